use std::collections::{BTreeMap, BTreeSet};

use glam::{DAffine2, DMat2, DVec2, dvec2};
use usvg::tiny_skia_path::PathSegment;

use super::error::SvgError;
use super::expansion::{check_entities, check_weight};
use super::intricacy;
use super::limits::{MAX_ELEMENTS, check_elements, check_nesting, xml_error};
use super::paint::{Look, affine, look};
use super::path::{Outline, Segment, TOLERANCE};
use super::words::{Word, words};
use crate::data::{PlateShape, PlateWord};
use crate::figure::outlines::distance_squared;
use crate::figure::plane::Plane;
use crate::figure::regions::{Fill, Mask, add_filled};

/// Bytes of a file at most.
const MAX_BYTES: usize = 8 << 20;
/// By how much the curves of a shape may be missed where it is pointed at, subject units.
const POINTED_TOLERANCE: f64 = 1e-3;
/// Points of all shapes that can be pointed at: beyond that a drawing has no parts that one would click.
const MOST_POINTED: usize = 200_000;

/// The shapes of an SVG. Coordinates are in units of its view box, from its upper left corner, y down.
#[derive(Clone, Debug)]
pub struct Drawing {
    /// Width and height of the view box; without one, of the drawing.
    pub size: DVec2,
    /// The shapes in the order of drawing.
    pub shapes: Vec<Shape>,
    /// The words of text, which is not drawn; they are offered as labels.
    pub words: Vec<Word>,
    /// Kinds of elements that are not drawn.
    pub left_out: BTreeSet<&'static str>,
}

/// A shape of an SVG.
#[derive(Clone, Debug)]
pub struct Shape {
    /// Ids of the element and of the groups that it is in, the outermost first; without those that have none.
    pub ids: Vec<String>,
    has_own_id: bool,
    /// What is filled or stroked.
    pub outline: Outline,
    /// Whether it is filled, and by the even-odd rule.
    pub fill: Option<bool>,
    pub(crate) look: Look,
}

impl Shape {
    /// The id of its own element, if it has one.
    pub fn id(&self) -> Option<&str> {
        self.ids
            .last()
            .filter(|_| self.has_own_id)
            .map(String::as_str)
    }
}

impl Drawing {
    /// Reads an SVG. Nothing but the bytes is read: files and addresses in it are left aside.
    ///
    /// # Errors
    /// [`SvgError`].
    pub fn read(bytes: &[u8]) -> Result<Self, SvgError> {
        if bytes.len() > MAX_BYTES {
            return Err(SvgError::TooLarge {
                bytes: bytes.len(),
                limit: MAX_BYTES,
            });
        }
        let text = std::str::from_utf8(bytes).map_err(|error| {
            let before = &bytes[..error.valid_up_to()];
            let line = before.iter().filter(|byte| **byte == b'\n').count() as u32 + 1;
            let column = before
                .iter()
                .rev()
                .take_while(|byte| **byte != b'\n')
                .count() as u32
                + 1;
            SvgError::NoXml { line, column }
        })?;
        check_nesting(text)?;
        check_entities(text)?;
        let options = usvg::roxmltree::ParsingOptions {
            allow_dtd: true,
            // Text and attributes count as nodes too.
            nodes_limit: 4 * MAX_ELEMENTS as u32,
            ..usvg::roxmltree::ParsingOptions::default()
        };
        let document = usvg::roxmltree::Document::parse_with_options(text, options)
            .map_err(|error| xml_error(&error))?;
        check_elements(&document)?;
        check_weight(&document)?;
        let options = usvg::Options {
            image_href_resolver: usvg::ImageHrefResolver {
                resolve_data: Box::new(|_, _, _| None),
                resolve_string: Box::new(|_, _| None),
            },
            ..usvg::Options::default()
        };
        let tree = usvg::Tree::from_xmltree(&document, &options).map_err(|error| match error {
            usvg::Error::ElementsLimitReached => SvgError::TooMany {
                limit: MAX_ELEMENTS,
            },
            // The elements themselves are few enough: their uses are not.
            usvg::Error::ParsingFailed(_) => SvgError::Uses,
            _ => SvgError::NoSvg,
        })?;
        let (size, view_from_tree) = view(&document, &tree);
        let mut drawing = Self {
            size,
            shapes: Vec::new(),
            words: words(&document, size),
            left_out: left_out(&document),
        };
        drawing.add(tree.root(), view_from_tree, &mut Vec::new(), 1.0)?;
        let shapes = drawing.shapes.iter();
        intricacy::check(size, shapes.map(|shape| (&shape.outline, &shape.look)))?;
        Ok(drawing)
    }

