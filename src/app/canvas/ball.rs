//! The ball that paints tissue: drags over slices and picture, the ring under the pointer, what the drag under way has
//! touched, and the bar that holds the ball.

use egui::{CursorIcon, Event, Painter, Pos2, Rect, Response, Stroke, Ui, vec2};
use glam::Vec3;

use super::projection::{Projection, pixels_of};
use super::slice_plot::Map;
use super::tools::head_bar;
use crate::app::kit::icon::Icon;
use crate::app::kit::theme::{self, over_picture as ink};
use crate::app::kit::widget;
use crate::app::picture::host::Picture;
use crate::app::session::brush::drag_code;
use crate::app::session::{Command, Place, Question, Session, TissueCommand};
use crate::app::words::tissue::w;
use crate::document::Stroke as Painted;
use crate::render::{PendingPick, PendingSlice, SlicePlane};

/// Points by which a hand moves at least from one place of its way to the next.
const STEP: f32 = 2.0;
/// How much of what the drag under way has touched is covered, of 255, by each of the balls that overlap there.
const TOUCHED_ALPHA: u8 = 34;
/// Width of the bar that holds the ball, points.
const BAR: f32 = 392.0;

fn command(command: TissueCommand) -> Command {
    Command::Tissue(command)
}

/// True if what is seen at a place is not what lies there at rest.
fn is_deformed(session: &Session) -> bool {
    let mut templates = session.shown().templates.iter();
    templates.any(|template| template.acting().enabled)
}

/// The hand that holds the ball, over one pane.
#[derive(Debug, Default)]
struct Hand {
    /// The drag under way, as its answers name it.
    code: Option<usize>,
    last: Option<Pos2>,
    /// Two fingers have moved since the last time that none was down: what the one does that stays is no stroke.
    has_moved: bool,
}

impl Hand {
    /// Where the hand went in this frame, and the drag that it belongs to. True behind it if the hand paints, so that
    /// it does nothing else.
    fn follow(
        &mut self,
        ui: &Ui,
        response: &Response,
        session: &Session,
        commands: &mut Vec<Command>,
    ) -> (Vec<(usize, Pos2)>, bool) {
        let (is_finger, has_two) = ui.input(|i| (i.any_touches(), i.multi_touch().is_some()));
        let is_main = ui.input(|i| i.pointer.primary_down());
        let has_moved = self.has_moved || has_two;
        self.has_moved = has_moved && (is_finger || is_main);
        let Some(erases) = session.tool().ball().filter(|_| !has_moved) else {
            self.code = None;
            return (Vec::new(), false);
        };
        let is_down = response.is_pointer_button_down_on() && is_main;
        let mut places = Vec::new();
        // A second finger may follow the first one, until that has gone some way.
        let begins = is_down && (!is_finger || response.dragged());
        if self.code.is_none() && (begins || response.clicked()) {
            let turns = ui.input(|i| i.modifiers.shift || i.modifiers.alt);
            // The command below counts it.
            let number = session.tissues.brush.drags + 1;
            self.code = Some(drag_code(number, erases != turns));
            self.last = None;
            commands.push(command(TissueCommand::PressBall));
            let from = ui.input(|i| i.pointer.press_origin());
            places.extend(from.or(response.interact_pointer_pos()));
        }
        let Some(code) = self.code else {
            return (Vec::new(), is_down);
        };
        // A slow frame holds more than one place.
        let moves = ui.input(|i| {
            let moves = i.events.iter().filter_map(|event| match event {
                Event::PointerMoved(pos) => Some(*pos),
                _ => None,
            });
            moves.collect::<Vec<_>>()
        });
        if is_down {
            places.extend(moves);
        }
        let mut way = Vec::new();
        for pos in places {
            let is_far = self.last.is_none_or(|last| last.distance(pos) >= STEP);
            if is_far && response.rect.contains(pos) {
                self.last = Some(pos);
                way.push((code, pos));
            }
        }
        if !is_down {
            self.code = None;
        }
        (way, true)
    }
}

// ---------------------------------------------------------------------------------------------------- slices

/// The ball over the slices.
#[derive(Debug, Default)]
pub(crate) struct SliceBall {
    hands: [Hand; 3],
    /// Places of the deformed object that are asked for, in order.
    asked: Vec<(usize, PendingSlice)>,
}

