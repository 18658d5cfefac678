// One device, one set of data and one frame loop for all pictures of a page (src/shell/reader.rs). At rest there is no frame
// and no timer.

import { startPart } from "../parts.js";
import { Background } from "./background.js";

/** What the GPU may spend on a frame while something moves, and at rest: seconds. */
const MOVING = 0.03;
const REST = 0.05;
// What Reader.draw returns.
const HAS_PICTURE = 1;
const IS_DONE = 2;
const IS_MOVING = 4;
const WAITS = 8;
/** Before each try to open a lost device again: seconds. A browser may need some to start its own process for graphics anew. */
const TRIES = [0, 1, 4];
/** How often a device may be lost in a row before a picture is whole: what is too much for it will be too much again. */
const MOST_LOSSES = 3;
/** How often the program is begun anew within so many seconds after a fault: a third one is no fault of one picture alone. */
const MOST_FAULTS = 2;
const MINUTE = 60;

const beside = (name) => new URL(`../${name}`, import.meta.url).href;

/** Whether an error is a fault of the program that has ended it: nothing of it can be called any more. */
export const isTrap = (error) =>
  error instanceof WebAssembly.RuntimeError || /call stack|too much recursion/i.test(error?.message ?? "");

let program;
/** Programs given up after a fault. The same address would be the same program to the browser. */
let givenUp = 0;
/** Ends the wait for an engine whose program has stopped. */
let halt = () => {};

/** The reader's program, fetched once; a failed fetch is tried again the next time. */
export function bindings() {
  const number = givenUp;
  program ??= import(`../fabrica_reader.js${number ? `?${number}` : ""}`)
    .then(async (found) => {
      await found.default({ module_or_path: beside("fabrica_reader_bg.wasm") });
      found.on_panic((text) => {
        console.error(`Fabrica: ${text}`);
        // Whoever has called the program hears of the trap first, and knows what it was at.
        queueMicrotask(() => number === givenUp && stopped(new WebAssembly.RuntimeError(text)));
      });
      return found;
    })
    .catch((error) => {
      program = undefined;
      throw new Error(`The viewer could not be fetched (${error.message ?? error}).`);
    });
  return program;
}

/** The program has stopped, and nobody knows at what. */
function stopped(error) {
  if (running) return running.stop(error);
  giveUp();
  halt(error);
}

function giveUp() {
  program = undefined;
  givenUp += 1;
}

/** What is still to be had of a program that has stopped. */
function attempt(act) {
  try {
    return act();
  } catch {
    return undefined;
  }
}

/**
 * The reader, whose faults are told, with the first argument of the call: mostly a picture. What it promises is refused when it
 * stops: a program that has stopped keeps no promise. `waiting` holds who is refused then.
 */
function guarded(reader, waiting, tell) {
  const promised = (answer) =>
    new Promise((keep, refuse) => {
      waiting.add(refuse);
      answer.then(keep, refuse).finally(() => waiting.delete(refuse));
    });
  return new Proxy(reader, {
    get(target, name) {
      const found = target[name];
      if (typeof found !== "function") return found;
      return (...args) => {
        try {
          const answer = found.apply(target, args);
          return answer instanceof Promise ? promised(answer) : answer;
        } catch (error) {
          if (isTrap(error)) tell(error, args[0]);
          throw error;
        }
      };
    },
  });
}

/** A part that was asked for before there is an engine. */
let asked = null;

/** Asks for a part while the reader's program is still on its way. Parts of an engine that runs are asked for by itself. */
export function askEarly(part) {
  if (part && !engine) asked ??= startPart(part, () => new Background());
}

/** Takes the part that was asked for, or asks for it now. */
function takeEarly(part) {
  const early = asked;
  asked = null;
  if (early?.part === part) return early;
  early?.worker.terminate();
  return part ? startPart(part, () => new Background()) : null;
}

let engine;
/** The engine itself while it runs. */
let running = null;
/** When programs have stopped because of a fault, seconds. */
let faults = [];
/**
 * The page's engine: started by the first picture, ended with the last. `part` is the part of the program that the first one's
 * subject needs, if that is known: it is on its way while the device is opened.
 */
