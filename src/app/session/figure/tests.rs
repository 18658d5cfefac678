use std::sync::Arc;

use glam::{DVec2, Vec2};
use serde_json::json;

use super::{
    FigureCommand, FigureTool, HandleKey, Overlay, ReferenceCommand, handle_edit, handle_place,
};
use crate::app::session::{Command, LoadOf, Session, Tool};
use crate::data::{Plate, PlateOrigin, PlateShape, Sheet, SheetMesh, Subject};
use crate::document::figure::{Hold, Rigidity, Source};
use crate::document::{Document, Edit, FIGURE_FRONT};
use crate::pictures::Picture;

/// A square plate whose two triangles have gone to the right by 0.1, and are one region.
fn session_of(json: &str, origin: PlateOrigin, shapes: Vec<PlateShape>) -> Session {
    let mut session = Session::new(Document::from_json(json).expect("a document"));
    session.set_subject(&Subject::from(Plate {
        size: DVec2::ONE,
        picture: Picture {
            size: [1, 1],
            pixels: vec![[255; 4]],
            is_of_inks: false,
        },
        origin,
        shapes,
        words: Vec::new(),
    }));
    let corners = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]];
    let rest: Vec<Vec2> = corners.map(Vec2::from_array).to_vec();
    let places = rest.iter().map(|at| *at + Vec2::X * 0.1).collect();
    session.view.figure.sheet = Some(Sheet {
        mesh: Arc::new(SheetMesh {
            colors: vec![[0.0; 4]; 4],
            rest,
            triangles: vec![[0, 1, 2], [0, 2, 3]],
            region_of: vec![0, 0],
            regions: vec!["rest".to_owned()],
        }),
        places: Arc::new(places),
        order: Arc::new(vec![0, 1]),
        base: None,
    });
    session
}

const FILE: &str = r#"{ "fabrica": 1, "subject": { "src": "plate.png" }, "figure": {} }"#;

fn plate() -> Session {
    session_of(FILE, PlateOrigin::Pixels, Vec::new())
}

fn run(session: &mut Session, command: FigureCommand) {
    session.run(Command::Figure(command), 0.0);
}

fn click(session: &mut Session, x: f32, y: f32) {
    run(session, FigureCommand::Use(Vec2::new(x, y), false));
}

#[test]
fn a_pin_takes_the_move_that_it_finds() {
    let mut session = plate();
    run(&mut session, FigureCommand::Take(FigureTool::Pin));
    click(&mut session, 0.3, 0.2);
    let figure = session.figure().clone();
    let [pin] = &figure.handles[..] else {
        panic!("{figure:?}");
    };
    assert_eq!(pin.hold, Hold::Point(DVec2::new(0.2, 0.2)));
    assert_eq!(pin.motion.by, DVec2::new(0.1, 0.0));
    assert_eq!(pin.motion.turn, None, "it stays open");
    let seen = handle_place(&session.view.figure, pin).expect("it is there");
    assert!(seen.distance(Vec2::new(0.3, 0.2)) < 1e-5, "{seen}");
    assert_eq!(session.view.figure.handles, [0], "it is selected");
    // Beside the figure there is nothing to hold, and the tool stays in hand.
    click(&mut session, -0.45, 0.0);
    assert_eq!(session.figure().clone().handles.len(), 1);
    assert_eq!(session.tool(), Tool::Figure(FigureTool::Pin));
    session.run(Command::Escape, 0.0);
    assert_eq!(session.tool(), Tool::Look);
}

