//! A template laid along a curve, read from the words of the additions to the contract: the map W is written down, its
//! inverse is searched for by halving.

use glam::{DVec2, DVec3};

/// The line as the template's top lies along it, subject units from the corner of the straight box.
pub(super) struct Line {
    places: Vec<DVec2>,
    mitres: Vec<DVec2>,
    size: DVec3,
}

/// Catmull-Rom between b and c, by repeated interpolation (Barry and Goldman) on knots 0, 1, 2, 3.
fn between(a: DVec2, b: DVec2, c: DVec2, d: DVec2, part: f64) -> DVec2 {
    let t = 1.0 + part;
    let mix = |p: DVec2, q: DVec2, from: f64, to: f64| {
        p * ((to - t) / (to - from)) + q * ((t - from) / (to - from))
    };
    let (ab, bc, cd) = (
        mix(a, b, 0.0, 1.0),
        mix(b, c, 1.0, 2.0),
        mix(c, d, 2.0, 3.0),
    );
    mix(mix(ab, bc, 0.0, 2.0), mix(bc, cd, 1.0, 3.0), 1.0, 2.0)
}

impl Line {
    pub(super) fn along(points: &[DVec2], is_spline: bool, size: DVec3) -> Self {
        let spans = points.len() - 1;
        // Each span of a spline in equal pieces of its own parameter, the fewest that make sixteen in all.
        let pieces = match spans {
            3 if is_spline => 18,
            5 if is_spline => 20,
            6 if is_spline => 18,
            7 if is_spline => 21,
            2 | 4 | 8 if is_spline => 16,
            spans => spans,
        };
        let mut places = Vec::new();
        for piece in 0..=pieces {
            let along = piece as f64 * spans as f64 / pieces as f64;
            let i = (along as usize).min(spans - 1);
            let (b, c) = (points[i], points[i + 1]);
            let a = if i > 0 { points[i - 1] } else { b - (c - b) };
            let d = if i + 2 < points.len() {
                points[i + 2]
            } else {
                c + (c - b)
            };
            places.push(between(a, b, c, d, along - i as f64));
        }
        for place in &mut places {
            *place *= DVec2::new(size.x, size.z);
        }
        let normal = |i: usize| (places[i + 1] - places[i]).normalize().perp();
        let last = places.len() - 1;
        let mitres = (0..=last)
            .map(|i| {
                let before = normal(i.max(1) - 1);
                let after = normal(i.min(last - 1));
                // As far along both normals as one unit is high.
                let both = (before + after).normalize();
                both / both.dot(after)
            })
            .collect();
        Self {
            places,
            mitres,
            size,
        }
    }

    fn length(&self) -> f64 {
        self.places.windows(2).map(|p| p[0].distance(p[1])).sum()
    }

    /// W of a place on segment i.
    fn on(&self, i: usize, part: f64, t: f64) -> DVec2 {
        let low = self.places[i] + t * self.mitres[i];
        let high = self.places[i + 1] + t * self.mitres[i + 1];
        low.lerp(high, part)
    }

    /// W(s, t): the place in the bent box's x-z plane at arc length `s` and height `t`.
    fn at(&self, s: f64, t: f64) -> DVec2 {
        let last = self.places.len() - 2;
        let mut start = 0.0;
        for i in 0..=last {
            let way = self.places[i + 1] - self.places[i];
            let length = way.length();
            if s < 0.0 {
                return self.on(0, 0.0, t) + way / length * s;
            }
            if s <= start + length {
                return self.on(i, (s - start) / length, t);
            }
            start += length;
        }
        let way = (self.places[last + 1] - self.places[last]).normalize();
        self.on(last, 1.0, t) + way * (s - start)
    }

    /// s and t of a place; none where no segment has room for it.
    fn inverse(&self, at: DVec2) -> Option<(f64, f64)> {
        let last = self.places.len() - 2;
        let mut start = 0.0;
        let mut found: Option<(f64, f64)> = None;
        for i in 0..=last {
            let step = self.places[i + 1] - self.places[i];
            let (length, way) = (step.length(), step.normalize());
            let from = at - self.places[i];
            let t = from.dot(way.perp());
            let mut s = None;
            if i == 0 && from.dot(way) < 0.0 || i == last && from.dot(way) > length {
                s = Some(start + from.dot(way));
            } else if (self.on(i, 1.0, t) - self.on(i, 0.0, t)).dot(way) > 0.05 * length {
                // How far the place still is ahead of the one at this part.
                let ahead = |part: f64| (at - self.on(i, part, t)).dot(way);
                let (mut low, mut high) = (0.0, 1.0);
                if ahead(low) >= -1e-12 && ahead(high) <= 1e-12 {
                    for _ in 0..80 {
                        let middle = 0.5 * (low + high);
                        if ahead(middle) > 0.0 {
                            low = middle;
                        } else {
                            high = middle;
                        }
                    }
                    s = Some(start + low * length);
                }
            }
            if let Some(s) = s
                && found.is_none_or(|(_, nearest)| t.abs() < nearest.abs())
            {
                found = Some((s, t));
            }
            start += length;
        }
        found
    }

    /// Where a point of the straight box comes from and the continuity there, for a template that does this in the box
    /// it acts in.
    pub(super) fn source(
        &self,
        q: DVec3,
        acts: impl Fn(DVec3, DVec3) -> (DVec3, f64),
    ) -> (DVec3, f64) {
        let Some((s, t)) = self.inverse(DVec2::new(q.x * self.size.x, q.z * self.size.z)) else {
            return (q, 1.0);
        };
        let size = self.size.with_x(self.length());
        let own = DVec3::new(s / size.x, q.y, 1.0 + t / size.z);
        let (source, a) = acts(own, size);
        let at = self.at(source.x * size.x, (source.z - 1.0) * size.z);
        (
            DVec3::new(at.x / self.size.x, source.y, at.y / self.size.z),
            a,
        )
    }
}
