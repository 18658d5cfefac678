// The picture: marches the deformed space along each pixel's ray and asks at every sample where it came from.
// Fragment shaders, uniform buffers and sampled textures only, so that WebGL2 could follow.
// Source: Correa, section 4.5 (pipeline, normals, compositing) and section 7.5.2 (adaptive sampling).
//
//   eye --o--o--o-----[empty cells]-----o--o-x====      o sample, x crossing found by bisection, = opaque
//
// Differs from the source: formulas instead of displacement textures; one pass over the ray instead of slices; crossings of
// A = 0 and of jumps in opacity are found by bisection; shadow and ambient occlusion.
//
// Written for devices that run both sides of every branch (software rasterisers): work is put behind loops that end early,
// not behind `if`; what is needed once per ray (occlusion, shadow) comes after the loop.
// needs: types.wgsl bind/frame.wgsl bind/subject.wgsl bind/templates.wgsl bind/look.wgsl bind/bodies.wgsl bind/grid.wgsl march/ray.wgsl march/value.wgsl march/shade.wgsl displace/compose.wgsl march/plain.wgsl|march/align.wgsl|march/baked.wgsl

/// 1 if the subject has labels; without them the look-ups are compiled away.
override has_labels: u32 = 1u;
/// 1 if there is a grid to leap with.
override has_grid: u32 = 1u;
/// 1 if opacity follows the gradient.
override has_edges: u32 = 0u;
/// 1 if segments are drawn as bodies of their own.
override has_bodies: u32 = 0u;
/// Taps of ambient occlusion, once per ray. More are smoother and cost a map and two texture reads each.
override occlusion_taps: u32 = 8u;
/// Taps towards the key light, once per ray.
override shadow_taps: u32 = 10u;

/// Opacity of 0.01 units below which a sample is nothing.
const VISIBLE: f32 = 0.0005;
/// A change of opacity from sample to sample that counts as a crossing, to be found exactly.
const JUMP: f32 = 0.04;
/// Halvings of a step to find a crossing: 2^-7 of a step is far below a pixel.
const BISECTIONS: u32 = 7u;
/// Transmittance at which a ray ends: below half a level of 255.
const OPAQUE: f32 = 0.002;
/// Opacity is said for this length, subject units (spec/contract.md, "Transfer functions").
const OPACITY_LENGTH: f32 = 0.01;
/// How far inside a surface its segment is looked up, voxels, if the voxels around it belong to none: where tissue fills less
/// than half of a voxel, its label is air. The nearest segment counts, for skin is thin.
const TINT_DEPTH: f32 = 1.9;
/// Steepness of the value (of the whole transfer table, per voxel) from which on an edge shows, and at which it is as opaque as the table says. The
/// scan's noise lies below the first.
const EDGE_NONE: f32 = 0.006;
const EDGE_FULL: f32 = 0.09;
/// Reaches of the central differences that the normal of a body is the mean of, voxels. Labels are yes or no, so they are wider than the
/// scan's; a layer thinner than the far one loses some of its relief.
const BODY_NEAR: f32 = 1.3;
const BODY_FAR: f32 = 3.4;
/// Columns of the Jacobian longer than this come from a jump of the map, not from tissue.
const MAX_STRETCH: f32 = 12.0;
/// A continuity steeper than this jumps at a rest face (from 0.25 to 1 at a hole's, say), which is no cut. Cuts have slopes of one over the
/// template's size, a peeler's at most a hundred times that.
const MAX_SLOPE: f32 = 250.0;
/// Events on one ray at most; a guard, a ray of 1.8 units at the finest step has fewer samples.
const MAX_EVENTS: u32 = 4096u;
/// Contribution that makes an event the ray's surface: occlusion, shadow and picking are for that one.
const SURFACE_WEIGHT: f32 = 0.3;

/// The object at one point of the deformed space.
struct Sample {
    /// Rest space.
    pos: vec3f,
    /// Normalised value, 0 to 1.
    texel: f32,
    /// Of 0.01 units; 0 in a gap and outside the volume.
    opacity: f32,
    /// As composed.
    continuity: f32,
    /// Templates that led here.
    path: u32,
}

/// What a ray found.
struct Marched {
    /// Linear premultiplied.
    color: vec4f,
    /// The ray's surface: distance from the eye, below 0 if there is none.
    surface_t: f32,
    /// Unit normal towards the eye, subject space.
    surface_normal: vec3f,
    /// Rest space.
    surface_rest: vec3f,
}

