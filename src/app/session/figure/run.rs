use glam::{DVec2, Vec2};
use serde_json::{Map, Value, json};

use super::edits::{
    HandleKey, figure_edit, handle_edit, handle_rest, index_of, rounded, rounded_places,
};
use super::place::{handle_motion, line_places, thinned};
use super::state::{FigureCommand, FigureTool};
use crate::app::session::notices::Gravity;
use crate::app::session::session::{Session, Tab};
use crate::app::session::tool::Tool;
use crate::app::words::{figure, fill, messages};
use crate::document::figure::{
    Context, Figure, Flood, Hold, MAX_FLOOD_POINTS, MAX_HANDLES, MAX_REGIONS, Source,
};
use crate::document::{Edit, FigureList, free_group_name};
use crate::math::round_to;

/// Corners of a polygon and points of a line at most, as a document takes them.
const MAX_CORNERS: usize = 512;
const MAX_LINE: usize = 32;
/// Corners of the polygon outside which handles move nothing.
const MAX_ONLY: usize = 64;
/// Points of one flood.
const MAX_SEEDS: usize = 16;
/// Landmarks at most.
const MAX_LANDMARKS: usize = 64;
/// A free line may be off by so much, subject units.
const DRAWN_OFF: f32 = 0.0015;
/// Less than this is no move, and no change of scale.
const NO_MOVE: f32 = 1e-4;
const NO_SCALE: f32 = 0.02;
/// By how much handles may move: see the table of the document's keys.
const FARTHEST: f64 = 4.0;
/// By which angle a key turns a handle for one hundredth, radians.
const TURN_STEP: f64 = 0.01;

impl Session {
    /// The figure of what is shown; one without regions and handles if the document has none.
    pub fn figure(&self) -> Figure {
        self.shown().figure.clone().unwrap_or_default()
    }

    pub(in crate::app::session) fn run_figure(&mut self, command: FigureCommand) {
        if !self.view.is_figure() {
            return;
        }
        match command {
            FigureCommand::Take(tool) => self.take_figure_tool(tool),
            FigureCommand::Use(at, adds) => self.use_figure_tool(at, adds),
            FigureCommand::Draw(at) => self.draw_on(at),
            FigureCommand::Finish => self.finish_draft(),
            FigureCommand::TakeBack => {
                self.view.figure.draft.pop();
            }
            FigureCommand::Widen(tolerance) => self.widen(tolerance),
            FigureCommand::SelectRegion(name) => {
                self.view.figure.handles.clear();
                self.view.figure.region = name;
                self.side_tab = Tab::Templates;
            }
            FigureCommand::SelectHandle(index, adds) => self.select_handle(index, adds),
            FigureCommand::MoveHandles(moved, by) => self.move_handles(moved, by.as_dvec2()),
            FigureCommand::MoveLinePoint(handle, point, to) => {
                self.move_line_point(handle, point, to);
            }
            FigureCommand::HoldRegion(name) => self.hold_region(&name),
            FigureCommand::TakeShapes => self.take_shapes(),
            FigureCommand::Rest(index) => self.put_back(index),
            FigureCommand::DropLandmarks => {
                self.apply(&figure_edit("context", None), false);
            }
            FigureCommand::Refer(command) => self.refer(command),
            FigureCommand::Show(overlay) => self.view.figure.toggle(overlay),
        }
    }

    fn take_figure_tool(&mut self, tool: FigureTool) {
        self.view.figure.draft.clear();
        let is_same = self.tool == Tool::Figure(tool);
        self.take_tool(if is_same {
            Tool::Look
        } else {
            Tool::Figure(tool)
        });
        self.tab = None;
    }

    /// The place at rest that is seen at a place of the bent figure.
    fn at_rest(&self, at: Vec2) -> Option<(usize, Vec2)> {
        self.view.figure.sheet.as_ref()?.back(at)
    }

