//! Segments made here: from the recipes of a document to voxels, and into one label volume with the segments that came
//! with the file.

use std::sync::Arc;

use glam::{DVec3, UVec3};

use super::made::{KnownMasks, made, step_count};
use super::mask::Mask;
use super::time_slices::TimeSlices;
use super::{Grid, Resources, Segment, Segmentation, Subject, Volume, resized};
use crate::document::{Recipe, RecipeSource};

/// Colours of segments whose recipe names none, in turn; told apart by those who see few colours too (after Okabe and
/// Ito 2008).
pub const RECIPE_COLORS_SRGB: [[u8; 3]; 8] = [
    [234, 223, 196],
    [86, 180, 233],
    [230, 159, 0],
    [0, 158, 115],
    [204, 121, 167],
    [213, 94, 0],
    [240, 228, 66],
    [0, 114, 178],
];

/// Colours of segments whose file gives none, by what their names hold, sRGB.
const NATURAL_COLORS_SRGB: [(&str, [u8; 3]); 6] = [
    ("skull", [234, 223, 196]),
    ("bone", [234, 223, 196]),
    ("brain", [219, 178, 168]),
    ("skin", [224, 172, 140]),
    ("muscle", [172, 66, 56]),
    ("fat", [236, 208, 120]),
];

fn natural_color(name: &str, label: u8) -> [u8; 3] {
    let lower = name.to_lowercase();
    let known = NATURAL_COLORS_SRGB
        .iter()
        .find(|(part, _)| lower.contains(part));
    known.map_or(
        RECIPE_COLORS_SRGB[usize::from(label) % RECIPE_COLORS_SRGB.len()],
        |(_, color)| *color,
    )
}

/// Voxels of the labels at most where label volumes are finer than the scan.
const MOST_LABELS: u64 = 1 << 28;

/// The segments of a subject, from its files and from recipes, and the notices about them.
#[derive(Clone, Debug, PartialEq)]
pub struct Segmented {
    /// All segments; `None` if there is none.
    pub segmentation: Option<Arc<Segmentation>>,
    /// Voxels of each recipe, in order.
    pub counts: Vec<u64>,
    /// Lines for the user; each begins with the JSON pointer of the recipe.
    pub notices: Vec<String>,
}

/// Makes the segments of a document's recipes out of the voxels of its subject, and joins them with the segments of
/// the subject's own file and of label volumes that lie beside it (on any grid). Where segments overlap, a label of its
/// own stands for the overlap. Without a subject there are none.
///
/// The result is the same bit for bit on every machine. Holds a byte per voxel besides the result.
pub async fn segment(
    resources: Resources,
    recipes: Vec<Recipe>,
    time_slices: TimeSlices,
) -> Segmented {
    segment_with(resources, recipes, None, time_slices).await
}

