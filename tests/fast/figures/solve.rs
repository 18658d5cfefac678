//! The solve, looked at from outside (issue 18, must show 5 to 10).

use super::common::*;
use fabrica::document::figure::{
    Context, Contour, Figure, Handle, Hold, Move, Propagation, Region, Rigidity, Rotations,
};
use fabrica::figure::Notice;
use fabrica::figure::mesh::{Mesh, Part};
use fabrica::figure::solve::{Posed, Rig};
use glam::{DVec2, dvec2};
use std::sync::Arc;

const PROPAGATIONS: [Propagation; 4] = [
    Propagation::Harmonic,
    Propagation::Nearest,
    Propagation::Linear,
    Propagation::Gaussian,
];

fn posed(mesh: &Arc<Mesh>, figure: &Figure) -> (Posed, Vec<Notice>) {
    let mut notices = Vec::new();
    let rig = Rig::new(mesh, figure, &mut notices);
    let posed = rig.posed(figure, &mut notices);
    (posed, notices)
}

fn polar(scale: f64, angle: f64) -> DVec2 {
    scale * dvec2(angle.cos(), angle.sin())
}

fn mul(a: DVec2, b: DVec2) -> DVec2 {
    dvec2(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x)
}

fn pin(at: [f64; 2], by: [f64; 2], turn: Option<f64>, scale: f64) -> Handle {
    let mut handle = Handle::pin(dvec2(at[0], at[1]), dvec2(by[0], by[1]));
    handle.motion.turn = turn;
    handle.motion.scale = scale;
    handle
}

/// A plate with regions of all kinds of rigidity.
fn mixed() -> Figure {
    Figure {
        regions: vec![
            rectangle(
                "fat",
                [-0.45, -0.3],
                [-0.15, 0.3],
                Rigidity::Elastic([0.1, 0.1]),
            ),
            rectangle("bone", [-0.1, -0.2], [0.0, 0.2], Rigidity::Rigid),
            rectangle("other bone", [0.0, -0.2], [0.1, 0.1], Rigidity::Rigid),
            rectangle(
                "muscle",
                [0.15, -0.25],
                [0.3, 0.25],
                Rigidity::Elastic([10.0, 1.0]),
            ),
            rectangle(
                "stone",
                [0.32, -0.1],
                [0.45, 0.1],
                Rigidity::Elastic([100.0, 100.0]),
            ),
        ],
        detail: 1500,
        ..Figure::default()
    }
}

/// Six handles of all kinds that move nothing.
fn still_handles() -> Vec<Handle> {
    let line = Handle {
        hold: Hold::Line {
            points: vec![dvec2(-0.4, -0.2), dvec2(-0.3, 0.0), dvec2(-0.2, 0.2)],
            to: Some(vec![dvec2(-0.4, -0.2), dvec2(-0.3, 0.0), dvec2(-0.2, 0.2)]),
        },
        ..pin([0.0, 0.0], [0.0, 0.0], None, 1.0)
    };
    let region = Handle {
        hold: Hold::Region("stone".to_owned()),
        ..pin([0.0, 0.0], [0.0, 0.0], None, 1.0)
    };
    vec![
        pin([-0.47, 0.0], [0.0, 0.0], None, 1.0),
        pin([-0.05, 0.1], [0.0, 0.0], None, 1.0),
        pin([-0.05, -0.1], [0.0, 0.0], Some(0.0), 1.0),
        pin([0.2, 0.2], [0.0, 0.0], Some(0.0), 1.0),
        line,
        region,
    ]
}

#[test]
fn handles_that_move_nothing_leave_everything_in_place() {
    let picture = plain(300, 200);
    let mut figure = mixed();
    figure.handles = still_handles();
    let (mesh, _) = mesh(&picture, &figure);
    for propagation in PROPAGATIONS {
        for rotations in [Rotations::Found, Rotations::Propagated] {
            (figure.propagation, figure.rotations) = (propagation, rotations);
            let (posed, notices) = posed(&mesh, &figure);
            assert_eq!(notices, [], "no notices");
            let most = furthest(&posed.places, &mesh.vertices, |at| at);
            assert!(most < 1e-6, "{propagation:?}, {rotations:?}: {most:e}");
        }
    }
    figure.handles.clear();
    let most = furthest(&posed(&mesh, &figure).0.places, &mesh.vertices, |at| at);
    assert!(most < 1e-6, "without handles: {most:e}");
}

