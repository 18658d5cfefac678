//! A plate as an SVG file: the picture, and over it outlines and texts that stay lines and letters.

use std::fmt::Write as _;
use std::io::{self, Write};

use base64::engine::general_purpose::STANDARD;
use base64::write::EncoderWriter;

use crate::app::{Lettering, escaped};
use crate::math::borders::BorderLine;

const MM_PER_INCH: f32 = 25.4;

/// A pen that outlines are drawn with.
pub(super) struct Pen {
    /// Width of the lines, thousandths of the picture's shorter side.
    pub(super) width: f32,
    /// sRGB bytes.
    pub(super) color: [u8; 3],
}

impl Pen {
    /// The pen for a picture whose style draws no outlines.
    pub(super) const PLAIN: Self = Self {
        width: 2.0,
        color: [0x1a; 3],
    };
}

/// What an SVG file of a picture holds.
pub(super) struct Plate<'a> {
    /// Width and height of the picture, pixels: the units of the file.
    pub(super) size: [u32; 2],
    /// Dots per inch in print.
    pub(super) dpi: Option<f32>,
    pub(super) title: &'a str,
    /// What the picture shows, in words.
    pub(super) told: &'a str,
    /// The picture without texts, a PNG file.
    pub(super) png: &'a [u8],
    /// Outlines, and columns and rows of the grid that they were found in.
    pub(super) outlines: (&'a [BorderLine], [u32; 2]),
    /// How outlines are drawn.
    pub(super) pen: Pen,
    pub(super) lettering: &'a Lettering,
}

impl Plate<'_> {
    /// Writes the file.
    pub(super) fn write(&self, mut out: impl Write) -> io::Result<()> {
        let [width, height] = self.size;
        let side = |px: u32| match self.dpi {
            Some(dpi) => format!("{:.3}mm", px as f32 / dpi * MM_PER_INCH),
            None => px.to_string(),
        };
        writeln!(
            out,
            r#"<svg xmlns="http://www.w3.org/2000/svg" width="{}" height="{}" viewBox="0 0 {width} {height}" role="img">"#,
            side(width),
            side(height)
        )?;
        for (element, text) in [("title", self.title), ("desc", self.told)] {
            if !text.trim().is_empty() {
                writeln!(out, "<{element}>{}</{element}>", escaped(text.trim()))?;
            }
        }
        write!(
            out,
            r#"<image width="{width}" height="{height}" href="data:image/png;base64,"#
        )?;
        write_base64(&mut out, self.png)?;
        let line = 1e-3 * self.pen.width * width.min(height) as f32;
        let [red, green, blue] = self.pen.color;
        writeln!(
            out,
            "\"/>\n<g id=\"outlines\" fill=\"none\" stroke=\"#{red:02x}{green:02x}{blue:02x}\" stroke-width=\"{line:.2}\" stroke-linecap=\"round\" stroke-linejoin=\"round\">"
        )?;
        let (lines, grid) = self.outlines;
        let scale = [0, 1].map(|i| self.size[i] as f32 / grid[i].max(1) as f32);
        for line in lines {
            writeln!(out, "<path d=\"{}\"/>", path(line, scale))?;
        }
        write!(
            out,
            "</g>\n<g id=\"lettering\">\n{}</g>\n</svg>\n",
            self.lettering.to_svg()
        )
    }
}

fn write_base64(out: impl Write, bytes: &[u8]) -> io::Result<()> {
    let mut encoder = EncoderWriter::new(out, &STANDARD);
    encoder.write_all(bytes)?;
    encoder.finish()?;
    Ok(())
}

fn path(line: &BorderLine, scale: [f32; 2]) -> String {
    let mut path = String::new();
    for (index, point) in line.points.iter().enumerate() {
        let letter = if index == 0 { 'M' } else { 'L' };
        let [x, y] = [point.x * scale[0], point.y * scale[1]];
        // Writing into a string cannot fail.
        let _written = write!(path, "{letter}{x:.1} {y:.1}");
    }
    if line.is_closed {
        path.push('z');
    }
    path
}
