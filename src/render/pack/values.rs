//! What the values of a volume mean, and how textures hold them.

use crate::data::{Histogram, Volume};

/// Voxels looked at for the histogram at most.
const HISTOGRAM_SAMPLES: usize = 1 << 20;
/// Below this (Hounsfield units) there is air: half of it lies between air and soft tissue.
const AIR_BELOW: f32 = -500.0;
/// Where values have no unit: part of the window, from its low end, up to which there is nothing.
const DARK_PART: f32 = 0.12;

/// What a volume looks like by default, and what its values span.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SubjectInfo {
    /// Smallest and largest value.
    pub value_range: [f32; 2],
    /// Window from the histogram, for presets without one of their own.
    pub window_auto: [f32; 2],
    /// True if the values are Hounsfield units, with `hounsfield_offset` added.
    pub is_ct: bool,
    /// Value of water: 0 for Hounsfield units, about 1,024 for scans that are stored unsigned.
    pub hounsfield_offset: f32,
    /// True if there are segments with colours.
    pub has_segments: bool,
}

impl SubjectInfo {
    /// Finds out what kind of numbers a volume holds. Segments are not looked at.
    pub(crate) fn of(volume: &Volume) -> Self {
        let histogram = sampled_histogram(volume);
        let [low, high] = volume.value_range;
        let is_hounsfield = low <= -200.0 && high >= 200.0;
        // Twelve bits stored unsigned with water at about 1,024: most of what is not air lies about there.
        let share = share_between(&histogram, 880.0, 1180.0)
            / share_between(&histogram, 300.0, high).max(1e-6);
        let is_offset_ct =
            !is_hounsfield && low >= 0.0 && (1800.0..=4200.0).contains(&high) && share > 0.35;
        let window_auto = histogram.robust_window();
        Self {
            value_range: volume.value_range,
            window_auto: if window_auto[1] > window_auto[0] {
                window_auto
            } else {
                [low, low + span(volume.value_range)]
            },
            is_ct: is_hounsfield || is_offset_ct,
            hounsfield_offset: if is_offset_ct { 1024.0 } else { 0.0 },
            has_segments: false,
        }
    }
}

impl SubjectInfo {
    /// The value at the object's outer surface: up to it there is nothing.
    pub fn outer_value(&self) -> f32 {
        if self.is_ct || self.value_range[0] <= -500.0 {
            return AIR_BELOW + self.hounsfield_offset;
        }
        let [low, high] = self.window_auto;
        low + DARK_PART * (high - low)
    }

    /// Of a subject without values. `has_segments` is true if it has segments with colours.
    pub(crate) fn of_no_values(has_segments: bool) -> Self {
        Self {
            value_range: [0.0, 1.0],
            window_auto: [0.0, 1.0],
            is_ct: false,
            hounsfield_offset: 0.0,
            has_segments,
        }
    }
}

/// From stored numbers to what textures hold: 0 for the smallest value of the volume and 1 for the largest.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Normalise {
    slope: f32,
    offset: f32,
}

impl Normalise {
    pub(crate) fn of(volume: &Volume) -> Self {
        let [low, high] = volume.value_range;
        let range = span(volume.value_range);
        debug_assert!(high >= low, "a value range is sorted");
        Self {
            slope: volume.slope / range,
            offset: (volume.intercept - low) / range,
        }
    }

    /// The stored number as a texel, 0 to 1; a value that is no number counts as the smallest.
    pub(crate) fn apply(self, stored: f32) -> f32 {
        let n = stored * self.slope + self.offset;
        if n > 0.0 { n.min(1.0) } else { 0.0 }
    }
}

/// Width of a range of values; 1 where it has none.
pub(crate) fn span(range: [f32; 2]) -> f32 {
    let span = range[1] - range[0];
    if span.is_finite() && span > 0.0 {
        span
    } else {
        1.0
    }
}

fn sampled_histogram(volume: &Volume) -> Histogram {
    let mut counts = vec![0u64; 256];
    let scale = Normalise::of(volume);
    let n = volume.voxels.len();
    // An odd stride does not run along the axes of grids with even sides.
    let stride = (n / HISTOGRAM_SAMPLES).max(1) | 1;
    let mut i = 0;
    while let Some(stored) = volume.voxels.get(i) {
        let bin = (scale.apply(stored) * 255.0 + 0.5) as usize;
        if let Some(count) = counts.get_mut(bin) {
            *count += 1;
        }
        i += stride;
    }
    Histogram {
        value_range: volume.value_range,
        counts,
    }
}

fn share_between(histogram: &Histogram, low: f32, high: f32) -> f32 {
    let [min, _] = histogram.value_range;
    let width = span(histogram.value_range) / 255.0;
    let (mut inside, mut total) = (0, 0);
    for (i, &count) in histogram.counts.iter().enumerate() {
        let value = min + i as f32 * width;
        total += count;
        if (low..=high).contains(&value) {
            inside += count;
        }
    }
    inside as f32 / total.max(1) as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_number_counts_as_the_smallest() {
        let scale = Normalise {
            slope: 0.1,
            offset: 0.2,
        };
        assert_eq!(scale.apply(f32::NAN), 0.0);
        assert_eq!(scale.apply(f32::INFINITY), 1.0);
        assert_eq!(scale.apply(f32::NEG_INFINITY), 0.0);
    }
}
