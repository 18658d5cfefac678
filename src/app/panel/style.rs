//! An illustrator's style: which preset, and what is changed of it.

use egui::Ui;
use serde_json::{Value, json};

use crate::app::kit::entry;
use crate::app::kit::widget::{self, Named as _, NumberRow};
use crate::app::session::Command;
use crate::app::words::style::w;
use crate::app::words::{fill, names};
use crate::document::{
    Edit, Ghost, GhostBy, Hatch, HatchBy, Look, Outline, STYLE_PRESETS, Stipple, Style, Tone,
    color_text, plain_f64, style_preset,
};

/// Widest lines that the slider offers, thousandths of the picture's shorter side. A document may have wider ones.
const WIDEST_LINE: f32 = 10.0;
/// Distances of strokes and dots, thousandths of the picture's shorter side.
const SPACING: [f32; 2] = [2.0, 50.0];
/// Widths of strokes and sizes of dots, thousandths of the picture's shorter side.
const SIZE: [f32; 2] = [0.2, 20.0];

/// The section of the panel.
pub(crate) fn ui(ui: &mut Ui, look: &Look, commands: &mut Vec<Command>) {
    let preset = look.style_preset.and_then(style_preset);
    let base = preset.map_or(Style::PLAIN, |preset| preset.style);
    widget::heading(ui, w().heading, |_| {});
    preset_ui(ui, look, &base, commands);
    if !widget::folded_heading(ui, "style is open", w().change, (w().unfold, w().fold)) {
        return;
    }
    let style = &look.style;
    let mut rows = Rows { ui, commands };
    rows.outline(&style.outline, &base.outline);
    rows.tone(&style.tone, &base.tone);
    rows.hatch(&style.hatch, &base.hatch);
    rows.stipple(&style.stipple, &base.stipple);
    rows.ghost(&style.ghost, &base.ghost);
}

/// The choice of a preset. To choose one drops what was changed.
fn preset_ui(ui: &mut Ui, look: &Look, base: &Style, commands: &mut Vec<Command>) {
    let named = |name: &str| {
        let preset = style_preset(name);
        preset.map_or(w().plain, |p| names::style_preset(p.name, p.title))
    };
    let title = look.style_preset.map_or(w().plain, named);
    let selected = match (look.style == *base, look.style_preset) {
        (true, _) => title.to_owned(),
        (false, Some(_)) => fill(w().changed, &[&title]),
        (false, None) => w().own.to_owned(),
    };
    widget::row(ui, |ui| {
        widget::row_label(ui, w().drawn, w().drawn_hint);
        let combo = widget::combo("style", &selected, ui.available_width() - 2.0);
        let shown = combo.show_ui(ui, |ui| {
            let presets = STYLE_PRESETS.iter().map(|preset| Some(preset.name));
            for name in std::iter::once(None).chain(presets) {
                let is_chosen = look.style_preset == name && look.style == *base;
                let title = name.map_or(w().plain, named);
                let choice = ui.selectable_label(is_chosen, title);
                if choice.on_hover_text(preset_hint(name)).clicked() {
                    commands.push(Command::Apply(Edit::SetStyle(name)));
                }
            }
        });
        let response = shown.response.on_hover_text(w().drawn_hint);
        response.named(w().drawn);
    });
}

/// What a preset looks like, in one sentence.
fn preset_hint(name: Option<&str>) -> &'static str {
    match name {
        None => w().plain_hint,
        Some("atlas") => w().atlas_hint,
        Some("ink") => w().ink_hint,
        Some("pencil") => w().pencil_hint,
        Some("textbook") => w().textbook_hint,
        Some("blueprint") => w().blueprint_hint,
        Some(_) => w().drawn_hint,
    }
}

/// A row's name and the sentence of its tooltip.
type Names = (&'static str, &'static str);

/// The rows of the parts. What belongs to a part is shown where the part is drawn.
struct Rows<'a> {
    ui: &'a mut Ui,
    commands: &'a mut Vec<Command>,
}

