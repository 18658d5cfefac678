//! Making a figure: what is chosen of its regions and handles, the tools that make new ones, and the edits that change
//! them. Places are those of the figure's plane: at rest as in the source, bent as they are seen.

mod edits;
mod handles;
mod place;
mod refer;
mod regions;
mod run;
mod state;
#[cfg(test)]
mod tests;

pub use self::edits::{HandleKey, figure_edit, handle_edit, region_edit, rigidity_edit};
pub use self::place::{handle_motion, handle_place, line_places};
pub use self::state::{
    FigureCommand, FigureTool, FigureView, Overlay, Reference, ReferenceCommand, Takes,
};
