//! The plan of the crate: which room may import which, and the order of the folders within a room.
//!
//! `cargo xtask imports` writes it into the docs (`src/imports.md`); `tests/fast/layers.rs` fails if the source breaks
//! it.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use super::imports::{self, Graph, Import, Source};

/// Rooms with their layers: a room imports only rooms of lower layers.
pub(crate) const ROOMS: [(&str, u32); 17] = [
    ("math", 0),
    ("pictures", 1),
    ("displace", 1),
    ("document", 2),
    ("link", 3),
    ("data", 3),
    ("load", 4),
    ("figure", 4),
    ("clay", 4),
    ("subjects", 4),
    ("placed", 4),
    ("describe", 4),
    ("render", 5),
    ("assets", 5),
    ("app", 6),
    ("reader", 6),
    ("shell", 7),
];

/// The order within rooms, from the bottom up. An entry is a folder or a file of the room; one step may hold several. A
/// file imports only from its own entry and from lower steps.
pub(crate) const ORDER: [(&str, &[&[&str]]); 3] = [
    (
        "document",
        &[
            &["limits.rs"],
            &["model", "text"],
            &["schema.rs"],
            &["read", "write"],
            &["pose.rs"],
            &["canonical.rs", "steps.rs", "blend.rs"],
            &["difference.rs"],
            &["recording.rs", "lesson.rs", "turn.rs"],
            &["tree.rs"],
            &["naming.rs", "walk.rs", "autoplay.rs"],
            &["history.rs", "authoring.rs", "reference.rs"],
            &["carry.rs"],
            &["tests"],
        ],
    ),
    (
        "render",
        &[
            &["device"],
            &["pack"],
            &["subject"],
            &["stage"],
            &["scene.rs"],
            &["draw"],
        ],
    ),
    (
        "app",
        &[
            &["words"],
            &["session"],
            &["services.rs"],
            &["kit", "picture"],
            &["canvas", "panel"],
            &["window.rs"],
            &[
                "arrivals.rs",
                "dropped.rs",
                "fields.rs",
                "layout.rs",
                "provisional.rs",
                "recents.rs",
                "saving.rs",
                "window_title.rs",
            ],
        ],
    ),
];

/// Paths that a part of the crate does not name: what the part is, its paths below `src`, beginnings of paths, and why.
pub(crate) const FORBIDDEN: [(&str, &[&str], &[&str]); 3] = [
    (
        "the session knows no window and no GPU",
        &["app/session/", "app/words/"],
        &[
            "egui", "eframe", "wgpu", "winit", "web_sys", "std::fs", "std::net",
        ],
    ),
    (
        "a picture is put into words without a window and without a GPU",
        &["describe/"],
        &[
            "egui", "eframe", "wgpu", "winit", "web_sys", "js_sys", "std::fs", "std::net",
        ],
    ),
    (
        "assets do no input or output and know no GPU",
        &["assets/"],
        &[
            "std::fs",
            "std::net",
            "std::process",
            "std::env",
            "std::thread",
            "web_sys",
            "js_sys",
            "wasm_bindgen",
            "wasm_bindgen_futures",
            "rfd",
            "egui",
            "eframe",
            "wgpu",
        ],
    ),
];

/// Reads all sources under a folder, sorted by their paths.
pub(crate) fn sources(src: &Path) -> std::io::Result<Vec<Source>> {
    fn add(folder: &Path, below: &str, found: &mut Vec<Source>) -> std::io::Result<()> {
        for entry in fs::read_dir(folder)? {
            let entry = entry?;
            let name = format!("{below}{}", entry.file_name().to_string_lossy());
            if entry.path().is_dir() {
                add(&entry.path(), &format!("{name}/"), found)?;
            } else if name.ends_with(".rs") {
                let text = fs::read_to_string(entry.path())?;
                found.push(Source { path: name, text });
            }
        }
        Ok(())
    }
    let mut found = Vec::new();
    add(src, "", &mut found)?;
    found.sort_by(|a, b| a.path.cmp(&b.path));
    Ok(found)
}

/// The room of a file below `src`; programs and the crate's root have none.
pub(crate) fn room_of(path: &str) -> Option<&str> {
    let (folder, _) = path.split_once('/')?;
    (folder != "bin").then_some(folder)
}

