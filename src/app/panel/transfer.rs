//! The transfer function over the subject's histogram: points are dragged, added, removed and coloured where they act,
//! and the window has its handles on the same axis.
//!
//! ```text
//!   ▼─────────────▼        window: its ends are dragged, the bar between them moves both
//!   │      o──o   │        opacity over value; upwards in square roots, so that 1 % is a tenth of the height
//!   │ ▂▅█▂/▁▂▃ \__o        histogram, logarithmic
//!   ████████████████       colours as they are mixed
//!   −1000   0   1000
//! ```
//!
//! A preset is shown by its points, at the values that they have in the window. The first change of a point turns them
//! into listed points, which are absolute (contract, "Transfer functions").

use egui::{
    CornerRadius, CursorIcon, EventFilter, Key, Modifiers, Pos2, Rect, Response, Role, Sense,
    Shape, Stroke, Ui, Vec2, WidgetInfo, pos2, vec2,
};

use super::transfer_plot::{
    Axis, Grip, LANE, paint_fill, paint_histogram, paint_levels, paint_point, paint_strip,
    paint_ticks, paint_window, percent,
};
use crate::app::kit::icon::Icon;
use crate::app::kit::theme::{self, Palette, control_height};
use crate::app::kit::widget::{self, Named as _};
use crate::app::session::Command;
use crate::app::session::Session;
use crate::app::words::{fill, look, transfer::w};
use crate::data::Histogram;
use crate::document::{Edit, Preset, PresetSubject, Transfer, TransferPoint, Window, presets};
use crate::render::{SubjectInfo, TransferTable, absolute_points};

/// Height of the curve, points.
const CURVE: f32 = 124.0;
/// Height of the strip of colours, points.
const STRIP: f32 = 12.0;
/// Height of the numbers below, points.
const TICKS: f32 = 16.0;
/// How near a press must be to a handle, points: a target of 24 by 24 at least.
const REACH: f32 = 13.0;
/// So far above or below the curve a point is let go to be removed, points.
const DROP: f32 = 34.0;
/// Listed points at most: more cannot be told apart on the axis.
const MAX_POINTS: usize = 64;

/// A drag under way: everything as it was when it began, so that a way back leads back.
#[derive(Clone, Debug)]
struct Held {
    grip: Grip,
    from: Pos2,
    points: Vec<TransferPoint>,
    window: [f32; 2],
    shown: [f32; 2],
}

/// What of the editor lives from frame to frame. The document holds the rest.
#[derive(Debug, Default)]
pub(crate) struct Editor {
    /// How often which values occur in the subject that is shown.
    histogram: Option<Histogram>,
    /// Part of the axis that is shown; none for all of it.
    zoomed: Option<[f32; 2]>,
    selected: Option<usize>,
    /// The point that gets the keyboard.
    wants_focus: Option<usize>,
    held: Option<Held>,
    /// A point of the curve has the keyboard: Delete is for it.
    pub(crate) has_keyboard: bool,
}

/// The transfer function that the picture shows.
struct Shown<'a> {
    points: Vec<TransferPoint>,
    tint: f32,
    /// The window and the preset that it stretches; none for listed points.
    preset: Option<&'a Preset>,
    window: [f32; 2],
}

impl Editor {
    /// Another subject is shown, with these values if it has any.
    pub(crate) fn set_histogram(&mut self, histogram: Option<Histogram>) {
        self.histogram = histogram;
        self.zoomed = None;
        self.held = None;
    }

    /// How often which values occur in the subject that is shown, if it has values.
    pub(crate) fn histogram(&self) -> Option<&Histogram> {
        self.histogram.as_ref()
    }

    /// The plot, the selected point, and the window of a preset. `preset` is what the look's colours stand for, none
    /// for listed points.
    pub(crate) fn ui(
        &mut self,
        ui: &mut Ui,
        session: &Session,
        info: &SubjectInfo,
        preset: Option<&Preset>,
        window: [f32; 2],
        commands: &mut Vec<Command>,
    ) {
        let look = &session.shown().look;
        let shown = Shown {
            points: match (&look.transfer, preset) {
                (Transfer::Points(points), _) => points.clone(),
                (_, Some(preset)) => absolute_points(preset, window),
                (_, None) => Vec::new(),
            },
            tint: look.tint.unwrap_or(preset.map_or(0.0, |p| p.tint)),
            preset,
            window,
        };
        if self.selected.is_some_and(|i| i >= shown.points.len()) {
            self.selected = None;
        }
        self.plot_ui(ui, &shown, info, commands);
        self.buttons_ui(ui, &shown, info, commands);
        self.point_ui(ui, &shown, info, commands);
    }

