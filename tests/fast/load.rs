//! Files in, volumes out: real scans against the facts known of them, written ones in every type and order, broken
//! ones.

use crate::data::data_folder;
use crate::scans::{Fact, Folder, fact, load_frame, load_path};
use fabrica::data::Voxels;
use fabrica::load::{self, FileSet, LoadError, ReadOptions, Warning};
use glam::{DVec3, UVec3};

/// What the folder's own README states, taken there with other programs.
const FACTS: &[Fact] = &[
    fact(
        "ct/chest_ct_2mm.nii.gz",
        [256, 194, 137],
        [1.5625, 1.5625, 2.0],
        [-1000.0, 1851.0],
        "LPS",
        "int16",
    ),
    fact(
        "ct/abdomen_ct.nii.gz",
        [122, 101, 112],
        [3.0; 3],
        [-1207.0, 3382.0],
        "RAS",
        "int32",
    ),
    fact(
        "ct/abdomen_ct_vertebrae_labels.nii.gz",
        [122, 101, 112],
        [3.0; 3],
        [0.0, 33.0],
        "RAS",
        "uint8",
    ),
    fact(
        "ct/abdomen_ct_small.nii.gz",
        [122, 101, 30],
        [3.0; 3],
        [-1100.0, 1207.0],
        "RAS",
        "int16",
    ),
    fact(
        "ct/abdomen_ct_small_labels.nii.gz",
        [122, 101, 30],
        [3.0; 3],
        [0.0, 117.0],
        "RAS",
        "uint8",
    ),
    fact(
        "ct/thigh_femur_ct.nii.gz",
        [86, 86, 182],
        [1.7, 1.7, 3.0],
        [-1305.0, 2082.0],
        "LPS",
        "int16",
    ),
    fact(
        "ct/head_ct_headsq.nii.gz",
        [64, 64, 93],
        [3.2, 3.2, 1.5],
        [0.0, 3926.0],
        "LPI",
        "int16",
    ),
    fact(
        "ct/head_phantom_ct_pitch.nii.gz",
        [175, 248, 58],
        [0.8125, 0.8125, 2.397],
        [0.0, 255.0],
        "RAS",
        "uint8",
    ),
    fact(
        "ct/head_phantom_ct_shear.nii.gz",
        [306, 422, 54],
        [0.4824, 0.4824, 2.371],
        [-1024.0, 789.0],
        "RAS",
        "uint8",
    ),
    fact(
        "ct/head_ct_template_2mm.nii.gz",
        [91, 109, 91],
        [2.0; 3],
        [0.0, 3794.0],
        "LAS",
        "uint8",
    ),
    fact(
        "mri/head_t1.nii.gz",
        [160, 232, 160],
        [1.0, 0.8984, 0.8984],
        [0.0, 512.0],
        "RAS",
        "uint8",
    ),
    fact(
        "mri/mni152_t1_2mm.nii.gz",
        [91, 109, 91],
        [2.0; 3],
        [0.0, 9968.0],
        "LAS",
        "int16",
    ),
    fact(
        "mri/mni152_deface_mask_2mm.nii.gz",
        [91, 109, 91],
        [2.0; 3],
        [0.0, 1.0],
        "LAS",
        "uint8",
    ),
    fact(
        "mri/aal_labels_1mm.nii.gz",
        [181, 217, 181],
        [1.0; 3],
        [0.0, 116.0],
        "RAS",
        "uint8",
    ),
    fact(
        "mri/brain_flair_oblique.nii.gz",
        [124, 160, 140],
        [1.0; 3],
        [0.0, 255.0],
        "RAS",
        "uint8",
    ),
    fact(
        "mri/abdomen_mr_small.nii.gz",
        [117, 91, 20],
        [3.0; 3],
        [-47.0, 833.0],
        "LPS",
        "int16",
    ),
    fact(
        "mri/abdomen_mr_small_labels.nii.gz",
        [117, 91, 20],
        [3.0; 3],
        [0.0, 49.0],
        "LPS",
        "uint8",
    ),
    fact(
        "mri/avg152T1_LR_nifti.nii.gz",
        [91, 109, 91],
        [2.0; 3],
        [0.0, 255.0],
        "LAS",
        "uint8",
    ),
    fact(
        "mri/avg152T1_RL_nifti.nii.gz",
        [91, 109, 91],
        [2.0; 3],
        [0.0, 255.0],
        "RAS",
        "uint8",
    ),
    fact(
        "mri/nifti_variants/nibabel_anatomical.nii",
        [33, 41, 25],
        [2.0; 3],
        [-610.0, 30393.0],
        "LAS",
        "int16",
    ),
    fact(
        "mri/nifti_variants/nibabel_standard.nii.gz",
        [4, 5, 7],
        [1.0, 3.0, 2.0],
        [0.0, 255.0],
        "RAS",
        "uint8",
    ),
    fact(
        "mri/nifti_variants/nibabel_reoriented_anat_moved.nii",
        [21, 26, 22],
        [4.0; 3],
        [0.0, 21200.0],
        "",
        "float32",
    ),
    fact(
        "mri/nifti_variants/minimal.nii.gz",
        [64, 64, 10],
        [3.0; 3],
        [0.0, 63.0],
        "RAS",
        "uint8",
    ),
    fact(
        "mri/nifti_variants/minimal.hdr",
        [64, 64, 10],
        [3.0; 3],
        [0.0, 63.0],
        "RAS",
        "uint8",
    ),
    fact(
        "mri/nifti_variants/minimal.img",
        [64, 64, 10],
        [3.0; 3],
        [0.0, 63.0],
        "RAS",
        "uint8",
    ),
    fact(
        "mri/nifti_variants/minimal_extended_hdr.nii",
        [8, 8, 1],
        [1.0; 3],
        [0.0, 0.0],
        "",
        "float64",
    ),
    fact(
        "mri/nifti_variants/f32.nii.gz",
        [11, 11, 11],
        [1.0; 3],
        [0.0, 1.0],
        "",
        "float32",
    ),
    fact(
        "mri/nifti_variants/tiny_7x5x3.nii.gz",
        [7, 5, 3],
        [2.0; 3],
        [0.0, 1.0],
        "",
        "uint8",
    ),
    fact(
        "displacement/dti_fa.nii.gz",
        [84, 92, 56],
        [2.2; 3],
        [0.0, 1.2247],
        "LAS",
        "float32",
    ),
];

