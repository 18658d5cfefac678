//! A clay is shaped and a sweep drawn by hand in a real browser, and handed on as a link.

use super::hand::{
    changed, click, document, drop_files, find, focus, hear, mark, press, press_with,
};
use super::harness::{Tab, with_browser};
use super::parts::{count, small_scan};
use super::path::downloads;
use super::*;
use fabrica::clay::{MeshFormat, Writing};
use fabrica::document::{Document, SubjectRef};
use fabrica::shell::clays::ClayDesk;
use std::path::Path;

const CLAY: &str = r#"{ "fabrica": 1, "subject": { "clay": { "detail": 0.05 } } }"#;
const SIZE: (u32, u32) = (800, 760);

/// Drags over the picture from a place beside its middle, and waits until that is a stroke and the clay is shaped.
async fn stroke(tab: &Tab, from: (f64, f64), by: (f64, f64)) -> serde_json::Value {
    let (x, y) = find(tab, "Picture").await.middle();
    let (x, y) = (x + from.0, y + from.1);
    mark(tab, "subject").await;
    tab.drag((x, y), (x + by.0, y + by.1), 6).await;
    let subject = changed(tab, "subject").await;
    tab.settled().await;
    subject["clay"]["strokes"].clone()
}

/// The file that the native program makes of a document's clay.
fn natively(document: &serde_json::Value, format: MeshFormat) -> Vec<u8> {
    let document = Document::from_value(document.clone()).expect("a document");
    let SubjectRef::Clay(clay) = document.illustration().subject_shown() else {
        panic!("a clay");
    };
    let title = document.illustration().title.clone();
    let writing = Writing { format, title };
    let made = ClayDesk::default().file(&clay, &writing, &mut |_| true);
    made.expect("a shaped clay")
}

/// The bytes of the only file that ends so, once it is whole.
async fn saved_in(folder: &Path, end: &str) -> Vec<u8> {
    for _ in 0..100 {
        let files = std::fs::read_dir(folder).expect("the folder").flatten();
        let mut ends = files
            .map(|file| file.path())
            .filter(|path| path.extension().is_some_and(|e| e == end));
        if let Some(path) = ends.next() {
            return std::fs::read(path).expect("the file");
        }
        tokio::time::sleep(std::time::Duration::from_millis(100)).await;
    }
    panic!("no file that ends in {end} was saved");
}

#[test]
fn a_clay_is_shaped_by_hand_and_handed_on() {
    with_browser(BrowserGpu::Software, |session| async move {
        let tab = session
            .half_viewer(&format!("#{}", payload(CLAY)), SIZE)
            .await;
        focus(&tab).await;
        tab.settled().await;
        let ball = object_part(&tab.picture("clay_begun").await);
        click(&tab, "Shape the clay").await;
        // An ear on either side, and a nose in the middle, which the next one takes back.
        let ears = stroke(&tab, (50.0, -60.0), (30.0, -70.0)).await;
        assert_eq!(ears.as_array().map(Vec::len), Some(1), "{ears}");
        assert_eq!(ears[0]["mirror"], "x");
        let nose = stroke(&tab, (0.0, 30.0), (0.0, 60.0)).await;
        assert_eq!(nose.as_array().map(Vec::len), Some(2), "{nose}");
        mark(&tab, "subject").await;
        press_with(&tab, 2, "z", None).await;
        let subject = changed(&tab, "subject").await;
        assert_eq!(subject["clay"]["strokes"], ears);
        click(&tab, "Put the tool away").await;
        tab.settled().await;
        let shaped = object_part(&tab.picture("clay_with_ears").await);
        let grown = difference(&ball, &shaped, WHITE);
        assert!(grown.mean > 0.5, "the ears are seen: {grown:?}");
        // As a file it is the native program's, bit for bit.
        let folder = downloads(&session, "clay").await;
        for format in [MeshFormat::Stl, MeshFormat::Glb] {
            let end = format.extension();
            click(&tab, "More").await;
            click(&tab, &format!("Save mesh as {}", end.to_uppercase())).await;
            hear(&tab, &format!("fabrica.{end} is in this browser")).await;
            let saved = saved_in(&folder, end).await;
            assert!(saved == natively(&document(&tab).await, format), "{end}");
        }
        assert_eq!(
            count(&session.server, "fabrica_clay_bg.wasm"),
            1,
            "its worker rests between strokes"
        );
        tab.assert_no_complaints().await;

        // The same from the link, in another tab.
        let link: String = tab.eval("window.fabrica.viewer.get_link()").await;
        let whole = document(&tab).await;
        tab.page.close().await.expect("the tab closes");
        let other = session.half_viewer(&format!("#{link}"), SIZE).await;
        focus(&other).await;
        other.settled().await;
        let opened = document(&other).await;
        assert_eq!(opened["subject"], whole["subject"]);
        let again = object_part(&other.picture("clay_handed_on").await);
        let off = difference(&shaped, &again, WHITE);
        assert!(off.mean < 0.2, "the same clay: {off:?}");
        other.assert_no_complaints().await;
    });
}

