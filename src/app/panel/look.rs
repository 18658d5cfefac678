//! Colours and light: preset, window, opacity, background, style.

use egui::{Ui, vec2};

use crate::app::kit::entry;
use crate::app::kit::icon::Icon;
use crate::app::kit::theme::{Palette, control_height};
use crate::app::kit::widget::{self, Change, Named as _};
use crate::app::panel::bodies;
use crate::app::panel::light;
use crate::app::panel::presets::{self, Pictures};
use crate::app::panel::style;
use crate::app::panel::transfer::Editor;
use crate::app::session::Command;
use crate::app::session::Session;
use crate::app::words::look::{Look as Words, w};
use crate::app::words::transfer::w as transfer_words;
use crate::app::words::{facts, fill, names};
use crate::document::{
    Background, Edit, Look, OpacityMode, Preset, PresetSubject, Transfer, Window, preset,
};
use crate::render::{SubjectInfo, auto_preset, window_of};

/// A colour (sRGB, 0 to 255) and its name in the reader's language.
type Named = ([u8; 3], fn(&Words) -> &'static str);

/// Backgrounds at a click: paper, warm paper, grey, slate, black.
const BACKGROUNDS: [Named; 5] = [
    ([255, 255, 255], |w| w.white),
    ([246, 241, 231], |w| w.paper),
    ([200, 204, 208], |w| w.grey),
    ([38, 43, 48], |w| w.slate),
    ([0, 0, 0], |w| w.black),
];

/// Draws the panel. `info` describes the values shown; `None` for a subject without values.
pub(crate) fn ui(
    ui: &mut Ui,
    session: &Session,
    info: Option<&SubjectInfo>,
    editor: &mut Editor,
    pictures: &mut Pictures,
    commands: &mut Vec<Command>,
) {
    let look = &session.shown().look;
    if session.view.has_values() {
        values_ui(ui, session, info, (editor, pictures), commands);
        widget::divider(ui);
    }
    if session.has_meshes() {
        bodies::ui(ui, session, commands);
        widget::divider(ui);
    }
    if session.view.has_values() {
        opacity_ui(ui, look, commands);
        widget::divider(ui);
    }
    background_ui(ui, look.background, commands);
    marks_ui(ui, look, commands);
    if session.view.is_figure() {
        return;
    }
    widget::divider(ui);
    light::ui(ui, look, commands);
    widget::divider(ui);
    style::ui(ui, look, commands);
}

/// How opacity follows the deformation and the steepness of the value.
fn opacity_ui(ui: &mut Ui, look: &Look, commands: &mut Vec<Command>) {
    widget::heading(ui, w().opacity_heading, |_| {});
    let options = [
        (OpacityMode::Constancy, w().surfaces, w().surfaces_hint),
        (OpacityMode::Mass, w().mass, w().mass_hint),
        (OpacityMode::None, w().as_it_is, w().as_it_is_hint),
    ];
    if let Some(mode) = widget::explained(ui, w().opacity, &options, look.opacity) {
        commands.push(Command::Apply(Edit::SetOpacity(mode)));
    }
    let hint = match look.opacity {
        OpacityMode::Constancy => w().surfaces_hint,
        OpacityMode::Mass => w().mass_hint,
        OpacityMode::None => w().as_it_is_hint,
    };
    let weak = Palette::get(ui).weak;
    ui.add(egui::Label::new(egui::RichText::new(hint).small().color(weak)).wrap());
    edges_ui(ui, look, commands);
}

/// What stands at the picture's edges for readers and in saved pictures.
fn marks_ui(ui: &mut Ui, look: &Look, commands: &mut Vec<Command>) {
    let marks = [
        (
            w().scale,
            w().scale_hint,
            look.scale_bar,
            "scale",
            "Change scale bar",
        ),
        (
            w().sides,
            w().sides_hint,
            look.sides,
            "sides",
            "Change letters of sides",
        ),
    ];
    for (name, hint, mut is_on, key, undo) in marks {
        ui.horizontal_wrapped(|ui| {
            if ui.checkbox(&mut is_on, name).on_hover_text(hint).changed() {
                commands.push(Command::Apply(Edit::Set {
                    pointer: format!("/look/{key}"),
                    value: is_on.into(),
                    name: undo.to_owned(),
                }));
            }
        });
    }
}

/// The transfer function and the window: how values look.
fn values_ui(
    ui: &mut Ui,
    session: &Session,
    info: Option<&SubjectInfo>,
    (editor, pictures): (&mut Editor, &mut Pictures),
    commands: &mut Vec<Command>,
) {
    let look = &session.shown().look;
    widget::heading(ui, w().heading, |_| {});
    let auto = info.map(|info| auto_preset(&session.illustration().subject, info));
    let facts = session.view.subject.as_ref();
    let modality = facts.and_then(|facts| facts.scan.as_ref()?.modality.as_deref());
    let auto = auto.map(|name| (name, modality));
    transfer_ui(ui, &look.transfer, info, auto, pictures, commands);
    let auto = auto.map(|(name, _)| name);
    // Listed points ignore the window, which then only sets the grey of slices.
    let name = match &look.transfer {
        Transfer::Preset(name) => Some(name.as_str()),
        Transfer::Auto | Transfer::Points(_) => auto,
    };
    if let (Some(info), Some(preset)) = (info, name.and_then(preset)) {
        let window = window_of(look.window, preset, info);
        let is_listed = matches!(look.transfer, Transfer::Points(_));
        let stretched = (!is_listed).then_some(preset);
        editor.ui(ui, session, info, stretched, window, commands);
        window_ui(ui, look.window, window, info, commands);
        if info.has_segments {
            tint_ui(ui, look, stretched, commands);
        }
    }
}

fn transfer_ui(
    ui: &mut Ui,
    transfer: &Transfer,
    info: Option<&SubjectInfo>,
    auto: Option<(&str, Option<&str>)>,
    pictures: &mut Pictures,
    commands: &mut Vec<Command>,
) {
    let title = |name: &str| {
        preset(name).map_or_else(
            || name.to_owned(),
            |p| names::preset(p.name, p.title).to_owned(),
        )
    };
    let auto_title = auto.map_or_else(
        || w().automatic.to_owned(),
        |(name, modality)| {
            // Values without a unit say nothing of the machine that they come from; the file may.
            let is_unknown = preset(name).is_some_and(|p| p.subject == PresetSubject::Mri);
            let title = match (is_unknown, modality) {
                (true, Some(code)) => facts::modality(code).to_owned(),
                (true, None) => w().any_scan.to_owned(),
                (false, _) => title(name),
            };
            fill(w().automatic_is, &[&title])
        },
    );
    let selected = match transfer {
        Transfer::Auto => auto_title.clone(),
        Transfer::Preset(name) => title(name),
        Transfer::Points(points) => fill(w().own_points, &[&points.len()]),
    };
    widget::row(ui, |ui| {
        widget::row_label(ui, w().colours, w().colours_hint);
        let combo = widget::combo("preset", &selected, ui.available_width() - 2.0);
        let shown = combo.height(420.0).show_ui(ui, |ui| {
            let auto = auto.map(|(name, _)| name);
            let auto = (auto, auto_title.as_str());
            presets::list_ui(ui, transfer, info, auto, pictures, commands);
        });
        shown.response.named(w().colours);
    });
}

/// Both ends of the window as numbers; the handles are in the plot.
fn window_ui(
    ui: &mut Ui,
    window: Window,
    shown: [f32; 2],
    info: &SubjectInfo,
    commands: &mut Vec<Command>,
) {
    let [low, high] = info.value_range;
    let span = (high.max(shown[1]) - low.min(shown[0])).max(1e-6);
    let mut edited = shown;
    let mut result: Option<Change<[f32; 2]>> = None;
    widget::row(ui, |ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        widget::row_label(ui, w().window, w().window_hint);
        let decimals = if span > 50.0 { 0 } else { 3 };
        for (i, name) in [w().window_from, w().window_to].into_iter().enumerate() {
            let field = widget::number_field(&mut edited[i], decimals).speed(span / 600.0);
            let field = ui
                .add_sized(vec2(66.0, control_height()), field)
                .named(name)
                .on_hover_text(name);
            if let Some(change) = widget::change(&field, edited) {
                result = Some(change);
            }
        }
        if window != Window::Auto
            && widget::icon_button(ui, Icon::Reset, w().reset_window, true).clicked()
        {
            commands.push(Command::Apply(Edit::SetWindow(Window::Auto)));
        }
    });
    let tolerance = span * 1e-5;
    let is_new =
        |[from, to]: &[f32; 2]| (from - shown[0]).abs().max((to - shown[1]).abs()) > tolerance;
    if let Some(change) = result.filter(|change| is_new(change.value())) {
        let least = span * 1e-3;
        let edit =
            |[from, to]: [f32; 2]| Edit::SetWindow(Window::Range([from, to.max(from + least)]));
        commands.push(widget::command(change.map(edit)));
    }
}

