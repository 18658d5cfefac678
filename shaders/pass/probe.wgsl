// Probe: the inverse map at given points, for tests, picking, labels and the command line. Subject space in, rest space
// out.
// needs: types.wgsl bind/templates.wgsl displace/compose.wgsl

/// Points of the deformed object, subject space (w is not used).
@group(3) @binding(0) var<storage, read> probe_points: array<vec4f>;
/// xyz: rest space; w: the composed continuity.
@group(3) @binding(1) var<storage, read_write> probe_results: array<vec4f>;

@compute @workgroup_size(64)
fn probe(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= arrayLength(&probe_points) {
        return;
    }
    let mapped = rest_from_subject(probe_points[id.x].xyz, 0xffffffffu);
    probe_results[id.x] = vec4f(mapped.pos, mapped.continuity);
}
