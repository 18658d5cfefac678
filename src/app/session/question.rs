//! Questions to the picture. Each names the command that its answer becomes.

use std::sync::Arc;

use glam::Vec3;

use super::command::Command;
use super::found::Found;
use crate::document::{Camera, Illustration};

/// Asks what surface is seen at a place.
#[derive(Clone, Debug)]
pub struct Question {
    /// The place in the picture or in space that is asked about.
    pub place: Place,
    /// Handed to `reply`, for questions that are asked several at a time.
    pub index: usize,
    /// Makes the command that is run with the answer; `None` where nothing is seen.
    pub reply: fn(usize, Option<Found>) -> Command,
    /// Every click counts: the answers to several, such as the ends of a distance, belong together.
    pub adds: bool,
}

/// Where a question looks.
#[derive(Clone, Debug)]
pub enum Place {
    /// Pixels from the upper left corner of the picture in the window.
    Pixel([f32; 2]),
    /// The middle of the picture in the window.
    Middle,
    /// Where a point of subject space is seen in a view of its own.
    Beside(Arc<Sight>, Vec3),
}

/// A view that is drawn for questions only.
#[derive(Debug)]
pub struct Sight {
    /// The illustration that is drawn; it need not be the one in the window.
    pub illustration: Illustration,
    /// The camera from which `illustration` is drawn.
    pub camera: Camera,
}

impl Question {
    /// A question about a place of the picture.
    pub fn new(place: Place, reply: fn(usize, Option<Found>) -> Command) -> Self {
        let index = 0;
        Self {
            place,
            index,
            reply,
            adds: false,
        }
    }

    /// True if this question makes an earlier one that has no answer yet pointless: a click the click before it unless
    /// both add up, a view of its own other such views.
    pub fn replaces(&self, earlier: &Self) -> bool {
        match (&self.place, &earlier.place) {
            (Place::Beside(new, _), Place::Beside(old, _)) => !Arc::ptr_eq(new, old),
            (Place::Beside(..), _) | (_, Place::Beside(..)) => false,
            _ => !(self.adds && earlier.adds),
        }
    }
}
