// What stands on a ray besides a volume: objects alone.
// This file defines the same functions as march/layers.wgsl.
// needs: march/overrides.wgsl march/seek.wgsl march/marched.wgsl march/gathered.wgsl march/objects.wgsl
//   march/under.wgsl

/// Parts of the subject on a ray besides the volume: there are none.
struct Layers {
    count: u32,
}

/// True if anything may stand on a ray.
fn has_others() -> bool {
    return has_objects != 0u;
}

/// Finds what stands on a ray, the nearest first. Returns where the ray ends: at the latest where something hides what
/// is behind it.
fn others_on(ray: Ray, on_ray: ptr<function, ObjectsMet>, _layers: ptr<function, Layers>) -> f32 {
    objects_on(ray, on_ray);
    return end_at_object(ray, on_ray);
}

/// True if something that is still to be gathered stands before a place of the ray.
fn is_other_before(on_ray: ptr<function, ObjectsMet>, _layers: ptr<function, Layers>, t: f32) -> bool {
    return is_object_before(on_ray, t);
}

/// Takes what comes next, after `is_other_before`.
fn take_other(ray: Ray, on_ray: ptr<function, ObjectsMet>, _layers: ptr<function, Layers>) -> Seen {
    let next = (*on_ray).next;
    (*on_ray).next++;
    return seen_object(ray, (*on_ray).items[next]);
}

/// Segment (0: none) that a picture shows where a ray found its surface.
fn shown_segment(found: Marched, pos: vec3f) -> u32 {
    return segment_behind(pos, found.surface_normal);
}

/// Segment (0: none) and value of what a ray found.
fn tissue_of(found: Marched, pos: vec3f, dir: vec3f) -> vec2f {
    if found.surface_what == MET_OBJECT {
        return vec2f(0.0);
    }
    return tissue_under(pos, dir);
}
