//! Edits of a document that has steps: what is done while a step is shown goes into what that step sets, and steps that
//! are added, moved or removed leave the others as they look.

use super::canonical;
use super::difference::difference;
use super::limits::{MAX_LABELS, MAX_OBJECTS, MAX_STEPS, MAX_TEMPLATES};
use super::read::resolve;
use super::schema::is_fixed;
use super::steps;
use super::text::pointer::{self, join};
use super::text::{DocumentError, json};
use super::write::{Edit, FigureList, insert, list, set, take};
use serde_json::{Map, Value, json};

/// Does an edit in a tree.
///
/// # Errors
/// If there is no such template, caption or step, or a limit would be passed.
pub(super) fn apply(root: &mut Value, edit: &Edit) -> Result<(), DocumentError> {
    match edit {
        Edit::All { edits, .. } => edits.iter().try_for_each(|edit| apply(root, edit)),
        Edit::AtStep { step, edit } => at_step(root, *step, edit),
        Edit::AddStep { index, step } => {
            let count = step_count(root);
            if count >= MAX_STEPS {
                return Err(DocumentError::TooMany {
                    pointer: "/steps".to_owned(),
                    what: "steps",
                    found: count + 1,
                    limit: MAX_STEPS,
                });
            }
            rearrange(root, |all| {
                all.insert((*index).min(count), (step.clone(), None));
            })
        }
        Edit::RemoveStep { step } => {
            is_there(root, *step)?;
            rearrange(root, |all| {
                all.remove(*step);
            })
        }
        Edit::DuplicateStep { step } => {
            is_there(root, *step)?;
            let mut copy = step_at(root, *step).cloned().unwrap_or_default();
            if let Some(map) = copy.as_object_mut() {
                map.remove("set");
            }
            let index = step + 1;
            apply(root, &Edit::AddStep { index, step: copy })
        }
        Edit::MoveStep { from, to } => {
            is_there(root, *from)?;
            is_there(root, *to)?;
            rearrange(root, |all| {
                let step = all.remove(*from);
                all.insert(*to, step);
            })
        }
        other => other.change(root),
    }
}

/// The entry of `steps` for a step that comes after another one and shows what `edit` makes of that one's state.
///
/// # Errors
/// [`DocumentError::NoSuchStep`], and as [`apply`].
pub(super) fn step_after(root: &Value, step: usize, edit: &Edit) -> Result<Value, DocumentError> {
    let before = state(root, step)?;
    let after = changed(&before, edit)?;
    let set: Map<String, Value> = difference(&before, &after).into_iter().collect();
    Ok(json!({ "set": set }))
}

// ---------------------------------------------------------------------------------------- the steps of a tree

fn steps_of(root: &Value) -> &[Value] {
    let steps = root.get("steps").and_then(Value::as_array);
    steps.map_or(&[], Vec::as_slice)
}

fn step_count(root: &Value) -> usize {
    steps_of(root).len()
}

/// The entry of a step, counted from 0 for the first after step 0.
fn step_at(root: &Value, index: usize) -> Option<&Value> {
    steps_of(root).get(index)
}

fn is_there(root: &Value, index: usize) -> Result<(), DocumentError> {
    match step_at(root, index) {
        Some(_) => Ok(()),
        None => Err(DocumentError::NotFound {
            pointer: format!("/steps/{index}"),
        }),
    }
}

/// What a step sets; made if it sets nothing yet. Steps are counted from 1.
fn set_of(root: &mut Value, step: usize) -> Option<&mut Map<String, Value>> {
    let step = list(root, "steps").ok()?.get_mut(step.checked_sub(1)?)?;
    let set = step.as_object_mut()?.entry("set");
    set.or_insert_with(|| json!({})).as_object_mut()
}

/// The document at a step, without its steps, in canonical form.
fn state(root: &Value, step: usize) -> Result<Value, DocumentError> {
    let mut state = steps::at_step(root, step, step_count(root))?;
    make_canonical(&mut state)?;
    Ok(state)
}

