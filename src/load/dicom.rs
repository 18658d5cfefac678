//! DICOM: a volume out of one file or of all files given together. Headers are looked through first, then the images of
//! the wanted volume are read one after the other. Of a header, only what says what made the images, how pixels are
//! written and where they lie is ever taken out: names, dates and whatever else tells who the patient is are stepped
//! over.

use std::cell::RefCell;
use std::rc::Rc;

use glam::UVec3;
use sha2::{Digest as _, Sha256};

use super::dicom_data::{self, Fault, Parsed, tag};
use super::dicom_pixels::FrameFault;
use super::dicom_series::{self, Frame, Source, Stack};
use super::files::{FileSet, open};
use super::geometry::{self, checked_dims};
use super::report::clean_name;
use super::stream::{Packing, SharedHash, Stream};
use super::voxels::{Layout, VoxelSource, stream_voxels};
use super::{ElementType, Format, LoadError, LoadReport, ReadOptions, Warning};
use crate::data::{Segment, SubjectPart, SubjectSink};

pub(crate) use super::dicom_data::{has_mark, is_header};

/// Bytes of a file that are looked at first; a header that is longer doubles them.
const HEADER_BYTES: usize = 64 * 1024;
/// Message about files that hold directories, reports or contours.
const NO_PIXELS: &str = "a DICOM file without pixels";
/// Images of all files together.
const MAX_FRAMES: usize = 1 << 18;

/// Reads the wanted volume of the file `name` and those of its series beside it; of all files for [`super::ALL_FILES`].
/// Returns the hash of what the volumes were chosen from.
pub(crate) fn read(
    files: &mut dyn FileSet,
    name: &str,
    options: &ReadOptions,
    sink: &mut dyn SubjectSink,
    report: &mut LoadReport,
) -> Result<[u8; 32], LoadError> {
    report.format = Some(Format::Dicom);
    let found = survey(files, name, sink)?;
    let Survey {
        sources, frames, ..
    } = found;
    let mut stacks = dicom_series::stacks(&sources, frames);
    report.frame_count = stacks.len() as u64;
    if options.frame >= stacks.len() as u64 {
        return Err(LoadError::NoSuchFrame {
            name: name.to_owned(),
            asked: options.frame,
            count: stacks.len() as u64,
        });
    }
    let stack = stacks.swap_remove(options.frame as usize);
    drop(stacks);
    if report.frame_count > 1 {
        report.warn(Warning::Frames {
            count: report.frame_count,
            shown: options.frame,
        });
    }
    if found.refused > 0 {
        report.warn(Warning::LeftOut {
            count: found.refused,
        });
    }
    let drawn = stack.slices.iter().flatten().next();
    let modality = drawn.map_or("", |frame| &sources[frame.file].modality);
    report.modality = modality_code(modality);
    for warning in &stack.warnings {
        report.warn(warning.clone());
    }
    let mut hashes = vec![None; sources.len()];
    read_stack(
        files,
        name,
        options,
        &sources,
        &stack,
        &mut hashes,
        sink,
        report,
    )?;
    // Files that are not shown belong to the series all the same, and are part of its hash.
    for (source, hash) in sources.iter().zip(&mut hashes) {
        if hash.is_none() {
            let loaded = load(files, &source.name, name)?;
            report.bytes_read += loaded.byte_count;
            *hash = Some(loaded.hash);
            if !sink.progress(1.0) {
                return Err(LoadError::Cancelled);
            }
        }
    }
    let mut hashes: Vec<[u8; 32]> = hashes.into_iter().flatten().collect();
    if let [one] = hashes[..] {
        return Ok(one);
    }
    // In whatever order files come and however they are called.
    hashes.sort_unstable();
    let mut all = Sha256::new();
    hashes.iter().for_each(|hash| all.update(hash));
    Ok(all.finalize().into())
}

