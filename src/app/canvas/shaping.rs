//! The hand that shapes a clay or draws a sweep over the picture: the tool where it would act and as held keys fit it,
//! the drag under way, and the bar that holds the tool.

use egui::{CursorIcon, PointerButton, Pos2, Rect, Response, Shape, Stroke, Ui, Vec2, pos2, vec2};
use glam::{Quat, Vec3};

use super::fitting::{Fits, Fitting};
use super::outline::{images, paint_outline, placed_outline, seen};
use super::pen::Pen;
use super::projection::{Projection, pixels_of};
use super::tools::{gizmo_name, head_bar};
use super::ways::paint_way;
use crate::app::kit::clay_tool::{forms_ui, held_title, own_forms, way_title};
use crate::app::kit::icon::Icon;
use crate::app::kit::theme::{self, Palette, over_picture as ink};
use crate::app::kit::widget::{self, Named as _};
use crate::app::picture::host::Picture;
use crate::app::session::{
    ClayCommand, Command, GizmoMode, HandCommand, HeldTool, Session, StrokeWay, Touch,
};
use crate::app::words::clay::w;
use crate::app::words::{fill, picture, sweep};
use crate::document::{TemplateData, ToolShape};
use crate::math::Similarity;
use crate::render::{PendingPick, Pick};

/// Points by which a hand moves at least from one place of its way to the next.
const STEP: f32 = 3.0;
/// Width of the bar, points.
const BAR: f32 = 464.0;
/// Below this width the bar leaves out what the panel has too.
const NARROW: f32 = 420.0;

/// What the hand does.
#[derive(Default)]
enum Hand {
    /// Nothing, or it turns the view: where the last drag began there was nothing to move.
    #[default]
    Free,
    /// It is pressed, and what is under it is being asked for.
    Pressed(PendingPick),
    /// The picture could not be asked yet.
    Waits,
    /// It draws, with the places that it has touched so far.
    Draws(Vec<Touch>),
    /// It is pressed and does nothing until it lets go: the tool was being fitted, or it is a palm.
    Rests,
}

/// The hand with the tool, over the picture.
#[derive(Default)]
pub(crate) struct ShapingHand {
    hand: Hand,
    way: StrokeWay,
    /// Where the hand was, points of the window.
    spots: Vec<Pos2>,
    /// The surface was asked for under as many of these.
    asked: usize,
    /// The session has heard of this way, of as many touches, and of the last of them.
    told: Option<(StrokeWay, usize, Touch)>,
    is_over: bool,
    /// Its way is kept to one axis of the picture.
    is_straight: bool,
    pen: Pen,
    /// How hard the pen pressed when the drag began.
    force: Option<f32>,
    has_palm: bool,
    /// What turns the view still.
    turned: Vec2,
    /// A held key fits the tool.
    fitting: Option<Fitting>,
    /// The wheel that turned for this has not come to rest yet.
    is_wheel_turning: bool,
    /// What is under the pointer, on its way, where the pointer was when it was asked for, and the last answer.
    pick: Option<PendingPick>,
    asked_at: Option<Pos2>,
    under: Option<Touch>,
}

impl ShapingHand {
    /// Hears of touches, before anything is made of them in this frame.
    pub(crate) fn hear(&mut self, ui: &Ui, session: &Session) {
        ui.input(|i| self.pen.hear(&i.events, session.pen, session.now));
        self.has_palm = session.has_hand() && self.pen.has_palm(session.now);
    }

    /// True if touches are no gesture of two fingers: one of them is a palm beside a pen.
    pub(crate) fn has_palm(&self) -> bool {
        self.has_palm
    }

    /// True if a drag on the picture shapes, and turns nothing. In its first frame nobody knows yet what is under it.
    pub(crate) fn takes_drags(&self, session: &Session, ui: &Ui, response: &Response) -> bool {
        let begins = || response.drag_started_by(PointerButton::Primary);
        let is_taken = draws(session) && self.is_plain(ui);
        is_taken && (!matches!(self.hand, Hand::Free) || begins())
    }

