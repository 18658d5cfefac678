//! Kept made here: growing, parts, distances and smoothing against plain readings of what they say; how segments are
//! joined.

use fabrica::data::{
    Grid, KnownMasks, Mask, Resources, Segment, Segmentation, Segmented, SubjectPart, SubjectSink,
    TimeSlices, Volume, VolumeBuilder, Voxels, segment, segment_with,
};
use fabrica::document::{Document, Recipe};
use glam::{DAffine3, DMat3, DVec3, IVec3, UVec3, Vec3};
use std::sync::Arc;

/// A small generator of our own: the same numbers everywhere (xorshift).
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    fn below(&mut self, n: u32) -> u32 {
        (self.next() >> 33) as u32 % n
    }

    fn unit(&mut self) -> f32 {
        (self.next() >> 40) as f32 / (1u64 << 24) as f32
    }

    /// Blobs and specks, so that there are parts of many sizes, holes and bridges.
    fn mask(&mut self, dims: UVec3) -> Mask {
        let blobs: Vec<(Vec3, f32, bool)> = (0..9)
            .map(|_| {
                let at = Vec3::new(self.unit(), self.unit(), self.unit()) * dims.as_vec3();
                let radius = 1.0 + self.unit() * 0.3 * dims.min_element() as f32;
                (at, radius, self.below(3) > 0)
            })
            .collect();
        let bits = voxels(dims).map(|v| {
            let mut is_in = false;
            for (at, radius, is_added) in &blobs {
                if (v.as_vec3() - *at).length() < *radius {
                    is_in = *is_added;
                }
            }
            u8::from(is_in ^ (self.below(23) == 0))
        });
        Mask {
            dims,
            bits: bits.collect(),
        }
    }

    fn dims(&mut self) -> UVec3 {
        UVec3::new(1 + self.below(13), 1 + self.below(11), 1 + self.below(9))
    }
}

fn voxels(dims: UVec3) -> impl Iterator<Item = UVec3> {
    (0..dims.element_product())
        .map(move |i| UVec3::new(i % dims.x, i / dims.x % dims.y, i / (dims.x * dims.y)))
}

fn index(dims: UVec3, v: UVec3) -> usize {
    (v.x + dims.x * (v.y + dims.y * v.z)) as usize
}

fn neighbours(dims: UVec3, v: UVec3) -> impl Iterator<Item = UVec3> {
    let steps = [
        IVec3::X,
        IVec3::Y,
        IVec3::Z,
        -IVec3::X,
        -IVec3::Y,
        -IVec3::Z,
    ];
    steps.into_iter().filter_map(move |step| {
        let at = v.as_ivec3() + step;
        let is_in = at.cmpge(IVec3::ZERO).all() && at.cmplt(dims.as_ivec3()).all();
        is_in.then(|| at.as_uvec3())
    })
}

/// The plain flood fill.
fn flood(mask: &Mask, wanted: u8, seeds: impl IntoIterator<Item = UVec3>) -> Vec<bool> {
    let mut seen = vec![false; mask.bits.len()];
    let mut open: Vec<UVec3> = seeds.into_iter().collect();
    while let Some(v) = open.pop() {
        let i = index(mask.dims, v);
        if mask.bits[i] == wanted && !std::mem::replace(&mut seen[i], true) {
            open.extend(neighbours(mask.dims, v));
        }
    }
    seen
}

fn bits(seen: &[bool]) -> Vec<u8> {
    seen.iter().map(|&is_in| u8::from(is_in)).collect()
}

fn done<T>(work: impl Future<Output = T>) -> T {
    pollster::block_on(work)
}

#[test]
fn growing_is_a_flood_fill() {
    let mut random = Random(7);
    for _ in 0..300 {
        let dims = random.dims();
        let mask = random.mask(dims);
        let seeds: Vec<UVec3> = (0..random.below(4))
            .map(|_| {
                UVec3::new(
                    random.below(dims.x),
                    random.below(dims.y),
                    random.below(dims.z),
                )
            })
            .collect();
        let mut grown = mask.clone();
        done(grown.keep_parts_at(&seeds, &TimeSlices::unlimited()));
        assert_eq!(grown.bits, bits(&flood(&mask, 1, seeds)), "{dims}");
    }
}

