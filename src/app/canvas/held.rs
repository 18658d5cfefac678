//! What the handles over the picture belong to: a template, an object of the scene, or a tool on a clay.

use glam::Vec3;

use super::outline::sides_of_tool;
use crate::app::session::{ClayCommand, Command, PlacedObject, Pose, Session};
use crate::document::{Edit, ObjectPlacement, PlacedTemplate};
use crate::math::{Bent, Placement};

/// Sides of a flat object are taken as this long at least, as parts of its longest side: its box can be seen.
const THINNEST: f32 = 0.01;

/// What the handles belong to.
#[derive(Clone, Copy)]
pub(crate) enum Held<'a> {
    /// A template, by its box and its main parameter.
    Template(&'a PlacedTemplate),
    /// An object, by the box of its mesh: all sides grow together.
    Object(&'a PlacedObject),
    /// A tool that is laid down on a clay, by a box of these sides: all grow together.
    Tool(Pose, Vec3),
}

impl<'a> Held<'a> {
    /// The tool that is laid down, if one is.
    pub(crate) fn of_tool(session: &Session) -> Option<Self> {
        let pose = session.laid()?;
        let sides = sides_of_tool(&session.view.grids, session.hand());
        Some(Self::Tool(pose, sides))
    }

    /// The template; `None` for an object.
    pub(crate) fn template(self) -> Option<&'a PlacedTemplate> {
        match self {
            Self::Template(template) => Some(template),
            Self::Object(_) | Self::Tool(..) => None,
        }
    }

    /// Its place among those of its kind.
    pub(crate) fn index(self) -> usize {
        match self {
            Self::Template(template) => template.index,
            Self::Object(object) => object.index,
            Self::Tool(..) => 0,
        }
    }

    /// Where its box lies: the unit cube of a template, or around the mesh of an object.
    pub(crate) fn placement(self) -> Placement {
        match self {
            Self::Template(template) => template.placement,
            Self::Object(object) => Placement {
                at: object.placement.at,
                rotate: object.placement.rotate,
                size: sides_of(object) * object.placement.size,
            },
            Self::Tool(pose, sides) => Placement {
                at: pose.at,
                rotate: pose.turn,
                size: sides,
            },
        }
    }

    /// The curve that it lies along.
    pub(crate) fn bent(self) -> Option<Bent> {
        self.template().and_then(PlacedTemplate::bent)
    }

    /// Subject space from a point of its unit box.
    pub(crate) fn subject_from_own(self, q: Vec3) -> Vec3 {
        match self {
            Self::Template(template) => template.subject_from_template(q),
            Self::Object(_) | Self::Tool(..) => self.placement().subject_from_template(q),
        }
    }

    /// The command that puts it there; `None` if that changes nothing. `sized`: the axis along which a face was
    /// dragged.
    pub(crate) fn put(self, placement: Placement, sized: Option<usize>) -> Option<Command> {
        if placement == self.placement() {
            return None;
        }
        // Where a template carves is where its object is.
        if let Self::Template(template) = self
            && let Some(found) = template.carves_by()
        {
            let size = sized.map_or(template.placement.size.x, |axis| placement.size[axis]);
            return Some(Command::Drag(Edit::PlaceObject {
                object: found.index,
                placement: ObjectPlacement {
                    at: placement.at,
                    rotate: placement.rotate,
                    size: size.clamp(0.001, 10.0),
                },
            }));
        }
        Some(Command::Drag(match self {
            Self::Template(template) => Edit::SetPlacement {
                template: template.index,
                placement,
            },
            Self::Object(object) => {
                let sides = sides_of(object);
                let size = sized.map_or(object.placement.size, |axis| {
                    (placement.size[axis] / sides[axis]).clamp(0.001, 10.0)
                });
                Edit::PlaceObject {
                    object: object.index,
                    placement: ObjectPlacement {
                        at: placement.at,
                        rotate: placement.rotate,
                        size,
                    },
                }
            }
            Self::Tool(pose, sides) => {
                let grown = sized.map_or(1.0, |axis| placement.size[axis] / sides[axis]);
                return Some(Command::Clay(ClayCommand::Put(Pose {
                    at: placement.at,
                    turn: placement.rotate,
                    size: pose.size * grown,
                })));
            }
        }))
    }
}

fn sides_of(object: &PlacedObject) -> Vec3 {
    object.sides.max(Vec3::splat(THINNEST))
}
