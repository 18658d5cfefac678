//! What commands do to the session and what they want done outside. No window, no device.

use glam::Vec3;
use serde_json::{Value, json};

use super::{
    Command, Effect, Focus, Found, Gravity, LinkChange, Notice, Place, Question, RawCommand, See,
    Session, Tab, Ticket, TissueCommand, Tool,
};
use crate::app::session::RecentChange;
use crate::assets::RawQuestion;
use crate::clay::MeshFormat;
use crate::document::{Document, Edit, SubjectRef, TemplateKind};
use crate::link::Link;

/// A document with two templates, one of a group, and a lesson of two steps.
const LESSON: &str = r#"{
    "fabrica": 1,
    "title": "Two Steps!",
    "camera": { "distance": 2.0 },
    "templates": [
        { "kind": "peel", "group": "lid", "at": [0, 0, 0.4] },
        { "kind": "hole", "group": "lid", "at": [0.1, 0, 0.4] }
    ],
    "steps": [
        { "title": "first", "seconds": 2, "set": { "/templates/0/amount": 0.5, "/camera/distance": 3.0 } },
        { "title": "second", "seconds": 0, "set": { "/templates/1/enabled": false } }
    ]
}"#;

fn session_of(json: &str) -> Session {
    let document = Document::from_json(json).expect("a valid document");
    let mut session = Session::new(Document::new());
    session.open_document(document, 0);
    session.take_effects();
    session
}

fn lesson() -> Session {
    session_of(LESSON)
}

fn empty() -> Session {
    session_of(r#"{ "fabrica": 1 }"#)
}

/// Runs a command at a time of 0 and returns its effects.
fn run(session: &mut Session, command: Command) -> Vec<Effect> {
    session.run(command, 0.0)
}

fn found() -> Found {
    Found {
        object: None,
        pos: Vec3::new(0.1, 0.45, 0.2),
        normal: Vec3::Y,
        pos_in_rest: Vec3::new(0.1, 0.4, 0.2),
        value: 120.0,
        segment: None,
    }
}

/// The only question among effects.
fn question(effects: Vec<Effect>) -> Question {
    let mut questions = effects.into_iter().filter_map(|effect| match effect {
        Effect::Ask(question) => Some(question),
        _ => None,
    });
    let question = questions.next().expect("a question");
    assert!(questions.next().is_none(), "one question only");
    question
}

fn answer(session: &mut Session, question: &Question, found: Option<Found>) {
    run(session, (question.reply)(question.index, found));
}

fn last_notice(session: &Session) -> Option<Gravity> {
    session.notices.all().last().map(|notice| notice.gravity)
}

/// A document with a recipe that grows from seeds, open for editing.
fn growing() -> Session {
    let mut session = session_of(
        r#"{ "fabrica": 1, "subject": { "builtin": "cube", "features": [
            { "name": "core", "from": { "grow": { "seeds": [], "range": [100, 200] } } }
        ] } }"#,
    );
    assert_eq!(
        session.illustration().recipes.len(),
        1,
        "the recipe is read"
    );
    run(&mut session, Command::Tissue(TissueCommand::Open(Some(0))));
    session
}

// ---------------------------------------------------------------------------------------- tools

/// Every way to take a tool in hand, with the tool.
fn ways() -> [(Command, Tool); 6] {
    [
        (
            Command::StartPlacing(TemplateKind::Peel),
            Tool::Place(TemplateKind::Peel),
        ),
        (Command::ToggleCaptioning, Tool::Caption),
        (Command::Tissue(TissueCommand::Seed(true)), Tool::Seed(0)),
        (
            Command::Tissue(TissueCommand::Ball(Some(false))),
            Tool::Paint {
                recipe: 0,
                erases: false,
            },
        ),
        (Command::See(See::ToggleMeasure), Tool::Measure(None)),
        (Command::See(See::ToggleLevel), Tool::Level),
    ]
}