    /// The way of a drag beside the clay while nobody knew yet what was under it, points; told once.
    pub(crate) fn take_turned(&mut self) -> Vec2 {
        std::mem::take(&mut self.turned)
    }

    /// True if the wheel fits the tool, and zooms nothing.
    pub(crate) fn takes_wheel(&self, session: &Session, ui: &Ui) -> bool {
        let is_fitted = || self.may_fit() && Fits::held(ui).is_some();
        session.has_hand() && (self.is_wheel_turning || is_fitted())
    }

    /// One finger, a pen or the first button, alone: a palm does not count.
    fn is_plain(&self, ui: &Ui) -> bool {
        let is_alone = ui.input(|i| {
            let pointer = &i.pointer;
            !pointer.secondary_down() && !pointer.middle_down() && i.multi_touch().is_none()
        });
        is_alone || self.has_palm
    }

    /// True if no stroke is under way.
    fn may_fit(&self) -> bool {
        matches!(self.hand, Hand::Free | Hand::Rests)
    }

    /// True while the picture has to answer.
    pub(crate) fn is_waiting(&self) -> bool {
        self.pick.is_some() || matches!(self.hand, Hand::Pressed(_) | Hand::Waits)
    }

    /// What the hand does in this frame.
    pub(crate) fn ui(
        &mut self,
        ui: &Ui,
        (response, view): (&Response, &Projection),
        session: &Session,
        (picture, size): (&mut Picture, [u32; 2]),
        commands: &mut Vec<Command>,
    ) {
        if !session.has_hand() {
            let pen = std::mem::take(&mut self.pen);
            *self = Self {
                pen,
                ..Self::default()
            };
            return;
        }
        let is_fitted = self.fit(ui, (response, view), session, commands);
        let pixel = pixels_of(view.rect, size);
        let ask = |picture: &mut Picture, pos: Pos2| picture.pick(pixel(pos), size).ok();
        if let Some(answer) = self.pick.as_mut().and_then(PendingPick::poll_now) {
            self.pick = None;
            // The outline of a tool that is being fitted stays where it is.
            if !is_fitted || self.under.is_none() {
                self.under = answer.ok().flatten().and_then(|pick| touch(&pick, view));
            }
            self.follow();
        }
        let is_plain = draws(session) && self.is_plain(ui);
        let begins = response.drag_started_by(PointerButton::Primary) && is_plain;
        if begins && (is_fitted || self.pen.is_palm_pointing(session.now)) {
            self.hand = Hand::Rests;
        } else if begins {
            let begin = ui.input(|i| (i.pointer.press_origin(), i.modifiers.shift));
            let way = session.hand().way;
            let smooths = begin.1 && way != StrokeWay::Form && !session.is_sweeping();
            self.way = if smooths { StrokeWay::Smooth } else { way };
            (self.asked, self.told) = (0, None);
            (self.is_over, self.is_straight) = (false, false);
            self.force = self.pen.force();
            self.spots = begin.0.into_iter().collect();
            self.hand = Hand::Waits;
        }
        if matches!(self.hand, Hand::Rests) && !response.dragged_by(PointerButton::Primary) {
            self.hand = Hand::Free;
        }
        if self.may_fit() {
            if !is_fitted {
                self.hover(response, |pos| ask(picture, pos));
            }
            return;
        }
        let here = response.interact_pointer_pos().filter(|_| !self.is_over);
        if !self.is_over {
            let modifiers = ui.input(|i| i.modifiers);
            // Before the press Shift smooths.
            self.is_straight = self.way == StrokeWay::Move && modifiers.shift;
            self.way = self.way.with_alt(modifiers.alt);
        }
        let last = self.spots.last().copied();
        let is_far = |pos: &Pos2| last.is_none_or(|last| last.distance(*pos) >= STEP);
        self.spots.extend(here.filter(is_far));
        self.is_over |= !response.dragged_by(PointerButton::Primary);
        self.find(|pos| ask(picture, pos), view, session.camera.target);
        if !matches!(self.hand, Hand::Draws(_)) {
            return;
        }
        let follows = self.way.follows_surface();
        if !follows {
            self.go_on_in_plane(view);
        } else if self.pick.is_none() && self.asked < self.spots.len() {
            // A weak device is asked about as many places as it answers.
            self.asked = self.spots.len();
            self.pick = self.spots.last().and_then(|pos| ask(picture, *pos));
        }
        self.tell(follows, commands);
    }

