//! The flags that tell what a file leaves open: which of its volumes, and how bare voxels lie.

use std::path::Path;

use super::error::CliError;
use crate::document::{RawVoxels, Reading};
use crate::load::{
    Description, LoadError, MeshDescription, MeshOptions, MeshOrNot, RawLayout, ReadOptions,
    describe, describe_mesh, describe_raw, mesh_or_not,
};
use crate::shell::files::Folder;
use crate::shell::loading::may_be_raw;

/// Flags that go before the reading in the document.
#[derive(Clone, Debug, Default, clap::Args)]
pub struct ReadingFlags {
    /// Which volume of a scan that holds several (time points, components), counted from 1.
    #[arg(long, global = true, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    frame: Option<u64>,
    /// How bare voxels lie in a file that does not say so: sizes (x fastest), type, and what differs from low byte
    /// first, voxels of 1 mm and nothing to skip. Such as 128x128x256,int16,big,0.5x0.5x2,skip=352.
    #[arg(long, global = true, value_name = "LAYOUT", value_parser = parse_raw)]
    raw: Option<RawVoxels>,
}

impl ReadingFlags {
    /// The reading in the document, but for the keys that flags give.
    pub fn over(&self, document: Option<&Reading>) -> Reading {
        let document = document.cloned().unwrap_or_default();
        Reading {
            frame: self.frame.map_or(document.frame, |number| number - 1),
            raw: self.raw.clone().or(document.raw),
            mesh: document.mesh,
            bounds: document.bounds,
            meshes: document.meshes,
            carves: document.carves,
            sweeps: document.sweeps,
        }
    }

    /// Describes a mesh; `None` for a file that is something else, or bare voxels by the flags.
    ///
    /// # Errors
    /// [`CliError::Mesh`].
    pub(super) fn describe_mesh(&self, file: &Path) -> Result<Option<MeshDescription>, CliError> {
        let (mut folder, name) = Folder::of(file);
        // What cannot be read at all is told by the reader of scans.
        let kind = mesh_or_not(&mut folder, &name).unwrap_or(MeshOrNot::Not);
        if self.raw.is_some() || kind == MeshOrNot::Not {
            return Ok(None);
        }
        let described = describe_mesh(&mut folder, &name, &MeshOptions::default(), &mut |_| true);
        let shown = file.to_string_lossy().into_owned();
        described
            .map(Some)
            .map_err(|error| CliError::Mesh(error, shown))
    }

    /// Describes a data file, read by the flags.
    ///
    /// # Errors
    /// As [`describe`].
    pub fn describe(&self, file: &Path) -> Result<Description, LoadError> {
        let (mut folder, name) = Folder::of(file);
        let reading = self.over(None);
        let options = ReadOptions {
            frame: reading.frame,
            ..ReadOptions::default()
        };
        match &reading.raw {
            Some(raw) => describe_raw(&mut folder, &name, &RawLayout::from(raw), &options),
            None => describe(&mut folder, &name, &options),
        }
    }
}

/// What to do where a file was not known: its name may promise bare voxels.
pub(super) fn hint(name: &str, error: &LoadError) -> Option<String> {
    let is_raw = matches!(error, LoadError::UnknownFormat { .. }) && may_be_raw(name);
    is_raw.then(|| {
        format!("{name} may hold bare voxels: say how they lie, such as --raw 128x128x256,int16")
    })
}

fn parse_raw(text: &str) -> Result<RawVoxels, String> {
    const EXPECTED: &str = "expected sizes and a type such as 128x128x256,int16, then if need be big, a voxel size in mm such as 0.5x0.5x2, and skip=BYTES";
    let mut parts = text.split(',').map(str::trim);
    let mut size = None;
    let mut raw = RawVoxels {
        size: [1; 3],
        element: "",
        big_endian: false,
        spacing_mm: [1.0; 3],
        skip_bytes: 0,
    };
    for part in &mut parts {
        let element = RawVoxels::ELEMENTS.into_iter().find(|known| *known == part);
        let is_known = match (part, element) {
            (_, Some(element)) => {
                raw.element = element;
                true
            }
            ("big" | "little", _) => {
                raw.big_endian = part == "big";
                true
            }
            _ => match part.strip_prefix("skip=") {
                Some(bytes) => bytes.parse().map(|bytes| raw.skip_bytes = bytes).is_ok(),
                // The first triple is the sizes, the second the size of a voxel.
                None if size.is_none() => {
                    size = triple::<u32>(part)
                        .filter(|size| size.iter().all(|n| (1..=65_536).contains(n)));
                    size.is_some()
                }
                None => {
                    let is_size = |mm: &f64| (1e-6..=1e6).contains(mm);
                    let spacing = triple::<f64>(part).filter(|mm| mm.iter().all(is_size));
                    spacing.map(|mm| raw.spacing_mm = mm).is_some()
                }
            },
        };
        if !is_known {
            return Err(format!("“{part}” is not understood; {EXPECTED}"));
        }
    }
    match size {
        Some(size) if !raw.element.is_empty() => Ok(RawVoxels { size, ..raw }),
        _ => Err(EXPECTED.to_owned()),
    }
}

fn triple<T: std::str::FromStr>(text: &str) -> Option<[T; 3]> {
    let numbers: Option<Vec<T>> = text
        .split(['x', 'X', '×'])
        .map(|n| n.parse().ok())
        .collect();
    numbers?.try_into().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn layouts_are_read_or_refused() {
        let raw = parse_raw("128x64x32,int16,big,0.5x0.5x2,skip=352").expect("all of it");
        assert_eq!((raw.size, raw.element), ([128, 64, 32], "int16"));
        assert_eq!((raw.spacing_mm, raw.skip_bytes), ([0.5, 0.5, 2.0], 352));
        assert!(raw.big_endian);
        let raw = parse_raw("uint8, 4x3x2").expect("in any order");
        assert_eq!(
            (raw.size, raw.spacing_mm, raw.big_endian),
            ([4, 3, 2], [1.0; 3], false)
        );
        for wrong in [
            "",
            "4x3x2",
            "uint8",
            "4x3,uint8",
            "0x3x2,uint8",
            "4x3x2,uint9",
            "4x3x2,uint8,0x1x1",
            "4x3x2,uint8,1xNaNx1",
            "4x3x2,uint8,skip=-1",
            "4x3x2,uint8,skip=x",
            "4x3x2,uint8,,",
            "99999999999x1x1,uint8",
        ] {
            parse_raw(wrong).expect_err(wrong);
        }
    }
}
