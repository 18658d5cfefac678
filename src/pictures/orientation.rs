//! Which way up a camera held a picture: the orientation of Exif. Textures of meshes are taken as they are stored;
//! figures follow it.

use super::picture::Picture;

/// The tag of the orientation (Exif 2.3, table 4).
const ORIENTATION: u16 = 0x0112;
/// Entries of a directory that are looked at.
const MAX_ENTRIES: usize = 512;

/// The orientation that the file of a JPEG gives, 1 to 8; 1, as stored, where it gives none.
pub fn orientation(file: &[u8]) -> u8 {
    exif(file).and_then(of_tiff).unwrap_or(1)
}

/// The Exif of a JPEG, from its TIFF header on.
fn exif(file: &[u8]) -> Option<&[u8]> {
    let mut rest = file.strip_prefix(b"\xff\xd8")?;
    loop {
        let (head, after) = rest.split_at_checked(4)?;
        let length = usize::from(u16::from_be_bytes([head[2], head[3]]));
        let (marker, body) = (head[1], after.get(..length.checked_sub(2)?)?);
        // Behind the first scan no segment counts.
        if head[0] != 0xff || marker == 0xda {
            return None;
        }
        if let Some(tiff) = body.strip_prefix(b"Exif\0\0").filter(|_| marker == 0xe1) {
            return Some(tiff);
        }
        rest = after.get(body.len()..)?;
    }
}

/// The orientation in the first directory of a TIFF header.
fn of_tiff(tiff: &[u8]) -> Option<u8> {
    let is_little = match tiff.get(..2)? {
        b"II" => true,
        b"MM" => false,
        _ => return None,
    };
    let short = |at: usize| {
        let bytes: [u8; 2] = tiff.get(at..at.checked_add(2)?)?.try_into().ok()?;
        Some(match is_little {
            true => u16::from_le_bytes(bytes),
            false => u16::from_be_bytes(bytes),
        })
    };
    let bytes: [u8; 4] = tiff.get(4..8)?.try_into().ok()?;
    let first = match is_little {
        true => u32::from_le_bytes(bytes),
        false => u32::from_be_bytes(bytes),
    } as usize;
    let entries = usize::from(short(first)?).min(MAX_ENTRIES);
    let entry = |i: usize| first.checked_add(2 + 12 * i);
    let found = (0..entries)
        .filter_map(entry)
        .find(|at| short(*at) == Some(ORIENTATION))?;
    let value = short(found.checked_add(8)?)?;
    u8::try_from(value)
        .ok()
        .filter(|value| (1..=8).contains(value))
}

/// The picture as it is seen that is stored in this orientation (1 to 8, as [`orientation`] gives it).
pub fn upright(picture: Picture, orientation: u8) -> Picture {
    let [width, height] = picture.size;
    // Exif tells where the stored first row and column are seen. From 5 on rows are seen as columns.
    let (is_turned, flips_x, flips_y) = match orientation {
        2 => (false, true, false),
        3 => (false, true, true),
        4 => (false, false, true),
        5 => (true, false, false),
        6 => (true, false, true),
        7 => (true, true, true),
        8 => (true, true, false),
        _ => return picture,
    };
    let size = match is_turned {
        true => [height, width],
        false => [width, height],
    };
    let stored = |(column, row): (u32, u32)| {
        let (x, y) = if is_turned {
            (row, column)
        } else {
            (column, row)
        };
        let x = if flips_x { width - 1 - x } else { x };
        let y = if flips_y { height - 1 - y } else { y };
        picture.pixels[y as usize * width as usize + x as usize]
    };
    let places = (0..size[1]).flat_map(|row| (0..size[0]).map(move |column| (column, row)));
    let pixels = places.map(stored).collect();
    Picture {
        size,
        pixels,
        is_of_inks: picture.is_of_inks,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The head of a JPEG with this orientation.
    fn head(orientation: u16, is_little: bool) -> Vec<u8> {
        let short = |value: u16| match is_little {
            true => value.to_le_bytes(),
            false => value.to_be_bytes(),
        };
        let long = |value: u32| match is_little {
            true => value.to_le_bytes(),
            false => value.to_be_bytes(),
        };
        let mut tiff = if is_little {
            b"II".to_vec()
        } else {
            b"MM".to_vec()
        };
        tiff.extend(short(42));
        tiff.extend(long(8));
        tiff.extend(short(2));
        for (tag, value) in [(0x010f, 7), (ORIENTATION, orientation)] {
            tiff.extend(short(tag));
            tiff.extend(short(3));
            tiff.extend(long(1));
            tiff.extend(short(value));
            tiff.extend([0; 2]);
        }
        let mut file = b"\xff\xd8\xff\xe0\0\x04ab\xff\xe1".to_vec();
        file.extend((2 + 6 + tiff.len() as u16).to_be_bytes());
        file.extend(b"Exif\0\0");
        file.extend(tiff);
        file.extend(b"\xff\xda\0\x02");
        file
    }

    #[test]
    fn orientations_are_read_or_none() {
        for is_little in [true, false] {
            for value in 1..=8 {
                assert_eq!(orientation(&head(value, is_little)), value as u8);
            }
            assert_eq!(orientation(&head(0, is_little)), 1, "none");
            assert_eq!(orientation(&head(9, is_little)), 1, "none");
        }
        let whole = head(6, true);
        for length in 0..whole.len() {
            let found = orientation(&whole[..length]);
            assert!(
                found == 1 || found == 6,
                "cut after {length} bytes: {found}"
            );
        }
        assert_eq!(orientation(b"\x89PNG\r\n\x1a\n"), 1);
    }

    /// The letter F, stored so that each orientation shows it upright (the figure that Exif readers are tried with).
    #[test]
    fn pictures_are_turned_upright() {
        let shown = ["##", "#.", "##", "#.", "#."];
        let stored: [&[&str]; 8] = [
            &["##", "#.", "##", "#.", "#."],
            &["##", ".#", "##", ".#", ".#"],
            &[".#", ".#", "##", ".#", "##"],
            &["#.", "#.", "##", "#.", "##"],
            &["#####", "#.#.."],
            &["#.#..", "#####"],
            &["..#.#", "#####"],
            &["#####", "..#.#"],
        ];
        let picture = |rows: &[&str]| Picture {
            size: [rows[0].len() as u32, rows.len() as u32],
            pixels: rows
                .iter()
                .flat_map(|row| row.bytes().map(|byte| [byte; 4]))
                .collect(),
            is_of_inks: false,
        };
        for (rows, orientation) in stored.iter().zip(1..) {
            assert_eq!(
                upright(picture(rows), orientation),
                picture(&shown),
                "orientation {orientation}"
            );
        }
    }
}
