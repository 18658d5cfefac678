//! The reader: illustrations as elements in somebody else's page.

use super::author::to_front;
use super::film::Film;
use super::hand::{Touch, bring_to_front, pause, strike};
use super::harness::{Session, Tab};
use super::parts::small_scan;
use super::*;
use chromiumoxide::cdp::browser_protocol::emulation::SetCpuThrottlingRateParams;
use chromiumoxide::cdp::browser_protocol::input::{
    DispatchMouseEventParams, DispatchMouseEventType,
};

/// A lesson of the cube with a value that its readers may move.
pub(crate) const LESSON: &str = r#"{"fabrica":1,"title":"Opening a cube","caption":"It is whole.","subject":{"builtin":"cube"},"templates":[{"kind":"split","size":[1.2,1.2,1.2],"params":{"amount":0}}],"labels":[{"at":[0.3,0.49,0.3],"text":"A corner"},{"at":[0,0,0],"text":"Its middle"}],"controls":[{"pointer":"/templates/0/params/amount","name":"Gap"},{"pointer":"/templates/0/enabled","name":"Split at all"}],"steps":[{"title":"Apart","caption":"The halves part.","set":{"/templates/0/params/amount":0.3}},{"title":"Nearer","set":{"/camera/distance":1.8}}]}"#;

/// Counts what a page makes on its graphics device, its workers, frames and timers. Stands before all other scripts.
const LEDGER: &[u8] = br"
window.ledger = { textures: new Map(), buffers: new Map(), devices: new Set(), workers: new Set(), pipelines: 0, frames: 0, due: new Set(), timers: 0 };
const bytesPerTexel = (format) => ({ r8unorm: 1, r8uint: 1, r16float: 2, r16uint: 2, rg8unorm: 2, r32float: 4, r32uint: 4, rg16float: 4, rgba16float: 8, rg32float: 8, rgba32float: 16 })[format] ?? 4;
function sizeOf({ size, format, mipLevelCount = 1 }) {
  const [width, height = 1, depth = 1] = Array.isArray(size) ? size : [size.width, size.height, size.depthOrArrayLayers];
  return width * height * depth * bytesPerTexel(format) * (mipLevelCount > 1 ? 1.34 : 1);
}
if (window.GPUDevice) {
  for (const [name, kept, bytes] of [['createTexture', 'textures', sizeOf], ['createBuffer', 'buffers', ({ size }) => size]]) {
    const make = GPUDevice.prototype[name];
    GPUDevice.prototype[name] = function (descriptor) {
      const made = make.call(this, descriptor);
      ledger[kept].set(made, { bytes: bytes(descriptor), device: this, label: descriptor.label });
      const destroy = made.destroy;
      made.destroy = function () { ledger[kept].delete(made); return destroy.call(this); };
      return made;
    };
  }
  for (const name of ['createRenderPipeline', 'createComputePipeline']) {
    const make = GPUDevice.prototype[name];
    GPUDevice.prototype[name] = function (descriptor) { ledger.pipelines += 1; return make.call(this, descriptor); };
  }
  const request = GPUAdapter.prototype.requestDevice;
  GPUAdapter.prototype.requestDevice = async function (...wanted) {
    const device = await request.apply(this, wanted);
    ledger.devices.add(device);
    const destroy = device.destroy;
    device.destroy = function () {
      ledger.devices.delete(device);
      for (const kept of ['textures', 'buffers']) for (const [made, of] of ledger[kept]) if (of.device === device) ledger[kept].delete(made);
      return destroy.call(this);
    };
    return device;
  };
}
const plainFrame = window.requestAnimationFrame.bind(window);
const Plain = window.Worker;
window.Worker = class extends Plain {
  constructor(...args) { super(...args); ledger.workers.add(this); }
  terminate() { ledger.workers.delete(this); super.terminate(); }
};
for (const name of ['setTimeout', 'setInterval']) {
  const plain = window[name];
  window[name] = (...args) => { ledger.timers += 1; return plain(...args); };
}
window.requestAnimationFrame = (act) => {
  ledger.frames += 1;
  const id = plainFrame((time) => { ledger.due.delete(id); act(time); });
  ledger.due.add(id);
  return id;
};
const plainCancel = window.cancelAnimationFrame.bind(window);
window.cancelAnimationFrame = (id) => { ledger.due.delete(id); plainCancel(id); };
ledger.bytes = () => ['textures', 'buffers'].flatMap((kept) => [...ledger[kept].values()]).reduce((sum, { bytes }) => sum + bytes, 0);
ledger.volumes = () => [...ledger.textures.values()].filter(({ label }) => label === 'volume').length;
// For the waits of the tests: frames of the browser.
let drawn = 0;
window.fabrica = { viewer: { frame: () => drawn, request_frame: () => plainFrame(() => (drawn += 1)) } };
window.told = [];
for (const name of ['ready', 'stepchange', 'paramchange', 'viewchange', 'error']) {
  document.addEventListener(name, (event) => window.told.push([name, event.target.id, event.detail]));
}
";

/// A page with embeds of these attributes, the first with the id `e0`, under the policy that the documentation names.
fn page_of(embeds: &[String], between: &str) -> String {
    let embeds: Vec<String> = embeds
        .iter()
        .enumerate()
        .map(|(index, rest)| format!("<fabrica-viewer id=e{index} {rest}</fabrica-viewer>"))
        .collect();
    format!(
        "<!doctype html><html lang=en><meta name=viewport content=\"width=device-width\"><meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; connect-src 'self'; worker-src 'self'; img-src 'self' data:; style-src 'self'\"><link rel=stylesheet href=tall.css><title>A lesson</title><script src=ledger.js></script><script type=module src=fabrica-viewer.js></script><main><h1>A lesson</h1>{}</main></html>",
        embeds.join(between)
    )
}

pub(crate) fn lesson(attributes: &str) -> String {
    format!("src=\"#{}\" {attributes}>", payload(LESSON))
}

