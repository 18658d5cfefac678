//! A lesson before a room: keys as of a slide program, a black screen, a spotlight, a QR code, and all as it was after.

use super::embed::{LESSON, lesson, open_coarse, ready, rests_quietly, stage};
use super::hand::{Touch, bring_to_front, strike};
use super::harness::{Session, Tab};
use super::*;
use chromiumoxide::cdp::browser_protocol::input::DispatchMouseEventType;

const ROOT: &str = "e0.shadowRoot";
const BUTTON: &str = "e0.shadowRoot.querySelector('[part~=present]')";

async fn start(session: &Session, size: (u32, u32)) -> Tab {
    let tab = open_coarse(session, &[lesson("controls")], "", size).await;
    bring_to_front(&tab).await;
    ready(&tab, 1).await;
    rests_quietly(&tab).await;
    tab
}

/// Presses the button that begins.
async fn begin(tab: &Tab) {
    tab.eval::<bool>(&format!("({BUTTON}.scrollIntoView(), true)"))
        .await;
    let [x, y]: [f64; 2] = tab
        .eval(&format!("(({{ x, y, width, height }}) => [x + width / 2, y + height / 2])({BUTTON}.getBoundingClientRect())"))
        .await;
    tab.click(x, y).await;
    tab.wait_until(&is_presenting(), 20).await;
    rests_quietly(tab).await;
}

fn is_presenting() -> String {
    format!("{ROOT}.querySelector('.presents .bar') !== null")
}

async fn key(tab: &Tab, key: &str) {
    strike(tab, 0, key, None).await;
    tab.frames(2).await;
}

fn is_shown(part: &str) -> String {
    format!("{ROOT}.querySelector('.{part}').checkVisibility()")
}

/// What a phone before the screen reads.
pub(crate) fn read(picture: &image::RgbaImage) -> Option<String> {
    let (width, height) = picture.dimensions();
    let gray = |x: usize, y: usize| picture.get_pixel(x as u32, y as u32)[1];
    let mut image =
        rqrr::PreparedImage::prepare_from_greyscale(width as usize, height as usize, gray);
    let grids = image.detect_grids();
    Some(grids.first()?.decode().ok()?.1)
}

/// The mean light of a square of 20 pixels around a place.
fn light(picture: &image::RgbaImage, (x, y): (f64, f64)) -> f64 {
    let (left, top) = (x as u32 - 10, y as u32 - 10);
    let part = image::imageops::crop_imm(picture, left, top, 20, 20).to_image();
    let sum: u32 = part.pixels().map(|p| u32::from(p[1])).sum();
    f64::from(sum) / f64::from(part.width() * part.height())
}

