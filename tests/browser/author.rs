//! What an author does in a real browser: by touch alone on a phone, by keyboard alone, in two tabs; and a page that
//! sleeps.

use super::hand::{CTRL, SHIFT, clipboard, document, kept, mark, pause};
use super::hand::{
    Control, IS_PREVENTED, KEEPS_KEYS, Touch, changed, controls, find, focus, hear, press,
    press_with, scenery, tab_to,
};
use super::harness::{Tab, with_browser};
use super::*;
use chromiumoxide::cdp::browser_protocol::input::{
    DispatchMouseEventParams, DispatchMouseEventType,
};
use serde_json::Value;

/// A phone, CSS pixels.
const PHONE: (u32, u32) = (360, 640);
/// What is there before the author chooses.
const OTHER: &str = r#"{"fabrica":1,"subject":{"builtin":"bar"}}"#;

const IS_CUBE: &str =
    "JSON.parse(window.fabrica.viewer.get_document()).subject?.builtin === 'cube'";

const TEMPLATES: &str =
    "(JSON.parse(window.fabrica.viewer.get_document() || '{}').templates ?? [])";

// ---------------------------------------------------------------------------------------------------- the path

/// Choose, place, open, adjust the look, copy the link: with fingers on a phone.
#[test]
fn the_path_by_touch_alone() {
    with_browser(BrowserGpu::Software, |session| async move {
        session.allow_clipboard().await;
        let tab = session
            .coarse_viewer(&format!("#{}", payload(OTHER)), PHONE)
            .await;
        let hand = Touch::new(&tab).await;
        hand.scenery().await;
        hand.tap("Subject").await;
        tab.picture("touch_0_subjects").await;
        hand.tap("Cube").await;
        tab.wait_until(IS_CUBE, 20).await;
        hand.scenery().await;
        tab.picture("touch_1_start").await;

        // One finger turns, two zoom and move.
        let camera = document(&tab).await["camera"].clone();
        let middle = find(&tab, "Picture").await.middle();
        let beside = |x: f64, y: f64| (middle.0 + x, middle.1 + y);
        mark(&tab, "camera").await;
        hand.swipe(&[[beside(-120.0, -60.0), beside(-70.0, -60.0)]])
            .await;
        let turned = changed(&tab, "camera").await;
        assert_ne!(turned["rotate"], camera["rotate"], "one finger turns");
        assert_eq!(turned["target"], camera["target"], "and moves nothing");
        mark(&tab, "camera").await;
        let pinch = [
            [beside(-30.0, 0.0), beside(-70.0, 20.0)],
            [beside(30.0, 0.0), beside(90.0, 40.0)],
        ];
        hand.swipe(&pinch).await;
        let pinched = changed(&tab, "camera").await;
        let distance = |camera: &Value| camera["distance"].as_f64().unwrap_or(2.5);
        assert!(
            distance(&pinched) < 0.9 * distance(&turned),
            "two fingers come closer: {turned} {pinched}"
        );
        assert_ne!(pinched["target"], turned["target"], "and move");
        assert_eq!(pinched["rotate"], turned["rotate"], "and turn nothing");
        mark(&tab, "camera").await;
        hand.tap("Back to the first view").await;
        changed(&tab, "camera").await;

        // Choose and place.
        hand.tap("Add").await;
        tab.picture("touch_2_catalogue").await;
        hand.tap("Place peel").await;
        let middle = find(&tab, "Picture").await.middle();
        hand.tap_at(middle).await;
        tab.wait_until(&format!("{TEMPLATES}.length === 1"), 60)
            .await;
        tab.picture("touch_3_placed").await;
        let placed = document(&tab).await;
        assert_eq!(placed["templates"][0]["kind"], "peel", "{placed}");

        // Open it where it acts: its handle is drawn out.
        let handle = find(&tab, "Drag progress").await;
        mark(&tab, "templates").await;
        let from = handle.middle();
        hand.swipe(&[[from, (from.0 + 60.0, from.1)]]).await;
        let opened = changed(&tab, "templates").await;
        tab.picture("touch_4_opened").await;
        let progress = |t: &Value| t[0]["params"]["progress"].as_f64().unwrap_or(0.5);
        assert!(
            (progress(&opened) - progress(&placed["templates"])).abs() > 0.05,
            "its handle opens it: {opened}"
        );

        // A long press is the right button: the template's menu. A tap above it puts it away.
        let beside = find(&tab, "Picture").await.corner(0.9, 0.3);
        let first = hand.hold_for(beside, "Copy").await;
        tab.picture("touch_5_menu").await;
        hand.tap_at((20.0, first.at.1 - 20.0)).await;
        let open: Vec<String> = controls(&tab).await.into_iter().map(|c| c.name).collect();
        assert!(
            !open.contains(&"Duplicate".to_owned()),
            "the menu is away: {open:?}"
        );

        // The look: a tap on a background, which is far down in the drawer.
        hand.tap("Look").await;
        mark(&tab, "look").await;
        hand.scroll_to("Background: Paper").await;
        tab.picture("touch_6_look").await;
        hand.tap("Background: Paper").await;
        let look = changed(&tab, "look").await;
        assert!(look["background"].is_string(), "{look}");
        hand.tap("Look").await;
        tab.frames(3).await;
        tab.picture("touch_7_done").await;

        // Everything that a thumb has to meet is large enough for one; the marks of the ball of axes stand in the menu
        // of views too.
        let small: Vec<String> = controls(&tab)
            .await
            .into_iter()
            .filter(|c| c.role == "Button" && !c.name.starts_with("View: "))
            .filter(|c| c.size.0.min(c.size.1) < 40.0)
            .map(|c| format!("{} {:?}", c.name, c.size))
            .collect();
        assert!(small.is_empty(), "too small for a finger: {small:?}");

        // The link.
        hand.tap("Copy link").await;
        let link = clipboard(&tab, &session.server.address()).await;
        let sent = document(&tab).await;
        let other = session.coarse_viewer_at(&link, PHONE).await;
        other
            .wait_until("window.fabrica.viewer.get_document() !== ''", 60)
            .await;
        assert_eq!(document(&other).await, sent, "the link is what was made");
        other.assert_no_complaints().await;
        tab.assert_no_complaints().await;
    });
}

