//! What an author does in a real browser: templates go from tab to tab, tabs keep their own documents, a page sleeps.

use super::harness::{Tab, with_browser};
use super::*;
use chromiumoxide::cdp::browser_protocol::emulation::SetFocusEmulationEnabledParams;
use chromiumoxide::cdp::browser_protocol::input::{DispatchKeyEventParams, DispatchKeyEventType};
use serde_json::Value;

/// A cube with nothing placed: quick to draw.
const PLAIN: &str = r#"{"fabrica":1,"subject":{"builtin":"cube"}}"#;

const TEMPLATES: &str =
    "(JSON.parse(window.fabrica.viewer.get_document() || '{}').templates ?? [])";

/// Gives the picture the keyboard, as a browser's window does that is in front.
async fn focus(tab: &Tab) {
    let emulation = SetFocusEmulationEnabledParams::new(true);
    tab.page
        .execute(emulation)
        .await
        .expect("a window in front");
    tab.eval::<bool>("(document.getElementById('fabrica').focus(), true)")
        .await;
    pause(300).await;
}

fn pause(milliseconds: u64) -> impl Future<Output = ()> {
    tokio::time::sleep(Duration::from_millis(milliseconds))
}

async fn document(tab: &Tab) -> Value {
    let text: String = tab.eval("window.fabrica.viewer.get_document()").await;
    serde_json::from_str(&text).expect("the viewer's document is JSON")
}

/// The text on the clipboard once it has come.
async fn clipboard(tab: &Tab, start: &str) -> String {
    let read = "navigator.clipboard.readText().catch(error => String(error))";
    let start = serde_json::to_string(start).expect("text");
    let wanted = format!("{read}.then(text => text.startsWith({start}))");
    tab.wait_until(&wanted, 30).await;
    tab.eval(read).await
}

// ---------------------------------------------------------------------------------------------------- keys

/// Ctrl as the protocol counts it.
const CTRL: i64 = 2;

/// A key with others held; `command` is what the browser's own editing would do with it.
async fn press_with(tab: &Tab, modifiers: i64, key: &str, command: Option<&str>) {
    for kind in [DispatchKeyEventType::KeyDown, DispatchKeyEventType::KeyUp] {
        let mut params = DispatchKeyEventParams::new(kind.clone());
        params.modifiers = Some(modifiers);
        params.key = Some(key.to_owned());
        let is_letter = key.len() == 1;
        params.code = Some(match key.chars().next() {
            Some(c) if is_letter && c.is_ascii_alphabetic() => {
                format!("Key{}", c.to_ascii_uppercase())
            }
            Some('/') => "Slash".to_owned(),
            Some(']') => "BracketRight".to_owned(),
            Some(' ') => "Space".to_owned(),
            _ => key.to_owned(),
        });
        if kind == DispatchKeyEventType::KeyDown {
            if is_letter && modifiers & CTRL == 0 {
                params.text = Some(key.to_owned());
            }
            params.commands = command.map(|command| vec![command.to_owned()]);
        }
        tab.page.execute(params).await.expect("a key");
    }
    pause(250).await;
}

async fn press(tab: &Tab, key: &str) {
    press_with(tab, 0, key, None).await;
}

// ---------------------------------------------------------------------------------------------------- tabs

async fn to_front(tab: &Tab) {
    tab.page.bring_to_front().await.expect("the tab comes up");
    pause(500).await;
}

