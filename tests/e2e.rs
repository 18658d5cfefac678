//! What only a real browser has: the first picture from a link, resize, history, files dropped, refusal and loss of the GPU.
//!
//! `cargo xtask test` builds the page and sets up Chromium and Xvfb first. Pictures are left in target/e2e.
#![cfg(feature = "app")]

#[path = "e2e/author.rs"]
mod author;
#[path = "e2e/compare.rs"]
mod compare;
#[path = "e2e/hand.rs"]
mod hand;
#[path = "e2e/harness.rs"]
mod harness;
#[path = "e2e/making.rs"]
mod making;
#[path = "e2e/slices.rs"]
mod slices;
#[path = "e2e/tissue.rs"]
mod tissue;

use compare::{difference, drawn_pixels, object_part};
use fabrica::document::{Document, TemplateKind};
use fabrica::link;
use fabrica::render::{Gpu, GpuOptions, Studio, View};
use hand::drop_files;
use harness::{Gpu as BrowserGpu, Tab, from_base64, test_data, with_browser};
use std::time::Duration;

/// Size of the page in these tests, CSS pixels: wide enough for the panels, small enough for a software GPU.
const PAGE: (u32, u32) = (780, 420);
/// The picture's place in it: beside the panels, under the bar.
const PICTURE: (f64, f64, f64, f64) = (218.0, 46.0, 258.0, 374.0);

const WHITE: [u8; 3] = [255; 3];
const AT_REST: &str = "window.fabrica.viewer.is_at_rest()";

/// A peel on the side of the head.
const PEEL: &str = r#"{"fabrica":1,"title":"Scalp","templates":[{"kind":"peel","at":[0,0.1,0.3],"size":[0.5,0.4,0.2],"params":{"progress":0.2}}]}"#;

fn payload(json: &str) -> String {
    link::encode(&Document::from_json(json).expect("a good document"))
}

async fn rest(tab: &Tab) {
    // A frame has to see the new document before it can be at rest with it.
    tokio::time::sleep(Duration::from_millis(700)).await;
    tab.wait_until(AT_REST, 240).await;
    tokio::time::sleep(Duration::from_millis(500)).await;
    tab.wait_until(AT_REST, 60).await;
}

/// A plain address shows the head, asks only its own server, and breaks no content policy.
#[test]
fn plain_address_shows_the_head() {
    with_browser(BrowserGpu::Software, |session| async move {
        let start = std::time::Instant::now();
        let tab = session.viewer_sized("", PAGE).await;
        println!(
            "viewer started after {:.1} s",
            start.elapsed().as_secs_f32()
        );
        rest(&tab).await;
        println!(
            "picture complete after {:.1} s",
            start.elapsed().as_secs_f32()
        );
        let picture = object_part(&tab.picture("plain").await);
        let drawn = drawn_pixels(&picture);
        assert!(
            drawn * 4 > picture.pixels().len(),
            "the head fills the picture: {drawn} pixels"
        );
        tab.assert_no_complaints().await;
        let fetched: Vec<String> = tab
            .eval("performance.getEntriesByType('resource').map(e => e.name).filter(n => !n.startsWith(location.origin) && !n.startsWith('blob:'))")
            .await;
        assert!(fetched.is_empty(), "asked elsewhere: {fetched:?}");
        let asked = session.server.asked();
        println!("asked for: {asked:?}");
    });
}

