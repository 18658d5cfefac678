use std::sync::Arc;

use glam::DVec2;

use super::context::ContextSheet;
use super::contour::{outline, targets};
use super::factor::NONE;
use super::hold::{Grip, GripKind, Holding};
use super::line::Target;
use super::moves::{Moved, line_of};
use super::rigid::Parts;
use super::stage::Stage;
use super::state::State;
use crate::document::figure::{Figure, Rotations};
use crate::figure::complex::mul;
use crate::figure::mesh::Mesh;
use crate::figure::notice::Notice;
use crate::figure::progress::{Progress, unwatched};

/// A figure that can be bent: its mesh with all that does not depend on where handles go. Matrices are factored here,
/// once for the mesh, the rigidities, what handles hold and the context's points and strength; a drag needs none. Cheap
/// to clone.
#[derive(Clone, Debug)]
pub struct Rig {
    pub(crate) mesh: Arc<Mesh>,
    /// Contours and likeness, if there are any.
    pub(crate) shape: Option<Arc<Shape>>,
    pub(crate) pose: Arc<Stage>,
}

/// The stage in which regions take other outlines, and the context other proportions.
#[derive(Clone, Debug)]
pub(crate) struct Shape {
    pub(crate) stage: Arc<Stage>,
    /// Per contour that is used its number in the document and the vertices of its outline.
    pub(crate) outlines: Vec<(usize, Vec<u32>)>,
}

/// Where a pose takes the vertices of a figure.
#[derive(Clone, Debug, PartialEq)]
pub struct Posed {
    /// Where each vertex goes.
    pub places: Vec<DVec2>,
    /// Where each vertex is after the shape stage, before the pose.
    pub base: Vec<DVec2>,
    /// Rounds that were needed; 0 if turns are propagated.
    pub rounds: u32,
    /// Triangles that are turned over.
    pub folded: usize,
    /// Turn and scale of the context, of the pose if it is kept there, else of the shape stage.
    pub context_found: Option<[f64; 2]>,
}

/// A pose that follows handles while they are dragged. Each frame goes on from the last one's turns.
#[derive(Clone, Debug)]
pub struct Drag {
    rig: Rig,
    state: State,
}

/// Where a vertex is taken, with its turn and scale.
pub(crate) type Aimed = (DVec2, f64, f64);

fn aimed(target: &Target) -> Aimed {
    (target.place, target.turn, libm::exp(target.log_scale))
}

impl Rig {
    /// Finds what handles hold and factors the matrices. The figure comes from a document that was read,
    /// and the mesh is made of its regions.
    pub fn new(mesh: &Arc<Mesh>, figure: &Figure, notices: &mut Vec<Notice>) -> Self {
        let parts = Parts::new(mesh, figure, &[], notices);
        let holding = Holding::new(mesh, &parts, figure, notices);
        let context = ContextSheet::new(mesh, figure, notices);
        let shape = Shape::new(mesh, figure, context.as_ref(), notices);
        let keeps = figure.context.as_ref().is_some_and(|context| context.keep);
        let context = context.filter(|_| keeps);
        Self {
            pose: Arc::new(Stage::new(
                mesh,
                parts,
                holding,
                context,
                figure.propagation,
                figure.reach,
            )),
            mesh: Arc::clone(mesh),
            shape: shape.map(Arc::new),
        }
    }

    /// True if contours or a likeness change the shape before handles move it.
    pub fn has_shape(&self) -> bool {
        self.shape.is_some()
    }

    /// The mesh that it bends.
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// The pose that a figure's handles make: turns are found to the end. The figure may differ from the one that the
    /// rig was made for in where handles go, and in amounts.
    pub fn posed(&self, figure: &Figure, notices: &mut Vec<Notice>) -> Posed {
        self.settled(figure, notices, &mut unwatched).0
    }

    /// As [`Rig::posed`], with the pose from which a drag goes on. Where `progress` stops it, turns are found as far as
    /// they were then.
    pub fn settled(
        &self,
        figure: &Figure,
        notices: &mut Vec<Notice>,
        progress: &mut Progress<'_>,
    ) -> (Posed, Drag) {
        let (base, shape_found) = self.base(figure);
        let moved = self.moved(figure, &base, notices);
        let mut state = self.propagated(&base, &moved);
        let rounds = match figure.rotations {
            Rotations::Found => state.find_turns(progress),
            Rotations::Propagated => 0,
        };
        let folded = self.folded(&state.places);
        if folded > 0 {
            notices.push(Notice::Folded { count: folded });
        }
        let posed = Posed {
            context_found: state.context_found().or(shape_found),
            places: state.places.clone(),
            base,
            rounds,
            folded,
        };
        let rig = self.clone();
        (posed, Drag { rig, state })
    }

