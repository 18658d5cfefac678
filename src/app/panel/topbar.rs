//! The bar along the top: name of the subject, undo, files, and the link.

use egui::Ui;

use crate::app::kit::icon::Icon;
use crate::app::kit::menu::menu_item;
use crate::app::kit::theme::{self, Palette};
use crate::app::kit::widget::{self, Named as _};
use crate::app::session::{ClayCommand, Command, LibraryCommand, Session};
use crate::app::words::bar::w;
use crate::app::words::{self, Lang, facts, fill, names};
use crate::clay::MeshFormat;
use crate::document::{ClayShape, ClayStart, SubjectRef, newest_revision};

/// Width of the bar in points from which on the examples have a button in it; else they are in the menu.
const EXAMPLES_WIDTH: f32 = 880.0;

/// The bar. `is_narrow` leaves words out.
pub(crate) fn ui(ui: &mut Ui, session: &Session, is_narrow: bool, commands: &mut Vec<Command>) {
    let palette = Palette::get(ui);
    let has_examples = ui.available_width() >= EXAMPLES_WIDTH;
    ui.horizontal_centered(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        if !is_narrow {
            ui.add(egui::Label::new(
                theme::strong("Fabrica").size(16.0).color(palette.text),
            ));
            ui.add_space(10.0);
        }
        subject_ui(ui, session, commands);
        if !is_narrow {
            let about = widget::icon_button(ui, Icon::Info, facts::w().about, has_facts(session));
            egui::Popup::menu(&about).show(|ui| facts_ui(ui, session));
        }
        if !is_narrow
            && widget::labelled_button(ui, Icon::Folder, w().open, false, true)
                .on_hover_text(w().open_hint)
                .clicked()
        {
            commands.push(Command::Open);
        }
        if has_examples
            && widget::labelled_button(ui, Icon::Book, words::library::w().examples, false, true)
                .on_hover_text(words::library::w().examples_hint)
                .clicked()
        {
            commands.push(Command::Library(LibraryCommand::Toggle));
        }
        ui.add_space(if is_narrow { 0.0 } else { 8.0 });
        let undo = session.history.undo_name().map(str::to_owned);
        let redo = session.history.redo_name().map(str::to_owned);
        let name = undo.as_ref().map_or_else(
            || w().undo.to_owned(),
            |what| fill(w().undo_what, &[&names::edit_title(what)]),
        );
        let is_enabled = undo.is_some() || !session.together.ghosts.is_empty();
        let response = widget::icon_button(ui, Icon::Undo, &name, is_enabled);
        if response.accessible_name(w().undo).clicked() {
            commands.push(Command::Undo);
        }
        let name = redo.as_ref().map_or_else(
            || w().redo.to_owned(),
            |what| fill(w().redo_what, &[&names::edit_title(what)]),
        );
        let is_enabled = redo.is_some() || session.together.has_taken_back();
        let response = widget::icon_button(ui, Icon::Redo, &name, is_enabled);
        if response.accessible_name(w().redo).clicked() {
            commands.push(Command::Redo);
        }

        ui.with_layout(widget::against(), |ui| {
            more_menu(ui, session, is_narrow, has_examples, commands);
            let is_copied = session.copied_at.is_some();
            let (icon, text) = match (is_copied, is_narrow) {
                (true, _) => (Icon::Check, w().copied),
                (false, true) => (Icon::Link, w().link),
                (false, false) => (Icon::Link, w().copy_link),
            };
            let button = widget::labelled_button(ui, icon, text, true, true);
            let length = session.payload.len();
            let hint = fill(w().link_hint, &[&length]);
            if button
                .accessible_name(w().copy_link)
                .on_hover_text(hint)
                .clicked()
            {
                commands.push(Command::CopyLink);
            }
            if !is_narrow {
                link_length_ui(ui, session, commands);
            }
        });
    });
}

/// The length of the link, and advice if the link is long.
fn link_length_ui(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    let length = session.payload.len();
    let palette = Palette::get(ui);
    if session.is_link_long() {
        let text = theme::strong(fill(w().link_of, &[&length]))
            .size(12.0)
            .color(palette.warning);
        let advice = w().link_is_long;
        if ui
            .add(egui::Button::new(text).frame(false))
            .on_hover_text(advice)
            .clicked()
        {
            commands.push(Command::SaveDocument);
        }
    } else {
        let text = egui::RichText::new(fill(w().link_of, &[&length]))
            .size(12.0)
            .color(palette.weak);
        ui.label(text).on_hover_text(w().link_length);
    }
    ui.add_space(4.0);
}

/// Which subject: the built-in ones, and opening one's own.
fn subject_ui(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    let current = &session.illustration().subject;
    let shown = widget::combo(
        "subject",
        &names::subject_title(session.illustration()),
        112.0,
    )
    .show_ui(ui, |ui| {
        for name in crate::subjects::all_names() {
            let is_shown =
                matches!(current, SubjectRef::Builtin { name: shown, .. } if shown == name);
            if ui
                .selectable_label(is_shown, names::subject(name))
                .clicked()
                && !is_shown
            {
                commands.push(Command::SetSubject(SubjectRef::newest(name)));
            }
        }
        if let SubjectRef::Builtin { name, revision } = current
            && *revision < newest_revision(name)
        {
            ui.separator();
            let title = fill(w().newer_subject, &[&names::subject(name)]);
            let newer = ui.selectable_label(false, title);
            if newer.on_hover_text(w().newer_subject_hint).clicked() {
                commands.push(Command::SetSubject(SubjectRef::newest(name)));
            }
        }
        ui.separator();
        let clay = words::clay::w();
        let titles = [clay.ball, clay.cube, clay.plate, clay.torus];
        for (shape, title) in ClayShape::ALL.into_iter().zip(titles) {
            if ui.selectable_label(false, title).clicked() {
                let begin = ClayCommand::Begin(ClayStart::Shape(shape));
                commands.push(Command::Clay(begin));
            }
        }
        ui.separator();
        if ui.button(w().open_file_more).clicked() {
            commands.push(Command::Open);
            ui.close();
        }
    });
    shown
        .response
        .named(w().subject)
        .on_hover_text(w().subject_hint);
}

