//! The reader in frames, from other hosts, and in pages that platforms have mangled; the lesson pages.

use super::embed::{LESSON, picture_of, ready, rests_quietly, serve_where};
use super::harness::{Session, Tab};
use super::parts::small_scan;
use super::*;

/// A page around a frame: keeps what the frame posts, with its origin.
fn host(frame: &str) -> Vec<u8> {
    format!(
        "<!doctype html><html lang=en><title>Host</title><script>window.posted = []; addEventListener('message', ({{ data, origin }}) => posted.push([origin, data]));</script><h1>Host</h1>{frame}"
    )
    .into_bytes()
}

/// Messages of the frame with this name that have come.
fn events(name: &str) -> String {
    format!("posted.filter(([, data]) => data?.type === 'event' && data.name === '{name}')")
}

async fn open_host(session: &Session, frame: &str) -> Tab {
    session.server.add("host.html", host(frame));
    session.open_coarse("host.html", (480, 760)).await
}

/// embed.html in a bare frame, and in one without an origin: it tells its height and what happens in it, does what
/// its parent says and what nobody else says, and leaves the parent's history alone.
#[test]
fn a_frame_is_told_what_to_do_by_its_parent_alone() {
    with_browser(BrowserGpu::Software, |session| async move {
        let link = payload(LESSON);
        let own = session.server.address();
        for attributes in ["", "sandbox=\"allow-scripts\""] {
            let frame = format!(
                "<iframe id=it {attributes} width=300 height=600 src=\"embed.html?parent={own}#{link}\"></iframe>"
            );
            let tab = open_host(&session, &frame).await;
            let length: u32 = tab.eval("history.length").await;
            tab.wait_until(
                &format!(
                    "[...{}, ...{}].length > 0",
                    events("ready"),
                    events("error")
                ),
                180,
            )
            .await;
            let faults: serde_json::Value = tab.eval(&events("error")).await;
            assert_eq!(faults, serde_json::json!([]), "{attributes}");
            tab.picture(&format!("frame_{}", attributes.len())).await;
            let heights: Vec<f64> = tab.eval("posted.filter(([, data]) => data?.subject === 'lti.frameResize').map(([, { height }]) => height)").await;
            assert!(
                heights.last().is_some_and(|height| *height > 300.0),
                "{heights:?}"
            );
            let ask = |name: &str, args: &str, id: u32| {
                format!(
                    "(it.contentWindow.postMessage({{ fabrica: 1, type: 'command', id: {id}, name: '{name}', args: {args} }}, '*'), true)"
                )
            };
            tab.eval::<bool>(&ask("step", "[1]", 7)).await;
            tab.wait_until(
                &format!(
                    "{}.some(([, {{ detail }}]) => detail.step === 1)",
                    events("stepchange")
                ),
                60,
            )
            .await;
            tab.eval::<bool>(&ask(
                "setParam",
                "['/templates/0/params/amount', 'wide']",
                8,
            ))
            .await;
            tab.wait_until("posted.some(([, data]) => data?.id === 8 && data.error.includes('/templates/0/params/amount'))", 30).await;
            // What is no command of this version is ignored.
            for other in [
                "{ fabrica: 2, type: 'command', id: 9, name: 'next' }",
                "{ fabrica: 1, type: 'command', id: 9, name: 'constructor' }",
                "'next'",
                "null",
                "{ fabrica: 1 }",
            ] {
                tab.eval::<bool>(&format!(
                    "(it.contentWindow.postMessage({other}, '*'), true)"
                ))
                .await;
            }
            tab.eval::<bool>(&ask("steps", "[]", 10)).await;
            tab.wait_until(
                "posted.some(([, data]) => data?.id === 10 && data.value.length === 2)",
                30,
            )
            .await;
            assert!(
                tab.eval::<bool>("!posted.some(([, data]) => data?.id === 9)")
                    .await
            );
            assert_eq!(
                tab.eval::<u32>("history.length").await,
                length,
                "back leads out as before"
            );
            tab.page.close().await.expect("the tab closes");
        }

        // A parent that the address does not name hears of heights alone, and is not obeyed.
        let other = session.server.beside();
        let frame = format!(
            "<iframe id=it width=300 height=600 src=\"{own}/embed.html?parent=https://elsewhere.example#{link}\"></iframe>"
        );
        other.add("host.html", host(&frame));
        let address = format!("{}/host.html", other.address());
        let tab = session.open_coarse_at(&address, (480, 760)).await;
        tab.wait_until("posted.some(([, data]) => data?.type === 'height')", 120)
            .await;
        tab.eval::<bool>("(it.contentWindow.postMessage({ fabrica: 1, type: 'command', id: 1, name: 'steps' }, '*'), true)").await;
        tab.frames_quietly(30).await;
        let told: Vec<serde_json::Value> = tab
            .eval("posted.filter(([, data]) => data?.fabrica && data.type !== 'height')")
            .await;
        assert!(told.is_empty(), "{told:?}");
    });
}