    /// Where a figure's handles take what they hold.
    pub(crate) fn moved(
        &self,
        figure: &Figure,
        base: &[DVec2],
        notices: &mut Vec<Notice>,
    ) -> Moved {
        Moved::new(
            &self.mesh,
            &self.pose.parts,
            &self.pose.holding,
            figure,
            base,
            notices,
        )
    }

    /// The pose with turns as they spread from the handles.
    fn propagated(&self, base: &[DVec2], moved: &Moved) -> State {
        let kept = self
            .pose
            .context
            .as_ref()
            .map(|context| context.places(base));
        State::propagated(&self.pose, base, moved, kept)
    }

    /// The shape that poses begin with: the source, or what contours and likeness make of it; and turn and scale of the
    /// context in it.
    fn base(&self, figure: &Figure) -> (Vec<DVec2>, Option<[f64; 2]>) {
        match &self.shape {
            Some(shape) => shape.shaped(&self.mesh, figure),
            None => (self.mesh.vertices.clone(), None),
        }
    }

    /// Triangles that are turned over.
    fn folded(&self, places: &[DVec2]) -> usize {
        let is_folded = |t: &usize| {
            let [a, b, c] = self.mesh.corners(*t, places);
            (b - a).perp_dot(c - a) < 0.0
        };
        (0..self.mesh.triangle_count()).filter(is_folded).count()
    }

    /// The context's sheet, of the stage that uses it.
    pub(crate) fn context(&self) -> Option<&ContextSheet> {
        let of_shape = self
            .shape
            .as_ref()
            .and_then(|shape| shape.stage.context.as_ref());
        self.pose.context.as_ref().or(of_shape)
    }

    /// Of a line that says where its points go: where the first goes, and per vertex that it would hold alone place,
    /// turn and scale.
    pub(crate) fn line_targets(
        &self,
        grip: &Grip,
        figure: &Figure,
        base: &[DVec2],
    ) -> Option<(DVec2, Vec<Aimed>)> {
        let line = line_of(&self.mesh, grip, figure, base)?;
        let first = grip.anchors.first()?.carried(&self.mesh, base);
        let target = |vertex: &u32| aimed(&line.target(base[*vertex as usize]));
        Some((
            line.target(first).place,
            grip.alone.iter().map(target).collect(),
        ))
    }

    /// Per contour that is used its number in the document, the vertices that it would hold alone, and for each place,
    /// turn and scale.
    pub(crate) fn contour_targets(&self, figure: &Figure) -> Vec<(usize, Vec<u32>, Vec<Aimed>)> {
        let Some(shape) = &self.shape else {
            return Vec::new();
        };
        let of = |(number, line): &(usize, Vec<u32>)| {
            let places: Vec<DVec2> = line
                .iter()
                .map(|vertex| self.mesh.vertices[*vertex as usize])
                .collect();
            let is_free = |vertex: u32| shape.stage.parts.part_of[vertex as usize] == NONE;
            let targets = targets(&figure.contours[*number], &places);
            let used = line
                .iter()
                .zip(&targets)
                .filter(|(vertex, _)| is_free(**vertex));
            let (vertices, aims) = used
                .map(|(vertex, target)| (*vertex, aimed(target)))
                .unzip();
            (*number, vertices, aims)
        };
        shape.outlines.iter().map(of).collect()
    }

    /// Entries of the largest factor for each of its unknowns.
    pub fn factor_entries_per_unknown(&self) -> f64 {
        let largest = self
            .pose
            .factors()
            .max_by_key(|factor| factor.entry_count());
        largest.map_or(0.0, |factor| {
            factor.entry_count() as f64 / factor.len().max(1) as f64
        })
    }

    /// Memory of the factors, bytes.
    pub fn factor_bytes(&self) -> usize {
        let of_shape = self.shape.iter().flat_map(|shape| shape.stage.factors());
        self.pose
            .factors()
            .chain(of_shape)
            .map(|factor| factor.byte_len())
            .sum()
    }
}

