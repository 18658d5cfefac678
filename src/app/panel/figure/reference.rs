//! Another picture beside the figure: its landmarks or an outline are clicked, and only these places are kept.

use egui::{
    Align2, Area, ColorImage, Id, Rect, Sense, Shape, Stroke, TextureHandle, Ui, pos2, vec2,
};
use glam::Vec2;
use std::sync::Arc;

use crate::app::kit::icon::Icon;
use crate::app::kit::theme::{self, Palette, over_picture as ink};
use crate::app::kit::widget::{self, Named as _};
use crate::app::session::figure::{FigureCommand, Reference, ReferenceCommand, Takes};
use crate::app::session::{Command, Session};
use crate::app::words::figure::w;
use crate::app::words::fill;
use crate::data::Plate;

/// Width of the picture, points.
const WIDTH: f32 = 360.0;
/// Pixels along the longest side of the copy that is shown.
const MOST_PX: u32 = 1024;

/// The picture as it is shown.
#[derive(Default)]
pub(crate) struct ReferencePicture(Option<(Arc<Plate>, TextureHandle)>);

impl ReferencePicture {
    fn texture(&mut self, ui: &Ui, plate: &Arc<Plate>) -> TextureHandle {
        if let Some((known, texture)) = &self.0
            && Arc::ptr_eq(known, plate)
        {
            return texture.clone();
        }
        let [width, height] = plate.picture.size;
        let step = width.max(height).div_ceil(MOST_PX).max(1);
        let size = [width.div_ceil(step), height.div_ceil(step)];
        let pixel = |i: u32| {
            let (x, y) = (i % size[0] * step, i / size[0] * step);
            let at = y as usize * width as usize + x as usize;
            let [r, g, b, a] = plate.picture.pixels.get(at).copied().unwrap_or_default();
            egui::Color32::from_rgba_unmultiplied(r, g, b, a)
        };
        let pixels = (0..size[0] * size[1]).map(pixel).collect();
        let image = ColorImage::new(size.map(|side| side as usize), pixels);
        let texture = ui
            .ctx()
            .load_texture("reference", image, egui::TextureOptions::LINEAR);
        self.0 = Some((Arc::clone(plate), texture.clone()));
        texture
    }
}

/// The picture in a window of its own over the panels.
pub(crate) fn ui(
    ui: &Ui,
    session: &Session,
    picture: &mut ReferencePicture,
    commands: &mut Vec<Command>,
) {
    let Some(other) = &session.view.figure.reference else {
        return;
    };
    let texture = picture.texture(ui, &other.plate);
    let content = ui.ctx().content_rect();
    let area = Area::new(Id::unique("reference"))
        .anchor(Align2::LEFT_BOTTOM, vec2(12.0, -12.0))
        .constrain_to(content);
    let mut send = |command| commands.push(Command::Figure(FigureCommand::Refer(command)));
    area.show(ui.ctx(), |ui| {
        egui::Frame::window(ui.style()).show(ui, |ui| {
            let width = (content.width() - 48.0).min(WIDTH);
            ui.set_width(width);
            widget::heading(ui, w().other, |ui| {
                if widget::icon_button(ui, Icon::Close, w().put_away, true).clicked() {
                    send(ReferenceCommand::Close);
                }
            });
            let options = [
                (Takes::Landmarks, w().of_landmarks),
                (Takes::Outline, w().of_outline),
            ];
            if let Some(takes) = widget::segmented(ui, w().other, &options, other.takes) {
                send(ReferenceCommand::For(takes));
            }
            let weak = Palette::get(ui).weak;
            ui.label(egui::RichText::new(next(session, other)).color(weak));
            if let Some(at) = picture_ui(ui, &texture, other, width, content.height() - 260.0) {
                send(ReferenceCommand::Click(at));
            }
            widget::row(ui, |ui| {
                let has_some = !other.points.is_empty();
                if widget::icon_button(ui, Icon::Undo, w().take_back, has_some).clicked() {
                    send(ReferenceCommand::TakeBack);
                }
                let can = session.can_take_over();
                if widget::labelled_button(ui, Icon::Check, w().take, true, can).clicked() {
                    send(ReferenceCommand::Take);
                }
            });
        });
    });
}

/// What the next click is for.
fn next(session: &Session, other: &Reference) -> String {
    let wanted = session.places_wanted();
    match (other.takes, &session.view.figure.region) {
        (Takes::Landmarks, _) if wanted == 0 => w().no_landmarks.to_owned(),
        (Takes::Landmarks, _) => {
            let next = (other.points.len() + 1).min(wanted);
            let text = theme::by_hand([w().click_landmark, w().tap_next]);
            fill(text, &[&next, &wanted])
        }
        (Takes::Outline, Some(region)) => {
            let text = theme::by_hand([w().click_outline, w().tap_outline]);
            fill(text, &[region])
        }
        (Takes::Outline, None) => w().no_region.to_owned(),
    }
}

/// The picture with what was clicked. Returns the place of its plane that was clicked, or that a drag draws on to.
fn picture_ui(
    ui: &mut Ui,
    texture: &TextureHandle,
    other: &Reference,
    width: f32,
    most_height: f32,
) -> Option<Vec2> {
    let half = other.plate.half_size().as_vec2();
    let scale = (0.5 * width / half.x).min(0.5 * most_height.max(80.0) / half.y);
    let size = vec2(half.x, half.y) * 2.0 * scale;
    let (rect, response) = ui.allocate_exact_size(size, Sense::click_and_drag());
    let response = response.named(w().other);
    let uv = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
    let painter = ui.painter_at(rect);
    painter.image(texture.id(), rect, uv, egui::Color32::WHITE);
    let seen = |at: &Vec2| rect.center() + vec2(at.x, -at.y) * scale;
    let points: Vec<egui::Pos2> = other.points.iter().map(seen).collect();
    if other.takes == Takes::Outline {
        for (width, color) in [(4.0, ink::HALO_DARK), (2.0, ink::HOT)] {
            painter.add(Shape::closed_line(
                points.clone(),
                Stroke::new(width, color),
            ));
        }
    } else {
        for (number, spot) in points.iter().enumerate() {
            painter.circle(*spot, 4.0, ink::X, Stroke::new(1.6, ink::HALO_LIGHT));
            let font = egui::FontId::proportional(11.0);
            let at = *spot + vec2(6.0, -6.0);
            let text = (number + 1).to_string();
            painter.text(at, Align2::LEFT_BOTTOM, text, font, ink::X);
        }
    }
    let draws = other.takes == Takes::Outline && response.dragged();
    let pos = response.interact_pointer_pos();
    let pos = pos.filter(|pos| (response.clicked() || draws) && rect.contains(*pos))?;
    let at = (pos - rect.center()) / scale;
    let at = Vec2::new(at.x, -at.y);
    let is_far = |last: &Vec2| last.distance(at) * scale > 3.0;
    (response.clicked() || other.points.last().is_none_or(is_far)).then_some(at)
}
