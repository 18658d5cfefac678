//! What is wrong with a file, as far as its owner can tell and mend it. The errors themselves name bytes and fields.

use super::error::{FaultKind, LoadError};

/// What is wrong with a file, for its owner.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileFault {
    /// What kind of fault it is.
    pub kind: FaultKind,
    /// Name of the file, as given.
    pub name: String,
    /// Of a file that is cut short: the bytes that came, and those that there should be. Else 0.
    pub bytes: [u64; 2],
    /// Name of the file that is missing beside this one; else empty.
    pub needed: String,
}

/// Endings of pictures whose first bytes are not looked at.
const PICTURES: [&str; 9] = [
    ".gif", ".bmp", ".tif", ".tiff", ".webp", ".heic", ".avif", ".svg", ".jp2",
];

impl LoadError {
    /// What the owner of the file can make of the error; `None` where its own words say that best.
    pub fn fault(&self) -> Option<FileFault> {
        let fault = |kind: FaultKind, name: &String| FileFault {
            kind,
            name: name.clone(),
            bytes: [0; 2],
            needed: String::new(),
        };
        Some(match self {
            Self::MissingFile { name, needed } => FileFault {
                needed: needed.clone(),
                ..fault(FaultKind::Lacks, name)
            },
            Self::Io { name, .. } => fault(FaultKind::Unreadable, name),
            Self::Empty { name } => fault(FaultKind::Empty, name),
            Self::UnknownFormat { name, .. } => {
                let lower = name.to_lowercase();
                let is_picture = PICTURES.iter().any(|ending| lower.ends_with(ending));
                let kind = match is_picture {
                    true => FaultKind::Picture,
                    false => FaultKind::Unknown,
                };
                fault(kind, name)
            }
            Self::NoScan { name, kind, .. } => fault(*kind, name),
            Self::Header { name, .. } | Self::HeaderLine { name, .. } => {
                fault(FaultKind::Header, name)
            }
            Self::Damaged { name, .. } => fault(FaultKind::Damaged, name),
            Self::Truncated {
                name,
                expected,
                found,
            } => FileFault {
                bytes: [*found, *expected],
                ..fault(FaultKind::CutShort, name)
            },
            Self::TooLarge { name, .. } => fault(FaultKind::TooLarge, name),
            Self::Unsupported { .. }
            | Self::TooLong { .. }
            | Self::NoSuchFrame { .. }
            | Self::Refused { .. }
            | Self::Cancelled
            | Self::Mesh { .. }
            | Self::Figure { .. }
            | Self::NotField { .. }
            | Self::NotLabels { .. } => return None,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::VolumeBuilder;
    use crate::load::{LoadReport, MemoryFiles, ReadOptions, read_volume};

    fn fault_of(name: &str, bytes: &[u8]) -> Option<FileFault> {
        let mut files = MemoryFiles::new([(name, bytes.to_vec())]);
        let (mut volume, mut report) = (VolumeBuilder::new(), LoadReport::default());
        let options = ReadOptions::default();
        let read = read_volume(&mut files, name, &options, &mut volume, &mut report);
        read.expect_err("no scan").fault()
    }

    #[test]
    fn files_that_are_no_scans_are_called_by_their_kind() {
        let cut = b"NRRD0004\ntype: uint8\ndimension: 3\nsizes: 2 2 2\nencoding: raw\n\n123";
        let cases: [(&str, &[u8], FaultKind); 8] = [
            ("photo.png", b"\x89PNG\r\n\x1a\n", FaultKind::Picture),
            ("photo.jpg", b"\xff\xd8\xff\xe0....", FaultKind::Picture),
            ("drawing.svg", b"<svg xmlns=\"\"></svg>", FaultKind::Picture),
            ("all.zip", b"PK\x03\x04....", FaultKind::Archive),
            ("skull.stl", b"solid skull", FaultKind::Surface),
            ("letter.txt", b"Dear Sir or Madam", FaultKind::Unknown),
            ("scan.nii", b"", FaultKind::Empty),
            ("scan.nrrd", cut, FaultKind::CutShort),
        ];
        for (name, bytes, kind) in cases {
            let fault = fault_of(name, bytes).unwrap_or_else(|| panic!("{name}"));
            assert_eq!((fault.kind, fault.name.as_str()), (kind, name));
        }
        let fault = fault_of("scan.nrrd", cut).expect("cut short");
        assert_eq!(fault.bytes, [3, 8]);
    }

    #[test]
    fn every_kind_has_a_word_of_its_own() {
        for (i, (kind, word)) in FaultKind::WORDS.iter().enumerate() {
            let rest = FaultKind::WORDS.iter().skip(i + 1);
            assert!(rest.clone().all(|(k, w)| k != kind && w != word), "{word}");
        }
    }
}
