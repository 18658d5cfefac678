//! Layer 5: the viewer. Panels read the state, commands change it, and the surroundings are reached by [`Services`].
//!
//! | file | holds |
//! |---|---|
//! | `state` | the document and its history, selection, camera, loading, what was said |
//! | `command` | everything that can be done, as values, and the table of keys |
//! | `services`, `arrivals` | what the shell does for the app, and what comes back |
//! | `viewport`, `camera`, `gizmo`, `orientation` | the picture and what the hand does on it |
//! | `view`, `view_bar`, `panes`, `slices` with `slice_plot`, `measure` | slices beside the picture, distances, the ghost |
//! | `picture`, `icons` | the renderer, its texture, questions to it; the catalogue's pictures |
//! | `topbar`, `catalogue`, `templates`, `look` with `transfer` and `transfer_plot`, `text`, `notice`, `keys` | one panel each |
//! | `words/` | every text of the interface in every language, a table per panel |
//! | `tissue`, `tissue_work` | segments listed, features made here |
//! | `theme`, `control`, `icon` | colours and type, the common controls, drawn icons |
//!
//! Nothing here knows where it runs. The picture is drawn when something changed; at rest nothing repaints.

mod arrivals;
mod camera;
mod catalogue;
mod command;
mod control;
mod curve;
mod fields;
mod floating;
mod frames;
mod gizmo;
mod hint;
mod icon;
mod icons;
mod keep;
mod keys;
mod labels;
mod lettering;
mod look;
mod making;
mod measure;
mod notice;
mod opening;
mod orientation;
mod panes;
mod picture;
mod points;
mod raw;
mod services;
mod slice_plot;
mod slices;
mod slow;
mod state;
mod steps;
mod templates;
mod text;
mod theme;
mod tissue;
mod tissue_work;
mod topbar;
mod transfer;
mod transfer_plot;
mod view;
mod view_bar;
mod viewport;
mod words;

use std::time::Duration;

use egui::{Frame, Margin, Panel, ScrollArea, Ui, Vec2, vec2};

use self::icon::Icon;
use self::icons::RenderedIcons;
use self::picture::Picture;
use self::state::{Gravity, State, Tab};
use self::theme::Palette;
use self::viewport::Viewport;
use crate::data::{Statistics, VolumeBuilder};
use crate::document::{Document, SegmentsRef};
use crate::render::{Clock, encode_png};

pub use self::camera::StandardView;
pub use self::command::{Command, GizmoMode};
pub use self::labels::label_places;
pub use self::lettering::{LabelPlace, letter};
pub use self::services::{
    LabelsExpected, LinkChange, LoadEvent, Message, RawQuestion, SaveFile, Services, Ticket,
};
pub use self::state::STORED_DOCUMENT;
pub use self::tissue::TissueCommand;
pub use self::view::{Pane, See};
pub use self::words::Lang;

/// Width in points below which panels become drawers.
const NARROW: f32 = 760.0;
/// Width of the catalogue and of the panel at the right.
const CATALOGUE_WIDTH: f32 = 218.0;
const SIDE_WIDTH: f32 = 304.0;
/// Under which the theme is kept.
const STORED_THEME: &str = "theme";
/// Under which it is kept whether the contrast is high.
const STORED_CONTRAST: &str = "contrast";
/// Under which it is kept whether title and credit are written into saved pictures.
const STORED_LETTERING: &str = "lettering";

/// How the app starts.
pub struct Start {
    /// Opened; with none, what was kept from the last time, else an empty document.
    pub document: Option<Document>,
    /// A link or JSON; goes before `document`. A broken one is said, and an empty document opened.
    pub text: Option<String>,
    /// A load that the shell has already started in place of the document's subject.
    pub subject: Option<Ticket>,
    /// Seconds, from any origin; the renderer measures itself with it.
    pub clock: Clock,
}

