use super::fill::{Fill, add_filled, crosses_itself};
use super::flood::{flood, over_white};
use super::mask::Mask;
use super::parts::{Neighbours, Padded};
use crate::document::figure::{Region, Source};
use crate::figure::notice::Notice;
use crate::figure::plane::Plane;
use crate::figure::progress::{Progress, unwatched};
use crate::pictures::Picture;

/// Label of the pixels that belong to no region and are not transparent.
pub const REST: u8 = 64;
/// Label of the pixels that are no part of the figure: transparent ones.
pub const VOID: u8 = 65;
/// Transparent pixels within this of the rest belong to it, pixels.
const REST_MARGIN: f64 = 2.0;

/// What regions are found in.
pub struct Canvas<'a> {
    /// How the figure's plane lies over the map.
    pub plane: Plane,
    /// The pixels, if the source has any: as many as the map has.
    pub picture: Option<&'a Picture>,
    /// What is drawn of a source without pixels; none: all of it.
    pub drawn: Option<Mask>,
    /// The filled shapes of an element by its id, or of a shape by its number, in map space.
    pub shapes: &'a dyn Fn(&str) -> Option<Vec<Fill>>,
}

/// To which region each pixel of the map belongs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RegionMap {
    /// Width and height, pixels.
    pub size: [usize; 2],
    /// Per pixel the number of its region in the list, [`REST`] or [`VOID`].
    pub labels: Vec<u8>,
}

impl RegionMap {
    /// The map of a document's regions.
    pub fn new(canvas: &Canvas<'_>, regions: &[Region], notices: &mut Vec<Notice>) -> Self {
        // What nobody watches is not stopped.
        let pixels = Pixels::new(canvas, regions, notices, &mut unwatched);
        pixels.map_or_else(|| Self::void(canvas), |pixels| pixels.laid(0))
    }

    /// Gives parts of fewer than `least` pixels to what lies to their left, or above where that is the map's edge:
    /// pieces of the rest between regions, and of regions under others.
    fn merge_small_parts(&mut self, least: usize) {
        let width = self.size[0];
        let padded = Padded::new(self.size, self.labels.iter().copied());
        padded.visit_parts(Neighbours::Four, least, |part| {
            // The first pixel in the order of rows: what lies left of it and above it is of another part.
            let first = part[0];
            let neighbour = if first % width > 0 {
                Some(first - 1)
            } else {
                first.checked_sub(width)
            };
            if let Some(neighbour) = neighbour {
                let label = self.labels[neighbour];
                part.iter().for_each(|at| self.labels[*at] = label);
            }
        });
    }

    /// A map in which nothing is drawn.
    fn void(canvas: &Canvas<'_>) -> Self {
        let size = canvas.plane.map.map(|side| side as usize);
        Self {
            size,
            labels: vec![VOID; size[0] * size[1]],
        }
    }

    /// Pixels that are left to each label, by its number.
    pub fn counts(&self) -> [usize; 256] {
        let mut counts = [0; 256];
        for label in &self.labels {
            counts[usize::from(*label)] += 1;
        }
        counts
    }
}

/// The pixels of all regions, each as it is before others are laid over it. Built once for a document's regions.
pub(crate) struct Pixels {
    regions: Vec<Packed>,
    /// Parts below this are left out already, by region.
    least: Vec<usize>,
    /// Pixels that are not fully transparent.
    drawn: Packed,
    size: [usize; 2],
}

/// A set of pixels, eight in a byte: there may be 64 sets of 16 million.
struct Packed(Vec<u8>);

impl Packed {
    fn new(mask: &Mask) -> Self {
        let byte = |bits: &[bool]| {
            bits.iter()
                .rev()
                .fold(0, |byte, bit| byte << 1 | u8::from(*bit))
        };
        Self(mask.bits.chunks(8).map(byte).collect())
    }

    fn mask(&self, size: [usize; 2]) -> Mask {
        let mut bits: Vec<bool> = self
            .0
            .iter()
            .flat_map(|byte| (0..8).map(move |k| byte >> k & 1 == 1))
            .collect();
        bits.truncate(size[0] * size[1]);
        Mask { size, bits }
    }
}

