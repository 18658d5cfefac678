//! Layer 4: placed templates: what they reach in the subject, where they are grabbed, and how their icons are drawn.
//! What is known of their kinds stands in [`displace`](crate::displace).
//!
//! ```
//! use fabrica::document::TemplateKind;
//! use fabrica::placed;
//!
//! // The icon's template is a placed peel; grab its hinge and pull it on.
//! let (mut peel, _camera) = placed::icon(TemplateKind::Peel);
//! let grip = placed::handle(&peel).expect("a peel is grabbed by its hinge");
//! let value = placed::dragged(&peel, grip.at + grip.along.expect("along x") * 0.1).expect("a number");
//! placed::set_main(&mut peel, value);
//! assert!(placed::handle(&peel).expect("still").at.x > grip.at.x + 0.09);
//! ```

mod bounds;
mod handle;
mod icon;
mod joined;
mod reach;

pub use bounds::{deformed_bounds, max_displacement};
pub use handle::{Handle, dragged, dragged_along_ray, handle, set_main};
pub use icon::{ICON_COLUMNS, ICON_PX, icon, icon_document, icon_kinds};
pub use joined::joined_sweep;
pub use reach::{
    bent_lattice, drawn_in_sweep, least_coat, missed_points, reach, solved_points, sweep_rows,
    sweep_texels, tool_ways,
};
