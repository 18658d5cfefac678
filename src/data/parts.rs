use std::sync::Arc;

use super::plate::Plate;
use super::surface::Surface;
use super::volume::{Volume, Voxels};

/// A piece of a subject on its way from a reader or a generator to whoever holds, counts or shows the subject.
///
/// A volume is too large to be held twice and comes in pieces; a subject that is small comes whole, as one piece. A new
/// piece is one more variant here, and one more arm where that piece is used. A sink that passes pieces on takes all of
/// them alike, and a sink for volumes alone leaves other pieces to its last arm.
#[derive(Clone, Debug)]
pub enum SubjectPart {
    /// A volume without its voxels, see [`SubjectPart::header`]. The pieces of this volume follow; earlier pieces
    /// belong to a coarser volume.
    Volume(Box<Volume>),
    /// Scalars that follow the ones before, in whole z slices, always of the type that the header announced.
    Scalars(Voxels),
    /// Labels that follow the ones before; only if the header announced a segmentation.
    Labels(Vec<u8>),
    /// A mesh, whole.
    Surface(Arc<Surface>),
    /// The picture of a figure, whole.
    Plate(Arc<Plate>),
}

impl SubjectPart {
    /// Announces a volume: all of it but voxels, whose type its empty variant gives, labels and `value_range`.
    pub fn header(header: Volume) -> Self {
        Self::Volume(Box::new(header))
    }
}

/// Takes a subject in pieces, so that readers and generators never hold it twice: the native program collects the
/// pieces, a browser's worker posts them to the page.
pub trait SubjectSink {
    /// Takes the next piece.
    ///
    /// # Errors
    /// In words: why this sink takes no more pieces, such as a volume that is too large. The sender stops then.
    fn take(&mut self, part: SubjectPart) -> Result<(), String>;

    /// Takes the fraction done, 0 to 1. Returns false if the sender should stop (the user cancelled).
    fn progress(&mut self, fraction: f32) -> bool;
}
