//! NIfTI-1 and NIfTI-2 (Cox et al. 2004; nifti.nimh.nih.gov), in one file or two, and Analyze 7.5 where the pair has no
//! NIfTI mark.
//!
//! Orientation is chosen as the standard says: the sform where its code is above 0, else the qform where its is, else
//! the voxel sizes alone (method 1), with a warning that left and right are not known.

use glam::{DAffine3, DMat3, DVec3, UVec3};

use super::geometry::{self, checked_dims};
use super::stream::{Packing, Stream};
use super::voxels::{ElementType, Layout, stream_voxels};
use super::{Format, LoadError, LoadReport, ReadOptions, Warning};
use crate::data::{Segment, SubjectPart, SubjectSink, Volume};

const SIZE_1: usize = 348;
const SIZE_2: usize = 540;
/// Header extensions up to this are looked at for label names; larger ones are passed over.
const MAX_EXTENSION_BYTES: u64 = 4 * 1024 * 1024;
const INTENT_LABEL: i64 = 1002;
const INTENT_DISPLACEMENT: i64 = 1006;

/// True if the bytes begin as a NIfTI or Analyze header does.
pub(crate) fn is_header(start: &[u8]) -> bool {
    let magic_1 = start.get(344..347);
    let size = start.get(..4).and_then(|b| <[u8; 4]>::try_from(b).ok());
    let sizes = [SIZE_1 as i32, SIZE_2 as i32];
    magic_1 == Some(b"n+1")
        || magic_1 == Some(b"ni1")
        || matches!(start.get(4..7), Some(b"n+2" | b"ni2"))
        || (start.len() >= SIZE_1
            && size.is_some_and(|b| {
                sizes.contains(&i32::from_le_bytes(b)) || sizes.contains(&i32::from_be_bytes(b))
            }))
}

/// A header, checked: all that is needed to read the voxels.
pub(crate) struct Header {
    volume: Volume,
    layout: Layout,
    frame_bytes: u64,
    /// Where the voxels begin in their file.
    vox_offset: u64,
}

/// Header bytes with their version and byte order.
struct Fields<'a> {
    bytes: &'a [u8],
    is_two: bool,
    big_endian: bool,
}

impl Fields<'_> {
    fn raw<const N: usize>(&self, offset: usize) -> [u8; N] {
        let mut raw = [0; N];
        // Headers are read whole before, so that the bytes are always there.
        if let Some(bytes) = self.bytes.get(offset..offset + N) {
            raw.copy_from_slice(bytes);
        }
        if self.big_endian {
            raw.reverse();
        }
        raw
    }

    /// A whole number: 16 bit at `one`, or at `two` with as many bits as given there.
    fn whole(&self, one: usize, two: (usize, u32)) -> i64 {
        match (self.is_two, two.1) {
            (false, _) => i64::from(i16::from_le_bytes(self.raw(one))),
            (true, 16) => i64::from(i16::from_le_bytes(self.raw(two.0))),
            (true, 32) => i64::from(i32::from_le_bytes(self.raw(two.0))),
            (true, _) => i64::from_le_bytes(self.raw(two.0)),
        }
    }

    /// A float: 32 bit at `one`, 64 bit at `two`.
    fn float(&self, one: usize, two: usize) -> f64 {
        if self.is_two {
            f64::from_le_bytes(self.raw(two))
        } else {
            f64::from(f32::from_le_bytes(self.raw(one)))
        }
    }

    fn dim(&self, i: usize) -> i64 {
        self.whole(40 + 2 * i, (16 + 8 * i, 64))
    }

    fn pixdim(&self, i: usize) -> f64 {
        self.float(76 + 4 * i, 104 + 8 * i)
    }

    /// Offsets for messages: of a field in version 1 and 2.
    fn at(&self, one: u64, two: u64) -> u64 {
        if self.is_two { two } else { one }
    }
}

