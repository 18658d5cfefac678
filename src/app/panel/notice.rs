//! Messages: over the picture, and all of them again on demand. The load under way, with its cancel button.

use egui::{CornerRadius, Label, Modal, Rect, RichText, Sense, Stroke, Ui, vec2};

use crate::app::kit::icon::Icon;
use crate::app::kit::theme::{self, Palette};
use crate::app::kit::widget;
use crate::app::session::Command;
use crate::app::session::figure::FigureCommand;
use crate::app::session::{Gravity, Load, Notice, Offer, Session};
use crate::app::words::messages::w;
use crate::app::words::{fill, names};

/// Lines shown at once over the picture.
const SHOWN: usize = 3;

/// At the bottom of the area: loading, then the newest lines. `floor` is the top of a card there, which they keep free,
/// points.
pub(crate) fn ui(
    ui: &Ui,
    area: Rect,
    floor: Option<f32>,
    session: &Session,
    commands: &mut Vec<Command>,
) {
    let figure = &session.view.figure;
    let is_bending = figure.progress.is_some() || figure.is_stopped;
    let is_busy = session.load.is_some() || session.is_reading || session.saving.is_some();
    if !is_busy && !is_bending && session.notices.shown().next().is_none() {
        return;
    }
    let width = area.width().clamp(240.0, 460.0);
    let bottom = floor.map_or(area.bottom(), |floor| area.bottom().min(floor - 8.0));
    let foot = egui::pos2(area.center().x, bottom);
    let shown = egui::Area::new(egui::Id::unique("notices"))
        .order(egui::Order::Middle)
        .pivot(egui::Align2::CENTER_BOTTOM)
        .fixed_pos(foot)
        .constrain_to(ui.max_rect())
        .fade_in(false);
    shown.show(ui.ctx(), |ui| {
        ui.set_width(width);
        ui.spacing_mut().item_spacing.y = 6.0;
        let count = session.notices.shown().count();
        for notice in session.notices.shown().skip(count.saturating_sub(SHOWN)) {
            notice_ui(ui, notice, commands);
        }
        if let Some(fraction) = session.saving {
            let work = (w().saving, w().stop_saving);
            work_ui(ui, work, fraction, Command::StopSaving, commands);
        }
        if let Some(fraction) = figure.progress {
            let work = (w().bending, w().stop_bending);
            let stop = Command::Figure(FigureCommand::Stop);
            work_ui(ui, work, fraction, stop, commands);
        } else if figure.is_stopped {
            stopped_ui(ui, commands);
        }
        // A hand that shapes clay asks for one sketch after the other: a bar for each would flicker.
        let is_hidden = session.is_sketch_of_hand();
        if let Some(load) = session.load.as_ref().filter(|_| !is_hidden) {
            load_ui(ui, load, commands);
        } else if session.is_reading {
            card(ui, Palette::get(ui).line, |ui| ui.label(w().loading));
        }
    });
}

fn card<R>(ui: &mut Ui, border: egui::Color32, contents: impl FnOnce(&mut Ui) -> R) -> R {
    let palette = Palette::get(ui);
    let frame = egui::Frame::new()
        .fill(palette.raised)
        .stroke(Stroke::new(1.0, border))
        .corner_radius(CornerRadius::same(8))
        .inner_margin(egui::Margin::symmetric(10, 6))
        .shadow(egui::Shadow {
            offset: [0, 2],
            blur: 10,
            spread: 0,
            color: egui::Color32::from_black_alpha(45),
        });
    frame
        .show(ui, |ui| {
            ui.set_width(ui.available_width());
            contents(ui)
        })
        .inner
}

fn notice_ui(ui: &mut Ui, notice: &Notice, commands: &mut Vec<Command>) {
    let palette = Palette::get(ui);
    let (icon, color) = match notice.gravity {
        Gravity::Success => (Icon::Check, palette.accent),
        Gravity::Info => (Icon::Info, palette.weak),
        Gravity::Warning => (Icon::Warning, palette.warning),
        Gravity::Error => (Icon::Warning, palette.danger),
    };
    let border = if notice.gravity == Gravity::Error {
        palette.danger
    } else {
        palette.line
    };
    ui.push_id(notice.id, |ui| {
        card(ui, border, |ui| {
            ui.horizontal(|ui| {
                let (spot, _) = ui.allocate_exact_size(vec2(20.0, 20.0), Sense::hover());
                icon.paint(ui.painter(), spot, color);
                let buttons = if notice.details.is_empty() {
                    34.0
                } else {
                    34.0 + 76.0
                };
                let text_width = (ui.available_width() - buttons).max(80.0);
                ui.allocate_ui_with_layout(
                    vec2(text_width, 20.0),
                    egui::Layout::top_down(egui::Align::Min),
                    |ui| {
                        ui.set_width(text_width);
                        let label = ui.add(Label::new(&notice.message).wrap());
                        // Screen readers speak it as it comes.
                        ui.ctx().accesskit_node_builder(label.id, |node| {
                            node.set_role(egui::Role::Alert);
                            node.set_label(notice.message.clone());
                        });
                    },
                );
                ui.with_layout(widget::against(), |ui| {
                    if widget::icon_button(ui, Icon::Close, w().dismiss, true).clicked() {
                        commands.push(Command::Dismiss(notice.id));
                    }
                    if !notice.details.is_empty() {
                        let text = if notice.is_unfolded {
                            w().less
                        } else {
                            w().details
                        };
                        if ui.button(text).clicked() {
                            commands.push(Command::Unfold(notice.id));
                        }
                    }
                });
            });
            let offered = notice.offer.as_ref().map(|offer| match offer {
                Offer::KeepTemplates => (Icon::Layers, w().keep_templates, Command::KeepTemplates),
                Offer::FetchFields(host) => {
                    let allow = Command::AllowFields(notice.id, host.clone());
                    (Icon::Download, w().fetch, allow)
                }
            });
            if let Some((icon, name, command)) = offered
                && widget::labelled_button(ui, icon, name, true, true).clicked()
            {
                commands.push(command);
            }
            if notice.is_unfolded {
                let text = RichText::new(&notice.details).small().color(palette.weak);
                egui::ScrollArea::vertical()
                    .max_height(160.0)
                    .show(ui, |ui| {
                        ui.add(Label::new(text).wrap().selectable(true));
                    });
            }
        });
    });
}

