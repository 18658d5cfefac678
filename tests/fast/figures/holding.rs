//! What handles, fixed regions and `only` hold, as the export says it (spec/figures.md, "Handles").

use super::common::*;
use fabrica::document::figure::{Figure, Handle, Hold, Move, Rest, Rigidity};
use fabrica::figure::Notice;
use fabrica::figure::exported;
use fabrica::figure::solve::{Posed, Rig};
use glam::{DVec2, dvec2};
use serde_json::Value;

fn solved(figure: &Figure) -> (Value, Posed, Vec<Notice>) {
    let picture = plain(400, 200);
    let (mesh, mut notices) = mesh(&picture, figure);
    let rig = Rig::new(&mesh, figure, &mut notices);
    let posed = rig.posed(figure, &mut notices);
    (exported(&rig, figure, &posed), posed, notices)
}

fn place(value: &Value) -> DVec2 {
    dvec2(value[0].as_f64().expect("x"), value[1].as_f64().expect("y"))
}

/// Vertices of an exported figure that move by more than a millionth.
fn moving(file: &Value) -> Vec<usize> {
    let list = |key: &str| -> Vec<DVec2> {
        file[key]
            .as_array()
            .expect("points")
            .iter()
            .map(place)
            .collect()
    };
    let (rest, now) = (list("vertices"), list("positions"));
    (0..rest.len())
        .filter(|v| rest[*v].distance(now[*v]) > 1e-6)
        .collect()
}

fn indices(value: &Value) -> Vec<usize> {
    value
        .as_array()
        .expect("indices")
        .iter()
        .map(|v| v.as_u64().expect("an index") as usize)
        .collect()
}

fn bar() -> Figure {
    Figure {
        regions: vec![
            rectangle("left", [-0.45, -0.2], [-0.2, 0.2], Rigidity::SOFT),
            rectangle("bone", [0.0, -0.03], [0.3, 0.03], Rigidity::Rigid),
        ],
        handles: vec![Handle::pin(dvec2(0.1, 0.15), dvec2(0.05, 0.08))],
        detail: 2000,
        ..Figure::default()
    }
}

#[test]
fn fixed_regions_and_the_outside_of_only_stay() {
    let mut figure = bar();
    figure.regions[0].fixed = true;
    let (file, ..) = solved(&figure);
    let fixed = indices(&file["handles"][1]["vertices"]);
    assert_eq!(
        file["handles"][1]["kind"], "region",
        "a fixed region is a handle, last"
    );
    assert!(
        fixed.len() > 50 && moving(&file).iter().all(|v| !fixed.contains(v)),
        "it stays"
    );
    figure.only = Some(vec![
        dvec2(-0.1, -0.3),
        dvec2(0.2, -0.3),
        dvec2(0.2, 0.3),
        dvec2(-0.1, 0.3),
    ]);
    let (file, _, notices) = solved(&figure);
    assert_eq!(file["handles"][2]["kind"], "outside", "last of all");
    assert!(
        notices.contains(&Notice::OnlyCrossesRigid {
            region: "bone".to_owned()
        }),
        "{notices:?}"
    );
    // The bone crosses the border: it moves as a whole, and no vertex of it is held.
    let rest: Vec<DVec2> = file["vertices"]
        .as_array()
        .expect("points")
        .iter()
        .map(place)
        .collect();
    let is_bone = |v: usize| (-0.02..0.32).contains(&rest[v].x) && rest[v].y.abs() < 0.05;
    let moving = moving(&file);
    let inside = |v: &usize| (-0.1..=0.2).contains(&rest[*v].x) || is_bone(*v);
    assert!(moving.iter().all(inside), "nothing else moves outside");
    assert!(
        moving.iter().any(|v| rest[*v].x > 0.25 && is_bone(*v)),
        "the bone does"
    );
}

#[test]
fn a_rest_that_is_kept_is_held_by_nothing() {
    let mut figure = bar();
    figure.rest = Rest::Keep;
    figure.handles[0] = Handle::pin(dvec2(-0.1, 0.1), dvec2(0.1, 0.0));
    let (file, _, notices) = solved(&figure);
    assert!(
        notices.contains(&Notice::HandleOutside { index: 0 }),
        "{notices:?}"
    );
    assert_eq!(
        file["handles"],
        Value::Array(Vec::new()),
        "no handle is used"
    );
    assert_eq!(moving(&file), [0_usize; 0], "nothing moves");
    figure.handles[0] = Handle::pin(dvec2(0.1, 0.0), dvec2(0.1, 0.0));
    figure.handles[0].motion.turn = Some(0.0);
    let (file, ..) = solved(&figure);
    let bone = indices(&file["handles"][0]["vertices"]);
    assert_eq!(moving(&file), bone, "the bone alone moves");
}

