//! The list of placed templates and everything about the selected one: parameters, mode, placement.

use egui::{
    CornerRadius, DragAndDrop, Id, Label, Rect, Role, Sense, Stroke, TextEdit, Ui, WidgetInfo, vec2,
};
use glam::{EulerRot, Quat, Vec3};

use super::{curve, kept, points};
use crate::app::kit::icon::Icon;
use crate::app::kit::template_menu;
use crate::app::kit::theme::{self, Palette};
use crate::app::kit::widget::{self, Change, Named as _, NumberRow};
use crate::app::session::{Command, LibraryCommand, Session};
use crate::app::words::templates::w;
use crate::app::words::{self, fill, kinds, names};
use crate::data::Segment;
use crate::document::{
    Edit, ParamKind, ParamSpec, ParamValue, PlacedTemplate, TemplateMode, free_group_name,
    group_of, groups,
};
use crate::math::Placement;

/// Height of a row of the list, points.
const ROW: f32 = 40.0;

/// The list, then the selected template.
pub(crate) fn ui(
    ui: &mut Ui,
    session: &Session,
    segments: &[Segment],
    inside: &[String],
    commands: &mut Vec<Command>,
) {
    list_ui(ui, session, commands);
    if let Some(template) = session.selected_template() {
        widget::divider(ui);
        template_ui(ui, session, (segments, inside), template, commands);
    } else if let Some(index) = session.selected {
        widget::divider(ui);
        let weak = Palette::get(ui).weak;
        let text = w().unknown_kind;
        ui.add(Label::new(egui::RichText::new(text).color(weak)).wrap());
        if widget::labelled_button(ui, Icon::Trash, w().delete, false, true).clicked() {
            commands.push(Command::Apply(Edit::RemoveTemplate { template: index }));
        }
    }
}

/// An entry of the list that is being dragged: its index in the document.
#[derive(Clone, Copy)]
struct DraggedRow(usize);

