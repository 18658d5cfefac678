use std::collections::BTreeMap;

use glam::DVec2;

use super::grid::Grid;
use super::triangulate::triangulate;
use crate::document::figure::{Behind, Figure, Rest};
use crate::figure::notice::Notice;
use crate::figure::progress::Progress;
use crate::figure::regions::{Canvas, REST};

/// The triangles of a figure at rest, in the sheets that they hang together in. It depends on the source, `rest`,
/// `detail` and the regions without their rigidity, order and whether they are fixed; built once for these.
#[derive(Clone, Debug)]
pub struct Mesh {
    /// Places at rest, figure space.
    pub vertices: Vec<DVec2>,
    /// Corners of triangles, counter-clockwise, by tissue from the front to the back, the rest last.
    pub triangles: Vec<[u32; 3]>,
    /// Per triangle the tissue it belongs to.
    pub tissue_of: Vec<u16>,
    /// The tissues, from behind to front, the rest last.
    pub tissues: Vec<Tissue>,
    /// Per vertex the number of its sheet: of all that hangs together.
    pub sheet_of: Vec<u32>,
    /// Where triangles lie at rest.
    pub grid: Grid,
}

/// What a triangle can belong to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Tissue {
    /// Name of the region; `rest`; or the region's name and ` (behind)`.
    pub name: String,
    /// The region, what lies behind one, or the rest.
    pub part: Part,
    /// Pixels of the map that are left to it.
    pub pixels: usize,
    /// Whether it is no part of the figure.
    pub is_hidden: bool,
}

/// What a tissue is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Part {
    /// The region with this number in the document's list.
    Region(usize),
    /// Soft tissue where the cut region with this number lay.
    Behind(usize),
    /// What lies in no region.
    Rest,
}

impl Mesh {
    /// The mesh of a figure; none if `progress` has stopped it.
    pub fn new(
        canvas: &Canvas<'_>,
        figure: &Figure,
        notices: &mut Vec<Notice>,
        progress: &mut Progress<'_>,
    ) -> Option<Self> {
        let made = triangulate(canvas, figure, notices, progress)?;
        let counts = made.map.counts();
        let tissues = tissues(figure, &counts);
        let mut by_label: Vec<Vec<u32>> = vec![Vec::new(); 256];
        for (triangle, index) in made.mesh.triangles.iter().zip(0..) {
            by_label[usize::from(triangle.label)].push(index);
        }
        for (i, region) in figure.regions.iter().enumerate() {
            if by_label[i].is_empty() {
                notices.push(Notice::EmptyRegion {
                    name: region.name.clone(),
                });
            }
        }
        let mut sheets = Sheets {
            points: &made.mesh.points,
            vertex_of: BTreeMap::new(),
            vertices: Vec::new(),
            triangles: Vec::new(),
            tissue_of: Vec::new(),
        };
        let n = tissues.len();
        let order = (0..n - 1).rev().chain([n - 1]);
        for index in order {
            let tissue = &tissues[index];
            let (label, is_cut, is_seen) = match tissue.part {
                Part::Region(i) => (i, figure.regions[i].cut.then_some(i), !tissue.is_hidden),
                Part::Behind(i) => (i, None, true),
                Part::Rest => (
                    usize::from(REST),
                    (figure.rest == Rest::Keep).then_some(usize::from(REST)),
                    figure.rest != Rest::Drop,
                ),
            };
            if is_seen {
                for triangle in &by_label[label] {
                    sheets.add(made.mesh.triangle(*triangle).corners, is_cut, index as u16);
                }
            }
        }
        let sheet_of = hanging_together(sheets.vertices.len(), sheets.triangles.iter());
        let grid = Grid::new(&sheets.vertices, &sheets.triangles);
        Some(Self {
            vertices: sheets.vertices,
            triangles: sheets.triangles,
            tissue_of: sheets.tissue_of,
            tissues,
            sheet_of,
            grid,
        })
    }

    /// Number of triangles.
    pub fn triangle_count(&self) -> usize {
        self.triangles.len()
    }

    /// The tissue of a triangle.
    pub fn tissue(&self, triangle: usize) -> &Tissue {
        &self.tissues[usize::from(self.tissue_of[triangle])]
    }

