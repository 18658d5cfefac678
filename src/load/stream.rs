//! Bytes of a file as a reader wants them: counted, hashed, unpacked, with a look ahead.

use std::cell::RefCell;
use std::io::{self, BufRead, Read};
use std::rc::Rc;

use bzip2::bufread::MultiBzDecoder;
use flate2::bufread::{GzDecoder, ZlibDecoder};
use sha2::{Digest as _, Sha256};

use super::LoadError;

/// Bytes read from the file at once. Larger costs memory, smaller costs calls (a browser's file reader is slow per
/// call).
const BLOCK_BYTES: usize = 256 * 1024;

/// The most that deflate can pack one byte (RFC 1951: 258 bytes per 2 bits), with room for the frame around it.
pub(crate) const DEFLATE_MAX_RATIO: u64 = 1032;

/// SHA-256 over all files opened, in order.
pub(crate) type SharedHash = Rc<RefCell<Sha256>>;

/// Reads through, counting and hashing.
struct Tap<'a> {
    inner: Box<dyn Read + 'a>,
    hash: Option<SharedHash>,
    count: u64,
}

impl Read for Tap<'_> {
    fn read(&mut self, buf: &mut [u8]) -> io::Result<usize> {
        let n = loop {
            match self.inner.read(buf) {
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                other => break other?,
            }
        };
        // A reader that claims more than it was offered is not believed.
        let n = n.min(buf.len());
        if let Some(hash) = &self.hash {
            hash.borrow_mut().update(&buf[..n]);
        }
        self.count += n as u64;
        Ok(n)
    }
}

/// A buffer that can look ahead any number of bytes.
struct Ahead<R> {
    inner: R,
    buffer: Vec<u8>,
    at: usize,
}

impl<R: Read> Ahead<R> {
    fn new(inner: R) -> Self {
        Self {
            inner,
            buffer: Vec::new(),
            at: 0,
        }
    }

    /// Up to `n` bytes that come next, without taking them; fewer only at the end.
    fn peek(&mut self, n: usize) -> io::Result<&[u8]> {
        while self.buffer.len() - self.at < n {
            if self.more()? == 0 {
                break;
            }
        }
        let end = self.buffer.len().min(self.at + n);
        Ok(&self.buffer[self.at..end])
    }

    fn more(&mut self) -> io::Result<usize> {
        self.buffer.drain(..self.at);
        self.at = 0;
        let start = self.buffer.len();
        self.buffer.resize(start + BLOCK_BYTES, 0);
        let result = self.inner.read(&mut self.buffer[start..]);
        let n = *result.as_ref().unwrap_or(&0);
        self.buffer.truncate(start + n);
        result
    }
}

impl<R: Read> BufRead for Ahead<R> {
    fn fill_buf(&mut self) -> io::Result<&[u8]> {
        self.peek(1)?;
        Ok(&self.buffer[self.at..])
    }

    fn consume(&mut self, n: usize) {
        self.at = (self.at + n).min(self.buffer.len());
    }
}

impl<R: Read> Read for Ahead<R> {
    fn read(&mut self, buf: &mut [u8]) -> io::Result<usize> {
        if self.at == self.buffer.len() && buf.len() >= BLOCK_BYTES {
            return self.inner.read(buf);
        }
        let n = self.fill_buf()?.read(buf)?;
        self.consume(n);
        Ok(n)
    }
}

type Raw<'a> = Ahead<Tap<'a>>;

enum Codec<'a> {
    Plain(Raw<'a>),
    Gzip(Box<Ahead<Members<'a>>>),
    Zlib(Box<Ahead<ZlibDecoder<Raw<'a>>>>),
    Bzip2(Box<Ahead<MultiBzDecoder<Raw<'a>>>>),
    /// Only while one becomes another.
    Gone,
}

/// All members of a gzip file, one after the other. What follows them that is no member is left where it is.
struct Members<'a> {
    decoder: Option<GzDecoder<Raw<'a>>>,
    rest: Option<Raw<'a>>,
}

impl Read for Members<'_> {
    fn read(&mut self, buf: &mut [u8]) -> io::Result<usize> {
        if buf.is_empty() {
            return Ok(0);
        }
        while let Some(decoder) = &mut self.decoder {
            let n = decoder.read(buf)?;
            if n > 0 {
                return Ok(n);
            }
            // The member ended and its checksum was right.
            let Some(decoder) = self.decoder.take() else {
                break;
            };
            let mut raw = decoder.into_inner();
            if raw.peek(2)? == [0x1f, 0x8b] {
                self.decoder = Some(GzDecoder::new(raw));
            } else {
                self.rest = Some(raw);
            }
        }
        Ok(0)
    }
}

/// How a file's bytes are packed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Packing {
    /// The bytes are not packed.
    Plain,
    /// gzip, any number of members.
    Gzip,
    /// zlib, as MetaImage has it.
    Zlib,
    /// bzip2, any number of streams.
    Bzip2,
}

