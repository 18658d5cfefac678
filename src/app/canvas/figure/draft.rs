use egui::{Pos2, Rect, Response, Shape, Stroke, Ui};

use super::plane::{place, seen};
use crate::app::canvas::projection::Projection;
use crate::app::canvas::tools::head_bar;
use crate::app::kit::icon::Icon;
use crate::app::kit::theme::{self, over_picture as ink};
use crate::app::kit::{figure_tool, slow_click, widget};
use crate::app::session::figure::{FigureCommand, FigureTool};
use crate::app::session::{Command, Session};
use crate::app::words::figure::w;
use crate::app::words::picture;

/// Tolerance for every point that the hand goes to the right.
const TOLERANCE_PER_POINT: f32 = 0.5;
/// Width of the bar of a tool, points.
const BAR: f32 = 460.0;

/// True if a drag over the picture means something to a tool.
pub(super) fn drags(tool: FigureTool) -> bool {
    tool.draws() || tool == FigureTool::Region
}

/// The hand with a tool.
#[derive(Debug, Default)]
pub(super) struct Hand {
    /// Where the drag that widens a region began, and the tolerance there.
    widens: Option<(Pos2, f64)>,
    draws: bool,
}

impl Hand {
    /// What the hand does over the picture.
    pub(super) fn ui(
        &mut self,
        ui: &Ui,
        response: &Response,
        view: &Projection,
        session: &Session,
        is_held: bool,
        commands: &mut Vec<Command>,
    ) {
        let mut send = |command| commands.push(Command::Figure(command));
        let tool = session.tool().for_figure();
        if is_held || ui.input(|i| i.multi_touch().is_some()) {
            (self.widens, self.draws) = (None, false);
            return;
        }
        let adds = ui.input(|i| i.modifiers.shift);
        let is_main = ui.input(|i| i.pointer.primary_down());
        let at = response.interact_pointer_pos();
        if response.clicked() && (tool.is_some() || !response.double_clicked()) {
            for pos in slow_click::places(ui, response) {
                if let Some(at) = place(view, pos) {
                    send(FigureCommand::Use(at, adds));
                }
            }
        }
        if response.double_clicked() && tool.is_some_and(FigureTool::draws) {
            send(FigureCommand::Finish);
        }
        let origin = ui.input(|i| i.pointer.press_origin());
        if response.drag_started() && is_main {
            let from = origin.or(at).and_then(|pos| Some((pos, place(view, pos)?)));
            match (tool, from) {
                (Some(FigureTool::Region), Some((_, at))) => {
                    send(FigureCommand::Use(at, adds));
                    self.widens = None;
                }
                (Some(tool), Some((_, at))) if tool.draws() => {
                    self.draws = true;
                    send(FigureCommand::Draw(at));
                }
                _ => {}
            }
        } else if response.dragged() && is_main {
            let now = at.and_then(|pos| place(view, pos));
            if self.draws
                && let Some(now) = now
            {
                send(FigureCommand::Draw(now));
            }
            if tool == Some(FigureTool::Region)
                && let (Some(pos), Some((_, flood))) = (at, session.selected_flood())
            {
                let (from, tolerance) = *self.widens.get_or_insert((pos, flood.tolerance));
                let more = f64::from((pos.x - from.x) * TOLERANCE_PER_POINT);
                send(FigureCommand::Widen(tolerance + more));
            }
        }
        if response.drag_stopped() {
            self.widens = None;
            if std::mem::take(&mut self.draws) {
                send(FigureCommand::Finish);
            }
        }
        self.paint(ui, response, view, session);
    }

    /// The line or polygon so far, and the way from its end to the pointer.
    fn paint(&self, ui: &Ui, response: &Response, view: &Projection, session: &Session) {
        let draft = &session.view.figure.draft;
        let corners = draft.iter().filter_map(|at| seen(view, *at));
        let mut line: Vec<Pos2> = corners.collect();
        let painter = ui.painter_at(view.rect);
        if line.is_empty() {
            return;
        }
        let tool = session.tool().for_figure();
        if !self.draws {
            for corner in &line {
                painter.circle(*corner, 4.0, ink::HOT, Stroke::new(1.5, ink::HALO_DARK));
            }
            line.extend(response.hover_pos());
        }
        if !tool.is_some_and(FigureTool::draws) {
            return;
        }
        for (width, color) in [(4.0, ink::HALO_DARK), (2.0, ink::HOT)] {
            let stroke = Stroke::new(width, color);
            painter.add(match tool {
                Some(FigureTool::Line) => Shape::line(line.clone(), stroke),
                _ => Shape::closed_line(line.clone(), stroke),
            });
        }
    }
}

/// The bar over the picture: what the tool in hand is for, and its buttons.
pub(super) fn bar_ui(
    ui: &mut Ui,
    rect: Rect,
    session: &Session,
    tool: FigureTool,
    commands: &mut Vec<Command>,
) {
    ui.ctx().set_cursor_icon(egui::CursorIcon::Crosshair);
    let draft = &session.view.figure.draft;
    let buttons = match (tool.draws(), draft.is_empty()) {
        (true, false) => 3.0,
        _ => 1.0,
    };
    let side = theme::control_height();
    let (mut inner, width) = head_bar(ui, rect, BAR, "figure tool");
    let ui = &mut inner;
    let is_narrow = width < 420.0;
    let middle = match is_narrow {
        true => picture::w().middle,
        false => picture::w().in_the_middle,
    };
    let room = width - 24.0 - buttons * (side + 4.0) - if is_narrow { 76.0 } else { 118.0 };
    let (_, _, hint) = figure_tool::face(tool, session.view.figure.has_pixels());
    let text = egui::RichText::new(hint).size(12.5);
    ui.allocate_ui(egui::vec2(room.max(40.0), side), |ui| {
        ui.add(egui::Label::new(text).truncate())
            .on_hover_text(hint);
    });
    let mut button = |ui: &mut Ui, icon, name, command| {
        if widget::icon_button(ui, icon, name, true).clicked() {
            commands.push(command);
        }
    };
    if tool.draws() && !draft.is_empty() {
        let figure = Command::Figure;
        button(
            ui,
            Icon::Undo,
            w().take_back,
            figure(FigureCommand::TakeBack),
        );
        button(ui, Icon::Check, w().finish, figure(FigureCommand::Finish));
    }
    if ui
        .button(middle)
        .on_hover_text(picture::w().enter)
        .clicked()
    {
        commands.push(Command::PlaceInMiddle);
    }
    if widget::icon_button(ui, Icon::Close, w().cancel, true).clicked() {
        commands.push(Command::Figure(FigureCommand::Take(tool)));
    }
}
