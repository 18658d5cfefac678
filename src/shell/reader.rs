//! The lesson's viewer as `web/reader` sees it: one device and one set of data for all pictures of a page.

use std::cell::{Cell, RefCell};
use std::collections::{BTreeMap, BTreeSet};
use std::rc::{Rc, Weak};

use js_sys::{Array, Function, Uint8ClampedArray};
use serde_json::{Value, json};
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::spawn_local;
use web_sys::{Blob, HtmlCanvasElement};

use super::address::{
    absolute, address_task, at_base, builtin_task, fetched, file_task, foreign_host, part_of,
};
use super::loading::wanted_file;
use super::wished;
use super::worker::answer::Answer;
use super::worker::fault::text_of;
use super::worker::run::{self, BendWorker, Maker, WorkerLoad};
use super::worker::task::{ClayTask, Part, ScanTask, Task};
use crate::assets::{BendAnswer, LoadEvent, Role, SegmentationsExpected, Source, Want};
use crate::describe::{Lang, seen_from};
use crate::document::Illustration;
use crate::link::{self, Qr};
use crate::reader::{Picture, Stock, StockKey, Visit, outline, texts};
use crate::render::{Gpu, GpuOptions, RenderError};

/// Called once when the program has been loaded.
pub fn loaded() {}

/// Seconds since the page was opened.
fn seconds() -> f64 {
    let performance = web_sys::window().and_then(|w| w.performance());
    performance.map_or(0.0, |p| p.now() * 1e-3)
}

/// The texts of a link, a payload or a document, as JSON: see `fabrica::reader::outline`. `part` names the part of the
/// program that makes or reads its subject, if that can be started at once;
/// `base` is what relative addresses start from.
///
/// # Errors
/// What is wrong with the link or the document.
#[wasm_bindgen]
pub fn outline_of(text: &str, base: &str) -> Result<String, JsValue> {
    let (document, mut found) = outline(text)?;
    found["part"] = json!(part_of(&document, base).map(Part::name));
    Ok(found.to_string())
}

/// The payload of a link to the document in a text: a link, a payload or a document.
///
/// # Errors
/// What is wrong with the link or the document.
#[wasm_bindgen]
pub fn payload_of(text: &str) -> Result<String, JsValue> {
    Ok(link::encode(&link::document_of(text)?.document))
}

/// The modules of a text's QR code as a square, row by row from the top: 1 for a dark one. Those around it that stay
/// light are among them.
///
/// # Errors
/// If the text is too long for a code.
#[wasm_bindgen]
pub fn qr_of(text: &str) -> Result<Vec<u8>, JsValue> {
    let code = Qr::of(text).map_err(|error| error.to_string())?;
    let (_, gray) = code.to_gray(1);
    Ok(gray.into_iter().map(|gray| u8::from(gray == 0)).collect())
}

thread_local! {
    /// Hears of a panic.
    static ON_PANIC: RefCell<Option<Function>> = const { RefCell::new(None) };
}

/// From now on the text of a panic goes to `hear`, before the trap that it ends in. Nothing of the program may be
/// called after that, except [`Reader::at_work`] and [`Reader::give_up`].
#[wasm_bindgen]
pub fn on_panic(hear: Function) {
    ON_PANIC.set(Some(hear));
    std::panic::set_hook(Box::new(|info| {
        if let Some(hear) = ON_PANIC.with_borrow(Clone::clone) {
            let _nobody_listens = hear.call1(&JsValue::NULL, &info.to_string().into());
        }
    }));
}

/// The picture may be shown.
const HAS_PICTURE: u32 = 1;
/// The picture is complete, and nothing is under way for it.
const IS_DONE: u32 = 2;
/// A passage goes on.
const IS_MOVING: u32 = 4;
/// All that there is to draw is drawn; more comes when a load goes on, or a finer drawing.
const WAITS: u32 = 8;

/// Bytes that all subjects of a page may take on the device, unless the picture in use needs more.
const BUDGET: u64 = 512 << 20;

/// A picture and the canvas that it is shown on.
struct Shown {
    picture: Picture,
    canvas: HtmlCanvasElement,
    surface: Option<wgpu::Surface<'static>>,
    configured: [u32; 2],
    stock: u32,
    base: String,
    /// It has given its memory back since it was drawn.
    is_resting: bool,
    /// Bends its figure, once it has one.
    bender: Option<BendWorker>,
}

/// A stock and what is being fetched for it.
struct Stocked {
    stock: Stock,
    load: Option<WorkerLoad>,
    /// The want of a host that the reader has to agree to, with its address.
    asks: Option<(Want, String, String)>,
    /// A file that only the reader has.
    wants_file: bool,
    /// Fields that are being fetched.
    fields: Vec<Want>,
    /// When a picture of it was drawn last, seconds.
    used: f64,
}

