//! What hand and knee are painted alike: skin over fat, muscles that stay apart, bone with a spongy inside, cords and
//! vessels.

use super::lanes::Lanes;
use super::paint::{Block, Canvas, border_width};
use super::shape::{Field, Near, Places};

/// The part of a field that matters in a block, for distances up to `band` mm beyond the border's width.
pub(super) fn near<'a>(field: &'a Field, block: &Block, band: f32) -> Near<'a> {
    let mut near = Near::default();
    field.near(block, band + border_width(block.spacing), &mut near);
    near
}

/// How wide borders inside the skin are drawn, mm.
pub(super) fn inner_width(block: &Block) -> f32 {
    0.55 * border_width(block.spacing)
}

/// Lays skin `thickness` mm thick and the fat under it; `skin` is the distance from the outside.
#[inline(always)]
pub(super) fn lay_skin(
    out: &mut Canvas,
    row: usize,
    block: &Block,
    skin: Lanes,
    thickness: f32,
    [skin_label, fat_label]: [u8; 2],
) {
    let (width, flat) = (border_width(block.spacing), Lanes::splat);
    out.lay(
        row,
        skin - 0.5 * block.spacing,
        width,
        flat(30.0),
        skin_label,
    );
    let thickness = thickness.max(0.9 * block.spacing);
    out.lay(
        row,
        skin + thickness,
        inner_width(block),
        flat(-100.0),
        fat_label,
    );
}

/// Distance from muscles `grow` mm larger than their shapes, parted by `gap` mm where they meet, from those of the two
/// nearest.
#[inline(always)]
pub(super) fn parted((first, second): (Lanes, Lanes), grow: f32, gap: f32) -> Lanes {
    (first - grow).max(Lanes::splat(gap) - (second - first))
}

/// Lays bone: a compact wall, `compact` mm thick, about an inside of the values `inside`.
#[inline(always)]
pub(super) fn lay_bone(
    out: &mut Canvas,
    row: usize,
    block: &Block,
    bone: Lanes,
    compact: Lanes,
    [wall, inside]: [Lanes; 2],
    label: u8,
) {
    let spongy = ((-bone - compact) * 0.8).clamp(0.0, 1.0);
    out.lay(
        row,
        bone,
        border_width(block.spacing),
        wall.mix(inside, spongy),
        label,
    );
}

/// Tendons, ligaments, vessels, nerves: what runs under the skin with one value.
pub(super) struct Cord<'a> {
    field: Near<'a>,
    value: f32,
    label: u8,
    /// How far under the skin it stays, mm.
    depth: f32,
}

impl<'a> Cord<'a> {
    /// The part of a cord that matters in a block. Its tubes are at least `least` mm thick, which is 0 or more.
    pub(super) fn new(
        field: &'a Field,
        (block, least): (&Block, f32),
        value: f32,
        label: u8,
        depth: f32,
    ) -> Self {
        let band = 1.0 + border_width(block.spacing);
        let mut near = Near::default();
        field.near_thick(block, band, least, &mut near);
        Self {
            field: near,
            value,
            label,
            depth,
        }
    }

    /// Lays it; `skin` is the distance from the outside.
    #[inline(always)]
    pub(super) fn lay(&self, out: &mut Canvas, row: usize, block: &Block, p: &Places, skin: Lanes) {
        if !self.field.is_empty() {
            let d = self.field.distance(p).max(skin + self.depth);
            out.lay(
                row,
                d,
                inner_width(block),
                Lanes::splat(self.value),
                self.label,
            );
        }
    }
}
