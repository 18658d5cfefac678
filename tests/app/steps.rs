//! Steps: recorded by clicks, walked, scrubbed and interrupted, seen in the strip under the picture.

use super::*;
use egui::Rect;
use fabrica::app::{Command, StepCommand};
use fabrica::data::{Subject, VolumeBuilder};
use fabrica::render::{Gpu, GpuOptions, Image, Studio, decode_png};

/// Small, since lavapipe draws every frame of a passage.
const SMALL: Vec2 = Vec2::new(790.0, 720.0);
const PHONE: Vec2 = Vec2::new(390.0, 844.0);

/// Frames of a passage of a second, with those of [`Window::settle`], and some more.
const PASSAGE: usize = 24;

const LESSON: &str = r##"{ "fabrica": 1, "title": "The way in", "subject": { "builtin": "cube" },
    "templates": [{ "kind": "peel", "at": [0, 0, 0.25] }],
    "steps": [{ "title": "Incision", "seconds": 0.1, "notes": "Ask what lies below.", "set": { "/templates/0/params/progress": 0.9 } },
        { "title": "From above", "seconds": 0.1, "set": { "/camera/rotate": [0, 0.7071, 0.7071, 0] } },
        { "title": "Dark", "seconds": 0.1, "set": { "/look/background": "#262b30" } },
        { "seconds": 0.1, "set": { "/templates/0/enabled": false } }] }"##;

impl Window {
    /// The picture as it is shown, drawn for a file of the size in the window.
    fn shown_picture(&mut self) -> Image {
        self.settle();
        let before = self.log.0.borrow().saved.len();
        self.harness.state_mut().ask_for_picture();
        let patience = clock() + 60.0;
        while self.log.0.borrow().saved.len() == before && clock() < patience {
            self.harness.step();
        }
        let log = self.log.0.borrow();
        decode_png(&log.saved.last().expect("a picture").bytes).expect("a PNG")
    }

    fn shown_step(&self) -> usize {
        self.harness.state().step()
    }

    fn rect_of_step(&self, name: &str) -> Rect {
        self.harness.get_by_label(name).rect()
    }

    /// The small picture of a step.
    pub(crate) fn step_picture(&mut self, name: &str) -> image::RgbaImage {
        let rect = self.rect_of_step(name);
        self.pixels(rect.shrink(8.0).with_max_y(rect.max.y - 18.0))
    }
}

/// Draws the steps of a document as the command line does.
struct Outside(Studio);

impl Outside {
    fn new() -> Self {
        let gpu = pollster::block_on(Gpu::open(&GpuOptions::default()));
        let mut cube = VolumeBuilder::new();
        fabrica::subjects::generate("cube", RESOLUTION, &mut cube).expect("a cube");
        let subject = Subject::from(cube.finish().expect("a whole volume"));
        Self(Studio::new(&gpu.expect("an adapter"), &subject, true).expect("it fits"))
    }

    fn picture(&self, document: &Document, step: usize, size: [u32; 2]) -> Image {
        let state = document.at_step(step).expect("a step");
        let drawing = self.0.render_image(state.illustration(), size, 4);
        pollster::block_on(drawing).expect("a picture")
    }
}

/// Part of the pixels that differ by more than three levels.
fn difference(one: &Image, other: &Image) -> f32 {
    assert_eq!(one.size, other.size);
    let pixels = one.rgba.chunks_exact(4).zip(other.rgba.chunks_exact(4));
    let differs = |(a, b): &(&[u8], &[u8])| a.iter().zip(*b).any(|(a, b)| a.abs_diff(*b) > 3);
    let count = pixels.filter(differs).count();
    count as f32 / (one.size[0] * one.size[1]) as f32
}

