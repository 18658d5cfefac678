//! Reading of single values: checked, brought into their range, and named in a notice where that changes them.

use super::object::{Object, numbers, wrong};
use crate::document::limits::MAX_NOTICES;
use crate::document::model::{ParamKind, ParamSpec, ParamValue};
use crate::document::schema::{Kind, MAX_PAIR};
use crate::document::text::json::{self, number_text};
use crate::document::text::pointer::{self, join};
use crate::document::text::{DocumentError, Notice, NoticeKind, shortened};
use crate::math::plain_f64;
use glam::{DQuat, DVec2, DVec3, Quat, Vec2, Vec3};
use serde_json::Value;

/// A quaternion whose length differs from 1 by less is taken as a unit quaternion: the editor rounds to four decimals.
const UNIT_TOLERANCE: f64 = 1e-3;

/// Reads a document and collects its notices. The other files of this folder add a method for each part of a document.
#[derive(Default)]
pub(crate) struct Reader {
    pub(super) notices: Vec<Notice>,
}

impl Reader {
    pub(super) fn note(&mut self, pointer: impl Into<String>, kind: NoticeKind) {
        self.notices.push(Notice::new(pointer, kind));
    }

    /// Names every key of an object that its list in the schema lacks.
    pub(super) fn unknown_keys(&mut self, object: &Object<'_>) {
        for key in object.map.keys() {
            if self.notices.len() > MAX_NOTICES {
                break;
            }
            if object.keys.iter().all(|known| known.name != key) {
                self.note(pointer::shortened(&object.at(key)), NoticeKind::UnknownKey);
            }
        }
    }

    pub(super) fn unknown_value(&mut self, pointer: String, found: &str, instead: &str) {
        self.note(
            pointer,
            NoticeKind::UnknownValue {
                found: shortened(found, 40),
                instead: instead.to_owned(),
            },
        );
    }

    /// Brings each value into a range.
    pub(super) fn clamp<const N: usize>(
        &mut self,
        pointer: impl FnOnce() -> String,
        values: [f64; N],
        range: [f64; 2],
    ) -> [f64; N] {
        let drawn = values.map(|v| v.clamp(range[0], range[1]));
        self.clamped(pointer, values, drawn)
    }

    /// Returns `drawn`, with a notice if it is not what the document says (`values`).
    pub(super) fn clamped<const N: usize>(
        &mut self,
        pointer: impl FnOnce() -> String,
        values: [f64; N],
        drawn: [f64; N],
    ) -> [f64; N] {
        if drawn != values {
            // Ranges of parameters are 32-bit floats: a value that only differs by their rounding (π written in full)
            // is in range.
            let rounding =
                |(v, d): (&f64, &f64)| (v - d).abs() <= d.abs() * f64::from(f32::EPSILON);
            if !values.iter().zip(&drawn).all(rounding) {
                self.note(
                    pointer(),
                    NoticeKind::Clamped {
                        found: written(&values),
                        drawn: written(&drawn.map(|d| plain_f64(d as f32))),
                    },
                );
            }
        }
        drawn
    }

    /// A number of the schema, in its range.
    pub(super) fn number(&mut self, object: &Object<'_>, key: &str) -> Result<f32, DocumentError> {
        let Kind::Number { default, min, max } = object.kind(key) else {
            debug_assert!(false, "{key} is no number in the schema");
            return Ok(0.0);
        };
        self.number_in(object, key, default, [min, max])
    }

    /// A number in a given range.
    pub(super) fn number_in(
        &mut self,
        object: &Object<'_>,
        key: &str,
        default: f64,
        range: [f64; 2],
    ) -> Result<f32, DocumentError> {
        let value = object.number(key)?.unwrap_or(default);
        let [value] = self.clamp(|| object.at(key), [value], range);
        Ok(value as f32)
    }

    /// A number of the schema, in its range and in full precision.
    pub(super) fn exact(&mut self, object: &Object<'_>, key: &str) -> Result<f64, DocumentError> {
        let Kind::Exact { default, min, max } = object.kind(key) else {
            debug_assert!(false, "{key} is no number of full precision in the schema");
            return Ok(0.0);
        };
        let value = object.number(key)?.unwrap_or(default);
        let [drawn] = self.clamp(|| object.at(key), [value], [min, max]);
        Ok(drawn)
    }

    /// A whole number of the schema, in its range; others are rounded.
    pub(super) fn count(&mut self, object: &Object<'_>, key: &str) -> Result<u32, DocumentError> {
        let Kind::Count { default, min, max } = object.kind(key) else {
            debug_assert!(false, "{key} is no whole number in the schema");
            return Ok(0);
        };
        let value = object.number(key)?.unwrap_or(default);
        let drawn = (value + 0.5).floor().clamp(min, max);
        let [drawn] = self.clamped(|| object.at(key), [value], [drawn]);
        Ok(drawn as u32)
    }

