//! Drawings in and out (issue 18, must show 17 and "Bad input").

use std::time::Instant;

use fabrica::document::figure::{Figure, Handle, Region, Rigidity, Source};
use fabrica::figure::Notice;
use fabrica::figure::mesh::Mesh;
use fabrica::figure::regions::Canvas;
use fabrica::figure::solve::Rig;
use fabrica::figure::svg::{Drawing, Label, Outline, SvgError, bent};
use fabrica::figure::{Plane, unwatched};
use glam::{DVec2, dvec2};
use std::path::Path;
use std::sync::Arc;

use crate::data::data_folder;

fn drawing(folder: &Path, name: &str) -> Drawing {
    let bytes = std::fs::read(folder.join("image2d").join(name)).expect("the drawing is there");
    Drawing::read(&bytes).expect("an SVG")
}

fn area(outline: &Outline) -> f64 {
    let of = |line: &Vec<DVec2>| {
        let ends = line.iter().zip(line.iter().cycle().skip(1));
        ends.map(|(a, b)| (*a - line[0]).perp_dot(*b - line[0]))
            .sum::<f64>()
            / 2.0
    };
    outline.flattened(1e-4).iter().map(of).sum()
}

#[test]
fn the_shapes_of_the_test_data_are_named() {
    let Some(folder) = data_folder("figures::svg::the_shapes_of_the_test_data_are_named") else {
        return;
    };
    for (name, size, filled) in [
        ("hand-bones-labeled.svg", dvec2(406.479, 391.48), 120),
        ("homo_sapiens.brain.svg", dvec2(143.50569, 121.65815), 6),
        ("rib-cage-anterior.svg", dvec2(595.275, 841.891), 21),
    ] {
        let drawing = drawing(&folder, name);
        println!(
            "{name}: {} {} shapes, {} filled, {:?}, {:?}",
            drawing.size,
            drawing.shapes.len(),
            drawing.filled().count(),
            drawing.words,
            drawing.left_out
        );
        for (number, shape) in drawing.filled().take(5) {
            println!("  {number} {:?} {:.2}", shape.ids, area(&shape.outline));
        }
        assert!(
            (drawing.size - size).length() < 1e-3,
            "{name}: view box {}",
            drawing.size
        );
        assert_eq!(drawing.filled().count(), filled, "{name}: filled shapes");
        let drawn = drawing.drawn(&Plane::of_drawing(drawing.size)).count();
        assert!(drawn > 10_000, "{name}: {drawn} pixels are drawn");
    }
}

fn map(drawing: &Drawing, figure: &Figure) -> (Plane, Arc<Mesh>, Vec<Notice>) {
    let plane = Plane::of_drawing(drawing.size);
    let canvas = Canvas {
        plane,
        picture: None,
        drawn: None,
        shapes: &|path| drawing.fills(&plane, path),
    };
    let mut notices = Vec::new();
    let mesh = Mesh::new(&canvas, figure, &mut notices, &mut unwatched).expect("not stopped");
    (plane, Arc::new(mesh), notices)
}

