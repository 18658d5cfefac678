//! The page: starts the viewer on a canvas and is what a page's scripts see of it.

use std::cell::RefCell;
use std::rc::Rc;
use std::sync::Arc;

use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::JsFuture;
use web_sys::{HtmlCanvasElement, PointerEvent, Url};

use super::address::{foreign_host, part_of};
use super::mirror::Mirror;
use super::page::{Page, PageServices, Place, kept_document};
use super::texts::Texts;
use super::wished;
use super::worker::run;
use super::worker::task::Part;
use crate::app::{App, Message, MissingDocument, Services as _, Start, WhyMissing, gpu_of};
use crate::data::VolumeLimits;
use crate::document::Document;
use crate::link;
use crate::render::Gpu;

/// An empty document: the head, nothing placed.
const EMPTY: &str = "{\"fabrica\":1}";

/// One viewer on one canvas.
#[wasm_bindgen]
pub struct Viewer {
    runner: eframe::WebRunner,
    canvas: HtmlCanvasElement,
    page: Rc<RefCell<Page>>,
    /// Text of a link or a document to open in place of the one in the address.
    text: RefCell<Option<String>>,
    _on_pop: Closure<dyn FnMut()>,
    _on_pen: Closure<dyn FnMut(PointerEvent)>,
}

#[wasm_bindgen]
impl Viewer {
    /// A viewer for this canvas; nothing is shown until [`Viewer::start`]. `worker` is the address of worker.js.
    #[wasm_bindgen(constructor)]
    pub fn new(canvas: HtmlCanvasElement, worker: String) -> Self {
        let base = web_sys::window().and_then(|w| w.document());
        let base = base.and_then(|d| d.base_uri().ok().flatten());
        let place = Place {
            worker,
            base: base.unwrap_or_default(),
        };
        run::set_known_address(&place.worker);
        let page = Rc::new(RefCell::new(Page::new(place)));
        let for_pop = Rc::clone(&page);
        let on_pop = Closure::new(move || {
            let text = address_text().unwrap_or_else(|| EMPTY.to_owned());
            let mut page = for_pop.borrow_mut();
            page.payload.clear();
            page.send(Message::OpenText { text });
        });
        if let Some(window) = web_sys::window() {
            window.set_onpopstate(Some(on_pop.as_ref().unchecked_ref()));
        }
        Self {
            runner: eframe::WebRunner::new(),
            text: RefCell::new(None),
            _on_pop: on_pop,
            _on_pen: hear_pen(&canvas, &page),
            canvas,
            page,
        }
    }

    /// Takes a worker that web/parts.js started for the part of this name; the part's next task goes to it.
    pub fn lend(&self, part: &str, worker: web_sys::Worker) {
        if let Some(part) = Part::of_name(part) {
            run::lend(part, worker);
        }
    }

    /// Starts to draw the document of the address (of a page) or of [`Viewer::set_link`]. A document that cannot be
    /// fetched is told in the viewer.
    ///
    /// # Errors
    /// If there is no WebGPU device for the canvas.
    pub async fn start(&self) -> Result<(), JsValue> {
        let given = self.text.borrow_mut().take();
        let text = match given {
            Some(text) => Some(text),
            None => match document_address() {
                Some(address) => {
                    self.page.borrow_mut().place.base.clone_from(&address);
                    match fetch_text(&address).await {
                        Ok(text) => Some(text),
                        Err(why) => {
                            let missing = MissingDocument { address, why };
                            return self.run(None, Some(missing)).await;
                        }
                    }
                }
                None => address_text(),
            },
        };
        self.run(text, None).await
    }

    /// Starts again after the graphics device was lost: the same document, the same files.
    ///
    /// # Errors
    /// If there is no device any more.
    pub async fn restart(&self) -> Result<(), JsValue> {
        let text = Some(self.get_link()).filter(|link| !link.is_empty());
        let text = text.unwrap_or_else(|| EMPTY.to_owned());
        self.runner.destroy();
        self.run(Some(text), None).await
    }

