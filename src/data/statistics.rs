use super::{Volume, Voxels};

/// Bins of a finished histogram.
const BINS: usize = 256;
/// Bins while counting floats, whose range is not known beforehand.
const FLOAT_BINS: usize = 4096;

/// How often which values occur, for windowing.
#[derive(Clone, Debug, PartialEq)]
pub struct Histogram {
    /// Smallest and largest value; the bins divide what lies between evenly. Equal for a constant volume, whose
    /// voxels are all in bin 0.
    pub value_range: [f32; 2],
    /// Voxels per bin, 256 bins.
    pub counts: Vec<u64>,
}

impl Histogram {
    /// Value below which the fraction `q` (0 to 1) of all voxels lies, to the width of a bin.
    pub fn quantile(&self, q: f32) -> f32 {
        let [min, max] = self.value_range;
        let total: u64 = self.counts.iter().sum();
        let wanted = f64::from(q.clamp(0.0, 1.0)) * total as f64;
        let mut below = 0.0;
        for (bin, &count) in self.counts.iter().enumerate() {
            let count = count as f64;
            if count > 0.0 && below + count >= wanted {
                let part = (bin as f64 + (wanted - below) / count) / self.counts.len() as f64;
                return (f64::from(min) + part * (f64::from(max) - f64::from(min))) as f32;
            }
            below += count;
        }
        max
    }

    /// Voxels with a value in the range, ends included, to the width of a bin.
    pub fn count_within(&self, [low, high]: [f32; 2]) -> f64 {
        let [min, max] = self.value_range.map(f64::from);
        let (low, high) = (f64::from(low), f64::from(high));
        let width = (max - min) / self.counts.len().max(1) as f64;
        if width <= 0.0 {
            let all: u64 = self.counts.iter().sum();
            return if low <= min && min <= high {
                all as f64
            } else {
                0.0
            };
        }
        let bins = self.counts.iter().enumerate();
        bins.map(|(bin, &count)| {
            let from = min + bin as f64 * width;
            let part = (high.min(from + width) - low.max(from)) / width;
            count as f64 * part.clamp(0.0, 1.0)
        })
        .sum()
    }

    /// A window that shows what matters when nothing is known of the values: without the darkest bin (the air around,
    /// or padding), from the 2nd to the 98th of a hundred voxels.
    pub fn robust_window(&self) -> [f32; 2] {
        let mut inner = self.clone();
        if let Some((bin, _)) = self
            .counts
            .iter()
            .enumerate()
            .find(|(_, count)| **count > 0)
            && self.counts.iter().filter(|count| **count > 0).count() > 2
        {
            inner.counts[bin] = 0;
        }
        let window = [inner.quantile(0.02), inner.quantile(0.98)];
        if window[1] > window[0] {
            window
        } else {
            self.value_range
        }
    }
}

/// Counts voxels as they come: range and histogram in one pass, cheap enough for every load (1 to 2 ns per voxel).
#[derive(Clone, Debug)]
pub struct Statistics {
    counts: Counts,
}

#[derive(Clone, Debug)]
enum Counts {
    /// No voxel was counted yet.
    Empty,
    /// One counter per stored number, which is `index + first`.
    Whole { first: i32, counts: Vec<u64> },
    /// Bins from `start`, each `width` wide; `width` doubles when a value falls outside.
    Float {
        min: f32,
        max: f32,
        start: f64,
        width: f64,
        counts: Vec<u64>,
    },
}

impl Default for Statistics {
    fn default() -> Self {
        Self::new()
    }
}

impl Statistics {
    /// Statistics of no voxels: the start of a count.
    pub fn new() -> Self {
        Self {
            counts: Counts::Empty,
        }
    }

    /// Counts stored numbers (before slope and intercept). Numbers that are not finite are left out. All calls must
    /// bring one type; another type starts a new count.
    pub fn add(&mut self, voxels: &Voxels) {
        match voxels {
            Voxels::U8(v) => {
                let counts = self.whole(0, 1 << 8);
                v.iter().for_each(|&x| counts[usize::from(x)] += 1);
            }
            Voxels::U16(v) => {
                let counts = self.whole(0, 1 << 16);
                v.iter().for_each(|&x| counts[usize::from(x)] += 1);
            }
            Voxels::I16(v) => {
                let counts = self.whole(i32::from(i16::MIN), 1 << 16);
                v.iter()
                    .for_each(|&x| counts[usize::from(x as u16 ^ 0x8000)] += 1);
            }
            Voxels::F32(v) => self.add_floats(v),
        }
    }