#[test]
fn scans_have_the_facts_stated_of_them() {
    let Some(folder) = data_folder("scans_have_the_facts_stated_of_them") else {
        return;
    };
    for fact in FACTS {
        let (name, volume) = (fact.file, fact.load(&folder));
        for (found, stated) in volume.value_range.into_iter().zip(fact.range) {
            // The README rounds fractions, scaled ones to whole numbers.
            let slack = match fact.stored {
                "float32" => 0.1,
                _ if volume.slope == 1.0 => 1e-4,
                _ => 0.5,
            };
            assert!(
                (found - stated).abs() <= slack,
                "{name}: range {:?}",
                volume.value_range
            );
        }
    }
}

#[test]
fn hash_is_that_of_the_file() {
    let Some(folder) = data_folder("hash_is_that_of_the_file") else {
        return;
    };
    let sums = std::fs::read_to_string(folder.join("SHA256SUMS")).expect("the list of sums");
    let mut checked = 0;
    for fact in FACTS {
        let Some(line) = sums.lines().find(|line| line.ends_with(fact.file)) else {
            continue;
        };
        if fact.file.ends_with(".hdr") || fact.file.ends_with(".img") {
            continue;
        }
        let (_, report) = load_path(&folder.join(fact.file)).expect("it loads");
        let hash = report.sha256_hex().expect("a hash");
        assert!(line.starts_with(&hash), "{}: {hash}", fact.file);
        checked += 1;
    }
    assert!(checked > 20, "only {checked} sums were found");
}

#[test]
fn every_type_holds_0_to_26() {
    let Some(folder) = data_folder("every_type_holds_0_to_26") else {
        return;
    };
    let types = [
        "uint8", "int8", "uint16", "int16", "uint32", "int32", "uint64", "int64", "float32",
        "float64",
    ];
    for stored in types {
        let file = format!("mri/nifti_variants/dtype_{stored}_3x3x3.nii");
        let (volume, report) =
            load_path(&folder.join(&file)).unwrap_or_else(|error| panic!("{file}: {error}"));
        assert_eq!(report.stored_type, stored);
        // They were counted with the last axis running fastest.
        let values: Vec<f32> = (0..27)
            .map(|i| {
                volume
                    .value_at(UVec3::new(i / 9, i / 3 % 3, i % 3))
                    .expect("inside")
            })
            .collect();
        let expected: Vec<f32> = (0..27u8).map(f32::from).collect();
        assert_eq!(values, expected, "{file}");
    }
}

