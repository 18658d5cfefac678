use std::sync::Arc;

use super::plane::reduced_size;
use super::svg::{DRAWN_SIDE, Drawing, SvgError};
use crate::data::{Plate, PlateOrigin};
use crate::pictures::{
    Picture, PictureError, PictureHeader, decode, orientation, reduced, upright,
};
use glam::dvec2;

/// Bytes by which the file of a figure is known: those in which an SVG has to begin.
pub const SNIFF_BYTES: usize = 4096;

/// What the file of a figure is, by its bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FigureFile {
    /// A PNG or JPEG.
    Picture,
    /// An SVG, of which shapes are drawn.
    Drawing,
}

impl FigureFile {
    /// What a file is that begins with these bytes; none if it is no figure.
    pub fn of(start: &[u8]) -> Option<Self> {
        if start.starts_with(b"\x89PNG") || start.starts_with(b"\xff\xd8\xff") {
            return Some(Self::Picture);
        }
        let start = &start[..start.len().min(SNIFF_BYTES)];
        let text = start
            .strip_prefix(b"\xef\xbb\xbf")
            .unwrap_or(start)
            .trim_ascii_start();
        let is_xml = text.starts_with(b"<");
        let has_svg = text.windows(4).any(|part| part == b"<svg");
        (is_xml && has_svg).then_some(Self::Drawing)
    }
}

/// Endings of the names of figures' files.
const ENDINGS: [&str; 4] = [".png", ".jpg", ".jpeg", ".svg"];

/// True if a name promises a figure; the file's bytes decide.
pub fn is_figure_name(name: &str) -> bool {
    let lower = name.to_lowercase();
    ENDINGS.iter().any(|ending| lower.ends_with(ending))
}

/// Why a file gave no figure.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum PlateError {
    /// Of another kind, or of none.
    #[error("no picture that Fabrica knows (PNG, JPEG, SVG): it begins with {0}")]
    Unknown(String),
    /// A picture that cannot be read.
    #[error(transparent)]
    Picture(#[from] PictureError),
    /// A drawing that cannot be read.
    #[error(transparent)]
    Drawing(#[from] SvgError),
    /// There is no drawing of the program by this name.
    #[error("there is no built-in figure “{0}”")]
    UnknownName(String),
}

/// A figure's file that was read.
#[derive(Clone, Debug, PartialEq)]
pub struct ReadPlate {
    /// The picture, with what regions are found in.
    pub plate: Plate,
    /// What is drawn otherwise than the file has it, or is left aside, in words.
    pub asides: Vec<String>,
}

/// Reads the file of a figure.
///
/// # Errors
/// [`PlateError`].
pub fn read_plate(bytes: &[u8]) -> Result<ReadPlate, PlateError> {
    match FigureFile::of(bytes) {
        Some(FigureFile::Picture) => {
            PictureHeader::of(bytes)?;
            Ok(plate_of_picture(upright(
                decode(bytes)?,
                orientation(bytes),
            )))
        }
        Some(FigureFile::Drawing) => Ok(plate_of_drawing(bytes)?),
        None => Err(PlateError::Unknown(beginning(bytes))),
    }
}

/// The plate of a picture that stands upright: of its own pixels, or of the smaller copy that is drawn where it is
/// large.
pub fn plate_of_picture(picture: Picture) -> ReadPlate {
    let size = picture.size;
    let mut asides = Vec::new();
    if picture.is_of_inks {
        asides
            .push("the picture mixes inks (CMYK); its colours were taken by inversion".to_owned());
    }
    let small = reduced_size(size);
    let picture = match small == size {
        true => picture,
        false => {
            asides.push(format!(
                "the picture has {} × {} pixels; it is drawn from a copy of {} × {}",
                size[0], size[1], small[0], small[1]
            ));
            reduced(&picture, small)
        }
    };
    let plate = Plate {
        size: dvec2(f64::from(size[0]), f64::from(size[1])),
        picture,
        origin: PlateOrigin::Pixels,
        shapes: Vec::new(),
        words: Vec::new(),
    };
    ReadPlate { plate, asides }
}

/// The plate of an SVG.
///
/// # Errors
/// [`SvgError`].
pub fn plate_of_drawing(bytes: &[u8]) -> Result<ReadPlate, SvgError> {
    let drawing = Drawing::read(bytes)?;
    let mut asides = Vec::new();
    if !drawing.words.is_empty() {
        let words: Vec<&str> = drawing.words.iter().map(|word| &*word.text).collect();
        let words = words.join("”, “");
        asides.push(format!("text of the SVG is not drawn: “{words}”"));
    }
    if !drawing.left_out.is_empty() {
        let kinds: Vec<&str> = drawing.left_out.iter().copied().collect();
        asides.push(format!("not drawn of the SVG: {}", kinds.join(", ")));
    }
    let plate = Plate {
        size: drawing.size,
        picture: drawing.picture(DRAWN_SIDE)?,
        origin: PlateOrigin::Drawing(Arc::from(bytes)),
        shapes: drawing.pointed(),
        words: drawing.offered(),
    };
    Ok(ReadPlate { plate, asides })
}

/// The plate of a drawing of the program.
///
/// # Errors
/// [`PlateError::UnknownName`].
pub fn builtin_plate(name: &str) -> Result<Plate, PlateError> {
    let drawn = super::drawn::drawn(name);
    let drawn = drawn.ok_or_else(|| PlateError::UnknownName(name.chars().take(40).collect()))?;
    Ok(Plate {
        origin: PlateOrigin::Builtin(name.to_owned()),
        shapes: Vec::new(),
        ..plate_of_drawing(drawn.svg.as_bytes())?.plate
    })
}

/// The first bytes of a file, in words.
fn beginning(bytes: &[u8]) -> String {
    let start = &bytes[..bytes.len().min(8)];
    if start.is_empty() {
        return "nothing: it is empty".to_owned();
    }
    match std::str::from_utf8(start) {
        Ok(text) if text.chars().all(|letter| !letter.is_control()) => format!("“{text}”"),
        _ => {
            let hex: Vec<String> = start.iter().map(|byte| format!("{byte:02x}")).collect();
            hex.join(" ")
        }
    }
}
