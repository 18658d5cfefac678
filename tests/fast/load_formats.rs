//! NRRD, MetaImage and raw voxels: real files against the facts known of them, written ones, broken ones.

use crate::data::data_folder;
use crate::scans::{Fact, Folder, Random, fact, load_files, load_path, rounds};
use fabrica::data::{Volume, VolumeBuilder, Voxels};
use fabrica::load::{
    self, LoadError, LoadReport, MemoryFiles, ReadOptions, Warning, orientation_code,
};
use glam::{DVec3, UVec3};

fn load(name: &str, bytes: Vec<u8>) -> Result<(Volume, LoadReport), LoadError> {
    load_files(&mut MemoryFiles::new([(name, bytes)]), name, 0)
}

/// What the folder's own README states, taken there with other programs.
const FACTS: &[Fact] = &[
    fact(
        "nrrd/chest_ct.nrrd",
        [128, 128, 34],
        [3.0469, 3.0469, 10.0],
        [-3024.0, 3070.0],
        "RAS",
        "int32",
    ),
    fact(
        "nrrd/chest_ct_segmentation.seg.nrrd",
        [128, 128, 34],
        [3.0469, 3.0469, 10.0],
        [0.0, 7.0],
        "RAS",
        "uint8",
    ),
    fact(
        "nrrd/brain_flair_oblique.nrrd",
        [124, 160, 140],
        [1.0; 3],
        [0.0, 255.0],
        "RAS",
        "uint8",
    ),
    fact(
        "nrrd/breast_mr.nrrd",
        [45, 120, 21],
        [0.6641, 0.6641, 2.1],
        [6.0, 248.0],
        "LPS",
        "int16",
    ),
    fact(
        "nrrd/breast_mr_label.nrrd",
        [45, 120, 21],
        [0.6641, 0.6641, 2.1],
        [0.0, 1.0],
        "LPS",
        "int16",
    ),
    fact(
        "mri/head_t1_skull_label.nrrd",
        [160, 232, 160],
        [1.0, 0.8984, 0.8984],
        [0.0, 1.0],
        "",
        "uint8",
    ),
    fact(
        "mri/head_t1_brain_label.nrrd",
        [160, 232, 160],
        [1.0, 0.8984, 0.8984],
        [0.0, 1.0],
        "",
        "uint8",
    ),
    fact(
        "ct/head_ct_headsq/quarter.nhdr",
        [64, 64, 93],
        [3.2, 3.2, 1.5],
        [0.0, 3926.0],
        "",
        "int16",
    ),
    fact(
        "raw/tooth.nhdr",
        [103, 94, 161],
        [1.0; 3],
        [0.0, 1300.0],
        "",
        "uint16",
    ),
    fact(
        "raw/foot.mha",
        [256, 256, 1],
        [1.0; 3],
        [0.0, 218.0],
        "",
        "uint8",
    ),
    fact(
        "metaimage/lung_ct.mha",
        [115, 157, 129],
        [1.366, 1.366, 2.5],
        [-1255.0, 1474.0],
        "LPS",
        "int16",
    ),
    fact(
        "metaimage/lung_ct_mask.mha",
        [115, 157, 129],
        [1.366, 1.366, 2.5],
        [0.0, 1.0],
        "LPS",
        "uint8",
    ),
    fact(
        "metaimage/brain_slice_2d.mha",
        [256, 256, 1],
        [1.0; 3],
        [-2.0, 217.0],
        "",
        "int16",
    ),
    fact(
        "metaimage/brain_epi.mha",
        [64, 64, 37],
        [3.4375, 3.4375, 3.8],
        [0.0, 6690.0],
        "LAS",
        "int16",
    ),
    fact(
        "metaimage/frogtissue.mhd",
        [500, 470, 136],
        [1.0, 1.0, 1.5],
        [0.0, 29.0],
        "LPS",
        "uint8",
    ),
    fact(
        "metaimage/HeadMRVolume.mhd",
        [48, 62, 42],
        [4.0; 3],
        [0.0, 255.0],
        "",
        "uint8",
    ),
];

#[test]
fn scans_have_the_facts_stated_of_them() {
    let Some(folder) = data_folder("scans_have_the_facts_stated_of_them") else {
        return;
    };
    for fact in FACTS {
        let volume = fact.load(&folder);
        assert_eq!(volume.value_range, fact.range, "{}: range", fact.file);
    }
}

