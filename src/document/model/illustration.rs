//! The whole illustration: what a document means once its defaults are filled in.

use super::figure::Figure;
use super::look::{Background, Look, OpacityMode, Transfer, Window};
use super::mesh::MeshRef;
use super::object::{ObjectSource, SceneObject};
use super::recipe::Recipe;
use super::script::needs_shaping;
use super::style::Style;
use super::subject::{SegmentsRef, SubjectRef};
use super::surface::SurfaceLook;
use super::template::PlacedTemplate;
use crate::document::limits::DEFAULT_SUBJECT;
use glam::{Quat, Vec3};

/// What a document means: every default filled in, every value inside its range.
#[derive(Clone, Debug, PartialEq)]
pub struct Illustration {
    /// Title of the illustration; may be empty.
    pub title: String,
    /// The text under the picture (`caption` in a document), or empty.
    pub legend: String,
    /// The author's text in place of the picture, for who cannot see it, or empty.
    pub alt: String,
    /// Credit line, or empty.
    pub credit: String,
    /// BCP 47 language of the texts, or empty.
    pub lang: String,
    /// The subject that is illustrated.
    pub subject: SubjectRef,
    /// Meshes that come with the subject's own file or built-in subject. A subject of meshes alone has its meshes in
    /// [`SubjectRef::Meshes`]; [`Illustration::meshes`] gives either.
    pub meshes_beside: Vec<MeshRef>,
    /// Label volumes beside the subject.
    pub segments: Vec<SegmentsRef>,
    /// Recipes of segments that are made from the subject's values, besides the segments that come with files.
    pub recipes: Vec<Recipe>,
    /// Objects that stand in the scene and are never displaced, switched off ones included. Those that name nothing
    /// that this version knows are left out; a notice names each.
    pub objects: Vec<SceneObject>,
    /// Templates in the order in which they act, switched off ones included. Unknown kinds are left out; a notice names
    /// each.
    pub templates: Vec<PlacedTemplate>,
    /// How a figure is divided and bent; `None` if the document has no such key.
    pub figure: Option<Figure>,
    /// The file of the subject is known to be none of a figure, whatever stands beside it.
    pub is_in_space: bool,
    /// Transfer function, opacity, light and background.
    pub look: Look,
    /// The view that the document opens with.
    pub camera: Camera,
    /// Texts that follow the tissue that they are fastened to (`labels` in a document).
    pub captions: Vec<Caption>,
    /// Values that readers may move.
    pub controls: Vec<Control>,
    /// Steps of the lesson, without step 0.
    pub steps: Vec<Step>,
}

impl Illustration {
    /// The illustration of an empty document: every default.
    pub fn document_default() -> Self {
        Self {
            title: String::new(),
            legend: String::new(),
            alt: String::new(),
            credit: String::new(),
            lang: String::new(),
            subject: SubjectRef::Builtin {
                name: DEFAULT_SUBJECT.to_owned(),
                revision: 1,
            },
            meshes_beside: Vec::new(),
            segments: Vec::new(),
            recipes: Vec::new(),
            objects: Vec::new(),
            templates: Vec::new(),
            figure: None,
            is_in_space: false,
            look: Look {
                transfer: Transfer::Auto,
                window: Window::Auto,
                tint: None,
                opacity: OpacityMode::Constancy,
                gradient: 0.0,
                segments: Vec::new(),
                surface: SurfaceLook::DOCUMENT_DEFAULT,
                style: Style::PLAIN,
                style_preset: None,
                light: None,
                background: Background::Color([255; 3]),
                scale_bar: false,
                sides: false,
                strokes: None,
                has_wires: false,
            },
            camera: Camera::DOCUMENT_DEFAULT,
            captions: Vec::new(),
            controls: Vec::new(),
            steps: Vec::new(),
        }
    }

    /// The entries of `subject.meshes` that name a file: the subject itself, or what lies beside its volume. Where the
    /// subject's own file is a mesh, that comes before these.
    pub fn meshes(&self) -> &[MeshRef] {
        match &self.subject {
            SubjectRef::Meshes { meshes, .. } => meshes,
            _ => &self.meshes_beside,
        }
    }

