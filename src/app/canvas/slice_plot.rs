//! How slices lie in their panes, and what is drawn over them: boxes of templates, the crosshair, the patient's sides.

use egui::{Align2, Color32, Painter, Pos2, Rect, Shape, Stroke, Vec2, pos2, vec2};
use glam::Vec3;

use crate::app::canvas::projection::Projection;
use crate::app::kit::theme::{self, over_picture as ink};
use crate::app::session::{Pane, ViewState};
use crate::describe::side_letters;
use crate::document::PlacedTemplate;
use crate::math::{Bent, Placement};

/// Width of the strip at the side of a slice that scrolls through.
pub(crate) const STRIP: f32 = 26.0;

/// A slice's axes, subject space.
pub(crate) struct Axes {
    pub(crate) pane: Pane,
    /// Across the slice; its component is what scrolls.
    pub(crate) normal: Vec3,
    pub(crate) right: Vec3,
    pub(crate) down: Vec3,
    /// Index of the component along the normal.
    pub(crate) axis: usize,
    pub(crate) color: Color32,
}

pub(crate) const SLICES: [Axes; 3] = [
    Axes {
        pane: Pane::Axial,
        normal: Vec3::Z,
        right: Vec3::NEG_X,
        down: Vec3::NEG_Y,
        axis: 2,
        color: ink::Z,
    },
    Axes {
        pane: Pane::Coronal,
        normal: Vec3::Y,
        right: Vec3::NEG_X,
        down: Vec3::NEG_Z,
        axis: 1,
        color: ink::Y,
    },
    Axes {
        pane: Pane::Sagittal,
        normal: Vec3::X,
        right: Vec3::NEG_Y,
        down: Vec3::NEG_Z,
        axis: 0,
        color: ink::X,
    },
];

/// How a slice lies in its pane.
pub(crate) struct Map<'a> {
    pub(crate) rect: Rect,
    pub(crate) axes: &'a Axes,
    /// What the middle of the pane shows, in the slice.
    pub(crate) middle: Vec3,
    pub(crate) units_per_point: f32,
}

impl Map<'_> {
    /// Where a point is seen, however far it lies from the slice.
    pub(crate) fn ui(&self, pos: Vec3) -> Pos2 {
        let to = (pos - self.middle) / self.units_per_point;
        self.rect.center() + vec2(to.dot(self.axes.right), to.dot(self.axes.down))
    }

    /// The point of the slice that is seen at a place.
    pub(crate) fn subject(&self, at: Pos2) -> Vec3 {
        let to = (at - self.rect.center()) * self.units_per_point;
        self.middle + self.axes.right * to.x + self.axes.down * to.y
    }

    /// Signed distance of a point from the slice.
    pub(crate) fn height(&self, pos: Vec3) -> f32 {
        (pos - self.middle).dot(self.axes.normal)
    }
}

/// The polygon in which a slice cuts a template's box, in the window; empty if it misses it.
pub(crate) fn section(map: &Map<'_>, placement: &Placement) -> Vec<Pos2> {
    let corner = |bits: usize| {
        let pick = |bit: usize| if bits & bit == 0 { 0.0 } else { 1.0 };
        placement.subject_from_template(Vec3::new(pick(1), pick(2), pick(4)))
    };
    let mut points = Vec::new();
    for axis in 0..3_usize {
        for bits in (0..8_usize).filter(|bits| bits & (1 << axis) == 0) {
            let (a, b) = (corner(bits), corner(bits | (1 << axis)));
            let (high, low) = (map.height(a), map.height(b));
            if (high > 0.0) != (low > 0.0) {
                points.push(map.ui(a.lerp(b, high / (high - low))));
            }
        }
    }
    let count = points.len().max(1) as f32;
    let middle = points.iter().fold(Vec2::ZERO, |sum, p| sum + p.to_vec2()) / count;
    points.sort_by(|a, b| {
        let angle = |p: &Pos2| (p.to_vec2() - middle).angle();
        angle(a).total_cmp(&angle(b))
    });
    points
}

