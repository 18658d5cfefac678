//! The list of presets: each as a small picture of the very scan that is open, with its name below.
//!
//! The pictures are drawn while the list is open and nothing else is: one at a time, once the picture in the middle is
//! complete and no button is held. They stay until another subject, or another look beside the colours, is shown.

use std::collections::BTreeMap;

use egui::text::{LayoutJob, TextFormat};
use egui::{
    Align, Color32, ColorImage, Context, CornerRadius, FontId, Rect, Role, Sense, Stroke,
    StrokeKind, TextureHandle, TextureOptions, Ui, WidgetInfo, pos2, vec2,
};

use super::transfer::{group_heading, grouped_presets};
use crate::app::kit::theme::{self, Palette};
use crate::app::kit::widget;
use crate::app::picture::host::Picture;
use crate::app::session::{Command, Session};
use crate::app::words::{fill, look::w, names};
use crate::data::{Pending, poll_once};
use crate::document::{Background, Camera, Document, Edit, Illustration, Look, Transfer, preset};
use crate::render::{Image, RenderError, SubjectInfo};

/// Width and height of a picture, pixels.
const PICTURE_PX: [u32; 2] = [96, 72];
/// Width of a tile, and height of its picture and of its name, points.
const WIDTH: f32 = 84.0;
const HEIGHT: f32 = 63.0;
const NAME: f32 = 30.0;
const GAP: f32 = 5.0;
/// Tiles beside each other.
const COLUMNS: usize = 3;

/// What all pictures of presets have in common.
#[derive(Clone, Debug, PartialEq)]
struct Common {
    /// Number of the subject that is shown, with its segments.
    subject: u64,
    /// The look but for its colours.
    look: Look,
}

impl Common {
    fn of(session: &Session) -> Self {
        Self {
            subject: session.view.subject_revision,
            look: Look {
                transfer: Transfer::Auto,
                // A preset brings its own.
                tint: None,
                background: Background::None,
                ..session.shown().look.clone()
            },
        }
    }
}

/// The pictures of presets of the subject that is shown.
#[derive(Default)]
pub(crate) struct Pictures {
    common: Option<Common>,
    /// Those that are there; `None` where one could not be drawn.
    made: BTreeMap<&'static str, Option<TextureHandle>>,
    job: Option<(&'static str, Pending<Result<Image, RenderError>>)>,
    /// The presets of the list that is open in this frame, in their order.
    wanted: Vec<&'static str>,
}

impl Pictures {
    /// True while pictures of the list that is open are missing.
    pub(crate) fn is_waiting(&self) -> bool {
        self.job.is_some() || self.next().is_some()
    }

    fn next(&self) -> Option<&'static str> {
        let mut wanted = self.wanted.iter().copied();
        wanted.find(|name| !self.made.contains_key(name))
    }

    /// Once per frame, after the list was shown: takes a picture that is done, or starts the next one.
    pub(crate) fn advance(
        &mut self,
        ctx: &Context,
        session: &Session,
        picture: Option<&Picture>,
        is_held: bool,
    ) {
        let wanted = std::mem::take(&mut self.wanted);
        if wanted.is_empty() && self.made.is_empty() && self.job.is_none() {
            return;
        }
        let common = Common::of(session);
        if self.common.as_ref() != Some(&common) {
            self.made.clear();
            self.job = None;
        }
        if wanted.is_empty() {
            // Nobody looks.
            self.job = None;
        }
        self.wanted = wanted;
        if let Some((name, work)) = &mut self.job {
            if let Some(image) = poll_once(work) {
                let texture = image.ok().map(|image| {
                    let size = image.size.map(|side| side as usize);
                    let pixels = ColorImage::from_rgba_unmultiplied(size, &image.rgba);
                    ctx.load_texture(format!("preset {name}"), pixels, TextureOptions::LINEAR)
                });
                self.made.insert(*name, texture);
                self.job = None;
            }
            ctx.request_repaint();
        } else if let (Some(name), Some(picture)) = (self.next(), picture) {
            let is_idle = picture.state.is_done && !picture.is_waiting();
            if is_idle && picture.state.has_picture && !is_held {
                let seen = seen_by(session, &common, name);
                self.job = Some((name, picture.start_small(&seen, None, PICTURE_PX)));
            }
            ctx.request_repaint();
        } else if picture.is_none() {
            self.wanted.clear();
        }
        self.common = Some(common);
    }
}

