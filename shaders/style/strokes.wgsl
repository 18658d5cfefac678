// Strokes and dots that make the tone: they lie on the tissue at rest and ride along with every displacement.
//
// A stroke is where the surface meets one of a family of parallel planes of rest space. Families with several normals
// stand ready; each pixel takes those two that follow its direction best. Where the picture needs more strokes of a
// family or fewer, every second one fades in or out (as tonal art maps do), so that they keep to the tissue while the
// camera moves.
// needs: types.wgsl bind/style.wgsl style/traced.wgsl style/directions.wgsl

/// Normals of the families of planes.
const FAMILIES: u32 = 9u;
/// Strokes that would lie nearer to each other, pixels, become an even tone.
const LEAST_SPACING: f32 = 2.6;
/// Part of the surface that strokes of one direction cover at most; beyond it others cross them.
const MOST_ALONE: f32 = 0.42;
/// The same of short dashes, which grow together where they cover more.
const MOST_DASHED: f32 = 0.28;

fn family_normal(index: u32) -> vec3f {
    var all = array<vec3f, FAMILIES>(
        vec3f(1.0, 0.0, 0.0), vec3f(0.0, 1.0, 0.0), vec3f(0.0, 0.0, 1.0),
        vec3f(0.7071, 0.7071, 0.0), vec3f(0.7071, -0.7071, 0.0), vec3f(0.7071, 0.0, 0.7071),
        vec3f(0.7071, 0.0, -0.7071), vec3f(0.0, 0.7071, 0.7071), vec3f(0.0, 0.7071, -0.7071),
    );
    return all[index];
}

/// The two families that follow a direction best, and the share of the first.
struct Families {
    first: vec3f,
    second: vec3f,
    share: f32,
}

/// Stands for strokes that take no family: its normals have no length.
fn no_families() -> Families {
    return Families(vec3f(0.0), vec3f(0.0), 1.0);
}

/// The families whose strokes lie across `across` on a surface, but for those that are taken: strokes of one family
/// would not cross each other.
fn families_for(normal: vec3f, across: vec3f, taken: Families) -> Families {
    var found = Families(across, across, 1.0);
    var best = -1.0;
    var next = -1.0;
    for (var k = 0u; k < FAMILIES; k++) {
        let family = family_normal(k);
        let in_plane = family - normal * dot(family, normal);
        let size = dot(in_plane, in_plane);
        let toward = dot(in_plane, across);
        let is_taken = max(dot(family, taken.first), dot(family, taken.second)) > 0.9;
        let fits = toward * toward / max(size, 1e-6) * smoothstep(0.05, 0.4, size);
        let score = select(fits, -2.0, is_taken);
        if score > best {
            next = best;
            found.second = found.first;
            best = score;
            found.first = family;
        } else if score > next {
            next = score;
            found.second = family;
        }
    }
    found.share = 0.5 + 0.5 * smoothstep(0.0, 0.15, best - next);
    return found;
}

/// How much of a pixel a stroke covers whose middle is so far away. Strokes under the least width are paler. Lengths as
/// parts of the way from stroke to stroke; `per_pixel` is that of a pixel.
fn stroke(off: f32, width: f32, least: f32, per_pixel: f32) -> f32 {
    let drawn = max(width, least);
    let pale = width / max(drawn, 1e-12);
    return pale * clamp((0.5 * drawn - off) / max(per_pixel, 1e-12) + 0.5, 0.0, 1.0);
}

/// How much of a pixel strokes cover, 0 to 1. `phase` is the place across the strokes and `slope` its change from pixel
/// to pixel. `duty` is the part that they cover, `spacing_px` between them at most, `width_px` their least width:
/// thinner ones are paler.
fn stripes(phase: f32, slope: f32, duty: f32, spacing_px: f32, width_px: f32) -> f32 {
    let level = log2(max(spacing_px * slope, 1e-12));
    let period = exp2(floor(level));
    let fine = 1.0 - fract(level);
    // Strokes stand at whole places; the odd ones are finer, down to nothing.
    let place = phase / period;
    let from_even = abs(place - 2.0 * round(0.5 * place));
    let width = 2.0 * duty / (1.0 + fine);
    let per_pixel = slope / period;
    let least = min(width_px, 0.5 * spacing_px) * per_pixel;
    let even = stroke(from_even, width, least, per_pixel);
    let odd = stroke(1.0 - from_even, width * fine, least, per_pixel);
    let ink = max(even, odd);
    // Strokes finer than the pixels are seen as their mean.
    return mix(duty, ink, smoothstep(LEAST_SPACING - 1.0, LEAST_SPACING + 1.0, spacing_px));
}

/// How much strokes of a family cover.
fn family_stripes(around: Patch, family: vec3f, duty: f32) -> f32 {
    let slope = length(vec2f(dot(around.right, family), dot(around.down, family)));
    return stripes(dot(around.rest, family), slope, duty, style.hatch_spacing_px, style.hatch_width_px);
}

/// How much strokes of two families cover.
fn strokes_of(around: Patch, families: Families, duty: f32) -> f32 {
    // So that both together cover what one alone would.
    let clear = max(1.0 - duty, 1e-3);
    let first = family_stripes(around, families.first, 1.0 - pow(clear, families.share));
    let second = family_stripes(around, families.second, 1.0 - pow(clear, 1.0 - families.share));
    return 1.0 - (1.0 - first) * (1.0 - second);
}