    async fn run(
        &self,
        text: Option<String>,
        missing: Option<MissingDocument>,
    ) -> Result<(), JsValue> {
        let mut setup = eframe::egui_wgpu::WgpuSetupCreateNew::without_display_handle();
        setup.instance_descriptor.backends = wgpu::Backends::BROWSER_WEBGPU;
        setup.device_descriptor = Arc::new(Gpu::device_descriptor);
        let options = eframe::WebOptions {
            renderer: eframe::Renderer::Wgpu,
            dithering: false,
            wgpu_options: eframe::egui_wgpu::WgpuConfiguration {
                wgpu_setup: setup.into(),
                ..Default::default()
            },
            should_prevent_default: Box::new(is_ours),
            should_stop_propagation: Box::new(is_ours),
            ..Default::default()
        };
        let page = Rc::clone(&self.page);
        let create: eframe::AppCreator<'static> = Box::new(move |cc| {
            {
                let mut page = page.borrow_mut();
                page.ctx = Some(cc.egui_ctx.clone());
                if let Some(state) = &cc.wgpu_render_state {
                    page.limits = VolumeLimits {
                        max_dim: state.device.limits().max_texture_dimension_3d,
                        ..page.limits
                    };
                }
            }
            let start = Start {
                link: None,
                text,
                missing,
                subject: None,
                gpu: cc
                    .wgpu_render_state
                    .as_ref()
                    .map(|state| gpu_of(state).with_samples(wished::samples())),
                clock: seconds,
            };
            let app = App::new(cc, Box::new(PageServices(page)), start);
            Ok(Box::new(Shown { app }))
        });
        self.runner
            .start(self.canvas.clone(), options, create)
            .await
    }

    /// Ends drawing and frees the device. The viewer can be started again.
    pub fn destroy(&self) {
        self.runner.destroy();
        PageServices(Rc::clone(&self.page)).show_texts(&[]);
    }

    /// Opens a link, a payload or a document as JSON; what is wrong with a bad one is shown in the viewer.
    pub fn set_link(&self, text: String) {
        let mut page = self.page.borrow_mut();
        if page.ctx.is_none() {
            self.text.replace(Some(text));
        } else {
            page.payload.clear();
            page.send(Message::OpenText { text });
        }
    }

    /// Payload of the link to the illustration shown now, and `&step=N` if a step is shown.
    pub fn get_link(&self) -> String {
        self.runner
            .app_mut::<Shown>()
            .map(|shown| {
                let fragment = link::fragment(&shown.app.document(), shown.app.step());
                fragment.trim_start_matches('#').to_owned()
            })
            .unwrap_or_default()
    }

    /// The document that is shown now, as JSON.
    pub fn get_document(&self) -> String {
        self.document_text().unwrap_or_default()
    }

    fn document_text(&self) -> Option<String> {
        let shown = self.runner.app_mut::<Shown>()?;
        Some(shown.app.document().to_json_compact())
    }

    /// The controls and texts that are seen, a line each: role, name, value, and where it lies in the canvas (left,
    /// top, width and height, CSS pixels), parted by tabs. Tabs and line breaks in a name or value are spaces here. A
    /// text has a value and no name. Empty at the first call; the next frame makes the list.
    pub fn controls(&self) -> String {
        let page = self.page.borrow();
        let Some(ctx) = &page.ctx else {
            return String::new();
        };
        let text = ctx.plugin_or_default::<Mirror>().lock().lines(ctx);
        if text.is_empty() {
            ctx.enable_accesskit();
            ctx.request_repaint();
        }
        text
    }

    /// The controls and texts of the last frame for web/mirror.js, as JSON: see `Mirror::list` in src/shell/mirror.rs.
    /// Empty if nothing was drawn since the last call, and at the first one; the next frame makes the list.
    pub fn mirrored(&self) -> String {
        let page = self.page.borrow();
        let Some(ctx) = &page.ctx else {
            return String::new();
        };
        let mirror = ctx.plugin_or_default::<Mirror>();
        if !mirror.lock().has_list() {
            ctx.enable_accesskit();
            ctx.request_repaint();
        }
        mirror.lock().list(ctx)
    }

    /// Does what assistive technology asks of a control of [`Viewer::mirrored`]: `focus`, `click`, `text` (with the
    /// new text) or `number` (with the new value).
    pub fn act(&self, id: &str, action: &str, value: &str) {
        if let Some(ctx) = &self.page.borrow().ctx {
            let is_known = ctx
                .plugin_or_default::<Mirror>()
                .lock()
                .ask(id, action, value);
            if is_known {
                ctx.request_repaint();
            }
        }
    }

    /// Number of frames drawn since the viewer was started. A viewer that sleeps draws none: see
    /// [`Viewer::request_frame`].
    pub fn frame(&self) -> u32 {
        let page = self.page.borrow();
        let number = page.ctx.as_ref().map_or(0, |ctx| ctx.cumulative_frame_nr());
        number as u32
    }

    /// Asks for one more frame, though nothing may have changed.
    pub fn request_frame(&self) {
        if let Some(ctx) = &self.page.borrow().ctx {
            ctx.request_repaint();
        }
    }

    /// True when the picture is complete and nothing is being loaded.
    pub fn is_at_rest(&self) -> bool {
        let shown = self.runner.app_mut::<Shown>();
        shown.is_some_and(|shown| shown.app.is_at_rest())
    }

    /// True if Ctrl and F find a tissue here, and not words of the page: the viewer has the keyboard, and no sheet lies
    /// over its panels.
    pub fn finds_tissues(&self) -> bool {
        let page = self.page.borrow();
        let has_keyboard = |ctx: &egui::Context| ctx.input(|i| i.focused);
        page.ctx.as_ref().is_some_and(has_keyboard)
            && self
                .runner
                .app_mut::<Shown>()
                .is_some_and(|shown| shown.app.finds_tissues())
    }

    /// True if the graphics device was lost: [`Viewer::restart`] is due.
    pub fn is_lost(&self) -> bool {
        let shown = self.runner.app_mut::<Shown>();
        shown.is_some_and(|shown| shown.app.is_device_lost())
    }

    /// True if a fault has stopped the viewer.
    pub fn has_panicked(&self) -> bool {
        self.runner.has_panicked()
    }

    /// What stopped it, or nothing.
    pub fn panic_message(&self) -> String {
        let summary = self.runner.panic_summary();
        summary.map(|s| s.message()).unwrap_or_default()
    }

    /// The picture as the bytes of a PNG: a Promise.
    pub fn picture(&self) -> js_sys::Promise {
        js_sys::Promise::new(&mut |resolve, reject| {
            let Some(mut shown) = self.runner.app_mut::<Shown>() else {
                let _ignored = reject.call1(&JsValue::NULL, &"the viewer has not started".into());
                return;
            };
            self.page.borrow_mut().picture_wanted = Some(resolve);
            shown.app.ask_for_picture();
            if let Some(ctx) = &self.page.borrow().ctx {
                ctx.request_repaint();
            }
        })
    }

    /// A function called with a text that the browser did not let onto the clipboard.
    pub fn on_copy_refused(&self, function: js_sys::Function) {
        self.page.borrow_mut().on_copy_refused = Some(function);
    }

    /// What sets captions over the canvas and letters into saved pictures, from the start on: see web/texts.js.
    pub fn set_texts(&self, texts: Texts) {
        self.page.borrow_mut().texts = Some(texts);
    }

    /// Goes to the field of the caption of this number, from 0.
    pub fn edit_caption(&self, caption: usize) {
        if let Some(mut shown) = self.runner.app_mut::<Shown>() {
            shown.app.edit_caption(caption);
        }
        self.request_frame();
    }

    /// Opens files as if the reader had picked them.
    pub fn open_files(&self, files: js_sys::Array) {
        let files = files.iter().map(|file| {
            let file: web_sys::File = file.unchecked_into();
            (file.name(), file.into())
        });
        PageServices(Rc::clone(&self.page)).open_files(files.collect());
    }
}

