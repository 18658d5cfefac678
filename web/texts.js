// Texts of the author's page that its canvas cannot have: captions over the picture, which are selected, translated and found as all
// text of a page, and letters of every script for saved pictures (src/shell/texts.rs).

/** Height of a row, of its letters', and what of it lies above the baseline. */
const ROW = 1.25;
const ABOVE = 0.95;
/** The first letter of a text is of a script that runs from the right. */
const FROM_RIGHT = /^\P{L}*[\u0590-\u08ff\ufb1d-\ufdff\ufe70-\ufefc]/u;

export class Texts {
  #canvas;
  #edit;
  #list = document.createElement("ol");
  #items = new Map();

  /** Texts over a canvas, as a list of this name; `edit` is called with the number of a caption that is clicked. */
  constructor(canvas, name, edit) {
    this.#canvas = canvas;
    this.#edit = edit;
    this.#list.id = "captions";
    this.#list.setAttribute("aria-label", name);
    this.#list.hidden = true;
    canvas.after(this.#list);
  }

  /** Shows these captions (JSON, see `shown` in src/shell/texts.rs), in this order. Returns width and height of each, CSS pixels. */
  show(json) {
    const texts = JSON.parse(json);
    const before = this.#items;
    this.#items = new Map(texts.map((text) => [text.caption, before.get(text.caption) ?? this.#make(text.caption)]));
    const items = [...this.#items.values()].map(({ item }) => item);
    // A text that is selected stays selected: nothing is moved that has its place already.
    if (items.length !== this.#list.children.length || items.some((item, index) => item !== this.#list.children[index])) {
      this.#list.replaceChildren(...items);
    }
    this.#list.hidden = items.length === 0;
    for (const { caption, text, at, widest, letters, light, faded } of texts) {
      const kept = this.#items.get(caption);
      const { item } = kept;
      // The browser may have translated it.
      if (kept.text !== text) item.textContent = kept.text = text;
      item.classList.toggle("absent", at === null);
      item.classList.toggle("light", light);
      item.classList.toggle("behind", faded);
      item.style.maxWidth = `${widest}px`;
      item.style.fontSize = `${letters}px`;
      if (at) item.style.transform = `translate(${at[0]}px, ${at[1]}px)`;
      const form = `${widest} ${letters} ${text}`;
      if (kept.form !== form) Object.assign(kept, { form, size: null });
    }
    // Measured only where that can have changed: it makes the browser lay the page out.
    return new Float32Array([...this.#items.values()].flatMap((kept) => (kept.size ??= [kept.item.offsetWidth, kept.item.offsetHeight])));
  }

  #make(caption) {
    const item = document.createElement("li");
    item.dir = "auto";
    // Whoever has selected a part of it does not want to change it.
    item.onclick = () => {
      if (!getSelection().isCollapsed) return;
      this.#canvas.focus();
      this.#edit(caption);
    };
    // The wheel belongs to the canvas, which asks what lies under the pointer.
    const pass = (event) => {
      event.preventDefault();
      item.style.pointerEvents = "none";
      for (const [Kind, name] of [[MouseEvent, "mousemove"], [WheelEvent, "wheel"]]) this.#canvas.dispatchEvent(new Kind(name, event));
      item.style.pointerEvents = "";
    };
    item.addEventListener("wheel", pass, { passive: false });
    return { item, text: "", form: "", size: null };
  }

  /** A text as letters of a height in pixels: width, height and how much of each pixel is covered, 0 to 255. */
  set(text, px, isStrong, widest, rows) {
    const font = `${isStrong ? 600 : 400} ${px}px system-ui, sans-serif`;
    const ruler = new OffscreenCanvas(1, 1).getContext("2d");
    ruler.font = font;
    const lines = rowsOf(text, widest, rows, (part) => ruler.measureText(part).width);
    const width = Math.ceil(Math.max(...lines.map((line) => ruler.measureText(line).width))) + 2;
    const height = Math.ceil(lines.length * ROW * px);
    const pen = new OffscreenCanvas(width, height).getContext("2d", { willReadFrequently: true });
    const isFromRight = FROM_RIGHT.test(text);
    Object.assign(pen, { font, direction: isFromRight ? "rtl" : "ltr", textAlign: "start" });
    lines.forEach((line, index) => pen.fillText(line, isFromRight ? width - 1 : 1, (index * ROW + ABOVE) * px));
    const { data } = pen.getImageData(0, 0, width, height);
    return { width, height, coverage: Uint8Array.from({ length: width * height }, (_, pixel) => data[4 * pixel + 3]) };
  }
}

/** A text in rows that are no wider than that, broken between words and where need be within them; what is too much is cut off. */
function rowsOf(text, widest, most, width) {
  const rows = [];
  const fits = (line) => width(line) <= widest;
  for (const paragraph of text.split("\n")) {
    let row = "";
    for (const word of paragraph.split(/\s+/)) {
      const longer = row ? `${row} ${word}` : word;
      if (fits(longer)) {
        row = longer;
        continue;
      }
      if (row) rows.push(row);
      row = "";
      for (const letter of word) {
        if (row && !fits(row + letter)) {
          rows.push(row);
          row = "";
        }
        row += letter;
      }
    }
    rows.push(row);
  }
  if (rows.length <= most) return rows;
  const last = [...rows[most - 1]];
  while (last.length > 0 && !fits(`${last.join("")}…`)) last.pop();
  return [...rows.slice(0, most - 1), `${last.join("")}…`];
}
