// Group 3 of picks: the rays that are asked.
// needs: types.wgsl

/// The rays, a row of the picture each.
@group(3) @binding(2) var<uniform> asked_rays: AskedRays;
