//! Reads an illustrator's look: a preset, and what the document changes of it.

use super::object::{Object, wrong};
use super::reader::Reader;
use super::surface::DEFAULT;
use crate::document::model::{
    Ghost, GhostBy, Hatch, HatchBy, Outline, STYLE_PRESETS, Stipple, Style, StylePreset, Tone,
    style_preset,
};
use crate::document::schema::Kind;
use crate::document::text::DocumentError;
use serde_json::Value;

impl Reader {
    /// The key `style` of `look`: the preset, if there is one, and what is drawn.
    pub(super) fn style(
        &mut self,
        look: &Object<'_>,
    ) -> Result<(Option<&'static StylePreset>, Style), DocumentError> {
        let object = match look.map.get("style") {
            None => return Ok((None, Style::PLAIN)),
            Some(Value::String(name)) => {
                let preset = style_preset(name);
                if preset.is_none() && name != "none" {
                    self.unknown_value(look.at("style"), name, "none");
                }
                return Ok((preset, preset.map_or(Style::PLAIN, |preset| preset.style)));
            }
            Some(Value::Object(_)) => look.child("style")?,
            Some(other) => {
                return Err(wrong(
                    &look.at("style"),
                    "a preset's name or an object",
                    other,
                ));
            }
        };
        self.unknown_keys(&object);
        // The first name is `none`.
        let chosen = self.choice(&object, "preset")?.checked_sub(1);
        let preset = chosen.and_then(|i| STYLE_PRESETS.get(i));
        let base = preset.map_or(Style::PLAIN, |preset| preset.style);
        let style = Style {
            outline: self.outline(&object, base.outline)?,
            tone: self.tone(&object, base.tone)?,
            hatch: self.hatch(&object, base.hatch)?,
            stipple: self.stipple(&object, base.stipple)?,
            ghost: self.ghost(&object, base.ghost)?,
        };
        Ok((preset, style))
    }

    fn outline(&mut self, style: &Object<'_>, base: Outline) -> Result<Outline, DocumentError> {
        let Some(part) = self.part(style, "outline")? else {
            return Ok(base);
        };
        Ok(Outline {
            width: self.amount(&part, "width", base.width, Outline::GIVEN_WIDTH)?,
            color_srgb: self.color_or(&part, "color", base.color_srgb)?,
            creases: self.number_or(&part, "creases", base.creases)?,
        })
    }

    fn tone(&mut self, style: &Object<'_>, base: Tone) -> Result<Tone, DocumentError> {
        let Some(part) = self.part(style, "tone")? else {
            return Ok(base);
        };
        Ok(Tone {
            levels: self.levels(&part, base.levels)?,
            warm_srgb: self.color_or(&part, "warm", base.warm_srgb)?,
            cool_srgb: self.color_or(&part, "cool", base.cool_srgb)?,
            strength: self.amount(&part, "strength", base.strength, Tone::GIVEN_STRENGTH)?,
        })
    }

    fn hatch(&mut self, style: &Object<'_>, base: Hatch) -> Result<Hatch, DocumentError> {
        let Some(part) = self.part(style, "hatch")? else {
            return Ok(base);
        };
        let by = self.choice_if_any(&part, "by", DEFAULT)?;
        Ok(Hatch {
            spacing: self.number_or(&part, "spacing", base.spacing)?,
            width: self.number_or(&part, "width", base.width)?,
            by: by.map_or(base.by, |i| HatchBy::ALL[i]),
            color_srgb: self.color_or(&part, "color", base.color_srgb)?,
            strength: self.amount(&part, "strength", base.strength, Hatch::GIVEN_STRENGTH)?,
        })
    }

    fn stipple(&mut self, style: &Object<'_>, base: Stipple) -> Result<Stipple, DocumentError> {
        let Some(part) = self.part(style, "stipple")? else {
            return Ok(base);
        };
        Ok(Stipple {
            spacing: self.number_or(&part, "spacing", base.spacing)?,
            size: self.number_or(&part, "size", base.size)?,
            color_srgb: self.color_or(&part, "color", base.color_srgb)?,
            strength: self.amount(&part, "strength", base.strength, Stipple::GIVEN_STRENGTH)?,
        })
    }

    fn ghost(&mut self, style: &Object<'_>, base: Ghost) -> Result<Ghost, DocumentError> {
        let Some(part) = self.part(style, "ghost")? else {
            return Ok(base);
        };
        let by = self.choice_if_any(&part, "by", DEFAULT)?;
        Ok(Ghost {
            by: by.map_or(base.by, |i| GhostBy::ALL[i]),
            strength: self.amount(&part, "strength", base.strength, Ghost::GIVEN_STRENGTH)?,
        })
    }

    /// The object of a part, if the document gives one.
    pub(super) fn part<'a>(
        &mut self,
        whole: &Object<'a>,
        key: &str,
    ) -> Result<Option<Object<'a>>, DocumentError> {
        if !whole.map.contains_key(key) {
            return Ok(None);
        }
        let part = whole.child(key)?;
        self.unknown_keys(&part);
        Ok(Some(part))
    }

    /// A width or strength. Who writes the object of a part wants it: without the key it is what the preset has, and
    /// where that does not draw the part, `given`.
    fn amount(
        &mut self,
        part: &Object<'_>,
        key: &str,
        base: f32,
        given: f32,
    ) -> Result<f32, DocumentError> {
        self.number_or(part, key, if base > 0.0 { base } else { given })
    }

    /// A number of the schema; without the key that of the preset.
    fn number_or(&mut self, part: &Object<'_>, key: &str, base: f32) -> Result<f32, DocumentError> {
        match part.map.contains_key(key) {
            true => self.number(part, key),
            false => Ok(base),
        }
    }

    /// A colour; without the key that of the preset.
    fn color_or(
        &mut self,
        part: &Object<'_>,
        key: &str,
        base: [u8; 3],
    ) -> Result<[u8; 3], DocumentError> {
        Ok(self.color(part, key, DEFAULT)?.unwrap_or(base))
    }

    /// The number of steps of a tone. One step would be no shading: the least are two.
    fn levels(&mut self, tone: &Object<'_>, base: u32) -> Result<u32, DocumentError> {
        let (Some(value), Kind::Count { min, max, .. }) =
            (tone.number("levels")?, tone.kind("levels"))
        else {
            return Ok(base);
        };
        let mut drawn = (value + 0.5).floor().clamp(min, max);
        if drawn == 1.0 {
            drawn = 2.0;
        }
        let [drawn] = self.clamped(|| tone.at("levels"), [value], [drawn]);
        Ok(drawn as u32)
    }
}
