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
        /// By how much, template units.
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
                "{template}: control point {point} is missed by {by:.4} of the box, for another point that stands at its place is met"
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