/// Six steps recorded by clicks, a template and a label added at the third; wherever one comes from, the window rests
/// at the picture that the command line draws of the step.
#[test]
fn a_lesson_is_recorded_by_clicks_and_rests_at_its_steps() {
    let mut window = Window::open(SMALL, CUBE);
    window.place_peel();
    window.click("Panel: Text");
    window.click("Add step");
    assert_eq!(window.shown_step(), 1);
    window.click("Panel: Look");
    window.click("Background: Paper");
    window.click("Add step");
    window.click("View: Left");
    window.settle();
    window.click("Take the present view");
    window.click("Add step");
    let center = window.picture_center();
    window.click("Place hole");
    window.click_at(center + vec2(20.0, 10.0));
    window.click("Panel: Text");
    window.click("Add a label");
    window.click_at(center - vec2(20.0, 20.0));
    window.click("Add step");
    window.click("Panel: Look");
    window.click("Background: Slate");
    window.click("Add step");
    window.click("Panel: Templates");
    window.click("2. Hole");
    window.click("Delete template");
    window.click("Add step");
    window.click("View: Front");
    window.settle();
    window.click("Take the present view");
    window.settle();
    window.look("steps_recorded");
    let document = window.document();
    assert_eq!((document.step_count(), window.shown_step()), (6, 6));
    let states: Vec<Document> = (0..=6)
        .map(|n| document.at_step(n).expect("a step"))
        .collect();
    let count = |step: usize| {
        let state = states[step].illustration();
        let templates = state.templates.iter().filter(|t| t.enabled).count();
        [
            templates,
            state.captions.iter().filter(|c| c.enabled).count(),
        ]
    };
    let counts: Vec<[usize; 2]> = (0..=6).map(count).collect();
    assert_eq!(
        counts,
        [[1, 0], [1, 0], [1, 0], [2, 1], [2, 1], [1, 1], [1, 1]]
    );

    let outside = Outside::new();
    let size = window.shown_picture().size;
    let pictures: Vec<Image> = (0..=6)
        .map(|n| outside.picture(&document, n, size))
        .collect();
    for (step, pair) in pictures.windows(2).enumerate() {
        assert!(
            difference(&pair[0], &pair[1]) > 0.01,
            "step {} looks like the one before",
            step + 1
        );
    }
    let rests_at = |window: &mut Window, step: usize, how: &str| {
        assert_eq!(window.shown_step(), step, "{how}");
        let off = difference(&window.shown_picture(), &pictures[step]);
        assert!(
            off < 0.001,
            "{how}: {off} of the pixels at step {step} differ"
        );
    };
    rests_at(&mut window, 6, "recorded");
    window.click("Step 4");
    rests_at(&mut window, 4, "by the strip");
    for step in (3..4).rev() {
        window.click("Step before");
        window.steps(PASSAGE);
        rests_at(&mut window, step, "back");
    }
    for step in 4..=6 {
        window.click("Next step");
        window.steps(PASSAGE);
        rests_at(&mut window, step, "forward");
    }
    // Each passage is interrupted: turned round in its middle, and round again.
    for step in (0..6).rev() {
        window.click("Step before");
        window.steps(12);
        window.click("Next step");
        window.steps(5);
        window.click("Step before");
        window.steps(PASSAGE);
        rests_at(&mut window, step, "interrupted");
    }
    // To a place between two steps, and on from there.
    let command = Command::Step(StepCommand::Scrub(1.5));
    window.harness.state_mut().run(command);
    let between = window.shown_picture();
    assert!(
        pictures
            .iter()
            .all(|step| difference(&between, step) > 0.001)
    );
    let step = window.shown_step();
    window.click("Next step");
    window.steps(PASSAGE);
    rests_at(&mut window, step, "scrubbed");
    // Opened at a step by its link.
    let link = window
        .log
        .0
        .borrow()
        .links
        .last()
        .expect("a link")
        .0
        .clone();
    assert!(link.ends_with(&format!("&step={step}")), "{link}");
    let mut other = Window::open(SMALL, &link);
    rests_at(&mut other, step, "opened");
}

/// The strip shows a picture of each step, walks by the keyboard, orders by dragging, and is away where there is no
/// room.
#[test]
fn the_strip_walks_and_orders_the_steps() {
    let titles = |window: &Window| -> Vec<String> {
        let document = window.document();
        let steps = document.illustration().steps.iter();
        steps.map(|step| step.title.clone()).collect()
    };
    let mut window = Window::open(DESK, LESSON);
    window.look("strip");
    let first = window.rect_of_step("Step 1: Incision").center();
    window.click_at(first);
    assert_eq!(window.shown_step(), 1);
    // The arrows walk on from there.
    window.press(Key::ArrowRight);
    window.settle();
    assert_eq!(window.shown_step(), 2);
    window.press(Key::ArrowLeft);
    window.press(Key::ArrowLeft);
    window.settle();
    assert_eq!(window.shown_step(), 0);
    // With a modifier they take the step along.
    let second = window.rect_of_step("Step 2: From above").center();
    window.click_at(second);
    window.press_with(Modifiers::COMMAND, Key::ArrowRight);
    window.settle();
    assert_eq!(titles(&window), ["Incision", "Dark", "From above", ""]);
    assert_eq!(window.shown_step(), 3);
    window.press_with(Modifiers::COMMAND, Key::Z);
    window.settle();
    assert_eq!(titles(&window), ["Incision", "From above", "Dark", ""]);
    // By hand: the first behind the third.
    let from = window.rect_of_step("Step 1: Incision").center();
    let to = window.rect_of_step("Step 3: Dark").center() + vec2(20.0, 0.0);
    window.drag(from, to - from);
    assert_eq!(titles(&window), ["From above", "Dark", "Incision", ""]);
    window.look("strip_ordered");
    // The slider goes to any place of the lesson: under 0.6 of its way lies the passage to the third step.
    let slider = window.rect_of_step("Place in the lesson");
    window.click_at(slider.lerp_inside(vec2(0.6, 0.5)));
    assert_eq!(window.shown_step(), 3, "{slider}");
    window.press(Key::P);
    window.settle();
    assert!(
        window.harness.query_by_label("Step 3: Incision").is_none(),
        "the picture is alone"
    );
}

