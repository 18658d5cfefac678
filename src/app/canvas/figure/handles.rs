use egui::{Pos2, Response, Shape, Stroke, Ui};
use glam::{Vec2, Vec3};

use super::plane::seen;
use crate::app::canvas::points::{Dot, Moved, handle, is_hot};
use crate::app::canvas::projection::Projection;
use crate::app::kit::theme::over_picture as ink;
use crate::app::session::figure::{
    FigureCommand, HandleKey, Overlay, handle_edit, handle_motion, handle_place, line_places,
};
use crate::app::session::{Command, Session};
use crate::app::words::figure::w;
use crate::app::words::{fill, names};
use crate::document::figure::{Handle, Hold, MAX_TURN, SCALE_RANGE};

/// Radius of the ring around the selected handle, points.
const RING: f32 = 40.0;
/// The knob of the scale keeps within these parts of the ring's radius.
const KNOB: [f32; 2] = [0.4, 5.0];

/// All handles of the figure, with the ring of the one that was selected last. True if one of them is under the pointer
/// or held.
pub(super) fn ui(
    ui: &Ui,
    view: &Projection,
    session: &Session,
    commands: &mut Vec<Command>,
) -> bool {
    let figure = &session.view.figure;
    let Some(shown) = session.shown().figure.as_ref() else {
        return false;
    };
    if !figure.shows(Overlay::Handles) || figure.sheet.is_none() {
        return false;
    }
    let mut is_held = false;
    let chosen = figure.handles.last().copied();
    if let Some((index, handle)) = chosen.and_then(|i| Some((i, shown.handles.get(i)?))) {
        is_held |= ring_ui(ui, view, session, (index, handle), commands);
    }
    for (index, handle) in shown.handles.iter().enumerate() {
        let mut one = One {
            ui,
            view,
            session,
            index,
            handle,
            commands: &mut *commands,
            is_held: false,
        };
        match handle.hold {
            Hold::Line { .. } => one.line(),
            _ => one.pin(),
        }
        is_held |= one.is_held;
    }
    context(ui, view, session);
    is_held
}

/// A handle that is drawn.
struct One<'a> {
    ui: &'a Ui,
    view: &'a Projection,
    session: &'a Session,
    index: usize,
    handle: &'a Handle,
    commands: &'a mut Vec<Command>,
    is_held: bool,
}

impl One<'_> {
    /// A pin: it is dragged, and goes with all that are selected.
    fn pin(&mut self) {
        let Some(at) = handle_place(&self.session.view.figure, self.handle) else {
            return;
        };
        // Its row in the panel has the plain name.
        let name = fill(w().spot, &[&names::handle(self.index, self.handle)]);
        if let Some(Moved::To(to)) = self.dot(at, &name) {
            let by = to.truncate() - at;
            self.send(FigureCommand::MoveHandles(self.index, by));
        }
    }

    /// A line: each of its points is dragged.
    fn line(&mut self) {
        let places = line_places(&self.session.view.figure, self.handle);
        let all = places.iter().filter_map(|at| seen(self.view, *at));
        let line: Vec<Pos2> = all.collect();
        let painter = self.ui.painter_at(self.view.rect);
        for (width, color) in [(4.0, ink::HALO_DARK), (2.0, self.color())] {
            painter.add(Shape::line(line.clone(), Stroke::new(width, color)));
        }
        let name = names::handle(self.index, self.handle);
        for (point, at) in places.into_iter().enumerate() {
            let name = fill(w().line_point, &[&name, &(point + 1)]);
            if let Some(Moved::To(to)) = self.dot(at, &name) {
                let to = to.truncate();
                self.send(FigureCommand::MoveLinePoint(self.index, point, to));
            }
        }
    }

    fn color(&self) -> egui::Color32 {
        match (self.handle.enabled, self.is_selected()) {
            (false, _) => ink::HALO_DARK,
            (true, true) => ink::HOT,
            (true, false) => ink::HANDLE,
        }
    }

    fn is_selected(&self) -> bool {
        self.session.view.figure.handles.contains(&self.index)
    }

    fn send(&mut self, command: FigureCommand) {
        self.commands.push(Command::Figure(command));
    }

    /// A dot of the handle, and where it was dragged; its other gestures are done here.
    fn dot(&mut self, at: Vec2, name: &str) -> Option<Moved> {
        let spot = seen(self.view, at)?;
        let plane = (at.extend(0.0), Vec3::Z);
        let (response, moved) = handle(
            self.ui,
            self.view,
            spot,
            plane,
            &Dot::full(name, self.color()),
        );
        self.is_held |= is_hot(&response);
        if response.clicked() {
            let adds = self.ui.input(|i| i.modifiers.shift);
            self.send(FigureCommand::SelectHandle(Some(self.index), adds));
        }
        if let Some(Moved::Removed) = moved {
            self.send(FigureCommand::SelectHandle(Some(self.index), false));
            self.commands.push(Command::DeleteSelected);
            return None;
        }
        moved
    }
}

