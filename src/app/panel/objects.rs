//! The list of objects of the scene and everything about the selected one: where it lies, colours, light, group.

use egui::{Label, RichText, Ui};
use serde_json::json;

use crate::app::kit::entry::{self, EntryRow, rotation_row, vec3};
use crate::app::kit::icon::Icon;
use crate::app::kit::menu::menu_item;
use crate::app::kit::theme::Palette;
use crate::app::kit::widget::{self, Change, NumberRow};
use crate::app::session::objects::{enabling, object_edit, regrouping};
use crate::app::session::{Command, Session};
use crate::app::words::objects::{tool, w};
use crate::app::words::{self, fill, templates, tissue};
use crate::document::{
    Edit, MAX_OBJECTS, ObjectPlacement, ObjectSource, SceneObject, color_text, groups,
    object_group_of,
};

/// How far from the middle the fields let an object lie, subject units, and how large they let it be.
const AT: [f64; 2] = [-10.0, 10.0];
const SIZE: [f64; 2] = [0.001, 10.0];
/// Shown where an object has colours of its own: steel.
const OWN: [u8; 3] = [0xc4, 0xc8, 0xcc];

/// The list of objects, folded into its heading while there are none.
pub(super) fn list_ui(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    let count = session.object_count();
    widget::heading(ui, w().heading, |ui| {
        add_ui(ui, count < MAX_OBJECTS, commands);
        if count == 0 {
            return;
        }
        let from = session.selection.object();
        let can_down = from.is_some_and(|from| from + 1 < count);
        if widget::icon_button(ui, Icon::Down, w().down, can_down).clicked() {
            commands.push(Command::ShiftSelected(1));
        }
        let can_up = from.is_some_and(|from| from > 0);
        if widget::icon_button(ui, Icon::Up, w().up, can_up).clicked() {
            commands.push(Command::ShiftSelected(-1));
        }
    });
    for index in 0..count {
        row_ui(ui, session, index, commands);
    }
}

/// The button that opens the list of tools.
fn add_ui(ui: &mut Ui, has_room: bool, commands: &mut Vec<Command>) {
    let add = widget::icon_button(ui, Icon::Plus, w().add, has_room);
    let add = match has_room {
        true => add.on_hover_text(w().heading_hint),
        false => add.on_disabled_hover_text(w().full),
    };
    egui::Popup::menu(&add).show(|ui| {
        ui.set_min_width(180.0);
        ui.set_max_width(200.0);
        ui.spacing_mut().item_spacing.y = 0.0;
        for builtin in SceneObject::BUILTINS {
            if menu_item(ui, Icon::Plus, tool(builtin)) {
                commands.push(Command::AddTool(builtin));
                ui.close();
            }
        }
        let weak = Palette::get(ui).weak;
        ui.add_space(2.0);
        ui.add(Label::new(RichText::new(w().add_hint).small().color(weak)).wrap());
    });
}

fn row_ui(ui: &mut Ui, session: &Session, index: usize, commands: &mut Vec<Command>) {
    let object = session.object(index);
    let title = object.map_or(w().unknown, |object| &object.name);
    let group = object_group_of(session.document(), index);
    let mut notes = Vec::new();
    if let Some(object) = object {
        let kind = kind_of(object);
        // A tool that is called what it is needs no second word.
        if !title.to_lowercase().starts_with(&kind.to_lowercase()) {
            notes.push(kind);
        }
    }
    if !group.is_empty() {
        notes.push(group);
    }
    let is_selected = session.selection.object() == Some(index);
    let row = EntryRow {
        id: ("object row", index),
        name: &fill(w().row, &[&(index + 1), &title]),
        title,
        note: &notes.join(", "),
        is_selected,
        has_grip: false,
        group: groups(session.document()).iter().position(|g| g == group),
        is_shown: object.map(|object| object.enabled),
    };
    let entry = row.ui(ui);
    if let Some(object) = object.filter(|_| entry.is_toggled) {
        commands.push(Command::Apply(enabling(object, !object.enabled)));
    }
    if entry.response.clicked() {
        let index = (!is_selected).then_some(index);
        commands.push(Command::SelectObject(index));
    }
}

/// What sort of thing it is.
fn kind_of(object: &SceneObject) -> &'static str {
    match object.source {
        ObjectSource::Builtin(name) => tool(name),
        ObjectSource::File { .. } => w().mesh,
    }
}