fn map_point(pos: vec3f, mask: u32) -> Material {
    if drawn_kinds == 0u {
        return Material(pos, 1.0, 0u);
    }
    return material_at(pos, mask);
}

/// Linear RGB and opacity of a normalised value.
fn transfer(texel: f32) -> vec4f {
    return textureSampleLevel(lut, linear_sampler, vec2f(texel * look.lut.x + look.lut.y, 0.5), 0.0);
}

/// Shares of bodies at a point of rest space (see `body_shares`).
fn body_at(pos: vec3f) -> vec4f {
    let uvw = apply_affine(
        subject.label_from_rest_row0,
        subject.label_from_rest_row1,
        subject.label_from_rest_row2,
        pos,
    );
    let is_inside = all(uvw >= vec3f(0.0)) && all(uvw <= vec3f(1.0));
    return select(vec4f(0.0), textureSampleLevel(body_shares, linear_sampler, uvw, 0.0), is_inside);
}

/// Opacity of 0.01 units where bodies take the place of what the values say. The voxels around a body that it fills less than half of
/// belong to no segment and would stay as a film of its values around it: they go too.
fn with_bodies(opacity: f32, shares: vec4f) -> f32 {
    let clear = max(shares.x - shares.z, 0.0);
    let seen = clamp((shares.y - shares.z) / max(clear, 1e-3), 0.0, 1.0);
    let through = 1.0 - pow(1.0 - seen, OPACITY_LENGTH / BODY_LAYER);
    let own = mix(through, 1.0, smoothstep(0.35, 0.65, shares.z / max(shares.x, 1e-3)));
    let film = smoothstep(0.05, 0.35, shares.x);
    return mix(opacity * (1.0 - film), own, smoothstep(0.25, 0.55, shares.x));
}

/// Direction from outside bodies to their inside in rest space, about 1 per voxel at their surface, 0 elsewhere; out of hidden ones.
fn body_gradient_at(pos: vec3f) -> vec3f {
    var sum = vec3f(0.0);
    for (var i = 0u; i < 3u; i++) {
        let axis = select(vec3f(0.0), vec3f(1.0), vec3u(0u, 1u, 2u) == vec3u(i));
        // Two reaches: the near one for what is thin, the far one against the stairs of labels.
        let near = axis * BODY_NEAR * subject.dims.w;
        let far = axis * BODY_FAR * subject.dims.w;
        let slope = 0.3 * (body_at(pos + near) - body_at(pos - near)) + 0.7 * (body_at(pos + far) - body_at(pos - far));
        sum += axis * dot(slope, vec4f(1.0, 0.0, 1.0, -2.0));
    }
    return sum * 0.5;
}

/// Linear RGB of the visible bodies around a point, blended over the 27 label voxels, premultiplied by how much of it is theirs.
fn body_color_at(pos: vec3f) -> vec4f {
    let around = around_at(pos);
    var sum = vec4f(0.0);
    for (var i = 0; i < 27; i++) {
        let item = bodies.items[label_around(around, i) & 255u];
        sum += select(vec4f(0.0), vec4f(item.rgb, 1.0) * weight_around(around, i), item.w >= BODY_HIDDEN);
    }
    return sum;
}

fn sample_mapped(mapped: Material) -> Sample {
    let uvw = texture_from_rest(mapped.pos);
    let is_inside = all(uvw >= vec3f(0.0)) && all(uvw <= subject.texture_end.xyz);
    let texel = texel_at(uvw);
    var opacity = transfer(texel).a;
    if has_bodies != 0u {
        opacity = with_bodies(opacity, body_at(mapped.pos));
    }
    return Sample(
        mapped.pos,
        texel,
        select(0.0, opacity, is_inside && mapped.continuity >= 0.0),
        mapped.continuity,
        mapped.path,
    );
}

/// How much of its opacity a place keeps if opacity follows the gradient (equation 6.2), 0 to 1.
fn edge_gain(steepness: f32) -> f32 {
    return mix(1.0, smoothstep(EDGE_NONE, EDGE_FULL, steepness), look.edges.x);
}

/// How much of what is seen somewhere is a body's, 0 to 1.
fn body_weight(shares: vec4f) -> f32 {
    return smoothstep(0.1, 0.35, shares.x - shares.w);
}

/// Where a value lies in the transfer table, 0 to 1: how dense the tissue counts as (equation 6.3).
fn density_of(found: Sample) -> f32 {
    return clamp(found.texel * look.lut.x + look.lut.y, 0.0, 1.0);
}

