//! Where everything stands: bar, catalogue, picture and panels in a wide window, picture and drawers in a narrow one.

use egui::{CentralPanel, Frame, Margin, Panel, ScrollArea, Ui, Vec2, vec2};

use crate::app::canvas::foot::Foot;
use crate::app::canvas::panes::{self, Places};
use crate::app::canvas::provisional as provisional_line;
use crate::app::canvas::{hint, title, view_bar};
use crate::app::kit::icon::Icon;
use crate::app::kit::theme::{self, Palette};
use crate::app::kit::widget;
use crate::app::panel::{catalogue, look, notice, strip, templates, text, tissue, topbar};
use crate::app::picture::host::Picture;
use crate::app::session::{Command, Focus, Tab};
use crate::app::window::App;
use crate::app::words;

/// Width of the catalogue and of the panel at the right.
const CATALOGUE_WIDTH: f32 = 218.0;
const SIDE_WIDTH: f32 = 304.0;

impl App {
    /// Bar, catalogue, picture and panel beside each other.
    pub(crate) fn wide_ui(&mut self, ui: &mut Ui, commands: &mut Vec<Command>) {
        // Everything has a place of its own.
        self.session.tab = None;
        let palette = Palette::get(ui);
        if !self.session.are_panels_hidden {
            let bar = Frame::new()
                .fill(palette.panel)
                .inner_margin(Margin::symmetric(12, 0));
            Panel::top("top")
                .exact_size(46.0)
                .frame(bar)
                .show(ui, |ui| {
                    widget::directed(ui, |ui| topbar::ui(ui, &self.session, false, commands));
                });
            let side = Frame::new().fill(palette.panel).inner_margin(Margin {
                left: 12,
                right: 6,
                top: 8,
                bottom: 8,
            });
            let (first, last) = if words::is_rtl() {
                (Panel::right("catalogue"), Panel::left("side"))
            } else {
                (Panel::left("catalogue"), Panel::right("side"))
            };
            first
                .exact_size(CATALOGUE_WIDTH)
                .resizable(false)
                .frame(side)
                .show(ui, |ui| {
                    widget::directed(ui, |ui| widget::heading(ui, words::bar::w().add, |_| {}));
                    scroll(ui, Tab::Add, |ui| {
                        catalogue::ui(ui, &self.session, &self.icons, self.focus, commands)
                    });
                });
            last.exact_size(SIDE_WIDTH)
                .resizable(false)
                .frame(side)
                .show(ui, |ui| {
                    ui.horizontal(|ui| {
                        ui.set_max_width(ui.available_width() - 8.0);
                        let w = words::bar::w();
                        let tabs = [
                            (Tab::Templates, self.making_name()),
                            (Tab::Tissues, w.tissues),
                            (Tab::Look, w.look),
                            (Tab::Text, w.text),
                        ];
                        if self.focus.take_if(|focus| *focus == Focus::Panel).is_some() {
                            widget::focus_chosen(ui, w.panel);
                        }
                        if let Some(tab) =
                            widget::segmented(ui, w.panel, &tabs, self.session.side_tab)
                        {
                            self.session.side_tab = tab;
                            // Whoever comes with the mouse to a document without a title types one at once. Keys go
                            // on through the panels, and fingers are not to meet a keyboard that they did not ask for.
                            let is_by_mouse =
                                !theme::is_touch() && ui.input(|i| i.pointer.any_released());
                            let has_title = !self.session.illustration().title.is_empty();
                            if tab == Tab::Text && is_by_mouse && !has_title {
                                self.focus = Some(Focus::Title);
                            }
                        }
                    });
                    ui.add_space(6.0);
                    let tab = self.session.side_tab;
                    scroll(ui, tab, |ui| self.tab_ui(ui, tab, commands));
                });
        }
        if self.session.side_tab != Tab::Tissues {
            self.session.end_tissues();
        }
        self.picture_ui(ui, commands);
    }

