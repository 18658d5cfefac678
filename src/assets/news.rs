use std::fmt;

/// A remark on a file that arrived for a document. Displayed, it is one line that begins with a JSON pointer into the
/// document.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ResourceNews {
    /// The author names a number that no segment of the file has; the name makes no segment.
    NoSegment {
        /// JSON pointer of the entry of `subject.segments`.
        pointer: String,
        /// The number in the file.
        number: u32,
        /// What the author calls it.
        name: String,
    },
    /// The subject is a mesh, and further meshes beside it are kept and not drawn.
    MeshesKept,
    /// A field is drawn, but not quite as its file has it.
    FieldNotice {
        /// Index of the template in the document.
        template: usize,
        /// What is different.
        line: String,
    },
    /// An object is thinner than a cell of the grids by which it would carve, and cuts nothing.
    TooThin {
        /// Index of the template in the document.
        template: usize,
        /// What the object is called.
        object: String,
    },
    /// A mesh that a tool is made of has no inside.
    ToolIsSheet {
        /// JSON pointer of the tool.
        pointer: String,
        /// What the file is called.
        name: String,
    },
    /// A field cannot be used with this subject.
    FieldRefused {
        /// Index of the template in the document.
        template: usize,
        /// Why, in plain words.
        why: String,
    },
}

impl fmt::Display for ResourceNews {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoSegment {
                pointer,
                number,
                name,
            } => write!(
                f,
                "{pointer}/names/{number}: the file has no segment of this number; “{name}” names nothing"
            ),
            Self::MeshesKept => f.write_str(
                "/subject/meshes: meshes beside a subject that is a mesh itself are kept, but not drawn yet",
            ),
            Self::FieldNotice { template, line } => write!(f, "/templates/{template}: {line}"),
            Self::TooThin { template, object } => write!(
                f,
                "/templates/{template}: “{object}” is too thin everywhere to carve: thinner than a cell of 1/128 of its longest side or less"
            ),
            Self::ToolIsSheet { pointer, name } => write!(
                f,
                "{pointer}: “{name}” is open and has no inside: as a tool it is a sheet"
            ),
            Self::FieldRefused { template, why } => write!(f, "/templates/{template}: {why}"),
        }
    }
}