#[test]
fn a_bent_finger_keeps_the_areas_of_its_bones() {
    let Some(folder) = data_folder("figures::svg::a_bent_finger_keeps_the_areas_of_its_bones")
    else {
        return;
    };
    let drawing = drawing(&folder, "hand-bones-labeled.svg");
    // The bones: filled shapes of some size that are not the paper.
    let all = drawing.size.x * drawing.size.y;
    let mut regions = Vec::new();
    for (_, shape) in drawing.filled() {
        let size = area(&shape.outline).abs();
        if let Some(id) = shape
            .id()
            .filter(|_| size > 0.0015 * all && size < 0.05 * all)
        {
            regions.push(Region {
                from: Some(Source::Path(id.to_owned())),
                rigidity: Rigidity::Rigid,
                ..Region::new(id)
            });
        }
    }
    println!("{} bones", regions.len());
    let mut figure = Figure {
        regions,
        ..Figure::default()
    };
    let (plane, mesh, notices) = map(&drawing, &figure);
    println!("{notices:?}, {} triangles", mesh.triangle_count());
    // Two bones are pinned, and one far from them is moved.
    let centre = |name: &str| {
        let of = (0..mesh.triangle_count()).filter(|t| mesh.tissue(*t).name == name);
        let middles: Vec<DVec2> = of
            .map(|t| mesh.corners(t, &mesh.vertices).iter().sum::<DVec2>() / 3.0)
            .collect();
        middles.iter().sum::<DVec2>() / middles.len() as f64
    };
    let seen: Vec<(String, DVec2)> = mesh
        .tissues
        .iter()
        .filter(|tissue| tissue.name != "rest" && tissue.pixels > 500)
        .map(|tissue| (tissue.name.clone(), centre(&tissue.name)))
        .filter(|(name, at)| {
            mesh.at_rest(*at)
                .is_some_and(|(t, _)| mesh.tissue(t).name == *name)
        })
        .collect();
    let lowest = seen
        .iter()
        .min_by(|a, b| a.1.y.total_cmp(&b.1.y))
        .expect("bones");
    let highest = seen
        .iter()
        .max_by(|a, b| a.1.y.total_cmp(&b.1.y))
        .expect("bones");
    let mut tip = Handle::pin(highest.1, dvec2(0.05, -0.06));
    tip.motion.turn = Some(-0.5);
    figure.handles = vec![Handle::pin(lowest.1, DVec2::ZERO), tip];
    let mut notices = Vec::new();
    let posed = Rig::new(&mesh, &figure, &mut notices).posed(&figure, &mut notices);
    println!("{notices:?}, {} rounds", posed.rounds);
    let start = Instant::now();
    let labels = [Label {
        text: "tip & <end>".to_owned(),
        at: highest.1,
    }];
    let text = bent(&drawing, &plane, &mesh, &figure, &posed.places, &labels);
    println!("{} bytes of SVG in {:?}", text.len(), start.elapsed());
    let again = Drawing::read(text.as_bytes()).expect("its own SVG");
    assert!(
        (again.size - drawing.size).length() < 1e-3,
        "the same view box"
    );
    let words: Vec<&str> = again.words.iter().map(|word| &*word.text).collect();
    assert_eq!(words, ["tip & <end>"], "labels are text");
    let mut moved = 0;
    for region in &figure.regions {
        let (before, after) = (drawing.taken(&region.name), again.taken(&region.name));
        assert_eq!(before.len(), after.len(), "{}", region.name);
        for (before, after) in before.iter().zip(&after) {
            let (a, b) = (area(&before.outline), area(&after.outline));
            assert!(
                (a / b - 1.0).abs() < 1e-3,
                "{}: {a} became {b}",
                region.name
            );
            let first = |outline: &Outline| outline.flattened(1.0)[0][0];
            moved += usize::from(first(&before.outline).distance(first(&after.outline)) > 1.0);
        }
    }
    println!("{moved} shapes moved");
    assert!(moved > 0, "a finger has moved");
}

#[test]
fn an_unbent_drawing_comes_out_as_it_went_in() {
    let Some(folder) = data_folder("figures::svg::an_unbent_drawing_comes_out_as_it_went_in")
    else {
        return;
    };
    let drawing = drawing(&folder, "rib-cage-anterior.svg");
    let figure = Figure::default();
    let (plane, mesh, _) = map(&drawing, &figure);
    let text = bent(&drawing, &plane, &mesh, &figure, &mesh.vertices, &[]);
    let again = Drawing::read(text.as_bytes()).expect("its own SVG");
    assert_eq!(again.shapes.len(), drawing.shapes.len(), "shapes");
    for (before, after) in drawing.shapes.iter().zip(&again.shapes) {
        let (a, b) = (area(&before.outline), area(&after.outline));
        let lines = before.outline.flattened(0.01);
        let length: f64 = lines
            .iter()
            .flat_map(|line| line.windows(2))
            .map(|ends| ends[0].distance(ends[1]))
            .sum();
        // Chords miss curves by 0.0002 of the longest side.
        assert!((a - b).abs() <= 0.0002 * 841.891 * length, "{a} {b}");
    }
}

fn svg(inner: &str) -> Vec<u8> {
    format!("<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" viewBox=\"10 20 200 100\">{inner}</svg>").into_bytes()
}