/// A code string of the standard (PS3.5, "Value Representation", CS) as it may stand on a screen; nothing for anything
/// else, since anything may stand in a file.
fn modality_code(text: &str) -> Option<String> {
    let is_code = |c: char| c.is_ascii_uppercase() || c.is_ascii_digit() || c == '_';
    let is_whole = (1..=16).contains(&text.len()) && text.chars().all(is_code);
    is_whole.then(|| text.to_owned())
}

/// What the files hold.
struct Survey {
    sources: Vec<Source>,
    frames: Vec<Frame>,
    /// DICOM images that cannot be read.
    refused: u64,
}

fn survey(
    files: &mut dyn FileSet,
    name: &str,
    sink: &mut dyn SubjectSink,
) -> Result<Survey, LoadError> {
    let mut survey = Survey {
        sources: Vec::new(),
        frames: Vec::new(),
        refused: 0,
    };
    let is_all = name == super::ALL_FILES;
    let mut series = None;
    let mut refusal = None;
    if !is_all {
        let (source, frames) = one(files, name, 0)?;
        series = Some(source.series.clone());
        survey.sources.push(source);
        survey.frames = frames;
    }
    let mut names = files.names();
    names.sort();
    // A file called .dcm is looked for among its like: its folder may hold anything.
    if !is_all && has_ending(name) {
        names.retain(|other| has_ending(other));
    }
    // A file without a series stands alone.
    if series.as_ref().is_some_and(String::is_empty) {
        names.clear();
    }
    for (i, other) in names.iter().enumerate() {
        if other == name {
            continue;
        }
        if i % 16 == 0 && !sink.progress(0.0) {
            return Err(LoadError::Cancelled);
        }
        match one(files, other, survey.sources.len()) {
            Ok((source, frames)) => {
                let belongs = series
                    .as_ref()
                    .is_none_or(|series| *series == source.series);
                if belongs && survey.frames.len() + frames.len() <= MAX_FRAMES {
                    survey.sources.push(source);
                    survey.frames.extend(frames);
                }
            }
            // Only a file that is an image by its header and still cannot be read gets a warning.
            Err(error @ LoadError::Unsupported { .. }) if is_all => {
                let is_image =
                    !matches!(&error, LoadError::Unsupported { what, .. } if what == NO_PIXELS);
                survey.refused += u64::from(is_image);
                refusal.get_or_insert(error);
            }
            Err(_) => {}
        }
    }
    if survey.sources.is_empty() {
        return Err(refusal.unwrap_or_else(|| LoadError::Unsupported {
            name: name.to_owned(),
            what: "there is no DICOM image among the files".to_owned(),
        }));
    }
    Ok(survey)
}

fn unsupported(name: &str, what: impl Into<String>) -> LoadError {
    LoadError::Unsupported {
        name: name.to_owned(),
        what: what.into(),
    }
}

fn fault(name: &str, fault: Fault, bytes: &[u8]) -> LoadError {
    match fault {
        Fault::Short => LoadError::Damaged {
            name: name.to_owned(),
            codec: "DICOM",
            offset: bytes.len() as u64,
            message: "the file ends in the middle of an element".to_owned(),
        },
        Fault::Wrong { offset, what } => LoadError::Damaged {
            name: name.to_owned(),
            codec: "DICOM",
            offset: offset as u64,
            message: what.to_owned(),
        },
    }
}

fn start<'a>(
    files: &'a mut dyn FileSet,
    name: &str,
    asked_by: &str,
    hash: Option<&SharedHash>,
) -> Result<Stream<'a>, LoadError> {
    let mut stream = open(files, name, asked_by, hash)?;
    if stream.peek(2)? == [0x1f, 0x8b] {
        stream.unpack(Packing::Gzip);
    }
    Ok(stream)
}

