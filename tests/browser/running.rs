//! What runs for all browser tests together: a display, one browser for the tests with a GPU, and the list of seconds.
//! All of it ends with the process of the tests, in whatever way that ends.

use chromiumoxide::browser::{Browser, BrowserConfig};
use futures::StreamExt as _;
use std::io::{BufRead as _, BufReader, Write as _};
use std::panic::Location;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::{Arc, LazyLock, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};
use tokio::time::timeout;

/// How the tests' browser is to be started.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Gpu {
    /// WebGPU on SwiftShader, the software rasteriser that comes with the browser.
    Software,
    /// As on a machine without any: the browser offers no adapter.
    None,
}

/// A browser that does not answer the simplest question within this time is ended.
const PATIENCE: Duration = Duration::from_secs(10);

/// The runtime of all tests: the connection to the browser outlives each of them.
pub(crate) static RUNTIME: LazyLock<tokio::runtime::Runtime> = LazyLock::new(|| {
    tokio::runtime::Builder::new_multi_thread()
        .worker_threads(1)
        .enable_all()
        .build()
        .expect("a tokio runtime")
});

/// What one test leaves to the next.
#[derive(Default)]
pub(crate) struct Stage {
    display: Option<Display>,
    /// The browser with a software GPU.
    software: Option<Running>,
}

/// One browser test at a time: they share two cores and a software GPU.
static STAGE: Mutex<Stage> = Mutex::new(Stage {
    display: None,
    software: None,
});

/// Waits until no other browser test runs.
pub(crate) fn alone() -> MutexGuard<'static, Stage> {
    STAGE.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Stage {
    /// A browser that answers: the shared one, or a new one where there is none, it does not answer or other flags are
    /// wanted.
    pub(crate) async fn browser(&mut self, gpu: Gpu) -> Running {
        if gpu == Gpu::Software
            && let Some(running) = self.software.take()
        {
            let answer = timeout(PATIENCE, running.browser.version()).await;
            if matches!(answer, Ok(Ok(_))) {
                return running;
            }
            println!("the browser does not answer: a new one is started");
        }
        let display = self.display.get_or_insert_with(Display::start);
        Running::start(gpu, display).await
    }

    /// Keeps a browser for the next test, if that can use it.
    pub(crate) fn keep(&mut self, running: Running) {
        if running.gpu == Gpu::Software {
            self.software = Some(running);
        }
    }
}

// ---------------------------------------------------------------------------------------------------- processes

/// Ends another process when dropped, or when the process of the tests ends in whatever way. A shell waits for the end
/// of its input, which comes when nobody holds the other side any more.
struct Leash(Child);

impl Leash {
    /// Of the process of this number; the folder is removed after its end.
    fn new(pid: u32, folder: Option<&Path>) -> Self {
        // Asked to end, and killed if it has not within two seconds. What is only a number any more (Z) has ended.
        const SCRIPT: &str = r#"
            trap '' INT TERM HUP
            read -r _
            kill "$1"
            for _ in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20; do
                case $(cut -d ' ' -f 3 "/proc/$1/stat") in '' | Z) break ;; esac
                sleep 0.1
            done
            kill -9 "$1"
            [ -z "$2" ] || rm -rf "$2"
        "#;
        let shell = Command::new("sh")
            .args(["-c", SCRIPT, "leash", &pid.to_string()])
            .arg(folder.unwrap_or(Path::new("")))
            .stdin(Stdio::piped())
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .expect("a shell");
        Self(shell)
    }
}

impl Drop for Leash {
    fn drop(&mut self) {
        drop(self.0.stdin.take());
        let _ended = self.0.wait();
    }
}

/// A display that no one sees.
struct Display {
    name: String,
    _child: Child,
    _leash: Leash,
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
        let leash = Leash::new(child.id(), None);
        let mut line = String::new();
        if let Some(out) = child.stdout.as_mut() {
            BufReader::new(out)
                .read_line(&mut line)
                .expect("Xvfb says which display it took");
        }
        let name = format!(":{}", line.trim());
        assert!(name.len() > 1, "Xvfb ended without a display");
        Self {
            name,
            _child: child,
            _leash: leash,
        }
    }
}

/// A browser that runs. Ends when dropped.
pub(crate) struct Running {
    gpu: Gpu,
    /// What it is told with.
    pub(crate) browser: Arc<Browser>,
    _leash: Leash,
}

impl Running {
    async fn start(gpu: Gpu, display: &Display) -> Self {
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
        let (mut browser, mut handler) = Browser::launch(config).await.expect("the browser starts");
        let child = browser.get_mut_child();
        let pid = child.and_then(|child| child.as_mut_inner().id());
        // From here on the leash removes the folder, also where no destructor runs.
        let leash = Leash::new(pid.expect("it has just started"), Some(&profile.keep()));
        tokio::spawn(async move { while handler.next().await.is_some() {} });
        // The first window shows the browser's start page, which would be drawn beside each test.
        for page in browser.pages().await.unwrap_or_default() {
            let _emptied = timeout(PATIENCE, page.goto("about:blank")).await;
        }
        Self {
            gpu,
            browser: Arc::new(browser),
            _leash: leash,
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

// ---------------------------------------------------------------------------------------------------- seconds

/// Takes a line for each test and writes them, the longest first, when the process of the tests has ended: a test
/// program in Rust has no last moment of its own.
static SECONDS: LazyLock<Mutex<Option<Child>>> = LazyLock::new(|| {
    let script =
        r#"trap '' INT TERM HUP; lines=$(sort -rn) && printf '\nseconds per test:\n%s\n' "$lines""#;
    let mut shell = Command::new("sh");
    shell.args(["-c", script]).stdin(Stdio::piped());
    Mutex::new(shell.spawn().ok())
});

/// Runs a test and notes how long it takes, whatever comes of it.
#[track_caller]
pub(crate) fn timed<R>(test: impl FnOnce() -> R) -> R {
    struct Clock(Instant, String);
    impl Drop for Clock {
        fn drop(&mut self) {
            let line = format!("{:7.1} {}\n", self.0.elapsed().as_secs_f32(), self.1);
            let mut list = SECONDS.lock().unwrap_or_else(PoisonError::into_inner);
            if let Some(input) = list.as_mut().and_then(|shell| shell.stdin.as_mut()) {
                let _written = input.write_all(line.as_bytes());
            }
        }
    }
    // Tests have a thread of their name, unless they run one by one.
    let thread = std::thread::current();
    let name = thread.name().filter(|name| *name != "main");
    let name = name.map_or_else(|| Location::caller().to_string(), str::to_owned);
    let _clock = Clock(Instant::now(), name);
    test()
}
