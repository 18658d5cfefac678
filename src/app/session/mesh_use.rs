//! Answers to the question what a mesh file is to be.

/// What a mesh file is to be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MeshUse {
    /// It takes the subject's place: a new document begins.
    Subject,
    /// A part of the subject, which is made of meshes too.
    Part,
    /// An object beside the subject.
    Object,
    /// A tool of the clay that is shown.
    Tool,
    /// Nothing: all stays as it is.
    Nothing,
}