impl SliceBall {
    /// What the hand does with the ball in the slice of this index. True if it does nothing else there.
    pub(crate) fn ui(
        &mut self,
        ui: &Ui,
        (i, response, map): (usize, &Response, &Map<'_>),
        session: &Session,
        picture: Option<&mut Picture>,
        commands: &mut Vec<Command>,
    ) -> bool {
        let (way, paints) = self.hands[i].follow(ui, response, session, commands);
        let paint = |code, pos| command(TissueCommand::PaintAt(code, pos));
        if !is_deformed(session) {
            let here = way.iter().map(|(code, pos)| (*code, map.subject(*pos)));
            commands.extend(here.map(|(code, pos)| paint(code, pos)));
        } else if let Some(picture) = picture {
            for (code, pos) in way {
                let plane = SlicePlane {
                    corner: map.subject(pos),
                    right: Vec3::ZERO,
                    down: Vec3::ZERO,
                };
                // What cannot be asked for yet is painted a little later.
                let asked = picture.read_slice(&plane, [1, 1]).ok();
                self.asked.extend(asked.map(|asked| (code, asked)));
            }
        }
        while let Some((code, asked)) = self.asked.first_mut() {
            let Some(answer) = asked.poll_now() else {
                ui.ctx().request_repaint();
                break;
            };
            let texel = answer.ok().and_then(|texels| texels.first().copied());
            if let Some(texel) = texel.filter(|texel| texel.is_there) {
                commands.push(paint(*code, texel.pos_in_rest));
            }
            self.asked.remove(0);
        }
        paints
    }
}

/// The ring under the pointer in a slice, and what the drag under way has touched there.
pub(crate) fn paint_in_slice(
    ui: &Ui,
    painter: &Painter,
    response: &Response,
    map: &Map<'_>,
    session: &Session,
) {
    let (Some(_), Some(radius)) = (session.tool().ball(), session.ball_in_units()) else {
        return;
    };
    if session.tissues.is_behind && !is_deformed(session) {
        touched(session, |stroke, pos, radius| {
            let height = map.height(pos);
            let inside = radius * radius - height * height;
            if inside > 0.0 {
                let color = touched_color(stroke);
                painter.circle_filled(map.ui(pos), inside.sqrt() / map.units_per_point, color);
            }
        });
    }
    if let Some(pos) = response.hover_pos() {
        ring(
            painter,
            pos,
            radius / map.units_per_point,
            is_erasing(ui, session),
        );
    }
}

// ---------------------------------------------------------------------------------------------------- picture

/// The ball over the picture.
#[derive(Default)]
pub(crate) struct PictureBall {
    hand: Hand,
    /// A place of the hand that waits until the picture has answered about the one before.
    next: Option<(usize, Pos2)>,
    /// The surface under the pointer, on its way, where the pointer was when it was asked for, and the last answer.
    pick: Option<PendingPick>,
    asked_at: Option<Pos2>,
    spot: Option<Vec3>,
}

impl PictureBall {
    /// True while places of the hand wait for the picture.
    pub(crate) fn is_waiting(&self) -> bool {
        self.next.is_some()
    }

    /// What the hand does with the ball in the picture: questions about places on its way.
    pub(crate) fn ui(
        &mut self,
        ui: &Ui,
        response: &Response,
        session: &Session,
        (picture, size): (&mut Picture, [u32; 2]),
        commands: &mut Vec<Command>,
    ) -> Option<Question> {
        let (way, _) = self.hand.follow(ui, response, session, commands);
        let pixel = pixels_of(response.rect, size);
        if session.tool().ball().is_none() {
            (self.next, self.pick, self.spot) = (None, None, None);
            return None;
        }
        if let Some(pick) = &mut self.pick {
            match pick.poll_now() {
                Some(pick) => {
                    self.spot = pick.ok().flatten().map(|pick| pick.pos_in_subject);
                    self.pick = None;
                }
                None => ui.ctx().request_repaint(),
            }
        }
        if self.pick.is_none()
            && let Some(pos) = response.hover_pos()
            && self.asked_at != Some(pos)
        {
            self.asked_at = Some(pos);
            // A ring that cannot be found is no reason for a message.
            self.pick = picture.pick(pixel(pos), size).ok();
        }
        // A weak device is asked about as many places as it answers.
        if let Some(last) = way.last() {
            self.next = Some(*last);
        }
        if picture.is_waiting() {
            return None;
        }
        let (code, pos) = self.next.take()?;
        let reply = |code, found| command(TissueCommand::PaintOn(code, found));
        Some(Question {
            index: code,
            adds: true,
            ..Question::new(Place::Pixel(pixel(pos)), reply)
        })
    }

