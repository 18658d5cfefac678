//! The app by role and label: what an author does from the first click to the link, with the mouse and with keys alone.
//!
//! With `FABRICA_LOOK_AT=folder` the windows are written there as PNG, to be looked at.
#![cfg(feature = "app")]

#[path = "app/comfort.rs"]
mod comfort;
#[path = "app/labels.rs"]
mod labels;
#[path = "app/looking.rs"]
mod looking;
#[path = "app/making.rs"]
mod making;
#[path = "app/tissue.rs"]
mod tissue;

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::rc::Rc;
use std::sync::Arc;

use egui::{Key, Modifiers, Pos2, Role, Vec2, pos2, vec2};
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use egui_kittest::{Harness, wgpu::WgpuTestRenderer};
use fabrica::app::{
    App, LinkChange, LoadEvent, Message, RawQuestion, SaveFile, Services, Start, Ticket,
};
use fabrica::data::{Volume, VolumeSink, Voxels};
use fabrica::document::{Document, ParamValue, RawVoxels, SubjectRef, TemplateMode};

// ---------------------------------------------------------------------------------------------------- surroundings

/// What the app asked of its surroundings.
#[derive(Default)]
struct Log {
    copied: Vec<String>,
    saved: Vec<SaveFile>,
    links: Vec<(String, LinkChange)>,
    stored: BTreeMap<String, String>,
    loads: Vec<SubjectRef>,
    answered_raw: Vec<(Ticket, RawVoxels)>,
    cancelled: Vec<Ticket>,
    allowed: Vec<Ticket>,
    dialogs: usize,
    queue: Vec<Message>,
    next_ticket: u64,
    /// Loads are answered only when a test does it itself.
    is_slow: bool,
}

#[derive(Clone, Default)]
struct Fake(Rc<RefCell<Log>>);

impl Fake {
    /// As if it had been kept from the last time.
    fn store_value(&self, key: &str, value: &str) {
        let mut log = self.0.borrow_mut();
        log.stored.insert(key.to_owned(), value.to_owned());
    }
}

/// Voxels along the subject: small, since lavapipe draws it.
const RESOLUTION: u32 = 48;
/// The same for the head when somebody looks.
const HEAD_RESOLUTION: u32 = 144;

struct Queue<'a>(&'a mut Log, Ticket);

impl Queue<'_> {
    fn push(&mut self, event: LoadEvent) {
        self.0.queue.push(Message::Load {
            ticket: self.1,
            event,
        });
    }
}

impl VolumeSink for Queue<'_> {
    fn begin(&mut self, header: &Volume) -> Result<(), String> {
        self.push(LoadEvent::Begin(Box::new(header.clone())));
        Ok(())
    }
    fn scalars(&mut self, next: Voxels) {
        self.push(LoadEvent::Scalars(next));
    }
    fn labels(&mut self, next: Vec<u8>) {
        self.push(LoadEvent::Labels(next));
    }
    fn progress(&mut self, _: f32) -> bool {
        true
    }
}

impl Services for Fake {
    fn poll(&mut self) -> Vec<Message> {
        std::mem::take(&mut self.0.borrow_mut().queue)
    }
    fn open_file(&mut self) {
        self.0.borrow_mut().dialogs += 1;
    }
    fn drop_file(&mut self, _: egui::DroppedFileHandle) {}
    fn load_subject(&mut self, subject: &SubjectRef) -> Ticket {
        let log = &mut *self.0.borrow_mut();
        log.next_ticket += 1;
        let ticket = Ticket(log.next_ticket);
        log.loads.push(subject.clone());
        if !log.is_slow
            && let SubjectRef::Builtin { name } = subject
        {
            let resolution = if name == "head" && std::env::var_os("FABRICA_LOOK_AT").is_some() {
                HEAD_RESOLUTION
            } else {
                RESOLUTION
            };
            let generated = fabrica::subjects::generate(name, resolution, &mut Queue(log, ticket));
            let event = match generated {
                Ok(()) => LoadEvent::Done { sha256: None },
                Err(error) => LoadEvent::Failed {
                    message: error.to_string(),
                    details: String::new(),
                },
            };
            log.queue.push(Message::Load { ticket, event });
        }
        ticket
    }
    fn allow_host(&mut self, ticket: Ticket) {
        self.0.borrow_mut().allowed.push(ticket);
    }
    fn answer_raw(&mut self, ticket: Ticket, raw: &RawVoxels) {
        self.0.borrow_mut().answered_raw.push((ticket, raw.clone()));
    }
    fn cancel_load(&mut self, ticket: Ticket) {
        let log = &mut *self.0.borrow_mut();
        log.cancelled.push(ticket);
        log.queue.push(Message::Load {
            ticket,
            event: LoadEvent::Cancelled,
        });
    }
    fn save_file(&mut self, file: SaveFile) {
        let log = &mut *self.0.borrow_mut();
        log.queue.push(Message::Saved(Ok(file.name.clone())));
        log.saved.push(file);
    }
    fn copy_text(&mut self, text: String) {
        let log = &mut *self.0.borrow_mut();
        log.copied.push(text);
        log.queue.push(Message::Copied(Ok(())));
    }
    fn paste_text(&mut self) {
        let log = &mut *self.0.borrow_mut();
        let text = log.copied.last().cloned();
        log.queue.push(Message::Pasted(text));
    }
    fn page_address(&self) -> String {
        "https://fabrica.example/#old".to_owned()
    }
    fn set_link(&mut self, payload: &str, change: LinkChange) {
        self.0.borrow_mut().links.push((payload.to_owned(), change));
    }
    fn store(&mut self, key: &str, value: &str) {
        self.0
            .borrow_mut()
            .stored
            .insert(key.to_owned(), value.to_owned());
    }
    fn stored(&self, key: &str) -> Option<String> {
        self.0.borrow().stored.get(key).cloned()
    }
}

