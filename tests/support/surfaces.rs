//! Surfaces made of the bytes of a mesh file, as the program makes them.

use fabrica::data::{SubjectPart, SubjectSink, Surface};
use fabrica::load::{LoadReport, MemoryFiles, MeshFile, read_mesh_subject};
use std::sync::Arc;

struct Taken(Option<Arc<Surface>>);

impl SubjectSink for Taken {
    fn take(&mut self, part: SubjectPart) -> Result<(), String> {
        if let SubjectPart::Surface(surface) = part {
            self.0 = Some(surface);
        }
        Ok(())
    }

    fn progress(&mut self, _fraction: f32) -> bool {
        true
    }
}

/// The surface of a mesh file; its name tells the format where the bytes do not.
pub(crate) fn surface_of(name: &str, bytes: Vec<u8>) -> Arc<Surface> {
    let (mut files, mut taken) = (MemoryFiles::new([(name, bytes)]), Taken(None));
    let mesh = MeshFile {
        file: name.to_owned(),
        ..MeshFile::default()
    };
    let mut report = LoadReport::default();
    read_mesh_subject(&mut files, &[mesh], None, &mut taken, &mut report).expect("a mesh");
    taken.0.expect("it came")
}
