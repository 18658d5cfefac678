//! The tools of a figure, where the catalogue of templates is else.

use egui::Ui;

use crate::app::kit::icon::Icon;
use crate::app::kit::theme::{self, Palette};
use crate::app::kit::{figure_tool, widget};
use crate::app::session::figure::{FigureCommand, FigureTool, Overlay};
use crate::app::session::{Command, Session, Tool};
use crate::app::words::figure::w;

/// The tools, and what is shown of the making.
pub(in crate::app::panel) fn ui(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    let weak = Palette::get(ui).weak;
    ui.add(egui::Label::new(egui::RichText::new(w().start).color(weak)).wrap());
    heading(ui, w().tools);
    for tool in [
        FigureTool::Pin,
        FigureTool::Line,
        FigureTool::Landmark,
        FigureTool::Only,
    ] {
        tool_ui(ui, session, tool, commands);
    }
    heading(ui, w().divide);
    let figure = &session.view.figure;
    let plate = figure.plate.as_ref();
    let has_shapes = plate.is_some_and(|plate| !plate.shapes.is_empty());
    if figure.has_pixels() || has_shapes {
        tool_ui(ui, session, FigureTool::Region, commands);
    }
    if has_shapes
        && widget::labelled_button(ui, Icon::Layers, w().all_shapes, false, true).clicked()
    {
        commands.push(Command::Figure(FigureCommand::TakeShapes));
    }
    tool_ui(ui, session, FigureTool::Polygon, commands);
    heading(ui, w().overlays);
    for overlay in Overlay::ALL {
        let mut is_shown = session.view.figure.shows(overlay);
        if ui.checkbox(&mut is_shown, overlay_name(overlay)).clicked() {
            commands.push(Command::Figure(FigureCommand::Show(overlay)));
        }
    }
}

fn heading(ui: &mut Ui, text: &str) {
    ui.add_space(6.0);
    let weak = Palette::get(ui).weak;
    ui.label(theme::strong(text).size(11.5).color(weak));
}

fn tool_ui(ui: &mut Ui, session: &Session, tool: FigureTool, commands: &mut Vec<Command>) {
    let (icon, name, hint) = figure_tool::face(tool, session.view.figure.has_pixels());
    let is_active = session.tool() == Tool::Figure(tool);
    let button = widget::labelled_button(ui, icon, name, is_active, true);
    if button.on_hover_text(hint).clicked() {
        commands.push(Command::Figure(FigureCommand::Take(tool)));
    }
}

fn overlay_name(overlay: Overlay) -> &'static str {
    match overlay {
        Overlay::Outlines => w().outlines,
        Overlay::Handles => w().handles,
        Overlay::Rigidity => w().rigidity,
        Overlay::Mesh => w().mesh,
        Overlay::Vertices => w().vertices,
    }
}