/// Open a link with a peel, drag its handle, copy the link, open it elsewhere: the same picture.
#[test]
fn peel_is_dragged_and_its_link_opens_to_the_same_picture() {
    with_browser(BrowserGpu::Software, |session| async move {
        session.allow_clipboard().await;
        let first = payload(PEEL);
        let tab = session.viewer_sized(&format!("#{first}"), PAGE).await;
        rest(&tab).await;
        let closed = object_part(&tab.picture("peel_before").await);
        assert!(drawn_pixels(&closed) > 10_000, "something is drawn");
        // Select it in the list, then take its handle where the head's geometry says that it is.
        tab.click(f64::from(PAGE.0) - 210.0, 150.0).await;
        tokio::time::sleep(Duration::from_millis(800)).await;
        tab.picture("peel_selected").await;
        let document = Document::from_json(PEEL).expect("a good document");
        let template = &document.illustration().templates[0];
        let handle = fabrica::displace::handle(template).expect("a peel has a handle");
        let size = [PICTURE.2 as u32, PICTURE.3 as u32];
        let view = View::new(&document.illustration().camera, size);
        let pixel_of = |pos| {
            let pixel = view
                .pixel_from_subject(pos)
                .expect("in front of the camera");
            (
                PICTURE.0 + f64::from(pixel.x),
                PICTURE.1 + f64::from(pixel.y),
            )
        };
        let from = pixel_of(handle.at);
        let along = handle.along.expect("a peel's handle goes one way");
        let to = pixel_of(handle.at + along * 0.15);
        println!("the handle is dragged from {from:?} to {to:?}");
        tab.drag(from, to, 8).await;
        tab.wait_until(&format!("location.hash !== '#{first}'"), 60)
            .await;
        tab.picture("peel_dragged").await;
        let progress: f64 = tab
            .eval("JSON.parse(window.fabrica.viewer.get_document()).templates[0].params?.progress ?? 0.5")
            .await;
        assert!(
            (progress - 0.2).abs() > 0.1,
            "the drag changed the peel: {progress}"
        );
        let hash: String = tab.eval("location.hash").await;
        assert_ne!(hash, format!("#{first}"), "the address follows");
        // The reader's way: the button.
        tab.key("Escape").await;
        tab.click(f64::from(PAGE.0) - 74.0, 23.0).await;
        let copied = "navigator.clipboard.readText().catch(error => String(error))";
        tab.wait_until(
            &format!("{copied}.then(text => text.startsWith(location.origin))"),
            30,
        )
        .await;
        let copied: String = tab.eval(copied).await;
        assert!(
            copied.starts_with(&session.server.address()),
            "a link was copied: {copied}"
        );
        rest(&tab).await;
        let dragged = object_part(&tab.picture("peel_dragged_rest").await);
        let other = session.viewer_at(&copied, PAGE).await;
        rest(&other).await;
        let opened = object_part(&other.picture("peel_opened").await);
        let same = difference(&dragged, &opened, WHITE);
        println!("dragged and opened: {same:?}");
        assert!(
            same.mean <= 1.0 && same.percentile <= 8,
            "the same picture: {same:?}"
        );
        let moved = difference(&closed, &opened, WHITE);
        assert!(moved.mean > 2.0, "the drag is seen: {moved:?}");
        other.assert_no_complaints().await;
    });
}

