//! Title and credit written into a picture that leaves the program: the title at its upper left, the credit at its lower left,
//! in ink or white as the background wants, with a halo of the other so that they read over tissue.

use egui::text::{LayoutJob, TextWrapping};
use egui::{Align, Color32, Context, FontId, RawInput, TextFormat};

use super::theme;
use crate::document::{Background, Illustration};
use crate::render::Image;

/// Height of the title's letters, of the picture's shorter side, and of the credit's.
const TITLE: f32 = 0.045;
const CREDIT: f32 = 0.024;
/// Pixels of letters at least: below nobody reads them.
const LEAST: f32 = 9.0;
/// Distance from the edges, of the shorter side.
const MARGIN: f32 = 0.035;
/// Radius of the halo, of the letters' height.
const HALO: f32 = 0.14;

/// How much of each pixel letters cover, 0 to 255.
struct Mask {
    size: [usize; 2],
    coverage: Vec<u8>,
}

/// Writes an illustration's title and credit into its picture. Returns the characters that no font at hand has.
pub fn letter(image: &mut Image, illustration: &Illustration) -> String {
    let ctx = Context::default();
    theme::install(&ctx);
    // Fonts are there from the first pass on.
    ctx.run_ui(RawInput::default(), |_| {})
        .textures_delta
        .clear();
    letter_with(&ctx, image, illustration)
}

/// The same with the fonts of a window, which has more of them.
pub(crate) fn letter_with(ctx: &Context, image: &mut Image, illustration: &Illustration) -> String {
    let [width, height] = image.size.map(|side| side as f32);
    let short = width.min(height);
    let margin = MARGIN * short;
    let is_dark = match illustration.look.background {
        Background::Color([r, g, b]) => Color32::from_rgb(r, g, b).intensity() < 0.45,
        Background::None => false,
    };
    let (ink, halo) = if is_dark {
        ([255; 3], [0; 3])
    } else {
        ([0x1f, 0x24, 0x26], [255; 3])
    };
    let mut missing = String::new();
    let texts = [
        (&illustration.title, TITLE, theme::STRONG, false),
        (&illustration.credit, CREDIT, "", true),
    ];
    for (text, part, family, is_at_foot) in texts {
        if text.trim().is_empty() {
            continue;
        }
        let letters = (part * short).max(LEAST);
        let mut mask = Mask {
            size: image.size.map(|side| side as usize),
            coverage: vec![0; image.size[0] as usize * image.size[1] as usize],
        };
        let room = [width - 2.0 * margin, 0.4 * height];
        missing += &mask.write(ctx, text, family, letters, margin, room, is_at_foot);
        let wide = mask.widened((HALO * letters).max(1.0));
        blend(image, &wide, halo, 0.8);
        blend(image, &mask, ink, 1.0);
    }
    missing
}

impl Mask {
    /// Writes a text of a height in pixels from the left margin on, at the top or the foot.
    #[expect(clippy::too_many_arguments, reason = "one call, each named at it")]
    fn write(
        &mut self,
        ctx: &Context,
        text: &str,
        family: &str,
        letters_px: f32,
        margin_px: f32,
        room_px: [f32; 2],
        is_at_foot: bool,
    ) -> String {
        let ppp = ctx.pixels_per_point();
        let font = match family {
            "" => FontId::proportional(letters_px / ppp),
            _ => theme::strong_font(letters_px / ppp),
        };
        let mut job = LayoutJob::single_section(
            text.trim().to_owned(),
            TextFormat::simple(font.clone(), Color32::WHITE),
        );
        job.wrap = TextWrapping {
            max_width: room_px[0] / ppp,
            max_rows: ((room_px[1] / (1.25 * letters_px)) as usize).max(1),
            ..TextWrapping::default()
        };
        job.halign = Align::LEFT;
        let (galley, atlas, missing) = ctx.fonts_mut(|fonts| {
            let missing: String = text
                .chars()
                .filter(|c| !c.is_whitespace() && !fonts.has_glyph(&font, *c))
                .collect();
            let galley = fonts.layout_job(job);
            (galley, fonts.image(), missing)
        });
        let top = if is_at_foot {
            self.size[1] as f32 - margin_px - galley.size().y * ppp
        } else {
            margin_px
        };
        for row in &galley.rows {
            for glyph in row.glyphs.iter().filter(|g| !g.uv_rect.is_nothing()) {
                let at = (row.pos.to_vec2() + glyph.pos.to_vec2() + glyph.uv_rect.offset) * ppp;
                let left = (margin_px + at.x).round() as i64;
                let top = (top + at.y).round() as i64;
                let [from, to] = [glyph.uv_rect.min, glyph.uv_rect.max];
                for v in from[1]..to[1] {
                    for u in from[0]..to[0] {
                        let texel = atlas
                            .pixels
                            .get(usize::from(v) * atlas.size[0] + usize::from(u));
                        let x = left + i64::from(u - from[0]);
                        let y = top + i64::from(v - from[1]);
                        self.cover(x, y, texel.map_or(0, Color32::a));
                    }
                }
            }
        }
        missing
    }