/// Like [`segment`], with the cleaned sets of earlier runs on the same subject at hand: of a recipe whose `from` and
/// `clean` are as they were, only the strokes are done anew. The result is the same. Holds a bit per voxel and recipe
/// in `known` from then on.
pub async fn segment_with(
    resources: Resources,
    recipes: Vec<Recipe>,
    known: Option<KnownMasks>,
    time_slices: TimeSlices,
) -> Segmented {
    let known = known.as_ref();
    let mut notices = Vec::new();
    let own = resources.own_segmentation();
    let files = &resources.segmentations;
    let volume = resources.subject.as_ref().and_then(Subject::values);
    let Some(volume) = volume.filter(|_| !files.is_empty() || !recipes.is_empty()) else {
        return Segmented {
            segmentation: own.map(|labels| Arc::new(labels.into_owned())),
            counts: Vec::new(),
            notices,
        };
    };
    let grid = grid_of_labels(volume, files);
    let mut join = Join::new(grid);
    // The segments' own labels first, so that their numbers depend on the list alone and not on overlaps.
    let mut sources = Vec::new();
    for labels in own
        .as_deref()
        .into_iter()
        .chain(files.iter().map(Arc::as_ref))
    {
        sources.push((
            labels,
            join.list_file(labels, &mut notices, &time_slices).await,
        ));
    }
    let listed: Vec<Option<Segment>> = recipes
        .iter()
        .map(|recipe| join.list_segment(recipe, &mut notices))
        .collect();
    for (labels, becomes) in sources {
        join.add_file(labels, &becomes, &mut notices, &time_slices)
            .await;
    }
    let mut counts = Vec::with_capacity(recipes.len());
    let steps: usize = recipes.iter().map(step_count).sum();
    time_slices.set_steps(steps);
    let mut done = 0;
    let mut has_done = |n: usize| {
        done += n;
        time_slices.set_progress(done as f32 / steps.max(1) as f32);
    };
    for (recipe, listed) in recipes.iter().zip(listed) {
        let mask = made(
            volume,
            recipe,
            known,
            &mut notices,
            &time_slices,
            &mut has_done,
        )
        .await;
        let count = mask.bits.iter().map(|&bit| u64::from(bit)).sum();
        // What is yet to be painted is not missed.
        let is_begun = recipe.from != RecipeSource::Nothing || !recipe.paint.is_empty();
        if count == 0 && is_begun {
            notices.push(format!(
                "/subject/features/{}: no voxel of the scan is in “{}”",
                recipe.index, recipe.name
            ));
        }
        counts.push(count);
        if let Some(segment) = listed {
            let at = format!("/subject/features/{}", recipe.index);
            join.add_segment(
                &volume.grid,
                &mask,
                &segment,
                &at,
                &mut notices,
                &time_slices,
            )
            .await;
        }
        has_done(1);
    }
    if let Some(known) = known {
        known.keep_to(&recipes);
    }
    Segmented {
        segmentation: Some(Arc::new(join.finish())),
        counts,
        notices,
    }
}

/// The grid on which segments are joined: the scan's, made finer by a whole number where a label volume has voxels
/// half as large.
fn grid_of_labels(volume: &Volume, files: &[Arc<Segmentation>]) -> Grid {
    let own = volume.segmentation.as_ref().into_iter();
    let scan = volume.grid.world_from_voxel.matrix3;
    let mut factors = DVec3::ONE;
    for labels in own.chain(files.iter().map(Arc::as_ref)) {
        let other = labels.grid.world_from_voxel.matrix3;
        for axis in 0..3 {
            // Along the axis of theirs that runs most nearly as this one does, whichever way.
            let (along, length) = (scan.col(axis).normalize_or_zero(), scan.col(axis).length());
            let share = |i: usize| along.dot(other.col(i).normalize_or_zero()).abs();
            let nearest = (1..3).fold(0, |best, i| if share(i) > share(best) { i } else { best });
            let factor = length / other.col(nearest).length().max(1e-9) + 0.25;
            factors[axis] = factors[axis].max(factor.floor().clamp(1.0, 4.0));
        }
    }
    let dims = volume.grid.dims * factors.as_uvec3();
    if dims == volume.grid.dims || dims.as_u64vec3().element_product() > MOST_LABELS {
        return volume.grid;
    }
    resized(&volume.grid, dims)
}

/// Segments from several sources, put into one label volume.
struct Join {
    labels: Segmentation,
    /// What each label stands for, as places in `labels.segments`; the own segment of a source is listed under its
    /// own label first.
    stands_for: Vec<Vec<Segment>>,
    is_taken: [bool; 256],
    /// Highest label of the first files.
    highest: usize,
}

impl Join {
    fn new(grid: Grid) -> Self {
        let mut is_taken = [false; 256];
        is_taken[0] = true;
        Self {
            labels: Segmentation {
                grid,
                labels: vec![0; grid.voxel_count()],
                segments: Vec::new(),
            },
            stands_for: vec![Vec::new(); 256],
            is_taken,
            highest: 0,
        }
    }

