use std::fmt::Write as _;

use glam::{DAffine2, DMat2, DVec2};

use super::paint::{Gradient, GradientKind, Paint};
use super::path::{Curve, Outline, Piece, Segment};
use super::read::{Drawing, Shape};
use crate::document::figure::{Figure, Rigidity, Source};
use crate::figure::mesh::{Mesh, Part};
use crate::figure::plane::Plane;
use crate::figure::probe::forward;

/// Bent curves are missed by less than this, figure units.
const TOLERANCE: f64 = 0.0002;
/// Pieces of a curve are at least so short at first, figure units, so that no bend between their ends is overlooked.
const FIRST_LENGTH: f64 = 0.02;
/// How often a piece is halved at most.
const HALVINGS: u32 = 12;

/// A word beside a bent drawing.
#[derive(Clone, Debug, PartialEq)]
pub struct Label {
    /// What it says.
    pub text: String,
    /// Where it stands, deformed, figure units.
    pub at: DVec2,
}

/// A bent drawing as SVG: its shapes in their order with their outlines bent, and labels as text. Shapes that a rigid
/// region takes by `path` keep their curves and are moved as a whole.
pub fn bent(
    drawing: &Drawing,
    plane: &Plane,
    mesh: &Mesh,
    figure: &Figure,
    places: &[DVec2],
    labels: &[Label],
) -> String {
    let writer = Writer {
        drawing,
        mesh,
        figure,
        places,
        scale: drawing.size.max_element(),
        half: plane.half_size(),
    };
    let mut text = String::new();
    let (width, height) = (drawing.size.x, drawing.size.y);
    // Writing to a string does not fail.
    let _ = writeln!(
        text,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\">"
    );
    for (number, shape) in drawing.shapes.iter().enumerate() {
        writer.write_shape(&mut text, number, shape);
    }
    for label in labels {
        let at = writer.view_from_figure(label.at);
        let _ = writeln!(
            text,
            "<text x=\"{}\" y=\"{}\" font-family=\"sans-serif\" font-size=\"{}\">{}</text>",
            at.x,
            at.y,
            0.02 * writer.scale,
            escaped(&label.text)
        );
    }
    text.push_str("</svg>\n");
    text
}

struct Writer<'a> {
    drawing: &'a Drawing,
    mesh: &'a Mesh,
    figure: &'a Figure,
    places: &'a [DVec2],
    /// Units of the view box in a figure unit.
    scale: f64,
    half: DVec2,
}

