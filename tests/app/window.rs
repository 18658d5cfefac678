//! The app in a window that nobody sees, with surroundings that keep what it asks of them.
//!
//! With `FABRICA_LOOK_AT=folder` the windows are written there as PNG, to be looked at.

use super::*;
use eframe::egui_wgpu::{WgpuSetup, WgpuSetupExisting};
use fabrica::app::{SetText, TextOver, TextToSet};
use fabrica::assets::{BendAnswer, BendPose, BendRequest, Role, Source, Want};
use fabrica::document::Clay;
use fabrica::load::{
    FileSet, LabelSource, LoadReport, MemoryFiles, ReadOptions, read_label_file, read_subject,
};
use fabrica::render::Gpu;
use fabrica::shell::bending::{Desk, make_figure};
use fabrica::shell::clays::{ClayDesk, Purpose, make_clay, make_clay_of_file};
use fabrica::shell::figures::read_figure;
use std::sync::OnceLock;

/// What the app asked of its surroundings.
#[derive(Default)]
pub(crate) struct Log {
    pub(crate) copied: Vec<String>,
    pub(crate) saved: Vec<SaveFile>,
    pub(crate) links: Vec<(String, LinkChange)>,
    pub(crate) stored: BTreeMap<String, String>,
    pub(crate) loads: Vec<Want>,
    pub(crate) answered_raw: Vec<(Ticket, RawVoxels)>,
    pub(crate) cancelled: Vec<Ticket>,
    /// How often a clay was let go.
    pub(crate) clays_gone: usize,
    pub(crate) allowed: Vec<Ticket>,
    /// Displacement fields that were asked for.
    pub(crate) fields: Vec<Want>,
    /// Hosts that the reader lets fields come from.
    pub(crate) field_hosts: Vec<String>,
    pub(crate) dialogs: usize,
    pub(crate) queue: Vec<Message>,
    pub(crate) next_ticket: u64,
    /// Loads are answered only when a test does it itself.
    pub(crate) is_slow: bool,
    /// The shell reads a file of which it is not yet known what it is.
    pub(crate) is_reading: bool,
    /// Files that there are, by their addresses.
    pub(crate) files: Vec<(String, Vec<u8>)>,
    /// Files of the program that were asked for.
    pub(crate) fetched: Vec<fabrica::app::Shipped>,
    /// The window has a pixel for each point, for tests that look at small things in it.
    pub(crate) is_fine: bool,
    /// Files of the program do not come.
    pub(crate) is_offline: bool,
    /// A load that was started in place of the document's subject.
    pub(crate) instead: Option<Ticket>,
    /// The document that was asked for and could not be had.
    pub(crate) missing: Option<MissingDocument>,
    /// The title that the window was last given.
    pub(crate) title: String,
    /// The clock that the renderer measures itself with, in place of the usual one. With one of its own the reader has
    /// not yet been told that this device is slow.
    pub(crate) clock: Option<fn() -> f64>,
    /// What a screen reader was to speak.
    pub(crate) said: Vec<String>,
    /// Letters that the window's fonts lack are boxes, as for a user, and no fault.
    pub(crate) has_other_letters: bool,
    /// The surroundings set texts, as a page does, each in this size.
    pub(crate) sets_texts: Option<Vec2>,
    /// The texts that they show over the picture.
    pub(crate) over: Vec<TextOver>,
    /// Those that they have set for pictures.
    pub(crate) set: RefCell<Vec<TextToSet>>,
    /// Bends figures.
    pub(crate) desk: Desk,
    /// How often a figure was bent at rest, and how often it followed.
    pub(crate) bends: [usize; 2],
}

impl Log {
    /// A file that the user opened begins to load.
    pub(crate) fn file_starts(&mut self, ticket: Ticket) {
        self.queue.push(Message::FileStarted { ticket });
    }
}

#[derive(Clone, Default)]
pub(crate) struct Fake(pub(crate) Rc<RefCell<Log>>);

impl Fake {
    /// Surroundings of a window that is looked at closely.
    pub(crate) fn fine() -> Self {
        let fake = Self::default();
        fake.0.borrow_mut().is_fine = true;
        fake
    }

    /// A file that the user opened begins to load.
    pub(crate) fn file_starts(&self, ticket: Ticket) {
        self.0.borrow_mut().file_starts(ticket);
    }

