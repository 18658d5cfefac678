//! Displacement fields that a document names, and what has come of all its files.

use std::sync::Arc;

use serde_json::json;

use crate::app::session::{Gravity, Selection};
use crate::app::window::App;
use crate::app::words::{fill, messages};
use crate::assets::{Data, ResourceNews, Role, Want};
use crate::data::{Resources, Sheet, Subject, with_mesh_segments};
use crate::document::{Edit, TemplateData};
use crate::load::{FieldFile, FieldUse};
use crate::math::round_to;
use crate::render::View;

impl App {
    /// Asks the shell for fields that the document shows and that are missing, and takes over the data of files that
    /// arrived.
    pub(crate) fn follow_resources(&mut self) {
        for want in self.assets.missing(self.session.shown()) {
            if want.role == Role::Field && !self.fields_asked.contains(&want) {
                self.services.load_field(&want);
                self.fields_asked.push(want);
            }
        }
        let (mut resources, news) = self.assets.resources(self.session.shown());
        resources.sheet = self.bent();
        for news in news {
            match news {
                ResourceNews::NoSegment { .. }
                | ResourceNews::TooThin { .. }
                | ResourceNews::ToolIsSheet { .. } => {
                    self.session.notify(Gravity::Warning, news.to_string(), "");
                }
                ResourceNews::MeshesKept => {
                    let text = messages::w();
                    let line = fill(text.not_drawn_yet, &[&text.meshes_beside]);
                    self.session.notify(Gravity::Warning, line, "");
                }
                ResourceNews::FieldNotice { line, .. } => {
                    self.session.notify(Gravity::Warning, line, "");
                }
                ResourceNews::FieldRefused { why, .. } => {
                    let text = messages::w().field_refused;
                    self.session.notify(Gravity::Error, text, why);
                }
            }
        }
        let beside = |resources: &Resources| match &resources.subject {
            Some(Subject::Space(space)) => space.meshes.clone(),
            _ => None,
        };
        if let Some(picture) = &mut self.picture {
            picture.set_meshes(beside(&resources).as_ref());
        }
        if resources == self.resources {
            return;
        }
        // A subject that comes anew knows of its own segments only.
        let has_meshes = beside(&resources).is_some() || beside(&self.resources).is_some();
        if resources.fields != self.resources.fields || !resources.has_objects_of(&self.resources) {
            let frames = resources.objects.iter();
            let frames = frames.map(|(source, mesh)| (source.clone(), mesh.frame));
            self.session.view.object_frames = frames.collect();
            self.session.revision += 1;
        }
        self.session.view.grids.clone_from(&resources.grids);
        if let Some(picture) = &mut self.picture {
            picture.set_resources(resources.clone());
        }
        self.resources = resources;
        if has_meshes {
            self.tell_segments();
        }
    }

    /// Has the figure bent as the document has it; the newest sheet that there is.
    fn bent(&mut self) -> Option<Sheet> {
        let plate = self.assets.subject().and_then(Subject::plate);
        let figure = self.session.shown().figure.as_ref();
        let is_moving = self.session.is_passing();
        if let Some(request) = self.bending.next(plate, figure, is_moving) {
            self.services.bend(request);
        }
        for notice in self.bending.take_notices() {
            self.session.notify(Gravity::Warning, notice, "");
        }
        if self.session.has_less_motion {
            self.bending.end_easing();
        }
        let sheet = self.bending.eased(self.session.now);
        let view = &mut self.session.view.figure;
        view.sheet.clone_from(&sheet);
        view.regions = Arc::clone(self.bending.regions());
        view.progress = self.bending.progress(self.session.now);
        view.is_stopped = self.bending.is_stopped();
        self.show_finer();
        sheet
    }

