//! Figures in the page and in embeds: their part is fetched when one is shown, and their pictures are those of the
//! native program.

use super::embed::{open_half, picture_of, ready, rests_at};
use super::hand::{
    CTRL, Control, Touch, changed, click, controls, find, focus, mark, press, press_with,
};
use super::harness::Tab;
use super::native::{drawn, promised};
use super::parts::count;
use super::picture_files::jpeg;
use super::*;
use fabrica::data::{Resources, Subject};
use fabrica::document::Illustration;
use fabrica::figure::{Bender, Original, ReadPlate, builtin_plate, read_plate, unwatched};
use image::RgbaImage;
use std::time::Instant;

/// An arm whose hand is moved by a step.
const ARM: &str = r#"{"fabrica":1,"subject":{"builtin":"drawn-arm"},"figure":{"detail":1500,"handles":[{"region":"humerus"},{"region":"hand","move":[0.02,0.03]}]},"steps":[{"set":{"/figure/handles/1/move":[0.05,0.12]},"seconds":1}]}"#;
/// A picture that is bent at one corner.
const PLATE: &str = r#"{"fabrica":1,"subject":{"src":"plate.png"},"figure":{"detail":800,"handles":[{"at":[-0.4,-0.2]},{"at":[0.3,0.2],"move":[0.05,0.1]}]}}"#;

/// What the native program draws of an illustration.
pub(crate) async fn native(
    shown: &Illustration,
    plate: fabrica::data::Plate,
    size: [u32; 2],
) -> RgbaImage {
    let gpu = Gpu::open(&GpuOptions::default()).await.expect("a device");
    let mut bender = Bender::new(&plate).expect("a good plate");
    let figure = shown.figure.clone().unwrap_or_default();
    let bent = bender.bent(&figure, &mut unwatched).expect("not stopped");
    let studio = Studio::new(&gpu, &Subject::from(plate), false).expect("it fits");
    let studio = studio.with_resources(Resources {
        sheet: Some(bent.sheet),
        ..Resources::default()
    });
    drawn(&studio, shown, size).await
}

pub(crate) fn illustration(json: &str) -> Illustration {
    let document = Document::from_json(json).expect("a good document");
    document.illustration().clone()
}

/// A plate of stripes and a disc.
pub(crate) fn plate_png() -> Vec<u8> {
    let picture = RgbaImage::from_fn(120, 80, |x, y| {
        let is_disc = (x as i32 - 60).pow(2) + (y as i32 - 40).pow(2) < 900;
        let stripe = if (x / 10) % 2 == 0 { 200 } else { 120 };
        image::Rgba(if is_disc {
            [190, 60, 50, 255]
        } else {
            [stripe, stripe, 90, 255]
        })
    });
    let mut bytes = std::io::Cursor::new(Vec::new());
    picture
        .write_to(&mut bytes, image::ImageFormat::Png)
        .expect("a PNG");
    bytes.into_inner()
}

/// Mean difference from the native program's picture, 255ths, at most: in pictures as small as these a plate of 2,048
/// pixels is read from copies sixteen times smaller, where two software devices differ by up to 23 at lines, 0.8 in the
/// mean. One that is bent in another way differs by several times as much.
const NEAR: f64 = 2.0;

/// The same figure at rest, without its handles.
pub(crate) fn unbent(shown: &Illustration) -> Illustration {
    let mut unbent = shown.clone();
    if let Some(figure) = &mut unbent.figure {
        figure.handles.clear();
    }
    unbent
}

fn assert_alike(page: &RgbaImage, native: &RgbaImage, name: &str) {
    let found = difference(page, native, WHITE);
    let folder = harness::root().join("target/e2e/compared");
    std::fs::create_dir_all(&folder).expect("a folder for pictures");
    for (side, picture) in [("page", page), ("native", native)] {
        let path = folder.join(format!("figure_{name}_{side}.png"));
        picture.save(path).expect("saved");
    }
    println!("{name}: {found:?}");
    assert!(found.count > 1000, "{name} is drawn: {found:?}");
    assert!(found.mean < NEAR, "{name}: {found:?}");
}

