//! Volumes, segmentations and displacement fields without their samples as JSON: the heads of messages, whose samples
//! travel beside them as typed arrays.

use glam::{DAffine3, DVec3, UVec3};
use serde_json::{Value, json};

use crate::data::{Grid, Segment, Segmentation, Volume, Voxels};
use crate::load::FieldFile;

/// A grid as JSON: its `dims` and, by columns, its `world_from_voxel`.
fn json_of_grid(grid: &Grid) -> Value {
    json!({ "dims": grid.dims.to_array(), "world_from_voxel": grid.world_from_voxel.to_cols_array() })
}

/// A grid from [`json_of_grid`].
fn grid_of(value: &Value) -> Option<Grid> {
    let dims: Vec<u32> = value
        .get("dims")?
        .as_array()?
        .iter()
        .filter_map(|n| u32::try_from(n.as_u64()?).ok())
        .collect();
    let columns: Vec<f64> = value
        .get("world_from_voxel")?
        .as_array()?
        .iter()
        .filter_map(Value::as_f64)
        .collect();
    Some(Grid {
        dims: UVec3::from_array(dims.try_into().ok()?),
        world_from_voxel: DAffine3::from_cols_array(&columns.try_into().ok()?),
    })
}

/// A segmentation without its labels as JSON.
pub fn json_of_labels(labels: &Segmentation) -> Value {
    let segments: Vec<Value> = labels
        .segments
        .iter()
        .map(|s| json!([s.label, s.name, s.color_srgb]))
        .collect();
    json!({ "grid": json_of_grid(&labels.grid), "segments": segments })
}

/// A segmentation without its labels from [`json_of_labels`].
pub fn labels_of(value: &Value) -> Option<Segmentation> {
    Some(Segmentation {
        grid: grid_of(value.get("grid")?)?,
        labels: Vec::new(),
        segments: value
            .get("segments")?
            .as_array()?
            .iter()
            .filter_map(segment_of)
            .collect(),
    })
}

/// A volume without its voxels as JSON.
pub fn json_of(header: &Volume) -> Value {
    let kind = match &header.voxels {
        Voxels::U8(_) => "u8",
        Voxels::I16(_) => "i16",
        Voxels::U16(_) => "u16",
        Voxels::F32(_) => "f32",
    };
    let labels = header.segmentation.as_ref().map(json_of_labels);
    json!({
        "grid": json_of_grid(&header.grid), "kind": kind, "slope": header.slope, "intercept": header.intercept,
        "value_range": header.value_range, "labels": labels, "has_size": header.has_size,
    })
}

/// A volume without its voxels from [`json_of`].
pub fn volume_of(value: &Value) -> Option<Volume> {
    let number = |value: &Value| value.as_f64().map(|x| x as f32);
    let range = value.get("value_range")?.as_array()?;
    let labels = match value.get("labels") {
        Some(labels) if !labels.is_null() => Some(labels_of(labels)?),
        _ => None,
    };
    Some(Volume {
        grid: grid_of(value.get("grid")?)?,
        voxels: match value.get("kind")?.as_str()? {
            "u8" => Voxels::U8(Vec::new()),
            "i16" => Voxels::I16(Vec::new()),
            "u16" => Voxels::U16(Vec::new()),
            _ => Voxels::F32(Vec::new()),
        },
        slope: number(value.get("slope")?)?,
        intercept: number(value.get("intercept")?)?,
        value_range: [
            number(range.first()?).unwrap_or_default(),
            number(range.get(1)?).unwrap_or_default(),
        ],
        segmentation: labels,
        has_size: value.get("has_size")?.as_bool()?,
    })
}

fn segment_of(value: &Value) -> Option<Segment> {
    let color = value.get(2)?.as_array().and_then(|c| {
        let bytes: Vec<u8> = c
            .iter()
            .filter_map(|n| u8::try_from(n.as_u64()?).ok())
            .collect();
        bytes.try_into().ok()
    });
    Some(Segment {
        label: u16::try_from(value.get(0)?.as_u64()?).ok()?,
        name: value.get(1)?.as_str()?.to_owned(),
        color_srgb: color,
    })
}

/// A displacement field without its samples as JSON.
pub fn json_of_field(field: &FieldFile) -> Value {
    json!({
        "grid": json_of_grid(&field.grid), "signs": field.signs.to_array(), "is_nodes": field.is_nodes,
        "sha256": field.sha256, "notices": field.notices,
    })
}

/// A displacement field without its samples from [`json_of_field`].
pub fn field_of(value: &Value) -> Option<FieldFile> {
    let signs: Option<Vec<f64>> = value
        .get("signs")?
        .as_array()?
        .iter()
        .map(Value::as_f64)
        .collect();
    let notices = value.get("notices")?.as_array()?.iter();
    Some(FieldFile {
        grid: grid_of(value.get("grid")?)?,
        samples: Vec::new(),
        signs: DVec3::from_array(signs?.try_into().ok()?),
        is_nodes: value.get("is_nodes")?.as_bool()?,
        sha256: value.get("sha256")?.as_str()?.to_owned(),
        notices: notices
            .filter_map(|line| Some(line.as_str()?.to_owned()))
            .collect(),
    })
}