/// A page with these embeds.
pub(crate) async fn open(
    session: &Session,
    embeds: &[String],
    between: &str,
    size: (u32, u32),
) -> Tab {
    serve(session, embeds, between);
    session.open_sized("lesson.html", size).await
}

/// The same with coarse pictures: for tests of what an embed does, not of how it looks.
pub(crate) async fn open_coarse(
    session: &Session,
    embeds: &[String],
    between: &str,
    size: (u32, u32),
) -> Tab {
    serve(session, embeds, between);
    session.open_coarse("lesson.html", size).await
}

/// The same with pictures of half the size along a side, which are compared.
pub(crate) async fn open_half(
    session: &Session,
    embeds: &[String],
    between: &str,
    size: (u32, u32),
) -> Tab {
    serve(session, embeds, between);
    session.open_half("lesson.html", size).await
}

/// Serves such a page under another policy, with the second text in place of the first.
pub(crate) fn serve_where(session: &Session, name: &str, embeds: &[String], policy: [&str; 2]) {
    serve(session, embeds, "");
    let page = page_of(embeds, "").replace(policy[0], policy[1]);
    session.server.add(name, page.into_bytes());
}

fn serve(session: &Session, embeds: &[String], between: &str) {
    session.server.add("ledger.js", LEDGER.to_vec());
    session.server.add(
        "tall.css",
        b".tall { height: 5000px } .narrow { max-width: 200px; margin: 40px auto }".to_vec(),
    );
    let page = page_of(embeds, between);
    session.server.add("lesson.html", page.into_bytes());
}

/// Waits until so many embeds have told that they are ready.
pub(crate) async fn ready(tab: &Tab, number: usize) {
    tab.wait_until(
        &format!("window.told.filter(([name]) => name === 'ready' || name === 'error').length >= {number}"),
        240,
    )
    .await;
    let faults: Vec<serde_json::Value> = tab
        .eval("window.told.filter(([name]) => name === 'error')")
        .await;
    assert!(faults.is_empty(), "{faults:?}");
    // Captions are placed with the first picture that there is.
    let blank: Vec<String> = tab
        .eval("[...document.querySelectorAll('fabrica-viewer')].filter(({ shadowRoot }) => shadowRoot?.querySelector('.ready .layer')?.style.visibility === 'hidden').map(({ id }) => id)")
        .await;
    assert!(blank.is_empty(), "ready without a picture: {blank:?}");
}

/// The place of an embed's picture: left, top, width, height, CSS pixels.
pub(crate) async fn stage(tab: &Tab, embed: &str) -> [f64; 4] {
    tab.eval(&format!(
        "(({{ x, y, width, height }}) => [x, y, width, height])({embed}.shadowRoot.querySelector('.stage').getBoundingClientRect())"
    ))
    .await
}

/// The middle of an embed's picture.
pub(crate) async fn middle(tab: &Tab, embed: &str) -> (f64, f64) {
    let [x, y, width, height] = stage(tab, embed).await;
    (x + 0.5 * width, y + 0.5 * height)
}

/// The picture of an embed as it gives it away.
pub(crate) async fn picture_of(tab: &Tab, embed: &str) -> image::RgbaImage {
    let url: String = tab.eval(&format!("{embed}.toDataURL()")).await;
    let data = url.strip_prefix("data:image/png;base64,").expect("a PNG");
    let picture = image::load_from_memory(&from_base64(data)).expect("a PNG");
    picture.to_rgba8()
}

/// Waits until an embed is complete and at rest at a step.
pub(crate) async fn rests_at(tab: &Tab, embed: &str, step: usize) {
    let at = format!(
        "{embed}.step === {step} && Number({embed}.shadowRoot.querySelector('[part=scrub]').value) === {step}"
    );
    tab.wait_until(&at, 120).await;
    rests_quietly(tab).await;
}