    /// As if it had been kept from the last time.
    pub(crate) fn store_value(&self, key: &str, value: &str) {
        let mut log = self.0.borrow_mut();
        log.stored.insert(key.to_owned(), value.to_owned());
    }
}

impl Log {
    /// Shapes a clay as the shells do, of one of its files where it begins with a file.
    fn shape(&mut self, clay: &Arc<Clay>, want: &Want, ticket: Ticket) {
        let mut files = MemoryFiles::new(self.files.clone());
        let is_it = |(name, bytes): &&(String, Vec<u8>)| match want.src() {
            Some(src) => name == src,
            None => want.check(&segment_files::hash(bytes)).is_ok(),
        };
        let name = self.files.iter().find(is_it).map(|(name, _)| name.clone());
        let (mut desk, queue) = (ClayDesk::default(), &mut self.queue);
        let mut post = |event: LoadEvent| {
            queue.push(Message::Load { ticket, event });
            true
        };
        let purpose = Purpose::of(want);
        match name {
            _ if !want.has_file() => make_clay(&mut desk, clay, &purpose, &mut post),
            Some(name) => {
                let file: (&mut dyn FileSet, &str) = (&mut files, &name);
                make_clay_of_file(&mut desk, clay, file, &purpose, &mut post);
            }
            None => {
                let message = fabrica::shell::loading::wanted_file(want.name());
                let (details, fault) = (String::new(), None);
                post(LoadEvent::Failed {
                    message,
                    details,
                    fault,
                });
            }
        }
    }

    /// Reads one of its files as the shells do.
    pub(crate) fn read(&mut self, name: &str, role: Role, ticket: Ticket) {
        let mut files = MemoryFiles::new(self.files.clone());
        let options = ReadOptions::default();
        let mut report = LoadReport::default();
        let outcome = match role {
            Role::Segments => read_label_file(&mut files, name, &options).map(|file| {
                let event = LoadEvent::LabelFile(Box::new(file));
                self.queue.push(Message::Load { ticket, event });
                None
            }),
            _ if fabrica::figure::is_figure_name(name) => {
                let sink = &mut Queue(self, ticket);
                read_figure(&mut files, name, sink, &mut report).map(|()| report.sha256_hex())
            }
            _ => {
                let own = LabelSource::default();
                let sink = &mut Queue(self, ticket);
                read_subject(&mut files, name, &own, &options, sink, &mut report)
                    .map(|()| report.sha256_hex())
            }
        };
        let event = match outcome {
            Ok(sha256) => LoadEvent::Done { sha256 },
            Err(error) => LoadEvent::Failed {
                message: error.to_string(),
                details: String::new(),
                fault: error.fault(),
            },
        };
        self.queue.push(Message::Load { ticket, event });
    }
}

/// Voxels along the subject: small, since lavapipe draws it.
pub(crate) const RESOLUTION: u32 = 48;
/// The same for the head when somebody looks.
pub(crate) const HEAD_RESOLUTION: u32 = 144;

pub(crate) struct Queue<'a>(pub(crate) &'a mut Log, pub(crate) Ticket);

impl Queue<'_> {
    fn push(&mut self, event: LoadEvent) {
        self.0.queue.push(Message::Load {
            ticket: self.1,
            event,
        });
    }
}

impl SubjectSink for Queue<'_> {
    fn take(&mut self, part: SubjectPart) -> Result<(), String> {
        self.push(LoadEvent::Part(part));
        Ok(())
    }
    fn progress(&mut self, _: f32) -> bool {
        true
    }
}

