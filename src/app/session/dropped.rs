//! A mesh file that was opened while a subject is shown: the reader is asked what it is to be.

use serde_json::{Value, json};

use super::effect::Effect;
use super::mesh_use::MeshUse;
use super::selection::Selection;
use super::session::{LoadOf, MeshQuestion, Session, Tab};
use crate::app::words::objects;
use crate::data::SubjectFrame;
use crate::document::{
    Clay, Edit, MAX_MESHES, MAX_OBJECTS, MeshRef, SubjectBox, ToolFile, ToolShape,
};

/// An object farther from the middle of the subject than this is brought before the camera, subject units.
const FARTHEST: f32 = 1.2;
/// So is one that is smaller or larger than these.
const SIZES: std::ops::RangeInclusive<f32> = 0.02..=3.0;

impl Session {
    /// Asks what the mesh of the load under way is to be. False if that is plain: nothing is shown yet, or the document
    /// waits for a file.
    pub fn ask_about_mesh(&mut self, sha256: &str, frame: SubjectFrame) -> bool {
        let is_answer = self.waits_for_file()
            || self
                .illustration()
                .subject
                .supplied_sha256()
                .is_some_and(|own| own == sha256);
        let is_file = self
            .load
            .as_ref()
            .is_some_and(|load| load.of == LoadOf::File);
        if !is_file || is_answer || self.view.subject.is_none() {
            return false;
        }
        if let Some(load) = self.load.take() {
            let sha256 = sha256.to_owned();
            self.mesh_question = Some(MeshQuestion {
                load,
                sha256,
                frame,
            });
        }
        true
    }

    /// True while the reader is asked what a mesh file is to be.
    pub fn is_asking_about_mesh(&self) -> bool {
        self.mesh_question.is_some()
    }

    /// True if the subject takes one mesh more.
    pub fn can_take_mesh(&self) -> bool {
        let shown = self.illustration();
        // Beside a scan it is a surface of the same patient; beside a mesh that is made it would not be drawn.
        let is_alone = !self.view.has_values();
        let is_taken = !is_alone || !shown.subject.is_made();
        is_taken && shown.meshes().len() < MAX_MESHES
    }

    /// True if the scene takes one object more.
    pub fn can_take_object(&self) -> bool {
        self.object_count() < MAX_OBJECTS
    }

    /// True if a tool more may be taken in hand: a clay has so many at most, sweeps of anything else have no such list.
    pub fn can_take_tool(&self) -> bool {
        let clay = self.clay();
        clay.is_none_or(|clay| clay.tools.len() < Clay::MAX_TOOLS)
    }

    /// Does with the mesh file what the reader answers.
    pub(super) fn use_mesh(&mut self, answer: MeshUse) {
        let Some(question) = self.mesh_question.take() else {
            return;
        };
        let MeshQuestion {
            load,
            sha256,
            frame,
        } = question;
        match answer {
            MeshUse::Nothing => self.effect(Effect::DropMesh),
            MeshUse::Subject => {
                self.load = Some(load);
                self.effect(Effect::ShowMesh(sha256));
            }
            MeshUse::Part => {
                self.effect(Effect::DropMesh);
                let mesh = MeshRef {
                    index: 0,
                    src: None,
                    sha256: Some(sha256),
                    name: String::new(),
                    reading: load.reading.mesh,
                };
                // Beside a scan its box decides.
                let box_mm = self.box_mm().filter(|_| !self.view.has_values());
                if self.apply(&Edit::AddMesh { mesh, box_mm }, false) {
                    self.load_subject();
                }
            }
            MeshUse::Tool => {
                self.effect(Effect::DropMesh);
                let file = ToolFile {
                    sha256: Some(sha256),
                    ..ToolFile::default()
                };
                let longest = ToolShape::LONGEST;
                let shape = ToolShape::Mesh { file, longest };
                match self.clay() {
                    Some(_) => self.take_own_tool(shape, "Add tool"),
                    None => self.sweep_with(shape),
                }
            }
            MeshUse::Object => {
                self.effect(Effect::DropMesh);
                let index = self.object_count();
                let name = self.free_object_name(objects::w().one);
                let object: Value = json!({ "sha256": sha256, "name": name });
                let mut edits = vec![Edit::AddObject { index, object }];
                if !self.is_seen_where_it_lies(&frame) {
                    edits.push(Edit::PlaceObject {
                        object: index,
                        placement: self.held_in_the_middle(),
                    });
                }
                let edit = Edit::All {
                    name: "Add object".to_owned(),
                    edits,
                };
                if self.apply(&edit, false) {
                    self.selection = Selection::Object(index);
                    self.side_tab = Tab::Templates;
                }
            }
        }
    }

    /// False for an object that would lie far from the subject, or would be too small or too large to be handled, where
    /// its file says.
    fn is_seen_where_it_lies(&self, frame: &SubjectFrame) -> bool {
        let own = self.own_placement(frame);
        own.is_some_and(|own| own.at.length() < FARTHEST && SIZES.contains(&own.size))
    }

    /// The box of the subject that is shown, as a document gives it.
    fn box_mm(&self) -> Option<SubjectBox> {
        let facts = self.view.subject.as_ref()?;
        let mm = f64::from(facts.mm_per_unit);
        Some(SubjectBox {
            min_mm: facts.middle_mm + facts.bounds.min.as_dvec3() * mm,
            max_mm: facts.middle_mm + facts.bounds.max.as_dvec3() * mm,
        })
    }
}
