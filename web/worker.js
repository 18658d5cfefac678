// The viewer's own program in a background thread: it reads files and makes subjects off the frame loop.
// Messages are described in src/shell/worker.rs.

self.onmessage = async (event) => {
  try {
    const fabrica = await import("./fabrica.js");
    await fabrica.default({ module_or_path: event.data.module });
    await fabrica.worker_task(event.data);
  } catch (error) {
    self.postMessage(["failed", "The background thread that loads scans stopped because of a fault", String(error)]);
  }
};
