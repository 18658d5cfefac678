//! What a slow device is spared: the resolution of the quick picture and the samples of the finished one are chosen by
//! what was measured on it.

/// The quick picture has at least this part of the full one's pixels along each side, and less only where enough
/// pixels are left along the shorter side.
const LEAST_SCALE: f32 = 0.14;
const LEAST_EVER: f32 = 0.07;
const ENOUGH_PX: f32 = 120.0;

/// The resolution stays while what is affordable lies between these parts of it: a picture that becomes sharper and
/// blunter from frame to frame is worse than a blunt one. A frame takes 1.4 times its budget at most, and half of it at
/// least where there is more to be had.
const KEPT: (f32, f32) = (0.85, 1.4);
/// Where so much is affordable the whole resolution is taken.
const WHOLE: f32 = 1.06;

/// Slow: a whole picture takes longer, seconds. Then its samples are these at most.
const SLOW_SECONDS: f64 = 1.0;
const SLOW_SAMPLES: u32 = 5;

/// A submission of tiles is believed to take no longer, seconds: the window may have been hidden meanwhile.
const MOST: f64 = 0.5;

/// The least scale of a quick picture that becomes one of `size` pixels.
pub(crate) fn least_scale(size: [u32; 2]) -> f32 {
    let shorter = size[0].min(size[1]).max(1) as f32;
    (ENOUGH_PX / shorter).clamp(LEAST_EVER, LEAST_SCALE)
}

/// The scale of a quick picture, in sixteenths. `affordable` is the one that the budget pays for, which may be above 1;
/// `before` the scale of the quick picture before, if there was one.
pub(crate) fn steady_scale(affordable: f32, before: Option<f32>, least: f32) -> f32 {
    let affordable = affordable.max(least);
    match before {
        Some(before)
            if affordable >= before * KEPT.0
                && affordable < before * KEPT.1
                && (affordable < WHOLE || before >= 1.0) =>
        {
            before.clamp(least, 1.0)
        }
        _ => ((affordable.min(1.0) * 16.0).floor() / 16.0).max(least),
    }
}

/// Samples of the finished picture on a device on which a whole picture takes so many seconds, and that could draw
/// `usual` of them.
pub(crate) fn samples(usual: u32, whole_seconds: Option<f64>) -> u32 {
    match whole_seconds {
        Some(seconds) if seconds > SLOW_SECONDS => usual.min(SLOW_SAMPLES),
        _ => usual,
    }
}

/// Measures how long a whole picture takes, which is drawn tile by tile, sample after sample.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct WholePicture {
    /// Seconds of the pass under way.
    so_far: f64,
    /// Seconds of the last passes that were drawn to their end.
    passes: [Option<f64>; 2],
}

impl WholePicture {
    /// The first tiles of a sample are handed in.
    pub(crate) fn begins(&mut self) {
        self.so_far = 0.0;
    }

    /// Tiles were seen to be done, so many seconds after they were handed in. `is_last`: those that end a sample.
    pub(crate) fn took(&mut self, seconds: f64, is_last: bool) {
        self.so_far += seconds.clamp(0.0, MOST);
        if is_last {
            self.passes = [self.passes[1], Some(self.so_far)];
        }
    }

    /// Seconds that a whole picture takes; known from the second on, as programs are still compiled during the first.
    pub(crate) fn seconds(&self) -> Option<f64> {
        let [a, b] = self.passes;
        Some(a?.min(b?))
    }
}

#[cfg(test)]
mod tests {
    use super::super::pace::{Pace, Work};
    use super::*;

    const PIXELS: f32 = 1_000_000.0;
    const FRAME: f64 = 1.0 / 60.0;
    const BUDGET: f64 = 0.03;

