//! The controls that every panel is built of: named icon buttons, headings, choices, numbers. Each has a name that a
//! screen reader reads and a test finds.

use egui::output::OutputEvent;
use egui::{
    Align2, CornerRadius, DragValue, FontId, Rect, Response, Role, Sense, Slider, Stroke,
    TextStyle, Ui, Vec2, WidgetInfo, vec2,
};

use crate::app::kit::icon::Icon;
use crate::app::kit::theme::{self, Palette, control_height};
use crate::app::session::Command;
use crate::app::words::templates::w;
use crate::app::words::{self, fill, in_sentence, localized};
use crate::document::Edit;

/// What a control did to a value in this frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Change<T> {
    /// A step of a drag; the drag as a whole is one step of undo.
    Drag(T),
    /// A value that was typed or chosen: one step of undo by itself.
    Set(T),
}

impl<T> Change<T> {
    /// The new value.
    pub(crate) fn value(&self) -> &T {
        match self {
            Self::Drag(value) | Self::Set(value) => value,
        }
    }

    /// With the value made into something else.
    pub(crate) fn map<U>(self, f: impl FnOnce(T) -> U) -> Change<U> {
        match self {
            Self::Drag(value) => Change::Drag(f(value)),
            Self::Set(value) => Change::Set(f(value)),
        }
    }
}

/// What happened to a value whose control gave this response.
pub(crate) fn change<T>(response: &Response, value: T) -> Option<Change<T>> {
    response.changed().then(|| {
        // The frame in which the pointer is let go still belongs to the drag.
        if response
            .ctx
            .input(|i| i.pointer.any_down() || i.pointer.any_released())
        {
            Change::Drag(value)
        } else {
            Change::Set(value)
        }
    })
}

/// A square button with an icon, named for screen readers and by its tooltip.
pub(crate) fn icon_button(ui: &mut Ui, icon: Icon, name: &str, enabled: bool) -> Response {
    icon_button_sized(ui, icon, name, enabled, false, control_height())
}

/// As [`icon_button`], with a state (pressed or not) and a side in points.
pub(crate) fn icon_button_sized(
    ui: &mut Ui,
    icon: Icon,
    name: &str,
    enabled: bool,
    selected: bool,
    side: f32,
) -> Response {
    let palette = Palette::get(ui);
    let sense = if enabled {
        Sense::click()
    } else {
        Sense::hover()
    };
    let (rect, response) = ui.allocate_exact_size(Vec2::splat(side), sense);
    let is_enabled = enabled && ui.is_enabled();
    response.widget_info(|| {
        if selected {
            WidgetInfo::selected(Role::Button, is_enabled, true, name)
        } else {
            WidgetInfo::labeled(Role::Button, is_enabled, name)
        }
    });
    if ui.is_rect_visible(rect) {
        let fill = if selected {
            Some(palette.accent_wash)
        } else if is_enabled && (response.hovered() || response.is_pointer_button_down_on()) {
            Some(palette.hover)
        } else {
            None
        };
        if let Some(fill) = fill {
            ui.painter().rect_filled(rect, CornerRadius::same(6), fill);
        }
        focus_ring(ui, &response, rect);
        let color = match (is_enabled, selected) {
            (false, _) => palette.weak.gamma_multiply(0.45),
            (true, true) => palette.accent,
            (true, false) => palette.text,
        };
        let side = (side * 0.64).min(22.0);
        icon.paint(
            ui.painter(),
            Rect::from_center_size(rect.center(), Vec2::splat(side)),
            color,
        );
    }
    response.on_hover_text(name).on_disabled_hover_text(name)
}

/// The ring around what has the keyboard.
pub(crate) fn focus_ring(ui: &Ui, response: &Response, rect: Rect) {
    if response.has_focus() {
        let stroke = Stroke::new(2.0, Palette::get(ui).accent);
        ui.painter().rect_stroke(
            rect,
            CornerRadius::same(6),
            stroke,
            egui::StrokeKind::Inside,
        );
    }
}