/// The page draws a drawing of the program as the command line does, and fetches the part for it once; a file's picture
/// takes the decoders besides.
#[test]
fn a_page_draws_figures_as_the_native_program_does() {
    with_browser(BrowserGpu::Software, |session| async move {
        let link = payload(ARM);
        // The bar of its step lies under the picture.
        let size = (PAGE.0, PAGE.1 + 60);
        let tab = session.half_viewer(&format!("#{link}"), size).await;
        tab.settled().await;
        let server = &session.server;
        assert_eq!(count(server, "fabrica_figures_bg.wasm"), 1);
        for part in ["subjects", "scans", "meshes", "pictures"] {
            assert_eq!(count(server, &format!("fabrica_{part}")), 0, "no {part}");
        }
        let page = promised(&tab, "window.fabrica.viewer.picture()").await;
        let plate = builtin_plate("drawn-arm").expect("it is built in");
        let size = page.dimensions().into();
        let shown = illustration(ARM);
        let plain = native(&unbent(&shown), plate.clone(), size).await;
        assert_alike(&page, &native(&shown, plate, size).await, "arm");
        let apart = difference(&page, &plain, WHITE);
        assert!(apart.mean > 2.0 * NEAR, "the pose is seen: {apart:?}");
        tab.assert_no_complaints().await;

        session.server.add("plate.png", plate_png());
        let link = payload(PLATE);
        let tab = session.half_viewer(&format!("#{link}"), PAGE).await;
        tab.settled().await;
        for part in ["subjects", "scans", "meshes"] {
            assert_eq!(count(server, &format!("fabrica_{part}")), 0, "no {part}");
        }
        assert!(count(server, "fabrica_pictures_bg.wasm") > 0);
        let page = promised(&tab, "window.fabrica.viewer.picture()").await;
        let ReadPlate { plate, .. } = read_plate(&plate_png()).expect("a PNG");
        let size = page.dimensions().into();
        assert_alike(
            &page,
            &native(&illustration(PLATE), plate, size).await,
            "plate",
        );
        tab.assert_no_complaints().await;
    });
}

/// A picture that is dropped on the page begins a document that tells that it is a figure.
#[test]
fn a_dropped_picture_is_a_figure() {
    with_browser(BrowserGpu::Software, |session| async move {
        session.server.add("plate.png", plate_png());
        // By another name its bytes tell what it is.
        session.server.add("plate.nii", plate_png());
        for name in ["plate.png", "plate.nii"] {
            let tab = session
                .coarse_viewer(&format!("#{}", payload(PLAIN)), PAGE)
                .await;
            tab.settled().await;
            drop_files(&tab, &[name]).await;
            tab.wait_until(
                "JSON.parse(window.fabrica.viewer.get_document()).figure !== undefined",
                120,
            )
            .await;
            tab.settled().await;
            let picture = object_part(&tab.picture("figure_dropped").await);
            assert!(drawn_pixels(&picture) > 2000, "{name} is drawn");
            tab.assert_no_complaints().await;
        }
    });
}

