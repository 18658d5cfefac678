//! A page that shows and removes illustrations for a long time.

use super::embed::open;
use super::harness::Tab;
use super::*;
use chromiumoxide::cdp::js_protocol::heap_profiler::CollectGarbageParams;
use chromiumoxide::cdp::js_protocol::runtime::GetHeapUsageParams;

/// Bytes of the page's objects, once all that nobody holds is gone.
async fn heap(tab: &Tab) -> f64 {
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
        let tab = open(&session, &[], "", (320, 500)).await;
        let link = payload(super::embed::LESSON);
        let mut rounds = Vec::new();
        for round in 0..20 {
            let shown: bool = tab
                .eval(&format!("new Promise((done) => {{ const it = document.createElement('fabrica-viewer'); it.setAttribute('src', '#{link}'); it.toggleAttribute('controls', true); it.addEventListener('ready', () => done(true)); it.addEventListener('error', () => done(false)); document.querySelector('main').append(it); }})"))
                .await;
            assert!(shown, "round {round}: {}", tab.messages().await);
            tab.eval::<bool>("(document.querySelector('fabrica-viewer').remove(), told.length = 0, messages.length = 0, true)")
                .await;
            tab.wait_until("ledger.devices.size === 0 && ledger.workers.size === 0", 20)
                .await;
            // What the tests themselves keep of every round, and the browser's list of what was fetched.
            tab.eval::<bool>("(devices.length = 0, performance.clearResourceTimings(), true)")
                .await;
            let program: f64 = tab
                .eval("import('./reader/engine.js').then(({ bindings }) => bindings()).then((found) => found.default()).then(({ memory }) => memory.buffer.byteLength)")
                .await;
            rounds.push((heap(&tab).await, program));
        }
        println!("bytes of the page and of its program: {rounds:?}");
        let second = rounds[1];
        for (heap, program) in &rounds[2..] {
            assert!(
                *heap <= 1.1 * second.0,
                "{heap} bytes, {} after two",
                second.0
            );
            assert!(
                *program <= 1.1 * second.1,
                "{program} bytes, {} after two",
                second.1
            );
        }
    });
}
