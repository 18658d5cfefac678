//! Shaders taken from their files while somebody changes them: native debug builds only.
//!
//! Every other build, and a debug build away from its sources, draws with the embedded text.

use super::RenderError;
use super::programs::{Assembled, PROGRAMS, ShaderFile};
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

/// The text of a shader file: from the disk while it is watched, else as embedded.
pub(super) fn text_of(file: &'static ShaderFile) -> Cow<'static, str> {
    if !IS_WATCHING.load(Ordering::Relaxed) {
        return Cow::Borrowed(file.source);
    }
    match std::fs::read_to_string(folder().join(file.path)) {
        Ok(text) => Cow::Owned(text),
        Err(_away) => Cow::Borrowed(file.source),
    }
}

/// Looks at the shader files in a thread of its own until `on_change` says false; calls it after each change of one of them.
/// Does nothing where the sources are not at hand.
pub fn watch_shaders(mut on_change: impl FnMut() -> bool + Send + 'static) {
    if !folder().is_dir() {
        return;
    }
    IS_WATCHING.store(true, Ordering::Relaxed);
    std::thread::spawn(move || {
        let mut seen = newest();
        loop {
            std::thread::sleep(PERIOD);
            let now = newest();
            if now != seen {
                seen = now;
                if !on_change() {
                    return;
                }
            }
        }
    });
}

fn newest() -> Option<SystemTime> {
    let folder = folder();
    super::programs::FILES
        .iter()
        .filter_map(|file| {
            std::fs::metadata(folder.join(file.path))
                .ok()?
                .modified()
                .ok()
        })
        .max()
}

/// Says what is wrong with the programs as they stand, with `file.wgsl:line`.
///
/// # Errors
/// [`RenderError::Shader`] for the first that does not parse or validate.
pub(super) fn check_programs() -> Result<(), RenderError> {
    use wgpu::naga;
    for program in PROGRAMS {
        let text = Assembled::new(program)?;
        let fault = |line: Option<usize>, message: String| {
            let place = line.map_or_else(String::new, |line| text.place(line));
            RenderError::Shader {
                program: program.name,
                messages: format!("{place}: {message}"),
            }
        };
        let line_of = |at: Option<naga::SourceLocation>| at.map(|at| at.line_number as usize);
        let module = naga::front::wgsl::parse_str(&text.source)
            .map_err(|e| fault(line_of(e.location(&text.source)), e.message().to_owned()))?;
        naga::valid::Validator::new(
            naga::valid::ValidationFlags::all(),
            naga::valid::Capabilities::empty(),
        )
        .validate(&module)
        .map_err(|e| fault(line_of(e.location(&text.source)), e.as_inner().to_string()))?;
    }
    Ok(())
}
