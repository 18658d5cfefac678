//! Tissues: made by values and by growing, cleaned up, shown alone, kept by a template; on a built-in subject, and on a
//! scan to look at.

use super::*;
use fabrica::document::{Align, CleanStep, Recipe, RecipeSource};
use fabrica::load::{LabelFile, LabelSource, LoadReport, ReadOptions, read_subject};

impl Window {
    fn recipes(&self) -> Vec<Recipe> {
        self.document().illustration().recipes.clone()
    }

    /// Shows a scan with enough voxels for many frames of work.
    fn drop_large_cube(&mut self) {
        self.drop_built_in("cube", 160, &"5c".repeat(32));
    }

    /// Pixels of the picture in which something is seen.
    fn drawn(&mut self) -> usize {
        let rect = self.harness.get_by_role(Role::Image).rect();
        let picture = self.pixels(rect);
        let is_white = |p: &image::Rgba<u8>| p.0.iter().all(|c| *c > 250);
        picture.pixels().filter(|p| !is_white(p)).count()
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
        log.file_starts(ticket);
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

/// The built-in head has a bone of its own: the new one stays apart, and Escape leaves it unmade.
#[test]
fn a_tissue_is_named_apart_and_left_by_escape() {
    let json = r#"{ "fabrica": 1, "subject": { "builtin": "head" } }"#;
    let mut window = Window::open(DESK, json);
    let before = window.document().to_json();
    window.click("Panel: Tissues");
    window.look("head_tissues");
    window.click("Make a tissue");
    window.settle();
    window.look("head_making");
    assert_eq!(window.recipes()[0].name, "bone 2");
    for name in ["Show bone alone", "Bone 2"] {
        window.harness.get_by_label(name);
    }
    // A name that is there already is not taken over.
    let typed = |window: &mut Window, text: &str| {
        window
            .harness
            .get_by_role_and_label(Role::TextInput, "Name")
            .focus();
        window.steps(2);
        window.press_with(Modifiers::COMMAND, Key::A);
        window
            .harness
            .get_by_role_and_label(Role::TextInput, "Name")
            .type_text(text);
        window.steps(2);
    };
    typed(&mut window, "Skin");
    window.look("head_naming");
    window.harness.get_by_label_contains("becomes “Skin 2”");
    window.press(Key::Enter);
    window.settle();
    assert_eq!(window.recipes()[0].name, "Skin 2");
    typed(&mut window, "mandible");
    window.press(Key::Escape);
    window.settle();
    assert_eq!(window.recipes()[0].name, "Skin 2", "the field is left");
    window.press(Key::Escape);
    window.settle();
    assert_eq!(window.document().to_json(), before, "it is not made");
}

/// The list takes what the panel has; a name that is clicked is shown for a moment.
#[test]
fn the_list_uses_the_panel_and_names_can_be_clicked() {
    let json = r#"{ "fabrica": 1, "subject": { "builtin": "head" } }"#;
    let mut window = Window::open(DESK, json);
    window.click("Panel: Tissues");
    window.steps(3);
    let last = window.harness.get_by_label("Shape it as clay").rect();
    let gap = DESK.y - last.bottom();
    assert!(
        (0.0..40.0).contains(&gap),
        "the list ends at the buttons, the last of which ends {gap} above the end"
    );
    let before = window.drawn();
    window.click("Bone");
    let mut bone = before;
    let patience = clock() + 60.0;
    while bone >= before * 9 / 10 && clock() < patience {
        window.steps(1);
        bone = window.drawn();
    }
    let name = window.harness.get_by_label("Bone");
    assert_eq!(
        name.accesskit_node().toggled(),
        Some(egui::accesskit::Toggled::True)
    );
    window.look("head_glimpse");
    assert!(bone < before * 9 / 10, "{bone} of {before}: the bone alone");
    // It goes on until the bone is drawn, then for a second.
    let mut after = bone;
    while after.abs_diff(before) >= before / 100 && clock() < patience {
        window.settle();
        after = window.drawn();
    }
    assert!(
        after.abs_diff(before) < before / 100,
        "{after} of {before}: everything again"
    );
}

/// The head from behind, with a label at the back of it.
const FROM_BEHIND: &str = r#"{ "fabrica": 1, "subject": { "builtin": "head" }, "camera": { "rotate": [0, 0, 1, 0] },
    "labels": [ { "text": "Vía occipital", "at": [0.02, -0.38, 0.1] } ] }"#;

/// Right, up and backward of the camera as it stands.
fn backward(window: &Window) -> glam::Vec3 {
    window.document().illustration().camera.rotate * glam::Vec3::Y
}

/// In one frame as in many, and whatever else the letters do as keys.
#[test]
fn a_structure_is_found_by_its_name_and_turned_to() {
    let mut window = Window::open(DESK, FROM_BEHIND);
    assert!(backward(&window).y < -0.99, "from behind");
    let word = [(Key::F, "f"), (Key::E, "e"), (Key::Y, "y"), (Key::E, "e")];
    for (key, letter) in word {
        let event = egui::Event::Key {
            key,
            physical_key: None,
            pressed: true,
            repeat: false,
            modifiers: Modifiers::NONE,
        };
        let text = egui::Event::Text(letter.to_owned());
        window.harness.input_mut().events.extend([event, text]);
    }
    window.steps(3);
    let field = |window: &Window| {
        let field = window
            .harness
            .get_by_role_and_label(Role::TextInput, "Search tissues and labels");
        field.value()
    };
    assert_eq!(field(&window).as_deref(), Some("eye"));
    assert!(window.harness.query_by_label("Bone").is_none(), "not found");
    window.look("seek_eyes_typed");
    window.press(Key::Enter);
    window.steps(20);
    window.look("seek_eyes_glimpse");
    let eyes = window.harness.get_by_label("Eyes");
    let is_chosen = eyes.accesskit_node().toggled();
    assert_eq!(is_chosen, Some(egui::accesskit::Toggled::True));
    window.settle();
    window.settle();
    let back = backward(&window);
    assert!(back.y > 0.7, "from the front: {back}");
    window.look("seek_eyes");

    // A label, without its accent, and by a click.
    window.click("Clear the search for tissues");
    window.press_with(Modifiers::COMMAND, Key::F);
    window
        .harness
        .event(egui::Event::Text("via occ".to_owned()));
    window.steps(3);
    window.look("seek_label_typed");
    // The label's text stands in the picture too.
    let rows = window
        .harness
        .get_all_by_role_and_label(Role::Button, "Vía occipital");
    rows.last().expect("a row").click();
    window.steps(30);
    window.settle();
    let back = backward(&window);
    assert!(back.y < -0.9, "from behind: {back}");
    window.look("seek_label");
    window.press(Key::F);
    window.harness.event(egui::Event::Text(" xyz".to_owned()));
    window.steps(3);
    window
        .harness
        .get_by_label("No tissue and no label is called that");
}

#[test]
fn a_phone_has_the_search_for_structures() {
    let mut window = Window::open(vec2(390.0, 844.0), FROM_BEHIND);
    window.click("Tissues");
    let field = window.harness.get_by_label("Search tissues and labels");
    field.focus();
    window.steps(2);
    window.harness.event(egui::Event::Text("tongue".to_owned()));
    window.steps(3);
    window.click("Tongue");
    window.steps(30);
    window.look("seek_phone");
    let back = backward(&window);
    assert!(back.y > 0.5, "from the front: {back}");
    window.click("Clear the search for tissues");
    window.harness.get_by_label("Bone");
}

/// While a tissue is found the picture is what it was, and the search can be stopped and goes on when that is wanted.
#[test]
fn finding_a_tissue_can_be_stopped() {
    const SMALL: Vec2 = Vec2::new(780.0, 640.0);
    let mut window = Window::open(SMALL, CUBE);
    window.drop_large_cube();
    window.click("Panel: Tissues");
    window.settle();
    let before = window.drawn();
    window.click("Make a tissue");
    window.look("finding");
    assert!(window.drawn() > before / 2, "the old picture stays");
    window.harness.get_by_label_contains("provisional");
    window.click("Stop");
    window.settle();
    window.look("stopped");
    window.harness.get_by_label_contains("Stopped");
    assert!(window.drawn() > before / 2, "as it was");
    window.click("Go on");
    window.settle();
    assert!(window.harness.query_by_label_contains("Stopped").is_none());
    assert!(
        window
            .harness
            .query_by_label_contains("provisional")
            .is_none()
    );
    window.look("found");
}

/// While the lowest value is dragged, what the range takes is seen at once, in the slices and in the picture; the
/// tissue follows.
#[test]
fn a_range_is_seen_while_it_is_dragged() {
    const PANES: [&str; 2] = ["Axial slice", "Picture of "];
    let mut window = Window::open(FOUR, CUBE);
    window.drop_large_cube();
    window.press(Key::V);
    window.click("Panel: Tissues");
    window.click("Make a tissue");
    window.settle();
    let pane = |window: &mut Window, name: &str| {
        let images = window.harness.get_all_by_role(Role::Image);
        let named = |node: &egui_kittest::Node<'_>| {
            let label = node.accesskit_node().label();
            label.is_some_and(|label| label.starts_with(name))
        };
        let rect = images.into_iter().find(named).expect("a pane").rect();
        window.pixels(rect)
    };
    let differ = |a: &image::RgbaImage, b: &image::RgbaImage| {
        let pairs = a.pixels().zip(b.pixels());
        let is_other = |(a, b): &(&image::Rgba<u8>, &image::Rgba<u8>)| {
            a.0.iter().zip(&b.0).any(|(a, b)| a.abs_diff(*b) > 40)
        };
        pairs.filter(is_other).count()
    };
    let assert_changed = |earlier: &[image::RgbaImage; 2],
                          later: &[image::RgbaImage; 2],
                          what: &str| {
        for (name, (earlier, later)) in ["slice", "picture"].iter().zip(earlier.iter().zip(later)) {
            let changed = differ(earlier, later);
            assert!(changed > 400, "{changed} pixels of the {name} {what}");
        }
    };
    let before = PANES.map(|name| pane(&mut window, name));
    window.look("range_before");
    let slider = window
        .harness
        .get_by_role_and_label(Role::Slider, "Lowest slider")
        .rect();
    let range = window.recipes()[0].from.range();
    let at = |part: f32| pos2(slider.left() + part * slider.width(), slider.center().y);
    window.harness.hover_at(at(0.5));
    window.harness.step();
    window.harness.drag_at(at(0.5));
    window.harness.step();
    window.harness.hover_at(at(0.45));
    window.steps(3);
    assert_ne!(window.recipes()[0].from.range(), range, "it is dragged");
    window.harness.get_by_label_contains("provisional");
    let during = PANES.map(|name| pane(&mut window, name));
    window.look("range_dragged");
    assert_changed(&before, &during, "show the range");
    window.harness.get_by_label_contains("provisional");
    // Another value, other pixels, still before any tissue is found.
    window.harness.hover_at(at(0.97));
    window.steps(3);
    window.harness.get_by_label_contains("provisional");
    let later = PANES.map(|name| pane(&mut window, name));
    window.look("range_dragged_on");
    assert_changed(&during, &later, "follow the hand");
    window.harness.drop_at(at(0.97));
    window.settle();
    window.look("range_found");
    let is_open = window.harness.query_by_label_contains("provisional");
    assert!(is_open.is_none(), "the tissue is found");
    let accent = |image: &image::RgbaImage| {
        let is_tinted =
            |p: &&image::Rgba<u8>| p[2] > p[0].saturating_add(30) && p[1].abs_diff(p[2]) < 25;
        image.pixels().filter(is_tinted).count()
    };
    let after = pane(&mut window, "Axial slice");
    assert!(
        accent(&during[0]) > 400,
        "the slice is tinted: {}",
        accent(&during[0])
    );
    assert!(
        accent(&after) < 100,
        "and is not any more: {}",
        accent(&after)
    );
}

