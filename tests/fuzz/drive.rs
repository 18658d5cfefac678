//! What a fuzzer drives: bytes in, and whatever comes of them, no panic, no hang, and no memory beyond what really
//! came. Where a format spreads over files, the bytes are cut in two: the first two say where.

use fabrica::data::{SubjectPart, SubjectSink, Volume, Voxels};
use fabrica::document::Document;
use fabrica::document::figure::{Figure, Flood, Handle, Region, Source};
use fabrica::figure::{Bender, FigureFile, read_plate, unwatched};
use fabrica::load::{
    self, ElementType, FileSet, LoadReport, MemoryFiles, RawLayout, ReadOptions,
};

/// A sink that looks at the header, counts voxels and labels, and keeps nothing.
#[derive(Default)]
struct Counter {
    expected: u64,
    found: u64,
}

impl Counter {
    fn begin(&mut self, header: &Volume) {
        let dims = header.grid.dims.as_u64vec3();
        self.expected = dims.element_product();
        assert!(self.expected > 0, "a volume has voxels");
        let affine = header.grid.world_from_voxel;
        assert!(affine.is_finite() && affine.matrix3.determinant() != 0.0, "it lies somewhere");
        assert!(header.slope.is_finite() && header.intercept.is_finite(), "values are finite");
    }

    fn count(&mut self, next: &Voxels) {
        self.found += next.len() as u64;
        if let Voxels::F32(values) = next {
            assert!(values.iter().all(|value| value.is_finite()), "voxels are finite");
        }
    }
}

impl SubjectSink for Counter {
    fn take(&mut self, part: SubjectPart) -> Result<(), String> {
        match part {
            SubjectPart::Volume(header) => self.begin(&header),
            SubjectPart::Scalars(next) => self.count(&next),
            other => drop(std::hint::black_box(other)),
        }
        Ok(())
    }

    // A hundred million voxels out of a packed file prove no more than the first ones.
    fn progress(&mut self, _fraction: f32) -> bool {
        self.found < 1 << 24
    }
}

fn read(files: &mut dyn FileSet, name: &str) {
    for frame in [0, 1] {
        let options = ReadOptions {
            frame,
            ..ReadOptions::default()
        };
        let (mut sink, mut report) = (Counter::default(), LoadReport::default());
        match load::read_volume(files, name, &options, &mut sink, &mut report) {
            Ok(()) => {
                assert_eq!(sink.found, sink.expected, "all voxels come");
                assert!(report.sha256.is_some(), "the file has a hash");
            }
            Err(error) => {
                let line = error.to_string();
                assert!(!line.contains('\n') && !line.is_empty(), "one line: {line}");
            }
        }
        for notice in report.notices() {
            assert!(!notice.contains('\n'), "one line: {notice}");
        }
    }
    let mut report = LoadReport::default();
    let names = Default::default();
    let labels = load::read_labels(files, name, &names, &limited(), &mut report);
    if let Ok(labels) = labels {
        assert_eq!(labels.labels.len(), labels.grid.voxel_count());
    }
}

/// Labels are kept, so that a packed file may not hold too many.
fn limited() -> ReadOptions {
    ReadOptions {
        max_voxels: 1 << 20,
        ..ReadOptions::default()
    }
}

/// The bytes as one file of this name, or as the first of two.
fn one_or_two(data: &[u8], name: &str, other: &str) {
    read(&mut MemoryFiles::new([(name, data.to_vec())]), name);
    let Some((cut, rest)) = data.split_first_chunk::<2>() else {
        return;
    };
    let cut = usize::from(u16::from_le_bytes(*cut)).min(rest.len());
    let (first, second) = rest.split_at(cut);
    let files = [(name, first.to_vec()), (other, second.to_vec())];
    read(&mut MemoryFiles::new(files), name);
}

/// NIfTI-1 and -2, Analyze, single files and pairs, packed or not.
pub fn nifti(data: &[u8]) {
    one_or_two(data, "a.nii", "b.nii");
    one_or_two(data, "a.hdr", "a.img");
}

/// NRRD, attached and detached.
pub fn nrrd(data: &[u8]) {
    one_or_two(data, "a.nhdr", "a.raw");
}

/// MetaImage, attached and detached.
pub fn metaimage(data: &[u8]) {
    one_or_two(data, "a.mhd", "a.raw");
}

