//! Every test there is, fast to slow.

use std::time::Instant;

use crate::Outcome;
use crate::page;
use crate::run::{cargo, root, run, say};
use crate::setup;

/// Tests that need the built page.
const OF_THE_PAGE: [&str; 2] = ["size", "e2e"];

/// Parts of tests/app.rs that get a process each: Mesa 22's lavapipe keeps some 0.3 GB of every window drawn in a process, as long as it
/// lives, and half a hundred windows are more than a small machine has.
const PARTS_OF_APP: [&str; 4] = ["comfort::", "looking::", "making::", "tissue::"];

/// Sets up, builds the page and runs all tests; with names, only the integration tests so called.
pub(crate) fn test(names: &[String]) -> Outcome {
    let start = Instant::now();
    setup::for_tests()?;
    let needs_page = |name: &str| OF_THE_PAGE.contains(&name);
    if !names.is_empty() {
        if names.iter().any(|name| needs_page(name)) {
            page::build()?;
        }
        let outcomes = names.iter().map(|name| one(name)).collect::<Vec<_>>();
        return close(start, outcomes);
    }
    // The page first: where it cannot be built there is no use in waiting for the rest.
    page::build()?;
    let mut outcomes = vec![
        run("compile the tests", &mut tests(&["--no-run"])),
        run("unit tests", &mut tests(&["--lib"])),
    ];
    let mut files = integration_tests()?;
    files.sort_by_key(|name| needs_page(name));
    outcomes.extend(files.iter().map(|name| one(name)));
    outcomes.push(run("examples in the documentation", &mut tests(&["--doc"])));
    // Their tests ran above; running them again would compile everything that tests depend on once more.
    let bare = ["check", "--no-default-features", "--lib", "--quiet"];
    outcomes.push(run(
        "the rooms below the renderer, without any feature",
        cargo().args(bare),
    ));
    close(start, outcomes)
}

fn one(name: &str) -> Outcome {
    let run_with = |what: &str, args: &[&str]| {
        let mut command = tests(&["--test", name]);
        command.args(args);
        run(&format!("tests/{name}.rs{what}"), &mut command)
    };
    match name {
        "app" => {
            let mut rest = vec!["--"];
            for part in PARTS_OF_APP {
                run_with(&format!(", {part}"), &[part])?;
                rest.extend(["--skip", part]);
            }
            run_with(", the rest", &rest)
        }
        _ if OF_THE_PAGE.contains(&name) => run_with("", &["--", "--nocapture"]),
        _ => run_with("", &[]),
    }
}

/// `cargo test` under a software GPU.
pub(crate) fn tests(args: &[&str]) -> std::process::Command {
    let mut command = cargo();
    command.arg("test").args(args);
    // Mesa complains without it.
    if std::env::var_os("XDG_RUNTIME_DIR").is_none() {
        command.env("XDG_RUNTIME_DIR", std::env::temp_dir());
    }
    command
}

fn integration_tests() -> Result<Vec<String>, String> {
    let folder = root().join("tests");
    let entries = std::fs::read_dir(&folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    let mut names: Vec<String> = entries
        .flatten()
        .filter_map(|entry| {
            let path = entry.path();
            let is_test = path.extension().is_some_and(|e| e == "rs");
            is_test.then(|| path.file_stem().map(|s| s.to_string_lossy().into_owned()))?
        })
        .collect();
    names.sort();
    Ok(names)
}

/// All failures at the end, where they are seen.
fn close(start: Instant, outcomes: Vec<Outcome>) -> Outcome {
    let minutes = start.elapsed().as_secs_f32() / 60.0;
    let total = outcomes.len();
    let failures: Vec<String> = outcomes.into_iter().filter_map(Result::err).collect();
    if failures.is_empty() {
        say(&format!("all {total} steps passed in {minutes:.1} minutes"));
        return Ok(());
    }
    Err(format!(
        "{} of {total} steps failed ({minutes:.1} minutes):\n  {}",
        failures.len(),
        failures.join("\n  ")
    ))
}

/// Lets the tests write what they draw as the expected pictures: one by name, or all.
pub(crate) fn bless(names: &[String]) -> Outcome {
    setup::for_tests()?;
    let name = names.first().map_or("all", String::as_str);
    let mut command = tests(&["--test", "images", "--test", "app"]);
    command.env("FABRICA_BLESS", name);
    run(&format!("bless {name}"), &mut command)
}
