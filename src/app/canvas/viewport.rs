//! The picture and what the hand does on it: turn, move, zoom, use a tool; over it the gizmo, the sides of the
//! patient and a few floating controls.

use egui::{
    Align2, Color32, Event, EventFilter, Key, PointerButton, Pos2, Rect, Response, Role, Sense,
    Shape, Stroke, Ui, Vec2, WidgetInfo, pos2, vec2,
};
use glam::Vec3;

use super::ball::{self, PictureBall};
use super::captions::Followed;
use super::figure::FigureCanvas;
use super::ghosts;
use super::gizmo::Gizmo;
use super::held::Held;
use super::measure::Distances;
use super::panes::ONE_PANE;
use super::projection::{self, Projection};
use super::shaping::{self, ShapingHand};
use super::tools::{asking_ui, bar_bottom, tools_ui};
use super::{
    curve, edge_sliders, mirrors, orientation, points, slice_plot, strokes, view_bar, ways,
};
use crate::app::kit::theme::{self, Palette};
use crate::app::kit::{slow_click, template_menu, widget};
use crate::app::picture::host::{Picture, found};
use crate::app::services::TextOver;
use crate::app::session::camera;
use crate::app::session::{Command, Gravity, Place, Question, Selection, Session, Tool};
use crate::app::words::picture::w;
use crate::app::words::{self, fill, in_sentence, kinds, messages, names};
use crate::displace::Holds;
use crate::document::{Background, Camera, PlacedTemplate, TemplateKind};
use crate::math::Placement;
use crate::render::{CaptionPlace, PendingPick, RenderError};

/// Radians per point of a drag.
const ORBIT_PER_POINT: f32 = 0.0075;
/// Seconds without a change after which the picture refines.
const REST_SECONDS: f64 = 0.18;
/// Seconds of GPU work per frame while something moves, and at rest.
const BUDGET_MOVING: f32 = 0.03;
const BUDGET_REST: f32 = 0.05;

/// How much of the untouched object is seen, of 255.
const GHOST_ALPHA: u8 = 84;
/// How much of an object is seen that is no longer the document's, of 255.
const EARLIER_ALPHA: u8 = 110;
/// Pixels of the picture at most. On a 4K screen it is drawn at about seven tenths of the screen's own resolution and
/// scaled up: nobody sees the difference in tissue, and it takes half as long.
pub(crate) const MAX_PICTURE_PIXELS: f32 = 4_200_000.0;

/// What of the picture lives from frame to frame.
#[derive(Default)]
pub(crate) struct Viewport {
    gizmo: Gizmo,
    /// Where the template being placed would lie.
    preview: Option<Placement>,
    /// Where the pointer was when the preview was asked for.
    preview_at: Option<Pos2>,
    /// The answer about the place under the pointer, on its way.
    preview_pick: Option<PendingPick>,
    /// Questions of the session that wait for the next frame.
    questions: Vec<Question>,
    /// Until when the picture counts as moving, seconds on the clock of the interface.
    moving_until: f64,
    last_camera: Option<Camera>,
    last_revision: u64,
    /// Rectangle of the last frame, points.
    rect: Option<Rect>,
    /// Identity of the picture as a widget.
    id: Option<egui::Id>,
    /// The picture could not be drawn; a message told so.
    has_failed: bool,
    captions: Followed,
    ball: PictureBall,
    figure: FigureCanvas,
    shaping: ShapingHand,
    /// The picture still shows another object than the document's, and is drawn faintly.
    pub(crate) is_earlier: bool,
}

/// True if a double click on the picture adds a place to the template.
fn takes_places(template: &PlacedTemplate) -> bool {
    matches!(template.kind.facts().holds, Holds::Points | Holds::Tools)
}

/// True if another click would add a place to the selected template: within its box, or on a way of its tools. The
/// first one does not put it away then.
fn may_add(view: &Projection, response: &Response, session: &Session) -> bool {
    let template = session.selected_template().filter(|t| takes_places(t));
    let Some((template, pos)) = template.zip(response.interact_pointer_pos()) else {
        return false;
    };
    if template.kind.facts().holds == Holds::Tools {
        return ways::is_near(view, template, pos);
    }
    let place = view.on_plane(pos, template.placement.at, view.back());
    let place = place.map(|pos| template.template_from_subject(pos));
    place.is_some_and(|q| q.cmpge(Vec3::ZERO).all() && q.cmple(Vec3::ONE).all())
}

