//! Slices of the deformed object beside the picture: axial, coronal and sagittal, through one crosshair.
//!
//! As radiologists lay them: the patient's right at the left of axial and coronal slices, the face to the left in
//! sagittal ones, superior up.
//!

use egui::{
    Align2, Color32, CursorIcon, EventFilter, Key, Modifiers, Painter, PointerButton, Pos2, Rect,
    Response, Role, Sense, Stroke, Ui, UiBuilder, Vec2, WidgetInfo, pos2, vec2,
};
use glam::Vec3;

use super::ball::{self, SliceBall};
use super::levelling;
use super::measure::Distances;
use crate::app::canvas::panes::{ONE_PANE, Places, pane_name};
use crate::app::canvas::slice_plot::{
    Axes, Map, SLICES, STRIP, edges, paint_crosshair, paint_section, paint_template, sections,
};
use crate::app::kit::float::float_frame;
use crate::app::kit::icon::Icon;
use crate::app::kit::theme::{self, over_picture as ink};
use crate::app::kit::{slow_click, widget};
use crate::app::picture::host::Picture;
use crate::app::session::shape::placement_on_surface;
use crate::app::session::{Command, Gravity, See, Session, SubjectFacts};
use crate::app::words::names;
use crate::app::words::{fill, slices::w};
use crate::data::Resources;
use crate::document::{Background, Edit, PlacedTemplate};
use crate::math::{Aabb, Placement};
use crate::placed::deformed_bounds;
use crate::render::{MarkedValues, PendingSlice, SliceColors, SlicePlane, SliceTexel, SliceView};

/// Points of the wheel for one voxel.
const WHEEL_PER_VOXEL: f32 = 16.0;
/// Where nothing is, in grey slices: a little lighter than air, so that a gap is not taken for it.
const NOTHING_SRGB: [u8; 3] = [26, 30, 34];
/// How near a press must be to a template's dot, points.
const REACH: f32 = 14.0;

/// The thing that is dragged in a pane.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Held {
    Crosshair,
    /// A template, and its centre as seen from where it was taken hold of, subject space.
    Template(usize, Vec3),
}

/// What of a pane lives from frame to frame.
#[derive(Debug)]
struct PaneView {
    /// From the middle of the object, along right and down, subject units.
    pan: Vec2,
    zoom: f32,
    held: Option<Held>,
}

impl Default for PaneView {
    fn default() -> Self {
        Self {
            pan: Vec2::ZERO,
            zoom: 1.0,
            held: None,
        }
    }
}

/// A question about a point: where, and for which document and subject.
type Asked = (Vec3, u64, u64);

/// The three slices beside the picture: what each pane shows, and the value under the pointer.
#[derive(Default)]
pub(crate) struct Slices {
    panes: [PaneView; 3],
    reading: Option<(Asked, PendingSlice)>,
    /// The last answer about a point, and the question that it answers.
    read: Option<(Asked, SliceTexel)>,
    /// A pane has the keyboard: page up and down are for it.
    pub(crate) has_keyboard: bool,
    has_failed: bool,
    ball: SliceBall,
    /// Where the line about a point was painted last: the lower letter of that pane makes way.
    readout: Option<Rect>,
}

impl Slices {
    /// Everything but the picture.
    pub(crate) fn ui(
        &mut self,
        ui: &mut Ui,
        places: &Places,
        session: &Session,
        mut picture: Option<&mut Picture>,
        commands: &mut Vec<Command>,
    ) {
        self.has_keyboard = false;
        let Some(facts) = session.view.subject.clone() else {
            return;
        };
        let bounds = shown_bounds(&facts, session);
        let mut cross = session.view.cross;
        let mut hovered = None;
        for (i, axes) in SLICES.iter().enumerate() {
            if let Some(rect) = places.slices[i] {
                let found = self.pane_ui(
                    ui,
                    (i, axes, rect),
                    session,
                    &mut cross,
                    (&facts, bounds),
                    picture.as_deref_mut(),
                    commands,
                );
                hovered = hovered.or(found.map(|pos| (pos, rect)));
            }
        }
        // The planes stay in the outermost voxels, however far outside a click lies.
        let edge = Vec3::splat(0.5 * facts.detail).min(0.5 * (bounds.max - bounds.min));
        cross = cross.clamp(bounds.min + edge, bounds.max - edge);
        if cross != session.view.cross {
            commands.push(Command::See(See::Cross(cross)));
            ui.ctx().request_repaint();
        }
        self.readout_ui(
            ui,
            (places, hovered, cross),
            session,
            &facts,
            picture,
            commands,
        );
    }

