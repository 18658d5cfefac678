//! A processor four times as slow: nothing that is clicked or typed is lost, however fast; how soon controls answer is
//! printed.

use super::hand::{Control, click, controls, document, find, focus, write};
use super::harness::{Tab, with_browser};
use super::*;
use chromiumoxide::cdp::browser_protocol::emulation::SetCpuThrottlingRateParams;
use chromiumoxide::cdp::browser_protocol::input::DispatchMouseEventType;
use serde::Deserialize;

/// Times as slow.
const SLOWER: f64 = 4.0;

const SIZE: (u32, u32) = (1280, 800);

/// A template, and a lesson of three steps about it.
const LESSON: &str = r#"{"fabrica":1,"title":"Slow","subject":{"builtin":"cube"},"templates":[{"kind":"peel","at":[0,0.2,0.2],"size":[0.6,0.5,0.4]}],"steps":[{"title":"one"},{"title":"two"},{"title":"three"}]}"#;

/// `window.answer(condition)` waits for the next press of a button or key, and tells milliseconds from it: until the
/// viewer has taken it in (the condition holds), has painted a whole frame after that, and the graphics device has
/// done all that was given to it until then.
const ANSWER: &str = r#"
window.answer = (condition) => new Promise((resolve) => {
  const viewer = window.fabrica.viewer;
  const begin = (event) => {
    for (const kind of ["pointerdown", "keydown"]) removeEventListener(kind, begin, true);
    const since = event.timeStamp;
    let taken = 0, frame = 0;
    const look = () => {
      const now = performance.now();
      if (!taken && condition()) [taken, frame] = [now, viewer.frame()];
      if (taken && viewer.frame() > frame) {
        const shown = performance.now();
        window.devices.at(-1).queue.onSubmittedWorkDone().then(() =>
          resolve([taken - since, shown - since, performance.now() - since]));
      } else if (now - since > 60000) resolve([-1, -1, -1]);
      else setTimeout(look, 2);
    };
    look();
  };
  for (const kind of ["pointerdown", "keydown"]) addEventListener(kind, begin, true);
});
true
"#;

/// Milliseconds from a press.
#[derive(Debug, Deserialize)]
struct Answer(f64, f64, f64);

/// A press and release with nothing in between.
async fn press_at(tab: &Tab, (x, y): (f64, f64)) {
    for (kind, held) in [
        (DispatchMouseEventType::MouseMoved, false),
        (DispatchMouseEventType::MousePressed, true),
        (DispatchMouseEventType::MouseReleased, true),
    ] {
        tab.mouse(kind, x, y, held).await;
    }
}

/// Presses at a place, and waits until the condition holds: how long that took is printed.
async fn answered(tab: &Tab, what: &str, at: (f64, f64), condition: &str) {
    // The hand comes to the place before it presses.
    tab.mouse(DispatchMouseEventType::MouseMoved, at.0, at.1, false)
        .await;
    tab.frames(2).await;
    let script = format!("window.answer(() => {{ {condition} }})");
    let (answer, ()) = tokio::join!(tab.eval::<Answer>(&script), press_at(tab, at));
    println!(
        "    {what}: taken in after {:.0} ms, painted after {:.0} ms, all drawn after {:.0} ms",
        answer.0, answer.1, answer.2
    );
    assert!(answer.0 >= 0.0, "{what} is never answered");
}

