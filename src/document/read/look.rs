//! Reading of colours, opacity and background.

use super::object::{Object, wrong};
use super::reader::Reader;
use crate::document::model::{
    Background, Look, OpacityMode, SegmentLook, SubjectRef, Transfer, TransferPoint, Window, preset,
};
use crate::document::schema::MAX_VALUE;
use crate::document::text::DocumentError;
use serde_json::Value;

const WHITE: [u8; 3] = [255; 3];

impl Reader {
    pub(super) fn look(
        &mut self,
        object: &Object<'_>,
        subject: &SubjectRef,
    ) -> Result<Look, DocumentError> {
        self.unknown_keys(object);
        let transfer = self.transfer(object)?;
        let window = self.window(object)?;
        let tint = match object.map.contains_key("tint") {
            true => Some(self.number(object, "tint")?),
            false => None,
        };
        let opacity = OpacityMode::ALL[self.choice(object, "opacity")?];
        let gradient = self.number(object, "gradient")?;
        let segments = self.segment_looks(&object.child("segments")?)?;
        let surface = self.surface(object, subject)?;
        let (preset, style) = self.style(object)?;
        let light = self.light(object)?;
        let background = match object.text("background")? {
            Some("none") => Background::None,
            _ => Background::Color(
                self.color(object, "background", "#ffffff")?
                    .unwrap_or(WHITE),
            ),
        };
        Ok(Look {
            transfer,
            window,
            tint,
            opacity,
            gradient,
            segments,
            surface,
            style,
            style_preset: preset.map(|preset| preset.name),
            light,
            background,
            scale_bar: object.flag("scale")?,
            sides: object.flag("sides")?,
            strokes: match object.map.contains_key("strokes") {
                true => Some(self.count(object, "strokes")?),
                false => None,
            },
            has_wires: false,
        })
    }

    fn transfer(&mut self, object: &Object<'_>) -> Result<Transfer, DocumentError> {
        Ok(match object.map.get("transfer") {
            None => Transfer::Auto,
            Some(Value::String(name)) if name == "auto" => Transfer::Auto,
            Some(Value::String(name)) if preset(name).is_some() => Transfer::Preset(name.clone()),
            Some(Value::String(name)) => {
                self.unknown_value(object.at("transfer"), name, "auto");
                Transfer::Auto
            }
            Some(Value::Array(_)) => self.points(object)?,
            Some(other) => {
                return Err(wrong(
                    &object.at("transfer"),
                    "a preset's name or a list of points",
                    other,
                ));
            }
        })
    }

    fn points(&mut self, look: &Object<'_>) -> Result<Transfer, DocumentError> {
        let mut points = Vec::new();
        for object in look.children("transfer")? {
            let object = object?;
            self.unknown_keys(&object);
            let color_srgb = self.color(&object, "color", "#ffffff")?.unwrap_or(WHITE);
            points.push(TransferPoint {
                value: self.number(&object, "value")?,
                color_srgb,
                opacity: self.number(&object, "opacity")?,
            });
        }
        points.sort_by(|a, b| a.value.total_cmp(&b.value));
        Ok(Transfer::Points(points))
    }

    fn window(&mut self, object: &Object<'_>) -> Result<Window, DocumentError> {
        if let Some(Value::String(name)) = object.map.get("window") {
            if name != "auto" {
                self.unknown_value(object.at("window"), name, "auto");
            }
            return Ok(Window::Auto);
        }
        let Some(values) = object.numbers("window", "“auto” or a list of two numbers")? else {
            return Ok(Window::Auto);
        };
        let [a, b] = values.map(|v| v.clamp(-MAX_VALUE, MAX_VALUE) as f32);
        let (low, mut high) = (a.min(b), a.max(b));
        // A window has a width: at least what floats of this size can tell apart.
        let least = low.abs().max(high.abs()).max(1e-3) * 1e-5;
        high = high.max(low + least);
        let drawn = [f64::from(low), f64::from(high)];
        let drawn = self.clamped(|| object.at("window"), values, drawn);
        Ok(Window::Range(drawn.map(|v| v as f32)))
    }

    /// `{ "brain": 1, "skull": { "opacity": 0.3, "color": "#eadfc4" } }`: a number is an opacity.
    fn segment_looks(&mut self, segments: &Object<'_>) -> Result<Vec<SegmentLook>, DocumentError> {
        let mut looks = Vec::new();
        for (name, value) in segments.map {
            looks.push(match value {
                Value::Number(_) => SegmentLook {
                    opacity: self.number_in(segments, name, 1.0, [0.0, 1.0])?,
                    ..SegmentLook::solid(name)
                },
                _ => {
                    let look = Object::new(segments.at(name), value, segments.keys)?;
                    self.unknown_keys(&look);
                    let color_srgb = self.color(&look, "color", "#ffffff")?;
                    SegmentLook {
                        name: name.clone(),
                        opacity: self.number(&look, "opacity")?,
                        is_opacity_given: look.map.contains_key("opacity"),
                        color_srgb,
                        surface: self.surface_change(&look)?,
                    }
                }
            });
        }
        Ok(looks)
    }
}
