//! The parts of the page: each is fetched when it is first needed, and not before; a part that fails is no end of the
//! page.

use super::*;
use harness::Tab;
use server::Server;

/// The files of programs that a server was asked for, in order.
fn programs(server: &Server) -> Vec<String> {
    let mut asked = server.asked();
    asked.retain(|path| path.starts_with("/fabrica"));
    asked
}

/// How often a file of a part was asked for.
pub(crate) fn count(server: &Server, name: &str) -> usize {
    let asked = programs(server);
    asked
        .iter()
        .filter(|path| path.trim_start_matches('/').starts_with(name))
        .count()
}

/// True if an object fills a quarter of the picture's middle; the hint for newcomers may cover the rest.
fn is_drawn(picture: &image::RgbaImage) -> bool {
    drawn_pixels(picture) * 4 > picture.pixels().len()
}

/// Puts the message of an error away: the picture behind it is still there.
async fn assert_head_is_drawn(tab: &Tab, name: &str) {
    hand::click(tab, "Dismiss").await;
    let list = hand::listed(tab).await;
    assert!(!list.contains("Alert\t"), "no message is left: {list}");
    let picture = object_part(&tab.picture(name).await);
    assert!(is_drawn(&picture), "{name}: the head is still there");
}

/// A small scan: a ball in an NRRD file.
pub(crate) fn small_scan() -> Vec<u8> {
    const SIDE: i32 = 24;
    let mut file = format!(
        "NRRD0004\ntype: uint8\ndimension: 3\nsizes: {SIDE} {SIDE} {SIDE}\nspace: right-anterior-superior\nspace directions: (4,0,0) (0,4,0) (0,0,4)\nencoding: raw\n\n"
    )
    .into_bytes();
    let half = SIDE / 2;
    for z in 0..SIDE {
        for y in 0..SIDE {
            for x in 0..SIDE {
                let square = (x - half).pow(2) + (y - half).pow(2) + (z - half).pow(2);
                file.push(if square < half * half { 200 } else { 0 });
            }
        }
    }
    file
}

/// The built-in head takes the page and the makers of subjects: no reader of scans, no decoder. A dropped scan fetches
/// those.
#[test]
fn each_part_is_fetched_when_it_is_needed() {
    with_browser(BrowserGpu::Software, |session| async move {
        session.server.add("ball.nrrd", small_scan());
        let tab = session.coarse_viewer("", PAGE).await;
        tab.settled().await;
        let picture = object_part(&tab.picture("parts_head").await);
        assert!(is_drawn(&picture), "the head is drawn");
        let server = &session.server;
        let asked = programs(server);
        println!("for the head: {asked:?}");
        for part in ["scans", "meshes", "pictures", "figures"] {
            let name = format!("fabrica_{part}");
            assert_eq!(count(server, &name), 0, "no reader: {asked:?}");
        }
        assert_eq!(count(server, "fabrica_subjects.js"), 1, "{asked:?}");
        assert_eq!(count(server, "fabrica_subjects_bg.wasm"), 1, "{asked:?}");
        assert_eq!(count(server, "fabrica_bg.wasm"), 1, "{asked:?}");
        let all = server.asked();
        let first = |name: &str| all.iter().position(|path| path == name);
        assert!(
            first("/worker.js") < first("/fabrica_bg.wasm"),
            "the part is asked for while the page's own module is on its way: {all:?}"
        );
        drop_files(&tab, &["ball.nrrd"]).await;
        tab.settled().await;
        let ball = object_part(&tab.picture("parts_ball").await);
        assert!(
            difference(&picture, &ball, WHITE).mean > 2.0,
            "the ball is drawn"
        );
        let asked = programs(server);
        println!("with the scan: {asked:?}");
        assert_eq!(count(server, "fabrica_scans_bg.wasm"), 1, "{asked:?}");
        for part in [
            "fabrica_meshes",
            "fabrica_pictures",
            "fabrica_figures",
            "fabrica_clay",
        ] {
            assert_eq!(count(server, part), 0, "no {part} for a scan: {asked:?}");
        }
        // The compiled module serves the next load: nothing is fetched again.
        drop_files(&tab, &["ball.nrrd"]).await;
        tab.settled().await;
        assert_eq!(count(server, "fabrica_scans_bg.wasm"), 1, "kept");
        tab.assert_no_complaints().await;
    });
}

