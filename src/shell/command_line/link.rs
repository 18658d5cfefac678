//! `fabrica link`: the link of a document, and its QR code.

use std::path::Path;

use super::error::CliError;
use super::opening::Opened;
use super::output::{notice, print, write_whole};
use crate::link::{self, DENSE_QR, Qr};
use crate::render::{Image, encode_png};

/// Pixels along a module of a QR code.
const MODULE_PX: usize = 8;

/// Prints the link of a document behind the address of a page, and writes its QR code into a file.
pub(super) fn link(opened: &Opened, page: &str, qr: Option<&Path>) -> Result<(), CliError> {
    opened.report_notices();
    let fragment = link::fragment(&opened.document, opened.step);
    if fragment.len() > link::ADVISED_LENGTH {
        notice(format!(
            "the link has {} characters; above {} some programs cut it, a document file is safer",
            fragment.len(),
            link::ADVISED_LENGTH
        ));
    }
    let page = page.split('#').next().unwrap_or_default();
    let address = format!("{page}{fragment}");
    if let Some(path) = qr {
        write_qr(&address, page.is_empty(), path)?;
    }
    print(&format!("{address}\n"))
}

fn write_qr(address: &str, is_bare: bool, path: &Path) -> Result<(), CliError> {
    let ending = path.extension().map(|ending| ending.to_ascii_lowercase());
    let is_svg = match ending.as_ref().and_then(|ending| ending.to_str()) {
        Some("svg") => true,
        Some("png") => false,
        _ => {
            return Err(CliError::Usage(
                "--qr writes SVG or PNG: name a file that ends in .svg or .png",
            ));
        }
    };
    let qr = Qr::of(address)?;
    if is_bare {
        notice(
            "the QR code holds a link without a page, which opens nothing: name one by --page URL",
        );
    }
    if address.len() > DENSE_QR {
        notice(format!(
            "the QR code holds {} characters; above {DENSE_QR} it is so dense that some phones do not read it",
            address.len()
        ));
    }
    let bytes = if is_svg {
        qr.to_svg().into_bytes()
    } else {
        let (side, gray) = qr.to_gray(MODULE_PX);
        encode_png(&Image {
            size: [side as u32; 2],
            rgba: gray.into_iter().flat_map(|v| [v, v, v, 255]).collect(),
        })?
    };
    write_whole(path, &bytes)
}
