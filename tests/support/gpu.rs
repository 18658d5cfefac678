//! One device for all tests of a process: opening one and compiling for it takes longer than most tests.

#![allow(dead_code, reason = "each test uses a part of it")]

use std::sync::OnceLock;

use fabrica::data::{Subject, Volume, VolumeBuilder};
use fabrica::render::{Gpu, GpuOptions, Studio};
use fabrica::subjects;

fn open(adapter: Option<&str>) -> Gpu {
    let options = GpuOptions {
        adapter: adapter.map(str::to_owned),
        is_strict: true,
    };
    pollster::block_on(Gpu::open(&options)).expect("an adapter (lavapipe is enough)")
}

/// The strongest adapter there is, as strict as a browser.
pub(crate) fn gpu() -> &'static Gpu {
    static GPU: OnceLock<Gpu> = OnceLock::new();
    GPU.get_or_init(|| open(None))
}

/// A software device of its own, for what is compared to the bit and for tests that lose their device.
pub(crate) fn open_software() -> Gpu {
    let gpu = open(Some("llvmpipe"));
    let name = &gpu.info.name;
    assert!(
        gpu.is_software(),
        "pictures are compared on the software rasteriser, this is {name}"
    );
    println!("{name} {}", gpu.info.driver_info);
    gpu
}

/// The software device that tests share.
pub(crate) fn software() -> &'static Gpu {
    static GPU: OnceLock<Gpu> = OnceLock::new();
    GPU.get_or_init(open_software)
}

/// A built-in subject, so many voxels along its longest side.
pub(crate) fn builtin(name: &str, resolution: u32) -> Volume {
    let mut builder = VolumeBuilder::new();
    subjects::generate(name, resolution, &mut builder).expect("a built-in subject");
    builder.finish().expect("a whole volume")
}

/// A device with a volume on it.
pub(crate) fn studio_of(gpu: &Gpu, volume: &Volume, wants_grid: bool) -> Studio {
    let subject = Subject::from(volume.clone());
    Studio::new(gpu, &subject, wants_grid).expect("the volume fits")
}
