use glam::DVec2;

use super::factor::NONE;
use super::line::{distance_squared_to_line, meets_triangle};
use super::rigid::{Parts, Stiffness};
use crate::document::figure::{Figure, Handle, Hold, Rest};
use crate::figure::mesh::{Mesh, Part};
use crate::figure::notice::Notice;
use crate::math::winding;

/// A handle in no triangle takes hold of the nearest vertex within this, figure units.
const NEAR: f64 = 0.02;

/// A place of the figure at rest and the triangle that carries it, if there is one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Anchor {
    /// Where it is at rest.
    pub(crate) at: DVec2,
    triangle: Option<(usize, [f64; 3])>,
}

impl Anchor {
    pub(crate) fn new(mesh: &Mesh, at: DVec2) -> Self {
        Self {
            at,
            triangle: mesh.at_rest(at),
        }
    }

    /// Where it is carried when the vertices have these places.
    pub(crate) fn carried(&self, mesh: &Mesh, places: &[DVec2]) -> DVec2 {
        self.triangle
            .map_or(self.at, |triangle| mesh.carried(triangle, places))
    }
}

/// What kind of handle holds vertices.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GripKind {
    /// A handle at a point.
    Point,
    /// A handle of a region, or a fixed region.
    Region,
    /// A handle along a line.
    Line,
    /// What keeps the outside of `only`.
    Outside,
}

/// A handle and what it holds. It depends on the mesh, the rigidities and where handles are, not on where they go.
#[derive(Clone, Debug)]
pub(crate) struct Grip {
    pub(crate) kind: GripKind,
    /// Its number in the document's list; none of fixed regions and the outside of `only`.
    pub(crate) handle: Option<usize>,
    /// The point, the region's centroid, or the line's points; empty for the outside of `only`.
    pub(crate) anchors: Vec<Anchor>,
    /// The vertices that it would hold alone, in order.
    pub(crate) alone: Vec<u32>,
    /// The rigid part that a point handle lies in.
    pub(crate) part: Option<u32>,
}

/// Who holds which vertex.
#[derive(Clone, Debug)]
pub(crate) struct Holding {
    /// The handles in the document's order, then fixed regions, then the outside of `only`; unused ones left out.
    pub(crate) grips: Vec<Grip>,
    /// Per vertex the grip that holds it, or [`NONE`].
    pub(crate) holder: Vec<u32>,
    /// Per rigid part the grip that holds it, or [`NONE`].
    pub(crate) part_holder: Vec<u32>,
}

impl Holding {
    /// What a figure's handles, fixed regions and `only` hold.
    pub(crate) fn new(
        mesh: &Mesh,
        parts: &Parts,
        figure: &Figure,
        notices: &mut Vec<Notice>,
    ) -> Self {
        let finder = Finder {
            mesh,
            parts,
            figure,
        };
        let mut grips = Vec::new();
        for (i, handle) in figure
            .handles
            .iter()
            .enumerate()
            .filter(|(_, handle)| handle.enabled)
        {
            if let Hold::Region(name) = &handle.hold
                && !figure.regions.iter().any(|region| region.name == *name)
            {
                notices.push(Notice::UnknownRegion {
                    pointer: format!("/figure/handles/{i}/region"),
                    name: name.clone(),
                });
                continue;
            }
            match finder.grip(i, handle) {
                Some(grip) if !grip.alone.is_empty() => grips.push(grip),
                _ => notices.push(Notice::HandleOutside { index: i }),
            }
        }
        for (i, _) in figure
            .regions
            .iter()
            .enumerate()
            .filter(|(_, region)| region.fixed)
        {
            grips.push(finder.region(i, None));
        }
        if let Some(only) = &figure.only {
            grips.push(finder.outside(only, notices));
        }
        grips.retain(|grip| !grip.alone.is_empty());
        Self::shared_out(mesh, parts, grips)
    }

    /// Gives each vertex to the first grip that holds it. A rigid part goes as a whole: what a grip holds alone has
    /// all of its vertices, or none.
    pub(crate) fn shared_out(mesh: &Mesh, parts: &Parts, grips: Vec<Grip>) -> Self {
        let mut holder = vec![NONE; mesh.vertices.len()];
        for (grip, number) in grips.iter().zip(0..) {
            for vertex in &grip.alone {
                let holder = &mut holder[*vertex as usize];
                if *holder == NONE {
                    *holder = number;
                }
            }
        }
        let part_holder = parts
            .parts
            .iter()
            .map(|part| holder[part.vertices[0] as usize])
            .collect();
        Self {
            grips,
            holder,
            part_holder,
        }
    }

