// A slice through a subject of meshes alone: what is filled in the colours of its segments, and surfaces as lines.
// needs: types.wgsl bind/slice.wgsl displace/compose.wgsl subject/mesh.wgsl march/filling.wgsl slice/plane.wgsl
//   slice/mesh.wgsl march/plain.wgsl|march/align.wgsl

/// What the deformed object has at a point of subject space: its depth under the surface stands for a value.
fn object_at(pos: vec3f) -> Here {
    let mapped = object_from_subject(pos, 0xffffffffu);
    let segment = filled_at(mapped.pos);
    return Here(
        mapped.pos,
        field_at(mapped.pos),
        mapped.continuity,
        segment,
        segment != 0u && mapped.continuity >= 0.0,
    );
}

/// Linear RGB of the object at a place, over the background.
fn color_at(pixel: vec2f) -> vec3f {
    let line = line_at(pixel);
    if line != NO_TRIANGLE {
        return line_color(line);
    }
    let here = object_at(subject_from_pixel(pixel));
    if !here.is_there {
        return slice.background.rgb;
    }
    return filling_color_at(here.label, here.pos);
}
