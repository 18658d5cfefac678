//! A mesh that is to be written, and what all formats take of it.

use glam::Vec3;

/// Two formats have two forms.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Form {
    /// Small and quick: what people mean if they do not say.
    #[default]
    Binary,
    /// ASCII, to be looked at.
    Text,
}

/// A mesh that is to be written. Triangles with an index out of range are left out.
///
/// A clay has at most 300,000 triangles; 4 GiB, where the lengths in these formats end, are more than twenty million.
#[derive(Clone, Copy, Debug)]
pub struct Export<'a> {
    /// Millimetres, RAS+.
    pub positions_mm: &'a [Vec3],
    /// One for each position, of unit length, RAS+. One that is missing, 0 or not finite is written as +z.
    pub normals: &'a [Vec3],
    /// Corners, counter-clockwise as seen from outside.
    pub triangles: &'a [[u32; 3]],
    /// What the picture is called; may be empty, and may hold anything. Each format gets of it what it can hold.
    pub title: &'a str,
}

impl Export<'_> {
    /// The triangles whose corners are there.
    pub(super) fn whole_triangles(&self) -> impl Iterator<Item = [u32; 3]> {
        let count = self.positions_mm.len();
        let triangles = self.triangles.iter().copied();
        triangles.filter(move |triangle| triangle.iter().all(|&i| (i as usize) < count))
    }

    /// Each position with its normal.
    pub(super) fn vertices(&self) -> impl Iterator<Item = (Vec3, Vec3)> {
        let normals = self
            .normals
            .iter()
            .copied()
            .chain(std::iter::repeat(Vec3::Z));
        let normals = normals.map(|normal| match normal.is_finite() && normal != Vec3::ZERO {
            true => normal,
            false => Vec3::Z,
        });
        self.positions_mm.iter().copied().zip(normals)
    }
}

/// From RAS+ to the axes of OBJ and glTF. A turn: nothing is mirrored. A 0 stays above 0.
pub(super) fn y_up_from_ras(ras: Vec3) -> Vec3 {
    Vec3::new(0.0 - ras.x, ras.z, ras.y)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_missing_is_made_up_and_what_is_broken_left_out() {
        let positions_mm = [Vec3::ZERO, Vec3::X, Vec3::Y];
        let export = Export {
            positions_mm: &positions_mm,
            normals: &[Vec3::ZERO, Vec3::NAN],
            triangles: &[[0, 1, 3], [0, 1, 2], [u32::MAX; 3]],
            title: "",
        };
        assert!(
            export.vertices().all(|(_, normal)| normal == Vec3::Z),
            "upwards"
        );
        assert_eq!(export.whole_triangles().collect::<Vec<_>>(), [[0, 1, 2]]);
    }

    #[test]
    fn axes_are_turned_as_the_readers_turn_them_back() {
        let [x, y, z] = y_up_from_ras(Vec3::new(1.0, 2.0, 3.0)).to_array();
        // `Axes::YUp` of the readers: RAS = −x, z, y.
        assert_eq!([-x, z, y], [1.0, 2.0, 3.0]);
        assert!(
            y_up_from_ras(Vec3::ZERO).x.is_sign_positive(),
            "−0 is not written"
        );
    }
}
