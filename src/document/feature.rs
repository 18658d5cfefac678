//! Features made here: the recipe by which an author's program, and every reader's, finds a tissue in a scan that has no labels for it.
//!
//! ```json
//! { "subject": { "sha256": "…", "features": [
//!     { "name": "bone", "color": "#eadfc4", "from": { "threshold": [200, 3000] },
//!       "clean": [ { "largest": 1 }, { "close": 2 }, { "fill": true }, { "smooth": 1 } ] },
//!     { "name": "aorta", "from": { "grow": { "seeds": [[0.02, 0.05, 0.1]], "range": [150, 400] } } } ] } }
//! ```
//!
//! Values are the scan's own (Hounsfield units for a CT), seeds lie in the undeformed subject, lengths of the clean-up are millimetres. The
//! clean-up is done in the order in which it is listed. What comes out is the same bit for bit on every machine
//! ([`crate::document::FeatureRecipe`] is all that it depends on, besides the voxels).

use serde_json::{Map, Value, json};

use super::edit::hex;
use super::error::DocumentError;
use super::json::shortened;
use super::notice::NoticeKind;
use super::object::{Object, wrong};
use super::pointer::join;
use super::resolve::{Reader, color};
use glam::Vec3;

/// Features in a document at most.
pub const MAX_FEATURES: usize = 16;
/// Steps of one feature's clean-up at most.
pub const MAX_CLEAN_STEPS: usize = 16;
/// Seeds of one feature at most.
pub const MAX_SEEDS: usize = 64;
/// Longest reach of a step of the clean-up, mm.
pub const MAX_CLEAN_MM: f32 = 50.0;
/// Widest smoothing, mm (standard deviation).
pub const MAX_SMOOTH_MM: f32 = 10.0;
/// Parts that may be kept at most.
const MAX_PARTS: f64 = 1000.0;
/// Values beyond this are taken as without an end.
const MAX_VALUE: f64 = f32::MAX as f64 / 4.0;

/// How a feature is found in the voxels of a scan.
#[derive(Clone, Debug, PartialEq)]
pub struct FeatureRecipe {
    /// Index in the document's `subject.features`, which may also hold recipes unknown to this version.
    pub index: usize,
    /// By which `keep` means it; never empty.
    pub name: String,
    /// Shown in it where segments tint, sRGB bytes; none: one of the program's.
    pub color_srgb: Option<[u8; 3]>,
    /// What it is at first.
    pub from: FeatureSource,
    /// What is done to it then, in this order.
    pub clean: Vec<CleanStep>,
}

/// The first draft of a feature.
#[derive(Clone, Debug, PartialEq)]
pub enum FeatureSource {
    /// All voxels with a value in the range, ends included.
    Threshold {
        /// Lowest and highest value.
        range: [f32; 2],
    },
    /// The voxels with a value in the range that hang together, over faces, with the voxel of a seed.
    Grow {
        /// In the undeformed subject, subject units.
        seeds: Vec<Vec3>,
        /// Lowest and highest value, ends included.
        range: [f32; 2],
    },
}

impl FeatureSource {
    /// Lowest and highest value, ends included.
    pub fn range(&self) -> [f32; 2] {
        match self {
            Self::Threshold { range } | Self::Grow { range, .. } => *range,
        }
    }
}

/// One step of a clean-up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CleanStep {
    /// Keeps so many of the largest parts (what hangs together over faces); of parts of one size the one that comes first in the file.
    Largest(u32),
    /// Fills what is closed in on all sides.
    Fill,
    /// Closes gaps up to twice as wide: grows by so many mm and shrinks again.
    Close(f32),
    /// Smooths the outline by a Gaussian of this standard deviation, mm.
    Smooth(f32),
    /// Adds what is at most so many mm away.
    Grow(f32),
    /// Takes away what is at most so many mm from the outside.
    Shrink(f32),
}

