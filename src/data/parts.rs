use super::builder::{BuildError, VolumeBuilder};
use super::statistics::Histogram;
use super::subject::Subject;
use super::volume::{Volume, VolumeSink, Voxels};

/// A piece of a subject on its way from a reader or a generator to whoever shows it.
#[derive(Clone, Debug)]
pub enum SubjectPart {
    /// A volume without its voxels, as [`VolumeSink::begin`] takes it. The pieces of this volume follow; earlier pieces
    /// belong to a coarser volume.
    Volume(Box<Volume>),
    /// Scalars that follow the ones before.
    Scalars(Voxels),
    /// Labels that follow the ones before.
    Labels(Vec<u8>),
}

/// Puts a subject together from its pieces. Memory grows as described at [`VolumeBuilder`].
#[derive(Debug, Default)]
pub struct SubjectBuilder {
    volume: Option<VolumeBuilder>,
}

impl SubjectBuilder {
    /// Takes the next piece. Scalars and labels of a volume that was not announced are dropped.
    ///
    /// # Errors
    /// In words: why the subject cannot be held.
    pub fn take(&mut self, part: SubjectPart) -> Result<(), String> {
        match part {
            SubjectPart::Volume(header) => {
                self.volume = None;
                let mut builder = VolumeBuilder::new();
                builder.begin(&header)?;
                self.volume = Some(builder);
            }
            SubjectPart::Scalars(scalars) => self.scalars(scalars),
            SubjectPart::Labels(labels) => self.labels(labels),
        }
        Ok(())
    }

    /// The subject, and how often which of its values occur if it has values; `None` if no piece came.
    ///
    /// # Errors
    /// If memory ran out, or other pieces came than were announced.
    pub fn finish(self) -> Option<Result<(Subject, Option<Histogram>), BuildError>> {
        let whole = self.volume?.finish_with_histogram();
        Some(whole.map(|(volume, histogram)| (Subject::from(volume), Some(histogram))))
    }
}

impl VolumeSink for SubjectBuilder {
    fn begin(&mut self, header: &Volume) -> Result<(), String> {
        self.take(SubjectPart::Volume(Box::new(header.clone())))
    }

    fn scalars(&mut self, next: Voxels) {
        if let Some(builder) = &mut self.volume {
            builder.scalars(next);
        }
    }

    fn labels(&mut self, next: Vec<u8>) {
        if let Some(builder) = &mut self.volume {
            builder.labels(next);
        }
    }

    fn progress(&mut self, fraction: f32) -> bool {
        let builder = self.volume.as_mut();
        builder.is_none_or(|builder| builder.progress(fraction))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::Grid;
    use glam::{DAffine3, UVec3};

    fn header(dims: UVec3) -> SubjectPart {
        SubjectPart::Volume(Box::new(Volume {
            grid: Grid {
                dims,
                world_from_voxel: DAffine3::IDENTITY,
            },
            voxels: Voxels::U8(Vec::new()),
            slope: 1.0,
            intercept: 0.0,
            value_range: [0.0, 0.0],
            segmentation: None,
        }))
    }

    #[test]
    fn a_finer_volume_takes_the_place_of_a_coarser_one() {
        let mut builder = SubjectBuilder::default();
        for part in [
            header(UVec3::new(2, 1, 1)),
            SubjectPart::Scalars(Voxels::U8(vec![7, 9])),
            header(UVec3::new(3, 1, 1)),
            SubjectPart::Scalars(Voxels::U8(vec![1, 2])),
            SubjectPart::Scalars(Voxels::U8(vec![5])),
        ] {
            builder.take(part).expect("it can be held");
        }
        let (subject, histogram) = builder.finish().expect("it came").expect("it is whole");
        let volume = subject.values().expect("it has values");
        assert_eq!(volume.voxels, Voxels::U8(vec![1, 2, 5]));
        assert_eq!(volume.value_range, [1.0, 5.0]);
        let counted: u64 = histogram.expect("of its values").counts.iter().sum();
        assert_eq!(counted, 3, "values of the coarser one do not count");
    }

    #[test]
    fn pieces_that_were_not_announced_make_no_subject() {
        let mut builder = SubjectBuilder::default();
        let scalars = SubjectPart::Scalars(Voxels::U8(vec![1]));
        builder.take(scalars).expect("dropped");
        assert!(builder.finish().is_none(), "nothing was announced");

        let mut builder = SubjectBuilder::default();
        let too_large = header(UVec3::splat(u32::MAX));
        assert!(builder.take(too_large).is_err(), "no memory is so large");
        assert!(builder.finish().is_none(), "and nothing is left of it");
    }

    #[test]
    fn what_is_not_whole_is_an_error() {
        let mut builder = SubjectBuilder::default();
        builder.take(header(UVec3::new(2, 1, 1))).expect("it fits");
        assert!(
            builder.finish().expect("it came").is_err(),
            "no voxels came"
        );
    }
}
