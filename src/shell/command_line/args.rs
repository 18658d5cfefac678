//! The arguments of the command line.

use std::path::PathBuf;

use clap::{Parser, Subcommand};

use super::reading::ReadingFlags;
use crate::describe::Lang;
use crate::render::MOST_PX;

/// Opens CT and MRI scans the way a medical illustrator would.
///
/// DOC is an existing file, a link, or a link's payload; - reads a document from standard input.
#[derive(Debug, Parser)]
#[command(name = "fabrica", version, max_term_width = 100)]
pub(super) struct Args {
    #[command(subcommand)]
    pub(super) command: Option<Command>,
    #[command(flatten)]
    pub(super) common: Common,
}

#[derive(Debug, clap::Args)]
pub(super) struct Common {
    /// A scan, a mesh or a picture that takes the place of the document's subject; of a clay it is the mesh that it
    /// begins with, and the strokes stay.
    #[arg(long, global = true, value_name = "FILE")]
    pub(super) subject: Option<PathBuf>,
    /// A displacement field that the document names by its hash; may be given several times.
    #[arg(long, global = true, value_name = "FILE")]
    pub(super) field: Vec<PathBuf>,
    /// A label volume beside the scan; may be given several times.
    #[arg(long, global = true, value_name = "FILE")]
    pub(super) segments: Vec<PathBuf>,
    /// A mesh of the subject that the document names by its hash, that which a clay begins with too; may be given
    /// several times.
    #[arg(long = "mesh", global = true, value_name = "FILE")]
    pub(super) meshes: Vec<PathBuf>,
    #[command(flatten)]
    pub(super) reading: ReadingFlags,
    /// The graphics adapter to use, by (part of) its name.
    #[arg(long, global = true, value_name = "NAME")]
    pub(super) adapter: Option<String>,
}

