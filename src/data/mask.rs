//! Sets of voxels and operations on them: connected parts, growing and shrinking by millimetres, smoothing.
//!
//! Everything here is the same bit for bit on every machine: whole numbers, or floats by additions, products and
//! comparisons in a fixed order. An operation works slice by slice and gives way in between when its time slice
//! is over ([`TimeSlices`]); besides the set itself it holds a few slices.

use std::collections::VecDeque;

use glam::UVec3;

use super::time_slices::TimeSlices;

/// A set of voxels.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mask {
    /// Voxels along each axis.
    pub dims: UVec3,
    /// 1 in the set, else 0; x fastest.
    pub bits: Vec<u8>,
}

/// A row's stretch of voxels in the set.
#[derive(Clone, Copy, Debug)]
struct Run {
    start: u32,
    end: u32,
    /// Another run of the same part that comes earlier in the file, or itself.
    parent: u32,
}

/// What of a set hangs together over faces.
struct Parts {
    runs: Vec<Run>,
    /// First run of each row, and the number of runs at the end.
    rows: Vec<u32>,
}

impl Parts {
    /// The first run of the part that a run belongs to, once all are joined.
    fn root(&self, run: u32) -> u32 {
        self.runs[run as usize].parent
    }

    fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.shortened(a), self.shortened(b));
        // The earlier part keeps its number, so that parts are numbered in the order of the file.
        let (first, second) = (a.min(b), a.max(b));
        self.runs[second as usize].parent = first;
    }

    /// The root, and half of the way to it made shorter.
    fn shortened(&mut self, mut run: u32) -> u32 {
        loop {
            let parent = self.runs[run as usize].parent;
            if parent == run {
                return run;
            }
            let above = self.runs[parent as usize].parent;
            self.runs[run as usize].parent = above;
            run = above;
        }
    }

    fn row(&self, row: usize) -> std::ops::Range<u32> {
        self.rows[row]..self.rows[row + 1]
    }

    /// Joins the runs of a row with those of an earlier one that lie beside them.
    fn join_rows(&mut self, row: usize, earlier: usize) {
        let (mut a, a_end) = (self.row(row).start, self.row(row).end);
        let (mut b, b_end) = (self.row(earlier).start, self.row(earlier).end);
        while a < a_end && b < b_end {
            let (x, y) = (self.runs[a as usize], self.runs[b as usize]);
            if x.start < y.end && y.start < x.end {
                self.join(a, b);
            }
            if x.end < y.end {
                a += 1;
            } else {
                b += 1;
            }
        }
    }
}

impl Mask {
    fn row_length(&self) -> usize {
        self.dims.x as usize
    }

    fn slice_length(&self) -> usize {
        self.dims.x as usize * self.dims.y as usize
    }

    fn slices(&self) -> usize {
        self.dims.z as usize
    }

    async fn parts(&self, wanted: u8, time_slices: &TimeSlices) -> Parts {
        let height = self.dims.y as usize;
        let mut parts = Parts {
            runs: Vec::new(),
            rows: Vec::with_capacity(height * self.slices() + 1),
        };
        parts.rows.push(0);
        for (row, bits) in self.bits.chunks_exact(self.row_length()).enumerate() {
            let mut x = 0;
            while let Some(start) = bits[x..].iter().position(|&b| b == wanted) {
                let start = x + start;
                let length = bits[start..].iter().position(|&b| b != wanted);
                x = length.map_or(bits.len(), |length| start + length);
                let number = parts.runs.len() as u32;
                parts.runs.push(Run {
                    start: start as u32,
                    end: x as u32,
                    parent: number,
                });
            }
            parts.rows.push(parts.runs.len() as u32);
            if row % height > 0 {
                parts.join_rows(row, row - 1);
            }
            if row >= height {
                parts.join_rows(row, row - height);
            }
            if row % height == 0 {
                time_slices.has_done(row, height * self.slices());
                time_slices.give_way().await;
            }
        }
        // A parent comes earlier, so that in order each step leads to the end.
        for run in 0..parts.runs.len() {
            let parent = parts.runs[run].parent as usize;
            parts.runs[run].parent = parts.runs[parent].parent;
        }
        parts
    }

