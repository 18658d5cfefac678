//! Title, credit and captions written into a picture that leaves the program: the title at its upper left, the credit
//! at its lower left, captions at its sides, in ink or white as the background wants, with a halo of the other so
//! that they read over tissue.

use egui::text::{LayoutJob, TextWrapping};
use egui::{Align, Color32, Context, FontId, Galley, Pos2, RawInput, Rect, TextFormat, Vec2, vec2};
use std::sync::Arc;

use super::caption_layout::{self, is_dark};
use crate::app::kit::theme;
use crate::document::Illustration;
use crate::render::{CaptionPlace, Image, View};

/// Height of the title's letters, of the picture's shorter side, and of the credit's.
const TITLE: f32 = 0.045;
const CREDIT: f32 = 0.024;
/// Height of a caption's letters, of the picture's shorter side; and its greatest width, of the picture's width.
const CAPTION: f32 = 0.03;
const CAPTION_WIDTH: f32 = 0.24;
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

/// Writes an illustration's title, credit and captions into its picture. `captions` holds the place of each caption.
/// Returns the characters that no font at hand has.
pub fn letter(image: &mut Image, illustration: &Illustration, captions: &[CaptionPlace]) -> String {
    let ctx = Context::default();
    theme::install(&ctx);
    // Fonts are there from the first pass on.
    ctx.run_ui(RawInput::default(), |_| {})
        .textures_delta
        .clear();
    letter_with(&ctx, image, illustration, captions)
}

/// Writes the texts like [`letter`], with the fonts of a window, which has more of them.
pub(crate) fn letter_with(
    ctx: &Context,
    image: &mut Image,
    illustration: &Illustration,
    captions: &[CaptionPlace],
) -> String {
    let [width, height] = image.size.map(|side| side as f32);
    let short = width.min(height);
    let margin = MARGIN * short;
    let (ink, halo) = if is_dark(illustration.look.background) {
        ([255; 3], [0; 3])
    } else {
        ([0x1f, 0x24, 0x26], [255; 3])
    };
    let mut missing = String::new();
    let mut free = Rect::from_min_size(Pos2::ZERO, vec2(width, height)).shrink(margin);
    let texts = [
        (&illustration.title, TITLE, theme::STRONG, false),
        (&illustration.credit, CREDIT, "", true),
    ];
    for (text, part, family, is_at_foot) in texts {
        if text.trim().is_empty() {
            continue;
        }
        let letters = (part * short).max(LEAST);
        let rows = 0.4 * height / (1.25 * letters);
        let room = width - 2.0 * margin;
        let (galley, size, lacking) = laid_out(ctx, text, family, letters, room, rows as usize);
        missing += &lacking;
        let mut at = free.left_top();
        if is_at_foot {
            at.y = free.bottom() - size.y;
            free.max.y = at.y - margin;
        } else {
            free.min.y = at.y + size.y + margin;
        }
        let mut mask = Mask::new(image.size);
        mask.write(ctx, &galley, at);
        mask.lay(image, letters, ink, halo);
    }
    let view = View::new(&illustration.camera, image.size);
    let letters = (CAPTION * short).max(LEAST);
    let mut mask = Mask::new(image.size);
    let (mut points, mut texts) = (Vec::new(), Vec::new());
    for (caption, place) in illustration.captions.iter().zip(captions) {
        let seen = place.and_then(|(pos, hidden)| Some((view.pixel_from_subject(pos)?, hidden)));
        let Some((at, is_hidden)) =
            seen.filter(|_| caption.enabled && !caption.text.trim().is_empty())
        else {
            continue;
        };
        let at = Pos2::new(at.x, at.y);
        if !Rect::from_min_size(Pos2::ZERO, vec2(width, height)).contains(at) {
            continue;
        }
        let room = CAPTION_WIDTH * width;
        let (galley, size, lacking) =
            laid_out(ctx, &caption.text, "", letters, room, caption_layout::ROWS);
        missing += &lacking;
        points.push(at);
        texts.push((galley, size, is_hidden));
    }
    let sizes: Vec<Vec2> = texts.iter().map(|(_, size, _)| *size).collect();
    let places = caption_layout::arranged(&points, &sizes, 0.3 * letters, free);
    for (((galley, _, is_hidden), at), rect) in texts.iter().zip(&points).zip(places) {
        mask.write(ctx, galley, rect.min);
        mask.line(
            caption_layout::line_start(rect, *at, 0.3 * letters),
            *at,
            0.1 * letters,
        );
        mask.line(*at, *at, if *is_hidden { 0.12 } else { 0.26 } * letters);
    }
    if !texts.is_empty() {
        mask.lay(image, letters, ink, halo);
    }
    missing
}

