// Where the pixels of the picture lie on a triangle that a ray meets: the Jacobian takes a pixel to rest space, so that
// a texture under templates takes the copy that fits what is seen of it, and wires are as wide as a pixel.
// needs: types.wgsl affine.wgsl textures.wgsl bind/frame.wgsl march/overrides.wgsl march/seek.wgsl

/// From a place of a ray to those of the rays through the next pixels, subject space.
struct NextPixels {
    right: vec3f,
    down: vec3f,
}

fn next_pixels(ray: Ray, t: f32) -> NextPixels {
    let side = 2.0 * frame.lens / frame.size_px * (-ray.dir_in_view.z * t);
    let right = apply_linear(frame.subject_from_view, vec3f(side.x, 0.0, 0.0));
    let down = apply_linear(frame.subject_from_view, vec3f(0.0, -side.y, 0.0));
    return NextPixels(right, down);
}

/// The footprint of a pixel on a triangle. `along` is the direction of the ray and `next` the ways to the next pixels,
/// all in the space of the corners.
fn footprint_on(a: vec3f, b: vec3f, c: vec3f, weights: vec3f, along: vec3f, next: NextPixels) -> Footprint {
    if has_textures != TEXTURES_REDUCED && has_wires == 0u {
        return place_alone(weights);
    }
    let normal = cross(b - a, c - a);
    return Footprint(
        weights,
        weights_along(a, b, c, aside_on_plane(normal, along, next.right)),
        weights_along(a, b, c, aside_on_plane(normal, along, next.down)),
    );
}

/// Half the width of a wire, and how far it fades beside that, pixels.
const WIRE_HALF: f32 = 0.5;
const WIRE_FADE: f32 = 0.8;
/// Triangles that are less wide have no wires, and those that are wider have them whole, pixels.
const WIRE_ROOM: vec2f = vec2f(1.5, 8.0);
/// The part of a colour that a wire leaves.
const WIRE_KEEPS: f32 = 0.25;

/// A colour with the edges of its triangle drawn over it. They fade where triangles are little wider than the lines:
/// they would be one dark patch.
fn wired(color: vec3f, at: Footprint) -> vec3f {
    let per_pixel = max(sqrt(at.right * at.right + at.down * at.down), vec3f(1e-9));
    let pixels = at.weights / per_pixel;
    let nearest = min(pixels.x, min(pixels.y, pixels.z));
    let line = 1.0 - smoothstep(WIRE_HALF, WIRE_HALF + WIRE_FADE, nearest);
    // About as many pixels as the triangle is wide.
    let wide = 1.0 / max(per_pixel.x, max(per_pixel.y, per_pixel.z));
    let room = smoothstep(WIRE_ROOM.x, WIRE_ROOM.y, wide);
    return color * mix(1.0, WIRE_KEEPS, line * room);
}
