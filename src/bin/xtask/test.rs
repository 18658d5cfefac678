//! Every check and every test there is, fast to slow.

use std::path::Path;
use std::process::Command;
use std::time::Instant;

use crate::check;
use crate::lint;
use crate::page;
use crate::run::{Outcome, cargo, report, root, run};
use crate::setup;

/// The test binaries that are run once all is built; `gpu` is run before, beside the end of the page's build.
const BINARIES: [&str; 4] = ["fast", "evaluate", "app", "browser"];

/// Parts of tests/app that get a process together: Mesa 22's lavapipe keeps 0.15 GB of every window drawn in a process,
/// as long as it lives, and half a hundred windows are more than a small machine has. Some two dozen share their
/// programs, which take long to compile.
const PARTS_OF_APP: [&[&str]; 6] = [
    &["authoring::", "bodies::", "canvas::"],
    &["comfort::", "dropping::", "library::", "share::"],
    &["looking::", "making::"],
    &["objects::", "screens::", "steps::"],
    &["opening::"],
    &["tissue::"],
];

/// Checks, sets up, builds the page and runs all tests; with names, only the test binaries so called.
pub(crate) fn test(names: &[String]) -> Outcome {
    let start = Instant::now();
    setup::for_tests()?;
    let not_run = root().join("target/xtask/not_run.txt");
    let _was_there = std::fs::remove_file(&not_run);
    if !names.is_empty() {
        if names.iter().any(|name| name == "browser") {
            page::build()?;
        }
        let plainly = |args: &[&str]| Ok(tests(args));
        let mut outcomes: Vec<Outcome> = names.iter().map(|name| one(name, plainly)).collect();
        outcomes.push(all_ran(&not_run));
        return close(start, outcomes);
    }
    setup::for_page()?;
    // The page is built beside the native checks and the compiler of the tests: for most of its time one core optimises
    // one program, and the others have ends that take one core too. The tests on the GPU need no page, and none of them
    // asks that something is quick.
    let ((checked, compiled, drawn), page) = std::thread::scope(|scope| {
        let page = scope.spawn(page::build_beside);
        let checked = check::check_rest();
        let what = "lint, document and compile the tests and what they test";
        let compiled = linted_tests(&["--no-run"]).and_then(|mut command| run(what, &mut command));
        let drawn = compiled.is_ok().then(|| one("gpu", linted_tests));
        ((checked, compiled, drawn), page.join())
    });
    // Where something cannot be built, or a lint speaks, there is no use in waiting for the rest.
    let built = page.map_err(|_panic| "building the page panicked".to_owned())?;
    if built.is_err() || compiled.is_err() {
        let outcomes = [checked, compiled, built].into_iter().chain(drawn);
        return close(start, outcomes.collect());
    }
    let mut outcomes = vec![checked];
    outcomes.extend(drawn);
    outcomes.push(run("unit tests", &mut linted_tests(&["--lib"])?));
    outcomes.extend(BINARIES.map(|name| one(name, linted_tests)));
    let examples = &mut linted_tests(&["--doc"])?;
    outcomes.push(run("examples in the documentation", examples));
    outcomes.push(all_ran(&not_run));
    close(start, outcomes)
}

/// Runs the tests of a binary, which is compiled as `tests` has cargo do it.
fn one(name: &str, tests: fn(&[&str]) -> Result<Command, String>) -> Outcome {
    let run_with = |what: &str, args: &[&str]| {
        let mut command = tests(&["--test", name])?;
        command.args(args);
        run(&format!("tests/{name}{what}"), &mut command)
    };
    match name {
        "app" => {
            let mut rest = vec!["--"];
            // After a part that fails the others are run too.
            let mut outcome = Ok(());
            for parts in PARTS_OF_APP {
                let args = [&["--"], parts].concat();
                outcome = outcome.and(run_with(&format!(", {}", parts.join(" ")), &args));
                rest.extend(parts.iter().flat_map(|part| ["--skip", *part]));
            }
            outcome.and(run_with(", the rest", &rest))
        }
        "browser" => run_with("", &["--", "--nocapture"]),
        _ => run_with("", &[]),
    }
}

/// Says which tests of scans did not run. That is a failure where the scans should be there: where `FABRICA_TEST_DATA`
/// names a folder.
fn all_ran(list: &Path) -> Outcome {
    let text = std::fs::read_to_string(list).unwrap_or_default();
    let mut names: Vec<&str> = text.lines().collect();
    names.sort_unstable();
    names.dedup();
    if names.is_empty() {
        return Ok(());
    }
    let message = format!(
        "{} tests of scans did not run: {}",
        names.len(),
        names.join(", ")
    );
    match std::env::var("FABRICA_TEST_DATA") {
        Ok(folder) if folder != "none" => Err(message),
        _ => {
            report(&format!(
                "{message} (FABRICA_TEST_DATA names no folder of scans)"
            ));
            Ok(())
        }
    }
}

/// `cargo test` under a software GPU.
pub(crate) fn tests(args: &[&str]) -> Command {
    let mut command = cargo();
    command.arg("test").args(args);
    // Mesa complains without it.
    if std::env::var_os("XDG_RUNTIME_DIR").is_none() {
        command.env("XDG_RUNTIME_DIR", std::env::temp_dir());
    }
    // Windows make their shaders without debug information too (see `Gpu::open`).
    command.env("WGPU_DEBUG", "0");
    // Tests that find no scans put their names there.
    command.env("FABRICA_NOT_RUN", root().join("target/xtask/not_run.txt"));
    command
}

/// The same, compiled with lints and docs.
fn linted_tests(args: &[&str]) -> Result<Command, String> {
    let mut command = tests(args);
    lint::beside(&mut command)?;
    Ok(command)
}

/// All failures at the end, where they are seen.
fn close(start: Instant, outcomes: Vec<Outcome>) -> Outcome {
    let minutes = start.elapsed().as_secs_f32() / 60.0;
    let total = outcomes.len();
    let failures: Vec<String> = outcomes.into_iter().filter_map(Result::err).collect();
    if failures.is_empty() {
        report(&format!("all {total} steps passed in {minutes:.1} minutes"));
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
    let mut command = tests(&["--test", "gpu", "images::"]);
    command.env("FABRICA_BLESS", name);
    run(&format!("bless {name}"), &mut command)
}

/// Draws the windows of tests/app, those that are there only to be looked at too, into target/look; with a name, only
/// of the tests whose names hold it.
pub(crate) fn look(names: &[String]) -> Outcome {
    setup::for_tests()?;
    let folder = root().join("target/look");
    std::fs::create_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let name = names.first().map_or("to_look_at", String::as_str);
    let mut command = tests(&[
        "--test",
        "app",
        name,
        "--",
        "--include-ignored",
        "--nocapture",
    ]);
    command.env("FABRICA_LOOK_AT", &folder);
    run("draw windows to look at", &mut command)?;
    report(&format!("look into {}", folder.display()));
    Ok(())
}