/// The largest distance of places from where `carry` takes those at rest.
fn furthest(places: &[DVec2], rest: &[DVec2], carry: impl Fn(DVec2) -> DVec2) -> f64 {
    places
        .iter()
        .zip(rest)
        .map(|(place, at)| place.distance(carry(*at)))
        .fold(0.0, f64::max)
}

#[test]
fn one_similarity_by_three_handles_carries_the_whole() {
    let picture = plain(300, 200);
    let mut figure = mixed();
    let (mesh, _) = mesh(&picture, &figure);
    let (z, shift) = (polar(1.3, 0.9), dvec2(0.2, -0.1));
    let carry = |at: DVec2| mul(z, at) + shift;
    for at in [[-0.4, 0.2], [-0.05, 0.0], [0.4, 0.05]] {
        let by = carry(dvec2(at[0], at[1])) - dvec2(at[0], at[1]);
        figure.handles.push(pin(at, [by.x, by.y], Some(0.9), 1.3));
    }
    for propagation in PROPAGATIONS {
        for rotations in [Rotations::Found, Rotations::Propagated] {
            (figure.propagation, figure.rotations) = (propagation, rotations);
            let (posed, _) = posed(&mesh, &figure);
            let most = furthest(&posed.places, &mesh.vertices, carry);
            assert!(
                most < 1e-5,
                "{propagation:?}, {rotations:?}: {most:e} after {} rounds",
                posed.rounds
            );
        }
    }
}

#[test]
fn open_pins_under_one_rigid_motion_carry_the_whole() {
    let picture = plain(300, 200);
    let mut figure = mixed();
    let (mesh, _) = mesh(&picture, &figure);
    for (turn, ats) in [
        (0.9, [[-0.4, 0.2], [-0.05, 0.0], [0.4, 0.05]]),
        (-2.5, [[-0.3, -0.1], [-0.05, 0.1], [0.05, 0.0]]),
    ] {
        let (z, shift) = (polar(1.0, turn), dvec2(0.2, -0.1));
        let carry = |at: DVec2| mul(z, at) + shift;
        figure.handles.clear();
        for at in ats {
            let by = carry(dvec2(at[0], at[1])) - dvec2(at[0], at[1]);
            figure.handles.push(pin(at, [by.x, by.y], None, 1.0));
        }
        for propagation in PROPAGATIONS {
            for rotations in [Rotations::Found, Rotations::Propagated] {
                (figure.propagation, figure.rotations) = (propagation, rotations);
                let (posed, _) = posed(&mesh, &figure);
                let most = furthest(&posed.places, &mesh.vertices, carry);
                assert!(
                    most < 1e-5,
                    "{propagation:?}, {rotations:?}, {turn}: {most:e}, {} rounds",
                    posed.rounds
                );
            }
        }
    }
}

/// An arm along x, bent at its middle, with a bone to each side of the elbow.
fn arm(rigidity: Rigidity, detail: u32) -> Figure {
    let bone = |name, from, to| rectangle(name, [from, -0.03], [to, 0.03], rigidity);
    Figure {
        regions: vec![bone("humerus", -0.45, -0.03), bone("ulna", 0.03, 0.45)],
        detail,
        ..Figure::default()
    }
}

/// Two pins in the upper arm, and one at the wrist that is moved by `angle` about the elbow.
fn bent(mut figure: Figure, angle: f64, turn: Option<f64>) -> Figure {
    let wrist = dvec2(0.4, 0.0);
    let by = mul(polar(1.0, angle), wrist) - wrist;
    figure.handles = vec![
        pin([-0.4, 0.0], [0.0, 0.0], Some(0.0), 1.0),
        pin([-0.1, 0.0], [0.0, 0.0], Some(0.0), 1.0),
        pin([0.4, 0.0], [by.x, by.y], turn, 1.0),
    ];
    figure
}

