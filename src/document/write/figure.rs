//! A figure and its parts as JSON, in full precision.

use super::json::write_compact;
use super::number::color_text;
use crate::document::model::figure::{
    Behind, Context, Contour, Figure, Flood, Handle, Hold, Region, Rigidity, Source,
};
use crate::document::text::json::number;
use glam::DVec2;
use serde_json::{Map, Value, json};

/// The figure as JSON text, as it stands under `figure` in a document, every number in full precision. It is how a
/// figure crosses to a worker; [`figure_from_text`](crate::document::figure_from_text) reads it back.
pub fn figure_to_text(figure: &Figure) -> String {
    let mut text = String::new();
    write_compact(&figure.to_value(), &mut text);
    text
}

impl Figure {
    /// The figure as it stands under `figure` in a document. A document leaves out what stands at its default.
    pub fn to_value(&self) -> Value {
        let listed = |list: Vec<Value>| Value::Array(list);
        let mut map = Map::new();
        let mut set = |key: &str, value: Value| map.insert(key.to_owned(), value);
        set(
            "regions",
            listed(self.regions.iter().map(Region::to_value).collect()),
        );
        set(
            "handles",
            listed(self.handles.iter().map(Handle::to_value).collect()),
        );
        set("only", points(self.only.as_deref().unwrap_or_default()));
        set("propagation", json!(self.propagation.name()));
        set("reach", exact(self.reach));
        set("rotations", json!(self.rotations.name()));
        if let Some(shape) = &self.context {
            set("context", context(shape));
        }
        set(
            "contours",
            listed(self.contours.iter().map(Contour::to_value).collect()),
        );
        set("rest", json!(self.rest.name()));
        set("detail", json!(self.detail));
        Value::Object(map)
    }
}

impl Region {
    /// The region as an entry of a figure's `regions`. One without `from` has the keys that change what the source has.
    pub fn to_value(&self) -> Value {
        let mut value = json!({ "name": self.name });
        let all = [
            ("grow", exact(self.grow)),
            ("smooth", exact(self.smooth)),
            ("least", json!(self.least)),
            ("rigidity", rigidity(self.rigidity)),
            ("fixed", json!(self.fixed)),
            ("order", exact(self.order)),
            ("cut", json!(self.cut)),
            ("behind", json!(behind(self.behind))),
            ("hide", json!(self.hide)),
        ];
        let default = Self::new("");
        let is_default = [
            self.grow == default.grow,
            self.smooth == default.smooth,
            self.least == default.least,
            self.rigidity == default.rigidity,
            self.fixed == default.fixed,
            self.order == default.order,
            self.cut == default.cut,
            self.behind == default.behind,
            self.hide == default.hide,
        ];
        for ((key, own), is_default) in all.into_iter().zip(is_default) {
            if self.from.is_some() || self.given.contains(&key) || !is_default {
                value[key] = own;
            }
        }
        if let Some(from) = &self.from {
            value["from"] = source(from);
        }
        if let Some(fill) = self.fill {
            value["fill"] = json!(fill);
        }
        value
    }
}

impl Handle {
    /// The handle as an entry of a figure's `handles`.
    pub fn to_value(&self) -> Value {
        let mut value = json!({ "radius": exact(self.radius), "enabled": self.enabled });
        if let Some(name) = &self.name {
            value["name"] = json!(name);
        }
        let mut leads = false;
        match &self.hold {
            Hold::Point(at) => value["at"] = point(*at),
            Hold::Region(region) => value["region"] = json!(region),
            Hold::Line { points: line, to } => {
                value["points"] = points(line);
                if let Some(to) = to {
                    value["to"] = points(to);
                    leads = true;
                }
            }
        }
        // What a bent line does not take is not written.
        if !leads {
            value["move"] = point(self.motion.by);
            value["turn"] = self.motion.turn.map_or(Value::Null, exact);
            value["scale"] = exact(self.motion.scale);
        }
        value
    }
}

impl Contour {
    /// The contour as an entry of a figure's `contours`.
    pub fn to_value(&self) -> Value {
        json!({
            "region": self.region, "like": points(&self.like), "amount": exact(self.amount), "mirror": self.mirror,
            "keep": points(&self.keep),
        })
    }
}

fn context(context: &Context) -> Value {
    json!({
        "points": points(&context.points), "strength": exact(context.strength), "keep": context.keep,
        "like": points(context.like.as_deref().unwrap_or_default()), "amount": exact(context.amount),
    })
}

fn source(source: &Source) -> Value {
    match source {
        Source::Flood(flood) => json!({ "flood": self::flood(flood) }),
        Source::Polygon(polygon) => json!({ "polygon": points(polygon) }),
        Source::Path(id) => json!({ "path": id }),
    }
}

fn flood(flood: &Flood) -> Value {
    json!({
        "at": points(&flood.at), "tolerance": exact(flood.tolerance), "gap": exact(flood.gap),
        "connected": flood.connected,
    })
}

fn rigidity(rigidity: Rigidity) -> Value {
    match rigidity {
        Rigidity::Rigid => json!("rigid"),
        Rigidity::Elastic([kx, ky]) if kx == ky => exact(kx),
        Rigidity::Elastic(both) => json!(both.map(exact)),
    }
}

fn behind(behind: Behind) -> Value {
    match behind {
        Behind::None => json!("none"),
        Behind::Smooth => json!("smooth"),
        Behind::Color(color_srgb) => json!(color_text(color_srgb)),
    }
}

fn exact(value: f64) -> Value {
    Value::Number(number(value))
}

fn point(at: DVec2) -> Value {
    json!(at.to_array().map(exact))
}

fn points(points: &[DVec2]) -> Value {
    points.iter().copied().map(point).collect()
}