    /// Scales of quick pictures, and the seconds that they took, on a device that takes so long for a pixel, give or
    /// take a part of it.
    fn drag(cost: f64, unsteady: f64, frames: usize) -> Vec<(f32, f64)> {
        let mut pace = Pace::new([3e-8; 4]);
        let mut before = None;
        let drawn = (0..frames).map(|frame| {
            let affordable = pace.affordable(BUDGET, Work::Quick) as f32;
            let scale = steady_scale((affordable / PIXELS).sqrt(), before, LEAST_SCALE);
            before = Some(scale);
            let pixels = scale * scale * PIXELS;
            let given = 1.0 + unsteady * (1.7 * frame as f64).sin();
            let takes = given * cost * f64::from(pixels);
            let checks = (takes / FRAME).ceil().max(1.0);
            pace.learn(checks * FRAME, pixels as u32, checks as u32, Work::Quick);
            (scale, takes)
        });
        drawn.collect()
    }

    #[test]
    fn moving_keeps_its_pace_and_does_not_flicker() {
        // From a good graphics card to one on which the least scale takes a twentieth of a second.
        let costs = [1e-9, 2e-8, 5e-8, 1e-7, 3e-7, 1e-6, 2e-6];
        for (cost, unsteady) in costs.iter().flat_map(|cost| [(*cost, 0.0), (*cost, 0.15)]) {
            let drawn = &drag(cost, unsteady, 240)[40..];
            let longest = drawn.iter().map(|(_, takes)| *takes).fold(0.0, f64::max);
            assert!(longest < 0.1, "{cost}: {longest} s");
            let scales: Vec<f32> = drawn.iter().map(|(scale, _)| *scale).collect();
            let changes = scales.windows(2).filter(|two| two[0] != two[1]).count();
            assert!(changes <= 4, "{cost}: {changes} changes, {scales:?}");
            if cost < 2e-8 {
                assert_eq!(scales.last(), Some(&1.0), "all that there is");
            }
        }
    }

    #[test]
    fn a_large_screen_may_be_drawn_more_coarsely() {
        assert_eq!(least_scale([640, 480]), LEAST_SCALE, "of few pixels");
        assert_eq!(least_scale([2400, 1200]), 0.1, "120 are left");
        assert_eq!(least_scale([8000, 6000]), LEAST_EVER);
        assert_eq!(least_scale([0, 0]), LEAST_SCALE);
    }

    #[test]
    fn a_scale_is_kept_until_it_is_far_off() {
        assert_eq!(steady_scale(0.6, None, 0.14), 0.5625, "in sixteenths");
        assert_eq!(steady_scale(0.52, Some(0.5625), 0.14), 0.5625);
        assert_eq!(steady_scale(0.77, Some(0.5625), 0.14), 0.5625);
        assert_eq!(steady_scale(0.47, Some(0.5625), 0.14), 0.4375);
        assert_eq!(steady_scale(0.8, Some(0.5625), 0.14), 0.75);
        assert_eq!(steady_scale(1.07, Some(0.9375), 0.14), 1.0);
        assert_eq!(steady_scale(9.0, Some(0.25), 0.14), 1.0);
        assert_eq!(steady_scale(0.01, Some(0.25), 0.14), 0.14);
        assert_eq!(steady_scale(0.1, Some(1.0), 0.1), 0.1, "of another size");
    }

    #[test]
    fn a_whole_picture_is_measured_from_the_second_on() {
        let mut whole = WholePicture::default();
        let mut pass = |tiles: &[f64]| {
            whole.begins();
            for (i, seconds) in tiles.iter().enumerate() {
                whole.took(*seconds, i + 1 == tiles.len());
            }
            whole.seconds()
        };
        // A program is compiled meanwhile.
        assert_eq!(pass(&[0.5, 0.5, 0.5]), None);
        assert_eq!(pass(&[0.25, 0.25]), Some(0.5));
        assert_eq!(pass(&[0.5, 0.25]), Some(0.5));
        assert_eq!(pass(&[0.5, 0.5, 0.25]), Some(0.75), "two that are slow");
        // Nobody looked for a minute.
        assert_eq!(pass(&[60.0, 0.25]), Some(0.75));
        whole.begins();
        whole.took(0.5, false);
        assert_eq!(whole.seconds(), Some(0.75), "not drawn to its end");
        assert_eq!([samples(16, None), samples(16, Some(0.7))], [16, 16]);
        assert_eq!([samples(16, Some(2.0)), samples(3, Some(2.0))], [5, 3]);
    }
}
