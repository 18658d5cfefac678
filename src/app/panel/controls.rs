//! Values that the readers of a lesson may move themselves (`controls` of the document).

use egui::{Align2, Label, RichText, TextEdit, Ui, vec2};
use serde_json::{Value, json};

use crate::app::kit::icon::Icon;
use crate::app::kit::theme::{self, Palette};
use crate::app::kit::widget::{self, Named as _};
use crate::app::session::{Command, Session};
use crate::app::words::controls::w;
use crate::app::words::{fill, kinds, names};
use crate::document::{Control, Edit, Illustration, MAX_CONTROLS, ParamKind};

/// Draws the list of controls, a row each, with buttons to add and to remove one.
pub(crate) fn ui(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    let illustration = session.illustration();
    let listed = session
        .document()
        .get("/controls")
        .and_then(Value::as_array);
    let listed = listed.cloned().unwrap_or_default();
    let free = values(illustration);
    let mut change = |controls: Vec<Value>, is_dragged: bool| {
        let edit = Edit::Set {
            pointer: "/controls".to_owned(),
            value: controls.into(),
            name: "Change controls".to_owned(),
        };
        commands.push(match is_dragged {
            true => Command::Drag(edit),
            false => Command::Apply(edit),
        });
    };
    widget::heading(ui, w().heading, |ui| {
        let has_room = listed.len() < MAX_CONTROLS && !free.is_empty();
        let add = widget::icon_button(ui, Icon::Plus, w().add, has_room);
        egui::Popup::menu(&add).show(|ui| {
            egui::ScrollArea::vertical()
                .max_height(320.0)
                .show(ui, |ui| {
                    for (pointer, name) in &free {
                        if ui.button(name).clicked() {
                            let new = json!({ "pointer": pointer, "name": name });
                            change(listed.iter().cloned().chain([new]).collect(), false);
                        }
                    }
                });
        });
    });
    if illustration.controls.is_empty() {
        let hint = RichText::new(w().none).small().color(Palette::get(ui).weak);
        ui.add(Label::new(hint).wrap());
    }
    for control in &illustration.controls {
        let Some(index) = listed
            .iter()
            .position(|one| one["pointer"] == control.pointer)
        else {
            continue;
        };
        ui.push_id(("control", index), |ui| {
            widget::row(ui, |ui| row_ui(ui, control, index, &listed, &mut change));
        });
    }
    ui.add_space(6.0);
}

fn row_ui(
    ui: &mut Ui,
    control: &Control,
    index: usize,
    listed: &[Value],
    change: &mut impl FnMut(Vec<Value>, bool),
) {
    let mut name = control.name.clone();
    let field = TextEdit::singleline(&mut name)
        .align(Align2::LEFT_CENTER)
        .min_size(vec2(0.0, theme::control_height()))
        .desired_width(ui.available_width() - theme::control_height() - 8.0);
    let what = fill(w().name_of, &[&control.pointer]);
    let field = ui.add(field).named(what).on_hover_text(&control.pointer);
    if field.changed() {
        let mut controls = listed.to_vec();
        controls[index]["name"] = name.into();
        change(controls, true);
    }
    let remove = fill(w().remove, &[&control.name]);
    if widget::icon_button(ui, Icon::Trash, &remove, true).clicked() {
        let mut controls = listed.to_vec();
        controls.remove(index);
        change(controls, false);
    }
}

/// Numbers and switches of the templates that no control moves yet: pointer and name.
fn values(illustration: &Illustration) -> Vec<(String, String)> {
    let mut values = Vec::new();
    for template in &illustration.templates {
        let title = names::template_title(template);
        let at = format!("/templates/{}", template.index);
        for (index, param) in template.kind.spec().params.iter().enumerate() {
            if matches!(
                param.kind,
                ParamKind::Number { .. } | ParamKind::Count { .. } | ParamKind::Flag { .. }
            ) {
                let name = kinds::param_name(template.kind, index);
                values.push((
                    format!("{at}/params/{}", param.name),
                    format!("{title}: {name}"),
                ));
            }
        }
        values.push((format!("{at}/enabled"), fill(w().is_on, &[&title])));
    }
    let is_free = |(pointer, _): &(String, String)| {
        let mut taken = illustration.controls.iter();
        taken.all(|control| control.pointer != *pointer)
    };
    values.retain(is_free);
    values
}
