//! What templates hold besides parameters: control points, a cut, the name of a file.

use super::catalogue::TemplateKind;
use super::edit::{rounded, vector};
use super::error::DocumentError;
use super::illustration::{ControlPoint, ControlPoints, FieldRef, TemplateData};
use super::notice::NoticeKind;
use super::object::{Object, wrong};
use super::pointer::join;
use super::resolve::Reader;
use super::resolve_subject::hash;
use super::{MAX_CUT, MAX_POINTS};
use glam::{DVec2, DVec3, Vec3};
use serde_json::{Value, json};

/// Control points lie in the box or not far from it, template units.
const POINT_RANGE: [f64; 2] = [-10.0, 10.0];

impl Reader {
    pub(super) fn data(
        &mut self,
        kind: TemplateKind,
        template: &Object<'_>,
        params: &Object<'_>,
    ) -> Result<TemplateData, DocumentError> {
        Ok(match kind {
            TemplateKind::Rbf => TemplateData::Points(self.control_points(params)?),
            TemplateKind::Field => TemplateData::Field(FieldRef {
                src: params.text("src")?.map(str::to_owned),
                sha256: hash(params)?,
                name: params.string("name")?,
                is_placed: ["at", "rotate", "size"]
                    .iter()
                    .any(|key| template.map.contains_key(*key)),
                samples: None,
            }),
            _ => TemplateData::None,
        })
    }

    fn control_points(&mut self, params: &Object<'_>) -> Result<ControlPoints, DocumentError> {
        let mut points = Vec::new();
        for (i, value) in self.first(params, "points", MAX_POINTS)?.iter().enumerate() {
            let object = Object::new(join(&params.at("points"), &i.to_string()), value)?;
            self.unknown_keys(&object, &["at", "move"]);
            let mut vector = |key: &str, default: [f64; 3]| {
                let values = object
                    .numbers(key, "a list of three numbers")?
                    .unwrap_or(default);
                let drawn = self.clamp(|| object.at(key), values, POINT_RANGE);
                Ok::<Vec3, DocumentError>(DVec3::from_array(drawn).as_vec3())
            };
            points.push(ControlPoint {
                at: vector("at", [0.5; 3])?,
                shift: vector("move", [0.0; 3])?,
            });
        }
        let mut cut = Vec::new();
        for (i, value) in self.first(params, "cut", MAX_CUT)?.iter().enumerate() {
            let pointer = join(&params.at("cut"), &i.to_string());
            let Value::Array(items) = value else {
                return Err(wrong(&pointer, "a list of two numbers", value));
            };
            let [x, y] = items.as_slice() else {
                return Err(wrong(&pointer, "a list of two numbers", value));
            };
            let x = super::object::number(&join(&pointer, "0"), x)?;
            let y = super::object::number(&join(&pointer, "1"), y)?;
            let drawn = self.clamp(|| pointer, [x, y], POINT_RANGE);
            cut.push(DVec2::from_array(drawn).as_vec2());
        }
        Ok(ControlPoints { points, cut })
    }

    /// The first entries of a list; says so if there are more.
    pub(super) fn first<'a>(
        &mut self,
        params: &Object<'a>,
        key: &str,
        limit: usize,
    ) -> Result<&'a [Value], DocumentError> {
        let items = params.list(key)?;
        if items.len() > limit {
            self.note(
                params.at(key),
                NoticeKind::Clamped {
                    found: items.len().to_string(),
                    drawn: format!("the first {limit}"),
                },
            );
        }
        Ok(items.get(..limit).unwrap_or(items))
    }
}

/// Parameters of a new `rbf`, something to take hold of: the middle drawn up between four points that stay.
pub(super) fn fresh_points() -> Value {
    let point = |x: f32, y: f32| json!({ "at": vector(Vec3::new(x, y, 0.5)) });
    json!({ "edge": 0.25, "points": [
        { "at": [0.5, 0.5, 0.6], "move": [0, 0, -0.15] },
        point(0.25, 0.25), point(0.75, 0.25), point(0.25, 0.75), point(0.75, 0.75),
    ] })
}

/// Points and cut as a document lists them.
pub(super) fn points_listed(points: &ControlPoints) -> [Value; 2] {
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
