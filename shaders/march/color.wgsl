// The colour of tissue. The transfer table gives the colour, and the segments around the point tint that colour. Where
// the tissue belongs to a body, the colour of the body replaces the tinted colour.
// needs: types.wgsl bind/subject.wgsl bind/look.wgsl march/overrides.wgsl march/value.wgsl march/segments.wgsl
//   march/sample.wgsl march/surface.wgsl march/plain.wgsl|march/align.wgsl|march/baked.wgsl

/// How deep below a surface, in voxels, the shader searches for a segment if the voxels around the surface belong to no
/// segment. Such voxels occur because a voxel that tissue fills to less than half has the label of air. The search ends
/// at the first segment, since a thin segment such as the skin must not be missed.
const TINT_DEPTH: f32 = 1.9;

/// Colour of the segments around a point, linear RGB, premultiplied by how much of it is known (alpha): of those on a
/// side of the surfaces of kept tissue if there are any, so that what was beside kept tissue leaves no colour on it.
fn tint_at(pos: vec3f, side: u32) -> vec4f {
    let around = around_at(pos);
    var sum = vec4f(0.0);
    var beyond = vec4f(0.0);
    for (var i = 0; i < 27; i++) {
        let label = label_around(around, i);
        let color = textureLoad(palette, vec2i(i32(label), 0), 0);
        let part = vec4f(color.rgb * color.a, color.a) * weight_around(around, i);
        let is_ours = is_on_side(label, side);
        sum += select(vec4f(0.0), part, is_ours);
        beyond += select(part, vec4f(0.0), is_ours);
    }
    return select(sum, beyond, sum.a <= 0.02 && beyond.a > sum.a);
}

/// Linear RGB of a surface.
fn albedo_of(edge: Sample, surface: Surface) -> vec3f {
    var texel = edge.texel;
    if KEEPS_TISSUE || has_bodies != 0u {
        texel = texel_at(texture_from_rest(surface.tint_pos));
    }
    var albedo = transfer(texel).rgb;
    if has_labels != 0u {
        let grad = surface.gradient;
        let inwards = grad / max(length(grad), 1e-9) * (subject.detail * smoothstep(0.01, 0.05, surface.steepness));
        let side = side_at(edge.pos);
        var depth = 0.0;
        var tint = vec4f(0.0);
        loop {
            tint = tint_at(surface.tint_pos + inwards * depth, side);
            if tint.a > 0.02 || depth >= TINT_DEPTH {
                break;
            }
            depth += 0.4;
        }
        let how_much = look.tint * smoothstep(0.0, 0.02, tint.a);
        albedo = mix(albedo, albedo * tint.rgb / max(tint.a, 1e-4), how_much);
    }
    if has_bodies != 0u {
        let body = body_color_at(surface.tint_pos);
        albedo = mix(albedo, body.rgb / max(body.a, 1e-4), smoothstep(0.02, 0.3, body.a));
    }
    return albedo;
}
