//! What the app asks of its surroundings, and what comes back. The shell implements [`Services`] natively and on the
//! page; tests have a false one. Nothing here blocks and nothing here knows a file, a thread or an address bar.

use egui::{Pos2, Vec2};
use std::path::PathBuf;

use crate::app::session::{LinkChange, SaveFile, Shipped, Ticket};
use crate::app::words::{self, fill};
use crate::assets::{BendAnswer, BendRequest, LoadEvent, SegmentationsExpected, Want};
use crate::clay::Writing;
use crate::document::RawVoxels;
use crate::load::FieldFile;

/// Calls return at once; results come as [`Message`]s by [`Services::poll`].
pub trait Services {
    /// What has arrived since the last call. Whoever adds a message asks the egui context for a repaint.
    fn poll(&mut self) -> Vec<Message>;
    /// Shows a dialog for a scan or a document.
    fn open_file(&mut self);
    /// Opens a file that was dropped on the window: a scan or a document.
    fn drop_file(&mut self, file: egui::DroppedFileHandle);
    /// Starts to load a subject or a label volume, and ends any load before it. The hash of the
    /// bytes is not yet compared with that in the document.
    fn load(&mut self, want: &Want) -> Ticket;
    /// Which label volumes the document names, by the hash of their files, and whether the scan that they would go with
    /// is shown: then files that are opened are taken as segments of it where they are labels.
    fn expect_segmentations(&mut self, expected: &SegmentationsExpected) {
        _ = expected;
    }
    /// True while the shell reads files outside a load: files that the user opened, which may turn out to be documents,
    /// fields or scans, and fields that the document names. Also true while messages wait to be polled, as far as the
    /// shell knows.
    fn is_reading(&self) -> bool {
        false
    }
    /// The reader agreed to fetch from the host that [`Message::AskHost`] named.
    fn allow_host(&mut self, ticket: Ticket);
    /// The reader agreed to fetch displacement fields from the host that [`Message::AskFieldHost`] named.
    fn allow_fields(&mut self, host: &str) {
        _ = host;
    }
    /// How the voxels lie in the file that [`LoadEvent::AskRaw`] asked about; its load goes on under the same ticket.
    fn answer_raw(&mut self, ticket: Ticket, raw: &RawVoxels);
    /// Reads a displacement field; [`Message::Field`] follows, or [`Message::AskFieldHost`].
    fn load_field(&mut self, want: &Want) {
        _ = want;
    }
    /// Bends a figure; [`Message::Bent`] follows. Only one is asked for at a time.
    fn bend(&mut self, request: BendRequest) {
        _ = request;
    }
    /// Stops the bending of a figure; [`BendAnswer::Stopped`] follows, or an answer that was there before.
    fn stop_bending(&mut self) {}
    /// Fetches a file that ships with the program; [`Message::Shipped`] follows.
    fn fetch_shipped(&mut self, file: Shipped);
    /// Stops a load; [`LoadEvent::Cancelled`] follows.
    fn cancel_load(&mut self, ticket: Ticket);
    /// Gives bytes to the user as a file; [`Message::Saved`] follows.
    fn save_file(&mut self, file: SaveFile);
    /// Shapes a clay, unless that was done, and gives its mesh to the user as a file; [`Message::Saved`] follows.
    fn save_mesh(&mut self, want: &Want, mesh: MeshToSave) {
        _ = (want, mesh);
    }
    /// No clay is shown any more: gives back what the strokes of the last one have left.
    fn let_clay_go(&mut self) {}
    /// Puts text on the clipboard; [`Message::Copied`] follows.
    fn copy_text(&mut self, text: String);
    /// Reads the clipboard; [`Message::Pasted`] follows.
    fn paste_text(&mut self);
    /// The page that goes in front of `#payload` when a link is copied.
    fn page_address(&self) -> String;
    /// Shows the document's payload in the address bar, where there is one.
    fn set_link(&mut self, payload: &str, change: LinkChange);
    /// Keeps a text for the next time the program is started.
    fn store(&mut self, key: &str, value: &str);
    /// Calls the window, or the tab of the browser, by this title.
    fn set_title(&mut self, title: &str) {
        _ = title;
    }
    /// Language tags that the reader wants, the best liked first.
    fn languages(&self) -> Vec<String> {
        Vec::new()
    }
    /// True if fingers are what points first, whatever the window's width.
    fn has_fingers(&self) -> bool {
        false
    }
    /// How hard a pen presses, 0 to 1, where the surroundings tell it beside the touches and the mouse that the window
    /// hears of; `None` while none does.
    fn pen(&self) -> Option<f32> {
        None
    }
    /// True if the reader has asked for high contrast everywhere.
    fn wants_contrast(&self) -> bool {
        false
    }
    /// True if the reader has asked for less motion everywhere: passages between steps are cuts.
    fn wants_less_motion(&self) -> bool {
        false
    }
    /// True if the surroundings set texts themselves, and shape all scripts: see [`Services::show_texts`] and
    /// [`Services::set_text`].
    fn sets_texts(&self) -> bool {
        false
    }
    /// Shows these texts over the picture, in place of those of the last call. Returns the width and height of each,
    /// points; fewer where they are not known.
    fn show_texts(&mut self, texts: &[TextOver]) -> Vec<Vec2> {
        _ = texts;
        Vec::new()
    }
    /// Sets a text for a picture; `None` where that cannot be done.
    fn set_text(&self, text: &TextToSet) -> Option<SetText> {
        _ = text;
        None
    }
    /// The text that was last given to [`Services::store`] under this key; `None` if there is none.
    fn stored(&self, key: &str) -> Option<String>;

