use super::parts::{Neighbours, Padded};

/// A set of pixels of the map, one flag for each, row by row from the top.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mask {
    /// Width and height, pixels.
    pub size: [usize; 2],
    /// Whether each pixel is in the set.
    pub bits: Vec<bool>,
}

impl Mask {
    /// No pixel of a map of this size.
    pub fn none(size: [usize; 2]) -> Self {
        Self {
            size,
            bits: vec![false; size[0] * size[1]],
        }
    }

    /// Number of pixels in the set.
    pub fn count(&self) -> usize {
        self.bits.iter().filter(|bit| **bit).count()
    }

    /// Takes every pixel that `other` has as well.
    pub(crate) fn add(&mut self, other: &Self) {
        for (bit, more) in self.bits.iter_mut().zip(&other.bits) {
            *bit |= more;
        }
    }

    /// Leaves the pixels that `other` has as well.
    pub(crate) fn keep(&mut self, other: &Self) {
        for (bit, kept) in self.bits.iter_mut().zip(&other.bits) {
            *bit &= kept;
        }
    }

    /// The pixels that are not in the set.
    pub(crate) fn inverted(&self) -> Self {
        Self {
            size: self.size,
            bits: self.bits.iter().map(|bit| !bit).collect(),
        }
    }

    /// The pixels that have one of the set within `radius` (distance of centres, pixels, 0 to 32).
    pub(crate) fn grown(&self, radius: f64) -> Self {
        let [width, height] = self.size;
        let reach = radius.floor() as usize;
        let distances = self.distances_along_rows();
        let mut grown = Self::none(self.size);
        // A pixel `dy` rows away is within the radius if it lies at most `half` columns away.
        for dy in 0..=reach.min(height.saturating_sub(1)) {
            let half = (radius * radius - (dy * dy) as f64).sqrt().floor() as u8;
            for row in 0..height - dy {
                let (upper, lower) = (row * width, (row + dy) * width);
                mark(
                    &mut grown.bits[upper..upper + width],
                    &distances[lower..lower + width],
                    half,
                );
                mark(
                    &mut grown.bits[lower..lower + width],
                    &distances[upper..upper + width],
                    half,
                );
            }
        }
        grown
    }

    /// The set grown by `radius` (pixels, -32 to 32); a negative one grows what is outside the set, which the map's
    /// edge is not.
    pub(crate) fn offset(self, radius: f64) -> Self {
        if radius > 0.0 {
            self.grown(radius)
        } else if radius < 0.0 {
            self.inverted().grown(-radius).inverted()
        } else {
            self
        }
    }

    /// Takes in the holes of fewer than `below` pixels: what the map's edge does not reach over eight neighbours.
    pub(crate) fn fill_holes(&mut self, below: usize) {
        let [width, height] = self.size;
        let outside = self
            .bits
            .iter()
            .map(|bit| if *bit { Padded::NOWHERE } else { 0 });
        Padded::new(self.size, outside).visit_parts(Neighbours::Eight, below, |part| {
            let is_edge = |at: &usize| {
                let (column, row) = (at % width, at / width);
                column == 0 || row == 0 || column + 1 == width || row + 1 == height
            };
            if !part.iter().any(is_edge) {
                part.iter().for_each(|at| self.bits[*at] = true);
            }
        });
    }

    /// Takes out the parts of fewer than `least` pixels; a part hangs together over four neighbours.
    pub(crate) fn drop_small_parts(&mut self, least: usize) {
        if least > 1 {
            let padded = self.padded();
            padded.visit_parts(Neighbours::Four, least, |part| {
                part.iter().for_each(|at| self.bits[*at] = false);
            });
        }
    }

    /// The pixels of the set that `start` reaches over four neighbours; none if it is not in the set.
    pub(crate) fn reached_from(&self, start: usize) -> Self {
        Self {
            size: self.size,
            bits: self.padded().reached_from(start),
        }
    }

    fn padded(&self) -> Padded {
        let inside = self
            .bits
            .iter()
            .map(|bit| if *bit { 0 } else { Padded::NOWHERE });
        Padded::new(self.size, inside)
    }

    /// How many columns each pixel is away from the nearest of the set in its row, 255 where it is further or none.
    fn distances_along_rows(&self) -> Vec<u8> {
        let width = self.size[0];
        let mut distances: Vec<u8> = self
            .bits
            .iter()
            .map(|bit| if *bit { 0 } else { u8::MAX })
            .collect();
        for row in distances.chunks_exact_mut(width) {
            let mut last = u8::MAX;
            for distance in row.iter_mut() {
                last = (*distance).min(last.saturating_add(1));
                *distance = last;
            }
            last = u8::MAX;
            for distance in row.iter_mut().rev() {
                last = (*distance).min(last.saturating_add(1));
                *distance = last;
            }
        }
        distances
    }
}

/// Sets the flags of those pixels whose distance is at most `half`.
fn mark(bits: &mut [bool], distances: &[u8], half: u8) {
    for (bit, distance) in bits.iter_mut().zip(distances) {
        *bit |= *distance <= half;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mask(rows: &[&str]) -> Mask {
        let bits = rows
            .iter()
            .flat_map(|row| row.bytes().map(|byte| byte == b'#'));
        Mask {
            size: [rows[0].len(), rows.len()],
            bits: bits.collect(),
        }
    }

    #[test]
    fn growth_is_a_disk_of_centres() {
        let mut one = Mask::none([15, 13]);
        one.bits[6 * 15 + 7] = true;
        for radius in [0.0, 1.0, 1.4, 1.5, 2.0, 2.9, 5.0, 6.5] {
            let grown = one.grown(radius);
            for (at, bit) in grown.bits.iter().enumerate() {
                let (dx, dy) = ((at % 15) as f64 - 7.0, (at / 15) as f64 - 6.0);
                assert_eq!(
                    *bit,
                    dx * dx + dy * dy <= radius * radius,
                    "radius {radius}, {dx}, {dy}"
                );
            }
        }
    }

    #[test]
    fn shrinking_leaves_the_edge_of_the_map_alone() {
        let all = Mask::none([5, 4]).inverted();
        assert_eq!(all.clone().offset(-2.0), all, "nothing is outside");
        let bar = mask(&["....", "####", "####", "####", "...."]);
        assert_eq!(
            bar.offset(-1.0),
            mask(&["....", "....", "####", "....", "...."]),
            "from above and below"
        );
    }

    #[test]
    fn holes_leak_over_corners_and_parts_hang_over_edges() {
        let mut ring = mask(&[".....", ".###.", ".#.#.", ".###.", "....."]);
        ring.fill_holes(usize::MAX);
        assert_eq!(ring.count(), 9, "a closed ring has a hole");
        let mut open = mask(&[".....", ".##..", ".#.#.", ".###.", "....."]);
        open.fill_holes(usize::MAX);
        assert_eq!(open.count(), 7, "a hole leaks over a corner");
        let mut two = mask(&["##...", "##...", "..##.", ".....", "....."]);
        two.drop_small_parts(3);
        assert_eq!(two.count(), 4, "a corner joins no parts");
    }
}