#[test]
fn a_lesson_is_presented_by_keys() {
    with_browser(BrowserGpu::Software, |session| async move {
        let tab = start(&session, (900, 600)).await;
        let state = "JSON.stringify([e0.shadowRoot.adoptedStyleSheets.length, e0.shadowRoot.querySelector('.frame').outerHTML.replace(/style=\"[^\"]*\"|aria-[a-z]+=\"[^\"]*\"|<ol.*<.ol>|<svg.*?<.svg>|<p class=\"unseen\".*?<.p>/gs, ''), e0.shadowRoot.activeElement?.getAttribute('part')])";
        tab.eval::<bool>(&format!("({BUTTON}.focus(), true)")).await;
        let before: String = tab.eval(state).await;
        begin(&tab).await;
        let size: [f64; 4] = stage(&tab, "e0").await;
        assert_eq!(
            [size[0], size[1], size[2]],
            [0.0, 0.0, 900.0],
            "from edge to edge"
        );
        assert!(
            !tab.eval::<bool>(&is_shown("controls")).await,
            "no controls"
        );
        tab.picture("present_desk").await;

        // Steps are walked by arrows, clickers, and to both ends; the page hears none of it.
        tab.eval::<bool>(
            "(window.heard = [], addEventListener('keydown', ({ key }) => heard.push(key)), true)",
        )
        .await;
        for (pressed, step) in [
            ("ArrowRight", 1),
            ("PageDown", 2),
            ("PageDown", 2),
            ("PageUp", 1),
            ("ArrowLeft", 0),
            ("ArrowLeft", 0),
            ("End", 2),
            ("Home", 0),
            (" ", 1),
        ] {
            key(&tab, pressed).await;
            assert_eq!(tab.eval::<u32>("e0.step").await, step, "after {pressed}");
        }
        rests_quietly(&tab).await;
        let text: String = tab
            .eval(&format!("{ROOT}.querySelector('.talk').innerText"))
            .await;
        assert!(
            text.contains("Apart") && text.contains("The halves part."),
            "{text}"
        );
        let letters: f64 = tab
            .eval(&format!(
                "parseFloat(getComputedStyle({ROOT}.querySelector('.talk')).fontSize)"
            ))
            .await;
        assert!(letters >= 18.0, "{letters} pixels");
        assert_eq!(tab.eval::<Vec<String>>("heard").await, [""; 0]);

        // Black, and the first press after it only brings the picture back.
        for black in ["b", "."] {
            key(&tab, black).await;
            assert!(tab.eval::<bool>(&is_shown("blank")).await);
            key(&tab, "ArrowRight").await;
            assert!(!tab.eval::<bool>(&is_shown("blank")).await);
            assert_eq!(tab.eval::<u32>("e0.step").await, 1);
        }

        // The spotlight is where the pointer is.
        key(&tab, "l").await;
        let (here, there) = ((200.0, 120.0), (700.0, 330.0));
        for (at, other) in [(here, there), (there, here)] {
            tab.mouse(DispatchMouseEventType::MouseMoved, at.0, at.1, false)
                .await;
            tab.frames(3).await;
            let picture = tab.picture("present_spot").await;
            let (lit, dark) = (light(&picture, at), light(&picture, other));
            assert!(lit > 2.0 * dark, "{lit} and {dark}");
        }
        key(&tab, "l").await;
        assert!(!tab.eval::<bool>(&is_shown("spot")).await);

        // A drag turns, R goes back to the lesson.
        let turned =
            "e0.shadowRoot.querySelector('.back').getAttribute('aria-disabled') === 'false'";
        let turned = turned.replace(".back", "[part~=controls] [part~=back]");
        tab.drag((300.0, 200.0), (400.0, 200.0), 3).await;
        tab.wait_until(&turned, 20).await;
        assert_eq!(tab.eval::<u32>("e0.step").await, 1, "a drag is no press");
        key(&tab, "r").await;
        tab.wait_until(&format!("!({turned})"), 20).await;
        tab.click(700.0, 200.0).await;
        assert_eq!(tab.eval::<u32>("e0.step").await, 2, "a press walks on");
        tab.click(60.0, 200.0).await;
        assert_eq!(tab.eval::<u32>("e0.step").await, 1, "and back at the left");

        // The code of the step's link.
        key(&tab, "q").await;
        tab.wait_until(&is_shown("code"), 20).await;
        let link = format!(
            "{}/embed.html#{}&step=1",
            session.server.address(),
            payload(LESSON)
        );
        let read = read(&tab.picture("present_code").await);
        assert_eq!(read.as_deref(), Some(link.as_str()));
        let told: String = tab
            .eval(&format!("{ROOT}.querySelector('.code').textContent"))
            .await;
        assert!(told.contains(&link.len().to_string()), "{told}");
        key(&tab, "q").await;

        // The keyboard stays among the buttons, whose Enter is their own.
        key(&tab, "Tab").await;
        let active = "e0.shadowRoot.activeElement.getAttribute('aria-label')";
        assert_eq!(tab.eval::<String>(active).await, "Previous step");
        strike(&tab, 8, "Tab", None).await;
        assert_eq!(tab.eval::<String>(active).await, "End the presentation");

        key(&tab, "Escape").await;
        tab.wait_until(&format!("!({})", is_presenting()), 10).await;
        tab.wait_until(
            "document.fullscreenElement === null && innerHeight === 600",
            10,
        )
        .await;
        tab.frames(3).await;
        assert!(
            tab.eval::<bool>(&format!("{ROOT}.activeElement === {BUTTON}"))
                .await,
            "the keyboard is back on the button"
        );
        let step: u32 = tab.eval("(e0.step = 0)").await;
        assert_eq!(step, 0);
        rests_quietly(&tab).await;
        let after: String = tab.eval(state).await;
        let plain = |text: &str| {
            text.replace("It is whole.", "")
                .replace("The halves part.", "")
        };
        assert_eq!(plain(&after), plain(&before), "all is as it was");
        assert!(!tab.eval::<bool>("heard.includes('Escape')").await);
        tab.assert_no_complaints().await;
    });
}