#[test]
fn handles_are_moved_together_in_one_step_of_undo() {
    let mut session = plate();
    run(&mut session, FigureCommand::Take(FigureTool::Pin));
    for x in [0.0, 0.2, 0.4] {
        click(&mut session, x, 0.0);
    }
    run(&mut session, FigureCommand::SelectHandle(Some(0), false));
    run(&mut session, FigureCommand::SelectHandle(Some(2), true));
    session.end_drag();
    for _ in 0..3 {
        run(&mut session, FigureCommand::MoveHandles(2, Vec2::Y * 0.05));
        assert!(session.is_passing(), "the figure follows");
    }
    session.end_drag();
    assert!(!session.is_passing());
    let moves = |session: &Session| -> Vec<f64> {
        let figure = session.figure().clone();
        figure
            .handles
            .iter()
            .map(|handle| handle.motion.by.y)
            .collect()
    };
    assert_eq!(moves(&session), [0.15, 0.0, 0.15]);
    session.run(Command::Undo, 0.0);
    assert_eq!(moves(&session), [0.0; 3]);
    session.run(Command::Redo, 0.0);
    // One that was not selected goes alone.
    run(&mut session, FigureCommand::MoveHandles(1, Vec2::Y));
    assert_eq!(moves(&session), [0.15, 1.0, 0.15]);
    run(&mut session, FigureCommand::MoveHandles(1, Vec2::NAN));
    run(&mut session, FigureCommand::Rest(Some(1)));
    assert_eq!(moves(&session), [0.15, 0.0, 0.15]);
    run(&mut session, FigureCommand::Rest(None));
    assert_eq!(moves(&session), [0.0; 3]);
    // Keys: the next is selected, turned, switched off, removed.
    session.run(Command::SelectNext(true), 0.0);
    assert_eq!(session.view.figure.handles, [2]);
    session.run(Command::NudgeMain(5.0), 0.0);
    assert!(
        session.figure().clone().handles[2]
            .motion
            .turn
            .is_some_and(|turn| turn > 0.04)
    );
    session.run(Command::ToggleSelected, 0.0);
    assert!(!session.figure().clone().handles[2].enabled);
    session.run(Command::DeleteSelected, 0.0);
    assert_eq!(session.figure().clone().handles.len(), 2);
    assert!(session.view.figure.handles.is_empty());
}

#[test]
fn a_flood_is_widened_and_gets_more_points() {
    let mut session = plate();
    run(&mut session, FigureCommand::Take(FigureTool::Region));
    click(&mut session, 0.0, 0.0);
    let flood = |session: &Session| {
        let (_, flood) = session.selected_flood().expect("it is selected");
        flood.clone()
    };
    assert_eq!(flood(&session).at, [DVec2::new(-0.1, 0.0)]);
    session.end_drag();
    for tolerance in [30.0, 41.3, 999.0] {
        run(&mut session, FigureCommand::Widen(tolerance));
    }
    assert_eq!(flood(&session).tolerance, 255.0);
    session.run(Command::Undo, 0.0);
    assert_eq!(flood(&session).tolerance, 24.0);
    run(&mut session, FigureCommand::Use(Vec2::new(0.3, 0.1), true));
    assert_eq!(flood(&session).at.len(), 2);
    let name = session.figure().clone().regions[0].name.clone();
    click(&mut session, 0.2, 0.3);
    let second = session.figure().clone().regions[1].name.clone();
    assert!(second != name && !second.is_empty(), "{second}");
    session.run(Command::ShiftSelected(-1), 0.0);
    assert_eq!(
        session.figure().clone().regions[0].name,
        second,
        "further back"
    );
    session.run(Command::DeleteSelected, 0.0);
    assert_eq!(session.figure().clone().regions.len(), 1);
}

