//! What lies at the foot of the object: the bar of a lesson, else the card of texts while the picture is shown alone.

use egui::{Rect, Ui};

use super::{steps, title, view_bar};
use crate::app::session::{Command, Session};

/// Where they lie; one of them at most, so that neither covers the other and no text is there twice.
pub(crate) struct Foot {
    steps: Option<Rect>,
    card: Option<Rect>,
}

impl Foot {
    /// In the part of the window that shows the object.
    pub(crate) fn new(ui: &Ui, area: Rect, session: &Session) -> Self {
        let steps = steps::place(ui, area, session);
        // A lesson has its own texts in the bar.
        let card = match steps {
            None if session.are_panels_hidden => title::place(ui, area, session),
            _ => None,
        };
        Self { steps, card }
    }

    /// The top of what lies there.
    pub(crate) fn top(&self) -> Option<f32> {
        self.steps.or(self.card).map(|rect| rect.top())
    }

    /// The part of the area that is left for panes. A card of many lines leaves them the upper half, and covers more.
    pub(crate) fn panes(&self, area: Rect, session: &Session) -> Rect {
        match self.top() {
            Some(top) if view_bar::is_card_under(area, session) => {
                area.with_max_y((top - 8.0).max(area.center().y))
            }
            _ => area,
        }
    }

    /// Shows what lies there.
    pub(crate) fn ui(
        &self,
        ui: &mut Ui,
        area: Rect,
        session: &Session,
        commands: &mut Vec<Command>,
    ) {
        if let Some(bar) = self.steps {
            steps::ui(ui, bar, session, commands);
        }
        if let Some(card) = self.card {
            title::ui(ui, area, card, session);
        }
    }
}