/// An embed shows a figure and plays its steps with the reader and the part for figures alone.
#[test]
fn an_embed_bends_a_figure_from_step_to_step() {
    with_browser(BrowserGpu::Software, |session| async move {
        let embed = format!("controls src=\"#{}\">", payload(ARM));
        let tab = open_half(&session, &[embed], "", (320, 500)).await;
        ready(&tab, 1).await;
        rests_at(&tab, "e0", 0).await;
        let before = picture_of(&tab, "e0").await;
        let size = before.dimensions().into();
        let plate = || builtin_plate("drawn-arm").expect("it is built in");
        let document = Document::from_json(ARM).expect("a good document");
        let lesson = document.lesson().expect("steps");
        let at = |step: usize| lesson.at_step(step).expect("a step").clone();
        assert_alike(&before, &native(&at(0), plate(), size).await, "step 0");
        tab.eval::<bool>("(e0.next(), true)").await;
        rests_at(&tab, "e0", 1).await;
        let after = picture_of(&tab, "e0").await;
        assert!(difference(&before, &after, WHITE).mean > 1.0, "it is bent");
        assert_alike(&after, &native(&at(1), plate(), size).await, "step 1");
        tab.eval::<bool>("(e0.reset(), true)").await;
        let told = "told.findLast(([name]) => name === 'viewchange')";
        tab.wait_until(&format!("{told} !== undefined"), 60).await;
        let turn: Vec<f32> = tab.eval(&format!("{told}[2].view.rotate")).await;
        assert!(turn[3].abs() > 0.999, "as the document has it: {turn:?}");
        let server = &session.server;
        assert_eq!(count(server, "fabrica_figures_bg.wasm"), 1);
        for part in ["subjects", "scans", "meshes", "pictures", "bg"] {
            assert_eq!(count(server, &format!("fabrica_{part}")), 0, "no {part}");
        }
        tab.assert_no_complaints().await;
    });
}

/// Where a place of the figure's plane is seen in the page.
pub(crate) async fn spot(tab: &Tab, x: f64, y: f64) -> (f64, f64) {
    let picture = find(tab, "Picture").await;
    let text: String = tab.eval("window.fabrica.viewer.get_document()").await;
    let camera = illustration(&text).camera;
    let half = f64::from((0.5 * camera.fov_deg.to_radians()).tan() * camera.distance);
    let scale = 0.5 * picture.size.0.min(picture.size.1) / half;
    let (middle_x, middle_y) = picture.middle();
    let target = camera.target.as_dvec3();
    (
        middle_x + (x - target.x) * scale,
        middle_y - (y - target.y) * scale,
    )
}

/// Clicks on a place of the figure, and waits for the part of the document that it changes.
async fn click_on(tab: &Tab, (x, y): (f64, f64)) -> serde_json::Value {
    mark(tab, "figure").await;
    let (x, y) = spot(tab, x, y).await;
    tab.click(x, y).await;
    let figure = changed(tab, "figure").await;
    tab.settled().await;
    figure
}

pub(crate) fn count_of(figure: &serde_json::Value, list: &str) -> usize {
    figure[list].as_array().map_or(0, Vec::len)
}

/// Notes how long each pose takes that follows the hand, from the request to the answer, ms.
const TIME_FOLLOWING: &str = "(() => {
    window.followed = [];
    const post = Worker.prototype.postMessage;
    Worker.prototype.postMessage = function (message, ...rest) {
        if (message?.rounds !== undefined) {
            if (!this.isTimed) this.addEventListener('message', (event) => {
                if (event.data[0] !== 'bent' || !this.asked) return;
                window.followed.push(performance.now() - this.asked);
                this.asked = 0;
            });
            this.isTimed = true;
            this.asked = performance.now();
        }
        return post.call(this, message, ...rest);
    };
    return true;
})()";

