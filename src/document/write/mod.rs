//! From typed values to the JSON tree, and from the tree to text.

mod change;
mod clay;
mod edit;
mod figure;
pub(super) mod json;
mod lists;
mod number;
mod set;
mod value;

pub use clay::clay_to_text;
pub use edit::{Edit, FigureList};
pub use figure::figure_to_text;
pub(super) use lists::{insert, list, take};
#[cfg(any(feature = "app", feature = "session"))]
pub(crate) use number::color_text;
pub(super) use set::set;
