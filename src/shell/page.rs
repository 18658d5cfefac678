//! What the page does for the app: address bar and history, files, workers, clipboard, what is kept between visits.

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::{JsFuture, spawn_local};
use web_sys::{Blob, BlobPropertyBag, HtmlAnchorElement, HtmlInputElement, Storage, Url, Window};

use super::address::{
    absolute, address_task, at_base, builtin_task, fetched, file_task, foreign_host,
};
use super::loading::wanted_file;
use super::texts::{self, Texts};
use super::worker::answer::Answer;
use super::worker::fault::text_of;
use super::worker::run::{self, BendWorker, WorkerLoad};
use super::worker::task::{ClayTask, ScanTask, Task};
use crate::app::{
    LinkChange, MeshToSave, Message, STORED_DOCUMENT, SaveFile, SavedTo, Services, SetText,
    Shipped, TextOver, TextToSet, Ticket,
};
use crate::assets::{BendAnswer, BendRequest, LoadEvent, SegmentationsExpected, Source, Want};
use crate::data::VolumeLimits;
use crate::document::{RawVoxels, Reading};
use crate::load::FieldFile;

/// A larger file is no document (the contract's limit is 1 MiB), and is opened as a scan.
const MAX_DOCUMENT_BYTES: f64 = 2e6;

/// How a viewer is set into its surroundings.
#[derive(Clone, Debug)]
pub(super) struct Place {
    /// Address of `worker.js`, the script of the workers.
    pub worker: String,
    /// What a document's relative addresses start from.
    pub base: String,
}

/// State that outlives the app (a lost device makes a new one).
pub(super) struct Page {
    pub place: Place,
    pub ctx: Option<egui::Context>,
    pub limits: VolumeLimits,
    messages: Vec<Message>,
    load: Option<(Ticket, WorkerLoad)>,
    /// A clay that becomes a file.
    writing: Option<WorkerLoad>,
    next_ticket: u64,
    /// Bends the figure that is shown, once there is one.
    bender: Option<BendWorker>,
    /// Loads that wait for leave to fetch.
    asking: BTreeMap<Ticket, (String, Want)>,
    allowed_hosts: BTreeSet<String>,
    /// Files that the reader gave, by the hash of their bytes.
    known: BTreeMap<String, Vec<(String, Blob)>>,
    /// A file that may be a displacement field: a load only when its part says that it is none.
    opening: Option<(Ticket, WorkerLoad)>,
    /// Files being looked at, and fields that the document names, which are not there yet.
    n_reading: usize,
    /// The files of the load under way, until their hash is known.
    opened: Option<(Ticket, Vec<(String, Blob)>)>,
    /// Files dropped since the last frame: those dropped together are opened together.
    dropped: Vec<(String, Blob)>,
    /// Label volumes that the document names.
    labels: SegmentationsExpected,
    /// The payload that the app last gave.
    pub payload: String,
    /// A picture that a script asked for goes here instead of into a file.
    pub picture_wanted: Option<js_sys::Function>,
    /// Called with the text where the browser refuses the clipboard.
    pub on_copy_refused: Option<js_sys::Function>,
    /// What sets texts in place of the canvas.
    pub texts: Option<Texts>,
    /// How hard a pen presses on the canvas.
    pub pen: Option<f32>,
}

impl Page {
    pub(super) fn new(place: Place) -> Self {
        Self {
            place,
            ctx: None,
            limits: VolumeLimits {
                max_dim: 2048,
                max_voxels: 1 << 30,
            },
            messages: Vec::new(),
            load: None,
            writing: None,
            opening: None,
            n_reading: 0,
            next_ticket: 1,
            bender: None,
            asking: BTreeMap::new(),
            allowed_hosts: BTreeSet::new(),
            known: BTreeMap::new(),
            opened: None,
            dropped: Vec::new(),
            labels: SegmentationsExpected::default(),
            payload: String::new(),
            picture_wanted: None,
            on_copy_refused: None,
            texts: None,
            pen: None,
        }
    }

    pub(super) fn send(&mut self, message: Message) {
        self.messages.push(message);
        if let Some(ctx) = &self.ctx {
            ctx.request_repaint();
        }
    }

