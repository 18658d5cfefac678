//! Everything that can be done, as values: buttons, keys and gestures say what, [`super::state::State`] does it.

use egui::{Key, KeyboardShortcut, Modifiers};

use super::camera::StandardView;
use super::tissue::TissueCommand;
use super::view::See;
use super::words::Lang;
use super::words::keys::w;
use crate::document::{Edit, Plane, SubjectRef, TemplateKind};

/// One thing to do.
#[derive(Clone, Debug)]
pub enum Command {
    /// Takes the last change back.
    Undo,
    /// Does again what was taken back.
    Redo,
    /// Changes the document: one step of undo.
    Apply(Edit),
    /// Changes the document as part of a drag: the drag is one step of undo.
    Drag(Edit),
    /// Starts placing a template: the next click on the object says where.
    StartPlacing(TemplateKind),
    /// Puts the template being placed on what the middle of the picture shows.
    PlaceInMiddle,
    /// Starts or ends setting a label.
    ToggleLabelling,
    /// Drops what is being done: placing, the selection, a sheet.
    Escape,
    /// Selects a template by its index in the document.
    Select(Option<usize>),
    /// Selects the next one in the list, or with `false` the one before.
    SelectNext(bool),
    /// Removes the selected template.
    DeleteSelected,
    /// Makes a copy of the selected template behind it.
    DuplicateSelected,
    /// Puts the selected template, with its group, on the clipboard.
    Copy,
    /// The same, and takes it out of the document.
    Cut,
    /// Takes what is on the clipboard: templates, a link, a document.
    Paste,
    /// Mirrors the selected template, with its group, across a middle plane of the subject: as a copy, or where it is.
    Mirror(Plane, bool),
    /// Turns and moves the selected template so that it lies on the surface under it.
    LayOnSurface,
    /// Bends the selected template along the surface under it.
    FollowSurface,
    /// Puts the selected template into the group of the one before it.
    GroupWithPrevious,
    /// Takes the selected template out of its group.
    LeaveGroup,
    /// Handles go in steps, or not.
    ToggleSnap,
    /// Says what the catalogue is searched for.
    Search(String),
    /// Puts the keyboard into the search over the catalogue.
    StartSearch,
    /// Shows or hides the selected template.
    ToggleSelected,
    /// Makes the selected template act earlier (`-1`) or later (`1`).
    ShiftSelected(i8),
    /// Adds to the main parameter of the selected template, in hundredths of its range.
    NudgeMain(f32),
    /// What the handles in the picture do.
    SetGizmo(GizmoMode),
    /// Looks from a side.
    View(StandardView),
    /// Back to the camera that the document came with.
    ResetView,
    /// Turns the camera, radians to the right and down.
    Orbit(f32, f32),
    /// Comes closer by a factor.
    Zoom(f32),
    /// Takes a subject in place of the present one.
    SetSubject(SubjectRef),
    /// Opens a scan or a document.
    Open,
    /// Starts from an empty document.
    New,
    /// Shows a step of the document; 0 is the document as it stands.
    GoToStep(usize),
    /// Shows the next step, or with `false` the one before.
    WalkStep(bool),
    /// Puts the link on the clipboard.
    CopyLink,
    /// Saves the document as a file.
    SaveDocument,
    /// Saves the picture as a PNG.
    SavePicture,
    /// Stops loading.
    CancelLoad,
    /// Fetches from the host that was asked about.
    AllowHost,
    /// Shows or hides the sheet of keys.
    ToggleKeys,
    /// Shows or hides what the program has said so far.
    ToggleMessages,
    /// Shows or hides the choice among the volumes of the subject's file.
    ToggleFrames,
    /// Light, dark.
    ToggleTheme,
    /// Turns to the next panel and gives it the keyboard, or with `false` to the one before.
    NextPanel(bool),
    /// High contrast or the usual one.
    ToggleContrast,
    /// Title and credit are written into saved pictures, or not.
    ToggleLettering,
    /// The first hint does not come again.
    PutHintAway,
    /// The interface speaks another language.
    Speak(Lang),
    /// Everything larger or smaller, for a projector.
    Scale(f32),
    /// Panels away, the picture alone.
    TogglePanels,
    /// Changes how one looks: slices, ghost, distances.
    See(See),
    /// Edits or shows tissues.
    Tissue(TissueCommand),
}

/// What the handles in the picture do.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum GizmoMode {
    /// Along the axes, in the planes between them, freely.
    #[default]
    Move,
    /// About the axes.
    Turn,
    /// The faces of the box.
    Size,
}

impl GizmoMode {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Move, Self::Turn, Self::Size];
}

/// A key, what it does, and how the sheet of keys says it.
pub(crate) struct Shortcut {
    /// Which keys.
    pub keys: KeyboardShortcut,
    /// What it does.
    pub command: Command,
    /// As in the sheet; an empty text is not listed (a second key for the same).
    pub text: &'static str,
}

const SHIFT: Modifiers = Modifiers::SHIFT;
const NONE: Modifiers = Modifiers::NONE;
const COMMAND: Modifiers = Modifiers::COMMAND;

/// Radians by which an arrow key turns the camera.
const KEY_ORBIT: f32 = 0.13;

/// True for what comes as an event of the clipboard instead of as a key.
pub(crate) fn is_of_clipboard(command: &Command) -> bool {
    matches!(command, Command::Copy | Command::Cut | Command::Paste)
}

