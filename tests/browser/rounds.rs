//! A page that shows and removes illustrations for a long time.

use super::embed::open;
use super::harness::Tab;
use super::parts::small_scan;
use super::*;
use chromiumoxide::cdp::js_protocol::heap_profiler::CollectGarbageParams;
use chromiumoxide::cdp::js_protocol::runtime::{DiscardConsoleEntriesParams, GetHeapUsageParams};

/// Bytes of the page's objects, once all that nobody holds is gone.
async fn heap(tab: &Tab) -> f64 {
    // The browser keeps what the page has written, for its tools.
    let discarded = tab.page.execute(DiscardConsoleEntriesParams {}).await;
    discarded.expect("nothing written is kept");
    for _ in 0..3 {
        let collected = tab.page.execute(CollectGarbageParams {}).await;
        collected.expect("garbage is collected");
        tab.frames(2).await;
    }
    let usage = tab.page.execute(GetHeapUsageParams {}).await;
    usage.expect("the heap's size").result.used_size
}

/// Twenty embeds, one after the other, leave no more behind than two.
#[test]
fn twenty_rounds_leave_nothing_behind() {
    with_browser(BrowserGpu::Software, |session| async move {
        session.server.add("ball.nrrd", small_scan());
        let tab = open(&session, &[], "", (320, 500)).await;
        let lesson = r#"{"fabrica":1,"subject":{"src":"ball.nrrd"},"labels":[{"at":[0,0,0.4],"text":"Top"}],"controls":[{"pointer":"/camera/fov","min":20,"max":60}],"steps":[{"set":{"/camera/distance":2}}]}"#;
        let link = payload(lesson);
        let mut rounds = Vec::new();
        for round in 0..20 {
            let shown: bool = tab
                .eval(&format!("new Promise((done) => {{ const it = document.createElement('fabrica-viewer'); it.setAttribute('src', '#{link}'); it.className = 'narrow'; it.toggleAttribute('controls', true); it.addEventListener('ready', () => done(true)); it.addEventListener('error', () => done(false)); document.querySelector('main').append(it); }})"))
                .await;
            assert!(shown, "round {round}: {}", tab.messages().await);
            tab.eval::<bool>("(document.querySelector('fabrica-viewer').remove(), told.length = 0, messages.length = 0, true)")
                .await;
            tab.wait_until("ledger.devices.size === 0 && ledger.workers.size === 0", 20)
                .await;
            // What the tests themselves keep of every round, and the browser's list of what was fetched.
            tab.eval::<bool>("(performance.clearResourceTimings(), true)")
                .await;
            let program: f64 = tab
                .eval("import('./reader/engine.js').then(({ bindings }) => bindings()).then((found) => found.default()).then(({ memory }) => memory.buffer.byteLength)")
                .await;
            rounds.push((heap(&tab).await, program));
        }
        println!("bytes of the page and of its program: {rounds:?}");
        // The browser compiles what runs often and remembers it: that adds some 15 % to the objects of the page in the
        // first ten rounds. An embed that stayed would add its own objects in every round.
        let second = rounds[1];
        for (heap, program) in &rounds[2..] {
            let (now, then) = (heap + program, second.0 + second.1);
            assert!(now <= 1.1 * then, "{now} bytes, {then} after two");
            let is_kept = *program <= 1.1 * second.1;
            assert!(is_kept, "{program} bytes, {} after two", second.1);
        }
        let a_round = (rounds[19].0 - rounds[9].0) / 10.0;
        assert!(a_round < 10_000.0, "{a_round} bytes stay of each round");
    });
}
