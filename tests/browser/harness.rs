//! What the browser tests stand on: a display of their own, a server for the built page, a browser with a software
//! WebGPU, and pictures of the canvas. Nothing is skipped: a missing part fails with what to do about it.

use base64::Engine as _;
use chromiumoxide::Page;
use chromiumoxide::browser::{Browser, BrowserConfig};
use chromiumoxide::cdp::browser_protocol::browser::{
    PermissionDescriptor, PermissionSetting, SetPermissionParams,
};
use chromiumoxide::cdp::browser_protocol::emulation::SetDeviceMetricsOverrideParams;
use chromiumoxide::cdp::browser_protocol::input::{
    DispatchKeyEventParams, DispatchKeyEventType, DispatchMouseEventParams, DispatchMouseEventType,
    MouseButton,
};
use chromiumoxide::cdp::browser_protocol::page::CaptureScreenshotFormat;
use chromiumoxide::page::ScreenshotParams;
use futures::{FutureExt as _, StreamExt as _};
use std::collections::BTreeMap;
use std::future::Future;
use std::io::{BufRead as _, BufReader, Read as _, Write as _};
use std::net::{TcpListener, TcpStream};
use std::panic::AssertUnwindSafe;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant, SystemTime};

/// How the tests' browser is to be started.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Gpu {
    /// WebGPU on SwiftShader, the software rasteriser that comes with the browser.
    Software,
    /// As on a machine without any: the browser offers no adapter.
    None,
}

/// No browser test may take longer; a hanging browser must not hold up everything after it.
const LIMIT: Duration = Duration::from_secs(900);

/// One browser test at a time: they share two cores and a software GPU.
static ONE_AT_A_TIME: Mutex<()> = Mutex::new(());

/// Root of the repository.
pub(crate) fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Runs one test against a fresh browser, alone.
pub(crate) fn with_browser<F, R>(gpu: Gpu, test: F)
where
    F: FnOnce(Session) -> R,
    R: Future<Output = ()>,
{
    let _alone = alone();
    let dist = dist();
    let runtime = tokio::runtime::Builder::new_multi_thread()
        .worker_threads(1)
        .enable_all()
        .build()
        .expect("a tokio runtime");
    let display = Display::start();
    let server = Server::start(dist);
    // Whatever the test does, the browser and its display end: a panic is caught, and closing has its own limits.
    let outcome = runtime.block_on(async {
        let session = Session::start(gpu, &display, server).await;
        let browser = Arc::clone(&session.browser);
        let running = AssertUnwindSafe(tokio::time::timeout(LIMIT, test(session))).catch_unwind();
        let outcome = running.await;
        let closing = async {
            let mut browser = browser.lock().await;
            let _closed = tokio::time::timeout(Duration::from_secs(3), browser.close()).await;
            let _gone = tokio::time::timeout(Duration::from_secs(3), browser.wait()).await;
            if let Some(child) = browser.get_mut_child() {
                let _killed = child.inner.start_kill();
            }
        };
        let _closed = tokio::time::timeout(Duration::from_secs(10), closing).await;
        outcome
    });
    runtime.shutdown_timeout(Duration::from_secs(1));
    drop(display);
    match outcome {
        Ok(Ok(())) => {}
        Ok(Err(_elapsed)) => panic!("the test did not end within {} s", LIMIT.as_secs()),
        Err(panic) => std::panic::resume_unwind(panic),
    }
}

fn alone() -> MutexGuard<'static, ()> {
    ONE_AT_A_TIME.lock().unwrap_or_else(PoisonError::into_inner)
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

/// A display that no one sees. Ends when dropped.
pub(crate) struct Display {
    child: Child,
    name: String,
}

impl Display {
    fn start() -> Self {
        let mut child = Command::new("Xvfb")
            .args(["-displayfd", "1", "-screen", "0", "1400x1000x24", "-nolisten", "tcp"])
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap_or_else(|error| {
                panic!("Xvfb: {error}. The browser tests need it (Debian: apt-get install xvfb); `cargo xtask test` sets it up")
            });
        let mut line = String::new();
        if let Some(out) = child.stdout.as_mut() {
            BufReader::new(out)
                .read_line(&mut line)
                .expect("Xvfb says which display it took");
        }
        let name = format!(":{}", line.trim());
        assert!(name.len() > 1, "Xvfb ended without a display");
        Self { child, name }
    }
}

impl Drop for Display {
    fn drop(&mut self) {
        let _killed = self.child.kill();
        let _reaped = self.child.wait();
    }
}

/// A server on localhost for the built page and for files that a test adds.
#[derive(Clone)]
pub(crate) struct Server {
    port: u16,
    shared: Arc<Shared>,
}

struct Shared {
    folder: PathBuf,
    added: Mutex<BTreeMap<String, Vec<u8>>>,
    asked: Mutex<Vec<String>>,
}