impl Pixels {
    /// Finds the pixels of each region and cleans them up: holes, growth, small parts. None if that was stopped.
    pub(crate) fn new(
        canvas: &Canvas<'_>,
        regions: &[Region],
        notices: &mut Vec<Notice>,
        progress: &mut Progress<'_>,
    ) -> Option<Self> {
        let size = canvas.plane.map.map(|side| side as usize);
        let is_flooded = |region: &Region| matches!(region.from, Some(Source::Flood(_)));
        let colors = match canvas.picture {
            Some(picture) if regions.iter().any(is_flooded) => over_white(picture),
            _ => Vec::new(),
        };
        let mut packed = Vec::new();
        for (i, region) in regions.iter().enumerate() {
            if !progress(i as f32 / regions.len() as f32) {
                return None;
            }
            let mut mask = taken(canvas, region, &colors, notices);
            if region.fills_holes() {
                mask.fill_holes(usize::MAX);
            }
            let mut mask = mask.offset(region.grow);
            mask.drop_small_parts(region.least as usize);
            packed.push(Packed::new(&mask));
        }
        let drawn = match (canvas.picture, &canvas.drawn) {
            (Some(picture), _) => Packed::new(&Mask {
                size,
                bits: picture.pixels.iter().map(|pixel| pixel[3] > 0).collect(),
            }),
            (None, Some(drawn)) => Packed::new(drawn),
            (None, None) => Packed::new(&Mask::none(size).inverted()),
        };
        Some(Self {
            regions: packed,
            least: regions.iter().map(|region| region.least as usize).collect(),
            drawn,
            size,
        })
    }

    /// Lays the regions over each other in the order of the list, and the rest behind them. `coarser` is how often the
    /// least number of pixels is doubled: parts and holes below it are left out, of the regions and of the rest.
    pub(crate) fn laid(&self, coarser: u32) -> RegionMap {
        let mut labels = vec![VOID; self.size[0] * self.size[1]];
        for ((packed, least), label) in self.regions.iter().zip(&self.least).zip(0..) {
            let mut mask = packed.mask(self.size);
            drop_small(&mut mask, *least, coarser);
            lay(&mut labels, &mask, label);
        }
        let mut rest = self.drawn.mask(self.size);
        for (bit, label) in rest.bits.iter_mut().zip(&labels) {
            *bit &= *label == VOID;
        }
        if rest
            .bits
            .iter()
            .zip(&labels)
            .any(|(bit, label)| !bit && *label == VOID)
        {
            rest = rest.grown(REST_MARGIN);
        }
        for (label, bit) in labels.iter_mut().zip(&rest.bits) {
            if *label == VOID && *bit {
                *label = REST;
            }
        }
        let mut map = RegionMap {
            size: self.size,
            labels,
        };
        if coarser > 0 {
            map.merge_small_parts(1 << coarser.min(26));
        }
        map
    }

    /// The number of pixels below which [`Self::laid`] leaves parts out of the region with the largest number.
    pub(crate) fn least(&self, coarser: u32) -> u32 {
        let largest = self.least.iter().copied().max().unwrap_or(1).max(1);
        u32::try_from(largest << coarser.min(26)).unwrap_or(u32::MAX)
    }
}

fn lay(labels: &mut [u8], mask: &Mask, label: u8) {
    for (at, bit) in labels.iter_mut().zip(&mask.bits) {
        if *bit {
            *at = label;
        }
    }
}

/// Leaves out parts and holes below `least` (from 1), doubled so often.
fn drop_small(mask: &mut Mask, least: usize, coarser: u32) {
    if coarser > 0 {
        let least = least.max(1) << coarser.min(26);
        mask.drop_small_parts(least);
        mask.fill_holes(least);
    }
}

/// The pixels that a region's source takes.
fn taken(
    canvas: &Canvas<'_>,
    region: &Region,
    colors: &[[u8; 3]],
    notices: &mut Vec<Notice>,
) -> Mask {
    let mut mask = Mask::none(canvas.plane.map.map(|side| side as usize));
    match &region.from {
        Some(Source::Flood(source)) if canvas.picture.is_some() => {
            mask = flood(colors, &canvas.plane, source)
        }
        Some(Source::Flood(_)) => notices.push(Notice::FloodWithoutPixels {
            name: region.name.clone(),
        }),
        Some(Source::Polygon(polygon)) => {
            if crosses_itself(polygon) {
                notices.push(Notice::SelfCrossing {
                    name: region.name.clone(),
                });
            }
            let line = polygon
                .iter()
                .map(|at| canvas.plane.map_from_figure(*at))
                .collect();
            let fill = Fill {
                lines: vec![line],
                is_even_odd: false,
            };
            add_filled(&mut mask, &fill);
        }
        Some(Source::Path(path)) => match (canvas.shapes)(path) {
            Some(fills) => fills.iter().for_each(|fill| add_filled(&mut mask, fill)),
            None => notices.push(Notice::UnknownPath {
                name: region.name.clone(),
            }),
        },
        None => {}
    }
    mask
}
