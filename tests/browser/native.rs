//! Pictures of the page beside pictures of the native program.

use super::harness::{Session, Tab};
use super::server::Server;
use super::surfaces::{surface_of, surface_within};
use super::*;
use fabrica::data::{
    FieldSamples, Grid, Resources, Subject, SubjectPart, SubjectSink, Surface, Volume,
    VolumeBuilder,
};
use fabrica::document::{
    Illustration, Lesson, ObjectSource, STYLE_PRESETS, SubjectRef, TemplateData,
};
use fabrica::load::{FieldUse, FileSet, LoadReport, MemoryFiles, OneFile, read_field};
use fabrica::shell::clays::{ClayDesk, surface_of_clay};
use fabrica::subjects::{FINE_RESOLUTION, Generator, tool};
use glam::DVec3;
use image::RgbaImage;
use serde_json::{Value, json};
use sha2::{Digest as _, Sha256};
use std::collections::BTreeMap;
use std::f64::consts::FRAC_1_SQRT_2;
use std::sync::Arc;

/// Samples of a pixel as the viewer draws it.
const SAMPLES: u32 = 4;
/// Pixels beside each other that differ by so much (255ths) lie at a silhouette or at the border of two colours.
const SILHOUETTE: u8 = 24;

/// How finely both sides draw.
#[derive(Clone, Copy)]
struct Fineness {
    size: [u32; 2],
    /// Voxels along the longest side of a built-in subject.
    resolution: u32,
    samples: u32,
    /// How far colours may be apart at one of a thousand pixels, 255ths.
    apart: u8,
}

/// Of the many cases that are drawn for comparison alone.
const COARSE: Fineness = Fineness {
    size: [112, 84],
    resolution: 64,
    samples: 2,
    apart: 8,
};
/// Of documents about thin tissue: coarser voxels make crumbs of it, and each side draws those that a ray just touches.
/// Where a silhouette goes through a pixel, one ray of the eight may still meet the tissue on one side alone.
const FINE: Fineness = Fineness {
    size: [160, 120],
    resolution: FINE_RESOLUTION,
    samples: 8,
    apart: 255 / 8,
};

/// A document that both sides draw.
struct Case {
    name: String,
    document: Value,
    /// Pointers to what the case is about: without it the picture is another.
    about: &'static [&'static str],
}

fn case(name: &str, about: &'static [&'static str], rest: Value) -> Case {
    let mut document = rest;
    document["fabrica"] = json!(1);
    Case {
        name: name.to_owned(),
        document,
        about,
    }
}

/// A template of each kind that its parameters describe, and four together.
fn kinds() -> Vec<Case> {
    let mut cases: Vec<Case> = TemplateKind::FORMULAS
        .iter()
        .map(|kind| {
            let name = kind.spec().name;
            let template = json!({ "kind": name, "at": [0, 0.1, 0.1], "size": [0.8, 0.7, 0.9] });
            let rest = json!({
                "subject": { "builtin": "cube" },
                "templates": [template],
                "camera": { "rotate": [0.3, 0.2, 0.1, 0.92] },
            });
            case(name, &["/templates/0"], rest)
        })
        .collect();
    cases.push(case(
        "four",
        &[
            "/templates/0",
            "/templates/1",
            "/templates/2",
            "/templates/3",
        ],
        json!({
            "subject": { "builtin": "head" },
            "templates": [
                { "kind": "twist", "size": [1, 1, 1], "params": { "angle": 0.4 } },
                { "kind": "peel", "at": [0, 0.1, 0.3], "size": [0.5, 0.4, 0.2] },
                { "kind": "retractor", "at": [0.1, 0.2, 0], "rotate": [-0.7, 0, 0, 0.7], "size": [0.4, 0.4, 0.3] },
                { "kind": "slices", "size": [0.9, 0.9, 0.9], "params": { "count": 3 } },
            ],
        }),
    ));
    cases
}