#[test]
fn the_strip_scrolls_on_a_phone_and_makes_room_for_drawers() {
    let mut window = Window::open(PHONE, LESSON);
    window.look("strip_phone");
    let last = window.rect_of_step("Step 4");
    window.click("Next step");
    window.settle();
    assert_eq!(window.shown_step(), 1);
    for _ in 0..3 {
        window.click("Next step");
        window.settle();
    }
    window.look("strip_phone_last");
    let scrolled = window.rect_of_step("Step 4");
    assert!(
        scrolled.left() < last.left() && scrolled.right() <= PHONE.x,
        "{scrolled}, was {last}"
    );
    window.click("Text");
    window.settle();
    window.look("strip_phone_drawer");
    assert!(
        window.harness.query_by_label("Delete the step").is_none(),
        "the drawer has its place"
    );
    window.harness.get_by_label("Title of the step");
}

/// On a phone the bar of a lesson lies under the picture, which stays as high as it is from step to step, and messages
/// beside the buttons of the picture.
#[test]
fn on_a_phone_nothing_lies_over_the_object() {
    let legend = "A long legend of several lines, such as a lesson has. ".repeat(4);
    let with_legend = LESSON.replace(
        r#""title": "Incision","#,
        &format!(r#""title": "Incision", "caption": "{legend}","#),
    );
    let mut window = Window::open(PHONE, &with_legend);
    window.settle();
    let picture = |window: &Window| window.harness.get_by_role(Role::Image).rect();
    let start = picture(&window);
    assert!(start.height() > 300.0, "{start}");
    for step in 1..=2 {
        window.click("Next step");
        window.settle();
        window.look(&format!("phone_step_{step}"));
        assert_eq!(picture(&window), start, "step {step}");
        let bar = window.harness.get_by_label("Next step").rect();
        assert!(start.bottom() <= bar.top(), "{start} {bar}");
    }
    let text = "{ cut off".to_owned();
    window
        .log
        .0
        .borrow_mut()
        .queue
        .push(Message::OpenText { text });
    window.steps(3);
    window.look("phone_message");
    let message = window.harness.get_by_label("Dismiss").rect();
    for name in ["Standard views", "Compare with the original"] {
        let button = window.harness.get_by_label(name).rect();
        assert!(
            message.right() <= button.left(),
            "{name}: {message} {button}"
        );
    }
    let ball = window.harness.get_by_label("Back to the first view").rect();
    assert!(message.bottom() <= ball.top(), "{message} {ball}");
}

/// What is told about a step has fields of its own, each change of which is undone by itself.
#[test]
fn a_step_is_named_timed_and_noted() {
    let mut window = Window::open(DESK, LESSON);
    window.click("Panel: Text");
    window.harness.run_steps(2);
    assert!(
        window.harness.query_by_label("Title of the step").is_none(),
        "the start has none"
    );
    window.click("Next step");
    window.settle();
    window.look("step_fields");
    let note = window.harness.get_by_label("Notes for the teacher");
    assert_eq!(
        note.accesskit_node().value().as_deref(),
        Some("Ask what lies below.")
    );
    window.harness.get_by_label("Title of the step").focus();
    window.steps(2);
    window.press(Key::End);
    window
        .harness
        .event(egui::Event::Text(" of the skin".to_owned()));
    window.steps(3);
    let title = |window: &Window| window.document().illustration().steps[0].title.clone();
    assert_eq!(title(&window), "Incision of the skin");
    assert_eq!(window.shown_step(), 1);
    window.press(Key::Escape);
    window.harness.state_mut().run(Command::Undo);
    window.settle();
    assert_eq!(title(&window), "Incision");
    // A label that is switched off is not drawn.
    window.click("Add a label");
    let at = window.picture_center() + vec2(40.0, -30.0);
    window.click_at(at);
    let in_picture = |window: &Window| {
        let texts = window
            .harness
            .query_all_by_role_and_label(Role::Label, "Middle");
        texts.count()
    };
    assert_eq!(in_picture(&window), 1);
    window.click("Hide the label: Middle");
    window.settle();
    assert_eq!(in_picture(&window), 0);
    window.click("Show the label: Middle");
    window.settle();
    assert_eq!(in_picture(&window), 1);
    window.click("Step before");
    window.settle();
    window.steps(20);
    assert_eq!(in_picture(&window), 0, "it was added at the first step");
}
