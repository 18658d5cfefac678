//! `fabrica info`: what a data file holds.

use std::path::Path;

use super::args::Common;
use super::error::CliError;
use super::figures::describe_figure;
use super::output::{notice, print};
use super::reading::hint;

pub(super) fn info(common: &Common, file: &Path) -> Result<(), CliError> {
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
