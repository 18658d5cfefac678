//! Taking the templates of one document over into another, with what belongs to them: the steps that move them, and the
//! recipes of the tissue that they keep.

use serde_json::Value;

use super::authoring::{free_group_name, groups};
use super::text::pointer::{index, join, keys};
use super::tree::Document;
use super::write::Edit;

/// The edit that adds the templates of `from` to `into`, and its name in the menu; `None` if `from` has no templates.
///
/// With the templates come the steps of `from`, as far as they change templates, if `into` has no steps of its own; and
/// the recipes by threshold of tissue that the templates keep in place or give way to. Recipes that grow from seeds
/// stay behind, since their seeds are places in another subject, and so do recipes of names that `into` or `segments`,
/// the segments of its subject, has already.
pub fn carried_templates(from: &Document, into: &Document, segments: &[&str]) -> Option<Edit> {
    let mut templates = list(from, "/templates").to_vec();
    if templates.is_empty() {
        return None;
    }
    let mut edits = Vec::new();
    let recipes = recipes(from, into, segments, &templates);
    if !recipes.is_empty() {
        let all = [list(into, "/subject/features"), &recipes].concat();
        edits.push(Edit::Set {
            pointer: "/subject/features".to_owned(),
            value: Value::from(all),
            name: String::new(),
        });
    }
    let taken = groups(into);
    for template in &mut templates {
        if let Some(Value::String(group)) = template.get_mut("group") {
            *group = free_group_name(group, &taken);
        }
    }
    edits.push(Edit::InsertTemplates {
        index: usize::MAX,
        templates,
    });
    if into.step_count() == 0 {
        let first = list(into, "/templates").len();
        let steps = list(from, "/steps").iter();
        let steps = steps.map(|step| Edit::AddStep {
            index: usize::MAX,
            step: of_templates(step, first),
        });
        edits.extend(steps);
    }
    Some(Edit::All {
        name: "Keep templates".to_owned(),
        edits,
    })
}

/// Entries of a list of a document; none where the key stands at its default.
fn list<'a>(document: &'a Document, pointer: &str) -> &'a [Value] {
    let value = document.get(pointer).and_then(Value::as_array);
    value.map_or(&[], Vec::as_slice)
}

/// A step with those of its changes that are about templates, which come behind `first` others.
fn of_templates(step: &Value, first: usize) -> Value {
    let mut step = step.clone();
    if let Some(Value::Object(set)) = step.get_mut("set") {
        let all = std::mem::take(set);
        for (target, value) in all {
            let keys = keys(&target).unwrap_or_default();
            let [list, at, rest @ ..] = keys.as_slice() else {
                continue;
            };
            if list == "templates"
                && let Some(at) = index(at)
            {
                let head = join("/templates", &(at + first).to_string());
                set.insert(rest.iter().fold(head, |p, key| join(&p, key)), value);
            }
        }
    }
    step
}

/// The recipes of `from` that go with its templates and that `into` and its subject do not have.
fn recipes(from: &Document, into: &Document, segments: &[&str], templates: &[Value]) -> Vec<Value> {
    let named = |key: &'static str| {
        let kept = templates
            .iter()
            .filter_map(move |t| t.get(key)?.get("keep"));
        kept.filter_map(Value::as_array).flatten()
    };
    let kept: Vec<&str> = named("align")
        .chain(named("constrain"))
        .filter_map(Value::as_str)
        .collect();
    let name_of = |recipe: &Value| {
        recipe
            .get("name")
            .and_then(Value::as_str)
            .map(str::to_owned)
    };
    let is_there = |name: &str| {
        let mut own = list(into, "/subject/features").iter().filter_map(name_of);
        segments.contains(&name) || own.any(|own| own == name)
    };
    let is_carried = |recipe: &&Value| {
        let by_threshold = recipe
            .get("from")
            .is_some_and(|from| from.get("threshold").is_some());
        let name = name_of(recipe).unwrap_or_default();
        by_threshold && kept.contains(&name.as_str()) && !is_there(&name)
    };
    let all = list(from, "/subject/features").iter();
    all.filter(is_carried).cloned().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    const FROM: &str = r##"{ "fabrica": 1, "title": "Scalp", "labels": [{ "at": [0, 0, 0.4], "text": "Here" }],
        "subject": { "builtin": "head", "features": [
            { "name": "dense", "from": { "threshold": [300, 3000] } },
            { "name": "vessel", "from": { "grow": { "seeds": [[0, 0, 0]], "range": [100, 200] } } },
            { "name": "unused", "from": { "threshold": [0, 10] } } ] },
        "templates": [
            { "kind": "peel", "group": "lid", "align": { "to": "segment", "keep": ["dense", "vessel", "skin"] } },
            { "kind": "newer" } ],
        "steps": [{ "title": "Open", "set": { "/templates/0/amount": 0.5, "/labels/0/text": "There" } }] }"##;

    fn document(json: &str) -> Document {
        Document::from_json(json).expect("a document")
    }

    #[test]
    fn templates_come_with_what_belongs_to_them() {
        let (from, into) = (document(FROM), Document::new());
        let edit = carried_templates(&from, &into, &[]).expect("there are templates");
        let all = edit.apply(&into).expect("it takes them");
        assert_eq!(all.get("/templates"), from.get("/templates"));
        let recipes = &all.illustration().recipes;
        assert_eq!(recipes.len(), 1, "the one that is kept and has no seeds");
        assert_eq!(recipes[0].name, "dense");
        let step = &all.illustration().steps[0];
        assert_eq!(step.title, "Open");
        let set = all.get("/steps/0/set");
        assert_eq!(
            set,
            Some(&json!({ "/templates/0/amount": 0.5 })),
            "without the label"
        );
        assert!(all.illustration().captions.is_empty());
        assert_eq!(all.illustration().title, "");
        let edit = carried_templates(&from, &into, &["dense"]).expect("there are templates");
        let all = edit.apply(&into).expect("it takes them");
        assert!(
            all.illustration().recipes.is_empty(),
            "the scan has its own"
        );
        assert!(carried_templates(&into, &from, &[]).is_none());
    }

    #[test]
    fn what_is_there_stays() {
        let into =
            document(r#"{ "fabrica": 1, "templates": [{ "kind": "hole", "group": "lid" }] }"#);
        let edit = carried_templates(&document(FROM), &into, &[]).expect("there are templates");
        let all = edit.apply(&into).expect("it takes them");
        assert_eq!(all.get("/templates/0"), into.get("/templates/0"));
        assert_eq!(groups(&all), ["lid", "lid 2"]);
        let amount = all.at_step(1).expect("a step");
        assert_eq!(amount.get("/templates/1/amount"), Some(&json!(0.5)));
    }
}
