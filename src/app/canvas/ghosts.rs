//! What is laid down on a clay, over the picture: the way of each tool, its keys to be dragged, and its outline at both
//! ends; and the tool that handles move.

use egui::Ui;

use super::outline::{paint_outline, placed_outline};
use super::points::Moved;
use super::projection::Projection;
use super::strokes::{keys_ui, paint_move};
use crate::app::kit::theme::over_picture as ink;
use crate::app::session::{ClayCommand, Command, Pose, Session};
use crate::document::ClayKey;
use crate::math::Similarity;

/// The ghosts. Delete on a key takes all of its ghost back.
pub(crate) fn ui(ui: &Ui, view: &Projection, session: &Session, commands: &mut Vec<Command>) {
    let painter = ui.painter_at(view.rect);
    let (mirror, grids) = (session.hand().mirror, &session.view.grids);
    if let Some(Pose { at, turn, .. }) = session.laid() {
        let pose = Similarity::new(1.0, turn.as_dquat(), at.as_dvec3());
        let outline = placed_outline(grids, &session.hand().shape(), pose);
        paint_outline(&painter, view, &outline, mirror, ink::HOT);
    }
    let last = session.together.ghosts.len().wrapping_sub(1);
    for (i, ghost) in session.together.ghosts.iter().enumerate() {
        let poses = ClayKey::poses(&ghost.way.keys);
        let ends = [poses.first(), poses.last()];
        let count = poses.len().min(ends.len());
        for pose in ends.into_iter().take(count).flatten() {
            if let Some(shape) = &ghost.tool.shape {
                let outline = placed_outline(grids, shape, *pose);
                paint_outline(&painter, view, &outline, mirror, ink::HALO_LIGHT);
            }
        }
        paint_move(ui, view, &ghost.way);
        // Handles move it as a whole.
        if session.is_ghost_laid() && i == last {
            continue;
        }
        let command = match keys_ui(ui, view, &ghost.way, i).1 {
            Some((key, Moved::To(pos))) => ClayCommand::MoveGhost([i, key], pos),
            Some((_, Moved::Removed)) => ClayCommand::RemoveGhost(i),
            None => continue,
        };
        commands.push(Command::Clay(command));
    }
}
