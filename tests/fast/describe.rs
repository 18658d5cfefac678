//! Pictures in words: the gallery's documents and the built-in subjects, in every language.

use std::fs;

use fabrica::describe::{self, Lang, Measured, Seen, Sight, describe};
use fabrica::document::Document;
use fabrica::link;
use fabrica::subjects::{self, Generator};

/// Every step of the gallery has words, and neighbouring steps have other ones, without a look at the pictures.
#[test]
fn every_step_of_the_gallery_has_words_of_its_own() {
    let mut steps = 0;
    for file in crate::gallery::files() {
        let name = file.display();
        let text = fs::read_to_string(&file).expect("text");
        let document = Document::from_json(&text).expect("a document");
        for lang in Lang::ALL {
            let mut before = String::new();
            for step in 0..=document.step_count() {
                let told = describe(&document, step, &Measured::default(), lang).expect("a step");
                let told = told.text();
                assert!(told.chars().count() > 40, "{name}, step {step}: {told}");
                assert_ne!(told, before, "{name}, step {step}");
                assert!(
                    !told.contains(['{', '}', '\n']),
                    "{name}, step {step}: {told}"
                );
                before = told.to_owned();
                steps += 1;
            }
        }
    }
    assert!(steps > 300, "only {steps} steps were seen");
}

#[test]
fn built_in_subjects_and_their_segments_have_names() {
    for name in subjects::names() {
        assert!(describe::subject(name).is_some(), "{name}");
        let text = format!(r#"{{"fabrica":1,"subject":{{"builtin":"{name}"}}}}"#);
        let document = Document::from_json(&text).expect("a document");
        let header = Generator::new(name, 16)
            .expect("a built-in subject")
            .header();
        for segment in header.segmentation.expect("segments").segments {
            let sight = Sight {
                object: 0.5,
                segments: vec![Seen {
                    name: segment.name.clone(),
                    share: 1.0,
                }],
                unnamed: 0.0,
            };
            let measured = Measured {
                sight: Some(sight),
                mm_per_unit: None,
                turned: None,
            };
            let told = describe(&document, 0, &measured, Lang::Chinese).expect("step 0");
            let told = told.text();
            assert!(
                !told.contains(|c: char| c.is_ascii_alphabetic()),
                "{name}: {}: {told}",
                segment.name
            );
        }
    }
}

/// The author's text goes with the link, whatever is in it.
#[test]
fn the_authors_text_travels_in_the_link() {
    let hostile = "</script><b>\u{202e}“ß”\u{0}\n\\ 骨 \u{1f9b4}";
    let value =
        serde_json::json!({ "fabrica": 1, "alt": hostile, "steps": [{ "alt": "Geöffnet." }] });
    let document = Document::from_value(value).expect("a document");
    let back = link::decode(&link::fragment(&document, 1))
        .expect("a link")
        .document;
    assert_eq!(back, document);
    assert_eq!(back.illustration().alt, hostile);
    let told = |step| {
        let told = describe(&back, step, &Measured::default(), Lang::German).expect("a step");
        told.text().to_owned()
    };
    assert_eq!(told(1), "Geöffnet.");
    assert!(!told(0).contains(char::is_control), "{:?}", told(0));
}