#[test]
fn a_tool_takes_the_place_of_any_other() {
    for (first, before) in ways() {
        for (second, after) in ways() {
            let mut session = growing();
            run(&mut session, first.clone());
            assert_eq!(session.tool(), before);
            if before == after {
                continue;
            }
            run(&mut session, second);
            assert_eq!(session.tool(), after, "after {first:?}");
            run(&mut session, Command::Escape);
            assert_eq!(session.tool(), Tool::Look, "one Escape is enough");
        }
    }
}

#[test]
fn a_caption_under_way_ends_when_a_template_is_placed() {
    let mut session = empty();
    run(&mut session, Command::ToggleCaptioning);
    run(&mut session, Command::StartPlacing(TemplateKind::Peel));
    let asked = question(run(&mut session, Command::PlaceInMiddle));
    assert!(matches!(asked.place, Place::Middle), "{asked:?}");
    answer(&mut session, &asked, Some(found()));
    assert_eq!(session.template_count(), 1);
    assert_eq!(session.selection.template(), Some(0));
    assert_eq!(session.tool(), Tool::Look);
    assert!(session.illustration().captions.is_empty());
}

#[test]
fn the_same_command_again_puts_the_tool_away() {
    for (command, tool) in ways() {
        if tool.is_for_tissue() {
            continue;
        }
        let mut session = empty();
        run(&mut session, command.clone());
        run(&mut session, command);
        assert_eq!(session.tool(), Tool::Look);
    }
}

#[test]
fn a_click_asks_for_its_tool_and_looking_asks_nothing() {
    let mut session = empty();
    session.are_drawers = true;
    let click = || Command::UseToolAt([12.0, 34.0]);
    assert!(run(&mut session, click()).is_empty());
    run(&mut session, Command::ToggleCaptioning);
    let asked = question(run(&mut session, click()));
    assert!(matches!(asked.place, Place::Pixel([12.0, 34.0])));
    answer(&mut session, &asked, None);
    assert_eq!(
        last_notice(&session),
        Some(Gravity::Info),
        "nothing is there"
    );
    assert_eq!(session.tool(), Tool::Caption, "the next click may hit");
    let effects = run(&mut session, (asked.reply)(0, Some(found())));
    assert!(
        matches!(effects[..], [Effect::Focus(Focus::Caption(0))]),
        "{effects:?}"
    );
    let captions = &session.illustration().captions;
    assert_eq!(captions[0].at, found().pos_in_rest, "fastened to tissue");
    let drawer = session.tab;
    assert_eq!((session.side_tab, drawer), (Tab::Text, Some(Tab::Text)));
    // An answer that comes too late does nothing.
    answer(&mut session, &asked, Some(found()));
    assert_eq!(session.illustration().captions.len(), 1);
}

#[test]
fn a_newer_click_makes_an_open_one_pointless() {
    let at = |x| Question::new(Place::Pixel([x, 0.0]), |_, found| Command::LookAt(found));
    assert!(at(1.0).replaces(&at(2.0)));
    let mut session = lesson();
    run(&mut session, Command::Select(Some(0)));
    let beside = question(run(&mut session, Command::LayOnSurface));
    assert!(!beside.replaces(&at(1.0)) && !at(1.0).replaces(&beside));
    let other = question(run(&mut session, Command::LayOnSurface));
    assert!(other.replaces(&beside));
    // Both ends of a distance are asked for, however late the answer to the first comes.
    run(&mut session, Command::See(See::ToggleMeasure));
    let [first, second] =
        [1.0, 2.0].map(|x| question(run(&mut session, Command::UseToolAt([x, 0.0]))));
    assert!(!second.replaces(&first) && at(1.0).replaces(&second));
}

