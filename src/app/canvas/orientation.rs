//! Where the patient's sides are: letters at the edges of the picture as on a radiograph, and a small ball of axes that
//! turns with the camera and is tapped to look from a side. And how large the object is: a scale bar.

use egui::{Align2, Color32, Painter, Pos2, Rect, Role, Sense, Stroke, Ui, Vec2, WidgetInfo, vec2};

use crate::app::canvas::projection::Projection;
use crate::app::kit::theme::{self, Palette};
use crate::app::session::Command;
use crate::app::session::Session;
use crate::app::session::StandardView;
use crate::app::words::fill;
use crate::app::words::picture::w;
use crate::describe::side_letters;
use crate::render::ScaleBar;

/// Points of the ball's radius.
const BALL: f32 = 34.0;

/// Letters at the middles of the four edges.
pub(crate) fn edges_ui(painter: &Painter, view: &Projection, color: Color32, inner: Rect) {
    let font = theme::strong_font(13.0);
    let at = [
        (inner.left_center() + vec2(14.0, 0.0), -view.right),
        (inner.right_center() - vec2(14.0, 0.0), view.right),
        (inner.center_top() + vec2(0.0, 14.0), view.up),
        (inner.center_bottom() - vec2(0.0, 14.0), -view.up),
    ];
    for (pos, direction) in at {
        painter.text(
            pos,
            Align2::CENTER_CENTER,
            side_letters(direction),
            font.clone(),
            color,
        );
    }
}

/// A scale bar whose right end is at a place. Nothing where nobody knows how large the object is.
pub(crate) fn bar_ui(painter: &Painter, session: &Session, rect: Rect, color: Color32, end: Pos2) {
    let size = [rect.width(), rect.height()].map(|side| side.round().max(1.0) as u32);
    let mm_per_unit = session.view.known_mm_per_unit();
    let bar = mm_per_unit.and_then(|mm| ScaleBar::of(&session.camera, size, mm));
    let Some(bar) = bar.filter(|_| session.shown().look.scale_bar) else {
        return;
    };
    let start = end - vec2(bar.length_px, 0.0);
    let stroke = Stroke::new(2.0, color);
    painter.line_segment([start, end], stroke);
    for tip in [start + vec2(1.0, 0.0), end - vec2(1.0, 0.0)] {
        painter.line_segment([tip, tip - vec2(0.0, 6.0)], stroke);
    }
    let middle = start + 0.5 * (end - start) - vec2(0.0, 4.0);
    let font = egui::FontId::proportional(12.5);
    painter.text(middle, Align2::CENTER_BOTTOM, bar.text(), font, color);
}

/// The ball of axes, its centre given. Returns the side that was tapped.
pub(crate) fn ball_ui(ui: &Ui, view: &Projection, center: Pos2) -> Option<Command> {
    let palette = Palette::get(ui);
    let painter = ui.painter();
    painter.circle(
        center,
        BALL + 13.0,
        palette.float,
        Stroke::new(1.0, palette.line),
    );
    let mut tips: Vec<(StandardView, Vec2, f32)> = StandardView::ALL
        .into_iter()
        .map(|side| {
            let d = side.direction();
            (
                side,
                vec2(d.dot(view.right), -d.dot(view.up)) * BALL,
                d.dot(view.back),
            )
        })
        .collect();
    // The far ones first, so that the near ones lie over them.
    tips.sort_by(|a, b| a.2.total_cmp(&b.2));
    let mut tapped = None;
    for (side, offset, toward) in tips {
        let at = center + offset;
        let is_near = toward > -0.1;
        let hit = Rect::from_center_size(at, Vec2::splat(22.0));
        let response = ui.interact(
            hit,
            ui.scope_id().with(("side", side.letter())),
            Sense::click(),
        );
        let name = fill(w().view, &[&side_name(side)]);
        response.widget_info(|| WidgetInfo::labeled(Role::Button, true, &name));
        let is_hot = response.hovered() || response.has_focus();
        let color = match side {
            StandardView::Left | StandardView::Right => theme::over_picture::X,
            StandardView::Front | StandardView::Back => theme::over_picture::Y,
            StandardView::Top | StandardView::Bottom => theme::over_picture::Z,
        };
        let fade = 0.35 + 0.65 * (0.5 + 0.5 * toward);
        if matches!(
            side,
            StandardView::Right | StandardView::Front | StandardView::Top
        ) {
            painter.line_segment([center, at], Stroke::new(2.0, color.gamma_multiply(fade)));
        }
        let radius = if is_hot { 10.5 } else { 9.0 };
        let (fill, text) = if is_hot {
            (palette.accent, palette.on_accent)
        } else if is_near {
            (color, Color32::WHITE)
        } else {
            (palette.sunken, palette.weak)
        };
        painter.circle(at, radius, fill, Stroke::new(1.0, palette.float));
        painter.text(
            at,
            Align2::CENTER_CENTER,
            side.letter(),
            theme::strong_font(10.5),
            text,
        );
        if response
            .on_hover_text(format!("{} ({})", side_hint(side), side.letter()))
            .clicked()
        {
            tapped = Some(Command::View(side));
        }
    }
    tapped
}

/// As on the button: `Front`.
fn side_name(side: StandardView) -> &'static str {
    match side {
        StandardView::Front => w().front,
        StandardView::Back => w().back,
        StandardView::Right => w().right,
        StandardView::Left => w().left,
        StandardView::Top => w().top,
        StandardView::Bottom => w().bottom,
    }
}

pub(crate) fn side_hint(side: StandardView) -> &'static str {
    match side {
        StandardView::Front => w().from_front,
        StandardView::Back => w().from_back,
        StandardView::Right => w().from_right,
        StandardView::Left => w().from_left,
        StandardView::Top => w().from_above,
        StandardView::Bottom => w().from_below,
    }
}
