//! What the bodies of meshes are made of, and how they are drawn.

/// What lies under the surface of a body: nothing, a shell, or all of it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum BodyKind {
    /// Hollow beside a volume and where the mesh is open, else solid.
    #[default]
    Auto,
    /// The surface alone; cuts show its back side.
    Hollow,
    /// A shell, from the surface inwards.
    Thick,
    /// Full.
    Solid,
}

impl BodyKind {
    /// All kinds; the first is the default.
    pub(crate) const ALL: [Self; 4] = [Self::Auto, Self::Hollow, Self::Thick, Self::Solid];
    /// Names in documents, in the order of [`Self::ALL`].
    pub(crate) const NAMES: [&'static str; 4] = ["auto", "hollow", "thick", "solid"];

    /// The name in documents.
    pub fn name(self) -> &'static str {
        Self::NAMES[self as usize]
    }
}

/// The material of a body from a depth under its surface down to the next layer.
#[derive(Clone, Debug, PartialEq)]
pub struct Layer {
    /// Its index in the document's list.
    pub index: usize,
    /// Where it begins, subject units under the surface, 0 to 1.
    pub depth: f32,
    /// Name of the material, or empty. `keep` may name it; a segment of the same name comes first.
    pub name: String,
    /// sRGB bytes; `None`: as cut faces without a layer.
    pub color_srgb: Option<[u8; 3]>,
    /// How much its colour varies, 0 to 0.5.
    pub grain: f32,
}

impl Layer {
    /// Most variation of a layer's colour.
    pub const MAX_GRAIN: f32 = 0.5;

    /// The layers of a built-in subject whose document gives none; empty for one that has none of its own.
    pub fn of_builtin(name: &str) -> Vec<Self> {
        let layers: &[(f32, &str, [u8; 3], f32)] = match name {
            "apple" => &[
                (0.0, "skin", [0x8e, 0x1c, 0x26], 0.0),
                (0.008, "flesh", [0xf4, 0xea, 0xc4], 0.06),
                (0.23, "core", [0xe2, 0xd3, 0x9c], 0.12),
            ],
            _ => &[],
        };
        let layers = layers.iter().enumerate();
        let layer =
            |(index, &(depth, name, color, grain)): (usize, &(f32, &str, [u8; 3], f32))| Self {
                index,
                depth,
                name: name.to_owned(),
                color_srgb: Some(color),
                grain,
            };
        layers.map(layer).collect()
    }

    /// Sorts layers by depth; layers of one depth stay in the order of the document.
    pub(crate) fn sort(layers: &mut [Self]) {
        layers.sort_by(|a, b| a.depth.total_cmp(&b.depth).then(a.index.cmp(&b.index)));
    }
}

/// How the meshes of the subject are drawn where their segments do not say: the keys `body`, `thickness`, `inside`,
/// `layers` and `gloss` of `look`.
#[derive(Clone, Debug, PartialEq)]
pub struct SurfaceLook {
    /// What the bodies are.
    pub body: BodyKind,
    /// Thickness of a shell, subject units.
    pub thickness: f32,
    /// Colour of back sides and of cut faces without a layer, sRGB bytes. `None`, in linear light: back sides 0.75 of
    /// the colour of the point, cut faces 0.75 of the segment's mean colour by area.
    pub inside_srgb: Option<[u8; 3]>,
    /// Layers under the surface, sorted by depth.
    pub layers: Vec<Layer>,
    /// 0 to 1.
    pub gloss: f32,
}

impl SurfaceLook {
    /// Bodies of a document that says nothing (surfaces.md, "What a body is").
    pub const DOCUMENT_DEFAULT: Self = Self {
        body: BodyKind::Auto,
        thickness: Self::DEFAULT_THICKNESS,
        inside_srgb: None,
        layers: Vec::new(),
        gloss: Self::DEFAULT_GLOSS,
    };
    /// Thickness of a shell that does not say, subject units.
    pub const DEFAULT_THICKNESS: f32 = 0.03;
    /// Gloss of a mesh that does not say.
    pub const DEFAULT_GLOSS: f32 = 0.1;
    /// Range of a shell's thickness, subject units.
    pub const THICKNESS_RANGE: [f32; 2] = [0.001, 0.5];
}

/// What an entry of `look.segments` says of the surface of a mesh; `None` is as [`SurfaceLook`] has it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SurfaceChange {
    /// Whether it is hollow, a shell or full.
    pub body: Option<BodyKind>,
    /// Thickness of a shell, subject units.
    pub thickness: Option<f32>,
    /// Colour of back sides and of cut faces without a layer, sRGB bytes.
    pub inside_srgb: Option<[u8; 3]>,
    /// Layers under the surface, sorted by depth; an empty list is none.
    pub layers: Option<Vec<Layer>>,
    /// 0 to 1.
    pub gloss: Option<f32>,
}

impl SurfaceChange {
    /// What is drawn where `look` says the rest.
    pub fn over(&self, look: &SurfaceLook) -> SurfaceLook {
        let layers = self.layers.as_ref();
        SurfaceLook {
            body: self.body.unwrap_or(look.body),
            thickness: self.thickness.unwrap_or(look.thickness),
            inside_srgb: self.inside_srgb.or(look.inside_srgb),
            layers: layers.unwrap_or(&look.layers).clone(),
            gloss: self.gloss.unwrap_or(look.gloss),
        }
    }
}
