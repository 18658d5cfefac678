//! Objects of the scene: tools that are put in, and the edits of those that are there.

use glam::{Mat3, Quat, Vec3};
use serde_json::{Value, json};

use super::camera;
use super::command::Command;
use super::effect::Effect;
use super::found::Found;
use super::notices::Gravity;
use super::question::{Place, Question};
use super::selection::Selection;
use super::session::{Session, Tab};
use super::tool::Tool;
use crate::app::words::{in_sentence, objects};
use crate::data::SubjectFrame;
use crate::document::{
    Camera, Edit, ObjectPlacement, ParamValue, SceneObject, TemplateKind, free_group_name,
};
use crate::math::Placement;

/// A new tool is held like a pen: so far aside from the line of sight, radians, to the upper right.
const HELD_ASIDE: f32 = 0.8;
/// Between the working end of a new tool and the surface, parts of its size.
const GAP: f32 = 0.03;

/// How far the working end of a tool that comes to carve goes in, parts of its size.
const ENTERED: f32 = 0.12;
/// How far a new template that carves pushes tissue aside, subject units.
const NEW_PUSH: f32 = 0.01;

/// An object where it is seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlacedObject {
    /// Index in the document's list.
    pub index: usize,
    /// Its place in the subject.
    pub placement: ObjectPlacement,
    /// Sides of its box before the turn, as parts of the longest.
    pub sides: Vec3,
}

impl Session {
    /// Entries of the document's `objects`, unknown ones included.
    pub fn object_count(&self) -> usize {
        let list = self.document().get("/objects");
        list.and_then(Value::as_array).map_or(0, Vec::len)
    }

    /// The object of this index in the document as the picture shows it, if this version knows it.
    pub fn object(&self, index: usize) -> Option<&SceneObject> {
        let mut objects = self.shown().objects.iter();
        objects.find(|object| object.index == index)
    }

    /// The selected object as the picture shows it.
    pub fn selected_object(&self) -> Option<&SceneObject> {
        self.object(self.selection.object()?)
    }

    /// An object where it is seen, once its mesh and the subject have come.
    pub fn placed_object(&self, object: &SceneObject) -> Option<PlacedObject> {
        let frames = &self.view.object_frames;
        let (_, frame) = frames.iter().find(|(source, _)| *source == object.source)?;
        let placement = object.placement.or_else(|| self.own_placement(frame))?;
        Some(PlacedObject {
            index: object.index,
            placement,
            sides: frame.bounds.max - frame.bounds.min,
        })
    }

    /// Where the file of an object says that the object lies, in the subject that is shown.
    pub(super) fn own_placement(&self, frame: &SubjectFrame) -> Option<ObjectPlacement> {
        let subject = self.view.subject.as_ref()?;
        let mm_per_unit = f64::from(subject.mm_per_unit);
        Some(ObjectPlacement {
            at: ((frame.middle_mm - subject.middle_mm) / mm_per_unit).as_vec3(),
            rotate: Quat::IDENTITY,
            size: (frame.mm_per_unit / mm_per_unit) as f32,
        })
    }

    /// The place of a new object before the camera's target.
    pub(super) fn held_in_the_middle(&self) -> ObjectPlacement {
        held_before(self.camera.target, &self.camera)
    }

    /// Asks whether an object is seen at a pixel of the picture, which is selected then.
    pub(super) fn ask_what_to_select(&mut self, pixel: [f32; 2]) {
        let question = Question::new(Place::Pixel(pixel), Command::SelectSeen);
        self.effect(Effect::Ask(question));
    }

    /// Asks where a tool of the program goes: to what the middle of the picture shows.
    pub(super) fn ask_place_of_tool(&mut self, tool: &str) {
        let Some(index) = SceneObject::BUILTINS.iter().position(|name| *name == tool) else {
            return;
        };
        self.end_tissues();
        self.effect(Effect::Ask(Question {
            index,
            ..Question::new(Place::Middle, Command::PlaceTool)
        }));
    }

