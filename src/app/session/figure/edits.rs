use glam::{DVec2, Vec2};
use serde_json::{Value, json};

use crate::app::session::session::Session;
use crate::document::figure::{Handle, Hold, Rigidity};
use crate::document::{Edit, FigureList};
use crate::math::round_to;

/// A key of a handle with its value.
#[derive(Clone, Debug, PartialEq)]
pub enum HandleKey {
    /// Where it takes what it holds, by how much.
    Move(DVec2),
    /// By which angle, radians; none: open.
    Turn(Option<f64>),
    /// By which factor.
    Scale(f64),
    /// What it holds around its point or line, subject units.
    Radius(f64),
    /// Whether it acts.
    Enabled(bool),
    /// Its name; empty for none.
    Name(String),
    /// Where the points of a line go.
    To(Vec<Vec2>),
}

/// A place as a document has it: to four decimals.
pub(super) fn rounded(at: DVec2) -> Value {
    json!(at.to_array().map(|x| round_to(x, 4)))
}

pub(super) fn rounded_places(places: &[Vec2]) -> Value {
    places.iter().map(|at| rounded(at.as_dvec2())).collect()
}

/// The rigidity as a document has it.
pub(super) fn rigidity_value(rigidity: Rigidity) -> Value {
    match rigidity {
        Rigidity::Rigid => json!("rigid"),
        Rigidity::Elastic([x, y]) if x == y => json!(round_to(x, 2)),
        Rigidity::Elastic(both) => json!(both.map(|k| round_to(k, 2))),
    }
}

/// Sets a key of the figure itself, or puts it back to its default.
pub fn figure_edit(key: &str, value: Option<Value>) -> Edit {
    let pointer = format!("/figure/{key}");
    Edit::put(pointer, value, "Change figure".to_owned())
}

/// Sets a key of a region by its name. A region of the source that the document does not list yet is listed first, for
/// all steps; its key is set at the step that is shown.
pub fn region_edit(session: &Session, name: &str, key: &str, value: Value) -> Edit {
    let listed = index_of(session, name);
    let added = Edit::AddToFigure {
        list: FigureList::Regions,
        index: usize::MAX,
        entry: json!({ "name": name }),
    };
    let mut edits: Vec<Edit> = listed.is_none().then_some(added).into_iter().collect();
    let index = listed.unwrap_or(session.listed_regions().len());
    edits.push(Edit::Set {
        pointer: format!("/figure/regions/{index}/{key}"),
        value,
        name: "Change region".to_owned(),
    });
    Edit::All {
        name: "Change region".to_owned(),
        edits,
    }
}

/// Sets the rigidity of a region.
pub fn rigidity_edit(session: &Session, name: &str, rigidity: Rigidity) -> Edit {
    region_edit(session, name, "rigidity", rigidity_value(rigidity))
}

/// Where a region stands in the document's list.
pub(super) fn index_of(session: &Session, name: &str) -> Option<usize> {
    let mut regions = session.listed_regions().iter();
    regions.position(|region| region.name == name)
}

/// Sets a key of a handle.
pub fn handle_edit(index: usize, key: HandleKey) -> Edit {
    let (key, value) = match key {
        HandleKey::Move(by) => ("move", rounded(by)),
        HandleKey::Turn(turn) => ("turn", turn.map_or(Value::Null, |x| json!(round_to(x, 4)))),
        HandleKey::Scale(scale) => ("scale", json!(round_to(scale, 4))),
        HandleKey::Radius(radius) => ("radius", json!(round_to(radius, 4))),
        HandleKey::Enabled(enabled) => ("enabled", json!(enabled)),
        HandleKey::Name(name) => ("name", json!(name)),
        HandleKey::To(places) => ("to", rounded_places(&places)),
    };
    Edit::Set {
        pointer: format!("/figure/handles/{index}/{key}"),
        value,
        name: "Change handle".to_owned(),
    }
}

/// What brings a handle back to where it holds the figure at rest.
pub(super) fn handle_rest(index: usize, handle: &Handle) -> Edit {
    let mut edits = Vec::new();
    match &handle.hold {
        Hold::Line {
            points,
            to: Some(_),
        } => {
            let places: Vec<Vec2> = points.iter().map(|point| point.as_vec2()).collect();
            edits.push(handle_edit(index, HandleKey::To(places)));
        }
        hold => {
            edits.push(handle_edit(index, HandleKey::Move(DVec2::ZERO)));
            edits.push(handle_edit(index, HandleKey::Scale(1.0)));
            if handle.motion.turn.is_some() {
                let open = matches!(hold, Hold::Point(_));
                let turn = (!open).then_some(0.0);
                edits.push(handle_edit(index, HandleKey::Turn(turn)));
            }
        }
    }
    Edit::All {
        name: "Put handles back".to_owned(),
        edits,
    }
}
