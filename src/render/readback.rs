use super::{Gpu, RenderError};
use std::future::Future;
use std::pin::Pin;
use std::sync::{Arc, Mutex, PoisonError};
use std::task::{Context, Poll, Waker};

/// A buffer on its way back from the GPU. Await it (natively that waits for the GPU, in a browser it yields), or ask
/// [`Readback::poll_now`] once per frame.
#[derive(Debug)]
pub struct Readback {
    gpu: Gpu,
    buffer: wgpu::Buffer,
    state: Arc<Mutex<State>>,
}

#[derive(Debug, Default)]
struct State {
    done: Option<Result<(), wgpu::BufferAsyncError>>,
    waker: Option<Waker>,
}

impl Readback {
    /// Starts reading a buffer with `MAP_READ` usage; the work that fills it must have been submitted.
    pub fn start(gpu: &Gpu, buffer: wgpu::Buffer) -> Self {
        let state = Arc::new(Mutex::new(State::default()));
        let on_done = Arc::clone(&state);
        buffer.map_async(wgpu::MapMode::Read, .., move |result| {
            let mut state = on_done.lock().unwrap_or_else(PoisonError::into_inner);
            state.done = Some(result);
            if let Some(waker) = state.waker.take() {
                waker.wake();
            }
        });
        Self {
            gpu: gpu.clone(),
            buffer,
            state,
        }
    }

    /// The bytes if they have arrived; does not wait. Hands them out once.
    pub fn poll_now(&mut self) -> Option<Result<Vec<u8>, RenderError>> {
        if let Err(why) = self.gpu.device.poll(wgpu::PollType::Poll) {
            return Some(Err(RenderError::Refused {
                pass: "readback",
                message: why.to_string(),
            }));
        }
        self.take()
    }

    fn take(&mut self) -> Option<Result<Vec<u8>, RenderError>> {
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        let result = state.done.take()?;
        Some(match result {
            Ok(()) => match self.buffer.get_mapped_range(..) {
                Ok(view) => Ok(view.to_vec()),
                Err(why) => Err(RenderError::Refused {
                    pass: "readback",
                    message: why.to_string(),
                }),
            },
            Err(why) => Err(match self.gpu.lost() {
                Some(lost) => RenderError::DeviceLost(lost),
                None => RenderError::Refused {
                    pass: "readback",
                    message: why.to_string(),
                },
            }),
        })
    }
}

impl Future for Readback {
    type Output = Result<Vec<u8>, RenderError>;

    fn poll(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<Self::Output> {
        // Natively nothing else turns the crank; in a browser the call does nothing and the callback wakes us.
        #[cfg(not(target_arch = "wasm32"))]
        if let Err(why) = self.gpu.device.poll(wgpu::PollType::wait_indefinitely()) {
            return Poll::Ready(Err(RenderError::Refused {
                pass: "readback",
                message: why.to_string(),
            }));
        }
        if let Some(result) = self.take() {
            return Poll::Ready(result);
        }
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        if state.done.is_some() {
            context.waker().wake_by_ref();
        } else {
            state.waker = Some(context.waker().clone());
        }
        Poll::Pending
    }
}
