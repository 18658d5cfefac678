//! Clays, from their recipes to the events that the app waits for.

use std::sync::Arc;

use super::loading::{Post, PostingSink};
use crate::assets::LoadEvent;
use crate::clay::{ClayError, Shaping, box_mm};
use crate::data::{SubjectPart, SubjectSink, Surface, SurfaceError};
use crate::document::Clay;

/// Part of the work that is done when all strokes are.
const STROKES: f32 = 0.8;

/// Bytes of earlier states that are kept at most, and strokes that they are of.
const MOST_KEPT: usize = 64 << 20;
const LAST_STROKES: usize = 50;

/// Shapes clays, and keeps what the last strokes left, so that another last stroke, or one less, does not begin anew.
#[derive(Debug, Default)]
pub struct ClayDesk {
    last: Option<Arc<Clay>>,
    /// The clay of `last` after some of its strokes, the latest last.
    kept: Vec<Shaping>,
}

impl ClayDesk {
    /// The clay as its recipe has it. `go_on` hears how far it is, 0 to 1, and stops it by `false`.
    ///
    /// # Errors
    /// [`ClayError`].
    pub fn shape(
        &mut self,
        clay: &Arc<Clay>,
        go_on: &mut dyn FnMut(f32) -> bool,
    ) -> Result<&Shaping, ClayError> {
        let common = self
            .last
            .as_ref()
            .and_then(|last| last.strokes_shared(clay));
        self.kept
            .retain(|kept| common.is_some_and(|common| kept.done() <= common));
        self.last = Some(Arc::clone(clay));
        let all = clay.strokes.len();
        let mut shaping = match self.kept.last() {
            Some(kept) => kept.clone(),
            None => Shaping::new(clay)?,
        };
        self.keep(&shaping, all);
        while shaping.done() < all {
            let done = shaping.done() as f32;
            shaping.stroke(clay, &mut |part| go_on((done + part) / all as f32))?;
            self.keep(&shaping, all);
        }
        // What was shaped last is always kept.
        self.kept.last().ok_or(ClayError::Stopped)
    }

    /// Keeps a state, if it is one of the last, in place of the earliest ones where there is no room.
    fn keep(&mut self, shaping: &Shaping, all: usize) {
        let is_here = self
            .kept
            .last()
            .is_some_and(|kept| kept.done() == shaping.done());
        if is_here || shaping.done() + LAST_STROKES < all {
            return;
        }
        self.kept.push(shaping.clone());
        let mut bytes: usize = self.kept.iter().map(Shaping::bytes).sum();
        while bytes > MOST_KEPT && self.kept.len() > 1 {
            bytes -= self.kept.remove(0).bytes();
        }
    }
}

/// Shapes a clay and prepares it to be drawn.
///
/// # Errors
/// [`ClayError`].
pub fn surface_of_clay(
    desk: &mut ClayDesk,
    clay: &Arc<Clay>,
    go_on: &mut dyn FnMut(f32) -> bool,
) -> Result<(Arc<Surface>, Vec<String>), ClayError> {
    let shaping = desk.shape(clay, &mut |part| go_on(STROKES * part))?;
    let mesh = shaping.shaped().mesh();
    let surface = Surface::of(&[(&mesh, None)], Some(box_mm()), &mut |part| {
        go_on(STROKES + (1.0 - STROKES) * part)
    });
    match surface {
        Ok(surface) => Ok((Arc::new(surface), shaping.notices())),
        Err(SurfaceError::Stopped) => Err(ClayError::Stopped),
        Err(why) => Err(ClayError::NoSurface(why.to_string())),
    }
}