#[test]
fn the_largest_parts_are_kept_and_holes_are_filled() {
    let mut random = Random(8);
    let mut holes = 0;
    for _ in 0..300 {
        let dims = random.dims();
        let mask = random.mask(dims);
        let mut left = mask.clone();
        let mut parts: Vec<Vec<bool>> = Vec::new();
        for v in voxels(dims) {
            if left.bits[index(dims, v)] == 1 {
                let part = flood(&left, 1, [v]);
                for (bit, &gone) in left.bits.iter_mut().zip(&part) {
                    *bit &= u8::from(!gone);
                }
                parts.push(part);
            }
        }
        // Found in the order of the file; sorting keeps it for parts of one size.
        parts.sort_by_key(|part| std::cmp::Reverse(part.iter().filter(|&&b| b).count()));
        let count = 1 + random.below(3) as usize;
        let mut expected = vec![0; mask.bits.len()];
        for part in parts.iter().take(count) {
            expected
                .iter_mut()
                .zip(part)
                .for_each(|(e, &b)| *e |= u8::from(b));
        }
        let mut kept = mask.clone();
        done(kept.keep_largest(count, &TimeSlices::unlimited()));
        assert_eq!(kept.bits, expected, "{dims}, the {count} largest");

        let is_end = |v: &UVec3| v.cmpeq(UVec3::ZERO).any() || (*v + 1).cmpeq(dims).any();
        let outside = flood(&mask, 0, voxels(dims).filter(is_end));
        let expected: Vec<u8> = outside.iter().map(|&out| u8::from(!out)).collect();
        holes += usize::from(expected != mask.bits);
        let mut filled = mask.clone();
        done(filled.fill(&TimeSlices::unlimited()));
        assert_eq!(filled.bits, expected, "{dims}, filled");
    }
    assert!(holes > 30, "only {holes} had anything to fill");
}

#[test]
fn growing_and_shrinking_are_plain_distances() {
    let mut random = Random(9);
    let mut changed = 0;
    for _ in 0..200 {
        let dims = random.dims();
        let mask = random.mask(dims);
        let spacing = [0; 3].map(|_| 0.5 + 0.25 * random.below(9) as f32);
        let reach = 0.25 * random.below(20) as f32;
        for wanted in [1, 0] {
            let near = |v: UVec3| {
                voxels(dims).any(|other| {
                    let apart = (v.as_vec3() - other.as_vec3()) * Vec3::from_array(spacing);
                    mask.bits[index(dims, other)] == wanted
                        && apart.length_squared() <= reach * reach
                })
            };
            let expected: Vec<u8> = voxels(dims)
                .map(|v| {
                    if near(v) {
                        wanted
                    } else {
                        mask.bits[index(dims, v)]
                    }
                })
                .collect();
            let mut spread = mask.clone();
            done(spread.spread(wanted, spacing, reach, &TimeSlices::unlimited()));
            assert_eq!(
                spread.bits, expected,
                "{dims}, {spacing:?} mm, {reach} mm, to {wanted}"
            );
            changed += usize::from(spread != mask);
        }
    }
    assert!(changed > 200, "only {changed} changed");
}

#[test]
fn smoothing_is_a_gaussian_and_one_half() {
    let mut random = Random(10);
    let (mut compared, mut close) = (0, 0);
    for _ in 0..60 {
        let dims = random.dims();
        let mask = random.mask(dims);
        let spacing = [0; 3].map(|_| 0.5 + 0.25 * random.below(5) as f32);
        let sigma = 0.3 + 1.2 * random.unit();
        let mut smooth = mask.clone();
        done(smooth.smooth(spacing, sigma, &TimeSlices::unlimited()));
        // Axis by axis in double precision, over the same reach.
        let mut values: Vec<f64> = mask.bits.iter().map(|&b| f64::from(b)).collect();
        for axis in 0..3 {
            let s = f64::from(sigma / spacing[axis]);
            let reach = (3.0 * s).ceil() as i32;
            let weight = |k: i32| (-0.5 * (f64::from(k) / s).powi(2)).exp();
            let sum: f64 = (-reach..=reach).map(weight).sum();
            values = voxels(dims)
                .map(|v| {
                    (-reach..=reach)
                        .map(|k| {
                            let mut at = v.as_ivec3();
                            at[axis] = (at[axis] + k).clamp(0, dims[axis] as i32 - 1);
                            weight(k) / sum * values[index(dims, at.as_uvec3())]
                        })
                        .sum()
                })
                .collect();
        }
        for (value, &bit) in values.iter().zip(&smooth.bits) {
            // Three roundings to 16 bits.
            if (value - 0.5).abs() < 2e-4 {
                close += 1;
            } else {
                compared += 1;
                assert_eq!(bit, u8::from(*value > 0.5), "{value} with sigma {sigma}");
            }
        }
    }
    assert!(
        compared > 100 * close,
        "{compared} compared, {close} too close"
    );
}

