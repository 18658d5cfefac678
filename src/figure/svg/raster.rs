use glam::{DAffine2, DMat2, DVec2};
use tiny_skia as skia;

use super::error::SvgError;
use super::paint::{Gradient, GradientKind, Paint, Stroke};
use super::path::{Outline, Segment};
use super::read::{Drawing, Shape};
use crate::pictures::Picture;

/// Longest side of a drawn picture at most, pixels.
pub const MAX_DRAWN_SIDE: u32 = 4096;

impl Drawing {
    /// The drawing as pixels, on clear ground; the longest side has `longest` pixels (1 to [`MAX_DRAWN_SIDE`];
    /// clamped), the other is rounded and has at least one. What is drawn is what regions are made of and what
    /// [`bent`](super::bent) writes: fills and strokes with colours and gradients. Text, clips, masks and filters are
    /// left aside ([`Drawing::left_out`] names them), so the time is bounded by the number of shapes. The opacity of a
    /// group is that of its shapes, one by one.
    ///
    /// The painter's vector code is switched off, so that page and program draw the same pixels.
    ///
    /// # Errors
    /// [`SvgError::NoSvg`] if the drawing has no size.
    pub fn picture(&self, longest: u32) -> Result<Picture, SvgError> {
        let longest = longest.clamp(1, MAX_DRAWN_SIDE);
        let scale = f64::from(longest) / self.size.max_element();
        if !(scale.is_finite() && scale > 0.0) {
            return Err(SvgError::NoSvg);
        }
        let side = |length: f64| ((length * scale).round() as u32).clamp(1, longest);
        let size = [side(self.size.x), side(self.size.y)];
        let mut pixels = skia::Pixmap::new(size[0], size[1]).ok_or(SvgError::NoSvg)?;
        // A side that was rounded is stretched to whole pixels, as the map's is.
        let each = DVec2::new(f64::from(size[0]), f64::from(size[1])) / self.size;
        let pixels_from_view = transform(DAffine2::from_scale(each));
        for shape in &self.shapes {
            draw(&mut pixels, shape, pixels_from_view);
        }
        let straight = |pixel: &skia::PremultipliedColorU8| {
            let color = pixel.demultiply();
            [color.red(), color.green(), color.blue(), color.alpha()]
        };
        Ok(Picture {
            size,
            pixels: pixels.pixels().iter().map(straight).collect(),
            is_of_inks: false,
        })
    }
}

/// The painter's numbers hold so far from the picture's corner, pixels. Beyond it stops with a fault.
const FARTHEST: f32 = 1e6;

/// Draws a shape; one that has no extent, or reaches farther than the painter's numbers hold, is left out.
fn draw(pixels: &mut skia::Pixmap, shape: &Shape, pixels_from_view: skia::Transform) {
    let Some(path) = path(&shape.outline) else {
        return;
    };
    // How far corners of a line may stick out of it.
    let reach = |stroke: &Stroke| (stroke.width * stroke.miter_limit.max(1.0)) as f32;
    let reach = shape.look.stroke.as_ref().map_or(0.0, reach);
    let is_near = |bounds: skia::Rect| {
        let sides = [bounds.left(), bounds.top(), bounds.right(), bounds.bottom()];
        let scale = pixels_from_view.sx.max(pixels_from_view.sy);
        sides
            .iter()
            .all(|side| (side.abs() + reach) * scale <= FARTHEST)
    };
    if !is_near(path.bounds()) {
        return;
    }
    let look = &shape.look;
    let fill = |pixels: &mut skia::Pixmap| {
        let Some((fill, opacity)) = &look.fill else {
            return;
        };
        if let Some(paint) = paint(fill, opacity * look.opacity) {
            let rule = match shape.fill {
                Some(true) => skia::FillRule::EvenOdd,
                _ => skia::FillRule::Winding,
            };
            pixels.fill_path(&path, &paint, rule, pixels_from_view, None);
        }
    };
    let stroke = |pixels: &mut skia::Pixmap| {
        let Some(stroke) = &look.stroke else { return };
        if let Some(paint) = paint(&stroke.paint, stroke.opacity * look.opacity) {
            pixels.stroke_path(&path, &paint, &line(stroke), pixels_from_view, None);
        }
    };
    if look.is_stroke_first {
        stroke(pixels);
        fill(pixels);
    } else {
        fill(pixels);
        stroke(pixels);
    }
}

fn path(outline: &Outline) -> Option<skia::Path> {
    let mut path = skia::PathBuilder::new();
    let xy = |at: DVec2| (at.x as f32, at.y as f32);
    for segment in &outline.0 {
        match segment {
            Segment::Move(to) => path.move_to(xy(*to).0, xy(*to).1),
            Segment::Line(to) => path.line_to(xy(*to).0, xy(*to).1),
            Segment::Quadratic(control, to) => {
                let ((x1, y1), (x, y)) = (xy(*control), xy(*to));
                path.quad_to(x1, y1, x, y);
            }
            Segment::Cubic(one, other, to) => {
                let ((x1, y1), (x2, y2), (x, y)) = (xy(*one), xy(*other), xy(*to));
                path.cubic_to(x1, y1, x2, y2, x, y);
            }
            Segment::Close => path.close(),
        }
    }
    path.finish()
}