/// A button with an icon and a word; `main` is the one filled button of a view.
pub(crate) fn labelled_button(
    ui: &mut Ui,
    icon: Icon,
    text: &str,
    main: bool,
    enabled: bool,
) -> Response {
    let palette = Palette::get(ui);
    let font = if main {
        theme::strong_font(13.5)
    } else {
        TextStyle::Button.resolve(ui.style())
    };
    let galley = ui
        .painter()
        .layout_no_wrap(text.to_owned(), font, palette.text);
    let padding = vec2(10.0, 0.0);
    let size = vec2(
        galley.size().x + 18.0 + 6.0 + 2.0 * padding.x,
        control_height(),
    );
    let sense = if enabled {
        Sense::click()
    } else {
        Sense::hover()
    };
    let (rect, response) = ui.allocate_exact_size(size, sense);
    let is_enabled = enabled && ui.is_enabled();
    response.widget_info(|| WidgetInfo::labeled(Role::Button, is_enabled, text));
    if ui.is_rect_visible(rect) {
        let over = is_enabled && response.hovered();
        let (fill, stroke, color) = match (main, over) {
            (true, false) => (palette.accent, palette.accent, palette.on_accent),
            (true, true) => (
                palette.accent_hover,
                palette.accent_hover,
                palette.on_accent,
            ),
            (false, false) => (palette.raised, palette.line, palette.text),
            (false, true) => (palette.hover, palette.weak, palette.text),
        };
        let fade = |color: egui::Color32| {
            if is_enabled {
                color
            } else {
                color.gamma_multiply(0.45)
            }
        };
        ui.painter().rect(
            rect,
            CornerRadius::same(6),
            fade(fill),
            Stroke::new(1.0, fade(stroke)),
            egui::StrokeKind::Inside,
        );
        focus_ring(ui, &response, rect.expand(2.0));
        let icon_rect = Rect::from_center_size(
            rect.left_center() + vec2(padding.x + 9.0, 0.0),
            Vec2::splat(18.0),
        );
        icon.paint(ui.painter(), sided(rect, icon_rect), fade(color));
        let at = rect.left_center() + vec2(padding.x + 24.0, -0.5 * galley.size().y);
        let spot = sided(rect, Rect::from_min_size(at, galley.size()));
        ui.painter()
            .galley_with_override_text_color(spot.min, galley, fade(color));
    }
    response
}

/// Along the line, in the direction in which the language is read.
pub(crate) fn along() -> egui::Layout {
    if words::is_rtl() {
        egui::Layout::right_to_left(egui::Align::Center)
    } else {
        egui::Layout::left_to_right(egui::Align::Center)
    }
}

/// From the end of the line backwards.
pub(crate) fn against() -> egui::Layout {
    if words::is_rtl() {
        egui::Layout::left_to_right(egui::Align::Center)
    } else {
        egui::Layout::right_to_left(egui::Align::Center)
    }
}

/// A panel's contents from the top down, lines beginning on the side where the language begins them.
pub(crate) fn directed<R>(ui: &mut Ui, contents: impl FnOnce(&mut Ui) -> R) -> R {
    if words::is_rtl() {
        ui.with_layout(egui::Layout::top_down(egui::Align::Max), contents)
            .inner
    } else {
        contents(ui)
    }
}

/// A part of a rectangle on the side where the language has it; `part` is as for left to right.
pub(crate) fn sided(within: Rect, part: Rect) -> Rect {
    if words::is_rtl() {
        let x = within.left() + within.right();
        Rect::from_x_y_ranges((x - part.right())..=(x - part.left()), part.y_range())
    } else {
        part
    }
}

/// Paints one line of text `inset` points from where lines begin in `rect`, at mid height. Returns what it covers.
pub(crate) fn line_text(
    painter: &egui::Painter,
    rect: Rect,
    inset: f32,
    text: &str,
    font: FontId,
    color: egui::Color32,
) -> Rect {
    let (at, align) = if words::is_rtl() {
        (rect.right_center() - vec2(inset, 0.0), Align2::RIGHT_CENTER)
    } else {
        (rect.left_center() + vec2(inset, 0.0), Align2::LEFT_CENTER)
    };
    painter.text(at, align, text, font, color)
}

/// A heading within a panel, with room for buttons at its right end.
pub(crate) fn heading(ui: &mut Ui, text: &str, trailing: impl FnOnce(&mut Ui)) {
    ui.horizontal(|ui| {
        ui.set_min_height(control_height());
        let color = Palette::get(ui).text;
        let label = ui.add(egui::Label::new(
            theme::strong(text).size(13.5).color(color),
        ));
        ui.ctx().accesskit_node_builder(label.id, |node| {
            node.set_role(egui::Role::Heading);
            node.set_label(text);
        });
        ui.with_layout(against(), trailing);
    });
}