/// A frame that forbids full screen is filled, and walked by fingers.
#[test]
fn a_frame_is_filled_and_walked_by_fingers() {
    with_browser(BrowserGpu::Software, |session| async move {
        let frame = format!(
            "<!doctype html><html lang=en><title>Host</title><meta name=viewport content=\"width=device-width\"><script>let drawn = 0; window.fabrica = {{ viewer: {{ frame: () => drawn, request_frame: () => requestAnimationFrame(() => (drawn += 1)) }} }};</script><h1>Host</h1><iframe id=it title=Lesson width=350 height=560 src=\"embed.html#{}\"></iframe>",
            payload(LESSON)
        );
        session.server.add("host.html", frame.into_bytes());
        let tab = session.open_coarse("host.html", (390, 700)).await;
        let viewer = "it.contentDocument?.querySelector('fabrica-viewer')";
        let part = |name: &str| format!("{viewer}?.shadowRoot.querySelector('{name}')");
        tab.wait_until(&format!("Boolean({})", part(".frame.ready")), 120)
            .await;
        bring_to_front(&tab).await;
        // A page that is longer than its frame has a scroll bar.
        let bar = "it.contentWindow.innerWidth - it.contentDocument.documentElement.clientWidth";
        let lengthen = "it.contentDocument.body.style.minHeight = '2000px'";
        assert!(tab.eval::<f64>(&format!("({lengthen}, {bar})")).await > 0.0);
        tab.eval::<bool>(&format!("({}.click(), true)", part("[part~=present]")))
            .await;
        tab.wait_until(&format!("Boolean({})", part(".presents .bar")), 20)
            .await;
        let [width, height]: [f64; 2] = tab
            .eval(&format!(
                "(({{ width, height }}) => [width, height])({}.getBoundingClientRect())",
                part(".frame")
            ))
            .await;
        assert_eq!([width, height], [350.0, 560.0], "the whole frame");
        assert_eq!(tab.eval::<f64>(bar).await, 0.0, "without a scroll bar");
        let touch = Touch::new(&tab).await;
        let [x, y]: [f64; 2] = tab
            .eval("(({ x, y }) => [x, y])(it.getBoundingClientRect())")
            .await;
        let step = format!("{viewer}.step");
        touch
            .swipe(&[[(x + 260.0, y + 200.0), (x + 90.0, y + 210.0)]])
            .await;
        tab.wait_until(&format!("{step} === 1"), 10).await;
        touch.tap_at((x + 250.0, y + 250.0)).await;
        tab.wait_until(&format!("{step} === 2"), 10).await;
        touch
            .swipe(&[[(x + 90.0, y + 200.0), (x + 260.0, y + 210.0)]])
            .await;
        tab.wait_until(&format!("{step} === 1"), 10).await;
        touch.tap_at((x + 30.0, y + 250.0)).await;
        tab.wait_until(&format!("{step} === 0"), 10).await;
        touch.tap_at((x + 250.0, y + 250.0)).await;
        tab.picture("present_phone").await;
        tab.eval::<bool>(&format!(
            "({}.click(), true)",
            part(".bar button:last-child")
        ))
        .await;
        tab.wait_until(&format!("!{}", part(".presents, .fills")), 10)
            .await;
        let focused: String = tab
            .eval(&format!(
                "{viewer}.shadowRoot.activeElement?.getAttribute('aria-label') ?? ''"
            ))
            .await;
        assert_ne!(focused, "Previous step");
        assert!(tab.eval::<f64>(bar).await > 0.0, "the page scrolls again");
        tab.assert_no_complaints().await;
    });
}