impl Services for Fake {
    fn poll(&mut self) -> Vec<Message> {
        std::mem::take(&mut self.0.borrow_mut().queue)
    }
    fn open_file(&mut self) {
        self.0.borrow_mut().dialogs += 1;
    }
    fn drop_file(&mut self, _: egui::DroppedFileHandle) {}
    fn load(&mut self, want: &Want) -> Ticket {
        let log = &mut *self.0.borrow_mut();
        log.next_ticket += 1;
        let ticket = Ticket(log.next_ticket);
        log.loads.push(want.clone());
        if !log.is_slow
            && let Source::Builtin { name, .. } = &want.source
        {
            let resolution = if name == "head" && std::env::var_os("FABRICA_LOOK_AT").is_some() {
                HEAD_RESOLUTION
            } else {
                RESOLUTION
            };
            let generated = match (want.role, fabrica::subjects::tool(name)) {
                (Role::Object, Some(mesh)) => {
                    let surface = fabrica::data::Surface::new(&mesh, None, &mut |_| true);
                    let surface = Arc::new(surface.expect("it has a size"));
                    let event = LoadEvent::Part(SubjectPart::Surface(surface));
                    log.queue.push(Message::Load { ticket, event });
                    Ok(())
                }
                _ if fabrica::document::is_drawn_name(name) => {
                    let mut post = |event: LoadEvent| {
                        log.queue.push(Message::Load { ticket, event });
                        true
                    };
                    make_figure(name, &mut post);
                    return ticket;
                }
                _ => fabrica::subjects::generate(name, resolution, &mut Queue(log, ticket)),
            };
            let event = match generated {
                Ok(()) => LoadEvent::Done { sha256: None },
                Err(error) => LoadEvent::Failed {
                    message: error.to_string(),
                    details: String::new(),
                    fault: None,
                },
            };
            log.queue.push(Message::Load { ticket, event });
        }
        if !log.is_slow
            && let Source::Clay(clay) = &want.source
        {
            log.shape(clay, want, ticket);
        } else if !log.is_slow
            && let Some(src) = want.src()
        {
            log.read(src, want.role, ticket);
        }
        ticket
    }
    fn bend(&mut self, request: BendRequest) {
        let log = &mut *self.0.borrow_mut();
        match request.pose {
            BendPose::AtRest => log.bends[0] += 1,
            BendPose::Following(_) => log.bends[1] += 1,
            BendPose::Aside | BendPose::Finer => {}
        }
        let answer = match log.is_slow {
            true => BendAnswer::UnderWay(0.4),
            false => log.desk.answer(request, &mut |_| true),
        };
        log.queue.push(Message::Bent(answer));
    }
    fn stop_bending(&mut self) {
        let stopped = Message::Bent(BendAnswer::Stopped);
        self.0.borrow_mut().queue.push(stopped);
    }
    fn fetch_shipped(&mut self, file: fabrica::app::Shipped) {
        use fabrica::app::Shipped;
        let log = &mut *self.0.borrow_mut();
        log.fetched.push(file);
        let bytes: &[u8] = match file {
            Shipped::Examples => include_bytes!("../../web/examples/list.json"),
            Shipped::ExamplePictures => include_bytes!("../../web/examples/pictures.png"),
        };
        let outcome = match log.is_offline {
            true => Err("offline".to_owned()),
            false => Ok(bytes.to_vec()),
        };
        log.queue.push(Message::Shipped { file, outcome });
    }
    fn is_reading(&self) -> bool {
        self.0.borrow().is_reading
    }
    fn allow_host(&mut self, ticket: Ticket) {
        self.0.borrow_mut().allowed.push(ticket);
    }
    fn load_field(&mut self, want: &Want) {
        let log = &mut *self.0.borrow_mut();
        log.fields.push(want.clone());
        let host = want.src().and_then(|src| src.strip_prefix("https://"));
        let host = host.and_then(|rest| Some(rest.split_once('/')?.0.to_owned()));
        if let Some(host) = host.filter(|host| !log.field_hosts.contains(host)) {
            let want = want.clone();
            log.queue.push(Message::AskFieldHost { want, host });
        }
    }
    fn allow_fields(&mut self, host: &str) {
        self.0.borrow_mut().field_hosts.push(host.to_owned());
    }
    fn answer_raw(&mut self, ticket: Ticket, raw: &RawVoxels) {
        self.0.borrow_mut().answered_raw.push((ticket, raw.clone()));
    }
    fn cancel_load(&mut self, ticket: Ticket) {
        let log = &mut *self.0.borrow_mut();
        log.cancelled.push(ticket);
        log.queue.push(Message::Load {
            ticket,
            event: LoadEvent::Cancelled,
        });
    }
    fn let_clay_go(&mut self) {
        self.0.borrow_mut().clays_gone += 1;
    }
    fn save_file(&mut self, file: SaveFile) {
        let log = &mut *self.0.borrow_mut();
        log.queue
            .push(Message::Saved(Ok(SavedTo::Downloads(file.name.clone()))));
        log.saved.push(file);
    }
    fn copy_text(&mut self, text: String) {
        let log = &mut *self.0.borrow_mut();
        log.copied.push(text);
        log.queue.push(Message::Copied(Ok(())));
    }
    fn paste_text(&mut self) {
        let log = &mut *self.0.borrow_mut();
        let text = log.copied.last().cloned();
        log.queue.push(Message::Pasted(text));
    }
    fn page_address(&self) -> String {
        "https://fabrica.example/#old".to_owned()
    }
    fn set_link(&mut self, payload: &str, change: LinkChange) {
        self.0.borrow_mut().links.push((payload.to_owned(), change));
    }
    fn set_title(&mut self, title: &str) {
        title.clone_into(&mut self.0.borrow_mut().title);
    }
    fn announce(&mut self, text: &str) {
        self.0.borrow_mut().said.push(text.to_owned());
    }
    fn store(&mut self, key: &str, value: &str) {
        self.0
            .borrow_mut()
            .stored
            .insert(key.to_owned(), value.to_owned());
    }
    fn sets_texts(&self) -> bool {
        self.0.borrow().sets_texts.is_some()
    }
    fn show_texts(&mut self, texts: &[TextOver]) -> Vec<Vec2> {
        let log = &mut *self.0.borrow_mut();
        log.over = texts.to_vec();
        vec![log.sets_texts.unwrap_or_default(); texts.len()]
    }
    fn set_text(&self, text: &TextToSet) -> Option<SetText> {
        let log = self.0.borrow();
        log.sets_texts?;
        log.set.borrow_mut().push(text.clone());
        // A block in place of letters.
        let size = [200, 30];
        Some(SetText {
            size,
            coverage: vec![255; 6000],
        })
    }
    fn stored(&self, key: &str) -> Option<String> {
        let log = self.0.borrow();
        // The machine of the tests is slow; what they look at is something else.
        let told = (key == "slow" && log.clock.is_none()).then(|| "told".to_owned());
        log.stored.get(key).cloned().or(told)
    }
}

