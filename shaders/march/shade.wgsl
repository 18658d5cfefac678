// Light: a warm key (from the upper left, unless the look says otherwise), a cool fill from the right, a rim from
// behind, all fixed to the camera, as on an illustrator's table. All vectors in view space (camera along -z).
// needs: types.wgsl bind/look.wgsl

/// Direction to the fill light.
const FILL_DIR: vec3f = vec3f(0.780, 0.060, 0.623);
/// Linear RGB strengths; key, fill and sky at a surface that faces all of them add up to about 1, so that colours keep.
const KEY_COLOR: vec3f = vec3f(0.900, 0.862, 0.800);
const FILL_COLOR: vec3f = vec3f(0.130, 0.150, 0.185);
const SKY_COLOR: vec3f = vec3f(0.200, 0.212, 0.235);
const GROUND_COLOR: vec3f = vec3f(0.120, 0.098, 0.085);
const RIM_COLOR: vec3f = vec3f(0.230, 0.245, 0.270);
/// Larger is glossier and smaller in area.
const SPECULAR_POWER: f32 = 38.0;

/// Light that a surface sends to the eye, in parts that shadow and occlusion act on separately.
struct Lit {
    /// From the key light: a cast shadow takes it away. Linear RGB.
    key: vec3f,
    /// From everywhere else: occlusion takes it away. Linear RGB.
    ambient: vec3f,
}

/// Light from a surface of this colour (linear RGB) and unit normal towards the eye. `to_eye` is a unit vector.
/// `specular` is the strength of the highlight, 0 to 1.
fn shade_surface(albedo: vec3f, normal: vec3f, to_eye: vec3f, specular: f32) -> Lit {
    let n_dot_v = clamp(dot(normal, to_eye), 0.0, 1.0);
    let wrap = look.key_wrap.xyz;
    let key = clamp((dot(normal, look.key_dir.xyz) + wrap) / (1.0 + wrap), vec3f(0.0), vec3f(1.0));
    let fill = clamp(dot(normal, FILL_DIR) * 0.6 + 0.4, 0.0, 1.0);
    let sky = mix(GROUND_COLOR, SKY_COLOR, normal.y * 0.5 + 0.5);
    let half_dir = normalize(look.key_dir.xyz + to_eye);
    let shine = specular * pow(clamp(dot(normal, half_dir), 0.0, 1.0), SPECULAR_POWER);
    // The rim is strongest at grazing angles and from above; it takes the surface's colour so that bone stays bone.
    let edge = pow(1.0 - n_dot_v, 3.5);
    let rim = edge * clamp(normal.y * 0.5 + 0.6, 0.0, 1.0);
    var lit: Lit;
    lit.key = albedo * KEY_COLOR * key + KEY_COLOR * shine * smoothstep(0.0, 0.2, key.g);
    lit.ambient = albedo * (sky + FILL_COLOR * fill + RIM_COLOR * rim);
    return lit;
}

/// Light from a sample without a surface (haze): the mean light of a matte sphere, so that haze fits beside surfaces.
fn shade_medium(albedo: vec3f) -> Lit {
    var lit: Lit;
    lit.key = albedo * KEY_COLOR * 0.55;
    lit.ambient = albedo * ((SKY_COLOR + GROUND_COLOR) * 0.5 + FILL_COLOR * 0.5);
    return lit;
}
