//! The handles over the picture: a template or an object is moved, turned and sized where it is, and a template's main
//! parameter is dragged where it acts. Lines and dots are drawn by the interface over the picture with the picture's
//! own projection.

use egui::{Painter, Pos2, Rect, Response, Role, Sense, Shape, Stroke, Ui, Vec2, WidgetInfo, vec2};
use glam::{Quat, Vec3};

use super::apart::{APART, Apart, drawn_out, on_stems};
use super::held::Held;
use super::snap;
use crate::app::canvas::projection::Projection;
use crate::app::kit::theme::over_picture as ink;
use crate::app::session::{Command, GizmoMode, Session};
use crate::app::words::picture::w;
use crate::app::words::{fill, in_sentence, kinds};
use crate::document::{Edit, ParamKind, ParamValue, PlacedTemplate};
use crate::math::{Bent, Placement};
use crate::placed;

/// Points from the centre to the tip of an arrow.
const ARROW: f32 = 74.0;
/// Points of a turning ring's radius.
const RING: f32 = 66.0;
/// Where the squares lie between the arrows, as parts of both arrows: the first where there is room.
const SQUARES: [f32; 4] = [0.36, 0.5, 0.64, 0.8];
/// Lengths of an arrow where others are in its way, as parts of [`ARROW`].
const LENGTHS: [f32; 3] = [1.0, 1.35, 0.7];
/// How far the knob on its stem keeps from the shafts of the arrows, points.
const BESIDE_SHAFT: f32 = 14.0;
/// Points around a line or dot within which the mouse takes it.
const REACH_MOUSE: f32 = 9.0;
/// How near a finger must be to a handle, points.
const REACH_TOUCH: f32 = 24.0;
/// Smallest side that a face can be dragged to, subject units.
const SMALLEST_SIDE: f32 = 0.01;
const AXES: [Vec3; 3] = [Vec3::X, Vec3::Y, Vec3::Z];
const AXIS_COLORS: [egui::Color32; 3] = [ink::X, ink::Y, ink::Z];
const AXIS_NAMES: [&str; 3] = ["x", "y", "z"];

/// What can be held.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Part {
    /// The handle of the main parameter.
    Main,
    /// In the plane of the picture.
    Free,
    /// Along an axis of the template.
    Axis(usize),
    /// In the plane across an axis.
    Plane(usize),
    /// The ring that turns about an axis of the template, 0 to 2.
    Ring(usize),
    /// A face of the box: axis, and whether it is the one at 1.
    Face(usize, bool),
}

impl Part {
    fn name(self, main: &str) -> String {
        match self {
            Self::Main => fill(w().drag_main, &[&main]),
            Self::Free => w().move_freely.to_owned(),
            Self::Axis(i) => fill(w().move_along, &[&AXIS_NAMES[i]]),
            Self::Plane(i) => fill(w().move_across, &[&AXIS_NAMES[i]]),
            Self::Ring(i) => fill(w().turn_about, &[&AXIS_NAMES[i]]),
            Self::Face(i, high) => {
                let text = if high { w().size_far } else { w().size_near };
                fill(text, &[&AXIS_NAMES[i]])
            }
        }
    }
}

/// The part that is dragged, and the state of what is held and of the pointer when the drag began.
#[derive(Clone, Debug)]
struct Hold {
    part: Part,
    start: Pos2,
    placement: Placement,
    /// The view when it was taken.
    view: Projection,
    /// Where on the handle it was taken, relative to the handle's point; keeps it from jumping.
    offset: Vec2,
}

/// The handles of what is selected.
#[derive(Default)]
pub(crate) struct Gizmo {
    hold: Option<Hold>,
    hot: Option<Part>,
}

impl Gizmo {
    /// True while a handle is dragged.
    pub(crate) fn is_held(&self) -> bool {
        self.hold.is_some()
    }

    /// Something is held or under the pointer.
    pub(crate) fn is_hot(&self) -> bool {
        self.hot.is_some() || self.hold.is_some()
    }

    /// Forgets the part that is held and the one under the pointer.
    pub(crate) fn release(&mut self) {
        self.hold = None;
        self.hot = None;
    }

