//! A finished picture by its rows, for pictures that are too large for the memory: they are drawn from the top, and
//! each band of rows goes on its way, into a PNG file for one, before the next is drawn.

use super::image::png_encoder;
use super::tiles::TILE;
use crate::render::device::error::RenderError;
use std::cell::{Cell, RefCell};
use std::io::{self, ErrorKind, Write};
use std::rc::Rc;

/// The longest side of a picture, pixels: the longest that every device draws.
pub const MOST_PX: u32 = 8192;

/// Pixels that are drawn at once, about: 16 MiB with all that belongs to them. Fewer would let the device wait more
/// often than it draws.
const BAND_PX: u32 = 1 << 20;

/// Rows of a picture of this width that are drawn at once: whole tiles.
pub(super) fn band_rows(width: u32) -> u32 {
    (BAND_PX / width.max(1) / TILE).max(1) * TILE
}

/// A size of the same shape whose sides have so many pixels at most, and one at least.
pub fn shrunk(size: [u32; 2], most: u32) -> [u32; 2] {
    let factor = (f64::from(most) / f64::from(size[0].max(size[1]).max(1))).min(1.0);
    size.map(|side| ((f64::from(side) * factor).round() as u32).max(1))
}

/// How a finished picture is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PictureSpec {
    /// Width and height, pixels.
    pub size_px: [u32; 2],
    /// Samples per pixel, 1 at least.
    pub samples: u32,
    /// The object throws a soft shadow on its background, or on nothing where there is none.
    pub has_shadow: bool,
}

/// Rows of a picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Rows {
    /// The row of the picture that is the first of these.
    pub first: u32,
    /// sRGB with straight alpha, from the top.
    pub rgba: Vec<u8>,
}

/// Whoever takes a picture as it is drawn.
pub trait Taker {
    /// How much is drawn, 0 to 1. To be called often; an error, such as [`RenderError::Stopped`], ends the drawing.
    ///
    /// # Errors
    /// Why nothing more is to be drawn.
    fn progress(&mut self, part: f32) -> Result<(), RenderError>;

    /// The next rows, those below the ones before.
    ///
    /// # Errors
    /// Why they cannot be taken.
    fn take(&mut self, rows: Rows) -> Result<(), RenderError>;
}

/// A PNG file that is written row by row.
pub struct PngRows<W: Write + 'static> {
    stream: png::StreamWriter<'static, Heard<W>>,
    failure: Failure,
}

/// What kept bytes from being written.
type Failure = Rc<Cell<Option<ErrorKind>>>;

/// Where bytes go, and whether all of them did: the encoder drops the errors of a file's last bytes.
struct Heard<W> {
    out: W,
    failure: Failure,
}

impl<W: Write> Heard<W> {
    fn hear<T>(&self, result: io::Result<T>) -> io::Result<T> {
        result.inspect_err(|error| self.failure.set(Some(error.kind())))
    }
}

impl<W: Write> Write for Heard<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let result = self.out.write(bytes);
        self.hear(result)
    }

    fn flush(&mut self) -> io::Result<()> {
        let result = self.out.flush();
        self.hear(result)
    }
}

impl<W: Write + 'static> PngRows<W> {
    /// Begins a file for a picture of this size that is printed with so many dots per inch, if that is known.
    ///
    /// # Errors
    /// [`RenderError::Png`].
    pub fn new(out: W, size_px: [u32; 2], dpi: Option<f32>) -> Result<Self, RenderError> {
        let failure = Failure::default();
        let heard = Heard {
            out,
            failure: Rc::clone(&failure),
        };
        let writer = png_encoder(heard, size_px, dpi).write_header()?;
        Ok(Self {
            stream: writer.into_stream_writer()?,
            failure,
        })
    }

    /// Writes the next rows: sRGB with straight alpha.
    ///
    /// # Errors
    /// [`RenderError::Png`].
    pub fn write(&mut self, rgba: &[u8]) -> Result<(), RenderError> {
        self.stream
            .write_all(rgba)
            .map_err(png::EncodingError::from)?;
        Ok(())
    }

    /// Ends the file.
    ///
    /// # Errors
    /// [`RenderError::Png`], also if rows are missing.
    pub fn finish(self) -> Result<(), RenderError> {
        self.stream.finish()?;
        match self.failure.take() {
            Some(kind) => Err(png::EncodingError::from(io::Error::from(kind)).into()),
            None => Ok(()),
        }
    }
}

/// A file in main memory, which its writer and its reader share.
#[derive(Clone, Debug, Default)]
pub struct FileInMemory(Rc<RefCell<Vec<u8>>>);

impl FileInMemory {
    /// The bytes so far, which are then no longer in it.
    pub fn take(&self) -> Vec<u8> {
        self.0.take()
    }
}

impl Write for FileInMemory {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.borrow_mut().extend_from_slice(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::draw::image::{Image, decode_png};

    /// Takes so many bytes.
    struct FullDisk(usize);

    impl Write for FullDisk {
        fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
            match self.0.checked_sub(bytes.len()) {
                Some(left) => self.0 = left,
                None => return Err(ErrorKind::StorageFull.into()),
            }
            Ok(bytes.len())
        }

        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }

    #[test]
    fn bands_are_whole_tiles() {
        for width in [1, 64, 1000, 4096, 8192, u32::MAX] {
            let rows = band_rows(width);
            assert!(
                rows >= TILE && rows.is_multiple_of(TILE),
                "{rows} rows of {width}"
            );
        }
        assert_eq!(band_rows(8192), 128);
    }

    #[test]
    fn rows_make_a_file_with_its_resolution() {
        let image = Image {
            size: [5, 7],
            rgba: (0..140).map(|i| (i * 37 % 251) as u8).collect(),
        };
        let file = FileInMemory::default();
        let mut png = PngRows::new(file.clone(), image.size, Some(300.0)).expect("a header");
        for rows in image.rgba.chunks(4 * 5 * 3) {
            png.write(rows).expect("rows");
        }
        png.finish().expect("a file");
        let bytes = file.take();
        assert_eq!(decode_png(&bytes).expect("a PNG"), image);
        let at = bytes.windows(4).position(|name| name == b"pHYs");
        let found = at.map(|at| bytes[at + 4..at + 13].to_vec());
        // 300 dots per inch are 11,811.02 per metre; 1: the unit is the metre.
        let per_meter = 11_811_u32.to_be_bytes();
        let wanted = [&per_meter[..], &per_meter, &[1]].concat();
        assert_eq!(found, Some(wanted), "the chunk of the resolution");
        // A disk that is full before the last bytes.
        let disk = FullDisk(bytes.len() - 5);
        let mut png = PngRows::new(disk, image.size, Some(300.0)).expect("a header");
        png.write(&image.rgba).expect("not noticed yet");
        assert!(png.finish().is_err(), "noticed at the end");
        let without = FileInMemory::default();
        let png = PngRows::new(without.clone(), [1, 1], None).expect("a header");
        assert!(png.finish().is_err(), "rows are missing");
        assert!(!without.take().windows(4).any(|name| name == b"pHYs"));
    }
}
