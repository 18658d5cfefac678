//! The command line of the native program (spec/contract.md, "The command line").
//!
//! Results go to standard output, notices and errors to standard error, one line each; 0 is success, 1 an error, 2 bad
//! usage. A file that is written is whole or not there.

use std::fmt;
use std::io::{self, Read as _, Write as _};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{Parser, Subcommand};
use serde_json::{Value, json};

use super::fields::attach_fields;
use super::probing::probe;
use super::reading::{ReadingFlags, hint};
use super::subject::{MissingSubject, SubjectSource, load_subject};
use crate::data::{Volume, VolumeLimits};
use crate::document::{
    Document, DocumentError, Illustration, MAX_BYTES, ParamKind, TemplateKind, plain_f64,
};
use crate::link::{self, LinkError};
use crate::load::LoadError;
use crate::render::{Gpu, GpuOptions, KeptTissue, RenderError, Studio, encode_png};

/// Opens CT and MRI scans the way a medical illustrator would.
///
/// DOC is an existing file, a link, or a link's payload; - reads a document from standard input.
#[derive(Debug, Parser)]
#[command(name = "fabrica", version, max_term_width = 100)]
struct Args {
    #[command(subcommand)]
    command: Option<Command>,
    #[command(flatten)]
    common: Common,
}

#[derive(Debug, clap::Args)]
pub(super) struct Common {
    /// A scan that takes the place of the document's subject.
    #[arg(long, global = true, value_name = "FILE")]
    pub(super) subject: Option<PathBuf>,
    /// A displacement field that the document names by its hash; may be given several times.
    #[arg(long, global = true, value_name = "FILE")]
    pub(super) field: Vec<PathBuf>,
    /// A label volume beside the scan; may be given several times.
    #[arg(long, global = true, value_name = "FILE")]
    segments: Vec<PathBuf>,
    #[command(flatten)]
    reading: ReadingFlags,
    /// The graphics adapter to use, by (part of) its name.
    #[arg(long, global = true, value_name = "NAME")]
    adapter: Option<String>,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Opens a window.
    View {
        /// What to open; without it, what was open the last time.
        doc: Option<String>,
    },
    /// Draws without a window.
    Render {
        /// What to draw.
        doc: String,
        /// The PNG file to write.
        #[arg(short, long, value_name = "FILE")]
        output: PathBuf,
        /// Width and height, pixels.
        #[arg(long, value_name = "WxH", default_value = "1024x768", value_parser = parse_size)]
        size: [u32; 2],
        #[command(flatten)]
        moment: Moment,
        /// Samples per pixel against jagged edges.
        #[arg(long, value_name = "N", default_value_t = 4, value_parser = clap::value_parser!(u32).range(1..=1024))]
        samples: u32,
        /// Writes title, credit and labels into the picture.
        #[arg(long)]
        lettering: bool,
    },
    /// Says where the material at a point comes from: reads x,y,z lines, prints x,y,z,sx,sy,sz,a lines.
    Probe {
        /// What to probe.
        doc: String,
        /// Lines of x,y,z in the deformed subject; standard input without it, or for -.
        #[arg(long, value_name = "FILE")]
        points: Option<PathBuf>,
        /// Looks into the subject as well: adds value,segment, empty where there is nothing.
        #[arg(long)]
        object: bool,
        #[command(flatten)]
        moment: Moment,
    },
    /// Writes the composed map of a document as a displacement field: NRRD, millimetres from output to input, and continuity.
    ExportField {
        /// What to export.
        doc: String,
        /// The NRRD file to write.
        #[arg(short, long, value_name = "FILE")]
        output: PathBuf,
        /// Samples along the longest side.
        #[arg(long, value_name = "N", default_value_t = 128, value_parser = clap::value_parser!(u32).range(2..=512))]
        size: u32,
        #[command(flatten)]
        moment: Moment,
    },
    /// Prints the link of a document.
    Link {
        /// What to link to.
        doc: String,
        /// The page in front of the link.
        #[arg(long, value_name = "URL")]
        page: Option<String>,
    },
    /// Prints the document of a link, as canonical JSON.
    Doc {
        /// What to print.
        doc: String,
    },
    /// Says what a data file holds.
    Info {
        /// A scan.
        file: PathBuf,
    },
    /// Lists the displacement templates with parameters, defaults and ranges.
    Templates {
        /// As JSON.
        #[arg(long)]
        json: bool,
    },
    /// Measures frame times on this adapter, as ratios to the undeformed frame.
    Bench {
        /// As JSON.
        #[arg(long)]
        json: bool,
    },
}