/// The same document drawn by the page and by the native program under lavapipe.
#[test]
fn browser_draws_what_the_native_program_draws() {
    const SIZE: [u32; 2] = [160, 120];
    const RESOLUTION: u32 = 64;
    const SAMPLES: u32 = 4;
    let mut documents: Vec<(String, String)> = TemplateKind::FORMULAS
        .iter()
        .map(|kind| {
            let name = kind.spec().name;
            let text = format!(
                r#"{{"fabrica":1,"subject":{{"builtin":"cube"}},"templates":[{{"kind":"{name}","at":[0,0.1,0.1],"size":[0.8,0.7,0.9]}}],"camera":{{"rotate":[0.3,0.2,0.1,0.92]}}}}"#
            );
            (name.to_owned(), text)
        })
        .collect();
    let four = r#"{"fabrica":1,"subject":{"builtin":"head"},"templates":[{"kind":"twist","size":[1,1,1],"params":{"angle":0.4}},{"kind":"peel","at":[0,0.1,0.3],"size":[0.5,0.4,0.2]},{"kind":"retractor","at":[0.1,0.2,0],"rotate":[-0.7,0,0,0.7],"size":[0.4,0.4,0.3]},{"kind":"slices","size":[0.9,0.9,0.9],"params":{"count":3}}]}"#;
    documents.push(("four".to_owned(), four.to_owned()));
    with_browser(BrowserGpu::Software, |session| async move {
        let tab = session.open("#").await;
        tab.wait_until("window.fabrica?.viewer !== undefined", 120)
            .await;
        tab.eval::<bool>("(window.fabrica.viewer.destroy(), true)")
            .await;
        let gpu = Gpu::open(&GpuOptions {
            adapter: None,
            is_strict: true,
        })
        .await
        .expect("a Vulkan device, lavapipe is enough");
        println!("native: {} {}", gpu.info.name, gpu.info.driver_info);
        let folder = harness::root().join("target/e2e/compared");
        std::fs::create_dir_all(&folder).expect("a folder for pictures");
        let (mut worst, mut faults) = ((0.0, 0), Vec::new());
        let mut first_picture = None;
        let mut studio = None;
        for (name, text) in &documents {
            let quoted = serde_json::to_string(text).expect("text");
            let script = format!(
                "window.fabrica.module.render_png({quoted},{},{},{SAMPLES},{RESOLUTION}).then(b => btoa(Array.from(b, c => String.fromCharCode(c)).join('')))",
                SIZE[0], SIZE[1]
            );
            let page = image::load_from_memory(&from_base64(&tab.eval::<String>(&script).await))
                .expect("a PNG")
                .to_rgba8();
            let document = Document::from_json(text).expect("a good document");
            let subject = if name == "four" { "head" } else { "cube" };
            if studio.as_ref().is_none_or(|(held, _)| *held != subject) {
                let mut builder = fabrica::data::VolumeBuilder::new();
                fabrica::subjects::generate(subject, RESOLUTION, &mut builder).expect("a subject");
                let volume = builder.finish().expect("a whole volume");
                let made = Studio::new(&gpu, &volume, true).expect("the subject fits");
                studio = Some((subject, made));
            }
            let (_, held) = studio.as_ref().expect("just made");
            let image = held
                .render_image(document.illustration(), SIZE, SAMPLES)
                .await
                .expect("a native picture");
            let native = image::RgbaImage::from_raw(SIZE[0], SIZE[1], image.rgba).expect("whole");
            for (side, picture) in [("page", &page), ("native", &native)] {
                picture
                    .save(folder.join(format!("{name}_{side}.png")))
                    .expect("saved");
            }
            let found = difference(&page, &native, WHITE);
            println!("{name}: {found:?}");
            if found.count < 1500 {
                faults.push(format!("{name}: only {} pixels are drawn", found.count));
            }
            if found.mean > 2.0 || found.percentile > 8 {
                faults.push(format!("{name}: {found:?}"));
            }
            worst = (
                f64::max(worst.0, found.mean),
                u8::max(worst.1, found.percentile),
            );
            // The negative control: another template is another picture.
            if let Some(other) = &first_picture {
                let apart = difference(other, &native, WHITE);
                if apart.mean <= 2.0 && apart.percentile <= 8 {
                    faults.push(format!(
                        "{name} looks like {}: the test sees nothing",
                        documents[0].0
                    ));
                }
            } else {
                first_picture = Some(native);
            }
        }
        println!(
            "worst mean {:.3}, worst 99.9th percentile {}",
            worst.0, worst.1
        );
        assert!(faults.is_empty(), "{}", faults.join("\n"));
    });
}

/// A real scan dropped on the page is drawn; reloaded, the page says which file it wants.
#[test]
fn dropped_scan_is_drawn() {
    let Some(data) = test_data() else {
        println!("did not run: FABRICA_TEST_DATA names no folder of scans");
        return;
    };
    with_browser(BrowserGpu::Software, |session| async move {
        for name in ["head_ct_headsq.nii.gz", "chest_ct_2mm.nii.gz"] {
            let scan = std::fs::read(data.join("ct").join(name)).expect("a scan");
            session.server.add(name, scan);
            let tab = session.viewer_sized("#", PAGE).await;
            tab.wait_until("window.fabrica.viewer.get_document() !== ''", 60)
                .await;
            let before = object_part(&tab.picture(&format!("{name}_before")).await);
            drop_files(&tab, &[name]).await;
            tab.wait_until(
                "JSON.parse(window.fabrica.viewer.get_document()).subject?.sha256 !== undefined",
                180,
            )
            .await;
            rest(&tab).await;
            let after = object_part(&tab.picture(name).await);
            assert!(drawn_pixels(&after) > 5000, "the scan is drawn");
            assert!(
                difference(&before, &after, WHITE).mean > 3.0,
                "it is not the head of before"
            );
            let hash: String = tab.eval("location.hash").await;
            assert!(!hash.contains(name), "the file's name is not in the link");
            tab.assert_no_complaints().await;
            tab.page.close().await.expect("the tab closes");
        }
    });
}

