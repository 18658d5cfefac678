//! Which tests have time for all that they can ask.

#![allow(dead_code, reason = "each test binary uses a part of it")]

/// True where there is time for all that a test can ask: `FABRICA_LONG` in the environment.
pub(crate) fn is_long() -> bool {
    std::env::var_os("FABRICA_LONG").is_some()
}

/// The first of two sizes of a test where there is time for it, else the second.
pub(crate) fn long_or<T>(long: T, short: T) -> T {
    if is_long() { long } else { short }
}
