//! The real scans that some tests read. They lie outside the repository.

use std::io::Write as _;
use std::path::PathBuf;

/// The folder of scans that `FABRICA_TEST_DATA` names, or `None` (also where it says `none`). Then `test` does not run
/// and goes on the list that `cargo xtask test` prints in the end: the file that `FABRICA_NOT_RUN` names.
pub(crate) fn data_folder(test: &str) -> Option<PathBuf> {
    let named = std::env::var_os("FABRICA_TEST_DATA").filter(|folder| folder != "none");
    let folder = named.map(PathBuf::from).filter(|folder| folder.is_dir());
    if folder.is_none() {
        println!("{test}: NOT RUN, FABRICA_TEST_DATA names no folder of scans");
        if let Some(list) = std::env::var_os("FABRICA_NOT_RUN") {
            let file = std::fs::OpenOptions::new()
                .create(true)
                .append(true)
                .open(list);
            writeln!(file.expect("the list of tests that did not run"), "{test}").expect("a line");
        }
    }
    folder
}