    /// How many strokes of the clay are shown, those that are off counted; `None` for another subject.
    pub fn strokes_shown(&self) -> Option<u32> {
        let SubjectRef::Clay(clay) = &self.subject else {
            return None;
        };
        let all = u32::try_from(clay.strokes.len()).unwrap_or(u32::MAX);
        Some(self.look.strokes.map_or(all, |strokes| strokes.min(all)))
    }

    /// The subject that is shown: of a clay the recipe up to the strokes that are. It is no subject of the document:
    /// written back, strokes would be lost.
    pub fn subject_shown(&self) -> SubjectRef {
        match (&self.subject, self.look.strokes) {
            (SubjectRef::Clay(clay), Some(strokes)) => SubjectRef::Clay(clay.cut(strokes)),
            (subject, _) => subject.clone(),
        }
    }

    /// True if a subject is a clay as [`Illustration::subject_shown`] gives it. Copies nothing, since this is asked in
    /// every frame.
    pub fn shows(&self, subject: &SubjectRef) -> bool {
        let (SubjectRef::Clay(own), SubjectRef::Clay(shown)) = (&self.subject, subject) else {
            return false;
        };
        let strokes = self.strokes_shown().map_or(0, |strokes| strokes as usize);
        own.is_like(shown) && own.strokes[..strokes] == shown.strokes
    }

    /// JSON pointers to what the document has, but what is not drawn of this subject: templates and the look of volumes
    /// beside a figure, `figure` beside any other subject. The document itself names them in its notices where it
    /// tells which it is ([`SubjectRef::is_figure`]); of a file, the program knows when it has its bytes.
    pub fn left_beside(&self, is_figure: bool) -> Vec<&'static str> {
        let look = &self.look;
        let beside_figure = [
            ("/templates", !self.templates.is_empty()),
            ("/look/transfer", look.transfer != Transfer::Auto),
            ("/look/window", look.window != Window::Auto),
            ("/look/opacity", look.opacity != OpacityMode::Constancy),
            ("/look/segments", !look.segments.is_empty()),
        ];
        let beside_others = [("/figure", self.figure.is_some())];
        let beside: &[(&str, bool)] = match is_figure {
            true => &beside_figure,
            false => &beside_others,
        };
        let given = beside.iter().filter(|(_, is_given)| *is_given);
        given.map(|(pointer, _)| *pointer).collect()
    }

    /// True if a template that is switched on carves by an object with these triangles.
    pub fn carves_by(&self, source: &ObjectSource) -> bool {
        let is_it = |template: &PlacedTemplate| {
            template.enabled
                && template
                    .carves_by()
                    .is_some_and(|found| found.source == *source)
        };
        self.templates.iter().any(is_it)
    }

    /// The turn of a camera as the document has it.
    pub fn written_rotation(&self, rotate: Quat) -> Quat {
        match self.is_of_figure() {
            true => rotate * FIGURE_FRONT.inverse(),
            false => rotate,
        }
    }

    /// True if the document tells that its subject is a figure: by a built-in figure, or by a `figure` beside a file.
    pub fn is_of_figure(&self) -> bool {
        let is_figure = self.subject.is_figure();
        is_figure.unwrap_or(self.figure.is_some() && !self.is_in_space)
    }

    /// The file of a subject is known to be none of a figure. If it is this one's, a `figure` beside it does not turn
    /// the camera.
    pub(crate) fn learn_space(&mut self, subject: Option<&SubjectRef>) {
        let is_it = subject.is_some_and(|subject| subject.is_same_data(&self.subject));
        if is_it && self.subject.is_figure().is_none() {
            self.camera.rotate = self.written_rotation(self.camera.rotate);
            self.is_in_space = true;
        }
    }

    /// This illustration once it is known that its subject is a figure: seen from the front of its plane. One whose
    /// document tells that is as it is.
    pub fn of_figure(self) -> Self {
        if self.is_of_figure() {
            return self;
        }
        let camera = Camera {
            rotate: self.camera.rotate * FIGURE_FRONT,
            ..self.camera
        };
        Self {
            figure: Some(Figure::default()),
            camera,
            ..self
        }
    }

    /// This illustration once it is known that its subject lies in space: without a figure, and with the camera of a
    /// document that has none.
    pub fn of_space(self) -> Self {
        let camera = Camera {
            rotate: self.written_rotation(self.camera.rotate),
            ..self.camera
        };
        Self {
            figure: None,
            camera,
            ..self
        }
    }

    /// The illustration of a figure: without what only subjects in space are drawn with.
    pub fn flat(&self) -> Self {
        let default = Self::document_default().look;
        Self {
            objects: Vec::new(),
            templates: Vec::new(),
            recipes: Vec::new(),
            look: Look {
                background: self.look.background,
                scale_bar: self.look.scale_bar,
                sides: self.look.sides,
                ..default
            },
            ..self.clone()
        }
    }

    /// The object of a name: the first, if there are several.
    pub fn object(&self, name: &str) -> Option<&SceneObject> {
        self.objects.iter().find(|object| object.name == name)
    }
}