    /// The place that the pointer shows, if it is in this pane.
    #[expect(
        clippy::too_many_arguments,
        reason = "the pane, and what it shows and changes"
    )]
    fn pane_ui(
        &mut self,
        ui: &mut Ui,
        (i, axes, rect): (usize, &Axes, Rect),
        session: &Session,
        cross: &mut Vec3,
        (facts, bounds): (&SubjectFacts, Aabb),
        mut picture: Option<&mut Picture>,
        commands: &mut Vec<Command>,
    ) -> Option<Vec3> {
        let name = pane_name(axes.pane);
        let id = ui.scope_id().with(("slice", i));
        let response = ui.interact(rect, id, Sense::click_and_drag());
        response.widget_info(|| {
            WidgetInfo::labeled(Role::Image, ui.is_enabled(), fill(w().slice, &[&name]))
        });
        let map = self.map(i, axes, rect, *cross, bounds);
        let by = levelling::drag(ui, &response, session);
        let has_window = by.is_some() || session.tool().is_levelling();
        let shown = picture.as_deref().filter(|_| has_window);
        let shown =
            shown.and_then(|p| Some((grey_window(session, p)?, p.subject_info()?.value_range)));
        if let (Some(by), Some((window, values))) = (by, shown) {
            commands.extend(levelling::command(by, window, values));
        }
        let at = (i, &response, &map);
        let paints = self
            .ball
            .ui(ui, at, session, picture.as_deref_mut(), commands);
        let hand = (&response, by.is_some() || paints);
        self.gestures(ui, i, hand, &map, (session, facts), cross, commands);
        self.keys(ui, &response, axes, cross, facts);
        let map = self.map(i, axes, rect, *cross, bounds);

        let background = match (
            session.view.has_slice_colors,
            session.shown().look.background,
        ) {
            (false, _) => NOTHING_SRGB,
            (true, Background::Color(color)) => color,
            (true, Background::None) => [128; 3],
        };
        let [r, g, b] = background;
        let fill_color = Color32::from_rgb(r, g, b);
        ui.painter().rect_filled(rect, 0.0, fill_color);
        self.image_ui(ui, i, &map, session, picture, background, commands);

        let painter = ui.painter_at(rect);
        let is_dark = fill_color.intensity() < 0.45;
        let letters = if is_dark {
            Color32::from_white_alpha(190)
        } else {
            Color32::from_black_alpha(170)
        };
        let head = self.head_ui(&painter, (axes, rect), facts, *cross, letters);
        edges(&painter, axes, rect, [Some(head), self.readout], letters);
        paint_crosshair(&painter, axes, &map, *cross);
        self.templates_ui(ui, &painter, i, &map, session);
        ball::paint_in_slice(ui, &painter, &response, &map, session);
        // Lines in the slice are bright, lines a tenth of the object away are faint.
        let nearness = |pos: Vec3| (1.0 - 10.0 * map.height(pos).abs()).max(0.0);
        let seen = |pos: Vec3| Some(map.ui(pos));
        if let Some((window, _)) = shown {
            let at = rect.center_bottom() - vec2(0.0, 30.0);
            let font = theme::strong_font(13.0);
            let text = levelling::in_words(window);
            painter.text(at, Align2::CENTER_BOTTOM, text, font, letters);
        }
        let distances = Distances::of(session);
        distances.paint(&painter, facts.mm_per_unit, seen, nearness);
        if let (Some(kind), Some(pos)) = (session.tool().placing(), response.hover_pos()) {
            let pos = map.subject(pos);
            let normal = outwards(pos, facts.bounds.center(), axes);
            let placement = placement_on_surface(kind, pos, normal, &session.camera);
            paint_section(&painter, &map, &placement, Stroke::new(1.5, ink::HOT));
        }
        self.controls_ui(ui, (axes, rect), bounds, session, cross, letters, commands);
        if response.has_focus() {
            widget::focus_ring(ui, &response, rect.shrink(1.0));
        }
        let pos = response
            .hover_pos()
            .filter(|_| !ui.input(|i| i.any_touches()));
        pos.map(|pos| map.subject(pos))
    }

    fn map<'a>(&self, i: usize, axes: &'a Axes, rect: Rect, cross: Vec3, bounds: Aabb) -> Map<'a> {
        let pane = &self.panes[i];
        let size = bounds.max - bounds.min;
        let (across, along) = (size.dot(axes.right.abs()), size.dot(axes.down.abs()));
        let room = (rect.size() - vec2(36.0 + STRIP, 64.0)).max(Vec2::splat(40.0));
        let fitting = (across / room.x).max(along / room.y).max(1e-6);
        let center = bounds.center();
        let middle = center
            + axes.normal * (cross - center).dot(axes.normal)
            + axes.right * pane.pan.x
            + axes.down * pane.pan.y;
        Map {
            rect,
            axes,
            middle,
            units_per_point: fitting / pane.zoom,
        }
    }

    // ------------------------------------------------------------------------------------------------ the hand

    #[expect(
        clippy::too_many_arguments,
        reason = "one place for everything that the hand does"
    )]
    fn gestures(
        &mut self,
        ui: &Ui,
        i: usize,
        (response, is_taken): (&Response, bool),
        map: &Map<'_>,
        (session, facts): (&Session, &SubjectFacts),
        cross: &mut Vec3,
        commands: &mut Vec<Command>,
    ) {
        let axes = map.axes;
        let touch = ui
            .input(|i| i.multi_touch())
            .filter(|touch| map.rect.contains(touch.center_pos));
        let pane = &mut self.panes[i];
        if let Some(touch) = touch {
            pane.zoom_about(touch.zoom_delta, touch.center_pos, map);
            pane.held = None;
            return;
        }
        if response.contains_pointer() {
            let (wheel, zoom) = ui.input(|i| (i.smooth_scroll_delta().y, i.zoom_delta()));
            if zoom != 1.0 {
                let at = response.hover_pos().unwrap_or(map.rect.center());
                pane.zoom_about(zoom, at, map);
            } else if wheel != 0.0 {
                let by = axes.normal * (wheel / WHEEL_PER_VOXEL * facts.detail);
                *cross += by;
            }
        }
        if is_taken {
            pane.held = None;
            return;
        }
        let pointer = response.interact_pointer_pos();
        let is_pan = response.dragged_by(PointerButton::Middle)
            || (response.dragged() && ui.input(|i| i.modifiers.shift));
        if is_pan {
            pane.pan -= response.drag_delta() * map.units_per_point;
            return;
        }
        if response.drag_started() && session.tool().placing().is_none() {
            let from = ui.input(|i| i.pointer.press_origin()).or(pointer);
            pane.held = from.map(|from| match template_at(from, map, session) {
                Some(template) => {
                    commands.push(Command::Select(Some(template.index)));
                    Held::Template(template.index, template.placement.at - map.subject(from))
                }
                None => Held::Crosshair,
            });
        }
        if let (Some(held), Some(pos), true) = (pane.held, pointer, response.dragged()) {
            match held {
                Held::Crosshair => *cross = map.subject(pos),
                Held::Template(index, offset) => {
                    let templates = &session.shown().templates;
                    if let Some(template) = templates.iter().find(|t| t.index == index) {
                        let at = map.subject(pos) + offset;
                        let placement = Placement {
                            at: at.clamp(Vec3::splat(-4.0), Vec3::splat(4.0)),
                            ..template.placement
                        };
                        commands.push(Command::Drag(Edit::SetPlacement {
                            template: index,
                            placement,
                        }));
                    }
                }
            }
        }
        if !response.dragged() {
            pane.held = None;
        }
        let Some(pos) = pointer.filter(|_| response.clicked()) else {
            return;
        };
        ui.memory_mut(|memory| memory.request_focus(response.id));
        if session.tool().placing().is_some() {
            let pos = map.subject(pos);
            let normal = outwards(pos, facts.bounds.center(), axes);
            commands.push(Command::PlaceAt { pos, normal });
        } else if session.tool().is_measuring() {
            let places = slow_click::places(ui, response).into_iter();
            commands.extend(places.map(|pos| Command::Measure(Some(map.subject(pos)))));
        } else if let Some(template) = template_at(pos, map, session) {
            commands.push(Command::Select(Some(template.index)));
        } else {
            *cross = map.subject(pos);
        }
    }

    fn keys(
        &mut self,
        ui: &Ui,
        response: &Response,
        axes: &Axes,
        cross: &mut Vec3,
        facts: &SubjectFacts,
    ) {
        if !response.has_focus() {
            return;
        }
        self.has_keyboard = true;
        let filter = EventFilter {
            horizontal_arrows: true,
            vertical_arrows: true,
            ..Default::default()
        };
        ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, filter));
        let mut by = Vec3::ZERO;
        ui.input_mut(|input| {
            for (modifiers, step) in [(Modifiers::SHIFT, 10.0), (Modifiers::NONE, 1.0)] {
                let mut count = |key| input.count_and_consume_key(modifiers, key) as f32 * step;
                by += axes.right * (count(Key::ArrowRight) - count(Key::ArrowLeft));
                by += axes.down * (count(Key::ArrowDown) - count(Key::ArrowUp));
                by += axes.normal * (count(Key::PageUp) - count(Key::PageDown));
            }
        });
        if by != Vec3::ZERO {
            *cross += by * facts.detail;
        }
    }

    // ------------------------------------------------------------------------------------------------ what is seen

    #[expect(clippy::too_many_arguments, reason = "what a slice is drawn from")]
    fn image_ui(
        &mut self,
        ui: &Ui,
        i: usize,
        map: &Map<'_>,
        session: &Session,
        picture: Option<&mut Picture>,
        background_srgb: [u8; 3],
        commands: &mut Vec<Command>,
    ) {
        let Some(picture) = picture else {
            return;
        };
        let Some(window) = grey_window(session, picture) else {
            return;
        };
        let ppp = ui.pixels_per_point();
        let size_px = [map.rect.width(), map.rect.height()]
            .map(|side| (side * ppp).round().clamp(1.0, 4096.0) as u32);
        let step = map.units_per_point / ppp;
        let is_moving = ui.input(|i| i.pointer.any_down());
        // Over grey, so that what the range leaves out is seen beside what it takes.
        let [r, g, b, _] = ink::TAKEN.to_array();
        let marked = session.tissues.taken.map(|taken| MarkedValues {
            range: taken.range,
            color_srgb: [r, g, b],
        });
        let view = SliceView {
            plane: SlicePlane {
                corner: map.subject(map.rect.min),
                right: map.axes.right * step,
                down: map.axes.down * step,
            },
            size_px,
            colors: if session.view.has_slice_colors && marked.is_none() {
                SliceColors::Look
            } else {
                SliceColors::Grey {
                    window,
                    marks_bodies: session.tool().ball().is_some(),
                }
            },
            background_srgb,
            samples: if is_moving { 1 } else { 2 },
            marked,
        };
        match picture.slice(i, &view) {
            Ok(Some(texture)) => {
                let uv = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
                ui.painter().image(texture, map.rect, uv, Color32::WHITE);
                self.has_failed = false;
            }
            Ok(None) => {}
            Err(error) => {
                if !std::mem::replace(&mut self.has_failed, true) {
                    let message = crate::app::words::messages::w().cannot_draw.to_owned();
                    commands.push(Command::Notify(Gravity::Error, message, error.to_string()));
                }
            }
        }
    }

    /// Boxes cut by the slice, and dots to take hold of.
    fn templates_ui(&self, ui: &Ui, painter: &Painter, i: usize, map: &Map<'_>, session: &Session) {
        for template in &session.shown().templates {
            let is_selected = session.selection.template() == Some(template.index);
            let fade = if template.enabled { 1.0 } else { 0.45 };
            let width = if is_selected { 2.2 } else { 1.4 };
            let color = if is_selected { ink::HANDLE } else { ink::HOT };
            let stroke = Stroke::new(width, color.gamma_multiply(fade));
            let is_cut = paint_template(painter, map, template, stroke);
            if !is_cut && !is_selected {
                continue;
            }
            let at = map.ui(template.placement.at);
            if !map.rect.contains(at) {
                continue;
            }
            let title = names::template_title(template);
            let target = Rect::from_center_size(at, Vec2::splat(2.0 * REACH));
            let id = ui.scope_id().with(("slice template", i, template.index));
            let handle = ui.interact(target, id, Sense::empty());
            let name = fill(w().move_template, &[&title]);
            handle.widget_info(|| WidgetInfo::labeled(Role::GraphicsObject, true, &name));
            let is_hot = ui
                .input(|i| i.pointer.hover_pos())
                .is_some_and(|pos| pos.distance(at) <= REACH);
            if is_hot {
                ui.ctx().set_cursor_icon(CursorIcon::Grab);
                let text = painter.layout_no_wrap(title, theme::strong_font(12.0), Color32::WHITE);
                let corner = at + vec2(14.0, -0.5 * text.size().y);
                let back = Rect::from_min_size(corner, text.size()).expand2(vec2(6.0, 3.0));
                painter.rect_filled(back, 4.0, Color32::from_black_alpha(190));
                painter.galley(corner, text, Color32::WHITE);
            }
            let radius = if is_hot { 7.0 } else { 5.5 };
            painter.circle_filled(at, radius + 2.0, ink::HALO_DARK);
            painter.circle_filled(at, radius, Color32::WHITE.gamma_multiply(fade));
            painter.circle_filled(at, radius - 2.0, color.gamma_multiply(fade));
        }
    }

    /// Name and position at the head of a pane. Returns where they are painted.
    fn head_ui(
        &self,
        painter: &Painter,
        (axes, rect): (&Axes, Rect),
        facts: &SubjectFacts,
        cross: Vec3,
        letters: Color32,
    ) -> Rect {
        let name = pane_name(axes.pane);
        let mm = facts.world_from_subject(cross)[axes.axis];
        let text = fill(w().mm, &[&widget::plain(f64::from(mm), 1)]);
        let corner = rect.left_top() + vec2(10.0, 8.0);
        let shown = painter.text(
            corner,
            Align2::LEFT_TOP,
            name,
            theme::strong_font(13.0),
            axes.color,
        );
        let position = painter.text(
            shown.right_top() + vec2(8.0, 1.0),
            Align2::LEFT_TOP,
            text,
            egui::FontId::proportional(12.0),
            letters,
        );
        shown.union(position)
    }

    /// The strip that scrolls through, and the buttons of a pane.
    #[expect(clippy::too_many_arguments, reason = "what stands around a slice")]
    fn controls_ui(
        &mut self,
        ui: &mut Ui,
        (axes, rect): (&Axes, Rect),
        bounds: Aabb,
        session: &Session,
        cross: &mut Vec3,
        letters: Color32,
        commands: &mut Vec<Command>,
    ) {
        let name = pane_name(axes.pane);
        let at = cross[axes.axis];
        let painter = ui.painter_at(rect);

        // The strip at the right.
        let (low, high) = (bounds.min[axes.axis], bounds.max[axes.axis]);
        let strip = Rect::from_min_max(
            pos2(rect.right() - STRIP, rect.top() + 48.0),
            pos2(rect.right(), rect.bottom() - 30.0),
        );
        if strip.height() > 60.0 && high > low {
            let rail = strip.shrink2(vec2(0.5 * STRIP - 1.5, 6.0));
            let y = |value: f32| rail.bottom() - (value - low) / (high - low) * rail.height();
            let response = ui.interact(
                strip,
                ui.scope_id().with(("through", axes.axis)),
                Sense::click_and_drag(),
            );
            let label = fill(w().position, &[&name]);
            response
                .widget_info(|| WidgetInfo::slider(ui.is_enabled(), f64::from(at), label.clone()));
            if let Some(pos) = response.interact_pointer_pos()
                && (response.dragged() || response.clicked())
            {
                let part = ((rail.bottom() - pos.y) / rail.height()).clamp(0.0, 1.0);
                cross[axes.axis] = low + part * (high - low);
            }
            painter.rect_filled(rail, 2.0, letters.gamma_multiply(0.35));
            let knob = pos2(rail.center().x, y(at.clamp(low, high)));
            let radius = if response.hovered() || response.dragged() {
                8.0
            } else {
                6.5
            };
            painter.circle(knob, radius, axes.color, Stroke::new(2.0, Color32::WHITE));
        }

        // Expand, colours.
        let is_alone = session.view.expanded == Some(axes.pane);
        let is_narrow = rect.width() < ONE_PANE && is_alone;
        let bar = Rect::from_min_size(
            pos2(rect.right() - 74.0, rect.top() + 6.0),
            vec2(68.0, 34.0),
        );
        let bar = if is_narrow {
            bar.with_min_x(bar.max.x - 36.0)
        } else {
            bar
        };
        float_frame(ui, bar);
        let mut inner = ui.new_child(
            UiBuilder::new()
                .id_salt(("pane", axes.axis))
                .max_rect(bar.shrink(3.0))
                .layout(egui::Layout::left_to_right(egui::Align::Center)),
        );
        inner.spacing_mut().item_spacing.x = 4.0;
        let has_colors = session.view.has_slice_colors;
        let text = if has_colors { w().greys } else { w().colours };
        let button =
            widget::icon_button_sized(&mut inner, Icon::Look, text, true, has_colors, 28.0);
        if button.clicked() {
            commands.push(Command::See(See::ToggleSliceColors));
        }
        if !is_narrow {
            let (text, see) = if is_alone {
                (w().all.to_owned(), See::Expand(None))
            } else {
                (fill(w().expand, &[&name]), See::Expand(Some(axes.pane)))
            };
            let icon = if is_alone { Icon::Panes } else { Icon::Expand };
            if widget::icon_button(&mut inner, icon, &text, true).clicked() {
                commands.push(Command::See(see));
            }
        }
    }

    /// True while it is asked what lies under the pointer or the crosshair.
    pub(crate) fn is_waiting(&self) -> bool {
        self.reading.is_some()
    }

    /// Position, value and segment under the pointer, else under the crosshair.
    fn readout_ui(
        &mut self,
        ui: &Ui,
        (places, hovered, cross): (&Places, Option<(Vec3, Rect)>, Vec3),
        session: &Session,
        facts: &SubjectFacts,
        picture: Option<&mut Picture>,
        commands: &mut Vec<Command>,
    ) {
        let first = places.slices.iter().flatten().next().copied();
        let Some((pos, rect)) = hovered.or(first.map(|rect| (cross, rect))) else {
            self.readout = None;
            self.reading = None;
            return;
        };
        if let Some(picture) = picture {
            if let Some((asked, reading)) = &mut self.reading {
                match reading.poll_now() {
                    Some(Ok(texels)) => {
                        self.read = texels.first().map(|texel| (*asked, *texel));
                        if asked.0 == cross {
                            let there = texels.first().filter(|texel| texel.is_there);
                            let read = there.map(|texel| (texel.pos_in_rest, texel.value));
                            commands.push(Command::See(See::ReadCross(read)));
                        }
                        self.reading = None;
                    }
                    Some(Err(_)) => self.reading = None,
                    None => ui.ctx().request_repaint(),
                }
            }
            let wanted = (pos, session.revision, session.view.subject_revision);
            let has_answer = self.read.is_some_and(|(asked, _)| asked == wanted);
            if self.reading.is_none() && !has_answer {
                // A question that cannot be asked yet is no reason for a message.
                let plane = SlicePlane {
                    corner: pos,
                    right: Vec3::ZERO,
                    down: Vec3::ZERO,
                };
                self.reading = picture
                    .read_slice(&plane, [1, 1])
                    .ok()
                    .map(|pending| (wanted, pending));
                if self.reading.is_some() {
                    ui.ctx().request_repaint();
                }
            }
        }
        let number = |v: f32, decimals: usize| widget::plain(f64::from(v), decimals);
        let list = |v: Vec3, decimals: usize| v.to_array().map(|c| number(c, decimals)).join(", ");
        let mut text = fill(w().mm, &[&list(facts.world_from_subject(pos), 1)]);
        if let Some((_, texel)) = self.read {
            text.push_str(" · ");
            if texel.is_there {
                let decimals = if texel.value.abs() >= 100.0 { 0 } else { 2 };
                text.push_str(&fill(w().value, &[&number(texel.value, decimals)]));
                if let Some(name) = texel.segment.and_then(|label| facts.segments.get(&label)) {
                    text.push_str(" · ");
                    text.push_str(name);
                }
            } else {
                text.push_str(w().nothing);
            }
        }
        let painter = ui.painter_at(rect);
        let galley = painter.layout(
            text,
            egui::FontId::proportional(12.0),
            Color32::WHITE,
            rect.width() - 24.0,
        );
        let corner = rect.left_bottom() + vec2(10.0, -galley.size().y - 8.0);
        let back = Rect::from_min_size(corner, galley.size()).expand2(vec2(6.0, 3.0));
        let response = ui.interact(back, ui.scope_id().with("slice readout"), Sense::empty());
        let label = galley.text().to_owned();
        response.widget_info(|| WidgetInfo::labeled(Role::Label, true, label.clone()));
        painter.rect_filled(back, 4.0, Color32::from_black_alpha(170));
        painter.galley(corner, galley, Color32::WHITE);
        if self.readout.replace(back) != Some(back) {
            ui.ctx().request_repaint();
        }
    }
}

