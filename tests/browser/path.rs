//! The first path of a new author on a scan of their own, with the mouse and by touch: open, make bone, peel the skin
//! from it, label, title, save the picture, copy the link, open that elsewhere. Seconds and presses are printed.

use super::hand::{self, Touch, clipboard, document, find, focus, scenery, write};
use super::harness::{Session, Tab, root, with_browser};
use super::*;
use chromiumoxide::cdp::browser_protocol::browser::{
    SetDownloadBehaviorBehavior, SetDownloadBehaviorParams,
};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// How the author works.
#[derive(Clone, Copy, PartialEq)]
enum With {
    Mouse,
    Fingers,
}

impl With {
    const fn name(self) -> &'static str {
        match self {
            Self::Mouse => "mouse",
            Self::Fingers => "touch",
        }
    }

    /// Size of the page, CSS pixels.
    const fn size(self) -> (u32, u32) {
        match self {
            Self::Mouse => (1280, 800),
            Self::Fingers => (390, 844),
        }
    }

    /// Clicks, or taps and swipes, that the path takes at most. A drawer of the phone is opened by a tap where the wide
    /// window has its panels beside the picture.
    const fn most_presses(self) -> u32 {
        match self {
            Self::Mouse => 13,
            Self::Fingers => 18,
        }
    }
}

/// A wait of this length has to be told in words.
const PATIENCE: Duration = Duration::from_secs(2);

const NAME_OF_SCAN: &str = "CT head";

/// True once the document has a subject of its own, and nothing that the page shows is provisional.
const IS_OPENED: &str =
    "JSON.parse(window.fabrica.viewer.get_document() || '{}').subject?.sha256 !== undefined";

/// What is told of a wait: the lines of the controls that are a state, a progress or a message.
const TOLD: &str = "window.fabrica.viewer.controls().split('\\n').filter((line) => /^(Status|ProgressIndicator|Alert)\\t/.test(line)).map((line) => line.split('\\t')[1])";

/// What is told of work that has not ended.
const AT_WORK: &str = "window.fabrica.viewer.controls().split('\\n').filter((line) => /^(Status|ProgressIndicator)\\t/.test(line))";

/// Somebody on the path, who counts.
struct Author<'a> {
    tab: &'a Tab,
    touch: Option<Touch<'a>>,
    with: With,
    presses: u32,
    /// When the stage began, and the presses before it.
    since: (Instant, u32),
}

impl<'a> Author<'a> {
    async fn new(tab: &'a Tab, with: With) -> Self {
        focus(tab).await;
        let touch = match with {
            With::Mouse => None,
            With::Fingers => Some(Touch::new(tab).await),
        };
        hand::choose_files(tab).await;
        Self {
            tab,
            touch,
            with,
            presses: 0,
            since: (Instant::now(), 0),
        }
    }

    async fn press_at(&mut self, at: (f64, f64)) {
        self.presses += 1;
        match &self.touch {
            Some(touch) => touch.tap_at(at).await,
            None => self.tab.click(at.0, at.1).await,
        }
    }

    /// A click or a tap on the control of a name, which has to be within the window.
    async fn press(&mut self, name: &str) {
        let control = find(self.tab, name).await;
        let at = control.middle();
        let (width, height) = self.with.size();
        assert!(
            (0.0..f64::from(width)).contains(&at.0) && (0.0..f64::from(height)).contains(&at.1),
            "{name} is out of the window: {control:?}"
        );
        self.press_at(at).await;
    }

    /// A click or a tap into the field under a heading.
    async fn press_field(&mut self, heading: &str) {
        let lines = hand::listed(self.tab).await;
        let place = |line: &str| -> Option<[f64; 4]> {
            let mut numbers = line.split('\t').skip(3).map(|part| part.parse().ok());
            Some([
                numbers.next()??,
                numbers.next()??,
                numbers.next()??,
                numbers.next()??,
            ])
        };
        let over = lines
            .lines()
            .find(|line| line.split('\t').nth(2) == Some(heading));
        let over = over
            .and_then(place)
            .unwrap_or_else(|| panic!("no {heading}: {lines}"));
        // The middle of the field's first line.
        let at = (over[0] + 60.0, over[1] + over[3] + 22.0);
        self.press_at(at).await;
    }