/// What lies inside of the skull is offered to whoever keeps the bone.
#[test]
fn what_lies_inside_is_kept_too() {
    let json = r#"{ "fabrica": 1, "templates": [ { "kind": "peel", "at": [0.02,0.24,0.2],
        "rotate": [0,0.7071,0.7071,0], "size": [0.36,0.3,0.2], "params": { "progress": 0.6 } } ] }"#;
    let mut window = Window::open(DESK, json);
    window.press(Key::N);
    window.click("Keep in place: Tissue");
    window.settle();
    let keeps = |window: &Window| match &window.document().illustration().templates[0].align {
        Align::Segment { keep, .. } => keep.clone(),
        other => panic!("{other:?}"),
    };
    assert_eq!(keeps(&window), ["bone"]);
    window.look("inside_offered");
    window.click("Also keep what lies inside");
    window.settle();
    window.look("inside_kept");
    let kept = keeps(&window);
    for name in ["bone", "brain", "cerebellum"] {
        assert!(kept.iter().any(|n| n == name), "{name}: {kept:?}");
    }
    assert!(kept.iter().all(|n| n != "skin"), "{kept:?}");
    let offer = window.harness.query_by_label("Also keep what lies inside");
    assert!(offer.is_none(), "nothing is left inside");
    window.press_with(Modifiers::COMMAND, Key::Z);
    assert_eq!(keeps(&window), ["bone"], "one step of undo");
}

