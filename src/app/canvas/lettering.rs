//! What is written into a picture that leaves the program: the title at its upper left, the credit at its lower left,
//! captions at its sides, a scale bar at its lower right, letters of the patient's sides at its edges. In ink or white
//! as the background wants, with a halo of the other so that they read over tissue.

use egui::text::{LayoutJob, TextWrapping};
use egui::{Align, Color32, Context, FontId, Galley, Pos2, RawInput, Rect, TextFormat, Vec2, vec2};
use std::sync::Arc;

use super::caption_layout::{self, is_dark};
use crate::app::kit::theme;
use crate::app::services::{SetText, TextToSet};
use crate::document::{Background, Illustration, needs_shaping};
use crate::render::{CaptionPlace, Image, Marks, View};

/// Height of the title's letters, of the picture's shorter side, and of the credit's.
const TITLE: f32 = 0.045;
const CREDIT: f32 = 0.024;
/// Height of a caption's letters, of the picture's shorter side; and its greatest width, of the picture's width.
const CAPTION: f32 = 0.03;
const CAPTION_WIDTH: f32 = 0.24;
/// Height of the letters at the edges and of a scale bar's, of the picture's shorter side.
const MARK: f32 = 0.03;
/// Height of a scale bar with its text, of its letters' height.
const BAR: f32 = 1.8;
/// Part of the width that a credit has beside a scale bar.
const BESIDE_BAR: f32 = 0.68;
/// Pixels of letters at least: below nobody reads them.
const LEAST: f32 = 9.0;
/// Distance from the edges, of the shorter side.
const MARGIN: f32 = 0.035;
/// Radius of the halo, of the letters' height.
const HALO: f32 = 0.14;

/// Sets a text with fonts that the program does not have, or returns `None`.
pub(crate) type Setter<'a> = &'a dyn Fn(&TextToSet) -> Option<SetText>;

/// A text that has been laid out.
enum Laid {
    /// By the program's own fonts, points.
    Own(Arc<Galley>),
    /// By the surroundings.
    Set(SetText),
}

/// How much of each pixel letters cover, 0 to 255.
struct Mask {
    size: [usize; 2],
    coverage: Vec<u8>,
}

/// Writes an illustration's title, credit and captions into its picture. `captions` holds the place of each caption.
/// Returns the characters that no font at hand has.
pub fn letter(image: &mut Image, illustration: &Illustration, captions: &[CaptionPlace]) -> String {
    letter_with((&fonts(), &|_| None), image, illustration, captions)
}

/// Draws the scale bar and the letters of the patient's sides into an illustration's picture, where it wishes them.
/// `mm_per_unit`: millimetres in one subject unit; without it there is no bar.
pub fn mark(image: &mut Image, illustration: &Illustration, mm_per_unit: Option<f64>) {
    if illustration.look.scale_bar || illustration.look.sides {
        mark_with(&fonts(), image, illustration, mm_per_unit);
    }
}

/// A context for writing, without a window.
fn fonts() -> Context {
    let ctx = Context::default();
    theme::install(&ctx);
    // Fonts are there from the first pass on.
    ctx.run_ui(RawInput::default(), |_| {})
        .textures_delta
        .clear();
    ctx
}

/// Ink on a background, and the halo around it.
fn inks(background: Background) -> ([u8; 3], [u8; 3]) {
    if is_dark(background) {
        ([255; 3], [0; 3])
    } else {
        ([0x1f, 0x24, 0x26], [255; 3])
    }
}