/// The viewer: an [`eframe::App`] for a window and for the page alike.
pub struct App {
    state: State,
    services: Box<dyn Services>,
    picture: Option<Picture>,
    icons: RenderedIcons,
    viewport: Viewport,
    /// That the device was lost has been said.
    has_said_loss: bool,
    announced: Announced,
    /// The next picture asked for is of the size that is shown.
    wants_shown_size: bool,
    /// Title and credit are written into the picture that is being made.
    is_lettering: bool,
    /// Panels are drawers.
    is_narrow: bool,
    /// Fingers point first, so that controls are large in a wide window too.
    has_fingers: bool,
    /// The volume that is arriving.
    incoming: Option<VolumeBuilder>,
    fields: fields::Fields,
    /// Its values, counted as they arrive.
    statistics: Statistics,
    /// The plot of the transfer function.
    transfer: transfer::Editor,
    /// The slices beside the picture.
    slices: slices::Slices,
    /// The segments of the subject in the making.
    tissue: tissue_work::TissueWork,
    /// Label volumes of the load under way, with the hash of their files.
    incoming_labels: Vec<(String, crate::data::LabelVolume)>,
    /// What the shell was told last of label volumes.
    labels_expected: LabelsExpected,
    /// That a label volume is missing has been said of this document.
    has_said_labels: Vec<SegmentsRef>,
}

/// What has been said aloud so far.
#[derive(Debug, Default)]
struct Announced {
    next_said: u64,
    step: usize,
}

impl App {
    /// In a window that eframe has made. Without a device everything works but the picture.
    pub fn new(
        cc: &eframe::CreationContext<'_>,
        mut services: Box<dyn Services>,
        start: Start,
    ) -> Self {
        theme::install(&cc.egui_ctx);
        cc.egui_ctx.add_plugin(slow::SlowClicks::default());
        let has_fingers = services.has_fingers();
        let contrast = services.stored(STORED_CONTRAST);
        let is_wanted = contrast.map_or_else(|| services.wants_contrast(), |text| text == "high");
        theme::set_contrast(&cc.egui_ctx, is_wanted);
        match services.stored(STORED_THEME).as_deref() {
            Some("dark") => cc.egui_ctx.set_theme(egui::Theme::Dark),
            Some("light") => cc.egui_ctx.set_theme(egui::Theme::Light),
            _ => {}
        }
        let kept = services.stored(words::STORED_LANGUAGE);
        words::set_lang(Lang::best(kept.into_iter().chain(services.languages())));
        let picture = cc
            .wgpu_render_state
            .as_ref()
            .map(|render_state| Picture::new(render_state, start.clock));
        let mut state = State::new(Document::new());
        state.is_lettering = services.stored(STORED_LETTERING).as_deref() == Some("yes");
        // Who comes with a document has been here before, or comes to look.
        let is_first = start.text.is_none()
            && start.document.is_none()
            && services.stored(STORED_DOCUMENT).is_none();
        state.wants_hint = is_first && services.stored(hint::STORED).is_none();
        match (start.text, start.document) {
            (Some(text), _) => state.open_text(&text, services.as_mut()),
            (None, Some(document)) => state.open_document(document, 0, services.as_mut()),
            (None, None) => {
                // What was kept is a convenience: a broken one is not worth a message.
                let kept = services
                    .stored(STORED_DOCUMENT)
                    .and_then(|text| crate::link::decode(&text).ok());
                if let Some(link) = kept {
                    state.open_document(link.document, link.step, services.as_mut());
                }
            }
        }
        match start.subject {
            Some(ticket) => state.file_started(ticket),
            None => state.load_subject(services.as_mut()),
        }
        Self {
            state,
            services,
            has_fingers,
            picture,
            icons: RenderedIcons::default(),
            viewport: Viewport::default(),
            has_said_loss: false,
            announced: Announced::default(),
            wants_shown_size: false,
            is_lettering: false,
            is_narrow: false,
            incoming: None,
            fields: fields::Fields::default(),
            statistics: Statistics::new(),
            transfer: transfer::Editor::default(),
            slices: slices::Slices::default(),
            tissue: tissue_work::TissueWork::new(start.clock),
            incoming_labels: Vec::new(),
            labels_expected: LabelsExpected::default(),
            has_said_labels: Vec::new(),
        }
    }

