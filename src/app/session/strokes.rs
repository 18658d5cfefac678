//! The strokes of a clay that are there: hidden, moved in their list, and changed in their ways and tools. Those behind
//! what is changed are done again.

use glam::{Quat, Vec3};

use super::clay::{STROKES, StrokeChange};
use super::gesture::{degrees, thousandths};
use super::session::Session;
use super::shaping::used_tools;
use crate::document::{ClayStroke, Edit};

impl Session {
    /// Hides the stroke of this index, or shows it again.
    pub(super) fn switch_stroke(&mut self, index: usize) {
        let stroke = self.clay().and_then(|clay| clay.strokes.get(index));
        let Some(stroke) = stroke else {
            return;
        };
        let value = (!stroke.is_off).then_some(serde_json::Value::Bool(true));
        let name = match stroke.is_off {
            true => "Show stroke",
            false => "Hide stroke",
        };
        let pointer = format!("{STROKES}/{index}/off");
        self.apply(&Edit::put(pointer, value, name.to_owned()), false);
    }

    /// The edit that puts a stroke elsewhere among the others. The entries between the two places are written anew as
    /// they stand in the document: how many of them are shown stays as it is.
    pub(super) fn moved_stroke(&self, from: usize, to: usize) -> Option<Edit> {
        let mut list = self.document().get(STROKES)?.as_array()?.clone();
        if from.max(to) >= list.len() {
            return None;
        }
        let stroke = list.remove(from);
        list.insert(to, stroke);
        let name = "Move stroke".to_owned();
        let entries = list.into_iter().enumerate();
        let changed = entries.filter(|(i, _)| (from.min(to)..=from.max(to)).contains(i));
        let edits = changed.map(|(i, value)| Edit::Set {
            pointer: format!("{STROKES}/{i}"),
            value,
            name: name.clone(),
        });
        let edits = edits.collect();
        Some(Edit::All { name, edits })
    }

    /// Changes a tool of a stroke or its mirror images, as a part of a drag or as one step of undo. Other ways that use
    /// the same tool keep it.
    pub(super) fn change_stroke(&mut self, index: usize, change: StrokeChange, is_drag: bool) {
        let Some(clay) = self.clay().cloned() else {
            return;
        };
        let Some(mut stroke) = clay.strokes.get(index).cloned() else {
            return;
        };
        let mut edits = Vec::new();
        match change {
            StrokeChange::Mirror(mirror) if self.has_room_for(stroke.moves.len(), mirror) => {
                stroke.mirror = mirror;
            }
            StrokeChange::Mirror(_) => return,
            StrokeChange::Tool(way, tool) => {
                let Some(one) = stroke.moves.get_mut(way) else {
                    return;
                };
                let used = used_tools(&clay, |i, j| (i, j) != (index, way));
                let Some((places, list)) = self.places_of_tools(&clay, used, &[tool]) else {
                    return self.tell_of_many_tools();
                };
                one.tool = places[0];
                edits.extend(list);
            }
        }
        edits.push(changed(index, &stroke));
        let name = CHANGE.to_owned();
        self.apply(&Edit::All { name, edits }, is_drag);
    }
}

/// What a change of a stroke is called.
const CHANGE: &str = "Change stroke";

/// A stroke with a key of one of its tools elsewhere, subject space; the edit is of the stroke of this index.
pub fn with_key_at(
    index: usize,
    stroke: &ClayStroke,
    (one, key): (usize, usize),
    pos: Vec3,
) -> Edit {
    let mut new = stroke.clone();
    if let Some(key) = new.moves.get_mut(one).and_then(|one| one.keys.get_mut(key)) {
        key.at = thousandths(pos);
    }
    changed(index, &new)
}

/// A stroke without a key of one of its tools; `None` for the last one, as a path has one at least. Its turn goes on to
/// the next key, so that what is behind stays as it was.
pub fn without_key(index: usize, stroke: &ClayStroke, (one, key): (usize, usize)) -> Option<Edit> {
    let mut new = stroke.clone();
    let keys = &mut new.moves.get_mut(one)?.keys;
    if keys.len() < 2 || key >= keys.len() {
        return None;
    }
    let gone = keys.remove(key).turn;
    if let Some(next) = keys.get_mut(key) {
        next.turn = both_turns(gone, next.turn);
    }
    Some(changed(index, &new))
}

