//! Texts in two columns beside a picture.

use glam::Vec2;

/// Captions stay within this part of the picture's height to either side of its middle.
const BROADEST: f32 = 0.85;

/// In longer columns lines are left to cross: texts are as high as their points there, or there is no room for any
/// order.
const MOST_UNCROSSED: usize = 24;

/// Top left corners for texts of these sizes: each in a column at the side of the area that is nearer to its point,
/// as high as the point where there is room, none over another, and in an order in which lines do not cross, as a
/// rule that of the points. `area` is its top left and its bottom right corner; y points down. All lengths are of one
/// unit, such as pixels.
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
        let left = |i: usize| match is_left {
            true => middle - half,
            false => middle + half - sizes[i].x,
        };
        let line = |i: usize, top: f32| {
            let start = if is_left {
                left(i) + sizes[i].x
            } else {
                left(i)
            };
            [Vec2::new(start, top + 0.5 * sizes[i].y), points[i]]
        };
        let mut tops = stacked(&column, points, sizes, gap, [min.y, max.y]);
        // Texts that were pushed aside may have lines that cross. Two texts that change places end some crossings and
        // seldom begin others; an exchange stays if there are fewer afterwards.
        let crossings = |column: &[usize], tops: &[f32]| {
            let lines = column.iter().zip(tops).map(|(&i, &top)| line(i, top));
            let lines: Vec<_> = lines.collect();
            let pairs = (1..lines.len()).flat_map(|k| (0..k).map(move |j| (j, k)));
            pairs.filter(|&(j, k)| cross(lines[j], lines[k])).count()
        };
        let mut count = crossings(&column, &tops);
        let mut is_better = column.len() <= MOST_UNCROSSED;
        while count > 0 && is_better {
            is_better = false;
            for (j, k) in (1..column.len()).flat_map(|k| (0..k).map(move |j| (j, k))) {
                column.swap(j, k);
                let other_tops = stacked(&column, points, sizes, gap, [min.y, max.y]);
                let other = crossings(&column, &other_tops);
                if other < count {
                    (count, tops, is_better) = (other, other_tops, true);
                } else {
                    column.swap(j, k);
                }
            }
        }
        for (&i, top) in column.iter().zip(tops) {
            places[i] = Vec2::new(left(i), top);
        }
    }
    places
}

/// Upper edges of the texts of a column in their order, none over another, each as high as its point where there is
/// room between `[top, bottom]`.
fn stacked(
    column: &[usize],
    points: &[Vec2],
    sizes: &[Vec2],
    gap: f32,
    [top, bottom]: [f32; 2],
) -> Vec<f32> {
    let mut next = top;
    let mut tops = Vec::with_capacity(column.len());
    for &i in column {
        let top = (points[i].y - 0.5 * sizes[i].y).max(next);
        tops.push(top);
        next = top + sizes[i].y + gap;
    }
    // A text that would hang out below moves up, and moves the texts above that are in its way.
    let mut floor = bottom;
    for (&i, top) in column.iter().zip(&mut tops).rev() {
        *top = top.min(floor - sizes[i].y);
        floor = *top - gap;
    }
    tops
}

/// True if two segments cross in their insides.
fn cross([a, b]: [Vec2; 2], [c, d]: [Vec2; 2]) -> bool {
    let side = |from: Vec2, to: Vec2, p: Vec2| (to - from).perp_dot(p - from);
    side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::vec2;

    #[test]
    fn lines_hardly_ever_cross() {
        let mut seed = 7_u32;
        let mut random = |below: f32| {
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            below * (seed >> 8) as f32 / (1 << 24) as f32
        };
        let area = [vec2(5.0, 5.0), vec2(395.0, 295.0)];
        let (mut crossed, mut pairs) = (0, 0);
        for round in 0..200 {
            let count = 2 + round % 14;
            let points: Vec<Vec2> = (0..count)
                .map(|_| vec2(100.0 + random(200.0), 200.0 + random(95.0)))
                .collect();
            let sizes: Vec<Vec2> = (0..count)
                .map(|_| vec2(30.0 + random(40.0), 16.0))
                .collect();
            let places = arranged(&points, &sizes, 4.0, area);
            let line = |i: usize| {
                let is_left = points[i].x < 200.0;
                let start = places[i].x + if is_left { sizes[i].x } else { 0.0 };
                [vec2(start, places[i].y + 0.5 * sizes[i].y), points[i]]
            };
            for i in 0..count {
                for j in 0..i {
                    pairs += 1;
                    crossed += usize::from(cross(line(i), line(j)));
                }
            }
        }
        // Texts in the order of their points alone have 184 of these 7860 pairs of lines cross.
        assert!(crossed * 300 < pairs, "{crossed} of {pairs} pairs cross");
    }

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