    /// The document with the present camera, for whoever embeds the app.
    pub fn document(&self) -> Document {
        self.state.document_as_seen()
    }

    /// The step that is shown; 0 is the document as it stands.
    pub fn step(&self) -> usize {
        self.state.walk.step()
    }

    /// Index of the selected template, if one is.
    pub fn selected(&self) -> Option<usize> {
        self.state.selected
    }

    /// True when the picture is complete, nothing is being loaded and no question to the picture is open.
    pub fn is_at_rest(&self) -> bool {
        let is_picture_done = |picture: &Picture| picture.state.is_done && !picture.is_waiting();
        self.state.load.is_none()
            && !self.tissue.is_behind(self.state.shown())
            && !self.state.wants_place_in_middle
            && self.picture.as_ref().is_none_or(is_picture_done)
    }

    /// True if the graphics device was lost; whoever embeds the app makes a new one with [`App::document`].
    pub fn is_device_lost(&self) -> bool {
        let gpu = self.picture.as_ref().map(Picture::gpu);
        gpu.is_some_and(|gpu| gpu.lost().is_some())
    }

    /// Asks for the picture as a PNG in the size in which it is shown; it comes by [`Services::save_file`].
    pub fn ask_for_picture(&mut self) {
        self.wants_shown_size = true;
        self.run(Command::SavePicture);
    }

    /// Does something as if a button had been pressed.
    pub fn run(&mut self, command: Command) {
        self.state.run(command, self.services.as_mut());
    }

    // ------------------------------------------------------------------------------------------------ frame

    fn frame(&mut self, ui: &mut Ui) {
        let now = ui.input(|i| i.time);
        self.take_messages();
        self.follow_fields();
        self.advance_tissue(ui);
        if self.state.advance(now, self.services.as_mut()) {
            ui.ctx().request_repaint();
        }
        for file in viewport::dropped(ui) {
            self.services.drop_file(file);
        }
        if let Some(text) = viewport::pasted(ui) {
            self.state.open_text(&text, self.services.as_mut());
        }
        self.state.making.is_alone = ui.input(|i| i.modifiers.shift);
        let mut commands = Vec::new();
        self.keys(ui, &mut commands);
        // Said anew by whoever is shown in this frame.
        self.transfer.has_keyboard = false;

        self.is_narrow = ui.available_width() < NARROW;
        theme::set_touch(ui.ctx(), self.is_narrow || self.has_fingers);
        if self.is_narrow {
            self.narrow_ui(ui, &mut commands);
        } else {
            self.wide_ui(ui, &mut commands);
        }
        if self.state.is_keys_sheet_open {
            keys::ui(ui, &mut commands);
        }
        if self.state.is_messages_open {
            notice::messages_ui(ui, &self.state, &mut commands);
        }

        frames::ui(ui, &mut self.state, &mut commands);
        raw::ui(ui, &mut self.state, self.services.as_mut());

        // A drag is one step of undo: it ends when nothing is held any more.
        if !ui.input(|i| i.pointer.any_down())
            && !ui.ctx().text_edit_focused()
            && commands.is_empty()
        {
            self.state.end_drag();
        }
        self.state.making.wants_search = false;
        let has_commands = !commands.is_empty();
        let was_placing = (self.state.placing, self.state.labelling.is_placing);
        for command in commands {
            if let Command::NextPanel(forward) = command {
                self.state.next_panel(forward, self.is_narrow);
            }
            self.state.run(command, self.services.as_mut());
        }
        let is_placing = (self.state.placing, self.state.labelling.is_placing);
        if is_placing != (None, false) && is_placing != was_placing {
            // The next Enter places it; it does not press the button again that started it.
            let picture_id = self.picture_id(ui);
            ui.memory_mut(|memory| {
                if memory.focused().is_some() {
                    memory.request_focus(picture_id);
                }
            });
        }
        if has_commands {
            ui.ctx().request_repaint();
        }
        self.afterwards(ui);
    }

