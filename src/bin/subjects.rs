//! The part of the page that makes the built-in subjects, in a worker. It has no use outside a browser.

fn main() {
    #[cfg(target_arch = "wasm32")]
    fabrica::shell::worker::subjects::loaded();
}