/// A heading whose section is folded at first: a button at its end opens and closes it. `id` tells it from others; the
/// names are those of the button, for opening and for closing. True if the section is to be drawn.
pub(crate) fn folded_heading(
    ui: &mut Ui,
    id: &'static str,
    text: &str,
    (unfold, fold): (&str, &str),
) -> bool {
    let id = egui::Id::unique(id);
    let mut is_open = ui.data(|data| data.get_temp::<bool>(id).unwrap_or(false));
    let (icon, name) = match is_open {
        true => (Icon::ChevronDown, fold),
        false => (Icon::ChevronRight, unfold),
    };
    heading(ui, text, |ui| {
        if icon_button(ui, icon, name, true).clicked() {
            is_open = !is_open;
            ui.data_mut(|data| data.insert_temp(id, is_open));
        }
    });
    is_open
}

/// A thin line across a panel with air around it.
pub(crate) fn divider(ui: &mut Ui) {
    ui.add_space(6.0);
    let width = ui.available_width();
    let (rect, _) = ui.allocate_exact_size(vec2(width, 1.0), Sense::hover());
    ui.painter().rect_filled(rect, 0.0, Palette::get(ui).line);
    ui.add_space(6.0);
}

/// Gives the keyboard to the chosen one of the next choice of that name.
pub(crate) fn focus_chosen(ui: &Ui, name: &str) {
    let id = egui::Id::unique(("focus the chosen", name));
    ui.data_mut(|data| data.insert_temp(id, true));
}

/// Names for controls that show something else: screen readers speak the name, and the text shown is the value.
pub(crate) trait Named {
    /// Gives the control a name.
    fn named(self, name: impl Into<String>) -> Self;
}

impl Named for Response {
    fn named(self, name: impl Into<String>) -> Self {
        let name = name.into();
        if self.gained_focus() || self.changed() {
            self.ctx.output_mut(|output| {
                if let Some(OutputEvent::FocusGained(info) | OutputEvent::ValueChanged(info)) =
                    output.events.last_mut()
                {
                    let shown = info.label.replace(name.clone());
                    let value = info.current_text_value.take().or(shown);
                    info.current_text_value =
                        value.filter(|text| *text != name && !text.is_empty());
                }
            });
        }
        self.accessible_name(name)
    }
}

/// The text for a screen reader about the control that took the keyboard or was changed, if one did.
pub(crate) fn spoken(ui: &Ui) -> Option<String> {
    if ui.input(|i| i.pointer.any_down() || i.pointer.any_released()) {
        return None;
    }
    let info = ui.ctx().output(|output| {
        output.events.iter().rev().find_map(|event| match event {
            OutputEvent::FocusGained(info) | OutputEvent::ValueChanged(info) => Some(info.clone()),
            _ => None,
        })
    })?;
    let value = info.value.map(|value| plain(value, 3));
    let parts = [info.label, info.current_text_value, value];
    let parts: Vec<String> = parts.into_iter().flatten().collect();
    Some(parts.join(": ")).filter(|text| !text.is_empty())
}

/// Points that a line of text takes.
pub(crate) fn text_width(ui: &Ui, text: &str, font: FontId) -> f32 {
    let painter = ui.painter();
    let galley = painter.layout_no_wrap(text.to_owned(), font, egui::Color32::BLACK);
    galley.size().x
}

/// A choice among a few entries whose words speak for themselves; see [`explained`].
pub(crate) fn segmented<T: Copy + PartialEq>(
    ui: &mut Ui,
    name: &str,
    options: &[(T, &str)],
    current: T,
) -> Option<T> {
    let options: Vec<_> = options
        .iter()
        .map(|&(value, text)| (value, text, ""))
        .collect();
    explained(ui, name, &options, current)
}

