// Obstacles in the light of a surface: ambient occlusion and the shadow of the key light, by taps of the opacity.
// needs: types.wgsl bind/frame.wgsl bind/subject.wgsl bind/look.wgsl displace/compose.wgsl march/overrides.wgsl
//   march/opacity.wgsl march/bodies.wgsl march/value.wgsl march/sample.wgsl march/seek.wgsl march/gathered.wgsl
//   objects.wgsl march/whole.wgsl|march/replaced.wgsl

/// How far shadows of objects reach, subject units, and how far above a surface they are looked for.
const SHADOW_REACH: f32 = 0.6;
const ABOVE_SURFACE: f32 = 0.0015;
/// How wide the key light is, as a part of its distance.
const LAMP_SIZE: f32 = 0.06;

/// Direction k of n spread over the half sphere around +z, turned by `turn`.
fn spread(k: u32, n: u32, turn: f32) -> vec3f {
    let z = 0.25 + 0.7 * (f32(k) + 0.5) / f32(n);
    let around = f32(k) * 2.39996323 + turn;
    let r = sqrt(max(0.0, 1.0 - z * z));
    return vec3f(r * cos(around), r * sin(around), z);
}

/// Even noise over the pixels (interleaved gradient noise, Jimenez 2014), 0 to 1. Depends on the pixel alone, so that
/// pictures are repeatable.
fn pixel_noise(pixel: vec2f) -> f32 {
    return fract(52.9829189 * fract(dot(pixel, vec2f(0.06711056, 0.00583715))));
}

/// The noise that hides the spacing of the taps. A finished picture has none: from sample to sample its taps turn.
fn noise_of_taps(noise: f32) -> f32 {
    return select(noise, 0.0, frame.is_finished != 0u);
}

/// Opacity of a sample in a test of light. Edges are found by the gradient at rest, without the deformation.
fn shading_opacity(found: Sample) -> f32 {
    let opacity = select(found.opacity * look.ghost, found.opacity, has_ghost == 0u);
    if has_edges == 0u {
        return opacity;
    }
    var gain = 0.0;
    var left = select(0u, 1u, found.opacity > VISIBLE);
    while left > 0u {
        left--;
        gain = edge_gain(length(quick_gradient_at(texture_from_rest(found.pos))) * look.table_scale);
        if has_bodies != 0u {
            gain = mix(gain, 1.0, body_weight(body_at(found.pos)));
        }
    }
    return opacity * gain;
}

/// A tap of the surroundings.
struct Tap {
    pos: vec3f,
    /// How much it counts for occlusion, 0 for a tap towards the key light.
    weight: f32,
    /// How much of the key light something opaque there takes, 0 for a tap of occlusion.
    shade: f32,
}

/// Tap k: first those of occlusion, then those towards the key light.
fn tap_at(k: u32, pos: vec3f, normal: vec3f, key_dir: vec3f, noise: f32) -> Tap {
    if k < occlusion_taps {
        let up = select(vec3f(1.0, 0.0, 0.0), vec3f(0.0, 1.0, 0.0), abs(normal.y) < 0.9);
        let tangent = normalize(cross(up, normal));
        let bitangent = cross(normal, tangent);
        let way = spread(k, occlusion_taps, frame.occlusion_turn + noise * 6.2831853);
        // Near taps find creases, far ones the hollow under a flap.
        let reach = mix(0.010, 0.045, f32((k * 5u) % occlusion_taps) / f32(occlusion_taps)) + subject.detail;
        let at = pos + normal * (0.5 * subject.detail) + (tangent * way.x + bitangent * way.y + normal * way.z) * reach;
        return Tap(at, way.z, 0.0);
    }
    // Closer together near the surface, where a shadow has its edge.
    let part = (f32(k - occlusion_taps) + 0.3 + 0.7 * fract(frame.first_step + noise)) / f32(shadow_taps);
    var lamp = key_dir;
    if has_lamp != 0u {
        // Each tap goes to another place of the lamp: with the noise of pixels and samples the shadow is soft.
        let turn = 6.2831853 * noise + frame.occlusion_turn + 2.39996323 * f32(k);
        let beside = look.lamp * sqrt(fract(frame.first_step + noise + 0.618034 * f32(k)));
        lamp += beside * vec3f(cos(turn), sin(turn), cos(1.7 * turn));
    }
    let at = pos + normal * (1.5 * subject.detail) + lamp * (0.006 + 0.30 * part * part);
    // Farther occluders dim less: a large soft lamp.
    return Tap(at, 0.0, mix(look.shade_near, look.shade_far, part));
}

