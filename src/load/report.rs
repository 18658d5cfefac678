use std::fmt;

use glam::UVec3;

use crate::data::Segment;

/// Something about a file that a reader had to decide or repair, and the user should know.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Warning {
    /// The file does not say how the grid lies in the patient.
    NoOrientation,
    /// The orientation it gives cannot be: another was taken.
    BadOrientation {
        /// The part that cannot be used.
        field: &'static str,
        /// The orientation that was taken instead.
        instead: &'static str,
    },
    /// A voxel size is 0, negative or no number, and was repaired.
    BadSpacing {
        /// Grid axis, 0 to 2.
        axis: usize,
        /// The voxel size in the file.
        found: f32,
        /// The size that was taken instead, mm.
        instead: f32,
    },
    /// Slope 0 with an intercept: by the standard neither is applied.
    SlopeZero,
    /// Slope or intercept is no usable number; values are taken as stored.
    BadScale {
        /// Factor of the stored values, as the file gives it.
        slope: f32,
        /// Offset of the stored values, as the file gives it.
        intercept: f32,
    },
    /// Voxels that were NaN or infinite and are now 0.
    NotFinite {
        /// Number of such voxels.
        count: u64,
    },
    /// Voxels too large for what the picture can show, taken as the largest possible.
    Clipped {
        /// Number of such voxels.
        count: u64,
    },
    /// Whole numbers beyond 2²⁴, rounded to 24 bits.
    Rounded {
        /// Number of such voxels.
        count: u64,
    },
    /// All voxels of the volume are equal: there is nothing to see.
    Constant {
        /// The value that all voxels have.
        value: f32,
    },
    /// Bytes after the last voxel that the header does not explain.
    TrailingBytes,
    /// The file holds several volumes; one was taken.
    Frames {
        /// How many it holds.
        count: u64,
        /// The one taken, from 0.
        shown: u64,
    },
    /// Complex voxels: their magnitude is shown.
    Magnitude,
    /// Colours: their brightness is shown.
    Luminance,
    /// DICOM: slices are missing between others; their neighbours are shown there.
    MissingSlices {
        /// Number of missing slices.
        count: u64,
    },
    /// DICOM: more than one image at the same place; the first is shown.
    DoubledSlices {
        /// How many are left out.
        count: u64,
    },
    /// DICOM: slices lie at uneven distances and are drawn evenly.
    UnevenSlices {
        /// The smallest distance, mm.
        smallest_mm: f64,
        /// The largest distance of neighbours, mm.
        largest_mm: f64,
    },
    /// DICOM: slices do not lie square on each other, as the gantry was tilted.
    Tilted {
        /// Tilt of the gantry, degrees.
        degrees: f64,
    },
    /// DICOM: nothing says how large a pixel is.
    NoPixelSpacing,
    /// DICOM: images that are left out because they cannot be read.
    LeftOut {
        /// Number of images that are left out.
        count: u64,
    },
    /// Voxels that belong to several segments; the last is shown.
    OverlappingSegments {
        /// Number of such voxels.
        count: u64,
    },
    /// A header field is out of order but could be read around.
    Repaired {
        /// Name of the field, as the format has it.
        field: &'static str,
        /// What is wrong with the field, and how the reader went on.
        what: String,
    },
    /// A mesh was repaired, or something of it is left aside.
    Mesh {
        /// What was done, or what is left aside.
        what: String,
    },
    /// What of a figure is drawn otherwise than its file has it, or is left aside.
    Figure {
        /// What it is and what was done, in words.
        what: String,
    },
    /// Label names in the file could not be understood.
    LabelNames,
    /// Segments on several layers: only the first layer is shown.
    Layers {
        /// How many there are.
        count: u64,
    },
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoOrientation => f.write_str(
                "the file does not say which way the patient lies: left and right, front and back may be exchanged",
            ),
            Self::BadOrientation { field, instead } => {
                write!(f, "the orientation in {field} cannot be; {instead} was taken")
            }
            Self::BadSpacing { axis, found, instead } => write!(
                f,
                "voxel size {found} along axis {} cannot be; {instead} mm was taken",
                axis + 1
            ),
            Self::SlopeZero => f.write_str("the slope is 0, so the intercept is not applied either"),
            Self::BadScale { slope, intercept } => write!(
                f,
                "slope {slope} and intercept {intercept} cannot be applied; values are as stored"
            ),
            Self::NotFinite { count } => write!(f, "{count} voxels that are no number are shown as 0"),
            Self::Clipped { count } => write!(f, "{count} voxels are too large and were clipped"),
            Self::Rounded { count } => {
                write!(f, "{count} voxels are beyond 16,777,216 and were rounded")
            }
            Self::Constant { value } => {
                write!(f, "every voxel has the value {value}: there is nothing to see")
            }
            Self::TrailingBytes => f.write_str("there are bytes after the last voxel; they were left out"),
            Self::Frames { count, shown } => {
                write!(f, "the file holds {count} volumes; number {} is shown", shown + 1)
            }
            Self::Magnitude => f.write_str("the voxels are complex numbers; their magnitude is shown"),
            Self::Luminance => f.write_str(
                "the voxels are colours; their brightness is shown, coloured by the transfer function",
            ),
            Self::MissingSlices { count } => write!(
                f,
                "{count} slices are missing; their neighbours are shown in their place"
            ),
            Self::DoubledSlices { count } => write!(
                f,
                "{count} images lie where others do already; the first at each place is shown"
            ),
            Self::UnevenSlices { smallest_mm, largest_mm } => write!(
                f,
                "slices lie from {smallest_mm:.2} to {largest_mm:.2} mm apart and are drawn evenly: lengths across them are not exact"
            ),
            Self::Tilted { degrees } => write!(
                f,
                "the gantry was tilted: slices are shifted against each other by {degrees:.1}°, and drawn as they lie"
            ),
            Self::NoPixelSpacing => f.write_str("nothing says how large a pixel is; 1 mm was taken"),
            Self::LeftOut { count } => write!(f, "{count} DICOM files cannot be read and are left out"),
            Self::OverlappingSegments { count } => {
                write!(f, "{count} voxels belong to several segments; the last is shown")
            }
            Self::Repaired { field, what } => write!(f, "{field}: {what}"),
            Self::Mesh { what } | Self::Figure { what } => f.write_str(what),
            Self::LabelNames => f.write_str("the names of the labels could not be read"),
            Self::Layers { count } => write!(
                f,
                "the segments overlap on {count} layers; only the first layer is shown"
            ),
        }
    }
}

