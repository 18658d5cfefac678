//! Pieces of a subject in messages: a word for the kind of the piece, and what it holds. A new piece is one more arm in
//! each of the two functions here; what is heavy in it travels as a typed array, which is moved and not copied.

use std::sync::Arc;

use glam::{DVec2, UVec3, Vec2};
use js_sys::{
    Array, ArrayBuffer, Float32Array, Float64Array, Int16Array, Uint8Array, Uint16Array,
    Uint32Array,
};
use serde_json::{Value, json as value};
use wasm_bindgen::prelude::*;

use super::header::{json_of, volume_of};
use crate::data::{
    DistanceGrid, Plate, PlateOrigin, PlateShape, PlateWord, SheetMesh, SubjectPart, Surface,
    SurfaceArrays, Voxels,
};
use crate::pictures::Picture;

/// The word of a piece, and what it holds.
///
/// # Errors
/// For a surface, whose arrays travel one by one: see [`packed_surface`].
pub fn packed(part: SubjectPart) -> Result<(&'static str, JsValue), JsValue> {
    Ok(match part {
        SubjectPart::Volume(header) => ("begin", json_of(&header).to_string().into()),
        SubjectPart::Scalars(voxels) => ("scalars", array_of(&voxels)),
        SubjectPart::Labels(labels) => ("labels", Uint8Array::from(labels.as_slice()).into()),
        SubjectPart::Plate(plate) => ("plate", packed_plate(&plate)),
        SubjectPart::Surface(_) => return Err("a surface travels in arrays".into()),
    })
}

/// A piece from [`packed`]; none if there is no such word, or if it goes with other contents.
pub fn unpacked(word: &str, held: &JsValue) -> Option<SubjectPart> {
    Some(match word {
        "begin" => SubjectPart::header(volume_of(&json(held)?)?),
        "scalars" => SubjectPart::Scalars(voxels_of(held)?),
        "labels" => SubjectPart::Labels(held.dyn_ref::<Uint8Array>()?.to_vec()),
        "plate" => SubjectPart::Plate(Arc::new(unpacked_plate(held)?)),
        _ => return None,
    })
}

/// A plate: width and height of its source, those of its picture, the pixels, and the bytes or the name of its drawing.
pub fn packed_plate(plate: &Plate) -> JsValue {
    let [width, height] = plate.picture.size;
    let numbers = [
        plate.size.x,
        plate.size.y,
        f64::from(width),
        f64::from(height),
    ];
    let origin = match &plate.origin {
        PlateOrigin::Pixels => JsValue::UNDEFINED,
        PlateOrigin::Drawing(bytes) => Uint8Array::from(&**bytes).into(),
        PlateOrigin::Builtin(name) => name.into(),
    };
    let pixels = Uint8Array::from(plate.picture.pixels.as_flattened());
    let numbers = Float64Array::from(numbers.as_slice());
    let words = plate
        .words
        .iter()
        .map(|word| value!([word.text, word.at.x, word.at.y]));
    let words = Value::from_iter(words).to_string().into();
    Array::of5(
        &numbers,
        &pixels,
        &origin,
        &packed_shapes(&plate.shapes),
        &words,
    )
    .into()
}

/// The shapes of a drawing: their paths and rules and how many points each line has, then all points.
fn packed_shapes(shapes: &[PlateShape]) -> JsValue {
    let heads: Vec<Value> = (shapes.iter())
        .map(|shape| {
            let counts: Vec<usize> = shape.lines.iter().map(Vec::len).collect();
            value!([shape.path, shape.is_even_odd, counts])
        })
        .collect();
    let all = shapes.iter().flat_map(|shape| shape.lines.iter().flatten());
    let points: Vec<Vec2> = all.copied().collect();
    Array::of2(
        &value!(heads).to_string().into(),
        &Float32Array::from(bytemuck::cast_slice(&points)),
    )
    .into()
}

/// The shapes of a drawing from [`packed_shapes`]; `None` if it is none.
fn unpacked_shapes(held: &JsValue) -> Option<Vec<PlateShape>> {
    let held: &Array = held.dyn_ref()?;
    let heads = json(&held.get(0))?;
    let points = unpacked_places(&held.get(1))?;
    let mut points = points.as_slice();
    let shape = |head: &Value| {
        let line = |count: &Value| {
            let (line, rest) = points.split_at_checked(count.as_u64()? as usize)?;
            points = rest;
            Some(line.to_vec())
        };
        Some(PlateShape {
            path: head.get(0)?.as_str()?.to_owned(),
            is_even_odd: head.get(1)?.as_bool()?,
            lines: (head.get(2)?.as_array()?.iter())
                .map(line)
                .collect::<Option<_>>()?,
        })
    };
    heads.as_array()?.iter().map(shape).collect()
}

