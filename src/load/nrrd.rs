//! NRRD (Kindlmann 2002; teem.sourceforge.net/nrrd/format.html), with the header attached or apart, in every encoding.
//!
//! Axes that are in space make the volume, at most three of them. What runs faster than they do are components of a
//! voxel, what runs slower are frames; of both one is taken. Space is turned into RAS+ mm.

use glam::{DAffine3, DMat3, DVec3};

use super::files::pattern_files;
use super::geometry::{self, checked_dims};
use super::header::Fields;
use super::place::{Encoding, Header, Place, Skip};
use super::report::clean_name;
use super::stream::Stream;
use super::voxels::{ElementType, Layout};
use super::{Format, LoadError, LoadReport, ReadOptions, Warning};
use crate::data::Segment;

/// Longest header line; 3D Slicer writes long ones.
const MAX_LINE_BYTES: usize = 1 << 20;
/// Lines and bytes of a header in all.
const MAX_LINES: usize = 100_000;
const MAX_HEADER_BYTES: usize = 16 << 20;
/// Axes that an NRRD may have, by its definition.
const MAX_AXES: usize = 16;

/// True if the bytes begin as a NRRD header does.
pub(crate) fn is_header(start: &[u8]) -> bool {
    start.starts_with(b"NRRD")
}

impl Fields {
    fn read_nrrd(stream: &mut Stream<'_>) -> Result<Self, LoadError> {
        let mut header = Self::new(stream);
        let mut is_list = false;
        for number in 1..=MAX_LINES {
            let Some(line) = stream.line(MAX_LINE_BYTES)? else {
                return Ok(header);
            };
            if stream.position() > MAX_HEADER_BYTES as u64 {
                break;
            }
            let line = String::from_utf8_lossy(&line).trim_end().to_owned();
            if is_list {
                if !line.is_empty() {
                    header.list.push(line);
                }
                continue;
            }
            if number == 1 || line.starts_with('#') {
                continue;
            }
            if line.is_empty() {
                return Ok(header);
            }
            if let Some((key, value)) = line.split_once(":=") {
                header.pairs.insert(key.to_owned(), value.to_owned());
            } else if let Some((field, value)) = line.split_once(':') {
                let field: String = field
                    .chars()
                    .filter(|c| !c.is_whitespace())
                    .collect::<String>()
                    .to_lowercase();
                let value = value.trim().to_owned();
                is_list = field == "datafile" && value.split_whitespace().next() == Some("LIST");
                header.fields.insert(field, (number, value));
            } else {
                let found = line.chars().take(40).collect();
                return Err(header.wrong_line(number, "line", "\"field: value\"", found));
            }
        }
        Err(LoadError::Unsupported {
            name: header.name,
            what: "the header has no end".to_owned(),
        })
    }

    fn number<T: std::str::FromStr>(
        &self,
        field: &str,
        expected: &str,
    ) -> Result<Option<T>, LoadError> {
        self.get(field)
            .map(|text| text.parse().map_err(|_not_one| self.wrong(field, expected)))
            .transpose()
    }

    fn list<T: std::str::FromStr>(
        &self,
        field: &str,
        n: usize,
        expected: &str,
    ) -> Result<Option<Vec<T>>, LoadError> {
        let Some(text) = self.get(field) else {
            return Ok(None);
        };
        let items: Result<Vec<T>, _> = text.split_whitespace().map(str::parse).collect();
        match items {
            Ok(items) if items.len() == n => Ok(Some(items)),
            _ => Err(self.wrong(field, expected)),
        }
    }

    /// Vectors in brackets, `none` where an axis has no direction.
    fn vectors(&self, field: &str) -> Result<Option<Vec<Option<Vec<f64>>>>, LoadError> {
        let Some(text) = self.get(field) else {
            return Ok(None);
        };
        let expected = "vectors like (1,0,0), or none";
        let mut vectors = Vec::new();
        let mut rest = text.trim();
        while !rest.is_empty() && vectors.len() <= MAX_AXES {
            if let Some(after) = rest.strip_prefix('(') {
                let (inside, after) = after
                    .split_once(')')
                    .ok_or_else(|| self.wrong(field, expected))?;
                let numbers: Result<Vec<f64>, _> =
                    inside.split(',').map(|x| x.trim().parse()).collect();
                vectors.push(Some(
                    numbers.map_err(|_not_one| self.wrong(field, expected))?,
                ));
                rest = after.trim_start();
            } else if let Some(after) = rest.strip_prefix("none") {
                vectors.push(None);
                rest = after.trim_start();
            } else {
                return Err(self.wrong(field, expected));
            }
        }
        Ok(Some(vectors))
    }
}

