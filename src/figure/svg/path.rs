use glam::DVec2;

/// Curves are divided so that they are missed by at most this, pixels of the map.
pub(super) const TOLERANCE: f64 = 1.0 / 16.0;
/// Pieces of a curve at most: what is divided further is far outside the drawing.
const MAX_PIECES: f64 = 4096.0;

/// A piece of an outline; it begins where the one before ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Segment {
    /// Begins a new line.
    Move(DVec2),
    /// A straight line.
    Line(DVec2),
    /// A quadratic curve: its control point and its end.
    Quadratic(DVec2, DVec2),
    /// A cubic curve: its control points and its end.
    Cubic(DVec2, DVec2, DVec2),
    /// Back to where the line began.
    Close,
}

/// Lines and curves, as SVG has them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Outline(pub Vec<Segment>);

impl Outline {
    /// The outline with all of its points moved by a map that keeps straight lines straight.
    pub fn mapped(&self, map: impl Fn(DVec2) -> DVec2) -> Self {
        let segment = |segment: &Segment| match *segment {
            Segment::Move(to) => Segment::Move(map(to)),
            Segment::Line(to) => Segment::Line(map(to)),
            Segment::Quadratic(control, to) => Segment::Quadratic(map(control), map(to)),
            Segment::Cubic(one, other, to) => Segment::Cubic(map(one), map(other), map(to)),
            Segment::Close => Segment::Close,
        };
        Self(self.0.iter().map(segment).collect())
    }

    /// True if all of its points are somewhere.
    pub(crate) fn is_finite(&self) -> bool {
        self.0.iter().all(|segment| match segment {
            Segment::Move(to) | Segment::Line(to) => to.is_finite(),
            Segment::Quadratic(control, to) => control.is_finite() && to.is_finite(),
            Segment::Cubic(one, other, to) => [one, other, to].iter().all(|at| at.is_finite()),
            Segment::Close => true,
        })
    }

    /// The pieces with the points that they begin at; a line that is closed has the straight piece back.
    pub(crate) fn pieces(&self) -> Vec<Piece> {
        let mut pieces = Vec::new();
        let (mut first, mut at) = (DVec2::ZERO, DVec2::ZERO);
        for segment in &self.0 {
            let from = at;
            let (curve, to) = match *segment {
                Segment::Move(to) => {
                    first = to;
                    (Curve::Move, to)
                }
                Segment::Line(to) => (Curve::Line, to),
                Segment::Quadratic(control, to) => (Curve::Quadratic(control), to),
                Segment::Cubic(one, other, to) => (Curve::Cubic(one, other), to),
                Segment::Close => (Curve::Close, first),
            };
            at = to;
            pieces.push(Piece { from, curve, to });
        }
        pieces
    }

    /// Closed lines that miss the outline by at most `tolerance`; those that are open are closed, as filling does.
    pub fn flattened(&self, tolerance: f64) -> Vec<Vec<DVec2>> {
        let mut lines: Vec<Vec<DVec2>> = Vec::new();
        for piece in self.pieces() {
            if matches!(piece.curve, Curve::Move) || lines.is_empty() {
                lines.push(vec![piece.to]);
            } else if let Some(line) = lines.last_mut() {
                let n = piece.count(tolerance);
                line.extend((1..=n).map(|i| piece.at(f64::from(i) / f64::from(n))));
            }
        }
        lines.retain(|line| line.len() > 1);
        lines
    }
}

/// A piece of an outline with both of its ends.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Piece {
    pub(crate) from: DVec2,
    pub(crate) curve: Curve,
    pub(crate) to: DVec2,
}

/// What lies between the ends of a piece.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Curve {
    Move,
    Line,
    Quadratic(DVec2),
    Cubic(DVec2, DVec2),
    Close,
}

impl Piece {
    /// The point at a parameter, 0 to 1.
    pub(crate) fn at(&self, t: f64) -> DVec2 {
        if t >= 1.0 {
            return self.to;
        }
        let s = 1.0 - t;
        match self.curve {
            Curve::Move => self.to,
            Curve::Line | Curve::Close => s * self.from + t * self.to,
            Curve::Quadratic(control) => {
                s * s * self.from + 2.0 * s * t * control + t * t * self.to
            }
            Curve::Cubic(one, other) => {
                s * s * s * self.from
                    + 3.0 * s * s * t * one
                    + 3.0 * s * t * t * other
                    + t * t * t * self.to
            }
        }
    }

    /// Straight pieces that miss it by at most `tolerance`: an eighth of the largest second derivative over the square
    /// of their number.
    pub(crate) fn count(&self, tolerance: f64) -> u32 {
        let second = |a: DVec2, b: DVec2, c: DVec2| (a - 2.0 * b + c).length();
        let largest = match self.curve {
            Curve::Move | Curve::Line | Curve::Close => 0.0,
            Curve::Quadratic(control) => 2.0 * second(self.from, control, self.to),
            Curve::Cubic(one, other) => {
                6.0 * second(self.from, one, other).max(second(one, other, self.to))
            }
        };
        (largest / (8.0 * tolerance))
            .sqrt()
            .ceil()
            .clamp(1.0, MAX_PIECES) as u32
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::dvec2;

    #[test]
    fn a_circle_is_divided_finely_enough() {
        // Four cubic curves miss a circle by 0.03 %.
        let k = 0.552_284_75 * 100.0;
        let quarter =
            |x: DVec2, y: DVec2| Segment::Cubic(100.0 * x + k * y, 100.0 * y + k * x, 100.0 * y);
        let (x, y) = (DVec2::X, DVec2::Y);
        let circle = Outline(vec![
            Segment::Move(100.0 * x),
            quarter(x, y),
            quarter(y, -x),
            quarter(-x, -y),
            quarter(-y, x),
            Segment::Close,
        ]);
        for tolerance in [1.0, 1.0 / 16.0, 0.01] {
            let lines = circle.flattened(tolerance);
            let middles = lines[0].windows(2).map(|ends| (ends[0] + ends[1]) / 2.0);
            let most = middles
                .map(|p| (p.length() - 100.0).abs())
                .fold(0.0, f64::max);
            assert!(most <= tolerance + 0.03, "{tolerance}: {most}");
        }
    }

    #[test]
    fn open_lines_are_closed_and_points_are_none() {
        let outline = Outline(vec![
            Segment::Move(dvec2(1.0, 1.0)),
            Segment::Move(dvec2(0.0, 0.0)),
            Segment::Line(dvec2(1.0, 0.0)),
            Segment::Line(dvec2(1.0, 1.0)),
        ]);
        assert_eq!(
            outline.flattened(0.1),
            [vec![dvec2(0.0, 0.0), dvec2(1.0, 0.0), dvec2(1.0, 1.0)]],
            "one line"
        );
    }
}
