//! The reader: illustrations as elements in somebody else's page.

use super::hand::pause;
use super::harness::{Session, Tab};
use super::*;

/// A lesson of the cube with a value that its readers may move.
pub(crate) const LESSON: &str = r#"{"fabrica":1,"title":"Opening a cube","caption":"It is whole.","subject":{"builtin":"cube"},"templates":[{"kind":"split","size":[1.2,1.2,1.2],"params":{"amount":0}}],"labels":[{"at":[0.3,0.3,0.3],"text":"A corner"},{"at":[0,0,0],"text":"Its middle"}],"controls":[{"pointer":"/templates/0/params/amount","name":"Gap"},{"pointer":"/templates/0/enabled","name":"Split at all"}],"steps":[{"title":"Apart","caption":"The halves part.","set":{"/templates/0/params/amount":0.3}},{"title":"Nearer","set":{"/camera/distance":1.8}}]}"#;

/// Counts what a page makes on its graphics device, its workers, frames and timers. Stands before all other scripts.
const LEDGER: &[u8] = br"
window.ledger = { textures: new Map(), buffers: new Map(), devices: new Set(), workers: new Set(), frames: 0, timers: 0 };
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
      ledger[kept].set(made, { bytes: bytes(descriptor), device: this, label: descriptor.label, is3d: descriptor.dimension === '3d' });
      const destroy = made.destroy;
      made.destroy = function () { ledger[kept].delete(made); return destroy.call(this); };
      return made;
    };
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
const Plain = window.Worker;
window.Worker = class extends Plain {
  constructor(...args) { super(...args); ledger.workers.add(this); }
  terminate() { ledger.workers.delete(this); super.terminate(); }
};
for (const [name, count] of [['requestAnimationFrame', 'frames'], ['setTimeout', 'timers'], ['setInterval', 'timers']]) {
  const plain = window[name];
  window[name] = (...args) => { ledger[count] += 1; return plain(...args); };
}
ledger.bytes = () => ['textures', 'buffers'].flatMap((kept) => [...ledger[kept].values()]).reduce((sum, { bytes }) => sum + bytes, 0);
ledger.volumes = () => [...ledger.textures.values()].filter(({ is3d, bytes }) => is3d && bytes > 1e6).length;
window.told = [];
for (const name of ['ready', 'stepchange', 'paramchange', 'viewchange', 'error']) {
  document.addEventListener(name, (event) => window.told.push([name, event.target.id, event.detail]));
}
";

/// A page with embeds of these attributes, the first with the id `e0`, under the policy that the documentation names.
fn page_of(embeds: &[String], between: &str) -> Vec<u8> {
    let embeds: Vec<String> = embeds
        .iter()
        .enumerate()
        .map(|(index, rest)| format!("<fabrica-viewer id=e{index} {rest}</fabrica-viewer>"))
        .collect();
    format!(
        "<!doctype html><html lang=en><meta name=viewport content=\"width=device-width\"><meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; connect-src 'self'; worker-src 'self'; img-src 'self' data:\"><title>A lesson</title><script src=ledger.js></script><script type=module src=fabrica-viewer.js></script><h1>A lesson</h1>{}</html>",
        embeds.join(between)
    )
    .into_bytes()
}

fn lesson(attributes: &str) -> String {
    format!("src=\"#{}\" {attributes}>", payload(LESSON))
}

async fn open(session: &Session, embeds: &[String], between: &str, size: (u32, u32)) -> Tab {
    session.server.add("ledger.js", LEDGER.to_vec());
    session.server.add("lesson.html", page_of(embeds, between));
    let tab = session.open("lesson.html").await;
    tab.resize(size.0, size.1).await;
    tab
}

/// Waits until so many embeds have told that they are ready.
async fn ready(tab: &Tab, number: usize) {
    tab.wait_until(
        &format!("window.told.filter(([name]) => name === 'ready' || name === 'error').length >= {number}"),
        240,
    )
    .await;
    let faults: Vec<serde_json::Value> = tab.eval("window.told.filter(([name]) => name === 'error')").await;
    assert!(faults.is_empty(), "{faults:?}");
}

#[test]
fn zz_look() {
    with_browser(BrowserGpu::Software, |session| async move {
        let tab = open(&session, &[lesson("controls")], "", (480, 760)).await;
        ready(&tab, 1).await;
        pause(2000).await;
        for code in ["e.reader.side(1, 'en')", "e.reader.describe(1, 'en')", "e.reader.view(1)", "e.reader.document(1)"] {
            let said: String = tab.eval(&format!("import('./reader/engine.js').then(m => m.theEngine()).then(async e => String(await ({code}))).catch(e => e.stack ?? String(e))")).await;
            println!("{code}: {said}");
        }
        println!("{}", tab.messages().await);
    });
}