/// The same path without mouse and finger, and without seeing more than what is said aloud.
#[test]
fn the_path_by_keys_alone() {
    with_browser(BrowserGpu::Software, |session| async move {
        session.allow_clipboard().await;
        let tab = session
            .coarse_viewer(&format!("#{}", payload(PLAIN)), PAGE)
            .await;
        focus(&tab).await;
        scenery(&tab, "keys_0").await;
        mark(&tab, "camera").await;
        press(&tab, "ArrowRight").await;
        changed(&tab, "camera").await;
        press(&tab, "0").await;

        // Choose by search, place in the middle, open.
        press(&tab, "/").await;
        hear(&tab, "Search").await;
        for letter in ["p", "e", "e", "l"] {
            press(&tab, letter).await;
        }
        tab.picture("keys_1_search").await;
        press(&tab, "Enter").await;
        press(&tab, "Enter").await;
        tab.wait_until(&format!("{TEMPLATES}.length === 1"), 60)
            .await;
        tab.picture("keys_2_placed").await;
        for _ in 0..4 {
            press(&tab, "]").await;
        }
        // Opened by four times five hundredths.
        tab.wait_until(
            &format!("Math.abs({TEMPLATES}[0].params.progress - 0.7) < 0.01"),
            20,
        )
        .await;

        // The look: panel by panel, then control by control.
        press(&tab, "e").await;
        press(&tab, "e").await;
        find(&tab, "Opacity: Keep mass").await;
        tab_to(&tab, "Opacity: Keep mass").await;
        press(&tab, "Enter").await;
        tab.wait_until(
            "JSON.parse(window.fabrica.viewer.get_document()).look?.opacity === 'mass'",
            20,
        )
        .await;
        // A label in the middle, named at once.
        press(&tab, "a").await;
        press(&tab, "Enter").await;
        let labels = "JSON.parse(window.fabrica.viewer.get_document()).labels";
        tab.wait_until(&format!("{labels}?.length === 1"), 30).await;
        hear(&tab, "Text of label 1").await;
        for letter in ["b", "o", "x"] {
            press(&tab, letter).await;
        }
        tab.wait_until(&format!("{labels}[0].text === 'box'"), 20)
            .await;
        tab.frames(3).await;
        tab.picture("keys_3_look").await;
        let adjusted = document(&tab).await;
        assert_eq!(adjusted["look"]["opacity"], "mass", "{adjusted}");

        press_with(&tab, CTRL | SHIFT, "L", None).await;
        let link = clipboard(&tab, &session.server.address()).await;
        hear(&tab, "clipboard").await;
        let other = session.coarse_viewer_at(&link, PAGE).await;
        other
            .wait_until("window.fabrica.viewer.get_document() !== ''", 60)
            .await;
        assert_eq!(
            document(&other).await,
            document(&tab).await,
            "the link is what was made"
        );
        tab.assert_no_complaints().await;
    });
}

