//! A plate in the page from its file to the link of a bent figure: as the native program draws it, by keys alone, by
//! fingers alone; and what is kept of it here.

use super::embed::{self, picture_of, ready, serve_where};
use super::figures::{count_of, illustration, native, plate_png, spot};
use super::hand::{
    CTRL, SHIFT, Touch, changed, choose_file, choose_files, click, clipboard, document, find,
    focus, kept, mark, press, press_with, tab_back_to, tab_to,
};
use super::harness::{Session, Tab, root};
use super::native::promised;
use super::*;
use fabrica::figure::{Original, ReadPlate, builtin_plate, read_plate};
use image::RgbaImage;
use std::path::PathBuf;
use std::time::Instant;

const PICTURE: &str = "window.fabrica.viewer.picture()";
const IS_FIGURE: &str =
    "JSON.parse(window.fabrica.viewer.get_document() || '{}').figure !== undefined";

/// Share of the pixels of two pictures in which a channel differs by more than 1 of 255.
fn share_apart(name: &str, one: &RgbaImage, other: &RgbaImage) -> f64 {
    assert_eq!(one.dimensions(), other.dimensions(), "pictures of one size");
    let is_apart = |(p, q): &(&image::Rgba<u8>, &image::Rgba<u8>)| {
        p.0.iter().zip(q.0).any(|(p, q)| p.abs_diff(q) > 1)
    };
    let apart = one.pixels().zip(other.pixels()).filter(is_apart).count();
    let all = one.pixels().len();
    println!("{name}: {apart} of {all} pixels differ by more than 1 of 255");
    let folder = root().join("target/e2e/compared");
    std::fs::create_dir_all(&folder).expect("a folder for pictures");
    for (side, picture) in [("one", one), ("other", other)] {
        let path = folder.join(format!("plate_{name}_{side}.png"));
        picture.save(path).expect("saved");
    }
    apart as f64 / all as f64
}

/// At its full size the page's picture is that of the native program, edges and lines included.
#[test]
fn a_full_size_figure_is_the_native_one() {
    with_browser(BrowserGpu::Software, |session| async move {
        session.server.add("plate.png", plate_png());
        let arm = r#"{"fabrica":1,"subject":{"builtin":"drawn-arm"},"camera":{"distance":1.7},"figure":{"handles":[{"region":"humerus"},{"region":"hand","move":[0.02,0.13],"turn":0.5}]}}"#;
        let plate = r#"{"fabrica":1,"subject":{"src":"plate.png"},"camera":{"distance":1.5},"figure":{"regions":[{"name":"disc","from":{"flood":{"at":[[0,0]]}},"rigidity":"rigid"}],"handles":[{"at":[-0.4,-0.2]},{"at":[0,0.05],"move":[0.03,0]},{"at":[0.3,0.2],"move":[0.05,0.1]}]}}"#;
        for (name, json) in [("arm", arm), ("plate", plate)] {
            let link = format!("#{}", payload(json));
            let tab = session.viewer_sized(&link, (900, 760)).await;
            tab.settled().await;
            let page = promised(&tab, PICTURE).await;
            let drawn = match name {
                "arm" => builtin_plate("drawn-arm").expect("it is built in"),
                _ => read_plate(&plate_png()).expect("a PNG").plate,
            };
            let size = page.dimensions().into();
            let native = native(&illustration(json), drawn, size).await;
            assert!(drawn_pixels(&native) > 20_000, "{name} is drawn");
            let share = share_apart(name, &page, &native);
            assert!(share <= 0.001, "{name}: {share}");
            tab.assert_no_complaints().await;
            tab.page.close().await.expect("the tab closes");
        }
    });
}

/// A file of the plate that can be chosen in a dialog.
fn plate_file(name: &str) -> PathBuf {
    let folder = root().join("target/e2e");
    std::fs::create_dir_all(&folder).expect("a folder");
    let file = folder.join(name);
    std::fs::write(&file, plate_png()).expect("the plate is written");
    file
}

/// What was made of the plate: a disc and stripes, three pins, the last of them moved.
async fn assert_made(tab: &Tab) -> RgbaImage {
    tab.settled().await;
    let figure = document(tab).await["figure"].clone();
    assert_eq!(count_of(&figure, "regions"), 2, "{figure}");
    assert_eq!(count_of(&figure, "handles"), 3, "{figure}");
    let by = &figure["handles"][2]["move"][1];
    assert!(by.as_f64().is_some_and(|y| y > 0.05), "{figure}");
    promised(tab, PICTURE).await
}

