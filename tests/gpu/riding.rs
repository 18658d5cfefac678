//! Hatching rides: through a peel and a turn of the camera the strokes keep their places on the tissue, their tone and
//! their calm.

use crate::gpu::{software, studio_of};
use crate::long::long_or;
use crate::style::{LOOK, WHITE, cuboid, drawn, illustration, solid, squares};
use fabrica::document::Illustration;
use fabrica::render::{Image, RayEvent, Studio, View};
use glam::{IVec3, Mat2, Quat, Vec2, Vec3};
use std::collections::HashMap;

/// Width and height of the pictures, pixels.
const SIDE: u32 = 200;
/// From one stroke to the next at most, thousandths of the picture's side, and in pixels.
const SPACING: u32 = 45;
const SPACING_PX: f32 = (SPACING * SIDE) as f32 / 1000.0;
/// Pictures of the passage from the closed peel to the open one.
const FRAMES: u32 = 5;
/// Side of the squares in which strokes are followed, pixels.
const SQUARE: usize = 20;
/// Side of the cells in which places at rest are looked up, subject units: a little more than a pixel.
const CELL: f32 = 0.02;

/// A box whose top is peeled off while the camera goes round; `strokes` is what the style has beside white paper.
fn scene(strokes: &str, progress: f32) -> Illustration {
    let turn = Quat::from_rotation_z(-0.45 + 0.6 * progress)
        * Quat::from_rotation_x(0.75 - 0.2 * progress);
    let [x, y, z, w] = turn.to_array();
    let look = LOOK
        .replace("#ffffff\"", "none\"")
        .replace("\"color\":\"none\"", "\"color\":\"#a0a0a0\"");
    illustration(&format!(
        r##""look":{{{look},"style":{{{WHITE}{strokes}}}}},
        "camera":{{"rotate":[{x},{y},{z},{w}],"distance":1.9}},
        "templates":[{{"kind":"peel","at":[0,0,0.2],"size":[0.54,0.42,0.2],"params":{{"progress":{progress},"depth":0.4}}}}]"##
    ))
}

/// One moment: its picture, and what each pixel's middle shows.
struct Moment {
    image: Image,
    events: Vec<Option<RayEvent>>,
}

impl Moment {
    fn new(studio: &Studio, strokes: &str, progress: f32) -> Self {
        let shown = scene(strokes, progress);
        let view = View::new(&shown.camera, [SIDE; 2]);
        let pixels = (0..SIDE * SIDE).map(|i| (i % SIDE, i / SIDE));
        let rays: Vec<(Vec3, Vec3)> = pixels
            .map(|(x, y)| view.ray(Vec2::new(x as f32 + 0.5, y as f32 + 0.5)))
            .collect();
        Self {
            image: drawn(studio, &shown, [SIDE; 2], 4),
            events: pollster::block_on(studio.events(&shown, &rays)).expect("events"),
        }
    }

    fn event(&self, x: usize, y: usize) -> Option<&RayEvent> {
        self.events.get(y * SIDE as usize + x)?.as_ref()
    }

    /// Between the middles of pixels, in pixels from the top left; `None` over a border or beyond the picture.
    fn between<T>(&self, at: Vec2, of: impl Fn(usize, usize) -> Option<T>) -> Option<T>
    where
        T: Copy + std::ops::Mul<f32, Output = T> + std::ops::Add<Output = T>,
    {
        let from = at - 0.5;
        if from.min_element() < 0.0 || from.max_element() >= (SIDE - 1) as f32 {
            return None;
        }
        let (x, y) = (from.x as usize, from.y as usize);
        let part = from.fract();
        let above = of(x, y)? * (1.0 - part.x) + of(x + 1, y)? * part.x;
        let below = of(x, y + 1)? * (1.0 - part.x) + of(x + 1, y + 1)? * part.x;
        Some(above * (1.0 - part.y) + below * part.y)
    }

