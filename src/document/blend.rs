//! The way between two states of a document.

use super::model::{
    Align, Background, Curve, Ghost, Hatch, Illustration, Layer, Light, Outline, ParamKind,
    ParamValue, PlacedTemplate, SceneObject, SegmentLook, Stipple, Style, SubjectRef,
    SurfaceChange, SurfaceLook, TemplateData, Tone, Transfer, TransferPoint, Window, join_objects,
    limit_grids, limit_sweeps,
};
use super::pose::blend_figure;
use crate::math::mix_srgb;
use glam::{Quat, Vec2, Vec3};

/// The state between two others: `end`, with its numbers, vectors, colours and rotations `part` (0 to 1) of the way
/// from `start`.
pub(super) fn blend(start: &Illustration, end: &Illustration, part: f32) -> Illustration {
    let mix = |a: f32, b: f32| a + (b - a) * part;
    let mut out = end.clone();
    for template in &mut out.templates {
        let before = start
            .templates
            .iter()
            .find(|t| t.index == template.index && t.kind == template.kind);
        if let Some(before) = before {
            blend_template(before, template, part);
        }
    }
    out.figure = blend_figure(start.figure.as_ref(), end.figure.as_ref(), part);
    out.look.background = match (start.look.background, end.look.background) {
        (Background::Color(a), Background::Color(b)) => Background::Color(mix_srgb(a, b, part)),
        (_, other) => other,
    };
    if let (Window::Range(a), Window::Range(b)) = (start.look.window, end.look.window) {
        out.look.window = Window::Range([mix(a[0], b[0]), mix(a[1], b[1])]);
    }
    out.look.gradient = mix(start.look.gradient, end.look.gradient);
    for segment in &mut out.look.segments {
        let mut before = start.look.segments.iter();
        if let Some(before) = before.find(|before| before.name == segment.name) {
            segment.opacity = mix(before.opacity, segment.opacity);
            if let (Some(a), Some(b)) = (before.color_srgb, segment.color_srgb) {
                segment.color_srgb = Some(mix_srgb(a, b, part));
            }
        }
    }
    blend_segments(start, end, &mut out.look.segments, part);
    blend_surface(&start.look.surface, &mut out.look.surface, part);
    out.look.style = blend_style(&start.look.style, &end.look.style, part);
    out.look.light = blend_light(start.look.light, end.look.light, part);
    for object in &mut out.objects {
        let mut before = start.objects.iter();
        if let Some(before) = before.find(|before| before.index == object.index) {
            blend_object(before, object, part);
        }
    }
    // What carves is where its object is. Which of them do nothing was told when the document was read.
    let _told = join_objects(&mut out.templates, &out.objects);
    let _told = limit_sweeps(&mut out.templates);
    let clay = match &out.subject {
        SubjectRef::Clay(clay) => Some(&**clay),
        _ => None,
    };
    let _told = limit_grids(&mut out.templates, clay);
    if let (Some(a), Some(b)) = (start.strokes_shown(), end.strokes_shown())
        && part < 1.0
    {
        out.look.strokes = Some((mix(a as f32, b as f32) + 0.5).floor() as u32);
    }
    if let (Some(a), Some(b)) = (start.look.tint, end.look.tint) {
        out.look.tint = Some(mix(a, b));
    }
    if let (Transfer::Points(a), Transfer::Points(b)) = (&start.look.transfer, &end.look.transfer)
        && a.len() == b.len()
    {
        let mixed = a.iter().zip(b).map(|(a, b)| TransferPoint {
            value: mix(a.value, b.value),
            color_srgb: mix_srgb(a.color_srgb, b.color_srgb, part),
            opacity: mix(a.opacity, b.opacity),
        });
        out.look.transfer = Transfer::Points(mixed.collect());
    }
    out.camera.target = start.camera.target.lerp(end.camera.target, part);
    out.camera.rotate = slerp(start.camera.rotate, end.camera.rotate, part);
    out.camera.distance = mix(start.camera.distance, end.camera.distance);
    out.camera.fov_deg = mix(start.camera.fov_deg, end.camera.fov_deg);
    for (caption, before) in out.captions.iter_mut().zip(&start.captions) {
        caption.at = before.at.lerp(caption.at, part);
    }
    out
}

