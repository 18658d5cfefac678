// What stands at the picture's edges where its author wishes it: a scale bar, and letters of the patient's sides.

const EDGES = ["left", "right", "top", "bottom"];

export class Marks {
  #letters;
  #bar;
  #shown = "";

  constructor(layer) {
    const make = (className, part) => {
      const mark = document.createElement("span");
      mark.className = `mark ${className}`;
      mark.part = part;
      mark.hidden = true;
      return mark;
    };
    // The view is told in words to who cannot see it, so single letters are not.
    this.#letters = EDGES.map((edge) => Object.assign(make(edge, "side"), { ariaHidden: "true" }));
    this.#bar = make("ruler", "scale");
    this.#bar.setAttribute("role", "img");
    layer.prepend(...this.#letters, this.#bar);
  }

  /** Shows what Reader.marks tells. */
  show(told, words) {
    if (told === this.#shown) return;
    this.#shown = told;
    const { bar, sides } = JSON.parse(told) ?? {};
    this.#letters.forEach((letter, index) => {
      letter.hidden = !sides;
      letter.textContent = sides?.[index] ?? "";
    });
    this.#bar.hidden = !bar;
    if (!bar) return;
    const [share, text] = bar;
    this.#bar.style.width = `${100 * share}%`;
    this.#bar.textContent = text;
    this.#bar.ariaLabel = `${words.scale}: ${text}`;
  }

  /** What captions leave free at the edges and at the foot, CSS pixels. */
  get room() {
    return [this.#letters[0].offsetHeight, this.#bar.offsetHeight];
  }
}