#[test]
fn an_elbow_bends_without_folds_when_turns_are_found() {
    let picture = plain(400, 80);
    let soft = arm(Rigidity::SOFT, 4000);
    let rigid = arm(Rigidity::Rigid, 4000);
    let (mesh, _) = mesh(&picture, &soft);
    let count = mesh.triangle_count();
    let right = std::f64::consts::FRAC_PI_2;
    let (found, _) = posed(&mesh, &bent(soft.clone(), right, None));
    println!(
        "soft: {} rounds, {} folded of {count}",
        found.rounds, found.folded
    );
    assert_eq!(found.folded, 0, "soft");
    let (found, _) = posed(&mesh, &bent(rigid.clone(), right, None));
    println!(
        "rigid: {} rounds, {} folded of {count}",
        found.rounds, found.folded
    );
    assert!(
        found.folded <= 2 * count / 1000,
        "rigid: {} of {count}",
        found.folded
    );
    // The paper's way, with no turn: the negative control.
    let propagated = |figure: Figure| Figure {
        rotations: Rotations::Propagated,
        ..bent(figure, right, Some(0.0))
    };
    let (soft_paper, notices) = posed(&mesh, &propagated(soft));
    println!("soft, propagated: {} folded", soft_paper.folded);
    assert!(soft_paper.folded > 0, "soft, propagated");
    assert!(
        notices.contains(&Notice::Folded {
            count: soft_paper.folded
        }),
        "named"
    );
    let (rigid_paper, _) = posed(&mesh, &propagated(rigid));
    println!("rigid, propagated: {} folded", rigid_paper.folded);
    assert!(
        rigid_paper.folded >= 20 * found.folded.max(1),
        "rigid, propagated: {}",
        rigid_paper.folded
    );
}

#[test]
fn bones_keep_their_shape() {
    let picture = plain(400, 80);
    let rigid = bent(arm(Rigidity::Rigid, 4000), 1.2, None);
    let (mesh, _) = mesh(&picture, &rigid);
    let of_bone = |mesh: &Mesh, name: &str| -> Vec<usize> {
        let mut vertices: Vec<usize> = (0..mesh.triangle_count())
            .filter(|t| mesh.tissue(*t).name == name)
            .flat_map(|t| mesh.triangles[t].map(|vertex| vertex as usize))
            .collect();
        vertices.sort_unstable();
        vertices.dedup();
        vertices
    };
    // By how much a bone's points miss the nearest rigid motion.
    let miss = |places: &[DVec2], bone: &[usize]| {
        let n = bone.len() as f64;
        let mean = |list: &[DVec2]| bone.iter().map(|v| list[*v]).sum::<DVec2>() / n;
        let (rest_mean, mean) = (mean(&mesh.vertices), mean(places));
        let conj_mul = |a: DVec2, b: DVec2| dvec2(a.dot(b), a.perp_dot(b));
        let sum: DVec2 = bone
            .iter()
            .map(|v| conj_mul(mesh.vertices[*v] - rest_mean, places[*v] - mean))
            .sum();
        let z = sum / sum.length();
        let away = |v: &usize| (mul(z, mesh.vertices[*v] - rest_mean) + mean).distance(places[*v]);
        bone.iter().map(away).fold(0.0, f64::max)
    };
    let bone = of_bone(&mesh, "ulna");
    let at = |rigidity| {
        let mut figure = rigid.clone();
        figure
            .regions
            .iter_mut()
            .for_each(|region| region.rigidity = rigidity);
        let (posed, _) = posed(&mesh, &figure);
        println!("{rigidity:?}: {} rounds", posed.rounds);
        posed.places
    };
    let places = at(Rigidity::Rigid);
    assert!(
        miss(&places, &bone) < 1e-9,
        "rigid: {:e}",
        miss(&places, &bone)
    );
    for (i, one) in bone.iter().enumerate().step_by(7) {
        for other in bone[i..].iter().step_by(5) {
            let (rest, now) = (
                mesh.vertices[*one].distance(mesh.vertices[*other]),
                places[*one].distance(places[*other]),
            );
            assert!((rest - now).abs() < 1e-5, "a distance in a bone");
        }
    }
    let (hard, soft) = (
        miss(&at(Rigidity::Elastic([10.0; 2])), &bone),
        miss(&at(Rigidity::SOFT), &bone),
    );
    println!("misses at 10 and 1: {hard} {soft}");
    assert!(hard < soft / 2.0, "at 10 {hard}, at 1 {soft}");
}