    /// Sets all voxels of the runs that `changes` names by their part's first run.
    async fn set_parts(
        &mut self,
        parts: &Parts,
        to: u8,
        changes: impl Fn(u32) -> bool,
        time_slices: &TimeSlices,
    ) {
        let (length, height) = (self.row_length(), self.dims.y as usize);
        for row in 0..parts.rows.len() - 1 {
            for run in parts.row(row) {
                if changes(parts.root(run)) {
                    let Run { start, end, .. } = parts.runs[run as usize];
                    let at = row * length;
                    self.bits[at + start as usize..at + end as usize].fill(to);
                }
            }
            if row % height == 0 {
                time_slices.has_done(row, height * self.slices());
                time_slices.give_way().await;
            }
        }
    }

    /// Keeps the largest parts; of parts of one size the one that comes first.
    pub async fn keep_largest(&mut self, count: usize, time_slices: &TimeSlices) {
        let [finding, setting] = found_and_set(time_slices);
        let parts = self.parts(1, &finding).await;
        let mut sizes = vec![0u64; parts.runs.len()];
        for (index, run) in parts.runs.iter().enumerate() {
            sizes[parts.root(index as u32) as usize] += u64::from(run.end - run.start);
        }
        let mut roots: Vec<u32> = (0..sizes.len() as u32)
            .filter(|&root| sizes[root as usize] > 0)
            .collect();
        roots.sort_by_key(|&root| (std::cmp::Reverse(sizes[root as usize]), root));
        for &root in roots.iter().take(count) {
            sizes[root as usize] = 0;
        }
        let goes = |root: u32| sizes[root as usize] > 0;
        self.set_parts(&parts, 0, goes, &setting).await;
    }

    /// Keeps the parts that hold one of these voxels.
    pub async fn keep_parts_at(&mut self, seeds: &[UVec3], time_slices: &TimeSlices) {
        let [finding, setting] = found_and_set(time_slices);
        let parts = self.parts(1, &finding).await;
        let mut kept = Vec::new();
        for seed in seeds.iter().filter(|seed| seed.cmplt(self.dims).all()) {
            let row = (seed.y + self.dims.y * seed.z) as usize;
            let holds = |run: &u32| {
                let run = parts.runs[*run as usize];
                (run.start..run.end).contains(&seed.x)
            };
            kept.extend(parts.row(row).find(holds).map(|run| parts.root(run)));
        }
        self.set_parts(&parts, 0, |root| !kept.contains(&root), &setting)
            .await;
    }

    /// Adds every enclosed hole: parts of the rest that touch no end of the grid.
    pub async fn fill(&mut self, time_slices: &TimeSlices) {
        let [finding, setting] = found_and_set(time_slices);
        let parts = self.parts(0, &finding).await;
        let (height, rows) = (self.dims.y as usize, parts.rows.len() - 1);
        let mut is_open = vec![false; parts.runs.len()];
        for row in 0..rows {
            let (y, z) = (row % height, row / height);
            let is_end = y == 0 || y + 1 == height || z == 0 || z + 1 == self.slices();
            for run in parts.row(row) {
                let Run { start, end, .. } = parts.runs[run as usize];
                if is_end || start == 0 || end == self.dims.x {
                    is_open[parts.root(run) as usize] = true;
                }
            }
        }
        self.set_parts(&parts, 1, |root| !is_open[root as usize], &setting)
            .await;
    }