/// Reads the header and, of a single file, the voxels. Of a pair, gives the header for [`read_voxels`] on the other
/// file.
pub(crate) fn read(
    stream: &mut Stream<'_>,
    name: &str,
    options: &ReadOptions,
    sink: &mut dyn SubjectSink,
    report: &mut LoadReport,
) -> Result<Option<Header>, LoadError> {
    let start = stream.peek(SIZE_2)?;
    let (is_two, big_endian) = version(&start, name)?;
    let size = if is_two { SIZE_2 } else { SIZE_1 };
    if start.len() < size {
        return Err(LoadError::Truncated {
            name: name.to_owned(),
            expected: size as u64,
            found: start.len() as u64,
        });
    }
    let fields = Fields {
        bytes: &start[..size],
        is_two,
        big_endian,
    };
    let magic: [u8; 3] = if is_two {
        [start[4], start[5], start[6]]
    } else {
        [start[344], start[345], start[346]]
    };
    let format = match &magic {
        b"n+1" => Format::Nifti1,
        b"ni1" => Format::Nifti1Pair,
        b"n+2" => Format::Nifti2,
        b"ni2" => Format::Nifti2Pair,
        // Without the mark, only the half of a pair can be meant: the one before NIfTI.
        _ if !is_two && super::files::siblings(name, "hdr", "img").is_some() => Format::Analyze,
        other => {
            return Err(LoadError::Header {
                name: name.to_owned(),
                field: "magic",
                offset: if is_two { 4 } else { 344 },
                expected: "n+1, ni1, n+2 or ni2".to_owned(),
                found: format!("{:02x} {:02x} {:02x}", other[0], other[1], other[2]),
            });
        }
    };
    report.format = Some(format);
    let mut header = understand(&fields, name, format, options, report)?;
    stream.skip(size as u64, |_| true)?;
    match format {
        Format::Nifti1 | Format::Nifti2 => {
            let least = size as u64;
            if header.vox_offset < least {
                // Some writers leave it 0; the voxels then follow the header and its four bytes of flags.
                report.warn(Warning::Repaired {
                    field: "vox_offset",
                    what: format!(
                        "{} lies inside the header; the voxels are taken from byte {}",
                        header.vox_offset,
                        least + 4
                    ),
                });
                header.vox_offset = least + 4;
            }
            read_extensions(stream, header.vox_offset, big_endian, report)?;
            read_voxels(stream, &header, options, sink, report)?;
            Ok(None)
        }
        _ => {
            read_extensions(stream, u64::MAX, big_endian, report)?;
            stream.finish(|_| true)?;
            Ok(Some(header))
        }
    }
}

/// Version and byte order, from the header's size; from the dimensions where that is damaged.
fn version(start: &[u8], name: &str) -> Result<(bool, bool), LoadError> {
    let Some(raw) = start.get(..4).and_then(|b| <[u8; 4]>::try_from(b).ok()) else {
        return Err(LoadError::Truncated {
            name: name.to_owned(),
            expected: SIZE_1 as u64,
            found: start.len() as u64,
        });
    };
    let (le, be) = (i32::from_le_bytes(raw), i32::from_be_bytes(raw));
    for (value, big_endian) in [(le, false), (be, true)] {
        if value == SIZE_1 as i32 {
            return Ok((false, big_endian));
        }
        if value == SIZE_2 as i32 {
            return Ok((true, big_endian));
        }
    }
    Err(LoadError::Header {
        name: name.to_owned(),
        field: "sizeof_hdr",
        offset: 0,
        expected: "348 or 540".to_owned(),
        found: le.to_string(),
    })
}

