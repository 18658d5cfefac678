//! How much memory the worst files and documents of figures take, each in a process of its own (issue 18, "Bad input";
//! spec/figures.md, "Errors and notices").

use std::cell::RefCell;
use std::path::Path;

use super::common::Noise;
use crate::memory::{Measured, measure, report};
use crate::picture_files::{jpeg, png, rgb_png};
use fabrica::document::Document;
use fabrica::figure::{Bender, read_plate, unwatched};
use serde_json::{Value, json};

/// Set for the process that is measured: a picture. Its document lies beside it.
const FIGURE: &str = "FABRICA_MEASURED_FIGURE";
/// Nothing takes more.
const MOST_BYTES: u64 = 1 << 30;
const DOCUMENT: &str = "document.json";

/// Not a test of its own: what the measured process does.
#[test]
fn measured() {
    let Some(path) = std::env::var_os(FIGURE) else {
        return;
    };
    let document = std::fs::read_to_string(Path::new(&path).with_file_name(DOCUMENT));
    let document = Document::from_json(&document.expect("it was written")).expect("a document");
    let figure = document.illustration().figure.clone().unwrap_or_default();
    report(|| {
        let bytes = std::fs::read(&path).expect("it was written before");
        let Ok(read) = read_plate(&bytes) else {
            return 0;
        };
        let mut bender = Bender::new(&read.plate).expect("it was read before");
        let bent = bender
            .bent(&figure, &mut unwatched)
            .expect("nobody stops it");
        bent.sheet.mesh.triangles.len() as u64
    });
}

/// Triangles of the figure that a file and a document make, none where the file is refused; never too much memory.
fn triangles(name: &str, file: &[u8], figure: &Value) -> u64 {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join(name);
    std::fs::write(&path, file).expect("room");
    let document = json!({ "fabrica": 1, "subject": { "src": name }, "figure": figure });
    std::fs::write(path.with_file_name(DOCUMENT), document.to_string()).expect("room");
    let measured: Measured = measure("figures::memory::measured", FIGURE, path.as_os_str());
    println!(
        "{name}: {} bytes, {} triangles, peak {:.0} MiB, {:.1} s",
        file.len(),
        measured.result,
        measured.mebibytes(),
        measured.seconds
    );
    assert!(
        measured.peak < MOST_BYTES,
        "{name}: {} bytes",
        measured.peak
    );
    measured.result
}

/// A PNG whose header has another size than its pixels.
fn lying_png(size: [u32; 2], rows: &[u8]) -> Vec<u8> {
    png(size, [8, 2, 0], &[], rows)
}

#[test]
fn files_that_promise_or_unpack_too_much_take_little() {
    let bare = json!({});
    let refused = |name: &str, file: &[u8]| assert_eq!(triangles(name, file, &bare), 0, "{name}");
    refused("promising.png", &lying_png([65_535, 65_535], &[0; 400]));
    refused("short.png", &lying_png([6300, 6300], &[0; 400]));
    let deep = png([6300, 6300], [16, 6, 0], &[], &[0; 400]);
    refused("deep.png", &deep);
    // 300 MB of zeros where 768 bytes belong.
    triangles("bomb.png", &lying_png([16, 16], &vec![0; 300 << 20]), &bare);
    let chunks: (&[u8; 4], &[u8]) = (b"iCCP", &[b'a'; 60_000]);
    triangles(
        "profile.png",
        &png([1, 1], [8, 0, 0], &[chunks], &[0, 9]),
        &bare,
    );
    for (name, frame) in [("baseline.jpg", 0xc0), ("progressive.jpg", 0xc2)] {
        let mut file = jpeg([8, 8], &[1, 2, 3], (frame, 8), &[], |_, _, _| 9);
        let frame = (file.windows(2)).position(|pair| pair == [0xff, frame]);
        let size = frame.expect("a frame") + 5;
        file[size..size + 4].copy_from_slice(&[0x18, 0x9c, 0x18, 0x9c]);
        triangles(name, &file, &bare);
    }
    let mut scans = jpeg([2048, 2048], &[1, 2, 3], (0xc2, 8), &[], |_, _, _| 9);
    let scan = (scans.windows(2)).rposition(|pair| pair == [0xff, 0xda]);
    let scan = scans[scan.expect("a scan")..scans.len() - 2].to_vec();
    scans.truncate(scans.len() - 2);
    (0..1000).for_each(|_| scans.extend(&scan[..scan.len().min(60_000)]));
    triangles("scans.jpg", &scans, &bare);
}

#[test]
fn pictures_and_drawings_at_their_limits_are_drawn() {
    let bare = json!({ "detail": 60_000 });
    let noise = |size: [u32; 2]| {
        let noise = RefCell::new(Noise(7));
        let byte = || (noise.borrow_mut().next() * 256.0) as u8;
        rgb_png(size, |_, _| [byte(), byte(), byte()])
    };
    let plain = |x: u32, y: u32| [(x / 40) as u8, (y / 40) as u8, 90];
    let largest = rgb_png([6300, 6300], plain);
    assert!(
        triangles("largest.png", &largest, &bare) > 0,
        "40 million pixels"
    );
    // A row begins with its filter: none.
    let row = [vec![0], vec![0x40; 8 * 6300]].concat();
    let deepest = png([6300, 6300], [16, 6, 0], &[], &row.repeat(6300));
    assert!(triangles("deepest.png", &deepest, &bare) > 0, "16 bits");
    let path = "<path stroke=\"red\" stroke-width=\"3\" stroke-dasharray=\"1 2\" d=\"M0 0C90 0 90 90 0 99Z\"/>";
    let drawing = |inner: &str| {
        format!("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 100 100\">{inner}</svg>")
    };
    triangles(
        "strokes.svg",
        drawing(&path.repeat(60_000)).as_bytes(),
        &bare,
    );
    let small = "<path stroke=\"red\" stroke-width=\".1\" stroke-dasharray=\".5 2\" d=\"M50 50c2 0 2 2 0 2z\"/>";
    let most = drawing(&small.repeat(90_000));
    assert!(
        triangles("most.svg", most.as_bytes(), &bare) > 0,
        "90,000 shapes"
    );
    let long = drawing(&format!(
        "<path stroke=\"red\" d=\"M0 0{}\"/>",
        "h1v1h-1v-1".repeat(800_000)
    ));
    triangles("long.svg", long.as_bytes(), &bare);
    // Noise, everything that is alike wherever it lies, in rigid parts, held by as many handles as there may be.
    let regions: Vec<Value> = (0..32)
        .map(|i| {
            let at = f64::from(i) / 80.0 - 0.2;
            json!({ "name": format!("noise {i}"), "least": 0, "fill": false, "rigidity": "rigid",
                "from": { "flood": { "at": [[at, 0.1]], "tolerance": 80, "connected": false } } })
        })
        .collect();
    let handles: Vec<Value> = (0..64)
        .map(|i| json!({ "at": [f64::from(i) / 70.0 - 0.45, 0.1], "move": [0.01, 0.0] }))
        .collect();
    let figure = json!({ "regions": regions, "handles": handles, "detail": 60_000, "propagation": "gaussian" });
    for (side, count) in [(1024, 32), (4096, 6)] {
        let mut figure = figure.clone();
        let regions = figure["regions"].as_array_mut().expect("a list");
        regions.truncate(count);
        let found = triangles(&format!("noise{side}.png"), &noise([side; 2]), &figure);
        assert!(found > 0, "{side}: it is drawn");
    }
}
