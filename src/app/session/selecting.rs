//! What is done with the selected template or object.

use glam::Vec3;

use super::selection::Selection;
use super::session::{Session, Tab};
use super::tool::Tool;
use crate::document::{Edit, ParamKind, ParamValue};

impl Session {
    /// Selects a template, an object or nothing.
    pub(super) fn select(&mut self, selection: Selection) {
        self.selection = selection;
        if self.tool.placing().is_some() {
            self.take_tool(Tool::Look);
        }
        if selection != Selection::Nothing {
            self.side_tab = Tab::Templates;
        }
    }

    /// Selects the next one of all templates and then all objects, or the one before.
    pub(super) fn select_next(&mut self, forward: bool) {
        if self.view.is_figure() {
            return self.next_of_figure(forward);
        }
        let templates = self.template_count();
        let count = templates + self.object_count();
        if count == 0 {
            return;
        }
        let step = if forward { 1 } else { count - 1 };
        let next = match self.selection {
            Selection::Template(index) => (index + step) % count,
            Selection::Object(index) => (templates + index + step) % count,
            Selection::Nothing | Selection::Stroke(_) if forward => 0,
            Selection::Nothing | Selection::Stroke(_) => count - 1,
        };
        self.selection = match next.checked_sub(templates) {
            None => Selection::Template(next),
            Some(object) => Selection::Object(object),
        };
        self.side_tab = Tab::Templates;
    }

    /// Removes what is selected, and selects what comes in its place.
    pub(super) fn delete_selected(&mut self) {
        if self.view.is_figure() {
            return self.delete_of_figure();
        }
        // At a step it may stay in the list, switched off: then nothing is selected.
        let next = |index: usize, before: usize, after: usize| {
            let last = after.checked_sub(1).filter(|_| after < before);
            last.map(|last| index.min(last))
        };
        match self.selection {
            Selection::Nothing => {}
            Selection::Template(template) => {
                let before = self.template_count();
                self.apply(&Edit::RemoveTemplate { template }, false);
                let next = next(template, before, self.template_count());
                self.selection = Selection::of_template(next);
            }
            Selection::Object(object) => {
                let before = self.object_count();
                self.apply(&Edit::RemoveObject { object }, false);
                let next = next(object, before, self.object_count());
                self.selection = Selection::of_object(next);
            }
            Selection::Stroke(stroke) => {
                let count = |session: &Self| session.clay().map_or(0, |clay| clay.strokes.len());
                let before = count(self);
                self.apply(&Edit::RemoveStroke { stroke }, false);
                let next = next(stroke, before, count(self));
                self.selection = next.map_or(Selection::Nothing, Selection::Stroke);
            }
        }
    }

    /// Makes a copy of what is selected behind it, and selects the copy.
    pub(super) fn duplicate_selected(&mut self) {
        match self.selection {
            Selection::Nothing | Selection::Stroke(_) => {}
            Selection::Template(template) => {
                if self.apply(&Edit::DuplicateTemplate { template }, false) {
                    self.selection = Selection::Template(template + 1);
                }
            }
            Selection::Object(object) => {
                if self.apply(&self.copy_of_object(object), false) {
                    self.selection = Selection::Object(object + 1);
                }
            }
        }
    }

    /// Shows or hides what is selected.
    pub(super) fn toggle_selected(&mut self) {
        if self.view.is_figure() {
            return self.toggle_of_figure();
        }
        let edit = if let Some(template) = self.selected_template() {
            Edit::SetEnabled {
                template: template.index,
                enabled: !template.enabled,
            }
        } else if let Some(object) = self.selected_object() {
            super::objects::enabling(object, !object.enabled)
        } else if let Some(stroke) = self.selection.stroke() {
            return self.switch_stroke(stroke);
        } else {
            return;
        };
        self.apply(&edit, false);
    }

    /// Moves what is selected down in its list by so many places, or up. The selection goes with it.
    pub(super) fn shift_selected(&mut self, by: i8) {
        if self.view.is_figure() {
            return self.shift_of_figure(by);
        }
        let moved_by = |by: i8, from: usize, count: usize| {
            let to = from.saturating_add_signed(isize::from(by));
            Some(to).filter(|to| *to != from && *to < count)
        };
        let moved = |from: usize, count: usize| moved_by(by, from, count);
        let (edit, selection) = match self.selection {
            Selection::Nothing => return,
            Selection::Stroke(from) => {
                // The last one stands on top of the list.
                let count = self.clay().map_or(0, |clay| clay.strokes.len());
                let to = moved_by(by.saturating_neg(), from, count);
                let edit = to.and_then(|to| Some((self.moved_stroke(from, to)?, to)));
                let Some((edit, to)) = edit else {
                    return;
                };
                (edit, Selection::Stroke(to))
            }
            Selection::Template(from) => {
                let Some(to) = moved(from, self.template_count()) else {
                    return;
                };
                (Edit::MoveTemplate { from, to }, Selection::Template(to))
            }
            Selection::Object(from) => {
                let Some(to) = moved(from, self.object_count()) else {
                    return;
                };
                (Edit::MoveObject { from, to }, Selection::Object(to))
            }
        };
        if self.apply(&edit, false) {
            self.selection = selection;
        }
    }

    /// Does more or less of what the selected template is for; pushes the selected object on or draws it back.
    pub(super) fn nudge_main(&mut self, hundredths: f32) {
        if let Some(edit) = self.pushed_object(hundredths) {
            let edit = self.with_group(edit);
            self.apply(&edit, true);
            return;
        }
        let Some(template) = self.selected_template() else {
            return;
        };
        let spec = template.kind.spec();
        let Some(param) = spec.main_param else {
            return;
        };
        let (kind, value) = (&spec.params[param].kind, template.params[param]);
        let value = match (kind, value) {
            (
                ParamKind::Number { min, max, .. } | ParamKind::Count { min, max, .. },
                ParamValue::Number(value),
            ) => ParamValue::Number((value + (max - min) * hundredths / 100.0).clamp(*min, *max)),
            (_, ParamValue::Vector(v)) => {
                ParamValue::Vector(v + v.normalize_or(Vec3::Z) * hundredths / 100.0)
            }
            _ => return,
        };
        let edit = Edit::SetParam {
            template: template.index,
            param: spec.params[param].name,
            value,
        };
        self.apply(&edit, true);
    }
}
