use crate::document::{
    CleanStep, Document, DocumentError, MAX_BALL_MM, MAX_CLEAN_MM, MAX_RECIPES, MAX_SEEDS,
    MAX_STROKE_PLACES, MAX_STROKES, MIN_BALL_MM, Recipe, RecipeSource,
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

#[test]
fn strokes_are_read_and_written_as_they_are() {
    let text = r#"[{"name":"bone","from":{"threshold":[200]},"paint":[{"path":[20,50,-100,12,0,-4],"radius":3},{"erase":true,"path":[21,52,99],"radius":0.25}]},{"name":"by hand","paint":[]}]"#;
    let document = read(text).expect("a document");
    assert_eq!(document.notices(), &[], "nothing to say");
    let recipes = &document.illustration().recipes;
    let [painted, erased] = &recipes[0].paint[..] else {
        panic!("{recipes:?}");
    };
    assert!(!painted.erases && erased.erases);
    assert_eq!([painted.radius_mm, erased.radius_mm], [3.0, 0.25]);
    let places: Vec<[i32; 3]> = painted.places.iter().map(|p| p.to_array()).collect();
    assert_eq!(places, [[20, 50, -100], [32, 50, -104]]);
    assert_eq!(recipes[1].from, RecipeSource::Nothing, "it is only painted");
    let whole = document.to_json_compact();
    assert!(
        whole.contains(text),
        "keys in their order, and `paint` where it is empty: {whole}"
    );
    let written: Vec<Value> = recipes.iter().map(Recipe::to_value).collect();
    let again = read(&Value::from(written).to_string()).expect("as written");
    assert_eq!(again.to_json_compact(), whole);
}

#[test]
fn hostile_strokes_are_refused_or_clamped_in_words() {
    let of =
        |stroke: &str| format!(r#"[{{"name":"x","from":{{"threshold":[1]}},"paint":[{stroke}]}}]"#);
    let at = "/subject/features/0/paint";
    for (stroke, fault) in [
        ("7".to_owned(), "/0: expected an object"),
        ("{}".to_owned(), "/0/path: expected a list of whole numbers"),
        (
            r#"{"path":[]}"#.to_owned(),
            "/0/path: expected a list of whole numbers",
        ),
        (
            r#"{"path":[1,2,3,4]}"#.to_owned(),
            "/0/path: expected a list of whole numbers",
        ),
        (
            r#"{"path":[1,"a",3]}"#.to_owned(),
            "/0/path/1: expected a number",
        ),
        (
            r#"{"path":[1,2,3],"radius":"wide"}"#.to_owned(),
            "/0/radius: expected a number",
        ),
        (
            r#"{"path":[1,2,3],"erase":1}"#.to_owned(),
            "/0/erase: expected true or false",
        ),
        (
            format!(
                r#"{{"path":[{}]}}"#,
                vec!["1"; 3 * MAX_STROKE_PLACES + 3].join(",")
            ),
            "/0/path: 65 places, at most 64",
        ),
        (
            vec![r#"{"path":[0,0,0]}"#; MAX_STROKES + 1].join(","),
            ": 1001 strokes, at most 1000",
        ),
    ] {
        let error = read(&of(&stroke)).expect_err(fault).to_string();
        assert!(error.starts_with(&format!("{at}{fault}")), "{error}");
    }
    for text in ["NaN", "1e999", "-Infinity"] {
        read(&of(&format!(r#"{{"path":[0,{text},0]}}"#))).expect_err(text);
        read(&of(&format!(r#"{{"path":[0,0,0],"radius":{text}}}"#))).expect_err(text);
    }
    let odd = of(
        r#"{"path":[1000000,0.4,-1e300, -30000,0,1e300],"radius":1e9},{"path":[0,0,0],"radius":-3,"soft":1}"#,
    );
    let odd = read(&odd).expect("clamped");
    let lines: Vec<String> = odd.notices().iter().map(ToString::to_string).collect();
    for part in [
        "0/path/0: 1000000",
        "0/path/1: 0.4",
        "0/path/2: -",
        "0/path/3: -30000",
        "0/path/5: ",
        "0/radius: 1000000000",
        "1/radius: -3",
        "1/soft: ",
    ] {
        let part = format!("{at}/{part}");
        assert!(
            lines.iter().any(|line| line.starts_with(&part)),
            "{part}: {lines:#?}"
        );
    }
    let paint = &odd.illustration().recipes[0].paint;
    let places: Vec<[i32; 3]> = paint[0].places.iter().map(|p| p.to_array()).collect();
    assert_eq!(places, [[10_000, 0, -10_000], [-10_000, 0, 10_000]]);
    assert_eq!(
        [paint[0].radius_mm, paint[1].radius_mm],
        [MAX_BALL_MM, MIN_BALL_MM]
    );
    // Drafts of later versions stay unread, whatever is painted over them.
    let later = read(r#"[{"name":"x","from":{"thicket":1},"paint":[]}]"#).expect("a document");
    assert!(later.illustration().recipes.is_empty());
}
