//! Parts of a document as JSON.

use super::number::{color_text, hundredths, rotation, rounded, rounded_value, vector};
use crate::displace::MAX_TOOLS;
use crate::document::model::{
    Caption, CleanStep, ControlPoints, Curve, MeshParts, MeshReading, MeshRef, PathKey, RawVoxels,
    Recipe, RecipeSource, Stroke, SweepTools, ToolShape, TransferPoint,
};
use crate::document::schema::MAX_VALUE;
use glam::{IVec3, Quat, Vec3};
use serde_json::{Value, json};

/// The points of a transfer function.
pub(super) fn transfer_points(points: &[TransferPoint]) -> Value {
    points
        .iter()
        .map(|point| {
            json!({
                "value": rounded_value(point.value),
                "color": color_text(point.color_srgb),
                "opacity": rounded(point.opacity),
            })
        })
        .collect()
}

/// The curve of a template.
pub(super) fn curve(curve: &Curve) -> Value {
    let points = curve
        .points
        .iter()
        .map(|p| json!([rounded(p.x), rounded(p.y)]));
    let mut value = json!({ "points": points.collect::<Vec<_>>() });
    if !curve.is_spline {
        value["spline"] = json!(false);
    }
    value
}

/// An entry of `labels`.
pub(super) fn caption(caption: &Caption) -> Value {
    let mut value = json!({ "at": vector(caption.at), "text": caption.text });
    if !caption.enabled {
        value["enabled"] = json!(false);
    }
    value
}

/// The layout of bare voxels.
pub(super) fn raw(raw: &RawVoxels) -> Value {
    let mut value = json!({ "size": raw.size, "type": raw.element });
    let mut set = |key: &str, to: Value| value[key] = to;
    if raw.big_endian {
        set("order", json!("big"));
    }
    if raw.spacing_mm != [1.0; 3] {
        set("spacing", json!(raw.spacing_mm));
    }
    if raw.skip_bytes > 0 {
        set("skip", json!(raw.skip_bytes));
    }
    value
}

/// Where a file is and what its hash is: the keys of what is given.
pub(super) fn file_keys(
    src: &Option<String>,
    sha256: &Option<String>,
) -> impl Iterator<Item = (&'static str, Value)> {
    let keys = [("src", src), ("sha256", sha256)];
    let given = keys.map(|(key, given)| given.as_ref().map(|given| (key, json!(given))));
    given.into_iter().flatten()
}

/// An entry of `subject.meshes`.
pub(super) fn mesh(mesh: &MeshRef) -> Value {
    let mut value = json!({ "name": mesh.name });
    for (key, given) in file_keys(&mesh.src, &mesh.sha256) {
        value[key] = given;
    }
    for (key, given) in mesh_reading(&mesh.reading) {
        value[key] = given;
    }
    value
}

/// How a mesh is read: the keys that differ from their defaults.
pub(super) fn mesh_reading(reading: &MeshReading) -> Vec<(&'static str, Value)> {
    let mut keys = Vec::new();
    if let Some(units) = reading.units {
        keys.push(("units", json!(units.name())));
    }
    if let Some(axes) = reading.axes {
        keys.push(("axes", json!(axes.name())));
    }
    if reading.parts != MeshParts::Named {
        keys.push(("parts", json!(reading.parts.name())));
    }
    if let Some(smooth) = reading.smooth_deg {
        keys.push(("smooth", rounded(smooth)));
    }
    keys
}

/// Parameters of a new `rbf`: its middle is drawn up between four points that stay, so that there is something to take
/// hold of.
pub(super) fn fresh_points() -> Value {
    let point = |x: f32, y: f32| json!({ "at": vector(Vec3::new(x, y, 0.5)) });
    json!({ "edge": 0.25, "points": [
        { "at": [0.5, 0.5, 0.6], "move": [0, 0, -0.15] },
        point(0.25, 0.25), point(0.75, 0.25), point(0.25, 0.75), point(0.75, 0.75),
    ] })
}

/// The points and the cut of an `rbf`.
pub(super) fn points_and_cut(points: &ControlPoints) -> [Value; 2] {
    let listed = points.points.iter().map(|point| {
        let mut value = json!({ "at": vector(point.at) });
        if point.shift != Vec3::ZERO {
            value["move"] = vector(point.shift);
        }
        value
    });
    let cut = points
        .cut
        .iter()
        .map(|p| json!([rounded(p.x), rounded(p.y)]));
    [listed.collect(), cut.collect()]
}

/// Letters of the axes that tools are mirrored across.
pub(super) fn mirrors(mirror: [bool; 3]) -> String {
    let axes = ['x', 'y', 'z'].into_iter().zip(mirror);
    axes.filter(|(_, is_on)| *is_on)
        .map(|(axis, _)| axis)
        .collect()
}

/// Keys of tools that say what a shape is like; another shape has others.
const OF_SHAPES: [&str; 12] = [
    "radius", "radii", "length", "half", "round", "ring", "points", "src", "sha256", "name",
    "longest", "strokes",
];

