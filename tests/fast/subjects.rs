//! The built-in subjects: the same bits everywhere, segments where anatomy has them, values as in a scan.

use std::collections::VecDeque;
use std::future::Future as _;
use std::task::{Context, Poll, Waker};

use fabrica::data::{
    CoarseLabels, Segment, SubjectPart, SubjectSink, TimeSlices, Volume, VolumeBuilder, Voxels,
};
use fabrica::document::newest_revision;
use fabrica::subjects::{self, Generator, SubjectError};
use sha2::{Digest as _, Sha256};

/// A subject held whole.
struct Held {
    dims: [usize; 3],
    spacing_mm: f64,
    values: Vec<i16>,
    labels: Vec<u8>,
    names: Vec<String>,
}

struct Collect {
    header: Option<Volume>,
    values: Vec<i16>,
    labels: Vec<u8>,
    last_progress: f32,
    stop_at: f32,
}

impl Collect {
    fn new() -> Self {
        Self {
            header: None,
            values: Vec::new(),
            labels: Vec::new(),
            last_progress: 0.0,
            stop_at: 2.0,
        }
    }
}

impl SubjectSink for Collect {
    fn take(&mut self, part: SubjectPart) -> Result<(), String> {
        match part {
            SubjectPart::Volume(header) => {
                assert!(header.voxels.is_empty(), "the header holds no voxels");
                self.header = Some(*header);
            }
            SubjectPart::Scalars(Voxels::I16(next)) => self.values.extend(next),
            SubjectPart::Labels(next) => self.labels.extend(next),
            other => panic!("announced 16-bit scalars and labels, got {other:?}"),
        }
        Ok(())
    }

    fn progress(&mut self, fraction: f32) -> bool {
        assert!(fraction >= self.last_progress, "progress goes on");
        self.last_progress = fraction;
        fraction < self.stop_at
    }
}

fn make(name: &str, resolution: u32) -> Held {
    let mut sink = Collect::new();
    subjects::generate(name, resolution, &mut sink).expect("a subject is made");
    assert_eq!(sink.last_progress, 1.0, "{name}: progress ends at 1");
    held(name, sink)
}

/// The newest revision of a subject.
fn make_newest(name: &str, resolution: u32) -> Held {
    let revision = newest_revision(name);
    let generator = Generator::of_revision(name, revision, resolution).expect("a subject");
    let slab = generator.slab(0..generator.slice_count());
    let mut sink = Collect::new();
    sink.header = Some(generator.header());
    (sink.values, sink.labels) = (slab.values, slab.labels);
    held(name, sink)
}

fn held(name: &str, sink: Collect) -> Held {
    let header = sink.header.expect("a header came first");
    let dims = header.grid.dims;
    assert_eq!(sink.values.len(), header.grid.voxel_count(), "{name}");
    assert_eq!(sink.labels.len(), header.grid.voxel_count(), "{name}");
    let names = header
        .segmentation
        .as_ref()
        .expect("subjects have labels")
        .segments
        .iter();
    Held {
        dims: [dims.x as usize, dims.y as usize, dims.z as usize],
        spacing_mm: header.grid.spacing_mm().x,
        values: sink.values,
        labels: sink.labels,
        names: names.map(|s| s.name.clone()).collect(),
    }
}

impl Held {
    fn label(&self, name: &str) -> u8 {
        let index = self.names.iter().position(|n| n == name);
        index.unwrap_or_else(|| panic!("no segment {name}")) as u8 + 1
    }

    fn millilitres(&self, names: &[&str]) -> f64 {
        let wanted: Vec<u8> = names.iter().map(|n| self.label(n)).collect();
        let count = self.labels.iter().filter(|l| wanted.contains(l)).count();
        count as f64 * self.spacing_mm.powi(3) / 1000.0
    }

    /// Median value of a segment: its border, which holds some of its neighbours, does not count.
    fn median(&self, name: &str) -> i16 {
        let label = self.label(name);
        let mut values: Vec<i16> = (0..self.labels.len())
            .filter(|&i| self.labels[i] == label)
            .map(|i| self.values[i])
            .collect();
        assert!(!values.is_empty(), "{name} is empty");
        values.sort_unstable();
        values[values.len() / 2]
    }

    fn index(&self, p: [usize; 3]) -> usize {
        p[0] + self.dims[0] * (p[1] + self.dims[1] * p[2])
    }