#[test]
fn rigidity_acts_by_axis_of_the_picture() {
    // Along x: the half with [10, 1] takes less than 2 % of the stretch.
    for is_upright in [false, true] {
        let picture = if is_upright {
            plain(80, 400)
        } else {
            plain(400, 80)
        };
        let place = |along: f64, across: f64| {
            if is_upright {
                [across, along]
            } else {
                [along, across]
            }
        };
        let (low, high) = (place(-0.5, -0.1), place(0.0, 0.1));
        let mut figure = Figure {
            regions: vec![rectangle("half", low, high, Rigidity::Elastic([10.0, 1.0]))],
            detail: 3000,
            ..Figure::default()
        };
        // Both ends are held over their whole width.
        let end = |along: f64, by: f64| Handle {
            hold: Hold::Line {
                points: vec![
                    DVec2::from(place(along, -0.1)),
                    DVec2::from(place(along, 0.1)),
                ],
                to: None,
            },
            radius: 0.001,
            motion: Move {
                by: DVec2::from(place(by, 0.0)),
                turn: Some(0.0),
                scale: 1.0,
            },
            ..Handle::pin(DVec2::ZERO, DVec2::ZERO)
        };
        figure.handles = vec![end(-0.5, 0.0), end(0.5, 0.2)];
        let (mesh, _) = mesh(&picture, &figure);
        let (posed, notices) = posed(&mesh, &figure);
        let middle = mesh
            .at_rest(DVec2::from(place(0.0, 0.0)))
            .expect("the middle is in the figure");
        let moved = mesh.carried(middle, &posed.places) - DVec2::from(place(0.0, 0.0));
        let share = if is_upright { moved.y } else { moved.x } / 0.2;
        println!(
            "upright {is_upright}: share {share}, {} rounds, {notices:?}",
            posed.rounds
        );
        if is_upright {
            assert!(
                (share / (1.0 - share) - 1.0).abs() < 0.05,
                "both halves take the same: {share}"
            );
        } else {
            assert!(share < 0.02, "the stiff half takes {share}");
        }
    }
}

/// A plate with 14 points and a pull at its side.
fn pulled(strength: f64) -> Figure {
    let ring = |i: usize| {
        let angle = std::f64::consts::TAU * i as f64 / 13.0;
        dvec2(0.22 * angle.cos(), 0.18 * angle.sin())
    };
    let points = (0..13).map(ring).chain([dvec2(0.01, 0.02)]).collect();
    Figure {
        handles: vec![
            pin([-0.45, 0.0], [0.0, 0.0], Some(0.0), 1.0),
            pin([0.28, 0.0], [0.25, 0.0], None, 1.0),
        ],
        context: Some(Context {
            points,
            strength,
            keep: true,
            like: None,
            amount: 1.0,
        }),
        detail: 3000,
        ..Figure::default()
    }
}

/// Sum of squares that is left when one list of points is brought to another by the nearest similarity, as a part of
/// the other's own.
fn shape_error(from: &[DVec2], to: &[DVec2]) -> f64 {
    let n = from.len() as f64;
    let (mean_from, mean_to) = (from.iter().sum::<DVec2>() / n, to.iter().sum::<DVec2>() / n);
    let (mut product, mut square) = (DVec2::ZERO, 0.0);
    for (a, b) in from.iter().zip(to) {
        let (a, b) = (*a - mean_from, *b - mean_to);
        product += dvec2(a.dot(b), a.perp_dot(b));
        square += a.length_squared();
    }
    let z = product / square;
    let left =
        |(a, b): (&DVec2, &DVec2)| (mul(z, *a - mean_from) - (*b - mean_to)).length_squared();
    let own: f64 = to.iter().map(|b| (*b - mean_to).length_squared()).sum();
    (from.iter().zip(to).map(left).sum::<f64>() / own).sqrt()
}