/// Lays a text out, wrapped, with letters of a height in pixels. Returns the layout, its size in pixels, and the
/// characters that the font lacks.
fn laid_out(
    ctx: &Context,
    text: &str,
    family: &str,
    letters_px: f32,
    room_px: f32,
    rows: usize,
) -> (Arc<Galley>, Vec2, String) {
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
        max_width: room_px / ppp,
        max_rows: rows.max(1),
        ..TextWrapping::default()
    };
    job.halign = Align::LEFT;
    ctx.fonts_mut(|fonts| {
        let missing: String = text
            .chars()
            .filter(|c| !c.is_whitespace() && !fonts.has_glyph(&font, *c))
            .collect();
        let galley = fonts.layout_job(job);
        let size = galley.size() * ppp;
        (galley, size, missing)
    })
}

impl Mask {
    fn new(size: [u32; 2]) -> Self {
        Self {
            size: size.map(|side| side as usize),
            coverage: vec![0; size[0] as usize * size[1] as usize],
        }
    }

    /// Lays the letters over the picture, by their coverage, with a halo around them.
    fn lay(&self, image: &mut Image, letters_px: f32, ink: [u8; 3], halo: [u8; 3]) {
        let wide = self.widened((HALO * letters_px).max(1.0));
        blend(image, &wide, halo, 0.8);
        blend(image, self, ink, 1.0);
    }

    /// Writes a text with its upper left corner at a pixel.
    fn write(&mut self, ctx: &Context, galley: &Galley, corner: Pos2) {
        let ppp = ctx.pixels_per_point();
        let atlas = ctx.fonts(|fonts| fonts.image());
        for row in &galley.rows {
            for glyph in row.glyphs.iter().filter(|g| !g.uv_rect.is_nothing()) {
                let at = (row.pos.to_vec2() + glyph.pos.to_vec2() + glyph.uv_rect.offset) * ppp;
                let left = (corner.x + at.x).round() as i64;
                let top = (corner.y + at.y).round() as i64;
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
    }

    /// Draws a line with round ends; from a place to itself, a dot.
    fn line(&mut self, from: Pos2, to: Pos2, radius_px: f32) {
        let radius = radius_px.max(0.6);
        let area = Rect::from_two_pos(from, to).expand(radius + 1.0);
        let area = area.intersect(Rect::from_min_max(
            Pos2::ZERO,
            Pos2::new(self.size[0] as f32, self.size[1] as f32),
        ));
        if !area.is_positive() {
            return;
        }
        let way = to - from;
        for y in area.top() as i64..area.bottom().ceil() as i64 {
            for x in area.left() as i64..area.right().ceil() as i64 {
                let at = Pos2::new(x as f32 + 0.5, y as f32 + 0.5);
                let t = (at - from).dot(way) / way.length_sq().max(1e-6);
                let away = (from + way * t.clamp(0.0, 1.0) - at).length();
                self.cover(x, y, ((radius + 0.5 - away).clamp(0.0, 1.0) * 255.0) as u8);
            }
        }
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

/// Lays a colour over the picture where the mask covers it. Straight alpha, in sRGB as everything that is drawn over
/// it.
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
        let missing = letter(&mut image, document.illustration(), &[]);
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
