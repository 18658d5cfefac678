// The picture: marches the deformed space along each pixel's ray (march/volume.wgsl, march/mesh.wgsl). Fragment
// shaders, uniform buffers and sampled textures only, so that WebGL2 could follow.
// needs: types.wgsl affine.wgsl bind/frame.wgsl bind/rays.wgsl march/seek.wgsl march/volume.wgsl|march/surfaces.wgsl
//   style/words.wgsl

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

/// A pixel of the picture, and what it shows: see style/traced.wgsl.
struct Traced {
    @location(0) color: vec4f,
    @location(1) place: vec4f,
    @location(2) surface: vec2u,
}

/// Objects are numbered behind the labels of segments, those of meshes beside a volume among them.
const FIRST_OBJECT: u32 = 512u;

/// How bright a colour is.
fn luminance(color: vec3f) -> f32 {
    return dot(color, vec3f(0.2126, 0.7152, 0.0722));
}

/// The picture, linear premultiplied, and what its pixels show, for pass/style.wgsl: of see-through tissue where the
/// ray's surface is.
@fragment
fn trace(@builtin(position) at: vec4f) -> Traced {
    let pixel = pixel_at(at);
    let ray = ray_through(pixel);
    let found = march(ray, pixel);
    let is_object = found.surface_what == MET_OBJECT;
    let pos = ray.origin + ray.dir * found.surface_t;
    let segment = select(shown_segment(found, pos), FIRST_OBJECT - 1u + found.segment, is_object);
    let normal = apply_transposed(frame.subject_from_view, found.surface_normal);
    let own = luminance(found.event.albedo) * max(found.color.w, 1e-3);
    let light = select(luminance(found.color.rgb) / max(own, 1e-4), 1.0, found.event.what == MET_NOTHING);
    let is_found = found.surface_t >= 0.0;
    let facing = select(vec3f(0.0, 0.0, 1.0), normal, is_found);
    return Traced(
        found.color,
        vec4f(found.surface_rest, found.surface_t),
        surface_words(facing, select(0u, segment, is_found), light),
    );
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