/// Where a slice cuts the walls of a box that is bent along a curve: a line for every piece of a wall.
fn bent_section(map: &Map<'_>, placement: &Placement, bent: &Bent) -> Vec<Vec<Pos2>> {
    const PIECES: u8 = 24;
    let place = |x: f32, y: f32, z: f32| {
        placement.subject_from_template(bent.bend(Vec3::new(x, y, bent.unfolded(z))))
    };
    let mut lines = Vec::new();
    let mut cut = |wall: [Vec3; 4]| {
        let ends = (0..4).filter_map(|i| {
            let (a, b) = (wall[i], wall[(i + 1) % 4]);
            let (high, low) = (map.height(a), map.height(b));
            ((high > 0.0) != (low > 0.0)).then(|| map.ui(a.lerp(b, high / (high - low))))
        });
        let ends: Vec<Pos2> = ends.collect();
        lines.extend(ends.chunks_exact(2).map(<[Pos2]>::to_vec));
    };
    for x in [0.0, 1.0] {
        cut([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(y, z)| place(x, y, z)));
    }
    for piece in 0..PIECES {
        let [a, b] = [piece, piece + 1].map(|i| f32::from(i) / f32::from(PIECES));
        for end in [0.0, 1.0] {
            cut([(a, 0.0), (b, 0.0), (b, 1.0), (a, 1.0)].map(|(x, y)| place(x, y, end)));
            cut([(a, 0.0), (b, 0.0), (b, 1.0), (a, 1.0)].map(|(x, z)| place(x, end, z)));
        }
    }
    lines
}

/// The lines in which a slice cuts a template's box; none if it misses it.
pub(crate) fn sections(map: &Map<'_>, template: &PlacedTemplate) -> Vec<Vec<Pos2>> {
    if let Some(bent) = template.bent() {
        return bent_section(map, &template.placement, &bent);
    }
    let mut line = section(map, &template.placement);
    match line.first().copied() {
        Some(first) if line.len() > 2 => {
            line.push(first);
            vec![line]
        }
        _ => Vec::new(),
    }
}

/// Draws the section of a template. True if the slice cuts its box.
pub(crate) fn paint_template(
    painter: &Painter,
    map: &Map<'_>,
    template: &PlacedTemplate,
    stroke: Stroke,
) -> bool {
    let lines = sections(map, template);
    let is_cut = !lines.is_empty();
    for line in lines {
        paint_line(painter, line, stroke, !template.enabled);
    }
    is_cut
}

/// Draws the section of a box that is about to be placed.
pub(crate) fn paint_section(
    painter: &Painter,
    map: &Map<'_>,
    placement: &Placement,
    stroke: Stroke,
) {
    let mut line = section(map, placement);
    if let Some(first) = line.first().copied() {
        line.push(first);
        paint_line(painter, line, stroke, true);
    }
}

fn paint_line(painter: &Painter, line: Vec<Pos2>, stroke: Stroke, is_dashed: bool) {
    painter.add(Shape::line(
        line.clone(),
        Stroke::new(stroke.width + 2.0, ink::HALO_DARK),
    ));
    if is_dashed {
        painter.extend(Shape::dashed_line(&line, stroke, 5.0, 4.0));
    } else {
        painter.add(Shape::line(line, stroke));
    }
}

/// The sides of the patient at the edges. The upper and the lower letter make way for what else is written there.
pub(crate) fn edges(
    painter: &Painter,
    axes: &Axes,
    rect: Rect,
    written: [Option<Rect>; 2],
    color: Color32,
) {
    let font = theme::strong_font(13.0);
    let mut top = rect.center_top() + vec2(0.0, 16.0);
    let mut bottom = rect.center_bottom() - vec2(0.0, 16.0);
    for text in written.into_iter().flatten() {
        let around = text.expand2(vec2(14.0, 8.0));
        if around.contains(top) {
            top.y = text.bottom() + 12.0;
        }
        if around.contains(bottom) {
            bottom.y = text.top() - 10.0;
        }
    }
    let at = [
        (rect.left_center() + vec2(12.0, 0.0), -axes.right),
        (rect.right_center() - vec2(STRIP + 10.0, 0.0), axes.right),
        (top, -axes.down),
        (bottom, axes.down),
    ];
    for (pos, direction) in at {
        let letters = side_letters(direction);
        painter.text(pos, Align2::CENTER_CENTER, letters, font.clone(), color);
    }
}

