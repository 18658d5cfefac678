use super::{Histogram, Statistics, SubjectPart, SubjectSink, Volume, Voxels};

/// Bytes of the first allocation for voxels. A larger one is made only after as many bytes have arrived.
const FIRST_BYTES: usize = 1024 * 1024;

/// Collects the pieces of a volume from a reader or a generator into a [`Volume`]. Built once per subject.
///
/// Memory grows with the pieces that arrive, not with the promise of a header: it doubles until a quarter of the voxels
/// is there, then grows to the whole at once. At the last step a quarter and the whole are held together, so the peak
/// is 1.25 times the voxels' bytes, plus the slab in hand.
#[derive(Debug, Default)]
pub struct VolumeBuilder<P = fn(f32) -> bool> {
    volume: Option<Volume>,
    statistics: Statistics,
    label_total: usize,
    failure: Option<BuildError>,
    on_progress: Option<P>,
}

/// Why the collected pieces make no volume.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum BuildError {
    /// No header was given, or none that announces this piece.
    #[error("no volume was given")]
    Nothing,
    /// The memory is not to be had.
    #[error("not enough memory for {bytes} bytes of voxels")]
    OutOfMemory {
        /// Bytes that were asked for.
        bytes: u64,
    },
    /// Fewer or more voxels or labels than the header said, or of another type.
    #[error("{found} {what} came where {expected} were announced")]
    Miscounted {
        /// What was counted, for the message: “voxels” or “labels”.
        what: &'static str,
        /// How many the header announced.
        expected: usize,
        /// How many came.
        found: usize,
    },
}

impl VolumeBuilder {
    /// Collects without telling anybody.
    pub fn new() -> Self {
        Self {
            on_progress: None,
            volume: None,
            statistics: Statistics::new(),
            label_total: 0,
            failure: None,
        }
    }
}

impl<P: FnMut(f32) -> bool> VolumeBuilder<P> {
    /// Collects and passes progress (0 to 1) on; the function returns false to stop.
    pub fn with_progress(on_progress: P) -> Self {
        Self {
            on_progress: Some(on_progress),
            volume: None,
            statistics: Statistics::new(),
            label_total: 0,
            failure: None,
        }
    }

    /// The volume, with its value range.
    ///
    /// # Errors
    /// If memory ran out, or other voxels came than were announced.
    pub fn finish(self) -> Result<Volume, BuildError> {
        self.finish_with_histogram().map(|(volume, _)| volume)
    }

    /// The volume and the histogram counted on the way.
    ///
    /// # Errors
    /// If memory ran out, or other voxels came than were announced.
    pub fn finish_with_histogram(self) -> Result<(Volume, Histogram), BuildError> {
        if let Some(failure) = self.failure {
            return Err(failure);
        }
        let mut volume = self.volume.ok_or(BuildError::Nothing)?;
        let expected = volume.grid.voxel_count();
        if volume.voxels.len() != expected {
            return Err(BuildError::Miscounted {
                what: "voxels",
                expected,
                found: volume.voxels.len(),
            });
        }
        if let Some(labels) = &volume.segmentation
            && labels.labels.len() != self.label_total
        {
            return Err(BuildError::Miscounted {
                what: "labels",
                expected: self.label_total,
                found: labels.labels.len(),
            });
        }
        volume.value_range = self.statistics.value_range(volume.slope, volume.intercept);
        let histogram = self.statistics.histogram(volume.slope, volume.intercept);
        Ok((volume, histogram))
    }
}

/// Appends with the growth described at [`VolumeBuilder`]. `next` becomes the collection where that is empty and `next`
/// is all.
fn append<T: Copy>(held: &mut Vec<T>, next: Vec<T>, total: usize) -> Result<(), BuildError> {
    let found = held.len() + next.len();
    if found > total {
        return Err(BuildError::Miscounted {
            what: "voxels",
            expected: total,
            found,
        });
    }
    if held.is_empty() && next.len() == total {
        *held = next;
        return Ok(());
    }
    if found > held.capacity() {
        let size = size_of::<T>();
        let wanted = if found >= total / 4 {
            total
        } else {
            (held.capacity() * 2)
                .max(FIRST_BYTES / size)
                .clamp(found, total)
        };
        held.try_reserve_exact(wanted - held.len())
            .map_err(|_refused| BuildError::OutOfMemory {
                bytes: wanted as u64 * size as u64,
            })?;
    }
    held.extend_from_slice(&next);
    Ok(())
}

impl<P: FnMut(f32) -> bool> VolumeBuilder<P> {
    /// Drops what came before, and waits for the voxels of another volume.
    fn begin(&mut self, header: Volume) -> Result<(), String> {
        let dims = header.grid.dims.as_u64vec3();
        let too_large = dims
            .x
            .checked_mul(dims.y)
            .and_then(|n| n.checked_mul(dims.z))
            .is_none_or(|n| n > isize::MAX as u64 / 4);
        if too_large {
            return Err(format!(
                "{} × {} × {} voxels do not fit into this program's memory",
                dims.x, dims.y, dims.z
            ));
        }
        self.label_total = header
            .segmentation
            .as_ref()
            .map_or(0, |labels| labels.grid.voxel_count());
        self.volume = Some(header);
        self.statistics = Statistics::new();
        self.failure = None;
        Ok(())
    }

    /// Adds scalars or labels to the volume that was announced.
    fn add(&mut self, part: SubjectPart) -> Result<(), BuildError> {
        let volume = self.volume.as_mut().ok_or(BuildError::Nothing)?;
        let total = volume.grid.voxel_count();
        match (part, &mut volume.segmentation) {
            (SubjectPart::Scalars(next), _) => {
                self.statistics.add(&next);
                match (&mut volume.voxels, next) {
                    (Voxels::U8(held), Voxels::U8(next)) => append(held, next, total),
                    (Voxels::I16(held), Voxels::I16(next)) => append(held, next, total),
                    (Voxels::U16(held), Voxels::U16(next)) => append(held, next, total),
                    (Voxels::F32(held), Voxels::F32(next)) => append(held, next, total),
                    _ => Err(BuildError::Miscounted {
                        what: "voxels of the type",
                        expected: total,
                        found: 0,
                    }),
                }
            }
            (SubjectPart::Labels(next), Some(segmentation)) => {
                append(&mut segmentation.labels, next, self.label_total)
            }
            // Nothing of this volume.
            _ => Err(BuildError::Nothing),
        }
    }
}

impl<P: FnMut(f32) -> bool> SubjectSink for VolumeBuilder<P> {
    fn take(&mut self, part: SubjectPart) -> Result<(), String> {
        if let SubjectPart::Volume(header) = part {
            return self.begin(*header);
        }
        if self.failure.is_none() {
            self.failure = self.add(part).err();
        }
        let failure = self.failure.as_ref();
        failure.map_or(Ok(()), |failure| Err(failure.to_string()))
    }

    fn progress(&mut self, fraction: f32) -> bool {
        let on_progress = self.on_progress.as_mut();
        on_progress.is_none_or(|on_progress| on_progress(fraction))
    }
}