fn layer(room: &str) -> Option<u32> {
    ROOMS.iter().find(|(name, _)| *name == room).map(|r| r.1)
}

/// Where an import stands, for a message.
fn shown(import: &Import) -> String {
    let Import {
        from,
        to,
        line,
        written,
    } = import;
    format!("src/{from}:{line} imports {to} ({written})")
}

/// Imports between rooms that do not point down.
pub(crate) fn upward(graph: &Graph) -> Vec<String> {
    let faults = graph.imports.iter().filter_map(|import| {
        let (from, to) = (room_of(&import.from)?, room_of(&import.to)?);
        let (own, other) = (layer(from)?, layer(to)?);
        (from != to && other >= own)
            .then(|| format!("{}: layer {own} imports layer {other}", shown(import)))
    });
    faults.collect()
}

/// The step and the entry of a file in the order of its room; nothing for a `mod.rs` and for rooms without an order.
fn step<'a>(
    order: &'a [(&'a str, &'a [&'a [&'a str]])],
    path: &str,
) -> Option<Result<(usize, &'a str), ()>> {
    let (room, rest) = path.split_once('/')?;
    let (_, steps) = order.iter().find(|(name, _)| *name == room)?;
    if rest == "mod.rs" {
        return None;
    }
    let entry = rest.split('/').next().unwrap_or(rest);
    let found = steps
        .iter()
        .enumerate()
        .find_map(|(i, step)| step.iter().find(|e| **e == entry).map(|e| (i, *e)));
    Some(found.ok_or(()))
}

/// Imports against the order within a room, and files that the order does not name.
pub(crate) fn out_of_order(
    graph: &Graph,
    sources: &[Source],
    order: &[(&str, &[&[&str]])],
) -> Vec<String> {
    let mut faults = Vec::new();
    for source in sources {
        if let Some(Err(())) = step(order, &source.path) {
            faults.push(format!(
                "src/{} has no place in the order of its room",
                source.path
            ));
        }
    }
    for import in &graph.imports {
        if room_of(&import.from) != room_of(&import.to) {
            continue;
        }
        let (Some(Ok(from)), Some(Ok(to))) = (step(order, &import.from), step(order, &import.to))
        else {
            continue;
        };
        if to.0 > from.0 || (to.0 == from.0 && to.1 != from.1) {
            faults.push(format!(
                "{}: {} may not import {}",
                shown(import),
                from.1,
                to.1
            ));
        }
    }
    faults
}

/// Paths out of the crate that a part of it must not name.
pub(crate) fn forbidden(graph: &Graph) -> Vec<String> {
    let mut faults = Vec::new();
    for (what, places, names) in FORBIDDEN {
        for foreign in &graph.foreign {
            let is_there = places.iter().any(|place| foreign.from.starts_with(place));
            let is_named = |name: &&&str| {
                let rest = foreign.path.strip_prefix(**name);
                rest.is_some_and(|rest| rest.is_empty() || rest.starts_with("::"))
            };
            if let (true, Some(_)) = (is_there, names.iter().find(is_named)) {
                faults.push(format!(
                    "src/{}:{} names {}: {what}",
                    foreign.from, foreign.line, foreign.path
                ));
            }
        }
    }
    faults
}

/// Groups of files that import each other, directly or in a circle, with the imports within each group.
pub(crate) fn in_circles(graph: &Graph) -> Vec<String> {
    let mut faults = Vec::new();
    for (files, within) in imports::circles(graph) {
        faults.push(format!(
            "a circle of {} files: {}",
            files.len(),
            files.join(", ")
        ));
        faults.extend(within.iter().map(|import| format!("  {}", shown(import))));
    }
    faults
}

/// Files that no `mod` line reaches: nothing compiles them.
pub(crate) fn unreached(graph: &Graph) -> Vec<String> {
    let files = graph.unreached.iter();
    files
        .map(|file| format!("src/{file}: no `mod` line leads to it"))
        .collect()
}

// ---------------------------------------------------------------------------------------------------- the page of the
// docs

