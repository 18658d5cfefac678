//! The native window: files by path and dialog, loads in a thread, a folder for what is stored between runs.

use std::collections::BTreeMap;
use std::io::Read as _;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Instant;

use super::bending::{Desk, make_figure};
use super::clays::{ClayDesk, Purpose, make_clay, make_clay_of_file};
use super::command_line::ReadingFlags;
use super::figures::read_file;
use super::files::{Folder, Picked, local, mesh_set};
use super::loading::{
    make_subject, read_segments, resolutions, slabs_in_threads, take_segmentations, wanted_file,
};
use super::meshes::make_mesh;
use crate::app::{
    App, LinkChange, MeshToSave, Message, SaveFile, SavedTo, Services, Shipped, Start, Ticket,
};
use crate::assets::{
    BendAnswer, BendRequest, LoadEvent, Role, SegmentationsExpected, Source, Want,
};
use crate::data::VolumeLimits;
use crate::document::{Clay, RawVoxels, Reading, is_drawn_name};
use crate::link::Link;
use crate::load::{FileSet, is_field, mesh_among, read_field};
use crate::render::Gpu;
use crate::subjects::mesh_names;

/// A larger file is no document (the contract's limit is 1 MiB), and is opened as a scan.
const MAX_DOCUMENT_BYTES: u64 = 2 * 1024 * 1024;

/// What a window opens with.
#[derive(Clone, Debug, Default)]
pub struct Opening {
    /// The document to open, and its step; without it, the one stored by the last run.
    pub link: Option<Link>,
    /// Folder that the document's relative addresses start from; the working folder if none is given.
    pub folder: Option<PathBuf>,
    /// A file that takes the place of the document's subject.
    pub subject: Option<PathBuf>,
    /// How that file is read; goes before the reading in the document.
    pub reading: ReadingFlags,
    /// Part of the name of the adapter to draw with.
    pub adapter: Option<String>,
}

/// Why there is no window.
#[derive(Debug, thiserror::Error)]
pub enum WindowError {
    /// The window system, or the graphics device for it.
    #[error("no window could be opened: {0}")]
    Window(String),
}

/// Opens the window and runs until it is closed.
///
/// # Errors
/// If there is no window system or no graphics device.
pub fn view(opening: Opening) -> Result<(), WindowError> {
    let mut setup = eframe::egui_wgpu::WgpuSetupCreateNew::without_display_handle();
    setup.instance_descriptor.backends =
        wgpu::Backends::from_env().unwrap_or(wgpu::Backends::PRIMARY);
    setup.device_descriptor = Arc::new(Gpu::device_descriptor);
    if let Some(wanted) = opening.adapter.clone() {
        setup.native_adapter_selector = Some(Arc::new(move |adapters, surface| {
            select_adapter(&wanted, adapters, surface)
        }));
    }
    let options = eframe::NativeOptions {
        renderer: eframe::Renderer::Wgpu,
        // The picture has its own, and comparisons want none.
        dithering: false,
        wgpu_options: eframe::egui_wgpu::WgpuConfiguration {
            wgpu_setup: setup.into(),
            ..Default::default()
        },
        viewport: egui::ViewportBuilder::default()
            .with_title("Fabrica")
            .with_app_id("fabrica")
            .with_inner_size([1280.0, 820.0])
            .with_min_inner_size([360.0, 320.0]),
        ..Default::default()
    };
    let create: eframe::AppCreator<'_> = Box::new(move |cc| {
        let render_state = cc.wgpu_render_state.as_ref();
        let limits = render_state.map_or(SMALL, |state| limits_of(&state.device.limits()));
        if let Some(state) = render_state {
            let info = state.adapter.get_info();
            if info.device_type == wgpu::DeviceType::Cpu {
                eprintln!(
                    "notice: no graphics device; drawing on the processor ({})",
                    info.name
                );
            }
        }
        let mut services = NativeServices::new(cc.egui_ctx.clone(), limits, opening.folder);
        #[cfg(debug_assertions)]
        services.watch_shaders();
        let link = opening.link.as_ref();
        let in_document = link.and_then(|link| link.document.illustration().subject.reading());
        let reading = opening.reading.over(in_document);
        let subject = opening
            .subject
            .map(|path| services.start_file(path, true, reading));
        let start = Start {
            link: opening.link,
            text: None,
            missing: None,
            subject,
            gpu: None,
            clock: seconds,
        };
        Ok(Box::new(App::new(cc, Box::new(services), start)))
    });
    eframe::run_native("fabrica", options, create)
        .map_err(|error| WindowError::Window(error.to_string()))
}