#[test]
fn two_points_are_a_distance_and_escape_goes_back() {
    let mut session = empty();
    run(&mut session, Command::See(See::ToggleMeasure));
    let measure = |pos| Command::Measure(Some(pos));
    for pos in [Vec3::X, Vec3::NAN, Vec3::Y] {
        run(&mut session, measure(pos));
    }
    assert_eq!(session.view.measures.lines(), [[Vec3::X, Vec3::Y]]);
    run(&mut session, measure(Vec3::Z));
    run(&mut session, Command::Escape);
    assert_eq!(session.tool(), Tool::Measure(None), "first the point");
    run(&mut session, Command::Escape);
    assert_eq!(session.tool(), Tool::Look, "then measuring");
    assert_eq!(session.view.measures.lines().len(), 1, "distances stay");
    run(&mut session, measure(Vec3::Z));
    assert_eq!(session.tool(), Tool::Look, "a late answer does nothing");
}

#[test]
fn seeds_widen_the_range_of_their_recipe() {
    let mut session = growing();
    run(&mut session, Command::Tissue(TissueCommand::Seed(true)));
    let asked = question(run(&mut session, Command::UseToolAt([1.0, 1.0])));
    let low = Found {
        value: 40.0,
        ..found()
    };
    answer(&mut session, &asked, Some(low));
    let from = &session.illustration().recipes[0].from;
    assert_eq!(from.range(), Some([40.0, 200.0]));
    assert_eq!(session.tool(), Tool::Seed(0), "more may follow");
    run(&mut session, Command::Tissue(TissueCommand::Open(None)));
    assert_eq!(session.tool(), Tool::Look, "closed, it grows no more");
}

#[test]
fn a_template_follows_the_surface_once_every_place_is_known() {
    let mut session = lesson();
    run(&mut session, Command::Select(Some(1)));
    let effects = run(&mut session, Command::FollowSurface);
    let placed = session.selected_template().expect("selected").placement;
    let mut asked = 0;
    for effect in effects {
        let Effect::Ask(question) = effect else {
            continue;
        };
        let Place::Beside(sight, pos) = &question.place else {
            panic!("a view of its own: {question:?}");
        };
        assert_eq!(sight.illustration.templates.len(), 1, "the ones before it");
        // A roof with its ridge in the middle.
        let x = placed.template_from_subject(*pos).x;
        let at = Vec3::new(x, 0.5, 0.9 - 0.6 * (x - 0.5).abs());
        let hit = Found {
            pos: placed.subject_from_template(at),
            ..found()
        };
        asked += 1;
        assert!(
            session
                .selected_template()
                .expect("selected")
                .curve
                .is_none()
        );
        answer(&mut session, &question, Some(hit));
    }
    assert_eq!(asked, 7);
    assert!(
        session
            .selected_template()
            .expect("selected")
            .curve
            .is_some()
    );
}

// ---------------------------------------------------------------------------------------- author and lesson

#[test]
fn a_lesson_has_no_tools_of_authors() {
    for (command, tool) in ways() {
        let mut session = growing();
        session.open_document(Document::from_json(LESSON).expect("valid"), 0);
        let is_there = !tool.is_for_tissue();
        run(&mut session, command.clone());
        assert_eq!(session.tool() == tool, is_there, "{tool:?}");
        run(&mut session, Command::GoToStep(2));
        let kept = if tool.is_for_authors() {
            Tool::Look
        } else {
            tool
        };
        assert_eq!((session.step(), session.tool()), (2, kept));
        run(&mut session, command);
        assert_eq!(session.step(), 2, "taking {tool:?} stays at the step");
    }
}

#[test]
fn a_link_opens_at_its_step_and_tells_of_one_that_is_not_there() {
    for (step, shown) in [(0, 0), (1, 1), (9, 2)] {
        let mut session = growing();
        let document = Document::from_json(LESSON).expect("valid");
        session.open_link(Link { document, step });
        assert_eq!(session.step(), shown);
        let tells = |notice: &&Notice| notice.message.contains("step 9");
        let told = session.notices.shown().filter(tells).count();
        assert_eq!(told, usize::from(step == 9), "of step {step}");
    }
}

