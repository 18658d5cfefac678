//! The window: input becomes commands, commands change the session, and what they ask for is done.

use std::sync::Arc;
use std::time::Duration;

use egui::Ui;

use crate::app::canvas::points;
use crate::app::canvas::saved::Saving;
use crate::app::canvas::slices::Slices;
use crate::app::canvas::steps;
use crate::app::canvas::viewport::{self, Viewport};
use crate::app::kit::theme;
use crate::app::kit::{slow_click, widget};
use crate::app::panel::figure::reference::ReferencePicture;
use crate::app::panel::{
    catalogue, dropped, figure, frames, kept, keys, library, notice, presets, raw, share,
    shortcuts, strip, transfer,
};
use crate::app::picture::host::Picture;
use crate::app::picture::small::OpenPicture;
use crate::app::services::{MeshToSave, MissingDocument, Services};
use crate::app::session::{
    Command, Effect, Focus, Gravity, Listing, STORED_DOCUMENT, STORED_HINT, STORED_LETTERING,
    STORED_PICTURE, STORED_SLOW, STORED_TITLE, Session, Sought, Ticket,
};
use crate::app::words::{self, Lang};
use crate::assets::{Assets, Bending, SegmentationsExpected, TissueWork, Want};
use crate::clay::Writing;
use crate::data::{Resources, Site, SubjectBuilder, Surface};
use crate::document::{Document, SegmentsRef, SubjectRef};
use crate::link::Link;
use crate::load::LabelFile;
use crate::render::{Clock, Gpu, RenderNotice};

/// Width in points below which panels become drawers.
const NARROW: f32 = 760.0;
/// The key under which the theme is kept.
const STORED_THEME: &str = "theme";
/// The key under which it is kept whether the contrast is high.
const STORED_CONTRAST: &str = "contrast";

/// How the app starts.
pub struct Start {
    /// The document to open, and its step; with none, the one kept from the last time, else an empty one.
    pub link: Option<Link>,
    /// A link or JSON; goes before `link`. Where it is broken a message tells so, and an empty document is opened.
    pub text: Option<String>,
    /// The document that was asked for and could not be had: a message tells so, and an empty one is opened.
    pub missing: Option<MissingDocument>,
    /// A load that the shell has already started in place of the document's subject.
    pub subject: Option<Ticket>,
    /// The device that egui draws with, where somebody has chosen for it, or where other windows of the program draw on
    /// it too: they share its programs.
    pub gpu: Option<Gpu>,
    /// Seconds, from any origin; the renderer measures itself with it.
    pub clock: Clock,
}

