//! Recording and playing the steps of a lesson. No window, no device.

use glam::Vec3;

use super::{Command, Found, Session, StepCommand, Tool};
use crate::document::{
    Background, Camera, Caption, Document, Edit, Illustration, ParamValue, PlacedTemplate,
    TemplateKind,
};
use crate::math::Placement;

const LESSON: &str = r#"{ "fabrica": 1, "subject": { "builtin": "cube" }, "camera": { "distance": 2 },
    "templates": [{ "kind": "peel", "amount": 0.25 }, { "kind": "hole", "at": [0.25, 0, 0] }],
    "labels": [{ "text": "a" }],
    "steps": [{ "title": "one", "seconds": 2, "set": { "/templates/0/amount": 0.5 } },
        { "title": "two", "seconds": 1, "hold": 3, "set": { "/templates/0/amount": 1, "/camera/distance": 3 } },
        { "title": "three", "seconds": 1, "hold": 1, "set": { "/templates/1/enabled": false } }] }"#;

fn session_of(json: &str) -> Session {
    let mut session = Session::new(Document::new());
    session.open_document(Document::from_json(json).expect("a document"), 0);
    session.take_effects();
    session
}

fn lesson() -> Session {
    session_of(LESSON)
}

fn run(session: &mut Session, command: Command) {
    let now = session.now;
    session.run(command, now);
}

fn step(session: &mut Session, command: StepCommand) {
    run(session, Command::Step(command));
}

/// Goes to a step at once.
fn show(session: &mut Session, number: usize) {
    session.has_less_motion = true;
    run(session, Command::GoToStep(number));
    session.has_less_motion = false;
    assert_eq!(session.step(), number);
}

fn set_amount(template: usize, amount: f32) -> Edit {
    Edit::SetAmount { template, amount }
}

fn amount(session: &Session) -> f32 {
    session.shown().templates[0].amount
}

/// What somebody sees: templates and captions that are switched on, colours, camera.
#[derive(Clone, Debug, PartialEq)]
struct Seen {
    templates: Vec<PlacedTemplate>,
    captions: Vec<Caption>,
    background: Background,
    camera: Camera,
}

impl Seen {
    fn of(state: &Illustration) -> Self {
        let mut templates = state.templates.clone();
        templates.retain(|template| template.enabled);
        templates.iter_mut().for_each(|t| t.index = 0);
        let captions = state.captions.iter().filter(|caption| caption.enabled);
        Self {
            templates,
            captions: captions.cloned().collect(),
            background: state.look.background,
            camera: state.camera,
        }
    }

    /// Of every step of the document.
    fn all(session: &Session) -> Vec<Self> {
        let lesson = session.document().lesson().expect("a lesson");
        let steps = 0..=session.document().step_count();
        let states = steps.map(|step| lesson.at_step(step).expect("a step"));
        states.map(|state| Self::of(state)).collect()
    }
}

// ---------------------------------------------------------------------------------------- recording

#[test]
fn an_edit_at_a_step_stays_at_the_step() {
    let mut session = lesson();
    let before = Seen::all(&session);
    show(&mut session, 2);
    run(&mut session, Command::Select(Some(0)));
    run(&mut session, Command::Drag(set_amount(0, 0.7)));
    run(&mut session, Command::Drag(set_amount(0, 0.75)));
    session.end_drag();
    assert_eq!((session.step(), session.selection.template()), (2, Some(0)));
    assert_eq!(amount(&session), 0.75);
    assert_eq!(session.illustration().templates[0].amount, 0.25);
    let after = Seen::all(&session);
    assert_eq!(after[..2], before[..2]);
    assert_eq!(after[3].templates[0].amount, 0.75, "until it is set again");
    run(&mut session, Command::Undo);
    assert_eq!(Seen::all(&session), before, "a drag is one step of undo");
    assert_eq!(session.step(), 2);
    // Who is elsewhere is taken to what changes.
    show(&mut session, 0);
    run(&mut session, Command::Redo);
    assert_eq!((session.step(), amount(&session)), (2, 0.75));
    // The middle of a passage is no step: the edit is done at the one that it leads to.
    run(&mut session, Command::GoToStep(1));
    session.advance(0.5);
    assert!(session.mode.is_moving());
    run(&mut session, Command::Apply(set_amount(0, 0.375)));
    assert_eq!((session.step(), amount(&session)), (1, 0.375));
    assert!(!session.mode.is_between());
}

