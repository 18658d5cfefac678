// <fabrica-viewer>: an illustration in somebody else's page.
//
//   <script type="module" src="fabrica-viewer.js"></script>
//   <fabrica-viewer src="#PAYLOAD" controls>
//     <img src="poster.png" alt="…"><p>What is to be seen, in words.</p>
//   </fabrica-viewer>
//
// Attributes: src (a link, a payload, ?doc=ADDRESS, or the address of a document), step, controls, alt, lang, poster (or an
// image in the element), loading="lazy" or "tap".
// Properties and methods: steps, step, next(), previous(), play(), pause(), setParam(pointer, value), reset(),
// present(), toDataURL() (a Promise). Events, which bubble: ready, stepchange, paramchange, viewchange, error.
// The content of the element is its poster: it stays until the first whole picture is there, and for ever where there is no
// WebGPU, with title, caption and steps as text under it. No inline script, no cookie, no request to a third party; everything
// is taken from beside this file.

/** Removal counts after this long, milliseconds: an element that is moved in its document is removed and put in again. */
const GONE = 1000;
const SHOW = { en: "Show the illustration", de: "Abbildung zeigen", es: "Mostrar la ilustración", zh: "显示插图" };
/** Until there is a picture the content stands in place of it. */
const STYLE = `
  :host { display: block; position: relative; }
  :host([hidden]), [hidden] { display: none !important; }
  .poster, ::slotted(img) { display: block; width: 100%; height: auto; }
  .tap { position: absolute; inset: 0 0 auto; margin: 8px auto; min-width: 44px; min-height: 44px; padding: 0 16px; font: inherit; }
`;

class FabricaViewer extends HTMLElement {
  static observedAttributes = ["src", "step", "controls", "alt", "lang", "poster"];

  #root = this.attachShadow({ mode: "open" });
  #embed = null;
  #start = 0; // A start that was overtaken by another finds that its number is old.
  #wanted = null; // A step that was asked for before there was anything to show.
  #watch = null;
  #leaving = 0;
  #isConnected = false;
  #isStarted = false;

  connectedCallback() {
    clearTimeout(this.#leaving);
    if (this.#isConnected) return this.#embed?.dress();
    this.#isConnected = true;
    if (this.#wanted === null && this.hasAttribute("step")) this.step = this.getAttribute("step");
    this.#build();
    const loading = this.getAttribute("loading");
    if (loading === "tap") this.#offer();
    else if (loading === "lazy" && "IntersectionObserver" in window) this.#await();
    else this.#open();
  }

  disconnectedCallback() {
    this.#leaving = setTimeout(() => {
      if (this.isConnected) return;
      this.#isConnected = this.#isStarted = false;
      this.#start += 1;
      this.#watch?.disconnect();
      this.#embed?.end();
      this.#embed = null;
    }, GONE);
  }

  attributeChangedCallback(name, before, after) {
    if (before === after || !this.#isConnected) return;
    if (name === "src") {
      if (this.#embed) this.#embed.open();
      else if (this.#isStarted) this.#open();
    } else if (name === "step") {
      // Without the attribute it stays where it is.
      if (after !== null) this.step = after;
    } else {
      if (name === "poster" || name === "alt") this.#heedPoster();
      this.#embed?.dress();
    }
  }

  /** Titles and captions of the steps; step N of the document is entry N − 1. */
  get steps() {
    return this.#embed?.steps ?? [];
  }
  /** The step shown, 0 for the document as it stands. */
  get step() {
    return this.#embed?.step ?? this.#wanted ?? 0;
  }
  set step(value) {
    const step = Math.min(Math.round(parseFloat(value)), 1000);
    if (!(step >= 0)) return this.#fail(`${value} is not the number of a step`);
    this.#wanted = step;
    this.#embed?.go(step);
  }
  next() {
    this.step = this.step + 1;
  }
  previous() {
    this.step = Math.max(this.step - 1, 0);
  }
  /** Plays the lesson from what is shown, and stands still. */
  play() {
    this.#embed?.play(true);
  }
  pause() {
    this.#embed?.play(false);
  }
  /** Sets one value of the document by its JSON pointer: setParam("/templates/0/params/progress", 0.8). */
  setParam(pointer, value) {
    this.#ready().setParam(pointer, value);
  }
  /** Back to what the author shows at this step: view and values. */
  reset() {
    this.#embed?.reset();
  }
  /** Shows the lesson to a room, in full screen if a press of the reader asks for it, else over the whole frame. */
  present() {
    return this.#ready().present();
  }
  /** The picture as a data: address of a PNG. */
  async toDataURL() {
    return this.#ready().toDataURL();
  }

  #ready() {
    if (!this.#embed?.isReady) throw new Error("fabrica-viewer: not ready yet");
    return this.#embed;
  }

  #build() {
    const sheet = new CSSStyleSheet();
    sheet.replaceSync(STYLE);
    this.#root.adoptedStyleSheets = [sheet];
    this.#root.replaceChildren(document.createElement("slot"));
    this.#heedPoster();
  }

  /** The image of `poster` stands before the content, and later in what covers the picture. */
  #heedPoster() {
    const address = this.getAttribute("poster");
    let image = this.#root.querySelector("img.poster");
    if (address === null) image?.remove();
    else {
      if (!image) {
        image = new Image();
        image.className = "poster";
        (this.#root.querySelector(".cover") ?? this.#root).prepend(image);
      }
      if (image.getAttribute("src") !== address) image.src = address;
      image.alt = this.getAttribute("alt") ?? "";
    }
    this.#embed?.heedPoster();
  }

  /** Starts when the element is about to be seen. */
  #await() {
    this.#watch = new IntersectionObserver(
      (entries) => {
        if (!entries.some((entry) => entry.isIntersecting)) return;
        this.#open();
      },
      { rootMargin: "200px" },
    );
    this.#watch.observe(this);
  }

  /** Starts when the reader asks for it. */
  #offer() {
    const button = document.createElement("button");
    const lang = (this.closest("[lang]")?.lang ?? "en").slice(0, 2);
    button.className = "tap";
    button.part = "button start";
    button.textContent = `▶ ${SHOW[lang] ?? SHOW.en}`;
    button.onclick = () => this.#open();
    this.#root.append(button);
  }

  async #open() {
    const start = ++this.#start;
    this.#isStarted = true;
    this.#watch?.disconnect();
    this.#root.querySelector(".tap")?.remove();
    try {
      const { Embed } = await import("./reader/embed.js");
      if (start !== this.#start) return;
      this.#embed = new Embed(this, this.#root, this.#wanted);
      await this.#embed.open();
    } catch (error) {
      if (start === this.#start) this.#fail(error.message ?? error);
    }
  }

  #fail(message) {
    this.dispatchEvent(new CustomEvent("error", { bubbles: true, composed: true, detail: { message: String(message) } }));
  }
}

if (!customElements.get("fabrica-viewer")) customElements.define("fabrica-viewer", FabricaViewer);
