//! `fabrica describe`: a document in words, a paragraph for each step.

use serde_json::Value;

use super::args::Common;
use super::device::open_gpu;
use super::error::CliError;
use super::fields::fields_of;
use super::figures::with_sheet;
use super::objects::{Needed, objects_of};
use super::opening::Opened;
use super::output::{notice, print};
use super::subject::{report_drawing, subject_of};
use crate::data::ObjectMeshes;
use crate::describe::{Description, Lang, Measured, Sight, describe as in_words};
use crate::render::{SIGHT_PX, Studio};

/// Prints what each picture shows. Without a step all of them, unless the link names one; without a language in that of
/// the document where it is one of the four, else in English.
pub(super) fn describe(
    common: &Common,
    opened: &Opened,
    step: Option<usize>,
    lang: Option<Lang>,
    is_json: bool,
) -> Result<(), CliError> {
    opened.report_notices();
    let document = &opened.document;
    let whole = document.illustration();
    let lang = lang
        .or(Lang::from_tag(&whole.lang))
        .unwrap_or(Lang::English);
    let last = document.step_count();
    let steps = match step.or((opened.step > 0).then_some(opened.step.min(last))) {
        Some(step) => step..step + 1,
        None => 0..last + 1,
    };
    // A step that is not there is told before anything is loaded.
    let lesson = document.lesson().map_err(CliError::Step)?;
    let first = lesson.at_step(steps.start).map_err(CliError::Step)?;
    let gpu = open_gpu(common)?;
    let limits = gpu.volume_limits();
    let mut subject = subject_of(first, common, &opened.folder, limits)?;
    let mut studio = Studio::new(&gpu, &subject, true)?;
    let mut of = first.subject_shown();
    let mut told: Vec<Description> = Vec::new();
    let mut bender = None;
    for step in steps {
        let at_step = document.at_step(step).map_err(CliError::Step)?;
        for line in at_step.notices() {
            if !document.notices().contains(line) {
                notice(format!("step {step}: {line}"));
            }
        }
        let shown = at_step.illustration();
        // A step may show more or fewer strokes of a clay.
        if shown.subject_shown() != of {
            of = shown.subject_shown();
            subject = subject_of(shown, common, &opened.folder, limits)?;
            studio = Studio::new(&gpu, &subject, true)?;
        }
        let mut resources = fields_of(shown, common, &opened.folder)?;
        let place = (common, opened.folder.as_path());
        resources.objects = objects_of(shown, Needed::All, ObjectMeshes::new(), place)?;
        resources.grids.baked = subject.baked();
        if told.is_empty() {
            report_drawing(shown, &resources, &subject);
        }
        let (shown, resources) = with_sheet(&mut bender, shown.clone(), resources, &subject)?;
        let shown = &shown;
        let studio = studio.clone().with_resources(resources);
        let sighting = pollster::block_on(studio.identify(shown, SIGHT_PX))?;
        let measured = Measured {
            sight: Some(Sight::count(sighting.labels, &studio.sighted())),
            mm_per_unit: Some(subject.frame().mm_per_unit),
            turned: None,
        };
        told.push(in_words(document, step, &measured, lang).map_err(CliError::Step)?);
    }
    if is_json {
        let steps: Vec<Value> = told.iter().map(Description::to_json).collect();
        // Keys are texts and numbers are finite, so pretty JSON cannot fail; compact JSON is as good.
        let text = serde_json::to_string_pretty(&steps)
            .unwrap_or_else(|_unwritten| Value::from(steps).to_string());
        return print(&format!("{text}\n"));
    }
    let paragraphs: Vec<&str> = told.iter().map(Description::text).collect();
    print(&format!("{}\n", paragraphs.join("\n\n")))
}