impl Writer<'_> {
    fn figure_from_view(&self, at: DVec2) -> DVec2 {
        DVec2::new(
            at.x / self.scale - self.half.x,
            self.half.y - at.y / self.scale,
        )
    }

    fn view_from_figure(&self, at: DVec2) -> DVec2 {
        DVec2::new(
            (at.x + self.half.x) * self.scale,
            (self.half.y - at.y) * self.scale,
        )
    }

    /// The region that takes a shape by path, the last of several.
    fn region_of(&self, shape: &Shape) -> Option<usize> {
        let takes = |i: &usize| match &self.figure.regions[*i].from {
            Some(Source::Path(path)) => self
                .drawing
                .taken(path)
                .iter()
                .any(|taken| std::ptr::eq(*taken, shape)),
            _ => false,
        };
        (0..self.figure.regions.len()).rev().find(takes)
    }

    fn write_shape(&self, text: &mut String, number: usize, shape: &Shape) {
        let region = self.region_of(shape);
        let rigid = region.filter(|i| self.figure.regions[*i].rigidity == Rigidity::Rigid);
        let motion = rigid.and_then(|region| self.motion(region, shape));
        let outline = match motion {
            Some(motion) => shape.outline.mapped(|at| motion.transform_point2(at)),
            None => self.bent_outline(&shape.outline, region),
        };
        let affine =
            motion.unwrap_or_else(|| nearest_affine(&shape.outline, |at| self.carried(at, region)));
        let look = &shape.look;
        let mut definitions = String::new();
        let mut attributes = String::new();
        let mut color = |key: &str, paint: &Paint| match paint {
            Paint::Color([r, g, b]) => format!("#{r:02x}{g:02x}{b:02x}"),
            Paint::Gradient(gradient) => {
                let id = format!("{key}-{number}");
                write_gradient(&mut definitions, &id, gradient, affine);
                format!("url(#{id})")
            }
        };
        match &look.fill {
            Some((fill, opacity)) => {
                let _ = write!(
                    attributes,
                    " fill=\"{}\" fill-opacity=\"{opacity}\"",
                    color("fill", fill)
                );
            }
            None => attributes.push_str(" fill=\"none\""),
        }
        if let Some(stroke) = &look.stroke {
            let value = color("stroke", &stroke.paint);
            let _ = write!(
                attributes,
                " stroke=\"{value}\" stroke-opacity=\"{}\"",
                stroke.opacity
            );
            let _ = write!(
                attributes,
                " stroke-width=\"{}\" stroke-linecap=\"{}\" stroke-linejoin=\"{}\" stroke-miterlimit=\"{}\"",
                stroke.width, stroke.cap, stroke.join, stroke.miter_limit
            );
            if !stroke.dashes.is_empty() {
                let dashes: Vec<String> = stroke.dashes.iter().map(f64::to_string).collect();
                let _ = write!(attributes, " stroke-dasharray=\"{}\"", dashes.join(" "));
                let _ = write!(attributes, " stroke-dashoffset=\"{}\"", stroke.dash_offset);
            }
        }
        if shape.fill == Some(true) {
            attributes.push_str(" fill-rule=\"evenodd\"");
        }
        if look.is_stroke_first {
            attributes.push_str(" paint-order=\"stroke\"");
        }
        if look.opacity < 1.0 {
            let _ = write!(attributes, " opacity=\"{}\"", look.opacity);
        }
        // An element that is used several times gives its id to the first.
        let is_taken = |id: &str| {
            self.drawing.shapes[..number]
                .iter()
                .any(|other| other.id() == Some(id))
        };
        if let Some(id) = shape.id().filter(|id| !is_taken(id)) {
            let _ = write!(attributes, " id=\"{}\"", escaped(id));
        }
        text.push_str(&definitions);
        let _ = writeln!(text, "<path{attributes} d=\"{}\"/>", path_data(&outline));
    }

    /// Where a point of the view box is carried: with the region that takes the shape if that is there, else with what
    /// is in front.
    fn carried(&self, at: DVec2, region: Option<usize>) -> DVec2 {
        let pos = self.figure_from_view(at);
        let of_region = region.and_then(|region| {
            let corners = |t: usize| self.mesh.corners(t, &self.mesh.vertices);
            let candidates = self.mesh.grid.candidates(pos).iter().map(|t| *t as usize);
            let mut own = candidates.filter(|t| self.mesh.tissue(*t).part == Part::Region(region));
            own.find_map(|t| Some((t, crate::figure::mesh::weights(corners(t), pos)?)))
        });
        let place = match of_region {
            Some(found) => self.mesh.carried(found, self.places),
            None => forward(self.mesh, self.places, pos).place,
        };
        self.view_from_figure(place)
    }

    /// The motion of the rigid part that a shape lies in, in the view box; none if the region has no triangle.
    fn motion(&self, region: usize, shape: &Shape) -> Option<DAffine2> {
        let points: Vec<DVec2> = shape
            .outline
            .pieces()
            .iter()
            .map(|piece| piece.to)
            .collect();
        let near = |t: &usize| {
            let [a, b, c] = self
                .mesh
                .corners(*t, &self.mesh.vertices)
                .map(|at| self.view_from_figure(at));
            let middle = (a + b + c) / 3.0;
            points
                .iter()
                .map(|point| point.distance_squared(middle))
                .fold(f64::INFINITY, f64::min)
        };
        let own = (0..self.mesh.triangle_count())
            .filter(|t| self.mesh.tissue(*t).part == Part::Region(region));
        // Corners of triangles at a border with another rigid part may move with that one.
        let is_whole = |t: &usize| {
            let rest = self.mesh.corners(*t, &self.mesh.vertices);
            let now = self.mesh.corners(*t, self.places);
            let ratio = |i: usize, j: usize| now[i].distance(now[j]) / rest[i].distance(rest[j]);
            (ratio(0, 1) - ratio(1, 2)).abs() < 1e-6 && (ratio(0, 1) - ratio(2, 0)).abs() < 1e-6
        };
        let triangle = own
            .filter(is_whole)
            .min_by(|a, b| near(a).total_cmp(&near(b)))?;
        let corners = |places: &[DVec2]| {
            self.mesh
                .corners(triangle, places)
                .map(|at| self.view_from_figure(at))
        };
        let ([a, b, c], [p, q, r]) = (corners(&self.mesh.vertices), corners(self.places));
        let matrix2 = DMat2::from_cols(q - p, r - p) * DMat2::from_cols(b - a, c - a).inverse();
        Some(DAffine2 {
            matrix2,
            translation: p - matrix2 * a,
        })
    }

    /// An outline whose points are all carried, in straight pieces.
    fn bent_outline(&self, outline: &Outline, region: Option<usize>) -> Outline {
        let mut bent = Vec::new();
        for piece in outline.pieces() {
            match piece.curve {
                Curve::Move => bent.push(Segment::Move(self.carried(piece.to, region))),
                _ => {
                    let rough: f64 = (0..8)
                        .map(|i| {
                            piece
                                .at(f64::from(i) / 8.0)
                                .distance(piece.at(f64::from(i + 1) / 8.0))
                        })
                        .sum();
                    let n = (rough / (FIRST_LENGTH * self.scale))
                        .ceil()
                        .clamp(1.0, 1000.0) as u32;
                    for i in 0..n {
                        let (from, to) =
                            (f64::from(i) / f64::from(n), f64::from(i + 1) / f64::from(n));
                        self.divide(&piece, region, [from, to], HALVINGS, &mut bent);
                    }
                }
            }
            if matches!(piece.curve, Curve::Close) {
                bent.push(Segment::Close);
            }
        }
        Outline(bent)
    }

    /// Divides a part of a piece until the chord of its bent ends misses no bent point between by more than the
    /// tolerance.
    fn divide(
        &self,
        piece: &Piece,
        region: Option<usize>,
        [from, to]: [f64; 2],
        left: u32,
        bent: &mut Vec<Segment>,
    ) {
        let at = |part: f64| self.carried(piece.at(from + part * (to - from)), region);
        let (start, end) = (at(0.0), at(1.0));
        let misses = |part: f64| {
            let (p, along) = (at(part) - start, end - start);
            let length = along.length();
            let away = if length > 0.0 {
                along.perp_dot(p).abs() / length
            } else {
                p.length()
            };
            away > TOLERANCE / 2.0 * self.scale
        };
        if left > 0 && [0.25, 0.5, 0.75].into_iter().any(misses) {
            let middle = (from + to) / 2.0;
            self.divide(piece, region, [from, middle], left - 1, bent);
            self.divide(piece, region, [middle, to], left - 1, bent);
        } else {
            bent.push(Segment::Line(end));
        }
    }
}

