//! Where fingers shape: two sliders at the left edge of the picture, for the size of the tool in hand and for its
//! coating, which a mouse changes by held keys.

use egui::{Pos2, Rect, Shape, Slider, Stroke, Ui, UiBuilder, pos2, vec2};

use super::projection::Projection;
use super::view_bar;
use crate::app::kit::float::float_frame;
use crate::app::kit::theme::{self, Palette, over_picture as ink};
use crate::app::kit::widget::Named as _;
use crate::app::session::{Command, HandCommand, HeldTool, Session};
use crate::app::words::clay::w;

/// Width of a slider with its frame, points: as wide as a finger needs.
const WIDTH: f32 = 44.0;
/// Height of a slider with its frame, points. Where there is no room for the least there are none: the bar over the
/// picture has buttons.
const HEIGHTS: [f32; 2] = [84.0, 190.0];
/// Points between the two, where the letter of the patient's side stands, and from both to texts beside them.
const GAP: f32 = 26.0;
const BESIDE: f32 = 8.0;
/// Points at the head of a slider for its mark.
const HEAD: f32 = 24.0;

/// The frames of the two in what is free of the picture, above and below the middle of its edge, if they are shown.
fn frames(free: Rect, session: &Session) -> Option<[Rect; 2]> {
    let [least, most] = HEIGHTS;
    let area = view_bar::beside(free);
    let middle = free.center().y;
    let room = (middle - area.top()).min(area.bottom() - middle) - 0.5 * GAP;
    let height = room.min(most);
    let tops = [middle - 0.5 * GAP - height, middle + 0.5 * GAP];
    let frames = tops.map(|top| {
        let corner = pos2(area.left(), top);
        Rect::from_min_size(corner, vec2(WIDTH, height))
    });
    (theme::is_touch() && session.has_hand() && height >= least).then_some(frames)
}

/// The part of what is free of the picture that texts over it may fill: beside the sliders, too.
pub(crate) fn beside(free: Rect, session: &Session) -> Rect {
    let area = view_bar::beside(free);
    match frames(free, session) {
        Some([frame, _]) => area.with_min_x(frame.right() + BESIDE),
        None => area,
    }
}

/// The sliders, at the left edge of what is free of the picture. While one is moved, two rings in the middle of the
/// picture show how large the tool is, and its coating.
pub(crate) fn ui(
    ui: &mut Ui,
    free: Rect,
    view: &Projection,
    session: &Session,
    commands: &mut Vec<Command>,
) {
    let Some([size_frame, coat_frame]) = frames(free, session) else {
        return;
    };
    let hand = session.hand();
    let [sizes, coats] = HeldTool::RANGES;
    let is_moved = [
        slider_ui(ui, size_frame, w().size_of_tool, hand.size, sizes),
        slider_ui(ui, coat_frame, w().coat_of_tool, hand.coat, coats),
    ];
    let [size, coat] = is_moved.map(|moved| moved.value);
    let mut new = hand.clone();
    if let Some(size) = size {
        new = new.with_size(size);
    }
    if let Some(coat) = coat {
        new = new.with_coat(coat);
    }
    marks_ui(ui, size_frame, coat_frame);
    if is_moved.iter().any(|moved| moved.is_held) {
        rings_ui(ui, view, session.camera.target, &new);
    }
    if new != *hand {
        commands.push(Command::Hand(HandCommand::Hold(new)));
    }
}

/// What a finger or a key did with a slider.
#[derive(Clone, Copy)]
struct Moved {
    /// It is held, or has the keyboard.
    is_held: bool,
    /// Its new value.
    value: Option<f32>,
}

/// A slider that stands upright, the largest value on top.
fn slider_ui(ui: &mut Ui, frame: Rect, name: &str, value: f32, [low, high]: [f32; 2]) -> Moved {
    float_frame(ui, frame);
    let palette = Palette::get(ui);
    let rail = frame.with_min_y(frame.top() + HEAD);
    let mut inner = ui.new_child(UiBuilder::new().id_salt(name).max_rect(rail));
    let style = inner.style_mut();
    // All of the frame's width is for the finger.
    style.spacing.interact_size.y = WIDTH;
    style.spacing.slider_width = rail.height();
    style.spacing.slider_rail_height = 6.0;
    style.visuals.selection.bg_fill = palette.accent;
    style.visuals.handle_shape = egui::style::HandleShape::Rect { aspect_ratio: 0.5 };
    let mut new = value;
    let slider = Slider::new(&mut new, low..=high)
        .vertical()
        .logarithmic(true);
    let response = inner
        .add(slider.show_value(false).max_decimals(3))
        .named(name);
    let is_changed = response.changed() && new != value;
    Moved {
        is_held: response.dragged() || response.has_focus(),
        value: is_changed.then_some(new),
    }
}

/// What the sliders are for: a ball, and a ball in its coating.
fn marks_ui(ui: &Ui, size: Rect, coat: Rect) {
    let color = Palette::get(ui).text;
    let spot = |frame: Rect| frame.center_top() + vec2(0.0, 0.5 * HEAD + 2.0);
    let painter = ui.painter();
    painter.circle_filled(spot(size), 6.0, color);
    painter.circle_filled(spot(coat), 3.0, color);
    painter.circle_stroke(spot(coat), 7.5, Stroke::new(1.5, color));
}

/// How large a tool and its coating are at a place.
fn rings_ui(ui: &Ui, view: &Projection, at: glam::Vec3, hand: &HeldTool) {
    let Some(middle) = view.ui_from_subject(at) else {
        return;
    };
    let painter = ui.painter_at(view.rect);
    let unit = view.points_per_unit(at);
    let ring = |radius: f32| {
        let spot = |i: u8| {
            let turn = std::f32::consts::TAU * f32::from(i) / 64.0;
            middle + unit * radius * egui::Vec2::angled(turn)
        };
        (0..=64).map(spot).collect::<Vec<Pos2>>()
    };
    let tool = ring(hand.size);
    let halo = Stroke::new(3.0, ink::HALO_DARK.gamma_multiply(0.4));
    painter.add(Shape::line(tool.clone(), halo));
    painter.add(Shape::line(tool, Stroke::new(1.4, ink::HOT)));
    let coat = ring(hand.size + hand.coat);
    let stroke = Stroke::new(1.4, ink::HALO_LIGHT);
    painter.extend(Shape::dashed_line(&coat, stroke, 4.0, 4.0));
}
