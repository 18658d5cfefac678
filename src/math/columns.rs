//! Texts in two columns beside a picture.

use glam::Vec2;

/// Captions stay within this part of the picture's height to either side of its middle.
const BROADEST: f32 = 0.85;

/// In longer columns one does not look for an order in which texts stay as high as their points: that takes the fourth
/// power of their number.
const MOST_SEARCHED: usize = 24;

/// Top left corners for texts of these sizes: each in a column at the side of the area that is nearer to its point,
/// none over another, and in an order in which lines do not cross, as a rule that of the points. Texts are as high as
/// their points where there is room, and stand at equal distances where lines would cross otherwise. If a column has
/// no room for that, some of its lines cross. `area` is its top left and its bottom right corner; y points down. All
/// lengths are of one unit, such as pixels.
pub fn arranged(points: &[Vec2], sizes: &[Vec2], gap: f32, area: [Vec2; 2]) -> Vec<Vec2> {
    // In a very wide picture the object fills the middle, and lines across all the rest would be long.
    let [min, max] = area;
    let half = (0.5 * (max.x - min.x)).min(BROADEST * (max.y - min.y));
    let middle = 0.5 * (min.x + max.x);
    let mut places = vec![Vec2::ZERO; points.len()];
    for is_left in [true, false] {
        let texts = (0..points.len()).filter(|&i| (points[i].x < middle) == is_left);
        let mut column = Column {
            points,
            sizes,
            gap,
            span: [min.y, max.y],
            edge: if is_left {
                middle - half
            } else {
                middle + half
            },
            is_left,
            order: texts.collect(),
        };
        column
            .order
            .sort_by(|&a, &b| points[a].y.total_cmp(&points[b].y));
        column.place(&mut places);
    }
    places
}

/// Texts below each other.
struct Column<'a> {
    points: &'a [Vec2],
    sizes: &'a [Vec2],
    gap: f32,
    /// Its upper and its lower end.
    span: [f32; 2],
    /// Its outer side.
    edge: f32,
    is_left: bool,
    /// Indices of its texts from the top.
    order: Vec<usize>,
}

impl Column<'_> {
    fn place(&mut self, places: &mut [Vec2]) {
        let mut tops = self.stacked();
        let mut worth = self.worth(&tops);
        // Texts that were pushed aside may have lines that cross. Two texts that change places end some crossings and
        // seldom begin others; an exchange stays if there are fewer afterwards, or as many and the lines are shorter.
        let mut is_better = self.order.len() <= MOST_SEARCHED;
        while worth.0 > 0 && is_better {
            is_better = false;
            for (j, k) in pairs(self.order.len()) {
                self.order.swap(j, k);
                let other_tops = self.stacked();
                let other = self.worth(&other_tops);
                if other < worth {
                    (worth, tops, is_better) = (other, other_tops, true);
                } else {
                    self.order.swap(j, k);
                }
            }
        }
        // In equal places with their inner sides below each other there is always an order without crossings.
        let inner = match worth.0 {
            0 => None,
            _ => self.equal_places(),
        };
        if let Some((_, equal)) = &inner {
            tops.clone_from(equal);
        }
        for (&i, top) in self.order.iter().zip(tops) {
            let width = self.sizes[i].x;
            let left = match (&inner, self.is_left) {
                (Some((inner, _)), true) => inner - width,
                (Some((inner, _)), false) => *inner,
                (None, true) => self.edge,
                (None, false) => self.edge - width,
            };
            places[i] = Vec2::new(left, top);
        }
    }

    /// Upper edges of the texts in their order, none over another, each as high as its point where there is room.
    fn stacked(&self) -> Vec<f32> {
        let [mut next, mut floor] = self.span;
        let mut tops = Vec::with_capacity(self.order.len());
        for &i in &self.order {
            let height = self.sizes[i].y;
            let top = (self.points[i].y - 0.5 * height).max(next);
            tops.push(top);
            next = top + height + self.gap;
        }
        // A text that would hang out below moves up, and moves the texts above that are in its way.
        for (&i, top) in self.order.iter().zip(&mut tops).rev() {
            *top = top.min(floor - self.sizes[i].y);
            floor = *top - self.gap;
        }
        tops
    }

    /// How many lines cross, and how long all of them are together.
    fn worth(&self, tops: &[f32]) -> (usize, f32) {
        let lines = self.order.iter().zip(tops).map(|(&i, top)| {
            let size = self.sizes[i];
            let inner = match self.is_left {
                true => self.edge + size.x,
                false => self.edge - size.x,
            };
            [Vec2::new(inner, top + 0.5 * size.y), self.points[i]]
        });
        let lines: Vec<[Vec2; 2]> = lines.collect();
        let crossings = pairs(lines.len()).filter(|&(j, k)| cross(lines[j], lines[k]));
        let length = lines.iter().map(|[start, end]| start.distance(*end)).sum();
        (crossings.count(), length)
    }

    /// Puts the texts into an order in which no lines cross if they stand at equal distances and end on one line.
    /// Returns where that is, and their upper edges; None if there is no room.
    fn equal_places(&mut self) -> Option<(f32, Vec<f32>)> {
        let sizes = || self.order.iter().map(|&i| self.sizes[i]);
        let most = sizes().fold(Vec2::ZERO, Vec2::max);
        let pitch = most.y + self.gap;
        let [top, bottom] = self.span;
        let height = pitch * self.order.len() as f32 - self.gap;
        if height > bottom - top {
            return None;
        }
        let heights = self.order.iter().map(|&i| self.points[i].y);
        let mean = heights.sum::<f32>() / self.order.len() as f32;
        let first = (mean - 0.5 * height).clamp(top, bottom - height) + 0.5 * most.y;
        let inner = match self.is_left {
            true => self.edge + most.x,
            false => self.edge - most.x,
        };
        let start = |place: usize| Vec2::new(inner, first + pitch * place as f32);
        // Of two lines that cross, the sum of the lengths gets shorter if their ends change places.
        let length = |place: usize, i: usize| start(place).distance(self.points[i]);
        let mut is_better = true;
        while is_better {
            is_better = false;
            for (j, k) in pairs(self.order.len()) {
                let (a, b) = (self.order[j], self.order[k]);
                if length(j, b) + length(k, a) < length(j, a) + length(k, b) - 1e-4 * pitch {
                    self.order.swap(j, k);
                    is_better = true;
                }
            }
        }
        let places = self.order.iter().enumerate();
        let tops = places.map(|(place, &i)| start(place).y - 0.5 * self.sizes[i].y);
        Some((inner, tops.collect()))
    }
}

