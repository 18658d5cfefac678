// Objects of the scene on a ray: straight lines through triangles that no template moves, the nearest first.
// needs: types.wgsl affine.wgsl triangles.wgsl bind/frame.wgsl bind/objects.wgsl march/overrides.wgsl march/seek.wgsl
//   march/shade.wgsl march/marched.wgsl march/gathered.wgsl

/// Stands for no object.
const NO_OBJECT: u32 = 0xffffffffu;
/// Crossings of objects that count on one ray.
const MAX_OBJECT_CROSSINGS: u32 = 16u;
/// Farther than anything on a ray, subject units.
const FAR_ON_RAY: f32 = 1e4;
/// A surface of the subject so little in front of an object's counts as behind it, subject units.
const OBJECT_FIRST: f32 = 1e-4;
/// The next crossing is looked for so far behind the last one, subject units.
const BEHIND_CROSSING: f32 = 1e-5;
/// How far shadows of objects reach, subject units, and how far above a surface they are looked for.
const SHADOW_REACH: f32 = 0.6;
const ABOVE_SURFACE: f32 = 0.0015;
/// How wide the key light is, as a part of its distance.
const LAMP_SIZE: f32 = 0.06;

/// Where a line meets an object.
struct ObjectCrossing {
    /// Index of the object, or NO_OBJECT.
    object: u32,
    triangle: u32,
    /// Where on the way; 1 is its end.
    part: f32,
    /// Weights of the corners.
    weights: vec3f,
    is_front: bool,
}

fn object_texel(index: u32) -> vec4u {
    return textureLoad(object_texels, vec2u(index % MESH_ROW, index / MESH_ROW), 0);
}

/// The corner of an object's triangle, the object's own space.
fn object_corner(object: u32, triangle: u32, corner: u32) -> vec3f {
    return bitcast<vec3f>(object_texel(objects.items[object].triangles_at + 4u * triangle + corner).xyz);
}

/// The first place on a way, from a part of it to another, at which an object is met.
fn object_on(origin: vec3f, way: vec3f, after: f32, until: f32) -> ObjectCrossing {
    var found = ObjectCrossing(NO_OBJECT, NO_TRIANGLE, until, vec3f(0.0), false);
    for (var k = 0u; k < objects.count; k++) {
        let map = objects.items[k].object_from_subject;
        let along = apply_linear(map, way);
        let inverse_along = inverse_of(along);
        let nodes_at = objects.items[k].nodes_at;
        let low = bitcast<vec3f>(object_texel(nodes_at).xyz);
        let high = bitcast<vec3f>(object_texel(nodes_at + 1u).xyz);
        let from_after = apply_affine(map, origin + way * after);
        let span = part_in_box(from_after, inverse_along, low, high, found.part - after);
        // From where the line enters the box: numbers far away from a small object are too coarse.
        let first = after + span.x;
        let start = from_after + along * span.x;
        var node = select(objects.items[k].node_count, 0u, span.x <= span.y);
        while node < objects.items[k].node_count {
            let least = object_texel(nodes_at + 2u * node);
            let most = object_texel(nodes_at + 2u * node + 1u);
            let inner = part_in_box(start, inverse_along, bitcast<vec3f>(least.xyz), bitcast<vec3f>(most.xyz), found.part - first);
            let count = most.w & 15u;
            let is_met = inner.x <= inner.y;
            var left = select(0u, count, is_met);
            var triangle = most.w >> 4u;
            while left > 0u {
                left--;
                let crossing = line_crossing(
                    object_corner(k, triangle, 0u) - start,
                    object_corner(k, triangle, 1u) - start,
                    object_corner(k, triangle, 2u) - start,
                    along,
                );
                // What closes the holes of an open object is not seen.
                let owner = object_texel(objects.items[k].triangles_at + 4u * triangle + 3u).w & 255u;
                if crossing.is_met && first + crossing.part < found.part && owner < LID {
                    found = ObjectCrossing(k, triangle, first + crossing.part, crossing.weights, crossing.is_front);
                }
                triangle++;
            }
            node = select(least.w, node + 1u, is_met && count == 0u);
        }
    }
    return found;
}

/// The first object on a ray.
fn first_object(ray: Ray) -> ObjectCrossing {
    return object_on(ray.origin, ray.dir, 0.0, FAR_ON_RAY);
}

/// The next object on a ray.
fn object_behind(ray: Ray, last: ObjectCrossing) -> ObjectCrossing {
    return object_on(ray.origin, ray.dir, last.part + BEHIND_CROSSING, FAR_ON_RAY);
}

/// Where a ray ends at an object that hides what is behind it.
fn end_at_object(ray: Ray, first: ObjectCrossing) -> f32 {
    if first.object == NO_OBJECT || objects.items[first.object].opacity < 1.0 - OPAQUE {
        return ray.t_end;
    }
    return min(ray.t_end, first.part + 2.0 * frame.step);
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
    let color = objects.items[met.object].color;
    let inside = objects.items[met.object].inside;
    let outside = select(color_between(object_texel(at + 3u).xyz, met.weights), color.rgb, color.a >= 0.0);
    let back = select(INSIDE_SHARE * outside, inside.rgb, inside.a >= 0.0);
    let albedo = select(back, outside, met.is_front);
    let normal_in_view = apply_transposed(frame.subject_from_view, normal);
    let light = shade_surface(albedo, normal_in_view, -ray.dir_in_view, objects.items[met.object].gloss);
    let plane_normal = select(face, -face, dot(face, ray.dir) > 0.0);
    let place = ray.origin + ray.dir * met.part;
    let event = Event(met.part, MET_OBJECT, met.object + 1u, plane_normal, place, albedo);
    return Seen(event, normal, light, objects.items[met.object].opacity, 0.0);
}

/// How much of the light along a way objects take.
fn object_cover(origin: vec3f, way: vec3f) -> f32 {
    let met = object_on(origin, way, 0.0, 1.0);
    if met.object == NO_OBJECT {
        return 0.0;
    }
    return objects.items[met.object].opacity * mix(1.0, 0.4, met.part);
}
