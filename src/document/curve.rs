//! The curve that a template may be laid along.

use super::edit::rounded;
use super::error::DocumentError;
use super::illustration::PlacedTemplate;
use super::notice::NoticeKind;
use super::object::{Object, number, wrong};
use super::pointer::join;
use super::resolve::Reader;
use crate::math::{Bent, Laid, NotBent};
use glam::{DVec2, Vec2, Vec3};
use serde_json::{Map, Value, json};

/// Places of a curve at most.
pub const MAX_CURVE: usize = 9;
/// Places lie in the box or not far from it, template units.
const PLACE_RANGE: [f64; 2] = [-10.0, 10.0];

/// The line that a template's top lies along, from x = 0 to x = 1 (dissertation, section 5.3): the x-z plane of the template is bent with it, y
/// stays straight, and beyond its ends it goes straight on. The template is as long as the line.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// x and z in template space; 2 to [`MAX_CURVE`].
    pub points: Vec<Vec2>,
    /// Round through the points, or straight from each to the next.
    pub is_spline: bool,
    /// Which part of the box lies on it: the top ([`Laid::TOP`]) of what is written, other parts of what acts only in part.
    pub laid: Laid,
}

impl Curve {
    /// Round through these places.
    pub fn spline(points: Vec<Vec2>) -> Self {
        Self {
            points,
            is_spline: true,
            laid: Laid::TOP,
        }
    }

    /// The line on which nothing is bent, by so many points.
    fn straight(like: &Self) -> Self {
        let last = like.points.len().saturating_sub(1).max(1) as f32;
        let points = (0..like.points.len()).map(|i| Vec2::new(i as f32 / last, 1.0));
        Self {
            points: points.collect(),
            ..like.clone()
        }
    }

    /// The space bent along it, for a box of this size.
    ///
    /// # Errors
    /// [`NotBent`] if there is none; the template is straight then.
    pub fn bent(&self, size: Vec3) -> Result<Bent, NotBent> {
        Bent::new(&self.points, self.is_spline, size, self.laid)
    }

    /// Seen in a mirror across the middle of x, which also turns its way round.
    #[must_use]
    pub fn mirrored(&self) -> Self {
        let points = self.points.iter().rev();
        Self {
            points: points.map(|p| Vec2::new(1.0 - p.x, p.y)).collect(),
            ..self.clone()
        }
    }

    /// As the box of the same place is made smaller, `part` of its sides about `center` (template units): what acts in the smaller box is bent as
    /// it was in the larger.
    #[must_use]
    pub(super) fn in_part(&self, part: Vec2, center: Vec2) -> Self {
        let to = |q: Vec2| center + (q - center) / part;
        let [from, until] = self.laid.ends;
        Self {
            points: self.points.iter().map(|p| to(*p)).collect(),
            is_spline: self.is_spline,
            laid: Laid {
                height: to(Vec2::new(0.0, self.laid.height)).y,
                ends: [from, until].map(|x| to(Vec2::new(x, 0.0)).x),
            },
        }
    }

    /// Part of the way between two; where one is straight, from or to the straight line.
    pub(super) fn blend(from: Option<&Self>, to: Option<&Self>, part: f32) -> Option<Self> {
        if part >= 1.0 {
            return to.cloned();
        }
        let [a, b] = match (from, to) {
            (None, None) => return None,
            (Some(a), None) => [a.clone(), Self::straight(a)],
            (None, Some(b)) => [Self::straight(b), b.clone()],
            (Some(a), Some(b)) => [a.clone(), b.clone()],
        };
        if a.points.len() != b.points.len() {
            return Some(b);
        }
        let pairs = a.points.iter().zip(&b.points);
        Some(Self {
            points: pairs.map(|(a, b)| a.lerp(*b, part)).collect(),
            ..b
        })
    }

    /// As a document writes it.
    pub(super) fn value(&self) -> Value {
        let points = self.points.iter();
        let points: Vec<Value> = points
            .map(|p| json!([rounded(p.x), rounded(p.y)]))
            .collect();
        let mut value = json!({ "points": points });
        if !self.is_spline {
            value["spline"] = json!(false);
        }
        value
    }
}

impl PlacedTemplate {
    /// The space that it acts in, if it is laid along a curve.
    pub fn bent(&self) -> Option<Bent> {
        self.curve.as_ref()?.bent(self.placement.size).ok()
    }

    /// Where a point of the template's own space is, subject space: along its curve.
    pub fn subject_from_template(&self, q: Vec3) -> Vec3 {
        let straight = self.bent().map_or(q, |bent| bent.bend(q));
        self.placement.subject_from_template(straight)
    }

    /// The other way round. Where nothing of the template is laid, as if it were straight.
    pub fn template_from_subject(&self, pos: Vec3) -> Vec3 {
        let straight = self.placement.template_from_subject(pos);
        let own = self.bent().and_then(|bent| bent.unbend(straight));
        own.unwrap_or(straight)
    }
}

