use std::collections::BTreeMap;

use super::factor::NONE;
use crate::document::figure::{Figure, Rigidity};
use crate::figure::mesh::{Mesh, Part};
use crate::figure::notice::Notice;

/// Rigid parts at most; the smaller ones count as elastic bone.
const MAX_PARTS: usize = 128;

/// How a triangle resists.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Stiffness {
    /// It gives way; resistance of the deformed x and y.
    Soft([f64; 2]),
    /// It moves with a rigid part, which has all of its vertices.
    Inside(u32),
    /// It is of a rigid part, but others have some of its vertices: it gives way like soft tissue, with its part's
    /// turn.
    Border(u32),
}

/// Which triangles are rigid, and which vertices move with them. It depends on the mesh and the rigidities.
#[derive(Clone, Debug)]
pub(crate) struct Parts {
    /// Per triangle.
    pub(crate) stiffness: Vec<Stiffness>,
    /// The parts, by their first triangles.
    pub(crate) parts: Vec<RigidPart>,
    /// Per vertex the part that it moves with, or [`NONE`].
    pub(crate) part_of: Vec<u32>,
    /// The triangles of rigid regions that count as elastic, as there are too many parts.
    pub(crate) loose: Vec<u32>,
}

/// A part of a rigid region that hangs together over edges.
#[derive(Clone, Debug)]
pub(crate) struct RigidPart {
    /// Index of its tissue.
    pub(crate) tissue: u16,
    /// Its triangles, those at borders included.
    pub(crate) triangles: Vec<u32>,
    /// The vertices that move with it.
    pub(crate) vertices: Vec<u32>,
}

impl Parts {
    /// The rigid parts of a mesh. Regions of `elastic` count as elastic bone though they are rigid.
    pub(crate) fn new(
        mesh: &Mesh,
        figure: &Figure,
        elastic: &[usize],
        notices: &mut Vec<Notice>,
    ) -> Self {
        let rigidity = |tissue: u16| match mesh.tissues[usize::from(tissue)].part {
            Part::Region(i)
                if elastic.contains(&i) && figure.regions[i].rigidity == Rigidity::Rigid =>
            {
                Rigidity::Elastic(Rigidity::BONE)
            }
            Part::Region(i) => figure.regions[i].rigidity,
            Part::Behind(_) | Part::Rest => Rigidity::SOFT,
        };
        let mut stiffness: Vec<Stiffness> = Vec::with_capacity(mesh.triangle_count());
        for tissue in &mesh.tissue_of {
            stiffness.push(match rigidity(*tissue) {
                Rigidity::Elastic(k) => Stiffness::Soft(k),
                Rigidity::Rigid => Stiffness::Inside(NONE),
            });
        }
        let mut parts = connected(mesh, &stiffness);
        let mut loose = Vec::new();
        if parts.len() > MAX_PARTS {
            let count = parts.len();
            notices.push(Notice::RigidParts { count });
            let area = |part: &RigidPart| {
                part.triangles
                    .iter()
                    .map(|t| mesh.area(*t as usize))
                    .sum::<f64>()
            };
            let mut by_area: Vec<(f64, usize)> = parts.iter().map(area).zip(0..).collect();
            by_area.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
            let mut is_kept = vec![false; count];
            by_area
                .iter()
                .take(MAX_PARTS)
                .for_each(|(_, i)| is_kept[*i] = true);
            for (part, _) in parts.iter().zip(&is_kept).filter(|(_, kept)| !**kept) {
                loose.extend(&part.triangles);
            }
            let mut kept = is_kept.into_iter();
            parts.retain(|_| kept.next() == Some(true));
            loose.sort_unstable();
        }
        for t in &loose {
            stiffness[*t as usize] = Stiffness::Soft(Rigidity::BONE);
        }
        let part_of = give_vertices(mesh, &mut parts, &mut stiffness);
        Self {
            stiffness,
            parts,
            part_of,
            loose,
        }
    }
}

/// The parts of rigid regions, by their first triangles.
fn connected(mesh: &Mesh, stiffness: &[Stiffness]) -> Vec<RigidPart> {
    let is_rigid = |t: u32| matches!(stiffness[t as usize], Stiffness::Inside(_));
    let mut across: BTreeMap<(u32, u32), Vec<u32>> = BTreeMap::new();
    let edge = |t: u32, k: usize| {
        let corners = mesh.triangles[t as usize];
        let (a, b) = (corners[k], corners[(k + 1) % 3]);
        (a.min(b), a.max(b))
    };
    for t in (0..mesh.triangle_count() as u32).filter(|t| is_rigid(*t)) {
        for k in 0..3 {
            across.entry(edge(t, k)).or_default().push(t);
        }
    }
    let mut is_taken = vec![false; mesh.triangle_count()];
    let mut parts = Vec::new();
    for first in (0..mesh.triangle_count() as u32).filter(|t| is_rigid(*t)) {
        if is_taken[first as usize] {
            continue;
        }
        is_taken[first as usize] = true;
        let tissue = mesh.tissue_of[first as usize];
        let mut triangles = vec![first];
        let mut next = 0;
        while let Some(t) = triangles.get(next).copied() {
            next += 1;
            for k in 0..3 {
                for other in &across[&edge(t, k)] {
                    if !is_taken[*other as usize] && mesh.tissue_of[*other as usize] == tissue {
                        is_taken[*other as usize] = true;
                        triangles.push(*other);
                    }
                }
            }
        }
        triangles.sort_unstable();
        parts.push(RigidPart {
            tissue,
            triangles,
            vertices: Vec::new(),
        });
    }
    parts
}

/// Gives each vertex to the first part that it is of, and finds the triangles that then are at borders. A part that is
/// left no vertex is soft.
fn give_vertices(mesh: &Mesh, parts: &mut Vec<RigidPart>, stiffness: &mut [Stiffness]) -> Vec<u32> {
    let mut part_of = vec![NONE; mesh.vertices.len()];
    parts.retain_mut(|part| {
        for vertex in part
            .triangles
            .iter()
            .flat_map(|t| mesh.triangles[*t as usize])
        {
            let is_taken = &mut part_of[vertex as usize];
            if *is_taken == NONE {
                // The number is set below, when it is known which parts remain.
                *is_taken = u32::MAX - 1;
                part.vertices.push(vertex);
            }
        }
        if part.vertices.is_empty() {
            for t in &part.triangles {
                stiffness[*t as usize] = Stiffness::Soft([1.0, 1.0]);
            }
        }
        !part.vertices.is_empty()
    });
    for (part, number) in parts.iter_mut().zip(0..) {
        part.vertices.sort_unstable();
        part.vertices
            .iter()
            .for_each(|vertex| part_of[*vertex as usize] = number);
    }
    for (part, number) in parts.iter().zip(0..) {
        for t in &part.triangles {
            let is_whole = mesh.triangles[*t as usize]
                .iter()
                .all(|vertex| part_of[*vertex as usize] == number);
            let kind = if is_whole {
                Stiffness::Inside(number)
            } else {
                Stiffness::Border(number)
            };
            stiffness[*t as usize] = kind;
        }
    }
    part_of
}
