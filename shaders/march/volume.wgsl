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
//   march/overrides.wgsl march/value.wgsl march/opacity.wgsl march/ghost.wgsl march/bodies.wgsl march/shade.wgsl
//   march/sample.wgsl march/seek.wgsl march/refine.wgsl march/jacobian.wgsl march/surface.wgsl march/edges.wgsl
//   march/color.wgsl march/surroundings.wgsl
//   march/marched.wgsl march/gathered.wgsl march/objects.wgsl march/straight.wgsl|march/layers.wgsl
//   march/plain.wgsl|march/align.wgsl|march/baked.wgsl

/// Events on one ray at most; a guard, a ray of 1.8 units at the finest step has fewer samples.
const MAX_EVENTS: u32 = 4096u;
/// Light that a stretch would send to the eye if it were opaque. A cut face is wet but flat: half the shine.
fn light_of(ray: Ray, albedo: vec3f, surface: Surface) -> Lit {
    let normal_in_view = apply_transposed(frame.subject_from_view, surface.normal);
    let specular = look.specular * (1.0 - 0.5 * surface.cut_weight);
    let solid = shade_surface(albedo, normal_in_view, -ray.dir_in_view, specular);
    let haze = shade_medium(albedo);
    return Lit(mix(haze.key, solid.key, surface.surfaceness), mix(haze.ambient, solid.ambient, surface.surfaceness));
}

/// What shadow and occlusion take from the light of the ray's surface.
fn taken_by_surroundings(pixel: vec2f, gathered: Gathered, pos: vec3f) -> vec3f {
    let normal = gathered.found.surface_normal;
    var above = pos;
    if KEEPS_TISSUE {
        above += normal * gathered.lift;
    }
    let noise = pixel_noise(floor(pixel));
    let key_dir = apply_linear(frame.subject_from_view, look.key_dir.xyz);
    return taken_from(gathered.light, surroundings_of(above, normal, key_dir, noise));
}

/// The part of its opacity that tissue of a scan keeps as a ghost.
fn ghost_share(edge: Sample, surface: Surface, to_eye: vec3f) -> f32 {
    let surfaceness = max(smoothstep(RIM_NONE, RIM_FULL, surface.steepness / max(look.table_scale, 1.0)), surface.cut_weight);
    let keeps = ghost_keeps(surfaceness, surface.normal, to_eye);
    if has_bodies == 0u {
        return keeps;
    }
    return mix(keeps, 1.0, body_weight(body_at(edge.pos)));
}

/// A stretch of a ray between two samples: opaque as at the first up to the crossing, as at the second behind it.
struct Stretch {
    /// Distance of the crossing from the eye.
    t_edge: f32,
    /// Opacities of 0.01 subject units before and behind it.
    before: f32,
    behind: f32,
    /// How opacity follows the deformation.
    exponent: f32,
}

/// The light that a part of a stretch lets through.
fn passed_between(stretch: Stretch, t_from: f32, t_to: f32) -> f32 {
    let before = max(min(t_to, stretch.t_edge) - t_from, 0.0);
    let behind = max(t_to - max(t_from, stretch.t_edge), 0.0);
    return transmittance(stretch.before, before * stretch.exponent)
        * transmittance(stretch.behind, behind * stretch.exponent);
}

/// Marches a ray. `pixel` tells its noise from that of its neighbours.
fn march(asked: Ray, pixel: vec2f) -> Marched {
    var gathered = nothing_gathered();
    var ray = asked;
    var on_ray: ObjectsMet;
    var layers: Layers;
    if has_others() {
        ray.t_end = others_on(ray, &on_ray, &layers);
    }
    var walk = walk_along(ray);
    // Share of its opacity that the sample before keeps.
    var gain_before = 1.0;
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

        var gains = gains_of(gain_before, walk.here, crossing, map, surface, cut);
        if has_ghost != 0u {
            let keeps = select(ghost_share(edge, surface, -ray.dir), 1.0, is_kept_by_any(edge.pos));
            gains.behind *= keeps;
            gains.here *= keeps;
        }
        let exponent = opacity_exponent(map.jacobian, ray.dir);
        // Tissue that thins out behind a cut is as opaque as at the cut, wherever in it the sample lies.
        let at_edge = select(0.0, crossing.edge.opacity, crossing.is_jump && crossing.is_rising);
        let stretch = Stretch(
            crossing.t_edge,
            walk.before.opacity * gains.before,
            max(walk.here.opacity, at_edge) * gains.behind,
            exponent,
        );
        gain_before = gains.here;

        let albedo = albedo_of(edge, surface);
        var seen: Seen;
        seen.event = Event(crossing.t_shade, MET_VOLUME, 0u, surface.normal, edge.pos, albedo);
        seen.normal = surface.normal;
        seen.light = light_of(ray, albedo, surface);
        seen.lift = surface.lift;
        var t_from = walk.t_before;
        if has_others() {
            // Objects and meshes part the stretch in which they stand.
            while is_other_before(&on_ray, &layers, walk.t) {
                let other = take_other(ray, &on_ray, &layers);
                let is_at_edge = abs(other.event.t - crossing.t_edge) < OBJECT_FIRST;
                let t_other = max(select(other.event.t, crossing.t_edge, is_at_edge), t_from);
                seen.opacity = 1.0 - passed_between(stretch, t_from, t_other);
                gather(&gathered, seen);
                gather(&gathered, other);
                t_from = t_other;
            }
        }
        seen.opacity = 1.0 - passed_between(stretch, t_from, walk.t);
        gather(&gathered, seen);
        if gathered.clear == 0.0 {
            break;
        }
        walk.before = walk.here;
        walk.t_before = walk.t;
        walk.mask_before = walk.mask;
        walk.t += frame.step / clamp(stretch_along(map.jacobian, ray.dir), 0.6, 3.0);
    }
    if has_others() {
        while gathered.clear > 0.0 && is_other_before(&on_ray, &layers, FAR_ON_RAY) {
            gather(&gathered, take_other(ray, &on_ray, &layers));
        }
    }
    // Once per ray: what stands in the light of its surface.
    var color = gathered.color;
    if gathered.found.surface_t >= 0.0 {
        color -= taken_by_surroundings(pixel, gathered, ray.origin + ray.dir * gathered.found.surface_t);
    }
    gathered.found.color = vec4f(max(color, vec3f(0.0)), 1.0 - gathered.clear);
    return gathered.found;
}