impl PaneView {
    /// Zooms by a factor; the point of the slice under `at` stays there.
    fn zoom_about(&mut self, factor: f32, at: Pos2, map: &Map<'_>) {
        if !(factor.is_finite() && factor > 0.0) {
            return;
        }
        let before = self.zoom;
        self.zoom = (self.zoom * factor).clamp(0.5, 40.0);
        let to = (at - map.rect.center()) * map.units_per_point;
        self.pan += to * (1.0 - before / self.zoom);
    }
}

/// The box that slices are laid out for: the object, and what templates (but fields) draw out of it within reason.
fn shown_bounds(facts: &SubjectFacts, session: &Session) -> Aabb {
    let templates = &session.shown().templates;
    let deformed = deformed_bounds(templates, &Resources::default(), facts.bounds);
    let size = facts.bounds.max - facts.bounds.min;
    let limit = 0.15 * size.max_element();
    Aabb {
        min: deformed
            .min
            .clamp(facts.bounds.min - limit, facts.bounds.min),
        max: deformed
            .max
            .clamp(facts.bounds.max, facts.bounds.max + limit),
    }
}

/// The window for grey: the document's, else the preset's own.
fn grey_window(session: &Session, picture: &Picture) -> Option<[f32; 2]> {
    use crate::document::{Transfer, preset};
    use crate::render::{auto_preset, window_of};
    let info = picture.subject_info()?;
    let look = &session.shown().look;
    let name = match &look.transfer {
        Transfer::Preset(name) => name.as_str(),
        Transfer::Auto | Transfer::Points(_) => auto_preset(&session.illustration().subject, &info),
    };
    Some(window_of(look.window, preset(name)?, &info))
}