    /// Three numbers of the schema, in their range.
    pub(super) fn numbers(
        &mut self,
        object: &Object<'_>,
        key: &str,
    ) -> Result<[f64; 3], DocumentError> {
        let Kind::Vector { default, min, max } = object.kind(key) else {
            debug_assert!(false, "{key} is no vector in the schema");
            return Ok([0.0; 3]);
        };
        let values = object.numbers(key, "a list of three numbers")?;
        let values = values.unwrap_or(default);
        Ok(self.clamp(|| object.at(key), values, [min, max]))
    }

    /// A vector of the schema, in its range.
    pub(super) fn vector(&mut self, object: &Object<'_>, key: &str) -> Result<Vec3, DocumentError> {
        let values = self.numbers(object, key)?;
        Ok(DVec3::from_array(values).as_vec3())
    }

    /// A unit quaternion; the identity if the key is missing.
    pub(super) fn rotation(
        &mut self,
        object: &Object<'_>,
        key: &str,
    ) -> Result<Quat, DocumentError> {
        let Some(values) =
            object.numbers(key, "a quaternion, a list of four numbers x, y, z, w")?
        else {
            return Ok(Quat::IDENTITY);
        };
        // Scaled first, so that no square overflows or vanishes.
        let largest = values.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        if largest == 0.0 {
            return Err(DocumentError::ZeroRotation {
                pointer: object.at(key),
            });
        }
        let length = DQuat::from_array(values.map(|v| v / largest)).length() * largest;
        if (length - 1.0).abs() > UNIT_TOLERANCE {
            self.note(object.at(key), NoticeKind::Normalised);
        }
        let unit = values.map(|v| v / largest / (length / largest));
        Ok(DQuat::from_array(unit).as_quat())
    }

    /// Index of a name among those of the schema. The first stands for a missing key and for an unknown name.
    pub(super) fn choice(
        &mut self,
        object: &Object<'_>,
        key: &str,
    ) -> Result<usize, DocumentError> {
        let Kind::Name(names) = object.kind(key) else {
            debug_assert!(false, "{key} has no names in the schema");
            return Ok(0);
        };
        self.choice_of(object, key, names)
    }

    /// Index of a name among given ones. The first stands for a missing key and for an unknown name.
    fn choice_of(
        &mut self,
        object: &Object<'_>,
        key: &str,
        names: &[&str],
    ) -> Result<usize, DocumentError> {
        let Some(name) = object.text(key)? else {
            return Ok(0);
        };
        let found = names.iter().position(|known| *known == name);
        if found.is_none() {
            let instead = names.first().copied().unwrap_or_default();
            self.unknown_value(object.at(key), name, instead);
        }
        Ok(found.unwrap_or(0))
    }

    /// Reads a colour. If the text is none, `instead` is the colour that the notice names as drawn.
    pub(super) fn color(
        &mut self,
        object: &Object<'_>,
        key: &str,
        instead: &str,
    ) -> Result<Option<[u8; 3]>, DocumentError> {
        let Some(text) = object.text(key)? else {
            return Ok(None);
        };
        let found = color(text);
        if found.is_none() {
            self.unknown_value(object.at(key), text, instead);
        }
        Ok(found)
    }

    /// The text under a key, as far as it counts; a notice says if it is longer.
    pub(super) fn limited_text(
        &mut self,
        object: &Object<'_>,
        key: &str,
    ) -> Result<String, DocumentError> {
        let Kind::Limited { most } = object.kind(key) else {
            debug_assert!(false, "{key} has no limit in the schema");
            return object.string(key);
        };
        let text = object.text(key)?.unwrap_or_default();
        let Some((end, _)) = text.char_indices().nth(most) else {
            return Ok(text.to_owned());
        };
        self.note(
            object.at(key),
            NoticeKind::TooLong {
                found: text.chars().count(),
                most,
            },
        );
        Ok(text.get(..end).unwrap_or_default().to_owned())
    }

    /// The pairs of numbers of a list, as many as are drawn.
    pub(super) fn pairs(
        &mut self,
        object: &Object<'_>,
        key: &str,
    ) -> Result<Vec<Vec2>, DocumentError> {
        let mut pairs = Vec::new();
        for (i, value) in self.first(object, key)?.iter().enumerate() {
            let pointer = join(&object.at(key), &i.to_string());
            let pair: [f64; 2] = numbers(&pointer, value, "a list of two numbers")?;
            let drawn = self.clamp(|| pointer, pair, [-MAX_PAIR, MAX_PAIR]);
            pairs.push(DVec2::from_array(drawn).as_vec2());
        }
        Ok(pairs)
    }