/// Asserts that two volumes hold the same values at the same places, voxel for voxel.
fn assert_twins(a: &Volume, b: &Volume, bound_in_voxels: f64) {
    let b_from_a = b.grid.world_from_voxel.inverse() * a.grid.world_from_voxel;
    let dims = a.grid.dims;
    for z in (0..dims.z).step_by(7) {
        for y in (0..dims.y).step_by(5) {
            for x in 0..dims.x {
                let voxel = UVec3::new(x, y, z);
                let there = b_from_a.transform_point3(voxel.as_dvec3());
                assert!(
                    (there - there.round()).abs().max_element() < bound_in_voxels,
                    "{voxel} lies at {there}"
                );
                assert_eq!(
                    a.value_at(voxel),
                    b.value_at(there.round().as_uvec3()),
                    "at {voxel}"
                );
            }
        }
    }
}

#[test]
fn twins_agree_in_space() {
    let Some(folder) = data_folder("twins_agree_in_space") else {
        return;
    };
    let load = |name: &str| {
        load_path(&folder.join(name))
            .unwrap_or_else(|error| panic!("{name}: {error}"))
            .0
    };
    assert_twins(
        &load("mri/brain_flair_oblique.nii.gz"),
        &load("nrrd/brain_flair_oblique.nrrd"),
        1e-3,
    );
    // The label lies on its scan through space, its indices run the other way.
    let scan = load("mri/head_t1.nii.gz");
    let label = load("mri/head_t1_skull_label.nrrd");
    let label_from_scan = label.grid.world_from_voxel.inverse() * scan.grid.world_from_voxel;
    let there = label_from_scan.transform_point3(DVec3::new(10.0, 20.0, 30.0));
    assert!(
        (there - DVec3::new(149.0, 211.0, 30.0)).abs().max_element() < 0.6,
        "{there}"
    );
    let set: u64 = match &label.voxels {
        Voxels::U8(v) => v.iter().map(|&x| u64::from(x)).sum(),
        other => panic!("{other:?}"),
    };
    assert_eq!(set, 532_633);
    // The slices as they came and joined in one file hold the same numbers.
    let (joined, slices) = (
        load("ct/head_ct_headsq.nii.gz"),
        load("ct/head_ct_headsq/quarter.nhdr"),
    );
    assert_eq!(joined.voxels, slices.voxels);
    let hand = |volume: &Volume| volume.grid.world_from_voxel.matrix3.determinant().signum();
    assert_eq!(hand(&joined), hand(&slices), "left-handed both");
}

#[test]
fn the_ball_is_the_same_in_every_encoding() {
    let Some(folder) = data_folder("the_ball_is_the_same_in_every_encoding") else {
        return;
    };
    let folder = folder.join("nrrd/pynrrd");
    let (ball, _) = load_path(&folder.join("BallBinary30x30x30.nrrd")).expect("the ball");
    assert_eq!(ball.value_range, [0.0, 257.0]);
    for file in [
        "BallBinary30x30x30.nhdr",
        "BallBinary30x30x30_byteskip_minus_one.nhdr",
        "BallBinary30x30x30_byteskip_minus_one_nifti.nhdr",
        "BallBinary30x30x30_bz2.nrrd",
        "BallBinary30x30x30_gz.nrrd",
        "BallBinary30x30x30_gz_byteskip_minus_one.nrrd",
        "BallBinary30x30x30_gz_lineskip.nrrd",
    ] {
        let (other, report) =
            load_path(&folder.join(file)).unwrap_or_else(|error| panic!("{file}: {error}"));
        assert_eq!(other, ball, "{file}");
        assert_eq!(report.notices(), Vec::<String>::new(), "{file}");
    }
    for (file, words) in [
        (
            "BallBinary30x30x30_byteskip_minus_five.nhdr",
            "\"byteskip\" should be -1 or more, but is \"-5\"",
        ),
        (
            "BallBinary30x30x30_nifti.nhdr",
            "more than the header explains",
        ),
    ] {
        let message = load_path(&folder.join(file)).expect_err(file).to_string();
        println!("{message}");
        assert!(message.contains(words), "{message}");
    }
    let (line, _) = load_path(&folder.join("test1d_ascii.nrrd")).expect("one axis");
    assert_eq!(line.voxels, Voxels::U8((1..28).collect()));
    assert!((line.grid.spacing_mm().x - 1.0458).abs() < 1e-9);
    let (plane, _) = load_path(&folder.join("test2d_ascii.nrrd")).expect("two axes");
    assert_eq!(plane.voxels, Voxels::U16((1..28).collect()));
    assert_eq!(plane.grid.dims, UVec3::new(3, 9, 1));
    load_path(&folder.join("test_customFields.nrrd")).expect("own fields");
    let (one, _) =
        load_path(&folder.join("test_simple4d_raw.nrrd")).expect("an axis that is not in space");
    assert_eq!(orientation_code(&one.grid), "RAS");
    assert!(
        (one.grid.spacing_mm() - DVec3::new(1.5, 1.5, 1.0))
            .abs()
            .max_element()
            < 1e-9
    );
}

