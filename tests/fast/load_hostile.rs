//! Files that lie, break off or are damaged: a message each, never a panic, a hang or memory that no byte justifies.
//! And the well-formed ones they are made of: every type, both byte orders, every way to give an orientation.

use std::io::{self, Read, Write as _};

use crate::scans::{Random, rounds};
use fabrica::data::{SubjectPart, SubjectSink, Volume, VolumeBuilder, Voxels};
use fabrica::load::{
    FileHandle, FileSet, Format, LoadError, LoadReport, MemoryFiles, OneFile, ReadOptions, Warning,
    orientation_code, read_volume,
};
use glam::{DVec3, UVec3};

/// What a written file says. Numbers go out in the byte order asked for.
#[derive(Clone)]
struct Nifti {
    version: u8,
    big_endian: bool,
    datatype: i16,
    dim: [i64; 8],
    pixdim: [f32; 8],
    vox_offset: i64,
    slope: f32,
    intercept: f32,
    qform: Option<([f32; 3], [f32; 3])>,
    sform: Option<[[f32; 4]; 3]>,
    magic: &'static [u8; 4],
    voxels: Vec<u8>,
}

impl Nifti {
    fn new(datatype: i16, dims: [i64; 3], voxels: Vec<u8>) -> Self {
        Self {
            version: 1,
            big_endian: false,
            datatype,
            dim: [3, dims[0], dims[1], dims[2], 1, 1, 1, 1],
            pixdim: [1.0; 8],
            vox_offset: 352,
            slope: 1.0,
            intercept: 0.0,
            qform: None,
            sform: Some([
                [1.0, 0.0, 0.0, 0.0],
                [0.0, 1.0, 0.0, 0.0],
                [0.0, 0.0, 1.0, 0.0],
            ]),
            magic: b"n+1\0",
            voxels,
        }
    }

    fn header(&self) -> Vec<u8> {
        let is_two = self.version == 2;
        let mut bytes = vec![0; if is_two { 540 } else { 348 }];
        let mut put = |offset: usize, little: &[u8]| {
            let mut raw = little.to_vec();
            if self.big_endian {
                raw.reverse();
            }
            bytes[offset..offset + raw.len()].copy_from_slice(&raw);
        };
        let float = |x: f32| {
            if is_two {
                f64::from(x).to_le_bytes().to_vec()
            } else {
                x.to_le_bytes().to_vec()
            }
        };
        let at = |one: usize, two: usize| if is_two { two } else { one };
        let step = at(4, 8);
        put(0, &at(348, 540).to_le_bytes()[..4]);
        put(at(70, 12), &self.datatype.to_le_bytes());
        for (i, &n) in self.dim.iter().enumerate() {
            if is_two {
                put(16 + 8 * i, &n.to_le_bytes());
            } else {
                put(40 + 2 * i, &(n as i16).to_le_bytes());
            }
        }
        for (i, &size) in self.pixdim.iter().enumerate() {
            put(at(76, 104) + step * i, &float(size));
        }
        if is_two {
            put(168, &self.vox_offset.to_le_bytes());
        } else {
            put(108, &(self.vox_offset as f32).to_le_bytes());
        }
        put(at(112, 176), &float(self.slope));
        put(at(116, 184), &float(self.intercept));
        let mut code = |one: usize, two: usize, code: i32| {
            put(at(one, two), &code.to_le_bytes()[..at(2, 4)]);
        };
        code(252, 344, i32::from(self.qform.is_some()));
        code(254, 348, i32::from(self.sform.is_some()));
        if let Some((quaternion, offset)) = self.qform {
            for i in 0..3 {
                put(at(256, 352) + step * i, &float(quaternion[i]));
                put(at(268, 376) + step * i, &float(offset[i]));
            }
        }
        for (i, row) in self.sform.iter().flatten().enumerate() {
            for (j, &x) in row.iter().enumerate() {
                put(at(280, 400) + step * (4 * i + j), &float(x));
            }
        }
        let magic = at(344, 4);
        bytes[magic..magic + 4].copy_from_slice(self.magic);
        bytes
    }

    fn bytes(&self) -> Vec<u8> {
        let mut bytes = self.header();
        bytes.resize(self.vox_offset.max(0) as usize, 0);
        bytes.extend(&self.voxels);
        bytes
    }
}

