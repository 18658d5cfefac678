//! What a change must pass before its tests: format, lints, docs. Also writes the files that are generated from the
//! source: the assembled shaders and the graph of imports.

use crate::house;
use crate::imports;
use crate::run::{Outcome, cargo, root, run};

/// The checks, fast to slow: a name, and the arguments of cargo. Lints are errors here.
const CHECKS: [(&str, &[&str]); 10] = [
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
    (
        "lint, page",
        &[
            "clippy",
            "--target",
            "wasm32-unknown-unknown",
            "--bin",
            "fabrica",
        ],
    ),
    (
        "lint, the part that makes subjects",
        &[
            "clippy",
            "--target",
            "wasm32-unknown-unknown",
            "--no-default-features",
            "--features",
            "part-subjects",
            "--bin",
            "fabrica_subjects",
        ],
    ),
    (
        "lint, the reader",
        &[
            "clippy",
            "--target",
            "wasm32-unknown-unknown",
            "--no-default-features",
            "--features",
            "reader",
            "--bin",
            "fabrica_reader",
        ],
    ),
    (
        "lint, the part that reads scans",
        &[
            "clippy",
            "--target",
            "wasm32-unknown-unknown",
            "--no-default-features",
            "--features",
            "part-scans",
            "--bin",
            "fabrica_scans",
        ],
    ),
    ("docs", &["doc", "--no-deps", "--document-private-items"]),
];

/// Format, lints for every program and every set of features, docs. Goes on after a failure, so that all of them are
/// seen at once.
pub(crate) fn check() -> Outcome {
    let outcomes: Vec<Outcome> = CHECKS.iter().map(|(what, args)| one(what, args)).collect();
    let failures: Vec<String> = outcomes.into_iter().filter_map(Result::err).collect();
    match failures.is_empty() {
        true => Ok(()),
        false => Err(failures.join("\n  ")),
    }
}

fn one(what: &str, args: &[&str]) -> Outcome {
    let mut command = cargo();
    command.args(args).env("RUSTDOCFLAGS", "-D warnings");
    if args.contains(&"clippy") {
        command.args(["--", "-D", "warnings"]);
    }
    run(what, &mut command)
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
