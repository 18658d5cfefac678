//! Tissues: the segments that the subject came with and those made here, by a range of values or by growing from
//! points, then cleaned up. Each can be shown alone; those made here are edited in place, and the picture shows
//! the result as soon as it is found.

use egui::{Color32, Label, RichText, Sense, Stroke, Ui, vec2};

use super::{recipe, seek};
use crate::app::kit::icon::Icon;
use crate::app::kit::theme::{Palette, control_height};
use crate::app::kit::widget::{self, NumberRow};
use crate::app::session::tissues::set_look;
use crate::app::session::{ClayCommand, Command, Focus, LoadOf, Session, Sought, TissueCommand};
use crate::app::words::kept::segment;
use crate::app::words::tissue::w;
use crate::app::words::{clay, fill, in_sentence};
use crate::data::{Histogram, RECIPE_COLORS_SRGB, Segment};
use crate::document::{MAX_RECIPES, Recipe, SegmentLook};
use crate::render::SubjectInfo;

/// Height at which the menu of tissues scrolls, points.
const MENU_HEIGHT: f32 = 280.0;
/// Rows that the list shows at least before it scrolls, alone and with a form below.
const LISTED: usize = 9;
const LISTED_WITH_FORM: usize = 4;
/// Width of the bar that tells how far the search for tissues is, points.
const BAR: f32 = 96.0;
/// Space at the end of the panel, points.
const END: f32 = 14.0;
/// Where dense bone begins in Hounsfield units; its spongy parts are closed in by it.
const BONE_FROM: f32 = 180.0;

/// Each segment once: labels that stand for an overlap are left out.
pub(crate) fn listed(segments: &[Segment]) -> Vec<&Segment> {
    let is_single = |label: u16| segments.iter().filter(|other| other.label == label).count() == 1;
    segments.iter().filter(|s| is_single(s.label)).collect()
}

/// The panel. `segments` are those shown at this moment; `scan` is what is known of the values of the subject, and
/// how often which occur.
pub(crate) fn ui(
    ui: &mut Ui,
    session: &Session,
    segments: &[Segment],
    scan: Option<(&SubjectInfo, Option<&Histogram>)>,
    focus: Option<Focus>,
    commands: &mut Vec<Command>,
) {
    let recipes = &session.illustration().recipes;
    // Recipes find tissue by values.
    let has_values = session.view.has_values();
    // A coarse copy comes before the scan: lengths in its voxels would be too long.
    let is_arriving = |of: &LoadOf| !matches!(of, LoadOf::Beside(_));
    let is_loading = session
        .load
        .as_ref()
        .is_some_and(|load| is_arriving(&load.of));
    let can_add = scan.is_some() && recipes.len() < MAX_RECIPES && !is_loading;
    widget::heading(ui, w().heading, |ui| {
        progress_ui(ui, session, commands);
        if session.tissues.alone.is_some()
            && widget::icon_button(ui, Icon::Reset, w().all, true).clicked()
        {
            commands.push(Command::Tissue(TissueCommand::Alone(None)));
        }
    });
    stopped_ui(ui, session, commands);
    let listed = listed(segments);
    let weak = Palette::get(ui).weak;
    if listed.is_empty() && recipes.is_empty() {
        ui.add(Label::new(RichText::new(w().none).color(weak)).wrap());
    }
    if !(listed.is_empty() && recipes.is_empty() && session.shown().captions.is_empty()) {
        seek::field_ui(ui, session, focus == Some(Focus::Tissues), commands);
        ui.add_space(2.0);
    }
    let found = is_searching(session).then(|| session.found_by_name());
    let is_found = |name: &str| {
        let is_it = |sought: &Sought| matches!(sought, Sought::Tissue(other) if other == name);
        found.as_ref().is_none_or(|found| found.iter().any(is_it))
    };
    let rows = |ui: &mut Ui| {
        // A segment that a recipe is being run for has a row already.
        for recipe in recipes.iter().filter(|recipe| is_found(&recipe.name)) {
            let color = RECIPE_COLORS_SRGB[recipe.index % RECIPE_COLORS_SRGB.len()];
            let color = recipe.color_srgb.unwrap_or(color);
            row_ui(ui, session, &recipe.name, color, Some(recipe), commands);
        }
        let is_recipe = |s: &&&Segment| recipes.iter().all(|recipe| recipe.name != s.name);
        let others = listed.iter().filter(is_recipe);
        for entry in others.filter(|entry| is_found(&entry.name)) {
            let color = entry.color_srgb.unwrap_or([160; 3]);
            row_ui(ui, session, &entry.name, color, None, commands);
        }
        if let Some(found) = &found {
            seek::captions_ui(ui, session, found, commands);
        }
    };
    let least = match session.tissues.open {
        Some(_) => LISTED_WITH_FORM,
        None => LISTED,
    };
    let rows_height = list_height(ui, least);
    egui::ScrollArea::vertical()
        .id_salt("tissues")
        .max_height(rows_height)
        .auto_shrink([false, true])
        .show(ui, rows);
    let below = ui.cursor().top();
    let open = session.tissues.open;
    if let Some(recipe) = recipes.iter().find(|recipe| open == Some(recipe.index)) {
        widget::divider(ui);
        ui.push_id(("tissue", recipe.index), |ui| {
            recipe::ui(ui, session, recipe, scan, commands);
        });
    }
    if has_values {
        ui.add_space(4.0);
        ui.horizontal_wrapped(|ui| {
            let add = widget::labelled_button(ui, Icon::Plus, w().add, false, can_add);
            let add = add.on_hover_text(w().add_hint);
            let add = add.on_disabled_hover_text(if is_loading {
                w().loading
            } else {
                w().add_hint
            });
            if add.clicked()
                && let Some((info, _)) = scan
            {
                commands.push(make(session, info));
            }
            let by_hand = widget::labelled_button(ui, Icon::Brush, w().add_by_hand, false, can_add);
            if by_hand.on_hover_text(w().add_by_hand_hint).clicked() {
                let number = recipes.len() + 1;
                let name = fill(w().tissue_n, &[&number]);
                commands.push(Command::Tissue(TissueCommand::MakeByHand(name)));
            }
            if let Some((info, _)) = scan.filter(|_| session.clay().is_none() && !is_loading) {
                let made = recipes.iter().map(|recipe| recipe.name.as_str());
                let others = listed.iter().map(|entry| entry.name.as_str());
                let others = others.filter(|name| recipes.iter().all(|r| r.name != *name));
                let names: Vec<&str> = made.chain(others).collect();
                clay_ui(ui, session, info, &names, commands);
            }
        });
    }
    remember_height(ui, ui.cursor().top() - below);
}

