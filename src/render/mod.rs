//! Layer 4: everything GPU. Opens devices, assembles shader programs, uploads subjects and draws the picture.
//!
//! The inner rooms, bottom to top; a file imports from its own room and from those above it in this list:
//!
//! | room | holds |
//! |---|---|
//! | `device` | the device, its programs, bindings and readback |
//! | `pack` | from a document to what the shaders read |
//! | `subject` | what is illustrated, on the GPU: one file for each kind |
//! | `stage` | what is made on the GPU before a picture can be drawn |
//! | `scene` | everything that is ready to be drawn |
//! | `draw` | pictures, slices, picks and probes |

mod device;
mod draw;
mod pack;
mod scene;
mod stage;
mod subject;

pub use device::buffers::{result_buffer, storage_buffer, submit_and_read, uniform_buffer};
pub use device::cases::Cases;
pub use device::error::RenderError;
pub use device::gpu::{Gpu, GpuOptions};
pub use device::kernel::{Binding, Kernel};
pub use device::programs;
pub use device::readback::{Readback, WorkDone};
#[cfg(all(debug_assertions, not(target_arch = "wasm32")))]
pub use device::reload::watch_shaders;
pub use draw::bench::{BenchMeshes, BenchPlan, BenchReport, BenchRow, bench};
pub use draw::captions::{CaptionPlace, FollowedCaptions, caption_places};
pub use draw::clock::Clock;
#[cfg(not(target_arch = "wasm32"))]
pub use draw::clock::system_clock;
pub use draw::follow::PendingPlaces;
pub use draw::identify::{SIGHT_PX, Sighting};
pub use draw::image::{Image, decode_png, encode_png};
pub use draw::pick::{Meeting, PendingDepths, PendingEvents, PendingPick, Pick, RayEvent};
pub use draw::probe::{Probe, Sample};
pub use draw::renderer::{DrawState, Renderer};
pub use draw::rows::{FileInMemory, MOST_PX, PictureSpec, PngRows, Rows, Taker, shrunk};
pub use draw::slice::{MarkedValues, PendingSlice, SliceColors, SlicePlane, SliceTexel, SliceView};
pub use draw::studio::{Studio, render_image};
pub use pack::filling::{Filling, Fillings};
pub use pack::gpu_types;
pub use pack::kept::KeptTissue;
pub use pack::look::{
    TABLE_SIZE, TransferTable, absolute_points, auto_preset, linear_color, window_of,
};
pub use pack::marks::{Marks, ScaleBar};
pub use pack::mesh_look::lidded;
pub use pack::notice::{RenderNotice, missed_notices};
pub use pack::values::SubjectInfo;
pub use pack::view::View;
pub use stage::baked::BakedMap;
pub use stage::skip_grid::GridCells;
pub use subject::bricks::{BRICK, Bricks};
