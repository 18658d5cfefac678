//! The solve: what holds which vertices, how turns spread, and where the rest goes (spec/figures.md, "Handles",
//! "Propagation", "The solve"; Chen et al., sections 3.1 to 3.3 and 4).
//!
//! | paper | here |
//! |---|---|
//! | f, the deformed coordinates | `places` |
//! | ∇φ, the gradients of hat functions | `Element::gradients` |
//! | A, the area of a triangle | `Element::area` |
//! | kˣ, kʸ, the rigidities | `Body::k2`, their squares |
//! | w, the guidance field | `State::wanted` |
//! | C, λ, u, the shape context | `ContextSheet`, its `lambda`, `Kept::rows` |
//! | R(θ)S(s) of eq. 9 | `State::similarity` |
//!
//! # Differs from the source
//! - Eq. 2 divides by an area, eq. 6 and the divergence of eq. 5 do not. Here both sides are integrals: no division.
//! - Both sides carry k²; eq. 5 may be read as k, and then an untouched figure would move.
//! - Eq. 11 halves the usual Laplacian; contours use the running sum that is its solution with ends kept.
//! - The guidance is made of turns and scales per triangle only, not of gradients of vertices that were moved first.
//! - Eq. 8 and 9 hold at once: f is linear in the context's similarity, so that a system of two equations replaces the
//!   paper's iteration with a growing λ.
//! - Ours: harmonic propagation, turns that are found (local and global rounds as in Sorkine and Alexa 2007, with
//!   Anderson mixing), exactly rigid parts, open turns, lines.

mod anderson;
mod context;
mod contour;
mod element;
mod factor;
mod hold;
mod line;
mod moves;
mod order;
mod pose;
mod propagate;
mod rigid;
mod stage;
mod state;
mod trigonometric;

pub(crate) use element::Element;
pub(crate) use factor::{Matrix, NONE};
pub use hold::GripKind;
pub use pose::{Drag, Posed, Rig};
pub use state::{MAX_ROUNDS, TOLERANCE};