fn make_canonical(state: &mut Value) -> Result<(), DocumentError> {
    json::normalise(state, 0)?;
    let map = state.as_object_mut().ok_or(DocumentError::NoVersion)?;
    resolve(map)?;
    canonical::strip(map);
    Ok(())
}

/// A state with an edit done, in canonical form.
fn changed(state: &Value, edit: &Edit) -> Result<Value, DocumentError> {
    let mut after = state.clone();
    apply(&mut after, edit)?;
    make_canonical(&mut after)?;
    Ok(after)
}

/// True if an entry of `templates`, `labels`, `objects` or a figure's handles is in a state and not switched off.
fn is_shown(state: &Value, entry: &str) -> bool {
    let entry = pointer::get(state, entry);
    entry.is_some_and(|entry| entry.get("enabled") != Some(&json!(false)))
}

/// True if a pointer points at `entry` or at something inside.
fn is_in(target: &str, entry: &str) -> bool {
    let rest = target.strip_prefix(entry);
    rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('/'))
}

// ---------------------------------------------------------------------------------------- while a step is shown

fn at_step(root: &mut Value, step: usize, edit: &Edit) -> Result<(), DocumentError> {
    let last = step_count(root);
    if step > last {
        return Err(DocumentError::NoSuchStep { step, last });
    }
    if step == 0 {
        return apply(root, edit);
    }
    match edit {
        Edit::All { edits, .. } => edits.iter().try_for_each(|edit| at_step(root, step, edit)),
        Edit::SetTitle(_)
        | Edit::SetLegend(_)
        | Edit::SetCredit(_)
        | Edit::SetLang(_)
        | Edit::SetSubject(_)
        | Edit::RenameTemplate { .. }
        | Edit::SetGroup { .. }
        | Edit::MoveTemplate { .. }
        | Edit::AddStroke { .. }
        | Edit::RemoveStroke { .. }
        | Edit::AddMesh { .. }
        | Edit::RemoveMesh { .. }
        | Edit::MoveObject { .. }
        | Edit::MoveInFigure { .. }
        | Edit::AtStep { .. }
        | Edit::AddStep { .. }
        | Edit::RemoveStep { .. }
        | Edit::DuplicateStep { .. }
        | Edit::MoveStep { .. } => apply(root, edit),
        Edit::Set { pointer, .. } | Edit::Reset { pointer, .. } if is_of_all_steps(pointer) => {
            apply(root, edit)
        }
        Edit::AddTemplate { .. }
        | Edit::InsertTemplates { .. }
        | Edit::DuplicateTemplate { .. }
        | Edit::AddObject { .. }
        | Edit::DuplicateObject { .. }
        | Edit::AddCaption(_)
        | Edit::AddToFigure {
            list: FigureList::Handles,
            ..
        } => appear(root, step, edit),
        Edit::RemoveFromFigure {
            list: FigureList::Handles,
            index,
        } => vanish(root, step, FigureList::Handles.key(), *index),
        // All steps have the same regions and contours.
        Edit::AddToFigure { .. } | Edit::RemoveFromFigure { .. } => apply(root, edit),
        Edit::RemoveTemplate { template } => vanish(root, step, "templates", *template),
        Edit::RemoveObject { object } => vanish(root, step, "objects", *object),
        Edit::RemoveCaption { caption } => vanish(root, step, "labels", *caption),
        _ => change(root, step, edit),
    }
}

/// True for values that no step sets in the editor.
fn is_of_all_steps(target: &str) -> bool {
    const KEYS: [&str; 7] = [
        "/fabrica", "/title", "/caption", "/credit", "/lang", "/subject", "/steps",
    ];
    // Groups are the editor's: it asks the document for them, whatever step is shown.
    let is_group = |keys: &[String]| matches!(keys, [_, _, key] if key == "group");
    let keys = || pointer::keys(target).is_ok_and(|keys| is_fixed(&keys) || is_group(&keys));
    KEYS.iter().any(|key| is_in(target, key)) || keys()
}