/// Leaves out what stands at its default.
pub(super) fn strip(template: &mut Map<String, Value>) {
    let Some(Value::Object(curve)) = template.get_mut("curve") else {
        return;
    };
    if curve.get("spline") == Some(&Value::Bool(true)) {
        curve.remove("spline");
    }
    if curve.get("points") == Some(&json!([])) {
        curve.remove("points");
    }
    if curve.is_empty() {
        template.remove("curve");
    }
}

impl Reader {
    /// The curve of a template in a box of this size, of which it moves a layer under the top; none where it has none.
    pub(super) fn curve(
        &mut self,
        template: &Object<'_>,
        size: Vec3,
        layer: f32,
    ) -> Result<Option<Curve>, DocumentError> {
        if !template.map.contains_key("curve") {
            return Ok(None);
        }
        let object = template.child("curve")?;
        self.unknown_keys(&object, &["points", "spline"]);
        let is_spline = object.flag("spline")?.unwrap_or(true);
        let mut points = Vec::new();
        for (i, value) in self.first(&object, "points", MAX_CURVE)?.iter().enumerate() {
            let pointer = join(&object.at("points"), &i.to_string());
            let Value::Array(items) = value else {
                return Err(wrong(&pointer, "a list of two numbers", value));
            };
            let [x, z] = items.as_slice() else {
                return Err(wrong(&pointer, "a list of two numbers", value));
            };
            let x = number(&join(&pointer, "0"), x)?;
            let z = number(&join(&pointer, "1"), z)?;
            let drawn = self.clamp(|| pointer, [x, z], PLACE_RANGE);
            points.push(DVec2::from_array(drawn).as_vec2());
        }
        if points.is_empty() {
            return Ok(None);
        }
        let curve = Curve {
            points,
            is_spline,
            laid: Laid::TOP,
        };
        let what = match curve.bent(size) {
            Ok(bent) if bent.is_folded(layer) => {
                "the curve is bent more sharply than the template is deep; nothing is moved beyond the fold"
            }
            Ok(_) => return Ok(Some(curve)),
            Err(NotBent::TooShort) => {
                "a curve has at least two points apart from each other; the template is drawn straight"
            }
            Err(NotBent::TurnsBack) => {
                "the curve turns back on itself; the template is drawn straight"
            }
        };
        self.note(object.at("points"), NoticeKind::Curve { what });
        Ok(Some(curve))
    }
}

#[cfg(test)]
mod tests {
    use crate::document::{Document, Edit, Plane, mirror};
    use glam::Vec3;

