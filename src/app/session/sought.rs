//! What is searched for by its name.

/// Something of the object that has a name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Sought {
    /// The segment of this name.
    Tissue(String),
    /// The caption of this index, of those that are shown.
    Caption(usize),
}
