//! What this viewer last put on the clipboard.

/// What the clipboard last took, and a copy for where it may not be read.
#[derive(Clone, Debug, Default)]
pub struct Clipboard {
    /// For the message that it is there.
    pub last: Copied,
    /// Templates that were copied here, as text.
    pub templates: Option<String>,
}

/// What was copied.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Copied {
    /// The link to the document.
    #[default]
    Link,
    /// So many templates.
    Templates(usize),
}