    /// All of the axis: the subject's values and every point.
    fn whole(&self, shown: &Shown<'_>, info: &SubjectInfo) -> [f32; 2] {
        let [mut low, mut high] = info.value_range;
        // A held point does not drag the axis along.
        let points = self
            .held
            .as_ref()
            .map_or(&shown.points, |held| &held.points);
        for point in points {
            low = low.min(point.value);
            high = high.max(point.value);
        }
        let least = (low.abs().max(high.abs()) * 1e-4).max(1e-4);
        let margin = (0.02 * (high - low)).max(least);
        [low - margin, high + margin]
    }

    // ------------------------------------------------------------------------------------------------ plot

    fn plot_ui(
        &mut self,
        ui: &mut Ui,
        shown: &Shown<'_>,
        info: &SubjectInfo,
        commands: &mut Vec<Command>,
    ) {
        let palette = Palette::get(ui);
        let size = vec2(ui.available_width(), LANE + CURVE + STRIP + TICKS);
        let (rect, response) = ui.allocate_exact_size(size, Sense::click_and_drag());
        response.widget_info(|| WidgetInfo::labeled(Role::Canvas, ui.is_enabled(), w().plot));
        let inner = rect.shrink2(vec2(8.0, 0.0));
        let curve = Rect::from_min_max(
            pos2(inner.left(), rect.top() + LANE),
            pos2(inner.right(), rect.top() + LANE + CURVE),
        );
        let whole = self.whole(shown, info);
        self.zoom(ui, &response, curve, whole);
        let axis = Axis {
            curve,
            range: self.zoomed.unwrap_or(whole),
        };
        self.gestures(ui, &response, &axis, whole, shown, commands);
        let axis = Axis {
            curve,
            range: self.zoomed.unwrap_or(whole),
        };
        let hot = self.held.as_ref().map(|held| held.grip).or_else(|| {
            let pos = response.hover_pos()?;
            self.grip_at(pos, &axis, shown)
        });
        match hot {
            Some(Grip::End(_) | Grip::Bar) => {
                ui.ctx().set_cursor_icon(CursorIcon::ResizeHorizontal)
            }
            Some(Grip::Point(_)) => ui.ctx().set_cursor_icon(CursorIcon::Grab),
            _ => {}
        }

        let painter = ui.painter_at(rect.expand(1.0));
        painter.rect(
            curve.expand2(vec2(8.0, 1.0)),
            CornerRadius::same(6),
            palette.sunken,
            Stroke::new(1.0, palette.line),
            egui::StrokeKind::Outside,
        );
        let clipped = painter.with_clip_rect(curve.expand(7.0));
        let table = TransferTable::from_points(&shown.points, 0.0, 0.0);
        let line = paint_fill(&clipped, &axis, &table);
        if let Some(histogram) = &self.histogram {
            paint_histogram(
                &clipped,
                &axis,
                histogram,
                palette.text.gamma_multiply(0.28),
            );
        }
        paint_levels(&clipped, &axis, palette);
        let halo = Stroke::new(3.5, palette.sunken.gamma_multiply(0.7));
        clipped.add(Shape::line(line.clone(), halo));
        clipped.add(Shape::line(line, Stroke::new(1.6, palette.text)));
        let strip = Rect::from_min_size(
            curve.left_bottom() + vec2(0.0, 3.0),
            vec2(curve.width(), STRIP - 4.0),
        );
        paint_strip(&painter, &axis, &table, strip);
        paint_ticks(&painter, &axis, rect.bottom(), palette);
        paint_window(
            &painter,
            &axis,
            shown.window,
            rect.top(),
            hot,
            palette,
            shown.preset.is_some(),
        );

        let mut has_keyboard = false;
        let mut keyed = None;
        for (i, point) in shown.points.iter().enumerate() {
            let at = axis.place(point.value, point.opacity);
            let id = response.id.with(("point", i));
            let target = Rect::from_center_size(at, Vec2::splat(2.0 * REACH)).intersect(rect);
            let handle = ui.interact(target, id, Sense::focusable_noninteractive());
            let text = fill(
                w().point_is,
                &[
                    &(i + 1),
                    &widget::plain(f64::from(point.value), 2),
                    &percent(point.opacity),
                ],
            );
            handle.widget_info(|| WidgetInfo::labeled(Role::Slider, ui.is_enabled(), &text));
            if handle.has_focus() {
                has_keyboard = true;
                self.selected = Some(i);
                let filter = EventFilter {
                    horizontal_arrows: true,
                    vertical_arrows: true,
                    ..Default::default()
                };
                ui.memory_mut(|memory| memory.set_focus_lock_filter(id, filter));
                keyed = keyed.or(keys(ui, i, shown, &axis));
            }
            if axis.contains(point.value) {
                let is_out = self.held.as_ref().is_some_and(|h| h.grip == Grip::Point(i))
                    && is_dropped(ui, curve);
                let is_hot = hot == Some(Grip::Point(i)) || handle.has_focus();
                paint_point(
                    &painter,
                    at,
                    point,
                    self.selected == Some(i),
                    is_hot && !is_out,
                    palette,
                );
            }
        }
        self.has_keyboard = has_keyboard;
        if let Some(i) = self.wants_focus.take() {
            ui.memory_mut(|memory| memory.request_focus(response.id.with(("point", i))));
        }
        if let Some(keyed) = keyed {
            if keyed.len() < shown.points.len() {
                let last = keyed.len().saturating_sub(1);
                self.select(self.selected.map(|i| i.min(last)));
            }
            commands.push(points_command(keyed, shown.tint, false));
        }
        if let Some(hint) = self.hint(hot) {
            response.on_hover_text(hint);
        }
    }

