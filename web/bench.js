// The page with ?bench: frame times on this browser's adapter, as a table that can be copied. ?bench=3 takes three frames a row,
// &size=128 pictures of 128 × 128 pixels, &voxels=64 a head of 64 voxels along its longest side, &rows=3 the first three rows.
// The measuring is the program's own (src/render/draw/bench.rs), the same that `fabrica bench` runs.

/**
 * Measures by a plan (frames a row, size, voxels, rows; 0: as the command does), showing in `box` how far that is, and then the
 * table. Returns the report, as `fabrica bench --json` prints it.
 */
export async function showBench(fabrica, box, plan) {
  const bar = document.createElement("progress");
  const told = document.createElement("p");
  told.textContent = "Frames of the built-in head and of an apple are drawn and timed. Leave this page in sight until it is done.";
  bar.setAttribute("aria-label", "Measured");
  box.replaceChildren(told, bar);
  box.hidden = false;
  const [json, text] = await fabrica.bench(...plan, (part) => (bar.value = part));
  const report = JSON.parse(json);
  const adapter = document.createElement("p");
  adapter.textContent =
    `${report.adapter || "an adapter that the browser does not name"}: ${report.voxels.join(" × ")} voxels, ` +
    `${report.size.join(" × ")} pixels. Times are medians; ratios are to the undeformed frame.`;
  const copy = document.createElement("button");
  copy.textContent = "Copy";
  copy.onclick = async () => {
    try {
      await navigator.clipboard.writeText(`${text}${navigator.userAgent}\n`);
      copy.textContent = "Copied";
    } catch {
      copy.textContent = "Mark the table and press Ctrl+C";
    }
  };
  box.replaceChildren(adapter, tableOf(report.frames), copy);
  return report;
}

function tableOf(frames) {
  const table = document.createElement("table");
  const row = (cells, tag) => {
    const line = table.insertRow();
    for (const text of cells) {
      const cell = document.createElement(tag);
      cell.textContent = text;
      line.append(cell);
    }
  };
  row(["Scene", "Skip grid", "Frame, ms", "Ratio", "Edited in, ms", "Opened in, ms", "Without the grid"], "th");
  for (const frame of frames) {
    row(
      [
        frame.name,
        frame.grid ? "with" : "without",
        frame.ms.toFixed(1),
        frame.ratio.toFixed(2),
        frame.making_ms.toFixed(1),
        frame.opening_ms.toFixed(1),
        frame.grid_gain === null ? "" : `${frame.grid_gain.toFixed(2)} ×`,
      ],
      "td",
    );
  }
  return table;
}