/// A plate from [`packed_plate`]; `None` if it is none.
pub fn unpacked_plate(held: &JsValue) -> Option<Plate> {
    let held: &Array = held.dyn_ref()?;
    let numbers = held.get(0).dyn_ref::<Float64Array>()?.to_vec();
    let [width, height, columns, rows] = numbers.try_into().ok()?;
    let pixels = held.get(1).dyn_ref::<Uint8Array>()?.to_vec();
    let origin = held.get(2);
    let origin = match (origin.as_string(), origin.dyn_ref::<Uint8Array>()) {
        (Some(name), _) => PlateOrigin::Builtin(name),
        (None, Some(bytes)) => PlateOrigin::Drawing(Arc::from(bytes.to_vec())),
        (None, None) => PlateOrigin::Pixels,
    };
    Some(Plate {
        size: DVec2::new(width, height),
        picture: Picture {
            size: [columns as u32, rows as u32],
            pixels: pixels.as_chunks().0.to_vec(),
            is_of_inks: false,
        },
        origin,
        shapes: unpacked_shapes(&held.get(3))?,
        words: json(&held.get(4))?
            .as_array()?
            .iter()
            .filter_map(word)
            .collect(),
    })
}

fn word(value: &Value) -> Option<PlateWord> {
    let number = |index: usize| Some(value.get(index)?.as_f64()? as f32);
    Some(PlateWord {
        text: value.get(0)?.as_str()?.to_owned(),
        at: Vec2::new(number(1)?, number(2)?),
    })
}

/// A picture: width, height and pixels; and the buffer of these, which may be moved.
pub fn packed_picture(picture: &Picture) -> (JsValue, ArrayBuffer) {
    let [width, height] = picture.size;
    let pixels = Uint8Array::from(picture.pixels.as_flattened());
    let packed = Array::of3(&width.into(), &height.into(), &pixels);
    (packed.into(), pixels.buffer())
}

/// The picture from [`packed_picture`]; `None` if it is none.
pub fn unpacked_picture(held: &JsValue) -> Option<Picture> {
    let held: &Array = held.dyn_ref()?;
    let side = |index: u32| held.get(index).as_f64().map(|side| side as u32);
    let size = [side(0)?, side(1)?];
    let pixels = held.get(2).dyn_ref::<Uint8Array>()?.to_vec();
    let pixels = pixels.as_chunks().0.to_vec();
    let is_whole = pixels.len() as u64 == u64::from(size[0]) * u64::from(size[1]);
    is_whole.then_some(Picture {
        size,
        pixels,
        is_of_inks: false,
    })
}

/// The triangles of a sheet: places at rest, colours, corners, regions of the triangles, and the names of those.
pub fn packed_mesh(mesh: &SheetMesh) -> JsValue {
    Array::of5(
        &Float32Array::from(bytemuck::cast_slice(&mesh.rest)),
        &Float32Array::from(mesh.colors.as_flattened()),
        &Uint32Array::from(mesh.triangles.as_flattened()),
        &Uint16Array::from(mesh.region_of.as_slice()),
        &value!(mesh.regions).to_string().into(),
    )
    .into()
}

/// The triangles of a sheet from [`packed_mesh`]; `None` if it is none.
pub fn unpacked_mesh(held: &JsValue) -> Option<SheetMesh> {
    let held: &Array = held.dyn_ref()?;
    let colors = held.get(1).dyn_ref::<Float32Array>()?.to_vec();
    let triangles = held.get(2).dyn_ref::<Uint32Array>()?.to_vec();
    let regions = json(&held.get(4))?;
    let regions = regions.as_array()?.iter();
    let regions = regions.map(|name| name.as_str().map(str::to_owned));
    Some(SheetMesh {
        rest: unpacked_places(&held.get(0))?,
        colors: colors.as_chunks().0.to_vec(),
        triangles: triangles.as_chunks().0.to_vec(),
        region_of: held.get(3).dyn_ref::<Uint16Array>()?.to_vec(),
        regions: regions.collect::<Option<_>>()?,
    })
}

/// Places of a plane, from an array of their coordinates.
pub fn unpacked_places(held: &JsValue) -> Option<Vec<Vec2>> {
    let numbers = held.dyn_ref::<Float32Array>()?.to_vec();
    let pairs = numbers.as_chunks::<2>().0.iter();
    Some(pairs.map(|pair| Vec2::from_array(*pair)).collect())
}

/// How many arrays a surface has.
pub const SURFACE_ARRAYS: usize = 19;

