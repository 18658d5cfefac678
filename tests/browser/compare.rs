//! How far two pictures are apart.

use image::RgbaImage;

/// Differences over the pixels that are not background in at least one of two pictures, in 255ths.
#[derive(Debug)]
pub(crate) struct Difference {
    /// Pixels compared.
    pub(crate) count: usize,
    /// Largest mean of a channel.
    pub(crate) mean: f64,
    /// Largest 99.9th percentile of a channel.
    pub(crate) percentile: u8,
    /// Largest.
    pub(crate) max: u8,
}

/// Compares channel by channel; the background is the colour given.
pub(crate) fn difference(a: &RgbaImage, b: &RgbaImage, background: [u8; 3]) -> Difference {
    assert_eq!(a.dimensions(), b.dimensions(), "pictures of one size");
    let mut channels: [Vec<u8>; 3] = Default::default();
    for (p, q) in a.pixels().zip(b.pixels()) {
        let is_background = |p: &image::Rgba<u8>| p.0.iter().zip(background).all(|(x, y)| *x == y);
        if is_background(p) && is_background(q) {
            continue;
        }
        for (channel, (x, y)) in channels.iter_mut().zip(p.0.iter().zip(q.0)) {
            channel.push(x.abs_diff(y));
        }
    }
    let count = channels[0].len();
    let mut found = Difference {
        count,
        mean: 0.0,
        percentile: 0,
        max: 0,
    };
    for channel in &mut channels {
        channel.sort_unstable();
        let sum: f64 = channel.iter().copied().map(f64::from).sum();
        found.mean = found.mean.max(sum / count.max(1) as f64);
        let at = (count as f64 * 0.999).floor() as usize;
        found.percentile = found.percentile.max(
            channel
                .get(at.min(count.saturating_sub(1)))
                .copied()
                .unwrap_or(0),
        );
        found.max = found.max.max(channel.last().copied().unwrap_or(0));
    }
    found
}

/// The part of a page's picture that shows the object: what lies between the panels of the wide layout.
pub(crate) fn object_part(page: &RgbaImage) -> RgbaImage {
    let (left, right, top) = (300, 320, 80);
    let bottom = 150;
    let (w, h) = page.dimensions();
    image::imageops::crop_imm(page, left, top, w - left - right, h - top - bottom).to_image()
}

/// Pixels that are neither white nor nearly so.
pub(crate) fn drawn_pixels(picture: &RgbaImage) -> usize {
    picture
        .pixels()
        .filter(|p| p.0[..3].iter().any(|c| *c < 235))
        .count()
}
