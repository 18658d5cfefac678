//! The quick picture and the finished one agree in light and opacity: tiles that are finished while their neighbours
//! are not do not stand out.

use crate::data::data_folder;
use crate::gpu::{builtin, open_software};
use crate::scans::read_volume_at;
use fabrica::data::{Subject, VolumeBuilder};
use fabrica::document::{Document, Illustration};
use fabrica::load::{LoadReport, ReadOptions};
use fabrica::render::{Image, Renderer, system_clock};

/// Side of the pictures, pixels.
const SIDE: u32 = 224;
/// Largest difference of the means over the object, levels of 255.
const BOUND: f64 = 3.0;

fn illustration(json: &str) -> Illustration {
    let document = Document::from_json(json).expect("a valid document");
    document.illustration().clone()
}

/// The quick picture as small as it gets, the quick picture in full resolution, and the finished one.
fn pictures(subject: &Subject, scene: &Illustration) -> [Image; 3] {
    let read = |renderer: &Renderer| pollster::block_on(renderer.read_output()).expect("a picture");
    let quick = |budget: f32| {
        let mut renderer = Renderer::new(open_software(), system_clock);
        renderer.set_subject(subject.clone()).expect("it fits");
        renderer.set_illustration(scene);
        for _ in 0..20_000 {
            let state = renderer.draw([SIDE; 2], budget, true).expect("it is drawn");
            if state.has_picture {
                let image = read(&renderer);
                return (renderer, image);
            }
        }
        panic!("no picture comes");
    };
    // A pixel is guessed to take 2.5 µs before any is measured.
    let (_, coarse) = quick(1e-3);
    let (mut renderer, full) = quick(10.0);
    for _ in 0..20_000 {
        let state = renderer.draw([SIDE; 2], 0.2, false).expect("it is drawn");
        if state.is_done {
            return [coarse, full, read(&renderer)];
        }
        std::thread::sleep(std::time::Duration::from_millis(2));
    }
    panic!("drawing does not end");
}

/// Means of red, green, blue and opacity over the object: pixels around which the finished picture has something
/// everywhere within the reach of a pixel of the smallest picture, so that the blurred outline does not count.
fn means(image: &Image, finished: &Image) -> [f64; 4] {
    const REACH: i64 = 8;
    let side = i64::from(SIDE);
    let alpha = |x: i64, y: i64| {
        let inside = (0..side).contains(&x) && (0..side).contains(&y);
        if inside {
            finished.rgba[(4 * (y * side + x) + 3) as usize]
        } else {
            0
        }
    };
    let (mut sum, mut count) = ([0.0; 4], 0.0);
    for y in 0..side {
        for x in 0..side {
            let around = [-REACH, 0, REACH];
            let is_object = around
                .iter()
                .all(|dy| around.iter().all(|dx| alpha(x + dx, y + dy) > 2));
            if is_object {
                let at = (4 * (y * side + x)) as usize;
                for (sum, byte) in sum.iter_mut().zip(&image.rgba[at..at + 4]) {
                    *sum += f64::from(*byte);
                }
                count += 1.0;
            }
        }
    }
    assert!(count > 2_000.0, "{count} pixels of the object");
    sum.map(|sum| sum / count)
}

fn compare(name: &str, subject: &Subject, json: &str) -> f64 {
    let scene = illustration(json);
    let [coarse, full, fine] = pictures(subject, &scene);
    if let Some(folder) = std::env::var_os("FABRICA_LOOK_AT") {
        for (image, what) in [(&coarse, "coarse"), (&full, "full"), (&fine, "fine")] {
            let png = fabrica::render::encode_png(image).expect("a PNG");
            let name = format!("coarse_{}_{what}.png", name.replace(' ', "_"));
            std::fs::write(std::path::Path::new(&folder).join(name), png).expect("written");
        }
    }
    let of_fine = means(&fine, &fine);
    let mut worst = 0.0_f64;
    for (image, what) in [(&coarse, "small"), (&full, "full size")] {
        let of_quick = means(image, &fine);
        let by: Vec<f64> = (0..4).map(|i| of_quick[i] - of_fine[i]).collect();
        println!("{name}, quick at {what}: {by:.2?} of {of_fine:.0?}");
        worst = by.iter().fold(worst, |worst, by| worst.max(by.abs()));
    }
    worst
}

