//! Rigidity as hatching: the closer the strokes, the stiffer the tissue. Strokes lie along the axis that is stiff; what
//! is rigid is hatched both ways. They are fastened to the tissue.

use egui::{Color32, Painter, Pos2, Stroke};
use glam::Vec2;

use crate::app::session::Session;
use crate::data::Sheet;
use crate::document::figure::Rigidity;

/// Between strokes where rigidity is 1, subject units.
const WIDEST: f32 = 0.05;
/// Between strokes of what is rigid, and at least.
const CLOSEST: f32 = 0.008;
const INK: Color32 = Color32::from_rgba_premultiplied(20, 40, 110, 170);

/// The directions of a region's strokes, and the distance between them.
fn strokes(rigidity: Rigidity) -> Vec<(Vec2, f32)> {
    let spacing = |k: f64| (WIDEST / k.max(0.5) as f32).max(CLOSEST);
    match rigidity {
        Rigidity::Rigid => vec![(Vec2::ONE, CLOSEST), (Vec2::new(1.0, -1.0), CLOSEST)],
        Rigidity::Elastic([x, y]) if x > y => vec![(Vec2::X, spacing(x))],
        Rigidity::Elastic([x, y]) if x < y => vec![(Vec2::Y, spacing(y))],
        Rigidity::Elastic([k, _]) => vec![(Vec2::ONE, spacing(k))],
    }
}

/// Hatches all regions but soft ones.
pub(super) fn paint(
    painter: &Painter,
    sheet: &Sheet,
    session: &Session,
    spot: &impl Fn(u32) -> Option<Pos2>,
) {
    let named = |name: &String| session.view.figure.region_named(name);
    let of_regions: Vec<Vec<(Vec2, f32)>> = (sheet.mesh.regions.iter())
        .map(|name| {
            let rigidity = named(name).map_or(Rigidity::SOFT, |region| region.rigidity);
            match rigidity == Rigidity::SOFT {
                true => Vec::new(),
                false => strokes(rigidity),
            }
        })
        .collect();
    let stroke = Stroke::new(0.9, INK);
    for (corners, region) in sheet.mesh.triangles.iter().zip(&sheet.mesh.region_of) {
        let [Some(a), Some(b), Some(c)] = corners.map(spot) else {
            continue;
        };
        let rest = corners.map(|vertex| sheet.mesh.rest[vertex as usize]);
        for (direction, spacing) in &of_regions[usize::from(*region)] {
            for piece in across(rest, [a, b, c], *direction, *spacing) {
                painter.line_segment(piece, stroke);
            }
        }
    }
}

/// The strokes over a triangle, as they are seen.
fn across(rest: [Vec2; 3], seen: [Pos2; 3], direction: Vec2, spacing: f32) -> Vec<[Pos2; 2]> {
    let level = rest.map(|at| direction.normalize_or(Vec2::X).perp_dot(at) / spacing);
    let lowest = level.into_iter().fold(f32::INFINITY, f32::min).ceil();
    let highest = level.into_iter().fold(f32::NEG_INFINITY, f32::max);
    let mut pieces = Vec::new();
    let mut at = lowest;
    // A triangle as large as the picture has no more strokes than that.
    while at <= highest && pieces.len() < 200 {
        let crossing = |i: usize| {
            let (from, to) = (level[i], level[(i + 1) % 3]);
            let part = (at - from) / (to - from);
            let is_crossed = (from - at) * (to - at) <= 0.0 && from != to;
            is_crossed.then(|| seen[i] + (seen[(i + 1) % 3] - seen[i]) * part)
        };
        let met: Vec<Pos2> = (0..3).filter_map(crossing).collect();
        if let [first, .., last] = met[..] {
            pieces.push([first, last]);
        }
        at += 1.0;
    }
    pieces
}
