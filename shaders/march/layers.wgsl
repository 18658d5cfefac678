// What stands on a ray besides a volume: the surfaces and cut faces of meshes, and objects. They are found before the
// ray is marched through the volume, which then parts its haze where they stand: so all are gathered in the order of
// their distance, exactly, whatever is see-through.
// This file defines the same functions as march/straight.wgsl.
// needs: types.wgsl bind/frame.wgsl bind/subject.wgsl march/overrides.wgsl march/seek.wgsl march/marched.wgsl
//   march/gathered.wgsl march/objects.wgsl march/mesh.wgsl march/under.wgsl subject/mesh.wgsl

/// Surfaces and cut faces of meshes on a ray.
struct Layers {
    items: array<Seen, MAX_CROSSINGS>,
    count: u32,
    /// The first that is still to be gathered.
    next: u32,
}

/// True if anything may stand on a ray.
fn has_others() -> bool {
    return true;
}

/// Finds what stands on a ray, the nearest first. Returns where the ray ends: at the latest where something hides what
/// is behind it.
fn others_on(asked: Ray, on_ray: ptr<function, ObjectsMet>, layers: ptr<function, Layers>) -> f32 {
    var ray = asked;
    (*on_ray).count = 0u;
    (*on_ray).next = 0u;
    if has_objects != 0u {
        objects_on(ray, on_ray);
        ray.t_end = end_at_object(ray, on_ray);
    }
    (*layers).count = 0u;
    (*layers).next = 0u;
    var walk = MeshWalk(unmoved_spot(ray, ray.t_start), 0u, LONGEST_STEP, 1.0, NO_TRIANGLE, true);
    var steps = 0u;
    while (*layers).count < MAX_CROSSINGS {
        let met = next_met(ray, &walk, &steps);
        if !met.is_met {
            break;
        }
        let seen = seen_of(ray, met);
        (*layers).items[(*layers).count] = seen;
        (*layers).count++;
        if seen.opacity >= 1.0 - OPAQUE {
            // As far behind it as the volume's next sample may be.
            ray.t_end = min(ray.t_end, seen.event.t + 2.0 * frame.step);
            break;
        }
    }
    return ray.t_end;
}

/// Distance of the next surface of a mesh, FAR_ON_RAY if there is none.
fn next_layer_t(layers: ptr<function, Layers>) -> f32 {
    if (*layers).next >= (*layers).count {
        return FAR_ON_RAY;
    }
    return (*layers).items[(*layers).next].event.t;
}

/// True if something that is still to be gathered stands before a place of the ray.
fn is_other_before(on_ray: ptr<function, ObjectsMet>, layers: ptr<function, Layers>, t: f32) -> bool {
    return next_layer_t(layers) < t || is_object_before(on_ray, t);
}

/// Takes what comes next, after `is_other_before`.
fn take_other(ray: Ray, on_ray: ptr<function, ObjectsMet>, layers: ptr<function, Layers>) -> Seen {
    if is_object_before(on_ray, next_layer_t(layers) + OBJECT_FIRST) {
        let next = (*on_ray).next;
        (*on_ray).next++;
        return seen_object(ray, (*on_ray).items[next]);
    }
    let next = (*layers).next;
    (*layers).next++;
    return (*layers).items[next];
}

/// Segment (0: none) that a picture shows where a ray found its surface.
fn shown_segment(found: Marched, pos: vec3f) -> u32 {
    if found.surface_what != MET_VOLUME {
        return subject.labels_before + found.segment;
    }
    return segment_behind(pos, found.surface_normal);
}

/// Label (0: none) and value of what a ray found; of a mesh its segment's label and the depth under its surface.
fn tissue_of(found: Marched, pos: vec3f, dir: vec3f) -> vec2f {
    if found.surface_what == MET_OBJECT {
        return vec2f(0.0);
    }
    if found.surface_what != MET_VOLUME && found.segment > 0u {
        return vec2f(f32(subject.labels_before + found.segment), field_at(found.surface_rest));
    }
    return tissue_under(pos, dir);
}
