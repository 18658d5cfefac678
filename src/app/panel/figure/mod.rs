//! Making a figure: tools in place of the catalogue, and in place of templates its regions, its handles and what holds
//! for the whole.

mod handles;
mod material;
mod number;
pub(crate) mod reference;
mod region;
mod regions;
mod tools;
mod whole;

use egui::Ui;

pub(super) use self::tools::ui as tools_ui;
use crate::app::kit::widget;
use crate::app::session::{Command, Session};

/// Regions and handles, what is selected of them, and what holds for the whole figure.
pub(super) fn ui(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    handles::list_ui(ui, session, commands);
    handles::selected_ui(ui, session, commands);
    widget::divider(ui);
    regions::list_ui(ui, session, commands);
    region::selected_ui(ui, session, commands);
    widget::divider(ui);
    whole::ui(ui, session, commands);
}