#[test]
fn lines_and_polygons_are_drawn_by_corners_or_freely() {
    let mut session = plate();
    run(&mut session, FigureCommand::Take(FigureTool::Polygon));
    for [x, y] in [[0.0, 0.0], [0.2, 0.0], [0.2, 0.2], [0.2, 0.2]] {
        click(&mut session, x, y);
    }
    run(&mut session, FigureCommand::Finish);
    let polygon =
        |session: &Session, index: usize| match &session.figure().clone().regions[index].from {
            Some(Source::Polygon(polygon)) => polygon.clone(),
            other => panic!("{other:?}"),
        };
    let corners = [[-0.1, 0.0], [0.1, 0.0], [0.1, 0.2]].map(DVec2::from_array);
    assert_eq!(polygon(&session, 0), corners, "at rest, each once");
    // A circle by hand.
    for i in 0..1000 {
        let angle = i as f32 * 0.006;
        run(
            &mut session,
            FigureCommand::Draw(Vec2::from_angle(angle) * 0.2),
        );
    }
    run(&mut session, FigureCommand::Finish);
    let count = polygon(&session, 1).len();
    assert!((12..60).contains(&count), "{count} corners");
    // Two clicks make no polygon; taking back and Escape leave nothing behind.
    for x in [0.0, 0.1] {
        click(&mut session, x, 0.0);
    }
    run(&mut session, FigureCommand::TakeBack);
    assert_eq!(session.view.figure.draft.len(), 1);
    run(&mut session, FigureCommand::Finish);
    assert_eq!(session.figure().clone().regions.len(), 2);
    click(&mut session, 0.0, 0.0);
    session.run(Command::Escape, 0.0);
    assert!(session.view.figure.draft.is_empty());
    assert_eq!(session.tool(), Tool::Figure(FigureTool::Polygon));
    // A line on a figure that has moved begins where it is seen.
    run(&mut session, FigureCommand::Take(FigureTool::Line));
    for x in [0.0, 0.3] {
        click(&mut session, x, 0.1);
    }
    run(&mut session, FigureCommand::Finish);
    let line = session.figure().clone().handles[0].hold.clone();
    let Hold::Line {
        points,
        to: Some(to),
    } = &line
    else {
        panic!("{line:?}");
    };
    assert_eq!(
        (points[0], to[0]),
        (DVec2::new(-0.1, 0.1), DVec2::new(0.0, 0.1))
    );
    run(
        &mut session,
        FigureCommand::MoveLinePoint(0, 1, Vec2::new(0.3, 0.3)),
    );
    let moved = session.figure().clone().handles[0].hold.clone();
    assert!(matches!(moved, Hold::Line { to: Some(to), .. } if to[1] == DVec2::new(0.3, 0.3)));
    run(&mut session, FigureCommand::MoveLinePoint(0, 7, Vec2::ONE));
    run(&mut session, FigureCommand::MoveLinePoint(7, 0, Vec2::ONE));
    // By keys alone: the middle of the picture twice ends what is drawn.
    run(&mut session, FigureCommand::Take(FigureTool::Only));
    for target in [Vec2::ZERO, Vec2::X * 0.2, Vec2::Y * 0.2, Vec2::Y * 0.2] {
        session.camera.target = target.extend(0.0);
        session.run(Command::PlaceInMiddle, 0.0);
    }
    assert_eq!(
        session.figure().clone().only.map(|only| only.len()),
        Some(3)
    );
}

#[test]
fn shapes_of_a_drawing_become_regions() {
    let square = |path: &str, x: f32| PlateShape {
        path: path.to_owned(),
        lines: vec![
            [[x, 0.0], [x + 0.1, 0.0], [x + 0.1, 0.1], [x, 0.1]]
                .map(Vec2::from_array)
                .to_vec(),
        ],
        is_even_odd: false,
    };
    let shapes = vec![square("ulna", -0.2), square("1", 0.0), square("rest", 0.2)];
    let drawing = PlateOrigin::Drawing(Arc::from(&b"<svg/>"[..]));
    let mut session = session_of(FILE, drawing, shapes);
    run(&mut session, FigureCommand::Take(FigureTool::Region));
    // The shape at rest under what is seen.
    click(&mut session, -0.05, 0.05);
    let figure = session.figure().clone();
    assert_eq!(figure.regions[0].name, "ulna");
    assert_eq!(
        figure.regions[0].from,
        Some(Source::Path("ulna".to_owned()))
    );
    // As the bender tells it.
    session.view.figure.regions = Arc::new(figure.regions);
    click(&mut session, -0.05, 0.05);
    assert_eq!(
        session.figure().clone().regions.len(),
        1,
        "it is one already"
    );
    run(&mut session, FigureCommand::TakeShapes);
    let figure = session.figure().clone();
    let names: Vec<&str> = figure
        .regions
        .iter()
        .map(|region| region.name.as_str())
        .collect();
    assert_eq!(names[0], "ulna");
    assert_eq!(names.len(), 3);
    assert!(
        !names.contains(&"rest") && !names.contains(&"1"),
        "{names:?}"
    );
    session.run(Command::Undo, 0.0);
    assert_eq!(
        session.figure().clone().regions.len(),
        1,
        "one step of undo"
    );
}

#[test]
fn landmarks_come_three_at_first() {
    let mut session = plate();
    run(&mut session, FigureCommand::Take(FigureTool::Landmark));
    for (x, count) in [(0.0, 0), (0.2, 0), (0.3, 3), (0.4, 4)] {
        click(&mut session, x, x * x);
        let context = session.figure().clone().context;
        assert_eq!(context.map_or(0, |context| context.points.len()), count);
    }
    run(&mut session, FigureCommand::DropLandmarks);
    assert_eq!(session.figure().clone().context, None);
}

