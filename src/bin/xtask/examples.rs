//! The list of examples: the documents of the gallery in one file, which the page and the native program fetch when the
//! library is opened. It needs nothing of the other commands, as a test compares the list with the gallery.

use std::fs;
use std::path::{Path, PathBuf};

use fabrica::document::{DRAWN_FIGURES, Document, SubjectRef};
use fabrica::subjects;

/// Width and height of an example's picture, pixels: twice its width in points on a small window.
pub(crate) const TILE_PX: [u32; 2] = [240, 180];
/// Pictures in a row of their sheet.
pub(crate) const COLUMNS: u32 = 5;
/// The list, below the repository's root.
pub(crate) const LIST: &str = "web/examples/list.json";
/// The sheet of pictures, in the order of the list.
pub(crate) const PICTURES: &str = "web/examples/pictures.png";

/// The gallery's documents by file name, in the order of the names.
pub(crate) fn documents(root: &Path) -> Result<Vec<(String, Document)>, String> {
    let folder = root.join("web/gallery");
    let entries =
        fs::read_dir(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let mut files: Vec<PathBuf> = entries
        .filter_map(|entry| Some(entry.ok()?.path()))
        .filter(|path| path.extension().is_some_and(|end| end == "json"))
        .collect();
    files.sort();
    files
        .into_iter()
        .map(|path| {
            let located = |error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
            let text = fs::read_to_string(&path).map_err(|error| located(&error))?;
            let document = Document::from_json(&text).map_err(|error| located(&error))?;
            let stem = path.file_stem().unwrap_or_default();
            Ok((stem.to_string_lossy().into_owned(), document))
        })
        .collect()
}

/// The examples in the order of the library: anatomy before toys, the documents of a subject together.
pub(crate) fn examples(root: &Path) -> Result<Vec<(String, Document)>, String> {
    const FIRST: [&str; 4] = ["head", "torso", "knee", "hand"];
    let mut examples = documents(root)?;
    let anatomy = FIRST.into_iter().chain(DRAWN_FIGURES);
    let names: Vec<&str> = anatomy.chain(subjects::all_names()).collect();
    examples.sort_by_key(|(_, document)| match &document.illustration().subject {
        SubjectRef::Builtin { name, .. } => names.iter().position(|other| other == name),
        SubjectRef::Address { .. }
        | SubjectRef::Supplied { .. }
        | SubjectRef::Meshes { .. }
        | SubjectRef::Clay(_) => Some(names.len()),
    });
    Ok(examples)
}

/// The text of the list: a line per example, with its name in the gallery and its whole document.
pub(crate) fn list(examples: &[(String, Document)]) -> String {
    let lines = examples.iter().map(|(name, document)| {
        let document = document.to_json_compact();
        format!("{{\"name\":\"{name}\",\"document\":{document}}}")
    });
    let lines: Vec<String> = lines.collect();
    let [width, height] = TILE_PX;
    format!(
        "{{\"tile\":[{width},{height}],\"examples\":[\n{}\n]}}\n",
        lines.join(",\n")
    )
}
