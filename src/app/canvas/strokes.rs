//! The selected stroke of a clay over the picture: the way of each of its tools, and its keys to be dragged.

use egui::{Pos2, Ui};
use glam::Vec3;

use super::points::{Dot, Moved, handle, is_hot};
use super::projection::Projection;
use super::ways::paint_way;
use crate::app::kit::theme::over_picture as ink;
use crate::app::session::{Command, Session, curve, with_key_at, without_key};
use crate::app::words::fill;
use crate::app::words::sweep::w;
use crate::document::{ClayKey, ClayMove};

/// The lines and the handles. True if one of them is under the pointer or held.
pub(crate) fn ui(
    ui: &mut Ui,
    view: &Projection,
    session: &Session,
    commands: &mut Vec<Command>,
) -> bool {
    let Some((index, stroke)) = session.selected_stroke() else {
        return false;
    };
    let mut is_over = false;
    for (t, one) in stroke.moves.iter().enumerate() {
        paint_move(ui, view, one);
        let (is_hot, moved) = keys_ui(ui, view, one, t);
        is_over |= is_hot;
        match moved {
            Some((k, Moved::To(pos))) => {
                let edit = with_key_at(index, stroke, (t, k), pos);
                commands.push(Command::Drag(edit));
            }
            Some((k, Moved::Removed)) => {
                let edit = without_key(index, stroke, (t, k));
                commands.extend(edit.map(Command::Apply));
            }
            None => {}
        }
    }
    is_over
}

/// Draws the way of a tool.
pub(super) fn paint_move(ui: &Ui, view: &Projection, one: &ClayMove) {
    let line = way(one).into_iter().map(|pos| view.ui_from_subject(pos));
    if let Some(line) = line.collect::<Option<Vec<Pos2>>>() {
        paint_way(&ui.painter_at(view.rect), line);
    }
}

/// The keys of the tool of this index, to be dragged. Whether one of them is under the pointer or held, and which one
/// has gone where.
pub(super) fn keys_ui(
    ui: &Ui,
    view: &Projection,
    one: &ClayMove,
    tool: usize,
) -> (bool, Option<(usize, Moved)>) {
    let (mut is_over, mut changed) = (false, None);
    for (k, key) in one.keys.iter().enumerate() {
        let at = place(key);
        let Some(spot) = view.ui_from_subject(at) else {
            continue;
        };
        let name = fill(w().key_of, &[&(k + 1), &(tool + 1)]);
        let dot = Dot::full(&name, ink::HANDLE);
        let (response, moved) = handle(ui, view, spot, (at, view.back()), &dot);
        is_over |= is_hot(&response);
        changed = changed.or(moved.map(|moved| (k, moved)));
    }
    (is_over, changed)
}

/// Where a key is, subject space.
fn place(key: &ClayKey) -> Vec3 {
    Vec3::from_array(key.at.map(|thousandths| thousandths as f32 / 1000.0))
}

/// The way of a tool's origin, subject space.
fn way(one: &ClayMove) -> Vec<Vec3> {
    let places: Vec<Vec3> = one.keys.iter().map(place).collect();
    match one.is_straight {
        true => places,
        false => curve(&places),
    }
}
