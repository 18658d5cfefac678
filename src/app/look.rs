//! Colours and light: preset, window, opacity, background.

use egui::{DragValue, RangeSlider, Ui, vec2};

use super::command::Command;
use super::control::{self, Change};
use super::icon::Icon;
use super::state::State;
use super::templates::command;
use super::theme::{CONTROL_HEIGHT, Palette};
use super::words::look::{Look, w};
use super::words::{fill, names};
use crate::document::{
    Background, Edit, OpacityMode, Preset, Transfer, TransferPoint, Window, preset, presets,
};
use crate::render::{SubjectInfo, auto_preset, window_of};

/// Backgrounds at a click: paper, warm paper, grey, slate, black.
const BACKGROUNDS: [([u8; 3], fn(&Look) -> &'static str); 5] = [
    ([255, 255, 255], |w| w.white),
    ([246, 241, 231], |w| w.paper),
    ([200, 204, 208], |w| w.grey),
    ([38, 43, 48], |w| w.slate),
    ([0, 0, 0], |w| w.black),
];

/// The panel. `info` is what is known of the volume shown.
pub(crate) fn ui(
    ui: &mut Ui,
    state: &State,
    info: Option<&SubjectInfo>,
    commands: &mut Vec<Command>,
) {
    let look = &state.illustration().look;
    control::heading(ui, w().heading, |_| {});
    let auto = info.map(|info| auto_preset(&state.illustration().subject, info));
    transfer_ui(ui, &look.transfer, auto, commands);
    let name = match &look.transfer {
        Transfer::Auto => auto,
        Transfer::Preset(name) => Some(name.as_str()),
        Transfer::Points(_) => None,
    };
    if let (Some(info), Some(preset)) = (info, name.and_then(preset)) {
        window_ui(ui, look.window, preset, info, commands);
    }
    control::divider(ui);
    control::heading(ui, w().opacity_heading, |_| {});
    let options = [
        (OpacityMode::Constancy, w().surfaces),
        (OpacityMode::Mass, w().mass),
        (OpacityMode::None, w().as_it_is),
    ];
    if let Some(mode) = control::segmented(ui, w().opacity, &options, look.opacity) {
        commands.push(Command::Apply(Edit::SetOpacity(mode)));
    }
    let hint = match look.opacity {
        OpacityMode::Constancy => w().surfaces_hint,
        OpacityMode::Mass => w().mass_hint,
        OpacityMode::None => w().as_it_is_hint,
    };
    let weak = Palette::get(ui).weak;
    ui.add(egui::Label::new(egui::RichText::new(hint).small().color(weak)).wrap());
    control::divider(ui);
    background_ui(ui, look.background, commands);
}

fn transfer_ui(ui: &mut Ui, transfer: &Transfer, auto: Option<&str>, commands: &mut Vec<Command>) {
    let title = |name: &str| {
        presets()
            .iter()
            .find(|preset| preset.name == name)
            .map_or_else(
                || name.to_owned(),
                |p| names::preset(p.name, p.title).to_owned(),
            )
    };
    let auto = auto.map_or_else(
        || w().automatic.to_owned(),
        |name| fill(w().automatic_is, &[&title(name)]),
    );
    let selected = match transfer {
        Transfer::Auto => auto.clone(),
        Transfer::Preset(name) => title(name),
        Transfer::Points(points) => fill(w().own_points, &[&points.len()]),
    };
    control::row(ui, |ui| {
        control::row_label(ui, w().colours, w().colours_hint);
        let combo = control::combo("preset", &selected, ui.available_width() - 2.0);
        let shown = combo.height(420.0).show_ui(ui, |ui| {
            if ui
                .selectable_label(*transfer == Transfer::Auto, auto)
                .clicked()
            {
                commands.push(Command::Apply(Edit::SetTransfer(Transfer::Auto)));
            }
            for preset in presets() {
                let is_selected = matches!(transfer, Transfer::Preset(name) if name == preset.name);
                if ui
                    .selectable_label(is_selected, names::preset(preset.name, preset.title))
                    .clicked()
                {
                    let transfer = Transfer::Preset(preset.name.to_owned());
                    commands.push(Command::Apply(Edit::SetTransfer(transfer)));
                }
            }
        });
        shown.response.accessible_name(w().colours);
    });
    if let Transfer::Points(points) = transfer {
        points_ui(ui, points, commands);
    }
}

/// Listed points: value, colour, opacity.
fn points_ui(ui: &mut Ui, points: &[TransferPoint], commands: &mut Vec<Command>) {
    let send = |points: Vec<TransferPoint>, is_drag: bool| {
        let edit = Edit::SetTransfer(Transfer::Points(points));
        if is_drag {
            Command::Drag(edit)
        } else {
            Command::Apply(edit)
        }
    };
    for (i, point) in points.iter().enumerate() {
        control::row(ui, |ui| {
            let mut edited = *point;
            let color = ui.color_edit_button_srgb(&mut edited.color_srgb);
            let color = color.accessible_name(fill(w().colour_n, &[&(i + 1)]));
            let value = ui.add_sized(
                vec2(76.0, CONTROL_HEIGHT),
                DragValue::new(&mut edited.value).speed(2.0).max_decimals(2),
            );
            let value = value
                .accessible_name(fill(w().value_n, &[&(i + 1)]))
                .on_hover_text(w().value);
            let field = DragValue::new(&mut edited.opacity)
                .range(0.0..=1.0)
                .speed(0.005)
                .max_decimals(3);
            let opacity = ui.add_sized(vec2(60.0, CONTROL_HEIGHT), field);
            let opacity = opacity
                .accessible_name(fill(w().opacity_n, &[&(i + 1)]))
                .on_hover_text(w().opacity_hint);
            if color.changed() || value.changed() || opacity.changed() {
                let is_drag = value.is_pointer_button_down_on()
                    || opacity.is_pointer_button_down_on()
                    || color.changed();
                let mut points = points.to_vec();
                points[i] = edited;
                commands.push(send(points, is_drag));
            }
            let name = fill(w().remove_point, &[&(i + 1)]);
            if control::icon_button(ui, Icon::Close, &name, points.len() > 1).clicked() {
                let mut points = points.to_vec();
                points.remove(i);
                commands.push(send(points, false));
            }
        });
    }
    if control::labelled_button(ui, Icon::Plus, w().add_point, false, points.len() < 64).clicked() {
        let mut points = points.to_vec();
        if let Some(last) = points.last().copied() {
            points.push(TransferPoint {
                value: last.value + 100.0,
                ..last
            });
        }
        commands.push(send(points, false));
    }
}

fn window_ui(
    ui: &mut Ui,
    window: Window,
    preset: &Preset,
    info: &SubjectInfo,
    commands: &mut Vec<Command>,
) {
    let shown = window_of(window, preset, info);
    let [low, high] = info.value_range;
    let (low, high) = (low.min(shown[0]), high.max(shown[1]));
    let span = (high - low).max(1e-6);
    let mut edited = shown;
    let mut result: Option<Change<[f32; 2]>> = None;
    control::row(ui, |ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        control::row_label(ui, w().window, w().window_hint);
        let width = 66.0;
        let decimals = if span > 50.0 { 0 } else { 3 };
        for (i, name) in [w().window_from, w().window_to].into_iter().enumerate() {
            let field = DragValue::new(&mut edited[i])
                .speed(span / 600.0)
                .max_decimals(decimals)
                .custom_formatter(|value, _| control::plain(value, decimals))
                .update_while_editing(false);
            let field = ui
                .add_sized(vec2(width, CONTROL_HEIGHT), field)
                .accessible_name(name)
                .on_hover_text(name);
            if let Some(change) = control::change(&field, edited) {
                result = Some(change);
            }
        }
        if window != Window::Auto
            && control::icon_button(ui, Icon::Reset, w().reset_window, true).clicked()
        {
            commands.push(Command::Apply(Edit::SetWindow(Window::Auto)));
        }
    });
    let [mut from, mut to] = shown;
    let width = ui.available_width();
    let slider = control::slim(ui, width, |ui| {
        ui.name_inputs(w().window_slider, |ui| {
            ui.add(RangeSlider::new(&mut from, &mut to, low..=high).show_value(false))
        })
    });
    if let Some(change) = control::change(&slider, [from, to]) {
        result = Some(change);
    }
    let tolerance = span * 1e-5;
    let is_new =
        |[from, to]: &[f32; 2]| (from - shown[0]).abs().max((to - shown[1]).abs()) > tolerance;
    if let Some(change) = result.filter(|change| is_new(change.value())) {
        let least = span * 1e-3;
        let edit =
            |[from, to]: [f32; 2]| Edit::SetWindow(Window::Range([from, to.max(from + least)]));
        commands.push(command(change.map(edit)));
    }
}

fn background_ui(ui: &mut Ui, background: Background, commands: &mut Vec<Command>) {
    let palette = Palette::get(ui);
    control::heading(ui, w().background, |_| {});
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
            .accessible_name(w().background_colour)
            .on_hover_text(w().any_colour);
        if response.changed() {
            commands.push(Command::Drag(Edit::SetBackground(Background::Color(color))));
        }
    });
}

/// A round choice. True if it was taken.
fn swatch(ui: &mut Ui, name: &str, is_selected: bool, paint: impl FnOnce(&Ui, egui::Rect)) -> bool {
    let palette = Palette::get(ui);
    let (rect, response) = ui.allocate_exact_size(egui::Vec2::splat(28.0), egui::Sense::click());
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
    control::focus_ring(ui, &response, rect);
    response.on_hover_text(name).clicked()
}
