// The reader's hands on a picture in somebody else's page. Until the reader enters the picture, wheel, finger and pinch belong
// to the page; only a mouse that drags turns the object. Inside, they turn and zoom; Escape, Tab past the end and a tap
// elsewhere leave it.

/** How far a pointer may move and still tap, CSS pixels. */
const TAP = 6;
/** Radians that one press of an arrow turns. */
const STEP = Math.PI / 12;
/** A movement by keys or wheel is over after this long, milliseconds. */
const CALM = 180;

export class Hands {
  #stage;
  #embed;
  #pointers = new Map();
  #moved = 0;
  #calm = 0;
  #isInside = false;
  #abort = new AbortController();

  /** `embed` hears turn, zoom, shift, roll, go, reset, entered, escape and moving. */
  constructor(stage, host, embed) {
    this.#stage = stage;
    this.#embed = embed;
    const signal = this.#abort.signal;
    const on = (target, name, act, options = {}) =>
      target.addEventListener(name, act.bind(this), { signal, ...options });
    on(stage, "pointerdown", this.#down);
    on(stage, "pointermove", this.#move);
    on(stage, "pointerup", this.#up);
    on(stage, "pointercancel", this.#up);
    on(stage, "lostpointercapture", this.#up);
    on(stage, "click", this.#click);
    on(stage, "keydown", this.#key);
    on(host, "keydown", (event) => {
      if (event.key !== "Escape") return;
      this.leave();
      this.#embed.escape();
    });
    on(stage, "wheel", this.#wheel, { passive: false });
    on(host, "focusout", (event) => {
      if (!host.contains(event.relatedTarget) && event.relatedTarget !== host) this.leave();
    });
    on(document, "pointerdown", (event) => {
      if (!event.composedPath().includes(host)) this.leave();
    });
  }

  end() {
    clearTimeout(this.#calm);
    this.#abort.abort();
  }

  get isInside() {
    return this.#isInside;
  }

  enter() {
    if (this.#isInside) return;
    this.#isInside = true;
    this.#stage.classList.add("inside");
    this.#embed.entered(true);
  }

  leave() {
    if (!this.#isInside) return;
    this.#isInside = false;
    this.#stage.classList.remove("inside");
    this.#embed.entered(false);
  }

  /** A movement that has no end of its own. */
  #jog() {
    this.#embed.moving(true);
    clearTimeout(this.#calm);
    this.#calm = setTimeout(() => this.#embed.moving(false), CALM);
  }

  #down(event) {
    const isMouse = event.pointerType === "mouse";
    if (this.#pointers.size === 0) this.#moved = 0;
    if (event.target.closest("li") || event.ctrlKey) return; // A caption's text can be selected; with Ctrl a menu opens.
    if (isMouse ? event.button !== 0 : !this.#isInside) return;
    this.#pointers.set(event.pointerId, [event.clientX, event.clientY]);
    if (!isMouse) this.#stage.setPointerCapture(event.pointerId);
  }

  #move(event) {
    const before = this.#pointers.get(event.pointerId);
    if (!before) return;
    // The button may have been let go elsewhere.
    if (event.pointerType === "mouse" && !(event.buttons & 1)) return this.#up(event);
    const now = [event.clientX, event.clientY];
    const [dx, dy] = [now[0] - before[0], now[1] - before[1]];
    this.#moved += Math.hypot(dx, dy);
    // A press that becomes a drag has the pointer to itself from then on; a click goes where it would have gone.
    if (this.#moved > TAP) this.#stage.setPointerCapture(event.pointerId);
    const { width, height } = this.#stage.getBoundingClientRect();
    const side = Math.max(Math.min(width, height), 1);
    const others = [...this.#pointers.entries()].filter(([id]) => id !== event.pointerId);
    this.#embed.moving(true);
    if (others.length > 0) {
      const [, other] = others[0];
      const spread = (at) => Math.max(Math.hypot(at[0] - other[0], at[1] - other[1]), 1);
      this.#embed.zoom(spread(now) / spread(before));
      this.#embed.shift((0.5 * dx) / side, (0.5 * dy) / side);
      const way = (at) => Math.atan2(at[1] - other[1], at[0] - other[0]);
      // The shorter way round.
      const by = way(now) - way(before);
      this.#embed.roll(Math.atan2(Math.sin(by), Math.cos(by)));
    } else if (event.shiftKey) {
      this.#embed.shift(dx / side, dy / side);
    } else {
      this.#embed.turn((Math.PI * dx) / side, (Math.PI * dy) / side);
    }
    this.#pointers.set(event.pointerId, now);
  }

  #up(event) {
    if (!this.#pointers.delete(event.pointerId)) return;
    if (this.#pointers.size === 0) this.#embed.moving(false);
  }

  #click(event) {
    if (event.target.closest("li")) return;
    if (this.#moved > TAP) {
      this.#moved = 0;
      return;
    }
    this.#stage.focus({ preventScroll: true });
    this.enter();
  }

  #wheel(event) {
    if (!this.#isInside || event.ctrlKey) return;
    event.preventDefault();
    const lines = event.deltaMode === 1 ? 16 : 1;
    this.#jog();
    this.#embed.zoom(Math.exp(-0.0015 * lines * event.deltaY));
  }

  #key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.key === "Enter" && !this.#isInside) {
      event.preventDefault();
      return this.enter();
    }
    if (!this.#isInside) return;
    const act = {
      ArrowLeft: () => this.#embed.turn(-STEP, 0),
      ArrowRight: () => this.#embed.turn(STEP, 0),
      ArrowUp: () => this.#embed.turn(0, -STEP),
      ArrowDown: () => this.#embed.turn(0, STEP),
      "+": () => this.#embed.zoom(1.2),
      "=": () => this.#embed.zoom(1.2),
      "-": () => this.#embed.zoom(1 / 1.2),
      PageDown: () => this.#embed.go(this.#embed.step + 1),
      PageUp: () => this.#embed.go(Math.max(this.#embed.step - 1, 0)),
      Home: () => this.#embed.reset(),
    }[event.key];
    if (!act) return;
    event.preventDefault();
    if (!["Home", "PageUp", "PageDown"].includes(event.key)) this.#jog();
    act();
  }
}
