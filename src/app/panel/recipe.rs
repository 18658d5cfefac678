//! The form of a tissue that is made here: its name, its range of values over the histogram of the scan, the points
//! that it grows from, its clean-up, and its volume.

use egui::{Label, Rect, RichText, Role, Sense, TextEdit, Ui, WidgetInfo, vec2};
use glam::Vec3;

use super::paint;
use super::transfer_plot::{Axis, paint_histogram, paint_ticks};
use crate::app::kit::icon::Icon;
use crate::app::kit::theme::Palette;
use crate::app::kit::widget::{self, Change, NumberRow};
use crate::app::session::tissues::{length_mm, with_range, with_seeds};
use crate::app::session::{Command, Session, TissueCommand, Tool};
use crate::app::words::fill;
use crate::app::words::tissue::w;
use crate::data::Histogram;
use crate::document::{CleanStep, Edit, MAX_CLEAN_MM, MAX_SMOOTH_MM, Recipe, RecipeSource};
use crate::render::SubjectInfo;

/// The largest length that sliders offer, voxels; a document may hold longer ones.
const MOST_VOXELS: f64 = 10.0;
/// Heights of the histogram and of the numbers below, points.
const HISTOGRAM: f32 = 48.0;
const TICKS: f32 = 14.0;
/// Hounsfield units of blood with contrast agent: bone that begins there takes vessels with it.
const VESSELS: std::ops::Range<f32> = 100.0..400.0;

/// A change of the recipe, as one step of undo or a part of a drag.
fn set(recipe: &Recipe, change: Change<Recipe>, commands: &mut Vec<Command>) {
    let edit = change.map(|new| Edit::Set {
        pointer: format!("/subject/features/{}", recipe.index),
        value: new.to_value(),
        name: format!("Change {}", recipe.name),
    });
    commands.push(widget::command(edit));
}

/// The form. `scan` is what is known of the values of the subject, and how often which occur.
pub(crate) fn ui(
    ui: &mut Ui,
    session: &Session,
    recipe: &Recipe,
    scan: Option<(&SubjectInfo, Option<&Histogram>)>,
    commands: &mut Vec<Command>,
) {
    let info = scan.map(|(info, _)| info);
    let histogram = scan.and_then(|(_, histogram)| histogram);
    name_ui(ui, session, recipe, commands);
    from_ui(ui, recipe, info, commands);
    if let Some(range) = recipe.from.range() {
        range_ui(ui, recipe, range, info, commands);
        if let Some(histogram) = histogram {
            histogram_ui(ui, range, histogram);
        }
        if info.is_some_and(|info| takes_vessels(range, info)) {
            let weak = Palette::get(ui).weak;
            ui.add(Label::new(RichText::new(w().vessels).small().color(weak)).wrap());
        }
    }
    if let RecipeSource::Grow { seeds, .. } = &recipe.from {
        seeds_ui(ui, session, recipe, seeds, commands);
    }
    let facts = session.view.subject.as_ref();
    let voxel_mm = facts.and_then(|facts| facts.voxel_mm());
    if recipe.from != RecipeSource::Nothing {
        clean_ui(ui, recipe, voxel_mm, commands);
    }
    paint::ui(ui, session, recipe, voxel_mm, commands);
    if let Some(text) = volume(session, recipe, histogram) {
        let weak = Palette::get(ui).weak;
        ui.label(RichText::new(text).small().color(weak));
    }
    if session.tissues.making == Some(recipe.index) {
        making_ui(ui, recipe, commands);
    }
}

/// What makes the first draft of a tissue.
#[derive(Clone, Copy, PartialEq)]
enum Draft {
    Values,
    Points,
    Hand,
}

fn from_ui(ui: &mut Ui, recipe: &Recipe, info: Option<&SubjectInfo>, commands: &mut Vec<Command>) {
    let current = match recipe.from {
        RecipeSource::Threshold { .. } => Draft::Values,
        RecipeSource::Grow { .. } => Draft::Points,
        RecipeSource::Nothing => Draft::Hand,
    };
    let options = [
        (Draft::Values, w().values),
        (Draft::Points, w().points),
        (Draft::Hand, w().by_hand),
    ];
    let Some(from) = widget::segmented(ui, w().from, &options, current) else {
        return;
    };
    // The brighter half of the usual window, where there was no range before.
    let usual = || {
        info.map_or(0.0, |info| {
            0.5 * (info.window_auto[0] + info.window_auto[1])
        })
    };
    let range = recipe.from.range().unwrap_or_else(|| [usual(), f32::MAX]);
    let seeds = Vec::new();
    let new = Recipe {
        from: match from {
            Draft::Values => RecipeSource::Threshold { range },
            Draft::Points => RecipeSource::Grow { seeds, range },
            Draft::Hand => RecipeSource::Nothing,
        },
        ..recipe.clone()
    };
    set(recipe, Change::Set(new), commands);
    commands.push(Command::Tissue(match from {
        Draft::Hand => TissueCommand::Ball(Some(false)),
        _ => TissueCommand::Seed(from == Draft::Points),
    }));
}