fn gzip(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
    encoder.write_all(bytes).expect("memory takes it");
    encoder.finish().expect("memory takes it")
}

fn load_files(files: &mut dyn FileSet, name: &str) -> Result<(Volume, LoadReport), LoadError> {
    let mut report = LoadReport::default();
    let mut builder = VolumeBuilder::new();
    read_volume(
        files,
        name,
        &ReadOptions::default(),
        &mut builder,
        &mut report,
    )?;
    Ok((builder.finish().expect("all voxels came"), report))
}

fn load(name: &str, bytes: Vec<u8>) -> Result<(Volume, LoadReport), LoadError> {
    load_files(&mut MemoryFiles::new([(name, bytes)]), name)
}

/// The numbers 1 to 24 in a type, little-endian, with the NIfTI code and the bytes of one.
fn numbers() -> Vec<(i16, usize, Vec<u8>)> {
    macro_rules! row {
        ($code:expr, $type:ty) => {
            (
                $code,
                size_of::<$type>(),
                (1..25u8)
                    .flat_map(|i| <$type>::from(i).to_le_bytes())
                    .collect(),
            )
        };
    }
    vec![
        row!(2, u8),
        (256, 1, (1..25).collect()),
        row!(4, i16),
        row!(512, u16),
        row!(8, i32),
        row!(768, u32),
        row!(1024, i64),
        row!(1280, u64),
        row!(16, f32),
        row!(64, f64),
    ]
}

#[test]
fn every_type_order_and_version_round_trips() {
    for (datatype, size, little) in numbers() {
        for big_endian in [false, true] {
            for version in [1, 2] {
                for packed in [false, true] {
                    let mut voxels = little.clone();
                    if big_endian {
                        voxels.chunks_mut(size).for_each(<[u8]>::reverse);
                    }
                    let mut file = Nifti::new(datatype, [2, 3, 4], voxels);
                    (file.big_endian, file.version) = (big_endian, version);
                    file.pixdim = [1.0, 0.5, 1.5, 3.0, 1.0, 1.0, 1.0, 1.0];
                    (file.slope, file.intercept) = (2.0, -1000.0);
                    if version == 2 {
                        file.magic = b"n+2\0";
                        file.vox_offset = 544;
                    }
                    let bytes = if packed {
                        gzip(&file.bytes())
                    } else {
                        file.bytes()
                    };
                    let (volume, report) = load("a.nii", bytes).expect("well formed");
                    assert_eq!(report.notices(), Vec::<String>::new());
                    let values: Vec<f32> = (0..24)
                        .map(|i| {
                            volume
                                .value_at(UVec3::new(i % 2, i / 2 % 3, i / 6))
                                .expect("inside")
                        })
                        .collect();
                    let expected: Vec<f32> =
                        (1..25u8).map(|i| 2.0 * f32::from(i) - 1000.0).collect();
                    assert_eq!(
                        values, expected,
                        "type {datatype}, big-endian {big_endian}, version {version}"
                    );
                    assert_eq!(volume.value_range, [-998.0, -952.0]);
                }
            }
        }
    }
}

#[test]
fn pairs_are_found_from_either_half() {
    for (magic, format) in [
        (b"ni1\0", Format::Nifti1Pair),
        (b"\0\0\0\0", Format::Analyze),
    ] {
        let mut file = Nifti::new(2, [2, 3, 4], (0..24).collect());
        file.magic = magic;
        file.vox_offset = 0;
        for names in [["a.hdr", "a.img"], ["A.HDR", "A.IMG"]] {
            for asked in names {
                let mut files =
                    MemoryFiles::new([(names[0], file.header()), (names[1], file.voxels.clone())]);
                let (volume, report) = load_files(&mut files, asked).expect("a pair");
                assert_eq!(report.format, Some(format));
                assert_eq!(volume.voxels, Voxels::U8((0..24).collect()));
                assert_eq!(
                    report.warnings.contains(&Warning::NoOrientation),
                    format == Format::Analyze
                );
            }
        }
        let mut files = MemoryFiles::new([
            ("a.hdr", gzip(&file.header())),
            ("a.img.gz", gzip(&file.voxels)),
        ]);
        load_files(&mut files, "a.img.gz").expect("packed halves");
        let error = load("a.hdr", file.header()).expect_err("no image");
        assert_eq!(
            error.to_string(),
            "a.img is needed beside a.hdr, but was not given"
        );
        let error = load("a.img", file.voxels.clone()).expect_err("no header");
        assert_eq!(
            error.to_string(),
            "a.hdr is needed beside a.img, but was not given"
        );
    }
}

