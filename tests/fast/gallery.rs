//! The gallery's documents: each is whole, says what it shows, and fits a link.

use std::fs;
use std::path::{Path, PathBuf};

use crate::examples;
use fabrica::document::Document;
use fabrica::link;

pub(crate) fn files() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("web/gallery");
    let entries = fs::read_dir(&folder).expect("the gallery's folder");
    let mut files: Vec<PathBuf> = entries
        .map(|entry| entry.expect("an entry").path())
        .collect();
    files.sort();
    files
}

#[test]
fn every_document_is_whole_and_says_what_it_shows() {
    let files = files();
    assert!(files.len() >= 12, "only {} documents", files.len());
    for file in files {
        let name = file.display();
        let text = fs::read_to_string(&file).expect("text");
        let document = Document::from_json(&text).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert!(
            document.notices().is_empty(),
            "{name}: {:?}",
            document.notices()
        );
        assert_eq!(
            document.to_json().trim(),
            text.trim(),
            "{name} is not canonical"
        );
        let shown = document.illustration();
        assert!(!shown.subject.has_file(), "{name} needs a file");
        for (what, text) in [
            ("title", &shown.title),
            ("caption", &shown.legend),
            ("credit", &shown.credit),
        ] {
            assert!(!text.is_empty(), "{name} has no {what}");
        }
        assert!(!shown.steps.is_empty(), "{name} has no steps");
        for (i, step) in shown.steps.iter().enumerate() {
            assert!(
                !step.title.is_empty(),
                "{name}: step {} has no title",
                i + 1
            );
            let at = document.at_step(i + 1);
            assert!(at.is_ok(), "{name}: step {}: {at:?}", i + 1);
        }
        for label in &shown.captions {
            assert!(
                label.at.abs().max_element() <= 0.5,
                "{name}: the label {} is outside the subject",
                label.text
            );
        }
    }
}

#[test]
fn every_document_fits_a_link_and_comes_back() {
    for file in files() {
        let name = file.display();
        let text = fs::read_to_string(&file).expect("text");
        let document = Document::from_json(&text).expect("a document");
        let payload = link::encode(&document);
        assert!(
            payload.len() <= 2000,
            "{name}: {} characters",
            payload.len()
        );
        let back = link::decode(&payload).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert_eq!(back.document.to_json(), document.to_json(), "{name}");
    }
}

/// List and pictures of the examples ship with the program; both are written by one command.
#[test]
fn the_list_of_examples_is_the_gallery() {
    const REMEDY: &str = "run `cargo xtask examples`";
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let gallery = examples::examples(root).expect("the gallery");
    assert_eq!(gallery.len(), files().len());
    let list = fs::read_to_string(root.join(examples::LIST)).expect("the list");
    let expected = examples::list(&gallery);
    assert!(list == expected, "the list is out of date: {REMEDY}");

    let pictures = fs::read(root.join(examples::PICTURES)).expect("the pictures");
    let weight = pictures.len() + list.len();
    assert!(weight <= 400_000, "{weight} bytes for a page to fetch");
    let sheet = image::load_from_memory(&pictures)
        .expect("a PNG")
        .to_rgba8();
    let ([width, height], columns) = (examples::TILE_PX, examples::COLUMNS);
    let rows = (gallery.len() as u32).div_ceil(columns);
    assert_eq!(
        sheet.dimensions(),
        (columns * width, rows * height),
        "{REMEDY}"
    );
    for (index, (name, _)) in (0..).zip(&gallery) {
        let (x, y) = (index % columns * width, index / columns * height);
        let tile = image::imageops::crop_imm(&sheet, x, y, width, height).to_image();
        let corner = *tile.get_pixel(0, height / 2);
        let drawn = tile.pixels().filter(|pixel| **pixel != corner).count();
        assert!(drawn > 2000, "{name}: {drawn} pixels are drawn");
    }
}