/// Seconds since the first call.
pub fn seconds() -> f64 {
    static START: std::sync::OnceLock<Instant> = std::sync::OnceLock::new();
    START.get_or_init(Instant::now).elapsed().as_secs_f64()
}

fn select_adapter(
    wanted: &str,
    adapters: &[wgpu::Adapter],
    surface: Option<&wgpu::Surface<'_>>,
) -> Result<wgpu::Adapter, String> {
    let lower = wanted.to_lowercase();
    let fits = |adapter: &&wgpu::Adapter| {
        adapter.get_info().name.to_lowercase().contains(&lower)
            && surface.is_none_or(|surface| adapter.is_surface_supported(surface))
    };
    adapters.iter().find(fits).cloned().ok_or_else(|| {
        let names: Vec<String> = adapters.iter().map(|a| a.get_info().name).collect();
        format!("no adapter \"{wanted}\" (there are {})", names.join(", "))
    })
}

const SMALL: VolumeLimits = VolumeLimits {
    max_dim: 2048,
    max_voxels: 1 << 30,
};

/// What a device takes; see [`Gpu::volume_limits`].
fn limits_of(limits: &wgpu::Limits) -> VolumeLimits {
    VolumeLimits {
        max_dim: limits.max_texture_dimension_3d,
        ..SMALL
    }
}

/// One load in its thread.
struct Load {
    ticket: Ticket,
    is_wanted: Arc<AtomicBool>,
}

struct NativeServices {
    ctx: egui::Context,
    limits: VolumeLimits,
    folder: PathBuf,
    sender: Sender<Message>,
    receiver: Receiver<Message>,
    /// Answers of the file dialog, which runs in a thread of its own.
    picks: Sender<PathBuf>,
    picked: Receiver<PathBuf>,
    load: Option<Load>,
    /// The file of the latest load, for when its layout is told.
    opened: Option<(Ticket, PathBuf)>,
    next_ticket: u64,
    /// Files that were opened here, by the hash of their bytes.
    known: Arc<Mutex<BTreeMap<String, PathBuf>>>,
    /// Files dropped since the last frame: those dropped together are opened together.
    dropped: Vec<PathBuf>,
    /// Label volumes that the document names.
    labels: SegmentationsExpected,
    /// Fields that threads are reading.
    n_reading: usize,
    /// Shapes clays, one at a time.
    clays: Arc<Mutex<ClayDesk>>,
    /// Takes figures to be bent, once one was.
    bends: Option<Sender<BendRequest>>,
    /// What is bent is not wanted any more.
    is_bending_stopped: Arc<AtomicBool>,
}

impl NativeServices {
    fn new(ctx: egui::Context, limits: VolumeLimits, folder: Option<PathBuf>) -> Self {
        let (sender, receiver) = channel();
        let (picks, picked) = channel();
        Self {
            ctx,
            limits,
            folder: folder.unwrap_or_default(),
            sender,
            receiver,
            picks,
            picked,
            load: None,
            opened: None,
            next_ticket: 1,
            known: Arc::default(),
            dropped: Vec::new(),
            labels: SegmentationsExpected::default(),
            n_reading: 0,
            clays: Arc::default(),
            bends: None,
            is_bending_stopped: Arc::default(),
        }
    }

