// Pictures on the triangles of a mesh, in the texture that holds the triangles.
//
// Texels of the pictures; the first is at `at`, and places are counted from there:
//   triangle    places in the picture of the first corner and of the second | of the third, picture or 0 for none, 0
//   picture     width, height, how it goes on outside along u and v and number of copies (8 bits each), pixels
//   pixels      four in a texel, sRGB, row by row from the top; each copy begins with a texel of its own
// A copy is half as large as the one before, and made in linear light. Filtering is done in linear light as well.
// needs: srgb.wgsl triangles.wgsl

/// How a picture goes on outside 0 to 1: again, mirrored every second time, or with the colour of its border.
const WRAP_REPEAT: u32 = 0u;
const WRAP_MIRROR: u32 = 1u;
const WRAP_CLAMP: u32 = 2u;

/// Where a pixel of the picture lies on a triangle: the weights of the corners, and how these change to the pixel on
/// the right and to the one below; 0 where no smaller copies are wanted.
struct Footprint {
    weights: vec3f,
    right: vec3f,
    down: vec3f,
}

/// A place of a triangle alone, which the picture itself answers for.
fn place_alone(weights: vec3f) -> Footprint {
    return Footprint(weights, vec3f(0.0), vec3f(0.0));
}

/// How the weights of a triangle's corners change along a way in its plane.
fn weights_along(a: vec3f, b: vec3f, c: vec3f, way: vec3f) -> vec3f {
    let ab = b - a;
    let ac = c - a;
    let d00 = dot(ab, ab);
    let d01 = dot(ab, ac);
    let d11 = dot(ac, ac);
    let to_ab = dot(way, ab);
    let to_ac = dot(way, ac);
    let whole = max(d00 * d11 - d01 * d01, 1e-30);
    let v = (d11 * to_ab - d01 * to_ac) / whole;
    let w = (d00 * to_ac - d01 * to_ab) / whole;
    return vec3f(-v - w, v, w);
}

/// From a place in a plane to the plane's place on the ray of another pixel. `along` is the direction of the ray,
/// `aside` the way to the other ray.
fn aside_on_plane(normal: vec3f, along: vec3f, aside: vec3f) -> vec3f {
    let steep = dot(normal, along);
    let least = 1e-3 * length(normal) * length(along);
    let kept = select(steep, select(-least, least, steep >= 0.0), abs(steep) < least);
    return aside - along * (dot(normal, aside) / kept);
}

/// The texel that stands for one outside of a picture, along one axis.
fn wrapped(texel: f32, size: f32, wrap: u32) -> u32 {
    let period = select(size, 2.0 * size, wrap == WRAP_MIRROR);
    var inside = texel - period * floor(texel / period);
    // Quotients may be rounded to the wrong side of a whole number.
    inside = select(inside, inside - period, inside >= period);
    if wrap == WRAP_MIRROR {
        inside = min(inside, period - 1.0 - inside);
    }
    if wrap == WRAP_CLAMP {
        inside = texel;
    }
    return u32(clamp(inside, 0.0, size - 1.0));
}

fn picture_texel(texels: texture_2d<u32>, index: u32) -> vec4u {
    return textureLoad(texels, vec2u(index % MESH_ROW, index / MESH_ROW), 0);
}

/// Linear RGB of a copy of a picture at a place, 0 to 1: bilinear between four pixels.
fn filtered(texels: texture_2d<u32>, pixels_at: u32, size: vec2u, wraps: u32, uv: vec2f) -> vec3f {
    let place = uv * vec2f(size) - 0.5;
    let low = floor(place);
    let part = place - low;
    var sum = vec3f(0.0);
    for (var corner = 0u; corner < 4u; corner++) {
        let side = vec2f(f32(corner & 1u), f32(corner >> 1u));
        let x = wrapped(low.x + side.x, f32(size.x), wraps & 255u);
        let y = wrapped(low.y + side.y, f32(size.y), (wraps >> 8u) & 255u);
        let index = x + size.x * y;
        let packed = picture_texel(texels, pixels_at + (index >> 2u))[index & 3u];
        let weights = mix(1.0 - part, part, side);
        sum += weights.x * weights.y * linear_from_srgb(unpack4x8unorm(packed).rgb);
    }
    return sum;
}

/// Linear RGB of the picture on a triangle; white where there is none.
fn picture_on(texels: texture_2d<u32>, at: u32, triangle: u32, footprint: Footprint) -> vec3f {
    let second = picture_texel(texels, at + 2u * triangle + 1u);
    if at == 0u || second.z == 0u {
        return vec3f(1.0);
    }
    let first = bitcast<vec4f>(picture_texel(texels, at + 2u * triangle));
    let places = mat3x2f(first.xy, first.zw, bitcast<vec2f>(second.xy));
    let picture = picture_texel(texels, at + second.z);
    let size = vec2f(picture.xy);
    let right = (places * footprint.right) * size;
    let down = (places * footprint.down) * size;
    // A pixel covers about an ellipse. Of a long one twice the width counts: samples in the pixel do the rest.
    let longest = max(dot(right, right), dot(down, down));
    let area = right.x * down.y - right.y * down.x;
    let covered = max(area * area / max(longest, 1e-20), 0.25 * longest);
    let last = f32(picture.z >> 16u) - 1.0;
    let level = clamp(0.5 * log2(max(covered, 1e-12)), 0.0, last);
    var pixels_at = at + picture.w;
    var copy_size = picture.xy;
    var color = vec3f(0.0);
    for (var copy = 0u; copy <= u32(last); copy++) {
        let share = max(1.0 - abs(level - f32(copy)), 0.0);
        if share > 0.0 {
            color += share * filtered(texels, pixels_at, copy_size, picture.z, places * footprint.weights);
        }
        pixels_at += (copy_size.x * copy_size.y + 3u) / 4u;
        copy_size = max(copy_size / 2u, vec2u(1u));
    }
    return color;
}
