//! A clay that is opened is seen at once as it starts, and then as far as its strokes are done (spec/sweepers.md, B.5).

/// Strokes up to which a clay is done at once.
const FEW: usize = 2;
/// Strokes from one picture to the next, at first.
const FIRST: usize = 8;
/// Seconds from one picture to the next: more strokes are done where they take less, fewer where they take more.
const SECONDS: [f64; 2] = [1.0, 3.0];

/// How far a clay that was opened is.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Growing {
    /// Strokes of the picture that was asked for last, and when that was, seconds of the session.
    asked: Option<(usize, f64)>,
    /// Strokes until the next one.
    step: usize,
}

impl Growing {
    /// Strokes of the picture that was asked for last.
    pub(super) fn asked(&self) -> Option<usize> {
        Some(self.asked?.0)
    }

    /// Strokes of the next picture, once the one of `done` strokes is seen.
    pub(super) fn next(&mut self, done: Option<usize>, all: usize, now: f64) -> usize {
        let until = match self.asked {
            None => {
                self.step = FIRST;
                if all > FEW { 0 } else { all }
            }
            Some((asked, _)) if done != Some(asked) => return asked,
            Some((asked, since)) => {
                let [least, most] = SECONDS;
                // The start alone tells nothing of strokes.
                if asked > 0 && now - since < least {
                    self.step *= 2;
                } else if now - since > most {
                    self.step = (self.step / 2).max(1);
                }
                // No last picture of a few strokes.
                match asked + self.step {
                    until if until + self.step / 2 >= all => all,
                    until => until,
                }
            }
        };
        self.asked = Some((until, now));
        until
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Pictures of a clay of so many strokes, which take as long as `seconds` says of the strokes done for one.
    fn pictures(all: usize, seconds: impl Fn(usize) -> f64) -> Vec<usize> {
        let mut growing = Growing::default();
        let (mut seen, mut now) = (Vec::new(), 5.0);
        while seen.last() != Some(&all) {
            let done = seen.last().copied();
            let until = growing.next(done, all, now);
            // Asked again before it is seen, it is the same.
            assert_eq!(growing.next(done, all, now + 0.1), until);
            now += seconds(until - done.unwrap_or(0));
            seen.push(until);
        }
        seen
    }

    #[test]
    fn pictures_come_as_fast_as_strokes_are_done() {
        assert_eq!(pictures(0, |_| 0.1), [0]);
        assert_eq!(pictures(2, |_| 0.1), [2]);
        assert_eq!(pictures(3, |_| 0.1), [0, 3]);
        assert_eq!(
            pictures(40, |strokes| 0.2 * strokes as f64),
            [0, 8, 16, 24, 32, 40]
        );
        assert_eq!(pictures(40, |_| 0.3), [0, 8, 24, 40]);
        let slow = pictures(30, |strokes| strokes as f64);
        assert_eq!(slow, [0, 8, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30]);
        // Thousands of strokes that take no time are a dozen pictures.
        assert!(pictures(2000, |_| 0.1).len() < 12);
    }
}
