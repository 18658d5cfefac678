//! The part of the page that reads scans and holds their decoders, in a worker. It has no use outside a browser.

fn main() {
    #[cfg(target_arch = "wasm32")]
    fabrica::shell::worker::scans::loaded();
}