    /// Identity of the picture as a widget.
    fn picture_id(&self, ui: &Ui) -> egui::Id {
        self.viewport
            .id()
            .unwrap_or_else(|| ui.scope_id().with("picture"))
    }

    fn keys(&mut self, ui: &Ui, commands: &mut Vec<Command>) {
        let mut is_typing = ui.ctx().text_edit_focused() || self.state.making.wants_search;
        let has_arrows = viewport::has_arrows(ui, self.picture_id(ui));
        let is_sheet_open = self.state.is_keys_sheet_open
            || self.state.is_messages_open
            || self.state.files.raw.is_some();
        if !is_typing && !is_sheet_open {
            ui.input(|i| {
                commands.extend(i.events.iter().filter_map(|event| match event {
                    egui::Event::Copy => Some(Command::Copy),
                    egui::Event::Cut => Some(Command::Cut),
                    _ => None,
                }));
            });
            // A slow frame may hold the words too: the field is there to take them in this very frame.
            if ui.input_mut(|i| take_slash(&mut i.events)) {
                is_typing = true;
                self.run(Command::StartSearch);
            }
        }
        for shortcut in command::shortcuts() {
            if command::is_of_clipboard(&shortcut.command) {
                continue;
            }
            let key = shortcut.keys.logical_key;
            let is_plain = !shortcut.keys.modifiers.command;
            // Letters belong to a text field, arrows to whatever control has the keyboard.
            if is_plain && (is_typing || (viewport::is_widget_key(key) && !has_arrows)) {
                continue;
            }
            // A point of the transfer function is removed by the same keys as a template.
            let is_delete = matches!(key, egui::Key::Delete | egui::Key::Backspace);
            if is_delete && self.transfer.has_keyboard {
                continue;
            }
            // A slice is scrolled by the keys that order templates.
            if self.slices.has_keyboard && matches!(key, egui::Key::PageUp | egui::Key::PageDown) {
                continue;
            }
            if is_sheet_open && !matches!(shortcut.command, Command::ToggleKeys | Command::Escape) {
                continue;
            }
            let is_placing = self.state.placing.is_some() || self.state.labelling.is_placing;
            if key == egui::Key::Enter && !is_placing {
                continue;
            }
            // A slow frame may hold a key that was pressed several times.
            let modifiers = shortcut.keys.modifiers;
            let times = ui.input_mut(|i| i.count_and_consume_key(modifiers, key));
            commands.extend(std::iter::repeat_n(shortcut.command, times));
        }
    }

