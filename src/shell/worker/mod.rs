//! What the page leaves to Web Workers. Each part is a program of its own, with its own module, which is fetched when
//! the page first needs it: one makes the built-in subjects, one reads scans and holds their decoders, one reads meshes
//! and prepares them, one reads figures and bends them, one shapes clays, and one holds the decoders of pictures.
//!
//! `web/worker.js` loads the part that the first message names, and hands it a [`task`]. What the part posts back is an
//! [`answer`]. A part that finds that a file is for another one names that, and the worker goes on with it. One worker
//! does one task; to cancel it is to end it. Only a worker that bends a figure does one task after the other, and one
//! that has shaped a clay rests until its next stroke, as long as a clay is shown. A part that panics ends its worker,
//! and the page goes on with a message.

pub mod answer;
pub mod fault;
pub mod header;
pub mod pieces;
pub mod task;

#[cfg(feature = "reader")]
pub mod run;

#[cfg(feature = "parts")]
mod blobs;
#[cfg(feature = "parts")]
pub mod clay;
#[cfg(feature = "parts")]
pub mod figures;
#[cfg(feature = "parts")]
pub mod meshes;
#[cfg(feature = "parts")]
mod other;
#[cfg(feature = "parts")]
pub mod pictures;
#[cfg(feature = "parts")]
pub mod scans;
#[cfg(feature = "parts")]
pub mod subjects;
#[cfg(feature = "parts")]
mod unpacking;