#[test]
fn paths_are_filled_by_their_own_rule_and_transform() {
    let twice = "M0 0H100V100H0ZM25 25H75V75H25Z";
    let inner = format!(
        "<g id=\"all\" transform=\"translate(10 20)\"><path id=\"ring\" fill-rule=\"evenodd\" d=\"{twice}\"/>\
         <g transform=\"translate(100 0)\"><path id=\"full\" d=\"{twice}\"/><path id=\"line\" fill=\"none\" stroke=\"red\" d=\"M0 0H9\"/></g></g>"
    );
    let drawing = Drawing::read(&svg(&inner)).expect("an SVG");
    assert_eq!(drawing.size, dvec2(200.0, 100.0), "the view box");
    let plane = Plane::of_drawing(drawing.size);
    let count = |path: &str| {
        let region = Region {
            from: Some(Source::Path(path.to_owned())),
            fill: Some(false),
            ..Region::new("region")
        };
        let canvas = Canvas {
            plane,
            picture: None,
            drawn: None,
            shapes: &|path| drawing.fills(&plane, path),
        };
        let mut notices = Vec::new();
        let map = fabrica::figure::regions::RegionMap::new(&canvas, &[region], &mut notices);
        (map.counts()[0], notices)
    };
    let pixels = 512 * 512;
    assert_eq!(count("ring"), (pixels * 3 / 4, vec![]), "even-odd");
    assert_eq!(count("full"), (pixels, vec![]), "non-zero");
    assert_eq!(
        count("all"),
        (pixels * 7 / 4, vec![]),
        "an element and all below"
    );
    assert_eq!(count("1"), (pixels, vec![]), "by number");
    for path in ["line", "2", "nothing", ""] {
        let notice = Notice::UnknownPath {
            name: "region".to_owned(),
        };
        assert_eq!(count(path), (0, vec![notice]), "{path}");
    }
    let flood = Region {
        from: Some(Source::Flood(fabrica::document::figure::Flood::new(vec![
            DVec2::ZERO,
        ]))),
        ..Region::new("flood")
    };
    let (.., notices) = map(
        &drawing,
        &Figure {
            regions: vec![flood],
            ..Figure::default()
        },
    );
    assert!(
        notices.contains(&Notice::FloodWithoutPixels {
            name: "flood".to_owned()
        }),
        "{notices:?}"
    );
}

