//! `cargo xtask readme`: the sheets of pictures that the README shows, drawn by the native program out of the gallery.

use fabrica::document::{Document, pointer};
use serde_json::{Map, Value, json};

use crate::examples::documents;
use crate::run::{Outcome, root};
use crate::sheet::{Sheet, program_of};

/// One picture of a sheet: a document of the gallery at a step, and what is otherwise in it.
struct Tile {
    name: &'static str,
    step: usize,
    changes: Vec<(&'static str, Value)>,
}

fn tile(name: &'static str, step: usize) -> Tile {
    Tile {
        name,
        step,
        changes: Vec::new(),
    }
}

impl Tile {
    /// With another value at a JSON pointer.
    fn with(mut self, pointer: &'static str, value: Value) -> Self {
        self.changes.push((pointer, value));
        self
    }

    fn in_style(self, style: Value) -> Self {
        self.with("/look/style", style)
    }
}

/// Each sheet: its file, the size of a tile in pixels, tiles in a row, and the tiles.
fn sheets() -> Vec<(&'static str, [u32; 2], u32, Vec<Tile>)> {
    let knee = |step| tile("layers-of-the-knee", step);
    let near =
        |name, step, distance: f64| tile(name, step).with("/camera/distance", json!(distance));
    vec![
        (
            "web/sweeps.png",
            [460, 420],
            3,
            vec![
                tile("growing-tumour", 2),
                tile("retracted-tendons", 2),
                tile("held-liver", 2),
            ],
        ),
        (
            "web/clay.png",
            [300, 300],
            4,
            vec![
                tile("squirrel-of-clay", 2),
                tile("squirrel-of-clay", 3),
                tile("squirrel-of-clay", 4),
                tile("squirrel-of-clay", 5),
            ],
        ),
        (
            "web/styles.png",
            [440, 440],
            3,
            vec![
                knee(2).in_style(json!("ink")),
                knee(2).in_style(json!("pencil")),
                knee(2).in_style(json!("blueprint")),
                knee(1).in_style(json!("textbook")),
                near("knee-opening", 1, 2.2)
                    .with("/camera/target", json!([0, 0, 0]))
                    .in_style(json!({ "ghost": { "by": "facing", "strength": 1 } })),
                tile("craniotomy", 3).in_style(
                    json!({ "preset": "atlas", "ghost": { "by": "cut", "strength": 1 } }),
                ),
            ],
        ),
        (
            "web/figures.png",
            [380, 300],
            3,
            vec![
                near("elbow-flexion", 0, 1.9),
                near("elbow-flexion", 1, 1.9),
                near("elbow-flexion", 2, 1.9),
                near("neck-overbent", 0, 1.9),
                near("neck-overbent", 1, 1.9),
                near("neck-overbent", 2, 1.9),
                near("face-likeness", 0, 1.9),
                near("face-likeness", 1, 1.9),
                near("face-likeness", 2, 1.9),
            ],
        ),
    ]
}

/// Draws the sheets anew, or the one of `--only FILE`.
pub(crate) fn readme(args: &[String]) -> Outcome {
    let (only, rest) = match args {
        [flag, file, rest @ ..] if flag == "--only" => (Some(file.as_str()), rest),
        rest => (None, rest),
    };
    let fabrica = program_of("readme", rest)?;
    let gallery = documents(root())?;
    for (path, size_px, columns, tiles) in sheets() {
        if only.is_some_and(|only| !path.contains(only)) {
            continue;
        }
        let mut sheet = Sheet::new(size_px, columns);
        for Tile {
            name,
            step,
            changes,
        } in tiles
        {
            let found = gallery.iter().find(|(other, _)| other == name);
            let (_, document) = found.ok_or_else(|| format!("the gallery has no {name}"))?;
            let document =
                changed(document, changes).map_err(|error| format!("{name}: {error}"))?;
            sheet.add(&fabrica, &document, step)?;
        }
        sheet.write_whole(&root().join(path))?;
    }
    Ok(())
}

/// The document with other values; what a pointer goes through is made where it is not there.
fn changed(document: &Document, changes: Vec<(&'static str, Value)>) -> Result<Document, String> {
    let told = |error: &dyn std::fmt::Display| error.to_string();
    let mut tree: Value = serde_json::from_str(&document.to_json()).map_err(|e| told(&e))?;
    for (pointer, value) in changes {
        let mut at = &mut tree;
        for key in pointer::keys(pointer).map_err(|e| told(&e))? {
            at = at
                .as_object_mut()
                .ok_or_else(|| format!("{pointer} leads through no object"))?
                .entry(key)
                .or_insert_with(|| Value::Object(Map::new()));
        }
        *at = value;
    }
    Document::from_value(tree).map_err(|e| told(&e))
}
