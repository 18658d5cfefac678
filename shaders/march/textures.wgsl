// Where the pixels of the picture lie on a triangle that a ray meets: the Jacobian takes a pixel to rest space, so that
// a texture under templates takes the copy that fits what is seen of it.
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
    if has_textures != TEXTURES_REDUCED {
        return place_alone(weights);
    }
    let normal = cross(b - a, c - a);
    return Footprint(
        weights,
        weights_along(a, b, c, aside_on_plane(normal, along, next.right)),
        weights_along(a, b, c, aside_on_plane(normal, along, next.down)),
    );
}