    fn hint(&self, hot: Option<Grip>) -> Option<&'static str> {
        if self.held.is_some() {
            return None;
        }
        match hot {
            Some(Grip::Point(_)) => Some(w().point_hint),
            Some(Grip::End(_) | Grip::Bar) => Some(w().window_hint),
            _ => Some(w().line_hint),
        }
    }

    /// Ctrl and wheel, or two fingers.
    fn zoom(&mut self, ui: &Ui, response: &Response, curve: Rect, whole: [f32; 2]) {
        let Some(pos) = response.hover_pos() else {
            return;
        };
        let factor = ui.input(|i| i.zoom_delta());
        if factor != 1.0 && factor.is_finite() {
            let axis = Axis {
                curve,
                range: self.zoomed.unwrap_or(whole),
            };
            self.zoom_about(axis.value(pos.x), factor, whole);
        }
    }

    fn zoom_about(&mut self, value: f32, factor: f32, whole: [f32; 2]) {
        let [low, high] = self.zoomed.unwrap_or(whole);
        let width =
            ((high - low) / factor).clamp((whole[1] - whole[0]) * 0.005, whole[1] - whole[0]);
        let part = (value - low) / (high - low);
        let low = (value - part * width).clamp(whole[0], whole[1] - width);
        let is_whole = width >= 0.999 * (whole[1] - whole[0]);
        self.zoomed = (!is_whole).then_some([low, low + width]);
    }

    /// The part of the plot under a place; where several overlap, the most specific.
    fn grip_at(&self, pos: Pos2, axis: &Axis, shown: &Shown<'_>) -> Option<Grip> {
        let nearest = |i: &usize| {
            axis.place(shown.points[*i].value, shown.points[*i].opacity)
                .distance(pos)
        };
        // The selected point goes first, so that of two points at one place the selected one is dragged.
        if let Some(i) = self
            .selected
            .filter(|i| *i < shown.points.len() && nearest(i) <= 0.7 * REACH)
        {
            return Some(Grip::Point(i));
        }
        if pos.y >= axis.curve.top() - 4.0 {
            let points = (0..shown.points.len()).filter(|i| axis.contains(shown.points[*i].value));
            let found = points.min_by(|a, b| nearest(a).total_cmp(&nearest(b)));
            return found.filter(|i| nearest(i) <= REACH).map(Grip::Point);
        }
        let ends = shown.window.map(|value| (axis.x(value) - pos.x).abs());
        let end = usize::from(ends[1] < ends[0]);
        if ends[end] <= REACH {
            return Some(Grip::End(end));
        }
        let [low, high] = shown.window.map(|value| axis.x(value));
        (low..=high).contains(&pos.x).then_some(Grip::Bar)
    }

    fn gestures(
        &mut self,
        ui: &Ui,
        response: &Response,
        axis: &Axis,
        whole: [f32; 2],
        shown: &Shown<'_>,
        commands: &mut Vec<Command>,
    ) {
        let pointer = response.interact_pointer_pos();
        if response.drag_started() {
            let from = ui.input(|i| i.pointer.press_origin()).or(pointer);
            if let Some(from) = from {
                let grip = self.grip_at(from, axis, shown).unwrap_or(Grip::Axis);
                if let Grip::Point(i) = grip {
                    self.select(Some(i));
                }
                self.held = Some(Held {
                    grip,
                    from,
                    points: shown.points.clone(),
                    window: shown.window,
                    shown: axis.range,
                });
            }
        }
        if let (Some(held), Some(pos), true) = (&self.held, pointer, response.dragged()) {
            match held.grip {
                Grip::Point(i) => {
                    let mut points = held.points.clone();
                    if is_dropped(ui, axis.curve) && points.len() > 1 {
                        points.remove(i);
                    } else {
                        let start = axis.place(points[i].value, points[i].opacity);
                        let at = start + (pos - held.from);
                        move_point(&mut points, i, axis.value(at.x), axis.opacity(at.y));
                    }
                    if points != shown.points {
                        commands.push(points_command(points, shown.tint, true));
                    }
                }
                Grip::End(end) => {
                    let mut window = held.window;
                    window[end] = axis.value(axis.x(window[end]) + pos.x - held.from.x);
                    push_window(window, end, axis, shown, commands);
                }
                Grip::Bar => {
                    let by = (pos.x - held.from.x) * axis.per_point();
                    push_window(held.window.map(|v| v + by), 1, axis, shown, commands);
                }
                Grip::Axis => {
                    // A finger that finds nothing to hold scrolls the panel, which is mostly plot on a phone.
                    if ui.input(egui::InputState::has_touch_screen) {
                        let by = vec2(0.0, ui.input(|i| i.pointer.delta().y));
                        ui.scroll_with_delta_animation(by, egui::style::ScrollAnimation::none());
                    }
                    if self.zoomed.is_some() {
                        let width = held.shown[1] - held.shown[0];
                        let by = (held.from.x - pos.x) * axis.per_point();
                        let low = (held.shown[0] + by).clamp(whole[0], whole[1] - width);
                        self.zoomed = Some([low, low + width]);
                    }
                }
            }
        }
        if response.drag_stopped() || !ui.input(|i| i.pointer.any_down()) {
            self.held = None;
        }
        let (Some(pos), None) = (pointer, &self.held) else {
            return;
        };
        let grip = self.grip_at(pos, axis, shown);
        if response.secondary_clicked() || response.long_touched() {
            if let Some(Grip::Point(i)) = grip {
                self.remove(i, shown, commands);
            }
        } else if response.double_clicked() && grip.is_none() {
            self.add(
                axis.value(pos.x),
                Some(axis.opacity(pos.y)),
                shown,
                commands,
            );
        } else if response.clicked() {
            let on_line = (axis
                .place(0.0, opacity_at(&shown.points, axis.value(pos.x)))
                .y
                - pos.y)
                .abs()
                <= 8.0
                && axis.curve.expand(4.0).contains(pos);
            match grip {
                Some(Grip::Point(i)) => self.select(Some(i)),
                None if on_line => {
                    self.add(axis.value(pos.x), None, shown, commands);
                }
                _ => self.selected = None,
            }
        }
    }

    /// Selects a point. The point gets the keyboard too, once all points have been shown: before that a click beside
    /// its old place would take the keyboard away again.
    fn select(&mut self, point: Option<usize>) {
        self.selected = point;
        self.wants_focus = point;
    }

    /// Adds a point at a value ([`with_point`]) and selects it.
    fn add(
        &mut self,
        value: f32,
        opacity: Option<f32>,
        shown: &Shown<'_>,
        commands: &mut Vec<Command>,
    ) {
        if shown.points.len() >= MAX_POINTS {
            return;
        }
        let (points, at) = with_point(&shown.points, value, opacity);
        self.select(Some(at));
        commands.push(points_command(points, shown.tint, false));
    }

    fn remove(&mut self, i: usize, shown: &Shown<'_>, commands: &mut Vec<Command>) {
        if shown.points.len() > 1 && i < shown.points.len() {
            let mut points = shown.points.clone();
            points.remove(i);
            self.selected = None;
            commands.push(points_command(points, shown.tint, false));
        }
    }

    // ------------------------------------------------------------------------------------------------ below the plot

    fn buttons_ui(
        &mut self,
        ui: &mut Ui,
        shown: &Shown<'_>,
        info: &SubjectInfo,
        commands: &mut Vec<Command>,
    ) {
        let whole = self.whole(shown, info);
        widget::row(ui, |ui| {
            let has_room = shown.points.len() < MAX_POINTS;
            if widget::labelled_button(ui, Icon::Plus, look::w().add_point, false, has_room)
                .clicked()
            {
                // After the selected one, half way to the next.
                let i = self.selected.unwrap_or(shown.points.len() / 2);
                let at = |i: usize| shown.points.get(i).map(|p| p.value);
                let value = match (at(i), at(i + 1)) {
                    (Some(a), Some(b)) => 0.5 * (a + b),
                    (Some(a), None) => 0.5 * (a + whole[1].max(a)),
                    _ => 0.5 * (whole[0] + whole[1]),
                };
                let (points, at) = with_point(&shown.points, value, None);
                self.selected = Some(at);
                commands.push(points_command(points, shown.tint, false));
            }
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                if widget::icon_button(ui, Icon::Reset, w().whole, self.zoomed.is_some()).clicked()
                {
                    self.zoomed = None;
                }
                if widget::icon_button(ui, Icon::Magnifier, w().closer, true).clicked() {
                    let selected = self.selected.and_then(|i| shown.points.get(i));
                    let middle =
                        selected.map_or(0.5 * (shown.window[0] + shown.window[1]), |p| p.value);
                    self.zoom_about(middle.clamp(whole[0], whole[1]), 1.6, whole);
                }
            });
        });
    }

    /// Colour, value and opacity of the selected point.
    fn point_ui(
        &mut self,
        ui: &mut Ui,
        shown: &Shown<'_>,
        info: &SubjectInfo,
        commands: &mut Vec<Command>,
    ) {
        let weak = Palette::get(ui).weak;
        let Some((i, point)) = self.selected.and_then(|i| Some((i, *shown.points.get(i)?))) else {
            let text = w().choose;
            ui.add(egui::Label::new(egui::RichText::new(text).small().color(weak)).wrap());
            return;
        };
        let span = (info.value_range[1] - info.value_range[0]).max(1e-6);
        let decimals = if span > 50.0 { 1 } else { 4 };
        widget::row(ui, |ui| {
            let mut edited = point;
            let color = ui.color_edit_button_srgb(&mut edited.color_srgb);
            let color = color
                .named(fill(look::w().colour_n, &[&(i + 1)]))
                .on_hover_text(w().colour);
            let width = ((ui.available_width() - control_height() - 14.0) / 2.0).clamp(60.0, 120.0);
            let field = widget::number_field(&mut edited.value, decimals).speed(span / 800.0);
            let value = ui.add_sized(vec2(width, control_height()), field);
            let value = value
                .named(fill(look::w().value_n, &[&(i + 1)]))
                .on_hover_text(look::w().value);
            let mut opacity_percent = edited.opacity * 100.0;
            let field = widget::number_field(&mut opacity_percent, 2)
                .range(0.0..=100.0)
                .speed(0.25)
                .suffix(" %");
            let opacity = ui.add_sized(vec2(width, control_height()), field);
            let opacity = opacity
                .named(fill(look::w().opacity_n, &[&(i + 1)]))
                .on_hover_text(look::w().opacity_hint);
            if opacity.changed() {
                edited.opacity = opacity_percent / 100.0;
            }
            if color.changed() || value.changed() || opacity.changed() {
                let is_drag = color.changed()
                    || ui.input(|i| i.pointer.any_down() || i.pointer.any_released());
                let mut points = shown.points.clone();
                points[i].color_srgb = edited.color_srgb;
                // A typed value may go past its neighbours: the point takes its place among them.
                points[i].opacity = edited.opacity;
                points[i].value = edited.value;
                if value.changed() && !is_drag {
                    points.sort_by(|a, b| a.value.total_cmp(&b.value));
                    self.selected = points.iter().position(|p| p.value == edited.value);
                } else {
                    move_point(&mut points, i, edited.value, edited.opacity);
                }
                commands.push(points_command(points, shown.tint, is_drag));
            }
            let name = fill(look::w().remove_point, &[&(i + 1)]);
            if widget::icon_button(ui, Icon::Trash, &name, shown.points.len() > 1).clicked() {
                self.remove(i, shown, commands);
            }
        });
    }
}

