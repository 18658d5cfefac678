// Object probe: what the object has at given points when alignment counts, for the command line and tests.
// needs: displace/compose.wgsl march/align.wgsl

/// Points of the deformed object, subject space (w is not used).
@group(3) @binding(0) var<storage, read> probe_points: array<vec4f>;
/// xyz: rest space; w: the composed continuity, below 0 where there is nothing.
@group(3) @binding(1) var<storage, read_write> probe_results: array<vec4f>;

@compute @workgroup_size(64)
fn probe_object(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= arrayLength(&probe_points) {
        return;
    }
    let found = material_at(probe_points[id.x].xyz, 0xffffffffu);
    probe_results[id.x] = vec4f(found.pos, found.continuity);
}
