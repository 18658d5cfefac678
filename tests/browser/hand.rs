//! Hands for the browser tests: fingers, keys, and finding what is on the screen by its name, as whoever uses it does.

use super::compare::drawn_pixels;
use super::harness::Tab;
use chromiumoxide::cdp::browser_protocol::dom::SetFileInputFilesParams;
use chromiumoxide::cdp::browser_protocol::emulation::{
    SetFocusEmulationEnabledParams, SetTouchEmulationEnabledParams,
};
use chromiumoxide::cdp::browser_protocol::input::{DispatchKeyEventParams, DispatchKeyEventType};
use chromiumoxide::cdp::browser_protocol::page::{
    EventFileChooserOpened, SetInterceptFileChooserDialogParams,
};
use futures::StreamExt as _;
use serde_json::Value;
use std::path::Path;
use std::time::{Duration, Instant};

/// Lets time pass: only where time itself is what a test is about, or a hand is slow.
pub(crate) fn pause(milliseconds: u64) -> impl Future<Output = ()> {
    tokio::time::sleep(Duration::from_millis(milliseconds))
}

// ---------------------------------------------------------------------------------------------------- the document

/// The document that the page shows.
pub(crate) async fn document(tab: &Tab) -> Value {
    let text: String = tab.eval("window.fabrica.viewer.get_document()").await;
    serde_json::from_str(&text).expect("the viewer's document is JSON")
}

/// A part of the document as the page has it, as text.
fn part_text(part: &str) -> String {
    format!("JSON.stringify(JSON.parse(window.fabrica.viewer.get_document()).{part} ?? null)")
}

/// Keeps how a part of the document is now, for [`changed`].
pub(crate) async fn mark(tab: &Tab, part: &str) {
    tab.eval::<bool>(&format!("(window.marked = {}, true)", part_text(part)))
        .await;
}

/// Waits until a part of the document is another than when it was marked, and gives it.
pub(crate) async fn changed(tab: &Tab, part: &str) -> Value {
    let is_other = format!("{} !== window.marked", part_text(part));
    tab.wait_until(&is_other, 60).await;
    // A movement may not have ended.
    let mut before = document(tab).await;
    loop {
        tab.frames(4).await;
        let now = document(tab).await;
        if now == before {
            return now[part].clone();
        }
        before = now;
    }
}

/// Waits until the address and what the tab keeps are those of the document that is shown.
pub(crate) async fn kept(tab: &Tab) {
    let link = "window.fabrica.viewer.get_link()";
    tab.wait_until(
        &format!(
            "location.hash === '#' + {link} && sessionStorage.getItem('fabrica.document') === {link}"
        ),
        30,
    )
    .await;
}

/// Drops files of the server's together.
pub(crate) async fn drop_files(tab: &Tab, names: &[impl serde::Serialize]) {
    let list = serde_json::to_string(names).expect("text");
    let dropped: bool = tab
        .eval(&format!(
            "Promise.all({list}.map(n => fetch(n).then(r => r.blob()).then(b => new File([b], n)))).then(files => {{ const d = new DataTransfer(); files.forEach(f => d.items.add(f)); document.getElementById('fabrica').dispatchEvent(new DragEvent('drop', {{dataTransfer: d, bubbles: true, cancelable: true}})); return true; }})"
        ))
        .await;
    assert!(dropped, "the event was sent");
    tab.frames(2).await;
}

// ---------------------------------------------------------------------------------------------------- what is seen

/// A control that is on the screen.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Control {
    pub(crate) role: String,
    pub(crate) name: String,
    /// Left and top, CSS pixels.
    pub(crate) at: (f64, f64),
    pub(crate) size: (f64, f64),
}

impl Control {
    pub(crate) fn middle(&self) -> (f64, f64) {
        self.corner(0.5, 0.5)
    }

    /// A place in it, as parts of its size.
    pub(crate) fn corner(&self, x: f64, y: f64) -> (f64, f64) {
        (self.at.0 + x * self.size.0, self.at.1 + y * self.size.1)
    }
}

/// What the page shows as lines of text, see `controls` in src/shell/web.rs: as it is after all that was done before.
pub(crate) async fn listed(tab: &Tab) -> String {
    let lines = "window.fabrica.viewer.controls()";
    // Nothing is listed before the first call.
    let _asked: String = tab.eval(lines).await;
    tab.frames(2).await;
    tab.wait_until(&format!("{lines} !== ''"), 30).await;
    tab.eval(lines).await
}

