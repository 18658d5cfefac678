//! MetaImage (itk.org/Wiki/MetaIO): a text header, the voxels behind it (.mha) or in other files (.mhd).
//!
//! Directions are the axes one after the other, in LPS as ITK has it.

use glam::{DAffine3, DMat3, DVec3};

use super::files::pattern_files;
use super::geometry::{self, checked_dims};
use super::header::Fields;
use super::place::{Encoding, Header, Place, Skip};
use super::stream::Stream;
use super::voxels::{ElementType, Layout};
use super::{Format, LoadError, LoadReport, ReadOptions, Warning};

const MAX_LINE_BYTES: usize = 1 << 16;
const MAX_LINES: usize = 100_000;
/// From ITK's world, left, posterior, superior, to ours.
const RAS_FROM_LPS: DVec3 = DVec3::new(-1.0, -1.0, 1.0);

/// True if the bytes begin as a MetaImage header does: with one of its keys.
pub(crate) fn is_header(start: &[u8]) -> bool {
    let line = start
        .split(|&byte| byte == b'\n')
        .next()
        .unwrap_or_default();
    let Some((key, _)) = std::str::from_utf8(line)
        .ok()
        .and_then(|line| line.split_once('='))
    else {
        return false;
    };
    [
        "ObjectType",
        "NDims",
        "Comment",
        "ObjectSubType",
        "TransformType",
        "Name",
        "ID",
        "DimSize",
    ]
    .contains(&key.trim())
}

impl Fields {
    fn read_metaimage(stream: &mut Stream<'_>) -> Result<Self, LoadError> {
        let mut header = Self::new(stream);
        for number in 1..=MAX_LINES {
            let Some(line) = stream.line(MAX_LINE_BYTES)? else {
                break;
            };
            let line = String::from_utf8_lossy(&line).into_owned();
            if line.trim().is_empty() {
                continue;
            }
            let Some((key, value)) = line.split_once('=') else {
                let found = line.escape_debug().take(40).collect();
                return Err(header.wrong_line(number, "line", "\"Key = value\"", found));
            };
            let (key, value) = (key.trim().to_lowercase(), value.trim().to_owned());
            let is_last = key == "elementdatafile";
            let is_list = is_last && value.to_uppercase().starts_with("LIST");
            header.fields.insert(key, (number, value));
            if is_list {
                while header.list.len() < MAX_LINES {
                    let Some(line) = stream.line(MAX_LINE_BYTES)? else {
                        break;
                    };
                    let line = String::from_utf8_lossy(&line).trim().to_owned();
                    if !line.is_empty() {
                        header.list.push(line);
                    }
                }
            }
            if is_last {
                return Ok(header);
            }
        }
        Err(header.wrong("elementdatafile", "the voxels' file or LOCAL"))
    }

    fn is_true(&self, field: &str) -> bool {
        self.get(field).is_some_and(|text| {
            matches!(
                text.to_lowercase().as_str(),
                "true" | "t" | "1" | "yes" | "y"
            )
        })
    }

    /// Numbers, at least `n` of them; more are left out (headers of flat pictures often have three spacings).
    fn numbers(&self, field: &str, n: usize) -> Result<Option<Vec<f64>>, LoadError> {
        let Some(text) = self.get(field) else {
            return Ok(None);
        };
        let numbers: Result<Vec<f64>, _> =
            text.split_whitespace().take(n).map(str::parse).collect();
        match numbers {
            Ok(numbers) if numbers.len() == n => Ok(Some(numbers)),
            _ => Err(self.wrong(field, "a number for each dimension")),
        }
    }
}

