//! The list of placed templates and everything about the selected one: parameters, mode, placement.

use egui::{DragAndDrop, Label, Rect, Stroke, Ui, vec2};

use super::{carve, clay, curve, figure, hand, kept, objects, points, sweep};
use crate::app::kit::entry::{self, EntryRow, rotation_row, vec3};
use crate::app::kit::icon::Icon;
use crate::app::kit::template_menu;
use crate::app::kit::theme::Palette;
use crate::app::kit::widget::{self, Change, Named as _, NumberRow};
use crate::app::session::{Command, LibraryCommand, Session};
use crate::app::words::templates::w;
use crate::app::words::{self, kinds, names};
use crate::data::Segment;
use crate::displace::Holds;
use crate::document::{
    Edit, ParamKind, ParamSpec, ParamValue, PlacedTemplate, TemplateMode, group_of, groups,
};
use crate::math::Placement;

/// The lists of templates and of objects, then what is selected in one of them.
pub(crate) fn ui(
    ui: &mut Ui,
    session: &Session,
    segments: &[Segment],
    inside: &[String],
    commands: &mut Vec<Command>,
) {
    if session.view.is_figure() {
        return figure::ui(ui, session, commands);
    }
    clay::ui(ui, session, commands);
    if session.is_sweeping() {
        widget::heading(ui, words::sweep::w().in_hand, |_| {});
        hand::ui(ui, session.hand(), commands);
        widget::divider(ui);
    }
    list_ui(ui, session, commands);
    let has_objects = session.object_count() > 0;
    if has_objects {
        widget::divider(ui);
        objects::list_ui(ui, session, commands);
        objects::selected_ui(ui, session, commands);
    }
    if let Some(template) = session.selected_template() {
        widget::divider(ui);
        template_ui(ui, session, (segments, inside), template, commands);
    } else if let Some(index) = session.selection.template() {
        widget::divider(ui);
        let weak = Palette::get(ui).weak;
        let text = w().unknown_kind;
        ui.add(Label::new(egui::RichText::new(text).color(weak)).wrap());
        if widget::labelled_button(ui, Icon::Trash, w().delete, false, true).clicked() {
            commands.push(Command::Apply(Edit::RemoveTemplate { template: index }));
        }
    }
    // While there are none they take no room from the selected template.
    if !has_objects {
        widget::divider(ui);
        objects::list_ui(ui, session, commands);
    }
}

/// An entry of the list that is being dragged: its index in the document.
#[derive(Clone, Copy)]
struct DraggedRow(usize);

fn list_ui(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    let count = session.template_count();
    widget::heading(ui, w().heading, |ui| {
        let from = session.selection.template();
        let can_later = from.is_some_and(|from| from + 1 < count);
        if widget::icon_button(ui, Icon::Down, w().later, can_later).clicked() {
            commands.push(Command::ShiftSelected(1));
        }
        let can_earlier = from.is_some_and(|from| from > 0);
        if widget::icon_button(ui, Icon::Up, w().earlier, can_earlier).clicked() {
            commands.push(Command::ShiftSelected(-1));
        }
    });
    if count == 0 {
        let weak = Palette::get(ui).weak;
        let text = w().nothing_placed;
        ui.add(Label::new(egui::RichText::new(text).color(weak)).wrap());
        ui.add_space(4.0);
        let example = words::library::w().or_example;
        if widget::labelled_button(ui, Icon::Book, example, false, true).clicked() {
            commands.push(Command::Library(LibraryCommand::Toggle));
        }
        return;
    }
    let mut drop_at = None;
    for index in 0..count {
        let row = row_ui(ui, session, index, commands);
        if let (Some(dragged), Some(pointer)) = (
            DragAndDrop::payload::<DraggedRow>(ui.ctx()),
            ui.input(|i| i.pointer.interact_pos()),
        ) && row.expand2(vec2(40.0, 3.0)).contains(pointer)
        {
            let is_after = pointer.y > row.center().y;
            let y = if is_after {
                row.bottom() + 2.0
            } else {
                row.top() - 2.0
            };
            ui.painter()
                .hline(row.x_range(), y, Stroke::new(2.5, Palette::get(ui).accent));
            let gap = index + usize::from(is_after);
            // Taking the row out first moves everything behind it up by one.
            drop_at = Some((dragged.0, if gap > dragged.0 { gap - 1 } else { gap }));
        }
    }
    if ui.input(|i| i.pointer.any_released())
        && let Some((from, to)) = drop_at
    {
        DragAndDrop::clear_payload(ui.ctx());
        if from != to {
            commands.push(Command::Select(Some(to)));
            commands.push(Command::Apply(Edit::MoveTemplate { from, to }));
        }
    }
    if count > 1 {
        let weak = Palette::get(ui).weak;
        ui.label(egui::RichText::new(w().order).small().color(weak));
    }
}