/// Dismisses the messages over the picture. They go by themselves too, but stay long enough to be read.
pub(crate) async fn without_messages(tab: &Tab) {
    listed(tab).await;
    let script = "(() => {
        const viewer = window.fabrica.viewer;
        const found = JSON.parse(viewer.mirrored() || '[]').find((control) => control.name === 'Dismiss');
        if (found) viewer.act(found.id, 'click', '');
        return !viewer.controls().includes('Alert\\t');
    })()";
    tab.wait_until(script, 60).await;
}

/// Every control and text that the page shows.
pub(crate) async fn controls(tab: &Tab) -> Vec<Control> {
    let text = listed(tab).await;
    let control = |line: &str| {
        let parts: Vec<&str> = line.split('\t').collect();
        let number = |i: usize| parts.get(i)?.parse::<f64>().ok();
        Some(Control {
            role: (*parts.first()?).to_owned(),
            name: (*parts.get(1)?).to_owned(),
            at: (number(3)?, number(4)?),
            size: (number(5)?, number(6)?),
        })
    };
    text.lines().filter_map(control).collect()
}

/// The control of a name; `Picture` is the picture whatever it shows. Waits until it is there and stands still.
pub(crate) async fn find(tab: &Tab, name: &str) -> Control {
    let mut before = None;
    let mut seen = Vec::new();
    let start = Instant::now();
    while start.elapsed() < Duration::from_secs(60) {
        seen = controls(tab).await;
        let is_wanted = |c: &&Control| c.name == name || (name == "Picture" && c.role == "Image");
        let now = seen.iter().find(is_wanted).cloned();
        if let (Some(now), true) = (&now, now == before) {
            return now.clone();
        }
        before = now;
    }
    let names: Vec<&str> = seen.iter().map(|c| c.name.as_str()).collect();
    panic!("{name} is not on the screen; there are {names:?}");
}

/// Waits until an object is in the middle of the picture, and gives the page.
pub(crate) async fn scenery(tab: &Tab, name: &str) -> image::RgbaImage {
    let picture = find(tab, "Picture").await;
    let [left, top, width, height] =
        [picture.at.0, picture.at.1, picture.size.0, picture.size.1].map(|number| number as u32);
    // The middle third: neither bars nor messages lie over it.
    let middle = |page: &image::RgbaImage| {
        let (x, y) = (left + width / 3, top + height / 3);
        image::imageops::crop_imm(page, x, y, width / 3, height / 3).to_image()
    };
    let is_enough = |page: &image::RgbaImage| {
        let middle = middle(page);
        drawn_pixels(&middle) * 8 > middle.pixels().len()
    };
    tab.drawn(name, is_enough).await
}

// ---------------------------------------------------------------------------------------------------- the mouse

/// Clicks on the control of a name.
pub(crate) async fn click(tab: &Tab, name: &str) {
    let (x, y) = find(tab, name).await.middle();
    tab.click(x, y).await;
}

// ---------------------------------------------------------------------------------------------------- fingers

/// Fingers on the screen. Written out, since the library leaves an empty list of points away, which the end of a touch
/// needs.
#[derive(Debug)]
struct Fingers(Value);

impl serde::Serialize for Fingers {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.0.serialize(serializer)
    }
}

impl chromiumoxide::Method for Fingers {
    fn identifier(&self) -> chromiumoxide::types::MethodId {
        "Input.dispatchTouchEvent".into()
    }
}

impl chromiumoxide::Command for Fingers {
    type Response = Value;
}

/// A hand on a touch screen.
pub(crate) struct Touch<'a>(&'a Tab);

impl<'a> Touch<'a> {
    /// Makes the tab's screen one that can be touched.
    pub(crate) async fn new(tab: &'a Tab) -> Self {
        let mut emulation = SetTouchEmulationEnabledParams::new(true);
        emulation.max_touch_points = Some(5);
        tab.page.execute(emulation).await.expect("a touch screen");
        Self(tab)
    }

    /// Waits until there is something in the picture to be touched: its place is asked of what is drawn.
    pub(crate) async fn scenery(&self) {
        scenery(self.0, "touch_scenery").await;
    }

