//! `fabrica bench`: frame times on this adapter.

use std::path::Path;

use serde_json::{Value, json};

use super::args::Common;
use super::device::open_gpu;
use super::error::CliError;
use super::output::print;
use super::subject::subject_of;
use crate::document::Document;

/// Size of the measured picture, pixels: small enough for a software GPU to end within a minute or two.
const BENCH_SIZE: [u32; 2] = [256, 256];
/// Frames per case; the median counts.
const BENCH_REPEATS: usize = 7;

pub(super) fn bench(common: &Common, as_json: bool) -> Result<(), CliError> {
    let gpu = open_gpu(common)?;
    let illustration = Document::new().illustration().clone();
    let subject = subject_of(&illustration, common, Path::new("."), gpu.volume_limits())?;
    let rows = pollster::block_on(crate::render::bench(
        &gpu,
        &subject,
        &illustration.subject,
        BENCH_SIZE,
        BENCH_REPEATS,
        crate::render::system_clock,
    ))?;
    let dims = subject.values().map_or([0; 3], |v| v.grid.dims.to_array());
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