/// The window changes its size: the picture follows, and nothing is blank.
#[test]
fn resize_keeps_the_picture() {
    with_browser(BrowserGpu::Software, |session| async move {
        let tab = session.viewer_sized("", (700, 480)).await;
        rest(&tab).await;
        for (width, height) in [(420, 600), (900, 560)] {
            tab.resize(width, height).await;
            rest(&tab).await;
            let picture = tab.picture(&format!("resize_{width}")).await;
            assert_eq!(
                picture.dimensions(),
                (width, height),
                "the page has its new size"
            );
            assert!(
                drawn_pixels(&picture) > 15_000,
                "the head is drawn at {width} × {height}"
            );
        }
        tab.assert_no_complaints().await;
    });
}

/// Back and forward restore documents; what was last shown is kept over a reload; a payload goes before what was kept.
#[test]
fn history_and_reload_restore_documents() {
    with_browser(BrowserGpu::Software, |session| async move {
        let titled = |title: &str| {
            payload(&format!(
                r#"{{"fabrica":1,"title":"{title}","subject":{{"builtin":"cube"}}}}"#
            ))
        };
        let title = "JSON.parse(window.fabrica.viewer.get_document()).title ?? ''";
        let is = |wanted: &str| format!("({title}) === '{wanted}'");
        let tab = session
            .viewer_sized(&format!("#{}", titled("one")), (420, 360))
            .await;
        tab.wait_until(&is("one"), 30).await;
        tab.eval::<bool>(&format!("(location.hash = '{}', true)", titled("two")))
            .await;
        tab.wait_until(&is("two"), 30).await;
        tab.eval::<bool>("(history.back(), true)").await;
        tab.wait_until(&is("one"), 30).await;
        tab.eval::<bool>("(history.forward(), true)").await;
        tab.wait_until(&is("two"), 30).await;
        let plain = session.viewer_sized("", (420, 360)).await;
        plain.wait_until(&is("two"), 30).await;
        let given = session
            .viewer_sized(&format!("?s={}", titled("three")), (420, 360))
            .await;
        given.wait_until(&is("three"), 30).await;
        session.server.add(
            "lesson.json",
            br#"{"fabrica":1,"title":"four","subject":{"builtin":"bar"}}"#.to_vec(),
        );
        let from_file = session.viewer_sized("?doc=lesson.json", (420, 360)).await;
        from_file.wait_until(&is("four"), 30).await;
        from_file.assert_no_complaints().await;
    });
}

/// A document from another host waits for a tap on a message that names the host.
#[test]
fn foreign_document_waits_for_a_tap() {
    with_browser(BrowserGpu::Software, |session| async move {
        let other = session.other_server();
        other.add(
            "lesson.json",
            br#"{"fabrica":1,"title":"far","subject":{"builtin":"cube"}}"#.to_vec(),
        );
        let tab = session
            .open(&format!("?doc={}/lesson.json", other.address()))
            .await;
        tab.wait_until("document.getElementById('agree') !== null", 60)
            .await;
        let text = tab.text().await;
        let host = other.address().replace("http://", "");
        assert!(text.contains(&host), "the host is named: {text}");
        assert!(
            other.asked().is_empty(),
            "nothing was fetched before the tap"
        );
        tab.eval::<bool>("(document.getElementById('agree').click(), true)")
            .await;
        tab.wait_for_state("started").await;
        tab.wait_until(
            "JSON.parse(window.fabrica.viewer.get_document()).title === 'far'",
            30,
        )
        .await;
    });
}