    /// Adds the shapes of a group.
    fn add(
        &mut self,
        group: &usvg::Group,
        view_from_tree: DAffine2,
        ids: &mut Vec<String>,
        opacity: f64,
    ) -> Result<(), SvgError> {
        let has_id = !group.id().is_empty();
        if has_id {
            ids.push(group.id().to_owned());
        }
        let opacity = opacity * f64::from(group.opacity().get());
        for node in group.children() {
            match node {
                usvg::Node::Group(group) => self.add(group, view_from_tree, ids, opacity)?,
                usvg::Node::Path(path) if path.is_visible() => {
                    if self.shapes.len() >= MAX_ELEMENTS {
                        return Err(SvgError::TooMany {
                            limit: MAX_ELEMENTS,
                        });
                    }
                    let place = view_from_tree * affine(path.abs_transform());
                    let outline = outline(path.data(), place);
                    if !outline.is_finite() {
                        // Numbers too large for usvg: nobody can tell where it lies.
                        continue;
                    }
                    let mut ids = ids.clone();
                    ids.extend((!path.id().is_empty()).then(|| path.id().to_owned()));
                    self.shapes.push(Shape {
                        ids,
                        has_own_id: !path.id().is_empty(),
                        outline,
                        fill: path
                            .fill()
                            .map(|fill| fill.rule() == usvg::FillRule::EvenOdd),
                        look: look(path, place, opacity),
                    });
                }
                usvg::Node::Path(_) | usvg::Node::Image(_) | usvg::Node::Text(_) => {}
            }
        }
        if has_id {
            ids.pop();
        }
        Ok(())
    }

    /// The filled shapes with their numbers.
    pub fn filled(&self) -> impl Iterator<Item = (usize, &Shape)> {
        self.shapes
            .iter()
            .filter(|shape| shape.fill.is_some())
            .enumerate()
    }

    /// The shapes that a region takes by a path: those of an element and below it by its id, or a filled one by its
    /// number.
    pub fn taken(&self, path: &str) -> Vec<&Shape> {
        let has_id = |shape: &Shape| shape.ids.iter().any(|id| id == path);
        let by_id: Vec<&Shape> = self
            .filled()
            .map(|(_, shape)| shape)
            .filter(|shape| has_id(shape))
            .collect();
        if !by_id.is_empty() {
            return by_id;
        }
        let number = path.parse::<usize>().ok();
        self.filled()
            .filter(|(i, _)| Some(*i) == number)
            .map(|(_, shape)| shape)
            .collect()
    }

    /// A place of the view box in the plane of a figure.
    fn on_plane(&self, at: DVec2) -> DVec2 {
        let place = (at - 0.5 * self.size) / self.size.max_element();
        dvec2(place.x, -place.y)
    }

    /// The texts with their places in the plane of a figure.
    pub fn offered(&self) -> Vec<PlateWord> {
        let offered = |word: &Word| PlateWord {
            text: word.text.clone(),
            at: self.on_plane(word.at).as_vec2(),
        };
        self.words.iter().map(offered).collect()
    }

    /// The filled shapes as a click finds them, in the plane of a figure.
    pub fn pointed(&self) -> Vec<PlateShape> {
        let to_plane = |at: DVec2| self.on_plane(at);
        let mut count_of_id: BTreeMap<&str, u32> = BTreeMap::new();
        for id in self.filled().flat_map(|(_, shape)| &shape.ids) {
            *count_of_id.entry(id).or_default() += 1;
        }
        let mut left = MOST_POINTED;
        let mut shapes = Vec::new();
        for (number, shape) in self.filled() {
            let lines = shape.outline.mapped(to_plane).flattened(POINTED_TOLERANCE);
            let count = lines.iter().map(Vec::len).sum::<usize>();
            let Some(rest) = left.checked_sub(count) else {
                break;
            };
            left = rest;
            let own_id = shape.id().filter(|id| count_of_id.get(id) == Some(&1));
            shapes.push(PlateShape {
                path: own_id.map_or_else(|| number.to_string(), str::to_owned),
                lines: (lines.iter())
                    .map(|line| line.iter().map(|at| at.as_vec2()).collect())
                    .collect(),
                is_even_odd: shape.fill == Some(true),
            });
        }
        shapes
    }

    /// What a region takes by a path, in map space; none if there is no such element or shape.
    pub fn fills(&self, plane: &Plane, path: &str) -> Option<Vec<Fill>> {
        let scale = plane.map_size() / self.size;
        let fill = |shape: &&Shape| Fill {
            lines: shape.outline.mapped(|at| at * scale).flattened(TOLERANCE),
            is_even_odd: shape.fill == Some(true),
        };
        let taken = self.taken(path);
        (!taken.is_empty()).then(|| taken.iter().map(fill).collect())
    }

    /// The pixels of the map that are not fully transparent: those whose centres shapes fill, or lines along them
    /// cover.
    pub fn drawn(&self, plane: &Plane) -> Mask {
        let mut mask = Mask::none(plane.map.map(|side| side as usize));
        let scale = plane.map_size() / self.size;
        for shape in self.shapes.iter().filter(|shape| shape.look.opacity > 0.0) {
            let lines = shape.outline.mapped(|at| at * scale).flattened(TOLERANCE);
            if let Some(stroke) = shape
                .look
                .stroke
                .as_ref()
                .filter(|stroke| stroke.opacity > 0.0)
            {
                // A thin line covers some pixel everywhere.
                let half = (stroke.width * scale.max_element() / 2.0).max(0.75);
                lines
                    .iter()
                    .for_each(|line| add_line(&mut mask, line, half));
            }
            if shape
                .look
                .fill
                .as_ref()
                .is_some_and(|(_, opacity)| *opacity > 0.0)
            {
                let is_even_odd = shape.fill == Some(true);
                add_filled(&mut mask, &Fill { lines, is_even_odd });
            }
        }
        mask
    }
}

