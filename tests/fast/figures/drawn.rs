//! The built-in figures: what they are drawn with, that regions take what the table says, and that bones leave a
//! joint's width.

use std::collections::BTreeMap;

use fabrica::document::DRAWN_FIGURES;
use fabrica::document::figure::{Context, Figure, Rigidity};
use fabrica::figure::drawn::{CHILD_FACE, Drawn, FACE_POINTS, OLD_FACE, drawn};
use fabrica::figure::mesh::{Mesh, Part};
use fabrica::figure::regions::Canvas;
use fabrica::figure::solve::Rig;
use fabrica::figure::svg::Drawing;
use fabrica::figure::{Plane, unwatched};
use glam::{DVec2, dvec2};
use std::sync::Arc;

const REGIONS: [(&str, &[&str]); 5] = [
    (
        "drawn-arm",
        &[
            "skin",
            "humerus",
            "ulna",
            "radius",
            "hand",
            "biceps",
            "triceps",
            "brachialis",
        ],
    ),
    (
        "drawn-foot",
        &[
            "skin",
            "tibia",
            "fibula",
            "talus",
            "calcaneus",
            "midfoot",
            "metatarsals",
            "toes",
            "Achilles tendon",
            "plantar fascia",
        ],
    ),
    (
        "drawn-neck",
        &[
            "skin",
            "skull",
            "jaw",
            "C1",
            "C2",
            "C3",
            "C4",
            "C5",
            "C6",
            "C7",
            "T1",
            "discs",
            "spinal cord",
            "gullet and windpipe",
        ],
    ),
    (
        "drawn-heart",
        &[
            "wall",
            "left ventricle",
            "right ventricle",
            "left atrium",
            "right atrium",
            "septum",
            "valves",
            "aorta",
        ],
    ),
    (
        "drawn-face",
        &["outline", "eyes", "brows", "nose", "mouth", "ears"],
    ),
];

fn mesh(drawn: &Drawn, figure: &Figure) -> Arc<Mesh> {
    let drawing = Drawing::read(drawn.svg.as_bytes()).expect("a drawing");
    let plane = Plane::of_drawing(drawing.size);
    let canvas = Canvas {
        plane,
        picture: None,
        drawn: Some(drawing.drawn(&plane)),
        shapes: &|path| drawing.fills(&plane, path),
    };
    let mut notices = Vec::new();
    let mesh = Mesh::new(&canvas, figure, &mut notices, &mut unwatched).expect("not stopped");
    assert_eq!(notices, [], "nothing to say of {}", drawn.title);
    Arc::new(mesh)
}

fn figure(drawn: &Drawn) -> Figure {
    Figure {
        regions: drawn.regions.clone(),
        ..Figure::default()
    }
}

#[test]
fn they_have_the_regions_of_the_contract() {
    assert_eq!(REGIONS.map(|(name, _)| name), DRAWN_FIGURES, "all of them");
    for (name, wanted) in REGIONS {
        let drawn = drawn(name).expect("built in");
        let mut found: Vec<&str> = drawn
            .regions
            .iter()
            .map(|region| region.name.as_str())
            .collect();
        let mut wanted = wanted.to_vec();
        found.sort_unstable();
        wanted.sort_unstable();
        assert_eq!(found, wanted, "{name}");
        let mesh = mesh(&drawn, &figure(&drawn));
        let triangles = mesh.triangle_count();
        assert!(
            (3000..=10_500).contains(&triangles),
            "{name}: {triangles} triangles"
        );
        for tissue in mesh
            .tissues
            .iter()
            .filter(|tissue| tissue.part != Part::Rest)
        {
            assert!(
                tissue.pixels > 2000,
                "{name}: {} takes {} pixels",
                tissue.name,
                tissue.pixels
            );
        }
    }
}

#[test]
fn they_are_drawn_with_curves_only() {
    for name in DRAWN_FIGURES {
        let svg = drawn(name).expect("built in").svg;
        assert!(svg.len() < 40_000, "{name}: {} bytes", svg.len());
        let drawing = Drawing::read(svg.as_bytes()).expect("a drawing");
        assert!(
            drawing.left_out.is_empty() && drawing.words.is_empty(),
            "{name}: all is drawn"
        );
        for data in svg
            .split(" d=\"")
            .skip(1)
            .filter_map(|rest| rest.split('"').next())
        {
            let is_known = |c: char| "McCqQlLz -".contains(c) || c.is_ascii_digit();
            assert!(data.chars().all(is_known), "{name}: {data}");
        }
        for word in [
            "<use", "href", "style", "clip", "mask", "filter", "<text", "<image",
        ] {
            assert!(!svg.contains(word), "{name} has no {word}");
        }
    }
}

#[test]
fn no_two_bones_touch() {
    for name in DRAWN_FIGURES {
        let drawn = drawn(name).expect("built in");
        let figure = figure(&drawn);
        let mesh = mesh(&drawn, &figure);
        let mut bone_at: BTreeMap<u32, usize> = BTreeMap::new();
        let mut touching = BTreeMap::new();
        for (corners, tissue) in mesh.triangles.iter().zip(&mesh.tissue_of) {
            let Part::Region(i) = mesh.tissues[usize::from(*tissue)].part else {
                continue;
            };
            if figure.regions[i].rigidity != Rigidity::Rigid {
                continue;
            }
            for corner in corners {
                let other = *bone_at.entry(*corner).or_insert(i);
                if other != i {
                    touching.insert(
                        (&figure.regions[other].name, &figure.regions[i].name),
                        mesh.vertices[*corner as usize].to_array(),
                    );
                }
            }
        }
        assert_eq!(touching, BTreeMap::new(), "{name}");
    }
}

#[test]
fn a_face_grows_old_and_young() {
    let drawn = drawn("drawn-face").expect("built in");
    let points =
        |list: &[[f64; 2]; 16]| -> Vec<DVec2> { list.iter().map(|[x, y]| dvec2(*x, *y)).collect() };
    for (like, is_wider) in [(OLD_FACE, false), (CHILD_FACE, true)] {
        let figure = Figure {
            context: Some(Context {
                points: points(&FACE_POINTS),
                strength: 10.0,
                keep: true,
                like: Some(points(&like)),
                amount: 1.0,
            }),
            ..figure(&drawn)
        };
        let mesh = mesh(&drawn, &figure);
        let mut notices = Vec::new();
        let posed = Rig::new(&mesh, &figure, &mut notices).posed(&figure, &mut notices);
        let now: Vec<DVec2> = figure
            .context
            .iter()
            .flat_map(|context| &context.points)
            .map(|at| fabrica::figure::probe::forward(&mesh, &posed.places, *at).place)
            .collect();
        // How far the cheeks lie apart for the height of the face.
        assert_eq!(
            now[2].distance(now[3]) / now[0].distance(now[1])
                > FACE_POINTS[3][0] * 2.0 / (FACE_POINTS[0][1] - FACE_POINTS[1][1]),
            is_wider,
            "cheeks of {like:?}: {notices:?}"
        );
    }
}
