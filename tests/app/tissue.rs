//! Tissues: made by values and by growing, cleaned up, shown alone, kept by a template; on a built-in subject, and on a scan to look at.

use super::*;
use fabrica::document::{Align, CleanStep, FeatureRecipe, FeatureSource};
use fabrica::load::{LabelSource, LoadReport, ReadOptions, read_subject};

impl Window {
    fn features(&self) -> Vec<FeatureRecipe> {
        self.document().illustration().features.clone()
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
    let made = window.features();
    assert_eq!(made.len(), 1);
    assert!(
        matches!(made[0].from, FeatureSource::Threshold { .. }),
        "by values: {made:?}"
    );
    assert!(made[0].clean.contains(&CleanStep::Largest(1)), "{made:?}");
    window.look("tissue");
    // It is there for the template to keep, beside the segments of the subject.
    let name = made[0].name.clone();
    window.place_peel();
    window.click("Leaves alone: Tissue");
    let title = if name == "bone" { "Bone" } else { &name };
    let label = format!("Leaves alone: {title}");
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
    match &window.features()[0].from {
        FeatureSource::Grow { seeds, .. } => assert_eq!(seeds.len(), 1, "one click, one point"),
        other => panic!("{other:?}"),
    }
    window.look("tissue_grown");
    // Each of these was one step of undo.
    for _ in 0..2 {
        window.press_with(Modifiers::COMMAND, Key::Z);
    }
    window.settle();
    assert_eq!(window.features(), made, "as it was made");
    window.click(&format!("Remove {}", title.to_lowercase()));
    window.settle();
    assert!(window.features().is_empty(), "removed");
    window.settle();
}

/// The author's path on real scans, to be looked at; the link and the same file give the same again.
#[test]
fn bone_of_a_scan_to_look_at() {
    let (Some(data), true) = (
        std::env::var_os("FABRICA_TEST_DATA"),
        std::env::var_os("FABRICA_LOOK_AT").is_some(),
    ) else {
        println!("FABRICA_TEST_DATA or FABRICA_LOOK_AT is not set: nobody looks, nothing is drawn");
        return;
    };
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
        window.click("Leaves alone: Tissue");
        window.settle();
        window.look(&format!("{name}_peeled"));
    }
}