    /// Fits the tool by the keys that are held. True while one is.
    fn fit(
        &mut self,
        ui: &Ui,
        (response, view): (&Response, &Projection),
        session: &Session,
        commands: &mut Vec<Command>,
    ) -> bool {
        let (pos, wheel) = ui.input(|i| (i.pointer.latest_pos(), i.smooth_scroll_delta()));
        // With Shift the wheel counts as one that scrolls sideways.
        let wheel = wheel.x + wheel.y;
        let is_here = self.fitting.is_some() || response.contains_pointer();
        let fits = Fits::held(ui).filter(|_| self.may_fit() && is_here);
        let Some((fits, pos)) = fits.zip(pos) else {
            if self.fitting.take().is_some() {
                self.asked_at = None;
            }
            self.is_wheel_turning &= wheel != 0.0;
            return false;
        };
        let is_same = |fitting: &Fitting| fitting.fits == fits;
        let fitting = self.fitting.take().filter(is_same);
        let mut fitting = fitting.unwrap_or_else(|| Fitting::new(fits, session.hand(), pos));
        fitting.scroll(wheel);
        self.is_wheel_turning = wheel != 0.0;
        let at = self.under.map_or(session.camera.target, |under| under.pos);
        let hand = fitting.fitted(pos, view.points_per_unit(at));
        self.fitting = Some(fitting);
        if hand != *session.hand() {
            commands.push(held(hand));
        }
        true
    }

    /// What is under the pointer while nothing is drawn.
    fn hover(&mut self, response: &Response, ask: impl FnOnce(Pos2) -> Option<PendingPick>) {
        let pos = response.hover_pos();
        if pos.is_none() {
            self.under = None;
        }
        if self.pick.is_none()
            && let Some(pos) = pos
            && self.asked_at != Some(pos)
        {
            self.asked_at = Some(pos);
            self.pick = ask(pos);
        }
    }

    /// Finds what is seen where the drag began; a drag that began beside it turns the view. `middle` is what the camera
    /// looks at.
    fn find(
        &mut self,
        ask: impl FnOnce(Pos2) -> Option<PendingPick>,
        view: &Projection,
        middle: Vec3,
    ) {
        match &mut self.hand {
            Hand::Waits => {
                // Another question may be open; then this one is asked in the next frame.
                if let Some(asked) = self.spots.first().and_then(|pos| ask(*pos)) {
                    self.hand = Hand::Pressed(asked);
                }
            }
            Hand::Pressed(asked) => {
                let Some(answer) = asked.poll_now() else {
                    return;
                };
                let found = answer.ok().flatten();
                let under = found.and_then(|pick| touch(&pick, view));
                // The form of a tool may be drawn beside it all.
                let beside = || {
                    let pos = view.on_plane(*self.spots.first()?, middle, view.back())?;
                    Some(Touch {
                        pos,
                        normal: view.back(),
                        force: None,
                    })
                };
                let is_form = self.way == StrokeWay::Form;
                self.hand = match under.or_else(|| beside().filter(|_| is_form)) {
                    Some(first) => {
                        self.asked = 1;
                        let force = self.force;
                        Hand::Draws(vec![Touch { force, ..first }])
                    }
                    None => {
                        let ends = self.spots.first().zip(self.spots.last());
                        self.turned = ends.map_or(Vec2::ZERO, |(first, last)| *last - *first);
                        Hand::Free
                    }
                };
            }
            Hand::Free | Hand::Rests | Hand::Draws(_) => {}
        }
    }

    /// Takes the place that was found under the hand into its way.
    fn follow(&mut self) {
        if let (Hand::Draws(touches), Some(under)) = (&mut self.hand, self.under)
            && self.way.follows_surface()
        {
            let force = self.pen.force().or(self.force);
            touches.push(Touch { force, ..under });
        }
    }

