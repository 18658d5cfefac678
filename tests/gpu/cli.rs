//! The program as people call it: every command, its results, its errors and its exit status.

use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use fabrica::clay::{Shaped, Shaping};
use fabrica::data::VolumeBuilder;
use fabrica::document::{Document, SubjectRef};
use fabrica::load::{MemoryFiles, MeshOptions, Units, read_mesh};
use fabrica::render::ScaleBar;
use glam::Vec3;
use serde_json::{Value, json};
use sha2::{Digest as _, Sha256};
use tempfile::TempDir;

use crate::data::data_folder;
use crate::scatter::Random;
use crate::segment_files::{self, nifti};

/// How a call of the program ended.
pub(crate) struct Outcome {
    status: i32,
    /// Standard output.
    pub(crate) out: String,
    /// Standard error.
    pub(crate) err: String,
}

impl Outcome {
    #[track_caller]
    pub(crate) fn ok(self) -> Self {
        assert_eq!(self.status, 0, "standard error: {}", self.err);
        for line in self.err.lines() {
            assert!(
                line.starts_with("notice: "),
                "only notices with exit 0: {line}"
            );
        }
        self
    }

    /// One line that says what and where, exit status 1, nothing on standard output.
    #[track_caller]
    fn failed(self, what: &[&str]) {
        assert_eq!(self.status, 1, "out: {} err: {}", self.out, self.err);
        assert_eq!(self.out, "", "nothing is printed when it fails");
        let lines: Vec<&str> = self
            .err
            .lines()
            .filter(|line| !line.starts_with("notice: "))
            .collect();
        assert_eq!(lines.len(), 1, "one line: {}", self.err);
        assert!(lines[0].starts_with("error: "), "{}", lines[0]);
        for part in what {
            assert!(lines[0].contains(part), "“{part}” is not in: {}", lines[0]);
        }
    }
}

pub(crate) fn fabrica_with(folder: &Path, args: &[&str], input: &[u8]) -> Outcome {
    let mut child = Command::new(env!("CARGO_BIN_EXE_fabrica"))
        .args(args)
        .current_dir(folder)
        .env("XDG_RUNTIME_DIR", folder)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    // A program that stops early closes its end.
    let _closed = child.stdin.take().expect("a pipe").write_all(input);
    let output = child.wait_with_output().expect("the program ends");
    Outcome {
        status: output.status.code().expect("no signal"),
        out: String::from_utf8(output.stdout).expect("text"),
        err: String::from_utf8(output.stderr)
            .expect("text")
            .lines()
            // Said by the driver's loader, not by the program.
            .filter(|line| !line.contains("XDG_RUNTIME_DIR"))
            .map(|line| format!("{line}\n"))
            .collect(),
    }
}

fn fabrica(args: &[&str]) -> Outcome {
    fabrica_with(Path::new(env!("CARGO_MANIFEST_DIR")), args, b"")
}

fn folder() -> TempDir {
    tempfile::tempdir().expect("a folder")
}

fn write(folder: &TempDir, name: &str, bytes: impl AsRef<[u8]>) -> PathBuf {
    let path = folder.path().join(name);
    std::fs::write(&path, bytes).expect("a file");
    path
}

fn text(path: &Path) -> &str {
    path.to_str().expect("a plain path")
}

const PEEL: &str = r#"{"fabrica":1,"subject":{"builtin":"bar"},"templates":[{"kind":"peel","params":{"progress":0.8}}]}"#;

fn scan() -> Vec<u8> {
    nifti([16, 12, 8], |x, y, z| x * 50 + y + z)
}

fn hash(bytes: &[u8]) -> String {
    Sha256::digest(bytes)
        .iter()
        .map(|byte| format!("{byte:02x}"))
        .collect()
}

#[test]
fn link_and_doc_are_inverse() {
    let folder = folder();
    let path = write(&folder, "peel.json", PEEL);
    let link = fabrica(&["link", text(&path)]).ok().out;
    assert!(
        link.starts_with('#') && link.ends_with('\n') && link.lines().count() == 1,
        "{link}"
    );
    assert!(
        link.trim()[1..]
            .bytes()
            .all(|b| b.is_ascii_alphanumeric() || b == b'-' || b == b'_'),
        "{link}"
    );
    let canonical = fabrica(&["doc", text(&path)]).ok().out;
    assert_eq!(
        serde_json::from_str::<Value>(&canonical).expect("JSON"),
        serde_json::from_str::<Value>(PEEL).expect("JSON")
    );
    for doc in [
        link.trim(),
        &link.trim()[1..],
        &format!("https://example.org/a?b=c{}&step=3", link.trim()),
        &format!("https://example.org/?s={}", &link.trim()[1..]),
    ] {
        assert_eq!(fabrica(&["doc", doc]).ok().out, canonical, "of {doc}");
    }
    assert_eq!(
        fabrica_with(folder.path(), &["doc", "-"], PEEL.as_bytes())
            .ok()
            .out,
        canonical
    );
    assert_eq!(
        fabrica_with(folder.path(), &["doc", "peel.json"], b"")
            .ok()
            .out,
        canonical
    );
    let page = fabrica(&["link", text(&path), "--page", "https://example.org/v/"])
        .ok()
        .out;
    assert_eq!(page, format!("https://example.org/v/{link}"));
    let with_step = format!("{}&step=2", link.trim());
    assert_eq!(fabrica(&["link", &with_step]).ok().out.trim(), with_step);
    assert_eq!(
        fabrica_with(
            folder.path(),
            &["doc", text(&write(&folder, "a.txt", link))],
            b""
        )
        .ok()
        .out,
        canonical,
        "a file that holds a link"
    );
}

/// A scale bar is as long in the file as the camera sees its length, with and without lettering; captions that the
/// program cannot shape are named where they are written.
#[test]
fn pictures_have_a_scale_bar_and_unshaped_captions_are_named() {
    let folder = folder();
    let json = r#"{"fabrica":1,"subject":{"builtin":"bar"},"look":{"scale":true,"sides":true},"camera":{"distance":1.7},"labels":[{"at":[0,0,0.1],"text":"Shell"},{"at":[0,0.1,0.1],"text":"عظم"},{"at":[0,0.1,0],"text":"עצם\n\u001b[2J"},{"at":[0,0,0],"text":"עצם","enabled":false}]}"#;
    let path = write(&folder, "marks.json", json);
    let out = folder.path().join("marks.png");
    let drawn = |extra: &[&str]| {
        let args = ["render", text(&path), "-o", text(&out), "--size", "320x240"];
        let outcome = fabrica(&[&args, extra].concat()).ok();
        let picture = image::open(&out).expect("a picture").to_rgba8();
        (outcome.err, picture)
    };
    let (plain, picture) = drawn(&[]);
    assert!(
        !plain.contains("/labels"),
        "no captions, no notice: {plain}"
    );
    let document = Document::from_json(json).expect("a document");
    let mut bar = VolumeBuilder::new();
    fabrica::subjects::generate("bar", 32, &mut bar).expect("a bar");
    let mm_per_unit = bar.finish().expect("whole").grid.mm_per_unit();
    let camera = document.illustration().camera;
    let wanted = ScaleBar::of(&camera, [320, 240], mm_per_unit).expect("a scale bar");
    let longest = |y: u32| {
        let row = (160..320).map(|x| picture.get_pixel(x, y)[0] < 110);
        let mut runs = vec![0_u32];
        for is_dark in row {
            match is_dark {
                true => *runs.last_mut().expect("there is one") += 1,
                false => runs.push(0),
            }
        }
        runs.into_iter().max().unwrap_or(0)
    };
    let found = (210..240).map(longest).max().unwrap_or(0);
    let off = (found as f32 - wanted.length_px).abs();
    assert!(off <= 1.5, "{found} pixels, {wanted:?}");

    let (told, _) = drawn(&["--lettering"]);
    for part in ["/labels/1/text: “عظم”", "/labels/2/text: “עצם"] {
        assert!(told.contains(part), "“{part}” is not in {told}");
    }
    assert!(
        !told.contains("/labels/0") && !told.contains("/labels/3"),
        "{told}"
    );
    assert!(!told.contains('\u{1b}'), "{told:?}");
}

#[test]
fn notices_are_lines_with_exit_0() {
    let odd = r#"{"fabrica":1,"x":1,"templates":[{"kind":"peel","params":{"progress":3,"colour":1}},{"kind":"unknown"},{"kind":"rbf","params":{"points":[POINTS]}}]}"#;
    let odd = odd.replace("POINTS", &vec!["{}"; 65].join(","));
    let outcome = fabrica_with(Path::new("."), &["doc", "-"], odd.as_bytes()).ok();
    for part in [
        "/x:",
        "/templates/0/params/progress: 3 is outside",
        "/templates/0/params/colour",
        "“unknown”",
        "/templates/2/params/points: 65 is outside the range; the first 64 is drawn",
    ] {
        assert!(
            outcome.err.contains(part),
            "“{part}” is not in {}",
            outcome.err
        );
    }
    assert_eq!(outcome.err.lines().count(), 5, "{}", outcome.err);
    for part in [
        "\"x\": 1",
        "\"progress\": 3",
        "\"colour\": 1",
        "\"unknown\"",
        "\"rbf\"",
    ] {
        assert!(
            outcome.out.contains(part),
            "{part} is kept: {}",
            outcome.out
        );
    }
    // Nothing in a document steers the terminal.
    let hostile = "{\"fabrica\":1,\"\\u001b[2J\\nerror: x\":1}";
    let outcome = fabrica_with(Path::new("."), &["doc", "-"], hostile.as_bytes()).ok();
    assert!(
        !outcome.err.contains('\u{1b}') && outcome.err.lines().count() == 1,
        "{:?}",
        outcome.err
    );
}

#[test]
fn wrong_documents_are_named() {
    for (document, parts) in [
        ("", &["standard input", "line 1, column 1"][..]),
        ("{\"fabrica\":1,}", &["line 1, column 14"]),
        ("[]", &["expected an object"]),
        ("{}", &["/fabrica", "missing"]),
        ("{\"fabrica\":2}", &["/fabrica", "2", "newer release"]),
        (
            "{\"fabrica\":1,\"camera\":{\"fov\":1e999}}",
            &["/camera/fov", "1e999", "finite"],
        ),
        (
            "{\"fabrica\":1,\"camera\":{\"fov\":NaN}}",
            &["/camera/fov", "NaN"],
        ),
        (
            "{\"fabrica\":1,\"camera\":{\"fov\":\"wide\"}}",
            &["/camera/fov", "a number", "wide"],
        ),
        (
            "{\"fabrica\":1,\"templates\":[{\"kind\":\"peel\",\"at\":[0,0]}]}",
            &["/templates/0/at", "three numbers"],
        ),
        (
            "{\"fabrica\":1,\"templates\":[{\"kind\":\"cut\",\"rotate\":[0,0,0,0]}]}",
            &["/templates/0/rotate"],
        ),
        (
            "{\"fabrica\":1,\"title\":1,\"title\":2}",
            &["/title", "twice"],
        ),
        (
            "{\"fabrica\":1,\"steps\":[{\"set\":{\"/subject\":{}}}]}",
            &["/steps/0/set/~1subject", "may not be set"],
        ),
    ] {
        fabrica_with(Path::new("."), &["doc", "-"], document.as_bytes()).failed(parts);
    }
    let many = format!(
        "{{\"fabrica\":1,\"templates\":[{}]}}",
        vec!["{\"kind\":\"cut\"}"; 33].join(",")
    );
    fabrica_with(Path::new("."), &["link", "-"], many.as_bytes()).failed(&[
        "/templates",
        "33",
        "32",
    ]);
    fabrica_with(Path::new("."), &["link", "-"], &vec![b' '; 3 << 20])
        .failed(&["standard input", "1048576"]);
    fabrica_with(Path::new("."), &["link", "-"], b"\xff\xfe").failed(&["UTF-8"]);
}

