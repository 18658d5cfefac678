use std::cell::RefCell;
use std::rc::Rc;

use glam::{DVec3, UVec3};
use sha2::{Digest as _, Sha256};

use super::files::open;
use super::geometry;
use super::place::{self, Encoding, Place, Skip, Source};
use super::stream::{Packing, SharedHash};
use super::voxels::Layout;
use super::{ElementType, FileSet, Format, LoadError, LoadReport, ReadOptions, Warning};
use crate::data::SubjectSink;
use crate::document::RawVoxels;

/// The layout of a file of bare voxels, which the file itself does not hold.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RawLayout {
    /// Voxels along each axis, x fastest.
    pub dims: UVec3,
    /// Type of a voxel.
    pub element: ElementType,
    /// True if the high byte comes first.
    pub big_endian: bool,
    /// Size of a voxel, mm.
    pub spacing_mm: DVec3,
    /// Bytes before the voxels, unpacked.
    pub header_bytes: u64,
}

impl RawLayout {
    /// A guess to begin with, from a name like `stent_128x128x256_int16le.raw.gz` and the number of bytes. Without
    /// sizes in the name, a cube if the bytes make one; `None` if nothing fits.
    pub fn guess(name: &str, byte_len: Option<u64>) -> Option<Self> {
        let name = name.to_lowercase();
        let is_packed = name.ends_with(".gz");
        let len = byte_len.filter(|_| !is_packed);
        let dims = dims_in_name(&name);
        let (element, big_endian) = element_in_name(&name);
        let element = element.or_else(|| {
            // The size of one voxel tells the commonest type of that size.
            let voxels = dims.map_or_else(
                || {
                    let side =
                        |bytes: u64| ((len.unwrap_or(0) / bytes) as f64).cbrt().round() as u64;
                    [1, 2, 4]
                        .into_iter()
                        .find(|&bytes| {
                            side(bytes) > 0 && side(bytes).pow(3) * bytes == len.unwrap_or(0)
                        })
                        .map(|bytes| side(bytes).pow(3))
                },
                |dims| Some(dims.as_u64vec3().element_product()),
            )?;
            match len?.checked_div(voxels)? {
                1 => Some(ElementType::U8),
                2 => Some(ElementType::I16),
                4 => Some(ElementType::F32),
                8 => Some(ElementType::F64),
                _ => None,
            }
        });
        let element = element.unwrap_or(ElementType::U8);
        let size = element.byte_count() as u64;
        let dims = dims.or_else(|| {
            let voxels = len? / size;
            let side = (voxels as f64).cbrt().round() as u32;
            (side > 0 && u64::from(side).pow(3) == voxels).then_some(UVec3::splat(side))
        })?;
        let needed = dims.as_u64vec3().element_product() * size;
        Some(Self {
            dims,
            element,
            big_endian,
            spacing_mm: DVec3::ONE,
            header_bytes: len.map_or(0, |len| len.saturating_sub(needed)),
        })
    }
}

impl From<&RawVoxels> for RawLayout {
    fn from(raw: &RawVoxels) -> Self {
        let element = ElementType::from_name(raw.element);
        Self {
            dims: UVec3::from(raw.size),
            element: element.unwrap_or(ElementType::U8),
            big_endian: raw.big_endian,
            spacing_mm: DVec3::from(raw.spacing_mm),
            header_bytes: raw.skip_bytes,
        }
    }
}

impl From<&RawLayout> for RawVoxels {
    fn from(raw: &RawLayout) -> Self {
        Self {
            size: raw.dims.to_array(),
            element: raw.element.name(),
            big_endian: raw.big_endian,
            spacing_mm: raw.spacing_mm.to_array(),
            skip_bytes: raw.header_bytes,
        }
    }
}

/// Three numbers parted by `x`, as in 128x128x256.
fn dims_in_name(name: &str) -> Option<UVec3> {
    let words = name.split(|c: char| !c.is_ascii_digit() && c != 'x');
    words
        .filter_map(|word| {
            let numbers: Vec<u32> = word.split('x').filter_map(|n| n.parse().ok()).collect();
            let &[x, y, z] = numbers.as_slice() else {
                return None;
            };
            let dims = UVec3::new(x, y, z);
            (dims.min_element() > 0 && dims.max_element() <= 1 << 16).then_some(dims)
        })
        .next()
}