#[test]
fn a_passage_goes_with_the_clock_and_back() {
    let mut session = lesson();
    let amount = |session: &Session| session.shown().templates[0].amount;
    run(&mut session, Command::WalkStep(true));
    assert_eq!((session.step(), amount(&session)), (1, 1.0));
    assert!(session.advance(1.0), "on the way");
    let middle = amount(&session);
    assert!(middle > 0.5 && middle < 1.0, "{middle}");
    let distance = session.camera.distance;
    assert!(distance > 2.0 && distance < 3.0, "{distance}");
    session.advance(2.5);
    assert_eq!((amount(&session), session.camera.distance), (0.5, 3.0));
    assert!(!session.advance(2.6), "there");
    session.run(Command::WalkStep(false), 3.0);
    session.advance(9.0);
    assert_eq!((session.step(), amount(&session)), (0, 1.0));
    assert_eq!(session.shown(), session.illustration());
}

#[test]
fn a_change_stays_at_its_step() {
    let mut session = lesson();
    run(&mut session, Command::GoToStep(2));
    assert_ne!(session.shown(), session.illustration());
    // What is selected is shown as the step has it.
    run(&mut session, Command::SelectNext(true));
    assert_eq!((session.step(), session.selection.template()), (2, Some(0)));
    run(&mut session, Command::Select(Some(0)));
    assert_eq!((session.step(), session.selection.template()), (2, Some(0)));
    let shown = session.selected_template();
    assert_eq!(shown, session.shown().templates.first());
    assert_ne!(shown, session.illustration().templates.first());
    let edit = Edit::SetTitle("Other".to_owned());
    run(&mut session, Command::Apply(edit));
    assert_eq!((session.step(), session.selection.template()), (2, Some(0)));
    assert_eq!(session.illustration().title, "Other");
}

// ---------------------------------------------------------------------------------------- changes

#[test]
fn a_drag_is_one_step_of_undo() {
    let mut session = lesson();
    let title = |text: &str| Command::Drag(Edit::SetTitle(text.to_owned()));
    for text in ["a", "ab", "abc"] {
        run(&mut session, title(text));
    }
    session.end_drag();
    run(&mut session, title("abcd"));
    assert_eq!(session.illustration().title, "abcd");
    run(&mut session, Command::Undo);
    assert_eq!(session.illustration().title, "abc");
    run(&mut session, Command::Undo);
    assert_eq!(session.illustration().title, "Two Steps!");
    run(&mut session, Command::Redo);
    assert_eq!(session.illustration().title, "abc");
}

#[test]
fn undo_loads_the_subject_that_it_brings_back() {
    let mut session = empty();
    let before = session.illustration().subject.clone();
    let other = SubjectRef::Builtin {
        name: "cube".to_owned(),
        revision: 1,
    };
    assert_ne!(before, other);
    let effects = run(&mut session, Command::SetSubject(other.clone()));
    assert!(matches!(&effects[..], [Effect::LoadSubject(s)] if *s == other));
    let effects = run(&mut session, Command::SetSubject(other));
    assert!(effects.is_empty(), "it is on its way");
    let effects = run(&mut session, Command::Undo);
    assert!(matches!(&effects[..], [Effect::LoadSubject(s)] if *s == before));
}

#[test]
fn a_group_moves_with_its_template_unless_the_key_is_held() {
    let place = |session: &Session, index: usize| {
        let template = session.template(index).expect("a template");
        template.placement
    };
    for is_alone in [false, true] {
        let mut session = lesson();
        session.is_alone = is_alone;
        let other = place(&session, 1).at;
        let mut placement = place(&session, 0);
        placement.at += Vec3::X * 0.25;
        let edit = Edit::SetPlacement {
            template: 0,
            placement,
        };
        run(&mut session, Command::Drag(edit));
        let moved = place(&session, 1).at - other;
        let expected = if is_alone { Vec3::ZERO } else { Vec3::X * 0.25 };
        assert!(moved.distance(expected) < 1e-6, "{moved}");
    }
}