/// What the arrow keys and Delete do to a point that has the keyboard.
fn keys(ui: &Ui, i: usize, shown: &Shown<'_>, axis: &Axis) -> Option<Vec<TransferPoint>> {
    let (mut across, mut up, mut is_removed) = (0.0, 0.0, false);
    ui.input_mut(|input| {
        for (modifiers, step) in [(Modifiers::SHIFT, 10.0), (Modifiers::NONE, 1.0)] {
            let mut count = |key| input.count_and_consume_key(modifiers, key) as f32 * step;
            across += count(Key::ArrowRight) - count(Key::ArrowLeft);
            up += count(Key::ArrowUp) - count(Key::ArrowDown);
        }
        is_removed = input.consume_key(Modifiers::NONE, Key::Delete)
            || input.consume_key(Modifiers::NONE, Key::Backspace);
    });
    let mut points = shown.points.clone();
    if is_removed && points.len() > 1 {
        points.remove(i);
    } else if across != 0.0 || up != 0.0 {
        let point = points[i];
        let value = point.value + across * axis.per_point();
        let opacity = (point.opacity.sqrt() + 0.01 * up).clamp(0.0, 1.0).powi(2);
        move_point(&mut points, i, value, opacity);
    }
    (points != shown.points).then_some(points)
}

