//! What a drag with a tool in hand is: the way of the tool, thinned to few keys, or the curve that becomes a tool.

use glam::{DQuat, Quat, Vec3};

use super::camera;
use super::hand::{HeldTool, StrokeWay, Touch};
use super::shape::seen_across;
use crate::displace::MAX_TOOL_POINTS;
use crate::document::{Camera, ClayKey, MAX_KEYS, ToolShape};
use crate::math::{Aabb, Similarity, simplified_by, smooth_path};

/// How far the path may be off the gesture: a part of the coating, and subject units (spec/sweepers.md, B.3).
const OFF_COAT: f32 = 1.0 / 16.0;
const OFF_LEAST: f32 = 0.002;
/// A tool that pushes begins outside by so much of its size; one that pulls begins inside by so much.
const OUTSIDE: f32 = 1.0;
const INSIDE: f32 = 0.5;
/// Degrees by which a tool turns while the hand crosses the picture, and most degrees of one key.
const TURN: f32 = 360.0;
const TURN_OF_KEY: f32 = 120.0;
/// A tool grows to the double while the hand crosses this part of the picture.
const DOUBLES: f32 = 0.25;
/// Sizes of keys, per cent.
pub(super) const PERCENT: [f32; 2] = [5.0, 2000.0];
/// Longest turn of a key, degrees; rounding its parts may add one.
const LONGEST_TURN: f32 = 178.0;
/// Farthest place of a key, subject units.
const FARTHEST: f32 = 4.0;

pub(super) fn thousandths(pos: Vec3) -> [i32; 3] {
    let pos = pos.clamp(Vec3::splat(-FARTHEST), Vec3::splat(FARTHEST));
    (pos * 1e3).round().as_ivec3().to_array()
}

/// A turn as whole degrees about the axes of the subject, the shorter way round.
pub(super) fn degrees(turn: Quat) -> [i32; 3] {
    let turn = if turn.w < 0.0 { -turn } else { turn };
    let vector = turn.to_scaled_axis() * (180.0 / std::f32::consts::PI);
    let vector = vector.clamp_length_max(LONGEST_TURN);
    vector.round().as_ivec3().to_array()
}

/// The way of a tool, in keys.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Gesture {
    /// The poses, at least one.
    pub(super) keys: Vec<ClayKey>,
    /// True: screws join the keys; else a smooth curve does from three keys on.
    pub(super) is_straight: bool,
}

/// The way of a tool that a gesture is; `None` where it has come to nothing yet.
pub(super) fn gesture(
    hand: &HeldTool,
    way: StrokeWay,
    touches: &[Touch],
    camera: &Camera,
) -> Option<Gesture> {
    let (first, last) = (touches.first()?, touches.last()?);
    let (at, turn) = hand.pose(first);
    let key = |at: Vec3, turn: [i32; 3]| ClayKey {
        at: thousandths(at),
        turn,
        percent: 100,
    };
    let begin = key(at, degrees(turn));
    let [right, up, back] = camera::axes(camera.rotate);
    let gone = last.pos - first.pos;
    let [across, risen] = [gone.dot(right), gone.dot(up)];
    let (keys, is_straight) = match way {
        StrokeWay::Place | StrokeWay::Form => return None,
        StrokeWay::Move | StrokeWay::Along | StrokeWay::Smooth => {
            let places = touches.iter().map(|touch| match way {
                StrokeWay::Move => at + (touch.pos - first.pos),
                _ => hand.pose(touch).0,
            });
            let (places, is_straight) = few(&places.collect::<Vec<_>>(), hand.coat);
            // A place that is smoothed needs no way.
            if places.len() < 2 && way != StrokeWay::Smooth {
                return None;
            }
            let mut keys: Vec<ClayKey> = places.into_iter().map(|at| key(at, [0; 3])).collect();
            keys.first_mut()?.turn = begin.turn;
            keys.dedup_by_key(|key| key.at);
            (keys, is_straight)
        }
        StrokeWay::Push | StrokeWay::PushOver => {
            // Up pulls, or pushes where that is turned over.
            let risen = match way {
                StrokeWay::PushOver => -risen,
                _ => risen,
            };
            let from = match risen > 0.0 {
                true => first.pos - INSIDE * hand.size * first.normal,
                false => first.pos + OUTSIDE * hand.size * first.normal,
            };
            let to = from + risen * first.normal;
            (vec![key(from, begin.turn), key(to, [0; 3])], false)
        }
        StrokeWay::Turn | StrokeWay::TurnInView => {
            let axis = match way {
                StrokeWay::Turn => first.normal,
                _ => back,
            };
            let angle = (TURN * across / seen_across(camera)).round();
            let parts = (angle.abs() / TURN_OF_KEY).ceil().max(1.0);
            let by = (axis * (angle / parts)).round().as_ivec3().to_array();
            let turned = std::iter::repeat_n(key(at, by), parts as usize);
            (std::iter::once(begin).chain(turned).collect(), true)
        }
        StrokeWay::Grow => {
            let grown = (risen / (DOUBLES * seen_across(camera))).exp2();
            let percent = (100.0 * grown).round().clamp(PERCENT[0], PERCENT[1]) as i32;
            let end = ClayKey {
                percent,
                ..key(at, [0; 3])
            };
            (vec![begin, end], false)
        }
    };
    let is_still = keys.windows(2).all(|pair| {
        let [from, to] = pair else { return true };
        from.at == to.at && from.percent == to.percent && to.turn == [0; 3]
    });
    (way == StrokeWay::Smooth || !is_still).then_some(Gesture { keys, is_straight })
}