/// The untouched subject in the colours of a preset, from where a new document looks.
fn seen_by(session: &Session, common: &Common, preset: &str) -> Illustration {
    let camera: Camera = Document::new().illustration().camera;
    Illustration {
        templates: Vec::new(),
        camera,
        look: Look {
            transfer: Transfer::Preset(preset.to_owned()),
            ..common.look.clone()
        },
        ..session.illustration().clone()
    }
}

/// The list. `auto` is what the subject's own preset is, and how that choice is called.
pub(crate) fn list_ui(
    ui: &mut Ui,
    transfer: &Transfer,
    info: Option<&SubjectInfo>,
    (auto, auto_title): (Option<&str>, &str),
    pictures: &mut Pictures,
    commands: &mut Vec<Command>,
) {
    ui.set_min_width(COLUMNS as f32 * (WIDTH + GAP));
    let auto = auto.and_then(preset).map(|preset| preset.name);
    pictures.wanted.extend(auto);
    pictures.wanted.extend(
        grouped_presets(info)
            .into_iter()
            .flat_map(|(_, presets)| presets.into_iter().map(|preset| preset.name)),
    );
    let mut take = |ui: &mut Ui, name: Option<&'static str>, title: &str, wanted: Transfer| {
        let picture = name.and_then(|name| pictures.made.get(name)?.as_ref());
        if tile_ui(ui, picture, title, *transfer == wanted) {
            commands.push(Command::Apply(Edit::SetTransfer(wanted)));
            // A click closes the list anyway, a key does not.
            ui.close();
        }
    };
    take(ui, auto, auto_title, Transfer::Auto);
    for (title, presets) in grouped_presets(info) {
        group_heading(ui, title);
        for row in presets.chunks(COLUMNS) {
            ui.horizontal(|ui| {
                ui.spacing_mut().item_spacing.x = GAP;
                for preset in row {
                    let title = names::preset(preset.name, preset.title);
                    let wanted = Transfer::Preset(preset.name.to_owned());
                    take(ui, Some(preset.name), title, wanted);
                }
            });
        }
    }
}

/// A preset to choose: its picture, or a plain field while there is none, and its name. True if it was chosen.
fn tile_ui(ui: &mut Ui, picture: Option<&TextureHandle>, title: &str, is_selected: bool) -> bool {
    let palette = Palette::get(ui);
    let (rect, response) = ui.allocate_exact_size(vec2(WIDTH, HEIGHT + NAME), Sense::click());
    response
        .widget_info(|| WidgetInfo::selected(Role::Button, ui.is_enabled(), is_selected, title));
    if ui.is_rect_visible(rect) {
        let (fill, stroke) = match (is_selected, response.hovered()) {
            (true, _) => (palette.accent_wash, Stroke::new(1.5, palette.accent)),
            (false, true) => (palette.hover, Stroke::new(1.0, palette.weak)),
            (false, false) => (palette.raised, Stroke::new(1.0, palette.line)),
        };
        let radius = CornerRadius::same(6);
        let field = rect.with_max_y(rect.top() + HEIGHT).shrink(3.0);
        let painter = ui.painter();
        painter.rect(rect, radius, fill, stroke, StrokeKind::Inside);
        painter.rect_filled(field, CornerRadius::same(4), palette.sunken);
        if let Some(picture) = picture {
            let uv = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
            painter.image(picture.id(), field, uv, Color32::WHITE);
        }
        let (font, color) = match is_selected {
            true => (theme::strong_font(11.0), palette.accent),
            false => (FontId::proportional(11.0), palette.text),
        };
        let mut job = LayoutJob::single_section(
            title.to_owned(),
            TextFormat {
                font_id: font,
                color,
                ..TextFormat::default()
            },
        );
        job.halign = Align::Center;
        job.wrap.max_width = WIDTH - 6.0;
        job.wrap.max_rows = 2;
        let text = painter.layout_job(job);
        let middle = field.bottom() + 0.5 * (rect.bottom() - field.bottom());
        let at = pos2(rect.center().x, middle - 0.5 * text.size().y);
        painter.galley(at, text, color);
        widget::focus_ring(ui, &response, rect);
    }
    let hint = fill(w().preset_hint, &[&title]);
    response.on_hover_text(hint).clicked()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::presets;

    #[test]
    fn the_list_holds_every_preset_once() {
        let mut listed: Vec<&str> = grouped_presets(None)
            .into_iter()
            .flat_map(|(_, presets)| presets.into_iter().map(|preset| preset.name))
            .collect();
        let mut all: Vec<&str> = presets().iter().map(|preset| preset.name).collect();
        listed.sort_unstable();
        all.sort_unstable();
        assert_eq!(listed, all);
    }
}
