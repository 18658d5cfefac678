//! Making tissues: new ones, their names, and leaving one unmade.

use serde_json::Value;

use super::effect::Effect;
use super::session::{Session, Tab};
use super::tissues::{
    GLIMPSE_SECONDS, Glimpse, MOST_GLIMPSE_SECONDS, TissueCommand, first_steps, free_name,
    keep_edits, set_look,
};
use super::tool::Tool;
use crate::document::{Edit, Recipe, RecipeSource};

/// Where the document lists its recipes.
const RECIPES: &str = "/subject/features";

impl Session {
    pub(super) fn run_tissue(&mut self, command: TissueCommand) {
        self.revision += 1;
        let is_seeding = matches!(self.tool(), Tool::Seed(_));
        let has_tool = self.tool().is_for_tissue();
        match command {
            TissueCommand::Make(name, range) => {
                self.make_tissue(&name, RecipeSource::Threshold { range });
            }
            TissueCommand::MakeByHand(name) => {
                if self.make_tissue(&name, RecipeSource::Nothing) {
                    self.take_ball(Some(false));
                }
            }
            TissueCommand::Rename(index, name) => self.rename_tissue(index, &name),
            TissueCommand::Remove(index) => self.remove_tissue(index),
            TissueCommand::Open(index) => {
                self.tissues.open = index;
                self.tissues.making = None;
                if has_tool {
                    self.take_tool(Tool::Look);
                }
            }
            TissueCommand::Alone(name) => self.tissues.show_alone(name),
            TissueCommand::Select(name) => {
                let since = self.now;
                self.tissues.selected = Some(name.clone());
                self.tissues.is_drawn = false;
                self.tissues.glimpse = Some(Glimpse {
                    name,
                    since,
                    drawn: None,
                });
            }
            TissueCommand::Search(text) => self.tissues.search = text,
            TissueCommand::Look(name) => self.tissues.look = name,
            TissueCommand::Seed(true) => {
                if let Some(open) = self.tissues.open {
                    self.take_tool(Tool::Seed(open));
                }
            }
            TissueCommand::Seed(false) if is_seeding => self.take_tool(Tool::Look),
            TissueCommand::Seed(false) => {}
            TissueCommand::Ball(erases) => self.take_ball(erases),
            TissueCommand::BallRadius(mm) => self.set_ball(mm),
            TissueCommand::PressBall => self.press_ball(),
            TissueCommand::PaintOn(code, found) => self.paint_on(code, found),
            TissueCommand::PaintAt(code, pos) => self.paint_at(code, pos),
            TissueCommand::DropStrokes(all) => self.drop_strokes(all),
            TissueCommand::Stop => self.effect(Effect::StopTissues),
            TissueCommand::Find => self.effect(Effect::FindTissues),
        }
    }

    /// The name, or one like it that neither a segment nor a recipe has, in capitals or not. `own` is the present name
    /// of the tissue that is to have it.
    pub fn free_name(&self, wanted: &str, own: Option<&str>) -> String {
        let facts = self.view.subject.as_ref();
        let recipes = &self.illustration().recipes;
        free_name(wanted, |name| {
            let name = name.to_lowercase();
            let is_it =
                |other: &String| other.to_lowercase() == name && Some(other.as_str()) != own;
            let is_label = |label: &u16| label.to_string() == name;
            recipes.iter().any(|recipe| is_it(&recipe.name))
                || facts.is_some_and(|facts| {
                    facts.segments.values().any(is_it) || facts.segments.keys().any(is_label)
                })
        })
    }

    /// The recipe of this index in `subject.features`.
    pub(super) fn recipe(&self, index: usize) -> Option<Recipe> {
        let mut recipes = self.illustration().recipes.iter();
        recipes.find(|recipe| recipe.index == index).cloned()
    }

    /// The recipes as the document has them, unknown ones too.
    fn recipe_values(&self) -> Vec<Value> {
        let list = self.document().get(RECIPES).and_then(Value::as_array);
        list.cloned().unwrap_or_default()
    }

