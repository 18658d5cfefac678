//! Layer 6: windows, files, the command line and the page. The only room that knows where it runs.

#[cfg(target_arch = "wasm32")]
mod page;
#[cfg(target_arch = "wasm32")]
pub mod web;
#[cfg(target_arch = "wasm32")]
pub mod worker;

mod loading;

#[cfg(not(target_arch = "wasm32"))]
pub mod native;

#[cfg(not(target_arch = "wasm32"))]
pub mod cli;
#[cfg(not(target_arch = "wasm32"))]
mod fields;
#[cfg(not(target_arch = "wasm32"))]
pub mod files;
#[cfg(not(target_arch = "wasm32"))]
mod probing;
#[cfg(not(target_arch = "wasm32"))]
pub mod reading;
#[cfg(not(target_arch = "wasm32"))]
mod segments;
#[cfg(not(target_arch = "wasm32"))]
pub mod subject;

/// What is said where a document asks for a file of the reader's own. `name` is what the author called it.
fn wanted_file(name: &str) -> String {
    let called = if name.is_empty() {
        String::new()
    } else {
        format!(" (“{}”)", name.chars().take(80).collect::<String>())
    };
    format!(
        "This illustration was made with a scan that is not part of it{called}: open the file, or drop it here"
    )
}