/// What ends the making of a tissue.
fn making_ui(ui: &mut Ui, recipe: &Recipe, commands: &mut Vec<Command>) {
    ui.add_space(4.0);
    ui.horizontal(|ui| {
        if widget::labelled_button(ui, Icon::Check, w().done, false, true).clicked() {
            commands.push(Command::Tissue(TissueCommand::Open(None)));
        }
        let leave = widget::labelled_button(ui, Icon::Close, w().leave, false, true);
        if leave.on_hover_text(w().leave_hint).clicked() {
            let remove = TissueCommand::Remove(recipe.index);
            commands.push(Command::Tissue(remove));
        }
    });
}

/// The volume of a tissue in words. While the tissue is being found it is what the range of values takes before the
/// clean-up, or else what was counted before, and said to be provisional.
fn volume(session: &Session, recipe: &Recipe, histogram: Option<&Histogram>) -> Option<String> {
    let voxel_cm3 = session.view.subject.as_ref()?.voxel_cm3()?;
    let counted = session.tissues.counts.get(position(session, recipe));
    let counted = counted.map(|&count| count as f64);
    let in_words = |count: f64| {
        let volume = count * voxel_cm3;
        widget::plain(volume, if volume < 10.0 { 2 } else { 0 })
    };
    if session.tissues.is_behind || session.tissues.is_stopped {
        let by_values = match (&recipe.from, histogram) {
            (RecipeSource::Threshold { range }, Some(histogram)) => {
                Some(histogram.count_within(*range))
            }
            _ => counted,
        };
        return Some(fill(w().provisional, &[&in_words(by_values?)]));
    }
    let counted = counted?;
    Some(match counted > 0.0 {
        true => fill(w().volume, &[&in_words(counted)]),
        false => w().nothing.to_owned(),
    })
}

/// Place of a recipe among those that are known.
fn position(session: &Session, recipe: &Recipe) -> usize {
    let all = &session.illustration().recipes;
    all.iter().take_while(|r| r.index < recipe.index).count()
}

/// The name. It is taken when the field is left, for each name has the tissue found anew; Escape leaves the old one.
fn name_ui(ui: &mut Ui, session: &Session, recipe: &Recipe, commands: &mut Vec<Command>) {
    let id = ui.scope_id().with("name");
    let typed: Option<String> = ui.data(|data| data.get_temp(id));
    let mut name = typed.unwrap_or_else(|| recipe.name.clone());
    let field = widget::row(ui, |ui| {
        let label = widget::row_label(ui, w().name, "");
        let field = TextEdit::singleline(&mut name).desired_width(f32::INFINITY);
        ui.add(field).labelled_by(label.id)
    });
    if field.changed() {
        ui.data_mut(|data| data.insert_temp(id, name.clone()));
    }
    let wanted = name.trim();
    let free = session.free_name(wanted, Some(&recipe.name));
    if free != wanted {
        let text = fill(w().taken, &[&wanted, &free]);
        let weak = Palette::get(ui).weak;
        ui.add(Label::new(RichText::new(text).small().color(weak)).wrap());
    }
    if field.lost_focus() {
        ui.data_mut(|data| data.remove_temp::<String>(id));
        // Escape ends the typing, and nothing else.
        let is_escape = |command: &Command| matches!(command, Command::Escape);
        let is_left = commands.iter().any(is_escape);
        commands.retain(|command| !is_escape(command));
        if !is_left && !wanted.is_empty() && wanted != recipe.name {
            let rename = TissueCommand::Rename(recipe.index, wanted.to_owned());
            commands.push(Command::Tissue(rename));
        }
    }
}