/// Ctrl and F find a tissue, and the browser's own search stays closed; where a sheet lies over the panels the keys are
/// the browser's.
#[test]
fn ctrl_f_finds_a_tissue() {
    with_browser(BrowserGpu::Software, |session| async move {
        let tab = session
            .coarse_viewer(&format!("#{}", payload(PLAIN)), PAGE)
            .await;
        focus(&tab).await;
        tab.eval::<bool>(KEEPS_KEYS).await;
        let field = |list: &[Control]| list.iter().any(|c| c.name == "Search tissues and labels");
        assert!(!field(&controls(&tab).await), "the panel is another");
        press(&tab, "?").await;
        press_with(&tab, CTRL, "f", None).await;
        assert!(!tab.eval::<bool>(IS_PREVENTED).await, "under the sheet");
        press(&tab, "Escape").await;
        press_with(&tab, CTRL, "f", None).await;
        assert!(tab.eval::<bool>(IS_PREVENTED).await, "it is ours");
        find(&tab, "Search tissues and labels").await;
        hear(&tab, "Search tissues and labels").await;
        tab.assert_no_complaints().await;
    });
}

/// Captions over the picture are text of the page: selected, found by the browser's search, one list in the document's
/// order, and no obstacle for the wheel. What opens over them hides them. The letters of saved pictures are shaped.
#[test]
fn captions_are_text_of_the_page() {
    const LABELLED: &str = r#"{"fabrica":1,"subject":{"builtin":"cube"},"labels":[{"at":[-0.3,0.49,0.3],"text":"Upper corner"},{"at":[0.3,0.49,-0.3],"text":"עצם <b>"}]}"#;
    with_browser(BrowserGpu::Software, |session| async move {
        let tab = session
            .coarse_viewer(&format!("#{}", payload(LABELLED)), PAGE)
            .await;
        focus(&tab).await;
        let are_seen = "document.querySelectorAll('#captions li:not(.absent)').length === 2";
        tab.wait_until(are_seen, 60).await;
        tab.settled().await;
        tab.picture("captions_as_text").await;
        let texts: Vec<String> = tab
            .eval("[...document.querySelectorAll('ol#captions[aria-label] li')].map((li) => li.textContent)")
            .await;
        assert_eq!(texts, ["Upper corner", "עצם <b>"]);
        let twice = controls(&tab).await;
        assert!(twice.iter().all(|c| c.name != "Upper corner"), "{twice:?}");

        let camera =
            "JSON.stringify(JSON.parse(window.fabrica.viewer.get_document()).camera ?? null)";
        let before: String = tab.eval(camera).await;
        let [left, right, top, bottom]: [f64; 4] = tab
            .eval("(({ left, right, top, bottom }) => [left, right, top, bottom])(document.querySelector('#captions li').getBoundingClientRect())")
            .await;
        // From its first row to the last.
        let (from, to) = ((left + 1.0, top + 6.0), (right - 1.0, bottom - 6.0));
        tab.drag(from, to, 4).await;
        let selected: String = tab.eval("getSelection().toString()").await;
        assert!(selected.contains("corner"), "selected: {selected:?}");
        assert_eq!(tab.eval::<String>(camera).await, before, "nothing turns");
        tab.eval::<bool>("(getSelection().empty(), true)").await;
        for (words, is_there) in [("Upper corner", true), ("Lower corner", false)] {
            let found: bool = tab.eval(&format!("find('{words}')")).await;
            assert_eq!(found, is_there, "a search for {words:?}");
        }
        tab.eval::<bool>("(getSelection().empty(), true)").await;

        let middle = (0.5 * (left + right), 0.5 * (top + bottom));
        let mut wheel =
            DispatchMouseEventParams::new(DispatchMouseEventType::MouseWheel, middle.0, middle.1);
        (wheel.delta_x, wheel.delta_y) = (Some(0.0), Some(120.0));
        tab.page.execute(wheel).await.expect("a wheel");
        tab.wait_until(&format!("{camera} !== '{before}'"), 20)
            .await;

        // A click goes to the text's field; a sheet hides the texts that it covers.
        tab.settled().await;
        tab.wait_until(are_seen, 60).await;
        let [x, y]: [f64; 2] = tab
            .eval("(({ left, width, top, height }) => [left + width / 2, top + height / 2])(document.querySelector('#captions li').getBoundingClientRect())")
            .await;
        let under = format!("document.elementFromPoint({x}, {y})?.textContent");
        assert_eq!(tab.eval::<String>(&under).await, "Upper corner");
        tab.click(x, y).await;
        find(&tab, "Text of label 1").await;
        press(&tab, "Escape").await;
        focus(&tab).await;
        press(&tab, "?").await;
        tab.wait_until(
            "document.querySelectorAll('#captions li.absent').length > 0",
            20,
        )
        .await;
        press(&tab, "Escape").await;
        tab.wait_until(are_seen, 20).await;

        // Joined letters are narrower than letters that stand alone; a text from the right ends at the left.
        let widths: [u32; 2] = tab
            .eval("import('./texts.js').then(({ Texts }) => { const texts = new Texts(document.createElement('canvas'), '', () => {}); const width = (text) => texts.set(text, 60, false, 900, 1).width - 2; return [width('عظم'), width('ع') + width('ظ') + width('م')]; })")
            .await;
        assert!(widths[0] > 40 && widths[0] + 2 < widths[1], "{widths:?}");
        let rows: Vec<[u32; 3]> = tab
            .eval("import('./texts.js').then(({ Texts }) => { const texts = new Texts(document.createElement('canvas'), '', () => {}); return [['a long text of many words', 9], ['a long text of many words', 2], ['עצם', 2], ['unbreakable'.repeat(40), 4], ['', 1]].map(([text, rows]) => { const { width, height, coverage } = texts.set(text, 20, true, 100, rows); return [width, height, coverage.filter((c) => c > 200).length]; }); })")
            .await;
        for [width, height, inked] in &rows[..4] {
            assert!(*width <= 102 && *inked > 20, "{width} x {height}: {inked}");
        }
        let heights: Vec<u32> = rows.iter().map(|row| row[1]).collect();
        assert!(
            heights[0] > 50 && heights[1..] == [50, 25, 100, 25],
            "{rows:?}"
        );
        tab.assert_no_complaints().await;
    });
}