#[test]
fn what_is_placed_at_a_step_is_there_from_then_on() {
    let mut session = lesson();
    let before = Seen::all(&session);
    show(&mut session, 2);
    run(&mut session, Command::StartPlacing(TemplateKind::Split));
    assert_eq!(
        (session.step(), session.tool()),
        (2, Tool::Place(TemplateKind::Split))
    );
    let found = Found {
        object: None,
        pos: Vec3::new(0.0, 0.5, 0.0),
        normal: Vec3::Y,
        pos_in_rest: Vec3::new(0.0, 0.5, 0.0),
        value: 1.0,
        segment: None,
    };
    run(&mut session, Command::PlaceOn(Some(found)));
    assert_eq!((session.step(), session.selection.template()), (2, Some(2)));
    run(&mut session, Command::ToggleCaptioning);
    run(&mut session, Command::CaptionOn(Some(found)));
    let after = Seen::all(&session);
    assert_eq!(after[..2], before[..2]);
    for number in [2, 3] {
        let [new, old] = [&after[number], &before[number]];
        assert_eq!(new.templates.len(), old.templates.len() + 1);
        assert_eq!(new.captions.len(), old.captions.len() + 1);
        assert_eq!(new.templates.last().map(|t| t.amount), Some(1.0));
    }
    assert_eq!(Seen::of(session.shown()), after[2]);
    // A copy of a template is made of what the step shows.
    run(&mut session, Command::Select(Some(0)));
    run(&mut session, Command::DuplicateSelected);
    let copy = &Seen::all(&session)[2].templates[1];
    assert_eq!((copy.kind, copy.amount), (TemplateKind::Peel, 1.0));
    for _ in 0..3 {
        run(&mut session, Command::Undo);
    }
    assert_eq!(Seen::all(&session), before);
    for _ in 0..2 {
        run(&mut session, Command::Redo);
    }
    assert_eq!(Seen::all(&session), after);
}

#[test]
fn what_is_deleted_at_a_step_is_hidden_from_then_on() {
    let mut session = lesson();
    let before = Seen::all(&session);
    show(&mut session, 2);
    run(&mut session, Command::Select(Some(0)));
    run(&mut session, Command::DeleteSelected);
    assert_eq!(session.selection.template(), None);
    assert_eq!(session.notices.shown().count(), 1, "it says so");
    let after = Seen::all(&session);
    assert_eq!(after[..2], before[..2]);
    assert_eq!([after[2].templates.len(), after[3].templates.len()], [1, 0]);
    run(
        &mut session,
        Command::Apply(Edit::RemoveCaption { caption: 0 }),
    );
    assert_eq!(Seen::all(&session)[3].captions.len(), 0);
    assert_eq!(session.illustration().captions.len(), 1);
    run(&mut session, Command::Undo);
    run(&mut session, Command::Undo);
    assert_eq!(Seen::all(&session), before);
    // In the document itself it goes for good, and the pointers of all steps follow.
    show(&mut session, 0);
    run(&mut session, Command::Select(Some(0)));
    run(&mut session, Command::DeleteSelected);
    assert_eq!(session.template_count(), 1);
    assert_eq!(
        session
            .document()
            .get("/steps/2/set/~1templates~10~1enabled"),
        Some(&serde_json::json!(false)),
        "renumbered"
    );
    assert_eq!(Seen::all(&session)[3].templates.len(), 0, "the hole");
}