/// Reads the header; the stream stands at the voxels afterwards, if they are attached.
pub(crate) fn read_header(
    stream: &mut Stream<'_>,
    options: &ReadOptions,
    report: &mut LoadReport,
) -> Result<Header, LoadError> {
    report.format = Some(Format::Nrrd);
    let fields = Fields::read_nrrd(stream)?;
    let name = fields.name.clone();
    let rank: usize = fields
        .number("dimension", "1 to 16")?
        .filter(|rank| (1..=MAX_AXES).contains(rank))
        .ok_or_else(|| fields.wrong("dimension", "1 to 16"))?;
    let sizes: Vec<u64> = fields
        .list("sizes", rank, "as many sizes as the dimension says")?
        .filter(|sizes: &Vec<u64>| sizes.iter().all(|&n| n > 0))
        .ok_or_else(|| fields.wrong("sizes", "as many sizes, above 0, as the dimension says"))?;
    let (element, stored_type) = element_type(&fields)?;
    let encoding = match fields
        .get("encoding")
        .unwrap_or_default()
        .to_lowercase()
        .as_str()
    {
        "raw" => Encoding::Raw,
        "txt" | "text" | "ascii" => Encoding::Ascii,
        "hex" => Encoding::Hex,
        "gz" | "gzip" => Encoding::Gzip,
        "bz2" | "bzip2" => Encoding::Bzip2,
        _ => return Err(fields.wrong("encoding", "raw, ascii, hex, gzip or bzip2")),
    };
    let big_endian = match fields.get("endian").map(str::to_lowercase).as_deref() {
        Some("big") => true,
        Some("little") => false,
        None => {
            if element.byte_count() > 1 && encoding != Encoding::Ascii {
                report.warn(Warning::Repaired {
                    field: "endian",
                    what: "missing; the low byte was taken to come first".to_owned(),
                });
            }
            false
        }
        Some(_) => return Err(fields.wrong("endian", "little or big")),
    };

    let axes = Axes::find(&fields, &sizes)?;
    let dims = checked_dims(&name, axes.dims(&sizes), options)?;
    let components = axes.product(&sizes, 0..axes.first());
    let frames = axes.product(&sizes, axes.last() + 1..rank);
    let components = u32::try_from(components)
        .ok()
        .filter(|&n| n <= 4096)
        .ok_or_else(|| LoadError::Unsupported {
            name: name.clone(),
            what: format!("{components} components per voxel are too many"),
        })?;
    let is_color = axes.is_color(&fields, components);
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
    let layout = Layout {
        element,
        big_endian,
        dims,
        components,
        component: (options.frame % u64::from(frame_components)) as u32,
        is_color,
    };
    report.is_vectors = (3..=4).contains(&components)
        && fields.get("kinds").is_some_and(|kinds| {
            let kind = kinds.split_whitespace().next().unwrap_or_default();
            kind.to_lowercase().ends_with("vector")
        });
    report.stored_type = stored_type;
    report.dims = dims;
    report.frame_count = count;
    let world_from_voxel = axes.world_from_voxel(&fields, rank, report)?;
    segments(&fields, count, report);
    if count > 1
        && !(report.is_labels
            && report
                .warnings
                .iter()
                .any(|w| matches!(w, Warning::Layers { .. })))
    {
        report.warn(Warning::Frames {
            count,
            shown: options.frame,
        });
    }

    let skip = match fields.number::<i64>("byteskip", "-1 or more")?.unwrap_or(0) {
        -1 => Skip::AllButLast,
        n if n >= 0 => Skip::Bytes(n.unsigned_abs()),
        _ => return Err(fields.wrong("byteskip", "-1 or more")),
    };
    let line_skip = fields.number::<u64>("lineskip", "0 or more")?.unwrap_or(0);
    let files = data_files(&fields)?;
    Ok(Header {
        volume: geometry::header(
            &name,
            &layout,
            world_from_voxel,
            1.0,
            0.0,
            report.tells_size(),
        )?,
        place: Place {
            layout,
            encoding,
            line_skip,
            skip,
            frame_count: frames,
            frame: options.frame / u64::from(frame_components),
            is_exact: files.is_some(),
        },
        files,
    })
}

