//! Texts in two columns beside a picture.

use glam::Vec2;

/// Captions stay within this part of the picture's height to either side of its middle.
const BROADEST: f32 = 0.85;

/// Top left corners for texts of these sizes: each in a column at the side of the area that is nearer to its point, as
/// high as the point where there is room, none over another, and in the order of the points, so that no lines cross
/// within a column. `area` is its top left and its bottom right corner; y points down. All lengths are of one unit, such
/// as pixels.
pub fn arranged(points: &[Vec2], sizes: &[Vec2], gap: f32, area: [Vec2; 2]) -> Vec<Vec2> {
    // In a very wide picture the object fills the middle, and lines across all the rest would be long.
    let [min, max] = area;
    let half = (0.5 * (max.x - min.x)).min(BROADEST * (max.y - min.y));
    let middle = 0.5 * (min.x + max.x);
    let mut places = vec![Vec2::ZERO; points.len()];
    for is_left in [true, false] {
        let mut column: Vec<usize> = (0..points.len())
            .filter(|&i| (points[i].x < middle) == is_left)
            .collect();
        column.sort_by(|&a, &b| points[a].y.total_cmp(&points[b].y));
        let mut next = min.y;
        let mut tops = Vec::with_capacity(column.len());
        for &i in &column {
            let top = (points[i].y - 0.5 * sizes[i].y).max(next);
            tops.push(top);
            next = top + sizes[i].y + gap;
        }
        // A text that would hang out below moves up, and moves the texts above that are in its way.
        let mut floor = max.y;
        for (&i, top) in column.iter().zip(&mut tops).rev() {
            *top = top.min(floor - sizes[i].y);
            floor = *top - gap;
        }
        for (&i, top) in column.iter().zip(tops) {
            let left = if is_left {
                middle - half
            } else {
                middle + half - sizes[i].x
            };
            places[i] = Vec2::new(left, top);
        }
    }
    places
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::vec2;

    #[test]
    fn texts_stand_beside_each_other() {
        let area = [vec2(10.0, 20.0), vec2(410.0, 320.0)];
        let points: Vec<Vec2> = (0..14)
            .map(|i| vec2(if i % 3 == 0 { 100.0 } else { 300.0 }, 280.0 - i as f32))
            .collect();
        let sizes: Vec<Vec2> = (0..14).map(|i| vec2(60.0 + i as f32, 16.0)).collect();
        let places = arranged(&points, &sizes, 5.0, area);
        for (i, &a) in places.iter().enumerate() {
            let end = a + sizes[i];
            assert!(
                a.cmpge(area[0]).all() && end.cmple(area[1]).all(),
                "{i}: {a}"
            );
            for (j, &b) in places.iter().enumerate().filter(|&(j, _)| j != i) {
                let is_apart = end.cmplt(b).any() || (b + sizes[j]).cmplt(a).any();
                assert!(is_apart, "{i} and {j} overlap");
                if i % 3 == 0 && j % 3 == 0 {
                    assert_eq!(a.y < b.y, points[i].y < points[j].y, "lines cross");
                }
            }
        }
        // Alone, a text is as high as its point.
        let alone = arranged(&points[..1], &sizes[..1], 5.0, area);
        assert!((alone[0].y + 0.5 * sizes[0].y - points[0].y).abs() < 1e-3);
        assert!(arranged(&[], &[], 5.0, area).is_empty());
        // In a wide picture they stay with the object.
        let wide = [Vec2::ZERO, vec2(4000.0, 300.0)];
        let points = [vec2(1900.0, 100.0), vec2(2100.0, 100.0)];
        let places = arranged(&points, &sizes[..2], 5.0, wide);
        let right = places[1].x + sizes[1].x;
        assert!(places[0].x > 1700.0 && right < 2300.0, "{places:?}");
    }
}