/// How much the segments' own colours show.
fn tint_ui(ui: &mut Ui, look: &Look, preset: Option<&Preset>, commands: &mut Vec<Command>) {
    let own = preset.map_or(0.0, |preset| preset.tint);
    let row = PartRow {
        name: transfer_words().tint,
        summary: transfer_words().tint_hint,
        value: look.tint.unwrap_or(own),
        default: look.tint.is_some().then_some(own),
        pointer: "/look/tint",
        undo: "Change tint",
    };
    row.ui(ui, commands);
}

/// How much opacity follows the steepness of the value.
fn edges_ui(ui: &mut Ui, look: &Look, commands: &mut Vec<Command>) {
    let row = PartRow {
        name: w().edges,
        summary: w().edges_hint,
        value: look.gradient,
        default: Some(0.0),
        pointer: "/look/gradient",
        undo: "Change edges",
    };
    row.ui(ui, commands);
}

/// A row for a number from 0 to 1 of the document, shown in percent.
struct PartRow {
    name: &'static str,
    summary: &'static str,
    /// From 0 to 1, as `default`.
    value: f32,
    /// What the reset button sets; `None` hides the button.
    default: Option<f32>,
    /// JSON pointer of the number in the document.
    pointer: &'static str,
    /// Name of the change in the undo menu.
    undo: &'static str,
}

