use std::collections::BTreeMap;

use super::error::NO_VOLUME;
use super::report::clean_name;
use super::{FileSet, LoadError, LoadReport, ReadOptions, read_volume};
use crate::data::{Segment, Segmentation, SubjectPart, SubjectSink, Volume, Voxels};

/// Reads no voxels: size, type and orientation of a file, and what its header gives for the report. Quick, for a choice
/// of frame or a question before a long load.
///
/// # Errors
/// As [`read_volume`].
pub fn read_header(
    files: &mut dyn FileSet,
    name: &str,
    options: &ReadOptions,
) -> Result<(Volume, LoadReport), LoadError> {
    struct Stop(Option<Volume>);
    impl SubjectSink for Stop {
        fn take(&mut self, part: SubjectPart) -> Result<(), String> {
            if let SubjectPart::Volume(header) = part {
                self.0 = Some(*header);
            }
            // With a header nobody asks why.
            Err(NO_VOLUME.to_owned())
        }
        fn progress(&mut self, _fraction: f32) -> bool {
            // Until then: of a series every header is looked at first.
            self.0.is_none()
        }
    }
    let mut stop = Stop(None);
    let mut report = LoadReport::default();
    let result = read_volume(files, name, options, &mut stop, &mut report);
    match (stop.0, result) {
        (Some(header), _) => Ok((header, report)),
        (None, Err(error)) => Err(error),
        (None, Ok(())) => Err(LoadError::Cancelled),
    }
}

/// Reads a file as labels, on its own grid. Segments are those that occur, under the names that the file, or else
/// `names`, gives them. More than 255 different labels are refused; numbers beyond 255 are renumbered, and the number
/// of the file stands in the name.
///
/// # Errors
/// As [`read_volume`], and [`LoadError::NotLabels`].
pub fn read_labels(
    files: &mut dyn FileSet,
    name: &str,
    names: &BTreeMap<u16, String>,
    options: &ReadOptions,
    report: &mut LoadReport,
) -> Result<Segmentation, LoadError> {
    Ok(read_numbered(files, name, names, options, report)?.0)
}

/// A label volume as its file has it.
#[derive(Clone, Debug, PartialEq)]
pub struct LabelFile {
    /// SHA-256 of the file's bytes, lower-case hex.
    pub sha256: String,
    /// Labels on the file's own grid, and a segment for each number that occurs.
    pub segmentation: Segmentation,
    /// The number that each of the segments has in the file, in their order. It differs from the label where numbers do
    /// not fit into a byte.
    pub numbers: Vec<u16>,
}

/// Reads a file as labels and keeps their numbers in the file, so that an author's names can be given to them
/// afterwards.
///
/// # Errors
/// As [`read_labels`].
pub fn read_label_file(
    files: &mut dyn FileSet,
    name: &str,
    options: &ReadOptions,
) -> Result<LabelFile, LoadError> {
    let mut report = LoadReport::default();
    let (segmentation, numbers) =
        read_numbered(files, name, &BTreeMap::new(), options, &mut report)?;
    Ok(LabelFile {
        sha256: report.sha256_hex().unwrap_or_default(),
        segmentation,
        numbers,
    })
}

