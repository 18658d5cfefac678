//! Steps: what each sets, and the passage from one to the next.

use super::catalogue::{ParamKind, ParamValue};
use super::curve::Curve;
use super::error::DocumentError;
use super::illustration::{
    Align, Background, Illustration, PlacedTemplate, TemplateData, Transfer, TransferPoint, Window,
};
use super::notice::{Notice, NoticeKind};
use super::{json, pointer, resolve};
use glam::Quat;
use serde_json::{Map, Value};

/// Keys of the document that no step may set.
const REFUSED: [&str; 3] = ["fabrica", "subject", "steps"];

/// Walks all steps once: each must leave a right document.
///
/// # Errors
/// [`DocumentError::Refused`], [`DocumentError::BadPointer`], [`DocumentError::Step`].
pub(super) fn check(root: &Value) -> Result<Vec<Notice>, DocumentError> {
    let mut notices = Vec::new();
    let steps = steps_of(root);
    if steps.is_empty() {
        return Ok(notices);
    }
    let mut state = without_steps(root);
    for (i, step) in steps.iter().enumerate() {
        let at = format!("/steps/{i}/set");
        apply(&mut state, step, &at, |entry, target| {
            notices.push(Notice::new(
                entry,
                NoticeKind::Dangling {
                    target: target.to_owned(),
                },
            ));
        })?;
        if let Value::Object(map) = &state {
            let result =
                json::normalise(&mut state.clone(), 0).and_then(|()| resolve::resolve(map));
            result.map_err(|source| DocumentError::Step {
                pointer: at,
                step: i + 1,
                source: Box::new(source),
            })?;
        }
    }
    Ok(notices)
}

/// The tree at a step, without its steps.
///
/// # Errors
/// [`DocumentError::NoSuchStep`]; the rest cannot happen in a document that was checked.
pub(super) fn at_step(root: &Value, step: usize, last: usize) -> Result<Value, DocumentError> {
    if step > last {
        return Err(DocumentError::NoSuchStep { step, last });
    }
    let mut state = without_steps(root);
    for (i, set) in steps_of(root).iter().take(step).enumerate() {
        apply(&mut state, set, &format!("/steps/{i}/set"), |_, _| {})?;
    }
    Ok(state)
}

fn steps_of(root: &Value) -> &[Value] {
    match root.get("steps") {
        Some(Value::Array(steps)) => steps,
        _ => &[],
    }
}

fn without_steps(root: &Value) -> Value {
    match root {
        Value::Object(map) => Value::Object(
            map.iter()
                .filter(|(key, _)| *key != "steps")
                .map(|(key, value)| (key.clone(), value.clone()))
                .collect::<Map<_, _>>(),
        ),
        other => other.clone(),
    }
}

fn apply(
    state: &mut Value,
    step: &Value,
    at: &str,
    mut dangling: impl FnMut(String, &str),
) -> Result<(), DocumentError> {
    let Some(Value::Object(set)) = step.get("set") else {
        return Ok(());
    };
    for (target, value) in set {
        let entry = || pointer::shortened(&pointer::join(at, target));
        let keys = pointer::keys(target)?;
        match keys.first() {
            Some(first) if !REFUSED.contains(&first.as_str()) => {}
            _ => return Err(DocumentError::Refused { pointer: entry() }),
        }
        match pointer::set(state, target, value.clone()) {
            Ok(()) => {}
            Err(DocumentError::NotFound { .. }) => dangling(entry(), &pointer::shortened(target)),
            Err(other) => return Err(other),
        }
    }
    Ok(())
}

/// Between two states of a document: `end`, with its numbers, vectors, colours and rotations `part` of the way from
/// `start`.
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
    for (label, before) in out.labels.iter_mut().zip(&start.labels) {
        label.at = before.at.lerp(label.at, part);
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

/// The short way round; both ends exactly.
fn slerp(a: Quat, b: Quat, part: f32) -> Quat {
    if part <= 0.0 {
        a
    } else if part >= 1.0 {
        b
    } else {
        a.slerp(b, part)
    }
}

fn mix_srgb(a: [u8; 3], b: [u8; 3], part: f32) -> [u8; 3] {
    std::array::from_fn(|i| {
        let (a, b) = (linear_from_srgb(a[i]), linear_from_srgb(b[i]));
        srgb_from_linear(a + (b - a) * part)
    })
}

fn linear_from_srgb(byte: u8) -> f32 {
    let c = f32::from(byte) / 255.0;
    if c <= 0.04045 {
        c / 12.92
    } else {
        libm::powf((c + 0.055) / 1.055, 2.4)
    }
}

fn srgb_from_linear(value: f32) -> u8 {
    let c = if value <= 0.003_130_8 {
        value * 12.92
    } else {
        1.055 * libm::powf(value, 1.0 / 2.4) - 0.055
    };
    (c * 255.0 + 0.5).clamp(0.0, 255.0) as u8
}