/// One entry; returns its rectangle.
fn row_ui(ui: &mut Ui, session: &Session, index: usize, commands: &mut Vec<Command>) -> Rect {
    let template = session.template(index);
    let title = template.map_or_else(|| w().unknown.to_owned(), names::template_title);
    let is_selected = session.selection.template() == Some(index);
    let group = group_of(session.document(), index);
    let mut notes = Vec::new();
    if let Some(template) = template {
        if !template.name.is_empty() {
            notes.push(kinds::title(template.kind));
        }
        if template.mode == TemplateMode::Add && index > 0 {
            notes.push(w().added);
        }
        if !group.is_empty() {
            notes.push(group);
        }
    }
    let row = EntryRow {
        id: ("row", index),
        name: &format!("{}. {title}", index + 1),
        title: &title,
        note: &notes.join(", "),
        is_selected,
        has_grip: true,
        group: groups(session.document()).iter().position(|g| g == group),
        is_shown: template.map(|template| template.enabled),
    };
    let entry = row.ui(ui);
    if let Some(template) = template.filter(|_| entry.is_toggled) {
        let edit = Edit::SetEnabled {
            template: index,
            enabled: !template.enabled,
        };
        commands.push(Command::Apply(edit));
    }
    let response = entry.response;
    if response.clicked() {
        commands.push(Command::Select(if is_selected {
            None
        } else {
            Some(index)
        }));
    }
    if response.secondary_clicked() && !is_selected {
        commands.push(Command::Select(Some(index)));
    }
    response.context_menu(|ui| template_menu::ui(ui, session, commands));
    if response.drag_started() {
        response.dnd_set_drag_payload(DraggedRow(index));
    }
    response.rect
}

fn template_ui(
    ui: &mut Ui,
    session: &Session,
    (segments, inside): (&[Segment], &[String]),
    template: &PlacedTemplate,
    commands: &mut Vec<Command>,
) {
    let index = template.index;
    widget::heading(ui, kinds::title(template.kind), |ui| {
        let more = widget::icon_button(ui, Icon::More, words::authoring::w().actions, true);
        egui::Popup::menu(&more).show(|ui| template_menu::ui(ui, session, commands));
        if widget::icon_button(ui, Icon::Trash, w().delete_template, true).clicked() {
            commands.push(Command::DeleteSelected);
        }
        if widget::icon_button(ui, Icon::Copy, w().duplicate_template, true).clicked() {
            commands.push(Command::DuplicateSelected);
        }
    });
    let weak = Palette::get(ui).weak;
    ui.add(Label::new(egui::RichText::new(kinds::summary(template.kind)).color(weak)).wrap());
    ui.add_space(4.0);
    amount_ui(ui, template, commands);
    for (i, value) in template.params.iter().enumerate() {
        ui.push_id((index, i), |ui| param_ui(ui, template, i, *value, commands));
    }
    points::ui(ui, template, commands);
    sweep::ui(ui, template, commands);
    // The place of one that carves is its object's.
    let has_place = template.kind.facts().holds != Holds::Object;
    carve::ui(ui, session, template, commands);
    if has_place {
        curve::ui(ui, template, commands);
    }
    ui.add_space(2.0);
    let hints = (kinds::title(template.kind), w().name_hint);
    if let Some(name) = entry::name_row(ui, ("template name", index), &template.name, hints) {
        commands.push(Command::Drag(Edit::RenameTemplate {
            template: index,
            name,
        }));
    }
    if index > 0 {
        widget::row(ui, |ui| {
            widget::row_label(ui, w().joins, w().joins_hint);
            let options = [
                (TemplateMode::Compose, w().after, w().after_hint),
                (TemplateMode::Add, w().summed, w().summed_hint),
            ];
            if let Some(mode) = widget::explained(ui, w().joins, &options, template.mode) {
                commands.push(Command::Apply(Edit::SetMode {
                    template: index,
                    mode,
                }));
            }
        });
        sweep::join_ui(ui, &session.shown().templates, index, commands);
    }
    if session.template_count() > 1 {
        let current = group_of(session.document(), index);
        let known = groups(session.document());
        let hint = words::authoring::w().group_hint;
        if let Some(group) = entry::group_row(ui, current, &known, hint) {
            commands.push(Command::Apply(Edit::SetGroup {
                template: index,
                group,
            }));
        }
    }
    widget::divider(ui);
    let illustration = session.shown();
    kept::ui(ui, template, illustration, segments, inside, commands);
    if has_place {
        widget::divider(ui);
        placement_ui(ui, template, commands);
    }
}

/// How much of it is done.
fn amount_ui(ui: &mut Ui, template: &PlacedTemplate, commands: &mut Vec<Command>) {
    let w = words::slices::w();
    let row = NumberRow {
        name: w.amount,
        summary: w.amount_hint,
        value: f64::from(template.amount) * 100.0,
        default: Some(100.0),
        range: [0.0, 100.0],
        unit: " %",
        decimals: 0,
    };
    if let Some(change) = row.ui(ui) {
        let index = template.index;
        commands.push(widget::command(change.map(|percent| Edit::SetAmount {
            template: index,
            amount: (percent / 100.0).clamp(0.0, 1.0) as f32,
        })));
    }
}

/// True if a parameter is an angle in radians, which people read in degrees.
fn is_angle(param: &ParamSpec) -> bool {
    param.summary.ends_with(", radians")
}