#[test]
fn orientation_is_chosen_as_the_standard_says() {
    let base = {
        let mut file = Nifti::new(2, [2, 3, 4], vec![0; 24]);
        file.pixdim = [-1.0, 2.0, 3.0, 4.0, 1.0, 1.0, 1.0, 1.0];
        file
    };
    // A quarter turn about x: j goes to superior, k to posterior; with the third axis mirrored, to anterior.
    let half = std::f32::consts::FRAC_1_SQRT_2;
    let quarter = Some(([half, 0.0, 0.0], [5.0, 6.0, 7.0]));
    let sform = Some([
        [-2.0, 0.0, 0.5, 1.0],
        [0.0, 3.0, 0.0, 2.0],
        [0.0, 0.0, 4.0, 3.0],
    ]);

    let mut file = base.clone();
    (file.qform, file.sform) = (quarter, sform);
    let (volume, report) = load("a.nii", file.bytes()).expect("both forms");
    assert_eq!(orientation_code(&volume.grid), "LAS", "the sform wins");
    assert_eq!(
        volume.grid.world_from_voxel.translation,
        DVec3::new(1.0, 2.0, 3.0)
    );
    assert_eq!(
        volume.grid.world_from_voxel.matrix3.z_axis,
        DVec3::new(0.5, 0.0, 4.0),
        "sheared"
    );
    assert!(!report.warnings.contains(&Warning::NoOrientation));

    file.sform = None;
    let (volume, _) = load("a.nii", file.bytes()).expect("qform");
    assert_eq!(orientation_code(&volume.grid), "RSA");
    assert!(
        (volume.grid.spacing_mm() - DVec3::new(2.0, 3.0, 4.0))
            .abs()
            .max_element()
            < 1e-6
    );
    assert_eq!(
        volume.grid.world_from_voxel.translation,
        DVec3::new(5.0, 6.0, 7.0)
    );
    file.pixdim[0] = 1.0;
    let (volume, _) = load("a.nii", file.bytes()).expect("qform");
    assert_eq!(
        orientation_code(&volume.grid),
        "RSP",
        "pixdim[0] turns the third axis"
    );

    let mut file = base.clone();
    (file.qform, file.sform) = (None, None);
    let (volume, report) = load("a.nii", file.bytes()).expect("no form");
    assert_eq!(orientation_code(&volume.grid), "RAS");
    assert!(report.warnings.contains(&Warning::NoOrientation));

    // What cannot be is named, and the next is taken.
    for bad in [f32::NAN, 0.0, f32::INFINITY, 1e30] {
        let mut file = base.clone();
        file.qform = quarter;
        file.sform = Some([
            [bad, 0.0, 0.0, 0.0],
            [0.0, bad, 0.0, 0.0],
            [0.0, 0.0, 1.0, 0.0],
        ]);
        let (volume, report) = load("a.nii", file.bytes()).expect("falls back");
        assert_eq!(orientation_code(&volume.grid), "RSA", "sform of {bad}");
        assert!(matches!(
            report.warnings[..],
            [Warning::BadOrientation { field: "sform", .. }, ..]
        ));
        let mut file = base.clone();
        (file.qform, file.sform) = (None, None);
        file.pixdim[2] = bad;
        let (volume, report) = load("a.nii", file.bytes()).expect("falls back");
        assert!(volume.grid.mm_per_unit().is_finite());
        assert!(
            report
                .warnings
                .iter()
                .any(|warning| matches!(warning, Warning::BadSpacing { .. }))
        );
    }
}

