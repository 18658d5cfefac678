//! The tool that shapes a clay or draws a sweep while it is in hand: its sizes, how it stands, its mirror images.

use egui::Ui;

use crate::app::kit::widget::{self, Change, Named as _, NumberRow};
use crate::app::session::{Command, HandCommand, HeldTool};
use crate::app::words::clay::w;
use crate::app::words::fill;

/// The rows of the tool in the hand; the bar over the picture has its way and its form.
pub(crate) fn ui(ui: &mut Ui, hand: &HeldTool, commands: &mut Vec<Command>) {
    let mut new = hand.clone();
    if let Some(change) = lengths_ui(ui, hand, [w().size_hint, w().coat_hint]) {
        new = change.value().clone();
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
    mirrors_ui(ui, &mut new.mirror);
    if new != *hand {
        commands.push(Command::Hand(HandCommand::Hold(new)));
    }
}

/// The rows of size and coating of a tool, with what they say about themselves: the tool as it has become. A tool of a
/// document may be larger or smaller than a hand takes one.
pub(super) fn lengths_ui(
    ui: &mut Ui,
    hand: &HeldTool,
    [size_hint, coat_hint]: [&str; 2],
) -> Option<Change<HeldTool>> {
    let [sizes, coats] = HeldTool::RANGES;
    let row = |name, summary, value: f32, [low, high]: [f32; 2]| NumberRow {
        name,
        summary,
        value: f64::from(value),
        default: Some(0.1),
        range: [low.min(value), high.max(value)].map(f64::from),
        unit: "",
        decimals: 3,
    };
    let size = row(w().size, size_hint, hand.size, sizes).ui_logarithmic(ui);
    let size = size.map(|change| {
        change.map(|size| HeldTool {
            size: size as f32,
            ..hand.clone()
        })
    });
    let coat = row(w().coat, coat_hint, hand.coat, coats).ui_logarithmic(ui);
    let coat = coat.map(|change| {
        change.map(|coat| HeldTool {
            coat: coat as f32,
            ..hand.clone()
        })
    });
    size.or(coat)
}

/// The switches of the mirror images of a tool.
pub(super) fn mirrors_ui(ui: &mut Ui, mirror: &mut [bool; 3]) {
    widget::row(ui, |ui| {
        widget::row_label(ui, w().mirrors, w().mirror_hint);
        for (axis, name) in ["X", "Y", "Z"].into_iter().enumerate() {
            let named = fill(w().mirror, &[&name.to_lowercase()]);
            let response = ui.checkbox(&mut mirror[axis], name).named(&named);
            response.on_hover_text(w().mirror_hint);
        }
    });
}
