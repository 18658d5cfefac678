// Dilate: a bulge at mid height; the frame is drawn in squeeze.wgsl. Template space.
// Source: Correa, appendix C, with edges closed where no tear is meant (spec/templates.md).
//
//   z
//   1 +-------+       rest
//     |       |
//   ½(         )      x and y carry
//     |       |
//   0 +-------+       rest
//     0   ½   1 x
//
// needs: displace/frame.wgsl displace/squeeze.wgsl

/// p0: strength, 0 to 0.9. `q` in template space, as in every template.
fn displace_dilate(q: vec3f, size: vec3f, p0: vec4f, p1: vec4f) -> Displaced {
    return waisted(q, -p0.x);
}
