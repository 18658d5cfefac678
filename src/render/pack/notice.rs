//! What the renderer has to say about a document or a subject.

use std::fmt;

use crate::data::Reduction;
use crate::document::PlacedTemplate;
use crate::placed::missed_points;

/// What the renderer has to say. Displayed, it is one line in plain words.
#[derive(Clone, Debug, PartialEq)]
pub enum RenderNotice {
    /// `keep` of a template names a segment that the subject does not have; nothing is kept for it.
    UnknownKept(String),
    /// `look.segments` names a segment that the subject does not have.
    UnknownBody(String),
    /// A segment of a mesh that is to be solid is open; a lid closes it.
    Lid(String),
    /// A control point of an `rbf` that the map misses.
    MissedPoint {
        /// Name of the template, or its kind where it has none.
        template: String,
        /// Which of its points, from 1.
        point: usize,
        /// By how much, subject units.
        by: f32,
    },
    /// The meshes beside a volume do not fit on the device, and why.
    MeshesTooLarge(String),
    /// The volume is larger than the device takes, and is drawn coarser.
    Reduced(Reduction),
}

impl fmt::Display for RenderNotice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::UnknownKept(name) => write!(
                f,
                "keep: the subject has no segment “{name}”; nothing is kept for it"
            ),
            Self::UnknownBody(name) => write!(f, "look: the subject has no segment “{name}”"),
            Self::Lid(name) => write!(f, "look: “{name}” is open; a lid closes its solid body"),
            Self::MissedPoint {
                template,
                point,
                by,
            } => write!(
                f,
                "{template}: control point {point} is missed by {by:.4} subject units, for another point that stands at its place is met"
            ),
            Self::MeshesTooLarge(why) => {
                write!(f, "the meshes beside the scan are not drawn: {why}")
            }
            Self::Reduced(reduction) => reduction.fmt(f),
        }
    }
}

/// A notice for each control point that the map of an enabled template misses.
pub fn missed_notices(templates: &[PlacedTemplate]) -> Vec<RenderNotice> {
    let enabled = templates.iter().filter(|template| template.enabled);
    let each = enabled.flat_map(|template| {
        let name = match template.name.as_str() {
            "" => template.kind.spec().name,
            name => name,
        };
        let missed = missed_points(template).into_iter();
        missed.map(move |missed| RenderNotice::MissedPoint {
            template: name.to_owned(),
            point: missed.point + 1,
            by: missed.by,
        })
    });
    each.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::Document;

    fn notices(template: &str) -> Vec<String> {
        let json = format!(r#"{{ "fabrica": 1, "templates": [{template}] }}"#);
        let document = Document::from_json(&json).expect("a good document");
        let said = missed_notices(&document.illustration().templates).into_iter();
        said.map(|notice| notice.to_string()).collect()
    }

    /// Three points, of which the second is moved 0.1 along z where the first stays.
    fn contradicting(head: &str, params: &str) -> Vec<String> {
        notices(&format!(
            r#"{{ "kind": "rbf", {head} "params": {{ {params} "points": [{{ "at": [0.5, 0.5, 0.5] }},
                {{ "at": [0.5, 0.5, 0.5], "move": [0, 0, 0.1] }}, {{ "at": [0.2, 0.2, 0.2] }}] }} }}"#
        ))
    }

    #[test]
    fn a_missed_control_point_is_named_with_the_miss() {
        let said = |name: &str, by: &str| {
            vec![format!(
                "{name}: control point 2 is missed by {by} subject units, for another point that stands at its place is met"
            )]
        };
        let cube = r#""size": [1, 1, 1],"#;
        assert_eq!(contradicting(cube, ""), said("rbf", "0.1000"));
        let named = format!(r#"{cube} "name": "the lid","#);
        assert_eq!(contradicting(&named, ""), said("the lid", "0.1000"));
        // By what the picture misses: in the units of the subject, by the strength and by the share of it that acts.
        let flat = r#""size": [1, 1, 0.4],"#;
        assert_eq!(contradicting(flat, ""), said("rbf", "0.0400"));
        let strong = r#""strength": 1.5,"#;
        assert_eq!(contradicting(cube, strong), said("rbf", "0.1500"));
        let half = format!(r#"{cube} "amount": 0.5,"#);
        assert_eq!(contradicting(&half, strong), said("rbf", "0.0750"));
        // Where nothing acts nothing is missed, nor where the points agree.
        let off = format!(r#"{cube} "enabled": false,"#);
        assert_eq!(contradicting(&off, ""), Vec::<String>::new());
        let none = r#""strength": 0,"#;
        assert_eq!(contradicting(cube, none), Vec::<String>::new());
        let alike = r#"{ "kind": "rbf", "size": [1, 1, 1], "params": { "points": [
            { "at": [0.5, 0.5, 0.5], "move": [0, 0, 0.1] }, { "at": [0.5, 0.5, 0.5], "move": [0, 0, 0.1] }] } }"#;
        assert_eq!(notices(alike), Vec::<String>::new());
    }
}
