//! `probe` and `export-field` tell the map with its constraints: in numbers, and as a picture of the file that comes
//! back.

use crate::cli::{Outcome, fabrica_with};
use crate::long::is_long;
use crate::scatter::Random;
use crate::segment_files::nifti;
use fabrica::render::{Image, decode_png};
use glam::{DVec3, Vec3};
use std::path::Path;

/// Voxels of the bar of these tests, few, so that each call of the program is short.
const DIMS: [i16; 3] = [28, 72, 28];

/// A bar along y: 1 is its shell, 2 its core.
fn tissue(x: i16, y: i16, z: i16) -> i16 {
    // Twice the way from the middle.
    let away = |at: i16, axis: usize| (2 * at + 1 - DIMS[axis]).abs();
    let (across, along) = (away(x, 0).max(away(z, 2)), away(y, 1));
    match (across, along) {
        (..=8, ..=60) => 2,
        (..=22, ..=66) => 1,
        _ => 0,
    }
}

/// A document about the bar with these templates, its core seen through its shell.
fn document(templates: &str) -> String {
    format!(
        r#"{{"fabrica":1,"subject":{{"src":"bar.nii","segments":{{"src":"parts.nii","names":{{"1":"shell","2":"core"}}}}}},
            "camera":{{"rotate":[0.2,0.1,0.3,0.927],"distance":1.9}},
            "look":{{"background":"none","segments":{{"shell":0.25,"core":1}}}},"templates":[{templates}]}}"#
    )
}

/// What the program prints, and its notices.
fn run(folder: &Path, args: &[&str], input: &str) -> (String, String) {
    let Outcome { out, err, .. } = fabrica_with(folder, args, input.as_bytes()).ok();
    (out, err)
}

/// Source and continuity of each line.
fn sources(text: &str) -> Vec<(DVec3, f64)> {
    let lines = text.lines().map(|line| {
        let numbers = line.split(',').skip(3).take(4);
        let numbers: Vec<f64> = numbers.map(|x| x.parse().expect("a number")).collect();
        (DVec3::new(numbers[0], numbers[1], numbers[2]), numbers[3])
    });
    lines.collect()
}

/// How much two pictures differ where either shows something: per pixel the largest difference of a channel,
/// multiplied by its alpha, of 255.
#[derive(Debug)]
struct Apart {
    mean: f64,
    /// What one pixel in a hundred exceeds.
    most: f64,
    /// Pixels that only one of them covers by more than half, as a share of those that are shown.
    outline: f64,
}

fn apart(a: &Image, b: &Image) -> Apart {
    assert_eq!(a.size, b.size);
    let pairs = a.rgba.chunks_exact(4).zip(b.rgba.chunks_exact(4));
    let shown: Vec<_> = pairs.filter(|(a, b)| a[3] > 0 || b[3] > 0).collect();
    assert!(shown.len() > 1000, "{} pixels show something", shown.len());
    let channel = |p: &[u8], i: usize| {
        let alpha = f64::from(p[3]);
        if i == 3 {
            alpha
        } else {
            f64::from(p[i]) * alpha / 255.0
        }
    };
    let each = shown.iter().map(|(a, b)| {
        let channels = (0..4).map(|i| (channel(a, i) - channel(b, i)).abs());
        channels.fold(0.0, f64::max)
    });
    let mut each: Vec<f64> = each.collect();
    each.sort_by(f64::total_cmp);
    let outline = shown.iter().filter(|(a, b)| (a[3] > 127) != (b[3] > 127));
    let count = shown.len() as f64;
    Apart {
        mean: each.iter().sum::<f64>() / count,
        most: each[each.len() * 99 / 100],
        outline: outline.count() as f64 / count,
    }
}

const TWIST: &str =
    r#""kind":"twist","rotate":[0.7071,0,0,0.7071],"size":[0.6,0.6,1],"params":{"angle":0.8}"#;
/// Of a bend nothing is rigid, while a twist turns its axis as a body.
const BEND: &str = r#""kind":"bend","size":[2,1.1,2],"params":{"angle":0.6}"#;
/// Brings the whole bar along x.
const SHIFT: &str = r#"{"kind":"move","size":[2,2,2],"params":{"offset":[0.06,0,0]}},"#;

