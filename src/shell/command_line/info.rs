//! `fabrica info`: what a data file or a document holds.

use std::path::Path;

use super::about::about;
use super::args::Common;
use super::error::CliError;
use super::figures::describe_figure;
use super::opening::{is_document, open};
use super::output::{notice, print};
use super::reading::hint;

/// Describes a data file, or a document in whatever form. A path that is not there may be a link.
pub(super) fn info(common: &Common, what: &str) -> Result<(), CliError> {
    let file = Path::new(what);
    if !file.exists() || is_document(file) {
        return about(common, &open(what)?);
    }
    if let Some(description) = describe_figure(file)? {
        return print(&description);
    }
    if let Some(description) = common.reading.describe_mesh(file)? {
        for aside in &description.report.aside {
            notice(aside);
        }
        return print(&description.to_string());
    }
    let description = common.reading.describe(file).map_err(|error| {
        let name = file.to_string_lossy();
        if let Some(hint) = hint(&name, &error) {
            notice(hint);
        }
        CliError::Load(error, name.into_owned())
    })?;
    for line in description.report.notices() {
        notice(line);
    }
    print(&format!("{}\n", description.to_string().trim_end()))
}