fn blend_template(start: &PlacedTemplate, out: &mut PlacedTemplate, part: f32) {
    let mix = |a: f32, b: f32| a + (b - a) * part;
    out.placement.at = start.placement.at.lerp(out.placement.at, part);
    out.placement.rotate = slerp(start.placement.rotate, out.placement.rotate, part);
    out.placement.size = start.placement.size.lerp(out.placement.size, part);
    out.amount = mix(start.amount, out.amount);
    out.curve = Curve::blend(start.curve.as_ref(), out.curve.as_ref(), part);
    let specs = out.kind.spec().params;
    for ((value, before), spec) in out.params.iter_mut().zip(&start.params).zip(specs) {
        *value = match (*before, *value) {
            (ParamValue::Number(a), ParamValue::Number(b)) => {
                let mixed = mix(a, b);
                ParamValue::Number(if matches!(spec.kind, ParamKind::Count { .. }) {
                    (mixed + 0.5).floor()
                } else {
                    mixed
                })
            }
            (ParamValue::Vector(a), ParamValue::Vector(b)) => ParamValue::Vector(a.lerp(b, part)),
            (ParamValue::Rotation(a), ParamValue::Rotation(b)) => {
                ParamValue::Rotation(slerp(a, b, part))
            }
            (_, other) => other,
        };
    }
    if let (TemplateData::Points(a), TemplateData::Points(b)) = (&start.data, &mut out.data)
        && a.points.len() == b.points.len()
    {
        for (from, to) in a.points.iter().zip(&mut b.points) {
            to.at = from.at.lerp(to.at, part);
            to.shift = from.shift.lerp(to.shift, part);
        }
    }
    if let (TemplateData::Tools(a), TemplateData::Tools(b)) = (&start.data, &mut out.data) {
        *b = b.blended(a, part);
    }
    match (&start.align, &mut out.align) {
        (
            Align::Surface {
                depth: d0,
                thickness: t0,
            },
            Align::Surface { depth, thickness },
        ) => {
            *depth = mix(*d0, *depth);
            *thickness = mix(*t0, *thickness);
        }
        (Align::Segment { thickness: t0, .. }, Align::Segment { thickness, .. }) => {
            *thickness = mix(*t0, *thickness);
        }
        _ => {}
    }
}

/// A style on its way. A part that one of both does not draw grows or goes as the other draws it.
fn blend_style(start: &Style, end: &Style, part: f32) -> Style {
    if part >= 1.0 {
        return *end;
    }
    let mix = |a: f32, b: f32| a + (b - a) * part;
    let mix_color = |a, b| mix_srgb(a, b, part);
    let [a, b] = both_ends(start.outline, end.outline, |outline| &mut outline.width);
    let outline = Outline {
        width: mix(a.width, b.width),
        color_srgb: mix_color(a.color_srgb, b.color_srgb),
        creases: mix(a.creases, b.creases),
    };
    let [a, b] = both_ends(start.tone, end.tone, |tone| &mut tone.strength);
    let tone = Tone {
        levels: b.levels,
        warm_srgb: mix_color(a.warm_srgb, b.warm_srgb),
        cool_srgb: mix_color(a.cool_srgb, b.cool_srgb),
        strength: mix(a.strength, b.strength),
    };
    let [a, b] = both_ends(start.hatch, end.hatch, |hatch| &mut hatch.strength);
    let hatch = Hatch {
        spacing: mix(a.spacing, b.spacing),
        width: mix(a.width, b.width),
        by: b.by,
        color_srgb: mix_color(a.color_srgb, b.color_srgb),
        strength: mix(a.strength, b.strength),
    };
    let [a, b] = both_ends(start.stipple, end.stipple, |stipple| &mut stipple.strength);
    let stipple = Stipple {
        spacing: mix(a.spacing, b.spacing),
        size: mix(a.size, b.size),
        color_srgb: mix_color(a.color_srgb, b.color_srgb),
        strength: mix(a.strength, b.strength),
    };
    let [a, b] = both_ends(start.ghost, end.ghost, |ghost| &mut ghost.strength);
    let ghost = Ghost {
        by: b.by,
        strength: mix(a.strength, b.strength),
    };
    Style {
        outline,
        tone,
        hatch,
        stipple,
        ghost,
    }
}

/// Where a part of a style goes from and to. One that is not drawn, since its `amount` is 0, is taken as the other but
/// for that.
fn both_ends<T: Copy>(mut start: T, mut end: T, amount: impl Fn(&mut T) -> &mut f32) -> [T; 2] {
    match (*amount(&mut start) > 0.0, *amount(&mut end) > 0.0) {
        (true, false) => {
            end = start;
            *amount(&mut end) = 0.0;
        }
        (false, true) => {
            start = end;
            *amount(&mut start) = 0.0;
        }
        _ => {}
    }
    [start, end]
}

