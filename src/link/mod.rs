//! Layer 2: a document as the fragment of an address, and back.
//!
//! A payload is made of `A-Z a-z 0-9 - _` only: one character for the version, then what that version says, then five
//! characters of checksum over all before them. Each version has its file, and every version that was ever released
//! stays readable.
//!
//! ```
//! use fabrica::document::Document;
//! use fabrica::link;
//!
//! let text = r#"{ "fabrica": 1, "subject": { "builtin": "bar" }, "templates": [{ "kind": "peel" }] }"#;
//! let document = Document::from_json(text)?;
//! let address = format!("https://example.org/lesson{}", link::fragment(&document, 2));
//! let read = link::decode(&format!("{address}&from=course-7"))?;
//! assert_eq!((read.document, read.step), (document, 2));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod address;
mod error;
mod model;
mod payload;
mod qr;
mod v1;

pub use address::{ADVISED_LENGTH, Link, decode, document_of, encode, fragment, has_payload};
pub use error::LinkError;
pub use qr::{DENSE_QR, LONGEST_QR, Qr, TooLongForQr};