/// One file being read.
pub(crate) struct Stream<'a> {
    name: String,
    codec: Codec<'a>,
    byte_len: Option<u64>,
    /// Unpacked bytes taken so far.
    position: u64,
    /// Bytes before the packed part, which `position` counts too.
    position_at_unpack: u64,
}

impl<'a> Stream<'a> {
    /// Starts to read a file; `hash` takes all bytes that are read.
    pub(crate) fn new(
        name: &str,
        read: Box<dyn Read + 'a>,
        byte_len: Option<u64>,
        hash: Option<SharedHash>,
    ) -> Self {
        Self {
            name: name.to_owned(),
            codec: Codec::Plain(Ahead::new(Tap {
                inner: read,
                hash,
                count: 0,
            })),
            byte_len,
            position: 0,
            position_at_unpack: 0,
        }
    }

    /// Name of the file, for messages.
    pub(crate) fn name(&self) -> &str {
        &self.name
    }

    /// Unpacked bytes taken so far.
    pub(crate) fn position(&self) -> u64 {
        self.position
    }

    /// Takes what follows as packed in this way.
    pub(crate) fn unpack(&mut self, packing: Packing) {
        self.codec = match (std::mem::replace(&mut self.codec, Codec::Gone), packing) {
            (Codec::Plain(raw), Packing::Gzip) => Codec::Gzip(Box::new(Ahead::new(Members {
                decoder: Some(GzDecoder::new(raw)),
                rest: None,
            }))),
            (Codec::Plain(raw), Packing::Zlib) => {
                Codec::Zlib(Box::new(Ahead::new(ZlibDecoder::new(raw))))
            }
            (Codec::Plain(raw), Packing::Bzip2) => {
                Codec::Bzip2(Box::new(Ahead::new(MultiBzDecoder::new(raw))))
            }
            (other, _) => other,
        };
        self.position_at_unpack = self.position;
    }

    /// The file's length, if known.
    pub(crate) fn byte_len(&self) -> Option<u64> {
        self.byte_len
    }

    /// How the bytes are packed from here on.
    pub(crate) fn packing(&self) -> Packing {
        match self.codec {
            Codec::Plain(_) | Codec::Gone => Packing::Plain,
            Codec::Gzip(_) => Packing::Gzip,
            Codec::Zlib(_) => Packing::Zlib,
            Codec::Bzip2(_) => Packing::Bzip2,
        }
    }

