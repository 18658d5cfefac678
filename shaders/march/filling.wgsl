// What fills the bodies of a mesh, and the colours of their surfaces, cut faces and layers (spec/surfaces.md, "What
// a body is").
// needs: types.wgsl textures.wgsl bind/subject.wgsl bind/mesh_look.wgsl displace/noise.wgsl march/overrides.wgsl
//   subject/mesh.wgsl

/// Length of the grain of layers, subject units.
const GRAIN_LENGTH: f32 = 0.02;
/// Farther than any triangle is from a place inside.
const FAR_INSIDE: f32 = 2.0;

/// From a place inside of a segment (from 0) to the nearest point of its triangles; w is the distance. The field says
/// how far a search has to go where no other segment is nearer.
fn nearest_inside(rest: vec3f, segment: u32) -> vec4f {
    var within = max(field_at(rest), 0.0) * 1.12 + 1.5 * subject.field_detail;
    var nearest: vec4f;
    loop {
        nearest = to_nearest(rest, within, segment);
        if nearest.w < within || within >= FAR_INSIDE {
            break;
        }
        within *= 4.0;
    }
    return nearest;
}

/// The segment that fills a place, from 1; 0 where there is none. Of several the first one.
fn filled_at(rest: vec3f) -> u32 {
    var left = set_at(rest);
    // Where the field says that all triangles are farther, they are not searched.
    let depth = field_at(rest);
    loop {
        let label = take_segment(&left);
        if label == NO_LABEL {
            break;
        }
        let body = mesh_look.segments[label - 1u];
        var is_filled = body.kind == BODY_FULL;
        if body.kind == BODY_THICK && depth < body.thickness + 0.25 * subject.field_detail {
            is_filled = to_nearest(rest, body.thickness, label - 1u).w < body.thickness;
        }
        if is_filled {
            return label;
        }
    }
    return 0u;
}

/// Linear RGB of a triangle at a point, from its front or its back.
fn surface_color(triangle: u32, footprint: Footprint, is_front: bool) -> vec3f {
    let body = mesh_look.segments[segment_of(triangle)];
    var own = body.color.rgb;
    if body.color.a < 0.0 {
        own = color_of_triangle(triangle, footprint.weights);
        if has_textures != 0u {
            own *= picture_on(mesh_texels, subject.textures_at, triangle, footprint);
        }
    }
    let back = select(own * INSIDE_SHARE, body.inside.rgb, body.inside.a >= 0.0);
    return select(back, own, is_front);
}

/// Linear RGB of what fills a segment, from 1, at a place: its layer's, else that of its inside. `depth` is the
/// distance to the nearest triangle of the segment, which layers alone ask for.
fn filling_color(segment: u32, rest: vec3f, depth: f32) -> vec3f {
    let body = mesh_look.segments[segment - 1u];
    let mean = textureLoad(palette, vec2i(i32(subject.labels_before + segment), 0), 0).rgb;
    let own = select(mean, body.color.rgb, body.color.a >= 0.0);
    var color = select(own * INSIDE_SHARE, body.inside.rgb, body.inside.a >= 0.0);
    if body.layer_count > 0u {
        var grain = 0.0;
        for (var i = 0u; i < body.layer_count; i++) {
            let layer = mesh_look.layers[body.first_layer + i];
            if layer.depth <= depth {
                color = select(own * INSIDE_SHARE, layer.color.rgb, layer.color.a >= 0.0);
                if layer.color.a < 0.0 && body.inside.a >= 0.0 {
                    color = body.inside.rgb;
                }
                grain = layer.grain;
            }
        }
        if grain > 0.0 {
            let at = rest / GRAIN_LENGTH;
            color *= 1.0 + grain * (noise(at.xy, 0u) + noise(at.yz, 1u) + noise(at.zx, 2u)) / 3.0;
        }
    }
    return color;
}

/// As `filling_color`, at a place whose depth is not known.
fn filling_color_at(segment: u32, rest: vec3f) -> vec3f {
    var depth = 0.0;
    if mesh_look.segments[segment - 1u].layer_count > 0u {
        depth = nearest_inside(rest, segment - 1u).w;
    }
    return filling_color(segment, rest, depth);
}