fn nearest_vertices(mesh: &Mesh, points: &[DVec2]) -> Vec<usize> {
    let nearest = |point: &DVec2| {
        let distance = |v: &usize| mesh.vertices[*v].distance(*point);
        (0..mesh.vertices.len())
            .min_by(|a, b| distance(a).total_cmp(&distance(b)))
            .expect("vertices")
    };
    points.iter().map(nearest).collect()
}

#[test]
fn a_context_keeps_its_shape_the_more_the_stronger_it_is() {
    let picture = plain(300, 240);
    let (mesh, _) = mesh(&picture, &pulled(5.0));
    let mut errors = Vec::new();
    for strength in [0.0, 1.0, 2.0, 5.0, 10.0] {
        let figure = pulled(strength);
        let (posed, notices) = posed(&mesh, &figure);
        let points = nearest_vertices(&mesh, &figure.context.as_ref().expect("a context").points);
        let places = |list: &[DVec2]| -> Vec<DVec2> { points.iter().map(|v| list[*v]).collect() };
        let error = shape_error(&places(&mesh.vertices), &places(&posed.places));
        println!(
            "strength {strength}: {error}, {} rounds, {:?} {notices:?}",
            posed.rounds, posed.context_found
        );
        errors.push(error);
    }
    assert!(
        errors.windows(2).all(|pair| pair[1] < pair[0]),
        "falls: {errors:?}"
    );
    assert!(
        errors[3] < errors[0] / 10.0,
        "at 5 below a tenth: {errors:?}"
    );
}

#[test]
fn a_likeness_takes_over_proportions() {
    let picture = plain(300, 240);
    let mut figure = pulled(5.0);
    figure.handles.clear();
    let context = figure.context.as_mut().expect("a context");
    let skew = |(i, p): (usize, &DVec2)| {
        let away = polar(0.04, i as f64 * 2.4);
        mul(polar(7.0, 0.4), *p + away) + dvec2(3.0, 1.0)
    };
    let like: Vec<DVec2> = context.points.iter().enumerate().map(skew).collect();
    context.like = Some(like.clone());
    let (mesh, _) = mesh(&picture, &figure);
    let points = nearest_vertices(&mesh, &figure.context.as_ref().expect("a context").points);
    let places = |list: &[DVec2]| -> Vec<DVec2> { points.iter().map(|v| list[*v]).collect() };
    let (taken, _) = posed(&mesh, &figure);
    let (before, after) = (
        shape_error(&like, &places(&mesh.vertices)),
        shape_error(&like, &places(&taken.places)),
    );
    println!(
        "likeness: {before} before, {after} after, {:?}",
        taken.context_found
    );
    assert!(after <= before / 10.0, "{before} {after}");
    figure.context.as_mut().expect("a context").amount = 0.0;
    let (none, _) = posed(&mesh, &figure);
    let most = furthest(&none.places, &mesh.vertices, |at| at);
    assert!(most < 1e-6, "amount 0 is the identity: {most:e}");
}

/// A plate with a round organ.
fn organ(rigidity: Rigidity) -> Figure {
    let ring = |i: i32| {
        let angle = std::f64::consts::TAU * f64::from(i) / 60.0;
        [0.2 * angle.cos(), 0.15 * angle.sin()]
    };
    Figure {
        regions: vec![polygon(
            "organ",
            &(0..60).map(ring).collect::<Vec<_>>(),
            rigidity,
        )],
        detail: 3000,
        ..Figure::default()
    }
}

/// The outline of the organ as the mesh has it: counter-clockwise from the vertex of smallest x, then y.
fn outline(mesh: &Mesh) -> Vec<usize> {
    let mut next = std::collections::BTreeMap::new();
    let triangles: Vec<[u32; 3]> = (0..mesh.triangle_count())
        .filter(|t| mesh.tissue(*t).part == Part::Region(0))
        .map(|t| mesh.triangles[t])
        .collect();
    let edges: std::collections::BTreeSet<(u32, u32)> = triangles
        .iter()
        .flat_map(|[a, b, c]| [(*a, *b), (*b, *c), (*c, *a)])
        .collect();
    for (a, b) in &edges {
        if !edges.contains(&(*b, *a)) {
            next.insert(*a as usize, *b as usize);
        }
    }
    let key = |v: &usize| (mesh.vertices[*v].x, mesh.vertices[*v].y);
    let first = *next
        .keys()
        .min_by(|a, b| key(a).partial_cmp(&key(b)).expect("numbers"))
        .expect("an outline");
    let mut line = vec![first];
    while next[line.last().expect("a vertex")] != first {
        line.push(next[line.last().expect("a vertex")]);
    }
    line
}