/// The pointer is so far above or below the field that a held point is let go.
fn is_dropped(ui: &Ui, curve: Rect) -> bool {
    let pos = ui.input(|i| i.pointer.latest_pos());
    pos.is_some_and(|pos| {
        pos.y < curve.top() - LANE - DROP || pos.y > curve.bottom() + STRIP + TICKS + DROP
    })
}

/// Moves a point as far as its neighbours let it.
fn move_point(points: &mut [TransferPoint], i: usize, value: f32, opacity: f32) {
    let low = i
        .checked_sub(1)
        .and_then(|i| points.get(i))
        .map_or(f32::MIN, |p| p.value);
    let high = points.get(i + 1).map_or(f32::MAX, |p| p.value);
    if let Some(point) = points.get_mut(i) {
        point.value = value.clamp(low, high.max(low));
        point.opacity = opacity.clamp(0.0, 1.0);
    }
}

/// Points with one more at a value, in the colour that is there already, and with the opacity there unless another is
/// given; and the index of the new point.
fn with_point(
    points: &[TransferPoint],
    value: f32,
    opacity: Option<f32>,
) -> (Vec<TransferPoint>, usize) {
    let mut longer = points.to_vec();
    let at = points.partition_point(|p| p.value <= value);
    let point = TransferPoint {
        value,
        color_srgb: color_at(points, value),
        opacity: opacity.unwrap_or_else(|| opacity_at(points, value)),
    };
    longer.insert(at, point);
    (longer, at)
}

