//! The program: a window and a command line natively, a page on the web. It only picks a shell.

#[cfg(not(target_arch = "wasm32"))]
fn main() -> std::process::ExitCode {
    match fabrica::shell::native::view(fabrica::shell::native::Opening::default()) {
        Ok(()) => std::process::ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            std::process::ExitCode::FAILURE
        }
    }
}

#[cfg(target_arch = "wasm32")]
fn main() {
    fabrica::shell::web::loaded();
}
