//! The lines between the areas of a grid, for drawings that are made of lines.

use glam::Vec2;

use super::polyline::simplified;

/// A line and the areas beside it keep this distance at most when corners are taken away, cells: below what one sees.
const TOLERANCE: f32 = 0.5;
/// Areas of fewer cells are specks: they count as what lies beside most of them.
const LEAST_CELLS: usize = 40;
/// Specks amid specks are gone after so many times.
const ROUNDS: usize = 3;

/// A line between areas.
#[derive(Clone, Debug, PartialEq)]
pub struct BorderLine {
    /// Its places, cells from the grid's top left corner.
    pub points: Vec<Vec2>,
    /// The last is followed by the first.
    pub is_closed: bool,
}

/// The borders between cells that differ, in a grid of `size` (columns, rows), row by row from the top. Each border is
/// told once; lines end where three areas meet, and at the edge of the grid, which is no border itself. Stairs of cells
/// become slopes: a line lies within half a cell of the sides of cells, and its corners within half a cell of that.
/// Specks are left out.
pub fn borders<T: PartialEq + Copy>(cells: &[T], size: [u32; 2]) -> Vec<BorderLine> {
    let [width, height] = size.map(|side| side as usize);
    if width == 0 || height == 0 || cells.len() < width * height {
        return Vec::new();
    }
    let mut cells = cells.to_vec();
    for _ in 0..ROUNDS {
        if !take_specks(&mut cells, [width, height]) {
            break;
        }
    }
    let mut sides = Sides::of(&cells, [width, height]);
    let mut lines = Vec::new();
    // Lines first that begin where they must end; what is left are rings.
    for is_ring in [false, true] {
        for corner in 0..sides.ways.len() {
            while sides.ways[corner] != 0 && (is_ring || sides.is_end[corner]) {
                let corners = sides.take_line(corner);
                let places: Vec<Vec2> = corners.iter().map(|&at| sides.place(at)).collect();
                lines.push(BorderLine {
                    points: smoothed(&places, is_ring),
                    is_closed: is_ring,
                });
            }
        }
    }
    lines
}

/// Gives specks to their neighbours. False if there are none.
fn take_specks<T: PartialEq + Copy>(cells: &mut [T], [width, height]: [usize; 2]) -> bool {
    let beside = |at: usize| {
        let (x, y) = (at % width, at / width);
        let sides = [
            (x > 0, at.wrapping_sub(1)),
            (x + 1 < width, at + 1),
            (y > 0, at.wrapping_sub(width)),
            (y + 1 < height, at + width),
        ];
        sides
            .into_iter()
            .filter(|(is_there, _)| *is_there)
            .map(|(_, at)| at)
    };
    // The area of each cell, by number, and the cells of each area.
    let mut area_of = vec![usize::MAX; width * height];
    let mut areas: Vec<Vec<usize>> = Vec::new();
    for first in 0..width * height {
        if area_of[first] != usize::MAX {
            continue;
        }
        let number = areas.len();
        area_of[first] = number;
        let (mut area, mut next) = (vec![first], 0);
        while let Some(&at) = area.get(next) {
            next += 1;
            for other in beside(at) {
                if area_of[other] == usize::MAX && cells[other] == cells[at] {
                    area_of[other] = number;
                    area.push(other);
                }
            }
        }
        areas.push(area);
    }
    let mut has_taken = false;
    for (number, area) in areas.iter().enumerate() {
        if area.len() >= LEAST_CELLS {
            continue;
        }
        let mut shared: Vec<(usize, usize)> = Vec::new();
        for other in area.iter().flat_map(|&at| beside(at)) {
            let other = area_of[other];
            if other == number || areas[other].len() < LEAST_CELLS {
                continue;
            }
            match shared.iter_mut().find(|(known, _)| *known == other) {
                Some((_, count)) => *count += 1,
                None => shared.push((other, 1)),
            }
        }
        // Of equal ones the first.
        let most = shared
            .iter()
            .max_by_key(|(other, count)| (*count, usize::MAX - other));
        if let Some((other, _)) = most {
            let cell = cells[areas[*other][0]];
            area.iter().for_each(|&at| cells[at] = cell);
            has_taken = true;
        }
    }
    has_taken
}

/// Ways from a corner of cells along their sides: right, down, left, up.
const WAYS: [(u8, isize, isize); 4] = [(1, 1, 0), (2, 0, 1), (4, -1, 0), (8, 0, -1)];

/// Sides of cells that are borders, by the corners of cells.
struct Sides {
    /// Corners in a row.
    stride: usize,
    /// The ways on from each corner that were not walked yet, one bit each.
    ways: Vec<u8>,
    /// Lines end at this corner.
    is_end: Vec<bool>,
}

impl Sides {
    fn of<T: PartialEq>(cells: &[T], [width, height]: [usize; 2]) -> Self {
        let stride = width + 1;
        let mut ways = vec![0_u8; stride * (height + 1)];
        for y in 0..height {
            for x in 0..width {
                let cell = &cells[y * width + x];
                if x > 0 && *cell != cells[y * width + x - 1] {
                    ways[y * stride + x] |= 2;
                    ways[(y + 1) * stride + x] |= 8;
                }
                if y > 0 && *cell != cells[(y - 1) * width + x] {
                    ways[y * stride + x] |= 1;
                    ways[y * stride + x + 1] |= 4;
                }
            }
        }
        let is_end = ways.iter().map(|ways| ways.count_ones() != 2).collect();
        Self {
            stride,
            ways,
            is_end,
        }
    }

    fn place(&self, corner: usize) -> Vec2 {
        Vec2::new((corner % self.stride) as f32, (corner / self.stride) as f32)
    }

