// Workers for parts of the viewer, and what stands for them where the page starts none.

import { WORKER } from "../parts.js";

const WHY =
  "Fabrica: this page starts no worker of the viewer (its policy has to allow blob: in worker-src), " +
  "so it stands still while data are made or read.";
/** A worker was refused: the next one would be too. */
let isRefused = false;

/**
 * A worker, or what looks like one: where none can be started, as under a policy that forbids blobs, its tasks are done in the
 * page itself. Browsers tell that when the worker is made, or by an event before it has said anything.
 */
export class Background {
  /** Those that have not been ended. */
  static living = new Set();

  onmessage = null;
  onerror = null;
  #worker = null;
  #channel = null;
  #unanswered = [];
  #hasSpoken = false;
  #hasEnded = false;
  /** The bender of a figure that stands in the page. */
  #bender = null;

  constructor() {
    Background.living.add(this);
    if (isRefused) return this.#stayHere();
    try {
      this.#worker = new Worker(WORKER, { type: "module" });
    } catch {
      return this.#stayHere();
    }
    this.#worker.onmessage = (event) => {
      [this.#hasSpoken, this.#unanswered] = [true, []];
      this.onmessage?.(event);
    };
    this.#worker.onerror = (event) => (this.#hasSpoken ? this.onerror?.(event) : this.#stayHere());
  }

  postMessage(message) {
    if (!this.#hasSpoken) this.#unanswered.push(message);
    if (this.#channel) this.#runHere(message);
    else this.#worker.postMessage(message);
  }

  terminate() {
    this.#hasEnded = true;
    Background.living.delete(this);
    this.#worker?.terminate();
    this.#channel?.port1.close();
    this.#unanswered = [];
    const bender = this.#bender;
    if (bender !== null) import("./inline.js").then(({ dismiss }) => dismiss(bender));
  }

  #stayHere() {
    if (!isRefused) console.warn(WHY);
    isRefused = true;
    this.#worker?.terminate();
    this.#channel = new MessageChannel();
    this.#channel.port2.onmessage = (event) => this.onmessage?.(event);
    for (const message of this.#unanswered) this.#runHere(message);
  }

  #runHere(message) {
    this.#bender = message.bender ?? null;
    import("./inline.js").then(
      ({ run }) => !this.#hasEnded && run(message, this.#channel.port1),
      (error) => this.onerror?.(error),
    );
  }
}