fn clock() -> f64 {
    std::time::SystemTime::now()
        .duration_since(std::time::UNIX_EPOCH)
        .map_or(0.0, |since| since.as_secs_f64())
}

/// The app in a window of a size, on the software device.
struct Window {
    harness: Harness<'static, App>,
    log: Fake,
}

const CUBE: &str = r#"{ "fabrica": 1, "subject": { "builtin": "cube" } }"#;

impl Window {
    fn open(size: Vec2, json: &str) -> Self {
        Self::open_with(size, egui::Theme::Light, Fake::default(), Some(json))
    }

    fn open_with(size: Vec2, theme: egui::Theme, log: Fake, text: Option<&str>) -> Self {
        let mut setup = match egui_kittest::wgpu::default_wgpu_setup() {
            eframe::egui_wgpu::WgpuSetup::CreateNew(setup) => setup,
            other => panic!("the harness makes its own device, not {other:?}"),
        };
        setup.device_descriptor = Arc::new(fabrica::render::Gpu::device_descriptor);
        let services = log.clone();
        let text = text.map(str::to_owned);
        let harness = Harness::builder()
            .with_size(size)
            .with_theme(theme)
            .with_max_steps(2000)
            .renderer(WgpuTestRenderer::from_setup(
                eframe::egui_wgpu::WgpuSetup::CreateNew(setup),
            ))
            .build_eframe(|cc| {
                let start = Start {
                    document: None,
                    text,
                    subject: None,
                    clock,
                };
                App::new(cc, Box::new(services), start)
            });
        let mut window = Self { harness, log };
        window.settle();
        window
    }

    /// Goes on until the picture is complete and the link is renewed.
    fn settle(&mut self) {
        // What is never answered is not waited for.
        let patience = clock()
            + if self.log.0.borrow().is_slow {
                0.2
            } else {
                120.0
            };
        self.harness.step();
        while clock() < patience && !self.harness.state().is_at_rest() {
            self.harness.step();
            std::thread::sleep(std::time::Duration::from_millis(2));
        }
        // The link follows after a while on the clock of the interface, 1/60 s a step.
        self.harness.run_steps(40);
    }

    fn steps(&mut self, n: usize) {
        self.harness.run_steps(n);
    }

    fn click(&mut self, label: &str) {
        self.harness.get_by_label(label).click();
        self.steps(3);
    }

    fn document(&self) -> Document {
        self.harness.state().document()
    }

    fn press(&mut self, key: Key) {
        self.harness.key_press(key);
        self.steps(3);
    }

    fn press_with(&mut self, modifiers: Modifiers, key: Key) {
        self.harness.key_press_modifiers(modifiers, key);
        self.steps(3);
    }

    fn picture_center(&self) -> Pos2 {
        self.harness.get_by_role(Role::Image).rect().center()
    }

    fn click_at(&mut self, pos: Pos2) {
        self.harness.hover_at(pos);
        self.harness.step();
        self.harness.drag_at(pos);
        self.harness.step();
        self.harness.drop_at(pos);
        self.settle();
    }

    fn drag(&mut self, from: Pos2, by: Vec2) {
        self.harness.hover_at(from);
        self.harness.step();
        self.harness.drag_at(from);
        self.harness.step();
        for i in 1..=6 {
            self.harness.hover_at(from + by * (i as f32 / 6.0));
            self.harness.step();
        }
        self.harness.drop_at(from + by);
        self.settle();
    }

    /// Writes the window to be looked at, if somebody wants to.
    fn look(&mut self, name: &str) {
        if let Some(folder) = std::env::var_os("FABRICA_LOOK_AT") {
            let image = self.harness.render().expect("the window can be drawn");
            let path = std::path::Path::new(&folder).join(format!("{name}.png"));
            image.save(path).expect("a picture to look at");
        }
    }

    fn place_peel(&mut self) {
        self.click("Place peel");
        let center = self.picture_center();
        self.click_at(center);
        assert_eq!(
            self.document().illustration().templates.len(),
            1,
            "a click on the object places it"
        );
    }
}

/// The head as a visitor sees it; drawn only to be looked at, since it takes its time on a software device.
#[test]
fn the_head_to_look_at() {
    if std::env::var_os("FABRICA_LOOK_AT").is_none() {
        println!("FABRICA_LOOK_AT is not set: nobody looks, nothing is drawn");
        return;
    }
    let json = r#"{ "fabrica": 1, "templates": [ { "kind": "peel", "at": [0.02,0.24,0.2],
        "rotate": [0,0.7071,0.7071,0], "size": [0.36,0.3,0.2], "params": { "progress": 0.6 } } ] }"#;
    for (name, size, theme) in [
        ("head", DESK, egui::Theme::Light),
        ("head_dark", DESK, egui::Theme::Dark),
        ("head_phone", vec2(360.0, 740.0), egui::Theme::Light),
    ] {
        let mut window = Window::open_with(size, theme, Fake::default(), Some(json));
        window.settle();
        window.look(name);
        if size == DESK {
            window.click("1. Peel");
        } else {
            window.press(Key::N);
        }
        window.look(&format!("{name}_selected"));
    }
}

/// Small, since lavapipe draws it; 1280 by 800 to be looked at.
const DESK: Vec2 = if option_env!("FABRICA_LOOK_AT").is_some() {
    Vec2::new(1280.0, 800.0)
} else {
    Vec2::new(940.0, 700.0)
};

