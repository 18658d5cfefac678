// How an embed looks. Pages change it by ::part(…) and by --fabrica-ratio, --fabrica-ink and --fabrica-ground.

export const STYLE = `
  :host { display: block; font: 16px/1.4 system-ui, sans-serif; }
  :host([hidden]), [hidden] { display: none !important; }
  .frame { display: flex; flex-direction: column; height: 100%; color: var(--fabrica-ink, inherit); background: var(--fabrica-ground, none); }
  .stage { position: relative; flex: 1 1 auto; aspect-ratio: var(--fabrica-ratio, 4 / 3); min-height: 8rem; width: 100%;
    container-type: inline-size; overflow: hidden; cursor: grab; user-select: none; -webkit-user-select: none; color: #1f2426; --halo: rgb(255 255 255 / 0.85); }
  .stage.dark { color: #fff; --halo: rgb(0 0 0 / 0.75); }
  .stage:active { cursor: grabbing; }
  .stage { outline: none; }
  /* A ring of two colours is seen on every picture. */
  .stage:is(:focus-visible, .inside)::after { content: ""; position: absolute; inset: 0; z-index: 3; pointer-events: none; border: 3px solid #1558c0;
    outline: 2px solid #fff; outline-offset: -5px; }
  .stage.inside { touch-action: none; }
  canvas, .layer, .layer svg, .cover { position: absolute; inset: 0; width: 100%; height: 100%; }
  .paper { display: none; }
  .lost .paper { display: block; }
  .lost canvas:not(.paper) { visibility: hidden; }
  .cover.is-poster { background: Canvas; }
  .cover img, .cover ::slotted(img) { display: block; width: 100%; height: 100%; object-fit: contain; }
  .layer { pointer-events: none; z-index: 1; font-size: 13px; }
  .layer ol { margin: 0; padding: 0; list-style: none; }
  .layer li { position: absolute; left: 0; top: 0; max-width: min(27cqw, 190px); padding: 1px 4px; border-radius: 4px;
    background: var(--halo); pointer-events: auto; cursor: text; user-select: text; -webkit-user-select: text; }
  .layer li.off { visibility: hidden; }
  .layer li.behind { opacity: 0.75; }
  .layer svg .behind { opacity: 0.6; }
  .layer li.absent, .unseen { clip-path: inset(50%); }
  .unseen { position: absolute; width: 1px; height: 1px; margin: 0; overflow: hidden; white-space: nowrap; }
  .layer path { fill: none; stroke: currentColor; stroke-width: 1.2; }
  .layer path.halo { stroke: var(--halo); stroke-width: 3; }
  .layer circle { fill: currentColor; stroke: var(--halo); stroke-width: 1.4; }
  .mark { position: absolute; padding: 0 4px; font-weight: 600; text-shadow: 0 0 3px var(--halo), 0 0 2px var(--halo), 0 0 1px var(--halo); }
  .mark:is(.left, .right) { top: 50%; transform: translateY(-50%); }
  .mark:is(.top, .bottom) { left: 50%; transform: translateX(-50%); }
  .mark.left { left: 2px; }
  .mark.right { right: 2px; }
  .mark.top { top: 2px; }
  .mark.bottom { bottom: 2px; }
  .mark.ruler { box-sizing: border-box; right: 12px; bottom: 10px; padding: 0; border: 2px solid; border-top: 0; font-weight: 400; line-height: 1.2;
    display: grid; justify-content: center; white-space: nowrap; filter: drop-shadow(0 0 1px var(--halo)); }
  .hint { position: absolute; z-index: 2; left: 50%; bottom: 6px; transform: translateX(-50%); margin: 0; padding: 2px 10px; max-width: 94%;
    border-radius: 10px; font-size: 13px; background: #000c; color: #fff; opacity: 0; pointer-events: none; }
  .ready .stage:focus-visible .hint, .ready .stage.inside .hint { opacity: 1; }
  @media (hover: hover) { .ready .stage:hover .hint { opacity: 1; } }
  .ready .cover, .ready ~ .poster { display: none; }
  .frame:not(.ready) :is(.controls, .legend) { display: none; }
  .words { padding: 8px 12px; white-space: pre-line; }
  .words-only :is(canvas, .layer, .hint) { display: none; }
  .words-only .stage { cursor: auto; }
  .legend { margin: 0; padding: 8px 12px; min-height: 1.4em; }
  .controls { display: flex; flex-wrap: wrap; gap: 6px 14px; padding: 6px; }
  .controls > div { display: flex; flex-wrap: wrap; align-items: center; gap: 4px; min-width: 0; }
  .controls > div:first-child { flex: 1 1 20rem; }
  button { font: inherit; color: inherit; background: none; border: 1px solid color-mix(in srgb, currentColor 45%, transparent); border-radius: 6px;
    min-width: 32px; min-height: 32px; padding: 4px 7px; cursor: pointer; }
  button[aria-disabled="true"] { cursor: default; }
  button[aria-disabled="true"] svg { opacity: 0.45; }
  button svg { display: block; width: 16px; height: 16px; fill: none; stroke: currentColor; stroke-width: 1.8; stroke-linecap: round; stroke-linejoin: round; }
  button:focus-visible, select:focus-visible, input:focus-visible { outline: 3px solid currentColor; outline-offset: 2px; }
  /* Browsers give sliders a grey of their own, on which the empty part of the track looks fuller than the filled one. */
  input { color: inherit; accent-color: currentColor; }
  input[type="range"] { min-height: 24px; min-width: 6rem; flex: 3 1 8rem; }
  input[type="checkbox"] { width: 24px; height: 24px; margin: 0; }
  select { font: inherit; color: inherit; background: Canvas; min-height: 32px; flex: 1 1 8rem; max-width: min(22rem, 100%); border-radius: 6px; text-overflow: ellipsis; }
  fieldset { display: flex; flex-wrap: wrap; gap: 4px 14px; flex: 1 1 100%; margin: 0; border: 0; padding: 2px; min-width: 0; }
  legend { padding: 0; font-weight: 600; }
  label { display: flex; align-items: center; gap: 6px; flex: 1 1 14rem; min-height: 28px; }
  :host(:fullscreen) { background: Canvas; color: CanvasText; overflow: auto; }
  :host(:fullscreen) .stage, .fills .stage { aspect-ratio: auto; }
  .fills { position: fixed; inset: 0; width: 100%; height: 100%; margin: 0; border: 0; padding: 0; overflow: auto; background: Canvas; color: CanvasText; }
  @media print {
    .controls, .hint, .stage::after { display: none !important; }
    .frame { break-inside: avoid; }
    .paper { display: block !important; }
    canvas:not(.paper) { display: none; }
    .stage { print-color-adjust: exact; -webkit-print-color-adjust: exact; }
  }
  @media (forced-colors: active) {
    .layer li { background: Canvas; color: CanvasText; }
    /* The picture keeps its colours, and so do the lines on it. */
    .layer :is(svg, .mark) { forced-color-adjust: none; color: #1f2426; }
    .dark .layer :is(svg, .mark) { color: #fff; }
  }
`;