/// Rooms that each room imports.
fn rooms(graph: &Graph) -> BTreeMap<&str, BTreeSet<&str>> {
    let mut found: BTreeMap<&str, BTreeSet<&str>> = BTreeMap::new();
    for import in &graph.imports {
        if let (Some(from), Some(to)) = (room_of(&import.from), room_of(&import.to))
            && from != to
        {
            found.entry(from).or_default().insert(to);
        }
    }
    found
}

/// The page `src/imports.md`: the graph of the rooms as a picture and as a table, and the order within rooms.
pub(crate) fn page(graph: &Graph) -> String {
    let rooms = rooms(graph);
    let mut page = String::from(
        "<!-- Written by `cargo xtask imports`; a test fails when it is out of date. -->\n\n\
         Rooms, and the rooms that they import (an arrow is left out where a longer way leads to the same room):\n\n",
    );
    page.push_str(&picture(&rooms));
    page.push_str("\n| room | layer | imports |\n|---|---|---|\n");
    for (room, layer) in ROOMS {
        let imported: Vec<&str> = ROOMS
            .iter()
            .map(|(name, _)| *name)
            .filter(|name| rooms.get(room).is_some_and(|all| all.contains(name)))
            .collect();
        let _ = writeln!(page, "| `{room}` | {layer} | {} |", imported.join(", "));
    }
    page.push_str("\nWithin these rooms a file imports only from its own place and from places before it:\n\n");
    for (room, steps) in ORDER {
        let steps: Vec<String> = steps.iter().map(|step| step.join(", ")).collect();
        let _ = writeln!(page, "- `{room}`: {}", steps.join(" ← ").replace(".rs", ""));
    }
    page
}

/// The rooms as an SVG, one row for each layer, the lowest at the bottom.
fn picture(rooms: &BTreeMap<&str, BTreeSet<&str>>) -> String {
    const WIDTH: i32 = 700;
    const ROW: i32 = 64;
    const BOX: (i32, i32) = (92, 28);
    let top = ROOMS.iter().map(|r| r.1).max().unwrap_or(0);
    let place = |room: &str| {
        let own = layer(room).unwrap_or(0);
        let row: Vec<&str> = ROOMS.iter().filter(|r| r.1 == own).map(|r| r.0).collect();
        let i = row.iter().position(|name| *name == room).unwrap_or(0) as i32;
        // Every second row stands a little aside, so that arrows that pass a layer do not pass through its boxes.
        let aside = if own.is_multiple_of(2) { -50 } else { 50 };
        let x = WIDTH * (2 * i + 1) / (2 * row.len() as i32) + aside;
        (x, ROW * (top - own) as i32 + ROW / 2)
    };
    let reaches = |from: &str, to: &str| {
        let (mut todo, mut seen) = (vec![from], BTreeSet::new());
        while let Some(room) = todo.pop() {
            for next in rooms.get(room).into_iter().flatten() {
                if seen.insert(*next) {
                    todo.push(next);
                }
            }
        }
        seen.contains(to)
    };
    let mut svg = format!(
        "<svg viewBox=\"0 0 {WIDTH} {}\" width=\"{WIDTH}\" font-family=\"sans-serif\" font-size=\"13\" text-anchor=\"middle\">\n",
        ROW * (top as i32 + 1)
    );
    for (from, all) in rooms {
        for to in all {
            let is_implied = all.iter().any(|other| other != to && reaches(other, to));
            if is_implied {
                continue;
            }
            let ((x0, y0), (x1, y1)) = (place(from), place(to));
            let _ = writeln!(
                svg,
                "<line x1=\"{x0}\" y1=\"{}\" x2=\"{x1}\" y2=\"{}\" stroke=\"#888\"/>",
                y0 + BOX.1 / 2,
                y1 - BOX.1 / 2
            );
        }
    }
    for (room, _) in ROOMS {
        let (x, y) = place(room);
        let _ = writeln!(
            svg,
            "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" rx=\"4\" fill=\"#eef\" stroke=\"#668\"/><text x=\"{x}\" y=\"{}\" fill=\"#223\">{room}</text>",
            x - BOX.0 / 2,
            y - BOX.1 / 2,
            BOX.0,
            BOX.1,
            y + 5
        );
    }
    svg.push_str("</svg>\n");
    svg
}