/// What templates and looks have besides: control points, tools, drawn lines, curves, kept tissue, constraints, bodies,
/// and opacity by gradient with its correction at cuts.
fn besides() -> Vec<Case> {
    let above = json!({ "rotate": [0.3, 0.2, 0.1, 0.92] });
    vec![
        case(
            "rbf",
            &[
                "/templates/0",
                "/templates/0/params/edge",
                "/templates/0/params/cut",
            ],
            json!({
                "subject": { "builtin": "cube" },
                "templates": [{ "kind": "rbf", "at": [0, 0.1, 0.1], "size": [1, 1, 1], "params": {
                    "points": [
                        { "at": [0.7, 0.8, 0.7], "move": [0.1, 0, -0.2] },
                        { "at": [0.2, 0.5, 0.8], "move": [0, 0.1, 0.15] },
                    ],
                    "softness": 0.3,
                    "edge": 0.2,
                    "cut": [[0.45, 0], [0.5, 1]],
                } }],
                "camera": above,
            }),
        ),
        // A ball and its image act together, the ellipsoid alone on either side.
        case(
            "sweep",
            &[
                "/templates/0/params/mirror",
                "/templates/0/params/tools/0",
                "/templates/0/params/tools/1",
            ],
            json!({
                "subject": { "builtin": "cube" },
                "templates": [{ "kind": "sweep", "at": [0, 0, 0.2], "size": [0.8, 0.8, 0.8], "params": { "mirror": "x", "tools": [
                    { "radius": 0.12, "coat": 0.12, "path": [[0.25, 0.5, 1.1], [0.3, 0.5, 0.9]] },
                    { "shape": "ellipsoid", "radii": [0.12, 0.08, 0.08], "coat": 0.1, "path": [[0.7, 0, 0.8], { "at": [0.7, -0.05, 1.05], "rotate": [0, 0, 0.4, 0.9165] }] },
                ] } }],
                "camera": above,
            }),
        ),
        case(
            "curve",
            &["/templates/0", "/templates/0/curve"],
            json!({
                "subject": { "builtin": "cube" },
                "templates": [{
                    "kind": "peel", "at": [0, 0, 0.28], "size": [0.9, 0.7, 0.5],
                    "curve": { "points": [[0.02, 0.7], [0.35, 0.95], [0.65, 0.75], [0.98, 0.95]] },
                    "params": { "depth": 0.3, "progress": 0.6, "radius": 0.12 },
                }],
                "camera": above,
            }),
        ),
        // Both halves of the bar are cut open: down to the core, and down to a depth.
        case(
            "alignment",
            &["/templates/0/align", "/templates/1/align"],
            json!({
                "subject": { "builtin": "bar" },
                "templates": [
                    { "kind": "cut", "at": [0, 0.25, 0.1], "size": [0.5, 0.3, 0.3], "align": { "to": "segment", "keep": ["core"] } },
                    { "kind": "cut", "at": [0, -0.25, 0.1], "size": [0.5, 0.3, 0.3], "align": { "to": "surface", "depth": 0.05 } },
                ],
                "camera": { "rotate": [0.35, 0.2, 0.4, 0.82], "distance": 2 },
            }),
        ),
        // Three stretches of the bar, each with another constraint, in a look that lets the core be seen.
        case(
            "constraints",
            &[
                "/templates/0/constrain",
                "/templates/1/constrain",
                "/templates/2/constrain",
            ],
            json!({
                "subject": { "builtin": "bar" },
                "templates": [
                    { "kind": "pull", "at": [0, 0.32, 0], "size": [0.4, 0.28, 0.4], "constrain": { "by": "displacement", "keep": ["core"] } },
                    { "kind": "twist", "at": [0, 0, 0], "size": [0.4, 0.4, 0.28], "rotate": [FRAC_1_SQRT_2, 0, 0, FRAC_1_SQRT_2], "constrain": { "by": "coordinate", "keep": ["core"] } },
                    { "kind": "pull", "at": [0, -0.32, 0], "size": [0.4, 0.28, 0.4], "constrain": { "by": "rigid", "keep": ["core"] } },
                ],
                "look": { "segments": { "core": 1, "shell": 0.3 } },
                "camera": { "rotate": [0.35, 0.2, 0.4, 0.82], "distance": 2 },
            }),
        ),
        case(
            "bodies",
            &["/look/segments/core", "/look/segments/shell"],
            json!({
                "subject": { "builtin": "bar" },
                "templates": [{ "kind": "split", "at": [0, 0.1, 0], "size": [0.6, 0.6, 0.6] }],
                "look": { "segments": { "core": { "opacity": 1, "color": "#20c030" }, "shell": 0.3 } },
                "camera": { "rotate": [0.35, 0.2, 0.4, 0.82], "distance": 2 },
            }),
        ),
        case(
            "style",
            &["/look/style"],
            json!({
                "subject": { "builtin": "bar" },
                "templates": [{ "kind": "split", "at": [0, 0.1, 0], "size": [0.6, 0.6, 0.6] }],
                "look": { "style": { "preset": "ink", "stipple": { "spacing": 12, "size": 4 }, "ghost": { "by": "cut", "strength": 0.6 } } },
                "camera": { "rotate": [0.35, 0.2, 0.4, 0.82], "distance": 2 },
            }),
        ),
        case(
            "edges",
            &["/look/gradient", "/templates/0", "/templates/1"],
            json!({
                "subject": { "builtin": "cube" },
                "templates": [
                    { "kind": "split", "at": [0, 0.1, 0.2], "size": [1, 1, 0.8] },
                    { "kind": "cut", "at": [0.4, 0.3, 0.4], "size": [0.4, 0.6, 0.4] },
                ],
                "look": { "gradient": 0.8 },
                "camera": above,
            }),
        ),
    ]
}

