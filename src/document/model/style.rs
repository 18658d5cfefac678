//! An illustrator's looks: outlines, toned shading, hatching, stippling, and tissue drawn as a ghost.
//!
//! Widths and distances are thousandths of the shorter side of the picture, so that a print looks as the screen does.

/// How the picture is drawn (`look.style`). A part whose width or strength is 0 is not drawn, whatever else it says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Style {
    /// Lines around what is seen.
    pub outline: Outline,
    /// Colours of light and shade.
    pub tone: Tone,
    /// Strokes in the shade.
    pub hatch: Hatch,
    /// Dots in the shade.
    pub stipple: Stipple,
    /// Tissue that what lies behind it is seen through.
    pub ghost: Ghost,
}

/// Lines around what is seen, and along its creases.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outline {
    /// Width of a line, thousandths of the picture's shorter side, 0 to 20. 0: there are none.
    pub width: f32,
    /// sRGB bytes.
    pub color_srgb: [u8; 3],
    /// How readily a crease gets a line, 0 (outlines alone) to 1 (shallow ones too).
    pub creases: f32,
}

/// Shading in flat steps, and from a warm colour in the light to a cool one in the shade (Gooch et al., SIGGRAPH 1998).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tone {
    /// Number of steps, 2 to 5; 0 is smooth.
    pub levels: u32,
    /// Colour in the light, sRGB bytes.
    pub warm_srgb: [u8; 3],
    /// Colour in the shade, sRGB bytes.
    pub cool_srgb: [u8; 3],
    /// How far the two colours stand in the stead of those of the tissue, 0 (not at all) to 1.
    pub strength: f32,
}

/// Strokes over the shaded parts of surfaces; strokes brighter than what they lie on draw the lit parts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hatch {
    /// From one stroke to the next, thousandths of the picture's shorter side, 2 to 50.
    pub spacing: f32,
    /// Width of a stroke, thousandths of the picture's shorter side, 0.2 to 20.
    pub width: f32,
    /// What the strokes follow.
    pub by: HatchBy,
    /// sRGB bytes.
    pub color_srgb: [u8; 3],
    /// How much of the tone the strokes make, 0 (none) to 1.
    pub strength: f32,
}

/// What the strokes of a hatching follow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HatchBy {
    /// The direction in which the surface bends most.
    Curvature,
    /// The long axis of what is drawn.
    Axis,
}

/// Dots over the shaded parts of surfaces; dots brighter than what they lie on draw the lit parts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stipple {
    /// From one dot to the next, thousandths of the picture's shorter side, 2 to 50.
    pub spacing: f32,
    /// Diameter of a dot, thousandths of the picture's shorter side, 0.2 to 20.
    pub size: f32,
    /// sRGB bytes.
    pub color_srgb: [u8; 3],
    /// How much of the tone the dots make, 0 (none) to 1.
    pub strength: f32,
}

/// Tissue that what lies behind it is seen through, while its rims stay.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ghost {
    /// Which tissue it is.
    pub by: GhostBy,
    /// How clear it becomes, 0 (not at all) to 1.
    pub strength: f32,
}

/// Which tissue is drawn as a ghost.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GhostBy {
    /// Surfaces, the more the straighter they face the eye.
    Facing,
    /// All tissue, the more the farther it is from the boxes of the templates: a vignette around what was opened.
    Cut,
}

impl Style {
    /// The style of a document that names none: nothing of it is drawn. Its other values are those of keys that neither
    /// a document nor a preset gives.
    pub const PLAIN: Self = Self {
        outline: Outline {
            width: 0.0,
            color_srgb: INK,
            creases: 0.5,
        },
        tone: Tone {
            levels: 0,
            warm_srgb: [0xf3, 0xd9, 0xb8],
            cool_srgb: [0x3b, 0x4f, 0x6b],
            strength: 0.0,
        },
        hatch: Hatch {
            spacing: 6.0,
            width: 1.0,
            by: HatchBy::Curvature,
            color_srgb: INK,
            strength: 0.0,
        },
        stipple: Stipple {
            spacing: 5.0,
            size: 1.5,
            color_srgb: INK,
            strength: 0.0,
        },
        ghost: Ghost {
            by: GhostBy::Facing,
            strength: 0.0,
        },
    };

    /// True if a picture is drawn as without a style.
    pub fn is_plain(&self) -> bool {
        let amounts = [
            self.outline.width,
            self.tone.strength,
            self.hatch.strength,
            self.stipple.strength,
            self.ghost.strength,
        ];
        amounts.iter().all(|amount| *amount <= 0.0) && self.tone.levels == 0
    }
}

/// Colour of lines and dots that have none of their own, sRGB bytes.
const INK: [u8; 3] = [0x1a; 3];

impl Outline {
    /// Width of lines whose object does not say, where the preset has none either.
    pub(crate) const GIVEN_WIDTH: f32 = 2.0;
}

impl Tone {
    /// Strength of a tone whose object does not say, where the preset has none either.
    pub(crate) const GIVEN_STRENGTH: f32 = 1.0;
    /// Most steps.
    pub(crate) const MAX_LEVELS: u32 = 5;
}

impl Hatch {
    /// Strength of a hatching whose object does not say, where the preset has none either.
    pub(crate) const GIVEN_STRENGTH: f32 = 1.0;
}

impl HatchBy {
    /// All of them; the first is the default.
    pub(crate) const ALL: [Self; 2] = [Self::Curvature, Self::Axis];
    /// Names in documents, in the order of [`Self::ALL`].
    pub(crate) const NAMES: [&'static str; 2] = ["curvature", "axis"];

    /// The name in documents.
    pub fn name(self) -> &'static str {
        Self::NAMES[self as usize]
    }
}

impl Stipple {
    /// Strength of a stippling whose object does not say, where the preset has none either.
    pub(crate) const GIVEN_STRENGTH: f32 = 1.0;
}

impl Ghost {
    /// Strength of a ghost whose object does not say, where the preset has none either.
    pub(crate) const GIVEN_STRENGTH: f32 = 0.5;
}

impl GhostBy {
    /// All of them; the first is the default.
    pub(crate) const ALL: [Self; 2] = [Self::Facing, Self::Cut];
    /// Names in documents, in the order of [`Self::ALL`].
    pub(crate) const NAMES: [&'static str; 2] = ["facing", "cut"];

    /// The name in documents.
    pub fn name(self) -> &'static str {
        Self::NAMES[self as usize]
    }
}