    /// A place on the face, as parts of the box around what is drawn in the colours of skin and bone.
    async fn face_at(&self, x: f64, y: f64) -> (f64, f64) {
        let picture = find(self.tab, "Picture").await;
        let page = self.tab.picture("path_face").await;
        let is_warm = |p: &image::Rgba<u8>| i32::from(p.0[0]) - i32::from(p.0[2]) > 20;
        let [left, top] = [picture.at.0 as u32, picture.at.1 as u32];
        let [width, height] = [picture.size.0 as u32, picture.size.1 as u32];
        // The ball of axes, which has such colours too, is not between these.
        let (inner, outer) = (left + width * 3 / 10, left + width * 7 / 10);
        let row = |y: u32| {
            (inner..outer)
                .filter(|x| is_warm(page.get_pixel(*x, y)))
                .count()
        };
        let rows: Vec<u32> = (top..top + height).filter(|y| row(*y) > 20).collect();
        let column = |x: u32| {
            let is_face = |y: &&u32| is_warm(page.get_pixel(x, **y));
            rows.iter().filter(is_face).count()
        };
        let columns: Vec<u32> = (left..left + width).filter(|x| column(*x) > 20).collect();
        let part = |range: &[u32], t: f64| {
            let (first, last) = (range.first(), range.last());
            let (first, last) = first.zip(last).expect("a face");
            f64::from(*first) + t * f64::from(last - first)
        };
        (part(&columns, x), part(&rows, y))
    }

    /// Swipes until the control stands in the drawer; in a wide window it does already.
    async fn scroll_to(&mut self, name: &str) {
        let Some(touch) = &self.touch else { return };
        self.presses += touch.scroll_to(name).await;
    }

    /// The panel of a name: beside the picture, or a drawer over it.
    async fn show(&mut self, panel: &str) {
        match self.with {
            With::Mouse => self.press(&format!("Panel: {panel}")).await,
            With::Fingers => self.press(panel).await,
        }
        // The drawer may still be on its way.
        self.tab.frames(10).await;
    }

    /// Waits, and sees to it that the page tells why.
    async fn wait(&self, what: &str, until: &str, seconds: u64) {
        let start = Instant::now();
        let mut told: Vec<String> = Vec::new();
        let (mut silent_since, mut silence) = (start, Duration::ZERO);
        while !self.tab.eval::<bool>(until).await {
            let late = start.elapsed() > Duration::from_secs(seconds);
            assert!(!late, "{what} takes more than {seconds} s; told: {told:?}");
            let now: Vec<String> = self.tab.eval(TOLD).await;
            if now.is_empty() {
                silence = silence.max(silent_since.elapsed());
            } else {
                silent_since = Instant::now();
            }
            for line in now {
                if !told.contains(&line) {
                    told.push(line);
                }
            }
            hand::pause(50).await;
        }
        let took = start.elapsed();
        println!(
            "    waited {:.1} s: {what}; without a word for {:.1} s; told: {told:?}",
            took.as_secs_f32(),
            silence.as_secs_f32()
        );
        assert!(
            took < PATIENCE || !told.is_empty(),
            "{what}: {:.1} s without a word",
            took.as_secs_f32()
        );
    }

    /// Waits until no work is told of any more.
    async fn wait_for_work(&self, what: &str) {
        self.tab.frames(3).await;
        let is_done = format!("{AT_WORK}.length === 0");
        self.wait(what, &is_done, 300).await;
    }

    /// Chooses a file in the dialog that a press on the control opens.
    async fn choose(&mut self, button: &str, file: &Path) {
        let tab = self.tab;
        hand::choose_file(tab, file, self.press(button)).await;
    }

    /// Opens the scan, as the bar offers it.
    async fn open(&mut self, file: &Path) {
        if self.with == With::Mouse {
            self.choose("Open", file).await;
        } else {
            self.press("More").await;
            self.choose("Open a file", file).await;
        }
        self.wait("the scan opens", IS_OPENED, 120).await;
        self.wait_for_work("the scan is on the graphics device")
            .await;
    }