/// Volume of the tissue that is open, cubic centimetres, as the panel tells it.
fn told_volume(window: &Window) -> f32 {
    let Some(node) = window.harness.query_by_label_contains("cm³") else {
        window.harness.get_by_label("nothing found");
        return 0.0;
    };
    let node = node.accesskit_node();
    let text = node.value().or(node.label()).unwrap_or_default();
    let number = text.split(' ').next().unwrap_or_default();
    number.parse().expect("a volume")
}

fn slice_of(window: &Window, name: &str) -> egui::Rect {
    let label = format!("{name} slice");
    let node = window.harness.get_by_role_and_label(Role::Image, &label);
    node.rect()
}

#[test]
fn a_tissue_is_painted_in_the_picture_and_in_slices() {
    let mut window = Window::open(FOUR, CUBE);
    window.click("Panel: Tissues");
    window.click("Paint a tissue");
    window.settle();
    let made = window.document().to_json();
    assert_eq!(window.recipes()[0].from, RecipeSource::Nothing);
    assert_eq!(told_volume(&window), 0.0);
    let strokes = |window: &Window| window.recipes()[0].paint.clone();
    // In the picture, over its surface; the object does not turn meanwhile.
    let camera = window.document().illustration().camera;
    let center = window.picture_center();
    window.drag(center - vec2(50.0, 0.0), vec2(100.0, 30.0));
    window.look("paint_picture");
    let [stroke] = &strokes(&window)[..] else {
        panic!("one drag, one stroke: {:?}", strokes(&window));
    };
    assert!(!stroke.erases && stroke.places.len() >= 2, "{stroke:?}");
    assert_eq!(window.document().illustration().camera, camera);
    let in_picture = told_volume(&window);
    assert!(in_picture > 0.0);
    // In a slice, from the middle to the right.
    window.press(Key::V);
    window.settle();
    let axial = slice_of(&window, "Axial");
    window.drag(axial.center(), vec2(40.0, 10.0));
    let painted = strokes(&window);
    assert_eq!(painted.len(), 2);
    assert_eq!(painted[1].places[0], glam::IVec3::ZERO, "the middle");
    let in_slice = told_volume(&window);
    assert!(in_slice > in_picture, "{in_slice}, not {in_picture}");
    window.harness.hover_at(axial.center() - vec2(30.0, 20.0));
    window.settle();
    window.look("paint_slices");
    // The ball and its keys; what the last drag has painted is taken away again.
    window.press(Key::CloseBracket);
    window.press(Key::CloseBracket);
    window.click("Erase");
    window.drag(axial.center(), vec2(40.0, 10.0));
    let erased = strokes(&window);
    assert!(erased.len() == 3 && erased[2].erases, "{erased:?}");
    assert!(erased[2].radius_mm > erased[1].radius_mm, "{erased:?}");
    let left = told_volume(&window);
    assert!(left < in_slice, "{left}, not {in_slice}");
    window.harness.hover_at(axial.center() - vec2(30.0, 20.0));
    window.settle();
    window.look("paint_erased");
    window.harness.get_by_label("Strokes: 3");
    // Each drag is one step of undo.
    for volume in [in_slice, in_picture, 0.0] {
        window.press_with(Modifiers::COMMAND, Key::Z);
        window.settle();
        assert_eq!(told_volume(&window), volume);
    }
    assert_eq!(window.document().to_json(), made);
    window.press_with(Modifiers::COMMAND | Modifiers::SHIFT, Key::Z);
    window.settle();
    assert_eq!(told_volume(&window), in_picture);
    // Without the ball a drag is what it was.
    window.press(Key::Escape);
    window.drag(axial.center(), vec2(20.0, 0.0));
    assert_eq!(strokes(&window).len(), 1);
}

