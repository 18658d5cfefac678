//! What assistive technology, paper, large letters and forced colours make of the pages.

use super::embed::{lesson, middle, open_coarse, ready, rests_quietly};
use super::hand::{bring_to_front, strike};
use super::harness::Tab;
use super::presenting::read;
use super::*;
use chromiumoxide::cdp::browser_protocol::accessibility::GetFullAxTreeParams;
use chromiumoxide::cdp::browser_protocol::emulation::{MediaFeature, SetEmulatedMediaParams};

/// See the README beside it.
const AXE: &str = include_str!("axe/axe.min.js");

/// Every element that breaks a rule, as lines: the rule and its help, the element, what would mend it.
const BROKEN: &str = "axe.run(document, { resultTypes: ['violations'] }).then(({ violations }) => violations.flatMap(({ id, impact, help, nodes }) => nodes.map(({ target, html, failureSummary }) => `${id} (${impact}): ${help}\\n  ${target.flat(9).join(' >> ')}\\n  ${html.slice(0, 300)}\\n  ${failureSummary.replaceAll('\\n', '\\n  ')}`)))";

/// Fails on any rule of axe-core that the page breaks; no rule is left out.
async fn assert_accessible(tab: &Tab, what: &str) {
    tab.page
        .evaluate_expression(AXE)
        .await
        .expect("axe-core runs");
    let broken: Vec<String> = tab.eval(BROKEN).await;
    assert!(broken.is_empty(), "{what}:\n{}", broken.join("\n"));
}

/// Plants a button without a name where the controls of a page of this kind stand, and fails if that is not found: what
/// is told of the page above is looked for there.
async fn assert_watched(tab: &Tab, room: &str, what: &str) {
    let plant = format!("({room}.append(document.createElement('button')), true)");
    tab.eval::<bool>(&plant).await;
    let broken: Vec<String> = tab.eval(BROKEN).await;
    let is_found = broken.iter().any(|line| line.starts_with("button-name"));
    assert!(is_found, "{what}: a button without a name: {broken:?}");
    tab.eval::<bool>(&format!("({room}.lastElementChild.remove(), true)"))
        .await;
}

/// Role and name of everything that the browser tells assistive technology.
async fn told(tab: &Tab) -> Vec<(String, String)> {
    let tree = tab.page.execute(GetFullAxTreeParams::default()).await;
    let tree = tree.expect("the accessibility tree");
    let text = |value: &Option<chromiumoxide::cdp::browser_protocol::accessibility::AxValue>| {
        let value = value.as_ref()?.value.as_ref()?;
        Some(value.as_str()?.to_owned())
    };
    let nodes = tree.result.nodes.iter().filter(|node| !node.ignored);
    nodes
        .map(|node| {
            (
                text(&node.role).unwrap_or_default(),
                text(&node.name).unwrap_or_default(),
            )
        })
        .collect()
}

fn is_ready(embed: &str) -> String {
    format!("{embed}.shadowRoot.querySelector('.frame.ready') !== null")
}

/// The embed before it has a picture, with one, entered and presenting; steps, captions and values are in the
/// accessibility tree. The negative control is caught.
#[test]
fn an_embed_is_accessible() {
    with_browser(BrowserGpu::Software, |session| async move {
        let poster = "<img src=icon.svg alt=Poster width=64 height=48><p>What is to be seen.</p>";
        let tap = format!("{}{poster}", lesson("loading=tap"));
        let tab = open_coarse(&session, &[lesson("controls"), tap], "", (390, 900)).await;
        bring_to_front(&tab).await;
        ready(&tab, 1).await;
        rests_quietly(&tab).await;
        assert_accessible(&tab, "a page with embeds").await;
        // The words are asked of the device, and come after the picture.
        let described =
            "e0.shadowRoot.querySelector('[part=picture]').ariaLabel.startsWith('Opening a cube')";
        tab.wait_until(described, 60).await;

        let told = told(&tab).await;
        let has = |role: &str, name: &str| {
            let found = |(its_role, its_name): &(String, String)| {
                its_role == role && its_name.starts_with(name)
            };
            assert!(told.iter().any(found), "no {role} {name:?} in {told:?}");
        };
        has("combobox", "Steps");
        has("option", "1. Apart");
        has("option", "2. Nearer");
        has("list", "Captions");
        has("StaticText", "A corner");
        has("StaticText", "Its middle");
        has("slider", "Gap");
        has("checkbox", "Split at all");
        has("slider", "Place in the lesson");
        has("button", "Next step");
        has("button", "Present");
        has("image", "Opening a cube");

        let (x, y) = middle(&tab, "e0").await;
        tab.click(x, y).await;
        assert_accessible(&tab, "entered").await;
        tab.eval::<bool>("(e0.next(), e0.present().then(() => true))")
            .await;
        rests_quietly(&tab).await;
        assert_accessible(&tab, "presenting").await;

        let bar = "e0.shadowRoot.querySelector('.bar')";
        assert_watched(&tab, bar, "presenting").await;
    });
}