/// Reads the header; the stream stands at the voxels afterwards, if they are attached.
pub(crate) fn read_header(
    stream: &mut Stream<'_>,
    options: &ReadOptions,
    report: &mut LoadReport,
) -> Result<Header, LoadError> {
    report.format = Some(Format::MetaImage);
    let fields = Fields::read_metaimage(stream)?;
    let name = fields.name.clone();
    let refuse = |what: &str| LoadError::Unsupported {
        name: name.clone(),
        what: what.to_owned(),
    };
    if let Some(object) = fields.get("objecttype")
        && !object.eq_ignore_ascii_case("image")
    {
        return Err(refuse("a MetaIO file that holds no image"));
    }
    let rank: usize = fields
        .get("ndims")
        .and_then(|text| text.parse().ok())
        .filter(|rank| (1..=10).contains(rank))
        .ok_or_else(|| fields.wrong("ndims", "1 to 10"))?;
    let sizes: Option<Vec<u64>> = fields.get("dimsize").map(|text| {
        text.split_whitespace()
            .filter_map(|n| n.parse().ok())
            .filter(|&n| n > 0)
            .collect()
    });
    let sizes = sizes
        .filter(|sizes| sizes.len() == rank)
        .ok_or_else(|| fields.wrong("dimsize", "a size above 0 for each dimension"))?;
    let at = |i: usize| sizes.get(i).copied().unwrap_or(1);
    let dims = checked_dims(&name, [at(0), at(1), at(2)], options)?;
    let frames = sizes
        .iter()
        .skip(3)
        .fold(1u64, |n, &size| n.saturating_mul(size));
    let (element, stored_type) = element_type(&fields)?;
    let components = match fields.get("elementnumberofchannels") {
        None => 1,
        Some(text) => text
            .parse::<u32>()
            .ok()
            .filter(|n| (1..=4096).contains(n))
            .ok_or_else(|| fields.wrong("elementnumberofchannels", "1 or more"))?,
    };
    // Bytes by threes or fours are colours; ITK writes them so, and has no other mark.
    let is_color = matches!(components, 3 | 4) && element == ElementType::U8;
    let frame_components = if is_color {
        report.warn(Warning::Luminance);
        1
    } else {
        components
    };
    let count = frames.saturating_mul(u64::from(frame_components));
    if options.frame >= count {
        return Err(LoadError::NoSuchFrame {
            name,
            asked: options.frame,
            count,
        });
    }
    if count > 1 {
        report.warn(Warning::Frames {
            count,
            shown: options.frame,
        });
    }
    let layout = Layout {
        element,
        big_endian: fields.is_true("binarydatabyteordermsb")
            || fields.is_true("elementbyteordermsb"),
        dims,
        components,
        component: (options.frame % u64::from(frame_components)) as u32,
        is_color,
    };
    report.stored_type = stored_type;
    report.dims = dims;
    report.frame_count = count;
    report.vector_signs = [-1, -1, 1];
    let is_ascii = fields.get("binarydata").is_some() && !fields.is_true("binarydata");
    let encoding = match (fields.is_true("compresseddata"), is_ascii) {
        (true, _) => Encoding::Zlib,
        (false, true) => Encoding::Ascii,
        (false, false) => Encoding::Raw,
    };
    let skip = match fields.get("headersize").map(str::parse::<i64>) {
        None => Skip::Bytes(0),
        Some(Ok(-1)) => Skip::AllButLast,
        Some(Ok(n)) if n >= 0 => Skip::Bytes(n.unsigned_abs()),
        Some(_) => return Err(fields.wrong("headersize", "-1 or more")),
    };
    let world_from_voxel = world_from_voxel(&fields, rank, report)?;
    let files = data_files(&fields)?;
    let number = |key: &str| fields.get(key).and_then(|text| text.parse::<f32>().ok());
    let (mut slope, mut intercept) = (
        number("elementtointensityfunctionslope").unwrap_or(1.0),
        number("elementtointensityfunctionoffset").unwrap_or(0.0),
    );
    if !element.can_be_scaled(slope, intercept) {
        report.warn(Warning::BadScale { slope, intercept });
        (slope, intercept) = (1.0, 0.0);
    }
    Ok(Header {
        volume: geometry::header(
            &name,
            &layout,
            world_from_voxel,
            slope,
            intercept,
            report.tells_size(),
        )?,
        place: Place {
            layout,
            encoding,
            line_skip: 0,
            skip,
            frame_count: frames,
            frame: options.frame / u64::from(frame_components),
            is_exact: files.is_some(),
        },
        files,
    })
}

fn element_type(fields: &Fields) -> Result<(ElementType, &'static str), LoadError> {
    let text = fields.get("elementtype").unwrap_or_default().to_uppercase();
    Ok(match text.as_str() {
        "MET_UCHAR" => (ElementType::U8, "uint8"),
        "MET_CHAR" => (ElementType::I8, "int8"),
        "MET_USHORT" => (ElementType::U16, "uint16"),
        "MET_SHORT" => (ElementType::I16, "int16"),
        "MET_UINT" | "MET_ULONG" => (ElementType::U32, "uint32"),
        "MET_INT" | "MET_LONG" => (ElementType::I32, "int32"),
        "MET_ULONG_LONG" => (ElementType::U64, "uint64"),
        "MET_LONG_LONG" => (ElementType::I64, "int64"),
        "MET_FLOAT" => (ElementType::F32, "float32"),
        "MET_DOUBLE" => (ElementType::F64, "float64"),
        _ => return Err(fields.wrong("elementtype", "a scalar type like MET_SHORT")),
    })
}

