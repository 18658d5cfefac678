//! The tool that an author holds to shape a clay or to draw a sweep, and how it is used, as plain data.

use glam::{Quat, Vec3};

use crate::document::{ClayTool, ToolShape};

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
    /// The same turned over, as with Alt held: up pushes, down pulls.
    PushOver,
    /// It follows what is under the hand.
    Along,
    /// It turns about the surface's normal.
    Turn,
    /// It turns about the line of sight.
    TurnInView,
    /// It grows, and shrinks.
    Grow,
    /// What is under the hand is smoothed.
    Smooth,
    /// A click lays the tool down, and handles move it.
    Place,
    /// The way of the hand becomes the form of the tool.
    Form,
}

impl StrokeWay {
    /// What drags may do to a clay, in the order in which it is offered; where they draw a sweep, the first of it.
    const ALL: [Self; 8] = [
        Self::Move,
        Self::Push,
        Self::Along,
        Self::Turn,
        Self::TurnInView,
        Self::Grow,
        Self::Smooth,
        Self::Place,
    ];
    const OF_SWEEPS: usize = 6;

    /// What drags may do where they draw a sweep, or where they shape a clay.
    pub const fn offered(is_sweep: bool) -> &'static [Self] {
        match is_sweep {
            true => Self::ALL.split_at(Self::OF_SWEEPS).0,
            false => &Self::ALL,
        }
    }

    /// The next or the last one that is offered, around the end; the first after one that is not.
    pub fn beside(self, is_sweep: bool, is_next: bool) -> Self {
        let ways = Self::offered(is_sweep);
        let Some(at) = ways.iter().position(|way| *way == self) else {
            return ways[0];
        };
        let by = if is_next { 1 } else { ways.len() - 1 };
        ways[(at + by) % ways.len()]
    }

    /// The same with Alt held, or without it: that turns push and pull over, and nothing else.
    #[must_use]
    pub fn with_alt(self, is_held: bool) -> Self {
        match self {
            Self::Push | Self::PushOver if is_held => Self::PushOver,
            Self::Push | Self::PushOver => Self::Push,
            other => other,
        }
    }

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
pub struct HeldTool {
    /// What a drag does.
    pub way: StrokeWay,
    /// Its form, one of [`HeldTool::FORMS`].
    pub form: usize,
    /// In place of that form, a curve that was drawn, a mesh or the clay as it was, in the size of the hand.
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

impl Default for HeldTool {
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

impl HeldTool {
    /// The forms, by the names of [`ToolShape::NAMES`].
    pub const FORMS: [&'static str; 5] = ["ball", "ellipsoid", "capsule", "box", "torus"];
    /// Ranges of size and coating.
    pub const RANGES: [[f32; 2]; 2] = [SIZES, COATS];
    /// Radius of a rod and of a curve that is drawn, parts of the size in the hand.
    pub(super) const THICKNESS: f32 = 0.3;

    /// True of what every hand may hold, as numbers alone describe it.
    pub fn has_plain_form(shape: &ToolShape) -> bool {
        Self::FORMS.contains(&shape.name())
    }

    /// The form with its size; lengths are subject units.
    pub fn shape(&self) -> ToolShape {
        let size = self.size;
        let part = |part: f32| rounded(part * size);
        if let Some(mut own) = self.own.clone() {
            own = own.scaled(size / own.half_side());
            for number in own.numbers_mut() {
                *number = (*number * 1e4).round() / 1e4;
            }
            return own;
        }
        match Self::FORMS.get(self.form) {
            Some(&"ellipsoid") => ToolShape::Ellipsoid {
                radii: Vec3::new(part(1.0), part(0.7), part(0.5)),
            },
            Some(&"capsule") => ToolShape::Capsule {
                radius: part(Self::THICKNESS),
                length: part(2.0 - 2.0 * Self::THICKNESS),
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

    /// A hand that holds a tool which is there, in its own proportions; `None` of a form that this version does not
    /// have.
    pub fn with_tool(tool: &ClayTool) -> Option<Self> {
        let own = tool.shape.clone()?;
        let form = Self::FORMS.iter().position(|name| *name == own.name());
        Some(Self {
            form: form.unwrap_or_default(),
            size: own.half_side(),
            own: Some(own),
            coat: tool.coat as f32,
            ..Self::default()
        })
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

    /// The tool, as a clay lists it.
    pub fn tool(&self) -> ClayTool {
        ClayTool {
            shape: Some(self.shape()),
            coat: (f64::from(self.coat) * 1e3).round() / 1e3,
        }
    }

    /// Larger or smaller by a step.
    pub(super) fn resized(&self, larger: bool) -> Self {
        self.with_size(self.size * by_a_step(larger))
    }

    /// The same with a coating that is wider or thinner by a step.
    pub(super) fn recoated(&self, wider: bool) -> Self {
        self.with_coat(self.coat * by_a_step(wider))
    }

    /// The same of another size, as near to it as a hand may hold one.
    pub fn with_size(&self, size: f32) -> Self {
        Self {
            size: size.clamp(SIZES[0], SIZES[1]),
            ..self.clone()
        }
    }

    /// The same once its form was drawn, of this size: it moves again.
    pub(super) fn formed(&self, size: f32) -> Self {
        Self {
            way: StrokeWay::Move,
            ..self.with_size(size)
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

/// What a hand with a tool does over the picture.
#[derive(Clone, Debug, PartialEq)]
pub enum HandCommand {
    /// Changes the tool in the hand.
    Hold(HeldTool),
    /// Goes on to the next way of drags that is offered, or to the one before.
    NextWay(bool),
    /// Makes the coating wider or thinner by a step.
    Recoat(bool),
    /// The way of the hand, as far as it has come.
    Draw {
        /// What the drag does.
        way: StrokeWay,
        /// Where the hand was: on the surface where the way follows it, else in the plane of the picture through the
        /// first place.
        touches: Vec<Touch>,
        /// The hand has let go.
        is_over: bool,
    },
}

/// The factor of a step to more, or to less.
fn by_a_step(is_more: bool) -> f32 {
    if is_more { 1.15 } else { 1.0 / 1.15 }
}

/// Three decimals, as a link holds them.
fn rounded(length: f32) -> f32 {
    (length * 1e3).round() / 1e3
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_drawn_curve_has_the_size_of_the_hand() {
        let own = ToolShape::Curve {
            points: vec![Vec3::new(-0.3, 0.0, 0.0), Vec3::new(0.3, 0.1, 0.0)],
            radius: 0.1,
        };
        assert_eq!(own.half_side(), 0.4);
        let hand = HeldTool {
            own: Some(own.clone()),
            size: 0.2,
            ..HeldTool::default()
        };
        let half = ToolShape::Curve {
            points: vec![Vec3::new(-0.15, 0.0, 0.0), Vec3::new(0.15, 0.05, 0.0)],
            radius: 0.05,
        };
        assert_eq!(hand.shape(), half);
        assert!(half.has_form_of(&own), "another size is the same form");
        let ToolShape::Curve { points, .. } = own.clone() else {
            panic!("a curve")
        };
        let thin = ToolShape::Curve {
            points,
            radius: 0.02,
        };
        assert!(!thin.has_form_of(&own));
    }

    #[test]
    fn a_pen_sets_how_deep_the_tool_is_sunk() {
        let hand = HeldTool {
            depth: 0.4,
            ..HeldTool::default()
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
        let ball = HeldTool::default().with_turn(30.0);
        assert_eq!(ball.pose(&touch).1, Quat::IDENTITY);
        let [plain, turned] = [0.0, 90.0].map(|turn_deg| {
            let form = 3;
            let hand = HeldTool {
                form,
                ..HeldTool::default()
            };
            hand.with_turn(turn_deg).pose(&touch).1
        });
        assert!((turned * Vec3::Z).abs_diff_eq(Vec3::X, 1e-5), "it stands");
        assert!((turned * Vec3::X).abs_diff_eq(plain * Vec3::Y, 1e-5));
        assert_eq!(ball.with_turn(-270.4).turn_deg, 90.0);
    }
}