/// The affine map that is nearest to a deformation at the points of an outline (least squares).
fn nearest_affine(outline: &Outline, map: impl Fn(DVec2) -> DVec2) -> DAffine2 {
    let points: Vec<DVec2> = outline.pieces().iter().map(|piece| piece.to).collect();
    let n = points.len().max(1) as f64;
    let images: Vec<DVec2> = points.iter().map(|at| map(*at)).collect();
    let (mean, mean_image) = (
        points.iter().sum::<DVec2>() / n,
        images.iter().sum::<DVec2>() / n,
    );
    let (mut square, mut product) = (DMat2::ZERO, DMat2::ZERO);
    for (point, image) in points.iter().zip(&images) {
        let (d, e) = (*point - mean, *image - mean_image);
        square += DMat2::from_cols(d.x * d, d.y * d);
        product += DMat2::from_cols(d.x * e, d.y * e);
    }
    // Points on a line leave the other direction open.
    let matrix2 = if square.determinant() > 1e-12 {
        product * square.inverse()
    } else {
        DMat2::IDENTITY
    };
    DAffine2 {
        matrix2,
        translation: mean_image - matrix2 * mean,
    }
}

fn write_gradient(text: &mut String, id: &str, gradient: &Gradient, motion: DAffine2) {
    let (name, place) = match gradient.kind {
        GradientKind::Linear { from, to } => (
            "linearGradient",
            format!(
                "x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\"",
                from.x, from.y, to.x, to.y
            ),
        ),
        GradientKind::Radial {
            centre,
            radius,
            focus,
            focus_radius,
        } => (
            "radialGradient",
            format!(
                "cx=\"{}\" cy=\"{}\" r=\"{radius}\" fx=\"{}\" fy=\"{}\" fr=\"{focus_radius}\"",
                centre.x, centre.y, focus.x, focus.y
            ),
        ),
    };
    let DAffine2 {
        matrix2,
        translation,
    } = motion * gradient.place;
    let (x, y) = (matrix2.x_axis, matrix2.y_axis);
    let _ = write!(
        text,
        "<{name} id=\"{id}\" gradientUnits=\"userSpaceOnUse\" {place} spreadMethod=\"{}\" \
         gradientTransform=\"matrix({} {} {} {} {} {})\">",
        gradient.spread, x.x, x.y, y.x, y.y, translation.x, translation.y
    );
    for (offset, [r, g, b], opacity) in &gradient.stops {
        let _ = write!(
            text,
            "<stop offset=\"{offset}\" stop-color=\"#{r:02x}{g:02x}{b:02x}\" stop-opacity=\"{opacity}\"/>"
        );
    }
    let _ = writeln!(text, "</{name}>");
}

/// The data of a path. Numbers have as many digits as a millionth of a large drawing takes.
fn path_data(outline: &Outline) -> String {
    let number = |value: f64| {
        let text = format!("{value:.5}");
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    };
    let point = |at: DVec2| format!("{} {}", number(at.x), number(at.y));
    let segment = |segment: &Segment| match *segment {
        Segment::Move(to) => format!("M{}", point(to)),
        Segment::Line(to) => format!("L{}", point(to)),
        Segment::Quadratic(control, to) => format!("Q{} {}", point(control), point(to)),
        Segment::Cubic(one, other, to) => format!("C{} {} {}", point(one), point(other), point(to)),
        Segment::Close => "Z".to_owned(),
    };
    outline.0.iter().map(segment).collect()
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}
