//! Accessors of a GLB: numbers of any type, interleaved or not, also sparse ones.

use std::ops::Range;

use serde_json::Value;

use super::error::MeshError;
use super::glb_json::{Gltf, index};

/// Type of the components of an accessor, by its number in glTF.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Component {
    I8,
    U8,
    I16,
    U16,
    U32,
    F32,
}

impl Component {
    fn numbered(number: usize) -> Option<Self> {
        Some(match number {
            5120 => Self::I8,
            5121 => Self::U8,
            5122 => Self::I16,
            5123 => Self::U16,
            5125 => Self::U32,
            5126 => Self::F32,
            _ => return None,
        })
    }

    fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::U32 | Self::F32 => 4,
        }
    }

    /// The number in the first bytes. Of a normalised one whole numbers stand for −1 to 1, or 0 to 1.
    fn decode(self, bytes: &[u8], is_normalized: bool) -> f64 {
        fn first<const N: usize>(bytes: &[u8]) -> [u8; N] {
            let mut part = [0; N];
            part.copy_from_slice(&bytes[..N]);
            part
        }
        let (value, one) = match self {
            Self::I8 => (f64::from(i8::from_le_bytes(first(bytes))), 127.0),
            Self::U8 => (f64::from(bytes[0]), 255.0),
            Self::I16 => (f64::from(i16::from_le_bytes(first(bytes))), 32_767.0),
            Self::U16 => (f64::from(u16::from_le_bytes(first(bytes))), 65_535.0),
            Self::U32 => (
                f64::from(u32::from_le_bytes(first(bytes))),
                f64::from(u32::MAX),
            ),
            Self::F32 => return f64::from(f32::from_le_bytes(first(bytes))),
        };
        match is_normalized {
            true => (value / one).max(-1.0),
            false => value,
        }
    }
}

/// Where numbers lie in the block of bytes.
struct Layout {
    /// The first byte, of the first element.
    start: usize,
    /// Bytes from one element to the next.
    stride: usize,
}

/// Reads an accessor of `N` components of any type; how many elements there are is in the result.
///
/// # Errors
/// [`MeshError::Content`] if it reaches beyond its buffer, or is of another kind.
pub(super) fn read<const N: usize>(gltf: &Gltf, number: usize) -> Result<Vec<[f64; N]>, MeshError> {
    let accessor = gltf.item("accessors", number)?;
    let wrong = |what: &str| gltf.wrong(format!("accessor {number} {what}"));
    let kind = accessor
        .get("type")
        .and_then(Value::as_str)
        .unwrap_or_default();
    let kinds: &[&str] = match N {
        1 => &["SCALAR"],
        2 => &["VEC2"],
        3 => &["VEC3"],
        _ => &["VEC4"],
    };
    if !kinds.contains(&kind) {
        return Err(wrong(&format!(
            "should be of the type {}",
            kinds.join(" or ")
        )));
    }
    let component = index(accessor, "componentType").and_then(Component::numbered);
    let component =
        component.ok_or_else(|| wrong("has a type of numbers that glTF does not know"))?;
    let is_normalized = accessor
        .get("normalized")
        .and_then(Value::as_bool)
        .unwrap_or(false);
    let count = index(accessor, "count").ok_or_else(|| wrong("has no count"))?;
    if count as u64 > gltf.most_elements {
        return Err(wrong(&format!(
            "has {count} elements: {} are the most",
            gltf.most_elements
        )));
    }
    let size = component.size() * N;
    let element = |bytes: &[u8]| -> [f64; N] {
        std::array::from_fn(|i| component.decode(&bytes[i * component.size()..], is_normalized))
    };
    let mut values: Vec<[f64; N]> = match accessor.get("bufferView") {
        Some(_) => {
            let layout = layout(gltf, accessor, number, size, count)?;
            let starts = (0..count).map(|i| layout.start + i * layout.stride);
            starts
                .map(|start| element(&gltf.bytes[start..start + size]))
                .collect()
        }
        // Zeros, of which no byte says how many there are: as many as there are bytes is more than is of use.
        None if count > gltf.bytes.len() => {
            return Err(wrong("has more elements than the file has bytes"));
        }
        None => vec![[0.0; N]; count],
    };
    if let Some(sparse) = accessor.get("sparse") {
        let changed =
            index(sparse, "count").ok_or_else(|| wrong("has a sparse part without a count"))?;
        let (Some(indices), Some(replaced)) = (sparse.get("indices"), sparse.get("values")) else {
            return Err(wrong("has a sparse part without indices or values"));
        };
        let kind = index(indices, "componentType").and_then(Component::numbered);
        let Some(kind @ (Component::U8 | Component::U16 | Component::U32)) = kind else {
            return Err(wrong("has sparse indices that are no whole numbers"));
        };
        let at = layout(gltf, indices, number, kind.size(), changed)?;
        let from = layout(gltf, replaced, number, size, changed)?;
        for i in 0..changed {
            let start = at.start + i * at.stride;
            let index = kind.decode(&gltf.bytes[start..start + kind.size()], false) as usize;
            let start = from.start + i * from.stride;
            let value = values
                .get_mut(index)
                .ok_or_else(|| wrong("has a sparse index out of range"))?;
            *value = element(&gltf.bytes[start..start + size]);
        }
    }
    Ok(values)
}

