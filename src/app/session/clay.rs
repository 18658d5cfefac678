//! What an author holds to shape a clay, and what can be done with it, as plain data.

use glam::{Quat, Vec3};

use super::found::Found;
use crate::document::{ClayMove, ClayStart, ClayTool, ToolShape};

/// The sizes that a hand may hold, subject units.
const SIZES: [f32; 2] = [0.01, 0.5];
/// The widths of a coating that a hand may hold, subject units.
const COATS: [f32; 2] = [0.01, 0.5];

/// What a drag over a clay does (spec/sweepers.md, B.3).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum StrokeWay {
    /// The tool goes with the hand in the plane of the picture.
    #[default]
    Move,
    /// It goes along the surface's normal: up pulls, down pushes.
    Push,
    /// It follows what is under the hand.
    Along,
    /// It turns about the surface's normal.
    Turn,
    /// It grows, and shrinks.
    Grow,
    /// What is under the hand is smoothed.
    Smooth,
    /// A click lays the tool down, and handles move it.
    Place,
}

impl StrokeWay {
    /// All ways, in the order of the buttons.
    pub const ALL: [Self; 7] = [
        Self::Move,
        Self::Push,
        Self::Along,
        Self::Turn,
        Self::Grow,
        Self::Smooth,
        Self::Place,
    ];

    /// True if the picture is asked for the surface all along the way of the hand.
    pub fn follows_surface(self) -> bool {
        matches!(self, Self::Along | Self::Smooth)
    }
}

/// A place on the clay under the hand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Touch {
    /// Where, subject space.
    pub pos: Vec3,
    /// Unit normal out of the clay.
    pub normal: Vec3,
    /// How hard a pen presses there, 0 to 1; `None` of what tells no force.
    pub force: Option<f32>,
}

/// The tool that an author holds, and how it is used.
#[derive(Clone, Debug, PartialEq)]
pub struct ClayHand {
    /// What a drag does.
    pub way: StrokeWay,
    /// Its form, one of [`ClayHand::FORMS`].
    pub form: usize,
    /// In place of that form, a mesh or the clay as it was, in the size of the hand.
    pub own: Option<ToolShape>,
    /// Half of its longest side, subject units.
    pub size: f32,
    /// Width of its coating, subject units.
    pub coat: f32,
    /// How deep it is sunk into the surface: 0 by half, 1 by all of its size, −1 not at all.
    pub depth: f32,
    /// Its turn about its own z axis, which stands along the normal, degrees from −180 to 180.
    pub turn_deg: f32,
    /// For x, y and z: it has a mirror image beyond the middle plane.
    pub mirror: [bool; 3],
    /// The handles of the tool that is laid down shape the clay.
    pub acts: bool,
}

impl Default for ClayHand {
    fn default() -> Self {
        Self {
            way: StrokeWay::Move,
            form: 0,
            own: None,
            size: 0.1,
            coat: 0.1,
            depth: 0.0,
            turn_deg: 0.0,
            mirror: [true, false, false],
            acts: false,
        }
    }
}