    /// Tells the app what became of a field: one that the document names, or one that the user opened.
    fn send_field(&mut self, want: Option<Want>, outcome: Result<FieldFile, String>) {
        if want.is_some() {
            self.n_reading = self.n_reading.saturating_sub(1);
        }
        let outcome = Box::new(outcome);
        self.send(Message::Field { want, outcome });
    }

    /// Ends the load under way and gives the next one a ticket.
    fn new_ticket(&mut self) -> Ticket {
        self.load = None;
        self.opening = None;
        self.asking.clear();
        self.next_ticket()
    }

    fn next_ticket(&mut self) -> Ticket {
        let ticket = Ticket(self.next_ticket);
        self.next_ticket += 1;
        ticket
    }
}

fn matches_media(query: &str) -> bool {
    let found = window().and_then(|w| w.match_media(query).ok().flatten());
    found.is_some_and(|query| query.matches())
}

/// The page as the app sees it.
#[derive(Clone)]
pub(super) struct PageServices(pub Rc<RefCell<Page>>);

impl PageServices {
    /// Starts a task and passes on the answers of its part.
    fn start(&self, ticket: Ticket, task: &Task) {
        let started = self.answered(task, move |services, answer| match answer {
            Answer::Event(event) => services.pass(ticket, event),
            Answer::Field(outcome) => services.take_field(None, Vec::new(), *outcome),
            Answer::Module(..) | Answer::Bent(_) => {}
        });
        match started {
            Ok(load) => self.0.borrow_mut().load = Some((ticket, load)),
            Err(error) => self.pass(ticket, not_started(&error)),
        }
    }

    /// Starts a task; `on_answer` is called with the page and each answer as long as the page is there.
    fn answered(
        &self,
        task: &Task,
        mut on_answer: impl FnMut(&Self, Answer) + 'static,
    ) -> Result<WorkerLoad, JsValue> {
        let (worker, limits) = {
            let page = self.0.borrow();
            (page.place.worker.clone(), page.limits)
        };
        let weak = Rc::downgrade(&self.0);
        run::start(&worker.as_str().into(), task, limits, move |answer| {
            if let Some(page) = weak.upgrade() {
                on_answer(&Self(page), answer);
            }
        })
    }

    /// The task for a clay without a file, or for a file that the reader gave.
    ///
    /// # Errors
    /// In words: which file is wanted.
    fn task_without_address(&self, want: &Want) -> Result<Task, String> {
        if let Some(clay) = want.clay().filter(|_| !want.has_file()) {
            return Ok(Task::Clay(ClayTask::of(clay, want), None));
        }
        let page = self.0.borrow();
        let hash = want.sha256().unwrap_or_default().to_lowercase();
        let files = page.known.get(&hash).cloned();
        let files = files.ok_or_else(|| wanted_file(want.name()))?;
        let task = scan_task(files, want.reading.clone(), page.labels.clone());
        Ok(file_task(want, task))
    }

    /// Gives the app an event of a load.
    fn pass(&self, ticket: Ticket, event: LoadEvent) {
        let mut page = self.0.borrow_mut();
        if let LoadEvent::Done { sha256: Some(hash) } = &event
            && let Some((_, files)) = page.opened.take_if(|(t, _)| *t == ticket)
        {
            page.known.insert(hash.clone(), files);
        }
        page.send(Message::Load { ticket, event });
    }

    /// Gives the app a displacement field, or why there is none, and keeps its file by its hash.
    fn take_field(
        &self,
        want: Option<Want>,
        files: Vec<(String, Blob)>,
        outcome: Result<FieldFile, String>,
    ) {
        let mut page = self.0.borrow_mut();
        if let Ok(field) = &outcome {
            page.known.insert(field.sha256.clone(), files);
        }
        page.send_field(want, outcome);
    }

