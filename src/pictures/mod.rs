//! Layer 1: the pixels of PNG and JPEG files, and smaller copies of pictures.
//!
//! The decoders are Rust on every machine, without vector code that rounds in another way, so that the page and the
//! program get the same pixels from one file. Colours are taken as sRGB; embedded profiles and gamma are left aside,
//! and so is all else that a file says of itself. Sizes are checked by [`PictureHeader::of`] before pixels are
//! allocated.
//!
//! ```
//! use fabrica::pictures::{PictureError, PictureHeader, decode};
//! assert_eq!(decode(b"GIF89a"), Err(PictureError::Unknown));
//! # let mut file = Vec::new();
//! # let mut encoder = png::Encoder::new(&mut file, 2, 1);
//! # encoder.set_color(png::ColorType::Grayscale);
//! # encoder.write_header()?.write_image_data(&[7, 200])?;
//! assert_eq!(PictureHeader::of(&file)?.size, [2, 1]);
//! assert_eq!(decode(&file)?.pixels, [[7, 7, 7, 255], [200, 200, 200, 255]]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod decode;
mod error;
mod header;
mod limits;
mod orientation;
mod picture;
mod reduce;

pub use decode::decode;
pub use error::PictureError;
pub use header::{PictureHeader, PictureKind};
pub use limits::{MAX_FILE_BYTES, MAX_PIXELS, MAX_SIDE};
pub use orientation::{orientation, upright};
pub use picture::Picture;
pub use reduce::{halved, reduced, smaller_copies};