/// A choice among a few entries, side by side, in several rows where one is too narrow: value, word, and a sentence
/// that is shown while the pointer is over the entry (none where the sentence is empty). Returns the entry that was
/// chosen in this frame.
pub(crate) fn explained<T: Copy + PartialEq>(
    ui: &mut Ui,
    name: &str,
    options: &[(T, &str, &str)],
    current: T,
) -> Option<T> {
    let palette = Palette::get(ui);
    let needed = options
        .iter()
        .map(|(_, text, _)| text_width(ui, text, theme::strong_font(CHOICE_LETTERS)) + 10.0);
    let needed: Vec<f32> = needed.collect();
    let (cells, height, fit) = choice_cells(&needed, ui.available_width());
    let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width(), height), Sense::hover());
    ui.painter()
        .rect_filled(rect, CornerRadius::same(7), palette.sunken);
    let mut chosen = None;
    let wants_focus = egui::Id::unique(("focus the chosen", name));
    let letters = CHOICE_LETTERS * fit;
    for (i, &(value, text, hint)) in options.iter().enumerate() {
        let cell = sided(rect, cells[i].translate(rect.min.to_vec2()));
        let selected = value == current;
        let mut response = ui.interact(cell, ui.scope_id().with((name, i)), Sense::click());
        if !hint.is_empty() {
            response = response.on_hover_text(hint);
        }
        if selected
            && ui
                .data_mut(|data| data.remove_temp::<bool>(wants_focus))
                .is_some()
        {
            response.request_focus();
        }
        let full_name = format!("{name}: {text}");
        response.widget_info(|| {
            WidgetInfo::selected(
                Role::RadioButton,
                ui.is_enabled(),
                selected,
                full_name.clone(),
            )
        });
        let inner = cell.shrink(2.0);
        if selected {
            ui.painter().rect(
                inner,
                CornerRadius::same(5),
                palette.raised,
                Stroke::new(1.0, palette.line),
                egui::StrokeKind::Inside,
            );
        } else if response.hovered() {
            ui.painter()
                .rect_filled(inner, CornerRadius::same(5), palette.hover);
        }
        focus_ring(ui, &response, inner);
        let color = if selected {
            palette.accent
        } else {
            palette.weak
        };
        let font = if selected {
            theme::strong_font(letters)
        } else {
            FontId::proportional(letters)
        };
        ui.painter().with_clip_rect(inner).text(
            inner.center(),
            Align2::CENTER_CENTER,
            text,
            font,
            color,
        );
        if response.clicked() && !selected {
            chosen = Some(value);
        }
    }
    chosen
}

/// Where the entries of a choice stand whose words need so much, from the top left corner, how high they are together,
/// and how much the letters shrink. In a row all are alike where every word fits, else each is as its word needs. A row
/// shrinks a little before there is a second one.
fn choice_cells(needed: &[f32], room: f32) -> (Vec<Rect>, f32, f32) {
    let all: f32 = needed.iter().sum();
    let widest = needed.iter().copied().fold(1.0, f32::max);
    let in_one = (room / all.max(1.0)).min(1.0);
    let fit = match in_one >= LEAST_SHRUNK {
        true => in_one,
        false => (room / widest).min(1.0),
    };
    let mut rows: Vec<Vec<f32>> = Vec::new();
    for width in needed.iter().map(|width| width * fit) {
        match rows.last_mut() {
            // Sums of floats may be a little too large.
            Some(row) if row.iter().sum::<f32>() + width <= room + 0.5 => row.push(width),
            _ => rows.push(vec![width]),
        }
    }
    let mut cells = Vec::with_capacity(needed.len());
    for (row, widths) in rows.iter().enumerate() {
        let count = widths.len() as f32;
        let step = room / count;
        let is_tight = widths.iter().any(|width| *width > step);
        let spare = step - widths.iter().sum::<f32>() / count;
        let mut left = 0.0;
        for width in widths {
            let width = if is_tight { width + spare } else { step };
            let corner = egui::pos2(left, row as f32 * control_height());
            cells.push(Rect::from_min_size(corner, vec2(width, control_height())));
            left += width;
        }
    }
    (cells, rows.len() as f32 * control_height(), fit)
}

/// A number with its name, a slider and a field, in one row.
pub(crate) struct NumberRow<'a> {
    /// Shown at the left.
    pub name: &'a str,
    /// Shown as a tooltip over the row.
    pub summary: &'a str,
    /// As it stands, in shown units.
    pub value: f64,
    /// What it goes back to by the reset button, in shown units; none hides the button.
    pub default: Option<f64>,
    /// Lowest and highest, in shown units.
    pub range: [f64; 2],
    /// After the number: `°`.
    pub unit: &'a str,
    /// Decimals shown; 0 makes it a whole number.
    pub decimals: usize,
}

