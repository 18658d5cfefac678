//! What an author does with whole templates: copy them to another document, mirror, group, lay on the surface again, move in
//! steps. Templates of a group are copied, mirrored and moved together.

use glam::{Quat, Vec3};
use serde_json::Value;

use super::camera;
use super::command::Command;
use super::services::Services;
use super::state::{Gravity, State, Tab};
use super::words::fill;
use super::words::making::w;
use crate::document::{
    Camera, Edit, Illustration, PlacedTemplate, Plane, TemplateKind, free_group_name, group_of,
    groups, mirror, templates_from_text, templates_to_text,
};
use crate::math::Placement;

/// What was last put on the clipboard, for the message that it is there.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum OnClipboard {
    /// The link to the document.
    #[default]
    Link,
    /// So many templates.
    Templates(usize),
}

/// How the author works, beside the document. Lives as long as the window.
#[derive(Debug, Default)]
pub(crate) struct Making {
    /// Handles go in steps.
    pub is_snapping: bool,
    /// A template of a group is moved without the others, while the key for it is held.
    pub is_alone: bool,
    /// What the clipboard last took.
    pub on_clipboard: OnClipboard,
    /// Templates that were copied here, for where the clipboard may not be read.
    pub clip: Option<String>,
    /// The template that is to lie on the surface again.
    pub wants_surface: Option<usize>,
    /// The template that is to follow the surface.
    pub wants_curve: Option<usize>,
    /// What has been found of that surface so far.
    pub tracing: Option<super::curve::Tracing>,
    /// What is typed over the catalogue.
    pub search: String,
    /// The search wants the keyboard.
    pub wants_search: bool,
}

/// Steps of the handles when they snap.
pub(crate) mod step {
    /// Degrees of a turn.
    pub(crate) const TURN_DEG: f32 = 15.0;
    /// Subject units of a move, and of a side of the box.
    pub(crate) const LENGTH: f32 = 0.05;
    /// Part of the range of a main parameter.
    pub(crate) const PARAM: f32 = 0.05;

    /// The nearest step.
    pub(crate) fn nearest(value: f32, step: f32) -> f32 {
        (value / step).round() * step
    }
}

