//! The palette of a picture: 256 colours that stand for all. It needs nothing of the other commands, so that the fast
//! tests hold it too.

use std::collections::BTreeMap;

use glam::{Vec3, Vec4};

/// Colours of a palette at most.
const COLORS: usize = 256;

/// One pixel: red, green, blue, alpha; straight.
pub(crate) type Rgba = [u8; 4];

/// The colours that stand for all of a picture, and which of them stands for each colour. Boxes of colours are cut at
/// their means, the box with the largest error first (after Heckbert 1982, median cut); then each colour goes to the
/// nearest of the palette, and each of the palette to the mean of its own, a few times.
pub(crate) fn palette(pixels: &[Rgba]) -> (Vec<Rgba>, BTreeMap<Rgba, u8>) {
    const ROUNDS: usize = 6;
    let mut counts: BTreeMap<Rgba, f32> = BTreeMap::new();
    for pixel in pixels {
        *counts.entry(*pixel).or_default() += 1.0;
    }
    let colors = counts.into_iter().map(|(color, count)| Color {
        place: place(color),
        color,
        count,
    });
    let mut boxes = vec![Cluster::new(colors.collect())];
    while boxes.len() < COLORS {
        let worst = (0..boxes.len()).max_by(|a, b| boxes[*a].error.total_cmp(&boxes[*b].error));
        match worst {
            Some(worst) if boxes[worst].error > 0.0 => {
                let halves = boxes.swap_remove(worst).cut();
                boxes.extend(halves);
            }
            _ => break,
        }
    }
    let mut palette: Vec<Vec4> = boxes.iter().map(|cluster| cluster.mean).collect();
    let nearest = |palette: &[Vec4], place: Vec4| {
        let distance = |i: &usize| palette[*i].distance_squared(place);
        let found = (0..palette.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)));
        found.unwrap_or_default()
    };
    let colors: Vec<Color> = boxes
        .into_iter()
        .flat_map(|cluster| cluster.colors)
        .collect();
    for _ in 0..ROUNDS {
        let mut sums = vec![(Vec4::ZERO, 0.0); palette.len()];
        for color in &colors {
            let (sum, count) = &mut sums[nearest(&palette, color.place)];
            *sum += color.place * color.count;
            *count += color.count;
        }
        for (entry, (sum, count)) in palette.iter_mut().zip(sums) {
            if count > 0.0 {
                *entry = sum / count;
            }
        }
    }
    let index_of = colors
        .iter()
        .map(|color| (color.color, nearest(&palette, color.place) as u8));
    let index_of = index_of.collect();
    (palette.into_iter().map(color_at).collect(), index_of)
}

/// A colour, and how many pixels have it.
struct Color {
    place: Vec4,
    color: Rgba,
    count: f32,
}

/// Where a colour lies among the colours: premultiplied, so that clear ones are all alike; 0 to 255.
fn place([r, g, b, a]: Rgba) -> Vec4 {
    let [r, g, b, a] = [r, g, b, a].map(f32::from);
    (Vec3::new(r, g, b) * (a / 255.0)).extend(a)
}

/// The colour at a place; see [`place`].
fn color_at(place: Vec4) -> Rgba {
    let straight = place.truncate() * (255.0 / place.w.max(1.0));
    straight
        .extend(place.w)
        .to_array()
        .map(|c| c.round().clamp(0.0, 255.0) as u8)
}

/// Colours that one of the palette may stand for.
struct Cluster {
    colors: Vec<Color>,
    mean: Vec4,
    /// Sum of the squared distances from the mean, along each axis.
    spread: Vec4,
    /// Sum of the squared distances from the mean.
    error: f32,
}

impl Cluster {
    fn new(colors: Vec<Color>) -> Self {
        let count: f32 = colors.iter().map(|color| color.count).sum();
        let sum: Vec4 = colors.iter().map(|color| color.place * color.count).sum();
        let mean = sum / count.max(1.0);
        let away = |color: &Color| (color.place - mean).powf(2.0) * color.count;
        let spread: Vec4 = match colors.as_slice() {
            // What rounding leaves is no spread.
            [_] => Vec4::ZERO,
            _ => colors.iter().map(away).sum(),
        };
        Self {
            mean,
            spread,
            error: spread.element_sum(),
            colors,
        }
    }

    /// Cuts it at the mean of the axis along which it is longest.
    fn cut(self) -> [Self; 2] {
        let axis = self.spread.max_position();
        let is_low = |color: &Color| color.place[axis] < self.mean[axis];
        let (low, high) = self.colors.into_iter().partition(is_low);
        [Self::new(low), Self::new(high)]
    }
}