// ---------------------------------------------------------------------------------------------------- the author's path

#[test]
fn from_the_first_click_to_the_link() {
    let mut window = Window::open(DESK, CUBE);
    window.look("desk");
    window.place_peel();
    window.look("desk_placed");
    let placed = window.document().illustration().templates[0].clone();
    assert_eq!(placed.kind.spec().name, "peel");
    let up = placed.placement.rotate * glam::Vec3::Z;
    assert!(
        up.y > 0.9,
        "turned to the surface, which looks to the front: {up}"
    );
    assert_eq!(
        window.harness.state().selected(),
        Some(0),
        "what was placed is selected"
    );

    window.click("Copy link");
    window.steps(5);
    let copied = window
        .log
        .0
        .borrow()
        .copied
        .last()
        .cloned()
        .expect("the link was copied");
    let (page, payload) = copied.split_once('#').expect("a page and a payload");
    assert_eq!(page, "https://fabrica.example/");
    let opened = fabrica::link::decode(payload)
        .expect("the link opens")
        .document;
    assert_eq!(opened, window.document(), "the link is the document");
    assert!(
        window
            .harness
            .query_by_label_contains("clipboard")
            .is_some(),
        "and it is said"
    );
}

#[test]
fn parameters_are_changed_undone_and_redone() {
    let mut window = Window::open(DESK, CUBE);
    window.place_peel();
    let progress =
        |window: &Window| window.document().illustration().templates[0].number("progress");
    let slider = window.harness.get_by_label("Progress slider").rect();
    window.drag(slider.center(), vec2(0.3 * slider.width(), 0.0));
    let opened = progress(&window);
    assert!(opened > 0.6, "the slider was dragged: {opened}");
    window.click("Undo");
    assert!(
        (progress(&window) - 0.5).abs() < 1e-3,
        "one drag is one step of undo: {}",
        progress(&window)
    );
    window.press_with(Modifiers::COMMAND | Modifiers::SHIFT, Key::Z);
    assert!((progress(&window) - opened).abs() < 1e-3, "redone");
    window.click("Reset progress");
    assert!(
        (progress(&window) - 0.5).abs() < 1e-3,
        "back to the default"
    );
    window.press_with(Modifiers::COMMAND, Key::Z);
    window.press_with(Modifiers::COMMAND, Key::Z);
    window.press_with(Modifiers::COMMAND, Key::Z);
    assert!(
        window.document().illustration().templates.is_empty(),
        "all the way back"
    );
}

#[test]
fn angles_are_shown_in_degrees() {
    let mut window = Window::open(DESK, CUBE);
    window.place_peel();
    let field = window
        .harness
        .get_by_role_and_label(Role::SpinButton, "Angle");
    assert!(
        field.value().is_some_and(|value| value.contains("180")),
        "a half turn: {:?}",
        field.value()
    );
}

#[test]
fn the_list_orders_hides_duplicates_and_deletes() {
    let json = r#"{ "fabrica": 1, "subject": { "builtin": "cube" }, "templates": [
        { "kind": "poke" }, { "kind": "peel", "name": "skin" }, { "kind": "twist" } ] }"#;
    let mut window = Window::open(DESK, json);
    let kinds = |window: &Window| -> Vec<&str> {
        window
            .document()
            .illustration()
            .templates
            .iter()
            .map(|t| t.kind.spec().name)
            .collect()
    };
    window.click("2. skin");
    assert_eq!(window.harness.state().selected(), Some(1));
    window.click("Let it act earlier");
    assert_eq!(kinds(&window), ["peel", "poke", "twist"]);
    assert_eq!(
        window.harness.state().selected(),
        Some(0),
        "the selection goes with it"
    );
    window.click("Hide 1. skin");
    assert!(!window.document().illustration().templates[0].enabled);
    window.click("Show 1. skin");
    window.click("Duplicate template");
    assert_eq!(kinds(&window), ["peel", "peel", "poke", "twist"]);
    assert_eq!(
        window.harness.state().selected(),
        Some(1),
        "the copy is selected"
    );
    window.click("Joins: Added");
    assert_eq!(
        window.document().illustration().templates[1].mode,
        TemplateMode::Add
    );
    window.look("desk_list");
    window.click("Delete template");
    window.press(Key::Delete);
    assert_eq!(kinds(&window), ["peel", "twist"]);
}

#[test]
fn an_entry_is_dragged_to_its_place() {
    let json = r#"{ "fabrica": 1, "subject": { "builtin": "cube" }, "templates": [
        { "kind": "poke" }, { "kind": "peel" }, { "kind": "twist" } ] }"#;
    let mut window = Window::open(DESK, json);
    let first = window.harness.get_by_label("1. Poke").rect().center();
    let last = window.harness.get_by_label("3. Twist").rect().center();
    window.drag(first, last - first + vec2(0.0, 10.0));
    let kinds: Vec<_> = window
        .document()
        .illustration()
        .templates
        .iter()
        .map(|t| t.kind.spec().name)
        .collect();
    assert_eq!(kinds, ["peel", "twist", "poke"]);
}

