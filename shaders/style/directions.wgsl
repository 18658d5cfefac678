// Directions on the tissue that strokes follow: fields of the undeformed subject, so that strokes ride along with every
// displacement. All vectors in rest space.
// needs: types.wgsl bind/frame.wgsl bind/style.wgsl style/traced.wgsl

/// A bend so clear, over the length of four strokes' spacing, has as much say in the direction as the axis: on a ball
/// no direction bends most, and what is measured there is noise.
const FORMLESS: f32 = 0.25;

/// The surface around a pixel, as it lay at rest.
struct Patch {
    rest: vec3f,
    /// Where the next pixels to the right and below are on it.
    right: vec3f,
    down: vec3f,
    /// Unit, across the surface.
    normal: vec3f,
    /// Unit, in the surface: along the strokes, and across them.
    along: vec3f,
    across: vec3f,
    /// False where no neighbour tells how it lies.
    is_known: bool,
}

/// The shorter of the ways to two neighbours: the other one may lead over an edge.
fn shorter_way(here: vec3f, before: vec4f, behind: vec4f) -> vec3f {
    let back = here - before.xyz;
    let on = behind.xyz - here;
    let takes_back = behind.w < 0.0 || (before.w >= 0.0 && dot(back, back) < dot(on, on));
    return select(on, back, takes_back);
}

/// Curvature along one way over the surface: where it leads, as a place in the basis, and its height off the plane.
struct Bent {
    at: vec2f,
    height: f32,
}

/// The direction of the largest curvature: as a doubled angle in the basis, whose length tells how clear it is. A form
/// h = a x² + 2 b xy + c y² is fitted to the heights over four ways through the pixel.
fn curvature_at(pixel: vec2i, here: vec3f, basis: mat3x3f, reach: f32, longest: f32) -> vec2f {
    var ways = array<vec2f, 4>(vec2f(1.0, 0.0), vec2f(0.7071, 0.7071), vec2f(0.0, 1.0), vec2f(-0.7071, 0.7071));
    // Normal equations of the three coefficients.
    var m = mat3x3f();
    var v = vec3f(0.0);
    for (var k = 0u; k < 4u; k++) {
        let offset = vec2i(round(ways[k] * reach));
        let before = rest_at(pixel - offset);
        let behind = rest_at(pixel + offset);
        let chord = 0.5 * (behind.xyz - before.xyz);
        let bend = 0.5 * (behind.xyz + before.xyz) - here;
        // A way over an edge says nothing.
        let is_whole = min(before.w, behind.w) >= 0.0 && length(chord) < longest && length(bend) < 0.7 * length(chord);
        let x = dot(chord, basis[0]);
        let y = dot(chord, basis[1]);
        let size = max(x * x + y * y, 1e-12);
        let row = vec3f(x * x, 2.0 * x * y, y * y) / size;
        let weight = select(0.0, 1.0, is_whole);
        m += weight * mat3x3f(row * row.x, row * row.y, row * row.z);
        v += weight * row * (dot(bend, basis[2]) / size);
    }
    let scale = determinant(m);
    if abs(scale) < 1e-5 {
        return vec2f(0.0);
    }
    let a = determinant(mat3x3f(v, m[1], m[2])) / scale;
    let b = determinant(mat3x3f(m[0], v, m[2])) / scale;
    let c = determinant(mat3x3f(m[0], m[1], v)) / scale;
    // The doubled angle of the larger eigenvalue; of the other one where that bends more.
    let doubled = vec2f(a - c, 2.0 * b);
    return select(doubled, -doubled, a + c < 0.0);
}

/// The surface around a pixel, and the direction of strokes on it. `turn` turns the strokes in the surface, radians.
fn patch_at(pixel: vec2i, here: Shown, turn: f32) -> Patch {
    var found: Patch;
    found.rest = here.rest;
    let left = rest_at(pixel - vec2i(1, 0));
    let right = rest_at(pixel + vec2i(1, 0));
    let above = rest_at(pixel - vec2i(0, 1));
    let below = rest_at(pixel + vec2i(0, 1));
    found.right = shorter_way(here.rest, left, right);
    found.down = shorter_way(here.rest, above, below);
    let across = cross(found.right, found.down);
    let area = length(across);
    found.is_known = area > 1e-14 && max(left.w, right.w) >= 0.0 && max(above.w, below.w) >= 0.0;
    found.normal = select(vec3f(0.0, 0.0, 1.0), across / max(area, 1e-20), found.is_known);
    let axis = style.axes[min(here.segment, 255u)].xyz;
    var in_plane = axis - found.normal * dot(axis, found.normal);
    let tilt = length(in_plane);
    if tilt < 1e-3 {
        in_plane = cross(found.normal, vec3f(0.577, 0.577, 0.577));
    }
    let x = normalize(in_plane);
    let y = cross(found.normal, x);
    var doubled = vec2f(1.0, 0.0);
    if style.hatch_by == HATCH_CURVATURE {
        let reach = max(style.hatch_spacing_px, 4.0);
        let unit = max(length(found.right), length(found.down));
        // Where nothing bends the axis decides.
        let bends = curvature_at(pixel, here.rest, mat3x3f(x, y, found.normal), reach, 6.0 * reach * unit);
        doubled = bends * (4.0 * reach * unit) + FORMLESS * tilt * vec2f(1.0, 0.0);
    }
    let angle = 0.5 * atan2(doubled.y, doubled.x) + turn;
    found.along = x * cos(angle) + y * sin(angle);
    found.across = cross(found.normal, found.along);
    return found;
}
