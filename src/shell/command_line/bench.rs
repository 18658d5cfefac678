//! `fabrica bench`: frame times on this adapter.

use std::path::Path;

use super::args::Common;
use super::device::open_gpu;
use super::error::CliError;
use super::output::print;
use super::subject::subject_of;
use crate::document::Document;
use crate::render::{BENCH_REPEATS, BENCH_SIZE_PX, system_clock};

pub(super) fn bench(common: &Common, as_json: bool) -> Result<(), CliError> {
    let gpu = open_gpu(common)?;
    let illustration = Document::new().illustration().clone();
    let subject = subject_of(&illustration, common, Path::new("."), gpu.volume_limits())?;
    let report = pollster::block_on(crate::render::bench(
        &gpu,
        (&subject, &illustration.subject),
        BENCH_SIZE_PX,
        BENCH_REPEATS,
        system_clock,
        |_| {},
    ))?;
    if as_json {
        return print(&format!("{:#}\n", report.to_json()));
    }
    print(&report.to_string())
}