#[test]
fn a_built_in_region_is_changed_by_its_name() {
    let json = r#"{ "fabrica": 1, "subject": { "builtin": "drawn-arm" } }"#;
    let mut session = session_of(
        json,
        PlateOrigin::Builtin("drawn-arm".to_owned()),
        Vec::new(),
    );
    let edit = super::region_edit(&session, "ulna", "fixed", json!(true));
    session.run(Command::Apply(edit), 0.0);
    let edit = super::region_edit(&session, "ulna", "order", json!(2));
    session.run(Command::Apply(edit), 0.0);
    let listed = session.document().get("/figure/regions").cloned();
    assert_eq!(
        listed,
        Some(json!([{ "name": "ulna", "fixed": true, "order": 2 }]))
    );
    // A drag is one step of undo, from the first place of the hand on.
    let before = session.document().clone();
    for stiffness in [2.0, 3.0, 4.0] {
        let rigidity = Rigidity::Elastic([stiffness; 2]);
        let edit = super::rigidity_edit(&session, "radius", rigidity);
        session.run(Command::Drag(edit), 0.0);
    }
    session.end_drag();
    let listed = session.document().get("/figure/regions/1").cloned();
    assert_eq!(listed, Some(json!({ "name": "radius", "rigidity": 4 })));
    session.run(Command::Undo, 0.0);
    assert_eq!(*session.document(), before);
    // What belongs to the drawing is not removed.
    run(
        &mut session,
        FigureCommand::SelectRegion(Some("hand".to_owned())),
    );
    session.run(Command::DeleteSelected, 0.0);
    assert!(!session.notices.all().is_empty(), "a message tells why");
}

#[test]
fn at_a_step_a_built_in_region_changes_from_there_on() {
    let json =
        r#"{ "fabrica": 1, "subject": { "builtin": "drawn-arm" }, "steps": [{ "seconds": 0 }] }"#;
    let mut session = session_of(
        json,
        PlateOrigin::Builtin("drawn-arm".to_owned()),
        Vec::new(),
    );
    session.has_less_motion = true;
    session.run(Command::GoToStep(1), 0.0);
    let edit = super::rigidity_edit(&session, "ulna", Rigidity::Elastic([3.0; 2]));
    session.run(Command::Apply(edit), 0.0);
    let regions = session.document().get("/figure/regions").cloned();
    assert_eq!(regions, Some(json!([{ "name": "ulna" }])));
    let set = session.document().get("/steps/0/set").cloned();
    assert_eq!(set, Some(json!({ "/figure/regions/0/rigidity": 3 })));
}

#[test]
fn undo_does_not_take_back_that_a_file_is_a_picture() {
    let json = r#"{ "fabrica": 1, "subject": { "src": "plate.bin" } }"#;
    let mut session = session_of(json, PlateOrigin::Pixels, Vec::new());
    let edit = Edit::SetTitle("Elbow".to_owned());
    session.run(Command::Apply(edit), 0.0);
    let camera = session.camera;
    session.tell_figure();
    assert_eq!(session.camera.rotate, camera.rotate * FIGURE_FRONT);
    for command in [Command::Undo, Command::Undo, Command::Redo] {
        session.run(command, 0.0);
        let illustration = session.document().illustration();
        assert!(illustration.is_of_figure(), "it stays one");
    }
    assert_eq!(session.document().get("/title"), Some(&json!("Elbow")));
}

#[test]
fn at_a_step_a_pose_is_recorded() {
    let json = r#"{ "fabrica": 1, "subject": { "src": "plate.png" },
        "figure": { "handles": [{ "at": [0, 0] }] }, "steps": [{ "seconds": 0 }] }"#;
    let mut session = session_of(json, PlateOrigin::Pixels, Vec::new());
    session.has_less_motion = true;
    session.run(Command::GoToStep(1), 0.0);
    run(&mut session, FigureCommand::MoveHandles(0, Vec2::Y * 0.2));
    session.end_drag();
    let turned = handle_edit(0, HandleKey::Turn(Some(0.5)));
    session.run(Command::Apply(turned), 0.0);
    let set = session.document().get("/steps/0/set").cloned();
    let wanted = json!({ "/figure/handles/0/move": [0, 0.2], "/figure/handles/0/turn": 0.5 });
    assert_eq!(set, Some(wanted));
    session.run(Command::GoToStep(0), 0.0);
    assert_eq!(session.figure().clone().handles[0].motion.by, DVec2::ZERO);
    // The region is of all steps.
    session.run(Command::GoToStep(1), 0.0);
    run(&mut session, FigureCommand::Take(FigureTool::Region));
    click(&mut session, 0.0, 0.0);
    assert_eq!(
        session
            .illustration()
            .figure
            .as_ref()
            .map(|f| f.regions.len()),
        Some(1)
    );
}

