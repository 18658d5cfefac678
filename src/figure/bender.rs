use std::collections::BTreeMap;
use std::sync::Arc;

use glam::{DVec2, Vec2};

use super::behind::smooth_colors;
use super::mesh::{Mesh, Part};
use super::notice::Notice;
use super::original::Original;
use super::probe::drawing_order;
use super::progress::Progress;
use super::solve::{Drag, Posed, Rig};
use super::svg::SvgError;
use crate::data::{Plate, Sheet, SheetMesh};
use crate::document::figure::{Behind, Figure, Hold, Region, Rigidity, Rotations};
use crate::math::linear_from_srgb;

/// How much of a new pose is done with its mesh, and of what is left then with its factors.
const OF_MESH: f32 = 0.6;
const OF_FACTORS: f32 = 0.5;

/// Bends the figure of a plate. It keeps what does not change from one pose to the next: the mesh as long as regions
/// stay, the factors as long as what is held stays, and turns from one frame of a drag to the next.
#[derive(Debug)]
pub struct Bender {
    original: Original,
    made: Option<Made>,
    factorisations: u32,
}

/// What belongs to one division into regions.
#[derive(Debug)]
struct Made {
    /// The figure that it was made for, as far as the mesh depends on it.
    key: Figure,
    mesh: Arc<Mesh>,
    notices: Vec<Notice>,
    sheet: Arc<SheetMesh>,
    /// The vertex of the mesh that a vertex of the sheet is.
    vertex_of: Vec<u32>,
    rig: Option<Rigged>,
}

/// What belongs to one list of what is held.
#[derive(Clone, Debug)]
struct Rigged {
    /// The figure that it was made for, as far as the factors depend on it.
    key: Figure,
    rig: Rig,
    notices: Vec<Notice>,
    drag: Option<Drag>,
}

/// A figure that is bent.
#[derive(Clone, Debug)]
pub struct Bent {
    /// What is drawn.
    pub sheet: Sheet,
    /// The figure's regions with what the source adds, from behind to front.
    pub regions: Vec<Region>,
    /// Everything that should be said of it. While it is dragged nothing is.
    pub notices: Vec<Notice>,
}

/// A figure at rest in its pose, with all that is known of it.
#[derive(Clone, Debug)]
pub struct Solved {
    /// The figure with what its source adds.
    pub figure: Figure,
    /// Its mesh, and what its matrices are.
    pub rig: Rig,
    /// Where its vertices go.
    pub posed: Posed,
    /// Everything that should be said of it.
    pub notices: Vec<Notice>,
}

impl Bender {
    /// A bender of a plate.
    ///
    /// # Errors
    /// [`SvgError`] where the plate is a drawing that cannot be read.
    pub fn new(plate: &Plate) -> Result<Self, SvgError> {
        Ok(Self {
            original: Original::of(plate)?,
            made: None,
            factorisations: 0,
        })
    }

    /// How often matrices were factored so far.
    pub fn factorisations(&self) -> u32 {
        self.factorisations
    }

    /// What the figure is made of.
    pub fn original(&self) -> &Original {
        &self.original
    }

    /// The pose of a document's figure, turns found to the end; none if `progress` has stopped it.
    pub fn bent(&mut self, figure: &Figure, progress: &mut Progress<'_>) -> Option<Bent> {
        let solved = self.solved(figure, progress)?;
        Some(Bent {
            sheet: self.drawn(&solved)?,
            regions: solved.figure.regions,
            notices: solved.notices,
        })
    }

    /// As [`Bender::bent`], but what follows goes on from the pose before.
    pub fn bent_aside(&mut self, figure: &Figure, progress: &mut Progress<'_>) -> Option<Bent> {
        let before = self.made.as_ref();
        let before = before.and_then(|made| Some((Arc::clone(&made.mesh), made.rig.clone()?)));
        let bent = self.bent(figure, progress);
        if let (Some(made), Some((mesh, rig))) = (&mut self.made, before)
            && Arc::ptr_eq(&made.mesh, &mesh)
        {
            made.rig = Some(rig);
        }
        bent
    }