pub(crate) fn clock() -> f64 {
    std::time::SystemTime::now()
        .duration_since(std::time::UNIX_EPOCH)
        .map_or(0.0, |since| since.as_secs_f64())
}

/// Wide enough for the slices beside the picture.
pub(crate) const FOUR: Vec2 = Vec2::new(1100.0, 700.0);

/// Small, since lavapipe draws it; 1280 by 800 to be looked at.
pub(crate) const DESK: Vec2 = if option_env!("FABRICA_LOOK_AT").is_some() {
    Vec2::new(1280.0, 800.0)
} else {
    Vec2::new(940.0, 700.0)
};

/// Coarse windows are a quarter of the work for the software device, with the same layout.
const COARSE: f32 = 0.5;

/// The software device of all windows of the process, which share its programs: compiling them takes longer than most
/// tests.
fn shared_device() -> (WgpuSetupExisting, Gpu) {
    static DEVICE: OnceLock<(WgpuSetupExisting, Gpu)> = OnceLock::new();
    let device = DEVICE.get_or_init(|| {
        let mut setup = match egui_kittest::wgpu::default_wgpu_setup() {
            WgpuSetup::CreateNew(setup) => setup,
            other => panic!("the harness makes its own device, not {other:?}"),
        };
        setup.device_descriptor = Arc::new(Gpu::device_descriptor);
        // Each window would open and close OpenGL too, only to name it; windows in two threads that do so at once end
        // in a panic of the driver's.
        let backends = &mut setup.instance_descriptor.backends;
        backends.remove(wgpu::Backends::GL);
        let options = eframe::egui_wgpu::RendererOptions::PREDICTABLE;
        let made = egui_kittest::wgpu::create_render_state(WgpuSetup::CreateNew(setup), options);
        let (device, queue, info) = (made.device, made.queue, made.adapter.get_info());
        let gpu = Gpu::from_parts(device.clone(), queue.clone(), info);
        let setup = WgpuSetupExisting {
            instance: made.instance,
            adapter: made.adapter,
            device,
            queue,
        };
        (setup, gpu)
    });
    device.clone()
}

