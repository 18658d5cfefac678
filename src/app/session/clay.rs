//! What can be done with a clay, and what is laid down on it, as plain data.

use glam::{Quat, Vec3};

use super::found::Found;
use crate::document::{ClayMove, ClayStart, ClayTool};

/// Where the strokes of a clay stand in a document.
pub(super) const STROKES: &str = "/subject/clay/strokes";

/// A tool with its way, laid down.
#[derive(Clone, Debug, PartialEq)]
pub struct Ghost {
    /// What moves, with its coating.
    pub tool: ClayTool,
    /// Its way. A tool with one key stays, and holds what is in it.
    pub way: ClayMove,
}

/// How a tool stands that is laid down by itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// Its origin, subject space.
    pub at: Vec3,
    /// Its turn since its rest.
    pub turn: Quat,
    /// Half of its longest side, subject units.
    pub size: f32,
}

/// A tool that is laid down to be moved by handles. Its form and its size are those of the hand.
#[derive(Clone, Debug)]
pub(super) struct Laid {
    pub(super) at: Vec3,
    pub(super) turn: Quat,
    /// Its size when it was laid down.
    pub(super) own: f32,
    /// How it stood before the drag under way.
    pub(super) before: Option<Pose>,
    /// It is the last of the ghosts.
    pub(super) is_ghost: bool,
}

/// What is laid down, in the order of the strokes.
#[derive(Debug, Default)]
pub struct Together {
    /// Strokes that are drawn are laid down.
    pub is_on: bool,
    /// The ghosts. All have the mirror images of the tool in the hand.
    pub ghosts: Vec<Ghost>,
    /// Those that undo took back, the last one last.
    pub(super) taken_back: Vec<Ghost>,
}

impl Together {
    /// True if undo took one back that can be laid down again.
    pub fn has_taken_back(&self) -> bool {
        !self.taken_back.is_empty()
    }

    /// True if a ghost moves.
    pub fn may_act(&self) -> bool {
        self.ghosts.iter().any(|ghost| ghost.way.keys.len() > 1)
    }
}

/// What can be changed of a stroke that is there, beside its ways.
#[derive(Clone, Debug, PartialEq)]
pub enum StrokeChange {
    /// The tool of the way of this index.
    Tool(usize, ClayTool),
    /// The axes across which its tools have mirror images: x, y and z.
    Mirror([bool; 3]),
}

/// One thing to do with a clay.
#[derive(Clone, Debug, PartialEq)]
pub enum ClayCommand {
    /// Begins a document with a clay that no stroke has touched, and takes a tool in hand.
    Begin(ClayStart),
    /// Takes the tool in hand, or puts it away.
    Toggle,
    /// Takes the clay as it stands in hand, as a tool.
    Bake,
    /// From now on strokes that are drawn are only laid down, or done again.
    Together,
    /// Lays the tool down on the clay that was found.
    LayOn(Option<Found>),
    /// Puts the tool that is laid down elsewhere.
    Put(Pose),
    /// Does all that is laid down as one stroke.
    Act,
    /// Puts a key of something that is laid down elsewhere, subject space: its index and that of its key.
    MoveGhost([usize; 2], Vec3),
    /// Takes back what is laid down, by its index.
    RemoveGhost(usize),
    /// Switches the stroke of this index off, or on again.
    Switch(usize),
    /// Changes the stroke of this index.
    Change {
        /// One of the clay's strokes, counted from 0.
        stroke: usize,
        /// The tool of one of its ways, or its mirror images.
        change: StrokeChange,
        /// It is a part of a drag, which is one step of undo as a whole.
        is_drag: bool,
    },
    /// Removes the stroke of this index.
    Remove(usize),
    /// Selects the stroke of this index.
    Select(usize),
}
