//! Captions: texts fastened to tissue. Each stands at the side of the picture, with a line to where its tissue is now.
//! In a page the texts are the page's own, as long as nothing of the interface lies over them.

use std::sync::Arc;

use super::caption_layout::{ROWS, arranged, is_dark, line_start};
use super::projection::Projection;
use crate::app::picture::host::Picture;
use crate::app::services::TextOver;
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
/// Height of the letters, points.
const LETTERS: f32 = 13.0;
/// Space between two texts, points.
const GAP: f32 = 5.0;

/// Where the captions' tissue is, and the texts beside the picture.
#[derive(Default)]
pub(crate) struct Followed {
    places: FollowedCaptions,
    /// The texts that the surroundings show, where these set texts themselves.
    outside: Option<Outside>,
}

/// Texts that the surroundings show in place of the program.
#[derive(Default)]
struct Outside {
    /// Those of this frame, in the document's order.
    texts: Vec<TextOver>,
    /// Those of the last call, and the size of each, points.
    shown: Vec<TextOver>,
    sizes: Vec<Vec2>,
}

impl Outside {
    /// Size of a text as it was last shown, points.
    fn size(&self, text: &str, widest: f32) -> Option<Vec2> {
        let is_it = |over: &TextOver| over.text == text && over.widest == widest;
        let index = self.shown.iter().position(is_it)?;
        self.sizes.get(index).copied()
    }
}

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
        if picture.follow_captions(&mut self.places, (session.shown(), camera), size) {
            ctx.request_repaint();
        }
    }

    /// True while a question about captions is open.
    pub(crate) fn is_waiting(&self) -> bool {
        self.places.is_waiting()
    }

    /// The captions of an illustration with their places in a picture, as far as they are in it: index, place,
    /// whether something lies before it.
    fn in_picture(&self, shown: &Illustration, view: &Projection) -> Vec<(usize, Pos2, bool)> {
        let captions = shown.captions.iter().enumerate();
        captions
            .filter(|(_, caption)| caption.is_drawn())
            .filter_map(|(index, _)| {
                let (place, hidden) = self.places.place(index)?;
                let at = view.ui_from_subject(place)?;
                view.rect.contains(at).then_some((index, at, hidden))
            })
            .collect()
    }

    /// Where each caption of the document is, for a picture that is saved.
    pub(crate) fn places(&self) -> Vec<CaptionPlace> {
        self.places.places()
    }

    /// From now on the texts are shown by `show`, which takes the texts of a frame and tells the size of each, points.
    /// Called after each frame; true if the texts have to be laid out anew.
    pub(crate) fn show_outside(&mut self, show: impl FnOnce(&[TextOver]) -> Vec<Vec2>) -> bool {
        // An earlier window may have left texts there.
        let is_first = self.outside.is_none();
        let outside = self.outside.get_or_insert_default();
        let texts = std::mem::take(&mut outside.texts);
        if texts == outside.shown && !is_first {
            return false;
        }
        let sizes = show(&texts);
        let are_known = texts.iter().zip(&sizes).all(|(text, size)| {
            text.at.is_none() || outside.size(&text.text, text.widest) == Some(*size)
        });
        (outside.shown, outside.sizes) = (texts, sizes);
        is_first || !are_known
    }

    /// Draws them over the picture. A click on a text goes to its field.
    pub(crate) fn ui(
        &mut self,
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
                let job = job(&shown.captions[index].text, LETTERS, widest, ink);
                painter.layout_job(job)
            })
            .collect();
        let sizes: Vec<Vec2> = marks
            .iter()
            .zip(&galleys)
            .map(|(&(index, ..), galley)| {
                let text = shown.captions[index].text.trim();
                let outside = self.outside.as_ref();
                let known = outside.and_then(|outside| outside.size(text, widest));
                known.unwrap_or_else(|| galley.size())
            })
            .collect();
        let points: Vec<Pos2> = marks.iter().map(|&(_, at, _)| at).collect();
        let places = arranged(&points, &sizes, GAP, free);
        let texts: Vec<String> = marks
            .iter()
            .map(|&(index, _, _)| shown.captions[index].text.clone())
            .collect();
        let mut over = self.outside.is_some().then(|| texts_over(shown, widest));
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
            let whole = rect.expand2(vec2(4.0, 2.0));
            if let Some(over) = &mut over
                && !is_covered(ui, whole)
                && let Some(text) = over.iter_mut().find(|text| text.caption == index)
            {
                text.at = Some(rect.min);
                text.is_faded = is_hidden;
                continue;
            }
            painter.rect_filled(whole, 4.0, ground);
            painter.galley(rect.min, galley, ink);
            let id = ui.scope_id().with(("caption in the picture", index));
            let response = ui.interact(rect.expand(3.0), id, Sense::click());
            response.widget_info(|| WidgetInfo::labeled(Role::Label, true, &texts[i]));
            if response.clicked() {
                chosen = Some(index);
            }
        }
        if let Some(outside) = &mut self.outside {
            outside.texts = over.unwrap_or_default();
        }
        // In a picture alone there is no field to go to.
        if let Some(index) = chosen.filter(|_| !session.are_panels_hidden) {
            commands.push(Command::EditCaption(index));
        }
    }
}

/// The captions of an illustration, by their numbers, as texts that are not seen.
fn texts_over(shown: &Illustration, widest: f32) -> Vec<TextOver> {
    let captions = shown.captions.iter().enumerate();
    captions
        .filter(|(_, caption)| caption.is_drawn())
        .map(|(index, caption)| TextOver {
            caption: index,
            text: caption.text.trim().to_owned(),
            at: None,
            widest,
            letters: LETTERS,
            is_light: is_dark(shown.look.background),
            is_faded: false,
        })
        .collect()
}

/// True if a part of the interface lies over a rectangle of the picture: a menu, a sheet, a tooltip.
fn is_covered(ui: &Ui, rect: Rect) -> bool {
    ui.ctx().memory(|memory| {
        let layers = memory.areas().visible_layer_ids().into_iter();
        layers
            .filter(|layer| layer.order > ui.layer_id().order)
            .filter_map(|layer| memory.area_rect(layer.id))
            .any(|area| area.intersects(rect))
    })
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
