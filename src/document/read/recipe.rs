//! Reads recipes: the entries of `subject.features`.

use super::object::{Object, number, numbers, wrong};
use super::reader::Reader;
use crate::document::model::{CleanStep, Recipe, RecipeSource, Stroke};
use crate::document::schema::{Kind, find};
use crate::document::text::pointer::join;
use crate::document::text::{DocumentError, NoticeKind, shortened};
use glam::{DVec3, IVec3, Vec3};
use serde_json::Value;

impl Reader {
    pub(super) fn recipes(&mut self, subject: &Object<'_>) -> Result<Vec<Recipe>, DocumentError> {
        let mut recipes = Vec::new();
        for (index, object) in subject.children("features")?.enumerate() {
            recipes.extend(self.recipe(index, &object?)?);
        }
        Ok(recipes)
    }

    fn recipe(
        &mut self,
        index: usize,
        object: &Object<'_>,
    ) -> Result<Option<Recipe>, DocumentError> {
        self.unknown_keys(object);
        let name = match object.string("name")? {
            name if name.is_empty() => format!("feature {}", index + 1),
            name => name,
        };
        let color_srgb = self.color(object, "color", "a color of the program's")?;
        let from = object.child("from")?;
        self.unknown_keys(&from);
        let from = if from.map.contains_key("grow") {
            let grow = from.child("grow")?;
            self.unknown_keys(&grow);
            Some(RecipeSource::Grow {
                seeds: self.seeds(&grow)?,
                range: self.value_range(&grow, "range")?,
            })
        } else if from.map.contains_key("threshold") {
            Some(RecipeSource::Threshold {
                range: self.value_range(&from, "threshold")?,
            })
        } else if object.map.contains_key("paint") && !object.map.contains_key("from") {
            Some(RecipeSource::Nothing)
        } else {
            self.note(
                from.pointer.clone(),
                NoticeKind::NotDrawn {
                    what: "features are found by threshold or grow; this one is",
                },
            );
            None
        };
        let mut clean = Vec::new();
        for step in object.children("clean")? {
            clean.extend(self.clean_step(&step?)?);
        }
        let mut paint = Vec::new();
        for stroke in object.children("paint")? {
            paint.push(self.stroke(&stroke?)?);
        }
        Ok(from.map(|from| Recipe {
            index,
            name,
            color_srgb,
            from,
            clean,
            paint,
        }))
    }

    fn stroke(&mut self, object: &Object<'_>) -> Result<Stroke, DocumentError> {
        self.unknown_keys(object);
        Ok(Stroke {
            erases: object.flag("erase")?,
            radius_mm: self.number(object, "radius")?,
            places: self.places(object, "path")?,
        })
    }

    /// The places of a path: the first, then each less the one before.
    pub(super) fn places(
        &mut self,
        object: &Object<'_>,
        key: &str,
    ) -> Result<Vec<IVec3>, DocumentError> {
        let (most, max) = match object.kind(key) {
            Kind::Path { most, max } => (most, max),
            _ => (usize::MAX, f64::MAX),
        };
        let items = object.list(key)?;
        if items.is_empty() || items.len() % 3 != 0 {
            let found = object.map.get(key).unwrap_or(&Value::Null);
            let expected = "a list of whole numbers, three for each place";
            return Err(wrong(&object.at(key), expected, found));
        }
        if items.len() / 3 > most {
            return Err(DocumentError::TooMany {
                pointer: object.at(key),
                what: "places",
                found: items.len() / 3,
                limit: most,
            });
        }
        let mut places = Vec::with_capacity(items.len() / 3);
        let mut place = DVec3::ZERO;
        for (i, step) in items.chunks_exact(3).enumerate() {
            let at = |k: usize| join(&object.at(key), &(3 * i + k).to_string());
            for k in 0..3 {
                let value = number(&at(k), &step[k])?;
                let whole = (value + 0.5).floor();
                let drawn = (place[k] + whole).clamp(-max, max) - place[k];
                let [step] = self.clamped(|| at(k), [value], [drawn]);
                place[k] += step;
            }
            places.push(place.as_ivec3());
        }
        Ok(places)
    }

    fn seeds(&mut self, object: &Object<'_>) -> Result<Vec<Vec3>, DocumentError> {
        let max = match object.kind("seeds") {
            Kind::Vectors { max, .. } => max,
            _ => f64::MAX,
        };
        let mut seeds = Vec::new();
        for (i, value) in object.limited_list("seeds")?.iter().enumerate() {
            let pointer = join(&object.at("seeds"), &i.to_string());
            let seed = numbers(&pointer, value, "a list of three numbers")?;
            let seed = self.clamp(|| pointer, seed, [-max, max]);
            seeds.push(DVec3::from_array(seed).as_vec3());
        }
        Ok(seeds)
    }

    fn clean_step(&mut self, step: &Object<'_>) -> Result<Option<CleanStep>, DocumentError> {
        let expected = "an object of one key: largest, fill, close, smooth, grow or shrink";
        let [key] = step.map.keys().collect::<Vec<_>>()[..] else {
            let found = Value::Object(step.map.clone());
            return Err(wrong(&step.pointer, expected, &found));
        };
        Ok(Some(
            match (key.as_str(), find(step.keys, key).map(|key| key.kind)) {
                ("close", _) => CleanStep::Close(self.number(step, key)?),
                ("grow", _) => CleanStep::Grow(self.number(step, key)?),
                ("shrink", _) => CleanStep::Shrink(self.number(step, key)?),
                ("smooth", _) => CleanStep::Smooth(self.number(step, key)?),
                ("fill", _) => match step.flag(key)? {
                    true => CleanStep::Fill,
                    false => return Ok(None),
                },
                ("largest", Some(Kind::Number { default, min, max })) => {
                    let value = step.number(key)?.unwrap_or(default);
                    let drawn = (value + 0.5).floor().clamp(min, max);
                    let [count] = self.clamped(|| step.at(key), [value], [drawn]);
                    CleanStep::Largest(count as u32)
                }
                (other, _) => {
                    let what = shortened(other, 40);
                    self.unknown_value(
                        step.pointer.clone(),
                        &what,
                        "the feature without this step",
                    );
                    return Ok(None);
                }
            },
        ))
    }
}
