// Outlines: where what neighbouring pixels show does not hang together.
//
//   a depth jump          a line on the nearer side, as wide as the style says
//   a crease, a border    of two segments: half the width on either side
//
// Two places of one smooth surface lie near each other's tangent plane, however obliquely it is seen: on a ball a
// pixel and one r pixels on are at most r/4 pixel lengths off it, up to its silhouette.
// needs: types.wgsl bind/frame.wgsl bind/style.wgsl style/traced.wgsl

/// Directions in which a pixel looks for edges.
const OUTLINE_WAYS: u32 = 8u;

/// True if the way from one shown place to another, so many pixels on, leads over a jump in depth.
fn is_jump(here: Shown, there: Shown, pixels: f32) -> bool {
    let way = there.pos - here.pos;
    let off = min(abs(dot(here.normal, way)), abs(dot(there.normal, way)));
    return off > (1.0 + pixels) * pixel_length(min(here.t, there.t)) + style.detail;
}

/// How much of a pixel the outline covers, 0 or 1. `spin` turns the directions and shifts the places from sample to
/// sample, so that the mean of the samples is smooth and has the width to a part of a pixel.
fn outline_at(pixel: vec2i, here: Shown, spin: f32) -> f32 {
    var covered = 0.0;
    let shift = frame.jitter - 0.5;
    for (var way = 0u; way < OUTLINE_WAYS; way++) {
        let angle = (f32(way) + spin) * (6.2831853 / f32(OUTLINE_WAYS));
        let dir = vec2f(cos(angle), sin(angle)) * style.outline_px;
        for (var part = 2u; part > 0u; part--) {
            let at = vec2i(round(0.5 * f32(part) * dir + shift));
            let there = shown_at(pixel + at);
            let is_here = here.t >= 0.0;
            let is_there = there.t >= 0.0;
            if is_here && is_there {
                let is_border = here.segment != there.segment || dot(here.normal, there.normal) < style.crease_cosine;
                let is_over = is_jump(here, there, length(vec2f(at)));
                // Of a jump the nearer side has the line.
                let is_edge = select(is_border && part == 1u, here.t < there.t, is_over);
                covered = select(covered, 1.0, is_edge);
            } else if is_here {
                covered = 1.0;
            }
        }
    }
    return covered;
}
