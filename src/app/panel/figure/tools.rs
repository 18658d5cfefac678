//! The tools of a figure, where the catalogue of templates is else.

use egui::Ui;

use crate::app::kit::icon::Icon;
use crate::app::kit::theme::{self, Palette};
use crate::app::kit::widget;
use crate::app::session::figure::{FigureCommand, FigureTool, Overlay};
use crate::app::session::{Command, Session, Tool};
use crate::app::words::figure::w;

/// A tool, its icon, its name, and the sentence of its tooltip.
type Entry = (FigureTool, Icon, &'static str, &'static str);

/// The tools, and what is shown of the making.
pub(in crate::app::panel) fn ui(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    let weak = Palette::get(ui).weak;
    ui.add(egui::Label::new(egui::RichText::new(w().start).color(weak)).wrap());
    let plate = session.view.figure.plate.as_ref();
    let has_pixels = plate.is_some_and(|plate| plate.has_pixels());
    let has_shapes = plate.is_some_and(|plate| !plate.shapes.is_empty());
    let bend = [
        (FigureTool::Pin, Icon::Pin, w().pin, w().pin_hint),
        (FigureTool::Line, Icon::Bend, w().line, w().line_hint),
        (
            FigureTool::Landmark,
            Icon::Marks,
            w().landmark,
            w().landmark_hint,
        ),
        (FigureTool::Only, Icon::Expand, w().only, w().only_hint),
    ];
    heading(ui, w().tools);
    bend.into_iter()
        .for_each(|entry| tool_ui(ui, session, entry, commands));
    heading(ui, w().divide);
    if has_pixels {
        let entry = (
            FigureTool::Region,
            Icon::Drop,
            w().by_colour,
            w().by_colour_hint,
        );
        tool_ui(ui, session, entry, commands);
    }
    if has_shapes {
        let entry = (
            FigureTool::Region,
            Icon::Drop,
            w().by_shape,
            w().by_shape_hint,
        );
        tool_ui(ui, session, entry, commands);
        if widget::labelled_button(ui, Icon::Layers, w().all_shapes, false, true).clicked() {
            commands.push(Command::Figure(FigureCommand::TakeShapes));
        }
    }
    let entry = (
        FigureTool::Polygon,
        Icon::Cut,
        w().polygon,
        w().polygon_hint,
    );
    tool_ui(ui, session, entry, commands);
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

fn tool_ui(
    ui: &mut Ui,
    session: &Session,
    (tool, icon, name, hint): Entry,
    commands: &mut Vec<Command>,
) {
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
