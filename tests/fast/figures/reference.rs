//! Positions of exported figures against a second reading of the contract (issue 18, must-show 4).

use super::common::{mesh, plain, rectangle};
use crate::figure_reference::{P, Reference, dot, points, sub};
use fabrica::document::figure::{
    Context, Contour, Figure, Handle, Hold, Move, Propagation, Rigidity, Rotations,
};
use fabrica::figure::exported;
use fabrica::figure::solve::Rig;
use glam::{DVec2, dvec2};
use serde_json::Value;

fn pin(at: [f64; 2], by: [f64; 2], turn: Option<f64>, scale: f64) -> Handle {
    let mut handle = Handle::pin(DVec2::from(at), DVec2::from(by));
    handle.motion = Move {
        turn,
        scale,
        ..handle.motion
    };
    handle
}

/// The six documents (soft; 10; per axis; rigid; context; contour), a chain of bones of which the middle ones hang on
/// their neighbours only, and all at once on a changed shape.
fn documents() -> Vec<(&'static str, Figure)> {
    let bar = |rigidity| Figure {
        regions: vec![
            rectangle("left", [-0.45, -0.04], [-0.04, 0.05], rigidity),
            rectangle("right", [-0.04, -0.06], [0.45, 0.04], rigidity),
        ],
        handles: vec![
            pin([-0.4, 0.0], [0.02, 0.0], Some(0.1), 1.0),
            pin([0.4, 0.0], [-0.05, 0.12], None, 1.1),
            pin([0.0, 0.09], [0.03, 0.03], None, 1.0),
        ],
        detail: 500,
        ..Figure::default()
    };
    let mut rigid = bar(Rigidity::Rigid);
    rigid.handles.truncate(2);
    rigid.handles.push(Handle {
        hold: Hold::Line {
            points: vec![dvec2(-0.1, 0.09), dvec2(0.0, 0.09), dvec2(0.1, 0.09)],
            to: Some(vec![
                dvec2(-0.12, 0.12),
                dvec2(-0.02, 0.13),
                dvec2(0.08, 0.12),
            ]),
        },
        ..pin([0.0, 0.0], [0.0, 0.0], None, 1.0)
    });
    rigid.only = Some(vec![
        dvec2(-0.6, -0.08),
        dvec2(0.6, -0.08),
        dvec2(0.6, 0.6),
        dvec2(-0.6, 0.6),
    ]);
    let mut context = bar(Rigidity::Elastic([2.0, 2.0]));
    context.context = Some(Context {
        points: [
            [-0.2, 0.0],
            [0.2, 0.01],
            [0.05, 0.06],
            [-0.05, -0.06],
            [0.1, -0.02],
        ]
        .map(DVec2::from)
        .to_vec(),
        strength: 4.0,
        keep: true,
        like: Some(
            [[0.0, 0.0], [4.0, 0.4], [2.5, 1.0], [1.5, -0.7], [3.1, -0.3]]
                .map(DVec2::from)
                .to_vec(),
        ),
        amount: 0.6,
    });
    let mut contour = bar(Rigidity::SOFT);
    contour.regions[0].rigidity = Rigidity::Rigid;
    contour.contours = vec![Contour {
        region: "right".to_owned(),
        like: [[0.0, 0.0], [4.0, -0.6], [5.0, 0.3], [4.0, 1.0], [0.0, 0.7]]
            .map(DVec2::from)
            .to_vec(),
        amount: 0.7,
        mirror: false,
        keep: vec![dvec2(-0.04, 0.0)],
    }];
    let bone =
        |name, from, to, up| rectangle(name, [from, -0.05 + up], [to, 0.04 + up], Rigidity::Rigid);
    let mut chain = bar(Rigidity::SOFT);
    chain.regions = vec![
        bone("one", -0.45, -0.2, 0.0),
        bone("two", -0.2, 0.0, 0.02),
        bone("three", 0.03, 0.2, -0.02),
        bone("four", 0.22, 0.45, 0.0),
    ];
    chain.handles = vec![
        pin([-0.42, 0.0], [0.0, 0.0], None, 1.0),
        pin([-0.24, 0.0], [0.01, 0.05], None, 1.0),
        pin([0.4, 0.0], [-0.03, 0.1], None, 1.05),
        pin([0.1, 0.11], [0.0, 0.02], None, 1.0),
    ];
    let mut all = contour.clone();
    all.regions[0].rigidity = Rigidity::Elastic([5.0, 0.7]);
    all.regions.push(bone("loose", -0.3, -0.2, 0.01));
    all.regions[1].fixed = false;
    all.context = context.context.clone();
    vec![
        ("chain", chain),
        ("all", all),
        ("soft", bar(Rigidity::SOFT)),
        ("10", bar(Rigidity::Elastic([10.0, 10.0]))),
        ("per axis", bar(Rigidity::Elastic([6.0, 1.0]))),
        ("rigid", rigid),
        ("context", context),
        ("contour", contour),
    ]
}

