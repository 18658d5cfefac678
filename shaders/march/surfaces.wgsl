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
    let key_dir = apply_linear(frame.subject_from_view, KEY_DIR);
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

/// Marches a ray in a scene with objects.
fn march_with_objects(asked: Ray, pixel: vec2f) -> Marched {
    var gathered = nothing_gathered();
    var ray = asked;
    var on_ray: ObjectsMet;
    objects_on(ray, &on_ray);
    ray.t_end = end_at_object(ray, &on_ray);
    var walk = MeshWalk(unmoved_spot(ray, ray.t_start), 0u, LONGEST_STEP, 1.0, NO_TRIANGLE);
    var steps = 0u;
    var met = met_at_start(ray);
    var crossings = 0u;
    // What comes next, a part of the subject or an object, is gathered in one place of the program.
    while gathered.clear > 0.0 && crossings <= MAX_CROSSINGS {
        if !met.is_met && crossings < MAX_CROSSINGS {
            met = next_met(ray, &walk, &steps);
        }
        var seen: Seen;
        if is_object_before(&on_ray, select(FAR_ON_RAY, met.at.t + OBJECT_FIRST, met.is_met)) {
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
        color -= taken_by_bodies(pixel, ray.origin + ray.dir * gathered.found.surface_t, gathered.found.surface_normal, gathered.light);
    }
    gathered.found.color = vec4f(max(color, vec3f(0.0)), 1.0 - gathered.clear);
    return gathered.found;
}

/// Marches a ray in a scene without objects. This stands by itself: the software GPU of browsers does not end compiling
/// the march with objects where templates act.
fn march_alone(ray: Ray, pixel: vec2f) -> Marched {
    var result: Marched;
    result.surface_t = -1.0;
    var walk = MeshWalk(unmoved_spot(ray, ray.t_start), 0u, LONGEST_STEP, 1.0, NO_TRIANGLE);
    var steps = 0u;
    var clear = 1.0;
    var color = vec3f(0.0);
    var surface_light = Lit(vec3f(0.0), vec3f(0.0));
    var met = met_at_start(ray);
    for (var crossing = 0u; crossing < MAX_CROSSINGS; crossing++) {
        if !met.is_met {
            met = next_met(ray, &walk, &steps);
        }
        if !met.is_met {
            break;
        }
        let look_here = look_of(ray, met);
        let weight = clear * look_here.opacity;
        let normal_in_view = apply_transposed(frame.subject_from_view, look_here.normal);
        let light = shade_surface(look_here.albedo, normal_in_view, -ray.dir_in_view, look_here.gloss);
        color += weight * (light.key + light.ambient);
        if result.surface_t < 0.0 && weight > SURFACE_SHARE * (0.25 + 0.75 * clear) {
            result.surface_t = met.at.t;
            result.surface_normal = look_here.normal;
            result.surface_rest = met.at.pos;
            result.segment = met.segment;
            result.surface_what = MET_SURFACE;
            surface_light = Lit(light.key * weight, light.ambient * weight);
        }
        clear *= 1.0 - look_here.opacity;
        if clear < 0.5 && result.event.what == MET_NOTHING {
            result.event = event_of(met, look_here);
        }
        if clear < OPAQUE {
            clear = 0.0;
            break;
        }
        met.is_met = false;
    }
    if result.surface_t >= 0.0 {
        let pos = ray.origin + ray.dir * result.surface_t;
        color -= taken_by_bodies(pixel, pos, result.surface_normal, surface_light);
    }
    result.color = vec4f(max(color, vec3f(0.0)), 1.0 - clear);
    return result;
}

/// Marches a ray. `pixel` tells its noise from that of its neighbours.
fn march(ray: Ray, pixel: vec2f) -> Marched {
    var found: Marched;
    if has_objects != 0u {
        found = march_with_objects(ray, pixel);
    } else {
        found = march_alone(ray, pixel);
    }
    return found;
}

/// Segment (0: none) of what a ray found, and its depth under the surface.
fn tissue_of(found: Marched, _pos: vec3f, _dir: vec3f) -> vec2f {
    if found.surface_what == MET_OBJECT {
        return vec2f(0.0);
    }
    return vec2f(f32(found.segment), field_at(found.surface_rest));
}
