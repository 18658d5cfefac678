// Objects of the scene on a ray: straight lines through triangles that no template moves, the nearest first.
// needs: types.wgsl affine.wgsl triangles.wgsl objects.wgsl bind/frame.wgsl bind/objects.wgsl march/seek.wgsl
//   march/shade.wgsl march/marched.wgsl march/gathered.wgsl march/textures.wgsl textures.wgsl

/// Crossings of objects that count on one ray.
const MAX_OBJECT_CROSSINGS: u32 = 16u;
/// Farther than anything on a ray, subject units.
const FAR_ON_RAY: f32 = 1e4;
/// A surface of the subject so little in front of an object's counts as behind it, subject units.
const OBJECT_FIRST: f32 = 1e-4;
/// The next crossing is looked for so far behind the last one, subject units.
const BEHIND_CROSSING: f32 = 1e-5;

/// The objects on a ray, the nearest first.
struct ObjectsMet {
    items: array<ObjectCrossing, MAX_OBJECT_CROSSINGS>,
    count: u32,
    /// The first that is still to be gathered.
    next: u32,
}

/// Finds the objects on a ray, as far as they are seen, before the ray is marched. The search stands in one place of
/// the program: software GPUs compile it anew for each place.
fn objects_on(ray: Ray, met: ptr<function, ObjectsMet>) {
    (*met).count = 0u;
    (*met).next = 0u;
    var after = 0.0;
    while (*met).count < MAX_OBJECT_CROSSINGS {
        let found = object_on(ray.origin, ray.dir, after, FAR_ON_RAY);
        if found.object == NO_OBJECT {
            break;
        }
        (*met).items[(*met).count] = found;
        (*met).count++;
        after = found.part + BEHIND_CROSSING;
        if objects.items[found.object].opacity >= 1.0 - OPAQUE {
            break;
        }
    }
}

/// Where a ray ends at an object that hides what is behind it.
fn end_at_object(ray: Ray, met: ptr<function, ObjectsMet>) -> f32 {
    if (*met).count == 0u {
        return ray.t_end;
    }
    let last = (*met).items[(*met).count - 1u];
    if objects.items[last.object].opacity < 1.0 - OPAQUE {
        return ray.t_end;
    }
    return min(ray.t_end, last.part + 2.0 * frame.step);
}

/// True if an object that is still to be gathered lies before a place of the ray.
fn is_object_before(met: ptr<function, ObjectsMet>, t: f32) -> bool {
    return (*met).next < (*met).count && (*met).items[min((*met).next, MAX_OBJECT_CROSSINGS - 1u)].part < t;
}

/// Where the pixel lies on the triangle of an object.
fn footprint_of_object(ray: Ray, met: ObjectCrossing) -> Footprint {
    let map = objects.items[met.object].object_from_subject;
    let next = next_pixels(ray, met.part);
    return footprint_on(
        object_corner(met.object, met.triangle, 0u),
        object_corner(met.object, met.triangle, 1u),
        object_corner(met.object, met.triangle, 2u),
        met.weights,
        apply_linear(map, ray.dir),
        NextPixels(apply_linear(map, next.right), apply_linear(map, next.down)),
    );
}

/// How an object looks where a ray meets it.
fn seen_object(ray: Ray, met: ObjectCrossing) -> Seen {
    let at = objects.items[met.object].triangles_at + 4u * met.triangle;
    let a = object_corner(met.object, met.triangle, 0u);
    let plane = cross(object_corner(met.object, met.triangle, 1u) - a, object_corner(met.object, met.triangle, 2u) - a);
    var smooth_normal = vec3f(0.0);
    for (var corner = 0u; corner < 3u; corner++) {
        smooth_normal += from_octahedron(unpack2x16snorm(object_texel(at + corner).w)) * met.weights[corner];
    }
    let map = objects.items[met.object].object_from_subject;
    let face = normalize(apply_transposed(map, plane));
    let normal = normal_to_eye(apply_transposed(map, smooth_normal), face, ray.dir);
    let inside = objects.items[met.object].inside;
    let outside = object_color(met, footprint_of_object(ray, met));
    let back = select(INSIDE_SHARE * outside, inside.rgb, inside.a >= 0.0);
    let albedo = select(back, outside, met.is_front);
    let normal_in_view = apply_transposed(frame.subject_from_view, normal);
    let light = shade_surface(albedo, normal_in_view, -ray.dir_in_view, objects.items[met.object].gloss);
    let plane_normal = select(face, -face, dot(face, ray.dir) > 0.0);
    let place = ray.origin + ray.dir * met.part;
    let event = Event(met.part, MET_OBJECT, met.object + 1u, plane_normal, place, albedo);
    return Seen(event, normal, light, objects.items[met.object].opacity, 0.0);
}
