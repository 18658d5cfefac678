//! What the browser tests stand on: a browser with a software WebGPU, a server for the built page, tabs and pictures of
//! them. Nothing is skipped: a missing part fails with what to do about it.

pub(crate) use super::running::Gpu;
use super::running::{RUNTIME, Running, Stage, alone, timed};
use super::server::Server;
use base64::Engine as _;
use chromiumoxide::Page;
use chromiumoxide::browser::Browser;
use chromiumoxide::cdp::browser_protocol::browser::{
    BrowserContextId, PermissionDescriptor, PermissionSetting, SetPermissionParams,
};
use chromiumoxide::cdp::browser_protocol::emulation::SetDeviceMetricsOverrideParams;
use chromiumoxide::cdp::browser_protocol::input::{
    DispatchKeyEventParams, DispatchKeyEventType, DispatchMouseEventParams, DispatchMouseEventType,
    MouseButton,
};
use chromiumoxide::cdp::browser_protocol::page::CaptureScreenshotFormat;
use chromiumoxide::cdp::browser_protocol::target::{
    CreateBrowserContextParams, CreateTargetParams,
};
use chromiumoxide::error::CdpError;
use chromiumoxide::page::ScreenshotParams;
use futures::FutureExt as _;
use std::collections::VecDeque;
use std::future::Future;
use std::panic::AssertUnwindSafe;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant, SystemTime};
use tokio::time::timeout;

/// No browser test may take longer; a hanging browser must not hold up everything after it.
const LIMIT: Duration = Duration::from_secs(900);
/// Closing what a test has opened may not take longer.
const CLOSING: Duration = Duration::from_secs(10);
/// Between two questions of what is waited for.
const ROUND: Duration = Duration::from_millis(30);

/// The page's viewer.
const VIEWER: &str = "window.fabrica.viewer";

/// Runs in every page before its own scripts: keeps what the page complains of, the graphics devices that it made and
/// the texts of their shaders by label, and counts frames for [`Tab::frames`]. A page that sleeps is asked for the
/// frames. Finished pictures have one sample for each pixel: a software GPU takes the longest for the others.
const PREPARED: &str = r#"
window.fabricaSamples = 1;
window.messages = [];
for (const kind of ["log", "info", "warn", "error"]) {
  const write = console[kind];
  console[kind] = (...words) => { window.messages.push(kind + ": " + words.join(" ")); write(...words); };
}
// An event called `error` of an element on the page is no fault of a script.
addEventListener("error", (event) => event instanceof ErrorEvent && window.messages.push("uncaught: " + event.message));
addEventListener("unhandledrejection", (event) => window.messages.push("unhandled: " + event.reason));
addEventListener("securitypolicyviolation", (event) => window.messages.push("policy: " + event.violatedDirective + " " + event.blockedURI));
if (window.GPUAdapter) {
  const make = GPUDevice.prototype.createShaderModule;
  window.shaders = {};
  GPUDevice.prototype.createShaderModule = function (module) {
    window.shaders[module.label] = module.code;
    return make.call(this, module);
  };
  const request = GPUAdapter.prototype.requestDevice;
  window.devices = [];
  GPUAdapter.prototype.requestDevice = async function (...wanted) {
    const device = await request.apply(this, wanted);
    window.devices.push(device);
    return device;
  };
}
window.framesLater = async (viewer, wanted) => {
  const start = performance.now();
  let last = viewer.frame();
  for (let left = wanted; left > 0; ) {
    if (document.hidden) throw new Error("a hidden tab draws no frames");
    if (performance.now() - start > 60000) throw new Error(`${left} of ${wanted} frames did not come within a minute`);
    viewer.request_frame();
    // The timer is for the page that is hidden meanwhile.
    await new Promise((resolve) => { requestAnimationFrame(resolve); setTimeout(resolve, 1000); });
    const now = viewer.frame();
    // After a lost device the count begins anew.
    left -= now < last ? 0 : now - last;
    last = now;
  }
  return true;
};
"#;

/// The machine of the tests is slow, and its reader has been told so: the message would lie over what is looked at.
const KNOWN_TO_BE_SLOW: &str =
    "try { localStorage.setItem('fabrica.slow', 'told'); } catch { /* a page without storage */ }";

