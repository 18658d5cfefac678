//! The soft shadow that an object throws on the paper that it is printed on: as if the paper lay close behind it. It is
//! made of a small picture without a background, and laid under the rows of the large one.

use super::image::Image;
use super::rows::{Rows, Taker, shrunk};
use crate::document::{Background, Light};
use crate::math::{linear_from_srgb, srgb_from_linear};
use crate::render::device::error::RenderError;

/// Pixels along the longer side of the small picture at most: the shadow is soft, a larger one shows no more.
const SMALL_PX: u32 = 512;
/// Samples per pixel of the small picture.
pub(super) const SHADOW_SAMPLES: u32 = 4;
/// How much light the shadow takes at most, 0 to 1.
const DARK: f32 = 0.5;
/// How far the shadow is soft, of the picture's shorter side; and how far behind the object the paper lies.
const SOFT: f32 = 0.02;
const BEHIND: f32 = 0.025;

/// A shadow on paper, for a picture of one size.
#[derive(Clone, Debug)]
pub(super) struct PaperShadow {
    /// Width and height of the small picture, pixels.
    size: [usize; 2],
    /// How much light is taken, 0 to [`DARK`]. Rows from the top.
    dark: Vec<f32>,
    /// Pixels of the small picture for each of the large one.
    scale: [f32; 2],
    /// Width of the large picture, pixels.
    width: u32,
    /// What the shadow falls on.
    background: Background,
}

impl PaperShadow {
    /// Size of the small picture that the shadow for a picture of this size is made of, pixels.
    pub(super) fn small_size(size_px: [u32; 2]) -> [u32; 2] {
        shrunk(size_px, SMALL_PX)
    }

    /// The shadow for a picture of `size_px` on a background, of a small picture without one that has
    /// [`PaperShadow::small_size`].
    pub(super) fn new(
        small: &Image,
        size_px: [u32; 2],
        background: Background,
        light: &Light,
    ) -> Self {
        let size = small.size.map(|side| side as usize);
        let shorter = size[0].min(size[1]) as f32;
        // Away from the light, which the paper faces: y runs upwards there.
        let offset = light.from.truncate() * (BEHIND * shorter / light.from.z.max(0.3));
        let shift = [-offset.x.round() as i64, offset.y.round() as i64];
        let covered = |x: i64, y: i64| {
            let (x, y) = (usize::try_from(x).ok()?, usize::try_from(y).ok()?);
            let is_inside = x < size[0] && y < size[1];
            is_inside.then(|| f32::from(small.rgba[4 * (y * size[0] + x) + 3]) / 255.0 * DARK)
        };
        let mut dark: Vec<f32> = (0..size[1] as i64)
            .flat_map(|y| (0..size[0] as i64).map(move |x| (x, y)))
            .map(|(x, y)| covered(x - shift[0], y - shift[1]).unwrap_or(0.0))
            .collect();
        // Three boxes are nearly a bell curve.
        let radius = (SOFT * shorter).round().max(1.0) as usize;
        for _ in 0..3 {
            dark = smoothed(&dark, size, radius);
        }
        Self {
            size,
            dark,
            scale: [0, 1].map(|i| small.size[i] as f32 / size_px[i].max(1) as f32),
            width: size_px[0],
            background,
        }
    }

    /// How much light the paper lacks at a pixel of the large picture, 0 to 1.
    fn at(&self, x: u32, y: u32) -> f32 {
        let place = |i: usize, pixel: u32| {
            let most = (self.size[i] - 1) as f32;
            let place = ((pixel as f32 + 0.5) * self.scale[i] - 0.5).clamp(0.0, most);
            let first = place as usize;
            (first, (first + 1).min(self.size[i] - 1), place.fract())
        };
        let (left, right, part_x) = place(0, x);
        let (above, below, part_y) = place(1, y);
        let row = |y: usize| {
            let (a, b) = (
                self.dark[y * self.size[0] + left],
                self.dark[y * self.size[0] + right],
            );
            a + (b - a) * part_x
        };
        row(above) + (row(below) - row(above)) * part_y
    }

    /// Lays the shadow and the paper under rows of the picture, which was drawn without a background.
    fn lay_under(&self, rows: &mut Rows) {
        let paper = match self.background {
            Background::None => None,
            Background::Color(color) => Some(color),
        };
        for (index, pixel) in rows.rgba.chunks_exact_mut(4).enumerate() {
            if pixel[3] == 255 {
                continue;
            }
            let index = index as u32;
            let dark = self.at(index % self.width, rows.first + index / self.width);
            let own = f32::from(pixel[3]) / 255.0;
            // What lies below: black on the paper, whose part is `under`.
            let under = if paper.is_some() { 1.0 } else { dark };
            let alpha = own + under * (1.0 - own);
            if alpha <= 0.0 {
                continue;
            }
            for (channel, byte) in pixel[..3].iter_mut().enumerate() {
                let below =
                    paper.map_or(0.0, |paper| linear_from_srgb(paper[channel]) * (1.0 - dark));
                let light = linear_from_srgb(*byte) * own + below * (1.0 - own);
                *byte = srgb_from_linear(f64::from(light / alpha));
            }
            pixel[3] = (alpha * 255.0).round() as u8;
        }
    }
}

/// The means of squares of `2 × radius + 1` values; beyond the borders there is nothing.
fn smoothed(values: &[f32], [width, height]: [usize; 2], radius: usize) -> Vec<f32> {
    let mut found = values.to_vec();
    smooth_lines(&mut found, (width, 1), (height, width), radius);
    smooth_lines(&mut found, (height, width), (width, 1), radius);
    found
}