impl Server {
    /// Serves `folder` at a port of its own until the process ends.
    pub(crate) fn start(folder: PathBuf) -> Self {
        let listener = TcpListener::bind(("127.0.0.1", 0)).expect("a port on localhost");
        let port = listener
            .local_addr()
            .expect("the address just bound")
            .port();
        let shared = Arc::new(Shared {
            folder,
            added: Mutex::default(),
            asked: Mutex::default(),
        });
        let for_thread = Arc::clone(&shared);
        std::thread::spawn(move || {
            for stream in listener.incoming().flatten() {
                let shared = Arc::clone(&for_thread);
                std::thread::spawn(move || shared.answer(stream));
            }
        });
        Self { port, shared }
    }

    /// Where it is, without a slash at the end.
    pub(crate) fn address(&self) -> String {
        format!("http://127.0.0.1:{}", self.port)
    }

    /// Serves these bytes at `/name` from now on.
    pub(crate) fn add(&self, name: &str, bytes: Vec<u8>) {
        let mut added = self.shared.added.lock().expect("no answer panicked");
        added.insert(name.to_owned(), bytes);
    }

    /// Paths that were asked for, in order.
    pub(crate) fn asked(&self) -> Vec<String> {
        self.shared
            .asked
            .lock()
            .expect("no answer panicked")
            .clone()
    }
}

impl Shared {
    fn answer(&self, mut stream: TcpStream) {
        let _timeout = stream.set_read_timeout(Some(Duration::from_secs(10)));
        let mut reader = BufReader::new(match stream.try_clone() {
            Ok(stream) => stream,
            Err(_) => return,
        });
        let mut first = String::new();
        if reader.read_line(&mut first).is_err() {
            return;
        }
        let mut line = String::new();
        while reader.read_line(&mut line).is_ok_and(|n| n > 2) {
            line.clear();
        }
        let target = first.split(' ').nth(1).unwrap_or("/").to_owned();
        let path = target.split(['?', '#']).next().unwrap_or("/");
        let name = path.trim_start_matches('/');
        let name = if name.is_empty() { "index.html" } else { name };
        if let Ok(mut asked) = self.asked.lock() {
            asked.push(target.clone());
        }
        let added = self.added.lock().ok().and_then(|a| a.get(name).cloned());
        let body = added.or_else(|| {
            (!name.contains("..")).then(|| std::fs::read(self.folder.join(name)).ok())?
        });
        let kind = match name.rsplit('.').next() {
            Some("html") => "text/html; charset=utf-8",
            Some("js") => "text/javascript",
            Some("css") => "text/css",
            Some("wasm") => "application/wasm",
            Some("svg") => "image/svg+xml",
            Some("json") => "application/json",
            Some("png") => "image/png",
            _ => "application/octet-stream",
        };
        let (status, body) = match body {
            Some(body) => ("200 OK", body),
            None => ("404 Not Found", b"no such file".to_vec()),
        };
        let head = format!(
            "HTTP/1.1 {status}\r\nContent-Type: {kind}\r\nContent-Length: {}\r\nCache-Control: no-store\r\nAccess-Control-Allow-Origin: *\r\nConnection: close\r\n\r\n",
            body.len()
        );
        let _sent = stream
            .write_all(head.as_bytes())
            .and_then(|()| stream.write_all(&body));
        let _shut = stream.shutdown(std::net::Shutdown::Write);
        let _drained = stream.read(&mut [0; 1]);
    }
}

/// A browser with its display and server.
pub(crate) struct Session {
    /// The browser.
    pub(crate) browser: Arc<tokio::sync::Mutex<Browser>>,
    /// Serves the page.
    pub(crate) server: Server,
    _profile: tempfile::TempDir,
}

impl Session {
    async fn start(gpu: Gpu, display: &Display, server: Server) -> Self {
        let profile = tempfile::tempdir().expect("a folder for the browser's profile");
        let mut config = BrowserConfig::builder()
            .with_head()
            .no_sandbox()
            .window_size(1300, 900)
            .viewport(None)
            .user_data_dir(profile.path())
            .request_timeout(Duration::from_secs(300))
            .launch_timeout(Duration::from_secs(60))
            .env("DISPLAY", &display.name)
            .env(
                "XDG_RUNTIME_DIR",
                std::env::temp_dir().display().to_string(),
            )
            .args([
                "disable-quic",
                "no-first-run",
                "disable-background-networking",
                "disable-component-update",
                "disable-sync",
                "ignore-gpu-blocklist",
            ]);
        if let Some(path) = chromium() {
            config = config.chrome_executable(path);
        }
        config = match gpu {
            Gpu::Software => config
                .arg("enable-unsafe-webgpu")
                .arg(("use-webgpu-adapter", "swiftshader"))
                .arg(("enable-features", "Vulkan"))
                .arg(("use-vulkan", "swiftshader")),
            Gpu::None => config
                .arg("disable-gpu")
                .arg(("disable-features", "WebGPU")),
        };
        let config = config.build().unwrap_or_else(|error| {
            panic!("no browser: {error}. The tests need Chromium (Debian: apt-get install chromium); `cargo xtask test` sets it up")
        });
        let (browser, mut handler) = Browser::launch(config).await.expect("the browser starts");
        tokio::spawn(async move { while handler.next().await.is_some() {} });
        Self {
            browser: Arc::new(tokio::sync::Mutex::new(browser)),
            server,
            _profile: profile,
        }
    }

