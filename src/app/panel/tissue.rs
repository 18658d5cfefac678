//! Tissues: the segments that the subject came with and those made here, by a range of values or by growing from
//! points, then cleaned up. Each can be shown alone; those made here are edited in place, and the picture shows
//! the result as soon as it is found.

use egui::{Color32, Label, RichText, Sense, Stroke, TextEdit, Ui, vec2};
use serde_json::Value;

use crate::app::kit::icon::Icon;
use crate::app::kit::theme::{Palette, control_height};
use crate::app::kit::widget::{self, Change, NumberRow};
use crate::app::session::tissues::{with_range, with_seeds};
use crate::app::session::{Command, Session, TissueCommand, Tool};
use crate::app::words::kept::segment;
use crate::app::words::tissue::w;
use crate::app::words::{fill, in_sentence};
use crate::data::{RECIPE_COLORS_SRGB, Segment};
use crate::document::{
    Align, CleanStep, Constrain, Edit, MAX_RECIPES, MAX_SMOOTH_MM, PlacedTemplate, Recipe,
    RecipeSource, SegmentLook, color_text, pointer,
};
use crate::render::SubjectInfo;
use glam::Vec3;

/// Rows before the list scrolls.
const LISTED: usize = 9;
/// The largest lengths that sliders offer, mm; a document may hold larger ones.
const MOST_CLOSE_MM: f64 = 10.0;
const MOST_GROW_MM: f64 = 10.0;
/// Where dense bone begins in Hounsfield units; its spongy parts are closed in by it.
const BONE_FROM: f32 = 180.0;

/// Each segment once: labels that stand for an overlap are left out.
pub(crate) fn listed(segments: &[Segment]) -> Vec<&Segment> {
    let is_single = |label: u16| segments.iter().filter(|other| other.label == label).count() == 1;
    segments.iter().filter(|s| is_single(s.label)).collect()
}

/// The panel. `segments` are those shown at this moment.
pub(crate) fn ui(
    ui: &mut Ui,
    session: &Session,
    segments: &[Segment],
    info: Option<&SubjectInfo>,
    commands: &mut Vec<Command>,
) {
    let recipes = &session.illustration().recipes;
    // Recipes find tissue by values.
    let has_values = session.view.has_values();
    let can_add = info.is_some() && recipes.len() < MAX_RECIPES;
    widget::heading(ui, w().heading, |ui| {
        if session.tissues.alone.is_some()
            && widget::icon_button(ui, Icon::Reset, w().all, true).clicked()
        {
            commands.push(Command::Tissue(TissueCommand::Alone(None)));
        }
    });
    let listed = listed(segments);
    let weak = Palette::get(ui).weak;
    if listed.is_empty() && recipes.is_empty() {
        ui.add(Label::new(RichText::new(w().none).color(weak)).wrap());
    }
    let mut rows = |ui: &mut Ui| {
        // A segment that a recipe is being run for has a row already.
        for recipe in recipes {
            let color = RECIPE_COLORS_SRGB[recipe.index % RECIPE_COLORS_SRGB.len()];
            let color = recipe.color_srgb.unwrap_or(color);
            row_ui(ui, session, &recipe.name, color, Some(recipe), commands);
        }
        let is_recipe = |s: &&&Segment| recipes.iter().all(|recipe| recipe.name != s.name);
        for entry in listed.iter().filter(is_recipe) {
            let color = entry.color_srgb.unwrap_or([160; 3]);
            row_ui(ui, session, &entry.name, color, None, commands);
        }
    };
    if listed.len().max(recipes.len()) <= LISTED {
        rows(ui);
    } else {
        egui::ScrollArea::vertical()
            .id_salt("tissues")
            .max_height(LISTED as f32 * (control_height() + 4.0))
            .auto_shrink([false, true])
            .show(ui, rows);
    }
    let open = session.tissues.open;
    if let Some(recipe) = recipes.iter().find(|recipe| open == Some(recipe.index)) {
        widget::divider(ui);
        ui.push_id(("tissue", recipe.index), |ui| {
            recipe_ui(ui, session, recipe, info, commands);
        });
    }
    if has_values {
        ui.add_space(4.0);
        let add = widget::labelled_button(ui, Icon::Plus, w().add, false, can_add);
        if add.on_hover_text(w().add_hint).clicked()
            && let Some(info) = info
        {
            add_recipe(session, info, commands);
        }
    }
    if let Some(fraction) = session.tissues.progress {
        let bar = egui::ProgressBar::new(fraction).desired_height(4.0);
        ui.add(bar).on_hover_text(w().working);
    }
}

