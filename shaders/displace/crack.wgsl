// Crack: a jagged or rippled break down from the top, drawn apart along x. Template space.
// Source: Correa, section 7.5.1, with the formula of spec/surfaces.md.
//
//   z  section across                 y  from above
//   1 +-----.    .----+             1 +------.------+
//     |     _)   _)   |               |     ( )     |     lens: closes both ends in y
//     |      \ gap\   |               |    _)  _)   |     roughness, grain, seed: the teeth; the walls fit into each
//     |      (_  (_   |               |     \   \   |     other
//     |        \/     |               |      (_/    |     ripple, cycles: waves along y, or, below 0, along z
//   0 +---------------+             0 +------'------+
//     0       c       1  x            0             1  x
//
// Carries z high. Beyond the other faces tissue stays at rest. Tears at the faces in y where `lens` is below 1.
// needs: displace/frame.wgsl displace/angles.wgsl displace/noise.wgsl

/// The middle of the crack keeps away from the sides in x by this much.
const CRACK_MARGIN: f32 = 0.05;
/// The opening takes at most this part of the room between the middle and a side.
const CRACK_MOST: f32 = 0.9;

/// Where the middle of the crack lies in x, at a place of the cube.
fn crack_middle(y: f32, z: f32, size: vec3f, p0: vec4f, p1: vec4f) -> f32 {
    var middle = 0.5;
    if p0.w > 0.0 {
        let tall = size.z / max(size.y, 1e-30);
        middle += p0.w * noise(vec2f(y, z * tall) / max(p1.x, 1e-6), u32(max(p1.y, 0.0) + 0.5));
    }
    if p1.z > 0.0 {
        // Whole turns are taken off first: sines of small angles are as exact as the angles.
        let turns = abs(p1.w) * select(z, y, p1.w >= 0.0);
        middle += p1.z * sin_cos(TAU * (turns - round(turns))).x;
    }
    return clamp(middle, CRACK_MARGIN, 1.0 - CRACK_MARGIN);
}

/// How far each wall of the crack goes where it has the room, at a place of the cube.
fn crack_opening(y: f32, z: f32, p0: vec4f) -> f32 {
    let from_middle = 2.0 * y - 1.0;
    let deep = clamp((z - 1.0 + p0.z) / max(p0.z, 1e-6), 0.0, 1.0);
    return 0.5 * p0.x * (1.0 - p0.y * from_middle * from_middle) * deep;
}

/// A place just inside of a wall of the crack as it is drawn apart: what goes farthest at this height and depth.
fn wall_of_crack(y: f32, z: f32, is_left: bool, size: vec3f, p0: vec4f, p1: vec4f) -> vec3f {
    let high = min(z, 1.0);
    let middle = crack_middle(y, high, size, p0, p1);
    let room = select(1.0 - middle, middle, is_left);
    let away = min(crack_opening(y, high, p0), CRACK_MOST * room) + 1e-5;
    return vec3f(middle + select(away, -away, is_left), y, z);
}

/// p0: amount, lens, depth, roughness; p1: grain, seed, ripple, cycles.
fn displace_crack(q: vec3f, size: vec3f, p0: vec4f, p1: vec4f) -> Displaced {
    if is_beyond(q, vec3f(0.0), vec3f(1.0, 1.0, NO_END)) {
        return at_rest(q);
    }
    let z = min(q.z, 1.0);
    let wanted = crack_opening(q.y, z, p0);
    if wanted < CLOSED {
        return at_rest(q);
    }
    let middle = crack_middle(q.y, z, size, p0, p1);
    let is_left = q.x < middle;
    let room = select(1.0 - middle, middle, is_left);
    let opening = min(wanted, CRACK_MOST * room);
    let d = abs(q.x - middle);
    // How far from the middle the material came from; at the side of the box nothing moves.
    let source = select(room * (d - opening) / (room - opening), 0.0, d < opening);
    let towards = select(0.0, d - source, d < room);
    return Displaced(vec3f(q.x + select(-towards, towards, is_left), q.yz), d - opening);
}