/// Tissues are searched for by their names.
fn is_searching(session: &Session) -> bool {
    !session.tissues.search.trim().is_empty()
}

/// Where the height of what stands below the list is kept from frame to frame.
fn below_id() -> egui::Id {
    egui::Id::unique("height below the tissues")
}

/// The height that the list may take: what the panel has left besides what stands below the list, or that of the least
/// number of rows.
fn list_height(ui: &Ui, least: usize) -> f32 {
    let below: f32 = ui.data(|data| data.get_temp(below_id())).unwrap_or(0.0);
    let room = ui.clip_rect().bottom() - ui.cursor().top() - below - END;
    room.max(least as f32 * (control_height() + 4.0))
}

fn remember_height(ui: &Ui, height: f32) {
    let before = ui.data_mut(|data| {
        let before: Option<f32> = data.get_temp(below_id());
        data.insert_temp(below_id(), height);
        before
    });
    if before.is_none_or(|before| (before - height).abs() > 0.5) {
        ui.ctx().request_repaint();
    }
}

/// How far the search for tissues is, and how to stop it: in the heading, so that no control moves when it begins.
fn progress_ui(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    let tissues = &session.tissues;
    let Some(fraction) = tissues.progress.filter(|_| tissues.is_behind) else {
        return;
    };
    if widget::icon_button(ui, Icon::Close, w().stop, true).clicked() {
        commands.push(Command::Tissue(TissueCommand::Stop));
    }
    let percent = (fraction * 100.0).round();
    let bar = egui::ProgressBar::new(fraction).desired_height(4.0);
    let bar = ui.add(bar.desired_width(BAR));
    bar.on_hover_text(fill(w().working, &[&percent]));
}