struct Inner {
    instance: wgpu::Instance,
    gpu: Gpu,
    /// Makes workers for parts of the program.
    worker: Maker,
    shown: BTreeMap<u32, Shown>,
    stocks: BTreeMap<u32, Stocked>,
    next_id: u32,
    /// Bytes that all subjects may take on the device.
    budget: u64,
    allowed_hosts: BTreeSet<String>,
    /// Passages are cut, since the reader wants less motion.
    has_less_motion: bool,
    /// Called when something has come of a load.
    on_news: Function,
    /// The pictures whose data are worked on.
    at_work: Rc<Cell<Vec<u32>>>,
}

/// All pictures of a page.
#[wasm_bindgen]
pub struct Reader {
    inner: Rc<RefCell<Inner>>,
    /// The device, to be given back where a fault has left everything else as it was at that moment.
    device: RefCell<wgpu::Device>,
    at_work: Rc<Cell<Vec<u32>>>,
    is_lost: Cell<bool>,
    is_ended: Cell<bool>,
}

#[wasm_bindgen]
impl Reader {
    /// Opens a device. `worker` makes a worker, or what behaves like one; `on_news` is called when something has come
    /// of a load, so that a frame is due.
    ///
    /// # Errors
    /// If there is no device.
    pub async fn start(worker: Function, on_news: Function) -> Result<Reader, JsValue> {
        let gpu = open_gpu().await?;
        let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
        descriptor.backends = wgpu::Backends::BROWSER_WEBGPU;
        let device = gpu.device.clone();
        let at_work = Rc::default();
        let inner = Inner {
            instance: wgpu::Instance::new(descriptor),
            gpu,
            worker: Maker::Page(worker),
            shown: BTreeMap::new(),
            stocks: BTreeMap::new(),
            next_id: 1,
            budget: BUDGET,
            allowed_hosts: BTreeSet::new(),
            has_less_motion: false,
            on_news,
            at_work: Rc::clone(&at_work),
        };
        Ok(Self {
            inner: Rc::new(RefCell::new(inner)),
            device: RefCell::new(device),
            at_work,
            is_lost: Cell::new(false),
            is_ended: Cell::new(false),
        })
    }

    /// Takes a worker that web/parts.js started for the part of this name; the part's next task goes to it.
    pub fn lend(&self, part: &str, worker: web_sys::Worker) {
        if let Some(part) = Part::of_name(part) {
            run::lend(part, worker);
        }
    }

    /// Adds a picture of a link, a payload or a document, at a step or at that of the link. `base` is what relative
    /// addresses start from. Returns the number that the picture has from now on.
    ///
    /// # Errors
    /// What is wrong with the link or the document, or with the canvas.
    pub fn add(
        &self,
        canvas: HtmlCanvasElement,
        text: &str,
        base: String,
        step: Option<usize>,
    ) -> Result<u32, JsValue> {
        let visit = Visit::open(text, step).map_err(JsValue::from)?;
        let mut inner = self.inner.borrow_mut();
        let inner = &mut *inner;
        let surface = inner.surface(&canvas)?;
        let id = inner.new_id();
        let mut shown = Shown {
            picture: Picture::new(inner.gpu.clone(), seconds, visit),
            canvas,
            surface: Some(surface),
            configured: [0, 0],
            stock: 0,
            base,
            is_resting: false,
            bender: None,
        };
        shown.stock = inner.stock_for(&shown.picture.visit, &shown.base, id);
        inner.shown.insert(id, shown);
        Ok(id)
    }

    /// Takes a picture away, with the data that only it has used.
    pub fn remove(&self, id: u32) {
        let mut inner = self.inner.borrow_mut();
        if let Some(mut shown) = inner.shown.remove(&id) {
            shown.picture.destroy();
        }
        inner.drop_unused();
    }

    /// Gives the picture's memory on the device back; what its canvas shows stays. The next [`Reader::draw`] makes it
    /// anew.
    pub fn rest(&self, id: u32) {
        let mut inner = self.inner.borrow_mut();
        if let Some(shown) = inner.shown.get_mut(&id) {
            shown.picture.destroy();
            shown.is_resting = true;
        }
        inner.keep_budget();
    }

    /// Somebody turns to a picture: its data are used from now on, though nothing of it may have to be drawn yet.
    pub fn turn_to(&self, id: u32) {
        let mut inner = self.inner.borrow_mut();
        let inner = &mut *inner;
        if let Some(shown) = inner.shown.get_mut(&id) {
            shown.is_resting = false;
            if let Some(stocked) = inner.stocks.get_mut(&shown.stock) {
                stocked.used = seconds();
            }
        }
    }

    /// Sets how many bytes all subjects together may take on the device.
    pub fn set_budget(&self, bytes: f64) {
        let mut inner = self.inner.borrow_mut();
        inner.budget = bytes as u64;
        inner.keep_budget();
    }

    /// Takes everything away, the device too.
    pub fn destroy(&self) {
        self.is_ended.set(true);
        run::end_waiting();
        let mut inner = self.inner.borrow_mut();
        for shown in inner.shown.values_mut() {
            shown.picture.destroy();
        }
        inner.shown.clear();
        inner.drop_unused();
        inner.gpu.device.destroy();
    }

