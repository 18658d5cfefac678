//! `fabrica render`: one picture, drawn without a window.

use std::fs::File;
use std::io;
use std::path::Path;

use super::args::{Common, Moment};
use super::device::open_gpu;
use super::error::CliError;
use super::objects::{Needed, objects_of};
use super::opening::Opened;
use super::output::{WholeFile, notice, unwritten};
use super::progress::Progress;
use super::stop;
use super::subject::{report_drawing, subject_of};
use crate::app::Lettering;
use crate::document::Background;
use crate::render::{PngRows, RenderError, Rows, Studio, Taker};

/// Dots per inch that a file may say.
const DPI_RANGE: [f32; 2] = [1.0, 9600.0];

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
    let studio = Studio::new(&gpu, &subject, true)?.with_resources(resources);
    let places = match paper.lettering {
        true => Some(pollster::block_on(crate::render::caption_places(
            &studio,
            &illustration,
            paper.size,
        ))?),
        false => None,
    };
    if paper.lettering {
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
    let file = WholeFile::create(output).map_err(|source| unwritten(output, source))?;
    let out = file.writer().map_err(|source| unwritten(output, source))?;
    let print = Print {
        png: PngRows::new(out, paper.size, dpi)?,
        lettering,
        progress: Progress::start(),
    };
    let drawing = studio.render_rows(&illustration, paper.size, paper.samples, None, print);
    let written = pollster::block_on(drawing).and_then(|print| print.png.finish());
    written.map_err(|error| match error {
        RenderError::Stopped => CliError::Stopped {
            path: output.display().to_string(),
        },
        RenderError::Png(png::EncodingError::IoError(source)) => unwritten(output, source),
        error => error.into(),
    })?;
    file.finish().map_err(|source| unwritten(output, source))
}

/// A picture on its way into a PNG file.
struct Print {
    png: PngRows<File>,
    lettering: Lettering,
    progress: Progress,
}

impl Taker for Print {
    fn progress(&mut self, part: f32) -> Result<(), RenderError> {
        if stop::is_wished() {
            return Err(RenderError::Stopped);
        }
        self.progress.tell(part);
        Ok(())
    }

    fn take(&mut self, mut rows: Rows) -> Result<(), RenderError> {
        self.lettering.lay(rows.first, &mut rows.rgba);
        self.png.write(&rows.rgba)
    }
}