    /// The way of the hand over the window.
    fn way_over_window(&self) -> Vec<Pos2> {
        match self.spots[..] {
            [first, .., last] if self.is_straight => vec![first, kept_to_axis(first, last)],
            _ => self.spots.clone(),
        }
    }

    /// Takes the way of the hand in the plane of the picture through the first touch.
    fn go_on_in_plane(&mut self, view: &Projection) {
        let way = self.way_over_window();
        let Hand::Draws(touches) = &mut self.hand else {
            return;
        };
        let Some(first) = touches.first().copied() else {
            return;
        };
        let mut places = way
            .iter()
            .filter_map(|pos| view.on_plane(*pos, first.pos, view.back()));
        let Some(start) = places.next() else {
            return;
        };
        touches.truncate(1);
        // The picture is asked by its pixels, which may be coarse: what counts is how far the hand went.
        touches.extend(places.map(|pos| Touch {
            pos: first.pos + (pos - start),
            ..first
        }));
    }

    /// Tells the session how far the way has come.
    fn tell(&mut self, follows: bool, commands: &mut Vec<Command>) {
        let Hand::Draws(touches) = &self.hand else {
            return;
        };
        let is_over = self.is_over && !(follows && self.pick.is_some());
        let told = touches.last().map(|last| (self.way, touches.len(), *last));
        // A hand that rests changes nothing.
        if told == self.told && !is_over {
            return;
        }
        self.told = told;
        commands.push(Command::Hand(HandCommand::Draw {
            way: self.way,
            touches: touches.clone(),
            is_over,
        }));
        if is_over {
            self.hand = Hand::Free;
            self.asked_at = None;
        }
    }

    /// The tool where it would act, with its mirror images and the end of its coating, and the way of the hand.
    pub(crate) fn paint(&self, ui: &Ui, view: &Projection, session: &Session) {
        let painter = ui.painter_at(view.rect);
        let at = match &self.hand {
            Hand::Draws(touches) => {
                paint_way(&painter, self.way_over_window());
                touches.last().copied()
            }
            _ => self.under,
        };
        let Some(at) = at else {
            return;
        };
        ui.ctx().set_cursor_icon(CursorIcon::Crosshair);
        let hand = session.hand();
        if hand.way == StrokeWay::Form {
            return;
        }
        let (middle, turn) = hand.pose(&at);
        let placed = Similarity::new(1.0, turn.as_dquat(), middle.as_dvec3());
        let outline = placed_outline(&session.view.grids, &hand.shape(), placed);
        paint_outline(&painter, view, &outline, hand.mirror, ink::HOT);
        let ring = ring(view, middle, hand.size + hand.coat);
        for line in images(hand.mirror).filter_map(|image| seen(view, &ring, image)) {
            let stroke = Stroke::new(1.2, ink::HALO_LIGHT);
            painter.extend(Shape::dashed_line(&line, stroke, 4.0, 4.0));
        }
    }
}

/// True if drags are strokes: they are not where a tool is laid down.
fn draws(session: &Session) -> bool {
    session.has_hand() && session.hand().way != StrokeWay::Place
}

/// The place that was found, if it is not one of an object.
fn touch(pick: &Pick, view: &Projection) -> Option<Touch> {
    let normal = pick.normal.normalize_or(view.back());
    pick.object.is_none().then_some(Touch {
        pos: pick.pos_in_subject,
        normal,
        force: None,
    })
}

/// A place as far from another, along that axis of the picture along which it is farther away.
fn kept_to_axis(from: Pos2, to: Pos2) -> Pos2 {
    let way = to - from;
    match way.x.abs() >= way.y.abs() {
        true => pos2(to.x, from.y),
        false => pos2(from.x, to.y),
    }
}

/// A circle about a place, across the line of sight.
fn ring(view: &Projection, middle: Vec3, radius: f32) -> Vec<Vec3> {
    let corner = |i: u8| {
        let turn = Quat::from_axis_angle(view.back(), std::f32::consts::TAU * f32::from(i) / 48.0);
        middle + turn * (radius * view.right)
    };
    (0..=48).map(corner).collect()
}