#[test]
fn left_and_right_storage_agree_in_subject_space() {
    let Some(folder) = data_folder("left_and_right_storage_agree_in_subject_space") else {
        return;
    };
    let (lr, _) = load_path(&folder.join("mri/avg152T1_LR_nifti.nii.gz")).expect("it loads");
    let (rl, _) = load_path(&folder.join("mri/avg152T1_RL_nifti.nii.gz")).expect("it loads");
    let rl_from_subject = rl.grid.subject_from_voxel().inverse();
    let mut differing_if_not_flipped = 0;
    for z in (0..91).step_by(3) {
        for y in (0..109).step_by(3) {
            for x in 0..91 {
                let voxel = UVec3::new(x, y, z);
                let pos_in_subject = lr
                    .grid
                    .subject_from_voxel()
                    .transform_point3(voxel.as_dvec3());
                let there = rl_from_subject.transform_point3(pos_in_subject);
                assert!(
                    (there - there.round()).abs().max_element() < 1e-6,
                    "not on a voxel: {there}"
                );
                let value = rl.value_at(there.round().as_uvec3());
                assert_eq!(lr.value_at(voxel), value, "at {voxel}");
                differing_if_not_flipped += u32::from(lr.value_at(voxel) != rl.value_at(voxel));
            }
        }
    }
    // Negative control: without the orientation the two are different pictures.
    assert!(
        differing_if_not_flipped > 10_000,
        "the pictures are symmetric"
    );
}

#[test]
fn frames_are_chosen() {
    let Some(folder) = data_folder("frames_are_chosen") else {
        return;
    };
    let path = folder.join("mri/nifti_variants/nibabel_functional.nii");
    let (mut low, mut high) = (f32::INFINITY, f32::NEG_INFINITY);
    let mut seen = Vec::new();
    for frame in 0..20 {
        let (volume, report) = load_frame(&path, frame).expect("it loads");
        assert_eq!(report.frame_count, 20);
        assert!(report.warnings.contains(&Warning::Frames {
            count: 20,
            shown: frame
        }));
        assert_eq!(volume.grid.dims, UVec3::new(17, 21, 3));
        assert!(
            (volume.grid.spacing_mm() - DVec3::new(4.0, 4.0, 8.0))
                .abs()
                .max_element()
                < 1e-5
        );
        low = low.min(volume.value_range[0]);
        high = high.max(volume.value_range[1]);
        seen.push(volume.voxels);
    }
    assert!(
        (low - 629.8).abs() < 0.1 && (high - 5571.6).abs() < 0.1,
        "{low} {high}"
    );
    assert_ne!(seen[0], seen[19], "frames differ");
    assert!(matches!(
        load_frame(&path, 20),
        Err(LoadError::NoSuchFrame {
            asked: 20,
            count: 20,
            ..
        })
    ));
    let (volume, report) = load_frame(
        &folder.join("mri/nifti_variants/nibabel_example_nifti2.nii.gz"),
        1,
    )
    .expect("NIfTI-2");
    assert_eq!(report.format, Some(load::Format::Nifti2));
    assert_eq!(volume.grid.dims, UVec3::new(32, 20, 12));
    let (volume, _) =
        load_path(&folder.join("mri/nifti_variants/nibabel_example4d.nii.gz")).expect("4D");
    assert_eq!(volume.grid.dims, UVec3::new(128, 96, 24));
}

#[test]
fn colours_are_read_as_brightness() {
    let Some(folder) = data_folder("colours_are_read_as_brightness") else {
        return;
    };
    for (file, components) in [
        ("rgb24_3d.nii", 3),
        ("rgb24_4d.nii", 3),
        ("rgba32_4d.nii", 4),
    ] {
        let path = folder.join("mri/nifti_variants").join(file);
        let bytes = std::fs::read(&path).expect(file);
        let (volume, report) = load_path(&path).expect(file);
        assert!(
            report.warnings.contains(&load::Warning::Luminance),
            "{file}: {report:?}"
        );
        assert_eq!(volume.grid.dims, UVec3::splat(3), "{file}");
        let Voxels::U8(voxels) = &volume.voxels else {
            panic!("{file}: bytes");
        };
        for (voxel, color) in voxels.iter().zip(bytes[352..].chunks_exact(components)) {
            let part = |i: usize| f64::from(color[i]);
            let opacity = if components == 4 {
                part(3) / 255.0
            } else {
                1.0
            };
            let expected = (0.2126 * part(0) + 0.7152 * part(1) + 0.0722 * part(2)) * opacity;
            assert!(
                (f64::from(*voxel) - expected).abs() <= 0.51,
                "{file}: {voxel} for {color:?}"
            );
        }
    }
}

