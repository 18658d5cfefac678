// Ways to find the normal of a deformed volume, side by side (dissertation, sections 6.3 and 6.4): the program's own,
// and those it is compared with. Only the evaluation runs this; the map, the scan and its gradient are the program's
// own files.
// needs: types.wgsl bind/subject.wgsl bind/templates.wgsl affine.wgsl march/ray.wgsl march/value.wgsl
// displace/compose.wgsl

/// Points of the deformed object, subject space (w is not used); for `march` pixels of an orthographic picture, w its
/// side.
@group(3) @binding(0) var<storage, read> points: array<vec4f>;
/// xyz: unit normal away from the denser side; w: diffuse light from `LIGHT`.
@group(3) @binding(1) var<storage, read_write> results: array<vec4f>;

const UNLIT: u32 = 0u;
const JACOBIAN: u32 = 1u;
const CENTRAL: u32 = 2u;
const SOBEL: u32 = 3u;
const DOT_PRODUCT: u32 = 4u;
const JACOBIAN_OF_SOBEL: u32 = 5u;
const JACOBIAN_QUICK: u32 = 6u;
/// Which of these methods is evaluated.
override method: u32 = 1u;
/// Offset of finite differences of the map, subject units; as in the program.
override map_step: f32 = 0.0005;
/// Steepest slope of the value at rest, per voxel: what the dot product takes every gradient's length for.
override full_slope: f32 = 0.1;
const LIGHT: vec3f = vec3f(0.48, -0.64, 0.6);

fn value_at(pos: vec3f) -> f32 {
    let mapped = rest_from_subject(pos, 0xffffffffu);
    return select(0.0, texel_at(texture_from_rest(mapped.pos)), mapped.continuity >= 0.0);
}

fn axis_of(i: u32) -> vec3f {
    return select(vec3f(0.0), vec3f(1.0), vec3u(0u, 1u, 2u) == vec3u(i));
}

/// Sobel's operator at rest: between filtered taps half a voxel off along every axis the differences are central ones
/// and the means across have weights 1, 2, 1.
fn sobel_at_rest(uvw: vec3f) -> vec3f {
    var slope = vec3f(0.0);
    for (var i = 0u; i < 8u; i++) {
        let corner = select(vec3f(-1.0), vec3f(1.0), (vec3u(i) & vec3u(1u, 2u, 4u)) != vec3u(0u));
        slope += corner * texel_at(uvw + 0.5 * corner / subject.dims.xyz);
    }
    return 0.25 * slope;
}

/// The gradient at rest, carried over by the transposed Jacobian (equation 4.10).
fn by_jacobian(pos: vec3f) -> vec3f {
    let base = rest_from_subject(pos, 0xffffffffu).pos;
    let uvw = texture_from_rest(base);
    var grad = vec3f(0.0);
    if method == JACOBIAN_OF_SOBEL {
        grad = sobel_at_rest(uvw);
    } else if method == JACOBIAN {
        grad = gradient_at(uvw);
    } else {
        grad = quick_gradient_at(uvw);
    }
    var carried = vec3f(0.0);
    for (var i = 0u; i < 3u; i++) {
        let column = (rest_from_subject(pos + axis_of(i) * map_step, 0xffffffffu).pos - base) / map_step;
        carried += axis_of(i) * dot(column, grad);
    }
    return carried;
}

/// Differences of deformed samples on both sides, one voxel away.
fn by_central_differences(pos: vec3f) -> vec3f {
    var slope = vec3f(0.0);
    for (var i = 0u; i < 3u; i++) {
        let way = axis_of(i) * subject.detail;
        slope += axis_of(i) * 0.5 * (value_at(pos + way) - value_at(pos - way));
    }
    return slope;
}

/// Sobel's operator over 26 deformed samples, weights 1, 2, 4 across.
fn by_sobel(pos: vec3f) -> vec3f {
    var slope = vec3f(0.0);
    for (var k = 0; k < 27; k++) {
        let at = vec3f(f32(k % 3), f32((k / 3) % 3), f32(k / 9)) - 1.0;
        let across = 2.0 - abs(at);
        let value = value_at(pos + at * subject.detail);
        slope += value * at * vec3f(across.y * across.z, across.z * across.x, across.x * across.y);
    }
    return slope / 32.0;
}

/// The slope along the light alone (equation 6.5): light without a normal.
fn by_dot_product(pos: vec3f) -> f32 {
    let way = LIGHT * subject.detail;
    return max(0.5 * (value_at(pos - way) - value_at(pos + way)) / full_slope, 0.0);
}

fn evaluate_at(pos: vec3f) -> vec4f {
    var slope = vec3f(0.0);
    switch method {
        case JACOBIAN, JACOBIAN_OF_SOBEL, JACOBIAN_QUICK: {
            slope = by_jacobian(pos);
        }
        case CENTRAL: {
            slope = by_central_differences(pos);
        }
        case SOBEL: {
            slope = by_sobel(pos);
        }
        case DOT_PRODUCT: {
            return vec4f(vec3f(0.0), by_dot_product(pos));
        }
        default: {
            return vec4f(vec3f(0.0), 1.0);
        }
    }
    let normal = -slope / max(length(slope), 1e-12);
    return vec4f(normal, max(dot(normal, LIGHT), 0.0));
}

@compute @workgroup_size(64)
fn normals(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= arrayLength(&points) {
        return;
    }
    results[id.x] = evaluate_at(points[id.x].xyz);
}

/// A picture by even steps along y, every sample with something in it lit: what a method costs. x: light, w:
/// transmittance.
@compute @workgroup_size(64)
fn march(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= arrayLength(&points) {
        return;
    }
    let start = points[id.x].xyz;
    var clear = 1.0;
    var light = 0.0;
    let step = subject.detail;
    for (var t = 0.0; t < 1.3; t += step) {
        let pos = start - vec3f(0.0, t, 0.0);
        let opacity = 0.12 * smoothstep(0.1, 0.6, value_at(pos));
        // A loop and not a branch: software devices run both sides of a branch.
        var turns = select(0u, 1u, opacity > 0.001);
        while turns > 0u {
            turns--;
            light += clear * opacity * evaluate_at(pos).w;
        }
        clear *= 1.0 - opacity;
        if clear < 0.01 {
            break;
        }
    }
    results[id.x] = vec4f(light, 0.0, 0.0, clear);
}