#[test]
fn an_order_holds_for_all_steps() {
    let mut session = lesson();
    show(&mut session, 3);
    run(&mut session, Command::Select(Some(0)));
    run(&mut session, Command::ShiftSelected(1));
    assert_eq!((session.step(), session.selection.template()), (3, Some(1)));
    assert_eq!(session.notices.shown().count(), 1, "it says so");
    let kinds = |state: &Seen| -> Vec<_> { state.templates.iter().map(|t| t.kind).collect() };
    let (peel, hole) = (TemplateKind::Peel, TemplateKind::Hole);
    let all: Vec<_> = Seen::all(&session).iter().map(kinds).collect();
    assert_eq!(
        all[..3],
        [vec![hole, peel], vec![hole, peel], vec![hole, peel]]
    );
    assert_eq!(all[3], [peel]);
    assert_eq!(Seen::all(&session)[1].templates[1].amount, 0.5);
}

#[test]
fn a_new_step_shows_what_is_seen() {
    let mut session = session_of(r#"{ "fabrica": 1, "subject": { "builtin": "cube" } }"#);
    run(&mut session, Command::Orbit(0.5, 0.25));
    let first = session.camera;
    step(&mut session, StepCommand::Add);
    assert_eq!((session.step(), session.document().step_count()), (1, 1));
    assert!(
        session
            .illustration()
            .camera
            .rotate
            .angle_between(first.rotate)
            < 1e-3
    );
    assert_eq!(
        session.document().get("/steps/0/set"),
        None,
        "nothing differs"
    );
    run(&mut session, Command::Zoom(1.5));
    assert!(session.is_view_other());
    step(&mut session, StepCommand::Add);
    let set = session.document().get("/steps/1/set").cloned();
    let keys: Vec<String> = set
        .as_ref()
        .and_then(|set| set.as_object())
        .map(|set| set.keys().cloned().collect())
        .unwrap_or_default();
    assert_eq!(keys, ["/camera/distance"]);
    // The view is taken into the step that is shown.
    run(&mut session, Command::Zoom(1.2));
    step(&mut session, StepCommand::Update);
    let seen = Seen::all(&session);
    assert!((seen[2].camera.distance - session.camera.distance).abs() < 1e-3);
    assert!((seen[1].camera.distance - first.distance).abs() < 1e-3);
    run(&mut session, Command::Undo);
    run(&mut session, Command::Undo);
    assert_eq!((session.document().step_count(), session.step()), (1, 1));
    run(&mut session, Command::Redo);
    assert_eq!((session.document().step_count(), session.step()), (2, 2));
    // At the start the view is that of the document.
    show(&mut session, 0);
    run(&mut session, Command::Orbit(0.5, 0.25));
    step(&mut session, StepCommand::Update);
    assert!(
        session
            .illustration()
            .camera
            .rotate
            .angle_between(session.camera.rotate)
            < 1e-3
    );
}

#[test]
fn steps_are_ordered_copied_and_deleted() {
    let mut session = lesson();
    let before = Seen::all(&session);
    let mut check = |command: StepCommand, shown: usize, order: &[usize]| {
        step(&mut session, command.clone());
        assert_eq!(session.step(), shown, "{command:?}");
        let seen = Seen::all(&session);
        let expected: Vec<Seen> = order.iter().map(|&old| before[old].clone()).collect();
        assert_eq!(seen, expected, "{command:?}");
        assert_eq!(Seen::of(session.shown()), seen[shown]);
        run(&mut session, Command::Undo);
        assert_eq!(Seen::all(&session), before, "{command:?}");
    };
    check(StepCommand::Duplicate(2), 3, &[0, 1, 2, 2, 3]);
    check(StepCommand::Duplicate(0), 1, &[0, 0, 1, 2, 3]);
    check(StepCommand::Move { from: 3, to: 1 }, 1, &[0, 3, 1, 2]);
    check(StepCommand::Move { from: 1, to: 3 }, 3, &[0, 2, 3, 1]);
    show(&mut session, 2);
    step(&mut session, StepCommand::Delete(2));
    assert_eq!(session.step(), 2);
    assert_eq!(Seen::of(session.shown()), before[3]);
    for nothing in [
        StepCommand::Delete(0),
        StepCommand::Move { from: 0, to: 1 },
        StepCommand::Move { from: 1, to: 0 },
    ] {
        let document = session.document().clone();
        step(&mut session, nothing);
        assert_eq!(*session.document(), document);
    }
    step(&mut session, StepCommand::Delete(2));
    step(&mut session, StepCommand::Delete(1));
    assert_eq!((session.step(), session.document().step_count()), (0, 0));
}

// ---------------------------------------------------------------------------------------- many edits

/// Numbers that look random.
struct Dice(u64);

impl Dice {
    fn below(&mut self, sides: usize) -> usize {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (self.0 >> 33) as usize % sides
    }
}

/// One edit of what is shown; its place tells a new template from all others.
fn any_edit(session: &Session, dice: &mut Dice, number: usize) -> Option<Edit> {
    let count = session.template_count();
    let captions = session.illustration().captions.len();
    let value = (1 + dice.below(99)) as f32 / 100.0;
    let place = Placement {
        at: Vec3::new(number as f32 / 100.0, value, 0.0),
        ..Placement::DOCUMENT_DEFAULT
    };
    let of = |all: usize, dice: &mut Dice| (all > 0).then(|| dice.below(all));
    Some(match dice.below(10) {
        0 => Edit::AddTemplate {
            index: dice.below(count + 1),
            kind: TemplateKind::Peel,
            placement: place,
        },
        1 => Edit::RemoveTemplate {
            template: of(count, dice)?,
        },
        2 => Edit::DuplicateTemplate {
            template: of(count, dice)?,
        },
        3 => Edit::SetEnabled {
            template: of(count, dice)?,
            enabled: dice.below(2) == 0,
        },
        4 => Edit::SetParam {
            template: of(count, dice)?,
            param: "progress",
            value: ParamValue::Number(value),
        },
        5 => Edit::AddCaption(Caption {
            at: place.at,
            text: format!("caption {number}"),
            enabled: true,
        }),
        6 => Edit::RemoveCaption {
            caption: of(captions, dice)?,
        },
        7 => Edit::SetBackground(Background::Color([number as u8; 3])),
        8 => Edit::SetCamera(Camera {
            distance: 2.0 + value,
            ..session.shown().camera
        }),
        _ => Edit::SetPlacement {
            template: of(count, dice)?,
            placement: place,
        },
    })
}

/// Whatever is done at whichever step: the step is afterwards what the editor showed, the steps before are what they
/// were, and whole steps keep what they show wherever they go.
#[test]
fn every_step_is_what_the_editor_showed() {
    for seed in 0..24 {
        let mut dice = Dice(seed);
        let first = r#"{ "fabrica": 1, "subject": { "builtin": "cube" }, "templates": [{ "kind": "peel" }] }"#;
        let mut session = session_of(first);
        let start = session.document().clone();
        for number in 0..40 {
            let count = session.document().step_count();
            if dice.below(3) == 0 {
                let to = dice.below(count + 1);
                show(&mut session, to);
            }
            let shown = session.step();
            let mut expected = Seen::all(&session);
            let trace = format!("seed {seed}, edit {number} at step {shown}");
            let any = 1 + dice.below(count.max(1));
            match dice.below(12) {
                0 | 1 => {
                    // Somebody looks from where an edit may not have gone.
                    let camera = session.camera;
                    step(&mut session, StepCommand::Add);
                    if count == 0 {
                        expected[0].camera = camera;
                    }
                    let seen = expected[shown].clone();
                    expected.insert(shown + 1, Seen { camera, ..seen });
                }
                2 => {
                    step(&mut session, StepCommand::Duplicate(shown));
                    expected.insert(shown + 1, expected[shown].clone());
                }
                3 if count > 0 => {
                    step(&mut session, StepCommand::Delete(any));
                    expected.remove(any);
                }
                4 if count > 0 => {
                    let to = 1 + dice.below(count);
                    step(&mut session, StepCommand::Move { from: any, to });
                    let moved = expected.remove(any);
                    expected.insert(to, moved);
                }
                _ => {
                    let Some(edit) = any_edit(&session, &mut dice, number) else {
                        continue;
                    };
                    let before = session.document().at_step(shown).expect("a step");
                    run(&mut session, Command::Apply(edit.clone()));
                    let after = Seen::all(&session);
                    assert_eq!(session.step(), shown, "{trace}: {edit:?}");
                    assert_eq!(after[..shown], expected[..shown], "{trace}: {edit:?}");
                    let seen = Seen::of(session.shown());
                    assert_eq!(seen, after[shown], "{trace}: {edit:?}");
                    let wanted = edit.apply(&before).expect("an edit");
                    let mut wanted = Seen::of(wanted.illustration());
                    // A template of a later step, which is nothing yet, is whole when it is switched on.
                    let is_nothing = |t: &&mut PlacedTemplate| t.amount == 0.0;
                    let nothing = wanted.templates.iter_mut().filter(is_nothing);
                    nothing.for_each(|template| template.amount = 1.0);
                    assert_eq!(seen, wanted, "{trace}: {edit:?}");
                    expected = after;
                }
            }
            assert_eq!(Seen::all(&session), expected, "{trace}");
            let now = session.step();
            assert_eq!(Seen::of(session.shown()), expected[now], "{trace}");
        }
        let end = session.document().clone();
        while session.history.undo_name().is_some() {
            run(&mut session, Command::Undo);
        }
        assert_eq!(*session.document(), start, "seed {seed}: all undone");
        while session.history.redo_name().is_some() {
            run(&mut session, Command::Redo);
        }
        assert_eq!(*session.document(), end, "seed {seed}: all done again");
    }
}

// ---------------------------------------------------------------------------------------- playing

/// The greatest change of the amount from frame to frame, at 50 frames a second, until nothing moves.
fn fastest(session: &mut Session, end: f64) -> f32 {
    let (mut most, mut before) = (0.0_f32, amount(session));
    while session.now < end {
        let now = session.now + 0.02;
        session.advance(now);
        most = most.max((amount(session) - before).abs());
        before = amount(session);
    }
    most
}

/// A lesson of five passages of a second, each of which adds a tenth to the amount.
fn steady() -> Session {
    let steps: Vec<String> = (1..=5)
        .map(|n| {
            format!(
                r#"{{ "set": {{ "/templates/0/amount": {} }} }}"#,
                f64::from(n) / 10.0
            )
        })
        .collect();
    session_of(&format!(
        r#"{{ "fabrica": 1, "templates": [{{ "kind": "peel", "amount": 0 }}], "steps": [{}] }}"#,
        steps.join(",")
    ))
}

#[test]
fn an_interrupted_passage_goes_on_from_what_is_shown() {
    let mut session = steady();
    run(&mut session, Command::GoToStep(1));
    let undisturbed = fastest(&mut session, 1.5);
    assert!(undisturbed > 0.002 && amount(&session) == 0.1);
    for moment in [0.1, 0.3, 0.5, 0.7, 0.9] {
        for (first, second) in [(2, 1), (2, 3), (0, 1), (0, 2)] {
            let mut session = steady();
            show(&mut session, 1);
            run(&mut session, Command::GoToStep(first));
            fastest(&mut session, moment);
            let before = amount(&session);
            run(&mut session, Command::GoToStep(second));
            session.advance(session.now);
            if first.abs_diff(second) == 1 {
                assert_eq!(amount(&session), before, "{first} to {second} at {moment}");
                let again = session.now + 0.25;
                let mut most = fastest(&mut session, again);
                // And again in the middle of that one.
                run(&mut session, Command::GoToStep(first));
                most = most.max(fastest(&mut session, 9.0));
                assert!(
                    most <= undisturbed * 1.01,
                    "{most} at {moment}: {first}, {second}"
                );
                assert_eq!(session.step(), first);
                assert!((amount(&session) - 0.1 * first as f32).abs() < 1e-6);
            } else {
                assert_eq!(session.step(), second, "further at once");
                assert!((amount(&session) - 0.1 * second as f32).abs() < 1e-6);
            }
            assert!(!session.mode.is_between());
        }
    }
}

#[test]
fn a_turn_that_was_interrupted_is_completed() {
    let mut session = lesson();
    show(&mut session, 1);
    run(&mut session, Command::GoToStep(2));
    session.advance(session.now + 0.5);
    let middle = session.camera.distance;
    assert!(middle > 2.1 && middle < 2.9, "{middle}");
    // The third step does not turn the camera, but the second did.
    run(&mut session, Command::GoToStep(3));
    assert_eq!(session.camera.distance, middle);
    session.advance(session.now + 9.0);
    assert_eq!((session.step(), session.camera.distance), (3, 3.0));
}

#[test]
fn the_lesson_is_scrubbed_and_played_from_there() {
    let mut session = lesson();
    step(&mut session, StepCommand::Scrub(0.5));
    assert_eq!((session.step(), session.position()), (1, 0.5));
    assert!((amount(&session) - 0.375).abs() < 1e-6, "half way");
    assert!(session.is_paused() && !session.advance(5.0));
    step(&mut session, StepCommand::Scrub(1.5));
    assert_eq!(session.step(), 2);
    assert!((session.camera.distance - 2.5).abs() < 1e-3);
    step(&mut session, StepCommand::Scrub(3.0));
    assert_eq!((session.step(), session.camera.distance), (3, 3.0));
    assert_eq!(Seen::of(session.shown()), Seen::all(&session)[3]);
    step(&mut session, StepCommand::Scrub(-1.0));
    assert_eq!(session.step(), 0);
    step(&mut session, StepCommand::Scrub(99.0));
    assert_eq!(session.step(), 3);

    step(&mut session, StepCommand::Scrub(1.5));
    let before = amount(&session);
    step(&mut session, StepCommand::TogglePlay);
    assert_eq!(amount(&session), before, "from what is shown");
    assert!(session.is_playing() && session.position() == 1.5);
    let at = session.now;
    // Half of a way takes more than half of its time, since it begins slowly, too.
    assert!(session.advance(at + 0.6));
    session.advance(at + 0.75);
    session.advance(at + 0.8);
    assert_eq!((session.step(), amount(&session)), (2, 1.0));
    let wait = session.seconds_to_next_change().expect("it goes on");
    assert!(wait < 3.1, "{wait}");
    // It stays for three seconds, goes on for one, and ends.
    session.advance(at + 3.6);
    assert_eq!(session.step(), 2);
    assert!(session.advance(at + 3.9));
    assert_eq!(session.step(), 3);
    session.advance(at + 5.0);
    session.advance(at + 5.1);
    assert!(!session.is_playing());
    assert_eq!(session.position(), 3.0);
    // At the end it begins again, and an edit ends it.
    step(&mut session, StepCommand::TogglePlay);
    assert_eq!((session.step(), session.is_playing()), (0, true));
    run(&mut session, Command::Apply(set_amount(0, 0.3)));
    assert!(!session.is_playing());
    // Stopped in the middle it stands still there.
    step(&mut session, StepCommand::TogglePlay);
    let at = session.now;
    session.advance(at + 1.0);
    run(&mut session, Command::Escape);
    assert!(session.is_paused() && !session.is_playing());
    let position = session.position();
    session.advance(at + 9.0);
    assert_eq!(session.position(), position);
    run(&mut session, Command::WalkStep(true));
    assert_eq!(session.step(), 1, "first to the end of the passage");
    session.advance(at + 19.0);
    assert!(!session.mode.is_between());
}

#[test]
fn nothing_moves_for_whom_that_is_too_much() {
    let mut session = lesson();
    session.has_less_motion = true;
    run(&mut session, Command::WalkStep(true));
    assert_eq!((session.step(), amount(&session)), (1, 0.5));
    assert!(!session.advance(0.0) && !session.is_playing());
    step(&mut session, StepCommand::Scrub(1.6));
    assert_eq!((session.step(), session.camera.distance), (2, 3.0));
    run(&mut session, Command::View(super::StandardView::ALL[2]));
    assert!(!session.advance(0.0), "no glide");
    step(&mut session, StepCommand::Scrub(0.0));
    // Who presses the button sees one step after the other.
    step(&mut session, StepCommand::TogglePlay);
    assert_eq!((session.step(), amount(&session)), (1, 0.5));
    session.advance(0.1);
    session.advance(4.2);
    assert_eq!((session.step(), amount(&session)), (2, 1.0));
}
