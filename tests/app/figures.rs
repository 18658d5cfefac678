//! Figures: drawings and pictures that are bent, seen flat.

use super::*;
use fabrica::app::session::figure::{FigureCommand, Overlay, figure_edit};
use fabrica::app::{Command, See};
use fabrica::document::FIGURE_FRONT;

/// An arm whose hand is turned by a step.
const ARM: &str = r#"{ "fabrica": 1, "subject": { "builtin": "drawn-arm" },
    "figure": { "detail": 1500, "handles": [{ "region": "humerus" }, { "region": "hand", "move": [0, 0] }] },
    "labels": [{ "at": [0.3, 0.05, 0], "text": "Somewhere" }],
    "steps": [{ "set": { "/figure/handles/1/move": [0.05, 0.12] }, "seconds": 1 }] }"#;

impl Window {
    /// The picture in the middle, without what floats over its edges.
    fn middle(&mut self) -> image::RgbaImage {
        let center = self.picture_center();
        self.pixels(egui::Rect::from_center_size(center, vec2(300.0, 260.0)))
    }
}

/// How many pixels are of another colour than the one in the corner.
pub(crate) fn drawn(picture: &image::RgbaImage) -> usize {
    let ground = picture.get_pixel(0, 0);
    picture.pixels().filter(|pixel| *pixel != ground).count()
}

pub(crate) fn apart(a: &image::RgbaImage, b: &image::RgbaImage) -> usize {
    let pairs = a.pixels().zip(b.pixels());
    pairs.filter(|(a, b)| a != b).count()
}

#[test]
fn a_figure_is_drawn_and_moved_but_never_turned_away() {
    let mut window = Window::open(DESK, ARM);
    window.look("figure");
    let before = window.middle();
    assert!(drawn(&before) > before.pixels().len() / 20, "it is drawn");
    let center = window.picture_center();
    let seen = |window: &Window| window.document().illustration().camera;
    let front = seen(&window);
    assert_eq!(front.rotate, FIGURE_FRONT);
    window.drag(center, vec2(60.0, 20.0));
    let moved = seen(&window);
    assert!(moved.rotate.dot(front.rotate).abs() > 0.999_99, "{moved:?}");
    let by = moved.target - front.target;
    assert!(by.x < -0.01 && by.y > 0.005 && by.z.abs() < 1e-5, "{by}");
    assert!(apart(&before, &window.middle()) > 100, "it has moved");
    // Keys that turn others move it; what only subjects in space have does nothing.
    window.run_command(Command::Orbit(0.3, 0.0));
    for view in fabrica::app::StandardView::ALL {
        window.run_command(Command::View(view));
    }
    window.run_command(Command::See(See::ToggleSlices));
    window.run_command(Command::See(See::ToggleGhost));
    window.settle();
    let after = seen(&window);
    assert!(after.rotate.dot(front.rotate).abs() > 0.999_99, "{after:?}");
    assert!(after.target.x < moved.target.x, "moved to the right");
    // In the place of templates stand the tools of a figure.
    assert!(window.harness.query_by_label("Outline").is_some());
    assert!(window.harness.query_by_label("Peel").is_none());
    for panel in [
        "Panel: Tissues",
        "Panel: Look",
        "Panel: Text",
        "Panel: Figure",
    ] {
        window.click(panel);
        window.settle();
    }
}

#[test]
fn a_step_bends_it_from_frame_to_frame() {
    let mut window = Window::open(DESK, ARM);
    let before = window.middle();
    assert_eq!(window.log.0.borrow().bends, [1, 0]);
    window.run_command(Command::GoToStep(1));
    window.steps(60);
    window.settle();
    let [at_rest, followed] = window.log.0.borrow().bends;
    assert!(followed >= 2, "it follows: {followed}");
    assert!((2..6).contains(&at_rest), "and comes to rest: {at_rest}");
    window.look("figure_bent");
    assert!(apart(&before, &window.middle()) > 100, "it is bent");
    window.run_command(Command::GoToStep(0));
    window.steps(60);
    window.settle();
    assert!(apart(&before, &window.middle()) < 20, "as it was");
}