/// A scan of random values on a turned grid.
fn scan(random: &mut Random, dims: UVec3) -> Volume {
    let turn = DMat3::from_rotation_y(0.4) * DMat3::from_diagonal(DVec3::new(1.0, 1.5, -2.0));
    let mut builder = VolumeBuilder::new();
    let values = (0..dims.element_product()).map(|_| random.below(100) as i16);
    let header = Volume {
        has_size: true,
        grid: Grid {
            dims,
            world_from_voxel: DAffine3::from_mat3_translation(turn, DVec3::new(30.0, 4.0, -9.0)),
        },
        voxels: Voxels::I16(Vec::new()),
        slope: 2.0,
        intercept: -10.0,
        value_range: [0.0; 2],
        segmentation: None,
    };
    for part in [
        SubjectPart::header(header),
        SubjectPart::Scalars(Voxels::I16(values.collect())),
    ] {
        builder.take(part).expect("small");
    }
    builder.finish().expect("whole")
}

fn recipes(text: &str) -> Vec<Recipe> {
    let text = format!(r#"{{"fabrica":1,"subject":{{"features":{text}}}}}"#);
    let document = Document::from_json(&text).expect("a document");
    document.illustration().recipes.clone()
}

fn segmented(
    volume: &Volume,
    files: &[Segmentation],
    text: &str,
    time_slices: TimeSlices,
) -> Segmented {
    let resources = Resources {
        subject: Some(volume.clone().into()),
        segmentations: files.iter().cloned().map(Arc::new).collect(),
        ..Resources::default()
    };
    done(segment(resources, recipes(text), time_slices))
}

const RECIPES: &str = r#"[
    {"name":"bone","from":{"threshold":[90]},"clean":[{"close":2},{"largest":2},{"fill":true},{"smooth":1}]},
    {"name":"soft","from":{"threshold":[20,120]},"clean":[{"grow":1.5},{"shrink":2}],"paint":[{"path":[10,-20,30,5,0,-7],"radius":2.5},{"erase":true,"path":[0,0,0],"radius":1.5}]},
    {"name":"grown","from":{"grow":{"seeds":[[0,0,0],[0.1,0.1,0],[9,9,9]],"range":[-10,150]}}}]"#;

#[test]
fn interruptions_change_nothing() {
    let volume = scan(&mut Random(11), UVec3::new(19, 14, 11));
    let whole = segmented(&volume, &[], RECIPES, TimeSlices::unlimited());
    let count = std::cell::Cell::new(0);
    let time_slices = TimeSlices::until(move || {
        count.set(count.get() + 1);
        count.get() % 2 == 0
    });
    let parts = segmented(&volume, &[], RECIPES, time_slices.clone());
    assert_eq!(whole, parts, "bit for bit");
    assert_eq!(time_slices.progress(), 1.0, "told to its end");
    assert!(
        whole
            .notices
            .iter()
            .any(|line| line
                .starts_with("/subject/features/2/from/grow/seeds/2: the seed lies outside")),
        "{:?}",
        whole.notices
    );
}

/// What is told of the work moves within each of its steps, and never back.
#[test]
fn progress_moves_within_each_step() {
    let volume = scan(&mut Random(13), UVec3::new(40, 36, 48));
    let text = r#"[ {"name":"bone","from":{"grow":{"seeds":[[0,0,0]],"range":[-10,150]}},"clean":
        [{"close":2},{"largest":1},{"fill":true},{"smooth":1},{"grow":1.5},{"shrink":2}]} ]"#;
    let resources = Resources {
        subject: Some(volume.into()),
        ..Resources::default()
    };
    let time_slices = TimeSlices::until(|| true);
    let mut work = Box::pin(segment(resources, recipes(text), time_slices.clone()));
    let mut context = std::task::Context::from_waker(std::task::Waker::noop());
    let mut told = Vec::new();
    while work.as_mut().poll(&mut context).is_pending() {
        told.push(time_slices.progress());
    }
    assert!(told.is_sorted(), "never back: {told:?}");
    assert_eq!(time_slices.progress(), 1.0);
    // Finding the voxels, six steps of the clean-up, and joining.
    for step in 0..8_u8 {
        let within = f32::from(step) / 8.0..f32::from(step + 1) / 8.0;
        let mut values: Vec<f32> = told
            .iter()
            .copied()
            .filter(|at| within.contains(at))
            .collect();
        values.dedup();
        assert!(values.len() > 20, "step {step}: {values:?}");
        let jumps = values.windows(2).map(|pair| pair[1] - pair[0]);
        let largest = jumps.fold(0.0, f32::max);
        assert!(
            largest < 0.25 / 8.0,
            "step {step} leaps by {largest}: {values:?}"
        );
    }
}