    /// Reads one file that the reader opened: as a displacement field if it is one, else as a scan, which takes the
    /// place of what is being loaded.
    fn open_one(&self, name: String, blob: Blob) {
        let files = vec![(name, blob)];
        let ticket = {
            let mut page = self.0.borrow_mut();
            page.opening = None;
            page.next_ticket()
        };
        let task = Task::Scan(ScanTask::Files {
            files: files.clone(),
            reading: Reading::default(),
            segmentations: self.0.borrow().labels.clone(),
            may_be_field: true,
        });
        let started = self.answered(&task, move |services, answer| match answer {
            Answer::Event(event) => {
                services.begin(ticket, &files);
                services.pass(ticket, event);
            }
            Answer::Field(outcome) => {
                let ended = services
                    .0
                    .borrow_mut()
                    .opening
                    .take_if(|(t, _)| *t == ticket);
                drop(ended);
                services.take_field(None, files.clone(), *outcome);
            }
            Answer::Module(..) | Answer::Bent(_) => {}
        });
        match started {
            Ok(load) => self.0.borrow_mut().opening = Some((ticket, load)),
            Err(error) => {
                self.begin(ticket, &[]);
                self.pass(ticket, not_started(&error));
            }
        }
    }

    /// Makes what is being opened the load under way, unless it is that already.
    fn begin(&self, ticket: Ticket, files: &[(String, Blob)]) {
        let mut page = self.0.borrow_mut();
        if page.opened.as_ref().is_some_and(|(t, _)| *t == ticket)
            || page.load.as_ref().is_some_and(|(t, _)| *t == ticket)
        {
            return;
        }
        page.load = page.opening.take_if(|(t, _)| *t == ticket);
        page.asking.clear();
        page.opened = Some((ticket, files.to_vec()));
        page.send(Message::FileStarted { ticket });
    }

    fn fail(&self, message: String) -> Ticket {
        let mut page = self.0.borrow_mut();
        let ticket = page.new_ticket();
        let event = LoadEvent::Failed {
            message,
            details: String::new(),
            fault: None,
        };
        page.send(Message::Load { ticket, event });
        ticket
    }

    /// Reads a displacement field that a document names.
    async fn read_field(&self, want: Option<Want>, name: String, blob: Blob) {
        let outcome = if blob.size() > MAX_FIELD_BYTES {
            Err(format!("{name} could not be read, or has more than 256 MB"))
        } else {
            let worker = self.0.borrow().place.worker.clone();
            run::read_field(&worker.as_str().into(), name.clone(), blob.clone()).await
        };
        self.take_field(want, vec![(name, blob)], outcome);
    }

    /// Files that the reader picked or dropped together: a document if it reads like one, else a scan.
    pub(super) fn open_files(&self, files: Vec<(String, Blob)>) {
        let services = self.clone();
        self.0.borrow_mut().n_reading += 1;
        spawn_local(async move {
            let text = match files.as_slice() {
                [(_, blob)] if blob.size() <= MAX_DOCUMENT_BYTES => document_text(blob).await,
                _ => None,
            };
            services.0.borrow_mut().n_reading -= 1;
            if let Some(text) = text {
                services.0.borrow_mut().send(Message::OpenText { text });
                return;
            }
            if let [(name, blob)] = files.as_slice() {
                services.open_one(name.clone(), blob.clone());
                return;
            }
            let files = in_order(files);
            let ticket = {
                let mut page = services.0.borrow_mut();
                let ticket = page.new_ticket();
                page.opened = Some((ticket, files.clone()));
                page.send(Message::FileStarted { ticket });
                ticket
            };
            let labels = services.0.borrow().labels.clone();
            let task = scan_task(files, Reading::default(), labels);
            services.start(ticket, &Task::Scan(task));
        });
    }
}

/// A header goes before the voxels that it describes.
fn in_order(mut files: Vec<(String, Blob)>) -> Vec<(String, Blob)> {
    let is_voxels = |name: &str| {
        let lower = name.to_lowercase();
        [".img", ".img.gz", ".raw", ".raw.gz", ".zraw"]
            .iter()
            .any(|ending| lower.ends_with(ending))
    };
    files.sort_by_key(|(name, _)| is_voxels(name));
    files
}

/// A larger displacement field is not read on the page.
const MAX_FIELD_BYTES: f64 = 256e6;

/// The task to read files that the reader gave for a load that is under way.
fn scan_task(
    files: Vec<(String, Blob)>,
    reading: Reading,
    segmentations: SegmentationsExpected,
) -> ScanTask {
    ScanTask::Files {
        files,
        reading,
        segmentations,
        may_be_field: false,
    }
}

fn not_started(error: &JsValue) -> LoadEvent {
    LoadEvent::Failed {
        message: "This browser cannot load scans in the background".to_owned(),
        details: text_of(error),
        fault: None,
    }
}