/// The opacity of what was sampled for a test of light: by the gradient at rest, whatever the deformation makes of it.
fn shading_opacity(found: Sample) -> f32 {
    if has_edges == 0u {
        return found.opacity;
    }
    var gain = 0.0;
    var left = select(0u, 1u, found.opacity > VISIBLE);
    while left > 0u {
        left--;
        gain = edge_gain(length(gradient_at(texture_from_rest(found.pos))) * look.lut.x);
        if has_bodies != 0u {
            gain = mix(gain, 1.0, body_weight(body_at(found.pos)));
        }
    }
    return found.opacity * gain;
}

/// The 27 label voxels around a point.
struct Around {
    /// The middle one.
    middle: vec3i,
    /// Columns: weights per axis of the one before it, of itself, of the one after it.
    weights: mat3x3f,
}

fn around_at(pos: vec3f) -> Around {
    let uvw = apply_affine(
        subject.label_from_rest_row0,
        subject.label_from_rest_row1,
        subject.label_from_rest_row2,
        pos,
    );
    // Quadratic B-spline: borders between segments come out smooth, where eight voxels would leave stairs.
    let at = uvw * subject.label_dims.xyz - 0.5;
    let middle = floor(at + 0.5);
    let part = at - middle;
    let weights = mat3x3f(
        0.5 * (0.5 - part) * (0.5 - part),
        0.75 - part * part,
        0.5 * (0.5 + part) * (0.5 + part),
    );
    return Around(vec3i(middle), weights);
}

fn label_around(around: Around, i: i32) -> u32 {
    let last = vec3i(subject.label_dims.xyz) - 1;
    let voxel = clamp(around.middle + vec3i(i % 3, (i / 3) % 3, i / 9) - 1, vec3i(0), last);
    return textureLoad(labels, voxel, 0).x;
}

fn weight_around(around: Around, i: i32) -> f32 {
    return around.weights[i % 3].x * around.weights[(i / 3) % 3].y * around.weights[i / 9].z;
}

/// Colour of the segments around a point, blended over the 27 label voxels, premultiplied by how much of it is known.
fn tint_at(pos: vec3f) -> vec4f {
    let around = around_at(pos);
    var sum = vec4f(0.0);
    for (var i = 0; i < 27; i++) {
        let color = textureLoad(palette, vec2i(i32(label_around(around, i)), 0), 0);
        sum += vec4f(color.rgb * color.a, color.a) * weight_around(around, i);
    }
    return sum;
}

/// Cell of the grid at a point: x mask, y emptiness. Everything is visible without a grid.
fn cell_at(pos: vec3f) -> vec2u {
    if has_grid == 0u || grid.cells.w == 0u {
        return vec2u(0xffffffffu, 0u);
    }
    let local = floor((pos - grid.origin_min.xyz) / grid.cell_size.xyz);
    let cell = clamp(vec3i(local), vec3i(0), vec3i(grid.cells.xyz) - 1);
    return textureLoad(grid_cells, cell, 0).xy;
}

/// Transmittance of a length (subject units, adjusted) of this opacity. From 0.999 on it is a wall.
fn transmittance(opacity: f32, length: f32) -> f32 {
    let clear = 1.0 - opacity;
    let part = pow(max(clear, 1e-6), length / OPACITY_LENGTH);
    return select(part, 0.0, clear < 0.0011 && length > 0.0);
}

/// Direction k of n spread over the half sphere around +z, turned by `turn`.
fn spread(k: u32, n: u32, turn: f32) -> vec3f {
    let z = 0.25 + 0.7 * (f32(k) + 0.5) / f32(n);
    let around = f32(k) * 2.39996323 + turn;
    let r = sqrt(max(0.0, 1.0 - z * z));
    return vec3f(r * cos(around), r * sin(around), z);
}

/// Even noise over the pixels (interleaved gradient noise, Jimenez 2014), 0 to 1: hides the spacing of the shadow's taps. The
/// same for the same pixel always, so pictures stay repeatable.
fn pixel_noise(pixel: vec2f) -> f32 {
    return fract(52.9829189 * fract(dot(pixel, vec2f(0.06711056, 0.00583715))));
}

