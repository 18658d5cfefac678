//! What is written into a picture that leaves the program: the title at its upper left, the credit at its lower left,
//! captions at its sides, a scale bar at its lower right, letters of the patient's sides at its edges. In ink or white
//! as the background wants, with a halo of the other so that they read over tissue.

use egui::text::{LayoutJob, TextWrapping};
use egui::{
    Align, Color32, Context, FontFamily, FontId, Galley, Pos2, RawInput, Rect, TextFormat, Vec2,
    vec2,
};
use std::ops::Range;
use std::sync::Arc;

use super::caption_layout::{self, is_dark};
use crate::app::kit::theme;
use crate::app::services::{SetText, TextToSet};
use crate::document::{Background, Illustration, needs_shaping};
use crate::render::{CaptionPlace, MOST_PX, Marks, View};

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
pub(super) const HALO: f32 = 0.14;
pub(super) const HALO_OPACITY: f32 = 0.8;

/// Sets a text with fonts that the program does not have, or returns `None`.
pub(crate) type Setter<'a> = &'a dyn Fn(&TextToSet) -> Option<SetText>;

/// A text that has been laid out.
enum Laid {
    /// By the program's own fonts, points.
    Own(Arc<Galley>),
    /// By the surroundings.
    Set(SetText),
}

/// What is written into a picture of one size, laid out. It is laid over the picture's rows as they come.
pub struct Lettering {
    size: [u32; 2],
    pub(super) ink: [u8; 3],
    pub(super) halo: [u8; 3],
    /// Each lies with its halo over those before.
    pub(super) layers: Vec<Layer>,
    missing: String,
}

/// What has one halo together.
pub(super) struct Layer {
    /// Height of its letters, pixels.
    pub letters_px: f32,
    pub strokes: Vec<Stroke>,
    /// Its texts as letters: what the stamps among the strokes say.
    pub rows: Vec<TextRow>,
}

/// What covers pixels of the picture.
pub(super) enum Stroke {
    /// Pixels from a corner on, row by row, 0 to 255.
    Stamp {
        left: i64,
        top: i64,
        width: usize,
        coverage: Vec<u8>,
    },
    /// A line with round ends; from a place to itself, a dot.
    Line { from: Pos2, to: Pos2, radius: f32 },
    /// A rectangle; pixels at its edges are covered by their part of it.
    Fill(Rect),
}

/// A row of text where it stands in a picture, pixels.
pub(super) struct TextRow {
    pub text: String,
    /// The left end of its base line.
    pub left: f32,
    pub base: f32,
    pub width: f32,
    pub is_strong: bool,
}

/// How much of each pixel letters cover, 0 to 255, in some rows of a picture.
struct Mask {
    /// Width and height of the picture.
    size: [i64; 2],
    /// The rows that it holds.
    rows: Range<i64>,
    coverage: Vec<u8>,
}

