//! A link as a QR code (ISO/IEC 18004), for slides and paper.

use qrcodegen::{QrCode, QrCodeEcc};

/// Characters above which a code is so dense that some phones do not read it from a screen or a projector.
pub const DENSE_QR: usize = 1200;
/// Characters above which no code is made. The largest code holds 2,953 bytes.
pub const LONGEST_QR: usize = 2900;

/// A QR code.
#[derive(Clone, PartialEq, Eq)]
pub struct Qr {
    code: QrCode,
}

impl std::fmt::Debug for Qr {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Qr of {} modules along a side", self.code.size())
    }
}

/// The text is too long for a QR code.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "the link has {found} characters, and a QR code holds {LONGEST_QR}: pass on a document file instead"
)]
pub struct TooLongForQr {
    /// Bytes of the text; of a link as many as characters.
    pub found: usize,
}

impl Qr {
    /// Modules that stay light on every side of a code, as the standard asks for.
    pub const QUIET: usize = 4;

    /// The code of a text, in the smallest size that holds it. A text that is not dense gets the error correction
    /// that mends a code damaged by 15 percent, else by 7, and more where it fits the same size.
    ///
    /// # Errors
    /// [`TooLongForQr`].
    pub fn of(text: &str) -> Result<Self, TooLongForQr> {
        let found = text.len();
        let too_long = TooLongForQr { found };
        if found > LONGEST_QR {
            return Err(too_long);
        }
        let correction = match found > DENSE_QR {
            true => QrCodeEcc::Low,
            false => QrCodeEcc::Medium,
        };
        let code = QrCode::encode_text(text, correction).map_err(|_data_too_long| too_long)?;
        Ok(Self { code })
    }

    /// Modules along a side, those around it that stay light included.
    pub fn side(&self) -> usize {
        self.code.size() as usize + 2 * Self::QUIET
    }

    /// True if a module is dark; counted from the top left, with the light ones around.
    pub fn is_dark(&self, x: usize, y: usize) -> bool {
        let at = |i: usize| i as i32 - Self::QUIET as i32;
        self.code.get_module(at(x), at(y))
    }

    /// The code as an SVG picture, black on white.
    pub fn to_svg(&self) -> String {
        let side = self.side();
        let mut path = String::new();
        for y in 0..side {
            let mut x = 0;
            while x < side {
                let run = (x..side).take_while(|&x| self.is_dark(x, y)).count();
                if run > 0 {
                    path.push_str(&format!("M{x} {y}h{run}v1h-{run}z"));
                }
                x += run.max(1);
            }
        }
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {side} {side}\" shape-rendering=\"crispEdges\">\
             <path fill=\"#fff\" d=\"M0 0h{side}v{side}h-{side}z\"/><path d=\"{path}\"/></svg>\n"
        )
    }

    /// The code as rows of gray from the top, so many pixels along a module, and the pixels along a side.
    pub fn to_gray(&self, pixels: usize) -> (usize, Vec<u8>) {
        let side = self.side() * pixels;
        let mut gray = Vec::with_capacity(side * side);
        for y in 0..side {
            for x in 0..side {
                let is_dark = self.is_dark(x / pixels, y / pixels);
                gray.push(if is_dark { 0 } else { 255 });
            }
        }
        (side, gray)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A text of the characters of a link.
    fn link(length: usize) -> String {
        let page = "https://fabrica.example/#1";
        let payload = (0..length - page.len()).map(|i| b"aZ9-_Qk3x"[(i * i + i / 7) % 9] as char);
        page.chars().chain(payload).collect()
    }

    #[test]
    fn a_code_reads_back() {
        for length in [40, 300, DENSE_QR, DENSE_QR + 1, LONGEST_QR] {
            let text = link(length);
            let qr = Qr::of(&text).expect("a code");
            let (side, gray) = qr.to_gray(3);
            let mut image =
                rqrr::PreparedImage::prepare_from_greyscale(side, side, |x, y| gray[y * side + x]);
            let grids = image.detect_grids();
            assert_eq!(grids.len(), 1, "of {length} characters");
            let (_, read) = grids[0].decode().expect("a sound code");
            assert_eq!(read, text);
        }
    }

    #[test]
    fn what_is_too_long_is_refused_in_words() {
        let error = Qr::of(&link(LONGEST_QR + 1)).expect_err("too long");
        let text = error.to_string();
        assert!(text.contains("2901") && text.contains("2900"), "{text}");
        assert!(text.contains("document file"), "{text}");
    }

    #[test]
    fn the_drawing_has_the_same_modules() {
        let qr = Qr::of("https://fabrica.example/").expect("a code");
        let svg = qr.to_svg();
        let (_, path) = svg.rsplit_once(" d=\"").expect("a path");
        let mut dark = vec![false; qr.side() * qr.side()];
        for run in path.split('M').skip(1) {
            let numbers: Vec<usize> = run
                .split(|c: char| !c.is_ascii_digit())
                .filter_map(|number| number.parse().ok())
                .collect();
            let [x, y, length, ..] = numbers[..] else {
                panic!("{run}")
            };
            dark[y * qr.side() + x..][..length].fill(true);
        }
        for y in 0..qr.side() {
            for x in 0..qr.side() {
                assert_eq!(dark[y * qr.side() + x], qr.is_dark(x, y), "{x} {y}");
            }
        }
        assert!(
            (0..qr.side()).all(|i| !qr.is_dark(i, 3) && !qr.is_dark(3, i)),
            "a light edge"
        );
        assert!(qr.is_dark(4, 4));
    }
}