/// Every style that has a name.
fn styles() -> impl Iterator<Item = Case> {
    STYLE_PRESETS.iter().map(|preset| {
        case(
            preset.name,
            &["/look/style"],
            json!({
                "subject": { "builtin": "bar" },
                "templates": [{ "kind": "split", "at": [0, 0.1, 0], "size": [0.6, 0.6, 0.6] }],
                "look": { "style": preset.name },
                "camera": { "rotate": [0.35, 0.2, 0.4, 0.82], "distance": 2 },
            }),
        )
    })
}

/// The same document without what stands at a pointer.
fn without(document: &Value, pointer: &str) -> Value {
    let mut plain = document.clone();
    let (parent, last) = pointer.rsplit_once('/').expect("a pointer");
    match plain.pointer_mut(parent) {
        Some(Value::Array(list)) => {
            list.remove(last.parse().expect("an index"));
        }
        Some(Value::Object(map)) => {
            map.remove(last).expect("it is there");
        }
        _ => panic!("nothing is at {pointer}"),
    }
    plain
}

/// What was found so far.
struct Findings {
    how: Fineness,
    worst: (f64, u8),
    faults: Vec<String>,
}

impl Findings {
    fn new(how: Fineness) -> Self {
        Self {
            how,
            worst: (0.0, 0),
            faults: Vec::new(),
        }
    }

    /// Compares the two sides, and the native one with what it would be without what the case is about.
    fn compare(
        &mut self,
        name: &str,
        page: &RgbaImage,
        native: &RgbaImage,
        plain: &[(&str, RgbaImage)],
    ) {
        let folder = harness::root().join("target/e2e/compared");
        std::fs::create_dir_all(&folder).expect("a folder for pictures");
        for (side, picture) in [("page", page), ("native", native)] {
            picture
                .save(folder.join(format!("{name}_{side}.png")))
                .expect("saved");
        }
        let found = difference(page, native, WHITE);
        println!("{name}: {found:?}");
        if found.count < 1500 {
            self.faults
                .push(format!("{name}: only {} pixels are drawn", found.count));
        }
        if found.mean > 2.0 || found.percentile > self.how.apart {
            self.faults.push(format!("{name}: {found:?}"));
        }
        self.worst.0 = self.worst.0.max(found.mean);
        self.worst.1 = self.worst.1.max(found.percentile);
        for (pointer, plain) in plain {
            let apart = difference(plain, native, WHITE);
            if apart.mean <= 2.0 && apart.percentile <= self.how.apart {
                self.faults.push(format!(
                    "{name} looks the same without {pointer}: the test sees nothing"
                ));
            }
        }
    }

    /// Fails if the sides differ.
    fn tell(&self) {
        let Self { worst, faults, .. } = self;
        println!(
            "worst mean {:.3}, worst 99.9th percentile {}",
            worst.0, worst.1
        );
        assert!(faults.is_empty(), "{}", faults.join("\n"));
    }
}

/// The native side.
struct Native {
    gpu: Gpu,
    /// The last subject, by name, revision and resolution.
    held: Option<((String, u32, u32), Studio, Grid)>,
    /// Pictures by their documents: without what it is about, many a case is the same.
    drawn: BTreeMap<String, RgbaImage>,
}

impl Native {
    async fn open() -> Self {
        let options = GpuOptions {
            adapter: None,
            is_strict: true,
        };
        let gpu = Gpu::open(&options).await;
        let gpu = gpu.expect("a Vulkan device, lavapipe is enough");
        println!("native: {} {}", gpu.info.name, gpu.info.driver_info);
        Self {
            gpu,
            held: None,
            drawn: BTreeMap::new(),
        }
    }

    fn subject(&mut self, (name, revision): (&str, u32), resolution: u32) -> (Studio, Grid) {
        let wanted = (name.to_owned(), revision, resolution);
        if self.held.as_ref().is_none_or(|(held, ..)| *held != wanted) {
            let volume = volume_of((name, revision), resolution);
            let grid = volume.grid;
            let studio = Studio::new(&self.gpu, &volume.into(), true).expect("the subject fits");
            self.held = Some((wanted, studio, grid));
        }
        let (_, studio, grid) = self.held.as_ref().expect("just made");
        (studio.clone(), *grid)
    }

