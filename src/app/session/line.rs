//! The way of a hand, thinned to the few places that a document keeps of it.

use glam::{IVec3, Vec3};

use crate::document::{MAX_STROKE_PLACES, Stroke};

/// Part of the ball's radius by which the way may be off.
const OFF: f32 = 1.0 / 8.0;
/// Points that wait at most for the next place of the way.
const MOST_WAITING: usize = 200;

/// A way as it grows. A place that was taken stays, so that what is painted does not change behind the hand.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Line {
    /// How far the way may be off, subject units.
    tolerance: f32,
    /// Rest space, subject units.
    places: Vec<Vec3>,
    /// The points since the last place.
    waiting: Vec<Vec3>,
}

impl Line {
    /// A way that begins at a point of rest space, for a ball of this radius, subject units.
    pub(super) fn new(start: Vec3, radius: f32) -> Self {
        Self {
            tolerance: (radius * OFF).max(0.5 / Stroke::PER_UNIT as f32),
            places: vec![start],
            waiting: Vec::new(),
        }
    }

    fn end(&self) -> Vec3 {
        let ends = self.waiting.last().or(self.places.last());
        ends.copied().unwrap_or_default()
    }

    /// Goes on to a point. False if that is where the way ends already.
    pub(super) fn push(&mut self, pos: Vec3) -> bool {
        if pos.distance(self.end()) < 0.5 * self.tolerance {
            return false;
        }
        if let (Some(&from), Some(&last)) = (self.places.last(), self.waiting.last()) {
            let is_near = |p: &Vec3| distance_to_line(*p, [from, pos]) <= self.tolerance;
            if !self.waiting.iter().all(is_near) || self.waiting.len() >= MOST_WAITING {
                self.places.push(last);
                self.waiting.clear();
            }
        }
        self.waiting.push(pos);
        true
    }

    /// Distance of a point from the way.
    pub(super) fn distance(&self, pos: Vec3) -> f32 {
        let mut all = self.places.clone();
        all.extend(self.waiting.last());
        let first = pos.distance(all[0]);
        let lines = all.windows(2);
        lines.fold(first, |least, ends| {
            least.min(distance_to_line(pos, [ends[0], ends[1]]))
        })
    }

    /// The way as strokes: more than one where it has more places than a stroke may have.
    pub(super) fn strokes(&self, erases: bool, radius_mm: f32) -> Vec<Stroke> {
        let all = self.places.iter().chain(self.waiting.last());
        let whole = |pos: &Vec3| -> IVec3 {
            let pos = pos.as_dvec3() * Stroke::PER_UNIT;
            (pos + 0.5).floor().as_ivec3()
        };
        let mut places: Vec<IVec3> = all.map(whole).collect();
        places.dedup();
        let mut strokes = Vec::new();
        let mut start = 0;
        loop {
            let end = (start + MAX_STROKE_PLACES).min(places.len());
            strokes.push(Stroke {
                erases,
                radius_mm,
                places: places[start..end].to_vec(),
            });
            if end == places.len() {
                return strokes;
            }
            // The next one goes on where this one ends.
            start = end - 1;
        }
    }
}

fn distance_to_line(pos: Vec3, [start, end]: [Vec3; 2]) -> f32 {
    let way = end - start;
    let squared = way.length_squared();
    let part = match squared > 0.0 {
        true => ((pos - start).dot(way) / squared).clamp(0.0, 1.0),
        false => 0.0,
    };
    pos.distance(start + way * part)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_way_keeps_few_places_and_stays_near() {
        let radius = 0.03;
        // An arc of a circle as a hand draws it, in three hundred points.
        let points: Vec<Vec3> = (0..300)
            .map(|i| {
                let angle = i as f32 / 300.0 * 1.5;
                let tremor = if i % 2 == 0 { 0.0005 } else { -0.0005 };
                Vec3::new(0.2 * angle.cos() + tremor, 0.2 * angle.sin(), 0.1)
            })
            .collect();
        let mut line = Line::new(points[0], radius);
        for pos in &points[1..] {
            let before = line.places.clone();
            line.push(*pos);
            assert_eq!(line.places[..before.len()], before, "what was taken stays");
        }
        let [stroke] = &line.strokes(true, 7.5)[..] else {
            panic!("one stroke");
        };
        assert_eq!((stroke.erases, stroke.radius_mm), (true, 7.5));
        let count = stroke.places.len();
        assert!((3..=6).contains(&count), "{count} places");
        let places: Vec<Vec3> = stroke
            .places
            .iter()
            .map(|&p| Stroke::in_rest(p).as_vec3())
            .collect();
        for pos in points {
            let off = places
                .windows(2)
                .map(|ends| distance_to_line(pos, [ends[0], ends[1]]));
            let off = off.fold(f32::INFINITY, f32::min);
            assert!(off < radius * OFF + 0.001, "{off} off at {pos}");
        }
    }

    #[test]
    fn a_rest_is_one_place_and_a_long_way_several_strokes() {
        let mut line = Line::new(Vec3::splat(0.1), 0.03);
        assert!(!line.push(Vec3::splat(0.1005)), "a trembling hand");
        let strokes = line.strokes(false, 3.0);
        assert_eq!(strokes.len(), 1);
        assert_eq!(strokes[0].places, [IVec3::splat(100)]);
        // Back and forth two hundred times.
        for i in 0..200 {
            let x = if i % 2 == 0 { 0.3 } else { -0.3 };
            assert!(line.push(Vec3::new(x, 0.01 * i as f32, 0.0)));
        }
        let strokes = line.strokes(false, 3.0);
        assert_eq!(strokes.len(), 4, "{} places", 201);
        for pair in strokes.windows(2) {
            assert_eq!(pair[0].places.len(), MAX_STROKE_PLACES);
            assert_eq!(
                pair[0].places.last(),
                pair[1].places.first(),
                "without a gap"
            );
        }
    }
}
