//! The program: a window and a command line natively, a page on the web. It only picks a shell.

#[cfg(not(target_arch = "wasm32"))]
fn main() -> std::process::ExitCode {
    fabrica::shell::command_line::run()
}

#[cfg(target_arch = "wasm32")]
fn main() {
    fabrica::shell::web::loaded();
}
