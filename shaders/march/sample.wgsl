// The object at one point of the deformed space: where it came from, its value and its opacity.
// needs: types.wgsl bind/subject.wgsl bind/look.wgsl displace/compose.wgsl march/overrides.wgsl march/value.wgsl
//   march/opacity.wgsl march/bodies.wgsl march/whole.wgsl|march/replaced.wgsl
//   march/plain.wgsl|march/align.wgsl|march/baked.wgsl

/// The object at one point of the deformed space.
struct Sample {
    /// Where the material was at rest, rest space.
    pos: vec3f,
    /// Normalised value, 0 to 1.
    texel: f32,
    /// Opacity of 0.01 subject units, 0 to 1; 0 in a gap and outside the volume.
    opacity: f32,
    /// Continuity of the composed map; below 0 in a gap.
    continuity: f32,
    /// Templates that led here.
    path: u32,
}

/// Where a point of the deformed space came from, by the templates of a mask.
fn map_point(pos: vec3f, mask: u32) -> Material {
    if drawn_kinds == 0u {
        return Material(pos, 1.0, 0u);
    }
    return material_at(pos, mask);
}

/// Linear RGB and opacity of a normalised value.
fn transfer(texel: f32) -> vec4f {
    return textureSampleLevel(lut, linear_sampler, vec2f(texel * look.table_scale + look.table_offset, 0.5), 0.0);
}

/// The sample at a point whose place at rest is known.
fn sample_mapped(mapped: Material) -> Sample {
    let uvw = texture_from_rest(mapped.pos);
    let is_inside = is_in_subject(uvw);
    let texel = texel_at(uvw);
    var opacity = transfer(texel).a;
    if has_bodies != 0u {
        opacity = with_bodies(opacity, body_at(mapped.pos));
    }
    return Sample(
        mapped.pos,
        texel,
        select(0.0, opacity, is_inside && mapped.continuity >= 0.0 && !is_replaced(mapped.pos)),
        mapped.continuity,
        mapped.path,
    );
}

/// The sample at a point that no template reaches.
fn sample_unmoved(pos: vec3f) -> Sample {
    return sample_mapped(Material(pos, 1.0, 0u));
}

/// Where a value lies in the transfer table, 0 to 1: how dense the tissue counts as (equation 6.3).
fn density_of(found: Sample) -> f32 {
    return clamp(found.texel * look.table_scale + look.table_offset, 0.0, 1.0);
}
