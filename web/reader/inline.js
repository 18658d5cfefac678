// Parts of the viewer in the page itself, where its policy starts no worker from another host. The page stands still while one
// works.

const programs = new Map();
/** Tasks are done one after the other: a part answers to whoever gave it the last one. */
let before = Promise.resolve();

function load(part) {
  if (!programs.has(part)) {
    const program = import(`../fabrica_${part}.js`).then(async (bindings) => {
      await bindings.default({ module_or_path: new URL(`../fabrica_${part}_bg.wasm`, import.meta.url) });
      return bindings;
    });
    program.catch(() => programs.delete(part)); // Tried again with the next task.
    programs.set(part, program);
  }
  return programs.get(part);
}

/** Lets go of a bender of a figure, which would end with its worker. */
export function dismiss(bender) {
  before = before.then(() => programs.get("figures")).then((program) => program?.dismiss(bender), () => {});
}

/** Does a task as web/worker.js does it. Answers go to `port`. */
export function run(message, port) {
  const scope = { postMessage: (...args) => port.postMessage(...args), fetch: (...args) => fetch(...args) };
  before = before.then(async () => {
    try {
      const program = await load(message.part);
      if (!message.task) return;
      let other = await program.run({ ...message, scope }, load);
      while (other) other = await (await load(other)).run({ ...message, part: other, module: undefined, scope }, load);
    } catch (error) {
      if (message.task) port.postMessage(["failed", "The part of the viewer that loads scans stopped because of a fault", String(error)]);
    }
  });
}
