//! Colours, opacity and background.

use super::light::Light;
use super::style::Style;
use super::surface::{SurfaceChange, SurfaceLook};

/// Colours, opacity and background.
#[derive(Clone, Debug, PartialEq)]
pub struct Look {
    /// Opacity and colour over value.
    pub transfer: Transfer,
    /// The value range that a preset is stretched over.
    pub window: Window,
    /// How much the segments' own colours tint, 0 to 1. `None`: as the preset says, and 0 with listed points.
    pub tint: Option<f32>,
    /// How opacity follows compression (dissertation, section 4.5.4).
    pub opacity: OpacityMode,
    /// How much opacity follows the gradient of the value (dissertation, section 6.2.5): at 0 not at all, at 1 only
    /// edges and cut faces show.
    pub gradient: f32,
    /// Segments that are drawn as bodies of their own, whatever the transfer function says.
    pub segments: Vec<SegmentLook>,
    /// How meshes are drawn whose segments do not say.
    pub surface: SurfaceLook,
    /// How an illustrator would draw it: the preset, with what the document changes of it.
    pub style: Style,
    /// Name of the preset that [`Look::style`] starts from; `None`: nothing is drawn but what the document says.
    pub style_preset: Option<&'static str>,
    /// Where the light comes from and how it falls; `None`: the document does not say, and it is as ever, from the
    /// upper left.
    pub light: Option<Light>,
    /// The background behind the object.
    pub background: Background,
    /// A scale bar stands in the picture.
    pub scale_bar: bool,
    /// The letters of the patient's sides stand at the picture's edges.
    pub sides: bool,
    /// The strokes of a clay that are shown, from the first on; `None`: all.
    pub strokes: Option<u32>,
    /// The edges of a mesh's triangles are drawn. A view sets this; no document has it.
    pub has_wires: bool,
}

/// How one segment is drawn: as a body of its own, whatever its values are.
#[derive(Clone, Debug, PartialEq)]
pub struct SegmentLook {
    /// Name of the segment, or its label written as text.
    pub name: String,
    /// 1 is solid, 0 is hidden; between them the opacity of a layer of [`SegmentLook::LAYER`]. Of a mesh, the opacity
    /// of one crossing or one cut face.
    pub opacity: f32,
    /// False where the document gives no opacity: a scan's segment is solid then, a mesh has its file's.
    pub is_opacity_given: bool,
    /// sRGB bytes; `None`: the segment's own colour.
    pub color_srgb: Option<[u8; 3]>,
    /// What it says of the surface of a mesh. Scans do not have any.
    pub surface: SurfaceChange,
}

impl SegmentLook {
    /// Thickness of the layer whose opacity [`SegmentLook::opacity`] gives, subject units.
    pub const LAYER: f32 = 0.05;

    /// A segment as a solid body in its own colour.
    pub fn solid(name: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            opacity: 1.0,
            is_opacity_given: true,
            color_srgb: None,
            surface: SurfaceChange::default(),
        }
    }
}

/// How one segment of a mesh is drawn: the keys of `look` and of its entry in `look.segments` together.
#[derive(Clone, Debug, PartialEq)]
pub struct SegmentSurface {
    /// What the body is, and of what.
    pub surface: SurfaceLook,
    /// Opacity of one crossing or one cut face, 0 to 1; `None`: the file's.
    pub opacity: Option<f32>,
    /// sRGB bytes; `None`: what the file gives.
    pub color_srgb: Option<[u8; 3]>,
}

impl Look {
    /// How a segment of a mesh is drawn. `number` is its number, from 1, in a subject without a volume; beside a
    /// volume numbers mean labels, and it is `None`. A name goes before a number.
    pub fn of_mesh_segment(&self, name: &str, number: Option<u32>) -> SegmentSurface {
        let number = number.map(|number| number.to_string());
        let called = |name: &str| self.segments.iter().find(|look| look.name == name);
        let own = called(name).or_else(|| called(number.as_deref()?));
        let Some(own) = own else {
            return SegmentSurface {
                surface: self.surface.clone(),
                opacity: None,
                color_srgb: None,
            };
        };
        SegmentSurface {
            surface: own.surface.over(&self.surface),
            opacity: own.is_opacity_given.then_some(own.opacity),
            color_srgb: own.color_srgb,
        }
    }
}

/// The source of opacity and colour.
#[derive(Clone, Debug, PartialEq)]
pub enum Transfer {
    /// The subject's own preset.
    Auto,
    /// A named preset, relative to the window.
    Preset(String),
    /// Points at absolute values, sorted by value; the window is ignored.
    Points(Vec<TransferPoint>),
}

/// One point of a transfer function.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TransferPoint {
    /// Absolute value; in a preset the position in the window, 0 to 1.
    pub value: f32,
    /// Red, green and blue in sRGB, 0 to 255.
    pub color_srgb: [u8; 3],
    /// Opacity of 0.01 subject units, 0 to 1.
    pub opacity: f32,
}

/// The value range that a preset is stretched over.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Window {
    /// The subject's own range.
    Auto,
    /// Lowest and highest value.
    Range([f32; 2]),
}

/// How opacity follows the deformation (dissertation, eq. 4.23 and 4.30).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OpacityMode {
    /// Exponent |J v|: a surface keeps its opacity from every side.
    Constancy,
    /// Exponent |det J|: particles are conserved.
    Mass,
    /// Opacity is not adjusted to the deformation.
    None,
}

impl OpacityMode {
    /// All modes; the first is the default.
    pub(crate) const ALL: [Self; 3] = [Self::Constancy, Self::Mass, Self::None];
    /// Names in documents, in the order of [`Self::ALL`].
    pub(crate) const NAMES: [&'static str; 3] = ["constancy", "mass", "none"];
}

/// The background behind the object.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Background {
    /// Nothing: the picture is transparent there.
    None,
    /// One colour, sRGB bytes.
    Color([u8; 3]),
}