impl Viewport {
    /// Size of the picture in pixels as it was last shown.
    pub(crate) fn size_px(&self, pixels_per_point: f32) -> [u32; 2] {
        self.rect
            .map_or([1024, 768], |rect| size_px(rect, pixels_per_point))
    }

    /// Where each caption of the document is.
    pub(crate) fn caption_places(&self) -> Vec<CaptionPlace> {
        self.captions.places()
    }

    /// The surroundings show the texts of captions, with `show`: see [`Followed::show_outside`].
    pub(crate) fn show_outside(
        &mut self,
        show: impl FnOnce(&[TextOver]) -> Vec<egui::Vec2>,
    ) -> bool {
        self.captions.show_outside(show)
    }

    /// Takes a question of the session, to be asked in the next frame.
    pub(crate) fn take_question(&mut self, question: Question) {
        self.questions.push(question);
    }

    /// True while questions to the picture are open.
    pub(crate) fn is_waiting(&self) -> bool {
        !self.questions.is_empty()
            || self.preview_pick.is_some()
            || self.captions.is_waiting()
            || self.ball.is_waiting()
            || self.shaping.is_waiting()
    }

    /// Identity of the picture as a widget, once it has been shown.
    pub(crate) fn id(&self) -> Option<egui::Id> {
        self.id
    }

    /// Draws the picture and everything on it into a part of the window; none: only slices are seen.
    pub(crate) fn ui(
        &mut self,
        ui: &mut Ui,
        rect: Option<Rect>,
        session: &Session,
        picture: Option<&mut Picture>,
        commands: &mut Vec<Command>,
    ) {
        let Some(rect) = rect else {
            self.unseen_ui(ui, session, picture);
            return;
        };
        let bars = rect;
        let bar = bar_bottom(bars, session);
        // Where there is little room the bar lies above the picture, else over its head.
        let rect = match bar {
            Some(bar) if bars.width() < ONE_PANE => {
                let rect = bars.with_min_y(bar + 6.0);
                ui.painter()
                    .rect_filled(bars.with_max_y(rect.top()), 0.0, Palette::get(ui).panel);
                rect
            }
            _ => bars,
        };
        let id = ui.scope_id().with("picture");
        let response = ui.interact(rect, id, Sense::click_and_drag());
        ui.advance_cursor_after_rect(rect);
        self.rect = Some(rect);
        self.id = Some(id);
        self.announce(&response, session);

        self.shaping.hear(ui, session);
        let camera = self.gestures(
            ui,
            &response,
            &Projection::new(&session.camera, rect),
            session,
        );
        if camera != session.camera {
            commands.push(Command::MoveCamera(camera));
        }
        let view = Projection::new(&camera, rect);

        let background = background_color(session, ui);
        paint_background(ui, rect, session.shown().look.background, background);
        self.picture_ui(ui, (&response, &view), session, &camera, picture, commands);

        let painter = ui.painter_at(rect);
        let letters = if is_dark(background) {
            Color32::from_white_alpha(170)
        } else {
            Color32::from_black_alpha(150)
        };
        let free = match bar {
            Some(bar) if bars == rect => rect.with_min_y(bar + 2.0),
            _ => rect,
        };
        let free = if rect.height() < view_bar::LOW {
            free.with_max_y(rect.bottom() - theme::control_height() - 18.0)
        } else {
            free
        };
        // A figure is seen from its front: no side of a patient is left or right of it.
        if !session.view.is_figure() {
            orientation::edges_ui(&painter, &view, letters, free);
        }
        // Left of the buttons, where these have a column of their own.
        let foot = free.right_bottom() - vec2(view_bar::column_width(rect) + 14.0, 14.0);
        orientation::bar_ui(&painter, session, rect, letters, foot);
        let texts = edge_sliders::beside(free, session);
        self.captions.ui(ui, &view, texts, session, commands);

        match session.tool() {
            Tool::Place(TemplateKind::Sweep) => {
                self.gizmo.release();
                mirrors::paint(ui, &view, session);
                self.shaping.paint(ui, &view, session);
                shaping::bar_ui(ui, bars, session, commands);
                shaping::what_to_do_ui(ui, free);
            }
            Tool::Place(kind) => {
                let name = in_sentence(kinds::title(kind));
                let texts = [w().tap_where, w().click_where].map(|text| fill(text, &[&name]));
                self.placing_ui(ui, bars, &view, &texts, commands);
            }
            Tool::Caption => {
                self.gizmo.release();
                let words = words::captions::w();
                let texts = [words.tap_where, words.click_where];
                asking_ui(ui, bars, texts, words.cancel, commands);
            }
            Tool::Paint { erases, .. } => {
                self.gizmo.release();
                self.ball.paint(ui, &response, &view, session);
                ball::bar_ui(ui, bars, session, erases, commands);
            }
            Tool::Clay => {
                mirrors::paint(ui, &view, session);
                if !self.gizmo.is_hot() {
                    self.shaping.paint(ui, &view, session);
                }
                ghosts::ui(ui, &view, session, commands);
                match Held::of_tool(session) {
                    Some(held) => {
                        commands.extend(self.gizmo.ui(ui, &response, &view, held, session));
                    }
                    None => self.gizmo.release(),
                }
                shaping::bar_ui(ui, bars, session, commands);
            }
            Tool::Look | Tool::Figure(_) if session.view.is_figure() => {
                self.gizmo.release();
                self.figure
                    .ui(ui, (&response, bars), &view, session, commands);
            }
            Tool::Look | Tool::Seed(_) | Tool::Measure(_) | Tool::Level | Tool::Figure(_) => {
                self.templates_ui(ui, (&response, bars), &view, session, commands);
            }
        }
        let selects = matches!(session.tool(), Tool::Look | Tool::Seed(_) | Tool::Level);
        if response.clicked()
            && selects
            && !self.gizmo.is_hot()
            && session.selection != Selection::Nothing
            && !may_add(&view, &response, session)
        {
            commands.push(Command::Select(None));
        }
        self.seen_ui(ui, rect, &view, session, commands);
        if session.tool().placing().is_none()
            && session.tool().ball().is_none()
            && session.tool() != Tool::Clay
            && !session.view.is_figure()
        {
            // The right button or a long press. A finger that opened the menu no longer drags a handle.
            let menu = response.context_menu(|ui| template_menu::ui(ui, session, commands));
            if menu.is_some() {
                self.gizmo.release();
            }
        }
        edge_sliders::ui(ui, free, &view, session, commands);
        view_bar::corner_ui(ui, rect, &view, session, commands);
        if response.has_focus() {
            widget::focus_ring(ui, &response, rect.shrink(1.0));
        }
    }