/// The bytes of a file that lies beside the program.
async fn fetched_bytes(address: &str) -> Option<Vec<u8>> {
    let blob = fetched(address).await?;
    let buffer = JsFuture::from(blob.array_buffer()).await.ok()?;
    Some(js_sys::Uint8Array::new(&buffer).to_vec())
}

/// The text of a file that begins as a document does.
async fn document_text(blob: &Blob) -> Option<String> {
    let head = blob.slice_with_f64_and_f64(0.0, 64.0).ok()?;
    let head = JsFuture::from(head.text()).await.ok()?.as_string()?;
    if !head
        .trim_start_matches('\u{feff}')
        .trim_start()
        .starts_with('{')
    {
        return None;
    }
    JsFuture::from(blob.text()).await.ok()?.as_string()
}

fn window() -> Option<Window> {
    web_sys::window()
}

/// What only this tab keeps: a document that is edited in one tab is not the one that another tab comes back to.
fn tab_storage() -> Option<Storage> {
    window()?.session_storage().ok().flatten()
}

fn storage() -> Option<Storage> {
    // Throws where the reader forbids it; then nothing is kept.
    window()?.local_storage().ok().flatten()
}

/// The text stored under a key: by this tab, else by any tab.
fn kept(key: &str) -> Option<String> {
    let key = format!("fabrica.{key}");
    let read = |storage: Storage| storage.get_item(&key).ok().flatten();
    tab_storage()
        .and_then(read)
        .or_else(|| storage().and_then(read))
}

/// Payload of the document that an earlier visit kept.
pub(super) fn kept_document() -> Option<String> {
    kept(STORED_DOCUMENT)
}

/// Address of the page without fragment and without the document that it was opened with.
pub(super) fn page_address() -> String {
    let here = window().and_then(|w| w.location().href().ok());
    let Some(url) = here.and_then(|href| Url::new(&href).ok()) else {
        return String::new();
    };
    url.set_hash("");
    url.search_params().delete("s");
    url.search_params().delete("doc");
    url.href()
}

impl Services for PageServices {
    fn poll(&mut self) -> Vec<Message> {
        let dropped = std::mem::take(&mut self.0.borrow_mut().dropped);
        if !dropped.is_empty() {
            self.open_files(dropped);
        }
        std::mem::take(&mut self.0.borrow_mut().messages)
    }

    fn open_file(&mut self) {
        let services = self.clone();
        let picked = move |input: &HtmlInputElement| {
            let Some(list) = input.files() else { return };
            let files = (0..list.length()).filter_map(|i| list.get(i));
            let files: Vec<(String, Blob)> = files.map(|f| (f.name(), f.into())).collect();
            if !files.is_empty() {
                services.open_files(files);
            }
        };
        let shown = window().and_then(|w| w.document()).and_then(|document| {
            let input: HtmlInputElement = document.create_element("input").ok()?.dyn_into().ok()?;
            input.set_type("file");
            input.set_multiple(true);
            let for_event = input.clone();
            let on_change = Closure::once_into_js(move || picked(&for_event));
            input.set_onchange(Some(on_change.unchecked_ref()));
            input.click();
            Some(())
        });
        if shown.is_none() {
            self.0.borrow_mut().send(Message::Notice {
                message: "This browser shows no file dialog: drop the file on the picture"
                    .to_owned(),
                details: String::new(),
            });
        }
    }

    fn drop_file(&mut self, file: egui::DroppedFileHandle) {
        if let Some(file) = file.web_file() {
            let mut page = self.0.borrow_mut();
            page.dropped.push((file.name(), file.clone().into()));
            if let Some(ctx) = &page.ctx {
                ctx.request_repaint();
            }
        }
    }