#[test]
fn the_gizmo_moves_turns_and_sizes() {
    let mut window = Window::open(DESK, CUBE);
    window.place_peel();
    let placement = |window: &Window| window.document().illustration().templates[0].placement;
    let before = placement(&window);

    let tip = window.harness.get_by_label("Move along x").rect().center();
    window.drag(tip, vec2(60.0, 3.0));
    let moved = placement(&window);
    let by = moved.at - before.at;
    let along = (before.rotate * glam::Vec3::X).dot(by);
    assert!(
        along > 0.02 && by.length() - along < 1e-3,
        "along its own x axis alone: {by}"
    );

    window.click("Handles: Turn");
    let ring = window.harness.get_by_label("Turn about z").rect().center();
    window.drag(ring, vec2(40.0, 40.0));
    let turned = placement(&window);
    assert!(turned.rotate.angle_between(moved.rotate) > 0.1, "turned");
    assert!(turned.at.distance(moved.at) < 1e-3, "in place");

    window.click("Handles: Size");
    let face = window
        .harness
        .get_by_label("Size x at the far end")
        .rect()
        .center();
    let center = window
        .harness
        .get_by_label("Size x at the near end")
        .rect()
        .center();
    window.drag(face, (face - center).normalized() * 40.0);
    let sized = placement(&window);
    assert!(
        sized.size.x > turned.size.x + 0.02,
        "wider: {} to {}",
        turned.size,
        sized.size
    );
    assert!((sized.size.y - turned.size.y).abs() < 1e-4, "and only in x");
    window.look("desk_size");
    for _ in 0..3 {
        window.press_with(Modifiers::COMMAND, Key::Z);
    }
    assert_eq!(placement(&window), before, "each drag is one step of undo");
}

#[test]
fn the_main_parameter_is_dragged_in_the_picture() {
    let mut window = Window::open(DESK, CUBE);
    window.place_peel();
    let value = |window: &Window| match window.document().illustration().templates[0].params[0] {
        ParamValue::Number(value) => value,
        other => panic!("a number, not {other:?}"),
    };
    let camera = window.document().illustration().camera;
    let handle = window.harness.get_by_label("Drag progress").rect().center();
    window.drag(handle, vec2(50.0, 0.0));
    assert!(
        value(&window) > 0.52,
        "dragged open along x: {}",
        value(&window)
    );
    assert_eq!(
        window.document().illustration().camera,
        camera,
        "the camera stays"
    );
    let further = window.harness.get_by_label("Drag progress").rect().center();
    assert!(
        further.x > handle.x + 20.0,
        "the handle goes with the hand: {handle} to {further}"
    );
}

#[test]
fn the_whole_path_by_keys_alone() {
    let mut window = Window::open(DESK, CUBE);
    window.harness.get_by_label("Place retractor").focus();
    window.steps(2);
    window.press(Key::Enter);
    window.press(Key::Enter);
    window.settle();
    assert_eq!(
        window.document().illustration().templates.len(),
        1,
        "Enter places it in the middle"
    );
    let amount = |window: &Window| window.document().illustration().templates[0].number("amount");
    let before = amount(&window);
    window.press(Key::OpenBracket);
    assert!(amount(&window) < before, "closed a little");
    window.press(Key::CloseBracket);
    window.press(Key::CloseBracket);
    assert!(amount(&window) > before, "opened");
    let rotate = window.document().illustration().camera.rotate;
    window.press(Key::ArrowLeft);
    assert!(
        window.document().illustration().camera.rotate != rotate,
        "an arrow turns the object"
    );
    window.press(Key::D);
    assert_eq!(
        window.document().illustration().templates.len(),
        2,
        "duplicated"
    );
    window.press(Key::Delete);
    window.press(Key::H);
    assert!(
        !window.document().illustration().templates[0].enabled,
        "hidden"
    );
    window.press(Key::Num6);
    window.settle();
    let back = window.document().illustration().camera.rotate * glam::Vec3::Y;
    assert!(back.z < -0.99, "from below: {back}");
    window.press_with(Modifiers::COMMAND | Modifiers::SHIFT, Key::L);
    assert_eq!(window.log.0.borrow().copied.len(), 1, "the link is copied");
    window.press(Key::Questionmark);
    assert!(
        window.harness.query_by_label("Keys and gestures").is_some(),
        "the sheet of keys"
    );
    window.look("desk_keys");
    window.press(Key::Escape);
    assert!(
        window.harness.query_by_label("Keys and gestures").is_none(),
        "and away again"
    );
}

#[test]
fn the_camera_turns_moves_zooms_and_goes_home() {
    let mut window = Window::open(DESK, CUBE);
    let camera = |window: &Window| window.document().illustration().camera;
    let home = camera(&window);
    let center = window.picture_center();
    window.drag(center, vec2(120.0, 40.0));
    let turned = camera(&window);
    assert!(turned.rotate.angle_between(home.rotate) > 0.5, "turned");
    assert_eq!(turned.target, home.target);
    window.harness.hover_at(center);
    window.harness.event(egui::Event::MouseWheel {
        unit: egui::MouseWheelUnit::Point,
        delta: vec2(0.0, 120.0),
        phase: egui::TouchPhase::Move,
        source: egui::MouseWheelSource::Unknown,
        modifiers: Modifiers::NONE,
    });
    window.settle();
    assert!(camera(&window).distance < turned.distance, "closer");
    window.click("View: Left");
    window.settle();
    let back = camera(&window).rotate * glam::Vec3::Y;
    assert!(back.x < -0.99, "from the patient's left: {back}");
    window.click("Back to the first view");
    window.settle();
    assert!(
        camera(&window).rotate.angle_between(home.rotate) < 1e-3,
        "home"
    );
    assert!(window.document().illustration().templates.is_empty());
    window.press_with(Modifiers::COMMAND, Key::Z);
    assert!(
        camera(&window).rotate.angle_between(home.rotate) < 1e-3,
        "undo leaves the camera alone"
    );
}