/// What stands in the light of a surface.
struct Surroundings {
    /// How open they are, 0 to 1.
    openness: f32,
    /// How much of the key light arrives, 0 to 1.
    key_light: f32,
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
    let voxel = subject.dims.w;
    if k < occlusion_taps {
        let up = select(vec3f(1.0, 0.0, 0.0), vec3f(0.0, 1.0, 0.0), abs(normal.y) < 0.9);
        let tangent = normalize(cross(up, normal));
        let bitangent = cross(normal, tangent);
        let way = spread(k, occlusion_taps, frame.jitter.w + noise * 6.2831853);
        // Near taps find creases, far ones the hollow under a flap.
        let reach = mix(0.010, 0.045, f32((k * 5u) % occlusion_taps) / f32(occlusion_taps)) + voxel;
        let at = pos + normal * (0.5 * voxel) + (tangent * way.x + bitangent * way.y + normal * way.z) * reach;
        return Tap(at, way.z, 0.0);
    }
    // Closer together near the surface, where a shadow has its edge.
    let part = (f32(k - occlusion_taps) + 0.3 + 0.7 * fract(frame.jitter.z + noise)) / f32(shadow_taps);
    let at = pos + normal * (1.5 * voxel) + key_dir * (0.006 + 0.30 * part * part);
    // Farther occluders dim less: a large soft lamp.
    return Tap(at, 0.0, mix(0.62, 0.30, part));
}

/// Taps of the opacity in the deformed space around a surface.
fn surroundings_of(pos: vec3f, normal: vec3f, key_dir: vec3f, noise: f32) -> Surroundings {
    var closed = 0.0;
    var weights = 0.0001;
    var open = 1.0;
    // Taps that no template reaches are sampled plainly, the others in a loop of their own: where there are none, it ends at once.
    var mapped = 0u;
    for (var k = 0u; k < occlusion_taps + shadow_taps; k++) {
        let tap = tap_at(k, pos, normal, key_dir, noise);
        let is_mapped = cell_at(tap.pos).x != 0u && drawn_kinds != 0u;
        mapped |= select(0u, 1u << k, is_mapped);
        let opacity = select(shading_opacity(sample_mapped(Material(tap.pos, 1.0, 0u))), 0.0, is_mapped);
        weights += tap.weight;
        closed += tap.weight * smoothstep(0.02, 0.5, opacity);
        open *= 1.0 - tap.shade * smoothstep(0.02, 0.6, opacity);
    }
    if drawn_kinds != 0u {
        while mapped != 0u {
            let tap = tap_at(firstTrailingBit(mapped), pos, normal, key_dir, noise);
            mapped &= mapped - 1u;
            let opacity = shading_opacity(sample_mapped(map_point(tap.pos, cell_at(tap.pos).x)));
            closed += tap.weight * smoothstep(0.02, 0.5, opacity);
            open *= 1.0 - tap.shade * smoothstep(0.02, 0.6, opacity);
        }
    }
    return Surroundings(1.0 - closed / weights, open);
}