    async fn draw(&mut self, document: &Value, how: Fineness) -> RgbaImage {
        let text = document.to_string();
        if let Some(image) = self.drawn.get(&text) {
            return image.clone();
        }
        let document = Document::from_json(&text).expect("a good document");
        let SubjectRef::Builtin { name, revision } = &document.illustration().subject else {
            panic!("a built-in subject: {text}")
        };
        let (studio, _) = self.subject((name, *revision), how.resolution);
        let image = drawn_by(&studio, document.illustration(), how.size, how.samples).await;
        self.drawn.insert(text, image.clone());
        image
    }

    /// The picture of a case, and those without what it is about.
    async fn draw_case(
        &mut self,
        case: &Case,
        how: Fineness,
    ) -> (RgbaImage, Vec<(&'static str, RgbaImage)>) {
        let image = self.draw(&case.document, how).await;
        let mut plain = Vec::new();
        for pointer in case.about {
            let rest = without(&case.document, pointer);
            plain.push((*pointer, self.draw(&rest, how).await));
        }
        (image, plain)
    }
}

fn volume_of((name, revision): (&str, u32), resolution: u32) -> Volume {
    let generator = Generator::of_revision(name, revision, resolution).expect("a subject");
    let mut builder = VolumeBuilder::new();
    let header = SubjectPart::header(generator.header());
    builder.take(header).expect("a header");
    for part in generator.slab(0..generator.slice_count()).into_parts() {
        builder.take(part).expect("a part");
    }
    builder.finish().expect("a whole volume")
}

pub(crate) async fn drawn(
    studio: &Studio,
    illustration: &Illustration,
    size: [u32; 2],
) -> RgbaImage {
    drawn_by(studio, illustration, size, SAMPLES).await
}

async fn drawn_by(
    studio: &Studio,
    illustration: &Illustration,
    size: [u32; 2],
    samples: u32,
) -> RgbaImage {
    let image = studio.render_image(illustration, size, samples).await;
    let image = image.expect("a native picture");
    RgbaImage::from_raw(size[0], size[1], image.rgba).expect("whole")
}

/// The bytes of a PNG that a script promises.
pub(crate) async fn promised(tab: &Tab, script: &str) -> RgbaImage {
    let script =
        format!("{script}.then(b => btoa(Array.from(b, c => String.fromCharCode(c)).join('')))");
    let png = from_base64(&tab.eval::<String>(&script).await);
    image::load_from_memory(&png).expect("a PNG").to_rgba8()
}

/// Each kind of template, drawn by the page and by the native program under lavapipe.
#[test]
fn browser_draws_kinds_as_the_native_program_does() {
    compare_cases(COARSE, kinds);
}

/// The same of what documents have besides, and of styles.
#[test]
fn browser_draws_what_else_there_is_as_the_native_program_does() {
    compare_cases(COARSE, || besides().into_iter().chain(styles()).collect());
}

/// The same of the gallery's sweeps, with all voxels where there is time; else of the one that has no thin tissue.
#[test]
fn browser_draws_the_gallerys_sweeps_as_the_native_program_does() {
    compare_cases(long_or(FINE, COARSE), || {
        let mut cases = sweeps_of_the_gallery();
        cases.retain(|case| is_long() || case.name.starts_with("growing-tumour"));
        cases
    });
}

/// Documents of the gallery whose first template is a sweep, halfway and done to the end, with all that they have
/// beside their steps.
fn sweeps_of_the_gallery() -> Vec<Case> {
    let folder = harness::root().join("web/gallery");
    let mut cases = Vec::new();
    for entry in std::fs::read_dir(folder).expect("the gallery") {
        let path = entry.expect("a file").path();
        let text = std::fs::read_to_string(&path).expect("a document");
        let mut document: Value = serde_json::from_str(&text).expect("JSON");
        if document["templates"][0]["kind"] != "sweep" {
            continue;
        }
        let name = path.file_stem().expect("a name").display().to_string();
        document.as_object_mut().expect("an object").remove("steps");
        for percent in [50, 100] {
            document["templates"][0]["params"]["progress"] = json!(f64::from(percent) / 100.0);
            let name = format!("{name} {percent}");
            cases.push(case(&name, &["/templates/0"], document.clone()));
        }
    }
    assert!(cases.len() >= 8, "four documents: {}", cases.len());
    cases
}

/// The same documents drawn by the page and by the native program.
fn compare_cases(how: Fineness, cases: fn() -> Vec<Case>) {
    with_browser(BrowserGpu::Software, move |session| async move {
        let mut native = Native::open().await;
        let mut findings = Findings::new(how);
        let tab = session
            .half_viewer(&format!("#{}", payload(PLAIN)), (300, 420))
            .await;
        tab.eval::<bool>("(window.fabrica.viewer.destroy(), true)")
            .await;
        for case in cases() {
            let text = case.document.to_string();
            let quoted = serde_json::to_string(&text).expect("text");
            let script = format!(
                "window.fabrica.module.render_png({quoted},{},{},{},{})",
                how.size[0], how.size[1], how.samples, how.resolution
            );
            // The page is asked first, and draws while the native program does.
            let (page, (image, plain)) =
                tokio::join!(promised(&tab, &script), native.draw_case(&case, how));
            findings.compare(&case.name, &page, &image, &plain);
        }
        findings.tell();
    });
}

/// A displacement field comes from a file, so that the viewer itself draws it: its picture as it is shown.
#[test]
fn a_field_is_drawn_as_the_native_program_draws_it() {
    with_browser(BrowserGpu::Software, |session| async move {
        let mut findings = Findings::new(COARSE);
        compare_field(&session, &mut Native::open().await, &mut findings).await;
        findings.tell();
    });
}

async fn compare_field(session: &Session, native: &mut Native, findings: &mut Findings) {
    let mut table = String::from("x,y,z,dx,dy,dz\n");
    for i in 0..125 {
        let at = [i % 5, i / 5 % 5, i / 25].map(|n| f64::from(n) * 25.0 - 50.0);
        table += &format!("{},{},{},0,{},0\n", at[0], at[1], at[2], 0.3 * at[0] + 15.0);
    }
    let table = table.into_bytes();
    session.server.add("nodes.csv", table.clone());
    let json = r#"{"fabrica":1,"subject":{"builtin":"cube"},"templates":[{"kind":"field","params":{"src":"nodes.csv","edge":0.1}}],"camera":{"rotate":[0.3,0.2,0.1,0.92]}}"#;
    let tab = session
        .half_viewer(&format!("#{}", payload(json)), (300, 420))
        .await;
    tab.settled().await;
    let page = promised(&tab, "window.fabrica.viewer.picture()").await;

    let (studio, grid) = native.subject(("cube", 1), FINE_RESOLUTION);
    let document = Document::from_json(json).expect("a good document");
    let illustration = document.illustration();
    let size = page.dimensions().into();
    let plain = drawn(&studio, illustration, size).await;
    let length = table.len() as u64;
    let mut file = OneFile::new("nodes.csv", &*table, Some(length));
    let field = read_field(&mut file, "nodes.csv").expect("a field");
    let given = FieldUse {
        is_subject_units: false,
        is_lps: None,
        subject: &grid,
    };
    let (samples, notices) = field.fit(&given).expect("it fits");
    println!("field: {notices:?}");
    let mut resources = Resources::default();
    let template = &illustration.templates[0];
    assert!(matches!(template.data, TemplateData::Field(_)));
    let key = fabrica::data::FieldKey::of(template).expect("it names its file");
    resources.add_field(key, FieldSamples(Arc::new(samples)));
    let studio = studio.with_resources(resources);
    let image = drawn(&studio, illustration, size).await;
    findings.compare("field", &page, &image, &[("/templates/0", plain)]);
}

/// Of the parts that run in workers only these were fetched, once each.
fn assert_only_are_fetched(server: &Server, wanted: &[&str]) {
    for part in ["clay", "subjects", "scans", "meshes", "pictures", "figures"] {
        let count = parts::count(server, &format!("fabrica_{part}_bg.wasm"));
        assert_eq!(count, usize::from(wanted.contains(&part)), "{part}");
    }
}

/// A clay is shaped in a worker by a part of its own, the only one that its link fetches; it is the clay that the
/// native program shapes.
#[test]
fn a_clay_is_drawn_as_the_native_program_draws_it() {
    with_browser(BrowserGpu::Software, |session| async move {
        let json = r#"{"fabrica":1,"subject":{"clay":{"detail":0.04,"tools":[{"radius":0.12},{"shape":"box","half":[0.1,0.05,0.1]}],
            "strokes":[{"path":[140,60,380,60,30,170],"mirror":"x"},{"tool":1,"path":[0,560,0,0,-260,40],"turns":[0,0,0,0,30,40]},
            {"path":[0,0,-420,0,30,-250,90,0,-90],"scales":[100,80,60]},{"do":"smooth","strength":80,"path":[-100,500,100,200,0,0]}]}},
            "camera":{"rotate":[0.3,0.2,0.1,0.92]}}"#;
        let link = payload(json);
        let tab = session.half_viewer(&format!("#{link}"), (300, 420)).await;
        tab.settled().await;
        assert_only_are_fetched(&session.server, &["clay"]);
        let page = promised(&tab, "window.fabrica.viewer.picture()").await;
        let size = page.dimensions().into();
        let native = Native::open().await;
        let clay_of = |text: &str| {
            let document = Document::from_json(text).expect("a good document");
            let SubjectRef::Clay(clay) = &document.illustration().subject else {
                panic!("a clay: {text}")
            };
            let made = surface_of_clay(&mut ClayDesk::default(), clay, &mut |_| true);
            let (surface, notices) = made.expect("it can be made");
            assert!(notices.is_empty(), "{notices:?}");
            (document, Subject::from(surface))
        };
        let draw = async |text: &str| {
            let (document, subject) = clay_of(text);
            let studio = Studio::new(&native.gpu, &subject, true).expect("it fits");
            drawn(&studio, document.illustration(), size).await
        };
        let image = draw(json).await;
        let plain = draw(&json.replace("-250,90", "-150,20")).await;
        let mut findings = Findings::new(COARSE);
        findings.compare("clay", &page, &image, &[("/subject/clay/strokes/2", plain)]);
        findings.tell();
        tab.assert_no_complaints().await;
    });
}