/// Every two of so many things.
fn pairs(count: usize) -> impl Iterator<Item = (usize, usize)> {
    (1..count).flat_map(|k| (0..k).map(move |j| (j, k)))
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

    /// In random plates of up to `most` captions whose points lie within this height: pairs of lines that cross, pairs
    /// of texts that lie over each other, and texts that hang out.
    fn faults(most: usize, [top, bottom]: [f32; 2]) -> [usize; 3] {
        let mut seed = 7_u32;
        let mut random = |below: f32| {
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            below * (seed >> 8) as f32 / (1 << 24) as f32
        };
        let area = [vec2(5.0, 5.0), vec2(395.0, 395.0)];
        let mut found = [0; 3];
        for round in 0..200 {
            let count = 2 + round % (most - 1);
            let points: Vec<Vec2> = (0..count)
                .map(|_| vec2(100.0 + random(200.0), top + random(bottom - top)))
                .collect();
            let sizes: Vec<Vec2> = (0..count)
                .map(|_| vec2(30.0 + random(40.0), 12.0 + random(4.0)))
                .collect();
            let places = arranged(&points, &sizes, 4.0, area);
            let line = |i: usize| {
                let is_left = points[i].x < 200.0;
                let start = places[i].x + if is_left { sizes[i].x } else { 0.0 };
                [vec2(start, places[i].y + 0.5 * sizes[i].y), points[i]]
            };
            for (j, k) in pairs(count) {
                let ends = [places[j] + sizes[j], places[k] + sizes[k]];
                let is_over = places[j].cmplt(ends[1]).all() && places[k].cmplt(ends[0]).all();
                found[0] += usize::from(cross(line(j), line(k)));
                found[1] += usize::from(is_over);
            }
            let is_out = |i: &usize| {
                let (start, end) = (places[*i], places[*i] + sizes[*i]);
                let is_in = start.cmpge(area[0] - 1e-3) & end.cmple(area[1] + 1e-3);
                !is_in.all()
            };
            found[2] += (0..count).filter(is_out).count();
        }
        found
    }

    #[test]
    fn lines_do_not_cross() {
        for (most, within) in [
            (15, [300.0, 395.0]),
            (20, [170.0, 230.0]),
            (24, [5.0, 395.0]),
        ] {
            assert_eq!(faults(most, within), [0, 0, 0], "up to {most}");
        }
        // Where there is no room at equal distances, they still lie beside each other.
        let [crossed, over, out] = faults(44, [5.0, 60.0]);
        assert!(crossed > 0 && out > 0, "there is no room for all of them");
        assert_eq!(over, 0);
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