/// Marches the ray through a point of the picture (pixels, origin top left).
fn march(pixel: vec2f) -> Marched {
    var result: Marched;
    result.color = vec4f(0.0);
    result.surface_t = -1.0;

    let ndc = (pixel / frame.lens.zw) * 2.0 - 1.0;
    let dir_in_view = normalize(vec3f(ndc.x * frame.lens.x, -ndc.y * frame.lens.y, -1.0));
    let origin = vec3f(frame.subject_from_view_row0.w, frame.subject_from_view_row1.w, frame.subject_from_view_row2.w);
    let dir = without_zeros(apply_linear(
        frame.subject_from_view_row0,
        frame.subject_from_view_row1,
        frame.subject_from_view_row2,
        dir_in_view,
    ));
    let inverse_dir = 1.0 / dir;
    let span = ray_in_box(origin, inverse_dir, frame.bounds_min.xyz, frame.bounds_max.xyz);
    let step = frame.bounds_min.w;
    let t_end = span.y;
    let forward = select(vec3f(-1.0), vec3f(1.0), dir > vec3f(0.0));

    var t = max(span.x, 0.0) + step * frame.jitter.z;
    var t_before = max(span.x, 0.0);
    var before = Sample(vec3f(0.0), 0.0, 0.0, 1.0, 0u);
    // Share of its opacity that the sample before keeps.
    var gain_before = 1.0;
    var stretch = 1.0;
    var clear = 1.0;
    var mask = 0u;
    // Templates that reach the cell of the sample before: a cut between the two samples may be one of theirs alone.
    var mask_before = 0u;
    var color = vec3f(0.0);
    // The ray's surface, and its share of the colour, for shadow and occlusion.
    var surface_key = vec3f(0.0);
    var surface_ambient = vec3f(0.0);
    var surface_lift = 0.0;
    var t_cell = -1.0;

    for (var event = 0u; event < MAX_EVENTS; event++) {
        var here = before;
        var is_event = false;
        // Seek the next sample with something in it, or the first behind it.
        loop {
            var t_stop = t_end;
            // Through empty cells and those that no template reaches.
            loop {
                // Leap from cell to cell until something may be seen. Not while inside tissue: its end must be found first.
                loop {
                    if t >= t_end {
                        break;
                    }
                    if has_grid == 0u || grid.cells.w == 0u {
                        mask = 0xffffffffu;
                        t_cell = t_end;
                        break;
                    }
                    let local = floor((origin + dir * t - grid.origin_min.xyz) / grid.cell_size.xyz);
                    let cell = clamp(local, vec3f(0.0), vec3f(grid.cells.xyz) - 1.0);
                    let content = textureLoad(grid_cells, vec3i(cell), 0).xy;
                    let reach = max(f32(content.y), 1.0);
                    let plane = select(cell + 1.0 - reach, cell + reach, dir > vec3f(0.0));
                    let exits = (grid.origin_min.xyz + plane * grid.cell_size.xyz - origin) * inverse_dir;
                    t_cell = min(exits.x, min(exits.y, exits.z)) + step * 0.01;
                    mask = content.x;
                    if content.y == 0u || before.opacity > VISIBLE {
                        break;
                    }
                    t = max(t_cell, t + step * 0.01);
                    t_before = t;
                    mask_before = 0u;
                    stretch = 1.0;
                }
                // Cells that no template reaches are sampled plainly.
                t_stop = min(t_cell, t_end);
                let is_mapped = mask != 0u && drawn_kinds != 0u;
                loop {
                    if is_mapped || t >= t_stop || is_event {
                        break;
                    }
                    here = sample_mapped(Material(origin + dir * t, 1.0, 0u));
                    is_event = here.opacity > VISIBLE || before.opacity > VISIBLE;
                    if is_event {
                        break;
                    }
                    t_before = t;
                    mask_before = mask;
                    t += step;
                }
                if is_mapped || is_event || t >= t_end {
                    break;
                }
            }
            if drawn_kinds != 0u {
                loop {
                    if mask == 0u || t >= t_stop || is_event {
                        break;
                    }
                    let last = here.pos;
                    here = sample_mapped(map_point(origin + dir * t, mask));
                    is_event = here.opacity > VISIBLE || before.opacity > VISIBLE;
                    if is_event {
                        break;
                    }
                    // The step follows the Jacobian: compressed tissue gets more samples, stretched tissue fewer.
                    stretch = clamp(distance(here.pos, last) / max(t - t_before, 0.25 * step), 0.6, 3.0);
                    t_before = t;
                    mask_before = mask;
                    t += step / stretch;
                }
            }
            if is_event || t >= t_end {
                break;
            }
        }
        if !is_event {
            break;
        }

        // A jump of the opacity is found exactly; `edge` is the last or first sample that has something in it.
        let is_rising = here.opacity > before.opacity;
        let is_jump = abs(here.opacity - before.opacity) > JUMP || min(here.opacity, before.opacity) <= VISIBLE;
        let level = 0.5 * (here.opacity + before.opacity);
        var low = t_before;
        var high = t;
        var edge = before;
        if is_rising || !is_jump {
            edge = here;
        }
        let either = mask | mask_before;
        // Behind a surface towards nothing the first stretch has always the same length, and so the same share of the colour: were it what is
        // left of the step, the surface would fade wherever a sample happens to lie right behind it. What is there is asked for by one turn
        // more than there are halvings.
        let has_first_stretch = is_rising && before.opacity <= VISIBLE;
        var behind = here;
        // Two loops again: where no template reaches, a turn costs no map.
        let is_mapped = either != 0u && drawn_kinds != 0u;
        let turns = select(0u, BISECTIONS + select(0u, 1u, has_first_stretch), is_jump);
        for (var turn = select(0u, turns, !is_mapped); turn > 0u; turn--) {
            let is_last = has_first_stretch && turn == 1u;
            let at = select(0.5 * (low + high), high + step, is_last);
            let found = sample_mapped(Material(origin + dir * at, 1.0, 0u));
            let is_in = found.opacity > level;
            if is_last {
                behind = found;
            } else if is_in == is_rising {
                high = at;
            } else {
                low = at;
            }
            if is_in && !is_last {
                edge = found;
            }
        }
        if drawn_kinds != 0u {
            for (var turn = select(0u, turns, is_mapped); turn > 0u; turn--) {
                let is_last = has_first_stretch && turn == 1u;
                let at = select(0.5 * (low + high), high + step, is_last);
                let found = sample_mapped(map_point(origin + dir * at, either));
                let is_in = found.opacity > level;
                if is_last {
                    behind = found;
                } else if is_in == is_rising {
                    high = at;
                } else {
                    low = at;
                }
                if is_in && !is_last {
                    edge = found;
                }
            }
        }
        let t_edge = select(0.5 * (t_before + t), select(low, high, is_rising), is_jump);
        // Thin tissue keeps the sample that found it.
        if has_first_stretch && behind.opacity >= 0.5 * here.opacity && t_edge + step > t {
            here = behind;
            t = t_edge + step;
        }
        let t_shade = select(t, t_edge, is_jump);
        let pos = origin + dir * t_shade;

        // Jacobian of the map and gradient of the continuity: one-sided differences into the material.
        var col0 = vec3f(1.0, 0.0, 0.0);
        var col1 = vec3f(0.0, 1.0, 0.0);
        var col2 = vec3f(0.0, 0.0, 1.0);
        var grad_a = vec3f(0.0);
        var base = Mapped(edge.pos, edge.continuity);
        var path = 0u;
        if drawn_kinds != 0u {
            // First the point itself: the edge may have been sampled in a cell of another mask, and continuities of different masks
            // have no difference.
            path = either;
            if KEEPS_TISSUE {
                path = edge.path;
            }
            var turn = select(4u, select(0u, 1u, KEEPS_TISSUE), path != 0u);
            while turn < 4u {
                let along = select(vec3f(0.0), forward * map_step(), vec3u(1u, 2u, 3u) == vec3u(turn));
                let moved = map_along(pos + along, path);
                if turn == 0u {
                    base = moved;
                }
                let way = select(along.x + along.y + along.z, 1.0, turn == 0u);
                let column = (moved.pos - base.pos) / way;
                let change = (moved.continuity - base.continuity) / way;
                if dot(column, column) < MAX_STRETCH * MAX_STRETCH {
                    col0 = select(col0, column, turn == 1u);
                    col1 = select(col1, column, turn == 2u);
                    col2 = select(col2, column, turn == 3u);
                }
                grad_a = select(grad_a, vec3f(change), vec3u(1u, 2u, 3u) == vec3u(turn));
                turn++;
            }
        }

        // What the opacity is said for: the way since the sample before (equations 4.23 and 4.30).
        var exponent = 1.0;
        if look.modes.x == OPACITY_CONSTANCY {
            exponent = length(col0 * dir.x + col1 * dir.y + col2 * dir.z);
        } else if look.modes.x == OPACITY_MASS {
            exponent = abs(dot(col0, cross(col1, col2)));
        }

        // Normal: gradient of the value carried over by the transposed Jacobian (equation 4.10) ...
        let uvw = texture_from_rest(edge.pos);
        var grad = gradient_at(uvw);
        var body_share = 0.0;
        if has_bodies != 0u {
            // The surface of a body is that of its segment, whatever the values do there.
            let own = body_gradient_at(edge.pos);
            grad = mix(grad, own / look.lut.x, smoothstep(0.03, 0.15, length(own)));
            body_share = body_weight(body_at(edge.pos));
        }
        let carried = vec3f(dot(col0, grad), dot(col1, grad), dot(col2, grad));
        let steepness = length(grad) * look.lut.x;
        let to_eye = -dir;
        var normal = carried / max(length(carried), 1e-9);
        normal = select(-normal, normal, dot(normal, to_eye) >= 0.0);
        var surfaceness = smoothstep(0.004, 0.03, steepness);
        // ... blended into the gradient of the continuity near a cut (section 4.5.3), and the scan's own edge is a cut too.
        let slope_a = length(grad_a);
        let cut_distance = base.continuity / max(slope_a, 1e-6);
        let is_cut = slope_a > 1e-3 && slope_a < MAX_SLOPE;
        var cut_weight = select(0.0, 1.0 - smoothstep(0.25, 1.0, cut_distance / subject.dims.w), is_cut);
        var cut_normal = -grad_a / max(slope_a, 1e-9);
        let end_low = uvw * subject.dims.xyz;
        let end_high = (subject.texture_end.xyz - uvw) * subject.dims.xyz;
        let ends = min(end_low, end_high);
        let end = min(ends.x, min(ends.y, ends.z));
        let end_weight = 1.0 - smoothstep(0.25, 1.0, end);
        if end_weight > cut_weight {
            let end_axis = select(vec3f(0.0), select(vec3f(1.0), vec3f(-1.0), end_low < end_high), ends == vec3f(end));
            let end_rest = apply_transposed(
                subject.texture_from_rest_row0,
                subject.texture_from_rest_row1,
                subject.texture_from_rest_row2,
                end_axis,
            );
            cut_normal = normalize(vec3f(dot(col0, end_rest), dot(col1, end_rest), dot(col2, end_rest)) + to_eye * 1e-6);
            cut_weight = end_weight;
        }
        // A cut face is an edge too, as steep as the tissue there is dense (equation 6.3): where the cut goes through a hole, no face appears.
        var edge_weight = cut_weight;
        // A cut that faces away is not the face that is seen.
        cut_weight *= smoothstep(-0.02, 0.08, dot(cut_normal, to_eye));
        normal = normalize(mix(normal, cut_normal, cut_weight) + to_eye * 1e-5);
        surfaceness = max(surfaceness, cut_weight);
        // Both sides of the surface of kept tissue take their normal from it.
        var tint_pos = edge.pos;
        var lift = 0.0;
        if KEEPS_TISSUE {
            let kept = kept_surface(edge.pos, path, mat3x3f(col0, col1, col2), to_eye);
            normal = normalize(mix(normal, kept.normal, kept.weight) + to_eye * 1e-5);
            surfaceness = max(surfaceness, kept.weight);
            edge_weight = max(edge_weight, kept.weight);
            tint_pos += kept.inwards;
            // Labels end in stairs, its normal is smooth: what stands in its light is looked for from above the stairs.
            lift = kept.weight * subject.dims.w;
        }

        var gain = 1.0;
        var gain_here = 1.0;
        if has_edges != 0u {
            gain = mix(edge_gain(mix(length(carried) * look.lut.x, density_of(edge), edge_weight)), 1.0, body_share);
            gain_here = gain;
            // Behind a surface the layer of its steepness ends within a step: the share is the mean of both ends of the way.
            var turns = select(0u, 1u, is_jump && is_rising);
            while turns > 0u {
                turns--;
                let uvw_here = texture_from_rest(here.pos);
                let grad_here = gradient_at(uvw_here);
                let carried_here = vec3f(dot(col0, grad_here), dot(col1, grad_here), dot(col2, grad_here));
                let inside = min(uvw_here, subject.texture_end.xyz - uvw_here) * subject.dims.xyz;
                let away = min(min(inside.x, inside.y), inside.z);
                let from_cut = select(1.0, here.continuity / max(slope_a, 1e-6) / subject.dims.w, is_cut);
                let face = 1.0 - smoothstep(0.25, 1.0, min(away, from_cut));
                gain_here = edge_gain(mix(length(carried_here) * look.lut.x, density_of(here), face));
                if has_bodies != 0u {
                    gain_here = mix(gain_here, 1.0, body_weight(body_at(here.pos)));
                }
                gain = 0.5 * (gain + gain_here);
            }
            gain_before = select(gain_before, 0.5 * (gain_before + gain), is_jump && !is_rising);
        }
        let passed = transmittance(before.opacity * gain_before, (t_edge - t_before) * exponent)
            * transmittance(here.opacity * gain, (t - t_edge) * exponent);
        let weight = clear * (1.0 - passed);
        gain_before = gain_here;

        // Colour: the table's, tinted by the segments around.
        var texel = edge.texel;
        if KEEPS_TISSUE {
            texel = texel_at(texture_from_rest(tint_pos));
        }
        var albedo = transfer(texel).rgb;
        if has_labels != 0u {
            let inwards = grad / max(length(grad), 1e-9) * (subject.dims.w * smoothstep(0.01, 0.05, steepness));
            var depth = 0.0;
            var tint = vec4f(0.0);
            loop {
                tint = tint_at(tint_pos + inwards * depth);
                if tint.a > 0.02 || depth >= TINT_DEPTH {
                    break;
                }
                depth += 0.4;
            }
            let how_much = look.lut.z * smoothstep(0.0, 0.02, tint.a);
            albedo = mix(albedo, albedo * tint.rgb / max(tint.a, 1e-4), how_much);
        }
        if has_bodies != 0u {
            let body = body_color_at(tint_pos);
            albedo = mix(albedo, body.rgb / max(body.a, 1e-4), smoothstep(0.02, 0.3, body.a));
        }
        let normal_in_view = vec3f(
            dot(normal, vec3f(frame.subject_from_view_row0.x, frame.subject_from_view_row1.x, frame.subject_from_view_row2.x)),
            dot(normal, vec3f(frame.subject_from_view_row0.y, frame.subject_from_view_row1.y, frame.subject_from_view_row2.y)),
            dot(normal, vec3f(frame.subject_from_view_row0.z, frame.subject_from_view_row1.z, frame.subject_from_view_row2.z)),
        );
        // A cut face is wet but flat: half the shine.
        let solid = shade_surface(albedo, normal_in_view, -dir_in_view, look.lut.w * (1.0 - 0.5 * cut_weight));
        let haze = shade_medium(albedo);
        let key = mix(haze.key, solid.key, surfaceness) * weight;
        let ambient = mix(haze.ambient, solid.ambient, surfaceness) * weight;
        color += key + ambient;
        if result.surface_t < 0.0 && weight > SURFACE_WEIGHT * (0.25 + 0.75 * clear) {
            result.surface_t = t_shade;
            result.surface_normal = normal;
            result.surface_rest = edge.pos;
            surface_lift = lift;
            surface_key = key;
            surface_ambient = ambient;
        }

        clear *= passed;
        if clear < OPAQUE {
            clear = 0.0;
            break;
        }
        before = here;
        t_before = t;
        mask_before = mask;
        t += step / clamp(exponent_for_step(col0, col1, col2, dir), 0.6, 3.0);
    }

    // Once per ray: what stands in the light of its surface.
    if result.surface_t >= 0.0 {
        var pos = origin + dir * result.surface_t;
        if KEEPS_TISSUE {
            pos += result.surface_normal * surface_lift;
        }
        let noise = pixel_noise(floor(pixel));
        let key_dir = apply_linear(
            frame.subject_from_view_row0,
            frame.subject_from_view_row1,
            frame.subject_from_view_row2,
            KEY_DIR,
        );
        let around = surroundings_of(pos, result.surface_normal, key_dir, noise);
        let open = around.openness;
        let lit = around.key_light;
        color -= surface_key * (1.0 - lit) + surface_ambient * (0.8 * (1.0 - open)) + surface_key * lit * (0.25 * (1.0 - open));
    }
    result.color = vec4f(max(color, vec3f(0.0)), 1.0 - clear);
    return result;
}