    /// Handles the pointer and draws. `picture` is the response of the picture underneath. Returns a step of a drag.
    pub(crate) fn ui(
        &mut self,
        ui: &Ui,
        picture: &Response,
        view: &Projection,
        held: Held<'_>,
        session: &Session,
    ) -> Option<Command> {
        let handles = Handles::new(view, held, session.gizmo);
        let is_touch = ui.input(|i| i.any_touches());
        let reach = if is_touch { REACH_TOUCH } else { REACH_MOUSE };
        let pointer = ui.input(|i| i.pointer.latest_pos());
        let press = ui.input(|i| i.pointer.press_origin());
        let is_down = ui.input(|i| i.pointer.primary_down());
        let fingers = ui.input(|i| i.multi_touch().map_or(1, |touch| touch.num_touches));

        if self.hold.is_some() && (!is_down || fingers > 1) {
            self.hold = None;
        }
        if self.hold.is_none() {
            let is_over = picture.contains_pointer() || picture.is_pointer_button_down_on();
            let at = if picture.is_pointer_button_down_on() {
                press
            } else {
                pointer
            };
            self.hot = at
                .filter(|_| is_over)
                .and_then(|pos| handles.hit(pos, reach));
            if let (Some(part), Some(pos)) = (self.hot, press)
                && picture.is_pointer_button_down_on()
                && is_down
                && ui.input(|i| i.pointer.primary_pressed())
            {
                let anchor = if part == Part::Main {
                    handles.main_at
                } else {
                    None
                };
                self.hold = Some(Hold {
                    part,
                    start: pos,
                    placement: held.placement(),
                    view: *view,
                    offset: anchor.map_or(Vec2::ZERO, |anchor| anchor - pos),
                });
            }
        }

        let mut command = None;
        if let (Some(hold), Some(pos)) = (&self.hold, pointer) {
            self.hot = Some(hold.part);
            if pos != hold.start || picture.dragged() {
                let modifiers = ui.input(|i| i.modifiers);
                // The key reverses the setting while it is held.
                let snap = session.is_snapping != modifiers.command;
                command = hold.drag(pos, held, snap, modifiers.alt);
            }
        }
        if self.is_hot() {
            let icon = if self.is_held() {
                egui::CursorIcon::Grabbing
            } else {
                egui::CursorIcon::Grab
            };
            ui.ctx().set_cursor_icon(icon);
        }
        handles.paint(&ui.painter_at(view.rect), self.hot);
        handles.announce(ui, held);
        command
    }
}

impl Hold {
    /// What holding it and being at `pos` now makes of what is held. `snap` goes in steps; `both` takes the opposite
    /// face along.
    fn drag(&self, pos: Pos2, held: Held<'_>, snap: bool, both: bool) -> Option<Command> {
        let view = &self.view;
        let mut placement = self.placement;
        let at = placement.at;
        match self.part {
            Part::Main => {
                let edit = self.drag_main(pos, held.template()?, snap);
                return edit.map(Command::Drag);
            }
            Part::Free => {
                let from = view.on_plane(self.start, at, view.back)?;
                placement.at += view.on_plane(pos, at, view.back)? - from;
            }
            Part::Axis(i) => {
                let axis = placement.rotate * AXES[i];
                let from = view.along_line(self.start, at, axis)?;
                let by = view.along_line(pos, at, axis)? - from;
                placement.at += axis * stepped(by, snap::LENGTH, snap);
            }
            Part::Plane(i) => {
                let normal = placement.rotate * AXES[i];
                let from = view.on_plane(self.start, at, normal)?;
                let by = view.on_plane(pos, at, normal)? - from;
                placement.at += [(i + 1) % 3, (i + 2) % 3]
                    .map(|i| placement.rotate * AXES[i])
                    .map(|axis| axis * stepped(by.dot(axis), snap::LENGTH, snap))
                    .into_iter()
                    .sum::<Vec3>();
            }
            Part::Ring(i) => {
                let angle = stepped(self.ring_angle(i, pos)?, snap::TURN_DEG.to_radians(), snap);
                placement.rotate =
                    (placement.rotate * Quat::from_axis_angle(AXES[i], angle)).normalize();
            }
            Part::Face(i, high) => {
                let sign = if high { 1.0 } else { -1.0 };
                let axis = placement.rotate * AXES[i] * sign;
                let from = view.along_line(self.start, at, axis)?;
                let by = view.along_line(pos, at, axis)? - from;
                // With the key for it both faces go; otherwise the far one stays where it is.
                let grow = if both { 2.0 * by } else { by };
                let side = stepped(placement.size[i] + grow, snap::LENGTH, snap);
                let side = side.max(if snap { snap::LENGTH } else { SMALLEST_SIDE });
                if !both {
                    placement.at += axis * (0.5 * (side - placement.size[i]));
                }
                placement.size[i] = side;
            }
        }
        placement.at = placement.at.clamp(Vec3::splat(-4.0), Vec3::splat(4.0));
        let sized = match self.part {
            Part::Face(axis, _) => Some(axis),
            _ => None,
        };
        held.put(placement, sized)
    }