#[test]
fn the_address_follows_what_is_done() {
    let mut window = Window::open(DESK, CUBE);
    assert!(
        window.log.0.borrow().links.is_empty(),
        "opening changes nothing in the address bar"
    );
    let center = window.picture_center();
    window.drag(center, vec2(50.0, 0.0));
    let turned = window
        .log
        .0
        .borrow()
        .links
        .last()
        .cloned()
        .expect("the camera is in the link");
    assert_eq!(
        turned.1,
        LinkChange::Replace,
        "without an entry in the history"
    );
    window.place_peel();
    window.settle();
    let (payload, change) = window
        .log
        .0
        .borrow()
        .links
        .last()
        .cloned()
        .expect("the peel is in the link");
    assert_eq!(change, LinkChange::Push);
    let opened = fabrica::link::decode(&payload).expect("it opens").document;
    assert_eq!(opened, window.document());
    assert_eq!(
        window.log.0.borrow().stored.get("document"),
        Some(&payload),
        "and it is kept for a reload"
    );

    let log = Fake::default();
    log.0
        .borrow_mut()
        .stored
        .insert("document".to_owned(), payload);
    let again = Window::open_with(DESK, egui::Theme::Light, log, None);
    assert_eq!(again.document(), opened, "nothing is lost on reload");
}

// ---------------------------------------------------------------------------------------------------- faults

#[test]
fn steps_are_walked_and_an_edit_leaves_them() {
    let document = r#"{ "fabrica": 1, "title": "A cut", "subject": { "builtin": "cube" },
        "templates": [{ "kind": "split", "params": { "amount": 0 } }],
        "steps": [{ "title": "Incision", "caption": "It opens.", "seconds": 0.2, "set": { "/templates/0/params/amount": 0.3 } },
                  { "title": "Wide", "seconds": 0.2, "set": { "/templates/0/params/amount": 0.8, "/camera/distance": 4 } }] }"#;
    let document = fabrica::document::Document::from_json(document).expect("a document");
    let link = fabrica::link::fragment(&document, 1);
    let mut window = Window::open_with(DESK, egui::Theme::Light, Fake::default(), Some(&link));
    assert_eq!(window.harness.state().step(), 1);
    window.harness.get_by_label("1 / 2   Incision");
    let at_one = window.harness.render().expect("a picture");
    window.look("steps_one");

    window.click("Next step");
    window.settle();
    window.harness.get_by_label("2 / 2   Wide");
    let address = |window: &Window| {
        window
            .log
            .0
            .borrow()
            .links
            .last()
            .map(|(link, _)| link.clone())
    };
    assert!(
        address(&window).is_some_and(|link| link.ends_with("&step=2")),
        "the address names the step"
    );
    let at_two = window.harness.render().expect("a picture");
    assert_ne!(at_one, at_two);
    assert!(
        window
            .harness
            .state()
            .document()
            .get("/camera/distance")
            .is_none(),
        "the document is as it was"
    );

    window.press(Key::N);
    window.settle();
    assert_eq!(
        window.harness.state().step(),
        0,
        "what is edited is the document as it stands"
    );
    window.harness.get_by_label("0 / 2   A cut");
    assert!(address(&window).is_some_and(|link| !link.contains("step=")));
}

#[test]
fn a_broken_link_is_said_and_leaves_a_working_viewer() {
    let window = Window::open_with(
        DESK,
        egui::Theme::Light,
        Fake::default(),
        Some("#Anonsense"),
    );
    assert!(
        window
            .harness
            .query_by_label_contains("cannot be opened")
            .is_some(),
        "what is wrong is said"
    );
    assert!(
        window.log.0.borrow().links.is_empty(),
        "the address is left as it is"
    );
    assert!(
        window.harness.query_by_label("Place peel").is_some(),
        "and everything works"
    );
}

#[test]
fn loading_shows_its_progress_and_is_stopped() {
    let log = Fake::default();
    log.0.borrow_mut().is_slow = true;
    let mut window = Window::open_with(DESK, egui::Theme::Light, log.clone(), Some(CUBE));
    let ticket = Ticket(log.0.borrow().next_ticket);
    let event = LoadEvent::Progress {
        fraction: 0.42,
        what: "Generating".to_owned(),
    };
    log.0
        .borrow_mut()
        .queue
        .push(Message::Load { ticket, event });
    window.steps(3);
    assert!(
        window
            .harness
            .query_by_label_contains("Generating 42")
            .is_some(),
        "how far it is"
    );
    window.look("desk_loading");
    window.click("Cancel loading");
    assert_eq!(log.0.borrow().cancelled, [ticket]);
    window.steps(3);
    assert!(
        window.harness.query_by_label_contains("stopped").is_some(),
        "and it is said"
    );
    let late = LoadEvent::Failed {
        message: "late".to_owned(),
        details: String::new(),
    };
    log.0.borrow_mut().queue.push(Message::Load {
        ticket,
        event: late,
    });
    window.steps(3);
    assert!(
        window.harness.query_by_label("late").is_none(),
        "what comes after is dropped"
    );
}

#[test]
fn another_host_is_asked_about_before_it_is_fetched_from() {
    let log = Fake::default();
    log.0.borrow_mut().is_slow = true;
    let json = r#"{ "fabrica": 1, "subject": { "src": "https://scans.example/a.nii.gz" } }"#;
    let mut window = Window::open_with(DESK, egui::Theme::Light, log.clone(), Some(json));
    let ticket = Ticket(log.0.borrow().next_ticket);
    log.0.borrow_mut().queue.push(Message::AskHost {
        ticket,
        host: "scans.example".to_owned(),
    });
    window.steps(3);
    assert!(
        window
            .harness
            .query_by_label_contains("scans.example")
            .is_some(),
        "names the host"
    );
    assert!(log.0.borrow().allowed.is_empty());
    window.click("Fetch");
    assert_eq!(log.0.borrow().allowed, [ticket]);
}