impl CleanStep {
    fn value(self) -> Value {
        let mm = |mm: f32| json!((f64::from(mm) * 100.0).round() / 100.0);
        match self {
            Self::Largest(count) => json!({ "largest": count }),
            Self::Fill => json!({ "fill": true }),
            Self::Close(by) => json!({ "close": mm(by) }),
            Self::Smooth(by) => json!({ "smooth": mm(by) }),
            Self::Grow(by) => json!({ "grow": mm(by) }),
            Self::Shrink(by) => json!({ "shrink": mm(by) }),
        }
    }
}

impl FeatureRecipe {
    /// The recipe as it stands in a document. Seeds are rounded to four decimals, lengths to hundredths of a millimetre, values to
    /// hundredths.
    pub fn to_value(&self) -> Value {
        let rounded = |value: f32, to: f64| json!((f64::from(value) * to).round() / to);
        let range = |range: &[f32; 2]| {
            let mut list = vec![rounded(range[0], 100.0)];
            if f64::from(range[1]) < MAX_VALUE {
                list.push(rounded(range[1], 100.0));
            }
            list
        };
        let mut value = json!({ "name": self.name });
        let mut set = |key: &str, to: Value| value[key] = to;
        if let Some(color_srgb) = self.color_srgb {
            set("color", json!(hex(color_srgb)));
        }
        set(
            "from",
            match &self.from {
                FeatureSource::Threshold { range: ends } => json!({ "threshold": range(ends) }),
                FeatureSource::Grow { seeds, range: ends } => {
                    let seeds: Vec<Value> = seeds
                        .iter()
                        .map(|s| Value::from(s.to_array().map(|x| rounded(x, 1e4)).to_vec()))
                        .collect();
                    json!({ "grow": { "seeds": seeds, "range": range(ends) } })
                }
            },
        );
        if !self.clean.is_empty() {
            set(
                "clean",
                self.clean.iter().map(|step| step.value()).collect(),
            );
        }
        value
    }
}

impl Reader {
    pub(super) fn features(
        &mut self,
        subject: &Object<'_>,
    ) -> Result<Vec<FeatureRecipe>, DocumentError> {
        let mut features = Vec::new();
        let items = subject.limited_list("features", "features", MAX_FEATURES)?;
        for (index, value) in items.iter().enumerate() {
            let object = Object::new(join(&subject.at("features"), &index.to_string()), value)?;
            features.extend(self.feature(index, &object)?);
        }
        Ok(features)
    }

