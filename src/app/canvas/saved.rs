//! A picture on its way into a file: as it was when it was asked for, in its own frame, with its texts.

use std::cell::Cell;
use std::rc::Rc;

use glam::Vec2;

use super::lettering::Lettering;
use crate::document::Camera;
use crate::math::Aabb;
use crate::render::{FileInMemory, MOST_PX, PngRows, RenderError, Rows, Taker, View};

/// Pixels along the longer side of a saved picture at least, where none are asked for.
const LEAST_PX: f32 = 2000.0;
/// Free room around the object in a frame that was made lower, of the object's height.
const MARGIN: f32 = 0.06;

/// A picture on its way into a file.
pub(crate) struct Saving {
    /// Name of the file.
    pub name: String,
    /// Asked for by a script, which waits for the picture.
    pub is_for_script: bool,
}

/// The rows of a picture on their way into a PNG file, written over as they come.
pub(crate) struct SavedRows {
    png: PngRows<FileInMemory>,
    file: FileInMemory,
    lettering: Option<Lettering>,
    /// How much of the picture is drawn, 0 to 1.
    progress: Rc<Cell<f32>>,
}

impl SavedRows {
    /// Begins the file of a picture of this size, printed with so many dots per inch if that is known.
    pub(crate) fn new(
        size_px: [u32; 2],
        dpi: Option<f32>,
        lettering: Option<Lettering>,
        progress: Rc<Cell<f32>>,
    ) -> Result<Self, RenderError> {
        let file = FileInMemory::default();
        Ok(Self {
            png: PngRows::new(file.clone(), size_px, dpi)?,
            file,
            lettering,
            progress,
        })
    }

    /// The bytes of the file, once all rows are there.
    pub(crate) fn finish(self) -> Result<Vec<u8>, RenderError> {
        self.png.finish()?;
        Ok(self.file.take())
    }
}

impl Taker for SavedRows {
    fn progress(&mut self, part: f32) -> Result<(), RenderError> {
        self.progress.set(part);
        Ok(())
    }

    fn take(&mut self, mut rows: Rows) -> Result<(), RenderError> {
        if let Some(lettering) = &self.lettering {
            lettering.lay(rows.first, &mut rows.rgba);
        }
        self.png.write(&rows.rgba)
    }
}

/// Size of a saved picture, pixels: the proportions of the picture in the window, which has `shown_px`, and along the
/// longer side `longer_px`, or at least [`LEAST_PX`] where that is `None`. Where the window is higher than wide, as on
/// a phone, the frame ends above and below the object, whose box in subject space is `bounds`: most of the picture
/// would be empty else.
pub(crate) fn file_size(
    shown_px: [u32; 2],
    camera: &Camera,
    bounds: Option<Aabb>,
    longer_px: Option<u32>,
) -> [u32; 2] {
    let [width, height] = shown_px.map(|side| side.max(1) as f32);
    let needed = bounds.map_or(height, |bounds| {
        let view = View::new(camera, shown_px);
        let off_middle = |corner: Vec2| (corner.y - 0.5 * height).abs();
        let reach = bounds.corners().iter().try_fold(0.0_f32, |reach, corner| {
            Some(reach.max(off_middle(view.pixel_from_subject(*corner)?)))
        });
        reach.map_or(height, |reach| 2.0 * reach * (1.0 + MARGIN))
    });
    let height = needed.clamp(width.min(height), height);
    let longer = width.max(height);
    let factor = longer_px.map_or((LEAST_PX / longer).max(1.0), |px| px as f32 / longer);
    [width, height].map(|side| ((side * factor).round() as u32).clamp(1, MOST_PX))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::Document;
    use glam::Vec3;

    const BOX: Aabb = Aabb {
        min: Vec3::splat(-0.25),
        max: Vec3::splat(0.25),
    };

    #[test]
    fn a_wide_picture_keeps_the_windows_proportions() {
        let camera = Document::new().illustration().camera;
        assert_eq!(
            file_size([500, 400], &camera, Some(BOX), None),
            [2000, 1600]
        );
        assert_eq!(
            file_size([3000, 1000], &camera, Some(BOX), None),
            [3000, 1000]
        );
        let asked = |px| file_size([3000, 1500], &camera, Some(BOX), Some(px));
        assert_eq!([asked(1000), asked(4000)], [[1000, 500], [4000, 2000]]);
        assert_eq!(
            asked(u32::MAX),
            [MOST_PX; 2],
            "no more than a device may have"
        );
    }

    #[test]
    fn a_high_picture_ends_where_the_object_does() {
        let camera = Document::new().illustration().camera;
        let [width, height] = file_size([390, 740], &camera, Some(BOX), None);
        assert_eq!([width, height], [2000, 2000], "a small object: a square");
        // A box higher than the picture is wide needs more, one that leaves the window all of it.
        let tall = |half: f32| Aabb {
            min: Vec3::new(-0.1, -0.1, -half),
            max: Vec3::new(0.1, 0.1, half),
        };
        let [width, height] = file_size([390, 740], &camera, Some(tall(0.9)), None);
        assert!(width < height && height == 2000, "{width} x {height}");
        assert_eq!(
            file_size([390, 740], &camera, Some(tall(5.0)), None)[1],
            2000
        );
        assert_eq!(file_size([390, 740], &camera, None, None), [1054, 2000]);
    }
}
