//! What commands print and write.

use std::fmt;
use std::fs::File;
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};

use super::error::CliError;

pub(super) fn one_line(message: &dyn fmt::Display) -> String {
    let text = message.to_string();
    let lines: Vec<&str> = text
        .lines()
        .map(str::trim)
        .filter(|line| !line.is_empty())
        .collect();
    let text = lines.join("; ");
    // Text from a file or a link goes to a terminal: no control character in it may reach the terminal.
    text.chars()
        .map(|c| if c.is_control() { '\u{fffd}' } else { c })
        .collect()
}

/// What the reader of the arguments says about wrong ones, as one line: its first paragraph, and how the command is
/// used.
pub(super) fn misused(said: &str) -> String {
    let fault = said.split("\n\n").next().unwrap_or(said);
    let fault: Vec<&str> = fault.lines().map(str::trim).collect();
    let usage = said.lines().find_map(|line| line.strip_prefix("Usage: "));
    let usage = usage.map_or(String::new(), |usage| format!("; usage: {usage}"));
    one_line(&format!("{}{usage}", fault.join(" ")))
}

pub(super) fn notice(message: impl fmt::Display) {
    eprintln!("notice: {}", one_line(&message));
}

pub(super) fn print(text: &str) -> Result<(), CliError> {
    let mut out = io::stdout().lock();
    out.write_all(text.as_bytes())
        .and_then(|()| out.flush())
        .map_err(CliError::Output)
}

pub(super) fn shortened(text: &str) -> String {
    match text.char_indices().nth(60) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text.to_owned(),
    }
}

/// A file that is whole or not there: it is written beside its place and moved there at the end. Dropped before, it is
/// gone.
pub(super) struct WholeFile {
    path: PathBuf,
    part: PathBuf,
    file: File,
}

impl WholeFile {
    /// Begins the file of a path.
    pub(super) fn create(path: &Path) -> io::Result<Self> {
        let mut name = path.file_name().unwrap_or_default().to_os_string();
        name.push(format!(".{}.part", std::process::id()));
        let part = path.with_file_name(name);
        Ok(Self {
            path: path.to_path_buf(),
            file: File::create(&part)?,
            part,
        })
    }

    /// What is written into it.
    pub(super) fn writer(&self) -> io::Result<File> {
        self.file.try_clone()
    }

    /// Puts it in its place.
    pub(super) fn finish(self) -> io::Result<()> {
        self.file.sync_all()?;
        std::fs::rename(&self.part, &self.path)
    }
}

impl Drop for WholeFile {
    fn drop(&mut self) {
        // Gone already if it is in its place.
        let _gone = std::fs::remove_file(&self.part);
    }
}

/// The error of a file that could not be written.
pub(super) fn unwritten(path: &Path, source: io::Error) -> CliError {
    CliError::Write {
        path: path.display().to_string(),
        source,
    }
}

/// Writes a file that is whole or not there.
pub(super) fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), CliError> {
    let write = || -> io::Result<()> {
        let file = WholeFile::create(path)?;
        file.writer()?.write_all(bytes)?;
        file.finish()
    };
    write().map_err(|source| unwritten(path, source))
}
