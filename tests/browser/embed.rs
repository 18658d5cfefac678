//! The viewer as an element in somebody else's page.

use super::hand::{CTRL, IS_PREVENTED, KEEPS_KEYS, strike};
use super::*;
use chromiumoxide::cdp::browser_protocol::emulation::SetFocusEmulationEnabledParams;

const LESSON: &str = r#"{"fabrica":1,"title":"Opening a cube","subject":{"builtin":"cube"},"templates":[{"kind":"split","size":[1.2,1.2,1.2],"params":{"amount":0}}],"steps":[{"title":"Apart","caption":"The halves part.","set":{"/templates/0/params/amount":0.3}}]}"#;

/// Keeps the viewer that the element makes: for the test's waits alone.
const WATCH: &[u8] = b"import { Viewer } from './fabrica.js'; const start = Viewer.prototype.start; Viewer.prototype.start = function () { window.viewer = this; return start.call(this); };";
const VIEWER: &str = "window.viewer";

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
        let page = String::from_utf8(embedding_page("controls")).expect("text");
        let page = page.replace(
            "<script",
            "<script type=module src=watch.js></script><script",
        );
        session.server.add("lesson.html", page.into_bytes());
        session.server.add("watch.js", WATCH.to_vec());
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
        tab.drawn("embed_before", |page| drawn_pixels(page) > 5000)
            .await;
        let before: String = tab.eval(&picture).await;
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
        tab.frames_of(VIEWER, 3).await;
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
        tab.frames_of(VIEWER, 3).await;
        let by_page: String = tab.eval(&picture).await;
        let by_page = decode(&by_page);
        assert_eq!(by_page.dimensions(), after.dimensions());
        let apart = difference(&by_page, &after, WHITE).mean;
        assert!(
            apart < 0.5,
            "the page's own value draws what the step draws: {apart}"
        );
        // Its keys for a search look for words of the page around it.
        tab.page
            .execute(SetFocusEmulationEnabledParams::new(true))
            .await
            .expect("a window in front");
        tab.eval::<bool>(KEEPS_KEYS).await;
        tab.eval::<bool>(&format!(
            "({root}.shadowRoot.querySelector('canvas').focus(), true)"
        ))
        .await;
        tab.frames_of(VIEWER, 3).await;
        for (modifiers, key) in [(CTRL, "f"), (0, "p")] {
            strike(&tab, modifiers, key, None).await;
            tab.frames_of(VIEWER, 2).await;
            let is_prevented: bool = tab.eval(IS_PREVENTED).await;
            assert!(!is_prevented || key == "p", "{key} is the browser's");
            // Nothing is listed before the first call.
            tab.eval::<String>("window.viewer.controls()").await;
            tab.frames_of(VIEWER, 2).await;
            let lines: String = tab.eval("window.viewer.controls()").await;
            assert_eq!(
                lines.contains("Copy link"),
                key == "p",
                "{key}: panels are shown by P alone: {lines}"
            );
        }
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
        // An observer of what is seen is told after a frame of the browser.
        tab.eval::<bool>("new Promise(done => { let left = 20; const frame = () => left-- > 0 ? requestAnimationFrame(frame) : done(true); frame(); })").await;
        let fetched =
            "performance.getEntriesByType('resource').filter(e => e.name.endsWith('.wasm')).length";
        assert_eq!(tab.eval::<u32>(fetched).await, 0, "nothing is fetched yet");
        tab.eval::<bool>("(document.getElementById('it').scrollIntoView(), true)")
            .await;
        tab.wait_until(&format!("({words}).includes('WebGPU')"), 60)
            .await;
    });
}
