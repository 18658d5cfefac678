//! Probing forward and back (issue 18, must show 11).

use super::common::*;
use fabrica::document::figure::{Figure, Handle, Rest, Rigidity};
use fabrica::figure::probe::{Seen, forward};
use fabrica::figure::solve::Rig;
use glam::{DVec2, dvec2};

#[test]
fn probing_inverts_probing_forward() {
    let picture = plain(400, 200);
    let mut cut = rectangle(
        "organ",
        [-0.2, 0.05],
        [0.1, 0.2],
        Rigidity::Elastic([3.0, 3.0]),
    );
    cut.cut = true;
    let mut figure = Figure {
        regions: vec![
            rectangle("bone", [-0.45, -0.03], [-0.05, 0.03], Rigidity::Rigid),
            cut,
        ],
        detail: 4000,
        ..Figure::default()
    };
    let mut wrist = Handle::pin(dvec2(0.45, 0.0), dvec2(-0.1, 0.3));
    wrist.motion.turn = Some(1.0);
    figure.handles = vec![
        Handle::pin(dvec2(-0.4, 0.0), DVec2::ZERO),
        Handle::pin(dvec2(-0.1, 0.0), DVec2::ZERO),
        wrist,
        Handle::pin(dvec2(-0.1, 0.1), dvec2(0.15, 0.1)),
    ];
    let (mesh, _) = mesh(&picture, &figure);
    let mut notices = Vec::new();
    let rig = Rig::new(&mesh, &figure, &mut notices);
    let posed = rig.posed(&figure, &mut notices);
    let seen = Seen::new(&mesh, &figure, &posed.places);
    let mut noise = Noise(7);
    let (mut same, mut covered) = (0, 0);
    for _ in 0..1000 {
        let at = dvec2(noise.next() - 0.5, (noise.next() - 0.5) / 2.0);
        let gone = forward(&mesh, &posed.places, at);
        let triangle = gone.triangle.expect("all of the picture is in the figure");
        let back = seen.at(gone.place);
        let [a, b, c] = mesh.corners(triangle, &posed.places);
        let is_folded = (b - a).perp_dot(c - a) < 0.0;
        if back.place.distance(at) < 1e-4 {
            same += 1;
        } else {
            // Something else covers it: another region, or a fold.
            covered += 1;
            let front = back.triangle.expect("something covers it");
            assert!(
                is_folded || mesh.tissue(front).name != mesh.tissue(triangle).name,
                "{at} comes back as {back:?}"
            );
        }
    }
    println!(
        "{same} come back, {covered} are covered, {} folded",
        posed.folded
    );
    assert!(
        same > 900 && covered > 0,
        "{same} come back, {covered} are covered"
    );
    let outside = seen.at(dvec2(0.9, -0.9));
    assert_eq!(
        (outside.place, outside.triangle),
        (dvec2(0.9, -0.9), None),
        "nothing is there"
    );
    assert_eq!(
        forward(&mesh, &posed.places, dvec2(0.6, 0.0)).triangle,
        None,
        "no triangle is there"
    );
}

#[test]
fn what_is_in_front_is_seen() {
    let picture = plain(400, 200);
    let mut organ = rectangle("organ", [-0.3, -0.1], [-0.1, 0.1], Rigidity::Rigid);
    organ.cut = true;
    let mut figure = Figure {
        regions: vec![
            organ,
            rectangle("stone", [0.1, -0.1], [0.3, 0.1], Rigidity::Rigid),
        ],
        handles: vec![
            Handle::pin(dvec2(-0.2, 0.0), dvec2(0.4, 0.0)),
            Handle::pin(dvec2(0.2, 0.0), DVec2::ZERO),
        ],
        detail: 2000,
        ..Figure::default()
    };
    let (mesh, _) = mesh(&picture, &figure);
    let mut seen = |order: f64, rest: Rest| {
        figure.regions[0].order = order;
        figure.rest = rest;
        let mut notices = Vec::new();
        let posed = Rig::new(&mesh, &figure, &mut notices).posed(&figure, &mut notices);
        let seen = Seen::new(&mesh, &figure, &posed.places).at(dvec2(0.2, 0.05));
        mesh.tissue(seen.triangle.expect("in the figure"))
            .name
            .clone()
    };
    assert_eq!(seen(0.0, Rest::Bend), "stone", "later in the list");
    assert_eq!(seen(1.0, Rest::Bend), "organ", "by order");
    assert_eq!(seen(-1.0, Rest::Bend), "stone", "by order");
}
