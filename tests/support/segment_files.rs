//! Documents whose subject and label volumes are files, and what must come of each of them: the same in a command, in
//! the window and on the page.

use serde_json::{Value, json};
use sha2::{Digest as _, Sha256};

/// Name of the scan.
pub(crate) const SCAN: &str = "scan.nii";
/// Name of a label volume on its grid: 1 in the middle of x, 2 at its end.
pub(crate) const PARTS: &str = "parts.nii";

/// What must come of a document.
pub(crate) struct Case {
    /// Name of the case, for messages.
    pub(crate) name: &'static str,
    /// Value of the document's `subject`.
    pub(crate) subject: Value,
    /// The segments that there are.
    pub(crate) segments: &'static [&'static str],
    /// Names that are none.
    pub(crate) absent: &'static [&'static str],
    /// Parts of one message to the user.
    pub(crate) says: Vec<String>,
    /// It is an error, not a notice.
    pub(crate) is_error: bool,
}

/// Voxels along each axis of the files here.
const DIMS: [i16; 3] = [16, 12, 8];

/// A NIfTI-1 volume of 16-bit numbers with voxels of 1 mm about the origin.
pub(crate) fn nifti(dims: [i16; 3], value: impl Fn(i16, i16, i16) -> i16) -> Vec<u8> {
    let mut bytes = vec![0_u8; 352];
    let mut put = |at: usize, data: &[u8]| bytes[at..at + data.len()].copy_from_slice(data);
    put(0, &348_i32.to_le_bytes());
    let [width, height, depth] = dims;
    for (i, n) in [3, width, height, depth, 1, 1, 1, 1]
        .into_iter()
        .enumerate()
    {
        put(40 + 2 * i, &n.to_le_bytes());
    }
    put(70, &4_i16.to_le_bytes());
    put(72, &16_i16.to_le_bytes());
    for i in 0..8 {
        put(76 + 4 * i, &1_f32.to_le_bytes());
    }
    put(108, &352_f32.to_le_bytes());
    put(112, &1_f32.to_le_bytes());
    put(254, &1_i16.to_le_bytes());
    for (row, n) in dims.into_iter().enumerate() {
        put(280 + 20 * row, &1_f32.to_le_bytes());
        put(292 + 16 * row, &(-0.5 * (f32::from(n) - 1.0)).to_le_bytes());
    }
    put(344, b"n+1\0");
    for z in 0..depth {
        for y in 0..height {
            for x in 0..width {
                bytes.extend(value(x, y, z).to_le_bytes());
            }
        }
    }
    bytes
}

/// The files by their names.
pub(crate) fn files() -> [(&'static str, Vec<u8>); 2] {
    [
        (SCAN, nifti(DIMS, |x, y, z| x * 50 + y + z)),
        (
            PARTS,
            nifti(DIMS, |x, _, _| i16::from(x >= 5) + i16::from(x >= 10)),
        ),
    ]
}

/// SHA-256 of bytes, lower-case hex.
pub(crate) fn hash(bytes: &[u8]) -> String {
    let digest = Sha256::digest(bytes);
    digest.iter().map(|byte| format!("{byte:02x}")).collect()
}

/// Documents that name label volumes, with what must come of each.
pub(crate) fn cases() -> Vec<Case> {
    let [scan, parts] = files().map(|(_, bytes)| hash(&bytes));
    let other = "0".repeat(64);
    let subject = |segments: Value| json!({ "src": SCAN, "segments": segments });
    vec![
        Case {
            name: "by an address alone",
            subject: subject(json!([{ "src": PARTS }])),
            segments: &["segment 1", "segment 2"],
            absent: &["bone"],
            says: Vec::new(),
            is_error: false,
        },
        Case {
            name: "by an address and a hash",
            subject: subject(json!([{ "src": PARTS, "sha256": parts }])),
            segments: &["segment 1", "segment 2"],
            absent: &[],
            says: Vec::new(),
            is_error: false,
        },
        Case {
            name: "the author's names, one of a number that does not occur",
            subject: subject(json!([{ "src": PARTS, "names": { "1": "bone", "7": "ghost" } }])),
            segments: &["bone", "segment 2"],
            absent: &["segment 1", "ghost"],
            says: vec!["/names/7".to_owned(), "ghost".to_owned()],
            is_error: false,
        },
        Case {
            name: "names for a scan that has no segments",
            subject: subject(json!([{ "names": { "3": "ghost" } }])),
            segments: &[],
            absent: &["ghost"],
            says: vec!["/names/3".to_owned(), "ghost".to_owned()],
            is_error: false,
        },
        Case {
            name: "another label volume",
            subject: subject(json!([{ "src": PARTS, "sha256": other }])),
            segments: &[],
            absent: &["segment 1", "segment 2"],
            says: vec![other.clone(), parts],
            is_error: true,
        },
        Case {
            name: "another scan",
            subject: json!({ "src": SCAN, "sha256": other }),
            segments: &[],
            absent: &[],
            says: vec![other, scan],
            is_error: true,
        },
    ]
}
