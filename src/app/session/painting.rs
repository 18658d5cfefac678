//! Painting tissue with a ball: what a drag adds to a recipe, or takes out of it. A drag is one step of undo.

use glam::Vec3;
use serde_json::Value;

use super::brush::Drag;
use super::found::Found;
use super::line::Line;
use super::notices::Gravity;
use super::session::Session;
use super::tissues::marked_in;
use super::tool::Tool;
use crate::app::words::{fill, tissue};
use crate::document::{Edit, Illustration, MAX_BALL_MM, MAX_STROKES, MIN_BALL_MM, Recipe, Stroke};

/// Radius of the ball at first, voxels.
const BALL_VOXELS: f64 = 4.0;
/// How much larger a key makes the ball.
const BALL_STEP: f32 = 1.25;

impl Session {
    /// Radius of the ball that paints, mm.
    pub fn ball_mm(&self) -> f32 {
        let voxel_mm = self
            .view
            .subject
            .as_ref()
            .and_then(|facts| facts.voxel_mm());
        let usual = || two_digits((BALL_VOXELS * voxel_mm.unwrap_or(1.0)) as f32);
        self.tissues.brush.radius_mm.unwrap_or_else(usual)
    }

    /// Radius of the ball that paints, subject units.
    pub fn ball_in_units(&self) -> Option<f32> {
        Some(self.ball_mm() / self.view.mm_per_unit()?)
    }

    /// The strokes of the drag under way, or of the last one while the picture does not show it yet.
    pub fn strokes_under_way(&self) -> &[Stroke] {
        let Some(drag) = &self.tissues.brush.drag else {
            return &[];
        };
        let mut recipes = self.illustration().recipes.iter();
        let recipe = recipes.find(|recipe| recipe.index == drag.recipe);
        let strokes = recipe.and_then(|recipe| recipe.paint.get(drag.before..));
        strokes.unwrap_or_default()
    }

    /// What is seen in place of what the document shows: one tissue alone, the one that is painted in its colour, or a
    /// mesh with its wires.
    pub fn seen(&self) -> Option<Illustration> {
        let seen = self.seen_bare();
        if !(self.view.has_wires && self.view.is_mesh()) {
            return seen;
        }
        let mut seen = seen.unwrap_or_else(|| self.shown().clone());
        seen.look.has_wires = true;
        Some(seen)
    }

    fn seen_bare(&self) -> Option<Illustration> {
        if self.tool() == Tool::Clay && !self.shown().templates.is_empty() {
            return Some(Illustration {
                templates: Vec::new(),
                ..self.shown().clone()
            });
        }
        let facts = self.view.subject.as_ref();
        let alone = self.tissues.seen_in(self.shown(), facts);
        alone.or_else(|| {
            let Tool::Paint { recipe, .. } = self.tool() else {
                return None;
            };
            let name = self.recipe(recipe)?.name;
            let is_here = facts.is_some_and(|facts| facts.has_segment(&name));
            is_here.then(|| marked_in(self.shown(), &name))
        })
    }

    /// Takes the ball in hand for the recipe that is open, or puts it away.
    pub(super) fn take_ball(&mut self, erases: Option<bool>) {
        let tool = match (erases, self.tissues.open) {
            (Some(erases), Some(recipe)) => Tool::Paint { recipe, erases },
            _ => Tool::Look,
        };
        let is_new = !matches!(self.tool(), Tool::Paint { .. });
        if erases.is_none() && is_new {
            return;
        }
        if is_new {
            // What is painted on has to be seen.
            self.tissues.show_alone(None);
            self.tissues.glimpse = None;
            if self.are_drawers {
                self.tab = None;
            }
        }
        self.take_tool(tool);
    }

    /// Gives the ball another radius, mm.
    pub(super) fn set_ball(&mut self, radius_mm: f32) {
        if radius_mm.is_finite() {
            let radius_mm = two_digits(radius_mm).clamp(MIN_BALL_MM, MAX_BALL_MM);
            self.tissues.brush.radius_mm = Some(radius_mm);
        }
    }

    /// Makes the ball larger or smaller by a step.
    pub(super) fn resize_ball(&mut self, is_larger: bool) {
        let step = if is_larger {
            BALL_STEP
        } else {
            1.0 / BALL_STEP
        };
        self.set_ball(self.ball_mm() * step);
    }

    /// A new drag begins.
    pub(super) fn press_ball(&mut self) {
        self.tissues.brush.drags += 1;
    }