/// Where the object is opened, the ball paints the tissue that is seen under it, which lies elsewhere at rest, and in
/// the gap nothing.
#[test]
fn painting_in_an_opened_object_paints_its_tissue() {
    let mut window = Window::open(
        FOUR,
        r#"{ "fabrica": 1, "subject": { "builtin": "cube", "features": [ { "name": "mine", "paint": [] } ] },
            "templates": [ { "kind": "split", "params": { "amount": 0.3 } } ] }"#,
    );
    window.click("Panel: Tissues");
    window.click("Edit mine");
    window.click("Paint");
    window.press(Key::V);
    window.settle();
    let axial = slice_of(&window, "Axial");
    window.drag(axial.center(), vec2(6.0, 0.0));
    window.look("paint_gap");
    assert!(window.recipes()[0].paint.is_empty(), "there is nothing");
    let spot = axial.center() + vec2(0.25 * axial.size().min_elem(), 0.0);
    window.harness.hover_at(spot);
    window.settle();
    // As the slice tells the place of what is seen, mm.
    let node = window.harness.get_by_label_contains("mm · value");
    let node = node.accesskit_node();
    let text = node.value().or(node.label()).unwrap_or_default();
    let x = text.split(',').next().unwrap_or_default();
    let seen: f32 = x.replace('\u{2212}', "-").parse().expect("a number");
    window.drag(spot, vec2(0.0, 6.0));
    window.look("paint_open");
    // The cube is 100 mm wide.
    let at_rest = window.recipes()[0].paint[0].places[0].x as f32 / 10.0;
    assert!(
        seen.abs() - at_rest.abs() > 3.0,
        "{at_rest} mm at rest, {seen} mm where it is seen"
    );
}

