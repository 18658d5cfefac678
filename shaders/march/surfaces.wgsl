// The march of a ray through a subject of meshes alone.
// needs: types.wgsl affine.wgsl bind/frame.wgsl march/overrides.wgsl march/shade.wgsl march/sample.wgsl march/seek.wgsl
//   march/surroundings.wgsl march/marched.wgsl march/gathered.wgsl march/objects.wgsl march/cover.wgsl march/mesh.wgsl
//   subject/mesh.wgsl

/// How much of the light at a tap is taken by the meshes.
fn cover_at(pos: vec3f, mask: u32) -> f32 {
    var at = Material(pos, 1.0, 0u);
    if mask != 0u && drawn_kinds != 0u {
        at = map_point(pos, mask);
    }
    return mesh_cover(at);
}

/// What shadow and occlusion take from the light of the ray's surface.
fn taken_by_bodies(pixel: vec2f, pos: vec3f, normal: vec3f, light: Lit) -> vec3f {
    let noise = pixel_noise(floor(pixel));
    let key_dir = apply_linear(frame.subject_from_view, look.key_dir.xyz);
    var closed = 0.0;
    var weights = 0.0001;
    var lit = 1.0;
    for (var k = 0u; k < occlusion_taps + shadow_taps; k++) {
        let tap = tap_at(k, pos, normal, key_dir, noise);
        let cover = cover_at(tap.pos, cell_at(tap.pos).x);
        weights += tap.weight;
        closed += tap.weight * cover;
        lit *= 1.0 - tap.shade * cover;
    }
    let around = past_objects(Surroundings(1.0 - closed / weights, lit), pos, normal, key_dir, noise);
    return taken_from(light, around);
}

/// Marches a ray. `pixel` tells its noise from that of its neighbours.
fn march(asked: Ray, pixel: vec2f) -> Marched {
    var gathered = nothing_gathered();
    var ray = asked;
    var on_ray: ObjectsMet;
    on_ray.count = 0u;
    on_ray.next = 0u;
    if has_objects != 0u {
        objects_on(ray, &on_ray);
        ray.t_end = end_at_object(ray, &on_ray);
    }
    var walk = MeshWalk(unmoved_spot(ray, ray.t_start), 0u, LONGEST_STEP, 1.0, NO_TRIANGLE, true);
    var steps = 0u;
    var met = met_nothing(walk.here, 0u);
    var crossings = 0u;
    // What comes next, a part of the subject or an object, is gathered in one place of the program.
    while gathered.clear > 0.0 && crossings <= MAX_CROSSINGS {
        if !met.is_met && crossings < MAX_CROSSINGS {
            met = next_met(ray, &walk, &steps);
        }
        var seen: Seen;
        if has_objects != 0u && is_object_before(&on_ray, select(FAR_ON_RAY, met.at.t + OBJECT_FIRST, met.is_met)) {
            seen = seen_object(ray, on_ray.items[on_ray.next]);
            on_ray.next++;
        } else {
            if !met.is_met {
                break;
            }
            seen = seen_of(ray, met);
            met.is_met = false;
            crossings++;
        }
        gather(&gathered, seen);
    }
    var color = gathered.color;
    if gathered.found.surface_t >= 0.0 {
        let pos = ray.origin + ray.dir * gathered.found.surface_t;
        color -= taken_by_bodies(pixel, pos, gathered.found.surface_normal, gathered.light);
    }
    gathered.found.color = vec4f(max(color, vec3f(0.0)), 1.0 - gathered.clear);
    return gathered.found;
}

/// Segment (0: none) that a picture shows where a ray found its surface.
fn shown_segment(found: Marched, _pos: vec3f) -> u32 {
    return found.segment;
}

/// Segment (0: none) of what a ray found, and its depth under the surface.
fn tissue_of(found: Marched, _pos: vec3f, _dir: vec3f) -> vec2f {
    if found.surface_what == MET_OBJECT {
        return vec2f(0.0);
    }
    return vec2f(f32(found.segment), field_at(found.surface_rest));
}