    /// Turn by a drag along the tangent of the ring where it was taken: a ring seen edge-on turns as well as one seen
    /// full, and a long drag goes round more than once.
    fn ring_angle(&self, axis: usize, pos: Pos2) -> Option<f32> {
        let points = ring(&self.view, &self.placement, axis);
        let nearest = points.iter().min_by(|a, b| {
            a.seen
                .distance(self.start)
                .total_cmp(&b.seen.distance(self.start))
        })?;
        let direction = self.placement.rotate * AXES[axis];
        let tangent = direction.cross(nearest.pos - self.placement.at);
        let ahead = self.view.ui_from_subject(nearest.pos + tangent * 0.05)?;
        let along = ahead - nearest.seen;
        let along = if along.length() > 1e-3 {
            along.normalized()
        } else {
            return None;
        };
        Some((pos - self.start).dot(along) / RING)
    }

    /// The value of the main parameter whose handle is seen nearest to the pointer.
    fn drag_main(&self, pos: Pos2, template: &PlacedTemplate, snap: bool) -> Option<Edit> {
        let index = template.kind.spec().main_param?;
        let ray = self.view.ray(pos + self.offset);
        // Starts from the template as it is now, not as it was when the drag began: an angle may go around more than
        // once.
        let value = placed::dragged_along_ray(template, self.view.eye, ray)?;
        let value = match (value, template.kind.spec().params[index].kind) {
            (
                ParamValue::Number(value),
                ParamKind::Number { min, max, .. } | ParamKind::Count { min, max, .. },
            ) if snap => {
                let by = (max - min) * snap::PARAM;
                ParamValue::Number((min + snap::nearest(value - min, by)).clamp(min, max))
            }
            (value, _) => value,
        };
        (value != template.params[index]).then(|| Edit::SetParam {
            template: template.index,
            param: template.kind.spec().params[index].name,
            value,
        })
    }
}

/// A value in steps, if steps are wanted.
fn stepped(value: f32, step: f32, snap: bool) -> f32 {
    if snap {
        snap::nearest(value, step)
    } else {
        value
    }
}

/// A point of a ring: its place in subject space and in the window, and whether it lies on the half towards the eye.
struct RingPoint {
    pos: Vec3,
    seen: Pos2,
    is_front: bool,
}

fn ring(view: &Projection, placement: &Placement, axis: usize) -> Vec<RingPoint> {
    const SEGMENTS: u16 = 72;
    let radius = RING / view.points_per_unit(placement.at);
    let (u, v) = (AXES[(axis + 1) % 3], AXES[(axis + 2) % 3]);
    (0..=SEGMENTS)
        .filter_map(|i| {
            let angle = std::f32::consts::TAU * f32::from(i) / f32::from(SEGMENTS);
            let (sin, cos) = angle.sin_cos();
            let offset = placement.rotate * (u * cos + v * sin);
            let pos = placement.at + offset * radius;
            let seen = view.ui_from_subject(pos)?;
            Some(RingPoint {
                pos,
                seen,
                is_front: offset.dot(view.back) > -0.05,
            })
        })
        .collect()
}

/// Where every handle is seen.
struct Handles<'a> {
    view: &'a Projection,
    placement: Placement,
    bent: Option<Bent>,
    mode: GizmoMode,
    center: Option<Pos2>,
    /// Where the main parameter is held: the knob, on a stem beside what it stands for if another handle is there.
    main: Option<Pos2>,
    /// What the knob stands for.
    main_at: Option<Pos2>,
    main_name: &'static str,
    /// Where the tip of each arrow is seen; none of an arrow that points at the eye and cannot be dragged to any use.
    tips: [Option<Pos2>; 3],
    /// The squares between the arrows, each by the axis that it is across.
    squares: [Option<Pos2>; 3],
    faces: Vec<Face>,
}

