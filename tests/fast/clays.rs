//! Clays that begin with mesh files: real ones are made and take a stroke, broken ones are refused in words.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;

use crate::data::data_folder;
use crate::scans::Folder;
use fabrica::clay::{Check, Shaped};
use fabrica::document::{Clay, Document, SubjectRef};
use fabrica::load::{LoadError, LoadReport};
use fabrica::shell::clays::ClayDesk;
use serde_json::json;

/// The files of a folder, in order.
fn files(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).expect("the folder");
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.expect("a file").path()).collect();
    files.sort();
    assert!(files.len() > 20, "{files:?}");
    files
}

/// A clay of a file that a ball goes into from a place.
fn clay(name: &str, at: Option<[i32; 3]>) -> Arc<Clay> {
    let strokes = at.map(|[x, y, z]| json!({ "path": [x, y, z, 70, 40, 30] }));
    let strokes: Vec<_> = strokes.into_iter().collect();
    let document = json!({ "fabrica": 1, "subject": { "clay": { "from": { "src": name },
        "detail": 0.03, "tools": [{ "radius": 0.06, "coat": 0.08 }], "strokes": strokes } } });
    let document = Document::from_json(&document.to_string()).expect("a document");
    match &document.illustration().subject {
        SubjectRef::Clay(clay) => Arc::clone(clay),
        other => panic!("{other:?}"),
    }
}

/// The clay of a file before and after a stroke at its first vertex, and what there is to say.
fn struck(path: &Path) -> Result<(Shaped, Shaped, Vec<String>), LoadError> {
    let name = path.file_name().expect("a name").to_string_lossy();
    let mut folder = Folder::new(path.parent().expect("a folder"));
    let (mut desk, mut report) = (ClayDesk::default(), LoadReport::default());
    let untouched = clay(&name, None);
    desk.begin(&untouched, (&mut folder, &name), &mut report, &mut |_| true)?;
    let start = desk.shape(&untouched, &mut |_| true).expect("a start");
    let mut said = report.notices();
    said.extend(start.notices());
    let start = start.shaped();
    let first = start.positions[0] * 1000.0;
    let struck = clay(&name, Some(first.to_array().map(|x| x as i32)));
    let after = desk.shape(&struck, &mut |_| true).expect("a stroke");
    assert!(after.left_out().is_empty(), "{name}");
    Ok((start, after.shaped(), said))
}

fn check(shaped: &Shaped) -> Check {
    Check::of(&shaped.positions, &shaped.triangles, None)
}

#[test]
fn real_meshes_become_clays() {
    let Some(folder) = data_folder("real_meshes_become_clays") else {
        return;
    };
    for file in files(&folder.join("mesh")) {
        let began = Instant::now();
        let name = file.display();
        let (start, after, said) = struck(&file).unwrap_or_else(|error| panic!("{error}"));
        let (before, now) = (check(&start), check(&after));
        println!(
            "{name}: {} triangles, {} pieces, Euler number {}, {} border edges, {} meet; {:.1} s; {said:?}",
            before.triangles,
            before.pieces,
            before.euler,
            before.border_edges,
            before.crossing,
            began.elapsed().as_secs_f64()
        );
        for check in [&before, &now] {
            assert!(check.is_two_manifold(), "{name}: {}", check.lines());
        }
        assert_eq!(
            (before.pieces, before.euler, before.border_edges == 0),
            (now.pieces, now.euler, now.border_edges == 0),
            "{name}"
        );
        assert!(after.touched.contains(&true), "{name}");
        let is_open = said.iter().any(|line| line.contains("is open"));
        assert_eq!(is_open, before.border_edges > 0, "{name}: {said:?}");
        if let Some(volume) = before.volume {
            assert!(volume > 0.0, "{name}: {volume}");
        }
        // One unit is the longest side, and the origin is the middle.
        let places = || start.positions.iter().copied();
        let [least, most] = [
            places().reduce(|a, b| a.min(b)),
            places().reduce(|a, b| a.max(b)),
        ];
        let [least, most] = [least, most].map(|place| place.expect("a vertex"));
        assert!(((most - least).max_element() - 1.0).abs() < 1e-5, "{name}");
        assert!((most + least).abs().max_element() < 1e-5, "{name}");
    }
}

#[test]
fn broken_meshes_become_clays_or_are_refused_in_words() {
    let Some(folder) = data_folder("broken_meshes_become_clays_or_are_refused_in_words") else {
        return;
    };
    let (mut made, mut refused) = (0, 0);
    for file in files(&folder.join("malformed/mesh")) {
        let name = file.display();
        match struck(&file) {
            Ok((start, after, said)) => {
                println!("{name}: {} triangles; {said:?}", start.triangles.len());
                assert!(check(&start).is_two_manifold(), "{name}");
                assert!(check(&after).is_two_manifold(), "{name}");
                made += 1;
            }
            Err(error) => {
                let (said, called) = (error.to_string(), file.file_name().expect("a name"));
                println!("{name}: {said}");
                assert!(said.contains(&*called.to_string_lossy()), "{name}: {said}");
                assert_eq!(said.lines().count(), 1, "{name}: {said}");
                refused += 1;
            }
        }
    }
    assert!(
        made >= 10 && refused >= 10,
        "{made} made, {refused} refused"
    );
}