/// The element draws under a strict policy, walks its steps, takes values and gives its picture; its captions are text.
#[test]
fn an_embed_walks_its_steps_and_takes_values() {
    with_browser(BrowserGpu::Software, |session| async move {
        let tab = open(&session, &[lesson("controls")], "", (320, 700)).await;
        ready(&tab, 1).await;
        rests_at(&tab, "e0", 0).await;
        tab.picture("embed_whole").await;
        let whole = picture_of(&tab, "e0").await;
        let titles: Vec<String> = tab.eval("e0.steps.map(({ title }) => title)").await;
        assert_eq!(titles, ["Apart", "Nearer"]);
        let words = "e0.shadowRoot.querySelector('canvas').getAttribute('aria-label')";
        tab.wait_until(&format!("({words} ?? '').includes('In sight')"), 60)
            .await;
        let captions: Vec<String> = tab
            .eval("[...e0.shadowRoot.querySelectorAll('ol[part=captions] li')].map((li) => li.textContent)")
            .await;
        assert_eq!(captions[0], "A corner");
        assert!(
            captions[1].starts_with("Its middle ("),
            "inside of the cube: {captions:?}"
        );

        tab.eval::<bool>("(e0.next(), true)").await;
        rests_at(&tab, "e0", 1).await;
        tab.picture("embed_apart").await;
        let apart = picture_of(&tab, "e0").await;
        assert!(
            difference(&whole, &apart, WHITE).mean > 1.0,
            "the step is seen"
        );
        tab.eval::<bool>("(e0.step = 9, true)").await;
        rests_at(&tab, "e0", 2).await;
        let told: Vec<u32> = tab
            .eval("told.filter(([name]) => name === 'stepchange').map(([, , { step }]) => step)")
            .await;
        assert_eq!(
            told,
            [1, 2],
            "each change is told once, where the page can hear it"
        );

        // What the step sets, set by the page itself, is the same picture; wrong values change nothing.
        tab.eval::<bool>("(e0.step = 0, true)").await;
        rests_at(&tab, "e0", 0).await;
        let set = |pointer: &str, value: &str| {
            format!(
                "(() => {{ try {{ e0.setParam('{pointer}', {value}); return ''; }} catch (e) {{ return String(e); }} }})()"
            )
        };
        for (pointer, value) in [
            ("/templates/0/params/amount", "'wide'"),
            ("/templates/7/params/amount", "1"),
            ("nothing", "1"),
            ("/subject/builtin", "7"),
        ] {
            let refused: String = tab.eval(&set(pointer, value)).await;
            assert!(!refused.is_empty(), "{pointer}: {value} is refused");
        }
        assert_eq!(
            tab.eval::<String>(&set("/templates/0/params/amount", "0.3"))
                .await,
            ""
        );
        rests_at(&tab, "e0", 0).await;
        let by_page = picture_of(&tab, "e0").await;
        let off = difference(&by_page, &apart, WHITE).mean;
        assert!(
            off < 0.5,
            "the page's own value draws what the step draws: {off}"
        );
        let slider: f64 = tab
            .eval("Number(e0.shadowRoot.querySelector('[part=slider]').value)")
            .await;
        assert!((slider - 0.3).abs() < 0.01, "its control follows: {slider}");
        tab.eval::<bool>("(e0.reset(), true)").await;
        rests_at(&tab, "e0", 0).await;
        let back = picture_of(&tab, "e0").await;
        assert!(
            difference(&whole, &back, WHITE).mean < 0.1,
            "back to the lesson"
        );

        // A lost device comes back to the same picture.
        let before = tab.picture("embed_before_the_loss").await;
        tab.eval::<bool>("(told.length = 0, devices.at(-1).destroy(), true)")
            .await;
        let stands = "((root) => root.querySelector('.lost .layer')?.style.visibility === 'hidden' && getComputedStyle(root.querySelector('.paper')).display === 'block')(e0.shadowRoot)";
        tab.wait_until(stands, 20).await;
        tab.wait_until("devices.length === 2 && ledger.devices.size === 1", 60)
            .await;
        rests_at(&tab, "e0", 0).await;
        let after = tab.picture("embed_after_the_loss").await;
        let off = difference(&before, &after, WHITE).mean;
        assert!(off < 0.2, "the same picture after a loss: {off}");
        assert_eq!(
            tab.eval::<usize>("told.length").await,
            0,
            "nothing is told of it"
        );

        // Behind another tab a lesson that plays asks for no frame and holds no timer.
        tab.eval::<bool>("(e0.play(), true)").await;
        let other = session.open("icon.svg").await;
        tab.wait_until("document.hidden", 20).await;
        pause(1000).await;
        tab.eval::<bool>("(ledger.frames = ledger.timers = 0, true)")
            .await;
        pause(2000).await;
        let asked: [u32; 2] = tab.eval("[ledger.frames, ledger.timers]").await;
        assert_eq!(asked, [0, 0]);
        other.page.close().await.expect("the tab closes");
        to_front(&tab).await;
        tab.wait_until("e0.step > 0", 20).await;
        tab.eval::<bool>("(e0.pause(), e0.step = 0, true)").await;
        rests_at(&tab, "e0", 0).await;

        // Another lesson of the same subject is shown on the same device, from the same volume.
        let volumes: Vec<u32> = tab.eval("[ledger.devices.size, ledger.volumes()]").await;
        let plain = payload(PLAIN);
        tab.eval::<bool>(&format!(
            "(told.length = 0, e0.setAttribute('src', '#{plain}'), true)"
        ))
        .await;
        ready(&tab, 1).await;
        assert_eq!(tab.eval::<u32>("e0.steps.length").await, 0);
        assert_eq!(
            tab.eval::<Vec<u32>>("[ledger.devices.size, ledger.volumes()]")
                .await,
            volumes
        );
        assert_eq!(
            tab.eval::<u32>("localStorage.length + sessionStorage.length")
                .await,
            0,
            "nothing is stored"
        );
        tab.assert_no_complaints().await;
    });
}

