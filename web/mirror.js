// The controls of the author's page as elements, for assistive technology: the page draws them on a canvas, which tells nothing.
// They lie unseen over what they stand for, take no pointer, and pass focus, presses and values on (src/shell/mirror.rs). Fetched and
// kept up only after somebody has asked for it.

/** Between two looks at whether something was drawn, milliseconds. */
const ROUND = 200;
/** A value that was just given is not written over by an older one for so long, milliseconds. */
const FRESH = 600;

const STYLE = `
  #mirror { position: fixed; inset: 0; overflow: hidden; pointer-events: none; opacity: 0; }
  #mirror > * { position: absolute; margin: 0; padding: 0; border: 0; overflow: hidden; white-space: nowrap; }
`;

/** Roles of what can be pressed, also while it is switched off. */
const PRESSED = ["Button", "ComboBox", "DisclosureTriangle", "Link", "MenuItem", "RadioButton", "Tab"];

/** The element for a role. */
function kindOf({ role, press, number, max }) {
  if (role === "Slider" && max !== null) return "range";
  if (role === "SpinButton" || (role === "Slider" && number !== null)) return "number";
  if (["TextInput", "SearchInput", "PasswordInput"].includes(role)) return "text";
  if (role === "MultilineTextInput") return "textarea";
  if (["CheckBox", "Switch"].includes(role)) return "checkbox";
  if (["Image", "Canvas"].includes(role)) return "image";
  if (role === "Label" || role === "Heading") return "p";
  return press || PRESSED.includes(role) ? "button" : "p";
}

function make(kind) {
  if (["range", "number", "text", "checkbox"].includes(kind)) {
    const input = document.createElement("input");
    input.type = kind;
    if (kind !== "text" && kind !== "checkbox") input.step = "any";
    return input;
  }
  const element = document.createElement(kind === "image" ? "div" : kind);
  if (kind === "image") element.setAttribute("role", "img");
  if (kind === "button") element.type = "button";
  return element;
}

class Mirror {
  #viewer;
  #room;
  #known = new Map();
  #frame = -1;

  constructor(viewer, room) {
    this.#viewer = viewer;
    this.#room = room;
  }

  /** Brings the elements in line with what was drawn last. */
  look() {
    const frame = this.#viewer.frame();
    if (frame === this.#frame) return;
    const text = this.#viewer.mirrored();
    if (text === "") return;
    this.#frame = frame;
    const before = this.#known;
    this.#known = new Map();
    let last = null;
    for (const told of JSON.parse(text)) {
      const kind = kindOf(told);
      let kept = before.get(told.id);
      if (kept?.kind !== kind) kept = this.#add(told.id, kind);
      else before.delete(told.id);
      this.#known.set(told.id, kept);
      this.#show(kept, told);
      // What has its place already is not moved: it would lose the focus.
      const next = last ? last.nextSibling : this.#room.firstChild;
      if (next !== kept.element) this.#room.insertBefore(kept.element, next);
      last = kept.element;
    }
    for (const { element } of before.values()) element.remove();
  }

  #add(id, kind) {
    const element = make(kind);
    const kept = { element, kind, given: 0 };
    const act = (action, value = "") => {
      kept.given = performance.now();
      this.#viewer.act(id, action, String(value));
    };
    if (kind === "p" || kind === "image") return kept;
    element.tabIndex = -1; // The keyboard walks the canvas.
    element.onfocus = () => act("focus");
    if (kind === "button" || kind === "checkbox") element.onclick = () => act("click");
    else if (kind === "range") element.oninput = () => act("number", element.value);
    else if (kind === "number") element.onchange = () => act("number", element.value);
    else element.onchange = () => act("text", element.value);
    return kept;
  }

  #show({ element, kind, given }, { role, name, value, number, min, max, on, off, at }) {
    const set = (key, to) => {
      if (to === null || to === undefined) element.removeAttribute(key);
      else if (element.getAttribute(key) !== String(to)) element.setAttribute(key, to);
    };
    const place = ["left", "top", "width", "height"].map((key, index) => `${key}: ${at[index]}px`).join("; ");
    if (element.dataset.at !== place) {
      element.dataset.at = place;
      ["left", "top", "width", "height"].forEach((key, index) => (element.style[key] = `${at[index]}px`));
    }
    if (kind === "p") {
      const text = [name, value].filter(Boolean).join(": ");
      if (element.textContent !== text) element.textContent = text;
      return;
    }
    if (kind === "image") return set("aria-label", [name, value].filter(Boolean).join(": "));
    set("aria-label", kind === "button" && value ? `${name ?? ""} ${value}`.trim() : name ?? value);
    set("aria-disabled", off ? "true" : null);
    if (kind === "button") {
      set("role", { RadioButton: "radio", Tab: null, Link: "link" }[role]);
      set(role === "RadioButton" ? "aria-checked" : "aria-pressed", on);
      if (role === "ComboBox") set("aria-haspopup", "listbox");
      return;
    }
    if (kind === "checkbox") {
      element.checked = on === true;
      return;
    }
    if (performance.now() - given < FRESH) return;
    if (kind === "range" || kind === "number") {
      set("min", min);
      set("max", max);
      if (kind === "range") set("aria-valuetext", value);
      element.value = number ?? value;
    } else if (element.value !== (value ?? "")) element.value = value ?? "";
  }
}

/** Shows the controls of a viewer as elements of the page, from now on. */
export function startMirror(viewer, name) {
  const sheet = new CSSStyleSheet();
  sheet.replaceSync(STYLE);
  document.adoptedStyleSheets = [...document.adoptedStyleSheets, sheet];
  const room = document.createElement("div");
  room.id = "mirror";
  room.tabIndex = -1;
  room.setAttribute("role", "region");
  room.setAttribute("aria-label", name);
  document.body.append(room);
  const mirror = new Mirror(viewer, room);
  const timer = setInterval(() => {
    if (viewer.has_panicked()) return clearInterval(timer);
    mirror.look();
  }, ROUND);
  mirror.look();
  room.focus();
}