/// Pixels of a picture for one of CSS along a side, as on a page that is zoomed out: far less work for the software
/// GPU, with the same layout. A quarter where a test is of what the page does, not of how it looks; half where pictures
/// are compared.
const COARSE: f32 = 0.25;
const HALF: f32 = 0.5;

/// Makes pictures of so many pixels. The viewer counts them by the ratio where a browser does not tell them itself.
fn with_pixels(ratio: f32) -> String {
    format!(
        "Object.defineProperty(window, 'devicePixelRatio', {{ get: () => {ratio} }});
delete ResizeObserverEntry.prototype.devicePixelContentBoxSize;
"
    )
}

/// Root of the repository.
pub(crate) fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Runs one test, alone, in a fresh context of the browser: no cookie, storage, permission or tab of another test.
///
/// A test that hangs is run once more, in a browser of its own: one was seen to, after some fifty others in the shared
/// browser, for a reason that is not known. It is told, with what the test had asked, and `.ci/run` tells it again at
/// its end.
#[track_caller]
pub(crate) fn with_browser<F, R>(gpu: Gpu, test: F)
where
    F: FnOnce(Session) -> R + Clone,
    R: Future<Output = ()>,
{
    let mut stage = alone();
    let outcome = timed(|| {
        attempt(&mut stage, gpu, test.clone()).or_else(|hung| {
            println!("hung once: {hung}");
            attempt(&mut stage, gpu, test)
        })
    });
    if let Err(hung) = outcome {
        panic!("{hung}");
    }
}

/// Runs a test once; the error tells that it does not end.
fn attempt<F, R>(stage: &mut Stage, gpu: Gpu, test: F) -> Result<(), String>
where
    F: FnOnce(Session) -> R,
    R: Future<Output = ()>,
{
    let server = Server::start(dist());
    questions().clear();
    let run = async {
        let running = stage.browser(gpu).await;
        let session = Session::start(&running, server).await;
        let (browser, context) = (Arc::clone(&session.browser), session.context.clone());
        let outcome = AssertUnwindSafe(timeout(LIMIT, test(session)));
        let outcome = outcome.catch_unwind().await;
        let closed = timeout(CLOSING, browser.dispose_browser_context(context)).await;
        // A browser in which a test failed may be in any state: it ends here.
        if matches!((&outcome, closed), (Ok(Ok(())), Ok(Ok(_)))) {
            stage.keep(running);
        }
        outcome
    };
    match RUNTIME.block_on(run) {
        Ok(Ok(())) => Ok(()),
        Ok(Err(_elapsed)) => Err(format!(
            "a test did not end within {} s; it asked its pages last:{}",
            LIMIT.as_secs(),
            asked_last()
        )),
        Err(panic) => std::panic::resume_unwind(panic),
    }
}

/// What a test has asked its pages last, and when: a test that hangs is known by its questions.
static QUESTIONS: Mutex<VecDeque<(Instant, String)>> = Mutex::new(VecDeque::new());
/// As many of them are kept.
const LAST_QUESTIONS: usize = 12;

fn questions() -> MutexGuard<'static, VecDeque<(Instant, String)>> {
    QUESTIONS.lock().unwrap_or_else(PoisonError::into_inner)
}

fn note_question(expression: &str) {
    let mut questions = questions();
    // One that is asked again and again while a test waits counts once, with the first time.
    if questions.back().is_some_and(|(_, last)| last == expression) {
        return;
    }
    questions.push_back((Instant::now(), expression.to_owned()));
    if questions.len() > LAST_QUESTIONS {
        questions.pop_front();
    }
}

/// A line for each of them.
fn asked_last() -> String {
    let questions = questions();
    let lines = questions.iter().map(|(since, question)| {
        let start: String = question.chars().take(120).collect();
        format!("\n  {:.0} s ago: {start}", since.elapsed().as_secs_f32())
    });
    lines.collect()
}

/// The built page, which has to be newer than what it is built from.
pub(crate) fn dist() -> PathBuf {
    let dist = root().join("dist");
    let wasm = dist.join("fabrica_bg.wasm");
    let built = std::fs::metadata(&wasm).and_then(|m| m.modified());
    let built = built.unwrap_or_else(|error| {
        panic!(
            "{}: {error}. The page is not built: run `cargo xtask test`, or `trunk build`",
            wasm.display()
        )
    });
    let newest = ["src", "shaders", "web", "Cargo.toml", "Trunk.toml"]
        .iter()
        .filter_map(|name| newest_under(&root().join(name)))
        .max();
    if let Some((time, path)) = newest {
        assert!(
            time <= built,
            "the built page is older than {}: run `cargo xtask test`, or `trunk build`",
            path.display()
        );
    }
    dist
}