    fn cover(&mut self, x: i64, y: i64, coverage: u8) {
        let [width, height] = self.size.map(|side| side as i64);
        if (0..width).contains(&x)
            && (0..height).contains(&y)
            && let Some(pixel) = self.coverage.get_mut((y * width + x) as usize)
        {
            *pixel = (*pixel).max(coverage);
        }
    }

    /// Letters made wider all around, fading out.
    fn widened(&self, radius: f32) -> Self {
        let mut wide = Self {
            size: self.size,
            coverage: vec![0; self.coverage.len()],
        };
        let reach = radius.ceil() as i64;
        let mut brush = Vec::new();
        for dy in -reach..=reach {
            for dx in -reach..=reach {
                let distance = ((dx * dx + dy * dy) as f32).sqrt();
                let weight = (1.0 - distance / (radius + 1.0)).clamp(0.0, 1.0);
                if weight > 0.0 {
                    brush.push((dx, dy, weight.sqrt()));
                }
            }
        }
        let width = self.size[0].max(1);
        let covered = self.coverage.iter().enumerate().filter(|(_, c)| **c > 0);
        for (index, coverage) in covered {
            let (x, y) = ((index % width) as i64, (index / width) as i64);
            for &(dx, dy, weight) in &brush {
                wide.cover(x + dx, y + dy, (f32::from(*coverage) * weight) as u8);
            }
        }
        wide
    }
}

/// Lays a colour over the picture where the mask covers it. Straight alpha, in sRGB as everything that is drawn over it.
fn blend(image: &mut Image, mask: &Mask, color: [u8; 3], opacity: f32) {
    for (pixel, coverage) in image.rgba.chunks_exact_mut(4).zip(&mask.coverage) {
        if *coverage == 0 {
            continue;
        }
        let over = f32::from(*coverage) / 255.0 * opacity;
        let below = f32::from(pixel[3]) / 255.0 * (1.0 - over);
        let alpha = over + below;
        for (channel, ink) in pixel.iter_mut().zip(color) {
            let mixed = f32::from(ink) * over + f32::from(*channel) * below;
            *channel = (mixed / alpha.max(1e-6)).round() as u8;
        }
        pixel[3] = (alpha * 255.0).round() as u8;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::Document;

    fn lettered(json: &str, size: [u32; 2], pixel: [u8; 4]) -> (Image, String) {
        let document = Document::from_json(json).expect("a document");
        let count = size[0] as usize * size[1] as usize;
        let mut image = Image {
            size,
            rgba: pixel.repeat(count),
        };
        let missing = letter(&mut image, document.illustration());
        (image, missing)
    }

    fn dark_pixels(image: &Image, rows: std::ops::Range<usize>) -> usize {
        let stride = image.size[0] as usize * 4;
        let part = &image.rgba[rows.start * stride..rows.end * stride];
        part.chunks_exact(4)
            .filter(|p| p[0] < 90 && p[3] > 200)
            .count()
    }

    #[test]
    fn title_stands_above_and_credit_below() {
        let json = r#"{"fabrica":1,"title":"Craniotomy","credit":"A. Author"}"#;
        let (image, missing) = lettered(json, [400, 300], [255; 4]);
        assert_eq!(missing, "");
        let (top, middle, foot) = (
            dark_pixels(&image, 0..60),
            dark_pixels(&image, 60..250),
            dark_pixels(&image, 250..300),
        );
        assert!(top > 100 && foot > 30, "{top} {foot}");
        assert_eq!(middle, 0, "nothing between");
        let (nothing, _) = lettered(r#"{"fabrica":1}"#, [40, 30], [7; 4]);
        assert!(
            nothing.rgba.iter().all(|byte| *byte == 7),
            "no text, no change"
        );
    }

    #[test]
    fn letters_have_a_halo_and_stand_on_nothing() {
        let json = r#"{"fabrica":1,"title":"Skull","look":{"background":"none"}}"#;
        let (image, _) = lettered(json, [200, 150], [0; 4]);
        let white = image
            .rgba
            .chunks_exact(4)
            .filter(|p| p[0] > 240 && p[3] > 40)
            .count();
        assert!(white > 100, "a light halo on the empty ground: {white}");
        let corner = &image.rgba[image.rgba.len() - 4..];
        assert_eq!(corner, [0; 4], "the rest stays empty");
    }

    #[test]
    fn strange_texts_and_sizes_are_no_harm() {
        let long = "word ".repeat(2000);
        let json = format!(r#"{{"fabrica":1,"title":"{long}","credit":"颅骨 \u0000\n\n"}}"#);
        for size in [[1, 1], [3, 200], [640, 40]] {
            let (_, missing) = lettered(&json, size, [255; 4]);
            assert!(
                missing.contains('颅'),
                "what is missing is named: {missing}"
            );
        }
    }
}
