//! The rows of the selected template for the tools of a sweep: shape, sizes, coating, the keys of the path.

use egui::{Label, RichText, Ui};
use glam::Vec3;

use crate::app::kit::entry::{rotation_row, vec3};
use crate::app::kit::icon::Icon;
use crate::app::kit::theme::Palette;
use crate::app::kit::widget::{self, Change, Named as _, NumberRow};
use crate::app::session::Command;
use crate::app::words::sweep::w;
use crate::app::words::{fill, names};
use crate::displace::{COAT, FARTHEST, LONG, LONGEST, ROUND, SCALE, SOLID};
use crate::document::{
    Edit, MAX_KEYS, MAX_TOOLS, PathKey, PlacedTemplate, SweepTool, SweepTools, TemplateData,
    ToolShape,
};
use crate::placed::joined_sweep;

/// The tools, one under the other, and the planes in which they are mirrored.
pub(crate) fn ui(ui: &mut Ui, template: &PlacedTemplate, commands: &mut Vec<Command>) {
    let TemplateData::Tools(held) = &template.data else {
        return;
    };
    let mut changed: Option<Change<SweepTools>> = None;
    let with = |change: &dyn Fn(&mut SweepTools)| {
        let mut new = held.clone();
        change(&mut new);
        new
    };
    widget::row(ui, |ui| {
        widget::row_label(ui, w().mirror, w().mirror_hint);
        for (axis, letter) in ["x", "y", "z"].into_iter().enumerate() {
            let mut is_on = held.mirror[axis];
            let name = fill(w().mirror_axis, &[&letter]);
            if ui.checkbox(&mut is_on, letter).named(name).changed() {
                changed = Some(Change::Set(with(&|new| new.mirror[axis] = is_on)));
            }
        }
    });
    widget::row(ui, |ui| {
        widget::row_label(ui, w().tools, w().tools_hint);
        let has_room = held.tools.len() < MAX_TOOLS;
        if widget::icon_button(ui, Icon::Plus, w().add, has_room).clicked() {
            let new = |new: &mut SweepTools| {
                new.tools.push(SweepTool {
                    index: usize::MAX,
                    ..SweepTool::default()
                });
            };
            changed = Some(Change::Set(with(&new)));
        }
    });
    for (i, tool) in held.tools.iter().enumerate() {
        let edited = ui.push_id(("tool", i), |ui| tool_ui(ui, i + 1, tool));
        match edited.inner {
            Edited::No => {}
            Edited::Gone => {
                changed = Some(Change::Set(with(&|new| {
                    new.tools.remove(i);
                })));
            }
            Edited::To(change) => {
                changed = Some(change.map(|tool| with(&|new| new.tools[i] = tool.clone())));
            }
        }
    }
    if let Some(change) = changed {
        let template = template.index;
        commands.push(widget::command(
            change.map(|tools| Edit::SetTools { template, tools }),
        ));
    }
}

/// Offers to put the tools of a sweep into the one before it.
pub(crate) fn join_ui(
    ui: &mut Ui,
    templates: &[PlacedTemplate],
    index: usize,
    commands: &mut Vec<Command>,
) {
    let Some((template, tools)) = joined_sweep(templates, index) else {
        return;
    };
    let name = fill(w().join, &[&(template + 1)]);
    if ui.button(name).on_hover_text(w().join_hint).clicked() {
        let edits = vec![
            Edit::SetTools { template, tools },
            Edit::RemoveTemplate { template: index },
        ];
        commands.push(Command::Select(Some(template)));
        commands.push(Command::Apply(Edit::All {
            name: "Join sweeps".to_owned(),
            edits,
        }));
    }
}

/// What came of the rows of a tool.
enum Edited {
    No,
    Gone,
    To(Change<SweepTool>),
}

