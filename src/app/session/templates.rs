//! What an author does with whole templates: copy them to another document, mirror, group. Templates of a group are
//! copied, mirrored and moved together.

use serde_json::Value;

use super::clipboard::Copied;
use super::effect::Effect;
use super::notices::Gravity;
use super::selection::Selection;
use super::session::{Session, Tab};
use super::tool::Tool;
use crate::app::words::authoring::w;
use crate::app::words::fill;
use crate::app::words::names::template_title;
use crate::document::{
    Edit, Plane, free_group_name, group_of, groups, mirror, templates_from_text, templates_to_text,
};

impl Session {
    /// The selected template and those of its group, by their indices in the document.
    pub(super) fn acted_on(&self) -> Vec<usize> {
        let Some(selected) = self.selection.template() else {
            return Vec::new();
        };
        let group = group_of(self.document(), selected);
        if group.is_empty() {
            return vec![selected];
        }
        (0..self.template_count())
            .filter(|index| group_of(self.document(), *index) == group)
            .collect()
    }

    /// Puts the selected templates on the clipboard. True if there were any.
    pub(super) fn copy_templates(&mut self) -> bool {
        let templates = self.acted_on();
        if templates.is_empty() {
            return false;
        }
        let text = templates_to_text(self.document(), &templates);
        self.clipboard.last = Copied::Templates(templates.len());
        self.clipboard.templates = Some(text.clone());
        self.effect(Effect::Copy(text));
        true
    }

    /// Puts the selected templates on the clipboard and takes them out of the document: one step of undo.
    pub(super) fn cut_templates(&mut self) {
        let templates = self.acted_on();
        if !self.copy_templates() {
            return;
        }
        let edits = templates
            .iter()
            .rev()
            .map(|&template| Edit::RemoveTemplate { template });
        let edit = Edit::All {
            name: "Cut templates".to_owned(),
            edits: edits.collect(),
        };
        if self.apply(&edit, false) {
            self.selection = Selection::Nothing;
        }
    }

    /// Takes templates out of a text behind the selected one. False if the text is something else.
    pub(super) fn paste_templates(&mut self, text: &str) -> bool {
        let mut templates = match templates_from_text(text) {
            None => return false,
            Some(Ok(templates)) => templates,
            Some(Err(error)) => {
                self.notify(Gravity::Error, fill(w().cannot_paste, &[&error]), "");
                return true;
            }
        };
        let Some(last) = templates.len().checked_sub(1) else {
            return true;
        };
        self.rename_groups(&mut templates);
        let index = self
            .selection
            .template()
            .map_or(self.template_count(), |selected| selected + 1);
        if self.apply(&Edit::InsertTemplates { index, templates }, false) {
            self.select_made(index);
            let text = fill(w().pasted, &[&(last + 1)]);
            self.notify(Gravity::Success, text, "");
        }
        true
    }

    /// Takes the text that “Paste” found on the clipboard. `None` if the clipboard may not be read: then templates that
    /// were copied in this window are pasted.
    pub fn take_pasted(&mut self, text: Option<String>) {
        let is_refused = text.is_none();
        let text = text.or_else(|| self.clipboard.templates.clone());
        match text.filter(|text| !text.trim().is_empty()) {
            Some(text) => self.open_text(&text),
            None if is_refused => {
                let text = w().press_keys;
                self.notify(Gravity::Info, text, "");
            }
            None => {
                let text = w().nothing_to_paste;
                self.notify(Gravity::Info, text, "");
            }
        }
    }

    /// Groups that come from elsewhere do not join those of the same name here.
    fn rename_groups(&self, templates: &mut [Value]) {
        let taken = groups(self.document());
        for template in templates {
            if let Some(Value::String(group)) = template.get_mut("group")
                && !group.is_empty()
            {
                *group = free_group_name(group, &taken);
            }
        }
    }

    fn select_made(&mut self, index: usize) {
        self.selection = Selection::Template(index);
        if self.tool.placing().is_some() {
            self.tool = Tool::Look;
        }
        self.side_tab = Tab::Templates;
    }

    /// Mirrors the selected templates across a middle plane of the subject, where they are or as copies.
    pub(super) fn mirror_selected(&mut self, plane: Plane, as_copy: bool) {
        let (Some(selected), acted_on) = (self.selection.template(), self.acted_on()) else {
            return;
        };
        let group = group_of(self.document(), selected);
        let copies = (as_copy && !group.is_empty())
            .then(|| free_group_name(group, &groups(self.document())));
        let all = self.illustration().templates.iter();
        let mut titles: Vec<String> = all.map(template_title).collect();
        let mut edits = Vec::new();
        // From the last to the first, so that a copy moves none of those that are still to come.
        for &index in acted_on.iter().rev() {
            let Some(template) = self.template(index) else {
                continue;
            };
            edits.extend(mirror(template, plane, as_copy));
            if as_copy {
                let name = mirrored_name(&template_title(template), &titles);
                titles.push(name.clone());
                edits.push(Edit::RenameTemplate {
                    template: index + 1,
                    name,
                });
            }
            if let Some(group) = &copies {
                edits.push(Edit::SetGroup {
                    template: index + 1,
                    group: group.clone(),
                });
            }
        }
        if edits.is_empty() {
            return;
        }
        let edit = Edit::All {
            name: "Mirror templates".to_owned(),
            edits,
        };
        if self.apply(&edit, false) && as_copy {
            let before = acted_on.iter().filter(|index| **index < selected).count();
            self.select_made(selected + before + 1);
        }
    }
}

/// A name for the mirror image of a template, other than the titles that are taken: that of the image of an image is
/// the first one's.
fn mirrored_name(title: &str, taken: &[String]) -> String {
    let suffix = fill(w().mirrored, &[&""]);
    let wanted = match title.strip_suffix(&suffix) {
        Some(first) => first.to_owned(),
        None => fill(w().mirrored, &[&title]),
    };
    free_group_name(&wanted, taken)
}