    async fn touch(&self, kind: &str, fingers: &[(f64, f64)]) {
        let points: Vec<Value> = fingers
            .iter()
            .enumerate()
            .map(|(id, (x, y))| serde_json::json!({ "x": x, "y": y, "id": id }))
            .collect();
        let event = serde_json::json!({ "type": kind, "touchPoints": points });
        self.0.page.execute(Fingers(event)).await.expect("a touch");
    }

    /// Fingers go from one place each to another, and are lifted.
    pub(crate) async fn swipe(&self, paths: &[[(f64, f64); 2]]) {
        let at = |t: f64| -> Vec<(f64, f64)> {
            paths
                .iter()
                .map(|[from, to]| (from.0 + (to.0 - from.0) * t, from.1 + (to.1 - from.1) * t))
                .collect()
        };
        self.touch("touchStart", &at(0.0)).await;
        for i in 1..=8 {
            // No faster than a hand: a list would be flung.
            pause(70).await;
            self.touch("touchMove", &at(f64::from(i) / 8.0)).await;
        }
        pause(70).await;
        self.touch("touchEnd", &[]).await;
        self.0.frames(3).await;
    }

    /// A tap on a place.
    pub(crate) async fn tap_at(&self, at: (f64, f64)) {
        self.touch("touchStart", &[at]).await;
        pause(90).await;
        self.touch("touchEnd", &[]).await;
        self.0.frames(3).await;
    }

    /// A tap on the control of a name.
    pub(crate) async fn tap(&self, name: &str) {
        let control = find(self.0, name).await;
        println!("tap on {control:?}");
        self.tap_at(control.middle()).await;
    }

    /// A finger rests on a place until a control of this name has come.
    pub(crate) async fn hold_for(&self, at: (f64, f64), name: &str) -> Control {
        self.touch("touchStart", &[at]).await;
        let came = find(self.0, name).await;
        self.touch("touchEnd", &[]).await;
        self.0.frames(3).await;
        came
    }

    /// Swipes in the drawer until a control stands within it; how many swipes that took.
    pub(crate) async fn scroll_to(&self, name: &str) -> u32 {
        let tabs = find(self.0, "Add").await;
        let picture = find(self.0, "Picture").await;
        let (top, bottom) = (picture.at.1 + picture.size.1, tabs.at.1);
        for i in 0..12 {
            let control = find(self.0, name).await;
            let (_, y) = control.middle();
            println!("{name} at {y}, the drawer from {top} to {bottom}");
            if y < bottom - 24.0 {
                return i;
            }
            // By the edge, where the names stand and not the sliders; each time from elsewhere, for what lies under the
            // finger may be drawn itself.
            let x = 22.0;
            let start = bottom - 75.0 - 45.0 * f64::from(i % 3);
            self.swipe(&[[(x, start), (x, top + 10.0)]]).await;
        }
        panic!("{name} does not come into the drawer");
    }
}

// ---------------------------------------------------------------------------------------------------- keys

/// Ctrl and Shift as the protocol counts them.
pub(crate) const CTRL: i64 = 2;
pub(crate) const SHIFT: i64 = 8;

/// Keeps the key that was pressed last, for [`IS_PREVENTED`].
pub(crate) const KEEPS_KEYS: &str =
    "(addEventListener('keydown', (event) => { window.struck = event; }, true), true)";
/// The browser's own answer to that key was prevented.
pub(crate) const IS_PREVENTED: &str = "window.struck.defaultPrevented";

/// The window is in front: what is focused in the page has the keyboard.
pub(crate) async fn bring_to_front(tab: &Tab) {
    let emulation = SetFocusEmulationEnabledParams::new(true);
    tab.page
        .execute(emulation)
        .await
        .expect("a window in front");
}

/// Gives the picture the keyboard, as a browser's window does that is in front.
pub(crate) async fn focus(tab: &Tab) {
    bring_to_front(tab).await;
    tab.eval::<bool>("(document.getElementById('fabrica').focus(), true)")
        .await;
    tab.frames(2).await;
}

/// A key with others held; `command` is what the browser's own editing would do with it.
pub(crate) async fn press_with(tab: &Tab, modifiers: i64, key: &str, command: Option<&str>) {
    strike(tab, modifiers, key, command).await;
    tab.frames(2).await;
}

