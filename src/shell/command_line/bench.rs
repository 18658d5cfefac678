//! `fabrica bench`: frame times on this adapter, and what the shaping of clay costs.

use std::path::Path;
use std::sync::Arc;

use super::args::Common;
use super::device::open_gpu;
use super::error::{CliError, MissingSubject};
use super::objects::generated;
use super::output::print;
use super::subject::{generate, subject_of, surface_of};
use crate::clay::bench_clay;
use crate::data::{Subject, Surface};
use crate::document::{Document, SceneObject};
use crate::figure::{FigureRow, bench_figures};
use crate::render::{BenchMeshes, BenchPlan, system_clock};
use crate::subjects::{SubjectError, mesh};

/// The mesh that is measured where none is given.
const MESH: &str = "apple";
/// The scan that is measured where none is given.
const SCAN: &str = "head";

/// Measures the head and the apple. A file of `--subject` takes the place of the one or the other, whichever it is.
pub(super) fn bench(common: &Common, as_json: bool) -> Result<(), CliError> {
    let gpu = open_gpu(common)?;
    let illustration = Document::new().illustration().clone();
    let given = subject_of(&illustration, common, Path::new("."), gpu.volume_limits())?;
    let (scan, surface) = match given {
        Subject::Mesh(surface) => (generate(SCAN, 1)?, surface),
        scan @ Subject::Space(_) => (scan, built_in_mesh()?),
        Subject::Figure(_) => {
            return Err(CliError::Usage("figures are measured without --subject"));
        }
    };
    let tool = generated(SceneObject::BUILTINS[0], false)?;
    let report = pollster::block_on(crate::render::bench(
        &gpu,
        (&scan, &illustration.subject),
        Some(&BenchMeshes {
            finer: Some(Arc::new(surface.parted().parted())),
            surface,
            tool,
        }),
        BenchPlan::default(),
        system_clock,
        |_| {},
    ))?;
    let figures =
        bench_figures(system_clock).map_err(|error| CliError::Field(error.to_string()))?;
    if as_json {
        let mut report = report.to_json();
        report["figures"] = figures.iter().map(FigureRow::to_json).collect();
        return print(&format!("{report:#}\n"));
    }
    let figures = figures.iter().map(|row| format!("{row}\n"));
    print(&(report.to_string() + &figures.collect::<String>()))
}

fn built_in_mesh() -> Result<Arc<Surface>, MissingSubject> {
    let mesh = mesh(MESH).ok_or_else(|| SubjectError::UnknownName(MESH.to_owned()))?;
    surface_of(&mesh)
}

/// Measures the shaping of clay, without an adapter.
pub(super) fn bench_of_clay(as_json: bool) -> Result<(), CliError> {
    let report = bench_clay(system_clock).map_err(MissingSubject::Clay)?;
    print(&match as_json {
        true => format!("{:#}\n", report.to_json()),
        false => report.to_string(),
    })
}
