use glam::{DVec2, Vec2};
use serde_json::{Map, Value, json};

use super::edits::{HandleKey, handle_edit, handle_rest, index_of, rounded};
use super::place::{NO_MOVE, handle_motion, line_places};
use crate::app::session::notices::Gravity;
use crate::app::session::session::{Session, Tab};
use crate::app::words::figure;
use crate::document::figure::{Hold, MAX_HANDLES, MAX_MOVE, MAX_TURN, SCALE_RANGE};
use crate::document::{Edit, FigureList};
use crate::math::round_to;

/// Less than this is no change of scale.
const NO_SCALE: f32 = 0.02;
/// By which angle a key turns a handle for one hundredth, radians.
const TURN_STEP: f64 = 0.01;

impl Session {
    /// Adds a handle, and selects it.
    pub(super) fn add_handle(&mut self, entry: Value) -> bool {
        let index = self.figure().handles.len();
        let edit = Edit::AddToFigure {
            list: FigureList::Handles,
            index,
            entry,
        };
        if index >= MAX_HANDLES || !self.apply(&edit, false) {
            return false;
        }
        self.view.figure.handles = vec![index];
        self.view.figure.region = None;
        self.side_tab = Tab::Templates;
        true
    }

    /// What a handle that takes hold of a place has to do so that nothing jumps: it takes the move that it finds.
    pub(super) fn found_motion(
        &self,
        triangle: usize,
        at_rest: Vec2,
        seen: Vec2,
    ) -> Map<String, Value> {
        let mut keys = Map::new();
        let Some(sheet) = &self.view.figure.sheet else {
            return keys;
        };
        let by = seen - sheet.before_handles(at_rest);
        if by.length() > NO_MOVE {
            keys.insert("move".to_owned(), rounded(by.as_dvec2()));
        }
        let scale = sheet.motion_of(triangle).map_or(1.0, |(_, scale)| scale);
        if (scale - 1.0).abs() > NO_SCALE {
            let scale = f64::from(scale).clamp(SCALE_RANGE[0], SCALE_RANGE[1]);
            keys.insert("scale".to_owned(), json!(round_to(scale, 3)));
        }
        keys
    }

    pub(super) fn set_pin(&mut self, at: Vec2) {
        let Some((triangle, at_rest)) = self.at_rest(at) else {
            return self.nothing_here();
        };
        let mut entry = self.found_motion(triangle, at_rest, at);
        entry.insert("at".to_owned(), rounded(at_rest.as_dvec2()));
        self.add_handle(Value::Object(entry));
    }

    pub(super) fn hold_region(&mut self, name: &str) {
        let sheet = self.view.figure.sheet.as_ref();
        let found = sheet.and_then(|sheet| {
            let middle = sheet.middle_of(name)?;
            let (triangle, seen) = sheet.forward(middle)?;
            Some((triangle, middle, seen, sheet.motion_of(triangle)?.0))
        });
        let mut entry = Map::new();
        if let Some((triangle, middle, seen, turn)) = found {
            entry = self.found_motion(triangle, middle, seen);
            if f64::from(turn.abs()) > TURN_STEP {
                entry.insert("turn".to_owned(), json!(round_to(f64::from(turn), 4)));
            }
        }
        entry.insert("region".to_owned(), json!(name));
        self.add_handle(Value::Object(entry));
    }

    pub(super) fn select_handle(&mut self, index: Option<usize>, adds: bool) {
        let all = &mut self.view.figure.handles;
        match index {
            Some(index) if adds => match all.iter().position(|other| *other == index) {
                Some(place) => {
                    all.remove(place);
                }
                None => all.push(index),
            },
            Some(index) => *all = vec![index],
            None => all.clear(),
        }
        self.view.figure.region = None;
        self.side_tab = Tab::Templates;
    }

    pub(super) fn move_handles(&mut self, moved: usize, by: DVec2) {
        if !by.is_finite() {
            return;
        }
        let mut all = self.view.figure.handles.clone();
        if !all.contains(&moved) {
            all = vec![moved];
            self.view.figure.handles.clone_from(&all);
        }
        all.sort_unstable();
        let figure = self.figure();
        let limit = DVec2::splat(MAX_MOVE);
        let edits = all.iter().filter_map(|index| {
            let handle = figure.handles.get(*index)?;
            let key = match &handle.hold {
                Hold::Line { to: Some(to), .. } => {
                    HandleKey::To(to.iter().map(|to| (*to + by).as_vec2()).collect())
                }
                _ => HandleKey::Move((handle.motion.by + by).clamp(-limit, limit)),
            };
            Some(handle_edit(*index, key))
        });
        let edit = Edit::All {
            name: "Move handles".to_owned(),
            edits: edits.collect(),
        };
        self.apply(&edit, true);
    }

