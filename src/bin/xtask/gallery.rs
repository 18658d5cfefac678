//! `cargo xtask gallery`: every built-in subject from four sides, and every illustration of the gallery, drawn by the
//! native program into one page to look through.
//!
//! The gallery's documents are `web/gallery/*.json`: the page serves that folder, so that each opens as
//! `?doc=gallery/NAME.json`, and `fabrica view` opens the same files.

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use fabrica::document::{Document, newest_revision};
use fabrica::link;
use fabrica::subjects::{self, Generator};
use serde_json::{Value, json};

use crate::examples::documents;
use crate::run::{Outcome, cargo, fed, program, report, root, run};

/// Where `cargo xtask serve` shows the page.
const PAGE: &str = "http://127.0.0.1:8080/";

/// Samples per pixel.
const SAMPLES: u32 = 4;

/// The four sides: name, and degrees that the eye goes round from the front, to the subject's left first.
const SIDES: [(&str, f32); 4] = [
    ("front", 0.0),
    ("left", 90.0),
    ("back", 180.0),
    ("right", 270.0),
];

/// What the page of the gallery shall hold.
struct Wish {
    program: Option<PathBuf>,
    size_px: u32,
    only: Option<String>,
    page: String,
}

/// Draws the gallery into target/gallery.
pub(crate) fn gallery(args: &[String]) -> Outcome {
    let wish = read(args)?;
    let fabrica = native(wish.program.as_deref())?;
    let folder = root().join("target/gallery");
    fs::create_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let mut page = String::from(HEAD);
    let is_wanted = |name: &str| wish.only.as_deref().is_none_or(|only| name.contains(only));
    page.push_str("<h1>Gallery</h1>\n");
    for (name, document) in documents(root())? {
        if is_wanted(&name) {
            illustration(&mut page, &name, &document, &fabrica, &folder, &wish)?;
        }
    }
    page.push_str("<h1>Built-in subjects</h1>\n");
    for name in subjects::names() {
        if is_wanted(name) {
            sheet(&mut page, name, &fabrica, &folder, &wish)?;
        }
    }
    page.push_str("</html>\n");
    let index = folder.join("index.html");
    fs::write(&index, page).map_err(|error| format!("{}: {error}", index.display()))?;
    report(&format!("look at {}", index.display()));
    Ok(())
}

/// The native program that draws: the one that is given, else it is built.
pub(crate) fn native(given: Option<&Path>) -> Result<PathBuf, String> {
    if let Some(path) = given {
        return Ok(path.to_path_buf());
    }
    let mut command = cargo();
    command.args(["build", "--bin", "fabrica"]);
    run("build the native program", &mut command)?;
    Ok(root().join("target/debug/fabrica"))
}

fn read(args: &[String]) -> Result<Wish, String> {
    let mut wish = Wish {
        program: None,
        size_px: 384,
        only: None,
        page: PAGE.to_owned(),
    };
    let mut args = args.iter();
    while let Some(flag) = args.next() {
        let value = args
            .next()
            .ok_or_else(|| format!("{flag} needs something after it"))?;
        match flag.as_str() {
            "--program" => wish.program = Some(value.into()),
            "--only" => wish.only = Some(value.clone()),
            "--page" => wish.page.clone_from(value),
            "--size" => {
                wish.size_px = value
                    .parse()
                    .ok()
                    .filter(|size| (32..=4096).contains(size))
                    .ok_or("--size is 32 to 4096 pixels")?;
            }
            _ => {
                return Err(format!(
                    "gallery takes --size PIXELS, --only NAME, --program FILE and --page URL, not {flag}"
                ));
            }
        }
    }
    Ok(wish)
}

/// One illustration: its text, its link, a picture for every step.
fn illustration(
    page: &mut String,
    name: &str,
    document: &Document,
    fabrica: &Path,
    folder: &Path,
    wish: &Wish,
) -> Outcome {
    let shown = document.illustration();
    section(page, name, &shown.title, &shown.legend);
    for step in 0..=shown.steps.len() {
        let caption = match step.checked_sub(1) {
            None => "as it opens".to_owned(),
            Some(i) => format!("{step}. {}", shown.steps[i].title),
        };
        let file = format!("{name}-{step}.png");
        draw(
            fabrica,
            document,
            step,
            &folder.join(&file),
            [wish.size_px; 2],
            SAMPLES,
        )?;
        figure(page, document, step, &file, &caption, wish);
    }
    let _ = writeln!(
        page,
        "</div><p><small>{} · <a href=\"{}?doc=gallery/{name}.json\">document</a></small></p></section>",
        escaped(&shown.credit),
        escaped(&wish.page),
    );
    Ok(())
}