fn add_recipe(session: &Session, info: &SubjectInfo, commands: &mut Vec<Command>) {
    let recipes = &session.illustration().recipes;
    let has = |name: &str| recipes.iter().any(|recipe| recipe.name == name);
    let (mut name, range) = if info.is_ct {
        let low = info.hounsfield_offset + BONE_FROM;
        ("bone".to_owned(), [low, f32::MAX])
    } else {
        let [low, high] = info.window_auto;
        (String::new(), [0.5 * (low + high), f32::MAX])
    };
    let mut number = recipes.len() + 1;
    while name.is_empty() || has(&name) {
        name = fill(w().tissue_n, &[&number]);
        number += 1;
    }
    let recipe = Recipe {
        index: recipes.len(),
        name: name.clone(),
        color_srgb: None,
        from: RecipeSource::Threshold { range },
        clean: vec![
            CleanStep::Close(2.0),
            CleanStep::Largest(1),
            CleanStep::Fill,
        ],
    };
    let mut list = recipes_of(session);
    let index = list.len();
    list.push(recipe.to_value());
    commands.push(Command::Apply(Edit::Set {
        pointer: "/subject/features".to_owned(),
        value: Value::from(list),
        name: format!("Make {name}"),
    }));
    commands.push(Command::Tissue(TissueCommand::Open(Some(index))));
    commands.push(Command::Tissue(TissueCommand::Alone(Some(name))));
}

/// The recipes as the document has them, unknown ones too.
fn recipes_of(session: &Session) -> Vec<Value> {
    let list = session.document().get("/subject/features");
    list.and_then(Value::as_array).cloned().unwrap_or_default()
}

fn row_ui(
    ui: &mut Ui,
    session: &Session,
    name: &str,
    [r, g, b]: [u8; 3],
    recipe: Option<&Recipe>,
    commands: &mut Vec<Command>,
) {
    let title = segment(name);
    let in_text = in_sentence(&title);
    let is_alone = session.tissues.alone.as_deref() == Some(name);
    let is_open = recipe.is_some_and(|recipe| session.tissues.open == Some(recipe.index));
    let look = look_of(session, name);
    let own = Color32::from_rgb(r, g, b);
    widget::row(ui, |ui| {
        let is_edited = session.tissues.look.as_deref() == Some(name);
        if swatch_ui(ui, own, look, is_edited, &fill(w().look, &[&in_text])).clicked() {
            let look = (!is_edited).then(|| name.to_owned());
            commands.push(Command::Tissue(TissueCommand::Look(look)));
        }
        ui.with_layout(widget::against(), |ui| {
            ui.spacing_mut().item_spacing.x = 2.0;
            if let Some(recipe) = recipe {
                let text = fill(w().remove, &[&in_text]);
                if widget::icon_button(ui, Icon::Trash, &text, true).clicked() {
                    let mut list = recipes_of(session);
                    if recipe.index < list.len() {
                        list.remove(recipe.index);
                    }
                    commands.push(Command::Tissue(TissueCommand::Open(None)));
                    if is_alone {
                        commands.push(Command::Tissue(TissueCommand::Alone(None)));
                    }
                    let mut edits = vec![Edit::Set {
                        pointer: "/subject/features".to_owned(),
                        value: Value::from(list),
                        name: String::new(),
                    }];
                    if look.is_some() {
                        edits.push(set_look(name, None));
                    }
                    commands.push(Command::Apply(Edit::All {
                        name: format!("Remove {name}"),
                        edits,
                    }));
                }
            }
            let (text, alone) = match is_alone {
                true => (w().all.to_owned(), None),
                false => (fill(w().alone, &[&in_text]), Some(name.to_owned())),
            };
            let side = control_height();
            if widget::icon_button_sized(ui, Icon::Eye, &text, true, is_alone, side).clicked() {
                commands.push(Command::Tissue(TissueCommand::Alone(alone)));
            }
            if let Some(recipe) = recipe {
                let text = fill(w().edit, &[&in_text]);
                if widget::icon_button_sized(ui, Icon::More, &text, true, is_open, side).clicked() {
                    let open = (!is_open).then_some(recipe.index);
                    commands.push(Command::Tissue(TissueCommand::Open(open)));
                }
            }
            ui.with_layout(widget::along(), |ui| {
                let mut text = RichText::new(&title);
                if is_open {
                    text = text.color(Palette::get(ui).accent);
                }
                ui.add(Label::new(text).truncate());
            });
        });
    });
    if session.tissues.look.as_deref() == Some(name) {
        ui.push_id(("look", name), |ui| {
            look_ui(ui, name, [r, g, b], look, commands)
        });
    }
}