/// A plate is dropped, divided, pinned and bent by the mouse, undone by a key, and its link shows the same in another
/// tab and natively.
#[test]
fn a_plate_is_divided_and_bent_by_hand() {
    with_browser(BrowserGpu::Software, |session| async move {
        session.server.add("plate.png", plate_png());
        let size = (900, 760);
        let link = format!("#{}", payload(PLAIN));
        let tab = session.half_viewer(&link, size).await;
        tab.settled().await;
        drop_files(&tab, &["plate.png"]).await;
        let is_figure = "JSON.parse(window.fabrica.viewer.get_document()).figure !== undefined";
        tab.wait_until(is_figure, 120).await;
        focus(&tab).await;
        tab.settled().await;
        // The disc by a click, a stripe by a drag that widens its tolerance until it holds all stripes.
        click(&tab, "By colour").await;
        let figure = click_on(&tab, (0.0, 0.0)).await;
        assert_eq!(count_of(&figure, "regions"), 1, "{figure}");
        mark(&tab, "figure").await;
        let (x, y) = spot(&tab, -0.4, 0.2).await;
        tab.drag((x, y), (x + 60.0, y), 6).await;
        let figure = changed(&tab, "figure").await;
        assert_eq!(count_of(&figure, "regions"), 2, "{figure}");
        let tolerance = figure.pointer("/regions/1/from/flood/tolerance");
        assert!(
            tolerance.is_some_and(|t| t.as_f64().is_some_and(|t| (40.0..60.0).contains(&t))),
            "{figure}"
        );
        // The disc is made of bone.
        click(&tab, "region 1").await;
        mark(&tab, "figure").await;
        tab.settled().await;
        // The row's label has the same name.
        let is_combo = |control: &Control| control.name == "Material" && control.role == "ComboBox";
        let combo = controls(&tab).await.into_iter().find(is_combo);
        let (x, y) = combo.expect("a choice of materials").middle();
        tab.click(x, y).await;
        click(&tab, "Bone: rigid").await;
        let figure = changed(&tab, "figure").await;
        assert_eq!(figure["regions"][0]["rigidity"], "rigid", "{figure}");
        click(&tab, "Pin").await;
        for (i, place) in [(-0.4, -0.2), (0.0, 0.05), (0.4, 0.2)]
            .into_iter()
            .enumerate()
        {
            let figure = click_on(&tab, place).await;
            assert_eq!(count_of(&figure, "handles"), i + 1, "{figure}");
        }
        press(&tab, "Escape").await;
        mark(&tab, "figure").await;
        let _: bool = tab.eval(TIME_FOLLOWING).await;
        let from = find(&tab, "Pin 3 in the picture").await.middle();
        tab.drag(from, (from.0 - 10.0, from.1 - 40.0), 6).await;
        let figure = changed(&tab, "figure").await;
        let by = &figure["handles"][2]["move"];
        assert!(by[1].as_f64().is_some_and(|y| y > 0.05), "{figure}");
        tab.settled().await;
        let mut followed: Vec<f64> = tab.eval("window.followed").await;
        followed.sort_by(f64::total_cmp);
        assert!(!followed.is_empty(), "it followed");
        println!(
            "{} poses followed the hand, each in {:.1} ms (median; the worker and its messages)",
            followed.len(),
            followed[followed.len() / 2]
        );
        object_part(&tab.picture("figure_made").await);
        let page = promised(&tab, "window.fabrica.viewer.picture()").await;
        let text: String = tab.eval("window.fabrica.viewer.get_document()").await;
        let ReadPlate { plate, .. } = read_plate(&plate_png()).expect("a PNG");
        let shown = illustration(&text);
        let size_px = page.dimensions().into();
        assert_alike(&page, &native(&shown, plate.clone(), size_px).await, "made");
        let rest = native(&unbent(&shown), plate, size_px).await;
        assert!(difference(&page, &rest, WHITE).mean > NEAR, "it is bent");
        // One drag is one step of undo, and the picture comes back with it.
        press_with(&tab, CTRL, "z", None).await;
        tab.wait_until(
            "JSON.parse(window.fabrica.viewer.get_document()).figure.handles[2].move === undefined",
            60,
        )
        .await;
        press_with(&tab, CTRL, "y", None).await;
        tab.settled().await;
        // Another reader has the file too.
        let link: String = tab.eval("window.fabrica.viewer.get_link()").await;
        let other = session.half_viewer(&format!("#{link}"), size).await;
        drop_files(&other, &["plate.png"]).await;
        other
            .wait_until(
                "window.fabrica.viewer.get_document().includes('\"handles\"')",
                60,
            )
            .await;
        other.settled().await;
        let again = promised(&other, "window.fabrica.viewer.picture()").await;
        let apart = difference(&page, &again, WHITE);
        assert!(apart.percentile <= 1, "the same picture: {apart:?}");
        tab.assert_no_complaints().await;
    });
}