#[test]
fn odd_values_are_counted() {
    let voxels: Vec<u8> = [f32::NAN, 1.0, f32::INFINITY, -2.0, 3e38, 0.5]
        .iter()
        .flat_map(|x| x.to_le_bytes())
        .collect();
    let (volume, report) =
        load("a.nii", Nifti::new(16, [6, 1, 1], voxels).bytes()).expect("it loads");
    assert_eq!(
        volume.voxels,
        Voxels::F32(vec![0.0, 1.0, 0.0, -2.0, 1e37, 0.5])
    );
    assert_eq!(
        report.warnings,
        [
            Warning::NotFinite { count: 2 },
            Warning::Clipped { count: 1 }
        ]
    );
    // Scaled, the same stay within what can be shown.
    let voxels: Vec<u8> = [3e38f32, -3e38, 2.0]
        .iter()
        .flat_map(|x| x.to_le_bytes())
        .collect();
    let mut file = Nifti::new(16, [3, 1, 1], voxels);
    (file.slope, file.intercept) = (1e10, 1e30);
    let (volume, _) = load("a.nii", file.bytes()).expect("it loads");
    let [low, high] = volume.value_range;
    assert!((high - low).is_finite() && high > low, "{low} to {high}");
    let (volume, report) =
        load("a.nii", Nifti::new(2, [2, 2, 2], vec![9; 8]).bytes()).expect("it loads");
    assert_eq!(volume.value_range, [9.0, 9.0]);
    assert_eq!(report.warnings, [Warning::Constant { value: 9.0 }]);
    let wide: Vec<u8> = [(1i64 << 24) + 1, 5]
        .iter()
        .flat_map(|x| x.to_le_bytes())
        .collect();
    let (_, report) = load("a.nii", Nifti::new(1024, [2, 1, 1], wide).bytes()).expect("it loads");
    assert_eq!(report.warnings, [Warning::Rounded { count: 1 }]);
    let complex: Vec<u8> = [3f32, 4.0, 0.0, 1.0]
        .iter()
        .flat_map(|x| x.to_le_bytes())
        .collect();
    let (volume, report) =
        load("a.nii", Nifti::new(32, [2, 1, 1], complex).bytes()).expect("it loads");
    assert_eq!(
        (volume.voxels, &report.warnings[..]),
        (Voxels::F32(vec![5.0, 1.0]), &[Warning::Magnitude][..])
    );
    let mut file = Nifti::new(4, [2, 1, 1], vec![1, 0, 2, 0]);
    (file.slope, file.intercept) = (f32::NAN, 1.0);
    let (volume, report) = load("a.nii", file.bytes()).expect("it loads");
    assert_eq!(volume.value_range, [1.0, 2.0]);
    assert!(matches!(report.warnings[..], [Warning::BadScale { .. }]));
    (file.slope, file.intercept) = (0.0, 7.0);
    let (_, report) = load("a.nii", file.bytes()).expect("it loads");
    assert_eq!(report.warnings, [Warning::SlopeZero]);
    let mut bytes = Nifti::new(2, [2, 2, 2], (0..8).collect()).bytes();
    bytes.extend([1, 2, 3]);
    for bytes in [gzip(&bytes), bytes] {
        let (_, report) = load("a.nii", bytes).expect("it loads");
        assert_eq!(report.warnings, [Warning::TrailingBytes]);
    }
}

#[test]
fn gzip_members_join_and_their_sums_are_checked() {
    let bytes = Nifti::new(
        2,
        [16, 16, 16],
        (0..4096).map(|i| (i * 7 % 251) as u8).collect(),
    )
    .bytes();
    let (whole, _) = load("a.nii", bytes.clone()).expect("plain");
    let (first, second) = bytes.split_at(1000);
    let mut members = gzip(first);
    members.extend(gzip(second));
    assert_eq!(
        load("a.nii.gz", members.clone()).expect("two members").0,
        whole
    );
    members.extend([0; 512]);
    let (volume, report) = load("a.nii.gz", members).expect("padded");
    assert_eq!(
        (volume, &report.warnings[..]),
        (whole, &[Warning::TrailingBytes][..])
    );
    let mut wrong_sum = gzip(&bytes);
    let at = wrong_sum.len() - 6;
    wrong_sum[at] ^= 1;
    assert!(matches!(
        load("a.nii.gz", wrong_sum),
        Err(LoadError::Damaged { .. })
    ));
}