    /// Tells the app when a shader file changes, as long as there is a window.
    #[cfg(debug_assertions)]
    fn watch_shaders(&self) {
        let (sender, ctx) = (self.sender.clone(), self.ctx.clone());
        crate::render::watch_shaders(move || {
            let is_open = sender.send(Message::ShadersChanged).is_ok();
            ctx.request_repaint();
            is_open
        });
    }

    fn send(&self, message: Message) {
        send(&self.sender, &self.ctx, message);
    }

    fn new_ticket(&mut self) -> (Ticket, Arc<AtomicBool>) {
        if let Some(load) = self.load.take() {
            load.is_wanted.store(false, Ordering::Relaxed);
        }
        let ticket = Ticket(self.next_ticket);
        self.next_ticket += 1;
        let is_wanted = Arc::new(AtomicBool::new(true));
        self.load = Some(Load {
            ticket,
            is_wanted: Arc::clone(&is_wanted),
        });
        (ticket, is_wanted)
    }

    fn fail(&mut self, message: String) -> Ticket {
        let (ticket, _) = self.new_ticket();
        let event = LoadEvent::Failed {
            message,
            details: String::new(),
            fault: None,
        };
        self.send(Message::Load { ticket, event });
        ticket
    }

    fn start_file(&mut self, path: PathBuf, is_asked: bool, reading: Reading) -> Ticket {
        let (ticket, is_wanted) = self.new_ticket();
        if !is_asked {
            // The ticket is announced before any event of the load.
            self.send(Message::FileStarted { ticket });
        }
        self.opened = Some((ticket, path.clone()));
        self.read(ticket, is_wanted, path, reading);
        ticket
    }

    /// Reads in a thread.
    fn read(&self, ticket: Ticket, is_wanted: Arc<AtomicBool>, path: PathBuf, reading: Reading) {
        let (sender, ctx, limits) = (self.sender.clone(), self.ctx.clone(), self.limits);
        let known = Arc::clone(&self.known);
        let beside = self.folder.clone();
        let opened: Vec<PathBuf> = {
            let known = self.known.lock().unwrap_or_else(PoisonError::into_inner);
            known.values().cloned().collect()
        };
        std::thread::spawn(move || {
            let mut post = |event: LoadEvent| {
                remember(&known, &path, &event);
                post_while_wanted(&sender, &ctx, ticket, &is_wanted, event)
            };
            if reading.meshes.is_empty() {
                let (mut folder, name) = Folder::of(&path);
                read_file(&mut folder, &name, limits, &reading, &mut post);
            } else {
                let (mut picked, name) = mesh_set(&beside, &path, &reading.meshes, opened);
                read_file(&mut picked, &name, limits, &reading, &mut post);
            }
        });
    }

    /// The file that was opened here under the hash that is wanted.
    fn known_file(&self, want: &Want) -> Option<PathBuf> {
        let known = self.known.lock().unwrap_or_else(PoisonError::into_inner);
        known.get(&want.sha256()?.to_lowercase()).cloned()
    }

    /// Reads a label volume in a thread.
    fn start_segments(&mut self, path: PathBuf) -> Ticket {
        let (ticket, is_wanted) = self.new_ticket();
        let (sender, ctx) = (self.sender.clone(), self.ctx.clone());
        std::thread::spawn(move || {
            let mut post =
                |event: LoadEvent| post_while_wanted(&sender, &ctx, ticket, &is_wanted, event);
            let (mut folder, name) = Folder::of(&path);
            read_segments(&mut folder, &name, &mut post);
        });
        ticket
    }

    fn start_builtin(&mut self, (name, revision): (String, u32), want: &Want) -> Ticket {
        let carves = want.reading.carves;
        let is_figure = want.role == Role::Subject && is_drawn_name(&name);
        let is_mesh = want.role == Role::Object || mesh_names().contains(&name.as_str());
        let (ticket, is_wanted) = self.new_ticket();
        let (sender, ctx, limits) = (self.sender.clone(), self.ctx.clone(), self.limits);
        std::thread::spawn(move || {
            let mut post =
                |event: LoadEvent| post_while_wanted(&sender, &ctx, ticket, &is_wanted, event);
            if is_figure {
                return make_figure(&name, &mut post);
            }
            match is_mesh {
                true => make_mesh(&name, carves, &mut post),
                false => make_subject(
                    (&name, revision),
                    &resolutions(limits),
                    slabs_in_threads,
                    &mut post,
                ),
            }
        });
        ticket
    }

