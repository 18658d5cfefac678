//! The library over the window: examples as cards with pictures, and the documents that were open before as a list. A
//! click opens one.
//!
//! List and pictures of the examples are files that ship with the program: `cargo xtask examples` makes them out of
//! `web/gallery`. They are fetched when the library is first opened.

use egui::text::{LayoutJob, TextFormat};
use egui::{
    Color32, CornerRadius, FontId, Id, Modal, Rect, Role, ScrollArea, Sense, Stroke, StrokeKind,
    Ui, UiBuilder, WidgetInfo, vec2,
};

use crate::app::kit::icon::Icon;
use crate::app::kit::sheet::Sheet;
use crate::app::kit::theme::{self, Palette};
use crate::app::kit::widget::{self, Named as _};
use crate::app::session::{
    Command, Example, Library, LibraryCommand, LibraryPage, Listing, Recent, Session,
};
use crate::app::words::library::w;
use crate::app::words::{self, fill, kinds, messages, names};
use crate::document::TemplateKind;

/// Points between cards.
const GAP: f32 = 10.0;
/// Points of the picture of a recent document.
const RECENT: egui::Vec2 = vec2(64.0, 48.0);
/// Points of a card's texts under its picture.
const TEXTS: f32 = 92.0;

/// The pictures of the examples: the file as it came, and its texture once it was shown.
#[derive(Default)]
pub(crate) struct Pictures {
    png: Vec<u8>,
    sheet: Option<Sheet>,
    /// Those of recent documents that were shown, with the files that they are of.
    recent: Vec<(Vec<u8>, Sheet)>,
}

impl Pictures {
    /// Takes the file. A broken one, or one that did not come, leaves the cards without pictures.
    pub(crate) fn take(&mut self, png: Vec<u8>) {
        self.png = png;
        self.sheet = None;
    }

    /// The picture of a recent document; a broken one is none.
    fn recent(&mut self, ui: &Ui, png: Option<&Vec<u8>>) -> Option<&Sheet> {
        let png = png?;
        let known = self.recent.iter().position(|(other, _)| other == png);
        let at = match known {
            Some(at) => at,
            None => {
                let sheet = Sheet::whole(ui.ctx(), "recent document", png).ok()?;
                // More than are ever listed: older ones are of documents that are gone.
                if self.recent.len() > 32 {
                    self.recent.clear();
                }
                self.recent.push((png.clone(), sheet));
                self.recent.len() - 1
            }
        };
        self.recent.get(at).map(|(_, sheet)| sheet)
    }

    fn sheet(&mut self, ui: &Ui, tile_px: [u32; 2]) -> Option<&Sheet> {
        if self.sheet.is_none() && !self.png.is_empty() {
            let png = std::mem::take(&mut self.png);
            self.sheet = Sheet::new(ui.ctx(), "examples", &png, tile_px).ok();
        }
        self.sheet.as_ref()
    }
}

fn push(commands: &mut Vec<Command>, command: LibraryCommand) {
    commands.push(Command::Library(command));
}

/// The library over everything.
pub(crate) fn ui(ui: &Ui, session: &Session, pictures: &mut Pictures, commands: &mut Vec<Command>) {
    let library = &session.library;
    let content = ui.ctx().content_rect().size();
    let frame = egui::Frame::window(ui.style());
    let modal = Modal::new(Id::unique("library")).frame(frame);
    let modal = modal.show(ui.ctx(), |ui| {
        ui.set_width((content.x - 40.0).min(940.0));
        ui.set_height((content.y - 60.0).min(760.0));
        widget::heading(ui, w().examples, |ui| {
            if widget::icon_button(ui, Icon::Close, w().close, true).clicked() {
                push(commands, LibraryCommand::Toggle);
            }
        });
        let pages = [
            (LibraryPage::Examples, w().examples),
            (LibraryPage::Recent, w().recent),
        ];
        if let Some(page) = widget::segmented(ui, w().page, &pages, library.page) {
            push(commands, LibraryCommand::Show(page));
        }
        ui.add_space(6.0);
        match library.page {
            LibraryPage::Examples => examples_ui(ui, library, pictures, commands),
            LibraryPage::Recent => recent_ui(ui, library, pictures, commands),
        }
    });
    if modal.should_close() {
        push(commands, LibraryCommand::Toggle);
    }
}

// ---------------------------------------------------------------------------------------------------- examples

