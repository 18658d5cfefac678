use crate::document::{
    CleanStep, Document, DocumentError, MAX_CLEAN_MM, MAX_RECIPES, MAX_SEEDS, Recipe,
};
use serde_json::Value;

fn read(recipes: &str) -> Result<Document, DocumentError> {
    Document::from_json(&format!(
        r#"{{"fabrica":1,"subject":{{"builtin":"knee","features":{recipes}}}}}"#
    ))
}

#[test]
fn recipes_are_read_and_written_as_they_are() {
    let text = r##"[{"name":"bone","color":"#eadfc4","from":{"threshold":[200]},"clean":[{"largest":2},{"close":2},{"fill":true},{"smooth":1.5},{"grow":1},{"shrink":0.5}]},{"name":"vessel","from":{"grow":{"seeds":[[0.1,-0.2,0.3]],"range":[150,400]}}}]"##;
    let document = read(text).expect("a document");
    assert_eq!(document.notices(), &[], "nothing to say");
    let recipes = &document.illustration().recipes;
    assert_eq!(recipes.len(), 2);
    assert_eq!(recipes[0].clean.len(), 6);
    assert_eq!(recipes[0].clean[3], CleanStep::Smooth(1.5));
    assert!(
        recipes[0].from.range().is_some_and(|range| range[1] > 1e30),
        "one number has no upper end"
    );
    let written: Vec<Value> = recipes.iter().map(Recipe::to_value).collect();
    let whole = document.to_json_compact();
    let again = read(&Value::from(written).to_string()).expect("as written");
    assert_eq!(again.to_json_compact(), whole);
    assert_eq!(
        Document::from_json(&whole)
            .expect("again")
            .to_json_compact(),
        whole
    );
    assert!(whole.contains(text), "keys in their order: {whole}");
}

#[test]
fn hostile_recipes_are_refused_or_clamped_in_words() {
    let refused = |recipes: &str, pointer: &str| {
        let error = read(recipes).expect_err(recipes).to_string();
        assert!(error.starts_with(pointer), "{error}");
    };
    refused("{}", "/subject/features: expected a list");
    refused("[7]", "/subject/features/0: expected an object");
    refused(
        r#"[{"from":{"threshold":[]}}]"#,
        "/subject/features/0/from/threshold",
    );
    refused(
        r#"[{"from":{"threshold":[1,2,3]}}]"#,
        "/subject/features/0/from/threshold",
    );
    refused(
        r#"[{"from":{"threshold":["a"]}}]"#,
        "/subject/features/0/from/threshold/0",
    );
    refused(
        r#"[{"from":{"grow":{"seeds":[[0,0]],"range":[1,2]}}}]"#,
        "/subject/features/0/from/grow/seeds/0",
    );
    refused(
        r#"[{"from":{"grow":{"seeds":[]}}}]"#,
        "/subject/features/0/from/grow/range",
    );
    refused(
        r#"[{"from":{"threshold":[1]},"clean":[{"grow":1,"shrink":1}]}]"#,
        "/subject/features/0/clean/0",
    );
    refused(
        r#"[{"from":{"threshold":[1]},"clean":[{"grow":"x"}]}]"#,
        "/subject/features/0/clean/0/grow",
    );
    for text in ["NaN", "1e999"] {
        read(&format!(r#"[{{"from":{{"threshold":[{text}]}}}}]"#)).expect_err(text);
    }
    let seeds = vec!["[0,0,0]"; MAX_SEEDS + 1].join(",");
    refused(
        &format!(r#"[{{"from":{{"grow":{{"seeds":[{seeds}],"range":[1,2]}}}}}}]"#),
        "/subject/features/0/from/grow/seeds: 65 seeds",
    );
    let many = vec![r#"{"from":{"threshold":[1]}}"#; MAX_RECIPES + 1].join(",");
    refused(&format!("[{many}]"), "/subject/features: 17 features");

    let odd = read(
        r#"[{"from":{"threshold":[9,3]},"clean":[{"grow":1e9},{"largest":0},{"sharpen":1},{"smooth":-1}]},{"name":"x"}]"#,
    )
    .expect("clamped");
    let lines: Vec<String> = odd.notices().iter().map(ToString::to_string).collect();
    for part in [
        "/subject/features/0/from/threshold: [9, 3]",
        "/subject/features/0/clean/0/grow: 1000000000",
        "/subject/features/0/clean/1/largest: 0",
        "/subject/features/0/clean/2: this version does not know “sharpen”",
        "/subject/features/0/clean/3/smooth: -1",
        "/subject/features/1/from: features are found by threshold or grow",
    ] {
        assert!(
            lines.iter().any(|line| line.starts_with(part)),
            "{part}: {lines:#?}"
        );
    }
    let recipes = &odd.illustration().recipes;
    assert_eq!(recipes.len(), 1, "the one that is known");
    assert_eq!(recipes[0].name, "feature 1");
    assert_eq!(recipes[0].from.range(), Some([3.0, 9.0]));
    assert_eq!(
        recipes[0].clean,
        [
            CleanStep::Grow(MAX_CLEAN_MM),
            CleanStep::Largest(1),
            CleanStep::Smooth(0.0)
        ]
    );
}
