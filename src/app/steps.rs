//! Walking the steps of a document: which one is shown, the passage to the next, and the bar in the picture.

use egui::{FontId, Rect, Role, Ui, UiBuilder, WidgetInfo, vec2};

use super::camera;
use super::command::Command;
use super::control;
use super::floating;
use super::icon::Icon;
use super::state::State;
use super::theme::{self, Palette};
use super::view_bar;
use super::words::keys::w;
use crate::document::{Camera, Document, Illustration};

/// Points that the ball of axes and the way home take at the left, and at the foot of the picture.
const BESIDE_THE_BALL: f32 = 148.0;
const ABOVE_THE_BALL: f32 = 112.0;

/// Where one stands in the steps of the document. Step 0 is the document as it stands.
#[derive(Debug, Default)]
pub(crate) struct Walk {
    step: usize,
    /// What is shown at a step above 0, or in the middle of a passage.
    shown: Option<Illustration>,
    passage: Option<Passage>,
}

/// On the way from one step to its neighbour.
#[derive(Debug)]
struct Passage {
    /// The later of the two: its entry says how long it takes.
    later: usize,
    is_backwards: bool,
    /// Clock of the interface at the start.
    since: f64,
    seconds: f64,
    /// From where and to where one looks, if the step turns the camera at all.
    cameras: Option<(Camera, Camera)>,
}

impl Walk {
    /// Opened at a step: no passage, the step's own camera.
    pub(crate) fn at(document: &Document, step: usize) -> Self {
        let step = step.min(document.step_count());
        Self {
            step,
            shown: shown_at(document, step),
            passage: None,
        }
    }

    /// The step that is shown or under way to.
    pub(crate) fn step(&self) -> usize {
        self.step
    }

    /// What is shown in place of the document as it stands.
    pub(crate) fn shown(&self) -> Option<&Illustration> {
        self.shown.as_ref()
    }

    /// A passage goes on.
    pub(crate) fn is_moving(&self) -> bool {
        self.passage.is_some()
    }

    /// Goes to a step: to a neighbour by the passage between them, further at once. Returns the camera that is taken at
    /// once.
    pub(crate) fn go(
        &mut self,
        document: &Document,
        step: usize,
        now: f64,
        from: Camera,
    ) -> Option<Camera> {
        let step = step.min(document.step_count());
        if step == self.step {
            return None;
        }
        let before = std::mem::replace(&mut self.step, step);
        let camera_at = |n| {
            shown_at(document, n)
                .unwrap_or(document.illustration().clone())
                .camera
        };
        let (start, end) = (camera_at(before), camera_at(step));
        // A step that does not turn the camera leaves it where the student has turned it.
        let cameras = (start != end).then_some((from, end));
        if step.abs_diff(before) > 1 {
            self.passage = None;
            self.shown = shown_at(document, step);
            return cameras.map(|(_, end)| end);
        }
        let later = step.max(before);
        let steps = &document.illustration().steps;
        let seconds = steps
            .get(later - 1)
            .map_or(0.0, |step| f64::from(step.seconds));
        self.passage = Some(Passage {
            later,
            is_backwards: step < before,
            since: now,
            seconds,
            cameras,
        });
        None
    }

    /// Goes with the clock; returns the camera of the passage, if it has one.
    pub(crate) fn advance(&mut self, document: &Document, now: f64) -> Option<Camera> {
        let passage = self.passage.as_ref()?;
        let past = (now - passage.since).max(0.0);
        if past >= passage.seconds {
            let end = passage.cameras.map(|(_, end)| end);
            self.passage = None;
            self.shown = shown_at(document, self.step);
            return end;
        }
        let at = if passage.is_backwards {
            passage.seconds - past
        } else {
            past
        };
        if let Ok(shown) = document.at_time(passage.later, at as f32) {
            self.shown = Some(shown);
        }
        let part = (past / passage.seconds) as f32;
        passage
            .cameras
            .map(|(from, end)| camera::between(&from, &end, part))
    }
}

