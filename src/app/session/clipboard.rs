//! What this viewer last put on the clipboard.

/// What the clipboard last took, and a copy for where it may not be read.
#[derive(Clone, Debug, Default)]
pub struct Clipboard {
    /// What was copied last, for the message that says so.
    pub last: Copied,
    /// Templates that were copied here, as text.
    pub templates: Option<String>,
}

/// What the app put on the clipboard last, for the message that says so.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Copied {
    /// The link to the document.
    #[default]
    Link,
    /// HTML for a page.
    Snippet,
    /// Templates, and how many.
    Templates(usize),
}
