//! Pictures of the page beside pictures of the native program.

use super::*;

/// The same document drawn by the page and by the native program under lavapipe.
#[test]
fn browser_draws_what_the_native_program_draws() {
    const SIZE: [u32; 2] = [160, 120];
    const RESOLUTION: u32 = 64;
    const SAMPLES: u32 = 4;
    let mut documents: Vec<(String, String)> = TemplateKind::FORMULAS
        .iter()
        .map(|kind| {
            let name = kind.spec().name;
            let text = format!(
                r#"{{"fabrica":1,"subject":{{"builtin":"cube"}},"templates":[{{"kind":"{name}","at":[0,0.1,0.1],"size":[0.8,0.7,0.9]}}],"camera":{{"rotate":[0.3,0.2,0.1,0.92]}}}}"#
            );
            (name.to_owned(), text)
        })
        .collect();
    let four = r#"{"fabrica":1,"subject":{"builtin":"head"},"templates":[{"kind":"twist","size":[1,1,1],"params":{"angle":0.4}},{"kind":"peel","at":[0,0.1,0.3],"size":[0.5,0.4,0.2]},{"kind":"retractor","at":[0.1,0.2,0],"rotate":[-0.7,0,0,0.7],"size":[0.4,0.4,0.3]},{"kind":"slices","size":[0.9,0.9,0.9],"params":{"count":3}}]}"#;
    documents.push(("four".to_owned(), four.to_owned()));
    with_browser(BrowserGpu::Software, |session| async move {
        let tab = session.open("#").await;
        tab.wait_until("window.fabrica?.viewer !== undefined", 120)
            .await;
        tab.eval::<bool>("(window.fabrica.viewer.destroy(), true)")
            .await;
        let gpu = Gpu::open(&GpuOptions {
            adapter: None,
            is_strict: true,
        })
        .await
        .expect("a Vulkan device, lavapipe is enough");
        println!("native: {} {}", gpu.info.name, gpu.info.driver_info);
        let folder = harness::root().join("target/e2e/compared");
        std::fs::create_dir_all(&folder).expect("a folder for pictures");
        let (mut worst, mut faults) = ((0.0, 0), Vec::new());
        let mut first_picture = None;
        let mut studio = None;
        for (name, text) in &documents {
            let quoted = serde_json::to_string(text).expect("text");
            let script = format!(
                "window.fabrica.module.render_png({quoted},{},{},{SAMPLES},{RESOLUTION}).then(b => btoa(Array.from(b, c => String.fromCharCode(c)).join('')))",
                SIZE[0], SIZE[1]
            );
            let page = image::load_from_memory(&from_base64(&tab.eval::<String>(&script).await))
                .expect("a PNG")
                .to_rgba8();
            let document = Document::from_json(text).expect("a good document");
            let subject = if name == "four" { "head" } else { "cube" };
            if studio.as_ref().is_none_or(|(held, _)| *held != subject) {
                let mut builder = fabrica::data::VolumeBuilder::new();
                fabrica::subjects::generate(subject, RESOLUTION, &mut builder).expect("a subject");
                let volume = builder.finish().expect("a whole volume");
                let made = Studio::new(&gpu, &volume.into(), true).expect("the subject fits");
                studio = Some((subject, made));
            }
            let (_, held) = studio.as_ref().expect("just made");
            let image = held
                .render_image(document.illustration(), SIZE, SAMPLES)
                .await
                .expect("a native picture");
            let native = image::RgbaImage::from_raw(SIZE[0], SIZE[1], image.rgba).expect("whole");
            for (side, picture) in [("page", &page), ("native", &native)] {
                picture
                    .save(folder.join(format!("{name}_{side}.png")))
                    .expect("saved");
            }
            let found = difference(&page, &native, WHITE);
            println!("{name}: {found:?}");
            if found.count < 1500 {
                faults.push(format!("{name}: only {} pixels are drawn", found.count));
            }
            if found.mean > 2.0 || found.percentile > 8 {
                faults.push(format!("{name}: {found:?}"));
            }
            worst = (
                f64::max(worst.0, found.mean),
                u8::max(worst.1, found.percentile),
            );
            // The negative control: another template is another picture.
            if let Some(other) = &first_picture {
                let apart = difference(other, &native, WHITE);
                if apart.mean <= 2.0 && apart.percentile <= 8 {
                    faults.push(format!(
                        "{name} looks like {}: the test sees nothing",
                        documents[0].0
                    ));
                }
            } else {
                first_picture = Some(native);
            }
        }
        println!(
            "worst mean {:.3}, worst 99.9th percentile {}",
            worst.0, worst.1
        );
        assert!(faults.is_empty(), "{}", faults.join("\n"));
    });
}