/// What a finger does, as the window tells it: the first finger is the pointer too.
fn finger(window: &mut Window, id: u64, phase: egui::TouchPhase, pos: Pos2) {
    window.harness.event(egui::Event::Touch {
        device_id: egui::TouchDeviceId(1),
        id: egui::TouchId(id),
        phase,
        pos,
        force: None,
    });
    if id == 1 {
        let button = |pressed| egui::Event::PointerButton {
            pos,
            button: egui::PointerButton::Primary,
            pressed,
            modifiers: Modifiers::NONE,
        };
        window.harness.event(egui::Event::PointerMoved(pos));
        match phase {
            egui::TouchPhase::Start => window.harness.event(button(true)),
            egui::TouchPhase::Move => {}
            egui::TouchPhase::End | egui::TouchPhase::Cancel => {
                window.harness.event(button(false));
                window.harness.event(egui::Event::PointerGone);
            }
        }
    }
    window.harness.step();
}

/// On a phone one finger paints and two move; Shift turns painting into erasing where there is a keyboard.
#[test]
fn a_finger_paints_and_two_fingers_move() {
    use egui::TouchPhase::{End, Move, Start};
    let mut window = Window::open(vec2(390.0, 844.0), CUBE);
    window.click("Tissues");
    window.steps(5);
    window.click("Paint a tissue");
    window.settle();
    let strokes = |window: &Window| window.recipes()[0].paint.len();
    let camera = |window: &Window| window.document().illustration().camera;
    let (home, center) = (camera(&window), window.picture_center());
    finger(&mut window, 1, Start, center);
    for i in 1..=8 {
        finger(&mut window, 1, Move, center + vec2(6.0 * i as f32, 0.0));
    }
    window.look("paint_phone");
    finger(&mut window, 1, End, center + vec2(48.0, 0.0));
    window.settle();
    assert_eq!(
        (strokes(&window), camera(&window)),
        (1, home),
        "one finger paints"
    );
    // Apart: closer. The finger that stays longer does not paint either.
    let by = vec2(30.0, 0.0);
    finger(&mut window, 1, Start, center - by);
    finger(&mut window, 2, Start, center + by);
    for i in 1..=6 {
        let by = by * (1.0 + 0.2 * i as f32);
        finger(&mut window, 1, Move, center - by);
        finger(&mut window, 2, Move, center + by);
    }
    finger(&mut window, 2, End, center + 2.2 * by);
    for i in 1..=6 {
        let down = vec2(0.0, 8.0 * i as f32);
        finger(&mut window, 1, Move, center - 2.2 * by + down);
    }
    finger(&mut window, 1, End, center - 2.2 * by + vec2(0.0, 48.0));
    window.settle();
    assert_eq!(strokes(&window), 1, "two fingers paint nothing");
    assert!(camera(&window).distance < home.distance, "they move");
    // Shift, in the picture.
    window
        .harness
        .event(egui::Event::ModifiersChanged(Modifiers::SHIFT));
    window.drag(center, vec2(40.0, 0.0));
    window
        .harness
        .event(egui::Event::ModifiersChanged(Modifiers::NONE));
    let paint = window.recipes()[0].paint.clone();
    let erases: Vec<bool> = paint.iter().map(|stroke| stroke.erases).collect();
    assert_eq!(erases, [false, true]);
    window.click("Put the ball away (Esc)");
    window.settle();
    let bar = window.harness.query_by_label("Put the ball away (Esc)");
    assert!(bar.is_none(), "the bar goes with it");
}

