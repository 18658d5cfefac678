// An illustrator's look: outlines, tone, hatching and dots over a picture whose pixels tell what they show. One sample,
// which is mixed into those before as without a style.
// needs: types.wgsl affine.wgsl srgb.wgsl bind/frame.wgsl bind/style.wgsl style/traced.wgsl style/outlines.wgsl
//   style/directions.wgsl style/strokes.wgsl style/vignette.wgsl

/// One triangle that covers everything.
@vertex
fn cover(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    return vec4f(f32(index & 1u) * 4.0 - 1.0, f32(index >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}

/// The grey of a colour, 0 to 1, as the picture's file has it.
fn grey_of(color: vec3f) -> f32 {
    return srgb_from_linear(vec3f(dot(min(color, vec3f(1.0)), vec3f(0.2126, 0.7152, 0.0722)))).x;
}

/// Light in flat tones, each with a narrow soft border.
fn flat_light(light: f32) -> f32 {
    if style.levels < 2.0 {
        return light;
    }
    let place = clamp(light, 0.0, 1.0) * style.levels;
    let step_at = clamp(floor(place), 0.0, style.levels - 1.0);
    let soft = smoothstep(0.94, 1.0, place - step_at) * step(step_at, style.levels - 1.5);
    return (step_at + soft + 0.5) / style.levels;
}

/// The colour under the strokes: that of the tissue, in flat tones where these are wanted, and of cool and warm light.
fn toned(color: vec3f, here: Shown) -> vec3f {
    let light = flat_light(here.light);
    let own = color * (light / max(here.light, 0.02));
    return mix(own, mix(style.cool.rgb, style.warm.rgb, clamp(light, 0.0, 1.0)), style.tone);
}

/// The part of a surface of the first colour that ink has to cover for the tone of a grey: darker ink draws the shadow,
/// lighter ink the light.
fn ink_for(under: vec3f, ink: vec3f, grey: f32) -> f32 {
    let bare = grey_of(under);
    let inked = grey_of(ink);
    let wanted = mix(min(bare, inked), max(bare, inked), grey);
    let contrast = bare - inked;
    return clamp((bare - wanted) / select(contrast, 1e-3, abs(contrast) < 1e-3), 0.0, 1.0);
}

/// A colour of which ink covers a part, linear. In greys as a file has them, so that strokes which are too fine for the
/// pixels make the same tone as those that are seen.
fn inked(under: vec3f, ink: vec3f, covered: f32) -> vec3f {
    return linear_from_srgb(mix(srgb_from_linear(under), srgb_from_linear(ink), covered));
}

/// One sample of a pixel with its style, linear premultiplied.
@fragment
fn draw_style(@builtin(position) at: vec4f) -> @location(0) vec4f {
    let pixel = vec2i(at.xy) + vec2i(0, i32(frame.first_row));
    let plain = textureLoad(traced_color, traced_texel(pixel), 0);
    let here = shown_at(pixel);
    var color = plain;
    if here.t >= 0.0 && plain.a > 0.0 {
        let own = plain.rgb / plain.a;
        // Half the tone is the light, half the tissue's own darkness: plates do not draw dark tissue black.
        let grey = sqrt(grey_of(own) * grey_of(vec3f(here.light)));
        var drawn = toned(own, here);
        if style.hatch > 0.0 {
            let ink = hatching_at(pixel, here, style.hatch * ink_for(drawn, style.hatch_color.rgb, grey));
            drawn = inked(drawn, style.hatch_color.rgb, ink);
        }
        if style.stipple > 0.0 {
            let ink = dots_at(pixel, here, style.stipple * ink_for(drawn, style.stipple_color.rgb, grey));
            drawn = inked(drawn, style.stipple_color.rgb, ink);
        }
        color = vec4f(drawn * plain.a, plain.a);
    }
    if style.outline_px > 0.0 {
        let line = outline_at(pixel, here, frame.occlusion_turn);
        color = mix(color, vec4f(style.outline_color.rgb, 1.0), line);
    }
    if style.vignette > 0.0 && here.t >= 0.0 {
        color *= 1.0 - style.vignette * faded_at(apply_affine(frame.subject_from_view, here.pos));
    }
    return color;
}