#[test]
fn segments_come_with_names_and_colours() {
    let Some(folder) = data_folder("segments_come_with_names_and_colours") else {
        return;
    };
    let (_, report) =
        load_path(&folder.join("nrrd/chest_ct_segmentation.seg.nrrd")).expect("it loads");
    assert!(report.is_labels, "3D Slicer's keys say so");
    let names: Vec<&str> = report
        .segments
        .iter()
        .map(|segment| segment.name.as_str())
        .collect();
    assert_eq!(
        names,
        [
            "ribs",
            "cervical vertebral column",
            "thoracic vertebral column",
            "lumbar vertebral column",
            "right lung",
            "left lung",
            "tissue"
        ]
    );
    assert_eq!(report.segments[0].color_srgb, Some([253, 232, 158]));
    assert_eq!(report.notices(), Vec::<String>::new());
}

fn nrrd(lines: &str, voxels: &[u8]) -> Vec<u8> {
    let mut bytes = format!("NRRD0005\n{lines}\n").into_bytes();
    bytes.extend(voxels);
    bytes
}

#[test]
fn files_without_a_voxel_size_say_so() {
    let has_size = |name: &str, bytes: Vec<u8>| {
        let (volume, _) = load(name, bytes).expect("a volume");
        assert!(volume.grid.mm_per_unit() > 0.0, "1 mm is taken");
        volume.has_size
    };
    let of = |lines: &str| {
        nrrd(
            &format!("type: uint8\ndimension: 3\nsizes: 2 2 2\nencoding: raw\n{lines}"),
            &[1, 2, 3, 4, 5, 6, 7, 8],
        )
    };
    assert!(has_size("a.nrrd", of("spacings: 1 1 2\n")));
    assert!(has_size(
        "a.nrrd",
        of("space: right-anterior-superior\nspace directions: (1,0,0) (0,1,0) (0,0,1)\n")
    ));
    assert!(!has_size("a.nrrd", of("")));
    assert!(!has_size("a.nrrd", of("spacings: 1 1 0\n")));
    let meta = |line: &str| {
        let header = format!(
            "ObjectType = Image\nNDims = 3\nDimSize = 2 2 2\n{line}ElementType = MET_UCHAR\nElementDataFile = LOCAL\n"
        );
        [header.as_bytes(), &[1, 2, 3, 4, 5, 6, 7, 8]].concat()
    };
    assert!(has_size("a.mha", meta("ElementSpacing = 1 1 1\n")));
    assert!(!has_size("a.mha", meta("")));
}