/// A volume of two voxels type and some header extension, small enough to be cut at every byte.
fn small_files() -> Vec<(&'static str, Vec<u8>)> {
    let mut with_names = Nifti::new(4, [5, 4, 3], (0..120).collect());
    with_names.vox_offset = 352 + 112;
    let mut bytes = with_names.bytes();
    bytes[348] = 1;
    bytes[352..356].copy_from_slice(&112i32.to_le_bytes());
    let xml = br#"<Label Key="1" Red="1" Green="0" Blue="0"><![CDATA[bone]]></Label>"#;
    bytes[360..360 + xml.len()].copy_from_slice(xml);
    let mut two = Nifti::new(64, [3, 2, 2], vec![3; 96]);
    (two.version, two.magic, two.vox_offset, two.big_endian) = (2, b"n+2\0", 544, true);
    vec![
        ("names.nii", bytes.clone()),
        ("names.nii.gz", gzip(&bytes)),
        ("two.nii", two.bytes()),
    ]
}

#[test]
fn names_of_labels_are_read() {
    let (_, report) = load("names.nii", small_files()[0].1.clone()).expect("well formed");
    assert_eq!(report.segments.len(), 1);
    assert_eq!(
        (report.segments[0].label, report.segments[0].name.as_str()),
        (1, "bone")
    );
    assert_eq!(report.segments[0].color_srgb, Some([255, 0, 0]));
}

#[test]
fn cut_at_every_byte_is_an_error() {
    for (name, bytes) in small_files() {
        load(name, bytes.clone()).expect("whole");
        for len in 0..bytes.len() {
            let error = load(name, bytes[..len].to_vec()).expect_err("cut");
            let message = error.to_string();
            assert!(
                message.contains(name) && !message.contains('\n'),
                "{message}"
            );
            // The same from a reader that does not know its length.
            let mut one = OneFile::new(name, &bytes[..len], None);
            load_files(&mut one, name).expect_err("cut");
        }
    }
}

/// Counts the voxels and labels that it is given, and fails the test if they are more than the bytes read can have
/// held.
struct Bounded {
    voxels: u64,
    limit: u64,
}

impl SubjectSink for Bounded {
    fn take(&mut self, part: SubjectPart) -> Result<(), String> {
        if let SubjectPart::Scalars(next) = part {
            self.voxels += next.len() as u64;
            assert!(
                self.voxels <= self.limit,
                "{} voxels from nowhere",
                self.voxels
            );
        }
        Ok(())
    }
    fn progress(&mut self, fraction: f32) -> bool {
        assert!((0.0..=1.0).contains(&fraction), "progress {fraction}");
        true
    }
}

#[test]
fn ten_thousand_flipped_files_give_a_volume_or_a_message() {
    let mut random = Random(0x9e37_79b9_7f4a_7c15);
    let (mut loaded, mut refused) = (0, 0);
    for (name, bytes) in small_files() {
        for round in 0..rounds(4000) {
            let mut bytes = bytes.clone();
            // Half of the flips go into the header, where they hurt.
            let reach = if round % 2 == 0 {
                bytes.len()
            } else {
                bytes.len().min(352)
            };
            for _ in 0..1 + random.next() % 4 {
                let at = random.next() % reach;
                bytes[at] ^= 1 << (random.next() % 8);
            }
            let mut sink = Bounded {
                voxels: 0,
                limit: bytes.len() as u64 * 1032,
            };
            let mut report = LoadReport::default();
            let mut files = MemoryFiles::new([(name, bytes)]);
            match read_volume(
                &mut files,
                name,
                &ReadOptions::default(),
                &mut sink,
                &mut report,
            ) {
                Ok(()) => loaded += 1,
                Err(error) => {
                    assert!(!error.to_string().contains('\n'), "one line");
                    refused += 1;
                }
            }
        }
    }
    println!("{loaded} loaded, {refused} refused");
    assert!(
        loaded > 1000 && refused > 1000,
        "the flips reach both: {loaded} {refused}"
    );
}

