//! The lesson's viewer, for other people's pages. It has no use outside a browser.

fn main() {
    #[cfg(target_arch = "wasm32")]
    fabrica::shell::reader::loaded();
}