    fn load(&mut self, want: &Want) -> Ticket {
        match &want.source {
            Source::Builtin { name, revision } => {
                let ticket = self.0.borrow_mut().new_ticket();
                self.start(ticket, &builtin_task((name, *revision), want));
                return ticket;
            }
            Source::Clay(_) | Source::File { .. } => {}
        }
        let Some(src) = want.src() else {
            let task = match self.task_without_address(want) {
                Ok(task) => task,
                Err(why) => return self.fail(why),
            };
            let ticket = self.0.borrow_mut().new_ticket();
            self.start(ticket, &task);
            return ticket;
        };
        let base = self.0.borrow().place.base.clone();
        let address = match absolute(src, &base) {
            Ok(address) => address,
            Err(why) => return self.fail(why),
        };
        let want = at_base(want, &base);
        let mut page = self.0.borrow_mut();
        let ticket = page.new_ticket();
        match foreign_host(&address) {
            Some(host) if !page.allowed_hosts.contains(&host) => {
                page.asking.insert(ticket, (address, want));
                page.send(Message::AskHost { ticket, host });
            }
            _ => {
                drop(page);
                self.start(ticket, &address_task(address, &want));
            }
        }
        ticket
    }

    fn bend(&mut self, request: BendRequest) {
        let mut page = self.0.borrow_mut();
        let worker = page.place.worker.clone();
        let bender = page
            .bender
            .get_or_insert_with(|| BendWorker::new(worker.as_str().into()));
        let weak = Rc::downgrade(&self.0);
        let asked = bender.ask(request, move |answer| {
            if let Some(page) = weak.upgrade() {
                page.borrow_mut().send(Message::Bent(answer));
            }
        });
        if let Err(error) = asked {
            page.send(Message::Bent(BendAnswer::Lost(text_of(&error))));
        }
    }

    fn stop_bending(&mut self) {
        let mut page = self.0.borrow_mut();
        if let Some(bender) = &page.bender {
            bender.stop();
            page.send(Message::Bent(BendAnswer::Stopped));
        }
    }

    fn fetch_shipped(&mut self, file: Shipped) {
        let services = self.clone();
        // Its files lie beside the program, which need not lie beside the page that it is set into.
        let address = Url::new_with_base(file.path(), &self.0.borrow().place.worker);
        spawn_local(async move {
            let bytes = match address {
                Ok(address) => fetched_bytes(&address.href()).await,
                Err(_) => None,
            };
            let outcome = bytes.ok_or_else(|| file.path().to_owned());
            let mut page = services.0.borrow_mut();
            page.send(Message::Shipped { file, outcome });
        });
    }

    fn load_field(&mut self, want: &Want) {
        let services = self.clone();
        self.0.borrow_mut().n_reading += 1;
        let known = want.sha256();
        let known = known.and_then(|hash| self.0.borrow().known.get(hash).cloned());
        let for_want = Some(want.clone());
        if let Some([(name, blob)]) = known.as_deref() {
            let (name, blob) = (name.clone(), blob.clone());
            spawn_local(async move { services.read_field(for_want, name, blob).await });
            return;
        }
        let base = self.0.borrow().place.base.clone();
        let address = want.src().and_then(|src| {
            let url = Url::new_with_base(src, &base).ok()?;
            Some((src.to_owned(), url.href()))
        });
        let missing = wanted_file(want.name());
        // What lies elsewhere is not fetched unasked.
        let host = address.as_ref().and_then(|(_, at)| foreign_host(at));
        let mut page = self.0.borrow_mut();
        if let Some(host) = host.filter(|host| !page.allowed_hosts.contains(host)) {
            page.n_reading -= 1;
            let want = want.clone();
            page.send(Message::AskFieldHost { want, host });
            return;
        }
        drop(page);
        spawn_local(async move {
            if let Some((src, address)) = address
                && let Some(blob) = fetched(&address).await
            {
                let name = src.rsplit('/').next().unwrap_or(&src).to_owned();
                return services.read_field(for_want, name, blob).await;
            }
            let mut page = services.0.borrow_mut();
            page.send_field(for_want, Err(missing));
        });
    }

    fn is_reading(&self) -> bool {
        let page = self.0.borrow();
        // What lies here untaken is news to the app: a slow first frame may be seconds away.
        let has_news = !page.messages.is_empty() || !page.dropped.is_empty();
        has_news || page.n_reading > 0 || page.opening.is_some()
    }

    fn expect_segmentations(&mut self, expected: &SegmentationsExpected) {
        self.0.borrow_mut().labels.clone_from(expected);
    }

