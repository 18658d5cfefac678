//! A small picture of the one that is shown, for the list of recent documents.

use crate::app::session::SmallPicture;
use crate::render::{Image, encode_png};

/// Sizes that are tried, the largest first, pixels; the first whose file is short enough is taken.
const SIZES: [[u32; 2]; 3] = [[96, 72], [72, 54], [48, 36]];
/// Bytes of its file at most.
const MOST_BYTES: usize = 6_000;
/// Of each channel only these bits are kept: nobody misses the others at this size, and the file is a third as long.
const KEPT_BITS: u8 = 0xf8;

/// The small picture of the open document, and what of it is under way.
#[derive(Debug, Default)]
pub(crate) struct OpenPicture {
    /// The document, by its number, and the revision and the link that the picture was made of, or is being made of.
    pub of: Option<(u64, u64, String)>,
    /// Since when the picture has not changed, seconds on the clock of the interface.
    pub since: Option<f64>,
    /// As far as one was made.
    pub small: Option<SmallPicture>,
}

impl OpenPicture {
    /// With what was kept from the last time.
    pub(crate) fn kept(text: Option<String>) -> Self {
        Self {
            small: text.as_deref().and_then(SmallPicture::from_text),
            ..Self::default()
        }
    }
}

/// A PNG of the middle of a picture, on white; nothing if there is none that is short enough.
pub(crate) fn small_png(image: &Image) -> Option<Vec<u8>> {
    let mut pngs = SIZES
        .into_iter()
        .filter_map(|size| encode_png(&small(image, size)?).ok());
    pngs.find(|png| png.len() <= MOST_BYTES)
}

/// The largest part of the picture's middle with the proportions of `size`, made as small as that.
fn small(image: &Image, size: [u32; 2]) -> Option<Image> {
    let [width, height] = image.size.map(|side| side as usize);
    let [w, h] = size.map(|side| side as usize);
    let side = (width / w).min(height / h);
    if side == 0 || image.rgba.len() < 4 * width * height {
        return None;
    }
    let corner = [(width - side * w) / 2, (height - side * h) / 2];
    let mut rgba = Vec::with_capacity(4 * w * h);
    for y in 0..h {
        for x in 0..w {
            let mut sum = [0_usize; 3];
            for row in 0..side {
                let at = width * (corner[1] + y * side + row) + corner[0] + x * side;
                for pixel in image.rgba[4 * at..4 * (at + side)].chunks_exact(4) {
                    let alpha = usize::from(pixel[3]);
                    for (sum, channel) in sum.iter_mut().zip(pixel) {
                        *sum += usize::from(*channel) * alpha + 255 * (255 - alpha);
                    }
                }
            }
            let mean = sum.map(|sum| (sum / (255 * side * side)) as u8 & KEPT_BITS);
            // White stays white.
            rgba.extend(mean.map(|channel| channel | channel >> 5));
            rgba.push(255);
        }
    }
    Some(Image { size, rgba })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::decode_png;

    fn picture(size: [u32; 2], color: impl Fn(u32, u32) -> [u8; 4]) -> Image {
        let rows = (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| (x, y)));
        let rgba = rows.flat_map(|(x, y)| color(x, y)).collect();
        Image { size, rgba }
    }

    #[test]
    fn a_small_picture_shows_the_middle_on_white() {
        // A red half and a clear one, on a phone: above and below is something else.
        let shown = picture([960, 2000], |x, y| match (x, y) {
            (_, y) if !(640..1360).contains(&y) => [0, 0, 255, 255],
            (x, _) if x < 480 => [255, 0, 0, 255],
            _ => [0, 0, 0, 0],
        });
        let png = small_png(&shown).expect("a picture");
        let small = decode_png(&png).expect("a PNG");
        assert_eq!(small.size, [96, 72]);
        let at = |x: usize, y: usize| &small.rgba[4 * (96 * y + x)..][..4];
        for y in [0, 71] {
            assert_eq!(
                (at(2, y), at(90, y)),
                (&[255, 0, 0, 255][..], &[255; 4][..])
            );
        }
    }

    #[test]
    fn what_would_be_too_long_is_made_smaller() {
        // Noise of any kind is the longest there is.
        let noise = picture([400, 300], |x, y| {
            let n = (x * 7919 + y * 104_729).wrapping_mul(2_654_435_761);
            [(n >> 8) as u8, (n >> 16) as u8, (n >> 24) as u8, 255]
        });
        if let Some(png) = small_png(&noise) {
            assert!(png.len() <= MOST_BYTES, "{} bytes", png.len());
            assert!(decode_png(&png).expect("a PNG").size[0] < 96);
        }
        assert!(small_png(&picture([20, 20], |_, _| [0; 4])).is_none());
    }
}