/// Eight embeds of one subject share a device and a volume, and leave the page its wheel, its keyboard and its menu.
/// Removed, they give everything back.
#[test]
fn many_embeds_are_guests_and_share_what_they_need() {
    with_browser(BrowserGpu::Software, |session| async move {
        let one = open(&session, &[lesson("")], "", (216, 700)).await;
        ready(&one, 1).await;
        rests_quietly(&one).await;
        let [alone, made]: [f64; 2] = one.eval("[ledger.bytes(), ledger.pipelines]").await;

        one.page.close().await.expect("the tab closes");

        for width in long_or(vec![390, 1280], vec![390]) {
            let embeds: Vec<String> = (0..8).map(|_| lesson("class=narrow")).collect();
            let tab = open(&session, &embeds, "<p>Between.</p>", (width, 700)).await;
            // What is far below is drawn when it comes near.
            for index in 0..8 {
                tab.eval::<bool>(&format!("(e{index}.scrollIntoView(), true)"))
                    .await;
                tab.wait_until(
                    &format!("(e{index}.scrollIntoView(), told.some(([name, id]) => name === 'ready' && id === 'e{index}'))"),
                    120,
                )
                .await;
            }
            rests_quietly(&tab).await;
            let found: [f64; 5] = tab
                .eval(
                    "[ledger.devices.size, ledger.volumes(), ledger.workers.size, ledger.bytes(), ledger.pipelines]",
                )
                .await;
            println!("{width}: {found:?}, alone {alone}, {made} pipelines");
            assert_eq!(
                found[..3],
                [1.0, 1.0, 0.0],
                "one device, one volume, no worker"
            );
            assert_eq!(found[4], made, "programs are compiled once for all");
            assert!(found[3] <= 1.3 * alone, "{} bytes, {alone} alone", found[3]);
            assert!(
                tab.eval::<bool>("document.activeElement === document.body")
                    .await,
                "nobody took the keyboard"
            );
            let _: bool = tab.eval("(globalThis.prevented = 0, addEventListener('contextmenu', (event) => { prevented += event.defaultPrevented; }), true)").await;
            let fingers = match width {
                390 => Some(Touch::new(&tab).await),
                _ => None,
            };
            for index in 0..8 {
                let embed = format!("e{index}");
                // Away from the page's nearer end.
                let way = if index < 4 { 120.0 } else { -120.0 };
                tab.eval::<bool>(&format!(
                    "({embed}.scrollIntoView({{ block: 'center' }}), true)"
                ))
                .await;
                tab.frames(2).await;
                let (x, y) = middle(&tab, &embed).await;
                let before: f64 = tab.eval("scrollY").await;
                let mut wheel =
                    DispatchMouseEventParams::new(DispatchMouseEventType::MouseWheel, x, y);
                (wheel.delta_x, wheel.delta_y) = (Some(0.0), Some(way));
                tab.page.execute(wheel).await.expect("a wheel");
                tab.wait_until(&format!("scrollY !== {before}"), 10).await;
                let Some(fingers) = &fingers else { continue };
                // Until the wheel's way is at its end.
                tab.wait_until(
                    "(globalThis.last_y === scrollY) || ((globalThis.last_y = scrollY), false)",
                    10,
                )
                .await;
                tab.eval::<bool>(&format!(
                    "({embed}.scrollIntoView({{ block: 'center' }}), true)"
                ))
                .await;
                tab.frames(2).await;
                let (x, y) = middle(&tab, &embed).await;
                let before: f64 = tab.eval("scrollY").await;
                let there = y - 0.5 * way;
                fingers.swipe(&[[(x, y), (x, there)]]).await;
                tab.wait_until(&format!("scrollY !== {before}"), 10).await;
            }
            let moved: Vec<serde_json::Value> = tab
                .eval("told.filter(([name]) => name === 'viewchange')")
                .await;
            assert!(moved.is_empty(), "their cameras stay: {moved:?}");
            tab.eval::<bool>("(document.querySelectorAll('fabrica-viewer').forEach((it) => it.shadowRoot.querySelector('.stage').dispatchEvent(new MouseEvent('contextmenu', { bubbles: true, composed: true, cancelable: true }))), true)").await;
            assert_eq!(
                tab.eval::<u32>("prevented").await,
                0,
                "the menu is the browser's"
            );

            // At rest no frame is asked for and no timer is held.
            tab.eval::<bool>("(ledger.frames = 0, ledger.timers = 0, true)")
                .await;
            pause(5000).await;
            assert_eq!(
                tab.eval::<[u32; 2]>("[ledger.frames, ledger.timers]").await,
                [0, 0]
            );

            // A move in the document keeps everything; removal gives everything back.
            tab.eval::<bool>("(document.body.append(e0), true)").await;
            pause(1300).await;
            assert_eq!(tab.eval::<u32>("ledger.devices.size").await, 1);
            tab.eval::<bool>(
                "(document.querySelectorAll('fabrica-viewer').forEach((it) => it.remove()), true)",
            )
            .await;
            tab.wait_until("ledger.devices.size === 0", 10).await;
            assert_eq!(
                tab.eval::<[u32; 2]>("[ledger.textures.size, ledger.buffers.size]")
                    .await,
                [0, 0]
            );
            tab.assert_no_complaints().await;
            tab.page.close().await.expect("the tab closes");
        }
    });
}

pub(crate) async fn rests_quietly(tab: &Tab) {
    tab.wait_until(
        "(globalThis.quiet = ledger.due.size === 0 && ledger.frames === globalThis.was ? (globalThis.quiet ?? 0) + 1 : 0, globalThis.was = ledger.frames, globalThis.quiet > 8)",
        120,
    )
    .await;
}

