//! Shaping a clay by hand: what a drag over it becomes. A gesture is one stroke of the recipe, thinned to few keys, and
//! one step of undo.

use std::sync::Arc;

use super::clay::{ClayCommand, Ghost, STROKES};
use super::gesture::{Gesture, gesture};
use super::hand::{HeldTool, StrokeWay, Touch};
use super::notices::Gravity;
use super::selection::Selection;
use super::session::Session;
use super::tool::Tool;
use crate::app::words::clay::w;
use crate::app::words::fill;
use crate::document::{
    Camera, Clay, ClayMove, ClayStart, ClayStroke, ClayTool, ClayVolume, Edit, MeshRef, Reading,
    SubjectRef, ToolShape, VoxelPart, VoxelSource,
};

/// Where the tools of a clay stand in a document.
const TOOLS: &str = "/subject/clay/tools";

impl Session {
    /// The clay of the document, if its subject is one.
    pub fn clay(&self) -> Option<&Arc<Clay>> {
        match &self.illustration().subject {
            SubjectRef::Clay(clay) => Some(clay),
            _ => None,
        }
    }

    /// The stroke of the clay that is selected, with its index.
    pub fn selected_stroke(&self) -> Option<(usize, &ClayStroke)> {
        let index = self.selection.stroke()?;
        Some((index, self.clay()?.strokes.get(index)?))
    }

    /// How many strokes of the clay are shown.
    pub fn strokes_shown(&self) -> usize {
        self.shown().strokes_shown().unwrap_or(0) as usize
    }

    pub(super) fn run_clay(&mut self, command: ClayCommand) {
        match command {
            ClayCommand::Begin(from) => {
                self.choose_subject(SubjectRef::Clay(Arc::new(Clay {
                    from,
                    ..Clay::default()
                })));
                self.take_clay_tool();
            }
            ClayCommand::Toggle if self.tool() == Tool::Clay => self.take_tool(Tool::Look),
            ClayCommand::Toggle => self.take_clay_tool(),
            ClayCommand::Bake => {
                let strokes = self.clay().map_or(0, |clay| clay.strokes.len());
                self.take_own_tool(
                    ToolShape::Clay {
                        strokes: strokes as u32,
                        longest: ToolShape::LONGEST,
                    },
                    "Bake the clay",
                );
            }
            ClayCommand::Together if self.tool() == Tool::Clay => self.toggle_together(),
            ClayCommand::Together => {}
            ClayCommand::LayOn(found) => self.lay_tool(found),
            ClayCommand::Put(pose) => self.put_laid(pose),
            ClayCommand::Act => self.act_together(),
            ClayCommand::MoveGhost([ghost, key], pos) => self.move_ghost((ghost, key), pos),
            ClayCommand::RemoveGhost(ghost) => self.remove_ghost(ghost),
            ClayCommand::Switch(index) => self.switch_stroke(index),
            ClayCommand::Remove(stroke) => {
                self.apply(&Edit::RemoveStroke { stroke }, false);
            }
            ClayCommand::Change {
                stroke,
                change,
                is_drag,
            } => self.change_stroke(stroke, change, is_drag),
            ClayCommand::Select(index) => self.select(Selection::Stroke(index)),
        }
    }

    /// What a clay of the subject that is shown begins with: of a mesh its file, of a volume the tissue of this name,
    /// or all from a value up where none is named. `None` if no clay can be made of that: of several meshes, of a
    /// figure, of a tissue that is painted or lies in a label volume of its own.
    pub fn clay_start(&self, tissue: Option<&str>, outer_value: f32) -> Option<ClayStart> {
        let shown = self.illustration();
        if !self.view.has_values() {
            return mesh_of(&shown.subject).map(ClayStart::Mesh);
        }
        let of = voxels_of(&shown.subject)?;
        let part = match tissue {
            None => VoxelPart::Iso(f64::from(outer_value)),
            Some(name) => match shown.recipes.iter().find(|recipe| recipe.name == name) {
                Some(recipe) => VoxelPart::Iso(f64::from(recipe.from.range()?[0])),
                None if matches!(of, VoxelSource::File { .. }) && !shown.segments.is_empty() => {
                    return None;
                }
                None => VoxelPart::Segment(name.to_owned()),
            },
        };
        Some(ClayStart::Volume(Box::new(ClayVolume {
            of,
            part,
            has_all_walls: false,
        })))
    }