fn understand(
    fields: &Fields<'_>,
    name: &str,
    format: Format,
    options: &ReadOptions,
    report: &mut LoadReport,
) -> Result<Header, LoadError> {
    let wrong = |field, offset, expected: &str, found: String| LoadError::Header {
        name: name.to_owned(),
        field,
        offset,
        expected: expected.to_owned(),
        found,
    };
    let rank = fields.dim(0);
    if !(1..=7).contains(&rank) {
        return Err(wrong(
            "dim[0]",
            fields.at(40, 16),
            "1 to 7",
            rank.to_string(),
        ));
    }
    let mut dims = [1u64; 3];
    let mut frame_count = 1u64;
    for axis in 1..=rank as usize {
        let n = fields.dim(axis);
        if n < 1 && axis > 3 {
            // Written as 0 by some for an axis that is not there.
            continue;
        }
        if n < 1 {
            let (one, two) = (40 + 2 * axis as u64, 16 + 8 * axis as u64);
            return Err(wrong(
                "dim",
                fields.at(one, two),
                "at least 1",
                n.to_string(),
            ));
        }
        match axis {
            1..=3 => dims[axis - 1] = n.unsigned_abs(),
            _ => frame_count = frame_count.saturating_mul(n.unsigned_abs()),
        }
    }
    let dims = checked_dims(name, dims, options)?;
    let (element, type_name, components) = element_type(fields, name)?;
    if components > 1 {
        report.warn(Warning::Luminance);
    }
    if matches!(element, ElementType::C64 | ElementType::C128) {
        report.warn(Warning::Magnitude);
    }
    let layout = Layout {
        element,
        big_endian: fields.big_endian,
        dims,
        components,
        component: 0,
        is_color: components > 1,
    };
    report.stored_type = type_name;
    report.dims = dims;
    report.frame_count = frame_count;
    report.is_labels = format != Format::Analyze && fields.whole(68, (504, 32)) == INTENT_LABEL;
    let intent = fields.whole(68, (504, 32));
    report.is_vectors =
        intent == INTENT_DISPLACEMENT || (fields.dim(4) <= 1 && fields.dim(5) == 3 && rank >= 5);
    // ITK turns vectors of this intent alone.
    report.vector_signs = match intent {
        INTENT_DISPLACEMENT => [1, 1, 1],
        _ => [-1, -1, 1],
    };
    if options.frame >= frame_count {
        return Err(LoadError::NoSuchFrame {
            name: name.to_owned(),
            asked: options.frame,
            count: frame_count,
        });
    }
    if frame_count > 1 {
        report.warn(Warning::Frames {
            count: frame_count,
            shown: options.frame,
        });
    }
    let vox_offset = vox_offset(fields, name)?;
    let (slope, intercept) = scale(fields, format, element, report);
    let world_from_voxel = orientation(fields, format, dims, report);
    Ok(Header {
        volume: geometry::header(
            name,
            &layout,
            world_from_voxel,
            slope,
            intercept,
            report.tells_size(),
        )?,
        layout,
        frame_bytes: layout.byte_count().unwrap_or(u64::MAX),
        vox_offset,
    })
}

/// The type of a number, its name, and how many of them a voxel has.
fn element_type(
    fields: &Fields<'_>,
    name: &str,
) -> Result<(ElementType, &'static str, u32), LoadError> {
    let code = fields.whole(70, (12, 16));
    let refused = |what: &str| {
        Err(LoadError::Unsupported {
            name: name.to_owned(),
            what: what.to_owned(),
        })
    };
    let (element, name) = match code {
        2 => (ElementType::U8, "uint8"),
        4 => (ElementType::I16, "int16"),
        8 => (ElementType::I32, "int32"),
        16 => (ElementType::F32, "float32"),
        32 => (ElementType::C64, "complex64"),
        64 => (ElementType::F64, "float64"),
        256 => (ElementType::I8, "int8"),
        512 => (ElementType::U16, "uint16"),
        768 => (ElementType::U32, "uint32"),
        1024 => (ElementType::I64, "int64"),
        1280 => (ElementType::U64, "uint64"),
        1792 => (ElementType::C128, "complex128"),
        1 => return refused("voxels of one bit are not read: save them as 8-bit numbers"),
        128 => return Ok((ElementType::U8, "RGB24", 3)),
        2304 => return Ok((ElementType::U8, "RGBA32", 4)),
        1536 | 2048 => return refused("128-bit floats are not read: save them as 32-bit floats"),
        other => {
            return Err(LoadError::Header {
                name: name.to_owned(),
                field: "datatype",
                offset: fields.at(70, 12),
                expected: "a NIfTI data type".to_owned(),
                found: other.to_string(),
            });
        }
    };
    Ok((element, name, 1))
}

