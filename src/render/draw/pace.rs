//! How much work one submission may hold: measured on the device as it goes.
//!
//! A submission takes what its pixels take and something else besides: the window's own drawing, a frame or two until
//! it is noticed. On a software device in a browser that is a quarter of a second. Held against the budget it would
//! make every submission one tile, and the picture a minute's work; so the budget is never less than what a
//! submission takes anyway and a share of that.

use super::tiles::TILE;

/// A submission of tiles may take so many times what the shortest takes, and one of what moves.
const REST_SHARE: f64 = 1.7;
const MOVING_SHARE: f64 = 1.3;

/// What moves is not made to wait for a device that takes longer for anything at all, seconds; nor does the first
/// submission of tiles, about which nothing is known.
const MOST: f64 = 0.3;

/// Beyond what a submission takes anyway its tiles may take so long, seconds: no device is lost to them.
const MOST_WORK: f64 = 0.5;

/// The shortest is believed to take no longer, seconds: the first ones wait for programs to be compiled.
const LONGEST: f64 = 3.0;

/// The shortest may have become longer: it is believed to, so much at each submission of a few tiles. Larger ones tell
/// nothing about it.
const GROWS: f64 = 1.05;
const FEW_PIXELS: u32 = 2 * TILE * TILE;

/// What a submission is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Work {
    /// The quick picture, by the formulas.
    Quick,
    /// The quick picture, from the baked map.
    QuickBaked,
    /// Tiles of the full picture.
    Refine,
    /// Texels of the baked map.
    Bake,
}

/// Seconds per pixel or texel by [`Work`], all that a submission takes counted; and what the shortest took.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pace {
    cost: [f64; 4],
    is_measured: [bool; 4],
    shortest: f64,
}

impl Pace {
    /// With a first guess of the costs, seconds.
    pub(crate) fn new(cost: [f64; 4]) -> Self {
        Self {
            cost,
            is_measured: [false; 4],
            shortest: 0.0,
        }
    }

    /// Seconds per pixel or texel, as far as was seen.
    pub(crate) fn cost(&self, work: Work) -> f64 {
        self.cost[work as usize]
    }

    /// Seconds that the device takes for anything at all, as far as was seen.
    pub(crate) fn shortest(&self) -> f64 {
        self.shortest
    }

    /// A new map is baked: it is hoped to take so much of what the formulas take.
    pub(crate) fn hope_for_baked(&mut self, share: f64) {
        self.cost[Work::QuickBaked as usize] = share * self.cost(Work::Quick);
    }

    /// Pixels or texels that a budget of seconds pays for.
    pub(crate) fn affordable(&self, budget: f64, work: Work) -> f64 {
        let brief = self.shortest.min(MOST);
        let takes = match work {
            Work::Quick | Work::QuickBaked => MOVING_SHARE * brief,
            Work::Refine if self.is_measured[work as usize] => {
                self.shortest + ((REST_SHARE - 1.0) * self.shortest).min(MOST_WORK)
            }
            Work::Refine => REST_SHARE * brief,
            Work::Bake => brief,
        };
        budget.max(takes) / self.cost(work)
    }

    /// Learns from a submission that was seen to be done after `elapsed` seconds, at the check of number `checks`, one
    /// check a frame.
    pub(crate) fn learn(&mut self, elapsed: f64, pixels: u32, checks: u32, work: Work) {
        if work != Work::Bake {
            let believed = match self.shortest {
                0.0 if pixels <= FEW_PIXELS => elapsed,
                shortest if pixels <= FEW_PIXELS => shortest * GROWS,
                shortest => shortest,
            };
            self.shortest = elapsed.min(believed).min(LONGEST);
        }
        let measured = elapsed / f64::from(pixels.max(1));
        self.is_measured[work as usize] = true;
        let cost = &mut self.cost[work as usize];
        // Done by the next frame: it may have taken less than could be seen, so more is tried.
        *cost = if checks <= 1 {
            (*cost * 0.6).min(measured.max(*cost * 0.3))
        } else {
            0.5 * (*cost + measured)
        };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Seconds of work in a submission after `n` of them, on a device of this wait and cost that shows frames of this
    /// length.
    fn work_after(n: usize, first: f64, wait: f64, cost: f64, frame: f64, budget: f64) -> f64 {
        let mut pace = Pace::new([first; 4]);
        for _ in 0..n {
            let pixels = pace.affordable(budget, Work::Refine).clamp(4096.0, 1e6);
            let takes = wait + cost * pixels;
            let checks = (takes / frame).ceil();
            pace.learn(checks * frame, pixels as u32, checks as u32, Work::Refine);
        }
        pace.affordable(budget, Work::Refine).clamp(4096.0, 1e6) * cost
    }

    #[test]
    fn waiting_is_not_taken_for_work() {
        // SwiftShader in a browser: a tile takes 16 ms, and a quarter of a second goes by until that is known.
        let work = work_after(12, 2.5e-6, 0.25, 4e-6, 0.13, 0.05);
        assert!(work > 0.08, "many tiles at once: {work}");
        assert!(work < 0.6, "and not too many: {work}");
    }

    /// A page of full size on SwiftShader: half a second goes by for each frame, two of them for a submission. One tile
    /// at a time would make the picture three minutes' work.
    #[test]
    fn a_page_that_is_slow_by_itself_does_many_tiles_at_once() {
        const COST: f64 = 5e-6;
        let mut pace = Pace::new([2.5e-6; 4]);
        let mut pixels = 4096.0;
        for _ in 0..16 {
            // The device tells when it is done, between two frames.
            pace.learn(1.0 + COST * pixels, pixels as u32, 2, Work::Refine);
            pixels = pace.affordable(0.05, Work::Refine).max(4096.0);
        }
        let work = COST * pixels;
        assert!(work > 0.3, "{work}");
        assert!(work < 0.7, "{work}");
    }

    /// The first submissions wait for programs, which tells nothing about tiles.
    #[test]
    fn a_long_start_makes_no_long_submission() {
        let mut pace = Pace::new([2.5e-6; 4]);
        pace.learn(12.0, 4096, 30, Work::Quick);
        let first = 6e-5 * pace.affordable(0.05, Work::Refine);
        assert!(first < 15.0, "as before: {first}");
        let mut longest = 0.0_f64;
        let mut pixels = 8192.0;
        for _ in 0..20 {
            let takes = 0.3 + 6e-5 * pixels;
            longest = longest.max(6e-5 * pixels);
            pace.learn(
                takes,
                pixels as u32,
                (takes / 0.15).ceil() as u32,
                Work::Refine,
            );
            pixels = pace.affordable(0.05, Work::Refine).max(4096.0);
        }
        assert!(longest < 3.5, "{longest}");
        assert!(6e-5 * pixels < 1.0, "{pixels}");
    }

    #[test]
    fn a_fast_device_keeps_to_its_budget() {
        let work = work_after(30, 3e-8, 0.0, 2e-7, 1.0 / 60.0, 0.05);
        assert!((0.01..0.12).contains(&work), "{work}");
    }

    #[test]
    fn a_scene_that_became_dear_is_noticed() {
        let mut pace = Pace::new([1e-7; 4]);
        for _ in 0..20 {
            let pixels = pace.affordable(0.05, Work::Refine).max(4096.0);
            let takes = 0.1 + 5e-5 * pixels;
            pace.learn(
                takes,
                pixels as u32,
                (takes / 0.05).ceil() as u32,
                Work::Refine,
            );
        }
        let work = 5e-5 * pace.affordable(0.05, Work::Refine);
        assert!(work < 0.5, "{work}");
    }
}