/// What is wider than the room that it has, or small to press, of a page and the controls of an embed.
async fn assert_in_reach(tab: &Tab, embed: &str, what: &str) {
    let wide: Vec<String> = tab
        .eval(&format!("[document.documentElement, ...{embed}.shadowRoot.querySelectorAll('.frame, .controls, .controls *')].filter((it) => it.scrollWidth > it.clientWidth + 1 && it.clientWidth > 0 && it.tagName !== 'SELECT' || it.getBoundingClientRect().right > innerWidth + 1).map((it) => it.outerHTML.slice(0, 120))"))
        .await;
    assert!(wide.is_empty(), "{what}: {wide:?}");
    let small: Vec<String> = tab
        .eval(&format!("[...document.querySelectorAll('button'), ...{embed}.shadowRoot.querySelectorAll('button, select, input')].filter((it) => {{ const {{ width, height }} = it.getBoundingClientRect(); return it.checkVisibility() && (width < 24 || height < 24); }}).map((it) => it.outerHTML)"))
        .await;
    assert!(small.is_empty(), "{what}: {small:?}");
}

/// embed.html and the lesson pages, with their illustrations, at 400 % too, and when they are presented.
#[test]
fn pages_around_embeds_are_accessible() {
    with_browser(BrowserGpu::Software, |session| async move {
        let link = payload(super::embed::LESSON);
        let tab = session
            .open_coarse(&format!("embed.html#{link}"), (390, 800))
            .await;
        let viewer = "document.querySelector('fabrica-viewer')";
        tab.wait_until(&is_ready(viewer), 120).await;
        assert_accessible(&tab, "embed.html").await;
        let bar = format!("{viewer}.shadowRoot.querySelector('.controls')");
        assert_watched(&tab, &bar, "embed.html").await;
        let pages = [
            "index",
            "opening-the-skull",
            "the-hand-in-layers",
            "why-the-neck-whips",
        ];
        // What stands around the embeds of the others is made alike, and their first pictures take long.
        let most = long_or(pages.len(), 2);
        for page in pages.into_iter().take(most) {
            let address = format!("lessons/{page}.html");
            let tab = session.open_coarse(&address, (390, 800)).await;
            if page != "index" {
                tab.eval::<bool>(&format!("({viewer}.scrollIntoView(), true)"))
                    .await;
                tab.wait_until(&is_ready(viewer), 240).await;
            }
            for scheme in ["light", "dark"] {
                emulate(&tab, "", &[("prefers-color-scheme", scheme)]).await;
                assert_accessible(&tab, &format!("{page}, {scheme}")).await;
            }
            assert_watched(&tab, "document.querySelector('main')", page).await;
            if page == "index" {
                tab.page.close().await.expect("the tab closes");
                continue;
            }
            // A window of 1280 pixels at 400 %.
            emulate(&tab, "", &[("forced-colors", "active")]).await;
            tab.resize(320, 600).await;
            assert_in_reach(&tab, viewer, &format!("{page} at 400 %")).await;
            emulate(&tab, "", &[]).await;
            // Before a room, with the code of the step's link.
            tab.eval::<bool>(&format!(
                "({viewer}.step = 2, {viewer}.present().then(() => true))"
            ))
            .await;
            strike(&tab, 0, "q", None).await;
            let code = format!("{viewer}.shadowRoot.querySelector('.code').checkVisibility()");
            tab.wait_until(&code, 20).await;
            let document: String = tab
                .eval(&format!(
                    "new URL({viewer}.getAttribute('src'), location).href"
                ))
                .await;
            let query: String = tab.eval(&format!("encodeURIComponent({document:?})")).await;
            let link = format!("{}/embed.html?doc={query}&step=2", session.server.address());
            let read = read(&tab.picture(&format!("lesson_code_{page}")).await);
            assert_eq!(read.as_deref(), Some(link.as_str()), "{page}");
            tab.page.close().await.expect("the tab closes");
        }
    });
}

/// The author's page with its first picture, and the page that says why there is none.
#[test]
fn the_authors_page_is_accessible() {
    with_browser(BrowserGpu::Software, |session| async move {
        let link = payload(super::embed::LESSON);
        let tab = session.coarse_viewer(&format!("#{link}"), PAGE).await;
        tab.settled().await;
        assert_accessible(&tab, "the author's page").await;
        assert_watched(&tab, "document.body", "the author's page").await;
    });
    with_browser(BrowserGpu::None, |session| async move {
        let tab = session.open("").await;
        let state = "document.documentElement.dataset.state === 'no-webgpu'";
        tab.wait_until(state, 60).await;
        assert_accessible(&tab, "the page without WebGPU").await;
        assert_watched(
            &tab,
            "document.querySelector('#cover')",
            "the page without WebGPU",
        )
        .await;
    });
}