    /// After a fault: the pictures whose data were worked on, if it was in that work.
    pub fn at_work(&self) -> Vec<u32> {
        self.at_work.take()
    }

    /// After a fault: gives the device back, and with it all that was made on it.
    pub fn give_up(&self) {
        self.is_ended.set(true);
        self.device.borrow().destroy();
    }

    /// Goes on with data: fetches, uploads, makes segments, for about `budget` seconds. True if there is more to do at
    /// once.
    pub fn tick(&self, budget: f32) -> bool {
        Inner::fetch(&self.inner);
        let mut inner = self.inner.borrow_mut();
        let inner = &mut *inner;
        let mut is_busy = false;
        for (id, stocked) in &mut inner.stocks {
            inner.at_work.set(pictures_of(&inner.shown, *id));
            match stocked.stock.advance(budget) {
                // The others get their turn when this one's data are whole: together they would hold up the frame.
                Ok(true) => {
                    is_busy = true;
                    break;
                }
                Ok(false) => {}
                Err(RenderError::DeviceLost(_)) => self.is_lost.set(true),
                Err(error) => stocked.stock.fail(error.to_string()),
            }
        }
        inner.at_work.take();
        is_busy
    }

    /// One frame of a picture, of this size in pixels, at the time `now` (seconds, as `performance.now()` / 1000).
    /// `is_moving` says that more changes are about to come. Returns what became of it: the sum of 1 (there is a
    /// picture, and the canvas has it), 2 (it is complete, with all data), 4 (a passage goes on), 8 (nothing is left
    /// to draw before a load goes on).
    ///
    /// # Errors
    /// In words: why nothing can be drawn.
    pub fn draw(
        &self,
        id: u32,
        width: u32,
        height: u32,
        now: f64,
        budget: f32,
        is_moving: bool,
    ) -> Result<u32, JsValue> {
        let mut inner = self.inner.borrow_mut();
        let inner = &mut *inner;
        let Some(shown) = inner.shown.get_mut(&id) else {
            return Ok(0);
        };
        shown.is_resting = false;
        let Some(stocked) = inner.stocks.get_mut(&shown.stock) else {
            // Its data have given way to others. They are fetched again before the next frame.
            inner.restock(id);
            return Ok(0);
        };
        stocked.used = now;
        let is_cut = inner.has_less_motion;
        let passes = match shown.picture.is_asking() {
            true => shown.picture.visit.is_moving(),
            false => shown.picture.visit.advance(now, is_cut),
        };
        let take = {
            let weak = Rc::downgrade(&self.inner);
            move |answer| {
                if let Some(inner) = weak.upgrade() {
                    Inner::take_bent(&inner, id, answer);
                }
            }
        };
        shown.ask_bender(&stocked.stock, &inner.worker, take.clone());
        let size = [width.max(1), height.max(1)];
        let is_moving = is_moving || passes;
        let drawn = match shown
            .picture
            .draw(&mut stocked.stock, size, budget, is_moving)
        {
            Ok(drawn) => drawn,
            Err(RenderError::DeviceLost(_)) => {
                self.is_lost.set(true);
                return Ok(0);
            }
            Err(error) => return Err(error.to_string().into()),
        };
        if drawn.is_done && shown.picture.see_closer(&stocked.stock) {
            // Nothing else may ask for another frame.
            shown.ask_bender(&stocked.stock, &inner.worker, take);
        }
        let mut flags = 0;
        if drawn.has_picture {
            shown.present(&inner.gpu);
            flags |= HAS_PICTURE;
        }
        if passes {
            flags |= IS_MOVING;
        }
        // A question about segments does not keep the subject from being whole.
        let asks_beside = stocked.asks.is_some() && stocked.stock.host().subject_info().is_some();
        let is_settled = asks_beside || stocked.stock.is_settled() && stocked.fields.is_empty();
        let is_settled = is_settled && !shown.picture.is_bending(&stocked.stock);
        let has_drawn_all = drawn.is_done || stocked.stock.host().subject_info().is_none();
        if is_settled && drawn.is_done && !passes {
            flags |= IS_DONE;
            if shown.picture.awaits_finer() {
                flags |= WAITS;
            }
        } else if !is_settled && has_drawn_all && !passes {
            flags |= WAITS;
        }
        Ok(flags)
    }

