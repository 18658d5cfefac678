use crate::document::{Document, Edit, Plane, mirror};
use glam::Vec3;

#[test]
fn a_curve_is_read_kept_and_bounded() {
    let with = |curve: &str| {
        Document::from_json(&format!(
            r#"{{"fabrica":1,"templates":[{{"kind":"wave","size":[0.5,0.5,0.1],"curve":{curve}}}]}}"#
        ))
    };
    let drawn = |curve: &str| with(curve).expect(curve).illustration().templates[0].clone();
    let lines = |curve: &str| {
        let document = with(curve).expect(curve);
        let notices = document.notices().iter();
        notices.map(ToString::to_string).collect::<Vec<_>>()
    };
    let dome = r#"{"points":[[0,0.5],[0.5,1],[1,0.5]],"spline":true}"#;
    let document = with(dome).expect("a curve");
    assert!(document.notices().is_empty(), "{:?}", document.notices());
    assert_eq!(
        document.to_json_compact(),
        r#"{"fabrica":1,"templates":[{"kind":"wave","size":[0.5,0.5,0.1],"curve":{"points":[[0,0.5],[0.5,1],[1,0.5]]}}]}"#
    );
    assert!(drawn(dome).curve.is_some_and(|curve| curve.is_spline));
    // Nothing is nothing, and is left out.
    for empty in ["{}", r#"{"points":[]}"#] {
        assert_eq!(drawn(empty).curve, None);
        assert!(
            !with(empty)
                .expect("a document")
                .to_json_compact()
                .contains("curve")
        );
    }
    // What has another shape is refused by its place.
    for (curve, place) in [
        ("3", "/templates/0/curve"),
        (r#"{"points":3}"#, "/templates/0/curve/points"),
        (r#"{"points":[[0,1],[1]]}"#, "/templates/0/curve/points/1"),
        (
            r#"{"points":[[0,1],[1,"x"]]}"#,
            "/templates/0/curve/points/1/1",
        ),
        (
            r#"{"points":[[0,1],[1,1e999]]}"#,
            "/templates/0/curve/points/1/1",
        ),
        (
            r#"{"points":[[0,1],[1,1]],"spline":1}"#,
            "/templates/0/curve/spline",
        ),
    ] {
        let error = with(curve).expect_err(curve).to_string();
        assert!(error.contains(place), "{curve}: {error}");
    }
    // What cannot be bent is named and drawn straight.
    let many = format!(r#"{{"points":[{}[1,1]]}}"#, "[0,1],[0.5,1.1],".repeat(5000));
    for (curve, word) in [
        (r#"{"points":[[0,1]]}"#, "two points"),
        (r#"{"points":[[0.5,1],[0.5,1],[0.5,1]]}"#, "two points"),
        (
            r#"{"points":[[0,1],[1,1],[0,1]],"spline":false}"#,
            "turns back",
        ),
        (many.as_str(), "first 9"),
        (r#"{"points":[[0,1],[1e30,-1e30]]}"#, "outside the range"),
    ] {
        let lines = lines(curve).join("; ");
        assert!(lines.contains(word), "{lines}");
        assert!(lines.contains("/templates/0/curve/points"), "{lines}");
        let template = drawn(curve);
        assert!(template.subject_from_template(Vec3::splat(0.3)).is_finite());
    }
    assert!(
        drawn(r#"{"points":[[0,1],[1,1],[0,1]],"spline":false}"#)
            .bent()
            .is_none()
    );
    let gentle = r#"{"points":[[0,0.9],[0.5,1],[1,0.9]]}"#;
    assert!(lines(gentle).is_empty(), "{:?}", lines(gentle));
    let folded = r#"{"points":[[0.45,0.2],[0.5,1],[0.55,0.2]]}"#;
    assert!(
        lines(folded)[0].contains("more sharply"),
        "{:?}",
        lines(folded)
    );
}

#[test]
fn a_curve_is_edited_mirrored_and_eased() {
    let document = Document::from_json(
        r#"{"fabrica":1,"templates":[{"kind":"poke","at":[0.2,0,0],"curve":{"points":[[0,0.5],[0.4,1],[1,0.8]]}},{"kind":"peel"}],
            "steps":[{"set":{"/templates/0/curve/points/1/1":1.4}},{"set":{"/templates/1/curve":{"points":[[0,0.6],[1,1]]}}}]}"#,
    )
    .expect("a document");
    let half = document.at_time(1, 0.5).expect("half of the way");
    let points = &half.templates[0].curve.as_ref().expect("a curve").points;
    assert!((points[1].y - 1.2).abs() < 1e-6, "{points:?}");
    let half = document.at_time(2, 0.5).expect("half of the way");
    let points = &half.templates[1].curve.as_ref().expect("a curve").points;
    assert!(
        (points[0].y - 0.8).abs() < 1e-6,
        "from straight: {points:?}"
    );

    let template = &document.illustration().templates[0];
    let edits = mirror(template, Plane::Sagittal, true);
    let copied = edits
        .iter()
        .try_fold(document.clone(), |d, edit| edit.apply(&d));
    let copied = copied.expect("it is mirrored");
    let other = &copied.illustration().templates[1];
    for q in [
        Vec3::ZERO,
        Vec3::new(0.3, 0.4, 1.2),
        Vec3::new(1.1, 0.2, 0.6),
    ] {
        let here = template.subject_from_template(q);
        let there = other.subject_from_template(Vec3::new(1.0 - q.x, q.y, q.z));
        assert!(
            (here * Vec3::new(-1.0, 1.0, 1.0) - there).length() < 1e-3,
            "{here} {there}"
        );
    }
    let straight = Edit::SetCurve {
        template: 0,
        curve: None,
    };
    assert_eq!(straight.name(&document), "Straighten poke");
    let straight = straight.apply(&document).expect("straight");
    assert_eq!(straight.get("/templates/0/curve"), None);
    let again = Edit::SetCurve {
        template: 0,
        curve: template.curve.clone(),
    };
    let again = again.apply(&straight).expect("bent again");
    assert_eq!(again.illustration().templates[0].curve, template.curve);
}

#[test]
fn a_part_of_a_cut_lies_along_the_same_curve() {
    for shape in ["box", "sphere"] {
        let document = Document::from_json(&format!(
            r#"{{"fabrica":1,"templates":[{{"kind":"cut","amount":0.4,"params":{{"shape":"{shape}"}},"size":[0.6,0.3,0.2],
                "curve":{{"points":[[0,0.6],[0.5,1],[1,0.7]]}}}}]}}"#
        ))
        .expect("a document");
        let whole = &document.illustration().templates[0];
        let part = whole.acting();
        for own in [Vec3::new(0.2, 0.3, 0.4), Vec3::new(0.9, 0.1, 1.0)] {
            // The same place of the box, in the smaller one.
            let inner = match shape {
                "box" => Vec3::new(own.x, own.y, 1.0 + (own.z - 1.0) / 0.4),
                _ => 0.5 + (own - 0.5) / 0.4,
            };
            let (a, b) = (
                whole.subject_from_template(own),
                part.subject_from_template(inner),
            );
            assert!((a - b).length() < 1e-5, "{shape}: {a} {b}");
        }
    }
}
