use glam::{DAffine2, DMat2, DVec2, dvec2};

/// How a shape is painted.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Look {
    pub(crate) fill: Option<(Paint, f64)>,
    pub(crate) stroke: Option<Stroke>,
    pub(crate) is_stroke_first: bool,
    /// Product of the opacities of the shape's groups.
    pub(crate) opacity: f64,
}

/// A line along an outline.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Stroke {
    pub(crate) paint: Paint,
    pub(crate) opacity: f64,
    /// Width, units of the view box.
    pub(crate) width: f64,
    pub(crate) miter_limit: f64,
    pub(crate) cap: &'static str,
    pub(crate) join: &'static str,
    /// Lengths of dashes and gaps, units of the view box.
    pub(crate) dashes: Vec<f64>,
    pub(crate) dash_offset: f64,
}

/// Colours of a fill or stroke.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Paint {
    Color([u8; 3]),
    Gradient(Gradient),
}

/// Colours along a line or around a circle.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Gradient {
    pub(crate) kind: GradientKind,
    /// From the gradient's units to the view box.
    pub(crate) place: DAffine2,
    pub(crate) spread: &'static str,
    /// Offset, colour and opacity.
    pub(crate) stops: Vec<(f64, [u8; 3], f64)>,
}

/// Where a gradient runs, in its own units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum GradientKind {
    Linear {
        from: DVec2,
        to: DVec2,
    },
    Radial {
        centre: DVec2,
        radius: f64,
        focus: DVec2,
        focus_radius: f64,
    },
}

/// An affine map of usvg in 64 bits.
pub(crate) fn affine(ts: usvg::Transform) -> DAffine2 {
    let column = |x: f32, y: f32| dvec2(f64::from(x), f64::from(y));
    DAffine2 {
        matrix2: DMat2::from_cols(column(ts.sx, ts.ky), column(ts.kx, ts.sy)),
        translation: column(ts.tx, ts.ty),
    }
}

/// Paint of usvg for a shape that `place` brings into the view box; a pattern has none.
pub(crate) fn paint(paint: &usvg::Paint, place: DAffine2) -> Option<Paint> {
    let gradient = |base: &usvg::BaseGradient, kind| {
        let stop = |stop: &usvg::Stop| {
            let color = stop.color();
            (
                f64::from(stop.offset().get()),
                [color.red, color.green, color.blue],
                f64::from(stop.opacity().get()),
            )
        };
        Paint::Gradient(Gradient {
            kind,
            place: place * affine(base.transform()),
            spread: match base.spread_method() {
                usvg::SpreadMethod::Pad => "pad",
                usvg::SpreadMethod::Reflect => "reflect",
                usvg::SpreadMethod::Repeat => "repeat",
            },
            stops: base.stops().iter().map(stop).collect(),
        })
    };
    let point = |x: f32, y: f32| dvec2(f64::from(x), f64::from(y));
    match paint {
        usvg::Paint::Color(color) => Some(Paint::Color([color.red, color.green, color.blue])),
        usvg::Paint::LinearGradient(of) => {
            let (from, to) = (point(of.x1(), of.y1()), point(of.x2(), of.y2()));
            Some(gradient(of, GradientKind::Linear { from, to }))
        }
        usvg::Paint::RadialGradient(of) => {
            let kind = GradientKind::Radial {
                centre: point(of.cx(), of.cy()),
                radius: f64::from(of.r().get()),
                focus: point(of.fx(), of.fy()),
                focus_radius: f64::from(of.fr().get()),
            };
            Some(gradient(of, kind))
        }
        usvg::Paint::Pattern(_) => None,
    }
}

/// How usvg draws a path that `place` brings into the view box; widths of lines have its mean scale.
pub(crate) fn look(path: &usvg::Path, place: DAffine2, opacity: f64) -> Look {
    let scale = place.matrix2.determinant().abs().sqrt();
    let stroke = |stroke: &usvg::Stroke| {
        Some(Stroke {
            paint: paint(stroke.paint(), place)?,
            opacity: f64::from(stroke.opacity().get()),
            width: f64::from(stroke.width().get()) * scale,
            miter_limit: f64::from(stroke.miterlimit().get()),
            cap: match stroke.linecap() {
                usvg::LineCap::Butt => "butt",
                usvg::LineCap::Round => "round",
                usvg::LineCap::Square => "square",
            },
            join: match stroke.linejoin() {
                usvg::LineJoin::Miter | usvg::LineJoin::MiterClip => "miter",
                usvg::LineJoin::Round => "round",
                usvg::LineJoin::Bevel => "bevel",
            },
            dashes: stroke
                .dasharray()
                .unwrap_or_default()
                .iter()
                .map(|dash| f64::from(*dash) * scale)
                .collect(),
            dash_offset: f64::from(stroke.dashoffset()) * scale,
        })
    };
    Look {
        fill: path
            .fill()
            .and_then(|fill| Some((paint(fill.paint(), place)?, f64::from(fill.opacity().get())))),
        stroke: path.stroke().and_then(stroke),
        is_stroke_first: path.paint_order() == usvg::PaintOrder::StrokeAndFill,
        opacity,
    }
}