fn vox_offset(fields: &Fields<'_>, name: &str) -> Result<u64, LoadError> {
    let found = if fields.is_two {
        i64::from_le_bytes(fields.raw(168)) as f64
    } else {
        fields.float(108, 168)
    };
    // Beyond 2⁵³ a float names no byte.
    if (0.0..9.0e15).contains(&found) {
        return Ok(found as u64);
    }
    Err(LoadError::Header {
        name: name.to_owned(),
        field: "vox_offset",
        offset: fields.at(108, 168),
        expected: "a byte number".to_owned(),
        found: found.to_string(),
    })
}

fn scale(
    fields: &Fields<'_>,
    format: Format,
    element: ElementType,
    report: &mut LoadReport,
) -> (f32, f32) {
    const NONE: (f32, f32) = (1.0, 0.0);
    if format == Format::Analyze {
        return NONE;
    }
    let slope = fields.float(112, 176) as f32;
    let intercept = fields.float(116, 184) as f32;
    if slope == 0.0 {
        if intercept != 0.0 {
            report.warn(Warning::SlopeZero);
        }
        return NONE;
    }
    if element.can_be_scaled(slope, intercept) {
        return (slope, intercept);
    }
    report.warn(Warning::BadScale { slope, intercept });
    NONE
}

fn orientation(
    fields: &Fields<'_>,
    format: Format,
    dims: UVec3,
    report: &mut LoadReport,
) -> DAffine3 {
    let unit_code = if fields.is_two {
        i32::from_le_bytes(fields.raw(500)) & 7
    } else {
        i32::from(fields.raw::<1>(123)[0]) & 7
    };
    let mm_per_unit = match (format, unit_code) {
        (Format::Analyze, _) => 1.0,
        (_, 1) => 1000.0,
        (_, 3) => 0.001,
        _ => 1.0,
    };
    let to_mm = |affine: DAffine3| DAffine3 {
        matrix3: affine.matrix3 * mm_per_unit,
        translation: affine.translation * mm_per_unit,
    };
    let mut spacing = DVec3::ONE;
    let mut bad = Vec::new();
    for axis in 0..3 {
        let found = fields.pixdim(axis + 1);
        let size = found.abs() * mm_per_unit;
        if size.is_finite() && size > 0.0 && (found > 0.0 || format == Format::Analyze) {
            spacing[axis] = size;
        } else if size.is_finite() && size > 0.0 {
            spacing[axis] = size;
            bad.push((axis, found));
        } else if dims[axis] > 1 || found != 0.0 {
            bad.push((axis, found));
        }
    }
    if !geometry::is_usable(&geometry::unoriented(spacing)) {
        bad = (0..3).map(|axis| (axis, fields.pixdim(axis + 1))).collect();
        spacing = DVec3::ONE;
    }
    let warn_spacing = |report: &mut LoadReport| {
        for &(axis, found) in &bad {
            report.warn(Warning::BadSpacing {
                axis,
                found: found as f32,
                instead: spacing[axis] as f32,
            });
        }
    };
    if format != Format::Analyze {
        let sform_code = fields.whole(254, (348, 32));
        let qform_code = fields.whole(252, (344, 32));
        if sform_code > 0 {
            let affine = to_mm(sform(fields));
            if geometry::is_usable(&affine) {
                return affine;
            }
            report.warn(Warning::BadOrientation {
                field: "sform",
                instead: if qform_code > 0 {
                    "qform"
                } else {
                    "the voxel size"
                },
            });
        }
        if qform_code > 0 {
            warn_spacing(report);
            let mut affine = qform(fields, spacing);
            affine.translation *= mm_per_unit;
            if geometry::is_usable(&affine) {
                return affine;
            }
            report.warn(Warning::BadOrientation {
                field: "qform",
                instead: "the voxel size",
            });
            return geometry::unoriented(spacing);
        }
    }
    warn_spacing(report);
    report.warn(Warning::NoOrientation);
    geometry::unoriented(spacing)
}