    /// Shapes a clay in a thread; `file` is what it begins with, if that is a file. One that nobody wants any more lets
    /// the desk go at its next step.
    fn start_clay(&mut self, clay: Arc<Clay>, want: &Want, file: Option<PathBuf>) -> Ticket {
        let (meshes, purpose) = (want.meshes.clone(), Purpose::of(want));
        let (ticket, is_wanted) = self.new_ticket();
        let (sender, ctx, desk) = (
            self.sender.clone(),
            self.ctx.clone(),
            Arc::clone(&self.clays),
        );
        let known = Arc::clone(&self.known);
        std::thread::spawn(move || {
            let mut post = |event: LoadEvent| {
                file.iter().for_each(|path| remember(&known, path, &event));
                post_while_wanted(&sender, &ctx, ticket, &is_wanted, event)
            };
            let mut desk = desk.lock().unwrap_or_else(PoisonError::into_inner);
            desk.take_meshes(&meshes);
            match &file {
                None => make_clay(&mut desk, &clay, &purpose, &mut post),
                Some(path) => {
                    let (mut folder, name) = Folder::of(path);
                    {
                        let file: (&mut dyn FileSet, &str) = (&mut folder, &name);
                        make_clay_of_file(&mut desk, &clay, file, &purpose, &mut post);
                    }
                }
            }
        });
        ticket
    }

    /// Reads a displacement field in a thread.
    fn read_field(&mut self, want: Option<Want>, path: PathBuf) {
        self.n_reading += 1;
        let (sender, ctx) = (self.sender.clone(), self.ctx.clone());
        let known = Arc::clone(&self.known);
        std::thread::spawn(move || {
            let (mut folder, name) = Folder::of(&path);
            let outcome = read_field(&mut folder, &name).map_err(|error| error.to_string());
            if let Ok(field) = &outcome {
                let mut known = known.lock().unwrap_or_else(PoisonError::into_inner);
                known.insert(field.sha256.clone(), path);
            }
            let outcome = Box::new(outcome);
            send(&sender, &ctx, Message::Field { want, outcome });
        });
    }

    /// Files that the user picked or dropped together: a document if one reads like one, else a scan and its label
    /// volumes.
    fn open_paths(&mut self, mut paths: Vec<PathBuf>) {
        if let [path] = paths.as_slice() {
            if let Some(text) = document_text(path) {
                if let Some(folder) = path.parent() {
                    self.folder = folder.to_path_buf();
                }
                self.send(Message::OpenText { text });
                return;
            }
            if path.is_file() && is_field_file(path) {
                self.read_field(None, paths.remove(0));
                return;
            }
            if path.is_dir() {
                self.start_file(paths.remove(0), false, Reading::default());
                return;
            }
        }
        self.start_files(paths, Reading::default());
    }