    /// Where a picture stands at the time `now`, seconds, and what it waits for, as JSON: `progress` (0 to 1, or null
    /// while nothing is loaded), `host` (that the reader has to agree to, or null), `file` (true if only the reader
    /// has it), `troubles` (texts), `failed` (there is no subject), `step`, `position`, `moving`, `playing`, `wait`
    /// (seconds to the next step, or null), `strayed`, `values` (of the document's controls), `stand` (for
    /// [`Reader::resume`]).
    pub fn state(&self, id: u32, now: f64) -> String {
        let inner = self.inner.borrow();
        let Some(shown) = inner.shown.get(&id) else {
            return "{}".to_owned();
        };
        // There is none while its data have given way to others: nothing is under way then, and nothing wrong.
        let stocked = inner.stocks.get(&shown.stock);
        let (stock, visit) = (stocked.map(|s| &s.stock), &shown.picture.visit);
        let subject = &visit.document().illustration().subject;
        let is_supplied = subject.supplied_sha256().is_some();
        let has_failed = stock.is_some_and(Stock::has_failed);
        let troubles = stock.map_or(&[][..], Stock::troubles);
        let of_figure = shown.picture.troubles().iter().map(String::as_str);
        let troubles = troubles.iter().map(|t| t.message.as_str());
        let troubles: Vec<&str> = troubles.chain(of_figure).collect();
        let asks = stocked.and_then(|s| s.asks.as_ref());
        json!({
            "progress": stock.and_then(|stock| stock.loading()).map(|(_, fraction)| fraction),
            "host": asks.map(|(_, _, host)| host),
            "file": stocked.is_some_and(|s| s.wants_file) || (has_failed && is_supplied),
            "troubles": troubles,
            "failed": has_failed,
            "step": visit.step(),
            "position": visit.position(),
            "moving": visit.is_moving(),
            "playing": visit.is_playing(),
            "wait": visit.seconds_to_next_step(now),
            "strayed": visit.has_strayed(),
            "values": visit.control_values(),
            "stand": visit.stand(),
        })
        .to_string()
    }

    /// The reader has agreed to fetch from this host.
    pub fn allow_host(&self, host: String) {
        self.inner.borrow_mut().allowed_hosts.insert(host);
    }

    /// The reader agrees to fetch from the host that a picture's data lie on.
    pub fn allow(&self, id: u32) {
        let mut inner = self.inner.borrow_mut();
        let inner = &mut *inner;
        let stock = inner.shown.get(&id).map(|shown| shown.stock);
        let asks = stock
            .and_then(|stock| inner.stocks.get_mut(&stock))
            .and_then(|stocked| stocked.asks.take());
        if let (Some((want, address, host)), Some(stock)) = (asks, stock) {
            inner.allowed_hosts.insert(host);
            if want.role == Role::Field {
                return; // It is missing still, and fetched with the next frame.
            }
            let base = inner
                .stocks
                .get(&stock)
                .map_or("", |s| s.stock.key().base());
            let task = address_task(address, &at_base(&want, base));
            let started = inner.start_load(stock, &task, &self.inner);
            inner.loads(stock, started);
        }
    }

    /// The reader gives the files that a picture asks for.
    pub fn give(&self, id: u32, files: Array) {
        let files: Vec<(String, Blob)> = files
            .iter()
            .filter_map(|file| file.dyn_into::<web_sys::File>().ok())
            .map(|file| (file.name(), file.into()))
            .collect();
        let mut inner = self.inner.borrow_mut();
        let inner = &mut *inner;
        let Some(stock) = inner.shown.get(&id).map(|shown| shown.stock) else {
            return;
        };
        let Some(stocked) = inner.stocks.get_mut(&stock) else {
            return;
        };
        if files.is_empty() || !stocked.stock.retry() {
            return;
        }
        stocked.wants_file = false;
        let Some(want) = stocked.stock.next_want() else {
            return;
        };
        let task = ScanTask::Files {
            files,
            reading: want.reading.clone(),
            segmentations: SegmentationsExpected::default(),
            may_be_field: false,
        };
        let started = inner.start_load(stock, &file_task(&want, task), &self.inner);
        inner.loads(stock, started);
    }

    /// Whether the reader wants less motion: passages are cut then.
    pub fn set_less_motion(&self, has_less_motion: bool) {
        self.inner.borrow_mut().has_less_motion = has_less_motion;
    }

    /// Goes to a step at the time `now`, seconds. Returns the step that is shown or under way to.
    pub fn go(&self, id: u32, step: usize, now: f64) -> usize {
        let is_cut = self.inner.borrow().has_less_motion;
        self.with(id, |visit| {
            visit.go(step, now, is_cut);
            visit.step()
        })
    }

    /// Plays the lesson from what is shown at the time `now`, seconds, or stands still.
    pub fn toggle_playing(&self, id: u32, now: f64) {
        let is_cut = self.inner.borrow().has_less_motion;
        self.with(id, |visit| visit.toggle_playing(now, is_cut));
    }

    /// Shows a place between steps: 1.5 is the middle of the passage from step 1 to step 2.
    pub fn scrub(&self, id: u32, position: f32) {
        self.with(id, |visit| visit.scrub(position));
    }

    /// Turns the object under the hand: radians to the right and down.
    pub fn turn(&self, id: u32, right: f32, down: f32) {
        self.with(id, |visit| visit.turn(right, down));
    }