    /// For `wanted` 1: adds every voxel whose centre is at most `reach_mm` from the centre of a voxel in the set
    /// (Euclidean distance). For 0: removes every voxel that is as near to a voxel outside the set. Places beyond the
    /// grid are neither in the set nor outside.
    ///
    /// The squared distance is found axis by axis (Saito and Toriwaki 1994); only slices within reach are held.
    pub async fn spread(
        &mut self,
        wanted: u8,
        spacing_mm: [f32; 3],
        reach_mm: f32,
        time_slices: &TimeSlices,
    ) {
        // Room for the rounding of spacings, so that "1 mm" reaches the next voxel at 1 mm.
        let most = reach_mm * reach_mm * (1.0 + 1e-5);
        let [sx, sy, sz] = spacing_mm;
        let steps = |spacing: f32, count: u32| {
            let steps = (most.sqrt() / spacing.max(1e-6)) as u32;
            steps.min(count.saturating_sub(1)) as usize
        };
        let (rx, ry, rz) = (
            steps(sx, self.dims.x),
            steps(sy, self.dims.y),
            steps(sz, self.dims.z),
        );
        if rx + ry + rz == 0 {
            return;
        }
        let (width, length, slices) = (self.row_length(), self.slice_length(), self.slices());
        let squared = |steps: usize, spacing: f32| {
            let distance = steps as f32 * spacing;
            distance * distance
        };
        // Slices of squared distances within their slice, from `first` on; an empty one is far from everything.
        let mut ring: VecDeque<Vec<f32>> = VecDeque::new();
        let mut first = 0;
        let mut next = 0;
        let mut spare: Vec<Vec<f32>> = Vec::new();
        let mut rows = Vec::new();
        let mut near = Vec::new();
        for z in 0..slices {
            while next < slices && next <= z + rz {
                let bits = &self.bits[next * length..(next + 1) * length];
                let mut flat = Vec::new();
                if bits.contains(&wanted) {
                    flat = spare.pop().unwrap_or_default();
                    rows.clear();
                    for row in bits.chunks_exact(width) {
                        let at = rows.len();
                        rows.resize(at + width, f32::INFINITY);
                        along_row(row, wanted, rx, sx, &mut rows[at..]);
                    }
                    flat.clear();
                    flat.extend_from_slice(&rows);
                    for k in 1..=ry {
                        let more = squared(k, sy);
                        let shift = k * width;
                        lower(&mut flat[shift..], &rows[..length - shift], more);
                        lower(&mut flat[..length - shift], &rows[shift..], more);
                        if k % 8 == 0 {
                            time_slices.give_way().await;
                        }
                    }
                }
                ring.push_back(flat);
                next += 1;
                time_slices.has_done(next + z, 2 * slices);
                time_slices.give_way().await;
            }
            while first + rz < z {
                spare.extend(ring.pop_front().filter(|slice| !slice.is_empty()));
                first += 1;
            }
            near.clear();
            near.resize(length, f32::INFINITY);
            for (i, slice) in ring.iter().enumerate() {
                if !slice.is_empty() {
                    lower(&mut near, slice, squared((first + i).abs_diff(z), sz));
                    time_slices.give_way().await;
                }
            }
            let bits = &mut self.bits[z * length..(z + 1) * length];
            for (bit, &distance) in bits.iter_mut().zip(&near) {
                if distance <= most {
                    *bit = wanted;
                }
            }
            time_slices.has_done(next + z + 1, 2 * slices);
        }
    }

    /// Smooths the outline: blurs the set (1 inside, 0 outside) by a Gaussian and keeps the voxels with at least one
    /// half. A place beyond the grid has the value of its nearest voxel.
    pub async fn smooth(&mut self, spacing_mm: [f32; 3], sigma_mm: f32, time_slices: &TimeSlices) {
        let (width, length, slices) = (self.row_length(), self.slice_length(), self.slices());
        let kernels = spacing_mm.map(|spacing| kernel(sigma_mm / spacing.max(1e-6)));
        let [kx, ky, kz] = &kernels;
        let rz = kz.len() - 1;
        let mut ring: VecDeque<Vec<u16>> = VecDeque::new();
        let (mut first, mut next) = (0, 0);
        let mut row_blurred = vec![0u16; length];
        let mut sums = vec![0u32; length];
        for z in 0..slices {
            while next < slices && next <= z + rz {
                let bits = &self.bits[next * length..(next + 1) * length];
                for (row, out) in bits
                    .chunks_exact(width)
                    .zip(row_blurred.chunks_exact_mut(width))
                {
                    blur_row(row, kx, out);
                }
                time_slices.give_way().await;
                let height = self.dims.y as usize;
                for y in 0..height {
                    let sums = &mut sums[y * width..(y + 1) * width];
                    weigh(sums, ky, y, height, |y| {
                        &row_blurred[y * width..(y + 1) * width]
                    });
                    if y % 32 == 0 {
                        time_slices.give_way().await;
                    }
                }
                ring.push_back(sums.iter().map(|&sum| (sum >> 16) as u16).collect());
                next += 1;
                time_slices.has_done(next + z, 2 * slices);
            }
            while first + rz < z {
                ring.pop_front();
                first += 1;
            }
            weigh(&mut sums, kz, z, slices, |z| &ring[z - first]);
            time_slices.has_done(next + z + 1, 2 * slices);
            time_slices.give_way().await;
            let bits = &mut self.bits[z * length..(z + 1) * length];
            for (bit, &sum) in bits.iter_mut().zip(&sums) {
                *bit = u8::from(sum >= 1 << 31);
            }
        }
    }
}