/// The drawn curves, meshes and baked clays among the tools of the clay or of the sweeps, and what is held.
fn own_shapes(session: &Session) -> Vec<&ToolShape> {
    let listed: Vec<&ToolShape> = if session.is_sweeping() {
        swept_shapes(session).collect()
    } else {
        let tools = session.clay().into_iter().flat_map(|clay| &clay.tools);
        tools.filter_map(|tool| tool.shape.as_ref()).collect()
    };
    own_forms(listed.into_iter().chain(&session.hand().own))
}

/// The shapes of the tools of all sweeps that are shown.
fn swept_shapes(session: &Session) -> impl Iterator<Item = &ToolShape> {
    let templates = session.shown().templates.iter();
    let tools = templates.filter_map(|template| match &template.data {
        TemplateData::Tools(held) => Some(&held.tools),
        _ => None,
    });
    tools.flatten().filter_map(|tool| tool.shape.as_ref())
}

/// Over the picture while the tool is in hand: what a drag does, form and size of the tool, the mirror across x, and
/// how to put it away. The panel has the rest.
pub(crate) fn bar_ui(ui: &mut Ui, rect: Rect, session: &Session, commands: &mut Vec<Command>) {
    let (mut inner, width) = head_bar(ui, rect, BAR, "clay");
    let ui = &mut inner;
    let hand = session.hand();
    let side = theme::control_height();
    let is_wide = width >= NARROW;
    let buttons = if is_wide { 5.0 } else { 4.0 };
    let room = (width - 12.0 - buttons * (side + 2.0) - 12.0).max(120.0);
    let (way_width, form_width) = (0.56 * room, 0.44 * room);
    let shown = widget::combo("way of strokes", way_title(hand.way).0, way_width);
    let shown = shown.show_ui(ui, |ui| {
        for &way in StrokeWay::offered(session.is_sweeping()) {
            let (title, hint) = way_title(way);
            let label = ui.selectable_label(way == hand.way, title);
            if label.on_hover_text(hint).clicked() {
                commands.push(held(HeldTool {
                    way,
                    ..hand.clone()
                }));
            }
        }
    });
    let drag = match session.is_sweeping() {
        true => sweep::w().click_or_draw,
        false => w().drag,
    };
    let hint = format!("{}\n{drag}", way_title(hand.way).1);
    shown.response.named(w().way).on_hover_text(hint);
    if session.laid().is_some() {
        handles_ui(ui, session.gizmo, form_width, commands);
    } else {
        form_ui(ui, session, form_width, commands);
    }
    let [x, y, z] = hand.mirror;
    let name = fill(w().mirror, &[&"x"]);
    let mut mirrors = || ui.add_sized(vec2(side, side), egui::Button::new("X").selected(x));
    if is_wide
        && mirrors()
            .named(&name)
            .on_hover_text(w().mirror_hint)
            .clicked()
    {
        commands.push(held(HeldTool {
            mirror: [!x, y, z],
            ..hand.clone()
        }));
    }
    buttons_ui(ui, session, commands);
}

/// Takes another tool in hand.
fn held(hand: HeldTool) -> Command {
    Command::Hand(HandCommand::Hold(hand))
}

/// The form of the tool.
fn form_ui(ui: &mut Ui, session: &Session, form_width: f32, commands: &mut Vec<Command>) {
    let hand = session.hand();
    let shown = widget::combo("form of strokes", &held_title(hand), form_width);
    let shown = shown.show_ui(ui, |ui| {
        commands.extend(forms_ui(ui, hand, &own_shapes(session)).map(held));
        let draws = hand.way == StrokeWay::Form;
        let label = ui.selectable_label(draws, w().draw_form);
        if label.on_hover_text(w().draw_form_hint).clicked() {
            commands.push(held(HeldTool {
                way: StrokeWay::Form,
                ..hand.clone()
            }));
        }
    });
    shown.response.named(w().form).on_hover_text(w().form);
}

