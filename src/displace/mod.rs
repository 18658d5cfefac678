//! Layer 1: the kinds of templates, and all that is known of each besides its formula (which is WGSL,
//! `shaders/displace/`): its parameters, what it reaches, where material can go, where it is grabbed, its icon, its
//! mirror image, its place in the catalogue and its proportions. One file per kind, by the same stem as its shader.
//! Nothing here knows a document: what a template does in its place in a subject is in [`placed`](crate::placed).
//!
//! # Adding a kind
//!
//! A kind has five places. Say that a `swirl` is wanted, which turns the middle of its box:
//!
//! 1. One line in `kind.rs`, at the end, with the next number: `Swirl = 23 in swirl`. The compiler and the tests ask
//!    for the rest.
//! 2. `displace/swirl.rs`: its [`Facts`]. A smooth kind that moves material within its box by no more than its
//!    parameter is short:
//!
//!    ```ignore
//!    pub(super) const FACTS: Facts = Facts {
//!        spec: TemplateSpec {
//!            name: "swirl",
//!            summary: "Turn the middle of the box about z",
//!            params: &[number("angle", "Turn of the middle, radians", 1.0, -PI, PI)],
//!            main_param: Some(0),
//!        },
//!        holds: Holds::Parameters,
//!        amount: Amount::Parameters,
//!        reach: |given| match given.p[0] {
//!            0.0 => Reach::NONE,
//!            _ => Reach::shifted(Aabb::UNIT, -Vec3::ONE, Vec3::ONE).with_detail(0.1),
//!        },
//!        grip: Grip::Number(|given| Vec3::new(0.75, 0.5 + 0.25 * given.p[0].sin(), 0.5), INF),
//!        icon: Icon::PLAIN,
//!        mirror: Mirror { handed: &["angle"], ..Mirror::ACROSS_X },
//!        catalogue: Some((Group::Bend, 3)),
//!        shape: Shape::WHOLE,
//!    };
//!    ```
//! 3. `shaders/displace/swirl.wgsl`: `displace_swirl(q, size, p0, p1)`, with its source and a diagram of its unit cube.
//!    The formula is the last function of the file and calls no formula of another kind: programs for documents without
//!    the kind are put together without it ([`without_formula`]).
//!    It is embedded in `render/device/programs.rs` and called in `shaders/displace/compose.wgsl` under `KIND_SWIRL`;
//!    that name, its bit `DRAWN_SWIRL` and its main parameter are generated ([`shader_constants`]).
//! 4. Its words in `app/words/kinds.rs`, in every language.
//! 5. Its formula once more, in plain f64, in `tests/reference`.
//!
//! What shows that a place is forgotten: without 2 and 4 nothing compiles; `every_kind_has_its_place_in_the_shaders`
//! (tests/fast/shaders.rs) asks for 3, the probes for 5; a wrong reach, main parameter, mirror axis or group is found
//! by tests/gpu/probes.rs, tests/gpu/kinds.rs and the tests of `kind.rs`.

mod bend;
mod carve;
mod clusters;
mod constants;
mod crack;
mod cut;
mod cutquad;
mod dilate;
mod drawn;
mod facts;
mod field;
mod flap;
mod hole;
mod interpolant;
mod kind;
mod lens;
mod r#move;
mod mover;
mod noise;
mod peel;
mod peeler;
mod points;
mod poke;
mod pull;
mod rbf;
mod retractor;
mod slices;
mod spec;
mod split;
mod squeeze;
mod sweep;
mod sweep_rows;
mod sweeping;
mod tools;
mod twist;
mod wave;

pub use constants::{shader_constants, without_formula};
pub use drawn::{
    DRAWN_ALONE, DRAWN_CROWDED, DRAWN_ELLIPSOIDS, DRAWN_GRIDS, DRAWN_OF_SWEEPS, DRAWN_PIECES,
    DRAWN_TOGETHER,
};
pub use facts::{
    Amount, Arc, Facts, Given, Grip, Group, Holds, Icon, Material, Mirror, Reach, Samples, Shape,
    Shrinking, Tool,
};
pub(crate) use interpolant::Interpolant;
pub use interpolant::Missed;
pub use kind::TemplateKind;
pub(crate) use mover::{Ball, Mover, asked_in, coats_in, counted_in, images_of, spans, wanted_in};
pub use noise::noise;
pub use points::{ControlPoint, ControlPoints};
pub use spec::{MAX_PARAM_FLOATS, ParamKind, ParamSpec, ParamValue, TemplateSpec};
pub use sweep_rows::GridPlace;
pub(crate) use sweeping::Sweeping;
pub use sweeping::{ToolWay, WAY_PARTS};
pub(crate) use tools::{COAT, FARTHEST, LONG, LONGEST, ROUND, SCALE, SOLID};
pub use tools::{
    MAX_GRIDS, MAX_IMAGES, MAX_KEYS, MAX_PIECES, MAX_SWEEP_STEPS, MAX_TOOL_POINTS, MAX_TOOLS,
    MOST_STEPS, PathKey, SweepTool, SweepTools, ToolFile, ToolShape,
};
