//! One load, from its description to the events that the app waits for. The same natively (in a thread) and on the page
//! (in a worker); where it runs and how events travel is the caller's affair. Meshes have a file of their own, as their
//! readers are a program of their own in the page.

use std::io::Read as _;

use sha2::{Digest as _, Sha256};

use crate::assets::{LoadEvent, RawQuestion, SegmentationsExpected};
use crate::data::{Reducer, Reduction, SubjectPart, SubjectSink, VolumeLimits};
use crate::document::Reading;
use crate::load::{
    FileSet, LabelSource, LoadError, LoadReport, MeshOrNot, RawLayout, ReadOptions, Warning,
    is_segmentation, mesh_or_not, read_header, read_label_file, read_raw, read_subject,
};
use crate::subjects::{COARSE_RESOLUTION, FINE_RESOLUTION, Generator, Slab};

/// Slabs are made of about this many voxels: large enough to travel well, small enough to stop soon.
const SLAB_VOXELS: usize = 1 << 20;

/// Progress is told in steps of this size, for each is a frame of the app.
const PROGRESS_STEP: f32 = 0.01;

/// Passes events on. Returns false when no one wants more of them.
pub trait Post {
    /// Passes one event on.
    fn post(&mut self, event: LoadEvent) -> bool;
}

impl<F: FnMut(LoadEvent) -> bool> Post for F {
    fn post(&mut self, event: LoadEvent) -> bool {
        self(event)
    }
}

/// How finely a built-in subject is made for a device with these limits: coarsely at once, then finely.
pub fn resolutions(limits: VolumeLimits) -> [u32; 2] {
    [COARSE_RESOLUTION, FINE_RESOLUTION.min(limits.max_dim)]
}

/// Makes a revision of a built-in subject with each of these resolutions in turn, voxels along its longest side.
/// `slabs` makes the slabs of a generator that lie in the given ranges, in order; it may use threads.
pub fn make_subject(
    (name, revision): (&str, u32),
    resolutions: &[u32],
    mut slabs: impl FnMut(&Generator, u32, &mut dyn FnMut(Slab) -> bool) -> bool,
    post: &mut dyn Post,
) {
    for (i, &resolution) in resolutions.iter().enumerate() {
        let is_last = i + 1 == resolutions.len();
        let generator = match Generator::of_revision(name, revision, resolution) {
            Ok(generator) => generator,
            Err(error) => {
                post.post(LoadEvent::Failed {
                    message: error.to_string(),
                    details: String::new(),
                    fault: None,
                });
                return;
            }
        };
        let header = SubjectPart::header(generator.header());
        if !post.post(LoadEvent::Part(header)) {
            return;
        }
        let dims = generator.header().grid.dims;
        let slice = (dims.x * dims.y).max(1) as usize;
        let thickness = (SLAB_VOXELS / slice) as u32;
        let thickness = (thickness - thickness % Generator::SLAB).max(Generator::SLAB);
        let mut done = 0;
        let total = generator.slice_count().max(1) as usize * slice;
        let goes_on = slabs(&generator, thickness, &mut |slab| {
            done += slab.values.len();
            let progress = LoadEvent::Progress {
                fraction: done as f32 / total as f32,
                what: "Generating".to_owned(),
            };
            let mut parts = slab.into_parts().into_iter();
            parts.all(|part| post.post(LoadEvent::Part(part))) && (!is_last || post.post(progress))
        });
        if !goes_on {
            return;
        }
        let end = if is_last {
            LoadEvent::Done { sha256: None }
        } else {
            LoadEvent::Coarse
        };
        if !post.post(end) {
            return;
        }
    }
}

/// Makes the slabs of a generator one after the other.
#[cfg(any(target_arch = "wasm32", test))]
pub fn slabs_in_turn(
    generator: &Generator,
    thickness: u32,
    take: &mut dyn FnMut(Slab) -> bool,
) -> bool {
    let end = generator.slice_count();
    let mut z = 0;
    while z < end {
        if !take(generator.slab(z..z + thickness)) {
            return false;
        }
        z += thickness;
    }
    true
}