fn element_type(fields: &Fields) -> Result<(ElementType, &'static str), LoadError> {
    let text = fields.get("type").unwrap_or_default().to_lowercase();
    let words = text.split_whitespace().collect::<Vec<_>>().join(" ");
    Ok(match words.as_str() {
        "signed char" | "int8" | "int8_t" => (ElementType::I8, "int8"),
        "uchar" | "unsigned char" | "uint8" | "uint8_t" => (ElementType::U8, "uint8"),
        "short" | "short int" | "signed short" | "signed short int" | "int16" | "int16_t" => {
            (ElementType::I16, "int16")
        }
        "ushort" | "unsigned short" | "unsigned short int" | "uint16" | "uint16_t" => {
            (ElementType::U16, "uint16")
        }
        "int" | "signed int" | "int32" | "int32_t" => (ElementType::I32, "int32"),
        "uint" | "unsigned int" | "uint32" | "uint32_t" => (ElementType::U32, "uint32"),
        "longlong"
        | "long long"
        | "long long int"
        | "signed long long"
        | "signed long long int"
        | "int64"
        | "int64_t" => (ElementType::I64, "int64"),
        "ulonglong" | "unsigned long long" | "unsigned long long int" | "uint64" | "uint64_t" => {
            (ElementType::U64, "uint64")
        }
        "float" => (ElementType::F32, "float32"),
        "double" => (ElementType::F64, "float64"),
        "block" => {
            return Err(LoadError::Unsupported {
                name: fields.name.clone(),
                what: "voxels that are blocks of bytes cannot be drawn".to_owned(),
            });
        }
        _ => return Err(fields.wrong("type", "a NRRD scalar type")),
    })
}

/// Which axes are in space.
struct Axes {
    spatial: Vec<usize>,
    /// Directions of the spatial axes, where the header gives them, in its own space.
    directions: Option<Vec<DVec3>>,
}

impl Axes {
    fn find(fields: &Fields, sizes: &[u64]) -> Result<Self, LoadError> {
        let rank = sizes.len();
        let refuse = |what: String| LoadError::Unsupported {
            name: fields.name.clone(),
            what,
        };
        let kinds: Vec<String> = fields
            .get("kinds")
            .map(|text| text.split_whitespace().map(str::to_lowercase).collect())
            .unwrap_or_default();
        let vectors = fields.vectors("spacedirections")?;
        if vectors
            .as_ref()
            .is_some_and(|vectors| vectors.len() != rank)
        {
            return Err(fields.wrong("spacedirections", "a vector or none for each axis"));
        }
        let spacings = per_axis(fields, "spacings", rank);
        let is_spatial = |axis: usize| -> bool {
            if let Some(vectors) = &vectors {
                return vectors.get(axis).is_some_and(Option::is_some);
            }
            match kinds.get(axis).map(String::as_str) {
                Some("domain" | "space") => true,
                Some("???" | "none") | None => {
                    spacings.get(axis).is_none_or(|x| !x.is_nan() || rank <= 3)
                }
                Some(_) => false,
            }
        };
        let mut spatial: Vec<usize> = (0..rank).filter(|&axis| is_spatial(axis)).collect();
        if spatial.is_empty() {
            return Err(refuse("none of its axes is in space".to_owned()));
        }
        // Of more than three, the first three are space and the rest are frames.
        spatial.truncate(3);
        if spatial.windows(2).any(|pair| pair[1] != pair[0] + 1) {
            return Err(refuse(
                "an axis that is not in space lies between those that are: reorder the axes"
                    .to_owned(),
            ));
        }
        let directions = match &vectors {
            None => None,
            Some(vectors) => {
                let mut directions = Vec::new();
                for vector in spatial
                    .iter()
                    .filter_map(|&axis| vectors.get(axis).and_then(Option::as_ref))
                {
                    let at = |i: usize| vector.get(i).copied().unwrap_or(0.0);
                    if vector.len() > 3 && vector[3..].iter().any(|&x| x != 0.0) {
                        return Err(fields.wrong("spacedirections", "vectors of three numbers"));
                    }
                    directions.push(DVec3::new(at(0), at(1), at(2)));
                }
                Some(directions)
            }
        };
        Ok(Self {
            spatial,
            directions,
        })
    }

