//! Drawing a sweep on what is seen: the hand takes tissue along, and its gesture is one template.

use glam::{Quat, Vec3};

use super::selection::Selection;
use super::session::{Session, Tab};
use super::shape::seen_across;
use super::tool::Tool;
use crate::document::{
    Camera, Edit, MAX_KEYS, PathKey, SweepTool, SweepTools, TemplateKind, ToolShape,
};
use crate::math::{Placement, simplified_by};

/// Radius of the tool and width of its coating, parts of what the picture shows across its shorter side.
const RADIUS: f32 = 0.05;
const COAT: f32 = 0.08;
/// The tool is no smaller and no larger than this, subject units.
const LEAST: f32 = 0.012;
const MOST: f32 = 0.1;
/// How far the path may be off the gesture: a part of the coating, and subject units (spec/sweepers.md, B.3).
const OFF_COAT: f32 = 1.0 / 16.0;
const OFF_LEAST: f32 = 0.002;
/// Keys are rounded to this, template units: a link holds them.
const ROUNDED: f32 = 1e-3;

impl Session {
    /// Takes the way of a hand that draws a sweep, subject space, as far as it has come. At its end the tool is put
    /// away and the template is selected. The whole gesture is one step of undo.
    pub(super) fn draw_sweep(&mut self, way: &[Vec3], is_over: bool) {
        let drawn = self.drawn.take();
        if self.tool != Tool::Place(TemplateKind::Sweep) {
            return;
        }
        let Some((placement, tools)) = swept(way, &self.camera) else {
            self.drawn = drawn.filter(|_| !is_over);
            return;
        };
        let template = drawn.unwrap_or_else(|| self.template_count());
        let begin = match drawn {
            Some(_) => Edit::SetPlacement {
                template,
                placement,
            },
            None => Edit::AddTemplate {
                index: template,
                kind: TemplateKind::Sweep,
                placement,
            },
        };
        let edit = Edit::All {
            name: "Draw a sweep".to_owned(),
            edits: vec![begin, Edit::SetTools { template, tools }],
        };
        if !self.apply(&edit, true) {
            self.tool = Tool::Look;
            return;
        }
        if is_over {
            self.tool = Tool::Look;
            self.selection = Selection::Template(template);
            self.side_tab = Tab::Templates;
        } else {
            self.drawn = Some(template);
        }
    }
}

/// The box and the tool of a sweep along a way, subject space; `None` where the way has no length.
fn swept(way: &[Vec3], camera: &Camera) -> Option<(Placement, SweepTools)> {
    let seen = seen_across(camera);
    let [radius, coat] = [RADIUS, COAT].map(|part| (part * seen).clamp(LEAST, MOST));
    let keys = thinned(way, (OFF_COAT * coat).max(OFF_LEAST));
    let (low, high) = keys
        .iter()
        .fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(low, high), p| {
            (low.min(*p), high.max(*p))
        });
    if keys.len() < 2 || low.distance(high) < OFF_LEAST {
        return None;
    }
    let room = Vec3::splat(radius + coat);
    let size = high - low + 2.0 * room;
    let at = 0.5 * (low + high);
    let part = |length: f32| length / size.min_element();
    let path = keys.into_iter().map(|pos| {
        let q = (pos - at) / size + 0.5;
        PathKey::at((q / ROUNDED).round() * ROUNDED)
    });
    let tool = SweepTool {
        shape: Some(ToolShape::Ball {
            radius: part(radius),
        }),
        coat: part(coat),
        path: path.collect(),
        ..SweepTool::default()
    };
    let placement = Placement {
        at,
        rotate: Quat::IDENTITY,
        size,
    };
    let tools = SweepTools {
        tools: vec![tool],
        ..SweepTools::default()
    };
    Some((placement, tools))
}

/// As few of the points as lie on a path that all others are near to; at most [`MAX_KEYS`] (Douglas and Peucker).
pub(super) fn thinned(points: &[Vec3], tolerance: f32) -> Vec<Vec3> {
    let mut tolerance = tolerance;
    loop {
        let left = simplified_by(points, tolerance, distance_to);
        if left.len() <= MAX_KEYS {
            return left;
        }
        tolerance *= 1.5;
    }
}

/// Distance to a straight piece.
pub(super) fn distance_to(pos: Vec3, from: Vec3, to: Vec3) -> f32 {
    let along = to - from;
    let part = (pos - from).dot(along) / along.length_squared().max(1e-20);
    pos.distance(from + part.clamp(0.0, 1.0) * along)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_way_is_thinned_to_few_keys_near_it() {
        let way: Vec<Vec3> = (0..400)
            .map(|i| {
                let angle = 0.01 * i as f32;
                Vec3::new(0.3 * angle.cos(), 0.1 * angle, 0.3 * angle.sin())
            })
            .collect();
        let tolerance = 0.004;
        let keys = thinned(&way, tolerance);
        assert!(keys.len() < 20, "{} keys", keys.len());
        assert_eq!((keys[0], keys[keys.len() - 1]), (way[0], way[399]));
        for pos in &way {
            let near = keys
                .windows(2)
                .map(|pair| distance_to(*pos, pair[0], pair[1]));
            assert!(near.fold(f32::INFINITY, f32::min) <= tolerance);
        }
        // However wild, no more keys than a path holds; nothing from nothing.
        let wild: Vec<Vec3> = (0..3000).map(|i| Vec3::splat((i % 7) as f32)).collect();
        assert!(thinned(&wild, 1e-6).len() <= MAX_KEYS);
        assert!(thinned(&[], 0.1).is_empty());
        assert!(swept(&[Vec3::ZERO; 5], &Camera::DOCUMENT_DEFAULT).is_none());
    }

    #[test]
    fn the_box_holds_the_reach_and_the_keys_are_on_the_way() {
        let way = [Vec3::new(0.1, 0.2, 0.3), Vec3::new(0.3, 0.2, 0.35)];
        let (placement, tools) = swept(&way, &Camera::DOCUMENT_DEFAULT).expect("a sweep");
        let tool = &tools.tools[0];
        let Some(ToolShape::Ball { radius }) = tool.shape else {
            panic!("a ball")
        };
        let reach = (radius + tool.coat) * placement.size.min_element();
        for (pos, key) in way.iter().zip(&tool.path) {
            assert!(placement.subject_from_template(key.at).distance(*pos) < 1e-3);
            let inside = (key.at - 0.5).abs() * placement.size + reach;
            assert!(inside.cmple(0.5 * placement.size + 1e-3).all(), "{inside}");
        }
    }
}
