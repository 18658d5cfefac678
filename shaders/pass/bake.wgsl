// Bakes the composed map into a texture over the deformed space, slab by slab.
// Source: Correa, section 4.3.
// needs: types.wgsl bind/templates.wgsl displace/compose.wgsl

/// Where the texture lies and which slabs are made.
@group(3) @binding(0) var<uniform> baked: Baked;
/// As march/baked.wgsl reads it.
@group(3) @binding(1) var baked_out: texture_storage_3d<rgba16float, write>;

@compute @workgroup_size(4, 4, 4)
fn bake(@builtin(global_invocation_id) id: vec3u) {
    let texel = id + vec3u(0u, 0u, baked.first_slab);
    if any(texel >= baked.texels.xyz) {
        return;
    }
    let pos = baked.origin_min.xyz + (vec3f(texel) + 0.5) / (vec3f(baked.texels.xyz) * baked.per_unit.xyz);
    let mapped = rest_from_subject(pos, 0xffffffffu);
    textureStore(baked_out, texel, vec4f(mapped.pos - pos, clamp(mapped.continuity, -1.0, 1.0)));
}
