use super::error::RenderError;
use super::gpu::Gpu;
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

impl Drop for Readback {
    fn drop(&mut self) {
        self.buffer.destroy();
    }
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
        if let Err(error) = turn(&self.gpu) {
            return Poll::Ready(Err(error));
        }
        if let Some(result) = self.take() {
            return Poll::Ready(result);
        }
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        if state.done.is_some() || must_be_polled(&self.gpu) {
            context.waker().wake_by_ref();
        } else {
            state.waker = Some(context.waker().clone());
        }
        Poll::Pending
    }
}

/// What makes an answer of bytes.
type Reading<T> = dyn Fn(&[u8]) -> T + Send + Sync;

/// What bytes mean that are on their way back from the GPU. Await it, or ask once per frame.
pub struct Answer<T>(AnswerState<T>);

enum AnswerState<T> {
    /// On its way.
    Asked(Box<Readback>, Box<Reading<T>>),
    /// Nobody had to be asked; `None` once it was handed out.
    Known(Option<T>),
}

impl<T> Answer<T> {
    /// The answer that `read` makes of the bytes.
    pub(crate) fn new(
        reading: Readback,
        read: impl Fn(&[u8]) -> T + Send + Sync + 'static,
    ) -> Self {
        Self(AnswerState::Asked(Box::new(reading), Box::new(read)))
    }

    /// An answer for which the GPU is not asked.
    pub(crate) fn known(answer: T) -> Self {
        Self(AnswerState::Known(Some(answer)))
    }

    /// The answer if it has come; does not wait. Hands it out once.
    pub fn poll_now(&mut self) -> Option<Result<T, RenderError>> {
        match &mut self.0 {
            AnswerState::Asked(reading, read) => {
                let bytes = reading.poll_now()?;
                Some(bytes.map(|bytes| read(&bytes)))
            }
            AnswerState::Known(answer) => answer.take().map(Ok),
        }
    }
}

impl<T: Unpin> Future for Answer<T> {
    type Output = Result<T, RenderError>;

    fn poll(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<Self::Output> {
        match &mut self.0 {
            AnswerState::Asked(reading, read) => {
                let bytes = Pin::new(&mut **reading).poll(context);
                bytes.map(|bytes| bytes.map(|bytes| read(&bytes)))
            }
            AnswerState::Known(answer) => match answer.take() {
                Some(answer) => Poll::Ready(Ok(answer)),
                // A future that has given its answer is not polled again.
                None => Poll::Pending,
            },
        }
    }
}

impl<T> std::fmt::Debug for Answer<T> {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let mut shown = formatter.debug_tuple("Answer");
        if let AnswerState::Asked(reading, _) = &self.0 {
            shown.field(reading);
        }
        shown.finish()
    }
}

/// Natively: waits for the GPU if this device may, else lets finished work report itself. In a browser the callbacks
/// come by themselves.
fn turn(gpu: &Gpu) -> Result<(), RenderError> {
    let how = if gpu.waits() {
        wgpu::PollType::wait_indefinitely()
    } else {
        wgpu::PollType::Poll
    };
    match gpu.device.poll(how) {
        Ok(_) => Ok(()),
        Err(why) => Err(RenderError::Refused {
            pass: "readback",
            message: why.to_string(),
        }),
    }
}

/// Callbacks come by themselves, without anybody who polls.
const TELLS_BY_ITSELF: bool = cfg!(target_arch = "wasm32");

/// True where no callback comes unless somebody polls.
fn must_be_polled(gpu: &Gpu) -> bool {
    !TELLS_BY_ITSELF && !gpu.waits()
}

/// Resolves when everything submitted so far is done.
#[derive(Debug)]
pub struct WorkDone {
    gpu: Gpu,
    state: Arc<Mutex<WorkState>>,
}

#[derive(Debug, Default)]
struct WorkState {
    is_done: bool,
    /// Seconds on the clock of whoever watches, where the device tells by itself.
    done_at: Option<f64>,
    waker: Option<Waker>,
}

impl WorkDone {
    /// Starts to watch the work that was submitted before this call.
    pub fn start(gpu: &Gpu) -> Self {
        Self::timed(gpu, None)
    }

    /// The same, and notes when it is done, see [`WorkDone::done_at`].
    pub fn timed(gpu: &Gpu, clock: Option<fn() -> f64>) -> Self {
        let state = Arc::new(Mutex::new(WorkState::default()));
        let on_done = Arc::clone(&state);
        gpu.queue.on_submitted_work_done(move || {
            let mut state = on_done.lock().unwrap_or_else(PoisonError::into_inner);
            state.is_done = true;
            state.done_at = clock.filter(|_| TELLS_BY_ITSELF).map(|clock| clock());
            if let Some(waker) = state.waker.take() {
                waker.wake();
            }
        });
        Self {
            gpu: gpu.clone(),
            state,
        }
    }

    /// True if it is done; does not wait, and does not turn the crank (poll the device once per frame).
    pub fn is_done(&self) -> bool {
        self.state
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .is_done
    }

    /// When it was done, by the clock given at its start; only a browser's device tells that before it is polled.
    pub fn done_at(&self) -> Option<f64> {
        let state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        state.done_at
    }

    /// Wakes once it is done. False where it is done already, or where somebody has to poll the device for that.
    pub fn wake_when_done(&self, waker: &Waker) -> bool {
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        let will_wake = TELLS_BY_ITSELF && !state.is_done;
        if will_wake {
            state.waker = Some(waker.clone());
        }
        will_wake
    }
}

impl Future for WorkDone {
    type Output = Result<(), RenderError>;

    fn poll(self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<Self::Output> {
        if let Err(error) = turn(&self.gpu) {
            return Poll::Ready(Err(error));
        }
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        if state.is_done {
            return Poll::Ready(Ok(()));
        }
        if must_be_polled(&self.gpu) {
            context.waker().wake_by_ref();
        } else {
            state.waker = Some(context.waker().clone());
        }
        Poll::Pending
    }
}
