// The picture: marches the deformed space along each pixel's ray (march/volume.wgsl, march/mesh.wgsl). Fragment
// shaders, uniform buffers and sampled textures only, so that WebGL2 could follow.
// needs: types.wgsl affine.wgsl bind/frame.wgsl march/seek.wgsl march/volume.wgsl|march/mesh.wgsl

/// One triangle that covers everything.
@vertex
fn cover(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    return vec4f(f32(index & 1u) * 4.0 - 1.0, f32(index >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}

/// The picture, linear premultiplied.
@fragment
fn draw(@builtin(position) at: vec4f) -> @location(0) vec4f {
    return march(floor(at.xy) + frame.jitter).color;
}

/// The surface at one pixel, as four texels: position and distance from the eye (below 0: no surface); normal and
/// segment; rest position and value; accumulated opacity.
@fragment
fn pick(@builtin(position) at: vec4f) -> @location(0) vec4f {
    let found = march(frame.pick);
    let pos = apply_affine(frame.subject_from_view, dir_in_view_of(frame.pick) * found.surface_t);
    let tissue = tissue_of(found, pos, normalize(pos - offset_of(frame.subject_from_view)));
    let part = u32(at.x);
    if part == 0u {
        return vec4f(pos, found.surface_t);
    }
    if part == 1u {
        return vec4f(found.surface_normal, tissue.x);
    }
    if part == 2u {
        return vec4f(found.surface_rest, tissue.y);
    }
    return found.color;
}

/// What each pixel of a picture shows: the distance of its surface from the eye (below 0: no surface) and the segment
/// there (0: none).
@fragment
fn identify(@builtin(position) at: vec4f) -> @location(0) vec4f {
    let pixel = floor(at.xy) + frame.jitter;
    let found = march(pixel);
    let pos = apply_affine(frame.subject_from_view, dir_in_view_of(pixel) * found.surface_t);
    let tissue = tissue_of(found, pos, normalize(pos - offset_of(frame.subject_from_view)));
    return vec4f(found.surface_t, tissue.x, 0.0, found.color.w);
}
