// A lesson before a room: the picture over the whole screen (or the whole frame), title and caption in large letters, and keys as
// of a slide program. Fetched when a presentation begins.

import { ICONS, icon } from "./controls.js";

/** How long the buttons stay after a pointer or a finger has moved, milliseconds. */
const CALM = 3000;
/** How far a pointer may move and still press, and how far a finger goes that swipes: CSS pixels. */
const TAP = 8;
const SWIPE = 40;
/** The left part of the picture where a press goes back. */
const BACK = 0.3;
/** Characters above which some phones do not read a code, and those that a code holds: src/link/qr.rs. */
const DENSE = 1200;
const MOST = 2900;

const KEYS = {
  ArrowRight: "next", ArrowDown: "next", PageDown: "next", " ": "next", Enter: "next",
  ArrowLeft: "previous", ArrowUp: "previous", PageUp: "previous", Backspace: "previous",
  Home: "first", End: "last", b: "blank", ".": "blank", l: "spot", r: "back", q: "code", Escape: "leave",
};
/** Buttons in the order that they stand in, with the key that does the same. */
const BUTTONS = [["previous", "←"], ["next", "→"], ["blank", "B"], ["spot", "L"], ["back", "R"], ["code", "Q"], ["leave", "Esc"]];

Object.assign(ICONS, {
  blank: "M2 3h12v10H2zM2 13 14 3",
  spot: "M8 5.5a2.5 2.5 0 1 0 0 5 2.5 2.5 0 0 0 0-5M8 1v2M8 13v2M1 8h2M13 8h2",
  code: "M2 2h4v4H2zM10 2h4v4h-4zM2 10h4v4H2zM10 10v1M13 10v4h-3v-1M13 13h1",
  leave: "M4 4l8 8M12 4l-8 8",
});

const STYLE = `
  .presents { height: 100%; overflow: hidden; background: #000; color: #fff; }
  .presents:not(.fills) { position: relative; }
  .presents > :is(.controls, .legend), .presents .hint { display: none !important; }
  .presents .stage::after { display: none; }
  .presents .stage { aspect-ratio: auto; flex: 1 1 0; min-height: 45%; cursor: default; touch-action: pinch-zoom !important;
    color: #000; --halo: #fff; }
  .presents .stage.dark { color: #fff; --halo: #000; }
  .presents .layer { font-size: clamp(16px, 2.6vmin, 40px); line-height: 1.25; font-weight: 600; }
  .presents .layer li { max-width: 27cqw; padding: 2px 8px; pointer-events: none; }
  .talk { flex: none; max-height: 50%; overflow: auto; padding: 0.5em 0.9em; font-size: clamp(18px, 3.6vmin, 54px); line-height: 1.3; display: flex; gap: 1em; }
  .talk p { flex: 1; margin: 0; }
  .talk strong::after { content: "\\A"; white-space: pre; }
  .talk .place { flex: none; font-variant-numeric: tabular-nums; }
  .spot, .blank, .code { position: absolute; inset: 0; }
  .spot { z-index: 3; pointer-events: none;
    background: radial-gradient(circle at var(--x, 50%) var(--y, 40%), transparent 17vmin, rgb(0 0 0 / 0.8) 19vmin); }
  .blank { z-index: 4; background: #000; forced-color-adjust: none; }
  .code { z-index: 4; display: flex; flex-direction: column; align-items: center; justify-content: center; gap: 2vmin; padding: 2vmin; box-sizing: border-box;
    background: #fff; color: #000; font-size: clamp(16px, 2.6vmin, 36px); text-align: center; forced-color-adjust: none; }
  .code svg { flex: 0 1 auto; min-height: 0; width: min(100%, 84vh); }
  .code p { margin: 0; max-width: 40em; }
  .bar { position: absolute; z-index: 5; top: 8px; right: 8px; display: flex; flex-wrap: wrap; justify-content: flex-end; gap: 4px; opacity: 0; }
  .bar button { min-width: 44px; min-height: 44px; display: grid; place-items: center; background: #000; color: #fff; border-color: #fff; }
  .bar button[aria-pressed="true"] { background: #fff; color: #000; border-color: #000; }
  .bar button:focus-visible { outline: 3px solid #fff; outline-offset: 2px; box-shadow: 0 0 0 7px #000; }
  .stirs .bar, .bar:focus-within, .bar:hover { opacity: 1; }
  @media (prefers-reduced-motion: no-preference) { .bar { transition: opacity 0.3s; } }
  @media (forced-colors: active) { .bar button, .talk { forced-color-adjust: none; } }
`;
const sheet = new CSSStyleSheet();
sheet.replaceSync(STYLE);