    /// Has a drawing drawn finer that is seen closer than its pixels, once it is at rest: the picture is done, so that
    /// nothing else asks for another frame.
    pub(crate) fn see_closer(&mut self, ctx: &egui::Context) {
        let Some(picture) = &self.picture else {
            return;
        };
        if picture.state.is_done
            && !self.session.is_passing()
            && let Some(size_px) = picture.size_px()
        {
            let camera = &self.session.camera;
            let view = View::new(camera, size_px);
            if self
                .bending
                .see_closer(1.0 / view.units_per_pixel(camera.distance))
            {
                ctx.request_repaint();
            }
        }
    }

    /// Shows the drawing in more pixels, once it is there.
    fn show_finer(&mut self) {
        let plate = self.assets.subject().and_then(Subject::plate);
        if let (Some(plate), Some(picture)) = (plate, &mut self.picture)
            && let Some(finer) = self.bending.take_finer()
        {
            let finer = Subject::from(plate.redrawn(finer));
            if let Err(error) = picture.set_subject(finer) {
                // It is shown with the pixels that it had.
                self.session.notify(Gravity::Warning, error.to_string(), "");
            }
        }
    }

    /// True while the figure is not bent as the document has it.
    pub(crate) fn is_bending(&self) -> bool {
        let plate = self.assets.subject().and_then(Subject::plate);
        let figure = self.session.shown().figure.as_ref();
        let is_passing = self.session.is_passing();
        self.bending.is_easing() || self.bending.is_behind(plate, figure, is_passing)
    }

    /// Tells the session which segments are shown: those of the scan, and those of the meshes beside it.
    pub(crate) fn tell_segments(&mut self) {
        let own = self.tissue.segmentation(&self.assets);
        let own = own.map_or(&[][..], |labels| &labels.segments);
        let segments = match &self.resources.subject {
            Some(Subject::Space(space)) => match &space.meshes {
                Some(meshes) => with_mesh_segments(own, meshes),
                None => own.to_vec(),
            },
            _ => return,
        };
        self.session.view.set_segments(&segments);
        self.session.revision += 1;
    }

    /// A field has come: one that was wanted, or one that the reader opened.
    pub(crate) fn take_field(&mut self, want: Option<Want>, outcome: Result<FieldFile, String>) {
        let refused = messages::w().field_refused;
        let file = match outcome {
            Ok(file) => file,
            Err(why) => return self.session.notify(Gravity::Error, refused, why),
        };
        if let Some(want) = want {
            if let Err(other) = self.assets.take(&want, Data::Field(file)) {
                let text = messages::w().other_file_details;
                let details = fill(text, &[&other.wanted, &other.found]);
                self.session.notify(Gravity::Error, refused, details);
            }
            return;
        }
        let hash = file.sha256.clone();
        let mut all = self.session.illustration().templates.iter();
        let is_named = all.any(|template| match &template.data {
            TemplateData::Field(field) => field.sha256.as_ref() == Some(&hash),
            _ => false,
        });
        if is_named {
            return self.assets.give(Data::Field(file));
        }
        // A file that is new to the document gets a template at the place that the file gives, so that it can be
        // grabbed.
        let mut value = json!({ "kind": "field", "params": { "sha256": hash } });
        if let Some(subject) = self.assets.grid() {
            let given = FieldUse {
                is_subject_units: false,
                is_lps: None,
                subject,
            };
            match file.fit(&given) {
                Ok((samples, _)) => {
                    let p = samples.placement;
                    let short = |x: f32| round_to(f64::from(x), 4);
                    value["at"] = json!(p.at.to_array().map(short));
                    value["rotate"] = json!(p.rotate.to_array().map(short));
                    value["size"] = json!(p.size.to_array().map(short));
                }
                Err(why) => return self.session.notify(Gravity::Error, refused, why),
            }
        }
        self.assets.give(Data::Field(file));
        let edit = Edit::InsertTemplates {
            index: usize::MAX,
            templates: vec![value],
        };
        self.session.apply(&edit, false);
        let last = self.session.template_count().checked_sub(1);
        self.session.selection = Selection::of_template(last);
    }
}