    /// Markers of all templates, and the handles of the selected one.
    fn templates_ui(
        &mut self,
        ui: &mut Ui,
        (response, bars): (&Response, Rect),
        view: &Projection,
        session: &Session,
        commands: &mut Vec<Command>,
    ) {
        self.markers_ui(ui, view, session, commands);
        if strokes::ui(ui, view, session, commands) {
            self.gizmo.release();
        }
        let object = session.selected_object();
        if let Some(object) = object.and_then(|object| session.placed_object(object)) {
            let held = Held::Object(&object);
            commands.extend(self.gizmo.ui(ui, response, view, held, session));
            let is_enabled = session
                .selected_object()
                .is_some_and(|object| object.enabled);
            return tools_ui(ui, bars, session, is_enabled, commands);
        }
        let Some(template) = session.selected_template() else {
            self.gizmo.release();
            return;
        };
        let asked = ui.input(|i| i.pointer.latest_pos());
        let asked = asked.filter(|_| response.double_clicked());
        let is_point = points::ui(ui, view, template, asked, commands);
        let is_key = ways::ui(ui, view, (template, &session.view.grids), asked, commands);
        if curve::ui(ui, view, template, commands) || is_point || is_key {
            self.gizmo.release();
        } else {
            let held = Held::Template(template);
            commands.extend(self.gizmo.ui(ui, response, view, held, session));
        }
        tools_ui(ui, bars, session, template.enabled, commands);
    }

