//! The key light: where it comes from and how it falls.

use egui::{Color32, Key, Mesh, Pos2, Rect, Response, Role, Sense, Stroke, Ui, Vec2, WidgetInfo};
use glam::Vec3;
use serde_json::{Value, json};

use crate::app::kit::entry;
use crate::app::kit::icon::Icon;
use crate::app::kit::theme::Palette;
use crate::app::kit::widget::{self, Change, NumberRow};
use crate::app::session::Command;
use crate::app::words::light::w;
use crate::document::{Edit, Light, Look};

/// Radius of the ball on which the light is seen, points.
const BALL: f32 = 40.0;
/// Its rim stands for light from so far behind the object, degrees away from the viewer.
const RIM_DEG: f32 = 120.0;
/// The light may not come from straight behind: so far it is turned to a side at most, degrees.
const MOST_DEG: f32 = 175.0;
/// What an arrow key turns, degrees.
const KEY_DEG: f32 = 5.0;
/// Rings and sectors of the ball's picture.
const RINGS: u32 = 8;
const SECTORS: u32 = 28;
/// Brightness of the ball in the shade and in full light.
const SHADES: [f32; 2] = [0.25, 0.95];

/// The section of the panel.
pub(crate) fn ui(ui: &mut Ui, look: &Look, commands: &mut Vec<Command>) {
    if !widget::folded_heading(ui, "light is open", w().heading, (w().unfold, w().fold)) {
        return;
    }
    let light = look.light.unwrap_or(Light::DOCUMENT_DEFAULT);
    let mut from = None;
    ui.vertical_centered(|ui| from = ball_ui(ui, light.from));
    let [side, height] = angles(light.from);
    let of_default = angles(Light::DOCUMENT_DEFAULT.from);
    let row = |(name, summary), index: usize, most| NumberRow {
        name,
        summary,
        value: f64::from([side, height][index].round()),
        default: Some(f64::from(of_default[index].round())),
        range: [-f64::from(most), f64::from(most)],
        unit: "°",
        decimals: 0,
    };
    if let Some(change) = row((w().side, w().side_hint), 0, MOST_DEG).ui(ui) {
        from = Some(change.map(|side| direction([side as f32, height])));
    }
    if let Some(change) = row((w().height, w().height_hint), 1, 90.0).ui(ui) {
        from = Some(change.map(|height| direction([side, height as f32])));
    }
    if let Some(change) = from {
        let edit = |from: Vec3| set("from", json!(from.to_array().map(thousandths)));
        commands.push(widget::command(change.map(edit)));
    }
    let default = Light::DOCUMENT_DEFAULT;
    let parts = [
        ("soft", (w().soft, w().soft_hint), light.soft, default.soft),
        (
            "contact",
            (w().contact, w().contact_hint),
            light.contact,
            default.contact,
        ),
        ("skin", (w().skin, w().skin_hint), light.skin, default.skin),
    ];
    for (key, names, now, base) in parts {
        if let Some(change) = entry::part_row(ui, names, now, base) {
            let edit = |part: f64| set(key, json!(part));
            commands.push(widget::command(change.map(edit)));
        }
    }
    if look.light.is_some()
        && widget::labelled_button(ui, Icon::Reset, w().reset, false, true).clicked()
    {
        let name = "Reset light".to_owned();
        let edit = Edit::put("/look/light".to_owned(), None, name);
        commands.push(Command::Apply(edit));
    }
}

fn set(key: &str, value: Value) -> Edit {
    Edit::Set {
        pointer: format!("/look/light/{key}"),
        value,
        name: "Change light".to_owned(),
    }
}

fn thousandths(value: f32) -> f64 {
    (f64::from(value) * 1e3).round() / 1e3
}

/// How far a light is turned to the right of the viewer and raised above, degrees.
fn angles(from: Vec3) -> [f32; 2] {
    let side = from.x.atan2(from.z).to_degrees();
    [
        side.clamp(-MOST_DEG, MOST_DEG),
        from.y.clamp(-1.0, 1.0).asin().to_degrees(),
    ]
}

/// Towards a light by [`angles`], unit.
fn direction([side, height]: [f32; 2]) -> Vec3 {
    let (side, height) = (side.to_radians(), height.to_radians());
    let flat = height.cos();
    Vec3::new(side.sin() * flat, height.sin(), side.cos() * flat)
}

/// Where the light stands on the ball, whose radius is 1: its middle is the viewer.
fn on_ball(from: Vec3) -> Vec2 {
    let aside = Vec2::new(from.x, -from.y);
    let away_deg = from.z.clamp(-1.0, 1.0).acos().to_degrees();
    aside.normalized() * (away_deg / RIM_DEG).min(1.0)
}

/// Towards the light that stands at a place of the ball, unit.
fn from_ball(at: Vec2) -> Vec3 {
    let away = (at.length().min(1.0) * RIM_DEG).to_radians();
    let along = at.normalized();
    Vec3::new(along.x * away.sin(), -along.y * away.sin(), away.cos())
}