/// A light on its way from another. A light that comes from none is itself at once, and so is none.
fn blend_light(start: Option<Light>, end: Option<Light>, part: f32) -> Option<Light> {
    let (Some(a), Some(b)) = (start, end) else {
        return end;
    };
    if part >= 1.0 {
        return end;
    }
    let mix = |a: f32, b: f32| a + (b - a) * part;
    Some(Light {
        from: blend_from(a.from, b.from, part),
        soft: mix(a.soft, b.soft),
        contact: mix(a.contact, b.contact),
        skin: mix(a.skin, b.skin),
    })
}

/// The way between two directions of light: a straight line on the map of all directions whose middle is the one to
/// the viewer, and on which the distance from the middle is the angle in radians. Light that goes from one side to the
/// other passes the viewer so; the shortest way may lead through straight behind, from where no light may come.
fn blend_from(start: Vec3, end: Vec3, part: f32) -> Vec3 {
    if part <= 0.0 || start == end {
        return start;
    }
    let on_map = |from: Vec3| -> Vec2 {
        let aside = from.truncate();
        aside.normalize_or_zero() * aside.length().atan2(from.z)
    };
    let place = on_map(start).lerp(on_map(end), part);
    let angle = place.length();
    (place.normalize_or_zero() * angle.sin()).extend(angle.cos())
}

/// What the meshes' bodies are made of.
fn blend_surface(start: &SurfaceLook, out: &mut SurfaceLook, part: f32) {
    let mix = |a: f32, b: f32| a + (b - a) * part;
    out.thickness = mix(start.thickness, out.thickness);
    out.gloss = mix(start.gloss, out.gloss);
    out.inside_srgb = blend_color(start.inside_srgb, out.inside_srgb, part);
    blend_layers(&start.layers, &mut out.layers, part);
}

/// Layers of lists of one length; others switch.
fn blend_layers(start: &[Layer], out: &mut [Layer], part: f32) {
    let mix = |a: f32, b: f32| a + (b - a) * part;
    if start.len() != out.len() {
        return;
    }
    for layer in &mut *out {
        // A layer that passes another one on its way stays the same layer.
        if let Some(before) = start.iter().find(|before| before.index == layer.index) {
            layer.depth = mix(before.depth, layer.depth);
            layer.grain = mix(before.grain, layer.grain);
            layer.color_srgb = blend_color(before.color_srgb, layer.color_srgb, part);
        }
    }
    Layer::sort(out);
}

/// A colour that both give; else that of the end.
fn blend_color(start: Option<[u8; 3]>, end: Option<[u8; 3]>, part: f32) -> Option<[u8; 3]> {
    match (start, end) {
        (Some(a), Some(b)) => Some(mix_srgb(a, b, part)),
        _ => end,
    }
}

/// What single segments say of the surface of a mesh. A key that one of both states leaves to the look eases from what
/// the look says there, or to it.
fn blend_segments(start: &Illustration, end: &Illustration, out: &mut [SegmentLook], part: f32) {
    let nothing = SurfaceChange::default();
    for segment in out {
        let before = start.look.segments.iter().find(|l| l.name == segment.name);
        let before = before.map_or(&nothing, |before| &before.surface);
        let after = &mut segment.surface;
        if *before == *after {
            continue;
        }
        let start = before.over(&start.look.surface);
        let mut mixed = after.over(&end.look.surface);
        blend_surface(&start, &mut mixed, part);
        if before.thickness.is_some() || after.thickness.is_some() {
            after.thickness = Some(mixed.thickness);
        }
        if before.gloss.is_some() || after.gloss.is_some() {
            after.gloss = Some(mixed.gloss);
        }
        if before.inside_srgb.is_some() || after.inside_srgb.is_some() {
            after.inside_srgb = mixed.inside_srgb;
        }
        if before.layers.is_some() || after.layers.is_some() {
            after.layers = Some(mixed.layers);
        }
    }
}

fn blend_object(start: &SceneObject, out: &mut SceneObject, part: f32) {
    let mix = |a: f32, b: f32| a + (b - a) * part;
    // One that lies where its file says has no place that could be mixed with another.
    if let (Some(a), Some(b)) = (start.placement, &mut out.placement) {
        b.at = a.at.lerp(b.at, part);
        b.rotate = slerp(a.rotate, b.rotate, part);
        b.size = mix(a.size, b.size);
    }
    out.opacity = mix(start.opacity, out.opacity);
    out.gloss = mix(start.gloss, out.gloss);
    out.color_srgb = blend_color(start.color_srgb, out.color_srgb, part);
    out.inside_srgb = blend_color(start.inside_srgb, out.inside_srgb, part);
}

/// The shorter way between two rotations; the ends themselves at 0 and 1.
fn slerp(a: Quat, b: Quat, part: f32) -> Quat {
    if part <= 0.0 {
        a
    } else if part >= 1.0 {
        b
    } else {
        a.slerp(b, part)
    }
}