#[test]
fn overlays_are_switched() {
    let mut session = plate();
    let shown = |session: &Session| Overlay::ALL.map(|overlay| session.view.figure.shows(overlay));
    assert_eq!(shown(&session), [true, true, false, false, false]);
    for overlay in Overlay::ALL {
        run(&mut session, FigureCommand::Show(overlay));
    }
    assert_eq!(shown(&session), [false, false, true, true, true]);
    // Beside a scan nothing of it is done.
    let mut scan = Session::with_scan(r#"{ "fabrica": 1 }"#, 1.0, &[]);
    run(&mut scan, FigureCommand::Take(FigureTool::Pin));
    assert_eq!(scan.tool(), Tool::Look);
}

#[test]
fn places_of_another_picture_are_taken_over() {
    let refer = |session: &mut Session, command| run(session, FigureCommand::Refer(command));
    let mut session = plate();
    refer(&mut session, ReferenceCommand::Click(Vec2::ZERO));
    refer(&mut session, ReferenceCommand::Open);
    assert!(
        matches!(session.take_effects()[..], []),
        "they were handed on"
    );
    session.file_started(crate::app::session::Ticket(1));
    let load = session.load.take().expect("a load");
    assert_eq!(load.of, LoadOf::Reference);
    // Whoever does something else has not chosen one.
    refer(&mut session, ReferenceCommand::Open);
    session.run(Command::Escape, 0.0);
    session.file_started(crate::app::session::Ticket(2));
    assert_eq!(session.load.take().expect("a load").of, LoadOf::File);
    let other = session.view.figure.plate.clone().expect("a plate");
    session.set_reference(Arc::clone(&other));
    assert_eq!(session.places_wanted(), 0, "there are no landmarks");
    run(&mut session, FigureCommand::Take(FigureTool::Landmark));
    for x in [0.0, 0.2, 0.3] {
        click(&mut session, x, x * x);
    }
    for i in 0..5 {
        let at = Vec2::new(0.1, 0.1 * i as f32);
        refer(&mut session, ReferenceCommand::Click(at));
        assert_eq!(session.can_take_over(), i >= 2);
    }
    refer(&mut session, ReferenceCommand::TakeBack);
    assert!(!session.can_take_over());
    refer(&mut session, ReferenceCommand::Click(Vec2::ONE));
    refer(&mut session, ReferenceCommand::Take);
    let like = session
        .figure()
        .clone()
        .context
        .and_then(|context| context.like);
    assert_eq!(like.map(|like| like.len()), Some(3));
    // One landmark more: those of the other picture no longer fit.
    click(&mut session, 0.4, 0.0);
    assert_eq!(
        session
            .figure()
            .clone()
            .context
            .and_then(|context| context.like),
        None
    );
    // The outline of a region, once and then another one.
    run(&mut session, FigureCommand::Take(FigureTool::Region));
    click(&mut session, 0.0, 0.0);
    session.set_reference(other);
    for size in [0.1, 0.2] {
        for at in [Vec2::ZERO, Vec2::X, Vec2::Y] {
            refer(&mut session, ReferenceCommand::Click(at * size));
        }
        refer(&mut session, ReferenceCommand::Take);
        let contours = session.figure().clone().contours;
        assert_eq!(contours.len(), 1);
        assert_eq!(
            contours[0].like[1],
            DVec2::new(f64::from((size * 10.0).round()) / 10.0, 0.0)
        );
    }
    let json = session.document().to_json();
    assert!(!json.contains("pixels"), "only places are kept: {json}");
    refer(&mut session, ReferenceCommand::Close);
    assert!(session.view.figure.reference.is_none());
}