    #[test]
    fn a_curve_is_read_kept_and_bounded() {
        let with = |curve: &str| {
            Document::from_json(&format!(
                r#"{{"fabrica":1,"templates":[{{"kind":"wave","size":[0.5,0.5,0.1],"curve":{curve}}}]}}"#
            ))
        };
        let drawn = |curve: &str| with(curve).expect(curve).illustration().templates[0].clone();
        let said = |curve: &str| {
            let document = with(curve).expect(curve);
            let notices = document.notices().iter();
            notices.map(ToString::to_string).collect::<Vec<_>>()
        };
        let dome = r#"{"points":[[0,0.5],[0.5,1],[1,0.5]],"spline":true}"#;
        let document = with(dome).expect("a curve");
        assert!(document.notices().is_empty(), "{:?}", document.notices());
        assert_eq!(
            document.to_json_compact(),
            r#"{"fabrica":1,"templates":[{"kind":"wave","size":[0.5,0.5,0.1],"curve":{"points":[[0,0.5],[0.5,1],[1,0.5]]}}]}"#
        );
        assert!(drawn(dome).curve.is_some_and(|curve| curve.is_spline));
        // Nothing is nothing, and is left out.
        for empty in ["{}", r#"{"points":[]}"#] {
            assert_eq!(drawn(empty).curve, None);
            assert!(
                !with(empty)
                    .expect("a document")
                    .to_json_compact()
                    .contains("curve")
            );
        }
        // What has another shape is refused by its place.
        for (curve, place) in [
            ("3", "/templates/0/curve"),
            (r#"{"points":3}"#, "/templates/0/curve/points"),
            (r#"{"points":[[0,1],[1]]}"#, "/templates/0/curve/points/1"),
            (
                r#"{"points":[[0,1],[1,"x"]]}"#,
                "/templates/0/curve/points/1/1",
            ),
            (
                r#"{"points":[[0,1],[1,1e999]]}"#,
                "/templates/0/curve/points/1/1",
            ),
            (
                r#"{"points":[[0,1],[1,1]],"spline":1}"#,
                "/templates/0/curve/spline",
            ),
        ] {
            let error = with(curve).expect_err(curve).to_string();
            assert!(error.contains(place), "{curve}: {error}");
        }
        // What cannot be bent is named and drawn straight.
        let many = format!(r#"{{"points":[{}[1,1]]}}"#, "[0,1],[0.5,1.1],".repeat(5000));
        for (curve, word) in [
            (r#"{"points":[[0,1]]}"#, "two points"),
            (r#"{"points":[[0.5,1],[0.5,1],[0.5,1]]}"#, "two points"),
            (
                r#"{"points":[[0,1],[1,1],[0,1]],"spline":false}"#,
                "turns back",
            ),
            (many.as_str(), "first 9"),
            (r#"{"points":[[0,1],[1e30,-1e30]]}"#, "outside the range"),
        ] {
            let said = said(curve).join("; ");
            assert!(said.contains(word), "{said}");
            assert!(said.contains("/templates/0/curve/points"), "{said}");
            let template = drawn(curve);
            assert!(template.subject_from_template(Vec3::splat(0.3)).is_finite());
        }
        assert!(
            drawn(r#"{"points":[[0,1],[1,1],[0,1]],"spline":false}"#)
                .bent()
                .is_none()
        );
        let gentle = r#"{"points":[[0,0.9],[0.5,1],[1,0.9]]}"#;
        assert!(said(gentle).is_empty(), "{:?}", said(gentle));
        let folded = r#"{"points":[[0.45,0.2],[0.5,1],[0.55,0.2]]}"#;
        assert!(
            said(folded)[0].contains("more sharply"),
            "{:?}",
            said(folded)
        );
    }

    #[test]
    fn a_curve_is_edited_mirrored_and_eased() {
        let document = Document::from_json(
            r#"{"fabrica":1,"templates":[{"kind":"poke","at":[0.2,0,0],"curve":{"points":[[0,0.5],[0.4,1],[1,0.8]]}},{"kind":"peel"}],
                "steps":[{"set":{"/templates/0/curve/points/1/1":1.4}},{"set":{"/templates/1/curve":{"points":[[0,0.6],[1,1]]}}}]}"#,
        )
        .expect("a document");
        let half = document.at_time(1, 0.5).expect("half of the way");
        let points = &half.templates[0].curve.as_ref().expect("a curve").points;
        assert!((points[1].y - 1.2).abs() < 1e-6, "{points:?}");
        let half = document.at_time(2, 0.5).expect("half of the way");
        let points = &half.templates[1].curve.as_ref().expect("a curve").points;
        assert!(
            (points[0].y - 0.8).abs() < 1e-6,
            "from straight: {points:?}"
        );

        let template = &document.illustration().templates[0];
        let edits = mirror(template, Plane::Sagittal, true);
        let copied = edits
            .iter()
            .try_fold(document.clone(), |d, edit| edit.apply(&d));
        let copied = copied.expect("it is mirrored");
        let other = &copied.illustration().templates[1];
        for q in [
            Vec3::ZERO,
            Vec3::new(0.3, 0.4, 1.2),
            Vec3::new(1.1, 0.2, 0.6),
        ] {
            let here = template.subject_from_template(q);
            let there = other.subject_from_template(Vec3::new(1.0 - q.x, q.y, q.z));
            assert!(
                (here * Vec3::new(-1.0, 1.0, 1.0) - there).length() < 1e-3,
                "{here} {there}"
            );
        }
        let straight = Edit::SetCurve {
            template: 0,
            curve: None,
        };
        assert_eq!(straight.name(&document), "Straighten poke");
        let straight = straight.apply(&document).expect("straight");
        assert_eq!(straight.get("/templates/0/curve"), None);
        let again = Edit::SetCurve {
            template: 0,
            curve: template.curve.clone(),
        };
        let again = again.apply(&straight).expect("bent again");
        assert_eq!(again.illustration().templates[0].curve, template.curve);
    }

    #[test]
    fn a_part_of_a_cut_lies_along_the_same_curve() {
        for shape in ["box", "sphere"] {
            let document = Document::from_json(&format!(
                r#"{{"fabrica":1,"templates":[{{"kind":"cut","amount":0.4,"params":{{"shape":"{shape}"}},"size":[0.6,0.3,0.2],
                    "curve":{{"points":[[0,0.6],[0.5,1],[1,0.7]]}}}}]}}"#
            ))
            .expect("a document");
            let whole = &document.illustration().templates[0];
            let part = whole.acting();
            for own in [Vec3::new(0.2, 0.3, 0.4), Vec3::new(0.9, 0.1, 1.0)] {
                // The same place of the box, in the smaller one.
                let inner = match shape {
                    "box" => Vec3::new(own.x, own.y, 1.0 + (own.z - 1.0) / 0.4),
                    _ => 0.5 + (own - 0.5) / 0.4,
                };
                let (a, b) = (
                    whole.subject_from_template(own),
                    part.subject_from_template(inner),
                );
                assert!((a - b).length() < 1e-5, "{shape}: {a} {b}");
            }
        }
    }
}