/// The header of one file.
fn one(
    files: &mut dyn FileSet,
    name: &str,
    index: usize,
) -> Result<(Source, Vec<Frame>), LoadError> {
    let mut stream = start(files, name, name, None)?;
    let mut len = HEADER_BYTES;
    loop {
        let bytes = stream.peek(len)?;
        let is_end = bytes.len() < len;
        if len == HEADER_BYTES && !is_header(&bytes) && !has_ending(name) {
            return Err(LoadError::UnknownFormat {
                name: name.to_owned(),
                begins: String::new(),
            });
        }
        let unpacked = dicom_data::unpack(&bytes, is_end);
        match unpacked.and_then(|bytes| dicom_data::parse(&bytes, false)) {
            Err(Fault::Short) if !is_end => {
                len *= 2;
                continue;
            }
            Err(error) => return Err(fault(name, error, &bytes)),
            // A data set without pixels was read to the end of the bytes so far: more bytes may bring more elements.
            Ok(parsed) if parsed.pixels.tag == 0 && !is_end => {
                len *= 2;
                continue;
            }
            Ok(parsed) => {
                if parsed.pixels.tag == 0 {
                    return Err(unsupported(name, NO_PIXELS));
                }
                return dicom_series::frames(&parsed, name, index)
                    .map_err(|what| unsupported(name, format!("a DICOM image, but {what}")));
            }
        }
    }
}

/// The name to read of files that were given together: all of them if some are DICOM, else the first.
pub fn main_name(files: &mut dyn FileSet, first: &str) -> String {
    const LOOKED_AT: usize = 16;
    let names = files.names();
    if names.len() < 2 {
        return first.to_owned();
    }
    let is_dicom = names.iter().take(LOOKED_AT).any(|name| {
        start(files, name, name, None)
            .and_then(|mut stream| stream.peek(132))
            .is_ok_and(|bytes| is_header(&bytes))
    });
    if is_dicom { super::ALL_FILES } else { first }.to_owned()
}

/// True if a file is a DICOM segmentation by its header.
pub fn is_segmentation(files: &mut dyn FileSet, name: &str) -> bool {
    one(files, name, 0).is_ok_and(|(source, _)| source.is_segmentation)
}

/// How the names of DICOM files end.
pub(crate) const ENDINGS: [&str; 2] = [".dcm", ".ima"];

/// True if a file is called like a DICOM file.
fn has_ending(name: &str) -> bool {
    let lower = name.to_lowercase();
    let lower = lower.strip_suffix(".gz").unwrap_or(&lower);
    ENDINGS.iter().any(|ending| lower.ends_with(ending))
}

/// A file in memory.
struct Loaded {
    bytes: Vec<u8>,
    parsed: Parsed,
    hash: [u8; 32],
    byte_count: u64,
}

fn load(files: &mut dyn FileSet, name: &str, asked_by: &str) -> Result<Loaded, LoadError> {
    let hash: SharedHash = Rc::new(RefCell::new(Sha256::new()));
    let mut stream = start(files, name, asked_by, Some(&hash))?;
    let mut bytes = Vec::new();
    // A packed file may not unpack to more than anyone can want.
    let most = match stream.packing() {
        Packing::Plain => u64::MAX,
        _ => 4 * stream.byte_len().unwrap_or(0) + (64 << 20),
    };
    let mut block = vec![0; 256 * 1024];
    loop {
        let n = stream.fill(&mut block)?;
        bytes.extend_from_slice(&block[..n]);
        if n < block.len() {
            break;
        }
        if bytes.len() as u64 > most {
            return Err(unsupported(
                name,
                "it unpacks to more than a DICOM image can be",
            ));
        }
    }
    stream.finish(|_| true)?;
    let byte_count = stream.raw_count();
    drop(stream);
    if let std::borrow::Cow::Owned(unpacked) =
        dicom_data::unpack(&bytes, true).map_err(|error| fault(name, error, &bytes))?
    {
        bytes = unpacked;
    }
    let parsed = dicom_data::parse(&bytes, true).map_err(|error| fault(name, error, &bytes))?;
    let hash = hash.borrow().clone().finalize().into();
    Ok(Loaded {
        bytes,
        parsed,
        hash,
        byte_count,
    })
}