fn points_command(points: Vec<TransferPoint>, tint: f32, is_drag: bool) -> Command {
    let edit = Edit::SetPoints { points, tint };
    if is_drag {
        Command::Drag(edit)
    } else {
        Command::Apply(edit)
    }
}

/// The end that moved gives way where the other stands.
fn push_window(
    mut window: [f32; 2],
    moved: usize,
    axis: &Axis,
    shown: &Shown<'_>,
    commands: &mut Vec<Command>,
) {
    let least = 2.0 * axis.per_point();
    if window[1] - window[0] < least {
        if moved == 0 {
            window[0] = window[1] - least;
        } else {
            window[1] = window[0] + least;
        }
    }
    if window != shown.window {
        commands.push(Command::Drag(Edit::SetWindow(Window::Range(window))));
    }
}

fn neighbours(points: &[TransferPoint], value: f32) -> Option<(TransferPoint, TransferPoint, f32)> {
    let after = points.partition_point(|p| p.value <= value);
    let a = points.get(after.saturating_sub(1)).or(points.first())?;
    let b = points.get(after).unwrap_or(a);
    let part = (value - a.value) / (b.value - a.value).max(1e-12);
    Some((*a, *b, part.clamp(0.0, 1.0)))
}

fn opacity_at(points: &[TransferPoint], value: f32) -> f32 {
    neighbours(points, value).map_or(0.0, |(a, b, part)| {
        a.opacity + (b.opacity - a.opacity) * part
    })
}