/// Number of components of an accessor: 3 for `VEC3`.
pub(super) fn component_count(gltf: &Gltf, number: usize) -> Result<usize, MeshError> {
    let kind = gltf
        .item("accessors", number)?
        .get("type")
        .and_then(Value::as_str);
    Ok(match kind {
        Some("SCALAR") => 1,
        Some("VEC2") => 2,
        Some("VEC3") => 3,
        Some("VEC4") => 4,
        _ => 0,
    })
}

/// Bytes of a buffer view.
///
/// # Errors
/// [`MeshError::Content`] if it reaches beyond the block, or lies in another file.
pub(super) fn view(gltf: &Gltf, number: usize) -> Result<Range<usize>, MeshError> {
    let view = gltf.item("bufferViews", number)?;
    let buffer_number = index(view, "buffer").unwrap_or(0);
    let buffer = gltf.item("buffers", buffer_number)?;
    if buffer_number != 0 || buffer.get("uri").is_some() {
        return Err(gltf.wrong(format!(
            "buffer {buffer_number} is not in the file: save as one .glb with everything in it"
        )));
    }
    let start = index(view, "byteOffset").unwrap_or(0);
    let len = index(view, "byteLength").unwrap_or(0);
    let end = start
        .checked_add(len)
        .filter(|&end| end <= gltf.bytes.len());
    let end = end.ok_or_else(|| {
        gltf.wrong(format!(
            "bufferView {number} reaches beyond its buffer of {} bytes",
            gltf.bytes.len()
        ))
    })?;
    Ok(start..end)
}

/// Where the elements lie that an accessor, or a part of one, names: all of them inside their view.
fn layout(
    gltf: &Gltf,
    of: &Value,
    accessor: usize,
    size: usize,
    count: usize,
) -> Result<Layout, MeshError> {
    let beyond = || gltf.wrong(format!("accessor {accessor} reaches beyond its buffer"));
    let number = index(of, "bufferView").ok_or_else(beyond)?;
    let bytes = view(gltf, number)?;
    let stride = index(gltf.item("bufferViews", number)?, "byteStride");
    let stride = stride.filter(|stride| *stride >= size).unwrap_or(size);
    let offset = index(of, "byteOffset").unwrap_or(0);
    let last = count.saturating_sub(1).checked_mul(stride);
    let end = last.and_then(|last| {
        last.checked_add(offset)?
            .checked_add(if count > 0 { size } else { 0 })
    });
    match end {
        Some(end) if end <= bytes.len() => Ok(Layout {
            start: bytes.start + offset,
            stride,
        }),
        _ => Err(beyond()),
    }
}
