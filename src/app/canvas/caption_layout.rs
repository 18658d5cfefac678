//! How captions are laid out beside a picture, on the screen and in files.

use egui::{Color32, Pos2, Rect, Vec2, vec2};

use crate::document::Background;
use crate::math::columns;

/// Rows that a text has at most.
pub(crate) const ROWS: usize = 4;

/// True if letters on a background have to be light.
pub(crate) fn is_dark(background: Background) -> bool {
    match background {
        Background::Color([r, g, b]) => Color32::from_rgb(r, g, b).intensity() < 0.45,
        Background::None => false,
    }
}

/// Where the line of a caption begins that [`arranged`] has placed in an area: in the middle of the inner side of its
/// column. `at` is the place of its tissue, `middle` that of the area.
pub(crate) fn line_start(text: Rect, at: Pos2, middle: f32, gap: f32) -> Pos2 {
    if at.x < middle {
        text.right_center() + vec2(gap, 0.0)
    } else {
        text.left_center() - vec2(gap, 0.0)
    }
}

/// Places for texts beside a picture, in two columns: see [`arranged`](columns::arranged).
pub(crate) fn arranged(points: &[Pos2], sizes: &[Vec2], gap: f32, area: Rect) -> Vec<Rect> {
    let points: Vec<_> = points.iter().map(|p| glam::vec2(p.x, p.y)).collect();
    let plain: Vec<_> = sizes.iter().map(|s| glam::vec2(s.x, s.y)).collect();
    let corners = [area.min, area.max].map(|corner| glam::vec2(corner.x, corner.y));
    let places = columns::arranged(&points, &plain, gap, corners);
    let rect = |(at, &size): (glam::Vec2, &Vec2)| Rect::from_min_size(Pos2::new(at.x, at.y), size);
    places.into_iter().zip(sizes).map(rect).collect()
}
