//! Revisions of the built-in subjects: read, written, refused.

use serde_json::json;

use super::{document, notices};
use crate::document::{ClayStart, Document, Edit, SubjectRef, VoxelSource, newest_revision};

fn revision(document: &Document) -> u32 {
    match &document.illustration().subject {
        SubjectRef::Builtin { revision, .. } => *revision,
        other => panic!("{other:?} is built in"),
    }
}

#[test]
fn a_document_without_a_revision_shows_the_first() {
    let of = |subject| document(json!({ "fabrica": 1, "subject": subject }));
    for subject in [
        json!({ "builtin": "torso" }),
        json!({ "builtin": "torso", "revision": 0 }),
        json!({ "builtin": "torso", "revision": 1 }),
        json!({}),
    ] {
        let read = of(subject.clone());
        assert_eq!((revision(&read), notices(&read)), (1, vec![]), "{subject}");
    }
    let second = of(json!({ "builtin": "torso", "revision": 2 }));
    assert_eq!((revision(&second), notices(&second)), (2, vec![]));
    let again = Document::from_json(&second.to_json_compact()).expect("a document");
    assert_eq!(again, second);
}

#[test]
fn a_revision_to_come_is_named_and_kept() {
    for (name, number) in [("torso", 3), ("cube", 2), ("head", u64::MAX)] {
        let subject = json!({ "builtin": name, "revision": number });
        let read = document(json!({ "fabrica": 1, "subject": subject }));
        assert_eq!(revision(&read), newest_revision(name), "{name}");
        let said = notices(&read);
        assert!(
            matches!(&said[..], [one] if one.starts_with("/subject/revision: ") && one.contains("does not know")),
            "{said:?}"
        );
        assert!(read.to_json_compact().contains(&number.to_string()), "kept");
    }
    for wrong in [json!(-1), json!(1.5), json!("2"), json!(null)] {
        for subject in [
            json!({ "builtin": "torso", "revision": wrong }),
            json!({ "src": "a.nii", "revision": wrong }),
            json!({ "clay": {}, "revision": wrong }),
        ] {
            let text = json!({ "fabrica": 1, "subject": subject }).to_string();
            let error = Document::from_json(&text).expect_err("no whole number");
            assert!(error.to_string().contains("/subject/revision"), "{error}");
        }
    }
}

#[test]
fn another_revision_leaves_segments_and_another_subject_does_not() {
    let first = document(json!({ "fabrica": 1, "subject": {
        "builtin": "torso", "segments": [{ "names": { "1": "hide" } }] } }));
    let set = |subject| Edit::SetSubject(subject).apply(&first).expect("an edit");
    let newer = set(SubjectRef::newest("torso"));
    assert_eq!(revision(&newer), 2);
    assert_eq!(newer.illustration().segments, first.illustration().segments);
    assert!(newer.to_json_compact().contains(r#""revision":2"#));
    let other = set(SubjectRef::newest("cube"));
    assert!(other.illustration().segments.is_empty());
    assert!(
        !other.to_json_compact().contains("revision"),
        "it has one alone"
    );
    let back = Edit::SetSubject(first.illustration().subject.clone());
    assert_eq!(back.apply(&newer).expect("an edit"), first);
}

#[test]
fn a_clay_begins_with_the_revision_that_it_names() {
    for (revision, wanted) in [(json!(2), 2), (json!(0), 1), (json!(9), 2)] {
        let of = json!({ "builtin": "hand", "revision": revision });
        let from = json!({ "of": of, "segment": "veins" });
        let read = document(json!({ "fabrica": 1, "subject": { "clay": { "from": from } } }));
        let SubjectRef::Clay(clay) = &read.illustration().subject else {
            panic!("a clay");
        };
        let ClayStart::Volume(volume) = &clay.from else {
            panic!("of a volume");
        };
        let name = "hand".to_owned();
        let meant = VoxelSource::Builtin {
            name,
            revision: wanted,
        };
        assert_eq!(volume.of, meant);
        let written = Document::from_json(&json!({ "fabrica": 1, "subject": { "clay":
            serde_json::from_str::<serde_json::Value>(&crate::document::clay_to_text(clay)).expect("JSON") } }).to_string());
        let written = written.expect("a document");
        assert_eq!(written.illustration().subject, read.illustration().subject);
    }
}

#[test]
fn an_author_begins_with_the_newest_head() {
    let fresh = Document::fresh();
    assert_eq!(fresh.illustration().subject, SubjectRef::newest("head"));
    assert_eq!(revision(&fresh), newest_revision("head"));
    assert!(notices(&fresh).is_empty());
    assert!(fresh.is_blank() && Document::new().is_blank());
    let named = Document::from_json(r#"{ "fabrica": 1, "title": "Head" }"#).expect("a document");
    assert!(!named.is_blank());
}
