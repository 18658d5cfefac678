//! Meshes in the page: their programs are fetched when one comes, and textures are those of the native program.

use super::*;
use crate::parts::count;
use crate::picture_files::{jpeg, plate, rgb_png};
use sha2::{Digest as _, Sha256};

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
        hand::click(&tab, "The subject").await;
        tab.drawn("obj_with_picture", is_green).await;
        tab.assert_no_complaints().await;
    });
}
