//! What a change must pass, fast to slow, and the assembled shaders.

use crate::Outcome;
use crate::run::{cargo, root, run};

/// Format, lints for the native program, the page and the bare library, docs.
pub(crate) fn check() -> Outcome {
    let steps: [(&str, &[&str]); 6] = [
        ("format", &["fmt", "--check"]),
        (
            "lint, native",
            &["clippy", "--all-targets", "--", "-D", "warnings"],
        ),
        (
            "lint, xtask",
            &[
                "clippy",
                "--no-default-features",
                "--features",
                "dev",
                "--bin",
                "xtask",
                "--",
                "-D",
                "warnings",
            ],
        ),
        (
            "lint, page",
            &[
                "clippy",
                "--target",
                "wasm32-unknown-unknown",
                "--bin",
                "fabrica",
                "--",
                "-D",
                "warnings",
            ],
        ),
        (
            "lint, no features",
            &[
                "clippy",
                "--no-default-features",
                "--lib",
                "--",
                "-D",
                "warnings",
            ],
        ),
        ("docs", &["doc", "--no-deps", "--document-private-items"]),
    ];
    for (what, args) in steps {
        run(what, cargo().args(args).env("RUSTDOCFLAGS", "-D warnings"))?;
    }
    Ok(())
}

/// Writes the assembled programs, as the GPU gets them, with their line maps.
pub(crate) fn shaders(args: &[String]) -> Outcome {
    let folder = args
        .first()
        .cloned()
        .unwrap_or_else(|| "target/shaders".to_owned());
    let folder = root().join(folder);
    let mut command = cargo();
    command.args(["test", "--quiet", "--test", "shaders"]);
    command.env("FABRICA_DUMP_SHADERS", &folder);
    run(
        &format!("write the assembled shaders into {}", folder.display()),
        &mut command,
    )
}
