// Parts of the viewer are programs that run in workers (src/shell/worker). Here a part is started before the viewer asks for
// it, so that it is fetched and compiled while the viewer itself is on its way.

/** Address of the script that all parts start in. */
export const WORKER = new URL("./worker.js", import.meta.url).href;

/** A worker that loads a part and waits for one task, which Viewer.lend gives it; null where there are no workers. */
export function startPart(part) {
  try {
    const worker = new Worker(WORKER, { type: "module" });
    // The viewer hears only of what happens after it was given the worker.
    worker.onerror = () => (worker.hasFailed = true);
    worker.postMessage({ part });
    return { part, worker };
  } catch {
    return null;
  }
}
