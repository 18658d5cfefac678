// Starts the viewer on the page's canvas, and says in plain words what is the matter where it cannot.
// No logic lives here that is worth a unit test: decisions are made in src/shell/web.rs.

import { WORKER, partOf, startPart } from "./parts.js";
import { Texts } from "./texts.js";

const element = (id) => document.getElementById(id);

/** Shows one message in place of the picture: cause first, then what to do. */
function show(message, remedies = [], keep = "") {
  element("cover").hidden = false;
  element("message").textContent = message;
  const list = element("remedies");
  list.replaceChildren(
    ...remedies.map((text) => {
      const item = document.createElement("p");
      item.textContent = text;
      return item;
    }),
  );
  list.hidden = remedies.length === 0;
  element("keep").textContent = keep;
  element("keep").hidden = keep === "";
}

/** What a reader can do about a missing WebGPU, by what this browser says it is. */
function remedies() {
  const agent = navigator.userAgent;
  const list = [];
  if (!window.isSecureContext) {
    list.push("Open this page over https:// (or from localhost): browsers give WebGPU to secure pages only.");
  }
  if (/iPhone|iPad|Macintosh/.test(agent) && /Safari/.test(agent) && !/Chrom|Firefox/.test(agent)) {
    list.push("Safari has WebGPU from version 26 (macOS Tahoe, iOS 26) on; please bring the system up to date.");
  } else if (/Firefox/.test(agent)) {
    list.push("Firefox has WebGPU on Windows from version 141 and on macOS from 145 on; elsewhere it can be switched on as dom.webgpu.enabled in about:config.");
  } else if (/Linux|CrOS/.test(agent) && !/Android/.test(agent)) {
    list.push("Chrome and Chromium on Linux: open chrome://flags, switch on “Unsafe WebGPU Support” and “Vulkan”, and start the browser again.");
  } else {
    list.push("Chrome and Edge have WebGPU from version 113 on (Android: 121); please bring the browser up to date.");
  }
  list.push("See that “Use graphics acceleration when available” is on in the browser's settings, and that chrome://gpu names no blocked WebGPU.");
  list.push("Or open the same link on another device, or with the native program: fabrica view LINK.");
  return list;
}

/** Caption and steps of the document in the address as text, for who cannot see the picture. */
function describe(fabrica) {
  const box = element("caption");
  try {
    const text = fabrica.describe(location.href);
    box.textContent = text;
    box.hidden = text === "";
  } catch {
    box.hidden = true;
  }
}

/**
 * True if the viewer is sure to show the built-in head: nothing in the address, nothing kept from an earlier visit. What a link
 * holds only the viewer itself can read.
 */
function showsTheHead() {
  if (location.hash.length > 1 || /[?&](s|doc)=/.test(location.search)) return false;
  try {
    return [sessionStorage, localStorage].every((kept) => kept.getItem("fabrica.document") === null);
  } catch {
    return true;
  }
}

/** The part that a document beside the page needs, which the address names; null where only the viewer can tell. */
async function partOfDocument() {
  const name = /^#[\w-]{16,}/.test(location.hash) ? null : new URLSearchParams(location.search).get("doc");
  if (name === null || !URL.canParse(name, location.href)) return null;
  const address = new URL(name, location.href);
  if (address.origin !== location.origin) return null;
  try {
    const response = await fetch(address);
    return response.ok ? partOf(await response.text(), address.href) : null;
  } catch {
    return null;
  }
}

/**
 * Decides in the text of egui's shader what it asks at each pixel: whether to filter textures by hand and whether to dither,
 * neither of which the viewer wants. A software GPU works out all answers, and took seven times as long to draw the panels.
 */
function decideInShader() {
  if (!window.GPUDevice) return;
  const make = GPUDevice.prototype.createShaderModule;
  GPUDevice.prototype.createShaderModule = function (module) {
    if (module.label !== "egui") return make.call(this, module);
    const filters = module.code.replace("r_locals.predictable_texture_filtering == 0", "true");
    return make.call(this, { ...module, code: filters.replaceAll("r_locals.dithering == 1", "false") });
  };
}

async function main() {
  decideInShader();
  let fabrica;
  let program;
  let early = navigator.gpu && showsTheHead() ? startPart("subjects") : null;
  const named = navigator.gpu && !early ? partOfDocument().then((part) => part && startPart(part)) : null;
  try {
    fabrica = await import("./fabrica.js");
    program = await fabrica.default({ module_or_path: new URL("./fabrica_bg.wasm", import.meta.url) });
  } catch (error) {
    console.error(error);
    show("The viewer could not be loaded.", [
      "Check the connection and load the page again.",
      "If this page comes from a folder of your own, serve fabrica_bg.wasm beside it as application/wasm.",
      String(error),
    ]);
    return;
  }
  if (!early && navigator.gpu) {
    early = await named;
    const part = early ? null : fabrica.part_of_address();
    early ??= part ? startPart(part) : null;
  }
  const keep = "Nothing is lost: the illustration is in this page's address.";
  let adapter = null;
  try {
    adapter = navigator.gpu ? await navigator.gpu.requestAdapter({ powerPreference: "high-performance" }) : null;
  } catch (error) {
    console.warn(error);
  }
  if (!adapter) {
    const cause = navigator.gpu
      ? "This browser knows WebGPU, but has no graphics device for it."
      : "This browser has no WebGPU, which the picture is drawn with.";
    early?.worker.terminate();
    show(cause, remedies(), keep);
    describe(fabrica);
    document.documentElement.dataset.state = "no-webgpu";
    return;
  }
  const query = new URLSearchParams(location.search);
  if (query.has("bench")) {
    early?.worker.terminate();
    await bench(fabrica, ["bench", "size", "voxels", "rows"].map((key) => Math.max(Number.parseInt(query.get(key), 10) || 0, 0)));
    return;
  }
  const host = fabrica.foreign_document_host();
  if (host && !(await agreed(host))) {
    show("The document was not fetched.", [], "The page's address still names it: load the page again to be asked once more.");
    return;
  }
  const viewer = new fabrica.Viewer(element("fabrica"), WORKER);
  if (early) viewer.lend(early.part, early.worker);
  viewer.on_copy_refused(offerText);
  const [, , captions] = LIST[navigator.language.slice(0, 2)] ?? LIST.en;
  viewer.set_texts(new Texts(element("fabrica"), captions, (caption) => viewer.edit_caption(caption)));
  // For whoever embeds or tests the page; the viewer itself never reads it.
  window.fabrica = { viewer, module: fabrica, memory: program.memory };
  try {
    await viewer.start();
  } catch (error) {
    console.error(error);
    show("The viewer could not start.", [String(error), ...remedies()], keep);
    document.documentElement.dataset.state = "failed";
    return;
  }
  addEventListener("keydown", (event) => keepFromBrowser(viewer, event), true);
  element("cover").hidden = true;
  nameField();
  offerList(viewer);
  document.documentElement.dataset.state = "started";
  watch(viewer, keep);
}