/// The viewer: an [`eframe::App`] for a window and for the page alike.
pub struct App {
    pub(crate) session: Session,
    pub(crate) services: Box<dyn Services>,
    pub(crate) picture: Option<Picture>,
    pub(crate) icons: catalogue::Icons,
    pub(crate) example_pictures: library::Pictures,
    pub(crate) viewport: Viewport,
    /// A message about the lost device has been shown.
    has_told_loss: bool,
    /// Effects of commands that are carried out in the window once the frame is drawn.
    pending: Vec<Effect>,
    /// The control that takes the keyboard when it is shown next.
    pub(crate) focus: Option<Focus>,
    announced: Announced,
    /// The next picture asked for is of the size that is shown.
    pub(crate) wants_shown_size: bool,
    /// The picture on its way into a file.
    pub(crate) saving: Option<Saving>,
    share: share::Share,
    /// The window is narrow: panels open as drawers over the picture.
    pub(crate) is_narrow: bool,
    /// Fingers point first, so that controls are large in a wide window too.
    has_fingers: bool,
    /// The subject that is arriving.
    pub(crate) incoming: SubjectBuilder,
    /// Files that documents wanted and that have arrived.
    pub(crate) assets: Assets,
    /// The document's subject is a clay, as far as the shell knows.
    has_clay: bool,
    /// The figure that is shown.
    pub(crate) bending: Bending,
    /// The picture beside the figure, of which places are taken over.
    reference: ReferencePicture,
    /// The document, by its number, whose addresses `assets` knows.
    pub(crate) opened: u64,
    /// Fields that the shell was asked for.
    pub(crate) fields_asked: Vec<Want>,
    /// Those of them that are fetched only if the reader agrees, with their hosts.
    pub(crate) fields_elsewhere: Vec<(String, Want)>,
    /// Data of the files that the shown document names, as the picture has them.
    pub(crate) resources: Resources,
    /// The plot of the transfer function.
    pub(crate) transfer: transfer::Editor,
    /// The small pictures of presets.
    pub(crate) preset_pictures: presets::Pictures,
    /// The small pictures of the steps.
    pub(crate) step_pictures: strip::Pictures,
    /// The slices beside the picture.
    pub(crate) slices: Slices,
    /// The segments of the subject in the making.
    pub(crate) tissue: TissueWork,
    /// What lies inside of the tissue that the selected template keeps.
    pub(crate) inside: kept::Inside,
    /// A mesh file that waits for the reader's answer what it is to be.
    pub(crate) held_mesh: Option<Arc<Surface>>,
    /// Label volumes of the load under way.
    pub(crate) incoming_labels: Vec<LabelFile>,
    /// The label volumes that the shell was last told to expect.
    pub(crate) labels_expected: SegmentationsExpected,
    /// Label volumes of the document that a message has named as missing.
    pub(crate) reported_segments: Vec<SegmentsRef>,
    /// The picture shows an earlier object until the new one is on the device.
    pub(crate) is_other_uploading: bool,
    /// The title that the window was last given.
    pub(crate) window_title: String,
    /// The small picture of the open document.
    pub(crate) open_picture: OpenPicture,
    /// Since when the picture waits for something, seconds on the clock of the interface.
    pub(crate) provisional_since: Option<f64>,
}

/// What has been spoken to a screen reader so far.
#[derive(Debug, Default)]
struct Announced {
    next_notice: u64,
    step: usize,
}

impl App {
    /// In a window that eframe has made. Without a device everything works but the picture.
    pub fn new(
        cc: &eframe::CreationContext<'_>,
        services: Box<dyn Services>,
        start: Start,
    ) -> Self {
        theme::install(&cc.egui_ctx);
        cc.egui_ctx.add_plugin(slow_click::SlowClicks::default());
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
            .map(|render_state| Picture::new(render_state, start.gpu, start.clock));
        let mut session = Session::new(Document::fresh());
        let is_wished = |key| services.stored(key).as_deref() == Some("yes");
        session.is_lettering = is_wished(STORED_LETTERING);
        session.has_title = is_wished(STORED_TITLE);
        // Who comes with a document has been here before, or comes to look.
        let is_first = start.text.is_none()
            && start.link.is_none()
            && start.missing.is_none()
            && services.stored(STORED_DOCUMENT).is_none();
        session.has_less_motion = services.wants_less_motion();
        session.has_shaped_texts = services.sets_texts();
        session.has_told_slow = services.stored(STORED_SLOW).is_some();
        session.has_hint = is_first && services.stored(STORED_HINT).is_none();
        let earlier = services.stored(STORED_DOCUMENT);
        match (start.text, start.link, start.missing) {
            (Some(text), _, _) => session.open_text(&text),
            (None, Some(link), _) => session.open_link(link),
            (None, None, Some(missing)) => {
                let (text, details) = missing.in_words();
                session.notify(Gravity::Error, text, details);
            }
            (None, None, None) => {
                // A stored document that cannot be read is ignored without a message: storing is a convenience.
                let kept = services
                    .stored(STORED_DOCUMENT)
                    .and_then(|text| crate::link::decode(&text).ok());
                if let Some(link) = kept {
                    session.open_document(link.document, link.step);
                    session.is_restored = true;
                }
            }
        }
        if let Some(earlier) = earlier {
            session.keep_earlier(earlier);
        }
        session.load_subject();
        if let Some(ticket) = start.subject {
            session.instead_started(ticket);
        }
        let open_picture = OpenPicture::kept(services.stored(STORED_PICTURE));
        let mut app = Self {
            session,
            services,
            has_fingers,
            picture,
            icons: catalogue::Icons::new(&cc.egui_ctx),
            example_pictures: library::Pictures::default(),
            viewport: Viewport::default(),
            has_told_loss: false,
            pending: Vec::new(),
            focus: None,
            announced: Announced::default(),
            wants_shown_size: false,
            saving: None,
            share: share::Share::default(),
            is_narrow: false,
            incoming: SubjectBuilder::default(),
            assets: Assets::default(),
            has_clay: false,
            bending: Bending::default(),
            reference: ReferencePicture::default(),
            opened: 0,
            fields_asked: Vec::new(),
            fields_elsewhere: Vec::new(),
            resources: Resources::default(),
            transfer: transfer::Editor::default(),
            preset_pictures: presets::Pictures::default(),
            step_pictures: strip::Pictures::default(),
            slices: Slices::default(),
            tissue: TissueWork::new(start.clock),
            inside: kept::Inside::default(),
            held_mesh: None,
            incoming_labels: Vec::new(),
            labels_expected: SegmentationsExpected::default(),
            reported_segments: Vec::new(),
            is_other_uploading: false,
            provisional_since: None,
            open_picture,
            window_title: String::new(),
        };
        app.do_outside();
        if !app.session.is_restored {
            // It was of the document of the last visit, which is listed with it by now.
            app.open_picture.small = None;
        }
        app
    }

