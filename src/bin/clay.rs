//! The part of the page that shapes clays, in a worker. It has no use outside a browser.

fn main() {
    #[cfg(target_arch = "wasm32")]
    fabrica::shell::worker::clay::loaded();
}
