//! What is written into a picture, as text and paths of an SVG file.

use std::fmt::Write as _;

use super::lettering::{HALO, HALO_OPACITY, Layer, Lettering, Stroke};

impl Lettering {
    /// The elements of an SVG file whose units are the picture's pixels: each row of text is a `<text>`, each line and
    /// mark a `<path>`, with the halo of the picture's letters.
    pub fn to_svg(&self) -> String {
        let mut svg = String::new();
        for layer in &self.layers {
            layer.write_svg(&mut svg, self.ink, self.halo);
        }
        svg
    }
}

impl Layer {
    fn write_svg(&self, svg: &mut String, ink: [u8; 3], halo: [u8; 3]) {
        if self.strokes.is_empty() && self.rows.is_empty() {
            return;
        }
        let (ink, halo) = (hex(ink), hex(halo));
        let wide = 2.0 * HALO * self.letters_px;
        let shapes: Vec<(String, f32)> = self.strokes.iter().filter_map(shape).collect();
        // Halos lie under all that is inked.
        let mut path = |(shape, width): &(String, f32), color: &str, more: f32, opacity: f32| {
            let width = width + more;
            // Writing into a string cannot fail.
            let _written = writeln!(
                svg,
                r#"<path d="{shape}" fill="{color}" stroke="{color}" stroke-width="{width:.2}" stroke-linecap="round" stroke-linejoin="round" opacity="{opacity}"/>"#
            );
        };
        for shape in &shapes {
            path(shape, &halo, wide, HALO_OPACITY);
        }
        for shape in &shapes {
            path(shape, &ink, 0.0, 1.0);
        }
        for row in &self.rows {
            let weight = if row.is_strong { 600 } else { 400 };
            let text = escaped(&row.text);
            let _written = writeln!(
                svg,
                r#"<text x="{:.2}" y="{:.2}" font-family="Inter, Helvetica, Arial, sans-serif" font-size="{:.2}" font-weight="{weight}" textLength="{:.2}" lengthAdjust="spacingAndGlyphs" fill="{ink}" stroke="{halo}" stroke-opacity="{HALO_OPACITY}" stroke-width="{wide:.2}" stroke-linejoin="round" paint-order="stroke" xml:space="preserve">{text}</text>"#,
                row.left, row.base, self.letters_px, row.width
            );
        }
    }
}

/// The path of a line or a mark, and its width.
fn shape(stroke: &Stroke) -> Option<(String, f32)> {
    match stroke {
        // Letters are text.
        Stroke::Stamp { .. } => None,
        Stroke::Line { from, to, radius } => {
            let path = format!("M{:.2} {:.2}L{:.2} {:.2}", from.x, from.y, to.x, to.y);
            Some((path, 2.0 * radius))
        }
        Stroke::Fill(rect) => {
            let (size, [x, y]) = (rect.size(), [rect.left(), rect.top()]);
            let path = format!("M{x:.2} {y:.2}h{:.2}v{:.2}h{:.2}z", size.x, size.y, -size.x);
            Some((path, 0.0))
        }
    }
}

fn hex([r, g, b]: [u8; 3]) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// A text as XML takes it. What XML cannot hold is left out.
pub fn escaped(text: &str) -> String {
    let mut xml = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => xml.push_str("&amp;"),
            '<' => xml.push_str("&lt;"),
            '>' => xml.push_str("&gt;"),
            '"' => xml.push_str("&quot;"),
            '\n' | '\t' => xml.push(c),
            c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => {}
            c => xml.push(c),
        }
    }
    xml
}