    /// Puts a tool of the program behind the objects that are there, and selects it: its working end at the surface
    /// that was found, else at the camera's target.
    pub(super) fn place_tool(&mut self, tool: usize, found: Option<Found>) {
        let Some(builtin) = SceneObject::BUILTINS.get(tool) else {
            return;
        };
        let pos = found.map_or(self.camera.target, |found| found.pos);
        let placement = held_before(pos, &self.camera);
        let index = self.object_count();
        let edits = vec![
            Edit::AddObject {
                index,
                object: json!({
                    "builtin": builtin,
                    "name": self.free_object_name(&in_sentence(objects::tool(builtin))),
                }),
            },
            // Numbers are rounded by this one. At a step it goes into the entry itself, as nothing shows it before.
            Edit::PlaceObject {
                object: index,
                placement,
            },
        ];
        let edit = Edit::All {
            name: "Add object".to_owned(),
            edits,
        };
        if self.apply(&edit, false) {
            self.selection = Selection::Object(index);
            self.side_tab = Tab::Templates;
        }
    }

    /// Adds a template that carves by the selected object, else by the last that is shown. Where there is none, asks
    /// where a scalpel for it goes.
    pub(super) fn start_carving(&mut self, kind: TemplateKind) {
        self.take_tool(Tool::Look);
        let mut shown = self.illustration().objects.iter();
        let last = shown.rfind(|object| object.enabled);
        let object = self.selected_object().or(last);
        let Some(name) = object.map(|object| object.name.clone()) else {
            let question = Question::new(Place::Middle, Command::PlaceCarving);
            return self.effect(Effect::Ask(question));
        };
        let edits = self.carving(kind, &name);
        self.apply_carving(edits);
    }

    /// Puts a scalpel into what was found, and a template that carves by it.
    pub(super) fn place_carving(&mut self, found: Option<Found>) {
        let pos = found.map_or(self.camera.target, |found| found.pos);
        let mut placement = held_before(pos, &self.camera);
        // Its working end goes in.
        placement.at += placement.rotate * Vec3::NEG_Z * (placement.size * (GAP + ENTERED));
        let [builtin, ..] = SceneObject::BUILTINS;
        let name = self.free_object_name(&in_sentence(objects::tool(builtin)));
        let index = self.object_count();
        let mut edits = vec![
            Edit::AddObject {
                index,
                object: json!({ "builtin": builtin, "name": &name }),
            },
            Edit::PlaceObject {
                object: index,
                placement,
            },
        ];
        edits.extend(self.carving(TemplateKind::Carve, &name));
        if self.apply_carving(edits) {
            self.notify(Gravity::Info, objects::w().brought, "");
        }
    }

    /// The edits that add a template that carves by an object of this name.
    fn carving(&self, kind: TemplateKind, name: &str) -> Vec<Edit> {
        let index = self.template_count();
        vec![
            Edit::AddTemplate {
                index,
                kind,
                placement: Placement::DOCUMENT_DEFAULT,
            },
            carve_by(index, name),
            Edit::SetParam {
                template: index,
                param: "push",
                value: ParamValue::Number(NEW_PUSH),
            },
        ]
    }

    fn apply_carving(&mut self, edits: Vec<Edit>) -> bool {
        let index = self.template_count();
        let edit = Edit::All {
            name: "Add carve".to_owned(),
            edits,
        };
        let is_done = self.apply(&edit, false);
        if is_done {
            self.selection = Selection::Template(index);
            self.side_tab = Tab::Templates;
            self.tab = self.tab.filter(|tab| *tab != Tab::Add);
        }
        is_done
    }

    /// A name for an object that no other one has: the wanted one, with a number if need be.
    pub(super) fn free_object_name(&self, wanted: &str) -> String {
        let taken = self.illustration().objects.iter();
        let taken: Vec<String> = taken.map(|object| object.name.clone()).collect();
        free_group_name(wanted, &taken)
    }

