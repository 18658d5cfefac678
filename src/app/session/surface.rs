//! Laying templates on the surface under them: flat, or along it.

use std::sync::Arc;

use glam::{Quat, Vec3};

use super::command::Command;
use super::effect::Effect;
use super::found::Found;
use super::notices::Gravity;
use super::question::{Place, Question, Sight};
use super::session::Session;
use super::shape::camera_along;
use super::tracing::{self, Tracing};
use crate::app::words::authoring::w;
use crate::document::Edit;
use crate::math::Placement;

impl Session {
    /// The object as the templates before this one leave it, seen along the template's own axis.
    fn sight_along(&self, template: usize) -> Option<Arc<Sight>> {
        let placed = self.template(template)?;
        let camera = camera_along(&placed.placement);
        let mut illustration = self.shown().clone();
        illustration
            .templates
            .retain(|other| other.index < template);
        Some(Arc::new(Sight {
            illustration,
            camera,
        }))
    }

    /// Asks for the surface under the middle of the selected template.
    pub(super) fn ask_surface_under_selected(&mut self) {
        let Some(template) = self.selection.template() else {
            return;
        };
        if let Some(sight) = self.sight_along(template) {
            let middle = sight.camera.target;
            self.effect(Effect::Ask(Question {
                place: Place::Beside(sight, middle),
                index: template,
                reply: Command::LayOn,
                adds: false,
            }));
        }
    }

    /// Asks for the surface along the selected template.
    pub(super) fn ask_surface_along_selected(&mut self) {
        let Some(template) = self.selected_template() else {
            return;
        };
        let (index, places) = (template.index, tracing::places(template));
        let Some(sight) = self.sight_along(index) else {
            return;
        };
        self.tracing = Some(Tracing::new(index));
        for (index, pos) in places.into_iter().enumerate() {
            self.effect(Effect::Ask(Question {
                place: Place::Beside(Arc::clone(&sight), pos),
                index,
                reply: Command::Trace,
                adds: false,
            }));
        }
    }

    /// Lays a template on the surface that was found along its axis.
    pub(super) fn lay_on(&mut self, template: usize, found: Option<Found>) {
        let Some(found) = found else {
            self.notify(Gravity::Info, w().no_surface, "");
            return;
        };
        let Some(placed) = self.template(template) else {
            return;
        };
        let before = placed.placement;
        let z = found.normal.normalize_or(before.rotate * Vec3::Z);
        let turn = Quat::from_rotation_arc((before.rotate * Vec3::Z).normalize_or(Vec3::Z), z);
        let above = placed.kind.facts().shape.above;
        let placement = Placement {
            at: found.pos + z * before.size.z * (above - 0.5),
            rotate: (turn * before.rotate).normalize(),
            size: before.size,
        };
        let edit = self.with_group(Edit::SetPlacement {
            template,
            placement,
        });
        let edit = Edit::All {
            name: "Snap to the surface".to_owned(),
            edits: vec![edit],
        };
        self.apply(&edit, false);
    }

    /// Takes the surface at one of the places along the template that is to follow it.
    pub(super) fn trace(&mut self, index: usize, found: Option<Found>) {
        let Some(tracing) = &mut self.tracing else {
            return;
        };
        if !tracing.take(index, found.map(|found| found.pos)) {
            return;
        }
        let Some(done) = self.tracing.take() else {
            return;
        };
        let template = self.template(done.template());
        match template.and_then(|template| done.curve(template)) {
            Some(curve) => {
                let edit = Edit::SetCurve {
                    template: done.template(),
                    curve: Some(curve),
                };
                self.apply(&edit, false);
            }
            None => {
                self.notify(Gravity::Info, w().no_surface, "");
            }
        }
    }
}
