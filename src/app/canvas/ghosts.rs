//! What is laid down on a clay, over the picture: the way of each tool, its keys to be dragged, and its outline at both
//! ends.

use egui::Ui;

use super::outline::{paint_outline, placed_outline};
use super::points::Moved;
use super::projection::Projection;
use super::strokes::{keys_ui, paint_move};
use crate::app::kit::theme::over_picture as ink;
use crate::app::session::{ClayCommand, Command, Session};

/// The ghosts. Delete on a key takes all of its ghost back.
pub(crate) fn ui(ui: &Ui, view: &Projection, session: &Session, commands: &mut Vec<Command>) {
    let painter = ui.painter_at(view.rect);
    for (i, ghost) in session.together.ghosts.iter().enumerate() {
        let poses = ghost.poses();
        let ends = [poses.first(), poses.last()];
        let count = poses.len().min(ends.len());
        for pose in ends.into_iter().take(count).flatten() {
            if let Some(shape) = &ghost.tool.shape {
                let outline = placed_outline(shape, *pose);
                let mirror = session.clay_hand.mirror;
                paint_outline(&painter, view, &outline, mirror, ink::HALO_LIGHT);
            }
        }
        paint_move(ui, view, &ghost.way);
        let command = match keys_ui(ui, view, &ghost.way, i).1 {
            Some((key, Moved::To(pos))) => ClayCommand::MoveGhost([i, key], pos),
            Some((_, Moved::Removed)) => ClayCommand::RemoveGhost(i),
            None => continue,
        };
        commands.push(Command::Clay(command));
    }
}
