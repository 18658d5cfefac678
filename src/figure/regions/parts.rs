/// Value of what is done, and of the margin around a map.
const DONE: u8 = 255;
/// Value of what has been reached.
const REACHED: u8 = 254;

/// Which neighbours a pixel hangs together with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Neighbours {
    /// Those that share an edge.
    Four,
    /// Those that share an edge or a corner.
    Eight,
}

/// A copy of a map with a margin of one pixel, in which parts are found without looking out for its edges.
pub(crate) struct Padded {
    size: [usize; 2],
    values: Vec<u8>,
}

impl Padded {
    /// A copy of a map of values below 254; [`Padded::NOWHERE`] belongs to no part.
    pub(crate) fn new(size: [usize; 2], values: impl Iterator<Item = u8>) -> Self {
        let [width, height] = size;
        let mut padded = vec![DONE; (width + 2) * (height + 2)];
        let rows = padded.chunks_exact_mut(width + 2).skip(1).take(height);
        let inner = rows.flat_map(|row| &mut row[1..=width]);
        inner.zip(values).for_each(|(to, from)| *to = from);
        Self {
            size,
            values: padded,
        }
    }

    /// The value of what belongs to no part.
    pub(crate) const NOWHERE: u8 = DONE;

    fn offsets(&self) -> [isize; 8] {
        let row = self.size[0] as isize + 2;
        [-1, 1, -row, row, -row - 1, -row + 1, row - 1, row + 1]
    }

    /// Index in the map without its margin.
    fn inner(&self, at: u32) -> usize {
        let row = self.size[0] + 2;
        let at = at as usize;
        (at / row - 1) * self.size[0] + at % row - 1
    }

    /// Calls `visit` with the pixels of each part of equal values that has fewer than `below`, by its first pixel in
    /// the order of rows, which is given first.
    pub(crate) fn visit_parts(
        mut self,
        neighbours: Neighbours,
        below: usize,
        mut visit: impl FnMut(&[usize]),
    ) {
        let mut stack = Vec::new();
        let mut part = Vec::new();
        let mut inner = Vec::new();
        for start in 0..self.values.len() {
            if self.values[start] == DONE {
                continue;
            }
            part.clear();
            let mut count = 0_usize;
            self.flood(start, DONE, neighbours, &mut stack, |at| {
                count += 1;
                // Of a part that is large enough no list is needed.
                if part.len() < below {
                    part.push(at);
                }
            });
            if count < below {
                inner.clear();
                inner.extend(part.iter().map(|at| self.inner(*at)));
                visit(&inner);
            }
        }
    }

    /// Which pixels the one with this index reaches over four neighbours of the same value.
    pub(crate) fn reached_from(mut self, start: usize) -> Vec<bool> {
        let width = self.size[0];
        let padded = (start / width + 1) * (width + 2) + start % width + 1;
        self.flood(padded, REACHED, Neighbours::Four, &mut Vec::new(), |_| {});
        let rows = self
            .values
            .chunks_exact(width + 2)
            .skip(1)
            .take(self.size[1]);
        rows.flat_map(|row| row[1..=width].iter().map(|value| *value == REACHED))
            .collect()
    }

    /// Replaces the values of a part, and calls `visit` with each of its pixels, the first one first.
    fn flood(
        &mut self,
        start: usize,
        by: u8,
        neighbours: Neighbours,
        stack: &mut Vec<u32>,
        mut visit: impl FnMut(u32),
    ) {
        let value = self.values[start];
        if value == DONE {
            return;
        }
        let offsets = self.offsets();
        let offsets = match neighbours {
            Neighbours::Four => &offsets[..4],
            Neighbours::Eight => &offsets[..],
        };
        self.values[start] = by;
        stack.push(start as u32);
        while let Some(at) = stack.pop() {
            visit(at);
            for offset in offsets {
                let to = (at as usize).wrapping_add_signed(*offset);
                if self.values[to] == value {
                    self.values[to] = by;
                    stack.push(to as u32);
                }
            }
        }
    }
}
