//! The curve that a template may be laid along.

use crate::math::{Bent, NotBent, OnLine};
use glam::{Vec2, Vec3};

/// The line that a template's top lies along, from x = 0 to x = 1 (dissertation, section 5.3).
///
/// The x-z plane of the template bends with the line; y stays straight. Beyond its ends the line goes straight on. The
/// template is as long as the line.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// x and z in template space; 2 to [`crate::document::MAX_CURVE`] points.
    pub points: Vec<Vec2>,
    /// True: a smooth curve through the points. False: straight from each point to the next.
    pub is_spline: bool,
    /// Which part of the box lies on the line. In a document that is always the top ([`OnLine::TOP`]); a template that
    /// acts in part ([`super::PlacedTemplate::acting`]) has another part there.
    pub on_line: OnLine,
}

impl Curve {
    /// A smooth curve through these points (x and z in template space).
    pub fn spline(points: Vec<Vec2>) -> Self {
        Self {
            points,
            is_spline: true,
            on_line: OnLine::TOP,
        }
    }

    /// The line that bends nothing, with as many points as `like`.
    fn straight(like: &Self) -> Self {
        let last = like.points.len().saturating_sub(1).max(1) as f32;
        let points = (0..like.points.len()).map(|i| Vec2::new(i as f32 / last, 1.0));
        Self {
            points: points.collect(),
            ..like.clone()
        }
    }

    /// The space that is bent along the line, for a box of this size (subject units).
    ///
    /// # Errors
    /// [`NotBent`] if the points make no line; the template is straight then.
    pub fn bent(&self, size: Vec3) -> Result<Bent, NotBent> {
        Bent::new(&self.points, self.is_spline, size, self.on_line)
    }

    /// The mirror image across the middle of x. The order of the points is reversed as well.
    #[must_use]
    pub fn mirrored(&self) -> Self {
        let points = self.points.iter().rev();
        Self {
            points: points.map(|p| Vec2::new(1.0 - p.x, p.y)).collect(),
            ..self.clone()
        }
    }

    /// The curve for a box that is scaled by `part` about `center` (template units), so that tissue in the smaller box
    /// is bent as it was in the larger one.
    #[must_use]
    pub(super) fn in_part(&self, part: Vec2, center: Vec2) -> Self {
        let to = |q: Vec2| center + (q - center) / part;
        let [from, until] = self.on_line.ends;
        Self {
            points: self.points.iter().map(|p| to(*p)).collect(),
            is_spline: self.is_spline,
            on_line: OnLine {
                height: to(Vec2::new(0.0, self.on_line.height)).y,
                ends: [from, until].map(|x| to(Vec2::new(x, 0.0)).x),
            },
        }
    }

    /// The curve `part` (0 to 1) of the way between two curves; `None` stands for the straight line.
    pub(crate) fn blend(from: Option<&Self>, to: Option<&Self>, part: f32) -> Option<Self> {
        if part >= 1.0 {
            return to.cloned();
        }
        let [a, b] = match (from, to) {
            (None, None) => return None,
            (Some(a), None) => [a.clone(), Self::straight(a)],
            (None, Some(b)) => [Self::straight(b), b.clone()],
            (Some(a), Some(b)) => [a.clone(), b.clone()],
        };
        if a.points.len() != b.points.len() {
            return Some(b);
        }
        let pairs = a.points.iter().zip(&b.points);
        Some(Self {
            points: pairs.map(|(a, b)| a.lerp(*b, part)).collect(),
            ..b
        })
    }
}
