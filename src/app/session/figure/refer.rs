use std::sync::Arc;

use serde_json::{Value, json};

use super::edits::{figure_edit, rounded_places};
use super::place::thinned;
use super::state::{Reference, ReferenceCommand, Takes};
use crate::app::session::effect::Effect;
use crate::app::session::session::Session;
use crate::data::Plate;
use crate::document::figure::{MAX_CONTOURS, MAX_OUTLINE};
use crate::document::{Edit, FigureList};

/// An outline may be off by so much, parts of the picture's longest side.
const OFF: f32 = 0.001;

impl Session {
    pub(super) fn refer(&mut self, command: ReferenceCommand) {
        let wanted = self.places_wanted();
        let figure = &mut self.view.figure;
        match (command, &mut figure.reference) {
            (ReferenceCommand::Open, _) => {
                figure.wants_reference = true;
                self.effect(Effect::OpenFile);
            }
            (ReferenceCommand::Close, reference) => *reference = None,
            (ReferenceCommand::For(takes), Some(reference)) => {
                reference.takes = takes;
                reference.points.clear();
            }
            (ReferenceCommand::Click(at), Some(reference)) => {
                if at.is_finite() && reference.points.len() < wanted {
                    reference.points.push(at);
                }
            }
            (ReferenceCommand::TakeBack, Some(reference)) => {
                reference.points.pop();
            }
            (ReferenceCommand::Take, Some(_)) => self.take_over(),
            (_, None) => {}
        }
    }

    /// Another picture has come, of which places are to be taken over.
    pub fn set_reference(&mut self, plate: Arc<Plate>) {
        let takes = match self.view.figure.region.is_some() {
            true => Takes::Outline,
            false => Takes::Landmarks,
        };
        self.view.figure.reference = Some(Reference {
            plate,
            takes,
            points: Vec::new(),
        });
    }

    /// How many places of the other picture are wanted at most.
    pub fn places_wanted(&self) -> usize {
        let takes = self.view.figure.reference.as_ref().map(|other| other.takes);
        match takes {
            Some(Takes::Landmarks) => {
                let context = self.figure().context.as_ref();
                context.map_or(0, |context| context.points.len())
            }
            Some(Takes::Outline) => MAX_OUTLINE,
            None => 0,
        }
    }

    /// True if the places that were clicked are enough to be taken over.
    pub fn can_take_over(&self) -> bool {
        let figure = &self.view.figure;
        figure
            .reference
            .as_ref()
            .is_some_and(|other| match other.takes {
                Takes::Landmarks => {
                    other.points.len() == self.places_wanted() && other.points.len() > 2
                }
                Takes::Outline => other.points.len() > 2 && figure.region.is_some(),
            })
    }

    fn take_over(&mut self) {
        let Some(other) = self.view.figure.reference.clone() else {
            return;
        };
        if !self.can_take_over() {
            return;
        }
        match other.takes {
            Takes::Landmarks => {
                let like = rounded_places(&other.points);
                self.apply(&figure_edit("context/like", Some(like)), false);
            }
            Takes::Outline => {
                let like = rounded_places(&thinned(&other.points, OFF, MAX_OUTLINE));
                self.take_outline(&like);
            }
        }
        if let Some(other) = &mut self.view.figure.reference {
            other.points.clear();
        }
    }

    /// The selected region takes an outline over, in place of one that it took before.
    fn take_outline(&mut self, like: &Value) {
        let Some(region) = self.view.figure.region.clone() else {
            return;
        };
        let contours = &self.figure().contours;
        let own = contours.iter().position(|contour| contour.region == region);
        let edit = match own {
            Some(index) => figure_edit(&format!("contours/{index}/like"), Some(like.clone())),
            None if contours.len() >= MAX_CONTOURS => return,
            None => Edit::AddToFigure {
                list: FigureList::Contours,
                index: usize::MAX,
                entry: json!({ "region": region, "like": like }),
            },
        };
        self.apply(&edit, false);
    }
}
