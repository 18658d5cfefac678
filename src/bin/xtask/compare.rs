//! `cargo xtask compare OLD NEW`: what two builds of the native program make of the same documents.
//!
//! Links, documents, the catalogue and probes are compared byte for byte, pictures value by value. The documents are
//! those of `web/gallery` with all their steps, and the golden links of `tests/links`. OLD and NEW may also be two
//! folders of pictures, as `cargo xtask bless` leaves them in `tests/snapshots`.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

use fabrica::document::Document;

use crate::run::{Outcome, fed, program, report, root};

/// Pictures are drawn this large: each takes a second or two on a software GPU, and there are some hundred of them.
const SIZE: &str = "120x90";
/// Points asked in each document.
const POINTS: usize = 300;

/// What a program is asked: a name, and the arguments and the input that make the answer.
struct Question {
    name: String,
    args: Vec<String>,
    input: String,
    is_picture: bool,
}

/// Compares two builds, or two folders of pictures; fails if anything differs.
pub(crate) fn compare(args: &[String]) -> Outcome {
    let [old, new] = args else {
        return Err(
            "compare takes OLD and NEW: two programs, or two folders of pictures".to_owned(),
        );
    };
    let (old, new) = (PathBuf::from(old), PathBuf::from(new));
    let differences = match (old.is_dir(), new.is_dir()) {
        (true, true) => folders(&old, &new)?,
        (false, false) => programs(&old, &new)?,
        _ => return Err("compare takes two programs or two folders, not one of each".to_owned()),
    };
    if differences.is_empty() {
        report("nothing differs");
        return Ok(());
    }
    Err(format!(
        "{} things differ:\n  {}",
        differences.len(),
        differences.join("\n  ")
    ))
}

fn programs(old: &Path, new: &Path) -> Result<Vec<String>, String> {
    let questions = questions()?;
    let mut differences = Vec::new();
    let (mut answers, mut pictures) = (0, 0);
    for question in &questions {
        let (one, other) = (answer(old, question)?, answer(new, question)?);
        if question.is_picture {
            pictures += 1;
        } else {
            answers += 1;
        }
        if one == other {
            continue;
        }
        let how = match (question.is_picture, &one, &other) {
            (true, Ok(one), Ok(other)) => match picture_difference(one, other)? {
                Some(how) => how,
                None => continue,
            },
            _ => text_difference(&one, &other),
        };
        report(&format!("{}: {how}", question.name));
        differences.push(format!("{}: {how}", question.name));
    }
    report(&format!(
        "{answers} answers and {pictures} pictures were compared"
    ));
    Ok(differences)
}

/// All questions, in a fixed order: texts first, then probes, then pictures.
fn questions() -> Result<Vec<Question>, String> {
    let ask = |name: String, args: &[&str], input: &str, is_picture: bool| Question {
        name,
        args: args.iter().map(|arg| (*arg).to_owned()).collect(),
        input: input.to_owned(),
        is_picture,
    };
    let mut texts = vec![
        ask("templates".to_owned(), &["templates"], "", false),
        ask(
            "templates --json".to_owned(),
            &["templates", "--json"],
            "",
            false,
        ),
    ];
    let (mut probes, mut pictures) = (Vec::new(), Vec::new());
    let read = |path: &Path| {
        fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))
    };
    let links = root().join("tests/links");
    for path in files(&links, "txt")? {
        for (i, line) in read(&path)?.lines().enumerate() {
            let Some(payload) = line
                .split_whitespace()
                .next()
                .filter(|word| !word.starts_with('#'))
            else {
                continue;
            };
            let name = format!("{} line {}", path.display(), i + 1);
            texts.push(ask(format!("doc of {name}"), &["doc", payload], "", false));
            texts.push(ask(
                format!("link of {name}"),
                &["link", payload],
                "",
                false,
            ));
        }
    }
    for path in files(&root().join("web/gallery"), "json")? {
        let text = read(&path)?;
        let name = path
            .file_stem()
            .unwrap_or_default()
            .to_string_lossy()
            .into_owned();
        let document =
            Document::from_json(&text).map_err(|error| format!("{}: {error}", path.display()))?;
        let file = path.display().to_string();
        for command in ["doc", "link"] {
            texts.push(ask(
                format!("{command} of {name}"),
                &[command, &file],
                "",
                false,
            ));
        }
        let points = points(&name);
        probes.push(ask(
            format!("probe of {name}"),
            &["probe", &file],
            &points,
            false,
        ));
        let args = ["probe", &file, "--object"];
        probes.push(ask(
            format!("probe --object of {name}"),
            &args,
            &points,
            false,
        ));
        for step in 0..=document.illustration().steps.len() {
            let step = step.to_string();
            let args = ["render", &file, "--size", SIZE, "--step", &step, "-o"];
            pictures.push(ask(
                format!("picture of {name}, step {step}"),
                &args,
                "",
                true,
            ));
        }
    }
    texts.append(&mut probes);
    texts.append(&mut pictures);
    Ok(texts)
}

fn files(folder: &Path, end: &str) -> Result<Vec<PathBuf>, String> {
    let entries = fs::read_dir(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let paths = entries.filter_map(|entry| Some(entry.ok()?.path()));
    let mut paths: Vec<PathBuf> = paths
        .filter(|path| path.extension().is_some_and(|e| e == end))
        .collect();
    paths.sort();
    Ok(paths)
}

/// Points in and around the subject's box, the same for a document each time (xorshift64).
fn points(name: &str) -> String {
    let mut state = name.bytes().fold(0x9e37_79b9_7f4a_7c15_u64, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    });
    let mut next = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 40) as f64 / f64::from(1 << 24) * 1.2 - 0.6
    };
    let mut text = String::new();
    for _ in 0..POINTS {
        let _infallible = writeln!(text, "{:.4},{:.4},{:.4}", next(), next(), next());
    }
    text
}

