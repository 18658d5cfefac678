use glam::Vec3;

/// An axis-aligned box, closed. `min <= max` on every axis, or it is [`Aabb::EMPTY`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aabb {
    /// Lowest corner; +infinity in [`Aabb::EMPTY`].
    pub min: Vec3,
    /// Highest corner; -infinity in [`Aabb::EMPTY`].
    pub max: Vec3,
}

impl Aabb {
    /// Holds no point; the neutral element of [`Aabb::union`].
    pub const EMPTY: Self = Self {
        min: Vec3::INFINITY,
        max: Vec3::NEG_INFINITY,
    };
    /// The unit cube, a template's own box.
    pub const UNIT: Self = Self {
        min: Vec3::ZERO,
        max: Vec3::ONE,
    };

    /// The smallest box that holds all the points.
    pub fn from_points(points: impl IntoIterator<Item = Vec3>) -> Self {
        points.into_iter().fold(Self::EMPTY, |aabb, pos| Self {
            min: aabb.min.min(pos),
            max: aabb.max.max(pos),
        })
    }

    /// The box of two boxes.
    pub fn union(self, other: Self) -> Self {
        Self {
            min: self.min.min(other.min),
            max: self.max.max(other.max),
        }
    }

    /// What two boxes share, or [`Aabb::EMPTY`].
    pub fn intersection(self, other: Self) -> Self {
        let both = Self {
            min: self.min.max(other.min),
            max: self.max.min(other.max),
        };
        if both.is_empty() { Self::EMPTY } else { both }
    }

    /// Grown by `margin` on all six sides.
    pub fn expanded(self, margin: f32) -> Self {
        Self {
            min: self.min - margin,
            max: self.max + margin,
        }
    }

    /// True if it holds no point.
    pub fn is_empty(&self) -> bool {
        self.min.cmpgt(self.max).any()
    }

    /// True if the point is inside or on a face.
    pub fn contains(&self, pos: Vec3) -> bool {
        self.min.cmple(pos).all() && pos.cmple(self.max).all()
    }

    /// The point in the middle.
    pub fn center(&self) -> Vec3 {
        (self.min + self.max) * 0.5
    }

    /// Lengths of the sides.
    pub fn size(&self) -> Vec3 {
        self.max - self.min
    }

    /// The eight corners, x fastest.
    pub fn corners(&self) -> [Vec3; 8] {
        std::array::from_fn(|i| {
            let pick = |bit: usize, lo: f32, hi: f32| if i & bit == 0 { lo } else { hi };
            Vec3::new(
                pick(1, self.min.x, self.max.x),
                pick(2, self.min.y, self.max.y),
                pick(4, self.min.z, self.max.z),
            )
        })
    }
}