fn examples_ui(
    ui: &mut Ui,
    library: &Library,
    pictures: &mut Pictures,
    commands: &mut Vec<Command>,
) {
    let weak = Palette::get(ui).weak;
    match &library.listing {
        Listing::NotAsked | Listing::Asked => {
            ui.label(egui::RichText::new(messages::w().loading).color(weak));
            return;
        }
        Listing::Failed(why) => {
            ui.label(w().not_fetched).on_hover_text(why);
            if widget::labelled_button(ui, Icon::Reset, w().again, true, true).clicked() {
                push(commands, LibraryCommand::Ask);
            }
            return;
        }
        Listing::Here => {}
    }
    filters_ui(ui, library, commands);
    ui.add_space(6.0);
    let found = library.found();
    if found.is_empty() {
        ui.label(egui::RichText::new(w().found_nothing).color(weak));
        return;
    }
    let sheet = pictures.sheet(ui, library.tile_px);
    let is_small = ui.available_width() < 480.0;
    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        let width = ui.available_width() - 10.0;
        let wanted = if is_small { 140.0 } else { 205.0 };
        let columns = ((width + GAP) / (wanted + GAP)).floor().max(1.0);
        let width = ((width - GAP * (columns - 1.0)) / columns).floor();
        for row in found.chunks(columns as usize) {
            ui.horizontal_top(|ui| {
                ui.spacing_mut().item_spacing.x = GAP;
                for &index in row {
                    let example = &library.examples[index];
                    let card = Card {
                        index,
                        example,
                        width,
                        tile_px: library.tile_px,
                    };
                    card.ui(ui, sheet, commands);
                }
            });
            ui.add_space(GAP);
        }
    });
}

/// The search, and the choice of a subject and of a kind of template.
fn filters_ui(ui: &mut Ui, library: &Library, commands: &mut Vec<Command>) {
    let is_small = ui.available_width() < 480.0;
    let combo_width = if is_small {
        0.5 * ui.available_width() - 12.0
    } else {
        150.0
    };
    let search = |ui: &mut Ui, width: f32, commands: &mut Vec<Command>| {
        let mut text = library.search.clone();
        let has_text = !text.is_empty();
        let clear_width = if has_text {
            theme::control_height() + 8.0
        } else {
            0.0
        };
        let edit = egui::TextEdit::singleline(&mut text)
            .hint_text(w().search_hint)
            .desired_width(width - clear_width)
            .min_size(vec2(0.0, theme::control_height()))
            .align(egui::Align2::LEFT_CENTER)
            .char_limit(60)
            .id(Id::unique("search of the examples"));
        if ui.add(edit).named(w().search).changed() {
            push(commands, LibraryCommand::Search(text));
        }
        if has_text && widget::icon_button(ui, Icon::Close, w().clear_search, true).clicked() {
            push(commands, LibraryCommand::Search(String::new()));
        }
    };
    if is_small {
        widget::row(ui, |ui| search(ui, ui.available_width(), commands));
    }
    widget::row(ui, |ui| {
        if !is_small {
            let gap = ui.spacing().item_spacing.x;
            let width = ui.available_width() - 2.0 * (combo_width + gap) - 10.0;
            search(ui, width, commands);
        }
        subjects_ui(ui, library, combo_width, commands);
        kinds_ui(ui, library, combo_width, commands);
    });
}

fn subjects_ui(ui: &mut Ui, library: &Library, width: f32, commands: &mut Vec<Command>) {
    let chosen = library.subject.as_deref();
    let shown = chosen.map_or_else(|| w().all_subjects.to_owned(), names::subject);
    let combo = widget::combo("subject of the examples", &shown, width);
    let response = combo.show_ui(ui, |ui| {
        if ui
            .selectable_label(chosen.is_none(), w().all_subjects)
            .clicked()
        {
            push(commands, LibraryCommand::OfSubject(None));
        }
        let is_there = |name: &&str| library.examples.iter().any(|e| e.subject() == *name);
        for name in crate::subjects::all_names().filter(is_there) {
            let is_chosen = chosen == Some(name);
            if ui
                .selectable_label(is_chosen, names::subject(name))
                .clicked()
            {
                let name = Some(name.to_owned());
                push(commands, LibraryCommand::OfSubject(name));
            }
        }
    });
    response.response.named(w().subject);
}

