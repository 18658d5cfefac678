//! Layer 6: the lesson's viewer, for somebody else's page. It turns, zooms, walks steps and moves parameters; it edits
//! nothing and has no window of its own: controls and texts are the page's (`web/reader`).
//!
//! | file | holds |
//! |---|---|
//! | `visit` | a document as one reader sees it: the step, the passage, the camera, values that were moved |
//! | `stock` | the data of documents: a subject with its segments, on the GPU once for all pictures of it |
//! | `picture` | one visit on one stock, drawn |
//! | `outline` | what a page needs to know of a document before anything is drawn |

mod outline;
mod picture;
mod stock;
mod visit;

pub use outline::{outline, texts};
pub use picture::{Drawn, Picture};
pub use stock::{Stock, StockKey, Trouble};
pub use visit::Visit;
