//! The files that a document names, fetched by the page: found, named and refused as in the commands and in the window.

use super::hand::{click, pause, settled};
use super::*;

/// Where what stands in the panels has to be seen.
const HIGH: (u32, u32) = (780, 560);

/// The same segments as in a command (tests/gpu/cli.rs) and in the window (tests/app/assets.rs). Those two also read
/// the messages; the page lists its controls only, and messages go by while a slow device draws.
#[test]
fn label_volumes_open_as_in_a_command() {
    with_browser(BrowserGpu::Software, |session| async move {
        for (name, bytes) in segment_files::files() {
            session.server.add(name, bytes);
        }
        for case in segment_files::cases() {
            let document = serde_json::json!({ "fabrica": 1, "subject": case.subject });
            let link = payload(&document.to_string());
            let tab = session.viewer_sized(&format!("#{link}"), HIGH).await;
            settled(&tab).await;
            let controls = "window.fabrica.viewer.controls()";
            click(&tab, "Panel: Tissues").await;
            settled(&tab).await;
            let list: String = tab.eval(controls).await;
            let is_there = |name: &str| list.contains(&format!("Show {name} alone"));
            for name in case.segments {
                assert!(is_there(name), "{}: no “{name}”: {list}", case.name);
            }
            for name in case.absent {
                assert!(!is_there(name), "{}: “{name}”: {list}", case.name);
            }
            tab.page.close().await.expect("the tab closes");
        }
    });
}

/// A label volume on another host is fetched after a tap on a message that names the host, and not before.
#[test]
fn a_foreign_label_volume_waits_for_a_tap() {
    with_browser(BrowserGpu::Software, |session| async move {
        let other = session.other_server();
        let [(scan, bytes), (parts, labels)] = segment_files::files();
        session.server.add(scan, bytes);
        other.add(parts, labels);
        let src = format!("{}/{parts}", other.address());
        let document = serde_json::json!({ "fabrica": 1, "subject": { "src": scan, "segments": { "src": src } } });
        let link = payload(&document.to_string());
        let tab = session.viewer_sized(&format!("#{link}"), HIGH).await;
        tab.wait_until("window.fabrica.viewer.controls().includes('Fetch')", 60)
            .await;
        assert!(
            other.asked().is_empty(),
            "nothing was fetched before the tap"
        );
        // The card comes in with a movement.
        pause(1500).await;
        click(&tab, "Fetch").await;
        settled(&tab).await;
        click(&tab, "Panel: Tissues").await;
        settled(&tab).await;
        let list: String = tab.eval("window.fabrica.viewer.controls()").await;
        assert!(list.contains("Show segment 2 alone"), "{list}");
    });
}
