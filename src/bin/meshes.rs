//! The part of the page that reads meshes and prepares them, in a worker. It has no use outside a browser.

fn main() {
    #[cfg(target_arch = "wasm32")]
    fabrica::shell::worker::meshes::loaded();
}