/// The search was stopped: that the picture is not what the document says, and how to go on.
fn stopped_ui(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    if !session.tissues.is_stopped {
        return;
    }
    let weak = Palette::get(ui).weak;
    ui.add(Label::new(RichText::new(w().stopped).small().color(weak)).wrap());
    if widget::labelled_button(ui, Icon::Next, w().go_on, false, true).clicked() {
        commands.push(Command::Tissue(TissueCommand::Find));
    }
}

/// The command that makes a tissue: bone of a CT, else the brighter half of the usual window.
fn make(session: &Session, info: &SubjectInfo) -> Command {
    let (name, range) = if info.is_ct {
        let low = info.hounsfield_offset + BONE_FROM;
        ("bone".to_owned(), [low, f32::MAX])
    } else {
        let [low, high] = info.window_auto;
        let number = session.illustration().recipes.len() + 1;
        let name = fill(w().tissue_n, &[&number]);
        (name, [0.5 * (low + high), f32::MAX])
    };
    Command::Tissue(TissueCommand::Make(name, range))
}

/// The button whose menu begins a clay: with the outer surface or with a tissue.
fn clay_ui(
    ui: &mut Ui,
    session: &Session,
    info: &SubjectInfo,
    names: &[&str],
    commands: &mut Vec<Command>,
) {
    let words = clay::w();
    let outer = info.outer_value();
    let button = widget::labelled_button(ui, Icon::Brush, words.begin, false, true);
    let button = button.on_hover_text(words.begin_hint);
    egui::Popup::menu(&button).show(|ui| {
        let mut item = |ui: &mut Ui, title: &str, tissue: Option<&str>| {
            if let Some(start) = session.clay_start(tissue, outer)
                && ui.button(title).clicked()
            {
                commands.push(Command::Clay(ClayCommand::Begin(start)));
                ui.close();
            }
        };
        item(ui, words.outer, None);
        egui::ScrollArea::vertical()
            .max_height(MENU_HEIGHT)
            .show(ui, |ui| {
                for name in names {
                    item(ui, &segment(name), Some(name));
                }
            });
    });
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
                    let remove = TissueCommand::Remove(recipe.index);
                    commands.push(Command::Tissue(remove));
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
                name_ui(ui, session, name, is_open, commands);
            });
        });
    });
    if session.tissues.look.as_deref() == Some(name) {
        ui.push_id(("look", name), |ui| {
            look_ui(ui, name, [r, g, b], look, commands)
        });
    }
}

/// The name of a tissue: a click chooses it, and shows it for a moment. What was searched for is turned to.
fn name_ui(ui: &mut Ui, session: &Session, name: &str, is_open: bool, commands: &mut Vec<Command>) {
    let palette = Palette::get(ui);
    let title = segment(name);
    let is_selected = session.tissues.selected.as_deref() == Some(name);
    // All of the row takes the click.
    let (rect, response) = ui.allocate_exact_size(ui.available_size(), Sense::click());
    response.widget_info(|| {
        egui::WidgetInfo::selected(egui::Role::Button, ui.is_enabled(), is_selected, &title)
    });
    if is_selected || response.hovered() {
        let wash = if is_selected {
            palette.accent_wash
        } else {
            palette.hover
        };
        ui.painter().rect_filled(rect, 4.0, wash);
    }
    let color = if is_open {
        palette.accent
    } else {
        palette.text
    };
    let room = rect.width() - 8.0;
    let galley = egui::WidgetText::from(title.as_str()).into_galley(
        ui,
        Some(egui::TextWrapMode::Truncate),
        room,
        egui::TextStyle::Body,
    );
    let at = rect.left_center() + vec2(4.0, -0.5 * galley.size().y);
    let spot = widget::sided(rect, egui::Rect::from_min_size(at, galley.size()));
    ui.painter().galley(spot.min, galley, color);
    widget::focus_ring(ui, &response, rect);
    let hint = match is_searching(session) {
        true => w().turn_to,
        false => w().glimpse,
    };
    let hint = fill(hint, &[&in_sentence(&title)]);
    if response.on_hover_text(hint).clicked() {
        let name = name.to_owned();
        commands.push(match is_searching(session) {
            true => Command::Seek(Sought::Tissue(name)),
            false => Command::Tissue(TissueCommand::Select(name)),
        });
    }
}

fn look_of<'a>(session: &'a Session, name: &str) -> Option<&'a SegmentLook> {
    let mut looks = session.shown().look.segments.iter();
    looks.find(|look| look.name == name)
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