    /// Makes a copy of an object behind it, with a name of its own.
    pub(super) fn copy_of_object(&self, object: usize) -> Edit {
        let copy = Edit::DuplicateObject { object };
        let name = copy.name(self.document());
        let Some(first) = self.object(object) else {
            return copy;
        };
        // The copy of "scalpel 2" is "scalpel 3".
        let stem = first.name.trim_end_matches(|c: char| c.is_ascii_digit());
        let stem = match stem.strip_suffix(' ') {
            Some(stem) if stem.len() + 1 < first.name.len() => stem,
            _ => first.name.as_str(),
        };
        let renamed = renaming(object + 1, &first.name, &self.free_object_name(stem));
        Edit::All {
            name,
            edits: vec![copy, renamed],
        }
    }

    /// Another name for an object, for the templates that carve by it too.
    pub fn renamed_object(&self, object: &SceneObject, name: &str) -> Edit {
        let rename = renaming(object.index, &object.name, name);
        let carving = self.illustration().templates.iter();
        let carving = carving.filter(|template| {
            let found = template.carves_by();
            found.is_some_and(|found| found.index == object.index)
        });
        let mut edits: Vec<Edit> = carving.map(|t| carve_by(t.index, name)).collect();
        if edits.is_empty() {
            return rename;
        }
        let name = rename.name(self.document());
        edits.insert(0, rename);
        Edit::All { name, edits }
    }

    /// The selected object pushed towards its working end, in hundredths of its size; drawn back if negative.
    pub(super) fn pushed_object(&self, hundredths: f32) -> Option<Edit> {
        let object = self.selected_object()?;
        let placement = object.placement?;
        let by = placement.rotate * Vec3::NEG_Z * (placement.size * hundredths / 100.0);
        Some(Edit::PlaceObject {
            object: object.index,
            placement: ObjectPlacement {
                at: placement.at + by,
                ..placement
            },
        })
    }
}

/// Where a new tool lies whose working end is at a point: held to the upper right of the line of sight, its upper side
/// towards the top of the picture.
fn held_before(pos: Vec3, camera: &Camera) -> ObjectPlacement {
    let [right, up, back] = camera::axes(camera.rotate);
    let (sin, cos) = HELD_ASIDE.sin_cos();
    let z = (back * cos + (right + up).normalize_or(up) * sin).normalize_or(back);
    let y = (up - z * up.dot(z)).normalize_or(z.any_orthonormal_vector());
    let rotate = Quat::from_mat3(&Mat3::from_cols(y.cross(z), y, z)).normalize();
    let size = ObjectPlacement::DOCUMENT_DEFAULT.size;
    let at = pos + z * size * (0.5 + GAP);
    ObjectPlacement { at, rotate, size }
}

/// Lets a template carve by the object of this name.
pub fn carve_by(template: usize, name: &str) -> Edit {
    Edit::Set {
        pointer: format!("/templates/{template}/params/object"),
        value: json!(name),
        name: "Change object of carve".to_owned(),
    }
}

/// Sets a key of an object, or puts it back to what it is without the key. `what` names it in the menu of undo.
pub fn object_edit(object: &SceneObject, key: &str, value: Option<Value>, what: &str) -> Edit {
    let pointer = format!("/objects/{}/{key}", object.index);
    let name = format!("Change {what} of {}", object.name);
    Edit::put(pointer, value, name)
}

/// Shows or hides an object.
pub fn enabling(object: &SceneObject, enabled: bool) -> Edit {
    let verb = if enabled { "Show" } else { "Hide" };
    Edit::Set {
        pointer: format!("/objects/{}/enabled", object.index),
        value: json!(enabled),
        name: format!("{verb} {}", object.name),
    }
}

/// Gives the object of this index another name.
fn renaming(index: usize, before: &str, name: &str) -> Edit {
    Edit::Set {
        pointer: format!("/objects/{index}/name"),
        value: json!(name),
        name: format!("Rename {before}"),
    }
}

/// Puts an object into a group, or with an empty name out of its own.
pub fn regrouping(object: &SceneObject, group: &str) -> Edit {
    let verb = if group.is_empty() { "Ungroup" } else { "Group" };
    Edit::Set {
        pointer: format!("/objects/{}/group", object.index),
        value: json!(group),
        name: format!("{verb} {}", object.name),
    }
}