export async function theEngine(part) {
  for (;;) {
    engine ??= start(part).catch((error) => {
      engine = undefined;
      throw error;
    });
    const found = await engine;
    if (!found.reader) continue; // It ended meanwhile.
    found.claims += 1;
    return found;
  }
}

async function start(part) {
  const { Reader } = await bindings();
  const early = takeEarly(part);
  const made = new Engine();
  try {
    const halted = new Promise((_, fail) => (halt = fail));
    const started = Reader.start(() => new Background(), () => made.hear());
    const reader = await Promise.race([started, halted]);
    made.reader = guarded(reader, made.waiting, (error, id) => made.stop(error, id));
  } catch (error) {
    early?.worker.terminate();
    throw error;
  }
  running = made;
  if (early) made.reader.lend(early.part, early.worker);
  made.watch();
  const query = matchMedia("(prefers-reduced-motion: reduce)");
  const heed = () => made.reader?.set_less_motion(query.matches);
  heed();
  query.addEventListener("change", heed);
  // A trap in an answer of the browser, that is no panic.
  const hear = ({ error }) => isTrap(error) && error.stack?.includes("fabrica_reader") && made.stop(error);
  addEventListener("error", hear);
  made.forget = () => {
    query.removeEventListener("change", heed);
    removeEventListener("error", hear);
  };
  return made;
}

export const seconds = () => performance.now() * 1e-3;

class Engine {
  reader = null;
  /** Ends what it hears of the page. */
  forget = () => {};
  /** Who waits for what the program has promised: each is called with an error if it stops. */
  waiting = new Set();
  /** Embeds that have asked for the engine and have not added their picture yet. */
  claims = 0;
  #restarting = Promise.resolve();
  /** Devices lost at work since a picture was whole. */
  #losses = 0;
  #hasDrawn = false;
  #embeds = new Set();
  #frame = 0;
  /** The picture that was used last keeps its memory on the device; the others give it back when they are complete. */
  #used = null;
  #last = null;
  /** Data came to the device in the frame before. */
  #wasBusy = false;

  /** Adds the picture of an embed. */
  add(embed, canvas, { text, base, step }) {
    const id = this.reader.add(canvas, text, base, step);
    this.#embeds.add(embed);
    this.#used ??= embed;
    return id;
  }

  /** Takes away a picture that another one of its embed has replaced. */
  drop(id) {
    this.reader.remove(id);
  }