/// The document at a step; nothing where that is the document itself.
fn shown_at(document: &Document, step: usize) -> Option<Illustration> {
    if step == 0 {
        return None;
    }
    let at_step = document.at_step(step).ok()?;
    Some(at_step.illustration().clone())
}

/// Title and caption of the step that is shown.
fn texts(state: &State) -> (&str, &str) {
    let illustration = state.document().illustration();
    let step = state.walk.step().checked_sub(1);
    match step.and_then(|index| illustration.steps.get(index)) {
        Some(step) => (&step.title, &step.caption),
        None => (&illustration.title, &illustration.caption),
    }
}

fn label(number: usize, count: usize, title: &str) -> String {
    if title.is_empty() {
        format!("{number} / {count}")
    } else {
        format!("{number} / {count}   {title}")
    }
}

/// The step that is shown, for who cannot see it. Nothing without steps.
pub(crate) fn spoken(state: &State) -> Option<String> {
    let count = state.document().step_count();
    let (title, caption) = texts(state);
    (count > 0).then(|| format!("{}. {caption}", label(state.walk.step(), count, title)))
}

/// The bar at the foot of the picture: back, number and title, forth, and the caption. Nothing without steps.
pub(crate) fn ui(ui: &mut Ui, picture: Rect, state: &State, commands: &mut Vec<Command>) {
    let steps = &state.document().illustration().steps;
    if steps.is_empty() || picture.height() < 220.0 {
        return;
    }
    let palette = Palette::get(ui);
    let number = state.walk.step();
    let (title, caption) = texts(state);
    // Beside the ball of axes where there is room for both, else above it.
    let free = if picture.width() > 620.0 {
        picture.with_min_x(picture.left() + BESIDE_THE_BALL)
    } else {
        picture.with_max_y(picture.bottom() - ABOVE_THE_BALL)
    };
    let free = free.with_max_x(free.right() - view_bar::column_width(picture));
    let width = (free.width() - 16.0).min(560.0);
    let text_width = width - 28.0;
    let caption = (!caption.is_empty()).then(|| {
        ui.painter().layout(
            caption.to_owned(),
            FontId::proportional(14.0),
            palette.text,
            text_width,
        )
    });
    let caption_height = caption.as_ref().map_or(0.0, |galley| galley.size().y + 6.0);
    let height = 44.0 + caption_height.min(0.3 * picture.height());
    let bar = Rect::from_min_size(
        free.center_bottom() - vec2(0.5 * width, height + 14.0),
        vec2(width, height),
    );
    floating::float_frame(ui, bar);
    let row = Rect::from_min_size(bar.min, vec2(width, 44.0)).shrink2(vec2(8.0, 6.0));
    let mut inner = ui.new_child(
        UiBuilder::new()
            .id_salt("steps")
            .max_rect(row)
            .layout(control::along()),
    );
    let back = control::icon_button(&mut inner, Icon::Previous, w().step_before, number > 0);
    if back.clicked() {
        commands.push(Command::GoToStep(number.saturating_sub(1)));
    }
    let label = label(number, steps.len(), title);
    inner.allocate_ui(vec2(row.width() - 76.0, row.height()), |ui| {
        ui.centered_and_justified(|ui| {
            let response = ui.add(egui::Label::new(theme::strong(label.clone())).truncate());
            // Read out when the step changes.
            response.widget_info(|| WidgetInfo::labeled(Role::Status, true, &label));
        });
    });
    inner.with_layout(control::against(), |ui| {
        let is_last = number >= steps.len();
        if control::icon_button(ui, Icon::Next, w().next_step, !is_last).clicked() {
            commands.push(Command::GoToStep(number + 1));
        }
    });
    if let Some(galley) = caption {
        let at = bar.left_top() + vec2(14.0, 42.0);
        ui.painter_at(bar).galley(at, galley, palette.text);
    }
}
