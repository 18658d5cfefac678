//! Meshes in the page: their programs are fetched when one comes, and textures are those of the native program.

use super::hand::{
    CTRL, changed, click, clipboard, document, find, focus, hear, kept, listed, mark, press,
    press_with, without_messages, write,
};
use super::harness::Tab;
use super::*;
use crate::parts::count;
use crate::picture_files::{jpeg, plate, rgb_png};
use serde_json::Value;
use sha2::{Digest as _, Sha256};
use std::collections::HashMap;
use std::time::Instant;

/// All panels beside a picture that a software GPU soon completes, CSS pixels.
const TALL: (u32, u32) = (800, 760);

/// The question what a dropped mesh is to be.
const QUESTION: &str = "window.fabrica.viewer.controls().includes('What is this mesh?')";

/// The page's decoders give the pixels of the native ones: a photograph, a plate, and small files of other kinds.
#[test]
fn pictures_have_the_same_pixels_in_the_page() {
    let mut files = vec![
        (
            "a.png",
            rgb_png([19, 7], |x, y| [x as u8 * 9, y as u8 * 30, 200]),
        ),
        (
            "b.jpg",
            jpeg([40, 24], &[1, 2, 3], (0xc0, 8), &[], |c, x, y| {
                (60 * c as u16 + 20 * x + 9 * y) as u8
            }),
        ),
    ];
    if let Some(data) = data_folder("pictures_have_the_same_pixels_in_the_page") {
        for name in ["gray_Skull.jpg", "vertebral-column-colored.png"] {
            let bytes = std::fs::read(data.join("image2d").join(name)).expect("a picture");
            files.push((name, bytes));
        }
    }
    with_browser(BrowserGpu::Software, |session| async move {
        let tab = session.open("worker.js").await;
        for (name, bytes) in files {
            session.server.add(name, bytes.clone());
            let own = fabrica::pictures::decode(&bytes).expect("a picture");
            let own = fabrica::math::hex(&Sha256::digest(own.pixels.as_flattened()));
            let found: String = tab
                .eval(&format!(
                    "(async () => {{
                        const part = await import('/fabrica_pictures.js');
                        await part.default({{ module_or_path: '/fabrica_pictures_bg.wasm' }});
                        const packed = new Uint8Array(await (await fetch('/{name}')).arrayBuffer());
                        const hash = await crypto.subtle.digest('SHA-256', part.decode(packed)[3]);
                        return [...new Uint8Array(hash)].map((b) => b.toString(16).padStart(2, '0')).join('');
                    }})()"
                ))
                .await;
            assert_eq!(found, own, "{name}");
        }
    });
}

