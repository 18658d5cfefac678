//! Tissues: made by values and by growing, cleaned up, shown alone, kept by a template; on a built-in subject, and on a
//! scan to look at.

use super::*;
use fabrica::document::{Align, CleanStep, Recipe, RecipeSource};
use fabrica::load::{LabelFile, LabelSource, LoadReport, ReadOptions, read_subject};

impl Window {
    fn recipes(&self) -> Vec<Recipe> {
        self.document().illustration().recipes.clone()
    }

    /// What the shell does when a scan is dropped.
    fn drop_scan(&mut self, path: &std::path::Path) {
        let name = path
            .file_name()
            .expect("a file")
            .to_string_lossy()
            .into_owned();
        let bytes = std::fs::read(path).expect("a scan");
        let mut files = fabrica::load::MemoryFiles::new([(name.as_str(), bytes)]);
        let log = &mut *self.log.0.borrow_mut();
        log.next_ticket += 1;
        let ticket = Ticket(log.next_ticket);
        log.queue.push(Message::FileStarted { ticket });
        let mut report = LoadReport::default();
        read_subject(
            &mut files,
            &name,
            &LabelSource::default(),
            &ReadOptions::default(),
            &mut Queue(log, ticket),
            &mut report,
        )
        .expect("it is read");
        let sha256 = report.sha256_hex();
        log.queue.push(Message::Load {
            ticket,
            event: LoadEvent::Done { sha256 },
        });
    }
}

#[test]
fn a_tissue_is_made_cleaned_up_and_kept_by_a_template() {
    let mut window = Window::open(DESK, CUBE);
    window.click("Panel: Tissues");
    window.click("Make a tissue");
    window.settle();
    let made = window.recipes();
    assert_eq!(made.len(), 1);
    assert!(
        matches!(made[0].from, RecipeSource::Threshold { .. }),
        "by values: {made:?}"
    );
    assert!(made[0].clean.contains(&CleanStep::Largest(1)), "{made:?}");
    window.look("tissue");
    // It is there for the template to keep, beside the segments of the subject.
    let name = made[0].name.clone();
    window.place_peel();
    window.click("Keep in place: Tissue");
    let title = if name == "bone" { "Bone" } else { &name };
    let label = format!("Keep in place: {title}");
    let keeps = |window: &Window| match &window.document().illustration().templates[0].align {
        Align::Segment { keep, .. } => keep.clone(),
        other => panic!("{other:?}"),
    };
    if !keeps(&window).contains(&name) {
        window.click(&label);
    }
    assert!(keeps(&window).contains(&name), "{:?}", keeps(&window));
    // Growing: a point of the object, with its value.
    window.click("Panel: Tissues");
    window.click("Found by: Growing");
    let center = window.picture_center();
    window.click_at(center);
    window.settle();
    match &window.recipes()[0].from {
        RecipeSource::Grow { seeds, .. } => assert_eq!(seeds.len(), 1, "one click, one point"),
        other => panic!("{other:?}"),
    }
    window.look("tissue_grown");
    // Each of these was one step of undo.
    for _ in 0..2 {
        window.press_with(Modifiers::COMMAND, Key::Z);
    }
    window.settle();
    assert_eq!(window.recipes(), made, "as it was made");
    window.click(&format!("Remove {}", title.to_lowercase()));
    window.settle();
    assert!(window.recipes().is_empty(), "removed");
    window.settle();
}

