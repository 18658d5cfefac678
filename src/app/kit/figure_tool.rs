//! What the tools of a figure are called, in the panel and over the picture.

use super::icon::Icon;
use crate::app::session::figure::FigureTool;
use crate::app::words::figure::w;

/// Icon and name of a tool, and what it is for in one sentence. A region is taken by colour where the plate
/// `has_pixels`, else by a shape.
pub(crate) fn face(tool: FigureTool, has_pixels: bool) -> (Icon, &'static str, &'static str) {
    let w = w();
    match tool {
        FigureTool::Pin => (Icon::Pin, w.pin, w.pin_hint),
        FigureTool::Line => (Icon::Bend, w.line, w.line_hint),
        FigureTool::Landmark => (Icon::Marks, w.landmark, w.landmark_hint),
        FigureTool::Only => (Icon::Expand, w.only, w.only_hint),
        FigureTool::Region if has_pixels => (Icon::Drop, w.by_colour, w.by_colour_hint),
        FigureTool::Region => (Icon::Drop, w.by_shape, w.by_shape_hint),
        FigureTool::Polygon => (Icon::Cut, w.polygon, w.polygon_hint),
    }
}