/// What the handles of the tool that is laid down do.
fn handles_ui(ui: &mut Ui, current: GizmoMode, width: f32, commands: &mut Vec<Command>) {
    let shown = widget::combo("handles of the tool", gizmo_name(current), width);
    let shown = shown.show_ui(ui, |ui| {
        for mode in GizmoMode::ALL {
            if ui
                .selectable_label(mode == current, gizmo_name(mode))
                .clicked()
            {
                commands.push(Command::SetGizmo(mode));
            }
        }
    });
    shown.response.named(picture::w().handles);
}

/// At the head of what is free of the picture: what a click and a drag do.
pub(crate) fn what_to_do_ui(ui: &Ui, free: Rect) {
    let words = sweep::w();
    let text = theme::by_hand([words.click_or_draw, words.tap_or_draw]);
    let palette = Palette::get(ui);
    let painter = ui.painter();
    let font = theme::strong_font(12.5);
    let galley = painter.layout(text.to_owned(), font, palette.text, free.width() - 40.0);
    let left = free.center().x - 0.5 * galley.size().x;
    let place = pos2(left, free.top() + 26.0);
    let behind = Rect::from_min_size(place, galley.size()).expand2(vec2(10.0, 4.0));
    painter.rect_filled(behind, 6.0, palette.panel.gamma_multiply(0.85));
    painter.galley(place, galley, palette.text);
}

/// The buttons at the end of the bar while a sweep is drawn.
fn sweep_buttons_ui(ui: &mut Ui, commands: &mut Vec<Command>) {
    let words = picture::w();
    let buttons = [
        (Icon::Down, w().smaller, Command::NudgeMain(-1.0)),
        (Icon::Up, w().larger, Command::NudgeMain(1.0)),
        (Icon::Check, words.in_the_middle, Command::PlaceInMiddle),
        (Icon::Close, words.cancel_placing, Command::Escape),
    ];
    for (icon, name, command) in buttons {
        if widget::icon_button(ui, icon, name, true).clicked() {
            commands.push(command);
        }
    }
}

/// The buttons at the end of the bar. What is laid down is done and taken back where else the tool is sized.
fn buttons_ui(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    if session.is_sweeping() {
        return sweep_buttons_ui(ui, commands);
    }
    let together = &session.together;
    let act = Command::Clay(ClayCommand::Act);
    let take_back = (Icon::Undo, w().take_back, Command::DeleteSelected, true);
    let shown = match (together.ghosts.is_empty(), session.laid().is_some()) {
        (true, false) => vec![
            (Icon::Down, w().smaller, Command::NudgeMain(-1.0), true),
            (Icon::Up, w().larger, Command::NudgeMain(1.0), true),
        ],
        (true, true) => vec![take_back],
        (false, false) => vec![take_back, (Icon::Check, w().act, act, together.may_act())],
        (false, true) => vec![(Icon::Check, w().act, act, together.may_act())],
    };
    for (icon, name, command, is_enabled) in shown {
        if widget::icon_button(ui, icon, name, is_enabled).clicked() {
            commands.push(command);
        }
    }
    let side = theme::control_height();
    let hand = session.hand();
    if session.laid().is_some() {
        let toggle =
            widget::icon_button_sized(ui, Icon::Brush, w().acts_hint, true, hand.acts, side);
        if toggle.accessible_name(w().acts).clicked() {
            let acts = !hand.acts;
            let hand = HeldTool {
                acts,
                ..hand.clone()
            };
            commands.push(held(hand));
        }
    }
    let is_on = together.is_on;
    let hint = w().together_hint;
    let toggle = widget::icon_button_sized(ui, Icon::Layers, hint, true, is_on, side);
    if toggle.accessible_name(w().together).clicked() {
        commands.push(Command::Clay(ClayCommand::Together));
    }
    if widget::icon_button(ui, Icon::Close, w().put_away, true).clicked() {
        commands.push(Command::Clay(ClayCommand::Toggle));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_way_is_kept_to_the_axis_that_is_farther() {
        let from = pos2(10.0, 20.0);
        assert_eq!(kept_to_axis(from, pos2(40.0, 5.0)), pos2(40.0, 20.0));
        assert_eq!(kept_to_axis(from, pos2(0.0, -90.0)), pos2(10.0, -90.0));
        assert_eq!(kept_to_axis(from, from), from);
    }
}
