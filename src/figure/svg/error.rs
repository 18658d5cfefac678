/// Why bytes give no drawing.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum SvgError {
    /// Larger than is opened.
    #[error("the SVG has {bytes} bytes, more than {limit}")]
    TooLarge {
        /// Bytes of the file.
        bytes: usize,
        /// Bytes that it may have.
        limit: usize,
    },
    /// No XML in UTF-8.
    #[error("the SVG is no XML: line {line}, column {column}")]
    NoXml {
        /// Line, from 1.
        line: u32,
        /// Column, from 1.
        column: u32,
    },
    /// Elements in elements in elements.
    #[error("the SVG nests deeper than {limit} levels")]
    TooDeep {
        /// Levels that it may have.
        limit: usize,
    },
    /// More elements than are read, `use` counted as often as it is used.
    #[error("the SVG has more than {limit} elements")]
    TooMany {
        /// Elements that it may have.
        limit: usize,
    },
    /// Entities that stand for each other.
    #[error("the SVG's entities expand without end")]
    Entities,
    /// Elements that are used in each other.
    #[error("the SVG's elements use each other in a circle, or through too many levels")]
    Uses,
    /// Shapes that are used, or marked at points, over and over.
    #[error("the SVG repeats its shapes too often to be read")]
    Repeats,
    /// Rules of style that take too long to be read, or to find their elements.
    #[error("the SVG has too many rules of style for its elements")]
    Styles,
    /// Shapes that take too long to be drawn.
    #[error("the SVG has too many large or long shapes to be drawn in time")]
    Intricate,
    /// XML, but no SVG that has a size.
    #[error("the file is no SVG, or has no size")]
    NoSvg,
}