    /// Reads a scan, and as segments what of the files holds labels.
    fn start_files(&mut self, paths: Vec<PathBuf>, reading: Reading) -> Ticket {
        let (ticket, is_wanted) = self.new_ticket();
        self.send(Message::FileStarted { ticket });
        self.opened = paths.first().map(|path| (ticket, path.clone()));
        let (sender, ctx, limits) = (self.sender.clone(), self.ctx.clone(), self.limits);
        let (known, labels) = (Arc::clone(&self.known), self.labels.clone());
        std::thread::spawn(move || {
            let mut scan = None;
            let mut post =
                |event: LoadEvent| post_while_wanted(&sender, &ctx, ticket, &is_wanted, event);
            // Names are for finding them again here, and go nowhere.
            let named = paths.iter().map(|path| {
                let name = path.file_name().unwrap_or_default();
                (name.to_string_lossy().into_owned(), path.clone())
            });
            let mut picked = Picked(named.collect());
            let names = picked.0.iter().map(|(name, _)| name.clone()).collect();
            let rest = take_segmentations(&mut picked, names, &labels, &mut post);
            // Material libraries and pictures that were given with a mesh may lie in other folders.
            let mesh = mesh_among(&mut picked, &rest);
            if let Some(first) = mesh.as_ref().or(rest.first()) {
                scan = picked.0.iter().find(|(name, _)| name == first).cloned();
            }
            let Some((_, path)) = scan else {
                post(LoadEvent::Done { sha256: None });
                return;
            };
            let mut post = |event: LoadEvent| {
                remember(&known, &path, &event);
                post_while_wanted(&sender, &ctx, ticket, &is_wanted, event)
            };
            if let Some(name) = mesh {
                return read_file(&mut picked, &name, limits, &reading, &mut post);
            }
            let (mut folder, name) = Folder::of(&path);
            read_file(&mut folder, &name, limits, &reading, &mut post);
        });
        ticket
    }
}

/// Keeps where a file lies that has been read to its end, by its hash.
fn remember(known: &Mutex<BTreeMap<String, PathBuf>>, path: &Path, event: &LoadEvent) {
    if let LoadEvent::Done { sha256: Some(hash) } = event {
        let mut known = known.lock().unwrap_or_else(PoisonError::into_inner);
        known.insert(hash.clone(), path.to_owned());
    }
}

fn is_field_file(path: &Path) -> bool {
    let (mut folder, name) = Folder::of(path);
    is_field(&mut folder, &name)
}

fn send(sender: &Sender<Message>, ctx: &egui::Context, message: Message) {
    // The receiver is gone only when the window is.
    let _closed = sender.send(message);
    ctx.request_repaint();
}

fn post_while_wanted(
    sender: &Sender<Message>,
    ctx: &egui::Context,
    ticket: Ticket,
    is_wanted: &AtomicBool,
    event: LoadEvent,
) -> bool {
    if !is_wanted.load(Ordering::Relaxed) {
        return false;
    }
    send(sender, ctx, Message::Load { ticket, event });
    true
}

/// Starts a thread that bends figures, as long as somebody can ask for it.
fn start_bending(
    sender: Sender<Message>,
    ctx: egui::Context,
    is_stopped: Arc<AtomicBool>,
) -> Sender<BendRequest> {
    let (asks, requests) = channel::<BendRequest>();
    std::thread::spawn(move || {
        let mut desk = Desk::default();
        for request in requests {
            let mut tell = |part: f32| {
                send(&sender, &ctx, Message::Bent(BendAnswer::UnderWay(part)));
                !is_stopped.load(Ordering::Relaxed)
            };
            let answer = catch_unwind(AssertUnwindSafe(|| desk.answer(request, &mut tell)));
            let answer = answer.unwrap_or_else(|_| {
                desk = Desk::default();
                BendAnswer::Lost("a fault stopped the bending of the figure".to_owned())
            });
            send(&sender, &ctx, Message::Bent(answer));
        }
    });
    asks
}

/// The text of a file that begins as a document or a link does.
fn document_text(path: &Path) -> Option<String> {
    let file = std::fs::File::open(path).ok()?;
    if file.metadata().ok()?.len() > MAX_DOCUMENT_BYTES {
        return None;
    }
    let mut text = String::new();
    file.take(MAX_DOCUMENT_BYTES)
        .read_to_string(&mut text)
        .ok()?;
    text.trim_start().starts_with('{').then_some(text)
}

/// Folder for texts that are stored between runs.
fn store_folder() -> Option<PathBuf> {
    let from = |name: &str| {
        std::env::var_os(name)
            .map(PathBuf::from)
            .filter(|p| p.is_absolute())
    };
    let base = if cfg!(windows) {
        from("APPDATA")
    } else if cfg!(target_os = "macos") {
        from("HOME").map(|home| home.join("Library/Application Support"))
    } else {
        from("XDG_CONFIG_HOME").or_else(|| from("HOME").map(|home| home.join(".config")))
    };
    base.map(|base| base.join("fabrica"))
}

