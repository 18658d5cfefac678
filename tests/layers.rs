//! Rooms import only rooms below them. The list is that of src/lib.rs.

use std::path::{Path, PathBuf};

/// Rooms with their layers.
const ROOMS: [(&str, u32); 10] = [
    ("math", 0),
    ("document", 1),
    ("link", 2),
    ("data", 2),
    ("load", 3),
    ("subjects", 3),
    ("displace", 3),
    ("render", 4),
    ("app", 5),
    ("shell", 6),
];

fn layer(room: &str) -> Option<u32> {
    ROOMS.iter().find(|(name, _)| *name == room).map(|r| r.1)
}

/// Rooms that a source text names after `crate::`, in `use` lines (also grouped ones) and in paths; comments do not count.
fn rooms_named(source: &str) -> Vec<String> {
    let code: String = source
        .lines()
        .map(|line| line.split("//").next().unwrap_or_default())
        .collect::<Vec<_>>()
        .join("\n");
    let mut rooms = Vec::new();
    for rest in code.split("crate::").skip(1) {
        if let Some(group) = rest.strip_prefix('{') {
            // `use crate::{a::B, c}`: the names at the first level of braces.
            let (mut depth, mut word, mut is_start) = (1, String::new(), true);
            for c in group.chars() {
                match c {
                    '{' => depth += 1,
                    '}' => depth -= 1,
                    _ => {}
                }
                if c.is_alphanumeric() || c == '_' {
                    if is_start && depth == 1 {
                        word.push(c);
                    }
                } else {
                    if !word.is_empty() {
                        rooms.push(std::mem::take(&mut word));
                    }
                    is_start = c == ',' || (is_start && c.is_whitespace());
                }
                if depth == 0 {
                    break;
                }
            }
        } else {
            rooms.push(
                rest.chars()
                    .take_while(|c| c.is_alphanumeric() || *c == '_')
                    .collect(),
            );
        }
    }
    rooms
}

/// What is wrong with the imports of a file in `room`.
fn faults(room: &str, source: &str) -> Vec<String> {
    let own = layer(room).unwrap_or(u32::MAX);
    rooms_named(source)
        .into_iter()
        .filter(|named| named != room)
        .filter_map(|named| {
            let other = layer(&named)?;
            (other >= own).then(|| format!("{room} (layer {own}) imports {named} (layer {other})"))
        })
        .collect()
}

fn files_under(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder)
        .expect("a folder of the sources")
        .flatten()
    {
        let path = entry.path();
        if path.is_dir() {
            files_under(&path, found);
        } else if path.extension().is_some_and(|e| e == "rs") {
            found.push(path);
        }
    }
}

#[test]
fn imports_point_down() {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut seen = 0;
    let mut all = Vec::new();
    for (room, _) in ROOMS {
        let mut files = Vec::new();
        files_under(&src.join(room), &mut files);
        for file in files {
            let source = std::fs::read_to_string(&file).expect("a source file");
            seen += rooms_named(&source).len();
            let name = file
                .strip_prefix(&src)
                .unwrap_or(&file)
                .display()
                .to_string();
            all.extend(
                faults(room, &source)
                    .into_iter()
                    .map(|f| format!("{name}: {f}")),
            );
        }
    }
    assert!(
        seen > 50,
        "only {seen} imports were seen: the test reads nothing"
    );
    assert!(all.is_empty(), "{}", all.join("\n"));
}

#[test]
fn every_folder_is_a_room() {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    for entry in std::fs::read_dir(src).expect("the sources").flatten() {
        let name = entry.file_name().to_string_lossy().into_owned();
        let is_known = name == "bin" || layer(&name).is_some();
        assert!(
            !entry.path().is_dir() || is_known,
            "src/{name} is not in the table of rooms"
        );
    }
}

/// The negative control: what must be caught is caught.
#[test]
fn upward_imports_are_caught() {
    assert_eq!(
        faults("math", "use crate::document::Document;").len(),
        1,
        "upwards"
    );
    assert_eq!(
        faults("link", "use crate::data::Volume;").len(),
        1,
        "sideways"
    );
    assert_eq!(
        faults("load", "use crate::{data::Volume, app::{App, X}, math};").len(),
        1,
        "in a group"
    );
    assert_eq!(
        faults("render", "fn f() { crate::shell::cli::run(); }").len(),
        1,
        "in a path"
    );
    assert!(
        faults("render", "use crate::{data::Volume, math::{app, shell}};").is_empty(),
        "downwards"
    );
    assert!(
        faults("app", "use crate::app::X; // crate::shell").is_empty(),
        "own room, comment"
    );
}

/// Everything GPU and interface stays behind its features: the crates of layers up to 3 come without.
#[test]
fn bare_build_needs_no_gpu_and_no_interface() {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let output = std::process::Command::new(cargo)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .args([
            "tree",
            "--offline",
            "--no-default-features",
            "--edges",
            "normal",
            "--prefix",
            "none",
        ])
        .output()
        .expect("cargo runs");
    let tree = String::from_utf8_lossy(&output.stdout);
    assert!(
        tree.contains("glam"),
        "cargo tree: {}",
        String::from_utf8_lossy(&output.stderr)
    );
    for forbidden in ["wgpu", "egui", "eframe", "winit", "clap", "rfd", "naga"] {
        let found = tree
            .lines()
            .any(|line| line.split(' ').next() == Some(forbidden));
        assert!(!found, "a build without features holds {forbidden}");
    }
}
