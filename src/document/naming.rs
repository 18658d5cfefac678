//! What edits are called in the menu.

use super::text::shortened;
use super::tree::Document;
use super::write::Edit;
use serde_json::Value;

impl Edit {
    /// Name of the edit in the menu, given the document before it: “Move peel”.
    pub fn name(&self, document: &Document) -> String {
        let name_of = |i: &usize| {
            let key = |key: &str| {
                document
                    .get(&format!("/templates/{i}/{key}"))
                    .and_then(Value::as_str)
                    .filter(|name| !name.is_empty())
            };
            let name = key("name").or_else(|| key("kind")).unwrap_or("template");
            shortened(name, 32)
        };
        let object_name = |i: &usize| {
            let key = |key: &str| {
                let value = document.get(&format!("/objects/{i}/{key}"));
                value
                    .and_then(Value::as_str)
                    .filter(|name| !name.is_empty())
            };
            let name = key("name").or_else(|| key("builtin")).unwrap_or("object");
            shortened(name, 32)
        };
        match self {
            Self::Set { name, .. } | Self::Reset { name, .. } => name.clone(),
            Self::AddTemplate { kind, .. } => format!("Add {}", kind.spec().name),
            Self::RemoveTemplate { template } => format!("Remove {}", name_of(template)),
            Self::DuplicateTemplate { template } => format!("Duplicate {}", name_of(template)),
            Self::MoveTemplate { from, .. } => format!("Reorder {}", name_of(from)),
            Self::SetParam {
                template, param, ..
            } => format!("Change {param} of {}", name_of(template)),
            Self::SetControlPoints { template, .. } => {
                format!("Change points of {}", name_of(template))
            }
            Self::SetTools { template, .. } => format!("Change tools of {}", name_of(template)),
            Self::SetPlacement {
                template,
                placement,
            } => {
                let before = document
                    .illustration()
                    .templates
                    .iter()
                    .find(|t| t.index == *template)
                    .map(|t| t.placement);
                let verb = placing_verb(before.map(|b| {
                    let is_same_size = b.size == placement.size;
                    [
                        b.at == placement.at,
                        b.rotate == placement.rotate,
                        is_same_size,
                    ]
                }));
                format!("{verb} {}", name_of(template))
            }
            Self::SetCurve {
                template,
                curve: None,
            } => format!("Straighten {}", name_of(template)),
            Self::SetCurve { template, .. } => format!("Bend {}", name_of(template)),
            Self::SetAmount { template, .. } => format!("Change amount of {}", name_of(template)),
            Self::SetEnabled { template, enabled } => {
                format!(
                    "{} {}",
                    if *enabled { "Show" } else { "Hide" },
                    name_of(template)
                )
            }
            Self::SetMode { template, .. } => format!("Change mode of {}", name_of(template)),
            Self::SetAlign { template, .. } => format!("Change alignment of {}", name_of(template)),
            Self::SetConstrain { template, .. } => {
                format!("Change constraint of {}", name_of(template))
            }
            Self::RenameTemplate { template, .. } => format!("Rename {}", name_of(template)),
            Self::SetGroup { template, group } if group.is_empty() => {
                format!("Ungroup {}", name_of(template))
            }
            Self::SetGroup { template, .. } => format!("Group {}", name_of(template)),
            Self::InsertTemplates { .. } => "Paste templates".to_owned(),
            Self::All { name, .. } => name.clone(),
            Self::SetTransfer(_) | Self::SetPoints { .. } => "Change colours".to_owned(),
            Self::SetWindow(_) => "Change window".to_owned(),
            Self::SetOpacity(_) => "Change opacity mode".to_owned(),
            Self::SetStyle(_) => "Change style".to_owned(),
            Self::SetBackground(_) => "Change background".to_owned(),
            Self::SetCamera(_) => "Turn the view".to_owned(),
            Self::SetTitle(_) => "Change title".to_owned(),
            Self::SetLegend(_) => "Change caption".to_owned(),
            Self::SetCredit(_) => "Change credit".to_owned(),
            Self::SetLang(_) => "Change language".to_owned(),
            Self::SetSubject(_) => "Change subject".to_owned(),
            Self::AddStroke { .. } => "Add stroke".to_owned(),
            Self::RemoveStroke { .. } => "Remove stroke".to_owned(),
            Self::AddMesh { .. } => "Add mesh".to_owned(),
            Self::RemoveMesh { .. } => "Remove mesh".to_owned(),
            Self::AddObject { .. } => "Add object".to_owned(),
            Self::RemoveObject { object } => format!("Remove {}", object_name(object)),
            Self::DuplicateObject { object } => format!("Duplicate {}", object_name(object)),
            Self::MoveObject { from, .. } => format!("Reorder {}", object_name(from)),
            Self::PlaceObject { object, placement } => {
                let mut objects = document.illustration().objects.iter();
                let before = objects.find(|o| o.index == *object);
                let before = before.and_then(|o| o.placement);
                let verb = placing_verb(before.map(|b| {
                    let is_same_size = b.size == placement.size;
                    [
                        b.at == placement.at,
                        b.rotate == placement.rotate,
                        is_same_size,
                    ]
                }));
                format!("{verb} {}", object_name(object))
            }
            Self::AddCaption(_) => "Add label".to_owned(),
            Self::ReplaceCaption { .. } => "Change label".to_owned(),
            Self::RemoveCaption { .. } => "Remove label".to_owned(),
            Self::AddToFigure { list, .. } => format!("Add {}", list.noun()),
            Self::RemoveFromFigure { list, .. } => format!("Remove {}", list.noun()),
            Self::MoveInFigure { list, .. } => format!("Reorder {}s", list.noun()),
            Self::AtStep { step, edit } => match document.at_step(*step) {
                Ok(state) => edit.name(&state),
                Err(_) => edit.name(document),
            },
            Self::AddStep { .. } => "Add step".to_owned(),
            Self::DuplicateStep { .. } => "Duplicate step".to_owned(),
            Self::RemoveStep { .. } => "Remove step".to_owned(),
            Self::MoveStep { .. } => "Reorder steps".to_owned(),
        }
    }
}

/// What a new placement does, by whether centre, turn and size stay as they are; nothing where there was none.
fn placing_verb(stays: Option<[bool; 3]>) -> &'static str {
    match stays {
        Some([_, true, true]) => "Move",
        Some([true, _, true]) => "Turn",
        Some([_, true, _]) => "Resize",
        Some(_) | None => "Place",
    }
}
