//! Using the active tool: which question a click asks, and what its answer does.

use glam::Vec3;

use super::camera;
use super::command::Command;
use super::effect::{Effect, Focus};
use super::found::Found;
use super::notices::Gravity;
use super::question::{Place, Question};
use super::selection::Selection;
use super::session::{Session, Tab};
use super::shape::placement_on_surface;
use super::tissues::{with_range, with_seeds};
use super::tool::Tool;
use crate::app::words::{capitalized, captions, fill, kept, messages};
use crate::clay::Way;
use crate::document::{
    Align, Camera, Caption, Edit, MAX_SEEDS, RecipeSource, SubjectRef, TemplateKind,
};
use crate::math::Placement;

impl Session {
    /// Asks about a pixel of the picture for the active tool.
    pub(super) fn use_tool_at(&mut self, pixel: [f32; 2]) {
        let reply: fn(usize, Option<Found>) -> Command = match self.tool {
            Tool::Look | Tool::Level | Tool::Paint { .. } | Tool::Figure(_) => return,
            Tool::Clay => {
                let question = self.ask_where_to_lay(Place::Pixel(pixel));
                return self.effects.extend(question.map(Effect::Ask));
            }
            Tool::Place(_) => |_, found| Command::PlaceOn(found),
            Tool::Caption => |_, found| Command::CaptionOn(found),
            Tool::Seed(_) => |_, found| Command::SeedOn(found),
            Tool::Measure(_) => |_, found| Command::Measure(found.map(|found| found.pos)),
        };
        self.effect(Effect::Ask(Question {
            adds: self.tool.adds_up(),
            ..Question::new(Place::Pixel(pixel), reply)
        }));
    }

    /// Asks about the middle of the picture, for the tools that wait for one place.
    pub(super) fn use_tool_in_middle(&mut self) {
        let reply: fn(usize, Option<Found>) -> Command = match self.tool {
            Tool::Place(_) => |_, found| Command::PlaceOnOrAtTarget(found),
            Tool::Caption => |_, found| Command::CaptionOn(found),
            Tool::Figure(_) => return self.use_figure_tool_in_middle(),
            Tool::Look | Tool::Seed(_) | Tool::Paint { .. } | Tool::Measure(_) | Tool::Level => {
                return;
            }
            Tool::Clay if !self.together.ghosts.is_empty() => return self.act_together(),
            Tool::Clay => {
                let question = self.ask_where_to_lay(Place::Middle);
                return self.effects.extend(question.map(Effect::Ask));
            }
        };
        self.effect(Effect::Ask(Question::new(Place::Middle, reply)));
    }

    pub(super) fn notify_nothing_here(&mut self) {
        self.notify(Gravity::Info, messages::w().nothing_here, "");
    }

    /// Where a template of a kind would lie on a surface that was found.
    pub fn placement_on(&self, kind: TemplateKind, found: &Found) -> Placement {
        let normal = facing(found.normal, &self.camera);
        placement_on_surface(kind, found.pos, normal, &self.camera)
    }

    /// Puts a new template of the kind being placed onto a surface.
    pub(super) fn place_on(&mut self, found: Option<Found>) {
        match found {
            Some(found) => self.place_at(found.pos, facing(found.normal, &self.camera)),
            None => self.notify_nothing_here(),
        }
    }

    /// Puts a new template of the kind being placed onto a surface, or in the void where the camera looks.
    pub(super) fn place_on_or_at_target(&mut self, found: Option<Found>) {
        match found {
            Some(found) => self.place_at(found.pos, facing(found.normal, &self.camera)),
            None => self.place_at(self.camera.target, camera::axes(self.camera.rotate)[2]),
        }
    }

    /// Puts a new template of the kind being placed at a point, and selects it. `normal` points out of the object.
    pub(super) fn place_at(&mut self, pos: Vec3, normal: Vec3) {
        let Some(kind) = self.tool.placing() else {
            return;
        };
        if self.is_sweeping() {
            return self.press_sweep(pos, normal);
        }
        self.tool = Tool::Look;
        let index = self.template_count();
        let mut edit = Edit::AddTemplate {
            index,
            kind,
            placement: placement_on_surface(kind, pos, normal, &self.camera),
        };
        if let Some(keep) = self.keep_the_only_tissue(index) {
            edit = Edit::All {
                name: edit.name(self.document()),
                edits: vec![edit, keep],
            };
        }
        if self.apply(&edit, false) {
            self.selection = Selection::Template(index);
            self.side_tab = Tab::Templates;
        }
    }

