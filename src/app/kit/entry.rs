//! What the lists of templates and of objects share: their rows, and rows of the panels of what is selected there.

use egui::{
    Color32, CornerRadius, Id, Rect, Response, Role, Sense, Stroke, TextEdit, Ui, WidgetInfo, vec2,
};
use glam::{EulerRot, Quat, Vec3};

use super::icon::Icon;
use super::theme::{self, Palette};
use super::widget::{self, Change, Named as _, NumberRow};
use crate::app::words::templates::w;
use crate::app::words::{authoring, fill};
use crate::document::free_group_name;

/// Height of a row of a list, points.
const ROW: f32 = 40.0;

/// One entry of a list: a click selects it, an eye at its end shows or hides it.
pub(crate) struct EntryRow<'a> {
    /// Tells the row from others.
    pub id: (&'static str, usize),
    /// What a screen reader calls it.
    pub name: &'a str,
    /// Shown first.
    pub title: &'a str,
    /// Shown after the title, or empty.
    pub note: &'a str,
    /// The entry is selected.
    pub is_selected: bool,
    /// It can be dragged to another place of the list.
    pub has_grip: bool,
    /// Place of its group among all groups, if it is in one.
    pub group: Option<usize>,
    /// The entry is shown; without it there is no eye.
    pub is_shown: Option<bool>,
}

/// What was done with a row.
pub(crate) struct EntryResponse {
    /// Of the row as a whole.
    pub response: Response,
    /// The eye was clicked.
    pub is_toggled: bool,
}

impl EntryRow<'_> {
    /// Draws the row.
    pub(crate) fn ui(self, ui: &mut Ui) -> EntryResponse {
        let palette = Palette::get(ui);
        let sense = match self.has_grip {
            true => Sense::click_and_drag(),
            false => Sense::click(),
        };
        let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), ROW), sense);
        let (is_selected, name) = (self.is_selected, self.name);
        response.widget_info(|| {
            WidgetInfo::selected(Role::ListItem, ui.is_enabled(), is_selected, name)
        });
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
        self.text_ui(ui, rect);
        let is_toggled = self.eye_ui(ui, rect);
        EntryResponse {
            response,
            is_toggled,
        }
    }

    /// Grip, mark of the group, title and note.
    fn text_ui(&self, ui: &Ui, rect: Rect) {
        let palette = Palette::get(ui);
        let inset = if self.has_grip { 28.0 } else { 14.0 };
        if self.has_grip {
            let grip = rect.left_center() + vec2(14.0, 0.0);
            let grip = Rect::from_center_size(grip, vec2(16.0, 16.0));
            let color = palette.weak.gamma_multiply(0.7);
            Icon::Grip.paint(ui.painter(), widget::sided(rect, grip), color);
        }
        if let Some(place) = self.group {
            let bar = rect.shrink(1.0).with_max_x(rect.left() + 5.0);
            let color: Color32 = theme::GROUPS[place % theme::GROUPS.len()];
            let bar = widget::sided(rect, bar);
            ui.painter().rect_filled(bar, CornerRadius::same(2), color);
        }
        let color = match self.is_shown {
            Some(true) => palette.text,
            Some(false) | None => palette.weak,
        };
        let clip = widget::sided(rect, rect.with_max_x(rect.right() - 66.0));
        let painter = ui.painter().with_clip_rect(clip);
        let font = theme::strong_font(13.0);
        let shown = widget::line_text(&painter, rect, inset, self.title, font, color);
        let inset = inset + shown.width() + 8.0;
        let font = egui::FontId::proportional(11.5);
        widget::line_text(&painter, rect, inset, self.note, font, palette.weak);
    }

    /// True if it was clicked.
    fn eye_ui(&self, ui: &mut Ui, rect: Rect) -> bool {
        let Some(is_shown) = self.is_shown else {
            return false;
        };
        let (icon, verb) = match is_shown {
            true => (Icon::Eye, w().hide),
            false => (Icon::EyeOff, w().show),
        };
        let right = Rect::from_center_size(
            rect.right_center() - vec2(20.0, 0.0),
            egui::Vec2::splat(theme::control_height()),
        );
        let mut inner = ui.new_child(
            egui::UiBuilder::new()
                .id_salt(self.id)
                .max_rect(widget::sided(rect, right)),
        );
        let name = fill(verb, &[&self.name]);
        widget::icon_button(&mut inner, icon, &name, true).clicked()
    }
}

