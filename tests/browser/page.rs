//! The page itself: its first picture, links, its window's size, history, refusal and loss of the GPU.

use super::*;

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
        tab.settled().await;
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
        // What the toolkit would ask at each pixel is decided in the text: a software GPU works out all answers.
        let of_panels: String = tab.eval("window.shaders.egui").await;
        let asks = |name: &str| of_panels.contains(&format!("if r_locals.{name}"));
        assert!(
            of_panels.contains("if true") && of_panels.contains("if false"),
            "{of_panels}"
        );
        assert!(!asks("predictable_texture_filtering") && !asks("dithering"));
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
        let tab = session.half_viewer(&format!("#{first}"), PAGE).await;
        tab.settled().await;
        let closed = object_part(&tab.picture("peel_before").await);
        assert!(drawn_pixels(&closed) > 10_000, "something is drawn");
        // Select it in the list, then take its handle where the head's geometry says that it is.
        tab.click(f64::from(PAGE.0) - 210.0, 150.0).await;
        tab.picture("peel_selected").await;
        let document = Document::from_json(PEEL).expect("a good document");
        let template = &document.illustration().templates[0];
        let handle = fabrica::placed::handle(template).expect("a peel has a handle");
        // Where the picture lies with the bar of tools over it.
        let place = super::hand::find(&tab, "Picture").await;
        let size = [place.size.0 as u32, place.size.1 as u32];
        let view = View::new(&document.illustration().camera, size);
        let pixel_of = |pos| {
            let pixel = view
                .pixel_from_subject(pos)
                .expect("in front of the camera");
            (
                place.at.0 + f64::from(pixel.x),
                place.at.1 + f64::from(pixel.y),
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
        tab.key("Escape").await;
        // Off the handle, which tells its name under the pointer.
        tab.click(f64::from(PAGE.0) - 74.0, 300.0).await;
        tab.settled().await;
        // Before the link is copied: the message of that lies over the picture for some seconds.
        let dragged = object_part(&tab.picture("peel_dragged_rest").await);
        // The reader's way: the button.
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
        let other = session.half_viewer_at(&copied, PAGE).await;
        other.settled().await;
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

/// A built-in subject that is a mesh is made by the part that holds the readers of meshes, and drawn with its colours.
#[test]
fn the_apple_is_made_in_the_page() {
    with_browser(BrowserGpu::Software, |session| async move {
        let link = payload(r#"{"fabrica":1,"subject":{"builtin":"apple"}}"#);
        let tab = session.coarse_viewer(&format!("#{link}"), PAGE).await;
        let is_apple = |page: &image::RgbaImage| {
            let red = |p: &&image::Rgba<u8>| p.0[0] > 80 && p.0[0] / 2 > p.0[1].max(p.0[2]);
            object_part(page).pixels().filter(red).count() > 4_000
        };
        tab.drawn("apple", is_apple).await;
        tab.assert_no_complaints().await;
    });
}

/// The window changes its size: the picture follows, and nothing is blank.
#[test]
fn resize_keeps_the_picture() {
    with_browser(BrowserGpu::Software, |session| async move {
        // From afar: fewer pixels of the head for the software GPU, in canvases of the same sizes.
        let link = payload(r#"{"fabrica":1,"camera":{"distance":4}}"#);
        let tab = session.viewer_sized(&format!("#{link}"), (700, 480)).await;
        let is_head = |page: &image::RgbaImage| drawn_pixels(page) > 15_000;
        tab.drawn("resize_before", is_head).await;
        for (width, height) in [(420, 600), (900, 560)] {
            tab.resize(width, height).await;
            tab.frames(3).await;
            let picture = tab.drawn(&format!("resize_{width}"), is_head).await;
            assert_eq!(
                picture.dimensions(),
                (width, height),
                "the page has its new size"
            );
        }
        tab.settled().await;
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
            .coarse_viewer(&format!("#{}", titled("one")), (420, 360))
            .await;
        tab.wait_until(&is("one"), 30).await;
        tab.eval::<bool>(&format!("(location.hash = '{}', true)", titled("two")))
            .await;
        tab.wait_until(&is("two"), 30).await;
        tab.eval::<bool>("(history.back(), true)").await;
        tab.wait_until(&is("one"), 30).await;
        tab.eval::<bool>("(history.forward(), true)").await;
        tab.wait_until(&is("two"), 30).await;
        let plain = session.coarse_viewer("", (420, 360)).await;
        plain.wait_until(&is("two"), 30).await;
        let given = session
            .coarse_viewer(&format!("?s={}", titled("three")), (420, 360))
            .await;
        given.wait_until(&is("three"), 30).await;
        session.server.add(
            "lesson.json",
            br#"{"fabrica":1,"title":"four","subject":{"builtin":"bar"}}"#.to_vec(),
        );
        let from_file = session
            .coarse_viewer("?doc=lesson.json#top", (420, 360))
            .await;
        from_file.wait_until(&is("four"), 30).await;
        let called = "document.title === 'four \u{2013} Fabrica'";
        from_file.wait_until(called, 30).await;
        from_file.assert_no_complaints().await;
    });
}

/// A document that is not at its address is told as that, in a viewer that works.
#[test]
fn missing_document_is_told_in_a_working_viewer() {
    with_browser(BrowserGpu::Software, |session| async move {
        let tab = session.coarse_viewer("?doc=missing.json", PAGE).await;
        let said =
            "document.getElementById('said').textContent.includes('no document at this address')";
        tab.wait_until(said, 30).await;
        let title: String = tab.eval("document.title").await;
        assert_eq!(title, "Fabrica");
        let address: String = tab.eval("location.search").await;
        assert_eq!(address, "?doc=missing.json");
        let is_covered: bool = tab.eval("!document.getElementById('cover').hidden").await;
        assert!(!is_covered, "the viewer is seen");
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
            let tab = session.coarse_viewer(&format!("#{bad}"), PAGE).await;
            let before: String = tab.eval("location.hash").await;
            // The viewer draws the head.
            let is_head = |page: &image::RgbaImage| drawn_pixels(&object_part(page)) > 5000;
            tab.drawn(&format!("hostile_{name}"), is_head).await;
            // After 0.35 s of rest the address is renewed, if it is.
            hand::pause(700).await;
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
            .coarse_viewer(&format!("#{}", payload(PEEL)), PAGE)
            .await;
        tab.settled().await;
        let before = object_part(&tab.picture("lost_before").await);
        tab.eval::<bool>("(window.devices[0].destroy(), true)")
            .await;
        tab.wait_until("document.documentElement.dataset.losses === '1' && document.documentElement.dataset.state === 'started'", 60).await;
        tab.settled().await;
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

/// The page with `?bench` measures the rows of `fabrica bench` and shows them as a table; scripts get the same report.
#[test]
fn bench_page_ends_in_a_table() {
    with_browser(BrowserGpu::Software, |session| async move {
        // Each row is a program, which takes a software GPU the longest: the first three show how all of them go.
        let rows = if is_long() { 30 } else { 3 };
        let address = format!("?bench=1&size=48&voxels=64&rows={rows}");
        let tab = session.open(&address).await;
        tab.wait_until("document.documentElement.dataset.state === 'measured'", 300)
            .await;
        let report: serde_json::Value = tab.eval("window.fabrica.report").await;
        println!("{report:#}");
        let frames = report["frames"].as_array().expect("a list of rows");
        let names: Vec<&str> = frames
            .iter()
            .filter_map(|row| row["name"].as_str())
            .collect();
        assert_eq!(names.len(), rows, "{names:?}");
        assert_eq!(
            (names[0], frames[0]["ratio"].as_f64()),
            ("undeformed", Some(1.0))
        );
        assert!(
            frames.iter().all(|row| row["ms"].as_f64() > Some(0.0)),
            "{report}"
        );
        let table: Vec<String> = tab
            .eval("[...document.querySelectorAll('#remedies tr')].map((row) => row.textContent)")
            .await;
        assert_eq!(table.len(), 1 + names.len(), "{table:?}");
        for (name, line) in names.iter().zip(&table[1..]) {
            assert!(line.starts_with(name), "{line}");
        }
        let buttons: Vec<String> = tab
            .eval("[...document.querySelectorAll('#remedies button')].map((button) => button.textContent)")
            .await;
        assert_eq!(buttons, ["Copy"]);
        tab.picture("bench").await;
        tab.assert_no_complaints().await;
    });
}