fn look_of<'a>(session: &'a Session, name: &str) -> Option<&'a SegmentLook> {
    let mut looks = session.illustration().look.segments.iter();
    looks.find(|look| look.name == name)
}

/// The edit that draws a tissue with this opacity and colour, or (`None`) by the transfer function.
fn set_look(tissue: &str, look: Option<(f32, Option<[u8; 3]>)>) -> Edit {
    let pointer = pointer::join("/look/segments", tissue);
    let name = format!("Draw {tissue}");
    match look {
        None => Edit::Reset { pointer, name },
        Some((opacity, color)) => {
            let opacity = Value::from((f64::from(opacity) * 100.0).round() / 100.0);
            let value = match color {
                None => opacity,
                Some(color) => {
                    serde_json::json!({ "opacity": opacity, "color": color_text(color) })
                }
            };
            Edit::Set {
                pointer,
                value,
                name,
            }
        }
    }
}

/// The color of a tissue, as a button: filled where it is drawn in it, struck out where it is hidden.
fn swatch_ui(
    ui: &mut Ui,
    own: Color32,
    look: Option<&SegmentLook>,
    is_edited: bool,
    name: &str,
) -> egui::Response {
    let palette = Palette::get(ui);
    let size = egui::Vec2::splat(control_height());
    let (rect, response) = ui.allocate_exact_size(size, Sense::click());
    response.widget_info(|| {
        egui::WidgetInfo::selected(egui::Role::Button, ui.is_enabled(), is_edited, name)
    });
    let swatch = egui::Rect::from_center_size(rect.center(), vec2(16.0, 16.0));
    let [color, line] = match look {
        Some(look) if look.opacity <= 0.0 => [Color32::TRANSPARENT, palette.weak],
        Some(look) => {
            let color = look
                .color_srgb
                .map_or(own, |[r, g, b]| Color32::from_rgb(r, g, b));
            [
                color.gamma_multiply(0.35 + 0.65 * look.opacity),
                palette.text,
            ]
        }
        None => [own, palette.line],
    };
    let width = if is_edited || response.hovered() {
        2.0
    } else {
        1.0
    };
    let line = if is_edited { palette.accent } else { line };
    let line = Stroke::new(width, line);
    ui.painter()
        .rect(swatch, 3.0, color, line, egui::StrokeKind::Inside);
    if look.is_some_and(|look| look.opacity <= 0.0) {
        ui.painter()
            .line_segment([swatch.left_bottom(), swatch.right_top()], line);
    }
    widget::focus_ring(ui, &response, rect);
    response.on_hover_text(name)
}

#[derive(Clone, Copy, PartialEq)]
enum Drawn {
    Scan,
    Body,
    Hidden,
}

