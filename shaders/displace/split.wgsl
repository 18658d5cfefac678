// Split: two halves apart along x. Template space.
// Source: Correa, appendix C, as in spec/templates.md.
//
//   z
//   1 +-----.       .-----+     carries upwards, and along y; in x the formula holds beyond the cube
//     |      \(gap)/      |
//     |       \   /       |     wedge: closed at the bottom (rest below)
//   0 +--------\./--------+     else as wide below as above, and carried downwards too
//     0         ½         1  x
//
// needs: displace/frame.wgsl

/// p0: amount, lens, wedge (0 or 1).
fn displace_split(q: vec3f, size: vec3f, p0: vec4f, p1: vec4f) -> Displaced {
    let is_wedge = p0.z > 0.5;
    if is_wedge && q.z < 0.0 {
        return at_rest(q);
    }
    let c = in_cube(q);
    let from_middle = 2.0 * c.y - 1.0;
    let opening = p0.x * select(1.0, c.z, is_wedge) * (1.0 - p0.y * from_middle * from_middle);
    // In the gap everything comes from the middle plane.
    let moved = clamp(0.5 - q.x, -opening, opening);
    let continuity = select(abs(q.x - 0.5) - opening, 1.0, opening < CLOSED);
    return Displaced(vec3f(q.x + moved, q.yz), continuity);
}
