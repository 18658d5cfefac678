//! The files of a task: blobs that were given or fetched, read in pieces, so that a file of gigabytes takes a few
//! megabytes of this program's memory.

use std::collections::BTreeSet;
use std::io::{self, Read};

use js_sys::{Array, Reflect, Uint8Array};
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::JsFuture;
use web_sys::{Blob, FileReaderSync};

use super::answer::post;
use super::fault::{scope, text_of};
use crate::assets::LoadEvent;
use crate::load::{FileHandle, FileSet};

/// Bytes of a file that are in memory at a time.
const CHUNK_BYTES: usize = 4 << 20;

/// Where the bytes of a file are.
#[derive(Clone)]
enum Held {
    /// In the browser's own store; read by a reader that only workers have.
    Blob(Blob),
    /// In the page's memory, whole, where there is no worker.
    Bytes(Uint8Array),
}

impl Held {
    fn byte_len(&self) -> f64 {
        match self {
            Self::Blob(blob) => blob.size(),
            Self::Bytes(bytes) => f64::from(bytes.length()),
        }
    }

    /// The bytes from a place to another one.
    fn piece(&self, from: f64, to: f64) -> Result<Vec<u8>, JsValue> {
        match self {
            Self::Blob(blob) => {
                let piece = blob.slice_with_f64_and_f64(from, to)?;
                let read = FileReaderSync::new()?.read_as_array_buffer(&piece)?;
                Ok(Uint8Array::new(&read).to_vec())
            }
            Self::Bytes(bytes) => Ok(bytes.subarray(from as u32, to as u32).to_vec()),
        }
    }
}

/// Files that the page holds as blobs, with their names.
pub(super) struct BlobFiles(Vec<(String, Held)>);

impl BlobFiles {
    /// Files of these names. Where this is no worker they are read now.
    ///
    /// # Errors
    /// If one cannot be read.
    pub(super) async fn new(files: Vec<(String, Blob)>) -> Result<Self, JsValue> {
        let is_worker = Reflect::has(&js_sys::global(), &"FileReaderSync".into())?;
        let mut held = Vec::new();
        for (name, blob) in files {
            held.push((
                name,
                match is_worker {
                    true => Held::Blob(blob),
                    false => {
                        Held::Bytes(Uint8Array::new(&JsFuture::from(blob.array_buffer()).await?))
                    }
                },
            ));
        }
        Ok(Self(held))
    }

    /// Files that were opened together, and their names. Files from several folders may be called alike: those behind
    /// the first get other names.
    ///
    /// # Errors
    /// As [`BlobFiles::new`].
    pub(super) async fn of_all(
        mut files: Vec<(String, Blob)>,
    ) -> Result<(Self, Vec<String>), JsValue> {
        let mut names = BTreeSet::new();
        for (index, (name, _)) in files.iter_mut().enumerate() {
            if !names.insert(name.clone()) {
                *name = format!("{index}/{name}");
            }
        }
        let names = files.iter().map(|(name, _)| name.clone()).collect();
        Ok((Self::new(files).await?, names))
    }

    /// Keeps the files whose names are wanted.
    pub(super) fn retain(&mut self, is_wanted: impl Fn(&str) -> bool) {
        self.0.retain(|(name, _)| is_wanted(name));
    }
}

impl FileSet for BlobFiles {
    fn names(&mut self) -> Vec<String> {
        self.0.iter().map(|(name, _)| name.clone()).collect()
    }

    fn open(&mut self, name: &str) -> io::Result<FileHandle<'_>> {
        let found = self.0.iter().find(|(n, _)| n == name);
        let (_, held) = found.ok_or(io::ErrorKind::NotFound)?;
        Ok(FileHandle {
            byte_len: Some(held.byte_len() as u64),
            read: Box::new(HeldReader {
                held: held.clone(),
                chunk: Vec::new(),
                at: 0,
                next: 0.0,
            }),
        })
    }
}

struct HeldReader {
    held: Held,
    chunk: Vec<u8>,
    at: usize,
    next: f64,
}

impl Read for HeldReader {
    fn read(&mut self, out: &mut [u8]) -> io::Result<usize> {
        if self.at == self.chunk.len() {
            if self.next >= self.held.byte_len() {
                return Ok(0);
            }
            let end = (self.next + CHUNK_BYTES as f64).min(self.held.byte_len());
            let piece = self.held.piece(self.next, end);
            self.chunk = piece.map_err(|error| io::Error::other(text_of(&error)))?;
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

/// The name of what lies at an address.
pub(super) fn name_of(address: &str) -> String {
    let name = address.rsplit('/').next().unwrap_or_default();
    let name = name.split(['?', '#']).next().unwrap_or_default();
    name.to_owned()
}

/// That an address gave nothing.
pub(super) fn not_fetched(what: &str, address: &str, error: &JsValue) -> LoadEvent {
    LoadEvent::Failed {
        message: format!("The {what} could not be fetched from {address}"),
        details: format!(
            "{} The server may be down, or may not let other pages read its files (CORS).",
            text_of(error)
        ),
        fault: None,
    }
}

/// Fetches an address into the browser's own store of bytes, which is not this program's memory.
pub(super) async fn fetch(address: &str) -> Result<Blob, JsValue> {
    let response = JsFuture::from(scope().fetch_with_str(address)).await?;
    let response: web_sys::Response = response.unchecked_into();
    if !response.ok() {
        let text = format!("The server answered {}.", response.status());
        return Err(text.into());
    }
    let total = response
        .headers()
        .get("content-length")?
        .and_then(|n| n.parse::<f64>().ok());
    let parts = Array::new();
    let Some(body) = response.body() else {
        return Ok(JsFuture::from(response.blob()?).await?.unchecked_into());
    };
    let reader: web_sys::ReadableStreamDefaultReader = body.get_reader().unchecked_into();
    let (mut come, mut told) = (0.0, 0.0);
    loop {
        let chunk = JsFuture::from(reader.read()).await?;
        if Reflect::get(&chunk, &"done".into())?.is_truthy() {
            break;
        }
        let bytes: Uint8Array = Reflect::get(&chunk, &"value".into())?.unchecked_into();
        come += f64::from(bytes.length());
        parts.push(&bytes);
        let fraction = total.map_or(0.0, |total| (come / total.max(1.0)).min(1.0));
        if come - told > 1e6 {
            told = come;
            let event = LoadEvent::Progress {
                fraction: fraction as f32 * 0.5,
                what: "Fetching".to_owned(),
            };
            post::event(event)?;
        }
    }
    Blob::new_with_u8_array_sequence(&parts)
}