    /// Waits for the picture that is being saved where `FABRICA_LONG` is set. The tests of all together have no
    /// time for that on a software GPU: there it is stopped once it has come further.
    async fn save(&mut self, folder: &Path) {
        let is_told = |words: &str| format!("{TOLD}.some((line) => line.includes('{words}'))");
        if is_long() {
            let is_saved = is_told("downloads");
            self.wait("the picture is saved", &is_saved, 500).await;
            self.stage("6_saved").await;
            assert_saved(folder);
            return;
        }
        let percent =
            "(window.fabrica.viewer.controls().match(/Saving the picture… (\\d+) %/)?.[1] ?? -1)";
        self.wait("saving begins", &format!("{percent} >= 0"), 60)
            .await;
        self.wait("saving goes on", &format!("{percent} >= 2"), 120)
            .await;
        self.stage("6_saving").await;
        // The author of a finished picture does not stop it: no press that counts.
        self.press("Stop saving").await;
        self.presses -= 1;
        self.wait("saving stops", &is_told("Saving was stopped"), 30)
            .await;
        self.stage("6_stopped").await;
    }

    /// Ends a stage: what it took, and a picture of the page.
    async fn stage(&mut self, name: &str) {
        let (since, before) = self.since;
        println!(
            "{} {name}: {:.1} s, {} presses",
            self.with.name(),
            since.elapsed().as_secs_f32(),
            self.presses - before
        );
        let picture = format!("path_{}_{name}", self.with.name());
        self.tab.picture(&picture).await;
        self.since = (Instant::now(), self.presses);
    }
}

/// A folder into which the session's pages save, without asking.
pub(super) async fn downloads(session: &Session, name: &str) -> PathBuf {
    let folder = root().join("target/e2e").join(format!("saved_{name}"));
    let _nothing_there = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).expect("a folder for what is saved");
    let mut params = SetDownloadBehaviorParams::new(SetDownloadBehaviorBehavior::Allow);
    params.browser_context_id = Some(session.context.clone());
    params.download_path = Some(folder.display().to_string());
    session
        .browser
        .execute(params)
        .await
        .expect("saves go there");
    folder
}

