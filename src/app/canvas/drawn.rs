//! The hand that draws a sweep over the picture: from the tissue where it begins, in the plane of the picture there.

use egui::{PointerButton, Pos2, Response, Ui};
use glam::Vec3;

use super::projection::{Projection, pixels_of};
use super::ways::paint_way;
use crate::app::picture::host::Picture;
use crate::app::session::{Command, Session, Tool};
use crate::document::TemplateKind;
use crate::render::PendingPick;

/// Points by which a hand moves at least from one place of its way to the next.
pub(crate) const STEP: f32 = 3.0;

/// A gesture under way.
#[derive(Default)]
pub(crate) struct DrawnWay {
    /// Where it began is being asked for.
    asked: Option<PendingPick>,
    /// The tissue where it began, subject space.
    from: Option<Vec3>,
    /// Where the hand was, points of the window.
    way: Vec<Pos2>,
    /// As many of these have been told.
    told: usize,
    /// The hand has let go.
    is_over: bool,
}

impl DrawnWay {
    /// True if a drag on the picture draws, and turns nothing.
    pub(crate) fn takes_drags(session: &Session, ui: &Ui) -> bool {
        session.tool() == Tool::Place(TemplateKind::Sweep) && is_plain(ui)
    }

    /// True from the press until the hand has let go.
    pub(crate) fn is_drawing(&self) -> bool {
        !self.way.is_empty()
    }

    /// True while the picture has to answer.
    pub(crate) fn is_waiting(&self) -> bool {
        self.asked.is_some()
    }

    /// What the hand does in this frame.
    pub(crate) fn ui(
        &mut self,
        ui: &Ui,
        (response, view): (&Response, &Projection),
        session: &Session,
        (picture, size): (&mut Picture, [u32; 2]),
        commands: &mut Vec<Command>,
    ) {
        if session.tool() != Tool::Place(TemplateKind::Sweep) {
            *self = Self::default();
            return;
        }
        if response.drag_started_by(PointerButton::Primary) && Self::takes_drags(session, ui) {
            let begin = ui.input(|i| i.pointer.press_origin());
            *self = Self {
                way: begin.into_iter().collect(),
                ..Self::default()
            };
        }
        let Some(first) = self.way.first().copied() else {
            return;
        };
        let here = response.interact_pointer_pos().filter(|_| !self.is_over);
        let is_far = |pos: &Pos2| {
            self.way
                .last()
                .is_none_or(|last| last.distance(*pos) >= STEP)
        };
        self.way.extend(here.filter(is_far));
        self.is_over |= !response.dragged_by(PointerButton::Primary);
        if self.from.is_none() && !self.find(first, view, (picture, size)) {
            // Nothing is where it began.
            *self = Self::default();
            return;
        }
        self.paint(ui, view);
        let Some(from) = self.from else {
            ui.ctx().request_repaint();
            return;
        };
        if self.way.len() > self.told || self.is_over {
            self.told = self.way.len();
            let places = self.way.iter();
            let way = places.filter_map(|pos| view.on_plane(*pos, from, view.back()));
            commands.push(Command::DrawSweep {
                way: way.collect(),
                is_over: self.is_over,
            });
            if self.is_over {
                *self = Self::default();
            }
        }
    }

    /// Asks for the tissue where the gesture began. False if there is none.
    fn find(
        &mut self,
        first: Pos2,
        view: &Projection,
        (picture, size): (&mut Picture, [u32; 2]),
    ) -> bool {
        let Some(asked) = &mut self.asked else {
            let pixel = pixels_of(view.rect, size)(first);
            // Another question may be open; then this one is asked in the next frame.
            self.asked = picture.pick(pixel, size).ok();
            return true;
        };
        match asked.poll_now() {
            None => true,
            Some(answer) => {
                self.asked = None;
                self.from = answer.ok().flatten().map(|pick| pick.pos_in_subject);
                self.from.is_some()
            }
        }
    }

    /// The way of the hand.
    fn paint(&self, ui: &Ui, view: &Projection) {
        let painter = ui.painter_at(view.rect);
        paint_way(&painter, self.way.clone());
    }
}

/// One finger or the first button, alone.
pub(crate) fn is_plain(ui: &Ui) -> bool {
    ui.input(|i| {
        let pointer = &i.pointer;
        !pointer.secondary_down() && !pointer.middle_down() && i.multi_touch().is_none()
    })
}