    /// False if the document does not take it.
    fn make_tissue(&mut self, wanted: &str, from: RecipeSource) -> bool {
        let name = self.free_name(wanted, None);
        let facts = self.view.subject.as_ref();
        let voxel_mm = facts.and_then(|facts| facts.voxel_mm()).unwrap_or(1.0);
        let is_only = self.illustration().recipes.is_empty()
            && facts.is_none_or(|facts| facts.segments.is_empty());
        let mut list = self.recipe_values();
        let index = list.len();
        let clean = match from {
            RecipeSource::Nothing => Vec::new(),
            _ => first_steps(voxel_mm),
        };
        let recipe = Recipe {
            index,
            name: name.clone(),
            color_srgb: None,
            from,
            clean,
            paint: Vec::new(),
        };
        list.push(recipe.to_value());
        let mut edits = vec![Edit::Set {
            pointer: RECIPES.to_owned(),
            value: Value::from(list),
            name: String::new(),
        }];
        // Whoever wants to keep tissue, and had none, keeps the only one.
        if is_only {
            let templates = &self.illustration().templates;
            edits.extend(keep_edits(templates, |keep| {
                keep.is_empty().then(|| vec![name.clone()])
            }));
        }
        let edit = Edit::All {
            name: format!("Make {name}"),
            edits,
        };
        let is_made = self.apply_to_document(&edit, false);
        if is_made {
            self.tissues.open = Some(index);
            self.tissues.making = Some(index);
            self.tissues.show_alone(Some(name));
        }
        is_made
    }

    fn rename_tissue(&mut self, index: usize, wanted: &str) {
        let Some(recipe) = self.recipe(index) else {
            return;
        };
        let name = self.free_name(wanted.trim(), Some(&recipe.name));
        if name.is_empty() || name == recipe.name {
            return;
        }
        let new = Recipe {
            name: name.clone(),
            ..recipe.clone()
        };
        let mut edits = vec![Edit::Set {
            pointer: format!("{RECIPES}/{index}"),
            value: new.to_value(),
            name: String::new(),
        }];
        // What keeps it goes on keeping it.
        edits.extend(keep_edits(&self.illustration().templates, |keep| {
            let new = |old: &String| if *old == recipe.name { &name } else { old }.clone();
            keep.contains(&recipe.name)
                .then(|| keep.iter().map(new).collect())
        }));
        let mut looks = self.illustration().look.segments.iter();
        if let Some(look) = looks.find(|look| look.name == recipe.name) {
            edits.push(set_look(&recipe.name, None));
            edits.push(set_look(&name, Some((look.opacity, look.color_srgb))));
        }
        let edit = Edit::All {
            name: format!("Rename {}", recipe.name),
            edits,
        };
        if self.apply_to_document(&edit, false) && self.tissues.alone.as_ref() == Some(&recipe.name)
        {
            self.tissues.show_alone(Some(name));
        }
    }

    fn remove_tissue(&mut self, index: usize) {
        let Some(recipe) = self.recipe(index) else {
            return;
        };
        let mut list = self.recipe_values();
        if index < list.len() {
            list.remove(index);
        }
        let name = String::new();
        let mut edits = vec![if list.is_empty() {
            let pointer = RECIPES.to_owned();
            Edit::Reset { pointer, name }
        } else {
            let (pointer, value) = (RECIPES.to_owned(), Value::from(list));
            Edit::Set {
                pointer,
                value,
                name,
            }
        }];
        let illustration = self.illustration();
        let mut others = illustration.recipes.iter().filter(|r| r.index != index);
        if others.all(|other| other.name != recipe.name) {
            edits.extend(keep_edits(&illustration.templates, |keep| {
                let rest = || keep.iter().filter(|name| **name != recipe.name).cloned();
                keep.contains(&recipe.name).then(|| rest().collect())
            }));
            let mut looks = illustration.look.segments.iter();
            if looks.any(|look| look.name == recipe.name) {
                edits.push(set_look(&recipe.name, None));
            }
        }
        let edit = Edit::All {
            name: format!("Remove {}", recipe.name),
            edits,
        };
        if !self.apply_to_document(&edit, false) {
            return;
        }
        if self.tool().is_for_tissue() {
            self.take_tool(Tool::Look);
        }
        let tissues = &mut self.tissues;
        (tissues.open, tissues.making) = (None, None);
        if tissues.alone.as_ref() == Some(&recipe.name) {
            tissues.show_alone(None);
        }
    }

    /// Leaves the tissue unmade that is being made. False if none is.
    pub(super) fn leave_making(&mut self) -> bool {
        let Some(index) = self.tissues.making.take() else {
            return false;
        };
        self.remove_tissue(index);
        true
    }

