use super::error::RenderError;
use crate::data::VolumeLimits;
use std::any::Any;
use std::sync::{Arc, Mutex, PoisonError};
use std::task::{Poll, Waker};

/// How a device is chosen.
#[derive(Clone, Debug, Default)]
pub struct GpuOptions {
    /// Part of the adapter's name, any case; `None` takes the strongest, a software one if there is no other.
    pub adapter: Option<String>,
    /// Refuse what a browser would refuse. Tests use this, so that lavapipe stands for the web.
    pub is_strict: bool,
}

/// A device with its queue and what is known about it. Cheap to clone; built once per program (and again after a loss).
#[derive(Clone, Debug)]
pub struct Gpu {
    /// Makes buffers, textures and pipelines.
    pub device: wgpu::Device,
    /// Takes commands and copies data to the GPU.
    pub queue: wgpu::Queue,
    /// Name, kind and driver.
    pub info: wgpu::AdapterInfo,
    health: Arc<Mutex<Health>>,
    shared: Arc<Mutex<Option<Box<Shared>>>>,
    /// Natively, whether futures wait for the GPU (a headless program) or are polled by a frame loop (a window).
    waits: bool,
    /// Samples of a finished picture, where somebody has chosen them.
    samples: Option<u32>,
}

#[derive(Debug, Default)]
struct Health {
    lost: Option<String>,
    /// Who waits for the loss of the device.
    waiting: Option<Waker>,
    errors: Vec<String>,
}

/// Something made on a device.
#[cfg(not(target_arch = "wasm32"))]
type Shared = dyn Any + Send + Sync;

/// Something made on a device, which no other thread of a page can have.
#[cfg(target_arch = "wasm32")]
type Shared = dyn Any;

/// Two bytes each on the GPU and as much in the heap: 2 GiB each natively.
const MAX_VOXELS_NATIVE: u64 = 1 << 30;
/// A page has 4 GiB of heap at most, and phones have little to give: 400 MB each.
const MAX_VOXELS_WEB: u64 = 200 << 20;

/// More samples than this are not seen.
const MAX_SAMPLES: u32 = 64;

/// Errors kept until somebody asks; later ones are dropped, the first one is the cause.
const MAX_KEPT_ERRORS: usize = 8;

impl Gpu {
    /// Opens a device without a window. Software adapters are taken where there is no other ([`Gpu::is_software`]
    /// tells).
    ///
    /// # Errors
    /// [`RenderError::NoAdapter`], [`RenderError::NoSuchAdapter`], [`RenderError::NoDevice`].
    pub async fn open(options: &GpuOptions) -> Result<Self, RenderError> {
        let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
        descriptor.backends = wgpu::Backends::from_env().unwrap_or(wgpu::Backends::PRIMARY);
        // Debug information of shaders has a line for each instruction, which is counted from the beginning of the
        // text: debug builds took many times as long to make a program. No tool here reads it.
        descriptor.flags.remove(wgpu::InstanceFlags::DEBUG);
        if options.is_strict {
            descriptor.flags |= wgpu::InstanceFlags::STRICT_WEBGPU_COMPLIANCE;
        }
        let instance = wgpu::Instance::new(descriptor);
        let adapter = match &options.adapter {
            None => instance
                .request_adapter(&wgpu::RequestAdapterOptions {
                    power_preference: wgpu::PowerPreference::HighPerformance,
                    ..Default::default()
                })
                .await
                .map_err(|why| RenderError::NoAdapter(why.to_string()))?,
            Some(wanted) => {
                let all = instance.enumerate_adapters(wgpu::Backends::all()).await;
                let lower = wanted.to_lowercase();
                let names: Vec<String> = all.iter().map(|a| a.get_info().name).collect();
                let found = names.iter().position(|n| n.to_lowercase().contains(&lower));
                match found.and_then(|i| all.into_iter().nth(i)) {
                    Some(adapter) => adapter,
                    None => {
                        return Err(RenderError::NoSuchAdapter {
                            wanted: wanted.clone(),
                            found: names.join(", "),
                        });
                    }
                }
            }
        };
        let (device, queue) = adapter
            .request_device(&Self::device_descriptor(&adapter))
            .await
            .map_err(|source| RenderError::NoDevice {
                adapter: adapter.get_info().name,
                source,
            })?;
        Ok(Self {
            waits: true,
            ..Self::from_parts(device, queue, adapter.get_info())
        })
    }