/// File formats that are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// NIfTI-1 in one file.
    Nifti1,
    /// NIfTI-1 header and image in two files.
    Nifti1Pair,
    /// NIfTI-2 in one file.
    Nifti2,
    /// NIfTI-2 header and image in two files.
    Nifti2Pair,
    /// Analyze 7.5, the pair before NIfTI.
    Analyze,
    /// NRRD, attached or detached.
    Nrrd,
    /// MetaImage, .mha or .mhd.
    MetaImage,
    /// DICOM, one file or many.
    Dicom,
    /// Bare voxels whose layout the user gave.
    Raw,
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Nifti1 => "NIfTI-1",
            Self::Nifti1Pair => "NIfTI-1 pair",
            Self::Nifti2 => "NIfTI-2",
            Self::Nifti2Pair => "NIfTI-2 pair",
            Self::Analyze => "Analyze 7.5",
            Self::Nrrd => "NRRD",
            Self::MetaImage => "MetaImage",
            Self::Dicom => "DICOM",
            Self::Raw => "raw voxels",
        })
    }
}

/// What reading a file found out beside the voxels. Filled as reading goes on, so it is of use after an error too.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LoadReport {
    /// What the user should know, in the order found.
    pub warnings: Vec<Warning>,
    /// The format, once recognised.
    pub format: Option<Format>,
    /// Voxel type in the file, in the format's own word.
    pub stored_type: &'static str,
    /// Full size in voxels.
    pub dims: UVec3,
    /// What made the images, as DICOM abbreviates it ("CT", "MR"); `None` where the file does not tell.
    pub modality: Option<String>,
    /// Volumes in the file: time points, components.
    pub frame_count: u64,
    /// Names and colours of labels that the file brings.
    pub segments: Vec<Segment>,
    /// True if the voxels are labels by the header.
    pub is_labels: bool,
    /// The components of a voxel are a vector by the header.
    pub is_vectors: bool,
    /// What takes the file's vectors to RAS+, if it holds vectors (see [`super::read_field`]).
    pub vector_signs: [i8; 3],
    /// SHA-256 over the bytes of the file as they lie on disk; of several files, one after the other in the order
    /// opened, the header first; of several DICOM files, over the sorted hashes of each. `None` until all was read.
    pub sha256: Option<[u8; 32]>,
    /// Bytes read, as they lie on disk.
    pub bytes_read: u64,
    /// The header has no field for the size of voxels; 1 mm was taken.
    pub lacks_spacing: bool,
}

/// A name out of a file, made fit for a line on a screen: no control characters, 200 characters at most.
pub(crate) fn clean_name(name: &str) -> String {
    name.chars()
        .filter(|c| !c.is_control())
        .take(200)
        .collect::<String>()
        .trim()
        .to_owned()
}

impl LoadReport {
    /// Adds a warning unless the same is there already.
    pub(crate) fn warn(&mut self, warning: Warning) {
        if !self.warnings.contains(&warning) {
            self.warnings.push(warning);
        }
    }

    /// True if the file says how large its voxels are, as far as it was read.
    pub(crate) fn tells_size(&self) -> bool {
        let is_about_size =
            |w: &Warning| matches!(w, Warning::BadSpacing { .. } | Warning::NoPixelSpacing);
        !self.lacks_spacing && !self.warnings.iter().any(is_about_size)
    }

    /// The hash as the document writes it: 64 hexadecimal digits.
    pub fn sha256_hex(&self) -> Option<String> {
        self.sha256.map(|hash| crate::math::hex(&hash))
    }

    /// The warnings as lines for the user.
    pub fn notices(&self) -> Vec<String> {
        self.warnings.iter().map(ToString::to_string).collect()
    }
}