/// The largest distance from the reference.
fn difference(figure: &Figure) -> f64 {
    let picture = plain(400, 100);
    let (mesh, _) = mesh(&picture, figure);
    let mut notices = Vec::new();
    let rig = Rig::new(&mesh, figure, &mut notices);
    let posed = rig.posed(figure, &mut notices);
    let text = exported(&rig, figure, &posed).to_string();
    let again = exported(&rig, figure, &rig.posed(figure, &mut Vec::new())).to_string();
    assert_eq!(text, again, "the same bytes when run again");
    let file: Value = serde_json::from_str(&text).expect("JSON");
    let positions = points(&file["positions"]);
    println!(
        "  {} vertices, {} rounds, {} folded, {notices:?}",
        positions.len(),
        posed.rounds,
        posed.folded
    );
    let wanted = Reference::new(file).solve();
    let away = |(p, q): (&P, &P)| dot(sub(*p, *q), sub(*p, *q)).sqrt();
    positions.iter().zip(&wanted).map(away).fold(0.0, f64::max)
}

#[test]
fn propagated_turns_give_what_the_reference_gives() {
    for (name, mut figure) in documents() {
        figure.rotations = Rotations::Propagated;
        for propagation in [
            Propagation::Harmonic,
            Propagation::Nearest,
            Propagation::Linear,
            Propagation::Gaussian,
        ] {
            for reach in [0.0, 0.3] {
                (figure.propagation, figure.reach) = (propagation, reach);
                let difference = difference(&figure);
                println!("{name}, {propagation:?}, reach {reach}: {difference:e}");
                assert!(
                    difference <= 1e-5,
                    "{name}, {propagation:?}, reach {reach}: {difference:e}"
                );
            }
        }
    }
}

#[test]
fn found_turns_give_what_the_reference_gives() {
    for (name, figure) in documents() {
        let difference = difference(&figure);
        println!("{name}: {difference:e}");
        assert!(difference <= 1e-3, "{name}: {difference:e}");
    }
}

#[test]
fn the_reference_notices_what_is_wrong() {
    let picture = plain(400, 100);
    let (_, figure) = documents().swap_remove(2);
    let (mesh, _) = mesh(&picture, &figure);
    let mut notices = Vec::new();
    let rig = Rig::new(&mesh, &figure, &mut notices);
    let posed = rig.posed(&figure, &mut notices);
    let mut file = exported(&rig, &figure, &posed);
    let positions = points(&file["positions"]);
    file["regions"][0]["rigidity"] = serde_json::json!(3.0);
    let wanted = Reference::new(file).solve();
    let away = |(p, q): (&P, &P)| dot(sub(*p, *q), sub(*p, *q)).sqrt();
    let difference = positions.iter().zip(&wanted).map(away).fold(0.0, f64::max);
    assert!(
        difference > 2e-3,
        "another rigidity gives other places: {difference}"
    );
}
