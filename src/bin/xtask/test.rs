//! Every check and every test there is, fast to slow.

use std::path::Path;
use std::process::Command;
use std::sync::mpsc::{Receiver, channel};
use std::time::Instant;

use crate::check;
use crate::lint;
use crate::page;
use crate::run::{Outcome, cargo, given_way, report, root, run, run_beside};
use crate::setup;

/// The test binaries that need no page and little memory, and ask of nothing that it is quick, as the unit tests.
const PATIENT: [&str; 3] = ["fast", "gpu", "evaluate"];

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
    // Two rows of work beside each other. One sets up what builds the page, builds it and then tests it in the browser:
    // it draws one page after the other, and leaves a quarter of two cores idle. The other checks and compiles all
    // other tests, and runs those that can give way to the browser, whose tests wait for answers.
    let (sender, receiver) = channel();
    let (mut outcomes, is_compiled, page) = std::thread::scope(move |scope| {
        let page = scope.spawn(move || page_and_browser(&receiver));
        let mut outcomes = vec![check::check_rest()];
        let what = "lint, document and compile the tests and what they test";
        let compiled = linted_tests(&["--no-run"]).and_then(|mut command| run(what, &mut command));
        let is_compiled = compiled.is_ok();
        outcomes.push(compiled);
        // Nobody waits for the answer any more where the page could not be built.
        let _waits = sender.send(is_compiled);
        if is_compiled {
            let behind = |args: &[&str]| linted_tests(args).map(given_way);
            let units = behind(&["--lib"]);
            outcomes.push(units.and_then(|mut command| run("unit tests", &mut command)));
            outcomes.extend(PATIENT.map(|name| one(name, behind)));
        }
        (outcomes, is_compiled, page.join())
    });
    match page {
        Ok(of_page) => outcomes.extend(of_page),
        Err(_panic) => outcomes.push(Err("building the page panicked".to_owned())),
    }
    if is_compiled {
        outcomes.push(one("app", linted_tests));
        let examples = &mut linted_tests(&["--doc"])?;
        outcomes.push(run("examples in the documentation", examples));
    }
    outcomes.push(all_ran(&not_run));
    close(start, outcomes)
}

/// Sets up what the page needs, builds it, waits until the tests are compiled, and runs those of the browser.
/// `is_compiled` tells whether they could be.
fn page_and_browser(is_compiled: &Receiver<bool>) -> Vec<Outcome> {
    let built = setup::for_page().and_then(|()| page::build_beside());
    let is_built = built.is_ok();
    let mut outcomes = vec![built];
    if is_compiled.recv().unwrap_or(false) && is_built {
        let browser = linted_tests(&["--test", "browser", "--", "--nocapture"]);
        outcomes.push(browser.and_then(|mut command| run_beside("tests/browser", &mut command)));
    }
    outcomes
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