/// File for a key of the app's: letters, digits and dashes only.
fn store_file(key: &str) -> Option<PathBuf> {
    let name: String = key
        .chars()
        .map(|c| if c.is_ascii_alphanumeric() { c } else { '-' })
        .collect();
    store_folder().map(|folder| folder.join(format!("{name}.txt")))
}

/// Writes beside the file first, so that none is ever left half-written.
fn write_whole(path: &Path, bytes: &[u8]) -> std::io::Result<()> {
    let mut name = path.file_name().unwrap_or_default().to_os_string();
    name.push(".part");
    let part = path.with_file_name(name);
    let written = std::fs::write(&part, bytes).and_then(|()| std::fs::rename(&part, path));
    if written.is_err() {
        let _left = std::fs::remove_file(&part);
    }
    written
}

impl Services for NativeServices {
    fn poll(&mut self) -> Vec<Message> {
        while let Ok(path) = self.picked.try_recv() {
            self.dropped.push(path);
        }
        let dropped = std::mem::take(&mut self.dropped);
        if !dropped.is_empty() {
            self.open_paths(dropped);
        }
        let messages: Vec<Message> = self.receiver.try_iter().collect();
        let is_field = |message: &&Message| matches!(message, Message::Field { .. });
        let n_fields = messages.iter().filter(is_field).count();
        self.n_reading = self.n_reading.saturating_sub(n_fields);
        messages
    }

    fn open_file(&mut self) {
        let dialog = rfd::AsyncFileDialog::new()
            .add_filter(
                "Scans and illustrations",
                &[
                    "nii", "gz", "hdr", "img", "nrrd", "nhdr", "mha", "mhd", "dcm", "raw", "json",
                    "png", "jpg", "jpeg", "svg",
                ],
            )
            .add_filter("All files", &["*"])
            .pick_files();
        let (picks, ctx) = (self.picks.clone(), self.ctx.clone());
        std::thread::spawn(move || {
            for file in pollster::block_on(dialog).into_iter().flatten() {
                // The receiver is gone only when the window is.
                let _closed = picks.send(file.path().to_path_buf());
            }
            ctx.request_repaint();
        });
    }

    fn drop_file(&mut self, file: egui::DroppedFileHandle) {
        self.dropped.push(file.path().to_path_buf());
        self.ctx.request_repaint();
    }

    fn load(&mut self, want: &Want) -> Ticket {
        match &want.source {
            Source::Builtin { name, revision } => {
                return self.start_builtin((name.clone(), *revision), want);
            }
            Source::Clay(clay) if !want.has_file() => {
                return self.start_clay(Arc::clone(clay), want, None);
            }
            Source::Clay(_) | Source::File { .. } => {}
        }
        // A file is read where the document says that it is, even if the same bytes were opened before.
        let path = match want.src() {
            Some(src) => match (local(&self.folder, src), want.role) {
                (Some(path), _) => path,
                (None, Role::Subject) => {
                    return self.fail(format!(
                        "This program reads local files only: download the scan and start with --subject FILE ({src})"
                    ));
                }
                (None, _) => {
                    return self.fail(format!(
                        "This program reads local files only: download the label volume and open it here ({src})"
                    ));
                }
            },
            None => match self.known_file(want) {
                Some(path) => path,
                None => return self.fail(wanted_file(want.name())),
            },
        };
        match (want.role, want.clay()) {
            (Role::Segments, _) => self.start_segments(path),
            (_, Some(clay)) => self.start_clay(Arc::clone(clay), want, Some(path)),
            (_, None) => self.start_file(path, true, want.reading.clone()),
        }
    }