/// The colour that is mixed at a value, in linear light.
fn color_at(points: &[TransferPoint], value: f32) -> [u8; 3] {
    use egui::ecolor::{gamma_u8_from_linear_f32, linear_f32_from_gamma_u8};
    neighbours(points, value).map_or([255; 3], |(a, b, part)| {
        std::array::from_fn(|i| {
            let [a, b] = [a, b].map(|p| linear_f32_from_gamma_u8(p.color_srgb[i]));
            gamma_u8_from_linear_f32(a + (b - a) * part)
        })
    })
}

// ---------------------------------------------------------------------------------------------------- presets

/// The presets by what they are made for, those for this subject first.
pub(crate) fn grouped_presets(
    info: Option<&SubjectInfo>,
) -> Vec<(&'static str, Vec<&'static Preset>)> {
    let mut groups = vec![
        (PresetSubject::Builtin, w().segments),
        (PresetSubject::Ct, w().ct),
        (PresetSubject::Mri, w().other),
    ];
    let first = info.map(|info| match (info.has_segments, info.is_ct) {
        (true, _) => PresetSubject::Builtin,
        (_, true) => PresetSubject::Ct,
        _ => PresetSubject::Mri,
    });
    groups.sort_by_key(|(subject, _)| Some(*subject) != first);
    let of = |subject| {
        presets()
            .iter()
            .filter(move |p| p.subject == subject)
            .collect()
    };
    groups
        .into_iter()
        .map(|(subject, title)| (title, of(subject)))
        .collect()
}

/// The heading of each group in the list of presets.
pub(crate) fn group_heading(ui: &mut Ui, title: &str) {
    let weak = Palette::get(ui).weak;
    ui.add_space(2.0);
    ui.label(theme::strong(title).size(11.5).color(weak));
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(value: f32, opacity: f32) -> TransferPoint {
        TransferPoint {
            value,
            color_srgb: [10, 20, 30],
            opacity,
        }
    }

    #[test]
    fn a_point_stays_between_its_neighbours() {
        let mut points = vec![point(0.0, 0.0), point(5.0, 0.5), point(10.0, 1.0)];
        move_point(&mut points, 1, 99.0, 2.0);
        assert_eq!(points[1], point(10.0, 1.0));
        move_point(&mut points, 1, -99.0, -1.0);
        assert_eq!(points[1], point(0.0, 0.0));
        move_point(&mut points, 0, -99.0, 0.25);
        assert_eq!(points[0], point(-99.0, 0.25), "the ends are free outwards");
    }

    #[test]
    fn what_is_added_changes_nothing() {
        let points = [point(0.0, 0.0), point(10.0, 1.0)];
        assert!((opacity_at(&points, 2.5) - 0.25).abs() < 1e-6);
        assert_eq!(
            opacity_at(&points, -5.0),
            0.0,
            "before the first it goes on"
        );
        assert_eq!(opacity_at(&points, 50.0), 1.0);
        assert_eq!(color_at(&points, 5.0), [10, 20, 30]);
        assert_eq!(opacity_at(&[], 1.0), 0.0);
    }

    #[test]
    fn the_axis_goes_both_ways() {
        let axis = Axis {
            curve: Rect::from_min_size(pos2(10.0, 20.0), vec2(200.0, 100.0)),
            range: [-1000.0, 1000.0],
        };
        let at = axis.place(250.0, 0.04);
        assert!((axis.value(at.x) - 250.0).abs() < 1e-2);
        assert!((axis.opacity(at.y) - 0.04).abs() < 1e-5);
        assert!(
            (at.y - 100.0).abs() < 1e-3,
            "4 % is a fifth of the height: {at}"
        );
    }
}