    /// Comes closer by a factor above 1, goes away by one below.
    pub fn zoom(&self, id: u32, factor: f32) {
        self.with(id, |visit| visit.zoom(factor));
    }

    /// Moves the object in the picture: parts of the picture's shorter side to the right and down.
    pub fn shift(&self, id: u32, right: f32, down: f32) {
        self.with(id, |visit| visit.shift(right, down));
    }

    /// Rolls a figure in the picture, radians, clockwise for positive.
    pub fn roll(&self, id: u32, angle: f32) {
        self.with(id, |visit| visit.roll(angle));
    }

    /// Back to what the author shows at this step.
    pub fn reset(&self, id: u32) {
        self.with(id, Visit::reset);
        self.inner.borrow_mut().restock(id);
    }

    /// The camera, as the document has it: JSON.
    pub fn view(&self, id: u32) -> String {
        self.with(id, |visit| visit.view().to_string())
    }

    /// Brings a picture that was just added to where another one stood: the `stand` of its [`Reader::state`].
    pub fn resume(&self, id: u32, stand: &str) {
        let stand: Value = serde_json::from_str(stand).unwrap_or_default();
        self.with(id, |visit| visit.resume(&stand));
        self.inner.borrow_mut().restock(id);
    }

    /// Sets one value of what is shown, by its JSON pointer, to a value given as JSON.
    ///
    /// # Errors
    /// What is wrong with the pointer or the value.
    pub fn set(&self, id: u32, pointer: &str, value: &str) -> Result<(), JsValue> {
        let value: Value = serde_json::from_str(value).map_err(|error| error.to_string())?;
        self.with(id, |visit| visit.set(pointer, value).err())
            .map_or(Ok(()), |error| Err(JsValue::from(error.to_string())))?;
        self.inner.borrow_mut().restock(id);
        Ok(())
    }

    /// Title, legend, captions and background of the step that is shown or under way to, as JSON: see
    /// `fabrica::reader::texts`.
    pub fn texts(&self, id: u32) -> String {
        self.with(id, |visit| texts(visit.bound_for()).to_string())
    }

    /// Where captions go: six numbers for each one that is in the picture. See `fabrica::reader::Picture::captions`.
    /// `room` is the width and height of the picture, what lies between texts and around them, and what is kept free at
    /// the edges and at the foot.
    pub fn captions(&self, id: u32, sizes: &[f32], room: &[f32]) -> Vec<f32> {
        let inner = self.inner.borrow();
        let (Some(shown), &[width, height, gap, edges, foot]) = (inner.shown.get(&id), room) else {
            return Vec::new();
        };
        let picture = &shown.picture;
        picture.captions([width, height], sizes, gap, [edges, foot])
    }

    /// What stands at the picture's edges, as JSON: see `fabrica::reader::Picture::marks`.
    pub fn marks(&self, id: u32) -> String {
        let inner = self.inner.borrow();
        let Some(shown) = inner.shown.get(&id) else {
            return "null".to_owned();
        };
        let stocked = inner.stocks.get(&shown.stock);
        let mm_per_unit = stocked.and_then(|stocked| stocked.stock.known_mm_per_unit());
        shown.picture.marks(mm_per_unit).to_string()
    }

    /// The picture, drawn once more in full: a Promise of its bytes (sRGB with straight alpha, rows from
    /// the top), width and height.
    pub fn picture(&self, id: u32) -> js_sys::Promise {
        let image = self
            .inner
            .borrow()
            .shown
            .get(&id)
            .map(|s| s.picture.image());
        wasm_bindgen_futures::future_to_promise(async move {
            let image = image.ok_or_else(|| JsValue::from("there is no such picture"))?;
            let image = image.await.map_err(|error| error.to_string())?;
            let bytes = Uint8ClampedArray::from(image.rgba.as_slice());
            let [width, height] = image.size;
            Ok(Array::of3(&bytes, &width.into(), &height.into()).into())
        })
    }

    /// The picture in words, in a language by its tag (`en` where it has none of this): a Promise of a text.
    pub fn describe(&self, id: u32, lang: &str) -> js_sys::Promise {
        let inner = self.inner.borrow();
        let lang = Lang::from_tag(lang).unwrap_or(Lang::English);
        let words = inner.shown.get(&id).and_then(|shown| {
            let stocked = inner.stocks.get(&shown.stock)?;
            Some(shown.picture.describe(&stocked.stock, lang))
        });
        wasm_bindgen_futures::future_to_promise(async move {
            Ok(match words {
                Some(words) => words.await.into(),
                None => JsValue::from(""),
            })
        })
    }

    /// From where one looks, in a language by its tag: a sentence without its end.
    pub fn side(&self, id: u32, lang: &str) -> String {
        let lang = Lang::from_tag(lang).unwrap_or(Lang::English);
        self.with(id, |visit| {
            // A figure is flat, and has no sides.
            if visit.shown().is_of_figure() {
                return String::new();
            }
            seen_from(visit.camera().rotate, &visit.shown().subject, lang)
        })
    }