/// A clay begins with a mesh beside the page, or with one that the reader drops: the part that shapes it reads that.
#[test]
fn a_clay_of_a_file_is_drawn_as_the_native_program_draws_it() {
    compare_clay_of(
        "ball.obj",
        bumpy_ball().into_bytes(),
        |file| file.to_owned(),
        &["clay"],
    );
}

/// A clay begins with a scan: the part that reads scans hands it to the part that shapes clays.
#[test]
fn a_clay_of_a_scan_is_drawn_as_the_native_program_draws_it() {
    compare_clay_of(
        "ball.nrrd",
        parts::small_scan(),
        |file| format!(r#""of":{{{file}}},"iso":100"#),
        &["clay", "scans"],
    );
}

/// Compares a clay that begins with a file, which lies beside the page and then is dropped, page and native program.
/// `from` completes what names the file.
fn compare_clay_of(
    name: &'static str,
    bytes: Vec<u8>,
    from: impl Fn(&str) -> String + Clone + 'static,
    parts: &'static [&'static str],
) {
    with_browser(BrowserGpu::Software, move |session| async move {
        let server = &session.server;
        server.add(name, bytes.clone());
        let json = |file: &str, pulled: u32| {
            let from = from(file);
            format!(
                r#"{{"fabrica":1,"subject":{{"clay":{{"from":{{{from}}},"detail":0.04,"tools":[{{"radius":0.15}}],
                "strokes":[{{"path":[0,0,400,0,0,{pulled}]}}]}}}},"camera":{{"rotate":[0.3,0.2,0.1,0.92]}}}}"#
            )
        };
        let at_src = format!(r#""src":"{name}""#);
        let link = payload(&json(&at_src, 200));
        let tab = session.half_viewer(&format!("#{link}"), (300, 420)).await;
        tab.settled().await;
        assert_only_are_fetched(server, parts);
        let page = promised(&tab, "window.fabrica.viewer.picture()").await;
        let size = page.dimensions().into();
        let native = Native::open().await;
        let draw = async |pulled| {
            let document = Document::from_json(&json(&at_src, pulled)).expect("a good document");
            let SubjectRef::Clay(clay) = &document.illustration().subject else {
                panic!("a clay")
            };
            let (mut desk, mut report) = (ClayDesk::default(), LoadReport::default());
            let mut files = MemoryFiles::new([(name, bytes.clone())]);
            let file: (&mut dyn FileSet, &str) = (&mut files, name);
            let begun = desk.begin(clay, file, &mut report, &mut |_| true);
            begun.expect("it can be read");
            let made = surface_of_clay(&mut desk, clay, &mut |_| true);
            let subject = Subject::from(made.expect("it can be made").0);
            let studio = Studio::new(&native.gpu, &subject, true).expect("it fits");
            drawn(&studio, document.illustration(), size).await
        };
        let image = draw(200).await;
        let plain = draw(100).await;
        let mut findings = Findings::new(COARSE);
        let what = format!("clay of {name}");
        findings.compare(&what, &page, &image, &[("/subject/clay/strokes/0", plain)]);
        findings.tell();
        // The same by its hash, once the reader has dropped the file.
        let hash = fabrica::math::hex(&Sha256::digest(&bytes));
        let link = payload(&json(&format!(r#""sha256":"{hash}""#), 200));
        let tab = session.half_viewer(&format!("#{link}"), (300, 420)).await;
        tab.settled().await;
        drop_files(&tab, &[name]).await;
        tab.settled().await;
        let dropped = promised(&tab, "window.fabrica.viewer.picture()").await;
        let same = difference(&page, &dropped, WHITE);
        assert_eq!(same.mean, 0.0, "it is the same clay");
        tab.assert_no_complaints().await;
    });
}

/// A ball of 80 mm with bumps, as an OBJ of one part.
fn bumpy_ball() -> String {
    let (around, up) = (40, 20);
    let mut text = String::new();
    for i in 0..=up {
        let tilt = f64::from(i) / f64::from(up) * std::f64::consts::PI;
        for j in 0..around {
            let turn = f64::from(j) / f64::from(around) * std::f64::consts::TAU;
            let far = 40.0 + 3.0 * (3.0 * turn).sin() * tilt.sin().powi(2);
            let flat = far * tilt.sin();
            text += &format!(
                "v {:.4} {:.4} {:.4}\n",
                flat * turn.cos(),
                -far * tilt.cos(),
                flat * turn.sin()
            );
        }
    }
    let at = |i: i32, j: i32| 1 + i * around + j % around;
    for i in 0..up {
        for j in 0..around {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            text += &format!("f {a} {b} {c} {d}\n");
        }
    }
    text
}

/// A mesh that a link names is fetched, prepared in a worker and drawn as the native program draws it, with objects
/// that keep their place where templates move the mesh.
#[test]
fn a_mesh_is_drawn_as_the_native_program_draws_it() {
    compare_ball(
        r##"{"fabrica":1,"subject":{"src":"ball.obj"},
            "look":{"layers":[{"depth":0,"color":"#b8433a"},{"depth":0.03,"color":"#f2e3b3","grain":0.2}]},
            "objects":[{"src":"ball.obj","at":[0.35,0.6,0.1],"size":0.25},{"builtin":"scalpel","at":[0.1,0.6,0.2],"size":0.5}],
            "templates":[{"kind":"split","at":[0,0,0.1],"size":[0.7,1.2,0.9]}],"camera":{"rotate":[-0.3,0.05,0.1,0.94]}}"##,
        &["/templates/0", "/look/layers", "/objects/1", "/objects/0"],
        (300, 420),
    );
}

