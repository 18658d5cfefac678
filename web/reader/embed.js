// One illustration in a page: its picture with captions, its words and controls, around a picture of the engine.

import { Captions } from "./captions.js";
import { Controls } from "./controls.js";
import { partOf } from "../parts.js";
import { askEarly, bindings, isTrap, seconds, theEngine } from "./engine.js";
import { Hands } from "./hands.js";
import { Marks } from "./marks.js";
import { STYLE } from "./style.js";
import { nearest, wordsOf } from "./words.js";

/** Pixels of a picture at most; it is scaled up beyond. */
const MOST_PIXELS = 4.2e6;

/** A fragment that can be a payload: letters of base64url, and many. A shorter one is a place in a page (`#top`). */
const PAYLOAD = /^[\w-]{16,}/;

/** Where an embed stands that has no picture yet. */
const NOWHERE = { step: 0, position: 0, playing: false, strayed: false, values: [], troubles: [] };

const sheet = new CSSStyleSheet();
sheet.replaceSync(STYLE);

/** What `src` means: a link, a payload or a document as text, or the address of a document. */
export function sourceOf(src) {
  // What platforms and mails make of a link: line breaks, `&amp;`, an encoded `&` or `#`, added parameters.
  if (src.trimStart().startsWith("{")) return { text: src };
  const text = src
    .replace(/[\r\n\t]+/g, "")
    .trim()
    .replace(/&(amp;)+/g, "&")
    .replace(/^%23/, "#")
    .replace(/%26step(=|%3D)/gi, "&step=");
  if (text === "") return { text: '{"fabrica":1}' };
  const [page, fragment = ""] = text.split(/#(.*)/);
  const query = new URLSearchParams(page.split("?")[1] ?? "");
  // Which of the two holds the document the program finds out, as for every address.
  if (query.has("s") || PAYLOAD.test(fragment)) return { text };
  if (query.has("doc")) {
    const base = new URL(text, document.baseURI);
    return { address: new URL(query.get("doc"), base).href, step: Number(query.get("step") ?? NaN) };
  }
  if (fragment !== "") return { text };
  // A payload without its mark.
  if (/^[\w-]{16,}(&step=\d+)?$/.test(text)) return { text: `#${text}` };
  return { address: text };
}

export class Embed {
  id = 0;
  isDirty = false;
  isSeen = true;
  isWalking = false;
  waits = false;

  /** The whole picture was there once. */
  #isWhole = false;
  #host;
  #root;
  #engine = null;
  #outline = null;
  #state = NOWHERE;
  #wanted;
  #opening = 0;
  #isHandled = false;
  #told = "";
  #texts = "";
  #shown = {};
  #lastView = "";
  #parts = {};
  #watches = [];
  #timer = 0;
  #lang = "en";
  /** Where the document came from: its text, its base and, if it has one, its address. */
  #from = null;
  /** The hosts that its reader has agreed to fetch from. */
  #allowed = new Set();
  /** Files that its reader has given, and whether they are due again. */
  #files = [];
  #isFileDue = false;
  /** A question or a fault stands there that the picture before, which may still be drawn, knows nothing of. */
  #isTold = false;
  #presentation = null;
  /** Of the page, while its frame is filled. */
  #overflow = "";

  constructor(host, root, step) {
    this.#host = host;
    this.#root = root;
    this.#wanted = step;
  }

  // ---- What the element has ----

  get steps() {
    return (this.#outline?.steps ?? []).map(({ title, legend }) => ({ title, caption: legend }));
  }
  get step() {
    return this.#outline ? this.#state.step : (this.#wanted ?? 0);
  }
  get position() {
    return this.#state.position;
  }
  get isReady() {
    return this.#isWhole && this.#engine !== null;
  }
  get isPlaying() {
    return this.#state.playing;
  }

  go(step) {
    if (!this.#engine) {
      this.#wanted = step;
      return;
    }
    this.#engine.reader.go(this.id, step, seconds());
    this.#changed();
  }

  play(plays) {
    if (!this.#engine || plays === this.isPlaying) return;
    this.#engine.reader.toggle_playing(this.id, seconds());
    this.#changed();
  }

  scrub(position) {
    this.#engine?.reader.scrub(this.id, position);
    this.#changed();
  }

  setParam(pointer, value) {
    try {
      this.#engine.reader.set(this.id, pointer, JSON.stringify(value) ?? "null");
    } catch (error) {
      if (this.#engine) this.#tell("error", { message: String(error.message ?? error) });
      throw new Error(String(error.message ?? error));
    }
    this.#heedTexts();
    this.#tell("paramchange", { pointer, value });
    this.#changed();
  }

  reset() {
    if (!this.#engine) return;
    this.#engine.reader.reset(this.id);
    this.#heedTexts();
    this.#tell("viewchange", { view: this.view });
    this.#changed();
  }

  get view() {
    return JSON.parse(this.#engine?.reader.view(this.id) || "null");
  }

  async toDataURL() {
    const [bytes, width, height] = await this.#engine.reader.picture(this.id);
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = [width, height];
    canvas.getContext("2d").putImageData(new ImageData(bytes, width, height), 0, 0);
    return canvas.toDataURL("image/png");
  }

  // ---- What hands and controls do ----

  get isMoving() {
    return this.#isHandled || this.isWalking;
  }

  moving(is) {
    if (this.#isHandled === is) return;
    this.#isHandled = is;
    this.#wake();
    if (!is) this.#turned();
  }

  turn(right, down) {
    this.#engine?.reader.turn(this.id, right, down);
    this.#viewed();
  }
  zoom(factor) {
    this.#engine?.reader.zoom(this.id, factor);
    this.#viewed();
  }
  shift(right, down) {
    this.#engine?.reader.shift(this.id, right, down);
    this.#viewed();
  }
  roll(angle) {
    this.#engine?.reader.roll(this.id, angle);
    this.#viewed();
  }

  #viewed() {
    this.#changed();
    if (!this.#isHandled) this.#turned();
  }

  /** The view may have come to rest elsewhere: it is told, with the side that one looks from. */
  #turned() {
    if (!this.#engine) return;
    const view = this.#engine.reader.view(this.id);
    if (view === this.#lastView) return;
    this.#lastView = view;
    this.#tell("viewchange", { view: this.view });
    this.#say(this.#engine.reader.side(this.id, this.#lang));
  }

  get #isFull() {
    return this.#host.matches(":fullscreen") || this.#parts.view.classList.contains("fills");
  }

  full() {
    return this.#isFull ? this.#shrink() : this.#fill();
  }

  async #fill() {
    try {
      await this.#host.requestFullscreen();
    } catch {
      // Where a frame or a device forbids it, the picture fills the frame, over all that the page has.
      const { view } = this.#parts;
      view.classList.add("fills");
      // What lies below does not scroll, and its scroll bar is no part of the picture.
      const { style } = document.documentElement;
      [this.#overflow, style.overflow] = [style.overflow, "hidden"];
      view.popover = "manual";
      view.showPopover();
    }
  }

  #shrink() {
    if (this.#host.matches(":fullscreen")) return document.exitFullscreen();
    const { view } = this.#parts;
    view.classList.remove("fills");
    view.removeAttribute("popover");
    document.documentElement.style.overflow = this.#overflow;
  }

  /** Shows the lesson to a room. */
  async present() {
    if (!this.isReady || this.#presentation) return;
    const { view, stage, hands, captions } = this.#parts;
    this.#presentation = "begins";
    const [focused, wasFull] = [this.#root.activeElement ?? document.activeElement, this.#isFull];
    hands.leave();
    if (!wasFull) await this.#fill();
    const left = () => {
      this.#presentation = null;
      if (!wasFull && this.#isFull) this.#shrink();
      if (focused === document.body) stage.blur();
      else focused.focus({ preventScroll: true });
      this.#wake();
    };
    try {
      const { Presentation } = await import("./present.js");
      this.#presentation = new Presentation({
        embed: this,
        host: this.#host,
        root: this.#root,
        view,
        stage,
        words: this.#words,
        outline: this.#outline,
        measure: () => {
          captions.measure();
          this.#wake();
        },
        say: (text) => this.#say(text),
        link: () => this.#linkOf(),
        code: async (text) => (await bindings()).qr_of(text),
        left,
      });
    } catch (error) {
      left();
      this.#tell("error", { message: String(error.message ?? error) });
    }
  }

  /** The address of the step that is shown, as the reader alone on a page. */
  async #linkOf() {
    const page = new URL("../embed.html", import.meta.url).href;
    const step = this.step ? `&step=${this.step}` : "";
    const { text, base, address } = this.#from;
    if (address !== undefined && /^https?:/.test(base)) return `${page}?doc=${encodeURIComponent(base)}${step}`;
    const { payload_of: payloadOf } = await bindings();
    return `${page}#${payloadOf(text)}${step}`;
  }

  /** The keyboard asks to leave what fills the frame. */
  escape() {
    if (this.#isFull) this.#shrink();
  }

  entered(isInside) {
    this.#parts.hint.textContent = isInside ? this.#words.leave : this.#words.enter;
    if (isInside) this.#engine?.use(this);
  }

  // ---- Opening and ending ----

  /** Shows what `src` names. */
  async open() {
    const opening = ++this.#opening;
    this.#isTold = false;
    const isStale = () => opening !== this.#opening;
    try {
      const source = sourceOf(this.#host.getAttribute("src") ?? "");
      let base = document.baseURI;
      const reading = bindings();
      if (source.address !== undefined) {
        base = new URL(source.address, document.baseURI).href;
        await this.#consent(base);
        if (isStale()) return;
        source.text = await fetchText(base, source.address);
      }
      if (navigator.gpu) askEarly(partOf(source.text, base));
      const { outline_of: outlineOf } = await reading;
      const outline = JSON.parse(outlineOf(source.text, base));
      if (isStale()) return;
      this.#outline = outline;
      this.#heedLanguage();
      const engine = await theEngine(outline.part).catch((error) => {
        if (!isStale()) this.#showWords(outline);
        throw error;
      });
      try {
        if (!isStale()) this.#join(engine, source, base);
      } finally {
        engine.release();
      }
    } catch (error) {
      if (isStale()) return;
      this.#isTold = true;
      this.fail(error);
    }
  }

  /** Adds a picture of the document to the engine, in place of the one before. */
  #join(engine, source, base) {
    const outline = this.#outline;
    this.#build();
    const { stage, view, words } = this.#parts;
    view.classList.remove("words-only");
    words.hidden = true;
    stage.hidden = false;
    stage.tabIndex = 0;
    const wanted = [this.#wanted, source.step, outline.step].find((step) => Number.isFinite(step));
    this.#wanted = null;
    const step = Math.min(Math.max(Math.round(wanted), 0), outline.steps.length);
    this.#enter(engine, { text: source.text, base, address: source.address }, step);
    this.#files = [];
    this.#presentation?.leave?.();
    this.#state = { ...NOWHERE, step };
    this.#isWhole = false;
    this.#told = "";
    this.dress();
    this.#wake();
  }

  /** Adds a picture at a step to the engine. The one before stays until there is another. */
  #enter(engine, from, step) {
    const { canvas: old, stage } = this.#parts;
    const canvas = document.createElement("canvas");
    canvas.part = "picture";
    canvas.setAttribute("role", "img");
    if (old) canvas.setAttribute("aria-label", old.getAttribute("aria-label"));
    const before = this.id;
    for (const host of this.#allowed) engine.reader.allow_host(host);
    this.id = engine.add(this, canvas, { ...from, step });
    this.#engine = engine;
    this.#from = from;
    if (before) engine.drop(before);
    this.#parts.before?.remove();
    this.#parts.before = old;
    stage.prepend(canvas);
    this.#parts.canvas = canvas;
  }

  /** The program is begun anew after a fault of another picture: this one comes back to where its reader stood. */
  async revive() {
    const [opening, { step, stand }] = [this.#opening, this.#state];
    this.#leave();
    try {
      const engine = await theEngine();
      try {
        // Meanwhile it may have ended, or shows something else.
        if (opening !== this.#opening || this.#engine) return;
        this.#enter(engine, this.#from, step);
        if (stand) engine.reader.resume(this.id, JSON.stringify(stand));
        this.#isFileDue = this.#files.length > 0;
      } finally {
        engine.release();
      }
      if (this.#wanted !== null) this.go(this.#wanted);
      this.#wanted = null;
      this.#look();
      this.#wake();
    } catch (error) {
      if (opening === this.#opening && !this.#engine) this.fail(error);
    }
  }

  /** There is no engine any more that it has a picture of. */
  #leave() {
    this.#engine = null;
    this.id = 0;
    this.isDirty = false;
    clearTimeout(this.#timer);
  }

  /** Nothing is fetched from another host than the page's before the reader agrees. */
  async #consent(address) {
    const { origin, host } = new URL(address);
    // What has no origin (`data:`) comes from nowhere.
    if (["null", location.origin].includes(origin)) return;
    this.#build();
    this.#isTold = true;
    await new Promise((agree) => this.#ask(this.#words.host(host), this.#words.fetch, agree));
    this.#isTold = false;
    this.#allowed.add(host);
  }

  /** Gives back what only this embed has used. */
  end() {
    this.#opening += 1;
    clearTimeout(this.#timer);
    this.#presentation?.leave?.();
    if (this.#parts.view?.classList.contains("fills")) this.#shrink();
    for (const watch of this.#watches) watch();
    this.#watches = [];
    for (const image of this.#host.querySelectorAll(":scope > img[slot=poster]")) image.removeAttribute("slot");
    this.#engine?.remove(this);
    this.#engine = null;
    this.id = 0;
    this.#parts = {};
  }

  #build() {
    if (this.#parts.view) return;
    const make = (tag, part) => {
      const element = document.createElement(tag);
      element.className = part;
      element.part = part;
      return element;
    };
    this.#root.adoptedStyleSheets = [sheet];
    const [view, stage, layer, hint, words, controls, said] = [
      ["div", "frame"], ["div", "stage"], ["div", "layer"], ["p", "hint"], ["div", "words"], ["div", "controls"], ["p", "unseen"],
    ].map(([tag, part]) => make(tag, part));
    const legend = make("p", "legend");
    said.setAttribute("role", "status");
    words.setAttribute("role", "alert");
    stage.tabIndex = 0;
    stage.setAttribute("role", "group");
    words.hidden = true;
    layer.style.visibility = "hidden"; // Texts keep their sizes.
    // The poster lies over the picture until the first whole one is there.
    const poster = make("div", "poster");
    poster.append(...this.#root.childNodes);
    for (const image of this.#host.querySelectorAll(":scope > img")) image.slot = "poster";
    const slot = document.createElement("slot");
    slot.name = "poster";
    const image = poster.querySelector("img");
    stage.append(layer, hint);
    const cover = make("div", "cover");
    cover.append(...(image ? [image] : []), slot);
    stage.append(cover);
    view.append(stage, words, legend, controls, said);
    this.#root.replaceChildren(view, poster);
    this.#parts = { view, stage, layer, hint, words, controls, legend, said, poster, cover };
    this.heedPoster();
    this.#parts.captions = new Captions(layer);
    this.#parts.marks = new Marks(layer);
    this.#parts.bar = new Controls(controls, this);
    this.#parts.hands = new Hands(stage, this.#host, this);
    const sized = new ResizeObserver(() => {
      this.#parts.captions?.measure();
      this.#wake();
    });
    sized.observe(stage);
    const seen = new IntersectionObserver((entries) => {
      this.isSeen = entries.at(-1).isIntersecting;
      if (this.isSeen && this.isDirty) this.#wake();
    });
    seen.observe(this.#host);
    stage.addEventListener("pointerenter", () => this.#engine?.use(this), { passive: true });
    document.fonts?.ready.then(() => this.#parts.captions?.measure());
    this.#watches = [() => sized.disconnect(), () => seen.disconnect(), () => this.#parts.hands.end()];
  }

  /** Whether there is an image to cover the picture with until the picture is there. */
  heedPoster() {
    const { cover } = this.#parts;
    cover?.classList.toggle("is-poster", (cover.querySelector("img") ?? this.#host.querySelector(":scope > img")) !== null);
  }

  get #words() {
    return wordsOf(this.#lang);
  }

  /** The language of words and controls: the page's, else the document's, else the browser's. */
  #heedLanguage() {
    const own = this.#host.closest("[lang]")?.lang || document.documentElement.lang;
    this.#lang = nearest(own || this.#outline?.lang || navigator.language);
  }

  /** Brings words and controls in line with the attributes. */
  dress() {
    const { captions, bar, hint, controls, legend, stage } = this.#parts;
    if (!captions || !this.#outline) return;
    this.#heedLanguage();
    const { lang } = this.#outline;
    if (lang) this.#parts.layer.lang = legend.lang = lang;
    this.#texts = "";
    this.#heedTexts();
    bar.set(this.#outline, this.#words);
    controls.hidden = legend.hidden = !this.#host.hasAttribute("controls");
    this.#parts.view.lang = this.#lang;
    this.#parts.canvas.setAttribute("aria-label", this.#host.getAttribute("alt") ?? this.#words.illustration);
    this.#told = "";
    hint.textContent = this.#parts.hands.isInside ? this.#words.leave : this.#words.enter;
    stage.setAttribute("aria-label", this.#words.illustration);
    this.#wake();
    this.#show();
  }

  /** Title and caption of what is shown: at a step its own, else what a step has set. */
  get heading() {
    const own = this.#outline.steps[this.#state.step - 1];
    const of = (key) => {
      const [whole, shown] = [this.#outline[key], this.#shown[key] ?? this.#outline[key]];
      if (!own) return shown;
      return own[key] || (shown === whole ? "" : shown);
    };
    return { title: of("title"), legend: of("legend") };
  }

  /** Texts and background are those of what is shown. */
  #heedTexts() {
    const texts = this.#engine.reader.texts(this.id);
    if (texts === this.#texts) return;
    this.#texts = texts;
    this.#shown = JSON.parse(texts);
    const { captions, background } = this.#shown;
    const { stage } = this.#parts;
    this.#parts.captions.set(captions, this.#words);
    stage.style.background = background ?? "none";
    stage.classList.toggle("dark", isDark(background));
  }

  // ---- What the engine says ----

  /** Width and height of the picture, pixels. */
  size() {
    const { stage } = this.#parts;
    if (!stage?.isConnected) return [0, 0];
    const { width, height } = stage.getBoundingClientRect();
    const scale = Math.min(devicePixelRatio, Math.sqrt(MOST_PIXELS / Math.max(width * height, 1)));
    return [Math.round(width * scale), Math.round(height * scale)];
  }

  /** A frame was drawn. */
  drawn(hasPicture, isDone) {
    const { captions, layer, marks, stage, view } = this.#parts;
    if (hasPicture) {
      const { reader } = this.#engine;
      marks.show(reader.marks(this.id), this.#words);
      const room = [stage.clientWidth, stage.clientHeight, captions.gap, ...marks.room];
      captions.place(reader.captions(this.id, captions.sizes(), new Float32Array(room)), room[0]);
      layer.style.visibility = "";
      view.classList.remove("lost");
      this.#parts.before?.remove();
    }
    this.#look();
    if (isDone && !this.isReady) this.#reveal();
    if (isDone && hasPicture) {
      this.#describe();
      this.#copy();
    }
  }

  /**
   * For paper: browsers print nothing of what a graphics device has drawn, unless it is copied in the task that draws. The copy
   * also stands for the picture when the device is lost, and with it all that canvases show.
   */
  #copy() {
    const { canvas } = this.#parts;
    const paper = (this.#parts.paper ??= document.createElement("canvas"));
    paper.className = "paper";
    paper.ariaHidden = "true";
    [paper.width, paper.height] = [canvas.width, canvas.height];
    paper.getContext("2d").drawImage(canvas, 0, 0);
    canvas.after(paper);
  }

  /** The first whole picture takes the place of the poster, one frame after it is there. */
  #reveal() {
    if (this.#look().failed) return;
    this.#isWhole = true;
    requestAnimationFrame(() => {
      this.#parts.view?.classList.add("ready");
      this.#tell("ready", { step: this.step });
    });
  }

  /** Something has come of a load. */
  hear() {
    this.#look();
  }

  #look() {
    if (!this.#engine) return this.#state;
    const before = this.#state;
    this.#state = JSON.parse(this.#engine.reader.state(this.id, seconds()));
    const { step, troubles, wait } = this.#state;
    if (before.step !== step) {
      this.#heedTexts();
      this.#arrived(step);
    }
    for (const message of (troubles ?? []).slice(before.troubles?.length ?? 0)) this.#tell("error", { message });
    this.#show();
    if (!this.#isTold) this.#showLoad(before.failed);
    clearTimeout(this.#timer);
    // A lesson that plays by itself sleeps until the next step.
    if (wait !== null && wait !== undefined) this.#timer = setTimeout(() => this.#wake(), 1000 * Math.max(wait, 0) + 5);
    return this.#state;
  }

  /** Words about what is fetched for the picture, or was not to be had. */
  #showLoad(hadFailed) {
    const { host, file, failed, troubles, progress } = this.#state;
    const { words } = this.#parts;
    if (failed && !hadFailed && !file) words.textContent = `${this.#words.cannot} ${troubles.at(-1) ?? ""}`;
    else if (host) this.#askHost(host);
    else if (file) this.#askFile();
    else if (!this.isReady && progress !== null) this.#wait(progress);
    else if (!failed) words.hidden = true;
    if (failed) words.hidden = false;
  }

  #arrived(step) {
    this.#tell("stepchange", { step });
    const { title, legend } = this.heading;
    const where = step ? this.#words.step(step, this.#outline.steps.length) : this.#words.start;
    this.#say([where, title, legend].filter(Boolean).join(": "));
  }

  #show() {
    const { bar, legend } = this.#parts;
    if (!bar || !this.#outline) return;
    bar.show(this.#state, this.#outline.steps.length);
    const { title, legend: caption } = this.heading;
    const text = [title, caption].filter(Boolean).join(": ");
    if (legend.textContent !== text) legend.textContent = text;
  }

  /** The picture in words takes its place for who cannot see it. */
  async #describe() {
    const own = this.#host.getAttribute("alt");
    const key = `${this.#state.step} ${this.#engine.reader.view(this.id)} ${this.#lang} ${own}`;
    if (this.#told === key) return;
    this.#told = key;
    const { canvas } = this.#parts;
    const describing = own ?? this.#engine.reader.describe(this.id, this.#lang);
    const words = await Promise.resolve(describing).catch(() => null);
    if (this.#told !== key) return;
    if (words === null) this.#told = ""; // The program has stopped; another one is asked.
    else if (words) canvas.setAttribute("aria-label", words);
  }

  // ---- Words in place of the picture ----

  #say(text) {
    if (this.#parts.said) this.#parts.said.textContent = text;
  }

  #wait(progress) {
    const { words } = this.#parts;
    words.hidden = false;
    delete words.dataset.asks;
    words.textContent = `${this.#words.loading} … ${Math.round(100 * progress)} %`;
  }

  #ask(text, name, act) {
    const { words } = this.#parts;
    if (words.dataset.asks === text && !words.hidden) return;
    words.dataset.asks = text;
    const button = document.createElement("button");
    button.part = "button";
    button.textContent = name;
    button.onclick = () => {
      words.hidden = true;
      act();
      this.#wake();
    };
    words.replaceChildren(`${text} `, button);
    words.hidden = false;
  }

  #askHost(host) {
    this.#ask(this.#words.host(host), this.#words.fetch, () => {
      this.#allowed.add(host);
      this.#engine?.reader.allow(this.id);
    });
  }

  #askFile() {
    if (this.#isFileDue) return this.#giveFiles();
    this.#ask(this.#words.file, this.#words.choose, () => {
      const chooser = document.createElement("input");
      Object.assign(chooser, { type: "file", multiple: true });
      chooser.onchange = () => {
        this.#files = [...chooser.files];
        this.#giveFiles();
      };
      chooser.click();
    });
  }

  #giveFiles() {
    this.#isFileDue = false;
    this.#engine?.reader.give(this.id, this.#files);
    this.#wake();
  }

  /** Poster, title, caption and steps as text, where nothing can be drawn. */
  #showWords(outline) {
    this.#build();
    const { cover, stage, view, words } = this.#parts;
    stage.hidden = !cover.classList.contains("is-poster");
    stage.tabIndex = -1; // There is nothing to turn.
    const line = ({ title, legend }) => [title, legend].filter(Boolean).join(": ");
    const list = document.createElement("ol");
    list.append(...outline.steps.map((step) => Object.assign(document.createElement("li"), { textContent: line(step) })));
    const text = (content) => Object.assign(document.createElement("p"), { textContent: content });
    words.replaceChildren(text(line(outline)), list, text(this.#words.noGpu));
    words.hidden = false;
    view.classList.remove("ready");
    view.classList.add("words-only");
  }

  /** What went wrong is told in the embed and by `error`. */
  fail(error) {
    this.#heedLanguage();
    const hasStopped = isTrap(error);
    const message = hasStopped ? this.#words.stopped : String(error?.message ?? error);
    this.#build();
    const { words, view } = this.#parts;
    if (hasStopped && !words.hidden && words.textContent === message) return; // Told already.
    if (!view.classList.contains("words-only")) {
      delete words.dataset.asks;
      words.textContent = hasStopped ? message : `${this.#words.cannot} ${message}`;
      words.hidden = false;
    }
    this.#tell("error", { message });
  }

  /** The device is lost. Until there is a new picture the last whole one stands, without captions, which may be ahead of it. */
  falter() {
    const { layer, view } = this.#parts;
    view?.classList.add("lost");
    if (layer) layer.style.visibility = "hidden";
  }

  /** The device is gone for good, or the program has stopped at this picture; another `src` starts anew. */
  lose(error = new Error(this.#words.lost)) {
    this.#leave();
    this.fail(error);
  }

  #tell(name, detail) {
    this.#host.dispatchEvent(new CustomEvent(name, { bubbles: true, composed: true, detail }));
  }

  #changed() {
    if (!this.#engine) return;
    this.#engine.use(this);
    this.#look();
    this.#wake();
  }

  #wake() {
    if (this.#engine && this.id) this.#engine.wake(this);
  }
}

/** True if letters on a background have to be light. */
function isDark(background) {
  if (!background) return false;
  const [r, g, b] = [1, 3, 5].map((at) => parseInt(background.slice(at, at + 2), 16));
  return 0.3 * r + 0.59 * g + 0.11 * b < 0.45 * 255;
}

async function fetchText(address, name) {
  let response;
  try {
    response = await fetch(address, { credentials: "omit" });
  } catch {
    throw new Error(
      `${name} could not be fetched. If it lies on another host, that host has to allow it (Access-Control-Allow-Origin: *).`,
    );
  }
  if (!response.ok) throw new Error(`${name} could not be fetched (${response.status}).`);
  return response.text();
}