/// The link shows the same picture, in the page once it has the file too, and natively.
async fn assert_sent(
    session: &Session,
    name: &str,
    (tab, page): (&Tab, &RgbaImage),
    (link, other): (&str, &Tab),
) {
    // It is there once the figure has come.
    find(other, "Pin 3 in the picture").await;
    other.settled().await;
    let again = promised(other, PICTURE).await;
    assert_eq!(document(other).await, document(tab).await);
    let share = share_apart(&format!("{name}_sent"), page, &again);
    assert!(share <= 0.001, "another picture in the other tab: {share}");
    let tail = link.split('#').nth(1).expect("a link of the page");
    let sent = link::decode(tail).expect("a good link").document;
    let ReadPlate { plate, .. } = read_plate(&plate_png()).expect("a PNG");
    let size = page.dimensions().into();
    let native = native(sent.illustration(), plate, size).await;
    let share = share_apart(&format!("{name}_native"), page, &native);
    assert!(share <= 0.001, "another picture natively: {share}");
    assert!(link.starts_with(&session.server.address()), "{link}");
}

/// The file is opened, divided, pinned, bent and sent without a mouse.
#[test]
fn a_plate_is_bent_and_sent_by_keys_alone() {
    with_browser(BrowserGpu::Software, |session| async move {
        const SIZE: (u32, u32) = (900, 760);
        session.allow_clipboard().await;
        let file = plate_file("plate_for_keys.png");
        let link = format!("#{}", payload(PLAIN));
        let tab = session.coarse_viewer(&link, SIZE).await;
        focus(&tab).await;
        tab.settled().await;
        choose_files(&tab).await;
        choose_file(&tab, &file, press_with(&tab, CTRL, "o", None)).await;
        tab.wait_until(IS_FIGURE, 120).await;
        tab.settled().await;
        let enter = async || {
            mark(&tab, "figure").await;
            press(&tab, "Enter").await;
            let figure = changed(&tab, "figure").await;
            tab.settled().await;
            figure
        };
        let go = async |key: &str, times: usize| {
            for _ in 0..times {
                press(&tab, key).await;
            }
        };
        // The disc, and the stripe at the left.
        tab_to(&tab, "By colour").await;
        press(&tab, "Enter").await;
        tab_to(&tab, "Picture of").await;
        assert_eq!(count_of(&enter().await, "regions"), 1);
        go("ArrowRight", 7).await;
        go("ArrowDown", 3).await;
        let figure = enter().await;
        assert_eq!(count_of(&figure, "regions"), 2, "{figure}");
        // The first pin there, the others on the disc and at the right.
        tab_back_to(&tab, "Pin").await;
        press(&tab, "Enter").await;
        tab_to(&tab, "Picture of").await;
        assert_eq!(count_of(&enter().await, "handles"), 1);
        go("ArrowLeft", 7).await;
        go("ArrowUp", 3).await;
        assert_eq!(count_of(&enter().await, "handles"), 2);
        go("ArrowLeft", 7).await;
        go("ArrowUp", 3).await;
        assert_eq!(count_of(&enter().await, "handles"), 3);
        press(&tab, "Escape").await;
        tab_to(&tab, "Pin 3 in the picture").await;
        mark(&tab, "figure").await;
        go("ArrowUp", 10).await;
        changed(&tab, "figure").await;
        let page = assert_made(&tab).await;
        tab.picture("plate_by_keys").await;
        press_with(&tab, CTRL | SHIFT, "L", None).await;
        let link = clipboard(&tab, &session.server.address()).await;
        tab.assert_no_complaints().await;

        let other = session.coarse_viewer_at(&link, SIZE).await;
        focus(&other).await;
        choose_files(&other).await;
        choose_file(&other, &file, press_with(&other, CTRL, "o", None)).await;
        assert_sent(&session, "keys", (&tab, &page), (&link, &other)).await;
        other.assert_no_complaints().await;
    });
}