    fn allow_host(&mut self, ticket: Ticket) {
        let asked = self.0.borrow_mut().asking.remove(&ticket);
        if let Some((address, want)) = asked {
            if let Some(host) = foreign_host(&address) {
                self.0.borrow_mut().allowed_hosts.insert(host);
            }
            self.start(ticket, &address_task(address, &want));
        }
    }

    fn allow_fields(&mut self, host: &str) {
        self.0.borrow_mut().allowed_hosts.insert(host.to_owned());
    }

    fn answer_raw(&mut self, ticket: Ticket, raw: &RawVoxels) {
        let files = {
            let page = self.0.borrow();
            let opened = page.opened.as_ref().filter(|(t, _)| *t == ticket);
            opened.map(|(_, files)| files.clone())
        };
        if let Some(files) = files {
            let reading = Reading {
                frame: 0,
                raw: Some(raw.clone()),
                ..Reading::default()
            };
            let labels = self.0.borrow().labels.clone();
            let task = scan_task(files, reading, labels);
            self.start(ticket, &Task::Scan(task));
        }
    }

    fn cancel_load(&mut self, ticket: Ticket) {
        let mut page = self.0.borrow_mut();
        let was_asking = page.asking.remove(&ticket).is_some();
        let was_loading = page.load.take_if(|(t, _)| *t == ticket).is_some();
        if was_asking || was_loading {
            page.send(Message::Load {
                ticket,
                event: LoadEvent::Cancelled,
            });
        }
    }

    fn save_file(&mut self, file: SaveFile) {
        let bytes = js_sys::Uint8Array::from(file.bytes.as_slice());
        if file.mime == "image/png" {
            let wanted = self.0.borrow_mut().picture_wanted.take();
            if let Some(wanted) = wanted {
                let _ignored = wanted.call1(&JsValue::NULL, &bytes);
                return;
            }
        }
        let options = BlobPropertyBag::new();
        options.set_type(file.mime);
        let parts = js_sys::Array::of1(&bytes);
        let saved = Blob::new_with_u8_array_sequence_and_options(&parts, &options)
            .and_then(|blob| Url::create_object_url_with_blob(&blob))
            .and_then(|address| {
                let document = window().and_then(|w| w.document()).ok_or(JsValue::NULL)?;
                let link: HtmlAnchorElement = document.create_element("a")?.unchecked_into();
                link.set_href(&address);
                link.set_download(&file.name);
                link.click();
                Url::revoke_object_url(&address)
            });
        let outcome = saved
            .map(|()| SavedTo::Downloads(file.name))
            .map_err(|error| text_of(&error));
        self.0.borrow_mut().send(Message::Saved(outcome));
    }

    fn save_mesh(&mut self, want: &Want, mesh: MeshToSave) {
        let task = match want.src() {
            Some(src) => {
                let base = self.0.borrow().place.base.clone();
                absolute(src, &base).map(|address| address_task(address, &at_base(want, &base)))
            }
            None => self.task_without_address(want),
        };
        let mut task = match task {
            Ok(task) => task,
            Err(why) => return self.0.borrow_mut().send(Message::Saved(Err(why))),
        };
        let (name, mime) = (mesh.name, mesh.writing.format.mime());
        if let Task::Clay(clay, _) = &mut task {
            clay.writing = Some(mesh.writing);
        }
        let started = self.answered(&task, move |services, answer| match answer {
            Answer::Event(LoadEvent::Written(bytes)) => {
                let name = name.clone();
                services.clone().save_file(SaveFile { name, mime, bytes });
            }
            Answer::Event(LoadEvent::Failed { message, .. }) => {
                let mut page = services.0.borrow_mut();
                page.send(Message::Saved(Err(message)));
            }
            _ => {}
        });
        let mut page = self.0.borrow_mut();
        match started {
            Ok(load) => page.writing = Some(load),
            Err(error) => page.send(Message::Saved(Err(text_of(&error)))),
        }
    }

    fn pen(&self) -> Option<f32> {
        self.0.borrow().pen
    }

    fn let_clay_go(&mut self) {
        run::end_resting();
    }