/// The author's controls as elements, once they are asked for: named, pressed, given values, and in line with what is
/// drawn.
#[test]
fn the_authors_controls_are_elements_for_who_asks() {
    with_browser(BrowserGpu::Software, |session| async move {
        let link = payload(super::embed::LESSON);
        let tab = session.coarse_viewer(&format!("#{link}"), PAGE).await;
        tab.settled().await;
        assert!(
            tab.eval::<bool>("document.getElementById('mirror') === null")
                .await
        );
        tab.eval::<bool>("(document.getElementById('list').click(), true)")
            .await;
        let named = |kind: &str, name: &str| {
            format!(
                "[...document.querySelectorAll('#mirror {kind}')].find((it) => it.getAttribute('aria-label')?.startsWith('{name}'))"
            )
        };
        tab.wait_until(&format!("Boolean({})", named("button", "Add")), 30)
            .await;
        assert_accessible(&tab, "with the controls as elements").await;
        let mirror = "document.getElementById('mirror')";
        assert_watched(&tab, mirror, "the controls as elements").await;
        let told = told(&tab).await;
        let count = |role: &str| told.iter().filter(|(its, _)| its == role).count();
        assert!(count("button") > 5, "{told:?}");
        assert!(
            told.iter()
                .all(|(role, name)| role != "button" || !name.is_empty())
        );

        // A press does what it does on the canvas, and the elements follow.
        let look = named("button", "Panel: Look");
        let is_open = format!("{look}.getAttribute('aria-checked') === 'true'");
        assert!(!tab.eval::<bool>(&is_open).await);
        tab.eval::<bool>(&format!("({look}.click(), true)")).await;
        tab.wait_until(&is_open, 30).await;
        // A value that is given to an element is taken.
        let place = named("input[type=range]", "Place in the lesson");
        let give = format!("(({place}.value = 1), {place}.oninput(), true)");
        tab.eval::<bool>(&give).await;
        tab.wait_until("window.fabrica.viewer.get_link().endsWith('&step=1')", 30)
            .await;
        tab.assert_no_complaints().await;
    });
}

/// Shows the page as on a medium (`""` for the screen) with these preferences.
pub(crate) async fn emulate(tab: &Tab, medium: &str, features: &[(&str, &str)]) {
    let features = features.iter().map(|(name, value)| MediaFeature {
        name: (*name).to_owned(),
        value: (*value).to_owned(),
    });
    let params = SetEmulatedMediaParams {
        media: Some(medium.to_owned()),
        features: Some(features.collect()),
    };
    tab.page.execute(params).await.expect("another medium");
}

/// On paper there are the picture, its captions and the words of the step, and no controls.
#[test]
fn an_embed_is_printed() {
    with_browser(BrowserGpu::Software, |session| async move {
        let tab = open_coarse(&session, &[lesson("controls step=1")], "", (640, 900)).await;
        ready(&tab, 1).await;
        rests_quietly(&tab).await;
        emulate(&tab, "print", &[]).await;
        tab.frames(3).await;
        let [controls, hint, legend, captions]: [bool; 4] = tab
            .eval("['.controls', '.hint', '.legend', '[part=caption]'].map((part) => e0.shadowRoot.querySelector(part).checkVisibility())")
            .await;
        assert!(!controls && !hint, "nothing to press on paper");
        assert!(legend && captions, "words are on paper");
        let printed = tab.picture("embed_printed").await;
        let is_tissue = |p: &&image::Rgba<u8>| p[0] > p[2].saturating_add(40);
        let seen = printed.pixels().filter(is_tissue).count();
        assert!(
            seen > 50_000,
            "the cube is on paper: {seen} pixels of its colours"
        );
        emulate(&tab, "", &[]).await;
        tab.frames(3).await;
        let is_copy = "e0.shadowRoot.querySelector('.paper').checkVisibility()";
        assert!(!tab.eval::<bool>(is_copy).await, "the copy is for paper");
    });
}

/// At 200 % and 400 % of the letters' size, and in forced colours, nothing sticks out and everything can be reached.
#[test]
fn large_letters_and_forced_colours_leave_everything_in_reach() {
    with_browser(BrowserGpu::Software, |session| async move {
        let embeds = [lesson("controls step=1")];
        // A window of 1280 by 1024 pixels at 200 % and 400 %.
        let tab = open_coarse(&session, &embeds, "", (640, 512)).await;
        ready(&tab, 1).await;
        for (size, percent) in [((640, 512), 200), ((320, 256), 400)] {
            tab.resize(size.0, size.1).await;
            for (look, features) in [
                (
                    "light",
                    [("prefers-color-scheme", "light"), ("forced-colors", "none")],
                ),
                (
                    "forced",
                    [
                        ("prefers-color-scheme", "dark"),
                        ("forced-colors", "active"),
                    ],
                ),
            ] {
                emulate(&tab, "", &features).await;
                rests_quietly(&tab).await;
                assert_in_reach(&tab, "e0", &format!("{percent} %, {look}")).await;
                for (part, name) in [(".stage", "picture"), (".controls", "controls")] {
                    tab.eval::<bool>(&format!("(e0.shadowRoot.querySelector('{part}').scrollIntoView({{ block: 'start' }}), true)")).await;
                    tab.frames(3).await;
                    tab.picture(&format!("zoom_{percent}_{look}_{name}")).await;
                }
            }
        }
        tab.assert_no_complaints().await;
    });
}
