//! Layer 3: what the program knows of each template besides its formula (which is WGSL, `shaders/displace/`): what it reaches, where
//! material can go, where it is grabbed, and how its icon is drawn. One file per kind, by the same stem as its shader.
//!
//! ```
//! use fabrica::displace;
//! use fabrica::document::TemplateKind;
//!
//! // The icon's template is a placed peel; grab its hinge and pull it on.
//! let (mut peel, _camera) = displace::icon(TemplateKind::Peel);
//! let grip = displace::handle(&peel).expect("a peel is grabbed by its hinge");
//! let value = displace::dragged(&peel, grip.at + grip.along.expect("along x") * 0.1).expect("a number");
//! displace::set_main(&mut peel, value);
//! assert!(displace::handle(&peel).expect("still").at.x > grip.at.x + 0.09);
//! ```

mod bend;
mod bounds;
mod cut;
mod cutquad;
mod dilate;
mod facts;
mod field;
mod flap;
mod handle;
mod hole;
mod icon;
mod lens;
mod r#move;
mod peel;
mod peeler;
mod poke;
mod pull;
mod rbf;
mod retractor;
mod slices;
mod split;
mod squeeze;
mod twist;
mod wave;

pub use bounds::{deformed_bounds, max_displacement};
pub use facts::{Material, Reach};
pub use handle::{Handle, dragged, dragged_along_ray, handle, set_main};
pub use icon::icon;

use crate::document::{PlacedTemplate, TemplateKind};
use facts::{Facts, Given};

/// What a template reaches with the parameters and the size it has, template space.
pub fn reach(template: &PlacedTemplate) -> Reach {
    (facts_of(template.kind).reach)(&Given::new(&template.acting()))
}

/// What the shader of an `rbf` that acts ([`PlacedTemplate::acting`]) reads besides its parameters (shaders/displace/rbf.wgsl).
pub fn solved_points(template: &PlacedTemplate) -> Vec<[f32; 4]> {
    rbf::Interpolant::of(&Given::new(template)).pack()
}

/// Lines of a lattice on the tissue of an `rbf`'s middle plane (z = ½), as they lie when it is bent, subject space.
pub fn bent_lattice(template: &PlacedTemplate) -> Vec<Vec<glam::Vec3>> {
    let template = template.acting();
    let interpolant = rbf::Interpolant::of(&Given::new(&template));
    let place = |q: glam::Vec3| template.subject_from_template(q);
    let lines = interpolant.bent_lattice().into_iter();
    lines
        .map(|line| line.into_iter().map(place).collect())
        .collect()
}

/// Everything known about a kind.
fn facts_of(kind: TemplateKind) -> &'static Facts {
    match kind {
        TemplateKind::Poke => &poke::FACTS,
        TemplateKind::Twist => &twist::FACTS,
        TemplateKind::Wave => &wave::FACTS,
        TemplateKind::Bend => &bend::FACTS,
        TemplateKind::Squeeze => &squeeze::FACTS,
        TemplateKind::Dilate => &dilate::FACTS,
        TemplateKind::Peel => &peel::FACTS,
        TemplateKind::Flap => &flap::FACTS,
        TemplateKind::Split => &split::FACTS,
        TemplateKind::Slices => &slices::FACTS,
        TemplateKind::Retractor => &retractor::FACTS,
        TemplateKind::Cutquad => &cutquad::FACTS,
        TemplateKind::Peeler => &peeler::FACTS,
        TemplateKind::Pull => &pull::FACTS,
        TemplateKind::Cut => &cut::FACTS,
        TemplateKind::Hole => &hole::FACTS,
        TemplateKind::Lens => &lens::FACTS,
        TemplateKind::Move => &r#move::FACTS,
        TemplateKind::Rbf => &rbf::FACTS,
        TemplateKind::Field => &field::FACTS,
    }
}