/// A hostile link leaves a working viewer and stays in the address.
#[test]
fn hostile_link_leaves_a_working_viewer() {
    with_browser(BrowserGpu::Software, |session| async move {
        let good = payload(PEEL);
        let cut_off = &good[..good.len() / 2];
        for (name, bad, message) in [
            (
                "garbage",
                "1%00<script>alert(1)</script>",
                "cut off: 1 of 7",
            ),
            ("cut_off", cut_off, "cut off"),
            ("foreign", "Section-3", "not a Fabrica link"),
            // What a page's own router keeps there is no link at all.
            ("route", "/route/to?page", ""),
        ] {
            let tab = session.viewer_sized(&format!("#{bad}"), PAGE).await;
            let before: String = tab.eval("location.hash").await;
            rest(&tab).await;
            let picture = tab.picture(&format!("hostile_{name}")).await;
            assert!(
                drawn_pixels(&object_part(&picture)) > 5000,
                "{name}: the viewer draws the head"
            );
            let said: String = tab
                .eval("document.getElementById('said').textContent")
                .await;
            println!("{name}: {said}");
            assert!(said.contains(message), "{name}: {said}");
            let after: String = tab.eval("location.hash").await;
            assert_eq!(before, after, "{name}: the link stays in the address");
            assert!(
                !tab.eval::<bool>("window.fabrica.viewer.has_panicked()")
                    .await,
                "{name}: no fault"
            );
            tab.assert_no_complaints().await;
            tab.page.close().await.expect("the tab closes");
        }
    });
}

/// The graphics device is lost: the viewer comes back with the same picture.
#[test]
fn lost_device_comes_back() {
    with_browser(BrowserGpu::Software, |session| async move {
        let tab = session
            .viewer_sized(&format!("#{}", payload(PEEL)), PAGE)
            .await;
        rest(&tab).await;
        let before = object_part(&tab.picture("lost_before").await);
        tab.eval::<bool>("(window.devices[0].destroy(), true)")
            .await;
        tab.wait_until("document.documentElement.dataset.losses === '1' && document.documentElement.dataset.state === 'started'", 60).await;
        rest(&tab).await;
        let after = object_part(&tab.picture("lost_after").await);
        let same = difference(&before, &after, WHITE);
        println!("before and after the loss: {same:?}");
        assert!(same.mean <= 1.0, "the same picture: {same:?}");
    });
}

/// Without WebGPU the page says so, says what to do, keeps the link, and gives the document's words.
#[test]
fn page_without_webgpu_names_remedies() {
    with_browser(BrowserGpu::None, |session| async move {
        let link = payload(PEEL);
        let tab = session.open(&format!("#{link}")).await;
        tab.wait_until("document.documentElement.dataset.state === 'no-webgpu'", 60)
            .await;
        let text = tab.text().await;
        assert!(text.contains("WebGPU"), "names the cause: {text}");
        assert!(
            text.contains("graphics acceleration"),
            "names a remedy: {text}"
        );
        assert!(text.contains("Scalp"), "gives the document's title: {text}");
        let address: String = tab.eval("location.href").await;
        assert!(address.ends_with(&link), "the link is kept: {address}");
        tab.assert_no_complaints().await;
    });
}

const LESSON: &str = r#"{"fabrica":1,"title":"Opening a cube","subject":{"builtin":"cube"},"templates":[{"kind":"split","size":[1.2,1.2,1.2],"params":{"amount":0}}],"steps":[{"title":"Apart","caption":"The halves part.","set":{"/templates/0/params/amount":0.3}}]}"#;

fn embedding_page(attributes: &str) -> Vec<u8> {
    let link = payload(LESSON);
    format!(
        "<!doctype html><meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; connect-src 'self'; worker-src 'self'; style-src 'self'; img-src 'self' data:\"><script type=module src=fabrica-viewer.js></script><fabrica-viewer id=it src=\"#{link}\" {attributes}></fabrica-viewer>"
    )
    .into_bytes()
}