    /// Goes on with what of the tissues goes by the clock or ends when another panel is seen.
    pub(super) fn advance_tissues(&mut self) {
        let panel = match self.are_drawers {
            true => self.tab,
            false => Some(self.side_tab),
        };
        if panel != Some(Tab::Tissues) {
            self.tissues.making = None;
        }
        if let Some(glimpse) = &mut self.tissues.glimpse {
            let drawn = glimpse.drawn.unwrap_or(self.now);
            glimpse.drawn = self.tissues.is_drawn.then_some(drawn);
        }
        if self
            .seconds_of_glimpse()
            .is_some_and(|seconds| seconds < 0.0)
        {
            self.tissues.glimpse = None;
            self.revision += 1;
        }
    }

    /// Seconds until a tissue has been shown for long enough.
    pub(super) fn seconds_of_glimpse(&self) -> Option<f64> {
        let glimpse = self.tissues.glimpse.as_ref()?;
        let last = glimpse.since + MOST_GLIMPSE_SECONDS;
        let end = match glimpse.drawn {
            Some(drawn) => last.min(drawn + GLIMPSE_SECONDS),
            None => last,
        };
        Some(end - self.now)
    }
}

#[cfg(test)]
mod tests {
    use super::super::tissues::with_range;
    use super::super::{Command, Session, Taken};
    use super::*;
    use crate::data::Segment;
    use crate::document::{Align, CleanStep, TemplateKind, Transfer};

    /// A session with a scan of eight voxels of these sides, mm, and these segments, that shows the tissues.
    fn session_of(json: &str, voxel_mm: f64, segments: &[&str]) -> Session {
        let segments: Vec<(u16, &str)> = (1..).zip(segments.iter().copied()).collect();
        let mut session = Session::with_scan(json, voxel_mm, &segments);
        session.side_tab = Tab::Tissues;
        session
    }

