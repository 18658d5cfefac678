//! What is selected: a template, an object of the scene, a stroke of a clay, or nothing.

/// At most one thing is selected at a time. Indices are those of the document's lists.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Selection {
    /// Nothing is selected.
    #[default]
    Nothing,
    /// An entry of `templates`.
    Template(usize),
    /// An entry of `objects`.
    Object(usize),
    /// An entry of the clay's `strokes`.
    Stroke(usize),
}

impl Selection {
    /// A template, or nothing.
    pub fn of_template(index: Option<usize>) -> Self {
        index.map_or(Self::Nothing, Self::Template)
    }

    /// An object, or nothing.
    pub fn of_object(index: Option<usize>) -> Self {
        index.map_or(Self::Nothing, Self::Object)
    }

    /// The index of the template, if one is selected.
    pub fn template(self) -> Option<usize> {
        match self {
            Self::Template(index) => Some(index),
            Self::Object(_) | Self::Stroke(_) | Self::Nothing => None,
        }
    }

    /// The index of the stroke, if one is selected.
    pub fn stroke(self) -> Option<usize> {
        match self {
            Self::Stroke(index) => Some(index),
            Self::Template(_) | Self::Object(_) | Self::Nothing => None,
        }
    }

    /// The index of the object, if one is selected.
    pub fn object(self) -> Option<usize> {
        match self {
            Self::Object(index) => Some(index),
            Self::Template(_) | Self::Stroke(_) | Self::Nothing => None,
        }
    }
}
