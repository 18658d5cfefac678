//! The files of a task: blobs, read in pieces, so that a file of gigabytes takes a few megabytes of this program's
//! memory.

use std::io::{self, Read};

use js_sys::Uint8Array;
use web_sys::{Blob, FileReaderSync};

use super::fault::text_of;
use crate::load::{FileHandle, FileSet};

/// Bytes of a file that are in memory at a time.
const CHUNK_BYTES: usize = 4 << 20;

/// Files that the page holds as blobs, with their names.
pub(super) struct BlobFiles(pub(super) Vec<(String, Blob)>);

impl FileSet for BlobFiles {
    fn names(&mut self) -> Vec<String> {
        self.0.iter().map(|(name, _)| name.clone()).collect()
    }

    fn open(&mut self, name: &str) -> io::Result<FileHandle<'_>> {
        let found = self.0.iter().find(|(n, _)| n == name);
        let (_, blob) = found.ok_or(io::ErrorKind::NotFound)?;
        let reader = FileReaderSync::new().map_err(|e| io::Error::other(text_of(&e)))?;
        Ok(FileHandle {
            byte_len: Some(blob.size() as u64),
            read: Box::new(BlobReader {
                blob: blob.clone(),
                reader,
                chunk: Vec::new(),
                at: 0,
                next: 0.0,
            }),
        })
    }
}

struct BlobReader {
    blob: Blob,
    reader: FileReaderSync,
    chunk: Vec<u8>,
    at: usize,
    next: f64,
}

impl Read for BlobReader {
    fn read(&mut self, out: &mut [u8]) -> io::Result<usize> {
        if self.at == self.chunk.len() {
            if self.next >= self.blob.size() {
                return Ok(0);
            }
            let end = (self.next + CHUNK_BYTES as f64).min(self.blob.size());
            let read = self
                .blob
                .slice_with_f64_and_f64(self.next, end)
                .and_then(|piece| self.reader.read_as_array_buffer(&piece))
                .map_err(|error| io::Error::other(text_of(&error)))?;
            self.chunk = Uint8Array::new(&read).to_vec();
            self.at = 0;
            self.next = end;
        }
        let n = out.len().min(self.chunk.len() - self.at);
        if let (Some(to), Some(from)) = (out.get_mut(..n), self.chunk.get(self.at..self.at + n)) {
            to.copy_from_slice(from);
        }
        self.at += n;
        Ok(n)
    }
}