    /// The device to ask an adapter for: WebGPU's default limits, and of the adapter's own only the sizes of textures
    /// and buffers. No optional features, so that the page and the native program draw with the same means.
    pub fn device_descriptor(adapter: &wgpu::Adapter) -> wgpu::DeviceDescriptor<'static> {
        let has = adapter.limits();
        let base = wgpu::Limits::defaults();
        wgpu::DeviceDescriptor {
            label: Some("fabrica"),
            required_limits: wgpu::Limits {
                max_texture_dimension_2d: has
                    .max_texture_dimension_2d
                    .max(base.max_texture_dimension_2d),
                max_texture_dimension_3d: has
                    .max_texture_dimension_3d
                    .max(base.max_texture_dimension_3d),
                max_buffer_size: has.max_buffer_size.max(base.max_buffer_size),
                ..base
            },
            ..Default::default()
        }
    }

    /// Takes a device that somebody else made (eframe's render state, the page). Errors and the loss of the device are
    /// from now on kept here instead of ending the program.
    pub fn from_parts(device: wgpu::Device, queue: wgpu::Queue, info: wgpu::AdapterInfo) -> Self {
        let health = Arc::new(Mutex::new(Health::default()));
        let on_error = Arc::clone(&health);
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
            let mut health = on_error.lock().unwrap_or_else(PoisonError::into_inner);
            if health.errors.len() < MAX_KEPT_ERRORS {
                health.errors.push(error.to_string());
            }
        }));
        let on_loss = Arc::clone(&health);
        device.set_device_lost_callback(move |reason, message| {
            let mut health = on_loss.lock().unwrap_or_else(PoisonError::into_inner);
            health.lost = Some(format!("{reason:?} {message}"));
            if let Some(waiting) = health.waiting.take() {
                waiting.wake();
            }
        });
        Self {
            device,
            queue,
            info,
            health,
            shared: Arc::default(),
            waits: false,
            samples: None,
        }
    }

    /// The same device, on which viewers draw finished pictures with so many samples a pixel, 1 to 64. With `None` they
    /// choose by what the device can do.
    #[must_use]
    pub fn with_samples(mut self, samples: Option<u32>) -> Self {
        self.samples = samples.map(|number| number.clamp(1, MAX_SAMPLES));
        self
    }

    /// What [`Self::with_samples`] has chosen.
    pub(crate) const fn samples(&self) -> Option<u32> {
        self.samples
    }

    /// What all that draw on this device share: made for the first who asks. A device shares values of one type, which
    /// may not hold the device's `Gpu`.
    pub(crate) fn shared<T: Clone + wgpu::WasmNotSendSync + 'static>(
        &self,
        make: impl FnOnce() -> T,
    ) -> T {
        let mut shared = self.shared.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(made) = shared.as_ref().and_then(|any| any.downcast_ref::<T>()) {
            return made.clone();
        }
        let made = make();
        *shared = Some(Box::new(made.clone()));
        made
    }

    /// The next who asks for what is shared gets it made anew.
    #[cfg(all(debug_assertions, not(target_arch = "wasm32")))]
    pub(crate) fn forget_shared(&self) {
        *self.shared.lock().unwrap_or_else(PoisonError::into_inner) = None;
    }

    /// Waits until the device is lost, also by being destroyed. Only the last one who waits is told.
    pub fn until_lost(&self) -> impl Future<Output = ()> + use<> {
        let health = Arc::clone(&self.health);
        std::future::poll_fn(move |context| {
            let mut health = health.lock().unwrap_or_else(PoisonError::into_inner);
            if health.lost.is_some() {
                return Poll::Ready(());
            }
            health.waiting = Some(context.waker().clone());
            Poll::Pending
        })
    }

    /// True if futures of this device may block the thread while the GPU works.
    pub(crate) fn waits(&self) -> bool {
        self.waits
    }

    /// The largest volume to keep here; larger ones are made coarser on their way in.
    pub fn volume_limits(&self) -> VolumeLimits {
        VolumeLimits {
            max_dim: self.device.limits().max_texture_dimension_3d,
            max_voxels: if cfg!(target_arch = "wasm32") {
                MAX_VOXELS_WEB
            } else {
                MAX_VOXELS_NATIVE
            },
        }
    }

    /// True if the adapter is a CPU (lavapipe, SwiftShader, WARP).
    pub fn is_software(&self) -> bool {
        self.info.device_type == wgpu::DeviceType::Cpu
    }

    /// Why the device was lost, if it was. Everything on it must be made anew on another device.
    pub fn lost(&self) -> Option<String> {
        self.health
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .lost
            .clone()
    }

    /// Errors that no call returned, oldest first; they are handed out once.
    pub fn take_errors(&self) -> Vec<String> {
        std::mem::take(
            &mut self
                .health
                .lock()
                .unwrap_or_else(PoisonError::into_inner)
                .errors,
        )
    }

    /// Fails if the device is lost.
    ///
    /// # Errors
    /// [`RenderError::DeviceLost`].
    pub fn check(&self) -> Result<(), RenderError> {
        match self.lost() {
            Some(why) => Err(RenderError::DeviceLost(why)),
            None => Ok(()),
        }
    }
}