#[derive(Debug, Subcommand)]
pub(super) enum Command {
    /// Opens a window to view and edit an illustration.
    View {
        /// What to open; without it, what was open the last time.
        doc: Option<String>,
    },
    /// Draws without a window.
    Render {
        /// Document, link or payload to draw; - for a document on standard input.
        doc: String,
        /// The file to write: a PNG, or an SVG with texts and outlines as such if the name ends in .svg.
        #[arg(short, long, value_name = "FILE")]
        output: PathBuf,
        /// Width and height, pixels: each up to 8192.
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
        /// Draws on no background, whatever the document says.
        #[arg(long)]
        transparent: bool,
        /// Lays a soft shadow of the object on what is behind it, as if it lay on paper.
        #[arg(long)]
        shadow: bool,
        /// Dots per inch that the picture is printed with, which the file says.
        #[arg(long, value_name = "N", value_parser = parse_dpi)]
        dpi: Option<f32>,
    },
    /// Says where the material at a point comes from: reads x,y,z lines, prints x,y,z,sx,sy,sz,a lines.
    Probe {
        /// Document, link or payload to probe; - for a document on standard input.
        doc: String,
        /// Lines of x,y,z in the deformed subject; standard input without it, or for -.
        #[arg(long, value_name = "FILE")]
        points: Option<PathBuf>,
        /// Looks into the subject as well: adds value,segment, empty where there is nothing.
        #[arg(long)]
        object: bool,
        /// Adds how deep under the surface of a mesh the material was, subject units; below 0 outside.
        #[arg(long)]
        depth: bool,
        /// Reads places of a figure at rest instead, and says where they go.
        #[arg(long, conflicts_with_all = ["depth", "rays"])]
        forward: bool,
        /// Reads ox,oy,oz,dx,dy,dz lines instead, from FILE or standard input, and prints what each ray meets:
        /// ox,oy,oz,dx,dy,dz,t,x,y,z,nx,ny,nz,sx,sy,sz,what,segment,color.
        #[arg(long, value_name = "FILE", num_args = 0..=1, default_missing_value = "-",
            conflicts_with_all = ["points", "object", "depth"])]
        rays: Option<PathBuf>,
        #[command(flatten)]
        moment: Moment,
    },
    /// Writes the composed map of a document as a displacement field: NRRD, millimetres from output to input, and
    /// continuity.
    ExportField {
        /// Document, link or payload whose map is written; - for a document on standard input.
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
    /// Writes a bent figure: its numbers, its shapes or its pixels.
    ExportFigure {
        /// Document, link or payload whose figure is written; - for a document on standard input.
        doc: String,
        /// The file to write: .json (mesh, handles, places), .svg (the shapes of a drawing, bent), or .png.
        #[arg(short, long, value_name = "FILE")]
        output: PathBuf,
        /// Pixels along the longest side of a .png; without it those of the source, 2048 of a drawing.
        #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=i64::from(MOST_PX)))]
        size: Option<u32>,
        #[command(flatten)]
        moment: Moment,
    },
    /// Writes a clay as a mesh, or checks its mesh.
    Clay {
        /// Document, link or payload whose subject is a clay; - for a document on standard input.
        doc: String,
        /// The file to write: .ply, .obj, .stl (millimetres) or .glb (metres).
        #[arg(
            short,
            long,
            value_name = "FILE",
            required_unless_present = "check",
            conflicts_with = "check"
        )]
        output: Option<PathBuf>,
        /// Writes a .stl or a .ply as text, to be looked at.
        #[arg(long, requires = "output")]
        text: bool,
        /// Prints what the mesh is like: whether it is closed, its edges, angles, triangles that intersect, its hash.
        #[arg(long)]
        check: bool,
        /// Prints that as JSON.
        #[arg(long, requires = "check", conflicts_with = "output")]
        json: bool,
        /// The clay after its first strokes, those that are off counted; without it as the document shows it.
        #[arg(long, value_name = "N")]
        strokes: Option<u32>,
        #[command(flatten)]
        moment: Moment,
    },
    /// Prints the link of a document.
    Link {
        /// Document, link or payload to link to; - for a document on standard input.
        doc: String,
        /// The page in front of the link.
        #[arg(long, value_name = "URL")]
        page: Option<String>,
        /// Also writes the link as a QR code: a file that ends in .svg or .png.
        #[arg(long, value_name = "FILE")]
        qr: Option<PathBuf>,
    },
    /// Tells in words what the pictures of a document show: a paragraph for each step.
    Describe {
        /// Document, link or payload to describe; - for a document on standard input.
        doc: String,
        /// Only this step; 0 is the document itself.
        #[arg(long, value_name = "N")]
        step: Option<usize>,
        /// Language of the words, en, de, es or zh; without it the document's, else English.
        #[arg(long, value_name = "LANG", value_parser = parse_lang)]
        lang: Option<Lang>,
        /// Prints JSON, with the numbers.
        #[arg(long)]
        json: bool,
    },
    /// Prints the document of a link, as canonical JSON.
    Doc {
        /// Document, link or payload to print; - for a document on standard input.
        doc: String,
    },
    /// Says what a data file or a document holds.
    Info {
        /// The data file: a scan (NIfTI, NRRD, MetaImage, DICOM), a mesh (OBJ, STL, PLY, GLB), or the picture of a
        /// figure (PNG, JPEG, SVG). Or a document: its file, a link, a payload, or - for standard input.
        file: String,
    },
    /// Lists the displacement templates with parameters, defaults and ranges.
    Templates {
        /// Prints JSON instead of text.
        #[arg(long)]
        json: bool,
    },
    /// Measures frame times on this adapter, as ratios to the undeformed frame.
    Bench {
        /// Measures the shaping of clay instead, which needs no adapter: ratios and counts beside their limits.
        #[arg(long)]
        clay: bool,
        /// Prints JSON instead of text.
        #[arg(long)]
        json: bool,
    },
}

/// A moment of a lesson.
#[derive(Clone, Copy, Debug, clap::Args)]
pub(super) struct Moment {
    /// The step; a link may name one itself, else 0.
    #[arg(long, value_name = "N")]
    pub(super) step: Option<usize>,
    /// Seconds into the passage to that step; without it, its end.
    #[arg(long, value_name = "T", value_parser = parse_seconds)]
    pub(super) time: Option<f32>,
}

fn parse_size(text: &str) -> Result<[u32; 2], String> {
    let side = |text: &str| {
        text.trim()
            .parse::<u32>()
            .ok()
            .filter(|side| (1..=MOST_PX).contains(side))
    };
    text.split_once(['x', 'X', '×'])
        .and_then(|(width, height)| Some([side(width)?, side(height)?]))
        .ok_or_else(|| {
            format!("expected width and height such as 1024x768, each from 1 to {MOST_PX}")
        })
}

fn parse_dpi(text: &str) -> Result<f32, String> {
    match text.trim().parse::<f32>() {
        Ok(dpi) if dpi.is_finite() => Ok(dpi),
        _ => Err("expected a number of dots per inch, such as 300".to_owned()),
    }
}

fn parse_lang(text: &str) -> Result<Lang, String> {
    Lang::from_tag(text).ok_or_else(|| {
        let tags = Lang::ALL.map(Lang::tag).join(", ");
        format!("pictures are described in these languages: {tags}")
    })
}

fn parse_seconds(text: &str) -> Result<f32, String> {
    match text.parse::<f32>() {
        Ok(seconds) if seconds.is_finite() && seconds >= 0.0 => Ok(seconds),
        _ => Err("expected seconds, 0 or more".to_owned()),
    }
}