/// As [`read_labels`], with the number of each segment in the file.
fn read_numbered(
    files: &mut dyn FileSet,
    name: &str,
    names: &BTreeMap<u16, String>,
    options: &ReadOptions,
    report: &mut LoadReport,
) -> Result<(Segmentation, Vec<u16>), LoadError> {
    let mut collector = Collector {
        header: None,
        labels: Vec::new(),
        numbers: vec![0],
        number_of: vec![0; 1 << 16],
        wrong: None,
    };
    let result = read_volume(files, name, options, &mut collector, report);
    let not_labels = |what: String| LoadError::NotLabels {
        name: name.to_owned(),
        what,
    };
    if let Some(what) = collector.wrong {
        return Err(not_labels(what));
    }
    result?;
    let header = collector.header.ok_or(LoadError::Cancelled)?;
    let Collector {
        mut labels,
        numbers,
        ..
    } = collector;
    // Numbers that fit are kept as they are; else they count up, in the order of the file's numbers.
    let mut sorted: Vec<u16> = numbers
        .iter()
        .copied()
        .filter(|&number| number > 0)
        .collect();
    sorted.sort_unstable();
    let fits = sorted.last().is_none_or(|&last| last <= 255);
    let kept_as: BTreeMap<u16, u8> = sorted
        .iter()
        .zip(1u8..=255)
        .map(|(&number, position)| {
            (
                number,
                u8::try_from(number)
                    .ok()
                    .filter(|_| fits)
                    .unwrap_or(position),
            )
        })
        .collect();
    let table: Vec<u8> = numbers
        .iter()
        .map(|number| kept_as.get(number).copied().unwrap_or(0))
        .collect();
    for label in &mut labels {
        *label = table.get(usize::from(*label)).copied().unwrap_or(0);
    }
    let segments = kept_as
        .iter()
        .map(|(&number, &label)| {
            let known = report
                .segments
                .iter()
                .find(|segment| segment.label == number);
            let name = names
                .get(&number)
                .map(|name| clean_name(name))
                .or_else(|| known.map(|segment| segment.name.clone()))
                .filter(|name| !name.is_empty())
                .unwrap_or_else(|| format!("segment {number}"));
            Segment {
                label: u16::from(label),
                name,
                color_srgb: known.and_then(|segment| segment.color_srgb),
            }
        })
        .collect();
    let segmentation = Segmentation {
        grid: header.grid,
        labels,
        segments,
    };
    Ok((segmentation, kept_as.into_keys().collect()))
}

/// Collects labels as positions in a list of the numbers that occur.
struct Collector {
    header: Option<Volume>,
    labels: Vec<u8>,
    /// Label numbers of the file in the order met; the first is 0.
    numbers: Vec<u16>,
    /// For each number its position in `numbers`; 0 if it was not met.
    number_of: Vec<u8>,
    wrong: Option<String>,
}

impl Collector {
    fn push(&mut self, value: f32) {
        let number = value as u16;
        if f32::from(number) != value {
            self.wrong
                .get_or_insert_with(|| format!("a voxel has the value {value}"));
            return;
        }
        let mut position = self.number_of[usize::from(number)];
        if position == 0 && number > 0 {
            let Ok(next) = u8::try_from(self.numbers.len()) else {
                self.wrong
                    .get_or_insert_with(|| "more than 255 different values".to_owned());
                return;
            };
            position = next;
            self.numbers.push(number);
            self.number_of[usize::from(number)] = next;
        }
        self.labels.push(position);
    }

    fn push_all(&mut self, next: Voxels) {
        let Some((slope, intercept)) = self
            .header
            .as_ref()
            .map(|header| (header.slope, header.intercept))
        else {
            return;
        };
        if self.wrong.is_some() {
            return;
        }
        self.labels.reserve(next.len());
        let value = |stored: f32| stored * slope + intercept;
        match next {
            Voxels::U8(v) => v.iter().for_each(|&x| self.push(value(f32::from(x)))),
            Voxels::I16(v) => v.iter().for_each(|&x| self.push(value(f32::from(x)))),
            Voxels::U16(v) => v.iter().for_each(|&x| self.push(value(f32::from(x)))),
            Voxels::F32(v) => v.iter().for_each(|&x| self.push(value(x))),
        }
    }
}

impl SubjectSink for Collector {
    fn take(&mut self, part: SubjectPart) -> Result<(), String> {
        match part {
            SubjectPart::Volume(header) => self.header = Some(*header),
            SubjectPart::Scalars(next) => self.push_all(next),
            _ => return Err(NO_VOLUME.to_owned()),
        }
        Ok(())
    }

    fn progress(&mut self, _fraction: f32) -> bool {
        self.wrong.is_none()
    }
}