    /// The ring under the pointer, and what the drag under way has touched.
    pub(crate) fn paint(&self, ui: &Ui, response: &Response, view: &Projection, session: &Session) {
        let Some(radius) = session.ball_in_units() else {
            return;
        };
        let painter = ui.painter_at(view.rect);
        if session.tissues.is_behind && !is_deformed(session) {
            touched(session, |stroke, pos, radius| {
                if let Some(at) = view.ui_from_subject(pos) {
                    let radius = radius * view.points_per_unit(pos);
                    painter.circle_filled(at, radius, touched_color(stroke));
                }
            });
        }
        let Some(pos) = response.hover_pos() else {
            return;
        };
        match self.spot {
            Some(spot) => {
                let radius = radius * view.points_per_unit(spot);
                ring(&painter, pos, radius, is_erasing(ui, session));
            }
            // There is nothing to paint on.
            None => ring(&painter, pos, 3.0, is_erasing(ui, session)),
        }
    }
}

// ---------------------------------------------------------------------------------------------------- both

fn is_erasing(ui: &Ui, session: &Session) -> bool {
    let turns = ui.input(|i| i.modifiers.shift || i.modifiers.alt);
    session.tool().ball() == Some(!turns)
}

/// The outline of the ball: struck through where it erases.
fn ring(painter: &Painter, at: Pos2, radius: f32, erases: bool) {
    let radius = radius.max(2.0);
    painter.ctx().set_cursor_icon(CursorIcon::Crosshair);
    painter.circle_stroke(at, radius, Stroke::new(3.6, ink::HALO_DARK));
    let color = if erases { ink::X } else { ink::HOT };
    painter.circle_stroke(at, radius, Stroke::new(1.6, color));
    painter.circle_filled(at, 1.5, color);
    if erases {
        let by = 0.5_f32.sqrt() * radius;
        let ends = [at + vec2(-by, by), at + vec2(by, -by)];
        painter.line_segment(ends, Stroke::new(1.0, color.gamma_multiply(0.7)));
    }
}

fn touched_color(stroke: &Painted) -> egui::Color32 {
    let color = if stroke.erases { ink::X } else { ink::HOT };
    egui::Color32::from_rgba_unmultiplied(color.r(), color.g(), color.b(), TOUCHED_ALPHA)
}

/// Balls along the strokes of the drag under way: where, in rest space, and how large, subject units.
fn touched(session: &Session, mut ball: impl FnMut(&Painted, Vec3, f32)) {
    let Some(mm_per_unit) = session.view.mm_per_unit() else {
        return;
    };
    for stroke in session.strokes_under_way() {
        let radius = stroke.radius_mm / mm_per_unit;
        let place = |i: usize| Painted::in_rest(stroke.places[i]).as_vec3();
        for i in 0..stroke.places.len() {
            let (end, start) = (place(i), place(i.saturating_sub(1)));
            let steps = (end.distance(start) / (0.4 * radius))
                .ceil()
                .clamp(1.0, 200.0);
            for k in 1..=steps as u32 {
                ball(stroke, start.lerp(end, k as f32 / steps), radius);
            }
        }
    }
}

/// Over the picture while the ball is in hand: whether it paints or erases, how large it is, and how to put it away.
pub(crate) fn bar_ui(
    ui: &mut Ui,
    rect: Rect,
    session: &Session,
    erases: bool,
    commands: &mut Vec<Command>,
) {
    let (mut inner, width) = head_bar(ui, rect, BAR, "ball");
    let ui = &mut inner;
    let side = theme::control_height();
    let text = format!("{} mm", significant(session.ball_mm()));
    let text_width = 64.0;
    let choice = (width - 12.0 - 3.0 * (side + 2.0) - text_width - 8.0).max(60.0);
    let choices = [
        (false, w().paint, w().paint_hint),
        (true, w().erase, w().erase_hint),
    ];
    ui.allocate_ui(vec2(choice, side), |ui| {
        if let Some(erases) = widget::explained(ui, w().brush, &choices, erases) {
            commands.push(command(TissueCommand::Ball(Some(erases))));
        }
    });
    ui.add_space(4.0);
    if widget::icon_button(ui, Icon::Down, w().smaller, true).clicked() {
        commands.push(Command::NudgeMain(-1.0));
    }
    let label = egui::Label::new(text).truncate();
    ui.add_sized(vec2(text_width, side), label)
        .on_hover_text(w().ball_hint);
    if widget::icon_button(ui, Icon::Up, w().larger, true).clicked() {
        commands.push(Command::NudgeMain(1.0));
    }
    if widget::icon_button(ui, Icon::Close, w().put_away, true).clicked() {
        commands.push(command(TissueCommand::Ball(None)));
    }
}

/// A length with two digits: 12, 3.2, 0.38.
fn significant(mm: f32) -> String {
    let before = mm.max(1e-6).log10().floor() as i32;
    widget::plain(f64::from(mm), (1 - before).clamp(0, 4) as usize)
}
