//! `fabrica templates`: the catalogue with parameters, defaults and ranges.

use serde_json::{Value, json};

use crate::displace::Holds;
use crate::document::{ParamKind, TemplateKind, plain_f64};

/// The parameter of a kind that holds an object, and what it is.
const OBJECT: [&str; 2] = ["object", "Name of the object of the scene"];

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
            if kind.facts().holds == Holds::Object {
                value["params"].as_array_mut().into_iter().for_each(|list| {
                    list.push(json!({ "name": OBJECT[0], "summary": OBJECT[1], "type": "text", "default": "" }));
                });
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
        if kind.facts().holds == Holds::Object {
            text.push_str(&format!("  {}: {}\n", OBJECT[0], OBJECT[1]));
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
