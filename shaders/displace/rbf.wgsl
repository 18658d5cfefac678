// Rbf: displacements at control points, interpolated by multiquadrics and a linear part; a cut decouples its two sides.
// Template space.
// Source: Correa, section 4.6.2, eq. 4.32 to 4.36; spec/templates.md.
//
//   1 +-----------+        D(p) = sum a_i (|p - p_i|²/r² + 1)^m + b_0 + B (p - ½)     (Hardy, scaled to 1 at the point)
//     |  o→   /   |
//     |     P/  o |        left of the cut (P) by the points that lie there, right of it (Q) by the others;
//     | o   / Q   |        A: how far the source lies on the side of the point that is asked for, below 0 beyond the
//     cut
//   0 +----/------+
//     0     ½     1
//
// Where m is above 0: (|p - p_i|² + r²)^m, which is the most exact where it is largest.
//
// Differs from the source: A is a distance and not 0 or 1, so that the cut is found by bisection and has a normal; 1
// where nothing is displaced. What the sum misses at a point, where points lie too close for 32 bits, is added in a
// bump (1 - |p - p_i|²/w²)³ up to the next point. Solved by the processor (src/displace/interpolant.rs), which leaves
// in `templates.pool`, from `held` on:
//   points and bumps of P, those of Q, pieces of the cut;  per side b_0, B x, B y, B z, then a place (w: 0, or 1/w² of
//   a bump) and a coefficient per point;  per piece a and b
// Beyond the faces at rest; `edge` brings the displacement to 0 there.
// needs: types.wgsl bind/templates.wgsl displace/frame.wgsl

/// Signed distance to the cut (`count` pieces from `first` on), whose first and last pieces go on straight: above 0 on
/// its left.
fn distance_to_cut(p: vec2f, first: u32, count: u32) -> f32 {
    var nearest = NO_END;
    var across = 0.0;
    for (var i = 0u; i < count; i++) {
        let piece = templates.pool[first + i];
        let along = piece.zw - piece.xy;
        let way = p - piece.xy;
        let t = dot(way, along);
        let perpendicular = (along.x * way.y - along.y * way.x) / length(along);
        var away = abs(perpendicular);
        if t < 0.0 && i > 0u {
            away = length(way);
        } else if t > dot(along, along) && i + 1u < count {
            away = length(p - piece.zw);
        }
        // Two pieces that share the nearest place: the one that the point lies more to the side of says which side.
        if away < nearest || (away == nearest && abs(perpendicular) > abs(across)) {
            nearest = away;
            across = perpendicular;
        }
    }
    return select(nearest, -nearest, across < 0.0);
}

/// 0 at the faces, 1 from `edge` on.
fn inner_weight(q: vec3f, edge: f32) -> f32 {
    if edge <= 0.0 {
        return 1.0;
    }
    let t = clamp(min(q, 1.0 - q) / edge, vec3f(0.0), vec3f(1.0));
    let s = t * t * (3.0 - 2.0 * t);
    return s.x * s.y * s.z;
}

/// A power of a number above 0; where there is a function of its own it has less noise.
fn power(x: f32, exponent: f32) -> f32 {
    if exponent == -0.5 {
        return inverseSqrt(x);
    }
    if exponent == 0.5 {
        return sqrt(x);
    }
    return pow(x, exponent);
}

/// p0: strength, softness, exponent, extrude. p1: falloff, edge. held: index in the pool.
fn displace_rbf(q: vec3f, size: vec3f, p0: vec4f, p1: vec4f, held: u32) -> Displaced {
    let first = held;
    let counts = vec3u(templates.pool[first].xyz);
    if is_beyond(q, vec3f(0.0), vec3f(1.0)) || counts.x + counts.y == 0u || p0.x == 0.0 {
        return at_rest(q);
    }
    let is_flat = p0.w > 0.5;
    let at = select(q, vec3f(q.xy, 0.5), is_flat);
    let has_cut = counts.z > 0u;
    // A cut adds the second side's linear part.
    let second = first + 5u + 2u * counts.x;
    let cut = second + 4u + 2u * counts.y;
    var side = 1.0;
    var from_index = first + 1u;
    var count = counts.x;
    if has_cut && distance_to_cut(q.xy, cut, counts.z) < 0.0 {
        side = -1.0;
        from_index = second;
        count = counts.y;
    }
    let middle = at - 0.5;
    var sum = templates.pool[from_index].xyz
        + templates.pool[from_index + 1u].xyz * middle.x
        + templates.pool[from_index + 2u].xyz * middle.y
        + templates.pool[from_index + 3u].xyz * middle.z;
    let exponent = select(p0.z, -0.05, abs(p0.z) < 0.05);
    let grows = exponent > 0.0;
    let inverse = select(1.0 / (p0.y * p0.y), 1.0, grows);
    let least = select(1.0, p0.y * p0.y, grows);
    for (var i = 0u; i < count; i++) {
        let center = templates.pool[from_index + 4u + 2u * i];
        let way = at - center.xyz;
        let square = dot(way, way);
        var part = 0.0;
        if center.w == 0.0 {
            part = power(square * inverse + least, exponent);
        } else {
            let near = max(1.0 - square * center.w, 0.0);
            part = near * near * near;
        }
        sum += templates.pool[from_index + 5u + 2u * i].xyz * part;
    }
    let across = select(1.0, falloff_weight(abs(q.z - 0.5), p1.x), is_flat);
    let moved = sum * (p0.x * across * inner_weight(q, p1.y));
    if !has_cut || dot(moved, moved) < CLOSED * CLOSED {
        return Displaced(q + moved, 1.0);
    }
    let source = q + moved;
    return Displaced(source, side * distance_to_cut(source.xy, cut, counts.z));
}
