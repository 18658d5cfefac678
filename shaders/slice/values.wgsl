// The values of a scan in a slice: as grey by the window, or in the colours of the look.
// needs: types.wgsl bind/subject.wgsl bind/look.wgsl bind/bodies.wgsl bind/slice.wgsl affine.wgsl srgb.wgsl
//   displace/compose.wgsl subject/place.wgsl slice/plane.wgsl march/plain.wgsl|march/align.wgsl

/// How thick the cut is for the opacity of colours, subject units: haze stays faint, skin is solid.
const SLICE_THICKNESS: f32 = 0.03;
/// How opaque tissue must be to have a colour of its own; below it fades into the background.
const SLICE_OPACITY_LENGTH: f32 = 0.01;

/// How much of a body's colour lies over the grey where bodies are marked.
const SLICE_MARK: f32 = 0.45;

/// What the volume has where this came from.
fn volume_from(mapped: Mapped) -> Here {
    let uvw = texture_from_rest(mapped.pos);
    let is_inside = is_in_subject(uvw);
    return Here(
        mapped.pos,
        texel_at(uvw),
        mapped.continuity,
        label_here(mapped.pos),
        is_inside && mapped.continuity >= 0.0,
    );
}

/// Linear RGB of the object where there is something, over the background.
fn color_of(here: Here) -> vec3f {
    if slice.mode != SLICE_COLORS {
        let level = clamp(here.texel * slice.grey_scale + slice.grey_offset, 0.0, 1.0);
        // The window is linear in what a screen is sent, as on every radiologist's workstation.
        let grey = linear_from_srgb(vec3f(level));
        let mark = bodies.items[here.label & 255u];
        if slice.mode == SLICE_MARKED && mark.a > 0.0 {
            return mix(grey, mark.rgb, SLICE_MARK);
        }
        return grey;
    }
    let known = textureSampleLevel(lut, linear_sampler, vec2f(here.texel * look.table_scale + look.table_offset, 0.5), 0.0);
    let tint = textureLoad(palette, vec2i(i32(here.label), 0), 0);
    var albedo = mix(known.rgb, known.rgb * mix(vec3f(1.0), tint.rgb, tint.a), look.tint);
    var clear = pow(max(1.0 - known.a, 0.0), SLICE_THICKNESS / SLICE_OPACITY_LENGTH);
    let body = bodies.items[here.label & 255u];
    if body.a >= 0.0 {
        albedo = body.rgb;
        clear = pow(max(1.0 - body.a, 0.0), SLICE_THICKNESS / BODY_LAYER);
    }
    return mix(albedo, slice.background.rgb, clear);
}

/// Linear RGB of the volume at a place, over the background; marked values are tinted.
fn marked_color_of(here: Here) -> vec3f {
    if !here.is_there {
        return slice.background.rgb;
    }
    let color = color_of(here);
    if slice.marked_strength > 0.0 && here.texel >= slice.marked_from && here.texel <= slice.marked_to {
        return mix(color, slice.marked_color, slice.marked_strength);
    }
    return color;
}