    /// True if the one axis before those in space holds red, green and blue, with or without opacity.
    fn is_color(&self, fields: &Fields, components: u32) -> bool {
        let kind = fields
            .get("kinds")
            .and_then(|text| text.split_whitespace().next())
            .unwrap_or_default()
            .to_lowercase();
        self.first() == 1
            && match kind.as_str() {
                "rgb-color" | "3-color" => components == 3,
                "rgba-color" | "4-color" => components == 4,
                _ => false,
            }
    }

    fn first(&self) -> usize {
        self.spatial.first().copied().unwrap_or(0)
    }

    fn last(&self) -> usize {
        self.spatial.last().copied().unwrap_or(0)
    }

    fn dims(&self, sizes: &[u64]) -> [u64; 3] {
        let mut dims = [1; 3];
        for (dim, &axis) in dims.iter_mut().zip(&self.spatial) {
            *dim = sizes[axis];
        }
        dims
    }

    fn product(&self, sizes: &[u64], axes: std::ops::Range<usize>) -> u64 {
        sizes[axes]
            .iter()
            .fold(1, |n: u64, &size| n.saturating_mul(size))
    }

    fn world_from_voxel(
        &self,
        fields: &Fields,
        rank: usize,
        report: &mut LoadReport,
    ) -> Result<DAffine3, LoadError> {
        let space = fields
            .get("space")
            .map(|text| text.to_lowercase().replace(' ', "-"));
        let space = space
            .as_deref()
            .map(|space| space.strip_suffix("-time").unwrap_or(space));
        // What takes the header's space to RAS+; `false` where it does not say how the patient lies.
        let (sign, is_oriented) = match space {
            Some("right-anterior-superior" | "ras" | "rast") => (DVec3::ONE, true),
            Some("left-anterior-superior" | "las" | "last") => (DVec3::new(-1.0, 1.0, 1.0), true),
            Some("left-posterior-superior" | "lps" | "lpst") => (DVec3::new(-1.0, -1.0, 1.0), true),
            // Mirrored, so that the picture is not.
            Some("3d-left-handed") => (DVec3::new(-1.0, 1.0, 1.0), false),
            _ => (DVec3::ONE, false),
        };
        report.vector_signs = sign.to_array().map(|x| x as i8);
        let mm = unit_mm(fields);
        if let Some(directions) = &self.directions {
            let mut columns = directions.clone();
            complete(&mut columns);
            let origin = match fields.vectors("spaceorigin")?.as_deref() {
                Some([Some(origin)]) => {
                    let at = |i: usize| origin.get(i).copied().unwrap_or(0.0);
                    DVec3::new(at(0), at(1), at(2))
                }
                None => DVec3::ZERO,
                Some(_) => return Err(fields.wrong("spaceorigin", "one vector")),
            };
            let matrix = DMat3::from_cols(
                columns[0] * sign * mm,
                columns[1] * sign * mm,
                columns[2] * sign * mm,
            );
            let origin = if origin.is_finite() {
                origin
            } else {
                DVec3::ZERO
            };
            let affine = DAffine3::from_mat3_translation(matrix, origin * sign * mm);
            if geometry::is_usable(&affine) {
                if !is_oriented {
                    report.warn(Warning::NoOrientation);
                }
                return Ok(affine);
            }
            report.warn(Warning::BadOrientation {
                field: "space directions",
                instead: "the voxel size",
            });
        }
        let spacings = per_axis(fields, "spacings", rank);
        let thicknesses = per_axis(fields, "thicknesses", rank);
        let mut spacing = DVec3::ONE;
        report.lacks_spacing = spacings.is_empty() && thicknesses.is_empty();
        for (i, &axis) in self.spatial.iter().enumerate() {
            let found = spacings
                .get(axis)
                .or_else(|| thicknesses.get(axis))
                .copied()
                .unwrap_or(1.0);
            if found.is_finite() && found != 0.0 {
                spacing[i] = found.abs() * mm;
            } else {
                report.warn(Warning::BadSpacing {
                    axis: i,
                    found: found as f32,
                    instead: 1.0,
                });
            }
        }
        if !geometry::is_usable(&geometry::unoriented(spacing)) {
            report.warn(Warning::BadSpacing {
                axis: 0,
                found: spacing.x as f32,
                instead: 1.0,
            });
            spacing = DVec3::ONE;
        }
        report.warn(Warning::NoOrientation);
        Ok(geometry::unoriented(spacing * sign))
    }
}

