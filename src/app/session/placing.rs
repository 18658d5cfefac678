//! A tool that is laid down on a clay: handles and keys move, turn and size it, and shape the clay by that if they are
//! to.

use glam::{Quat, Vec2, Vec3};

use super::camera;
use super::clay::{ClayCommand, Ghost, Laid, Pose};
use super::command::{Command, GizmoMode};
use super::found::Found;
use super::gesture::{PERCENT, degrees, thousandths};
use super::hand::{HeldTool, StrokeWay, Touch};
use super::question::{Place, Question};
use super::session::Session;
use super::shape::seen_across;
use crate::document::{Clay, ClayKey, ClayMove, ClayStroke};

/// How far an arrow key moves the tool, as a part of the picture, and how far it turns it, degrees.
const MOVE: f32 = 0.01;
const TURN_DEG: f32 = 5.0;

impl Session {
    /// How the tool stands that is laid down.
    pub fn laid(&self) -> Option<Pose> {
        let laid = self.laid.as_ref()?;
        Some(Pose {
            at: laid.at,
            turn: laid.turn,
            size: self.clay_hand.size,
        })
    }

    /// True if the tool that is laid down is the last of the ghosts.
    pub fn is_ghost_laid(&self) -> bool {
        self.laid.as_ref().is_some_and(|laid| laid.is_ghost)
    }

    /// Takes a tool in hand, in place of the one before. One that is laid down and has not moved becomes like it.
    pub(super) fn hold_clay_tool(&mut self, hand: HeldTool) {
        self.clay_hand = hand;
        if self.clay_hand.way != StrokeWay::Place {
            self.laid = None;
        }
        let laid = self.laid.as_mut().filter(|laid| laid.is_ghost);
        if let Some((laid, ghost)) = laid.zip(self.together.ghosts.last_mut())
            && let [key] = &mut ghost.way.keys[..]
        {
            ghost.tool = self.clay_hand.tool();
            (key.percent, laid.own) = (100, self.clay_hand.size);
        }
    }

    /// Asks where in the picture the tool is to be laid down, if it is to be.
    pub(super) fn ask_where_to_lay(&self, place: Place) -> Option<Question> {
        let reply = |_, found| Command::Clay(ClayCommand::LayOn(found));
        (self.clay_hand.way == StrokeWay::Place).then(|| Question::new(place, reply))
    }

    /// Lays the tool down on the clay that was found. While strokes are laid down it is one of them, and holds what is
    /// in it until it is moved.
    pub(super) fn lay_tool(&mut self, found: Option<Found>) {
        let Some(found) = found.filter(|found| found.object.is_none()) else {
            return self.notify_nothing_here();
        };
        let (at, turn) = self.clay_hand.pose(&Touch {
            pos: found.pos,
            normal: found.normal.normalize_or(Vec3::Z),
            force: None,
        });
        let own = self.clay_hand.size;
        let is_ghost = self.together.is_on;
        if is_ghost {
            let pose = Pose {
                at,
                turn,
                size: own,
            };
            let way = way(vec![key_after(&[], &pose, own)]);
            let tool = self.clay_hand.tool();
            if !self.lay_ghost(Ghost { tool, way }) {
                return;
            }
        }
        self.laid = Some(Laid {
            at,
            turn,
            own,
            before: None,
            is_ghost,
        });
    }

    /// Puts the tool elsewhere that is laid down. If the handles act, the way there shapes the clay: as one stroke from
    /// where the drag began, or as the next part of the ghost.
    pub(super) fn put_laid(&mut self, to: Pose) {
        let Some((now, laid)) = self.laid().zip(self.laid.as_mut()) else {
            return;
        };
        let hand = self.clay_hand.clone();
        let new = hand.with_size((to.size * 1e3).round() / 1e3);
        let pose = Pose {
            size: new.size,
            ..to
        };
        if pose == now {
            return;
        }
        let begins = laid.before.is_none();
        let before = *laid.before.get_or_insert(now);
        (laid.at, laid.turn) = (pose.at, pose.turn);
        let (own, is_ghost) = (laid.own, laid.is_ghost);
        self.clay_hand = new;
        if is_ghost {
            let Some(ghost) = self.together.ghosts.last_mut() else {
                return;
            };
            let keys = &mut ghost.way.keys;
            let goes_on = hand.acts && begins && keys.len() < Clay::MAX_KEYS;
            if !goes_on {
                keys.pop();
            }
            keys.push(key_after(keys, &pose, own));
        } else if hand.acts {
            let first = key_after(&[], &before, before.size);
            let last = key_after(&[first], &pose, before.size);
            let stroke = ClayStroke {
                moves: vec![way(vec![first, last])],
                mirror: hand.mirror,
                smooth: None,
                is_off: false,
            };
            self.put_stroke(stroke, &[hand.with_size(before.size).tool()], false);
        }
    }

