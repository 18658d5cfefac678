//! What is done in the library: examples and recent documents are opened, and what makes room for them is kept.

use super::effect::{Effect, LinkChange};
use super::library::{LibraryCommand, LibraryPage, Listing, RecentChange, Shipped};
use super::selection::Selection;
use super::session::{Session, Tab, payload_of};
use crate::app::words::{self, fill};
use crate::document::{Document, Edit};
use crate::link;

/// A longer link is not kept, characters: browsers give a page a few million for everything.
const LONGEST: usize = 60_000;

impl Session {
    pub(super) fn run_library(&mut self, command: LibraryCommand) {
        match command {
            LibraryCommand::Toggle => {
                self.library.is_open = !self.library.is_open;
                if self.library.is_open {
                    self.library.page = LibraryPage::Examples;
                    self.ask_for_examples();
                    self.effect(Effect::Recent(RecentChange::List));
                }
            }
            LibraryCommand::Show(page) => self.library.page = page,
            LibraryCommand::Ask => self.ask_for_examples(),
            LibraryCommand::Search(text) => self.library.search = text,
            LibraryCommand::OfSubject(subject) => self.library.subject = subject,
            LibraryCommand::OfKind(kind) => self.library.kind = kind,
            LibraryCommand::Open(index) => {
                if let Some(example) = self.library.examples.get(index) {
                    let document = example.document.clone();
                    self.open_from_library(document, 0);
                    self.library.is_example_open = true;
                }
            }
            LibraryCommand::MakeMine(index) => {
                if let Some(example) = self.library.examples.get(index) {
                    let document = copy_of(&example.document);
                    self.open_from_library(document, 0);
                    self.are_panels_hidden = false;
                    self.side_tab = Tab::Templates;
                    let templates = &self.illustration().templates;
                    let first = templates.first().map(|template| template.index);
                    self.selection = Selection::of_template(first);
                }
            }
            LibraryCommand::OpenRecent(index) => {
                if let Some(recent) = self.library.recent.get(index).cloned() {
                    self.open_from_library(recent.document, recent.step);
                    self.effect(Effect::Recent(RecentChange::Remove(recent.tail)));
                }
            }
            LibraryCommand::Forget(index) => {
                if let Some(recent) = self.library.recent.get(index) {
                    let change = RecentChange::Remove(recent.tail.clone());
                    self.effect(Effect::Recent(change));
                }
            }
        }
    }

    /// Asks for the list of examples and for their pictures, unless they are there or on their way.
    fn ask_for_examples(&mut self) {
        let listing = &mut self.library.listing;
        if matches!(listing, Listing::NotAsked | Listing::Failed(_)) {
            *listing = Listing::Asked;
            self.effect(Effect::FetchShipped(Shipped::Examples));
            self.effect(Effect::FetchShipped(Shipped::ExamplePictures));
        }
    }

    fn open_from_library(&mut self, document: Document, step: usize) {
        // What was only looked at is kept too, as the command replaces it without a way back.
        if !self.library.is_example_open {
            self.keep_left();
        }
        self.library.is_open = false;
        self.open_document(document, step);
        self.touch_link(LinkChange::Push);
    }

    /// Keeps the document that is about to be replaced among the recent ones if it was worked on here.
    pub(super) fn keep_work(&mut self) {
        let is_work = self.history.undo_name().is_some() || self.is_restored;
        if is_work {
            self.keep_left();
        }
        self.library.is_example_open = false;
    }

    /// Keeps the document that is about to be replaced among the recent ones, unless there is nothing in it.
    fn keep_left(&mut self) {
        if self.document().is_blank() {
            return;
        }
        let camera = match self.step() {
            0 => self.camera,
            _ => self.illustration().camera,
        };
        self.keep_recent(payload_of(self.document(), &camera));
    }

    /// Keeps the document of an earlier visit among the recent ones, now that another one was opened.
    pub fn keep_earlier(&mut self, tail: String) {
        let document = link::decode(&tail).map(|link| link.document);
        let is_other =
            |document: Document| document != self.document_as_seen() && !document.is_blank();
        if document.is_ok_and(is_other) {
            self.keep_recent(tail);
        }
    }

    fn keep_recent(&mut self, tail: String) {
        if tail.len() <= LONGEST {
            self.effect(Effect::Recent(RecentChange::Add(tail)));
        }
    }
}

/// A document under a title of its own.
fn copy_of(document: &Document) -> Document {
    let title = &document.illustration().title;
    let title = fill(words::library::w().copy_of, &[title]);
    let edit = Edit::SetTitle(title);
    edit.apply(document).unwrap_or_else(|_| document.clone())
}