/// Pins by fingers on a phone, and by keys alone.
#[test]
fn pins_are_set_by_fingers_and_by_keys() {
    with_browser(BrowserGpu::Software, |session| async move {
        let json = r#"{"fabrica":1,"subject":{"builtin":"drawn-arm"},"figure":{"detail":1500}}"#;
        let link = format!("#{}", payload(json));
        let tab = session.coarse_viewer(&link, (390, 844)).await;
        tab.settled().await;
        let touch = Touch::new(&tab).await;
        tab.settled().await;
        for (i, (x, y)) in [(-0.25, 0.05), (0.36, -0.08)].into_iter().enumerate() {
            if i == 0 {
                touch.tap("Add").await;
                touch.tap("Pin").await;
                tab.settled().await;
            }
            mark(&tab, "figure").await;
            touch.tap_at(spot(&tab, x, y).await).await;
            let figure = changed(&tab, "figure").await;
            assert_eq!(count_of(&figure, "handles"), i + 1, "{figure}");
            tab.settled().await;
        }
        mark(&tab, "figure").await;
        let (x, y) = find(&tab, "Pin 2 in the picture").await.middle();
        touch.swipe(&[[(x, y), (x - 5.0, y - 60.0)]]).await;
        let figure = changed(&tab, "figure").await;
        let by = &figure["handles"][1]["move"];
        assert!(by[1].as_f64().is_some_and(|y| y > 0.03), "{figure}");
        tab.settled().await;
        tab.picture("figure_by_fingers").await;
        tab.assert_no_complaints().await;

        // Its forearm lies in the middle of the picture.
        let json = json.replace(
            "\"figure\"",
            "\"camera\":{\"target\":[0.1,-0.12,0]},\"figure\"",
        );
        let link = format!("#{}", payload(&json));
        let tab = session.coarse_viewer(&link, (900, 760)).await;
        focus(&tab).await;
        tab.settled().await;
        // As one goes through the controls of the page with Tab.
        click(&tab, "Pin").await;
        mark(&tab, "figure").await;
        focus(&tab).await;
        press(&tab, "Enter").await;
        let figure = changed(&tab, "figure").await;
        assert_eq!(count_of(&figure, "handles"), 1, "{figure}");
        mark(&tab, "figure").await;
        press(&tab, "]").await;
        let figure = changed(&tab, "figure").await;
        assert!(figure["handles"][0]["turn"].is_number(), "{figure}");
        mark(&tab, "figure").await;
        press(&tab, "Delete").await;
        let figure = changed(&tab, "figure").await;
        assert_eq!(count_of(&figure, "handles"), 0, "{figure}");
        tab.assert_no_complaints().await;
    });
}

/// A drawing with a word in it, which no picture shows.
const DRAWING: &str = r##"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 400 300"><circle id="head" cx="200" cy="150" r="110" fill="#c9a27c"/><text x="200" y="150" font-size="20">Ulna</text></svg>"##;