/// Smooths along lines of so many values, which lie so far apart; so many lines, so far apart.
fn smooth_lines(
    values: &mut [f32],
    (length, step): (usize, usize),
    (lines, apart): (usize, usize),
    radius: usize,
) {
    let part = 1.0 / (2 * radius + 1) as f64;
    let mut line = vec![0.0; length];
    for first in (0..lines).map(|line| line * apart) {
        let value = |i: usize| f64::from(values[first + i * step]);
        let mut sum: f64 = (0..radius.min(length)).map(value).sum();
        for (i, mean) in line.iter_mut().enumerate() {
            if i + radius < length {
                sum += value(i + radius);
            }
            if i > radius {
                sum -= value(i - radius - 1);
            }
            *mean = (sum * part) as f32;
        }
        for (i, mean) in line.iter().enumerate() {
            values[first + i * step] = *mean;
        }
    }
}

/// Rows that get the paper and its shadow before somebody takes them.
#[derive(Debug)]
pub(super) struct OnPaper<T> {
    /// Who takes them.
    pub taker: T,
    pub shadow: PaperShadow,
}

impl<T: Taker> Taker for OnPaper<T> {
    fn progress(&mut self, part: f32) -> Result<(), RenderError> {
        self.taker.progress(part)
    }

    fn take(&mut self, mut rows: Rows) -> Result<(), RenderError> {
        self.shadow.lay_under(&mut rows);
        self.taker.take(rows)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: [u32; 2] = [400, 300];

    /// A picture with a red square in its middle, 100 by 100 of 400 by 300.
    fn square(size: [u32; 2]) -> Image {
        let inside =
            |side: u32, at: u32, half: f32| ((at as f32 + 0.5) / side as f32 - 0.5).abs() < half;
        let rgba = (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| (x, y)));
        let rgba = rgba.flat_map(|(x, y)| {
            let is_inside = inside(size[0], x, 0.125) && inside(size[1], y, 1.0 / 6.0);
            if is_inside { [200, 0, 0, 255] } else { [0; 4] }
        });
        Image {
            size,
            rgba: rgba.collect(),
        }
    }

    fn laid(background: Background, light: &Light, rows_at_once: u32) -> Vec<u8> {
        let small = square(PaperShadow::small_size(SIZE));
        let shadow = PaperShadow::new(&small, SIZE, background, light);
        let whole = square(SIZE);
        let bytes = 4 * (SIZE[0] * rows_at_once) as usize;
        let bands = whole.rgba.chunks(bytes).enumerate();
        let bands = bands.map(|(index, rgba)| {
            let mut rows = Rows {
                first: index as u32 * rows_at_once,
                rgba: rgba.to_vec(),
            };
            shadow.lay_under(&mut rows);
            rows.rgba
        });
        bands.collect::<Vec<_>>().concat()
    }

    fn pixel(rgba: &[u8], x: u32, y: u32) -> [u8; 4] {
        let at = 4 * (y * SIZE[0] + x) as usize;
        [rgba[at], rgba[at + 1], rgba[at + 2], rgba[at + 3]]
    }

    #[test]
    fn the_shadow_lies_away_from_the_light() {
        let light = Light::DOCUMENT_DEFAULT;
        let clear = laid(Background::None, &light, 300);
        assert_eq!(pixel(&clear, 200, 150), [200, 0, 0, 255], "the object");
        assert_eq!(pixel(&clear, 5, 5), [0; 4], "far from it");
        // From the upper left: to the right and below it is dark, black of some alpha.
        let [lit, shaded] = [(147, 97), (253, 203)].map(|(x, y)| pixel(&clear, x, y));
        assert_eq!([lit[0], shaded[0]], [0, 0], "black");
        assert!(shaded[3] > lit[3] + 30, "{lit:?} {shaded:?}");
        let from_right = Light {
            from: glam::Vec3::new(0.6, -0.5, 0.6),
            ..light
        };
        let turned = laid(Background::None, &from_right, 300);
        assert!(pixel(&turned, 147, 97)[3] > pixel(&turned, 253, 203)[3] + 30);
    }

    #[test]
    fn paper_keeps_its_colour_where_nothing_lies() {
        let paper = [240, 230, 210];
        let on_paper = laid(Background::Color(paper), &Light::DOCUMENT_DEFAULT, 300);
        assert_eq!(pixel(&on_paper, 5, 5), [240, 230, 210, 255]);
        let shaded = pixel(&on_paper, 253, 203);
        assert!(shaded[3] == 255 && shaded[0] < 225, "{shaded:?}");
        assert!((0..3).all(|i| shaded[i] <= paper[i]));
    }

    #[test]
    fn bands_are_parts_of_the_whole() {
        let whole = laid(Background::None, &Light::DOCUMENT_DEFAULT, 300);
        assert_eq!(laid(Background::None, &Light::DOCUMENT_DEFAULT, 64), whole);
    }

    #[test]
    fn half_clear_tissue_lies_on_its_shadow() {
        let small = square(PaperShadow::small_size(SIZE));
        let light = Light::DOCUMENT_DEFAULT;
        let shadow = PaperShadow::new(&small, SIZE, Background::Color([255; 3]), &light);
        let mut rows = Rows {
            first: 150,
            rgba: [[200, 0, 0, 128]; 400].concat(),
        };
        shadow.lay_under(&mut rows);
        let [far, near] = [5, 200].map(|x| &rows.rgba[4 * x..4 * x + 4]);
        assert!(far[3] == 255 && near[3] == 255);
        assert!(near[1] + 20 < far[1], "{far:?} {near:?}");
    }
}
