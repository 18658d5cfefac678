//! Nodal displacements as simulations give them: a table of x, y, z and the forward displacement of each node,
//! regularised onto a grid (dissertation, section 9.3).
//!
//! A field holds the inverse map: a node that went from x to x + u tells that the material at x + u came from x, so its
//! sample lies at x + u and is −u. Between samples Shepard's interpolation over the nearest ones (Franke and Little's
//! weights), which runs through every node and needs no mesh.

use std::cell::RefCell;
use std::rc::Rc;

use glam::{DAffine3, DQuat, DVec3, IVec3, UVec3, Vec3};
use sha2::{Digest as _, Sha256};

use super::files::open;
use super::{FileSet, LoadError};
use crate::data::Grid;

/// Nodes that a table may have.
const MAX_NODES: usize = 1 << 20;
/// Bytes that a line may have.
const MAX_LINE_BYTES: usize = 4096;
/// Samples of the regular grid along its longest side.
const SIDE: f64 = 48.0;
/// The grid reaches so far beyond the nodes on each side, parts of its longest side.
const MARGIN: f64 = 0.04;
/// Nodes that a sample is made of.
const NEAREST: usize = 8;

/// True for the name of a table.
pub(crate) fn has_ending(name: &str) -> bool {
    let lower = name.to_lowercase();
    lower.ends_with(".csv") || lower.ends_with(".tsv")
}

/// A table of displacements at scattered nodes, sampled anew on a regular grid.
pub(crate) struct Nodes {
    pub(crate) grid: Grid,
    pub(crate) samples: Vec<[f32; 4]>,
    pub(crate) sha256: String,
    pub(crate) notices: Vec<String>,
}

/// Reads a table: six numbers a line, parted by commas, semicolons, tabs or spaces; one line of names may come first,
/// `#` begins a remark.
pub(crate) fn read(files: &mut dyn FileSet, name: &str) -> Result<Nodes, LoadError> {
    let hash = Rc::new(RefCell::new(Sha256::new()));
    let mut stream = open(files, name, name, Some(&hash))?;
    let refuse = |what: String| LoadError::NotField {
        name: name.to_owned(),
        what,
    };
    // Where a node went, and how.
    let mut nodes: Vec<(Vec3, Vec3)> = Vec::new();
    let (mut min, mut max) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    let mut has_names = false;
    for number in 1.. {
        let Some(line) = stream.line(MAX_LINE_BYTES)? else {
            break;
        };
        let line = String::from_utf8_lossy(&line);
        let line = line.trim().trim_start_matches('\u{feff}');
        if line.is_empty() || line.starts_with('#') {
            continue;
        }
        let words = line
            .split([',', ';', '\t', ' '])
            .filter(|word| !word.is_empty());
        let numbers: Vec<Option<f64>> = words.map(|word| word.trim().parse().ok()).collect();
        if nodes.is_empty() && !has_names && numbers.iter().all(Option::is_none) {
            has_names = true;
            continue;
        }
        let &[Some(x), Some(y), Some(z), Some(u), Some(v), Some(w)] = numbers.as_slice() else {
            let found: String = line.chars().take(40).collect();
            return Err(refuse(format!(
                "line {number} should be x, y, z and a displacement, six numbers, but is \"{found}\""
            )));
        };
        let (from, shift) = (DVec3::new(x, y, z), DVec3::new(u, v, w));
        if !(from.is_finite() && shift.is_finite() && (from + shift).abs().max_element() < 1e9) {
            return Err(refuse(format!("line {number} holds what is no number")));
        }
        if nodes.len() == MAX_NODES {
            return Err(refuse(format!("more than {MAX_NODES} nodes")));
        }
        let to = from + shift;
        min = min.min(to).min(from);
        max = max.max(to).max(from);
        nodes.push((to.as_vec3(), shift.as_vec3()));
    }
    if nodes.len() < 4 {
        return Err(refuse(format!("{} nodes make no field", nodes.len())));
    }
    drop(stream);
    let longest = (max - min).max_element();
    if longest <= 0.0 {
        return Err(refuse("all nodes are at one place".to_owned()));
    }
    let (min, max) = (min - MARGIN * longest, max + MARGIN * longest);
    let step = (max - min).max_element() / SIDE;
    let dims = ((max - min) / step)
        .ceil()
        .max(DVec3::splat(2.0))
        .as_uvec3();
    let grid = Grid {
        dims,
        world_from_voxel: DAffine3::from_scale_rotation_translation(
            DVec3::splat(step),
            DQuat::IDENTITY,
            min + 0.5 * step,
        ),
    };
    let buckets = Buckets::new(&nodes, min.as_vec3(), max.as_vec3());
    let mut samples = Vec::with_capacity(grid.voxel_count());
    for z in 0..dims.z {
        for y in 0..dims.y {
            for x in 0..dims.x {
                let voxel = UVec3::new(x, y, z).as_dvec3();
                let at = grid.world_from_voxel.transform_point3(voxel).as_vec3();
                let d = -buckets.interpolated(&nodes, at);
                samples.push([d.x, d.y, d.z, 1.0]);
            }
        }
    }
    let digest: [u8; 32] = hash.borrow().clone().finalize().into();
    Ok(Nodes {
        grid,
        samples,
        sha256: crate::math::hex(&digest),
        notices: vec![format!(
            "{} nodes were regularised onto {} x {} x {} samples",
            nodes.len(),
            dims.x,
            dims.y,
            dims.z
        )],
    })
}