/// Adds templates, an object, a caption or a handle while a step is shown: they are switched off before it. A template
/// grows in the passage to the step.
fn appear(root: &mut Value, step: usize, edit: &Edit) -> Result<(), DocumentError> {
    let before = state(root, step)?;
    let after = changed(&before, edit)?;
    let (key, limit) = match edit {
        Edit::AddCaption(_) => ("labels", MAX_LABELS),
        Edit::AddObject { .. } | Edit::DuplicateObject { .. } => ("objects", MAX_OBJECTS),
        Edit::AddToFigure { list, .. } => (list.key(), list.limit()),
        _ => ("templates", MAX_TEMPLATES),
    };
    let entries = |state: &Value| -> Vec<Value> {
        let list = pointer::get(state, &format!("/{key}")).and_then(Value::as_array);
        list.cloned().unwrap_or_default()
    };
    let (before, after) = (entries(&before), entries(&after));
    let count = after.len().saturating_sub(before.len());
    let index = match edit {
        Edit::AddTemplate { index, .. }
        | Edit::InsertTemplates { index, .. }
        | Edit::AddObject { index, .. }
        | Edit::AddToFigure { index, .. } => *index,
        Edit::DuplicateTemplate { template: i } | Edit::DuplicateObject { object: i } => i + 1,
        _ => usize::MAX,
    };
    let index = index.min(before.len());
    for (at, value) in (index..).zip(after.into_iter().skip(index).take(count)) {
        let is_shown = value.get("enabled") != Some(&json!(false));
        let mut hidden = value.clone();
        if is_shown {
            hidden["enabled"] = json!(false);
            if key == "templates" {
                hidden["amount"] = json!(0);
            }
        }
        insert(root, key, limit, at, hidden)?;
        let Some(set) = set_of(root, step).filter(|_| is_shown) else {
            continue;
        };
        let entry = format!("/{key}/{at}");
        set.insert(join(&entry, "enabled"), json!(true));
        if key == "templates" {
            let amount = value.get("amount").cloned().unwrap_or(json!(1));
            set.insert(join(&entry, "amount"), amount);
        }
    }
    Ok(())
}

/// Removes a template, an object, a caption or a handle while a step is shown: it is switched off from there on. What
/// no step before shows is removed for good.
fn vanish(
    root: &mut Value,
    step: usize,
    key: &'static str,
    index: usize,
) -> Result<(), DocumentError> {
    let entry = format!("/{key}/{index}");
    let before = state(root, step - 1)?;
    if pointer::get(&state(root, step)?, &entry).is_none() {
        return Err(DocumentError::NotFound { pointer: entry });
    }
    if !is_shown_before(root, step, &entry)? && pointer::get(root, &entry).is_some() {
        return take(root, key, index).map(|_| ());
    }
    for later in step..=step_count(root) {
        if let Some(set) = set_of(root, later) {
            set.retain(|target, _| !is_in(target, &entry));
        }
    }
    if is_shown(&before, &entry)
        && let Some(set) = set_of(root, step)
    {
        set.insert(join(&entry, "enabled"), json!(false));
    }
    Ok(())
}

/// True if a step before this one shows an entry of a list.
fn is_shown_before(root: &Value, step: usize, entry: &str) -> Result<bool, DocumentError> {
    let (mut number, mut shown) = (0, false);
    steps::walk(root, |state| {
        shown |= number < step && is_shown(state, entry);
        number += 1;
        Ok(())
    })?;
    Ok(shown)
}

/// Changes values while a step is shown: the step sets them, unless they are as the step before leaves them.
fn change(root: &mut Value, step: usize, edit: &Edit) -> Result<(), DocumentError> {
    let old = state(root, step)?;
    let mut new = changed(&old, edit)?;
    if let Edit::SetEnabled { template, .. } = edit {
        grow(root, step, *template, &old, &mut new)?;
    }
    let changes = difference(&old, &new);
    let mut edited = root.clone();
    for (target, value) in &changes {
        record(&mut edited, step, target, value.clone())?;
    }
    if state(&edited, step)? != new {
        // Some other pointer of the step covers what has changed: all that differs is set anew.
        edited = root.clone();
        let before = state(&edited, step - 1)?;
        if let Some(set) = set_of(&mut edited, step) {
            set.retain(|target, value| is_dangling(&before, target, value));
            set.extend(difference(&before, &new));
        }
    }
    for (target, _) in &changes {
        let mut shorter = edited.clone();
        let removed = set_of(&mut shorter, step).and_then(|set| set.remove(target));
        if removed.is_some() && state(&shorter, step).is_ok_and(|state| state == new) {
            edited = shorter;
        }
    }
    *root = edited;
    Ok(())
}