/// Makes the slabs of a generator in as many threads as there are cores, and hands them over in order.
#[cfg(not(target_arch = "wasm32"))]
pub fn slabs_in_threads(
    generator: &Generator,
    thickness: u32,
    take: &mut dyn FnMut(Slab) -> bool,
) -> bool {
    let n_threads = std::thread::available_parallelism().map_or(2, |n| n.get().min(16)) as u32;
    let n_slabs = generator.slice_count().div_ceil(thickness);
    std::thread::scope(|scope| {
        // Each thread makes every nth slab and waits when it is two ahead, so that little is held.
        let outputs: Vec<_> = (0..n_threads)
            .map(|first| {
                let (sender, receiver) = std::sync::mpsc::sync_channel(2);
                scope.spawn(move || {
                    for slab in (first..n_slabs).step_by(n_threads as usize) {
                        let start = slab * thickness;
                        if sender
                            .send(generator.slab(start..start + thickness))
                            .is_err()
                        {
                            return;
                        }
                    }
                });
                receiver
            })
            .collect();
        (0..n_slabs).all(|slab| {
            let output = outputs.get((slab % n_threads) as usize);
            output.and_then(|o| o.recv().ok()).is_some_and(&mut *take)
        })
    })
}

/// Endings of files that may hold bare voxels.
const RAW_ENDINGS: [&str; 7] = [".raw", ".bin", ".dat", ".vol", ".img", ".data", ".zraw"];

/// Words in the names of files that hold labels although their headers do not tell.
const LABEL_WORDS: [&str; 4] = ["label", "seg", "mask", "atlas"];
/// More files than this are a series of slices, with DICOM segmentations at most, not a scan with its label volumes.
const MOST_WITH_LABELS: usize = 12;
/// Larger files are not read in advance to know them by their hash.
const MOST_HASHED_BYTES: u64 = 64 << 20;

/// Takes the label volumes out of files that were opened together, and posts them. What is left is the scan; nothing
/// may be left if one is shown already, or if the document names them.
pub fn take_segmentations(
    files: &mut dyn FileSet,
    names: Vec<String>,
    expected: &SegmentationsExpected,
    post: &mut dyn Post,
) -> Vec<String> {
    let is_series = names.len() > MOST_WITH_LABELS;
    let is_alone = names.len() == 1;
    let (mut labels, mut rest) = (Vec::new(), Vec::new());
    for name in names {
        if is_series && !is_segmentation(files, &name) {
            rest.push(name);
            continue;
        }
        let is_named = !expected.sha256.is_empty()
            && hash_of(files, &name).is_some_and(|hash| expected.sha256.contains(&hash));
        let may_be = !is_alone || expected.has_scan;
        // A series is not looked through again: what its file is has been asked.
        if is_named || is_series || (may_be && looks_like_labels(files, &name)) {
            labels.push((name, is_named));
        } else {
            rest.push(name);
        }
    }
    if rest.is_empty() && !expected.has_scan && labels.iter().all(|(_, is_named)| !is_named) {
        // Labels of nothing are looked at as a scan.
        return labels.into_iter().map(|(name, _)| name).collect();
    }
    for (name, _) in labels {
        match read_label_file(files, &name, &ReadOptions::default()) {
            Ok(file) => {
                if !post.post(LoadEvent::LabelFile(Box::new(file))) {
                    return Vec::new();
                }
            }
            // It only seemed to be one.
            Err(LoadError::NotLabels { .. }) => rest.push(name),
            Err(error) => {
                post.post(LoadEvent::Notice(error.to_string()));
            }
        }
    }
    rest
}

fn looks_like_labels(files: &mut dyn FileSet, name: &str) -> bool {
    let lower = name.to_lowercase();
    if may_be_raw(&lower) && !lower.ends_with(".img") {
        return false;
    }
    let Ok((_, report)) = read_header(files, name, &ReadOptions::default()) else {
        return false;
    };
    report.is_labels || LABEL_WORDS.iter().any(|word| lower.contains(word))
}

/// The hash of a file's bytes, if it is not large.
pub(super) fn hash_of(files: &mut dyn FileSet, name: &str) -> Option<String> {
    let mut file = files.open(name).ok()?;
    file.byte_len
        .filter(|&length| length <= MOST_HASHED_BYTES)?;
    let mut hash = Sha256::new();
    let mut block = vec![0; 1 << 16];
    loop {
        match file.read.read(&mut block).ok()? {
            0 => break,
            n => hash.update(block.get(..n)?),
        }
    }
    Some(crate::math::hex(&hash.finalize()))
}

/// Reads a label volume that the document names.
pub fn read_segments(files: &mut dyn FileSet, name: &str, post: &mut dyn Post) {
    let event = match read_label_file(files, name, &ReadOptions::default()) {
        Ok(file) => {
            if !post.post(LoadEvent::LabelFile(Box::new(file))) {
                return;
            }
            LoadEvent::Done { sha256: None }
        }
        Err(error) => LoadEvent::Failed {
            message: error.to_string(),
            details: String::new(),
            fault: error.fault(),
        },
    };
    post.post(event);
}

