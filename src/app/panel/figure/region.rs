//! Everything about the selected region.

use egui::{Ui, vec2};
use serde_json::{Value, json};

use super::material::{self, MATERIALS};
use super::number;
use crate::app::kit::icon::Icon;
use crate::app::kit::widget::{self, Change, Named as _, NumberRow};
use crate::app::session::figure::{FigureCommand, region_edit, rigidity_edit};
use crate::app::session::{Command, Session};
use crate::app::words::figure::w;
use crate::app::words::fill;
use crate::document::color_text;
use crate::document::figure::{Behind, RIGIDITY_RANGE, Region, Rigidity, Source};

/// The rows of a region.
struct Rows<'a> {
    ui: &'a mut Ui,
    session: &'a Session,
    region: &'a Region,
    commands: &'a mut Vec<Command>,
}

pub(super) fn selected_ui(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    let Some(region) = session.view.figure.selected_region() else {
        return;
    };
    widget::divider(ui);
    widget::heading(ui, &region.name, |ui| {
        if widget::icon_button(ui, Icon::Trash, w().delete_region, true).clicked() {
            commands.push(Command::DeleteSelected);
        }
    });
    let mut rows = Rows {
        ui,
        session,
        region,
        commands,
    };
    rows.material();
    rows.flood();
    rows.flag(w().fixed, "fixed", region.fixed);
    rows.cut();
    rows.flag(w().hide, "hide", region.hide);
    let names = (w().order, w().order_hint);
    rows.number("order", names, (region.order, 0.0), [-100.0, 100.0], 0);
    if widget::labelled_button(rows.ui, Icon::Grip, w().hold, false, true).clicked() {
        let hold = FigureCommand::HoldRegion(region.name.clone());
        rows.commands.push(Command::Figure(hold));
    }
    let folds = [w().unfold, w().fold].map(|text| fill(text, &[&w().more]));
    let is_open =
        widget::folded_heading(rows.ui, "region is open", w().more, (&folds[0], &folds[1]));
    if is_open {
        rows.clean_up();
    }
}

impl Rows<'_> {
    fn edit(&self, key: &str, value: Value) -> crate::document::Edit {
        region_edit(self.session, &self.region.name, key, value)
    }

    fn set(&mut self, key: &str, value: Value) {
        let edit = self.edit(key, value);
        self.commands.push(Command::Apply(edit));
    }

    fn material(&mut self) {
        let (session, region) = (self.session, self.region);
        let own = material::name(region.rigidity);
        widget::row(self.ui, |ui| {
            widget::row_label(ui, w().material, w().material_hint);
            let combo = widget::combo("material", own, ui.available_width() - 2.0);
            let shown = combo.show_ui(ui, |ui| {
                for (word, rigidity) in MATERIALS {
                    let is_it = region.rigidity == rigidity;
                    if ui.selectable_label(is_it, word(w())).clicked() {
                        let edit = rigidity_edit(session, &region.name, rigidity);
                        self.commands.push(Command::Apply(edit));
                    }
                }
            });
            shown
                .response
                .on_hover_text(w().material_hint)
                .named(w().material);
        });
        let Rigidity::Elastic([x, y]) = region.rigidity else {
            return;
        };
        for (name, axis) in [(w().rigidity_x, 0), (w().rigidity_y, 1)] {
            let row = NumberRow {
                name,
                summary: w().rigidity_hint,
                value: [x, y][axis],
                default: None,
                range: RIGIDITY_RANGE,
                unit: "",
                decimals: 1,
            };
            if let Some(change) = row.ui_logarithmic(self.ui) {
                let edit = |k: f64| {
                    let mut both = [x, y];
                    both[axis] = k;
                    rigidity_edit(session, &region.name, Rigidity::Elastic(both))
                };
                self.commands.push(widget::command(change.map(edit)));
            }
        }
    }

    /// Tolerance, gap and reach of a region that takes like pixels.
    fn flood(&mut self) {
        let Some(Source::Flood(flood)) = &self.region.from else {
            return;
        };
        let (tolerance, gap, connected) = (flood.tolerance, flood.gap, flood.connected);
        let names = (w().tolerance, w().tolerance_hint);
        self.number(
            "from/flood/tolerance",
            names,
            (tolerance, 24.0),
            [0.0, 255.0],
            0,
        );
        let names = (w().gap, w().gap_hint);
        self.number("from/flood/gap", names, (gap, 0.0), [0.0, 16.0], 0);
        self.flag(w().connected, "from/flood/connected", connected);
    }

    fn cut(&mut self) {
        let region = self.region;
        self.flag(w().cut, "cut", region.cut);
        if !region.cut {
            return;
        }
        let mut set = None;
        widget::row(self.ui, |ui| {
            widget::row_label(ui, w().behind_cut, w().behind_cut_hint);
            let options = [
                (0, w().behind_none),
                (1, w().behind_smooth),
                (2, w().behind_colour),
            ];
            let (current, color) = match region.behind {
                Behind::None => (0, [255; 3]),
                Behind::Smooth => (1, [255; 3]),
                Behind::Color(color) => (2, color),
            };
            let width = ui.available_width() - if current == 2 { 48.0 } else { 2.0 };
            ui.allocate_ui(vec2(width, ui.available_height()), |ui| {
                if let Some(chosen) = widget::segmented(ui, w().behind_cut, &options, current) {
                    let values = [json!("none"), json!("smooth"), json!(color_text(color))];
                    set = Some(Change::Set(values[chosen].clone()));
                }
            });
            let mut new = color;
            if current == 2
                && ui
                    .color_edit_button_srgb(&mut new)
                    .named(w().behind_colour)
                    .changed()
            {
                set = Some(Change::Drag(json!(color_text(new))));
            }
        });
        if let Some(change) = set {
            let change = change.map(|value| self.edit("behind", value));
            self.commands.push(widget::command(change));
        }
    }

    fn clean_up(&mut self) {
        let region = self.region;
        self.flag(w().fill, "fill", region.fills_holes());
        let names = (w().grow, w().grow_hint);
        self.number("grow", names, (region.grow, 0.0), [-32.0, 32.0], 0);
        let names = (w().smooth, w().smooth_hint);
        self.number("smooth", names, (region.smooth, 1.5), [0.0, 32.0], 1);
        let names = (w().least, w().least_hint);
        let least = (f64::from(region.least), 16.0);
        self.number("least", names, least, [0.0, 10_000.0], 0);
    }

    fn number(
        &mut self,
        key: &str,
        names: (&str, &str),
        value: (f64, f64),
        range: [f64; 2],
        decimals: usize,
    ) {
        let change = number::row(self.ui, names, value, range, decimals);
        if let Some(change) = change {
            let change = change.map(|x| self.edit(key, json!(x)));
            self.commands.push(widget::command(change));
        }
    }

    fn flag(&mut self, name: &str, key: &str, value: bool) {
        let mut new = value;
        if self.ui.checkbox(&mut new, name).clicked() {
            self.set(key, json!(new));
        }
    }
}