    /// What happens after everything is shown.
    fn afterwards(&mut self, ui: &Ui) {
        self.announce(ui);
        let ctx = ui.ctx();
        if std::mem::take(&mut self.state.theme_toggle) {
            let is_dark = ctx.theme() == egui::Theme::Dark;
            ctx.set_theme(if is_dark {
                egui::Theme::Light
            } else {
                egui::Theme::Dark
            });
            self.services
                .store(STORED_THEME, if is_dark { "light" } else { "dark" });
        }
        if std::mem::take(&mut self.state.contrast_toggle) {
            let is_high = !theme::has_contrast();
            theme::set_contrast(ctx, is_high);
            let kept = if is_high { "high" } else { "usual" };
            self.services.store(STORED_CONTRAST, kept);
            ctx.request_repaint();
        }
        if let Some(factor) = self.state.scale_change.take() {
            ctx.set_zoom_factor((ctx.zoom_factor() * factor).clamp(0.6, 3.0));
        }
        if let Some(picture) = &mut self.picture {
            for notice in picture.take_notices() {
                // What is not there yet may be on its way.
                let is_early = self.tissue.is_behind(self.state.shown());
                if !(is_early && notice.starts_with("keep: ")) {
                    self.state.say(Gravity::Warning, notice, "");
                }
            }
            if std::mem::take(&mut self.state.wants_picture_file) {
                let size = self.viewport.size_px(ui.pixels_per_point());
                let is_as_shown = std::mem::take(&mut self.wants_shown_size);
                let size = if is_as_shown { size } else { file_size(size) };
                picture.start_file(&self.state.shown_as_seen(), size);
                // What a script asks for is the picture as it is shown.
                self.is_lettering = self.state.is_lettering && !is_as_shown;
            }
            let file = picture.poll_file().map(|image| {
                let mut image = image?;
                if self.is_lettering {
                    let places = self.viewport.label_places();
                    lettering::letter_with(ctx, &mut image, &self.state.shown_as_seen(), &places);
                }
                encode_png(&image)
            });
            match file {
                Some(Ok(bytes)) => {
                    let name = format!("{}.png", self.state.file_stem());
                    self.services.save_file(SaveFile {
                        name,
                        mime: "image/png",
                        bytes,
                    });
                }
                Some(Err(error)) => {
                    self.state.say(
                        Gravity::Error,
                        words::said::w().picture_failed,
                        error.to_string(),
                    );
                }
                None => {}
            }
            // Icons are drawn when the picture has had its turn, somebody sees them, and no hand is at work: making
            // a program for the GPU may take longer than a frame.
            let is_quiet = ui.input(|i| i.events.is_empty() && !i.pointer.any_down());
            let is_seen = self.state.tab == Some(Tab::Add) || !self.is_narrow;
            let is_icon_time =
                is_quiet && is_seen && picture.state.is_done && self.state.load.is_none();
            if is_icon_time && self.icons.advance(ctx, picture) {
                ctx.request_repaint();
            }
            if picture.is_waiting() {
                ctx.request_repaint();
            }
            self.look_after_device();
        }
        if let Some(seconds) = self.state.seconds_to_next_deed() {
            ctx.request_repaint_after(Duration::from_secs_f64(seconds));
        }
    }

    /// Says aloud what was said since, the step that is come to, and what the keyboard has come to or changed.
    fn announce(&mut self, ui: &Ui) {
        if let Some(text) = control::spoken(ui) {
            self.services.announce(&text);
        }
        for said in &self.state.said {
            if said.id >= self.announced.next_said {
                self.announced.next_said = said.id + 1;
                self.services.announce(&said.message);
            }
        }
        let step = self.state.walk.step();
        if step != std::mem::replace(&mut self.announced.step, step)
            && let Some(text) = steps::spoken(&self.state)
        {
            self.services.announce(&text);
        }
    }

    /// A lost device is said once; the shell makes another window for the same document.
    fn look_after_device(&mut self) {
        let lost = self
            .picture
            .as_ref()
            .and_then(|picture| picture.gpu().lost());
        if let Some(reason) = lost.filter(|_| !self.has_said_loss) {
            self.has_said_loss = true;
            self.icons.device_lost();
            self.state
                .say(Gravity::Error, words::said::w().device_lost, reason);
        }
    }

    // ------------------------------------------------------------------------------------------------ layout