/// The ring around a handle: one knob turns it, one scales it. True if one of them is under the pointer or held.
fn ring_ui(
    ui: &Ui,
    view: &Projection,
    session: &Session,
    (index, held): (usize, &Handle),
    commands: &mut Vec<Command>,
) -> bool {
    if matches!(held.hold, Hold::Line { to: Some(_), .. }) {
        return false;
    }
    let figure = &session.view.figure;
    let Some(at) = handle_place(figure, held) else {
        return false;
    };
    let Some(center) = seen(view, at) else {
        return false;
    };
    let (turn, scale) = handle_motion(figure, held);
    let painter = ui.painter_at(view.rect);
    for (width, color) in [(4.0, ink::HALO_DARK), (1.6, ink::HALO_LIGHT)] {
        painter.circle_stroke(center, RING, Stroke::new(width, color));
    }
    // So many subject units are the ring's radius.
    let radius = RING / view.points_per_unit(at.extend(0.0));
    let out = Vec2::from_angle(turn as f32) * radius;
    let name = names::handle(index, held);
    let mut is_held = false;
    let mut knob = |offset: Vec2, dot: &Dot<'_>| {
        let pos = at + offset;
        let moved =
            seen(view, pos).map(|spot| handle(ui, view, spot, (pos.extend(0.0), Vec3::Z), dot));
        let (response, moved): (Response, _) = moved?;
        is_held |= is_hot(&response);
        match moved {
            Some(Moved::To(to)) => Some(to.truncate() - at),
            _ => None,
        }
    };
    let named = fill(w().turn_of, &[&name]);
    let told = match held.motion.turn {
        Some(_) => named.clone(),
        None => format!("{named}: {}", w().turn_open),
    };
    let dot = match held.motion.turn {
        Some(_) => Dot::full(&named, ink::Z),
        None => Dot::hollow(&named, &told, ink::Z),
    };
    if let Some(to) = knob(out, &dot) {
        let by = f64::from(out.angle_to(to));
        let turn = (turn + by).clamp(-MAX_TURN, MAX_TURN);
        let edit = handle_edit(index, HandleKey::Turn(Some(turn)));
        commands.push(Command::Drag(edit));
    }
    let named = fill(w().size_of, &[&name]);
    let long = (scale as f32).clamp(KNOB[0], KNOB[1]);
    if let Some(to) = knob(out.perp() * long, &Dot::full(&named, ink::Y)) {
        let scale = f64::from(to.length() / radius.max(1e-6));
        let scale = scale.clamp(SCALE_RANGE[0], SCALE_RANGE[1]);
        let edit = handle_edit(index, HandleKey::Scale(scale));
        commands.push(Command::Drag(edit));
    }
    is_held
}

/// Landmarks, where they are now.
fn context(ui: &Ui, view: &Projection, session: &Session) {
    let shown = session.shown().figure.as_ref();
    let context = shown.and_then(|figure| figure.context.as_ref());
    let (Some(context), Some(sheet)) = (context, &session.view.figure.sheet) else {
        return;
    };
    let painter = ui.painter_at(view.rect);
    for point in &context.points {
        let at = sheet.forward(point.as_vec2()).map(|(_, at)| at);
        if let Some(spot) = at.and_then(|at| seen(view, at)) {
            painter.circle(spot, 4.0, ink::X, Stroke::new(1.6, ink::HALO_LIGHT));
            painter.circle_stroke(spot, 5.4, Stroke::new(1.0, ink::HALO_DARK));
        }
    }
}