/// In tissue the map is what the object shows, with its constraints; and the file is that map, drawn too.
#[test]
fn the_map_is_told_with_its_constraints() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    let write = |name: &str, bytes: &[u8]| {
        std::fs::write(folder.join(name), bytes).expect("written");
    };
    write("bar.nii", &nifti(DIMS, |x, y, z| 100 * tissue(x, y, z)));
    write("parts.nii", &nifti(DIMS, tissue));
    let mut random = Random(0x0b01_71ca);
    let points: String = (0..2000)
        .map(|_| random.vector(-0.2, 0.2) * Vec3::new(1.0, 2.2, 1.0))
        .map(|p| format!("{},{},{}\n", p.x, p.y, p.z))
        .collect();
    let probe = |name: &str, more: &[&str]| {
        sources(&run(folder, &[&["probe", name], more].concat(), &points).0)
    };
    let picture = |name: &str| {
        let args = [
            "render",
            name,
            "-o",
            "picture.png",
            "--size",
            "96x96",
            "--samples",
            "1",
        ];
        run(folder, &args, "");
        let bytes = std::fs::read(folder.join("picture.png")).expect("a picture");
        decode_png(&bytes).expect("a PNG")
    };
    let align = r#","align":{"to":"segment","keep":["core"]}"#;
    // The list of two first: it stands for the others where time is short.
    let all = [
        ("displacement", SHIFT, TWIST),
        ("displacement", "", TWIST),
        ("coordinate", "", TWIST),
        ("rigid", "", BEND),
    ];
    let is_long = is_long();
    for (by, before, template) in all.into_iter().take(if is_long { 4 } else { 1 }) {
        let name = format!("by {by}, {} before it", before.len().min(1));
        let constrain = format!(r#","constrain":{{"by":"{by}","keep":["core"]}}"#);
        let with = |more: &str| document(&format!("{before}{{{template}{more}}}"));
        write("free.json", with("").as_bytes());
        write("kept.json", with(&constrain).as_bytes());
        write("both.json", with(&(constrain.clone() + align)).as_bytes());
        let [free, kept] = ["free.json", "kept.json"].map(|name| probe(name, &[]));
        let object = probe("kept.json", &["--object"]);
        assert_eq!(kept, object, "{name}: the map is what the object shows");
        let both = probe("both.json", &[]);
        assert_eq!(kept, both, "{name}: alignment is no map");
        let pairs = free.iter().zip(&kept);
        let changed = pairs.filter(|(a, b)| a.0.distance(b.0) > 1e-3).count();
        assert!(
            changed > 100,
            "{name}: the constraint changes {changed} of them"
        );

        // And the file is that map, to its samples.
        let args = [
            "export-field",
            "both.json",
            "-o",
            "map.nrrd",
            "--size",
            "96",
        ];
        let (_, err) = run(folder, &args, "");
        let last = usize::from(!before.is_empty());
        assert!(
            err.contains(&format!("/templates/{last}/align")),
            "{name}: the alignment is named: {err}"
        );
        let back = document(r#"{"kind":"field","params":{"src":"map.nrrd"}}"#);
        write("back.json", back.as_bytes());
        let back = probe("back.json", &[]);
        let off = |of: &[(DVec3, f64)]| {
            // In tissue: beyond the deformed object the file has no samples.
            let half = DVec3::new(0.16, 0.46, 0.16);
            let there = kept.iter().map(|kept| kept.0.abs().cmplt(half).all());
            let pairs = back
                .iter()
                .zip(of)
                .zip(there)
                .filter(|(_, is_there)| *is_there);
            let mut ways: Vec<f64> = pairs.map(|((a, b), _)| a.0.distance(b.0)).collect();
            assert!(ways.len() > 500, "{} of them are in tissue", ways.len());
            ways.sort_by(f64::total_cmp);
            (
                ways.iter().sum::<f64>() / ways.len() as f64,
                ways[ways.len() - 1],
            )
        };
        let (right, wrong) = (off(&kept), off(&free));
        println!(
            "{name}: the file is off by {:.1e}, at most {:.1e}; from the map without constraints by {:.1e}, {:.1e}",
            right.0, right.1, wrong.0, wrong.1
        );
        // A hundredth of a side per sample: no place is off by more than one.
        assert!(right.0 < 1e-3 && right.1 < 0.01, "{name}: {right:?}");
        assert!(wrong.0 > 8.0 * right.0, "{name}: {wrong:?}");

        let seen = picture("kept.json");
        let (same, other) = (
            apart(&seen, &picture("back.json")),
            apart(&seen, &picture("free.json")),
        );
        println!("{name}: its picture is {same:.4?}, without constraints {other:.4?}");
        assert!(same.mean < 3.0 && same.outline < 0.005, "{name}: {same:?}");
        assert!(
            other.mean > 4.0 * same.mean
                && other.most > 4.0 * same.most
                && other.outline > 2.0 * same.outline,
            "{name}: {same:?}, without constraints {other:?}"
        );
    }
}
