//! The library: examples that come with the program, and documents that were open here before.

use serde_json::Value;

use crate::app::words::search::has_words;
use crate::app::words::{kinds, names};
use crate::document::{Document, SubjectRef, TemplateKind};
use crate::link;

/// The key under which the documents are kept that were open before: the tail of a link in each line, newest first.
pub const STORED_RECENT: &str = "recent";
/// Documents that are kept at most.
const MOST_RECENT: usize = 12;

/// A file that ships with the program and is fetched when it is first needed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shipped {
    /// The list of examples: JSON, as `cargo xtask examples` writes it.
    Examples,
    /// The pictures of the examples: a PNG of equal tiles, in the order of the list.
    ExamplePictures,
}

impl Shipped {
    /// Where the file lies beside the page.
    pub fn path(self) -> &'static str {
        match self {
            Self::Examples => "examples/list.json",
            Self::ExamplePictures => "examples/pictures.png",
        }
    }
}

/// What becomes of the list of documents that were open before.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum RecentChange {
    /// Nothing: the list is wanted.
    List,
    /// A document goes to its head; what stands behind the `#` of its link.
    Add(String),
    /// A document is taken from it.
    Remove(String),
}

/// Which of its lists the library shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LibraryPage {
    /// The examples that come with the program.
    #[default]
    Examples,
    /// The documents that were open here before.
    Recent,
}

/// How far the list of examples has come.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Listing {
    /// Nobody has looked at the examples yet.
    #[default]
    NotAsked,
    /// The list is on its way.
    Asked,
    /// The examples are there.
    Here,
    /// The list could not be had; says why.
    Failed(String),
}

/// A finished illustration that comes with the program.
#[derive(Clone, Debug)]
pub struct Example {
    /// The whole illustration.
    pub document: Document,
    /// Kinds of its templates, each once, in the order of the catalogue.
    pub kinds: Vec<TemplateKind>,
}

impl Example {
    fn new(document: Document) -> Self {
        let templates = &document.illustration().templates;
        let mut kinds: Vec<TemplateKind> = templates.iter().map(|t| t.kind).collect();
        kinds.sort();
        kinds.dedup();
        Self { document, kinds }
    }

    /// Name of its built-in subject; empty for another one.
    pub fn subject(&self) -> &str {
        match &self.document.illustration().subject {
            SubjectRef::Builtin { name, .. } => name,
            SubjectRef::Address { .. }
            | SubjectRef::Supplied { .. }
            | SubjectRef::Meshes { .. }
            | SubjectRef::Clay(_) => "",
        }
    }

    /// True if every word of a search is in its texts, or in the names of its subject and its templates.
    fn is_found(&self, wanted: &str) -> bool {
        let shown = self.document.illustration();
        let mut text = format!("{} {} ", shown.title, shown.legend);
        text.push_str(&names::subject_title(shown));
        for kind in &self.kinds {
            text.push(' ');
            text.push_str(kinds::title(*kind));
        }
        for step in &shown.steps {
            text.push(' ');
            text.push_str(&step.title);
        }
        has_words(&text, wanted)
    }
}

/// A document that was open before.
#[derive(Clone, Debug)]
pub struct Recent {
    /// What stands behind the `#` of its link.
    pub tail: String,
    /// The whole illustration.
    pub document: Document,
    /// The step at which it was left.
    pub step: usize,
    /// A small picture of it, a PNG, if one is kept.
    pub png: Option<Vec<u8>>,
}

impl Recent {
    /// Title, or where it has none its subject.
    pub fn name(&self) -> String {
        let shown = self.document.illustration();
        match shown.title.trim() {
            "" => names::subject_title(shown),
            title => title.to_owned(),
        }
    }
}

/// The state of the library.
#[derive(Debug, Default)]
pub struct Library {
    /// The library lies over the window.
    pub is_open: bool,
    /// The page that is shown.
    pub page: LibraryPage,
    /// How far the list of examples has come.
    pub listing: Listing,
    /// The examples, in the order of their pictures.
    pub examples: Vec<Example>,
    /// Width and height of an example's picture, pixels.
    pub tile_px: [u32; 2],
    /// The text that examples are searched for.
    pub search: String,
    /// Only examples of this built-in subject.
    pub subject: Option<String>,
    /// Only examples with a template of this kind.
    pub kind: Option<TemplateKind>,
    /// Documents that were open before, newest first.
    pub recent: Vec<Recent>,
    /// The open document came from the library and is not the user's own.
    pub(super) is_example_open: bool,
}

/// What is done in the library.
#[derive(Clone, Debug)]
pub enum LibraryCommand {
    /// Opens the library, or closes it.
    Toggle,
    /// Shows a page of it.
    Show(LibraryPage),
    /// Asks for the examples again.
    Ask,
    /// Searches the examples for a text.
    Search(String),
    /// Shows the examples of one subject only, or all.
    OfSubject(Option<String>),
    /// Shows the examples with one kind of template only, or all.
    OfKind(Option<TemplateKind>),
    /// Opens the example of this index as a link to it would.
    Open(usize),
    /// Opens a copy of the example of this index, to be edited.
    MakeMine(usize),
    /// Opens the document of this index that was open before.
    OpenRecent(usize),
    /// Takes the document of this index from the list of those that were open before.
    Forget(usize),
}

