//! Strokes of a clay that are only laid down, as ghosts, until all of them are done as one.

use glam::Vec3;

use super::clay::Ghost;
use super::gesture::thousandths;
use super::notices::Gravity;
use super::session::Session;
use crate::app::words::clay::w;
use crate::app::words::fill;
use crate::document::{Clay, ClayMove, ClayStroke, ClayTool};

/// True if so many tools with their mirror images may act at once.
fn has_room(count: usize, mirror: [bool; 3]) -> bool {
    let mirrors = mirror.iter().filter(|is_on| **is_on).count();
    count << mirrors <= Clay::MAX_AT_ONCE
}

impl Session {
    /// From now on strokes are laid down, or done again. What is laid down is done.
    pub(super) fn toggle_together(&mut self) {
        self.together.is_on = !self.together.is_on;
        self.lift_laid();
        if !self.together.is_on {
            self.act_together();
        }
    }

    /// Lays a way down. True if it may act with the others.
    pub(super) fn lay_ghost(&mut self, ghost: Ghost) -> bool {
        let count = self.together.ghosts.len() + 1;
        let has_room = self.has_room_for(count, self.clay_hand.mirror);
        if has_room {
            self.together.ghosts.push(ghost);
            self.together.taken_back.clear();
        }
        has_room
    }

    /// Lays what was taken back last down again. False if there is nothing.
    pub(super) fn lay_ghost_again(&mut self) -> bool {
        let Some(ghost) = self.together.taken_back.pop() else {
            return false;
        };
        let count = self.together.ghosts.len() + 1;
        if self.has_room_for(count, self.clay_hand.mirror) {
            self.lift_ghost();
            self.together.ghosts.push(ghost);
        } else {
            self.together.taken_back.push(ghost);
        }
        true
    }

    /// True if so many tools may act at once; else a message says so.
    pub(super) fn has_room_for(&mut self, count: usize, mirror: [bool; 3]) -> bool {
        let has_room = has_room(count, mirror);
        if !has_room {
            let text = fill(w().too_many_at_once, &[&Clay::MAX_AT_ONCE]);
            self.notify(Gravity::Info, text, "");
        }
        has_room
    }

    /// Does what is laid down as one stroke, if any of it moves: the first way is the stroke's own.
    pub(super) fn act_together(&mut self) {
        let count = self.together.ghosts.len();
        if !self.together.may_act() || !self.has_room_for(count, self.clay_hand.mirror) {
            return;
        }
        let ghosts = self.together.ghosts.iter().enumerate();
        let (tools, moves): (Vec<ClayTool>, Vec<ClayMove>) = ghosts
            .map(|(tool, ghost)| {
                let way = ghost.way.clone();
                (ghost.tool.clone(), ClayMove { tool, ..way })
            })
            .unzip();
        let stroke = ClayStroke {
            moves,
            mirror: self.clay_hand.mirror,
            smooth: None,
            is_off: false,
        };
        if self.put_stroke(stroke, &tools, true) {
            self.drop_ghosts();
        }
    }

    /// Takes back what was laid down last. False if there is nothing.
    pub(super) fn take_ghost_back(&mut self) -> bool {
        self.lift_ghost();
        let ghost = self.together.ghosts.pop();
        let is_taken = ghost.is_some();
        self.together.taken_back.extend(ghost);
        is_taken
    }

    /// Takes back all that is laid down. False if there is nothing.
    pub(super) fn drop_ghosts(&mut self) -> bool {
        let has_ghosts = !self.together.ghosts.is_empty();
        self.together.ghosts.clear();
        self.together.taken_back.clear();
        self.lift_ghost();
        has_ghosts
    }

    /// The last ghost is not what handles move any more.
    fn lift_ghost(&mut self) {
        self.laid.take_if(|laid| laid.is_ghost);
    }

    /// Puts a key of a ghost elsewhere, subject space.
    pub(super) fn move_ghost(&mut self, (ghost, key): (usize, usize), pos: Vec3) {
        let ghost = self.together.ghosts.get_mut(ghost);
        if let Some(key) = ghost.and_then(|ghost| ghost.way.keys.get_mut(key)) {
            key.at = thousandths(pos);
        }
    }

