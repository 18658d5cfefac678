//! What a cut shows of bodies that are hollow, thick and solid, closed and open; and that templates which do nothing
//! change nothing (spec/surfaces.md, "What the object has at a point, and what a ray meets").

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::data::data_folder;
use crate::gpu::{gpu, software};
use crate::scatter::Random;
use crate::surfaces::{ball_mesh, brick, surface_of};
use fabrica::data::{Subject, Surface};
use fabrica::document::Document;
use fabrica::math::linear_from_srgb;
use fabrica::render::{Image, Meeting, RayEvent, Studio};
use glam::Vec3;

/// How far borders of layers and shells may be off, subject units: the page's bound.
const FARTHEST: f32 = 0.002;

/// Everything above the middle is away.
const HALF: &str = r#"{"kind":"cut","params":{"shape":"halfspace"}}"#;

fn document(look: &str, templates: &str) -> Document {
    let json = format!(
        r#"{{"fabrica":1,"subject":{{"src":"body.stl"}},"look":{{{look}}},"templates":[{templates}],
            "camera":{{"rotate":[0.3,0.2,0.1,0.92]}}}}"#
    );
    Document::from_json(&json).expect("a good document")
}

fn studio(surface: &Arc<Surface>) -> Studio {
    let subject = Subject::from(Arc::clone(surface));
    Studio::new(gpu(), &subject, true).expect("it fits")
}

fn events(studio: &Studio, document: &Document, rays: &[(Vec3, Vec3)]) -> Vec<Option<RayEvent>> {
    pollster::block_on(studio.events(document.illustration(), rays)).expect("events")
}

