//! What the tool that shapes a clay or draws a sweep is called, and the choice of its form, in the panel and over the
//! picture.

use egui::Ui;

use crate::app::session::{HeldTool, StrokeWay};
use crate::app::words::clay::w;
use crate::app::words::names;
use crate::document::ToolShape;

/// What a way to drag is called, and what it does in one sentence.
pub(crate) fn way_title(way: StrokeWay) -> (&'static str, &'static str) {
    let w = w();
    match way {
        StrokeWay::Move => (w.r#move, w.move_hint),
        StrokeWay::Push | StrokeWay::PushOver => (w.push, w.push_hint),
        StrokeWay::Along => (w.along, w.along_hint),
        StrokeWay::Turn => (w.turn, w.turn_hint),
        StrokeWay::TurnInView => (w.turn_in_view, w.turn_in_view_hint),
        StrokeWay::Grow => (w.grow, w.grow_hint),
        StrokeWay::Smooth => (w.smooth, w.smooth_hint),
        StrokeWay::Place => (w.place, w.place_hint),
        StrokeWay::Form => (w.draw_form, w.draw_form_hint),
    }
}

/// What the form in the hand is called.
pub(crate) fn held_title(hand: &HeldTool) -> String {
    match &hand.own {
        Some(own) => own_title(own),
        None => form_title(hand.form).to_owned(),
    }
}

/// What a drawn curve is called, a mesh, or the clay after some of its strokes, as a tool.
pub(crate) fn own_title(shape: &ToolShape) -> String {
    let kind = names::tool_shape(shape);
    match shape {
        ToolShape::Mesh { file, .. } => {
            let named = (!file.name.is_empty()).then_some(&file.name);
            named
                .or(file.src.as_ref())
                .cloned()
                .unwrap_or_else(|| kind.to_owned())
        }
        ToolShape::Clay { strokes, .. } => format!("{kind} ({strokes})"),
        ToolShape::Curve { points, .. } => format!("{kind} ({})", points.len()),
        _ => kind.to_owned(),
    }
}

/// The drawn curves, meshes and baked clays among some shapes, each form once.
pub(crate) fn own_forms<'a>(shapes: impl Iterator<Item = &'a ToolShape>) -> Vec<&'a ToolShape> {
    let mut own: Vec<&ToolShape> = Vec::new();
    for shape in shapes {
        let is_known = |known: &&ToolShape| known.has_form_of(shape);
        if !HeldTool::has_plain_form(shape) && !own.iter().any(is_known) {
            own.push(shape);
        }
    }
    own
}

/// The entries of a list of forms: the plain ones, then some of a document's own. Gives the hand with the one chosen.
pub(crate) fn forms_ui(ui: &mut Ui, hand: &HeldTool, own: &[&ToolShape]) -> Option<HeldTool> {
    let mut chosen = None;
    let plain = (0..HeldTool::FORMS.len()).map(|form| (form, None));
    let own = own.iter().map(|shape| (hand.form, Some(*shape)));
    for (form, own) in plain.chain(own) {
        let is_held = match (own, &hand.own) {
            (None, None) => form == hand.form,
            (None, Some(held)) => HeldTool::FORMS[form] == held.name(),
            (Some(one), Some(held)) => held.has_form_of(one),
            (Some(_), None) => false,
        };
        let title = match own {
            None => form_title(form).to_owned(),
            Some(shape) => own_title(shape),
        };
        if ui.selectable_label(is_held, title).clicked() && !is_held {
            let own = own.cloned();
            let hand = hand.clone();
            chosen = Some(HeldTool { form, own, ..hand });
        }
    }
    chosen
}

/// What the form of this index in [`HeldTool::FORMS`] is called.
pub(crate) fn form_title(form: usize) -> &'static str {
    let name = HeldTool::FORMS.get(form).copied().unwrap_or_default();
    ToolShape::named(name).map_or("", |shape| names::tool_shape(&shape))
}