fn list_ui(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    let count = session.template_count();
    widget::heading(ui, w().heading, |ui| {
        let from = session.selected;
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
    let palette = Palette::get(ui);
    let template = session.template(index);
    let title = template.map_or_else(|| w().unknown.to_owned(), names::template_title);
    let is_selected = session.selected == Some(index);
    let (rect, response) =
        ui.allocate_exact_size(vec2(ui.available_width(), ROW), Sense::click_and_drag());
    let number = index + 1;
    let name = format!("{number}. {title}");
    response
        .widget_info(|| WidgetInfo::selected(Role::ListItem, ui.is_enabled(), is_selected, &name));
    let (back, stroke) = if is_selected {
        (palette.accent_wash, palette.accent)
    } else if response.hovered() {
        (palette.hover, palette.line)
    } else {
        (palette.raised, palette.line)
    };
    ui.painter().rect(
        rect,
        CornerRadius::same(6),
        back,
        Stroke::new(1.0, stroke),
        egui::StrokeKind::Inside,
    );
    widget::focus_ring(ui, &response, rect);

    let grip = Rect::from_center_size(rect.left_center() + vec2(14.0, 0.0), vec2(16.0, 16.0));
    Icon::Grip.paint(
        ui.painter(),
        widget::sided(rect, grip),
        palette.weak.gamma_multiply(0.7),
    );
    let group = group_of(session.document(), index);
    if let Some(place) = groups(session.document()).iter().position(|g| g == group) {
        let bar = rect.shrink(1.0).with_max_x(rect.left() + 5.0);
        let color = GROUP_COLORS[place % GROUP_COLORS.len()];
        let bar = widget::sided(rect, bar);
        ui.painter().rect_filled(bar, CornerRadius::same(2), color);
    }
    let is_on = template.is_some_and(|t| t.enabled);
    let color = if is_on { palette.text } else { palette.weak };
    let clip = widget::sided(rect, rect.with_max_x(rect.right() - 66.0));
    let painter = ui.painter().with_clip_rect(clip);
    let shown = widget::line_text(
        &painter,
        rect,
        28.0,
        &title,
        theme::strong_font(13.0),
        color,
    );
    if let Some(template) = template {
        let mut note = if template.name.is_empty() {
            String::new()
        } else {
            kinds::title(template.kind).to_owned()
        };
        if template.mode == TemplateMode::Add && index > 0 {
            note = if note.is_empty() {
                w().added.to_owned()
            } else {
                format!("{note}, {}", w().added)
            };
        }
        if !group.is_empty() {
            note = if note.is_empty() {
                group.to_owned()
            } else {
                format!("{note}, {group}")
            };
        }
        let inset = 28.0 + shown.width() + 8.0;
        let font = egui::FontId::proportional(11.5);
        widget::line_text(&painter, rect, inset, &note, font, palette.weak);
    }

    if let Some(template) = template {
        let (icon, verb) = if template.enabled {
            (Icon::Eye, w().hide)
        } else {
            (Icon::EyeOff, w().show)
        };
        let right = Rect::from_center_size(
            rect.right_center() - vec2(20.0, 0.0),
            egui::Vec2::splat(theme::control_height()),
        );
        let mut inner = ui.new_child(
            egui::UiBuilder::new()
                .id_salt(("row", index))
                .max_rect(widget::sided(rect, right)),
        );
        if widget::icon_button(&mut inner, icon, &fill(verb, &[&name]), true).clicked() {
            let edit = Edit::SetEnabled {
                template: index,
                enabled: !template.enabled,
            };
            commands.push(Command::Apply(edit));
        }
    }
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
    rect
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
    curve::ui(ui, template, commands);
    ui.add_space(2.0);
    widget::row(ui, |ui| {
        let label = widget::row_label(ui, w().name, w().name_hint);
        let mut name = template.name.clone();
        let edit = TextEdit::singleline(&mut name)
            .hint_text(kinds::title(template.kind))
            .desired_width(f32::INFINITY)
            .min_size(vec2(0.0, theme::control_height()))
            .align(egui::Align2::LEFT_CENTER)
            .char_limit(80)
            .id(Id::unique(("template name", index)));
        if ui.add(edit).labelled_by(label.id).changed() {
            commands.push(Command::Drag(Edit::RenameTemplate {
                template: index,
                name,
            }));
        }
    });
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
    }
    if session.template_count() > 1 {
        group_ui(ui, session, index, commands);
    }
    widget::divider(ui);
    let illustration = session.shown();
    kept::ui(ui, template, illustration, segments, inside, commands);
    widget::divider(ui);
    placement_ui(ui, template, commands);
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

/// Which group the template is in: none, one that there is, a new one.
fn group_ui(ui: &mut Ui, session: &Session, template: usize, commands: &mut Vec<Command>) {
    let w = words::authoring::w();
    let current = group_of(session.document(), template);
    let known = groups(session.document());
    widget::row(ui, |ui| {
        widget::row_label(ui, w.group, w.group_hint);
        let shown = if current.is_empty() {
            w.no_group
        } else {
            current
        };
        let mut set = |group: &str| {
            let group = group.to_owned();
            commands.push(Command::Apply(Edit::SetGroup { template, group }));
        };
        let combo = widget::combo("group", shown, ui.available_width() - 4.0);
        let shown = combo.show_ui(ui, |ui| {
            if ui
                .selectable_label(current.is_empty(), w.no_group)
                .clicked()
            {
                set("");
            }
            for group in &known {
                if ui.selectable_label(current == group, group).clicked() {
                    set(group);
                }
            }
            if ui.selectable_label(false, w.new_group).clicked() {
                set(&free_group_name(w.group, &known));
            }
        });
        let response = shown.response.on_hover_text(w.group_hint);
        response.named(w.group.to_owned());
    });
}

/// Colours by which groups are told apart in the list.
const GROUP_COLORS: [egui::Color32; 4] = theme::GROUPS;

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
    let id = Id::unique("placement is open");
    let mut is_open = ui.data(|data| data.get_temp::<bool>(id).unwrap_or(false));
    let icon = if is_open {
        Icon::ChevronDown
    } else {
        Icon::ChevronRight
    };
    widget::heading(ui, w().placement, |ui| {
        let name = if is_open {
            w().fold_placement
        } else {
            w().unfold_placement
        };
        if widget::icon_button(ui, icon, name, true).clicked() {
            is_open = !is_open;
            ui.data_mut(|data| data.insert_temp(id, is_open));
        }
    });
    if !is_open {
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

/// A rotation as three angles in degrees.
fn rotation_row(ui: &mut Ui, name: &str, summary: &str, q: Quat) -> Option<Change<Quat>> {
    let (z, y, x) = q.to_euler(EulerRot::ZYX);
    let degrees =
        [x, y, z].map(|angle| (f64::from(angle.to_degrees()) * 10.0).round() / 10.0 + 0.0);
    let change = widget::vector_row(ui, name, summary, degrees, [-360.0, 360.0], "°", 1)?;
    Some(change.map(|v| {
        let [x, y, z] = v.map(|degrees| (degrees as f32).to_radians());
        Quat::from_euler(EulerRot::ZYX, z, y, x).normalize()
    }))
}

fn vec3(v: [f64; 3]) -> Vec3 {
    Vec3::from_array(v.map(|x| x as f32))
}