#[test]
fn axes_out_of_space_are_components_or_frames() {
    let voxels: Vec<u8> = (0..48).collect();
    // Two components per voxel, 2 × 3 × 4.
    let bytes = nrrd(
        "type: uchar\ndimension: 4\nsizes: 2 2 3 4\nkinds: vector domain domain domain\nencoding: raw\nspace: RAS\nspace directions: none (1,0,0) (0,1,0) (0,0,1)\n",
        &voxels,
    );
    for component in 0..2u8 {
        let mut files = MemoryFiles::new([("a.nrrd", bytes.clone())]);
        let (volume, report) =
            load_files(&mut files, "a.nrrd", component.into()).expect("components");
        assert_eq!(
            volume.voxels,
            Voxels::U8((0..24).map(|i| 2 * i + component).collect())
        );
        assert_eq!(
            report.warnings,
            [Warning::Frames {
                count: 2,
                shown: component.into()
            }]
        );
    }
    // Two frames.
    let bytes = nrrd(
        "type: uint8\ndimension: 4\nsizes: 2 3 4 2\nkinds: space space space time\nspacings: 1 1 2 NaN\nencoding: raw\n",
        &voxels,
    );
    let mut files = MemoryFiles::new([("a.nrrd", bytes)]);
    let (volume, _) = load_files(&mut files, "a.nrrd", 1).expect("frames");
    assert_eq!(volume.voxels, Voxels::U8((24..48).collect()));
    assert_eq!(volume.grid.spacing_mm(), DVec3::new(1.0, 1.0, 2.0));
    assert!(matches!(
        load_files(&mut files, "a.nrrd", 2),
        Err(LoadError::NoSuchFrame { count: 2, .. })
    ));
    let colour = nrrd(
        "type: uchar\ndimension: 4\nsizes: 3 2 2 4\nkinds: RGB-color domain domain domain\nencoding: raw\n",
        &voxels,
    );
    // Colours: their brightness is read (ITU-R BT.709), with a warning.
    let (volume, report) = load("a.nrrd", colour).expect("colour");
    assert!(report.warnings.contains(&Warning::Luminance));
    let luma = |i: usize| {
        let part = |k: usize| f32::from(voxels[3 * i + k]);
        (0.2126 * part(0) + 0.7152 * part(1) + 0.0722 * part(2)).round() as u8
    };
    assert_eq!(volume.voxels, Voxels::U8((0..16).map(luma).collect()));
}

#[test]
fn lists_patterns_orders_and_texts() {
    let part = |i: u8| vec![i * 2, 0, i * 2 + 1, 0];
    for (data_file, names) in [
        (
            "LIST\nx.raw\nsub/y.raw\nz.raw",
            ["x.raw", "sub/y.raw", "z.raw"],
        ),
        ("s%02d.raw 3 1 -1", ["s03.raw", "s02.raw", "s01.raw"]),
        ("s %d.raw 1 5 2 2", ["s 1.raw", "s 3.raw", "s 5.raw"]),
    ] {
        let header = format!(
            "NRRD0004\ntype: short\ndimension: 3\nsizes: 2 1 3\nendian: little\nencoding: raw\nspace: left-posterior-superior\nspace directions: (1,0,0) (0,2,0) (0,0,3)\ndata file: {data_file}\n"
        );
        let mut all = vec![("a.nhdr".to_owned(), header.into_bytes())];
        for (i, name) in names.iter().enumerate() {
            all.push(((*name).to_owned(), part(i as u8)));
        }
        let mut files = MemoryFiles::new(all.clone());
        let (volume, _) = load_files(&mut files, "a.nhdr", 0)
            .unwrap_or_else(|error| panic!("{data_file}: {error}"));
        assert_eq!(volume.voxels, Voxels::I16(vec![0, 1, 2, 3, 4, 5]));
        assert_eq!(orientation_code(&volume.grid), "LPS");
        let message = load_files(&mut MemoryFiles::new(all[..3].to_vec()), "a.nhdr", 0)
            .expect_err("one is missing")
            .to_string();
        assert!(
            message.contains(names[2]) && message.contains("not given"),
            "{message}"
        );
        if data_file.starts_with("LIST") {
            // Dropped on a page, a file has lost its folder.
            let mut flat = all.clone();
            flat[2].0 = "y.raw".to_owned();
            load_files(&mut MemoryFiles::new(flat), "a.nhdr", 0).expect("found by its last name");
        }
        all[2].1.pop();
        load_files(&mut MemoryFiles::new(all), "a.nhdr", 0).expect_err("one is short");
    }
    let big = nrrd(
        "type: short\ndimension: 3\nsizes: 2 1 1\nendian: big\nencoding: hex\n",
        b"0001\nff FE ",
    );
    assert_eq!(
        load("a.nrrd", big).expect("hexadecimal").0.voxels,
        Voxels::I16(vec![1, -2])
    );
    let text = nrrd(
        "type: float\ndimension: 1\nsizes: 3\nencoding: text\n",
        b" 1.5,-2e3\n nan",
    );
    assert_eq!(
        load("a.nrrd", text).expect("text").0.voxels,
        Voxels::F32(vec![1.5, -2000.0, 0.0])
    );
    let wrong = nrrd(
        "type: uchar\ndimension: 1\nsizes: 3\nencoding: text\n",
        b"1 2 300",
    );
    let message = load("a.nrrd", wrong)
        .expect_err("300 is no byte")
        .to_string();
    assert!(message.contains("300"), "{message}");
    for (space, code) in [
        ("RAS", "RAS"),
        ("left-anterior-superior", "LAS"),
        ("LPS", "LPS"),
        ("left posterior superior", "LPS"),
    ] {
        let file = nrrd(
            &format!(
                "type: uchar\ndimension: 3\nsizes: 2 2 1\nencoding: raw\nspace: {space}\nspace directions: (1,0,0) (0,1,0) (0,0,1)\nspace origin: (1,2,3)\nspace units: \"cm\" \"cm\" \"cm\"\n"
            ),
            &[0, 1, 2, 3],
        );
        let (volume, report) = load("a.nrrd", file).expect("a space");
        assert_eq!(orientation_code(&volume.grid), code);
        assert_eq!(volume.grid.spacing_mm(), DVec3::splat(10.0));
        assert_eq!(report.notices(), Vec::<String>::new());
    }
}