/// How one tissue is drawn: by the transfer function, as a body in its own colour, or not at all.
fn look_ui(
    ui: &mut Ui,
    name: &str,
    own: [u8; 3],
    look: Option<&SegmentLook>,
    commands: &mut Vec<Command>,
) {
    let current = match look {
        None => Drawn::Scan,
        Some(look) if look.opacity <= 0.0 => Drawn::Hidden,
        Some(_) => Drawn::Body,
    };
    let color = look.and_then(|look| look.color_srgb);
    let options = [
        (Drawn::Scan, w().as_scan),
        (Drawn::Body, w().body),
        (Drawn::Hidden, w().hidden),
    ];
    if let Some(drawn) = widget::segmented(ui, w().drawn, &options, current) {
        let look = match drawn {
            Drawn::Scan => None,
            Drawn::Body => Some((1.0, color)),
            Drawn::Hidden => Some((0.0, color)),
        };
        commands.push(Command::Apply(set_look(name, look)));
    }
    let Some(look) = look.filter(|_| current == Drawn::Body) else {
        return;
    };
    let row = NumberRow {
        name: w().opacity,
        summary: w().opacity_hint,
        value: f64::from(look.opacity) * 100.0,
        default: Some(100.0),
        range: [1.0, 100.0],
        unit: " %",
        decimals: 0,
    };
    if let Some(change) = row.ui(ui) {
        let edit = change.map(|percent| set_look(name, Some((percent as f32 / 100.0, color))));
        commands.push(widget::command(edit));
    }
    widget::row(ui, |ui| {
        widget::row_label(ui, w().color, "");
        let mut shown = color.unwrap_or(own);
        let button = ui
            .color_edit_button_srgb(&mut shown)
            .accessible_name(w().color);
        if button.changed() {
            let edit = set_look(name, Some((look.opacity, Some(shown))));
            commands.push(Command::Drag(edit));
        }
        let reset = widget::icon_button(ui, Icon::Reset, w().own_color, color.is_some());
        if reset.clicked() {
            let edit = set_look(name, Some((look.opacity, None)));
            commands.push(Command::Apply(edit));
        }
    });
}

/// A change of the recipe, as one step of undo or a part of a drag.
fn set(recipe: &Recipe, change: Change<Recipe>, commands: &mut Vec<Command>) {
    let edit = change.map(|new| Edit::Set {
        pointer: format!("/subject/features/{}", recipe.index),
        value: new.to_value(),
        name: format!("Change {}", recipe.name),
    });
    commands.push(widget::command(edit));
}

fn recipe_ui(
    ui: &mut Ui,
    session: &Session,
    recipe: &Recipe,
    info: Option<&SubjectInfo>,
    commands: &mut Vec<Command>,
) {
    name_ui(ui, session, recipe, commands);
    let is_grown = matches!(recipe.from, RecipeSource::Grow { .. });
    let options = [(false, w().values), (true, w().points)];
    if let Some(grows) = widget::segmented(ui, w().from, &options, is_grown) {
        let range = recipe.from.range();
        let seeds = Vec::new();
        let from = match grows {
            true => RecipeSource::Grow { seeds, range },
            false => RecipeSource::Threshold { range },
        };
        let new = Recipe {
            from,
            ..recipe.clone()
        };
        set(recipe, Change::Set(new), commands);
        commands.push(Command::Tissue(TissueCommand::Seed(grows)));
    }
    range_ui(ui, recipe, info, commands);
    if let RecipeSource::Grow { seeds, .. } = &recipe.from {
        seeds_ui(ui, session, recipe, seeds, commands);
    }
    clean_ui(ui, recipe, commands);
    let voxel_cm3 = session.view.subject.as_ref().and_then(|s| s.voxel_cm3);
    if let (Some(&count), Some(voxel_cm3)) = (
        session.tissues.counts.get(position(session, recipe)),
        voxel_cm3,
    ) {
        let text = if count == 0 {
            w().nothing.to_owned()
        } else {
            let volume = count as f64 * voxel_cm3;
            let decimals = if volume < 10.0 { 2 } else { 0 };
            fill(w().volume, &[&widget::plain(volume, decimals)])
        };
        let weak = Palette::get(ui).weak;
        ui.label(RichText::new(text).small().color(weak));
    }
}

/// Place of a recipe among those that are known.
fn position(session: &Session, recipe: &Recipe) -> usize {
    let all = &session.illustration().recipes;
    all.iter().take_while(|r| r.index < recipe.index).count()
}