/// The same on a phone by fingers.
#[test]
fn a_plate_is_bent_and_sent_by_fingers_alone() {
    with_browser(BrowserGpu::Software, |session| async move {
        const SIZE: (u32, u32) = (390, 844);
        session.allow_clipboard().await;
        let file = plate_file("plate_for_fingers.png");
        let link = format!("#{}", payload(PLAIN));
        let tab = session.coarse_viewer(&link, SIZE).await;
        let touch = Touch::new(&tab).await;
        hand::bring_to_front(&tab).await;
        tab.settled().await;
        choose_files(&tab).await;
        touch.tap("More").await;
        choose_file(&tab, &file, touch.tap("Open a file")).await;
        tab.wait_until(IS_FIGURE, 120).await;
        tab.settled().await;
        let tap = async |x: f64, y: f64| {
            mark(&tab, "figure").await;
            touch.tap_at(spot(&tab, x, y).await).await;
            let figure = changed(&tab, "figure").await;
            tab.settled().await;
            figure
        };
        touch.tap("Add").await;
        tab.frames(10).await;
        tab.picture("plate_by_fingers_tools").await;
        touch.scroll_to("By colour").await;
        touch.tap("By colour").await;
        tab.settled().await;
        assert_eq!(count_of(&tap(0.0, 0.0).await, "regions"), 1);
        let figure = tap(-0.4, 0.2).await;
        assert_eq!(count_of(&figure, "regions"), 2, "{figure}");
        touch.tap("Add").await;
        tab.frames(10).await;
        touch.tap("Pin").await;
        tab.settled().await;
        for (i, (x, y)) in [(-0.4, -0.2), (0.0, 0.05), (0.4, 0.2)]
            .into_iter()
            .enumerate()
        {
            assert_eq!(count_of(&tap(x, y).await, "handles"), i + 1);
        }
        mark(&tab, "figure").await;
        let (x, y) = find(&tab, "Pin 3 in the picture").await.middle();
        touch.swipe(&[[(x, y), (x - 5.0, y - 60.0)]]).await;
        changed(&tab, "figure").await;
        // The card of the tool takes room from the picture.
        touch.tap("Put the tool away").await;
        let page = assert_made(&tab).await;
        tab.picture("plate_by_fingers").await;
        touch.tap("Copy link").await;
        let link = clipboard(&tab, &session.server.address()).await;
        tab.assert_no_complaints().await;

        let other = session.coarse_viewer_at(&link, SIZE).await;
        let touch = Touch::new(&other).await;
        hand::bring_to_front(&other).await;
        choose_files(&other).await;
        touch.tap("More").await;
        choose_file(&other, &file, touch.tap("Open a file")).await;
        assert_sent(&session, "fingers", (&tab, &page), (&link, &other)).await;
        other.assert_no_complaints().await;
    });
}

/// A figure is found again after a reload and among the recent documents, with the file that it asks for.
#[test]
fn a_figure_is_found_among_recent_documents() {
    with_browser(BrowserGpu::Software, |session| async move {
        session.server.add("plate.png", plate_png());
        let link = format!("#{}", payload(PLAIN));
        let tab = session.coarse_viewer(&link, (900, 760)).await;
        tab.settled().await;
        drop_files(&tab, &["plate.png"]).await;
        tab.wait_until(IS_FIGURE, 120).await;
        focus(&tab).await;
        tab.settled().await;
        click(&tab, "Pin").await;
        mark(&tab, "figure").await;
        let (x, y) = spot(&tab, 0.0, 0.05).await;
        tab.click(x, y).await;
        changed(&tab, "figure").await;
        press(&tab, "Escape").await;
        tab.settled().await;
        let made = document(&tab).await;
        kept(&tab).await;
        let page = promised(&tab, PICTURE).await;

        // The page is loaded again: everything is there but the file, which the page asks for by its name.
        let shows_it = async |name: &str| {
            drop_files(&tab, &["plate.png"]).await;
            find(&tab, "Pin 1 in the picture").await;
            tab.settled().await;
            assert_eq!(document(&tab).await, made, "{name}");
            let again = promised(&tab, PICTURE).await;
            let share = share_apart(&format!("recent_{name}"), &page, &again);
            assert!(share <= 0.001, "{name}: {share}");
        };
        tab.page.reload().await.expect("the page loads again");
        tab.wait_for_state("started").await;
        focus(&tab).await;
        tab.frames(3).await;
        assert_eq!(document(&tab).await, made, "nothing is lost");
        tab.picture("plate_reloaded").await;
        shows_it("reloaded").await;

        // Another document takes its place, and it is opened from the list.
        click(&tab, "More").await;
        click(&tab, "Examples").await;
        click(&tab, "Subject of the examples").await;
        click(&tab, "Cube").await;
        click(&tab, "Open the example Ten ways to open a block").await;
        tab.wait_until(
            "JSON.parse(window.fabrica.viewer.get_document()).figure === undefined",
            60,
        )
        .await;
        tab.settled().await;
        click(&tab, "More").await;
        click(&tab, "Examples").await;
        click(&tab, "Show: Recent documents").await;
        tab.frames(5).await;
        tab.picture("plate_recent").await;
        let listed = find(&tab, "Open Your plate").await;
        let (x, y) = listed.middle();
        tab.click(x, y).await;
        tab.wait_until(IS_FIGURE, 60).await;
        tab.frames(5).await;
        tab.picture("plate_from_recent").await;
        shows_it("opened").await;
        tab.assert_no_complaints().await;
    });
}