/// The other two slices as lines, open in the middle so that what is there can be seen.
pub(crate) fn paint_crosshair(painter: &Painter, axes: &Axes, map: &Map<'_>, cross: Vec3) {
    let at = map.ui(cross);
    for other in SLICES.iter().filter(|other| other.axis != axes.axis) {
        // The other slice runs along the direction that is neither its normal nor this one's.
        let is_upright = other.normal.dot(axes.right).abs() > 0.5;
        let color = other.color.gamma_multiply(0.85);
        let (low, high, from, to) = if is_upright {
            let line = |y: f32| pos2(at.x, y);
            (
                line(map.rect.top()),
                line(at.y - 10.0),
                line(at.y + 10.0),
                line(map.rect.bottom()),
            )
        } else {
            let line = |x: f32| pos2(x, at.y);
            (
                line(map.rect.left()),
                line(at.x - 10.0),
                line(at.x + 10.0),
                line(map.rect.right()),
            )
        };
        painter.line_segment([low, high], Stroke::new(1.0, color));
        painter.line_segment([from, to], Stroke::new(1.0, color));
    }
}

/// The crosshair's place in the picture.
pub(crate) fn mark_in_picture(painter: &Painter, view: &Projection, session: &ViewState) {
    if !session.is_split {
        return;
    }
    let unit = 14.0 / view.points_per_unit(session.cross);
    for axes in &SLICES {
        let ends = [-1.0, 1.0]
            .map(|sign| view.ui_from_subject(session.cross + axes.normal * (sign * unit)));
        if let [Some(a), Some(b)] = ends {
            painter.line_segment(
                [a, b],
                Stroke::new(3.5, ink::HALO_LIGHT.gamma_multiply(0.6)),
            );
            painter.line_segment([a, b], Stroke::new(1.8, axes.color));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn map(axes: &Axes) -> Map<'_> {
        Map {
            rect: Rect::from_min_size(pos2(0.0, 0.0), vec2(200.0, 100.0)),
            axes,
            middle: Vec3::new(0.1, 0.2, 0.3),
            units_per_point: 0.01,
        }
    }

    #[test]
    fn slices_lie_as_radiologists_lay_them() {
        for axes in &SLICES {
            let map = map(axes);
            let seen = |pos: Vec3| map.ui(map.middle + pos) - map.rect.center();
            match axes.pane {
                Pane::Sagittal => assert!(seen(Vec3::Y).x < 0.0, "the face looks to the left"),
                _ => assert!(seen(Vec3::X).x < 0.0, "right is left"),
            }
            match axes.pane {
                Pane::Axial => assert!(seen(Vec3::Y).y < 0.0, "anterior is up"),
                _ => assert!(seen(Vec3::Z).y < 0.0, "superior is up"),
            }
            let pos = map.subject(pos2(13.0, 77.0));
            assert!(map.ui(pos).distance(pos2(13.0, 77.0)) < 1e-3);
            assert!(map.height(pos).abs() < 1e-6, "it stays in the slice");
        }
    }

    #[test]
    fn a_slice_cuts_a_box_in_a_polygon() {
        let placement = Placement {
            at: Vec3::new(0.1, 0.2, 0.3),
            rotate: glam::Quat::IDENTITY,
            size: Vec3::new(0.4, 0.2, 0.6),
        };
        let found = section(&map(&SLICES[0]), &placement);
        assert_eq!(found.len(), 4);
        let size = Rect::from_points(&found).size();
        assert!((size - vec2(40.0, 20.0)).length() < 1e-2, "{size}");
        let turned = Placement {
            rotate: glam::Quat::from_rotation_arc(Vec3::Z, Vec3::ONE.normalize()),
            size: Vec3::splat(0.3),
            ..placement
        };
        assert_eq!(
            section(&map(&SLICES[0]), &turned).len(),
            6,
            "across a corner it has six sides"
        );
        let away = Placement {
            at: Vec3::new(0.1, 0.2, 0.9),
            ..placement
        };
        assert!(section(&map(&SLICES[0]), &away).is_empty());
    }
}