    fn announce(&self, response: &Response, session: &Session) {
        let title = &session.illustration().title;
        let subject = names::subject_title(session.illustration());
        response.widget_info(|| {
            let name = if title.is_empty() {
                fill(w().picture_of, &[&in_sentence(&subject)])
            } else {
                fill(w().picture_named, &[title])
            };
            WidgetInfo::labeled(Role::Image, true, name)
        });
        // The arrows turn the object while the picture has the keyboard; they do not move on to the next control.
        response.ctx.memory_mut(|memory| {
            let filter = EventFilter {
                tab: false,
                horizontal_arrows: true,
                vertical_arrows: true,
                escape: true,
            };
            memory.set_focus_lock_filter(response.id, filter);
        });
    }

    /// Turning, moving and zooming: the camera as the hand leaves it.
    fn gestures(
        &mut self,
        ui: &Ui,
        response: &Response,
        view: &Projection,
        session: &Session,
    ) -> Camera {
        let mut camera = session.camera;
        let is_painting = FigureCanvas::takes_drags(session, ui)
            || self.shaping.takes_drags(session, ui, response)
            || session.tool().ball().is_some()
                && ui.input(|i| !i.pointer.secondary_down() && !i.pointer.middle_down());
        let touch = ui
            .input(|i| i.multi_touch())
            .filter(|touch| view.rect.contains(touch.center_pos) && !self.shaping.has_palm());
        if let Some(touch) = touch {
            camera::zoom(&mut camera, touch.zoom_delta);
            projection::pan(&mut camera, view, touch.translation_delta);
            if session.view.is_figure() {
                camera::roll(&mut camera, touch.rotation_delta);
            }
        } else if response.dragged()
            && !self.gizmo.is_held()
            && !is_painting
            && response.drag_delta() != Vec2::ZERO
        {
            let delta = response.drag_delta();
            let shift = ui.input(|i| i.modifiers.shift);
            let is_pan = shift
                || response.dragged_by(PointerButton::Secondary)
                || response.dragged_by(PointerButton::Middle);
            let is_roll = !is_pan && ui.input(|i| i.modifiers.alt);
            if is_roll {
                camera::roll(&mut camera, delta.x * ORBIT_PER_POINT);
            } else if is_pan || session.view.is_figure() {
                // A figure is flat, and nothing is to be seen from its sides.
                projection::pan(&mut camera, view, delta);
            } else {
                orbit(&mut camera, delta);
            }
        }
        let turned = self.shaping.take_turned();
        if turned != Vec2::ZERO {
            orbit(&mut camera, turned);
        }
        let is_free = touch.is_none() && !self.shaping.takes_wheel(session, ui);
        if response.contains_pointer() && is_free {
            let (wheel, pinch) = ui.input(|i| (i.smooth_scroll_delta().y, i.zoom_delta()));
            if wheel != 0.0 {
                camera::zoom(&mut camera, (wheel * projection::ZOOM_PER_POINT).exp());
            } else if pinch != 1.0 {
                camera::zoom(&mut camera, pinch);
            }
        }
        if response.clicked() {
            // Keys go to the picture from now on, without a ring around a control that was only clicked.
            ui.memory_mut(|memory| {
                if let Some(focused) = memory.focused() {
                    memory.surrender_focus(focused);
                }
            });
        }
        if camera != session.camera {
            ui.ctx().request_repaint();
        }
        camera
    }

