// Captions: texts fastened to tissue, as real text over the picture, with lines to where their tissue is. All of them are one
// list in the document's order; those that the picture does not show stay in it for screen readers.

/** Space between texts and around them, CSS pixels. */
const GAP = 6;
const SVG = "http://www.w3.org/2000/svg";
/** States of a caption, as Reader.captions tells them. */
const [, HIDDEN, CUT_AWAY, OUT_OF_FRAME] = [0, 1, 2, 3];

export class Captions {
  #list;
  #lines;
  #items = [];
  #sizes = null;
  #words;

  constructor(layer) {
    this.#lines = document.createElementNS(SVG, "svg");
    this.#lines.setAttribute("aria-hidden", "true");
    this.#list = document.createElement("ol");
    this.#list.part = "captions";
    layer.append(this.#lines, this.#list);
  }

  /** Texts of the document's captions. */
  set(texts, words) {
    this.#words = words;
    this.#list.setAttribute("aria-label", words.captions);
    this.#list.hidden = texts.every((text) => text === "");
    this.#lines.replaceChildren();
    this.#items = texts.map((text) => {
      const item = document.createElement("li");
      item.part = "caption";
      const note = document.createElement("span");
      note.className = "unseen";
      item.append(text, note);
      const parts = ["path", "path", "circle"].map((name) => document.createElementNS(SVG, name));
      parts[0].setAttribute("class", "halo");
      parts[2].setAttribute("r", "2.6");
      this.#lines.append(...parts);
      return { item, note, parts };
    });
    this.#list.replaceChildren(...this.#items.map(({ item }) => item));
    this.measure();
  }

  /** The room or the letters have changed. */
  measure() {
    this.#sizes = null;
  }

  /** Width and height of every text, CSS pixels. */
  sizes() {
    this.#sizes ??= new Float32Array(this.#items.flatMap(({ item }) => [item.offsetWidth, item.offsetHeight]));
    return this.#sizes;
  }

  get gap() {
    return GAP;
  }

  /** Puts every caption where its tissue is: six numbers each (see Reader.captions), in a picture of this width, CSS pixels. */
  place(found, width) {
    const seen = new Map();
    for (let i = 0; i < found.length; i += 6) seen.set(found[i], found.subarray(i + 1, i + 6));
    this.#items.forEach(({ item, note, parts }, index) => {
      const [state, x, y, left, top] = seen.get(index) ?? [];
      const isPlaced = state < CUT_AWAY;
      item.classList.toggle("off", state === undefined); // Switched off at this step; it keeps its size.
      item.classList.toggle("absent", !isPlaced);
      item.classList.toggle("behind", state === HIDDEN);
      const why = { [HIDDEN]: this.#words.outOfSight, [CUT_AWAY]: this.#words.cutAway, [OUT_OF_FRAME]: this.#words.outOfFrame }[state];
      note.textContent = why ? ` (${why})` : "";
      for (const part of parts) part.style.display = isPlaced ? "" : "none";
      if (!isPlaced) return;
      item.style.transform = `translate(${left}px, ${top}px)`;
      const [wide, high] = this.#sizes.subarray(2 * index, 2 * index + 2);
      // The line begins at the inner side of its column.
      const from = x < 0.5 * width ? left + wide + 2 : left - 2;
      const path = `M${from} ${top + 0.5 * high}L${x} ${y}`;
      parts[0].setAttribute("d", path);
      parts[1].setAttribute("d", path);
      parts[2].setAttribute("cx", x);
      parts[2].setAttribute("cy", y);
      for (const part of parts) part.classList.toggle("behind", state === HIDDEN);
    });
  }
}