    fn use_figure_tool(&mut self, at: Vec2, adds: bool) {
        if !at.is_finite() {
            return;
        }
        match self.tool {
            Tool::Figure(tool) if tool.draws() => {
                if self.view.figure.draft.len() < MAX_CORNERS {
                    self.view.figure.draft.push(at);
                }
            }
            Tool::Figure(FigureTool::Pin) => self.set_pin(at),
            Tool::Figure(FigureTool::Landmark) => self.set_landmark(at),
            Tool::Figure(_) => self.pick_region(at, adds),
            _ => {
                let sheet = self.view.figure.sheet.as_ref();
                let found = sheet.and_then(|sheet| Some((sheet, sheet.back(at)?.0)));
                let name = found.map(|(sheet, triangle)| sheet.region(triangle).to_owned());
                let is_same = name == self.view.figure.region;
                self.view.figure.handles.clear();
                self.view.figure.region = name.filter(|_| !is_same);
            }
        }
    }

    /// Uses the tool where the middle of the picture is. What is drawn ends where the same place comes twice.
    pub(in crate::app::session) fn use_figure_tool_in_middle(&mut self) {
        let at = self.camera.target.truncate();
        let is_there = |last: &Vec2| last.distance(at) < NO_MOVE;
        match self.view.figure.draft.last().is_some_and(is_there) {
            true => self.finish_draft(),
            false => self.use_figure_tool(at, false),
        }
    }

    /// Goes on with what is drawn freely, where the hand has gone far enough.
    fn draw_on(&mut self, at: Vec2) {
        let draft = &mut self.view.figure.draft;
        let is_far = draft
            .last()
            .is_none_or(|last| last.distance(at) > DRAWN_OFF);
        if at.is_finite() && is_far && draft.len() < 20 * MAX_CORNERS {
            draft.push(at);
        }
    }

    fn nothing_here(&mut self) {
        self.notify(Gravity::Info, messages::w().nothing_here, "");
    }

    /// Adds a handle, and selects it.
    fn add_handle(&mut self, entry: Value) -> bool {
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
    fn found_motion(&self, triangle: usize, at_rest: Vec2, seen: Vec2) -> Map<String, Value> {
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
            let scale = f64::from(scale.clamp(0.05, 20.0));
            keys.insert("scale".to_owned(), json!(round_to(scale, 3)));
        }
        keys
    }

    fn set_pin(&mut self, at: Vec2) {
        let Some((triangle, at_rest)) = self.at_rest(at) else {
            return self.nothing_here();
        };
        let mut entry = self.found_motion(triangle, at_rest, at);
        entry.insert("at".to_owned(), rounded(at_rest.as_dvec2()));
        self.add_handle(Value::Object(entry));
    }

