//! Vertices at one place made one.

use glam::Vec3;

use crate::data::NO_INDEX;

/// The bits of a place, equal for equal floats: −0 is 0.
fn key(place: Vec3) -> [u32; 3] {
    // −0 + 0 is 0.
    (place + Vec3::ZERO).to_array().map(f32::to_bits)
}

/// For each place the index of the first one that is equal to it, coordinate by coordinate as 32-bit floats;
/// [`NO_INDEX`] for places that are not finite. Sorts, so that no choice of places makes it slow.
pub(super) fn weld(places: &[Vec3]) -> Vec<u32> {
    let finite = places
        .iter()
        .zip(0u32..)
        .filter(|(place, _)| place.is_finite());
    let mut keys: Vec<([u32; 3], u32)> =
        finite.map(|(&place, index)| (key(place), index)).collect();
    keys.sort_unstable();
    let mut first = vec![NO_INDEX; places.len()];
    for group in keys.chunk_by(|a, b| a.0 == b.0) {
        for (_, index) in group {
            first[*index as usize] = group[0].1;
        }
    }
    first
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_floats_are_welded_and_nothing_else() {
        let tiny = f32::from_bits(1);
        let places = [
            Vec3::new(0.0, 1.0, 2.0),
            Vec3::new(-0.0, 1.0, 2.0),
            Vec3::new(tiny, 1.0, 2.0),
            Vec3::new(0.0, 1.0, f32::NAN),
            Vec3::new(0.0, 1.0, f32::NAN),
            Vec3::new(0.0, f32::INFINITY, 0.0),
            Vec3::new(0.0, 1.0, 2.0),
            Vec3::new(tiny, 1.0, 2.0),
        ];
        let none = NO_INDEX;
        assert_eq!(weld(&places), [0, 0, 2, none, none, none, 0, 2]);
        assert!(weld(&[]).is_empty());
    }
}