    /// Nothing more is added to the drags so far.
    pub(super) fn close_drags(&mut self) {
        self.tissues.brush.close();
    }

    /// Goes on with a drag ([`drag_code`](super::brush::drag_code)) to what the picture has under the hand.
    pub(super) fn paint_on(&mut self, code: usize, found: Option<Found>) {
        let Some(found) = found else {
            return;
        };
        // What this drag has painted or dug out is not what the hand follows: the ball would climb on itself.
        if let (Some(drag), Some(mm_per_unit)) = (&self.tissues.brush.drag, self.view.mm_per_unit())
            && drag.number == code / 2
        {
            let radius = drag.radius_mm / mm_per_unit;
            let detail = self.view.subject.as_ref().map_or(0.0, |facts| facts.detail);
            let off = (drag.line.distance(found.pos_in_rest) - radius).abs();
            if off < (1.5 * detail).max(0.15 * radius) {
                return;
            }
        }
        self.paint_at(code, found.pos_in_rest);
    }

    /// Goes on with a drag ([`drag_code`](super::brush::drag_code)) to a point of rest space.
    pub(super) fn paint_at(&mut self, code: usize, pos: Vec3) {
        let (number, erases) = (code / 2, code % 2 == 1);
        let Tool::Paint { recipe: index, .. } = self.tool() else {
            return;
        };
        let (Some(recipe), Some(mm_per_unit)) = (self.recipe(index), self.view.mm_per_unit())
        else {
            return;
        };
        if number <= self.tissues.brush.closed || !pos.is_finite() {
            return;
        }
        let is_same = |drag: &Drag| drag.number == number;
        let mut drag = match self.tissues.brush.drag.take().filter(is_same) {
            Some(mut drag) => {
                // Something else was done with the strokes meanwhile.
                if recipe.paint.len() != drag.before + drag.count || drag.recipe != index {
                    return self.close_drags();
                }
                if !drag.line.push(pos) {
                    self.tissues.brush.drag = Some(drag);
                    return;
                }
                drag
            }
            None => {
                let radius_mm = self.ball_mm();
                Drag {
                    number,
                    recipe: index,
                    before: recipe.paint.len(),
                    count: 0,
                    radius_mm,
                    line: Line::new(pos, radius_mm / mm_per_unit),
                }
            }
        };
        let strokes = drag.line.strokes(erases, drag.radius_mm);
        if drag.before + strokes.len() > MAX_STROKES {
            self.tissues.brush.closed = number;
            let text = fill(tissue::w().no_more_strokes, &[&MAX_STROKES]);
            self.notify(Gravity::Info, text, "");
            return;
        }
        let is_first = drag.count == 0;
        drag.count = strokes.len();
        let before = recipe.paint[..drag.before].iter();
        let all: Vec<Value> = before.chain(&strokes).map(Stroke::to_value).collect();
        let verb = if erases { "Erase" } else { "Paint" };
        let edit = set_strokes(&recipe, all, format!("{verb} {}", recipe.name));
        let did = match is_first {
            true => self.apply(&edit, false),
            false => self.amend(&edit),
        };
        if did {
            self.tissues.brush.drag = Some(drag);
        }
    }

    /// Takes the last stroke of the recipe that is open away, or all of them.
    pub(super) fn drop_strokes(&mut self, all: bool) {
        let open = self.tissues.open.and_then(|index| self.recipe(index));
        let Some(recipe) = open.filter(|recipe| !recipe.paint.is_empty()) else {
            return;
        };
        self.close_drags();
        let count = if all { 0 } else { recipe.paint.len() - 1 };
        let rest = recipe.paint[..count].iter().map(Stroke::to_value).collect();
        let edit = set_strokes(&recipe, rest, format!("Remove strokes of {}", recipe.name));
        self.apply(&edit, false);
    }
}

/// The edit that gives a recipe other strokes.
fn set_strokes(recipe: &Recipe, strokes: Vec<Value>, name: String) -> Edit {
    let pointer = format!("/subject/features/{}/paint", recipe.index);
    // Where nothing else makes the tissue, an empty list keeps it.
    match strokes.is_empty() && recipe.from.range().is_some() {
        true => Edit::Reset { pointer, name },
        false => Edit::Set {
            pointer,
            value: Value::from(strokes),
            name,
        },
    }
}

