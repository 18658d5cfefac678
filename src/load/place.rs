//! Where the voxels of a text header lie: behind it, in one other file or in a list of them; packed, in text, behind
//! something to be skipped. Shared by NRRD, MetaImage and raw files.

use super::files::open;
use super::stream::{Packing, SharedHash, Stream};
use super::voxels::{ElementType, Layout, Slabs, VoxelSource};
use super::{FileSet, LoadError, LoadReport, Warning};
use crate::data::{SubjectPart, SubjectSink, Volume};

/// Longest line that is skipped, and longest number in text.
const MAX_LINE_BYTES: usize = 1 << 20;
const MAX_NUMBER_BYTES: usize = 64;
/// Bytes before the voxels that are unpacked to find how many there are ("skip all but the last").
const MAX_COUNTED_EXTRA: u64 = 64 * 1024 * 1024;

/// How voxels are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Encoding {
    Raw,
    Gzip,
    /// zlib, or gzip where the first bytes are those of gzip.
    Zlib,
    Bzip2,
    Ascii,
    Hex,
}

/// Bytes before the voxels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Skip {
    Bytes(u64),
    /// All but the voxels' own bytes.
    AllButLast,
}

/// Everything that is to be known to read one volume.
#[derive(Clone, Debug)]
pub(crate) struct Place {
    pub(crate) layout: Layout,
    pub(crate) encoding: Encoding,
    /// Lines skipped in each file, before anything is unpacked.
    pub(crate) line_skip: u64,
    /// Bytes skipped in each file, after.
    pub(crate) skip: Skip,
    /// Volumes one after the other, and the one that is wanted.
    pub(crate) frame_count: u64,
    pub(crate) frame: u64,
    /// True where bytes left over mean that the voxels are not at the place that the header gives.
    pub(crate) is_exact: bool,
}

/// A text header understood.
pub(crate) struct Header {
    /// What goes to the sink.
    pub(crate) volume: Volume,
    pub(crate) place: Place,
    /// Files of the voxels; `None` if they follow the header.
    pub(crate) files: Option<Vec<String>>,
}

/// Where the bytes of the voxels come from.
pub(crate) enum Source<'a> {
    /// The rest of the header's own file.
    Attached(Stream<'a>),
    /// Other files, each with the same share.
    Files {
        files: &'a mut dyn FileSet,
        header_name: String,
        names: Vec<String>,
        hash: SharedHash,
    },
}

/// Reads the wanted volume, and all files to their ends.
pub(crate) fn read(
    source: Source<'_>,
    header: &Header,
    sink: &mut dyn SubjectSink,
    report: &mut LoadReport,
) -> Result<(), LoadError> {
    let (place, header) = (&header.place, &header.volume);
    let mut reader = Reader {
        place,
        header,
        has_begun: false,
    };
    match source {
        Source::Attached(mut stream) => {
            let count = if place.skip == Skip::AllButLast {
                let raw = place.encoding == Encoding::Raw && stream.packing() == Packing::Plain;
                let left = stream.bytes_left_at_most().filter(|_| raw);
                Some(left.ok_or_else(|| {
                    unsupported(
                        stream.name(),
                        "byte skip -1 is for plain voxels of a file whose length is known",
                    )
                })?)
            } else {
                None
            };
            prepare(&mut stream, place)?;
            reader.begin(&mut stream, count, 1, sink)?;
            let mut slabs = Slabs::new(&place.layout, header, sink);
            reader.one(&mut stream, count, 0, 1, &mut slabs)?;
            slabs.finish(header, report);
            reader.end(&mut stream, 1, sink, report)
        }
        Source::Files {
            files,
            header_name,
            names,
            hash,
        } => {
            let file_count = names.len() as u64;
            let mut ends = Vec::new();
            // The sink gets its header once the first file has shown that it can hold its part of the voxels.
            let Some(first) = names.first() else {
                return Err(unsupported(
                    &header_name,
                    "the header names no file of voxels",
                ));
            };
            {
                let count = counted(files, first, &header_name, place)?;
                let mut stream = open(files, first, &header_name, None)?;
                prepare(&mut stream, place)?;
                reader.begin(&mut stream, count, file_count, sink)?;
            }
            let mut slabs = Slabs::new(&place.layout, header, sink);
            for (index, name) in names.iter().enumerate() {
                let count = counted(files, name, &header_name, place)?;
                let mut stream = open(files, name, &header_name, Some(&hash))?;
                prepare(&mut stream, place)?;
                reader.one(&mut stream, count, index as u64, file_count, &mut slabs)?;
                ends.push(reader.close(&mut stream, file_count, || slabs.progress())?);
                report.bytes_read += stream.raw_count();
            }
            slabs.finish(header, report);
            if ends.iter().any(|&has_more| has_more) {
                report.warn(Warning::TrailingBytes);
            }
            Ok(())
        }
    }
}