#[expect(
    clippy::too_many_arguments,
    reason = "one step of `read`, cut out for its length"
)]
fn read_stack(
    files: &mut dyn FileSet,
    name: &str,
    options: &ReadOptions,
    sources: &[Source],
    stack: &Stack,
    hashes: &mut [Option<[u8; 32]>],
    sink: &mut dyn SubjectSink,
    report: &mut LoadReport,
) -> Result<(), LoadError> {
    let first = stack
        .slices
        .iter()
        .flatten()
        .next()
        .ok_or(LoadError::Cancelled)?;
    let source = &sources[first.file];
    let format = &source.format;
    let dims = [
        format.columns.into(),
        format.rows.into(),
        stack.slices.len() as u64,
    ];
    let dims: UVec3 = checked_dims(name, dims, options)?;
    let stored = format.comes_as();
    let is_segmentation = source.is_segmentation;
    let all = || stack.slices.iter().flatten();
    let is_same =
        all().all(|frame| (frame.slope, frame.intercept) == (first.slope, first.intercept));
    let can_be = |frame: &Frame| stored.can_be_scaled(frame.slope as f32, frame.intercept as f32);
    if stored != format.element || format.color != super::dicom_pixels::Color::Gray {
        report.warn(Warning::Luminance);
    }
    let mut scale = Scale::Header;
    let (mut slope, mut intercept) = (first.slope as f32, first.intercept as f32);
    if is_segmentation {
        (slope, intercept) = (1.0, 0.0);
    } else if !all().all(can_be) {
        report.warn(Warning::BadScale { slope, intercept });
        (slope, intercept) = (1.0, 0.0);
    } else if !is_same {
        scale = Scale::Each;
        (slope, intercept) = (1.0, 0.0);
    }
    let element = match scale {
        Scale::Header => stored,
        Scale::Each => ElementType::F32,
    };
    let layout = Layout {
        element: if is_segmentation {
            ElementType::U8
        } else {
            element
        },
        big_endian: false,
        dims,
        components: 1,
        component: 0,
        is_color: false,
    };
    report.stored_type = stored.name();
    report.dims = dims;
    let has_size = report.tells_size();
    let header = geometry::header(
        name,
        &layout,
        stack.world_from_voxel,
        slope,
        intercept,
        has_size,
    )?;
    let mut slices = Slices {
        files,
        asked_by: name,
        sources,
        stack,
        scale,
        stored,
        loaded: None,
        hashes,
        slice: Vec::new(),
        next: 0,
        at: 0,
        bytes_read: 0,
        overlaps: 0,
    };
    // The first slice is read before anything is promised.
    slices.advance()?;
    if is_segmentation {
        report.is_labels = true;
        if let Some((_, loaded)) = &slices.loaded {
            report.segments = segments(&loaded.parsed);
        }
    }
    sink.take(SubjectPart::header(header.clone()))
        .map_err(LoadError::refused(name))?;
    stream_voxels(&mut slices, &layout, &header, sink, report)?;
    report.bytes_read += slices.bytes_read;
    if slices.overlaps > 0 {
        report.warn(Warning::OverlappingSegments {
            count: slices.overlaps,
        });
    }
    Ok(())
}

/// Where slope and intercept are applied.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Scale {
    /// All images have the same: they go into the header.
    Header,
    /// Each image has its own: values are kept instead.
    Each,
}

/// The slices of a stack as bytes, one after the other.
struct Slices<'a> {
    files: &'a mut dyn FileSet,
    asked_by: &'a str,
    sources: &'a [Source],
    stack: &'a Stack,
    scale: Scale,
    stored: ElementType,
    /// The file read last.
    loaded: Option<(usize, Loaded)>,
    hashes: &'a mut [Option<[u8; 32]>],
    slice: Vec<u8>,
    /// The slice after the one in hand.
    next: usize,
    /// Bytes of the slice in hand that were taken.
    at: usize,
    bytes_read: u64,
    /// Voxels of more than one segment.
    overlaps: u64,
}