    /// Has a screen reader speak a line, where the shell has a way to do so: a page has no accessibility tree of the
    /// app's own.
    fn announce(&mut self, text: &str) {
        _ = text;
    }
}

/// Where a file went that was given to the user.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum SavedTo {
    /// A file of this name among the downloads of the browser, wherever those are.
    Downloads(String),
    /// A file of this machine.
    Path(PathBuf),
}

/// A document whose address is known, but which could not be had.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MissingDocument {
    /// The address, as the reader knows it.
    pub address: String,
    /// What became of it.
    pub why: WhyMissing,
}

impl MissingDocument {
    /// Why the document could not be had: one line, and more on demand.
    pub(crate) fn in_words(&self) -> (String, String) {
        let w = words::messages::w();
        let (line, details) = match &self.why {
            WhyMissing::Answer(404 | 410) => (w.document_missing, String::new()),
            WhyMissing::Answer(status) => (w.document_refused, fill(w.server_answered, &[status])),
            WhyMissing::Unreachable(why) => (w.document_unreachable, why.clone()),
            WhyMissing::TooLong => (w.document_too_long, String::new()),
        };
        (fill(line, &[&self.address]), details)
    }
}

/// What became of a document that was asked for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum WhyMissing {
    /// The server answered with this status of HTTP.
    Answer(u16),
    /// There was no answer; the browser's words.
    Unreachable(String),
    /// The file has more bytes than a document may have.
    TooLong,
}

/// What the shell tells the app: results of the calls of [`Services`], and what the user opened.
#[derive(Debug)]
pub enum Message {
    /// A document as JSON, or a link: from a file, an argument or the address bar.
    OpenText {
        /// The whole text, a document or a link.
        text: String,
    },
    /// A scan that the user opened has begun to load; it becomes the document's subject when it is done.
    FileStarted {
        /// Names the load in later messages.
        ticket: Ticket,
    },
    /// A displacement field was read, or why not.
    Field {
        /// What it was asked for; `None` if the user opened it.
        want: Option<Want>,
        /// The field, or why there is none, in plain words.
        outcome: Box<Result<FieldFile, String>>,
    },
    /// Progress of a load.
    Load {
        /// The load that goes on.
        ticket: Ticket,
        /// What happened to the load since the last message.
        event: LoadEvent,
    },
    /// A file lies on another host than the page: fetch it?
    AskHost {
        /// The load that waits.
        ticket: Ticket,
        /// Name of the host.
        host: String,
    },
    /// A displacement field lies on another host than the page: fetch it?
    AskFieldHost {
        /// What was asked for.
        want: Want,
        /// Name of the host.
        host: String,
    },
    /// A figure is bent, or is not.
    Bent(BendAnswer),
    /// A file that ships with the program has come, or has not.
    Shipped {
        /// The file that was asked for.
        file: Shipped,
        /// Its bytes, or why there are none.
        outcome: Result<Vec<u8>, String>,
    },
    /// The clipboard has the text, or why not.
    Copied(Result<(), String>),
    /// The text on the clipboard; `None` where the clipboard may not be read.
    Pasted(Option<String>),
    /// Where the file was saved, or why it was not; an empty reason means that the user thought better of it.
    Saved(Result<SavedTo, String>),
    /// A shader file was changed. Sent by debug builds only.
    #[cfg(all(debug_assertions, not(target_arch = "wasm32")))]
    ShadersChanged,
    /// Something to tell the user.
    Notice {
        /// One line in plain words.
        message: String,
        /// More, shown on demand; may be empty.
        details: String,
    },
}

/// A file that a clay is to become, and that the user is given.
#[derive(Clone, Debug, PartialEq)]
pub struct MeshToSave {
    /// What is written.
    pub writing: Writing,
    /// Proposed file name with its ending.
    pub name: String,
}

/// A text over the picture, for surroundings that show it as a text of their own.
#[derive(Clone, Debug, PartialEq)]
pub struct TextOver {
    /// Number of the document's caption, from 0.
    pub caption: usize,
    /// What is written.
    pub text: String,
    /// The upper left corner, points; `None`: it is not seen, and is told to screen readers alone.
    pub at: Option<Pos2>,
    /// Width at most, points.
    pub widest: f32,
    /// Height of the letters, points.
    pub letters: f32,
    /// Letters are light, for a dark ground.
    pub is_light: bool,
    /// What the text names lies behind something.
    pub is_faded: bool,
}

/// A text that is to be set for a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct TextToSet {
    /// What is written.
    pub text: String,
    /// Height of the letters, pixels.
    pub letters_px: f32,
    /// In strong letters.
    pub is_strong: bool,
    /// Width of a row at most, pixels.
    pub widest_px: f32,
    /// Rows at most.
    pub rows: usize,
}

/// A text as letters that cover pixels.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SetText {
    /// Width and height, pixels.
    pub size: [u32; 2],
    /// How much of each pixel the letters cover, 0 to 255, row by row from the top.
    pub coverage: Vec<u8>,
}

impl SetText {
    /// Width and height, pixels.
    pub(crate) fn size_px(&self) -> Vec2 {
        let [width, height] = self.size;
        Vec2::new(width as f32, height as f32)
    }
}