fn world_from_voxel(
    fields: &Fields,
    rank: usize,
    report: &mut LoadReport,
) -> Result<DAffine3, LoadError> {
    let n = rank.min(3);
    let mut spacing = DVec3::ONE;
    let sizes = match fields.numbers("elementspacing", n)? {
        Some(sizes) => Some(sizes),
        None => fields.numbers("elementsize", n)?,
    };
    report.lacks_spacing = sizes.is_none();
    for (axis, found) in sizes.unwrap_or_default().into_iter().enumerate() {
        if found.is_finite() && found != 0.0 {
            spacing[axis] = found.abs();
        } else {
            report.warn(Warning::BadSpacing {
                axis,
                found: found as f32,
                instead: 1.0,
            });
        }
    }
    let key = |names: &[&'static str]| {
        names
            .iter()
            .copied()
            .find(|name| fields.get(name).is_some())
    };
    let mut origin = DVec3::ZERO;
    if let Some(key) = key(&["offset", "position", "origin"]) {
        for (i, x) in fields
            .numbers(key, n)?
            .unwrap_or_default()
            .into_iter()
            .enumerate()
        {
            origin[i] = if x.is_finite() { x } else { 0.0 };
        }
    }
    let matrix_key = key(&["transformmatrix", "rotation", "orientation"]);
    let mut directions = DMat3::IDENTITY;
    let mut is_oriented = matrix_key.is_some();
    if let Some(key) = matrix_key {
        let numbers = fields.numbers(key, rank * rank)?.unwrap_or_default();
        let at = |axis: usize, i: usize| {
            if axis < n && i < n {
                numbers.get(axis * rank + i).copied().unwrap_or(0.0)
            } else if axis == i {
                1.0
            } else {
                0.0
            }
        };
        let column = |axis: usize| DVec3::new(at(axis, 0), at(axis, 1), at(axis, 2));
        directions = DMat3::from_cols(column(0), column(1), column(2));
    } else if let Some(code) = fields
        .get("anatomicalorientation")
        .and_then(directions_of_code)
    {
        directions = code;
        is_oriented = true;
    }
    let matrix = DMat3::from_diagonal(RAS_FROM_LPS) * directions * DMat3::from_diagonal(spacing);
    let affine = DAffine3::from_mat3_translation(matrix, RAS_FROM_LPS * origin);
    if geometry::is_usable(&affine) {
        // Flat pictures have no room for a direction in the patient.
        if !is_oriented || n < 3 {
            report.warn(Warning::NoOrientation);
        }
        return Ok(affine);
    }
    let upright = geometry::unoriented(spacing * RAS_FROM_LPS);
    report.warn(Warning::BadOrientation {
        field: "TransformMatrix",
        instead: "the voxel size",
    });
    if geometry::is_usable(&upright) {
        return Ok(upright);
    }
    report.warn(Warning::BadSpacing {
        axis: 0,
        found: spacing.x as f32,
        instead: 1.0,
    });
    Ok(geometry::unoriented(RAS_FROM_LPS))
}

/// Directions in LPS of a code like RAI, whose letters name where each index begins.
fn directions_of_code(code: &str) -> Option<DMat3> {
    let column = |letter: char| {
        Some(match letter.to_ascii_uppercase() {
            'R' => DVec3::X,
            'L' => DVec3::NEG_X,
            'A' => DVec3::Y,
            'P' => DVec3::NEG_Y,
            'I' => DVec3::Z,
            'S' => DVec3::NEG_Z,
            _ => return None,
        })
    };
    let columns: Option<Vec<DVec3>> = code.trim().chars().map(column).collect();
    let [x, y, z] = <[DVec3; 3]>::try_from(columns?).ok()?;
    let matrix = DMat3::from_cols(x, y, z);
    (matrix.determinant() != 0.0).then_some(matrix)
}

/// Names of the voxels' files: one, a list below the header, or a pattern with numbers.
fn data_files(fields: &Fields) -> Result<Option<Vec<String>>, LoadError> {
    let text = fields.get("elementdatafile").unwrap_or_default();
    if text.eq_ignore_ascii_case("LOCAL") {
        return Ok(None);
    }
    if text.to_uppercase().starts_with("LIST") {
        return Ok(Some(fields.list.clone()));
    }
    if let [pattern, first, last, step] = text.split_whitespace().collect::<Vec<_>>()[..]
        && pattern.contains('%')
    {
        let numbers = (first.parse(), last.parse(), step.parse());
        if let (Ok(first), Ok(last), Ok(step)) = numbers
            && let Some(names) = pattern_files(pattern, first, last, step)
        {
            return Ok(Some(names));
        }
        return Err(fields.wrong("elementdatafile", "a name with %d, first, last and step"));
    }
    Ok(Some(vec![text.to_owned()]))
}