#[test]
fn handles_hold_in_their_order_and_may_be_off() {
    let mut figure = bar();
    let mut other = figure.handles[0].clone();
    other.motion.by = dvec2(-0.1, 0.0);
    figure.handles.push(other);
    figure
        .handles
        .iter_mut()
        .for_each(|handle| handle.motion.turn = Some(0.0));
    let by = |figure: &Figure| {
        let (file, ..) = solved(figure);
        let first = indices(&file["handles"][0]["vertices"])[0];
        place(&file["positions"][first]) - place(&file["vertices"][first])
    };
    assert!(
        (by(&figure) - dvec2(0.05, 0.08)).length() < 1e-12,
        "the first decides"
    );
    figure.handles[0].enabled = false;
    assert!(
        (by(&figure) - dvec2(-0.1, 0.0)).length() < 1e-12,
        "it is off"
    );
}

#[test]
fn a_line_takes_tissue_along_and_leaves_bones_alone() {
    let mut figure = bar();
    let points = vec![dvec2(-0.1, 0.0), dvec2(0.1, 0.0), dvec2(0.15, 0.1)];
    let to = vec![dvec2(-0.1, 0.02), dvec2(0.1, 0.05), dvec2(0.12, 0.14)];
    figure.handles[0] = Handle {
        hold: Hold::Line {
            points,
            to: Some(to),
        },
        motion: Move::default(),
        ..figure.handles[0].clone()
    };
    let (file, ..) = solved(&figure);
    let line = &file["handles"][0];
    assert_eq!(line["kind"], "line", "a line");
    let vertices = indices(&line["vertices"]);
    for (v, to) in vertices
        .iter()
        .zip(line["to"].as_array().expect("by vertex"))
    {
        let rest = place(&file["vertices"][*v]);
        assert!(
            place(&file["positions"][*v]).distance(place(to)) < 1e-12,
            "it takes what it holds"
        );
        let is_inside = (0.001..0.299).contains(&rest.x) && rest.y.abs() < 0.028;
        assert!(!is_inside, "no vertex inside the bone: {rest}");
    }
    assert!(vertices.len() > 10, "{} vertices", vertices.len());
}

#[test]
fn too_many_rigid_parts_are_elastic_and_listed() {
    let picture = plain(1024, 1024);
    let regions = (0..15).map(|i| {
        // A comb: each region is many bones, as the next one covers what lies between.
        let y = f64::from(i) * 0.06 - 0.45;
        rectangle(
            &format!("row {i}"),
            [-0.48, y],
            [0.48, y + 0.03],
            Rigidity::Rigid,
        )
    });
    let mut figure = Figure {
        regions: regions.collect(),
        detail: 8000,
        ..Figure::default()
    };
    for i in 0..10 {
        let x = f64::from(i) * 0.1 - 0.48 + 0.03 + f64::from(i) * 0.001;
        let cut = rectangle(
            &format!("gap {i}"),
            [x, -0.5],
            [x + 0.05, 0.5],
            Rigidity::SOFT,
        );
        figure.regions.push(cut);
    }
    let (mesh, mut notices) = mesh(&picture, &figure);
    let rig = Rig::new(&mesh, &figure, &mut notices);
    let posed = rig.posed(&figure, &mut notices);
    let count = notices.iter().find_map(|notice| match notice {
        Notice::RigidParts { count } => Some(*count),
        _ => None,
    });
    println!("{count:?} parts");
    assert!(count.is_some_and(|count| count > 128), "{notices:?}");
    let file = exported(&rig, &figure, &posed);
    let regions = file["regions"].as_array().expect("regions");
    let elastic: Vec<usize> = (0..regions.len())
        .filter(|i| {
            regions[*i]["name"]
                .as_str()
                .is_some_and(|name| name.ends_with(" (elastic)"))
        })
        .collect();
    assert!(!elastic.is_empty(), "listed");
    assert!(
        elastic.iter().all(|i| regions[*i]["rigidity"] == 10.0),
        "as 10"
    );
    let of = indices(&file["region"]);
    assert!(elastic.iter().all(|i| of.contains(i)), "with triangles");
}
