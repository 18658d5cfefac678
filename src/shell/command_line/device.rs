use super::args::Common;
use super::error::CliError;
use super::output::notice;
use crate::render::{Gpu, GpuOptions};

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
