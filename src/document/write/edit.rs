//! Edits: what can be done to a document.

use crate::document::model::figure;
use crate::document::model::{
    Align, Background, Camera, Caption, ClayStroke, Constrain, ControlPoints, Curve, FIGURE_FRONT,
    MeshRef, ObjectPlacement, OpacityMode, ParamValue, SubjectBox, SubjectRef, SweepTools,
    TemplateKind, TemplateMode, Transfer, TransferPoint, Window,
};
use crate::math::Placement;
use serde_json::Value;

/// A change of a document. Numbers are rounded to four decimals when they are written, so that links stay short.
///
/// A template, caption or step is named by its index in the document's list
/// ([`crate::document::PlacedTemplate::index`]), which counts unknown kinds too. Pointers in the steps follow entries
/// that move, and go with entries that are removed.
#[derive(Clone, Debug, PartialEq)]
pub enum Edit {
    /// Sets any value by JSON pointer, as it stands (not rounded).
    Set {
        /// JSON pointer to the value.
        pointer: String,
        /// The value that is set; it replaces the one that stands there.
        value: Value,
        /// Name of the edit in the menu, such as “Set key”.
        name: String,
    },
    /// Puts a key back to its default.
    Reset {
        /// JSON pointer to the key.
        pointer: String,
        /// Name of the edit in the menu.
        name: String,
    },
    /// Places a new template before the one of that index (or last).
    AddTemplate {
        /// Index of the new template after the edit; larger than the number of templates means last.
        index: usize,
        /// Kind of the new template, with the defaults of its parameters.
        kind: TemplateKind,
        /// Where its cube lies.
        placement: Placement,
    },
    /// Removes a template. Pointers of steps to later templates follow.
    RemoveTemplate {
        /// Index of the template.
        template: usize,
    },
    /// Places a copy right after a template.
    DuplicateTemplate {
        /// Index of the template that is copied.
        template: usize,
    },
    /// Changes when a template acts.
    MoveTemplate {
        /// Index of the template.
        from: usize,
        /// Index of the template after the edit.
        to: usize,
    },
    /// Sets one parameter of a template.
    SetParam {
        /// Index of the template.
        template: usize,
        /// Name of the parameter.
        param: &'static str,
        /// The new value, of the type that the catalogue gives.
        value: ParamValue,
    },
    /// Sets the control points and the cut of an `rbf`.
    SetControlPoints {
        /// Index of the template.
        template: usize,
        /// Points and cut, template space.
        points: ControlPoints,
    },
    /// Sets the tools of a `sweep`.
    SetTools {
        /// Index of the template.
        template: usize,
        /// Tools and mirrors; tools of an unknown shape stay as they are in the document.
        tools: SweepTools,
    },
    /// Moves, turns or sizes a template.
    SetPlacement {
        /// Index of the template.
        template: usize,
        /// Where its cube lies afterwards.
        placement: Placement,
    },
    /// Lays a template along a curve.
    SetCurve {
        /// Index of the template.
        template: usize,
        /// The curve, template space; `None` makes the template straight.
        curve: Option<Curve>,
    },
    /// Sets how much of a template's deformation is done.
    SetAmount {
        /// Index of the template.
        template: usize,
        /// From 0 (nothing) to 1 (what its parameters say).
        amount: f32,
    },
    /// Switches a template on or off.
    SetEnabled {
        /// Index of the template.
        template: usize,
        /// True to switch it on.
        enabled: bool,
    },
    /// Sets how a template joins the one before it.
    SetMode {
        /// Index of the template.
        template: usize,
        /// Whether the template is composed with the one before or added to it.
        mode: TemplateMode,
    },
    /// Sets the tissue that a template leaves where it is.
    SetAlign {
        /// Index of the template.
        template: usize,
        /// The tissue that the template leaves where it is.
        align: Align,
    },
    /// Sets the tissue towards which a template's displacement fades.
    SetConstrain {
        /// Index of the template.
        template: usize,
        /// The kept tissue; `None` takes the constraint away.
        constrain: Option<Constrain>,
    },
    /// Gives a template a name.
    RenameTemplate {
        /// Index of the template.
        template: usize,
        /// The author's name for it; empty for none.
        name: String,
    },
    /// Puts a template into a group of the list.
    SetGroup {
        /// Index of the template.
        template: usize,
        /// Name of the group; empty for none.
        group: String,
    },
    /// Inserts templates from elsewhere before the one of that index (or last).
    InsertTemplates {
        /// Index of the first afterwards; larger than the number of templates means last.
        index: usize,
        /// Entries of `templates`, as in a document.
        templates: Vec<Value>,
    },
    /// Several edits, one after the other, as one.
    All {
        /// Name of the whole in the menu.
        name: String,
        /// The edits; each sees what the ones before it left.
        edits: Vec<Edit>,
    },
    /// Sets opacity and colour over value. A preset brings its own tint; listed points leave the tint as it is.
    SetTransfer(Transfer),
    /// Lists points in place of a preset, and sets how much the segments' own colours tint them.
    SetPoints {
        /// Points at absolute values, sorted by value.
        points: Vec<TransferPoint>,
        /// 0 to 1; 0 is not written.
        tint: f32,
    },
    /// Sets the value range of a preset.
    SetWindow(Window),
    /// Sets how opacity follows the deformation.
    SetOpacity(OpacityMode),
    /// Draws in the style of a preset as it is, whatever the document changed before; `None` draws without a style.
    SetStyle(Option<&'static str>),
    /// Sets the background behind the object.
    SetBackground(Background),
    /// Sets the view that the document opens with.
    SetCamera(Camera),
    /// Sets the title; empty for none.
    SetTitle(String),
    /// Sets the text under the picture (`caption` in a document).
    SetLegend(String),
    /// Sets the credit line.
    SetCredit(String),
    /// Sets the language of the texts.
    SetLang(String),
    /// Shows another subject, or another revision of the same. Segments of another subject are removed.
    SetSubject(SubjectRef),
    /// Puts a stroke of a clay before the one of that index (or last). Who shows some of the strokes goes on to show
    /// the same.
    AddStroke {
        /// Index of the new stroke after the edit; larger than the number of strokes means last.
        index: usize,
        /// What it does, and which tools it moves.
        stroke: ClayStroke,
    },
    /// Removes a stroke of a clay. Who shows some of the strokes goes on to show the same without it.
    RemoveStroke {
        /// Index of the stroke, those counted that this version does not know.
        stroke: usize,
    },
    /// Adds a mesh of the subject behind those that are there.
    AddMesh {
        /// The mesh; its index does not matter.
        mesh: MeshRef,
        /// The box of a subject of meshes as it is before. It is written where the document has none, so that nothing
        /// moves.
        box_mm: Option<SubjectBox>,
    },
    /// Removes a mesh of the subject.
    RemoveMesh {
        /// Index of the mesh in `subject.meshes`.
        mesh: usize,
    },
    /// Puts an object into the scene before the one of that index (or last).
    AddObject {
        /// Index of the new object after the edit; larger than the number of objects means last.
        index: usize,
        /// An entry of `objects`, as in a document.
        object: Value,
    },
    /// Removes an object. Pointers of steps to later objects follow.
    RemoveObject {
        /// Index of the object.
        object: usize,
    },
    /// Puts a copy right after an object.
    DuplicateObject {
        /// Index of the object that is copied.
        object: usize,
    },
    /// Changes the place of an object in the list.
    MoveObject {
        /// Index of the object.
        from: usize,
        /// Index of the object after the edit.
        to: usize,
    },
    /// Moves, turns or sizes an object.
    PlaceObject {
        /// Index of the object.
        object: usize,
        /// Where it lies afterwards.
        placement: ObjectPlacement,
    },
    /// Adds a caption at the end of `labels`.
    AddCaption(Caption),
    /// Replaces a caption by another one.
    ReplaceCaption {
        /// Index of the caption in `labels`, from 0.
        caption: usize,
        /// The caption that takes its place.
        value: Caption,
    },
    /// Removes a caption. Pointers of steps to later captions follow.
    RemoveCaption {
        /// Index of the caption in `labels`, from 0.
        caption: usize,
    },
    /// Adds an entry to a list of the figure before the one of that index (or last). Pointers of steps follow.
    AddToFigure {
        /// Which of the lists of `figure`.
        list: FigureList,
        /// Index of the new entry after the edit; larger than the number of entries means last.
        index: usize,
        /// The entry, as in a document.
        entry: Value,
    },
    /// Removes an entry of a list of the figure. Pointers of steps to later entries follow.
    RemoveFromFigure {
        /// Which of the lists of `figure`.
        list: FigureList,
        /// Index of the entry.
        index: usize,
    },
    /// Changes the place of an entry in a list of the figure. Pointers of steps follow.
    MoveInFigure {
        /// Which of the lists of `figure`.
        list: FigureList,
        /// Index of the entry.
        from: usize,
        /// Index of the entry after the edit.
        to: usize,
    },
    /// Does an edit while a step is shown. What it changes goes into what the step sets and holds from there on, until
    /// another step sets it. A template, caption or handle that it adds is switched off before the step, one that it
    /// removes is switched off from the step on. Order and names of templates, the regions and contours of a figure,
    /// the texts of the document and its subject are those of all steps.
    AtStep {
        /// The step that is shown; 0 is the document itself.
        step: usize,
        /// What is done.
        edit: Box<Edit>,
    },
    /// Adds a step before the one of that index, counted from 0 for the first after step 0. All others go on to show
    /// what they showed.
    AddStep {
        /// Index of the new step after the edit; larger than the number of steps means last.
        index: usize,
        /// The step as JSON: `title`, `caption`, `set`, `seconds`, `hold`, `notes`.
        step: Value,
    },
    /// Removes a step; later steps come one earlier and go on to show what they showed.
    RemoveStep {
        /// Index of the step, from 0 for the first after step 0.
        step: usize,
    },
    /// Makes a copy of a step right after it, which shows the same.
    DuplicateStep {
        /// Index of the step, from 0 for the first after step 0.
        step: usize,
    },
    /// Changes when a step comes. All steps go on to show what they showed.
    MoveStep {
        /// Index of the step, from 0 for the first after step 0.
        from: usize,
        /// Index of the step after the edit.
        to: usize,
    },
}

/// What `figure` holds several of, in an order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FigureList {
    /// Its parts, from behind to front.
    Regions,
    /// What bends it.
    Handles,
    /// Outlines that take the style of others.
    Contours,
}