/// A guest hears hands and keys only when its reader has entered it, and lets her out again.
#[test]
fn an_embed_is_entered_and_left() {
    with_browser(BrowserGpu::Software, |session| async move {
        let tab = open_coarse(&session, &[lesson("controls")], "", (320, 700)).await;
        bring_to_front(&tab).await;
        ready(&tab, 1).await;
        rests_quietly(&tab).await;
        let camera =
            "JSON.stringify(told.findLast(([name]) => name === 'viewchange')?.[2].view ?? null)";
        let inside = "e0.shadowRoot.querySelector('.stage').classList.contains('inside')";
        let active =
            "e0.shadowRoot.activeElement?.getAttribute('part') ?? document.activeElement.tagName";
        let (x, y) = middle(&tab, "e0").await;

        // Keys are the page's before; Enter leads in, Escape out.
        strike(&tab, 0, "Tab", None).await;
        assert_eq!(tab.eval::<String>(active).await, "stage");
        strike(&tab, 0, "ArrowLeft", None).await;
        assert_eq!(
            tab.eval::<String>(camera).await,
            "null",
            "outside an arrow is the page's"
        );
        strike(&tab, 0, "Enter", None).await;
        assert!(tab.eval::<bool>(inside).await);
        strike(&tab, 0, "ArrowLeft", None).await;
        tab.wait_until(&format!("{camera} !== 'null'"), 20).await;
        let side: String = tab
            .eval("e0.shadowRoot.querySelector('[role=status]').textContent")
            .await;
        assert!(side.starts_with("Seen from"), "{side}");
        // No key edits, and none opens an editor.
        tab.eval::<bool>("(told.length = 0, true)").await;
        for (modifiers, key) in [
            (0, "Delete"),
            (0, "Backspace"),
            (0, "g"),
            (0, "m"),
            (2, "z"),
            (2, "v"),
        ] {
            strike(&tab, modifiers, key, None).await;
        }
        rests_quietly(&tab).await;
        let changes: Vec<String> = tab
            .eval("told.map(([name]) => name).filter((name) => name !== 'viewchange')")
            .await;
        assert!(changes.is_empty(), "{changes:?}");
        let editor: usize = tab
            .eval("performance.getEntriesByType('resource').filter(({ name }) => name.includes('fabrica_bg.wasm')).length")
            .await;
        assert_eq!(editor, 0, "the editor is not fetched");
        strike(&tab, 0, "Escape", None).await;
        assert!(!tab.eval::<bool>(inside).await);

        // Through every control and out at the end.
        let mut seen = Vec::new();
        for _ in 0..40 {
            strike(&tab, 0, "Tab", None).await;
            let name: String = tab.eval("e0.shadowRoot.activeElement?.getAttribute('aria-label') ?? e0.shadowRoot.activeElement?.closest('label')?.textContent ?? ''").await;
            if name.is_empty() {
                break;
            }
            // A step and a value are within reach of the keyboard, too.
            match &*name {
                "Next step" => {
                    strike(&tab, 0, " ", None).await;
                    tab.wait_until("e0.step === 1", 20).await;
                }
                "Gap" => {
                    strike(&tab, 0, "ArrowRight", None).await;
                    tab.wait_until("told.some(([name]) => name === 'paramchange')", 20)
                        .await;
                }
                _ => {}
            }
            seen.push(name);
        }
        for wanted in [
            "Play",
            "Next step",
            "Place in the lesson",
            "Steps",
            "Turn to the left",
            "Closer",
            "Back to the lesson",
            "Full screen",
            "Gap",
            "Split at all",
        ] {
            assert!(
                seen.iter().any(|name| name == wanted),
                "{wanted} is missing in {seen:?}"
            );
        }
        assert!(seen.len() < 40, "Tab leads out: {seen:?}");
        // And out at the first end, to what stands before it.
        tab.eval::<bool>("(document.querySelector('h1').tabIndex = 0, e0.shadowRoot.querySelector('.stage').focus(), true)").await;
        strike(&tab, 8, "Tab", None).await;
        let before: String = tab.eval("document.activeElement.tagName").await;
        assert_eq!(before, "H1", "Shift and Tab lead out");

        // Controls speak the language of the page.
        let mut words = Vec::new();
        for lang in ["de", "es", "zh", "en"] {
            tab.eval::<bool>(&format!("(e0.lang = '{lang}', true)"))
                .await;
            let next = "e0.shadowRoot.querySelector('[part~=next]').title";
            words.push(tab.eval::<String>(next).await);
        }
        assert_eq!(
            words,
            ["Nächster Schritt", "Paso siguiente", "下一步", "Next step"]
        );

        // A mouse turns the object without entering; a click enters, the wheel zooms, a press elsewhere leaves.
        tab.eval::<bool>("(e0.reset(), told.length = 0, true)")
            .await;
        tab.drag((x - 60.0, y), (x + 60.0, y), 4).await;
        tab.wait_until(&format!("{camera} !== 'null'"), 20).await;
        assert!(!tab.eval::<bool>(inside).await, "a drag does not enter");
        tab.click(x, y + 30.0).await;
        assert!(tab.eval::<bool>(inside).await, "a click enters");
        tab.eval::<bool>("(told.length = 0, true)").await;
        let mut wheel = DispatchMouseEventParams::new(DispatchMouseEventType::MouseWheel, x, y);
        (wheel.delta_x, wheel.delta_y) = (Some(0.0), Some(-240.0));
        tab.page.execute(wheel).await.expect("a wheel");
        tab.wait_until(&format!("(JSON.parse({camera})?.distance ?? 9) < 2.3"), 20)
            .await;
        tab.click(240.0, 20.0).await;
        assert!(!tab.eval::<bool>(inside).await, "a press elsewhere leaves");

        // A caption's text can be selected, which neither turns the object nor enters it; the browser's search finds
        // it.
        tab.eval::<bool>("(e0.reset(), e0.step = 0, told.length = 0, true)")
            .await;
        rests_at(&tab, "e0", 0).await;
        let text = "e0.shadowRoot.querySelector('[part=caption]')";
        let [left, right, y]: [f64; 3] = tab
            .eval(&format!("(({{ left, right, top, height }}) => [left, right, top + height / 2])({text}.getBoundingClientRect())"))
            .await;
        tab.drag((left + 1.0, y), (right - 1.0, y), 4).await;
        let selected: String = tab.eval("getSelection().toString()").await;
        assert!(selected.contains("corner"), "selected: {selected:?}");
        assert_eq!(tab.eval::<String>(camera).await, "null", "nothing turns");
        assert!(!tab.eval::<bool>(inside).await);
        tab.eval::<bool>("(getSelection().empty(), true)").await;
        for (words, is_there) in [("A corner", true), ("Its middle", true), ("Its end", false)] {
            let found: bool = tab.eval(&format!("find('{words}')")).await;
            assert_eq!(found, is_there, "a search for {words:?}");
        }
        tab.assert_no_complaints().await;
    });
}

/// A finger scrolls the page over a picture that it has not entered, and turns the object after a tap.
#[test]
fn a_finger_scrolls_until_it_has_tapped() {
    with_browser(BrowserGpu::Software, |session| async move {
        let tall = "<div class=tall>Below</div>";
        let tab = open_coarse(
            &session,
            &[lesson(""), "hidden>".to_owned()],
            tall,
            (390, 600),
        )
        .await;
        let touch = Touch::new(&tab).await;
        ready(&tab, 1).await;
        let (x, y) = middle(&tab, "e0").await;
        touch.swipe(&[[(x, y + 60.0), (x, y - 60.0)]]).await;
        assert!(tab.eval::<f64>("scrollY").await > 20.0, "the page scrolls");
        assert_eq!(
            tab.eval::<usize>("told.filter(([name]) => name === 'viewchange').length")
                .await,
            0
        );
        tab.eval::<bool>("(scrollTo(0, 0), true)").await;
        touch.tap_at((x, y)).await;
        tab.wait_until(
            "e0.shadowRoot.querySelector('.stage').classList.contains('inside')",
            10,
        )
        .await;
        touch.swipe(&[[(x, y + 60.0), (x, y - 60.0)]]).await;
        tab.wait_until("told.some(([name]) => name === 'viewchange')", 20)
            .await;
        assert_eq!(
            tab.eval::<f64>("scrollY").await,
            0.0,
            "inside the finger is the object's"
        );
        tab.assert_no_complaints().await;
    });
}

