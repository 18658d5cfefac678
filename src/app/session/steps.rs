//! Recording the steps of a lesson, as a slide program does it: what is done while a step is shown is what that step
//! sets.

use serde_json::json;

use super::command::StepCommand;
use super::notices::Gravity;
use super::session::Session;
use crate::app::words::steps::w;
use crate::document::{Camera, Document, Edit};

impl Session {
    pub(super) fn run_step(&mut self, command: StepCommand) {
        match command {
            StepCommand::Add => self.add_step(),
            StepCommand::Duplicate(0) => self.record(
                Edit::AddStep {
                    index: 0,
                    step: json!({}),
                },
                1,
            ),
            StepCommand::Duplicate(step) => {
                self.record(Edit::DuplicateStep { step: step - 1 }, step + 1);
            }
            StepCommand::Delete(0) => {}
            StepCommand::Delete(step) => {
                let shown = self.step();
                let next = if shown > step { shown - 1 } else { shown };
                self.record(Edit::RemoveStep { step: step - 1 }, next);
            }
            StepCommand::Move { from, to } => {
                if let (Some(from), Some(index)) = (from.checked_sub(1), to.checked_sub(1))
                    && from != index
                {
                    self.record(Edit::MoveStep { from, to: index }, to);
                }
            }
            StepCommand::Update => self.update_step(),
            StepCommand::TogglePlay => self.toggle_playing(),
            StepCommand::Scrub(position) => self.scrub(position),
        }
    }

    /// Changes the list of steps, as one step of undo, and shows one of them at once.
    fn record(&mut self, edit: Edit, step: usize) {
        self.end_drag();
        if self.apply_to_document(&edit, false) {
            self.go(step, true);
            self.take_view();
        }
    }

    /// Looks from where the step looks that is shown: as the document has it, which rounds.
    fn take_view(&mut self) {
        self.glide = None;
        self.camera = self.view_of_step();
    }

    /// The camera of the step that is shown.
    fn view_of_step(&self) -> Camera {
        let lesson = self.document().lesson();
        let state = lesson.and_then(|lesson| lesson.at_step(self.step()));
        state.map_or(self.illustration().camera, |state| state.camera)
    }

    /// Where one looks from, or is about to.
    fn camera_now(&self) -> Camera {
        self.glide.map_or(self.camera, |glide| glide.to)
    }

    /// True if the view is another one than that of the step that is shown.
    pub fn is_view_other(&self) -> bool {
        self.camera_now() != self.view_of_step()
    }

    fn add_step(&mut self) {
        let step = self.step();
        let turned = self.is_view_other();
        let view = Edit::SetCamera(self.camera_now());
        let mut edits = Vec::new();
        let mut value = json!({});
        if turned && self.document().step_count() == 0 {
            // A lesson begins: its start looks as it does now, and the first step as the start.
            edits.push(view);
        } else if turned {
            match self.document().step_after(step, &view) {
                Ok(after) => value = after,
                Err(error) => return self.notify(Gravity::Error, error.to_string(), ""),
            }
        }
        edits.push(Edit::AddStep {
            index: step,
            step: value,
        });
        let edit = Edit::All {
            name: "Add step".to_owned(),
            edits,
        };
        self.record(edit, step + 1);
    }

    fn update_step(&mut self) {
        if !self.is_view_other() {
            return;
        }
        let edit = Edit::SetCamera(self.camera_now());
        self.end_drag();
        if self.apply(&edit, false) {
            self.take_view();
        }
    }

    /// The edit as it is to be done while the step is shown that is shown.
    pub(super) fn at_step_shown(&self, edit: &Edit) -> Edit {
        match self.step() {
            0 => edit.clone(),
            step => Edit::AtStep {
                step,
                edit: Box::new(edit.clone()),
            },
        }
    }

    /// Templates, objects and captions of the document, all together.
    pub(super) fn entry_count(&self) -> usize {
        self.template_count() + self.object_count() + self.illustration().captions.len()
    }

    /// Says what an edit means for other steps, where that is not plain to see. `before` is the number of entries
    /// before it.
    pub(super) fn tell_of_steps(&mut self, edit: &Edit, before: usize) {
        if self.document().step_count() == 0 {
            return;
        }
        let after = self.entry_count();
        let text = match edit {
            Edit::MoveTemplate { .. } => w().order_for_all,
            Edit::RemoveTemplate { .. }
            | Edit::RemoveObject { .. }
            | Edit::RemoveCaption { .. }
                if self.step() > 0 && after == before =>
            {
                w().hidden_from_here
            }
            _ => return,
        };
        self.notify(Gravity::Info, text, "");
    }

    /// After undo or redo: stays at the step that was shown if something has changed there, else goes to the first step
    /// that has changed.
    pub(super) fn show_change(&mut self, before: &Document, shown: usize) {
        let after = self.document();
        let count = before.step_count().max(after.step_count());
        if count == 0 {
            return;
        }
        let (Ok(old), Ok(new)) = (before.lesson(), after.lesson()) else {
            return;
        };
        let is_same = |step: usize| {
            let entry = |document: &Document| {
                let index = step.checked_sub(1)?;
                document.illustration().steps.get(index).cloned()
            };
            old.at_step(step).ok() == new.at_step(step).ok() && entry(before) == entry(after)
        };
        if !is_same(shown) {
            return;
        }
        if let Some(changed) = (0..=count).find(|step| !is_same(*step)) {
            self.go(changed.min(self.document().step_count()), true);
        }
    }
}
