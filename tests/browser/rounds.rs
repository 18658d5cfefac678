//! A page that shows and removes illustrations for a long time.

use super::embed::open;
use super::harness::Tab;
use super::parts::small_scan;
use super::*;
use chromiumoxide::cdp::js_protocol::heap_profiler::{
    CollectGarbageParams, EventAddHeapSnapshotChunk, TakeHeapSnapshotParams,
};
use chromiumoxide::cdp::js_protocol::runtime::DiscardConsoleEntriesParams;
use futures::StreamExt as _;
use serde::Deserialize;
use std::time::Duration;
use tokio::time::timeout;

/// What a page makes itself. The rest is the browser's: above all machine code, since it compiles what runs often, for
/// some ten rounds, which adds a sixth to the heap.
const MADE: [&str; 9] = [
    "object",
    "closure",
    "array",
    "string",
    "concatenated string",
    "sliced string",
    "number",
    "bigint",
    "regexp",
];

/// A snapshot of the heap, as V8 writes it: so many numbers for each node.
#[derive(Deserialize)]
struct Heap {
    snapshot: About,
    nodes: Vec<u64>,
}

#[derive(Deserialize)]
struct About {
    meta: Meta,
}

#[derive(Deserialize)]
struct Meta {
    node_fields: Vec<String>,
    node_types: Vec<serde_json::Value>,
}

/// Bytes of what the page has made, once all that nobody holds is gone.
async fn made(tab: &Tab) -> f64 {
    // The browser keeps what the page has written, for its tools, and the list of what was fetched.
    let discarded = tab.page.execute(DiscardConsoleEntriesParams {}).await;
    discarded.expect("nothing written is kept");
    tab.eval::<bool>("(performance.clearResourceTimings(), true)")
        .await;
    for _ in 0..3 {
        let collected = tab.page.execute(CollectGarbageParams {}).await;
        collected.expect("garbage is collected");
        tab.frames(2).await;
    }
    let chunks = tab.page.event_listener::<EventAddHeapSnapshotChunk>();
    let mut chunks = chunks.await.expect("the heap is told of");
    let taken = tab.page.execute(TakeHeapSnapshotParams::default()).await;
    taken.expect("a snapshot of the heap");
    let mut text = String::new();
    while let Ok(Some(chunk)) = timeout(Duration::from_secs(2), chunks.next()).await {
        text += &chunk.chunk;
        if text.ends_with("]}\n") || text.ends_with("]}") {
            break;
        }
    }
    let heap: Heap = serde_json::from_str(&text).expect("a whole snapshot");
    let Meta {
        node_fields,
        node_types,
    } = heap.snapshot.meta;
    let field = |name: &str| node_fields.iter().position(|field| field == name);
    let (kind, size) = (field("type"), field("self_size"));
    let (kind, size) = (kind.expect("a kind"), size.expect("a size"));
    let is_made = |node: &&[u64]| {
        let name = node_types[kind][node[kind] as usize].as_str();
        name.is_some_and(|name| MADE.contains(&name))
    };
    let nodes = heap.nodes.chunks_exact(node_fields.len());
    nodes.filter(is_made).map(|node| node[size] as f64).sum()
}

/// Shows an illustration and removes it; a page that keeps it keeps what it has made.
async fn round(tab: &Tab, link: &str, is_kept: bool) {
    let shown: bool = tab
        .eval(&format!("new Promise((done) => {{ const it = document.createElement('fabrica-viewer'); it.setAttribute('src', '#{link}'); it.className = 'narrow'; it.toggleAttribute('controls', true); it.addEventListener('ready', () => done(true)); it.addEventListener('error', () => done(false)); document.querySelector('main').append(it); }})"))
        .await;
    assert!(shown, "{}", tab.messages().await);
    // The tests themselves keep what is told and written, and the devices.
    tab.eval::<bool>(&format!("((it) => {{ it.remove(); told.length = messages.length = devices.length = 0; if ({is_kept}) (window.kept ??= []).push(it); return true; }})(document.querySelector('fabrica-viewer'))"))
        .await;
    tab.wait_until("ledger.devices.size === 0 && ledger.workers.size === 0", 20)
        .await;
}

/// Twenty embeds, one after the other, leave no more behind than two.
#[test]
fn twenty_rounds_leave_nothing_behind() {
    with_browser(BrowserGpu::Software, |session| async move {
        session.server.add("ball.nrrd", small_scan());
        let tab = open(&session, &[], "", (320, 500)).await;
        let lesson = r#"{"fabrica":1,"subject":{"src":"ball.nrrd"},"labels":[{"at":[0,0,0.4],"text":"Top"}],"controls":[{"pointer":"/camera/fov","min":20,"max":60}],"steps":[{"set":{"/camera/distance":2}}]}"#;
        let link = payload(lesson);
        let memory = "import('./reader/engine.js').then(({ bindings }) => bindings()).then((found) => found.default()).then(({ memory }) => memory.buffer.byteLength)";
        let (mut heaps, mut memories) = (Vec::new(), Vec::<f64>::new());
        for number in 1..=20 {
            round(&tab, &link, false).await;
            memories.push(tab.eval(memory).await);
            if [2, 20].contains(&number) {
                heaps.push(made(&tab).await);
            }
        }
        println!("bytes of what the page has made: {heaps:?}; of its program: {memories:?}");
        for (then, now) in [(heaps[0], heaps[1]), (memories[1], memories[19])] {
            assert!(now <= 1.1 * then, "{now} bytes, {then} after two");
        }
        let a_round = (heaps[1] - heaps[0]) / 18.0;
        assert!(a_round < 500.0, "{a_round} bytes stay of each round");
        // A page that holds on to what it has removed is found.
        for _ in 0..2 {
            round(&tab, &link, true).await;
        }
        let a_round = (made(&tab).await - heaps[1]) / 2.0;
        assert!(a_round > 2000.0, "{a_round} bytes of what is kept");
    });
}