/// A ball that is cut in the middle has rings of its layers' colours.
#[test]
fn a_solid_ball_has_rings() {
    let mesh = ball_mesh(72);
    assert!(mesh.triangles.len() > 20_000);
    let surface = Surface::new(&mesh, None, &mut |_| true).expect("it has a size");
    let layers: [(f32, [u8; 3]); 3] = [
        (0.0, [0xb8, 0x43, 0x3a]),
        (0.1, [0xf2, 0xe3, 0xb3]),
        (0.25, [0x40, 0x60, 0x80]),
    ];
    let list = layers.map(|(depth, [r, g, b])| {
        format!(r##"{{"depth":{depth},"color":"#{r:02x}{g:02x}{b:02x}"}}"##)
    });
    let look = format!(r#""body":"solid","layers":[{}]"#, list.join(","));
    let mut random = Random(8);
    let mut places = Vec::new();
    while places.len() < 2000 {
        let place = random.vector(-0.5, 0.5).with_z(0.0);
        let depth = 0.5 - place.length();
        let is_border = |border: &(f32, [u8; 3])| (depth - border.0).abs() < FARTHEST;
        if depth > 0.0 && !layers.iter().any(is_border) {
            places.push(place);
        }
    }
    let rays: Vec<(Vec3, Vec3)> = places.iter().map(|p| (p.with_z(2.0), -Vec3::Z)).collect();
    let found = events(&studio(&Arc::new(surface)), &document(&look, HALF), &rays);
    let color_at = |depth: f32| {
        let layer = layers.iter().rev().find(|layer| layer.0 <= depth);
        Vec3::from(layer.expect("the first").1.map(linear_from_srgb))
    };
    let mut near = 0;
    for (place, event) in places.iter().zip(found) {
        let event = event.expect("the cut face");
        assert_eq!(event.meeting, Meeting::Cut, "{place}");
        assert!((event.distance - 2.0).abs() < 1e-3, "{place}: {event:?}");
        let depth = 0.5 - place.length();
        let off = event.albedo.distance(color_at(depth));
        assert!(off < 0.01, "{depth}: {event:?}");
        // What the comparison would say of borders that are elsewhere.
        near += usize::from(event.albedo.distance(color_at(depth + 2.0 * FARTHEST)) > 0.01);
    }
    assert!(near > 10, "{near} places tell borders that are wrong");
}

/// A box that is cut shows its back sides, the rim of its shell and its inner wall, or a full face.
#[test]
fn a_shell_is_as_thick_as_it_is_said_to_be() {
    let studio = studio(&brick());
    let thickness = 0.05;
    let mut random = Random(9);
    let mut rays = Vec::new();
    for _ in 0..1000 {
        let (x, y) = (random.between(-0.5, 0.5), random.between(-0.3, 0.3));
        rays.push((Vec3::new(x, y, 2.0), -Vec3::Z));
    }
    for body in ["hollow", "thick", "solid"] {
        let look = format!(r#""body":"{body}","thickness":{thickness}"#);
        let found = events(&studio, &document(&look, HALF), &rays);
        let mut rim = 0;
        for ((origin, _), event) in rays.iter().zip(found) {
            let depth = (0.5 - origin.x.abs()).min(0.3 - origin.y.abs());
            if depth.min((depth - thickness).abs()) < FARTHEST {
                continue;
            }
            let is_rim = depth < thickness;
            rim += usize::from(is_rim);
            let (meeting, distance) = match body {
                "hollow" => (Meeting::Inside, 2.4),
                "thick" if !is_rim => (Meeting::Cut, 2.4 - thickness),
                _ => (Meeting::Cut, 2.0),
            };
            let event = event.expect("something is there");
            assert_eq!(event.meeting, meeting, "{body} at {origin}: {event:?}");
            let off = (event.distance - distance).abs();
            assert!(off < FARTHEST, "{body} at {origin}: {event:?}");
        }
        assert!(rim > 100, "{rim} rays meet the rim");
    }
}

/// Middle of a surface's open rim, the way out of it, and the middles of its edges.
fn rim_of(surface: &Surface) -> (Vec3, Vec3, Vec<Vec3>) {
    let mut edges: BTreeMap<[[u32; 3]; 2], (i32, [Vec3; 2])> = BTreeMap::new();
    let own = (0..surface.triangles.len()).filter(|i| !surface.is_lid(*i));
    for corners in own.map(|i| surface.triangles[i].0) {
        for k in 0..3 {
            let ends = [corners[k], corners[(k + 1) % 3]];
            let [a, b] = ends.map(|end| end.to_array().map(f32::to_bits));
            edges.entry([a.min(b), a.max(b)]).or_insert((0, ends)).0 += 1;
        }
    }
    let open: Vec<[Vec3; 2]> = edges
        .into_values()
        .filter_map(|(count, ends)| (count == 1).then_some(ends))
        .collect();
    let middles: Vec<Vec3> = open.iter().map(|[a, b]| a.midpoint(*b)).collect();
    let middle = middles.iter().sum::<Vec3>() / middles.len() as f32;
    let turned = open.iter().map(|[a, b]| (a - middle).cross(b - middle));
    let out = turned.sum::<Vec3>().normalize();
    (middle, out * out.dot(middle).signum(), middles)
}

/// A hand that is open at the wrist is seen into, or closed by a lid.
#[test]
fn an_open_hand_is_seen_into_or_closed() {
    check_hand("auto", Meeting::Inside, false, 0);
    check_hand("solid", Meeting::Cut, true, 16);
}

/// As a shell it has a rim, and is seen into up to its inner wall.
#[test]
fn an_open_shell_has_a_rim() {
    check_hand("thick", Meeting::Cut, false, 16);
}

/// Rays into the opening of the hand meet `within`, at the opening or far behind it, and so many onto its rim a cut
/// face at once.
fn check_hand(body: &str, within: Meeting, is_at_once: bool, on_rim: usize) {
    let Some(folder) = data_folder("an open hand") else {
        return;
    };
    let bytes = std::fs::read(folder.join("mesh/hand_lowres.obj")).expect("the hand");
    let surface = surface_of("hand_lowres.obj", bytes);
    let (middle, out, edges) = rim_of(&surface);
    assert_eq!(edges.len(), 16, "edges of one triangle");
    let away = 0.3;
    let aim = |place: Vec3| (place + away * out, -out);
    let into = edges.iter().map(|edge| aim(middle.lerp(*edge, 0.4)));
    let thickness = 0.02;
    let onto = edges.iter().map(|edge| {
        let inwards = (middle - edge).reject_from_normalized(out).normalize();
        aim(edge + 0.5 * thickness * inwards)
    });
    let rays: Vec<(Vec3, Vec3)> = into.chain(onto).collect();
    let look = format!(r#""body":"{body}","thickness":{thickness}"#);
    let found = events(&studio(&surface), &document(&look, ""), &rays);
    let told = |events: &[Option<RayEvent>], meeting: Meeting, is_at_once: bool| {
        let is_near = |event: &RayEvent| event.distance < away + 0.03;
        let events = events.iter().flatten();
        let is_it = |event: &&RayEvent| event.meeting == meeting && is_near(event) == is_at_once;
        events.filter(is_it).count()
    };
    let (into, onto) = found.split_at(edges.len());
    let counts = [
        told(into, within, is_at_once),
        told(onto, Meeting::Cut, true),
    ];
    assert_eq!(counts, [16, on_rim], "{body}");
}

/// How many pixels of two pictures differ by more than 1 of 255.
fn apart(a: &Image, b: &Image) -> usize {
    let pairs = a.rgba.chunks_exact(4).zip(b.rgba.chunks_exact(4));
    let is_apart = |(a, b): &(&[u8], &[u8])| a.iter().zip(*b).any(|(a, b)| a.abs_diff(*b) > 1);
    pairs.filter(is_apart).count()
}

/// A template far from a mesh, one of which nothing is done and one that is switched off change no pixel by more than
/// 1 of 255, nor does the grid; no line is seen along the border of their boxes.
#[test]
fn what_does_nothing_changes_no_pixel() {
    let mesh = ball_mesh(24);
    let surface = Surface::new(&mesh, None, &mut |_| true).expect("it has a size");
    let subject = Subject::from(Arc::new(surface));
    let studio = Studio::new(software(), &subject, true).expect("it fits");
    let draw = |studio: &Studio, templates: &str| {
        let document = document(r#""body":"solid""#, templates);
        let image = studio.render_image(document.illustration(), [120, 90], 2);
        pollster::block_on(image).expect("a picture")
    };
    let twist = r#"{"kind":"twist","size":[0.9,0.9,0.6],"params":{"angle":1.2}}"#;
    let split = r#""kind":"split","size":[0.7,0.7,0.7]"#;
    let plain = draw(&studio, twist);
    for other in [
        r#"{"kind":"peel","at":[3,0,0]}"#.to_owned(),
        format!(r#"{{{split},"at":[0.2,0.2,0.2],"amount":0}}"#),
        format!(r#"{{{split},"at":[0.2,0.2,0.2],"enabled":false}}"#),
    ] {
        let count = apart(&plain, &draw(&studio, &format!("{twist},{other}")));
        assert_eq!(count, 0, "{other}");
    }
    let without = draw(&studio.with_grid(false), twist);
    assert_eq!(apart(&plain, &without), 0, "without the grid");
    let open = format!(r#"{twist},{{{split},"at":[0.2,0.2,0.2]}}"#);
    let [open, bare] = [true, false].map(|grid| draw(&studio.with_grid(grid), &open));
    assert!(apart(&plain, &open) > 500, "an open one is seen");
    assert_eq!(apart(&open, &bare), 0, "a split without the grid");
}