fn kinds_ui(ui: &mut Ui, library: &Library, width: f32, commands: &mut Vec<Command>) {
    let shown = library.kind.map_or(w().all_templates, kinds::title);
    let combo = widget::combo("template of the examples", shown, width);
    let response = combo.show_ui(ui, |ui| {
        if ui
            .selectable_label(library.kind.is_none(), w().all_templates)
            .clicked()
        {
            push(commands, LibraryCommand::OfKind(None));
        }
        let is_there =
            |kind: &TemplateKind| library.examples.iter().any(|e| e.kinds.contains(kind));
        for kind in TemplateKind::ALL.into_iter().filter(is_there) {
            let is_chosen = library.kind == Some(kind);
            if ui.selectable_label(is_chosen, kinds::title(kind)).clicked() {
                push(commands, LibraryCommand::OfKind(Some(kind)));
            }
        }
    });
    response.response.named(w().template);
}

/// One example: picture, title, subject and number of steps, legend, and a button for a copy.
struct Card<'a> {
    index: usize,
    example: &'a Example,
    width: f32,
    tile_px: [u32; 2],
}

impl Card<'_> {
    fn ui(&self, ui: &mut Ui, sheet: Option<&Sheet>, commands: &mut Vec<Command>) {
        let palette = Palette::get(ui);
        let shown = self.example.document.illustration();
        let [wide, high] = self.tile_px.map(|side| side.max(1) as f32);
        let picture_size = vec2(self.width, (self.width * high / wide).round());
        let button = theme::control_height() + 8.0;
        let size = picture_size + vec2(0.0, TEXTS + button);
        let (rect, response) = ui.allocate_exact_size(size, Sense::click());
        let name = fill(w().open, &[&shown.title]);
        let enabled = ui.is_enabled();
        let about = self.about();
        response.widget_info(|| {
            let mut info = WidgetInfo::labeled(Role::Button, enabled, &name);
            info.current_text_value = Some(about.clone());
            info
        });
        ui.ctx().accesskit_node_builder(response.id, |node| {
            node.set_description(shown.legend.clone());
        });
        if response.gained_focus() {
            response.scroll_to_me(None);
        }
        if ui.is_rect_visible(rect) {
            let line = if response.hovered() {
                palette.weak
            } else {
                palette.line
            };
            let (radius, stroke) = (CornerRadius::same(8), Stroke::new(1.0, line));
            ui.painter()
                .rect(rect, radius, palette.raised, stroke, StrokeKind::Inside);
            let picture = Rect::from_min_size(rect.min, picture_size).shrink(1.0);
            match sheet {
                Some(sheet) => {
                    let (texture, uv) = sheet.tile(self.index);
                    let image = egui::Image::new((texture, picture.size()));
                    let top = CornerRadius {
                        nw: 8,
                        ne: 8,
                        sw: 0,
                        se: 0,
                    };
                    image.uv(uv).corner_radius(top).paint_at(ui, picture);
                }
                None => {
                    ui.painter().rect_filled(picture, radius, palette.sunken);
                }
            }
            let inner = Rect::from_min_size(
                rect.min + vec2(0.0, picture_size.y),
                vec2(self.width, TEXTS),
            );
            self.texts(ui, inner.shrink2(vec2(9.0, 6.0)), &about);
            widget::focus_ring(ui, &response, rect);
        }
        if response.on_hover_text(&shown.legend).clicked() {
            push(commands, LibraryCommand::Open(self.index));
        }
        let row = Rect::from_min_max(rect.left_bottom() - vec2(0.0, button), rect.max);
        let builder = UiBuilder::new()
            .id_salt(("copy of an example", self.index))
            .max_rect(row.shrink2(vec2(6.0, 0.0)))
            .layout(widget::along());
        let mut ui = ui.new_child(builder);
        let response = widget::labelled_button(&mut ui, Icon::Copy, w().make_mine, false, true);
        let response = response.accessible_name(fill(w().make_mine_of, &[&shown.title]));
        if response.gained_focus() {
            response.scroll_to_me(None);
        }
        if response.on_hover_text(w().make_mine_hint).clicked() {
            push(commands, LibraryCommand::MakeMine(self.index));
        }
    }

    /// Subject and number of steps.
    fn about(&self) -> String {
        let shown = self.example.document.illustration();
        let subject = names::subject_title(shown);
        match shown.steps.len() {
            1 => fill(w().one_step, &[&subject]),
            n => fill(w().steps, &[&subject, &n]),
        }
    }

    fn texts(&self, ui: &Ui, rect: Rect, about: &str) {
        let palette = Palette::get(ui);
        let shown = self.example.document.illustration();
        let lines = [
            (
                shown.title.as_str(),
                theme::strong_font(13.0),
                palette.text,
                1,
            ),
            (about, FontId::proportional(11.5), palette.accent, 1),
            (
                shown.legend.as_str(),
                FontId::proportional(11.5),
                palette.weak,
                3,
            ),
        ];
        let mut y = rect.top();
        for (text, font, color, rows) in lines {
            let galley = elided(ui, text, font, color, rect.width(), rows);
            let place = Rect::from_min_size(egui::pos2(rect.left(), y), galley.size());
            y += galley.size().y + 3.0;
            let place = widget::sided(rect, place);
            ui.painter().galley(place.min, galley, color);
        }
    }
}

