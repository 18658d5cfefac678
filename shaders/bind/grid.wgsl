// Group 2, bindings 3 and 4: the skip grid over the deformed space.
// needs: types.wgsl

/// Where the skip grid lies.
@group(2) @binding(3) var<uniform> grid: Grid;
/// Per cell x: mask of the templates that may reach it; y: 0 if something visible may be there, else all cells nearer
/// than y cells (Chebyshev) are empty.
@group(2) @binding(4) var grid_cells: texture_3d<u32>;
