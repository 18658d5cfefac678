//! Rows of numbers of a figure.

use egui::Ui;

use crate::app::kit::widget::{Change, NumberRow};
use crate::math::round_to;

/// A number with its name and sentence, as it is and as it is at first. Returns it to two decimals.
pub(super) fn row(
    ui: &mut Ui,
    (name, summary): (&str, &str),
    (value, default): (f64, f64),
    range: [f64; 2],
    decimals: usize,
) -> Option<Change<f64>> {
    let row = NumberRow {
        name,
        summary,
        value,
        default: Some(default),
        range,
        unit: "",
        decimals,
    };
    Some(row.ui(ui)?.map(|value| round_to(value, 2)))
}
