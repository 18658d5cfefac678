//! Layer 4: flat pictures that bend (Chen, Liang, Maciejewski, Ebert, *Shape Context Preserving Deformation of 2D
//! Anatomical Illustrations*; the contract is spec/figures.md).
//!
//! The regions of a document's figure ([`crate::document::figure`]) become sets of pixels ([`regions`]), their
//! outlines a network of lines, and what lies between a triangle mesh ([`mesh`]). What handles hold and the matrices
//! are made ready once ([`solve::Rig`]); then every pose is a few back-substitutions. Places are found back by
//! [`probe`].
//!
//! All of it is in 64 bits with libm's sines and in a fixed order, so that page and program have the same numbers.
//!
//! ```
//! use fabrica::figure::mesh::Mesh;
//! use fabrica::document::figure::{Figure, Handle};
//! use fabrica::figure::{Plane, regions::Canvas, solve::Rig, unwatched};
//! use glam::{DVec2, dvec2};
//! # let picture = fabrica::pictures::Picture {
//! #     size: [60, 30],
//! #     pixels: vec![[200, 180, 160, 255]; 1800],
//! #     is_of_inks: false,
//! # };
//! let plane = Plane::of_picture(picture.size);
//! let canvas = Canvas { plane, picture: Some(&picture), drawn: None, shapes: &|_| None };
//! let figure = Figure {
//!     handles: vec![Handle::pin(dvec2(-0.4, 0.0), DVec2::ZERO), Handle::pin(dvec2(0.4, 0.0), dvec2(0.0, 0.2))],
//!     detail: 500,
//!     ..Figure::default()
//! };
//! let mut notices = Vec::new();
//! let mesh = std::sync::Arc::new(Mesh::new(&canvas, &figure, &mut notices, &mut unwatched).expect("nobody stops it"));
//! let posed = Rig::new(&mesh, &figure, &mut notices).posed(&figure, &mut notices);
//! let tip = fabrica::figure::probe::forward(&mesh, &posed.places, dvec2(0.4, 0.0)).place;
//! assert!((tip - dvec2(0.4, 0.2)).length() < 1e-6);
//! assert_eq!(notices, []);
//! ```

mod behind;
mod bench;
mod bender;
mod complex;
pub mod drawn;
mod export;
pub mod mesh;
mod notice;
mod original;
mod outlines;
mod plane;
pub mod probe;
mod progress;
mod read;
pub mod regions;
pub mod solve;
pub mod svg;

pub use behind::smooth_colors;
pub use bench::{FigureRow, bench_figures};
pub use bender::{Bender, Bent, Solved};
pub use export::exported;
pub use notice::Notice;
pub use original::Original;
pub use plane::{Plane, reduced_size};
pub use progress::{Progress, unwatched};
pub use read::{
    FigureFile, PlateError, ReadPlate, SNIFF_BYTES, builtin_plate, is_figure_name,
    plate_of_drawing, plate_of_picture, read_plate,
};