/// Finding the parts of a set, and changing some of them: most of the time goes into the first.
fn found_and_set(time_slices: &TimeSlices) -> [TimeSlices; 2] {
    [time_slices.part(0.0, 0.8), time_slices.part(0.8, 1.0)]
}

/// Squared distance along a row to the nearest of its voxels that are `wanted`, as far as `reach` voxels.
fn along_row(row: &[u8], wanted: u8, reach: usize, spacing: f32, out: &mut [f32]) {
    let mut run = |indices: &mut dyn Iterator<Item = usize>| {
        let mut since = usize::MAX;
        for x in indices {
            since = if row[x] == wanted {
                0
            } else {
                since.saturating_add(1)
            };
            if since <= reach {
                let distance = since as f32 * spacing;
                out[x] = out[x].min(distance * distance);
            }
        }
    };
    run(&mut (0..row.len()));
    run(&mut (0..row.len()).rev());
}

fn lower(into: &mut [f32], from: &[f32], more: f32) {
    for (into, &from) in into.iter_mut().zip(from) {
        let other = from + more;
        if other < *into {
            *into = other;
        }
    }
}

/// Half of a Gaussian of `sigma` voxels, the middle first, in 65536ths; the whole sums to one.
fn kernel(sigma: f32) -> Vec<u32> {
    let sigma = f64::from(sigma.min(1000.0));
    let reach = (3.0 * sigma).ceil() as usize;
    let weights: Vec<f64> = (0..=reach)
        .map(|k| falling(0.5 * (k as f64 / sigma.max(1e-9)).powi(2)))
        .collect();
    let sum = weights[0] + 2.0 * weights[1..].iter().sum::<f64>();
    let mut kernel: Vec<u32> = weights
        .iter()
        .map(|w| (w / sum * 65536.0 + 0.5) as u32)
        .collect();
    kernel[0] = 65536 - 2 * kernel[1..].iter().sum::<u32>().min(32768);
    kernel
}

/// e to the power of −t by additions and products alone, for those of the system's libraries differ in the last digit.
fn falling(t: f64) -> f64 {
    if t > 700.0 {
        return 0.0;
    }
    let small = t / 1024.0;
    let mut sum = 1.0;
    for n in (1..=12).rev() {
        sum = 1.0 + sum * small / f64::from(n);
    }
    for _ in 0..10 {
        sum *= sum;
    }
    1.0 / sum
}

fn blur_row(row: &[u8], kernel: &[u32], out: &mut [u16]) {
    let last = row.len() - 1;
    // Where a whole row is of one kind, so is the result.
    if row.iter().all(|&bit| bit == row[0]) {
        out.fill(if row[0] == 1 { u16::MAX } else { 0 });
        return;
    }
    for (x, out) in out.iter_mut().enumerate() {
        let mut sum = kernel[0] * u32::from(row[x]);
        for (k, &weight) in kernel.iter().enumerate().skip(1) {
            let (a, b) = (row[x.saturating_sub(k)], row[(x + k).min(last)]);
            sum += weight * u32::from(a + b);
        }
        *out = sum.min(65535) as u16;
    }
}

/// Sums of lines around line `at` of `count`, weighted; lines beyond the ends are as the last.
fn weigh<'a>(
    sums: &mut [u32],
    kernel: &[u32],
    at: usize,
    count: usize,
    line: impl Fn(usize) -> &'a [u16],
) {
    sums.fill(0);
    let mut add = |line: &[u16], weight: u32| {
        for (sum, &value) in sums.iter_mut().zip(line) {
            *sum += weight * u32::from(value);
        }
    };
    add(line(at), kernel[0]);
    for (k, &weight) in kernel.iter().enumerate().skip(1) {
        add(line(at.saturating_sub(k)), weight);
        add(line((at + k).min(count - 1)), weight);
    }
}