#[test]
fn what_is_cut_can_be_pasted() {
    let mut session = lesson();
    run(&mut session, Command::Select(Some(0)));
    let effects = run(&mut session, Command::Cut);
    assert!(matches!(&effects[..], [Effect::Copy(_)]), "{effects:?}");
    assert_eq!(session.template_count(), 0, "with its group");
    assert!(matches!(
        run(&mut session, Command::Paste)[..],
        [Effect::Paste]
    ));
    // The clipboard may not be read: what was cut here is taken.
    session.take_pasted(None);
    assert_eq!(session.template_count(), 2);
    run(&mut session, Command::Undo);
    run(&mut session, Command::Undo);
    assert_eq!(session.template_count(), 2, "cutting is one step of undo");
}

// ---------------------------------------------------------------------------------------- the link

#[test]
fn the_link_is_renewed_when_the_hand_rests() {
    let mut session = lesson();
    run(&mut session, Command::Orbit(0.3, 0.1));
    assert!(session.take_effects().is_empty(), "not while it moves");
    session.advance(0.2);
    assert!(session.take_effects().is_empty());
    session.advance(0.5);
    let effects = session.take_effects();
    let [
        Effect::SetLink(tail, LinkChange::Replace),
        Effect::Store(key, kept),
    ] = &effects[..]
    else {
        panic!("{effects:?}");
    };
    assert_eq!((*key, kept), ("document", tail));
    let read = crate::link::decode(tail).expect("a link");
    let camera = read.document.illustration().camera;
    assert!(camera.rotate.abs_diff_eq(session.camera.rotate, 1e-3));
    run(&mut session, Command::GoToStep(2));
    session.advance(1.0);
    let effects = session.take_effects();
    assert!(
        matches!(&effects[0], Effect::SetLink(tail, LinkChange::Push) if tail.ends_with("&step=2")),
        "{effects:?}"
    );
}

#[test]
fn a_copied_link_is_told_and_ends_the_hint() {
    let mut session = lesson();
    session.has_hint = true;
    let effects = run(&mut session, Command::CopyLink);
    assert!(matches!(&effects[0], Effect::Store("hint", _)));
    assert!(matches!(effects.last(), Some(Effect::CopyLink(tail)) if *tail == session.link_tail()));
    session.copied(Ok(()));
    assert!(session.copied_at.is_some());
    assert_eq!(last_notice(&session), Some(Gravity::Success));
    session.copied(Err("no".to_owned()));
    assert_eq!(last_notice(&session), Some(Gravity::Error));
}

#[test]
fn a_copied_link_that_others_cannot_open_is_told() {
    let own = format!(
        r#"{{ "fabrica": 1, "subject": {{ "sha256": "{}", "name": "scan.nrrd" }} }}"#,
        "5c".repeat(32)
    );
    let mut session = session_of(&own);
    let _effects = run(&mut session, Command::CopyLink);
    session.copied(Ok(()));
    assert_eq!(last_notice(&session), Some(Gravity::Warning));
    session.copied(Err("no".to_owned()));
    assert_eq!(last_notice(&session), Some(Gravity::Error));
}

#[test]
fn a_saved_document_is_named_for_its_title() {
    let effects = run(&mut lesson(), Command::SaveDocument);
    let [Effect::Save(file)] = &effects[..] else {
        panic!("{effects:?}");
    };
    assert_eq!(
        (file.name.as_str(), file.mime),
        ("two-steps.json", "application/json")
    );
    let text = std::str::from_utf8(&file.bytes).expect("text");
    assert!(Document::from_json(text).is_ok());
}