    /// A Promise that is kept when the graphics device is lost, also by [`Reader::destroy`].
    pub fn lost(&self) -> js_sys::Promise {
        let lost = self.inner.borrow().gpu.until_lost();
        wasm_bindgen_futures::future_to_promise(async move {
            lost.await;
            Ok(JsValue::UNDEFINED)
        })
    }

    /// True if the graphics device was lost: [`Reader::restart`] is due.
    pub fn is_lost(&self) -> bool {
        self.is_lost.get()
    }

    /// Starts again on another device: the same pictures, the same data.
    ///
    /// # Errors
    /// If there is no device any more.
    pub async fn restart(&self) -> Result<(), JsValue> {
        let gpu = open_gpu().await?;
        if self.is_ended.get() {
            gpu.device.destroy();
            return Ok(());
        }
        let mut inner = self.inner.borrow_mut();
        let inner = &mut *inner;
        *self.device.borrow_mut() = gpu.device.clone();
        inner.gpu = gpu;
        for stocked in inner.stocks.values_mut() {
            let recovered = stocked.stock.recover(inner.gpu.clone());
            recovered.map_err(|error| error.to_string())?;
        }
        let canvases: Vec<(u32, HtmlCanvasElement)> = inner
            .shown
            .iter()
            .map(|(id, shown)| (*id, shown.canvas.clone()))
            .collect();
        for (id, canvas) in canvases {
            let surface = inner.surface(&canvas)?;
            if let Some(shown) = inner.shown.get_mut(&id) {
                (shown.surface, shown.configured) = (Some(surface), [0, 0]);
                let recovered = shown.picture.recover(inner.gpu.clone());
                recovered.map_err(|error| error.to_string())?;
            }
        }
        self.is_lost.set(false);
        Ok(())
    }
}

impl Reader {
    fn with<T: Default>(&self, id: u32, act: impl FnOnce(&mut Visit) -> T) -> T {
        let mut inner = self.inner.borrow_mut();
        let shown = inner.shown.get_mut(&id);
        shown.map_or_else(T::default, |shown| act(&mut shown.picture.visit))
    }
}

/// The pictures of a stock.
fn pictures_of(shown: &BTreeMap<u32, Shown>, stock: u32) -> Vec<u32> {
    let of_stock = shown.iter().filter(|(_, shown)| shown.stock == stock);
    of_stock.map(|(id, _)| *id).collect()
}

async fn open_gpu() -> Result<Gpu, JsValue> {
    let gpu = Gpu::open(&GpuOptions::default()).await;
    let gpu = gpu.map_err(|error| JsValue::from(error.to_string()))?;
    Ok(gpu.with_samples(wished::samples()))
}

impl Shown {
    /// Asks what bends the figure for what is wanted next, if anything; `take` hears the answers.
    fn ask_bender(
        &mut self,
        stock: &Stock,
        worker: &Maker,
        take: impl FnMut(BendAnswer) + 'static,
    ) {
        let Some(request) = self.picture.next_bend(stock) else {
            return;
        };
        let bender = self
            .bender
            .get_or_insert_with(|| BendWorker::new(worker.clone()));
        if let Err(error) = bender.ask(request, take) {
            let answer = BendAnswer::Lost(text_of(&error));
            self.picture.take_bent(answer);
        }
    }

    /// Hands the picture to the canvas.
    fn present(&mut self, gpu: &Gpu) {
        let Some(surface) = &self.surface else {
            return;
        };
        let size = self.picture.size_px();
        if self.configured != size {
            self.configured = size;
            surface.configure(
                &gpu.device,
                &wgpu::SurfaceConfiguration {
                    usage: wgpu::TextureUsages::COPY_DST | wgpu::TextureUsages::RENDER_ATTACHMENT,
                    format: wgpu::TextureFormat::Rgba8Unorm,
                    color_space: wgpu::SurfaceColorSpace::Auto,
                    width: size[0],
                    height: size[1],
                    present_mode: wgpu::PresentMode::Fifo,
                    desired_maximum_frame_latency: 2,
                    alpha_mode: wgpu::CompositeAlphaMode::PreMultiplied,
                    view_formats: Vec::new(),
                },
            );
        }
        if let wgpu::CurrentSurfaceTexture::Success(frame)
        | wgpu::CurrentSurfaceTexture::Suboptimal(frame) = surface.get_current_texture()
        {
            self.picture.renderer().copy_output(&frame.texture);
            gpu.queue.present(frame);
        }
    }
}

/// What has to be done for a want.
enum Way {
    Start(Box<Task>),
    Ask(String, String),
    File(String),
    Fail(String),
}

impl Inner {
    fn new_id(&mut self) -> u32 {
        let id = self.next_id;
        self.next_id += 1;
        id
    }

