//! Layer 4: everything GPU. Opens devices, assembles shader programs, uploads volumes and draws the picture.

mod baked;
#[cfg(any(test, target_arch = "wasm32"))]
mod bare;
mod bench;
mod bodies;
mod error;
mod feature;
mod field;
mod follow;
mod gpu;
pub mod gpu_types;
mod grid;
mod kernel;
mod look;
mod object;
mod pace;
mod passes;
mod picture;
mod probe;
pub mod programs;
mod readback;
#[cfg(all(debug_assertions, not(target_arch = "wasm32")))]
mod reload;
mod renderer;
mod rigid;
mod scene;
mod slice;
mod subject;
mod view;

pub use baked::BakedMap;
pub use bench::{BenchRow, bench};
pub use error::RenderError;
pub use feature::KeptTissue;
pub use follow::PendingPlaces;
pub use gpu::{Gpu, GpuOptions};
pub use grid::GridCells;
pub use kernel::{Binding, Kernel, result_buffer, storage_buffer, submit_and_read, uniform_buffer};
pub use look::{
    TABLE_SIZE, TransferTable, absolute_points, auto_preset, linear_color, linear_from_srgb,
    window_of,
};
pub use picture::{Image, PendingPick, Pick, Studio, encode_png, render_image};
pub use probe::{Probe, Sample};
pub use readback::{Readback, WorkDone};
#[cfg(all(debug_assertions, not(target_arch = "wasm32")))]
pub use reload::watch_shaders;
#[cfg(not(target_arch = "wasm32"))]
pub use renderer::system_clock;
pub use renderer::{Clock, DrawState, Renderer};
pub use slice::{PendingSlice, SliceColors, SlicePlane, SliceTexel, SliceView};
pub use subject::{BRICK, Bricks, SubjectInfo};
pub use view::View;
