//! What the bodies of meshes are made of: hollow, a shell or full, and the layers that cuts show.

use egui::{Align2, Label, RichText, TextEdit, Ui, vec2};
use serde_json::{Value, json};

use crate::app::kit::entry;
use crate::app::kit::icon::Icon;
use crate::app::kit::theme::{self, Palette};
use crate::app::kit::widget::{self, Named as _, NumberRow};
use crate::app::session::{ClayCommand, Command, Session};
use crate::app::words::bodies::w;
use crate::app::words::{clay, fill};
use crate::document::{BodyKind, Edit, Layer, MAX_LAYERS, SurfaceLook, color_text};

/// Shown where the inside or a layer has no colour of its own: the colour of a mesh whose file gives none, darker.
const OWN: [u8; 3] = [0xbd, 0xb3, 0xa3];
/// A new layer begins so much below the one before it, subject units.
const BELOW: f64 = 0.02;
/// Colours of new layers, from the outside in.
const NEW: [[u8; 3]; 4] = [
    [0xd8, 0x9a, 0x7a],
    [0xe8, 0xd9, 0xae],
    [0xb8, 0x5a, 0x4a],
    [0xf2, 0xea, 0xdc],
];

/// The bodies of a subject of meshes and their layers.
pub(crate) fn ui(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    let surface = &session.shown().look.surface;
    widget::heading(ui, w().heading, |_| {});
    let options = [
        (BodyKind::Auto, w().auto, w().auto_hint),
        (BodyKind::Hollow, w().hollow, w().hollow_hint),
        (BodyKind::Thick, w().thick, w().thick_hint),
        (BodyKind::Solid, w().solid, w().solid_hint),
    ];
    if let Some(body) = widget::explained(ui, w().body, &options, surface.body) {
        let edit = set("body", json!(body.name()), "Change bodies");
        commands.push(Command::Apply(edit));
    }
    let hint = options
        .iter()
        .find(|(body, _, _)| *body == surface.body)
        .map_or("", |(_, _, hint)| hint);
    let weak = Palette::get(ui).weak;
    ui.add(Label::new(RichText::new(hint).small().color(weak)).wrap());
    if surface.body == BodyKind::Thick {
        thickness_ui(ui, surface, commands);
    }
    let names = (w().inside, w().inside_hint);
    let color = (surface.inside_srgb, OWN);
    if let Some(change) = entry::color_row(ui, names, color, w().inside_auto) {
        let name = "Change inside colour";
        let edit = |color: Option<[u8; 3]>| {
            let value = color.map(|color| json!(color_text(color)));
            Edit::put("/look/inside".to_owned(), value, name.to_owned())
        };
        commands.push(widget::command(change.map(edit)));
    }
    let names = (w().gloss, w().gloss_hint);
    let default = SurfaceLook::DEFAULT_GLOSS;
    if let Some(change) = entry::part_row(ui, names, surface.gloss, default) {
        let edit = |part: f64| set("gloss", json!(part), "Change gloss");
        commands.push(widget::command(change.map(edit)));
    }
    widget::divider(ui);
    layers_ui(ui, session, &surface.layers, commands);
    if let Some(start) = session.clay_start(None, 0.0) {
        widget::divider(ui);
        let words = clay::w();
        let begin = widget::labelled_button(ui, Icon::Brush, words.begin, false, true);
        if begin.on_hover_text(words.begin_mesh_hint).clicked() {
            commands.push(Command::Clay(ClayCommand::Begin(start)));
        }
    }
}

/// Sets a key of the look.
fn set(key: &str, value: Value, name: &str) -> Edit {
    Edit::Set {
        pointer: format!("/look/{key}"),
        value,
        name: name.to_owned(),
    }
}

/// To as many decimals as its field shows.
fn rounded(value: f64) -> Value {
    json!((value * 1e3).round() / 1e3)
}

fn thickness_ui(ui: &mut Ui, surface: &SurfaceLook, commands: &mut Vec<Command>) {
    let row = NumberRow {
        name: w().thickness,
        summary: w().thickness_hint,
        value: f64::from(surface.thickness),
        default: Some(f64::from(SurfaceLook::DEFAULT_THICKNESS)),
        range: SurfaceLook::THICKNESS_RANGE.map(f64::from),
        unit: "",
        decimals: 3,
    };
    if let Some(change) = row.ui_logarithmic(ui) {
        let edit = |value: f64| set("thickness", rounded(value), "Change thickness");
        commands.push(widget::command(change.map(edit)));
    }
}