/// One subject from four sides: plain, peeled, laid bare and sliced.
fn sheet(page: &mut String, name: &str, fabrica: &Path, folder: &Path, wish: &Wish) -> Outcome {
    let header = Generator::new(name, subjects::MIN_RESOLUTION)
        .map_err(|error| error.to_string())?
        .header();
    let dims = header.grid.dims.as_vec3();
    let half = dims / (2.0 * dims.max_element());
    section(
        page,
        name,
        name,
        "Plain, peeled, laid bare and sliced, from four sides.",
    );
    let segments: Vec<String> = header
        .segmentation
        .iter()
        .flat_map(|segmentation| &segmentation.segments)
        .map(|segment| segment.name.clone())
        .collect();
    for (how, is_from_above) in [
        ("plain", false),
        ("peeled", true),
        ("bared", true),
        ("sliced", false),
    ] {
        for (side, angle_deg) in SIDES {
            let (width, depth) = if angle_deg % 180.0 == 0.0 {
                (half.x, half.y)
            } else {
                (half.y, half.x)
            };
            let templates = match how {
                "peeled" => {
                    let kept: Vec<&str> = segments
                        .iter()
                        .map(String::as_str)
                        .filter(|segment| !wrapping(name).contains(segment))
                        .collect();
                    json!([peel(name, angle_deg, width, half.z, depth, &kept)])
                }
                // A cut that takes everything, but for what it is told to keep.
                "bared" => {
                    let keep = json!({ "to": "segment", "keep": core(name) });
                    json!([{ "kind": "cut", "size": [3, 3, 3], "align": keep }])
                }
                "sliced" => {
                    json!([{ "kind": "cut", "at": middle(name), "rotate": facing(angle_deg), "params": { "shape": "halfspace" } }])
                }
                _ => json!([]),
            };
            // A little from the side and from above, so that the picture has depth.
            let camera = json!({
                "rotate": eye(
                    // Past the open door.
                    angle_deg + if how == "peeled" { -8.0 } else { 14.0 },
                    if is_from_above { 18.0 } else { 10.0 },
                ),
                // The cube fills its box; the others leave its corners free.
                "distance": match (name, how) {
                    ("cube", _) => 3.4,
                    (_, "peeled") => 3.1,
                    _ => 2.35,
                },
                // Between the subject and its open door.
                "target": match how {
                    "peeled" => {
                        let angle = angle_deg.to_radians();
                        rounded([-angle.cos() * 0.2, -angle.sin() * 0.2, 0.0])
                    }
                    _ => rounded([0.0; 3]),
                },
            });
            let document = made(name, &templates, &camera)?;
            let file = format!("{name}-{how}-{side}.png");
            draw(
                fabrica,
                &document,
                0,
                &folder.join(&file),
                [wish.size_px; 2],
                SAMPLES,
            )?;
            figure(page, &document, 0, &file, &format!("{how}, {side}"), wish);
        }
    }
    page.push_str("</div></section>\n");
    Ok(())
}

/// The tissue that is peeled off a subject.
fn wrapping(name: &str) -> &'static [&'static str] {
    match name {
        "bar" => &["shell"],
        "cube" => &["top", "middle"],
        "tomato" => &["skin", "flesh"],
        "piggybank" => &["wall", "eyes", "plug"],
        "head" => &["skin", "fat", "hair", "lips", "csf"],
        "hand" => &["skin", "fat", "nails"],
        "knee" => &["skin", "fat", "joint fluid"],
        _ => &["skin", "fat"],
    }
}

/// The tissue that is left when a subject is laid bare.
fn core(name: &str) -> &'static [&'static str] {
    match name {
        "bar" => &["core"],
        "cube" => &["ball", "bottom"],
        "tomato" => &["seeds", "core", "calyx"],
        "piggybank" => &["coins"],
        "head" => &["bone", "teeth", "cartilage"],
        "hand" => &[
            "bone",
            "cartilage",
            "tendons",
            "arteries",
            "veins",
            "nerves",
        ],
        "knee" => &[
            "femur",
            "tibia",
            "fibula",
            "patella",
            "cartilage",
            "menisci",
            "ligaments",
            "tendons",
        ],
        _ => &[
            "heart", "arteries", "veins", "bronchi", "liver", "stomach", "spleen", "pancreas",
            "kidneys", "ureters", "spine", "discs", "pelvis",
        ],
    }
}

/// One side opened as a door over most of its width, with `kept` left standing.
fn peel(name: &str, angle_deg: f32, width: f32, height: f32, depth: f32, kept: &[&str]) -> Value {
    // Far towards the middle: the part that comes off ends at kept tissue. A door, for so thick a layer rolls badly.
    let layer = depth * if name == "hand" { 0.9 } else { 0.62 };
    let out = depth * 1.04 - layer / 2.0;
    // Of the hand, what lies before its fingers bend forward.
    let out = if name == "hand" && angle_deg == 0.0 {
        out - 0.1
    } else {
        out
    };
    let angle = angle_deg.to_radians();
    json!({
        "kind": "flap",
        "at": rounded([-angle.sin() * out, angle.cos() * out, 0.0]),
        "rotate": facing(angle_deg),
        "size": rounded([width * 1.8, height * 1.5, layer]),
        "params": { "depth": 1.0, "angle": 2.4 },
        "align": { "to": "segment", "keep": kept },
    })
}

