// Structs that Rust fills in, mirrored in order by src/render/gpu_types.rs (tests/layout.rs compares them).
// No vec3 here: rows of four.
// needs: -

/// Templates of one document at most (spec/contract.md, "Limits").
const MAX_TEMPLATES: u32 = 32u;

/// How a template joins the list.
const MODE_COMPOSE: u32 = 0u;
const MODE_ADD: u32 = 1u;

/// One placed template, ready for the shaders: enabled, of a known kind.
struct Template {
    /// Rows of the affine that takes subject space to template space (the unit cube).
    template_from_subject_row0: vec4f,
    template_from_subject_row1: vec4f,
    template_from_subject_row2: vec4f,
    /// Rows of the affine that takes template space to subject space.
    subject_from_template_row0: vec4f,
    subject_from_template_row1: vec4f,
    subject_from_template_row2: vec4f,
    /// xyz: side lengths, subject units.
    size: vec4f,
    /// Parameters in the order of the catalogue, flags 0 or 1, choices as index.
    params0: vec4f,
    params1: vec4f,
    /// Number of the kind (TemplateKind).
    kind: u32,
    /// MODE_COMPOSE or MODE_ADD; the first of the list always composes.
    mode: u32,
    /// Reserved, 0.
    flags: u32,
    /// Index of the composing template that heads its `add` group (its own if it composes).
    group: u32,
}

/// All templates that act, in the order in which they act on the object.
struct Templates {
    items: array<Template, 32>,
    /// x: how many of them count.
    count: vec4u,
}
