//! Notices: remarks on a document that is valid but not drawn as written.

use std::fmt;

/// A remark on a value that is kept, but not drawn as written. A document with notices is still drawn.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Notice {
    /// JSON pointer to the value.
    pub pointer: String,
    /// What is wrong with the value, and what is drawn in its place.
    pub kind: NoticeKind,
}

/// The content of a [`Notice`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NoticeKind {
    /// A key that this version does not know.
    UnknownKey,
    /// A template without a kind, or of a kind that this version does not know.
    UnknownTemplate {
        /// The kind as the document writes it; empty if there is none.
        kind: String,
    },
    /// A parameter that the kind of the template does not have.
    UnknownParam {
        /// Name of the template's kind.
        kind: &'static str,
    },
    /// A name that this version does not know, where one of several is expected.
    UnknownValue {
        /// The value as the document writes it.
        found: String,
        /// The name that is used in its place.
        instead: String,
    },
    /// A value outside its range.
    Clamped {
        /// The value as the document writes it.
        found: String,
        /// The value that is drawn.
        drawn: String,
    },
    /// A text of more characters than count.
    TooLong {
        /// Characters of the text in the document.
        found: usize,
        /// Characters that count, from its beginning.
        most: usize,
    },
    /// A rotation that is no unit quaternion; its direction is drawn.
    Normalised,
    /// A built-in subject that this version does not know.
    UnknownSubject {
        /// The value as the document writes it.
        found: String,
    },
    /// A revision of a built-in subject that this version does not know.
    UnknownRevision {
        /// The revision in the document.
        revision: u32,
        /// The newest that this version knows, which is drawn.
        newest: u32,
    },
    /// A value that this version knows but does not draw.
    NotDrawn {
        /// The thing that is not drawn, in plain words.
        what: &'static str,
    },
    /// A value that goes with another kind of subject.
    Beside {
        /// The subject beside which it is not drawn, in plain words.
        what: &'static str,
    },
    /// An object has the name of one before it, which counts where the name is asked for.
    SameName {
        /// What both are called.
        name: String,
    },
    /// A `carve` that does nothing, for the sake of its object.
    NotCarving {
        /// The reason, in plain words.
        why: &'static str,
    },
    /// A step sets a value in a place that the document does not have.
    Dangling {
        /// The pointer in `set`.
        target: String,
    },
    /// An entry of `controls` that readers are not shown.
    NoControl {
        /// The reason, in plain words.
        why: &'static str,
    },
    /// There are more notices, which are not listed.
    More,
    /// A curve that is not drawn, or only in part.
    Curve {
        /// The reason, and what is drawn, in plain words.
        what: &'static str,
    },
    /// Two sources are named, of which one is used.
    LeftAside {
        /// The source that is used.
        taken: &'static str,
    },
}

impl Notice {
    pub(crate) fn new(pointer: impl Into<String>, kind: NoticeKind) -> Self {
        Self {
            pointer: pointer.into(),
            kind,
        }
    }
}

impl fmt::Display for Notice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let pointer = &self.pointer;
        match &self.kind {
            NoticeKind::UnknownKey => {
                write!(
                    f,
                    "{pointer}: this version does not know this key; it is kept"
                )
            }
            NoticeKind::UnknownTemplate { kind } if kind.is_empty() => {
                write!(
                    f,
                    "{pointer}: the template names no kind; it is kept, not drawn"
                )
            }
            NoticeKind::UnknownTemplate { kind } => write!(
                f,
                "{pointer}: this version does not know the template “{kind}”; it is kept, not drawn"
            ),
            NoticeKind::UnknownParam { kind } => {
                write!(
                    f,
                    "{pointer}: {kind} has no such parameter; it is kept, not drawn"
                )
            }
            NoticeKind::UnknownValue { found, instead } => write!(
                f,
                "{pointer}: this version does not know “{found}”; it is kept, {instead} is drawn"
            ),
            NoticeKind::Clamped { found, drawn } => {
                write!(
                    f,
                    "{pointer}: {found} is outside the range; {drawn} is drawn"
                )
            }
            NoticeKind::TooLong { found, most } => write!(
                f,
                "{pointer}: {found} characters; it is kept, and the first {most} count"
            ),
            NoticeKind::Normalised => {
                write!(f, "{pointer}: not of length 1; the direction is drawn")
            }
            NoticeKind::UnknownSubject { found } => write!(
                f,
                "{pointer}: this version does not know the built-in subject “{found}”; it is kept, not drawn"
            ),
            NoticeKind::UnknownRevision { revision, newest } => write!(
                f,
                "{pointer}: this version does not know revision {revision} of the subject; revision {newest} is drawn"
            ),
            NoticeKind::NotDrawn { what } => {
                write!(f, "{pointer}: {what} not drawn yet; kept")
            }
            NoticeKind::Beside { what } => {
                write!(f, "{pointer}: beside {what} this is kept, not drawn")
            }
            NoticeKind::SameName { name } => write!(
                f,
                "{pointer}: an object before is called “{name}” too; that one counts"
            ),
            NoticeKind::NotCarving { why } => {
                write!(f, "{pointer}: {why}; the template is kept, not drawn")
            }
            NoticeKind::Dangling { target } => {
                write!(f, "{pointer}: {target} is not there; left out")
            }
            NoticeKind::NoControl { why } => write!(f, "{pointer}: {why}; readers cannot move it"),
            NoticeKind::More => write!(f, "there is more that this version does not know"),
            NoticeKind::Curve { what } => write!(f, "{pointer}: {what}"),
            NoticeKind::LeftAside { taken } => {
                write!(f, "{pointer}: {taken} is shown; this is kept, left aside")
            }
        }
    }
}