/// The element draws in somebody else's page under a strict policy, walks the steps, and gives its picture.
#[test]
fn embedded_viewer_walks_its_steps() {
    with_browser(BrowserGpu::Software, |session| async move {
        session
            .server
            .add("lesson.html", embedding_page("controls"));
        let tab = session.open("lesson.html").await;
        tab.resize(480, 400).await;
        let root = "document.getElementById('it')";
        tab.wait_until(
            &format!("{root}.shadowRoot?.querySelector('.words').hidden === true"),
            120,
        )
        .await;
        tab.eval::<bool>(&format!("(window.changes = 0, {root}.addEventListener('stepchange', () => window.changes++), true)")).await;
        let picture = format!("{root}.toDataURL()");
        tokio::time::sleep(Duration::from_secs(8)).await;
        let before: String = tab.eval(&picture).await;
        tab.picture("embed_before").await;
        tab.eval::<bool>(&format!("({root}.next(), {root}.next(), true)"))
            .await;
        assert_eq!(
            tab.eval::<u32>(&format!("{root}.step")).await,
            1,
            "the last step is the end"
        );
        assert_eq!(
            tab.eval::<u32>("window.changes").await,
            1,
            "one change was told"
        );
        assert_eq!(
            tab.eval::<String>(&format!("{root}.steps[0].title")).await,
            "Apart",
            "the steps are there"
        );
        tokio::time::sleep(Duration::from_secs(8)).await;
        tab.picture("embed_after").await;
        let after: String = tab.eval(&picture).await;
        let decode = |url: &str| {
            let data = url.strip_prefix("data:image/png;base64,").expect("a PNG");
            image::load_from_memory(&from_base64(data))
                .expect("a PNG")
                .to_rgba8()
        };
        let (before, after) = (decode(&before), decode(&after));
        assert!(drawn_pixels(&before) > 1000, "the picture is no blank");
        if before.dimensions() == after.dimensions() {
            assert!(
                difference(&before, &after, WHITE).mean > 1.0,
                "the step is seen"
            );
        }
        // What the step sets, set by the page itself, is the same picture.
        let set = |pointer: &str, value: &str| {
            format!(
                "(() => {{ try {{ {root}.setParam('{pointer}', {value}); return ''; }} catch (e) {{ return String(e); }} }})()"
            )
        };
        tab.eval::<bool>(&format!("({root}.previous(), true)"))
            .await;
        let refused: String = tab.eval(&set("/templates/0/params/amount", "'wide'")).await;
        assert!(
            refused.contains("/templates/0/params/amount"),
            "a wrong type is refused: {refused}"
        );
        let accepted: String = tab.eval(&set("/templates/0/params/amount", "0.3")).await;
        assert_eq!(accepted, "", "a value is taken");
        tokio::time::sleep(Duration::from_secs(8)).await;
        let by_page: String = tab.eval(&picture).await;
        let by_page = decode(&by_page);
        assert_eq!(by_page.dimensions(), after.dimensions());
        let apart = difference(&by_page, &after, WHITE).mean;
        assert!(
            apart < 0.5,
            "the page's own value draws what the step draws: {apart}"
        );
        tab.assert_no_complaints().await;
        let kept: u32 = tab.eval("localStorage.length").await;
        assert_eq!(kept, 0, "an embedded viewer keeps nothing");
    });
}