    /// A label that means nothing yet: the next after those in use, else any.
    fn free(&mut self) -> Option<u8> {
        let after = self.highest + 1..256;
        let label = after.chain(1..256).find(|&label| !self.is_taken[label])?;
        self.is_taken[label] = true;
        self.highest = self.highest.max(label);
        Some(label as u8)
    }

    /// Lists the segments of a label volume, by their numbers in it. A number that is in use becomes another one.
    async fn list_file(
        &mut self,
        file: &Segmentation,
        notices: &mut Vec<String>,
        time_slices: &TimeSlices,
    ) -> Vec<Option<Segment>> {
        let mut occurs = [false; 256];
        for part in file.labels.chunks(1 << 18) {
            for &label in part {
                occurs[usize::from(label)] = true;
            }
            time_slices.give_way().await;
        }
        let mut becomes: Vec<Option<Segment>> = vec![None; 256];
        for number in 1..256usize {
            let named = file
                .segments
                .iter()
                .find(|s| usize::from(s.label) == number);
            if !occurs[number] && named.is_none() {
                continue;
            }
            let label = if self.is_taken[number] {
                self.free()
            } else {
                self.is_taken[number] = true;
                self.highest = self.highest.max(number);
                Some(number as u8)
            };
            let Some(label) = label else {
                notices.push(format!(
                    "a label volume: there are more than 255 segments; number {number} is left out"
                ));
                continue;
            };
            let name = named.map_or_else(String::new, |s| s.name.clone());
            let is_used = |name: &str| self.labels.segments.iter().any(|s| s.name == name);
            // What two files call by number only is told apart by the number it has here.
            let name = if name.is_empty() || (name.starts_with("segment ") && is_used(&name)) {
                format!("segment {label}")
            } else {
                name
            };
            let color = named
                .and_then(|s| s.color_srgb)
                .unwrap_or_else(|| natural_color(&name, label));
            let segment = Segment {
                label: u16::from(label),
                name,
                color_srgb: Some(color),
            };
            self.stands_for[usize::from(label)] = vec![segment.clone()];
            self.labels.segments.push(segment.clone());
            becomes[number] = Some(segment);
        }
        becomes
    }

    async fn add_file(
        &mut self,
        file: &Segmentation,
        becomes: &[Option<Segment>],
        notices: &mut Vec<String>,
        time_slices: &TimeSlices,
    ) {
        let from = Nearest::new(&self.labels.grid, &file.grid);
        let mut table = OverlapTable::default();
        let mut lost = 0u64;
        let dims = self.labels.grid.dims;
        let mut at = 0;
        for z in 0..dims.z {
            for y in 0..dims.y {
                for x in 0..dims.x {
                    let number = from
                        .index(UVec3::new(x, y, z))
                        .and_then(|i| file.labels.get(i).copied())
                        .unwrap_or(0);
                    if let Some(segment) = &becomes[usize::from(number)] {
                        let old = self.labels.labels[at];
                        self.labels.labels[at] = self.with(old, segment, &mut table, &mut lost);
                    }
                    at += 1;
                }
                if y % 16 == 0 {
                    time_slices.give_way().await;
                }
            }
        }
        self.report_lost(lost, "a label volume", notices);
    }

    fn list_segment(&mut self, recipe: &Recipe, notices: &mut Vec<String>) -> Option<Segment> {
        let Some(label) = self.free() else {
            notices.push(format!(
                "/subject/features/{}: there are 255 segments already; “{}” is left out",
                recipe.index, recipe.name
            ));
            return None;
        };
        let color = RECIPE_COLORS_SRGB[recipe.index % RECIPE_COLORS_SRGB.len()];
        let segment = Segment {
            label: u16::from(label),
            name: recipe.name.clone(),
            color_srgb: Some(recipe.color_srgb.unwrap_or(color)),
        };
        self.stands_for[usize::from(label)] = vec![segment.clone()];
        self.labels.segments.push(segment.clone());
        Some(segment)
    }

