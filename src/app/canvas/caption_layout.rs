//! How captions are laid out beside a picture, on the screen and in files.

use egui::{Color32, Pos2, Rect, Vec2, vec2};
use glam::Vec3;

use crate::document::Background;

/// Captions stay within this part of the picture's height to either side of its middle.
const BROADEST: f32 = 0.85;
/// Rows that a text has at most.
pub(crate) const ROWS: usize = 4;

/// Where the tissue of a caption is, subject space, and whether something lies before it. `None`: it is cut away.
pub type CaptionPlace = Option<(Vec3, bool)>;

/// True if letters on a background have to be light.
pub(crate) fn is_dark(background: Background) -> bool {
    match background {
        Background::Color([r, g, b]) => Color32::from_rgb(r, g, b).intensity() < 0.45,
        Background::None => false,
    }
}

/// Where a caption's line begins: in the middle of the side that faces its tissue.
pub(crate) fn line_start(text: Rect, at: Pos2, gap: f32) -> Pos2 {
    if text.center().x < at.x {
        text.right_center() + vec2(gap, 0.0)
    } else {
        text.left_center() - vec2(gap, 0.0)
    }
}

/// Places for texts of these sizes: each in a column at the side of the area that is nearer to its point, as high as
/// the point where there is room, none over another, and in the order of the points, so that no lines cross within a
/// column.
pub(crate) fn arranged(points: &[Pos2], sizes: &[Vec2], gap: f32, area: Rect) -> Vec<Rect> {
    // In a very wide picture the object fills the middle, and lines across all the rest would be long.
    let half = (0.5 * area.width()).min(BROADEST * area.height());
    let middle = area.center().x;
    let area = area.with_min_x(middle - half).with_max_x(middle + half);
    let mut places = vec![Rect::NOTHING; points.len()];
    for is_left in [true, false] {
        let mut column: Vec<usize> = (0..points.len())
            .filter(|&i| (points[i].x < area.center().x) == is_left)
            .collect();
        column.sort_by(|&a, &b| points[a].y.total_cmp(&points[b].y));
        let mut next = area.top();
        let mut tops = Vec::with_capacity(column.len());
        for &i in &column {
            let top = (points[i].y - 0.5 * sizes[i].y).max(next);
            tops.push(top);
            next = top + sizes[i].y + gap;
        }
        // A text that would hang out below moves up, and moves the texts above that are in its way.
        let mut floor = area.bottom();
        for (&i, top) in column.iter().zip(&mut tops).rev() {
            *top = top.min(floor - sizes[i].y);
            floor = *top - gap;
        }
        for (&i, top) in column.iter().zip(tops) {
            let left = if is_left {
                area.left()
            } else {
                area.right() - sizes[i].x
            };
            places[i] = Rect::from_min_size(Pos2::new(left, top), sizes[i]);
        }
    }
    places
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_stand_beside_each_other() {
        let area = Rect::from_min_size(Pos2::new(10.0, 20.0), vec2(400.0, 300.0));
        let points: Vec<Pos2> = (0..14)
            .map(|i| Pos2::new(if i % 3 == 0 { 100.0 } else { 300.0 }, 280.0 - i as f32))
            .collect();
        let sizes: Vec<Vec2> = (0..14).map(|i| vec2(60.0 + i as f32, 16.0)).collect();
        let places = arranged(&points, &sizes, 5.0, area);
        for (i, a) in places.iter().enumerate() {
            assert!(area.contains_rect(*a), "{i}: {a:?}");
            assert_eq!(a.size(), sizes[i]);
            let overlaps = places[i + 1..].iter().filter(|b| a.intersects(**b));
            assert_eq!(overlaps.count(), 0, "{i}");
            for (j, b) in places
                .iter()
                .enumerate()
                .filter(|(j, _)| i % 3 == 0 && j % 3 == 0)
            {
                assert_eq!(a.top() < b.top(), points[i].y < points[j].y, "lines cross");
            }
        }
        // Alone, a text is as high as its point.
        let alone = arranged(&points[..1], &sizes[..1], 5.0, area);
        assert!((alone[0].center().y - points[0].y).abs() < 1e-3);
        assert!(arranged(&[], &[], 5.0, area).is_empty());
        // In a wide picture they stay with the object.
        let wide = Rect::from_min_size(Pos2::ZERO, vec2(4000.0, 300.0));
        let points = [Pos2::new(1900.0, 100.0), Pos2::new(2100.0, 100.0)];
        let places = arranged(&points, &sizes[..2], 5.0, wide);
        assert!(
            places[0].left() > 1700.0 && places[1].right() < 2300.0,
            "{places:?}"
        );
    }
}