fn load_ui(ui: &mut Ui, load: &Load, commands: &mut Vec<Command>) {
    let Some(host) = &load.host else {
        let stage = names::stage(&load.what);
        let work = (stage.as_str(), w().cancel_loading);
        return work_ui(ui, work, load.fraction, Command::CancelLoad, commands);
    };
    card(ui, Palette::get(ui).line, |ui| {
        ui.add(Label::new(fill(w().fetch_it, &[host])).wrap());
        ui.horizontal(|ui| {
            if widget::labelled_button(ui, Icon::Download, w().fetch, true, true).clicked() {
                commands.push(Command::AllowHost);
            }
            if widget::labelled_button(ui, Icon::Close, w().no, false, true).clicked() {
                commands.push(Command::CancelLoad);
            }
        });
    });
}

/// The figure is not what the document says, and how to go on.
fn stopped_ui(ui: &mut Ui, commands: &mut Vec<Command>) {
    card(ui, Palette::get(ui).line, |ui| {
        ui.add(Label::new(w().bending_stopped).wrap());
        if widget::labelled_button(ui, Icon::Next, w().bend_on, false, true).clicked() {
            commands.push(Command::Figure(FigureCommand::GoOn));
        }
    });
}

/// Work under way: its name, how much of it is done, and a button that stops it.
fn work_ui(
    ui: &mut Ui,
    (name, stop_name): (&str, &str),
    fraction: f32,
    stop: Command,
    commands: &mut Vec<Command>,
) {
    let palette = Palette::get(ui);
    card(ui, palette.line, |ui| {
        ui.horizontal(|ui| {
            let percent = (fraction * 100.0).round();
            ui.add(Label::new(format!("{name} {percent} %")).truncate());
            ui.with_layout(widget::against(), |ui| {
                if widget::icon_button(ui, Icon::Close, stop_name, true).clicked() {
                    commands.push(stop);
                }
                let (bar, response) = ui.allocate_exact_size(
                    vec2((ui.available_width() - 8.0).max(20.0), 4.0),
                    Sense::hover(),
                );
                response.widget_info(|| {
                    let mut info =
                        egui::WidgetInfo::labeled(egui::Role::ProgressIndicator, true, name);
                    info.value = Some(f64::from(fraction));
                    info
                });
                ui.painter()
                    .rect_filled(bar, CornerRadius::same(2), palette.sunken);
                let done = bar.with_max_x(bar.left() + bar.width() * fraction.clamp(0.0, 1.0));
                ui.painter()
                    .rect_filled(done, CornerRadius::same(2), palette.accent);
            });
        });
    });
}

/// Every message so far, newest first.
pub(crate) fn messages_ui(ui: &Ui, session: &Session, commands: &mut Vec<Command>) {
    let content = ui.ctx().content_rect().size();
    let frame = egui::Frame::window(ui.style());
    let modal = Modal::new(egui::Id::unique("messages"))
        .frame(frame)
        .show(ui.ctx(), |ui| {
            ui.set_width((content.x - 64.0).min(520.0));
            widget::heading(ui, w().messages, |ui| {
                if widget::icon_button(ui, Icon::Close, w().close_messages, true).clicked() {
                    commands.push(Command::ToggleMessages);
                }
            });
            widget::divider(ui);
            let weak = Palette::get(ui).weak;
            if session.notices.all().is_empty() {
                ui.label(RichText::new(w().nothing_so_far).color(weak));
            }
            egui::ScrollArea::vertical()
                .max_height(content.y - 180.0)
                .show(ui, |ui| {
                    for notice in session.notices.all().iter().rev() {
                        ui.add(
                            Label::new(theme::strong(notice.message.clone()).size(13.0))
                                .wrap()
                                .selectable(true),
                        );
                        if !notice.details.is_empty() {
                            let details = RichText::new(&notice.details).small().color(weak);
                            ui.add(Label::new(details).wrap().selectable(true));
                        }
                        ui.add_space(6.0);
                    }
                });
        });
    if modal.should_close() {
        commands.push(Command::ToggleMessages);
    }
}