impl State {
    /// The selected template and those of its group, by their indices in the document.
    pub(crate) fn acted_on(&self) -> Vec<usize> {
        let Some(selected) = self.selected else {
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

    /// Turns to the next panel, or the one before, and gives it the keyboard.
    pub(crate) fn next_panel(&mut self, forward: bool, are_drawers: bool) {
        const PANELS: [Tab; 5] = [Tab::Add, Tab::Templates, Tab::Tissues, Tab::Look, Tab::Text];
        // The catalogue has a place of its own where there is room.
        let panels = if are_drawers {
            &PANELS[..]
        } else {
            &PANELS[1..]
        };
        let current = if are_drawers {
            self.tab
        } else {
            Some(self.side_tab)
        };
        let at = panels.iter().position(|tab| Some(*tab) == current);
        let count = panels.len();
        let next = match (at, forward) {
            (Some(at), true) => (at + 1) % count,
            (Some(at), false) => (at + count - 1) % count,
            (None, true) => 0,
            (None, false) => count - 1,
        };
        self.are_panels_hidden = false;
        self.side_tab = panels[next];
        self.tab = are_drawers.then_some(panels[next]);
        self.wants_panel_focus = true;
    }

    /// The first hint was read or followed to its end: it does not come again.
    pub(crate) fn put_hint_away(&mut self, services: &mut dyn Services) {
        if std::mem::take(&mut self.wants_hint) {
            services.store(super::hint::STORED, "seen");
        }
    }

    /// Puts the selected templates on the clipboard. True if there were any.
    pub(crate) fn copy_templates(&mut self, services: &mut dyn Services) -> bool {
        let templates = self.acted_on();
        if templates.is_empty() {
            return false;
        }
        let text = templates_to_text(self.document(), &templates);
        self.making.on_clipboard = OnClipboard::Templates(templates.len());
        self.making.clip = Some(text.clone());
        services.copy_text(text);
        true
    }

    /// The same, and takes them out of the document: one step of undo.
    pub(crate) fn cut_templates(&mut self, services: &mut dyn Services) {
        let templates = self.acted_on();
        if !self.copy_templates(services) {
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
        if self.apply_checked(&edit, false) {
            self.selected = None;
        }
    }

    /// Takes templates out of a text behind the selected one. False if the text is something else.
    pub(crate) fn paste_templates(&mut self, text: &str) -> bool {
        let mut templates = match templates_from_text(text) {
            None => return false,
            Some(Ok(templates)) => templates,
            Some(Err(error)) => {
                self.say(Gravity::Error, fill(w().cannot_paste, &[&error]), "");
                return true;
            }
        };
        let Some(last) = templates.len().checked_sub(1) else {
            return true;
        };
        self.leave_steps();
        self.rename_groups(&mut templates);
        let index = self
            .selected
            .map_or(self.template_count(), |selected| selected + 1);
        if self.apply_checked(&Edit::InsertTemplates { index, templates }, false) {
            self.select_made(index);
            let text = fill(w().pasted, &[&(last + 1)]);
            self.say(Gravity::Success, text, "");
        }
        true
    }

    /// What a tap on “Paste” found. Where the clipboard may not be read, what was copied in this window is taken.
    pub(crate) fn take_pasted(&mut self, text: Option<String>, services: &mut dyn Services) {
        let is_refused = text.is_none();
        let text = text.or_else(|| self.making.clip.clone());
        match text.filter(|text| !text.trim().is_empty()) {
            Some(text) => self.open_text(&text, services),
            None if is_refused => {
                let text = w().press_keys;
                self.say(Gravity::Info, text, "");
            }
            None => {
                let text = w().nothing_to_paste;
                self.say(Gravity::Info, text, "");
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
        self.selected = Some(index);
        self.placing = None;
        self.side_tab = Tab::Templates;
    }

    /// Mirrors the selected templates across a middle plane of the subject, where they are or as copies.
    pub(crate) fn mirror_selected(&mut self, plane: Plane, as_copy: bool) {
        let (Some(selected), acted_on) = (self.selected, self.acted_on()) else {
            return;
        };
        let group = group_of(self.document(), selected);
        let copies = (as_copy && !group.is_empty())
            .then(|| free_group_name(group, &groups(self.document())));
        let mut edits = Vec::new();
        // From the last to the first, so that a copy moves none of those that are still to come.
        for &index in acted_on.iter().rev() {
            let Some(template) = self.template(index) else {
                continue;
            };
            edits.extend(mirror(template, plane, as_copy));
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
        if self.apply_checked(&edit, false) && as_copy {
            let before = acted_on.iter().filter(|index| **index < selected).count();
            self.select_made(selected + before + 1);
        }
    }

    fn template(&self, index: usize) -> Option<&PlacedTemplate> {
        let mut templates = self.illustration().templates.iter();
        templates.find(|template| template.index == index)
    }

    /// Puts the selected template into the group of the one before it in the list, or both into a new one.
    pub(crate) fn group_with_previous(&mut self) {
        let Some(template) = self.selected else {
            return;
        };
        let Some(previous) = template.checked_sub(1) else {
            self.say(Gravity::Info, w().nothing_before, "");
            return;
        };
        let known = group_of(self.document(), previous);
        let edit = if known.is_empty() {
            let group = free_group_name(w().group, &groups(self.document()));
            let both = [previous, template].map(|template| Edit::SetGroup {
                template,
                group: group.clone(),
            });
            Edit::All {
                name: "Group templates".to_owned(),
                edits: both.to_vec(),
            }
        } else {
            Edit::SetGroup {
                template,
                group: known.to_owned(),
            }
        };
        self.apply_checked(&edit, false);
    }

    /// Takes the selected template out of its group.
    pub(crate) fn leave_group(&mut self) {
        if let Some(template) = self.selected {
            let group = String::new();
            self.apply_checked(&Edit::SetGroup { template, group }, false);
        }
    }

    /// A template's new place taken over by those of its group: they turn and move with it as one.
    pub(crate) fn with_group(&self, edit: Edit) -> Edit {
        let Edit::SetPlacement {
            template,
            placement,
        } = edit
        else {
            return edit;
        };
        let group = group_of(self.document(), template);
        let Some(before) = self.template(template).map(|t| t.placement) else {
            return edit;
        };
        // A side that is drawn out belongs to the one box alone.
        if group.is_empty() || self.making.is_alone || before.size != placement.size {
            return edit;
        }
        let turn = placement.rotate * before.rotate.conjugate();
        let mut edits = vec![Edit::SetPlacement {
            template,
            placement,
        }];
        for other in &self.illustration().templates {
            if other.index != template && group_of(self.document(), other.index) == group {
                let offset = turn * (other.placement.at - before.at);
                let limit = Vec3::splat(4.0);
                edits.push(Edit::SetPlacement {
                    template: other.index,
                    placement: Placement {
                        at: (placement.at + offset).clamp(-limit, limit),
                        rotate: (turn * other.placement.rotate).normalize(),
                        size: other.placement.size,
                    },
                });
            }
        }
        let verb = if before.rotate == placement.rotate {
            "Move"
        } else {
            "Turn"
        };
        Edit::All {
            name: format!("{verb} group {group}"),
            edits,
        }
    }

    /// What has to be looked at to lay a template on the surface again: the object as the templates before it leave it, seen
    /// along the template's own axis.
    pub(crate) fn surface_view(&self, template: usize) -> Option<(Illustration, Camera)> {
        let placed = self.template(template)?;
        let camera = camera_along(&placed.placement);
        let mut seen = self.illustration().clone();
        seen.templates.retain(|other| other.index < template);
        Some((seen, camera))
    }

    /// Lays the template on a surface that was found along its axis. `normal` points out of the object.
    pub(crate) fn lay_on_surface(&mut self, template: usize, pos: Vec3, normal: Vec3) {
        let Some(placed) = self.template(template) else {
            return;
        };
        let before = placed.placement;
        let z = normal.normalize_or(before.rotate * Vec3::Z);
        let turn = Quat::from_rotation_arc((before.rotate * Vec3::Z).normalize_or(Vec3::Z), z);
        let above = shape_of(placed.kind).above;
        let placement = Placement {
            at: pos + z * before.size.z * (above - 0.5),
            rotate: (turn * before.rotate).normalize(),
            size: before.size,
        };
        let edit = self.with_group(Edit::SetPlacement {
            template,
            placement,
        });
        let edit = Edit::All {
            name: "Lay on the surface".to_owned(),
            edits: vec![edit],
        };
        self.apply_checked(&edit, false);
    }
}

/// Where a new template lies that was put on a surface: its z axis along the normal, its y axis up in the picture as far as
/// that goes, its top a little above the surface. `normal` points out of the object.
pub(crate) fn placement_on_surface(
    kind: TemplateKind,
    pos: Vec3,
    normal: Vec3,
    camera: &Camera,
) -> Placement {
    // The size follows what one sees: about a quarter of the picture's shorter side, within reason.
    let seen = 2.0 * camera.distance * (0.5 * camera.fov_deg.to_radians()).tan();
    let side = (0.25 * seen).clamp(0.08, 0.5);
    let z = normal.normalize_or(Vec3::Y);
    let [right, up, _] = camera::axes(camera.rotate);
    let y = (up - z * up.dot(z))
        .try_normalize()
        .or_else(|| (right - z * right.dot(z)).try_normalize());
    let y = y.unwrap_or_else(|| z.any_orthonormal_vector());
    let x = y.cross(z);
    let rotate = Quat::from_mat3(&glam::Mat3::from_cols(x, y, z)).normalize();
    let Shape { size, above } = shape_of(kind);
    let size = size * side;
    // `above` of the box stands over the surface, the rest reaches into the object.
    let at = pos + z * size.z * (above - 0.5);
    Placement { at, rotate, size }
}

/// Proportions of a new template: its box in parts of the sensible side, and how much of its height stands above the surface.
pub(super) struct Shape {
    size: Vec3,
    pub(super) above: f32,
}

pub(super) fn shape_of(kind: TemplateKind) -> Shape {
    use TemplateKind as K;
    let (size, above) = match kind {
        // Layers: wide and flat, the top just over the skin, so that on a curved surface the layer still reaches it at
        // the edges.
        K::Peel | K::Flap => (Vec3::new(1.0, 0.8, 0.6), 0.06),
        K::Peeler => (Vec3::new(0.8, 1.0, 0.6), 0.7),
        // Openings: as deep as wide, the top over the skin.
        K::Retractor | K::Cutquad | K::Hole | K::Split => (Vec3::new(1.0, 1.0, 0.8), 0.15),
        K::Poke => (Vec3::new(0.9, 0.9, 0.6), 0.2),
        // What turns or bends the whole goes around the place.
        K::Twist | K::Bend | K::Squeeze | K::Dilate | K::Slices | K::Wave => {
            (Vec3::splat(1.5), 0.5)
        }
        K::Pull | K::Lens | K::Rbf | K::Field => (Vec3::splat(1.0), 0.5),
        K::Cut => (Vec3::new(1.0, 1.0, 1.0), 0.5),
        K::Move => (Vec3::new(0.9, 0.9, 0.7), 0.3),
    };
    Shape { size, above }
}

/// Looks at a box along its z axis from above it, from outside of any subject.
fn camera_along(placement: &Placement) -> Camera {
    let z = (placement.rotate * Vec3::Z).normalize_or(Vec3::Z);
    // The camera's identity looks from +y towards −y with +z up.
    let turned = Quat::from_rotation_arc(Vec3::Y, z);
    Camera {
        target: placement.at,
        rotate: turned,
        distance: 3.0,
        fov_deg: 20.0,
    }
}

/// Entries of the menu of a template: what it says, what it does, and whether it can be done now.
pub(crate) fn menu_entries(state: &State) -> Vec<MenuEntry> {
    use super::icon::Icon;
    let w = w();
    let has_one = state.selected.is_some();
    let mut entries = Vec::new();
    let mut add = |icon, text: &'static str, command| {
        entries.push(MenuEntry {
            icon,
            text,
            command,
        });
    };
    if has_one {
        add(Icon::Copy, w.copy, Command::Copy);
        add(Icon::Cut, w.cut, Command::Cut);
    }
    add(Icon::Paste, w.paste, Command::Paste);
    if let Some(selected) = state.selected {
        let words = super::words::picture::w();
        let is_on = state.selected_template().is_some_and(|t| t.enabled);
        let (eye, text) = match is_on {
            true => (Icon::EyeOff, words.hide),
            false => (Icon::Eye, words.show),
        };
        add(eye, text, Command::ToggleSelected);
        add(Icon::Plus, w.duplicate, Command::DuplicateSelected);
        add(
            Icon::Mirror,
            w.mirror_sagittal,
            Command::Mirror(Plane::Sagittal, true),
        );
        add(
            Icon::Mirror,
            w.mirror_coronal,
            Command::Mirror(Plane::Coronal, true),
        );
        add(
            Icon::Mirror,
            w.mirror_axial,
            Command::Mirror(Plane::Axial, true),
        );
        add(
            Icon::Mirror,
            w.mirror_here,
            Command::Mirror(Plane::Sagittal, false),
        );
        add(Icon::Down, w.lay, Command::LayOnSurface);
        let follow = super::words::curve::w().follow;
        add(Icon::Down, follow, Command::FollowSurface);
        if selected > 0 {
            add(Icon::Layers, w.group_previous, Command::GroupWithPrevious);
        }
        if !group_of(state.document(), selected).is_empty() {
            add(Icon::Close, w.leave_group, Command::LeaveGroup);
        }
        add(Icon::Trash, words.delete, Command::DeleteSelected);
    }
    let snap = if state.making.is_snapping {
        w.snap_off
    } else {
        w.snap_on
    };
    add(Icon::Snap, snap, Command::ToggleSnap);
    entries
}

/// An entry of the menu of a template.
pub(crate) struct MenuEntry {
    /// At its left.
    pub icon: super::icon::Icon,
    /// What it says.
    pub text: &'static str,
    /// What it does.
    pub command: Command,
}

/// The menu of the selected template, wherever it is opened from: a button, the right mouse button, a long press.
pub(crate) fn menu_ui(ui: &mut egui::Ui, state: &State, commands: &mut Vec<Command>) {
    ui.set_min_width(236.0);
    ui.spacing_mut().item_spacing.y = 0.0;
    for entry in menu_entries(state) {
        if super::topbar::menu_item(ui, entry.icon, entry.text) {
            commands.push(entry.command);
            ui.close();
        }
    }
}