/// The fewest places whose way stays near to all of a gesture, and whether that is the straight one: a smooth curve
/// through few of them may stray.
fn few(places: &[Vec3], coat: f32) -> (Vec<Vec3>, bool) {
    let tolerance = (OFF_COAT * coat).max(OFF_LEAST);
    for part in [1.0, 0.5, 0.25] {
        let keys = thinned(places, part * tolerance, MAX_KEYS);
        if keys.len() < 3 {
            return (keys, false);
        }
        if is_near(&curve(&keys), places, tolerance) {
            return (keys, false);
        }
    }
    (thinned(places, tolerance, MAX_KEYS), true)
}

/// The smooth way through places, as a clay takes it.
pub fn curve(keys: &[Vec3]) -> Vec<Vec3> {
    let pose = |at: &Vec3| Similarity::new(1.0, DQuat::IDENTITY, at.as_dvec3());
    let poses: Vec<Similarity> = keys.iter().map(pose).collect();
    let way = smooth_path(&poses).into_iter();
    way.map(|pose| pose.place.as_vec3()).collect()
}

/// True if a way passes all places within the tolerance, and goes nowhere else.
fn is_near(way: &[Vec3], places: &[Vec3], tolerance: f32) -> bool {
    let away = |pos: &Vec3, way: &[Vec3]| {
        let pieces = way
            .windows(2)
            .map(|piece| distance_to(*pos, piece[0], piece[1]));
        pieces.fold(f32::INFINITY, f32::min)
    };
    places.iter().all(|pos| away(pos, way) <= tolerance)
        && way.iter().all(|pos| away(pos, places) <= tolerance)
}

/// The curve that a gesture draws in the plane of the picture, as a tool in its own frame: its middle is the origin,
/// and what faced the viewer faces along its z axis. It is as thick as a rod of the size in the hand. `None` of a
/// gesture without length.
pub(super) fn form(hand: &HeldTool, touches: &[Touch], camera: &Camera) -> Option<ToolShape> {
    let radius = HeldTool::THICKNESS * hand.size;
    let way: Vec<Vec3> = touches.iter().map(|touch| touch.pos).collect();
    let tolerance = (0.1 * radius).max(OFF_LEAST);
    let mut points = thinned(&way, tolerance, MAX_TOOL_POINTS);
    let [_, _, back] = camera::axes(camera.rotate);
    let turn = Quat::from_rotation_arc(Vec3::Z, back).inverse();
    points.iter_mut().for_each(|point| *point = turn * *point);
    let around = Aabb::from_points(points.iter().copied());
    if points.len() < 2 || around.size().length() < OFF_LEAST {
        return None;
    }
    let middle = around.center();
    points.iter_mut().for_each(|point| *point -= middle);
    Some(ToolShape::Curve { points, radius })
}

/// As few of the points as lie on a path that all others are near to; at most so many (Douglas and Peucker).
fn thinned(points: &[Vec3], tolerance: f32, most: usize) -> Vec<Vec3> {
    let mut tolerance = tolerance;
    loop {
        let left = simplified_by(points, tolerance, distance_to);
        if left.len() <= most {
            return left;
        }
        tolerance *= 1.5;
    }
}