/// The tools of a sweep. Of those that the document has `before`, keys that are not known stay, and tools that are not
/// drawn stay whole: of an unknown shape, or beyond the number that is drawn.
pub(super) fn tools(tools: &SweepTools, before: Option<Value>) -> Value {
    let each = tools.tools.iter().map(|tool| {
        let old = before.as_ref().and_then(|list| list.get(tool.index));
        let mut value = old.cloned().unwrap_or_else(|| json!({}));
        let Some(shape) = &tool.shape else {
            return value;
        };
        put_shape(&mut value, shape);
        let mut put = |key: &str, new: Value| value[key] = new;
        put("coat", rounded(tool.coat));
        put("spline", json!(tool.spline));
        put("path", tool.path.iter().map(path_key).collect());
        value
    });
    let list = before.as_ref().and_then(Value::as_array);
    let beyond = list.into_iter().flatten().skip(MAX_TOOLS).cloned();
    each.chain(beyond).collect()
}

/// Gives a tool this shape, in place of the one that it has.
pub(super) fn put_shape(tool: &mut Value, shape: &ToolShape) {
    if let Some(keys) = tool.as_object_mut() {
        keys.retain(|key, _| !OF_SHAPES.contains(&key.as_str()));
    }
    let mut put = |key: &str, new: Value| tool[key] = new;
    put("shape", json!(shape.name()));
    match shape {
        ToolShape::Ball { radius } => put("radius", rounded(*radius)),
        ToolShape::Ellipsoid { radii } => put("radii", vector(*radii)),
        ToolShape::Capsule { radius, length } => {
            put("radius", rounded(*radius));
            put("length", rounded(*length));
        }
        ToolShape::Box { half, round } => {
            put("half", vector(*half));
            put("round", rounded(*round));
        }
        ToolShape::Torus { ring, radius } => {
            put("ring", rounded(*ring));
            put("radius", rounded(*radius));
        }
        ToolShape::Curve { points, radius } => {
            put("points", points.iter().map(|p| vector(*p)).collect());
            put("radius", rounded(*radius));
        }
        ToolShape::Mesh { file, longest } => {
            for (key, given) in file_keys(&file.src, &file.sha256) {
                put(key, given);
            }
            if !file.name.is_empty() {
                put("name", json!(file.name));
            }
            put("longest", rounded(*longest));
        }
        ToolShape::Clay { strokes, longest } => {
            put("strokes", json!(strokes));
            put("longest", rounded(*longest));
        }
    }
}

/// A pose on the path of a tool.
fn path_key(key: &PathKey) -> Value {
    if *key == PathKey::at(key.at) {
        return vector(key.at);
    }
    let mut value = json!({ "at": vector(key.at) });
    if key.rotate != Quat::IDENTITY {
        value["rotate"] = rotation(key.rotate);
    }
    if key.scale != 1.0 {
        value["scale"] = rounded(key.scale);
    }
    value
}

/// One step of a clean-up.
fn clean_step(step: CleanStep) -> Value {
    match step {
        CleanStep::Largest(count) => json!({ "largest": count }),
        CleanStep::Fill => json!({ "fill": true }),
        CleanStep::Close(by) => json!({ "close": rounded(by) }),
        CleanStep::Smooth(by) => json!({ "smooth": rounded(by) }),
        CleanStep::Grow(by) => json!({ "grow": rounded(by) }),
        CleanStep::Shrink(by) => json!({ "shrink": rounded(by) }),
    }
}

impl Recipe {
    /// The recipe as an entry of `subject.features`. Seeds and lengths, in mm, are rounded to four decimals, values to
    /// hundredths.
    pub fn to_value(&self) -> Value {
        let range = |range: &[f32; 2]| {
            let mut list = vec![hundredths(range[0])];
            if f64::from(range[1]) < MAX_VALUE {
                list.push(hundredths(range[1]));
            }
            list
        };
        let mut value = json!({ "name": self.name });
        let mut set = |key: &str, to: Value| value[key] = to;
        if let Some(color_srgb) = self.color_srgb {
            set("color", json!(color_text(color_srgb)));
        }
        match &self.from {
            RecipeSource::Threshold { range: ends } => {
                set("from", json!({ "threshold": range(ends) }));
            }
            RecipeSource::Grow { seeds, range: ends } => {
                let seeds: Vec<Value> = seeds.iter().map(|seed| vector(*seed)).collect();
                set(
                    "from",
                    json!({ "grow": { "seeds": seeds, "range": range(ends) } }),
                );
            }
            RecipeSource::Nothing => {}
        }
        if !self.clean.is_empty() {
            set(
                "clean",
                self.clean.iter().copied().map(clean_step).collect(),
            );
        }
        // What is painted only, and nothing yet, is a recipe too.
        if !self.paint.is_empty() || self.from == RecipeSource::Nothing {
            set("paint", self.paint.iter().map(Stroke::to_value).collect());
        }
        value
    }
}

impl Stroke {
    /// The stroke as an entry of a recipe's `paint`.
    pub fn to_value(&self) -> Value {
        let mut before = IVec3::ZERO;
        let mut path = Vec::with_capacity(3 * self.places.len());
        for &place in &self.places {
            path.extend((place - before).to_array());
            before = place;
        }
        let mut value = json!({ "path": path, "radius": rounded(self.radius_mm) });
        if self.erases {
            value["erase"] = json!(true);
        }
        value
    }
}
