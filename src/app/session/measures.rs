//! Distances between two points. The points keep their positions in the space of the deformed object. No document
//! stores the distances. A subject that fills another box removes all distances.

use glam::Vec3;

/// Most distances at a time: a user cannot tell more lines over a picture apart.
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

    /// Adds a distance. If the list is full, removes the oldest distance first.
    pub fn add(&mut self, line: [Vec3; 2]) {
        if self.lines.len() == MOST {
            self.lines.remove(0);
        }
        self.lines.push(line);
    }

    /// Removes the distance at this index. Does nothing if there is no distance at this index.
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