fn param_ui(
    ui: &mut Ui,
    placed: &PlacedTemplate,
    index: usize,
    value: ParamValue,
    commands: &mut Vec<Command>,
) {
    let (template, kind) = (placed.index, placed.kind);
    let param = &kind.spec().params[index];
    let name = kinds::param_name(kind, index);
    let summary = kinds::param_summary(kind, index);
    let send = |change: Change<ParamValue>, commands: &mut Vec<Command>| {
        let edit = |value| Edit::SetParam {
            template,
            param: param.name,
            value,
        };
        commands.push(widget::command(change.map(edit)));
    };
    match (param.kind, value) {
        (ParamKind::Number { default, min, max }, ParamValue::Number(value)) => {
            let factor = if is_angle(param) {
                180.0 / std::f64::consts::PI
            } else {
                1.0
            };
            let shown = |v: f32| f64::from(v) * factor;
            let row = NumberRow {
                name,
                summary,
                value: shown(value),
                default: Some(shown(default)),
                range: [shown(min), shown(max)],
                unit: if is_angle(param) { "°" } else { "" },
                decimals: if is_angle(param) { 1 } else { 3 },
            };
            if let Some(change) = row.ui(ui) {
                // The ends are given as they are, so that no rounding of degrees leaves the range.
                send(
                    change.map(|v| ParamValue::Number(((v / factor) as f32).clamp(min, max))),
                    commands,
                );
            }
        }
        (ParamKind::Count { default, min, max }, ParamValue::Number(value)) => {
            let row = NumberRow {
                name,
                summary,
                value: f64::from(value),
                default: Some(f64::from(default)),
                range: [f64::from(min), f64::from(max)],
                unit: "",
                decimals: 0,
            };
            if let Some(change) = row.ui(ui) {
                send(
                    change.map(|v| ParamValue::Number((v as f32).round())),
                    commands,
                );
            }
        }
        (ParamKind::Flag { .. }, ParamValue::Flag(value)) => {
            widget::row(ui, |ui| {
                widget::row_label(ui, name, summary);
                let mut on = value;
                let response = ui.checkbox(&mut on, "").named(name).on_hover_text(summary);
                if response.changed() {
                    send(Change::Set(ParamValue::Flag(on)), commands);
                }
            });
        }
        (ParamKind::Choice { names }, ParamValue::Choice(value)) => {
            widget::row(ui, |ui| {
                widget::row_label(ui, name, summary);
                let titles: Vec<String> = names.iter().map(|name| kinds::choice(name)).collect();
                let selected = titles.get(value as usize).cloned().unwrap_or_default();
                let combo = widget::combo("choice", &selected, ui.available_width() - 4.0);
                let shown = combo.show_ui(ui, |ui| {
                    for (i, (name, title)) in names.iter().zip(&titles).enumerate() {
                        let entry = ui.selectable_label(i == value as usize, title);
                        if entry.on_hover_text(kinds::choice_hint(name)).clicked() {
                            send(Change::Set(ParamValue::Choice(i as u32)), commands);
                        }
                    }
                });
                shown.response.named(name);
            });
        }
        (ParamKind::Vector { min, max, .. }, ParamValue::Vector(v)) => {
            let value = v.to_array().map(f64::from);
            let range = [f64::from(min), f64::from(max)];
            if let Some(change) = widget::vector_row(ui, name, summary, value, range, "", 3) {
                send(change.map(|v| ParamValue::Vector(vec3(v))), commands);
            }
        }
        (ParamKind::Rotation, ParamValue::Rotation(q)) => {
            if let Some(change) = rotation_row(ui, name, summary, q) {
                send(change.map(ParamValue::Rotation), commands);
            }
        }
        // A value of another type than its parameter's does not occur: the document is valid by construction.
        _ => {}
    }
}

fn placement_ui(ui: &mut Ui, template: &PlacedTemplate, commands: &mut Vec<Command>) {
    let placement = template.placement;
    let names = (w().unfold_placement, w().fold_placement);
    if !widget::folded_heading(ui, "placement is open", w().placement, names) {
        return;
    }
    let send = |change: Change<Placement>, commands: &mut Vec<Command>| {
        let edit = |placement| Edit::SetPlacement {
            template: template.index,
            placement,
        };
        commands.push(widget::command(change.map(edit)));
    };
    let range = [-4.0, 4.0];
    let at = placement.at.to_array().map(f64::from);
    let hint = w().centre_hint;
    if let Some(change) = widget::vector_row(ui, w().centre, hint, at, range, "", 3) {
        send(
            change.map(|v| Placement {
                at: vec3(v),
                ..placement
            }),
            commands,
        );
    }
    if let Some(change) = rotation_row(ui, w().turned, w().turned_hint, placement.rotate) {
        send(
            change.map(|rotate| Placement {
                rotate,
                ..placement
            }),
            commands,
        );
    }
    let size = placement.size.to_array().map(f64::from);
    if let Some(change) = widget::vector_row(ui, w().size, w().size_hint, size, [0.01, 4.0], "", 3)
    {
        send(
            change.map(|v| Placement {
                size: vec3(v),
                ..placement
            }),
            commands,
        );
    }
}
