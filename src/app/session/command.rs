//! Everything that can be done, as values: buttons, keys and gestures make them, the session runs them.

use glam::Vec3;

use super::camera::StandardView;
use super::clay::ClayCommand;
use super::figure::FigureCommand;
use super::files::RawCommand;
use super::found::Found;
use super::hand::HandCommand;
use super::library::LibraryCommand;
use super::mesh_use::MeshUse;
use super::notices::Gravity;
use super::sought::Sought;
use super::tissues::TissueCommand;
use super::view::See;
use crate::app::words::Lang;
use crate::clay::MeshFormat;
use crate::data::Site;
use crate::describe::Snippet;
use crate::document::{Camera, Edit, Plane, SubjectRef, TemplateKind};

/// One thing to do.
#[derive(Clone, Debug)]
pub enum Command {
    /// Takes the last change of the document back.
    Undo,
    /// Makes the change again that was taken back last.
    Redo,
    /// Changes the document: one step of undo.
    Apply(Edit),
    /// Changes the document as part of a drag: the drag is one step of undo.
    Drag(Edit),
    /// Starts placing a template of a kind: the next click on the object is its place. Choosing the same kind again
    /// cancels.
    StartPlacing(TemplateKind),
    /// Uses the active tool on what the middle of the picture shows.
    PlaceInMiddle,
    /// Makes, selects or moves something of a figure.
    Figure(FigureCommand),
    /// Starts or ends setting a caption.
    ToggleCaptioning,
    /// Uses the active tool at a pixel of the picture.
    UseToolAt([f32; 2]),
    /// Moves the camera's target to the surface at a pixel of the picture.
    LookAtPixel([f32; 2]),
    /// Places the template being placed on the surface that was found.
    PlaceOn(Option<Found>),
    /// Like `PlaceOn`; where nothing was found, the template goes to the camera's target.
    PlaceOnOrAtTarget(Option<Found>),
    /// Places the template being placed at a point of subject space, its z axis along a normal.
    PlaceAt {
        /// The point, subject space.
        pos: Vec3,
        /// Out of the object, any length but zero.
        normal: Vec3,
    },
    /// Does something with the tool in hand: it shapes the clay, or draws a sweep.
    Hand(HandCommand),
    /// Fastens a caption to the tissue that was found.
    CaptionOn(Option<Found>),
    /// Adds a seed to the recipe that is being seeded.
    SeedOn(Option<Found>),
    /// Adds a seed to the recipe that is open: a point of rest space and the subject's value there.
    AddSeed(Vec3, f32),
    /// Measures from or to a point of subject space.
    Measure(Option<Vec3>),
    /// Turns the look to the surface that was found.
    LookAt(Option<Found>),
    /// Lays the template of this index on the surface that was found along its axis.
    LayOn(usize, Option<Found>),
    /// Takes one of the places of the surface along the template that is to follow it.
    Trace(usize, Option<Found>),
    /// Closes or ends the topmost of these: a sheet, the tool, a search, the selection.
    Escape,
    /// Selects a template by its index in the document.
    Select(Option<usize>),
    /// Selects an object of the scene by its index in the document.
    SelectObject(Option<usize>),
    /// Selects the object that is seen at a pixel of the picture, if one is.
    SelectAt([f32; 2]),
    /// Selects the object that was found, if one was. The number is of no use.
    SelectSeen(usize, Option<Found>),
    /// Puts a tool of this name into the scene, at what the middle of the picture shows.
    AddTool(&'static str),
    /// Puts the tool of this index among those of the program to the surface that was found, else to where the camera
    /// looks.
    PlaceTool(usize, Option<Found>),
    /// Puts a scalpel into the surface that was found, else where the camera looks, and a template that carves by it.
    /// The number is of no use.
    PlaceCarving(usize, Option<Found>),
    /// Selects the next one in the list of templates, then in that of objects, or with `false` the one before.
    SelectNext(bool),
    /// Removes the selected template or object.
    DeleteSelected,
    /// Makes a copy of the selected template or object behind it.
    DuplicateSelected,
    /// Puts the selected template, with its group, on the clipboard.
    Copy,
    /// Puts the selected template, with its group, on the clipboard and takes it out of the document.
    Cut,
    /// Takes the content of the clipboard: templates, a link or a document.
    Paste,
    /// Mirrors the selected template, with its group, across a middle plane of the subject: as a copy, or where it is.
    Mirror(Plane, bool),
    /// Turns and moves the selected template so that it lies on the surface under it.
    LayOnSurface,
    /// Bends the selected template along the surface under it.
    FollowSurface,
    /// Puts the selected template into the group of the one before it.
    GroupWithPrevious,
    /// Takes the selected template out of its group.
    LeaveGroup,
    /// Handles go in steps, or not.
    ToggleSnap,
    /// Searches the catalogue for a text.
    Search(String),
    /// Puts the keyboard into the search over the catalogue.
    StartSearch,
    /// Puts the keyboard into the search over tissues and captions.
    StartSeeking,
    /// Turns the view to what is sought, and shows a tissue for a moment.
    Seek(Sought),
    /// Turns the view to the first that the search over tissues and captions finds.
    SeekFirst,
    /// Turns the view to where that lies; there is none of it where no place is known.
    TurnTo(Sought, Option<Site>),
    /// Shows or hides the selected template or object.
    ToggleSelected,
    /// Makes the selected template act earlier (`-1`) or later (`1`); moves the selected object or stroke
    /// up or down in its list.
    ShiftSelected(i8),
    /// Adds to the main parameter of the selected template, in hundredths of its range. Pushes the selected object
    /// towards its working end, in hundredths of its size.
    NudgeMain(f32),
    /// What the handles in the picture do.
    SetGizmo(GizmoMode),
    /// Looks from a side.
    View(StandardView),
    /// Back to the camera that the document came with.
    ResetView,
    /// Takes another camera, as a hand moved it.
    MoveCamera(Camera),
    /// Turns the camera, radians to the right and down.
    Orbit(f32, f32),
    /// Comes closer by a factor.
    Zoom(f32),
    /// Takes a subject in place of the present one: a new document begins, unless it is another volume of the same
    /// file.
    SetSubject(SubjectRef),
    /// Brings the templates of the document that was left for a new one into that.
    KeepTemplates,
    /// Opens a scan or a document.
    Open,
    /// Starts from an empty document; undo brings the present one back.
    New,
    /// Shows a step of the document; 0 is the document as it stands.
    GoToStep(usize),
    /// Shows the next step, or with `false` the one before.
    WalkStep(bool),
    /// Records and plays the steps of the document.
    Step(StepCommand),
    /// Puts the link on the clipboard.
    CopyLink,
    /// Saves the document as a file.
    SaveDocument,
    /// Saves the clay that is shown as a mesh file.
    SaveMesh(MeshFormat),
    /// Saved pictures get so many pixels along their longer side from now on; `None`: as many as suit the window.
    SetPictureSize(Option<u32>),
    /// Saved pictures say from now on that they are printed with so many dots per inch.
    SetPictureDpi(u32),
    /// Saved pictures stand on this paper from now on.
    SetPicturePaper(PicturePaper),
    /// Saves the picture as a PNG.
    SavePicture,
    /// Stops making the picture for a file.
    StopSaving,
    /// Stops the load under way; what was shown before stays.
    CancelLoad,
    /// Fetches from the host that was asked about.
    AllowHost,
    /// Fetches displacement fields from this host; answers the message of this number.
    AllowFields(u64, String),
    /// Answers the question what a mesh file is to be.
    UseMesh(MeshUse),
    /// Answers the question how the voxels of a bare file lie.
    Raw(RawCommand),
    /// Shows or hides the sheet of keys.
    ToggleKeys,
    /// Opens or closes the dialog that shares the illustration.
    ToggleShare,
    /// Put HTML for a page on the clipboard.
    CopySnippet(Snippet),
    /// Shows or hides every message so far.
    ToggleMessages,
    /// Shows a message: how grave, one line, details.
    Notify(Gravity, String, String),
    /// Puts the message of this number away.
    Dismiss(u64),
    /// Unfolds the details of the message of this number, or folds them.
    Unfold(u64),
    /// Opens the field of the caption of this index.
    EditCaption(usize),
    /// Shows or hides the choice among the volumes of the subject's file.
    ToggleFrames,
    /// Turns from the light theme to the dark one, or back.
    ToggleTheme,
    /// Turns to the next panel and gives it the keyboard, or with `false` to the one before.
    NextPanel(bool),
    /// High contrast or the usual one.
    ToggleContrast,
    /// Title and credit are written into saved pictures, or not.
    ToggleLettering,
    /// The title stands over the picture, or not.
    ToggleTitle,
    /// The first hint does not come again.
    PutHintAway,
    /// The interface speaks another language.
    Speak(Lang),
    /// Everything larger or smaller, for a projector.
    Scale(f32),
    /// Panels away, the picture alone.
    TogglePanels,
    /// Changes how one looks: slices, ghost, distances.
    See(See),
    /// Shows examples and recent documents, or opens one.
    Library(LibraryCommand),
    /// Edits or shows tissues.
    Tissue(TissueCommand),
    /// Shapes the clay.
    Clay(ClayCommand),
}

/// One thing to do with the steps of the document. Steps are counted as they are shown, 0 is the start.
#[derive(Clone, Debug, PartialEq)]
pub enum StepCommand {
    /// Adds a step after the one that is shown, which shows the same as is seen now, and goes there.
    Add,
    /// Makes a copy of a step behind it, and goes there.
    Duplicate(usize),
    /// Removes a step above 0.
    Delete(usize),
    /// Makes a step above 0 come earlier or later, and goes there.
    Move {
        /// Number of the step.
        from: usize,
        /// Number of the step afterwards.
        to: usize,
    },
    /// Takes the present view into the step that is shown.
    Update,
    /// Starts to play the lesson at what is shown now, or stops it there.
    TogglePlay,
    /// Stands still at a place of the lesson: 1.5 is the middle of the passage from step 1 to step 2.
    Scrub(f32),
}

/// What saved pictures stand on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PicturePaper {
    /// The background of the document.
    #[default]
    Background,
    /// Nothing: the picture is transparent beside the object.
    Clear,
    /// The background of the document, with the object's soft shadow.
    Shadow,
    /// The object's soft shadow alone: it takes the colour of the page that it is printed on.
    ClearShadow,
}

/// What the handles in the picture do.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum GizmoMode {
    /// Along the axes, in the planes between them, freely.
    #[default]
    Move,
    /// Turns about the axes of the template.
    Turn,
    /// The faces of the box.
    Size,
}

impl GizmoMode {
    /// All modes, in the order of the buttons.
    pub const ALL: [Self; 3] = [Self::Move, Self::Turn, Self::Size];
}