fn unsupported(name: &str, what: &str) -> LoadError {
    LoadError::Unsupported {
        name: name.to_owned(),
        what: what.to_owned(),
    }
}

/// Skips lines and starts to unpack.
fn prepare(stream: &mut Stream<'_>, place: &Place) -> Result<(), LoadError> {
    for _ in 0..place.line_skip {
        if stream.line(MAX_LINE_BYTES)?.is_none() {
            return Err(LoadError::Truncated {
                name: stream.name().to_owned(),
                expected: place.layout.byte_count().unwrap_or(u64::MAX),
                found: 0,
            });
        }
    }
    let packing = match place.encoding {
        Encoding::Raw | Encoding::Ascii | Encoding::Hex => return Ok(()),
        Encoding::Gzip => Packing::Gzip,
        Encoding::Zlib if stream.peek(2)? == [0x1f, 0x8b] => Packing::Gzip,
        Encoding::Zlib => Packing::Zlib,
        Encoding::Bzip2 => Packing::Bzip2,
    };
    if stream.packing() != Packing::Plain {
        return Err(unsupported(
            stream.name(),
            "packed twice: unpack the file once and open what comes out",
        ));
    }
    stream.unpack(packing);
    Ok(())
}

/// Bytes of voxels and what is before them in a file, where that must be known beforehand.
fn counted(
    files: &mut dyn FileSet,
    name: &str,
    header_name: &str,
    place: &Place,
) -> Result<Option<u64>, LoadError> {
    if place.skip != Skip::AllButLast {
        return Ok(None);
    }
    let mut stream = open(files, name, header_name, None)?;
    if place.encoding == Encoding::Raw
        && place.line_skip == 0
        && let Some(len) = stream.byte_len()
    {
        return Ok(Some(len));
    }
    prepare(&mut stream, place)?;
    let before = stream.position();
    let most = place
        .layout
        .byte_count()
        .and_then(|bytes| bytes.checked_mul(place.frame_count))
        .unwrap_or(u64::MAX)
        .saturating_add(MAX_COUNTED_EXTRA);
    let count = stream.skip(most, |_| true)?;
    if count == most {
        return Err(LoadError::TooLong {
            name: name.to_owned(),
            extra: MAX_COUNTED_EXTRA,
        });
    }
    debug_assert!(before <= stream.position(), "positions grow");
    Ok(Some(count))
}

struct Reader<'a> {
    place: &'a Place,
    header: &'a Volume,
    has_begun: bool,
}

