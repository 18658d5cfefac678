// Tissue that fades with its distance to what was opened.
// needs: types.wgsl affine.wgsl bind/templates.wgsl

/// From the box of a template on tissue fades, and so far away it has faded, subject units.
const VIGNETTE_NEAR: f32 = 0.03;
const VIGNETTE_FAR: f32 = 0.45;

/// How far tissue has faded at a place of subject space, 0 to 1.
fn faded_at(pos: vec3f) -> f32 {
    var nearest = VIGNETTE_FAR;
    for (var i = 0u; i < templates.count; i++) {
        let at = apply_affine(templates.items[i].template_from_subject, pos);
        let beside = max(abs(at - 0.5) - 0.5, vec3f(0.0)) * templates.items[i].size.xyz;
        nearest = min(nearest, length(beside));
    }
    return select(smoothstep(VIGNETTE_NEAR, VIGNETTE_FAR, nearest), 0.0, templates.count == 0u);
}
