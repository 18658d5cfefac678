// Opacity along a ray: over a length, under a deformation (Correa, section 4.5.4) and at edges (section 6.1).
// needs: types.wgsl bind/look.wgsl

/// Opacity is given for this length, subject units (spec/contract.md, "Transfer functions").
const OPACITY_LENGTH: f32 = 0.01;
/// Opacity of 0.01 units below which a sample is nothing.
const VISIBLE: f32 = 0.0005;
/// Steepness of the value (of the whole transfer table, per voxel) from which on an edge shows, and at which it is as
/// opaque as the table says. The scan's noise lies below the first.
const EDGE_NONE: f32 = 0.006;
const EDGE_FULL: f32 = 0.09;

/// Transmittance of a length (subject units, adjusted) of this opacity. From 0.999 on it is a wall.
fn transmittance(opacity: f32, length: f32) -> f32 {
    let clear = 1.0 - opacity;
    let part = pow(max(clear, 1e-6), length / OPACITY_LENGTH);
    return select(part, 0.0, clear < 0.0011 && length > 0.0);
}

/// How much of its opacity a place keeps if opacity follows the gradient (equation 6.2), 0 to 1.
fn edge_gain(steepness: f32) -> f32 {
    return mix(1.0, smoothstep(EDGE_NONE, EDGE_FULL, steepness), look.edges);
}

/// |J v|: how much rest space one unit along a direction goes through. `jacobian` takes steps in subject space to rest
/// space.
fn stretch_along(jacobian: mat3x3f, dir: vec3f) -> f32 {
    return length(jacobian[0] * dir.x + jacobian[1] * dir.y + jacobian[2] * dir.z);
}

/// Factor on lengths by which opacity follows the deformation (equations 4.23 and 4.30).
fn opacity_exponent(jacobian: mat3x3f, dir: vec3f) -> f32 {
    var exponent = 1.0;
    if look.opacity_mode == OPACITY_CONSTANCY {
        exponent = stretch_along(jacobian, dir);
    } else if look.opacity_mode == OPACITY_MASS {
        exponent = abs(dot(jacobian[0], cross(jacobian[1], jacobian[2])));
    }
    return exponent;
}
