//! Material libraries of OBJ: colour, opacity and picture.

use std::collections::BTreeMap;

use glam::Vec3;

use super::input::{Input, Lines, Progress};
use super::report::Aside;
use crate::data::{MeshMaterial, Wrap};
use crate::load::FileSet;
use crate::load::files::open;
use crate::math::linear_from_srgb;
use crate::pictures::MAX_FILE_BYTES;

use super::draft::Draft;
use super::error::MeshError;

/// Materials in the libraries of a file that are looked at, and bytes of a library.
const MAX_MATERIALS: usize = 65_536;
const MAX_LIBRARY_BYTES: u64 = 16 << 20;

/// One entry of a library.
#[derive(Clone, Debug, Default)]
struct Entry {
    color_srgb: Option<[f32; 3]>,
    opacity: Option<f32>,
    picture: Option<String>,
}

/// The last part of a path as a header writes it, for either kind of slash: nothing else is ever opened.
pub(super) fn last_part(path: &str) -> &str {
    path.rsplit(['/', '\\']).next().unwrap_or(path).trim()
}

/// Linear light of an sRGB colour, 0 to 1; what is outside counts as the nearest end.
pub(super) fn linear(color_srgb: [f32; 3]) -> Vec3 {
    // Through bytes where the value is one, so that 255ths are the same everywhere.
    Vec3::from_array(color_srgb.map(|value| {
        let scaled = value.clamp(0.0, 1.0) * 255.0;
        let (low, part) = (scaled.floor(), scaled.fract());
        let at = |byte: f32| linear_from_srgb(byte.min(255.0) as u8);
        at(low) + (at(low + 1.0) - at(low)) * part
    }))
}

/// Gives the draft's materials, which are named by `names`, what the libraries say of them. A library or picture that
/// is not there is left aside.
///
/// # Errors
/// Cancellation only.
pub(super) fn read(
    files: &mut dyn FileSet,
    asked_by: &str,
    libraries: &[String],
    names: &BTreeMap<String, u32>,
    draft: &mut Draft,
    progress: &mut Progress<'_>,
) -> Result<(), MeshError> {
    let mut entries = BTreeMap::new();
    for library in libraries {
        match read_library(files, asked_by, last_part(library), &mut entries, progress) {
            Ok(()) => {}
            Err(error @ MeshError::File(crate::load::LoadError::Cancelled)) => return Err(error),
            Err(_unreadable) => draft.leave(Aside::NoLibrary),
        }
    }
    let mut pictures: BTreeMap<String, Option<u32>> = BTreeMap::new();
    for (name, &index) in names {
        let Some(entry) = entries.get(name) else {
            continue;
        };
        let picture = entry
            .picture
            .as_deref()
            .map(last_part)
            .filter(|name| !name.is_empty());
        let texture = picture.and_then(|name| {
            *pictures.entry(name.to_owned()).or_insert_with(|| {
                match read_picture(files, name, draft) {
                    Ok(packed) => draft.add_texture(packed, [Wrap::Repeat; 2]),
                    Err(why) => {
                        draft.leave(why);
                        None
                    }
                }
            })
        });
        let Some(material) = draft.materials.get_mut(index as usize) else {
            continue;
        };
        *material = MeshMaterial {
            color: entry.color_srgb.map_or(Vec3::ONE, linear),
            has_color: entry.color_srgb.is_some(),
            // Exporters that mean “opaque” write 0.
            opacity: entry
                .opacity
                .filter(|d| *d > 0.0)
                .map_or(1.0, |d| d.min(1.0)),
            texture,
        };
    }
    Ok(())
}

