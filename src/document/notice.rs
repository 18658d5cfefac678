use std::fmt;

/// Something in a document that is kept, but not drawn as written. Notices never stop anything.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Notice {
    /// JSON pointer to what is meant.
    pub pointer: String,
    /// What about it.
    pub kind: NoticeKind,
}

/// What a [`Notice`] says.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NoticeKind {
    /// A key that this version does not know.
    UnknownKey,
    /// A template of a kind, or without a kind, that this version does not know.
    UnknownTemplate {
        /// The kind, or empty.
        kind: String,
    },
    /// A parameter that the template has not.
    UnknownParam {
        /// The template's kind.
        kind: &'static str,
    },
    /// A name out of a list that this version does not know.
    UnknownValue {
        /// As written.
        found: String,
        /// What is taken in its place.
        instead: String,
    },
    /// A value outside its range.
    Clamped {
        /// As written.
        found: String,
        /// What is drawn.
        drawn: String,
    },
    /// A rotation that was no unit quaternion.
    Normalised,
    /// A built-in subject that this version does not know.
    UnknownSubject {
        /// As written.
        found: String,
    },
    /// Known, but not drawn by this version.
    NotDrawn {
        /// What, in plain words.
        what: &'static str,
    },
    /// A step sets something that is not there.
    Dangling {
        /// The pointer in `set`.
        target: String,
    },
    /// There are more, which are not listed.
    More,
    /// A curve that is not, or not wholly, drawn as written.
    Curve {
        /// Why, and what is drawn, in plain words.
        what: &'static str,
    },
    /// Two sources are named; one of them is left aside.
    LeftAside {
        /// What is taken.
        taken: &'static str,
    },
}

impl Notice {
    pub(super) fn new(pointer: impl Into<String>, kind: NoticeKind) -> Self {
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
            NoticeKind::Normalised => {
                write!(f, "{pointer}: not of length 1; the direction is drawn")
            }
            NoticeKind::UnknownSubject { found } => write!(
                f,
                "{pointer}: this version does not know the built-in subject “{found}”; it is kept, not drawn"
            ),
            NoticeKind::NotDrawn { what } => {
                write!(f, "{pointer}: {what} not drawn yet; kept")
            }
            NoticeKind::Dangling { target } => {
                write!(f, "{pointer}: {target} is not there; left out")
            }
            NoticeKind::More => write!(f, "there is more that this version does not know"),
            NoticeKind::Curve { what } => write!(f, "{pointer}: {what}"),
            NoticeKind::LeftAside { taken } => {
                write!(f, "{pointer}: {taken} is shown; this is kept, left aside")
            }
        }
    }
}