/// Adds axes, orthogonal to those there are and with their mean length, until there are three.
fn complete(columns: &mut Vec<DVec3>) {
    let length =
        columns.iter().map(|column| column.length()).sum::<f64>() / columns.len().max(1) as f64;
    if columns.len() == 1 {
        columns.push(columns[0].any_orthogonal_vector().normalize_or_zero() * length);
    }
    if columns.len() == 2 {
        columns.push(columns[0].cross(columns[1]).normalize_or_zero() * length);
    }
}

/// Numbers per axis, NaN where there is none; empty if the field is missing or damaged.
fn per_axis(fields: &Fields, field: &str, rank: usize) -> Vec<f64> {
    let numbers: Vec<f64> = fields
        .get(field)
        .map(|text| {
            text.split_whitespace()
                .map(|x| x.parse().unwrap_or(f64::NAN))
                .collect()
        })
        .unwrap_or_default();
    if numbers.len() == rank {
        numbers
    } else {
        Vec::new()
    }
}

/// Millimetres in one unit of the header.
fn unit_mm(fields: &Fields) -> f64 {
    let text = fields
        .get("spaceunits")
        .or_else(|| fields.get("units"))
        .unwrap_or_default();
    let unit = text
        .split('"')
        .nth(1)
        .unwrap_or_default()
        .trim()
        .to_lowercase();
    match unit.as_str() {
        "m" | "meter" | "metre" => 1000.0,
        "cm" => 10.0,
        "um" | "µm" | "μm" | "micron" | "microns" | "micrometer" => 0.001,
        "nm" => 1e-6,
        _ => 1.0,
    }
}

/// Names and colours as 3D Slicer writes them into segmentations.
fn segments(fields: &Fields, frame_count: u64, report: &mut LoadReport) {
    let mut layers = std::collections::BTreeSet::new();
    for index in 0..usize::from(u16::MAX) {
        let get = |key: &str| fields.pairs.get(&format!("Segment{index}_{key}"));
        if get("ID").or(get("Name")).is_none() {
            break;
        }
        report.is_labels = true;
        let layer: u64 = get("Layer")
            .and_then(|text| text.trim().parse().ok())
            .unwrap_or(0);
        layers.insert(layer);
        // Old segmentations have one layer per segment and no label values.
        let label = get("LabelValue").map_or(Some(1), |text| text.trim().parse::<u16>().ok());
        let (Some(label), true) = (label.filter(|&label| label > 0), layer == 0) else {
            continue;
        };
        let name = clean_name(get("Name").or(get("ID")).map_or("", String::as_str));
        let channels: Vec<u8> = get("Color")
            .map(|text| {
                text.split_whitespace()
                    .filter_map(|x| x.parse::<f32>().ok())
                    .map(|x| (x.clamp(0.0, 1.0) * 255.0).round() as u8)
                    .collect()
            })
            .unwrap_or_default();
        if report.segments.iter().all(|known| known.label != label) {
            report.segments.push(Segment {
                label,
                name,
                color_srgb: <[u8; 3]>::try_from(channels).ok(),
            });
        }
    }
    report.segments.sort_by_key(|segment| segment.label);
    if layers.len() > 1 || (report.is_labels && frame_count > 1) {
        report.warn(Warning::Layers {
            count: frame_count.max(layers.len() as u64),
        });
    }
}

/// Names of the voxels' files: one, a list below the header, or a pattern with numbers.
fn data_files(fields: &Fields) -> Result<Option<Vec<String>>, LoadError> {
    let Some(text) = fields.get("datafile") else {
        return Ok(None);
    };
    if text.split_whitespace().next() == Some("LIST") {
        return Ok(Some(fields.list.clone()));
    }
    let words: Vec<&str> = text.split_whitespace().collect();
    // A pattern: a name with a place for a number, first, last and step, and perhaps the dimension of each file.
    for numbers in [4, 3] {
        let Some((pattern, numbers)) = words
            .len()
            .checked_sub(numbers)
            .map(|at| words.split_at(at))
        else {
            continue;
        };
        let numbers: Option<Vec<i64>> = numbers.iter().map(|word| word.parse().ok()).collect();
        let Some([first, last, step] | [first, last, step, _]) = numbers.as_deref() else {
            continue;
        };
        let pattern = pattern.join(" ");
        if pattern.contains('%') {
            return pattern_files(&pattern, *first, *last, *step)
                .map(Some)
                .ok_or_else(|| fields.wrong("datafile", "a name with %d, first, last and step"));
        }
    }
    Ok(Some(vec![text.to_owned()]))
}
