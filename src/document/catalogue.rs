use glam::{Quat, Vec3};

/// The kinds of templates, as in spec/templates.md. The discriminant is the number the shaders know them by.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[repr(u32)]
#[expect(missing_docs, reason = "each kind is described by its `spec`")]
pub enum TemplateKind {
    Poke = 1,
    Twist,
    Wave,
    Bend,
    Squeeze,
    Dilate,
    Peel,
    Flap,
    Split,
    Slices,
    Retractor,
    Cutquad,
    Peeler,
    Pull,
    Cut,
    Hole,
    Lens,
    Move,
    Rbf,
    Field,
}

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
        /// If the document says nothing.
        default: f32,
        /// Lowest.
        min: f32,
        /// Highest.
        max: f32,
    },
    /// A whole number in a closed range; fractions are rounded, halves up.
    Count {
        /// If the document says nothing.
        default: f32,
        /// Lowest.
        min: f32,
        /// Highest.
        max: f32,
    },
    /// Yes or no.
    Flag {
        /// If the document says nothing.
        default: bool,
    },
    /// One of several names; packed as the index.
    Choice {
        /// The names; the first is the default.
        names: &'static [&'static str],
    },
    /// A vector.
    Vector {
        /// If the document says nothing.
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

/// A parameter's value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ParamValue {
    /// Of [`ParamKind::Number`] and [`ParamKind::Count`].
    Number(f32),
    /// Of [`ParamKind::Flag`].
    Flag(bool),
    /// Of [`ParamKind::Choice`]: the index.
    Choice(u32),
    /// Of [`ParamKind::Vector`].
    Vector(Vec3),
    /// Of [`ParamKind::Rotation`].
    Rotation(Quat),
}

/// Floats that the parameters of one template take at most when packed for the GPU.
pub const MAX_PARAM_FLOATS: usize = 8;

