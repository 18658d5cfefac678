use super::builder::{BuildError, VolumeBuilder};
use super::parts::{SubjectPart, SubjectSink};
use super::plate::Plate;
use super::statistics::Histogram;
use super::subject::Subject;
use super::surface::Surface;
use std::sync::Arc;

/// Puts a subject together from its pieces. Memory grows as described at [`VolumeBuilder`].
#[derive(Debug, Default)]
pub struct SubjectBuilder {
    volume: Option<VolumeBuilder>,
    surface: Option<Arc<Surface>>,
    plate: Option<Arc<Plate>>,
}

impl SubjectBuilder {
    /// The mesh, if the subject is one.
    pub fn surface(&self) -> Option<&Arc<Surface>> {
        self.surface.as_ref()
    }

    /// The subject, and how often which of its values occur if it has values; `None` if no piece came.
    ///
    /// # Errors
    /// If memory ran out, or other pieces came than were announced.
    pub fn finish(self) -> Option<Result<(Subject, Option<Histogram>), BuildError>> {
        if let Some(surface) = self.surface {
            return Some(Ok((Subject::from(surface), None)));
        }
        if let Some(plate) = self.plate {
            return Some(Ok((Subject::Figure(plate), None)));
        }
        let whole = self.volume?.finish_with_histogram();
        Some(whole.map(|(volume, histogram)| (Subject::from(volume), Some(histogram))))
    }
}

impl SubjectSink for SubjectBuilder {
    /// Scalars and labels of a volume that was not announced are dropped.
    fn take(&mut self, part: SubjectPart) -> Result<(), String> {
        match part {
            SubjectPart::Volume(_) => {
                self.volume = None;
                let mut builder = VolumeBuilder::new();
                builder.take(part)?;
                self.volume = Some(builder);
            }
            SubjectPart::Surface(surface) => self.surface = Some(surface),
            SubjectPart::Plate(plate) => self.plate = Some(plate),
            SubjectPart::Scalars(_) | SubjectPart::Labels(_) => {
                if let Some(volume) = &mut self.volume {
                    volume.take(part)?;
                }
            }
        }
        Ok(())
    }

    fn progress(&mut self, fraction: f32) -> bool {
        let volume = self.volume.as_mut();
        volume.is_none_or(|volume| volume.progress(fraction))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::{Grid, Volume, Voxels};
    use glam::{DAffine3, UVec3};

    fn header(dims: UVec3) -> SubjectPart {
        SubjectPart::header(Volume {
            has_size: true,
            grid: Grid {
                dims,
                world_from_voxel: DAffine3::IDENTITY,
            },
            voxels: Voxels::U8(Vec::new()),
            slope: 1.0,
            intercept: 0.0,
            value_range: [0.0, 0.0],
            segmentation: None,
        })
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