/// Method 3: three rows of four.
fn sform(fields: &Fields<'_>) -> DAffine3 {
    let row = |i: usize| {
        let at = |j: usize| fields.float(280 + 16 * i + 4 * j, 400 + 32 * i + 8 * j);
        ([at(0), at(1), at(2)], at(3))
    };
    let rows = [row(0), row(1), row(2)];
    let column = |j: usize| DVec3::new(rows[0].0[j], rows[1].0[j], rows[2].0[j]);
    DAffine3::from_mat3_translation(
        DMat3::from_cols(column(0), column(1), column(2)),
        DVec3::new(rows[0].1, rows[1].1, rows[2].1),
    )
}

/// Method 2: a rotation as three quaternion components, voxel sizes, and the handedness in `pixdim[0]`.
fn qform(fields: &Fields<'_>, spacing_mm: DVec3) -> DAffine3 {
    let at = |i: usize| fields.float(256 + 4 * i, 352 + 8 * i);
    let (mut b, mut c, mut d) = (at(0), at(1), at(2));
    let square = b * b + c * c + d * d;
    // As the reference implementation: rounded past a half turn, it is one.
    let a = if square >= 1.0 - 1e-7 {
        let length = square.sqrt();
        (b, c, d) = (b / length, c / length, d / length);
        0.0
    } else {
        (1.0 - square).sqrt()
    };
    let rotation = DMat3::from_cols(
        DVec3::new(
            a * a + b * b - c * c - d * d,
            2.0 * (b * c + a * d),
            2.0 * (b * d - a * c),
        ),
        DVec3::new(
            2.0 * (b * c - a * d),
            a * a + c * c - b * b - d * d,
            2.0 * (c * d + a * b),
        ),
        DVec3::new(
            2.0 * (b * d + a * c),
            2.0 * (c * d - a * b),
            a * a + d * d - b * b - c * c,
        ),
    );
    let handedness = if fields.pixdim(0) < 0.0 { -1.0 } else { 1.0 };
    let offset = |i: usize| fields.float(268 + 4 * i, 376 + 8 * i);
    DAffine3::from_mat3_translation(
        rotation * DMat3::from_diagonal(spacing_mm * DVec3::new(1.0, 1.0, handedness)),
        DVec3::new(offset(0), offset(1), offset(2)),
    )
}

/// Looks through the header extensions for label names. The stream stands behind the header before, and at the voxels
/// or before them afterwards.
fn read_extensions(
    stream: &mut Stream<'_>,
    vox_offset: u64,
    big_endian: bool,
    report: &mut LoadReport,
) -> Result<(), LoadError> {
    let room = vox_offset.saturating_sub(stream.position());
    if room < 4 || stream.peek(4)?.first().is_none_or(|&flag| flag == 0) {
        return Ok(());
    }
    stream.skip(4, |_| true)?;
    while vox_offset.saturating_sub(stream.position()) >= 8 {
        let frame = stream.peek(8)?;
        let (Some(size), true) = (frame.first_chunk::<4>(), frame.len() == 8) else {
            return Ok(());
        };
        let size = if big_endian {
            i32::from_be_bytes(*size)
        } else {
            i32::from_le_bytes(*size)
        };
        let size = u64::from(size.max(0).unsigned_abs());
        if size < 8 || size > vox_offset.saturating_sub(stream.position()) {
            return Ok(());
        }
        stream.skip(8, |_| true)?;
        if size - 8 > MAX_EXTENSION_BYTES {
            stream.skip(size - 8, |_| true)?;
            continue;
        }
        let mut text = Vec::new();
        let mut left = (size - 8) as usize;
        while left > 0 {
            let mut part = vec![0; left.min(64 * 1024)];
            let got = stream.fill(&mut part)?;
            text.extend_from_slice(&part[..got]);
            if got < part.len() {
                return Ok(());
            }
            left -= got;
        }
        let text = String::from_utf8_lossy(&text);
        if text.contains("<Label") {
            let names = label_names(&text);
            if names.is_empty() {
                report.warn(Warning::LabelNames);
            }
            for segment in names {
                if report
                    .segments
                    .iter()
                    .all(|known| known.label != segment.label)
                {
                    report.segments.push(segment);
                }
            }
        }
    }
    Ok(())
}

