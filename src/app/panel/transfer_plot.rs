//! How the transfer function's plot is drawn: the axis, the histogram, the curve and its handles.

use egui::{Align2, Color32, FontId, Mesh, Painter, Pos2, Rect, Shape, Stroke, pos2};

use crate::app::kit::theme::Palette;
use crate::app::kit::widget;
use crate::data::Histogram;
use crate::document::TransferPoint;
use crate::render::TransferTable;

/// Height of the lane of the window's handles, points.
pub(crate) const LANE: f32 = 24.0;

/// What the pointer holds of the plot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Grip {
    /// The point of the curve of this index.
    Point(usize),
    /// An end of the window.
    End(usize),
    /// The bar between the ends.
    Bar,
    /// The axis: the shown part of it moves.
    Axis,
}

/// An opacity, 0 to 1, in percent as text.
pub(crate) fn percent(opacity: f32) -> String {
    format!("{} %", widget::plain(f64::from(opacity) * 100.0, 1))
}

/// How values and opacities lie in the field.
pub(crate) struct Axis {
    pub curve: Rect,
    /// Value at its left and at its right.
    pub range: [f32; 2],
}

impl Axis {
    pub(crate) fn x(&self, value: f32) -> f32 {
        let part = (value - self.range[0]) / (self.range[1] - self.range[0]);
        self.curve.left() + part * self.curve.width()
    }

    pub(crate) fn value(&self, x: f32) -> f32 {
        let part = (x - self.curve.left()) / self.curve.width();
        self.range[0] + part * (self.range[1] - self.range[0])
    }

    /// Values that one point of the window takes.
    pub(crate) fn per_point(&self) -> f32 {
        (self.range[1] - self.range[0]) / self.curve.width()
    }

    /// Upwards in square roots: haze of a hundredth is a tenth of the height.
    pub(crate) fn place(&self, value: f32, opacity: f32) -> Pos2 {
        pos2(
            self.x(value),
            self.curve.bottom() - opacity.max(0.0).sqrt() * self.curve.height(),
        )
    }

    pub(crate) fn opacity(&self, y: f32) -> f32 {
        ((self.curve.bottom() - y) / self.curve.height())
            .clamp(0.0, 1.0)
            .powi(2)
    }

    pub(crate) fn contains(&self, value: f32) -> bool {
        (self.curve.left() - 1.0..=self.curve.right() + 1.0).contains(&self.x(value))
    }

    /// Left and right of each column of `step` points.
    pub(crate) fn columns(&self, step: f32) -> impl Iterator<Item = (f32, f32)> + use<> {
        let (left, right) = (self.curve.left(), self.curve.right());
        let count = (self.curve.width() / step).ceil().max(1.0) as usize;
        (0..count).map(move |i| {
            (
                left + i as f32 * step,
                (left + (i + 1) as f32 * step).min(right),
            )
        })
    }
}

/// Columns as high as the logarithm of how often their values occur.
pub(crate) fn paint_histogram(
    painter: &Painter,
    axis: &Axis,
    histogram: &Histogram,
    color: Color32,
) {
    let [low, high] = histogram.value_range;
    let width = (high - low) / histogram.counts.len().max(1) as f32;
    if width <= 0.0 {
        return;
    }
    // The commonest value is air as a rule; it may stand out of the field.
    let mut counts = histogram.counts.clone();
    counts.sort_unstable();
    let tallest = counts.iter().rev().nth(1).copied().unwrap_or(1).max(2);
    let scale = 1.0 / (tallest as f32 + 1.0).ln();
    let mut mesh = Mesh::default();
    for (left, right) in axis.columns(1.5) {
        let bin = |x: f32| ((axis.value(x) - low) / width).floor();
        let (first, last) = (bin(left), bin(right - 1e-3));
        if last < 0.0 || first >= histogram.counts.len() as f32 {
            continue;
        }
        let bins = histogram
            .counts
            .get(first.max(0.0) as usize..=(last as usize).min(histogram.counts.len() - 1));
        let count = bins.unwrap_or_default().iter().max().copied().unwrap_or(0);
        let height = ((count as f32 + 1.0).ln() * scale).min(1.0) * axis.curve.height();
        if height > 0.0 {
            let bottom = axis.curve.bottom();
            mesh.add_colored_rect(
                Rect::from_min_max(pos2(left, bottom - height), pos2(right, bottom)),
                color,
            );
        }
    }
    painter.add(Shape::mesh(mesh));
}

/// Fine lines at 1, 10 and 50 %.
pub(crate) fn paint_levels(painter: &Painter, axis: &Axis, palette: &Palette) {
    for opacity in [0.01_f32, 0.1, 0.5, 1.0] {
        let y = axis.place(0.0, opacity).y;
        painter.hline(axis.curve.x_range(), y, Stroke::new(1.0, palette.line));
        if opacity < 1.0 {
            let at = pos2(axis.curve.right() + 5.0, y - 1.0);
            let text = percent(opacity);
            painter.text(
                at,
                Align2::RIGHT_BOTTOM,
                text,
                FontId::proportional(9.5),
                palette.weak,
            );
        }
    }
}

pub(crate) fn table_at(table: &TransferTable, value: f32) -> [f32; 4] {
    let [low, high] = table.domain;
    let last = table.entries.len().saturating_sub(1);
    let at = ((value - low) / (high - low)).clamp(0.0, 1.0) * last as f32;
    table
        .entries
        .get(at.round() as usize)
        .copied()
        .unwrap_or_default()
}

