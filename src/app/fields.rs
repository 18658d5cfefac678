//! Displacement fields that a document names: asked for, kept while the window is open, laid over the subject that is shown.

use std::collections::BTreeMap;
use std::sync::Arc;

use serde_json::json;

use super::App;
use super::state::Gravity;
use super::words::{fill, said};
use crate::data::Grid;
use crate::document::{
    Edit, FieldRef, FieldSamples, Illustration, ParamValue, PlacedTemplate, TemplateData,
};
use crate::load::{FieldFile, FieldUse};

/// Units and axes, by their index in the catalogue.
type Choices = [u32; 2];

/// Fields as they are laid over the subject that is shown.
pub(crate) type Laid = Vec<(String, Choices, Option<FieldSamples>)>;

/// Files by the name that documents have for them, and what was made of them.
#[derive(Default)]
pub(super) struct Fields {
    /// None: asked for and not come.
    files: BTreeMap<String, Option<Arc<FieldFile>>>,
    laid: Laid,
    subject: Option<Grid>,
}

impl Fields {
    /// Another subject is shown.
    pub(super) fn set_subject(&mut self, grid: Grid) {
        if self.subject != Some(grid) {
            self.subject = Some(grid);
            self.laid.clear();
        }
    }
}

fn field_of(template: &PlacedTemplate) -> Option<(&FieldRef, &str, Choices)> {
    let TemplateData::Field(field) = &template.data else {
        return None;
    };
    let choices = [1, 2].map(|i| match template.params.get(i) {
        Some(ParamValue::Choice(choice)) => *choice,
        _ => 0,
    });
    Some((field, field.key()?, choices))
}

fn used(choices: Choices, subject: &Grid) -> FieldUse<'_> {
    FieldUse {
        is_subject_units: choices[0] == 1,
        is_lps: match choices[1] {
            1 => Some(true),
            2 => Some(false),
            _ => None,
        },
        subject,
    }
}

/// Gives the templates their samples, and the place that the file says where the document says none.
pub(super) fn attach(illustration: &mut Illustration, laid: &Laid) {
    for template in &mut illustration.templates {
        let Some((_, key, choices)) = field_of(template) else {
            continue;
        };
        let found = laid.iter().find(|(k, c, _)| k == key && *c == choices);
        let Some((_, _, Some(samples))) = found else {
            continue;
        };
        let placement = samples.0.placement;
        if let TemplateData::Field(field) = &mut template.data {
            if !field.is_placed {
                template.placement = placement;
            }
            field.samples = Some(samples.clone());
        }
    }
}

impl App {
    /// Asks for what the document shows and is not there, and lays what came over the subject.
    pub(super) fn follow_fields(&mut self) {
        let templates = &self.state.shown().templates;
        let wanted: Vec<(FieldRef, String, Choices)> = templates
            .iter()
            .filter(|template| template.enabled)
            .filter_map(field_of)
            .map(|(field, key, choices)| (field.clone(), key.to_owned(), choices))
            .collect();
        for (field, key, choices) in wanted {
            if !self.fields.files.contains_key(&key) {
                self.fields.files.insert(key.clone(), None);
                self.services.load_field(&field);
            }
            let is_laid = self
                .fields
                .laid
                .iter()
                .any(|(k, c, _)| *k == key && *c == choices);
            let (Some(Some(file)), Some(subject), false) =
                (self.fields.files.get(&key), self.fields.subject, is_laid)
            else {
                continue;
            };
            let samples = match file.fit(&used(choices, &subject)) {
                Ok((samples, notices)) => {
                    for line in notices {
                        self.state.say(Gravity::Warning, line, "");
                    }
                    Some(FieldSamples(Arc::new(samples)))
                }
                Err(why) => {
                    self.state.say(Gravity::Error, said::w().field_refused, why);
                    None
                }
            };
            self.fields.laid.push((key, choices, samples));
            self.state.revision += 1;
        }
        if let Some(picture) = &mut self.picture {
            picture.set_fields(&self.fields.laid);
        }
    }

    /// A field has come: one that was asked for by `key`, or one that the reader opened.
    pub(super) fn take_field(&mut self, key: Option<String>, outcome: Result<FieldFile, String>) {
        let file = match outcome {
            Ok(file) => Arc::new(file),
            Err(why) => return self.state.say(Gravity::Error, said::w().field_refused, why),
        };
        let hash = file.sha256.clone();
        if let Some(key) = key {
            let wanted = self
                .state
                .illustration()
                .templates
                .iter()
                .filter_map(field_of);
            let other = wanted
                .filter(|(_, k, _)| *k == key)
                .find_map(|(field, ..)| field.sha256.clone().filter(|w| *w != hash));
            if let Some(wanted) = other {
                let details = fill(said::w().other_file_details, &[&wanted, &hash]);
                return self
                    .state
                    .say(Gravity::Error, said::w().field_refused, details);
            }
            self.fields.files.insert(key, Some(file));
            return;
        }
        let mut all = self
            .state
            .illustration()
            .templates
            .iter()
            .filter_map(field_of);
        if all.any(|(field, ..)| field.sha256.as_ref() == Some(&hash)) {
            self.fields.files.insert(hash, Some(file));
            return;
        }
        // New to the document: where the file says, so that it can be taken hold of.
        let mut value = json!({ "kind": "field", "params": { "sha256": hash } });
        if let Some(subject) = &self.fields.subject {
            match file.fit(&used([0; 2], subject)) {
                Ok((samples, _)) => {
                    let p = samples.placement;
                    let short = |x: f32| (f64::from(x) * 1e4).round() / 1e4;
                    value["at"] = json!(p.at.to_array().map(short));
                    value["rotate"] = json!(p.rotate.to_array().map(short));
                    value["size"] = json!(p.size.to_array().map(short));
                }
                Err(why) => return self.state.say(Gravity::Error, said::w().field_refused, why),
            }
        }
        self.fields.files.insert(hash, Some(file));
        let edit = Edit::InsertTemplates {
            index: usize::MAX,
            templates: vec![value],
        };
        self.state.apply(&edit, false);
        self.state.selected = self.state.template_count().checked_sub(1);
    }
}
