// What a ray gathers on its way, whatever it meets: light from front to back, the ray's surface, and where the ray
// turns more than half opaque.
// needs: types.wgsl bind/look.wgsl march/shade.wgsl march/marched.wgsl

/// Transmittance at which a ray ends: below half a level of 255.
const OPAQUE: f32 = 0.002;
/// Contribution that makes something the ray's surface: occlusion, shadow and picking are for that one.
const SURFACE_SHARE: f32 = 0.3;

/// What a ray has gathered so far.
struct Gathered {
    /// Its colour is set at the end.
    found: Marched,
    /// Linear RGB, premultiplied.
    color: vec3f,
    /// How much of what comes is still seen, 0 to 1; 0 once the ray has ended.
    clear: f32,
    /// Light of the ray's surface, which shadow and occlusion act on.
    light: Lit,
    /// How far above the ray's surface they are looked for, subject units.
    lift: f32,
}

/// Something on a ray.
struct Seen {
    event: Event,
    /// Normal that it is shaded by: unit, towards the eye, subject space.
    normal: vec3f,
    /// Light that it would send to the eye if it were opaque.
    light: Lit,
    /// How much of what is behind it takes, 0 to 1.
    opacity: f32,
    /// See `Gathered`.
    lift: f32,
}

/// A ray at its start.
fn nothing_gathered() -> Gathered {
    var gathered: Gathered;
    gathered.found.surface_t = -1.0;
    gathered.clear = 1.0;
    return gathered;
}

/// Adds what comes next on a ray.
fn gather(gathered: ptr<function, Gathered>, seen: Seen) {
    let clear = (*gathered).clear;
    let weight = clear * seen.opacity;
    (*gathered).color += weight * (seen.light.key + seen.light.ambient);
    if (*gathered).found.surface_t < 0.0 && weight > SURFACE_SHARE * (0.25 + 0.75 * clear) {
        (*gathered).found.surface_t = seen.event.t;
        (*gathered).found.surface_normal = seen.normal;
        (*gathered).found.surface_rest = seen.event.rest;
        (*gathered).found.surface_what = seen.event.what;
        (*gathered).found.segment = seen.event.segment;
        (*gathered).light = Lit(seen.light.key * weight, seen.light.ambient * weight);
        (*gathered).lift = seen.lift;
    }
    let left = clear * (1.0 - seen.opacity);
    if left < 0.5 && (*gathered).found.event.what == MET_NOTHING {
        (*gathered).found.event = seen.event;
    }
    (*gathered).clear = select(left, 0.0, left < OPAQUE);
}

/// What stands in the light of a surface.
struct Surroundings {
    /// How open they are, 0 to 1.
    openness: f32,
    /// How much of the key light arrives, 0 to 1.
    key_light: f32,
}

/// How much of the key light occlusion takes, as a part of what it takes from the other.
const CONTACT_KEY: f32 = 0.3125;

/// What shadow and occlusion take from light.
fn taken_from(light: Lit, around: Surroundings) -> vec3f {
    let closed = 1.0 - around.openness;
    let lit = around.key_light;
    return light.key * (1.0 - lit) + light.ambient * (look.contact * closed) + light.key * lit * (CONTACT_KEY * look.contact * closed);
}