/// A scan that the reader drops becomes clay by two clicks, and is there again after undo.
#[test]
fn a_dropped_scan_becomes_clay() {
    with_browser(BrowserGpu::Software, |session| async move {
        session.server.add("ball.nrrd", small_scan());
        let tab = session.coarse_viewer("", SIZE).await;
        focus(&tab).await;
        tab.settled().await;
        drop_files(&tab, &["ball.nrrd"]).await;
        tab.settled().await;
        let scan = document(&tab).await["subject"].clone();
        assert!(scan["sha256"].is_string(), "{scan}");
        click(&tab, "Panel: Tissues").await;
        click(&tab, "Shape it as clay").await;
        mark(&tab, "subject").await;
        click(&tab, "Outer surface").await;
        let subject = changed(&tab, "subject").await;
        let from = &subject["clay"]["from"];
        assert_eq!(from["of"]["sha256"], scan["sha256"], "{subject}");
        assert!(from["iso"].is_number(), "{subject}");
        tab.settled().await;
        click(&tab, "Put the tool away").await;
        tab.settled().await;
        let clay = object_part(&tab.picture("clay_of_a_dropped_scan").await);
        assert!(drawn_pixels(&clay) > 500, "the ball is seen");
        mark(&tab, "subject").await;
        press_with(&tab, 2, "z", None).await;
        assert_eq!(changed(&tab, "subject").await, scan);
        tab.settled().await;
        tab.assert_no_complaints().await;
    });
}

/// So high that all of the catalogue is seen.
const HIGH: (u32, u32) = (800, 1700);

/// A sweep is drawn on what is seen, and its link shows the same in another tab.
#[test]
fn a_sweep_is_drawn_by_hand_and_handed_on() {
    with_browser(BrowserGpu::Software, |session| async move {
        let bare =
            r#"{ "fabrica": 1, "subject": { "builtin": "cube" }, "camera": { "distance": 6 } }"#;
        let tab = session
            .coarse_viewer(&format!("#{}", payload(bare)), HIGH)
            .await;
        focus(&tab).await;
        tab.settled().await;
        let cube = object_part(&tab.picture("sweep_begun").await);
        click(&tab, "Place sweep").await;
        let (x, y) = find(&tab, "Picture").await.middle();
        mark(&tab, "templates").await;
        tab.drag((x, y), (x + 70.0, y - 90.0), 6).await;
        let templates = changed(&tab, "templates").await;
        assert_eq!(templates.as_array().map(Vec::len), Some(1), "{templates}");
        assert_eq!(templates[0]["kind"], "sweep");
        // Its handles and its bar go.
        press(&tab, "Escape").await;
        tab.settled().await;
        let swept = object_part(&tab.picture("sweep_drawn").await);
        let moved = difference(&cube, &swept, WHITE);
        assert!(moved.mean > 0.5, "tissue has gone along: {moved:?}");
        tab.assert_no_complaints().await;

        let link: String = tab.eval("window.fabrica.viewer.get_link()").await;
        tab.page.close().await.expect("the tab closes");
        let other = session.coarse_viewer(&format!("#{link}"), HIGH).await;
        focus(&other).await;
        other.settled().await;
        assert_eq!(document(&other).await["templates"], templates);
        let again = object_part(&other.picture("sweep_handed_on").await);
        let off = difference(&swept, &again, WHITE);
        assert!(off.mean < 0.2, "the same sweep: {off:?}");
        other.assert_no_complaints().await;
    });
}