/// Bare voxels; the first sixteen bytes say how they lie.
pub fn raw(data: &[u8]) {
    let name = String::from_utf8_lossy(&data[..data.len().min(40)]);
    std::hint::black_box(RawLayout::guess(&name, Some(data.len() as u64)));
    let Some((how, rest)) = data.split_first_chunk::<16>() else {
        return;
    };
    let side = |i: usize| u32::from(u16::from_le_bytes([how[i], how[i + 1]]));
    const ELEMENTS: [ElementType; 4] = [
        ElementType::U8,
        ElementType::I16,
        ElementType::F32,
        ElementType::F64,
    ];
    let layout = RawLayout {
        dims: [side(0), side(2), side(4)].into(),
        element: ELEMENTS[usize::from(how[6] % 4)],
        big_endian: how[7] & 1 == 1,
        spacing_mm: [
            f64::from(f32::from_le_bytes([how[8], how[9], how[10], how[11]])),
            1.0,
            1.0,
        ]
        .into(),
        header_bytes: u64::from(how[12]),
    };
    let (mut sink, mut report) = (Counter::default(), LoadReport::default());
    let mut files = MemoryFiles::new([("a.raw", rest.to_vec())]);
    let options = ReadOptions::default();
    if load::read_raw(&mut files, "a.raw", &layout, &options, &mut sink, &mut report).is_ok() {
        assert_eq!(sink.found, sink.expected, "all voxels come");
    }
}

/// DICOM: one file, and a folder of two.
pub fn dicom(data: &[u8]) {
    one_or_two(data, "a.dcm", "b.dcm");
}

/// Meshes: the bytes under the name of each format. What comes of them is whole.
pub fn mesh(data: &[u8]) {
    for name in ["a.obj", "a.stl", "a.ply", "a.glb"] {
        let mut files = MemoryFiles::new([(name, data.to_vec())]);
        let options = load::MeshOptions {
            parts: load::PartsMode::Pieces,
            ..load::MeshOptions::default()
        };
        match load::read_mesh(&mut files, name, &options, &mut |_| true) {
            Ok((mesh, _)) => {
                assert!(mesh.positions.iter().all(|p| p.is_finite()), "places are finite");
                let indices = mesh.triangles.iter().flatten();
                assert!({ indices }.all(|i| (*i as usize) < mesh.positions.len()), "corners are there");
            }
            Err(error) => assert!(!error.to_string().contains('\n'), "one line: {error}"),
        }
    }
}

/// Figures of pixels: PNG and JPEG.
pub fn picture(data: &[u8]) {
    if FigureFile::of(data) == Some(FigureFile::Picture) {
        figure(data);
    }
}

/// Figures of shapes: SVG. Where the bytes are none, they stand within one.
pub fn drawing(data: &[u8]) {
    if FigureFile::of(data) == Some(FigureFile::Drawing) {
        return figure(data);
    }
    let inner = String::from_utf8_lossy(data);
    let text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 9 9\">{inner}</svg>"
    );
    figure(text.as_bytes());
}

/// Reads a figure and, if it is small, floods a region of it and pulls at two places.
fn figure(data: &[u8]) {
    let plate = match read_plate(data) {
        Ok(read) => read.plate,
        Err(error) => {
            let line = error.to_string();
            assert!(!line.contains('\n') && !line.is_empty(), "one line: {line}");
            return;
        }
    };
    let [width, height] = plate.picture.size;
    assert_eq!(plate.picture.pixels.len(), (width * height) as usize, "all pixels");
    assert!(plate.size.min_element() > 0.0 && plate.size.is_finite(), "it has a size");
    let is_of_pixels = FigureFile::of(data) == Some(FigureFile::Picture);
    if is_of_pixels && width * height > 1 << 16 {
        return;
    }
    let mut bender = Bender::new(&plate).expect("it was read before");
    let source = match is_of_pixels {
        true => Source::Flood(Flood::new(vec![glam::DVec2::ZERO])),
        false => Source::Path("0".to_owned()),
    };
    let figure = Figure {
        regions: vec![Region {
            from: Some(source),
            ..Region::new("region")
        }],
        handles: vec![
            Handle::pin(glam::dvec2(-0.3, 0.0), glam::DVec2::ZERO),
            Handle::pin(glam::dvec2(0.3, 0.0), glam::dvec2(0.0, 0.2)),
        ],
        detail: 500,
        ..Figure::default()
    };
    let bent = bender.bent(&figure, &mut unwatched).expect("nobody stops it");
    assert!(bent.sheet.places.iter().all(|place| place.is_finite()), "places are finite");
    for notice in bent.notices {
        assert!(!notice.to_string().contains('\n'), "one line: {notice}");
    }
}

/// Links: any text gives a document or an error, and a document comes back from its link.
pub fn link(data: &[u8]) {
    let text = String::from_utf8_lossy(data);
    if let Ok(link) = fabrica::link::decode(&text) {
        round_trip(&link.document);
    }
}

/// Reads the bytes as a document in JSON; what is read must survive a round trip.
pub fn document(data: &[u8]) {
    let text = String::from_utf8_lossy(data);
    if let Ok(document) = Document::from_json(&text) {
        round_trip(&document);
        let json = document.to_json();
        let again = Document::from_json(&json).expect("what was written is read");
        assert_eq!(again.to_json(), json, "written twice, it is the same");
        for step in 0..=document.step_count() {
            document.at_step(step).expect("a step of a valid document").illustration();
        }
    }
}

fn round_trip(document: &Document) {
    let payload = fabrica::link::encode(document);
    let again = fabrica::link::decode(&payload).expect("our own link");
    assert_eq!(again.document.to_json(), document.to_json(), "without loss");
}