impl Slices<'_> {
    fn frame(&mut self, frame: &Frame) -> Result<Vec<u8>, LoadError> {
        let source = &self.sources[frame.file];
        if self
            .loaded
            .as_ref()
            .is_none_or(|(file, _)| *file != frame.file)
        {
            self.loaded = None;
            let loaded = load(self.files, &source.name, self.asked_by)?;
            if self.hashes[frame.file].is_none() {
                self.bytes_read += loaded.byte_count;
            }
            self.hashes[frame.file] = Some(loaded.hash);
            self.loaded = Some((frame.file, loaded));
        }
        let Some((_, loaded)) = &self.loaded else {
            return Err(LoadError::Cancelled);
        };
        source
            .format
            .frame(
                &loaded.bytes,
                &loaded.parsed,
                frame.index,
                source.frame_count,
            )
            .map_err(|fault| match fault {
                FrameFault::Short { expected, found } => LoadError::Truncated {
                    name: source.name.clone(),
                    expected,
                    found,
                },
                FrameFault::Other(what) => {
                    unsupported(&source.name, format!("a DICOM image, but {what}"))
                }
            })
    }

    fn advance(&mut self) -> Result<(), LoadError> {
        let stack = self.stack;
        let Some(frames) = stack.slices.get(self.next) else {
            self.slice = Vec::new();
            return Ok(());
        };
        let is_repeated = self.next > 0
            && {
                let before = stack
                    .slices
                    .get(self.next - 1)
                    .and_then(|frames| frames.first());
                matches!((before, frames.first()), (Some(a), Some(b)) if a.file == b.file && a.index == b.index)
            };
        self.next += 1;
        self.at = 0;
        if is_repeated {
            return Ok(());
        }
        self.slice = match frames.as_slice() {
            // A segmentation: numbers of segments; an empty slice has none.
            [] => vec![0; self.pixel_count()],
            [first, ..] if first.segment.is_some() => {
                let mut labels = vec![0u8; self.pixel_count()];
                for frame in frames {
                    let number = frame
                        .segment
                        .and_then(|n| u8::try_from(n).ok())
                        .unwrap_or(u8::MAX);
                    let mask = self.frame(frame)?;
                    for (label, &bit) in labels.iter_mut().zip(&mask) {
                        if bit > 0 {
                            self.overlaps += u64::from(*label != 0);
                            *label = number;
                        }
                    }
                }
                labels
            }
            [frame, ..] => {
                let bytes = self.frame(frame)?;
                match self.scale {
                    Scale::Header => bytes,
                    Scale::Each => scaled(
                        &bytes,
                        self.stored,
                        frame.slope as f32,
                        frame.intercept as f32,
                    ),
                }
            }
        };
        Ok(())
    }

    fn pixel_count(&self) -> usize {
        let first = self.stack.slices.iter().flatten().next();
        let format = first.map(|frame| &self.sources[frame.file].format);
        format.map_or(0, |format| format.rows as usize * format.columns as usize)
    }
}

impl VoxelSource for Slices<'_> {
    fn fill(&mut self, buf: &mut [u8]) -> Result<usize, LoadError> {
        let mut done = 0;
        while done < buf.len() {
            if self.at == self.slice.len() {
                if self.next == self.stack.slices.len() {
                    break;
                }
                self.advance()?;
                if self.slice.is_empty() {
                    break;
                }
            }
            let n = (self.slice.len() - self.at).min(buf.len() - done);
            buf[done..done + n].copy_from_slice(&self.slice[self.at..self.at + n]);
            self.at += n;
            done += n;
        }
        Ok(done)
    }

    fn fraction(&mut self) -> Option<f32> {
        None
    }

    fn name(&self) -> String {
        self.asked_by.to_owned()
    }
}