/// Draws the marks like [`mark`], with the fonts of a window.
pub(crate) fn mark_with(
    ctx: &Context,
    image: &mut Image,
    illustration: &Illustration,
    mm_per_unit: Option<f64>,
) {
    // Figures, units and single letters: every font has them.
    let fonts: (&Context, Setter<'_>) = (ctx, &|_| None);
    let marks = Marks::of(illustration, image.size, mm_per_unit);
    let [width, height] = image.size.map(|side| side as f32);
    let short = width.min(height);
    let margin = MARGIN * short;
    let letters = (MARK * short).max(LEAST);
    let mut mask = Mask::new(image.size);
    let middles = [
        [0.0, 0.5 * height],
        [width, 0.5 * height],
        [0.5 * width, 0.0],
        [0.5 * width, height],
    ];
    for (text, [x, y]) in marks.sides.iter().flatten().zip(middles) {
        let (laid, size, _) = laid_out(fonts, text, theme::STRONG, letters, width, 1);
        let edge = Vec2::splat(0.5 * margin);
        let room = vec2(width, height) - size - edge;
        let corner = Pos2::new(x, y) - 0.5 * size;
        mask.write(ctx, &laid, corner.min(room.to_pos2()).max(edge.to_pos2()));
    }
    if let Some(bar) = marks.bar {
        // Whole rows, so that it is crisp; its length is exact.
        let foot = Pos2::new(width - margin, (height - margin).round());
        let left = foot.x - bar.length_px;
        let thick = (0.13 * letters).round().max(1.0);
        let mut draw =
            |from: [f32; 2], to: [f32; 2]| mask.fill(Rect::from_min_max(from.into(), to.into()));
        draw([left, foot.y - thick], [foot.x, foot.y]);
        // The ends stand up, inside of the length.
        draw([left, foot.y - 4.0 * thick], [left + thick, foot.y]);
        draw([foot.x - thick, foot.y - 4.0 * thick], [foot.x, foot.y]);
        let (laid, size, _) = laid_out(fonts, &bar.text(), "", letters, width, 1);
        let start = (0.5 * (left + foot.x - size.x)).min(foot.x - size.x);
        mask.write(ctx, &laid, Pos2::new(start, foot.y - 2.0 * thick - size.y));
    }
    let (ink, halo) = inks(illustration.look.background);
    mask.lay(image, letters, ink, halo);
}

/// Writes the texts like [`letter`], with the fonts of a window, which has more of them, and with those of a setter
/// where the window's do not do.
pub(crate) fn letter_with(
    fonts: (&Context, Setter<'_>),
    image: &mut Image,
    illustration: &Illustration,
    captions: &[CaptionPlace],
) -> String {
    let [width, height] = image.size.map(|side| side as f32);
    let short = width.min(height);
    let margin = MARGIN * short;
    let (ink, halo) = inks(illustration.look.background);
    let mut missing = String::new();
    let mut free = Rect::from_min_size(Pos2::ZERO, vec2(width, height)).shrink(margin);
    let mark = (MARK * short).max(LEAST);
    let look = &illustration.look;
    if look.sides {
        free = free.shrink(mark);
    }
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
        let is_beside_bar = is_at_foot && look.scale_bar;
        let room = free.width() * if is_beside_bar { BESIDE_BAR } else { 1.0 };
        let rows = rows as usize;
        let (laid, size, lacking) = laid_out(fonts, text, family, letters, room, rows);
        missing += &lacking;
        let mut at = free.left_top();
        if is_at_foot {
            at.y = free.bottom() - size.y;
            free.max.y = at.y - margin;
        } else {
            free.min.y = at.y + size.y + margin;
        }
        let mut mask = Mask::new(image.size);
        mask.write(fonts.0, &laid, at);
        mask.lay(image, letters, ink, halo);
    }
    if look.scale_bar {
        free.max.y = free.max.y.min(height - 2.0 * margin - BAR * mark);
    }
    let view = View::new(&illustration.camera, image.size);
    let letters = (CAPTION * short).max(LEAST);
    let mut mask = Mask::new(image.size);
    let (mut points, mut texts) = (Vec::new(), Vec::new());
    for (caption, place) in illustration.captions.iter().zip(captions) {
        let seen = place.and_then(|(pos, hidden)| Some((view.pixel_from_subject(pos)?, hidden)));
        let Some((at, is_hidden)) = seen.filter(|_| caption.is_drawn()) else {
            continue;
        };
        let at = Pos2::new(at.x, at.y);
        if !Rect::from_min_size(Pos2::ZERO, vec2(width, height)).contains(at) {
            continue;
        }
        let room = CAPTION_WIDTH * width;
        let rows = caption_layout::ROWS;
        let (laid, size, lacking) = laid_out(fonts, &caption.text, "", letters, room, rows);
        missing += &lacking;
        points.push(at);
        texts.push((laid, size, is_hidden));
    }
    let sizes: Vec<Vec2> = texts.iter().map(|(_, size, _)| *size).collect();
    let places = caption_layout::arranged(&points, &sizes, 0.3 * letters, free);
    for (((laid, _, is_hidden), at), rect) in texts.iter().zip(&points).zip(places) {
        mask.write(fonts.0, laid, rect.min);
        mask.line(
            caption_layout::line_start(rect, *at, free.center().x, 0.3 * letters),
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
/// characters that no font has.
fn laid_out(
    (ctx, set): (&Context, Setter<'_>),
    text: &str,
    family: &str,
    letters_px: f32,
    room_px: f32,
    rows: usize,
) -> (Laid, Vec2, String) {
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
    let missing: String = ctx.fonts_mut(|fonts| {
        let is_missing = |c: &char| !c.is_whitespace() && !fonts.has_glyph(&font, *c);
        text.chars().filter(is_missing).collect()
    });
    if needs_shaping(text) || !missing.is_empty() {
        let wanted = TextToSet {
            text: text.trim().to_owned(),
            letters_px,
            is_strong: !family.is_empty(),
            widest_px: room_px,
            rows: rows.max(1),
        };
        if let Some(text) = set(&wanted) {
            let size = text.size_px();
            return (Laid::Set(text), size, String::new());
        }
    }
    let galley = ctx.fonts_mut(|fonts| fonts.layout_job(job));
    let size = galley.size() * ppp;
    (Laid::Own(galley), size, missing)
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
    fn write(&mut self, ctx: &Context, laid: &Laid, corner: Pos2) {
        match laid {
            Laid::Own(galley) => self.write_own(ctx, galley, corner),
            Laid::Set(text) => self.write_set(text, corner),
        }
    }

    fn write_set(&mut self, text: &SetText, corner: Pos2) {
        let (left, top) = (corner.x.round() as i64, corner.y.round() as i64);
        let width = text.size[0].max(1) as usize;
        for (y, row) in (top..).zip(text.coverage.chunks(width)) {
            for (x, coverage) in (left..).zip(row) {
                self.cover(x, y, *coverage);
            }
        }
    }

    fn write_own(&mut self, ctx: &Context, galley: &Galley, corner: Pos2) {
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

    /// Fills a rectangle; pixels at its edges by their part of it.
    fn fill(&mut self, rect: Rect) {
        let [width, height] = self.size.map(|side| side as f32);
        let rect = rect.intersect(Rect::from_min_max(Pos2::ZERO, Pos2::new(width, height)));
        if !rect.is_positive() {
            return;
        }
        let part = |from: f32, to: f32, at: i64| {
            (to.min(at as f32 + 1.0) - from.max(at as f32)).clamp(0.0, 1.0)
        };
        for y in rect.top() as i64..rect.bottom().ceil() as i64 {
            for x in rect.left() as i64..rect.right().ceil() as i64 {
                let covered =
                    part(rect.left(), rect.right(), x) * part(rect.top(), rect.bottom(), y);
                self.cover(x, y, (covered * 255.0) as u8);
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

    /// The longest run of dark pixels in a row of the picture.
    fn longest_run(image: &Image, row: usize) -> usize {
        let stride = image.size[0] as usize * 4;
        let pixels = image.rgba[row * stride..(row + 1) * stride].chunks_exact(4);
        let mut runs = vec![0];
        for pixel in pixels {
            match pixel[0] < 120 {
                true => *runs.last_mut().expect("there is one") += 1,
                false => runs.push(0),
            }
        }
        runs.into_iter().max().unwrap_or(0)
    }

    #[test]
    fn a_bar_is_as_long_in_the_picture_as_the_camera_sees_it() {
        let mm_per_unit = 180.0;
        for (distance, size) in [(2.5, [400, 300]), (1.3, [400, 300]), (0.7, [300, 500])] {
            let json = format!(
                r#"{{"fabrica":1,"look":{{"scale":true}},"camera":{{"distance":{distance}}}}}"#
            );
            let document = Document::from_json(&json).expect("a document");
            let shown = document.illustration();
            let mut image = Image {
                size,
                rgba: vec![255; 4 * size[0] as usize * size[1] as usize],
            };
            mark(&mut image, shown, Some(mm_per_unit));
            let rows = 0..size[1] as usize;
            let found = rows.map(|row| longest_run(&image, row)).max().unwrap_or(0);
            // Two places in the plane of the target, as far apart as the bar says.
            let bar = Marks::of(shown, size, Some(mm_per_unit))
                .bar
                .expect("a bar");
            let view = View::new(&shown.camera, size);
            let pixel = |x: f64| view.pixel_from_subject(glam::Vec3::X * (x / mm_per_unit) as f32);
            let [a, b] = [pixel(0.0), pixel(bar.mm)].map(|pixel| pixel.expect("in sight"));
            let wanted = a.distance(b);
            assert!(
                (found as f32 - wanted).abs() <= 1.5,
                "{found} px of {wanted}: {bar:?}"
            );
        }
        let plain =
            Document::from_json(r#"{"fabrica":1,"look":{"scale":true}}"#).expect("a document");
        let mut image = Image {
            size: [40, 30],
            rgba: vec![255; 4800],
        };
        mark(&mut image, plain.illustration(), None);
        assert!(
            image.rgba.iter().all(|byte| *byte == 255),
            "nobody knows its size"
        );
    }

    #[test]
    fn letters_of_sides_stand_at_all_edges() {
        let json = r#"{"fabrica":1,"look":{"sides":true}}"#;
        let document = Document::from_json(json).expect("a document");
        let size = [600_usize, 400];
        let mut image = Image {
            size: [600, 400],
            rgba: vec![255; 960_000],
        };
        mark(&mut image, document.illustration(), None);
        let dark = |x: std::ops::Range<usize>, y: std::ops::Range<usize>| {
            let pixels = y.flat_map(|y| x.clone().map(move |x| y * size[0] + x));
            pixels.filter(|pixel| image.rgba[4 * pixel] < 120).count()
        };
        for (x, y) in [
            (0..40, 185..215),
            (560..600, 185..215),
            (285..315, 0..40),
            (285..315, 360..400),
        ] {
            assert!(dark(x.clone(), y.clone()) > 8, "a letter at {x:?}, {y:?}");
        }
        assert_eq!(dark(45..555, 45..355), 0, "and none elsewhere");
        for size in [[1, 1], [3, 200], [640, 40]] {
            let count = (size[0] * size[1]) as usize;
            let mut image = Image {
                size,
                rgba: vec![255; 4 * count],
            };
            mark(&mut image, document.illustration(), Some(1.0));
        }
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