    /// The pose that follows a drag or a passage: with so many rounds from the last pose on. Where there is no last
    /// pose with these regions and these held places, it is the pose at rest.
    pub fn follow(
        &mut self,
        figure: &Figure,
        rounds: u32,
        progress: &mut Progress<'_>,
    ) -> Option<Bent> {
        let whole = self.original.completed(figure);
        let rig_key = rig_key(&whole);
        let mesh_key = mesh_key(&whole);
        let made = self.made.as_mut().filter(|made| made.key == mesh_key);
        let rigged = made.and_then(|made| made.rig.as_mut().filter(|rig| rig.key == rig_key));
        let Some(drag) = rigged.and_then(|rig| rig.drag.as_mut()) else {
            return self.bent(figure, progress);
        };
        drag.follow(&whole, rounds);
        let (places, base) = (drag.places().to_vec(), drag.base().map(<[DVec2]>::to_vec));
        Some(Bent {
            sheet: self.sheet(&whole, &places, base.as_deref())?,
            regions: whole.regions,
            notices: Vec::new(),
        })
    }

    /// As [`Bender::bent`], with the numbers behind it. A mesh takes the first part of the progress, then factors, then
    /// rounds, each if it is to be made.
    pub fn solved(&mut self, figure: &Figure, progress: &mut Progress<'_>) -> Option<Solved> {
        let whole = self.original.completed(figure);
        let original = &self.original;
        let mesh_key = mesh_key(&whole);
        let mut done = 0.0;
        let made = match self.made.take().filter(|made| made.key == mesh_key) {
            Some(made) => made,
            None => {
                done = OF_MESH;
                let mut of_mesh = |part: f32| progress(OF_MESH * part);
                Made::new(original, &whole, mesh_key, &mut of_mesh)?
            }
        };
        let made = self.made.insert(made);
        let rig_key = rig_key(&whole);
        let rigged = match made.rig.take().filter(|rig| rig.key == rig_key) {
            Some(rigged) => rigged,
            None => {
                if !progress(done) {
                    return None;
                }
                done += (1.0 - done) * OF_FACTORS;
                self.factorisations += 1;
                let mut notices = Vec::new();
                Rigged {
                    key: rig_key,
                    rig: Rig::new(&made.mesh, &whole, &mut notices),
                    notices,
                    drag: None,
                }
            }
        };
        let rigged = made.rig.insert(rigged);
        let mut notices = [made.notices.as_slice(), &rigged.notices].concat();
        let mut is_wanted = progress(done);
        let mut of_rounds = |part: f32| {
            is_wanted &= progress(done + (1.0 - done) * part);
            is_wanted
        };
        let (posed, drag) = (rigged.rig).settled(&whole, &mut notices, &mut of_rounds);
        if !is_wanted {
            return None;
        }
        rigged.drag = Some(drag);
        Some(Solved {
            rig: rigged.rig.clone(),
            figure: whole,
            posed,
            notices,
        })
    }

    /// What is drawn of a pose that was the last to be solved.
    pub fn drawn(&self, solved: &Solved) -> Option<Sheet> {
        let base = solved.rig.has_shape().then_some(&*solved.posed.base);
        self.sheet(&solved.figure, &solved.posed.places, base)
    }

    /// What is drawn where the vertices of the last mesh have these places, and had those before handles moved them.
    fn sheet(&self, figure: &Figure, places: &[DVec2], base: Option<&[DVec2]>) -> Option<Sheet> {
        let made = self.made.as_ref()?;
        let drawn = |places: &[DVec2]| -> Arc<Vec<Vec2>> {
            let place = |vertex: &u32| places[*vertex as usize].as_vec2();
            Arc::new(made.vertex_of.iter().map(place).collect())
        };
        Some(Sheet {
            mesh: Arc::clone(&made.sheet),
            places: drawn(places),
            base: base.map(drawn),
            order: Arc::new(drawing_order(&made.mesh, figure, places)),
        })
    }
}