    /// Opens a tab at `path` of the server (`""`, `"#payload"`, `"?s=…"`), without waiting for more than its loading.
    pub(crate) async fn open(&self, path: &str) -> Tab {
        let tab = self.tab().await;
        let address = format!("{}/{path}", self.server.address());
        tab.page
            .goto(address.as_str())
            .await
            .expect("the page loads");
        tab
    }

    async fn tab(&self) -> Tab {
        let browser = self.browser.lock().await;
        let page = browser.new_page("about:blank").await.expect("a tab opens");
        page.evaluate_on_new_document(
            "window.messages=[];for(const k of ['log','info','warn','error']){const f=console[k];console[k]=(...a)=>{window.messages.push(k+': '+a.join(' '));f(...a)}};addEventListener('error',e=>window.messages.push('uncaught: '+e.message));addEventListener('unhandledrejection',e=>window.messages.push('unhandled: '+e.reason));addEventListener('securitypolicyviolation',e=>window.messages.push('policy: '+e.violatedDirective+' '+e.blockedURI));if(window.GPUAdapter){const r=GPUAdapter.prototype.requestDevice;window.devices=[];GPUAdapter.prototype.requestDevice=async function(...a){const d=await r.apply(this,a);window.devices.push(d);return d}}",
        )
        .await
        .expect("a script for the next page");
        Tab { page }
    }

    /// Opens a tab of this size at `path` of the server and waits until the viewer has started.
    pub(crate) async fn viewer_sized(&self, path: &str, size: (u32, u32)) -> Tab {
        self.viewer_at(&format!("{}/{path}", self.server.address()), size)
            .await
    }

    /// Opens a tab of this size at an address and waits until the viewer has started.
    pub(crate) async fn viewer_at(&self, address: &str, size: (u32, u32)) -> Tab {
        let tab = self.tab().await;
        tab.resize(size.0, size.1).await;
        tab.page.goto(address).await.expect("the page loads");
        tab.wait_for_state("started").await;
        tab
    }

    /// A second server: another origin.
    pub(crate) fn other_server(&self) -> Server {
        Server::start(self.server.shared.folder.clone())
    }

    /// Lets pages of the server read and write the clipboard, as a reader would be asked to.
    pub(crate) async fn allow_clipboard(&self) {
        let browser = self.browser.lock().await;
        for name in ["clipboard-read", "clipboard-write"] {
            let what = PermissionDescriptor::new(name);
            let mut params = SetPermissionParams::new(what, PermissionSetting::Granted);
            params.origin = Some(self.server.address());
            browser.execute(params).await.expect("the permission");
        }
    }
}

fn chromium() -> Option<PathBuf> {
    if let Some(path) = std::env::var_os("CHROME") {
        return Some(path.into());
    }
    let path = std::env::var_os("PATH")?;
    let names = [
        "chromium",
        "chromium-browser",
        "google-chrome-stable",
        "google-chrome",
    ];
    std::env::split_paths(&path)
        .flat_map(|folder| names.map(|name| folder.join(name)))
        .find(|file| file.is_file())
}

/// One tab.
pub(crate) struct Tab {
    /// The tab itself.
    pub(crate) page: Page,
}

impl Tab {
    /// Value of a JavaScript expression; a promise is awaited.
    pub(crate) async fn eval<T: serde::de::DeserializeOwned>(&self, expression: &str) -> T {
        let found = self.page.evaluate_expression(expression).await;
        let found = found.unwrap_or_else(|error| panic!("{expression}: {error}"));
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
            tokio::time::sleep(Duration::from_millis(100)).await;
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
            tokio::time::sleep(Duration::from_millis(100)).await;
        }
    }

    /// Visible text of the page.
    pub(crate) async fn text(&self) -> String {
        self.eval("document.body.innerText").await
    }

    /// What the page wrote to its console so far.
    pub(crate) async fn messages(&self) -> String {
        self.eval("(window.messages ?? []).join('\\n')").await
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

    /// Clicks.
    pub(crate) async fn click(&self, x: f64, y: f64) {
        self.drag((x, y), (x, y), 1).await;
    }

    /// Drags from one point to the other in `n` moves.
    pub(crate) async fn drag(&self, from: (f64, f64), to: (f64, f64), n: u32) {
        self.mouse(DispatchMouseEventType::MouseMoved, from.0, from.1, false)
            .await;
        tokio::time::sleep(Duration::from_millis(150)).await;
        self.mouse(DispatchMouseEventType::MousePressed, from.0, from.1, true)
            .await;
        for i in 1..=n {
            let t = f64::from(i) / f64::from(n);
            let (x, y) = (from.0 + (to.0 - from.0) * t, from.1 + (to.1 - from.1) * t);
            tokio::time::sleep(Duration::from_millis(60)).await;
            self.mouse(DispatchMouseEventType::MouseMoved, x, y, true)
                .await;
        }
        tokio::time::sleep(Duration::from_millis(60)).await;
        self.mouse(DispatchMouseEventType::MouseReleased, to.0, to.1, true)
            .await;
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