/// Puts an array of a surface, by its index in [`packed_surface`], to those that have come. Each comes in a message of
/// its own, so that no frame waits for all of them. `None` if it is none.
pub fn put_array(arrays: &mut SurfaceArrays, index: u32, held: &JsValue) -> Option<()> {
    let bytes = || Some(held.dyn_ref::<Uint8Array>()?.to_vec());
    let floats = || Some(held.dyn_ref::<Float32Array>()?.to_vec());
    let indices = || Some(held.dyn_ref::<Uint32Array>()?.to_vec());
    match index {
        0 => {
            let names = json(held)?;
            let names = names.as_array()?.iter();
            let names = names.map(|name| name.as_str().map(str::to_owned));
            arrays.names = names.collect::<Option<_>>()?;
        }
        1 => arrays.places = held.dyn_ref::<Float64Array>()?.to_vec(),
        2 => arrays.indices = indices()?,
        3 => arrays.nodes = indices()?,
        4 => arrays.order = indices()?,
        5 => arrays.corners = floats()?,
        6 => arrays.normals = floats()?,
        7 => arrays.colors = bytes()?,
        8 => arrays.owners = bytes()?,
        9 => arrays.depths = floats()?,
        10 => arrays.fills = bytes()?,
        11 => arrays.uvs = floats()?,
        12 => arrays.picture_of = held.dyn_ref::<Uint16Array>()?.to_vec(),
        13 => arrays.pixels = bytes()?,
        14 => arrays.carver_numbers = floats()?,
        15 => arrays.carver_levels = indices()?,
        16 => arrays.carver_texels = indices()?,
        17 => arrays.grid_sides = indices()?,
        18 => arrays.grid_values = floats()?,
        _ => return None,
    }
    Some(())
}

/// The arrays of a surface: a typed array of each.
pub fn packed_surface(surface: &Surface) -> [JsValue; SURFACE_ARRAYS] {
    let arrays = SurfaceArrays::of(surface);
    let bytes = |list: &[u8]| JsValue::from(Uint8Array::from(list));
    let floats = |list: &[f32]| JsValue::from(Float32Array::from(list));
    let indices = |list: &[u32]| JsValue::from(Uint32Array::from(list));
    [
        serde_json::json!(arrays.names).to_string().into(),
        Float64Array::from(arrays.places.as_slice()).into(),
        indices(&arrays.indices),
        indices(&arrays.nodes),
        indices(&arrays.order),
        floats(&arrays.corners),
        floats(&arrays.normals),
        bytes(&arrays.colors),
        bytes(&arrays.owners),
        floats(&arrays.depths),
        bytes(&arrays.fills),
        floats(&arrays.uvs),
        Uint16Array::from(arrays.picture_of.as_slice()).into(),
        bytes(&arrays.pixels),
        floats(&arrays.carver_numbers),
        indices(&arrays.carver_levels),
        indices(&arrays.carver_texels),
        indices(&arrays.grid_sides),
        floats(&arrays.grid_values),
    ]
}

/// Grids of tools, each an array of its key, its sides with 1 behind them if it is open, and its nodes.
pub fn packed_grids(grids: &[(String, Arc<DistanceGrid>)]) -> Array {
    let packed = grids.iter().map(|(key, grid)| {
        let [x, y, z] = grid.nodes().to_array();
        let sides = [x, y, z, grid.is_open().into()];
        let values = Float32Array::from(grid.values());
        Array::of3(&key.into(), &Uint32Array::from(&sides[..]), &values)
    });
    packed.collect()
}

/// The grids of [`packed_grids`]; those that are none are left out.
pub fn unpacked_grids(held: &JsValue) -> Vec<(String, Arc<DistanceGrid>)> {
    let grid_of = |packed: JsValue| {
        let packed: Array = packed.dyn_into().ok()?;
        let sides = packed.get(1).dyn_ref::<Uint32Array>()?.to_vec();
        let values = packed.get(2).dyn_ref::<Float32Array>()?.to_vec();
        let [x, y, z, is_open] = sides[..] else {
            return None;
        };
        let grid = DistanceGrid::from_parts(UVec3::new(x, y, z), values, is_open != 0)?;
        Some((packed.get(0).as_string()?, Arc::new(grid)))
    };
    let list = held.dyn_ref::<Array>().into_iter();
    list.flat_map(|list| list.iter())
        .filter_map(grid_of)
        .collect()
}

fn json(text: &JsValue) -> Option<Value> {
    serde_json::from_str(&text.as_string()?).ok()
}

fn array_of(voxels: &Voxels) -> JsValue {
    match voxels {
        Voxels::U8(v) => Uint8Array::from(v.as_slice()).into(),
        Voxels::I16(v) => Int16Array::from(v.as_slice()).into(),
        Voxels::U16(v) => Uint16Array::from(v.as_slice()).into(),
        Voxels::F32(v) => Float32Array::from(v.as_slice()).into(),
    }
}

fn voxels_of(array: &JsValue) -> Option<Voxels> {
    if let Some(a) = array.dyn_ref::<Uint8Array>() {
        return Some(Voxels::U8(a.to_vec()));
    }
    if let Some(a) = array.dyn_ref::<Int16Array>() {
        return Some(Voxels::I16(a.to_vec()));
    }
    if let Some(a) = array.dyn_ref::<Uint16Array>() {
        return Some(Voxels::U16(a.to_vec()));
    }
    array
        .dyn_ref::<Float32Array>()
        .map(|a| Voxels::F32(a.to_vec()))
}
