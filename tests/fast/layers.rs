//! The house holds: imports point down between rooms and within them, no two files import each other in a circle, and
//! what must know no window, GPU or file names none. The tables are those of src/bin/xtask/house.rs.

use std::path::Path;

use crate::house::{self, ROOMS};
use crate::imports::{self, Graph, Source};

fn crate_sources() -> Vec<Source> {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    house::sources(&src).expect("the sources")
}

fn crate_graph() -> Graph {
    let graph = imports::read(&crate_sources());
    let n = graph.imports.len();
    assert!(n > 500, "only {n} imports are seen: the test reads nothing");
    graph
}

/// The graph of a few planted files.
fn planted(files: &[(&str, &str)]) -> (Vec<Source>, Graph) {
    let source = |(path, text): &(&str, &str)| Source {
        path: (*path).to_owned(),
        text: (*text).to_owned(),
    };
    let sources: Vec<Source> = files.iter().map(source).collect();
    let graph = imports::read(&sources);
    (sources, graph)
}

// ---------------------------------------------------------------------------------------------------- the crate

#[test]
fn imports_point_down_between_rooms() {
    let faults = house::upward(&crate_graph());
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn imports_point_down_within_rooms() {
    let faults = house::out_of_order(&crate_graph(), &crate_sources(), &house::ORDER);
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn no_two_files_import_each_other_in_a_circle() {
    let faults = house::in_circles(&crate_graph());
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn parts_without_window_gpu_or_files_name_none() {
    let faults = house::forbidden(&crate_graph());
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn every_folder_is_a_room_and_every_file_is_reached() {
    let sources = crate_sources();
    for source in &sources {
        let room = house::room_of(&source.path);
        let is_known = room.is_none_or(|room| ROOMS.iter().any(|(name, _)| *name == room));
        assert!(is_known, "src/{} is in no room of the table", source.path);
    }
    let unreached = house::unreached(&imports::read(&sources));
    assert!(
        unreached.is_empty(),
        "{}",
        unreached.join(
            "
"
        )
    );
}

#[test]
fn the_page_of_the_docs_is_up_to_date() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/imports.md");
    let written = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(
        written == house::page(&crate_graph()),
        "src/imports.md is out of date: run `cargo xtask imports`"
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

// ---------------------------------------------------------------------------------------------------- planted faults

#[test]
fn upward_imports_are_caught() {
    let rooms =
        "mod math; mod document; mod data; mod link; mod load; mod render; mod app; mod shell;";
    let faults_of = |path: &str, text: &str| {
        let mut files = vec![("lib.rs", rooms)];
        for room in [
            "math", "document", "data", "link", "load", "render", "app", "shell",
        ] {
            let file: &str = Box::leak(format!("{room}/mod.rs").into_boxed_str());
            files.push((
                file,
                if file == path {
                    text
                } else {
                    "pub struct X; pub mod y { pub struct Z; }"
                },
            ));
        }
        house::upward(&planted(&files).1).len()
    };
    for (path, text, expected, what) in [
        ("math/mod.rs", "use crate::document::X;", 1, "upwards"),
        ("link/mod.rs", "use crate::data::X;", 1, "sideways"),
        (
            "load/mod.rs",
            "use crate::{data::X, app::{X as A, y}, math};",
            1,
            "in a group",
        ),
        (
            "render/mod.rs",
            "fn f() { crate::shell::y::Z; }",
            1,
            "in a path",
        ),
        (
            "render/mod.rs",
            "mod tests { use super::super::super::app::X; }",
            1,
            "by super",
        ),
        (
            "render/mod.rs",
            "use crate::{data::X, math::{y, y::Z}};",
            0,
            "downwards",
        ),
        (
            "app/mod.rs",
            "use crate::app::y; // crate::shell::X\n/* crate::shell::X */",
            0,
            "own room, comments",
        ),
        (
            "app/mod.rs",
            "const T: &str = \"crate::shell::X\"; const R: &str = r#\"crate::shell::X\"#;",
            0,
            "texts",
        ),
    ] {
        assert_eq!(faults_of(path, text), expected, "{what}: {text}");
    }
}

#[test]
fn circles_are_caught() {
    let circles_of = |files: &[(&str, &str)]| {
        let circles = imports::circles(&planted(files).1);
        circles
            .into_iter()
            .map(|(files, _)| files)
            .collect::<Vec<_>>()
    };
    let root = ("lib.rs", "mod a;");
    // Two files, by `super` and by a path in the middle of code.
    let direct = [
        root,
        ("a/mod.rs", "mod b; mod c;"),
        ("a/b.rs", "use super::c::C; pub struct B;"),
        (
            "a/c.rs",
            "pub struct C; fn f() -> crate::a::b::B { todo!() }",
        ),
    ];
    assert_eq!(circles_of(&direct), [["a/b.rs", "a/c.rs"]]);
    // Three files in a ring, one of the imports through a re-export, one through an alias of a module.
    let ring = [
        root,
        ("a/mod.rs", "mod b; mod c; mod d; pub use b::B;"),
        ("a/b.rs", "use super::{c as sea}; pub struct B(sea::C);"),
        ("a/c.rs", "pub use super::d::*; pub struct C;"),
        ("a/d.rs", "use crate::a::B; pub struct D(B);"),
    ];
    assert_eq!(circles_of(&ring), [["a/b.rs", "a/c.rs", "a/d.rs"]]);
    // A mod.rs that declares and re-exports is no importer.
    let declares = [
        root,
        (
            "a/mod.rs",
            "//! Docs.\n#[cfg(test)]\nmod t;\nmod b;\npub(crate) mod c;\npub use b::{B, c_of};",
        ),
        ("a/t.rs", "use super::*;"),
        (
            "a/b.rs",
            "pub struct B; pub fn c_of() -> super::c::C { todo!() }",
        ),
        ("a/c.rs", "pub struct C;"),
    ];
    assert!(
        circles_of(&declares).is_empty(),
        "{:?}",
        circles_of(&declares)
    );
    // A mod.rs that defines something is one.
    let defines = [
        root,
        ("a/mod.rs", "mod b; pub struct A(b::B);"),
        ("a/b.rs", "use super::A; pub struct B(Option<Box<A>>);"),
    ];
    assert_eq!(circles_of(&defines), [["a/b.rs", "a/mod.rs"]]);
    // A test module inside a file imports the file itself.
    let own = [
        root,
        ("a/mod.rs", "mod b;"),
        (
            "a/b.rs",
            "pub struct B; mod tests { use super::*; fn f(_: B, c: char) -> bool { c == '\\'' || c == '\"' } }",
        ),
    ];
    assert!(circles_of(&own).is_empty(), "{:?}", circles_of(&own));
}

#[test]
fn imports_against_the_order_are_caught() {
    let order: [(&str, &[&[&str]]); 1] = [("a", &[&["low", "side"], &["mid.rs"], &["high"]])];
    let faults_of = |path: &str, text: &str| {
        let mut files = vec![
            ("lib.rs", "mod a;"),
            ("a/mod.rs", "mod low; mod side; mod mid; mod high;"),
            ("a/low/mod.rs", "pub mod x; pub mod y;"),
            ("a/low/x.rs", "pub struct X;"),
            ("a/low/y.rs", "pub struct Y;"),
            ("a/side/mod.rs", "pub struct S;"),
            ("a/mid.rs", "pub struct M;"),
            ("a/high/mod.rs", "pub mod h; pub use h::H;"),
            ("a/high/h.rs", "pub struct H;"),
        ];
        match files.iter_mut().find(|file| file.0 == path) {
            Some(file) => file.1 = text,
            None => files.push((path, text)),
        }
        let (sources, graph) = planted(&files);
        house::out_of_order(&graph, &sources, &order).len()
    };
    for (path, text, expected, what) in [
        ("a/low/x.rs", "use crate::a::mid::M;", 1, "upwards"),
        (
            "a/mid.rs",
            "use super::high::H;",
            1,
            "upwards, through a re-export",
        ),
        ("a/low/x.rs", "use crate::a::side::S;", 1, "sideways"),
        ("a/low/x.rs", "use super::y::Y;", 0, "within a folder"),
        (
            "a/high/h.rs",
            "use crate::a::{mid::M, low::{x::X, y::Y}};",
            0,
            "downwards",
        ),
        ("a/new.rs", "", 1, "a file without a place"),
    ] {
        assert_eq!(faults_of(path, text), expected, "{what}: {text}");
    }
}

#[test]
fn forbidden_names_are_caught() {
    let faults_of = |room: &str, text: &str| {
        let files = match room {
            "session" => vec![
                ("lib.rs", "mod app;"),
                ("app/mod.rs", "mod session;"),
                ("app/session/mod.rs", text),
            ],
            _ => vec![("lib.rs", "mod assets;"), ("assets/mod.rs", text)],
        };
        house::forbidden(&planted(&files).1).len()
    };
    for (room, text, expected) in [
        ("session", "fn f(_: egui::Pos2) {}", 1),
        ("session", "use wgpu::{Device, Queue};", 2),
        ("session", "use std::sync::Arc; use glam::Vec3;", 0),
        ("assets", "use std::{fs, io};", 1),
        ("assets", "use std::fs as files; fn f() { files::read; }", 2),
        ("assets", "fn f() { ::std::net::TcpStream::connect; }", 1),
        ("assets", "use web_sys::Window;", 1),
        ("assets", "use std::io::Read; // std::fs::read", 0),
    ] {
        assert_eq!(faults_of(room, text), expected, "{room}: {text}");
    }
}
