//! The lines of a text header as names and values, whatever parts the two.

use std::collections::BTreeMap;

use super::LoadError;
use super::stream::Stream;

/// What stands in a text header.
pub(crate) struct Fields {
    /// The file's name, for messages.
    pub(crate) name: String,
    /// Field to (line number, value); names in lower case.
    pub(crate) fields: BTreeMap<String, (usize, String)>,
    /// Free pairs of key and value.
    pub(crate) pairs: BTreeMap<String, String>,
    /// Names of files, a line each, at the end.
    pub(crate) list: Vec<String>,
}

impl Fields {
    pub(crate) fn new(stream: &Stream<'_>) -> Self {
        Self {
            name: stream.name().to_owned(),
            fields: BTreeMap::new(),
            pairs: BTreeMap::new(),
            list: Vec::new(),
        }
    }

    pub(crate) fn get(&self, field: &str) -> Option<&str> {
        self.fields.get(field).map(|(_, value)| value.as_str())
    }

    /// That a field holds something else than expected.
    pub(crate) fn wrong(&self, field: &str, expected: &str) -> LoadError {
        let (line, found) = self.fields.get(field).cloned().unwrap_or_default();
        self.wrong_line(line, field, expected, found.chars().take(60).collect())
    }

    /// That a line is not what a header has.
    pub(crate) fn wrong_line(
        &self,
        line: usize,
        field: &str,
        expected: &str,
        found: String,
    ) -> LoadError {
        LoadError::HeaderLine {
            name: self.name.clone(),
            line,
            field: field.to_owned(),
            expected: expected.to_owned(),
            found,
        }
    }
}