/// What takes long is stopped and gone on with; a drawing seen closely is drawn finer; its words become labels; a JPEG
/// has the pixels that the native program reads.
#[test]
fn a_figure_is_stopped_drawn_finer_and_labelled() {
    with_browser(BrowserGpu::Software, |session| async move {
        let size = (900, 760);
        let json = r#"{"fabrica":1,"subject":{"builtin":"drawn-arm"},"figure":{"detail":60000,"handles":[{"region":"humerus"},{"region":"hand","move":[0.02,0.1]}]}}"#;
        let link = format!("#{}", payload(json));
        let tab = session.half_viewer(&link, size).await;
        click(&tab, "Stop bending").await;
        let go_on = find(&tab, "Go on").await;
        tab.picture("figure_stopped").await;
        let text: String = tab.eval("window.fabrica.viewer.get_document()").await;
        assert!(text.contains("60000"), "nothing of it is lost: {text}");
        tab.click(go_on.middle().0, go_on.middle().1).await;
        tab.settled().await;
        let page = promised(&tab, "window.fabrica.viewer.picture()").await;
        let plate = || builtin_plate("drawn-arm").expect("it is built in");
        let size_px = page.dimensions().into();
        let shown = illustration(json);
        assert_alike(&page, &native(&shown, plate(), size_px).await, "gone_on");
        tab.assert_no_complaints().await;

        // The edge of a bone is several pixels wide where the drawing is seen too closely.
        let json = r#"{"fabrica":1,"subject":{"builtin":"drawn-arm"},"figure":{"detail":1500},"camera":{"target":[0.1,-0.12,0],"distance":0.15}}"#;
        let link = format!("#{}", payload(json));
        let tab = session.half_viewer(&link, size).await;
        tab.settled().await;
        let page = promised(&tab, "window.fabrica.viewer.picture()").await;
        let size_px = page.dimensions().into();
        let shown = illustration(json);
        let coarse = native(&shown, plate(), size_px).await;
        let original = Original::of(&plate()).expect("a drawing");
        let finer = plate().redrawn(original.finer().expect("it can be drawn finer"));
        let finer = native(&shown, finer, size_px).await;
        // It is drawn once the picture is at rest.
        let comes = async |when: &str| {
            let start = Instant::now();
            loop {
                let page = promised(&tab, "window.fabrica.viewer.picture()").await;
                let [to_coarse, to_finer] =
                    [&coarse, &finer].map(|other| difference(&page, other, WHITE));
                if to_finer.mean < 0.5 * to_coarse.mean {
                    return;
                }
                let seconds = start.elapsed().as_secs();
                assert!(
                    seconds < 120,
                    "{when}: coarse {to_coarse:?}, finer {to_finer:?}"
                );
            }
        };
        comes("at first").await;
        tab.assert_no_complaints().await;
        tab.eval::<bool>("(window.devices[0].destroy(), true)")
            .await;
        tab.wait_until("document.documentElement.dataset.losses === '1' && document.documentElement.dataset.state === 'started'", 60).await;
        tab.settled().await;
        comes("after a loss").await;

        session
            .server
            .add("drawing.svg", DRAWING.as_bytes().to_vec());
        let tab = session
            .half_viewer(&format!("#{}", payload(PLAIN)), size)
            .await;
        tab.settled().await;
        drop_files(&tab, &["drawing.svg"]).await;
        let is_figure = "JSON.parse(window.fabrica.viewer.get_document()).figure !== undefined";
        tab.wait_until(is_figure, 120).await;
        tab.settled().await;
        click(&tab, "Panel: Text").await;
        mark(&tab, "labels").await;
        click(&tab, "Label: Ulna").await;
        let labels = changed(&tab, "labels").await;
        assert_eq!(labels[0]["text"], "Ulna", "{labels}");
        tab.settled().await;
        tab.picture("figure_labelled").await;
        tab.assert_no_complaints().await;

        let value = |c: usize, x: u16, y: u16| (60 + 20 * x + 40 * y + 30 * c as u16) as u8;
        let file = jpeg([64, 40], &[1, 2, 3], (0xc0, 8), &[], value);
        session.server.add("plate.jpg", file.clone());
        let link = format!("#{}", payload(&PLATE.replace("plate.png", "plate.jpg")));
        let tab = session.half_viewer(&link, PAGE).await;
        tab.settled().await;
        let page = promised(&tab, "window.fabrica.viewer.picture()").await;
        let ReadPlate { plate, .. } = read_plate(&file).expect("a JPEG");
        let shown = illustration(&PLATE.replace("plate.png", "plate.jpg"));
        let size_px = page.dimensions().into();
        assert_alike(&page, &native(&shown, plate, size_px).await, "jpeg");
        tab.assert_no_complaints().await;
    });
}