/// The handle of a face of the box.
#[derive(Clone, Copy)]
struct Face {
    axis: usize,
    /// At the far end of the axis.
    is_far: bool,
    /// The middle of the face.
    at: Pos2,
    /// Where it is held: in the middle, or drawn out from there where another handle is in its way; none where that is
    /// no use either.
    grip: Option<Pos2>,
    /// The face is turned to the viewer.
    is_front: bool,
}

impl<'a> Handles<'a> {
    fn new(view: &'a Projection, held: Held<'_>, mode: GizmoMode) -> Self {
        let placement = held.placement();
        let unit = 1.0 / view.points_per_unit(placement.at);
        let arrows = AXES.map(|axis| {
            view.ui_from_subject(placement.at + placement.rotate * axis * (ARROW * unit))
        });
        let mut faces = Vec::with_capacity(6);
        for (i, axis) in AXES.into_iter().enumerate() {
            for high in [false, true] {
                let sign = if high { 0.5 } else { -0.5 };
                let pos = held.subject_from_own(Vec3::splat(0.5) + axis * sign);
                let outward = placement.rotate * axis * sign;
                if let Some(seen) = view.ui_from_subject(pos) {
                    faces.push(Face {
                        axis: i,
                        is_far: high,
                        at: seen,
                        grip: None,
                        is_front: outward.dot(view.eye - pos) > 0.0,
                    });
                }
            }
        }
        let center = view.ui_from_subject(placement.at);
        let handle = held.template().and_then(placed::handle);
        let main_at = handle.and_then(|handle| view.ui_from_subject(handle.at));
        let main_name = held.template().and_then(|template| {
            let main = template.kind.spec().main_param?;
            Some(kinds::param_name(template.kind, main))
        });
        let mut handles = Self {
            view,
            placement,
            bent: held.bent(),
            mode,
            center,
            main: None,
            main_at,
            main_name: main_name.unwrap_or_default(),
            tips: [None; 3],
            squares: [None; 3],
            faces,
        };
        if let Some(center) = center {
            handles.keep_apart(center, arrows);
        }
        handles
    }

    /// Finds a place for every handle: the centre first, then the knob, which stays where it is dragged to, then the
    /// others around both.
    fn keep_apart(&mut self, center: Pos2, arrows: [Option<Pos2>; 3]) {
        let mut apart = Apart::default();
        // Where the knob would be nearer to the middle, it stands on a stem in every mode.
        apart.take(center);
        self.main = self.main_at.and_then(|at| apart.take_first([at]));
        match self.mode {
            GizmoMode::Move => self.place_arrows(center, arrows, &mut apart),
            GizmoMode::Turn => {}
            GizmoMode::Size => self.place_faces(center, &mut apart),
        }
        if let (None, Some(at)) = (self.main, self.main_at) {
            let shafts = self.tips;
            let beside = |place: &Pos2| {
                let distance = |tip: Pos2| segment_distance(*place, center, tip);
                shafts
                    .iter()
                    .flatten()
                    .all(|tip| distance(*tip) >= BESIDE_SHAFT)
            };
            let stems = || on_stems(at, self.view.rect);
            let place = apart.take_first(stems().filter(beside));
            self.main = place.or_else(|| apart.take_first(stems())).or(Some(at));
        }
    }

    fn place_arrows(&mut self, center: Pos2, arrows: [Option<Pos2>; 3], apart: &mut Apart) {
        for (i, arrow) in arrows.into_iter().enumerate() {
            let along = arrow.map(|tip| tip - center);
            self.tips[i] = along
                .filter(|along| along.length() >= APART)
                .and_then(|along| apart.take_first(LENGTHS.map(|part| center + along * part)));
        }
        for i in 0..3 {
            let normal = self.placement.rotate * AXES[i];
            let to_eye = (self.view.eye - self.placement.at).normalize_or_zero();
            // Edge-on squares cannot be dragged to any use.
            if normal.dot(to_eye).abs() <= 0.25 {
                continue;
            }
            if let (Some(a), Some(b)) = (arrows[(i + 1) % 3], arrows[(i + 2) % 3]) {
                let out = (a - center) + (b - center);
                self.squares[i] = apart.take_first(SQUARES.map(|part| center + out * part));
            }
        }
    }