/// Where there is no WebGPU the element gives title and steps as text.
#[test]
fn embedded_viewer_without_webgpu_gives_words() {
    with_browser(BrowserGpu::None, |session| async move {
        session
            .server
            .add("lesson.html", embedding_page("poster=\"icon.svg\""));
        let tab = session.open("lesson.html").await;
        let words =
            "document.getElementById('it').shadowRoot?.querySelector('.words').textContent ?? ''";
        tab.wait_until(&format!("({words}).includes('WebGPU')"), 60)
            .await;
        let text: String = tab.eval(words).await;
        assert!(
            text.contains("Opening a cube") && text.contains("1. Apart"),
            "title and steps: {text}"
        );
        let poster: bool = tab
            .eval("!document.getElementById('it').shadowRoot.querySelector('.poster').hidden")
            .await;
        assert!(poster, "the poster is shown");

        // A lazy one far down the page fetches nothing before it comes near.
        let mut page = b"<div style=\"height: 4000px\"></div>".to_vec();
        page.extend(embedding_page("loading=\"lazy\""));
        session.server.add("long.html", page);
        let tab = session.open("long.html").await;
        tokio::time::sleep(Duration::from_secs(2)).await;
        let fetched =
            "performance.getEntriesByType('resource').filter(e => e.name.endsWith('.wasm')).length";
        assert_eq!(tab.eval::<u32>(fetched).await, 0, "nothing is fetched yet");
        tab.eval::<bool>("(document.getElementById('it').scrollIntoView(), true)")
            .await;
        tab.wait_until(&format!("({words}).includes('WebGPU')"), 60)
            .await;
    });
}

/// A 512³ volume of 16-bit voxels loads and draws; the page's heap stays under 1.6 times its bytes over the idle program.
#[test]
fn large_volume_stays_within_its_memory() {
    const SIDE: usize = 512;
    with_browser(BrowserGpu::Software, |session| async move {
        let tab = session.viewer_sized("#", (420, 360)).await;
        rest(&tab).await;
        let heap = "window.fabrica.memory.buffer.byteLength";
        let idle: f64 = tab.eval(heap).await;
        session.server.add("large.nii", large_nifti(SIDE));
        let document = r#"{"fabrica":1,"subject":{"src":"large.nii"}}"#;
        tab.eval::<bool>(&format!(
            "(window.fabrica.viewer.set_link('{document}'), true)"
        ))
        .await;
        tokio::time::sleep(Duration::from_secs(3)).await;
        rest(&tab).await;
        let picture = tab.picture("large").await;
        assert!(drawn_pixels(&picture) > 5000, "it is drawn");
        let loaded: f64 = tab.eval(heap).await;
        let bytes = (SIDE * SIDE * SIDE * 2) as f64;
        let ratio = (loaded - idle) / bytes;
        println!(
            "512³: page heap {:.0} MB idle, {:.0} MB loaded: {ratio:.2} times the volume's {:.0} MB over idle",
            idle / 1e6,
            loaded / 1e6,
            bytes / 1e6
        );
        assert!(
            ratio < 1.6,
            "the heap grew by {ratio:.2} times the volume's bytes"
        );
        tab.assert_no_complaints().await;
    });
}

/// A ball with a core, as NIfTI-1.
fn large_nifti(side: usize) -> Vec<u8> {
    let mut file = vec![0u8; 352];
    file[..4].copy_from_slice(&348i32.to_le_bytes());
    for (i, n) in [3, side as i16, side as i16, side as i16]
        .iter()
        .enumerate()
    {
        file[40 + 2 * i..42 + 2 * i].copy_from_slice(&n.to_le_bytes());
    }
    file[70..72].copy_from_slice(&4i16.to_le_bytes());
    file[72..74].copy_from_slice(&16i16.to_le_bytes());
    for i in 0..4 {
        file[76 + 4 * i..80 + 4 * i].copy_from_slice(&1f32.to_le_bytes());
    }
    file[108..112].copy_from_slice(&352f32.to_le_bytes());
    file[344..348].copy_from_slice(b"n+1\0");
    file.reserve(side * side * side * 2);
    let middle = side as i32 / 2;
    let squares: Vec<i32> = (0..side as i32)
        .map(|i| (i - middle) * (i - middle))
        .collect();
    for z in &squares {
        for y in &squares {
            for x in &squares {
                let r2 = x + y + z;
                let value: i16 = if r2 < (middle / 3).pow(2) {
                    900
                } else if r2 < (middle * 4 / 5).pow(2) {
                    60
                } else {
                    -1000
                };
                file.extend_from_slice(&value.to_le_bytes());
            }
        }
    }
    file
}