impl Reader<'_> {
    fn frame_bytes(&self) -> u64 {
        self.place.layout.byte_count().unwrap_or(u64::MAX)
    }

    /// Bytes of voxels in each of so many files.
    fn file_bytes(&self, name: &str, file_count: u64) -> Result<u64, LoadError> {
        let total = self
            .frame_bytes()
            .checked_mul(self.place.frame_count)
            .ok_or_else(|| LoadError::TooLarge {
                name: name.to_owned(),
                voxels: u64::MAX,
                limit: u64::MAX,
            })?;
        let voxel_bytes =
            self.place.layout.element.byte_count() as u64 * u64::from(self.place.layout.components);
        if !total.is_multiple_of(file_count * voxel_bytes) {
            return Err(unsupported(
                name,
                &format!("its voxels cannot be dealt out evenly to {file_count} files"),
            ));
        }
        Ok(total / file_count)
    }

    /// The sink hears of the volume once the first file can hold its part.
    fn begin(
        &mut self,
        stream: &mut Stream<'_>,
        count: Option<u64>,
        file_count: u64,
        sink: &mut dyn SubjectSink,
    ) -> Result<(), LoadError> {
        let name = stream.name().to_owned();
        let file_bytes = self.file_bytes(&name, file_count)?;
        // In text, an element takes a digit and what parts it from the next; in hexadecimal a byte takes two.
        let needed = match self.place.encoding {
            Encoding::Ascii => {
                (file_bytes / self.place.layout.element.byte_count() as u64).saturating_mul(2) - 1
            }
            Encoding::Hex => file_bytes.saturating_mul(2),
            _ => match self.place.skip {
                Skip::Bytes(skip) => file_bytes.saturating_add(skip),
                Skip::AllButLast => file_bytes,
            },
        };
        let possible = match (count, self.place.encoding) {
            (Some(count), _) => Some(count),
            _ => stream.bytes_left_at_most(),
        };
        if let Some(found) = possible.filter(|&possible| possible < needed) {
            return Err(LoadError::Truncated {
                name,
                expected: needed,
                found,
            });
        }
        if !self.has_begun {
            self.has_begun = true;
            sink.take(SubjectPart::header(self.header.clone()))
                .map_err(LoadError::refused(&name))?;
        }
        Ok(())
    }

    /// Reads what one file holds of the wanted frame.
    fn one(
        &self,
        stream: &mut Stream<'_>,
        count: Option<u64>,
        file_index: u64,
        file_count: u64,
        slabs: &mut Slabs<'_>,
    ) -> Result<(), LoadError> {
        let name = stream.name().to_owned();
        let file_bytes = self.file_bytes(&name, file_count)?;
        let (file_start, frame_start) = (
            file_index * file_bytes,
            self.place.frame * self.frame_bytes(),
        );
        let (start, end) = (
            frame_start.max(file_start),
            (frame_start + self.frame_bytes()).min(file_start + file_bytes),
        );
        if start >= end {
            return Ok(());
        }
        let before = match (self.place.skip, count) {
            (Skip::Bytes(skip), _) => skip,
            (Skip::AllButLast, Some(count)) => {
                count.checked_sub(file_bytes).ok_or(LoadError::Truncated {
                    name: name.clone(),
                    expected: file_bytes,
                    found: count,
                })?
            }
            (Skip::AllButLast, None) => 0,
        };
        let element = self.place.layout.element;
        let voxel_bytes = element.byte_count() as u64 * u64::from(self.place.layout.components);
        let voxels = (end - start) / voxel_bytes;
        let skip = start - file_start;
        match self.place.encoding {
            Encoding::Ascii => {
                skip_exactly(stream, before, file_bytes, slabs)?;
                let mut text = Ascii::new(stream, element, self.place.layout.big_endian);
                text.drop_numbers(skip / element.byte_count() as u64)?;
                slabs.pull(&mut text, voxels)?;
            }
            Encoding::Hex => {
                skip_exactly(stream, before, file_bytes, slabs)?;
                let mut text = Hex { stream };
                let mut buf = [0];
                for _ in 0..skip {
                    text.fill(&mut buf)?;
                }
                slabs.pull(&mut text, voxels)?;
            }
            _ => {
                skip_exactly(stream, before.saturating_add(skip), file_bytes, slabs)?;
                if file_count == 1 {
                    slabs.pull(stream, voxels)?;
                } else {
                    slabs.pull(&mut Part { stream }, voxels)?;
                }
            }
        }
        Ok(())
    }

    /// Reads a file to its end; true if there were bytes that nobody asked for.
    fn close(
        &self,
        stream: &mut Stream<'_>,
        file_count: u64,
        mut keep_on: impl FnMut() -> bool,
    ) -> Result<bool, LoadError> {
        let is_text = matches!(self.place.encoding, Encoding::Ascii | Encoding::Hex);
        let extra = stream.finish(|_| keep_on())?;
        let is_last = self.place.frame + 1 == self.place.frame_count;
        let has_more = extra && is_last && !is_text && file_count == 1;
        if has_more && self.place.is_exact {
            // How many is found from the file's length where that can be.
            let known = stream
                .byte_len()
                .filter(|_| stream.packing() == Packing::Plain);
            return Err(LoadError::TooLong {
                name: stream.name().to_owned(),
                extra: known.map_or(1, |len| len.saturating_sub(stream.position()) + 1),
            });
        }
        Ok(has_more)
    }

    fn end(
        &self,
        stream: &mut Stream<'_>,
        file_count: u64,
        sink: &mut dyn SubjectSink,
        report: &mut LoadReport,
    ) -> Result<(), LoadError> {
        if self.close(stream, file_count, || sink.progress(1.0))? {
            report.warn(Warning::TrailingBytes);
        }
        report.bytes_read += stream.raw_count();
        Ok(())
    }
}

fn skip_exactly(
    stream: &mut Stream<'_>,
    n: u64,
    file_bytes: u64,
    slabs: &mut Slabs<'_>,
) -> Result<(), LoadError> {
    let skipped = stream.skip(n, |_| slabs.progress())?;
    if skipped < n {
        return Err(LoadError::Truncated {
            name: stream.name().to_owned(),
            expected: n.saturating_add(file_bytes),
            found: skipped,
        });
    }
    Ok(())
}

/// One of several files: its own fraction is not the progress of the whole.
struct Part<'a, 'b> {
    stream: &'a mut Stream<'b>,
}

impl VoxelSource for Part<'_, '_> {
    fn fill(&mut self, buf: &mut [u8]) -> Result<usize, LoadError> {
        self.stream.fill(buf)
    }

    fn fraction(&mut self) -> Option<f32> {
        None
    }

    fn name(&self) -> String {
        self.stream.name().to_owned()
    }
}