#[test]
fn metaimage_directions_and_parts() {
    let header = "ObjectType = Image\nNDims = 3\nDimSize = 2 1 2\nElementType = MET_USHORT\nBinaryDataByteOrderMSB = True\nTransformMatrix = 0 1 0 0 0 1 1 0 0\nElementSpacing = 1 2 3\nOffset = 1 2 3\nElementDataFile = ";
    let voxels = [0, 1, 0, 2, 0, 3, 0, 4];
    let mut local = format!("{header}LOCAL\n").into_bytes();
    local.extend(voxels);
    let (volume, report) = load("a.mha", local.clone()).expect("local");
    assert_eq!(volume.voxels, Voxels::U16(vec![1, 2, 3, 4]));
    // Axis 1 goes along LPS y, axis 2 along z, axis 3 along x.
    assert_eq!(orientation_code(&volume.grid), "PSL");
    assert_eq!(
        volume.grid.world_from_voxel.translation,
        DVec3::new(-1.0, -2.0, 3.0)
    );
    assert_eq!(report.notices(), Vec::<String>::new());
    for list in ["LIST\nb.raw\nc.raw\n", "%c.raw"] {
        let mut files = MemoryFiles::new([
            ("a.mhd", format!("{header}{list}").into_bytes()),
            ("b.raw", voxels[..4].to_vec()),
            ("c.raw", voxels[4..].to_vec()),
        ]);
        let result = load_files(&mut files, "a.mhd", 0);
        if list.starts_with("LIST") {
            assert_eq!(result.expect("a list").0, volume);
        } else {
            result.expect_err("no such file");
        }
    }
    for len in 0..local.len() {
        load("a.mha", local[..len].to_vec()).expect_err("cut");
    }
    let rgb = "ObjectType = Image\nNDims = 2\nDimSize = 1 1\nElementNumberOfChannels = 3\nElementType = MET_UCHAR\nElementDataFile = LOCAL\n123";
    let (volume, report) = load("a.mha", rgb.as_bytes().to_vec()).expect("colour");
    assert!(report.warnings.contains(&Warning::Luminance), "{report:?}");
    assert_eq!(
        volume.voxels,
        Voxels::U8(vec![b'2']),
        "1, 2 and 3 are as bright as 2"
    );
}