fn more_menu(
    ui: &mut Ui,
    session: &Session,
    is_narrow: bool,
    has_examples: bool,
    commands: &mut Vec<Command>,
) {
    let button = widget::icon_button(ui, Icon::More, w().more, true);
    egui::Popup::menu(&button).show(|ui| {
        // The row of languages takes all the width that there is.
        ui.set_width(264.0);
        let mut item = |ui: &mut Ui, icon: Icon, text: &str, command: Command| {
            if menu_item(ui, icon, text) {
                commands.push(command);
                ui.close();
            }
        };
        if is_narrow {
            item(ui, Icon::Folder, w().open_file, Command::Open);
        }
        if !has_examples {
            let command = Command::Library(LibraryCommand::Toggle);
            item(ui, Icon::Book, words::library::w().examples, command);
        }
        item(ui, Icon::Plus, w().new_document, Command::New);
        let share = words::share::w().share;
        item(ui, Icon::Link, share, Command::ToggleShare);
        item(ui, Icon::Download, w().save_document, Command::SaveDocument);
        let formats = MeshFormat::ALL.into_iter();
        for format in formats.filter(|_| session.has_mesh_to_save()) {
            let end = format.extension().to_uppercase();
            let text = fill(w().save_mesh, &[&end]);
            item(ui, Icon::Download, &text, Command::SaveMesh(format));
        }
        item(ui, Icon::Picture, w().save_picture, Command::SavePicture);
        ui.separator();
        item(ui, Icon::Eye, w().picture_alone, Command::TogglePanels);
        let theme = match ui.theme() {
            egui::Theme::Dark => w().theme_light,
            egui::Theme::Light => w().theme_dark,
        };
        item(ui, Icon::Contrast, theme, Command::ToggleTheme);
        let contrast = if theme::has_contrast() {
            w().usual_contrast
        } else {
            w().high_contrast
        };
        item(ui, Icon::Look, contrast, Command::ToggleContrast);
        item(ui, Icon::Plus, w().larger, Command::Scale(1.15));
        item(ui, Icon::Reset, w().smaller, Command::Scale(1.0 / 1.15));
        ui.separator();
        ui.label(
            egui::RichText::new(w().language)
                .small()
                .color(Palette::get(ui).weak),
        );
        let languages = Lang::OFFERED.map(|lang| {
            let name = lang.own_name();
            let is_drawn = theme::can_draw(ui, name);
            (lang, if is_drawn { name } else { lang.plain_name() })
        });
        if let Some(lang) = widget::segmented(ui, w().language, &languages, words::lang()) {
            commands.push(Command::Speak(lang));
        }
        ui.separator();
        let mut item = |ui: &mut Ui, icon: Icon, text: &str, command: Command| {
            if menu_item(ui, icon, text) {
                commands.push(command);
                ui.close();
            }
        };
        item(ui, Icon::Info, w().messages, Command::ToggleMessages);
        item(ui, Icon::Help, w().keys, Command::ToggleKeys);
        if is_narrow {
            ui.separator();
            let length = session.payload.len();
            let weak = Palette::get(ui).weak;
            ui.label(
                egui::RichText::new(fill(w().link_of, &[&length]))
                    .small()
                    .color(weak),
            );
            if has_facts(session) {
                ui.separator();
                facts_ui(ui, session);
            }
        }
    });
}

fn has_facts(session: &Session) -> bool {
    let facts = session.view.subject.as_ref();
    facts.is_some_and(|facts| facts.scan.is_some())
}

/// What is known of the scan: name, modality, voxels, spacing, size, values, segments. Nothing here names a patient,
/// for no reader takes such a name in.
fn facts_ui(ui: &mut Ui, session: &Session) {
    let Some((facts, scan)) = session
        .view
        .subject
        .as_ref()
        .and_then(|f| Some((f, f.scan.as_ref()?)))
    else {
        return;
    };
    ui.set_min_width(230.0);
    let w = facts::w();
    let number = |value: f64, decimals: usize| widget::plain(value, decimals);
    let mm = |lengths: [f64; 3], decimals: usize| {
        let [x, y, z] = lengths.map(|length| number(length, decimals));
        format!("{x} × {y} × {z} mm")
    };
    let [x, y, z] = scan.dims;
    let sizes = std::array::from_fn(|i| f64::from(scan.dims[i]) * scan.spacing_mm[i]);
    let [low, high] = scan.value_range.map(|value| number(f64::from(value), 1));
    let count = facts.segments.len().to_string();
    let modality = scan.modality.as_deref().map(facts::modality);
    let lines = [
        Some((w.name, names::subject_title(session.illustration()))),
        modality.map(|modality| (w.modality, modality.to_owned())),
        Some((w.voxels, format!("{x} × {y} × {z}"))),
        Some((w.spacing, mm(scan.spacing_mm, 3))),
        Some((w.size, mm(sizes, 1))),
        Some((w.values, fill(w.from_to, &[&low, &high]))),
        Some((w.segments, count)),
    ];
    egui::Grid::new("facts of the scan")
        .num_columns(2)
        .spacing(egui::vec2(14.0, 4.0))
        .show(ui, |ui| {
            for (name, value) in lines.into_iter().flatten() {
                ui.label(theme::strong(name).size(12.5));
                ui.label(value);
                ui.end_row();
            }
        });
}