/// The ball on the head, to be looked at: over the skin, and in slices while the hand is on its way.
#[test]
#[ignore = "only drawn to be looked at: cargo xtask look"]
fn painting_on_the_head_to_look_at() {
    let json = r#"{ "fabrica": 1, "subject": { "builtin": "head" } }"#;
    let mut window = Window::open(DESK, json);
    window.click("Panel: Tissues");
    window.click("Paint a tissue");
    window.settle();
    let center = window.picture_center();
    window.drag_on(center - vec2(90.0, 60.0), vec2(180.0, 40.0), 24);
    window.look("paint_head_under_way");
    window.harness.drop_at(center + vec2(90.0, -20.0));
    window.settle();
    window.look("paint_head");
    window.press(Key::V);
    window.settle();
    let axial = slice_of(&window, "Axial");
    window.drag_on(axial.center() - vec2(60.0, 20.0), vec2(120.0, 60.0), 24);
    window.look("paint_head_slice_under_way");
    window.harness.drop_at(axial.center() + vec2(60.0, 40.0));
    window.settle();
    window.look("paint_head_slices");
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
        log.file_starts(ticket);
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
    // It is not at rest before it has what it waits for.
    let log = Fake::default();
    log.0.borrow_mut().is_slow = true;
    let mut window = Window::open_with(SMALL, egui::Theme::Light, log, Some(&json));
    dropped(&mut window, true, &[]);
    let asks = |window: &Window| {
        let all = window
            .harness
            .query_all_by_label_contains("needs a label file");
        all.count() > 0
    };
    for _ in 0..100 {
        window.steps(1);
        if asks(&window) {
            break;
        }
    }
    assert!(asks(&window), "it is asked for");
    window.log.0.borrow_mut().is_slow = false;
    dropped(&mut window, false, &[("aa", 10)]);
    window.settle();
    assert!(!asks(&window), "it is there");
    assert_eq!(window.document().to_json(), json, "as it was");
}