impl NumberRow<'_> {
    /// Draws the row and returns the change, in shown units.
    pub(crate) fn ui(self, ui: &mut Ui) -> Option<Change<f64>> {
        self.row_ui(ui, None, false)
    }

    /// The same with a slider on which small numbers have as much room as large ones.
    pub(crate) fn ui_logarithmic(self, ui: &mut Ui) -> Option<Change<f64>> {
        self.row_ui(ui, None, true)
    }

    /// The same with a note beside the number, such as the number in another unit.
    pub(crate) fn ui_with_note(self, ui: &mut Ui, note: &str) -> Option<Change<f64>> {
        self.row_ui(ui, Some(note), false)
    }

    fn row_ui(self, ui: &mut Ui, note: Option<&str>, is_logarithmic: bool) -> Option<Change<f64>> {
        let mut result = None;
        row(ui, |ui| {
            let [low, high] = self.range;
            let label = row_label(ui, self.name, self.summary);
            let reset = if theme::is_touch() { 36.0 } else { 20.0 };
            let noted = note.map_or(0.0, |_| NOTE_WIDTH);
            let field_width = FIELD_WIDTH - if note.is_some() { NOTED_LESS } else { 0.0 };
            let tail = field_width + noted + reset + 2.0 * ui.spacing().item_spacing.x;
            let width = (ui.available_width() - tail).max(40.0);
            let mut value = self.value;
            let step = if self.decimals == 0 { 1.0 } else { 0.0 };
            let slider = slim(ui, width, |ui| {
                let slider = Slider::new(&mut value, low..=high)
                    .show_value(false)
                    .logarithmic(is_logarithmic);
                ui.add(slider.step_by(step).max_decimals(self.decimals))
            });
            let slider = slider.named(fill(w().slider, &[&self.name]));
            let mut typed = self.value;
            let speed = match is_logarithmic {
                true => (self.value * 0.01).max(0.1_f64.powi(self.decimals as i32)),
                false => (high - low) / 400.0,
            };
            let field = number_field(&mut typed, self.decimals)
                .range(low..=high)
                .speed(speed)
                .suffix(self.unit);
            let field = ui.add_sized(vec2(field_width, control_height()), field);
            if let Some(note) = note {
                let size = vec2(noted - ui.spacing().item_spacing.x, control_height());
                let text = egui::RichText::new(note)
                    .small()
                    .color(Palette::get(ui).weak);
                ui.add_sized(size, egui::Label::new(text).truncate());
            }
            let field = field.labelled_by(label.id).on_hover_text(fill(
                w().range,
                &[
                    &self.summary,
                    &plain(low, self.decimals),
                    &plain(high, self.decimals),
                    &self.unit,
                ],
            ));
            // Controls report what they round away as a change. The slider does so in every frame, and must not hide
            // what was typed into the field.
            // A value right between two that are shown is rounded away too.
            let tolerance = 0.501 * 0.1_f64.powi(self.decimals as i32);
            let is_new = |change: &Change<f64>| (change.value() - self.value).abs() > tolerance;
            result = change(&slider, value)
                .filter(is_new)
                .or(change(&field, typed).filter(is_new));
            if let Some(default) = self.default.filter(|d| (d - self.value).abs() > tolerance) {
                let name = fill(w().reset, &[&in_sentence(self.name)]);
                if icon_button_sized(ui, Icon::Reset, &name, true, false, reset).clicked() {
                    result = Some(Change::Set(default));
                }
            }
        });
        result
    }
}

/// A row of controls of one height, so that none of them stands lower than the one before.
pub(crate) fn row<R>(ui: &mut Ui, contents: impl FnOnce(&mut Ui) -> R) -> R {
    let size = vec2(ui.available_width(), control_height());
    let layout = along();
    ui.allocate_ui_with_layout(size, layout, |ui| {
        ui.set_min_height(control_height());
        ui.spacing_mut().item_spacing.x = 6.0;
        contents(ui)
    })
    .inner
}