    fn bend(&mut self, request: BendRequest) {
        let (sender, ctx) = (&self.sender, &self.ctx);
        let is_stopped = &self.is_bending_stopped;
        is_stopped.store(false, Ordering::Relaxed);
        let bends = self.bends.get_or_insert_with(|| {
            start_bending(sender.clone(), ctx.clone(), Arc::clone(is_stopped))
        });
        if bends.send(request).is_err() {
            self.bends = None;
            let why = "the thread that bends figures is gone".to_owned();
            self.send(Message::Bent(BendAnswer::Lost(why)));
        }
    }

    fn stop_bending(&mut self) {
        self.is_bending_stopped.store(true, Ordering::Relaxed);
    }

    fn fetch_shipped(&mut self, file: Shipped) {
        let bytes: &[u8] = match file {
            Shipped::Examples => include_bytes!("../../web/examples/list.json"),
            Shipped::ExamplePictures => include_bytes!("../../web/examples/pictures.png"),
        };
        let outcome = Ok(bytes.to_vec());
        self.send(Message::Shipped { file, outcome });
    }

    fn load_field(&mut self, want: &Want) {
        let local = want.src().and_then(|src| local(&self.folder, src));
        match self.known_file(want).or(local) {
            Some(path) => self.read_field(Some(want.clone()), path),
            None => {
                self.n_reading += 1;
                let outcome = Box::new(Err(wanted_file(want.name())));
                let want = Some(want.clone());
                self.send(Message::Field { want, outcome });
            }
        }
    }

    fn is_reading(&self) -> bool {
        self.n_reading > 0 || !self.dropped.is_empty()
    }

    fn expect_segmentations(&mut self, expected: &SegmentationsExpected) {
        self.labels.clone_from(expected);
    }

    fn allow_host(&mut self, _ticket: Ticket) {}

    fn answer_raw(&mut self, ticket: Ticket, raw: &RawVoxels) {
        let load = self.load.as_ref().filter(|load| load.ticket == ticket);
        let opened = self.opened.as_ref().filter(|(t, _)| *t == ticket);
        if let (Some(load), Some((_, path))) = (load, opened) {
            let (is_wanted, path) = (Arc::clone(&load.is_wanted), path.clone());
            let reading = Reading {
                frame: 0,
                raw: Some(raw.clone()),
                ..Reading::default()
            };
            self.read(ticket, is_wanted, path, reading);
        }
    }

    fn cancel_load(&mut self, ticket: Ticket) {
        if let Some(load) = self.load.take_if(|load| load.ticket == ticket) {
            load.is_wanted.store(false, Ordering::Relaxed);
            self.send(Message::Load {
                ticket,
                event: LoadEvent::Cancelled,
            });
        }
    }

    fn save_file(&mut self, file: SaveFile) {
        let dialog = rfd::AsyncFileDialog::new()
            .set_file_name(&file.name)
            .save_file();
        let (sender, ctx) = (self.sender.clone(), self.ctx.clone());
        std::thread::spawn(move || {
            let outcome = match pollster::block_on(dialog) {
                None => Err(String::new()),
                Some(chosen) => write_whole(chosen.path(), &file.bytes)
                    .map(|()| SavedTo::Path(chosen.path().to_owned()))
                    .map_err(|error| error.to_string()),
            };
            send(&sender, &ctx, Message::Saved(outcome));
        });
    }

    fn save_mesh(&mut self, want: &Want, mesh: MeshToSave) {
        let Some(clay) = want.clay().cloned() else {
            return;
        };
        let dialog = rfd::AsyncFileDialog::new()
            .set_file_name(&mesh.name)
            .save_file();
        let (sender, ctx, desk) = (
            self.sender.clone(),
            self.ctx.clone(),
            Arc::clone(&self.clays),
        );
        let meshes = want.meshes.clone();
        std::thread::spawn(move || {
            let outcome = match pollster::block_on(dialog) {
                None => Err(String::new()),
                Some(chosen) => {
                    let mut desk = desk.lock().unwrap_or_else(PoisonError::into_inner);
                    desk.take_meshes(&meshes);
                    let bytes = desk.file(&clay, &mesh.writing, &mut |_| true);
                    let saved = bytes.map_err(|error| error.to_string()).and_then(|bytes| {
                        write_whole(chosen.path(), &bytes).map_err(|error| error.to_string())
                    });
                    saved.map(|()| SavedTo::Path(chosen.path().to_owned()))
                }
            };
            send(&sender, &ctx, Message::Saved(outcome));
        });
    }