/// A text of so many rows at most.
fn elided(
    ui: &Ui,
    text: &str,
    font: FontId,
    color: Color32,
    width: f32,
    rows: usize,
) -> std::sync::Arc<egui::Galley> {
    let mut job = LayoutJob::single_section(text.to_owned(), TextFormat::simple(font, color));
    job.wrap.max_width = width;
    job.wrap.max_rows = rows;
    ui.painter().layout_job(job)
}

// ---------------------------------------------------------------------------------------------------- recent ones

fn recent_ui(ui: &mut Ui, library: &Library, pictures: &mut Pictures, commands: &mut Vec<Command>) {
    if library.recent.is_empty() {
        let weak = Palette::get(ui).weak;
        let text = egui::RichText::new(w().no_recent).color(weak);
        ui.add(egui::Label::new(text).wrap());
        return;
    }
    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        for (index, recent) in library.recent.iter().enumerate() {
            let sheet = pictures.recent(ui, recent.png.as_ref());
            recent_row(ui, index, recent, sheet, commands);
        }
    });
}

/// One document that was open before: its picture, its title, what is in it, and a button that takes it from the list.
fn recent_row(
    ui: &mut Ui,
    index: usize,
    recent: &Recent,
    sheet: Option<&Sheet>,
    commands: &mut Vec<Command>,
) {
    let palette = Palette::get(ui);
    let name = recent.name();
    let side = theme::control_height();
    ui.horizontal(|ui| {
        let width = ui.available_width() - side - 24.0;
        let (rect, response) = ui.allocate_exact_size(vec2(width, RECENT.y + 8.0), Sense::click());
        let enabled = ui.is_enabled();
        let spoken = fill(w().open_recent, &[&name]);
        response.widget_info(|| WidgetInfo::labeled(Role::Button, enabled, &spoken));
        if response.hovered() {
            ui.painter()
                .rect_filled(rect, CornerRadius::same(6), palette.hover);
        }
        widget::focus_ring(ui, &response, rect);
        let shown = recent.document.illustration();
        let kinds = shown.templates.iter().map(|t| kinds::title(t.kind));
        let kinds = kinds.collect::<Vec<&str>>().join(", ");
        let subject = names::subject_title(shown);
        let about = if kinds.is_empty() {
            subject
        } else {
            format!("{subject}: {kinds}")
        };
        let tile = Rect::from_min_size(rect.min + vec2(4.0, 4.0), RECENT);
        let tile = widget::sided(rect, tile);
        let rect = match words::is_rtl() {
            true => rect.with_max_x(tile.left()),
            false => rect.with_min_x(tile.right()),
        };
        let radius = CornerRadius::same(6);
        match sheet {
            Some(sheet) => {
                let (texture, uv) = sheet.tile(0);
                let image = egui::Image::new((texture, RECENT));
                image.uv(uv).corner_radius(radius).paint_at(ui, tile);
            }
            None => {
                ui.painter().rect_filled(tile, radius, palette.sunken);
            }
        }
        let line = Stroke::new(1.0, palette.line);
        ui.painter()
            .rect_stroke(tile, radius, line, StrokeKind::Inside);
        let room = rect.width() - 16.0;
        let title = elided(ui, &name, theme::strong_font(13.0), palette.text, room, 1);
        let about = elided(
            ui,
            &about,
            FontId::proportional(11.5),
            palette.weak,
            room,
            1,
        );
        let mut y = rect.center().y - 0.5 * (title.size().y + about.size().y);
        for galley in [title, about] {
            let place = Rect::from_min_size(egui::pos2(rect.left() + 8.0, y), galley.size());
            y += galley.size().y;
            let place = widget::sided(rect, place);
            ui.painter().galley(place.min, galley, palette.text);
        }
        if response.gained_focus() {
            response.scroll_to_me(None);
        }
        if response.clicked() {
            push(commands, LibraryCommand::OpenRecent(index));
        }
        let forget = fill(w().forget, &[&name]);
        if widget::icon_button(ui, Icon::Trash, &forget, true).clicked() {
            push(commands, LibraryCommand::Forget(index));
        }
    });
}