/// The pattern of a segment's strokes: three times their kind, plus how often they are turned by 60 degrees. Those of
/// objects and of meshes beside a volume go by their number.
fn pattern_of(segment: u32) -> u32 {
    let usual = segment % 3u + 3u * ((segment / 3u) % 3u);
    return select(u32(style.axes[min(segment, 255u)].w), usual, segment > 255u);
}

/// How much of a pixel hatching covers where it is to make this part dark. Segments differ in the direction of their
/// strokes, and in their kind: lines, broken lines, crossed lines, rows of short dashes.
fn hatching_at(pixel: vec2i, here: Shown, dark: f32) -> f32 {
    let pattern = pattern_of(here.segment);
    let around = patch_at(pixel, here, f32(pattern % 3u) * 1.0471976);
    if !around.is_known {
        return dark;
    }
    let kind = pattern / 3u;
    let most = select(MOST_ALONE, MOST_DASHED, kind == 3u);
    let alone = select(min(dark, most), 1.0 - sqrt(max(1.0 - dark, 0.0)), kind == 2u);
    let crossed = 1.0 - (1.0 - dark) / (1.0 - alone);
    let ours = families_for(around.normal, around.across, no_families());
    var strokes = 0.0;
    if kind == 1u || kind == 3u {
        // Broken: gaps of a quarter, made up for by the width. Dashes: gaps of a half, twice as near.
        let on_part = select(0.75, 0.5, kind == 3u);
        let spacing_px = select(3.0, 1.5, kind == 3u) * style.hatch_spacing_px;
        let gaps = families_for(around.normal, around.along, ours).first;
        let gap_slope = length(vec2f(dot(around.right, gaps), dot(around.down, gaps)));
        let on = stripes(dot(around.rest, gaps), gap_slope, on_part, spacing_px, 0.0);
        strokes = strokes_of(around, ours, min(alone / on_part, 1.0)) * on;
    } else {
        strokes = strokes_of(around, ours, alone);
    }
    let others = strokes_of(around, families_for(around.normal, around.along, ours), crossed);
    return 1.0 - (1.0 - strokes) * (1.0 - others);
}

/// Even numbers out of a place, 0 to 1 (PCG by Jarzynski and Olano 2020).
fn noise_of(place: vec2f) -> vec3f {
    var v = vec3u(bitcast<vec2u>(place + 0.0), 0x9e3779b9u) * 1664525u + 1013904223u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v ^= v >> vec3u(16u);
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    return vec3f(v >> vec3u(8u)) / 16777216.0;
}

/// How much of a pixel dots cover where they are to make this part dark. The dots stand on a lattice of the coordinate
/// plane that the surface faces most, each beside its place; three of four fade where the picture needs fewer.
fn dots_at(pixel: vec2i, here: Shown, dark: f32) -> f32 {
    let around = patch_at(pixel, here, 0.0);
    if !around.is_known {
        return dark;
    }
    let facing = abs(around.normal);
    let is_x = facing.x >= max(facing.y, facing.z);
    let is_y = !is_x && facing.y >= facing.z;
    let on_x = mat3x2f(vec2f(0.0, 0.0), vec2f(1.0, 0.0), vec2f(0.0, 1.0));
    let on_y = mat3x2f(vec2f(0.0, 1.0), vec2f(0.0, 0.0), vec2f(1.0, 0.0));
    let on_z = mat3x2f(vec2f(1.0, 0.0), vec2f(0.0, 1.0), vec2f(0.0, 0.0));
    var at = on_z * around.rest;
    var right = on_z * around.right;
    var down = on_z * around.down;
    if is_x {
        at = on_x * around.rest;
        right = on_x * around.right;
        down = on_x * around.down;
    } else if is_y {
        at = on_y * around.rest;
        right = on_y * around.right;
        down = on_y * around.down;
    }
    // Area of a pixel on the plane.
    let area = abs(right.x * down.y - right.y * down.x);
    let level = log2(max(style.stipple_spacing_px * sqrt(area), 1e-12));
    let cell = exp2(floor(level));
    let coarse = fract(level);
    let fine = 1.0 - coarse;
    // Dots per cell, counted by their areas: three of four shrink.
    let dots = 0.25 * (1.0 + 3.0 * fine * fine);
    let per_pixel = sqrt(area) / cell;
    // The least dot, in cells; lighter tones have fewer of it, darker ones larger dots.
    let least = 0.5 * min(style.stipple_size_px, 0.6 * style.stipple_spacing_px) * per_pixel;
    let full = dots * 3.1415927 * least * least;
    let kept = min(dark / full, 1.0);
    let radius = select(sqrt(dark / (dots * 3.1415927)), least, kept < 1.0);
    let place = at / cell;
    var ink = 0.0;
    for (var k = 0u; k < 9u; k++) {
        let lattice = round(place) + vec2f(f32(k % 3u) - 1.0, f32(k / 3u) - 1.0);
        let noise = noise_of(lattice * cell);
        let is_coarse = all((vec2i(lattice) & vec2i(1)) == vec2i(0));
        let beside = (noise.xy - 0.5) * (0.4 * (1.0 + coarse) * (1.0 - smoothstep(0.2, 0.7, dark)));
        let size = radius * select(fine, 1.0, is_coarse) * smoothstep(0.0, 0.1, kept + 0.1 - noise.z);
        let off = length(place - lattice - beside);
        ink = max(ink, clamp((size - off) / max(per_pixel, 1e-12) + 0.5, 0.0, 1.0) * step(1e-4, size));
    }
    return mix(dark, ink, smoothstep(LEAST_SPACING - 1.0, LEAST_SPACING + 1.0, style.stipple_spacing_px));
}