#[test]
fn wrong_links_are_named() {
    let link = fabrica_with(Path::new("."), &["link", "-"], PEEL.as_bytes())
        .ok()
        .out;
    let link = link.trim();
    fabrica(&["doc", &link[..link.len() - 3]]).failed(&["cut off"]);
    let mut swapped = link.to_owned().into_bytes();
    swapped.swap(4, 5);
    fabrica(&["doc", std::str::from_utf8(&swapped).expect("ASCII")]).failed(&["damaged"]);
    fabrica(&["doc", "#top"]).failed(&["not a Fabrica link", "top"]);
    fabrica(&["doc", "no/such/file.json"]).failed(&["no/such/file.json", "there is no file"]);
    fabrica(&["doc", "https://example.org/"]).failed(&["empty"]);
    fabrica(&["doc", "."]).failed(&["."]);
}

#[test]
fn bad_usage_is_2() {
    for args in [
        &["unknown"][..],
        &["render"],
        &["render", "x"],
        &["render", "x", "-o", "a.png", "--size", "0x3"],
        &["render", "x", "-o", "a.png", "--size", "big"],
        &["render", "x", "-o", "a.png", "--samples", "0"],
        &["render", "x", "-o", "a.png", "--time", "NaN"],
        &["clay", "x"],
        &["clay", "x", "-o", "a.ply", "--check"],
        &["clay", "x", "-o", "a.ply", "--json"],
        &["doc"],
        &["templates", "--xml"],
        &["probe"],
        &["probe", "-"],
        &["probe", "-", "--rays"],
        &["probe", "x", "--rays", "--depth"],
        &["link", "a", "b"],
    ] {
        let outcome = fabrica(args);
        assert_eq!(outcome.status, 2, "{args:?}: {}", outcome.err);
        assert_eq!(outcome.out, "", "{args:?}");
        let lines: Vec<&str> = outcome.err.lines().collect();
        assert_eq!(lines.len(), 1, "{args:?}: {}", outcome.err);
        assert!(lines[0].starts_with("error: "), "{}", lines[0]);
    }
    let missing = fabrica(&["render"]).err;
    for told in ["<DOC>", "--output", "usage: fabrica render"] {
        assert!(missing.contains(told), "{told}: {missing}");
    }
    assert_eq!(fabrica(&["--help"]).status, 0);
    assert!(
        fabrica(&["--version"]).out.starts_with("fabrica "),
        "its version"
    );
}

#[test]
fn a_clay_is_written_read_again_and_checked() {
    const PULLED: &str = r#"{ "fabrica": 1, "title": "Horn", "subject": { "clay": { "detail": 0.05,
        "tools": [{ "radius": 0.1 }, { "shape": "later" }],
        "strokes": [{ "path": [0, 0, 440, 0, 0, 300] }, { "tool": 1, "path": [0, 0, 0] }] } } }"#;
    let folder = folder();
    let path = write(&folder, "horn.json", PULLED);
    let path = text(&path);
    let check = |args: &[&str]| -> Value {
        let args = [&["clay", path, "--check", "--json"], args].concat();
        serde_json::from_str(&fabrica(&args).ok().out).expect("JSON")
    };
    let whole = check(&[]);
    assert_eq!(whole, check(&[]), "the same bits again");
    assert_eq!(whole["crossing"], 0);
    assert_eq!(whole["euler"], 2);
    assert_eq!(whole["border_edges"], 0);
    assert_ne!(whole["sha256"], check(&["--strokes", "0"])["sha256"]);
    let first = check(&["--strokes", "1"]);
    assert!(first["shortest_edge"].as_f64() > Some(0.05 / 16.0));
    assert!(
        whole["shortest_edge"].is_null(),
        "the last stroke does nothing"
    );
    assert_eq!(
        (&whole["short_edges"], &whole["smoothing_strokes"]),
        (&json!(0), &json!(0))
    );
    let told = fabrica(&["clay", path, "--check"]).ok();
    for line in [
        "Euler number: 2",
        "edges shorter than detail/16 in reach of the last stroke: 0",
        "strokes that smooth: 0",
    ] {
        assert!(told.out.contains(line), "{line}: {}", told.out);
    }
    assert!(told.err.contains("stroke 2 is left out"), "{}", told.err);
    for end in ["ply", "obj", "stl", "glb"] {
        let mesh = folder.path().join(format!("horn.{end}"));
        fabrica(&["clay", path, "-o", text(&mesh)]).ok();
        let info = fabrica(&["info", text(&mesh)]).ok().out;
        assert!(info.contains("surface: closed"), "{end}: {info}");
        assert!(
            info.contains("100 × 100 × 1"),
            "{end}: in millimetres: {info}"
        );
        let triangles = format!("triangles: {}", whole["triangles"]);
        assert!(info.contains(&triangles), "{end}: {info}");
    }
    for (end, begins) in [("stl", "solid "), ("ply", "ply\nformat ascii")] {
        let mesh = folder.path().join(format!("text.{end}"));
        fabrica(&["clay", path, "-o", text(&mesh), "--text"]).ok();
        let written = std::fs::read_to_string(&mesh).expect("a text");
        assert!(written.starts_with(begins), "{end}");
        let info = fabrica(&["info", text(&mesh)]).ok().out;
        let triangles = format!("triangles: {}", whole["triangles"]);
        assert!(info.contains(&triangles), "{end}: {info}");
    }
    let picture = folder.path().join("horn.png");
    let args = ["render", path, "-o", text(&picture), "--size", "64x48"];
    assert!(fabrica(&args).ok().err.contains("stroke 2 is left out"));
    let ball = write(&folder, "ball.json", r#"{ "fabrica": 1 }"#);
    let outcome = fabrica(&["clay", text(&ball), "--check"]);
    assert_eq!(outcome.status, 2, "{}", outcome.err);
    let egg = r#"{ "fabrica": 1, "subject": { "clay": { "from": { "shape": "egg" } } } }"#;
    let egg = write(&folder, "egg.json", egg);
    fabrica(&["clay", text(&egg), "--check"]).failed(&["egg"]);
}

/// A clay of ten strokes, two of them mirrored and one that smooths.
const TEN_STROKES: &str = r#"{ "fabrica": 1, "title": "Ten", "subject": { "clay": { "detail": 0.05,
    "tools": [{ "radius": 0.1 }, { "shape": "box", "half": [0.1, 0.08, 0.06], "coat": 0.08 }],
    "strokes": [{ "path": [0, 0, 440, 0, 0, 300] }, { "path": [300, 300, 200, 120, 40, 60] },
        { "path": [250, 0, 500, -160, 0, -20], "mirror": "x" }, { "path": [0, 700, 0, 0, -300, 0] },
        { "tool": 1, "path": [0, -480, 0, 0, 0, 40], "turns": [0, 0, 0, 0, 40, 0] },
        { "path": [0, -600, 300, 0, 200, -80] }, { "path": [450, 0, -200, 200, 30, 0], "scales": [100, 60] },
        { "path": [0, 0, 500, 0, 0, 0], "do": "smooth" }, { "path": [0, 200, -520, 100, 50, 120] },
        { "path": [-420, 100, 100, -120, 0, 60], "mirror": "z" }] } } }"#;

/// The clay of a document after all of its strokes.
fn shaped(document: &str) -> Shaped {
    let document = Document::from_json(document).expect("a document");
    let SubjectRef::Clay(clay) = &document.illustration().subject else {
        panic!("a clay");
    };
    let mut shaping = Shaping::new(clay).expect("a start");
    for _ in &clay.strokes {
        shaping.stroke(clay, &mut |_| true).expect("a stroke");
    }
    shaping.shaped()
}

#[test]
fn what_is_written_of_a_clay_is_read_again_equal() {
    let folder = folder();
    let path = write(&folder, "ten.json", TEN_STROKES);
    let shaped = shaped(TEN_STROKES);
    let positions = shaped.positions_mm();
    // The numbers of a file as they are: of a GLB metres.
    let options = MeshOptions {
        units: Some(Units::Millimetre),
        ..MeshOptions::default()
    };
    for (end, per_mm, has_normals) in [
        ("ply", 1.0, true),
        ("obj", 1.0, true),
        ("stl", 1.0, false),
        ("glb", 1000.0, true),
    ] {
        let file = folder.path().join(format!("ten.{end}"));
        fabrica(&["clay", text(&path), "-o", text(&file)]).ok();
        let bytes = std::fs::read(&file).expect("a file");
        let mut files = MemoryFiles::new([(end, bytes)]);
        let (read, mut report) = read_mesh(&mut files, end, &options, &mut |_| true)
            .unwrap_or_else(|error| panic!("{end}: {error}"));
        // Readers replace a normal that looks away from its triangle: at sharp folds there are a few.
        report.repair.bad_normals = 0;
        assert_eq!(report.repair.phrases(), [""; 0], "{end}");
        assert_eq!(read.triangles.len(), shaped.triangles.len(), "{end}");
        assert_eq!(read.positions.len(), positions.len(), "{end}");
        let mut normals = 0;
        for (triangle, (of_file, of_clay)) in
            read.triangles.iter().zip(&shaped.triangles).enumerate()
        {
            let found = of_file.map(|i| read.positions[i as usize]);
            let wanted = of_clay.map(|i| positions[i as usize] / per_mm);
            assert_eq!(found, wanted, "{end}: triangle {triangle}");
            for (corner, i) in of_clay.iter().enumerate() {
                let of_file = read.normals.as_ref().and_then(|n| n.get(triangle, corner));
                let is_equal = |normal: Vec3| normal.distance(shaped.normals[*i as usize]) < 1e-6;
                normals += usize::from(of_file.is_some_and(is_equal));
            }
        }
        let least = if has_normals { 2.97 } else { 0.0 };
        assert!(
            normals as f64 >= least * read.triangles.len() as f64,
            "{end}: {normals}"
        );
    }
}

