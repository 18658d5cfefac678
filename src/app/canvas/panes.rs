//! Where the picture and the slices lie: the picture alone, all four, or, where there is room for one only, one with
//! tabs.
//!
//! ```text
//!   axial  (from below)   picture
//!   coronal (from front)  sagittal (from the left)
//! ```

use egui::{Align2, CornerRadius, Rect, Stroke, Ui, UiBuilder, Vec2, vec2};

use super::slice_plot::SLICES;
use crate::app::kit::float::float_frame;
use crate::app::kit::theme::Palette;
use crate::app::kit::{theme, widget};
use crate::app::session::{Command, Pane, See, ViewState};
use crate::app::words;
use crate::app::words::slices::w;

/// Gap between two panes, points.
const GAP: f32 = 2.0;
/// Width below which there is room for one pane only.
pub(crate) const ONE_PANE: f32 = 560.0;

/// What a pane is called.
pub(crate) fn pane_name(pane: Pane) -> &'static str {
    match pane {
        Pane::Picture => w().picture,
        Pane::Axial => w().axial,
        Pane::Coronal => w().coronal,
        Pane::Sagittal => w().sagittal,
    }
}

/// Where the panes lie.
pub(crate) struct Places {
    /// The picture's, if it is seen.
    pub picture: Option<Rect>,
    /// The slices', in the order of [`SLICES`].
    pub slices: [Option<Rect>; 3],
    tabs: Option<Rect>,
}

impl Places {
    /// In a rectangle of the window.
    pub(crate) fn new(rect: Rect, view: &ViewState) -> Self {
        let mut places = Self {
            picture: Some(rect),
            slices: [None; 3],
            tabs: None,
        };
        if !view.is_split {
            return places;
        }
        let is_narrow = rect.width() < ONE_PANE;
        let mut inner = rect;
        if is_narrow {
            let tabs = theme::control_height() + 12.0;
            places.tabs = Some(rect.with_max_y(rect.top() + tabs));
            inner.min.y += tabs;
        }
        let alone = view.expanded.or(is_narrow.then_some(Pane::Picture));
        let place = |pane: Pane| match alone {
            Some(only) => (only == pane).then_some(inner),
            None => {
                let i = Pane::ALL.iter().position(|p| *p == pane).unwrap_or(0);
                let size = 0.5 * (inner.size() - Vec2::splat(GAP));
                let step = size + Vec2::splat(GAP);
                let at = inner.min + vec2((i % 2) as f32 * step.x, (i / 2) as f32 * step.y);
                Some(Rect::from_min_size(at, size))
            }
        };
        places.picture = place(Pane::Picture);
        places.slices = [0, 1, 2].map(|i: usize| place(SLICES[i].pane));
        places
    }
}

/// Which pane is shown, where there is room for one only.
impl Places {
    pub(crate) fn tabs_ui(&self, ui: &mut Ui, view: &ViewState, commands: &mut Vec<Command>) {
        let Some(rect) = self.tabs else {
            return;
        };
        float_frame(ui, rect);
        let mut inner = ui.new_child(
            UiBuilder::new()
                .id_salt("panes")
                .max_rect(rect.shrink2(vec2(8.0, 6.0))),
        );
        let options = [Pane::Picture, Pane::Axial, Pane::Coronal, Pane::Sagittal]
            .map(|pane| (pane, pane_name(pane)));
        let current = view.expanded.unwrap_or(Pane::Picture);
        if let Some(pane) = widget::segmented(&mut inner, w().pane, &options, current) {
            commands.push(Command::See(See::Expand(Some(pane))));
        }
    }
}

/// Over everything while a file is held over the window.
pub(crate) fn drop_hint_ui(ui: &Ui, rect: Rect) {
    let palette = Palette::get(ui);
    let painter = ui.painter_at(rect);
    let frame = rect.shrink(10.0);
    painter.rect_filled(rect, 0.0, palette.float.gamma_multiply(0.85));
    let stroke = Stroke::new(2.0, palette.accent);
    painter.rect_stroke(
        frame,
        CornerRadius::same(12),
        stroke,
        egui::StrokeKind::Inside,
    );
    let text = words::picture::w().drop_here;
    painter.text(
        rect.center(),
        Align2::CENTER_CENTER,
        text,
        theme::strong_font(15.0),
        palette.text,
    );
}
