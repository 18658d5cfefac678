//! The page: built by Trunk, weighed, served.

use std::process::Command;

use crate::lint;
use crate::run::{Outcome, cargo, find, program, report, root, run, run_beside};
use crate::setup;

const BUILD: &str = "build the page (2 minutes and more on two cores)";

/// Builds the page into dist/.
pub(crate) fn build() -> Outcome {
    setup::for_page()?;
    run(BUILD, &mut trunk(&["build"])?)
}

/// The same with lints, beside something else, once all is set up.
pub(crate) fn build_beside() -> Outcome {
    let mut command = trunk(&["build"])?;
    lint::beside(&mut command)?;
    run_beside(BUILD, &mut command)
}

/// Builds and serves the page until it is stopped.
pub(crate) fn serve(args: &[String]) -> Outcome {
    let port = match args {
        [] => "8080",
        [flag, port] if flag == "--port" && port.parse::<u16>().is_ok() => port,
        _ => return Err("serve takes --port NUMBER and nothing else".to_owned()),
    };
    build()?;
    report(&format!(
        "the page: http://127.0.0.1:{port}/ (it is built again when a file changes; Ctrl+C ends)"
    ));
    run("serve the page", &mut trunk(&["serve", "--port", port])?)
}

fn trunk(args: &[&str]) -> Result<Command, String> {
    let trunk = find("trunk").ok_or("Trunk is not installed: run `cargo xtask setup`")?;
    let mut command = program(trunk);
    // Trunk fails on values of these that it does not know.
    command.env_remove("NO_COLOR").args(args);
    Ok(command)
}

/// Weighs the built page; fails above the ceiling of tests/size.rs.
pub(crate) fn size() -> Outcome {
    if !root().join("dist/fabrica_bg.wasm").is_file() {
        build()?;
    }
    let mut command = cargo();
    command.args([
        "test",
        "--quiet",
        "--test",
        "browser",
        "size::",
        "--",
        "--nocapture",
    ]);
    run("weigh the page", &mut command)
}