#[test]
fn what_is_not_read_says_so() {
    let Some(folder) = data_folder("what_is_not_read_says_so") else {
        return;
    };
    for (file, words) in [
        ("mri/nifti_variants/nibabel_test.mgz", "MGH"),
        ("ct/stent_ct.npz", "ZIP"),
        ("mesh/bunny.obj", "surface"),
        ("README.md", "not a volume file"),
        (
            "malformed/nifti/nifti_crash-08123ef3.nii",
            "sizeof_hdr at byte 0",
        ),
        ("malformed/nifti/nifti_crash-98aa0543.nii", ""),
        ("malformed/nifti/nifti_crash-d03c6346.nii", "sizeof_hdr"),
        (
            "malformed/nifti/minimal2.img_without_hdr.gz",
            "not a volume file",
        ),
    ] {
        let error = load_path(&folder.join(file)).expect_err(file);
        let message = error.to_string();
        println!("{message}");
        assert!(message.contains(words), "{file}: {message}");
        assert!(!message.contains('\n'), "{file}: one line");
    }
}

#[test]
fn every_file_loads_but_those_refused_for_a_stated_reason() {
    let Some(folder) = data_folder("every_file_loads_but_those_refused_for_a_stated_reason") else {
        return;
    };
    let refused = [
        ("mri/nifti_variants/nibabel_test.mgz", "MGH"),
        ("nrrd/pynrrd/BallBinary30x30x30.raw", "not a volume file"),
        (
            "nrrd/pynrrd/BallBinary30x30x30_byteskip_minus_five.nhdr",
            "-5",
        ),
        (
            "nrrd/pynrrd/BallBinary30x30x30_nifti.nhdr",
            "more than the header explains",
        ),
        ("raw/foot.raw", "not a volume file"),
        ("raw/stent_128x128x256_int16le.raw.gz", "not a volume file"),
        ("raw/tooth.raw", "not a volume file"),
    ];
    let mut count = 0;
    for place in ["nrrd", "raw", "mri/nifti_variants"] {
        for name in Folder::new(folder.join(place)).names() {
            let name = format!("{place}/{name}");
            let expected = refused.iter().find(|(refused, _)| *refused == name);
            match (load_path(&folder.join(&name)), expected) {
                (Ok((volume, report)), None) => {
                    assert_eq!(volume.voxels.len(), volume.grid.voxel_count(), "{name}");
                    assert!(report.sha256.is_some(), "{name}");
                }
                (Err(error), Some((_, words))) => {
                    assert!(error.to_string().contains(words), "{name}: {error}");
                    count += 1;
                }
                (Ok(_), Some(_)) => panic!("{name} was read"),
                (Err(error), None) => panic!("{name}: {error}"),
            }
        }
    }
    assert_eq!(count, refused.len(), "all of them were there");
}

#[test]
fn a_file_is_described_without_its_texts() {
    let Some(folder) = data_folder("a_file_is_described_without_its_texts") else {
        return;
    };
    for (file, lines) in [
        (
            "ct/abdomen_ct_small_labels.nii.gz",
            &[
                "kind: NIfTI-1, label volume, uint8",
                "size: 122 × 101 × 30 voxels",
                "segments: 41",
                "  5 liver (",
                "  117 ",
            ][..],
        ),
        (
            "ct/abdomen_ct_vertebrae_labels.nii.gz",
            &["segments: 8", "  26 vertebrae_S1 ("],
        ),
        (
            "ct/head_phantom_ct_shear.nii.gz",
            &[
                "orientation: RAS, sheared",
                "spacing: 0.4824 × 0.4824 × 2.3708 mm",
            ],
        ),
        (
            "mri/avg152T1_LR_nifti.nii.gz",
            &[
                "orientation: LAS, left-handed storage",
                "values: 0 to 255",
                "sha256: ",
            ],
        ),
    ] {
        let mut files = Folder::new(&folder);
        let description = load::describe(&mut files, file, &ReadOptions::default()).expect(file);
        let text = description.to_string();
        println!("{text}");
        for line in lines {
            assert!(
                text.lines().any(|found| found.starts_with(line)),
                "{file}: no \"{line}\" in\n{text}"
            );
        }
        assert!(!text.contains("FSL"), "the description field is not shown");
    }
}