    /// Takes back the ghost of this index.
    pub(super) fn remove_ghost(&mut self, ghost: usize) {
        if ghost + 1 == self.together.ghosts.len() {
            self.take_ghost_back();
        } else if ghost < self.together.ghosts.len() {
            self.together.ghosts.remove(ghost);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::session::{
        ClayCommand, Command, HandCommand, HeldTool, StrokeWay, Tool, Touch,
    };
    use crate::document::{ClayShape, ClayStart, Document};

    fn run(session: &mut Session, command: ClayCommand) {
        session.run(Command::Clay(command), 0.0);
    }

    fn session() -> Session {
        let mut session = Session::new(Document::new());
        run(
            &mut session,
            ClayCommand::Begin(ClayStart::Shape(ClayShape::Ball)),
        );
        run(&mut session, ClayCommand::Together);
        session
    }

    fn hold(session: &mut Session, size: f32, mirror: [bool; 3]) {
        let hand = HeldTool {
            size,
            mirror,
            ..HeldTool::default()
        };
        session.run(Command::Hand(HandCommand::Hold(hand)), 0.0);
    }

    /// A way upwards that begins so far to the left.
    fn draw(session: &mut Session, way: StrokeWay, x: f32) {
        let touch = |i: usize| Touch {
            pos: Vec3::new(x, 0.0, 0.4 + 0.02 * i as f32),
            normal: Vec3::Z,
            force: None,
        };
        for (count, is_over) in [(5, false), (11, true)] {
            let touches = (0..count).map(touch).collect();
            let command = HandCommand::Draw {
                way,
                touches,
                is_over,
            };
            session.run(Command::Hand(command), 0.0);
        }
    }

    fn strokes(session: &Session) -> &[ClayStroke] {
        &session.clay().expect("a clay").strokes
    }

    #[test]
    fn ways_that_are_laid_down_are_done_as_one_stroke() {
        let mut session = session();
        for (size, x) in [(0.1, 0.1), (0.2, 0.2), (0.1, 0.3)] {
            hold(&mut session, size, [true, false, false]);
            draw(&mut session, StrokeWay::Move, x);
        }
        assert!(strokes(&session).is_empty(), "nothing is done yet");
        assert_eq!(session.together.ghosts.len(), 3);
        session.run(Command::PlaceInMiddle, 0.0);
        assert!(session.together.ghosts.is_empty());
        let [stroke] = strokes(&session) else {
            panic!("one stroke: {:?}", strokes(&session))
        };
        let tools = stroke.moves.iter().map(|one| one.tool);
        assert_eq!(tools.collect::<Vec<_>>(), [0, 1, 0]);
        assert_eq!(stroke.mirror, [true, false, false]);
        assert_eq!(stroke.moves[0].keys[0].at[0], 100, "the first is its own");
        assert_eq!(session.clay().expect("a clay").tools.len(), 2);
        session.run(Command::Undo, 0.0);
        assert!(strokes(&session).is_empty(), "one step of undo");
    }

    #[test]
    fn ghosts_are_taken_back_one_by_one_and_dropped() {
        let mut session = session();
        for x in [0.0, 0.1, 0.2] {
            draw(&mut session, StrokeWay::Move, x);
        }
        let all = session.together.ghosts.clone();
        for _ in 0..2 {
            session.run(Command::Undo, 0.0);
        }
        assert_eq!(session.together.ghosts, all[..1]);
        for _ in 0..2 {
            session.run(Command::Redo, 0.0);
        }
        assert_eq!(session.together.ghosts, all, "and laid down again");
        session.run(Command::Undo, 0.0);
        assert_eq!(session.together.ghosts.len(), 2);
        run(&mut session, ClayCommand::RemoveGhost(0));
        let at = |session: &Session| session.together.ghosts[0].way.keys[0].at;
        assert_eq!(at(&session)[0], 100);
        run(&mut session, ClayCommand::MoveGhost([0, 0], Vec3::X));
        assert_eq!(at(&session), [1000, 0, 0]);
        run(&mut session, ClayCommand::MoveGhost([7, 0], Vec3::X));
        run(&mut session, ClayCommand::RemoveGhost(7));
        session.run(Command::DeleteSelected, 0.0);
        assert!(session.together.ghosts.is_empty());
        draw(&mut session, StrokeWay::Move, 0.0);
        session.run(Command::Redo, 0.0);
        assert_eq!(session.together.ghosts.len(), 1, "a new one is the end");
        session.run(Command::Escape, 0.0);
        session.run(Command::Redo, 0.0);
        assert!(session.together.ghosts.is_empty());
        assert_eq!(session.tool(), Tool::Clay, "one thing at a time");
        session.run(Command::PlaceInMiddle, 0.0);
        assert!(strokes(&session).is_empty());
        draw(&mut session, StrokeWay::Move, 0.0);
        session.run(Command::Escape, 0.0);
        session.run(Command::Escape, 0.0);
        assert_eq!(session.tool(), Tool::Look);
        assert!(session.clay().is_some());
    }

    #[test]
    fn at_most_eight_act_at_once_with_their_images() {
        let mut session = session();
        hold(&mut session, 0.1, [true, true, false]);
        for x in [0.1, 0.2, 0.3] {
            draw(&mut session, StrokeWay::Move, x);
        }
        assert_eq!(session.together.ghosts.len(), 2);
        let told = |session: &Session| session.notices.shown().count();
        assert_eq!(told(&session), 1);
        hold(&mut session, 0.1, [true, true, true]);
        session.run(Command::PlaceInMiddle, 0.0);
        assert!(strokes(&session).is_empty(), "sixteen would act");
        assert_eq!(session.together.ghosts.len(), 2, "they stay");
        hold(&mut session, 0.1, [false; 3]);
        session.run(Command::PlaceInMiddle, 0.0);
        assert_eq!(strokes(&session)[0].moves.len(), 2);
    }

    #[test]
    fn smoothing_is_done_at_once_and_switching_off_does_the_rest() {
        let mut session = session();
        draw(&mut session, StrokeWay::Smooth, 0.0);
        assert_eq!(strokes(&session).len(), 1);
        draw(&mut session, StrokeWay::Move, 0.0);
        assert_eq!(strokes(&session).len(), 1);
        run(&mut session, ClayCommand::Together);
        assert_eq!(strokes(&session).len(), 2);
        draw(&mut session, StrokeWay::Move, 0.0);
        assert_eq!(strokes(&session).len(), 3);
    }
}