/// A mesh with a texture fetches the part for meshes and the decoders, each once, and no reader of scans; a file that
/// is called like a scan and is a mesh is read all the same.
#[test]
fn a_mesh_fetches_the_programs_that_it_needs() {
    let picture = rgb_png(
        [8, 8],
        |x, _| if x < 4 { [250, 20, 20] } else { [20, 20, 250] },
    );
    let glb = plate(&picture, "image/png", 1.0, &[]);
    let is_painted = |page: &image::RgbaImage| {
        let count = |red: usize, blue: usize| {
            let is_so = |p: &&image::Rgba<u8>| p.0[red] > 60 && p.0[red] / 2 > p.0[blue];
            object_part(page).pixels().filter(is_so).count()
        };
        count(0, 2) > 500 && count(2, 0) > 500
    };
    with_browser(BrowserGpu::Software, |session| async move {
        session.server.add("plate.glb", glb.clone());
        session.server.add("plate.nrrd", glb);
        let link = |name: &str| {
            let document = format!(r#"{{"fabrica":1,"subject":{{"src":"{name}"}}}}"#);
            format!("#{}", payload(&document))
        };
        let server = &session.server;
        let tab = session.coarse_viewer(&link("plate.glb"), PAGE).await;
        tab.drawn("plate", is_painted).await;
        for (part, expected) in [
            ("meshes", 1),
            ("pictures", 1),
            ("scans", 0),
            ("subjects", 0),
        ] {
            let name = format!("fabrica_{part}_bg.wasm");
            assert_eq!(count(server, &name), expected, "{name}");
        }
        tab.assert_no_complaints().await;
        let tab = session.coarse_viewer(&link("plate.nrrd"), PAGE).await;
        tab.drawn("plate_by_content", is_painted).await;
        assert_eq!(count(server, "fabrica_scans_bg.wasm"), 1);
        tab.assert_no_complaints().await;
    });
}

/// An OBJ that is dropped with its material library and picture is drawn with the picture, wherever they stand in the
/// list.
#[test]
fn an_obj_is_dropped_with_its_picture() {
    let obj = "mtllib C:\\Jane\\a.mtl\nusemtl a\nv 0 0 0\nv 10 0 0\nv 10 10 0\nv 0 10 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n";
    let is_green = |page: &image::RgbaImage| {
        let green = |p: &&image::Rgba<u8>| p.0[1] > 60 && p.0[1] / 2 > p.0[0].max(p.0[2]);
        object_part(page).pixels().filter(green).count() > 1000
    };
    with_browser(BrowserGpu::Software, |session| async move {
        session.server.add("a.obj", obj.as_bytes().to_vec());
        session
            .server
            .add("a.mtl", b"newmtl a\nmap_Kd x/a.jpg\n".to_vec());
        let value = |component: usize, _: u16, _: u16| [128, 44, 21][component];
        session
            .server
            .add("a.jpg", jpeg([8, 8], &[1, 2, 3], (0xc0, 8), &[], value));
        let head = format!(
            "#{}",
            payload(r#"{"fabrica":1,"subject":{"builtin":"cube"}}"#)
        );
        let tab = session.coarse_viewer(&head, PAGE).await;
        tab.settled().await;
        drop_files(&tab, &["a.jpg", "a.mtl", "a.obj"]).await;
        click(&tab, "The subject").await;
        tab.drawn("obj_with_picture", is_green).await;
        tab.assert_no_complaints().await;
    });
}

/// A box as a binary STL: its middle and half of its sides, mm.
fn box_stl(middle: [f32; 3], half: [f32; 3]) -> Vec<u8> {
    let mesh = surfaces::brick_mesh(glam::Vec3::from(half));
    let mut stl = vec![0; 80];
    stl.extend((mesh.triangles.len() as u32).to_le_bytes());
    for triangle in mesh.triangles {
        stl.extend([0; 12]);
        for corner in triangle {
            let place = mesh.positions[corner as usize] + glam::Vec3::from(middle);
            stl.extend(
                place
                    .to_array()
                    .iter()
                    .flat_map(|number| number.to_le_bytes()),
            );
        }
        stl.extend([0; 2]);
    }
    stl
}

/// The picture between the panels, with nothing selected, and without messages over it.
async fn object(tab: &Tab, name: &str) -> image::RgbaImage {
    press(tab, "Escape").await;
    tab.settled().await;
    without_messages(tab).await;
    object_part(&tab.picture(name).await)
}

/// Asserts that two pictures differ where something small is seen in one of them only.
fn assert_apart(a: &image::RgbaImage, b: &image::RgbaImage, what: &str) {
    let pairs = a.pixels().zip(b.pixels());
    let is_apart = |(a, b): &(&image::Rgba<u8>, &image::Rgba<u8>)| {
        a.0.iter().zip(b.0).any(|(a, b)| a.abs_diff(b) > 12)
    };
    let count = pairs.filter(is_apart).count();
    println!("{what}: {count} pixels differ");
    assert!(count > 300, "{what}: {count} pixels differ");
}

/// A dropped STL asks what it is to be, becomes an object, is dragged by its handle, cuts, is undone and done again;
/// and who has the link and the file sees the same.
#[test]
fn a_dropped_stl_becomes_a_tool_that_cuts() {
    with_browser(BrowserGpu::Software, |session| async move {
        session.allow_clipboard().await;
        // In the front of the cube, which is 100 mm wide.
        let stl = box_stl([10.0, 48.0, 10.0], [14.0, 12.0, 14.0]);
        session.server.add("knife.stl", stl);
        let json =
            r#"{"fabrica":1,"subject":{"builtin":"cube"},"camera":{"rotate":[0.2,0,0.1,0.97]}}"#;
        let tab = session
            .half_viewer(&format!("#{}", payload(json)), TALL)
            .await;
        focus(&tab).await;
        tab.settled().await;
        drop_files(&tab, &["knife.stl"]).await;
        mark(&tab, "objects").await;
        click(&tab, "An object").await;
        let objects = changed(&tab, "objects").await;
        assert!(objects[0]["sha256"].is_string(), "{objects}");
        assert!(
            objects[0]["at"].is_null(),
            "it lies where its file says: {objects}"
        );

        tab.settled().await;
        mark(&tab, "objects").await;
        let (x, y) = find(&tab, "Move freely").await.middle();
        tab.drag((x, y), (x - 30.0, y + 15.0), 4).await;
        let dragged = changed(&tab, "objects").await;
        assert!(dragged[0]["at"].is_array(), "{dragged}");
        // So that the wound is seen.
        mark(&tab, "objects").await;
        let (x, y) = find(&tab, "Opacity slider").await.corner(0.3, 0.5);
        tab.click(x, y).await;
        changed(&tab, "objects").await;
        focus(&tab).await;
        let whole = object(&tab, "knife_dragged").await;

        mark(&tab, "templates").await;
        press(&tab, "/").await;
        write(&tab, "carve").await;
        press(&tab, "Enter").await;
        let templates = changed(&tab, "templates").await;
        assert_eq!(templates[0]["kind"], "carve", "{templates}");
        let named = &document(&tab).await["objects"][0]["name"];
        assert_eq!(&templates[0]["params"]["object"], named);
        let cut = object(&tab, "knife_cuts").await;
        assert_apart(&whole, &cut, "the wound");

        press_with(&tab, CTRL, "z", None).await;
        tab.wait_until(
            "JSON.parse(window.fabrica.viewer.get_document()).templates === undefined",
            30,
        )
        .await;
        let undone = object(&tab, "knife_undone").await;
        assert!(
            undone == whole,
            "as it was: {:?}",
            difference(&undone, &whole, WHITE)
        );
        mark(&tab, "templates").await;
        press_with(&tab, CTRL, "y", None).await;
        changed(&tab, "templates").await;
        kept(&tab).await;

        click(&tab, "Copy link").await;
        let link = clipboard(&tab, &session.server.address()).await;
        let other = session.half_viewer_at(&link, TALL).await;
        focus(&other).await;
        other.settled().await;
        // It says which file it waits for.
        click(&other, "Dismiss").await;
        let without = object(&other, "knife_missing").await;
        assert_apart(&without, &cut, "without the file");
        drop_files(&other, &["knife.stl"]).await;
        let seen = object(&other, "knife_linked").await;
        assert!(
            seen == cut,
            "the same: {:?}",
            difference(&seen, &cut, WHITE)
        );
        assert_eq!(document(&other).await, document(&tab).await);
        other.assert_no_complaints().await;
        tab.assert_no_complaints().await;
    });
}

/// The triangles of an OBJ, each parted in 16, as a binary PLY.
fn parted(obj: &str) -> (Vec<u8>, usize) {
    let rows = |kind: &'static str| obj.lines().filter_map(move |line| line.strip_prefix(kind));
    let numbers = |row: &str| -> [f32; 3] {
        let mut numbers = row.split_whitespace().map(|n| n.parse().expect("a number"));
        std::array::from_fn(|_| numbers.next().expect("three of them"))
    };
    let mut places: Vec<glam::Vec3> = rows("v ").map(|row| numbers(row).into()).collect();
    let corner = |text: &str| {
        let index = text.split('/').next().and_then(|n| n.parse::<usize>().ok());
        index.expect("an index") - 1
    };
    let mut triangles: Vec<[usize; 3]> = rows("f ")
        .map(|row| {
            let corners: Vec<usize> = row.split_whitespace().map(corner).collect();
            corners.try_into().expect("a triangle")
        })
        .collect();
    for _ in 0..2 {
        let mut known = HashMap::new();
        let mut middle = |a: usize, b: usize| {
            *known.entry([a.min(b), a.max(b)]).or_insert_with(|| {
                places.push(places[a].midpoint(places[b]));
                places.len() - 1
            })
        };
        let mut parts = Vec::with_capacity(4 * triangles.len());
        for [a, b, c] in triangles {
            let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
            parts.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
        }
        triangles = parts;
    }
    let mut ply = format!(
        "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
        places.len(),
        triangles.len()
    )
    .into_bytes();
    for place in &places {
        ply.extend(
            place
                .to_array()
                .iter()
                .flat_map(|number| number.to_le_bytes()),
        );
    }
    for triangle in &triangles {
        ply.push(3);
        ply.extend(
            triangle
                .iter()
                .flat_map(|&index| (index as u32).to_le_bytes()),
        );
    }
    (ply, triangles.len())
}

/// Keeps from when and how long the page's own thread was held, milliseconds, where that is 50 or more.
const HOLDS: &str = "(() => {
  [window.held, window.since] = [[], performance.now()];
  const observer = new PerformanceObserver((list) => window.held.push(...list.getEntries().map((entry) => [Math.round(entry.startTime - window.since), entry.duration])));
  observer.observe({ type: 'longtask' });
  return true;
})()";