#[test]
fn damaged_headers_give_a_volume_or_a_message() {
    let gz = {
        use std::io::Write as _;
        let mut encoder = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
        encoder
            .write_all(&(0..120).collect::<Vec<u8>>())
            .expect("memory takes it");
        encoder.finish().expect("memory takes it")
    };
    let space = "space: LPS\nspace directions: (1,0,0) (0,1,0) (0,0.5,2)\nspace origin: (3,4,5)\n";
    let files: Vec<(&str, Vec<u8>)> = vec![
        ("a.nrrd", nrrd(&format!("type: short\ndimension: 3\nsizes: 5 4 3\nendian: little\nencoding: gzip\n{space}"), &gz)),
        ("b.nrrd", nrrd("type: uchar\ndimension: 4\nsizes: 2 5 4 3\nkinds: list domain domain domain\nspacings: nan 1 1 2\nencoding: raw\nbyte skip: 0\n", &[7; 120])),
        ("c.nrrd", nrrd("type: float\ndimension: 2\nsizes: 3 2\nencoding: ascii\nline skip: 1\nspacings: 1 2\n", b"skip\n1 2 3.5 -4 5e3 6")),
        ("d.mha", [b"ObjectType = Image\nNDims = 3\nDimSize = 5 4 3\nElementSpacing = 1 1 2\nTransformMatrix = 1 0 0 0 1 0 0 0 1\nOffset = 1 2 3\nElementType = MET_SHORT\nElementDataFile = LOCAL\n".as_slice(), &[9; 120]].concat()),
        ("e.nhdr", b"NRRD0004\ntype: uchar\ndimension: 3\nsizes: 2 2 2\nencoding: raw\ndata file: p%d 1 2 1\n".to_vec()),
    ];
    let mut random = Random(99);
    let (mut loaded, mut refused) = (0, 0);
    for (name, bytes) in files {
        let beside = [("p1", vec![1; 4]), ("p2", vec![2; 4])];
        for round in 0..rounds(2000) {
            let mut bytes = bytes.clone();
            match round {
                0 => {}
                _ if round <= bytes.len() => bytes.truncate(round - 1),
                _ => {
                    for _ in 0..1 + random.next() % 3 {
                        let at = random.next() % bytes.len();
                        match random.next() % 3 {
                            0 => bytes[at] ^= 1 << (random.next() % 8),
                            // Another digit hurts more than another letter.
                            1 => bytes[at] = b'0' + (random.next() % 10) as u8,
                            _ => {
                                let digits = [
                                    b"9".as_slice(),
                                    b"-",
                                    b"e9",
                                    b"99999999999",
                                    b"nan",
                                    b"none",
                                    b"\n",
                                ][random.next() % 7];
                                bytes.splice(at..at, digits.iter().copied());
                            }
                        }
                    }
                }
            }
            let all = std::iter::once((name, bytes)).chain(beside.clone());
            match load_files(&mut MemoryFiles::new(all), name, 0) {
                Ok((volume, _)) => {
                    assert!(volume.grid.mm_per_unit().is_finite(), "a size");
                    assert!(volume.grid.texture_from_subject().is_finite(), "invertible");
                    loaded += 1;
                }
                Err(error) => {
                    assert!(!error.to_string().contains('\n'), "one line: {error}");
                    assert!(round > 0, "{name}: {error}");
                    refused += 1;
                }
            }
        }
    }
    println!("{loaded} loaded, {refused} refused");
    assert!(
        loaded > 1000 && refused > 1000,
        "both happen: {loaded} {refused}"
    );
}

#[test]
fn labels_lie_on_their_scan_or_on_their_own_grid() {
    let Some(folder) = data_folder("labels_lie_on_their_scan_or_on_their_own_grid") else {
        return;
    };
    let mut files = Folder::new(&folder);
    let mut subject = |scan: &str, labels: Option<&str>| {
        let mut builder = VolumeBuilder::new();
        let mut report = LoadReport::default();
        let source = load::LabelSource {
            name: labels.map(str::to_owned),
            names: [(5, "the liver".to_owned())].into(),
        };
        load::read_subject(
            &mut files,
            scan,
            &source,
            &ReadOptions::default(),
            &mut builder,
            &mut report,
        )
        .unwrap_or_else(|error| panic!("{scan}: {error}"));
        builder.finish().expect("all came")
    };
    let volume = subject(
        "ct/abdomen_ct_small.nii.gz",
        Some("ct/abdomen_ct_small_labels.nii.gz"),
    );
    let labels = volume.segmentation.expect("labels");
    assert_eq!(labels.grid, volume.grid);
    assert_eq!(labels.segments.len(), 41);
    let name = |label: u16| {
        labels
            .segments
            .iter()
            .find(|segment| segment.label == label)
            .map(|segment| segment.name.as_str())
    };
    assert_eq!(
        (name(1), name(5), name(12)),
        (Some("spleen"), Some("the liver"), None)
    );

    // Of another format, on a grid that runs the other way.
    let volume = subject("mri/head_t1.nii.gz", Some("mri/head_t1_skull_label.nrrd"));
    let labels = volume.segmentation.expect("labels");
    assert_ne!(labels.grid, volume.grid);
    assert_eq!(
        labels.labels.iter().filter(|&&label| label == 1).count(),
        532_633
    );

    // A file that says it holds labels brings them itself; a scan does not.
    let volume = subject("nrrd/chest_ct_segmentation.seg.nrrd", None);
    assert_eq!(
        volume.segmentation.expect("its own").segments[0].name,
        "ribs"
    );
    assert_eq!(
        subject("mri/aal_labels_1mm.nii.gz", None)
            .segmentation
            .expect("its own")
            .segments
            .len(),
        116
    );
    assert_eq!(
        subject("ct/abdomen_ct_small.nii.gz", None).segmentation,
        None
    );

    let error = load::read_labels(
        &mut files,
        "ct/abdomen_ct_small.nii.gz",
        &std::collections::BTreeMap::new(),
        &ReadOptions::default(),
        &mut LoadReport::default(),
    )
    .expect_err("values below 0");
    println!("{error}");
    assert!(matches!(error, LoadError::NotLabels { .. }), "{error}");

    let (header, report) = load::read_header(
        &mut files,
        "mri/nifti_variants/nibabel_functional.nii",
        &ReadOptions::default(),
    )
    .expect("a header");
    assert_eq!(
        (header.grid.dims, report.frame_count),
        (UVec3::new(17, 21, 3), 20)
    );
}