/// Everything about the selected object, if one is selected.
pub(super) fn selected_ui(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    if session.selection.object().is_none() {
        return;
    }
    widget::divider(ui);
    let object = session.selected_object();
    widget::heading(ui, object.map_or(w().unknown, kind_of), |ui| {
        if widget::icon_button(ui, Icon::Trash, w().delete, true).clicked() {
            commands.push(Command::DeleteSelected);
        }
        if widget::icon_button(ui, Icon::Copy, w().duplicate, true).clicked() {
            commands.push(Command::DuplicateSelected);
        }
    });
    let Some(object) = object else {
        let weak = Palette::get(ui).weak;
        ui.add(Label::new(RichText::new(w().unknown_hint).color(weak)).wrap());
        return;
    };
    ui.push_id(("object", object.index), |ui| {
        let hints = (kind_of(object), w().name_hint);
        let id = ("object name", object.index);
        if let Some(name) = entry::name_row(ui, id, &object.name, hints) {
            let edit = session.renamed_object(object, &name);
            commands.push(Command::Drag(edit));
        }
        match object.placement {
            Some(placement) => placement_ui(ui, object, placement, commands),
            None => from_file_ui(ui, session, object, commands),
        }
        look_ui(ui, object, commands);
        let current = object_group_of(session.document(), object.index);
        let known = groups(session.document());
        if let Some(group) = entry::group_row(ui, current, &known, w().group_hint) {
            commands.push(Command::Apply(regrouping(object, &group)));
        }
    });
}

/// An object with a file lies where that says until it is placed.
fn from_file_ui(ui: &mut Ui, session: &Session, object: &SceneObject, commands: &mut Vec<Command>) {
    let weak = Palette::get(ui).weak;
    ui.add(Label::new(RichText::new(w().from_file).color(weak)).wrap());
    if widget::labelled_button(ui, Icon::Grip, w().place_here, false, true).clicked() {
        let placement = ObjectPlacement {
            at: session.camera.target,
            ..ObjectPlacement::DOCUMENT_DEFAULT
        };
        commands.push(Command::Apply(Edit::PlaceObject {
            object: object.index,
            placement,
        }));
    }
}

fn placement_ui(
    ui: &mut Ui,
    object: &SceneObject,
    placement: ObjectPlacement,
    commands: &mut Vec<Command>,
) {
    let mut send = |change: Change<ObjectPlacement>| {
        let edit = |placement| Edit::PlaceObject {
            object: object.index,
            placement,
        };
        commands.push(widget::command(change.map(edit)));
    };
    let at = placement.at.to_array().map(f64::from);
    let t = templates::w();
    if let Some(change) = widget::vector_row(ui, w().position, t.centre_hint, at, AT, "", 3) {
        send(change.map(|v| ObjectPlacement {
            at: vec3(v),
            ..placement
        }));
    }
    if let Some(change) = rotation_row(ui, t.turned, w().turned_hint, placement.rotate) {
        send(change.map(|rotate| ObjectPlacement {
            rotate,
            ..placement
        }));
    }
    let row = NumberRow {
        name: t.size,
        summary: w().size_hint,
        value: f64::from(placement.size),
        default: Some(f64::from(ObjectPlacement::DOCUMENT_DEFAULT.size)),
        range: SIZE,
        unit: "",
        decimals: 3,
    };
    if let Some(change) = row.ui_logarithmic(ui) {
        send(change.map(|size| ObjectPlacement {
            size: size as f32,
            ..placement
        }));
    }
}

/// Colours, opacity and gloss.
fn look_ui(ui: &mut Ui, object: &SceneObject, commands: &mut Vec<Command>) {
    let inside = words::bodies::w();
    let colors = [
        (
            ("color", "colour"),
            (tissue::w().color, ""),
            (object.color_srgb, OWN),
            w().own_colour,
        ),
        (
            ("inside", "inside colour"),
            (inside.inside, inside.inside_hint),
            (object.inside_srgb, object.color_srgb.unwrap_or(OWN)),
            inside.inside_auto,
        ),
    ];
    for ((key, what), names, color, reset) in colors {
        if let Some(change) = entry::color_row(ui, names, color, reset) {
            commands.push(widget::command(change.map(|color| {
                object_edit(object, key, color.map(|c| json!(color_text(c))), what)
            })));
        }
    }
    let parts = [
        (
            ("opacity", "opacity"),
            (tissue::w().opacity, w().opacity_hint),
            (object.opacity, 1.0),
        ),
        (
            ("gloss", "gloss"),
            (inside.gloss, inside.gloss_hint),
            (object.gloss, SceneObject::DEFAULT_GLOSS),
        ),
    ];
    for ((key, what), names, (value, default)) in parts {
        if let Some(change) = entry::part_row(ui, names, value, default) {
            let edit = |part: f64| object_edit(object, key, Some(json!(part)), what);
            commands.push(widget::command(change.map(edit)));
        }
    }
}
