// The map as light asks it and as the picture's places are asked, for splines.rs.
// needs: types.wgsl affine.wgsl bind/templates.wgsl displace/curve.wgsl displace/compose.wgsl

/// Points of the deformed object, subject space; w: 1 to ask as light does, 0 as places are asked.
@group(3) @binding(0) var<storage, read> asked: array<vec4f>;
/// xyz: rest space; w: how far the first template's `bend` is from taking back its `unbend`, straight box, below 0
/// where nothing is laid.
@group(3) @binding(1) var<storage, read_write> answers: array<vec4f>;

@compute @workgroup_size(64)
fn ask(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= arrayLength(&asked) {
        return;
    }
    let point = asked[id.x];
    rounds_splines = point.w > 0.5;
    let mapped = rest_from_subject(point.xyz, 0xffffffffu);
    let first = templates.items[0].curve;
    let size = templates.items[0].size.xyz;
    let q = apply_affine(templates.items[0].template_from_subject, point.xyz);
    let own = unbend(first, size, q);
    let off = length(bend(first, size, own.xyz) - q);
    answers[id.x] = vec4f(mapped.pos, select(-1.0, off, own.w > 0.5));
}
