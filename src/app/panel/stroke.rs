//! The rows of the selected stroke of a clay: form, size and coating of each of its tools, and their mirror images.

use egui::{Label, RichText, Ui};

use super::hand::{lengths_ui, mirrors_ui};
use crate::app::kit::clay_tool::{forms_ui, held_title, own_forms};
use crate::app::kit::theme::Palette;
use crate::app::kit::widget::{self, Change, Named as _};
use crate::app::session::{ClayCommand, Command, HeldTool, StrokeChange};
use crate::app::words::clay::w;
use crate::app::words::{fill, sweep};
use crate::document::{Clay, ClayStroke};

/// The rows of a stroke, by its index.
pub(super) fn ui(
    ui: &mut Ui,
    clay: &Clay,
    (index, stroke): (usize, &ClayStroke),
    commands: &mut Vec<Command>,
) {
    let mut change = |change: Change<StrokeChange>| {
        let (change, is_drag) = match change {
            Change::Drag(change) => (change, true),
            Change::Set(change) => (change, false),
        };
        commands.push(Command::Clay(ClayCommand::Change {
            stroke: index,
            change,
            is_drag,
        }));
    };
    for (way, one) in stroke.moves.iter().enumerate() {
        let hand = clay.tools.get(one.tool).and_then(HeldTool::with_tool);
        let Some(hand) = hand else {
            let text = RichText::new(sweep::w().unknown);
            ui.add(Label::new(text.small().color(Palette::get(ui).weak)).wrap());
            continue;
        };
        let changed = ui.push_id(("tool", way), |ui| {
            let form = form_ui(ui, clay, (index, way), &hand);
            let hints = [w().stroke_size_hint, w().stroke_coat_hint];
            form.map(Change::Set).or(lengths_ui(ui, &hand, hints))
        });
        if let Some(hand) = changed.inner {
            change(hand.map(|hand| StrokeChange::Tool(way, hand.tool())));
        }
    }
    let mut mirror = stroke.mirror;
    mirrors_ui(ui, &mut mirror);
    if mirror != stroke.mirror {
        change(Change::Set(StrokeChange::Mirror(mirror)));
    }
}

/// The form of the tool of a way. What is baked is offered to strokes that come after those it is made of.
fn form_ui(
    ui: &mut Ui,
    clay: &Clay,
    (index, way): (usize, usize),
    hand: &HeldTool,
) -> Option<HeldTool> {
    let made = clay.tools.iter().filter(|tool| tool.is_made_before(index));
    let own = own_forms(made.filter_map(|tool| tool.shape.as_ref()));
    let name = fill(sweep::w().tool, &[&(way + 1)]);
    widget::row(ui, |ui| {
        widget::row_label(ui, &name, w().form);
        let combo = widget::combo("form of a tool", &held_title(hand), ui.available_width());
        let shown = combo.show_ui(ui, |ui| forms_ui(ui, hand, &own));
        shown.response.named(name.as_str()).on_hover_text(w().form);
        shown.inner.flatten()
    })
}