fn range_ui(
    ui: &mut Ui,
    recipe: &Recipe,
    [low, high]: [f32; 2],
    info: Option<&SubjectInfo>,
    commands: &mut Vec<Command>,
) {
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

/// How often which values occur, and which of them the tissue takes.
fn histogram_ui(ui: &mut Ui, range: [f32; 2], histogram: &Histogram) {
    let palette = Palette::get(ui);
    let size = vec2(ui.available_width(), HISTOGRAM + TICKS);
    let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
    response.widget_info(|| WidgetInfo::labeled(Role::Canvas, ui.is_enabled(), w().histogram));
    let [min, max] = histogram.value_range;
    let curve = rect.shrink2(vec2(8.0, 0.0));
    let axis = Axis {
        curve: curve.with_max_y(rect.bottom() - TICKS),
        range: [min, max.max(min + 1e-4)],
    };
    let [left, right] = range.map(|value| axis.x(value.clamp(axis.range[0], axis.range[1])));
    let taken = Rect::from_x_y_ranges(left..=right.max(left + 1.0), axis.curve.y_range());
    let painter = ui.painter_at(rect);
    painter.rect_filled(axis.curve, 3.0, palette.raised);
    painter.rect_filled(taken, 0.0, palette.accent_wash);
    paint_histogram(&painter, &axis, histogram, palette.line);
    let inner = painter.with_clip_rect(taken);
    paint_histogram(&inner, &axis, histogram, palette.accent);
    paint_ticks(&painter, &axis, rect.bottom(), palette);
    response.on_hover_text(w().histogram);
}

/// True if vessels that are filled with contrast agent are in a range that is meant for bone.
fn takes_vessels([low, high]: [f32; 2], info: &SubjectInfo) -> bool {
    let [low, high] = [low, high].map(|value| value - info.hounsfield_offset);
    info.is_ct && VESSELS.contains(&low) && high > VESSELS.end
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

fn clean_ui(ui: &mut Ui, recipe: &Recipe, voxel_mm: Option<f64>, commands: &mut Vec<Command>) {
    let with = |panel| Recipe {
        clean: from_panel(panel),
        ..recipe.clone()
    };
    ui.add_space(4.0);
    // Lengths are shown in voxels, with millimetres beside them. Recipes are only where voxels are.
    let voxel_mm = voxel_mm.unwrap_or(1.0);
    ui.label(fill(w().clean, &[&significant(voxel_mm)]));
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
    let row = |name: &'static str, summary: &'static str, value: f64, range: [f64; 2]| NumberRow {
        name,
        summary,
        value,
        default: Some(0.0),
        range: [range[0].min(value), range[1].max(value)],
        unit: "",
        decimals: 1,
    };
    let length = |ui: &mut Ui, name, summary, mm: f32, most_mm: f32, is_signed: bool| {
        let most = (f64::from(most_mm) / voxel_mm).min(MOST_VOXELS);
        let least = if is_signed { -most } else { 0.0 };
        let voxels = f64::from(mm) / voxel_mm;
        let note = if mm == 0.0 {
            String::new()
        } else {
            format!("{} mm", significant(f64::from(mm)))
        };
        let change = row(name, summary, voxels, [least, most]).ui_with_note(ui, &note);
        change.map(|c| c.map(|voxels| length_mm(voxels, voxel_mm).clamp(-most_mm, most_mm)))
    };
    let most = MAX_CLEAN_MM;
    let mut change = length(ui, w().close, w().close_hint, close, most, false)
        .map(|c| c.map(|mm| (mm, largest, fills, smooth, grow)));
    let parts = NumberRow {
        decimals: 0,
        ..row(
            w().largest,
            w().largest_hint,
            f64::from(largest),
            [0.0, 10.0],
        )
    };
    change = change.or(parts
        .ui(ui)
        .map(|c| c.map(|n| (close, n as u32, fills, smooth, grow))));
    let mut is_filled = fills;
    if ui.checkbox(&mut is_filled, w().fill).changed() {
        change = Some(Change::Set((close, largest, is_filled, smooth, grow)));
    }
    let smoothing = length(
        ui,
        w().smooth,
        w().smooth_hint,
        smooth,
        MAX_SMOOTH_MM,
        false,
    );
    change = change.or(smoothing.map(|c| c.map(|mm| (close, largest, fills, mm, grow))));
    let growing = length(ui, w().grow, w().grow_hint, grow, most, true);
    change = change.or(growing.map(|c| c.map(|mm| (close, largest, fills, smooth, mm))));
    if let Some(change) = change {
        set(recipe, change.map(with), commands);
    }
}

/// A length with the digits that tell: 2.2, 0.38, 0.012.
fn significant(mm: f64) -> String {
    let before = mm.abs().max(1e-6).log10().floor() as i32;
    widget::plain(mm, (1 - before).clamp(0, 6) as usize)
}
