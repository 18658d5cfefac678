//! The developer's commands: `cargo xtask serve`, `cargo xtask test` and a few more. Needs nothing but std and
//! the bare library, so that setting up starts within seconds on a fresh machine.

mod check;
mod compare;
mod evaluate;
mod examples;
mod gallery;
mod house;
mod imports;
mod islands;
mod lint;
mod page;
mod palette;
mod pieces;
mod readme;
mod run;
mod setup;
mod sheet;
mod test;

use std::process::ExitCode;

const HELP: &str = "\
cargo xtask COMMAND

  serve [--port N]  set up what is missing, build the page, serve it on localhost
  test [NAME…]      set up what is missing, check format, lints and docs, build the page, run every test; with names
                    (fast, gpu, app, browser, evaluate) only the tests of that binary
  check             format, lints (native, page, without features) and docs alone
  look [NAME]       draw the windows of tests/app into target/look, to be looked at
  compare OLD NEW   compare two builds of the native program: links, catalogue, probes, pictures
  imports           write the graph of the rooms into the docs (src/imports.md), name circles between files
  build             build the page into dist/
  size              what the built page weighs: raw, gzip, brotli
  bless [NAME]      accept the pictures that tests draw now as the expected ones
  gallery [--only NAME]  draw every built-in subject and every illustration of web/gallery into
                    target/gallery/index.html (also --size PIXELS, --program FILE, --page URL)
  examples          write the list of examples out of web/gallery, and draw their pictures anew
  readme            draw the sheets of pictures of the README anew, out of web/gallery (--only FILE, --program FILE)
  icons             draw the icons of the catalogue anew, into the picture that ships with the program
  islands           draw every document of web/gallery at each step and every built-in subject, and name what floats
                    beside the object in fewer than 40 pixels (--only NAME, --program FILE)
  evaluate          measure maps, normals, opacity and cost against closed forms (some minutes, test profile):
                    tables and plots in target/evaluation/index.html
  shaders [FOLDER]  write the assembled shader programs into a folder (default target/shaders)
  setup             only set up what serve and test need";

fn main() -> ExitCode {
    let args: Vec<String> = std::env::args().skip(1).collect();
    if let Some(compiler) = lint::compiler(&args) {
        return lint::compile(compiler, &args);
    }
    let rest = args.get(1..).unwrap_or_default();
    let outcome = match args.first().map(String::as_str) {
        Some("serve") => page::serve(rest),
        Some("test") => test::test(rest),
        Some("check") => check::check(),
        Some("look") => test::look(rest),
        Some("compare") => compare::compare(rest),
        Some("imports") => check::graph(),
        Some("build") => page::build(),
        Some("size") => page::size(),
        Some("bless") => test::bless(rest),
        Some("gallery") => gallery::gallery(rest),
        Some("icons") => sheet::icons(rest),
        Some("examples") => sheet::examples(rest),
        Some("readme") => readme::readme(rest),
        Some("islands") => islands::islands(rest),
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