/// A template opens a volume and the mesh in it.
#[test]
fn a_mesh_in_a_volume_is_drawn_as_natively() {
    compare_ball(
        r##"{"fabrica":1,"subject":{"builtin":"cube","meshes":[{"src":"ball.obj"}]},
            "look":{"segments":{"ball":{"body":"solid","color":"#b8433a"}}},
            "templates":[{"kind":"split","at":[0,0,0.4],"size":[0.8,1.2,0.9]}],"camera":{"rotate":[0.5,0,0,0.866]}}"##,
        &["/templates/0", "/look/segments"],
        (180, 252),
    );
}

/// The bumpy ball as a document has it: the subject, or a part of a built-in one.
fn ball_in(document: &Value) -> Subject {
    let bytes = bumpy_ball().into_bytes();
    let Some(name) = document["subject"]["builtin"].as_str() else {
        return surface_of("ball.obj", bytes).into();
    };
    let subject = Subject::from(volume_of((name, 1), FINE_RESOLUTION));
    let half = DVec3::splat(0.5 * subject.mm_per_unit().expect("it has a size"));
    subject.with_meshes(Some(surface_within("ball.obj", bytes, [-half, half])))
}

/// A tool that carves, half way of what a step does to it: its place, its wound, and the tissue that gives way.
#[test]
fn a_tool_that_carves_is_drawn_under_way_as_natively() {
    compare_scene(
        r##"{"fabrica":1,"subject":{"src":"ball.obj"},
            "look":{"body":"solid","layers":[{"depth":0,"color":"#b8433a"},{"depth":0.05,"color":"#f2e3b3"}]},
            "objects":[{"src":"ball.obj","name":"knife","at":[0,0.9,0.3],"size":0.5,"opacity":0.2}],
            "templates":[{"kind":"carve","params":{"object":"knife","push":0.03,"reach":0.15}}],
            "steps":[{"set":{"/objects/0/at":[0,0.3,0.1]},"seconds":2}],
            "camera":{"rotate":[0.3,0.2,0.1,0.92]}}"##,
        &["/templates/0"],
        (300, 460),
        Some(0.5),
    );
}