    /// Where the tissue was at rest, rest space.
    fn rest(&self, at: Vec2) -> Option<Vec3> {
        self.between(at, |x, y| Some(self.event(x, y)?.pos_in_rest))
    }

    /// The grey, levels of 255.
    fn grey(&self, at: Vec2) -> Option<f32> {
        self.between(at, |x, y| {
            let pixel = 4 * (y * SIDE as usize + x);
            (self.image.rgba[pixel + 3] == 255).then(|| f32::from(self.image.rgba[pixel]))
        })
    }
}

/// Where the tissue of each pixel of one moment is in the picture of another; `None` where it is not in sight there.
fn ways(one: &Moment, other: &Moment) -> Vec<Option<Vec2>> {
    let cell = |rest: Vec3| (rest / CELL).floor().as_ivec3();
    let mut cells: HashMap<IVec3, Vec<(Vec2, Vec3)>> = HashMap::new();
    for (i, event) in (0..).zip(&other.events) {
        if let Some(event) = event {
            let pixel = Vec2::new((i % SIDE) as f32 + 0.5, (i / SIDE) as f32 + 0.5);
            cells
                .entry(cell(event.pos_in_rest))
                .or_default()
                .push((pixel, event.pos_in_rest));
        }
    }
    let way = |event: &Option<RayEvent>| {
        let rest = event.as_ref()?.pos_in_rest;
        let around = (0..27).map(|i| cell(rest) + IVec3::new(i % 3, i / 3 % 3, i / 9) - 1);
        let near = around.filter_map(|cell| cells.get(&cell)).flatten();
        let (pixel, found) = near.min_by(|a, b| {
            a.1.distance_squared(rest)
                .total_cmp(&b.1.distance_squared(rest))
        })?;
        // From the nearest pixel on by how the places change from pixel to pixel.
        let right = 0.5 * (other.rest(*pixel + Vec2::X)? - other.rest(*pixel - Vec2::X)?);
        let down = 0.5 * (other.rest(*pixel + Vec2::Y)? - other.rest(*pixel - Vec2::Y)?);
        let off = rest - *found;
        let shape = Mat2::from_cols(
            Vec2::new(right.dot(right), right.dot(down)),
            Vec2::new(right.dot(down), down.dot(down)),
        );
        let step = shape.try_inverse()? * Vec2::new(right.dot(off), down.dot(off));
        let there = *pixel + step;
        // What is seen there is that tissue, to a fifth of a pixel.
        let missed = other.rest(there)?.distance(rest);
        (step.length() < 1.5 && missed < 0.2 * right.length().min(down.length())).then_some(there)
    };
    one.events.iter().map(way).collect()
}

/// The strokes of a square in two moments, on the pixels of the first.
struct Strokes {
    /// Across the strokes, unit.
    across: Vec2,
    /// Pixels and where their tissue is in the other moment.
    pixels: Vec<(Vec2, Vec2)>,
}

/// Squares all of whose tissue is in sight in both moments, and has clear strokes.
fn clear_squares(one: &Moment, ways: &[Option<Vec2>]) -> Vec<Strokes> {
    let width = SIDE as usize;
    let mut found = Vec::new();
    for y0 in (1..width - SQUARE - 1).step_by(SQUARE / 2) {
        for x0 in (1..width - SQUARE - 1).step_by(SQUARE / 2) {
            let places = (0..SQUARE * SQUARE).map(|i| (x0 + i % SQUARE, y0 + i / SQUARE));
            let pixels = places.map(|(x, y)| {
                let at = Vec2::new(x as f32 + 0.5, y as f32 + 0.5);
                Some((at, ways[y * width + x]?))
            });
            let Some(pixels) = pixels.collect::<Option<Vec<(Vec2, Vec2)>>>() else {
                continue;
            };
            // The direction in which the grey changes most.
            let changes = pixels.iter().filter_map(|(at, _)| {
                let right = one.grey(*at + Vec2::X)? - one.grey(*at - Vec2::X)?;
                let down = one.grey(*at + Vec2::Y)? - one.grey(*at - Vec2::Y)?;
                Some(0.5 * Vec2::new(right, down))
            });
            let (mut doubled, mut all) = (Vec2::ZERO, 0.0);
            for change in changes {
                doubled += Vec2::new(
                    change.x * change.x - change.y * change.y,
                    2.0 * change.x * change.y,
                );
                all += change.length_squared();
            }
            let is_clear = doubled.length() > 0.4 * all && all > 100.0 * pixels.len() as f32;
            if is_clear {
                let across = Vec2::from_angle(0.5 * doubled.to_angle());
                found.push(Strokes { across, pixels });
            }
        }
    }
    found
}