    fn copy_text(&mut self, text: String) {
        let services = self.clone();
        let clipboard = window()
            .map(|w| w.navigator().clipboard())
            .filter(|c| c.is_object());
        // Begun at once: browsers allow it during a tap only.
        let writing = clipboard.map(|c| JsFuture::from(c.write_text(&text)));
        spawn_local(async move {
            let outcome = match writing {
                Some(writing) => writing.await.map(|_| ()).map_err(|error| text_of(&error)),
                None => Err("The clipboard needs a page on https://".to_owned()),
            };
            let refused = services.0.borrow().on_copy_refused.clone();
            if let (Err(_), Some(refused)) = (&outcome, refused) {
                // A dialog with the text and a button of the page's own, whose click every browser accepts.
                let _ignored = refused.call1(&JsValue::NULL, &text.into());
                return;
            }
            services.0.borrow_mut().send(Message::Copied(outcome));
        });
    }

    fn paste_text(&mut self) {
        let services = self.clone();
        // Firefox asks with a button of its own; what is refused is refused without a reason.
        let can_read = |c: &web_sys::Clipboard| {
            c.is_object() && js_sys::Reflect::has(c, &"readText".into()).unwrap_or(false)
        };
        let clipboard = window().map(|w| w.navigator().clipboard()).filter(can_read);
        let reading = clipboard.map(|c| JsFuture::from(c.read_text()));
        spawn_local(async move {
            let text = match reading {
                Some(reading) => reading.await.ok().and_then(|text| text.as_string()),
                None => None,
            };
            services.0.borrow_mut().send(Message::Pasted(text));
        });
    }

    fn page_address(&self) -> String {
        page_address()
    }

    fn set_link(&mut self, payload: &str, change: LinkChange) {
        let mut page = self.0.borrow_mut();
        if page.payload == payload {
            return;
        }
        payload.clone_into(&mut page.payload);
        let address = format!("{}#{payload}", page_address());
        let history = window().and_then(|w| w.history().ok());
        let written = history.map(|history| match change {
            LinkChange::Replace => {
                history.replace_state_with_url(&JsValue::NULL, "", Some(&address))
            }
            LinkChange::Push => history.push_state_with_url(&JsValue::NULL, "", Some(&address)),
        });
        // Safari refuses more than a hundred in half a minute; the next change writes what this one could not.
        if !matches!(written, Some(Ok(()))) {
            page.payload.clear();
        }
    }

    fn announce(&mut self, text: &str) {
        let document = window().and_then(|w| w.document());
        let line = document.and_then(|d| d.get_element_by_id("said"));
        if let Some(line) = line {
            line.set_text_content(Some(text));
        }
    }

    fn store(&mut self, key: &str, value: &str) {
        // A tab comes back to its own document; a new one to the last that any tab kept. The rest is for all tabs.
        let of_tab = tab_storage().filter(|_| key == STORED_DOCUMENT);
        for storage in [of_tab, storage()].into_iter().flatten() {
            // Full or forbidden: the address bar still holds the document.
            let _ignored = storage.set_item(&format!("fabrica.{key}"), value);
        }
    }

    fn set_title(&mut self, title: &str) {
        if let Some(document) = window().and_then(|w| w.document()) {
            document.set_title(title);
        }
    }

    fn languages(&self) -> Vec<String> {
        let wanted = window().map(|w| w.navigator().languages());
        let wanted = wanted.into_iter().flat_map(|list| list.to_vec());
        wanted.filter_map(|tag| tag.as_string()).collect()
    }

    fn has_fingers(&self) -> bool {
        matches_media("(pointer: coarse)")
    }

    fn wants_contrast(&self) -> bool {
        matches_media("(prefers-contrast: more)")
    }

    fn wants_less_motion(&self) -> bool {
        matches_media("(prefers-reduced-motion: reduce)")
    }

    fn sets_texts(&self) -> bool {
        self.0.borrow().texts.is_some()
    }

    fn show_texts(&mut self, over: &[TextOver]) -> Vec<egui::Vec2> {
        let (page, zoom) = {
            let page = self.0.borrow();
            let zoom = page.ctx.as_ref().map_or(1.0, egui::Context::zoom_factor);
            (page.texts.clone(), zoom)
        };
        page.map_or_else(Vec::new, |page| texts::shown(&page, over, zoom))
    }

    fn set_text(&self, text: &TextToSet) -> Option<SetText> {
        let page = self.0.borrow().texts.clone();
        texts::set(&page?, text)
    }

    fn stored(&self, key: &str) -> Option<String> {
        kept(key)
    }
}