/// Taps of the opacity in the deformed space around a surface. `noise` tells the pixel from its neighbours.
fn surroundings_of(pos: vec3f, normal: vec3f, key_dir: vec3f, noise: f32) -> Surroundings {
    let tap_noise = noise_of_taps(noise);
    var closed = 0.0;
    var weights = 0.0001;
    var open = 1.0;
    // Taps that no template reaches are sampled plainly, the others in a loop of their own: where there are none, it
    // ends at once.
    var mapped = 0u;
    for (var k = 0u; k < occlusion_taps + shadow_taps; k++) {
        let tap = tap_at(k, pos, normal, key_dir, tap_noise);
        let is_mapped = cell_at(tap.pos).x != 0u && drawn_kinds != 0u;
        mapped |= select(0u, 1u << k, is_mapped);
        let opacity = select(shading_opacity(sample_unmoved(tap.pos)), 0.0, is_mapped);
        let cover = select(cover_beside(Material(tap.pos, 1.0, 0u)), 0.0, is_mapped);
        weights += tap.weight;
        closed += tap.weight * max(smoothstep(0.02, 0.5, opacity), cover);
        open *= 1.0 - tap.shade * max(smoothstep(0.02, 0.6, opacity), cover);
    }
    if drawn_kinds != 0u {
        while mapped != 0u {
            let tap = tap_at(firstTrailingBit(mapped), pos, normal, key_dir, tap_noise);
            mapped &= mapped - 1u;
            let at = map_point(tap.pos, cell_at(tap.pos).x);
            let opacity = shading_opacity(sample_mapped(at));
            let cover = cover_beside(at);
            closed += tap.weight * max(smoothstep(0.02, 0.5, opacity), cover);
            open *= 1.0 - tap.shade * max(smoothstep(0.02, 0.6, opacity), cover);
        }
    }
    return past_objects(Surroundings(1.0 - closed / weights, open), pos, normal, key_dir, noise);
}

/// What is left of openness and key light where objects stand about.
fn past_objects(around: Surroundings, pos: vec3f, normal: vec3f, key_dir: vec3f, noise: f32) -> Surroundings {
    if has_objects == 0u {
        return around;
    }
    let above = pos + normal * ABOVE_SURFACE;
    // A ray to another place of the lamp in each pixel and sample makes its shadow soft. Without the noise of pixels
    // the few samples of a picture would be seen as so many edges.
    let turn = 6.2831853 * noise + frame.occlusion_turn;
    let lamp = key_dir + LAMP_SIZE * sqrt(fract(frame.first_step + noise)) * vec3f(cos(turn), sin(turn), cos(1.7 * turn));
    var closed = 0.0;
    var weights = 0.0001;
    var shade = 0.0;
    // The last turn is the shadow: the search stands in one place of the program.
    for (var k = 0u; k <= occlusion_taps; k++) {
        let tap = tap_at(min(k, max(occlusion_taps, 1u) - 1u), pos, normal, key_dir, noise_of_taps(noise));
        let is_shadow = k == occlusion_taps;
        let cover = object_cover(above, select(tap.pos - above, SHADOW_REACH * lamp, is_shadow));
        let weight = select(tap.weight, 0.0, is_shadow);
        weights += weight;
        closed += weight * cover;
        shade = 0.75 * cover;
    }
    return Surroundings(around.openness * (1.0 - closed / weights), around.key_light * (1.0 - shade));
}