/// Names at a voxel, whatever label stands for them.
fn names_at(labels: &Segmentation, i: usize) -> Vec<String> {
    let label = u16::from(labels.labels[i]);
    let here = labels.segments.iter().filter(|s| s.label == label);
    let mut names: Vec<String> = here.map(|s| s.name.clone()).collect();
    names.sort();
    names
}

#[test]
fn segments_of_several_files_and_recipes_are_joined() {
    let mut random = Random(12);
    let dims = UVec3::new(12, 10, 8);
    let volume = scan(&mut random, dims);
    // The first on the scan's grid, the second turned the other way: x and z run backwards.
    let label = |label: u16, name: &str| Segment {
        label,
        name: name.to_owned(),
        color_srgb: None,
    };
    let own = |random: &mut Random| -> Vec<u8> {
        (0..dims.element_product())
            .map(|_| random.below(3) as u8)
            .collect()
    };
    let first = Segmentation {
        grid: volume.grid,
        labels: own(&mut random),
        segments: vec![label(1, "segment 1"), label(2, "rib")],
    };
    let last = dims.as_dvec3() - 1.0;
    let flip = DAffine3::from_translation(DVec3::new(last.x, 0.0, last.z))
        * DAffine3::from_scale(DVec3::new(-1.0, 1.0, -1.0));
    let second = Segmentation {
        grid: Grid {
            dims,
            world_from_voxel: volume.grid.world_from_voxel * flip,
        },
        labels: own(&mut random),
        segments: vec![label(1, "segment 1"), label(2, "brain")],
    };
    let files = [first, second];
    let text = r#"[{"name":"high","from":{"threshold":[100,9999]}}]"#;
    let made = segmented(&volume, &files, text, TimeSlices::unlimited());
    assert_eq!(made.notices, Vec::<String>::new());
    let labels = made.segmentation.expect("labels");
    assert_eq!(labels.grid, volume.grid);
    let all: Vec<&str> = labels
        .segments
        .iter()
        .map(|s| s.name.as_str())
        .take(2)
        .collect();
    assert_eq!(
        all,
        ["segment 1", "rib"],
        "numbers and names of the first file stay"
    );
    for v in voxels(dims) {
        let i = index(dims, v);
        let there = UVec3::new(dims.x - 1 - v.x, v.y, dims.z - 1 - v.z);
        let mut expected = Vec::new();
        match files[0].labels[i] {
            1 => expected.push("segment 1"),
            2 => expected.push("rib"),
            _ => {}
        }
        match files[1].labels[index(dims, there)] {
            // Its number was in use; the next free one is 3.
            1 => expected.push("segment 3"),
            2 => expected.push("brain"),
            _ => {}
        }
        if volume.value_at(v).expect("inside") >= 100.0 {
            expected.push("high");
        }
        expected.sort_unstable();
        assert_eq!(names_at(&labels, i), expected, "at {v}");
    }
}

#[test]
fn finer_labels_stay_fine_and_one_file_stays_as_it_is() {
    let volume = scan(&mut Random(13), UVec3::new(6, 5, 4));
    let fine = fabrica::data::resized(&volume.grid, UVec3::new(12, 10, 8));
    let labels = Segmentation {
        grid: fine,
        labels: (0..fine.voxel_count())
            .map(|i| (i % 5 == 0) as u8)
            .collect(),
        segments: vec![Segment {
            label: 1,
            name: "fifth".to_owned(),
            color_srgb: None,
        }],
    };
    let files = [labels];
    let alone = segmented(&volume, &files, "[]", TimeSlices::unlimited());
    let alone = alone.segmentation.expect("labels");
    assert_eq!(alone.labels, files[0].labels, "on its own grid");
    assert_eq!(alone.segments[0].name, "fifth");
    assert!(alone.segments[0].color_srgb.is_some(), "a color of ours");
    let text = r#"[{"name":"all","from":{"threshold":[-9999]}}]"#;
    let made = segmented(&volume, &files, text, TimeSlices::unlimited());
    let joined = made.segmentation.expect("labels");
    assert_eq!(joined.grid.dims, fine.dims);
    assert!(
        joined
            .grid
            .world_from_voxel
            .abs_diff_eq(fine.world_from_voxel, 1e-9),
        "over the same box"
    );
    for i in 0..fine.voxel_count() {
        let expected = match files[0].labels[i] {
            1 => vec!["all", "fifth"],
            _ => vec!["all"],
        };
        assert_eq!(names_at(&joined, i), expected, "{i}");
    }
}