    async fn add_segment(
        &mut self,
        scan: &Grid,
        mask: &Mask,
        segment: &Segment,
        at: &str,
        notices: &mut Vec<String>,
        time_slices: &TimeSlices,
    ) {
        let mut table = OverlapTable::default();
        let mut lost = 0;
        // Finer by a whole number, or the same.
        let factor = self.labels.grid.dims / scan.dims.max(UVec3::ONE);
        let dims = self.labels.grid.dims;
        let width = mask.dims.x as usize;
        let mut out = 0;
        for z in 0..dims.z {
            for y in 0..dims.y {
                let row = ((y / factor.y) + mask.dims.y * (z / factor.z)) as usize * width;
                for x in 0..dims.x {
                    if mask.bits[row + (x / factor.x) as usize] == 1 {
                        let old = self.labels.labels[out];
                        self.labels.labels[out] = self.with(old, segment, &mut table, &mut lost);
                    }
                    out += 1;
                }
            }
            time_slices.has_done(z as usize + 1, dims.z as usize);
            time_slices.give_way().await;
        }
        self.report_lost(lost, at, notices);
    }

    fn report_lost(&self, lost: u64, what: &str, notices: &mut Vec<String>) {
        if lost > 0 {
            notices.push(format!(
                "{what}: too many segments overlap; {lost} voxels belong to the last of them only"
            ));
        }
    }

    /// The label that stands for what `old` stands for and this segment too.
    fn with(&mut self, old: u8, segment: &Segment, table: &mut OverlapTable, lost: &mut u64) -> u8 {
        let own = segment.label as u8;
        if old == 0 || old == own {
            return own;
        }
        let key = (old, own);
        if let Some((_, label)) = table.known.iter().find(|(k, _)| *k == key) {
            *lost += u64::from(label.is_none());
            return label.unwrap_or(own);
        }
        if self.stands_for[usize::from(old)].contains(segment) {
            return old;
        }
        let label = self.free();
        table.known.push((key, label));
        let Some(label) = label else {
            *lost += 1;
            return own;
        };
        let mut all = self.stands_for[usize::from(old)].clone();
        all.push(segment.clone());
        // Once for each of them, under the label that stands for all.
        for member in &all {
            self.labels.segments.push(Segment {
                label: u16::from(label),
                ..member.clone()
            });
        }
        self.stands_for[usize::from(label)] = all;
        label
    }

    fn finish(self) -> Segmentation {
        self.labels
    }
}

/// Labels of overlaps, by the label that a voxel had and the label that was added.
#[derive(Default)]
struct OverlapTable {
    known: Vec<((u8, u8), Option<u8>)>,
}

/// Finds the voxel of one grid that is nearest to a voxel of another grid.
struct Nearest {
    is_same: bool,
    to: glam::DAffine3,
    from_dims: UVec3,
    dims: UVec3,
}

impl Nearest {
    fn new(from: &Grid, to: &Grid) -> Self {
        let affine = to.world_from_voxel.inverse() * from.world_from_voxel;
        Self {
            is_same: from.dims == to.dims && affine.abs_diff_eq(glam::DAffine3::IDENTITY, 1e-6),
            to: affine,
            from_dims: from.dims,
            dims: to.dims,
        }
    }

    fn index(&self, voxel: UVec3) -> Option<usize> {
        let there = if self.is_same {
            debug_assert!(voxel.cmplt(self.from_dims).all(), "of this grid");
            voxel
        } else {
            let there = (self.to.transform_point3(voxel.as_dvec3()) + 0.5).floor();
            if there.cmplt(DVec3::ZERO).any() || there.cmpge(self.dims.as_dvec3()).any() {
                return None;
            }
            there.as_uvec3()
        };
        let [x, y, z] = there.to_array().map(|n| n as usize);
        let [width, height, _] = self.dims.to_array().map(|n| n as usize);
        Some(x + width * (y + height * z))
    }
}