/// Labels of a CaretNIfTI extension: `<Label Key="5" Red="0.1" …><![CDATA[liver]]></Label>`.
fn label_names(xml: &str) -> Vec<Segment> {
    let attribute = |tag: &str, key: &str| {
        let start = tag.find(&format!("{key}=\""))? + key.len() + 2;
        let end = start + tag[start..].find('"')?;
        Some(tag[start..end].to_owned())
    };
    let mut segments = Vec::new();
    for part in xml.split("<Label ").skip(1).take(usize::from(u16::MAX)) {
        let Some((tag, rest)) = part.split_once('>') else {
            continue;
        };
        let text = rest.split("</Label").next().unwrap_or_default();
        let name = text
            .trim()
            .trim_start_matches("<![CDATA[")
            .trim_end_matches("]]>");
        let name = super::report::clean_name(name);
        let Some(label) = attribute(tag, "Key").and_then(|key| key.parse::<u16>().ok()) else {
            continue;
        };
        if label == 0 || name.is_empty() {
            continue;
        }
        let channel = |key| {
            attribute(tag, key)
                .and_then(|text| text.parse::<f32>().ok())
                .map(|x| (x.clamp(0.0, 1.0) * 255.0).round() as u8)
        };
        segments.push(Segment {
            label,
            name,
            color_srgb: match (channel("Red"), channel("Green"), channel("Blue")) {
                (Some(r), Some(g), Some(b)) => Some([r, g, b]),
                _ => None,
            },
        });
    }
    segments.sort_by_key(|segment| segment.label);
    segments
}

/// Reads the voxels of the frame that is wanted, from a stream that stands at or before them, and the file to its end.
pub(crate) fn read_voxels(
    stream: &mut Stream<'_>,
    header: &Header,
    options: &ReadOptions,
    sink: &mut dyn SubjectSink,
    report: &mut LoadReport,
) -> Result<(), LoadError> {
    let name = stream.name().to_owned();
    let expected = header
        .frame_bytes
        .checked_mul(options.frame.saturating_add(1))
        .and_then(|bytes| bytes.checked_add(header.vox_offset))
        .unwrap_or(u64::MAX);
    // A header that promises more than the file can hold is unmasked before anybody asks for memory.
    let possible = stream
        .bytes_left_at_most()
        .map(|left| left.saturating_add(stream.position()));
    if let Some(found) = possible.filter(|&possible| possible < expected) {
        return Err(LoadError::Truncated {
            name,
            expected,
            found,
        });
    }
    sink.take(SubjectPart::header(header.volume.clone()))
        .map_err(LoadError::refused(&name))?;
    let skip = (expected - header.frame_bytes).saturating_sub(stream.position());
    let skipped = stream.skip(skip, |stream| {
        let fraction = stream.fraction().unwrap_or(0.0);
        sink.progress(fraction)
    })?;
    if skipped < skip {
        return Err(LoadError::Truncated {
            name,
            expected,
            found: stream.position(),
        });
    }
    stream_voxels(stream, &header.layout, &header.volume, sink, report)?;
    let has_more = stream.finish(|stream| {
        let fraction = stream.fraction().unwrap_or(1.0);
        sink.progress(fraction)
    })?;
    let is_last = options.frame + 1 == report.frame_count;
    if has_more && is_last {
        report.warn(Warning::TrailingBytes);
    }
    debug_assert!(
        matches!(stream.packing(), Packing::Plain | Packing::Gzip),
        "NIfTI knows gzip only"
    );
    Ok(())
}
