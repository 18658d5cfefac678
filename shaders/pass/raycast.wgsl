// The picture: marches the deformed space along each pixel's ray (march/volume.wgsl, march/mesh.wgsl). Fragment
// shaders, uniform buffers and sampled textures only, so that WebGL2 could follow.
// needs: types.wgsl affine.wgsl bind/frame.wgsl bind/rays.wgsl march/seek.wgsl march/volume.wgsl|march/surfaces.wgsl

/// One triangle that covers everything.
@vertex
fn cover(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    return vec4f(f32(index & 1u) * 4.0 - 1.0, f32(index >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}

/// Where in the whole picture the ray of a pixel of the target goes through, pixels.
fn pixel_at(at: vec4f) -> vec2f {
    return floor(at.xy) + vec2f(0.0, frame.first_row) + frame.jitter;
}

/// The picture, linear premultiplied.
@fragment
fn draw(@builtin(position) at: vec4f) -> @location(0) vec4f {
    let pixel = pixel_at(at);
    return march(ray_through(pixel), pixel).color;
}

/// Rays of one `AskedRays`.
const ROWS_AT_ONCE: u32 = 256u;

/// The ray that is asked in a row.
fn asked_ray(row: f32) -> Ray {
    let index = 2u * (u32(row) % ROWS_AT_ONCE);
    let dir = asked_rays.items[index + 1u].xyz;
    return ray_along(asked_rays.items[index].xyz, dir, apply_transposed(frame.subject_from_view, dir));
}

/// The surface along each row's ray, as four texels: position and distance from the origin (below 0: no surface);
/// normal and segment; rest position and value; object (from 1, 0 for none) and accumulated opacity.
@fragment
fn pick(@builtin(position) at: vec4f) -> @location(0) vec4f {
    let ray = asked_ray(at.y);
    let found = march(ray, vec2f(0.0));
    let pos = ray.origin + ray.dir * found.surface_t;
    let tissue = tissue_of(found, pos, ray.dir);
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
    let object = select(0u, found.segment, found.surface_what == MET_OBJECT);
    return vec4f(f32(object), 0.0, 0.0, found.color.w);
}

/// Where each row's ray turns more than half opaque, as four texels: distance from the origin, what is there, segment;
/// normal; rest position; colour before light.
@fragment
fn meet(@builtin(position) at: vec4f) -> @location(0) vec4f {
    let event = march(asked_ray(at.y), vec2f(0.0)).event;
    let part = u32(at.x);
    if part == 0u {
        return vec4f(event.t, f32(event.what), f32(event.segment), 0.0);
    }
    let rest_or_color = select(event.albedo, event.rest, part == 2u);
    return vec4f(select(rest_or_color, event.normal, part == 1u), 0.0);
}

/// What each pixel of a picture shows: the distance of its surface from the eye (below 0: no surface) and the segment
/// there (0: none).
@fragment
fn identify(@builtin(position) at: vec4f) -> @location(0) vec4f {
    let pixel = pixel_at(at);
    let ray = ray_through(pixel);
    let found = march(ray, pixel);
    let tissue = tissue_of(found, ray.origin + ray.dir * found.surface_t, ray.dir);
    return vec4f(found.surface_t, tissue.x, 0.0, found.color.w);
}
