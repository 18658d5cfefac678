// embed.html: one illustration in a bare <iframe>. Its address has the payload (embed.html#…) or a document's address
// (embed.html?doc=…). It makes no history entries and stores nothing.
//
// The page around it may speak to it by messages, if `?parent=` names that page's origin (several are parted by commas):
//   { fabrica: 1, type: "command", id, name, args }   name: next, previous, play, pause, reset, present, setParam,
//                                                    toDataURL, step, steps
//   { fabrica: 1, type: "result", id, value } or { …, error }
//   { fabrica: 1, type: "event", name, detail }        ready, stepchange, paramchange, viewchange, error
// Its height is told to every parent, as { fabrica: 1, type: "height", height } and as learning platforms understand it:
// { subject: "lti.frameResize", height } (1EdTech: Canvas, Moodle, Blackboard).

import "../fabrica-viewer.js";

// The scripts came: no words about those that do not.
document.querySelector(".late")?.remove();

const VERSION = 1;
const viewer = document.querySelector("fabrica-viewer");
// Some platforms write `&amp;` in an address for `&`.
const query = new URLSearchParams(location.search.replace(/&(amp;)+/g, "&"));
const parents = (query.get("parent") ?? "").split(",").map((text) => text.trim()).filter((text) => !["", "*", "/"].includes(text));
const isFramed = window.parent !== window;

/** The payload stands behind `#`; platforms that drop that may give it as `?s=`. */
function source() {
  const hash = location.hash.slice(1);
  if (hash) return `#${hash}`;
  const step = query.has("step") ? `&step=${query.get("step")}` : "";
  if (query.has("s")) return `#${query.get("s")}${step}`;
  return query.get("doc") ?? "";
}

function open() {
  if (query.has("step")) viewer.setAttribute("step", query.get("step"));
  viewer.setAttribute("src", source());
}

open();
window.addEventListener("hashchange", open);

/** To the parents that the address names, and to nobody else. */
function post(message) {
  if (!isFramed) return;
  for (const origin of parents) {
    try {
      window.parent.postMessage({ fabrica: VERSION, ...message }, origin);
    } catch {
      console.warn(`embed.html: ?parent=${origin} is no origin`);
    }
  }
}

for (const name of ["ready", "stepchange", "paramchange", "viewchange", "error"]) {
  viewer.addEventListener(name, (event) => post({ type: "event", name, detail: event.detail }));
}

const COMMANDS = {
  next: () => viewer.next(),
  previous: () => viewer.previous(),
  play: () => viewer.play(),
  pause: () => viewer.pause(),
  reset: () => viewer.reset(),
  present: () => viewer.present(),
  step: (step) => {
    if (step !== undefined) viewer.step = step;
    return viewer.step;
  },
  steps: () => viewer.steps,
  setParam: (pointer, value) => viewer.setParam(pointer, value),
  toDataURL: () => viewer.toDataURL(),
};

window.addEventListener("message", async ({ data, origin, source: from }) => {
  if (from !== window.parent || !parents.includes(origin)) return;
  if (data?.fabrica !== VERSION || data.type !== "command" || !Object.hasOwn(COMMANDS, data.name)) return;
  try {
    const value = await COMMANDS[data.name](...(Array.isArray(data.args) ? data.args : []));
    post({ type: "result", id: data.id, value });
  } catch (error) {
    post({ type: "result", id: data.id, error: String(error.message ?? error) });
  }
});

if (isFramed) {
  document.documentElement.classList.add("framed");
  let told = 0;
  new ResizeObserver(() => {
    const height = Math.ceil(viewer.getBoundingClientRect().height);
    // A parent that adds a border to what it is told must not be asked again for that.
    if (Math.abs(height - told) < 2 || height === 0) return;
    told = height;
    // The height is no secret, and who asks for it cannot be known.
    window.parent.postMessage({ fabrica: VERSION, type: "height", height }, "*");
    window.parent.postMessage({ subject: "lti.frameResize", height }, "*");
  }).observe(viewer);
}
