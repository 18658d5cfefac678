//! What all formats share about grids: which affines can be used, and what a volume starts from.

use glam::{DAffine3, DMat3, DVec3, UVec3};

use super::voxels::Layout;
use super::{LoadError, ReadOptions};
use crate::data::{Grid, Volume};

/// An affine whose axes span less than this part of a box with the same edge lengths is flat.
const MIN_RELATIVE_VOLUME: f64 = 1e-4;
/// The longest voxel edge over the shortest. Beyond, nothing could be seen; and 32-bit floats would not hold it.
const MAX_ANISOTROPY: f64 = 1e4;
/// Voxel edges in mm: from a nanometre to a kilometre.
const EDGE_MM: std::ops::RangeInclusive<f64> = 1e-6..=1e6;
/// Distance of the origin from 0, mm.
const MAX_ORIGIN_MM: f64 = 1e9;

/// True if the affine can be drawn: finite, not flat, voxels of a sensible size.
pub(crate) fn is_usable(world_from_voxel: &DAffine3) -> bool {
    let m = world_from_voxel.matrix3;
    if !m.is_finite() || !world_from_voxel.translation.is_finite() {
        return false;
    }
    let edges = DVec3::new(m.x_axis.length(), m.y_axis.length(), m.z_axis.length());
    edges.to_array().iter().all(|edge| EDGE_MM.contains(edge))
        && edges.max_element() / edges.min_element() <= MAX_ANISOTROPY
        && m.determinant().abs() >= MIN_RELATIVE_VOLUME * edges.element_product()
        && world_from_voxel.translation.abs().max_element() <= MAX_ORIGIN_MM
}

/// Axes along the grid, first voxel at 0, for a file without an orientation.
pub(crate) fn unoriented(spacing_mm: DVec3) -> DAffine3 {
    DAffine3::from_mat3_translation(DMat3::from_diagonal(spacing_mm), DVec3::ZERO)
}

/// Three letters that name the direction in which each index grows: right, anterior, superior, left, posterior,
/// inferior. Oblique axes get the nearest, each letter pair once.
pub fn orientation_code(grid: &Grid) -> String {
    let m = grid.world_from_voxel.matrix3;
    let axes = [m.x_axis, m.y_axis, m.z_axis].map(DVec3::normalize_or_zero);
    // Of the six ways to pair axes, the one that fits best in total.
    const PAIRINGS: [[usize; 3]; 6] = [
        [0, 1, 2],
        [0, 2, 1],
        [1, 0, 2],
        [1, 2, 0],
        [2, 0, 1],
        [2, 1, 0],
    ];
    let fit = |pairing: &[usize; 3]| -> f64 { (0..3).map(|i| axes[i][pairing[i]].abs()).sum() };
    let best = PAIRINGS.iter().fold(PAIRINGS[0], |best, next| {
        if fit(next) > fit(&best) + 1e-9 {
            *next
        } else {
            best
        }
    });
    (0..3)
        .map(|i| {
            let letters = [['R', 'L'], ['A', 'P'], ['S', 'I']][best[i]];
            if axes[i][best[i]] >= 0.0 {
                letters[0]
            } else {
                letters[1]
            }
        })
        .collect()
}

/// The header that goes to the sink, once sizes are known to be possible.
pub(crate) fn header(
    name: &str,
    layout: &Layout,
    world_from_voxel: DAffine3,
    slope: f32,
    intercept: f32,
    has_size: bool,
) -> Result<Volume, LoadError> {
    if layout.dims.cmpeq(UVec3::ZERO).any() {
        return Err(LoadError::Unsupported {
            name: name.to_owned(),
            what: format!(
                "no voxels: {} × {} × {}",
                layout.dims.x, layout.dims.y, layout.dims.z
            ),
        });
    }
    Ok(Volume {
        grid: Grid {
            dims: layout.dims,
            world_from_voxel,
        },
        voxels: layout.element.kept_as(),
        slope,
        intercept,
        value_range: [0.0, 0.0],
        segmentation: None,
        has_size,
    })
}

/// Sizes from a header, checked against the limit.
pub(crate) fn checked_dims(
    name: &str,
    dims: [u64; 3],
    options: &ReadOptions,
) -> Result<UVec3, LoadError> {
    let voxels = dims.iter().try_fold(1u64, |n, &d| n.checked_mul(d));
    match (voxels, dims.map(u32::try_from)) {
        (Some(n), [Ok(x), Ok(y), Ok(z)]) if n <= options.max_voxels => Ok(UVec3::new(x, y, z)),
        _ => Err(LoadError::TooLarge {
            name: name.to_owned(),
            voxels: voxels.unwrap_or(u64::MAX),
            limit: options.max_voxels,
        }),
    }
}
