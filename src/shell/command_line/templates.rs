//! `fabrica templates`: the catalogue with parameters, defaults and ranges.

use serde_json::{Value, json};

use crate::displace::{COAT, Holds, LONG, LONGEST, MAX_TOOL_POINTS, ROUND, SCALE, SOLID};
use crate::document::{MAX_KEYS, MAX_TOOLS, ParamKind, TemplateKind, ToolShape, plain_f64};

/// Parameters of a kind that are no numbers or choices, as the list has them.
fn held(holds: Holds) -> Value {
    let number = |name: &str, default: f64, [min, max]: [f64; 2], summary: &str| json!({ "name": name, "summary": summary, "type": "number", "default": default, "min": min, "max": max });
    let vector = |name: &str, default: [f64; 3], [min, max]: [f64; 2], summary: &str| json!({ "name": name, "summary": summary, "type": "vector", "default": default, "min": min, "max": max });
    let text = |name: &str, summary: &str| json!({ "name": name, "summary": summary, "type": "text", "default": "" });
    let list = |name: &str, default: Value, most: usize, of: Value, summary: &str| json!({ "name": name, "summary": summary, "type": "list", "default": default, "max": most, "of": of });
    match holds {
        Holds::Object => json!([text("object", "Name of the object of the scene")]),
        Holds::Tools => {
            let key = json!([
                vector("at", [0.5; 3], [-10.0, 10.0], "Place of the tool's origin, template space; a bare list is a place"),
                { "name": "rotate", "summary": "Turn about its origin", "type": "rotation", "default": [0, 0, 0, 1] },
                number("scale", 1.0, SCALE, "Scale about its origin"),
            ]);
            let path = json!([[0.5, 0.5, 1.15], [0.5, 0.5, 0.65]]);
            let point = json!([vector(
                "",
                [0.0; 3],
                [-4.0, 4.0],
                "A place in the frame of the tool"
            )]);
            let tool = json!([
                { "name": "shape", "summary": "Its form; lengths are fractions of the shortest side of the box",
                    "type": "choice", "default": ToolShape::NAMES[0], "choices": ToolShape::OF_SWEEPS },
                number("radius", 0.15, ROUND, "Of a ball (0.15, at least 0.005), a capsule (0.08), the tube of a torus or a curve (0.05)"),
                vector("radii", [0.2, 0.15, 0.1], SOLID, "Half axes of an ellipsoid"),
                number("length", 0.4, LONG, "Of the straight part of a capsule"),
                vector("half", [0.15; 3], SOLID, "Half sides of a box"),
                number("round", 0.02, ROUND, "Radius of the edges of a box, at most its least half side"),
                number("ring", 0.2, SOLID, "Radius of a torus, to the middle of its tube"),
                list("points", json!([[0, 0, -0.2], [0, 0, 0.2]]), MAX_TOOL_POINTS, point, "Of a curve: two or more places with straight pieces between them"),
                text("src", "Address of the file of a mesh"),
                text("sha256", "Hash of its bytes; without an address the reader supplies the file"),
                text("name", "The author's name for the file"),
                number("longest", ToolShape::LONGEST.into(), LONGEST, "Longest side of the box of a mesh"),
                number("coat", 0.25, COAT, "Width of the coating in which its motion fades"),
                { "name": "spline", "summary": "Places are joined by a smooth curve", "type": "flag", "default": false },
                list("path", path, MAX_KEYS, key, "Its poses; with one it stands still and holds what is in it"),
            ]);
            json!([
                text(
                    "mirror",
                    "Letters of x, y and z: each tool has an image beyond the middle plane of the box across that axis"
                ),
                list(
                    "tools",
                    json!([{}]),
                    MAX_TOOLS,
                    tool,
                    "Tools that act at once; with their images at most eight"
                ),
            ])
        }
        Holds::Parameters | Holds::Points | Holds::File => json!([]),
    }
}

pub(super) fn templates_json() -> String {
    let templates: Vec<Value> = TemplateKind::ALL
        .iter()
        .map(|kind| {
            let spec = kind.spec();
            let params: Vec<Value> = spec
                .params
                .iter()
                .map(|param| {
                    let mut value = json!({ "name": param.name, "summary": param.summary });
                    let mut set = |key: &str, to: Value| value[key] = to;
                    match param.kind {
                        ParamKind::Number { default, min, max }
                        | ParamKind::Count { default, min, max } => {
                            let is_count = matches!(param.kind, ParamKind::Count { .. });
                            set("type", json!(if is_count { "count" } else { "number" }));
                            set("default", json!(plain_f64(default)));
                            set("min", json!(plain_f64(min)));
                            set("max", json!(plain_f64(max)));
                        }
                        ParamKind::Flag { default } => {
                            set("type", json!("flag"));
                            set("default", json!(default));
                        }
                        ParamKind::Choice { names } => {
                            set("type", json!("choice"));
                            set("default", json!(names.first()));
                            set("choices", json!(names));
                        }
                        ParamKind::Vector {
                            default,
                            min,
                            max,
                            max_length,
                        } => {
                            set("type", json!("vector"));
                            set("default", json!(default.map(plain_f64)));
                            set("min", json!(plain_f64(min)));
                            set("max", json!(plain_f64(max)));
                            if max_length.is_finite() {
                                set("max_length", json!(plain_f64(max_length)));
                            }
                        }
                        ParamKind::Rotation => {
                            set("type", json!("rotation"));
                            set("default", json!([0, 0, 0, 1]));
                        }
                    }
                    value
                })
                .collect();
            let mut value = json!({ "kind": spec.name, "summary": spec.summary, "params": params });
            if let (Some(list), Value::Array(more)) =
                (value["params"].as_array_mut(), held(kind.facts().holds))
            {
                list.extend(more);
            }
            if let Some(main) = spec.main_param.and_then(|i| spec.params.get(i)) {
                value["main"] = json!(main.name);
            }
            value
        })
        .collect();
    match serde_json::to_string_pretty(&templates) {
        Ok(text) => format!("{text}\n"),
        // Keys are texts and numbers are finite, so this cannot be; compact JSON is as good.
        Err(_) => format!("{}\n", Value::from(templates)),
    }
}

pub(super) fn templates_text() -> String {
    let mut text = String::new();
    for kind in TemplateKind::ALL {
        let spec = kind.spec();
        text.push_str(&format!("{}: {}\n", spec.name, spec.summary));
        for param in held(kind.facts().holds).as_array().into_iter().flatten() {
            let [name, summary] = ["name", "summary"].map(|key| param[key].as_str().unwrap_or(""));
            text.push_str(&format!("  {name}: {summary}\n"));
        }
        for param in spec.params {
            let values = match param.kind {
                ParamKind::Number { default, min, max } => format!("{default} ({min} to {max})"),
                ParamKind::Count { default, min, max } => {
                    format!("{default} ({min} to {max}, whole)")
                }
                ParamKind::Flag { default } => default.to_string(),
                ParamKind::Choice { names } => names.join(" | "),
                ParamKind::Vector {
                    default: [x, y, z],
                    min,
                    max,
                    max_length,
                } => {
                    let length = if max_length.is_finite() {
                        format!(", length up to {max_length}")
                    } else {
                        String::new()
                    };
                    format!("[{x}, {y}, {z}] (each {min} to {max}{length})")
                }
                ParamKind::Rotation => "[0, 0, 0, 1] (quaternion x, y, z, w)".to_owned(),
            };
            text.push_str(&format!(
                "  {:<10} {:<44} {}\n",
                param.name, values, param.summary
            ));
        }
    }
    text
}