#[test]
fn info_tells_of_documents_and_links() {
    let folder = folder();
    let clay = r#"{ "fabrica": 1, "title": "Horn", "subject": { "clay": { "detail": 0.05,
        "tools": [{ "radius": 0.1 }, { "shape": "later" }],
        "strokes": [{ "path": [0, 0, 440, 0, 0, 300] }, { "tool": 1, "path": [0, 0, 0] },
            { "path": [0, 0, 700], "do": "smooth", "off": true }, { "path": [0, 0, 900, 0, 0, 1] }] } },
        "look": { "strokes": 3 }, "templates": [{ "kind": "cut" }, { "kind": "peel" }, { "kind": "cut" }],
        "steps": [{ "title": "Begin" }] }"#;
    let path = write(&folder, "horn.json", clay);
    let path = text(&path);
    let told = fabrica(&["info", path]).ok();
    for line in [
        "kind: Fabrica document\n",
        "title: Horn\n",
        "subject: clay\n",
        "start: ball\n",
        "detail: 0.05\n",
        "  ball, coat 0.1\n  not known, coat 0.1\n",
        "strokes: 4, of which the first 3 are shown\n",
        "  smoothing: 1\n  off: 1\n  left out: 1\n  stroke 2: tool 1 is not there",
        "pieces: 1\n",
        "size: 100 × 100 × 1",
        "box: -50, -50, -50 to ",
        " mm³\n",
        "templates: 2 cut, 1 peel\n",
        "steps: 1\n  1 Begin\n",
    ] {
        assert!(told.out.contains(line), "“{line}” is not in {}", told.out);
    }
    assert!(told.err.contains("stroke 2 is left out"), "{}", told.err);
    let check = fabrica(&["clay", path, "--check"]).ok().out;
    for line in check.lines().take(3) {
        assert!(told.out.contains(line), "“{line}” is not in {}", told.out);
    }
    // The same of its link, of a file that holds the link, and from standard input.
    let link = fabrica(&["link", path]).ok().out;
    let link = link.trim();
    let file = write(&folder, "link.txt", link);
    assert_eq!(fabrica(&["info", link]).ok().out, told.out);
    assert_eq!(fabrica(&["info", text(&file)]).ok().out, told.out);
    let piped = fabrica_with(folder.path(), &["info", "-"], clay.as_bytes());
    assert_eq!(piped.ok().out, told.out);
    let sha256 = "a".repeat(64);
    let supplied = format!("a file that the reader has, “CT” (SHA-256 {sha256})");
    for (subject, line) in [
        (json!({ "builtin": "hand" }), "built-in hand"),
        (json!({ "src": "a/b.nii" }), "file a/b.nii"),
        (json!({ "sha256": sha256, "name": "CT" }), supplied.as_str()),
        (
            json!({ "meshes": [{ "src": "a.stl" }] }),
            "meshes: 1\n  file a.stl",
        ),
    ] {
        let document = json!({ "fabrica": 1, "subject": subject }).to_string();
        let told = fabrica_with(folder.path(), &["info", "-"], document.as_bytes());
        let expected =
            format!("kind: Fabrica document\nsubject: {line}\ntemplates: none\nsteps: 0\n");
        assert_eq!(told.ok().out, expected);
    }
    // What is wrong is said as of any document.
    let broken = write(&folder, "broken.json", r#"{ "fabrica": 1, "title": 3 }"#);
    fabrica(&["info", text(&broken)]).failed(&["broken.json", "/title"]);
    let cut_off = write(&folder, "cut.json", r#"{ "fabrica": 1, "#);
    fabrica(&["info", text(&cut_off)]).failed(&["cut.json"]);
    let egg = r#"{ "fabrica": 1, "subject": { "clay": { "from": { "shape": "egg" } } } }"#;
    fabrica_with(folder.path(), &["info", "-"], egg.as_bytes()).failed(&["egg"]);
    fabrica(&["info", &link[..link.len() - 3]]).failed(&["cut off"]);
}

/// Counts hold everywhere; of times it is told whether they do.
#[test]
fn the_shaping_of_clay_is_measured_without_an_adapter() {
    let told = fabrica(&["bench", "--clay", "--json", "--adapter", "none such"])
        .ok()
        .out;
    let report: Value = serde_json::from_str(&told).expect("JSON");
    let limits = report["limits"].as_array().expect("a list");
    let limit = |name: &str| {
        let found = limits
            .iter()
            .find(|row| row["name"].as_str().is_some_and(|n| n.contains(name)));
        found.unwrap_or_else(|| panic!("“{name}” is not in {told}"))
    };
    for (name, most) in [
        ("field once", 25.0),
        ("ten times as many", 1.3),
        ("replayed", 1.05),
        ("fewest", 1.2),
        ("bytes", 200.0),
    ] {
        let row = limit(name);
        assert_eq!(row["limit"], json!(most), "{told}");
        assert!(
            row["value"].as_f64() > Some(0.0) && row["holds"].is_boolean(),
            "{told}"
        );
    }
    for counted in ["fewest", "bytes"] {
        assert_eq!(limit(counted)["holds"], true, "{told}");
    }
    for count in [
        "strokes",
        "vertices",
        "triangles",
        "steps",
        "splits",
        "collapses",
    ] {
        assert!(report[count].as_u64() > Some(0), "{count}: {told}");
    }
}

#[test]
fn a_clay_begins_with_a_file() {
    const CORNER: &str =
        "v 0 0 0\nv 80 0 0\nv 0 80 0\nv 0 0 80\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
    let folder = folder();
    let doc = |name: &str, from: &str| {
        let text = r#"{ "fabrica": 1, "subject": { "clay": { "from": { FROM, "axes": "ras" }, "detail": 0.1,
            "tools": [{ "radius": 0.2 }], "strokes": [{ "path": [-500, -500, 500, 0, 0, 200] }] } } }"#;
        write(&folder, name, text.replace("FROM", from))
    };
    let corner = write(&folder, "corner.obj", CORNER);
    let half = write(&folder, "half.obj", CORNER.replace("80", "40"));
    let wanted = hash(CORNER.as_bytes());
    let at_src = doc("at.json", r#""src": "corner.obj""#);
    let by_hash = doc(
        "by.json",
        &format!(r#""sha256": "{wanted}", "name": "Corner""#),
    );
    let check = |args: &[&str]| -> Value {
        let args = [&["clay", "--check", "--json"], args].concat();
        serde_json::from_str(&fabrica(&args).ok().out).expect("JSON")
    };
    let made = check(&[text(&at_src)]);
    assert_eq!(
        (&made["euler"], &made["border_edges"]),
        (&json!(2), &json!(0))
    );
    assert_ne!(
        made["sha256"],
        check(&[text(&at_src), "--strokes", "0"])["sha256"]
    );
    assert_eq!(
        made,
        check(&[
            text(&by_hash),
            "--mesh",
            text(&half),
            "--mesh",
            text(&corner)
        ])
    );
    assert_eq!(made, check(&[text(&by_hash), "--subject", text(&corner)]));
    // It comes out in the millimetres in which it came in.
    for (end, more) in [("ply", &[][..]), ("glb", &["--subject", text(&corner)])] {
        let mesh = folder.path().join(format!("start.{end}"));
        let args = ["clay", text(&at_src), "--strokes", "0", "-o", text(&mesh)];
        fabrica(&[&args, more].concat()).ok();
        let info = fabrica(&["info", text(&mesh)]).ok().out;
        assert!(info.contains("80 × 80 × 80"), "{end}: {info}");
        assert!(info.contains("triangles: 4"), "{end}: {info}");
    }
    // Another file is taken where it is given instead, and refused where the document names it.
    let other = fabrica(&["clay", text(&by_hash), "--subject", text(&half), "--check"]).ok();
    assert!(
        other.err.contains("another file than the document means"),
        "{}",
        other.err
    );
    let ball = write(
        &folder,
        "ball.json",
        r#"{ "fabrica": 1, "subject": { "clay": {} } }"#,
    );
    assert_eq!(
        check(&[text(&ball), "--subject", text(&corner)])["triangles"],
        4
    );
    let from = format!(r#""src": "half.obj", "sha256": "{wanted}""#);
    let wrong = doc("wrong.json", &from);
    let picture = folder.path().join("clay.png");
    let render =
        |doc: &Path| fabrica(&["render", text(doc), "-o", text(&picture), "--size", "64x48"]);
    for outcome in [fabrica(&["clay", text(&wrong), "--check"]), render(&wrong)] {
        outcome.failed(&["half.obj", "another file than the document means", &wanted]);
    }
    for outcome in [
        fabrica(&["clay", text(&by_hash), "--check"]),
        render(&by_hash),
    ] {
        outcome.failed(&["Corner", &wanted, "--subject"]);
    }
    let gone = doc("gone.json", r#""src": "gone.obj""#);
    fabrica(&["clay", text(&gone), "--check"]).failed(&["gone.obj"]);
    let scan = write(&folder, "scan.nii", scan());
    fabrica(&["clay", text(&ball), "--subject", text(&scan), "--check"]).failed(&["not a mesh"]);
    let open = write(&folder, "open.obj", CORNER.replace("f 2 3 4\n", ""));
    let told = fabrica(&["clay", text(&at_src), "--subject", text(&open), "--check"]).ok();
    assert!(told.err.contains("is open"), "{}", told.err);
    assert!(told.out.contains("border edges: "), "{}", told.out);
    // It is a subject like any other.
    render(&at_src).ok();
    clay_is_at_the_first(&at_src, b"-0.47,-0.47,0.6\n0.4,0.4,0.4\n");
}

/// Of two points, the first lies in the clay and the second beside it.
fn clay_is_at_the_first(doc: &Path, points: &[u8]) {
    let args = ["probe", text(doc), "--object"];
    let inside = fabrica_with(Path::new("."), &args, points).ok().out;
    let lines: Vec<&str> = inside.lines().collect();
    assert!(
        lines[0].ends_with(",clay") && !lines[1].ends_with(",clay"),
        "{inside}"
    );
}

#[test]
fn a_clay_begins_with_a_part_of_a_volume() {
    let folder = folder();
    let doc = |name: &str, from: &str| {
        let text = r#"{ "fabrica": 1, "subject": { "clay": { "from": { FROM }, "detail": 0.05,
            "tools": [{ "radius": 0.2 }], "strokes": [{ "path": [0, 0, 450, 0, 0, 200] }] } } }"#;
        write(&folder, name, text.replace("FROM", from))
    };
    let check = |args: &[&str]| -> Value {
        let args = [&["clay", "--check", "--json"], args].concat();
        serde_json::from_str(&fabrica(&args).ok().out).expect("JSON")
    };
    let is_whole = |made: &Value| {
        let facts = ["euler", "pieces", "border_edges", "bad_edges"];
        assert_eq!(facts.map(|fact| made[fact].clone()), [2, 1, 0, 0], "{made}");
    };
    // The ball in the cube, 50 mm wide, about the middle.
    let cube = doc(
        "cube.json",
        r#""of": { "builtin": "cube" }, "segment": "ball""#,
    );
    let made = check(&[text(&cube)]);
    is_whole(&made);
    is_whole(&check(&[text(&cube), "--strokes", "0"]));
    let info = fabrica(&["info", text(&cube)]).ok().out;
    assert!(
        info.contains("start: segment ball of built-in cube\n"),
        "{info}"
    );
    let picture = folder.path().join("clay.png");
    let render =
        |doc: &Path| fabrica(&["render", text(doc), "-o", text(&picture), "--size", "64x48"]);
    render(&cube).ok();
    clay_is_at_the_first(&cube, b"0,0,0.55\n0.4,0.4,0.4\n");
    let stone = doc(
        "stone.json",
        r#""of": { "builtin": "cube" }, "segment": "stone""#,
    );
    let high = doc("high.json", r#""of": { "builtin": "cube" }, "iso": 1e9"#);
    for outcome in [fabrica(&["clay", text(&stone), "--check"]), render(&stone)] {
        outcome.failed(&["stone", "top, middle, bottom, ball"]);
    }
    fabrica(&["clay", text(&high), "--check"]).failed(&["1000000000", "they lie between"]);

    // A scan, at its address, by its hash, and in place of another one.
    let ball = |radius: f64| {
        nifti([30, 30, 30], |x, y, z| {
            let square = |at: i16| (f64::from(at) - 14.5).powi(2);
            (1000.0 + 50.0 * (radius - (square(x) + square(y) + square(z)).sqrt())) as i16
        })
    };
    let scan = write(&folder, "scan.nii", ball(10.0));
    let other = write(&folder, "other.nii", ball(7.0));
    let wanted = hash(&ball(10.0));
    let at_src = doc("at.json", r#""of": { "src": "scan.nii" }, "iso": 1000"#);
    let by = format!(r#""of": {{ "sha256": "{wanted}", "name": "Ball" }}, "iso": 1000"#);
    let by_hash = doc("by.json", &by);
    let made = check(&[text(&at_src)]);
    is_whole(&made);
    let given = ["--mesh", text(&other), "--mesh", text(&scan)];
    assert_eq!(made, check(&[&[text(&by_hash)], &given[..]].concat()));
    assert_eq!(made, check(&[text(&by_hash), "--subject", text(&scan)]));
    assert_ne!(made, check(&[text(&at_src), "--subject", text(&other)]));
    let ply = folder.path().join("start.ply");
    fabrica(&["clay", text(&at_src), "--strokes", "0", "-o", text(&ply)]).ok();
    assert!(ply.exists());
    render(&at_src).ok();
    fabrica(&["clay", text(&by_hash), "--check"]).failed(&["Ball", &wanted, "--subject"]);
    let wrong = format!(r#""of": {{ "src": "other.nii", "sha256": "{wanted}" }}, "iso": 1000"#);
    let wrong = doc("wrong.json", &wrong);
    for outcome in [fabrica(&["clay", text(&wrong), "--check"]), render(&wrong)] {
        outcome.failed(&["other.nii", "another file than the document means"]);
    }
    let bare = doc(
        "bare.json",
        r#""of": { "src": "scan.nii" }, "segment": "bone""#,
    );
    fabrica(&["clay", text(&bare), "--check"]).failed(&["bone", "it has none", "scan.nii"]);
    write(&folder, "mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    let mesh = doc("mesh.json", r#""of": { "src": "mesh.obj" }, "iso": 1"#);
    fabrica(&["clay", text(&mesh), "--check"]).failed(&["a mesh", "mesh.obj"]);
    let clay = doc("clay.json", r#""of": { "clay": {} }, "iso": 1"#);
    fabrica(&["clay", text(&clay), "--check"]).failed(&["/subject/clay/from/of/clay"]);
}

#[test]
fn pictures_are_described_in_words() {
    const LESSON: &str = r#"{"fabrica":1,"title":"Frucht","lang":"de-AT","subject":{"builtin":"tomato"},
        "templates":[{"kind":"peel","at":[0,0.3,0],"rotate":[-0.7071,0,0,0.7071],"size":[0.8,0.7,0.44],
            "params":{"depth":1,"progress":0.8,"radius":0.12},"align":{"to":"segment","keep":["jelly","seeds","core","calyx"]}}],
        "steps":[{"title":"Closed","set":{"/templates/0/params/progress":0}},{"title":"Own","alt":"In my words."}]}"#;
    let folder = folder();
    let path = write(&folder, "lesson.json", LESSON);
    let path = text(&path);
    let told = fabrica(&["describe", path]).ok().out;
    let paragraphs: Vec<&str> = told.trim_end().split("\n\n").collect();
    let [first, closed, own] = paragraphs[..] else {
        panic!("three paragraphs: {told}")
    };
    for part in [
        "Frucht. Objekt: Tomate. Die Schicht ist abgerollt, 80 %. Am Platz gelassen: Gelee, Kerne, Kern, Kelch. Ansicht von vorn. Zu sehen: ",
        "Haut ",
        "Fruchtfleisch ",
        " % des Bildes ein.",
    ] {
        assert!(first.contains(part), "“{part}” is not in {first}");
    }
    assert!(
        closed.starts_with("Schritt 1 von 2: Closed. Objekt: Tomate. Nichts ist verformt."),
        "{closed}"
    );
    assert_eq!(own, "In my words.");
    // One step, of a link, in another language. What is kept takes the longest, and has been told.
    let mut free: Value = serde_json::from_str(LESSON).expect("JSON");
    let template = free["templates"][0].as_object_mut().expect("a template");
    template.remove("align").expect("an alignment");
    let free = free.to_string();
    let path = write(&folder, "free.json", &free);
    let path = text(&path);
    let link = fabrica(&["link", path]).ok().out;
    let one = fabrica(&["describe", link.trim(), "--step", "1", "--lang", "en"])
        .ok()
        .out;
    assert!(
        one.starts_with("Step 1 of 2: Closed. Object: tomato. Nothing is deformed."),
        "{one}"
    );
    assert_eq!(one.lines().count(), 1, "{one}");
    // Within a passage a plate says how far it is.
    let plate = folder.path().join("plate.svg");
    let size = ["--size", "64x64", "--samples", "1"];
    let moment = ["--step", "1", "--time", "0.5", "-o", text(&plate)];
    fabrica(&[&["render", path][..], &size, &moment].concat()).ok();
    let plate = std::fs::read_to_string(&plate).expect("a plate");
    let part = plate.split_once("Die Schicht ist abgerollt, ");
    let part = part.and_then(|(_, rest)| rest.split_once(' ')?.0.parse::<u32>().ok());
    assert!(
        part.is_some_and(|part| (20..80).contains(&part)),
        "{part:?}"
    );
    let named = format!("{}&step=1", link.trim());
    assert_eq!(fabrica(&["describe", &named, "--lang", "en"]).ok().out, one);
    let piped = fabrica_with(
        folder.path(),
        &["describe", "-", "--json", "--lang", "zh"],
        free.as_bytes(),
    );
    let steps: Value = serde_json::from_str(&piped.ok().out).expect("JSON");
    assert_eq!(steps.as_array().map(Vec::len), Some(3));
    assert_eq!(
        steps[0]["done"],
        json!([{ "template": 0, "kind": "peel", "part": 0.8 }])
    );
    assert_eq!(
        (&steps[2]["is_by_author"], &steps[2]["text"]),
        (&json!(true), &json!("In my words."))
    );
    let segments = steps[0]["segments"].as_array().expect("segments");
    let share = |segment: &Value| segment["share"].as_f64().expect("a share");
    let all: f64 = segments.iter().map(share).sum();
    let unnamed = steps[0]["unnamed"].as_f64().expect("a share");
    assert!((all + unnamed - 1.0).abs() < 1e-3, "{steps}");
    let is_large = |segment: &&Value| share(segment) > 0.05;
    assert!(segments.iter().filter(is_large).count() >= 2, "{steps}");
    fabrica(&["describe", path, "--step", "3"]).failed(&["3", "2", "step"]);
    fabrica(&["describe", "no/such/file.json"]).failed(&["no/such/file.json"]);
    let unknown = fabrica(&["describe", path, "--lang", "fr"]);
    assert_eq!(unknown.status, 2);
    assert!(unknown.err.contains("en, de, es, zh"), "{}", unknown.err);
    // A file that the reader has to supply is named.
    let supplied = format!(
        r#"{{"fabrica":1,"subject":{{"sha256":"{}","name":"CT"}}}}"#,
        "a".repeat(64)
    );
    fabrica_with(folder.path(), &["describe", "-"], supplied.as_bytes())
        .failed(&["CT", "--subject"]);
}

#[test]
fn a_link_becomes_a_qr_code() {
    let folder = folder();
    let path = write(&folder, "peel.json", PEEL);
    let page = "https://fabrica.example/v/";
    let png = folder.path().join("code.PNG");
    let outcome = fabrica(&["link", text(&path), "--page", page, "--qr", text(&png)]).ok();
    assert_eq!(outcome.err, "", "nothing to say of a short link");
    let gray = image::open(&png).expect("a PNG").to_luma8();
    let (width, height) = (gray.width() as usize, gray.height() as usize);
    let mut prepared = rqrr::PreparedImage::prepare_from_greyscale(width, height, |x, y| {
        gray.get_pixel(x as u32, y as u32)[0]
    });
    let codes = prepared.detect_grids();
    assert_eq!(codes.len(), 1, "one code");
    let (_, read) = codes[0].decode().expect("a sound code");
    assert_eq!(read, outcome.out.trim());
    assert_eq!(
        fabrica(&["doc", &read]).ok().out,
        fabrica(&["doc", text(&path)]).ok().out
    );
    let svg = folder.path().join("code.svg");
    let bare = fabrica(&["link", text(&path), "--qr", text(&svg)]).ok();
    assert!(bare.err.contains("--page"), "{}", bare.err);
    let drawn = std::fs::read_to_string(&svg).expect("an SVG");
    assert!(
        drawn.starts_with("<svg ") && drawn.contains("viewBox"),
        "{drawn}"
    );
    // Digits that no model of text foresees make a link as long as wanted.
    let labels = |n: u64, words: u64| -> String {
        let word = |i: u64| {
            let i = (i + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
            let i = (i ^ (i >> 31)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            format!("{:016x}", i ^ (i >> 27))
        };
        let text = |i: u64| (0..words).map(|k| word(words * i + k)).collect::<String>();
        let all: Vec<String> = (0..n)
            .map(|i| format!(r#"{{"text":"{}"}}"#, text(i)))
            .collect();
        format!(r#"{{"fabrica":1,"labels":[{}]}}"#, all.join(","))
    };
    let args = ["link", "-", "--page", page, "--qr", text(&svg)];
    let dense = fabrica_with(folder.path(), &args, labels(140, 1).as_bytes()).ok();
    let length = dense.out.trim().len();
    assert!((1201..=2900).contains(&length), "{length}");
    assert!(dense.err.contains("above 1200"), "{}", dense.err);
    let before = std::fs::read(&svg).expect("an SVG");
    let long = labels(256, 2);
    let length = fabrica_with(folder.path(), &args[..4], long.as_bytes())
        .ok()
        .out
        .len();
    assert!(length > 2901, "{length}");
    fabrica_with(folder.path(), &args, long.as_bytes()).failed(&["2900", "document file"]);
    assert_eq!(
        std::fs::read(&svg).expect("an SVG"),
        before,
        "nothing is written"
    );
    let other = fabrica(&["link", text(&path), "--qr", "code.jpg"]);
    assert_eq!((other.status, other.out.as_str()), (2, ""), "{}", other.err);
    assert!(
        other.err.contains(".svg") && other.err.contains(".png"),
        "{}",
        other.err
    );
}

#[test]
fn the_catalogue_is_listed() {
    let catalogue: Value =
        serde_json::from_str(&fabrica(&["templates", "--json"]).ok().out).expect("JSON");
    let kinds = catalogue.as_array().expect("a list");
    assert_eq!(kinds.len(), 23);
    let param = |kind: &str, name: &str| {
        let kind = kinds.iter().find(|k| k["kind"] == kind).expect("the kind");
        let params = kind["params"].as_array().expect("params");
        params
            .iter()
            .find(|p| p["name"] == name)
            .expect("the parameter")
            .clone()
    };
    let progress = param("peel", "progress");
    assert_eq!(
        (&progress["default"], &progress["min"], &progress["max"]),
        (&json!(0.5), &json!(0.0), &json!(1.0))
    );
    assert_eq!(
        param("cut", "shape")["choices"],
        json!(["box", "sphere", "cylinder", "halfspace"])
    );
    assert_eq!(param("pull", "offset")["default"], json!([0.0, 0.0, 0.25]));
    assert_eq!(param("split", "wedge")["default"], json!(true));
    // A list says what is in it: every key that the reference has.
    let tools = param("sweep", "tools");
    assert_eq!((&tools["type"], &tools["max"]), (&json!("list"), &json!(4)));
    let reference = include_str!("../../src/document/reference.md");
    let (_, rows) = reference
        .split_once("`/templates/*/params/tools/*`\n")
        .expect("its section");
    let rows = rows.split("\n## ").next().unwrap_or_default();
    let mut wanted: Vec<&str> = rows
        .lines()
        .filter_map(|row| row.strip_prefix("| `")?.split('`').next())
        .collect();
    let mut listed: Vec<&str> = tools["of"]
        .as_array()
        .into_iter()
        .flatten()
        .filter_map(|key| key["name"].as_str())
        .collect();
    wanted.sort_unstable();
    listed.sort_unstable();
    assert_eq!(listed, wanted);
    let text = fabrica(&["templates"]).ok().out;
    for kind in kinds {
        assert!(
            text.contains(&format!("{}: ", kind["kind"].as_str().expect("a name"))),
            "{kind} is listed"
        );
    }
}

#[test]
fn info_says_what_a_file_holds() {
    let folder = folder();
    let path = write(&folder, "scan.nii", scan());
    let out = fabrica(&["info", text(&path)]).ok().out;
    for part in ["NIfTI", "16", "12", "8"] {
        assert!(out.contains(part), "“{part}” is not in {out}");
    }
    let bytes = scan();
    fabrica(&[
        "info",
        text(&write(&folder, "short.nii", &bytes[..bytes.len() / 2])),
    ])
    .failed(&["short.nii"]);
    fabrica(&["info", text(&write(&folder, "page.html", "<html>"))]).failed(&["page.html"]);
    fabrica(&["info", "nothing.nii"]).failed(&["nothing.nii"]);
}

#[test]
fn probing_follows_the_material() {
    let lines = |outcome: Outcome| -> Vec<Vec<f64>> {
        outcome
            .ok()
            .out
            .lines()
            .map(|line| {
                line.split(',')
                    .map(|n| n.parse().expect("a number"))
                    .collect()
            })
            .collect()
    };
    let folder = folder();
    let bare = write(&folder, "bare.json", r#"{"fabrica":1}"#);
    let points = b"0.1,0.2,0.3\n\n# a remark\n -0.5 , 0, 1e-3\r\n";
    let found = lines(fabrica_with(folder.path(), &["probe", text(&bare)], points));
    assert_eq!(found.len(), 2, "{found:?}");
    for row in &found {
        for axis in 0..3 {
            assert!(
                (row[axis] - row[axis + 3]).abs() < 1e-6,
                "no template is the identity: {row:?}"
            );
        }
        assert_eq!(row[6], 1.0, "and all is whole: {row:?}");
    }
    // A hole of radius 0.25 in a unit box: its middle is a gap, beside it material was pushed aside.
    let hole = write(
        &folder,
        "hole.json",
        r#"{"fabrica":1,"templates":[{"kind":"hole","size":[1,1,1]}],"steps":[{"set":{"/templates/0/params/amount":0}}]}"#,
    );
    let file = write(&folder, "points.csv", "0,0,0\n0.375,0,0\n");
    for args in [
        vec!["probe", text(&hole), "--points", text(&file)],
        vec!["probe", text(&hole), "--points", "-"],
    ] {
        let found = lines(fabrica_with(folder.path(), &args, b"0,0,0\n0.375,0,0\n"));
        assert!(
            (found[0][6] + 0.25).abs() < 1e-5,
            "A is -0.25 in the middle: {:?}",
            found[0]
        );
        assert!(
            (found[1][3] - 0.25).abs() < 1e-5,
            "half way between rim and edge comes from the middle: {:?}",
            found[1]
        );
        assert!((found[1][6] - 0.125).abs() < 1e-5, "{:?}", found[1]);
    }
    let closed = lines(fabrica_with(
        folder.path(),
        &["probe", text(&hole), "--step", "1"],
        b"0.375,0,0\n",
    ));
    assert!(
        (closed[0][3] - 0.375).abs() < 1e-6,
        "step 1 closes it: {closed:?}"
    );
    let half = lines(fabrica_with(
        folder.path(),
        &["probe", text(&hole), "--step", "1", "--time", "0.5"],
        b"0,0,0\n",
    ));
    assert!(
        (half[0][6] + 0.125).abs() < 1e-5,
        "half way there: {half:?}"
    );
    fabrica_with(folder.path(), &["probe", text(&hole)], b"0,0,0\n0,nan,0\n")
        .failed(&["standard input, line 2", "0,nan,0"]);
    fabrica_with(folder.path(), &["probe", text(&hole)], b"0,0\n").failed(&["line 1"]);
    fabrica_with(
        folder.path(),
        &["probe", text(&hole), "--points", "none.csv"],
        b"",
    )
    .failed(&["none.csv"]);
    fabrica_with(
        folder.path(),
        &["probe", text(&hole), "--step", "2"],
        b"0,0,0\n",
    )
    .failed(&["no step 2"]);
}

#[test]
fn probing_the_object_reads_the_scan() {
    let folder = folder();
    let bytes = scan();
    write(&folder, "scan.nii", &bytes);
    write(
        &folder,
        "parts.nii",
        nifti([16, 12, 8], |x, _, _| i16::from(x >= 8)),
    );
    let document = json!({ "fabrica": 1, "subject": { "src": "scan.nii", "sha256": hash(&bytes), "segments": { "src": "parts.nii", "names": { "1": "right, half" } } },
        "templates": [{ "kind": "cut", "at": [0.4, 0, 0], "size": [0.1, 1, 1] }] });
    let path = write(&folder, "scan.json", document.to_string());
    // 16 voxels are one unit; the centre of voxel (4, 6, 4) lies at ((4 − 7.5)/16, 0.5/16, 0.5/16).
    let out = fabrica_with(
        Path::new("/"),
        &["probe", text(&path), "--object"],
        b"-0.21875,0.03125,0.03125\n0.21875,0.03125,0.03125\n0.4,0,0\n2,0,0\n",
    )
    .ok()
    .out;
    let rows: Vec<&str> = out.lines().collect();
    assert!(
        rows[0].ends_with(",210,"),
        "value 4·50 + 6 + 4, no segment: {}",
        rows[0]
    );
    assert!(
        rows[1].ends_with(",560,\"right, half\""),
        "value 11·50 + 6 + 4 in the named half: {}",
        rows[1]
    );
    assert!(rows[2].ends_with(",,"), "the cut is empty: {}", rows[2]);
    assert!(
        rows[3].ends_with(",,"),
        "and so is the outside: {}",
        rows[3]
    );
}

/// An OBJ of a box around a point, mm.
fn box_obj(name: &str, middle: [f32; 3], half: f32) -> String {
    let mut text = format!("o {name}\n");
    for i in 0..8 {
        let sign = |bit: u32| if i >> bit & 1 == 1 { half } else { -half };
        let [x, y, z] = [0, 1, 2].map(|k| middle[k as usize] + sign(k));
        text += &format!("v {x} {y} {z}\n");
    }
    let faces = [
        "1 3 4 2", "1 2 6 5", "3 7 8 4", "1 5 7 3", "2 4 8 6", "5 6 8 7",
    ];
    for face in faces {
        text += &format!("f {face}\n");
    }
    text
}

#[test]
fn rays_meet_what_a_page_says() {
    let folder = folder();
    write(&folder, "box.obj", box_obj("box", [0.0; 3], 50.0));
    // One unit is the box's side. Rays along -z, from above.
    let cases = [
        (
            r##""look":{"layers":[{"depth":0,"name":"rind","color":"#b8433a"},{"depth":0.1,"name":"flesh","color":"#f2e3b3"}]}"##,
            "0,0,2,0,0,-3",
            "1.5",
            "surface,box,#d8cdbd",
        ),
        // What the ray begins in is a cut face, here a layer.
        (
            r##""look":{"layers":[{"depth":0,"name":"rind","color":"#b8433a"},{"depth":0.1,"name":"flesh","color":"#f2e3b3"}]}"##,
            "0,0,0,0,0,-1",
            "0",
            "cut,flesh,#f2e3b3",
        ),
        (
            r##""look":{"body":"hollow","inside":"#102030"}"##,
            "0,0,0,0,0,-1",
            "0.5",
            "inside,box,#102030",
        ),
        (
            r##""look":{"body":"thick","thickness":0.1,"inside":"#405060"}"##,
            "0,0,0,0,0,-1",
            "0.4",
            "cut,box,#405060",
        ),
        // Half clear: the far side is the one behind which a ray is more than half opaque.
        (
            r##""look":{"body":"hollow","segments":{"box":{"opacity":0.4}},"inside":"#102030"}"##,
            "0,0,2,0,0,-1",
            "2.5",
            "inside,box,#102030",
        ),
    ];
    for (look, ray, distance, end) in cases {
        let json = format!(
            r#"{{"fabrica":1,"subject":{{"src":"box.obj","name":"box","axes":"ras"}},{look}}}"#
        );
        write(&folder, "box.json", json);
        let input = format!("# a ray\n{ray}\n5,5,5,0,0,1\n");
        let out = fabrica_with(
            folder.path(),
            &["probe", "box.json", "--rays"],
            input.as_bytes(),
        )
        .ok()
        .out;
        let lines: Vec<&str> = out.lines().collect();
        let columns: Vec<&str> = lines[0].split(',').collect();
        assert_eq!(columns.len(), 19, "{}", lines[0]);
        assert_eq!(columns[..6].join(","), ray, "the ray as it was given");
        let found: f32 = columns[6].parse().expect("a number");
        let expected: f32 = distance.parse().expect("a number");
        assert!((found - expected).abs() < 1e-4, "{look}: {}", lines[0]);
        assert_eq!(columns[16..].join(","), end, "{look}");
        assert_eq!(
            lines[1],
            format!("5,5,5,0,0,1,{}", ",".repeat(12)),
            "nothing is there"
        );
    }
    // Without its upper face a lid closes the box where it is to be full, and a notice says so.
    let open = box_obj("box", [0.0; 3], 50.0).replace("f 5 6 8 7\n", "");
    write(&folder, "open.obj", open);
    let lid = "look: “box” is open; a lid closes its solid body";
    for (body, distance, end, has_lid) in [
        ("solid", 1.5, "cut,rind,#b8433a", true),
        ("auto", 2.5, "inside,box,#405060", false),
    ] {
        let json = format!(
            r##"{{"fabrica":1,"subject":{{"src":"open.obj","name":"box","axes":"ras"}},"look":{{"body":"{body}","inside":"#405060",
                "layers":[{{"depth":0,"name":"rind","color":"#b8433a"}},{{"depth":0.6,"color":"#f2e3b3"}}]}}}}"##
        );
        write(&folder, "open.json", json);
        let ray = b"0.2,0.3,2,0,0,-1\n";
        let ran = fabrica_with(folder.path(), &["probe", "open.json", "--rays"], ray).ok();
        let columns: Vec<&str> = ran.out.trim_end().split(',').collect();
        let found: f32 = columns[6].parse().expect("a number");
        assert!((found - distance).abs() < 2e-3, "{body}: {}", ran.out);
        assert_eq!(columns[16..].join(","), end, "{body}");
        assert_eq!(ran.err.contains(lid), has_lid, "{body}: {}", ran.err);
    }
    let bad = |input: &[u8], what: &[&str]| {
        fabrica_with(folder.path(), &["probe", "box.json", "--rays"], input).failed(what);
    };
    bad(b"0,0,0,1,1\n", &["line 1", "six finite numbers"]);
    bad(b"0,0,0,0,0,0\n", &["ray 1", "no length"]);
}

#[test]
fn rays_meet_objects() {
    let folder = folder();
    write(&folder, "box.obj", box_obj("box", [0.0; 3], 50.0));
    write(&folder, "tool.obj", box_obj("tool", [0.0, 0.0, 90.0], 10.0));
    let probe = |objects: &str, ray: &str| {
        let json = format!(
            r#"{{"fabrica":1,"subject":{{"src":"box.obj","axes":"ras"}},"objects":[{objects}]}}"#
        );
        write(&folder, "scene.json", json);
        fabrica_with(
            folder.path(),
            &["probe", "scene.json", "--rays"],
            ray.as_bytes(),
        )
    };
    let columns = |ran: &Outcome| -> (f32, String) {
        let columns: Vec<&str> = ran.out.trim_end().split(',').collect();
        let distance = columns[6].parse().expect("a number");
        (distance, columns[16..].join(","))
    };
    // Where its file says, in the subject's millimetres: one unit is 100 of them.
    let own = r##"{"src":"tool.obj","name":"knife","axes":"ras","color":"#3366cc"}"##;
    let ran = probe(own, "0,0,2,0,0,-1\n").ok();
    let (distance, end) = columns(&ran);
    assert!((distance - 1.0).abs() < 1e-4, "{}", ran.out);
    assert_eq!(end, "object,knife,#3366cc");
    // Beside it the subject is met as before.
    assert_eq!(
        columns(&probe(own, "0.3,0.3,2,0,0,-1\n").ok()).1,
        "surface,surface,#d8cdbd"
    );
    // With a place of its own, and from inside of it.
    let placed = r##"{"src":"tool.obj","at":[0,0,0.8],"size":0.4,"inside":"#102030"}"##;
    let (distance, end) = columns(&probe(placed, "0,0,2,0,0,-1\n").ok());
    assert!((distance - 1.0).abs() < 1e-4);
    assert_eq!(end, "object,object 1,#d8cdbd");
    let (distance, end) = columns(&probe(placed, "0,0,0.8,0,0,-1\n").ok());
    assert!((distance - 0.2).abs() < 1e-4);
    assert_eq!(end, "object,object 1,#102030");
    // What is not there is named and left out; what is no mesh is an error.
    let ran = probe(r#"{"src":"gone.obj","name":"saw"}"#, "0,0,2,0,0,-1\n").ok();
    assert!(
        ran.err.contains("“saw” is not there, and it is left out"),
        "{}",
        ran.err
    );
    assert_eq!(columns(&ran).1, "surface,surface,#d8cdbd");
    write(
        &folder,
        "scan.nrrd",
        "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 2 2 2\nencoding: ascii\n\n1 2 3 4 5 6 7 8\n",
    );
    probe(r#"{"src":"scan.nrrd"}"#, "0,0,2,0,0,-1\n")
        .failed(&["scan.nrrd", "a scan, not a surface mesh"]);
    write(&folder, "bad.obj", "v 0 0 0\nf 1 2 3\n");
    probe(r#"{"src":"bad.obj"}"#, "0,0,2,0,0,-1\n").failed(&["bad.obj", "line 2"]);
}

/// Tools of sweeps and of clays are meshes from beside the document, or given by their hash.
#[test]
fn tools_may_be_meshes() {
    let folder = folder();
    let block = box_obj("block", [7.0; 3], 10.0);
    write(&folder, "block.obj", &block);
    let sweep = |file: &str| {
        let text = r#"{ "fabrica": 1, "subject": { "builtin": "cube" }, "templates": [{ "kind": "sweep",
            "size": [1, 1, 1], "params": { "tools": [{ "shape": "mesh", FILE, "longest": 0.2, "coat": 0.2,
            "path": [[0.5, 0.5, 0.2], [0.5, 0.5, 0.7]] }] } }] }"#;
        write(&folder, "sweep.json", text.replace("FILE", file));
    };
    let probe = |args: &[&str]| {
        let args = [&["probe", "sweep.json"], args].concat();
        fabrica_with(folder.path(), &args, b"0.05,-0.05,0.25\n").ok()
    };
    let is_moved = |out: &str| {
        let source: Vec<f32> = out
            .trim()
            .split(',')
            .map(|n| n.parse().expect("a number"))
            .collect();
        let [.., z, _] = source[..] else {
            panic!("{out}")
        };
        (z + 0.25).abs() < 1e-3
    };
    sweep(r#""src": "block.obj""#);
    let told = probe(&[]);
    assert!(
        is_moved(&told.out) && !told.err.contains("tool"),
        "{} {}",
        told.out,
        told.err
    );
    let hash = hash(block.as_bytes());
    sweep(&format!(r#""sha256": "{hash}", "name": "Block""#));
    assert!(is_moved(&probe(&["--mesh", "block.obj"]).out));
    let gone = probe(&[]);
    assert!(!is_moved(&gone.out), "{}", gone.out);
    assert!(
        gone.err.contains("tool “Block”") && gone.err.contains(&hash),
        "{}",
        gone.err
    );
    sweep(&format!(
        r#""src": "block.obj", "sha256": "{}""#,
        "0".repeat(64)
    ));
    let wrong = fabrica_with(folder.path(), &["probe", "sweep.json"], b"0,0,0\n");
    wrong.failed(&["block.obj", "another file than the document means"]);
    // Without its upper side it is a sheet.
    let lines: Vec<&str> = block.lines().collect();
    write(&folder, "block.obj", lines[..lines.len() - 1].join("\n"));
    sweep(r#""src": "block.obj""#);
    let told = probe(&[]);
    assert!(told.err.contains("as a tool it is a sheet"), "{}", told.err);
    write(&folder, "block.obj", &block);
    let clay = r#"{ "fabrica": 1, "subject": { "clay": { "detail": 0.05, "tools": [
        { "shape": "mesh", "src": "block.obj", "longest": 0.2 }, { "shape": "clay", "strokes": 1, "longest": 0.3 }],
        "strokes": [{ "path": [0, 0, 700, 0, 0, -200] }, { "tool": 1, "path": [700, 0, 0, -200, 0, 0] }] } } }"#;
    write(&folder, "clay.json", clay);
    let check = || {
        let args = ["clay", "clay.json", "--check", "--json"];
        let told = fabrica_with(folder.path(), &args, b"").ok();
        let check: Value = serde_json::from_str(&told.out).expect("JSON");
        assert_eq!(
            (&check["euler"], &check["border_edges"]),
            (&json!(2), &json!(0))
        );
        (check["sha256"].clone(), told.err)
    };
    let (with, told) = check();
    assert_eq!(told, "");
    assert_eq!(check().0, with, "it is the same every time");
    fabrica_with(folder.path(), &["info", "clay.json"], b"").ok();
    std::fs::remove_file(folder.path().join("block.obj")).expect("it was there");
    let (without, told) = check();
    assert_ne!(with, without);
    assert!(
        told.contains("block.obj") && told.contains("stroke 1 holds nothing"),
        "{told}"
    );
}

#[test]
fn several_meshes_are_one_subject() {
    let folder = folder();
    let inner = box_obj("inner", [0.0; 3], 10.0);
    write(&folder, "inner.obj", &inner);
    write(&folder, "outer.obj", box_obj("outer", [0.0; 3], 50.0));
    std::fs::create_dir(folder.path().join("far")).expect("a folder");
    write(
        &folder,
        "far/beside.obj",
        box_obj("beside", [100.0, 0.0, 0.0], 20.0),
    );
    let document = |meshes: &str, more: &str| {
        let json = format!(
            r#"{{"fabrica":1,"subject":{{"meshes":[{meshes}]{more}}},"look":{{"body":"solid"}}}}"#
        );
        write(&folder, "several.json", json)
    };
    let probe = |args: &[&str], points: &str| {
        let args = [&["probe", "several.json", "--object", "--depth"], args].concat();
        fabrica_with(folder.path(), &args, points.as_bytes())
    };
    let three = r#"{"src":"inner.obj","name":"heart","axes":"ras"},{"src":"outer.obj","name":"skin","axes":"ras"},{"src":"far/beside.obj","name":"beside","axes":"ras"}"#;
    document(three, "");
    // From -50 to 120 mm: the origin lies at 35 mm, one unit is 170 mm.
    let out = probe(&[], "-0.20588236,0,0\n-0.3,0,0\n0.38235295,0,0\n")
        .ok()
        .out;
    let ends: Vec<Vec<&str>> = out
        .lines()
        .map(|line| line.split(',').skip(7).collect())
        .collect();
    assert_eq!(ends[0][1], "heart", "listed first: {out}");
    assert_eq!(ends[1][1], "skin", "{out}");
    assert_eq!(ends[2][1], "beside", "{out}");
    let depth: f32 = ends[0][2].parse().expect("a number");
    assert!(
        (depth - 50.0 / 170.0).abs() < 1e-4,
        "the greatest depth: {depth}"
    );
    // A box that the document gives holds everything in place, also where a mesh is missing.
    let boxed = r#","box":[-50,-50,-50,50,50,50]"#;
    document(&three.replace("far/beside", "far/none"), boxed);
    let there = probe(&[], "0,0,0\n").ok();
    assert!(
        there.err.contains("not there are left out: beside"),
        "{}",
        there.err
    );
    assert!(there.out.contains(",heart,"), "{}", there.out);
    document(&three.replace("far/beside", "far/none"), "");
    probe(&[], "0,0,0\n").failed(&["beside", "subject.box"]);
    // By hash, as the reader supplies it.
    let hashed = format!(
        r#"{{"sha256":"{}","name":"heart","axes":"ras"}}"#,
        hash(inner.as_bytes())
    );
    document(
        &format!(r#"{{"src":"outer.obj","name":"skin","axes":"ras"}},{hashed}"#),
        "",
    );
    let given = probe(&["--mesh", "inner.obj"], "0,0,0.45\n").ok().out;
    assert!(given.contains(",skin,"), "{given}");
    document(&hashed, "");
    let given = probe(&["--mesh", "inner.obj"], "0,0,0\n").ok().out;
    assert!(given.contains(",heart,"), "{given}");
    probe(&[], "0,0,0\n").failed(&["heart"]);
}

/// What a step does to a tool is seen under way, what the tool carves goes with it, and a link says the same.
#[test]
fn a_tool_moves_by_steps_and_carves_where_it_is() {
    let folder = folder();
    write(&folder, "box.obj", box_obj("box", [0.0; 3], 50.0));
    write(&folder, "tool.obj", box_obj("tool", [0.0; 3], 10.0));
    let document = |at: [f64; 3], steps: Value| {
        let tool =
            json!({ "src": "tool.obj", "name": "tool", "axes": "ras", "at": at, "size": 0.3 });
        json!({ "fabrica": 1, "subject": { "src": "box.obj", "axes": "ras" }, "objects": [tool],
            "templates": [{ "kind": "carve", "params": { "object": "tool", "push": 0.05, "reach": 0.2 } }],
            "camera": { "rotate": [0.3, 0.2, 0.1, 0.92] }, "steps": steps })
        .to_string()
    };
    let steps = json!([{ "set": { "/objects/0/at": [0, 0, 0.5] }, "seconds": 2 }]);
    write(&folder, "moving.json", document([0.0, 0.0, 0.8], steps));
    write(&folder, "still.json", document([0.0, 0.0, 0.65], json!([])));
    let half = ["--step", "1", "--time", "1"];
    let probe = |args: &[&str], input: &str| -> Vec<f32> {
        let args = [&["probe", "moving.json"], args].concat();
        let out = fabrica_with(folder.path(), &args, input.as_bytes())
            .ok()
            .out;
        let numbers = out
            .trim_end()
            .split(',')
            .map_while(|text| text.parse().ok());
        numbers.collect()
    };
    // Its upper face from above, and its lower one over tissue that gives way. A cell of it is 0.3/128.
    let ray = probe(&[&["--rays"], &half[..]].concat(), "0,0,2,0,0,-1\n");
    assert!((ray[6] - 1.2).abs() < 1e-4, "{ray:?}");
    for (moment, away) in [(&half[..], 0.06), (&half[..2], -0.09)] {
        let found = probe(moment, "0.02,0.01,0.44\n");
        assert!((found[6] - away).abs() < 0.0012, "{moment:?}: {found:?}");
        // Inside of the tool is a gap; beside it tissue is pushed in by `push`, less with the distance.
        let risen = found[5] - 0.44;
        let is_right = away < 0.0 || (risen - 0.05 * (1.0 - away / 0.2)).abs() < 0.0012;
        assert!(is_right, "{moment:?}: {found:?}");
    }
    let draw = |what: &str, name: &str, moment: &[&str]| {
        let args = [
            "render",
            what,
            "-o",
            name,
            "--size",
            "64x48",
            "--samples",
            "1",
        ];
        fabrica_with(folder.path(), &[&args, moment].concat(), b"").ok();
        image::open(folder.path().join(name))
            .expect("a PNG")
            .to_rgba8()
    };
    // By its link, as a reader opens it.
    let link = fabrica_with(folder.path(), &["link", "moving.json"], b"")
        .ok()
        .out;
    let under_way = draw(link.trim(), "way.png", &half);
    let still = draw("still.json", "still.png", &[]);
    assert_eq!(under_way, still, "half way it is in the middle");
}

/// Corners of a binary STL.
fn corners_of(stl: &[u8]) -> Vec<[f32; 3]> {
    let number = |bytes: &[u8]| f32::from_le_bytes(bytes.try_into().expect("four bytes"));
    let corner = |bytes: &[u8]| std::array::from_fn(|i| number(&bytes[4 * i..4 * i + 4]));
    let triangles = stl[84..].chunks_exact(50);
    triangles
        .flat_map(|triangle| triangle[12..48].chunks_exact(12).map(corner))
        .collect()
}

/// Five bones of a leg under one bend: the talus that is kept stays to the bit, and no other bone gets into it.
#[test]
fn one_of_five_bones_is_kept() {
    let Some(data) = data_folder("one of five bones is kept") else {
        return;
    };
    let folder = folder();
    let names = ["cuboid", "navicular", "patella", "phalanges", "talus"];
    let bounds = |corners: &[[f32; 3]]| -> [[f32; 2]; 3] {
        std::array::from_fn(|axis| {
            let along = corners.iter().map(|corner| corner[axis]);
            [
                along.clone().fold(f32::INFINITY, f32::min),
                along.fold(f32::NEG_INFINITY, f32::max),
            ]
        })
    };
    let (mut all, mut meshes) = (Vec::new(), Vec::new());
    let mut talus = Vec::new();
    for name in names {
        let bytes = std::fs::read(data.join(format!("mesh/vhf_left_{name}.stl"))).expect("a bone");
        talus = corners_of(&bytes);
        all.extend(&talus);
        write(&folder, &format!("{name}.stl"), bytes);
        meshes.push(json!({ "src": format!("{name}.stl"), "name": name }));
    }
    let (all, talus) = (bounds(&all), bounds(&talus));
    let unit = all.iter().map(|[low, high]| high - low).fold(0.0, f32::max);
    // The middle of everything is the origin; points in the box of the talus and around it.
    let mut random = Random(14);
    let mut points = String::new();
    for _ in 0..3000 {
        let place: [f32; 3] = std::array::from_fn(|axis| {
            let ([low, high], [least, most]) = (talus[axis], all[axis]);
            let grown = 0.15 * (high - low);
            (random.between(low - grown, high + grown) - 0.5 * (least + most)) / unit
        });
        points += &format!("{},{},{}\n", place[0], place[1], place[2]);
    }
    // Through the middle of the talus.
    let at: [f32; 3] = std::array::from_fn(|axis| {
        let ([low, high], [least, most]) = (talus[axis], all[axis]);
        (0.5 * (low + high) - 0.5 * (least + most)) / unit
    });
    let probe = |templates: Value| -> Vec<Vec<String>> {
        let document = json!({ "fabrica": 1, "subject": { "meshes": meshes }, "look": { "body": "solid" }, "templates": templates });
        write(&folder, "leg.json", document.to_string());
        let args = ["probe", "leg.json", "--object"];
        let out = fabrica_with(folder.path(), &args, points.as_bytes())
            .ok()
            .out;
        let lines = out
            .lines()
            .map(|line| line.split(',').map(str::to_owned).collect());
        lines.collect()
    };
    let bend =
        json!({ "kind": "bend", "at": at, "size": [0.5, 0.5, 0.5], "params": { "angle": 0.8 } });
    let mut keeping = bend.clone();
    keeping["align"] = json!({ "to": "segment", "keep": ["talus"] });
    let (plain, bent, kept) = (
        probe(json!([])),
        probe(json!([bend])),
        probe(json!([keeping])),
    );
    let (mut inside, mut would_move, mut others) = (0, 0, 0);
    for ((plain, bent), kept) in plain.iter().zip(&bent).zip(&kept) {
        if plain[8] == "talus" {
            inside += 1;
            would_move += usize::from(bent[3..6] != plain[3..6]);
            assert_eq!(
                kept[3..],
                plain[3..],
                "it stays to the bit, and alone: {}",
                kept[..3].join(",")
            );
        } else {
            assert_ne!(
                kept[8],
                "talus",
                "nothing of it is elsewhere: {}",
                kept[..3].join(",")
            );
            others += usize::from(kept[3..6] != plain[3..6]);
        }
    }
    println!("{inside} points in the talus, {would_move} would move; {others} beside it do");
    assert!(inside > 300 && would_move > 250 && others > 250);
}

/// The outer faces of voxels with a label as a binary STL, mm, for voxels of 1 mm about the origin.
fn faces_of(dims: [i16; 3], is_in: impl Fn([i16; 3]) -> bool, shift: f32) -> Vec<u8> {
    let mut triangles = Vec::new();
    for z in 0..dims[2] {
        for y in 0..dims[1] {
            for x in 0..dims[0] {
                for side in (0..6_usize).filter(|_| is_in([x, y, z])) {
                    let (axis, step) = (side / 2, if side % 2 == 0 { -1 } else { 1 });
                    let mut beside = [x, y, z];
                    beside[axis] += step;
                    if is_in(beside) {
                        continue;
                    }
                    let corner = |u: f32, v: f32| {
                        let mut at = [0.0; 3];
                        at[axis] = 0.5 * f32::from(step);
                        at[(axis + 1) % 3] = u;
                        at[(axis + 2) % 3] = v;
                        let place = |k: usize| {
                            let middle = 0.5 * (f32::from(dims[k]) - 1.0);
                            f32::from([x, y, z][k]) - middle + at[k] + shift
                        };
                        [0, 1, 2].map(place)
                    };
                    let mut quad = [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)];
                    if step < 0 {
                        quad.reverse();
                    }
                    let [a, b, c, d] = quad.map(|(u, v)| corner(u, v));
                    triangles.extend([[a, b, c], [a, c, d]]);
                }
            }
        }
    }
    let mut stl = vec![0; 80];
    stl.extend((triangles.len() as u32).to_le_bytes());
    for triangle in triangles {
        stl.extend([0; 12]);
        let numbers = triangle.iter().flatten();
        stl.extend(numbers.flat_map(|number: &f32| number.to_le_bytes()));
        stl.extend([0; 2]);
    }
    stl
}

/// The faces of a label's voxels, laid beside its scan as a solid, are where the label is, peeled or not.
#[test]
fn a_mesh_of_a_label_lies_where_the_label_lies() {
    let dims = [24, 20, 16];
    // Two balls that overlap, so that the border is no box.
    let is_in = |[x, y, z]: [i16; 3]| {
        let square = |x: i16, y: i16, z: i16| i32::from(x * x + y * y + z * z);
        square(x - 10, y - 9, z - 8) < 30 || square(x - 15, y - 11, z - 7) < 20
    };
    let folder = folder();
    write(&folder, "scan.nii", nifti(dims, |x, y, z| 50 + x + y + z));
    write(
        &folder,
        "label.nii",
        nifti(dims, |x, y, z| i16::from(is_in([x, y, z]))),
    );
    write(&folder, "label.stl", faces_of(dims, is_in, 0.0));
    write(&folder, "aside.stl", faces_of(dims, is_in, 1.0));
    let mut points = Vec::new();
    for i in 0..14 * 14 * 14 {
        let at = [i % 14, i / 14 % 14, i / 196].map(|n| (f64::from(n) + 0.37) / 14.0 * 0.9 - 0.45);
        points.push(at);
    }
    let lines: String = points
        .iter()
        .map(|[x, y, z]| format!("{x},{y},{z}\n"))
        .collect();
    let segments = |mesh: &str, templates: &str| -> Vec<([f64; 3], String)> {
        let meshes = match mesh {
            "" => String::new(),
            src => format!(r#","meshes":[{{"src":"{src}","name":"copy"}}]"#),
        };
        let json = format!(
            r#"{{"fabrica":1,"subject":{{"src":"scan.nii","segments":{{"src":"label.nii","names":{{"1":"lump"}}}}{meshes}}},
                "look":{{"segments":{{"copy":{{"body":"solid"}}}}}},"templates":[{templates}]}}"#
        );
        write(&folder, "d.json", json);
        let args = ["probe", "d.json", "--object"];
        let out = fabrica_with(folder.path(), &args, lines.as_bytes())
            .ok()
            .out;
        let rows = out.lines().map(|line| {
            let cells: Vec<&str> = line.split(',').collect();
            let source = [3, 4, 5].map(|i| cells[i].parse().expect("a number"));
            (source, cells[8].to_owned())
        });
        rows.collect()
    };
    // 24 voxels are one unit.
    let to_border = |source: [f64; 3]| {
        let at: [f64; 3] =
            std::array::from_fn(|k| source[k] * 24.0 + 0.5 * (f64::from(dims[k]) - 1.0));
        let [x, y, z] = at.map(|place| place.round() as i16);
        let here = is_in([x, y, z]);
        let mut least = f64::INFINITY;
        for i in 0..125_i16 {
            let voxel = [x + i % 5 - 2, y + i / 5 % 5 - 2, z + i / 25 - 2];
            if is_in(voxel) != here {
                let away = |k: usize| ((at[k] - f64::from(voxel[k])).abs() - 0.5).max(0.0);
                let far = [0, 1, 2]
                    .map(away)
                    .iter()
                    .map(|d| d * d)
                    .sum::<f64>()
                    .sqrt();
                least = least.min(far);
            }
        }
        least
    };
    let peel = r#"{"kind":"peel","at":[0,0.1,0.1],"size":[0.7,0.6,0.5],"params":{"progress":0.6}}"#;
    let mut agree = 0;
    for templates in ["", peel] {
        let label = segments("", templates);
        let wrong = |mesh: &str| {
            let found = segments(mesh, templates);
            let pairs = label.iter().zip(&found);
            let firm = pairs.filter(|((source, _), _)| to_border(*source) > 0.5);
            let counts = firm.map(|((_, label), (_, found))| {
                let is_label = label == "lump";
                (
                    usize::from(is_label),
                    usize::from(is_label != (found == "copy")),
                )
            });
            counts.fold((0, 0), |(all, wrong), (a, w)| (all + a, wrong + w))
        };
        let (inside, off) = wrong("label.stl");
        assert!(inside > 20, "{inside} points lie deep in the label");
        assert_eq!(off, 0, "{templates}: the mesh is where the label is");
        agree += inside;
        let (_, off) = wrong("aside.stl");
        assert!(
            off > 3,
            "a mesh that is aside is told from one that is not: {off}"
        );
    }
    println!("{agree} points in the label and in the mesh");
}

#[test]
fn meshes_lie_beside_a_scan() {
    let folder = folder();
    write(
        &folder,
        "scan.nii",
        nifti([20, 20, 20], |x, _, _| if x == 0 { 50 } else { 100 }),
    );
    write(
        &folder,
        "parts.nii",
        nifti([20, 20, 20], |x, _, _| i16::from(x >= 10)),
    );
    // 20 mm are one unit.
    let inner = box_obj("inner", [0.0; 3], 3.0);
    write(&folder, "inner.obj", &inner);
    write(&folder, "outer.obj", box_obj("outer", [0.0; 3], 6.0));
    let point = "v 1 1 1\n".repeat(3) + "f 1 2 3\n";
    write(&folder, "point.obj", point);
    let document = |meshes: &str, look: &str| {
        let json = format!(
            r#"{{"fabrica":1,"subject":{{"src":"scan.nii","segments":{{"src":"parts.nii","names":{{"1":"right"}}}},
                "meshes":[{meshes}]}},"look":{{{look}}}}}"#
        );
        write(&folder, "d.json", json);
    };
    let probe = |args: &[&str], points: &str| {
        let args = [&["probe", "d.json"], args].concat();
        fabrica_with(folder.path(), &args, points.as_bytes())
    };
    let named =
        |src: &str, name: &str| format!(r#"{{"src":"{src}","name":"{name}","axes":"ras"}}"#);
    let solid = r#""body":"solid""#;
    // Hollow beside a scan, unless the document says otherwise; the one listed first decides.
    let both = [named("inner.obj", "heart"), named("outer.obj", "right")].join(",");
    document(&both, "");
    let scan = probe(&["--object"], "0.1,0,0\n").ok().out;
    assert!(scan.ends_with(",100,right\n"), "{scan}");
    document(&both, solid);
    let out = probe(&["--object", "--depth"], "0.1,0,0\n0.2,0,0\n0.4,0,0\n")
        .ok()
        .out;
    let ends: Vec<Vec<&str>> = out
        .lines()
        .map(|l| l.split(',').skip(7).collect())
        .collect();
    assert_eq!(
        [ends[0][1], ends[1][1], ends[2][1]],
        ["heart", "right 2", "right"],
        "{out}"
    );
    assert_eq!(ends[2][0], "100", "the scan around it");
    let depth = |i: usize| ends[i][2].parse::<f32>().expect("a number");
    assert!(
        (depth(0) - 0.2).abs() < 1e-4 && (depth(2) + 0.1).abs() < 1e-4,
        "{out}"
    );
    // A mesh has its name only, a number is the scan's label; two of one name are told apart.
    document(
        &[named("inner.obj", "a"), named("outer.obj", "a")].join(","),
        r#""segments":{"a 2":{"body":"solid"},"1":{"opacity":1}}"#,
    );
    let out = probe(&["--object"], "0.1,0,0\n0.2,0,0\n").ok();
    assert!(
        out.out.lines().all(|line| line.ends_with(",a 2")),
        "{}",
        out.out
    );
    assert!(
        !out.err.contains("segment"),
        "every name is known: {}",
        out.err
    );
    // Rays: around the scan, out of whose box a mesh may reach.
    write(&folder, "wide.obj", box_obj("wide", [0.0; 3], 12.0));
    document(&named("wide.obj", "box"), "");
    let rays = probe(&["--rays"], "0,0,2,0,0,-1\n").ok().out;
    let columns: Vec<&str> = rays.trim_end().split(',').collect();
    let t: f32 = columns[6].parse().expect("a number");
    assert!((t - 1.4).abs() < 1e-4, "{rays}");
    assert_eq!(columns[16..].join(","), "surface,box,#d8cdbd");
    // One that is not there is named, and the others are drawn; so by hash.
    document(
        &[named("none.obj", "lost"), named("outer.obj", "box")].join(","),
        solid,
    );
    let out = probe(&["--object"], "0.2,0,0\n").ok();
    assert!(out.out.ends_with(",box\n"), "{}", out.out);
    assert!(out.err.contains("“lost” is not there"), "{}", out.err);
    document(
        &[named("outer.obj", "box"), named("none.obj", "lost")].join(","),
        solid,
    );
    let out = probe(&["--object"], "0.2,0,0\n").ok();
    assert!(
        out.out.ends_with(",box\n") && out.err.contains("lost"),
        "{} {}",
        out.out,
        out.err
    );
    let hashed = format!(
        r#"{{"sha256":"{}","name":"heart","axes":"ras"}}"#,
        hash(inner.as_bytes())
    );
    document(&hashed, solid);
    let out = probe(&["--object"], "0.1,0,0\n").ok();
    assert!(out.out.ends_with(",100,right\n"), "{}", out.out);
    assert!(out.err.contains("“heart”"), "{}", out.err);
    let out = probe(&["--object", "--mesh", "inner.obj"], "0.1,0,0\n").ok();
    assert!(
        out.out.ends_with(",heart\n") && !out.err.contains("heart"),
        "{} {}",
        out.out,
        out.err
    );
    // What is no mesh, has no size, or is more than there may be.
    document(&named("parts.nii", "scan"), "");
    probe(&["--object"], "0,0,0\n").failed(&["parts.nii", "a scan, not a surface mesh"]);
    document(&named("point.obj", "point"), "");
    probe(&["--object"], "0,0,0\n").failed(&["point.obj"]);
    document(&vec![named("outer.obj", "box"); 65].join(","), "");
    probe(&["--object"], "0,0,0\n").failed(&["65", "64"]);
    // The link of such a document opens to the same.
    document(&both, solid);
    let link = fabrica_with(folder.path(), &["link", "d.json"], b"")
        .ok()
        .out;
    let back = fabrica_with(
        folder.path(),
        &["probe", link.trim(), "--object"],
        b"0.1,0,0\n",
    )
    .ok();
    assert!(back.out.ends_with(",heart\n"), "{}", back.out);
}

#[test]
fn subjects_are_found_or_named() {
    let folder = folder();
    let bytes = scan();
    let scan = write(&folder, "my scan.nii", &bytes);
    let probe = |document: Value, more: &[&str]| {
        let path = write(&folder, "d.json", document.to_string());
        let args: Vec<&str> = ["probe", text(&path), "--object"]
            .iter()
            .chain(more)
            .copied()
            .collect();
        fabrica_with(Path::new("/"), &args, b"0,0,0\n")
    };
    let value = "0,0,0,0,0,0,1,384,";
    for src in ["my scan.nii", "my%20scan.nii", text(&scan)] {
        assert_eq!(
            probe(json!({ "fabrica": 1, "subject": { "src": src } }), &[])
                .ok()
                .out
                .trim(),
            value,
            "{src}"
        );
    }
    probe(
        json!({ "fabrica": 1, "subject": { "src": "my scan.nii", "sha256": "0".repeat(64) } }),
        &[],
    )
    .failed(&["another file", &hash(&bytes)]);
    probe(
        json!({ "fabrica": 1, "subject": { "src": "https://example.org/a.nii" } }),
        &[],
    )
    .failed(&["https://example.org/a.nii", "--subject"]);
    probe(
        json!({ "fabrica": 1, "subject": { "src": "missing.nii" } }),
        &[],
    )
    .failed(&["missing.nii"]);
    let wanted = json!({ "fabrica": 1, "subject": { "sha256": hash(&bytes), "name": "CT head" } });
    probe(wanted.clone(), &[]).failed(&["CT head", "--subject"]);
    assert_eq!(
        probe(wanted, &["--subject", text(&scan)]).ok().out.trim(),
        value
    );
    let other = probe(
        json!({ "fabrica": 1, "subject": { "sha256": "1".repeat(64) } }),
        &["--subject", text(&scan)],
    )
    .ok();
    assert!(other.err.contains("another file"), "{}", other.err);
    probe(
        json!({ "fabrica": 1, "subject": { "builtin": "unicorn" } }),
        &[],
    )
    .failed(&["unicorn"]);
    assert_eq!(
        probe(
            json!({ "fabrica": 1, "subject": { "builtin": "unicorn" } }),
            &["--subject", text(&scan)]
        )
        .out
        .trim(),
        value
    );
}

/// The same as in the window (tests/app/assets.rs) and on the page (tests/browser/assets.rs).
#[test]
fn label_volumes_open_as_in_the_window() {
    let folder = folder();
    for (name, bytes) in segment_files::files() {
        write(&folder, name, bytes);
    }
    for case in segment_files::cases() {
        let keep: Vec<&str> = [case.segments, case.absent].concat();
        let document = json!({ "fabrica": 1, "subject": case.subject, "templates": [
            { "kind": "peel", "align": { "to": "segment", "keep": keep } }] });
        let path = write(&folder, "d.json", document.to_string());
        let args = ["probe", text(&path), "--object"];
        let outcome = fabrica_with(Path::new("/"), &args, b"0,0,0\n");
        if case.is_error {
            let says: Vec<&str> = case.says.iter().map(String::as_str).collect();
            outcome.failed(&says);
            continue;
        }
        let err = outcome.ok().err;
        let is_there = |name: &str| !err.contains(&format!("no segment “{name}”"));
        for name in case.segments {
            assert!(is_there(name), "{}: no “{name}”: {err}", case.name);
        }
        for name in case.absent {
            assert!(!is_there(name), "{}: “{name}”: {err}", case.name);
        }
        let is_said = |line: &str| case.says.iter().all(|part| line.contains(part));
        assert!(
            case.says.is_empty() || err.lines().any(is_said),
            "{}: {err}",
            case.name
        );
    }
}

/// A file given for the document's subject is taken all the same, one given beside it is an addition.
#[test]
fn given_files_are_taken_with_a_notice() {
    let folder = folder();
    let [(_, scan), (_, parts)] = segment_files::files();
    let scan_path = write(&folder, "mine.nii", &scan);
    let parts_path = write(&folder, "mine_parts.nii", &parts);
    let wanted = "1".repeat(64);
    let document =
        json!({ "fabrica": 1, "subject": { "sha256": wanted, "segments": { "sha256": wanted } } });
    let path = write(&folder, "d.json", document.to_string());
    let outcome = fabrica_with(
        Path::new("/"),
        &[
            "probe",
            text(&path),
            "--object",
            "--subject",
            text(&scan_path),
            "--segments",
            text(&parts_path),
        ],
        b"0.4,0,0\n",
    )
    .ok();
    let names_both = |line: &str| line.contains(&wanted) && line.contains(&hash(&scan));
    assert!(outcome.err.lines().any(names_both), "{}", outcome.err);
    assert!(outcome.err.contains("--segments FILE"), "{}", outcome.err);
    assert!(outcome.out.trim().ends_with("segment 2"), "{}", outcome.out);
}

#[test]
fn what_a_file_leaves_open_is_said() {
    let folder = folder();
    // Bare voxels, of which the ramp along x shows that the sizes were taken in order.
    let bytes: Vec<u8> = (0..24u8).flat_map(|i| [0, i % 4]).collect();
    let bare = write(&folder, "bare.raw", [&[9u8; 7][..], &bytes].concat());
    let out = fabrica(&["info", text(&bare)]);
    assert_eq!(out.status, 1, "without a layout the file is refused");
    assert!(out.err.contains("--raw"), "{}", out.err);
    let layout = "4x3x2,int16,big,1x1x2.5,skip=7";
    let out = fabrica(&["info", text(&bare), "--raw", layout]);
    assert_eq!(out.status, 0, "{}", out.err);
    for line in [
        "size: 4 × 3 × 2 voxels",
        "spacing: 1 × 1 × 2.5 mm",
        "values: 0 to 3",
    ] {
        assert!(out.out.contains(line), "{line}: {}", out.out);
    }
    let out = fabrica(&["info", text(&bare), "--raw", "5x3x2,int16"]);
    assert_eq!(out.status, 1, "too short for this");
    let out = fabrica(&["info", text(&bare), "--raw", "4x3x2"]);
    assert_eq!(out.status, 2, "no type");

    // Two volumes in one file: the document says which, the flag goes before it.
    let mut series = scan();
    let header: Vec<u8> = series.drain(..352).collect();
    let twice = series.iter().map(|byte| byte ^ 1).collect::<Vec<u8>>();
    let mut header = header;
    header[40] = 4;
    header[48] = 2;
    let file = write(&folder, "series.nii", [header, series, twice].concat());
    let values = |args: &[&str]| {
        let out = fabrica(&[&["info", text(&file)], args].concat());
        (out.status, out.out, out.err)
    };
    let (first, second) = (values(&["--frame", "1"]), values(&["--frame", "2"]));
    assert_eq!((first.0, second.0), (0, 0), "{} {}", first.2, second.2);
    assert_ne!(first.1, second.1, "another volume");
    assert_eq!(values(&[]).1, first.1, "the first by default");
    let third = values(&["--frame", "3"]);
    assert_eq!(third.0, 1);
    assert!(
        third.2.contains("volume 3 was asked for, the file has 2"),
        "{}",
        third.2
    );
    assert_eq!(values(&["--frame", "0"]).0, 2, "counted from 1");
}

#[test]
fn pictures_are_whole_or_not_there() {
    let folder = folder();
    write(
        &folder,
        "scan.nii",
        nifti([24, 24, 24], |x, y, z| {
            let r = [x, y, z]
                .iter()
                .map(|v| (f32::from(*v) - 11.5).powi(2))
                .sum::<f32>()
                .sqrt();
            if r < 9.0 { 300 } else { -1000 }
        }),
    );
    let document = json!({ "fabrica": 1, "subject": { "src": "scan.nii" },
        "look": { "transfer": [{ "value": 0, "opacity": 0 }, { "value": 100, "color": "#cc4433", "opacity": 1 }], "background": "#002244" },
        "templates": [{ "kind": "split", "size": [1, 1, 1], "params": { "amount": 0, "wedge": false } }],
        "steps": [{ "set": { "/templates/0/params/amount": 0.3 } }] });
    let path = write(&folder, "ball.json", document.to_string());
    let draw = |name: &str, more: &[&str]| {
        let args: Vec<&str> = [
            "render",
            text(&path),
            "-o",
            name,
            "--size",
            "64x48",
            "--samples",
            "1",
        ]
        .iter()
        .chain(more)
        .copied()
        .collect();
        fabrica_with(folder.path(), &args, b"").ok();
        image::open(folder.path().join(name))
            .expect("a PNG")
            .to_rgba8()
    };
    let whole = draw("whole.png", &[]);
    assert_eq!(whole.dimensions(), (64, 48));
    let middle = |image: &image::RgbaImage| image.get_pixel(32, 24).0;
    assert_eq!(
        whole.get_pixel(0, 0).0,
        [0, 0x22, 0x44, 255],
        "the background"
    );
    assert!(
        middle(&whole)[0] > middle(&whole)[2],
        "the red ball: {:?}",
        middle(&whole)
    );
    let open = draw("open.png", &["--step", "1"]);
    assert_eq!(
        middle(&open),
        [0, 0x22, 0x44, 255],
        "step 1 shows the background between the halves"
    );
    let under_way = draw("half.png", &["--step", "1", "--time", "0"]);
    assert_eq!(under_way, whole, "at second 0 it looks as before");
    let again = draw("again.png", &["--step", "1"]);
    assert_eq!(again, open, "the same twice");

    let outcome = fabrica_with(
        folder.path(),
        &["render", text(&path), "-o", "no/where.png"],
        b"",
    );
    outcome.failed(&["no/where.png", "nothing was written"]);
    fabrica_with(
        folder.path(),
        &[
            "render",
            text(&path),
            "-o",
            "x.png",
            "--adapter",
            "no such card",
        ],
        b"",
    )
    .failed(&["no such card"]);
    fabrica_with(
        folder.path(),
        &["render", text(&path), "-o", "x.png", "--step", "9"],
        b"",
    )
    .failed(&["no step 9"]);
    let mut names: Vec<String> = std::fs::read_dir(folder.path())
        .expect("the folder")
        .map(|entry| {
            entry
                .expect("an entry")
                .file_name()
                .to_string_lossy()
                .into_owned()
        })
        .collect();
    names.retain(|name| name.contains(".p"));
    names.sort();
    assert_eq!(
        names,
        ["again.png", "half.png", "open.png", "whole.png"],
        "nothing half-written is left"
    );
}

#[test]
fn the_software_adapter_is_said() {
    let outcome = fabrica_with(
        Path::new("."),
        &[
            "probe",
            "-",
            "--points",
            "/dev/null",
            "--adapter",
            "llvmpipe",
        ],
        b"{\"fabrica\":1}",
    )
    .ok();
    assert!(
        outcome.err.contains("notice: no graphics device in use"),
        "{}",
        outcome.err
    );
}

#[test]
fn a_window_without_a_display_is_an_error() {
    let mut command = Command::new(env!("CARGO_BIN_EXE_fabrica"));
    let output = command
        .args(["view", "#top"])
        .env_remove("DISPLAY")
        .env_remove("WAYLAND_DISPLAY")
        .output()
        .expect("the program runs");
    assert_eq!(
        output.status.code(),
        Some(1),
        "a bad link is refused before a window opens"
    );
}