    /// Walks from a corner that has a way to where its line ends, or back to the corner. The sides are then gone.
    fn take_line(&mut self, first: usize) -> Vec<usize> {
        let mut corners = vec![first];
        let mut at = first;
        while let Some((bit, dx, dy)) = WAYS.into_iter().find(|way| self.ways[at] & way.0 != 0) {
            let next = at.wrapping_add_signed(dx + dy * self.stride as isize);
            self.ways[at] &= !bit;
            // The way back is two places on.
            self.ways[next] &= !(if bit < 4 { bit << 2 } else { bit >> 2 });
            at = next;
            corners.push(at);
            if at == first || self.is_end[at] {
                break;
            }
        }
        corners
    }
}

/// A line along the sides of cells without its stairs: by the middles of the sides, and of those the ones that count.
fn smoothed(corners: &[Vec2], is_ring: bool) -> Vec<Vec2> {
    let middles = corners.windows(2).map(|pair| 0.5 * (pair[0] + pair[1]));
    if !is_ring {
        let [first, .., last] = corners else {
            return corners.to_vec();
        };
        let points: Vec<Vec2> = [*first].into_iter().chain(middles).chain([*last]).collect();
        return simplified(&points, TOLERANCE);
    }
    // A ring is cut in two: at its first place, and at the one that is farthest from it.
    let mut points: Vec<Vec2> = middles.collect();
    let Some(&start) = points.first() else {
        return points;
    };
    points.push(start);
    let away = |i: &usize| points[*i].distance_squared(start);
    let far = (0..points.len()).max_by(|a, b| away(a).total_cmp(&away(b)));
    let far = far.unwrap_or(0);
    let mut kept = simplified(&points[..=far], TOLERANCE);
    kept.pop();
    kept.extend(simplified(&points[far..], TOLERANCE));
    kept.pop();
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid(size: [u32; 2], of: impl Fn(Vec2) -> u8) -> Vec<u8> {
        let rows = (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| (x, y)));
        rows.map(|(x, y)| of(Vec2::new(x as f32 + 0.5, y as f32 + 0.5)))
            .collect()
    }

    #[test]
    fn a_disc_has_one_ring_that_keeps_to_it() {
        let (middle, radius) = (Vec2::new(50.3, 41.2), 30.7);
        let cells = grid([100, 90], |pos| u8::from(pos.distance(middle) < radius));
        let lines = borders(&cells, [100, 90]);
        let [ring] = &lines[..] else {
            panic!("{} lines", lines.len());
        };
        assert!(ring.is_closed, "a ring");
        assert!(ring.points.len() < 60, "{} corners", ring.points.len());
        // Whole ways, not corners alone.
        let ends = ring.points.iter().cycle().skip(1);
        for (a, b) in ring.points.iter().zip(ends) {
            for part in [0.0, 0.25, 0.5, 0.75] {
                let off = (a.lerp(*b, part).distance(middle) - radius).abs();
                assert!(off < 1.0, "off by {off}");
            }
        }
    }

    #[test]
    fn lines_end_where_three_areas_meet() {
        // Left and right, and a third below both.
        let cells = grid([40, 40], |pos| match pos.y > 25.0 {
            true => 3,
            false => 1 + u8::from(pos.x > 18.0),
        });
        let mut lines = borders(&cells, [40, 40]);
        lines.sort_by(|a, b| a.points[0].x.total_cmp(&b.points[0].x));
        let ends: Vec<[Vec2; 2]> = lines
            .iter()
            .map(|line| [line.points[0], line.points[line.points.len() - 1]])
            .collect();
        let has = |a: [f32; 2], b: [f32; 2]| {
            let (a, b) = (Vec2::from(a), Vec2::from(b));
            ends.contains(&[a, b]) || ends.contains(&[b, a])
        };
        assert_eq!(lines.len(), 3, "{lines:?}");
        assert!(has([0.0, 25.0], [18.0, 25.0]), "{ends:?}");
        assert!(has([18.0, 25.0], [40.0, 25.0]), "{ends:?}");
        assert!(has([18.0, 0.0], [18.0, 25.0]), "{ends:?}");
        assert!(
            lines
                .iter()
                .all(|line| line.points.len() == 2 && !line.is_closed)
        );
    }

    #[test]
    fn specks_and_nothing_have_no_lines() {
        assert!(borders(&[7; 12], [4, 3]).is_empty(), "one area");
        assert!(borders::<u8>(&[], [0, 3]).is_empty(), "no cells");
        assert!(borders(&[1, 2], [4, 3]).is_empty(), "cells are missing");
        let speck = grid([30, 30], |pos| {
            u8::from(pos.distance(Vec2::splat(9.0)) < 1.5)
        });
        assert!(borders(&speck, [30, 30]).is_empty(), "a speck");
        // A rim of crumbs of other areas leaves one ring.
        let rim = |pos: Vec2| (pos.distance(Vec2::splat(30.0)) - 20.0, pos.x as u32 / 3);
        let cells = grid([60, 60], |pos| match rim(pos) {
            (off, _) if off > 0.0 => 0,
            (off, part) if off > -1.5 => 2 + (part % 3) as u8,
            _ => 1,
        });
        let lines = borders(&cells, [60, 60]);
        assert!(lines.len() == 1 && lines[0].is_closed, "{lines:?}");
        // Two areas that touch at a corner.
        let cells = grid([60, 60], |pos| u8::from((pos.x < 30.0) == (pos.y < 30.0)));
        assert_eq!(borders(&cells, [60, 60]).len(), 4, "four lines meet");
    }
}