fn newest_under(path: &Path) -> Option<(SystemTime, PathBuf)> {
    // The developer's commands are not in the page.
    if path.ends_with("src/bin/xtask") || path.ends_with("src/bin/xtask.rs") {
        return None;
    }
    if path.is_dir() {
        let entries = std::fs::read_dir(path).ok()?;
        return entries.filter_map(|e| newest_under(&e.ok()?.path())).max();
    }
    let time = std::fs::metadata(path).ok()?.modified().ok()?;
    Some((time, path.to_path_buf()))
}

/// What one test has: a context of the browser, and a server.
pub(crate) struct Session {
    /// The browser of all tests.
    pub(crate) browser: Arc<Browser>,
    /// The context of this test alone.
    pub(crate) context: BrowserContextId,
    /// Serves the page.
    pub(crate) server: Server,
}

impl Session {
    async fn start(running: &Running, server: Server) -> Self {
        Self::within(Arc::clone(&running.browser), server).await
    }

    /// The same page in a context of its own, as on another machine: end it before the test ends.
    pub(crate) async fn elsewhere(&self) -> Self {
        Self::within(Arc::clone(&self.browser), self.server.clone()).await
    }

    /// Closes a context that [`Session::elsewhere`] made.
    pub(crate) async fn end(self) {
        let closing = self.browser.dispose_browser_context(self.context);
        let closed = timeout(CLOSING, closing).await;
        closed.expect("it closes in time").expect("it closes");
    }

    async fn within(browser: Arc<Browser>, server: Server) -> Self {
        let context = browser
            .create_browser_context(CreateBrowserContextParams::default())
            .await
            .expect("a context of its own");
        Self {
            browser,
            context,
            server,
        }
    }

    /// Opens a tab at `path` of the server (`""`, `"#payload"`, `"?s=…"`), without waiting for more than its loading.
    pub(crate) async fn open(&self, path: &str) -> Tab {
        let tab = self.tab().await;
        tab.go(&format!("{}/{path}", self.server.address())).await;
        tab
    }

    /// The same in a tab that has its size before the page loads: nothing is drawn in the size of the window first.
    pub(crate) async fn open_sized(&self, path: &str, size: (u32, u32)) -> Tab {
        let address = format!("{}/{path}", self.server.address());
        self.open_with("", &address, size).await
    }

    /// As [`Session::open_sized`], with coarse pictures: for tests of what the page does, not of how it looks.
    pub(crate) async fn open_coarse(&self, path: &str, size: (u32, u32)) -> Tab {
        let address = format!("{}/{path}", self.server.address());
        self.open_coarse_at(&address, size).await
    }

    /// The same at an address.
    pub(crate) async fn open_coarse_at(&self, address: &str, size: (u32, u32)) -> Tab {
        self.open_with(&with_pixels(COARSE), address, size).await
    }

    /// As [`Session::open_sized`], with pictures of half the size along a side, which are compared.
    pub(crate) async fn open_half(&self, path: &str, size: (u32, u32)) -> Tab {
        let address = format!("{}/{path}", self.server.address());
        self.open_with(&with_pixels(HALF), &address, size).await
    }

    async fn open_with(&self, before: &str, address: &str, size: (u32, u32)) -> Tab {
        let tab = self.tab().await;
        tab.resize(size.0, size.1).await;
        tab.run_before(before).await;
        tab.go(address).await;
        tab
    }

    async fn tab(&self) -> Tab {
        let mut target = CreateTargetParams::new("about:blank");
        target.browser_context_id = Some(self.context.clone());
        let page = self.browser.new_page(target).await.expect("a tab opens");
        let tab = Tab { page };
        tab.run_before(PREPARED).await;
        tab
    }

    /// Opens a tab of this size at `path` of the server and waits until the viewer has started.
    pub(crate) async fn viewer_sized(&self, path: &str, size: (u32, u32)) -> Tab {
        self.viewer_at(&format!("{}/{path}", self.server.address()), size)
            .await
    }

