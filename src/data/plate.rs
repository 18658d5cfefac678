//! The flat picture of a figure, as it is drawn.

use std::sync::Arc;

use glam::{DVec2, DVec3, Vec2, Vec3};

use super::frame::SubjectFrame;
use crate::math::{Aabb, winding};
use crate::pictures::Picture;

/// The picture of a figure: a plate, a photograph or a drawing that lies in the plane z = 0 of its subject space. Its
/// middle is the origin, y is up, and its longest side is 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Plate {
    /// Width and height of the source: pixels, or units of a drawing's view box.
    pub size: DVec2,
    /// The pixels that are drawn: those of the source, of its smaller copy, or those that a drawing was drawn into.
    pub picture: Picture,
    /// What regions are found in.
    pub origin: PlateOrigin,
    /// The filled shapes of an SVG from a file, from behind to front, as far as they can be pointed at.
    pub shapes: Vec<PlateShape>,
    /// The texts of an SVG, which are not drawn: they are offered as captions.
    pub words: Vec<PlateWord>,
}

/// A text of a drawing.
#[derive(Clone, Debug, PartialEq)]
pub struct PlateWord {
    /// What stands there.
    pub text: String,
    /// Where it begins, subject space.
    pub at: Vec2,
}

/// A filled shape of a drawing, so that a click can find it.
#[derive(Clone, Debug, PartialEq)]
pub struct PlateShape {
    /// By which a region takes it: its id, or where that is no single shape's its number among the filled ones.
    pub path: String,
    /// Its outlines, closed, subject space.
    pub lines: Vec<Vec<Vec2>>,
    /// It is filled by the even-odd rule, not the non-zero one.
    pub is_even_odd: bool,
}

impl PlateShape {
    /// True if the shape fills a place of subject space.
    pub fn fills(&self, at: Vec2) -> bool {
        let around = |line: &Vec<Vec2>| {
            let places = line.iter().map(|place| place.as_dvec2());
            winding(places, at.as_dvec2())
        };
        let turns: i32 = self.lines.iter().map(around).sum();
        match self.is_even_odd {
            true => turns % 2 != 0,
            false => turns != 0,
        }
    }
}

/// Where the pixels of a plate come from.
#[derive(Clone, Debug, PartialEq)]
pub enum PlateOrigin {
    /// From the file of a picture: regions are found in the pixels.
    Pixels,
    /// From an SVG, whose bytes these are: regions are found in its shapes.
    Drawing(Arc<[u8]>),
    /// From a drawing of the program, by its name.
    Builtin(String),
}

impl Plate {
    /// Half of the width and of the height, subject units: the plate reaches from minus this to this.
    pub fn half_size(&self) -> DVec2 {
        self.size / (2.0 * self.size.max_element())
    }

    /// Where the plate lies, and how fine it is.
    pub fn frame(&self) -> SubjectFrame {
        let half = self.half_size().as_vec2().extend(0.0);
        let most = self.picture.size[0].max(self.picture.size[1]);
        SubjectFrame {
            bounds: Aabb {
                min: -half,
                max: half,
            },
            // A picture does not say how large what it shows is.
            mm_per_unit: 1.0,
            middle_mm: DVec3::ZERO,
            detail: 1.0 / most.max(1) as f32,
        }
    }

    /// True if a drawing has fewer pixels than its longest side has on a screen, and more could be drawn.
    pub fn is_coarse(&self, seen_px: f32) -> bool {
        let [width, height] = self.picture.size;
        !self.has_pixels() && seen_px > width.max(height) as f32
    }

    /// The plate with other pixels of the same drawing.
    pub fn redrawn(&self, picture: Picture) -> Self {
        Self {
            size: self.size,
            picture,
            origin: self.origin.clone(),
            shapes: self.shapes.clone(),
            words: self.words.clone(),
        }
    }

    /// True if regions are found in the pixels, not in shapes.
    pub fn has_pixels(&self) -> bool {
        self.origin == PlateOrigin::Pixels
    }

    /// The shape of a drawing that is seen at a place of subject space, as it is at rest.
    pub fn shape_at(&self, at: Vec2) -> Option<&PlateShape> {
        self.shapes.iter().rev().find(|shape| shape.fills(at))
    }

    /// The colour of the pixel that a point of subject space lies in, straight sRGB with alpha; `None` outside.
    pub fn color_at(&self, place: Vec3) -> Option<[u8; 4]> {
        let [width, height] = self.picture.size.map(f64::from);
        let at = place.as_dvec3();
        let part = DVec2::new(at.x, -at.y) / (2.0 * self.half_size()) + 0.5;
        let (column, row) = ((part.x * width).floor(), (part.y * height).floor());
        let is_inside = column >= 0.0 && row >= 0.0 && column < width && row < height;
        let index = row as usize * self.picture.size[0] as usize + column as usize;
        (self.picture.pixels.get(index).copied()).filter(|_| is_inside)
    }
}
