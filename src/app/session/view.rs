//! How one looks at the object besides the camera: slices next to the picture, the ghost of the untouched object,
//! distances. None of it belongs to the document, so that none of it is undone.

use std::collections::BTreeMap;

use glam::{DVec3, Vec3};

use super::figure::FigureView;
use super::measures::Measures;
use crate::data::{Grids, Segment, Subject, SubjectFrame};
use crate::document::ObjectSource;
use crate::math::Aabb;

/// A part of the window in which the object is seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pane {
    /// The picture in space.
    Picture,
    /// The slice across z.
    Axial,
    /// The slice across y.
    Coronal,
    /// The slice across x.
    Sagittal,
}

impl Pane {
    /// In the order of the panes: by rows, from the left.
    pub const ALL: [Self; 4] = [Self::Axial, Self::Picture, Self::Coronal, Self::Sagittal];
}

/// Changes how one looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum See {
    /// Slices beside the picture, or the picture alone.
    ToggleSlices,
    /// One pane alone, or with none all four.
    Expand(Option<Pane>),
    /// Grey or the look's colours in slices.
    ToggleSliceColors,
    /// Puts the crosshair to a point, subject space.
    Cross(Vec3),
    /// The untouched object faintly over the deformed one.
    ToggleGhost,
    /// The edges of a mesh's triangles over its surface.
    ToggleWires,
    /// Clicks measure distances, or not.
    ToggleMeasure,
    /// Drags over slices change the window of values, or not.
    ToggleLevel,
    /// Tells what the crosshair lies on: where that is at rest, and its value; nothing where it lies outside.
    ReadCross(Option<(Vec3, f32)>),
    /// Drops one distance by its place in the list.
    RemoveMeasure(usize),
}

/// What is known of a scan's voxels, or of those of a built-in subject.
#[derive(Clone, Debug, PartialEq)]
pub struct ScanFacts {
    /// Voxels along each axis of the file.
    pub dims: [u32; 3],
    /// Distance of their middles along the same axes, mm.
    pub spacing_mm: [f64; 3],
    /// Smallest and largest value.
    pub value_range: [f32; 2],
    /// What made the images, as DICOM abbreviates it, where the file tells.
    pub modality: Option<String>,
}

/// What panels want to know of the subject that is shown.
#[derive(Clone, Debug, PartialEq)]
pub struct SubjectFacts {
    /// Millimetres in one subject unit.
    pub mm_per_unit: f32,
    /// Its file says how large it is.
    pub has_size: bool,
    /// Where the middle of its box lies in the scanner's space, mm.
    pub middle_mm: DVec3,
    /// Box of the untouched subject, subject space.
    pub bounds: Aabb,
    /// Length of its finest detail, subject units.
    pub detail: f32,
    /// Its voxels; `None` if the subject has no values. Then windows, thresholds and recipes mean nothing, and panels
    /// do not offer them.
    pub scan: Option<ScanFacts>,
    /// It is a figure: flat, and bent by handles.
    pub is_figure: bool,
    /// Names of its segments by label.
    pub segments: BTreeMap<u16, String>,
    /// Names of its segments, each once, in the order of its file; labels that stand for an overlap are left out.
    pub tissues: Vec<String>,
}

impl SubjectFacts {
    fn new(subject: &Subject) -> Self {
        let frame = subject.frame();
        Self {
            mm_per_unit: frame.mm_per_unit as f32,
            has_size: subject.mm_per_unit().is_some(),
            middle_mm: frame.middle_mm,
            bounds: frame.bounds,
            detail: frame.detail,
            scan: subject.values().map(|volume| ScanFacts {
                dims: volume.grid.dims.to_array(),
                spacing_mm: volume.grid.spacing_mm().to_array(),
                value_range: volume.value_range,
                modality: None,
            }),
            is_figure: subject.plate().is_some(),
            segments: names_of(subject.segments()),
            tissues: each_once(subject.segments()),
        }
    }

    /// Volume of a voxel, cubic millimetres; `None` if the subject has no values.
    fn voxel_mm3(&self) -> Option<f64> {
        Some(self.scan.as_ref()?.spacing_mm.iter().product())
    }

    /// Volume of a voxel, cubic centimetres; `None` if the subject has no values.
    pub fn voxel_cm3(&self) -> Option<f64> {
        Some(self.voxel_mm3()? / 1000.0)
    }

    /// Mean length of a voxel's sides, mm; `None` if the subject has no values.
    pub fn voxel_mm(&self) -> Option<f64> {
        self.voxel_mm3().filter(|mm3| *mm3 > 0.0).map(f64::cbrt)
    }

    /// True if a segment has this name.
    pub fn has_segment(&self, name: &str) -> bool {
        self.segments.values().any(|other| other == name)
    }