/// The app in a window of a size, on the software device.
pub(crate) struct Window {
    pub(crate) harness: Harness<'static, App>,
    pub(crate) log: Fake,
}

pub(crate) const CUBE: &str = r#"{ "fabrica": 1, "subject": { "builtin": "cube" } }"#;

impl Window {
    pub(crate) fn open(size: Vec2, json: &str) -> Self {
        Self::open_with(size, egui::Theme::Light, Fake::default(), Some(json))
    }

    pub(crate) fn open_with(size: Vec2, theme: egui::Theme, log: Fake, text: Option<&str>) -> Self {
        let (setup, gpu) = shared_device();
        let is_fine = log.0.borrow().is_fine || std::env::var_os("FABRICA_LOOK_AT").is_some();
        let services = log.clone();
        let text = text.map(str::to_owned);
        let instead = log.0.borrow().instead;
        let missing = log.0.borrow().missing.clone();
        let own_clock = log.0.borrow().clock;
        // A software GPU takes the longest for the other samples of a finished picture.
        let has_all_samples = own_clock.is_some() || std::env::var_os("FABRICA_LOOK_AT").is_some();
        let gpu = gpu.with_samples((!has_all_samples).then_some(1));
        let builder = match log.0.borrow().has_other_letters {
            true => Harness::builder().allow_missing_glyphs(),
            false => Harness::builder(),
        };
        let harness = builder
            .with_size(size)
            .with_pixels_per_point(if is_fine { 1.0 } else { COARSE })
            .with_theme(theme)
            .with_max_steps(2000)
            .renderer(WgpuTestRenderer::from_setup(WgpuSetup::Existing(setup)))
            .build_eframe(|cc| {
                let start = Start {
                    link: None,
                    text,
                    missing,
                    subject: instead,
                    gpu: Some(gpu),
                    clock: own_clock.unwrap_or(clock),
                };
                App::new(cc, Box::new(services), start)
            });
        let mut window = Self { harness, log };
        window.settle();
        window
    }

    /// Goes on until the picture is complete and the link is renewed.
    pub(crate) fn settle(&mut self) {
        // Waits for no answer that never comes.
        let patience = clock()
            + if self.log.0.borrow().is_slow {
                0.2
            } else {
                120.0
            };
        self.harness.step();
        while clock() < patience && !self.harness.state().is_at_rest() {
            self.harness.step();
            std::thread::sleep(std::time::Duration::from_millis(2));
        }
        // The link follows after a while on the clock of the interface, 1/60 s a step.
        self.harness.run_steps(40);
    }

    pub(crate) fn steps(&mut self, n: usize) {
        self.harness.run_steps(n);
    }

    pub(crate) fn click(&mut self, label: &str) {
        self.harness.get_by_label(label).click();
        self.steps(3);
    }

    /// Chooses an entry of a list that opens.
    pub(crate) fn choose(&mut self, list: &str, entry: &str) {
        let list = self
            .harness
            .get_by_role_and_label(egui::accesskit::Role::ComboBox, list);
        list.click();
        self.steps(3);
        self.click(entry);
    }

    pub(crate) fn document(&self) -> Document {
        self.harness.state().document()
    }

    pub(crate) fn press(&mut self, key: Key) {
        self.harness.key_press(key);
        self.steps(3);
    }

    pub(crate) fn press_with(&mut self, modifiers: Modifiers, key: Key) {
        self.harness.key_press_modifiers(modifiers, key);
        self.steps(3);
    }

    pub(crate) fn undo(&mut self) {
        self.press_with(Modifiers::COMMAND, Key::Z);
    }

    /// Runs a command as a button does.
    pub(crate) fn run_command(&mut self, command: fabrica::app::Command) {
        self.harness.state_mut().run(command);
        self.steps(2);
    }

    /// Types into the field of this name, in place of what stands there.
    pub(crate) fn type_into(&mut self, field: &str, text: &str) {
        self.click(field);
        self.press_with(Modifiers::COMMAND, Key::A);
        self.harness.event(egui::Event::Text(text.to_owned()));
        self.steps(2);
        self.press(Key::Enter);
        self.steps(2);
    }