    /// The vertices that each grip holds, in order.
    pub(crate) fn held(&self) -> Vec<Vec<u32>> {
        let mut held = vec![Vec::new(); self.grips.len()];
        for (holder, vertex) in self.holder.iter().zip(0..) {
            if *holder != NONE {
                held[*holder as usize].push(vertex);
            }
        }
        held
    }

    /// The point handles that hold a rigid part together, in their order; empty if no handle holds it or another kind
    /// does.
    pub(crate) fn pins_of(&self, part: u32) -> Vec<u32> {
        let holder = self.part_holder[part as usize];
        if holder == NONE || self.grips[holder as usize].part != Some(part) {
            return Vec::new();
        }
        let of_part = |(grip, number): (&Grip, u32)| (grip.part == Some(part)).then_some(number);
        self.grips.iter().zip(0..).filter_map(of_part).collect()
    }
}

struct Finder<'a> {
    mesh: &'a Mesh,
    parts: &'a Parts,
    figure: &'a Figure,
}

impl Finder<'_> {
    fn grip(&self, index: usize, handle: &Handle) -> Option<Grip> {
        match &handle.hold {
            Hold::Point(at) => self.point(index, *at, handle.radius),
            Hold::Region(name) => {
                let region = self
                    .figure
                    .regions
                    .iter()
                    .position(|region| region.name == *name)?;
                Some(self.region(region, Some(index)))
            }
            Hold::Line { points, .. } => self.line(index, points, handle.radius),
        }
    }

    /// Whether handles can hold a triangle: a rest that is kept is held and moved by nothing.
    fn is_movable(&self, triangle: usize) -> bool {
        self.figure.rest != Rest::Keep || self.mesh.tissue(triangle).part != Part::Rest
    }

    /// The triangle in front that a handle at a place takes hold of.
    fn triangle_at(&self, at: DVec2) -> Option<usize> {
        let candidates = self.mesh.grid.candidates(at).iter().map(|t| *t as usize);
        let holds = |t: &usize| {
            let corners = self.mesh.corners(*t, &self.mesh.vertices);
            self.is_movable(*t) && crate::figure::mesh::weights(corners, at).is_some()
        };
        candidates.filter(|t| self.is_movable(*t)).find(holds)
    }

    /// The nearest vertex to a place that lies in no triangle, the first of equally near ones.
    fn vertex_near(&self, at: DVec2) -> Option<u32> {
        let mut nearest = None;
        let mut least = NEAR * NEAR;
        for t in (0..self.mesh.triangle_count()).filter(|t| self.is_movable(*t)) {
            for vertex in self.mesh.triangles[t] {
                let distance = self.mesh.vertices[vertex as usize].distance_squared(at);
                if distance < least || nearest.is_none() && distance <= least {
                    least = distance;
                    nearest = Some(vertex);
                }
            }
        }
        nearest
    }

    fn point(&self, index: usize, at: DVec2, radius: f64) -> Option<Grip> {
        let triangle = self.triangle_at(at);
        let (part, own) = match triangle {
            Some(t) => {
                let part = match self.parts.stiffness[t] {
                    Stiffness::Inside(part) | Stiffness::Border(part) => Some(part),
                    Stiffness::Soft(_) => None,
                };
                (part, self.mesh.triangles[t].to_vec())
            }
            None => {
                let vertex = self.vertex_near(at)?;
                let part = self.parts.part_of[vertex as usize];
                ((part != NONE).then_some(part), vec![vertex])
            }
        };
        let alone = match part {
            Some(part) => self.parts.parts[part as usize].vertices.clone(),
            None => {
                let sheet = self.mesh.sheet_of[own[0] as usize];
                let is_near = |place: DVec2| place.distance_squared(at) <= radius * radius;
                self.whole_parts(self.in_sheet(sheet, own, is_near))
            }
        };
        Some(Grip {
            kind: GripKind::Point,
            handle: Some(index),
            anchors: vec![Anchor::new(self.mesh, at)],
            alone,
            part,
        })
    }

    fn line(&self, index: usize, points: &[DVec2], radius: f64) -> Option<Grip> {
        let mut own = Vec::new();
        let first = self.triangle_at(points[0]);
        let sheet = match first {
            Some(t) => self.mesh.sheet_of[self.mesh.triangles[t][0] as usize],
            None => {
                let vertex = self.vertex_near(points[0])?;
                own.push(vertex);
                self.mesh.sheet_of[vertex as usize]
            }
        };
        for t in 0..self.mesh.triangle_count() {
            let corners = self.mesh.triangles[t];
            let is_crossed = || meets_triangle(points, self.mesh.corners(t, &self.mesh.vertices));
            if self.mesh.sheet_of[corners[0] as usize] == sheet && is_crossed() {
                own.extend(corners);
            }
        }
        let is_near = |place: DVec2| distance_squared_to_line(place, points) <= radius * radius;
        let mut alone = self.in_sheet(sheet, own, is_near);
        alone.retain(|vertex| self.parts.part_of[*vertex as usize] == NONE);
        Some(Grip {
            kind: GripKind::Line,
            handle: Some(index),
            anchors: points
                .iter()
                .map(|at| Anchor::new(self.mesh, *at))
                .collect(),
            alone,
            part: None,
        })
    }

    /// The vertices of a sheet that are near, and those given; in order.
    fn in_sheet(&self, sheet: u32, own: Vec<u32>, is_near: impl Fn(DVec2) -> bool) -> Vec<u32> {
        let mut is_held = vec![false; self.mesh.vertices.len()];
        own.into_iter()
            .for_each(|vertex| is_held[vertex as usize] = true);
        let vertices = self.mesh.vertices.iter().zip(&self.mesh.sheet_of);
        for ((place, of), held) in vertices.zip(&mut is_held) {
            *held |= *of == sheet && is_near(*place);
        }
        let held = |vertex: &u32| is_held[*vertex as usize];
        (0..self.mesh.vertices.len() as u32).filter(held).collect()
    }

    /// Leaves out the vertices of rigid parts of which some are missing.
    fn whole_parts(&self, mut vertices: Vec<u32>) -> Vec<u32> {
        let mut counts = vec![0; self.parts.parts.len()];
        for vertex in &vertices {
            let part = self.parts.part_of[*vertex as usize];
            if part != NONE {
                counts[part as usize] += 1;
            }
        }
        vertices.retain(|vertex| {
            let part = self.parts.part_of[*vertex as usize];
            part == NONE || counts[part as usize] == self.parts.parts[part as usize].vertices.len()
        });
        vertices
    }

    fn region(&self, region: usize, handle: Option<usize>) -> Grip {
        let mut is_held = vec![false; self.mesh.vertices.len()];
        let (mut moment, mut total) = (DVec2::ZERO, 0.0);
        for t in (0..self.mesh.triangle_count())
            .filter(|t| self.mesh.tissue(*t).part == Part::Region(region))
        {
            self.mesh.triangles[t]
                .iter()
                .for_each(|vertex| is_held[*vertex as usize] = true);
            let ([a, b, c], area) = (self.mesh.corners(t, &self.mesh.vertices), self.mesh.area(t));
            moment += area * (a + b + c) / 3.0;
            total += area;
        }
        let centroid = if total > 0.0 {
            moment / total
        } else {
            DVec2::ZERO
        };
        let vertices = (0..is_held.len() as u32)
            .filter(|vertex| is_held[*vertex as usize])
            .collect();
        Grip {
            kind: GripKind::Region,
            handle,
            anchors: vec![Anchor::new(self.mesh, centroid)],
            alone: self.whole_parts(vertices),
            part: None,
        }
    }

    /// What holds the vertices outside a polygon.
    fn outside(&self, only: &[DVec2], notices: &mut Vec<Notice>) -> Grip {
        let is_outside: Vec<bool> = self
            .mesh
            .vertices
            .iter()
            .map(|at| winding(only.iter().copied(), *at) == 0)
            .collect();
        for part in &self.parts.parts {
            let count = part
                .vertices
                .iter()
                .filter(|vertex| is_outside[**vertex as usize])
                .count();
            if count > 0 && count < part.vertices.len() {
                notices.push(Notice::OnlyCrossesRigid {
                    region: self.mesh.tissues[usize::from(part.tissue)].name.clone(),
                });
            }
        }
        let vertices = (0..is_outside.len() as u32)
            .filter(|vertex| is_outside[*vertex as usize])
            .collect();
        Grip {
            kind: GripKind::Outside,
            handle: None,
            anchors: Vec::new(),
            alone: self.whole_parts(vertices),
            part: None,
        }
    }
}
