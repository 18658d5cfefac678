// How the map changes around a point of the deformed space.
// needs: types.wgsl kinds.wgsl displace/curve.wgsl displace/compose.wgsl march/sample.wgsl
//   march/plain.wgsl|march/align.wgsl|march/baked.wgsl

/// Columns of the Jacobian longer than this come from a jump of the map, not from tissue. A sweep has no jump, and what
/// is pressed together by ten coatings is stretched by a hundred.
const MAX_STRETCH: f32 = 12.0;

/// How the map changes around a point.
struct Differential {
    /// Takes a step in subject space to one in rest space.
    jacobian: mat3x3f,
    /// The continuity at the point.
    continuity: f32,
    /// Gradient of the continuity, subject space.
    slope: vec3f,
    /// The templates along which differences were taken.
    path: u32,
}

/// One-sided differences of the map and of the continuity at a point, forward along the ray: into the material. On a
/// face that is seen obliquely an axis of the ray may lead out of the material, where the map may leap to other tissue:
/// there the difference is taken backward. `edge` is the sample at the point, `mask` the templates that may reach it.
fn differential_at(pos: vec3f, forward: vec3f, edge: Sample, mask: u32) -> Differential {
    var col0 = vec3f(1.0, 0.0, 0.0);
    var col1 = vec3f(0.0, 1.0, 0.0);
    var col2 = vec3f(0.0, 0.0, 1.0);
    var slope = vec3f(0.0);
    var base = Mapped(edge.pos, edge.continuity);
    var path = 0u;
    if drawn_kinds != 0u {
        // First the point itself: the edge may have been sampled in a cell of another mask, and continuities of
        // different masks have no difference.
        path = mask;
        if KEEPS_TISSUE {
            path = edge.path;
        }
        // A spline has another shape for its slopes than for its places: there the point itself is asked anew too.
        let has_base = KEEPS_TISSUE && (drawn_kinds & DRAWN_CURVES) == 0u;
        var turn = select(4u, select(0u, 1u, has_base), path != 0u);
        rounds_splines = true;
        let may_leap = KEEPS_TISSUE || (drawn_kinds & ~(DRAWN_SWEEP | DRAWN_CURVES | DRAWN_OF_SWEEPS)) != 0u;
        var is_back = false;
        while turn < 4u {
            let toward = select(forward, -forward, is_back) * map_step();
            let along = select(vec3f(0.0), toward, vec3u(1u, 2u, 3u) == vec3u(turn));
            let moved = map_along(pos + along, path);
            if turn == 0u {
                base = moved;
            }
            let way = select(along.x + along.y + along.z, 1.0, turn == 0u);
            let column = (moved.pos - base.pos) / way;
            let change = (moved.continuity - base.continuity) / way;
            let leaps = may_leap && dot(column, column) >= MAX_STRETCH * MAX_STRETCH;
            if leaps && !is_back && turn != 0u {
                is_back = true;
                continue;
            }
            is_back = false;
            if !leaps {
                col0 = select(col0, column, turn == 1u);
                col1 = select(col1, column, turn == 2u);
                col2 = select(col2, column, turn == 3u);
            }
            slope = select(slope, vec3f(change), vec3u(1u, 2u, 3u) == vec3u(turn));
            turn++;
        }
        rounds_splines = false;
    }
    return Differential(mat3x3f(col0, col1, col2), base.continuity, slope, path);
}

/// A gradient in rest space carried over to subject space, by the transposed Jacobian (equation 4.10).
fn carried_over(jacobian: mat3x3f, gradient: vec3f) -> vec3f {
    return vec3f(dot(jacobian[0], gradient), dot(jacobian[1], gradient), dot(jacobian[2], gradient));
}