#[test]
fn label_numbers_beyond_a_byte_are_renumbered() {
    let bytes = |numbers: &[u16]| {
        let voxels: Vec<u8> = numbers.iter().flat_map(|x| x.to_le_bytes()).collect();
        nrrd(
            &format!(
                "type: ushort\ndimension: 1\nsizes: {}\nendian: little\nencoding: raw\n",
                numbers.len()
            ),
            &voxels,
        )
    };
    let read = |numbers: &[u16]| {
        load::read_labels(
            &mut MemoryFiles::new([("a.nrrd", bytes(numbers))]),
            "a.nrrd",
            &[(1002, "bone".to_owned())].into(),
            &ReadOptions::default(),
            &mut LoadReport::default(),
        )
    };
    let labels = read(&[0, 2035, 1002, 7, 0, 1002]).expect("labels");
    assert_eq!(labels.labels, [0, 3, 2, 1, 0, 2]);
    let names: Vec<_> = labels
        .segments
        .iter()
        .map(|segment| (segment.label, segment.name.as_str()))
        .collect();
    assert_eq!(names, [(1, "segment 7"), (2, "bone"), (3, "segment 2035")]);
    assert_eq!(read(&[0, 255, 3]).expect("labels").labels, [0, 255, 3]);
    let many: Vec<u16> = (0..300).collect();
    assert!(matches!(read(&many), Err(LoadError::NotLabels { .. })));
    assert_eq!(read(&many[..256]).expect("just fits").segments.len(), 255);
}

#[test]
fn raw_voxels_with_dimensions_given() {
    let Some(folder) = data_folder("raw_voxels_with_dimensions_given") else {
        return;
    };
    let mut files = Folder::new(folder.join("raw"));
    let mut read = |name: &str, layout: &load::RawLayout| {
        let mut builder = VolumeBuilder::new();
        let mut report = LoadReport::default();
        load::read_raw(
            &mut files,
            name,
            layout,
            &ReadOptions::default(),
            &mut builder,
            &mut report,
        )
        .map(|()| (builder.finish().expect("all came"), report))
    };
    let name = "stent_128x128x256_int16le.raw.gz";
    let layout = load::RawLayout::guess(name, None).expect("the name says it");
    let (stent, report) = read(name, &layout).expect("it loads");
    assert_eq!(
        (stent.grid.dims, stent.value_range),
        (UVec3::new(128, 128, 256), [0.0, 2000.0])
    );
    assert_eq!(report.warnings, [Warning::NoOrientation]);
    // The tooth through its header and as bare voxels; with the bytes swapped it is another picture.
    let mut layout = load::RawLayout {
        dims: UVec3::new(103, 94, 161),
        element: load::ElementType::U16,
        big_endian: true,
        spacing_mm: DVec3::ONE,
        header_bytes: 0,
    };
    let (tooth, _) = read("tooth.raw", &layout).expect("it loads");
    assert_eq!(tooth.value_range, [0.0, 1300.0]);
    assert_eq!(
        tooth.voxels,
        load_path(&folder.join("raw/tooth.nhdr"))
            .expect("it loads")
            .0
            .voxels
    );
    layout.big_endian = false;
    assert_ne!(
        read("tooth.raw", &layout).expect("it loads").0.value_range,
        [0.0, 1300.0]
    );
    layout.dims.z += 1;
    assert!(matches!(
        read("tooth.raw", &layout),
        Err(LoadError::Truncated { .. })
    ));
    layout.dims.z -= 2;
    assert!(
        read("tooth.raw", &layout)
            .expect("it loads")
            .1
            .warnings
            .contains(&Warning::TrailingBytes)
    );
}
