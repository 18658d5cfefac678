//! `fabrica render`: one picture, drawn without a window.

use std::io::{self, Write as _};
use std::path::Path;
use std::rc::Rc;

use super::args::{Common, Moment};
use super::device::open_gpu;
use super::error::CliError;
use super::figures::{finer, with_sheet};
use super::objects::{Needed, objects_of};
use super::opening::Opened;
use super::output::{WholeFile, notice, unwritten};
use super::progress::Progress;
use super::stop;
use super::subject::{report_drawing, subject_of};
use super::svg::{Pen, Plate};
use crate::app::Lettering;
use crate::describe::{Lang, Measured, Sight, describe_shown};
use crate::document::{Background, Illustration};
use crate::math::borders::borders;
use crate::render::{
    FileInMemory, PictureSpec, PngRows, RenderError, Rows, SIGHT_PX, Studio, Taker, shrunk,
};

/// Dots per inch that a file may say.
const DPI_RANGE: [f32; 2] = [1.0, 9600.0];
/// Pixels along the longer side of the picture that outlines are found in: 64 MiB.
const OUTLINE_PX: u32 = 2048;

/// What a picture is drawn on.
pub(super) struct Paper {
    /// Width and height, pixels.
    pub(super) size: [u32; 2],
    /// Samples per pixel, 1 to 1,024.
    pub(super) samples: u32,
    /// With title, credit and labels.
    pub(super) lettering: bool,
    /// Without a background.
    pub(super) transparent: bool,
    /// With a soft shadow of the object on what is behind it.
    pub(super) shadow: bool,
    /// Dots per inch that it is printed with.
    pub(super) dpi: Option<f32>,
}

impl Paper {
    /// The dots per inch that the file says, brought into their range, which a notice names.
    fn dpi(&self) -> Option<f32> {
        let dpi = self.dpi?;
        let [least, most] = DPI_RANGE;
        let taken = dpi.clamp(least, most);
        if taken != dpi {
            notice(format!(
                "--dpi {dpi} is out of range ({least} to {most}); {taken} is taken"
            ));
        }
        Some(taken)
    }
}

pub(super) fn render(
    common: &Common,
    opened: &Opened,
    output: &Path,
    moment: Moment,
    paper: Paper,
) -> Result<(), CliError> {
    let (mut illustration, mut resources) = opened.illustration(moment, common)?;
    if paper.transparent {
        illustration.look.background = Background::None;
    }
    let dpi = paper.dpi();
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
    let subject = subject_of(&illustration, common, &opened.folder, gpu.volume_limits())?;
    report_drawing(&illustration, &resources, &subject);
    let here = std::mem::take(&mut resources.objects);
    let place = (common, opened.folder.as_path());
    resources.objects = objects_of(&illustration, Needed::All, here, place)?;
    resources.grids.baked = subject.baked();
    let (illustration, resources) = with_sheet(&mut None, illustration, resources, &subject)?;
    let subject = finer(subject, &illustration.camera, paper.size);
    let studio = Studio::new(&gpu, &subject, true)?.with_resources(resources);
    let is_lettered = paper.lettering || is_svg(output);
    let places = match is_lettered {
        true => Some(pollster::block_on(crate::render::caption_places(
            &studio,
            &illustration,
            paper.size,
        ))?),
        false => None,
    };
    if is_lettered && !is_svg(output) {
        for (index, text) in illustration.unshaped_captions() {
            notice(format!(
                "/labels/{index}/text: “{text}” cannot be shaped here: its letters stand unjoined and from the left; browsers set it rightly"
            ));
        }
    }
    let mm_per_unit = subject.mm_per_unit();
    let lettering =
        crate::app::lettering(&illustration, paper.size, mm_per_unit, places.as_deref());
    if !lettering.missing().is_empty() {
        notice(format!(
            "no font here has the characters {}",
            lettering.missing()
        ));
    }
    stop::watch();
    let job = Job {
        studio: &studio,
        illustration: &illustration,
        lettering: Rc::new(lettering),
        paper: &paper,
        dpi,
    };
    let written = match is_svg(output) {
        true => {
            let (step, lang) = (moment.step.unwrap_or(opened.step), Lang::English);
            let told = told(&studio, (opened, step, lang), &illustration, mm_per_unit)?;
            job.write_svg(output, &told)
        }
        false => job.write_png(output),
    };
    written.map_err(|error| match error {
        RenderError::Stopped => CliError::Stopped {
            path: output.display().to_string(),
        },
        RenderError::Png(png::EncodingError::IoError(source)) => unwritten(output, source),
        error => error.into(),
    })
}