fn contour(like: Vec<DVec2>) -> Contour {
    Contour {
        region: "organ".to_owned(),
        like,
        amount: 1.0,
        mirror: false,
        keep: Vec::new(),
    }
}

#[test]
fn a_contour_takes_the_style_of_another() {
    let picture = plain(300, 240);
    let mut figure = organ(Rigidity::SOFT);
    let (mesh, _) = mesh(&picture, &figure);
    let line = outline(&mesh);
    let places = |list: &[DVec2]| -> Vec<DVec2> { line.iter().map(|v| list[*v]).collect() };
    // Its own outline, turned and scaled.
    let own: Vec<DVec2> = places(&mesh.vertices)
        .iter()
        .map(|p| mul(polar(40.0, 1.1), *p) + dvec2(5.0, 0.0))
        .collect();
    figure.contours = vec![contour(own)];
    let most = furthest(&posed(&mesh, &figure).0.places, &mesh.vertices, |at| at);
    assert!(most < 1e-3, "its own outline moves nothing: {most:e}");
    // A smooth reference with three lobes.
    let lobes = |i: i32| {
        let angle = std::f64::consts::TAU * f64::from(i) / 200.0;
        polar(3.0 + 0.5 * (3.0 * angle).cos(), angle)
    };
    let like: Vec<DVec2> = (0..200).map(lobes).collect();
    figure.contours = vec![contour(like.clone())];
    let (taken, _) = posed(&mesh, &figure);
    let error = outline_error(&places(&taken.places), &like);
    let before = outline_error(&places(&mesh.vertices), &like);
    println!(
        "contour: {before} before, {error} after, {} folded",
        taken.folded
    );
    assert!(error < 0.01 && before > 0.05, "{before} {error}");
    // Kept places.
    let kept = [places(&mesh.vertices)[3], places(&mesh.vertices)[40]];
    figure.contours[0].keep = kept.to_vec();
    let (held, _) = posed(&mesh, &figure);
    for at in kept {
        let triangle = mesh.at_rest(at).expect("in the figure");
        assert!(
            mesh.carried(triangle, &held.places).distance(at) < 0.01,
            "a kept place"
        );
    }
    // Half of it, mirrored, on a rigid region: a shape, and then a pose on top.
    figure.contours = vec![Contour {
        amount: 0.5,
        mirror: true,
        ..contour(like)
    }];
    figure.regions[0].rigidity = Rigidity::Rigid;
    figure.handles = vec![
        pin([0.0, 0.0], [0.1, 0.05], Some(0.5), 1.0),
        pin([-0.45, 0.0], [0.0, 0.0], None, 1.0),
    ];
    let (both, notices) = posed(&mesh, &figure);
    let carried = |at: DVec2| mul(polar(1.0, 0.5), at);
    let centre = mesh.carried(
        mesh.at_rest(DVec2::ZERO).expect("in the figure"),
        &both.base,
    );
    for (place, base) in places(&both.places).iter().zip(places(&both.base)) {
        let wanted = centre + dvec2(0.1, 0.05) + carried(base - centre);
        assert!(
            place.distance(wanted) < 1e-9,
            "the changed shape is posed as a whole: {notices:?}"
        );
    }
}