/// Sliders with a thin rail, filled in the accent colour, and a small handle.
pub(crate) fn slim<R>(ui: &mut Ui, width: f32, contents: impl FnOnce(&mut Ui) -> R) -> R {
    let palette = Palette::get(ui);
    let size = vec2(width, control_height());
    ui.allocate_ui_with_layout(size, along(), |ui| {
        ui.set_min_size(size);
        let style = ui.style_mut();
        style.spacing.slider_width = width;
        style.spacing.interact_size.y = if theme::is_touch() { 26.0 } else { 17.0 };
        style.spacing.slider_rail_height = 4.0;
        for font in style.text_styles.values_mut() {
            font.size = 8.0;
        }
        style.visuals.selection.bg_fill = palette.accent;
        let widgets = &mut style.visuals.widgets;
        for (visuals, width) in [
            (&mut widgets.inactive, 1.5),
            (&mut widgets.hovered, 2.0),
            (&mut widgets.active, 2.5),
        ] {
            visuals.bg_fill = palette.line;
            visuals.fg_stroke = Stroke::new(width, palette.accent);
        }
        contents(ui)
    })
    .inner
}

/// A choice from a list that opens.
pub(crate) fn combo(id: &'static str, selected: &str, width: f32) -> egui::ComboBox<'static> {
    egui::ComboBox::from_id_salt(id)
        .selected_text(selected.to_owned())
        .width(width)
        .truncate()
        .icon(|ui, rect, _visuals, _is_open| {
            let spot = Rect::from_center_size(rect.center(), Vec2::splat(15.0));
            Icon::ChevronDown.paint(ui.painter(), spot, Palette::get(ui).weak);
        })
}

const FIELD_WIDTH: f32 = 62.0;
/// Letters of the words of a choice, points, and how far they shrink before a second row is begun.
const CHOICE_LETTERS: f32 = 12.5;
const LEAST_SHRUNK: f32 = 0.88;
/// Width of the note beside the number of a [`NumberRow`], and by how much the number is narrower there.
const NOTE_WIDTH: f32 = 54.0;
const NOTED_LESS: f32 = 20.0;

/// Width of the names at the left of rows.
pub(crate) const LABEL_WIDTH: f32 = 78.0;

/// The name at the left of a row.
pub(crate) fn row_label(ui: &mut Ui, name: &str, summary: &str) -> Response {
    let weak = Palette::get(ui).weak;
    let label = egui::Label::new(egui::RichText::new(name).color(weak)).truncate();
    let size = vec2(LABEL_WIDTH, control_height());
    let layout = along();
    let response = ui
        .allocate_ui_with_layout(size, layout, |ui| {
            ui.set_min_size(size);
            ui.add(label)
        })
        .inner;
    if summary.is_empty() {
        response
    } else {
        response.on_hover_text(summary)
    }
}

/// Three numbers in a row: x, y, z.
pub(crate) fn vector_row(
    ui: &mut Ui,
    name: &str,
    summary: &str,
    value: [f64; 3],
    range: [f64; 2],
    unit: &str,
    decimals: usize,
) -> Option<Change<[f64; 3]>> {
    let mut result = None;
    row(ui, |ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        // Three angles such as −143.9° have just room.
        ui.spacing_mut().button_padding.x = 2.0;
        row_label(ui, name, summary);
        let width = ((ui.available_width() - 2.0 * 4.0) / 3.0).clamp(44.0, 80.0);
        for (i, axis) in ["x", "y", "z"].into_iter().enumerate() {
            let mut edited = value;
            let field = number_field(&mut edited[i], decimals)
                .range(range[0]..=range[1])
                .speed(0.6 * 0.1_f64.powi(decimals as i32))
                .suffix(unit);
            let field = ui.add_sized(vec2(width, control_height()), field);
            let field = field
                .named(format!("{name} {axis}"))
                .on_hover_text(format!("{name} {axis}"));
            let tolerance = 0.5 * 0.1_f64.powi(decimals as i32);
            let change =
                change(&field, edited).filter(|_| (edited[i] - value[i]).abs() > tolerance);
            result = result.take().or(change);
        }
    });
    result
}

/// A field for a number, shown and typed as the language writes numbers. The value changes when the keyboard leaves it.
pub(crate) fn number_field<N: egui::emath::Numeric>(
    value: &mut N,
    decimals: usize,
) -> DragValue<'_> {
    DragValue::new(value)
        .max_decimals(decimals)
        .custom_formatter(move |value, _| plain(value, decimals))
        .custom_parser(words::parse_number)
        .update_while_editing(false)
}

