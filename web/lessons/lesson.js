// The buttons in the text: <button class="show" data-viewer="skull" data-step="3" hidden>…</button> shows step 3 of the
// embed with that id. They stay hidden where the embed cannot draw: without its script, without WebGPU, after a fault.
await customElements.whenDefined("fabrica-viewer");
for (const button of document.querySelectorAll("button.show[data-viewer]")) {
  const viewer = document.getElementById(button.dataset.viewer);
  if (!viewer || !navigator.gpu) continue;
  button.hidden = false;
  viewer.addEventListener("error", () => (button.hidden = !viewer.steps?.length));
  button.addEventListener("click", () => {
    viewer.step = Number(button.dataset.step);
    const gently = !matchMedia("(prefers-reduced-motion: reduce)").matches;
    viewer.scrollIntoView({ block: "nearest", behavior: gently ? "smooth" : "auto" });
  });
}