/// A file of the user's that was read: the bar, under a hash.
fn file_arrives(log: &Fake, ticket: Ticket, before_done: Option<LoadEvent>) {
    let log = &mut *log.0.borrow_mut();
    fabrica::subjects::generate("bar", 32, &mut Queue(log, ticket)).expect("a built-in subject");
    let sha256 = Some("ab".repeat(32));
    let events = before_done.into_iter().chain([LoadEvent::Done { sha256 }]);
    for event in events {
        log.queue.push(Message::Load { ticket, event });
    }
}

#[test]
fn one_of_several_volumes_is_chosen_and_taken_back() {
    let log = Fake::default();
    let mut window = Window::open_with(DESK, egui::Theme::Light, log.clone(), Some(CUBE));
    let ticket = Ticket(99);
    log.0
        .borrow_mut()
        .queue
        .push(Message::FileStarted { ticket });
    window.steps(2);
    file_arrives(&log, ticket, Some(LoadEvent::Frames { count: 20 }));
    window.settle();
    let frame = |window: &Window| {
        let subject = window.document().illustration().subject.clone();
        subject.reading().map(|reading| reading.frame)
    };
    assert_eq!(frame(&window), Some(0), "the first is shown");
    window
        .harness
        .get_by_role_and_label(Role::Slider, "Volume")
        .focus();
    window.steps(2);
    window.harness.key_press(egui::Key::ArrowRight);
    window.steps(3);
    assert_eq!(frame(&window), Some(1), "one further");
    let asked = log.0.borrow().loads.last().cloned();
    assert_eq!(
        asked
            .as_ref()
            .and_then(SubjectRef::reading)
            .map(|r| r.frame),
        Some(1),
        "and it is loaded"
    );
    window.click("Undo");
    window.steps(3);
    assert_eq!(frame(&window), Some(0), "and back");
}