#[test]
fn a_clay_is_saved_as_a_mesh_and_nothing_else_is() {
    let mut session = Session::new(Document::new());
    let save = Command::SaveMesh(MeshFormat::Stl);
    assert!(run(&mut session, save.clone()).is_empty(), "a head");
    let clay = r#"{ "fabrica": 1, "subject": { "clay": {} } }"#;
    session.open_document(Document::from_json(clay).expect("a document"), 0);
    let load = session.take_effects();
    assert!(
        load.iter()
            .any(|effect| matches!(effect, Effect::LoadSubject(_))),
        "{load:?}"
    );
    session.load_started(Ticket(3));
    assert!(
        run(&mut session, save.clone()).is_empty(),
        "not before it is there"
    );
    session.load_done(None);
    let effects = run(&mut session, save);
    assert!(
        matches!(&effects[..], [Effect::SaveMesh(MeshFormat::Stl)]),
        "{effects:?}"
    );
}

#[test]
fn what_a_new_document_replaces_is_kept_among_the_recent() {
    let mut session = lesson();
    let title = Edit::SetTitle("Mine".to_owned());
    run(&mut session, Command::Apply(title));
    let effects = run(&mut session, Command::New);
    assert!(
        effects
            .iter()
            .any(|effect| matches!(effect, Effect::Recent(RecentChange::Add(_)))),
        "{effects:?}"
    );
}

// ---------------------------------------------------------------------------------------- opening

#[test]
fn opening_a_document_drops_what_was_being_done() {
    let mut session = growing();
    run(&mut session, Command::Tissue(TissueCommand::Seed(true)));
    run(
        &mut session,
        Command::Tissue(TissueCommand::Alone(Some("core".to_owned()))),
    );
    let link = crate::link::encode(&Document::from_json(LESSON).expect("valid"));
    session.open_text(&format!("{link}&step=1"));
    assert_eq!((session.tool(), session.step()), (Tool::Look, 1));
    assert!(session.tissues.alone.is_none() && session.tissues.open.is_none());
    assert_eq!(session.camera.distance, 3.0, "the step's own camera");
    let effects = session.take_effects();
    assert!(matches!(&effects[0], Effect::Store("document", tail) if tail.ends_with("&step=1")));
    assert!(matches!(&effects[1], Effect::LoadSubject(_)));
}

#[test]
fn a_broken_text_is_told_and_changes_nothing() {
    let mut session = lesson();
    session.open_text("{ \"templates\": 3 ");
    assert_eq!(last_notice(&session), Some(Gravity::Error));
    assert_eq!(session.template_count(), 2);
    assert!(session.take_effects().is_empty());
}

#[test]
fn a_file_becomes_the_subject_when_it_is_read() {
    let mut session = lesson();
    session.file_started(Ticket(7));
    let before = session.illustration().subject.clone();
    session.refuse_load("broken", String::new());
    assert!(matches!(
        session.take_effects()[..],
        [Effect::CancelLoad(Ticket(7))]
    ));
    assert_eq!(session.illustration().subject, before);
    session.file_started(Ticket(8));
    session.load_done(Some("ab".repeat(32)));
    let subject = &session.illustration().subject;
    assert!(matches!(subject, SubjectRef::Supplied { sha256, .. } if sha256.starts_with("abab")));
    let failure = session.notices.shown().find(|n| n.message == "broken");
    assert!(failure.is_none(), "it is no longer missing");
    run(&mut session, Command::Undo);
    assert_eq!(session.illustration().subject, before);
}

#[test]
fn a_bare_file_is_asked_about_once() {
    let mut session = lesson();
    session.file_started(Ticket(3));
    session.ask_raw(RawQuestion {
        byte_len: None,
        is_packed: true,
        guess: None,
    });
    let mut voxels = session.raw_draft().expect("asked").voxels.clone();
    voxels.size = [4, 5, 6];
    run(
        &mut session,
        Command::Raw(RawCommand::Change(voxels.clone())),
    );
    let effects = run(&mut session, Command::Raw(RawCommand::Open));
    assert!(matches!(&effects[..], [Effect::AnswerRaw(Ticket(3), answer)] if *answer == voxels));
    assert!(session.raw_draft().is_none());
    assert!(run(&mut session, Command::Raw(RawCommand::Cancel)).is_empty());
}

// ---------------------------------------------------------------------------------------- the window