fn read_library(
    files: &mut dyn FileSet,
    asked_by: &str,
    name: &str,
    entries: &mut BTreeMap<String, Entry>,
    progress: &mut Progress<'_>,
) -> Result<(), MeshError> {
    let mut input = Input::new(open(files, name, asked_by, None)?, progress);
    let mut lines = Lines::new(&mut input, 0);
    let mut entry: Option<&mut Entry> = None;
    let (mut bytes, mut count) = (0, 0);
    while lines.advance(true)? {
        let text = lines.text();
        bytes += text.len() as u64;
        if bytes > MAX_LIBRARY_BYTES || count > MAX_MATERIALS {
            break;
        }
        let mut words = text.split_whitespace();
        let Some(keyword) = words.next() else {
            continue;
        };
        if keyword == "newmtl" {
            let rest = text.trim_start().get(keyword.len()..).unwrap_or_default();
            count += 1;
            entry = Some(entries.entry(rest.trim().to_owned()).or_default());
            continue;
        }
        let Some(entry) = &mut entry else { continue };
        let mut numbers = words
            .clone()
            .map(|word| word.parse::<f32>().ok().filter(|x| x.is_finite()));
        match keyword {
            "Kd" => {
                let mut next = || numbers.next().flatten();
                if let Some(red) = next() {
                    // One number stands for all three.
                    let (green, blue) = (next().unwrap_or(red), next().unwrap_or(red));
                    entry.color_srgb = Some([red, green, blue]);
                }
            }
            "d" => entry.opacity = numbers.next_back().flatten(),
            "map_Kd" => entry.picture = Some(picture_name(words)),
            _ => {}
        }
    }
    Ok(())
}

/// The file's name after the options of a `map_Kd`, which begin with a dash and take numbers or words. Names with
/// spaces are kept whole.
pub(super) fn picture_name<'a>(words: impl Iterator<Item = &'a str>) -> String {
    let words: Vec<&str> = words.collect();
    let mut rest = &words[..];
    while let [option, after @ ..] = rest {
        let arguments = match *option {
            "-o" | "-s" | "-t" => after
                .iter()
                .take(3)
                .take_while(|w| w.parse::<f32>().is_ok())
                .count(),
            "-mm" => 2,
            "-blendu" | "-blendv" | "-boost" | "-texres" | "-clamp" | "-bm" | "-imfchan"
            | "-type" | "-cc" => 1,
            _ => break,
        };
        rest = after.get(arguments..).unwrap_or_default();
    }
    rest.join(" ")
}

/// The bytes of a picture beside the file.
fn read_picture(files: &mut dyn FileSet, name: &str, draft: &Draft) -> Result<Vec<u8>, Aside> {
    let handle = files.open(name).map_err(|_unreadable| Aside::NoPicture)?;
    let mut bytes = Vec::new();
    let mut read = std::io::Read::take(handle.read, MAX_FILE_BYTES + 1);
    std::io::Read::read_to_end(&mut read, &mut bytes).map_err(|_unreadable| Aside::NoPicture)?;
    draft.has_room_for_picture(bytes.len() as u64)?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_last_part_of_a_path_is_looked_for() {
        assert_eq!(last_part("C:\\Users\\Jane Doe\\skin.mtl"), "skin.mtl");
        assert_eq!(last_part("../../etc/passwd"), "passwd");
        assert_eq!(last_part("skin.mtl"), "skin.mtl");
    }

    #[test]
    fn options_stand_before_the_name_of_a_picture() {
        let name = |text: &str| picture_name(text.split_whitespace());
        assert_eq!(name("skin of a hand.png"), "skin of a hand.png");
        assert_eq!(name("-s 2 2 1 -clamp on -o 0.5 skin.png"), "skin.png");
        assert_eq!(name("-mm 0 1"), "");
    }

    #[test]
    fn colours_are_linear() {
        assert_eq!(linear([0.0, 1.0, 2.0]), Vec3::new(0.0, 1.0, 1.0));
        let half = linear([128.0 / 255.0, 0.5, 0.0]);
        assert!((half.x - linear_from_srgb(128)).abs() < 1e-6);
        assert!((half.y - 0.214_04).abs() < 1e-4, "{half}");
    }
}