impl Illustration {
    /// Captions that are switched on and whose letters only a browser sets rightly: their places in `labels`, and
    /// texts.
    pub fn unshaped_captions(&self) -> impl Iterator<Item = (usize, &str)> {
        let captions = self.captions.iter().enumerate();
        captions
            .filter(|(_, caption)| caption.enabled && needs_shaping(&caption.text))
            .map(|(index, caption)| (index, caption.text.trim()))
    }
}

/// Turns the camera of a subject in space that is not turned to that of a figure that is not turned: it looks from +z
/// towards -z, +y is up, and +x to the right. Half a turn about the axis between y and z.
pub const FIGURE_FRONT: Quat = Quat::from_xyzw(
    0.0,
    std::f32::consts::FRAC_1_SQRT_2,
    std::f32::consts::FRAC_1_SQRT_2,
    0.0,
);

/// A perspective camera that looks at a target.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// The point in the middle of the picture, subject space.
    pub target: Vec3,
    /// Turns the camera about the target; the identity looks from +y towards -y with +z up.
    pub rotate: Quat,
    /// Distance from the target, subject units.
    pub distance: f32,
    /// Field of view across the shorter side of the picture, degrees.
    pub fov_deg: f32,
}

impl Camera {
    /// The camera of a document that gives none (contract, "Defaults").
    pub const DOCUMENT_DEFAULT: Self = Self {
        target: Vec3::ZERO,
        rotate: Quat::IDENTITY,
        distance: 2.5,
        fov_deg: 30.0,
    };
}

/// A text that follows the tissue that it is fastened to (an entry of `labels` in a document).
#[derive(Clone, Debug, PartialEq)]
pub struct Caption {
    /// The point of tissue, rest space.
    pub at: Vec3,
    /// The text beside the point; any script, one line.
    pub text: String,
    /// False: it is not drawn.
    pub enabled: bool,
}

impl Caption {
    /// True if there is something to draw: switched on, and more than spaces.
    pub fn is_drawn(&self) -> bool {
        self.enabled && !self.text.trim().is_empty()
    }
}

/// A value that readers of a lesson may move (an entry of `controls` in a document).
#[derive(Clone, Debug, PartialEq)]
pub struct Control {
    /// JSON pointer to the value.
    pub pointer: String,
    /// What the reader reads beside it.
    pub name: String,
    /// What it can be set to.
    pub range: ControlRange,
}

/// What a reader can set a value to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ControlRange {
    /// True or false; the value of a document that does not give it.
    Flag(bool),
    /// A number in a closed range, for a slider.
    Number {
        /// The value of a document that does not give it.
        default: f64,
        /// Lowest value.
        min: f64,
        /// Highest value; above `min`.
        max: f64,
        /// Only whole numbers.
        is_whole: bool,
    },
}

/// One step of a lesson.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// Title of the step; may be empty.
    pub title: String,
    /// The text under the picture (`caption` in a document), or empty.
    pub legend: String,
    /// The author's text in place of the picture at this step, or empty.
    pub alt: String,
    /// Length of the passage to this step, seconds.
    pub seconds: f32,
    /// How long a lesson that plays by itself stays at this step, seconds.
    pub hold_seconds: f32,
    /// Text for the teacher; may be empty. It is not drawn.
    pub notes: String,
}

impl Step {
    /// How long a lesson that plays by itself stays at a step that does not say, seconds.
    pub const DEFAULT_HOLD: f32 = 4.0;
}