/// A link to a scan beside the page fetches the readers of scans and no maker of subjects.
#[test]
fn a_link_to_a_scan_fetches_no_maker_of_subjects() {
    with_browser(BrowserGpu::Software, |session| async move {
        session.server.add("ball.nrrd", small_scan());
        let link = payload(r#"{"fabrica":1,"subject":{"src":"ball.nrrd"}}"#);
        let tab = session.coarse_viewer(&format!("#{link}"), PAGE).await;
        // The ball is drawn.
        tab.drawn("parts_link", |page| is_drawn(&object_part(page)))
            .await;
        let server = &session.server;
        assert_eq!(
            count(server, "fabrica_subjects"),
            0,
            "{:?}",
            programs(server)
        );
        assert_eq!(count(server, "fabrica_scans_bg.wasm"), 1);
        for part in [
            "fabrica_meshes",
            "fabrica_pictures",
            "fabrica_figures",
            "fabrica_clay",
        ] {
            assert_eq!(count(server, part), 0, "no {part} for a scan");
        }
        tab.assert_no_complaints().await;
    });
}

/// What a document beside the page needs is fetched while the programs of the page and of an embed are on their way.
#[test]
fn parts_for_a_document_come_beside_the_viewer() {
    with_browser(BrowserGpu::Software, |session| async move {
        let server = &session.server;
        server.add("ball.nrrd", small_scan());
        let lesson = br#"{"fabrica":1,"title":"early","subject":{"src":"ball.nrrd"}}"#;
        server.add("lesson.json", lesson.to_vec());
        let host = "<!doctype html><script>addEventListener('ready', () => (window.isReady = true));</script><script type=module src=fabrica-viewer.js></script><fabrica-viewer src=lesson.json></fabrica-viewer>";
        server.add("host.html", host.as_bytes().to_vec());
        let title = "JSON.parse(window.fabrica?.viewer?.get_document() || '{}').title";
        let page = format!("{title} === 'early'");
        let page = ("?doc=lesson.json", "fabrica_bg.wasm", page);
        let embed = "window.isReady === true".to_owned();
        let embed = ("host.html", "fabrica_reader_bg.wasm", embed);
        for (i, (path, program, is_open)) in [page, embed].into_iter().enumerate() {
            server.hold(program, true);
            let tab = session.open_coarse(path, PAGE).await;
            let start = std::time::Instant::now();
            while count(server, "fabrica_scans_bg.wasm") == i {
                assert!(
                    start.elapsed().as_secs() < 60,
                    "{path}: {:?}",
                    programs(server)
                );
                hand::pause(30).await;
            }
            server.hold(program, false);
            tab.wait_until(&is_open, 60).await;
            if i == 0 {
                tab.settled().await;
            }
            let asked = count(server, "fabrica_scans_bg.wasm");
            assert_eq!(
                asked,
                i + 1,
                "{path}: the part is lent: {:?}",
                programs(server)
            );
            assert_eq!(count(server, "fabrica_subjects"), 0, "{path}");
            tab.assert_no_complaints().await;
            tab.page.close().await.expect("the tab closes");
        }
    });
}

/// A real panic in a part: the program as it is shipped, in a browser that says that a file's piece has more bytes than
/// this machine can hold. The viewer tells it in words with the panic's own beside them, and the next scan is read.
#[test]
fn a_panic_in_a_part_is_a_message() {
    const FAULTY: &str = "
        const read = FileReaderSync.prototype.readAsArrayBuffer;
        FileReaderSync.prototype.readAsArrayBuffer = function (...piece) {
            const bytes = read.apply(this, piece);
            Object.defineProperty(Uint8Array.prototype, 'length', { get: () => 0xffffffff });
            return bytes;
        };";
    with_browser(BrowserGpu::Software, |session| async move {
        session.server.add("ball.nrrd", small_scan());
        let tab = session.coarse_viewer("", PAGE).await;
        tab.drawn("panic_before", |page| is_drawn(&object_part(page)))
            .await;
        let bindings = std::fs::read_to_string(harness::dist().join("fabrica_scans.js"));
        let bindings = bindings.expect("the script of the part");
        let faulty = format!("{bindings}\n{FAULTY}").into_bytes();
        session.server.add("fabrica_scans.js", faulty);
        drop_files(&tab, &["ball.nrrd"]).await;
        hand::hear(&tab, "stopped because of a fault").await;
        hand::click(&tab, "Details").await;
        let words = hand::listed(&tab).await;
        assert!(words.contains("capacity overflow"), "{words}");
        assert!(
            !tab.eval::<bool>("window.fabrica.viewer.has_panicked()")
                .await,
            "the page itself goes on"
        );
        let document: String = tab.eval("window.fabrica.viewer.get_document()").await;
        assert!(!document.contains("sha256"), "as it was: {document}");
        assert_head_is_drawn(&tab, "panic_after").await;

        session
            .server
            .add("fabrica_scans.js", bindings.into_bytes());
        drop_files(&tab, &["ball.nrrd"]).await;
        tab.wait_until(
            "JSON.parse(window.fabrica.viewer.get_document()).subject?.sha256 !== undefined",
            60,
        )
        .await;
        tab.assert_no_complaints().await;
    });
}

/// A part that cannot be loaded, or stops with a fault, becomes a message; the page goes on.
#[test]
fn a_part_that_fails_is_a_message() {
    with_browser(BrowserGpu::Software, |session| async move {
        session.server.add("ball.nrrd", small_scan());
        let tab = session.coarse_viewer("", PAGE).await;
        tab.drawn("parts_before", |page| is_drawn(&object_part(page)))
            .await;
        // It loads, and stops in the midst of its task.
        let faulty = "export default async () => {}; export async function run() { setTimeout(() => { throw new Error('planted fault'); }); await new Promise(() => {}); }";
        session
            .server
            .add("fabrica_scans.js", faulty.as_bytes().to_vec());
        drop_files(&tab, &["ball.nrrd"]).await;
        let said = "document.getElementById('said').textContent";
        tab.wait_until(
            &format!("{said}.includes('stopped because of a fault')"),
            20,
        )
        .await;
        assert!(
            !tab.eval::<bool>("window.fabrica.viewer.has_panicked()")
                .await,
            "the page itself goes on"
        );
        assert_head_is_drawn(&tab, "parts_after_fault").await;
        // It cannot be loaded at all.
        session
            .server
            .add("fabrica_scans.js", b"this is no program".to_vec());
        drop_files(&tab, &["ball.nrrd"]).await;
        tab.settled().await;
        let document: String = tab.eval("window.fabrica.viewer.get_document()").await;
        assert!(
            !document.contains("ball"),
            "the document is as it was: {document}"
        );
        assert_head_is_drawn(&tab, "parts_after_no_program").await;
        tab.assert_no_complaints().await;
    });
}