    /// Corners of a triangle among some places of the vertices.
    pub fn corners(&self, triangle: usize, places: &[DVec2]) -> [DVec2; 3] {
        self.triangles[triangle].map(|vertex| places[vertex as usize])
    }

    /// Area of a triangle at rest, square figure units.
    pub fn area(&self, triangle: usize) -> f64 {
        let [a, b, c] = self.corners(triangle, &self.vertices);
        (b - a).perp_dot(c - a) / 2.0
    }

    /// The triangle in front that holds a place at rest, and the weights of its corners there.
    pub fn at_rest(&self, at: DVec2) -> Option<(usize, [f64; 3])> {
        self.grid
            .first(at, |triangle| self.corners(triangle, &self.vertices))
    }

    /// Where something at rest is carried: the place with these weights in a triangle.
    pub fn carried(&self, (triangle, weights): (usize, [f64; 3]), places: &[DVec2]) -> DVec2 {
        let [a, b, c] = self.corners(triangle, places);
        weights[0] * a + weights[1] * b + weights[2] * c
    }
}

/// The tissues of a figure, from behind to front, the rest last.
fn tissues(figure: &Figure, counts: &[usize; 256]) -> Vec<Tissue> {
    let mut tissues = Vec::new();
    for (i, region) in figure.regions.iter().enumerate() {
        let name = &region.name;
        if region.cut && region.behind != Behind::None && !region.hide {
            tissues.push(Tissue {
                name: format!("{name} (behind)"),
                part: Part::Behind(i),
                pixels: 0,
                is_hidden: false,
            });
        }
        tissues.push(Tissue {
            name: name.clone(),
            part: Part::Region(i),
            pixels: counts[i],
            is_hidden: region.hide,
        });
    }
    tissues.push(Tissue {
        name: "rest".to_owned(),
        part: Part::Rest,
        pixels: counts[usize::from(REST)],
        is_hidden: figure.rest == Rest::Drop,
    });
    tissues
}

/// Triangles on their way into sheets.
struct Sheets<'a> {
    points: &'a [DVec2],
    /// The vertex that a point has in a cut sheet, or in what is not cut.
    vertex_of: BTreeMap<Option<usize>, Vec<u32>>,
    vertices: Vec<DVec2>,
    triangles: Vec<[u32; 3]>,
    tissue_of: Vec<u16>,
}

impl Sheets<'_> {
    fn add(&mut self, corners: [u32; 3], cut: Option<usize>, tissue: u16) {
        let vertex_of = self
            .vertex_of
            .entry(cut)
            .or_insert_with(|| vec![u32::MAX; self.points.len()]);
        let corners = corners.map(|point| {
            let vertex = &mut vertex_of[point as usize];
            if *vertex == u32::MAX {
                *vertex = self.vertices.len() as u32;
                self.vertices.push(self.points[point as usize]);
            }
            *vertex
        });
        self.triangles.push(corners);
        self.tissue_of.push(tissue);
    }
}

/// Numbers what hangs together: per vertex the number of its component, in the order of their first vertices.
pub(crate) fn hanging_together<'a>(
    n: usize,
    triangles: impl Iterator<Item = &'a [u32; 3]>,
) -> Vec<u32> {
    let mut root: Vec<u32> = (0..n as u32).collect();
    fn find(root: &mut [u32], mut at: u32) -> u32 {
        while root[at as usize] != at {
            root[at as usize] = root[root[at as usize] as usize];
            at = root[at as usize];
        }
        at
    }
    for [a, b, c] in triangles {
        for (one, other) in [(*a, *b), (*b, *c)] {
            let (one, other) = (find(&mut root, one), find(&mut root, other));
            // The smaller number stays, so that roots are first vertices.
            root[one.max(other) as usize] = one.min(other);
        }
    }
    let mut number = vec![u32::MAX; n];
    let mut count = 0;
    let mut component_of = Vec::with_capacity(n);
    for vertex in 0..n as u32 {
        let first = find(&mut root, vertex) as usize;
        if number[first] == u32::MAX {
            number[first] = count;
            count += 1;
        }
        component_of.push(number[first]);
    }
    component_of
}