/// embed.html from another host in a page whose policy forbids everything but that frame and a script that listens.
#[test]
fn a_frame_from_another_host_needs_frame_src_alone() {
    with_browser(BrowserGpu::Software, |session| async move {
        let far = session.server.address();
        let other = session.server.beside();
        let own = other.address();
        let link = payload(LESSON);
        other.add("posted.js", b"window.posted = []; addEventListener('message', ({ data, origin }) => posted.push([origin, data]));".to_vec());
        let policy = format!("default-src 'none'; script-src 'self'; frame-src {far}");
        let page = format!(
            "<!doctype html><html lang=en><meta http-equiv=\"Content-Security-Policy\" content=\"{policy}\"><title>Host</title><script src=posted.js></script><iframe id=it width=300 height=600 src=\"{far}/embed.html?parent={own}#{link}\"></iframe>"
        );
        other.add("host.html", page.into_bytes());
        let address = format!("{own}/host.html");
        let tab = session.open_coarse_at(&address, (320, 640)).await;
        let has_come = format!(
            "[...{}, ...{}].length > 0",
            events("ready"),
            events("error")
        );
        tab.wait_until(&has_come, 180).await;
        let faults: serde_json::Value = tab.eval(&events("error")).await;
        assert_eq!(faults, serde_json::json!([]));
        let origins: Vec<String> = tab
            .eval("[...new Set(posted.map(([origin]) => origin))]")
            .await;
        assert_eq!(origins, [far]);
        tab.picture("frame_far").await;
        tab.assert_no_complaints().await;
    });
}

/// The element's script from another host, whose workers a browser refuses to start.
#[test]
fn the_element_comes_from_another_host() {
    with_browser(BrowserGpu::Software, |session| async move {
        let other = session.server.beside();
        let far = session.server.address();
        let link = payload(LESSON);
        other.add(
            "lesson.html",
            format!("<!doctype html><html lang=en><title>Far</title><script type=module src=\"{far}/fabrica-viewer.js\"></script><fabrica-viewer id=e0 src=\"#{link}\"></fabrica-viewer><script>window.told = []; for (const name of ['ready', 'error']) addEventListener(name, (event) => told.push([name, event.detail]));</script>").into_bytes(),
        );
        let address = format!("{}/lesson.html", other.address());
        let tab = session.open_coarse_at(&address, (320, 400)).await;
        tab.wait_until("told.length > 0", 180).await;
        let told: serde_json::Value = tab.eval("told").await;
        assert_eq!(told[0][0], "ready", "{told}");
    });
}