impl ClayHand {
    /// The forms, by the names of [`ToolShape::NAMES`].
    pub const FORMS: [&'static str; 5] = ["ball", "ellipsoid", "capsule", "box", "torus"];
    /// Ranges of size and coating.
    pub const RANGES: [[f32; 2]; 2] = [SIZES, COATS];

    /// The form with its size; lengths are subject units.
    pub fn shape(&self) -> ToolShape {
        let size = self.size;
        let part = |part: f32| rounded(part * size);
        if let Some(mut own) = self.own.clone() {
            own.numbers_mut()
                .into_iter()
                .for_each(|longest| *longest = part(2.0));
            return own;
        }
        match Self::FORMS.get(self.form) {
            Some(&"ellipsoid") => ToolShape::Ellipsoid {
                radii: Vec3::new(part(1.0), part(0.7), part(0.5)),
            },
            Some(&"capsule") => ToolShape::Capsule {
                radius: part(0.3),
                length: part(1.4),
            },
            Some(&"box") => ToolShape::Box {
                half: Vec3::splat(part(1.0)),
                round: part(0.15),
            },
            Some(&"torus") => ToolShape::Torus {
                ring: part(0.75),
                radius: part(0.25),
            },
            _ => ToolShape::Ball { radius: part(1.0) },
        }
    }

    /// Where the tool stands over a place of the clay, and how it is turned. The form of index 0, a ball, is the same
    /// however it is turned.
    pub fn pose(&self, touch: &Touch) -> (Vec3, Quat) {
        let own = || Quat::from_rotation_z(self.turn_deg.to_radians());
        let turn = match (self.form, &self.own) {
            (0, None) => Quat::IDENTITY,
            _ => Quat::from_rotation_arc(Vec3::Z, touch.normal) * own(),
        };
        let depth = self.depth_at(touch.force);
        (touch.pos - depth * self.size * touch.normal, turn)
    }

    /// How deep the tool is sunk by a pen that presses so hard: as is set at one half, not at all without pressure, by
    /// all of its size with all of it.
    fn depth_at(&self, force: Option<f32>) -> f32 {
        let Some(force) = force else {
            return self.depth;
        };
        let part = 2.0 * force.clamp(0.0, 1.0) - 1.0;
        let end = if part < 0.0 { -1.0 } else { 1.0 };
        self.depth + part.abs() * (end - self.depth)
    }

    pub(super) fn tool(&self) -> ClayTool {
        ClayTool {
            shape: Some(self.shape()),
            coat: (f64::from(self.coat) * 1e3).round() / 1e3,
        }
    }

    /// Larger or smaller by a step.
    pub(super) fn resized(&self, larger: bool) -> Self {
        let factor = if larger { 1.15 } else { 1.0 / 1.15 };
        self.with_size(self.size * factor)
    }

    /// The same of another size, as near to it as a hand may hold one.
    pub fn with_size(&self, size: f32) -> Self {
        Self {
            size: size.clamp(SIZES[0], SIZES[1]),
            ..self.clone()
        }
    }

    /// The same with another coating, as near to it as a hand may hold one.
    pub fn with_coat(&self, coat: f32) -> Self {
        Self {
            coat: coat.clamp(COATS[0], COATS[1]),
            ..self.clone()
        }
    }

    /// The same turned by so many degrees in all, in whole ones; beyond half a turn it goes on from the other end.
    pub fn with_turn(&self, turn_deg: f32) -> Self {
        Self {
            turn_deg: (turn_deg.round() + 180.0).rem_euclid(360.0) - 180.0,
            ..self.clone()
        }
    }
}

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
}

impl Together {
    /// True if a ghost moves.
    pub fn may_act(&self) -> bool {
        self.ghosts.iter().any(|ghost| ghost.way.keys.len() > 1)
    }
}

/// One thing to do with a clay.
#[derive(Clone, Debug, PartialEq)]
pub enum ClayCommand {
    /// Begins a document with a clay that no stroke has touched, and takes a tool in hand.
    Begin(ClayStart),
    /// Takes the tool in hand, or puts it away.
    Toggle,
    /// Changes the tool in the hand.
    Hold(ClayHand),
    /// Takes the clay as it stands in hand, as a tool.
    Bake,
    /// The way of a hand over the clay, as far as it has come.
    Draw {
        /// What the drag does.
        way: StrokeWay,
        /// Where the hand was: on the surface where the way follows it, else in the plane of the picture through the
        /// first place.
        touches: Vec<Touch>,
        /// The hand has let go.
        is_over: bool,
    },
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
    /// Removes the stroke of this index.
    Remove(usize),
    /// Selects the stroke of this index.
    Select(usize),
}

/// Three decimals, as a link holds them.
fn rounded(length: f32) -> f32 {
    (length * 1e3).round() / 1e3
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pen_sets_how_deep_the_tool_is_sunk() {
        let hand = ClayHand {
            depth: 0.4,
            ..ClayHand::default()
        };
        let depths = [
            (None, 0.4),
            (Some(0.5), 0.4),
            (Some(0.0), -1.0),
            (Some(1.0), 1.0),
            (Some(0.25), -0.3),
            (Some(7.0), 1.0),
        ];
        for (force, depth) in depths {
            let touch = Touch {
                pos: Vec3::ZERO,
                normal: Vec3::Z,
                force,
            };
            let sunk = -hand.pose(&touch).0.z / hand.size;
            assert!((sunk - depth).abs() < 1e-5, "{force:?}: {sunk}");
        }
    }

    #[test]
    fn a_tool_is_turned_about_the_normal() {
        let touch = Touch {
            pos: Vec3::ZERO,
            normal: Vec3::X,
            force: None,
        };
        let ball = ClayHand::default().with_turn(30.0);
        assert_eq!(ball.pose(&touch).1, Quat::IDENTITY);
        let [plain, turned] = [0.0, 90.0].map(|turn_deg| {
            let form = 3;
            let hand = ClayHand {
                form,
                ..ClayHand::default()
            };
            hand.with_turn(turn_deg).pose(&touch).1
        });
        assert!((turned * Vec3::Z).abs_diff_eq(Vec3::X, 1e-5), "it stands");
        assert!((turned * Vec3::X).abs_diff_eq(plain * Vec3::Y, 1e-5));
        assert_eq!(ball.with_turn(-270.4).turn_deg, 90.0);
    }
}