fn name_ui(ui: &mut Ui, session: &Session, recipe: &Recipe, commands: &mut Vec<Command>) {
    widget::row(ui, |ui| {
        let label = widget::row_label(ui, w().name, "");
        let mut name = recipe.name.clone();
        let field = TextEdit::singleline(&mut name).desired_width(f32::INFINITY);
        let field = ui.add(field).labelled_by(label.id);
        if field.changed() && !name.trim().is_empty() {
            let new = Recipe {
                name: name.clone(),
                ..recipe.clone()
            };
            let mut edits = vec![Edit::Set {
                pointer: format!("/subject/features/{}", recipe.index),
                value: new.to_value(),
                name: String::new(),
            }];
            // What keeps it goes on keeping it.
            edits.extend(renamed(
                &session.illustration().templates,
                &recipe.name,
                &name,
            ));
            if let Some(look) = look_of(session, &recipe.name) {
                edits.push(set_look(&recipe.name, None));
                edits.push(set_look(&name, Some((look.opacity, look.color_srgb))));
            }
            commands.push(Command::Drag(Edit::All {
                name: format!("Rename {}", recipe.name),
                edits,
            }));
            if session.tissues.alone.as_ref() == Some(&recipe.name) {
                commands.push(Command::Tissue(TissueCommand::Alone(Some(name))));
            }
        }
    });
}

/// Edits that let templates mean a tissue by its new name.
fn renamed(templates: &[PlacedTemplate], from: &str, to: &str) -> Vec<Edit> {
    let change = |keep: &[String]| -> Option<Vec<String>> {
        let has = keep.iter().any(|name| name == from);
        let new = |name: &String| if name == from { to } else { name }.to_owned();
        has.then(|| keep.iter().map(new).collect())
    };
    let mut edits = Vec::new();
    for template in templates {
        let index = template.index;
        if let Align::Segment { keep, thickness } = &template.align
            && let Some(keep) = change(keep)
        {
            edits.push(Edit::SetAlign {
                template: index,
                align: Align::Segment {
                    keep,
                    thickness: *thickness,
                },
            });
        }
        if let Some(Constrain { by, keep }) = &template.constrain
            && let Some(keep) = change(keep)
        {
            edits.push(Edit::SetConstrain {
                template: index,
                constrain: Some(Constrain { by: *by, keep }),
            });
        }
    }
    edits
}

fn range_ui(ui: &mut Ui, recipe: &Recipe, info: Option<&SubjectInfo>, commands: &mut Vec<Command>) {
    let [low, high] = recipe.from.range();
    let [min, max] = info.map_or([low, high], |info| info.value_range);
    let shown_high = high.min(max);
    let decimals = if max - min > 50.0 { 0 } else { 3 };
    let row = |name: &'static str, summary: &'static str, value: f32| NumberRow {
        name,
        summary,
        value: f64::from(value),
        default: None,
        range: [f64::from(min.min(low)), f64::from(max)],
        unit: "",
        decimals,
    };
    if let Some(change) = row(w().lowest, w().lowest_hint, low.min(max)).ui(ui) {
        let change = change.map(|v| with_range(recipe, [v as f32, high.max(v as f32)]));
        set(recipe, change, commands);
    }
    if let Some(change) = row(w().highest, w().highest_hint, shown_high).ui(ui) {
        // At the end of the scale there is no end.
        let end = |v: f64| if v as f32 >= max { f32::MAX } else { v as f32 };
        let change = change.map(|v| with_range(recipe, [low.min(v as f32), end(v)]));
        set(recipe, change, commands);
    }
}

fn seeds_ui(
    ui: &mut Ui,
    session: &Session,
    recipe: &Recipe,
    seeds: &[Vec3],
    commands: &mut Vec<Command>,
) {
    let is_on = session.tool() == Tool::Seed(recipe.index);
    widget::row(ui, |ui| {
        let mut is_checked = is_on;
        let check = ui.checkbox(&mut is_checked, w().click);
        if check.on_hover_text(w().click_hint).changed() {
            commands.push(Command::Tissue(TissueCommand::Seed(is_checked)));
        }
    });
    widget::row(ui, |ui| {
        let read = session.view.cross_read;
        let button = ui.add_enabled(read.is_some(), egui::Button::new(w().from_cross));
        if button.clicked()
            && let Some((pos, value)) = read
        {
            commands.push(Command::AddSeed(pos, value));
        }
        ui.label(fill(w().seeds, &[&seeds.len()]));
        if !seeds.is_empty() && widget::icon_button(ui, Icon::Trash, w().clear, true).clicked() {
            set(
                recipe,
                Change::Set(with_seeds(recipe, Vec::new())),
                commands,
            );
        }
    });
}

