//! The catalogue: every template as a small picture of what it does to a cube, drawn by the renderer itself. A click starts
//! placing it.

use egui::{
    Align2, CornerRadius, FontId, Rect, Role, Sense, Stroke, Ui, Vec2, WidgetInfo, pos2, vec2,
};

use super::command::Command;
use super::control::{self, Named as _};
use super::icon::Icon;
use super::state::State;
use super::theme::{self, Palette};
use super::words::catalogue::{Catalogue, w};
use super::words::{fill, in_sentence, kinds, making};
use crate::document::TemplateKind;

/// Pictures of the templates, as far as they are drawn. `None` shows an outline.
pub(crate) trait Icons {
    /// Texture of a template's icon.
    fn texture(&self, kind: TemplateKind) -> Option<egui::TextureId>;
}

/// What one wants to do, in the reader's language, and what does it.
type Group = (fn(&Catalogue) -> &'static str, &'static [TemplateKind]);

/// Groups in which the catalogue is shown.
const GROUPS: [Group; 4] = {
    use TemplateKind as K;
    [
        (
            |w| w.open_up,
            &[
                K::Peel,
                K::Flap,
                K::Retractor,
                K::Cutquad,
                K::Peeler,
                K::Hole,
            ],
        ),
        (|w| w.take_apart, &[K::Split, K::Slices, K::Move]),
        (
            |w| w.carve,
            &[
                K::Cut,
                K::Poke,
                K::Pull,
                K::Squeeze,
                K::Dilate,
                K::Lens,
                K::Rbf,
            ],
        ),
        (|w| w.bend, &[K::Bend, K::Twist, K::Wave]),
    ]
};

/// Every kind, in the order of the catalogue.
pub(crate) fn kinds() -> impl Iterator<Item = TemplateKind> {
    GROUPS.iter().flat_map(|(_, kinds)| kinds.iter().copied())
}

/// What people call it.
pub(crate) fn kind_title(kind: TemplateKind) -> &'static str {
    kinds::title(kind)
}

/// The whole catalogue in columns as the width allows.
pub(crate) fn ui(ui: &mut Ui, state: &State, icons: &dyn Icons, commands: &mut Vec<Command>) {
    let gap = 5.0;
    let columns = ((ui.available_width() + gap) / 64.0)
        .floor()
        .clamp(2.0, 6.0);
    let cell = ((ui.available_width() - gap * (columns - 1.0)) / columns).floor();
    search_ui(ui, state, commands);
    let wanted = state.making.search.trim();
    let mut found_some = false;
    for (title, kinds) in GROUPS {
        let kinds: Vec<TemplateKind> = kinds
            .iter()
            .copied()
            .filter(|kind| is_found(*kind, title(w()), wanted))
            .collect();
        if kinds.is_empty() {
            continue;
        }
        found_some = true;
        ui.add_space(2.0);
        let weak = Palette::get(ui).weak;
        ui.label(theme::strong(title(w())).size(11.5).color(weak));
        for row in kinds.chunks(columns as usize) {
            ui.horizontal(|ui| {
                ui.spacing_mut().item_spacing.x = gap;
                for &kind in row {
                    cell_ui(ui, state, icons, kind, cell, commands);
                }
            });
        }
    }
    if !found_some {
        let weak = Palette::get(ui).weak;
        let text = egui::RichText::new(making::w().found_nothing).color(weak);
        ui.add(egui::Label::new(text).wrap());
    }
    if state.template_count() >= 32 {
        ui.label(w().full);
    }
}

/// The field over the catalogue. Enter starts placing the first that is found.
fn search_ui(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    let mut text = state.making.search.clone();
    let id = egui::Id::unique("search of the catalogue");
    control::row(ui, |ui| {
        let has_text = !text.is_empty();
        let width = ui.available_width() - if has_text { 34.0 } else { 0.0 };
        let edit = egui::TextEdit::singleline(&mut text)
            .hint_text(making::w().search_hint)
            .desired_width(width)
            .min_size(vec2(0.0, theme::control_height()))
            .align(egui::Align2::LEFT_CENTER)
            .char_limit(40)
            .id(id);
        // Before the field is shown: it takes what is typed in this very frame, and says its name.
        if state.making.wants_search {
            ui.memory_mut(|memory| memory.request_focus(id));
        }
        let response = ui.add(edit).named(making::w().search);
        if response.changed() {
            commands.push(Command::Search(text.clone()));
        }
        // In a slow frame the keyboard comes and goes again.
        let has_left =
            response.lost_focus() || (state.making.wants_search && !response.has_focus());
        if has_left && ui.input(|i| i.key_pressed(egui::Key::Enter)) {
            let found = GROUPS.iter().find_map(|(title, kinds)| {
                let mut kinds = kinds.iter().copied();
                kinds.find(|kind| is_found(*kind, title(w()), text.trim()))
            });
            if let Some(kind) = found.filter(|_| !text.trim().is_empty()) {
                commands.push(Command::Search(String::new()));
                commands.push(Command::StartPlacing(kind));
            }
        }
        let clear = making::w().clear_search;
        if has_text && control::icon_button(ui, Icon::Close, clear, true).clicked() {
            commands.push(Command::Search(String::new()));
        }
    });
}