/// A number without needless zeros.
pub(crate) fn plain(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    let text = match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    };
    if text == "-0" {
        "0".to_owned()
    } else {
        localized(text.replace('-', "\u{2212}"))
    }
}

/// A change as a command: the parts of a drag join into one step of undo.
pub(crate) fn command(change: Change<Edit>) -> Command {
    match change {
        Change::Drag(edit) => Command::Drag(edit),
        Change::Set(edit) => Command::Apply(edit),
    }
}

#[cfg(test)]
mod tests {
    use egui_kittest::Harness;
    use egui_kittest::kittest::Queryable as _;

    use super::*;
    use crate::document::{ParamKind, TemplateKind};

    /// A row of a parameter whose value is kept as the document keeps it: in 32 bits.
    fn typed_into_row(start: f32, range: [f32; 2], decimals: usize, text: &str) -> f32 {
        let row = move |ui: &mut Ui, (value, is_ready): &mut (f32, bool)| {
            // Fonts come a frame after they were asked for.
            if !std::mem::replace(is_ready, true) {
                return theme::install(ui.ctx());
            }
            let row = NumberRow {
                name: "Depth",
                summary: "How deep",
                value: f64::from(*value),
                default: Some(f64::from(start)),
                range: range.map(f64::from),
                unit: "",
                decimals,
            };
            if let Some(change) = row.ui(ui) {
                *value = *change.value() as f32;
            }
        };
        let mut harness = Harness::builder()
            .with_size(vec2(320.0, 60.0))
            .build_ui_state(row, (start, false));
        harness.run_steps(2);
        harness.get_by_role(Role::SpinButton).click();
        harness.run_steps(2);
        harness.event(egui::Event::Text(text.to_owned()));
        harness.run_steps(2);
        harness.key_press(egui::Key::Enter);
        harness.run_steps(4);
        harness.state().0
    }

    #[test]
    fn every_number_of_every_template_can_be_typed() {
        for kind in TemplateKind::FORMULAS {
            for param in kind.spec().params {
                let (start, min, max, decimals) = match param.kind {
                    ParamKind::Number { default, min, max } => (default, min, max, 3),
                    ParamKind::Count { default, min, max } => (default, min, max, 0),
                    _ => continue,
                };
                let wanted = plain(f64::from(min + 0.62 * (max - min)), decimals);
                let kept = typed_into_row(start, [min, max], decimals, &wanted);
                let name = (kind.spec().name, param.name);
                assert_eq!(plain(f64::from(kept), decimals), wanted, "{name:?}");
            }
        }
    }

    /// No word of a choice becomes hard to read: a second row is begun, and every row fills the width.
    #[test]
    fn choices_that_are_too_long_for_a_row_take_another() {
        let (cells, height, fit) = choice_cells(&[60.0, 50.0, 40.0], 300.0);
        assert_eq!((height, fit), (control_height(), 1.0));
        assert!(cells.iter().all(|cell| cell.width() == 100.0), "{cells:?}");
        let (cells, height, fit) = choice_cells(&[60.0, 90.0, 60.0, 50.0, 120.0, 110.0], 240.0);
        assert_eq!((height, fit), (3.0 * control_height(), 1.0));
        for row in [&cells[..3], &cells[3..5], &cells[5..]] {
            let tops = row.iter().map(|cell| cell.top());
            assert!(tops.clone().all(|top| top == row[0].top()), "{cells:?}");
            let width: f32 = row.iter().map(|cell| cell.width()).sum();
            assert!((width - 240.0).abs() < 0.01, "{width}");
        }
        // A word that is wider than the panel still shrinks; what is a little too wide does as well.
        let (_, height, fit) = choice_cells(&[480.0, 100.0], 240.0);
        assert_eq!((height, fit), (2.0 * control_height(), 0.5));
        let (_, height, fit) = choice_cells(&[130.0, 120.0], 240.0);
        assert_eq!((height, fit), (control_height(), 0.96));
    }

    #[test]
    fn a_field_that_is_left_as_it_was_changes_nothing() {
        for start in [0.3, 1.0 / 3.0] {
            let shown = plain(f64::from(start), 3);
            assert_eq!(typed_into_row(start, [0.0, 1.0], 3, &shown), start);
        }
    }
}
