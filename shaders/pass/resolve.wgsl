// From the accumulated picture (linear, premultiplied) to the one that is shown: background, sRGB. Also enlarges the
// quick small picture that is shown while anything moves.
// needs: types.wgsl srgb.wgsl

/// Where the source lies in its texture, and the background behind the picture.
@group(3) @binding(0) var<uniform> resolve: Resolve;
/// The accumulated picture, linear premultiplied RGBA.
@group(3) @binding(1) var source: texture_2d<f32>;
/// Linear filter, clamped at the edges of the picture.
@group(3) @binding(2) var source_sampler: sampler;

/// Light above this is rolled off instead of cut, so that highlights keep their colour; below it nothing changes.
const SHOULDER: f32 = 0.75;

/// Rolls off values brighter than SHOULDER: the slope is 1 at SHOULDER, and the result is never above 1.
fn roll_off(c: vec3f) -> vec3f {
    let over = max(c - SHOULDER, vec3f(0.0)) / (1.0 - SHOULDER);
    return min(c, vec3f(SHOULDER)) + (1.0 - SHOULDER) * (over / (1.0 + over));
}

/// The colour as it is shown, still linear.
fn shown(c: vec3f) -> vec3f {
    if resolve.is_unlit == 1u {
        return c;
    }
    return roll_off(c);
}

/// One triangle that covers everything.
@vertex
fn cover(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    return vec4f(f32(index & 1u) * 4.0 - 1.0, f32(index >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}

/// What is accumulated at a pixel. A finished picture is taken texel by texel: a filter that is off by a rounding mixes
/// in neighbours, and others where the picture is drawn in bands.
fn found_at(at: vec2f) -> vec4f {
    if resolve.is_straight == 1u {
        return textureLoad(source, vec2i(at), 0);
    }
    let uv = min(at * resolve.scale, resolve.end);
    return textureSampleLevel(source, source_sampler, uv, 0.0);
}

/// sRGB, premultiplied after encoding (what egui blends) or straight (what PNG holds).
@fragment
fn encode(@builtin(position) at: vec4f) -> @location(0) vec4f {
    let found = found_at(at.xy);
    let alpha = clamp(found.a, 0.0, 1.0);
    if resolve.background.a > 0.5 {
        let object = shown(found.rgb / max(alpha, 1e-4)) * alpha;
        return vec4f(srgb_from_linear(object + resolve.background.rgb * (1.0 - alpha)), 1.0);
    }
    let color = srgb_from_linear(shown(found.rgb / max(alpha, 1e-4)));
    return vec4f(select(color * alpha, color, resolve.is_straight == 1u), alpha);
}