    /// Puts a drawn curve, a mesh, or the clay as it stands, among the tools of the clay and takes it in hand: one step
    /// of undo.
    pub(super) fn take_own_tool(&mut self, shape: ToolShape, name: &str) {
        let Some(clay) = self.clay().cloned() else {
            return;
        };
        let hand = HeldTool {
            own: Some(shape),
            ..self.clay_hand.clone()
        };
        let used = used_tools(&clay, |_, _| true);
        let Some((_, tools)) = self.places_of_tools(&clay, used, &[hand.tool()]) else {
            return self.tell_of_many_tools();
        };
        if let Some(edit) = tools {
            let (name, edits) = (name.to_owned(), vec![edit]);
            self.apply(&Edit::All { name, edits }, false);
        }
        self.clay_hand = hand;
        if self.tool() != Tool::Clay {
            self.take_clay_tool();
        }
    }

    pub(super) fn tell_of_many_tools(&mut self) {
        let text = fill(w().too_many_tools, &[&Clay::MAX_TOOLS]);
        self.notify(Gravity::Info, text, "");
    }

    /// Takes the tool in hand that shapes the clay. Strokes come after those that are there, so that all have to be
    /// seen.
    fn take_clay_tool(&mut self) {
        let Some(clay) = self.clay() else {
            return;
        };
        if self.strokes_shown() < clay.strokes.len() {
            return self.notify(Gravity::Info, w().show_all_first, "");
        }
        self.end_tissues();
        self.selection = Selection::Nothing;
        self.drawn_stroke = None;
        self.take_tool(Tool::Clay);
    }

    /// Takes the way of a hand that shapes the clay. The whole gesture is one step of undo. While strokes are laid down
    /// it is a ghost in the end.
    pub(super) fn draw_stroke(&mut self, way: StrokeWay, touches: &[Touch], is_over: bool) {
        let tool = self.tool_in_hand();
        let stroke = stroke(&self.clay_hand, way, touches, &self.camera);
        if self.together.is_on && way != StrokeWay::Smooth {
            let way = stroke.and_then(|stroke| stroke.moves.into_iter().next());
            if let Some(way) = way.filter(|_| is_over) {
                self.lay_ghost(Ghost { tool, way });
            }
            return;
        }
        match stroke {
            Some(stroke) => {
                self.put_stroke(stroke, &[tool], is_over);
            }
            None => self.drawn_stroke = self.drawn_stroke.filter(|_| !is_over),
        }
    }

    /// Puts a stroke in place of the one that is being drawn, or behind the others; its moves name tools by their
    /// places in this list. True if the document took it.
    pub(super) fn put_stroke(
        &mut self,
        mut stroke: ClayStroke,
        tools: &[ClayTool],
        is_over: bool,
    ) -> bool {
        let drawn = self.drawn_stroke.take();
        let Some(clay) = self.clay().cloned() else {
            return false;
        };
        let index = drawn.unwrap_or(clay.strokes.len());
        let used = used_tools(&clay, |stroke, _| stroke != index);
        let Some((places, list)) = self.places_of_tools(&clay, used, tools) else {
            self.tell_of_many_tools();
            return false;
        };
        for one in &mut stroke.moves {
            one.tool = places[one.tool];
        }
        let mut edits: Vec<Edit> = list.into_iter().collect();
        let value = stroke.to_value();
        if drawn.is_none() {
            edits.push(Edit::AddStroke { index, stroke });
        }
        let name = "Draw a stroke".to_owned();
        edits.push(Edit::Set {
            pointer: format!("{STROKES}/{index}"),
            value,
            name: name.clone(),
        });
        let is_done = self.apply(&Edit::All { name, edits }, true);
        self.drawn_stroke = (is_done && !is_over).then_some(index);
        if is_over {
            self.end_drag();
        }
        is_done
    }