    fn raw(&mut self) -> Option<&mut Raw<'a>> {
        match &mut self.codec {
            Codec::Plain(raw) => Some(raw),
            Codec::Gzip(ahead) => {
                let members = &mut ahead.inner;
                match &mut members.decoder {
                    Some(decoder) => Some(decoder.get_mut()),
                    None => members.rest.as_mut(),
                }
            }
            Codec::Zlib(ahead) => Some(ahead.inner.get_mut()),
            Codec::Bzip2(ahead) => Some(ahead.inner.get_mut()),
            Codec::Gone => None,
        }
    }

    /// Bytes of the file read so far, as they lie on disk.
    pub(crate) fn raw_count(&mut self) -> u64 {
        self.raw().map_or(0, |raw| raw.inner.count)
    }

    /// Part of the file that was read, if its length is known.
    pub(crate) fn fraction(&mut self) -> Option<f32> {
        let len = self.byte_len.filter(|&len| len > 0)?;
        Some((self.raw_count() as f64 / len as f64).min(1.0) as f32)
    }

    /// The most unpacked bytes that can still come, if the file's length is known.
    pub(crate) fn bytes_left_at_most(&mut self) -> Option<u64> {
        let len = self.byte_len?;
        Some(match self.packing() {
            Packing::Plain => len.saturating_sub(self.position),
            Packing::Gzip | Packing::Zlib => len
                .saturating_mul(DEFLATE_MAX_RATIO)
                .saturating_add(self.position_at_unpack)
                .saturating_sub(self.position),
            // Runs of runs: a block of 900 kB can stand for 45 MB in 40 bytes.
            Packing::Bzip2 => u64::MAX,
        })
    }

    fn error(&self, error: &io::Error) -> LoadError {
        let codec = match self.packing() {
            Packing::Plain => None,
            Packing::Gzip => Some("gzip"),
            Packing::Zlib => Some("zlib"),
            Packing::Bzip2 => Some("bzip2"),
        };
        match (codec, error.kind()) {
            (
                Some(codec),
                io::ErrorKind::InvalidInput
                | io::ErrorKind::InvalidData
                | io::ErrorKind::UnexpectedEof,
            ) => LoadError::Damaged {
                name: self.name.clone(),
                codec,
                offset: self.position,
                message: error.to_string(),
            },
            _ => LoadError::Io {
                name: self.name.clone(),
                offset: self.position,
                message: error.to_string(),
            },
        }
    }

    /// Up to `n` unpacked bytes that come next, without taking them; fewer only at the end.
    pub(crate) fn peek(&mut self, n: usize) -> Result<Vec<u8>, LoadError> {
        let result = match &mut self.codec {
            Codec::Plain(raw) => raw.peek(n).map(<[u8]>::to_vec),
            Codec::Gzip(ahead) => ahead.peek(n).map(<[u8]>::to_vec),
            Codec::Zlib(ahead) => ahead.peek(n).map(<[u8]>::to_vec),
            Codec::Bzip2(ahead) => ahead.peek(n).map(<[u8]>::to_vec),
            Codec::Gone => Ok(Vec::new()),
        };
        result.map_err(|error| self.error(&error))
    }

    /// Fills the buffer as far as the file goes; returns how many bytes came.
    pub(crate) fn fill(&mut self, buf: &mut [u8]) -> Result<usize, LoadError> {
        let mut done = 0;
        while done < buf.len() {
            let rest = &mut buf[done..];
            let result = match &mut self.codec {
                Codec::Plain(raw) => raw.read(rest),
                Codec::Gzip(ahead) => ahead.read(rest),
                Codec::Zlib(ahead) => ahead.read(rest),
                Codec::Bzip2(ahead) => ahead.read(rest),
                Codec::Gone => Ok(0),
            };
            match result {
                Ok(0) => break,
                Ok(n) => {
                    done += n;
                    self.position += n as u64;
                }
                Err(error) => return Err(self.error(&error)),
            }
        }
        Ok(done)
    }

    /// Takes `n` bytes away unseen; returns how many there were.
    pub(crate) fn skip(
        &mut self,
        n: u64,
        mut keep_on: impl FnMut(&mut Self) -> bool,
    ) -> Result<u64, LoadError> {
        let mut buf = vec![0; BLOCK_BYTES.min(n as usize)];
        let mut left = n;
        while left > 0 {
            let want = (buf.len() as u64).min(left) as usize;
            let got = self.fill(&mut buf[..want])?;
            left -= got as u64;
            if got < want {
                break;
            }
            if !keep_on(self) {
                return Err(LoadError::Cancelled);
            }
        }
        Ok(n - left)
    }

    /// Takes one line, without its end; `None` at the end of the file. An endless line is an error.
    pub(crate) fn line(&mut self, max_bytes: usize) -> Result<Option<Vec<u8>>, LoadError> {
        let mut line = Vec::new();
        loop {
            let ahead = self.peek(256)?;
            if ahead.is_empty() {
                return Ok((!line.is_empty()).then_some(line));
            }
            let end = ahead.iter().position(|&byte| byte == b'\n');
            let take = end.map_or(ahead.len(), |end| end + 1);
            line.extend_from_slice(&ahead[..end.unwrap_or(take)]);
            let mut taken = vec![0; take];
            self.fill(&mut taken)?;
            if end.is_some() {
                if line.last() == Some(&b'\r') {
                    line.pop();
                }
                return Ok(Some(line));
            }
            if line.len() > max_bytes {
                return Err(LoadError::Unsupported {
                    name: self.name.clone(),
                    what: format!("a line of more than {max_bytes} bytes in a text header"),
                });
            }
        }
    }

    /// Reads the file to its end, so that its checksum and hash are complete. True if anything was left after what
    /// the caller has taken. Unpacks at most one more block: what a bomb would unpack to is not looked at.
    pub(crate) fn finish(
        &mut self,
        mut keep_on: impl FnMut(&mut Self) -> bool,
    ) -> Result<bool, LoadError> {
        let mut buf = vec![0; BLOCK_BYTES];
        let mut has_more = self.fill(&mut buf[..1])? > 0;
        if let Codec::Gzip(ahead) = &mut self.codec
            && let Some(rest) = &mut ahead.inner.rest
        {
            has_more |= !rest
                .peek(1)
                .map_err(|error| LoadError::Io {
                    name: self.name.clone(),
                    offset: self.position,
                    message: error.to_string(),
                })?
                .is_empty();
        }
        loop {
            let name = self.name.clone();
            let Some(raw) = self.raw() else {
                break;
            };
            let n = raw.inner.read(&mut buf).map_err(|error| LoadError::Io {
                name,
                offset: raw.inner.count,
                message: error.to_string(),
            })?;
            if n == 0 {
                break;
            }
            if !keep_on(self) {
                return Err(LoadError::Cancelled);
            }
        }
        Ok(has_more)
    }
}
