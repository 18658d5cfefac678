//! The tool that shapes a clay or draws a sweep while it is in hand: its sizes, how it stands, its mirror images.

use egui::Ui;

use crate::app::kit::widget::{self, Named as _, NumberRow};
use crate::app::session::{Command, HandCommand, HeldTool};
use crate::app::words::clay::w;
use crate::app::words::fill;

/// The rows of the tool in the hand; the bar over the picture has its way and its form.
pub(crate) fn ui(ui: &mut Ui, hand: &HeldTool, commands: &mut Vec<Command>) {
    let mut new = hand.clone();
    let [sizes, coats] = HeldTool::RANGES;
    let rows = [
        (w().size, w().size_hint, &mut new.size, sizes),
        (w().coat, w().coat_hint, &mut new.coat, coats),
    ];
    for (name, summary, value, range) in rows {
        let row = NumberRow {
            name,
            summary,
            value: f64::from(*value),
            default: Some(0.1),
            range: range.map(f64::from),
            unit: "",
            decimals: 3,
        };
        if let Some(change) = row.ui_logarithmic(ui) {
            *value = *change.value() as f32;
        }
    }
    let whole = |(name, summary), value: f32, most: f64, unit| NumberRow {
        name,
        summary,
        value: f64::from(value),
        default: Some(0.0),
        range: [-most, most],
        unit,
        decimals: 0,
    };
    let depth = whole((w().depth, w().depth_hint), hand.depth * 100.0, 100.0, " %");
    if let Some(change) = depth.ui(ui) {
        new.depth = *change.value() as f32 / 100.0;
    }
    let turn = whole((w().angle, w().angle_hint), hand.turn_deg, 180.0, "°");
    if let Some(change) = turn.ui(ui) {
        new.turn_deg = *change.value() as f32;
    }
    widget::row(ui, |ui| {
        widget::row_label(ui, w().mirrors, w().mirror_hint);
        for (axis, name) in ["X", "Y", "Z"].into_iter().enumerate() {
            let named = fill(w().mirror, &[&name.to_lowercase()]);
            let response = ui.checkbox(&mut new.mirror[axis], name).named(&named);
            response.on_hover_text(w().mirror_hint);
        }
    });
    if new != *hand {
        commands.push(Command::Hand(HandCommand::Hold(new)));
    }
}
