//! What holds for a figure as a whole: landmarks, how turns spread, what becomes of the rest, how fine the mesh is.

use egui::Ui;
use serde_json::json;

use super::number;
use crate::app::kit::entry;
use crate::app::kit::icon::Icon;
use crate::app::kit::widget::{self, Named as _};
use crate::app::session::figure::{FigureCommand, ReferenceCommand, figure_edit};
use crate::app::session::{Command, Session};
use crate::app::words::figure::w;
use crate::app::words::fill;
use crate::document::figure::{DEFAULT_DETAIL, Propagation, Rest, Rotations};
use crate::document::{Edit, FigureList};

pub(super) fn ui(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    let figure = session.figure();
    if let Some(context) = &figure.context {
        let count = context.points.len();
        widget::heading(ui, &fill(w().landmarks, &[&count]), |ui| {
            if widget::icon_button(ui, Icon::Trash, w().drop_landmarks, true).clicked() {
                commands.push(Command::Figure(FigureCommand::DropLandmarks));
            }
        });
        let names = (w().strength, w().strength_hint);
        let value = (context.strength, 5.0);
        number_ui(
            ui,
            "context/strength",
            names,
            value,
            [0.0, 10.0],
            1,
            commands,
        );
    }
    likeness_ui(ui, session, commands);
    let folds = [w().unfold, w().fold].map(|text| fill(text, &[&w().whole]));
    if !widget::folded_heading(ui, "figure is open", w().whole, (&folds[0], &folds[1])) {
        return;
    }
    widget::row(ui, |ui| {
        widget::row_label(ui, w().rest_of, w().rest_hint);
        let options = [
            (Rest::Bend, w().rest_bend),
            (Rest::Keep, w().rest_keep),
            (Rest::Drop, w().rest_drop),
        ];
        if let Some(rest) = widget::segmented(ui, w().rest_of, &options, figure.rest) {
            let edit = figure_edit("rest", Some(json!(rest.name())));
            commands.push(Command::Apply(edit));
        }
    });
    widget::row(ui, |ui| {
        widget::row_label(ui, w().spread, w().spread_hint);
        let shown = spread_name(figure.propagation);
        let combo = widget::combo("spread", shown, ui.available_width() - 2.0);
        let shown = combo.show_ui(ui, |ui| {
            for propagation in Propagation::ALL {
                let is_it = figure.propagation == propagation;
                if ui
                    .selectable_label(is_it, spread_name(propagation))
                    .clicked()
                {
                    let value = json!(propagation.name());
                    let edit = figure_edit("propagation", Some(value));
                    commands.push(Command::Apply(edit));
                }
            }
        });
        shown
            .response
            .on_hover_text(w().spread_hint)
            .named(w().spread);
    });
    let mut is_found = figure.rotations == Rotations::Found;
    if ui.checkbox(&mut is_found, w().turn_open).clicked() {
        let rotations = Rotations::ALL[usize::from(!is_found)];
        let edit = figure_edit("rotations", Some(json!(rotations.name())));
        commands.push(Command::Apply(edit));
    }
    let names = (w().reach, w().reach_hint);
    let value = (figure.reach, 0.0);
    number_ui(ui, "reach", names, value, [0.0, 2.0], 2, commands);
    let names = (w().detail, w().detail_hint);
    let value = (f64::from(figure.detail), f64::from(DEFAULT_DETAIL));
    number_ui(ui, "detail", names, value, [500.0, 60_000.0], 0, commands);
    let drop_only = w().drop_only;
    if figure.only.is_some()
        && widget::labelled_button(ui, Icon::Close, drop_only, false, true).clicked()
    {
        commands.push(Command::Apply(figure_edit("only", None)));
    }
}

/// What is taken over from other pictures.
fn likeness_ui(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    let figure = session.figure();
    if let Some(context) = &figure.context {
        let mut keeps = context.keep;
        if ui.checkbox(&mut keeps, w().keeps).clicked() {
            let edit = figure_edit("context/keep", Some(json!(keeps)));
            commands.push(Command::Apply(edit));
        }
        if context.like.is_some() {
            amount_ui(ui, "context", context.amount, commands);
        }
    }
    if !figure.contours.is_empty() {
        widget::heading(ui, w().contours, |_| {});
    }
    for (index, contour) in figure.contours.iter().enumerate() {
        ui.push_id(("contour", index), |ui| {
            widget::row(ui, |ui| {
                widget::row_label(ui, &contour.region, "");
                let mut mirror = contour.mirror;
                let key = format!("contours/{index}/mirror");
                if ui.checkbox(&mut mirror, w().mirror).clicked() {
                    commands.push(Command::Apply(figure_edit(&key, Some(json!(mirror)))));
                }
                let name = fill(w().drop_contour, &[&contour.region]);
                if widget::icon_button(ui, Icon::Trash, &name, true).clicked() {
                    commands.push(Command::Apply(Edit::RemoveFromFigure {
                        list: FigureList::Contours,
                        index,
                    }));
                }
            });
            let key = format!("contours/{index}");
            amount_ui(ui, &key, contour.amount, commands);
        });
    }
    let button = widget::labelled_button(ui, Icon::Picture, w().like, false, true);
    if button.on_hover_text(w().like_hint).clicked() {
        let open = FigureCommand::Refer(ReferenceCommand::Open);
        commands.push(Command::Figure(open));
    }
}

/// How much is taken over, in percent.
fn amount_ui(ui: &mut Ui, key: &str, amount: f64, commands: &mut Vec<Command>) {
    let names = (w().amount, w().amount_hint);
    if let Some(change) = entry::part_row(ui, names, amount as f32, 1.0) {
        let edit = |part: f64| figure_edit(&format!("{key}/amount"), Some(json!(part)));
        commands.push(widget::command(change.map(edit)));
    }
}

/// A number of the figure itself, under a key.
fn number_ui(
    ui: &mut Ui,
    key: &str,
    names: (&str, &str),
    value: (f64, f64),
    range: [f64; 2],
    decimals: usize,
    commands: &mut Vec<Command>,
) {
    if let Some(change) = number::row(ui, names, value, range, decimals) {
        let edit = |x: f64| figure_edit(key, Some(json!(x)));
        commands.push(widget::command(change.map(edit)));
    }
}

fn spread_name(propagation: Propagation) -> &'static str {
    match propagation {
        Propagation::Harmonic => w().harmonic,
        Propagation::Nearest => w().nearest,
        Propagation::Linear => w().linear,
        Propagation::Gaussian => w().gaussian,
    }
}