    /// As [`Session::viewer_sized`], with all samples of a finished picture: for tests of what is done meanwhile.
    pub(crate) async fn refining_viewer(&self, path: &str, size: (u32, u32)) -> Tab {
        let address = format!("{}/{path}", self.server.address());
        let before = "delete window.fabricaSamples;";
        self.viewer_with(before, &address, size).await
    }

    /// Opens a tab of this size at an address and waits until the viewer has started.
    pub(crate) async fn viewer_at(&self, address: &str, size: (u32, u32)) -> Tab {
        self.viewer_with("", address, size).await
    }

    /// As [`Session::viewer_sized`], with a coarse canvas: for tests of what the page does, not of how it looks.
    pub(crate) async fn coarse_viewer(&self, path: &str, size: (u32, u32)) -> Tab {
        let address = format!("{}/{path}", self.server.address());
        self.coarse_viewer_at(&address, size).await
    }

    /// As [`Session::viewer_at`], with a coarse canvas.
    pub(crate) async fn coarse_viewer_at(&self, address: &str, size: (u32, u32)) -> Tab {
        self.viewer_with_pixels(COARSE, address, size).await
    }

    /// As [`Session::viewer_sized`], with a canvas of half the size along a side: for pictures that are compared.
    pub(crate) async fn half_viewer(&self, path: &str, size: (u32, u32)) -> Tab {
        let address = format!("{}/{path}", self.server.address());
        self.half_viewer_at(&address, size).await
    }

    /// The same at an address.
    pub(crate) async fn half_viewer_at(&self, address: &str, size: (u32, u32)) -> Tab {
        self.viewer_with_pixels(HALF, address, size).await
    }

    async fn viewer_with_pixels(&self, ratio: f32, address: &str, size: (u32, u32)) -> Tab {
        let tab = self.viewer_with(&with_pixels(ratio), address, size).await;
        let is_so = format!(
            "Math.abs(document.getElementById('fabrica').width - {ratio} * innerWidth) <= 1"
        );
        tab.wait_until(&is_so, 30).await;
        tab
    }

    async fn viewer_with(&self, before: &str, address: &str, size: (u32, u32)) -> Tab {
        let before = format!("{KNOWN_TO_BE_SLOW}{before}");
        let tab = self.open_with(&before, address, size).await;
        tab.wait_for_state("started").await;
        tab
    }

    /// Lets pages of the server read and write the clipboard, as a reader would be asked to.
    pub(crate) async fn allow_clipboard(&self) {
        for name in ["clipboard-read", "clipboard-write"] {
            let what = PermissionDescriptor::new(name);
            let mut params = SetPermissionParams::new(what, PermissionSetting::Granted);
            params.origin = Some(self.server.address());
            params.browser_context_id = Some(self.context.clone());
            self.browser.execute(params).await.expect("the permission");
        }
    }
}

/// What a page wrote to its console so far.
const MESSAGES: &str = "(window.messages ?? []).join('\\n')";

/// A tab of the browser, with the hands and eyes of a test.
pub(crate) struct Tab {
    /// Its connection with the browser.
    pub(crate) page: Page,
}

impl Tab {
    /// Runs a script in every page of the tab from now on, before the page's own.
    async fn run_before(&self, script: &str) {
        let added = self.page.evaluate_on_new_document(script).await;
        added.expect("a script for the next page");
    }

    /// Leads the tab to an address. The connection gives up on a page that has not loaded after half a minute, as where
    /// it works in its main thread on a busy machine; such a page is waited for here.
    pub(crate) async fn go(&self, address: &str) {
        match self.page.goto(address).await {
            Ok(_) => {}
            Err(CdpError::Timeout) => {
                println!("{address}: loads for more than half a minute");
                let place = address.split('#').next().unwrap_or_default();
                let has_loaded = format!(
                    "document.readyState === 'complete' && location.href.startsWith('{place}')"
                );
                self.wait_until(&has_loaded, 200).await;
            }
            Err(error) => panic!("{address}: {error}"),
        }
    }