/// Where the page's policy forbids the blobs that such workers start from, the illustration is made, or read, in the
/// page itself, and the console says so.
#[test]
fn without_workers_the_page_does_their_work() {
    with_browser(BrowserGpu::Software, |session| async move {
        let other = session.server.beside();
        let far = session.server.address();
        other.add("ball.nrrd", small_scan());
        for subject in [r#"{"builtin":"bar"}"#, r#"{"src":"ball.nrrd"}"#] {
            let link = payload(&format!(r#"{{"fabrica":1,"subject":{subject}}}"#));
            other.add(
                "strict.html",
                format!("<!doctype html><html lang=en><meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; script-src 'self' {far} 'wasm-unsafe-eval'; connect-src 'self' {far}; worker-src 'self' {far}\"><title>Strict</title><script src=told.js></script><script type=module src=\"{far}/fabrica-viewer.js\"></script><fabrica-viewer id=e0 src=\"#{link}\"></fabrica-viewer>").into_bytes(),
            );
            other.add("told.js", b"window.told = []; for (const name of ['ready', 'error']) addEventListener(name, (event) => told.push([name, event.detail])); window.warned = []; const warn = console.warn; console.warn = (...words) => { warned.push(words.join(' ')); warn.apply(console, words); };".to_vec());
            let tab = session.open("").await;
            tab.resize(400, 400).await;
            tab.go(&format!("{}/strict.html", other.address())).await;
            tab.wait_until("told.length > 0", 240).await;
            let told: serde_json::Value = tab.eval("told").await;
            assert_eq!(told[0][0], "ready", "{subject}: {told}");
            let warned: Vec<String> = tab.eval("warned").await;
            assert!(
                warned.iter().any(|line| line.contains("starts no worker")),
                "{subject}: {warned:?}"
            );
            tab.picture(&format!("frame_strict_{}", subject.len()))
                .await;
            tab.page.close().await.expect("the tab closes");
        }
    });
}

/// What lies on another host is fetched once the reader agrees: a displacement field; a document, with the subject that
/// lies beside it. Where that host does not allow it, a sentence says what to set.
#[test]
fn another_host_is_asked_about_first() {
    with_browser(BrowserGpu::Software, |session| async move {
        let far = session.server.beside();
        let host = far.address();
        let mut table = String::from("x,y,z,dx,dy,dz\n");
        for i in 0..125 {
            let at = [i % 5, i / 5 % 5, i / 25].map(|n| f64::from(n) * 40.0 - 80.0);
            table += &format!(
                "{},{},{},0,{},0\n",
                at[0],
                at[1],
                at[2],
                0.3 * (at[0] + 80.0)
            );
        }
        far.add("nodes.csv", table.into_bytes());
        far.add("ball.nrrd", small_scan());
        let ball = br#"{"fabrica":1,"subject":{"src":"ball.nrrd"}}"#;
        far.add("ball.json", ball.to_vec());
        far.add("own.json", ball.to_vec());
        far.keep_to_itself("own.json");
        let asked = || far.asked().len();
        let field = payload(&format!(
            r#"{{"fabrica":1,"subject":{{"builtin":"cube"}},"templates":[{{"kind":"field","params":{{"src":"{host}/nodes.csv"}}}}]}}"#
        ));
        let embeds = [format!("src=\"#{field}\">")];
        let policy = ["connect-src 'self'", &format!("connect-src 'self' {host}")];
        serve_where(&session, "elsewhere.html", &embeds, policy);
        let tab = session.open_coarse("elsewhere.html", (320, 500)).await;
        let words = "e0.shadowRoot.querySelector('.words')";
        let name = host.trim_start_matches("http://");
        let asks = format!(
            "(e0.shadowRoot && {words}?.hidden === false && {words}.textContent.includes('{name}'))"
        );
        let agree = format!("({words}.querySelector('button').click(), true)");
        ready(&tab, 1).await;
        tab.wait_until(&asks, 60).await;
        assert_eq!(asked(), 0, "nothing is fetched unasked");
        let straight = picture_of(&tab, "e0").await;
        tab.eval::<bool>(&agree).await;
        // A notice tells how the nodes were taken.
        tab.wait_until("told.some(([name, , detail]) => name === 'error' && detail.message.includes('125 nodes'))", 60)
            .await;
        rests_quietly(&tab).await;
        assert_eq!(far.asked(), ["/nodes.csv"]);
        let bent = picture_of(&tab, "e0").await;
        let off = difference(&straight, &bent, WHITE).mean;
        assert!(off > 0.5, "the field displaces: {off}");

        // A document, by the address of a page that shows it.
        let show = |file: &str| {
            format!("(told.length = 0, e0.setAttribute('src', '?doc={host}/{file}'), true)")
        };
        tab.eval::<bool>(&show("ball.json")).await;
        tab.wait_until(&asks, 60).await;
        assert_eq!(asked(), 1, "nor is a document");
        tab.eval::<bool>(&agree).await;
        ready(&tab, 1).await;
        assert_eq!(
            far.asked()[1..],
            ["/ball.json", "/ball.nrrd"],
            "one answer is enough"
        );
        tab.eval::<bool>(&show("own.json")).await;
        tab.wait_until(&asks, 60).await;
        tab.eval::<bool>(&agree).await;
        tab.wait_until("told.some(([name]) => name === 'error')", 60)
            .await;
        let said: String = tab.eval(&format!("{words}.textContent")).await;
        assert!(said.contains("Access-Control-Allow-Origin: *"), "{said}");
    });
}

/// Links as platforms and mails leave them lead to the same lesson and step.
#[test]
fn mangled_links_are_read() {
    with_browser(BrowserGpu::Software, |session| async move {
        let link = payload(LESSON);
        let (head, tail) = link.split_at(link.len() / 2);
        let own = session.server.address();
        let forms = [
            format!("#{link}&step=2"),
            format!("{link}&step=2"),
            format!("#{link}&amp;amp;step=2"),
            format!("#{link}%26step%3D2"),
            format!("#{head}\n{tail}&step=2"),
            format!("{own}/?utm=mail#{link}&step=2"),
            format!("{own}/?s={link}&step=2&fbclid=x"),
            format!("#{link}&step=2?a=b"),
            format!("{own}/#{link}?a=b&step=2"),
            format!("{own}/?s=1AAAA#{link}&step=2"),
            format!("{own}/?step=2&s={link}#top"),
            format!("{own}/?doc=none.json#{link}&step=2"),
        ];
        let embeds: Vec<String> = forms
            .iter()
            .map(|form| format!("<fabrica-viewer loading=tap src=\"{form}\"></fabrica-viewer>"))
            .collect();
        session.server.add("mangled.html", format!("<!doctype html><title>Mail</title><script type=module src=fabrica-viewer.js></script>{}", embeds.concat()).into_bytes());
        let tab = session.open("mangled.html").await;
        let found: Vec<serde_json::Value> = tab
            .eval("Promise.all([import('./reader/embed.js'), import('./reader/engine.js')]).then(async ([{ sourceOf }, { bindings }]) => { const { outline_of: outline } = await bindings(); return [...document.querySelectorAll('fabrica-viewer')].map((it) => { try { return JSON.parse(outline(sourceOf(it.getAttribute('src')).text, location.href)).step; } catch (error) { return String(error); } }); })")
            .await;
        assert_eq!(found, vec![serde_json::json!(2); forms.len()]);
        // A place in a page is no payload.
        let address: String = tab
            .eval("import('./reader/embed.js').then(({ sourceOf }) => sourceOf('?doc=a/lesson.json&step=1#top').address)")
            .await;
        assert_eq!(address, format!("{own}/a/lesson.json"));
        // The same for the address of a frame.
        for rest in [
            format!("?s={link}&amp;step=2"),
            format!("?a=b#{link}&amp;step=2"),
        ] {
            let tab = session
                .open_coarse(&format!("embed.html{rest}"), (320, 400))
                .await;
            tab.wait_until("document.querySelector('fabrica-viewer').step === 2", 120)
                .await;
            tab.page.close().await.expect("the tab closes");
        }
    });
}

/// A frame without an origin, on a host that keeps its scripts to its own pages: nothing runs there, and a sentence
/// says what to set.
#[test]
fn a_frame_whose_scripts_are_refused_says_so() {
    with_browser(BrowserGpu::Software, |session| async move {
        session.server.keep_to_itself("reader/frame.js");
        let link = payload(LESSON);
        let frame = format!(
            "<iframe id=it sandbox=allow-scripts width=300 height=400 src=\"embed.html#{link}\"></iframe>"
        );
        let tab = open_host(&session, &frame).await;
        tokio::time::sleep(std::time::Duration::from_secs(9)).await;
        let page = tab.picture("frame_without_scripts").await;
        let [left, top, width, height]: [f64; 4] = tab
            .eval(
                "(({ x, y, width, height }) => [x, y, width, height])(it.getBoundingClientRect())",
            )
            .await;
        let [left, top, width, height] = [left, top, width, height].map(|px| px as u32);
        let below = image::imageops::crop_imm(&page, left, top + height / 2, width, height / 2);
        let letters = below.to_image().pixels().filter(|p| p.0[0] < 128).count();
        assert!(letters > 300, "{letters} dark pixels of a sentence");
    });
}

/// The lesson pages show their posters, start their illustrations and keep to their policy.
#[test]
fn the_lesson_pages_stand() {
    with_browser(BrowserGpu::Software, |session| async move {
        for page in [
            "opening-the-skull",
            "the-hand-in-layers",
            "why-the-neck-whips",
        ] {
            let address = format!("lessons/{page}.html");
            let tab = session.open_coarse(&address, (390, 900)).await;
            for width in [390, 1280] {
                tab.resize(width, 900).await;
                let too_wide: f64 = tab
                    .eval("document.documentElement.scrollWidth - innerWidth")
                    .await;
                assert!(
                    too_wide <= 0.0,
                    "{page} at {width}: {too_wide} pixels stick out"
                );
            }
            let broken: u32 = tab.eval("Promise.all([...document.images].map((image) => image.decode().then(() => 0, () => 1))).then((all) => all.reduce((a, b) => a + b, 0))").await;
            assert_eq!(broken, 0, "{page}: a poster is missing");
            // The document of each illustration is right, whether or not it is drawn here.
            let wrong: Vec<String> = tab
                .eval("import('../reader/engine.js').then(({ bindings }) => bindings()).then(async ({ outline_of: outline }) => { const wrong = []; for (const it of document.querySelectorAll('fabrica-viewer')) { const text = await (await fetch(it.getAttribute('src'))).text(); const { steps, controls, captions } = JSON.parse(outline(text, location.href)); const listed = it.querySelectorAll('ol > li').length; if (steps.length !== listed) wrong.push(`${it.id}: ${steps.length} steps, ${listed} listed`); if (controls.length !== (JSON.parse(text).controls ?? []).length) wrong.push(`${it.id}: a control is left out`); if (captions.length === 0) wrong.push(`${it.id}: no captions`); } return wrong; })")
                .await;
            assert!(wrong.is_empty(), "{page}: {wrong:?}");
            tab.assert_no_complaints().await;
        }
    });
}