    /// The document with the present camera, for whoever embeds the app.
    pub fn document(&self) -> Document {
        self.session.document_as_seen()
    }

    /// The step that is shown; 0 is the document as it stands.
    pub fn step(&self) -> usize {
        self.session.step()
    }

    /// Index of the selected template, if one is.
    pub fn selected(&self) -> Option<usize> {
        self.session.selection.template()
    }

    /// Index of the selected object, if one is.
    pub fn selected_object(&self) -> Option<usize> {
        self.session.selection.object()
    }

    /// Names of the segments of the subject that the picture shows, those of meshes beside it too.
    pub fn segment_names(&self) -> Vec<String> {
        let shown = self.picture.as_ref().map_or(&[][..], |p| p.segments());
        shown.iter().map(|segment| segment.name.clone()).collect()
    }

    /// True when the picture is complete, nothing is being loaded and no question to the picture is open.
    pub fn is_at_rest(&self) -> bool {
        let is_picture_done = |picture: &Picture| picture.state.is_done && !picture.is_waiting();
        self.session.load.is_none()
            && !self.session.awaits_clay()
            && !self.services.is_reading()
            && !self.tissue.is_behind(&self.assets, self.session.shown())
            && !self.wants_beside()
            && !self.is_bending()
            && self.pending.is_empty()
            && self.session.library.listing != Listing::Asked
            && !self.viewport.is_waiting()
            && !(self.session.view.is_split && self.slices.is_waiting())
            && !self.preset_pictures.is_waiting()
            && !self.step_pictures.is_waiting(&self.session)
            && self.picture.as_ref().is_none_or(is_picture_done)
    }

    /// True if Ctrl and F find a tissue: no sheet lies over the panels.
    pub fn finds_tissues(&self) -> bool {
        !self.is_sheet_open()
    }

