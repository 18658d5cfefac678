//! Steps: what each of them sets in the document.

use super::read::resolve;
use super::schema::{Key, is_fixed, list_with_fixed};
use super::text::{DocumentError, Notice, NoticeKind, json, pointer};
use super::write::set;
use serde_json::{Map, Value};

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
            let result = json::normalise(&mut state.clone(), 0).and_then(|()| resolve(map));
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

/// Calls `visit` with the tree at every step, step 0 first, without its steps.
///
/// # Errors
/// The first error of `visit`; the rest cannot happen in a document that was checked.
pub(super) fn walk(
    root: &Value,
    mut visit: impl FnMut(&Value) -> Result<(), DocumentError>,
) -> Result<(), DocumentError> {
    let mut state = without_steps(root);
    visit(&state)?;
    for (i, step) in steps_of(root).iter().enumerate() {
        apply(&mut state, step, &format!("/steps/{i}/set"), |_, _| {})?;
        visit(&state)?;
    }
    Ok(())
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

/// What of the entries of a list no step may change: how many there are, and their values under fixed keys. An empty
/// text is no value.
fn fixed_parts(state: &Value, list: &str, of: &[Key]) -> Vec<Vec<Option<Value>>> {
    let entries = state.get(list).and_then(Value::as_array);
    let fixed_of = |entry: &Value| {
        let fixed = of.iter().filter(|key| key.is_fixed);
        let value = |key: &Key| entry.get(key.name).filter(|v| v.as_str() != Some(""));
        fixed.map(|key| value(key).cloned()).collect()
    };
    entries.into_iter().flatten().map(fixed_of).collect()
}

fn apply(
    state: &mut Value,
    step: &Value,
    at: &str,
    mut dangling: impl FnMut(String, &str),
) -> Result<(), DocumentError> {
    let Some(Value::Object(values)) = step.get("set") else {
        return Ok(());
    };
    for (target, value) in values {
        let entry = || pointer::shortened(&pointer::join(at, target));
        let keys = pointer::keys(target)?;
        let refused = || DocumentError::Refused { pointer: entry() };
        if keys.is_empty() || is_fixed(&keys) {
            return Err(refused());
        }
        let whole = list_with_fixed(&keys);
        let before = whole.map(|(list, of)| fixed_parts(state, list, of));
        let result = set(state, target, value.clone());
        if before != whole.map(|(list, of)| fixed_parts(state, list, of)) {
            return Err(refused());
        }
        match result {
            Ok(()) => {}
            Err(DocumentError::NotFound { .. }) => dangling(entry(), &pointer::shortened(target)),
            Err(other) => return Err(other),
        }
    }
    Ok(())
}