/// Shapes a clay and posts it, what there is to say, and how it ended.
pub fn make_clay(desk: &mut ClayDesk, clay: &Arc<Clay>, post: &mut dyn Post) {
    let mut sink = PostingSink::of(post, "Shaping");
    let made = surface_of_clay(desk, clay, &mut |part| sink.progress(part));
    let event = match made {
        Ok((surface, notices)) => {
            let is_taken = sink.take(SubjectPart::Surface(surface)).is_ok();
            if !is_taken {
                post.post(LoadEvent::Cancelled);
                return;
            }
            for notice in notices {
                post.post(LoadEvent::Notice(notice));
            }
            LoadEvent::Done { sha256: None }
        }
        Err(ClayError::Stopped) => LoadEvent::Cancelled,
        Err(error) => LoadEvent::Failed {
            message: error.to_string(),
            details: String::new(),
            fault: None,
        },
    };
    post.post(event);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::{ClayTool, Document, SubjectRef};

    const PULLED: &str = r#"{ "fabrica": 1, "subject": { "clay": { "detail": 0.05, "tools": [{ "radius": 0.1 }],
        "strokes": [{ "path": [0, 0, 440, 0, 0, 300] }, { "path": [440, 0, 0, 200, 0, 0] }] } } }"#;

    fn pulled() -> Arc<Clay> {
        let document = Document::from_json(PULLED).unwrap();
        match &document.illustration().subject {
            SubjectRef::Clay(clay) => Arc::clone(clay),
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn a_clay_goes_on_where_it_was() {
        let clay = pulled();
        let mut desk = ClayDesk::default();
        let mut heard = Vec::new();
        desk.shape(&clay.cut(1), &mut |part| {
            heard.push(part);
            true
        })
        .unwrap();
        assert!(heard.is_sorted());
        heard.clear();
        let went_on = desk.shape(&clay, &mut |part| {
            heard.push(part);
            true
        });
        let went_on = went_on.unwrap().shaped();
        assert!(heard[0] >= 0.5, "the first stroke is not done again");
        let anew = ClayDesk::default()
            .shape(&clay, &mut |_| true)
            .unwrap()
            .shaped();
        assert_eq!(went_on, anew);
        let back = desk.shape(&clay.cut(1), &mut |_| true).unwrap().shaped();
        assert_ne!(back.positions, anew.positions);
    }

    /// The last stroke taken back, and another drawn: nothing before it is done again, and all is as if made anew.
    #[test]
    fn another_last_stroke_does_no_other_again() {
        let clay = pulled();
        let mut desk = ClayDesk::default();
        desk.shape(&clay, &mut |_| true).unwrap();
        let mut others = Vec::new();
        for (moved, percent) in [(100, 100), (150, 120)] {
            let mut other = Clay::clone(&clay);
            let key = &mut other.strokes[1].moves[0].keys[1];
            (key.at[0], key.percent) = (key.at[0] + moved, percent);
            others.push(Arc::new(other));
        }
        // With one more tool, which no stroke before names.
        let mut other = Clay::clone(&clay);
        other.tools.push(ClayTool::default());
        other.strokes[1].moves[0].tool = 1;
        others.push(Arc::new(other));
        others.push(clay.cut(1));
        for other in others {
            let mut heard = Vec::new();
            let mut hear = |part| {
                heard.push(part);
                true
            };
            let shaped = desk.shape(&other, &mut hear).unwrap().shaped();
            assert!(heard.first().is_none_or(|first| *first >= 0.5), "{heard:?}");
            let anew = ClayDesk::default()
                .shape(&other, &mut |_| true)
                .unwrap()
                .shaped();
            assert_eq!(shaped, anew);
        }
        // Another tool under the first stroke begins anew.
        let mut other = Clay::clone(&clay);
        other.tools[0].coat = 0.2;
        let mut is_first = false;
        let mut hear = |part: f32| {
            is_first |= part < 0.5;
            true
        };
        desk.shape(&Arc::new(other), &mut hear).unwrap();
        assert!(is_first);
    }

    #[test]
    fn a_surface_comes_and_then_the_end() {
        let mut events = Vec::new();
        make_clay(
            &mut ClayDesk::default(),
            &pulled(),
            &mut |event: LoadEvent| {
                events.push(event);
                true
            },
        );
        let parts = events
            .iter()
            .filter(|event| matches!(event, LoadEvent::Part(_)));
        assert_eq!(parts.count(), 1);
        assert!(matches!(
            events.last(),
            Some(LoadEvent::Done { sha256: None })
        ));
        let mut stopped = Vec::new();
        make_clay(
            &mut ClayDesk::default(),
            &pulled(),
            &mut |event: LoadEvent| {
                stopped.push(event);
                false
            },
        );
        assert!(matches!(stopped.last(), Some(LoadEvent::Cancelled)));
    }

    /// The unit stays that of the starting shape, however far a clay is pulled.
    #[test]
    fn strokes_move_no_unit() {
        let clay = pulled();
        let mut desk = ClayDesk::default();
        let mut frame = |strokes| {
            let made = surface_of_clay(&mut desk, &clay.cut(strokes), &mut |_| true);
            made.unwrap().0.frame
        };
        let (start, end) = (frame(0), frame(2));
        assert_eq!(start.mm_per_unit, 100.0);
        assert_eq!(start.mm_per_unit, end.mm_per_unit);
        assert!(start.middle_mm.distance(end.middle_mm) < 1e-9);
        assert!(end.bounds.max.z > start.bounds.max.z + 0.2);
    }
}
