//! What the session wants done outside of itself, as values. Whoever runs a command carries out what it returns.

use super::library::{RecentChange, Shipped};
use super::question::Question;
use super::sought::Sought;
use super::ticket::Ticket;
use crate::clay::MeshFormat;
use crate::describe::Snippet;
use crate::document::{RawVoxels, SubjectRef};

/// Bytes on their way out.
#[derive(Clone, Debug, PartialEq)]
pub struct SaveFile {
    /// Proposed file name with its ending.
    pub name: String,
    /// Media type of the file, such as `image/png`.
    pub mime: &'static str,
    /// Content of the file.
    pub bytes: Vec<u8>,
}

/// How the address bar takes a new link.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LinkChange {
    /// In place: while something is dragged, and for the camera.
    Replace,
    /// As a new entry of the history.
    Push,
}

/// A control that takes the keyboard.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Focus {
    /// The tab of the panel that is open.
    Panel,
    /// The search over the catalogue.
    Search,
    /// The search over tissues and captions.
    Tissues,
    /// The text field of the caption of this index.
    Caption(usize),
    /// The text field of the document's title.
    Title,
}

/// One thing to do outside of the session.
#[derive(Clone, Debug)]
pub enum Effect {
    /// Start loading a subject, and tell the session by `load_started`.
    LoadSubject(SubjectRef),
    /// Stop the load of this ticket.
    CancelLoad(Ticket),
    /// Let a load fetch from the host that the user was asked about.
    AllowHost(Ticket),
    /// Fetch displacement fields from this host.
    AllowFields(String),
    /// Go on with the mesh of this hash that was held back: it becomes the subject.
    ShowMesh(String),
    /// Let go of the mesh that was held back.
    DropMesh,
    /// Say how the voxels of the file lie that a load asked about.
    AnswerRaw(Ticket, RawVoxels),
    /// Stop finding the tissues of the document.
    StopTissues,
    /// Go on finding them after a stop.
    FindTissues,
    /// Stop bending the figure.
    StopBending,
    /// Go on bending it after a stop.
    GoOnBending,
    /// Show a dialog for a scan or a document.
    OpenFile,
    /// Give bytes to the user as a file.
    Save(SaveFile),
    /// Give the clay that is shown to the user as a file of this format.
    SaveMesh(MeshFormat),
    /// Draw the picture once more for a file.
    SavePicture,
    /// Stop making the picture for a file.
    StopSaving,
    /// Put text on the clipboard.
    Copy(String),
    /// Put the link on the clipboard; the text goes behind the `#` of the page's address.
    CopyLink(String),
    /// Put HTML for a page on the clipboard, made of the document as it is seen and the page's address.
    CopySnippet(Snippet),
    /// Read the clipboard, for templates to paste.
    Paste,
    /// Show a link in the address bar; the text goes behind its `#`.
    SetLink(String, LinkChange),
    /// Keep a text under a key for the next start.
    Store(&'static str, String),
    /// Fetch a file that ships with the program.
    FetchShipped(Shipped),
    /// Change the list of documents that were open before, and give it to the library if it is open.
    Recent(RecentChange),
    /// Ask the picture a question; its answer is a command.
    Ask(Question),
    /// Find out where that lies; the answer is `Command::TurnTo`.
    Locate(Sought),
    /// Give a control the keyboard.
    Focus(Focus),
    /// Change between the light and the dark theme.
    ToggleTheme,
    /// Change between high and usual contrast.
    ToggleContrast,
    /// Draw the interface larger by a factor.
    Scale(f32),
}