/// Reads a scan from a file and posts its pieces and how the load ended.
pub fn read_scan_file(
    files: &mut dyn FileSet,
    name: &str,
    limits: VolumeLimits,
    reading: &Reading,
    post: &mut dyn Post,
) {
    let mut sink = PostingSink::new(post);
    let mut report = LoadReport::default();
    let mut reducer = Reducer::new(&mut sink, limits);
    let outcome = read_scan(files, name, reading, &mut reducer, &mut report);
    let reduction = reducer.reduction();
    match outcome {
        Err(LoadError::UnknownFormat { .. }) if !sink.is_stopped() && may_be_raw(name) => {
            post.post(LoadEvent::AskRaw(question(files, name)));
        }
        outcome => sink.end(outcome, &report, reduction),
    }
}

/// Reads a scan as its document says. A file that says that it holds labels brings its segments.
///
/// # Errors
/// As [`read_subject`] and [`read_raw`].
pub fn read_scan(
    files: &mut dyn FileSet,
    name: &str,
    reading: &Reading,
    sink: &mut dyn SubjectSink,
    report: &mut LoadReport,
) -> Result<(), LoadError> {
    let options = ReadOptions {
        frame: reading.frame,
        ..ReadOptions::default()
    };
    match &reading.raw {
        Some(raw) => read_raw(files, name, &RawLayout::from(raw), &options, sink, report),
        None => {
            let own = LabelSource::default();
            read_subject(files, name, &own, &options, sink, report)
        }
    }
}

/// True if a file is to be read as a mesh. One that cannot be opened twice is read as a scan, whose reader names a
/// mesh.
///
/// # Errors
/// [`LoadError`] if the file cannot be read.
pub fn is_mesh_file(
    files: &mut dyn FileSet,
    name: &str,
    reading: &Reading,
) -> Result<bool, LoadError> {
    let may_be = reading.raw.is_none() && files.can_reopen();
    Ok(may_be && matches!(mesh_or_not(files, name)?, MeshOrNot::Mesh(_)))
}

/// The message for a document that asks for a file of the reader's own. `name` is the author's name for the file.
pub fn wanted_file(name: &str) -> String {
    let called = if name.is_empty() {
        String::new()
    } else {
        format!(" (“{}”)", name.chars().take(80).collect::<String>())
    };
    format!(
        "This illustration was made with a file that is not part of it{called}: open the file, or drop it here"
    )
}

/// True if a name promises voxels and no more.
pub fn may_be_raw(name: &str) -> bool {
    let lower = name.to_lowercase();
    let lower = lower.strip_suffix(".gz").unwrap_or(&lower);
    RAW_ENDINGS.iter().any(|ending| lower.ends_with(ending))
        || RawLayout::guess(lower, None).is_some()
}

fn question(files: &mut dyn FileSet, name: &str) -> RawQuestion {
    let mut start = [0; 2];
    let mut byte_len = None;
    let mut is_packed = false;
    if let Ok(mut file) = files.open(name) {
        byte_len = file.byte_len;
        is_packed = file.read.read_exact(&mut start).is_ok() && start == [0x1f, 0x8b];
    }
    let guess = RawLayout::guess(name, byte_len.filter(|_| !is_packed));
    RawQuestion {
        byte_len,
        is_packed,
        guess: guess.as_ref().map(Into::into),
    }
}

/// Turns what a reader hands over into events.
pub(super) struct PostingSink<'a> {
    post: &'a mut dyn Post,
    /// What is done, for who waits.
    what: &'static str,
    last_fraction: f32,
    is_stopped: bool,
}

impl<'a> PostingSink<'a> {
    pub(super) fn new(post: &'a mut dyn Post) -> Self {
        Self::of(post, "Reading")
    }

    /// One that tells what is done in other words.
    pub(super) fn of(post: &'a mut dyn Post, what: &'static str) -> Self {
        Self {
            post,
            what,
            last_fraction: -1.0,
            is_stopped: false,
        }
    }

    /// True if nobody wants more.
    pub(super) fn is_stopped(&self) -> bool {
        self.is_stopped
    }

    fn pass(&mut self, event: LoadEvent) -> bool {
        self.is_stopped = self.is_stopped || !self.post.post(event);
        !self.is_stopped
    }