    /// The picture itself, and the questions about it.
    fn picture_ui(
        &mut self,
        ui: &mut Ui,
        (response, view): (&Response, &Projection),
        session: &Session,
        camera: &Camera,
        picture: Option<&mut Picture>,
        commands: &mut Vec<Command>,
    ) {
        let rect = view.rect;
        let Some(picture) = picture else {
            let text = w().no_device;
            ui.painter().text(
                rect.center(),
                Align2::CENTER_CENTER,
                text,
                theme::strong_font(14.0),
                Palette::get(ui).weak,
            );
            return;
        };
        let now = session.now;
        let is_changed =
            self.last_camera != Some(*camera) || self.last_revision != session.revision;
        if is_changed {
            self.last_camera = Some(*camera);
            self.last_revision = session.revision;
            self.moving_until = now + REST_SECONDS;
            set_seen(picture, session, camera);
        }
        if ui.input(|i| i.events.iter().any(is_done_by_hand)) {
            // The control that was meant answers first.
            self.moving_until = self.moving_until.max(now + REST_SECONDS);
            picture.hold();
        }
        let is_moving = now < self.moving_until;
        let size = size_px(rect, ui.pixels_per_point());
        let budget = if is_moving {
            BUDGET_MOVING
        } else {
            BUDGET_REST
        };
        match picture.draw(size, budget, is_moving) {
            Ok(texture) => {
                self.has_failed = false;
                if let Some(texture) = texture {
                    let uv = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
                    let tint = match self.is_earlier {
                        true => Color32::from_white_alpha(EARLIER_ALPHA),
                        false => Color32::WHITE,
                    };
                    ui.painter().image(texture, rect, uv, tint);
                }
            }
            Err(error) => {
                if !self.has_failed {
                    commands.push(tell(Gravity::Error, messages::w().cannot_draw, &error));
                }
                self.has_failed = true;
            }
        }
        self.ghost_ui(
            ui,
            rect,
            (session, camera),
            picture,
            (size, budget, is_moving),
        );
        let goes_on = !picture.state.is_done && !picture.state.is_held && !self.has_failed;
        if goes_on && !picture.repaint_when_done(ui.ctx()) {
            ui.ctx().request_repaint();
        } else if is_moving {
            let rest = (self.moving_until - now).max(0.0) + 0.01;
            ui.ctx()
                .request_repaint_after(std::time::Duration::from_secs_f64(rest));
        }
        if !picture.state.is_done && !is_moving && picture.state.has_picture {
            paint_progress(ui, rect, picture.state.progress);
        }
        self.click(ui, response, session, picture, size, commands);
        let hand = self
            .ball
            .ui(ui, response, session, (picture, size), commands);
        self.questions.extend(hand);
        let hands = (response, view);
        self.shaping
            .ui(ui, hands, session, (picture, size), commands);
        self.ask(session, camera, picture, size, commands);
        self.captions
            .update(ui.ctx(), session, camera, picture, size);
        if picture.is_waiting() || self.is_waiting() {
            ui.ctx().request_repaint();
        }
    }

    /// The untouched object faintly over the picture: where nothing moved, it changes nothing.
    fn ghost_ui(
        &self,
        ui: &Ui,
        rect: Rect,
        (session, camera): (&Session, &Camera),
        picture: &mut Picture,
        (size, budget, is_moving): ([u32; 2], f32, bool),
    ) {
        let shown = session.shown();
        if !session.view.has_ghost || shown.templates.iter().all(|t| !t.acting().enabled) {
            picture.drop_ghost();
            return;
        }
        if self.has_failed || !picture.state.has_picture {
            return;
        }
        // The picture reports a failure of the same device.
        let drawn = picture.draw_ghost(shown, camera, size, (budget, is_moving));
        if let Ok(Some(texture)) = drawn {
            let uv = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
            let tint = Color32::from_white_alpha(GHOST_ALPHA);
            ui.painter().image(texture, rect, uv, tint);
        }
    }

    /// What a click on the picture does with the active tool, and the preview of a template before the click.
    fn click(
        &mut self,
        ui: &Ui,
        response: &Response,
        session: &Session,
        picture: &mut Picture,
        size: [u32; 2],
        commands: &mut Vec<Command>,
    ) {
        let pixel = projection::pixels_of(response.rect, size);
        let clicked = response.interact_pointer_pos().map(&pixel);
        // The tool of a sweep is seen where it would act.
        let placed = session.tool().placing().filter(|_| !session.has_hand());
        if let Some(kind) = placed {
            if let Some(pick) = &mut self.preview_pick {
                match pick.poll_now() {
                    Some(Ok(pick)) => {
                        let placement = |pick| session.placement_on(kind, &found(pick));
                        self.preview = pick.map(placement);
                        self.preview_pick = None;
                    }
                    Some(Err(_)) => self.preview_pick = None,
                    None => ui.ctx().request_repaint(),
                }
            }
            if let Some(pos) = response.hover_pos()
                && self.preview_at != Some(pos)
                && !response.clicked()
                && !response.dragged()
                && self.preview_pick.is_none()
            {
                self.preview_at = Some(pos);
                // A preview that cannot be found is no reason for a message.
                self.preview_pick = picture.pick(pixel(pos), size).ok();
            }
        } else {
            self.preview = None;
            self.preview_pick = None;
        }
        let is_free =
            !session.selected_template().is_some_and(takes_places) && !self.gizmo.is_hot();
        match clicked {
            Some(_) if session.tool().adds_up() && response.clicked() => {
                let places = slow_click::places(ui, response).into_iter();
                commands.extend(places.map(|pos| Command::UseToolAt(pixel(pos))));
            }
            Some(at)
                if session.tool() != Tool::Look && response.clicked() && !self.gizmo.is_hot() =>
            {
                commands.push(Command::UseToolAt(at));
            }
            Some(at) if session.tool() == Tool::Look && response.double_clicked() && is_free => {
                commands.push(Command::LookAtPixel(at));
            }
            // Without objects a click on the picture selects nothing, and nothing has to be asked.
            Some(at)
                if session.tool() == Tool::Look
                    && response.clicked()
                    && !self.gizmo.is_hot()
                    && !session.shown().objects.is_empty() =>
            {
                commands.push(Command::SelectAt(at));
            }
            _ => {}
        }
    }