  /** Takes the picture of an embed away; with the last one goes the device. */
  remove(embed) {
    if (!this.#embeds.delete(embed)) return;
    if (this.#used === embed) this.#used = null;
    this.reader.remove(embed.id);
    this.#endUnused();
  }

  /** An embed has added its picture, or does not want to any more. */
  release() {
    this.claims -= 1;
    this.#endUnused();
  }

  #endUnused() {
    if (this.#embeds.size > 0 || this.claims > 0 || !this.reader) return;
    const reader = this.#end();
    reader.destroy();
    // A device that is being opened again is given back first.
    this.#restarting.finally(() => reader.free());
  }

  #end() {
    cancelAnimationFrame(this.#frame);
    engine = undefined;
    running = null;
    this.forget();
    const reader = this.reader;
    this.reader = null;
    return reader;
  }

  /**
   * The program has stopped because of a fault. The pictures that it was at keep what they show; the others come back in a
   * program that is begun anew, unless that has become too much. Without `id` the program itself may know what it was at.
   */
  stop(error, id) {
    if (!this.reader) return;
    console.error("Fabrica:", error);
    const embeds = [...this.#embeds];
    this.#embeds.clear();
    const reader = this.#end();
    giveUp();
    const own = embeds.some((embed) => embed.id === id) ? [id] : [...(attempt(() => reader.at_work()) ?? [])];
    attempt(() => reader.give_up());
    for (const worker of Background.living) worker.terminate();
    for (const refuse of this.waiting) refuse(new Error("The viewer stopped because of a fault."));
    const now = seconds();
    faults = [...faults.filter((time) => now - time < MINUTE), now];
    for (const embed of embeds) {
      embed.falter();
      if (own.includes(embed.id) || faults.length > MOST_FAULTS) embed.lose(error);
      else embed.revive();
    }
  }

  /** The picture that the reader turns to keeps what it needs to be drawn at once. */
  use(embed) {
    if (this.#used === embed) return;
    this.reader.turn_to(embed.id);
    if (this.#used && !this.#used.isDirty) this.reader.rest(this.#used.id);
    this.#used = embed;
  }

  /** A picture has to be drawn. */
  wake(embed) {
    embed.isDirty = true;
    this.#schedule();
  }

  /** Something has come of a load. */
  hear() {
    for (const embed of this.#embeds) {
      // One that shares its data with another may have been given them by that.
      if (embed.waits || !embed.isReady) embed.isDirty = true;
      this.#guard(embed, () => embed.hear());
    }
    this.#schedule();
  }

  /** A fault in one embed leaves the others running. */
  #guard(embed, act) {
    try {
      act();
    } catch (error) {
      if (!this.reader) return; // It has been told.
      embed.isDirty = false;
      embed.fail(error);
    }
  }

  #schedule() {
    if (this.reader && !this.#frame) this.#frame = requestAnimationFrame(() => this.#draw());
  }

  /** The picture to draw next: one that moves, else the one in use, else the first that is seen. */
  #next() {
    const wanting = [...this.#embeds].filter((embed) => embed.isDirty && embed.isSeen);
    const moving = wanting.filter((embed) => embed.isMoving);
    if (moving.length > 0) return moving[(moving.indexOf(this.#last) + 1) % moving.length];
    return wanting.includes(this.#used) ? this.#used : wanting[0];
  }

  #draw() {
    this.#frame = 0;
    let isBusy;
    try {
      if (this.reader.is_lost()) return;
      isBusy = this.reader.tick(REST);
    } catch (error) {
      if (this.reader) throw error;
      return; // The program has stopped, which has been told.
    }
    if (isBusy || this.#wasBusy) {
      for (const embed of this.#embeds) embed.isDirty ||= embed.waits;
    }
    this.#wasBusy = isBusy;
    const embed = this.#next();
    if (embed) this.#guard(embed, () => this.#drawOne(embed));
    this.#last = embed;
    if (isBusy || this.#next()) this.#schedule();
  }

  #drawOne(embed) {
    const [width, height] = embed.size();
    embed.waits = false;
    if (width === 0) {
      embed.isDirty = false; // It has no room; it is woken when it gets some.
      return;
    }
    this.#hasDrawn = true;
    const budget = embed.isMoving ? MOVING : REST;
    const flags = this.reader.draw(embed.id, width, height, seconds(), budget, embed.isMoving);
    embed.isWalking = Boolean(flags & IS_MOVING);
    embed.waits = Boolean(flags & WAITS);
    embed.isDirty = !(flags & IS_DONE) && !embed.waits;
    embed.drawn(Boolean(flags & HAS_PICTURE), Boolean(flags & IS_DONE));
    if (!(flags & IS_DONE)) return;
    this.#losses = 0;
    if (embed !== this.#used) this.reader.rest(embed.id);
  }

  /** Starts again when the device is lost: the same pictures, the same data. */
  watch() {
    this.reader.lost().then(
      () => this.#restart(),
      () => {}, // It has stopped, and is not started again.
    );
  }

  async #restart() {
    if (!this.reader) return;
    for (const embed of this.#embeds) embed.falter();
    // A machine that sleeps takes devices away from pages that do nothing.
    if (this.#hasDrawn) this.#losses += 1;
    this.#hasDrawn = false;
    for (const wait of this.#losses > MOST_LOSSES ? [] : TRIES) {
      await new Promise((go) => setTimeout(go, 1000 * wait));
      if (!this.reader) return;
      const restarting = this.reader.restart();
      this.#restarting = restarting.catch(() => {});
      try {
        await restarting;
      } catch {
        continue;
      }
      if (!this.reader) return;
      this.watch();
      for (const embed of this.#embeds) embed.isDirty = true;
      this.#schedule();
      return;
    }
    const embeds = [...this.#embeds];
    for (const embed of embeds) {
      this.remove(embed);
      embed.lose();
    }
  }
}
