//! The voxels of one recipe: the first draft, its clean-up, and what was painted over it. What the clean-up leaves can
//! be kept, so that a stroke does not cost the clean-up again.

use std::cell::RefCell;
use std::rc::Rc;

use glam::DVec3;

use super::mask::Mask;
use super::time_slices::TimeSlices;
use super::{Volume, Voxels};
use crate::document::{CleanStep, Recipe, RecipeSource};

/// What the clean-up of recipes left, a bit per voxel, for runs to come on the same subject. A clone holds the same.
#[derive(Clone, Debug, Default)]
pub struct KnownMasks(Rc<RefCell<Vec<Known>>>);

#[derive(Debug)]
struct Known {
    from: RecipeSource,
    clean: Vec<CleanStep>,
    bits: Vec<u64>,
}

impl Known {
    fn is_of(&self, recipe: &Recipe) -> bool {
        self.from == recipe.from && self.clean == recipe.clean
    }
}

impl KnownMasks {
    /// Bytes that are held.
    pub fn byte_count(&self) -> usize {
        let known = self.0.borrow();
        known.iter().map(|known| 8 * known.bits.len()).sum()
    }

    fn get(&self, recipe: &Recipe, voxel_count: usize) -> Option<Vec<u8>> {
        let all = self.0.borrow();
        let known = all.iter().find(|known| known.is_of(recipe))?;
        let is_same_size = known.bits.len() == voxel_count.div_ceil(64);
        is_same_size.then(|| {
            let word = |word: &u64| {
                let word = *word;
                (0..64).map(move |i| (word >> i & 1) as u8)
            };
            let mut bits = Vec::with_capacity(known.bits.len() * 64);
            for known in &known.bits {
                bits.extend(word(known));
            }
            bits.truncate(voxel_count);
            bits
        })
    }

    fn keep(&self, recipe: &Recipe, mask: &Mask) {
        let word = |bits: &[u8]| {
            let bits = bits.iter().enumerate();
            bits.fold(0, |word, (i, &bit)| word | u64::from(bit) << i)
        };
        let mut all = self.0.borrow_mut();
        all.retain(|known| !known.is_of(recipe));
        all.push(Known {
            from: recipe.from.clone(),
            clean: recipe.clean.clone(),
            bits: mask.bits.chunks(64).map(word).collect(),
        });
    }

    /// Forgets what belongs to none of these recipes.
    pub(super) fn keep_to(&self, recipes: &[Recipe]) {
        let mut all = self.0.borrow_mut();
        all.retain(|known| recipes.iter().any(|recipe| known.is_of(recipe)));
    }
}

/// Steps of a recipe: finding its voxels, its clean-up, what is painted, and joining the voxels with other segments.
pub(super) fn step_count(recipe: &Recipe) -> usize {
    recipe.clean.len() + usize::from(!recipe.paint.is_empty()) + 2
}

/// The voxels of a recipe, on the scan's grid. Tells `has_done` how many of its steps are done: all but joining.
pub(super) async fn made(
    volume: &Volume,
    recipe: &Recipe,
    known: Option<&KnownMasks>,
    notices: &mut Vec<String>,
    time_slices: &TimeSlices,
    has_done: &mut impl FnMut(usize),
) -> Mask {
    let cleaned = known.and_then(|known| known.get(recipe, volume.voxels.len()));
    let mut mask = match cleaned {
        Some(bits) => {
            let dims = volume.grid.dims;
            has_done(recipe.clean.len() + 1);
            Mask { dims, bits }
        }
        None => {
            let mask = cleaned_mask(volume, recipe, notices, time_slices, has_done).await;
            // Nothing is found again at no cost.
            if let Some(known) = known.filter(|_| recipe.from != RecipeSource::Nothing) {
                known.keep(recipe, &mask);
            }
            mask
        }
    };
    time_slices.give_way().await;
    if recipe.paint.is_empty() {
        return mask;
    }
    for (i, stroke) in recipe.paint.iter().enumerate() {
        mask.paint(&volume.grid, stroke, time_slices).await;
        time_slices.has_done(i + 1, recipe.paint.len());
    }
    has_done(1);
    mask
}