#[test]
fn bare_voxels_are_opened_by_what_one_says_of_them() {
    let log = Fake::default();
    let mut window = Window::open_with(DESK, egui::Theme::Light, log.clone(), Some(CUBE));
    let ticket = Ticket(99);
    let question = RawQuestion {
        byte_len: Some(4 * 3 * 2),
        is_packed: false,
        guess: Some(RawVoxels {
            size: [4, 3, 2],
            element: "uint8",
            big_endian: false,
            spacing_mm: [1.0; 3],
            skip_bytes: 0,
        }),
    };
    {
        let queue = &mut log.0.borrow_mut().queue;
        queue.push(Message::FileStarted { ticket });
        queue.push(Message::Load {
            ticket,
            event: LoadEvent::AskRaw(question),
        });
    }
    window.steps(3);
    window
        .harness
        .get_by_label("The size fits the file to the byte");
    window
        .harness
        .get_by_role_and_label(Role::CheckBox, "High byte first")
        .click();
    window.steps(2);
    // "Open" also stands in the bar above, behind the dialog.
    let buttons = window
        .harness
        .get_all_by_role_and_label(Role::Button, "Open");
    buttons.last().expect("the dialog's").click();
    window.steps(2);
    let answered = log.0.borrow().answered_raw.clone();
    assert_eq!(answered.len(), 1, "one answer");
    assert!(answered[0].1.big_endian, "as it was said");
    file_arrives(&log, ticket, None);
    window.settle();
    let subject = window.document().illustration().subject.clone();
    let raw = subject.reading().and_then(|reading| reading.raw.clone());
    assert_eq!(raw.as_ref(), Some(&answered[0].1), "kept in the document");
    let json = window.document().to_json_compact();
    assert!(
        json.contains(r#""raw":{"size":[4,3,2],"order":"big"}"#),
        "{json}"
    );
}

#[test]
fn an_opened_file_becomes_the_subject_by_its_hash() {
    let log = Fake::default();
    let mut window = Window::open_with(DESK, egui::Theme::Light, log.clone(), Some(CUBE));
    window
        .harness
        .get_by_role_and_label(Role::Button, "Open")
        .click();
    window.steps(3);
    assert_eq!(log.0.borrow().dialogs, 1);
    let ticket = Ticket(99);
    {
        let log = &mut *log.0.borrow_mut();
        log.queue.push(Message::FileStarted { ticket });
        fabrica::subjects::generate("bar", 32, &mut Queue(log, ticket))
            .expect("a built-in subject");
        let sha256 = Some("ab".repeat(32));
        log.queue.push(Message::Load {
            ticket,
            event: LoadEvent::Done { sha256 },
        });
    }
    window.settle();
    match &window.document().illustration().subject {
        SubjectRef::Supplied { sha256, name, .. } => {
            assert_eq!(*sha256, "ab".repeat(32));
            assert!(name.is_empty(), "never the file's own name");
        }
        other => panic!("the reader's file, not {other:?}"),
    }
    window.click("Undo");
    window.settle();
    assert_eq!(
        window.document().illustration().subject,
        SubjectRef::Builtin {
            name: "cube".to_owned()
        }
    );
    let last = log.0.borrow().loads.last().cloned();
    assert_eq!(
        last,
        Some(SubjectRef::Builtin {
            name: "cube".to_owned()
        }),
        "and the cube is there again"
    );
}

#[test]
fn documents_and_pictures_are_saved() {
    let mut window = Window::open(
        vec2(900.0, 600.0),
        r#"{ "fabrica": 1, "title": "A cube, cut", "subject": { "builtin": "cube" } }"#,
    );
    window.press_with(Modifiers::COMMAND, Key::S);
    {
        let log = window.log.0.borrow();
        let file = log.saved.last().expect("the document");
        assert_eq!(file.name, "a-cube-cut.json");
        let text = String::from_utf8(file.bytes.clone()).expect("text");
        assert_eq!(
            Document::from_json(&text).expect("a document"),
            window.document()
        );
    }
    window.click("More");
    window.look("more_menu");
    window.click("Save picture");
    let patience = clock() + 120.0;
    while clock() < patience && window.log.0.borrow().saved.len() < 2 {
        window.harness.step();
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
    let log = window.log.0.borrow();
    let file = log.saved.last().expect("the picture");
    assert_eq!(
        (file.name.as_str(), file.mime),
        ("a-cube-cut.png", "image/png")
    );
    assert_eq!(file.bytes.get(1..4), Some(b"PNG".as_slice()), "a PNG");
}

// ---------------------------------------------------------------------------------------------------- sizes and themes

#[test]
fn a_phone_has_drawers() {
    let mut window = Window::open(vec2(360.0, 740.0), CUBE);
    window.look("phone");
    assert!(
        window.harness.query_by_label("Place peel").is_none(),
        "the picture is alone"
    );
    window.click("Add");
    window.look("phone_add");
    window.click("Place peel");
    assert!(
        window.harness.query_by_label("Place flap").is_none(),
        "the drawer makes room for the picture"
    );
    window.look("phone_placing");
    let center = window.picture_center();
    window.click_at(center);
    assert_eq!(window.document().illustration().templates.len(), 1);
    window.look("phone_placed");
    window.click("Templates");
    assert!(window.harness.query_by_label("Progress slider").is_some());
    window.look("phone_templates");
    window.click("Look");
    window.look("phone_look");
    let screen = egui::Rect::from_min_size(Pos2::ZERO, vec2(360.0, 740.0));
    for name in [
        "Copy link",
        "More",
        "Undo",
        "Redo",
        "Add",
        "Templates",
        "Look",
        "Text",
    ] {
        let rect = window
            .harness
            .get_by_role_and_label(Role::Button, name)
            .rect();
        assert!(
            screen.expand(0.5).contains_rect(rect),
            "{name} is on the screen: {rect}"
        );
        assert!(
            rect.width().min(rect.height()) >= 40.0,
            "{name} is large enough for a thumb: {rect}"
        );
    }
}

/// What a thumb or a small window meets, in every language, to be looked at.
#[test]
fn small_screens_to_look_at() {
    if std::env::var_os("FABRICA_LOOK_AT").is_none() {
        println!("FABRICA_LOOK_AT is not set: nobody looks, nothing is drawn");
        return;
    }
    let json = r#"{ "fabrica": 1, "title": "Cube", "subject": { "builtin": "cube" },
        "templates": [ { "kind": "peel", "at": [0,0,0.2], "size": [0.8,0.8,0.6], "params": { "progress": 0.6 } },
        { "kind": "retractor", "at": [0,0.4,0], "rotate": [-0.7,0,0,0.7], "size": [0.4,0.4,0.3] } ] }"#;
    for (lang, theme) in [("de", egui::Theme::Light), ("es", egui::Theme::Dark)] {
        let log = Fake::default();
        log.store_value("language", lang);
        let mut window = Window::open_with(vec2(360.0, 640.0), theme, log, Some(json));
        window.press(Key::N);
        window.look(&format!("small_{lang}"));
        window.press(Key::V);
        window.settle();
        window.look(&format!("small_{lang}_slices"));
        window.press(Key::V);
        for i in 0..4 {
            window.press(Key::E);
            window.steps(8);
            window.look(&format!("small_{lang}_panel{i}"));
        }
    }
    let log = Fake::default();
    log.store_value("contrast", "high");
    log.store_value("language", "de");
    let size = vec2(780.0, 480.0);
    let mut window = Window::open_with(size, egui::Theme::Dark, log, Some(json));
    window.press(Key::N);
    window.look("tight_contrast");
    window.press(Key::V);
    window.settle();
    window.look("tight_contrast_slices");
}

#[test]
fn the_dark_theme_and_the_look_panel() {
    let json = r##"{ "fabrica": 1, "subject": { "builtin": "cube" }, "look": { "background": "#15181a" },
        "templates": [ { "kind": "peel", "at": [0,0,0.2], "size": [0.8,0.8,0.6] } ] }"##;
    let mut window = Window::open_with(DESK, egui::Theme::Dark, Fake::default(), Some(json));
    window.look("dark");
    window.click("Panel: Look");
    window.click("Background: Paper");
    window.look("dark_look");
    let look = window.document().illustration().look.clone();
    assert_eq!(
        look.background,
        fabrica::document::Background::Color([246, 241, 231])
    );
    window.click("Opacity: Mass");
    assert_eq!(
        window.document().illustration().look.opacity,
        fabrica::document::OpacityMode::Mass
    );
    window.click("Panel: Text");
    window.look("dark_text");
    window.harness.get_by_label("Title").focus();
    window.steps(2);
    window.harness.get_by_label("Title").type_text("Dh?");
    window.steps(3);
    assert_eq!(
        window.document().illustration().title,
        "Dh?",
        "letters belong to the field, not to the keys"
    );
    assert_eq!(window.document().illustration().templates.len(), 1);
}