#[test]
fn nothing_and_everything_are_segments_too() {
    let mut volume = scan(&mut Random(14), UVec3::new(5, 4, 3));
    let made = segmented(
        &volume,
        &[],
        r#"[{"from":{"threshold":[5000]},"clean":[{"largest":3},{"close":50},{"smooth":10},{"fill":true},{"shrink":50}]}]"#,
        TimeSlices::unlimited(),
    );
    assert_eq!(made.counts, [0]);
    assert_eq!(
        made.notices,
        ["/subject/features/0: no voxel of the scan is in “feature 1”"]
    );
    volume.voxels = Voxels::F32(vec![f32::NAN; 60]);
    let made = segmented(
        &volume,
        &[],
        r#"[{"from":{"threshold":[-1e30]}}]"#,
        TimeSlices::unlimited(),
    );
    assert_eq!(made.counts, [0], "what is no number is in no range");
    volume.voxels = Voxels::F32(vec![1.0; 60]);
    let all =
        r#"{"from":{"threshold":[-1e30]},"clean":[{"shrink":50},{"smooth":10},{"close":50}]}"#;
    let all = vec![all; 16].join(",");
    let made = segmented(&volume, &[], &format!("[{all}]"), TimeSlices::unlimited());
    assert_eq!(made.counts, [60; 16], "beyond the grid is neither");
    assert_eq!(
        names_at(made.segmentation.as_deref().expect("labels"), 7).len(),
        16
    );
}

/// Recipes and the names of labels travel in the link, and old documents with one label volume mean what they meant.
#[test]
fn recipes_and_label_names_survive_the_link() {
    let one = r#"{"sha256":"HASH","names":{"1":"skull","7":"Großhirn · 大脑"}}"#
        .replace("HASH", &"0f".repeat(32));
    let two = format!("[{one},{{\"src\":\"brain.nrrd\"}}]");
    for segments in [one, two] {
        let text = format!(
            r#"{{"fabrica":1,"subject":{{"sha256":"{}","segments":{segments},"features":{RECIPES}}},"templates":[{{"kind":"peel","align":{{"to":"segment","keep":["bone","skull"]}}}}]}}"#,
            "ab".repeat(32)
        );
        let document = Document::from_json(&text).expect("a document");
        assert_eq!(document.notices(), &[], "all of it is known");
        let there = document.illustration();
        assert_eq!(
            there.segments[0].names[1],
            (7, "Großhirn · 大脑".to_owned())
        );
        assert_eq!(there.recipes.len(), 3);
        let payload = fabrica::link::encode(&document);
        let back = fabrica::link::decode(&payload).expect("a link").document;
        assert_eq!(back.to_json(), document.to_json());
        assert_eq!(back.illustration(), there);
    }
    let many = ["{}"; 9].join(",");
    let text = format!(r#"{{"fabrica":1,"subject":{{"segments":[{many}]}}}}"#);
    let error = Document::from_json(&text)
        .expect_err("too many")
        .to_string();
    assert!(
        error.starts_with("/subject/segments: 9 label volumes"),
        "{error}"
    );
}

/// Distance of a point from a line between two others, mm, found by narrowing down: the plain reading of what a stroke
/// touches.
fn distance_mm(pos: DVec3, [start, end]: [DVec3; 2]) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..200 {
        let third = (high - low) / 3.0;
        let off = |part: f64| (pos - start.lerp(end, part)).length();
        if off(low + third) <= off(high - third) {
            high -= third;
        } else {
            low += third;
        }
    }
    (pos - start.lerp(end, low)).length()
}