async fn cleaned_mask(
    volume: &Volume,
    recipe: &Recipe,
    notices: &mut Vec<String>,
    time_slices: &TimeSlices,
    has_done: &mut impl FnMut(usize),
) -> Mask {
    let mut mask = draft(volume, recipe, notices, time_slices).await;
    has_done(1);
    let spacing = volume.grid.spacing_mm().as_vec3().to_array();
    for step in &recipe.clean {
        match *step {
            CleanStep::Largest(count) => mask.keep_largest(count as usize, time_slices).await,
            CleanStep::Fill => mask.fill(time_slices).await,
            CleanStep::Close(mm) => {
                let [first, second] = [time_slices.part(0.0, 0.5), time_slices.part(0.5, 1.0)];
                mask.spread(1, spacing, mm, &first).await;
                mask.spread(0, spacing, mm, &second).await;
            }
            CleanStep::Smooth(mm) => mask.smooth(spacing, mm, time_slices).await,
            CleanStep::Grow(mm) => mask.spread(1, spacing, mm, time_slices).await,
            CleanStep::Shrink(mm) => mask.spread(0, spacing, mm, time_slices).await,
        }
        has_done(1);
    }
    mask
}

/// The first draft of a segment, on the scan's grid.
async fn draft(
    volume: &Volume,
    recipe: &Recipe,
    notices: &mut Vec<String>,
    time_slices: &TimeSlices,
) -> Mask {
    let dims = volume.grid.dims;
    let slice = dims.x as usize * dims.y as usize;
    let Some(range) = recipe.from.range() else {
        let bits = vec![0; volume.voxels.len()];
        return Mask { dims, bits };
    };
    let mut bits = Vec::with_capacity(volume.voxels.len());
    let is_grown = matches!(recipe.from, RecipeSource::Grow { .. });
    let reading = time_slices.part(0.0, if is_grown { 0.2 } else { 1.0 });
    while bits.len() < volume.voxels.len() {
        within(volume, range, bits.len()..bits.len() + slice, &mut bits);
        reading.has_done(bits.len(), volume.voxels.len());
        time_slices.give_way().await;
    }
    let mut mask = Mask { dims, bits };
    if let RecipeSource::Grow { seeds, .. } = &recipe.from {
        let voxel_from_subject = volume.grid.subject_from_voxel().inverse();
        let mut inside = Vec::new();
        for (i, seed) in seeds.iter().enumerate() {
            let voxel = (voxel_from_subject.transform_point3(seed.as_dvec3()) + 0.5).floor();
            let at = format!("/subject/features/{}/from/grow/seeds/{i}", recipe.index);
            let is_outside = voxel.cmplt(DVec3::ZERO).any() || voxel.cmpge(dims.as_dvec3()).any();
            if is_outside {
                notices.push(format!(
                    "{at}: the seed lies outside the scan; nothing grows from it"
                ));
                continue;
            }
            let voxel = voxel.as_uvec3();
            match volume.value_at(voxel) {
                Some(value) if !(range[0]..=range[1]).contains(&value) => notices.push(format!(
                    "{at}: the scan has the value {value} there, outside the range; nothing grows from it"
                )),
                _ => inside.push(voxel),
            }
        }
        let growing = time_slices.part(0.2, 1.0);
        mask.keep_parts_at(&inside, &growing).await;
    }
    mask
}

/// Appends 1 for each voxel with a value in the range, else 0.
fn within(volume: &Volume, [low, high]: [f32; 2], part: std::ops::Range<usize>, out: &mut Vec<u8>) {
    let (slope, intercept) = (volume.slope, volume.intercept);
    let test = |stored: f32| {
        let value = stored * slope + intercept;
        u8::from(low <= value && value <= high)
    };
    match &volume.voxels {
        Voxels::U8(v) => out.extend(v[part].iter().map(|&x| test(f32::from(x)))),
        Voxels::I16(v) => out.extend(v[part].iter().map(|&x| test(f32::from(x)))),
        Voxels::U16(v) => out.extend(v[part].iter().map(|&x| test(f32::from(x)))),
        Voxels::F32(v) => out.extend(v[part].iter().map(|&x| test(x))),
    }
}