    /// Value of a JavaScript expression; a promise is awaited.
    pub(crate) async fn eval<T: serde::de::DeserializeOwned>(&self, expression: &str) -> T {
        note_question(expression);
        let found = match self.page.evaluate_expression(expression).await {
            Ok(found) => found,
            // A program that has ended answers nothing any more; the reason is among its messages.
            Err(error) => {
                let said = self.page.evaluate_expression(MESSAGES).await;
                let said: Option<String> = said.ok().and_then(|said| said.into_value().ok());
                panic!("{expression}: {error}\n{}", said.unwrap_or_default())
            }
        };
        found
            .into_value()
            .unwrap_or_else(|error| panic!("{expression}: {error}"))
    }

    /// Waits until the page says it is in this state; fails after two minutes, or at once in another final state.
    pub(crate) async fn wait_for_state(&self, wanted: &str) {
        let start = Instant::now();
        loop {
            let state: String = self
                .eval("document.documentElement.dataset.state ?? ''")
                .await;
            if state == wanted {
                return;
            }
            let late = start.elapsed() > Duration::from_secs(120);
            if late || ["failed", "no-webgpu", "panicked"].contains(&state.as_str()) {
                panic!(
                    "the page is in state {state:?} instead of {wanted:?}. It says: {}\n{}",
                    self.text().await,
                    self.messages().await
                );
            }
            tokio::time::sleep(ROUND).await;
        }
    }

    /// Waits for an expression to be true.
    pub(crate) async fn wait_until(&self, expression: &str, seconds: u64) {
        let start = Instant::now();
        while !self.eval::<bool>(expression).await {
            if start.elapsed() > Duration::from_secs(seconds) {
                self.screenshot("waited_in_vain").await;
                panic!(
                    "not true after {seconds} s: {expression}\n{}",
                    self.messages().await
                );
            }
            tokio::time::sleep(ROUND).await;
        }
    }

    /// Waits until the page's viewer has drawn so many more frames. The first of them takes in what was done before,
    /// the second shows it, and when there is a third the second is on the screen.
    pub(crate) async fn frames(&self, number: u32) {
        self.frames_of(VIEWER, number).await;
    }

    /// The same of a viewer in somebody else's page.
    pub(crate) async fn frames_of(&self, viewer: &str, number: u32) {
        let script = format!("window.framesLater({viewer}, {number})");
        assert!(self.eval::<bool>(&script).await);
    }

    /// Waits until all that was done before is on the screen: taken in, loaded, and drawn to the last sample.
    pub(crate) async fn settled(&self) {
        self.settled_of(VIEWER).await;
    }

    /// Waits for so many frames of the browser, in a page without the viewer.
    pub(crate) async fn frames_quietly(&self, number: u32) {
        let code = format!(
            "new Promise((done) => {{ let left = {number}; const frame = () => (left-- > 0 ? requestAnimationFrame(frame) : done(true)); frame(); }})"
        );
        self.eval::<bool>(&code).await;
    }

    /// The same of a viewer in somebody else's page.
    pub(crate) async fn settled_of(&self, viewer: &str) {
        let is_at_rest = format!("{viewer}.is_at_rest()");
        for _ in 0..100 {
            self.frames_of(viewer, 3).await;
            self.wait_until(&is_at_rest, 240).await;
            // The last frames may have found something more to do.
            self.frames_of(viewer, 3).await;
            if self.eval(&is_at_rest).await {
                return;
            }
        }
        panic!("the page never comes to rest");
    }

    /// Visible text of the page.
    pub(crate) async fn text(&self) -> String {
        self.eval("document.body.innerText").await
    }

    /// What the page wrote to its console so far.
    pub(crate) async fn messages(&self) -> String {
        self.eval(MESSAGES).await
    }

    /// Fails if the page reported an error, broke its content policy or asked for something it should not.
    pub(crate) async fn assert_no_complaints(&self) {
        let messages = self.messages().await;
        let bad = messages.lines().find(|line| {
            ["error:", "uncaught:", "unhandled:", "policy:"]
                .iter()
                .any(|start| line.starts_with(start))
        });
        assert!(bad.is_none(), "the page complains:\n{messages}");
    }

    /// The canvas as it is shown, in pixels. Fails if it is all one colour: a blank canvas is no picture.
    pub(crate) async fn picture(&self, name: &str) -> image::RgbaImage {
        let picture = self.screenshot(name).await;
        assert_not_blank(&picture, name);
        picture
    }

