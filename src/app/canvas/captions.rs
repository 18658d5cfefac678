//! Captions: texts fastened to tissue. Each stands at the side of the picture, with a line to where its tissue is now.

use std::sync::Arc;

use super::caption_layout::{ROWS, arranged, is_dark, line_start};
use super::projection::Projection;
use crate::app::picture::host::Picture;
use crate::app::session::{Command, Session};
use crate::document::{Background, Camera, Illustration};
use crate::render::{CaptionPlace, FollowedCaptions};
use egui::text::{LayoutJob, TextWrapping};
use egui::{
    Color32, Context, FontId, Galley, Pos2, Rect, Role, Sense, Stroke, TextFormat, Ui, Vec2,
    WidgetInfo, vec2,
};

/// Width of a text at most: part of the picture's, and points.
const WIDEST: (f32, f32) = (0.27, 190.0);
/// Space between two texts, points.
const GAP: f32 = 5.0;

/// Where the captions' tissue is, and the texts beside the picture.
#[derive(Default)]
pub(crate) struct Followed(FollowedCaptions);

impl Followed {
    /// Asks, and takes answers. `size` is that of the picture, pixels.
    pub(crate) fn update(
        &mut self,
        ctx: &Context,
        session: &Session,
        camera: &Camera,
        picture: &mut Picture,
        size: [u32; 2],
    ) {
        if picture.follow_captions(&mut self.0, (session.shown(), camera), size) {
            ctx.request_repaint();
        }
    }

    /// True while a question about captions is open.
    pub(crate) fn is_waiting(&self) -> bool {
        self.0.is_waiting()
    }

    /// The captions of an illustration with their places in a picture, as far as they are in it: index, place,
    /// whether something lies before it.
    fn in_picture(&self, shown: &Illustration, view: &Projection) -> Vec<(usize, Pos2, bool)> {
        let captions = shown.captions.iter().enumerate();
        captions
            .filter(|(_, caption)| caption.enabled && !caption.text.trim().is_empty())
            .filter_map(|(index, _)| {
                let (place, hidden) = self.0.place(index)?;
                let at = view.ui_from_subject(place)?;
                view.rect.contains(at).then_some((index, at, hidden))
            })
            .collect()
    }

    /// Where each caption of the document is, for a picture that is saved.
    pub(crate) fn places(&self) -> Vec<CaptionPlace> {
        self.0.places()
    }

    /// Draws them over the picture. A click on a text goes to its field.
    pub(crate) fn ui(
        &self,
        ui: &Ui,
        view: &Projection,
        free: Rect,
        session: &Session,
        commands: &mut Vec<Command>,
    ) {
        let shown = session.shown();
        let marks = self.in_picture(shown, view);
        let (ink, ground) = colors(&shown.look.background);
        let painter = ui.painter_at(view.rect);
        let widest = (WIDEST.0 * view.rect.width()).min(WIDEST.1);
        let galleys: Vec<Arc<Galley>> = marks
            .iter()
            .map(|&(index, _, _)| {
                let job = job(&shown.captions[index].text, 13.0, widest, ink);
                painter.layout_job(job)
            })
            .collect();
        let sizes: Vec<Vec2> = galleys.iter().map(|galley| galley.size()).collect();
        let points: Vec<Pos2> = marks.iter().map(|&(_, at, _)| at).collect();
        let places = arranged(&points, &sizes, GAP, free);
        let texts: Vec<String> = marks
            .iter()
            .map(|&(index, _, _)| shown.captions[index].text.clone())
            .collect();
        let mut chosen = None;
        for (i, (&(index, at, is_hidden), galley)) in marks.iter().zip(galleys).enumerate() {
            let rect = places[i];
            let fade = if is_hidden { 0.55 } else { 1.0 };
            let (ink, ground) = (ink.gamma_multiply(fade), ground.gamma_multiply(fade));
            let from = line_start(rect, at, free.center().x, 4.0);
            painter.line_segment([from, at], Stroke::new(3.0, ground));
            painter.line_segment([from, at], Stroke::new(1.2, ink));
            painter.circle_filled(at, 4.0, ground);
            if is_hidden {
                painter.circle_stroke(at, 2.4, Stroke::new(1.2, ink));
            } else {
                painter.circle_filled(at, 2.6, ink);
            }
            painter.rect_filled(rect.expand2(vec2(4.0, 2.0)), 4.0, ground);
            painter.galley(rect.min, galley, ink);
            let id = ui.scope_id().with(("caption in the picture", index));
            let response = ui.interact(rect.expand(3.0), id, Sense::click());
            response.widget_info(|| WidgetInfo::labeled(Role::Label, true, &texts[i]));
            if response.clicked() {
                chosen = Some(index);
            }
        }
        // In a picture alone there is no field to go to.
        if let Some(index) = chosen.filter(|_| !session.are_panels_hidden) {
            commands.push(Command::EditCaption(index));
        }
    }
}

/// Colours of the letters and of the halo behind them, chosen for the background.
fn colors(background: &Background) -> (Color32, Color32) {
    if is_dark(*background) {
        (Color32::WHITE, Color32::from_black_alpha(190))
    } else {
        (
            Color32::from_rgb(0x1f, 0x24, 0x26),
            Color32::from_white_alpha(215),
        )
    }
}

/// A caption's text in a few rows.
fn job(text: &str, size: f32, widest: f32, color: Color32) -> LayoutJob {
    let format = TextFormat::simple(FontId::proportional(size), color);
    let mut job = LayoutJob::single_section(text.trim().to_owned(), format);
    job.wrap = TextWrapping {
        max_width: widest,
        max_rows: ROWS,
        ..TextWrapping::default()
    };
    job
}
