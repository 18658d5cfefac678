// What every template shares: the result, the frame's edges, and the fall-off of twist and wave.
//
// needs: -

/// An inverse displacement at one point, in the space of one template (spec/templates.md, "What a template is").
struct Displaced {
    /// Where the material at the point was before, template space.
    source: vec3f,
    /// At least 0: there is material. Below 0: the template opened a gap here. Zero set and sign are the contract, not
    /// the scale.
    continuity: f32,
}

/// Stands for "no end" on an axis that carries.
const NO_END: f32 = 1e30;
/// An opening below this counts as closed (spec/templates.md: "1 where o = 0").
const CLOSED: f32 = 1e-6;

/// A point that the template leaves alone.
fn at_rest(q: vec3f) -> Displaced {
    return Displaced(q, 1.0);
}

/// True beyond a rest end. Faces are inside; an axis end that carries is given as NO_END.
fn is_beyond(q: vec3f, rest_min: vec3f, rest_max: vec3f) -> bool {
    return any(q < rest_min) || any(q > rest_max);
}

/// The nearest point of the unit cube, where axes that carry take their displacement from.
fn in_cube(q: vec3f) -> vec3f {
    return clamp(q, vec3f(0.0), vec3f(1.0));
}

/// Weight of twist and wave at distance `r` from the axis: 1 inside, down to 0 at one half; `falloff` 0 keeps 1
/// everywhere.
fn falloff_weight(r: f32, falloff: f32) -> f32 {
    if falloff <= 0.0 {
        return 1.0;
    }
    // smoothstep from (1 - falloff)/2 to 1/2, written with its width so that a narrow one is guarded.
    let t = clamp((r - 0.5 + 0.5 * falloff) / max(0.5 * falloff, 1e-12), 0.0, 1.0);
    return 1.0 - t * t * (3.0 - 2.0 * t);
}
