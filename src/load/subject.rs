use std::collections::BTreeMap;

use super::labels::{read_header, read_labels};
use super::{FileSet, LoadError, LoadReport, ReadOptions, read_volume};
use crate::data::{Segmentation, SubjectPart, SubjectSink};

/// Where the labels of a subject come from.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct LabelSource {
    /// The label volume's file; `None` takes the scan's own file if its header says that it holds labels.
    pub name: Option<String>,
    /// Names by label number, which win over those in the file.
    pub names: BTreeMap<u16, String>,
}

/// Reads a subject, told by the content of its file first, by its name where content says nothing. Today that is a scan
/// with its segments: the label volume first, whole, then the scan slab by slab. The sink's header announces both.
///
/// # Errors
/// As [`read_volume`] and [`read_labels`]. A scan's own file that only seems to hold labels is read without them.
pub fn read_subject(
    files: &mut dyn FileSet,
    name: &str,
    labels: &LabelSource,
    options: &ReadOptions,
    sink: &mut dyn SubjectSink,
    report: &mut LoadReport,
) -> Result<(), LoadError> {
    let labels = match &labels.name {
        Some(file) => Some(read_labels(
            files,
            file,
            &labels.names,
            &ReadOptions::default(),
            &mut LoadReport::default(),
        )?),
        None => {
            // A file that cannot be opened twice is read once, without labels.
            let says_labels = read_header_if_again(files, name, options);
            if says_labels {
                read_labels(
                    files,
                    name,
                    &labels.names,
                    options,
                    &mut LoadReport::default(),
                )
                .ok()
            } else {
                None
            }
        }
    };
    let mut sink = WithLabels {
        inner: sink,
        labels,
    };
    read_volume(files, name, options, &mut sink, report)
}

fn read_header_if_again(files: &mut dyn FileSet, name: &str, options: &ReadOptions) -> bool {
    files.can_reopen()
        && read_header(files, name, options).is_ok_and(|(_, report)| report.is_labels)
}

/// Adds a label volume to the volume that passes.
struct WithLabels<'a> {
    inner: &'a mut dyn SubjectSink,
    labels: Option<Segmentation>,
}

impl SubjectSink for WithLabels<'_> {
    fn take(&mut self, part: SubjectPart) -> Result<(), String> {
        match part {
            SubjectPart::Volume(mut header) if let Some(mut segmentation) = self.labels.take() => {
                let labels = std::mem::take(&mut segmentation.labels);
                header.segmentation = Some(segmentation);
                self.inner.take(SubjectPart::Volume(header))?;
                self.inner.take(SubjectPart::Labels(labels))
            }
            part => self.inner.take(part),
        }
    }

    fn progress(&mut self, fraction: f32) -> bool {
        self.inner.progress(fraction)
    }
}