/// A ball under the light, which a drag or a click brings to another place and the arrow keys turn.
fn ball_ui(ui: &mut Ui, from: Vec3) -> Option<Change<Vec3>> {
    let (rect, response) =
        ui.allocate_exact_size(Vec2::splat(2.0 * BALL + 8.0), Sense::click_and_drag());
    response.widget_info(|| WidgetInfo::labeled(Role::Slider, ui.is_enabled(), w().ball));
    draw_ball(ui, &response, rect, from);
    if response.clicked() {
        response.request_focus();
    }
    let change = if let Some(pos) = response.interact_pointer_pos() {
        let at = (pos - rect.center()) / BALL;
        Some(Change::Drag(from_ball(at)))
    } else {
        turned_by_keys(ui, &response, from).map(Change::Set)
    };
    response.on_hover_text(w().ball_hint);
    change
}

/// The light after the arrow keys of this frame.
fn turned_by_keys(ui: &Ui, response: &Response, from: Vec3) -> Option<Vec3> {
    if !response.has_focus() {
        return None;
    }
    let filter = egui::EventFilter {
        horizontal_arrows: true,
        vertical_arrows: true,
        ..Default::default()
    };
    ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, filter));
    let turns = ui.input(|input| {
        let count = |key| input.num_presses(key) as f32;
        [
            count(Key::ArrowRight) - count(Key::ArrowLeft),
            count(Key::ArrowUp) - count(Key::ArrowDown),
        ]
    });
    let [side, height] = angles(from);
    let turned = [
        (side + KEY_DEG * turns[0]).clamp(-MOST_DEG, MOST_DEG),
        (height + KEY_DEG * turns[1]).clamp(-90.0, 90.0),
    ];
    (turns != [0.0, 0.0]).then(|| direction(turned))
}

fn draw_ball(ui: &Ui, response: &Response, rect: Rect, from: Vec3) {
    let palette = Palette::get(ui);
    let (painter, center) = (ui.painter(), rect.center());
    let mut mesh = Mesh::default();
    let place = |ring: u32, sector: u32| {
        let radius = ring as f32 / RINGS as f32;
        let turn = sector as f32 / SECTORS as f32 * std::f32::consts::TAU;
        Vec2::angled(turn) * radius
    };
    for ring in 0..=RINGS {
        for sector in 0..=SECTORS {
            let at = place(ring, sector);
            let toward = (1.0 - at.length_sq()).max(0.0).sqrt();
            let lit = Vec3::new(at.x, -at.y, toward).dot(from).max(0.0);
            let grey = SHADES[0] + (SHADES[1] - SHADES[0]) * lit;
            let color = Color32::from_gray((255.0 * grey) as u8);
            mesh.colored_vertex(center + at * BALL, color);
        }
    }
    let index = |ring: u32, sector: u32| ring * (SECTORS + 1) + sector;
    for ring in 0..RINGS {
        for sector in 0..SECTORS {
            let corners = [
                index(ring, sector),
                index(ring + 1, sector),
                index(ring + 1, sector + 1),
                index(ring, sector + 1),
            ];
            mesh.add_triangle(corners[0], corners[1], corners[2]);
            mesh.add_triangle(corners[0], corners[2], corners[3]);
        }
    }
    painter.add(mesh);
    painter.circle_stroke(center, BALL, Stroke::new(1.0, palette.line));
    let lamp: Pos2 = center + on_ball(from) * BALL;
    painter.circle(lamp, 5.0, palette.accent, Stroke::new(1.5, palette.panel));
    widget::focus_ring(ui, response, rect);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_light_stands_where_it_was_put() {
        for side in [-160.0_f32, -90.0, -31.0, 0.0, 45.0, 170.0] {
            for height in [-80.0_f32, -20.0, 0.0, 37.0, 88.0] {
                let from = direction([side, height]);
                assert!((from.length() - 1.0).abs() < 1e-6);
                let [again, high] = angles(from);
                assert!((again - side).abs() < 1e-2 && (high - height).abs() < 1e-2);
                let is_on_ball = from.z.acos().to_degrees() < RIM_DEG;
                let back = from_ball(on_ball(from));
                assert!(!is_on_ball || back.distance(from) < 1e-5, "{from} {back}");
            }
        }
        let right = direction([90.0, 0.0]);
        assert!(right.x > 0.999 && on_ball(right).x > 0.0);
        assert!(on_ball(direction([0.0, 60.0])).y < 0.0, "above is up");
        let default = direction(angles(Light::DOCUMENT_DEFAULT.from));
        assert!(default.distance(Light::DOCUMENT_DEFAULT.from) < 1e-5);
    }

    #[test]
    fn no_light_comes_from_straight_behind() {
        let worst = direction([MOST_DEG, 0.0]);
        assert!(worst.z > -0.999);
        for at in [Vec2::new(5.0, 0.0), Vec2::ZERO, Vec2::new(0.0, -1.0)] {
            let from = from_ball(at);
            assert!(from.is_finite() && from.z > -0.999, "{from}");
        }
    }
}