/// The author's path on real scans, to be looked at; the link and the same file give the same again.
#[test]
#[ignore = "only drawn to be looked at: cargo xtask look"]
fn bone_of_a_scan_to_look_at() {
    let data =
        std::env::var_os("FABRICA_TEST_DATA").expect("FABRICA_TEST_DATA names the folder of scans");
    for name in ["chest_ct_2mm", "thigh_femur_ct"] {
        let path = std::path::Path::new(&data).join(format!("ct/{name}.nii.gz"));
        let mut window = Window::open(DESK, CUBE);
        window.drop_scan(&path);
        window.settle();
        let start = std::time::Instant::now();
        window.click("Panel: Tissues");
        window.click("Make a tissue");
        window.settle();
        println!(
            "{name}: found and drawn in {:.1} s",
            start.elapsed().as_secs_f32()
        );
        window.look(&format!("{name}_alone"));
        window.press(Key::V);
        window.settle();
        window.look(&format!("{name}_slices"));
        window.press(Key::V);
        window.place_peel();
        window.click("Keep in place: Tissue");
        window.settle();
        window.look(&format!("{name}_peeled"));
    }
}

/// Label volumes come with the scan or after it; the document names them, and a link to it asks for them.
#[test]
fn label_files_become_tissues_of_the_scan() {
    // The pictures are small: the tests look at the panels.
    const SMALL: Vec2 = Vec2::new(780.0, 360.0);
    let mut window = Window::open(SMALL, CUBE);
    let dropped = |window: &mut Window, has_scan: bool, labels: &[(&str, u8)]| {
        let log = &mut *window.log.0.borrow_mut();
        log.next_ticket += 1;
        let ticket = Ticket(log.next_ticket);
        log.queue.push(Message::FileStarted { ticket });
        for (hash, from) in labels {
            let grid = fabrica::subjects::Generator::new("cube", RESOLUTION)
                .expect("the cube")
                .header()
                .grid;
            let slice = (grid.dims.x * grid.dims.y) as usize;
            let labels = fabrica::data::Segmentation {
                grid,
                labels: (0..grid.voxel_count())
                    .map(|i| u8::from(i / slice > usize::from(*from)))
                    .collect(),
                segments: vec![fabrica::data::Segment {
                    label: 1,
                    name: "segment 1".to_owned(),
                    color_srgb: None,
                }],
            };
            let event = LoadEvent::LabelFile(Box::new(LabelFile {
                sha256: hash.repeat(32),
                segmentation: labels,
                numbers: vec![1],
            }));
            log.queue.push(Message::Load { ticket, event });
        }
        let mut sha256 = None;
        if has_scan {
            fabrica::subjects::generate("cube", RESOLUTION, &mut Queue(log, ticket))
                .expect("the cube");
            sha256 = Some("5c".repeat(32));
        }
        let event = LoadEvent::Done { sha256 };
        log.queue.push(Message::Load { ticket, event });
    };
    dropped(&mut window, true, &[("aa", 10)]);
    window.settle();
    let named = |window: &Window| -> Vec<String> {
        let document = window.document();
        let segments = document.illustration().segments.iter();
        segments.filter_map(|s| s.sha256.clone()).collect()
    };
    assert_eq!(named(&window), ["aa".repeat(32)]);
    // A second one, for the scan that is shown.
    dropped(&mut window, false, &[("bb", 30)]);
    window.settle();
    assert_eq!(named(&window), ["aa".repeat(32), "bb".repeat(32)]);
    window.click("Panel: Tissues");
    for name in ["top", "segment 1", "segment 6"] {
        window.harness.get_by_label(&format!("Show {name} alone"));
    }
    window.press_with(Modifiers::COMMAND, Key::Z);
    window.settle();
    assert_eq!(named(&window).len(), 1, "one step of undo");
    // Who opens the document is asked for what it names, until it is there.
    let json = window.document().to_json();
    let mut window = Window::open(SMALL, &json);
    dropped(&mut window, true, &[]);
    window.settle();
    let asks = |window: &Window| {
        let all = window
            .harness
            .query_all_by_label_contains("needs a label file");
        all.count() > 0
    };
    assert!(asks(&window), "it is asked for");
    dropped(&mut window, false, &[("aa", 10)]);
    window.settle();
    assert!(!asks(&window), "it is there");
    assert_eq!(window.document().to_json(), json, "as it was");
}