// ---------------------------------------------------------------------------------------------------- tabs

/// Brings a tab to the front that another one lies over.
pub(crate) async fn to_front(tab: &Tab) {
    tab.page.bring_to_front().await.expect("the tab comes up");
    tab.wait_until("!document.hidden", 20).await;
    tab.frames(2).await;
}

/// A template copied in one tab is pasted in another; both are edited in turn, reloaded without their addresses, and
/// come back as they were left.
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
            .coarse_viewer(&format!("#{}", with_title("first", poke)), SIZE)
            .await;
        focus(&first).await;
        scenery(&first, "tabs_first").await;
        press(&first, "n").await;
        press_with(&first, CTRL, "c", Some("copy")).await;
        let text = clipboard(&first, "{\"fabrica-templates\"").await;
        assert!(text.contains("nose") && text.contains("later"), "{text}");

        let second = session
            .coarse_viewer(&format!("#{}", with_title("second", "")), SIZE)
            .await;
        focus(&second).await;
        scenery(&second, "tabs_second").await;
        press_with(&second, CTRL, "v", Some("paste")).await;
        second
            .wait_until(&format!("{TEMPLATES}.length === 1"), 30)
            .await;
        assert_eq!(
            document(&second).await["templates"],
            document(&first).await["templates"],
            "whole, with what this version does not know"
        );
        scenery(&second, "tabs_pasted").await;

        // Edited in turn.
        to_front(&first).await;
        press(&first, "d").await;
        first
            .wait_until(&format!("{TEMPLATES}.length === 2"), 30)
            .await;
        kept(&first).await;
        to_front(&second).await;
        press(&second, "h").await;
        second
            .wait_until(&format!("{TEMPLATES}[0].enabled === false"), 30)
            .await;
        kept(&second).await;
        to_front(&first).await;
        press(&first, "h").await;
        first
            .wait_until(&format!("{TEMPLATES}.some(t => t.enabled === false)"), 30)
            .await;
        kept(&first).await;
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
            .coarse_viewer(&format!("#{}", payload(PLAIN)), (420, 380))
            .await;
        tab.eval::<bool>(
            "(() => { const submit = GPUQueue.prototype.submit; window.submits = 0; GPUQueue.prototype.submit = function (...a) { window.submits++; return submit.apply(this, a) }; return true })()",
        )
        .await;
        let submits = "window.submits";
        // Turned once, to see that the counter counts.
        focus(&tab).await;
        press(&tab, "ArrowRight").await;
        tab.settled().await;
        assert!(tab.eval::<u32>(submits).await > 0, "drawing is counted");
        // Messages go by and the catalogue's pictures are made; then there is silence. Time itself is looked at here: a
        // page that asked for a frame every few seconds would not sleep.
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
        assert!(tab.eval::<u32>(submits).await > before, "and awake again");
    });
}