/// The rows of one tool; `number` counts from 1.
fn tool_ui(ui: &mut Ui, number: usize, tool: &SweepTool) -> Edited {
    let mut edited = Edited::No;
    let name = fill(w().tool, &[&number]);
    widget::row(ui, |ui| {
        widget::row_label(ui, &name, w().shape_hint);
        let title = tool.shape.as_ref().map_or("", names::tool_shape);
        let combo = widget::combo("shape of tool", title, ui.available_width() - 34.0);
        let shown = combo.show_ui(ui, |ui| {
            for shape in ToolShape::NAMES.into_iter().filter_map(ToolShape::named) {
                let is_chosen = tool.shape.as_ref().map(ToolShape::name) == Some(shape.name());
                if ui
                    .selectable_label(is_chosen, names::tool_shape(&shape))
                    .clicked()
                    && !is_chosen
                {
                    let mut new = tool.clone();
                    new.shape = Some(shape);
                    edited = Edited::To(Change::Set(new));
                }
            }
        });
        shown
            .response
            .named(name.as_str())
            .on_hover_text(w().shape_hint);
        let remove = fill(w().remove, &[&number]);
        if widget::icon_button(ui, Icon::Trash, &remove, true).clicked() {
            edited = Edited::Gone;
        }
    });
    let Some(shape) = &tool.shape else {
        let weak = Palette::get(ui).weak;
        ui.add(Label::new(RichText::new(w().unknown).color(weak)).wrap());
        return edited;
    };
    if let Some(change) = shape_ui(ui, shape) {
        edited = Edited::To(change.map(|shape| SweepTool {
            shape: Some(shape),
            ..tool.clone()
        }));
    }
    let coat = length_row(ui, (w().coat, w().coat_hint), tool.coat, COAT);
    if let Some(change) = coat {
        edited = Edited::To(change.map(|coat| SweepTool {
            coat,
            ..tool.clone()
        }));
    }
    if let Some(new) = path_ui(ui, number, tool) {
        edited = Edited::To(new);
    }
    edited
}

/// The keys of a tool's path.
fn path_ui(ui: &mut Ui, number: usize, tool: &SweepTool) -> Option<Change<SweepTool>> {
    let mut changed = None;
    let with = |change: &dyn Fn(&mut SweepTool)| {
        let mut new = tool.clone();
        change(&mut new);
        new
    };
    widget::row(ui, |ui| {
        widget::row_label(ui, w().smooth, w().smooth_hint);
        let mut spline = tool.spline;
        let response = ui.checkbox(&mut spline, "").named(w().smooth);
        if response.on_hover_text(w().smooth_hint).changed() {
            changed = Some(Change::Set(with(&|new| new.spline = spline)));
        }
        let has_room = tool.path.len() < MAX_KEYS;
        let add = fill(w().key_add, &[&number]);
        if widget::icon_button(ui, Icon::Plus, &add, has_room).clicked() {
            changed = Some(Change::Set(with(&|new| {
                new.path.push(next_key(&tool.path))
            })));
        }
    });
    for (i, key) in tool.path.iter().enumerate() {
        let name = fill(w().key, &[&(i + 1)]);
        let set = |change: Change<PathKey>| Some(change.map(|key| with(&|new| new.path[i] = key)));
        ui.push_id(("key", i), |ui| {
            let at = key.at.to_array().map(f64::from);
            let range = [-FARTHEST, FARTHEST].map(f64::from);
            if let Some(change) = widget::vector_row(ui, &name, w().key_hint, at, range, "", 3) {
                changed = set(change.map(|at| PathKey {
                    at: vec3(at),
                    ..*key
                }));
            }
            if let Some(change) = rotation_row(ui, w().turn, w().turn_hint, key.rotate) {
                changed = set(change.map(|rotate| PathKey { rotate, ..*key }));
            }
            let scale = NumberRow {
                name: w().scale,
                summary: w().scale_hint,
                value: f64::from(key.scale),
                default: Some(1.0),
                range: SCALE,
                unit: "",
                decimals: 2,
            };
            if let Some(change) = scale.ui_logarithmic(ui) {
                changed = set(change.map(|scale| PathKey {
                    scale: scale as f32,
                    ..*key
                }));
            }
            let remove = fill(w().key_remove, &[&(i + 1), &number]);
            let is_last = tool.path.len() == 1;
            if !is_last && widget::icon_button(ui, Icon::Trash, &remove, true).clicked() {
                changed = Some(Change::Set(with(&|new| {
                    new.path.remove(i);
                })));
            }
        });
    }
    changed
}

