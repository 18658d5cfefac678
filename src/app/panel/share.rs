//! The dialog that shares the illustration: link, QR code, HTML for a page, files.

use egui::{Color32, ColorImage, Image, Role, TextureHandle, TextureOptions, Ui, WidgetInfo};

use crate::app::kit::dialog;
use crate::app::kit::icon::Icon;
use crate::app::kit::theme::Palette;
use crate::app::kit::widget;
use crate::app::session::{Command, PicturePaper, Session};
use crate::app::words::share::w;
use crate::app::words::{bar, fill, text};
use crate::describe::Snippet;
use crate::link::{DENSE_QR, LONGEST_QR, Qr};

/// Sizes of saved pictures that are offered: pixels along the longer side.
const SIZES: [(u32, &str); 4] = [
    (1000, "1000"),
    (2000, "2000"),
    (4000, "4000"),
    (8000, "8000"),
];
/// Dots per inch that are offered.
const DPI: [(u32, &str); 3] = [(150, "150"), (300, "300"), (600, "600")];
const CM_PER_INCH: f32 = 2.54;
/// Points along the side of the QR code.
const CODE: f32 = 220.0;

/// The code of the address that was shown last.
#[derive(Default)]
pub(crate) struct Share {
    address: String,
    code: Option<TextureHandle>,
}

impl Share {
    /// The picture of the code; `None` for an address that is too long. Made anew where the address is another one.
    fn code(&mut self, ui: &Ui, address: &str) -> Option<&TextureHandle> {
        if self.address != address {
            address.clone_into(&mut self.address);
            self.code = Qr::of(address).ok().map(|qr| {
                let (side, gray) = qr.to_gray(1);
                let pixels = ColorImage::from_gray([side; 2], &gray);
                ui.ctx().load_texture("qr", pixels, TextureOptions::NEAREST)
            });
        }
        self.code.as_ref()
    }
}

/// The dialog over everything. `page` is the address of the page, which a window may not have.
pub(crate) fn ui(
    ui: &Ui,
    session: &Session,
    share: &mut Share,
    page: &str,
    commands: &mut Vec<Command>,
) {
    let names = (w().heading, w().close);
    let is_closed = dialog::is_closed(ui, "share", names, 360.0, |ui| {
        inside(ui, session, share, page, commands);
    });
    if is_closed {
        commands.push(Command::ToggleShare);
    }
}

fn inside(
    ui: &mut Ui,
    session: &Session,
    share: &mut Share,
    page: &str,
    commands: &mut Vec<Command>,
) {
    let page = page.split('#').next().unwrap_or_default();
    let address = format!("{page}#{}", session.link_tail());
    ui.label(fill(w().length, &[&address.chars().count()]));
    if session.is_link_long() {
        warning(ui, w().long);
    }
    if session.needs_own_file() {
        warning(ui, w().local);
    }
    if page.is_empty() {
        warning(ui, w().no_page);
    }
    button(
        ui,
        Icon::Link,
        bar::w().copy_link,
        "",
        Command::CopyLink,
        commands,
    );
    widget::divider(ui);
    match share.code(ui, &address) {
        Some(code) => {
            ui.vertical_centered(|ui| {
                let image =
                    ui.add(Image::new((code.id(), egui::Vec2::splat(CODE))).tint(Color32::WHITE));
                image.widget_info(|| WidgetInfo::labeled(Role::Image, true, w().qr));
            });
            if address.len() > DENSE_QR {
                warning(ui, w().qr_dense);
            }
        }
        None => warning(ui, &fill(w().qr_none, &[&LONGEST_QR])),
    }
    widget::divider(ui);
    widget::heading(ui, w().for_pages, |_| {});
    for (form, name, hint) in [
        (Snippet::Element, w().element, w().element_hint),
        (Snippet::Frame, w().frame, w().frame_hint),
        (Snippet::Plain, w().plain, w().plain_hint),
    ] {
        button(
            ui,
            Icon::Copy,
            name,
            hint,
            Command::CopySnippet(form),
            commands,
        );
    }
    widget::divider(ui);
    widget::heading(ui, w().files, |_| {});
    let bar = bar::w();
    button(
        ui,
        Icon::Download,
        bar.save_document,
        "",
        Command::SaveDocument,
        commands,
    );
    ui.label(w().size);
    let mut sizes = vec![(None, w().automatic)];
    sizes.extend(SIZES.map(|(px, text)| (Some(px), text)));
    if let Some(size) = widget::segmented(ui, w().size, &sizes, session.picture_px) {
        commands.push(Command::SetPictureSize(size));
    }
    ui.label(w().dpi);
    if let Some(dpi) = widget::segmented(ui, w().dpi, &DPI, session.picture_dpi) {
        commands.push(Command::SetPictureDpi(dpi));
    }
    if let Some(px) = session.picture_px {
        let cm = px as f32 / session.picture_dpi as f32 * CM_PER_INCH;
        ui.label(fill(w().printed, &[&format!("{cm:.1}")]));
    }
    ui.label(w().paper);
    let papers = [
        (
            PicturePaper::Background,
            w().paper_background,
            w().paper_background_hint,
        ),
        (PicturePaper::Clear, w().paper_clear, w().paper_clear_hint),
        (
            PicturePaper::Shadow,
            w().paper_shadow,
            w().paper_shadow_hint,
        ),
        (
            PicturePaper::ClearShadow,
            w().paper_clear_shadow,
            w().paper_clear_shadow_hint,
        ),
    ];
    if let Some(paper) = widget::explained(ui, w().paper, &papers, session.picture_paper) {
        commands.push(Command::SetPicturePaper(paper));
    }
    let mut is_lettering = session.is_lettering;
    if ui
        .checkbox(&mut is_lettering, text::w().lettering)
        .changed()
    {
        commands.push(Command::ToggleLettering);
    }
    button(
        ui,
        Icon::Picture,
        bar.save_picture,
        "",
        Command::SavePicture,
        commands,
    );
}

fn button(
    ui: &mut Ui,
    icon: Icon,
    name: &str,
    hint: &str,
    command: Command,
    commands: &mut Vec<Command>,
) {
    let hint = if hint.is_empty() { name } else { hint };
    if widget::labelled_button(ui, icon, name, false, true)
        .on_hover_text(hint)
        .clicked()
    {
        commands.push(command);
    }
}

fn warning(ui: &mut Ui, text: &str) {
    let color = Palette::get(ui).warning;
    ui.label(egui::RichText::new(text).color(color));
}
