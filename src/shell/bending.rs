//! Bends figures off the picture's thread: in a thread natively, in a worker in the page.

use super::figures::hand_over;
use super::loading::{Post, PostingSink};
use crate::assets::{BendAnswer, BendRequest, LoadEvent};
use crate::figure::{Bender, ReadPlate, builtin_plate, unwatched};
use crate::load::LoadReport;

/// One bender, and what it is asked for.
#[derive(Debug, Default)]
pub struct Desk {
    bender: Option<Bender>,
}

impl Desk {
    /// Does what is asked.
    pub fn answer(&mut self, request: BendRequest) -> BendAnswer {
        if let Some(plate) = request.plate {
            // One of another picture is of no use from now on.
            self.bender = None;
            match Bender::new(&plate) {
                Ok(bender) => self.bender = Some(bender),
                Err(error) => return BendAnswer::Failed(error.to_string()),
            }
        }
        let Some(bender) = &mut self.bender else {
            return BendAnswer::Failed("there is no picture to bend".to_owned());
        };
        let bent = match request.rounds {
            Some(rounds) => bender.follow(&request.figure, rounds, &mut unwatched),
            None => bender.bent(&request.figure, &mut unwatched),
        };
        match bent {
            Some(bent) => BendAnswer::Bent {
                sheet: bent.sheet,
                regions: request.rounds.is_none().then_some(bent.regions),
                notices: bent.notices.iter().map(ToString::to_string).collect(),
            },
            None => BendAnswer::Failed("the figure was not bent".to_owned()),
        }
    }
}

/// Makes the plate of a drawing of the program and posts it, and how that ended.
pub fn make_figure(name: &str, post: &mut dyn Post) {
    match builtin_plate(name) {
        Ok(plate) => {
            let mut sink = PostingSink::new(post);
            let mut report = LoadReport::default();
            let read = ReadPlate {
                plate,
                asides: Vec::new(),
            };
            let outcome = hand_over(read, name, &mut sink, &mut report);
            sink.end(outcome, &report, None);
        }
        Err(error) => {
            post.post(LoadEvent::Failed {
                message: error.to_string(),
                details: String::new(),
                fault: None,
            });
        }
    }
}