/// Out of the object, within the slice: where a template that is placed in a slice looks.
fn outwards(pos: Vec3, center: Vec3, axes: &Axes) -> Vec3 {
    let to = pos - center;
    (to - axes.normal * to.dot(axes.normal)).normalize_or(-axes.down)
}

/// The template whose dot is at a place; the selected one first.
fn template_at<'a>(at: Pos2, map: &Map<'_>, session: &'a Session) -> Option<&'a PlacedTemplate> {
    let templates = &session.shown().templates;
    let near = templates.iter().filter(|t| {
        let is_selected = session.selection.template() == Some(t.index);
        map.ui(t.placement.at).distance(at) <= REACH
            && (is_selected || !sections(map, t).is_empty())
    });
    near.max_by_key(|t| session.selection.template() == Some(t.index))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn zooming_keeps_what_is_under_the_pointer() {
        let map = Map {
            rect: Rect::from_min_size(pos2(0.0, 0.0), vec2(200.0, 100.0)),
            axes: &SLICES[1],
            middle: Vec3::new(0.1, 0.2, 0.3),
            units_per_point: 0.01,
        };
        let at = pos2(150.0, 20.0);
        let before = map.subject(at);
        let mut pane = PaneView::default();
        pane.zoom_about(2.0, at, &map);
        let after = Map {
            middle: map.middle + map.axes.right * pane.pan.x + map.axes.down * pane.pan.y,
            units_per_point: 0.005,
            ..map
        };
        assert!(after.subject(at).distance(before) < 1e-6);
    }
}
