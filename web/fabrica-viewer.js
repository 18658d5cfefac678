// <fabrica-viewer>: an illustration in a page of one's own.
//
//   <script type="module" src="fabrica-viewer.js"></script>
//   <fabrica-viewer src="#PAYLOAD" alt="…" controls></fabrica-viewer>
//
// Attributes: src (a link, a payload or the address of a document), poster, alt, step, controls, loading="lazy".
// Properties and methods: steps, step, next(), previous(), setParam(pointer, value), toDataURL() (a Promise).
// Events: ready, stepchange, error. No inline script, no cookie, no request to a third party: parts.js, worker.js and the
// programs (fabrica*.js, fabrica*_bg.wasm) are taken from beside this file. What it cannot draw it says in words.

import { WORKER, startPart } from "./parts.js";

const here = (name) => new URL(name, import.meta.url).href;

/** The program is loaded once for all elements of a page, when the first one starts. */
let loading;
function program() {
  loading ??= import("./fabrica.js").then(async (fabrica) => {
    await fabrica.default({ module_or_path: here("./fabrica_bg.wasm") });
    return fabrica;
  });
  return loading;
}

/** A link or payload, as opposed to the address of a document. */
function linkIn(src) {
  if (src.startsWith("{")) return src;
  const at = src.indexOf("#");
  if (at >= 0) return src.slice(at);
  const query = /[?&]s=([A-Za-z0-9_-]+)/.exec(src);
  if (query) return "#" + query[1];
  return null;
}

const STYLE = `
  :host { display: flex; flex-direction: column; aspect-ratio: 4 / 3; min-height: 12rem; font: 16px/1.5 system-ui, sans-serif; }
  :host([hidden]) { display: none; }
  .stage { position: relative; flex: 1; min-height: 0; }
  canvas, img.poster { position: absolute; inset: 0; width: 100%; height: 100%; display: block; }
  img.poster { object-fit: contain; }
  .words { position: absolute; inset: 0; overflow: auto; padding: 1rem; white-space: pre-line; }
  .words.over-poster { top: auto; background: rgb(255 255 255 / 0.92); color: #2b2622; max-height: 60%; }
  .steps { display: flex; gap: 0.5rem; align-items: center; padding: 0.5rem; }
  .steps button { font: inherit; min-width: 2.75rem; min-height: 2.75rem; }
  [hidden] { display: none !important; }
`;

class FabricaViewer extends HTMLElement {
  static observedAttributes = ["src", "step", "alt", "poster", "controls"];

  #generation = 0; // A start that was overtaken by another finds that its number is old.
  #viewer = null;
  #observer = null;
  #watch = 0;
  #document = null;
  #step = 0;
  #parts = null;

