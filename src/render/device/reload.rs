//! Shaders taken from their files while somebody changes them: native debug builds only.
//!
//! Every other build, and a debug build away from its sources, draws with the embedded text.

use std::borrow::Cow;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, SystemTime};

/// How often the files are looked at: soon enough for a hand on a keyboard.
const PERIOD: Duration = Duration::from_millis(400);

/// Set once somebody watches; from then on programs are put together from the files.
static IS_WATCHING: AtomicBool = AtomicBool::new(false);

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("shaders")
}

/// The text of a shader file: from the disk while it is watched, else as embedded. `path` is under `shaders/`.
pub(crate) fn text_of(path: &str, embedded: &'static str) -> Cow<'static, str> {
    if !IS_WATCHING.load(Ordering::Relaxed) {
        return Cow::Borrowed(embedded);
    }
    match std::fs::read_to_string(folder().join(path)) {
        Ok(text) => Cow::Owned(text),
        Err(_away) => Cow::Borrowed(embedded),
    }
}

/// Looks at the shader files in a thread of its own until `on_change` says false; calls it after each change of one
/// of them. Does nothing where the sources are not at hand.
pub fn watch_shaders(mut on_change: impl FnMut() -> bool + Send + 'static) {
    if !folder().is_dir() {
        return;
    }
    IS_WATCHING.store(true, Ordering::Relaxed);
    std::thread::spawn(move || {
        let mut seen = newest_in(&folder());
        loop {
            std::thread::sleep(PERIOD);
            let now = newest_in(&folder());
            if now != seen {
                seen = now;
                if !on_change() {
                    return;
                }
            }
        }
    });
}

/// When any file under the folder was last changed.
fn newest_in(folder: &Path) -> Option<SystemTime> {
    let entries = std::fs::read_dir(folder).ok()?.flatten();
    let times = entries.filter_map(|entry| {
        let about = entry.metadata().ok()?;
        if about.is_dir() {
            newest_in(&entry.path())
        } else {
            about.modified().ok()
        }
    });
    times.max()
}
