//! A clay is shaped and a sweep drawn by hand in a real browser, and handed on as a link.

use super::hand::{
    changed, click, document, drop_files, find, focus, hear, mark, press, press_with,
};
use super::harness::{Tab, with_browser};
use super::parts::{count, small_scan};
use super::path::downloads;
use super::*;
use chromiumoxide::cdp::browser_protocol::input::{
    DispatchMouseEventParams, DispatchMouseEventPointerType, DispatchMouseEventType, MouseButton,
};
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

/// Begins a stroke at the nose, and loses the device before the hand lets go; waits until the page has come back.
async fn lose_device_in_a_stroke(tab: &Tab) {
    let (x, y) = find(tab, "Picture").await.middle();
    mark(tab, "subject").await;
    tab.mouse(DispatchMouseEventType::MouseMoved, x, y, false)
        .await;
    tab.frames(2).await;
    tab.mouse(DispatchMouseEventType::MousePressed, x, y, true)
        .await;
    for i in 1..=4 {
        let y = y + 12.0 * f64::from(i);
        tab.mouse(DispatchMouseEventType::MouseMoved, x, y, true)
            .await;
        tab.frames(2).await;
    }
    changed(tab, "subject").await;
    tab.eval::<bool>("(window.devices.at(-1).destroy(), true)")
        .await;
    tab.mouse(DispatchMouseEventType::MouseReleased, x, y + 48.0, true)
        .await;
    let is_back = "document.documentElement.dataset.losses === '1' && document.documentElement.dataset.state === 'started'";
    tab.wait_until(is_back, 60).await;
    tab.settled().await;
}

/// Drags with a pen that presses so hard, 0 to 1, as [`stroke`] does with the mouse.
async fn pen_stroke(tab: &Tab, from: (f64, f64), by: (f64, f64), force: f64) -> serde_json::Value {
    let (x, y) = find(tab, "Picture").await.middle();
    mark(tab, "subject").await;
    let event = async |kind, part: f64, force: f64| {
        let (x, y) = (x + from.0 + part * by.0, y + from.1 + part * by.1);
        let mut pen = DispatchMouseEventParams::new(kind, x, y);
        pen.pointer_type = Some(DispatchMouseEventPointerType::Pen);
        if force > 0.0 {
            pen.button = Some(MouseButton::Left);
            pen.buttons = Some(1);
            pen.click_count = Some(1);
            pen.force = Some(force);
        }
        tab.page.execute(pen).await.expect("a pen");
        tab.frames(2).await;
    };
    event(DispatchMouseEventType::MouseMoved, 0.0, 0.0).await;
    event(DispatchMouseEventType::MousePressed, 0.0, force).await;
    for i in 1..=6 {
        event(
            DispatchMouseEventType::MouseMoved,
            f64::from(i) / 6.0,
            force,
        )
        .await;
    }
    event(DispatchMouseEventType::MouseReleased, 1.0, force).await;
    let subject = changed(tab, "subject").await;
    tab.settled().await;
    subject["clay"]["strokes"].clone()
}

/// How far from the middle of the clay the last stroke begins, thousandths of its size.
fn begins_at(strokes: &serde_json::Value) -> f64 {
    let last = strokes.as_array().and_then(|all| all.last());
    let path = &last.expect("a stroke")["path"];
    let place = |axis: usize| path[axis].as_f64().expect("a number");
    [0, 1, 2]
        .map(place)
        .iter()
        .map(|x| x * x)
        .sum::<f64>()
        .sqrt()
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

        // The graphics device is lost in the middle of a stroke: what was drawn is kept, and the hand goes on.
        click(&other, "Shape the clay").await;
        lose_device_in_a_stroke(&other).await;
        let kept = document(&other).await["subject"]["clay"]["strokes"].clone();
        println!("kept after the loss: {kept}");
        assert_eq!(kept[0], ears[0], "{kept}");
        assert_eq!(kept.as_array().map(Vec::len), Some(2), "{kept}");
        click(&other, "Shape the clay").await;
        let more = stroke(&other, (0.0, 30.0), (0.0, 60.0)).await;
        assert_eq!(more.as_array().map(Vec::len), Some(3), "{more}");
        assert_eq!(more[1], kept[1], "{more}");

        // With its document goes what its strokes have left, although the next subject cannot be had.
        let ended = "(Worker.prototype.terminate = (end => function () { window.ended = (window.ended ?? 0) + 1; end.call(this); })(Worker.prototype.terminate), true)";
        assert!(other.eval::<bool>(ended).await);
        let absent = format!(
            r#"{{"fabrica":1,"subject":{{"sha256":"{}"}}}}"#,
            "0".repeat(64)
        );
        let script = format!("(window.fabrica.viewer.set_link('{absent}'), true)");
        assert!(other.eval::<bool>(&script).await);
        other.wait_until("window.ended === 1", 30).await;
    });
}