    /// The drag of a handle has ended: the next one begins where the tool is now.
    pub(super) fn rest_laid(&mut self) {
        if let Some(laid) = &mut self.laid
            && laid.before.take().is_some()
        {
            self.drawn_stroke = None;
        }
    }

    /// Moves, turns or sizes the tool that is laid down by a step to the right or down in the picture, as its handles
    /// do now.
    pub(super) fn nudge_laid(&mut self, right: f32, down: f32) {
        let Some(mut pose) = self.laid() else {
            return;
        };
        let step = Vec2::new(right, -down).normalize_or_zero();
        let [right, up, _] = camera::axes(self.camera.rotate);
        match self.gizmo {
            GizmoMode::Move => {
                let by = MOVE * seen_across(&self.camera);
                pose.at += by * (step.x * right + step.y * up);
            }
            GizmoMode::Turn => {
                let by = TURN_DEG.to_radians() * (step.x * up - step.y * right);
                pose.turn = (Quat::from_scaled_axis(by) * pose.turn).normalize();
            }
            GizmoMode::Size => return self.resize_held_tool(step.x + step.y > 0.0),
        }
        self.put_laid(pose);
        self.end_drag();
    }

    /// Makes the tool larger or smaller by a step, in the hand or where it is laid down.
    pub(super) fn resize_held_tool(&mut self, is_larger: bool) {
        let hand = self.hand().resized(is_larger);
        match self.laid() {
            Some(pose) => {
                self.put_laid(Pose {
                    size: hand.size,
                    ..pose
                });
                self.end_drag();
            }
            None => self.hold(hand),
        }
    }

    /// Lifts the tool that is laid down. False if none is.
    pub(super) fn lift_laid(&mut self) -> bool {
        self.laid.take().is_some()
    }
}

fn way(keys: Vec<ClayKey>) -> ClayMove {
    ClayMove {
        tool: 0,
        keys,
        is_straight: false,
    }
}

