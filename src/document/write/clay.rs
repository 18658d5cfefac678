//! A clay as JSON.

use super::value;
use crate::document::model::{
    Clay, ClayMove, ClayStart, ClayStroke, ClayTool, ClayVolume, MeshParts, MeshReading, MeshRef,
    VoxelPart, VoxelSource,
};
use serde_json::{Value, json};

/// The value of `subject.clay`. A start and tools that this version does not know stay as the document has them
/// `before`.
pub(super) fn clay(clay: &Clay, before: Option<&Value>) -> Value {
    let old = |key: &str| before.and_then(|before| before.get(key));
    let from = match &clay.from {
        ClayStart::Shape(shape) => json!({ "shape": shape.name() }),
        ClayStart::Mesh(mesh) => {
            // That its parts are one goes without saying.
            let parts = MeshParts::default();
            let reading = MeshReading {
                parts,
                ..mesh.reading
            };
            value::mesh(&MeshRef {
                reading,
                ..mesh.clone()
            })
        }
        ClayStart::Volume(volume) => volume.to_value(),
        ClayStart::Unknown(name) => {
            let kept = old("from").cloned();
            kept.unwrap_or_else(|| json!({ "shape": name }))
        }
    };
    let tools = clay.tools.iter().enumerate().map(|(i, tool)| {
        let kept = old("tools").and_then(|tools| tools.get(i));
        match (&tool.shape, kept) {
            (None, Some(kept)) => kept.clone(),
            _ => tool.to_value(),
        }
    });
    json!({
        "from": from,
        "detail": clay.detail,
        "tools": tools.collect::<Vec<_>>(),
        "strokes": clay.strokes.iter().map(ClayStroke::to_value).collect::<Vec<_>>(),
    })
}

/// A recipe as text, for who makes the clay elsewhere.
pub fn clay_to_text(of: &Clay) -> String {
    clay(of, None).to_string()
}

impl ClayVolume {
    /// The value of `subject.clay.from`.
    fn to_value(&self) -> Value {
        let mut of = json!({});
        let mut set = |key: &str, to: Value| of[key] = to;
        match &self.of {
            VoxelSource::Builtin { name, revision } => {
                set("builtin", json!(name));
                if *revision > 1 {
                    set("revision", json!(revision));
                }
            }
            VoxelSource::File {
                src,
                sha256,
                name,
                reading,
            } => {
                set("name", json!(name));
                for (key, given) in value::file_keys(src, sha256) {
                    set(key, given);
                }
                set("frame", json!(reading.frame));
                if let Some(raw) = &reading.raw {
                    set("raw", value::raw(raw));
                }
            }
        }
        let mut from = json!({ "of": of });
        match &self.part {
            VoxelPart::Segment(name) => from["segment"] = json!(name),
            VoxelPart::Iso(value) => from["iso"] = json!(value),
        }
        if self.has_all_walls {
            from["walls"] = json!(Self::WALLS[1]);
        }
        from
    }
}

impl ClayTool {
    /// The tool as an entry of `subject.clay.tools`.
    pub fn to_value(&self) -> Value {
        let mut tool = json!({ "coat": self.coat });
        if let Some(shape) = &self.shape {
            value::put_shape(&mut tool, shape);
        }
        tool
    }
}

impl ClayStroke {
    /// The stroke as an entry of `subject.clay.strokes`.
    pub fn to_value(&self) -> Value {
        let mut moves = self.moves.iter().map(ClayMove::to_value);
        let mut stroke = moves.next().unwrap_or_else(|| json!({}));
        let with: Vec<Value> = moves.collect();
        let mut set = |key: &str, to: Value| stroke[key] = to;
        if !with.is_empty() {
            set("with", Value::from(with));
        }
        if self.mirror != [false; 3] {
            set("mirror", json!(value::mirrors(self.mirror)));
        }
        if let Some(strength) = self.smooth {
            set("do", json!("smooth"));
            set("strength", json!(strength));
        }
        if self.is_off {
            set("off", json!(true));
        }
        stroke
    }
}

impl ClayMove {
    /// The tool and its way. What follows of itself at the ends of lists is left out.
    fn to_value(&self) -> Value {
        let mut before = [0; 3];
        let mut path = Vec::with_capacity(3 * self.keys.len());
        for key in &self.keys {
            let way = key.at.iter().zip(before);
            path.extend(way.map(|(at, before)| i64::from(*at) - i64::from(before)));
            before = key.at;
        }
        let mut turns: Vec<[i32; 3]> = self.keys.iter().map(|key| key.turn).collect();
        while turns.last() == Some(&[0; 3]) {
            turns.pop();
        }
        let mut scales: Vec<i32> = self.keys.iter().map(|key| key.percent).collect();
        while let [.., a, b] = scales[..]
            && a == b
        {
            scales.pop();
        }
        if scales == [100] {
            scales.clear();
        }
        let mut value = json!({ "tool": self.tool, "path": path });
        let mut set = |key: &str, to: Value| value[key] = to;
        if !turns.is_empty() {
            set("turns", json!(turns.concat()));
        }
        if !scales.is_empty() {
            set("scales", json!(scales));
        }
        if self.is_straight {
            set("straight", json!(true));
        }
        value
    }
}
