//! The part of the page that holds the decoders of pictures, in a worker. It has no use outside a browser.

#[cfg(target_arch = "wasm32")]
use fabrica as _;

fn main() {}