/// |J v|: how much rest space one unit of the ray goes through.
fn exponent_for_step(col0: vec3f, col1: vec3f, col2: vec3f, dir: vec3f) -> f32 {
    return length(col0 * dir.x + col1 * dir.y + col2 * dir.z);
}

/// One triangle that covers everything.
@vertex
fn cover(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    return vec4f(f32(index & 1u) * 4.0 - 1.0, f32(index >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}

/// The picture, linear premultiplied.
@fragment
fn draw(@builtin(position) at: vec4f) -> @location(0) vec4f {
    return march(floor(at.xy) + frame.jitter.xy).color;
}

/// What is at one pixel, four texels wide: position and distance (below 0: nothing); normal and segment; rest position
/// and value; accumulated opacity.
@fragment
fn pick(@builtin(position) at: vec4f) -> @location(0) vec4f {
    let found = march(frame.pick.xy);
    let ndc = (frame.pick.xy / frame.lens.zw) * 2.0 - 1.0;
    let dir_in_view = normalize(vec3f(ndc.x * frame.lens.x, -ndc.y * frame.lens.y, -1.0));
    let pos = apply_affine(
        frame.subject_from_view_row0,
        frame.subject_from_view_row1,
        frame.subject_from_view_row2,
        dir_in_view * found.surface_t,
    );
    // On the surface itself half of the voxels are air: a little deeper along the ray it is told what this is.
    let dir = normalize(pos - vec3f(frame.subject_from_view_row0.w, frame.subject_from_view_row1.w, frame.subject_from_view_row2.w));
    var segment = 0.0;
    var value = 0.0;
    for (var k = 1; k <= 4; k++) {
        let inside = map_point(pos + dir * (f32(k) * 0.5 * subject.dims.w), 0xffffffffu).pos;
        let uvw = apply_affine(
            subject.label_from_rest_row0,
            subject.label_from_rest_row1,
            subject.label_from_rest_row2,
            inside,
        );
        let voxel = clamp(vec3i(floor(uvw * subject.label_dims.xyz)), vec3i(0), vec3i(subject.label_dims.xyz) - 1);
        segment = f32(textureLoad(labels, voxel, 0).x);
        value = subject.value.x + subject.value.y * texel_at(texture_from_rest(inside));
        if segment > 0.0 || (k >= 2 && subject.label_dims.w < 0.5) {
            break;
        }
    }
    let part = u32(at.x);
    if part == 0u {
        return vec4f(pos, found.surface_t);
    }
    if part == 1u {
        return vec4f(found.surface_normal, segment);
    }
    if part == 2u {
        return vec4f(found.surface_rest, value);
    }
    return found.color;
}