impl Made {
    fn new(
        original: &Original,
        figure: &Figure,
        key: Figure,
        progress: &mut Progress<'_>,
    ) -> Option<Self> {
        let mut notices = Vec::new();
        let mesh = original.mesh(figure, &mut notices, progress)?;
        let (sheet, vertex_of) = drawn_mesh(&mesh, original, figure);
        Some(Self {
            key,
            mesh: Arc::new(mesh),
            notices,
            sheet: Arc::new(sheet),
            vertex_of,
            rig: None,
        })
    }
}

/// The mesh as it is drawn, and for each of its vertices the vertex of the mesh. What is drawn in colours of its own
/// has vertices of its own.
fn drawn_mesh(mesh: &Mesh, original: &Original, figure: &Figure) -> (SheetMesh, Vec<u32>) {
    let mut vertex_of: Vec<u32> = (0..mesh.vertices.len() as u32).collect();
    let mut colors = vec![[0.0; 4]; mesh.vertices.len()];
    let mut triangles = mesh.triangles.clone();
    for (i, region) in figure
        .regions
        .iter()
        .enumerate()
        .filter(|(_, region)| region.cut)
    {
        let smooth = match region.behind {
            Behind::None => continue,
            Behind::Smooth => smooth_colors(mesh, &original.plane, original.picture(), i),
            Behind::Color(_) => BTreeMap::new(),
        };
        let color_of = |vertex: u32| match region.behind {
            Behind::Color(color) => color.map(linear_from_srgb),
            _ => smooth
                .get(&vertex)
                .map_or([0.0; 3], |color| color.map(|value| value as f32)),
        };
        let mut own = BTreeMap::new();
        for (t, triangle) in triangles.iter_mut().enumerate() {
            if mesh.tissue(t).part != Part::Behind(i) {
                continue;
            }
            for vertex in triangle {
                *vertex = *own.entry(*vertex).or_insert_with(|| {
                    let [r, g, b] = color_of(*vertex);
                    colors.push([r, g, b, 1.0]);
                    vertex_of.push(*vertex);
                    vertex_of.len() as u32 - 1
                });
            }
        }
    }
    let rest: Vec<Vec2> = (vertex_of.iter())
        .map(|vertex| mesh.vertices[*vertex as usize].as_vec2())
        .collect();
    let sheet = SheetMesh {
        rest,
        colors,
        triangles,
        region_of: mesh.tissue_of.clone(),
        regions: mesh
            .tissues
            .iter()
            .map(|tissue| tissue.name.clone())
            .collect(),
    };
    (sheet, vertex_of)
}

/// A figure as far as its mesh depends on it.
fn mesh_key(figure: &Figure) -> Figure {
    let mut key = Figure {
        regions: figure.regions.clone(),
        rest: figure.rest,
        detail: figure.detail,
        ..Figure::default()
    };
    for region in &mut key.regions {
        region.rigidity = Rigidity::SOFT;
        region.fixed = false;
        region.order = 0.0;
        region.given.clear();
    }
    key
}

/// A figure as far as its factors, and what its handles hold, depend on it.
fn rig_key(figure: &Figure) -> Figure {
    let mut key = figure.clone();
    key.rotations = Rotations::Found;
    for region in &mut key.regions {
        region.order = 0.0;
        region.given.clear();
    }
    for handle in &mut key.handles {
        handle.name = None;
        handle.motion.by = DVec2::ZERO;
        handle.motion.scale = 1.0;
        handle.motion.turn = handle.motion.turn.map(|_| 0.0);
        if let Hold::Line { to: Some(to), .. } = &mut handle.hold {
            to.clear();
        }
    }
    if let Some(context) = &mut key.context {
        context.amount = 0.0;
        context.like.iter_mut().for_each(Vec::clear);
    }
    for contour in &mut key.contours {
        contour.like.clear();
        contour.keep.clear();
        contour.amount = 0.0;
        contour.mirror = false;
    }
    key
}