    /// Faces that are turned to the viewer first; others that find no place are left out.
    fn place_faces(&mut self, center: Pos2, apart: &mut Apart) {
        self.faces.sort_by_key(|face| !face.is_front);
        for face in &mut self.faces {
            let out = face.at - center;
            let direction = if out.length() > 2.0 {
                out.normalized()
            } else {
                Vec2::ZERO
            };
            face.grip = apart.take_first(drawn_out(face.at, direction));
        }
    }

    /// The part under a place of the window, within `reach` points; where several overlap, the most specific.
    fn hit(&self, pos: Pos2, reach: f32) -> Option<Part> {
        // The nearest of those within reach: a finger reaches several.
        let nearest = |handles: &[(Part, Option<Pos2>, f32)]| {
            let within = handles.iter().filter_map(|(part, at, extra)| {
                let distance = at.as_ref()?.distance(pos);
                (distance <= reach + extra).then_some((*part, distance))
            });
            within
                .min_by(|a, b| a.1.total_cmp(&b.1))
                .map(|found| found.0)
        };
        let main = (Part::Main, self.main, 5.0);
        match self.mode {
            GizmoMode::Move => {
                let square = |i| (Part::Plane(i), self.squares[i], 2.0);
                let tip = |i| (Part::Axis(i), self.tips[i], 0.0);
                let free = (Part::Free, self.center, 1.0);
                let all = [
                    main,
                    free,
                    square(0),
                    square(1),
                    square(2),
                    tip(0),
                    tip(1),
                    tip(2),
                ];
                if let Some(part) = nearest(&all) {
                    return Some(part);
                }
                let center = self.center?;
                let distance = |i: usize| {
                    self.tips[i].map_or(f32::INFINITY, |tip| segment_distance(pos, center, tip))
                };
                let best = (0..3).min_by(|&a, &b| distance(a).total_cmp(&distance(b)))?;
                (distance(best) <= reach).then_some(Part::Axis(best))
            }
            GizmoMode::Turn => {
                if let Some(part) = nearest(&[main]) {
                    return Some(part);
                }
                let distance = |i: usize| {
                    let points = ring(self.view, &self.placement, i);
                    points
                        .windows(2)
                        .map(|w| {
                            // The near half of a ring goes before the far half of another.
                            let behind = if w[0].is_front { 0.0 } else { 4.0 };
                            segment_distance(pos, w[0].seen, w[1].seen) + behind
                        })
                        .fold(f32::INFINITY, f32::min)
                };
                let best = (0..3).min_by(|&a, &b| distance(a).total_cmp(&distance(b)))?;
                (distance(best) <= reach + 2.0).then_some(Part::Ring(best))
            }
            GizmoMode::Size => {
                let face = |face: &Face| (Part::Face(face.axis, face.is_far), face.grip, 3.0);
                let mut all = vec![main];
                all.extend(self.faces.iter().map(face));
                nearest(&all)
            }
        }
    }

    fn paint(&self, painter: &Painter, hot: Option<Part>) {
        self.paint_box(painter);
        match self.mode {
            GizmoMode::Move => self.paint_move(painter, hot),
            GizmoMode::Turn => self.paint_turn(painter, hot),
            GizmoMode::Size => self.paint_size(painter, hot),
        }
        if let (Some(main), Some(at)) = (self.main, self.main_at) {
            if main != at {
                stem(painter, at, main);
                painter.circle_filled(at, 3.5, ink::HANDLE);
            }
            let is_hot = hot == Some(Part::Main);
            let radius = if is_hot { 9.0 } else { 7.5 };
            painter.circle_filled(main, radius + 3.5, ink::HALO_DARK);
            painter.circle_filled(main, radius + 2.0, egui::Color32::WHITE);
            painter.circle_filled(main, radius, if is_hot { ink::HOT } else { ink::HANDLE });
            if is_hot {
                let font = crate::app::kit::theme::strong_font(12.0);
                let text = self.main_name.to_owned();
                let galley = painter.layout_no_wrap(text, font, egui::Color32::WHITE);
                let at = main + vec2(16.0, -0.5 * galley.size().y);
                let back = Rect::from_min_size(at, galley.size()).expand2(vec2(6.0, 3.0));
                painter.rect_filled(back, 4.0, egui::Color32::from_black_alpha(190));
                painter.galley(at, galley, egui::Color32::WHITE);
            }
        }
    }

