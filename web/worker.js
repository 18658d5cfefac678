// The viewer's own program in a background thread: it reads files and makes subjects off the frame loop.
// Messages are described in src/shell/worker.rs.

let ready;

self.onmessage = async (event) => {
  try {
    ready ??= import("./fabrica.js").then(async (fabrica) => {
      await fabrica.default({ module_or_path: new URL("./fabrica_bg.wasm", import.meta.url) });
      return fabrica;
    });
    const fabrica = await ready;
    await fabrica.worker_task(event.data);
  } catch (error) {
    self.postMessage({ kind: "failed", message: String(error) });
  }
};