    fn wide_ui(&mut self, ui: &mut Ui, commands: &mut Vec<Command>) {
        // Everything has a place of its own.
        self.state.tab = None;
        let palette = Palette::get(ui);
        if !self.state.are_panels_hidden {
            let bar = Frame::new()
                .fill(palette.panel)
                .inner_margin(Margin::symmetric(12, 0));
            Panel::top("top")
                .exact_size(46.0)
                .frame(bar)
                .show(ui, |ui| {
                    control::directed(ui, |ui| topbar::ui(ui, &self.state, false, commands));
                });
            let side = Frame::new().fill(palette.panel).inner_margin(Margin {
                left: 12,
                right: 6,
                top: 8,
                bottom: 8,
            });
            let (first, last) = if words::is_rtl() {
                (Panel::right("catalogue"), Panel::left("side"))
            } else {
                (Panel::left("catalogue"), Panel::right("side"))
            };
            first
                .exact_size(CATALOGUE_WIDTH)
                .resizable(false)
                .frame(side)
                .show(ui, |ui| {
                    control::directed(ui, |ui| control::heading(ui, words::bar::w().add, |_| {}));
                    scroll(ui, |ui| {
                        catalogue::ui(ui, &self.state, &self.icons, commands)
                    });
                });
            last.exact_size(SIDE_WIDTH)
                .resizable(false)
                .frame(side)
                .show(ui, |ui| {
                    ui.horizontal(|ui| {
                        ui.set_max_width(ui.available_width() - 8.0);
                        let w = words::bar::w();
                        let tabs = [
                            (Tab::Templates, w.templates),
                            (Tab::Tissues, w.tissues),
                            (Tab::Look, w.look),
                            (Tab::Text, w.text),
                        ];
                        if std::mem::take(&mut self.state.wants_panel_focus) {
                            control::focus_chosen(ui, w.panel);
                        }
                        if let Some(tab) =
                            control::segmented(ui, w.panel, &tabs, self.state.side_tab)
                        {
                            self.state.side_tab = tab;
                        }
                    });
                    ui.add_space(6.0);
                    let tab = self.state.side_tab;
                    scroll(ui, |ui| self.tab_ui(ui, tab, commands));
                });
        }
        if self.state.side_tab != Tab::Tissues {
            self.state.end_tissues();
        }
        self.picture_ui(ui, commands);
    }

    fn narrow_ui(&mut self, ui: &mut Ui, commands: &mut Vec<Command>) {
        let palette = Palette::get(ui);
        if !self.state.are_panels_hidden {
            let bar = Frame::new()
                .fill(palette.panel)
                .inner_margin(Margin::symmetric(8, 0));
            Panel::top("top")
                .exact_size(48.0)
                .frame(bar)
                .show(ui, |ui| {
                    control::directed(ui, |ui| topbar::ui(ui, &self.state, true, commands));
                });
            let tabs = Frame::new()
                .fill(palette.panel)
                .inner_margin(Margin::symmetric(4, 2));
            Panel::bottom("tabs")
                .exact_size(56.0)
                .frame(tabs)
                .show(ui, |ui| {
                    control::directed(ui, |ui| self.tabs_ui(ui));
                });
            let drawer = Frame::new().fill(palette.panel).inner_margin(Margin {
                left: 14,
                right: 8,
                top: 8,
                bottom: 8,
            });
            if let Some(tab) = self.state.tab {
                let height = (ui.available_height() * 0.52).clamp(180.0, 420.0);
                Panel::bottom("drawer")
                    .exact_size(height)
                    .resizable(false)
                    .frame(drawer)
                    .show(ui, |ui| {
                        scroll(ui, |ui| match tab {
                            Tab::Add => catalogue::ui(ui, &self.state, &self.icons, commands),
                            _ => self.tab_ui(ui, tab, commands),
                        });
                    });
            }
        }
        if self.state.tab.is_some_and(|tab| tab != Tab::Tissues) {
            self.state.end_tissues();
        }
        self.picture_ui(ui, commands);
    }

    fn tab_ui(&mut self, ui: &mut Ui, tab: Tab, commands: &mut Vec<Command>) {
        match tab {
            Tab::Add | Tab::Templates => {
                let segments = self.picture.as_ref().map_or(&[][..], Picture::segments);
                templates::ui(ui, &self.state, segments, commands);
            }
            Tab::Tissues => {
                let segments = self.picture.as_ref().map_or(&[][..], Picture::segments);
                let info = self.picture.as_ref().and_then(Picture::subject_info);
                tissue::ui(ui, &self.state, segments, info.as_ref(), commands);
            }
            Tab::Look => {
                let info = self.picture.as_ref().and_then(Picture::subject_info);
                look::ui(ui, &self.state, info.as_ref(), &mut self.transfer, commands);
            }
            Tab::Text => text::ui(ui, &mut self.state, commands),
        }
    }

