//! Strokes tell tissues apart where there is no colour.

use crate::gpu::{builtin, software, studio_of};
use crate::style::{drawn, illustration};
use fabrica::render::{Image, Sighting};
use std::collections::BTreeMap;
use std::f32::consts::PI;

fn grey(image: &Image, x: u32, y: u32) -> f32 {
    f32::from(image.rgba[4 * (y * image.size[0] + x) as usize])
}

/// What a picture shows of a segment.
#[derive(Default)]
struct Tissue {
    count: f64,
    grey: f64,
    /// Sums of products of the slopes of the grey: along x, across, along y.
    slopes: [f64; 3],
}

impl Tissue {
    fn mean(&self) -> f64 {
        self.grey / self.count
    }

    /// The direction in which the grey changes most, radians from 0 to π, which is across the strokes.
    fn across(&self) -> f32 {
        let [xx, xy, yy] = self.slopes;
        (0.5 * (2.0 * xy).atan2(xx - yy)).rem_euclid(std::f64::consts::PI) as f32
    }
}

/// How the strokes of a segment are drawn: plain, broken, crossed (shaders/style/strokes.wgsl).
fn kind(label: u16) -> u16 {
    label / 3 % 3
}

fn tissues(image: &Image, sighting: &Sighting) -> BTreeMap<u16, Tissue> {
    let [width, height] = image.size;
    let label = |x: u32, y: u32| sighting.labels[(y * width + x) as usize];
    let mut found = BTreeMap::<u16, Tissue>::new();
    for y in 2..height - 2 {
        for x in 2..width - 2 {
            let Some(own) = label(x, y) else { continue };
            // Outlines are not strokes.
            let inside = (0..25).all(|i| label(x + i % 5 - 2, y + i / 5 - 2) == Some(own));
            if !inside {
                continue;
            }
            let slope_x = f64::from(grey(image, x + 1, y) - grey(image, x - 1, y));
            let slope_y = f64::from(grey(image, x, y + 1) - grey(image, x, y - 1));
            let tissue = found.entry(own).or_default();
            tissue.count += 1.0;
            tissue.grey += f64::from(grey(image, x, y));
            tissue.slopes[0] += slope_x * slope_x;
            tissue.slopes[1] += slope_x * slope_y;
            tissue.slopes[2] += slope_y * slope_y;
        }
    }
    found
}

/// Pixels that two segments have side by side.
fn borders(sighting: &Sighting, size: [u32; 2]) -> BTreeMap<(u16, u16), usize> {
    let label = |x: u32, y: u32| sighting.labels[(y * size[0] + x) as usize];
    let mut found = BTreeMap::new();
    for y in 0..size[1] - 1 {
        for x in 0..size[0] - 1 {
            for next in [label(x + 1, y), label(x, y + 1)] {
                if let (Some(a), Some(b)) = (label(x, y), next)
                    && a != b
                {
                    *found.entry((a.min(b), a.max(b))).or_default() += 1;
                }
            }
        }
    }
    found
}

/// In grey, Ink and Blueprint tell all tissues of the opened knee apart: two that meet along 40 pixels or more differ
/// by 20 of 255 in their mean, or in the kind of their strokes, or in the direction of these by 30 degrees.
#[test]
fn tissues_are_told_apart_without_colour() {
    let studio = studio_of(software(), &builtin("knee", 128), true);
    let size = [480, 360];
    for preset in ["ink", "blueprint"] {
        let shown = illustration(&format!(
            r#""subject":{{"builtin":"knee"}},"look":{{"style":"{preset}"}},
            "camera":{{"rotate":[0.0955,0.0425,0.4045,0.9085],"target":[0.1,0.05,0],"distance":2}},
            "templates":[{{"kind":"flap","at":[0,0.14,0],"rotate":[-0.5,0.5,0.5,0.5],"size":[0.74,0.6,0.42],
            "params":{{"depth":1,"angle":2.2}},"align":{{"to":"segment","keep":["femur","tibia","fibula","patella",
            "cartilage","menisci","ligaments","tendons","arteries","nerves"]}}}}]"#
        ));
        let image = drawn(&studio, &shown, size, 4);
        let sighting = pollster::block_on(studio.identify(&shown, size)).expect("segments");
        let tissues = tissues(&image, &sighting);
        let met = borders(&sighting, size);
        let (mut asked, mut by_grey, mut by_kind, mut by_direction) = (0, 0, 0, 0);
        for ((a, b), length) in met {
            if length < 40 {
                continue;
            }
            // A thread that nowhere is five pixels wide has no inside to compare.
            let (Some(first), Some(second)) = (tissues.get(&a), tissues.get(&b)) else {
                continue;
            };
            if first.count.min(second.count) < 40.0 {
                continue;
            }
            asked += 1;
            let apart = (first.across() - second.across()).abs();
            let turned = apart.min(PI - apart).to_degrees();
            let greys = (first.mean() - second.mean()).abs();
            by_grey += usize::from(greys >= 20.0);
            by_kind += usize::from(kind(a) != kind(b));
            by_direction += usize::from(turned >= 30.0);
            println!(
                "{preset}: {a} and {b}, {length} px: {greys:.0} levels, {turned:.0} degrees, kinds {} and {}",
                kind(a),
                kind(b)
            );
            assert!(
                greys >= 20.0 || kind(a) != kind(b) || turned >= 30.0,
                "{preset}: segments {a} and {b} look alike: {greys:.0} levels, {turned:.0} degrees"
            );
        }
        println!(
            "{preset}: of {asked} borders {by_grey} by grey, {by_kind} by kind, {by_direction} by direction"
        );
        assert!(asked >= 8, "{preset}: only {asked} borders");
    }
}