/** What the controls are called for assistive technology, the button that asks for them as elements of the page, and the captions. */
const LIST = {
  en: ["Controls", "List the controls for a screen reader", "Labels"],
  de: ["Bedienelemente", "Bedienelemente für einen Screenreader auflisten", "Beschriftungen"],
  es: ["Controles", "Enumerar los controles para un lector de pantalla", "Rótulos"],
  zh: ["控件", "为屏幕阅读器列出控件", "标注"],
};

/** The field that takes what is typed into the canvas has a name for who hears the page. */
function nameField() {
  for (const field of document.querySelectorAll("main > input")) field.setAttribute("aria-label", "Fabrica");
}

/** The canvas tells assistive technology nothing; who asks for it gets its controls as elements. */
function offerList(viewer) {
  const [name, offer] = LIST[navigator.language.slice(0, 2)] ?? LIST.en;
  const button = element("list");
  button.textContent = offer;
  button.hidden = false;
  button.onclick = async () => {
    try {
      const { startMirror } = await import("./mirror.js");
      startMirror(viewer, name);
      button.remove();
    } catch (error) {
      console.error(error);
    }
  };
}

/** The browser's own search stays closed where the same keys find a tissue. */
function keepFromBrowser(viewer, event) {
  const isFind = (event.ctrlKey || event.metaKey) && !event.altKey && event.key.toLowerCase() === "f";
  if (isFind && viewer.finds_tissues()) event.preventDefault();
}

/** Frame times in place of the viewer. */
async function bench(fabrica, plan) {
  window.fabrica = { module: fabrica };
  show("Frame times on this device");
  try {
    const { showBench } = await import("./bench.js");
    window.fabrica.report = await showBench(fabrica, element("remedies"), plan);
    document.documentElement.dataset.state = "measured";
  } catch (error) {
    console.error(error);
    show("The frame times could not be measured.", [String(error)]);
    document.documentElement.dataset.state = "failed";
  }
}

/** Looks after a fault in the viewer, which leaves the picture frozen, and after a lost graphics device. */
function watch(viewer, keep) {
  let losses = 0;
  const timer = setInterval(async () => {
    if (viewer.has_panicked()) {
      clearInterval(timer);
      show("The viewer stopped because of a fault in it.", ["Load the page again to go on.", viewer.panic_message()], keep);
      document.documentElement.dataset.state = "panicked";
    } else if (document.documentElement.dataset.state === "started" && viewer.is_lost()) {
      losses += 1;
      document.documentElement.dataset.state = "lost";
      document.documentElement.dataset.losses = losses;
      try {
        // A device that is lost again and again has a reason that starting again does not remove.
        if (losses > 5) throw new Error("It was lost " + losses + " times.");
        await viewer.restart();
        nameField();
        document.documentElement.dataset.state = "started";
      } catch (error) {
        clearInterval(timer);
        show("The graphics device was lost and could not be had again.", ["Load the page again.", String(error)], keep);
        document.documentElement.dataset.state = "failed";
      }
    }
  }, 500);
}

/** Asks before anything is fetched from another host than the page's. */
function agreed(host) {
  return new Promise((resolve) => {
    show(`This address opens a document from another place: ${host}.`, ["That host will see that you asked for it. Nothing of yours is sent to it."]);
    const button = document.createElement("button");
    button.textContent = `Open the document from ${host}`;
    button.id = "agree";
    const no = document.createElement("button");
    no.textContent = "Leave it";
    element("remedies").append(button, no);
    button.onclick = () => {
      show("Loading the document…");
      resolve(true);
    };
    no.onclick = () => resolve(false);
  });
}

/** A text that the clipboard refused, with a button whose tap every browser accepts. */
function offerText(text) {
  const dialog = document.createElement("dialog");
  const field = document.createElement("textarea");
  const copy = document.createElement("button");
  const close = document.createElement("button");
  field.value = text;
  field.readOnly = true;
  field.rows = 5;
  copy.textContent = "Copy";
  close.textContent = "Close";
  copy.onclick = async () => {
    field.select();
    try {
      await navigator.clipboard.writeText(text);
      dialog.close();
    } catch {
      copy.textContent = "Press Ctrl+C";
    }
  };
  close.onclick = () => dialog.close();
  dialog.onclose = () => dialog.remove();
  dialog.append("The link", field, copy, close);
  document.body.append(dialog);
  dialog.showModal();
  field.select();
}

main();