#[test]
fn what_only_a_window_can_do_is_an_effect() {
    let mut session = empty();
    let mut is_effect = |command: Command, expected: fn(&Effect) -> bool| {
        let effects = run(&mut session, command);
        assert!(effects.len() == 1 && expected(&effects[0]), "{effects:?}");
    };
    is_effect(Command::ToggleTheme, |e| matches!(e, Effect::ToggleTheme));
    is_effect(Command::ToggleContrast, |e| {
        matches!(e, Effect::ToggleContrast)
    });
    is_effect(Command::Scale(1.5), |e| matches!(e, Effect::Scale(1.5)));
    is_effect(Command::SavePicture, |e| matches!(e, Effect::SavePicture));
    is_effect(Command::Open, |e| matches!(e, Effect::OpenFile));
    is_effect(Command::StartSearch, |e| {
        matches!(e, Effect::Focus(Focus::Search))
    });
    is_effect(
        Command::ToggleLettering,
        |e| matches!(e, Effect::Store("lettering", on) if on == "yes"),
    );
}

#[test]
fn captions_that_cannot_be_set_are_named() {
    let mut session = empty();
    let texts = |session: &Session| -> Vec<String> {
        let shown = session.notices.shown();
        shown.map(|notice| notice.details.clone()).collect()
    };
    let set = |session: &mut Session, labels: Value| {
        let edit = Edit::Set {
            pointer: "/labels".to_owned(),
            value: labels,
            name: String::new(),
        };
        session.run(Command::Apply(edit), session.now);
        session.advance(session.now + 0.1);
    };
    set(
        &mut session,
        json!([{ "text": "Bone" }, { "text": "עצם", "enabled": false }]),
    );
    assert!(texts(&session).is_empty(), "{:?}", texts(&session));
    set(
        &mut session,
        json!([{ "text": "Bone" }, { "text": "עצם" }, { "text": "عظم" }]),
    );
    assert_eq!(texts(&session), ["עצם\nعظم"]);
    let told = session.notices.all().len();
    set(
        &mut session,
        json!([{ "text": "Bones" }, { "text": "עצם" }, { "text": "عظم" }]),
    );
    assert_eq!(session.notices.all().len(), told, "told once");
}

#[test]
fn slow_graphics_are_told_of_once_for_all() {
    let mut session = empty();
    let tell = |session: &mut Session, seconds: Option<f32>| {
        session.take_pace(seconds);
        let effects = session.take_effects();
        let is_kept = matches!(effects[..], [Effect::Store("slow", _)]);
        assert!(is_kept || effects.is_empty(), "{effects:?}");
        is_kept
    };
    assert!(!tell(&mut session, None), "not measured");
    assert!(!tell(&mut session, Some(0.9)), "fast enough");
    session.are_panels_hidden = true;
    assert!(!tell(&mut session, Some(3.0)), "a picture in a lecture");
    session.are_panels_hidden = false;
    assert!(tell(&mut session, Some(3.0)));
    let all = session.notices.all();
    assert!(
        all.len() == 1 && all[0].details.contains("3.0 s"),
        "{all:?}"
    );
    assert!(!tell(&mut session, Some(9.0)), "once");
    assert_eq!(session.notices.all().len(), 1);
}

#[test]
fn panels_are_turned_through_with_the_keyboard() {
    let mut session = empty();
    let mut tabs = Vec::new();
    for _ in 0..4 {
        let effects = run(&mut session, Command::NextPanel(true));
        assert!(matches!(effects[..], [Effect::Focus(Focus::Panel)]));
        tabs.push(session.side_tab);
    }
    assert_eq!(tabs, [Tab::Tissues, Tab::Look, Tab::Text, Tab::Templates]);
    session.are_drawers = true;
    run(&mut session, Command::NextPanel(false));
    assert_eq!(session.tab, Some(Tab::Text));
    run(&mut session, Command::NextPanel(true));
    assert_eq!(session.tab, Some(Tab::Add));
}