    fn place(&self, index: usize) -> [usize; 3] {
        let [nx, ny, _] = self.dims;
        [index % nx, index / nx % ny, index / (nx * ny)]
    }

    /// How many voxels hang together by their faces, of each piece of a segment; the largest first.
    fn pieces(&self, name: &str) -> Vec<usize> {
        let label = self.label(name);
        let mut is_seen = vec![false; self.labels.len()];
        let mut sizes = Vec::new();
        for first in 0..self.labels.len() {
            if self.labels[first] != label || std::mem::replace(&mut is_seen[first], true) {
                continue;
            }
            let (mut todo, mut size) = (vec![first], 0);
            while let Some(index) = todo.pop() {
                size += 1;
                for next in self.neighbours(index) {
                    if self.labels[next] == label && !std::mem::replace(&mut is_seen[next], true) {
                        todo.push(next);
                    }
                }
            }
            sizes.push(size);
        }
        sizes.sort_unstable_by(|a, b| b.cmp(a));
        sizes
    }

    /// The six neighbours inside the grid.
    fn neighbours(&self, index: usize) -> Vec<usize> {
        let p = self.place(index);
        let mut out = Vec::new();
        for axis in 0..3 {
            for step in [-1i64, 1] {
                let moved = p[axis] as i64 + step;
                if (0..self.dims[axis] as i64).contains(&moved) {
                    let mut q = p;
                    q[axis] = moved as usize;
                    out.push(self.index(q));
                }
            }
        }
        out
    }
}

/// SHA-256 of labels and values at a low resolution. A subject that is improved gets new numbers here and, once
/// released, a revision in the document.
const GOLDEN: &[(&str, &str)] = &[
    (
        "bar",
        "36320dd917f89e65e32eceaeac6de4c35d27edd14b049973b08e068f6e3f08ce",
    ),
    (
        "cube",
        "8d2058c926ed87b722d8b146a1b9f8768281291616b56f90338fc09c55eb0142",
    ),
    (
        "head",
        "3fe1c6c449313b2910e917dccefc4414edfe2bc9daa819a39fd1f2fe8d805f1b",
    ),
    (
        "tomato",
        "a967997601e223cea3a09518505c71c08848bef69bec2c8d12d6d52a1767f032",
    ),
    (
        "piggybank",
        "ba48feae55f51e587568d2026e6a91772ce6ab4fcc10bd697a333ce446aa3320",
    ),
    (
        "hand",
        "d48b6b05c35fc40af6a043fa03f63dc53f98fd3691d284da2834446e9f57635c",
    ),
    (
        "knee",
        "adcb66547ee211d9a82bd82a0b1c72558e90b913168498c614f3ad9144ed5295",
    ),
    (
        "torso",
        "71fc7f94040a82b45083b7bd4bb3e3abcba14a3688417cbaf1f7737f270d54fe",
    ),
];

fn digest(held: &Held) -> String {
    let mut hash = Sha256::new();
    hash.update(&held.labels);
    for value in &held.values {
        hash.update(value.to_le_bytes());
    }
    hash.finalize().iter().map(|b| format!("{b:02x}")).collect()
}

#[test]
fn the_bits_are_the_same_on_every_machine() {
    let mut wrong = Vec::new();
    for name in subjects::names() {
        let found = digest(&make(name, 48));
        let expected = GOLDEN.iter().find(|(n, _)| n == name).map(|(_, d)| *d);
        if expected != Some(&found) {
            wrong.push(format!("    (\"{name}\", \"{found}\"),"));
        }
    }
    assert!(wrong.is_empty(), "now:\n{}", wrong.join("\n"));
}

/// As [`GOLDEN`], of the second revisions.
const SECOND: &[(&str, &str)] = &[
    (
        "hand",
        "2621bf76500d1ebde3ec35a49663c4023414e54cde769ae10771edba5e030044",
    ),
    (
        "head",
        "3039dfac4c8552aaed74a7469d0c147918b103120b76635203024c70468e9694",
    ),
    (
        "knee",
        "7cb9421a31ecd1d532d7f78a59f8b33de37a7533cb0a03d75b567fbe36b3ab70",
    ),
    (
        "torso",
        "4102b1d45f966b71f2115183a5ba16e6d8e22c3386f60959ca94b249681a1157",
    ),
];