/// A moment of a lesson.
#[derive(Clone, Copy, Debug, clap::Args)]
pub(super) struct Moment {
    /// The step; a link may name one itself, else 0.
    #[arg(long, value_name = "N")]
    step: Option<usize>,
    /// Seconds into the passage to that step; without it, its end.
    #[arg(long, value_name = "T", value_parser = parse_seconds)]
    time: Option<f32>,
}

fn parse_size(text: &str) -> Result<[u32; 2], String> {
    let side = |text: &str| {
        text.trim()
            .parse::<u32>()
            .ok()
            .filter(|side| (1..=32_768).contains(side))
    };
    text.split_once(['x', 'X', '×'])
        .and_then(|(width, height)| Some([side(width)?, side(height)?]))
        .ok_or_else(|| {
            "expected width and height such as 1024x768, each from 1 to 32768".to_owned()
        })
}

fn parse_seconds(text: &str) -> Result<f32, String> {
    match text.parse::<f32>() {
        Ok(seconds) if seconds.is_finite() && seconds >= 0.0 => Ok(seconds),
        _ => Err("expected seconds, 0 or more".to_owned()),
    }
}

/// Why a command failed. One line each.
#[derive(Debug, thiserror::Error)]
pub(super) enum CliError {
    #[error("{path}: {source}")]
    Read { path: String, source: io::Error },
    #[error("{path}: larger than a document may be ({MAX_BYTES} bytes)")]
    TooLong { path: String },
    #[error("{path}: not a text in UTF-8")]
    NotUtf8 { path: String },
    #[error("{path}: {source}")]
    Document { path: String, source: DocumentError },
    #[error("{path}: {source}")]
    Link { path: String, source: LinkError },
    #[error("there is no file {path}, and no link that begins so: {source}")]
    NeitherFileNorLink { path: String, source: LinkError },
    #[error(transparent)]
    Step(DocumentError),
    #[error("{0}")]
    Field(String),
    #[error("subject: {0}")]
    Subject(#[from] MissingSubject),
    #[error("{0} [{1}]")]
    Load(LoadError, String),
    #[error(transparent)]
    Render(#[from] RenderError),
    #[error("{path}: {source}; nothing was written")]
    Write { path: String, source: io::Error },
    #[error("{path}, line {line}: expected x,y,z, three finite numbers, found “{found}”")]
    Point {
        path: String,
        line: usize,
        found: String,
    },
    #[error("standard output: {0}")]
    Output(io::Error),
    #[error("{0}")]
    Window(String),
    #[error("{0}")]
    Usage(&'static str),
}

/// Runs the command line. Without arguments it opens the window.
pub fn run() -> ExitCode {
    let args = match Args::try_parse() {
        Ok(args) => args,
        Err(error) => {
            // Help and version go to standard output and are no error.
            let code = if error.use_stderr() { 2 } else { 0 };
            let _unprintable = error.print();
            return ExitCode::from(code);
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

fn one_line(message: &dyn fmt::Display) -> String {
    let text = message.to_string();
    let lines: Vec<&str> = text
        .lines()
        .map(str::trim)
        .filter(|line| !line.is_empty())
        .collect();
    let text = lines.join("; ");
    // What came from a file or a link goes to a terminal: nothing in it may steer that.
    text.chars()
        .map(|c| if c.is_control() { '\u{fffd}' } else { c })
        .collect()
}

fn notice(message: impl fmt::Display) {
    eprintln!("notice: {}", one_line(&message));
}

fn execute(args: Args) -> Result<(), CliError> {
    let common = &args.common;
    match args.command.unwrap_or(Command::View { doc: None }) {
        Command::View { doc } => {
            let opened = doc.as_deref().map(open).transpose()?;
            if let Some(opened) = &opened {
                opened.say_notices();
            }
            let opening = super::native::Opening {
                folder: opened.as_ref().map(|opened| opened.folder.clone()),
                document: opened.map(|opened| opened.document),
                subject: common.subject.clone(),
                reading: common.reading.clone(),
                adapter: common.adapter.clone(),
            };
            super::native::view(opening).map_err(|error| CliError::Window(error.to_string()))
        }
        Command::Render {
            doc,
            output,
            size,
            moment,
            samples,
            lettering,
        } => {
            let paper = Paper {
                size,
                samples,
                lettering,
            };
            render(common, &open(&doc)?, &output, moment, paper)
        }
        Command::Probe {
            doc,
            points,
            object,
            moment,
        } => {
            let points = points.filter(|path| path != Path::new("-"));
            if doc == "-" && points.is_none() {
                return Err(CliError::Usage(
                    "document and points cannot both come from standard input: name a file by --points",
                ));
            }
            probe(common, &open(&doc)?, points.as_deref(), object, moment)
        }
        Command::ExportField {
            doc,
            output,
            size,
            moment,
        } => {
            let bytes = super::fields::export_field(common, &open(&doc)?, moment, size)?;
            write_whole(&output, &bytes)
        }
        Command::Link { doc, page } => {
            let opened = open(&doc)?;
            opened.say_notices();
            let fragment = link::fragment(&opened.document, opened.step);
            if fragment.len() > link::ADVISED_LENGTH {
                notice(format!(
                    "the link has {} characters; above {} some programs cut it, a document file is safer",
                    fragment.len(),
                    link::ADVISED_LENGTH
                ));
            }
            let page = page.unwrap_or_default();
            let page = page.split('#').next().unwrap_or_default();
            print(&format!("{page}{fragment}\n"))
        }
        Command::Doc { doc } => {
            let opened = open(&doc)?;
            opened.say_notices();
            print(&opened.document.to_json())
        }
        Command::Info { file } => info(common, &file),
        Command::Templates { json } => print(&if json {
            templates_json()
        } else {
            templates_text()
        }),
        Command::Bench { json } => bench(common, json),
    }
}

fn print(text: &str) -> Result<(), CliError> {
    let mut out = io::stdout().lock();
    out.write_all(text.as_bytes())
        .and_then(|()| out.flush())
        .map_err(CliError::Output)
}

/// A document, where its relative addresses start, and the step that its link names.
pub(super) struct Opened {
    document: Document,
    pub(super) folder: PathBuf,
    step: usize,
}

impl Opened {
    fn say_notices(&self) {
        for line in self.document.notices() {
            notice(line);
        }
    }

    /// What the document says at a moment, its notices said.
    pub(super) fn illustration(
        &self,
        moment: Moment,
        common: &Common,
    ) -> Result<Illustration, CliError> {
        let mut illustration = self.at_moment(moment)?;
        attach_fields(&mut illustration, common, &self.folder, &mut |line| {
            notice(line);
        })?;
        Ok(illustration)
    }

    fn at_moment(&self, moment: Moment) -> Result<Illustration, CliError> {
        self.say_notices();
        let last = self.document.step_count();
        let step = moment.step.unwrap_or_else(|| {
            if self.step > last {
                notice(format!(
                    "the link opens at step {}, the last is {last}",
                    self.step
                ));
            }
            self.step.min(last)
        });
        let at_step = self.document.at_step(step).map_err(CliError::Step)?;
        for line in at_step.notices() {
            if !self.document.notices().contains(line) {
                notice(format!("step {step}: {line}"));
            }
        }
        match moment.time {
            Some(_) if step == 0 => {
                notice("there is no passage to step 0; --time changes nothing");
                Ok(at_step.illustration().clone())
            }
            Some(seconds) => self.document.at_time(step, seconds).map_err(CliError::Step),
            None => Ok(at_step.illustration().clone()),
        }
    }
}

/// Opens DOC: an existing path, a link, a payload, or `-`.
fn open(doc: &str) -> Result<Opened, CliError> {
    let here = PathBuf::from(".");
    if doc == "-" {
        let text = read_text(io::stdin().lock(), "standard input")?;
        return from_text(&text, "standard input", here);
    }
    let path = Path::new(doc);
    if path.exists() {
        let file = std::fs::File::open(path).map_err(|source| CliError::Read {
            path: doc.to_owned(),
            source,
        })?;
        let text = read_text(file, doc)?;
        let folder = match path.parent() {
            Some(parent) if !parent.as_os_str().is_empty() => parent.to_path_buf(),
            _ => here,
        };
        return from_text(&text, doc, folder);
    }
    match link::decode(doc) {
        Ok(link) => Ok(Opened {
            document: link.document,
            folder: here,
            step: link.step,
        }),
        Err(source @ (LinkError::Foreign { .. } | LinkError::Empty)) if !doc.contains('#') => {
            Err(CliError::NeitherFileNorLink {
                path: format!("“{}”", shortened(doc)),
                source,
            })
        }
        Err(source) => Err(CliError::Link {
            path: shortened(doc),
            source,
        }),
    }
}

pub(super) fn shortened(text: &str) -> String {
    match text.char_indices().nth(60) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text.to_owned(),
    }
}

fn read_text(from: impl io::Read, path: &str) -> Result<String, CliError> {
    let mut bytes = Vec::new();
    from.take(MAX_BYTES as u64 + 1)
        .read_to_end(&mut bytes)
        .map_err(|source| CliError::Read {
            path: path.to_owned(),
            source,
        })?;
    if bytes.len() > MAX_BYTES {
        return Err(CliError::TooLong {
            path: path.to_owned(),
        });
    }
    String::from_utf8(bytes).map_err(|_not_utf8| CliError::NotUtf8 {
        path: path.to_owned(),
    })
}

/// A file holds a document, or just its link.
fn from_text(text: &str, path: &str, folder: PathBuf) -> Result<Opened, CliError> {
    let is_link = text.trim().lines().count() == 1 && link::decode(text).is_ok();
    if is_link && let Ok(link) = link::decode(text) {
        return Ok(Opened {
            document: link.document,
            folder,
            step: link.step,
        });
    }
    let document = Document::from_json(text).map_err(|source| CliError::Document {
        path: path.to_owned(),
        source,
    })?;
    Ok(Opened {
        document,
        folder,
        step: 0,
    })
}

pub(super) fn open_gpu(common: &Common) -> Result<Gpu, CliError> {
    let gpu = pollster::block_on(Gpu::open(&GpuOptions {
        adapter: common.adapter.clone(),
        is_strict: false,
    }))?;
    if gpu.is_software() {
        notice(format!(
            "no graphics device in use; drawing on the processor ({})",
            gpu.info.name
        ));
    }
    Ok(gpu)
}

pub(super) fn subject_of(
    illustration: &Illustration,
    common: &Common,
    folder: &Path,
    limits: VolumeLimits,
) -> Result<Volume, CliError> {
    let source = SubjectSource {
        folder,
        instead: common.subject.as_deref(),
        reading: &common.reading,
        segments: &common.segments,
        limits,
    };
    Ok(load_subject(illustration, source, &mut |line| {
        notice(line)
    })?)
}

/// Names what `keep` asks for and the subject has not.
pub(super) fn say_kept(illustration: &Illustration, volume: &Volume) {
    let segments = volume.labels.as_ref().map_or(&[][..], |l| &l.segments);
    let bounds = volume.grid.subject_bounds();
    for line in KeptTissue::of(&illustration.templates, segments, bounds).notices() {
        notice(line);
    }
}

/// What a picture is drawn on.
struct Paper {
    /// Width and height, pixels.
    size: [u32; 2],
    /// Per pixel.
    samples: u32,
    /// With title, credit and labels.
    lettering: bool,
}

fn render(
    common: &Common,
    opened: &Opened,
    output: &Path,
    moment: Moment,
    paper: Paper,
) -> Result<(), CliError> {
    let illustration = opened.illustration(moment, common)?;
    // Found out before minutes of drawing, not after.
    let folder = output
        .parent()
        .filter(|folder| !folder.as_os_str().is_empty());
    if output.is_dir() || folder.is_some_and(|folder| !folder.is_dir()) {
        return Err(CliError::Write {
            path: output.display().to_string(),
            source: io::Error::from(if output.is_dir() {
                io::ErrorKind::IsADirectory
            } else {
                io::ErrorKind::NotFound
            }),
        });
    }
    let gpu = open_gpu(common)?;
    let volume = subject_of(&illustration, common, &opened.folder, gpu.volume_limits())?;
    say_kept(&illustration, &volume);
    let studio = Studio::new(&gpu, &volume, true)?;
    let drawing = studio.render_image(&illustration, paper.size, paper.samples);
    let mut image = pollster::block_on(drawing)?;
    if paper.lettering {
        let places = crate::app::label_places(&studio, &illustration, paper.size);
        let places = pollster::block_on(places)?;
        let missing = crate::app::letter(&mut image, &illustration, &places);
        if !missing.is_empty() {
            notice(format!("no font here has the characters {missing}"));
        }
    }
    let bytes = encode_png(&image)?;
    write_whole(output, &bytes)
}

/// Writes beside the file first, so that none is ever left half-written.
fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), CliError> {
    let mut name = path.file_name().unwrap_or_default().to_os_string();
    name.push(format!(".{}.part", std::process::id()));
    let part = path.with_file_name(name);
    let write = || -> io::Result<()> {
        let mut file = std::fs::File::create(&part)?;
        file.write_all(bytes)?;
        file.sync_all()?;
        std::fs::rename(&part, path)
    };
    write().map_err(|source| {
        // It may never have been made.
        let _gone = std::fs::remove_file(&part);
        CliError::Write {
            path: path.display().to_string(),
            source,
        }
    })
}

fn info(common: &Common, file: &Path) -> Result<(), CliError> {
    let description = common.reading.describe(file).map_err(|error| {
        let name = file.to_string_lossy();
        if let Some(hint) = hint(&name, &error) {
            notice(hint);
        }
        CliError::Load(error, name.into_owned())
    })?;
    for line in description.report.notices() {
        notice(line);
    }
    print(&format!("{}\n", description.to_string().trim_end()))
}

fn templates_json() -> String {
    let templates: Vec<Value> = TemplateKind::ALL
        .iter()
        .map(|kind| {
            let spec = kind.spec();
            let params: Vec<Value> = spec
                .params
                .iter()
                .map(|param| {
                    let mut value = json!({ "name": param.name, "summary": param.summary });
                    let mut set = |key: &str, to: Value| value[key] = to;
                    match param.kind {
                        ParamKind::Number { default, min, max }
                        | ParamKind::Count { default, min, max } => {
                            let is_count = matches!(param.kind, ParamKind::Count { .. });
                            set("type", json!(if is_count { "count" } else { "number" }));
                            set("default", json!(plain_f64(default)));
                            set("min", json!(plain_f64(min)));
                            set("max", json!(plain_f64(max)));
                        }
                        ParamKind::Flag { default } => {
                            set("type", json!("flag"));
                            set("default", json!(default));
                        }
                        ParamKind::Choice { names } => {
                            set("type", json!("choice"));
                            set("default", json!(names.first()));
                            set("choices", json!(names));
                        }
                        ParamKind::Vector {
                            default,
                            min,
                            max,
                            max_length,
                        } => {
                            set("type", json!("vector"));
                            set("default", json!(default.map(plain_f64)));
                            set("min", json!(plain_f64(min)));
                            set("max", json!(plain_f64(max)));
                            if max_length.is_finite() {
                                set("max_length", json!(plain_f64(max_length)));
                            }
                        }
                        ParamKind::Rotation => {
                            set("type", json!("rotation"));
                            set("default", json!([0, 0, 0, 1]));
                        }
                    }
                    value
                })
                .collect();
            let mut value = json!({ "kind": spec.name, "summary": spec.summary, "params": params });
            if let Some(main) = spec.main_param.and_then(|i| spec.params.get(i)) {
                value["main"] = json!(main.name);
            }
            value
        })
        .collect();
    match serde_json::to_string_pretty(&templates) {
        Ok(text) => format!("{text}\n"),
        // Keys are texts and numbers are finite, so this cannot be; compact JSON is as good.
        Err(_) => format!("{}\n", Value::from(templates)),
    }
}

fn templates_text() -> String {
    let mut text = String::new();
    for kind in TemplateKind::ALL {
        let spec = kind.spec();
        text.push_str(&format!("{}: {}\n", spec.name, spec.summary));
        for param in spec.params {
            let values = match param.kind {
                ParamKind::Number { default, min, max } => format!("{default} ({min} to {max})"),
                ParamKind::Count { default, min, max } => {
                    format!("{default} ({min} to {max}, whole)")
                }
                ParamKind::Flag { default } => default.to_string(),
                ParamKind::Choice { names } => names.join(" | "),
                ParamKind::Vector {
                    default: [x, y, z],
                    min,
                    max,
                    max_length,
                } => {
                    let length = if max_length.is_finite() {
                        format!(", length up to {max_length}")
                    } else {
                        String::new()
                    };
                    format!("[{x}, {y}, {z}] (each {min} to {max}{length})")
                }
                ParamKind::Rotation => "[0, 0, 0, 1] (quaternion x, y, z, w)".to_owned(),
            };
            text.push_str(&format!(
                "  {:<10} {:<44} {}\n",
                param.name, values, param.summary
            ));
        }
    }
    text
}

/// Size of the measured picture, pixels: small enough for a software GPU to end within a minute or two.
const BENCH_SIZE: [u32; 2] = [256, 256];
/// Frames per case; the median counts.
const BENCH_REPEATS: usize = 7;

fn bench(common: &Common, as_json: bool) -> Result<(), CliError> {
    let gpu = open_gpu(common)?;
    let illustration = Document::new().illustration().clone();
    let volume = subject_of(&illustration, common, Path::new("."), gpu.volume_limits())?;
    let rows = pollster::block_on(crate::render::bench(
        &gpu,
        &volume,
        &illustration.subject,
        BENCH_SIZE,
        BENCH_REPEATS,
        crate::render::system_clock,
    ))?;
    let dims = volume.grid.dims.to_array();
    if as_json {
        let rows: Vec<Value> = rows
            .iter()
            .map(|row| {
                json!({
                    "name": row.name, "templates": row.template_count, "grid": row.has_grid,
                    "ms": row.seconds * 1e3, "making_ms": row.making_seconds * 1e3, "ratio": row.ratio, "grid_gain": row.grid_gain,
                })
            })
            .collect();
        let all =
            json!({ "adapter": gpu.info.name, "voxels": dims, "size": BENCH_SIZE, "frames": rows });
        return print(&format!("{all:#}\n"));
    }
    let [x, y, z] = dims;
    let [width, height] = BENCH_SIZE;
    let mut text = format!(
        "{}, {x} x {y} x {z} voxels, {width} x {height} pixels; ratios to the undeformed frame with the grid\n",
        gpu.info.name
    );
    for row in &rows {
        text.push_str(&format!("{row}\n"));
    }
    print(&text)
}
