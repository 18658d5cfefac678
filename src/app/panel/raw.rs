//! A file of bare voxels is opened by telling how they lie: sizes, type, byte order, what to skip, voxel size. Filled
//! in from the file's name and length as far as they tell; the answer is kept in the document, so that the same file
//! opens by itself the next time.

use egui::{ComboBox, DragValue, Id, Modal, RichText, Ui};

use crate::app::kit::theme::Palette;
use crate::app::kit::widget;
use crate::app::session::{Command, Fit, RawCommand, Session};
use crate::app::words::files::w;
use crate::app::words::fill;
use crate::document::RawVoxels;

/// The dialog, if a load asks.
pub(crate) fn ui(ui: &Ui, session: &Session, commands: &mut Vec<Command>) {
    let Some(draft) = session.raw_draft() else {
        return;
    };
    let mut voxels = draft.voxels.clone();
    let (mut is_opened, mut is_cancelled) = (false, false);
    let width = (ui.ctx().content_rect().width() - 48.0).min(380.0);
    let modal = Modal::new(Id::unique("raw"))
        .frame(egui::Frame::window(ui.style()))
        .show(ui.ctx(), |ui| {
            ui.set_width(width);
            widget::heading(ui, w().bare, |_| {});
            let weak = Palette::get(ui).weak;
            ui.label(RichText::new(w().bare_hint).small().color(weak));
            ui.add_space(6.0);
            fields_ui(ui, &mut voxels);
            ui.add_space(6.0);
            let fit = draft.fit();
            let palette = Palette::get(ui);
            let (text, color) = match fit {
                Fit::Exact => (w().fits.to_owned(), palette.accent),
                Fit::Over(n) => (fill(w().over, &[&n]), palette.warning),
                Fit::Under(n) => (fill(w().under, &[&n]), palette.danger),
                Fit::Unknown => (w().packed.to_owned(), weak),
                Fit::TooLarge => (w().too_large.to_owned(), palette.danger),
            };
            ui.label(RichText::new(text).color(color));
            ui.add_space(6.0);
            widget::row(ui, |ui| {
                let is_possible = !matches!(fit, Fit::Under(_) | Fit::TooLarge);
                is_opened = ui
                    .add_enabled(is_possible, egui::Button::new(w().open))
                    .clicked();
                is_cancelled = ui.button(w().cancel).clicked();
            });
        });
    is_cancelled |= modal.should_close() && !is_opened;
    if voxels != draft.voxels {
        commands.push(Command::Raw(RawCommand::Change(voxels)));
    }
    if is_opened {
        commands.push(Command::Raw(RawCommand::Open));
    } else if is_cancelled {
        commands.push(Command::Raw(RawCommand::Cancel));
    }
}

fn fields_ui(ui: &mut Ui, voxels: &mut RawVoxels) {
    let names = [w().width, w().height, w().depth];
    widget::row(ui, |ui| {
        ui.label(w().voxels);
        for (side, name) in voxels.size.iter_mut().zip(names) {
            named(ui, name, |ui| {
                ui.add(DragValue::new(side).range(1..=65_536))
            });
        }
    });
    widget::row(ui, |ui| {
        let label = ui.label(w().kind);
        let selected = voxels.element;
        ComboBox::from_id_salt("raw type")
            .selected_text(selected)
            .show_ui(ui, |ui| {
                for element in RawVoxels::ELEMENTS {
                    ui.selectable_value(&mut voxels.element, element, element);
                }
            })
            .response
            .labelled_by(label.id);
        ui.checkbox(&mut voxels.big_endian, w().high_byte_first);
    });
    widget::row(ui, |ui| {
        let label = ui.label(w().skip);
        ui.add(DragValue::new(&mut voxels.skip_bytes).range(0..=1_u64 << 40))
            .labelled_by(label.id);
    });
    widget::row(ui, |ui| {
        ui.label(w().voxel_size);
        for (edge, name) in voxels.spacing_mm.iter_mut().zip(names) {
            let value = DragValue::new(edge).range(1e-3..=1e3).speed(0.01);
            named(ui, &fill(w().edge, &[&name]), |ui| ui.add(value));
        }
    });
}

/// A control without a text of its own, named for screen readers and on hover.
fn named(ui: &mut Ui, name: &str, add: impl FnOnce(&mut Ui) -> egui::Response) {
    let response = add(ui).on_hover_text(name);
    ui.ctx().accesskit_node_builder(response.id, |node| {
        node.set_label(name.to_owned());
    });
}