/// An embed that shows a drawing closely has it drawn finer, also after its device was lost, and rolls it by a twist of
/// two fingers.
#[test]
fn an_embed_draws_finer_and_rolls() {
    with_browser(BrowserGpu::Software, |session| async move {
        let json = r#"{"fabrica":1,"subject":{"builtin":"drawn-arm"},"figure":{"detail":1500},"camera":{"target":[0.1,-0.12,0],"distance":0.15}}"#;
        let embed = format!("controls src=\"#{}\">", payload(json));
        let tab = embed::open(&session, &[embed], "", (390, 600)).await;
        ready(&tab, 1).await;
        let first = picture_of(&tab, "e0").await;
        let size = first.dimensions().into();
        let shown = illustration(json);
        let plate = || builtin_plate("drawn-arm").expect("it is built in");
        let coarse = native(&shown, plate(), size).await;
        let original = Original::of(&plate()).expect("a drawing");
        let finer = plate().redrawn(original.finer().expect("it can be drawn finer"));
        let finer = native(&shown, finer, size).await;
        let comes = async |name: &str| {
            let start = Instant::now();
            loop {
                let page = picture_of(&tab, "e0").await;
                let [to_coarse, to_finer] =
                    [&coarse, &finer].map(|other| difference(&page, other, WHITE));
                if to_finer.mean < 0.5 * to_coarse.mean {
                    println!("{name}: coarse {to_coarse:?}, finer {to_finer:?}");
                    return;
                }
                let seconds = start.elapsed().as_secs();
                assert!(
                    seconds < 60,
                    "{name}: coarse {to_coarse:?}, finer {to_finer:?}"
                );
                hand::pause(100).await;
            }
        };
        comes("at first").await;
        tab.eval::<bool>("(told.length = 0, devices.at(-1).destroy(), true)")
            .await;
        tab.wait_until("devices.length === 2 && ledger.devices.size === 1", 60)
            .await;
        tab.wait_until("e0.toDataURL().then(() => true, () => false)", 60)
            .await;
        comes("after a loss").await;

        let touch = Touch::new(&tab).await;
        let (x, y) = embed::middle(&tab, "e0").await;
        touch.tap_at((x, y)).await;
        tab.wait_until(
            "e0.shadowRoot.querySelector('.stage').classList.contains('inside')",
            10,
        )
        .await;
        // A quarter of a turn to the right.
        let (left, right) = (
            [(x - 60.0, y), (x, y - 60.0)],
            [(x + 60.0, y), (x, y + 60.0)],
        );
        touch.swipe(&[left, right]).await;
        let told = "told.findLast(([name]) => name === 'viewchange')";
        tab.wait_until(&format!("{told} !== undefined"), 30).await;
        let turn: Vec<f64> = tab.eval(&format!("{told}[2].view.rotate")).await;
        // Half of the angle's cosine and sine.
        let angle = 2.0 * turn[0].hypot(turn[1]).hypot(turn[2]).atan2(turn[3].abs());
        assert!(
            (angle - std::f64::consts::FRAC_PI_2).abs() < 0.1,
            "{turn:?}"
        );
        tab.picture("embed_rolled").await;
        tab.assert_no_complaints().await;
    });
}

/// Where a page starts no workers, what bends the figure of an embed stands in the page, and goes with the embed.
#[test]
fn what_bends_a_figure_goes_with_its_embed() {
    with_browser(BrowserGpu::Software, |session| async move {
        let json = r#"{"fabrica":1,"subject":{"builtin":"drawn-arm"},"figure":{"detail":1500,"handles":[{"region":"humerus"},{"region":"hand","move":[0.02,0.06]}]}}"#;
        let embed = format!("src=\"#{}\">", payload(json));
        serve_where(
            &session,
            "inline.html",
            &[embed],
            ["worker-src 'self'", "worker-src 'none'"],
        );
        let tab = session.open_coarse("inline.html", (400, 400)).await;
        ready(&tab, 1).await;
        // Whoever asks the bender without a picture hears of its figure, or that there is none.
        let asks = "(window.asks = async () => {
            const figures = await import('/fabrica_figures.js');
            const said = [];
            const scope = { postMessage: (message) => said.push(JSON.stringify(message)) };
            await figures.run({ part: 'figures', task: true, module: true, bender: 0, figure: '{}', scope }, null);
            return said.some((text) => text.includes('no picture to bend'));
        }, true)";
        tab.eval::<bool>(asks).await;
        assert!(!tab.eval::<bool>("asks()").await, "it is there");
        tab.eval::<bool>("(e0.remove(), true)").await;
        tab.wait_until("asks()", 20).await;
    });
}
