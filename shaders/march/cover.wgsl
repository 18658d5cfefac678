// How much light meshes take from what lies around, by their field alone.
// needs: types.wgsl affine.wgsl bind/subject.wgsl bind/mesh_look.wgsl displace/compose.wgsl subject/mesh.wgsl

/// 1 if the body around a place is filled at this depth, by the nearest voxel; else 0.
fn is_filled_near(rest: vec3f, depth: f32) -> u32 {
    let voxel = floor(apply_affine(subject.fill_from_rest, rest) * subject.fill_dims.xyz);
    let label = textureLoad(mesh_fills, vec3i(clamp(voxel, vec3f(0.0), subject.fill_dims.xyz - 1.0)), 0).x;
    let first = first_of(mesh_texel(subject.sets_at + label));
    if label == 0u || first == NO_LABEL {
        // Between the surface and the first voxels inside.
        return select(0u, 1u, depth < subject.field_detail);
    }
    let body = mesh_look.segments[first];
    return select(0u, 1u, body.kind == BODY_FULL || (body.kind == BODY_THICK && depth < body.thickness));
}

/// How much of the light at a place meshes take: by what is inside of closed segments, and by what is near a triangle.
fn mesh_cover(at: Material) -> f32 {
    let uvw = field_from_rest(at.pos);
    let depth = field_at(at.pos);
    let is_there = at.continuity >= 0.0 && all(uvw >= vec3f(0.0)) && all(uvw <= vec3f(1.0));
    let thin = 1.0 - smoothstep(0.4 * subject.field_detail, 1.2 * subject.field_detail, abs(depth));
    let full = smoothstep(-0.3 * subject.field_detail, 0.7 * subject.field_detail, depth);
    // Most places that are asked lie outside: they end the loop before it begins.
    var filled = 0u;
    var asks = is_there && full > 0.0;
    while asks {
        asks = false;
        filled = is_filled_near(at.pos, depth);
    }
    return select(0.0, max(thin * 0.5, full * f32(filled)), is_there);
}
