use std::io;
use std::path::Path;
use std::process::ExitCode;

use clap::Parser as _;

use super::args::{Args, Command};
use super::bench::{bench, bench_of_clay};
use super::clay::{check_clay, write_clay};
use super::describe::describe;
use super::error::CliError;
use super::export::export_field;
use super::figures::{export_figure, is_figure, probe_figure};
use super::info::info;
use super::link::link;
use super::opening::{Opened, open};
use super::output::{misused, one_line, print, write_whole};
use super::probe::{Columns, probe};
use super::rays::rays;
use super::render::{Paper, render};
use super::templates::{templates_json, templates_text};
use crate::link::Link;
use crate::shell::native::{Opening, view};

/// Runs the command line. Without arguments it opens the window.
pub fn run() -> ExitCode {
    let args = match Args::try_parse() {
        Ok(args) => args,
        Err(error) => {
            // Help and version go to standard output and are no error.
            if !error.use_stderr() {
                let _unprintable = error.print();
                return ExitCode::SUCCESS;
            }
            eprintln!("{}", misused(&error.to_string()));
            return ExitCode::from(2);
        }
    };
    match execute(args) {
        Ok(()) => ExitCode::SUCCESS,
        // Who reads has seen enough.
        Err(CliError::Output(error)) if error.kind() == io::ErrorKind::BrokenPipe => {
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("error: {}", one_line(&error));
            ExitCode::from(if matches!(error, CliError::Usage(_)) {
                2
            } else {
                1
            })
        }
    }
}

fn execute(args: Args) -> Result<(), CliError> {
    let common = &args.common;
    match args.command.unwrap_or(Command::View { doc: None }) {
        Command::View { doc } => {
            let opened = doc.as_deref().map(open).transpose()?;
            if let Some(opened) = &opened {
                opened.report_notices();
            }
            let opening = Opening {
                folder: opened.as_ref().map(|opened| opened.folder.clone()),
                link: opened.map(|Opened { document, step, .. }| Link { document, step }),
                subject: common.subject.clone(),
                reading: common.reading.clone(),
                adapter: common.adapter.clone(),
            };
            view(opening).map_err(|error| CliError::Window(error.to_string()))
        }
        Command::Render {
            doc,
            output,
            size,
            moment,
            samples,
            lettering,
            transparent,
            shadow,
            dpi,
        } => {
            let paper = Paper {
                size,
                samples,
                lettering,
                transparent,
                shadow,
                dpi,
            };
            render(common, &open(&doc)?, &output, moment, paper)
        }
        Command::Probe {
            doc,
            points,
            object,
            depth,
            forward,
            rays: asked,
            moment,
        } => {
            let is_rays = asked.is_some();
            let from = points.or(asked).filter(|path| path != Path::new("-"));
            if doc == "-" && from.is_none() {
                return Err(CliError::Usage(match is_rays {
                    true => {
                        "document and rays cannot both come from standard input: name a file behind --rays"
                    }
                    false => {
                        "document and points cannot both come from standard input: name a file by --points"
                    }
                }));
            }
            let opened = open(&doc)?;
            if is_rays {
                return rays(common, &opened, from.as_deref(), moment);
            }
            if !depth && is_figure(&opened, common) {
                let asked = (object, forward);
                return probe_figure(common, &opened, from.as_deref(), asked, moment);
            }
            if forward {
                return Err(CliError::Usage(
                    "--forward asks where places of a figure go, and this subject is none",
                ));
            }
            let columns = Columns { object, depth };
            probe(common, &opened, from.as_deref(), columns, moment)
        }
        Command::ExportField {
            doc,
            output,
            size,
            moment,
        } => {
            let bytes = export_field(common, &open(&doc)?, moment, size)?;
            write_whole(&output, &bytes)
        }
        Command::ExportFigure {
            doc,
            output,
            size,
            moment,
        } => export_figure(common, &open(&doc)?, &output, moment, size),
        Command::Clay {
            doc,
            output,
            text,
            check: _,
            json,
            strokes,
            moment,
        } => {
            let opened = open(&doc)?;
            match &output {
                Some(output) => write_clay(common, &opened, (output, text), strokes, moment),
                None => check_clay(common, &opened, strokes, moment, json),
            }
        }
        Command::Link { doc, page, qr } => {
            link(&open(&doc)?, &page.unwrap_or_default(), qr.as_deref())
        }
        Command::Describe {
            doc,
            step,
            lang,
            json,
        } => describe(common, &open(&doc)?, step, lang, json),
        Command::Doc { doc } => {
            let opened = open(&doc)?;
            opened.report_notices();
            print(&opened.document.to_json())
        }
        Command::Info { file } => info(common, &file),
        Command::Templates { json } => print(&if json {
            templates_json()
        } else {
            templates_text()
        }),
        Command::Bench { clay: true, json } => bench_of_clay(json),
        Command::Bench { clay: false, json } => bench(common, json),
    }
}
