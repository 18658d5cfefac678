//! Work that goes on beside the frames, asked once per frame whether it is done.

use std::future::Future;
use std::pin::Pin;
use std::task::{Context, Poll, Waker};

/// Work that is asked once per frame whether it is done.
pub type Pending<T> = Pin<Box<dyn Future<Output = T>>>;

/// Asks whether it is ready; never waits.
pub fn poll_once<T>(pending: &mut Pending<T>) -> Option<T> {
    match pending
        .as_mut()
        .poll(&mut Context::from_waker(Waker::noop()))
    {
        Poll::Ready(value) => Some(value),
        Poll::Pending => None,
    }
}