#[test]
fn the_bits_of_second_revisions_are_the_same_on_every_machine() {
    let improved = || {
        subjects::names()
            .iter()
            .filter(|name| newest_revision(name) > 1)
    };
    let mut wrong = Vec::new();
    for name in improved() {
        let found = digest(&make_newest(name, 48));
        if !SECOND.contains(&(name, &found)) {
            wrong.push(format!("    (\"{name}\", \"{found}\"),"));
        }
    }
    assert!(wrong.is_empty(), "now:\n{}", wrong.join("\n"));
    assert_eq!(improved().count(), SECOND.len(), "each is listed");
}

#[test]
fn each_revision_that_documents_know_is_made() {
    for name in subjects::names() {
        let made = |revision| {
            let generator = Generator::of_revision(name, revision, 32).expect("a subject");
            generator.slab(0..generator.slice_count())
        };
        let newest = newest_revision(name);
        for revision in 2..=newest {
            assert!(made(revision) != made(revision - 1), "{name}: {revision}");
        }
        assert!(made(newest) == made(newest + 1), "{name}: none is newer");
    }
    // One that is not there yet is the newest that is.
    let made = |revision| Generator::of_revision("hand", revision, 16).expect("a hand");
    let all = |of: &Generator| of.slab(0..of.slice_count());
    assert!(all(&made(2)) == all(&made(u32::MAX)), "a revision to come");
    assert!(all(&made(0)) == all(&made(1)) && all(&made(1)) != all(&made(2)));
}

/// At the resolution that is shown, by the faces of voxels. Left out are crumbs of one voxel, which another tissue cut
/// off a wall.
#[test]
fn vessels_nerves_and_airways_are_whole() {
    let mut wrong = Vec::new();
    // And how many of these segments are broken in the first revision.
    for (subject, segments, broken_first) in [
        // The spinal cord with its roots; a ureter on each side.
        (
            "torso",
            &[
                ("arteries", 1),
                ("veins", 1),
                ("bronchi", 1),
                ("nerves", 1),
                ("ureters", 2),
            ][..],
            5,
        ),
        // Two arteries enter the hand, and two nerves; the tendons of the thumb's back run apart from the others.
        (
            "hand",
            &[("arteries", 2), ("veins", 1), ("nerves", 2), ("tendons", 3)],
            4,
        ),
        // Of the veins the outer jugulars run apart; the nerves of the eyes cross.
        ("head", &[("arteries", 1), ("veins", 3), ("nerves", 7)], 3),
        // The long vein under the skin runs apart.
        ("knee", &[("arteries", 1), ("veins", 2), ("nerves", 1)], 2),
    ] {
        let held = make_newest(subject, subjects::FINE_RESOLUTION);
        let first = make(subject, subjects::FINE_RESOLUTION);
        let mut broken = 0;
        for (segment, number) in segments {
            let whole = |held: &Held| {
                let pieces = held.pieces(segment).into_iter();
                pieces.filter(|size| *size > 1).collect::<Vec<_>>()
            };
            if whole(&held).len() != *number {
                wrong.push(format!("{subject}, {segment}: {:?}", whole(&held)));
            }
            broken += usize::from(whole(&first).len() > *number);
        }
        assert_eq!(broken, broken_first, "{subject}, first revision");
    }
    assert!(wrong.is_empty(), "{}", wrong.join("; "));
}

#[test]
fn slabs_do_not_depend_on_how_they_are_asked_for() {
    for name in subjects::names() {
        let whole = make(name, 40);
        let generator = Generator::new(name, 40).unwrap();
        let (mut values, mut labels) = (Vec::new(), Vec::new());
        let mut z = 0;
        for height in [1, 7, 3, 8, 13].into_iter().cycle() {
            let slab = generator.slab(z..z + height);
            values.extend(slab.values);
            labels.extend(slab.labels);
            z += height;
            if z >= generator.slice_count() {
                break;
            }
        }
        assert!(values == whole.values, "{name}: values");
        assert!(labels == whole.labels, "{name}: labels");
        let beyond = generator.slab(1_000_000..u32::MAX);
        assert!(beyond.values.is_empty(), "{name}: beyond the end");
    }
}

#[test]
fn values_stay_in_the_announced_range_and_labels_have_names() {
    for name in subjects::names() {
        let held = make(name, 48);
        let [low, high] = Generator::new(name, 48).unwrap().header().value_range;
        for (&value, &label) in held.values.iter().zip(&held.labels) {
            assert!((low..=high).contains(&f32::from(value)), "{name}: {value}");
            assert!(usize::from(label) <= held.names.len(), "{name}: {label}");
        }
        let mut names = held.names.clone();
        names.sort();
        names.dedup();
        assert_eq!(names.len(), held.names.len(), "{name}: a name twice");
    }
}