fn line(stroke: &Stroke) -> skia::Stroke {
    let dashes = stroke.dashes.iter().map(|length| *length as f32).collect();
    skia::Stroke {
        width: stroke.width as f32,
        miter_limit: stroke.miter_limit as f32,
        line_cap: match stroke.cap {
            "round" => skia::LineCap::Round,
            "square" => skia::LineCap::Square,
            _ => skia::LineCap::Butt,
        },
        line_join: match stroke.join {
            "round" => skia::LineJoin::Round,
            "bevel" => skia::LineJoin::Bevel,
            "miter-clip" => skia::LineJoin::MiterClip,
            _ => skia::LineJoin::Miter,
        },
        dash: skia::StrokeDash::new(dashes, stroke.dash_offset as f32),
    }
}

/// The colours of a shape; none if a gradient has no extent that can be drawn.
fn paint(paint: &Paint, opacity: f64) -> Option<skia::Paint<'static>> {
    let shader = match paint {
        Paint::Color(rgb) => skia::Shader::SolidColor(color(*rgb, opacity)),
        Paint::Gradient(gradient) => shader(gradient, opacity)?,
    };
    Some(skia::Paint {
        shader,
        anti_alias: true,
        ..skia::Paint::default()
    })
}

fn shader(gradient: &Gradient, opacity: f64) -> Option<skia::Shader<'static>> {
    let stop = |(offset, rgb, alpha): &(f64, [u8; 3], f64)| {
        skia::GradientStop::new(*offset as f32, color(*rgb, alpha * opacity))
    };
    let stops = gradient.stops.iter().map(stop).collect();
    let spread = match gradient.spread {
        "reflect" => skia::SpreadMode::Reflect,
        "repeat" => skia::SpreadMode::Repeat,
        _ => skia::SpreadMode::Pad,
    };
    let point = |at: DVec2| skia::Point::from_xy(at.x as f32, at.y as f32);
    let place = transform(gradient.place);
    match gradient.kind {
        GradientKind::Linear { from, to } => {
            skia::LinearGradient::new(point(from), point(to), stops, spread, place)
        }
        GradientKind::Radial {
            centre,
            radius,
            focus,
            focus_radius,
        } => skia::RadialGradient::new(
            point(focus),
            focus_radius as f32,
            point(centre),
            radius as f32,
            stops,
            spread,
            place,
        ),
    }
}

fn color([red, green, blue]: [u8; 3], opacity: f64) -> skia::Color {
    let alpha = (255.0 * opacity.clamp(0.0, 1.0)).round() as u8;
    skia::Color::from_rgba8(red, green, blue, alpha)
}

fn transform(place: DAffine2) -> skia::Transform {
    let DMat2 { x_axis, y_axis } = place.matrix2;
    let t = place.translation;
    skia::Transform::from_row(
        x_axis.x as f32,
        x_axis.y as f32,
        y_axis.x as f32,
        y_axis.y as f32,
        t.x as f32,
        t.y as f32,
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A quarter that is moved and turned in two groups, a ring by the even-odd rule, a gradient, half a red.
    const DRAWING: &[u8] = br##"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 40 20">
      <linearGradient id="g" gradientUnits="userSpaceOnUse" x1="20" y1="0" x2="30" y2="0">
        <stop offset="0" stop-color="#000"/><stop offset="1" stop-color="#fff"/></linearGradient>
      <g transform="translate(10 0)"><g transform="rotate(90)"><path d="M0 0H8V10H0Z" fill="#0000ff"/></g></g>
      <path fill-rule="evenodd" fill="#00aa00" d="M0 10H10V20H0ZM3 13H7V17H3Z"/>
      <path fill="url(#g)" d="M20 0H30V20H20Z"/>
      <g opacity="0.5"><path fill="#ff0000" d="M30 0H40V10H30Z"/></g>
      <path fill="none" stroke="#102030" stroke-width="4" d="M30 15H40"/></svg>"##;

    fn drawn_picture(bytes: &[u8], longest: u32) -> Result<Picture, SvgError> {
        Drawing::read(bytes)?.picture(longest)
    }

    #[test]
    fn named_pixels_have_the_colours_that_the_drawing_says() {
        let picture = drawn_picture(DRAWING, 80).expect("a drawing");
        assert_eq!(picture.size, [80, 40], "its size");
        let at = |column: usize, row: usize| picture.pixels[row * 80 + column];
        assert_eq!(at(10, 8), [0, 0, 255, 255], "turned into the corner");
        assert_eq!(at(10, 18), [0, 0, 0, 0], "clear below it");
        assert_eq!(at(2, 22), [0, 170, 0, 255], "the ring");
        assert_eq!(at(10, 30), [0, 0, 0, 0], "its hole");
        assert_eq!(at(75, 30), [16, 32, 48, 255], "the stroke");
        let [red, green, blue, alpha] = at(70, 5);
        assert_eq!([green, blue], [0, 0], "red only");
        assert!(
            red >= 254 && (127..=128).contains(&alpha),
            "half of it, not multiplied: {red} {alpha}"
        );
        for column in [41, 50, 58] {
            let wanted = (column as f64 + 0.5 - 40.0) / 20.0 * 255.0;
            let found = f64::from(at(column, 20)[0]);
            assert!(
                (found - wanted).abs() <= 1.0,
                "{column}: {found}, not {wanted}"
            );
        }
    }

    #[test]
    fn sizes_are_kept_in_their_limits() {
        let size = |longest| drawn_picture(DRAWING, longest).map(|picture| picture.size);
        assert_eq!(size(0), Ok([1, 1]), "at least a pixel");
        assert_eq!(size(u32::MAX), Ok([4096, 2048]), "no more than the largest");
        assert_eq!(
            drawn_picture(b"<svg", 10).map(|_| ()),
            Err(SvgError::NoXml { line: 1, column: 1 }),
            "no XML"
        );
    }
}