    fn surface(&self, canvas: &HtmlCanvasElement) -> Result<wgpu::Surface<'static>, JsValue> {
        let target = wgpu::SurfaceTarget::Canvas(canvas.clone());
        let surface = self.instance.create_surface(target);
        surface.map_err(|error| JsValue::from(error.to_string()))
    }

    /// The stock for a visit of the picture of a number: one that is there, or a new one.
    fn stock_for(&mut self, visit: &Visit, base: &str, picture: u32) -> u32 {
        let illustration = visit.document().illustration();
        let key = StockKey::new(illustration, base, picture);
        let found = self.stocks.iter().find(|(_, s)| *s.stock.key() == key);
        if let Some((id, _)) = found {
            return *id;
        }
        let id = self.new_id();
        let stocked = Stocked {
            stock: Stock::new(&self.gpu, seconds, key, illustration),
            load: None,
            asks: None,
            wants_file: false,
            fields: Vec::new(),
            used: seconds(),
        };
        self.stocks.insert(id, stocked);
        id
    }

    /// A document may have been given another subject.
    fn restock(&mut self, id: u32) {
        let Some(mut shown) = self.shown.remove(&id) else {
            return;
        };
        let stock = self.stock_for(&shown.picture.visit, &shown.base, id);
        if stock != shown.stock {
            shown.stock = stock;
            shown.picture.restock();
        }
        self.shown.insert(id, shown);
        self.drop_unused();
    }

    /// Lets go of the subjects that were not drawn for the longest time while all of them take more than they may.
    /// Those of pictures that do not rest stay, and those that only the reader has.
    fn keep_budget(&mut self) {
        loop {
            let bytes = self.stocks.values().map(|s| s.stock.host().subject_bytes());
            if bytes.sum::<u64>() <= self.budget {
                return;
            }
            let pictures = self.shown.values().filter(|shown| !shown.is_resting);
            let busy: BTreeSet<u32> = pictures.map(|shown| shown.stock).collect();
            let idle = self
                .stocks
                .iter()
                .filter(|(id, s)| !busy.contains(id) && s.stock.can_come_again());
            let oldest = idle.min_by(|(_, a), (_, b)| a.used.total_cmp(&b.used));
            let Some(oldest) = oldest.map(|(id, _)| *id) else {
                return;
            };
            self.remove_stock(oldest);
            let pictures = self.shown.values_mut();
            for shown in pictures.filter(|shown| shown.stock == oldest) {
                shown.picture.forget_subject();
            }
        }
    }

    fn drop_unused(&mut self) {
        let used: BTreeSet<u32> = self.shown.values().map(|shown| shown.stock).collect();
        let unused: Vec<u32> = self
            .stocks
            .keys()
            .filter(|id| !used.contains(id))
            .copied()
            .collect();
        for id in unused {
            self.remove_stock(id);
        }
    }

    /// Lets go of a subject, and with the last clay of the worker that rests until another stroke of it is shown.
    fn remove_stock(&mut self, id: u32) {
        let is_of_clay = |stocked: &Stocked| stocked.stock.key().is_of_clay();
        let was_clay = self.stocks.remove(&id).as_ref().is_some_and(is_of_clay);
        if was_clay && !self.stocks.values().any(is_of_clay) {
            run::end_resting();
        }
    }

    /// Starts whatever stocks want and nobody fetches yet.
    fn fetch(inner: &Rc<RefCell<Self>>) {
        let mut this = inner.borrow_mut();
        let this = &mut *this;
        let ids: Vec<u32> = this.stocks.keys().copied().collect();
        for id in ids {
            let Some(stocked) = this.stocks.get_mut(&id) else {
                continue;
            };
            let shown = this.shown.values().filter(|shown| shown.stock == id);
            let shown: Vec<&Illustration> =
                shown.map(|shown| shown.picture.visit.shown()).collect();
            shown.iter().for_each(|shown| stocked.stock.follow(shown));
            let wanted = stocked.stock.next_want();
            let mut shown = shown.into_iter();
            let object = || shown.find_map(|shown| stocked.stock.next_object(shown));
            let Some(want) = wanted.or_else(object) else {
                continue;
            };
            let way = this.way(id, &want);
            let Some(stocked) = this.stocks.get_mut(&id) else {
                continue;
            };
            match way {
                Way::Start(task) => {
                    let started = this.start_load(id, &task, inner);
                    this.loads(id, started);
                }
                Way::Ask(address, host) => stocked.asks = Some((want, address, host)),
                Way::File(message) => {
                    stocked.wants_file = true;
                    stocked.stock.fail(message);
                }
                Way::Fail(message) => stocked.stock.fail(message),
            }
        }
        this.fetch_fields(inner);
    }

    /// The bender of a picture has answered.
    fn take_bent(inner: &Rc<RefCell<Self>>, id: u32, answer: BendAnswer) {
        let on_news = {
            let mut inner = inner.borrow_mut();
            let inner = &mut *inner;
            if let Some(shown) = inner.shown.get_mut(&id) {
                inner.at_work.set(vec![id]);
                shown.picture.take_bent(answer);
                if let Some(stocked) = inner.stocks.get_mut(&shown.stock) {
                    shown.picture.show_finer(&mut stocked.stock);
                }
                inner.at_work.take();
            }
            inner.on_news.clone()
        };
        let _nobody_listens = on_news.call0(&JsValue::NULL);
    }

    fn way(&self, stock: u32, want: &Want) -> Way {
        match &want.source {
            Source::Builtin { name, revision } => {
                return Way::Start(Box::new(builtin_task((name, *revision), want)));
            }
            Source::Clay(clay) if !want.has_file() => {
                return Way::Start(Box::new(Task::Clay(ClayTask::of(clay, want), None)));
            }
            Source::Clay(_) | Source::File { .. } => {}
        }
        let Some(src) = want.src() else {
            let message = wanted_file(want.name());
            return match want.role {
                Role::Object | Role::Mesh | Role::Tool => Way::Fail(message),
                _ => Way::File(message),
            };
        };
        let base = self.stocks.get(&stock).map_or("", |s| s.stock.key().base());
        match absolute(src, base) {
            Ok(address) => match foreign_host(&address) {
                Some(host) if !self.allowed_hosts.contains(&host) => Way::Ask(address, host),
                _ => Way::Start(Box::new(address_task(address, &at_base(want, base)))),
            },
            Err(why) => Way::Fail(why),
        }
    }

    fn start_load(
        &self,
        stock: u32,
        task: &Task,
        inner: &Rc<RefCell<Self>>,
    ) -> Result<WorkerLoad, JsValue> {
        let weak: Weak<RefCell<Self>> = Rc::downgrade(inner);
        run::start(
            &self.worker,
            task,
            self.gpu.volume_limits(),
            move |answer| {
                let (Some(inner), Answer::Event(event)) = (weak.upgrade(), answer) else {
                    return;
                };
                let on_news = {
                    let mut inner = inner.borrow_mut();
                    let inner = &mut *inner;
                    if let Some(stocked) = inner.stocks.get_mut(&stock) {
                        inner.at_work.set(pictures_of(&inner.shown, stock));
                        stocked.stock.take(event);
                        inner.at_work.take();
                    }
                    inner.on_news.clone()
                };
                let _nobody_listens = on_news.call0(&JsValue::NULL);
            },
        )
    }

    /// Keeps a load, or tells that there is none.
    fn loads(&mut self, stock: u32, started: Result<WorkerLoad, JsValue>) {
        let Some(stocked) = self.stocks.get_mut(&stock) else {
            return;
        };
        match started {
            Ok(load) => stocked.load = Some(load),
            Err(error) => stocked.stock.take(LoadEvent::Failed {
                message: format!(
                    "This browser cannot load scans in the background: {}",
                    text_of(&error)
                ),
                details: String::new(),
                fault: None,
            }),
        }
    }

    /// Fetches displacement fields that pictures show, once the reader has agreed to their hosts.
    fn fetch_fields(&mut self, inner: &Rc<RefCell<Self>>) {
        for shown in self.shown.values() {
            let id = shown.stock;
            let Some(stocked) = self.stocks.get_mut(&id) else {
                continue;
            };
            for want in stocked.stock.missing_fields(shown.picture.visit.shown()) {
                if stocked.fields.contains(&want) {
                    continue;
                }
                let address = want.src().map(|src| absolute(src, &shown.base));
                let host = address
                    .as_ref()
                    .and_then(|at| foreign_host(at.as_deref().ok()?));
                if let (Some(host), Some(Ok(address))) = (host, &address)
                    && !self.allowed_hosts.contains(&host)
                {
                    let asks = (want, address.clone(), host);
                    stocked.asks.get_or_insert(asks);
                    continue;
                }
                stocked.fields.push(want.clone());
                let (inner, worker) = (Rc::clone(inner), self.worker.clone());
                spawn_local(async move {
                    let outcome = field(&worker, &want, address).await;
                    let on_news = {
                        let mut inner = inner.borrow_mut();
                        let inner = &mut *inner;
                        if let Some(stocked) = inner.stocks.get_mut(&id) {
                            inner.at_work.set(pictures_of(&inner.shown, id));
                            stocked.fields.retain(|other| *other != want);
                            stocked.stock.take_field(&want, outcome);
                            inner.at_work.take();
                        }
                        inner.on_news.clone()
                    };
                    let _nobody_listens = on_news.call0(&JsValue::NULL);
                });
            }
        }
    }
}

/// Reads a displacement field from its address, if it has one.
async fn field(
    worker: &Maker,
    want: &Want,
    address: Option<Result<String, String>>,
) -> Result<crate::load::FieldFile, String> {
    let missing = wanted_file(want.name());
    let address = address.ok_or_else(|| missing.clone())??;
    let blob = fetched(&address).await.ok_or(missing)?;
    let src = want.src().unwrap_or(&address);
    let name = src.rsplit('/').next().unwrap_or(src).to_owned();
    run::read_field(worker, name, blob).await
}