    const EMPTY: &str = r#"{ "fabrica": 1 }"#;
    /// A template that keeps no tissue yet.
    const KEEPS_NONE: &str = r#"{ "fabrica": 1, "templates": [
        { "kind": "peel", "align": { "to": "segment", "keep": [] } } ] }"#;

    fn run(session: &mut Session, command: TissueCommand) -> Vec<Effect> {
        session.run(Command::Tissue(command), 0.0)
    }

    fn make(session: &mut Session, name: &str) {
        run(
            session,
            TissueCommand::Make(name.to_owned(), [180.0, 500.0]),
        );
    }

    fn names(session: &Session) -> Vec<&str> {
        let recipes = session.illustration().recipes.iter();
        recipes.map(|recipe| recipe.name.as_str()).collect()
    }

    fn kept(session: &Session) -> &[String] {
        match &session.illustration().templates[0].align {
            Align::Segment { keep, .. } => keep,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn no_tissue_takes_the_name_of_another() {
        let mut session = session_of(EMPTY, 1.0, &["Bone", "skin"]);
        make(&mut session, "bone");
        make(&mut session, "bone");
        assert_eq!(names(&session), ["bone 2", "bone 3"]);
        let mut rename = |from: usize, to: &str| {
            run(&mut session, TissueCommand::Rename(from, to.to_owned()));
            names(&session)[from].to_owned()
        };
        assert_eq!(rename(0, " SKIN "), "SKIN 2", "in capitals or not");
        assert_eq!(rename(0, "Bone 3"), "Bone 4", "a recipe is a tissue too");
        assert_eq!(
            rename(0, "bone 4"),
            "bone 4",
            "its own name in small letters"
        );
        assert_eq!(rename(0, "2"), "2 2", "a number means a label");
        assert_eq!(rename(0, "  "), "2 2", "no name is none");
        assert_eq!(rename(0, "mandible"), "mandible");
    }

    #[test]
    fn escape_leaves_a_tissue_unmade() {
        let mut session = session_of(KEEPS_NONE, 1.0, &[]);
        let before = session.document().to_json();
        make(&mut session, "bone");
        assert_eq!(kept(&session), ["bone"], "the only tissue is kept");
        // Whatever was changed meanwhile.
        run(&mut session, TissueCommand::Rename(0, "femur".to_owned()));
        run(&mut session, TissueCommand::Seed(true));
        session.run(Command::Escape, 0.0);
        assert_eq!(names(&session), ["femur"], "the tool is put down first");
        session.run(Command::Escape, 0.0);
        assert_eq!(
            session.document().to_json(),
            before,
            "nothing is left of it"
        );
        assert_eq!(
            (session.tissues.open, &session.tissues.alone),
            (None, &None)
        );
        session.run(Command::Undo, 0.0);
        assert_eq!(names(&session), ["femur"], "it can be had again");
        session.run(Command::Escape, 0.0);
        assert_eq!(names(&session), ["femur"], "what is made stays");
    }

    #[test]
    fn a_tissue_that_is_made_stays() {
        for is_done in [true, false] {
            let mut session = session_of(EMPTY, 1.0, &[]);
            make(&mut session, "bone");
            if is_done {
                run(&mut session, TissueCommand::Open(None));
            } else {
                session.side_tab = Tab::Look;
                session.advance(1.0);
            }
            session.run(Command::Escape, 0.0);
            assert_eq!(names(&session), ["bone"], "done: {is_done}");
        }
        let mut session = session_of(EMPTY, 1.0, &[]);
        make(&mut session, "bone");
        session.run(Command::Undo, 0.0);
        assert_eq!((session.tissues.making, session.tissues.open), (None, None));
        assert_eq!(session.tissues.alone, None, "nothing to show alone");
    }

    /// What a template does to tissue that is placed in the middle of what the session shows.
    fn placed(session: &mut Session) -> Align {
        session.tool = Tool::Place(TemplateKind::Peel);
        session.run(Command::PlaceOnOrAtTarget(None), 0.0);
        session.illustration().templates[0].align.clone()
    }

    #[test]
    fn the_first_template_leaves_the_only_tissue_in_place() {
        let mut session = session_of(EMPTY, 1.0, &[]);
        assert_eq!(placed(&mut session), Align::Axis, "nothing to keep");

        let mut session = session_of(EMPTY, 1.0, &[]);
        make(&mut session, "bone");
        let before = session.document().to_json();
        placed(&mut session);
        assert_eq!(kept(&session), ["bone"]);
        session.run(Command::Undo, 0.0);
        assert_eq!(session.document().to_json(), before, "one step of undo");

        make(&mut session, "skin");
        assert_eq!(placed(&mut session), Align::Axis, "one of two");

        let mut session = session_of(EMPTY, 1.0, &["femur"]);
        make(&mut session, "bone");
        assert_eq!(placed(&mut session), Align::Axis, "the scan has its own");
    }

    #[test]
    fn only_the_only_tissue_is_kept_at_once() {
        let mut session = session_of(KEEPS_NONE, 1.0, &["skin"]);
        make(&mut session, "bone");
        assert_eq!(kept(&session), [""; 0], "there is another");
    }

    #[test]
    fn a_removed_tissue_is_kept_by_none() {
        let mut session = session_of(KEEPS_NONE, 1.0, &[]);
        make(&mut session, "bone");
        make(&mut session, "skin");
        run(&mut session, TissueCommand::Remove(0));
        assert_eq!((names(&session), kept(&session)), (vec!["skin"], &[][..]));
        session.run(Command::Undo, 0.0);
        assert_eq!(kept(&session), ["bone"], "one step of undo");
    }

    #[test]
    fn lengths_follow_the_voxels() {
        for (voxel_mm, close_mm) in [(0.1, 0.2), (0.7, 1.4), (0.09765625, 0.196), (2.0, 2.0)] {
            let mut session = session_of(EMPTY, voxel_mm, &[]);
            make(&mut session, "bone");
            let clean = &session.illustration().recipes[0].clean;
            assert_eq!(clean[0], CleanStep::Close(close_mm), "voxels of {voxel_mm}");
        }
    }

    #[test]
    fn a_tissue_is_seen_for_a_moment_and_alone_when_it_is_found() {
        let mut session = session_of(EMPTY, 1.0, &["skin"]);
        let seen = |session: &Session| {
            let facts = session.view.subject.as_ref();
            let seen = session.tissues.seen_in(session.shown(), facts)?;
            match &seen.templates[..] {
                [cut] => match &cut.align {
                    Align::Segment { keep, .. } => Some(keep.join(", ")),
                    other => panic!("{other:?}"),
                },
                more => panic!("{more:?}"),
            }
        };
        make(&mut session, "bone");
        assert_eq!(seen(&session), None, "the old picture until it is found");
        run(&mut session, TissueCommand::Alone(Some("skin".to_owned())));
        run(&mut session, TissueCommand::Alone(Some("bone".to_owned())));
        assert_eq!(seen(&session).as_deref(), Some("skin"), "what was seen");
        session.view.set_segments(&[Segment {
            label: 1,
            name: "bone".to_owned(),
            color_srgb: None,
        }]);
        assert_eq!(seen(&session).as_deref(), Some("bone"), "it is found");
        run(&mut session, TissueCommand::Alone(None));
        run(&mut session, TissueCommand::Select("bone".to_owned()));
        assert_eq!(seen(&session).as_deref(), Some("bone"));
        assert_eq!(session.tissues.selected.as_deref(), Some("bone"));
        session.advance(3.0);
        assert_eq!(seen(&session).as_deref(), Some("bone"), "until it is drawn");
        session.tissues.is_drawn = true;
        session.advance(4.0);
        session.advance(5.0);
        assert_eq!(seen(&session).as_deref(), Some("bone"), "for a second");
        session.advance(5.3);
        assert_eq!(seen(&session), None, "for a moment only");
        run(&mut session, TissueCommand::Select("bone".to_owned()));
        session.advance(20.1);
        assert_eq!(seen(&session), None, "though it takes for ever");
    }

    /// While the tissue of a new range is looked for, its values are seen; a tissue that is new is waited for.
    #[test]
    fn what_a_range_takes_is_seen_until_its_tissue_is_found() {
        let mut session = session_of(KEEPS_NONE, 1.0, &["skin"]);
        make(&mut session, "bone");
        let taken =
            |session: &Session, found: &[Recipe]| Taken::of(found, &session.illustration().recipes);
        assert_eq!(taken(&session, &[]), None, "a new one has nothing to show");
        let found = session.illustration().recipes.clone();
        assert_eq!(taken(&session, &found), None, "it is there");
        let mut change = |edit: &dyn Fn(&mut Recipe)| {
            let mut new = found[0].clone();
            edit(&mut new);
            let edit = Edit::Set {
                pointer: format!("{RECIPES}/0"),
                value: new.to_value(),
                name: String::new(),
            };
            session.run(Command::Drag(edit), 0.0);
            taken(&session, &found)
        };
        let cleaned = change(&|new| new.clean.clear());
        assert_eq!(cleaned, None, "the same values, cleaned up otherwise");
        let colored = change(&|new| {
            *new = with_range(new, [300.0, f32::MAX]);
            new.color_srgb = Some([1, 2, 3]);
        });
        let Some(Taken { range, color_srgb }) = colored else {
            panic!("other values");
        };
        assert_eq!((range[0], color_srgb), (300.0, [1, 2, 3]));
        assert!(range[1] > 1e30, "no end above");
        // What is seen: the values from 300 on and nothing else, without the templates while the tissue is alone.
        session.tissues.taken = colored;
        let facts = session.view.subject.as_mut().expect("a subject");
        facts.scan.as_mut().expect("values").value_range = [-1000.0, 2000.0];
        for is_alone in [true, false] {
            session
                .tissues
                .show_alone(is_alone.then(|| "bone".to_owned()));
            let facts = session.view.subject.as_ref();
            let seen = session.tissues.seen_in(session.shown(), facts);
            let seen = seen.expect("the values in place of the document");
            assert_eq!(seen.templates.is_empty(), is_alone);
            let Transfer::Points(points) = &seen.look.transfer else {
                panic!("{:?}", seen.look);
            };
            let opacity: Vec<f32> = points.iter().map(|point| point.opacity).collect();
            assert_eq!(opacity, [0.0, 1.0, 1.0], "no end above: {points:?}");
            assert!((points[0].value..=points[1].value).contains(&298.0));
            assert_eq!(points[1].value, 300.0);
            assert!(points.is_sorted_by(|a, b| a.value < b.value), "{points:?}");
            assert!(points.iter().all(|p| p.value.abs() < 3000.0), "{points:?}");
        }
        session.tissues.taken = None;
        let facts = session.view.subject.as_ref();
        assert_eq!(session.tissues.seen_in(session.shown(), facts), None);
    }

    #[test]
    fn stopping_and_going_on_are_for_the_window() {
        let mut session = session_of(EMPTY, 1.0, &[]);
        let effects = run(&mut session, TissueCommand::Stop);
        assert!(matches!(effects[..], [Effect::StopTissues]));
        let effects = run(&mut session, TissueCommand::Find);
        assert!(matches!(effects[..], [Effect::FindTissues]));
    }
}
