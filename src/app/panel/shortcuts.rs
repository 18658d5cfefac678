//! The table of keys: which key makes which command, and how the sheet of keys words it.

use egui::{Key, KeyboardShortcut, Modifiers};

use crate::app::session::{
    ClayCommand, Command, GizmoMode, HandCommand, See, StandardView, StepCommand,
};
use crate::app::words::keys::w;
use crate::document::Plane;

/// A key, its command, and its line in the sheet of keys.
pub(crate) struct Shortcut {
    /// The key and the modifiers held with it.
    pub keys: KeyboardShortcut,
    /// The command that the key runs.
    pub command: Command,
    /// As in the sheet; an empty text is not listed (a second key for the same).
    pub text: &'static str,
}

const SHIFT: Modifiers = Modifiers::SHIFT;
const NONE: Modifiers = Modifiers::NONE;
const COMMAND: Modifiers = Modifiers::COMMAND;

/// Radians by which an arrow key turns the camera.
const KEY_ORBIT: f32 = 0.13;

/// True for commands whose keys arrive as an event of the clipboard.
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
    let coat = |is_wider| Command::Hand(HandCommand::Recoat(is_wider));
    let hand = crate::app::words::clay::w();
    let w = w();
    let s = crate::app::words::slices::w();
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
        // Some keyboards make braces of the brackets.
        entry(SHIFT, Key::CloseBracket, coat(true), hand.key_wider),
        entry(SHIFT, Key::CloseCurlyBracket, coat(true), ""),
        entry(SHIFT, Key::OpenBracket, coat(false), hand.key_thinner),
        entry(SHIFT, Key::OpenCurlyBracket, coat(false), ""),
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
        entry(
            NONE,
            Key::J,
            Command::Clay(ClayCommand::Together),
            crate::app::words::clay::w().key_together,
        ),
        entry(
            SHIFT,
            Key::Q,
            Command::Hand(HandCommand::NextWay(false)),
            "",
        ),
        entry(
            NONE,
            Key::Q,
            Command::Hand(HandCommand::NextWay(true)),
            crate::app::words::clay::w().key_way,
        ),
        entry(NONE, Key::K, Command::ToggleSnap, w.snap),
        entry(
            SHIFT,
            Key::A,
            Command::Step(StepCommand::Add),
            crate::app::words::steps::w().add,
        ),
        entry(
            NONE,
            Key::A,
            Command::ToggleCaptioning,
            crate::app::words::captions::w().add,
        ),
        entry(NONE, Key::Slash, Command::StartSearch, w.search),
        entry(NONE, Key::F, Command::StartSeeking, w.seek),
        entry(COMMAND, Key::F, Command::StartSeeking, ""),
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
        entry(NONE, Key::Z, Command::See(See::ToggleWires), s.key_wires),
        entry(
            NONE,
            Key::R,
            Command::See(See::ToggleMeasure),
            s.key_measure,
        ),
        entry(NONE, Key::W, Command::See(See::ToggleLevel), s.key_level),
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