    fn whole(&mut self, first: i32, n: usize) -> &mut [u64] {
        let fits = matches!(&self.counts, Counts::Whole { first: f, counts } if *f == first && counts.len() == n);
        if !fits {
            self.counts = Counts::Whole {
                first,
                counts: vec![0; n],
            };
        }
        match &mut self.counts {
            Counts::Whole { counts, .. } => counts,
            Counts::Empty | Counts::Float { .. } => &mut [],
        }
    }

    fn add_floats(&mut self, values: &[f32]) {
        let (mut low, mut high) = (f32::INFINITY, f32::NEG_INFINITY);
        for &x in values.iter().filter(|x| x.is_finite()) {
            low = low.min(x);
            high = high.max(x);
        }
        if low > high {
            return;
        }
        if !matches!(self.counts, Counts::Float { .. }) {
            // The first slab guesses the range; a constant one guesses a width that its size can resolve.
            let span = f64::from(high) - f64::from(low);
            let width = if span > 0.0 {
                span / (FLOAT_BINS - 1) as f64
            } else {
                f64::from(low.abs().max(f32::MIN_POSITIVE)) * f64::from(f32::EPSILON)
            };
            self.counts = Counts::Float {
                min: low,
                max: high,
                start: f64::from(low),
                width,
                counts: vec![0; FLOAT_BINS],
            };
        }
        let Counts::Float {
            min,
            max,
            start,
            width,
            counts,
        } = &mut self.counts
        else {
            return;
        };
        *min = min.min(low);
        *max = max.max(high);
        while f64::from(low) < *start {
            // Twice as wide towards lower values: the counts so far move to the upper half.
            *start -= *width * FLOAT_BINS as f64;
            *width *= 2.0;
            let merged = halve(counts);
            counts.fill(0);
            counts[FLOAT_BINS / 2..].copy_from_slice(&merged);
        }
        while (f64::from(high) - *start) / *width >= FLOAT_BINS as f64 {
            *width *= 2.0;
            let merged = halve(counts);
            counts.fill(0);
            counts[..FLOAT_BINS / 2].copy_from_slice(&merged);
        }
        let per_width = 1.0 / *width;
        for &x in values.iter().filter(|x| x.is_finite()) {
            let bin = ((f64::from(x) - *start) * per_width) as usize;
            counts[bin.min(FLOAT_BINS - 1)] += 1;
        }
    }

    /// Stored whole numbers that occurred, ascending, with how often. Empty for floats.
    pub fn whole_counts(&self) -> impl Iterator<Item = (i32, u64)> + '_ {
        let (first, counts) = match &self.counts {
            Counts::Whole { first, counts } => (*first, counts.as_slice()),
            Counts::Empty | Counts::Float { .. } => (0, &[][..]),
        };
        (first..)
            .zip(counts.iter().copied())
            .filter(|&(_, count)| count > 0)
    }

    /// Smallest and largest stored number; `None` if no finite one came.
    pub fn stored_range(&self) -> Option<[f32; 2]> {
        match &self.counts {
            Counts::Empty => None,
            Counts::Whole { first, counts } => {
                let low = counts.iter().position(|&n| n > 0)?;
                let high = counts.iter().rposition(|&n| n > 0)?;
                Some([(low as i32 + first) as f32, (high as i32 + first) as f32])
            }
            Counts::Float { min, max, .. } => Some([*min, *max]),
        }
    }

    /// Smallest and largest value; 0 and 0 if no finite one came.
    pub fn value_range(&self, slope: f32, intercept: f32) -> [f32; 2] {
        let [a, b] = self.stored_range().unwrap_or([0.0, 0.0]);
        let [a, b] = [a * slope + intercept, b * slope + intercept];
        [a.min(b), a.max(b)]
    }

    /// The histogram of values.
    pub fn histogram(&self, slope: f32, intercept: f32) -> Histogram {
        let value_range = self.value_range(slope, intercept);
        let [min, max] = value_range.map(f64::from);
        let mut bins = vec![0; BINS];
        let mut put = |stored: f64, count: u64| {
            let value = stored * f64::from(slope) + f64::from(intercept);
            let part = if max > min {
                (value - min) / (max - min)
            } else {
                0.0
            };
            bins[((part * BINS as f64) as usize).min(BINS - 1)] += count;
        };
        match &self.counts {
            Counts::Empty => {}
            Counts::Whole { first, counts } => {
                for (i, &count) in counts.iter().enumerate().filter(|(_, count)| **count > 0) {
                    put(f64::from(i as i32 + first), count);
                }
            }
            Counts::Float {
                start,
                width,
                counts,
                ..
            } => {
                for (i, &count) in counts.iter().enumerate().filter(|(_, count)| **count > 0) {
                    put(start + (i as f64 + 0.5) * width, count);
                }
            }
        }
        Histogram {
            value_range,
            counts: bins,
        }
    }
}