/// The key that comes after others with this pose of a tool whose own size is `own`.
fn key_after(keys: &[ClayKey], pose: &Pose, own: f32) -> ClayKey {
    let turned = ClayKey::poses(keys).last().map(|last| last.turn.as_quat());
    let turn = pose.turn * turned.unwrap_or(Quat::IDENTITY).inverse();
    let percent = (100.0 * pose.size / own).round();
    ClayKey {
        at: thousandths(pose.at),
        turn: degrees(turn),
        percent: percent.clamp(PERCENT[0], PERCENT[1]) as i32,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::session::HandCommand;
    use crate::document::{ClayShape, ClayStart, Document};

    fn run(session: &mut Session, command: ClayCommand) {
        session.run(Command::Clay(command), 0.0);
    }

    /// With a tool laid down on top of a ball.
    fn session(is_together: bool, acts: bool) -> Session {
        let mut session = Session::new(Document::new());
        run(
            &mut session,
            ClayCommand::Begin(ClayStart::Shape(ClayShape::Ball)),
        );
        if is_together {
            run(&mut session, ClayCommand::Together);
        }
        let hand = HeldTool {
            way: StrokeWay::Place,
            mirror: [false; 3],
            acts,
            ..HeldTool::default()
        };
        session.run(Command::Hand(HandCommand::Hold(hand)), 0.0);
        lay(&mut session);
        session
    }

    fn lay(session: &mut Session) {
        let found = Found {
            pos: Vec3::new(0.0, 0.0, 0.5),
            normal: Vec3::Z,
            pos_in_rest: Vec3::ZERO,
            value: 0.0,
            segment: None,
            object: None,
        };
        run(session, ClayCommand::LayOn(Some(found)));
        assert!(session.laid().is_some());
    }

    /// Drags the tool to a place in two steps, turned about z and of this size in the end.
    fn drag(session: &mut Session, at: Vec3, turn_deg: f32, size: f32) {
        let from = session.laid().expect("a tool").at;
        for part in [0.5, 1.0] {
            let pose = Pose {
                at: from.lerp(at, part),
                turn: Quat::from_rotation_z((part * turn_deg).to_radians()),
                size,
            };
            run(session, ClayCommand::Put(pose));
        }
        session.end_drag();
    }

    fn strokes(session: &Session) -> &[ClayStroke] {
        &session.clay().expect("a clay").strokes
    }

    const UP: Vec3 = Vec3::new(0.0, 0.0, 0.7);

    #[test]
    fn a_tool_is_placed_without_acting() {
        let mut session = session(false, false);
        drag(&mut session, UP, 30.0, 0.2);
        let pose = session.laid().expect("a tool");
        assert_eq!((pose.at, pose.size), (UP, 0.2));
        assert!(strokes(&session).is_empty());
        session.run(Command::Escape, 0.0);
        assert_eq!(session.laid(), None);
        lay(&mut session);
        session.run(Command::DeleteSelected, 0.0);
        assert_eq!(session.laid(), None);
        lay(&mut session);
        session.run(Command::Hand(HandCommand::Hold(HeldTool::default())), 0.0);
        assert_eq!(session.laid(), None, "another way of the hand");
        run(&mut session, ClayCommand::LayOn(None));
        assert_eq!(session.notices.shown().count(), 1);
    }

    #[test]
    fn each_drag_of_a_handle_that_acts_is_one_stroke() {
        let mut session = session(false, true);
        drag(&mut session, UP, 0.0, 0.1);
        drag(&mut session, UP, 90.0, 0.1);
        drag(&mut session, UP, 90.0, 0.2);
        let ends = strokes(&session).iter().map(|stroke| {
            let [first, last] = stroke.moves[0].keys[..] else {
                panic!("two keys: {stroke:?}")
            };
            (first.at[2], last.at[2], last.turn[2], last.percent)
        });
        let ends: Vec<_> = ends.collect();
        let wanted = [(500, 700, 0, 100), (700, 700, 90, 100), (700, 700, 0, 200)];
        assert_eq!(ends, wanted);
        assert_eq!(session.clay_hand.size, 0.2);
        session.run(Command::Undo, 0.0);
        assert_eq!(strokes(&session).len(), 2, "one step of undo each");
    }

    #[test]
    fn keys_do_what_the_handles_do() {
        let mut session = session(false, true);
        session.run(Command::Orbit(0.0, -0.13), 0.0);
        let pose = session.laid().expect("a tool");
        assert!(pose.at.z > 0.5, "{pose:?}");
        session.run(Command::SetGizmo(GizmoMode::Turn), 0.0);
        session.run(Command::Orbit(0.13, 0.0), 0.0);
        let turned = session.laid().expect("a tool").turn;
        let angle = turned.angle_between(Quat::IDENTITY).to_degrees();
        assert!((angle - TURN_DEG).abs() < 0.01, "{angle}");
        session.run(Command::SetGizmo(GizmoMode::Size), 0.0);
        session.run(Command::Orbit(0.13, 0.0), 0.0);
        session.run(Command::NudgeMain(1.0), 0.0);
        assert!(session.clay_hand.size > 0.13);
        assert_eq!(strokes(&session).len(), 4);
    }

    #[test]
    fn a_tool_that_is_laid_down_together_holds_until_it_moves() {
        let mut session = session(true, false);
        drag(&mut session, UP, 0.0, 0.1);
        let keys = |session: &Session, i: usize| session.together.ghosts[i].way.keys.clone();
        assert_eq!(keys(&session, 0).len(), 1, "it only lies elsewhere");
        assert_eq!(keys(&session, 0)[0].at, [0, 0, 700]);
        session.run(Command::PlaceInMiddle, 0.0);
        assert!(strokes(&session).is_empty(), "nothing moves");
        lay(&mut session);
        let hand = HeldTool {
            acts: true,
            size: 0.2,
            ..session.clay_hand.clone()
        };
        session.run(Command::Hand(HandCommand::Hold(hand)), 0.0);
        drag(&mut session, UP, 30.0, 0.2);
        drag(&mut session, Vec3::Z, 60.0, 0.3);
        let [first, second, third] = keys(&session, 1)[..] else {
            panic!("{:?}", keys(&session, 1))
        };
        assert_eq!([first.at[2], second.at[2], third.at[2]], [500, 700, 1000]);
        assert_eq!([second.turn[2], third.turn[2]], [30, 30]);
        assert_eq!([second.percent, third.percent], [100, 150]);
        session.run(Command::PlaceInMiddle, 0.0);
        assert_eq!(session.laid(), None);
        let stroke = &strokes(&session)[0];
        assert_eq!(stroke.moves[0].keys.len(), 1);
        assert_eq!(stroke.moves[1].keys.len(), 3);
        let tools = &session.clay().expect("a clay").tools;
        assert_ne!(tools[stroke.moves[0].tool], tools[stroke.moves[1].tool]);
    }
}
