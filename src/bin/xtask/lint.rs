//! Lints and docs beside the compiler. Cargo calls this program in place of the compiler for the crates of this
//! repository; it calls the compiler, and Clippy and rustdoc beside that, with the dependencies as they have just been
//! compiled. `cargo clippy` and `cargo doc` would check all dependencies once more, for each program and set of
//! features, which takes a small machine longer than all else that they do.

use crate::run::root;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitCode, Stdio};

/// Makes cargo lint and document what it compiles of this repository. A lint is an error.
///
/// # Errors
/// If this program does not know its own file.
pub(crate) fn beside(command: &mut Command) -> Result<(), String> {
    let own = std::env::current_exe().map_err(|error| format!("this program's file: {error}"))?;
    command.env("RUSTC_WORKSPACE_WRAPPER", own);
    Ok(())
}

/// The compiler, if the arguments of this program are a call of the compiler by cargo.
pub(crate) fn compiler(args: &[String]) -> Option<&Path> {
    let first = Path::new(args.first()?);
    (first.file_stem() == Some(OsStr::new("rustc"))).then_some(first)
}

/// Compiles a crate as cargo asks for it, and lints it. `args` are those of this program, the compiler first.
pub(crate) fn compile(compiler: &Path, args: &[String]) -> ExitCode {
    let wanted = args.get(1..).unwrap_or_default();
    let is_crate = wanted.iter().any(|arg| arg.starts_with("--emit="));
    let beside = match is_crate {
        true => vec![linter(compiler, args), docs(compiler, wanted)],
        // A question about the compiler.
        false => Vec::new(),
    };
    let beside: Vec<_> = beside
        .into_iter()
        .flatten()
        .map(|mut command| started(&mut command))
        .collect();
    let compiled = started(Command::new(compiler).args(wanted)).and_then(ended);
    // The first failure counts; the compiler tells its own, and the linter often the same.
    let others = beside.into_iter().map(|child| child.and_then(ended));
    let outcome = std::iter::once(compiled).chain(others.collect::<Vec<_>>());
    match outcome.collect::<Result<Vec<()>, String>>() {
        Ok(_) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
}

fn started(command: &mut Command) -> Result<Child, String> {
    let name = command.get_program().to_string_lossy().into_owned();
    let child = command.stdin(Stdio::null()).spawn();
    child.map_err(|error| format!("{name} could not be started: {error}"))
}

fn ended(mut child: Child) -> Result<(), String> {
    let status = child.wait().map_err(|error| error.to_string())?;
    match status.success() {
        true => Ok(()),
        false => Err(format!("xtask: {status}")),
    }
}

/// A program that came with the compiler.
fn companion(compiler: &Path, name: &str) -> Command {
    Command::new(compiler.with_file_name(format!("{name}{}", std::env::consts::EXE_SUFFIX)))
}

/// A folder for what nobody needs.
fn scratch(name: &str) -> PathBuf {
    let folder = root().join("target/xtask").join(name);
    // Whoever writes into it says so if it is not there.
    let _made = std::fs::create_dir_all(&folder);
    folder
}

/// Clippy, which is called as cargo's own command does it, and makes nothing but the crate's metadata.
fn linter(compiler: &Path, args: &[String]) -> Option<Command> {
    let mut command = companion(compiler, "clippy-driver");
    let mut args = args.iter();
    while let Some(arg) = args.next() {
        if arg.starts_with("--emit=") {
            command.arg("--emit=metadata");
        } else if arg == "--out-dir" {
            args.next()?;
            command.arg("--out-dir").arg(scratch("lint"));
        } else {
            command.arg(arg);
        }
    }
    command.args(["-D", "warnings"]);
    Some(command)
}

/// Rustdoc over the library of native programs.
fn docs(compiler: &Path, args: &[String]) -> Option<Command> {
    const VALUED: [&str; 7] = [
        "--crate-name",
        "--crate-type",
        "--cfg",
        "--check-cfg",
        "--extern",
        "-L",
        "--target",
    ];
    let mut command = companion(compiler, "rustdoc");
    let (mut is_library, mut is_whole) = (false, false);
    let mut args = args.iter();
    while let Some(arg) = args.next() {
        if VALUED.contains(&arg.as_str()) {
            let value = args.next()?;
            is_library |= arg == "--crate-type" && value == "lib";
            // All features of native programs: the default ones.
            is_whole |= value == "feature=\"app\"";
            if arg == "--target" {
                return None;
            }
            command.args([arg, value]);
        } else if arg.starts_with("--edition") || arg.ends_with(".rs") {
            command.arg(arg);
        }
    }
    command.args(["--document-private-items", "-D", "warnings", "--out-dir"]);
    command.arg(scratch("doc"));
    (is_library && is_whole).then_some(command)
}
