//! Running other programs: each step prints what it does and how long it took.

use std::ffi::OsStr;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitStatus, Output, Stdio};
use std::time::Instant;

/// Why a command stopped: one message, with what to do about it.
pub(crate) type Outcome = Result<(), String>;

/// Root of the repository.
pub(crate) fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Prints a line about the work of the command.
pub(crate) fn report(what: &str) {
    println!("xtask: {what}");
}

/// A program in the repository's root.
pub(crate) fn program(name: impl AsRef<OsStr>) -> Command {
    let mut command = Command::new(name);
    command.current_dir(root());
    command
}

/// Runs a program that is given this text to read, and returns how it ended and what it said.
pub(crate) fn fed(command: &mut Command, text: &str) -> Result<Output, String> {
    let name = command.get_program().to_owned();
    let failed = |error: std::io::Error| format!("{}: {error}", Path::new(&name).display());
    let piped = command.stdin(Stdio::piped()).stdout(Stdio::piped());
    let mut child = piped.stderr(Stdio::piped()).spawn().map_err(failed)?;
    if let Some(mut input) = child.stdin.take() {
        // A program that asks for nothing may have ended already.
        let _taken = input.write_all(text.as_bytes());
    }
    child.wait_with_output().map_err(failed)
}

/// The cargo that runs this.
pub(crate) fn cargo() -> Command {
    let mut command = program(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    // Meant for this binary, not for what it builds.
    for (name, _) in std::env::vars_os() {
        if name
            .to_str()
            .is_some_and(|n| n.starts_with("CARGO_PKG_") || n.starts_with("CARGO_BIN_"))
        {
            command.env_remove(name);
        }
    }
    command
}

/// Runs to the end with its output shown.
pub(crate) fn run(what: &str, command: &mut Command) -> Outcome {
    report(what);
    let start = Instant::now();
    let status = command.status();
    ended(what, command, start, status)
}

/// Runs to the end beside others, and shows its output then: their lines are not mixed.
pub(crate) fn run_beside(what: &str, command: &mut Command) -> Outcome {
    report(&format!("{what}: begun"));
    let start = Instant::now();
    let output = command.stdin(Stdio::null()).output();
    let status = output.map(|output| {
        report(what);
        print!("{}", String::from_utf8_lossy(&output.stdout));
        eprint!("{}", String::from_utf8_lossy(&output.stderr));
        output.status
    });
    ended(what, command, start, status)
}

fn ended(
    what: &str,
    command: &Command,
    start: Instant,
    status: std::io::Result<ExitStatus>,
) -> Outcome {
    let status = status
        .map_err(|error| format!("{what}: {} could not be started: {error}", shown(command)))?;
    let seconds = start.elapsed().as_secs_f32();
    if status.success() {
        report(&format!("{what}: done in {seconds:.0} s"));
        Ok(())
    } else {
        Err(format!(
            "{what}: failed after {seconds:.0} s ({status}): {}",
            shown(command)
        ))
    }
}

/// What a program prints, if it succeeds.
pub(crate) fn output(command: &mut Command) -> Option<String> {
    let output = command.stderr(Stdio::null()).output().ok()?;
    let is_good = output.status.success();
    is_good.then(|| String::from_utf8_lossy(&output.stdout).into_owned())
}

/// The command line as one would type it.
fn shown(command: &Command) -> String {
    std::iter::once(command.get_program())
        .chain(command.get_args())
        .map(OsStr::to_string_lossy)
        .collect::<Vec<_>>()
        .join(" ")
}

/// The same command, which gives way to others that want the processor, where the system has a program for that.
pub(crate) fn given_way(command: Command) -> Command {
    let Some(nice) = find("nice") else {
        return command;
    };
    let mut behind = program(nice);
    behind.args(["-n", "10"]);
    behind.arg(command.get_program()).args(command.get_args());
    for (name, value) in command.get_envs() {
        match value {
            Some(value) => behind.env(name, value),
            None => behind.env_remove(name),
        };
    }
    behind
}

/// Where a program is found.
pub(crate) fn find(name: &str) -> Option<PathBuf> {
    let file = format!("{name}{}", std::env::consts::EXE_SUFFIX);
    let path = std::env::var_os("PATH")?;
    std::env::split_paths(&path)
        .chain(cargo_bin())
        .map(|folder| folder.join(&file))
        .find(|file| file.is_file())
}

/// Where `cargo install` puts programs.
pub(crate) fn cargo_bin() -> Option<PathBuf> {
    let home = std::env::var_os("CARGO_HOME").map(PathBuf::from);
    let home = home.or_else(|| {
        let user = std::env::var_os("HOME").or_else(|| std::env::var_os("USERPROFILE"))?;
        Some(PathBuf::from(user).join(".cargo"))
    });
    home.map(|home| home.join("bin"))
}