#[test]
fn every_grid_that_loads_can_be_drawn() {
    let mut random = Random(77);
    let bytes = Nifti::new(2, [4, 4, 4], (0..64).collect()).bytes();
    for _ in 0..rounds(4000) {
        let mut bytes = bytes.clone();
        for _ in 0..1 + random.next() % 6 {
            let field = [76, 252, 254, 256, 280, 296, 312, 112][random.next() % 8];
            bytes[field + random.next() % 16] = random.next() as u8;
        }
        if let Ok((volume, _)) = load("a.nii", bytes) {
            let grid = volume.grid;
            let mm = grid.mm_per_unit();
            assert!(mm.is_finite() && mm > 0.0, "{mm}");
            assert!(grid.texture_from_subject().is_finite(), "invertible");
            assert!(grid.subject_bounds().max.is_finite(), "finite");
            assert!(
                volume.value_range.iter().all(|x| x.is_finite()),
                "{:?}",
                volume.value_range
            );
            assert!(
                (volume.value_range[1] - volume.value_range[0]).is_finite(),
                "the span is finite"
            );
        }
    }
}

#[test]
fn headers_that_promise_more_than_comes_are_unmasked() {
    for dims in [
        [32767, 32767, 1],
        [32767, 32767, 7],
        [1024, 1024, 1024],
        [32767, 1, 32767],
    ] {
        let file = Nifti::new(16, dims, vec![0; 1000]);
        for (name, bytes) in [("a.nii", file.bytes()), ("a.nii.gz", gzip(&file.bytes()))] {
            let mut begun = Begun(false);
            let mut report = LoadReport::default();
            let mut files = MemoryFiles::new([(name, bytes.clone())]);
            let error = read_volume(
                &mut files,
                name,
                &ReadOptions::default(),
                &mut begun,
                &mut report,
            )
            .expect_err("promises too much");
            assert!(matches!(error, LoadError::Truncated { .. }), "{error}");
            assert!(!begun.0, "the sink was not even asked");
            // Where the length is not known, the sink begins, and the end comes when it comes.
            load_files(&mut OneFile::new(name, bytes.as_slice(), None), name)
                .expect_err("promises too much");
        }
    }
    let mut file = Nifti::new(2, [1, 1, 1], vec![0; 8]);
    (file.version, file.magic, file.vox_offset) = (2, b"n+2\0", 544);
    for dims in [
        [i64::MAX, i64::MAX, i64::MAX],
        [1 << 40, 1, 1],
        [1 << 21, 1 << 21, 1 << 21],
    ] {
        file.dim[1..4].copy_from_slice(&dims);
        let error = load("a.nii", file.bytes()).expect_err("too large");
        assert!(matches!(error, LoadError::TooLarge { .. }), "{error}");
    }
    file.dim[1..4].copy_from_slice(&[0, 1, 1]);
    assert!(matches!(
        load("a.nii", file.bytes()),
        Err(LoadError::Header { field: "dim", .. })
    ));
    file.dim[1..5].copy_from_slice(&[2, 2, 2, i64::MAX]);
    file.dim[0] = 7;
    file.dim[5] = i64::MAX;
    load("a.nii", file.bytes()).expect("the first of very many");
    let mut file = Nifti::new(2, [2, 2, 2], vec![0; 8]);
    file.vox_offset = i64::MAX;
    assert!(
        load("a.nii", file.header()).is_err(),
        "voxels beyond the end"
    );
}

struct Begun(bool);

impl SubjectSink for Begun {
    fn take(&mut self, part: SubjectPart) -> Result<(), String> {
        self.0 |= matches!(part, SubjectPart::Volume(_));
        Ok(())
    }
    fn progress(&mut self, _fraction: f32) -> bool {
        true
    }
}

#[test]
fn a_bomb_behind_the_voxels_is_not_unpacked() {
    let mut bytes = Nifti::new(2, [2, 2, 2], (0..8).collect()).bytes();
    bytes.resize(bytes.len() + 300_000_000, 0);
    let bomb = gzip(&bytes);
    drop(bytes);
    let start = std::time::Instant::now();
    let (_, report) = load("a.nii.gz", bomb).expect("the volume is there");
    assert_eq!(report.warnings, [Warning::TrailingBytes]);
    assert!(
        start.elapsed().as_secs_f32() < 1.0,
        "took {:?}",
        start.elapsed()
    );
}