    pub(super) fn move_line_point(&mut self, index: usize, point: usize, to: Vec2) {
        let figure = self.figure();
        let Some(handle) = figure.handles.get(index).filter(|_| to.is_finite()) else {
            return;
        };
        let mut places = line_places(&self.view.figure, handle);
        let Some(place) = places.get_mut(point) else {
            return;
        };
        *place = to;
        self.apply(&handle_edit(index, HandleKey::To(places)), true);
    }

    pub(super) fn put_back(&mut self, index: Option<usize>) {
        let figure = self.figure();
        let all = figure.handles.iter().enumerate();
        let edits = all.filter(|(other, _)| index.is_none_or(|index| index == *other));
        let edit = Edit::All {
            name: "Put handles back".to_owned(),
            edits: edits.map(|(i, handle)| handle_rest(i, handle)).collect(),
        };
        self.apply(&edit, false);
    }

    /// Removes the selected handles, else the selected region.
    pub(in crate::app::session) fn delete_of_figure(&mut self) {
        let mut handles = std::mem::take(&mut self.view.figure.handles);
        handles.sort_unstable();
        let remove = |list, index| Edit::RemoveFromFigure { list, index };
        let (name, edits): (_, Vec<Edit>) = match (&self.view.figure.region, handles.is_empty()) {
            (_, false) => {
                let all = handles.iter().rev();
                let all = all.map(|index| remove(FigureList::Handles, *index));
                ("Remove handle", all.collect())
            }
            (Some(name), true) => {
                let Some(index) = index_of(self, name) else {
                    // A region of the source cannot be taken out of it.
                    return self.notify(Gravity::Info, figure::w().of_source, "");
                };
                self.view.figure.region = None;
                ("Remove region", vec![remove(FigureList::Regions, index)])
            }
            (None, true) => return,
        };
        let edit = Edit::All {
            name: name.to_owned(),
            edits,
        };
        self.apply(&edit, false);
    }

    /// Switches the selected handles on or off.
    pub(in crate::app::session) fn toggle_of_figure(&mut self) {
        let figure = self.figure();
        let chosen = |i: &usize| figure.handles.get(*i);
        let all = &self.view.figure.handles;
        let is_on = all.iter().filter_map(chosen).any(|handle| handle.enabled);
        let edits = all.iter().filter(|i| chosen(i).is_some());
        let edits: Vec<Edit> = edits
            .map(|i| handle_edit(*i, HandleKey::Enabled(!is_on)))
            .collect();
        if !edits.is_empty() {
            let name = "Change handle".to_owned();
            self.apply(&Edit::All { name, edits }, false);
        }
    }

    /// Selects the next handle, or the one before.
    pub(in crate::app::session) fn next_of_figure(&mut self, forward: bool) {
        let count = self.figure().handles.len();
        if count == 0 {
            return;
        }
        let step = if forward { 1 } else { count - 1 };
        let next = match self.view.figure.handles.last() {
            Some(last) => (last + step) % count,
            None if forward => 0,
            None => count - 1,
        };
        self.select_handle(Some(next), false);
    }

    /// Turns the selected handles.
    pub(in crate::app::session) fn turn_of_figure(&mut self, hundredths: f32) {
        let figure = self.figure();
        let edits = self.view.figure.handles.iter().filter_map(|index| {
            let handle = figure.handles.get(*index)?;
            if matches!(handle.hold, Hold::Line { to: Some(_), .. }) {
                return None;
            }
            let (turn, _) = handle_motion(&self.view.figure, handle);
            let turn = turn + f64::from(hundredths) * TURN_STEP;
            let key = HandleKey::Turn(Some(turn.clamp(-MAX_TURN, MAX_TURN)));
            Some(handle_edit(*index, key))
        });
        let edits: Vec<Edit> = edits.collect();
        if !edits.is_empty() {
            let name = "Turn handles".to_owned();
            self.apply(&Edit::All { name, edits }, true);
        }
    }

    /// Moves the selected region in its list by so many places.
    pub(in crate::app::session) fn shift_of_figure(&mut self, by: i8) {
        let name = self.view.figure.region.clone();
        let Some(from) = name.and_then(|name| index_of(self, &name)) else {
            return;
        };
        let count = self.listed_regions().len();
        let to = from.saturating_add_signed(isize::from(by));
        if to != from && to < count {
            let list = FigureList::Regions;
            self.apply(&Edit::MoveInFigure { list, from, to }, false);
        }
    }
}
