use std::sync::LazyLock;

use glam::Vec2;
use serde_json::json;

use super::edits::{figure_edit, rounded_places};
use super::place::{NO_MOVE, thinned};
use super::state::{FigureCommand, FigureTool};
use crate::app::session::effect::Effect;
use crate::app::session::notices::Gravity;
use crate::app::session::session::{Session, Tab};
use crate::app::session::tool::Tool;
use crate::app::words::messages;
use crate::document::Edit;
use crate::document::figure::{Figure, MAX_LANDMARKS, MAX_LINE, MAX_ONLY, MAX_POLYGON};

/// A free line may be off by so much, subject units.
const DRAWN_OFF: f32 = 0.0015;

impl Session {
    /// The figure of what is shown; one without regions and handles if the document has none.
    pub fn figure(&self) -> &Figure {
        static PLAIN: LazyLock<Figure> = LazyLock::new(Figure::default);
        self.shown().figure.as_ref().unwrap_or(&PLAIN)
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
            FigureCommand::Stop => self.effect(Effect::StopBending),
            FigureCommand::GoOn => self.effect(Effect::GoOnBending),
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
    pub(super) fn at_rest(&self, at: Vec2) -> Option<(usize, Vec2)> {
        self.view.figure.sheet.as_ref()?.back(at)
    }

    fn use_figure_tool(&mut self, at: Vec2, adds: bool) {
        if !at.is_finite() {
            return;
        }
        match self.tool {
            Tool::Figure(tool) if tool.draws() => {
                if self.view.figure.draft.len() < MAX_POLYGON {
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
        if at.is_finite() && is_far && draft.len() < 20 * MAX_POLYGON {
            draft.push(at);
        }
    }

    pub(super) fn nothing_here(&mut self) {
        self.notify(Gravity::Info, messages::w().nothing_here, "");
    }

    fn set_landmark(&mut self, at: Vec2) {
        let Some((_, at_rest)) = self.at_rest(at) else {
            return self.nothing_here();
        };
        let points: Vec<Vec2> = match &self.figure().context {
            Some(context) if context.points.len() >= MAX_LANDMARKS => return,
            Some(context) => {
                let points = context.points.iter().map(|at| at.as_vec2());
                points.chain([at_rest]).collect()
            }
            // A context has three points at least: the first come together.
            None => {
                self.view.figure.draft.push(at);
                if self.view.figure.draft.len() < 3 {
                    return;
                }
                let draft = std::mem::take(&mut self.view.figure.draft);
                let at_rest = draft.iter().filter_map(|at| self.at_rest(*at));
                at_rest.map(|(_, at)| at).collect()
            }
        };
        // Another picture has as many: its points no longer fit.
        let edit = Edit::All {
            name: "Add landmark".to_owned(),
            edits: vec![
                figure_edit("context/points", Some(rounded_places(&points))),
                figure_edit("context/like", Some(json!([]))),
            ],
        };
        self.apply(&edit, false);
    }

    fn finish_draft(&mut self) {
        let Some(tool) = self.tool.for_figure().filter(|tool| tool.draws()) else {
            return;
        };
        let mut draft = std::mem::take(&mut self.view.figure.draft);
        // A double click is two clicks in one place.
        draft.dedup_by(|a, b| a.distance(*b) < NO_MOVE);
        let least = if tool == FigureTool::Line { 2 } else { 3 };
        if draft.len() < least {
            return;
        }
        let most = match tool {
            FigureTool::Line => MAX_LINE,
            FigureTool::Only => MAX_ONLY,
            _ => MAX_POLYGON,
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
}