/// Where a subject is cut through: the middle of its box, but for the hand, which bends forward in its own.
fn middle(name: &str) -> Value {
    let forward = if name == "hand" { -0.055 } else { 0.0 };
    rounded([0.0, forward, 0.0])
}

/// Turns a template's z towards a side, its x to the left as one looks at it.
fn facing(angle_deg: f32) -> Value {
    let (s, c) = (angle_deg / 2.0).to_radians().sin_cos();
    let (r, t) = (
        -std::f32::consts::FRAC_1_SQRT_2,
        std::f32::consts::FRAC_1_SQRT_2,
    );
    rounded([c * r, s * r, s * t, c * t])
}

/// A camera that has gone round, then up.
fn eye(angle_deg: f32, up_deg: f32) -> Value {
    let (s, c) = (angle_deg / 2.0).to_radians().sin_cos();
    let (r, t) = (up_deg / 2.0).to_radians().sin_cos();
    rounded([c * r, s * r, s * t, c * t])
}

fn rounded<const N: usize>(numbers: [f32; N]) -> Value {
    numbers
        .iter()
        .map(|n| json!(fabrica::math::round_to(f64::from(*n), 4)))
        .collect()
}

fn made(name: &str, templates: &Value, camera: &Value) -> Result<Document, String> {
    let tree = json!({
        "fabrica": 1,
        "subject": { "builtin": name, "revision": newest_revision(name) },
        "templates": templates,
        "camera": camera,
    });
    Document::from_json(&tree.to_string()).map_err(|error| error.to_string())
}

/// The command that draws the document of a file at a step, without the file that it is to write.
pub(crate) fn render(
    fabrica: &Path,
    document: &Path,
    step: usize,
    [width, height]: [u32; 2],
    samples: u32,
) -> Command {
    let mut command = program(fabrica);
    command.arg("render").arg(document).args([
        "--size",
        &format!("{width}x{height}"),
        "--step",
        &step.to_string(),
        "--samples",
        &samples.to_string(),
    ]);
    command
}

/// Lets a command of [`render`] write its picture.
pub(crate) fn written(command: &mut Command, to: &Path) -> Outcome {
    let done = fed(command.arg("-o").arg(to), "")?;
    if !done.status.success() {
        let told = String::from_utf8_lossy(&done.stderr);
        return Err(format!("{}: {}", to.display(), told.trim()));
    }
    Ok(())
}

/// Draws a document at a step into a PNG of so many pixels.
pub(crate) fn draw(
    fabrica: &Path,
    document: &Document,
    step: usize,
    to: &Path,
    size_px: [u32; 2],
    samples: u32,
) -> Outcome {
    let from = to.with_extension("json");
    fs::write(&from, document.to_json()).map_err(|error| format!("{}: {error}", from.display()))?;
    let drawn = written(&mut render(fabrica, &from, step, size_px, samples), to);
    let _ = fs::remove_file(&from);
    drawn
}

fn section(page: &mut String, name: &str, title: &str, caption: &str) {
    let _ = writeln!(
        page,
        "<section id=\"{}\"><h2>{}</h2><p>{}</p><div>",
        escaped(name),
        escaped(title),
        escaped(caption)
    );
}

fn figure(
    page: &mut String,
    document: &Document,
    step: usize,
    file: &str,
    caption: &str,
    wish: &Wish,
) {
    let address = format!("{}{}", wish.page, link::fragment(document, step));
    let _ = writeln!(
        page,
        "<figure><a href=\"{}\"><img src=\"{}\" alt=\"{}\" width=\"{size}\" height=\"{size}\"></a><figcaption>{}</figcaption></figure>",
        escaped(&address),
        escaped(file),
        escaped(caption),
        escaped(caption),
        size = wish.size_px,
    );
}

/// Text as HTML shows it.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}

const HEAD: &str = "<!doctype html>
<html lang=\"en\"><meta charset=\"utf-8\"><title>Fabrica: gallery</title>
<style>
body { font: 16px/1.45 system-ui, sans-serif; margin: 2rem auto; max-width: 104rem; padding: 0 1rem; color: #222; }
section { margin: 2rem 0; } section > div { display: flex; flex-wrap: wrap; gap: 0.75rem; }
figure { margin: 0; } figure img { background: #fff; border: 1px solid #ddd; max-width: 100%; height: auto; }
figcaption { font-size: 0.85rem; color: #555; } p { max-width: 44rem; }
</style>
";