/// True if every word that is searched for is in the template's name, what is said of it, its group, or its name in
/// documents.
fn is_found(kind: TemplateKind, group: &str, wanted: &str) -> bool {
    let text = format!(
        "{} {} {group} {}",
        kind_title(kind),
        kinds::summary(kind),
        kind.spec().name
    )
    .to_lowercase();
    let wanted = wanted.to_lowercase();
    wanted.split_whitespace().all(|word| text.contains(word))
}

fn cell_ui(
    ui: &mut Ui,
    state: &State,
    icons: &dyn Icons,
    kind: TemplateKind,
    width: f32,
    commands: &mut Vec<Command>,
) {
    let palette = Palette::get(ui);
    let title = kind_title(kind);
    let picture_side = (width - 8.0).min(64.0);
    let (rect, response) = ui.allocate_exact_size(vec2(width, picture_side + 22.0), Sense::click());
    let is_placing = state.placing == Some(kind);
    let name = fill(w().place, &[&in_sentence(title)]);
    response.widget_info(|| WidgetInfo::selected(Role::Button, ui.is_enabled(), is_placing, &name));
    if ui.is_rect_visible(rect) {
        let (fill, stroke) = if is_placing {
            (palette.accent_wash, palette.accent)
        } else if response.hovered() {
            (palette.raised, palette.weak)
        } else {
            (palette.raised, palette.line)
        };
        let stroke = Stroke::new(if is_placing { 1.5 } else { 1.0 }, stroke);
        ui.painter().rect(
            rect,
            CornerRadius::same(8),
            fill,
            stroke,
            egui::StrokeKind::Inside,
        );
        control::focus_ring(ui, &response, rect);
        let top = rect.center_top() + vec2(0.0, 4.0 + 0.5 * picture_side);
        let picture = Rect::from_center_size(top, Vec2::splat(picture_side));
        match icons.texture(kind) {
            Some(texture) => {
                let uv = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
                ui.painter()
                    .image(texture, picture, uv, egui::Color32::WHITE);
            }
            None => outline(ui, picture.shrink(8.0), palette.line),
        }
        let mut font = if is_placing {
            theme::strong_font(11.0)
        } else {
            FontId::proportional(11.0)
        };
        let wide = control::text_width(ui, title, font.clone());
        font.size *= ((width - 5.0) / wide).min(1.0);
        let color = if is_placing {
            palette.accent
        } else {
            palette.text
        };
        let at = rect.center_bottom() - vec2(0.0, 10.5);
        ui.painter()
            .with_clip_rect(rect)
            .text(at, Align2::CENTER_CENTER, title, font, color);
    }
    let response = response.on_hover_text(kinds::summary(kind));
    if response.clicked() {
        commands.push(Command::StartPlacing(kind));
    }
}

/// A plain cube, until the renderer has drawn the icon.
fn outline(ui: &Ui, rect: Rect, color: egui::Color32) {
    let (c, r) = (rect.center(), 0.5 * rect.height());
    let at = |x: f32, y: f32| c + vec2(x * r, y * r);
    let stroke = Stroke::new(1.2, color);
    let hexagon = vec![
        at(0.0, -1.0),
        at(0.87, -0.5),
        at(0.87, 0.5),
        at(0.0, 1.0),
        at(-0.87, 0.5),
        at(-0.87, -0.5),
    ];
    ui.painter().add(egui::Shape::closed_line(hexagon, stroke));
    for to in [at(0.87, -0.5), at(0.0, 1.0), at(-0.87, -0.5)] {
        ui.painter().line_segment([at(0.0, 0.0), to], stroke);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_groups_hold_every_kind_once() {
        let mut all: Vec<TemplateKind> = kinds().collect();
        all.sort();
        // A field comes with its file.
        let mut expected = TemplateKind::ALL.to_vec();
        expected.retain(|kind| *kind != TemplateKind::Field);
        expected.sort();
        assert_eq!(all, expected, "the catalogue shows every kind once");
    }
}
