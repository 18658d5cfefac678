//! The developer's commands: `cargo xtask serve`, `cargo xtask test` and a few more. Needs nothing but std and
//! the bare library, so that setting up starts within seconds on a fresh machine.

#[path = "xtask/check.rs"]
mod check;
#[path = "xtask/evaluate.rs"]
mod evaluate;
#[path = "xtask/gallery.rs"]
mod gallery;
#[path = "xtask/page.rs"]
mod page;
#[path = "xtask/run.rs"]
mod run;
#[path = "xtask/setup.rs"]
mod setup;
#[path = "xtask/test.rs"]
mod test;

use std::process::ExitCode;

/// Why a command stopped: one message, with what to do about it.
type Outcome = Result<(), String>;

const HELP: &str = "\
cargo xtask COMMAND

  serve [--port N]  set up what is missing, build the page, serve it on localhost
  test [NAME…]      set up what is missing, build the page, check its size, run every test
  check             what a change must pass: fmt, clippy (native, page, bare), docs
  build             build the page into dist/
  size              what the built page weighs: raw, gzip, brotli
  bless [NAME]      accept the pictures that tests draw now as the expected ones
  gallery [--only NAME]  draw every built-in subject and every illustration of web/gallery into
                    target/gallery/index.html (also --size PIXELS, --program FILE, --page URL)
  evaluate          measure maps, normals, opacity and cost against closed forms (some minutes, test profile):
                    tables and plots in target/evaluation/index.html
  shaders [FOLDER]  write the assembled shader programs into a folder (default target/shaders)
  setup             only set up what serve and test need";

fn main() -> ExitCode {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let rest = args.get(1..).unwrap_or_default();
    let outcome = match args.first().map(String::as_str) {
        Some("serve") => page::serve(rest),
        Some("test") => test::test(rest),
        Some("check") => check::check(),
        Some("build") => page::build(),
        Some("size") => page::size(),
        Some("bless") => test::bless(rest),
        Some("gallery") => gallery::gallery(rest),
        Some("evaluate") => evaluate::evaluate(),
        Some("shaders") => check::shaders(rest),
        Some("setup") => setup::for_page().and_then(|()| setup::for_tests()),
        _ => {
            println!("{HELP}");
            return ExitCode::from(2);
        }
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("xtask: {message}");
            ExitCode::FAILURE
        }
    }
}
