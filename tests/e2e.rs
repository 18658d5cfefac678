//! What only a real browser has: the first picture from a link, resize, history, files dropped, refusal of the GPU.
//!
//! `cargo xtask test` builds the page and sets up Chromium and Xvfb first. Pictures are left in target/e2e.
#![cfg(feature = "app")]

#[path = "e2e/harness.rs"]
mod harness;

use harness::{Gpu, with_browser};

/// A plain address shows the viewer, asks only its own server, and breaks no content policy.
#[test]
fn plain_address_shows_the_viewer() {
    with_browser(Gpu::Software, |session| async move {
        let tab = session.viewer("").await;
        tokio::time::sleep(std::time::Duration::from_secs(2)).await;
        tab.picture("plain").await;
        tab.assert_no_complaints().await;
    });
}

/// Without WebGPU the page says so, says what to do, and keeps the link.
#[test]
fn page_without_webgpu_names_remedies() {
    with_browser(Gpu::None, |session| async move {
        let tab = session.open("#nothing").await;
        tab.wait_until("document.documentElement.dataset.state === 'no-webgpu'", 60)
            .await;
        let text = tab.text().await;
        assert!(text.contains("WebGPU"), "names the cause: {text}");
        assert!(
            text.contains("graphics acceleration"),
            "names a remedy: {text}"
        );
        let address: String = tab.eval("location.href").await;
        assert!(address.ends_with("#nothing"), "the link is kept: {address}");
        tab.assert_no_complaints().await;
    });
}