fn element_in_name(name: &str) -> (Option<ElementType>, bool) {
    const WORDS: [(&str, ElementType); 16] = [
        ("uint8", ElementType::U8),
        ("uint16", ElementType::U16),
        ("uint32", ElementType::U32),
        ("int8", ElementType::I8),
        ("int16", ElementType::I16),
        ("int32", ElementType::I32),
        ("ushort", ElementType::U16),
        ("uchar", ElementType::U8),
        ("float32", ElementType::F32),
        ("float64", ElementType::F64),
        ("double", ElementType::F64),
        ("float", ElementType::F32),
        ("short", ElementType::I16),
        ("_u8", ElementType::U8),
        ("_u16", ElementType::U16),
        ("_i16", ElementType::I16),
    ];
    let found = WORDS.iter().find(|(word, _)| name.contains(word));
    let after = found
        .and_then(|(word, _)| name.split(word).nth(1))
        .unwrap_or_default();
    (
        found.map(|&(_, element)| element),
        after.starts_with("be") || after.starts_with("_be"),
    )
}

/// Reads bare voxels in the layout that the user gave. gzip is unpacked without being asked for.
///
/// # Errors
/// As [`super::read_volume`].
pub fn read_raw(
    files: &mut dyn FileSet,
    name: &str,
    raw: &RawLayout,
    options: &ReadOptions,
    sink: &mut dyn SubjectSink,
    report: &mut LoadReport,
) -> Result<(), LoadError> {
    report.format = Some(Format::Raw);
    let dims = geometry::checked_dims(name, raw.dims.as_u64vec3().to_array(), options)?;
    let layout = Layout {
        element: raw.element,
        big_endian: raw.big_endian,
        dims,
        components: 1,
        component: 0,
        is_color: false,
    };
    let mut world_from_voxel = geometry::unoriented(raw.spacing_mm);
    if !geometry::is_usable(&world_from_voxel) {
        report.warn(Warning::BadSpacing {
            axis: 0,
            found: raw.spacing_mm.x as f32,
            instead: 1.0,
        });
        world_from_voxel = geometry::unoriented(DVec3::ONE);
    }
    report.warn(Warning::NoOrientation);
    report.stored_type = raw.element.name();
    report.dims = dims;
    report.frame_count = 1;
    let header = place::Header {
        volume: geometry::header(
            name,
            &layout,
            world_from_voxel,
            1.0,
            0.0,
            report.tells_size(),
        )?,
        place: Place {
            layout,
            encoding: Encoding::Raw,
            line_skip: 0,
            skip: Skip::Bytes(raw.header_bytes),
            frame_count: 1,
            frame: 0,
            is_exact: false,
        },
        files: None,
    };
    let hash: SharedHash = Rc::new(RefCell::new(Sha256::new()));
    let mut stream = open(files, name, name, Some(&hash))?;
    if stream.peek(2)? == [0x1f, 0x8b] {
        stream.unpack(Packing::Gzip);
    }
    place::read(Source::Attached(stream), &header, sink, report)?;
    let digest = hash.borrow().clone().finalize();
    report.sha256 = Some(digest.into());
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_sizes_are_guessed() {
        let stent =
            RawLayout::guess("stent_128x128x256_int16le.raw.gz", Some(1000)).expect("in the name");
        assert_eq!(
            (stent.dims, stent.element, stent.big_endian),
            (UVec3::new(128, 128, 256), ElementType::I16, false)
        );
        let named =
            RawLayout::guess("a-10x20x30-uint16be.raw", Some(12_000 + 100)).expect("in the name");
        assert_eq!(
            (named.element, named.big_endian, named.header_bytes),
            (ElementType::U16, true, 100)
        );
        let cube = RawLayout::guess("bonsai.raw", Some(256 * 256 * 256)).expect("a cube");
        assert_eq!(
            (cube.dims, cube.element),
            (UVec3::splat(256), ElementType::U8)
        );
        let wide = RawLayout::guess("x.raw", Some(2 * 64 * 64 * 64))
            .expect("a cube of 16 bits, or not a cube of bytes");
        assert_eq!(
            (wide.dims, wide.element),
            (UVec3::splat(64), ElementType::I16)
        );
        assert_eq!(RawLayout::guess("x.raw", Some(12_345)), None);
        assert_eq!(RawLayout::guess("0x0x0.raw", None), None);
        assert_eq!(RawLayout::guess("99999x99999x99999.raw", None), None);
    }
}
