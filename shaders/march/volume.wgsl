// The march of a ray through a scan: at every sample it finds where the material came from.
// Source: Correa, section 4.5 (pipeline, normals, compositing) and section 7.5.2 (adaptive sampling).
//
//   eye --o--o--o-----[empty cells]-----o--o-x====      o sample, x crossing found by bisection, = opaque
//
// Differs from the source: formulas instead of displacement textures; one pass over the ray instead of slices;
// crossings of A = 0 and of jumps in opacity are found by bisection; shadow and ambient occlusion.
//
// Written for devices that run both sides of every branch (software rasterisers): work is put behind loops that end
// early, not behind `if`; work that is done once per ray (occlusion, shadow) comes after the loop.
// needs: types.wgsl affine.wgsl bind/frame.wgsl bind/subject.wgsl bind/look.wgsl displace/compose.wgsl
//   march/overrides.wgsl march/value.wgsl march/opacity.wgsl march/shade.wgsl march/sample.wgsl march/seek.wgsl
//   march/refine.wgsl march/jacobian.wgsl march/surface.wgsl march/edges.wgsl march/color.wgsl march/surroundings.wgsl
//   march/marched.wgsl march/plain.wgsl|march/align.wgsl|march/baked.wgsl

/// Transmittance at which a ray ends: below half a level of 255.
const OPAQUE: f32 = 0.002;
/// Events on one ray at most; a guard, a ray of 1.8 units at the finest step has fewer samples.
const MAX_EVENTS: u32 = 4096u;
/// Contribution that makes an event the ray's surface: occlusion, shadow and picking are for that one.
const SURFACE_WEIGHT: f32 = 0.3;

/// Light of the ray's surface, which shadow and occlusion act on, and how far above it they are looked for.
struct SurfaceLight {
    key: vec3f,
    ambient: vec3f,
    lift: f32,
}

/// Light that a stretch sends to the eye, premultiplied by its share (`weight`). A cut face is wet but flat: half the
/// shine.
fn light_of(ray: Ray, albedo: vec3f, surface: Surface, weight: f32) -> Lit {
    let normal_in_view = apply_transposed(frame.subject_from_view, surface.normal);
    let specular = look.specular * (1.0 - 0.5 * surface.cut_weight);
    let solid = shade_surface(albedo, normal_in_view, -ray.dir_in_view, specular);
    let haze = shade_medium(albedo);
    return Lit(
        mix(haze.key, solid.key, surface.surfaceness) * weight,
        mix(haze.ambient, solid.ambient, surface.surfaceness) * weight,
    );
}

/// What shadow and occlusion take from the light of the ray's surface.
fn taken_by_surroundings(pixel: vec2f, pos: vec3f, normal: vec3f, light: SurfaceLight) -> vec3f {
    var above = pos;
    if KEEPS_TISSUE {
        above += normal * light.lift;
    }
    let noise = pixel_noise(floor(pixel));
    let key_dir = apply_linear(frame.subject_from_view, KEY_DIR);
    let around = surroundings_of(above, normal, key_dir, noise);
    let open = around.openness;
    let lit = around.key_light;
    return light.key * (1.0 - lit) + light.ambient * (0.8 * (1.0 - open)) + light.key * lit * (0.25 * (1.0 - open));
}

/// Marches a ray. `pixel` tells its noise from that of its neighbours.
fn march(ray: Ray, pixel: vec2f) -> Marched {
    var result: Marched;
    result.color = vec4f(0.0);
    result.surface_t = -1.0;
    var walk = walk_along(ray);
    // Share of its opacity that the sample before keeps.
    var gain_before = 1.0;
    var clear = 1.0;
    var color = vec3f(0.0);
    var surface_light = SurfaceLight(vec3f(0.0), vec3f(0.0), 0.0);
    for (var event = 0u; event < MAX_EVENTS; event++) {
        if !seek(ray, &walk) {
            break;
        }
        let crossing = refine(ray, &walk);
        let edge = crossing.edge;
        let map = differential_at(ray.origin + ray.dir * crossing.t_shade, ray.forward, edge, crossing.mask);
        let uvw = texture_from_rest(edge.pos);
        let cut = cut_at(uvw, map, -ray.dir);
        let surface = surface_at(edge, uvw, map, cut, -ray.dir);

        // Opacity over the way since the sample before: up to the crossing as there, behind it as here.
        let gains = gains_of(gain_before, walk.here, crossing, map, surface, cut);
        let exponent = opacity_exponent(map.jacobian, ray.dir);
        let passed = transmittance(walk.before.opacity * gains.before, (crossing.t_edge - walk.t_before) * exponent)
            * transmittance(walk.here.opacity * gains.behind, (walk.t - crossing.t_edge) * exponent);
        let weight = clear * (1.0 - passed);
        gain_before = gains.here;

        let albedo = albedo_of(edge, surface);
        let light = light_of(ray, albedo, surface, weight);
        color += light.key + light.ambient;
        if result.surface_t < 0.0 && weight > SURFACE_WEIGHT * (0.25 + 0.75 * clear) {
            result.surface_t = crossing.t_shade;
            result.surface_normal = surface.normal;
            result.surface_rest = edge.pos;
            surface_light = SurfaceLight(light.key, light.ambient, surface.lift);
        }

        clear *= passed;
        if clear < 0.5 && result.event.what == MET_NOTHING {
            result.event = Event(crossing.t_shade, MET_VOLUME, 0u, surface.normal, edge.pos, albedo);
        }
        if clear < OPAQUE {
            clear = 0.0;
            break;
        }
        walk.before = walk.here;
        walk.t_before = walk.t;
        walk.mask_before = walk.mask;
        walk.t += frame.step / clamp(stretch_along(map.jacobian, ray.dir), 0.6, 3.0);
    }
    // Once per ray: what stands in the light of its surface.
    if result.surface_t >= 0.0 {
        let pos = ray.origin + ray.dir * result.surface_t;
        color -= taken_by_surroundings(pixel, pos, result.surface_normal, surface_light);
    }
    result.color = vec4f(max(color, vec3f(0.0)), 1.0 - clear);
    return result;
}

/// Segment (0: none) and value a little deeper along a ray than its surface, on which half of the voxels are air.
fn tissue_under(pos: vec3f, dir: vec3f) -> vec2f {
    var segment = 0.0;
    var value = 0.0;
    for (var k = 1; k <= 4; k++) {
        let inside = map_point(pos + dir * (f32(k) * 0.5 * subject.detail), 0xffffffffu).pos;
        let uvw = apply_affine(subject.label_from_rest, inside);
        let voxel = clamp(vec3i(floor(uvw * subject.label_dims.xyz)), vec3i(0), vec3i(subject.label_dims.xyz) - 1);
        segment = f32(textureLoad(labels, voxel, 0).x);
        value = subject.value_low + subject.value_range * texel_at(texture_from_rest(inside));
        if segment > 0.0 || (k >= 2 && subject.has_labels == 0u) {
            break;
        }
    }
    return vec2f(segment, value);
}

/// Segment (0: none) and value of what a ray found.
fn tissue_of(_found: Marched, pos: vec3f, dir: vec3f) -> vec2f {
    return tissue_under(pos, dir);
}