/// Subjects that are more than the page may hold give way, those first that were not used for the longest time. Their
/// pictures stay, and they come again where they are touched.
#[test]
fn subjects_beyond_the_budget_give_way_and_come_again() {
    with_browser(BrowserGpu::Software, |session| async move {
        let names = ["a.nrrd", "b.nrrd", "c.nrrd"];
        let of = |name: &str| {
            session.server.add(name, small_scan());
            // In halves, so that it is seen whether it was turned.
            let document = format!(
                r#"{{"fabrica":1,"subject":{{"src":"{name}"}},"templates":[{{"kind":"split","size":[1.2,1.2,1.2],"params":{{"amount":0.3}}}}]}}"#
            );
            format!("class=narrow src=\"#{}\">", payload(&document))
        };
        let tab = open(&session, &names.map(of), "", (320, 900)).await;
        ready(&tab, 3).await;
        rests_quietly(&tab).await;
        assert_eq!(tab.eval::<usize>("ledger.volumes()").await, 3);
        // The first is in use.
        let (x, y) = middle(&tab, "e0").await;
        tab.drag((x + 30.0, y), (x, y), 4).await;
        rests_quietly(&tab).await;
        let before = tab.picture("embed_budget").await;
        let budget = "import('./reader/engine.js').then(({ theEngine }) => theEngine()).then((engine) => { engine.reader.set_budget(1); engine.release(); return true; })";
        tab.eval::<bool>(budget).await;
        assert_eq!(
            tab.eval::<usize>("ledger.volumes()").await,
            1,
            "of the picture in use"
        );
        let still = tab.picture("embed_budget_kept").await;
        let change = difference(&before, &still, WHITE);
        assert!(change.mean < 0.01, "the others' pictures stay: {change:?}");
        for (index, name) in names.into_iter().enumerate() {
            let embed = format!("e{index}");
            let asked = || {
                let asked = session.server.asked();
                asked.iter().filter(|path| path[1..] == *name).count()
            };
            let before_turn = asked();
            tab.eval::<bool>("(told.length = 0, true)").await;
            let (x, y) = middle(&tab, &embed).await;
            tab.drag((x - 40.0, y), (x + 40.0, y), 4).await;
            let turned =
                format!("told.some(([name, id]) => name === 'viewchange' && id === '{embed}')");
            tab.wait_until(&turned, 20).await;
            rests_quietly(&tab).await;
            tab.wait_until("ledger.volumes() === 1 && ledger.workers.size === 0", 60)
                .await;
            rests_quietly(&tab).await;
            let again = asked() - before_turn;
            assert_eq!(
                again,
                usize::from(index > 0),
                "{name}: the first was in use"
            );
            let after = tab.picture(&format!("embed_budget_{index}")).await;
            let [left, top, width, height] = stage(&tab, &embed).await.map(|v| v as u32);
            let part = |page| image::imageops::crop_imm(page, left, top, width, height).to_image();
            let change = difference(&part(&before), &part(&after), WHITE);
            assert!(change.mean > 1.0, "{embed} was turned: {change:?}");
        }
        tab.assert_no_complaints().await;
    });
}

/// A page of a narrow window with one lesson of these attributes, around its poster.
async fn open_poster(session: &Session, attributes: &str, poster: &str) -> Tab {
    let embeds = [format!("{}{poster}", lesson(attributes))];
    open_coarse(session, &embeds, "", (320, 700)).await
}

/// The poster is content of the element: there before the program, until the first whole picture.
#[test]
fn a_poster_stays_until_there_is_a_picture() {
    with_browser(BrowserGpu::Software, |session| async move {
        let poster = "<img src=icon.svg alt=Poster width=64 height=48><p>What is to be seen.</p>";
        let tab = open_poster(&session, "controls", poster).await;
        let is_shown = "e0.querySelector('img').checkVisibility()";
        assert!(
            tab.eval::<bool>(&format!("{is_shown} || told.length > 0"))
                .await
        );
        ready(&tab, 1).await;
        tab.wait_until(
            &format!("!{is_shown} && !e0.querySelector('p').checkVisibility()"),
            10,
        )
        .await;
        tab.picture("embed_after_poster").await;

        // A tap, and nearness, start what waits for them.
        let wasm = "performance.getEntriesByType('resource').filter(({ name }) => name.endsWith('.wasm')).length";
        let tap = open_poster(&session, "loading=tap", poster).await;
        tap.frames(20).await;
        assert_eq!(tap.eval::<u32>(wasm).await, 0);
        tap.eval::<bool>("(e0.shadowRoot.querySelector('button').click(), true)")
            .await;
        ready(&tap, 1).await;
        let far = "<div class=tall></div>";
        let lazy = open_coarse(
            &session,
            &["hidden loading=lazy>".to_owned(), lesson("loading=lazy")],
            far,
            (320, 700),
        )
        .await;
        lazy.frames(20).await;
        assert_eq!(lazy.eval::<u32>(wasm).await, 0);
        lazy.eval::<bool>("(e1.scrollIntoView(), true)").await;
        ready(&lazy, 1).await;
    });
}

/// Of an embed's picture: the share that has the colours of the poster, and the share that has the background of the
/// illustration.
fn poster_and_ground(page: &image::RgbaImage, place: [f64; 4]) -> [f32; 2] {
    let [left, top, width, height] = place.map(|v| v as u32);
    let part = image::imageops::crop_imm(page, left, top, width, height).to_image();
    let share = |color: [u8; 3]| {
        let is_it = |p: &&image::Rgba<u8>| (0..3).all(|k| p[k].abs_diff(color[k]) <= 8);
        part.pixels().filter(is_it).count() as f32 / part.pixels().len() as f32
    };
    [share(POSTER), share(GROUND)]
}