/// How far the strokes of a square have moved against their tissue, pixels: what shift brings those of the other
/// moment, carried back to the pixels of the first, into line with these. `None` if none does. `push` moves them on
/// purpose.
fn moved(one: &Moment, other: &Moment, strokes: &Strokes, push: f32) -> Option<f32> {
    let likeness = |shift: f32| -> Option<f32> {
        let along = strokes.across * shift;
        let pairs = strokes.pixels.iter().map(|&(at, there)| {
            let from = at + along + strokes.across * push;
            Some((one.grey(from)?, other.grey(there)?))
        });
        let pairs: Vec<(f32, f32)> = pairs.collect::<Option<_>>()?;
        let count = pairs.len() as f32;
        let (a, b) = pairs
            .iter()
            .fold((0.0, 0.0), |(a, b), pair| (a + pair.0, b + pair.1));
        let (a, b) = (a / count, b / count);
        let (mut both, mut ones, mut others) = (0.0, 0.0, 0.0);
        for (p, q) in pairs {
            both += (p - a) * (q - b);
            ones += (p - a).powi(2);
            others += (q - b).powi(2);
        }
        Some(both / (ones * others).sqrt().max(1e-6))
    };
    // Less than half the way to the next stroke of those that have faded in.
    let most = (0.22 * SPACING_PX / 0.1) as i32;
    let shifts = (-most..=most).map(|i| 0.1 * i as f32);
    let best = shifts
        .filter_map(|shift| Some((shift, likeness(shift)?)))
        .max_by(|a, b| a.1.total_cmp(&b.1))?;
    (best.1 > 0.5).then_some(best.0)
}