    fn hold_region(&mut self, name: &str) {
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

    fn set_landmark(&mut self, at: Vec2) {
        let Some((_, at_rest)) = self.at_rest(at) else {
            return self.nothing_here();
        };
        let context: Option<Context> = self.figure().context;
        let mut points: Vec<Value> = context
            .iter()
            .flat_map(|context| &context.points)
            .map(|point| rounded(*point))
            .collect();
        if points.len() >= MAX_LANDMARKS {
            return;
        }
        points.push(rounded(at_rest.as_dvec2()));
        // A context has three points at least: the first come together.
        if context.is_none() && points.len() < 3 {
            self.view.figure.draft.push(at);
            let draft = std::mem::take(&mut self.view.figure.draft);
            if draft.len() < 3 {
                self.view.figure.draft = draft;
                return;
            }
            let at_rest = draft.iter().filter_map(|at| Some(self.at_rest(*at)?.1));
            points = at_rest.map(|at| rounded(at.as_dvec2())).collect();
        }
        // Another picture has as many: its points no longer fit.
        let edit = Edit::All {
            name: "Add landmark".to_owned(),
            edits: vec![
                figure_edit("context/points", Some(json!(points))),
                figure_edit("context/like", Some(json!([]))),
            ],
        };
        self.apply(&edit, false);
    }

    fn region_count(&self) -> usize {
        let own = self.view.figure.regions.iter();
        let listed = self.illustration().figure.as_ref();
        let listed = listed.map_or(&[][..], |figure| &figure.regions);
        let is_new = |name: &&String| !listed.iter().any(|region| region.name == **name);
        own.map(|region| &region.name).filter(is_new).count() + listed.len()
    }

    /// A name that no region has.
    fn free_region_name(&self, wanted: Option<&str>) -> String {
        let listed = self.illustration().figure.as_ref();
        let listed = listed.map_or(&[][..], |figure| &figure.regions);
        let own = self.view.figure.regions.iter();
        let mut taken: Vec<String> = listed
            .iter()
            .chain(own)
            .map(|region| region.name.clone())
            .collect();
        taken.push("rest".to_owned());
        match wanted {
            Some(wanted) => free_group_name(wanted, &taken),
            None => {
                let mut names = (1..).map(|n: usize| fill(figure::w().region_n, &[&n]));
                names.find(|name| !taken.contains(name)).unwrap_or_default()
            }
        }
    }

    fn add_region(&mut self, wanted: Option<&str>, from: &Value) -> bool {
        let limit = fill(figure::w().too_many_regions, &[&MAX_REGIONS]);
        if self.region_count() >= MAX_REGIONS {
            self.notify(Gravity::Info, limit, "");
            return false;
        }
        let name = self.free_region_name(wanted);
        let edit = Edit::AddToFigure {
            list: FigureList::Regions,
            index: usize::MAX,
            entry: json!({ "name": name, "from": from }),
        };
        let is_done = self.apply(&edit, false);
        if is_done {
            self.view.figure.handles.clear();
            self.view.figure.region = Some(name);
            self.side_tab = Tab::Templates;
        }
        is_done
    }

    /// A region of like pixels around a place, or of the shape of a drawing that is seen there.
    fn pick_region(&mut self, at: Vec2, adds: bool) {
        let Some((_, at_rest)) = self.at_rest(at) else {
            return self.nothing_here();
        };
        let Some(plate) = self.view.figure.plate.clone() else {
            return;
        };
        if !plate.has_pixels() {
            let Some(shape) = plate.shape_at(at_rest) else {
                return self.nothing_here();
            };
            let regions = self.view.figure.regions.iter();
            let mut own = regions.filter(
                |region| matches!(&region.from, Some(Source::Path(path)) if *path == shape.path),
            );
            match own.next_back() {
                Some(region) => self.view.figure.region = Some(region.name.clone()),
                None => {
                    self.add_region(
                        Some(&shape_name(&shape.path)),
                        &json!({ "path": &shape.path }),
                    );
                }
            }
            return;
        }
        let at = rounded(at_rest.as_dvec2());
        if adds && self.add_seed_to_flood(&at) {
            return;
        }
        self.add_region(None, &json!({ "flood": { "at": [at] } }));
    }

    /// One more point for the flood of the selected region; false if it is none, or has no room.
    fn add_seed_to_flood(&mut self, at: &Value) -> bool {
        let figure = self.figure();
        let floods = figure
            .regions
            .iter()
            .filter_map(|region| match &region.from {
                Some(Source::Flood(flood)) => Some(flood.at.len()),
                _ => None,
            });
        if floods.sum::<usize>() >= MAX_FLOOD_POINTS {
            return false;
        }
        let Some((index, seeds)) = self
            .selected_flood()
            .map(|(index, flood)| (index, flood.at.len()))
        else {
            return false;
        };
        let edit = Edit::Set {
            pointer: format!("/figure/regions/{index}/from/flood/at/-"),
            value: at.clone(),
            name: "Change region".to_owned(),
        };
        seeds < MAX_SEEDS && self.apply(&edit, false)
    }

    /// The flood of the selected region, with its place in the document's list.
    pub fn selected_flood(&self) -> Option<(usize, &Flood)> {
        let index = index_of(self, self.view.figure.region.as_deref()?)?;
        let figure = self.illustration().figure.as_ref()?;
        match &figure.regions.get(index)?.from {
            Some(Source::Flood(flood)) => Some((index, flood)),
            _ => None,
        }
    }

    fn widen(&mut self, tolerance: f64) {
        let Some((index, flood)) = self.selected_flood() else {
            return;
        };
        let tolerance = tolerance.round().clamp(0.0, 255.0);
        if flood.tolerance == tolerance {
            return;
        }
        let edit = Edit::Set {
            pointer: format!("/figure/regions/{index}/from/flood/tolerance"),
            value: json!(tolerance),
            name: "Change region".to_owned(),
        };
        self.apply(&edit, true);
    }

    fn take_shapes(&mut self) {
        let Some(plate) = self.view.figure.plate.clone() else {
            return;
        };
        let is_taken = |path: &str| {
            let mut regions = self.view.figure.regions.iter();
            regions.any(|region| matches!(&region.from, Some(Source::Path(own)) if own == path))
        };
        let shapes = plate.shapes.iter().filter(|shape| !is_taken(&shape.path));
        let left = MAX_REGIONS.saturating_sub(self.region_count());
        let paths: Vec<&str> = shapes.map(|shape| shape.path.as_str()).collect();
        let mut names: Vec<String> = Vec::new();
        let mut edits = Vec::new();
        for path in paths.iter().take(left) {
            let wanted = shape_name(path);
            let free = self.free_region_name(Some(&wanted));
            let name = match names.contains(&free) {
                true => free_group_name(&free, &names),
                false => free,
            };
            edits.push(Edit::AddToFigure {
                list: FigureList::Regions,
                index: usize::MAX,
                entry: json!({ "name": &name, "from": { "path": path } }),
            });
            names.push(name);
        }
        if paths.len() > left {
            let limit = fill(figure::w().too_many_regions, &[&MAX_REGIONS]);
            self.notify(Gravity::Info, limit, "");
        }
        let edit = Edit::All {
            name: "Take all shapes".to_owned(),
            edits,
        };
        self.apply(&edit, false);
    }

    fn finish_draft(&mut self) {
        let Tool::Figure(tool) = self.tool else {
            return;
        };
        let mut draft = std::mem::take(&mut self.view.figure.draft);
        // A double click is two clicks in one place.
        draft.dedup_by(|a, b| a.distance(*b) < NO_MOVE);
        let least = if tool == FigureTool::Line { 2 } else { 3 };
        if !tool.draws() || draft.len() < least {
            return;
        }
        let most = match tool {
            FigureTool::Line => MAX_LINE,
            FigureTool::Only => MAX_ONLY,
            _ => MAX_CORNERS,
        };
        let draft = thinned(&draft, DRAWN_OFF, most);
        let at_rest: Vec<(Vec2, Vec2)> = draft
            .iter()
            .map(|seen| (self.at_rest(*seen).map_or(*seen, |(_, at)| at), *seen))
            .collect();
        let rest: Vec<Vec2> = at_rest.iter().map(|(at, _)| *at).collect();
        match tool {
            FigureTool::Line => {
                let sheet = self.view.figure.sheet.as_ref();
                let is_moved = at_rest.iter().any(|(at, seen)| {
                    let before = sheet.map_or(*at, |sheet| sheet.before_handles(*at));
                    before.distance(*seen) > NO_MOVE
                });
                let mut entry = json!({ "points": rounded_places(&rest) });
                if is_moved {
                    entry["to"] = rounded_places(&draft);
                }
                self.add_handle(entry);
            }
            FigureTool::Only => {
                let only = figure_edit("only", Some(rounded_places(&rest)));
                self.apply(&only, false);
            }
            _ => {
                self.add_region(None, &json!({ "polygon": rounded_places(&rest) }));
            }
        }
    }

    fn select_handle(&mut self, index: Option<usize>, adds: bool) {
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

    fn move_handles(&mut self, moved: usize, by: DVec2) {
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
        let limit = DVec2::splat(FARTHEST);
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

    fn move_line_point(&mut self, index: usize, point: usize, to: Vec2) {
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

    fn put_back(&mut self, index: Option<usize>) {
        let figure = self.figure();
        let all = figure.handles.iter().enumerate();
        let edits = all.filter(|(other, _)| index.is_none_or(|index| index == *other));
        let edit = Edit::All {
            name: "Put handles back".to_owned(),
            edits: edits.map(|(i, handle)| handle_rest(i, handle)).collect(),
        };
        self.apply(&edit, false);
    }

    // -------------------------------------------------------------------------- what keys do with what is selected

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
            let most = 4.0 * std::f64::consts::PI;
            let key = HandleKey::Turn(Some(turn.clamp(-most, most)));
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
        let listed = self.illustration().figure.as_ref();
        let count = listed.map_or(0, |figure| figure.regions.len());
        let to = from.saturating_add_signed(isize::from(by));
        if to != from && to < count {
            let list = FigureList::Regions;
            self.apply(&Edit::MoveInFigure { list, from, to }, false);
        }
    }
}

/// What a region of a shape is called: by its id, or by its number.
fn shape_name(path: &str) -> String {
    match path.bytes().all(|letter| letter.is_ascii_digit()) {
        true => fill(figure::w().shape_n, &[&path]),
        false => path.to_owned(),
    }
}
