//! Segments drawn as bodies of their own: solid, hidden, seen through; with the grid as without it, and from links.

use crate::gpu::{builtin, gpu, studio_of};
use fabrica::document::Document;
use fabrica::link;
use fabrica::render::{Gpu, Image, Studio};

const SIZE: [u32; 2] = [96, 96];

fn studios(gpu: &Gpu) -> [Studio; 2] {
    let volume = builtin("bar", 48);
    [true, false].map(|grid| studio_of(gpu, &volume, grid))
}

/// The bar with this look of its segments; its values alone show nothing if `is_clear`.
fn document(segments: &str, templates: &str, is_clear: bool) -> Document {
    let transfer = match is_clear {
        true => r##""transfer":[{"value":-5000,"opacity":0},{"value":5000,"opacity":0}],"##,
        false => "",
    };
    let json = format!(
        r#"{{"fabrica":1,"subject":{{"builtin":"bar"}},"templates":[{templates}],"look":{{{transfer}"segments":{{{segments}}}}}}}"#
    );
    Document::from_json(&json).expect("a valid document")
}

fn drawn(studio: &Studio, document: &Document) -> Image {
    pollster::block_on(studio.render_image(document.illustration(), SIZE, 2)).expect("a picture")
}

/// Pixels that are not paper, and their mean color.
fn seen(image: &Image) -> (usize, [f32; 3]) {
    let (mut count, mut sum) = (0, [0.0; 3]);
    for pixel in image.rgba.chunks_exact(4) {
        if pixel[..3].iter().any(|&c| c < 250) {
            count += 1;
            for (sum, &c) in sum.iter_mut().zip(pixel) {
                *sum += f32::from(c);
            }
        }
    }
    (count, sum.map(|s| s / count.max(1) as f32))
}

fn largest_difference(a: &Image, b: &Image) -> u8 {
    let pairs = a.rgba.iter().zip(&b.rgba);
    pairs.map(|(a, b)| a.abs_diff(*b)).max().unwrap_or(0)
}

#[test]
fn bodies_are_seen_whatever_their_values_are() {
    let [with_grid, without] = studios(gpu());
    let nothing = drawn(&with_grid, &document("", "", true));
    assert_eq!(seen(&nothing).0, 0, "the values alone show nothing");

    // The core alone: green, and the same with the grid as without it, also where a template moves it.
    let core = r##""core":{"opacity":1,"color":"#20c030"}"##;
    for templates in [
        "",
        r#"{"kind":"twist","size":[1,1,1],"params":{"angle":0.6}},{"kind":"split","size":[0.6,0.6,0.6]}"#,
    ] {
        let scene = document(core, templates, true);
        let image = drawn(&with_grid, &scene);
        let (count, [r, g, b]) = seen(&image);
        assert!(count > 60, "the core is seen: {count} pixels");
        assert!(g > 1.4 * r && g > 1.4 * b, "it is green: {r} {g} {b}");
        // Rays that graze the surface start their steps elsewhere with the grid, which a few pixels show; a cell left
        // out would be a hole.
        let plain = drawn(&without, &scene);
        let pairs = image.rgba.iter().zip(&plain.rgba);
        let apart = pairs.filter(|(a, b)| a.abs_diff(**b) > 64).count();
        let (other, _) = seen(&plain);
        assert!(
            apart <= 12 && count.abs_diff(other) * 50 <= count,
            "the grid leaves nothing out: {apart} values apart, {count} and {other} pixels"
        );
    }

    // Hidden, the shell bares the core; half seen through, it lies over it.
    let whole = seen(&drawn(&with_grid, &document("", "", false)));
    let red = r##""core":{"color":"#e01010"}"##;
    let bare = drawn(
        &with_grid,
        &document(&format!(r#"{red},"shell":0"#), "", false),
    );
    let (count, [r, g, _]) = seen(&bare);
    assert!(
        count > 60 && count < whole.0,
        "less than the whole bar is left: {count} of {}",
        whole.0
    );
    assert!(r > 1.5 * g, "and that is the red core: {r} {g}");
    let veiled = drawn(
        &with_grid,
        &document(&format!(r#"{red},"shell":0.3"#), "", false),
    );
    let (veiled_count, [veiled_r, veiled_g, _]) = seen(&veiled);
    assert!(veiled_count > count, "the shell is there");
    assert!(
        veiled_r / veiled_g < r / g,
        "and lies over the core: {veiled_r} {veiled_g}"
    );
}

/// Negative control of the rest: a look that names no segment changes nothing; nor does one that is taken back.
#[test]
fn a_look_of_nothing_changes_nothing() {
    let [studio, _] = studios(gpu());
    let plain = drawn(&studio, &document("", "", false));
    let unknown = drawn(&studio, &document(r#""horn":1"#, "", false));
    assert_eq!(largest_difference(&plain, &unknown), 0);
    let solid = drawn(&studio, &document(r#""shell":1"#, "", false));
    assert!(
        largest_difference(&plain, &solid) > 20,
        "a solid shell is seen"
    );
}

/// A scene that has drawn other bodies before draws as one that has not: nothing of what they filled is left.
#[test]
fn bodies_leave_nothing_behind() {
    let [studio, _] = studios(gpu());
    let twist = r#"{"kind":"twist","size":[1,1,1],"params":{"angle":0.6}}"#;
    for segments in [
        r##""shell":{"opacity":1,"color":"#2030e0"}"##,
        r##""core":{"opacity":1,"color":"#20c030"}"##,
        "",
        r#""shell":0.4"#,
    ] {
        let shown = document(segments, twist, true);
        let [fresh, _] = studios(gpu());
        let (after, expected) = (drawn(&studio, &shown), drawn(&fresh, &shown));
        assert_eq!(largest_difference(&after, &expected), 0, "{segments}");
        assert_eq!(seen(&expected).0 == 0, segments.is_empty(), "{segments}");
    }
}

#[test]
fn looks_of_segments_survive_the_link() {
    let json = r##"{"fabrica":1,"subject":{"builtin":"bar"},"look":{"segments":{"a/b":0.25,"core":{"color":"#20c030","opacity":0.5},"shell":0}},"steps":[{"set":{"/look/segments/shell":1}}]}"##;
    let document = Document::from_json(json).expect("a valid document");
    assert!(document.notices().is_empty(), "{:?}", document.notices());
    let again = link::decode(&link::encode(&document))
        .expect("a link")
        .document;
    assert_eq!(again.to_json_compact(), json);
    let looks = &again.illustration().look.segments;
    let found: Vec<_> = looks.iter().map(|l| (l.name.as_str(), l.opacity)).collect();
    assert_eq!(found, [("a/b", 0.25), ("core", 0.5), ("shell", 0.0)]);
    // Hostile: wrong types name their place, numbers are brought into their range and said.
    let wrong = Document::from_json(r#"{"fabrica":1,"look":{"segments":{"core":"solid"}}}"#);
    let message = wrong.expect_err("no number").to_string();
    assert!(message.contains("/look/segments/core"), "{message}");
    let much = Document::from_json(r#"{"fabrica":1,"look":{"segments":{"core":7}}}"#);
    let much = much.expect("clamped");
    assert_eq!(much.illustration().look.segments[0].opacity, 1.0);
    assert_eq!(much.notices().len(), 1, "{:?}", much.notices());
}