impl ParamKind {
    /// What it is if the document says nothing.
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

const fn number(
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

impl TemplateKind {
    /// Every kind, in catalogue order.
    pub const ALL: [Self; 20] = {
        let mut all = [Self::Rbf; 20];
        let mut i = 0;
        while i < Self::FORMULAS.len() {
            all[i] = Self::FORMULAS[i];
            i += 1;
        }
        all[19] = Self::Field;
        all
    };

    /// The kinds that are described whole by their parameters. The others have [`super::TemplateData`] besides.
    pub const FORMULAS: [Self; 18] = [
        Self::Poke,
        Self::Twist,
        Self::Wave,
        Self::Bend,
        Self::Squeeze,
        Self::Dilate,
        Self::Peel,
        Self::Flap,
        Self::Split,
        Self::Slices,
        Self::Retractor,
        Self::Cutquad,
        Self::Peeler,
        Self::Pull,
        Self::Cut,
        Self::Hole,
        Self::Lens,
        Self::Move,
    ];

    /// The kind of a name as written in documents.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.spec().name == name)
    }

    /// Name, meaning and parameters.
    pub const fn spec(self) -> &'static TemplateSpec {
        use std::f32::consts::{FRAC_PI_2, FRAC_PI_4, PI, TAU};
        match self {
            Self::Poke => {
                const {
                    &TemplateSpec {
                        name: "poke",
                        summary: "Push in or pull out a bump along z",
                        params: &[
                            number("amount", "Height; positive pulls out", 0.5, -2.0, 0.95),
                            number("sigma", "Width of the bump", 0.15, 0.05, 0.3),
                        ],
                        main_param: Some(0),
                    }
                }
            }
            Self::Twist => {
                const {
                    &TemplateSpec {
                        name: "twist",
                        summary: "Turn about the z axis",
                        params: &[
                            number(
                                "angle",
                                "Turn of the middle, radians",
                                FRAC_PI_2,
                                -2.0 * TAU,
                                2.0 * TAU,
                            ),
                            number(
                                "falloff",
                                "0 turns the whole box, 1 falls off from the axis on",
                                0.3,
                                0.0,
                                1.0,
                            ),
                        ],
                        main_param: Some(0),
                    }
                }
            }
            Self::Wave => {
                const {
                    &TemplateSpec {
                        name: "wave",
                        summary: "Concentric ripple along y",
                        params: &[
                            number("amplitude", "Height of the ripple", 0.08, 0.0, 0.5),
                            number(
                                "frequency",
                                "Radians per unit of radius",
                                2.0 * TAU,
                                0.0,
                                64.0,
                            ),
                            number(
                                "falloff",
                                "0 ripples the whole box, 1 falls off from the axis on",
                                0.5,
                                0.0,
                                1.0,
                            ),
                        ],
                        main_param: Some(0),
                    }
                }
            }
            Self::Bend => {
                const {
                    &TemplateSpec {
                        name: "bend",
                        summary: "Bend a bar that runs along y",
                        params: &[
                            number(
                                "angle",
                                "Towards -z, or +z if negative, radians",
                                FRAC_PI_4,
                                -PI,
                                PI,
                            ),
                            number("start", "Where along y the bend begins", 0.25, 0.0, 1.0),
                            number("end", "Where along y the bend ends", 0.75, 0.0, 1.0),
                        ],
                        main_param: Some(0),
                    }
                }
            }
            Self::Squeeze => {
                const {
                    &TemplateSpec {
                        name: "squeeze",
                        summary: "A waist at mid height",
                        params: &[number("strength", "How narrow", 0.5, 0.0, 2.0)],
                        main_param: Some(0),
                    }
                }
            }
            Self::Dilate => {
                const {
                    &TemplateSpec {
                        name: "dilate",
                        summary: "A bulge at mid height",
                        params: &[number("strength", "How wide", 0.5, 0.0, 0.9)],
                        main_param: Some(0),
                    }
                }
            }
            Self::Peel => {
                const {
                    &TemplateSpec {
                        name: "peel",
                        summary: "Roll a layer up from the x = 0 edge",
                        params: &[
                            number(
                                "progress",
                                "How far along x the hinge has come",
                                0.5,
                                0.0,
                                1.0,
                            ),
                            number(
                                "depth",
                                "Thickness of the layer under the top, fraction of z",
                                0.3,
                                0.01,
                                1.0,
                            ),
                            number(
                                "radius",
                                "Inside of the roll, fraction of x",
                                0.15,
                                0.01,
                                2.0,
                            ),
                            number(
                                "angle",
                                "Where the roll ends and the flap goes on straight, radians",
                                PI,
                                0.0,
                                TAU,
                            ),
                        ],
                        main_param: Some(0),
                    }
                }
            }
            Self::Flap => {
                const {
                    &TemplateSpec {
                        name: "flap",
                        summary: "A door that opens about its x = 0, z = 1 edge",
                        params: &[
                            number("angle", "How far it is open, radians", FRAC_PI_2, 0.0, PI),
                            number(
                                "depth",
                                "Thickness of the door under the top, fraction of z",
                                0.3,
                                0.01,
                                1.0,
                            ),
                        ],
                        main_param: Some(0),
                    }
                }
            }
            Self::Split => {
                const {
                    &TemplateSpec {
                        name: "split",
                        summary: "Two halves apart along x",
                        params: &[
                            number("amount", "Half width of the opening", 0.25, 0.0, 1.0),
                            number(
                                "lens",
                                "1 closes the opening at both ends in y",
                                0.0,
                                0.0,
                                1.0,
                            ),
                            ParamSpec {
                                name: "wedge",
                                summary: "Closed at the bottom, open at the top",
                                kind: ParamKind::Flag { default: true },
                            },
                        ],
                        main_param: Some(0),
                    }
                }
            }
            Self::Slices => {
                const {
                    &TemplateSpec {
                        name: "slices",
                        summary: "Cut into slabs along z and draw them apart",
                        params: &[
                            ParamSpec {
                                name: "count",
                                summary: "Number of slabs",
                                kind: ParamKind::Count {
                                    default: 4.0,
                                    min: 1.0,
                                    max: 32.0,
                                },
                            },
                            number("gap", "Between two slabs", 0.1, 0.0, 2.0),
                            number("shift", "Sideways, along x, per slab", 0.0, -1.0, 1.0),
                            number("progress", "0 closed, 1 drawn apart", 1.0, 0.0, 1.0),
                        ],
                        main_param: Some(3),
                    }
                }
            }
            Self::Retractor => {
                const {
                    &TemplateSpec {
                        name: "retractor",
                        summary: "Draw an incision along x open, compressing the tissue beside it",
                        params: &[
                            number("amount", "Half opening at the top", 0.3, 0.0, 0.4),
                            number("length", "Half length of the incision", 0.5, 0.05, 1.0),
                            number("reach", "How far beside it tissue gives way", 0.4, 0.1, 0.5),
                        ],
                        main_param: Some(0),
                    }
                }
            }
            Self::Cutquad => {
                const {
                    &TemplateSpec {
                        name: "cutquad",
                        summary: "An incision along y with lips that bulge",
                        params: &[
                            number("amount", "Half opening at the top", 0.3, 0.0, 0.4),
                            number("length", "Half length of the incision", 0.45, 0.05, 0.5),
                            number("ripple", "Height of the bulging lips", 0.1, 0.0, 0.5),
                        ],
                        main_param: Some(0),
                    }
                }
            }
            Self::Peeler => {
                const {
                    &TemplateSpec {
                        name: "peeler",
                        summary: "Lift a tongue of the top layer",
                        params: &[
                            number("lift", "Height at the tip", 0.5, 0.0, 2.0),
                            number("width", "Width of the tongue", 1.0, 0.2, 1.0),
                        ],
                        main_param: Some(0),
                    }
                }
            }
            Self::Pull => {
                const {
                    &TemplateSpec {
                        name: "pull",
                        summary: "Draw the middle of the box along a vector",
                        params: &[ParamSpec {
                            name: "offset",
                            summary: "Where the middle goes, fractions of the box",
                            kind: ParamKind::Vector {
                                default: [0.0, 0.0, 0.25],
                                min: -0.3,
                                max: 0.3,
                                max_length: 0.3,
                            },
                        }],
                        main_param: Some(0),
                    }
                }
            }
            Self::Cut => {
                const {
                    &TemplateSpec {
                        name: "cut",
                        summary: "Remove material, move nothing",
                        params: &[ParamSpec {
                            name: "shape",
                            summary: "What is removed",
                            kind: ParamKind::Choice {
                                names: &["box", "sphere", "cylinder", "halfspace"],
                            },
                        }],
                        main_param: None,
                    }
                }
            }
            Self::Hole => {
                const {
                    &TemplateSpec {
                        name: "hole",
                        summary: "Push a round opening aside, along z",
                        params: &[
                            number("amount", "Radius at the top", 0.25, 0.0, 0.45),
                            number(
                                "taper",
                                "Radius at the bottom as a fraction of it",
                                1.0,
                                0.0,
                                1.0,
                            ),
                        ],
                        main_param: Some(0),
                    }
                }
            }
            Self::Lens => {
                const {
                    &TemplateSpec {
                        name: "lens",
                        summary: "Magnify the middle of the box",
                        params: &[number("strength", "How much", 0.5, 0.0, 0.9)],
                        main_param: Some(0),
                    }
                }
            }
            Self::Move => {
                const {
                    &TemplateSpec {
                        name: "move",
                        summary: "Take the box out whole and put it elsewhere",
                        params: &[
                            ParamSpec {
                                name: "offset",
                                summary: "How far, fractions of the box",
                                kind: ParamKind::Vector {
                                    default: [0.0, 0.0, 0.6],
                                    min: -10.0,
                                    max: 10.0,
                                    max_length: f32::INFINITY,
                                },
                            },
                            ParamSpec {
                                name: "turn",
                                summary: "Turned about its centre",
                                kind: ParamKind::Rotation,
                            },
                        ],
                        main_param: Some(0),
                    }
                }
            }
            Self::Rbf => {
                const {
                    &TemplateSpec {
                        name: "rbf",
                        summary: "Displacements at control points, interpolated",
                        params: &[
                            number("strength", "Times the displacements", 1.0, 0.0, 2.0),
                            number(
                                "softness",
                                "Reach of a control point, fractions of the box",
                                0.2,
                                0.01,
                                2.0,
                            ),
                            number(
                                "exponent",
                                "Of the multiquadric; -0.5 is smooth and local",
                                -0.5,
                                -2.0,
                                0.9,
                            ),
                            ParamSpec {
                                name: "extrude",
                                summary: "Control points count in x and y alone, for every z",
                                kind: ParamKind::Flag { default: false },
                            },
                            number(
                                "falloff",
                                "0 extrudes through the whole box, 1 falls off from its middle on",
                                0.3,
                                0.0,
                                1.0,
                            ),
                            number(
                                "edge",
                                "Width over which it ends at the faces of the box",
                                0.0,
                                0.0,
                                0.5,
                            ),
                        ],
                        main_param: Some(0),
                    }
                }
            }
            Self::Field => {
                const {
                    &TemplateSpec {
                        name: "field",
                        summary: "A displacement field from a file",
                        params: &[
                            number("strength", "Times the displacement", 1.0, 0.0, 2.0),
                            ParamSpec {
                                name: "units",
                                summary: "Of the vectors in the file",
                                kind: ParamKind::Choice {
                                    names: &["mm", "subject"],
                                },
                            },
                            ParamSpec {
                                name: "axes",
                                summary: "Directions of the vectors in the file",
                                kind: ParamKind::Choice {
                                    names: &["auto", "lps", "ras"],
                                },
                            },
                            number(
                                "edge",
                                "Width over which it ends at the faces of the box",
                                0.0,
                                0.0,
                                0.5,
                            ),
                        ],
                        main_param: Some(0),
                    }
                }
            }
        }
    }
}