/// A mesh of 466,720 triangles loads with progress, can be stopped, and holds no frame while it is read and prepared;
/// one of more than may be is refused with its count.
#[test]
fn a_large_mesh_holds_no_frame() {
    let Some(data) = data_folder("a_large_mesh_holds_no_frame") else {
        return;
    };
    let obj = std::fs::read_to_string(data.join("mesh/armadillo.obj")).expect("the armadillo");
    let (ply, count) = parted(&obj);
    assert_eq!(count, 466_720, "each in 16");
    // A strip of three corners, again and again.
    let mut strip = b"ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement tristrips 1\nproperty list int uchar vertex_indices\nend_header\n".to_vec();
    for number in [0.0_f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0] {
        strip.extend(number.to_le_bytes());
    }
    strip.extend(2_000_003_u32.to_le_bytes());
    strip.extend((0..2_000_003).map(|i| (i % 3) as u8));
    with_browser(BrowserGpu::Software, |session| async move {
        session.server.add("large.ply", ply);
        session.server.add("strip.ply", strip);
        let tab = session
            .coarse_viewer(&format!("#{}", payload(PLAIN)), (420, 420))
            .await;
        focus(&tab).await;
        tab.settled().await;
        drop_files(&tab, &["strip.ply"]).await;
        hear(&tab, "2000001 triangles so far").await;
        click(&tab, "Dismiss").await;

        assert!(tab.eval::<bool>(HOLDS).await);
        let start = Instant::now();
        let progress = "window.fabrica.viewer.controls().match(/Reading (\\d+) %/)?.[1] ?? 0";
        for goal in [3, 100] {
            drop_files(&tab, &["large.ply"]).await;
            listed(&tab).await;
            if goal < 100 {
                tab.wait_until(&format!("({progress}) >= {goal}"), 60).await;
                click(&tab, "Cancel loading").await;
                tab.wait_until(&format!("({progress}) === 0"), 10).await;
                println!("stopped after {:?}", start.elapsed());
            }
        }
        tab.wait_until(QUESTION, 240).await;
        println!("ready after {:?}", start.elapsed());
        let held: Vec<[f64; 2]> = tab.eval("window.held").await;
        // Two cores share the worker, the page and a software GPU: a hold of a frame or two may be theirs. What is read
        // on the page's own thread holds it for most of the time.
        let whole = 1000.0 * start.elapsed().as_secs_f64();
        let longest = held.iter().map(|[_, time]| *time).fold(0.0, f64::max);
        assert!(
            longest < whole / 50.0,
            "held while it is read and prepared (from, for): {held:?} of {whole:.0} ms"
        );
        click(&tab, "The subject").await;
        tab.settled().await;
        println!("drawn after {:?}", start.elapsed());
        // On its way to the GPU it still holds frames, one of them for three quarters of a second (issue 15).
        let held: Vec<[f64; 2]> = tab.eval("window.held").await;
        println!("held on the way to the GPU (from, for): {held:?} ms");
        let is_drawn = |page: &image::RgbaImage| drawn_pixels(page) > 3000;
        tab.drawn("large_mesh", is_drawn).await;
        let subject: Value = document(&tab).await["subject"].clone();
        assert!(subject["sha256"].is_string(), "{subject}");
        tab.assert_no_complaints().await;
    });
}