impl Rows<'_> {
    fn outline(&mut self, now: &Outline, base: &Outline) {
        let row = NumberRow {
            name: w().outline,
            summary: w().outline_hint,
            value: f64::from(now.width),
            default: Some(f64::from(base.width)),
            range: [0.0, f64::from(WIDEST_LINE.max(now.width))],
            unit: "",
            decimals: 1,
        };
        if let Some(change) = row.ui(self.ui) {
            let edit = |width: f64| set("outline/width", json!(tenths(width)));
            self.commands.push(widget::command(change.map(edit)));
        }
        if now.width <= 0.0 {
            return;
        }
        let names = (w().outline_colour, w().outline_colour_hint);
        self.color("outline/color", names, now.color_srgb, base.color_srgb);
        let names = (w().creases, w().creases_hint);
        self.part("outline/creases", names, now.creases, base.creases);
    }

    fn tone(&mut self, now: &Tone, base: &Tone) {
        let names = (w().tone, w().tone_hint);
        self.part("tone/strength", names, now.strength, base.strength);
        if now.strength <= 0.0 {
            return;
        }
        let levels = [
            (0, w().smooth, ""),
            (2, "2", ""),
            (3, "3", ""),
            (4, "4", ""),
            (5, "5", ""),
        ];
        let names = (w().levels, w().levels_hint);
        if let Some(levels) = self.choice(names, &levels, now.levels) {
            self.set("tone/levels", json!(levels));
        }
        let names = (w().warm, w().warm_hint);
        self.color("tone/warm", names, now.warm_srgb, base.warm_srgb);
        let names = (w().cool, w().cool_hint);
        self.color("tone/cool", names, now.cool_srgb, base.cool_srgb);
    }

    fn hatch(&mut self, now: &Hatch, base: &Hatch) {
        let names = (w().hatch, w().hatch_hint);
        self.part("hatch/strength", names, now.strength, base.strength);
        if now.strength <= 0.0 {
            return;
        }
        let names = (w().hatch_spacing, w().hatch_spacing_hint);
        self.length("hatch/spacing", names, [now.spacing, base.spacing], SPACING);
        let names = (w().hatch_width, w().hatch_width_hint);
        self.length("hatch/width", names, [now.width, base.width], SIZE);
        let by = [
            (HatchBy::Curvature, w().curvature, w().curvature_hint),
            (HatchBy::Axis, w().axis, w().axis_hint),
        ];
        if let Some(by) = self.choice((w().hatch_by, w().hatch_by_hint), &by, now.by) {
            self.set("hatch/by", json!(by.name()));
        }
        let names = (w().hatch_colour, w().hatch_colour_hint);
        self.color("hatch/color", names, now.color_srgb, base.color_srgb);
    }

    fn stipple(&mut self, now: &Stipple, base: &Stipple) {
        let names = (w().stipple, w().stipple_hint);
        self.part("stipple/strength", names, now.strength, base.strength);
        if now.strength <= 0.0 {
            return;
        }
        let names = (w().stipple_spacing, w().stipple_spacing_hint);
        let spacing = [now.spacing, base.spacing];
        self.length("stipple/spacing", names, spacing, SPACING);
        let names = (w().stipple_size, w().stipple_size_hint);
        self.length("stipple/size", names, [now.size, base.size], SIZE);
        let names = (w().stipple_colour, w().stipple_colour_hint);
        self.color("stipple/color", names, now.color_srgb, base.color_srgb);
    }

    fn ghost(&mut self, now: &Ghost, base: &Ghost) {
        let names = (w().ghost, w().ghost_hint);
        self.part("ghost/strength", names, now.strength, base.strength);
        if now.strength <= 0.0 {
            return;
        }
        let by = [
            (GhostBy::Facing, w().facing, w().facing_hint),
            (GhostBy::Cut, w().cut, w().cut_hint),
        ];
        if let Some(by) = self.choice((w().ghost_by, w().ghost_by_hint), &by, now.by) {
            self.set("ghost/by", json!(by.name()));
        }
    }

    /// A number from 0 to 1, in percent.
    fn part(&mut self, key: &str, names: Names, now: f32, base: f32) {
        if let Some(change) = entry::part_row(self.ui, names, now, base) {
            let edit = |part: f64| set(key, json!(part));
            self.commands.push(widget::command(change.map(edit)));
        }
    }

    /// A distance or a size: as it is, and as the preset has it.
    fn length(
        &mut self,
        key: &str,
        (name, summary): Names,
        [now, base]: [f32; 2],
        range: [f32; 2],
    ) {
        let row = NumberRow {
            name,
            summary,
            value: f64::from(now),
            default: Some(f64::from(base)),
            range: range.map(plain_f64),
            unit: "",
            decimals: 1,
        };
        if let Some(change) = row.ui_logarithmic(self.ui) {
            let edit = |value: f64| set(key, json!(tenths(value)));
            self.commands.push(widget::command(change.map(edit)));
        }
    }

    fn color(&mut self, key: &str, names: Names, now: [u8; 3], base: [u8; 3]) {
        let own = (now != base).then_some(now);
        if let Some(change) = entry::color_row(self.ui, names, (own, base), w().as_preset) {
            let edit = |color: Option<[u8; 3]>| set(key, json!(color_text(color.unwrap_or(base))));
            self.commands.push(widget::command(change.map(edit)));
        }
    }

    /// A few entries side by side; the one that was chosen.
    fn choice<T: Copy + PartialEq>(
        &mut self,
        (name, summary): Names,
        options: &[(T, &str, &str)],
        now: T,
    ) -> Option<T> {
        widget::row(self.ui, |ui| {
            widget::row_label(ui, name, summary);
            widget::explained(ui, name, options, now)
        })
    }

    fn set(&mut self, key: &str, value: Value) {
        self.commands.push(Command::Apply(set(key, value)));
    }
}

/// Sets a key of the style.
fn set(key: &str, value: Value) -> Edit {
    Edit::Set {
        pointer: format!("/look/style/{key}"),
        value,
        name: "Change style".to_owned(),
    }
}

/// To as many decimals as a length shows.
fn tenths(value: f64) -> f64 {
    (value * 10.0).round() / 10.0
}