    fn is_sheet_open(&self) -> bool {
        self.session.is_keys_sheet_open
            || self.session.is_share_open
            || self.session.is_messages_open
            || self.session.library.is_open
            || self.session.raw_draft().is_some()
            || self.session.is_asking_about_mesh()
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

    /// Goes to the field of a caption, by its number, as a click on its text in the picture does.
    pub fn edit_caption(&mut self, caption: usize) {
        // In a picture alone there is no field to go to.
        if !self.session.are_panels_hidden && caption < self.session.shown().captions.len() {
            self.run(Command::EditCaption(caption));
        }
    }

    /// Runs a command as if a button had been pressed.
    pub fn run(&mut self, command: Command) {
        let effects = self.session.run(command, self.session.now);
        self.perform(effects);
    }

    /// Tells the shell once the document's subject is no clay any more.
    fn let_clay_go(&mut self) {
        let has_clay = matches!(self.session.shown().subject, SubjectRef::Clay(_));
        if std::mem::replace(&mut self.has_clay, has_clay) && !has_clay {
            self.services.let_clay_go();
        }
    }

    // ------------------------------------------------------------------------------------------------ effects

    /// Does what the session wants done since the last time.
    pub(crate) fn do_outside(&mut self) {
        let effects = self.session.take_effects();
        self.perform(effects);
    }

    /// Does what goes to the surroundings at once; what needs the window waits for the end of the frame.
    fn perform(&mut self, effects: Vec<Effect>) {
        let services = self.services.as_mut();
        let (mut located, mut recent) = (Vec::new(), Vec::new());
        let mut mesh = None;
        for effect in effects {
            match effect {
                Effect::LoadSubject(subject) => {
                    let mut want = self.assets.subject_want(&subject);
                    want.is_sketch = self.session.wants_sketch();
                    self.assets.asked_for(&want);
                    let ticket = services.load(&want);
                    self.session.load_started(ticket);
                }
                Effect::CancelLoad(ticket) => services.cancel_load(ticket),
                Effect::AllowHost(ticket) => services.allow_host(ticket),
                Effect::AllowFields(host) => {
                    services.allow_fields(&host);
                    // They are missing still, and are asked for anew.
                    let allowed = self.fields_elsewhere.extract_if(.., |(on, _)| *on == host);
                    for (_, want) in allowed {
                        self.fields_asked.retain(|asked| *asked != want);
                    }
                }
                Effect::AnswerRaw(ticket, voxels) => services.answer_raw(ticket, &voxels),
                Effect::ShowMesh(sha256) => mesh = Some(sha256),
                Effect::DropMesh => self.held_mesh = None,
                Effect::StopTissues => self.tissue.stop(&self.assets, self.session.shown()),
                Effect::FindTissues => self.tissue.find(),
                Effect::StopBending => services.stop_bending(),
                Effect::GoOnBending => self.bending.go_on(),
                Effect::OpenFile => services.open_file(),
                Effect::Save(file) => services.save_file(file),
                Effect::SaveMesh(format) => {
                    let shown = self.session.shown();
                    let want = self.assets.subject_want(&shown.subject_shown());
                    let title = shown.title.clone();
                    let mesh = MeshToSave {
                        writing: Writing { format, title },
                        name: format!("{}.{}", self.session.file_stem(), format.extension()),
                    };
                    services.save_mesh(&want, mesh);
                }
                Effect::Copy(text) => services.copy_text(text),
                Effect::CopyLink(tail) => {
                    let page = services.page_address();
                    let page = page.split('#').next().unwrap_or_default();
                    services.copy_text(format!("{page}#{tail}"));
                }
                Effect::CopySnippet(form) => {
                    let page = services.page_address();
                    services.copy_text(self.session.snippet(form, &page));
                }
                Effect::Paste => services.paste_text(),
                Effect::SetLink(tail, change) => services.set_link(&tail, change),
                Effect::Store(key, value) => services.store(key, &value),
                Effect::FetchShipped(file) => services.fetch_shipped(file),
                Effect::Recent(change) => recent.push(change),
                Effect::Ask(question) => self.viewport.take_question(question),
                Effect::Locate(sought) => located.push(sought),
                Effect::Focus(focus) => self.focus = Some(focus),
                Effect::SavePicture
                | Effect::StopSaving
                | Effect::ToggleTheme
                | Effect::ToggleContrast
                | Effect::Scale(_) => self.pending.push(effect),
            }
        }
        if let Some(sha256) = mesh {
            self.show_held_mesh(sha256);
        }
        for change in recent {
            self.change_recent(&change);
        }
        for sought in located {
            let site = self.site_of(&sought);
            self.run(Command::TurnTo(sought, site));
        }
    }

    /// Where something lies: a caption where its tissue is now, a segment in the untouched subject, as it is shown
    /// alone for a moment.
    fn site_of(&self, sought: &Sought) -> Option<Site> {
        match sought {
            Sought::Tissue(name) => self.tissue.segmentation(&self.assets)?.site_of(name),
            Sought::Caption(index) => {
                let places = self.viewport.caption_places();
                let seen = places.get(*index).copied().flatten();
                let caption = self.session.shown().captions.get(*index)?;
                Some(Site::point(seen.map_or(caption.at, |(place, _)| place)))
            }
        }
    }

    /// Does in the window what had to wait for the end of the frame.
    fn perform_in_window(&mut self, ui: &Ui) {
        let ctx = ui.ctx();
        for effect in std::mem::take(&mut self.pending) {
            match effect {
                Effect::ToggleTheme => {
                    let is_dark = ctx.theme() == egui::Theme::Dark;
                    let (theme, name) = match is_dark {
                        true => (egui::Theme::Light, "light"),
                        false => (egui::Theme::Dark, "dark"),
                    };
                    ctx.set_theme(theme);
                    self.services.store(STORED_THEME, name);
                }
                Effect::ToggleContrast => {
                    let is_high = !theme::has_contrast();
                    theme::set_contrast(ctx, is_high);
                    let kept = if is_high { "high" } else { "usual" };
                    self.services.store(STORED_CONTRAST, kept);
                    ctx.request_repaint();
                }
                Effect::Scale(factor) => {
                    ctx.set_zoom_factor((ctx.zoom_factor() * factor).clamp(0.6, 3.0));
                }
                Effect::SavePicture => self.start_saving(ui.ctx()),
                Effect::StopSaving => self.stop_saving(),
                // The rest is done at once.
                _ => {}
            }
        }
    }

    // ------------------------------------------------------------------------------------------------ frame

    fn frame(&mut self, ui: &mut Ui) {
        let now = ui.input(|i| i.time);
        if ui.ctx().cumulative_frame_nr() == 0 {
            theme::warm(ui);
        }
        self.take_messages();
        self.session.is_reading = self.services.is_reading();
        self.session.pen = self.services.pen();
        self.follow_resources();
        self.advance_tissue(ui);
        if self.session.advance(now) || self.bending.is_easing() {
            ui.ctx().request_repaint();
        }
        for file in viewport::dropped(ui) {
            self.services.drop_file(file);
        }
        if let Some(text) = viewport::pasted(ui) {
            self.session.open_text(&text);
        }
        self.session.follow_clay();
        self.do_outside();
        self.let_clay_go();
        self.session.is_alone = ui.input(|i| i.modifiers.shift);
        let mut commands = Vec::new();
        self.keys(ui, &mut commands);
        // The panel sets this anew if it is shown in this frame.
        self.transfer.has_keyboard = false;

        self.is_narrow = ui.available_width() < NARROW;
        self.session.are_drawers = self.is_narrow;
        theme::set_touch(ui.ctx(), self.is_narrow || self.has_fingers);
        if self.is_narrow {
            self.narrow_ui(ui, &mut commands);
        } else {
            self.wide_ui(ui, &mut commands);
        }
        if self.session.is_keys_sheet_open {
            keys::ui(ui, &mut commands);
        }
        if self.session.is_share_open {
            let page = self.services.page_address();
            share::ui(ui, &self.session, &mut self.share, &page, &mut commands);
        }
        if self.session.is_messages_open {
            notice::messages_ui(ui, &self.session, &mut commands);
        }

        if self.session.library.is_open {
            library::ui(ui, &self.session, &mut self.example_pictures, &mut commands);
        }
        frames::ui(ui, &self.session, &mut commands);
        let reference = &mut self.reference;
        figure::reference::ui(ui, &self.session, reference, &mut commands);
        raw::ui(ui, &self.session, &mut commands);
        dropped::ui(ui, &self.session, &mut commands);

        // A drag is one step of undo: it ends when nothing is held any more.
        if !ui.input(|i| i.pointer.any_down())
            && !ui.ctx().text_edit_focused()
            && commands.is_empty()
        {
            if self.session.is_passing() {
                // A figure that followed a handle comes to rest.
                ui.ctx().request_repaint();
            }
            self.session.end_drag();
        }
        // The field was there to take it in this frame.
        self.focus
            .take_if(|focus| matches!(focus, Focus::Search | Focus::Tissues));
        let has_commands = !commands.is_empty();
        let before = self.session.tool();
        for command in commands {
            let effects = self.session.run(command, now);
            self.perform(effects);
        }
        let tool = self.session.tool();
        if tool.wants_place() && tool != before {
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
        let [has_press, has_key] = ui.input(|i| ends(&i.events));
        if has_press || (has_key && has_commands) {
            // The controls are laid out again in this very frame: they show what was done a frame earlier, and the next
            // press, which may come before that, meets them as they now are.
            ui.ctx().request_discard("what is shown has changed");
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
        let mut is_typing = ui.ctx().text_edit_focused()
            || matches!(
                self.focus,
                Some(Focus::Search | Focus::Tissues | Focus::Title)
            );
        let has_arrows = viewport::has_arrows(ui, self.picture_id(ui));
        let is_sheet_open = self.is_sheet_open();
        let is_shaping = self.session.has_hand();
        if !is_typing && !is_sheet_open {
            ui.input(|i| {
                commands.extend(i.events.iter().filter_map(|event| match event {
                    egui::Event::Copy => Some(Command::Copy),
                    egui::Event::Cut => Some(Command::Cut),
                    _ => None,
                }));
            });
            // A slow frame may hold the words too: the field is there to take them in this very frame.
            if !is_shaping && let Some(search) = ui.input_mut(|i| take_search(&mut i.events)) {
                is_typing = true;
                self.run(search);
            }
        }
        for shortcut in shortcuts::shortcuts() {
            if shortcuts::is_of_clipboard(&shortcut.command) {
                continue;
            }
            let key = shortcut.keys.logical_key;
            let is_plain = !shortcut.keys.modifiers.command;
            // Letters belong to a text field, arrows to whatever control has the keyboard. A dot does nothing by Enter.
            let is_enter_of_dot = key == egui::Key::Enter && points::has_keyboard(ui);
            let is_widgets = viewport::is_widget_key(key) && !has_arrows && !is_enter_of_dot;
            if is_plain && (is_typing || is_widgets) {
                continue;
            }
            // A point of the transfer function and a dot in the picture are removed by the same keys as a template.
            let is_delete = matches!(key, egui::Key::Delete | egui::Key::Backspace);
            if is_delete && (self.transfer.has_keyboard || points::has_keyboard(ui)) {
                continue;
            }
            // A slice is scrolled by the keys that order templates.
            if self.slices.has_keyboard && matches!(key, egui::Key::PageUp | egui::Key::PageDown) {
                continue;
            }
            // Held, they size and turn the tool that shapes the clay.
            if is_shaping && is_plain && matches!(key, egui::Key::F | egui::Key::R) {
                continue;
            }
            if is_sheet_open && !matches!(shortcut.command, Command::ToggleKeys | Command::Escape) {
                continue;
            }
            let takes_enter = is_shaping || self.session.tool().wants_place();
            if key == egui::Key::Enter && !takes_enter {
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
        self.tell_title();
        let services = self.services.as_mut();
        if services.sets_texts()
            && self
                .viewport
                .show_outside(|texts| services.show_texts(texts))
        {
            ui.ctx().request_repaint();
        }
        self.perform_in_window(ui);
        let ctx = ui.ctx();
        self.advance_saving();
        let is_held = ui.input(|i| i.pointer.any_down());
        let picture = self.picture.as_ref();
        self.preset_pictures
            .advance(ctx, &self.session, picture, is_held);
        let drawing = (picture, &mut self.bending);
        self.step_pictures
            .advance(ctx, &self.session, drawing, is_held);
        if let Some(picture) = &mut self.picture {
            for notice in picture.take_notices() {
                // A file that is not there yet may be on its way.
                let is_early = self.tissue.is_behind(&self.assets, self.session.shown());
                if !(is_early && matches!(notice, RenderNotice::UnknownKept(_))) {
                    let line = notice.to_string();
                    self.session.notify(Gravity::Warning, line, "");
                }
            }
            if picture.is_waiting() {
                ctx.request_repaint();
            }
            let whole_seconds = picture.state.whole_seconds;
            self.session.take_pace(whole_seconds);
            self.look_after_device();
        }
        self.see_closer(ctx);
        self.advance_open_picture(&ctx.clone());
        if let Some(seconds) = self.session.seconds_to_next_change() {
            ctx.request_repaint_after(Duration::from_secs_f64(seconds));
        }
    }

    /// Speaks new messages, the step that was reached, and the control that has the keyboard or was changed.
    fn announce(&mut self, ui: &Ui) {
        if let Some(text) = widget::spoken(ui) {
            self.services.announce(&text);
        }
        for notice in self.session.notices.all() {
            if notice.id >= self.announced.next_notice {
                self.announced.next_notice = notice.id + 1;
                self.services.announce(&notice.message);
            }
        }
        let step = self.session.step();
        if step != std::mem::replace(&mut self.announced.step, step)
            && let Some(text) = steps::spoken(&self.session)
        {
            self.services.announce(&text);
        }
    }

    /// A message tells once that the device is lost; the shell makes another window for the same document.
    fn look_after_device(&mut self) {
        let lost = self
            .picture
            .as_ref()
            .and_then(|picture| picture.gpu().lost());
        if let Some(reason) = lost.filter(|_| !self.has_told_loss) {
            self.has_told_loss = true;
            self.session
                .notify(Gravity::Error, words::messages::w().device_lost, reason);
        }
    }
}

impl eframe::App for App {
    fn ui(&mut self, ui: &mut Ui, _frame: &mut eframe::Frame) {
        self.frame(ui);
    }

    fn clear_color(&self, visuals: &egui::Visuals) -> [f32; 4] {
        visuals.panel_fill.to_normalized_gamma_f32()
    }
}

/// Whether a button was let go, and whether a key was pressed: no parts of a movement, in which many commands follow
/// each other.
fn ends(events: &[egui::Event]) -> [bool; 2] {
    use egui::Event::{Key, PointerButton};
    let has = |is: fn(&egui::Event) -> bool| events.iter().any(is);
    [
        has(|event| matches!(event, PointerButton { pressed: false, .. })),
        has(|event| matches!(event, Key { pressed: true, .. })),
    ]
}

/// Removes the key that starts a search and all events before that key from the events of a frame; text that was typed
/// after the key stays. Returns what the key does; nothing if no such key was pressed.
fn take_search(events: &mut Vec<egui::Event>) -> Option<Command> {
    let starts = |event: &egui::Event| match event {
        egui::Event::Key {
            key,
            pressed: true,
            modifiers,
            ..
        } if !(modifiers.ctrl || modifiers.alt || modifiers.command) => match key {
            egui::Key::Slash => Some((Command::StartSearch, "/")),
            egui::Key::F => Some((Command::StartSeeking, "f")),
            _ => None,
        },
        _ => None,
    };
    let found = events.iter().enumerate();
    let (at, (command, letter)) = found
        .filter_map(|(i, event)| Some((i, starts(event)?)))
        .next()?;
    let is_its_text = |i: usize| matches!(events.get(i), Some(egui::Event::Text(text)) if text.eq_ignore_ascii_case(letter));
    // The letter that the key writes comes before the key or after it.
    let is_before = at.checked_sub(1).is_some_and(is_its_text);
    let end = at + usize::from(!is_before && is_its_text(at + 1));
    events.drain(..=end);
    Some(command)
}