/// Gives one byte at a time, an error or an interruption now and then.
struct Slow<'a> {
    bytes: &'a [u8],
    fail_at: Option<usize>,
    calls: usize,
}

impl Read for Slow<'_> {
    fn read(&mut self, buf: &mut [u8]) -> io::Result<usize> {
        self.calls += 1;
        if self.calls.is_multiple_of(3) {
            return Err(io::ErrorKind::Interrupted.into());
        }
        if self.fail_at == Some(self.calls) {
            return Err(io::Error::other("the disk was taken out"));
        }
        let n = self.bytes.len().min(buf.len()).min(1);
        buf[..n].copy_from_slice(&self.bytes[..n]);
        self.bytes = &self.bytes[n..];
        Ok(n)
    }
}

#[test]
fn slow_and_failing_readers() {
    for (name, bytes) in small_files() {
        let (whole, report) = load(name, bytes.clone()).expect("well formed");
        let slow = |fail_at| Slow {
            bytes: &bytes,
            fail_at,
            calls: 0,
        };
        let (dripped, again) =
            load_files(&mut OneFile::new(name, slow(None), None), name).expect("slow");
        assert_eq!((dripped, again.sha256), (whole, report.sha256));
        let mut failing = OneFile::new(name, slow(Some(100)), Some(bytes.len() as u64));
        let message = load_files(&mut failing, name)
            .expect_err("fails")
            .to_string();
        assert!(message.contains("the disk was taken out"), "{message}");
    }
}

/// Stops at the first progress.
struct Impatient(u32);

impl SubjectSink for Impatient {
    fn take(&mut self, part: SubjectPart) -> Result<(), String> {
        self.0 += u32::from(matches!(part, SubjectPart::Scalars(_)));
        Ok(())
    }
    fn progress(&mut self, _fraction: f32) -> bool {
        false
    }
}

#[test]
fn cancel_stops_within_a_slab() {
    let bytes = Nifti::new(2, [256, 256, 100], vec![0; 256 * 256 * 100]).bytes();
    for bytes in [gzip(&bytes), bytes] {
        let mut sink = Impatient(0);
        let mut report = LoadReport::default();
        let mut files = MemoryFiles::new([("a.nii", bytes)]);
        let result = read_volume(
            &mut files,
            "a.nii",
            &ReadOptions::default(),
            &mut sink,
            &mut report,
        );
        assert_eq!(result, Err(LoadError::Cancelled));
        assert!(sink.0 <= 1, "{} slabs after the stop", sink.0);
        assert_eq!(report.sha256, None);
    }
}

/// Holds the header and this many slabs, and refuses the next.
struct Full(u32);

impl SubjectSink for Full {
    fn take(&mut self, part: SubjectPart) -> Result<(), String> {
        if matches!(part, SubjectPart::Scalars(_)) {
            self.0 = self.0.checked_sub(1).ok_or("full")?;
        }
        Ok(())
    }
    fn progress(&mut self, _fraction: f32) -> bool {
        true
    }
}

#[test]
fn a_slab_that_is_refused_ends_the_load_with_the_reason() {
    let bytes = Nifti::new(2, [256, 256, 400], vec![0; 256 * 256 * 400]).bytes();
    for held in [0, 1] {
        let mut report = LoadReport::default();
        let mut files = MemoryFiles::new([("a.nii", bytes.clone())]);
        let options = ReadOptions::default();
        let result = read_volume(&mut files, "a.nii", &options, &mut Full(held), &mut report);
        let (name, message) = ("a.nii".to_owned(), "full".to_owned());
        assert_eq!(result, Err(LoadError::Refused { name, message }));
    }
}

#[test]
fn files_outside_are_not_asked_for() {
    struct Spy(Vec<String>);
    impl FileSet for Spy {
        fn open(&mut self, name: &str) -> io::Result<FileHandle<'_>> {
            self.0.push(name.to_owned());
            Err(io::ErrorKind::NotFound.into())
        }
    }
    let mut spy = Spy(Vec::new());
    let error = load_files(&mut spy, "a.nii").expect_err("nothing there");
    assert!(matches!(error, LoadError::Io { .. }), "{error}");
    assert_eq!(spy.0, ["a.nii"]);
}
