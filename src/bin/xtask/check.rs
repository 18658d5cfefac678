//! What a change must pass before its tests: format, lints, docs. Also writes the files that are generated from the
//! source: the assembled shaders and the graph of imports.

use crate::house;
use crate::imports;
use crate::run::{Outcome, cargo, root, run};

/// A check: its name, and the arguments of cargo.
type Check = (&'static str, &'static [&'static str]);

/// What is checked without the page's target, fast to slow: the last two with the default features. Lints are errors
/// here.
const NATIVE: [Check; 6] = [
    ("format", &["fmt", "--check"]),
    (
        "lint, xtask",
        &[
            "clippy",
            "--no-default-features",
            "--features",
            "dev",
            "--bin",
            "xtask",
        ],
    ),
    (
        "lint, no features",
        &["clippy", "--no-default-features", "--lib"],
    ),
    (
        "lint, the session alone",
        &[
            "clippy",
            "--no-default-features",
            "--features",
            "session",
            "--lib",
        ],
    ),
    ("lint, native", &["clippy", "--all-targets"]),
    ("docs", &["doc", "--no-deps", "--document-private-items"]),
];

/// The page's programs, with their features; `None` for the default ones. The parts that run in workers share theirs.
const PAGE: [(&str, Option<&str>, &[&str]); 3] = [
    ("lint, page", None, &["fabrica"]),
    ("lint, the reader", Some("reader"), &["fabrica_reader"]),
    (
        "lint, the parts that run in workers",
        Some("parts"),
        &[
            "fabrica_subjects",
            "fabrica_scans",
            "fabrica_meshes",
            "fabrica_pictures",
            "fabrica_figures",
            "fabrica_clay",
        ],
    ),
];

/// Format, lints for every program and every set of features, docs. Goes on after a failure, so that all of them are
/// seen at once.
pub(crate) fn check() -> Outcome {
    all([check_native(&NATIVE), check_page()])
}

/// The checks of what is not compiled for the page and the tests: these are linted while they are compiled (see
/// lint.rs).
pub(crate) fn check_rest() -> Outcome {
    let (rest, _compiled) = NATIVE.split_at(NATIVE.len() - 2);
    check_native(rest)
}

/// Checks without the page's target.
fn check_native(checks: &[Check]) -> Outcome {
    all(checks.iter().map(|(what, args)| {
        let mut command = cargo();
        command.args(*args).env("RUSTDOCFLAGS", "-D warnings");
        if args.contains(&"clippy") {
            command.args(["--", "-D", "warnings"]);
        }
        run(what, &mut command)
    }))
}

/// Lints the page's programs.
fn check_page() -> Outcome {
    all(PAGE.map(|(what, features, programs)| {
        let mut command = cargo();
        command.args(["clippy", "--target", "wasm32-unknown-unknown"]);
        command.args(["--profile", "web"]);
        command.args(programs.iter().flat_map(|program| ["--bin", *program]));
        if let Some(features) = features {
            command.args(["--no-default-features", "--features", features]);
        }
        run(what, command.args(["--", "-D", "warnings"]))
    }))
}

fn all(outcomes: impl IntoIterator<Item = Outcome>) -> Outcome {
    let failures: Vec<String> = outcomes.into_iter().filter_map(Result::err).collect();
    match failures.is_empty() {
        true => Ok(()),
        false => Err(failures.join("\n  ")),
    }
}

/// Writes the assembled programs, as the GPU gets them, with their line maps.
pub(crate) fn shaders(args: &[String]) -> Outcome {
    let folder = args
        .first()
        .cloned()
        .unwrap_or_else(|| "target/shaders".to_owned());
    let folder = root().join(folder);
    let mut command = cargo();
    command.args(["test", "--quiet", "--test", "fast", "shaders::"]);
    command.env("FABRICA_DUMP_SHADERS", &folder);
    run(
        &format!("write the assembled shaders into {}", folder.display()),
        &mut command,
    )
}

/// Writes the graph of the rooms into the docs, and says what breaks the plan of the house.
pub(crate) fn graph() -> Outcome {
    let src = root().join("src");
    let sources = house::sources(&src).map_err(|error| format!("{}: {error}", src.display()))?;
    let graph = imports::read(&sources);
    let page = src.join("imports.md");
    std::fs::write(&page, house::page(&graph))
        .map_err(|error| format!("{}: {error}", page.display()))?;
    let faults = [
        house::upward(&graph),
        house::out_of_order(&graph, &sources, &house::ORDER),
        house::forbidden(&graph),
        house::unreached(&graph),
        house::in_circles(&graph),
    ]
    .concat();
    match faults.is_empty() {
        true => Ok(()),
        false => Err(format!(
            "the plan of the house is broken:\n  {}",
            faults.join("\n  ")
        )),
    }
}