/// Every shortcut. Those with more modifiers come first, since egui takes `Ctrl+Z` out of `Ctrl+Shift+Z` as well.
pub(crate) fn shortcuts() -> Vec<Shortcut> {
    let entry = |modifiers: Modifiers, key: Key, command: Command, text: &'static str| Shortcut {
        keys: KeyboardShortcut::new(modifiers, key),
        command,
        text,
    };
    let w = w();
    let s = super::words::slices::w();
    let mut all = vec![
        entry(COMMAND | SHIFT, Key::Z, Command::Redo, w.redo),
        entry(COMMAND, Key::Y, Command::Redo, ""),
        entry(COMMAND, Key::Z, Command::Undo, w.undo),
        // The window and the page give these three as events of their own, not as keys.
        entry(COMMAND, Key::C, Command::Copy, w.copy),
        entry(COMMAND, Key::X, Command::Cut, w.cut),
        entry(COMMAND, Key::V, Command::Paste, w.paste),
        entry(COMMAND | SHIFT, Key::G, Command::LeaveGroup, w.ungroup),
        entry(COMMAND, Key::G, Command::GroupWithPrevious, w.group),
        entry(COMMAND, Key::O, Command::Open, w.open),
        entry(
            COMMAND | SHIFT,
            Key::S,
            Command::SavePicture,
            w.save_picture,
        ),
        entry(COMMAND, Key::S, Command::SaveDocument, w.save_document),
        entry(COMMAND | SHIFT, Key::L, Command::CopyLink, w.copy_link),
        entry(
            NONE,
            Key::ArrowLeft,
            Command::Orbit(-KEY_ORBIT, 0.0),
            w.turn_object,
        ),
        entry(NONE, Key::ArrowRight, Command::Orbit(KEY_ORBIT, 0.0), ""),
        entry(NONE, Key::ArrowUp, Command::Orbit(0.0, -KEY_ORBIT), ""),
        entry(NONE, Key::ArrowDown, Command::Orbit(0.0, KEY_ORBIT), ""),
        entry(NONE, Key::Plus, Command::Zoom(1.15), w.closer),
        entry(NONE, Key::Equals, Command::Zoom(1.15), ""),
        entry(NONE, Key::Minus, Command::Zoom(1.0 / 1.15), w.further),
        entry(NONE, Key::Num0, Command::ResetView, w.first_view),
        entry(NONE, Key::Enter, Command::PlaceInMiddle, w.place_in_middle),
        entry(NONE, Key::Escape, Command::Escape, w.drop),
        entry(SHIFT, Key::N, Command::SelectNext(false), w.before),
        entry(NONE, Key::N, Command::SelectNext(true), w.next),
        entry(NONE, Key::G, Command::SetGizmo(GizmoMode::Move), w.move_it),
        entry(NONE, Key::T, Command::SetGizmo(GizmoMode::Turn), w.turn_it),
        entry(NONE, Key::S, Command::SetGizmo(GizmoMode::Size), w.size_it),
        entry(
            NONE,
            Key::CloseBracket,
            Command::NudgeMain(5.0),
            w.open_further,
        ),
        entry(NONE, Key::OpenBracket, Command::NudgeMain(-5.0), w.close_it),
        entry(NONE, Key::H, Command::ToggleSelected, w.hide),
        entry(NONE, Key::D, Command::DuplicateSelected, w.duplicate),
        entry(
            NONE,
            Key::M,
            Command::Mirror(Plane::Sagittal, true),
            w.mirror,
        ),
        entry(NONE, Key::L, Command::LayOnSurface, w.lay),
        entry(NONE, Key::K, Command::ToggleSnap, w.snap),
        entry(
            NONE,
            Key::A,
            Command::ToggleLabelling,
            super::words::labels::w().add,
        ),
        entry(NONE, Key::Slash, Command::StartSearch, w.search),
        entry(NONE, Key::Delete, Command::DeleteSelected, w.delete),
        entry(NONE, Key::Backspace, Command::DeleteSelected, ""),
        entry(NONE, Key::PageUp, Command::ShiftSelected(-1), w.earlier),
        entry(NONE, Key::PageDown, Command::ShiftSelected(1), w.later),
        entry(NONE, Key::Space, Command::WalkStep(true), w.next_step),
        entry(SHIFT, Key::Space, Command::WalkStep(false), w.step_before),
        entry(SHIFT, Key::E, Command::NextPanel(false), ""),
        entry(NONE, Key::E, Command::NextPanel(true), w.next_panel),
        entry(NONE, Key::P, Command::TogglePanels, w.picture_alone),
        entry(NONE, Key::V, Command::See(See::ToggleSlices), s.key_slices),
        entry(NONE, Key::B, Command::See(See::ToggleGhost), s.key_ghost),
        entry(
            NONE,
            Key::R,
            Command::See(See::ToggleMeasure),
            s.key_measure,
        ),
        entry(NONE, Key::F1, Command::ToggleKeys, ""),
        entry(NONE, Key::Questionmark, Command::ToggleKeys, w.this_sheet),
    ];
    let digits = [
        Key::Num1,
        Key::Num2,
        Key::Num3,
        Key::Num4,
        Key::Num5,
        Key::Num6,
    ];
    let texts = [w.front, w.back, w.right, w.left, w.above, w.below];
    for ((view, key), text) in StandardView::ALL.into_iter().zip(digits).zip(texts) {
        all.push(entry(NONE, key, Command::View(view), text));
    }
    all
}