fn named<'a>(controls: &'a [Control], name: &str) -> &'a Control {
    let found = controls.iter().find(|control| control.name == name);
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
            .viewer_sized(&format!("#{}", payload(LESSON)), SIZE)
            .await;
        focus(&tab).await;
        tab.settled().await;
        tab.eval::<bool>(ANSWER).await;
        click(&tab, "1. Peel").await;
        find(&tab, "Progress slider").await;
        tab.settled().await;
        let throttle = SetCpuThrottlingRateParams::new(SLOWER);
        tab.page.execute(throttle).await.expect("a slow processor");

        // One by one, with the picture at rest before each: what changes it, and what does not.
        let seen = controls(&tab).await;
        let at = |name: &str, x: f64| named(&seen, name).corner(x, 0.5);
        let progress = format!(
            "{DOCUMENT} return Math.abs((d.templates[0].params?.progress ?? 0.5) - 0.8) < 0.05"
        );
        println!("with the picture at rest:");
        answered(&tab, "slider", at("Progress slider", 0.78), &progress).await;
        println!("while the picture is drawn:");
        let undone = format!("{DOCUMENT} return !d.templates[0].params?.progress");
        answered(&tab, "undo", at("Undo", 0.5), &undone).await;
        answered(&tab, "redo", at("Redo", 0.5), &progress).await;
        let hidden = format!("{DOCUMENT} return d.templates[0].enabled === false");
        answered(&tab, "hide", at("Hide", 0.5), &hidden).await;
        let step = "return window.fabrica.viewer.get_link().includes('&step=1')";
        answered(&tab, "next step", at("Next step", 0.5), step).await;
        let menu = "return window.fabrica.viewer.controls().includes('Save picture')";
        answered(&tab, "menu", at("More", 0.5), menu).await;
        tab.picture("slow_menu").await;
        let closed = "return !window.fabrica.viewer.controls().includes('Save picture')";
        answered(&tab, "menu away", at("Picture", 0.05), closed).await;
        let text = "return window.fabrica.viewer.controls().includes('Show the title')";
        answered(&tab, "panel", at("Panel: Text", 0.5), text).await;
        tab.settled().await;
        println!("with the picture at rest:");
        let titled = "return window.fabrica.viewer.controls().includes('Heading\\tSlow')";
        let check = find(&tab, "Show the title over the picture").await;
        answered(&tab, "check box", check.corner(0.03, 0.5), titled).await;
        answered(&tab, "menu", at("More", 0.5), menu).await;
        tab.eval::<bool>("true").await;
        answered(&tab, "menu away", at("Picture", 0.05), closed).await;
        answered(
            &tab,
            "step back",
            at("Step before", 0.5),
            "return !window.fabrica.viewer.get_link().includes('&step=')",
        )
        .await;

        burst(&tab).await;
        tab.assert_no_complaints().await;
    });
}

/// Everything at once, faster than any hand: no press waits for what came before it.
async fn burst(tab: &Tab) {
    click(tab, "Panel: Templates").await;
    click(tab, "1. Peel").await;
    find(tab, "Depth slider").await;
    let seen = controls(tab).await;
    let at = |name: &str, x: f64| named(&seen, name).corner(x, 0.5);
    let start = std::time::Instant::now();
    press_at(tab, at("Progress slider", 0.3)).await;
    press_at(tab, field_beside(named(&seen, "Depth slider"))).await;
    write(tab, "0.62").await;
    tab.key("Enter").await;
    // An odd number of times.
    for _ in 0..5 {
        press_at(tab, at("Show", 0.5)).await;
    }
    press_at(tab, field_beside(named(&seen, "Angle slider"))).await;
    write(tab, "95").await;
    tab.key("Enter").await;
    press_at(tab, at("Undo", 0.5)).await;
    press_at(tab, at("Redo", 0.5)).await;
    press_at(tab, at("Panel: Text", 0.5)).await;
    println!(
        "a burst of fourteen presses and eight keys within {:.1} s",
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
    assert!(
        number("progress").is_some_and(|p| (0.2..0.4).contains(&p)),
        "{template}"
    );
    assert_eq!(number("depth"), Some(0.62), "{template}");
    assert!(
        number("angle")
            .is_some_and(|a| (a - 95_f64.to_radians()).abs() < 1e-3 || (a - 95.0).abs() < 1e-3),
        "{template}"
    );
    assert_ne!(
        template["enabled"], false,
        "shown by the fifth press: {template}"
    );
}
