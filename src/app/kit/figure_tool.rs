//! What the tools of a figure are called, in the panel and over the picture.

use super::icon::Icon;
use super::theme;
use crate::app::session::figure::FigureTool;
use crate::app::words::figure::w;

/// Icon and name of a tool, and what it is for in one sentence. A region is taken by colour where the plate
/// `has_pixels`, else by a shape.
pub(crate) fn face(tool: FigureTool, has_pixels: bool) -> (Icon, &'static str, &'static str) {
    let w = w();
    let (icon, name, hints) = match tool {
        FigureTool::Pin => (Icon::Pin, w.pin, [w.pin_hint, w.tap_pin]),
        FigureTool::Line => (Icon::Bend, w.line, [w.line_hint, w.tap_line]),
        FigureTool::Landmark => (Icon::Marks, w.landmark, [w.landmark_hint, w.tap_landmark]),
        FigureTool::Only => (Icon::Expand, w.only, [w.only_hint, w.tap_only]),
        FigureTool::Region if has_pixels => {
            let hints = [w.by_colour_hint, w.tap_colour];
            (Icon::Drop, w.by_colour, hints)
        }
        FigureTool::Region => (Icon::Drop, w.by_shape, [w.by_shape_hint, w.tap_shape]),
        FigureTool::Polygon => (Icon::Cut, w.polygon, [w.polygon_hint, w.tap_polygon]),
    };
    (icon, name, theme::by_hand(hints))
}