fn halve(counts: &[u64]) -> Vec<u64> {
    counts.chunks(2).map(|pair| pair.iter().sum()).collect()
}

impl Volume {
    /// Histogram of the values, counted anew: one pass over the voxels. Who collects them has it already.
    pub fn histogram(&self) -> Histogram {
        let mut statistics = Statistics::new();
        statistics.add(&self.voxels);
        statistics.histogram(self.slope, self.intercept)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn float_range_grows_both_ways() {
        let mut statistics = Statistics::new();
        statistics.add(&Voxels::F32(vec![5.0; 10]));
        statistics.add(&Voxels::F32(vec![-1000.0, f32::NAN, 3000.0, f32::INFINITY]));
        assert_eq!(statistics.stored_range(), Some([-1000.0, 3000.0]));
        let histogram = statistics.histogram(1.0, 0.0);
        assert_eq!(histogram.counts.iter().sum::<u64>(), 12);
        // 5 lies in bin 1005/4000·256 = 64.3, seen through bins that are one 4096th wide at least.
        assert_eq!(histogram.counts[64], 10);
    }

    #[test]
    fn whole_numbers_are_counted_exactly() {
        let mut statistics = Statistics::new();
        statistics.add(&Voxels::I16(vec![-1000, 0, 1000]));
        statistics.add(&Voxels::I16(vec![0]));
        assert_eq!(statistics.value_range(2.0, 10.0), [-1990.0, 2010.0]);
        assert_eq!(statistics.value_range(-1.0, 0.0), [-1000.0, 1000.0]);
        let histogram = statistics.histogram(1.0, 0.0);
        assert_eq!(histogram.counts[128], 2);
        assert!((histogram.quantile(0.5) - 0.0).abs() < 2000.0 / 256.0);
    }

    #[test]
    fn voxels_within_a_range_are_counted() {
        let mut statistics = Statistics::new();
        statistics.add(&Voxels::I16(vec![-1000, 0, 0, 0, 200, 1000]));
        let histogram = statistics.histogram(1.0, 0.0);
        let count = |low: f32, high: f32| histogram.count_within([low, high]);
        assert_eq!(count(100.0, f32::MAX), 2.0);
        assert_eq!(count(-2000.0, 2000.0), 6.0);
        assert_eq!(count(-500.0, 100.0), 3.0);
        assert_eq!(count(300.0, 900.0), 0.0);
        statistics = Statistics::new();
        statistics.add(&Voxels::U8(vec![7; 9]));
        let constant = statistics.histogram(1.0, 0.0);
        assert_eq!(constant.count_within([7.0, 8.0]), 9.0);
        assert_eq!(constant.count_within([8.0, 9.0]), 0.0);
    }

    #[test]
    fn extremes_do_not_hang() {
        let mut statistics = Statistics::new();
        statistics.add(&Voxels::F32(vec![f32::MIN_POSITIVE]));
        statistics.add(&Voxels::F32(vec![-1e37, 1e37, 0.0]));
        assert_eq!(statistics.histogram(1.0, 0.0).counts.iter().sum::<u64>(), 4);
        assert_eq!(Statistics::new().value_range(1.0, 0.0), [0.0, 0.0]);
    }
}
