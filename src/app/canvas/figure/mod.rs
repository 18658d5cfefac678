//! A figure as it is made, in the picture: borders, rigidity and triangles over it, its handles, and what is drawn with
//! a tool.

mod draft;
mod handles;
mod hatching;
mod overlays;
mod plane;

use egui::{Rect, Response, Ui};

use self::draft::Hand;
use self::overlays::Borders;
use crate::app::canvas::projection::Projection;
use crate::app::session::figure::FigureTool;
use crate::app::session::{Command, Session, Tool};

/// What of it lives from frame to frame.
#[derive(Debug, Default)]
pub(crate) struct FigureCanvas {
    borders: Option<Borders>,
    hand: Hand,
}

impl FigureCanvas {
    /// Draws what lies over the figure and takes what the hand does with it. `bars` is where floating bars may lie.
    pub(crate) fn ui(
        &mut self,
        ui: &mut Ui,
        (response, bars): (&Response, Rect),
        view: &Projection,
        session: &Session,
        commands: &mut Vec<Command>,
    ) {
        if session.are_panels_hidden {
            return;
        }
        let painter = ui.painter_at(view.rect);
        if let Some(sheet) = &session.view.figure.sheet {
            let is_known = |borders: &Borders| borders.are_of(&sheet.mesh);
            if !self.borders.as_ref().is_some_and(is_known) {
                self.borders = Some(Borders::new(&sheet.mesh));
            }
            if let Some(borders) = &self.borders {
                overlays::paint(&painter, view, (sheet, borders), session);
            }
            if session.tool() == Tool::Figure(FigureTool::Region)
                && let Some(pos) = response.hover_pos()
            {
                overlays::paint_shape(&painter, view, sheet, session, pos);
            }
        }
        let is_held = handles::ui(ui, view, session, commands);
        self.hand.ui(ui, response, view, session, is_held, commands);
        if let Some(tool) = session.tool().for_figure() {
            draft::bar_ui(ui, bars, session, tool, commands);
        }
    }

    /// True if a drag over the picture belongs to the tool, so that the picture stays.
    pub(crate) fn takes_drags(session: &Session, ui: &Ui) -> bool {
        let is_main = ui.input(|i| !i.pointer.secondary_down() && !i.pointer.middle_down());
        is_main && session.tool().for_figure().is_some_and(draft::drags)
    }
}
