use glam::{DVec2, dvec2};

/// Longest side of the map of a drawing, and of the copy of a large picture, pixels.
const DRAWING_SIDE: f64 = 1024.0;
const MAX_SIDE: u32 = 4096;

/// How the plane of a figure lies over the pixels of its map.
///
/// Figure space: origin in the middle of the source, x to the right, y up, 1 is the source's longest side. Map space:
/// origin at the top left corner, x to the right, y down, 1 is a pixel; the centre of the first pixel is (½, ½).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// Width and height of the source: pixels, or units of an SVG's view box.
    pub source: DVec2,
    /// Width and height of the map, pixels.
    pub map: [u32; 2],
}

impl Plane {
    /// That of a picture of this width and height, pixels. A picture with a side above 4096 is reduced.
    pub fn of_picture(size: [u32; 2]) -> Self {
        Self {
            source: dvec2(f64::from(size[0]), f64::from(size[1])),
            map: reduced_size(size),
        }
    }

    /// That of a drawing whose view box has this width and height.
    pub fn of_drawing(size: DVec2) -> Self {
        let scale = DRAWING_SIDE / size.max_element();
        let side = |length: f64| ((length * scale).round() as u32).max(1);
        Self {
            source: size,
            map: [side(size.x), side(size.y)],
        }
    }

    /// Half of the width and of the height, figure units: the source reaches from minus this to this.
    pub fn half_size(&self) -> DVec2 {
        self.source / (2.0 * self.source.max_element())
    }

    /// Pixels of the map in a figure unit, along x and y; they differ where a reduced side had to be rounded.
    pub fn pixels_per_unit(&self) -> DVec2 {
        self.map_size() / (2.0 * self.half_size())
    }

    /// Width and height of the map, pixels.
    pub fn map_size(&self) -> DVec2 {
        dvec2(f64::from(self.map[0]), f64::from(self.map[1]))
    }

    /// A point of the map in figure space. The map's edge gives the source's edge to the last bit.
    pub fn figure_from_map(&self, pos: DVec2) -> DVec2 {
        // Measured from the middle, so that opposite edges have opposite numbers.
        let from_middle =
            (pos - self.map_size() / 2.0) / self.map_size() * (2.0 * self.half_size());
        dvec2(from_middle.x, -from_middle.y)
    }

    /// A point of figure space in the map; outside the source it is outside the map.
    pub fn map_from_figure(&self, pos: DVec2) -> DVec2 {
        dvec2(pos.x, -pos.y) / (2.0 * self.half_size()) * self.map_size() + self.map_size() / 2.0
    }

    /// Column and row of the pixel that a point of figure space lies in, if it lies in the map.
    pub fn pixel_at(&self, pos: DVec2) -> Option<[usize; 2]> {
        let at = self.map_from_figure(pos);
        let is_inside = at.cmpge(DVec2::ZERO).all() && at.cmplt(self.map_size()).all();
        is_inside.then_some([at.x as usize, at.y as usize])
    }
}

/// Width and height of the copy of a picture in which regions are found and from which it is drawn: its own unless a
/// side is longer than 4096 pixels.
pub fn reduced_size(size: [u32; 2]) -> [u32; 2] {
    let longest = size[0].max(size[1]);
    if longest <= MAX_SIDE {
        return size;
    }
    let factor = f64::from(MAX_SIDE) / f64::from(longest);
    size.map(|side| ((f64::from(side) * factor).round() as u32).max(1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pixels_lie_where_the_contract_says() {
        let (w, h) = (233.0, 800.0);
        let plane = Plane::of_picture([233, 800]);
        for (i, j) in [(0, 0), (232, 0), (7, 799), (116, 400)] {
            let (column, row) = (f64::from(i), f64::from(j));
            let at = dvec2(
                (column + 0.5 - w / 2.0) / 800.0,
                (h / 2.0 - row - 0.5) / 800.0,
            );
            assert!(
                (plane.figure_from_map(dvec2(column + 0.5, row + 0.5)) - at).length() < 1e-15,
                "pixel {i}, {j}"
            );
            assert_eq!(
                plane.pixel_at(at),
                Some([i as usize, j as usize]),
                "pixel {i}, {j}"
            );
        }
        assert_eq!(plane.pixel_at(dvec2(0.0, 0.51)), None, "above the picture");
        assert_eq!(
            plane.pixel_at(dvec2(-0.2, 0.0)),
            None,
            "left of the picture"
        );
    }

    #[test]
    fn large_pictures_are_reduced_and_thin_ones_keep_a_pixel() {
        assert_eq!(
            reduced_size([4096, 4096]),
            [4096, 4096],
            "not above the limit"
        );
        assert_eq!(reduced_size([8192, 5000]), [4096, 2500], "half");
        assert_eq!(reduced_size([16_384, 1]), [4096, 1], "a line");
        assert_eq!(
            Plane::of_drawing(dvec2(300.0, 150.0)).map,
            [1024, 512],
            "a drawing"
        );
    }
}
