//! Text: JSON, pointers, and the words of errors and notices.

mod error;
pub(crate) mod json;
mod notice;
pub mod pointer;
mod shortened;

pub use error::DocumentError;
pub use notice::{Notice, NoticeKind};
pub(crate) use shortened::shortened;
