//! The header of a PLY: which elements follow, with which properties, in which form.

use super::error::MeshError;
use super::input::{Input, space_in};
use super::options::Axes;

/// Lines of a header, and bytes of a line, at most.
const MAX_LINES: u64 = 10_000;
const MAX_LINE_BYTES: usize = 4096;

/// How the elements are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Form {
    Ascii,
    Binary { is_big: bool },
}

/// Type of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Scalar {
    fn named(word: &str) -> Option<Self> {
        Some(match word {
            "char" | "int8" => Self::I8,
            "uchar" | "uint8" => Self::U8,
            "short" | "int16" => Self::I16,
            "ushort" | "uint16" => Self::U16,
            "int" | "int32" => Self::I32,
            "uint" | "uint32" => Self::U32,
            "float" | "float32" => Self::F32,
            "double" | "float64" => Self::F64,
            _ => return None,
        })
    }

    /// Bytes of a number.
    pub(super) fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }

    /// What the value 1 of a colour is written as.
    pub(super) fn one(self) -> f32 {
        match self {
            Self::I8 => 127.0,
            Self::U8 => 255.0,
            Self::I16 => 32_767.0,
            Self::U16 => 65_535.0,
            Self::I32 | Self::U32 | Self::F32 | Self::F64 => 1.0,
        }
    }

    /// The number in these bytes, of which there are as many as [`Scalar::size`].
    pub(super) fn decode(self, bytes: [u8; 8], is_big: bool) -> f64 {
        fn first<const N: usize>(bytes: [u8; 8], is_big: bool) -> [u8; N] {
            let mut part = [0; N];
            part.copy_from_slice(&bytes[..N]);
            if is_big {
                part.reverse();
            }
            part
        }
        match self {
            Self::I8 => i8::from_le_bytes(first(bytes, is_big)).into(),
            Self::U8 => bytes[0].into(),
            Self::I16 => i16::from_le_bytes(first(bytes, is_big)).into(),
            Self::U16 => u16::from_le_bytes(first(bytes, is_big)).into(),
            Self::I32 => i32::from_le_bytes(first(bytes, is_big)).into(),
            Self::U32 => u32::from_le_bytes(first(bytes, is_big)).into(),
            Self::F32 => f32::from_le_bytes(first(bytes, is_big)).into(),
            Self::F64 => f64::from_le_bytes(first(bytes, is_big)),
        }
    }
}

/// One property of an element.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Property {
    pub(super) name: String,
    /// Type of the count, of a list.
    pub(super) count: Option<Scalar>,
    pub(super) item: Scalar,
}

/// A kind of element, how many of it follow, and what each of them consists of.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Element {
    pub(super) name: String,
    pub(super) count: u64,
    pub(super) properties: Vec<Property>,
}

impl Element {
    /// Bytes of one, if it has no list.
    pub(super) fn size(&self) -> Option<u64> {
        let sizes = self.properties.iter().map(|property| match property.count {
            None => Some(property.item.size() as u64),
            Some(_) => None,
        });
        sizes.sum()
    }
}

/// What a header says.
#[derive(Debug)]
pub(super) struct Header {
    pub(super) form: Form,
    pub(super) elements: Vec<Element>,
    pub(super) space: Option<Axes>,
    pub(super) names_texture: bool,
    /// Lines of the header.
    pub(super) line_count: u64,
}

/// One line, ended as the first one is.
fn line(input: &mut Input<'_, '_>, end: u8) -> Result<Option<String>, MeshError> {
    let mut line = Vec::new();
    let mut byte = [0];
    while input.fill(&mut byte)? == 1 {
        if byte[0] == end {
            return Ok(Some(String::from_utf8_lossy(&line).into_owned()));
        }
        if line.len() == MAX_LINE_BYTES {
            break;
        }
        line.push(byte[0]);
    }
    Ok(None)
}

/// Reads a header to its end.
pub(super) fn read(input: &mut Input<'_, '_>, name: &str) -> Result<Header, MeshError> {
    // Binary elements begin right after the end of the last line, so that it has to be known which it is.
    let end = match input.peek(5)?[..] {
        [_, _, _, b'\r', next, ..] if next != b'\n' => b'\r',
        _ => b'\n',
    };
    let mut form = None;
    let mut header = Header {
        form: Form::Ascii,
        elements: Vec::new(),
        space: None,
        names_texture: false,
        line_count: 0,
    };
    loop {
        header.line_count += 1;
        let number = header.line_count;
        let wrong = |what: &str| MeshError::Line {
            name: name.to_owned(),
            line: number,
            what: what.to_owned(),
        };
        let Some(text) = line(input, end)? else {
            return Err(wrong("the file ends before end_header"));
        };
        if number > MAX_LINES {
            return Err(wrong("the header has no end"));
        }
        let words: Vec<&str> = text.split_whitespace().collect();
        match words[..] {
            [] | ["obj_info", ..] => {}
            ["ply"] if number == 1 => {}
            ["comment", ..] => {
                header.space = header.space.or(space_in(&text));
                header.names_texture |= words.get(1) == Some(&"TextureFile");
            }
            ["format", kind, "1.0"] => {
                form = Some(match kind {
                    "ascii" => Form::Ascii,
                    "binary_little_endian" => Form::Binary { is_big: false },
                    "binary_big_endian" => Form::Binary { is_big: true },
                    _ => {
                        return Err(wrong(
                            "expected ascii, binary_little_endian or binary_big_endian",
                        ));
                    }
                });
            }
            ["element", name, count] => {
                let Ok(count) = count.parse() else {
                    return Err(wrong("expected the number of elements"));
                };
                header.elements.push(Element {
                    name: name.to_owned(),
                    count,
                    properties: Vec::new(),
                });
            }
            ["property", ref rest @ ..] => {
                let Some(element) = header.elements.last_mut() else {
                    return Err(wrong("a property stands before any element"));
                };
                let scalar =
                    |word| Scalar::named(word).ok_or_else(|| wrong("expected a type of numbers"));
                let (count, item, name) = match *rest {
                    ["list", count, item, name] => (Some(scalar(count)?), scalar(item)?, name),
                    [item, name] => (None, scalar(item)?, name),
                    _ => return Err(wrong("expected a type and a name")),
                };
                element.properties.push(Property {
                    name: name.to_owned(),
                    count,
                    item,
                });
            }
            ["end_header"] => break,
            _ => {
                return Err(wrong(
                    "expected format, element, property, comment or end_header",
                ));
            }
        }
    }
    header.form = form.ok_or_else(|| MeshError::Content {
        name: name.to_owned(),
        what: "the header does not say its format".to_owned(),
    })?;
    Ok(header)
}