impl Library {
    /// Indices of the examples that search and filters leave.
    pub fn found(&self) -> Vec<usize> {
        let is_found = |example: &Example| {
            let is_subject = |name: &String| example.subject() == name.as_str();
            self.subject.as_ref().is_none_or(is_subject)
                && self.kind.is_none_or(|kind| example.kinds.contains(&kind))
                && example.is_found(&self.search)
        };
        let all = self.examples.iter().enumerate();
        all.filter(|(_, example)| is_found(example))
            .map(|(index, _)| index)
            .collect()
    }

    /// Takes the list of examples, as `cargo xtask examples` writes it.
    pub fn take_list(&mut self, outcome: Result<&[u8], String>) {
        let list = outcome.and_then(|bytes| listed(bytes).ok_or_else(String::new));
        self.listing = match list {
            Ok((tile_px, examples)) => {
                self.tile_px = tile_px;
                self.examples = examples;
                Listing::Here
            }
            Err(why) => Listing::Failed(why),
        };
    }

    /// Takes the list of documents that were open before, as it is kept, and gives each the picture that there is for
    /// its link. What cannot be read is left out.
    pub fn take_recent(&mut self, kept: &str, picture_of: impl Fn(&str) -> Option<Vec<u8>>) {
        let read = |tail: &str| {
            let link = link::decode(tail).ok()?;
            Some(Recent {
                tail: tail.to_owned(),
                document: link.document,
                step: link.step,
                png: picture_of(tail),
            })
        };
        self.recent = kept.lines().filter_map(read).collect();
    }
}

/// The size of the pictures and the examples of a list; nothing if it is broken.
fn listed(bytes: &[u8]) -> Option<([u32; 2], Vec<Example>)> {
    let mut list: Value = serde_json::from_slice(bytes).ok()?;
    let side = |i: usize| u32::try_from(list["tile"][i].as_u64()?).ok();
    let tile_px = [side(0)?, side(1)?];
    let entries = list["examples"].as_array_mut()?;
    let document = |entry: &mut Value| Document::from_value(entry["document"].take()).ok();
    let documents: Option<Vec<Document>> = entries.iter_mut().map(document).collect();
    Some((tile_px, documents?.into_iter().map(Example::new).collect()))
}

/// The list of documents that were open before, after a change.
pub fn changed_recent(kept: &str, change: &RecentChange) -> String {
    let payload = |tail: &str| tail.split('&').next().unwrap_or_default().to_owned();
    let (first, gone) = match change {
        RecentChange::List => return kept.to_owned(),
        RecentChange::Add(tail) => (Some(tail.as_str()), payload(tail)),
        RecentChange::Remove(tail) => (None, payload(tail)),
    };
    let others = kept.lines().filter(|tail| payload(tail) != gone);
    let tails = first.into_iter().chain(others).take(MOST_RECENT);
    tails.collect::<Vec<&str>>().join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn recent_documents_are_each_listed_once() {
        let add =
            |kept: &str, tail: &str| changed_recent(kept, &RecentChange::Add(tail.to_owned()));
        let mut kept = String::new();
        for tail in ["Aa", "Ab", "Aa&step=2", "Ac"] {
            kept = add(&kept, tail);
        }
        assert_eq!(kept, "Ac\nAa&step=2\nAb", "newest first, without steps");
        assert_eq!(changed_recent(&kept, &RecentChange::List), kept);
        let removed = changed_recent(&kept, &RecentChange::Remove("Aa".to_owned()));
        assert_eq!(removed, "Ac\nAb");
        for i in 0..20 {
            kept = add(&kept, &format!("B{i}"));
        }
        assert_eq!(kept.lines().count(), MOST_RECENT);
        assert!(kept.starts_with("B19\n"), "{kept}");
    }

    #[test]
    fn what_cannot_be_read_is_left_out() {
        let mut library = Library::default();
        let good = link::encode(&Document::new());
        library.take_recent(&format!("nonsense\n\n{good}&step=0\n{good}"), |_| None);
        assert_eq!(library.recent.len(), 2, "{:?}", library.recent);
        for broken in ["", "{}", r#"{"tile":[1,1],"examples":[{}]}"#] {
            library.take_list(Ok(broken.as_bytes()));
            assert!(matches!(library.listing, Listing::Failed(_)), "{broken}");
        }
        let one =
            r#"{"tile":[4,3],"examples":[{"name":"a","document":{"fabrica":1,"title":"A"}}]}"#;
        library.take_list(Ok(one.as_bytes()));
        assert_eq!(library.listing, Listing::Here);
        assert_eq!(library.found(), [0]);
        library.search = "no such".to_owned();
        assert!(library.found().is_empty());
    }
}
