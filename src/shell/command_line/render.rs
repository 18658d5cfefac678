//! `fabrica render`: one picture, drawn without a window.

use std::io;
use std::path::Path;

use super::args::{Common, Moment};
use super::device::open_gpu;
use super::error::CliError;
use super::objects::{Needed, objects_of};
use super::opening::Opened;
use super::output::{notice, write_whole};
use super::subject::{report_drawing, subject_of};
use crate::render::{Studio, encode_png};

/// What a picture is drawn on.
pub(super) struct Paper {
    /// Width and height, pixels.
    pub(super) size: [u32; 2],
    /// Samples per pixel, 1 to 1,024.
    pub(super) samples: u32,
    /// With title, credit and labels.
    pub(super) lettering: bool,
}

pub(super) fn render(
    common: &Common,
    opened: &Opened,
    output: &Path,
    moment: Moment,
    paper: Paper,
) -> Result<(), CliError> {
    let (illustration, mut resources) = opened.illustration(moment, common)?;
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
    let drawing = studio.render_image(&illustration, paper.size, paper.samples);
    let mut image = pollster::block_on(drawing)?;
    crate::app::mark(&mut image, &illustration, subject.mm_per_unit());
    if paper.lettering {
        let places = crate::render::caption_places(&studio, &illustration, paper.size);
        let places = pollster::block_on(places)?;
        for (index, text) in illustration.unshaped_captions() {
            notice(format!(
                "/labels/{index}/text: “{text}” cannot be shaped here: its letters stand unjoined and from the left; browsers set it rightly"
            ));
        }
        let missing = crate::app::letter(&mut image, &illustration, &places);
        if !missing.is_empty() {
            notice(format!("no font here has the characters {missing}"));
        }
    }
    let bytes = encode_png(&image)?;
    write_whole(output, &bytes)
}