/// Draws a document of the bumpy ball in a page of this size (CSS pixels) and natively. Without each of `about` the
/// picture is another.
fn compare_ball(json: &'static str, about: &'static [&'static str], page_size: (u32, u32)) {
    compare_scene(json, about, page_size, None);
}

/// As [`compare_ball`]; with a `place`, at that part of the passage to the first step.
fn compare_scene(
    json: &'static str,
    about: &'static [&'static str],
    page_size: (u32, u32),
    place: Option<f32>,
) {
    with_browser(BrowserGpu::Software, move |session| async move {
        let bytes = bumpy_ball().into_bytes();
        session.server.add("ball.obj", bytes.clone());
        let tab = session
            .half_viewer(&format!("#{}", payload(json)), page_size)
            .await;
        tab.settled().await;
        if let Some(place) = place {
            scrub(&tab, place).await;
        }
        let page = promised(&tab, "window.fabrica.viewer.picture()").await;

        let ball = surface_of("ball.obj", bytes);
        let native = Native::open().await;
        let document: Value = serde_json::from_str(json).expect("JSON");
        let studio = Studio::new(&native.gpu, &ball_in(&document), true).expect("it fits");
        let knife = tool("scalpel").expect("it is generated");
        let knife = Surface::new(&knife, None, &mut |_| true).expect("it has a size");
        let shown = Document::from_json(json).expect("a good document");
        let shown = shown.illustration();
        let (knife, mut beside) = (Arc::new(knife), Arc::clone(&ball));
        if shown
            .templates
            .iter()
            .any(|t| t.kind == TemplateKind::Carve)
        {
            let carving = Surface::clone(&ball).carving(&mut |_| true);
            beside = Arc::new(carving.expect("not stopped"));
        }
        let objects = shown.objects.iter().map(|object| match &object.source {
            source @ ObjectSource::Builtin(_) => (source.clone(), Arc::clone(&knife)),
            source @ ObjectSource::File { .. } => (source.clone(), Arc::clone(&beside)),
        });
        let studio = studio.with_resources(Resources {
            objects: objects.collect(),
            ..Resources::default()
        });
        let draw = async |document: &Value, place: Option<f32>| {
            let document = Document::from_json(&document.to_string()).expect("a good document");
            let size = page.dimensions().into();
            let Some(place) = place else {
                return drawn(&studio, document.illustration(), size).await;
            };
            let lesson = document.lesson().expect("steps");
            let [first, second] = [0, 1].map(|step| lesson.at_step(step).expect("a step"));
            drawn(&studio, &Lesson::between(first, second, place), size).await
        };
        let image = draw(&document, place).await;
        let mut plain = Vec::new();
        for pointer in about {
            plain.push((*pointer, draw(&without(&document, pointer), place).await));
        }
        if place.is_some() {
            plain.push(("the passage", draw(&document, Some(0.0)).await));
        }
        let mut findings = Findings::new(COARSE);
        findings.compare("mesh", &page, &image, &plain);
        assert!(findings.faults.is_empty(), "{}", findings.faults.join("\n"));
        let (even, off) = apart_in_even_parts(&page, &image);
        println!("{off} of {even} pixels away from silhouettes differ by more than 1 of 255");
        assert!(even > 1000 && off == 0, "{off} of {even} pixels differ");
    });
}