/// A picture file that is opened begins a document that tells that it is a figure.
#[test]
fn a_picture_that_is_opened_is_a_figure() {
    let mut window = Window::open(DESK, CUBE);
    let svg = br##"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 40 30"><rect id="r" x="5" y="5" width="30" height="20" fill="#c04020"/><text x="10" y="12">Red<tspan> square</tspan></text></svg>"##;
    {
        let log = &mut *window.log.0.borrow_mut();
        log.files.push(("plate.svg".to_owned(), svg.to_vec()));
        log.next_ticket += 1;
        let ticket = Ticket(log.next_ticket);
        log.file_starts(ticket);
        log.read("plate.svg", fabrica::assets::Role::Subject, ticket);
    }
    window.settle();
    let document = window.document();
    assert!(document.get("/figure").is_some(), "{}", document.to_json());
    let illustration = document.illustration();
    assert!(illustration.is_of_figure());
    assert_eq!(illustration.camera.rotate, FIGURE_FRONT);
    assert_eq!(document.get("/camera/rotate"), None, "seen from its front");
    let picture = window.middle();
    let red = picture.pixels().filter(|p| p.0[0] > 150 && p.0[1] < 100);
    assert!(red.count() > 200, "it is drawn");
    // What a click would take is outlined under the hand.
    window.click("By shape");
    window.settle();
    let before = window.middle();
    let center = window.picture_center();
    window.harness.hover_at(center + vec2(20.0, 10.0));
    window.settle();
    window.look("figure_pointed");
    let outlined = apart(&before, &window.middle());
    assert!(outlined > 100, "{outlined} pixels");
    window.press(Key::Escape);
    window.settle();
    // Its words are not drawn, but offered as labels.
    window.click("Panel: Text");
    window.settle();
    let word = "Label: Red square";
    window.harness.get_by_label(word).scroll_to_me();
    window.steps(20);
    window.look("figure_words");
    window.click(word);
    window.settle();
    let captions = window.document().illustration().captions.clone();
    assert_eq!(captions.len(), 1);
    assert_eq!(captions[0].text, "Red square");
    let place = glam::Vec3::new(10.0 / 40.0 - 0.5, (15.0 - 12.0) / 40.0, 0.0);
    assert!(captions[0].at.distance(place) < 1e-5, "{}", captions[0].at);
    assert!(window.harness.query_by_label(word).is_none(), "each once");
    window.undo();
    window.undo();
    window.settle();
    let subject = &window.document().illustration().subject.clone();
    assert!(
        matches!(subject, SubjectRef::Builtin { name, .. } if name == "cube"),
        "{subject:?}"
    );
}

/// Where a place of the figure's plane is seen in the window.
fn spot(window: &Window, x: f32, y: f32) -> Pos2 {
    let camera = window.document().illustration().camera;
    let rect = window.harness.get_by_role(Role::Image).rect();
    let half = (0.5 * camera.fov_deg.to_radians()).tan() * camera.distance;
    let scale = 0.5 * rect.width().min(rect.height()) / half;
    let at = vec2(x - camera.target.x, camera.target.y - y) * scale;
    rect.center() + at
}

fn handles(window: &Window) -> Vec<fabrica::document::figure::Handle> {
    let document = window.document();
    let figure = document.illustration().figure.clone();
    figure.map_or_else(Vec::new, |figure| figure.handles)
}

/// The strip shows each step as it bends the figure.
#[test]
fn steps_have_small_pictures_of_their_own() {
    let mut window = Window::open(DESK, ARM);
    window.steps(90);
    window.settle();
    window.look("figure_strip");
    let (start, step) = (window.step_picture("Start"), window.step_picture("Step 1"));
    assert!(drawn(&start) > 60, "the arm is drawn");
    assert!(apart(&start, &step) > 20, "bent otherwise");
}