    /// Asks the picture what the session wants to know, and passes on the commands that answers have become.
    fn ask(
        &mut self,
        session: &Session,
        camera: &Camera,
        picture: &mut Picture,
        size: [u32; 2],
        commands: &mut Vec<Command>,
    ) {
        let mut is_beside = false;
        for question in std::mem::take(&mut self.questions) {
            is_beside |= matches!(question.place, Place::Beside(..));
            if let Err(error) = picture.ask(question, size) {
                commands.push(tell(Gravity::Info, messages::w().nothing_to_click, &error));
            }
        }
        if is_beside {
            // The picture's own view is back.
            set_seen(picture, session, camera);
            self.moving_until = session.now + REST_SECONDS;
        }
        for answer in picture.answers() {
            commands.push(match answer {
                Ok(command) => command,
                Err(error) => tell(Gravity::Error, messages::w().point_not_found, &error),
            });
        }
    }

    /// The interface while a template is being placed.
    fn placing_ui(
        &mut self,
        ui: &mut Ui,
        rect: Rect,
        view: &Projection,
        texts: &[String; 2],
        commands: &mut Vec<Command>,
    ) {
        self.gizmo.release();
        if let Some(preview) = &self.preview {
            paint_preview(ui, view.rect, view, preview);
        }
        asking_ui(
            ui,
            rect,
            [&texts[0], &texts[1]],
            w().cancel_placing,
            commands,
        );
    }

    /// A dot for each template and object that is not selected; a click selects it.
    fn markers_ui(
        &mut self,
        ui: &Ui,
        view: &Projection,
        session: &Session,
        commands: &mut Vec<Command>,
    ) {
        if self.gizmo.is_held() {
            return;
        }
        for template in &session.shown().templates {
            if session.selection != Selection::Template(template.index) {
                let name = names::template_title(template);
                let id = ("marker", template.index);
                if marker_ui(
                    ui,
                    view,
                    (template.placement.at, template.enabled),
                    &name,
                    id,
                ) {
                    commands.push(Command::Select(Some(template.index)));
                }
            }
        }
        for object in &session.shown().objects {
            let placed = session.placed_object(object);
            if session.selection != Selection::Object(object.index)
                && let Some(placed) = placed
            {
                let id = ("object", object.index);
                let at = (placed.placement.at, object.enabled);
                if marker_ui(ui, view, at, &object.name, id) {
                    commands.push(Command::SelectObject(Some(object.index)));
                }
            }
        }
    }

    /// The crosshair of the slices and the distances, over the picture.
    fn seen_ui(
        &self,
        ui: &mut Ui,
        rect: Rect,
        view: &Projection,
        session: &Session,
        commands: &mut Vec<Command>,
    ) {
        let painter = ui.painter_at(rect);
        slice_plot::mark_in_picture(&painter, view, &session.view);
        let distances = Distances::of(session);
        if let Some(mm_per_unit) = session.view.mm_per_unit() {
            distances.paint(
                &painter,
                mm_per_unit,
                |pos| view.ui_from_subject(pos),
                |_| 1.0,
            );
        }
        if session.tool().is_measuring() {
            ui.ctx().set_cursor_icon(egui::CursorIcon::Crosshair);
        }
        let corner = rect.left_top() + vec2(8.0, 60.0);
        let room = rect.size() - vec2(16.0, 200.0);
        distances.list_ui(ui, corner, room, &session.view, commands);
    }

