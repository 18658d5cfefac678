//! Poses that follow: a drag and a passage go from frame to frame, and come to what the pose at rest is.

use std::sync::Arc;

use fabrica::data::Sheet;
use fabrica::document::figure::{Context, Figure, Handle, Hold, Region, Rigidity, Rotations};
use fabrica::figure::drawn::{CHILD_FACE, FACE_POINTS};
use fabrica::figure::{Bender, builtin_plate, unwatched};
use glam::{DVec2, dvec2};

fn bender(name: &str) -> Bender {
    let plate = builtin_plate(name).expect("built in");
    Bender::new(&plate).expect("a drawing that is read")
}

fn held(region: &str, by: DVec2, turn: f64, scale: f64) -> Handle {
    let mut handle = Handle::pin(DVec2::ZERO, by);
    handle.hold = Hold::Region(region.to_owned());
    handle.motion.turn = Some(turn);
    handle.motion.scale = scale;
    handle
}

/// An arm whose hand is moved and turned by a part of the whole way.
fn arm(part: f64) -> Figure {
    Figure {
        handles: vec![
            held("humerus", DVec2::ZERO, 0.0, 1.0),
            held("hand", dvec2(0.0, 0.12 * part), 0.5 * part, 1.0),
        ],
        detail: 1500,
        ..Figure::default()
    }
}

fn at_rest(bender: &mut Bender, figure: &Figure) -> Sheet {
    let bent = bender.bent(figure, &mut unwatched);
    bent.expect("nobody stops it").sheet
}

fn followed(bender: &mut Bender, figure: &Figure) -> Sheet {
    let bent = bender.follow(figure, 4, &mut unwatched);
    bent.expect("nobody stops it").sheet
}

/// The longest way between the places of a vertex.
fn apart(one: &Sheet, other: &Sheet) -> f32 {
    let pairs = one.places.iter().zip(other.places.iter());
    pairs.map(|(a, b)| a.distance(*b)).fold(0.0, f32::max)
}

#[test]
fn what_follows_comes_to_the_pose_at_rest() {
    for rotations in [Rotations::Found, Rotations::Propagated] {
        let of = |part: f64| Figure {
            rotations,
            ..arm(part)
        };
        let mut bender_in_use = bender("drawn-arm");
        let start = at_rest(&mut bender_in_use, &of(0.0));
        let wanted = at_rest(&mut bender("drawn-arm"), &of(1.0));
        assert!(apart(&start, &wanted) > 0.1, "it is another pose");
        let mut last = start;
        for frame in 1..=20 {
            let now = followed(&mut bender_in_use, &of(f64::from(frame) / 20.0));
            assert!(Arc::ptr_eq(&now.mesh, &last.mesh), "the mesh stays");
            let step = apart(&now, &last);
            assert!((1e-4..0.03).contains(&step), "frame {frame} goes {step}");
            last = now;
        }
        for _ in 0..40 {
            last = followed(&mut bender_in_use, &of(1.0));
        }
        let off = apart(&last, &wanted);
        assert!(off < 1e-3, "{rotations:?}: {off} from the pose at rest");
    }
}

#[test]
fn scales_and_likenesses_ease() {
    let grown = |scale: f64| Figure {
        handles: vec![
            held("humerus", DVec2::ZERO, 0.0, 1.0),
            held("hand", DVec2::ZERO, 0.0, scale),
        ],
        detail: 1500,
        ..Figure::default()
    };
    let alike = |amount: f64| Figure {
        context: Some(Context {
            points: FACE_POINTS.map(DVec2::from_array).to_vec(),
            strength: 5.0,
            keep: true,
            like: Some(CHILD_FACE.map(DVec2::from_array).to_vec()),
            amount,
        }),
        detail: 1500,
        ..Figure::default()
    };
    let cases: [(&str, Vec<Figure>); 2] = [
        ("drawn-arm", [1.0, 1.15, 1.3].map(grown).to_vec()),
        ("drawn-face", [0.0, 0.5, 1.0].map(alike).to_vec()),
    ];
    for (name, figures) in cases {
        let mut bender_in_use = bender(name);
        let start = at_rest(&mut bender_in_use, &figures[0]);
        let before = bender_in_use.factorisations();
        let half = followed(&mut bender_in_use, &figures[1]);
        let mut end = followed(&mut bender_in_use, &figures[2]);
        for _ in 0..40 {
            end = followed(&mut bender_in_use, &figures[2]);
        }
        assert_eq!(
            bender_in_use.factorisations(),
            before,
            "{name}: none is made anew"
        );
        let whole = apart(&start, &end);
        assert!(whole > 0.01, "{name} changes: {whole}");
        for (what, other) in [("start", &start), ("end", &end)] {
            let away = apart(&half, other);
            assert!(
                away > 0.2 * whole,
                "{name}: half way is {away} from the {what}"
            );
        }
        let off = apart(&end, &at_rest(&mut bender(name), &figures[2]));
        assert!(off < 2e-3, "{name}: {off} from the pose at rest");
    }
}

/// What a step may set of a region changes no mesh (spec/figures.md, "The mesh").
#[test]
fn rigidity_and_order_leave_the_mesh() {
    let with = |region: Option<Region>| Figure {
        regions: region.into_iter().collect(),
        ..arm(0.5)
    };
    let mut bender_in_use = bender("drawn-arm");
    let start = at_rest(&mut bender_in_use, &with(None));
    let region = Region {
        rigidity: Rigidity::Elastic([9.0, 9.0]),
        order: 3.0,
        given: vec!["rigidity", "order"],
        ..Region::new("biceps")
    };
    let now = at_rest(&mut bender_in_use, &with(Some(region)));
    assert!(Arc::ptr_eq(&start.mesh, &now.mesh), "the mesh stays");
    assert!(apart(&start, &now) > 1e-4, "it bends in another way");
    assert_ne!(start.order, now.order, "it is drawn in another order");
}
