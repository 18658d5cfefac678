//! Distances between two points. They stay where they were set in the deformed object's space, belong to no document,
//! and go with the subject.

use glam::Vec3;

/// Distances at most: more cannot be told apart over a picture.
const MOST: usize = 12;

/// The distances that were measured.
#[derive(Debug, Default)]
pub struct Measures {
    lines: Vec<[Vec3; 2]>,
}

impl Measures {
    /// Both ends of each distance, subject space, oldest first.
    pub fn lines(&self) -> &[[Vec3; 2]] {
        &self.lines
    }

    /// Adds a distance; the oldest goes where there are too many.
    pub fn add(&mut self, line: [Vec3; 2]) {
        if self.lines.len() == MOST {
            self.lines.remove(0);
        }
        self.lines.push(line);
    }

    /// Removes the distance of this index; without one nothing happens.
    pub fn remove(&mut self, index: usize) {
        if index < self.lines.len() {
            self.lines.remove(index);
        }
    }

    /// Removes all distances.
    pub fn clear(&mut self) {
        self.lines.clear();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_oldest_distance_makes_room() {
        let mut measures = Measures::default();
        for i in 0..40 {
            measures.add([Vec3::ZERO, Vec3::splat(i as f32)]);
        }
        assert_eq!(measures.lines().len(), MOST);
        assert_eq!(measures.lines()[MOST - 1][1], Vec3::splat(39.0));
        measures.remove(99);
        measures.remove(0);
        assert_eq!(measures.lines().len(), MOST - 1);
        measures.clear();
        assert!(measures.lines().is_empty());
    }
}
