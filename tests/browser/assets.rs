//! The files that a document names, fetched by the page: found, named and refused as in the commands and in the window.

use super::hand::{click, find, listed};
use super::harness::Tab;
use super::*;

/// Where what stands in the panels has to be seen.
const HIGH: (u32, u32) = (780, 560);

/// True if every part stands in the list of all messages, which keeps those that go by themselves.
async fn has_told(tab: &Tab, parts: &[String]) -> bool {
    click(tab, "More").await;
    click(tab, "Messages").await;
    find(tab, "Close messages").await;
    let list = listed(tab).await;
    click(tab, "Close messages").await;
    println!("{list}");
    parts.iter().all(|part| list.contains(part))
}

/// The same as in a command (tests/gpu/cli.rs) and in the window (tests/app/assets.rs).
#[test]
fn label_volumes_open_as_in_a_command() {
    with_browser(BrowserGpu::Software, |session| async move {
        for (name, bytes) in segment_files::files() {
            session.server.add(name, bytes);
        }
        for case in segment_files::cases() {
            // Far away: the picture is not looked at, and few of its pixels have to be drawn.
            let document = serde_json::json!({ "fabrica": 1, "subject": case.subject, "camera": { "distance": 8 } });
            let link = payload(&document.to_string());
            let tab = session.coarse_viewer(&format!("#{link}"), HIGH).await;
            tab.settled().await;
            // An error stays over the picture, with the hashes behind a button.
            let list = listed(&tab).await;
            let has_details = list.contains("\tDetails\t");
            assert_eq!(has_details, case.is_error, "{}: {list}", case.name);
            let is_told = has_told(&tab, &case.says).await;
            assert!(is_told, "{}: {:?}", case.name, case.says);
            click(&tab, "Panel: Tissues").await;
            let list = listed(&tab).await;
            let is_there = |name: &str| list.contains(&format!("Show {name} alone"));
            for name in case.segments {
                assert!(is_there(name), "{}: no “{name}”: {list}", case.name);
            }
            for name in case.absent {
                assert!(!is_there(name), "{}: “{name}”: {list}", case.name);
            }
            if case.is_error {
                // It goes on: another document opens.
                let cube = payload(PLAIN);
                tab.eval::<bool>(&format!("(location.hash = '{cube}', true)"))
                    .await;
                find(&tab, "Show top alone").await;
            }
            tab.page.close().await.expect("the tab closes");
        }
    });
}

/// A label volume on another host is fetched after a tap on a message that names the host, and not before.
#[test]
fn a_foreign_label_volume_waits_for_a_tap() {
    with_browser(BrowserGpu::Software, |session| async move {
        let other = session.server.beside();
        let [(scan, bytes), (parts, labels)] = segment_files::files();
        session.server.add(scan, bytes);
        other.add(parts, labels);
        let src = format!("{}/{parts}", other.address());
        let document = serde_json::json!({ "fabrica": 1, "subject": { "src": scan, "segments": { "src": src } }, "camera": { "distance": 8 } });
        let link = payload(&document.to_string());
        let tab = session.coarse_viewer(&format!("#{link}"), HIGH).await;
        tab.wait_until("window.fabrica.viewer.controls().includes('Fetch')", 60)
            .await;
        let host = other.address().replace("http://", "");
        let list = listed(&tab).await;
        let question = list.lines().find(|line| line.contains(&host));
        assert!(question.is_some(), "the host is named: {list}");
        assert!(
            other.asked().is_empty(),
            "nothing was fetched before the tap"
        );
        click(&tab, "Fetch").await;
        tab.settled().await;
        click(&tab, "Panel: Tissues").await;
        let list = listed(&tab).await;
        assert!(list.contains("Show segment 2 alone"), "{list}");
    });
}