fn hatch(by: &str) -> String {
    format!(r##","hatch":{{"spacing":{SPACING},"width":4,"color":"#000000","by":"{by}"}}"##)
}

/// Strokes so fine that they are their mean: the tone alone.
const SHADING: &str = r##","hatch":{"spacing":2,"width":0.2,"color":"#000000","by":"axis"}"##;

/// Followed from picture to picture, and from the first to the last, through a peel from 0 to 1 while the camera turns,
/// strokes move against their tissue by less than a pixel.
#[test]
fn strokes_keep_their_places_through_a_peel_and_a_turn() {
    let studio = studio_of(software(), &solid(cuboid, |_| 1, &["box"]), true);
    for by in long_or(&["axis", "curvature"][..], &["axis"]) {
        let strokes = hatch(by);
        let progress = (0..FRAMES).map(|i| i as f32 / (FRAMES - 1) as f32);
        let moments: Vec<Moment> = progress
            .map(|p| Moment::new(&studio, &strokes, p))
            .collect();
        let mut pairs: Vec<(usize, usize)> = (1..moments.len()).map(|i| (i - 1, i)).collect();
        pairs.push((0, moments.len() - 1));
        let (mut shifts, mut lost, mut pushed) = (Vec::new(), 0, Vec::new());
        for (i, k) in pairs {
            let (one, other) = (&moments[i], &moments[k]);
            let found = clear_squares(one, &ways(one, other));
            println!("{by}, {i} to {k}: {} squares", found.len());
            for strokes in &found {
                match moved(one, other, strokes, 0.0) {
                    Some(shift) => shifts.push(shift.abs()),
                    None => lost += 1,
                }
                pushed.extend(moved(one, other, strokes, 1.5));
            }
        }
        let mean = |shifts: &[f32]| shifts.iter().sum::<f32>() / shifts.len() as f32;
        let worst = shifts.iter().copied().fold(0.0, f32::max);
        println!(
            "{by}: {} squares, {lost} lost, {:.2} px in the mean, {worst:.2} at most; pushed by 1.5: {:.2}",
            shifts.len(),
            mean(&shifts),
            mean(&pushed)
        );
        assert!(shifts.len() > 30, "{} squares", shifts.len());
        assert!(worst < 1.0, "{worst} px");
        // Where strokes fade in or out, those of a square may be others than before.
        assert!(lost * 5 < shifts.len(), "{lost} lost of {}", shifts.len());
        // Negative control: strokes that lie 1.5 pixels beside are found there.
        assert!((mean(&pushed) + 1.5).abs() < 0.5, "{}", mean(&pushed));
    }
}

/// In squares of 16 and of 32 pixels, as large as what a tone is told by, neighbouring pictures of a passage differ at
/// most twice as much as with shading alone, and the mean grey follows the tone. Pixel by pixel they differ by more:
/// strokes go with the tissue.
#[test]
fn hatching_is_as_calm_as_its_tone() {
    let studio = studio_of(software(), &solid(cuboid, |_| 1, &["box"]), true);
    // Two pictures of the thirty a second of a passage of 1.5 seconds.
    let pair = |strokes: &str| {
        let shown = [0.5, 0.5 + 1.0 / 45.0].map(|progress| scene(strokes, progress));
        shown.map(|shown| drawn(&studio, &shown, [SIDE; 2], 4))
    };
    let (hatched, shaded) = (pair(&hatch("axis")), pair(SHADING));
    let covered = |image: &Image| -> Vec<bool> {
        let pixels = image.rgba.chunks_exact(4);
        pixels.map(|pixel| pixel[3] == 255).collect()
    };
    let both: Vec<bool> = covered(&hatched[0])
        .iter()
        .zip(covered(&hatched[1]))
        .map(|(a, b)| *a && b)
        .collect();
    for block in [1, 16, 32] {
        let [ours, tone] = [&hatched, &shaded].map(|pair| difference(pair, &both, block));
        println!("squares of {block}: {ours:.2} levels with strokes, {tone:.2} of the tone alone");
        if block > 1 {
            assert!(
                ours <= 2.0 * tone,
                "squares of {block}: {ours:.2} and {tone:.2}"
            );
        }
    }
    let covered = covered(&hatched[0]);
    let tones = squares(&shaded[0], &covered);
    assert!(tones.len() > 6, "{} squares", tones.len());
    let off = squares(&hatched[0], &covered).into_iter().zip(tones);
    let worst = off
        .map(|(ours, tone)| (ours.1 - tone.1).abs())
        .fold(0.0, f64::max);
    println!("the tone is {worst:.3} off");
    assert!(worst <= 0.1, "the tone is {worst:.3} off");
}

/// How much the means of squares differ between two pictures in the mean, levels of 255. Only the pixels that count,
/// and squares that have at least half of theirs.
fn difference([one, other]: &[Image; 2], counts: &[bool], block: usize) -> f64 {
    let side = SIDE as usize;
    let (mut sum, mut blocks) = (0.0, 0);
    for y0 in (0..side - block + 1).step_by(block) {
        for x0 in (0..side - block + 1).step_by(block) {
            let places = (0..block * block).map(|i| (y0 + i / block) * side + x0 + i % block);
            let ways = places
                .filter(|at| counts[*at])
                .map(|at| f64::from(one.rgba[4 * at]) - f64::from(other.rgba[4 * at]));
            let ways: Vec<f64> = ways.collect();
            if 2 * ways.len() >= block * block {
                sum += (ways.iter().sum::<f64>() / ways.len() as f64).abs();
                blocks += 1;
            }
        }
    }
    sum / f64::from(blocks.max(1))
}