    fn paint_box(&self, painter: &Painter) {
        let corner = |bits: usize| {
            let pick = |bit: usize| if bits & bit == 0 { 0.0 } else { 1.0 };
            Vec3::new(pick(1), pick(2), pick(4))
        };
        let seen = |q: Vec3| {
            let q = self
                .bent
                .as_ref()
                .map_or(q, |bent| bent.bend(q.with_z(bent.unfolded(q.z))));
            self.view
                .ui_from_subject(self.placement.subject_from_template(q))
        };
        // Along a curve the long edges are round.
        let pieces = |axis: usize| match (&self.bent, axis) {
            (Some(_), 0) => 24_u8,
            _ => 1,
        };
        // An edge lies behind if both its faces look away.
        let is_face_front = |axis: usize, high: bool| {
            self.faces
                .iter()
                .any(|face| face.axis == axis && face.is_far == high && face.is_front)
        };
        for axis in 0..3_usize {
            for bits in 0..8_usize {
                if bits & (1 << axis) != 0 {
                    continue;
                }
                let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
                let is_front = is_face_front(a, bits & (1 << a) != 0)
                    || is_face_front(b, bits & (1 << b) != 0);
                let (from, to) = (corner(bits), corner(bits | (1 << axis)));
                let count = pieces(axis);
                let line = (0..=count).map(|i| f32::from(i) / f32::from(count));
                let line: Option<Vec<Pos2>> = line.map(|part| seen(from.lerp(to, part))).collect();
                let Some(line) = line else { continue };
                if is_front {
                    let halo = Stroke::new(3.0, ink::HALO_LIGHT.gamma_multiply(0.55));
                    painter.add(Shape::line(line.clone(), halo));
                    painter.add(Shape::line(line, Stroke::new(1.3, ink::BOX)));
                } else {
                    let stroke = Stroke::new(1.0, ink::BOX.gamma_multiply(0.6));
                    painter.extend(Shape::dashed_line(&line, stroke, 4.0, 4.0));
                }
            }
        }
    }

    fn paint_move(&self, painter: &Painter, hot: Option<Part>) {
        let Some(center) = self.center else { return };
        // The arrow that points away from the viewer goes first, so that the near ones lie over it.
        let mut order = [0, 1, 2];
        let toward = |i: usize| (self.placement.rotate * AXES[i]).dot(self.view.back);
        order.sort_by(|&a, &b| toward(a).total_cmp(&toward(b)));
        for i in order {
            let color = if hot == Some(Part::Axis(i)) {
                ink::HOT
            } else {
                AXIS_COLORS[i]
            };
            if let Some(tip) = self.tips[i] {
                let start = center + (tip - center).normalized() * 12.0;
                arrow(painter, start, tip, color);
            }
            if let Some(at) = self.squares[i] {
                let is_hot = hot == Some(Part::Plane(i));
                let color = if is_hot { ink::HOT } else { AXIS_COLORS[i] };
                let square =
                    Rect::from_center_size(at, Vec2::splat(if is_hot { 13.0 } else { 11.0 }));
                painter.rect_filled(square.expand(1.5), 3.0, ink::HALO_LIGHT);
                painter.rect_filled(square, 2.0, color);
            }
        }
        let is_hot = hot == Some(Part::Free);
        painter.circle_filled(center, if is_hot { 9.0 } else { 7.5 }, ink::HALO_DARK);
        painter.circle_filled(
            center,
            if is_hot { 7.5 } else { 6.0 },
            if is_hot {
                ink::HOT
            } else {
                egui::Color32::WHITE
            },
        );
    }

    fn paint_turn(&self, painter: &Painter, hot: Option<Part>) {
        for pass in [false, true] {
            for (i, axis_color) in AXIS_COLORS.into_iter().enumerate() {
                let points = ring(self.view, &self.placement, i);
                let is_hot = hot == Some(Part::Ring(i));
                let color = if is_hot { ink::HOT } else { axis_color };
                for run in points.chunk_by(|a, b| a.is_front == b.is_front) {
                    if run[0].is_front != pass {
                        continue;
                    }
                    let line: Vec<Pos2> = run.iter().map(|point| point.seen).collect();
                    if pass {
                        painter.add(Shape::line(
                            line.clone(),
                            Stroke::new(5.0, ink::HALO_LIGHT.gamma_multiply(0.7)),
                        ));
                        painter.add(Shape::line(
                            line,
                            Stroke::new(if is_hot { 3.5 } else { 2.4 }, color),
                        ));
                    } else {
                        painter.add(Shape::line(
                            line,
                            Stroke::new(1.2, color.gamma_multiply(0.55)),
                        ));
                    }
                }
            }
        }
    }