    /// What the panel of templates is called: with a figure it holds regions and handles.
    fn making_name(&self) -> &'static str {
        match self.session.view.is_figure() {
            true => words::figure::w().tab,
            false => words::bar::w().templates,
        }
    }

    /// The picture under the bar, and drawers over it.
    pub(crate) fn narrow_ui(&mut self, ui: &mut Ui, commands: &mut Vec<Command>) {
        let palette = Palette::get(ui);
        if !self.session.are_panels_hidden {
            let bar = Frame::new()
                .fill(palette.panel)
                .inner_margin(Margin::symmetric(8, 0));
            Panel::top("top")
                .exact_size(48.0)
                .frame(bar)
                .show(ui, |ui| {
                    widget::directed(ui, |ui| topbar::ui(ui, &self.session, true, commands));
                });
            let tabs = Frame::new()
                .fill(palette.panel)
                .inner_margin(Margin::symmetric(4, 2));
            Panel::bottom("tabs")
                .exact_size(56.0)
                .frame(tabs)
                .show(ui, |ui| {
                    widget::directed(ui, |ui| self.tabs_ui(ui));
                });
            let drawer = Frame::new().fill(palette.panel).inner_margin(Margin {
                left: 14,
                right: 8,
                top: 8,
                bottom: 8,
            });
            if let Some(tab) = self.session.tab {
                let height = (ui.available_height() * 0.52).clamp(180.0, 420.0);
                Panel::bottom("drawer")
                    .exact_size(height)
                    .resizable(false)
                    .frame(drawer)
                    .show(ui, |ui| {
                        scroll(ui, tab, |ui| match tab {
                            Tab::Add => {
                                catalogue::ui(ui, &self.session, &self.icons, self.focus, commands)
                            }
                            _ => self.tab_ui(ui, tab, commands),
                        });
                    });
            }
        }
        if self.session.tab.is_some_and(|tab| tab != Tab::Tissues) {
            self.session.end_tissues();
        }
        self.picture_ui(ui, commands);
    }

    /// The picture, the slices beside it, and what floats over both.
    fn picture_ui(&mut self, ui: &mut Ui, commands: &mut Vec<Command>) {
        let provisional = self.provisional(ui.ctx());
        let is_earlier = self.shows_earlier_object();
        if strip::is_shown(&self.session, ui.ctx().content_rect().height()) {
            let fill = Palette::get(ui).panel;
            let frame = Frame::new()
                .fill(fill)
                .inner_margin(Margin::symmetric(8, 2));
            Panel::bottom("strip")
                .exact_size(strip::height())
                .resizable(false)
                .frame(frame)
                .show(ui, |ui| {
                    let pictures = &mut self.step_pictures;
                    widget::directed(ui, |ui| strip::ui(ui, &self.session, pictures, commands));
                });
        } else {
            strip::put_away(&mut self.step_pictures);
        }
        CentralPanel::default().frame(Frame::new()).show(ui, |ui| {
            let session = &self.session;
            let rect = ui.available_rect_before_wrap();
            let foot = Foot::new(ui, rect, session);
            let panes = foot.panes(rect, session);
            let places = Places::new(panes, &session.view);
            let palette = Palette::get(ui);
            ui.painter().rect_filled(rect, 0.0, palette.panel);
            ui.painter().rect_filled(panes, 0.0, palette.line);
            let picture = self.picture.as_mut();
            self.viewport.is_earlier = is_earlier;
            self.viewport
                .ui(ui, places.picture, session, picture, commands);
            if let Some(picture) = places.picture {
                let head = title::head_ui(ui, picture, session);
                if let Some(text) = provisional {
                    provisional_line::ui(ui, picture, head, text);
                }
            }
            places.tabs_ui(ui, &session.view, commands);
            let picture = self.picture.as_mut();
            self.slices.ui(ui, &places, session, picture, commands);
            foot.ui(ui, rect, session, commands);
            let hint = hint::ui(ui, rect, session, commands);
            let floor = foot.top().or(hint.map(|card| card.top()));
            let area = view_bar::for_messages(panes);
            notice::ui(ui, area, floor, session, commands);
            if session.are_panels_hidden {
                title::way_back_ui(ui, rect, commands);
            }
            if ui.input(|i| !i.raw.hovered_files.is_empty()) {
                panes::drop_hint_ui(ui, rect);
            }
        });
    }

    fn tab_ui(&mut self, ui: &mut Ui, tab: Tab, commands: &mut Vec<Command>) {
        match tab {
            Tab::Add | Tab::Templates => {
                let segments = self.picture.as_ref().map_or(&[][..], Picture::segments);
                let template = self.session.selected_template();
                let inside = self.inside.names(template, segments);
                templates::ui(ui, &self.session, segments, inside, commands);
            }
            Tab::Tissues => {
                let segments = self.picture.as_ref().map_or(&[][..], Picture::segments);
                let info = self.picture.as_ref().and_then(Picture::subject_info);
                let scan = info.as_ref().map(|info| (info, self.transfer.histogram()));
                tissue::ui(ui, &self.session, segments, scan, self.focus, commands);
            }
            Tab::Look => {
                let info = self.picture.as_ref().and_then(Picture::subject_info);
                look::ui(
                    ui,
                    &self.session,
                    info.as_ref(),
                    &mut self.transfer,
                    &mut self.preset_pictures,
                    commands,
                );
            }
            Tab::Text => text::ui(ui, &self.session, &mut self.focus, commands),
        }
    }

    /// The row of drawers at the bottom of a narrow window.
    fn tabs_ui(&mut self, ui: &mut Ui) {
        let palette = Palette::get(ui);
        let w = words::bar::w();
        let tabs = [
            (Tab::Add, Icon::Plus, w.add),
            (Tab::Templates, Icon::Layers, self.making_name()),
            (Tab::Tissues, Icon::Tissue, w.tissues),
            (Tab::Look, Icon::Look, w.look),
            (Tab::Text, Icon::Text, w.text),
        ];
        let size = vec2(
            ui.available_width() / tabs.len() as f32,
            ui.available_height(),
        );
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing = Vec2::ZERO;
            for (tab, icon, name) in tabs {
                let (rect, response) = ui.allocate_exact_size(size, egui::Sense::click());
                let is_open = self.session.tab == Some(tab);
                response.widget_info(|| {
                    egui::WidgetInfo::selected(egui::Role::Button, ui.is_enabled(), is_open, name)
                });
                if is_open && self.focus.take_if(|focus| *focus == Focus::Panel).is_some() {
                    response.request_focus();
                }
                let color = if is_open {
                    palette.accent
                } else {
                    palette.weak
                };
                let inner = rect.shrink2(vec2(4.0, 3.0));
                if is_open {
                    ui.painter().rect_filled(inner, 8.0, palette.accent_wash);
                }
                widget::focus_ring(ui, &response, inner);
                let spot =
                    egui::Rect::from_center_size(rect.center() - vec2(0.0, 8.0), Vec2::splat(22.0));
                icon.paint(ui.painter(), spot, color);
                let at = rect.center() + vec2(0.0, 13.0);
                ui.painter().text(
                    at,
                    egui::Align2::CENTER_CENTER,
                    name,
                    egui::FontId::proportional(11.5),
                    color,
                );
                if response.clicked() {
                    self.session.tab = if is_open { None } else { Some(tab) };
                }
            }
        });
    }
}

/// Contents of the panel, scrolled when they do not fit, with room for the bar at the right. Each panel keeps its own
/// place: another one in the same drawer begins at its top.
fn scroll(ui: &mut Ui, panel: Tab, contents: impl FnOnce(&mut Ui)) {
    let area = ScrollArea::vertical().id_salt(panel).auto_shrink(false);
    area.show(ui, |ui| {
        ui.set_max_width(ui.available_width() - 8.0);
        widget::directed(ui, contents);
        ui.add_space(12.0);
    });
}
