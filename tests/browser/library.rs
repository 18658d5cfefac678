//! The examples in the page: fetched when they are looked at and not before, and opened by a click.

use super::hand::{click, document, find};
use super::*;

/// Bytes of the list and of the pictures together.
const MOST_BYTES: u64 = 400_000;

#[test]
fn examples_are_fetched_when_they_are_looked_at() {
    const SIZE: (u32, u32) = (960, 540);
    with_browser(BrowserGpu::Software, |session| async move {
        let tab = session
            .viewer_sized(&format!("#{}", payload(PLAIN)), SIZE)
            .await;
        tab.settled().await;
        let asked = || {
            let mut asked = session.server.asked();
            asked.retain(|path| path.contains("/examples/"));
            asked.sort();
            asked
        };
        assert!(asked().is_empty(), "unasked: {:?}", asked());
        click(&tab, "Examples").await;
        find(&tab, "Subject of the examples").await;
        let both = ["/examples/list.json", "/examples/pictures.png"];
        let files = "performance.getEntriesByType('resource').filter((file) => file.name.includes('/examples/'))";
        tab.wait_until(&format!("{files}.length === 2"), 20).await;
        assert_eq!(asked(), both);
        let bytes: u64 = tab
            .eval(&format!(
                "{files}.reduce((sum, file) => sum + file.encodedBodySize, 0)"
            ))
            .await;
        println!("{bytes} bytes of examples");
        assert!((20_000..=MOST_BYTES).contains(&bytes), "{bytes} bytes");
        tab.picture("library").await;

        click(&tab, "Subject of the examples").await;
        click(&tab, "Cube").await;
        click(&tab, "Open the example Ten ways to open a block").await;
        tab.wait_until(
            "JSON.parse(window.fabrica.viewer.get_document()).title === 'Ten ways to open a block'",
            60,
        )
        .await;
        let opened = document(&tab).await;
        assert_eq!(
            opened["steps"].as_array().map(Vec::len),
            Some(SHOWCASE_STEPS)
        );
        assert_eq!(asked(), both, "the list holds the whole example");
        tab.assert_no_complaints().await;
    });
}

const SHOWCASE_STEPS: usize = 9;
