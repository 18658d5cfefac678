//! Counting the pieces of a picture, as `cargo xtask islands` does.

use crate::pieces::{SEEN_ALPHA, islands, pieces};

/// A picture out of rows of text: `#` is drawn, `+` is just seen, `-` is just not seen.
fn picture(rows: &[&str]) -> (u32, Vec<u8>) {
    let alpha = |c| match c {
        '#' => 255,
        '+' => SEEN_ALPHA + 1,
        '-' => SEEN_ALPHA,
        _ => 0,
    };
    let rgba = rows.iter().flat_map(|row| row.chars());
    let rgba = rgba.flat_map(|c| [9, 9, 9, alpha(c)]).collect();
    (rows[0].len() as u32, rgba)
}

#[test]
fn pieces_hang_together_by_sides_and_corners() {
    let (width, rgba) = picture(&[
        "##......#", //
        "##.....#.", //
        "..#......", //
        "....+++..", //
        "-..------", //
        "#.#....#.", //
    ]);
    let found = pieces(width, &rgba);
    let sizes: Vec<usize> = found.iter().map(Vec::len).collect();
    assert_eq!(sizes, [5, 3, 2, 1, 1, 1]);
    let mut second = found[1].clone();
    second.sort_unstable();
    assert_eq!(second, [(4, 3), (5, 3), (6, 3)]);
    // Fewer than three pixels, and never the object itself.
    let small = islands(found, 3);
    assert_eq!(small.iter().map(Vec::len).collect::<Vec<_>>(), [2, 1, 1, 1]);
    // The ends of rows do not hang together.
    let (width, rgba) = picture(&["..#", "...", "#.."]);
    assert_eq!(pieces(width, &rgba).len(), 2);
}

#[test]
fn an_object_alone_has_no_islands() {
    let (width, rgba) = picture(&["....", ".#..", "...."]);
    assert!(islands(pieces(width, &rgba), 40).is_empty());
    let (width, rgba) = picture(&["...."]);
    assert!(islands(pieces(width, &rgba), 40).is_empty());
    assert!(pieces(0, &[]).is_empty());
}