    /// The row of drawers at the bottom of a narrow window.
    fn tabs_ui(&mut self, ui: &mut Ui) {
        let palette = Palette::get(ui);
        let w = words::bar::w();
        let tabs = [
            (Tab::Add, Icon::Plus, w.add),
            (Tab::Templates, Icon::Layers, w.templates),
            (Tab::Tissues, Icon::Tissue, w.tissues),
            (Tab::Look, Icon::Look, w.look),
            (Tab::Text, Icon::Text, w.text),
        ];
        let size = vec2(
            ui.available_width() / tabs.len() as f32,
            ui.available_height(),
        );
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing = Vec2::ZERO;
            for (tab, icon, name) in tabs {
                let (rect, response) = ui.allocate_exact_size(size, egui::Sense::click());
                let is_open = self.state.tab == Some(tab);
                response.widget_info(|| {
                    egui::WidgetInfo::selected(egui::Role::Button, ui.is_enabled(), is_open, name)
                });
                if is_open && std::mem::take(&mut self.state.wants_panel_focus) {
                    response.request_focus();
                }
                let color = if is_open {
                    palette.accent
                } else {
                    palette.weak
                };
                let inner = rect.shrink2(vec2(4.0, 3.0));
                if is_open {
                    ui.painter().rect_filled(inner, 8.0, palette.accent_wash);
                }
                control::focus_ring(ui, &response, inner);
                let spot =
                    egui::Rect::from_center_size(rect.center() - vec2(0.0, 8.0), Vec2::splat(22.0));
                icon.paint(ui.painter(), spot, color);
                let at = rect.center() + vec2(0.0, 13.0);
                ui.painter().text(
                    at,
                    egui::Align2::CENTER_CENTER,
                    name,
                    egui::FontId::proportional(11.5),
                    color,
                );
                if response.clicked() {
                    self.state.tab = if is_open { None } else { Some(tab) };
                }
            }
        });
    }
}

/// A panel's contents, scrolled when they do not fit, with room for the bar at the right.
fn scroll(ui: &mut Ui, contents: impl FnOnce(&mut Ui)) {
    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        ui.set_max_width(ui.available_width() - 8.0);
        control::directed(ui, contents);
        ui.add_space(12.0);
    });
}

/// A saved picture has the window's proportions, and at least 2,000 pixels along its longer side.
fn file_size([width, height]: [u32; 2]) -> [u32; 2] {
    let longest = width.max(height).max(1) as f32;
    let factor = (2000.0 / longest).max(1.0);
    [width, height].map(|side| ((side as f32 * factor).round() as u32).clamp(1, 4096))
}

impl eframe::App for App {
    fn ui(&mut self, ui: &mut Ui, _frame: &mut eframe::Frame) {
        self.frame(ui);
    }

    fn clear_color(&self, visuals: &egui::Visuals) -> [f32; 4] {
        visuals.panel_fill.to_normalized_gamma_f32()
    }
}

/// Takes the key of the search and what lies before it out of a frame's events, and leaves what was typed after it; false if that key
/// was not pressed.
fn take_slash(events: &mut Vec<egui::Event>) -> bool {
    let is_slash = |event: &egui::Event| match event {
        egui::Event::Key {
            key: egui::Key::Slash,
            pressed,
            modifiers,
            ..
        } => *pressed && !(modifiers.command || modifiers.ctrl || modifiers.alt),
        _ => false,
    };
    let Some(at) = events.iter().position(is_slash) else {
        return false;
    };
    let is_its_text = |event: &egui::Event| matches!(event, egui::Event::Text(text) if text == "/");
    let own = events[at..].iter().position(is_its_text);
    events.drain(..=at + own.unwrap_or(0));
    true
}