/// The app, as something that can be found again in its runner.
struct Shown {
    app: App,
}

impl eframe::App for Shown {
    fn ui(&mut self, ui: &mut egui::Ui, frame: &mut eframe::Frame) {
        self.app.ui(ui, frame);
    }

    fn as_any_mut(&mut self) -> Option<&mut dyn std::any::Any> {
        Some(self)
    }

    fn clear_color(&self, visuals: &egui::Visuals) -> [f32; 4] {
        self.app.clear_color(visuals)
    }

    fn persist_egui_memory(&self) -> bool {
        false
    }
}

/// Keeps how hard a pen presses on the canvas: eframe takes it for a mouse, or for a finger.
fn hear_pen(
    canvas: &HtmlCanvasElement,
    page: &Rc<RefCell<Page>>,
) -> Closure<dyn FnMut(PointerEvent)> {
    let page = Rc::clone(page);
    let on_pen = Closure::new(move |event: PointerEvent| {
        let kind = event.pointer_type();
        // A palm may rest beside the pen.
        if kind != "touch" {
            let presses = kind == "pen" && event.buttons() != 0;
            page.borrow_mut().pen = presses.then(|| event.pressure());
        }
    });
    for kind in ["pointerdown", "pointermove", "pointerup", "pointercancel"] {
        let listener = on_pen.as_ref().unchecked_ref();
        // No browser refuses.
        let _heard = canvas.add_event_listener_with_callback(kind, listener);
    }
    on_pen
}