    /// Whoever made the only tissue of a scan, and then places a first template, means that tissue to stay in place.
    fn keep_the_only_tissue(&self, index: usize) -> Option<Edit> {
        let illustration = self.illustration();
        let [recipe] = &illustration.recipes[..] else {
            return None;
        };
        let mut segments = self
            .view
            .subject
            .iter()
            .flat_map(|facts| facts.segments.values());
        let is_only = segments.all(|name| *name == recipe.name);
        (is_only && index == 0).then(|| Edit::SetAlign {
            template: index,
            align: Align::Segment {
                keep: vec![recipe.name.clone()],
                thickness: Align::DEFAULT_THICKNESS,
            },
        })
    }

    /// Fastens a caption to the tissue that was found, with the name of its segment; the text is to be typed next.
    pub(super) fn caption_on(&mut self, found: Option<Found>) {
        let Some(found) = found else {
            return self.notify_nothing_here();
        };
        if self.tool != Tool::Caption {
            return;
        }
        self.tool = Tool::Look;
        let index = self.illustration().captions.len();
        let facts = self.view.subject.as_ref().zip(found.segment);
        let segment = facts.and_then(|(facts, label)| facts.segments.get(&label));
        let segment = segment.filter(|name| !name.trim().is_empty());
        let caption = Caption {
            at: self.at_start(found.pos_in_rest),
            text: segment.map_or_else(
                || fill(captions::w().caption_n, &[&(index + 1)]),
                |name| capitalized(&kept::segment(name)),
            ),
            enabled: true,
        };
        if self.apply(&Edit::AddCaption(caption), false) {
            self.are_panels_hidden = false;
            self.edit_caption(index);
        }
    }

    /// Where tissue of the untouched subject is in what the document holds: of a clay in its starting shape.
    fn at_start(&self, place: Vec3) -> Vec3 {
        match &self.shown_subject {
            Some(SubjectRef::Clay(clay)) => {
                let way = Way::of(clay, &self.view.grids);
                way.back_of(place.as_dvec3()).as_vec3()
            }
            _ => place,
        }
    }

    /// Opens the field of a caption, in a narrow window the drawer that holds it too.
    pub(super) fn edit_caption(&mut self, index: usize) {
        self.side_tab = Tab::Text;
        self.tab = self.are_drawers.then_some(Tab::Text);
        self.effect(Effect::Focus(Focus::Caption(index)));
    }

    /// Adds the tissue that was found to the seeds of the recipe that is being seeded.
    pub(super) fn seed_on(&mut self, found: Option<Found>) {
        match (self.tool, found) {
            (Tool::Seed(recipe), Some(found)) => {
                self.add_seed(recipe, found.pos_in_rest, found.value);
            }
            (_, Some(_)) => {}
            (_, None) => self.notify_nothing_here(),
        }
    }

    /// Adds a seed to the recipe of this index, if it grows from seeds and there is room for one more. The range of
    /// values widens to hold the value of the seed.
    pub(super) fn add_seed(&mut self, index: usize, pos_in_rest: Vec3, value: f32) {
        let recipes = &self.illustration().recipes;
        let Some(recipe) = recipes.iter().find(|recipe| recipe.index == index) else {
            return;
        };
        let RecipeSource::Grow { seeds, range } = &recipe.from else {
            return;
        };
        if seeds.len() >= MAX_SEEDS || !pos_in_rest.is_finite() {
            return;
        }
        let mut all = seeds.clone();
        all.push(pos_in_rest);
        let mut new = with_seeds(recipe, all);
        if !(range[0]..=range[1]).contains(&value) {
            let range = [range[0].min(value), range[1].max(value)];
            new = with_range(&new, range);
        }
        let edit = Edit::Set {
            pointer: format!("/subject/features/{index}"),
            value: new.to_value(),
            name: format!("Grow {}", recipe.name),
        };
        self.apply(&edit, false);
    }

    /// Takes an end of a distance, subject space.
    pub(super) fn measure(&mut self, pos: Option<Vec3>) {
        let Some(pos) = pos else {
            return self.notify_nothing_here();
        };
        let Tool::Measure(first) = self.tool else {
            return;
        };
        if !pos.is_finite() {
            return;
        }
        self.tool = match first {
            Some(first) => {
                self.view.measures.add([first, pos]);
                Tool::Measure(None)
            }
            None => Tool::Measure(Some(pos)),
        };
    }

    /// Turns the look to a point of the object, from the same side.
    pub(super) fn look_at(&mut self, found: Option<Found>) {
        if let Some(found) = found {
            self.glide_to(Camera {
                target: found.pos,
                ..self.camera
            });
        }
    }
}

/// The normal on the side of the viewer, or the direction to the viewer where the surface has none to speak of.
fn facing(normal: Vec3, camera: &Camera) -> Vec3 {
    let back = camera::axes(camera.rotate)[2];
    let normal = normal.normalize_or(back);
    if normal.dot(back) < -0.2 {
        -normal
    } else {
        normal
    }
}
