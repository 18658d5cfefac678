//! Groups: templates and objects of one group are moved and turned together.

use glam::{Quat, Vec3};

use super::notices::Gravity;
use super::selection::Selection;
use super::session::Session;
use crate::app::words::authoring::w;
use crate::document::{Edit, ObjectPlacement, free_group_name, group_of, groups, object_group_of};
use crate::math::Placement;

/// Templates lie no further out than this along an axis, subject units.
const FURTHEST: f32 = 4.0;

/// Where something lies, apart from its size.
#[derive(Clone, Copy, PartialEq)]
struct Pose {
    at: Vec3,
    rotate: Quat,
}

impl From<&Placement> for Pose {
    fn from(placement: &Placement) -> Self {
        Self {
            at: placement.at,
            rotate: placement.rotate,
        }
    }
}

impl From<&ObjectPlacement> for Pose {
    fn from(placement: &ObjectPlacement) -> Self {
        Self {
            at: placement.at,
            rotate: placement.rotate,
        }
    }
}

impl Session {
    /// Puts the selected template into the group of the one before it in the list, or both into a new one.
    pub(super) fn group_with_previous(&mut self) {
        let Some(template) = self.selection.template() else {
            return;
        };
        let Some(previous) = template.checked_sub(1) else {
            self.notify(Gravity::Info, w().nothing_before, "");
            return;
        };
        let known = group_of(self.document(), previous);
        let edit = if known.is_empty() {
            let group = free_group_name(w().group, &groups(self.document()));
            let both = [previous, template].map(|template| Edit::SetGroup {
                template,
                group: group.clone(),
            });
            Edit::All {
                name: "Group templates".to_owned(),
                edits: both.to_vec(),
            }
        } else {
            Edit::SetGroup {
                template,
                group: known.to_owned(),
            }
        };
        self.apply(&edit, false);
    }

    /// Takes what is selected out of its group.
    pub(super) fn leave_group(&mut self) {
        let edit = match (self.selection, self.selected_object()) {
            (Selection::Template(template), _) => Edit::SetGroup {
                template,
                group: String::new(),
            },
            (_, Some(object)) => super::objects::regrouping(object, ""),
            (_, None) => return,
        };
        self.apply(&edit, false);
    }

    /// The new place of a template or an object taken over by those of its group: they turn and move with it as one.
    pub(super) fn with_group(&self, edit: Edit) -> Edit {
        let Some((moved, before, after)) = self.moved_by(&edit) else {
            return edit;
        };
        let document = self.document();
        let group = match moved {
            Selection::Template(index) => group_of(document, index),
            Selection::Object(index) => object_group_of(document, index),
            Selection::Nothing | Selection::Stroke(_) => "",
        };
        if group.is_empty() || self.is_alone {
            return edit;
        }
        let turn = after.rotate * before.rotate.conjugate();
        let carried = |pose: Pose| Pose {
            at: after.at + turn * (pose.at - before.at),
            rotate: (turn * pose.rotate).normalize(),
        };
        let mut edits = vec![edit];
        for other in &self.shown().templates {
            let is_moved = moved == Selection::Template(other.index);
            if !is_moved && group_of(document, other.index) == group {
                let Pose { at, rotate } = carried(Pose::from(&other.placement));
                let limit = Vec3::splat(FURTHEST);
                edits.push(Edit::SetPlacement {
                    template: other.index,
                    placement: Placement {
                        at: at.clamp(-limit, limit),
                        rotate,
                        size: other.placement.size,
                    },
                });
            }
        }
        for other in &self.shown().objects {
            let is_moved = moved == Selection::Object(other.index);
            // One that lies where its file says stays there.
            if let Some(placement) = other.placement
                && !is_moved
                && object_group_of(document, other.index) == group
            {
                let Pose { at, rotate } = carried(Pose::from(&placement));
                let size = placement.size;
                edits.push(Edit::PlaceObject {
                    object: other.index,
                    placement: ObjectPlacement { at, rotate, size },
                });
            }
        }
        let verb = if before.rotate == after.rotate {
            "Move"
        } else {
            "Turn"
        };
        Edit::All {
            name: format!("{verb} group {group}"),
            edits,
        }
    }

    /// What an edit moves or turns, and where that lies before and after; `None` for all other edits. One that changes
    /// a size is of the one thing alone.
    fn moved_by(&self, edit: &Edit) -> Option<(Selection, Pose, Pose)> {
        match edit {
            Edit::SetPlacement {
                template,
                placement,
            } => {
                let before = self.template(*template)?.placement;
                let moved = Selection::Template(*template);
                let is_same_size = before.size == placement.size;
                is_same_size.then_some((moved, Pose::from(&before), Pose::from(placement)))
            }
            Edit::PlaceObject { object, placement } => {
                let before = self.object(*object)?.placement?;
                let moved = Selection::Object(*object);
                let is_same_size = before.size == placement.size;
                is_same_size.then_some((moved, Pose::from(&before), Pose::from(placement)))
            }
            _ => None,
        }
    }
}