  connectedCallback() {
    this.#build();
    if (this.getAttribute("loading") === "lazy" && "IntersectionObserver" in window) {
      this.#observer = new IntersectionObserver((entries) => {
        if (entries.some((entry) => entry.isIntersecting)) {
          this.#observer?.disconnect();
          this.#observer = null;
          this.#start();
        }
      }, { rootMargin: "200px" });
      this.#observer.observe(this);
    } else {
      this.#start();
    }
  }

  disconnectedCallback() {
    this.#generation += 1;
    this.#observer?.disconnect();
    this.#observer = null;
    clearInterval(this.#watch);
    this.#viewer?.destroy();
    this.#viewer?.free?.();
    this.#viewer = null;
  }

  attributeChangedCallback(name, before, after) {
    if (before === after || !this.isConnected || !this.#parts) return;
    if (name === "src") {
      this.disconnectedCallback();
      this.#build();
      this.#start();
    } else if (name === "step") {
      this.step = Number(after);
    } else {
      this.#dress();
    }
  }

  /** Titles and captions of the steps; step N of the document is entry N − 1. */
  get steps() {
    return (this.#document?.steps ?? []).map(({ title = "", caption = "" }) => ({ title, caption }));
  }

  /** The step shown, 0 for the document as it stands. */
  get step() {
    return this.#step;
  }

  set step(value) {
    const step = Math.min(Math.max(Math.round(Number(value) || 0), 0), this.steps.length);
    if (step === this.#step) return;
    this.#step = step;
    this.#show();
    this.#dress();
    this.dispatchEvent(new CustomEvent("stepchange", { detail: { step } }));
  }

  next() {
    this.step = this.#step + 1;
  }

  previous() {
    this.step = this.#step - 1;
  }

  /** Sets one value of the document by its JSON pointer: setParam("/templates/0/params/progress", 0.8). */
  setParam(pointer, value) {
    if (!this.#document || !this.#viewer) throw new Error("fabrica-viewer: not ready yet");
    this.#document = JSON.parse(this.#fabrica.with_value(JSON.stringify(this.#document), pointer, JSON.stringify(value)));
    this.#show();
  }

  /** The picture as a data: address of a PNG. */
  async toDataURL() {
    if (!this.#viewer) throw new Error("fabrica-viewer: not ready yet");
    const bytes = await this.#viewer.picture();
    return new Promise((resolve, reject) => {
      const reader = new FileReader();
      reader.onload = () => resolve(reader.result);
      reader.onerror = () => reject(reader.error);
      reader.readAsDataURL(new Blob([bytes], { type: "image/png" }));
    });
  }

  #fabrica = null;

  #build() {
    const root = this.shadowRoot ?? this.attachShadow({ mode: "open" });
    const sheet = new CSSStyleSheet();
    sheet.replaceSync(STYLE);
    root.adoptedStyleSheets = [sheet];
    const make = (tag, name) => {
      const element = document.createElement(tag);
      if (name) element.className = name;
      return element;
    };
    const stage = make("div", "stage");
    const canvas = make("canvas");
    const poster = make("img", "poster");
    const words = make("div", "words");
    const steps = make("div", "steps");
    const previous = make("button");
    const next = make("button");
    const where = make("span");
    previous.textContent = "‹";
    previous.setAttribute("aria-label", "Previous step");
    next.textContent = "›";
    next.setAttribute("aria-label", "Next step");
    where.setAttribute("aria-live", "polite");
    previous.onclick = () => this.previous();
    next.onclick = () => this.next();
    steps.append(previous, next, where);
    stage.append(canvas, poster, words);
    root.replaceChildren(stage, steps);
    this.#parts = { canvas, poster, words, steps, previous, next, where };
    words.textContent = "Loading the illustration…";
    this.#dress();
  }

  /** Brings what surrounds the picture in line with the attributes and the step. */
  #dress() {
    const { canvas, poster, steps, previous, next, where } = this.#parts;
    const alt = this.getAttribute("alt") ?? this.#document?.title ?? "An anatomical illustration";
    canvas.setAttribute("role", "img");
    canvas.setAttribute("aria-label", alt);
    poster.alt = alt;
    if (this.hasAttribute("poster")) poster.src = this.getAttribute("poster");
    poster.hidden = !this.hasAttribute("poster") || this.#viewer !== null;
    const list = this.steps;
    steps.hidden = !this.hasAttribute("controls") || list.length === 0 || this.#viewer === null;
    previous.disabled = this.#step === 0;
    next.disabled = this.#step === list.length;
    const { title = "", caption = "" } = list[this.#step - 1] ?? this.#document ?? {};
    where.textContent = [title, caption].filter(Boolean).join(": ");
  }

  /** Words in place of the picture, over the poster if there is one. */
  #say(text) {
    const { words } = this.#parts;
    words.textContent = text;
    words.hidden = text === "";
    words.classList.toggle("over-poster", this.hasAttribute("poster"));
  }

  #show() {
    if (!this.#viewer || !this.#document) return;
    try {
      this.#viewer.set_link(this.#fabrica.at_step(JSON.stringify(this.#document), this.#step));
    } catch (error) {
      this.#fail(error);
    }
  }

  #fail(error) {
    this.dispatchEvent(new CustomEvent("error", { detail: { message: String(error) } }));
  }

  async #start() {
    const generation = ++this.#generation;
    const isStale = () => generation !== this.#generation;
    try {
      const src = this.getAttribute("src") ?? "";
      const fabrica = await program();
      if (isStale()) return;
      this.#fabrica = fabrica;
      let base = document.baseURI;
      let text = src === "" ? '{"fabrica":1}' : linkIn(src);
      if (text === null) {
        base = new URL(src, document.baseURI).href;
        const response = await fetch(base, { credentials: "same-origin" });
        if (!response.ok) throw new Error(`The document ${src} could not be fetched (${response.status}).`);
        text = await response.text();
      }
      if (isStale()) return;
      this.#document = JSON.parse(fabrica.to_document(text));
      const wanted = this.hasAttribute("step") ? Number(this.getAttribute("step")) : fabrica.step_of(text);
      this.#step = Math.min(Math.max(Math.round(wanted) || 0, 0), this.steps.length);
      this.#dress();
      const part = navigator.gpu ? fabrica.first_part(JSON.stringify(this.#document), base) : null;
      const early = part ? startPart(part) : null;
      const adapter = navigator.gpu ? await navigator.gpu.requestAdapter() : null;
      if (isStale() || !adapter) early?.worker.terminate();
      if (isStale()) return;
      if (!adapter) {
        const words = fabrica.describe(JSON.stringify(this.#document));
        this.#say([words, "This browser has no WebGPU, which the picture is drawn with."].filter(Boolean).join("\n\n"));
        this.#fail(new Error("This browser has no WebGPU."));
        return;
      }
      const viewer = new fabrica.Viewer(this.#parts.canvas, WORKER, false);
      if (early) viewer.lend(early.part, early.worker);
      viewer.set_base(base);
      viewer.set_link(fabrica.at_step(JSON.stringify(this.#document), this.#step));
      await viewer.start();
      if (isStale()) {
        viewer.destroy();
        return;
      }
      this.#viewer = viewer;
      this.#say("");
      this.#dress();
      this.#watch = setInterval(() => this.#look(), 500);
      this.dispatchEvent(new CustomEvent("ready"));
    } catch (error) {
      if (isStale()) return;
      this.#say(`This illustration cannot be shown. ${error instanceof Error ? error.message : error}`);
      this.#fail(error);
    }
  }

  /** Looks after a fault and after a lost graphics device. */
  async #look() {
    const viewer = this.#viewer;
    if (viewer?.has_panicked()) {
      clearInterval(this.#watch);
      this.#say("The viewer stopped because of a fault in it. Load the page again to go on.");
      this.#fail(new Error(viewer.panic_message()));
    } else if (viewer?.is_lost()) {
      clearInterval(this.#watch);
      try {
        await viewer.restart();
        this.#watch = setInterval(() => this.#look(), 500);
      } catch (error) {
        this.#say("The graphics device was lost and could not be had again. Load the page again.");
        this.#fail(error);
      }
    }
  }
}

if (!customElements.get("fabrica-viewer")) customElements.define("fabrica-viewer", FabricaViewer);