    fn paint_size(&self, painter: &Painter, hot: Option<Part>) {
        for pass in [false, true] {
            for face in self.faces.iter().filter(|face| face.is_front == pass) {
                let Some(grip) = face.grip else { continue };
                let is_hot = hot == Some(Part::Face(face.axis, face.is_far));
                let side = if is_hot { 15.0 } else { 12.0 };
                let color = if is_hot {
                    ink::HOT
                } else {
                    AXIS_COLORS[face.axis]
                };
                let fade = if face.is_front { 1.0 } else { 0.55 };
                if grip != face.at {
                    stem(painter, face.at, grip);
                }
                let square = Rect::from_center_size(grip, Vec2::splat(side));
                painter.rect_filled(square.expand(3.0), 4.0, ink::HALO_DARK.gamma_multiply(fade));
                painter.rect_filled(
                    square.expand(1.8),
                    3.0,
                    egui::Color32::WHITE.gamma_multiply(fade),
                );
                painter.rect_filled(square, 2.0, color.gamma_multiply(fade));
            }
        }
    }

    /// Names the handles to screen readers and tests. They do not take the pointer: the picture does.
    fn announce(&self, ui: &Ui, held: Held<'_>) {
        let announce = |part: Part, at: Option<Pos2>| {
            let Some(at) = at.filter(|at| self.view.rect.contains(*at)) else {
                return;
            };
            let name = part.name(&in_sentence(self.main_name));
            let rect = Rect::from_center_size(at, Vec2::splat(12.0));
            let id = ui
                .scope_id()
                .with(("gizmo", held.template().is_some(), held.index(), &name));
            let response = ui.interact(rect, id, Sense::empty());
            response.widget_info(|| WidgetInfo::labeled(Role::GraphicsObject, true, &name));
        };
        announce(Part::Main, self.main);
        match self.mode {
            GizmoMode::Move => {
                announce(Part::Free, self.center);
                for i in 0..3 {
                    announce(Part::Axis(i), self.tips[i]);
                    announce(Part::Plane(i), self.squares[i]);
                }
            }
            GizmoMode::Turn => {
                for i in 0..3 {
                    let points = ring(self.view, &self.placement, i);
                    let front = points.iter().filter(|point| point.is_front);
                    announce(Part::Ring(i), front.map(|point| point.seen).nth(3));
                }
            }
            GizmoMode::Size => {
                for face in &self.faces {
                    announce(Part::Face(face.axis, face.is_far), face.grip);
                }
            }
        }
    }
}

fn segment_distance(pos: Pos2, from: Pos2, to: Pos2) -> f32 {
    let along = to - from;
    let t = ((pos - from).dot(along) / along.length_sq().max(1e-6)).clamp(0.0, 1.0);
    (pos - from - along * t).length()
}

/// The line between a handle and what it stands for.
fn stem(painter: &Painter, from: Pos2, to: Pos2) {
    painter.line_segment([from, to], Stroke::new(4.0, ink::HALO_DARK));
    painter.line_segment([from, to], Stroke::new(2.0, egui::Color32::WHITE));
}

fn arrow(painter: &Painter, from: Pos2, to: Pos2, color: egui::Color32) {
    let direction = (to - from).normalized();
    let side = direction.rot90();
    let base = to - direction * 13.0;
    painter.line_segment(
        [from, base],
        Stroke::new(5.0, ink::HALO_LIGHT.gamma_multiply(0.7)),
    );
    let head = vec![to, base + side * 5.5, base - side * 5.5];
    let wide = vec![
        to + direction * 3.0,
        base + side * 8.0 - direction * 1.5,
        base - side * 8.0 - direction * 1.5,
    ];
    painter.add(Shape::convex_polygon(
        wide,
        ink::HALO_LIGHT.gamma_multiply(0.7),
        Stroke::NONE,
    ));
    painter.line_segment([from, base], Stroke::new(2.6, color));
    painter.add(Shape::convex_polygon(head, color, Stroke::NONE));
}