    /// The scanner's space, mm, from a point of the subject.
    pub fn world_from_subject(&self, pos: Vec3) -> Vec3 {
        (self.middle_mm + pos.as_dvec3() * f64::from(self.mm_per_unit)).as_vec3()
    }
}

/// What a label means; where segments overlap, all of them.
fn names_of(segments: &[Segment]) -> BTreeMap<u16, String> {
    let mut names: BTreeMap<u16, String> = BTreeMap::new();
    for segment in segments {
        let name = names.entry(segment.label).or_default();
        if !name.is_empty() {
            name.push_str(" + ");
        }
        name.push_str(&segment.name);
    }
    names
}

/// Names of the segments that have a label of their own.
fn each_once(segments: &[Segment]) -> Vec<String> {
    let is_single = |label: u16| segments.iter().filter(|other| other.label == label).count() == 1;
    let single = segments.iter().filter(|s| is_single(s.label));
    single.map(|segment| segment.name.clone()).collect()
}

/// How one looks, beside the camera.
#[derive(Debug, Default)]
pub struct ViewState {
    /// Slices are shown beside the picture.
    pub is_split: bool,
    /// The pane that is shown alone.
    pub expanded: Option<Pane>,
    /// Slices are in the look's colours.
    pub has_slice_colors: bool,
    /// Where the slices cross, subject space.
    pub cross: Vec3,
    /// The subject that is shown.
    pub subject: Option<SubjectFacts>,
    /// What the crosshair lies on: where that was at rest, and its value.
    pub cross_read: Option<(Vec3, f32)>,
    /// The untouched object is seen over the deformed one.
    pub has_ghost: bool,
    /// The edges of a mesh's triangles are drawn.
    pub has_wires: bool,
    /// Distances in the picture.
    pub measures: Measures,
    /// Rises with every subject.
    pub subject_revision: u64,
    /// The frames of the meshes of objects that have come, by where each comes from.
    pub object_frames: Vec<(ObjectSource, SubjectFrame)>,
    /// The grids of the tools that are there, of a clay those with which captions go.
    pub grids: Grids,
    /// The figure that is shown, as it is made.
    pub figure: FigureView,
}

impl ViewState {
    /// Takes the facts of another subject, or of the same clay with other strokes. Distances and the crosshair stay
    /// where it fills the same box, and on a clay; true if they do.
    pub fn set_subject(&mut self, subject: &Subject, is_same_clay: bool) -> bool {
        let facts = SubjectFacts::new(subject);
        let is_same_place = self.subject.as_ref().is_some_and(|old| {
            // Strokes change the bounds of a clay and leave its space where it is.
            old.mm_per_unit == facts.mm_per_unit && (is_same_clay || old.bounds == facts.bounds)
        });
        if !is_same_place {
            self.cross = facts.bounds.center();
            self.measures.clear();
        }
        if facts.is_figure {
            (self.is_split, self.expanded, self.has_ghost) = (false, None, false);
        }
        self.figure.set_plate(subject.plate().cloned());
        self.subject = Some(facts);
        self.subject_revision += 1;
        is_same_place
    }

    /// The file tells what made its images, or does not.
    pub fn set_modality(&mut self, modality: Option<String>) {
        let scan = self.subject.as_mut().and_then(|facts| facts.scan.as_mut());
        if let Some(scan) = scan {
            scan.modality = modality;
        }
    }

    /// The subject has other segments now.
    pub fn set_segments(&mut self, segments: &[Segment]) {
        let Some(facts) = &mut self.subject else {
            return;
        };
        facts.segments = names_of(segments);
        facts.tissues = each_once(segments);
        self.subject_revision += 1;
    }

    /// Puts the crosshair to a point, within reach of the object.
    pub fn set_cross(&mut self, pos: Vec3) {
        if pos.is_finite() {
            self.cross = pos.clamp(Vec3::splat(-1.5), Vec3::splat(1.5));
        }
    }

    /// Millimetres in one subject unit, once a subject is there.
    pub fn mm_per_unit(&self) -> Option<f32> {
        self.subject.as_ref().map(|subject| subject.mm_per_unit)
    }

    /// Millimetres in one subject unit, once a subject is there whose file says how large it is.
    pub fn known_mm_per_unit(&self) -> Option<f64> {
        let subject = self.subject.as_ref().filter(|subject| subject.has_size);
        subject.map(|subject| f64::from(subject.mm_per_unit))
    }

    /// True if a figure is shown: panels leave out what is about subjects in space.
    pub fn is_figure(&self) -> bool {
        (self.subject.as_ref()).is_some_and(|subject| subject.is_figure)
    }

    /// True if the subject is a mesh, or a clay, and nothing else.
    pub fn is_mesh(&self) -> bool {
        !self.has_values() && !self.is_figure()
    }

    /// False if a subject is shown that has no values: panels leave out what is about values.
    pub fn has_values(&self) -> bool {
        let subject = self.subject.as_ref();
        subject.is_none_or(|subject| subject.scan.is_some())
    }
}