/// What is written into a picture of an illustration, with the program's own fonts: the scale bar and the letters of
/// the patient's sides where it wishes them, and title, credit and captions if `captions` tells the place of each
/// caption. `mm_per_unit`: millimetres in one subject unit; without it there is no bar.
pub fn lettering(
    illustration: &Illustration,
    size_px: [u32; 2],
    mm_per_unit: Option<f64>,
    captions: Option<&[CaptionPlace]>,
) -> Lettering {
    let mut lettering = Lettering::new(illustration, size_px);
    if captions.is_some() || illustration.look.scale_bar || illustration.look.sides {
        let fonts: (&Context, Setter<'_>) = (&fonts(), &|_| None);
        lettering.mark(fonts.0, illustration, mm_per_unit);
        if let Some(captions) = captions {
            lettering.letter(fonts, illustration, captions);
        }
    }
    lettering
}

/// A context for writing, without a window.
fn fonts() -> Context {
    let ctx = Context::default();
    theme::install(&ctx);
    // Fonts are there from the first pass on. The letters of a large print want more room than a window gives.
    let input = RawInput {
        max_texture_side: Some(MOST_PX as usize),
        ..RawInput::default()
    };
    ctx.run_ui(input, |_| {}).textures_delta.clear();
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

impl Lettering {
    /// Nothing yet.
    pub(crate) fn new(illustration: &Illustration, size: [u32; 2]) -> Self {
        let (ink, halo) = inks(illustration.look.background);
        Self {
            size,
            ink,
            halo,
            layers: Vec::new(),
            missing: String::new(),
        }
    }

    /// Characters of the texts that no font at hand has.
    pub fn missing(&self) -> &str {
        &self.missing
    }

    /// Writes over rows of the picture (sRGB with straight alpha), `first` the first of them.
    pub fn lay(&self, first: u32, rgba: &mut [u8]) {
        let width = self.size[0] as usize;
        let count = rgba.len() / (4 * width.max(1));
        let rows = i64::from(first)..i64::from(first) + count as i64;
        for layer in &self.layers {
            layer.lay(self.size, rows.clone(), rgba, (self.ink, self.halo));
        }
    }

    /// The scale bar and the letters of the patient's sides, where the illustration wishes them.
    pub(crate) fn mark(
        &mut self,
        ctx: &Context,
        illustration: &Illustration,
        mm_per_unit: Option<f64>,
    ) {
        // Figures, units and single letters: every font has them.
        let fonts: (&Context, Setter<'_>) = (ctx, &|_| None);
        let marks = Marks::of(illustration, self.size, mm_per_unit);
        let [width, height] = self.size.map(|side| side as f32);
        let short = width.min(height);
        let margin = MARGIN * short;
        let letters = (MARK * short).max(LEAST);
        let mut layer = Layer::new(letters);
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
            layer.write(ctx, &laid, corner.min(room.to_pos2()).max(edge.to_pos2()));
        }
        if let Some(bar) = marks.bar {
            // Whole rows, so that it is crisp; its length is exact.
            let foot = Pos2::new(width - margin, (height - margin).round());
            let left = foot.x - bar.length_px;
            let thick = (0.13 * letters).round().max(1.0);
            let mut draw = |from: [f32; 2], to: [f32; 2]| {
                layer.fill(Rect::from_min_max(from.into(), to.into()))
            };
            draw([left, foot.y - thick], [foot.x, foot.y]);
            // The ends stand up, inside of the length.
            draw([left, foot.y - 4.0 * thick], [left + thick, foot.y]);
            draw([foot.x - thick, foot.y - 4.0 * thick], [foot.x, foot.y]);
            let (laid, size, _) = laid_out(fonts, &bar.text(), "", letters, width, 1);
            let start = (0.5 * (left + foot.x - size.x)).min(foot.x - size.x);
            layer.write(ctx, &laid, Pos2::new(start, foot.y - 2.0 * thick - size.y));
        }
        self.layers.push(layer);
    }

    /// Title, credit and captions; `captions` holds the place of each caption.
    pub(crate) fn letter(
        &mut self,
        fonts: (&Context, Setter<'_>),
        illustration: &Illustration,
        captions: &[CaptionPlace],
    ) {
        let [width, height] = self.size.map(|side| side as f32);
        let short = width.min(height);
        let margin = MARGIN * short;
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
            self.missing += &lacking;
            let mut at = free.left_top();
            if is_at_foot {
                at.y = free.bottom() - size.y;
                free.max.y = at.y - margin;
            } else {
                free.min.y = at.y + size.y + margin;
            }
            let mut layer = Layer::new(letters);
            layer.write(fonts.0, &laid, at);
            self.layers.push(layer);
        }
        if look.scale_bar {
            free.max.y = free.max.y.min(height - 2.0 * margin - BAR * mark);
        }
        let view = View::new(&illustration.camera, self.size);
        let letters = (CAPTION * short).max(LEAST);
        let mut layer = Layer::new(letters);
        let (mut points, mut texts) = (Vec::new(), Vec::new());
        for (caption, place) in illustration.captions.iter().zip(captions) {
            let seen =
                place.and_then(|(pos, hidden)| Some((view.pixel_from_subject(pos)?, hidden)));
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
            self.missing += &lacking;
            points.push(at);
            texts.push((laid, size, is_hidden));
        }
        let sizes: Vec<Vec2> = texts.iter().map(|(_, size, _)| *size).collect();
        let places = caption_layout::arranged(&points, &sizes, 0.3 * letters, free);
        for (((laid, _, is_hidden), at), rect) in texts.iter().zip(&points).zip(places) {
            layer.write(fonts.0, laid, rect.min);
            layer.line(
                caption_layout::line_start(rect, *at, free.center().x, 0.3 * letters),
                *at,
                0.1 * letters,
            );
            layer.line(*at, *at, if *is_hidden { 0.12 } else { 0.26 } * letters);
        }
        self.layers.push(layer);
    }
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

impl Layer {
    fn new(letters_px: f32) -> Self {
        Self {
            letters_px,
            strokes: Vec::new(),
            rows: Vec::new(),
        }
    }

    /// Writes a text with its upper left corner at a pixel.
    fn write(&mut self, ctx: &Context, laid: &Laid, corner: Pos2) {
        match laid {
            Laid::Own(galley) => self.write_own(ctx, galley, corner),
            Laid::Set(text) => self.strokes.push(Stroke::Stamp {
                left: corner.x.round() as i64,
                top: corner.y.round() as i64,
                width: text.size[0].max(1) as usize,
                coverage: text.coverage.clone(),
            }),
        }
    }

    /// The pixels of the letters are taken at once: the window may put its letters elsewhere before they are laid.
    fn write_own(&mut self, ctx: &Context, galley: &Galley, corner: Pos2) {
        let ppp = ctx.pixels_per_point();
        let atlas = ctx.fonts(|fonts| fonts.image());
        let format = galley.job.sections.first().map(|section| &section.format);
        let family = format.map(|format| &format.font_id.family);
        let is_strong = family.is_some_and(|family| *family != FontFamily::Proportional);
        for row in &galley.rows {
            if let (Some(first), Some(last)) = (row.glyphs.first(), row.glyphs.last()) {
                let start = corner + (row.pos.to_vec2() + first.pos.to_vec2()) * ppp;
                self.rows.push(TextRow {
                    text: row.text(),
                    left: start.x,
                    base: start.y,
                    width: (last.pos.x + last.advance_width - first.pos.x) * ppp,
                    is_strong,
                });
            }
            for glyph in row.glyphs.iter().filter(|g| !g.uv_rect.is_nothing()) {
                let at = (row.pos.to_vec2() + glyph.pos.to_vec2() + glyph.uv_rect.offset) * ppp;
                let [from, to] = [glyph.uv_rect.min, glyph.uv_rect.max];
                let texels = (from[1]..to[1]).flat_map(|v| {
                    let start = usize::from(v) * atlas.size[0];
                    (from[0]..to[0]).map(move |u| start + usize::from(u))
                });
                let coverage = texels.map(|texel| atlas.pixels.get(texel).map_or(0, Color32::a));
                self.strokes.push(Stroke::Stamp {
                    left: (corner.x + at.x).round() as i64,
                    top: (corner.y + at.y).round() as i64,
                    width: usize::from(to[0] - from[0]).max(1),
                    coverage: coverage.collect(),
                });
            }
        }
    }

    fn line(&mut self, from: Pos2, to: Pos2, radius_px: f32) {
        let radius = radius_px.max(0.6);
        self.strokes.push(Stroke::Line { from, to, radius });
    }

    fn fill(&mut self, rect: Rect) {
        self.strokes.push(Stroke::Fill(rect));
    }

    /// Lays the letters over rows of a picture, by their coverage, with a halo around them.
    fn lay(
        &self,
        size: [u32; 2],
        rows: Range<i64>,
        rgba: &mut [u8],
        (ink, halo): ([u8; 3], [u8; 3]),
    ) {
        let radius = (HALO * self.letters_px).max(1.0);
        // Letters above and below have their halo in these rows too.
        let reach = radius.ceil() as i64;
        let mut mask = Mask::new(size, rows.start - reach..rows.end + reach);
        if !self.strokes.iter().any(|stroke| stroke.is_in(&mask.rows)) {
            return;
        }
        for stroke in &self.strokes {
            stroke.cover(&mut mask);
        }
        blend(
            rgba,
            &mask.widened(radius, rows.clone()).coverage,
            halo,
            HALO_OPACITY,
        );
        let width = mask.size[0] as usize;
        let above = (rows.start - mask.rows.start) as usize * width;
        blend(
            rgba,
            mask.coverage.get(above..).unwrap_or_default(),
            ink,
            1.0,
        );
    }
}

impl Stroke {
    /// The rows of the picture that it covers something of lie in these.
    fn rows(&self) -> Range<i64> {
        let of = |top: f32, bottom: f32| top.floor() as i64..bottom.ceil() as i64 + 1;
        match self {
            Self::Stamp {
                top,
                width,
                coverage,
                ..
            } => *top..*top + coverage.len().div_ceil(*width) as i64,
            Self::Line { from, to, radius } => of(
                from.y.min(to.y) - radius - 1.0,
                from.y.max(to.y) + radius + 1.0,
            ),
            Self::Fill(rect) => of(rect.top(), rect.bottom()),
        }
    }

    fn is_in(&self, rows: &Range<i64>) -> bool {
        let own = self.rows();
        own.start < rows.end && rows.start < own.end
    }

    /// Covers its pixels in the rows of a mask.
    fn cover(&self, mask: &mut Mask) {
        if !self.is_in(&mask.rows) {
            return;
        }
        let whole = Rect::from_min_max(
            Pos2::ZERO,
            Pos2::new(mask.size[0] as f32, mask.size[1] as f32),
        );
        match self {
            Self::Stamp {
                left,
                top,
                width,
                coverage,
            } => {
                for (y, row) in (*top..).zip(coverage.chunks(*width)) {
                    for (x, coverage) in (*left..).zip(row) {
                        mask.cover(x, y, *coverage);
                    }
                }
            }
            Self::Line { from, to, radius } => {
                let area = Rect::from_two_pos(*from, *to).expand(radius + 1.0);
                let way = *to - *from;
                mask.cover_all(area.intersect(whole), |x, y| {
                    let at = Pos2::new(x as f32 + 0.5, y as f32 + 0.5);
                    let t = (at - *from).dot(way) / way.length_sq().max(1e-6);
                    let away = (*from + way * t.clamp(0.0, 1.0) - at).length();
                    (radius + 0.5 - away).clamp(0.0, 1.0)
                });
            }
            Self::Fill(rect) => {
                let rect = rect.intersect(whole);
                let part = |from: f32, to: f32, at: i64| {
                    (to.min(at as f32 + 1.0) - from.max(at as f32)).clamp(0.0, 1.0)
                };
                mask.cover_all(rect, |x, y| {
                    part(rect.left(), rect.right(), x) * part(rect.top(), rect.bottom(), y)
                });
            }
        }
    }
}

impl Mask {
    /// Of those of the rows that the picture has.
    fn new(size: [u32; 2], rows: Range<i64>) -> Self {
        let size = size.map(i64::from);
        let rows = rows.start.clamp(0, size[1])..rows.end.clamp(0, size[1]);
        let count = (rows.end - rows.start).max(0);
        Self {
            size,
            rows,
            coverage: vec![0; (size[0] * count) as usize],
        }
    }

    /// Covers the pixels of an area of the picture by the part, 0 to 1, that is told for each.
    fn cover_all(&mut self, area: Rect, part: impl Fn(i64, i64) -> f32) {
        if !area.is_positive() {
            return;
        }
        let top = (area.top() as i64).max(self.rows.start);
        let bottom = (area.bottom().ceil() as i64).min(self.rows.end);
        for y in top..bottom {
            for x in area.left() as i64..area.right().ceil() as i64 {
                self.cover(x, y, (part(x, y) * 255.0) as u8);
            }
        }
    }

    fn cover(&mut self, x: i64, y: i64, coverage: u8) {
        if (0..self.size[0]).contains(&x)
            && self.rows.contains(&y)
            && let Some(pixel) = self
                .coverage
                .get_mut(((y - self.rows.start) * self.size[0] + x) as usize)
        {
            *pixel = (*pixel).max(coverage);
        }
    }

    /// Letters made wider all around, fading out, in some of the rows.
    fn widened(&self, radius: f32, rows: Range<i64>) -> Self {
        let mut wide = Self::new(self.size.map(|side| side as u32), rows);
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
        let width = self.size[0].max(1) as usize;
        let count = self.coverage.len() / width;
        for (index, coverage) in self.coverage.iter().enumerate() {
            if *coverage == 0 {
                continue;
            }
            let (x, y) = (index % width, index / width);
            let (left, top) = (x as i64, self.rows.start + y as i64);
            // Amid others that are covered as much it adds nothing but itself: wherever its brush reaches, that of
            // one of them reaches with more weight.
            let is_inside = x > 0
                && y > 0
                && x + 1 < width
                && y + 1 < count
                && [index - 1, index + 1, index - width, index + width]
                    .iter()
                    .all(|beside| self.coverage[*beside] >= *coverage);
            if is_inside {
                wide.cover(left, top, *coverage);
                continue;
            }
            for &(dx, dy, weight) in &brush {
                wide.cover(left + dx, top + dy, (f32::from(*coverage) * weight) as u8);
            }
        }
        wide
    }
}

/// Lays a colour over rows of a picture where they are covered. Straight alpha, in sRGB as everything that is drawn
/// over it.
fn blend(rgba: &mut [u8], coverage: &[u8], color: [u8; 3], opacity: f32) {
    for (pixel, coverage) in rgba.chunks_exact_mut(4).zip(coverage) {
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
    use crate::render::Image;

    fn lettered(json: &str, size: [u32; 2], pixel: [u8; 4]) -> (Image, String) {
        let document = Document::from_json(json).expect("a document");
        let count = size[0] as usize * size[1] as usize;
        let mut image = Image {
            size,
            rgba: pixel.repeat(count),
        };
        let lettering = lettering(document.illustration(), size, None, Some(&[]));
        lettering.lay(0, &mut image.rgba);
        (image, lettering.missing().to_owned())
    }

    fn marked(image: &mut Image, shown: &Illustration, mm_per_unit: Option<f64>) {
        lettering(shown, image.size, mm_per_unit, None).lay(0, &mut image.rgba);
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
            marked(&mut image, shown, Some(mm_per_unit));
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
        marked(&mut image, plain.illustration(), None);
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
        marked(&mut image, document.illustration(), None);
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
            marked(&mut image, document.illustration(), Some(1.0));
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

    /// All that can be written, laid over the whole picture and over bands of it.
    #[test]
    fn bands_are_lettered_like_the_whole() {
        let json = r#"{"fabrica":1,"title":"Craniotomy","credit":"A. Author","look":{"scale":true,"sides":true,"background":"none"},"labels":[{"at":[0,0,0.1],"text":"Parietal bone"},{"at":[0.2,0,-0.1],"text":"Dura mater, opened and turned down"}]}"#;
        let document = Document::from_json(json).expect("a document");
        let shown = document.illustration();
        let places: Vec<CaptionPlace> = shown
            .captions
            .iter()
            .map(|caption| Some((caption.at, false)))
            .collect();
        let size = [320, 250];
        let lettering = lettering(shown, size, Some(180.0), Some(&places));
        let count = (size[0] * size[1]) as usize;
        let ground: Vec<u8> = (0..4 * count).map(|i| (i * 31 % 256) as u8).collect();
        let mut whole = ground.clone();
        lettering.lay(0, &mut whole);
        let changed = whole
            .chunks(4)
            .zip(ground.chunks(4))
            .filter(|(a, b)| a != b);
        assert!(changed.count() > 4000, "texts, lines, marks, halos");
        for rows in [1, 7, 64, 249] {
            let mut bands = ground.clone();
            let stride = 4 * size[0] as usize * rows;
            for (first, band) in (0..).step_by(rows).zip(bands.chunks_mut(stride)) {
                lettering.lay(first, band);
            }
            assert!(bands == whole, "bands of {rows} rows");
        }
    }

    /// What is skipped inside of letters adds nothing.
    #[test]
    fn halos_are_those_of_all_pixels() {
        let size = [60, 40];
        let mut mask = Mask::new(size, 0..40);
        for y in 0..40 {
            for x in 0..60 {
                let away = (((x - 20) * (x - 20) + (y - 18) * (y - 18)) as f32).sqrt();
                mask.cover(x, y, ((11.0 - away).clamp(0.0, 1.0) * 255.0) as u8);
                mask.cover(x, y, if x > 40 && y % 9 == 3 { 130 } else { 0 });
            }
        }
        let radius = 5.3;
        let wide = mask.widened(radius, 0..40);
        for y in 0..40_i64 {
            for x in 0..60_i64 {
                let all = (0..40_i64).flat_map(|v| (0..60_i64).map(move |u| (u, v)));
                let weights = all.map(|(u, v)| {
                    let (dx, dy) = (x - u, y - v);
                    let distance = ((dx * dx + dy * dy) as f32).sqrt();
                    let weight = (1.0 - distance / (radius + 1.0)).clamp(0.0, 1.0).sqrt();
                    (f32::from(mask.coverage[(v * 60 + u) as usize]) * weight) as u8
                });
                let wanted = weights.max().unwrap_or(0);
                let found = wide.coverage[(y * 60 + x) as usize];
                assert_eq!(found, wanted, "{x}, {y}");
            }
        }
    }
}
