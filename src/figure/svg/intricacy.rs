use glam::DVec2;

use super::error::SvgError;
use super::limits::DRAWN_SIDE;
use super::paint::Look;
use super::path::{Curve, Outline, Piece, TOLERANCE};
use crate::figure::plane::Plane;

/// What drawing takes at most: a few seconds for each, in the page too.
const MOST: Work = Work {
    area: 2e9,
    rows: 3e7,
    pieces: 1e7,
    dashes: 1e6,
};

/// What drawing takes.
#[derive(Clone, Copy, Debug, Default)]
struct Work {
    /// Pixels that are painted, each as often as it is, in a picture of the usual size.
    area: f64,
    /// Rows of the map that outlines cross.
    rows: f64,
    /// Straight pieces that curves are divided into.
    pieces: f64,
    /// Dashes of lines.
    dashes: f64,
}

/// Refuses a drawing of this size that would keep the painter, or whoever looks for regions, busy for minutes: a
/// hundred thousand shapes as large as the page, or lines of millions of dashes.
pub(super) fn check<'a>(
    size: DVec2,
    shapes: impl Iterator<Item = (&'a Outline, &'a Look)>,
) -> Result<(), SvgError> {
    let plane = Plane::of_drawing(size);
    let mut work = Work::default();
    for (outline, look) in shapes {
        work.add(outline, look, &plane);
        // Also where a number is none.
        let is_little = work.area <= MOST.area
            && work.rows <= MOST.rows
            && work.pieces <= MOST.pieces
            && work.dashes <= MOST.dashes;
        if !is_little {
            return Err(SvgError::Intricate);
        }
    }
    Ok(())
}

impl Work {
    fn add(&mut self, outline: &Outline, look: &Look, plane: &Plane) {
        let map = plane.map_size();
        let scale = map / plane.source;
        let pieces = outline.mapped(|at| at * scale).pieces();
        let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        let points = |piece: &Piece| match piece.curve {
            Curve::Move => [piece.to; 4],
            Curve::Line | Curve::Close => [piece.from, piece.from, piece.to, piece.to],
            Curve::Quadratic(control) => [piece.from, control, control, piece.to],
            Curve::Cubic(one, other) => [piece.from, one, other, piece.to],
        };
        for point in pieces.iter().flat_map(points) {
            low = low.min(point);
            high = high.max(point);
        }
        let is_inside = low.min_element() >= 0.0 && high.cmple(map).all();
        let box_size = (high.min(map) - low.max(DVec2::ZERO)).max(DVec2::ZERO);
        // The triangles from a point to all pieces cover whatever is filled.
        let middle = (low + high) / 2.0;
        let (mut fan, mut length, mut seen_length, mut rows) = (0.0, 0.0, 0.0, 0.0);
        for piece in &pieces {
            self.pieces += f64::from(piece.count(TOLERANCE));
            let on_map = |at: DVec2| at.clamp(DVec2::ZERO, map);
            for ends in points(piece).windows(2) {
                let (from, to) = (ends[0], ends[1]);
                fan += (from - middle).perp_dot(to - middle).abs() / 2.0;
                length += from.distance(to);
                seen_length += on_map(from).distance(on_map(to));
                rows += (on_map(from).y - on_map(to).y).abs();
            }
            rows += 1.0;
        }
        let finer = (f64::from(DRAWN_SIDE) / map.max_element()).powi(2);
        if look.fill.is_some() {
            let of_box = box_size.x * box_size.y;
            self.area += finer * if is_inside { of_box.min(fan) } else { of_box };
            self.rows += rows;
        }
        if let Some(stroke) = &look.stroke {
            let width = (stroke.width * scale.max_element()).min(map.max_element());
            let count = pieces.len() as f64;
            let around = (seen_length + count) * (width + 1.0);
            self.area += finer * around.min(map.x * map.y);
            self.rows += 2.0 * (rows + count * width);
            let period: f64 = stroke.dashes.iter().sum::<f64>() * scale.max_element();
            if period > 0.0 {
                self.dashes += length / period * stroke.dashes.len() as f64;
            }
        }
    }
}
