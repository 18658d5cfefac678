//! Bends figures off the picture's thread: in a thread natively, in a worker in the page.

use super::figures::hand_over;
use super::loading::{Post, PostingSink};
use crate::assets::{BendAnswer, BendPose, BendRequest, LoadEvent};
use crate::figure::{Bender, ReadPlate, builtin_plate};
use crate::load::LoadReport;

/// One bender, and what it is asked for.
#[derive(Debug, Default)]
pub struct Desk {
    bender: Option<Bender>,
}

impl Desk {
    /// Does what is asked. `tell` hears how far a pose at rest is, 0 to 1, and says whether it is still wanted.
    pub fn answer(
        &mut self,
        request: BendRequest,
        tell: &mut dyn FnMut(f32) -> bool,
    ) -> BendAnswer {
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
        if request.pose == BendPose::Finer {
            let finer = bender.original().finer();
            let none = || BendAnswer::Failed("the picture has no more pixels".to_owned());
            return finer.map_or_else(none, BendAnswer::Finer);
        }
        let mut told = 0;
        let mut progress = |part: f32| {
            let percent = (part * 100.0) as u32;
            std::mem::replace(&mut told, percent) == percent || tell(part)
        };
        let figure = &request.figure;
        let bent = match request.pose {
            BendPose::AtRest | BendPose::Finer => bender.bent(figure, &mut progress),
            BendPose::Following(rounds) => bender.follow(figure, rounds, &mut progress),
            BendPose::Aside => bender.bent_aside(figure, &mut progress),
        };
        match bent {
            Some(bent) => BendAnswer::Bent {
                sheet: bent.sheet,
                regions: (request.pose == BendPose::AtRest).then_some(bent.regions),
                notices: bent.notices.iter().map(ToString::to_string).collect(),
            },
            None => {
                self.bender = None;
                BendAnswer::Stopped
            }
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
