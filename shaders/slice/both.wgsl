// A slice through a scan with meshes beside it: what bodies of meshes fill in their colours, the scan around them, and
// surfaces as lines.
// needs: bind/subject.wgsl displace/compose.wgsl subject/mesh.wgsl march/filling.wgsl slice/plane.wgsl
//   slice/values.wgsl slice/mesh.wgsl march/plain.wgsl|march/align.wgsl

/// What the deformed object has at a point of subject space; its value is the scan's, whatever fills the place.
fn object_at(pos: vec3f) -> Here {
    let mapped = object_from_subject(pos, 0xffffffffu);
    var here = volume_from(mapped);
    let segment = filled_at(mapped.pos);
    if segment != 0u && mapped.continuity >= 0.0 {
        here.label = subject.labels_before + segment;
        here.is_there = true;
    }
    return here;
}

/// Linear RGB of the object at a place, over the background.
fn color_at(pixel: vec2f) -> vec3f {
    let line = line_at(pixel);
    if line != NO_TRIANGLE {
        return line_color(line);
    }
    let here = object_at(subject_from_pixel(pixel));
    if here.is_there && here.label > subject.labels_before {
        return filling_color_at(here.label - subject.labels_before, here.pos);
    }
    return marked_color_of(here);
}