impl Drag {
    /// Goes to where a figure's handles are, and to the shape that it begins with, with so many rounds. Scales, and
    /// turns that are not found, spread anew; turns that are found go on from those of the pose before.
    pub fn follow(&mut self, figure: &Figure, rounds: u32) {
        let (base, _) = self.rig.base(figure);
        let moved = self.rig.moved(figure, &base, &mut Vec::new());
        let mut state = self.rig.propagated(&base, &moved);
        if figure.rotations == Rotations::Found {
            state.go_on_from(&self.state);
            state.relax(rounds);
        }
        self.state = state;
    }

    /// Where each vertex is now.
    pub fn places(&self) -> &[DVec2] {
        &self.state.places
    }

    /// Where each vertex is after the shape stage; `None` if there is none.
    pub fn base(&self) -> Option<&[DVec2]> {
        self.rig.has_shape().then(|| self.state.base())
    }
}

impl Shape {
    /// None if the figure has neither contours nor a likeness.
    fn new(
        mesh: &Mesh,
        figure: &Figure,
        context: Option<&ContextSheet>,
        notices: &mut Vec<Notice>,
    ) -> Option<Self> {
        let has_likeness = figure
            .context
            .as_ref()
            .is_some_and(|context| context.like.is_some());
        if figure.contours.is_empty() && !has_likeness {
            return None;
        }
        let mut outlines = Vec::new();
        let mut elastic = Vec::new();
        for (number, contour) in figure.contours.iter().enumerate() {
            let Some(region) = figure
                .regions
                .iter()
                .position(|region| region.name == contour.region)
            else {
                notices.push(Notice::UnknownRegion {
                    pointer: format!("/figure/contours/{number}/region"),
                    name: contour.region.clone(),
                });
                continue;
            };
            let line = outline(mesh, region);
            if !line.is_empty() {
                elastic.push(region);
                outlines.push((number, line));
            }
        }
        // What is named of rigid parts is named for the pose.
        let parts = Parts::new(mesh, figure, &elastic, &mut Vec::new());
        let grip = |(_, line): &(usize, Vec<u32>)| {
            let mut alone = line.clone();
            alone.retain(|vertex| parts.part_of[*vertex as usize] == NONE);
            Grip {
                kind: GripKind::Line,
                handle: None,
                anchors: Vec::new(),
                alone,
                part: None,
            }
        };
        let holding = Holding::shared_out(mesh, &parts, outlines.iter().map(grip).collect());
        let context = context.filter(|_| has_likeness).cloned();
        Some(Self {
            stage: Arc::new(Stage::new(
                mesh,
                parts,
                holding,
                context,
                figure.propagation,
                0.0,
            )),
            outlines,
        })
    }

    /// The base shape, and turn and scale of the context in it.
    fn shaped(&self, mesh: &Mesh, figure: &Figure) -> (Vec<DVec2>, Option<[f64; 2]>) {
        let mut moved = Moved::none(&mesh.vertices);
        for (grip, (number, line)) in (0..).zip(&self.outlines) {
            let places: Vec<DVec2> = line
                .iter()
                .map(|vertex| mesh.vertices[*vertex as usize])
                .collect();
            for (vertex, target) in line.iter().zip(targets(&figure.contours[*number], &places)) {
                if self.stage.holding.holder[*vertex as usize] == grip {
                    moved.set(*vertex, target);
                }
            }
        }
        let kept = self
            .stage
            .context
            .as_ref()
            .map(|context| likeness(context, mesh, figure));
        let state = State::propagated(&self.stage, &mesh.vertices, &moved, kept);
        let found = state.context_found();
        (state.places, found)
    }
}

/// The places that a likeness wants, by vertex of the context (Chen et al., section 4.2).
fn likeness(sheet: &ContextSheet, mesh: &Mesh, figure: &Figure) -> Vec<DVec2> {
    let p = sheet.places(&mesh.vertices);
    let context = figure.context.as_ref();
    let Some((like, amount)) =
        context.and_then(|context| Some((context.like.as_ref()?, context.amount)))
    else {
        return p;
    };
    let like: Vec<DVec2> = sheet.points.iter().map(|point| like[*point]).collect();
    let n = p.len() as f64;
    let (mean, mean_like) = (p.iter().sum::<DVec2>() / n, like.iter().sum::<DVec2>() / n);
    let z = ContextSheet::similarity(&like, &p);
    let brought = like.iter().map(|like| mean + mul(z, *like - mean_like));
    p.iter()
        .zip(brought)
        .map(|(p, like)| (1.0 - amount) * *p + amount * like)
        .collect()
}