    /// The page once enough of it is drawn, though the picture may not be complete: `is_enough` says so. For tests
    /// that do not compare pictures: the last samples take a software GPU the longest.
    pub(crate) async fn drawn(
        &self,
        name: &str,
        is_enough: impl Fn(&image::RgbaImage) -> bool,
    ) -> image::RgbaImage {
        let start = Instant::now();
        loop {
            let picture = self.screenshot(name).await;
            if is_enough(&picture) {
                return picture;
            }
            let late = start.elapsed() > Duration::from_secs(120);
            assert!(!late, "{name} is not drawn:\n{}", self.messages().await);
            tokio::time::sleep(ROUND).await;
        }
    }

    /// The page as it is, blank or not; left in target/e2e.
    async fn screenshot(&self, name: &str) -> image::RgbaImage {
        let params = ScreenshotParams::builder()
            .format(CaptureScreenshotFormat::Png)
            .build();
        let png = self.page.screenshot(params).await.expect("a screenshot");
        let folder = root().join("target/e2e");
        std::fs::create_dir_all(&folder).expect("a folder for pictures");
        std::fs::write(folder.join(format!("{name}.png")), &png).expect("the picture is written");
        image::load_from_memory(&png).expect("a PNG").to_rgba8()
    }

    /// Sets the size of the page in CSS pixels.
    pub(crate) async fn resize(&self, width: u32, height: u32) {
        let params = SetDeviceMetricsOverrideParams::new(width, height, 1.0, false);
        self.page.execute(params).await.expect("a new size");
    }

    /// Moves the pointer with or without a button held.
    pub(crate) async fn mouse(&self, kind: DispatchMouseEventType, x: f64, y: f64, held: bool) {
        let mut params = DispatchMouseEventParams::new(kind, x, y);
        if held {
            params.button = Some(MouseButton::Left);
            params.buttons = Some(1);
            params.click_count = Some(1);
        }
        self.page.execute(params).await.expect("a mouse event");
    }

    /// Presses and lets go of a key by its DOM name.
    pub(crate) async fn key(&self, key: &str) {
        for kind in [DispatchKeyEventType::KeyDown, DispatchKeyEventType::KeyUp] {
            let mut params = DispatchKeyEventParams::new(kind);
            params.key = Some(key.to_owned());
            params.code = Some(key.to_owned());
            self.page.execute(params).await.expect("a key event");
        }
    }

    /// Presses and releases the left button at a place in CSS pixels.
    pub(crate) async fn click(&self, x: f64, y: f64) {
        self.mouse(DispatchMouseEventType::MouseMoved, x, y, false)
            .await;
        self.frames(2).await;
        // As a hand does: the release does not wait until the page has dealt with the press.
        tokio::join!(
            self.mouse(DispatchMouseEventType::MousePressed, x, y, true),
            self.mouse(DispatchMouseEventType::MouseReleased, x, y, true)
        );
        self.frames(2).await;
    }

    /// Drags from one point to the other in `n` moves, each of them in a frame of its own.
    pub(crate) async fn drag(&self, from: (f64, f64), to: (f64, f64), n: u32) {
        self.mouse(DispatchMouseEventType::MouseMoved, from.0, from.1, false)
            .await;
        self.frames(2).await;
        self.mouse(DispatchMouseEventType::MousePressed, from.0, from.1, true)
            .await;
        for i in 1..=n {
            let t = f64::from(i) / f64::from(n);
            let (x, y) = (from.0 + (to.0 - from.0) * t, from.1 + (to.1 - from.1) * t);
            self.frames(1).await;
            self.mouse(DispatchMouseEventType::MouseMoved, x, y, true)
                .await;
        }
        self.frames(1).await;
        self.mouse(DispatchMouseEventType::MouseReleased, to.0, to.1, true)
            .await;
        self.frames(2).await;
    }
}

/// Fails on a picture of one colour.
pub(crate) fn assert_not_blank(picture: &image::RgbaImage, name: &str) {
    let first = picture.get_pixel(0, 0);
    let other = picture.pixels().filter(|p| *p != first).count();
    assert!(
        other * 200 > picture.pixels().len(),
        "{name}: the picture is blank ({other} of {} pixels differ from the first)",
        picture.pixels().len()
    );
}

/// Bytes from the base64 text that a page hands over.
pub(crate) fn from_base64(text: &str) -> Vec<u8> {
    base64::engine::general_purpose::STANDARD
        .decode(text)
        .expect("base64")
}
