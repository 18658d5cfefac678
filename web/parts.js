// Parts of the viewer are programs that run in workers (src/shell/worker). Here a part is started before the viewer asks for
// it, so that it is fetched and compiled while the viewer itself is on its way.

const SCRIPT = new URL("./worker.js", import.meta.url);

/** Address of the script that all parts start in. */
export const WORKER = address();

/**
 * Browsers start no worker from another host, nor from any where the page is sandboxed and has no origin. There a script of the
 * page's own imports it: a blob, or a data address where even a blob would be another's.
 */
function address() {
  if (SCRIPT.origin === self.origin) return SCRIPT.href;
  const script = `import ${JSON.stringify(SCRIPT.href)};`;
  if (self.origin === "null") return `data:text/javascript,${encodeURIComponent(script)}`;
  return URL.createObjectURL(new Blob([script], { type: "text/javascript" }));
}

/** A worker that loads a part and waits for one task, which Viewer.lend gives it; null where there are no workers. */
export function startPart(part, make = () => new Worker(WORKER, { type: "module" })) {
  try {
    const worker = make();
    // The viewer hears only of what happens after it was given the worker.
    worker.onerror = () => (worker.hasFailed = true);
    worker.postMessage({ part });
    return { part, worker };
  } catch {
    return null;
  }
}

/** Built-in subjects that are volumes. */
const VOLUMES = ["bar", "cube", "tomato", "piggybank", "head", "hand", "torso", "knee"];

/** The path of an address at the page's own host; null for any other, and for what is no address. */
function ownPath(src, base) {
  if (typeof src !== "string" || !URL.canParse(src, base)) return null;
  const { origin, pathname } = new URL(src, base);
  return origin === self.origin ? pathname : null;
}

/**
 * The part that the subject of a document needs, as far as its JSON tells without the viewer; else null, and the viewer tells.
 * `base` is what relative addresses are relative to.
 */
export function partOf(json, base) {
  let subject;
  try {
    subject = JSON.parse(json).subject ?? { builtin: "head" };
  } catch {
    return null;
  }
  if (typeof subject?.clay === "object" && subject.clay !== null) {
    const from = Object(subject.clay.from);
    const of = from.of === undefined ? from : Object(from.of);
    const { src, sha256 } = of.builtin === undefined ? of : {};
    // Without a file it begins with a shape or a built-in subject; a file of the reader's own is not there yet.
    if (src === undefined) return sha256 === undefined ? "clay" : null;
    return ownPath(src, base) === null ? null : "clay";
  }
  if (VOLUMES.includes(subject?.builtin)) return "subjects";
  const pathname = subject?.builtin === undefined ? ownPath(subject?.src, base) : null;
  if (pathname === null) return null;
  if (/\.(nii|nii\.gz|nrrd|nhdr)$/i.test(pathname)) return "scans";
  return /\.(stl|ply|obj|gltf|glb)$/i.test(pathname) ? "meshes" : null;
}