impl FigureList {
    /// Where the list stands in a document, without the first stroke of the pointer.
    pub(crate) fn key(self) -> &'static str {
        match self {
            Self::Regions => "figure/regions",
            Self::Handles => "figure/handles",
            Self::Contours => "figure/contours",
        }
    }

    /// Most entries of the list.
    pub fn limit(self) -> usize {
        match self {
            Self::Regions => figure::MAX_REGIONS,
            Self::Handles => figure::MAX_HANDLES,
            Self::Contours => figure::MAX_CONTOURS,
        }
    }

    /// What an entry is called.
    pub fn noun(self) -> &'static str {
        match self {
            Self::Regions => "region",
            Self::Handles => "handle",
            Self::Contours => "contour",
        }
    }
}

impl Edit {
    /// The same with the camera of a figure where it has that of a subject in space.
    pub(crate) fn seen_as_figure(&self) -> Self {
        match self {
            Self::All { name, edits } => Self::All {
                name: name.clone(),
                edits: edits.iter().map(Self::seen_as_figure).collect(),
            },
            Self::AtStep { step, edit } => Self::AtStep {
                step: *step,
                edit: Box::new(edit.seen_as_figure()),
            },
            Self::SetCamera(camera) => Self::SetCamera(Camera {
                rotate: camera.rotate * FIGURE_FRONT,
                ..*camera
            }),
            other => other.clone(),
        }
    }

