//! The clock that pictures are timed by.

/// Seconds since any fixed moment. Given by the shell, since a browser has its own clock.
pub type Clock = fn() -> f64;

/// A clock for programs with `std::time` (natively).
#[cfg(not(target_arch = "wasm32"))]
pub fn system_clock() -> f64 {
    use std::sync::OnceLock;
    static START: OnceLock<std::time::Instant> = OnceLock::new();
    START
        .get_or_init(std::time::Instant::now)
        .elapsed()
        .as_secs_f64()
}