/// The largest distance of an outline's points from a reference after the best similarity, in the outline's size. The
/// best start along the reference is searched for.
fn outline_error(line: &[DVec2], like: &[DVec2]) -> f64 {
    let sampled = |line: &[DVec2], start: f64| -> Vec<DVec2> {
        let n = line.len();
        let length: f64 = (0..n).map(|i| line[i].distance(line[(i + 1) % n])).sum();
        let at = |k: i32| {
            let mut left = length * (f64::from(k) / 256.0 + start).fract();
            for i in 0..n {
                let step = line[i].distance(line[(i + 1) % n]);
                if left <= step {
                    return line[i].lerp(line[(i + 1) % n], left / step);
                }
                left -= step;
            }
            line[0]
        };
        (0..256).map(at).collect()
    };
    let to = sampled(line, 0.0);
    let size = to
        .iter()
        .map(|p| p.distance(to.iter().sum::<DVec2>() / 256.0))
        .fold(0.0, f64::max)
        * 2.0;
    let error = |start: i32| {
        let from = sampled(like, f64::from(start) / 1024.0);
        let n = 256.0;
        let (mean_from, mean_to) = (from.iter().sum::<DVec2>() / n, to.iter().sum::<DVec2>() / n);
        let (mut product, mut square) = (DVec2::ZERO, 0.0);
        for (a, b) in from.iter().zip(&to) {
            let (a, b) = (*a - mean_from, *b - mean_to);
            product += dvec2(a.dot(b), a.perp_dot(b));
            square += a.length_squared();
        }
        let z = product / square;
        let away = |(a, b): (&DVec2, &DVec2)| (mul(z, *a - mean_from) + mean_to).distance(*b);
        from.iter().zip(&to).map(away).fold(0.0, f64::max)
    };
    (0..1024).map(error).fold(f64::INFINITY, f64::min) / size
}

#[test]
fn pins_that_do_not_fit_their_bone_are_named() {
    let picture = plain(400, 80);
    let mut figure = arm(Rigidity::Rigid, 2000);
    figure.handles = vec![
        pin([-0.4, 0.0], [0.0, 0.0], None, 1.0),
        pin([-0.1, 0.0], [0.1, 0.0], None, 1.0),
    ];
    let (mesh, _) = mesh(&picture, &figure);
    let (posed, notices) = posed(&mesh, &figure);
    let by = notices.iter().find_map(|notice| match notice {
        Notice::BoneMisfit { region, by } if region == "humerus" => Some(*by),
        _ => None,
    });
    assert!(by.is_some_and(|by| (by - 0.05).abs() < 1e-6), "{notices:?}");
    assert!(posed.places.iter().all(|place| place.is_finite()), "finite");
}

#[test]
fn hostile_handles_are_kept_and_named() {
    let picture = plain(200, 100);
    let mut figure = Figure {
        regions: vec![
            Region::new("nothing"),
            rectangle("bone", [-0.2, -0.1], [0.2, 0.1], Rigidity::Rigid),
        ],
        detail: 800,
        ..Figure::default()
    };
    figure.handles = vec![
        pin([3.0, 3.0], [0.1, 0.0], None, 1.0),
        Handle {
            hold: Hold::Region("nowhere".to_owned()),
            ..pin([0.0, 0.0], [0.0, 0.0], None, 1.0)
        },
        Handle {
            hold: Hold::Region("nothing".to_owned()),
            ..pin([0.0, 0.0], [0.0, 0.0], None, 1.0)
        },
        Handle {
            hold: Hold::Line {
                points: vec![dvec2(-0.45, 0.0); 3],
                to: Some(vec![dvec2(-0.45, 0.1); 3]),
            },
            ..pin([0.0, 0.0], [0.0, 0.0], None, 1.0)
        },
        pin([0.509, 0.0], [0.02, 0.0], None, 1.0),
    ];
    figure.context = Some(Context {
        points: vec![dvec2(-0.4, 0.0), dvec2(0.0, 0.0), dvec2(0.4, 0.0)],
        strength: 5.0,
        keep: true,
        like: None,
        amount: 1.0,
    });
    let (mesh, mut all) = mesh(&picture, &figure);
    let (posed, notices) = posed(&mesh, &figure);
    all.extend(notices);
    println!("{all:?}");
    for wanted in [
        Notice::EmptyRegion {
            name: "nothing".to_owned(),
        },
        Notice::HandleOutside { index: 0 },
        Notice::UnknownRegion {
            pointer: "/figure/handles/1/region".to_owned(),
            name: "nowhere".to_owned(),
        },
        Notice::HandleOutside { index: 2 },
        Notice::ContextPoints { used: 0 },
    ] {
        assert!(all.contains(&wanted), "{wanted:?}");
    }
    assert!(posed.places.iter().all(|place| place.is_finite()), "finite");
}
