// Controls of a lesson: steps, passages, playing, the document's values, turning without a mouse.

const SVG = "http://www.w3.org/2000/svg";
/** Radians and factor of one press. */
const TURN = Math.PI / 8;
const ZOOM = 1.25;
/** Drawings of 16 by 16, as letters of arrows look different everywhere. */
export const ICONS = {
  previous: "M10 3 5 8l5 5",
  next: "M6 3l5 5-5 5",
  play: "M5 3v10l8-5z",
  pause: "M5 3v10M11 3v10",
  left: "M13 11a5 5 0 1 0-9-3M1 6l3 3 3-3",
  right: "M3 11a5 5 0 1 1 9-3M15 6l-3 3-3-3",
  up: "M8 13V3M4 7l4-4 4 4",
  down: "M8 3v10M4 9l4 4 4-4",
  closer: "M8 3v10M3 8h10",
  farther: "M3 8h10",
  back: "M3 3v4h4M3.5 7A5 5 0 1 1 4 11",
  full: "M3 6V3h3M10 3h3v3M13 10v3h-3M6 13H3v-3",
  present: "M2 3h12v8H2zM8 11v3M5 14h6",
};

function make(tag, part, ...content) {
  const element = document.createElement(tag);
  if (part) element.part = part;
  element.append(...content);
  return element;
}

/** The drawing of a name in [`ICONS`]. */
export function icon(name) {
  const svg = document.createElementNS(SVG, "svg");
  const path = document.createElementNS(SVG, "path");
  svg.setAttribute("viewBox", "0 0 16 16");
  svg.setAttribute("aria-hidden", "true");
  path.setAttribute("d", ICONS[name]);
  svg.append(path);
  return svg;
}

export class Controls {
  #embed;
  #words;
  #parts = {};
  #values = [];
  #isScrubbing = false;

  /** `embed` hears go, play, scrub, setParam, turn, zoom, reset, full and present. */
  constructor(room, embed) {
    this.room = room;
    this.#embed = embed;
  }

  /** Builds the controls of a document. */
  set(outline, words) {
    this.#words = words;
    const button = (name, act) => {
      const made = make("button", `button ${name}`, icon(name));
      made.type = "button";
      made.title = words[name];
      made.setAttribute("aria-label", words[name]);
      made.onclick = act;
      return made;
    };
    const embed = this.#embed;
    const count = outline.steps.length;
    const steps = make("div", "steps");
    steps.setAttribute("role", "group");
    steps.setAttribute("aria-label", words.steps);
    this.#parts = {
      previous: button("previous", () => embed.go(Math.max(Math.ceil(embed.position) - 1, 0))),
      play: button("play", () => embed.play(!embed.isPlaying)),
      next: button("next", () => embed.go(Math.floor(embed.position) + 1)),
      scrub: this.#slider("scrub", words.place, [0, count, 0.01], (value) => embed.scrub(value)),
      list: this.#list(outline.steps),
    };
    const { previous, play, next, scrub, list } = this.#parts;
    const scrubs = (does) => {
      this.#isScrubbing = does;
      embed.moving(does);
    };
    scrub.addEventListener("pointerdown", () => scrubs(true));
    for (const name of ["pointerup", "pointercancel", "blur"]) scrub.addEventListener(name, () => scrubs(false));
    scrub.addEventListener("change", () => {
      embed.scrub(Math.round(Number(scrub.value)));
    });
    // With the keyboard one press is one step.
    scrub.addEventListener("keydown", (event) => {
      const way = { ArrowRight: 1, ArrowUp: 1, PageUp: 1, ArrowLeft: -1, ArrowDown: -1, PageDown: -1 }[event.key];
      if (!way) return;
      event.preventDefault();
      embed.go(Math.min(Math.max(Math.round(embed.position) + way, 0), count));
    });
    steps.append(previous, play, next, scrub, list);
    const view = make("div", "view");
    view.setAttribute("role", "group");
    view.setAttribute("aria-label", words.view);
    this.#parts.back = button("back", () => embed.reset());
    view.append(
      button("left", () => embed.turn(-TURN, 0)),
      button("right", () => embed.turn(TURN, 0)),
      button("up", () => embed.turn(0, -TURN)),
      button("down", () => embed.turn(0, TURN)),
      button("closer", () => embed.zoom(ZOOM)),
      button("farther", () => embed.zoom(1 / ZOOM)),
      this.#parts.back,
      button("full", () => embed.full()),
      button("present", () => embed.present()),
    );
    this.room.replaceChildren(...(count > 0 ? [steps] : []), view, ...this.#makeValues(outline.controls));
  }

  #slider(part, name, [min, max, step], hear) {
    const slider = make("input", part);
    Object.assign(slider, { type: "range", min, max, step, value: min });
    slider.setAttribute("aria-label", name);
    slider.oninput = () => hear(Number(slider.value));
    return slider;
  }

  #list(steps) {
    const list = make("select", "list");
    list.setAttribute("aria-label", this.#words.steps);
    const titles = [this.#words.start, ...steps.map((step, index) => step.title || this.#words.step(index + 1, steps.length))];
    list.append(...titles.map((title, index) => new Option(index ? `${index}. ${title}` : title, index)));
    list.onchange = () => this.#embed.go(Number(list.value));
    return list;
  }

  /** A slider or a switch for each value that readers may move. */
  #makeValues(controls) {
    this.#values = controls.map(({ pointer, name, min, max, whole }) => {
      const label = make("label", "value", make("span", "name", name));
      if (min === undefined) {
        const flag = make("input", "switch");
        flag.type = "checkbox";
        flag.onchange = () => this.#embed.setParam(pointer, flag.checked);
        label.prepend(flag);
        return { label, show: (value) => (flag.checked = value === true) };
      }
      const slider = this.#slider("slider", name, [min, max, whole ? 1 : (max - min) / 200], (value) => {
        this.#embed.moving(true);
        this.#embed.setParam(pointer, value);
      });
      slider.onchange = () => this.#embed.moving(false);
      label.append(slider);
      return { label, show: (value) => this.room.getRootNode().activeElement !== slider && (slider.value = value) };
    });
    if (this.#values.length === 0) return [];
    const group = make("fieldset", "values", make("legend", "values-name", this.#words.values));
    group.append(...this.#values.map(({ label }) => label));
    return [group];
  }

  /** Brings the controls in line with where the embed stands. */
  show({ position, step, playing, strayed, values }, count) {
    const { previous, next, play, scrub, list, back } = this.#parts;
    if (!previous) return;
    // A button that is switched off would lose the keyboard's focus.
    previous.setAttribute("aria-disabled", position <= 0);
    next.setAttribute("aria-disabled", position >= count);
    const name = playing ? "pause" : "play";
    if (play.dataset.shows !== name) {
      play.dataset.shows = name;
      play.replaceChildren(icon(name));
      play.title = this.#words[name];
      play.setAttribute("aria-label", this.#words[name]);
    }
    if (!this.#isScrubbing) scrub.value = position;
    scrub.setAttribute("aria-valuetext", step === 0 ? this.#words.start : this.#words.step(step, count));
    list.value = step;
    back.setAttribute("aria-disabled", !strayed);
    values.forEach((value, index) => this.#values[index]?.show(value));
  }
}