/// Whether the page must not also act on an event. Keys that belong to the browser (reload, tools, full screen, what
/// goes with Ctrl and is no shortcut of ours) stay with it.
fn is_ours(event: &egui::Event) -> bool {
    use egui::{Event, Key};
    match event {
        Event::Key { key, .. } => !matches!(
            key,
            Key::F1 | Key::F3 | Key::F5 | Key::F6 | Key::F7 | Key::F10 | Key::F11 | Key::F12
        ),
        _ => true,
    }
}

/// Seconds since the page was opened.
pub(super) fn seconds() -> f64 {
    let performance = web_sys::window().and_then(|w| w.performance());
    performance.map_or(0.0, |p| p.now() * 1e-3)
}

fn here() -> Option<Url> {
    let href = web_sys::window()?.location().href().ok()?;
    Url::new(&href).ok()
}

/// The page's address, if a document is in it.
fn address_text() -> Option<String> {
    let url = here()?;
    let has_document = url.hash().len() > 1 || url.search_params().has("s");
    has_document.then(|| url.href())
}

/// The absolute address of `?doc=`, unless a payload in the address goes before it.
fn document_address() -> Option<String> {
    let url = here()?;
    let wanted = url.search_params().get("doc")?;
    if link::has_payload(&url.href()) {
        return None;
    }
    Url::new_with_base(&wanted, &url.href())
        .ok()
        .map(|u| u.href())
}

async fn fetch_text(address: &str) -> Result<String, WhyMissing> {
    const LIMIT: f64 = 2e6;
    let unreachable =
        |error: &JsValue| WhyMissing::Unreachable(super::worker::fault::text_of(error));
    let window = web_sys::window();
    let window = window.ok_or_else(|| WhyMissing::Unreachable("no window".to_owned()))?;
    let response = JsFuture::from(window.fetch_with_str(address)).await;
    let response: web_sys::Response = response.map_err(|e| unreachable(&e))?.unchecked_into();
    if !response.ok() {
        return Err(WhyMissing::Answer(response.status()));
    }
    let length = response.headers().get("content-length");
    let length = length.ok().flatten().and_then(|n| n.parse::<f64>().ok());
    if length.is_some_and(|n| n > LIMIT) {
        return Err(WhyMissing::TooLong);
    }
    let text = response.text().map_err(|e| unreachable(&e))?;
    let text = JsFuture::from(text).await.map_err(|e| unreachable(&e))?;
    text.as_string()
        .ok_or_else(|| WhyMissing::Unreachable("no text".to_owned()))
}

/// Called once when the program has been loaded. Starting is left to web/start.js.
pub fn loaded() {}

/// Host that `?doc=` would fetch from, if it is not the page's own: nothing is fetched from it without a tap.
#[wasm_bindgen]
pub fn foreign_document_host() -> Option<String> {
    foreign_host(&document_address()?)
}

/// The name of the part (see web/parts.js) that the document of the page's address needs first, or the document that
/// was stored on an earlier visit: see [`part_of`].
#[wasm_bindgen]
pub fn part_of_address() -> Option<String> {
    if document_address().is_some() {
        return None;
    }
    let document = open(&address_text().or_else(kept_document)?).ok()?;
    let part = part_of(&document, &here()?.href())?;
    Some(part.name().to_owned())
}

/// Title, legend, steps and the author's texts in place of pictures, of the document in a link or JSON, as lines of
/// text, for where no picture can be drawn.
///
/// # Errors
/// What is wrong with the link or the document.
#[wasm_bindgen]
pub fn describe(text: &str) -> Result<String, JsValue> {
    let illustration = open(text)?.illustration().clone();
    let mut lines = vec![illustration.title, illustration.legend, illustration.alt];
    for (index, step) in illustration.steps.iter().enumerate() {
        let line = format!("{}. {} {} {}", index + 1, step.title, step.legend, step.alt);
        lines.push(line.trim_end().to_owned());
    }
    lines.retain(|line| !line.trim().is_empty());
    Ok(lines.join("\n"))
}

/// The document of a link, a payload or JSON.
pub(super) fn open(text: &str) -> Result<Document, JsValue> {
    let opened = link::document_of(text);
    opened.map(|link| link.document).map_err(JsValue::from)
}