/// A template copied in one tab is pasted in another; both are edited in turn, reloaded without their addresses, and come
/// back as they were left.
#[test]
fn two_tabs_share_templates_and_nothing_else() {
    const SIZE: (u32, u32) = (420, 380);
    with_browser(BrowserGpu::Software, |session| async move {
        session.allow_clipboard().await;
        let with_title = |title: &str, templates: &str| {
            payload(&format!(
                r#"{{"fabrica":1,"title":"{title}","subject":{{"builtin":"cube"}},"templates":[{templates}]}}"#
            ))
        };
        let poke =
            r#"{"kind":"poke","name":"nose","group":"face","at":[0.1,0.4,0.2],"later":true}"#;
        let first = session
            .viewer_sized(&format!("#{}", with_title("first", poke)), SIZE)
            .await;
        rest(&first).await;
        focus(&first).await;
        press(&first, "n").await;
        press_with(&first, CTRL, "c", Some("copy")).await;
        let text = clipboard(&first, "{\"fabrica-templates\"").await;
        assert!(text.contains("nose") && text.contains("later"), "{text}");

        let second = session
            .viewer_sized(&format!("#{}", with_title("second", "")), SIZE)
            .await;
        rest(&second).await;
        focus(&second).await;
        press_with(&second, CTRL, "v", Some("paste")).await;
        second
            .wait_until(&format!("{TEMPLATES}.length === 1"), 30)
            .await;
        assert_eq!(
            document(&second).await["templates"],
            document(&first).await["templates"],
            "whole, with what this version does not know"
        );
        rest(&second).await;
        second.picture("tabs_pasted").await;

        // Edited in turn.
        to_front(&first).await;
        press(&first, "d").await;
        first
            .wait_until(&format!("{TEMPLATES}.length === 2"), 30)
            .await;
        pause(1000).await;
        to_front(&second).await;
        press(&second, "h").await;
        second
            .wait_until(&format!("{TEMPLATES}[0].enabled === false"), 30)
            .await;
        pause(1000).await;
        to_front(&first).await;
        press(&first, "h").await;
        pause(1500).await;
        rest(&first).await;
        let left = [document(&first).await, document(&second).await];
        assert_ne!(left[0], left[1]);

        // Reloaded at the plain address: only what the tab itself kept can bring its document back.
        for (tab, left) in [(&second, &left[1]), (&first, &left[0])] {
            to_front(tab).await;
            tab.eval::<bool>("(history.replaceState(null, '', location.pathname), true)")
                .await;
            tab.page.reload().await.expect("the page reloads");
            tab.wait_for_state("started").await;
            tab.wait_until("window.fabrica.viewer.get_document() !== ''", 60)
                .await;
            let back = document(tab).await;
            assert_eq!(&back, left, "as it was left");
            tab.assert_no_complaints().await;
        }
    });
}

// ---------------------------------------------------------------------------------------------------- sleep

/// Once the picture is complete nothing is asked of the graphics device, in front and behind another tab.
#[test]
fn a_sleeping_page_draws_nothing() {
    with_browser(BrowserGpu::Software, |session| async move {
        let tab = session
            .viewer_sized(&format!("#{}", payload(PLAIN)), (420, 380))
            .await;
        tab.eval::<bool>(
            "(() => { const submit = GPUQueue.prototype.submit; window.submits = 0; GPUQueue.prototype.submit = function (...a) { window.submits++; return submit.apply(this, a) }; return true })()",
        )
        .await;
        let submits = "window.submits";
        // Turned once, to see that the counter counts.
        focus(&tab).await;
        press(&tab, "ArrowRight").await;
        rest(&tab).await;
        assert!(tab.eval::<u32>(submits).await > 0, "drawing is counted");
        // Messages go by and the catalogue's pictures are made; then there is silence.
        let mut before = tab.eval::<u32>(submits).await;
        for _ in 0..40 {
            pause(4000).await;
            let now = tab.eval::<u32>(submits).await;
            if now == before {
                break;
            }
            before = now;
        }
        pause(6000).await;
        assert_eq!(tab.eval::<u32>(submits).await, before, "asleep in front");
        let other = session.open("icon.svg").await;
        pause(4000).await;
        assert_eq!(tab.eval::<u32>(submits).await, before, "asleep behind");
        other.page.close().await.expect("the tab closes");
        to_front(&tab).await;
        press(&tab, "ArrowLeft").await;
        pause(1500).await;
        assert!(tab.eval::<u32>(submits).await > before, "and awake again");
    });
}
