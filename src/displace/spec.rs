//! What a kind of template is called and which parameters it takes: names, meanings, defaults, ranges.

use glam::{Quat, Vec3};

/// A kind's name, meaning and parameters.
#[derive(Debug)]
pub struct TemplateSpec {
    /// As written in documents.
    pub name: &'static str,
    /// One line, in the reader's terms.
    pub summary: &'static str,
    /// Parameters in the order in which they are packed for the GPU.
    pub params: &'static [ParamSpec],
    /// Index in `params` of the one that is dragged in the picture, if there is one.
    pub main_param: Option<usize>,
}

/// A parameter's name, meaning, default and range.
#[derive(Debug)]
pub struct ParamSpec {
    /// As written in documents.
    pub name: &'static str,
    /// One line, with the unit.
    pub summary: &'static str,
    /// Type, default and range.
    pub kind: ParamKind,
}

/// Type, default and range of a parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ParamKind {
    /// A number in a closed range.
    Number {
        /// The value if the document gives none.
        default: f32,
        /// Lowest value; smaller ones are raised to this.
        min: f32,
        /// Highest value; larger ones are lowered to this.
        max: f32,
    },
    /// A whole number in a closed range; fractions are rounded, halves up.
    Count {
        /// The value if the document gives none.
        default: f32,
        /// Lowest value; smaller ones are raised to this.
        min: f32,
        /// Highest value; larger ones are lowered to this.
        max: f32,
    },
    /// A switch, true or false.
    Flag {
        /// The value if the document gives none.
        default: bool,
    },
    /// One of several names; packed as the index.
    Choice {
        /// The names; the first is the default.
        names: &'static [&'static str],
    },
    /// Three numbers that belong together.
    Vector {
        /// The value if the document gives none.
        default: [f32; 3],
        /// Range of each component.
        min: f32,
        /// Range of each component.
        max: f32,
        /// A longer one is scaled to this length.
        max_length: f32,
    },
    /// A unit quaternion x, y, z, w; the default is the identity.
    Rotation,
}

/// The value of a parameter, inside the range that its [`ParamKind`] gives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ParamValue {
    /// Value of a [`ParamKind::Number`] or [`ParamKind::Count`].
    Number(f32),
    /// Value of a [`ParamKind::Flag`].
    Flag(bool),
    /// Value of a [`ParamKind::Choice`]: the index of the name.
    Choice(u32),
    /// Value of a [`ParamKind::Vector`].
    Vector(Vec3),
    /// Value of a [`ParamKind::Rotation`], of unit length.
    Rotation(Quat),
}

/// Floats that the parameters of one template take at most when packed for the GPU.
pub const MAX_PARAM_FLOATS: usize = 8;

impl ParamKind {
    /// The value if the document does not give one.
    pub fn default_value(&self) -> ParamValue {
        match *self {
            Self::Number { default, .. } | Self::Count { default, .. } => {
                ParamValue::Number(default)
            }
            Self::Flag { default } => ParamValue::Flag(default),
            Self::Choice { .. } => ParamValue::Choice(0),
            Self::Vector { default, .. } => ParamValue::Vector(Vec3::from_array(default)),
            Self::Rotation => ParamValue::Rotation(Quat::IDENTITY),
        }
    }
}

impl ParamValue {
    /// Appends the value as the shaders take it: flags 0 or 1, choices as their index, quaternions x, y, z, w.
    pub fn pack(&self, floats: &mut Vec<f32>) {
        match *self {
            Self::Number(value) => floats.push(value),
            Self::Flag(value) => floats.push(f32::from(u8::from(value))),
            Self::Choice(index) => floats.push(index as f32),
            Self::Vector(v) => floats.extend(v.to_array()),
            Self::Rotation(q) => floats.extend(q.to_array()),
        }
    }
}

/// The specification of a number.
pub(super) const fn number(
    name: &'static str,
    summary: &'static str,
    default: f32,
    min: f32,
    max: f32,
) -> ParamSpec {
    ParamSpec {
        name,
        summary,
        kind: ParamKind::Number { default, min, max },
    }
}