#[test]
fn the_picture_alone_has_its_texts_and_a_way_back() {
    let json = r#"{ "fabrica": 1, "title": "A cube", "caption": "Strata and a ball", "subject": { "builtin": "cube" } }"#;
    let mut window = Window::open(DESK, json);
    window.press(Key::P);
    window.settle();
    window.look("alone");
    assert!(
        window.harness.query_by_label("Copy link").is_none(),
        "no panels"
    );
    window.click("Show the panels");
    assert!(
        window.harness.query_by_label("Copy link").is_some(),
        "and back"
    );
}

#[test]
fn every_control_has_a_name() {
    let json = r#"{ "fabrica": 1, "subject": { "builtin": "cube" }, "templates": [
        { "kind": "move" }, { "kind": "slices" }, { "kind": "split" }, { "kind": "cut" }, { "kind": "pull", "mode": "add" } ] }"#;
    let mut window = Window::open(DESK, json);
    let check = |window: &Window, place: &str| {
        let interactive = [
            Role::Button,
            Role::CheckBox,
            Role::Slider,
            Role::SpinButton,
            Role::TextInput,
            Role::ComboBox,
            Role::RadioButton,
            Role::ListItem,
            Role::ColorWell,
        ];
        for node in window.harness.root().children_recursive() {
            let node = node.accesskit_node();
            if interactive.contains(&node.role()) {
                let name = node.label().unwrap_or_default();
                assert!(
                    !name.trim().is_empty(),
                    "{place}: a {:?} without a name, {:?}",
                    node.role(),
                    node.bounding_box()
                );
            }
        }
    };
    check(&window, "start");
    for entry in ["1. Move", "2. Slices", "3. Split", "4. Cut", "5. Pull"] {
        window.click(entry);
        if window.harness.query_by_label("Unfold placement").is_some() {
            window.click("Unfold placement");
        }
        check(&window, entry);
    }
    window.look("desk_inspector");
    for tab in ["Panel: Look", "Panel: Text"] {
        window.click(tab);
        check(&window, tab);
    }
}

#[test]
fn at_rest_nothing_repaints() {
    let mut window = Window::open(DESK, CUBE);
    window.place_peel();
    window.settle();
    // Icons are drawn and messages go by; then there is silence.
    let patience = clock() + 240.0;
    while clock() < patience {
        window.harness.step();
        let delay = window.harness.output().viewport_output[&egui::ViewportId::ROOT].repaint_delay;
        if delay > std::time::Duration::from_secs(1) {
            window.look("desk_icons");
            return;
        }
        std::thread::sleep(std::time::Duration::from_millis(1));
    }
    panic!("still repainting");
}

// ---------------------------------------------------------------------------------------------------- kept tissue

/// What a template leaves alone is chosen in its panel, by a list of the subject's segments, and undone step by step.
#[test]
fn tissue_is_left_alone_by_check_boxes() {
    let mut window = Window::open(DESK, CUBE);
    window.place_peel();
    let get = |window: &Window, key: &str| {
        let pointer = format!("/templates/0/{key}");
        window.document().get(&pointer).cloned()
    };
    window.click("Leaves alone: Tissue");
    assert_eq!(get(&window, "align/to"), Some("segment".into()));
    let before = get(&window, "align/keep");
    window
        .harness
        .get_by_label("Leaves alone: ball")
        .click_accesskit();
    window.settle();
    window.look("keep");
    let keep = get(&window, "align/keep").expect("a set");
    assert_ne!(Some(&keep), before.as_ref(), "the box changes the set");
    assert!(
        keep.as_array()
            .is_some_and(|names| names.contains(&"ball".into())),
        "{keep}"
    );
    window.press_with(Modifiers::COMMAND, Key::Z);
    assert_eq!(get(&window, "align/keep"), before, "one step back");
    window.press_with(Modifiers::COMMAND, Key::Z);
    assert_eq!(get(&window, "align"), None, "nothing is kept by default");

    window.click("Leaves alone: What lies deep");
    assert_eq!(get(&window, "align/to"), Some("surface".into()));
    window
        .harness
        .get_by_label("Gives way to: Acts less")
        .click_accesskit();
    window.settle();
    assert_eq!(get(&window, "constrain/by"), Some("coordinate".into()));
    window.press_with(Modifiers::COMMAND, Key::Z);
    assert_eq!(get(&window, "constrain"), None);
}

#[test]
fn a_drawer_is_scrolled_by_a_finger() {
    let mut window = Window::open(vec2(360.0, 640.0), CUBE);
    // From the first touch on, drags scroll what they do not hold.
    for phase in [egui::TouchPhase::Start, egui::TouchPhase::End] {
        window.harness.event(egui::Event::Touch {
            device_id: egui::TouchDeviceId(1),
            id: egui::TouchId(1),
            phase,
            pos: pos2(5.0, 200.0),
            force: None,
        });
        window.steps(2);
    }
    window.click("Look");
    window.steps(10);
    let height = |window: &Window| {
        let button = window.harness.get_by_label("Background: Paper");
        button.rect().center().y
    };
    let look = window.document().illustration().look.clone();
    // On a name, and on the plot between its points.
    for from in [pos2(30.0, 378.0), pos2(230.0, 480.0)] {
        let before = height(&window);
        window.drag(from, vec2(0.0, -120.0));
        let moved = before - height(&window);
        assert!(moved > 60.0, "from {from}: {moved}");
        window.drag(pos2(from.x, 330.0), vec2(0.0, 240.0));
    }
    assert_eq!(
        window.document().illustration().look,
        look,
        "and nothing else"
    );
}