    /// The tool in hand, for the stroke to come. One that was made of strokes which are gone is put away.
    fn tool_in_hand(&mut self) -> ClayTool {
        let count = self.clay().map_or(0, |clay| clay.strokes.len());
        let next = self.drawn_stroke.unwrap_or(count);
        if !self.clay_hand.tool().is_made_before(next) {
            self.clay_hand.own = None;
        }
        self.clay_hand.tool()
    }

    /// The places of tools in the clay's list, and the edit that puts those there that have none yet: in place of some
    /// that are not among those used, or behind the others. A curve, a mesh and a baked clay give way to what has their
    /// form alone. `None` if all places are taken.
    pub(super) fn places_of_tools(
        &self,
        clay: &Clay,
        mut used: Vec<usize>,
        tools: &[ClayTool],
    ) -> Option<(Vec<usize>, Option<Edit>)> {
        let listed = self.document().get(TOOLS).and_then(|list| list.as_array());
        let own = || clay.tools.iter().map(ClayTool::to_value).collect();
        let mut list: Vec<serde_json::Value> = listed.cloned().unwrap_or_else(own);
        let mut held = clay.tools.clone();
        let mut places = Vec::with_capacity(tools.len());
        for tool in tools {
            let known = held.iter().position(|other| other == tool);
            let gives_way = |shape: &ToolShape| {
                let new = tool.shape.as_ref();
                HeldTool::has_plain_form(shape) || new.is_some_and(|new| new.has_form_of(shape))
            };
            let is_free =
                |i: &usize| held[*i].shape.as_ref().is_some_and(gives_way) && !used.contains(i);
            let free = || (0..held.len()).find(is_free);
            let index = known.or_else(free).unwrap_or(held.len());
            if index >= Clay::MAX_TOOLS {
                return None;
            }
            if known.is_none() {
                put(&mut held, index, tool.clone());
                put(&mut list, index, tool.to_value());
            }
            used.push(index);
            places.push(index);
        }
        let edit = (held != clay.tools).then(|| Edit::Set {
            pointer: TOOLS.to_owned(),
            value: list.into(),
            name: String::new(),
        });
        Some((places, edit))
    }
}

/// The places of the tools that ways of strokes use: of those ways alone that are asked about, by the index of their
/// stroke and their own.
pub(super) fn used_tools(clay: &Clay, is_asked: impl Fn(usize, usize) -> bool) -> Vec<usize> {
    let strokes = clay.strokes.iter().enumerate();
    let ways = strokes.flat_map(|(i, stroke)| {
        let moves = stroke.moves.iter().enumerate();
        moves.map(move |(j, one)| ((i, j), one.tool))
    });
    let used = ways.filter(|((i, j), _)| is_asked(*i, *j));
    used.map(|(_, tool)| tool).collect()
}

/// Puts an entry into a list, in place of the one of this index or behind the others.
fn put<T>(list: &mut Vec<T>, index: usize, entry: T) {
    match list.get_mut(index) {
        Some(there) => *there = entry,
        None => list.push(entry),
    }
}

/// The stroke that a gesture is, by the first tool of a list; `None` where it has come to nothing yet.
fn stroke(
    hand: &HeldTool,
    way: StrokeWay,
    touches: &[Touch],
    camera: &Camera,
) -> Option<ClayStroke> {
    let Gesture { keys, is_straight } = gesture(hand, way, touches, camera)?;
    Some(ClayStroke {
        moves: vec![ClayMove {
            tool: 0,
            keys,
            is_straight,
        }],
        mirror: hand.mirror,
        smooth: (way == StrokeWay::Smooth).then_some(ClayStroke::DEFAULT_STRENGTH),
        is_off: false,
    })
}

/// The address and the hash of a subject's file, its name, and how it is read; `None` if it is no single file.
type File<'a> = (Option<String>, Option<String>, &'a String, &'a Reading);