/// Pixels away from silhouettes, and those of them that differ by more than 1 of 255.
fn apart_in_even_parts(a: &RgbaImage, b: &RgbaImage) -> (usize, usize) {
    let (width, height) = a.dimensions();
    let far = |p: &image::Rgba<u8>, q: &image::Rgba<u8>| {
        let pairs = p.0.iter().zip(q.0);
        pairs.map(|(p, q)| p.abs_diff(q)).max().unwrap_or(0)
    };
    let is_even = |image: &RgbaImage, x: u32, y: u32| {
        let own = image.get_pixel(x, y);
        let around = (0..9).map(|i| image.get_pixel(x + i % 3 - 1, y + i / 3 - 1));
        own.0[..3] != WHITE
            && around
                .map(|other| far(own, other))
                .all(|far| far < SILHOUETTE)
    };
    let (mut even, mut off) = (0, 0);
    for (x, y) in (1..width - 1).flat_map(|x| (1..height - 1).map(move |y| (x, y))) {
        if is_even(a, x, y) && is_even(b, x, y) {
            even += 1;
            off += usize::from(far(a.get_pixel(x, y), b.get_pixel(x, y)) > 1);
        }
    }
    (even, off)
}

/// Brings the lesson to a place between its start and its first step, and waits until the picture rests there.
async fn scrub(tab: &Tab, place: f32) {
    let list = "window.fabrica.viewer.mirrored()";
    // Nothing is listed before the first call.
    let _asked: String = tab.eval(list).await;
    tab.frames(2).await;
    let slider = "Place in the lesson";
    let script = format!(
        "(() => {{
            const found = JSON.parse({list} || '[]').find((control) => control.name === '{slider}' && control.max !== null);
            if (found) window.fabrica.viewer.act(found.id, 'number', '{place}');
            return found !== undefined;
        }})()"
    );
    tab.wait_until(&script, 30).await;
    tab.settled().await;
}