#[test]
fn bar_and_cube_have_their_segments() {
    let bar = make("bar", 64);
    assert_eq!(bar.names, ["shell", "core"], "as the contract says");
    assert!(bar.dims[1] > 2 * bar.dims[0], "the bar runs along y");
    // The core lies inside the shell: no core voxel touches the outside.
    let core = bar.label("core");
    for i in (0..bar.labels.len()).filter(|&i| bar.labels[i] == core) {
        assert!(
            bar.neighbours(i).iter().all(|&n| bar.labels[n] != 0),
            "core"
        );
    }
    let cube = make("cube", 64);
    for name in ["top", "middle", "bottom", "ball"] {
        assert!(cube.millilitres(&[name]) > 40.0, "{name}");
    }
}

#[test]
fn the_torso_has_plausible_volumes_and_values() {
    let torso = make("torso", 128);
    let mut wrong = Vec::new();
    for (names, low, high) in [
        (&["skin"][..], 600.0, 3600.0),
        (&["muscle"], 5000.0, 16000.0),
        (&["ribs"], 250.0, 800.0),
        (&["spine"], 400.0, 1200.0),
        (&["sternum"], 30.0, 160.0),
        (&["lungs"], 2500.0, 6000.0),
        (&["heart"], 200.0, 700.0),
        (&["liver"], 900.0, 2000.0),
        (&["spleen"], 100.0, 350.0),
        (&["kidneys"], 150.0, 450.0),
        (&["pancreas"], 35.0, 150.0),
        (&["gallbladder"], 10.0, 60.0),
        (&["stomach"], 80.0, 500.0),
        (&["bowel", "colon", "contents"], 800.0, 2500.0),
    ] {
        let found = torso.millilitres(names);
        if !(low..high).contains(&found) {
            wrong.push(format!("{names:?}: {found:.0} ml"));
        }
    }
    for (name, low, high) in [
        ("fat", -110, -60),
        ("muscle", 35, 60),
        ("lungs", -650, -560),
        ("liver", 50, 70),
        ("spleen", 40, 60),
        ("air", -1000, -800),
        ("arteries", 150, 240),
        ("ribs", 150, 1100),
    ] {
        let found = torso.median(name);
        if !(low..=high).contains(&found) {
            wrong.push(format!("{name}: {found}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("; "));
    // Liver and gallbladder on the right (x grows to it), heart, stomach and spleen on the left.
    let middle = torso.dims[0] as f64 / 2.0 - 0.5;
    let side = |name: &str| {
        let label = torso.label(name);
        let places = (0..torso.labels.len()).filter(|&i| torso.labels[i] == label);
        let (sum, count) = places.fold((0.0, 0.0), |(sum, count), i| {
            (sum + torso.place(i)[0] as f64 - middle, count + 1.0)
        });
        sum / count
    };
    for (name, right) in [
        ("liver", true),
        ("gallbladder", true),
        ("heart", false),
        ("stomach", false),
        ("spleen", false),
    ] {
        assert_eq!(side(name) > 0.0, right, "{name} at {:.1}", side(name));
    }
}

#[test]
fn the_head_has_plausible_volumes() {
    let head = make("head", 128);
    for (names, low, high) in [
        (&["skin"][..], 250.0, 600.0),
        (&["fat"], 500.0, 1500.0),
        (&["muscle", "tongue"], 350.0, 1300.0),
        (&["bone"], 450.0, 1000.0),
        (&["brain", "white matter", "cerebellum"], 850.0, 1500.0),
        (&["cerebellum"], 40.0, 170.0),
        (&["brain stem"], 25.0, 70.0),
        (&["ventricles"], 8.0, 45.0),
        (&["eyes", "iris", "pupil", "lens"], 11.0, 18.0),
        (&["teeth"], 8.0, 40.0),
        (&["tongue"], 35.0, 90.0),
        (&["airway"], 40.0, 150.0),
        (&["arteries"], 5.0, 50.0),
        (&["veins"], 10.0, 80.0),
        (&["lips"], 1.0, 12.0),
    ] {
        let found = head.millilitres(names);
        assert!((low..high).contains(&found), "{names:?}: {found:.0} ml");
    }
}

/// A peel that keeps the bone would drag the brain through the skull: what the skull encloses is known, and nothing
/// else.
#[test]
fn the_skull_of_the_head_encloses_the_brain() {
    let mut builder = VolumeBuilder::new();
    subjects::generate("head", 96, &mut builder).expect("the head is made");
    let volume = builder.finish().expect("it is whole");
    let labels = volume.segmentation.expect("it has segments");
    let coarse = CoarseLabels::of(&labels);
    let inside = |keep: &[&str]| {
        let is_kept = |segment: &Segment| keep.contains(&segment.name.as_str());
        let unlimited = TimeSlices::unlimited();
        let work = std::pin::pin!(coarse.inside(&labels.segments, is_kept, &unlimited));
        match work.poll(&mut Context::from_waker(Waker::noop())) {
            Poll::Ready(names) => names,
            Poll::Pending => panic!("without time slices nothing waits"),
        }
    };
    let found = inside(&["bone"]);
    for name in ["brain", "white matter", "cerebellum", "ventricles"] {
        assert!(
            found.iter().any(|n| n == name),
            "{name} is inside: {found:?}"
        );
    }
    for name in ["skin", "fat", "muscle", "lips", "bone"] {
        assert!(found.iter().all(|n| n != name), "{name} is not: {found:?}");
    }
    assert!(inside(&["ventricles"]).is_empty(), "nothing is in them");
}

#[test]
fn the_head_has_values_as_in_a_scan() {
    let head = make("head", 224);
    for (name, low, high) in [
        ("skin", -150, 60),
        ("fat", -110, -60),
        ("muscle", 35, 60),
        ("bone", 380, 1500),
        ("brain", 25, 45),
        ("white matter", 24, 36),
        ("ventricles", 0, 20),
        ("teeth", 1400, 2400),
        ("airway", -1000, -900),
        ("arteries", 80, 240),
        ("veins", 80, 240),
        ("tongue", 40, 65),
    ] {
        let found = head.median(name);
        assert!((low..=high).contains(&found), "{name}: {found}");
    }
    assert!(
        head.median("brain") > head.median("white matter"),
        "grey is denser"
    );
    assert!(head.values.iter().any(|&v| v > 1100), "compact bone");
}

#[test]
fn skin_encloses_the_head() {
    let head = make("head", 128);
    // The lining of the nose shows in the nostrils, and only there.
    let lining = head.label("mucosa");
    let outer: Vec<u8> = [
        "skin", "lips", "hair", "eyes", "iris", "pupil", "airway", "mucosa",
    ]
    .iter()
    .map(|n| head.label(n))
    .collect();
    // Flood the outside from a corner.
    let mut outside = vec![false; head.labels.len()];
    let mut queue = VecDeque::from([0usize]);
    outside[0] = true;
    // The neck ends in an open section.
    let section = 6;
    let (mut touched, mut lining_touched) = (0, 0);
    while let Some(i) = queue.pop_front() {
        for n in head.neighbours(i) {
            if head.labels[n] == 0 {
                if !outside[n] {
                    outside[n] = true;
                    queue.push_back(n);
                }
            } else if head.place(n)[2] > section {
                touched += 1;
                lining_touched += usize::from(head.labels[n] == lining);
                assert!(
                    outer.contains(&head.labels[n]),
                    "{} is bare at {:?}",
                    head.names[usize::from(head.labels[n]) - 1],
                    head.place(n)
                );
            }
        }
    }
    assert!(touched > 5_000, "the outside was walked: {touched}");
    assert!(lining_touched < 60, "lining shows: {lining_touched}");
    let inside = (0..outside.len()).filter(|&i| head.labels[i] == 0 && !outside[i]);
    assert_eq!(inside.count(), 0, "nothing inside is without a segment");
}

#[test]
fn bone_covers_the_brain() {
    let head = make("head", 128);
    let bone = head.label("bone");
    let brain = [head.label("brain"), head.label("white matter")];
    // From the middle of the brain, every way that leads up or level meets bone before skin.
    let (mut sum, mut count) = ([0.0f64; 3], 0.0f64);
    for i in (0..head.labels.len()).filter(|&i| brain.contains(&head.labels[i])) {
        let p = head.place(i);
        for axis in 0..3 {
            sum[axis] += p[axis] as f64;
        }
        count += 1.0;
    }
    let center = sum.map(|s| s / count);
    let n = 4000;
    for k in 0..n {
        // Evenly over the upper half of the sphere, and a little below level.
        let z = 1.0 - 1.1 * (f64::from(k) + 0.5) / f64::from(n);
        let turn = f64::from(k) * 2.399_963;
        let r = (1.0 - z * z).sqrt();
        let way = [r * turn.cos(), r * turn.sin(), z];
        let mut bones = 0;
        for step in 0..400 {
            let t = f64::from(step) * 0.5;
            let p = [0, 1, 2].map(|a| (center[a] + way[a] * t).round());
            if (0..3).any(|a| p[a] < 0.0 || p[a] >= head.dims[a] as f64) {
                break;
            }
            let at = head.index(p.map(|c| c as usize));
            bones += usize::from(head.labels[at] == bone);
        }
        assert!(bones >= 3, "no bone along {way:?}");
    }
}

#[test]
fn the_brain_has_two_hemispheres_of_about_the_same_size() {
    let head = make("head", 128);
    let brain = [head.label("brain"), head.label("white matter")];
    let middle = head.dims[0] as f64 / 2.0 - 0.5;
    let (mut right, mut left) = (0.0f64, 0.0f64);
    // High up, where nothing joins them, the fissure is free of brain.
    let (mut in_gap, mut beside) = (0, 0);
    for i in (0..head.labels.len()).filter(|&i| brain.contains(&head.labels[i])) {
        let p = head.place(i);
        let x = p[0] as f64 - middle;
        if x > 0.0 {
            right += 1.0
        } else {
            left += 1.0
        }
        if p[2] as f64 > 0.84 * head.dims[2] as f64 {
            in_gap += usize::from(x.abs() < 0.6);
            beside += usize::from((4.0..5.2).contains(&x.abs()));
        }
    }
    assert!((right / left - 1.0).abs() < 0.05, "{right} and {left}");
    assert!(
        in_gap * 20 < beside,
        "{in_gap} in the gap, {beside} beside it"
    );
    // Alike, yet no mirror images.
    let differ = (0..head.labels.len()).filter(|&i| {
        let mut p = head.place(i);
        p[0] = head.dims[0] - 1 - p[0];
        brain.contains(&head.labels[i]) && head.labels[i] != head.labels[head.index(p)]
    });
    assert!(differ.count() > 1_000, "folds differ from side to side");
}

#[test]
fn the_coarse_head_is_the_same_head() {
    let (coarse, fine) = (make("head", 64), make("head", 128));
    for name in ["skin", "bone", "brain", "muscle", "airway", "fat"] {
        let (a, b) = (coarse.millilitres(&[name]), fine.millilitres(&[name]));
        // The coarse skin is one voxel thick, which is more than the skin has.
        let most = if name == "skin" { 3.5 } else { 1.8 };
        assert!(a / b < most && b / a < most, "{name}: {a:.0} and {b:.0} ml");
    }
}

#[test]
fn hostile_requests_are_refused() {
    for name in ["", "Head", "head ", "../head", "\u{0}", "💀"] {
        assert_eq!(
            Generator::new(name, 64).err(),
            Some(SubjectError::UnknownName(name.to_owned())),
            "{name:?}"
        );
    }
    let long = "x".repeat(1 << 20);
    let message = Generator::new(&long, 64).err().unwrap().to_string();
    assert!(message.len() < 300, "a long name is not repeated");
    assert!(message.contains("head"), "the message says what there is");
    for resolution in [0, 1, 15, 513, 100_000, u32::MAX] {
        assert_eq!(
            Generator::new("head", resolution).err(),
            Some(SubjectError::Resolution(resolution)),
            "{resolution}"
        );
    }
}

#[test]
fn a_sink_may_refuse_or_stop() {
    struct Refuse;
    impl SubjectSink for Refuse {
        fn take(&mut self, part: SubjectPart) -> Result<(), String> {
            match part {
                SubjectPart::Volume(_) => Err("too large".to_owned()),
                _ => panic!("nothing follows a refusal"),
            }
        }
        fn progress(&mut self, _: f32) -> bool {
            panic!("nothing follows a refusal");
        }
    }
    assert_eq!(
        subjects::generate("cube", 32, &mut Refuse),
        Err(SubjectError::Refused("too large".to_owned())),
        "refused"
    );
    let mut sink = Collect::new();
    sink.stop_at = 0.4;
    assert_eq!(
        subjects::generate("cube", 64, &mut sink),
        Err(SubjectError::Stopped),
        "stopped"
    );
    assert!(sink.last_progress < 0.6, "soon after it was asked to");
}