/// Values of one image, as 32-bit floats.
fn scaled(bytes: &[u8], stored: ElementType, slope: f32, intercept: f32) -> Vec<u8> {
    fn each<const N: usize>(bytes: &[u8], value: impl Fn([u8; N]) -> f32) -> Vec<u8> {
        let (items, _) = bytes.as_chunks::<N>();
        items
            .iter()
            .flat_map(|item| value(*item).to_le_bytes())
            .collect()
    }
    let apply = |stored: f32| stored * slope + intercept;
    match stored {
        ElementType::I8 => each(bytes, |[b]| apply(f32::from(b as i8))),
        ElementType::U16 => each(bytes, |b| apply(f32::from(u16::from_le_bytes(b)))),
        ElementType::I16 => each(bytes, |b| apply(f32::from(i16::from_le_bytes(b)))),
        ElementType::U32 => each(bytes, |b| apply(u32::from_le_bytes(b) as f32)),
        ElementType::I32 => each(bytes, |b| apply(i32::from_le_bytes(b) as f32)),
        ElementType::F32 => each(bytes, |b| apply(f32::from_le_bytes(b))),
        ElementType::F64 => each(bytes, |b| apply(f64::from_le_bytes(b) as f32)),
        _ => each(bytes, |[b]| apply(f32::from(b))),
    }
}

/// Names and colours of the segments of a segmentation.
fn segments(parsed: &Parsed) -> Vec<Segment> {
    let items = parsed.root.items(tag::SEGMENTS).iter().take(255);
    items
        .filter_map(|item| {
            let label = item
                .short(tag::SEGMENT_NUMBER)
                .filter(|&number| (1..=255).contains(&number))?;
            let color = item.shorts(tag::SEGMENT_COLOR);
            let name = clean_name(&item.text(tag::SEGMENT_LABEL).unwrap_or_default());
            Some(Segment {
                label,
                name: if name.is_empty() {
                    format!("segment {label}")
                } else {
                    name
                },
                color_srgb: color.first_chunk::<3>().map(|&lab| srgb_from_cielab(lab)),
            })
        })
        .collect()
}

/// A colour as DICOM writes it (PS3.3, C.10.7.1.1: CIELab under D50, in 16 bits) as sRGB bytes. IEC 61966-2-1, with the
/// Bradford matrix from D50.
fn srgb_from_cielab([l, a, b]: [u16; 3]) -> [u8; 3] {
    let lightness = f64::from(l) / 65_535.0 * 100.0;
    let a = f64::from(a) / 65_535.0 * 255.0 - 128.0;
    let b = f64::from(b) / 65_535.0 * 255.0 - 128.0;
    let fy = (lightness + 16.0) / 116.0;
    let inverse = |f: f64| {
        if f > 6.0 / 29.0 {
            f.powi(3)
        } else {
            3.0 * (6.0_f64 / 29.0).powi(2) * (f - 4.0 / 29.0)
        }
    };
    let [x, y, z] = [
        0.964_22 * inverse(fy + a / 500.0),
        inverse(fy),
        0.825_21 * inverse(fy - b / 200.0),
    ];
    let linear = [
        3.133_856_1 * x - 1.616_866_7 * y - 0.490_614_6 * z,
        -0.978_768_4 * x + 1.916_141_5 * y + 0.033_454_0 * z,
        0.071_945_3 * x - 0.228_991_4 * y + 1.405_242_7 * z,
    ];
    linear.map(crate::math::srgb_from_linear)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_of_segments() {
        assert_eq!(srgb_from_cielab([65_535, 32_896, 32_896]), [255, 255, 255]);
        assert_eq!(srgb_from_cielab([0, 32_896, 32_896]), [0, 0, 0]);
        let red = srgb_from_cielab([35_565, 53_626, 50_844]);
        assert!(red[0] > 240 && red[1] < 30 && red[2] < 30, "{red:?}");
    }
}
