//! A mesh and titles that the tests of all formats share.

use super::export::Export;
use glam::Vec3;

/// A tetrahedron with numbers that are not round in any base, and its normals.
pub(super) fn mesh() -> ([Vec3; 4], [Vec3; 4], [[u32; 3]; 4]) {
    let positions = [
        Vec3::new(0.1, -1234.567, 1.0 / 3.0),
        Vec3::new(16_777_216.0, 1e-7, -0.3),
        Vec3::new(0.0, 98.765_43, 5e-39),
        Vec3::new(-7.7, 1.000_000_1, 3.4e38),
    ];
    let normals = [[1, 0, 0], [0, 0, -1], [3, 4, 0], [1, 1, 1]].map(|n: [i32; 3]| {
        let normal = Vec3::from_array(n.map(|x| x as f32));
        normal / normal.length()
    });
    (
        positions,
        normals,
        [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]],
    )
}

/// Titles that are not meant well, or just are not English.
pub(super) const TITLES: [&str; 16] = [
    "",
    "A hand",
    "solid",
    "solid\nfacet normal 0 0 1",
    "a\r\nend_header\nelement vertex 3\nv 1 2 3",
    "\u{2028}f 1 2 3\u{85}f 1 2 3\u{0}\u{7}\u{1b}[31m",
    "SPACE=LPS SPACE=LPS",
    "S\u{200b}PACE=LPS, COLOR=abcd",
    "ends in \\",
    "ends in \\\\ \\",
    "Schädel, 頭蓋骨, 🦴, \u{202e}desrever",
    "\u{feff}# begins with a mark",
    "\"}], \"asset\": {\"version\": \"3.0\"",
    "TextureFile a.png",
    "   \t\n ",
    "endsolid",
];

pub(super) fn export<'a>(
    (positions_mm, normals, triangles): &'a ([Vec3; 4], [Vec3; 4], [[u32; 3]; 4]),
    title: &'a str,
) -> Export<'a> {
    Export {
        positions_mm,
        normals,
        triangles,
        title,
    }
}

pub(super) fn long_title() -> String {
    "頭\\".repeat(100_000)
}

/// The numbers of a line behind its first `skip` words.
pub(super) fn numbers(line: &str, skip: usize) -> Vec<f32> {
    let words = line.split_whitespace().skip(skip);
    words.map(|word| word.parse().expect("a number")).collect()
}

/// The 32-bit floats that lie at a place.
pub(super) fn floats<const N: usize>(bytes: &[u8], at: usize) -> [f32; N] {
    std::array::from_fn(|i| f32::from_bits(word(bytes, at + 4 * i)))
}

pub(super) fn word(bytes: &[u8], at: usize) -> u32 {
    u32::from_le_bytes(bytes[at..at + 4].try_into().expect("four bytes"))
}