fn file_of(subject: &SubjectRef) -> Option<File<'_>> {
    match subject {
        SubjectRef::Address {
            src,
            sha256,
            name,
            reading,
        } => Some((Some(src.clone()), sha256.clone(), name, reading)),
        SubjectRef::Supplied {
            sha256,
            name,
            reading,
        } => Some((None, Some(sha256.clone()), name, reading)),
        SubjectRef::Builtin { .. } | SubjectRef::Meshes { .. } | SubjectRef::Clay(_) => None,
    }
}

/// The file of a subject that is one mesh.
fn mesh_of(subject: &SubjectRef) -> Option<MeshRef> {
    if let SubjectRef::Meshes { meshes, .. } = subject {
        let [one] = meshes.as_slice() else {
            return None;
        };
        return Some(one.clone());
    }
    let (src, sha256, name, reading) = file_of(subject)?;
    Some(MeshRef {
        index: 0,
        src,
        sha256,
        name: name.clone(),
        reading: reading.mesh,
    })
}

/// Where the voxels of a subject come from, if it is a volume.
fn voxels_of(subject: &SubjectRef) -> Option<VoxelSource> {
    if let SubjectRef::Builtin { name, revision } = subject {
        let (name, revision) = (name.clone(), *revision);
        return Some(VoxelSource::Builtin { name, revision });
    }
    let (src, sha256, name, reading) = file_of(subject)?;
    Some(VoxelSource::File {
        src,
        sha256,
        name: name.clone(),
        reading: reading.clone(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::session::camera;
    use crate::app::session::shape::seen_across;
    use crate::app::session::{Command, Effect, HandCommand, See, Ticket};
    use crate::data::{Subject, Surface};
    use crate::document::{ClayShape, Document, TemplateKind, clay_to_text};
    use glam::Vec3;

    const UP: Touch = Touch {
        pos: Vec3::new(0.2, 0.0, 0.45),
        normal: Vec3::Z,
        force: None,
    };

    /// Touches along an arc in the plane of the picture.
    fn arc() -> Vec<Touch> {
        let touch = |i: usize| {
            let angle = 0.02 * i as f32;
            Touch {
                pos: UP.pos + 0.3 * Vec3::new(1.0 - angle.cos(), 0.0, angle.sin()),
                ..UP
            }
        };
        (0..60).map(touch).collect()
    }

    fn session() -> Session {
        let mut session = Session::new(Document::new());
        session.run(
            Command::Clay(ClayCommand::Begin(ClayStart::Shape(ClayShape::Ball))),
            0.0,
        );
        assert_eq!(session.tool(), Tool::Clay);
        session
    }

    fn draw(
        session: &mut Session,
        way: StrokeWay,
        touches: &[Touch],
        is_over: bool,
    ) -> Vec<Effect> {
        let touches = touches.to_vec();
        let command = HandCommand::Draw {
            way,
            touches,
            is_over,
        };
        session.run(Command::Hand(command), 0.0)
    }

    fn strokes(session: &Session) -> &[ClayStroke] {
        &session.clay().expect("a clay").strokes
    }

    #[test]
    fn a_gesture_is_one_stroke_and_one_step_of_undo() {
        let mut session = session();
        let way = arc();
        for end in [5, 20, 40] {
            draw(&mut session, StrokeWay::Move, &way[..end], false);
            assert_eq!(strokes(&session).len(), 1);
        }
        draw(&mut session, StrokeWay::Move, &way, true);
        let [stroke] = strokes(&session) else {
            panic!("one stroke")
        };
        assert_eq!(stroke.mirror, [true, false, false]);
        let keys = &stroke.moves[0].keys;
        assert!((3..8).contains(&keys.len()), "{} keys", keys.len());
        assert_eq!(keys[0].at, [200, 0, 450]);
        draw(&mut session, StrokeWay::Move, &way, true);
        assert_eq!(strokes(&session).len(), 2);
        session.run(Command::Undo, 0.0);
        assert_eq!(strokes(&session).len(), 1);
        session.run(Command::Undo, 0.0);
        assert!(strokes(&session).is_empty());
        session.run(Command::Redo, 0.0);
        assert_eq!(strokes(&session).len(), 1);
    }

    #[test]
    fn a_command_makes_the_coating_wider_and_thinner() {
        let mut session = session();
        let before = session.hand().coat;
        let mut coat = |is_wider: bool| {
            session.run(Command::Hand(HandCommand::Recoat(is_wider)), 0.0);
            session.hand().coat
        };
        assert!(coat(true) > 1.1 * before);
        assert!((coat(false) - before).abs() < 1e-3);
    }

    #[test]
    fn a_command_goes_through_the_ways_to_drag() {
        let mut session = session();
        let mut next = |is_next: bool| {
            session.run(Command::Hand(HandCommand::NextWay(is_next)), 0.0);
            session.hand().way
        };
        let forth = [StrokeWay::Push, StrokeWay::Along, StrokeWay::Turn];
        assert_eq!(forth.map(|_| next(true)), forth);
        let back = [StrokeWay::Along, StrokeWay::Push, StrokeWay::Move];
        assert_eq!(back.map(|_| next(false)), back);
        assert_eq!(
            [next(false), next(true)],
            [StrokeWay::Place, StrokeWay::Move]
        );
        // A sweep is not smoothed, and its tool not laid down.
        session.take_tool(Tool::Place(TemplateKind::Sweep));
        let mut seen = Vec::new();
        for _ in 0..6 {
            session.run(Command::Hand(HandCommand::NextWay(true)), 0.0);
            seen.push(session.hand().way);
        }
        assert_eq!(seen[5], StrokeWay::Move);
        assert!(!seen.contains(&StrokeWay::Smooth) && !seen.contains(&StrokeWay::Place));
        // With no tool in hand it is left as it was.
        session.take_tool(Tool::Look);
        session.run(Command::Hand(HandCommand::NextWay(true)), 0.0);
        assert_eq!(session.hand().way, StrokeWay::Move);
    }

    /// What a hand shapes is asked for as a sketch, and when the hand has left as it stays.
    #[test]
    fn a_drag_asks_for_sketches_and_its_end_for_the_clay() {
        let mut session = session();
        let shows = |session: &mut Session| {
            session.load_started(Ticket(1));
            session.load_is_shown();
            session.load_done(None);
        };
        let asks = |session: &mut Session| {
            session.follow_clay();
            let effects = session.take_effects();
            effects
                .iter()
                .any(|effect| matches!(effect, Effect::LoadSubject(_)))
        };
        assert!(
            !session.wants_sketch(),
            "a clay that is begun is asked for at once"
        );
        shows(&mut session);
        for end in [20, 40] {
            draw(&mut session, StrokeWay::Move, &arc()[..end], false);
            assert!(asks(&mut session) && session.wants_sketch());
            shows(&mut session);
            assert!(!session.awaits_clay(), "the hand goes on");
            assert!(!asks(&mut session));
        }
        // Nothing is changed by the last touch.
        draw(&mut session, StrokeWay::Move, &arc()[..40], true);
        assert!(session.awaits_clay());
        assert!(asks(&mut session) && !session.wants_sketch());
        assert!(!asks(&mut session), "it is on its way");
        shows(&mut session);
        assert!(!session.awaits_clay() && !asks(&mut session));
    }

    #[test]
    fn each_way_makes_its_own_stroke() {
        let far = |by: Vec3| {
            [
                UP,
                Touch {
                    pos: UP.pos + by,
                    ..UP
                },
            ]
        };
        let drawn = |way, by: Vec3| {
            let mut session = session();
            draw(&mut session, way, &far(by), true);
            strokes(&session).first().cloned()
        };
        let camera = Camera::DOCUMENT_DEFAULT;
        let [right, up, back] = camera::axes(camera.rotate);
        let pulled = drawn(StrokeWay::Push, 0.2 * up).expect("a pull");
        let [from, to] = &pulled.moves[0].keys[..] else {
            panic!("two keys")
        };
        assert!(from.at[2] < 450 && to.at[2] - from.at[2] == 200);
        let pushed = drawn(StrokeWay::Push, -0.2 * up).expect("a push");
        assert!(pushed.moves[0].keys[0].at[2] > 450);
        for (by, same) in [(0.2, &pushed), (-0.2, &pulled)] {
            let over = drawn(StrokeWay::PushOver, by * up);
            assert_eq!(over.as_ref(), Some(same), "Alt turns it over");
        }
        let turned = drawn(StrokeWay::Turn, 0.5 * seen_across(&camera) * right).expect("a turn");
        let by: i32 = turned.moves[0].keys.iter().map(|key| key.turn[2]).sum();
        assert_eq!((by, turned.moves[0].keys.len()), (180, 3));
        let half = 0.5 * seen_across(&camera) * right;
        let seen = drawn(StrokeWay::TurnInView, half).expect("a turn");
        let turns = seen.moves[0].keys.iter().map(|key| key.turn);
        let by: Vec3 = turns
            .map(|turn| Vec3::from_array(turn.map(|x| x as f32)))
            .sum();
        assert!(
            by.distance(180.0 * back) < 3.0,
            "about the line of sight: {by}"
        );
        let grown = drawn(StrokeWay::Grow, 0.25 * seen_across(&camera) * up).expect("growth");
        assert_eq!(grown.moves[0].keys[1].percent, 200);
        let smoothed = drawn(StrokeWay::Smooth, Vec3::ZERO).expect("a touch is enough");
        assert_eq!(smoothed.smooth, Some(50));
        for way in [
            StrokeWay::Move,
            StrokeWay::Push,
            StrokeWay::PushOver,
            StrokeWay::Turn,
            StrokeWay::TurnInView,
            StrokeWay::Grow,
        ] {
            assert_eq!(
                drawn(way, Vec3::ZERO),
                None,
                "{way:?}: the hand has not moved"
            );
        }
    }

    #[test]
    fn tools_are_listed_once_and_unused_ones_give_way() {
        let mut session = session();
        let mut hand = HeldTool::default();
        for size in [0.1, 0.2, 0.1, 0.3] {
            hand.size = size;
            session.run(Command::Hand(HandCommand::Hold(hand.clone())), 0.0);
            draw(&mut session, StrokeWay::Move, &arc(), true);
        }
        let clay = session.clay().expect("a clay");
        assert_eq!(clay.tools.len(), 3);
        let tools = clay.strokes.iter().map(|stroke| stroke.moves[0].tool);
        assert_eq!(tools.collect::<Vec<_>>(), [0, 1, 0, 2]);
        session.run(Command::Clay(ClayCommand::Remove(1)), 0.0);
        hand.size = 0.4;
        session.run(Command::Hand(HandCommand::Hold(hand.clone())), 0.0);
        draw(&mut session, StrokeWay::Move, &arc(), true);
        assert_eq!(session.clay().expect("a clay").tools.len(), 3);
        for i in 0..20 {
            hand.size = 0.02 + 0.01 * i as f32;
            session.run(Command::Hand(HandCommand::Hold(hand.clone())), 0.0);
            draw(&mut session, StrokeWay::Move, &arc(), true);
        }
        assert_eq!(session.clay().expect("a clay").tools.len(), Clay::MAX_TOOLS);
        assert!(
            session
                .notices
                .shown()
                .any(|notice| notice.message.contains("16"))
        );
    }

    #[test]
    fn a_baked_clay_is_a_tool_in_the_hand_and_one_step_of_undo() {
        let mut session = session();
        draw(&mut session, StrokeWay::Move, &arc(), true);
        session.run(Command::Clay(ClayCommand::Bake), 0.0);
        let baked = |strokes, longest| Some(ToolShape::Clay { strokes, longest });
        let tools = |session: &Session| {
            let clay = session.clay().expect("a clay");
            let shapes = clay.tools.iter().map(|tool| tool.shape.clone());
            shapes.collect::<Vec<_>>()
        };
        let listed = tools(&session);
        assert_eq!(listed[1..], [baked(1, 0.2)]);
        assert_eq!(
            session.clay_hand.shape(),
            listed[1].clone().expect("a tool")
        );
        // In another size it takes the place of what no stroke uses; a plain tool does not.
        let mut hand = session.clay_hand.clone();
        hand.size = 0.15;
        session.run(Command::Hand(HandCommand::Hold(hand.clone())), 0.0);
        draw(&mut session, StrokeWay::Move, &arc(), true);
        assert_eq!(tools(&session)[1..], [baked(1, 0.3)]);
        let stroke = &session.clay().expect("a clay").strokes[1];
        assert_eq!(stroke.moves[0].tool, 1);
        session.run(Command::Clay(ClayCommand::Bake), 0.0);
        let plain = HeldTool { own: None, ..hand };
        session.run(Command::Hand(HandCommand::Hold(plain)), 0.0);
        draw(&mut session, StrokeWay::Move, &arc(), true);
        assert_eq!(tools(&session)[1..3], [baked(1, 0.3), baked(2, 0.3)]);
        assert_eq!(tools(&session).len(), 4);
        for _ in 0..2 {
            session.run(Command::Undo, 0.0);
        }
        assert_eq!(tools(&session).len(), 2, "the stroke, then what was baked");
        // Without the strokes that it is made of the hand holds its plain form.
        session.run(Command::Clay(ClayCommand::Bake), 0.0);
        session.run(Command::Clay(ClayCommand::Remove(1)), 0.0);
        draw(&mut session, StrokeWay::Move, &arc(), true);
        assert_eq!(session.clay_hand.own, None);
        assert_eq!(session.clay().expect("a clay").strokes[1].moves[0].tool, 3);
    }

    /// A stroke that this version does not know, unknown keys and the numbers of steps outlive strokes beside them.
    #[test]
    fn strokes_go_beside_what_is_not_known() {
        let json = r#"{ "fabrica": 1, "subject": { "clay": { "x-own": 1, "strokes": [
            { "path": [0, 0, 400, 0, 0, 100] }, { "path": [1, 2, 3], "do": "carve", "x-deep": 7 } ] } },
            "look": { "strokes": 2 }, "steps": [{ "set": { "/look/strokes": 1 } }] }"#;
        let mut session = Session::new(Document::from_json(json).expect("a document"));
        session.run(Command::Clay(ClayCommand::Toggle), 0.0);
        draw(&mut session, StrokeWay::Move, &arc(), true);
        session.run(Command::Clay(ClayCommand::Switch(0)), 0.0);
        assert!(strokes(&session)[0].is_off);
        session.run(Command::Clay(ClayCommand::Switch(0)), 0.0);
        session.run(Command::Clay(ClayCommand::Remove(0)), 0.0);
        let written = session.document().to_json_compact();
        for kept in [r#""x-own":1"#, r#""do":"carve""#, r#""x-deep":7"#] {
            assert!(written.contains(kept), "{written}");
        }
        assert!(written.contains(r#""/look/strokes":0"#), "{written}");
        assert_eq!(session.illustration().strokes_shown(), Some(1), "{written}");
    }

    #[test]
    fn the_tool_wants_to_see_all_strokes_and_goes_with_its_clay() {
        let json = r#"{ "fabrica": 1, "subject": { "clay": { "strokes": [{ "path": [0, 0, 400, 0, 0, 100] }] } },
            "look": { "strokes": 0 } }"#;
        let mut session = Session::new(Document::from_json(json).expect("a document"));
        session.run(Command::Clay(ClayCommand::Toggle), 0.0);
        assert_eq!(session.tool(), Tool::Look);
        assert_eq!(session.notices.shown().count(), 1);
        let mut session = self::session();
        session.run(Command::Undo, 0.0);
        assert_eq!(
            session.tool(),
            Tool::Look,
            "the document before has no clay"
        );
        session.run(Command::Clay(ClayCommand::Toggle), 0.0);
        assert_eq!(session.tool(), Tool::Look);
        draw(&mut session, StrokeWay::Move, &arc(), true);
        assert!(session.clay().is_none());
    }

    /// As [`Session::clay_start`], as JSON.
    fn start_of(session: &Session, tissue: Option<&str>) -> Option<String> {
        let from = session.clay_start(tissue, -500.0)?;
        let clay = Clay {
            from,
            ..Clay::default()
        };
        Some(clay_to_text(&clay))
    }

    #[test]
    fn a_clay_begins_with_what_is_shown() {
        let head = r#"{ "fabrica": 1, "subject": { "builtin": "head" } }"#;
        let mut session = Session::with_scan(head, 1.0, &[(1, "skin")]);
        let outer = start_of(&session, None).unwrap();
        assert!(
            outer.contains(r#""iso":-500"#) && outer.contains("head"),
            "{outer}"
        );
        let skin = start_of(&session, Some("skin")).unwrap();
        assert!(skin.contains(r#""segment":"skin""#), "{skin}");
        let before = session.document().clone();
        let start = session.clay_start(Some("skin"), 0.0).unwrap();
        session.run(Command::Clay(ClayCommand::Begin(start)), 0.0);
        assert!(session.clay().is_some() && session.tool() == Tool::Clay);
        session.run(Command::Undo, 0.0);
        assert_eq!(*session.document(), before);
    }

    /// With the built-in apple as the subject's mesh.
    fn with_surface(json: &str) -> Session {
        let apple = crate::subjects::mesh("apple").expect("a built-in mesh");
        let surface = Surface::new(&apple, None, &mut |_| true).expect("it has a size");
        let mut session = Session::new(Document::from_json(json).expect("a valid document"));
        session.set_subject(&Subject::from(Arc::new(surface)));
        session
    }

    #[test]
    fn wires_are_seen_on_meshes_alone() {
        let toggle = || Command::See(See::ToggleWires);
        let mut scan = Session::with_scan(r#"{ "fabrica": 1 }"#, 1.0, &[]);
        scan.run(toggle(), 0.0);
        assert_eq!(scan.seen(), None);
        let mut mesh = with_surface(r#"{ "fabrica": 1, "subject": { "builtin": "apple" } }"#);
        let (before, document) = (mesh.revision, mesh.document().clone());
        mesh.run(toggle(), 0.0);
        assert!(mesh.seen().is_some_and(|seen| seen.look.has_wires));
        assert!(mesh.revision > before, "the picture is drawn anew");
        assert_eq!(*mesh.document(), document, "it is no part of the document");
        mesh.run(toggle(), 0.0);
        assert_eq!(mesh.seen(), None);
    }

    #[test]
    fn a_scan_becomes_clay_by_values_or_by_its_own_segments() {
        let hash = "0".repeat(64);
        let features = r#""features": [{ "name": "bone", "from": { "threshold": [200, 3000] } },
            { "name": "by hand", "paint": [{ "radius": 3, "path": [0, 0, 0] }] }]"#;
        let scan = |more: &str| {
            let json = format!(
                r#"{{ "fabrica": 1, "subject": {{ "sha256": "{hash}", "name": "scan", {features}{more} }} }}"#
            );
            Session::with_scan(&json, 1.0, &[(1, "liver")])
        };
        let alone = scan("");
        let bone = start_of(&alone, Some("bone")).unwrap();
        assert!(
            bone.contains(r#""iso":200"#) && bone.contains(&hash),
            "{bone}"
        );
        assert_eq!(start_of(&alone, Some("by hand")), None);
        assert!(start_of(&alone, Some("liver")).unwrap().contains("liver"));
        let labels = "1".repeat(64);
        let beside = scan(&format!(r#", "segments": [{{ "sha256": "{labels}" }}]"#));
        assert_eq!(start_of(&beside, Some("liver")), None);
        assert!(start_of(&beside, Some("bone")).is_some());
        let mesh = format!(
            r#"{{ "fabrica": 1, "subject": {{ "meshes": [{{ "sha256": "{hash}", "units": "m" }}] }} }}"#
        );
        let text = start_of(&with_surface(&mesh), None).unwrap();
        assert!(
            text.contains(&hash) && text.contains(r#""units":"m""#),
            "{text}"
        );
        let apple = with_surface(r#"{ "fabrica": 1, "subject": { "builtin": "apple" } }"#);
        assert_eq!(start_of(&apple, None), None, "it has no file");
    }
}