fn is_svg(path: &Path) -> bool {
    let ending = path.extension().and_then(|ending| ending.to_str());
    ending.is_some_and(|ending| ending.eq_ignore_ascii_case("svg"))
}

/// What a picture shows, in words.
fn told(
    studio: &Studio,
    (opened, step, lang): (&Opened, usize, Lang),
    shown: &Illustration,
    mm_per_unit: Option<f64>,
) -> Result<String, CliError> {
    let sighting = pollster::block_on(studio.identify(shown, SIGHT_PX))?;
    let measured = Measured {
        sight: Some(Sight::count(sighting.labels, &studio.sighted())),
        mm_per_unit,
        turned: None,
    };
    let document = &opened.document;
    let lang = Lang::from_tag(&document.illustration().lang).unwrap_or(lang);
    let step = step.min(document.step_count());
    let description =
        describe_shown(document, (step, shown), &measured, lang).map_err(CliError::Step)?;
    Ok(description.text().to_owned())
}

/// A picture that is ready to be drawn and written.
struct Job<'a> {
    studio: &'a Studio,
    illustration: &'a Illustration,
    lettering: Rc<Lettering>,
    paper: &'a Paper,
    dpi: Option<f32>,
}

impl Job<'_> {
    fn write_png(self, output: &Path) -> Result<(), RenderError> {
        let file = WholeFile::create(output).map_err(io_error)?;
        let out = file.writer().map_err(io_error)?;
        let lettering = Rc::clone(&self.lettering);
        self.draw(self.illustration, out, Some(lettering), self.dpi)?;
        file.finish().map_err(io_error)
    }

    /// The picture goes into memory as the PNG file that it is inside of the SVG file.
    fn write_svg(self, output: &Path, told: &str) -> Result<(), RenderError> {
        let file = WholeFile::create(output).map_err(io_error)?;
        let grid = shrunk(self.paper.size, OUTLINE_PX);
        let sighting = pollster::block_on(self.studio.identify(self.illustration, grid))?;
        let lines = borders(&sighting.labels, grid);
        // The outlines of a style become paths too, and are not in the picture below them.
        let mut shown = self.illustration.clone();
        let outline = &mut shown.look.style.outline;
        let pen = match outline.width > 0.0 {
            true => Pen {
                width: std::mem::take(&mut outline.width),
                color: outline.color_srgb,
            },
            false => Pen::PLAIN,
        };
        let picture = FileInMemory::default();
        self.draw(&shown, picture.clone(), None, None)?;
        let plate = Plate {
            size: self.paper.size,
            dpi: self.dpi,
            title: &self.illustration.title,
            told,
            png: &picture.take(),
            outlines: (&lines, grid),
            pen,
            lettering: &self.lettering,
        };
        let out = file.writer().map_err(io_error)?;
        let mut out = io::BufWriter::new(out);
        plate.write(&mut out).map_err(io_error)?;
        out.flush().map_err(io_error)?;
        file.finish().map_err(io_error)
    }

    fn draw<W: io::Write + 'static>(
        &self,
        illustration: &Illustration,
        out: W,
        lettering: Option<Rc<Lettering>>,
        dpi: Option<f32>,
    ) -> Result<(), RenderError> {
        let Paper { size, samples, .. } = *self.paper;
        let print = Print {
            png: PngRows::new(out, size, dpi)?,
            lettering,
            progress: Progress::start(),
        };
        let spec = PictureSpec {
            size_px: size,
            samples,
            has_shadow: self.paper.shadow,
        };
        let drawing = self.studio.render_rows(illustration, spec, None, print);
        pollster::block_on(drawing)?.png.finish()
    }
}

fn io_error(source: io::Error) -> RenderError {
    png::EncodingError::from(source).into()
}

/// A picture on its way into a PNG file.
struct Print<W: io::Write + 'static> {
    png: PngRows<W>,
    lettering: Option<Rc<Lettering>>,
    progress: Progress,
}

impl<W: io::Write> Taker for Print<W> {
    fn progress(&mut self, part: f32) -> Result<(), RenderError> {
        if stop::is_wished() {
            return Err(RenderError::Stopped);
        }
        self.progress.tell(part);
        Ok(())
    }

    fn take(&mut self, mut rows: Rows) -> Result<(), RenderError> {
        if let Some(lettering) = &self.lettering {
            lettering.lay(rows.first, &mut rows.rgba);
        }
        self.png.write(&rows.rgba)
    }
}
