//! A processor four times as slow: nothing that is clicked or typed is lost, however fast it comes and whatever the
//! picture is at. How soon controls answer is printed where `FABRICA_LONG` is set.

use super::hand::{Control, click, controls, document, find, focus, strike, write};
use super::harness::{Session, Tab, with_browser};
use super::*;
use chromiumoxide::cdp::browser_protocol::emulation::SetCpuThrottlingRateParams;
use chromiumoxide::cdp::browser_protocol::input::DispatchMouseEventType;
use serde::Deserialize;
use std::time::Instant;

/// Times as slow.
const SLOWER: f64 = 4.0;

/// Size of the page, CSS pixels: all panels beside a picture that a software GPU soon completes.
const SIZE: (u32, u32) = (800, 760);

/// A template, and a lesson of three steps about it.
const LESSON: &str = r#"{"fabrica":1,"title":"Slow","subject":{"builtin":"cube"},"templates":[{"kind":"peel","at":[0,0.2,0.2],"size":[0.6,0.5,0.4]}],"steps":[{"title":"one"},{"title":"two"},{"title":"three"}]}"#;

/// `window.answer(condition)` waits until a condition holds after the next click, and tells milliseconds from its
/// release: until the page began to deal with it, until the condition held, until the frame that shows it was handed to
/// the graphics device, and until the device had done all of it. The condition is looked at after each event and frame:
/// the viewer deals with a release in its event, and the next frame paints what came of it.
const ANSWER: &str = r#"
const soon = new MessageChannel();
const ask = window.requestAnimationFrame;
let busy = 0;
window.requestAnimationFrame = (f) => ask.call(window, (t) => {
  const start = performance.now();
  f(t);
  busy += performance.now() - start;
  soon.port2.postMessage(start);
});
const events = [];
const observer = new PerformanceObserver((list) => events.push(...list.getEntries()));
observer.observe({ type: "event", durationThreshold: 16 });
for (const kind of ["pointerdown", "pointerup", "keydown"])
  addEventListener(kind, (event) => {
    window.press = [event.timeStamp, performance.now()];
    busy = 0;
    soon.port2.postMessage(0);
  }, true);
window.answer = (condition) => new Promise((resolve) => {
  window.press = null;
  let taken = 0;
  soon.port1.onmessage = ({ data: frame }) => {
    if (!window.press) return;
    const [since, begun] = window.press;
    const now = performance.now();
    if (!taken && condition()) taken = now;
    // A frame that began before the release may be told of after it.
    if (!taken || frame < begun) return;
    soon.port1.onmessage = null;
    const frames = busy;
    window.devices.at(-1).queue.onSubmittedWorkDone().then(() => {
      const drawn = performance.now();
      events.push(...observer.takeRecords());
      const handled = events.filter((e) => e.startTime >= since - 1);
      const own = handled.reduce((sum, e) => sum + e.processingEnd - e.processingStart, frames);
      resolve([...[begun, taken, now, drawn].map((time) => time - since), own]);
    });
  };
});
true
"#;

/// Milliseconds from the release of a button.
#[derive(Debug, Deserialize)]
struct Answer {
    begun: f64,
    taken: f64,
    painted: f64,
    drawn: f64,
    /// Of the time until it was painted, what the page itself was busy: the rest was waiting for the browser and the
    /// graphics device.
    busy: f64,
}

/// A press and release as fast as the browser takes them.
async fn press_at(tab: &Tab, (x, y): (f64, f64)) {
    tab.mouse(DispatchMouseEventType::MouseMoved, x, y, false)
        .await;
    tokio::join!(
        tab.mouse(DispatchMouseEventType::MousePressed, x, y, true),
        tab.mouse(DispatchMouseEventType::MouseReleased, x, y, true)
    );
}

/// Presses at a place, and waits until the condition holds: how long that took is printed.
async fn answered(tab: &Tab, what: &str, at: (f64, f64), condition: &str) {
    // The hand comes to the place before it presses.
    tab.mouse(DispatchMouseEventType::MouseMoved, at.0, at.1, false)
        .await;
    tab.frames(2).await;
    let is_at_rest: bool = tab.eval("window.fabrica.viewer.is_at_rest()").await;
    // The page waits for the press before it comes.
    let script = format!("window.answered = window.answer(() => {{ {condition} }}); true");
    tab.eval::<bool>(&script).await;
    press_at(tab, at).await;
    let answer: Answer = tab.eval("window.answered").await;
    println!(
        "{what:<12} while the picture {}: begun after {:3.0} ms, taken in {:3.0}, painted {:4.0} (busy {:3.0}), drawn {:4.0}",
        if is_at_rest {
            "is at rest"
        } else {
            "refines   "
        },
        answer.begun,
        answer.taken,
        answer.painted,
        answer.busy,
        answer.drawn
    );
}

fn named<'a>(controls: &'a [Control], name: &str) -> &'a Control {
    let is_it =
        |control: &&Control| control.name == name || (name == "Picture" && control.role == "Image");
    let found = controls.iter().find(is_it);
    found.unwrap_or_else(|| panic!("{name} is not on the screen: {controls:?}"))
}

/// The field of the number at the right of a slider.
fn field_beside(slider: &Control) -> (f64, f64) {
    let (x, y) = slider.corner(1.0, 0.5);
    (x + 30.0, y)
}

