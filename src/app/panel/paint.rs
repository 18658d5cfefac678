//! Painting in the form of a tissue: the ball, whether it paints or erases, and the strokes so far.

use egui::{Label, Ui};

use crate::app::kit::icon::Icon;
use crate::app::kit::widget::{self, NumberRow};
use crate::app::session::{Command, Session, TissueCommand};
use crate::app::words::fill;
use crate::app::words::tissue::w;
use crate::document::{MAX_BALL_MM, MAX_STROKES, MIN_BALL_MM, Recipe};

/// The largest radius that the slider offers, voxels; a document may hold a larger one.
const MOST_VOXELS: f64 = 30.0;

pub(super) fn ui(
    ui: &mut Ui,
    session: &Session,
    recipe: &Recipe,
    voxel_mm: Option<f64>,
    commands: &mut Vec<Command>,
) {
    let mut push = |command| commands.push(Command::Tissue(command));
    let ball = session.tool().ball();
    let has_room = recipe.paint.len() < MAX_STROKES;
    ui.add_space(4.0);
    ui.label(w().brush);
    widget::row(ui, |ui| {
        for (erases, icon, name, hint) in [
            (false, Icon::Brush, w().paint, w().paint_hint),
            (true, Icon::Eraser, w().erase, w().erase_hint),
        ] {
            let is_held = ball == Some(erases);
            let button = widget::labelled_button(ui, icon, name, is_held, has_room);
            if button.on_hover_text(hint).clicked() {
                push(TissueCommand::Ball((!is_held).then_some(erases)));
            }
        }
    });
    let voxel_mm = voxel_mm.unwrap_or(1.0).max(1e-6);
    let radius = f64::from(session.ball_mm());
    let most = (MOST_VOXELS * voxel_mm).min(f64::from(MAX_BALL_MM));
    let row = NumberRow {
        name: w().ball,
        summary: w().ball_hint,
        value: radius,
        default: None,
        range: [f64::from(MIN_BALL_MM), most.max(radius)],
        unit: "",
        decimals: if voxel_mm < 0.3 { 2 } else { 1 },
    };
    let voxels = fill(w().voxels, &[&widget::plain(radius / voxel_mm, 1)]);
    if let Some(change) = row.ui_with_note(ui, &voxels) {
        push(TissueCommand::BallRadius(*change.value() as f32));
    }
    let count = recipe.paint.len();
    widget::row(ui, |ui| {
        ui.add(Label::new(fill(w().strokes, &[&count])).truncate());
        let has_any = count > 0;
        if widget::icon_button(ui, Icon::Undo, w().last_stroke, has_any).clicked() {
            push(TissueCommand::DropStrokes(false));
        }
        if widget::icon_button(ui, Icon::Trash, w().all_strokes, has_any).clicked() {
            push(TissueCommand::DropStrokes(true));
        }
    });
}