    fn feature(
        &mut self,
        index: usize,
        object: &Object<'_>,
    ) -> Result<Option<FeatureRecipe>, DocumentError> {
        self.unknown_keys(object, &["name", "color", "from", "clean"]);
        let name = match object.string("name")? {
            name if name.is_empty() => format!("feature {}", index + 1),
            name => name,
        };
        let color_srgb = match object.text("color")? {
            None => None,
            Some(text) => {
                let known = color(text);
                if known.is_none() {
                    self.unknown_value(object.at("color"), text, "a color of the program's");
                }
                known
            }
        };
        let from = object.child("from")?;
        self.unknown_keys(&from, &["threshold", "grow"]);
        let from = if from.map.contains_key("grow") {
            let grow = from.child("grow")?;
            self.unknown_keys(&grow, &["seeds", "range"]);
            Some(FeatureSource::Grow {
                seeds: self.seeds(&grow)?,
                range: self.value_range(&grow, "range")?,
            })
        } else if from.map.contains_key("threshold") {
            Some(FeatureSource::Threshold {
                range: self.value_range(&from, "threshold")?,
            })
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
        let steps = object.limited_list("clean", "steps of a clean-up", MAX_CLEAN_STEPS)?;
        for (i, value) in steps.iter().enumerate() {
            let step = Object::new(join(&object.at("clean"), &i.to_string()), value)?;
            clean.extend(self.clean_step(&step)?);
        }
        Ok(from.map(|from| FeatureRecipe {
            index,
            name,
            color_srgb,
            from,
            clean,
        }))
    }

    /// One or two numbers: without the second there is no upper end.
    fn value_range(&mut self, object: &Object<'_>, key: &str) -> Result<[f32; 2], DocumentError> {
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

    fn seeds(&mut self, object: &Object<'_>) -> Result<Vec<Vec3>, DocumentError> {
        let items = object.limited_list("seeds", "seeds", MAX_SEEDS)?;
        let pointer = object.at("seeds");
        let list: Map<String, Value> = items
            .iter()
            .enumerate()
            .map(|(i, seed)| (i.to_string(), seed.clone()))
            .collect();
        let list = Object {
            pointer,
            map: &list,
        };
        let mut seeds = Vec::with_capacity(items.len());
        for i in 0..items.len() {
            let key = i.to_string();
            let seed = list.numbers::<3>(&key, "a list of three numbers")?;
            let seed = self.clamp(|| list.at(&key), seed.unwrap_or_default(), [-1e4, 1e4]);
            seeds.push(Vec3::from_array(seed.map(|x| x as f32)));
        }
        Ok(seeds)
    }

    fn clean_step(&mut self, step: &Object<'_>) -> Result<Option<CleanStep>, DocumentError> {
        let expected = "an object of one key: largest, fill, close, smooth, grow or shrink";
        let [key] = step.map.keys().collect::<Vec<_>>()[..] else {
            let found = Value::Object(step.map.clone());
            return Err(wrong(&step.pointer, expected, &found));
        };
        let mut mm = |most: f32| -> Result<f32, DocumentError> {
            let value = step.number(key)?.unwrap_or_default();
            let [value] = self.clamp(|| step.at(key), [value], [0.0, f64::from(most)]);
            Ok(value as f32)
        };
        Ok(Some(match key.as_str() {
            "close" => CleanStep::Close(mm(MAX_CLEAN_MM)?),
            "grow" => CleanStep::Grow(mm(MAX_CLEAN_MM)?),
            "shrink" => CleanStep::Shrink(mm(MAX_CLEAN_MM)?),
            "smooth" => CleanStep::Smooth(mm(MAX_SMOOTH_MM)?),
            "fill" => match step.flag(key)? {
                Some(true) => CleanStep::Fill,
                _ => return Ok(None),
            },
            "largest" => {
                let value = step.number(key)?.unwrap_or(1.0);
                let drawn = (value + 0.5).floor().clamp(1.0, MAX_PARTS);
                let [count] = self.clamped(|| step.at(key), [value], [drawn]);
                CleanStep::Largest(count as u32)
            }
            other => {
                let what = shortened(other, 40);
                self.unknown_value(step.pointer.clone(), &what, "the feature without this step");
                return Ok(None);
            }
        }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::Document;

    fn read(features: &str) -> Result<Document, DocumentError> {
        Document::from_json(&format!(
            r#"{{"fabrica":1,"subject":{{"builtin":"knee","features":{features}}}}}"#
        ))
    }

    #[test]
    fn recipes_are_read_and_written_as_they_are() {
        let text = r##"[{"name":"bone","color":"#eadfc4","from":{"threshold":[200]},"clean":[{"largest":2},{"close":2},{"fill":true},{"smooth":1.5},{"grow":1},{"shrink":0.5}]},{"name":"vessel","from":{"grow":{"seeds":[[0.1,-0.2,0.3]],"range":[150,400]}}}]"##;
        let document = read(text).expect("a document");
        assert_eq!(document.notices(), &[], "nothing to say");
        let features = &document.illustration().features;
        assert_eq!(features.len(), 2);
        assert_eq!(features[0].clean.len(), 6);
        assert_eq!(features[0].clean[3], CleanStep::Smooth(1.5));
        assert!(
            features[0].from.range()[1] > 1e30,
            "one number has no upper end"
        );
        let written: Vec<Value> = features.iter().map(FeatureRecipe::to_value).collect();
        let whole = document.to_json_compact();
        let again = read(&Value::from(written).to_string()).expect("as written");
        assert_eq!(again.to_json_compact(), whole);
        assert_eq!(
            Document::from_json(&whole)
                .expect("again")
                .to_json_compact(),
            whole
        );
        assert!(whole.contains(text), "keys in their order: {whole}");
    }

    #[test]
    fn hostile_recipes_are_refused_or_clamped_in_words() {
        let refused = |features: &str, pointer: &str| {
            let error = read(features).expect_err(features).to_string();
            assert!(error.starts_with(pointer), "{error}");
        };
        refused("{}", "/subject/features: expected a list");
        refused("[7]", "/subject/features/0: expected an object");
        refused(
            r#"[{"from":{"threshold":[]}}]"#,
            "/subject/features/0/from/threshold",
        );
        refused(
            r#"[{"from":{"threshold":[1,2,3]}}]"#,
            "/subject/features/0/from/threshold",
        );
        refused(
            r#"[{"from":{"threshold":["a"]}}]"#,
            "/subject/features/0/from/threshold/0",
        );
        refused(
            r#"[{"from":{"grow":{"seeds":[[0,0]],"range":[1,2]}}}]"#,
            "/subject/features/0/from/grow/seeds/0",
        );
        refused(
            r#"[{"from":{"grow":{"seeds":[]}}}]"#,
            "/subject/features/0/from/grow/range",
        );
        refused(
            r#"[{"from":{"threshold":[1]},"clean":[{"grow":1,"shrink":1}]}]"#,
            "/subject/features/0/clean/0",
        );
        refused(
            r#"[{"from":{"threshold":[1]},"clean":[{"grow":"x"}]}]"#,
            "/subject/features/0/clean/0/grow",
        );
        for text in ["NaN", "1e999"] {
            read(&format!(r#"[{{"from":{{"threshold":[{text}]}}}}]"#)).expect_err(text);
        }
        let seeds = vec!["[0,0,0]"; MAX_SEEDS + 1].join(",");
        refused(
            &format!(r#"[{{"from":{{"grow":{{"seeds":[{seeds}],"range":[1,2]}}}}}}]"#),
            "/subject/features/0/from/grow/seeds: 65 seeds",
        );
        let many = vec![r#"{"from":{"threshold":[1]}}"#; MAX_FEATURES + 1].join(",");
        refused(&format!("[{many}]"), "/subject/features: 17 features");

        let odd = read(
            r#"[{"from":{"threshold":[9,3]},"clean":[{"grow":1e9},{"largest":0},{"sharpen":1},{"smooth":-1}]},{"name":"x"}]"#,
        )
        .expect("clamped");
        let said: Vec<String> = odd.notices().iter().map(ToString::to_string).collect();
        for part in [
            "/subject/features/0/from/threshold: [9, 3]",
            "/subject/features/0/clean/0/grow: 1000000000",
            "/subject/features/0/clean/1/largest: 0",
            "/subject/features/0/clean/2: this version does not know “sharpen”",
            "/subject/features/0/clean/3/smooth: -1",
            "/subject/features/1/from: features are found by threshold or grow",
        ] {
            assert!(
                said.iter().any(|line| line.starts_with(part)),
                "{part}: {said:#?}"
            );
        }
        let features = &odd.illustration().features;
        assert_eq!(features.len(), 1, "the one that is known");
        assert_eq!(features[0].name, "feature 1");
        assert_eq!(features[0].from.range(), [3.0, 9.0]);
        assert_eq!(
            features[0].clean,
            [
                CleanStep::Grow(MAX_CLEAN_MM),
                CleanStep::Largest(1),
                CleanStep::Smooth(0.0)
            ]
        );
    }
}
