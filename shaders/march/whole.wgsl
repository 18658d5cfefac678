// Where other parts of the subject take the place of a volume: nowhere, where there are none.
// This file defines the same functions as march/replaced.wgsl.
// needs: displace/compose.wgsl

/// True where something else is in the volume's place, at a point of rest space.
fn is_replaced(_rest: vec3f) -> bool {
    return false;
}

/// How much of the light at a place other parts of the subject take, 0 to 1.
fn cover_beside(_at: Material) -> f32 {
    return 0.0;
}