/// Nodes by the cell that they lie in.
struct Buckets {
    min: Vec3,
    cell: f32,
    dims: UVec3,
    /// First of each cell in `order`, and one more.
    starts: Vec<u32>,
    order: Vec<u32>,
}

impl Buckets {
    fn new(nodes: &[(Vec3, Vec3)], min: Vec3, max: Vec3) -> Self {
        let size = max - min;
        // About four nodes in each, no more cells than 48 along a side.
        let cell = (size.element_product() * 4.0 / nodes.len() as f32).cbrt();
        let cell = cell.max(size.max_element() / 48.0);
        let dims = (size / cell)
            .ceil()
            .max(Vec3::ONE)
            .as_uvec3()
            .min(UVec3::splat(64));
        let mut this = Self {
            min,
            cell,
            dims,
            starts: vec![0; dims.element_product() as usize + 1],
            order: vec![0; nodes.len()],
        };
        for (at, _) in nodes {
            let cell = this.index(this.cell_of(*at));
            this.starts[cell + 1] += 1;
        }
        for i in 1..this.starts.len() {
            this.starts[i] += this.starts[i - 1];
        }
        let mut next = this.starts.clone();
        for (i, (at, _)) in nodes.iter().enumerate() {
            let cell = this.index(this.cell_of(*at));
            this.order[next[cell] as usize] = i as u32;
            next[cell] += 1;
        }
        this
    }

    fn cell_of(&self, at: Vec3) -> UVec3 {
        let cell = ((at - self.min) / self.cell).max(Vec3::ZERO).as_uvec3();
        cell.min(self.dims - 1)
    }

    fn index(&self, cell: UVec3) -> usize {
        (cell.x + self.dims.x * (cell.y + self.dims.y * cell.z)) as usize
    }

    /// Displacement of the material at a place.
    fn interpolated(&self, nodes: &[(Vec3, Vec3)], at: Vec3) -> Vec3 {
        let home = self.cell_of(at).as_ivec3();
        let last = self.dims.as_ivec3() - 1;
        let mut found: Vec<(f32, u32)> = Vec::new();
        let mut enough = None;
        for ring in 0..=last.max_element() {
            let (low, high) = ((home - ring).max(IVec3::ZERO), (home + ring).min(last));
            for z in low.z..=high.z {
                for y in low.y..=high.y {
                    // Of a row inside the ring only its two ends are new.
                    let is_shell = (z - home.z).abs() == ring || (y - home.y).abs() == ring;
                    let stride = if is_shell || ring == 0 { 1 } else { 2 * ring };
                    let mut x = if is_shell { low.x } else { home.x - ring };
                    while x <= high.x {
                        if x >= low.x {
                            let cell = self.index(IVec3::new(x, y, z).as_uvec3());
                            let range = self.starts[cell] as usize..self.starts[cell + 1] as usize;
                            for &i in &self.order[range] {
                                found.push((nodes[i as usize].0.distance_squared(at), i));
                            }
                        }
                        x += stride;
                    }
                }
            }
            // What lies in the next ring may still be nearer than the farthest of these.
            if enough == Some(ring - 1) {
                break;
            }
            if enough.is_none() && found.len() >= NEAREST.min(nodes.len()) {
                enough = Some(ring);
            }
        }
        let n = NEAREST.min(found.len());
        if n < found.len() {
            found.select_nth_unstable_by(n, |a, b| a.0.total_cmp(&b.0));
            found.truncate(n + 1);
        }
        let reach = found.iter().map(|(d2, _)| d2.sqrt()).fold(0.0, f32::max) * 1.01;
        let (mut sum, mut weights) = (Vec3::ZERO, 0.0);
        for (d2, i) in found {
            let d = d2.sqrt();
            let shift = nodes[i as usize].1;
            if d <= 1e-6 * self.cell {
                return shift;
            }
            let weight = ((reach - d) / (reach * d)).powi(2);
            sum += shift * weight;
            weights += weight;
        }
        if weights > 0.0 {
            sum / weights
        } else {
            Vec3::ZERO
        }
    }
}