/// The row of the author's name for a thing; the name, when it was changed. `id` tells the field from others.
pub(crate) fn name_row(
    ui: &mut Ui,
    id: (&'static str, usize),
    name: &str,
    (hint, summary): (&str, &str),
) -> Option<String> {
    widget::row(ui, |ui| {
        let label = widget::row_label(ui, w().name, summary);
        let mut name = name.to_owned();
        let edit = TextEdit::singleline(&mut name)
            .hint_text(hint)
            .desired_width(f32::INFINITY)
            .min_size(vec2(0.0, theme::control_height()))
            .align(egui::Align2::LEFT_CENTER)
            .char_limit(80)
            .id(Id::unique(id));
        let is_changed = ui.add(edit).labelled_by(label.id).changed();
        is_changed.then_some(name)
    })
}

/// The row of the group that a thing is in: none, one that there is, a new one. The group, when another was chosen.
pub(crate) fn group_row(
    ui: &mut Ui,
    current: &str,
    known: &[String],
    summary: &str,
) -> Option<String> {
    let w = authoring::w();
    let mut chosen = None;
    widget::row(ui, |ui| {
        widget::row_label(ui, w.group, summary);
        let shown = if current.is_empty() {
            w.no_group
        } else {
            current
        };
        let combo = widget::combo("group", shown, ui.available_width() - 4.0);
        let shown = combo.show_ui(ui, |ui| {
            let none = ui.selectable_label(current.is_empty(), w.no_group);
            if none.clicked() {
                chosen = Some(String::new());
            }
            for group in known {
                if ui.selectable_label(current == group, group).clicked() {
                    chosen = Some(group.clone());
                }
            }
            if ui.selectable_label(false, w.new_group).clicked() {
                chosen = Some(free_group_name(w.group, known));
            }
        });
        shown.response.on_hover_text(summary).named(w.group);
    });
    chosen
}

/// A rotation as three angles in degrees.
pub(crate) fn rotation_row(
    ui: &mut Ui,
    name: &str,
    summary: &str,
    q: Quat,
) -> Option<Change<Quat>> {
    let (z, y, x) = q.to_euler(EulerRot::ZYX);
    let degrees =
        [x, y, z].map(|angle| (f64::from(angle.to_degrees()) * 10.0).round() / 10.0 + 0.0);
    let change = widget::vector_row(ui, name, summary, degrees, [-360.0, 360.0], "°", 1)?;
    Some(change.map(|v| {
        let [x, y, z] = v.map(|degrees| (degrees as f32).to_radians());
        Quat::from_euler(EulerRot::ZYX, z, y, x).normalize()
    }))
}

/// A colour that may be left to what it is by itself: `own` is shown then, and `reset` names the button that goes back
/// to it. Returns the colour that was chosen; `None` in the change is the own one.
pub(crate) fn color_row(
    ui: &mut Ui,
    (name, summary): (&str, &str),
    (color, own): (Option<[u8; 3]>, [u8; 3]),
    reset: &str,
) -> Option<Change<Option<[u8; 3]>>> {
    let mut change = None;
    widget::row(ui, |ui| {
        widget::row_label(ui, name, summary);
        let mut shown = color.unwrap_or(own);
        let button = ui.color_edit_button_srgb(&mut shown).named(name);
        if button.changed() {
            change = Some(Change::Drag(Some(shown)));
        }
        if color.is_none() {
            let weak = Palette::get(ui).weak;
            let text = egui::RichText::new(reset).small().color(weak);
            ui.add(egui::Label::new(text).truncate());
        } else if widget::icon_button(ui, Icon::Reset, reset, true).clicked() {
            change = Some(Change::Set(None));
        }
    });
    change
}

/// Three numbers of a row as a vector.
pub(crate) fn vec3(v: [f64; 3]) -> Vec3 {
    Vec3::from_array(v.map(|x| x as f32))
}

/// A number from 0 to 1 of the document, shown in percent. Returns it in whole hundredths.
pub(crate) fn part_row(
    ui: &mut Ui,
    (name, summary): (&str, &str),
    value: f32,
    default: impl Into<Option<f32>>,
) -> Option<Change<f64>> {
    let row = NumberRow {
        name,
        summary,
        value: f64::from(value) * 100.0,
        default: default.into().map(|part| f64::from(part) * 100.0),
        range: [0.0, 100.0],
        unit: " %",
        decimals: 0,
    };
    let change = row.ui(ui)?;
    Some(change.map(|percent| percent.round() / 100.0))
}