/// The harder a pen presses, the deeper its tool is sunk. The clay is baked into a tool that stamps it; its head is cut
/// open; and the link shows the same in another tab.
#[test]
fn a_pen_shapes_and_the_baked_clay_stamps() {
    with_browser(BrowserGpu::Software, |session| async move {
        let tab = session
            .half_viewer(&format!("#{}", payload(CLAY)), HIGH)
            .await;
        focus(&tab).await;
        tab.settled().await;
        click(&tab, "Shape the clay").await;
        let (from, by) = ((50.0, -60.0), (30.0, -70.0));
        let mut depths = Vec::new();
        for force in [0.2, 0.5, 0.9] {
            let strokes = pen_stroke(&tab, from, by, force).await;
            assert_eq!(strokes.as_array().map(Vec::len), Some(1), "{strokes}");
            depths.push(begins_at(&strokes));
            mark(&tab, "subject").await;
            press_with(&tab, 2, "z", None).await;
            changed(&tab, "subject").await;
            tab.settled().await;
        }
        let of_mouse = begins_at(&stroke(&tab, from, by).await);
        println!("a pen begins at {depths:?}, a mouse at {of_mouse}");
        assert!(
            depths[0] > depths[1] + 20.0 && depths[1] > depths[2] + 20.0,
            "harder is deeper: {depths:?}"
        );
        assert!(
            (of_mouse - depths[1]).abs() < 3.0,
            "a mouse is a pen at one half"
        );

        click(&tab, "Bake the clay").await;
        let stamped = stroke(&tab, (0.0, 30.0), (0.0, 60.0)).await;
        let tools = &document(&tab).await["subject"]["clay"]["tools"];
        let tool = stamped[1]["tool"].as_u64().expect("another tool") as usize;
        assert_eq!(tools[tool]["shape"], "clay", "{tools}");
        assert_eq!(tools[tool]["strokes"], 1, "{tools}");
        click(&tab, "Put the tool away").await;
        tab.settled().await;
        let whole = object_part(&tab.picture("clay_stamped").await);
        mark(&tab, "templates").await;
        click(&tab, "Place cut").await;
        let (x, y) = find(&tab, "Picture").await.middle();
        tab.click(x, y - 40.0).await;
        let templates = changed(&tab, "templates").await;
        assert_eq!(templates[0]["kind"], "cut", "{templates}");
        press(&tab, "Escape").await;
        tab.settled().await;
        let open = object_part(&tab.picture("clay_cut_open").await);
        let cut = difference(&whole, &open, WHITE);
        assert!(cut.mean > 0.5, "the cut is seen: {cut:?}");
        tab.assert_no_complaints().await;

        let before = document(&tab).await;
        let link: String = tab.eval("window.fabrica.viewer.get_link()").await;
        tab.page.close().await.expect("the tab closes");
        let other = session.half_viewer(&format!("#{link}"), HIGH).await;
        focus(&other).await;
        other.settled().await;
        let opened = document(&other).await;
        for part in ["subject", "templates"] {
            assert_eq!(opened[part], before[part], "{part}");
        }
        let again = object_part(&other.picture("clay_cut_again").await);
        let off = difference(&open, &again, WHITE);
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