/// A turn and then another, degrees about the axes of the subject. About one axis they add up, beyond half a turn too.
fn both_turns(first: [i32; 3], second: [i32; 3]) -> [i32; 3] {
    let [a, b] = [first, second].map(|turn| Vec3::from_array(turn.map(|x| x as f32)));
    if a.cross(b) == Vec3::ZERO {
        return (a + b).as_ivec3().to_array();
    }
    let [a, b] = [a, b].map(|turn| Quat::from_scaled_axis(turn * (std::f32::consts::PI / 180.0)));
    degrees(b * a)
}

fn changed(index: usize, stroke: &ClayStroke) -> Edit {
    Edit::Set {
        pointer: format!("{STROKES}/{index}"),
        value: stroke.to_value(),
        name: CHANGE.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::session::{ClayCommand, Command};
    use crate::document::{Clay, ClayKey, ClayMove, ClayTool, Document, SubjectRef, ToolShape};
    use std::sync::Arc;

    #[test]
    fn a_key_goes_and_what_is_behind_it_stays() {
        let key = |turn| ClayKey {
            at: [0; 3],
            turn,
            percent: 100,
        };
        let turned = |turns: &[[i32; 3]]| ClayStroke {
            moves: vec![ClayMove {
                tool: 0,
                keys: turns.iter().map(|turn| key(*turn)).collect(),
                is_straight: true,
            }],
            mirror: [false; 3],
            smooth: None,
            is_off: false,
        };
        let left = |stroke: &ClayStroke, gone: usize| match without_key(3, stroke, (0, gone)) {
            Some(Edit::Set { pointer, value, .. }) => {
                assert_eq!(pointer, "/subject/clay/strokes/3");
                value["turns"].to_string()
            }
            other => panic!("{other:?}"),
        };
        let about_z = turned(&[[0; 3], [0, 0, 120], [0, 0, 100]]);
        assert_eq!(left(&about_z, 1), "[0,0,0,0,0,220]");
        let about_both = turned(&[[90, 0, 0], [0, 90, 0]]);
        // Half way between the axes, a third of a turn.
        assert_eq!(left(&about_both, 0), "[69,69,-69]");
        assert_eq!(without_key(0, &turned(&[[0; 3]]), (0, 0)), None);
        assert_eq!(without_key(0, &about_z, (0, 7)), None);
        assert_eq!(without_key(0, &about_z, (1, 0)), None);
    }

    #[test]
    fn a_stroke_goes_elsewhere_and_as_many_are_shown() {
        let json = r#"{ "fabrica": 1, "subject": { "clay": { "strokes": [
            { "path": [0, 0, 400, 0, 0, 100] }, { "path": [1, 2, 3], "do": "carve", "x-deep": 7 },
            { "path": [0, 0, -400, 0, 0, -100] }] } },
            "look": { "strokes": 1 }, "steps": [{ "set": { "/look/strokes": 2 } }] }"#;
        let mut session = Session::new(Document::from_json(json).expect("a document"));
        let before = session.document().to_json_compact();
        session.run(Command::Clay(ClayCommand::Select(0)), 0.0);
        // The last one stands on top of the list.
        session.run(Command::ShiftSelected(1), 0.0);
        assert_eq!(session.selection.stroke(), Some(0), "it is the lowest");
        session.run(Command::ShiftSelected(-1), 0.0);
        assert_eq!(session.selection.stroke(), Some(1));
        let listed = |session: &Session| session.document().get(STROKES).cloned();
        let strokes = listed(&session).expect("strokes");
        assert_eq!(strokes[0]["x-deep"], 7);
        assert_eq!(strokes[1]["path"][2], 400);
        assert_eq!(session.strokes_shown(), 1);
        let written = session.document().to_json_compact();
        assert!(written.contains(r#""/look/strokes":2"#), "{written}");
        session.run(Command::Undo, 0.0);
        assert_eq!(session.document().to_json_compact(), before);
    }
    /// Two strokes by the first of two tools, one by both.
    const SHARED: &str = r#"{ "fabrica": 1, "subject": { "clay": { "tools": [{ "radius": 0.15 }, { "radius": 0.2 }],
        "strokes": [{ "path": [0, 0, 400, 0, 0, 100] }, { "path": [0, 400, 0, 0, 100, 0], "mirror": "x" },
            { "path": [0, 0, -400, 0, 0, -100], "with": [{ "tool": 1, "path": [400, 0, 0, 100, 0, 0] }] }] } } }"#;

    fn change(session: &mut Session, stroke: usize, change: StrokeChange, is_drag: bool) {
        let command = ClayCommand::Change {
            stroke,
            change,
            is_drag,
        };
        session.run(Command::Clay(command), 0.0);
    }

    fn ball(radius: f32) -> ClayTool {
        ClayTool {
            shape: Some(ToolShape::Ball { radius }),
            coat: 0.1,
        }
    }

    fn clay(session: &Session) -> &Clay {
        session.clay().expect("a clay")
    }

    /// The tools of the ways of each stroke.
    fn tools(session: &Session) -> Vec<Vec<&ClayTool>> {
        let clay = clay(session);
        let of = |stroke: &ClayStroke| {
            let moves = stroke.moves.iter();
            moves.map(|one| &clay.tools[one.tool]).collect()
        };
        clay.strokes.iter().map(of).collect()
    }

    #[test]
    fn a_changed_tool_is_that_of_one_way_alone() {
        let mut session = Session::new(Document::from_json(SHARED).expect("a document"));
        let before = session.document().clone();
        // A drag is one step of undo, and takes one place in the list of tools.
        for radius in [0.16, 0.2, 0.25, 0.3] {
            change(&mut session, 1, StrokeChange::Tool(0, ball(radius)), true);
        }
        session.end_drag();
        let [shared, other, new] = [0.15, 0.2, 0.3].map(ball);
        assert_eq!(
            tools(&session),
            [vec![&shared], vec![&new], vec![&shared, &other]]
        );
        assert_eq!(clay(&session).tools.len(), 3);
        // The other way of the last stroke keeps its tool.
        let coated = ClayTool {
            coat: 0.3,
            ..other.clone()
        };
        change(
            &mut session,
            2,
            StrokeChange::Tool(1, coated.clone()),
            false,
        );
        assert_eq!(tools(&session)[2], [&shared, &coated]);
        assert_eq!(clay(&session).tools.len(), 3, "in place of the one before");
        session.run(Command::Undo, 0.0);
        session.run(Command::Undo, 0.0);
        assert_eq!(*session.document(), before);
        // What is not there is not changed.
        change(&mut session, 7, StrokeChange::Tool(0, ball(0.3)), false);
        change(&mut session, 0, StrokeChange::Tool(7, ball(0.3)), false);
        assert_eq!(*session.document(), before);
    }

    #[test]
    fn mirror_images_of_a_stroke_are_switched_as_far_as_there_is_room() {
        let mut session = Session::new(Document::from_json(SHARED).expect("a document"));
        change(
            &mut session,
            1,
            StrokeChange::Mirror([false, true, true]),
            false,
        );
        assert_eq!(clay(&session).strokes[1].mirror, [false, true, true]);
        session.run(Command::Undo, 0.0);
        assert_eq!(clay(&session).strokes[1].mirror, [true, false, false]);
        assert_eq!(session.notices.shown().count(), 0);
        change(&mut session, 2, StrokeChange::Mirror([true; 3]), false);
        assert_eq!(
            clay(&session).strokes[2].mirror,
            [false; 3],
            "sixteen tools"
        );
        assert_eq!(session.notices.shown().count(), 1);
    }

    #[test]
    fn a_clay_that_has_all_its_tools_says_so() {
        let radius = |i: usize| 0.1 + 0.01 * i as f32;
        let tools = (0..Clay::MAX_TOOLS).map(|i| ball(radius(i)));
        let stroke = |tool: usize| ClayStroke {
            moves: vec![ClayMove {
                tool,
                keys: vec![ClayKey {
                    at: [0; 3],
                    turn: [0; 3],
                    percent: 100,
                }],
                is_straight: false,
            }],
            mirror: [false; 3],
            smooth: None,
            is_off: false,
        };
        let full = Clay {
            tools: tools.collect(),
            strokes: (0..Clay::MAX_TOOLS).chain([0]).map(stroke).collect(),
            ..Clay::default()
        };
        let mut session = Session::new(Document::new());
        let subject = SubjectRef::Clay(Arc::new(full));
        session.apply(&Edit::SetSubject(subject), false);
        let last = Clay::MAX_TOOLS;
        change(&mut session, last, StrokeChange::Tool(0, ball(0.9)), false);
        assert_eq!(clay(&session).strokes[last].moves[0].tool, 0);
        assert_eq!(session.notices.shown().count(), 1);
        // One that the clay has, or whose place no other way holds, is no more of them.
        change(
            &mut session,
            last,
            StrokeChange::Tool(0, ball(radius(3))),
            false,
        );
        assert_eq!(clay(&session).strokes[last].moves[0].tool, 3);
        change(&mut session, 5, StrokeChange::Tool(0, ball(0.9)), false);
        assert_eq!(clay(&session).tools[5], ball(0.9));
        assert_eq!(session.notices.shown().count(), 1);
    }
}