/// A length with two digits.
fn two_digits(mm: f32) -> f32 {
    let mm = f64::from(mm.max(MIN_BALL_MM));
    let unit = 10.0_f64.powf(mm.log10().floor() - 1.0);
    // By hundredths, which is as fine as a ball gets.
    (((mm / unit).round() * unit * 1e4).round() / 1e4) as f32
}

#[cfg(test)]
mod tests {
    use glam::{DAffine3, DVec3, UVec3};

    use super::super::brush::drag_code;
    use super::super::{Command, TissueCommand};
    use super::*;
    use crate::data::{
        Grid, KnownMasks, Resources, Segmented, Subject, TimeSlices, Volume, Voxels, segment,
        segment_with,
    };
    use crate::document::{Document, RecipeSource};
    use crate::link;

    const BONE: &str = r#"{ "fabrica": 1, "subject": { "sha256": "5c5c5c5c5c5c5c5c5c5c5c5c5c5c5c5c5c5c5c5c5c5c5c5c5c5c5c5c5c5c5c5c",
        "features": [ { "name": "bone", "from": { "threshold": [200] }, "clean": [ { "largest": 1 }, { "fill": true } ] } ] } }"#;

    /// A ball of bone with a hole, and specks around it, in this many voxels of a millimetre along each side.
    fn ball_of_bone(side: u32) -> Volume {
        let half = f64::from(side) / 2.0;
        let value = |i: u64| {
            let n = u64::from(side);
            let v = DVec3::new((i % n) as f64, (i / n % n) as f64, (i / n / n) as f64);
            let off = (v - half).length() / half;
            match off {
                _ if i.is_multiple_of(4099) => 300,
                o if o < 0.2 => 40,
                o if o < 0.6 => 400,
                _ => 0,
            }
        };
        Volume {
            has_size: true,
            grid: Grid {
                dims: UVec3::splat(side),
                world_from_voxel: DAffine3::from_scale(DVec3::ONE),
            },
            voxels: Voxels::I16((0..u64::from(side).pow(3)).map(value).collect()),
            slope: 1.0,
            intercept: 0.0,
            value_range: [0.0, 400.0],
            segmentation: None,
        }
    }

    /// A session that has bone open for editing, in a scan of this many voxels along each side.
    fn session_of(volume: &Subject) -> Session {
        let mut session = Session::new(Document::from_json(BONE).expect("a valid document"));
        session.set_subject(volume);
        tissue(&mut session, TissueCommand::Open(Some(0)));
        session
    }

    fn tissue(session: &mut Session, command: TissueCommand) {
        session.run(Command::Tissue(command), 0.0);
    }

    /// One drag of the hand.
    fn drag(session: &mut Session, erases: bool, points: &[Vec3]) {
        tissue(session, TissueCommand::PressBall);
        let code = drag_code(session.tissues.brush.drags, erases);
        for &pos in points {
            tissue(session, TissueCommand::PaintAt(code, pos));
        }
    }

    fn strokes(session: &Session) -> &[Stroke] {
        &session.illustration().recipes[0].paint
    }

    fn made(volume: &Subject, document: &Document, known: Option<KnownMasks>) -> Segmented {
        let resources = Resources {
            subject: Some(volume.clone()),
            ..Resources::default()
        };
        let recipes = document.illustration().recipes.clone();
        let time_slices = TimeSlices::unlimited();
        match known {
            Some(_) => pollster::block_on(segment_with(resources, recipes, known, time_slices)),
            None => pollster::block_on(segment(resources, recipes, time_slices)),
        }
    }

    const LINE: [Vec3; 3] = [
        Vec3::ZERO,
        Vec3::new(0.1, 0.0, 0.0),
        Vec3::new(0.2, 0.0, 0.0),
    ];

    #[test]
    fn a_drag_is_a_stroke_and_one_step_of_undo() {
        let volume = Subject::from(ball_of_bone(64));
        let mut session = session_of(&volume);
        let before = session.document().clone();
        drag(&mut session, false, &LINE);
        assert_eq!(session.document(), &before, "there is no ball in hand");
        tissue(&mut session, TissueCommand::Ball(Some(false)));
        assert_eq!(session.tool().ball(), Some(false));
        drag(&mut session, false, &LINE);
        drag(&mut session, true, &LINE[..1]);
        let [painted, erased] = strokes(&session) else {
            panic!("{:?}", strokes(&session));
        };
        assert_eq!((painted.erases, painted.radius_mm), (false, 4.0));
        let places: Vec<[i32; 3]> = painted.places.iter().map(|p| p.to_array()).collect();
        assert_eq!(
            places,
            [[0, 0, 0], [200, 0, 0]],
            "straight, so that its ends are enough"
        );
        assert_eq!((erased.erases, erased.places.len()), (true, 1));
        assert_eq!(session.history.undo_name(), Some("Erase bone"));
        let all = session.document().clone();
        session.run(Command::Undo, 0.0);
        assert_eq!(strokes(&session).len(), 1);
        session.run(Command::Undo, 0.0);
        assert_eq!(session.document(), &before);
        session.run(Command::Redo, 0.0);
        session.run(Command::Redo, 0.0);
        assert_eq!(session.document(), &all);
        // What was taken back is not gone on with.
        let code = drag_code(session.tissues.brush.drags, true);
        tissue(&mut session, TissueCommand::PaintAt(code, Vec3::Y));
        assert_eq!(
            session.document(),
            &all,
            "a late answer of a drag that was taken back"
        );
        tissue(&mut session, TissueCommand::DropStrokes(false));
        assert_eq!(strokes(&session).len(), 1, "the last one");
        session.run(Command::Undo, 0.0);
        tissue(&mut session, TissueCommand::DropStrokes(true));
        assert_eq!(session.document(), &before, "all of them");
        session.run(Command::Escape, 0.0);
        assert_eq!(session.tool(), Tool::Look, "Escape puts the ball away");
        drag(&mut session, false, &LINE);
        assert_eq!(session.document(), &before);
    }

    #[test]
    fn the_ball_follows_the_voxels_and_the_keys() {
        let mut volume = ball_of_bone(8);
        volume.grid.world_from_voxel = DAffine3::from_scale(DVec3::new(0.5, 0.5, 0.7));
        let mut session = session_of(&Subject::from(volume));
        assert_eq!(session.ball_mm(), 2.2, "four voxels, by two digits");
        tissue(&mut session, TissueCommand::Ball(Some(true)));
        session.run(Command::NudgeMain(5.0), 0.0);
        assert_eq!(session.ball_mm(), 2.8);
        session.run(Command::NudgeMain(-5.0), 0.0);
        assert_eq!(session.ball_mm(), 2.2);
        for (wanted, is) in [
            (1e9, MAX_BALL_MM),
            (-1.0, MIN_BALL_MM),
            (f32::NAN, MIN_BALL_MM),
        ] {
            tissue(&mut session, TissueCommand::BallRadius(wanted));
            assert_eq!(session.ball_mm(), is, "{wanted}");
        }
    }

    #[test]
    fn the_ball_does_not_climb_on_what_it_has_painted() {
        let mut session = session_of(&Subject::from(ball_of_bone(64)));
        tissue(&mut session, TissueCommand::Ball(Some(false)));
        tissue(&mut session, TissueCommand::PressBall);
        let code = drag_code(session.tissues.brush.drags, false);
        let radius = session.ball_in_units().expect("a scan");
        let mut on = |x: f32, y: f32| {
            let pos = Vec3::new(x, y, 0.0);
            let found = Found {
                object: None,
                pos,
                normal: Vec3::Y,
                pos_in_rest: pos,
                value: 0.0,
                segment: None,
            };
            tissue(&mut session, TissueCommand::PaintOn(code, Some(found)));
            strokes(&session)[0].places.clone()
        };
        on(0.0, 0.0);
        assert_eq!(on(0.01, radius).len(), 1, "the top of the ball itself");
        let places = on(0.1, 0.0);
        assert_eq!(places.len(), 2, "{places:?}: the surface beside it");
        tissue(&mut session, TissueCommand::PaintOn(code, None));
        assert_eq!(strokes(&session)[0].places, places, "nothing is no place");
    }

    #[test]
    fn a_tissue_can_be_painted_only() {
        let volume = Subject::from(ball_of_bone(32));
        let mut session = session_of(&volume);
        tissue(&mut session, TissueCommand::MakeByHand("Bone".to_owned()));
        let recipes = &session.illustration().recipes;
        assert_eq!(
            (recipes[1].name.as_str(), &recipes[1].from),
            ("Bone 2", &RecipeSource::Nothing)
        );
        assert_eq!(
            session.tool(),
            Tool::Paint {
                recipe: 1,
                erases: false
            }
        );
        let empty = made(&volume, session.document(), None);
        assert_eq!(
            (empty.counts[1], empty.notices),
            (0, Vec::new()),
            "and nothing is missed"
        );
        drag(&mut session, false, &LINE[..1]);
        assert!(made(&volume, session.document(), None).counts[1] > 200);
        tissue(&mut session, TissueCommand::DropStrokes(true));
        assert_eq!(session.illustration().recipes.len(), 2, "it stays, empty");
        session.run(Command::Escape, 0.0);
        session.run(Command::Escape, 0.0);
        assert_eq!(
            session.illustration().recipes.len(),
            1,
            "Escape leaves it unmade"
        );
    }

    /// The tissue that is painted is drawn as a body while the ball is in hand, and no other tissue is.
    #[test]
    fn what_is_painted_is_marked() {
        let mut session = session_of(&Subject::from(ball_of_bone(16)));
        tissue(&mut session, TissueCommand::Ball(Some(false)));
        assert_eq!(session.seen(), None, "it is not found yet");
        session.view.set_segments(&[crate::data::Segment {
            label: 1,
            name: "bone".to_owned(),
            color_srgb: None,
        }]);
        let seen = session.seen().expect("marked");
        let looks: Vec<_> = seen
            .look
            .segments
            .iter()
            .map(|look| (&*look.name, look.opacity))
            .collect();
        assert_eq!(looks, [("bone", 1.0)]);
        tissue(&mut session, TissueCommand::Ball(None));
        assert_eq!(session.seen(), None);
    }

    /// Two hundred strokes on a scan of 256³ voxels: undo, the link, and the same bits after opening.
    #[test]
    fn two_hundred_strokes_are_undone_linked_and_opened_alike() {
        let volume = Subject::from(ball_of_bone(256));
        let mut session = session_of(&volume);
        let before = session.document().clone();
        let start = link::encode(&before).len();
        tissue(&mut session, TissueCommand::BallRadius(6.0));
        tissue(&mut session, TissueCommand::Ball(Some(false)));
        let known = KnownMasks::default();
        let mut seed = 1_u32;
        let mut random = move || {
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (seed >> 8) as f32 / (1 << 24) as f32
        };
        for i in 0..200 {
            // An arc over the surface of the bone, by a hand that trembles.
            let mut pos = || Vec3::new(random(), random(), random()) - 0.5;
            let from = pos();
            let to = from + 0.8 * pos();
            let way = (0..12).map(|k| {
                let on = from.lerp(to, k as f32 / 11.0).normalize_or(Vec3::X);
                0.3 * on + 0.002 * pos()
            });
            let way: Vec<Vec3> = way.collect();
            drag(&mut session, i % 4 == 3, &way);
        }
        let all = session.document().clone();
        assert_eq!(strokes(&session).len(), 200);
        // The link.
        let payload = link::encode(&all);
        let each = (payload.len() - start) as f32 / 200.0;
        let places: usize = strokes(&session).iter().map(|s| s.places.len()).sum();
        println!(
            "{each} characters a stroke of {} places",
            places as f32 / 200.0
        );
        assert!(each <= 40.0, "{each} characters a stroke");
        session.run(Command::CopyLink, 0.0);
        session.copied(Ok(()));
        assert!(
            session.is_link_long(),
            "{} characters: a file is advised",
            payload.len()
        );
        // The same bits after opening, with and without what is known of the clean-up, and on every machine.
        let opened = link::decode(&payload).expect("a link").document;
        assert_eq!(opened.to_json(), all.to_json());
        let clean = made(&volume, &before, Some(known.clone()));
        assert_eq!(known.byte_count(), 256 * 256 * 256 / 8, "a bit per voxel");
        let live = made(&volume, &all, Some(known));
        let again = made(&volume, &opened, None);
        assert_eq!(live, again);
        assert_ne!(live.counts, clean.counts);
        let labels = &again.segmentation.as_ref().expect("labels").labels;
        let runs = labels.iter().fold((0_u64, 0), |(sum, at), &label| {
            let at = at + 1;
            (sum.wrapping_mul(31).wrapping_add(u64::from(label) * at), at)
        });
        assert_eq!(
            (again.counts[0], runs.0),
            (2_079_016, 9_147_369_588_527_168_626),
            "as on every machine"
        );
        // Undo, all the way, and back.
        for _ in 0..200 {
            session.run(Command::Undo, 0.0);
        }
        assert_eq!(session.document(), &before);
        for _ in 0..200 {
            session.run(Command::Redo, 0.0);
        }
        assert_eq!(session.document(), &all);
    }
}