/// The answer of a program to a question: its output, the picture that it wrote, or its error.
fn answer(fabrica: &Path, question: &Question) -> Result<Result<Vec<u8>, String>, String> {
    let folder = root().join("target/compare");
    let picture = folder.join("picture.png");
    fs::create_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let _was_there = fs::remove_file(&picture);
    let mut command = program(fabrica);
    command.args(&question.args);
    if question.is_picture {
        command.arg(&picture);
    }
    let done = fed(&mut command, &question.input)?;
    if !done.status.success() {
        return Ok(Err(String::from_utf8_lossy(&done.stderr).trim().to_owned()));
    }
    if question.is_picture {
        return fs::read(&picture)
            .map(Ok)
            .map_err(|error| format!("{}: {error}", picture.display()));
    }
    // Notices are part of the output that is compared.
    Ok(Ok([done.stdout, done.stderr].concat()))
}

/// Where two texts part, and the largest difference of their numbers.
fn text_difference(one: &Result<Vec<u8>, String>, other: &Result<Vec<u8>, String>) -> String {
    let (Ok(one), Ok(other)) = (one, other) else {
        let shown = |answer: &Result<Vec<u8>, String>| match answer {
            Ok(_) => "an answer".to_owned(),
            Err(message) => format!("“{message}”"),
        };
        return format!("{} became {}", shown(one), shown(other));
    };
    let (one, other) = (String::from_utf8_lossy(one), String::from_utf8_lossy(other));
    let pairs: Vec<(&str, &str)> = one
        .lines()
        .zip(other.lines())
        .filter(|(a, b)| a != b)
        .collect();
    let numbers = pairs
        .iter()
        .flat_map(|(a, b)| a.split(',').zip(b.split(',')));
    let largest = numbers
        .filter_map(|(a, b)| {
            Some((a.trim().parse::<f64>().ok()? - b.trim().parse::<f64>().ok()?).abs())
        })
        .fold(0.0, f64::max);
    let first = pairs
        .first()
        .map_or_else(String::new, |(a, b)| format!("; the first: {a} | {b}"));
    format!(
        "{} of {} lines differ ({} lines became {}), numbers by up to {largest:e}{first}",
        pairs.len(),
        one.lines().count(),
        one.lines().count(),
        other.lines().count()
    )
}

/// How two PNG files differ in their values, or `None` if they do not.
fn picture_difference(one: &[u8], other: &[u8]) -> Result<Option<String>, String> {
    let (one, other) = (values(one)?, values(other)?);
    if one == other {
        return Ok(None);
    }
    if one.0 != other.0 {
        return Ok(Some(format!("{:?} pixels became {:?}", one.0, other.0)));
    }
    let steps: Vec<u8> = one
        .1
        .iter()
        .zip(&other.1)
        .map(|(a, b)| a.abs_diff(*b))
        .collect();
    let count = steps.iter().filter(|step| **step > 0).count();
    Ok(Some(format!(
        "{count} of {} values differ ({:.3} %), by up to {}/255",
        steps.len(),
        100.0 * count as f64 / steps.len() as f64,
        steps.iter().max().unwrap_or(&0)
    )))
}

/// Size and values of a PNG with 8 bits a channel.
pub(crate) fn values(bytes: &[u8]) -> Result<((u32, u32), Vec<u8>), String> {
    let mut reader = png::Decoder::new(std::io::Cursor::new(bytes))
        .read_info()
        .map_err(|error| format!("no PNG: {error}"))?;
    let size = reader.output_buffer_size().ok_or("a picture too large")?;
    let mut values = vec![0; size];
    let info = reader
        .next_frame(&mut values)
        .map_err(|error| format!("no PNG: {error}"))?;
    values.truncate(info.buffer_size());
    Ok(((info.width, info.height), values))
}

/// Compares the pictures of two folders that have the same paths below them.
fn folders(old: &Path, new: &Path) -> Result<Vec<String>, String> {
    fn pictures(folder: &Path, below: &str, found: &mut BTreeMap<String, PathBuf>) -> Outcome {
        let entries =
            fs::read_dir(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
        for path in entries.filter_map(|entry| Some(entry.ok()?.path())) {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            let name = format!("{below}{name}");
            if path.is_dir() {
                pictures(&path, &format!("{name}/"), found)?;
            } else if name.ends_with(".png") {
                found.insert(name, path);
            }
        }
        Ok(())
    }
    let (mut one, mut other) = (BTreeMap::new(), BTreeMap::new());
    pictures(old, "", &mut one)?;
    pictures(new, "", &mut other)?;
    let mut differences = Vec::new();
    for (name, path) in &one {
        let Some(there) = other.get(name) else {
            differences.push(format!("{name} is gone"));
            continue;
        };
        let read =
            |path: &Path| fs::read(path).map_err(|error| format!("{}: {error}", path.display()));
        if let Some(how) = picture_difference(&read(path)?, &read(there)?)? {
            differences.push(format!("{name}: {how}"));
        }
    }
    let added = other.keys().filter(|name| !one.contains_key(*name));
    differences.extend(added.map(|name| format!("{name} is new")));
    report(&format!("{} pictures were compared", one.len()));
    Ok(differences)
}
