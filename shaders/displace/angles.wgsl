// Sine, cosine and arc tangent to a few units in the last place, and the unrolling of an arc.
//
// WGSL allows sin and cos an absolute error of 2^-11 and atan2 4096 ulp (WGSL, "Floating point accuracy"); a template
// turns material as far as twice the longest side of a subject, so that bound alone would be 1e-3 of a subject unit.
// These do without the built-ins: a reduction in two steps, then polynomials that interpolate at Chebyshev nodes.
// Errors over the reduced range: sine 1.1e-8, cosine 1.1e-9, arc tangent 3.2e-8, all below the rounding of f32.
//
// needs: -

const PI: f32 = 3.14159265358979;
const TAU: f32 = 6.28318530717959;
const HALF_PI: f32 = 1.57079632679490;
const QUARTER_PI: f32 = 0.785398163397448;

/// Sine (x) and cosine (y) of an angle in radians, |angle| up to a few hundred.
fn sin_cos(angle: f32) -> vec2f {
    // The quarter turns are taken off in two parts: the first has 8 significant bits, so that n times it is exact.
    let n = round(angle * 0.636619772367581);
    let x = (angle - n * 1.5703125) - n * 4.83826794896558e-4;
    let z = x * x;
    let s = x + x * z * (-0.1666666453998961 + z * (0.008332724732630577 - z * 0.00019582855850856846));
    let c = 1.0 - 0.5 * z + z * z * (0.041666664536946084 + z * (-0.0013888279449649546 + z * 2.4542896337e-5));
    let quarter = i32(n) & 3;
    let swapped = select(vec2f(s, c), vec2f(c, s), (quarter & 1) == 1);
    return vec2f(
        select(swapped.x, -swapped.x, quarter >= 2),
        select(swapped.y, -swapped.y, quarter == 1 || quarter == 2),
    );
}

/// Angle of the point (x, y) from the x axis, in [0, 2 pi); 0 at the origin.
fn turn_of(y: f32, x: f32) -> f32 {
    let ax = abs(x);
    let ay = abs(y);
    let small = min(ax, ay);
    let large = max(ax, ay);
    // Folded to [0, pi/8] by tan(a - pi/4) = (t - 1)/(t + 1), with t = small/large.
    let is_folded = small > 0.414213562373095 * large;
    let numerator = select(small, small - large, is_folded);
    let denominator = select(large, small + large, is_folded);
    // The guard is for the origin, where it gives 0.
    let t = numerator / max(denominator, 1e-30);
    let z = t * t;
    var a = t + t * z * (-0.33333282970920597 + z * (0.19990748772668773 + z * (-0.14014833041099495 + z * 0.08477801109767528)));
    a += select(0.0, QUARTER_PI, is_folded);
    a = select(a, HALF_PI - a, ay > ax);
    a = select(a, PI - a, x < 0.0);
    return select(a, TAU - a, y < 0.0);
}

/// A point of template space in the coordinates along an arc, as `unroll` finds them.
struct Unrolled {
    /// Angle on the arc, radians, 0 to `turn`.
    angle: f32,
    /// Tangential coordinate past the end of the arc, in the arc's end frame.
    along: f32,
    /// Distance from the centre, in the arc's end frame.
    across: f32,
}

/// spec/templates.md, `unroll(u, v, phi)`: coordinates along an arc that starts at (0, v > 0) and runs for `turn`
/// radians towards +u; beyond an end the straight line that continues it, whichever end is nearer around the circle.
fn unroll(u: f32, v: f32, turn: f32) -> Unrolled {
    let around = turn_of(u, v);
    if around <= turn {
        // On the arc the end frame turns with the point.
        return Unrolled(around, 0.0, length(vec2f(u, v)));
    }
    if around - turn < TAU - around {
        let sc = sin_cos(turn);
        return Unrolled(turn, u * sc.y - v * sc.x, u * sc.x + v * sc.y);
    }
    return Unrolled(0.0, u, v);
}