/// Transfer functions over the values of a scan: opaque tissue, and skin that lets half of the light through.
fn looks(air: f64, soft: f64, hard: f64) -> [(&'static str, String); 3] {
    let points = |list: &[(f64, &str, f64)]| {
        let list: Vec<String> = list
            .iter()
            .map(|(value, color, opacity)| {
                format!(r#"{{ "value": {value}, "color": "{color}", "opacity": {opacity} }}"#)
            })
            .collect();
        format!(
            r#""look": {{ "background": "none", "transfer": [{}] }}"#,
            list.join(", ")
        )
    };
    [
        (
            "opaque",
            points(&[
                (air, "#c08060", 0.0),
                (soft, "#c08060", 0.9),
                (hard, "#f0e8d8", 1.0),
            ]),
        ),
        (
            "half",
            points(&[
                (air, "#c08060", 0.0),
                (soft, "#c08060", 0.08),
                (hard, "#f0e8d8", 0.9),
            ]),
        ),
        (
            "haze",
            points(&[
                (air, "#c08060", 0.0),
                (soft, "#c08060", 0.02),
                (hard, "#f0e8d8", 0.06),
            ]),
        ),
    ]
}

fn check(found: &[(String, f64)]) {
    for (name, worst) in found {
        println!("{name}: {worst:.2}");
    }
    for (name, worst) in found {
        assert!(*worst <= BOUND, "{name}: {worst:.2} levels of 255");
    }
}

#[test]
fn coarse_and_fine_agree_on_the_head() {
    let subject = Subject::from(builtin("head", 256));
    let peel = r#""templates": [ { "kind": "peel", "at": [0.02,0.24,0.2],
        "rotate": [0,0.7071,0.7071,0], "size": [0.36,0.3,0.2], "params": { "progress": 0.6 } } ]"#;
    let mut found = Vec::new();
    for (look, json) in looks(-300.0, 40.0, 900.0) {
        let name = format!("head {look}");
        let worst = compare(&name, &subject, &format!(r#"{{ "fabrica": 1, {json} }}"#));
        found.push((name, worst));
    }
    for (name, look) in [
        ("head own", r#""look": { "background": "none" }"#),
        (
            "head edges",
            r#""look": { "background": "none", "gradient": 1 }"#,
        ),
    ] {
        let worst = compare(name, &subject, &format!(r#"{{ "fabrica": 1, {look} }}"#));
        found.push((name.to_owned(), worst));
    }
    let worst = compare(
        "head peeled",
        &subject,
        &format!(r#"{{ "fabrica": 1, "look": {{ "background": "none" }}, {peel} }}"#),
    );
    found.push(("head peeled".to_owned(), worst));
    check(&found);
}

/// A scan under the examples' folder of CT.
fn scan(folder: &std::path::Path, name: &str) -> Subject {
    let mut builder = VolumeBuilder::new();
    let path = folder.join("ct").join(name);
    let (options, mut report) = (ReadOptions::default(), LoadReport::default());
    read_volume_at(&path, &options, &mut builder, &mut report).expect("a readable scan");
    Subject::from(builder.finish().expect("a whole volume"))
}

#[test]
fn coarse_and_fine_agree_on_a_scan() {
    let Some(folder) = data_folder("coarse::coarse_and_fine_agree_on_a_scan") else {
        return;
    };
    let subject = scan(&folder, "chest_ct_2mm.nii.gz");
    let mut found = Vec::new();
    for (look, json) in looks(-600.0, 0.0, 500.0) {
        let name = format!("chest {look}");
        let worst = compare(&name, &subject, &format!(r#"{{ "fabrica": 1, {json} }}"#));
        found.push((name, worst));
    }
    let own = r#"{ "fabrica": 1, "look": { "background": "none", "transfer": "ct-muscle-bone" } }"#;
    found.push((
        "chest preset".to_owned(),
        compare("chest preset", &subject, own),
    ));
    // Its noise is strong: gradients that see more of it make the skin darker.
    let noisy = scan(&folder, "head_ct_headsq.nii.gz");
    let own = r#"{ "fabrica": 1, "look": { "background": "none" } }"#;
    found.push(("noisy head".to_owned(), compare("noisy head", &noisy, own)));
    check(&found);
}
