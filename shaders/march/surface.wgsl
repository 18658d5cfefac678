// The surface at a sample: its normal, and whether it is a surface of tissue, of a cut or of kept tissue (Correa,
// sections 4.5.2 and 4.5.3).
// needs: types.wgsl affine.wgsl bind/subject.wgsl bind/look.wgsl march/overrides.wgsl march/value.wgsl
// march/bodies.wgsl
//   march/sample.wgsl march/jacobian.wgsl march/interface.wgsl march/plain.wgsl|march/align.wgsl|march/baked.wgsl

/// A continuity steeper than this jumps at a rest face (from 0.25 to 1 at a hole's, say), which is no cut. Cuts have
/// slopes of one over the template's size, a peeler's at most a hundred times that.
const MAX_SLOPE: f32 = 250.0;

/// A cut face near a point: of a template, or the end of the scan.
struct Cut {
    /// Out of the material, subject space, unit.
    normal: vec3f,
    /// 0 to 1: how much the point lies on the face.
    weight: f32,
    /// Slope of the continuity, per subject unit.
    slope: f32,
    /// True if that is the slope of a cut.
    is_cut: bool,
}

/// The surface at a point.
struct Surface {
    /// Unit, towards the eye, subject space.
    normal: vec3f,
    /// 0 haze to 1 surface.
    surfaceness: f32,
    /// Gradient of the normalised value at rest, per voxel; of the shares where a body is.
    gradient: vec3f,
    /// Length of the gradient as a part of the whole transfer table: at rest, and in subject space.
    steepness: f32,
    steepness_seen: f32,
    /// Part of the tissue at the point that belongs to bodies, 0 to 1.
    body_share: f32,
    /// How much of the point is a cut face that is seen, 0 to 1.
    cut_weight: f32,
    /// How much of the point is an edge whatever its gradient, 0 to 1: a cut face or the surface of kept tissue.
    edge_weight: f32,
    /// Where segments are looked up, rest space.
    tint_pos: vec3f,
    /// How far above the point its light is looked for, subject units.
    lift: f32,
}

/// The cut face near a sample whose texture coordinate is `uvw`.
fn cut_at(uvw: vec3f, map: Differential, to_eye: vec3f) -> Cut {
    let slope = length(map.slope);
    let distance = map.continuity / max(slope, 1e-6);
    let is_cut = slope > 1e-3 && slope < MAX_SLOPE;
    var weight = select(0.0, 1.0 - smoothstep(0.25, 1.0, distance / subject.detail), is_cut);
    var normal = -map.slope / max(slope, 1e-9);
    // The scan's own edge is a cut too.
    let end_low = uvw * subject.dims.xyz;
    let end_high = (subject.texture_end.xyz - uvw) * subject.dims.xyz;
    let ends = min(end_low, end_high);
    let end = min(ends.x, min(ends.y, ends.z));
    let end_weight = 1.0 - smoothstep(0.25, 1.0, end);
    if end_weight > weight {
        let end_axis = select(vec3f(0.0), select(vec3f(1.0), vec3f(-1.0), end_low < end_high), ends == vec3f(end));
        let end_rest = apply_transposed(subject.texture_from_rest, end_axis);
        normal = normalize(carried_over(map.jacobian, end_rest) + to_eye * 1e-6);
        weight = end_weight;
    }
    return Cut(normal, weight, slope, is_cut);
}

/// How far beneath the surface that hidden tissue leaves bare its colour is taken from, voxels.
const BARED_DEPTH: f32 = 0.7;

/// The surface at a sample. `to_eye` is a unit vector.
fn surface_at(edge: Sample, uvw: vec3f, map: Differential, cut: Cut, to_eye: vec3f) -> Surface {
    // Gradient of the value carried over by the transposed Jacobian ...
    var gradient = gradient_at(uvw);
    var body_share = 0.0;
    var tint_pos = edge.pos;
    if has_bodies != 0u {
        // The surface of a body is the surface of its segment, whatever the values there are.
        let own = body_gradient_at(edge.pos);
        let is_edge = smoothstep(0.03, 0.15, length(own));
        gradient = mix(gradient, own / look.table_scale, is_edge);
        let shares = body_at(edge.pos);
        body_share = body_weight(shares);
        // The values half a voxel around a border are those of both sides: what is hidden gives no colour.
        let bared = smoothstep(0.05, 0.25, shares.w) * is_edge;
        tint_pos += own / max(length(own), 1e-9) * (bared * BARED_DEPTH * subject.detail);
    }
    let carried = carried_over(map.jacobian, gradient);
    let steepness = length(gradient) * look.table_scale;
    var normal = carried / max(length(carried), 1e-9);
    normal = select(-normal, normal, dot(normal, to_eye) >= 0.0);
    var surfaceness = smoothstep(0.004, 0.03, steepness);
    // ... blended into the normal of a cut near it. A cut face is an edge too, as steep as the tissue there is dense
    // (equation 6.3): where the cut goes through a hole, no face appears. A cut that faces away is not the face that is
    // seen.
    var edge_weight = cut.weight;
    let cut_weight = cut.weight * smoothstep(-0.02, 0.08, dot(cut.normal, to_eye));
    normal = normalize(mix(normal, cut.normal, cut_weight) + to_eye * 1e-5);
    surfaceness = max(surfaceness, cut_weight);
    // Both sides of the surface of kept tissue take their normal from it.
    var lift = 0.0;
    if KEEPS_TISSUE {
        let kept = kept_surface(edge.pos, map.path, map.jacobian, to_eye);
        normal = normalize(mix(normal, kept.normal, kept.weight) + to_eye * 1e-5);
        surfaceness = max(surfaceness, kept.weight);
        edge_weight = max(edge_weight, kept.weight);
        tint_pos += kept.inwards;
        // Labels end in stairs, the normal is smooth: what stands in its light is looked for from above the stairs.
        lift = kept.weight * subject.detail;
    }
    return Surface(
        normal,
        surfaceness,
        gradient,
        steepness,
        length(carried) * look.table_scale,
        body_share,
        cut_weight,
        edge_weight,
        tint_pos,
        lift,
    );
}