    /// Sets a value by JSON pointer, or without one puts the key back to its default. `name` is that in the menu.
    pub fn put(pointer: String, value: Option<Value>, name: String) -> Self {
        match value {
            Some(value) => Self::Set {
                pointer,
                value,
                name,
            },
            None => Self::Reset { pointer, name },
        }
    }

    /// Names what the edit changes: successive edits of one target in one drag are one step of the history.
    pub fn target(&self) -> String {
        match self {
            Self::Set { pointer, .. } | Self::Reset { pointer, .. } => pointer.clone(),
            Self::SetParam {
                template, param, ..
            } => format!("/templates/{template}/params/{param}"),
            Self::SetControlPoints { template, .. } => format!("/templates/{template}/points"),
            Self::SetTools { template, .. } => format!("/templates/{template}/tools"),
            Self::SetPlacement { template, .. } => format!("/templates/{template}/placement"),
            Self::SetCurve { template, .. } => format!("/templates/{template}/curve"),
            Self::SetAmount { template, .. } => format!("/templates/{template}/amount"),
            Self::SetEnabled { template, .. } => format!("/templates/{template}/enabled"),
            Self::SetMode { template, .. } => format!("/templates/{template}/mode"),
            Self::SetAlign { template, .. } => format!("/templates/{template}/align"),
            Self::SetConstrain { template, .. } => format!("/templates/{template}/constrain"),
            Self::RenameTemplate { template, .. } => format!("/templates/{template}/name"),
            Self::MoveTemplate { from, to } => format!("/templates/{from}/to/{to}"),
            Self::AddTemplate { index, .. } => format!("/templates/{index}/add"),
            Self::RemoveTemplate { template } => format!("/templates/{template}/remove"),
            Self::DuplicateTemplate { template } => format!("/templates/{template}/duplicate"),
            Self::SetGroup { template, .. } => format!("/templates/{template}/group"),
            Self::InsertTemplates { index, .. } => format!("/templates/{index}/paste"),
            Self::All { name, edits } => {
                // What has to be made before a key can be set is made once, by the first edit of a drag.
                let last = edits.last().map(Self::target).unwrap_or_default();
                format!("{last} {name}")
            }
            Self::SetTransfer(_) | Self::SetPoints { .. } => "/look/transfer".to_owned(),
            Self::SetWindow(_) => "/look/window".to_owned(),
            Self::SetOpacity(_) => "/look/opacity".to_owned(),
            Self::SetStyle(_) => "/look/style".to_owned(),
            Self::SetBackground(_) => "/look/background".to_owned(),
            Self::SetCamera(_) => "/camera".to_owned(),
            Self::SetTitle(_) => "/title".to_owned(),
            Self::SetLegend(_) => "/caption".to_owned(),
            Self::SetCredit(_) => "/credit".to_owned(),
            Self::SetLang(_) => "/lang".to_owned(),
            Self::SetSubject(_) => "/subject".to_owned(),
            Self::AddStroke { index, .. } => format!("/subject/clay/strokes/{index}/add"),
            Self::RemoveStroke { stroke } => format!("/subject/clay/strokes/{stroke}/remove"),
            Self::AddMesh { .. } => "/subject/meshes/-".to_owned(),
            Self::RemoveMesh { mesh } => format!("/subject/meshes/{mesh}/remove"),
            Self::AddObject { index, .. } => format!("/objects/{index}/add"),
            Self::RemoveObject { object } => format!("/objects/{object}/remove"),
            Self::DuplicateObject { object } => format!("/objects/{object}/duplicate"),
            Self::MoveObject { from, to } => format!("/objects/{from}/to/{to}"),
            Self::PlaceObject { object, .. } => format!("/objects/{object}/placement"),
            Self::AddCaption(_) => "/labels/-".to_owned(),
            Self::ReplaceCaption { caption, .. } => format!("/labels/{caption}"),
            Self::RemoveCaption { caption } => format!("/labels/{caption}/remove"),
            Self::AddToFigure { list, index, .. } => format!("/{}/{index}/add", list.key()),
            Self::RemoveFromFigure { list, index } => format!("/{}/{index}/remove", list.key()),
            Self::MoveInFigure { list, from, to } => format!("/{}/{from}/to/{to}", list.key()),
            Self::AtStep { step, edit } => format!("/steps/{step}{}", edit.target()),
            Self::AddStep { index, .. } => format!("/steps/{index}/add"),
            Self::DuplicateStep { step } => format!("/steps/{step}/duplicate"),
            Self::RemoveStep { step } => format!("/steps/{step}/remove"),
            Self::MoveStep { from, to } => format!("/steps/{from}/to/{to}"),
        }
    }
}
