//! The part of the page that reads figures and bends them, in a worker. It has no use outside a browser.

fn main() {
    #[cfg(target_arch = "wasm32")]
    fabrica::shell::worker::figures::loaded();
}
