//! A template along a curve: laid along the surface under it, its points dragged in the picture, made straight again.

use egui::{Pos2, Rect, Shape, Stroke, Ui};
use glam::{Vec2 as Flat, Vec3};

use super::camera::Projection;
use super::command::Command;
use super::control::{self, Named as _};
use super::icon::Icon;
use super::making::shape_of;
use super::picture::{PickFor, Picture};
use super::points::{Moved, handle};
use super::state::{Gravity, State};
use super::theme::over_picture as ink;
use super::viewport::SURFACE_VIEW;
use super::words;
use super::words::curve::w;
use super::words::fill;
use crate::document::{Curve, Edit, PlacedTemplate};
use crate::math::{Bent, Laid};
use crate::render::RenderError;

/// Places of the surface that are asked for along a template.
const ASKED: usize = 7;
/// The surface is looked for so far over and under the box, in parts of its height: what lies farther away is another surface.
const REACH: [f32; 2] = [-1.0, 2.0];
/// Points are kept this near to the box, template units.
const FARTHEST: f32 = 9.0;
/// A plane that is seen more edge-on than this (sine) cannot be dragged in.
const EDGE_ON: f32 = 0.35;

/// What has been found of the surface along a template so far.
#[derive(Debug)]
pub(crate) struct Tracing {
    template: usize,
    open: usize,
    /// Subject space.
    found: [Option<Vec3>; ASKED],
}

impl Tracing {
    /// Nothing yet.
    pub(crate) fn new(template: usize) -> Self {
        Self {
            template,
            open: ASKED,
            found: [None; ASKED],
        }
    }
}

/// Asks for the surface along the selected template, if that is wanted. The object is looked at along the template's axis for it: whoever shows
/// the picture sets its own view again.
pub(super) fn ask(state: &mut State, picture: &mut Picture) -> Option<Result<(), RenderError>> {
    let template = state.making.wants_curve.take()?;
    let (seen, camera) = state.surface_view(template)?;
    let places = places(state.selected_template()?);
    picture.set(&seen, &camera);
    let rect = Rect::from_min_size(Pos2::ZERO, egui::Vec2::splat(SURFACE_VIEW as f32));
    let view = Projection::new(&camera, rect);
    state.making.tracing = Some(Tracing::new(template));
    let mut asks = places.into_iter().enumerate();
    Some(asks.try_for_each(|(i, pos)| {
        let at = view.ui_from_subject(pos).unwrap_or_default();
        picture.ask(PickFor::Along(i), [at.x, at.y], [SURFACE_VIEW; 2])
    }))
}

/// Where along a template's top the surface is asked for, subject space.
fn places(template: &PlacedTemplate) -> [Vec3; ASKED] {
    std::array::from_fn(|i| {
        let x = i as f32 / (ASKED - 1) as f32;
        template
            .placement
            .subject_from_template(Vec3::new(x, 0.5, 1.0))
    })
}

impl State {
    /// Takes the surface at one of the places.
    pub(crate) fn trace(&mut self, index: usize, pos: Option<Vec3>) {
        let Some(tracing) = &mut self.making.tracing else {
            return;
        };
        if let Some(slot) = tracing.found.get_mut(index) {
            *slot = pos;
            tracing.open = tracing.open.saturating_sub(1);
        }
        if tracing.open == 0
            && let Some(done) = self.making.tracing.take()
        {
            let mut templates = self.illustration().templates.iter();
            let template = templates.find(|t| t.index == done.template);
            match template.and_then(|template| along(template, &done.found)) {
                Some(curve) => {
                    let edit = Edit::SetCurve {
                        template: done.template,
                        curve: Some(curve),
                    };
                    self.apply(&edit, false);
                }
                None => {
                    let text = words::making::w().no_surface;
                    self.say(Gravity::Info, text, "");
                }
            }
        }
    }
}