/// Distance to a straight piece.
fn distance_to(pos: Vec3, from: Vec3, to: Vec3) -> f32 {
    let along = to - from;
    let part = (pos - from).dot(along) / along.length_squared().max(1e-20);
    pos.distance(from + part.clamp(0.0, 1.0) * along)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_turn_of_a_key_is_the_shorter_one() {
        let about_z = |degrees: f32| Quat::from_rotation_z(degrees.to_radians());
        assert_eq!(degrees(about_z(90.0)), [0, 0, 90]);
        assert_eq!(degrees(-about_z(90.0)), [0, 0, 90]);
        assert_eq!(degrees(about_z(270.0)), [0, 0, -90]);
        assert_eq!(degrees(about_z(180.0))[2].abs(), 178);
    }

    #[test]
    fn a_way_is_thinned_to_few_keys_near_it() {
        let way: Vec<Vec3> = (0..400)
            .map(|i| {
                let angle = 0.01 * i as f32;
                Vec3::new(0.3 * angle.cos(), 0.1 * angle, 0.3 * angle.sin())
            })
            .collect();
        let tolerance = 0.004;
        let keys = thinned(&way, tolerance, MAX_KEYS);
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
        assert!(thinned(&wild, 1e-6, MAX_KEYS).len() <= MAX_KEYS);
        assert!(thinned(&[], 0.1, MAX_KEYS).is_empty());
    }

    #[test]
    fn the_smooth_way_stays_near_the_hand() {
        let arc = |i: usize| {
            let angle = 0.02 * i as f32;
            Vec3::new(0.5 - 0.3 * angle.cos(), 0.0, 0.45 + 0.3 * angle.sin())
        };
        let places: Vec<Vec3> = (0..60).map(arc).collect();
        let (keys, is_straight) = few(&places, 0.1);
        assert!(!is_straight && keys.len() < 8, "{} keys", keys.len());
        assert!(is_near(&curve(&keys), &places, 0.1 / 16.0));
        // A corner that a curve would round off.
        let corner = |i: usize| match i < 30 {
            true => Vec3::new(0.01 * i as f32, 0.0, 0.0),
            false => Vec3::new(0.3, 0.01 * (i - 30) as f32, 0.0),
        };
        let places: Vec<Vec3> = (0..60).map(corner).collect();
        let (keys, is_straight) = few(&places, 0.02);
        let way = if is_straight {
            keys.clone()
        } else {
            curve(&keys)
        };
        assert!(is_near(&way, &places, 0.0021), "{keys:?}");
        assert_eq!(few(&[], 0.1).0, []);
    }

    #[test]
    fn a_drawn_form_faces_the_viewer_and_keeps_its_proportions() {
        let camera = Camera::DOCUMENT_DEFAULT;
        let [right, up, back] = camera::axes(camera.rotate);
        let touch = |i: usize| {
            let angle = 0.05 * i as f32;
            Touch {
                pos: Vec3::new(0.2, 0.1, 0.3) + 0.2 * (angle.cos() * right + angle.sin() * up),
                normal: back,
                force: None,
            }
        };
        let half: Vec<Touch> = (0..=63).map(touch).collect();
        let hand = HeldTool::default();
        let Some(ToolShape::Curve { points, radius }) = form(&hand, &half, &camera) else {
            panic!("a curve")
        };
        assert!((3..MAX_TOOL_POINTS).contains(&points.len()), "{points:?}");
        assert_eq!(radius, HeldTool::THICKNESS * hand.size);
        let around = Aabb::from_points(points.iter().copied());
        let off = around.center().abs().max_element();
        assert!(off < 5e-6, "about its middle");
        let sides = around.size();
        assert!(sides.z < 1e-4, "flat: {sides}");
        assert!((sides.x.max(sides.y) - 0.4).abs() < 0.01, "{sides}");
        // Laid on a plane that faces the viewer it is seen as it was drawn.
        let turn = Quat::from_rotation_arc(Vec3::Z, back);
        let ends = turn * (points[points.len() - 1] - points[0]);
        let drawn = half[63].pos - half[0].pos;
        assert!(ends.distance(drawn) < 1e-4, "{ends} and {drawn}");
        assert_eq!(form(&hand, &half[..1], &camera), None);
        assert_eq!(form(&hand, &[], &camera), None);
        // However wild, no more points than a tool has.
        let wild: Vec<Touch> = (0..3000)
            .map(|i| Touch {
                pos: Vec3::new((i % 7) as f32, (i % 11) as f32, (i % 5) as f32),
                ..half[0]
            })
            .collect();
        let points = form(&hand, &wild, &camera).map(|shape| shape.points().len());
        assert!(points.is_some_and(|count| count <= MAX_TOOL_POINTS));
    }
}
