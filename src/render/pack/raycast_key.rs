use super::gpu_types::{CONSTRAIN_COORDINATE, CONSTRAIN_LATE, CONSTRAIN_RIGID};
use crate::render::device::cases::Cases;
use crate::render::device::programs::SubjectShader;

/// What a ray march pipeline is made for. Few of them per document: software GPUs run every branch, so what a document
/// does not use is left out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct RaycastKey {
    /// What says what the subject has at a place.
    pub subject: SubjectShader,
    /// Bit k: templates of kind k occur.
    pub drawn_kinds: u32,
    /// The subject has labels and the look tints by them.
    pub has_labels: bool,
    /// The ray march leaps by the skip grid.
    pub has_grid: bool,
    /// How kept tissue is found: see `KeptTissue::align_mode`.
    pub align_mode: u32,
    /// How displacements give way to kept tissue: see `KeptTissue::constraints`.
    pub constraints: u32,
    /// What says that tissue is kept: see `KeptTissue::kept_by`; bit 3: segments end at the smooth surface of their
    /// shares.
    pub kept_by: u32,
    /// Opacity follows the gradient.
    pub has_edges: bool,
    /// Tissue is drawn as a ghost.
    pub has_ghost: bool,
    /// The edges of a mesh's triangles are drawn.
    pub has_wires: bool,
    /// A segment of meshes is a shell.
    pub has_shells: bool,
    /// The key light is a lamp of some width.
    pub has_lamp: bool,
    /// Segments are drawn as bodies of their own.
    pub has_bodies: bool,
    /// Objects stand in the scene.
    pub has_objects: bool,
    /// Pictures lie on the triangles of the subject or of objects.
    pub has_textures: bool,
    /// The map is read from its baked texture.
    pub is_baked: bool,
    /// What is wanted of each ray.
    pub finds: Finds,
}

/// What a ray march is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Finds {
    /// The colour of each pixel.
    Picture,
    /// The colour of each pixel and what the pixel shows, for a style.
    Traced,
    /// Everything about the surface under one pixel.
    Pick,
    /// The segment under each pixel.
    Segments,
    /// Where the ray turns more than half opaque.
    Event,
}

impl RaycastKey {
    /// True if templates leave tissue alone or give way to it: a longer program.
    pub(crate) fn keeps_tissue(&self) -> bool {
        self.align_mode != 0
    }

    /// What its program is put together for.
    pub(crate) fn cases(&self) -> Cases {
        let has = |way: u32| self.constraints & (1 << way) != 0;
        Cases {
            kinds: self.drawn_kinds,
            align_modes: 1 << self.align_mode,
            gives_way: self.constraints != 0,
            gives_way_late: has(CONSTRAIN_LATE),
            gives_way_by_coordinate: has(CONSTRAIN_COORDINATE),
            moves_as_a_whole: has(CONSTRAIN_RIGID),
        }
    }

    /// The pipeline constant `has_textures` of march/overrides.wgsl: rays that are asked one by one take pictures as
    /// they are, and so does a slice, whose lines have one colour for each triangle.
    pub(crate) fn textures_constant(&self, is_slice: bool) -> (&'static str, f64) {
        let is_picture =
            matches!(self.finds, Finds::Picture | Finds::Traced | Finds::Segments) && !is_slice;
        let value = match (self.has_textures, is_picture) {
            (false, _) => 0.0,
            (true, false) => 1.0,
            (true, true) => 2.0,
        };
        ("has_textures", value)
    }

    /// The pipeline constants of march/align.wgsl.
    pub(crate) fn align_constants(&self) -> [(&'static str, f64); 3] {
        [
            ("align_mode", f64::from(self.align_mode)),
            ("has_constraints", f64::from(self.constraints)),
            ("kept_by", f64::from(self.kept_by)),
        ]
    }
}
