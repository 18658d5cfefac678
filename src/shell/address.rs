//! Addresses that a document names, in the page and in lessons.

use wasm_bindgen::JsCast as _;
use wasm_bindgen_futures::JsFuture;
use web_sys::{Blob, Url};

/// The host of an absolute address, if it is another one than the page's: nothing is fetched from there unasked.
pub(super) fn foreign_host(address: &str) -> Option<String> {
    let own = web_sys::window()?.location().origin().ok()?;
    let url = Url::new(address).ok()?;
    let is_own = url.origin() == own || ["blob:", "data:"].contains(&url.protocol().as_str());
    (!is_own).then(|| url.host())
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