pub(crate) fn srgb(linear: [f32; 4]) -> Color32 {
    let [r, g, b] = [linear[0], linear[1], linear[2]].map(egui::ecolor::gamma_u8_from_linear_f32);
    Color32::from_rgb(r, g, b)
}

/// The colours under the curve; returns the curve.
pub(crate) fn paint_fill(painter: &Painter, axis: &Axis, table: &TransferTable) -> Vec<Pos2> {
    let mut mesh = Mesh::default();
    let mut line = Vec::new();
    let bottom = axis.curve.bottom();
    for (left, right) in axis.columns(1.0) {
        let entry = table_at(table, axis.value(left));
        let top = axis.place(0.0, entry[3]).y;
        line.push(pos2(left, top));
        mesh.add_colored_rect(
            Rect::from_min_max(pos2(left, top), pos2(right, bottom)),
            srgb(entry).gamma_multiply(0.6),
        );
    }
    let end = table_at(table, axis.range[1]);
    line.push(pos2(axis.curve.right(), axis.place(0.0, end[3]).y));
    painter.add(Shape::mesh(mesh));
    line
}

/// The colours as they are mixed, opaque.
pub(crate) fn paint_strip(painter: &Painter, axis: &Axis, table: &TransferTable, strip: Rect) {
    let mut mesh = Mesh::default();
    for (left, right) in axis.columns(2.0) {
        let color = srgb(table_at(table, axis.value(0.5 * (left + right))));
        mesh.add_colored_rect(
            Rect::from_min_max(pos2(left, strip.top()), pos2(right, strip.bottom())),
            color,
        );
    }
    painter.add(Shape::mesh(mesh));
}

/// Round numbers under the axis, as many as there is room for.
pub(crate) fn paint_ticks(painter: &Painter, axis: &Axis, bottom: f32, palette: &Palette) {
    let span = axis.range[1] - axis.range[0];
    let wanted = span / (axis.curve.width() / 58.0).max(1.0);
    let power = 10.0_f32.powf(wanted.log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0]
        .into_iter()
        .map(|m| m * power)
        .find(|s| *s >= wanted)
        .unwrap_or(wanted);
    if !(step.is_finite() && step > 0.0) {
        return;
    }
    let decimals = (-step.log10().floor()).clamp(0.0, 6.0) as usize;
    let mut k = (axis.range[0] / step).ceil();
    while k * step <= axis.range[1] {
        let value = k * step;
        let text = widget::plain(f64::from(value), decimals);
        let galley = painter.layout_no_wrap(text, FontId::proportional(10.0), palette.weak);
        let half = 0.5 * galley.size().x;
        let x = axis.x(value).clamp(
            axis.curve.left() - 8.0 + half,
            axis.curve.right() + 8.0 - half,
        );
        painter.galley(
            pos2(x - half, bottom - galley.size().y),
            galley,
            palette.weak,
        );
        k += 1.0;
    }
}

pub(crate) fn paint_window(
    painter: &Painter,
    axis: &Axis,
    window: [f32; 2],
    top: f32,
    hot: Option<Grip>,
    palette: &Palette,
    is_stretching: bool,
) {
    let fade = if is_stretching { 1.0 } else { 0.6 };
    let [low, high] = window.map(|value| {
        axis.x(value)
            .clamp(axis.curve.left() - 6.0, axis.curve.right() + 6.0)
    });
    let y = top + 0.5 * LANE;
    let bar = Rect::from_min_max(pos2(low, y - 3.0), pos2(high, y + 3.0));
    let color = if hot == Some(Grip::Bar) {
        palette.accent_hover
    } else {
        palette.accent_wash
    };
    painter.rect_filled(bar, 3.0, color.gamma_multiply(fade));
    for (i, x) in [low, high].into_iter().enumerate() {
        let is_hot = hot == Some(Grip::End(i));
        let color = if is_hot {
            palette.accent_hover
        } else {
            palette.accent
        };
        painter.extend(Shape::dashed_line(
            &[pos2(x, y + 6.0), pos2(x, axis.curve.bottom())],
            Stroke::new(1.0, color.gamma_multiply(0.6 * fade)),
            3.0,
            3.0,
        ));
        let half = if is_hot { 7.0 } else { 6.0 };
        let triangle = vec![
            pos2(x - half, y - half),
            pos2(x + half, y - half),
            pos2(x, y + half),
        ];
        painter.add(Shape::convex_polygon(
            triangle,
            color.gamma_multiply(fade),
            Stroke::new(1.5, palette.raised),
        ));
    }
}

pub(crate) fn paint_point(
    painter: &Painter,
    at: Pos2,
    point: &TransferPoint,
    is_selected: bool,
    is_hot: bool,
    palette: &Palette,
) {
    let [r, g, b] = point.color_srgb;
    let radius = if is_hot || is_selected { 7.0 } else { 5.5 };
    let ring = if is_selected {
        palette.accent
    } else {
        palette.text
    };
    painter.circle_filled(at, radius + 2.5, palette.raised);
    painter.circle(
        at,
        radius,
        Color32::from_rgb(r, g, b),
        Stroke::new(if is_selected { 2.5 } else { 1.5 }, ring),
    );
}