    /// The first entries of a list, as many as are drawn; a notice says if there are more.
    pub(super) fn first<'a>(
        &mut self,
        object: &Object<'a>,
        key: &str,
    ) -> Result<&'a [Value], DocumentError> {
        let most = match object.kind(key) {
            Kind::Pairs { most } | Kind::Triples { most, .. } | Kind::FirstOf { most, .. } => most,
            _ => usize::MAX,
        };
        let items = object.list(key)?;
        if items.len() > most {
            self.note(
                object.at(key),
                NoticeKind::Clamped {
                    found: items.len().to_string(),
                    drawn: format!("the first {most}"),
                },
            );
        }
        Ok(items.get(..most).unwrap_or(items))
    }

    /// One or two numbers, a lower end and an upper end; without the second number there is no upper end.
    pub(super) fn value_range(
        &mut self,
        object: &Object<'_>,
        key: &str,
    ) -> Result<[f32; 2], DocumentError> {
        use crate::document::schema::MAX_VALUE;
        let ends = object.list(key)?;
        if !(1..=2).contains(&ends.len()) {
            let found = object.map.get(key).unwrap_or(&Value::Null);
            return Err(wrong(
                &object.at(key),
                "the lowest value and, where there is one, the highest",
                found,
            ));
        }
        let mut range = [0.0, MAX_VALUE];
        for (i, (slot, end)) in range.iter_mut().zip(ends).enumerate() {
            *slot = super::object::number(&join(&object.at(key), &i.to_string()), end)?;
        }
        let drawn = [range[0].min(range[1]), range[0].max(range[1])];
        let drawn = drawn.map(|v| v.clamp(-MAX_VALUE, MAX_VALUE));
        let drawn = self.clamped(|| object.at(key), range, drawn);
        Ok(drawn.map(|v| v as f32))
    }

    /// Names or numbers of segments, numbers as text.
    pub(super) fn segment_names(object: &Object<'_>) -> Result<Vec<String>, DocumentError> {
        let pointer = object.at("keep");
        let names = object.list("keep")?.iter().enumerate();
        names
            .map(|(i, value)| match value {
                Value::String(name) => Ok(name.clone()),
                Value::Number(number) if number.as_u64().is_some() => Ok(number.to_string()),
                other => Err(wrong(
                    &join(&pointer, &i.to_string()),
                    "a segment's name or number",
                    other,
                )),
            })
            .collect()
    }

    /// A parameter of a template.
    pub(super) fn param(
        &mut self,
        params: &Object<'_>,
        spec: &ParamSpec,
    ) -> Result<ParamValue, DocumentError> {
        let key = spec.name;
        if !params.map.contains_key(key) {
            return Ok(spec.kind.default_value());
        }
        Ok(match spec.kind {
            ParamKind::Number { default, min, max } => ParamValue::Number(self.number_in(
                params,
                key,
                f64::from(default),
                [f64::from(min), f64::from(max)],
            )?),
            ParamKind::Count { default, min, max } => {
                let value = params.number(key)?.unwrap_or(f64::from(default));
                let drawn = (value + 0.5).floor().clamp(f64::from(min), f64::from(max));
                let [drawn] = self.clamped(|| params.at(key), [value], [drawn]);
                ParamValue::Number(drawn as f32)
            }
            ParamKind::Flag { default } => {
                ParamValue::Flag(params.flag_if_any(key)?.unwrap_or(default))
            }
            ParamKind::Choice { names } => {
                ParamValue::Choice(self.choice_of(params, key, names)? as u32)
            }
            ParamKind::Vector {
                default,
                min,
                max,
                max_length,
            } => {
                let values = params
                    .numbers(key, "a list of three numbers")?
                    .unwrap_or(default.map(f64::from));
                let drawn = if max_length.is_finite() {
                    // A vector that is too long is scaled as a whole, so that its direction stays.
                    let largest = values.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
                    let length = if largest == 0.0 {
                        0.0
                    } else {
                        (DVec3::from_array(values) / largest).length() * largest
                    };
                    let limit = f64::from(max_length);
                    if length > limit {
                        values.map(|v| v / length * limit)
                    } else {
                        values
                    }
                } else {
                    values.map(|v| v.clamp(f64::from(min), f64::from(max)))
                };
                let drawn = self.clamped(|| params.at(key), values, drawn);
                ParamValue::Vector(DVec3::from_array(drawn).as_vec3())
            }
            ParamKind::Rotation => ParamValue::Rotation(self.rotation(params, key)?),
        })
    }
}

/// One number, or a list of them in brackets, as a document would write it.
fn written(values: &[f64]) -> String {
    let one = |value: f64| number_text(&json::number(value));
    match values {
        [value] => one(*value),
        values => {
            let texts: Vec<String> = values.iter().map(|v| one(*v)).collect();
            format!("[{}]", texts.join(", "))
        }
    }
}

/// `#rgb` or `#rrggbb` as bytes.
fn color(text: &str) -> Option<[u8; 3]> {
    let digits = text.strip_prefix('#')?;
    if !digits.bytes().all(|b| b.is_ascii_hexdigit()) {
        return None;
    }
    let byte = |from: usize, n: usize| u8::from_str_radix(digits.get(from..from + n)?, 16).ok();
    match digits.len() {
        3 => Some([byte(0, 1)? * 17, byte(1, 1)? * 17, byte(2, 1)? * 17]),
        6 => Some([byte(0, 2)?, byte(2, 2)?, byte(4, 2)?]),
        _ => None,
    }
}
