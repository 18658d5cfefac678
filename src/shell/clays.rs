//! Clays, from their recipes to the events that the app waits for.

use std::sync::Arc;

use super::loading::{Post, PostingSink};
use crate::assets::LoadEvent;
use crate::clay::{ClayError, Shaping, box_mm};
use crate::data::{SubjectPart, SubjectSink, Surface, SurfaceError};
use crate::document::Clay;

/// Part of the work that is done when all strokes are.
const STROKES: f32 = 0.8;

/// Shapes clays, and keeps the last, so that the next stroke does not begin anew.
#[derive(Debug, Default)]
pub struct ClayDesk {
    last: Option<(Arc<Clay>, Shaping)>,
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
        let mut shaping = match self.last.take() {
            Some((last, shaping))
                if last.is_like(clay) && clay.strokes.starts_with(&last.strokes) =>
            {
                shaping
            }
            _ => Shaping::new(clay)?,
        };
        let all = clay.strokes.len() as f32;
        while shaping.done() < clay.strokes.len() {
            let done = shaping.done() as f32;
            shaping.stroke(clay, &mut |part| go_on((done + part) / all))?;
        }
        let (_, shaping) = self.last.insert((Arc::clone(clay), shaping));
        Ok(shaping)
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
    use crate::document::{Document, SubjectRef};

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