/// The clean-up that the panel knows, in its order; `None` where the author's steps are others.
fn as_panel(clean: &[CleanStep]) -> Option<(f32, u32, bool, f32, f32)> {
    let mut panel = (0.0, 0, false, 0.0, 0.0);
    let mut last = 0;
    for step in clean {
        let place = match *step {
            CleanStep::Close(mm) => {
                panel.0 = mm;
                1
            }
            CleanStep::Largest(count) => {
                panel.1 = count;
                2
            }
            CleanStep::Fill => {
                panel.2 = true;
                3
            }
            CleanStep::Smooth(mm) => {
                panel.3 = mm;
                4
            }
            CleanStep::Grow(mm) => {
                panel.4 = mm;
                5
            }
            CleanStep::Shrink(mm) => {
                panel.4 = -mm;
                5
            }
        };
        if place <= last {
            return None;
        }
        last = place;
    }
    Some(panel)
}

fn from_panel((close, largest, fills, smooth, grow): (f32, u32, bool, f32, f32)) -> Vec<CleanStep> {
    let steps = [
        (close > 0.0).then_some(CleanStep::Close(close)),
        (largest > 0).then_some(CleanStep::Largest(largest)),
        fills.then_some(CleanStep::Fill),
        (smooth > 0.0).then_some(CleanStep::Smooth(smooth)),
        (grow > 0.0).then_some(CleanStep::Grow(grow)),
        (grow < 0.0).then_some(CleanStep::Shrink(-grow)),
    ];
    steps.into_iter().flatten().collect()
}

fn clean_ui(ui: &mut Ui, recipe: &Recipe, commands: &mut Vec<Command>) {
    let with = |panel| Recipe {
        clean: from_panel(panel),
        ..recipe.clone()
    };
    ui.add_space(4.0);
    ui.label(w().clean);
    let Some(panel) = as_panel(&recipe.clean) else {
        let text = fill(w().own_steps, &[&recipe.clean.len()]);
        ui.add(Label::new(RichText::new(text).color(Palette::get(ui).weak)).wrap());
        if widget::labelled_button(ui, Icon::Reset, w().reset, false, true).clicked() {
            let new = with((0.0, 0, false, 0.0, 0.0));
            set(recipe, Change::Set(new), commands);
        }
        return;
    };
    let (close, largest, fills, smooth, grow) = panel;
    let row = |name: &'static str, summary: &'static str, value: f32, range: [f64; 2]| NumberRow {
        name,
        summary,
        value: f64::from(value),
        default: Some(0.0),
        range: [
            range[0].min(f64::from(value)),
            range[1].max(f64::from(value)),
        ],
        unit: " mm",
        decimals: 1,
    };
    let mut change = row(w().close, w().close_hint, close, [0.0, MOST_CLOSE_MM])
        .ui(ui)
        .map(|c| c.map(|mm| (mm as f32, largest, fills, smooth, grow)));
    let parts = NumberRow {
        unit: "",
        decimals: 0,
        ..row(w().largest, w().largest_hint, largest as f32, [0.0, 10.0])
    };
    change = change.or(parts
        .ui(ui)
        .map(|c| c.map(|n| (close, n as u32, fills, smooth, grow))));
    let mut is_filled = fills;
    if ui.checkbox(&mut is_filled, w().fill).changed() {
        change = Some(Change::Set((close, largest, is_filled, smooth, grow)));
    }
    change = change.or(row(
        w().smooth,
        w().smooth_hint,
        smooth,
        [0.0, f64::from(MAX_SMOOTH_MM).min(5.0)],
    )
    .ui(ui)
    .map(|c| c.map(|mm| (close, largest, fills, mm as f32, grow))));
    change = change.or(
        row(w().grow, w().grow_hint, grow, [-MOST_GROW_MM, MOST_GROW_MM])
            .ui(ui)
            .map(|c| c.map(|mm| (close, largest, fills, smooth, mm as f32))),
    );
    if let Some(change) = change {
        set(recipe, change.map(with), commands);
    }
}