    fn let_clay_go(&mut self) {
        // A thread that still shapes one ends soon, and takes the old desk with it.
        self.clays = Arc::default();
    }

    fn copy_text(&mut self, text: String) {
        self.ctx.copy_text(text);
        self.send(Message::Copied(Ok(())));
    }

    fn paste_text(&mut self) {
        // Comes as an event of the window, as if its keys had been pressed.
        self.ctx
            .send_viewport_cmd(egui::ViewportCommand::RequestPaste);
    }

    fn page_address(&self) -> String {
        // A window has no page of its own; an author who publishes one can name its address.
        std::env::var("FABRICA_PAGE").unwrap_or_default()
    }

    fn set_link(&mut self, _payload: &str, _change: LinkChange) {}

    fn store(&mut self, key: &str, value: &str) {
        if let Some(path) = store_file(key) {
            let folder = path.parent().unwrap_or(Path::new("."));
            let written =
                std::fs::create_dir_all(folder).and_then(|()| write_whole(&path, value.as_bytes()));
            if let Err(error) = written {
                eprintln!("notice: {}: {error}", path.display());
            }
        }
    }

    fn set_title(&mut self, title: &str) {
        let title = egui::ViewportCommand::Title(title.to_owned());
        self.ctx.send_viewport_cmd(title);
    }

    fn languages(&self) -> Vec<String> {
        // The order in which the C library looks; a variable that is set but empty does not count.
        let set = |name| std::env::var(name).ok().filter(|value| !value.is_empty());
        let first = ["LC_ALL", "LC_MESSAGES", "LANG"].into_iter().find_map(set);
        let list = set("LANGUAGE").unwrap_or_default();
        let wanted = list.split(':').map(str::to_owned).chain(first);
        wanted.filter(|tag| !tag.is_empty()).collect()
    }

    fn stored(&self, key: &str) -> Option<String> {
        std::fs::read_to_string(store_file(key)?).ok()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::Document;
    use std::time::Duration;

    fn wait_until(mut is_so: impl FnMut() -> bool) {
        let patience = Instant::now() + Duration::from_secs(60);
        while !is_so() {
            assert!(Instant::now() < patience, "it never comes");
            std::thread::sleep(Duration::from_millis(5));
        }
    }

    /// What a clay's strokes have left goes with it, at once or as soon as the thread ends that still shapes it.
    #[test]
    fn a_clay_that_goes_leaves_nothing() {
        let text = r#"{ "fabrica": 1, "subject": { "clay": { "detail": 0.05,
            "strokes": [{ "path": [0, 0, 400, 0, 0, 120] }] } } }"#;
        let document = Document::from_json(text).unwrap();
        let want = Want::subject(&document.illustration().subject);
        let cube = Document::from_json(r#"{ "fabrica": 1, "subject": { "builtin": "cube" } }"#);
        let cube = Want::subject(&cube.unwrap().illustration().subject);
        let is_end = |message: Message| match message {
            Message::Load { event, .. } => matches!(event, LoadEvent::Done { .. }),
            _ => false,
        };
        for is_whole in [true, false] {
            let mut services = NativeServices::new(egui::Context::default(), SMALL, None);
            services.load(&want);
            if is_whole {
                wait_until(|| services.poll().into_iter().any(is_end));
                assert!(services.clays.lock().unwrap().bytes() > 100_000);
            }
            let desk = Arc::downgrade(&services.clays);
            services.load(&cube);
            services.let_clay_go();
            wait_until(|| desk.strong_count() == 0);
            assert_eq!(services.clays.lock().unwrap().bytes(), 0);
        }
    }
}