impl PartRow {
    fn ui(&self, ui: &mut Ui, commands: &mut Vec<Command>) {
        let names = (self.name, self.summary);
        if let Some(change) = entry::part_row(ui, names, self.value, self.default) {
            commands.push(widget::command(change.map(|part| Edit::Set {
                pointer: self.pointer.to_owned(),
                value: part.into(),
                name: self.undo.to_owned(),
            })));
        }
    }
}

fn background_ui(ui: &mut Ui, background: Background, commands: &mut Vec<Command>) {
    let palette = Palette::get(ui);
    widget::heading(ui, w().background, |_| {});
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 6.0;
        for (color, name) in BACKGROUNDS {
            let is_selected = background == Background::Color(color);
            let [r, g, b] = color;
            let fill = egui::Color32::from_rgb(r, g, b);
            if swatch(ui, name(w()), is_selected, |ui, rect| {
                ui.painter().circle(
                    rect.center(),
                    11.0,
                    fill,
                    egui::Stroke::new(1.0, palette.weak),
                );
            }) {
                commands.push(Command::Apply(Edit::SetBackground(Background::Color(
                    color,
                ))));
            }
        }
        if swatch(
            ui,
            w().transparent,
            background == Background::None,
            |ui, rect| {
                ui.painter().circle(
                    rect.center(),
                    11.0,
                    palette.raised,
                    egui::Stroke::new(1.0, palette.weak),
                );
                let d = vec2(7.5, -7.5);
                ui.painter().line_segment(
                    [rect.center() - d, rect.center() + d],
                    egui::Stroke::new(1.5, palette.danger),
                );
            },
        ) {
            commands.push(Command::Apply(Edit::SetBackground(Background::None)));
        }
        let mut color = match background {
            Background::Color(color) => color,
            Background::None => [255; 3],
        };
        let response = ui
            .color_edit_button_srgb(&mut color)
            .named(w().background_colour)
            .on_hover_text(w().any_colour);
        if response.changed() {
            commands.push(Command::Drag(Edit::SetBackground(Background::Color(color))));
        }
    });
}

/// A round choice. True if it was taken.
fn swatch(ui: &mut Ui, name: &str, is_selected: bool, paint: impl FnOnce(&Ui, egui::Rect)) -> bool {
    let palette = Palette::get(ui);
    let (rect, response) =
        ui.allocate_exact_size(egui::Vec2::splat(control_height()), egui::Sense::click());
    let full_name = fill(w().background_is, &[&name]);
    response.widget_info(|| {
        egui::WidgetInfo::selected(
            egui::Role::RadioButton,
            ui.is_enabled(),
            is_selected,
            &full_name,
        )
    });
    paint(ui, rect);
    if is_selected {
        ui.painter()
            .circle_stroke(rect.center(), 13.5, egui::Stroke::new(2.0, palette.accent));
    } else if response.hovered() {
        ui.painter()
            .circle_stroke(rect.center(), 13.5, egui::Stroke::new(1.0, palette.weak));
    }
    widget::focus_ring(ui, &response, rect);
    response.on_hover_text(name).clicked()
}
