//! What the stages of a scene are made from.

use super::held::HeldData;
use crate::data::Resources;
use crate::document::{Illustration, OpacityMode, PlacedTemplate, Style};
use crate::math::Aabb;
use crate::placed::deformed_bounds;
use crate::render::device::programs::SubjectShader;
use crate::render::pack::bodies::bodies_of;
use crate::render::pack::gpu_types::{Bodies, MeshLook, Templates};
use crate::render::pack::kept::KeptTissue;
use crate::render::pack::look::{TransferTable, background_uniform};
use crate::render::pack::mesh_look::{lidded, mesh_look_of};
use crate::render::pack::notice::{RenderNotice, missed_notices};
use crate::render::pack::objects::DrawnObjects;
use crate::render::pack::stamps::{MadeFrom, Stamp, Stamped};
use crate::render::subject::textures::SubjectTextures;

/// What of an illustration and its subject the stages are made from, each with a stamp.
#[derive(Debug)]
pub(crate) struct Inputs {
    /// Stamp of the subject.
    pub subject: Stamp,
    /// As the shaders take them.
    pub templates: Stamped<Templates>,
    /// What the templates that act hold besides numbers.
    pub held: Stamped<HeldData>,
    /// What templates leave alone; `None` before the first update.
    pub kept: Stamped<Option<KeptTissue>>,
    /// Box of the deformed object, subject space.
    pub bounds: Stamped<Aabb>,
    /// Segments that are drawn as bodies of their own.
    pub bodies: Stamped<Bodies>,
    /// How the segments of a mesh are drawn.
    pub mesh_look: Stamped<MeshLook>,
    /// The objects of the scene.
    pub objects: Stamped<DrawnObjects>,
    /// The transfer function and how opacity follows the deformation; `None` before the first update.
    pub look: Stamped<Option<(TransferTable, OpacityMode)>>,
    /// An illustrator's look, [`Style::PLAIN`] for none.
    pub style: Stamped<Style>,
    /// Linear RGB; w: 1 if there is a background.
    pub background: Stamped<[f32; 4]>,
    bounds_from: MadeFrom<4>,
    /// Names of no segment that a notice has been made for.
    noticed: Vec<String>,
    notices: Vec<RenderNotice>,
}

impl Inputs {
    /// The inputs before the first [`Inputs::update`]: no template and no look.
    pub(crate) fn new() -> Self {
        Self {
            subject: 0,
            templates: Stamped::new(Templates::NONE),
            held: Stamped::default(),
            kept: Stamped::default(),
            bounds: Stamped::new(Aabb::EMPTY),
            bodies: Stamped::new(Bodies::NONE),
            mesh_look: Stamped::default(),
            objects: Stamped::default(),
            look: Stamped::default(),
            style: Stamped::new(Style::PLAIN),
            background: Stamped::default(),
            bounds_from: MadeFrom::default(),
            noticed: Vec::new(),
            notices: Vec::new(),
        }
    }

    /// Takes over an illustration and the data of its files for a subject; each input that differs gets a new stamp.
    pub(crate) fn update(
        &mut self,
        illustration: &Illustration,
        resources: &Resources,
        subject: &SubjectTextures,
    ) {
        let placed = &illustration.templates;
        self.subject = subject.stamp;
        self.held.set(HeldData::of(placed, resources));
        self.templates.set(Templates::pack(placed, resources));
        let kept = KeptTissue::of(placed, resources, &subject.segments, subject.bounds);
        self.notify(&kept.unknown, RenderNotice::UnknownKept);
        self.kept.set(Some(kept));
        let bounds_from = [
            self.subject,
            self.templates.stamp(),
            self.held.stamp(),
            self.kept.stamp(),
        ];
        if self.bounds_from.is_stale(bounds_from) {
            self.notify_missed(placed);
            let bounds = deformed_bounds(placed, resources, subject.bounds);
            let around = self.rigid_reach().map(|far| subject.bounds.expanded(far));
            self.bounds
                .set(around.map_or(bounds, |around| bounds.union(around)));
        }
        let mut unknown = Vec::new();
        let look = &illustration.look;
        let bodies = bodies_of(&look.segments, &subject.segments, &mut unknown);
        let is_beside = subject.shader == SubjectShader::Both;
        let of_meshes = &subject.mesh_segments;
        self.mesh_look.set(mesh_look_of(look, of_meshes, is_beside));
        self.notify(&unknown, RenderNotice::UnknownBody);
        self.notify(&lidded(look, of_meshes, is_beside), RenderNotice::Lid);
        self.bodies.set(bodies);
        let objects = DrawnObjects::of(&illustration.objects, resources, &subject.frame);
        self.objects.set(objects);
        let table = TransferTable::new(look, &illustration.subject, &subject.info);
        self.look.set(Some((table, look.opacity)));
        self.style.set(look.style);
        self.background.set(background_uniform(look.background));
    }

    /// Grows with every change that the picture shows.
    pub(crate) fn revision(&self) -> u64 {
        [
            self.subject,
            self.templates.stamp(),
            self.held.stamp(),
            self.kept.stamp(),
            self.bodies.stamp(),
            self.mesh_look.stamp(),
            self.objects.stamp(),
            self.look.stamp(),
            self.style.stamp(),
            self.background.stamp(),
        ]
        .iter()
        .sum()
    }

    /// What templates leave alone.
    pub(crate) fn kept(&self) -> Option<&KeptTissue> {
        self.kept.get().as_ref()
    }

    /// The transfer function; `None` until a document was taken in.
    pub(crate) fn table(&self) -> Option<&TransferTable> {
        self.look.get().as_ref().map(|(table, _)| table)
    }

    /// Notices about the document since the last call.
    pub(crate) fn take_notices(&mut self) -> Vec<RenderNotice> {
        std::mem::take(&mut self.notices)
    }

    /// Longest way of segments that move as a whole, subject units; `None` if there are none.
    fn rigid_reach(&self) -> Option<f32> {
        let kept = self.kept().filter(|kept| kept.has_rigid())?;
        let longest = kept.items.iter().map(|item| item.longest);
        Some(longest.fold(0.0, f32::max))
    }

    /// Adds a notice for each control point that is missed, once per point.
    fn notify_missed(&mut self, placed: &[PlacedTemplate]) {
        for notice in missed_notices(placed) {
            let RenderNotice::MissedPoint {
                template, point, ..
            } = &notice
            else {
                continue;
            };
            let name = format!("{template}, control point {point}");
            if !self.noticed.contains(&name) {
                self.noticed.push(name);
                self.notices.push(notice);
            }
        }
    }

    /// Adds a notice for each name of no segment, once per name.
    fn notify(&mut self, names: &[String], notice: fn(String) -> RenderNotice) {
        for name in names {
            if !self.noticed.contains(name) {
                self.notices.push(notice(name.clone()));
                self.noticed.push(name.clone());
            }
        }
    }
}