/// Numbers in text, parted by white space or commas, given as the bytes of their type.
struct Ascii<'a, 'b> {
    stream: &'a mut Stream<'b>,
    element: ElementType,
    big_endian: bool,
    text: Vec<u8>,
    at: usize,
}

impl<'a, 'b> Ascii<'a, 'b> {
    fn new(stream: &'a mut Stream<'b>, element: ElementType, big_endian: bool) -> Self {
        Self {
            stream,
            element,
            big_endian,
            text: Vec::new(),
            at: 0,
        }
    }

    fn next_byte(&mut self) -> Result<Option<u8>, LoadError> {
        if self.at == self.text.len() {
            self.text.resize(64 * 1024, 0);
            let n = self.stream.fill(&mut self.text)?;
            self.text.truncate(n);
            self.at = 0;
        }
        let byte = self.text.get(self.at).copied();
        self.at += usize::from(byte.is_some());
        Ok(byte)
    }

    /// The next number as text; `None` at the end.
    fn number(&mut self) -> Result<Option<String>, LoadError> {
        let mut token = String::new();
        loop {
            match self.next_byte()? {
                Some(byte) if !byte.is_ascii_whitespace() && byte != b',' => {
                    token.push(char::from(byte));
                    if token.len() > MAX_NUMBER_BYTES {
                        return Err(self.no_number(&token));
                    }
                }
                Some(_) if token.is_empty() => {}
                None if token.is_empty() => return Ok(None),
                _ => return Ok(Some(token)),
            }
        }
    }

    fn no_number(&self, token: &str) -> LoadError {
        LoadError::Damaged {
            name: self.stream.name().to_owned(),
            codec: "text",
            offset: self.stream.position(),
            message: format!("\"{}\" is no number of the type", token.escape_default()),
        }
    }

    fn drop_numbers(&mut self, n: u64) -> Result<(), LoadError> {
        for _ in 0..n {
            if self.number()?.is_none() {
                break;
            }
        }
        Ok(())
    }

    fn bytes(&self, token: &str) -> Result<Vec<u8>, LoadError> {
        macro_rules! whole {
            ($type:ty) => {
                token
                    .parse::<$type>()
                    .map(|x| x.to_le_bytes().to_vec())
                    .map_err(|_not_one| self.no_number(token))?
            };
        }
        let mut bytes = match self.element {
            ElementType::U8 => whole!(u8),
            ElementType::I8 => whole!(i8),
            ElementType::U16 => whole!(u16),
            ElementType::I16 => whole!(i16),
            ElementType::U32 => whole!(u32),
            ElementType::I32 => whole!(i32),
            ElementType::U64 => whole!(u64),
            ElementType::I64 => whole!(i64),
            ElementType::F32 => whole!(f32),
            ElementType::F64 => whole!(f64),
            ElementType::C64 | ElementType::C128 => return Err(self.no_number(token)),
        };
        if self.big_endian {
            bytes.reverse();
        }
        Ok(bytes)
    }
}

impl VoxelSource for Ascii<'_, '_> {
    fn fill(&mut self, buf: &mut [u8]) -> Result<usize, LoadError> {
        let mut done = 0;
        for place in buf.chunks_exact_mut(self.element.byte_count()) {
            let Some(token) = self.number()? else {
                break;
            };
            place.copy_from_slice(&self.bytes(&token)?);
            done += place.len();
        }
        Ok(done)
    }

    fn fraction(&mut self) -> Option<f32> {
        self.stream.fraction()
    }

    fn name(&self) -> String {
        self.stream.name().to_owned()
    }
}

/// Bytes as two hexadecimal digits each, white space between.
struct Hex<'a, 'b> {
    stream: &'a mut Stream<'b>,
}

impl VoxelSource for Hex<'_, '_> {
    fn fill(&mut self, buf: &mut [u8]) -> Result<usize, LoadError> {
        let mut digits = 0;
        let mut text = vec![0; 64 * 1024];
        while digits < 2 * buf.len() {
            let want = text.len().min(2 * buf.len() - digits);
            let got = self.stream.fill(&mut text[..want])?;
            for &byte in text[..got]
                .iter()
                .filter(|byte| !byte.is_ascii_whitespace())
            {
                let Some(digit) = char::from(byte).to_digit(16) else {
                    return Err(LoadError::Damaged {
                        name: self.stream.name().to_owned(),
                        codec: "hexadecimal",
                        offset: self.stream.position(),
                        message: "no hexadecimal digit".to_owned(),
                    });
                };
                let place = &mut buf[digits / 2];
                *place = (*place << 4) | digit as u8;
                digits += 1;
            }
            if got < want {
                break;
            }
        }
        Ok(digits / 2)
    }

    fn fraction(&mut self) -> Option<f32> {
        self.stream.fraction()
    }

    fn name(&self) -> String {
        self.stream.name().to_owned()
    }
}