    /// Tells how a load ended.
    pub(super) fn end(
        self,
        outcome: Result<(), LoadError>,
        report: &LoadReport,
        reduction: Option<Reduction>,
    ) {
        let post = self.post;
        match outcome {
            Ok(()) => {
                let hash = report.sha256_hex();
                if report.frame_count > 1 {
                    post.post(LoadEvent::Frames {
                        count: report.frame_count,
                    });
                }
                if let Some(code) = &report.modality {
                    post.post(LoadEvent::Modality(code.clone()));
                }
                for warning in &report.warnings {
                    // Which of several volumes is shown stands in a dialog of its own.
                    if !matches!(warning, Warning::Frames { .. }) {
                        post.post(LoadEvent::Notice(warning.to_string()));
                    }
                }
                if let Some(reduction) = reduction {
                    post.post(LoadEvent::Notice(reduction.to_string()));
                }
                post.post(LoadEvent::Done { sha256: hash });
            }
            Err(_) if self.is_stopped => {
                post.post(LoadEvent::Cancelled);
            }
            Err(error) => {
                post.post(LoadEvent::Failed {
                    message: error.to_string(),
                    details: report.notices().join("\n"),
                    fault: error.fault(),
                });
            }
        }
    }
}

impl SubjectSink for PostingSink<'_> {
    fn take(&mut self, part: SubjectPart) -> Result<(), String> {
        match self.pass(LoadEvent::Part(part)) {
            true => Ok(()),
            false => Err("stopped".to_owned()),
        }
    }

    fn progress(&mut self, fraction: f32) -> bool {
        if fraction >= 1.0 || fraction - self.last_fraction >= PROGRESS_STEP {
            self.last_fraction = fraction;
            return self.pass(LoadEvent::Progress {
                fraction,
                what: self.what.to_owned(),
            });
        }
        !self.is_stopped
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::load::MemoryFiles;

    const LIMITS: VolumeLimits = VolumeLimits {
        max_dim: 2048,
        max_voxels: 1 << 30,
    };

    #[test]
    fn a_subject_comes_coarse_and_then_fine() {
        let mut kinds = Vec::new();
        let mut counts = Vec::new();
        make_subject(
            ("cube", 1),
            &resolutions(LIMITS),
            slabs_in_turn,
            &mut |event: LoadEvent| {
                match event {
                    LoadEvent::Part(SubjectPart::Volume(header)) => {
                        counts.push((header.grid.voxel_count(), 0));
                        kinds.push('b');
                    }
                    LoadEvent::Part(SubjectPart::Scalars(voxels)) => {
                        if let Some(last) = counts.last_mut() {
                            last.1 += voxels.len();
                        }
                    }
                    LoadEvent::Coarse => kinds.push('c'),
                    LoadEvent::Done { sha256: None } => kinds.push('d'),
                    LoadEvent::Part(SubjectPart::Labels(_)) | LoadEvent::Progress { .. } => {}
                    other => panic!("unexpected: {other:?}"),
                }
                true
            },
        );
        assert_eq!(kinds, ['b', 'c', 'b', 'd'], "in this order");
        assert!(
            counts.iter().all(|(a, b)| a == b),
            "all voxels came: {counts:?}"
        );
    }

    #[test]
    fn a_stopped_subject_says_no_more() {
        let mut n = 0;
        make_subject(
            ("cube", 1),
            &resolutions(LIMITS),
            slabs_in_turn,
            &mut |_: LoadEvent| {
                n += 1;
                n < 3
            },
        );
        assert_eq!(n, 3, "nothing is posted after the receiver declined");
    }

    #[test]
    fn a_file_that_is_no_scan_fails_in_words() {
        let mut files = MemoryFiles::new([("x.nii", b"hello".to_vec())]);
        let mut last = None;
        read_scan_file(
            &mut files,
            "x.nii",
            LIMITS,
            &Reading::default(),
            &mut |event: LoadEvent| {
                last = Some(event);
                true
            },
        );
        assert!(
            matches!(&last, Some(LoadEvent::Failed { message, .. }) if message.contains("x.nii")),
            "{last:?}"
        );
    }

    /// A series of a few files or of many, and a segmentation among them.
    #[test]
    fn segmentations_are_told_from_their_series() {
        let Some(data) = std::env::var_os("FABRICA_TEST_DATA") else {
            println!("did not run: FABRICA_TEST_DATA names no folder of scans");
            return;
        };
        let folder = std::path::Path::new(&data).join("dicom");
        let read = |path: std::path::PathBuf| {
            let name = path.file_name().expect("a name").to_string_lossy();
            (
                name.into_owned(),
                std::fs::read(&path).expect("a file of the test data"),
            )
        };
        let few = ["IMG0001.dcm", "IMG0002.dcm", "IMG0003.dcm"];
        let few = few.map(|name| read(folder.join("seg_23x38x3").join(name)));
        let many = std::fs::read_dir(folder.join("head_mr_17slices")).expect("the series");
        let many = many.map(|entry| read(entry.expect("a file").path()));
        for series in [few.to_vec(), many.collect()] {
            let count = series.len();
            let seg = read(folder.join("seg_23x38x3/segmentation.dcm"));
            let all = || series.iter().cloned().chain([seg.clone()]);
            let mut files = MemoryFiles::new(all());
            let mut found = Vec::new();
            let mut post = |event: LoadEvent| {
                if let LoadEvent::LabelFile(file) = event {
                    let segments = file.segmentation.segments;
                    found.extend(segments.into_iter().map(|segment| segment.name));
                }
                true
            };
            let names = all().map(|(name, _)| name).collect();
            let rest = take_segmentations(
                &mut files,
                names,
                &SegmentationsExpected::default(),
                &mut post,
            );
            assert_eq!((rest.len(), found), (count, vec!["Liver".to_owned()]));
        }
    }

    #[test]
    fn label_volumes_are_told_from_the_scan() {
        let file = |values: [u8; 8]| {
            let mut file =
                b"NRRD0004\ntype: uint8\ndimension: 3\nsizes: 2 2 2\nencoding: raw\n\n".to_vec();
            file.extend(values);
            file
        };
        let mut files = MemoryFiles::new([
            ("scan.nrrd", file([0, 9, 18, 27, 36, 45, 54, 63])),
            ("skull_label.nrrd", file([0, 0, 0, 1, 1, 1, 2, 2])),
            ("other.nrrd", file([0, 0, 5, 5, 0, 0, 0, 0])),
        ]);
        let mut take = |names: &[&str], expected: &SegmentationsExpected| {
            let mut found = Vec::new();
            let mut post = |event: LoadEvent| {
                if let LoadEvent::LabelFile(file) = event {
                    found.push((file.sha256, file.segmentation.segments.len()));
                }
                true
            };
            let names = names.iter().map(|&name| name.to_owned()).collect();
            let rest = take_segmentations(&mut files, names, expected, &mut post);
            (rest, found)
        };
        let nothing = SegmentationsExpected::default();
        let (rest, found) = take(&["scan.nrrd", "skull_label.nrrd"], &nothing);
        assert_eq!((rest, found[0].1), (vec!["scan.nrrd".to_owned()], 2));
        let (rest, found) = take(&["skull_label.nrrd"], &nothing);
        assert_eq!(
            (rest.len(), found.len()),
            (1, 0),
            "labels of nothing are a scan"
        );
        let has_scan = SegmentationsExpected {
            has_scan: true,
            ..SegmentationsExpected::default()
        };
        let (rest, found) = take(&["skull_label.nrrd"], &has_scan);
        assert_eq!(
            (rest.len(), found.len()),
            (0, 1),
            "of the scan that is shown"
        );
        let (rest, found) = take(&["scan.nrrd"], &has_scan);
        assert_eq!((rest.len(), found.len()), (1, 0), "another scan");
        let mut hash = Sha256::new();
        hash.update(file([0, 0, 5, 5, 0, 0, 0, 0]));
        let hash = crate::math::hex(&hash.finalize());
        let named = SegmentationsExpected {
            sha256: vec![hash.clone()],
            has_scan: false,
        };
        let (rest, found) = take(&["other.nrrd", "scan.nrrd"], &named);
        assert_eq!(
            (rest.len(), found),
            (1, vec![(hash, 1)]),
            "the document names it"
        );
    }

    #[test]
    fn bare_voxels_are_asked_about_and_then_read() {
        let mut files = MemoryFiles::new([("scan_4x3x2_uint8.raw", vec![7; 24])]);
        let mut read = |reading: &Reading| {
            let mut last = None;
            let mut post = |event: LoadEvent| {
                last = Some(event);
                true
            };
            let name = "scan_4x3x2_uint8.raw";
            read_scan_file(&mut files, name, LIMITS, reading, &mut post);
            last
        };
        let Some(LoadEvent::AskRaw(question)) = read(&Reading::default()) else {
            panic!("it should have asked");
        };
        assert_eq!((question.byte_len, question.is_packed), (Some(24), false));
        let raw = question.guess.expect("its name says it");
        assert_eq!(raw.size, [4, 3, 2]);
        let frame = 0;
        let done = read(&Reading {
            frame,
            raw: Some(raw),
            ..Reading::default()
        });
        assert!(
            matches!(done, Some(LoadEvent::Done { sha256: Some(_) })),
            "{done:?}"
        );
    }
}