/// The same, without waiting for the page to deal with it.
pub(crate) async fn strike(tab: &Tab, modifiers: i64, key: &str, command: Option<&str>) {
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
        // Without a code the page takes it for what a phone's keyboard sends while it composes.
        let code = match key {
            "Enter" => 13,
            "Tab" => 9,
            "Escape" => 27,
            "ArrowLeft" => 37,
            "ArrowUp" => 38,
            "ArrowRight" => 39,
            "ArrowDown" => 40,
            "/" => 191,
            "]" => 221,
            _ => i64::from(key.to_ascii_uppercase().as_bytes()[0]),
        };
        params.windows_virtual_key_code = Some(code);
        if kind == DispatchKeyEventType::KeyDown {
            if is_letter && modifiers & CTRL == 0 {
                params.text = Some(key.to_owned());
            }
            params.commands = command.map(|command| vec![command.to_owned()]);
        }
        tab.page.execute(params).await.expect("a key");
    }
}

pub(crate) async fn press(tab: &Tab, key: &str) {
    press_with(tab, 0, key, None).await;
}

/// Types a text, as fast as the browser takes the keys: no letter waits for a frame.
pub(crate) async fn write(tab: &Tab, text: &str) {
    for letter in text.chars() {
        for kind in [DispatchKeyEventType::KeyDown, DispatchKeyEventType::KeyUp] {
            let mut params = DispatchKeyEventParams::new(kind.clone());
            params.key = Some(letter.to_string());
            params.windows_virtual_key_code = Some(match letter {
                // The number of the letter is that of the key that deletes.
                '.' => 190,
                _ => i64::from(letter.to_ascii_uppercase() as u32),
            });
            params.text = (kind == DispatchKeyEventType::KeyDown).then(|| letter.to_string());
            tab.page.execute(params).await.expect("a key");
        }
    }
    tab.frames(2).await;
}

/// Waits until the page says something aloud.
pub(crate) async fn hear(tab: &Tab, wanted: &str) {
    let said = "document.getElementById('said').textContent";
    tab.wait_until(&format!("{said}.includes('{wanted}')"), 20)
        .await;
}

/// From now on the test chooses the files that the tab asks for.
pub(crate) async fn choose_files(tab: &Tab) {
    let intercept = SetInterceptFileChooserDialogParams::new(true);
    let intercepted = tab.page.execute(intercept).await;
    intercepted.expect("the test chooses the files");
}

/// Chooses a file in the dialog that `ask` opens.
pub(crate) async fn choose_file(tab: &Tab, file: &Path, ask: impl Future<Output = ()>) {
    let listener = tab.page.event_listener::<EventFileChooserOpened>();
    let mut opened = listener.await.expect("the dialog is told of");
    ask.await;
    let dialog = tokio::time::timeout(Duration::from_secs(20), opened.next());
    let dialog = dialog.await.expect("a dialog opens").expect("a dialog");
    let mut files = SetFileInputFilesParams::new(vec![file.display().to_string()]);
    files.backend_node_id = dialog.backend_node_id;
    tab.page.execute(files).await.expect("a file is given");
}

/// The text on the clipboard once it has come.
pub(crate) async fn clipboard(tab: &Tab, start: &str) -> String {
    let read = "navigator.clipboard.readText().catch(error => String(error))";
    let start = serde_json::to_string(start).expect("text");
    let wanted = format!("{read}.then(text => text.startsWith({start}))");
    tab.wait_until(&wanted, 30).await;
    tab.eval(read).await
}

/// What the page last said aloud.
async fn spoken(tab: &Tab) -> String {
    tab.eval("document.getElementById('said').textContent")
        .await
}

/// Goes on with the tabulator until the page says that the keyboard has come to what is wanted.
pub(crate) async fn tab_to(tab: &Tab, wanted: &str) {
    walk_to(tab, 0, wanted).await;
}

/// The same backwards.
pub(crate) async fn tab_back_to(tab: &Tab, wanted: &str) {
    walk_to(tab, SHIFT, wanted).await;
}

async fn walk_to(tab: &Tab, modifiers: i64, wanted: &str) {
    let mut heard = Vec::new();
    for _ in 0..60 {
        let before = spoken(tab).await;
        press_with(tab, modifiers, "Tab", None).await;
        let mut said = spoken(tab).await;
        for _ in 0..20 {
            if said != before {
                break;
            }
            tab.frames(2).await;
            said = spoken(tab).await;
        }
        if said.contains(wanted) {
            return;
        }
        heard.push(said);
    }
    panic!("the keyboard never came to {wanted}; it was at {heard:?}");
}