const POSTER: [u8; 3] = [200, 0, 160];
const GROUND: [u8; 3] = [0x10, 0x50, 0x28];

/// The poster is painted where scripts are blocked, and before a byte of the program has come; no frame between it and
/// the picture is blank.
#[test]
fn no_frame_is_blank_from_the_poster_to_the_picture() {
    with_browser(BrowserGpu::Software, |session| async move {
        let mut png = Vec::new();
        let [r, g, b] = POSTER;
        image::RgbImage::from_pixel(64, 48, image::Rgb([r, g, b]))
            .write_to(&mut std::io::Cursor::new(&mut png), image::ImageFormat::Png)
            .expect("a PNG");
        session.server.add("poster.png", png);
        let json =
            r##"{"fabrica":1,"subject":{"builtin":"cube"},"look":{"background":"#105028"}}"##;
        let embed = format!(
            "src=\"#{}\"><img src=poster.png alt=Poster width=64 height=48><p>What is to be seen.</p>",
            payload(json)
        );
        let policy = ["script-src 'self' 'wasm-unsafe-eval'", "script-src 'none'"];
        serve_where(
            &session,
            "blocked.html",
            std::slice::from_ref(&embed),
            policy,
        );
        let image = "document.querySelector('fabrica-viewer img')";
        let place = format!(
            "(({{ x, y, width, height }}) => [x, y, width, height])({image}.getBoundingClientRect())"
        );
        // Without the element's style the poster has a size of its own.
        let blocked = session.open_sized("blocked.html", (320, 500)).await;
        blocked
            .wait_until(&format!("{image}?.complete === true"), 20)
            .await;
        let shown = blocked.picture("embed_poster_blocked").await;
        let [poster, _] = poster_and_ground(&shown, blocked.eval(&place).await);
        assert!(poster > 0.95, "{poster} of the poster without scripts");
        let text: String = blocked.text().await;
        assert!(text.contains("What is to be seen."), "{text}");
        blocked.page.close().await.expect("the tab closes");

        let program = "fabrica_reader_bg.wasm";
        session.server.hold(program, true);
        let tab = open(&session, &[embed], "", (320, 500)).await;
        bring_to_front(&tab).await;
        let is_asked = || {
            session
                .server
                .asked()
                .iter()
                .any(|path| path.contains(program))
        };
        while !is_asked() {
            tab.frames(2).await;
        }
        let place: [f64; 4] = tab.eval(&place).await;
        let shown = tab.picture("embed_poster_waiting").await;
        let [poster, _] = poster_and_ground(&shown, place);
        assert!(poster > 0.95, "{poster} of the poster on a slow connection");
        let film = Film::start(&tab).await;
        // Slow, so that data come to the device in pieces.
        let throttle = SetCpuThrottlingRateParams::new(6.0);
        tab.page.execute(throttle).await.expect("a slow processor");
        session.server.hold(program, false);
        ready(&tab, 1).await;
        rests_quietly(&tab).await;
        // The browser sends frames a little later than it shows them.
        film.shows(|frame| poster_and_ground(frame, place)[1] > 0.2)
            .await;
        let frames = film.end().await;
        let shares: Vec<[f32; 2]> = frames
            .iter()
            .map(|frame| poster_and_ground(frame, place))
            .collect();
        let is_other = |pair: &&[[f32; 2]]| pair[0] != pair[1];
        let changes: Vec<_> = shares.windows(2).filter(is_other).collect();
        println!("{} frames, changes: {changes:?}", shares.len());
        let (first, last) = (shares[0], shares[shares.len() - 1]);
        assert!(
            first[0] > 0.95 && last[1] > 0.2 && last[0] == 0.0,
            "{changes:?}"
        );
        let blank = shares
            .iter()
            .find(|[poster, ground]| *poster < 0.95 && *ground < 0.8 * last[1]);
        assert!(blank.is_none(), "a frame has neither: {blank:?}");
        // The page around it is blank, and is found to be that.
        let [x, y, width, height] = place;
        let around = poster_and_ground(&frames[0], [x, y + height + 20.0, width, 40.0]);
        assert_eq!(around, [0.0, 0.0]);
        tab.assert_no_complaints().await;
    });
}

/// Where there is no WebGPU the poster stays, and title, caption and steps are there as text.
#[test]
fn an_embed_without_webgpu_gives_words() {
    with_browser(BrowserGpu::None, |session| async move {
        let poster = "<img src=icon.svg alt=Poster><p>What is to be seen.</p>";
        let embeds = [
            format!("{}{poster}", lesson("")),
            lesson("poster=icon.svg"),
            lesson(""),
        ];
        let tab = open(&session, &embeds, "", (320, 1400)).await;
        tab.wait_until("told.filter(([name]) => name === 'error').length === 3", 60)
            .await;
        let own =
            "e0.querySelector('img').checkVisibility() && e0.querySelector('p').checkVisibility()";
        assert!(tab.eval::<bool>(own).await);
        tab.picture("embed_without_webgpu").await;
        // The stage is as high as a picture where it shows a poster, and is not there without one.
        let heights: Vec<f64> = tab
            .eval("[e0, e1, e2].map((it) => it.shadowRoot.querySelector('.stage').getBoundingClientRect().height)")
            .await;
        assert!(
            heights[0] > 100.0 && heights[1] > 100.0 && heights[2] == 0.0,
            "{heights:?}"
        );
        for embed in ["e0", "e1", "e2"] {
            let text: String = tab
                .eval(&format!(
                    "{embed}.shadowRoot.querySelector('.words').innerText"
                ))
                .await;
            for wanted in [
                "Opening a cube: It is whole.",
                "Apart: The halves part.",
                "WebGPU",
            ] {
                assert!(text.contains(wanted), "{embed}: {wanted}: {text}");
            }
        }
        let seen = "e1.shadowRoot.querySelector('img.poster')?.checkVisibility() ?? false";
        assert!(tab.eval::<bool>(seen).await, "the poster of the attribute");
        tab.eval::<bool>("(e1.removeAttribute('poster'), true)")
            .await;
        assert!(!tab.eval::<bool>(seen).await, "it goes with the attribute");
        tab.eval::<bool>("(e1.setAttribute('poster', 'icon.svg'), true)")
            .await;
        assert!(tab.eval::<bool>(seen).await, "and comes with it");
    });
}