/// A pose that takes long tells how far it is, can be stopped, and is made after all when that is wished.
#[test]
fn a_pose_that_takes_long_can_be_stopped() {
    let mut window = Window::open(DESK, ARM);
    // Handles stand where the document has them.
    let handles = FigureCommand::Show(Overlay::Handles);
    window.run_command(Command::Figure(handles));
    // Above the cards over the picture.
    let top = |window: &mut Window| {
        let center = window.picture_center();
        window.pixels(egui::Rect::from_center_size(
            center - vec2(0.0, 65.0),
            vec2(300.0, 130.0),
        ))
    };
    let before = top(&mut window);
    window.log.0.borrow_mut().is_slow = true;
    let to = serde_json::json!([0.05, 0.12]);
    let edit = figure_edit("handles/1/move", Some(to));
    window.run_command(Command::Apply(edit));
    assert!(
        window.harness.query_by_label("Stop bending").is_none(),
        "it may be there at once"
    );
    window.steps(60);
    let bar = window.harness.get_by_role(Role::ProgressIndicator);
    assert_eq!(
        bar.accesskit_node().numeric_value(),
        Some(f64::from(0.4_f32))
    );
    window.look("figure_under_way");
    window.click("Stop bending");
    window.steps(10);
    assert!(window.harness.query_by_label("Stop bending").is_none());
    assert!(apart(&before, &top(&mut window)) < 20, "as it was");
    window.log.0.borrow_mut().is_slow = false;
    window.click("Go on");
    window.settle();
    assert!(window.harness.query_by_label("Go on").is_none());
    assert!(apart(&before, &top(&mut window)) > 100, "it is bent");
}

/// Pins are set by clicks and dragged, by the hand and by keys; the figure follows, and one drag is one step of undo.
#[test]
fn pins_are_set_and_dragged() {
    let mut window = Window::open(
        DESK,
        r#"{ "fabrica": 1, "subject": { "builtin": "drawn-arm" }, "figure": { "detail": 1500 } }"#,
    );
    window.click("Pin");
    window.settle();
    for (x, y) in [(-0.25, 0.05), (-0.15, -0.2), (0.36, -0.08)] {
        let at = spot(&window, x, y);
        window.click_at(at);
        window.settle();
    }
    window.look("figure_pins");
    let set = handles(&window);
    assert_eq!(set.len(), 3, "{}", window.document().to_json());
    window.press(Key::Escape);
    window.settle();
    let bends = window.log.0.borrow().bends;
    let at = spot(&window, 0.36, -0.08);
    window.drag_on(at, vec2(-20.0, -60.0), 6);
    window.look("figure_followed");
    window.harness.drop_at(at + vec2(-20.0, -60.0));
    window.settle();
    window.look("figure_dragged");
    let moved = handles(&window)[2].motion.by;
    assert!(moved.y > 0.03 && moved.x < 0.0, "{moved}");
    let after = window.log.0.borrow().bends;
    assert!(
        after[1] > bends[1],
        "it follows the hand: {bends:?} {after:?}"
    );
    assert!(after[0] > bends[0], "and comes to rest");
    assert!(
        window
            .harness
            .query_by_label("Turn of Pin 3: Found by itself")
            .is_some()
    );
    window.undo();
    window.settle();
    assert_eq!(handles(&window)[2].motion.by, glam::DVec2::ZERO);
    // By keys: the next pin, a bit to the left, turned, put back, taken away.
    window.harness.get_by_label("Pin 2 in the picture").focus();
    window.settle();
    window.press(Key::ArrowLeft);
    window.settle();
    assert!(handles(&window)[1].motion.by.x < -0.001);
    window.press(Key::Delete);
    window.settle();
    assert_eq!(handles(&window).len(), 2);
    // With all overlays it can still be read.
    for overlay in ["Rigidity", "Mesh", "Vertices"] {
        window.click(overlay);
    }
    window.settle();
    window.look("figure_overlays");
}
