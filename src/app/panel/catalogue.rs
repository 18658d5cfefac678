//! The catalogue: every template as a small picture of what it does to a cube. A click starts placing it.
//!
//! The pictures ship with the program: `cargo xtask icons` has the renderer draw them into `catalogue.png` beside this
//! file.

use egui::{
    Align2, Context, CornerRadius, FontId, Rect, Role, Sense, Stroke, Ui, Vec2, WidgetInfo, vec2,
};

use super::figure;
use crate::app::kit::icon::Icon;
use crate::app::kit::sheet::Sheet;
use crate::app::kit::theme::{self, Palette};
use crate::app::kit::widget::{self, Named as _};
use crate::app::session::{Command, Focus, Session, Tool};
use crate::app::words::catalogue::{Catalogue, w};
use crate::app::words::search::has_words;
use crate::app::words::{authoring, fill, in_sentence, kinds};
use crate::displace::Group;
use crate::document::TemplateKind;
use crate::placed::{ICON_PX, icon_kinds};

/// A word of the catalogue's table.
type Word = fn(&Catalogue) -> &'static str;

/// Groups in which the catalogue is shown: what one wants to do, in the reader's language.
const GROUPS: [(Word, Group); 4] = [
    (|w| w.open_up, Group::OpenUp),
    (|w| w.take_apart, Group::TakeApart),
    (|w| w.carve, Group::Carve),
    (|w| w.bend, Group::Bend),
];

/// The kinds of a group, in the order of the catalogue.
fn kinds_of(group: Group) -> Vec<TemplateKind> {
    let place = |kind: TemplateKind| {
        let (of, place) = kind.facts().catalogue?;
        (of == group).then_some((place, kind))
    };
    let mut kinds: Vec<(u32, TemplateKind)> =
        TemplateKind::ALL.into_iter().filter_map(place).collect();
    kinds.sort();
    kinds.into_iter().map(|(_, kind)| kind).collect()
}

/// The pictures of the catalogue. Made once per window.
pub(crate) struct Icons(Option<Sheet>);

impl Icons {
    /// The icons as the program ships them.
    pub(crate) fn new(ctx: &Context) -> Self {
        let png = include_bytes!("catalogue.png");
        Self(Sheet::new(ctx, "icons of the catalogue", png, [ICON_PX; 2]).ok())
    }

    /// Paints the icon of a kind.
    fn paint(&self, ui: &Ui, kind: TemplateKind, rect: Rect) {
        let index = icon_kinds().position(|other| other == kind);
        if let (Some(sheet), Some(index)) = (&self.0, index) {
            let (texture, uv) = sheet.tile(index);
            ui.painter().image(texture, rect, uv, egui::Color32::WHITE);
        }
    }
}

/// The whole catalogue in columns as the width allows.
pub(crate) fn ui(
    ui: &mut Ui,
    session: &Session,
    icons: &Icons,
    focus: Option<Focus>,
    commands: &mut Vec<Command>,
) {
    if session.view.is_figure() {
        return figure::tools_ui(ui, session, commands);
    }
    let gap = 5.0;
    let columns = ((ui.available_width() + gap) / 64.0)
        .floor()
        .clamp(2.0, 6.0);
    let cell = ((ui.available_width() - gap * (columns - 1.0)) / columns).floor();
    search_ui(ui, session, focus == Some(Focus::Search), commands);
    let wanted = session.search.trim();
    let mut found_some = false;
    for (title, group) in GROUPS {
        let kinds: Vec<TemplateKind> = kinds_of(group)
            .into_iter()
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
                    cell_ui(ui, session, icons, kind, cell, commands);
                }
            });
        }
    }
    if !found_some {
        let weak = Palette::get(ui).weak;
        let text = egui::RichText::new(authoring::w().found_nothing).color(weak);
        ui.add(egui::Label::new(text).wrap());
    }
    if session.template_count() >= 32 {
        ui.label(w().full);
    }
}

/// The field over the catalogue. Enter starts placing the first that is found.
fn search_ui(ui: &mut Ui, session: &Session, wants_focus: bool, commands: &mut Vec<Command>) {
    let mut text = session.search.clone();
    let id = egui::Id::unique("search of the catalogue");
    widget::row(ui, |ui| {
        let has_text = !text.is_empty();
        let width = ui.available_width() - if has_text { 34.0 } else { 0.0 };
        let edit = egui::TextEdit::singleline(&mut text)
            .hint_text(authoring::w().search_hint)
            .desired_width(width)
            .min_size(vec2(0.0, theme::control_height()))
            .align(egui::Align2::LEFT_CENTER)
            .char_limit(40)
            .id(id);
        // Asked for before the field is shown: the field then takes letters typed in this very frame, and tells its
        // name.
        if wants_focus {
            ui.memory_mut(|memory| memory.request_focus(id));
        }
        let response = ui.add(edit).named(authoring::w().search);
        if response.changed() {
            commands.push(Command::Search(text.clone()));
        }
        // In a slow frame the keyboard comes and goes again.
        let has_left = response.lost_focus() || (wants_focus && !response.has_focus());
        if has_left && ui.input(|i| i.key_pressed(egui::Key::Enter)) {
            let found = GROUPS.iter().find_map(|(title, group)| {
                let mut kinds = kinds_of(*group).into_iter();
                kinds.find(|kind| is_found(*kind, title(w()), text.trim()))
            });
            if let Some(kind) = found.filter(|_| !text.trim().is_empty()) {
                commands.push(Command::Search(String::new()));
                commands.push(Command::StartPlacing(kind));
            }
        }
        let clear = authoring::w().clear_search;
        if has_text && widget::icon_button(ui, Icon::Close, clear, true).clicked() {
            commands.push(Command::Search(String::new()));
        }
    });
}

/// True if every word of the search is in the template's name, its summary, its group, or its name in
/// documents.
fn is_found(kind: TemplateKind, group: &str, wanted: &str) -> bool {
    let text = format!(
        "{} {} {group} {}",
        kinds::title(kind),
        kinds::summary(kind),
        kind.spec().name
    );
    has_words(&text, wanted)
}

fn cell_ui(
    ui: &mut Ui,
    session: &Session,
    icons: &Icons,
    kind: TemplateKind,
    width: f32,
    commands: &mut Vec<Command>,
) {
    let palette = Palette::get(ui);
    let title = kinds::title(kind);
    let picture_side = (width - 8.0).min(64.0);
    let (rect, response) = ui.allocate_exact_size(vec2(width, picture_side + 22.0), Sense::click());
    let is_placing = session.tool() == Tool::Place(kind);
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
        widget::focus_ring(ui, &response, rect);
        let top = rect.center_top() + vec2(0.0, 4.0 + 0.5 * picture_side);
        let picture = Rect::from_center_size(top, Vec2::splat(picture_side));
        icons.paint(ui, kind, picture);
        let mut font = if is_placing {
            theme::strong_font(11.0)
        } else {
            FontId::proportional(11.0)
        };
        let wide = widget::text_width(ui, title, font.clone());
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_groups_hold_every_kind_once() {
        let groups = GROUPS.into_iter();
        let mut all: Vec<TemplateKind> = groups.flat_map(|(_, group)| kinds_of(group)).collect();
        all.sort();
        // A field comes with its file.
        let mut expected = TemplateKind::ALL.to_vec();
        expected.retain(|kind| *kind != TemplateKind::Field);
        expected.sort();
        assert_eq!(all, expected, "the catalogue shows every kind once");
    }
}
