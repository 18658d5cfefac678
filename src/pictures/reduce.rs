//! Smaller copies of pictures, made in linear light.

use std::sync::LazyLock;

use super::picture::Picture;
use crate::math::linear_from_srgb;

/// The sRGB curve backwards, in a table: a picture has millions of values.
struct Curve {
    /// Linear light from which on the next byte is the nearest.
    borders: [f32; 255],
}

static CURVE: LazyLock<Curve> = LazyLock::new(|| {
    let borders = std::array::from_fn(|byte| {
        let between = (byte as f64 + 0.5) / 255.0;
        match between <= 0.04045 {
            true => (between / 12.92) as f32,
            false => libm::pow((between + 0.055) / 1.055, 2.4) as f32,
        }
    });
    Curve { borders }
});

impl Curve {
    fn byte(&self, linear: f32) -> u8 {
        self.borders.partition_point(|border| *border <= linear) as u8
    }
}

/// The pixels that each pixel of a shorter row covers: the first, and how much of each.
fn covers(from: u32, to: u32) -> Vec<(usize, Vec<f32>)> {
    let (from, to) = (u64::from(from), u64::from(to));
    let one = |index: u64| {
        // In parts of from × to of the row.
        let (start, end) = (index * from, (index + 1) * from);
        let (first, last) = (start / to, (end - 1) / to);
        let weight = |pixel: u64| {
            let (low, high) = (start.max(pixel * to), end.min((pixel + 1) * to));
            (high - low) as f32 / from as f32
        };
        (first as usize, (first..=last).map(weight).collect())
    };
    (0..to).map(one).collect()
}

/// The picture in a smaller size: each pixel is the mean of the area that it covers, by area and alpha, in linear
/// light. No side of the new size is 0 or above the picture's.
pub fn reduced(picture: &Picture, size: [u32; 2]) -> Picture {
    let curve = &*CURVE;
    let [columns, rows] = [0, 1].map(|axis| {
        let from = picture.size[axis];
        covers(from, size[axis].clamp(1, from))
    });
    let width = picture.size[0] as usize;
    let mut pixels = Vec::with_capacity(columns.len() * rows.len());
    for (top, heights) in &rows {
        for (left, widths) in &columns {
            let (mut light, mut cover) = ([0.0_f32; 3], 0.0_f32);
            for (y, height) in heights.iter().enumerate() {
                let start = (top + y) * width + left;
                let row = &picture.pixels[start..start + widths.len()];
                for ([r, g, b, a], part) in row.iter().zip(widths) {
                    let weight = height * part * f32::from(*a);
                    cover += weight;
                    for (sum, byte) in light.iter_mut().zip([r, g, b]) {
                        *sum += linear_from_srgb(*byte) * weight;
                    }
                }
            }
            let [r, g, b] = light.map(|sum| curve.byte(sum / cover.max(f32::MIN_POSITIVE)));
            pixels.push([r, g, b, (cover.round() as u32).min(255) as u8]);
        }
    }
    Picture {
        size: [columns.len() as u32, rows.len() as u32],
        pixels,
        is_of_inks: picture.is_of_inks,
    }
}

/// The picture with half as many pixels along each side, rounded down, at least 1.
pub fn halved(picture: &Picture) -> Picture {
    reduced(picture, picture.size.map(|side| (side / 2).max(1)))
}

/// The picture and copies of it, each half as large as the one before, down to a single pixel.
pub fn smaller_copies(picture: Picture) -> Vec<Picture> {
    let mut copies = vec![picture];
    while let Some(last) = copies.last().filter(|last| last.size != [1, 1]) {
        copies.push(halved(last));
    }
    copies
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::srgb_from_linear;

    fn gray(size: [u32; 2], values: &[u8]) -> Picture {
        Picture {
            size,
            pixels: values.iter().map(|&v| [v, v, v, 255]).collect(),
            is_of_inks: false,
        }
    }

    fn first_channel(picture: &Picture) -> Vec<u8> {
        picture.pixels.iter().map(|pixel| pixel[0]).collect()
    }

    #[test]
    fn means_are_of_light() {
        let half = halved(&gray([2, 2], &[0, 255, 255, 0]));
        assert_eq!((half.size, first_channel(&half)), ([1, 1], vec![188]));
        // A third of the width is one pixel and a half.
        let third = reduced(&gray([3, 1], &[255, 0, 0]), [2, 1]);
        let light = srgb_from_linear(2.0 / 3.0);
        assert_eq!(first_channel(&third), [light, 0]);
        let same = gray([3, 2], &[1, 2, 3, 40, 150, 255]);
        assert_eq!(reduced(&same, [3, 2]), same);
        assert_eq!(reduced(&same, [9, 9]), same, "nothing is made larger");
        let sizes: Vec<_> = (smaller_copies(gray([5, 2], &[9; 10])).iter())
            .map(|copy| (copy.size, copy.pixels.iter().all(|p| *p == [9, 9, 9, 255])))
            .collect();
        assert_eq!(sizes, [([5, 2], true), ([2, 1], true), ([1, 1], true)]);
    }

    #[test]
    fn what_is_clear_has_no_colour() {
        let mut picture = gray([2, 1], &[200, 10]);
        picture.pixels[1][3] = 0;
        assert_eq!(halved(&picture).pixels, [[200, 200, 200, 128]]);
        picture.make_opaque();
        assert_eq!(halved(&picture).pixels[0][3], 255);
    }

    #[test]
    fn the_table_is_the_curve() {
        for step in 0..=4000 {
            let linear = step as f32 / 4000.0;
            let off =
                i32::from(CURVE.byte(linear)) - i32::from(srgb_from_linear(f64::from(linear)));
            // One on the border itself may fall to either side.
            let byte = usize::from(CURVE.byte(linear));
            let is_border = (byte.saturating_sub(1)..=byte)
                .filter_map(|border| CURVE.borders.get(border))
                .any(|border| (border - linear).abs() < 1e-6);
            assert!(off == 0 || is_border, "{linear}");
        }
    }
}
