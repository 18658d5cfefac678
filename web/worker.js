// A part of the viewer in a background thread: it makes subjects or reads files off the frame loop. The first message names
// the part, which is loaded then; tasks and answers are described in src/shell/worker.

const programs = new Map();

/** The functions of a part. `module` is its compiled module, if the page has it. */
function load(part, module) {
  if (!programs.has(part)) {
    const program = import(`./fabrica_${part}.js`).then(async (bindings) => {
      await bindings.default({ module_or_path: module ?? new URL(`./fabrica_${part}_bg.wasm`, import.meta.url) });
      return bindings;
    });
    programs.set(part, program);
  }
  return programs.get(part);
}

/** Tells the page that there will be no answer. The page ends this worker and goes on. */
function fail(error) {
  self.postMessage(["failed", "The background thread that loads scans stopped because of a fault", String(error)]);
}

self.onmessage = async ({ data }) => {
  try {
    const bindings = await load(data.part, data.module);
    if (!data.task) return;
    // A part that finds that a file is for another one names it.
    let other = await bindings.run(data, load);
    while (other) other = await (await load(other)).run({ ...data, part: other, module: undefined }, load);
  } catch (error) {
    // A part that was asked for early and could not be loaded fails its task, which is still to come.
    if (data.task) fail(error);
  }
};

// A panic in a part reaches the page before this with its text (src/shell/worker/fault.rs).
self.addEventListener("error", (event) => {
  event.preventDefault();
  fail(event.error ?? event.message);
});
self.addEventListener("unhandledrejection", (event) => {
  event.preventDefault();
  fail(event.reason);
});