/// Adds the pixels whose centres are within `half` of a line, pixels.
fn add_line(mask: &mut Mask, line: &[DVec2], half: f64) {
    let [width, height] = mask.size;
    for ends in line.windows(2) {
        let low = ends[0].min(ends[1]) - half;
        let high = ends[0].max(ends[1]) + half;
        let range = |low: f64, high: f64, side: usize| {
            (low.max(0.0) as usize)..((high.max(0.0) as usize + 1).min(side))
        };
        let along = ends[1] - ends[0];
        for row in range(low.y, high.y, height) {
            // Only what of the line lies within `half` of the row can be near its pixels; a bit more is looked at.
            let y = row as f64 + 0.5;
            let (mut from, mut to) = (low.x, high.x);
            if along.y.abs() > 1e-9 {
                let at = |y: f64| ((y - ends[0].y) / along.y).clamp(0.0, 1.0);
                let xs = [y - half, y + half].map(|y| ends[0].x + at(y) * along.x);
                from = xs[0].min(xs[1]) - half - 1.0;
                to = xs[0].max(xs[1]) + half + 1.0;
            }
            for column in range(from, to, width) {
                let centre = dvec2(column as f64 + 0.5, row as f64 + 0.5);
                mask.bits[row * width + column] |=
                    distance_squared(centre, ends[0], ends[1]) <= half * half;
            }
        }
    }
}

/// Size of the view box, and the map into it from where usvg has brought it.
fn view(document: &usvg::roxmltree::Document<'_>, tree: &usvg::Tree) -> (DVec2, DAffine2) {
    let size = dvec2(
        f64::from(tree.size().width()),
        f64::from(tree.size().height()),
    );
    let root = document.root_element();
    let numbers = |text: &str| -> Option<[f64; 4]> {
        let parts = text
            .split(|c: char| c.is_whitespace() || c == ',')
            .filter(|part| !part.is_empty());
        let numbers: Option<Vec<f64>> = parts.map(|part| part.parse().ok()).collect();
        numbers?
            .try_into()
            .ok()
            .filter(|[.., w, h]: &[f64; 4]| *w > 0.0 && *h > 0.0)
    };
    // The corner of the view box is at the origin already.
    let Some([_, _, width, height]) = root.attribute("viewBox").and_then(numbers) else {
        return (size, DAffine2::IDENTITY);
    };
    let view = dvec2(width, height);
    let aspect = root
        .attribute("preserveAspectRatio")
        .unwrap_or("xMidYMid meet");
    let each = size / view;
    let scale = if aspect.contains("none") {
        each
    } else if aspect.contains("slice") {
        DVec2::splat(each.max_element())
    } else {
        DVec2::splat(each.min_element())
    };
    let align = |low: &str, high: &str| {
        if aspect.contains(low) {
            0.0
        } else if aspect.contains(high) {
            1.0
        } else {
            0.5
        }
    };
    let align = dvec2(align("xMin", "xMax"), align("YMin", "YMax"));
    let tree_from_view = DAffine2 {
        matrix2: DMat2::from_diagonal(scale),
        translation: align * (size - view * scale),
    };
    (view, tree_from_view.inverse())
}

fn outline(path: &usvg::tiny_skia_path::Path, place: DAffine2) -> Outline {
    let at = |p: usvg::tiny_skia_path::Point| {
        place.transform_point2(dvec2(f64::from(p.x), f64::from(p.y)))
    };
    let segment = |segment| match segment {
        PathSegment::MoveTo(to) => Segment::Move(at(to)),
        PathSegment::LineTo(to) => Segment::Line(at(to)),
        PathSegment::QuadTo(control, to) => Segment::Quadratic(at(control), at(to)),
        PathSegment::CubicTo(one, other, to) => Segment::Cubic(at(one), at(other), at(to)),
        PathSegment::Close => Segment::Close,
    };
    Outline(path.segments().map(segment).collect())
}

/// Kinds of elements that are not drawn, by their names.
fn left_out(document: &usvg::roxmltree::Document<'_>) -> BTreeSet<&'static str> {
    const KINDS: [&str; 12] = [
        "text",
        "script",
        "animate",
        "animateMotion",
        "animateTransform",
        "set",
        "image",
        "foreignObject",
        "filter",
        "mask",
        "clipPath",
        "pattern",
    ];
    let is_there = |kind: &&str| {
        document
            .descendants()
            .any(|node| node.is_element() && node.tag_name().name() == *kind)
    };
    KINDS.into_iter().filter(|kind| is_there(kind)).collect()
}