/// The whole path.
async fn walk(session: &Session, scan: &Path, with: With) {
    session.allow_clipboard().await;
    let folder = downloads(session, with.name()).await;
    let start = Instant::now();
    let tab = session
        .coarse_viewer(&format!("#{}", payload(PLAIN)), with.size())
        .await;
    let mut author = Author::new(&tab, with).await;
    scenery(&tab, "path_start").await;
    author.stage("0_start").await;

    author.open(scan).await;
    scenery(&tab, "path_opened").await;
    author.stage("1_open").await;

    author.show("Tissues").await;
    author.press("Make a tissue").await;
    author.wait_for_work("bone is found").await;
    let made = document(&tab).await;
    let bone = made["subject"]["features"][0]["name"].clone();
    assert!(bone.is_string(), "{made}");
    author.stage("2_bone").await;

    if with == With::Fingers {
        author.press("Add").await;
    }
    author.press("Place peel").await;
    let forehead = author.face_at(0.5, 0.12).await;
    author.press_at(forehead).await;
    tab.wait_until(
        "JSON.parse(window.fabrica.viewer.get_document()).templates?.length === 1",
        30,
    )
    .await;
    let kept = document(&tab).await["templates"][0]["align"]["keep"][0].clone();
    assert_eq!(kept, bone, "the only tissue stays in place");
    author.stage("3_peeled").await;

    author.show("Text").await;
    if with == With::Fingers {
        // With the mouse the cursor stands in the empty field already.
        author.press_field("Title").await;
    }
    tab.frames(3).await;
    write(&tab, "Under the scalp").await;
    // What is under the fields comes into the drawer together with the last of them.
    author.scroll_to("Add a label").await;
    author.press_field("Name of the scan").await;
    write(&tab, NAME_OF_SCAN).await;
    tab.wait_until(
        &format!("JSON.parse(window.fabrica.viewer.get_document()).title === 'Under the scalp' && JSON.parse(window.fabrica.viewer.get_document()).subject.name === '{NAME_OF_SCAN}'"),
        30,
    )
    .await;
    author.stage("4_titled").await;

    author.press("Add a label").await;
    // Where the skin is off: the peel rolls it up from the left.
    let bared = author.face_at(0.35, 0.12).await;
    author.press_at(bared).await;
    tab.wait_until(
        "JSON.parse(window.fabrica.viewer.get_document()).labels?.length === 1",
        30,
    )
    .await;
    hand::hear(&tab, "Text of label 1").await;
    write(&tab, "Skull").await;
    tab.wait_until(
        "JSON.parse(window.fabrica.viewer.get_document()).labels[0].text === 'Skull'",
        30,
    )
    .await;
    author.stage("5_labelled").await;

    author.press("More").await;
    author.press("Save picture").await;
    author.save(&folder).await;

    author.press("Copy link").await;
    let link = clipboard(&tab, &session.server.address()).await;
    author.stage("7_copied").await;
    let done = author.presses;
    let sent = document(&tab).await;
    tab.assert_no_complaints().await;
    tab.page.close().await.expect("the tab closes");
    if with == With::Fingers && !is_long() {
        // The same files are opened by fingers above, and the link by the mouse.
        println!("touch: {done} presses to the link");
        assert!(done <= with.most_presses() - 2, "{done} presses");
        return;
    }

    // Elsewhere: nothing of this visit is known there.
    let elsewhere = session.elsewhere().await;
    let other = elsewhere.coarse_viewer_at(&link, with.size()).await;
    let mut reader = Author::new(&other, with).await;
    let asks = format!(
        "{TOLD}.some((line) => line.includes('{NAME_OF_SCAN}') && line.includes('open the file'))"
    );
    hand::listed(&other).await;
    reader.wait("the file is asked for", &asks, 60).await;
    reader.stage("9_asked").await;
    reader.open(scan).await;
    reader.stage("10_elsewhere").await;
    assert_eq!(document(&other).await, sent, "the link is what was made");
    // Text of the page, or of the canvas where something lies over it.
    let is_labelled = "document.querySelector('#captions li:not(.absent)')?.textContent === 'Skull' || window.fabrica.viewer.controls().includes('Label\\t\\tSkull\\t')";
    other.wait_until(is_labelled, 60).await;
    other.assert_no_complaints().await;
    elsewhere.end().await;

    println!(
        "{}: {done} presses to the link, {} to open it, {:.0} s together",
        with.name(),
        reader.presses,
        start.elapsed().as_secs_f32()
    );
    let all = done + reader.presses;
    assert!(all <= with.most_presses(), "{all} presses");
}

/// One picture lies in the folder, as large as a figure in print needs it, and is not blank.
fn assert_saved(folder: &Path) {
    let files: Vec<PathBuf> = std::fs::read_dir(folder)
        .expect("the folder")
        .map(|entry| entry.expect("a file").path())
        .collect();
    assert_eq!(files.len(), 1, "{files:?}");
    let picture = image::open(&files[0]).expect("a picture").to_rgba8();
    println!(
        "    saved {} {:?}",
        files[0].display(),
        picture.dimensions()
    );
    assert!(picture.width().max(picture.height()) >= 2000);
    harness::assert_not_blank(&picture, "the saved picture");
}

#[test]
fn the_path_on_a_scan_with_the_mouse() {
    on_a_scan("the_path_on_a_scan_with_the_mouse", With::Mouse);
}

#[test]
fn the_path_on_a_scan_by_touch() {
    on_a_scan("the_path_on_a_scan_by_touch", With::Fingers);
}

#[track_caller]
fn on_a_scan(test: &str, with: With) {
    let Some(data) = data_folder(test) else {
        return;
    };
    let scan = data.join("ct/head_ct_headsq.nii.gz");
    with_browser(BrowserGpu::Software, |session| async move {
        walk(&session, &scan, with).await;
    });
}