#[test]
fn hostile_drawings_are_refused_or_read_around() {
    let timed = |name: &str, bytes: &[u8]| {
        let start = Instant::now();
        let read = Drawing::read(bytes);
        println!(
            "{name}: {:?} in {:?}",
            read.as_ref().map(|drawing| drawing.shapes.len()),
            start.elapsed()
        );
        read
    };
    let mut entities = String::from("<!DOCTYPE svg [<!ENTITY a0 \"<g/>\">");
    for i in 1..30 {
        entities.push_str(&format!(
            "<!ENTITY a{i} \"&a{0};&a{0};&a{0};&a{0};&a{0};&a{0};&a{0};&a{0};\">",
            i - 1
        ));
    }
    entities.push_str("]><svg xmlns=\"http://www.w3.org/2000/svg\">&a29;</svg>");
    assert!(
        timed("nested entities", entities.as_bytes()).is_err(),
        "nested entities"
    );
    let looped = "<!DOCTYPE svg [<!ENTITY a \"&b;\"><!ENTITY b \"&a;\">]><svg xmlns=\"http://www.w3.org/2000/svg\">&a;</svg>";
    assert_eq!(
        timed("entities in a circle", looped.as_bytes()).err(),
        Some(SvgError::Entities),
        "a circle"
    );
    let circle = "<g id=\"a\"><use xlink:href=\"#b\"/></g><g id=\"b\"><use xlink:href=\"#a\"/></g><path d=\"M0 0H9V9Z\"/>";
    assert_eq!(
        timed("use in a circle", &svg(circle)).err(),
        Some(SvgError::Uses),
        "use in a circle"
    );
    let mut powers = String::from("<path id=\"p0\" d=\"M0 0H9V9Z\"/>");
    for i in 1..25 {
        powers.push_str(&format!(
            "<g id=\"p{i}\"><use xlink:href=\"#p{0}\"/><use xlink:href=\"#p{0}\"/></g>",
            i - 1
        ));
    }
    assert!(
        timed("use of use", &svg(&powers)).is_err(),
        "two to the 24 paths"
    );
    let many = "<path d=\"M0 0H9V9Z\"/>".repeat(200_000);
    assert_eq!(
        timed("200,000 paths", &svg(&many)).err(),
        Some(SvgError::TooMany { limit: 100_000 }),
        "many"
    );
    let deep = format!("{}{}", "<g>".repeat(10_000), "</g>".repeat(10_000));
    assert_eq!(
        timed("10,000 levels", &svg(&deep)).err(),
        Some(SvgError::TooDeep { limit: 64 }),
        "deep"
    );
    let long = format!("<path id=\"p\" d=\"M0 0{}\"/>", "h1v1".repeat(20_000));
    let uses = format!("{long}{}", "<use xlink:href=\"#p\"/>".repeat(5000));
    assert_eq!(
        timed("a long path 5,000 times", &svg(&uses)).err(),
        Some(SvgError::Repeats)
    );
    let rules = format!(
        "<style>{}</style>{}",
        "path{fill:url(#a)}".repeat(100_000),
        "<path d=\"M0 0h.1v.1z\"/>".repeat(50_000)
    );
    assert_eq!(
        timed("100,000 rules for 50,000 elements", &svg(&rules)).err(),
        Some(SvgError::Styles)
    );
    let entity = format!(
        "<!DOCTYPE svg [<!ENTITY a \"{}\">]><svg xmlns=\"http://www.w3.org/2000/svg\"><path d=\"M0 0{}\"/></svg>",
        "h1v1".repeat(20_000),
        "&a;".repeat(100_000)
    );
    assert_eq!(
        timed("a long entity 100,000 times", entity.as_bytes()).err(),
        Some(SvgError::Entities)
    );
    for (name, path) in [
        ("as large as the page", "<path d=\"M0 0H200V200H0Z\"/>"),
        ("far beyond it", "<path d=\"M0 0C1e9 0 1e9 1e9 0 1e9Z\"/>"),
        (
            "wide lines",
            "<path fill=\"none\" stroke=\"red\" stroke-width=\"900\" d=\"M0 0L200 200\"/>",
        ),
    ] {
        let many = svg(&path.repeat(60_000));
        assert_eq!(
            timed(name, &many).err(),
            Some(SvgError::Intricate),
            "{name}"
        );
        assert!(timed(name, &svg(&path.repeat(20))).is_ok(), "{name}: a few");
    }
    let dashes = "<path fill=\"none\" stroke=\"red\" stroke-dasharray=\"0.001\" d=\"M0 0H200\"/>";
    assert_eq!(
        timed("dashes", &svg(&dashes.repeat(9))).err(),
        Some(SvgError::Intricate)
    );
    let outside = "<image xlink:href=\"file:///etc/passwd\" width=\"9\" height=\"9\"/><script>alert(1)</script><path d=\"M0 0H9V9Z\"/>";
    let read = timed("a file and a script", &svg(outside)).expect("the path is read");
    assert_eq!(read.shapes.len(), 1, "only the path");
    assert!(
        read.left_out.contains("image") && read.left_out.contains("script"),
        "{:?}",
        read.left_out
    );
    let bytes = svg("<path d=\"M0 0H9V9Z\"/>");
    for length in 0..bytes.len() {
        assert!(
            Drawing::read(&bytes[..length]).is_err(),
            "cut off after {length}"
        );
    }
    let wrong = b"<svg xmlns=\"http://www.w3.org/2000/svg\">\n  <g>\xff</g></svg>";
    assert_eq!(
        Drawing::read(wrong).err(),
        Some(SvgError::NoXml { line: 2, column: 6 }),
        "no UTF-8"
    );
    // The painter's numbers do not hold there: such shapes are left out, and the others are drawn.
    for far in ["1e4", "1e6", "1e8", "41e9", "1e20", "1e37"] {
        let inner = format!(
            "<circle r=\"{far}\"/><circle cx=\"{far}\" r=\"{far}\"/><rect x=\"-{far}\" y=\"3\" width=\"{far}\" height=\"9\"/>\
             <path d=\"M0 0L9 {far}L-{far} 7Z\" stroke=\"red\" stroke-width=\"{far}\"/><path fill=\"red\" d=\"M20 30H40V50H20Z\"/>"
        );
        let drawing = match timed(far, &svg(&inner)) {
            // Where 32 bits end.
            Err(SvgError::Intricate) if matches!(far, "1e20" | "1e37") => continue,
            read => read.expect("it is read"),
        };
        let picture = drawing.picture(200).expect("it is drawn");
        assert_eq!(picture.pixels[20 * 200 + 20], [255, 0, 0, 255], "{far}");
    }
    let numbers =
        "<path d=\"M1e38 1e38L-1e38 5 9e999 nan\"/><path d=\"M0 0C1e30 1e30 -1e30 1e30 5 5Z\"/>";
    if let Ok(drawing) = timed("huge numbers", &svg(numbers)) {
        let plane = Plane::of_drawing(drawing.size);
        for (number, _) in drawing.filled() {
            drawing.fills(&plane, &number.to_string());
        }
    }
}
