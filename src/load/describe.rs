use std::fmt;

use glam::DVec3;

use super::error::NO_VOLUME;
use super::{
    FileSet, LoadError, LoadReport, RawLayout, ReadOptions, geometry::orientation_code, read_raw,
    read_volume,
};
use crate::data::{Segment, Statistics, SubjectPart, SubjectSink, Volume};

/// Segments listed at most.
const MAX_SEGMENTS_SHOWN: usize = 300;

/// What a data file holds, in words. Descriptive texts of the file, where patients' names stand, are not in it.
#[derive(Clone, Debug, PartialEq)]
pub struct Description {
    /// Size, spacing and orientation; its voxels are not kept.
    pub header: Volume,
    /// Segments in the file with the voxels of each, in label order; empty if it is no label volume.
    pub segments: Vec<(Segment, u64)>,
    /// Warnings and hash, as the reader reported them.
    pub report: LoadReport,
}

/// Reads a file through and describes its content, without keeping its voxels.
///
/// # Errors
/// As [`read_volume`].
pub fn describe(
    files: &mut dyn FileSet,
    name: &str,
    options: &ReadOptions,
) -> Result<Description, LoadError> {
    describe_by(|sink, report| read_volume(files, name, options, sink, report))
}

/// Reads a file of bare voxels through and describes its content.
///
/// # Errors
/// As [`read_raw`].
pub fn describe_raw(
    files: &mut dyn FileSet,
    name: &str,
    raw: &RawLayout,
    options: &ReadOptions,
) -> Result<Description, LoadError> {
    describe_by(|sink, report| read_raw(files, name, raw, options, sink, report))
}

fn describe_by(
    read: impl FnOnce(&mut dyn SubjectSink, &mut LoadReport) -> Result<(), LoadError>,
) -> Result<Description, LoadError> {
    let mut report = LoadReport::default();
    let mut counter = Counter {
        header: None,
        statistics: Statistics::new(),
    };
    read(&mut counter, &mut report)?;
    let mut header = counter.header.ok_or(LoadError::Cancelled)?;
    header.value_range = counter
        .statistics
        .value_range(header.slope, header.intercept);
    let is_plain = header.slope == 1.0 && header.intercept == 0.0;
    let segments = if is_plain && (report.is_labels || !report.segments.is_empty()) {
        segments_there(&counter.statistics, &report.segments)
    } else {
        Vec::new()
    };
    Ok(Description {
        header,
        segments,
        report,
    })
}

/// Labels that occur, with their names where the file has them.
pub(super) fn segments_there(statistics: &Statistics, named: &[Segment]) -> Vec<(Segment, u64)> {
    statistics
        .whole_counts()
        .filter_map(|(stored, count)| {
            let label = u16::try_from(stored).ok().filter(|&label| label > 0)?;
            let segment = named.iter().find(|segment| segment.label == label);
            let segment = segment.cloned().unwrap_or_else(|| Segment {
                label,
                name: format!("segment {label}"),
                color_srgb: None,
            });
            Some((segment, count))
        })
        .collect()
}

/// A sink that counts values and labels and keeps none of them.
struct Counter {
    header: Option<Volume>,
    statistics: Statistics,
}

impl SubjectSink for Counter {
    fn take(&mut self, part: SubjectPart) -> Result<(), String> {
        match part {
            SubjectPart::Volume(header) => self.header = Some(*header),
            SubjectPart::Scalars(next) => self.statistics.add(&next),
            _ => return Err(NO_VOLUME.to_owned()),
        }
        Ok(())
    }

    fn progress(&mut self, _fraction: f32) -> bool {
        true
    }
}

/// A number as people write it: four decimals at most.
pub fn short(x: f64) -> String {
    let text = if x != 0.0 && (x.abs() >= 1e9 || x.abs() < 1e-4) {
        format!("{x:.4e}")
    } else {
        let text = format!("{x:.4}");
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    };
    if text == "-0" { "0".to_owned() } else { text }
}

/// Three numbers as people write them, with times signs between.
pub fn times(v: DVec3) -> String {
    format!("{} × {} × {}", short(v.x), short(v.y), short(v.z))
}

impl fmt::Display for Description {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (grid, report) = (&self.header.grid, &self.report);
        let kind = report
            .format
            .map_or_else(|| "unknown".to_owned(), |format| format.to_string());
        let what = if self.segments.is_empty() {
            "volume"
        } else {
            "label volume"
        };
        writeln!(f, "kind: {kind}, {what}, {}", report.stored_type)?;
        let (dims, spacing) = (grid.dims.as_dvec3(), grid.spacing_mm());
        writeln!(f, "size: {} voxels", times(dims))?;
        if report.frame_count > 1 {
            writeln!(f, "frames: {}", report.frame_count)?;
        }
        writeln!(f, "spacing: {} mm", times(spacing))?;
        writeln!(f, "extent: {} mm", times(dims * spacing))?;
        let axes = grid.world_from_voxel.matrix3;
        let [x, y, z] = [axes.x_axis, axes.y_axis, axes.z_axis].map(DVec3::normalize_or_zero);
        let is_skewed = x.dot(y).abs().max(y.dot(z).abs()).max(z.dot(x).abs()) > 1e-3;
        let is_oblique = [x, y, z]
            .iter()
            .any(|axis| axis.abs().max_element() < 0.9999);
        let lie = match (is_skewed, is_oblique) {
            (true, _) => ", sheared",
            (false, true) => ", oblique",
            (false, false) => "",
        };
        let hand = if axes.determinant() < 0.0 {
            ", left-handed storage"
        } else {
            ""
        };
        writeln!(f, "orientation: {}{lie}{hand}", orientation_code(grid))?;
        let [low, high] = self.header.value_range.map(f64::from);
        write!(f, "values: {} to {}", short(low), short(high))?;
        let (slope, intercept) = (self.header.slope, self.header.intercept);
        if slope != 1.0 || intercept != 0.0 {
            write!(
                f,
                " (stored × {} {} {})",
                short(slope.into()),
                if intercept < 0.0 { '−' } else { '+' },
                short(intercept.abs().into())
            )?;
        }
        writeln!(f)?;
        if !self.segments.is_empty() {
            writeln!(f, "segments: {}", self.segments.len())?;
            for (segment, count) in self.segments.iter().take(MAX_SEGMENTS_SHOWN) {
                writeln!(f, "  {} {} ({count} voxels)", segment.label, segment.name)?;
            }
            if self.segments.len() > MAX_SEGMENTS_SHOWN {
                writeln!(f, "  …")?;
            }
        }
        if let Some(hash) = report.sha256_hex() {
            writeln!(f, "sha256: {hash}")?;
        }
        Ok(())
    }
}