function make(tag, name, ...content) {
  const element = document.createElement(tag);
  element.className = element.part = name;
  element.append(...content);
  return element;
}

export class Presentation {
  #to;
  #parts = {};
  #buttons = {};
  #abort = new AbortController();
  #calm = 0;
  #down = null;

  /**
   * Begins. `to` has the embed with its `host`, `root`, `view` and `stage`, its `words`, the `outline` of its document, `measure()`
   * (letters have changed their sizes), `say(text)`, `link()` (a Promise of the address of the step shown), `code(text)` (a Promise of
   * the modules of its QR code) and `left()` (the presentation has ended).
   */
  constructor(to) {
    this.#to = to;
    const { host, root, view, stage, words } = to;
    const talk = make("div", "talk");
    const spot = make("div", "spot");
    const blank = make("div", "blank");
    const code = make("div", "code");
    const bar = make("div", "bar");
    bar.setAttribute("role", "toolbar");
    bar.setAttribute("aria-label", words.present);
    for (const [name, key] of BUTTONS) {
      const button = make("button", "button", icon(name));
      const says = name === "leave" ? words.leavePresenting : words[name];
      button.type = "button";
      button.title = `${says} (${key})`;
      button.setAttribute("aria-label", says);
      button.onclick = () => this.#do(name);
      bar.append(button);
      this.#buttons[name] = button;
    }
    this.#parts = { talk, spot, blank, code, bar };
    spot.hidden = blank.hidden = code.hidden = true;
    for (const name of ["spot", "blank", "code"]) this.#press(name, false);
    root.adoptedStyleSheets = [...root.adoptedStyleSheets, sheet];
    view.classList.add("presents");
    view.append(talk, spot, code, blank, bar);
    const signal = this.#abort.signal;
    const on = (target, name, act, capture = true) => target.addEventListener(name, act.bind(this), { signal, capture });
    on(window, "keydown", this.#key);
    on(view, "pointerdown", (event) => (this.#down = [event.clientX, event.clientY]));
    on(view, "pointermove", this.#move);
    on(view, "pointerup", this.#up);
    on(view, "click", this.#click);
    on(host, "stepchange", this.#show, false);
    on(document, "fullscreenchange", () => !host.matches(":fullscreen") && !view.classList.contains("fills") && this.leave());
    stage.focus({ preventScroll: true });
    to.measure();
    this.#show();
    this.#stir();
    to.say(words.presentKeys);
  }

  /** Ends; all is as it was. */
  leave() {
    if (this.#abort.signal.aborted) return;
    this.#abort.abort();
    clearTimeout(this.#calm);
    const { root, view, measure, left } = this.#to;
    view.classList.remove("presents", "stirs");
    for (const part of Object.values(this.#parts)) part.remove();
    root.adoptedStyleSheets = root.adoptedStyleSheets.filter((other) => other !== sheet);
    measure();
    left();
  }

  #do(name) {
    const { embed, outline } = this.#to;
    const { blank, code, spot } = this.#parts;
    if (name === "leave") return this.leave();
    // The first press shows the picture again; it does nothing else.
    if (!blank.hidden) return this.#toggle("blank");
    const walks = { next: embed.step + 1, previous: embed.step - 1, first: 0, last: outline.steps.length };
    if (name in walks) {
      if (!code.hidden) this.#toggle("code");
      const step = Math.min(Math.max(walks[name], 0), outline.steps.length);
      if (step !== embed.step) embed.go(step);
    } else if (name === "back") embed.reset();
    else if (name === "code" && code.hidden) this.#ask();
    else this.#toggle(name);
  }

  #press(name, is) {
    this.#buttons[name].setAttribute("aria-pressed", is);
  }

  #toggle(name) {
    const part = this.#parts[name];
    part.hidden = !part.hidden;
    this.#press(name, !part.hidden);
  }

  /** Shows the code of the step's link, or why there is none. */
  async #ask() {
    const { words, link, code } = this.#to;
    const box = this.#parts.code;
    const address = await link();
    const line = (text) => Object.assign(document.createElement("p"), { textContent: text });
    const lines = [line(words.letters(address.length))];
    if (address.length > DENSE) lines.push(line(address.length > MOST ? words.noCode(MOST) : words.dense));
    const modules = address.length > MOST ? null : await code(address);
    if (this.#abort.signal.aborted) return;
    box.replaceChildren(...(modules ? [drawing(modules, words.code)] : []), ...lines);
    if (box.hidden) this.#toggle("code");
  }

  /** Title and caption of the step. */
  #show() {
    const { embed, outline, words } = this.#to;
    const { title, legend } = embed.heading;
    const text = document.createElement("p");
    if (title) text.append(Object.assign(document.createElement("strong"), { textContent: title }));
    text.append(legend ?? "");
    const place = make("span", "place", `${embed.step} / ${outline.steps.length}`);
    place.setAttribute("aria-label", embed.step ? words.step(embed.step, outline.steps.length) : words.start);
    place.setAttribute("role", "img");
    this.#parts.talk.replaceChildren(...(title || legend ? [text] : []), ...(outline.steps.length ? [place] : []));
    if (outline.lang) this.#parts.talk.lang = outline.lang;
    this.#parts.talk.hidden = !this.#parts.talk.hasChildNodes();
  }

  /** The buttons are seen for a while. */
  #stir() {
    this.#to.view.classList.add("stirs");
    clearTimeout(this.#calm);
    this.#calm = setTimeout(() => this.#to.view.classList.remove("stirs"), CALM);
  }

  #key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    // The page under the presentation does not act on its keys.
    event.stopImmediatePropagation();
    const { root } = this.#to;
    const buttons = Object.values(this.#buttons);
    const at = buttons.indexOf(root.activeElement);
    if (event.key === "Tab") {
      event.preventDefault();
      const to = event.shiftKey ? (at < 0 ? -1 : at - 1) : at + 1;
      return buttons.at(to % buttons.length).focus();
    }
    if (at >= 0 && (event.key === "Enter" || event.key === " ")) return;
    const name = KEYS[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!name) return;
    event.preventDefault();
    // A key that is held walks one step.
    if (!event.repeat) this.#do(name);
  }

  #move(event) {
    this.#stir();
    const { spot } = this.#parts;
    const { left, top } = this.#to.view.getBoundingClientRect();
    spot.style.setProperty("--x", `${event.clientX - left}px`);
    spot.style.setProperty("--y", `${event.clientY - top}px`);
  }

  #up(event) {
    if (event.pointerType === "mouse" || !this.#down) return;
    const [x, y] = [event.clientX - this.#down[0], event.clientY - this.#down[1]];
    if (Math.abs(x) > SWIPE && Math.abs(x) > 1.5 * Math.abs(y)) this.#do(x < 0 ? "next" : "previous");
  }

  /** A press walks, too; one that has moved has turned the object or swiped. */
  #click(event) {
    if (event.target.closest(".bar, .talk")) return;
    event.stopPropagation();
    const [x, y] = this.#down ?? [event.clientX, event.clientY];
    if (Math.hypot(event.clientX - x, event.clientY - y) > TAP) return;
    if (event.pointerType !== "mouse") this.#stir();
    const { left, width } = this.#to.view.getBoundingClientRect();
    if (!this.#parts.code.hidden) this.#toggle("code");
    else this.#do(event.clientX - left < BACK * width ? "previous" : "next");
  }
}

/** A QR code, black on white: its modules row by row, 1 for a dark one, with the light ones around. */
function drawing(modules, name) {
  const SVG = "http://www.w3.org/2000/svg";
  const side = Math.sqrt(modules.length);
  const svg = document.createElementNS(SVG, "svg");
  const path = document.createElementNS(SVG, "path");
  svg.setAttribute("viewBox", `0 0 ${side} ${side}`);
  svg.setAttribute("shape-rendering", "crispEdges");
  svg.setAttribute("role", "img");
  svg.setAttribute("aria-label", name);
  const dark = [...modules.keys()].filter((at) => modules[at]);
  path.setAttribute("d", dark.map((at) => `M${at % side} ${Math.floor(at / side)}h1v1h-1z`).join(""));
  svg.append(path);
  return svg;
}
