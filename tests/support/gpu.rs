//! One device for all tests of a process: opening one and compiling for it takes longer than most tests.

#![allow(dead_code, reason = "each test uses a part of it")]

use std::sync::OnceLock;

use fabrica::data::{Grid, Subject, Volume, VolumeBuilder, Voxels};
use fabrica::render::{Gpu, GpuOptions, Studio};
use fabrica::subjects;
use glam::{DAffine3, DVec3, UVec3};

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

/// A cube of `n`³ voxels of one value, 1 unit wide.
pub(crate) fn uniform_volume(n: u32) -> Volume {
    Volume {
        has_size: true,
        grid: Grid {
            dims: UVec3::splat(n),
            world_from_voxel: DAffine3::from_scale(DVec3::splat(100.0 / f64::from(n))),
        },
        voxels: Voxels::U8(vec![7; (n * n * n) as usize]),
        slope: 1.0,
        intercept: 0.0,
        value_range: [7.0, 7.0],
        segmentation: None,
    }
}

/// A device with a volume on it.
pub(crate) fn studio_of(gpu: &Gpu, volume: &Volume, wants_grid: bool) -> Studio {
    let subject = Subject::from(volume.clone());
    Studio::new(gpu, &subject, wants_grid).expect("the volume fits")
}