    /// Pictures are saved as small as the tests can look at them: those of the usual size take a software GPU the
    /// longest.
    pub(crate) fn save_small_pictures(&mut self) {
        self.run_command(fabrica::app::Command::SetPictureSize(Some(800)));
    }

    /// Saves the picture by its keys and returns it.
    pub(crate) fn saved_picture(&mut self) -> image::RgbaImage {
        let before = self.log.0.borrow().saved.len();
        self.press_with(Modifiers::COMMAND | Modifiers::SHIFT, Key::S);
        let patience = clock() + 120.0;
        while clock() < patience && self.log.0.borrow().saved.len() == before {
            self.steps(1);
        }
        let log = self.log.0.borrow();
        let file = log.saved.get(before).expect("a picture was saved");
        let picture = image::load_from_memory(&file.bytes).expect("a PNG");
        picture.to_rgba8()
    }

    pub(crate) fn picture_center(&self) -> Pos2 {
        self.harness.get_by_role(egui::Role::Image).rect().center()
    }

    pub(crate) fn click_at(&mut self, pos: Pos2) {
        self.harness.hover_at(pos);
        self.harness.step();
        self.harness.drag_at(pos);
        self.harness.step();
        self.harness.drop_at(pos);
        self.settle();
    }

    pub(crate) fn double_click_at(&mut self, pos: Pos2) {
        self.harness.hover_at(pos);
        self.harness.step();
        // A step takes a quarter of a second, which is too long between two clicks.
        let start = self.harness.ctx.input(|i| i.time);
        for i in 0..4 {
            if i % 2 == 0 {
                self.harness.drag_at(pos);
            } else {
                self.harness.drop_at(pos);
            }
            self.harness.input_mut().time = Some(start + 0.02 * f64::from(i + 1));
            self.harness.step();
        }
        self.harness.input_mut().time = None;
        self.settle();
    }

    pub(crate) fn drag(&mut self, from: Pos2, by: Vec2) {
        self.drag_on(from, by, 6);
        self.harness.drop_at(from + by);
        self.settle();
    }

    /// A drag of so many moves that has not ended.
    pub(crate) fn drag_on(&mut self, from: Pos2, by: Vec2, moves: u16) {
        self.harness.hover_at(from);
        self.harness.step();
        self.harness.drag_at(from);
        self.harness.step();
        for i in 1..=moves {
            let part = f32::from(i) / f32::from(moves);
            self.harness.hover_at(from + by * part);
            self.harness.step();
        }
    }

    /// A scan is dropped: a built-in subject's voxels, so many along it, in a file of this hash.
    pub(crate) fn drop_built_in(&mut self, name: &str, resolution: u32, sha256: &str) {
        {
            let log = &mut *self.log.0.borrow_mut();
            log.next_ticket += 1;
            let ticket = Ticket(log.next_ticket);
            log.file_starts(ticket);
            fabrica::subjects::generate(name, resolution, &mut Queue(log, ticket))
                .expect("a built-in subject");
            let sha256 = Some(sha256.to_owned());
            let event = LoadEvent::Done { sha256 };
            log.queue.push(Message::Load { ticket, event });
        }
        self.settle();
    }

    /// The window as it is drawn, a part of it.
    pub(crate) fn pixels(&mut self, rect: egui::Rect) -> image::RgbaImage {
        let image = self.harness.render().expect("the window can be drawn");
        let rect = rect * self.harness.ctx.pixels_per_point();
        let [x, y] = [rect.left() as u32, rect.top() as u32];
        let [w, h] = [rect.width() as u32, rect.height() as u32];
        image::imageops::crop_imm(&image, x, y, w, h).to_image()
    }

    /// Writes the window to be looked at, if somebody wants to.
    pub(crate) fn look(&mut self, name: &str) {
        if let Some(folder) = std::env::var_os("FABRICA_LOOK_AT") {
            let image = self.harness.render().expect("the window can be drawn");
            let path = std::path::Path::new(&folder).join(format!("{name}.png"));
            image.save(path).expect("a picture to look at");
        }
    }

    pub(crate) fn place_peel(&mut self) {
        self.click("Place peel");
        let center = self.picture_center();
        self.click_at(center);
        assert_eq!(
            self.document().illustration().templates.len(),
            1,
            "a click on the object places it"
        );
    }
}