/// A key that goes on the way of the last two, half as far.
fn next_key(path: &[PathKey]) -> PathKey {
    match path {
        [.., before, last] => PathKey {
            at: last.at + 0.5 * (last.at - before.at),
            ..*last
        },
        [only] => PathKey {
            at: only.at + Vec3::new(0.0, 0.0, -0.25),
            ..*only
        },
        [] => PathKey::PRESS[0],
    }
}

/// The numbers of a shape.
fn shape_ui(ui: &mut Ui, shape: &ToolShape) -> Option<Change<ToolShape>> {
    let w = w();
    let hint = w.size_hint;
    let names: &[(&str, [f64; 2])] = match shape {
        ToolShape::Ball { .. } => &[(w.radius, SOLID)],
        ToolShape::Ellipsoid { radii } => return axes_row(ui, w.radii, *radii, shape),
        ToolShape::Capsule { .. } => &[(w.radius, ROUND), (w.length, LONG)],
        ToolShape::Box { half, round } => {
            let sides = axes_row(ui, w.half, *half, shape);
            let most = f64::from(half.min_element());
            let change = length_row(ui, (w.round, hint), *round, [0.0, most]);
            let half = *half;
            let rounded = change.map(|c| c.map(|round| ToolShape::Box { half, round }));
            return sides.or(rounded);
        }
        ToolShape::Torus { .. } => &[(w.ring, SOLID), (w.radius, ROUND)],
        ToolShape::Mesh { .. } | ToolShape::Clay { .. } => &[(w.longest, LONGEST)],
        ToolShape::Curve { points, radius } => {
            let change = length_row(ui, (w.radius, hint), *radius, ROUND)?;
            let points = points.clone();
            return Some(change.map(|radius| ToolShape::Curve { points, radius }));
        }
    };
    let mut changed = None;
    for (i, ((name, range), value)) in names.iter().zip(shape.numbers()).enumerate() {
        if let Some(change) = length_row(ui, (name, hint), value, *range) {
            changed = Some(change.map(|value| {
                let mut new = shape.clone();
                if let Some(number) = new.numbers_mut().into_iter().nth(i) {
                    *number = value;
                }
                new
            }));
        }
    }
    changed
}

/// The three lengths of an ellipsoid or a box.
fn axes_row(ui: &mut Ui, name: &str, value: Vec3, shape: &ToolShape) -> Option<Change<ToolShape>> {
    let shown = value.to_array().map(f64::from);
    let change = widget::vector_row(ui, name, w().size_hint, shown, SOLID, "", 3)?;
    Some(change.map(|value| match shape {
        ToolShape::Box { round, .. } => ToolShape::Box {
            half: vec3(value),
            round: round.min(vec3(value).min_element()),
        },
        _ => ToolShape::Ellipsoid { radii: vec3(value) },
    }))
}

/// A length as a part of the shortest side of the box.
fn length_row(
    ui: &mut Ui,
    (name, summary): (&str, &str),
    value: f32,
    range: [f64; 2],
) -> Option<Change<f32>> {
    let row = NumberRow {
        name,
        summary,
        value: f64::from(value),
        default: None,
        range,
        unit: "",
        decimals: 3,
    };
    let change = row.ui_logarithmic(ui)?;
    Some(change.map(|value| value as f32))
}
