//! The gallery's documents: each is whole, says what it shows, and fits a link.

use std::fs;
use std::path::{Path, PathBuf};

use fabrica::document::{Document, SubjectRef};
use fabrica::link;

fn files() -> Vec<PathBuf> {
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
        assert!(
            matches!(shown.subject, SubjectRef::Builtin { .. }),
            "{name} needs a file"
        );
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
