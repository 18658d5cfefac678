// Opacity that follows the gradient (Correa, section 6.1): how much of its opacity each sample of a stretch keeps.
// needs: types.wgsl bind/subject.wgsl bind/look.wgsl march/overrides.wgsl march/opacity.wgsl march/bodies.wgsl
//   march/value.wgsl march/sample.wgsl march/refine.wgsl march/jacobian.wgsl march/surface.wgsl

/// Shares of their opacity that the parts of a stretch keep, 0 to 1.
struct Gains {
    /// Before the crossing, behind it, and at the second sample itself.
    before: f32,
    behind: f32,
    here: f32,
}

/// The share that the second sample keeps, which lies behind a surface.
fn gain_behind(here: Sample, map: Differential, cut: Cut) -> f32 {
    let uvw = texture_from_rest(here.pos);
    let carried = carried_over(map.jacobian, gradient_at(uvw));
    let inside = min(uvw, subject.texture_end.xyz - uvw) * subject.dims.xyz;
    let away = min(min(inside.x, inside.y), inside.z);
    let from_cut = select(1.0, here.continuity / max(cut.slope, 1e-6) / subject.detail, cut.is_cut);
    let face = 1.0 - smoothstep(0.25, 1.0, min(away, from_cut));
    var gain = edge_gain(mix(length(carried) * look.table_scale, density_of(here), face));
    if has_bodies != 0u {
        gain = mix(gain, 1.0, body_weight(body_at(here.pos)));
    }
    return gain;
}

/// The shares of a stretch. `before` is what the first sample keeps.
fn gains_of(before: f32, here: Sample, crossing: Crossing, map: Differential, surface: Surface, cut: Cut) -> Gains {
    var gains = Gains(before, 1.0, 1.0);
    if has_edges != 0u {
        let steepness = mix(surface.steepness_seen, density_of(crossing.edge), surface.edge_weight);
        gains.behind = mix(edge_gain(steepness), 1.0, surface.body_share);
        gains.here = gains.behind;
        // Behind a surface the layer of its steepness ends within a step: the share is the mean of both ends of the
        // way.
        var turns = select(0u, 1u, crossing.is_jump && crossing.is_rising);
        while turns > 0u {
            turns--;
            gains.here = gain_behind(here, map, cut);
            gains.behind = 0.5 * (gains.behind + gains.here);
        }
        gains.before = select(before, 0.5 * (before + gains.behind), crossing.is_jump && !crossing.is_rising);
    }
    return gains;
}