/// The curve through what was found about the middle, as high over the surface as a template of this kind stands.
fn along(template: &PlacedTemplate, found: &[Option<Vec3>; ASKED]) -> Option<Curve> {
    let near = |pos: Option<Vec3>| {
        let q = template.placement.template_from_subject(pos?);
        let is_near = q.z > REACH[0] && q.z < REACH[1];
        is_near.then_some(Flat::new(q.x, q.z))
    };
    let middle = ASKED / 2;
    let (low, high) = found.split_at(middle);
    let mut places: Vec<Flat> = low.iter().rev().map_while(|pos| near(*pos)).collect();
    places.reverse();
    places.extend(high.iter().map_while(|pos| near(*pos)));
    let size = template.placement.size;
    let surface = Bent::new(&places, false, size, Laid::TOP).ok()?;
    let top = surface.beside(shape_of(template.kind).above * size.z);
    let curve = Curve::spline(top);
    (places.len() > 2 && curve.bent(size).is_ok()).then_some(curve)
}

fn set(template: &PlacedTemplate, curve: Option<Curve>) -> Edit {
    Edit::SetCurve {
        template: template.index,
        curve,
    }
}

/// The line and the handles of its points. True if one of them is under the pointer or held.
pub(super) fn ui(
    ui: &mut Ui,
    view: &Projection,
    template: &PlacedTemplate,
    commands: &mut Vec<Command>,
) -> bool {
    let Some(curve) = &template.curve else {
        return false;
    };
    let placement = template.placement;
    let place = |p: Flat| placement.subject_from_template(Vec3::new(p.x, 0.5, p.y));
    if let Some(bent) = template.bent() {
        let line: Option<Vec<_>> = bent
            .beside(0.0)
            .into_iter()
            .map(|p| view.ui_from_subject(place(p)))
            .collect();
        let painter = ui.painter_at(view.rect);
        for (width, color) in [(4.0, ink::HALO_DARK), (2.0, ink::HANDLE)] {
            painter.add(Shape::line(
                line.clone().unwrap_or_default(),
                Stroke::new(width, color),
            ));
        }
    }
    // In the plane that is bent; where that is seen edge-on, out of the surface and into it.
    let [normal, out] = [Vec3::Y, Vec3::Z].map(|axis| placement.rotate * axis);
    let is_edge_on = normal.dot(view.back()).abs() < EDGE_ON;
    let plane = if is_edge_on { view.back() } else { normal };
    let mut is_hot = false;
    for (i, point) in curve.points.iter().enumerate() {
        let pos = place(*point);
        let Some(spot) = view.ui_from_subject(pos) else {
            continue;
        };
        let name = fill(w().point, &[&(i + 1)]);
        let (hot, moved) = handle(ui, view, spot, (pos, plane), &name, ink::HANDLE);
        is_hot |= hot;
        let mut new = curve.clone();
        match moved {
            Some(Moved::To(to)) => {
                let to = if is_edge_on {
                    pos + out * (to - pos).dot(out)
                } else {
                    to
                };
                let q = placement.template_from_subject(to);
                let limit = Flat::splat(FARTHEST);
                new.points[i] = Flat::new(q.x, q.z).clamp(-limit, limit);
                // A line that cannot be laid along is not taken: the last one stays.
                if new.bent(placement.size).is_ok() {
                    commands.push(Command::Drag(set(template, Some(new))));
                }
            }
            Some(Moved::Removed) => {
                new.points.remove(i);
                let rest = (new.points.len() > 1).then_some(new);
                commands.push(Command::Apply(set(template, rest)));
            }
            None => {}
        }
    }
    is_hot
}

/// In the panel: along the surface, straight, round.
pub(super) fn panel_ui(ui: &mut Ui, template: &PlacedTemplate, commands: &mut Vec<Command>) {
    control::row(ui, |ui| {
        control::row_label(ui, w().curve, w().hint);
        let follow = ui.button(w().follow).on_hover_text(w().follow_hint);
        if follow.clicked() {
            commands.push(Command::FollowSurface);
        }
        let is_curved = template.curve.is_some();
        if control::icon_button(ui, Icon::Close, w().straight, is_curved).clicked() {
            commands.push(Command::Apply(set(template, None)));
        }
    });
    if let Some(curve) = &template.curve {
        control::row(ui, |ui| {
            control::row_label(ui, w().round, w().round_hint);
            let mut is_spline = curve.is_spline;
            let response = ui.checkbox(&mut is_spline, "").named(w().round);
            if response.on_hover_text(w().round_hint).changed() {
                let curve = Curve {
                    is_spline,
                    ..curve.clone()
                };
                commands.push(Command::Apply(set(template, Some(curve))));
            }
        });
    }
}