    /// The picture is not seen: what slices need of it goes on.
    fn unseen_ui(&mut self, ui: &Ui, session: &Session, picture: Option<&mut Picture>) {
        let Some(picture) = picture else {
            return;
        };
        picture.set(session.shown(), &session.camera);
        self.last_camera = None;
        // A failure is reported once the picture is seen again.
        _ = picture.draw([64, 64], BUDGET_REST, false);
        if !picture.state.is_done && !picture.repaint_when_done(ui.ctx()) {
            ui.ctx().request_repaint();
        }
    }
}

/// Somebody presses, lets go, types or scrolls. Moving the pointer alone does nothing that has to be answered at once.
fn is_done_by_hand(event: &Event) -> bool {
    matches!(
        event,
        Event::PointerButton { .. }
            | Event::Key { .. }
            | Event::Text(_)
            | Event::MouseWheel { .. }
            | Event::Touch { .. }
    )
}

/// The command that shows a message about a failure.
fn tell(gravity: Gravity, message: &str, error: &RenderError) -> Command {
    Command::Notify(gravity, message.to_owned(), error.to_string())
}

/// Size of the picture in a rectangle, pixels: those of the screen up to [`MAX_PICTURE_PIXELS`], at least one by one.
fn size_px(rect: Rect, pixels_per_point: f32) -> [u32; 2] {
    let area = rect.area() * pixels_per_point * pixels_per_point;
    let cap = (MAX_PICTURE_PIXELS / area.max(1.0)).sqrt().min(1.0);
    [rect.width(), rect.height()]
        .map(|side| (side * pixels_per_point * cap).round().clamp(1.0, 8192.0) as u32)
}

fn background_color(session: &Session, ui: &Ui) -> Color32 {
    match session.shown().look.background {
        Background::Color([r, g, b]) => Color32::from_rgb(r, g, b),
        Background::None => Palette::get(ui).raised,
    }
}

fn is_dark(color: Color32) -> bool {
    color.intensity() < 0.45
}

/// The document's background under the picture, so that nothing flashes while there is none; a chequered one for none.
fn paint_background(ui: &Ui, rect: Rect, background: Background, color: Color32) {
    ui.painter().rect_filled(rect, 0.0, color);
    if background == Background::None {
        const SIDE: f32 = 12.0;
        let painter = ui.painter_at(rect);
        let other = Palette::get(ui).hover;
        let (columns, rows) = (
            (rect.width() / SIDE).ceil() as u32,
            (rect.height() / SIDE).ceil() as u32,
        );
        for y in 0..rows {
            for x in (y % 2..columns).step_by(2) {
                let min = rect.min + vec2(x as f32, y as f32) * SIDE;
                painter.rect_filled(Rect::from_min_size(min, Vec2::splat(SIDE)), 0.0, other);
            }
        }
    }
}

/// A thin line along the top while the picture refines.
fn paint_progress(ui: &Ui, rect: Rect, progress: f32) {
    let width = rect.width() * progress.clamp(0.0, 1.0);
    let line = Rect::from_min_size(rect.left_bottom() - vec2(0.0, 2.0), vec2(width, 2.0));
    ui.painter()
        .rect_filled(line, 0.0, Palette::get(ui).accent.gamma_multiply(0.6));
}

/// The box of the template that would be placed.
/// A dot at a place, paler if what it stands for is not enabled. True if it was clicked.
fn marker_ui(
    ui: &Ui,
    view: &Projection,
    (place, is_enabled): (Vec3, bool),
    name: &str,
    id: (&str, usize),
) -> bool {
    let at = view.ui_from_subject(place);
    let Some(at) = at.filter(|at| view.rect.contains(*at)) else {
        return false;
    };
    let side = if theme::is_touch() { 40.0 } else { 26.0 };
    let hit = Rect::from_center_size(at, Vec2::splat(side));
    let response = ui.interact(hit, ui.scope_id().with(id), Sense::click());
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, fill(w().select, &[&name])));
    let is_hot = response.hovered() || response.has_focus();
    let fade = if is_enabled { 1.0 } else { 0.5 };
    let painter = ui.painter_at(view.rect);
    let dot = |radius: [f32; 2], color: Color32| {
        let radius = if is_hot { radius[1] } else { radius[0] };
        painter.circle_filled(at, radius, color.gamma_multiply(fade));
    };
    dot([7.0, 9.0], theme::over_picture::HALO_DARK);
    dot([5.5, 7.5], Color32::WHITE);
    dot([3.2, 5.0], Palette::get(ui).accent);
    response.on_hover_text(name).clicked()
}

