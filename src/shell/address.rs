//! Addresses that a document names, in the page and in lessons.

use wasm_bindgen::JsCast as _;
use wasm_bindgen_futures::JsFuture;
use web_sys::{Blob, Url};

use super::worker::task::{ClayTask, Part, ScanTask, Task};
use crate::assets::{Role, Want};
use crate::document::{Document, SubjectRef};

/// The host of an absolute address, if it is another one than the page's: nothing is fetched from there unasked.
pub(super) fn foreign_host(address: &str) -> Option<String> {
    let own = web_sys::window()?.location().origin().ok()?;
    let url = Url::new(address).ok()?;
    let is_own = url.origin() == own || ["blob:", "data:"].contains(&url.protocol().as_str());
    (!is_own).then(|| url.host())
}

/// The part that makes or reads a document's subject: the makers for a built-in one, readers for one at the page's own
/// host, the shaper for a clay that begins with no file or with one there; `base` is what relative addresses start
/// from. None if the reader is to be asked first.
pub(super) fn part_of(document: &Document, base: &str) -> Option<Part> {
    match &document.illustration().subject {
        SubjectRef::Builtin { name, revision } => Some(Task::subject(name, *revision, None).part()),
        SubjectRef::Clay(clay) if clay.file().is_none() => Some(Part::Clay),
        subject => {
            let address = absolute(subject.src()?, base).ok()?;
            let part = || match subject {
                SubjectRef::Clay(_) => Part::Clay,
                _ => Part::of_address(&address),
            };
            foreign_host(&address).is_none().then(part)
        }
    }
}

/// An address that may be fetched, made absolute.
///
/// # Errors
/// In words: why nothing can be fetched from there.
pub(super) fn absolute(src: &str, base: &str) -> Result<String, String> {
    let Ok(url) = Url::new_with_base(src, base) else {
        return Err(format!("This is no address: {src}"));
    };
    if !["http:", "https:", "blob:", "data:"].contains(&url.protocol().as_str()) {
        return Err(format!("A page can only fetch from http and https: {src}"));
    }
    Ok(url.href())
}

/// A want whose further meshes have absolute addresses. Those at another host than the page's and the first mesh's keep
/// none: the reader was not asked about it.
pub(super) fn at_base(want: &Want, base: &str) -> Want {
    let mut want = want.clone();
    let first = want.src().and_then(|src| absolute(src, base).ok());
    let asked = first.and_then(|address| foreign_host(&address));
    for mesh in want.reading.meshes.iter_mut().skip(1) {
        let address = mesh.src.as_ref().and_then(|src| absolute(src, base).ok());
        mesh.src = address.filter(|address| match foreign_host(address) {
            None => true,
            host => host == asked,
        });
    }
    want
}

/// The task to make what the program generates: a subject, or a tool that stands as an object in the scene.
pub(super) fn builtin_task((name, revision): (&str, u32), want: &Want) -> Task {
    match want.role {
        Role::Object => Task::Scan(ScanTask::Mesh(name.to_owned(), want.reading.carves)),
        _ => Task::subject(name, revision, None),
    }
}

/// The task to fetch an address and to read the bytes that come.
pub(super) fn address_task(address: String, want: &Want) -> Task {
    let task = ScanTask::Address {
        address,
        are_segments: want.role == Role::Segments,
        reading: want.reading.clone(),
    };
    file_task(want, task)
}

/// The task for a want whose file is read by this one: a clay begins with it.
pub(super) fn file_task(want: &Want, task: ScanTask) -> Task {
    match want.clay() {
        Some(clay) => Task::Clay(ClayTask::of(clay, want), Some(task)),
        None => Task::Scan(task),
    }
}

/// What lies at an address; `None` if it cannot be had.
pub(super) async fn fetched(address: &str) -> Option<Blob> {
    let response = JsFuture::from(web_sys::window()?.fetch_with_str(address))
        .await
        .ok()?;
    let response: web_sys::Response = response.dyn_into().ok()?;
    if !response.ok() {
        return None;
    }
    JsFuture::from(response.blob().ok()?)
        .await
        .ok()?
        .dyn_into()
        .ok()
}