fn layers_ui(ui: &mut Ui, session: &Session, layers: &[Layer], commands: &mut Vec<Command>) {
    let has_room = layers.len() < MAX_LAYERS;
    widget::heading(ui, w().layers, |ui| {
        let add = widget::icon_button(ui, Icon::Plus, w().add_layer, has_room);
        if add.on_disabled_hover_text(w().full).clicked() {
            commands.push(Command::Apply(added(session, layers)));
        }
    });
    if layers.is_empty() {
        let weak = Palette::get(ui).weak;
        ui.add(Label::new(RichText::new(w().no_layers).small().color(weak)).wrap());
    }
    for (place, layer) in layers.iter().enumerate() {
        if place > 0 {
            ui.add_space(6.0);
        }
        ui.push_id(("layer", layer.index), |ui| {
            layer_ui(ui, session, place + 1, layer, commands);
        });
    }
}

/// The edit that adds a layer below all others.
fn added(session: &Session, layers: &[Layer]) -> Edit {
    let below = |layer: &Layer| (f64::from(layer.depth) + BELOW).min(1.0);
    let depth = layers.last().map_or(0.0, below);
    let color = NEW[layers.len() % NEW.len()];
    let name = fill(w().layer_n, &[&(layers.len() + 1)]);
    let layer = json!({ "depth": rounded(depth), "name": name, "color": color_text(color) });
    session.layers_edit("Add layer", |list| {
        list.extend(layer.as_object().cloned());
    })
}

/// One layer; `number` is its place from the outside in, from 1.
fn layer_ui(
    ui: &mut Ui,
    session: &Session,
    number: usize,
    layer: &Layer,
    commands: &mut Vec<Command>,
) {
    let changed = |key: &str, value: Value| {
        session.layers_edit("Change layer", |list| {
            if let Some(entry) = list.get_mut(layer.index) {
                entry.insert(key.to_owned(), value);
            }
        })
    };
    widget::row(ui, |ui| {
        let mut color = layer.color_srgb.unwrap_or(OWN);
        let button = ui.color_edit_button_srgb(&mut color);
        if button.named(fill(w().colour_of, &[&number])).changed() {
            commands.push(Command::Drag(changed("color", json!(color_text(color)))));
        }
        let mut name = layer.name.clone();
        let title = fill(w().layer_n, &[&number]);
        let room = ui.available_width() - theme::control_height() - 8.0;
        let field = TextEdit::singleline(&mut name)
            .hint_text(&title)
            .desired_width(room)
            .min_size(vec2(0.0, theme::control_height()))
            .align(Align2::LEFT_CENTER)
            .char_limit(80);
        if ui.add(field).named(fill(w().name_of, &[&number])).changed() {
            commands.push(Command::Drag(changed("name", json!(name))));
        }
        let shown = if layer.name.is_empty() {
            &title
        } else {
            &layer.name
        };
        let remove = fill(w().remove_layer, &[shown]);
        if widget::icon_button(ui, Icon::Trash, &remove, true).clicked() {
            commands.push(Command::Apply(session.layers_edit(
                "Remove layer",
                |list| {
                    if layer.index < list.len() {
                        list.remove(layer.index);
                    }
                },
            )));
        }
    });
    let row = NumberRow {
        name: w().depth,
        summary: w().depth_hint,
        value: f64::from(layer.depth),
        default: None,
        range: [0.0, 1.0],
        unit: "",
        decimals: 3,
    };
    if let Some(change) = row.ui_logarithmic(ui) {
        commands.push(widget::command(
            change.map(|value| changed("depth", rounded(value))),
        ));
    }
    let row = NumberRow {
        name: w().grain,
        summary: w().grain_hint,
        value: f64::from(layer.grain),
        default: Some(0.0),
        range: [0.0, f64::from(Layer::MAX_GRAIN)],
        unit: "",
        decimals: 2,
    };
    if let Some(change) = row.ui(ui) {
        commands.push(widget::command(
            change.map(|value| changed("grain", rounded(value))),
        ));
    }
}