/// A template that was added at a later step does nothing before it; who switches it on earlier wants to see it.
fn grow(
    root: &Value,
    step: usize,
    template: usize,
    old: &Value,
    new: &mut Value,
) -> Result<(), DocumentError> {
    let entry = format!("/templates/{template}");
    let amount = join(&entry, "amount");
    let is_nothing = pointer::get(new, &amount).and_then(Value::as_f64) == Some(0.0);
    let appears = !is_shown(old, &entry) && is_shown(new, &entry);
    if appears && is_nothing && !is_shown_before(root, step, &entry)? {
        pointer::remove(new, &amount)?;
    }
    Ok(())
}

/// Writes a value into what a step sets; into the document itself where it belongs to a template, an object or a
/// caption that no earlier step shows, so that this lies ready when it comes.
fn record(root: &mut Value, step: usize, target: &str, value: Value) -> Result<(), DocumentError> {
    let keys = pointer::keys(target)?;
    if let [list, index, rest @ ..] = keys.as_slice()
        && ["templates", "labels", "objects"].contains(&list.as_str())
        && let Some(name) = rest.first()
        && name != "enabled"
        && name != "amount"
        && let entry = format!("/{list}/{index}")
        && pointer::get(root, &entry).is_some()
        && !is_shown_before(root, step, &entry)?
        && !is_covered(root, step, target)
        && set(root, target, value.clone()).is_ok()
    {
        for earlier in 1..=step {
            if let Some(set) = set_of(root, earlier) {
                set.retain(|other, _| !is_in(other, target));
            }
        }
        return Ok(());
    }
    if let Some(set) = set_of(root, step) {
        set.retain(|other, _| other == target || !is_in(other, target));
        set.insert(target.to_owned(), value);
    }
    Ok(())
}

/// True if this step or one before sets something as a whole that a pointer points into.
fn is_covered(root: &Value, step: usize, target: &str) -> bool {
    let sets = steps_of(root).iter().take(step).map(|step| step.get("set"));
    let mut others = sets
        .flatten()
        .filter_map(Value::as_object)
        .flat_map(Map::keys);
    others.any(|other| other != target && is_in(target, other))
}

/// True if a step that follows `before` cannot set this pointer: it is of another release or of another document, and
/// stays.
fn is_dangling(before: &Value, target: &str, value: &Value) -> bool {
    set(&mut before.clone(), target, value.clone()).is_err()
}

// ---------------------------------------------------------------------------------------- whole steps

/// An entry of `steps`, and the state that it shows; `None` if that follows from what it sets.
type Shown = (Value, Option<Value>);

/// Changes the list of steps. Each goes on to show what it showed: what it sets is written anew where it comes after
/// another one.
fn rearrange(root: &mut Value, change: impl FnOnce(&mut Vec<Shown>)) -> Result<(), DocumentError> {
    let first = state(root, 0)?;
    let mut all: Vec<Shown> = Vec::new();
    for (i, step) in steps_of(root).iter().enumerate() {
        all.push((step.clone(), Some(state(root, i + 1)?)));
    }
    change(&mut all);
    let steps = list(root, "steps")?;
    steps.clear();
    let mut before = first;
    for (step, wanted) in all {
        list(root, "steps")?.push(step);
        let number = step_count(root);
        let now = state(root, number);
        before = match wanted {
            Some(wanted) => {
                if now.ok().as_ref() != Some(&wanted)
                    && let Some(set) = set_of(root, number)
                {
                    set.retain(|target, value| is_dangling(&before, target, value));
                    set.extend(difference(&before, &wanted));
                }
                wanted
            }
            None => now?,
        };
    }
    Ok(())
}