fn paint_preview(ui: &Ui, rect: Rect, view: &Projection, placement: &Placement) {
    let painter = ui.painter_at(rect);
    let corner = |bits: usize| {
        let pick = |bit: usize| if bits & bit == 0 { 0.0 } else { 1.0 };
        view.ui_from_subject(placement.subject_from_template(Vec3::new(pick(1), pick(2), pick(4))))
    };
    for axis in 0..3_usize {
        for bits in (0..8_usize).filter(|bits| bits & (1 << axis) == 0) {
            if let (Some(a), Some(b)) = (corner(bits), corner(bits | (1 << axis))) {
                painter.line_segment(
                    [a, b],
                    Stroke::new(3.0, theme::over_picture::HALO_LIGHT.gamma_multiply(0.5)),
                );
                painter.extend(Shape::dashed_line(
                    &[a, b],
                    Stroke::new(1.3, theme::over_picture::BOX),
                    5.0,
                    3.0,
                ));
            }
        }
    }
    let (base, tip) = (
        placement.at,
        placement.subject_from_template(Vec3::new(0.5, 0.5, 1.25)),
    );
    if let (Some(a), Some(b)) = (view.ui_from_subject(base), view.ui_from_subject(tip)) {
        painter.line_segment([a, b], Stroke::new(2.0, theme::over_picture::Z));
        painter.circle_filled(b, 3.5, theme::over_picture::Z);
    }
}

/// Hands the illustration to the picture: as the document has it, or as the work on tissues wants it seen.
fn set_seen(picture: &mut Picture, session: &Session, camera: &Camera) {
    match session.seen() {
        Some(seen) => picture.set(&seen, camera),
        None => picture.set(session.shown(), camera),
    }
}

/// True if the picture or nothing has the keyboard, so that arrows turn the object.
pub(crate) fn has_arrows(ui: &Ui, picture_id: egui::Id) -> bool {
    ui.memory(|memory| memory.focused().is_none_or(|id| id == picture_id))
}

/// Keys that a focused control uses itself.
pub(crate) fn is_widget_key(key: Key) -> bool {
    matches!(
        key,
        Key::ArrowLeft | Key::ArrowRight | Key::ArrowUp | Key::ArrowDown | Key::Enter | Key::Space
    )
}

/// Files that were dropped on the window in this frame.
pub(crate) fn dropped(ui: &Ui) -> Vec<egui::DroppedFileHandle> {
    ui.input(|i| i.raw.dropped_files.clone())
}

/// Text that was pasted and is not meant for a text field.
pub(crate) fn pasted(ui: &Ui) -> Option<String> {
    if ui.ctx().egui_wants_keyboard_input() {
        return None;
    }
    ui.input(|i| {
        i.events.iter().find_map(|event| match event {
            Event::Paste(text) => Some(text.clone()),
            _ => None,
        })
    })
}

/// Turns the view by so many points of a drag.
fn orbit(camera: &mut Camera, by: Vec2) {
    let turn = by * ORBIT_PER_POINT;
    camera::orbit(camera, glam::vec2(turn.x, turn.y));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_large_screen_does_not_make_the_picture_larger() {
        let rect = Rect::from_min_size(Pos2::ZERO, vec2(1920.0, 1080.0));
        assert_eq!(
            size_px(rect, 1.0),
            [1920, 1080],
            "as many as the screen has"
        );
        let [width, height] = size_px(rect, 2.0);
        assert!(
            (width * height) as f32 <= 1.001 * MAX_PICTURE_PIXELS,
            "capped on 4K"
        );
        assert!(
            (width as f32 / height as f32 - 16.0 / 9.0).abs() < 0.01,
            "in its proportions"
        );
        let phone = Rect::from_min_size(Pos2::ZERO, vec2(360.0, 640.0));
        assert_eq!(size_px(phone, 3.0), [1080, 1920], "a phone keeps its own");
    }
}
