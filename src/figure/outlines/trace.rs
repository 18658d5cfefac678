use crate::figure::regions::RegionMap;

/// Label of what lies outside the picture.
pub(crate) const OUTSIDE: u8 = 255;

/// The edges of the map between two labels, from junction to junction or closed, in steps of one pixel.
pub(crate) struct Traced {
    /// Corners of pixels, column and row, line after line.
    points: Vec<[u16; 2]>,
    /// Lines between junctions, and closed ones.
    pub(crate) lines: Vec<TracedLine>,
}

/// A line between two labels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct TracedLine {
    first: usize,
    end: usize,
    /// Label to the left, as seen on the screen when one goes along the line.
    pub(crate) left: u8,
    /// Label to the right.
    pub(crate) right: u8,
    /// Whether it has no ends; its last point is then its first again.
    pub(crate) is_closed: bool,
}

/// Steps to the right, down, to the left and up.
const STEPS: [[i32; 2]; 4] = [[1, 0], [0, 1], [-1, 0], [0, -1]];

impl Traced {
    /// The corners of pixels that a line runs through.
    pub(crate) fn points(&self, line: &TracedLine) -> &[[u16; 2]] {
        &self.points[line.first..line.end]
    }

    /// Traces all lines; none if there are more than `limit` junctions, closed lines counted threefold, which is what
    /// their points come to at least.
    pub(crate) fn new(map: &RegionMap, limit: usize) -> Option<Self> {
        let mut tracer = Tracer::new(map);
        let junctions = tracer.junctions(limit)?;
        let mut count = junctions.len();
        for at in &junctions {
            for direction in 0..4 {
                tracer.trace(*at, direction, false);
            }
        }
        // What is left are lines without a junction; each has an edge to the right.
        for row in 0..=tracer.height {
            for column in 0..=tracer.width {
                if tracer.trace([column, row], 0, true) {
                    count += 3;
                }
            }
            if count > limit {
                return None;
            }
        }
        Some(tracer.traced)
    }
}

/// The map while its lines are traced.
struct Tracer<'a> {
    map: &'a RegionMap,
    width: usize,
    height: usize,
    /// Whether the edge to the right of each corner, and the one down from it, has been taken.
    is_taken: Vec<[bool; 2]>,
    traced: Traced,
}

impl<'a> Tracer<'a> {
    fn new(map: &'a RegionMap) -> Self {
        let [width, height] = map.size;
        Self {
            map,
            width,
            height,
            is_taken: vec![[false; 2]; (width + 1) * (height + 1)],
            traced: Traced {
                points: Vec::new(),
                lines: Vec::new(),
            },
        }
    }

    /// The label of the pixel whose upper left corner is `at`, moved by whole pixels.
    fn label(&self, at: [usize; 2], dx: i32, dy: i32) -> u8 {
        let column = at[0]
            .checked_add_signed(dx as isize)
            .filter(|column| *column < self.width);
        let row = at[1]
            .checked_add_signed(dy as isize)
            .filter(|row| *row < self.height);
        match (column, row) {
            (Some(column), Some(row)) => self.map.labels[row * self.width + column],
            _ => OUTSIDE,
        }
    }

    /// Labels to the left and to the right of the step from a corner in a direction.
    fn sides(&self, at: [usize; 2], direction: usize) -> [u8; 2] {
        let [left, right] = match direction {
            0 => [(0, -1), (0, 0)],
            1 => [(0, 0), (-1, 0)],
            2 => [(-1, 0), (-1, -1)],
            _ => [(-1, -1), (0, -1)],
        };
        [left, right].map(|(dx, dy)| self.label(at, dx, dy))
    }

    fn is_line(&self, at: [usize; 2], direction: usize) -> bool {
        let [left, right] = self.sides(at, direction);
        left != right
    }

    /// Whether lines end at a corner: three or more meet, or it is a corner of the picture.
    fn is_junction(&self, at: [usize; 2]) -> bool {
        let is_end = |value, side| value == 0 || value == side;
        let around = [(-1, -1), (0, -1), (0, 0), (-1, 0)].map(|(dx, dy)| self.label(at, dx, dy));
        let count = (0..4).filter(|i| around[*i] != around[(i + 1) % 4]).count();
        count > 2 || is_end(at[0], self.width) && is_end(at[1], self.height)
    }

    fn junctions(&self, limit: usize) -> Option<Vec<[usize; 2]>> {
        let mut junctions = Vec::new();
        for row in 0..=self.height {
            for column in 0..=self.width {
                if self.is_junction([column, row]) {
                    junctions.push([column, row]);
                }
            }
            if junctions.len() > limit {
                return None;
            }
        }
        Some(junctions)
    }

    /// The flag of the edge that a step goes along.
    fn taken(&mut self, at: [usize; 2], direction: usize) -> &mut bool {
        let [column, row] = match direction {
            2 => [at[0] - 1, at[1]],
            3 => [at[0], at[1] - 1],
            _ => at,
        };
        &mut self.is_taken[row * (self.width + 1) + column][direction % 2]
    }

    /// Follows the line that begins with a step, until a junction or its own beginning. False if there is none, or it
    /// has been taken.
    fn trace(&mut self, start: [usize; 2], direction: usize, is_closed: bool) -> bool {
        if !self.is_line(start, direction) || *self.taken(start, direction) {
            return false;
        }
        let [left, right] = self.sides(start, direction);
        let first = self.traced.points.len();
        let (mut at, mut direction) = (start, direction);
        self.push(at);
        loop {
            *self.taken(at, direction) = true;
            let [dx, dy] = STEPS[direction];
            at = [
                at[0].wrapping_add_signed(dx as isize),
                at[1].wrapping_add_signed(dy as isize),
            ];
            self.push(at);
            if at == start || self.is_junction(at) {
                break;
            }
            let back = (direction + 2) % 4;
            let Some(next) = (0..4).find(|next| *next != back && self.is_line(at, *next)) else {
                break;
            };
            direction = next;
        }
        self.traced.lines.push(TracedLine {
            first,
            end: self.traced.points.len(),
            left,
            right,
            is_closed,
        });
        true
    }

    fn push(&mut self, at: [usize; 2]) {
        self.traced.points.push(at.map(|value| value as u16));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn traced(rows: &[&str]) -> Traced {
        let map = RegionMap {
            size: [rows[0].len(), rows.len()],
            labels: rows.iter().flat_map(|row| row.bytes()).collect(),
        };
        Traced::new(&map, 1000).expect("few lines")
    }

    #[test]
    fn an_island_is_one_closed_line_and_the_frame_four() {
        let traced = traced(&["aaaa", "abba", "aaaa"]);
        assert_eq!(traced.lines.len(), 5, "lines");
        let island = traced
            .lines
            .iter()
            .find(|line| line.is_closed)
            .expect("a closed line");
        assert_eq!(traced.points(island).len(), 7, "around two pixels and back");
        // It starts to the right along the upper edge: the island lies to its right.
        assert_eq!([island.left, island.right], [b'a', b'b'], "sides");
    }

    #[test]
    fn regions_that_touch_at_a_corner_meet_in_a_junction() {
        let traced = traced(&["aaaa", "abaa", "aaba", "aaaa"]);
        let inner: Vec<_> = traced
            .lines
            .iter()
            .filter(|line| line.left != OUTSIDE && line.right != OUTSIDE)
            .collect();
        assert_eq!(inner.len(), 2, "two loops");
        for line in inner {
            let points = traced.points(line);
            assert_eq!(points.first(), Some(&[2, 2]), "from the corner");
            assert_eq!(points.last(), Some(&[2, 2]), "to the corner");
        }
    }
}