#[test]
fn strokes_touch_what_is_near_their_line_in_order() {
    let mut random = Random(21);
    let mut touched = 0;
    for round in 0..60 {
        let dims = UVec3::new(4, 3, 2) + random.dims();
        // Turned, with voxels of 1 by 1.5 by 2 mm, the last axis backwards.
        let volume = scan(&mut random, dims);
        let grid = volume.grid;
        let world = |place: [i32; 3]| {
            let subject = DVec3::from(place.map(f64::from)) / 1000.0;
            let voxel = grid
                .subject_from_voxel()
                .inverse()
                .transform_point3(subject);
            grid.world_from_voxel.transform_point3(voxel)
        };
        let mut expected = vec![false; volume.voxels.len()];
        let mut strokes = Vec::new();
        // How near to its border a ball comes to the middle of a voxel.
        let mut nearest = f64::INFINITY;
        for _ in 0..1 + random.below(4) {
            let place = |random: &mut Random| -> [i32; 3] {
                std::array::from_fn(|_| random.below(1400) as i32 - 700)
            };
            let places: Vec<[i32; 3]> = (0..1 + random.below(4))
                .map(|_| place(&mut random))
                .collect();
            let radius = 0.3 + 4.0 * random.unit();
            let erases = random.below(3) == 0;
            for v in voxels(dims) {
                let pos = grid.world_from_voxel.transform_point3(v.as_dvec3());
                let ends = |i: usize| [world(places[i.saturating_sub(1)]), world(places[i])];
                let off = (0..places.len()).map(|i| distance_mm(pos, ends(i)));
                let off = off.fold(f64::INFINITY, f64::min);
                nearest = nearest.min((off - f64::from(radius)).abs());
                if off <= f64::from(radius) {
                    expected[index(dims, v)] = !erases;
                    touched += 1;
                }
            }
            let mut before = [0; 3];
            let mut path = Vec::new();
            for place in places {
                path.extend((0..3).map(|k| (place[k] - before[k]).to_string()));
                before = place;
            }
            strokes.push(format!(
                r#"{{"erase":{erases},"radius":{radius},"path":[{}]}}"#,
                path.join(",")
            ));
        }
        if nearest < 1e-6 {
            continue;
        }
        let text = format!(r#"[{{"name":"x","paint":[{}]}}]"#, strokes.join(","));
        let made = segmented(&volume, &[], &text, TimeSlices::unlimited());
        let labels = made.segmentation.expect("labels");
        let found: Vec<bool> = labels.labels.iter().map(|&label| label > 0).collect();
        assert_eq!(found, expected, "round {round}: {text}");
    }
    assert!(touched > 2000, "only {touched} voxels were touched");
}

#[test]
fn strokes_come_after_the_clean_up_and_far_ones_touch_nothing() {
    let volume = scan(&mut Random(22), UVec3::new(9, 8, 7));
    let all = r#"{"name":"x","from":{"threshold":[-9999]}"#;
    let none =
        r#"{"name":"y","from":{"threshold":[9998,9999]},"clean":[{"largest":1},{"shrink":50}]"#;
    let far =
        r#"{"path":[10000,10000,10000],"radius":1},{"path":[-10000,0,0,0,10000,0],"radius":1}"#;
    let text = format!(
        r#"[{all},"clean":[{{"fill":true}}],"paint":[{{"erase":true,"radius":50,"path":[0,0,0]}},{{"radius":2,"path":[0,0,0]}}]}},
            {none},"paint":[{far}]}},{{"name":"z","paint":[]}}]"#
    );
    let made = segmented(&volume, &[], &text, TimeSlices::unlimited());
    let ball = segmented(
        &volume,
        &[],
        r#"[{"name":"x","paint":[{"radius":2,"path":[0,0,0]}]}]"#,
        TimeSlices::unlimited(),
    );
    assert!(ball.counts[0] > 5, "{:?}", ball.counts);
    assert_eq!(
        made.counts,
        [ball.counts[0], 0, 0],
        "erased whole, then a ball"
    );
    assert_eq!(
        made.notices,
        ["/subject/features/1: no voxel of the scan is in “y”"],
        "what is yet to be painted is not missed"
    );
    // The same with the clean-up at hand, time slice by time slice.
    let known = KnownMasks::default();
    for _ in 0..2 {
        let resources = Resources {
            subject: Some(volume.clone().into()),
            ..Resources::default()
        };
        let again = done(segment_with(
            resources,
            recipes(&text),
            Some(known.clone()),
            TimeSlices::until(|| true),
        ));
        assert_eq!(again.segmentation, made.segmentation);
        assert_eq!(again.counts, made.counts);
    }
    assert_eq!(
        known.byte_count(),
        2 * 8 * 504_usize.div_ceil(64),
        "a bit per voxel"
    );
}