const DOCUMENT: &str = "const d = JSON.parse(window.fabrica.viewer.get_document() || '{}');";

#[test]
fn a_slow_processor_loses_nothing() {
    with_browser(BrowserGpu::Software, |session| async move {
        let tab = session
            .refining_viewer(&format!("#{}", payload(LESSON)), SIZE)
            .await;
        focus(&tab).await;
        tab.frames(3).await;
        if is_long() {
            let first = find(&tab, "1. Peel").await;
            click(&tab, "1. Peel").await;
            find(&tab, "Progress slider").await;
            let seen = controls(&tab).await;
            tab.page.close().await.expect("the tab closes");
            return one_by_one(&session, &seen, first.middle()).await;
        }
        click(&tab, "1. Peel").await;
        find(&tab, "Progress slider").await;
        slow_down(&tab).await;
        click(&tab, "Hide 1. Peel").await;
        // No more selected, as below.
        click(&tab, "1. Peel").await;
        at_once(&tab).await;
        tab.assert_no_complaints().await;
    });
}

async fn slow_down(tab: &Tab) {
    let throttle = SetCpuThrottlingRateParams::new(SLOWER);
    tab.page.execute(throttle).await.expect("a slow processor");
}

/// What changes the picture, and what does not; each is answered. The places of the controls, once the row at `first`
/// is open, come from another tab: whoever asks for the list of controls has it made in every frame from then on, which
/// takes part of the time that is measured here.
async fn one_by_one(session: &Session, seen: &[Control], first: (f64, f64)) {
    let tab = session
        .refining_viewer(&format!("#{}", payload(LESSON)), SIZE)
        .await;
    focus(&tab).await;
    tab.frames(3).await;
    tab.eval::<bool>(ANSWER).await;
    press_at(&tab, first).await;
    tab.frames(3).await;
    slow_down(&tab).await;
    let tab = &tab;
    let at = |name: &str, x: f64| named(seen, name).corner(x, 0.5);
    let progress = format!(
        "{DOCUMENT} return Math.abs((d.templates[0].params?.progress ?? 0.5) - 0.8) < 0.05"
    );
    answered(tab, "slider", at("Progress slider", 0.78), &progress).await;
    let undone = format!("{DOCUMENT} return !d.templates[0].params?.progress");
    answered(tab, "undo", at("Undo", 0.5), &undone).await;
    answered(tab, "redo", at("Redo", 0.5), &progress).await;
    let hidden = format!("{DOCUMENT} return d.templates[0].enabled === false");
    answered(tab, "hide", at("Hide 1. Peel", 0.5), &hidden).await;
    let step = "return window.fabrica.viewer.get_link().includes('&step=1')";
    answered(tab, "next step", at("Next step", 0.5), step).await;
    let back = "return !window.fabrica.viewer.get_link().includes('&step=')";
    answered(tab, "step back", at("Step before", 0.5), back).await;
    // These ask for the list.
    let menu = "return window.fabrica.viewer.controls().includes('Save picture')";
    answered(tab, "menu", at("More", 0.5), menu).await;
    tab.picture("slow_menu").await;
    let closed = "const seen = window.fabrica.viewer.controls(); return seen !== '' && !seen.includes('Save picture')";
    answered(tab, "menu away", at("Picture", 0.05), closed).await;
    let text = "return window.fabrica.viewer.controls().includes('Show the title')";
    answered(tab, "panel", at("Panel: Text", 0.5), text).await;
    at_once(tab).await;
    tab.assert_no_complaints().await;
}

/// Everything at once, faster than any hand: no press waits for what came before it.
async fn at_once(tab: &Tab) {
    click(tab, "Panel: Templates").await;
    click(tab, "1. Peel").await;
    find(tab, "Depth slider").await;
    let seen = controls(tab).await;
    let at = |name: &str, x: f64| named(&seen, name).corner(x, 0.5);
    let start = Instant::now();
    press_at(tab, at("Progress slider", 0.3)).await;
    press_at(tab, field_beside(named(&seen, "Depth slider"))).await;
    write(tab, "0.62").await;
    strike(tab, 0, "Enter", None).await;
    // An odd number of times.
    for _ in 0..5 {
        press_at(tab, at("Show 1. Peel", 0.5)).await;
    }
    press_at(tab, field_beside(named(&seen, "Angle slider"))).await;
    write(tab, "95").await;
    strike(tab, 0, "Enter", None).await;
    // There is something to be done again only once the first press was answered.
    press_at(tab, at("Undo", 0.5)).await;
    press_at(tab, at("Redo", 0.5)).await;
    press_at(tab, at("Panel: Text", 0.5)).await;
    println!(
        "fifteen presses and eight keys within {:.1} s",
        start.elapsed().as_secs_f32()
    );
    tab.wait_until(
        "window.fabrica.viewer.controls().includes('Show the title')",
        60,
    )
    .await;
    let after = document(tab).await;
    let template = &after["templates"][0];
    let number = |name: &str| template["params"][name].as_f64();
    let progress = number("progress");
    assert!(
        progress.is_some_and(|p| (0.2..0.4).contains(&p)),
        "{template}"
    );
    assert_eq!(number("depth"), Some(0.62), "{template}");
    let angle = number("angle");
    assert!(
        angle.is_some_and(|a| (a - 95_f64.to_radians()).abs() < 1e-3),
        "{template}"
    );
    assert_ne!(template["enabled"], false, "{template}");
}