/// What is wrong is named in the embed and by an event, is text, and leaves the others alone.
#[test]
fn wrong_embeds_say_so_and_leave_the_others_running() {
    with_browser(BrowserGpu::Software, |session| async move {
        session
            .server
            .add("broken.json", b"{ \"fabrica\": 1, \"camera\": 7 }".to_vec());
        session.server.add(
            "hostile.json",
            br#"{"fabrica":1,"title":"<img src=x onerror=alert(1)>","caption":"</p><script>window.ran=1</script>","subject":{"builtin":"cube"},"labels":[{"at":[0.4,0.4,0.4],"text":"<b onmouseover=alert(1)>b</b>"}],"controls":[{"pointer":"/templates/3/params/x","name":"<i>"},{"pointer":"/camera/fov","name":"<u>Lens</u>","min":20,"max":60}],"steps":[{"title":"<script>window.ran=1</script>"}]}"#.to_vec(),
        );
        let embeds = [
            "src=broken.json>".to_owned(),
            "src=missing.json>".to_owned(),
            "src=\"#AAAAAAAAAAAAAAAAAAAAAAAA\">".to_owned(),
            "src=\"javascript:alert(1)\">".to_owned(),
            "src=hostile.json controls>".to_owned(),
            lesson("step=77"),
            lesson("loading=tap step=abc"),
            lesson("loading=tap step=1"),
        ];
        let tab = open_coarse(&session, &embeds, "", (320, 900)).await;
        tab.wait_until("told.filter(([name]) => name === 'error').length >= 5", 120)
            .await;
        // A step counts before there is a picture. A wrong one is told, one that is taken away is none.
        let of = "told.filter(([name, id]) => name === 'error' && id === 'e6')";
        let told: Vec<String> = tab
            .eval(&format!("{of}.map(([, , detail]) => detail.message)"))
            .await;
        assert_eq!(told, ["abc is not the number of a step"]);
        let steps: Vec<u32> = tab
            .eval(&format!(
                "(e6.removeAttribute('step'), e7.next(), [e6.step, e7.step, {of}.length])"
            ))
            .await;
        assert_eq!(steps, [0, 2, 1]);
        for index in 4..6 {
            tab.eval::<bool>(&format!("(e{index}.scrollIntoView(), true)"))
                .await;
            tab.wait_until(
                &format!("(e{index}.scrollIntoView(), told.some(([name, id]) => name === 'ready' && id === 'e{index}'))"),
                120,
            )
            .await;
        }
        for (index, wanted) in ["/camera", "404", "link", "javascript"].iter().enumerate() {
            let text: String = tab
                .eval(&format!(
                    "e{index}.shadowRoot.querySelector('.words').textContent"
                ))
                .await;
            assert!(text.contains(wanted), "{index}: {text}");
        }
        assert_eq!(tab.eval::<u32>("e5.step").await, 2, "the last step");
        tab.eval::<bool>("(e5.step = -3, e5.step = 'x', true)")
            .await;
        assert_eq!(tab.eval::<u32>("e5.step").await, 2);
        let made: u32 = tab
            .eval(
                "e4.shadowRoot.querySelectorAll('img, script, b, i, u').length + (window.ran ?? 0)",
            )
            .await;
        assert_eq!(made, 0, "text is text");
        let names: Vec<String> = tab
            .eval("[...e4.shadowRoot.querySelectorAll('[part=name]')].map((it) => it.textContent)")
            .await;
        assert_eq!(
            names,
            ["<u>Lens</u>"],
            "a control without a value is left out"
        );

        // A graphics device that never comes back is told of in each embed, under the last picture. Another source
        // starts anew.
        let seen = drawn_pixels(&part_of(&tab, "e5", "before_it_is_gone").await);
        tab.eval::<bool>("(told.length = 0, navigator.gpu.requestAdapter = async () => null, devices.at(-1).destroy(), true)")
            .await;
        let lost = "told.filter(([name, , { message }]) => name === 'error' && message.includes('lost')).length === 2";
        tab.wait_until(lost, 60).await;
        let text: String = tab
            .eval("e5.shadowRoot.querySelector('.words').textContent")
            .await;
        assert!(text.contains("lost"), "{text}");
        let still = drawn_pixels(&part_of(&tab, "e5", "gone").await);
        assert!(seen > 1000 && still * 10 > seen * 7, "{still} of {seen} px");
        tab.eval::<bool>(&format!(
            "(told.length = 0, delete navigator.gpu.requestAdapter, e5.setAttribute('src', '#{}'), true)",
            payload(PLAIN)
        ))
        .await;
        tab.wait_until("told.length > 0", 120).await;
        let told: Vec<(String, String)> = tab.eval("told.map(([name, id]) => [name, id])").await;
        assert_eq!(told[0], ("ready".to_owned(), "e5".to_owned()));
    });
}

/// What is seen of an embed in the page.
pub(crate) async fn part_of(tab: &Tab, embed: &str, name: &str) -> image::RgbaImage {
    tab.eval::<bool>(&format!(
        "({embed}.shadowRoot.querySelector('.stage').scrollIntoView(), true)"
    ))
    .await;
    let [left, top, width, height] = stage(tab, embed).await.map(|px| px as u32);
    let page = tab.picture(name).await;
    image::imageops::crop_imm(&page, left, top, width, height).to_image()
}
