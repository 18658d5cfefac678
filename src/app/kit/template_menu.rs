//! The menu of the selected template, wherever it is opened from: a button, the right mouse button, a long press.

use egui::Ui;

use super::icon::Icon;
use super::menu::menu_item;
use crate::app::session::{Command, Session};
use crate::app::words;
use crate::app::words::authoring::w;
use crate::document::{Plane, group_of};

/// Entries of the menu: those that can be run now.
pub(crate) fn menu_entries(session: &Session) -> Vec<MenuEntry> {
    let w = w();
    let has_one = session.selection.template().is_some();
    let mut entries = Vec::new();
    let mut add = |icon, text: &'static str, command| {
        entries.push(MenuEntry {
            icon,
            text,
            command,
        });
    };
    if has_one {
        add(Icon::Copy, w.copy, Command::Copy);
        add(Icon::Cut, w.cut, Command::Cut);
    }
    add(Icon::Paste, w.paste, Command::Paste);
    if let Some(selected) = session.selection.template() {
        let words = words::picture::w();
        let is_on = session.selected_template().is_some_and(|t| t.enabled);
        let (eye, text) = match is_on {
            true => (Icon::EyeOff, words.hide),
            false => (Icon::Eye, words.show),
        };
        add(eye, text, Command::ToggleSelected);
        add(Icon::Plus, w.duplicate, Command::DuplicateSelected);
        add(
            Icon::Mirror,
            w.mirror_sagittal,
            Command::Mirror(Plane::Sagittal, true),
        );
        add(
            Icon::Mirror,
            w.mirror_coronal,
            Command::Mirror(Plane::Coronal, true),
        );
        add(
            Icon::Mirror,
            w.mirror_axial,
            Command::Mirror(Plane::Axial, true),
        );
        add(
            Icon::Mirror,
            w.mirror_here,
            Command::Mirror(Plane::Sagittal, false),
        );
        add(Icon::Down, w.lay, Command::LayOnSurface);
        let follow = words::curve::w().follow;
        add(Icon::Down, follow, Command::FollowSurface);
        if selected > 0 {
            add(Icon::Layers, w.group_previous, Command::GroupWithPrevious);
        }
        if !group_of(session.document(), selected).is_empty() {
            add(Icon::Close, w.leave_group, Command::LeaveGroup);
        }
        add(Icon::Trash, words.delete, Command::DeleteSelected);
    }
    let snap = if session.is_snapping {
        w.snap_off
    } else {
        w.snap_on
    };
    add(Icon::Snap, snap, Command::ToggleSnap);
    entries
}

/// An entry of the menu of a template.
pub(crate) struct MenuEntry {
    /// Drawn at the left of the row.
    pub icon: Icon,
    /// What the row says, in the language of the interface.
    pub text: &'static str,
    /// The command of the row.
    pub command: Command,
}

/// The menu of the selected template, wherever it is opened from: a button, the right mouse button, a long press.
pub(crate) fn ui(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    ui.set_min_width(236.0);
    ui.spacing_mut().item_spacing.y = 0.0;
    for entry in menu_entries(session) {
        if menu_item(ui, entry.icon, entry.text) {
            commands.push(entry.command);
            ui.close();
        }
    }
}
