//! Lines of straight pieces in a plane.

use glam::{DVec2, Vec2};

/// The places of a line without those that lie within `tolerance` of the straight way between the others (Douglas and
/// Peucker, 1973).
pub fn simplified(points: &[Vec2], tolerance: f32) -> Vec<Vec2> {
    simplified_by(points, tolerance, away_from)
}

/// The same for places of any kind; `away` is the distance of a place from the straight way between two others.
pub fn simplified_by<P: Copy>(
    points: &[P],
    tolerance: f32,
    away: impl Fn(P, P, P) -> f32,
) -> Vec<P> {
    let mut is_kept = vec![false; points.len()];
    let mut spans = vec![(0, points.len().saturating_sub(1))];
    while let Some((from, to)) = spans.pop() {
        for end in [from, to] {
            if let Some(is_kept) = is_kept.get_mut(end) {
                *is_kept = true;
            }
        }
        let away = |i: usize| away(points[i], points[from], points[to]);
        let farthest = (from + 1..to).map(|i| (away(i), i));
        let farthest = farthest.max_by(|a, b| a.0.total_cmp(&b.0));
        if let Some((_, at)) = farthest.filter(|(away, _)| *away > tolerance) {
            spans.extend([(from, at), (at, to)]);
        }
    }
    let pairs = points.iter().zip(is_kept);
    pairs
        .filter(|(_, is_kept)| *is_kept)
        .map(|(p, _)| *p)
        .collect()
}

/// The distance of a place from the straight way between two others.
fn away_from(pos: Vec2, from: Vec2, to: Vec2) -> f32 {
    let way = to - from;
    let t = (pos - from).dot(way) / way.length_squared().max(1e-12);
    pos.distance(from + way * t.clamp(0.0, 1.0))
}

/// How often a closed polygon goes around a place, counter-clockwise where y is up.
pub fn winding(polygon: impl Iterator<Item = DVec2> + Clone, at: DVec2) -> i32 {
    let ends = polygon.clone().zip(polygon.cycle().skip(1));
    let turn = |(a, b): (DVec2, DVec2)| {
        let side = (b - a).perp_dot(at - a);
        match (a.y <= at.y, b.y <= at.y) {
            (true, false) if side > 0.0 => 1,
            (false, true) if side < 0.0 => -1,
            _ => 0,
        }
    };
    ends.map(turn).sum()
}
