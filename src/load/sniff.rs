use super::error::FaultKind;
use super::mesh::format::{self, MeshKind};
use super::{dicom, metaimage, nifti, nrrd};

/// Bytes looked at to tell what a file is.
pub(super) const SNIFF_BYTES: usize = 1024;

/// The format of a file, by its first bytes and its name.
#[derive(Clone, Copy)]
pub(super) enum Kind {
    Dicom,
    Nifti,
    Nrrd,
    MetaImage,
    Empty,
    /// Known, and not read: in words.
    Refused(&'static str),
    /// A mesh, of a format that is read or not.
    Mesh(MeshKind),
    /// Known, and no scan: which kind of file, and in words.
    NoScan(FaultKind, &'static str),
    Unknown,
}

/// True if a file begins like one of a format.
type IsHeader = fn(&[u8]) -> bool;

/// Formats that are read, in the order in which they are tried: by how the file begins, or by how its name ends.
const READ: &[(Kind, IsHeader, &[&str])] = &[
    (Kind::Nifti, nifti::is_header, &[".nii", ".hdr"]),
    (Kind::Nrrd, nrrd::is_header, &[]),
    (Kind::MetaImage, metaimage::is_header, &[".mha", ".mhd"]),
    (Kind::Dicom, dicom::has_mark, &dicom::ENDINGS),
];

/// Tells the format of a file by its first bytes (unpacked), or by its name where the bytes are not clear. `byte_len`
/// is the length of a file that is not packed, where it is known.
pub(super) fn sniff(start: &[u8], name: &str, byte_len: Option<u64>) -> Kind {
    let lower = name.to_lowercase();
    let inner = lower.strip_suffix(".gz").unwrap_or(&lower);
    let named = |ending: &str| lower.ends_with(ending) || inner.ends_with(ending);
    if start.is_empty() {
        return Kind::Empty;
    }
    for &(kind, is_header, endings) in READ {
        if is_header(start) || endings.iter().any(|ending| named(ending)) {
            return kind;
        }
    }
    if named(".mgz") || named(".mgh") {
        return Kind::Refused(
            "FreeSurfer's MGH is not read: convert it to NIfTI (mri_convert does)",
        );
    }
    if let Some(kind) = format::sniff(start, inner, byte_len) {
        return Kind::Mesh(kind);
    }
    const SIGNS: [(&[u8], FaultKind, &str); 3] = [
        (b"\x89PNG", FaultKind::Picture, "a PNG picture is no volume"),
        (
            b"\xff\xd8\xff",
            FaultKind::Picture,
            "a JPEG picture is no volume",
        ),
        (
            b"PK\x03\x04",
            FaultKind::Archive,
            "a ZIP archive: unpack it and open the scan in it",
        ),
    ];
    for (sign, kind, what) in SIGNS {
        if start.starts_with(sign) {
            return Kind::NoScan(kind, what);
        }
    }
    const UNREAD: [(&[u8], &str); 2] = [
        (
            b"\x93NUMPY",
            "a NumPy array says nothing of voxel size or orientation: save it as NIfTI or NRRD",
        ),
        (
            b"# vtk DataFile",
            "VTK files are not read: save a scan as MetaImage or NIfTI, a mesh as PLY or GLB",
        ),
    ];
    for (sign, what) in UNREAD {
        if start.starts_with(sign) {
            return Kind::Refused(what);
        }
    }
    if dicom::is_header(start) && !named(".raw") {
        return Kind::Dicom;
    }
    Kind::Unknown
}
