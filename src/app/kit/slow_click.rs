//! Clicks on slow devices: a press and its release may lie a long frame apart, however short the finger or the button
//! was down, and one frame may hold several clicks.

use egui::{Context, Event, PointerButton, Pos2, RawInput, Response, Ui};

/// Longest press that is a click, seconds; a finger that rests longer opens a menu.
const CLICK: f64 = 0.8;
/// A frame that takes longer than this is slow, seconds.
const QUICK: f64 = 0.25;
/// Longest time that is made up for, seconds.
const LONGEST: f64 = 10.0;

/// Lets a release end a click although frames were slow since the press: events do not tell when within a frame they
/// came.
#[derive(Default)]
pub(crate) struct SlowClicks {
    /// What slow frames took beyond quick ones since the press, seconds.
    lost: f64,
}

impl egui::Plugin for SlowClicks {
    fn debug_name(&self) -> &'static str {
        "slow clicks"
    }

    fn input_hook(&mut self, ctx: &Context, input: &mut RawInput) {
        let is_press = |event: &Event| matches!(event, Event::PointerButton { pressed: true, .. });
        let is_release =
            |event: &Event| matches!(event, Event::PointerButton { pressed: false, .. });
        let before = ctx.input(|i| i.time);
        let frame = input.time.map_or(0.0, |now| now - before);
        self.lost = (self.lost + (frame - QUICK).max(0.0)).min(LONGEST);
        let mut longest = CLICK;
        // A finger that rests is waited for as long as ever: it opens a menu.
        let is_finger = ctx.input(|i| i.any_touches())
            || input
                .events
                .iter()
                .any(|event| matches!(event, Event::Touch { .. }));
        if !is_finger || input.events.iter().any(is_release) {
            longest += self.lost;
        }
        if input.events.iter().any(is_press) {
            self.lost = 0.0;
        }
        ctx.options_mut(|options| options.input_options.max_click_duration = longest);
    }
}

/// Where the main button or a finger clicked on a widget in this frame, in order: egui tells the last place only.
pub(crate) fn places(ui: &Ui, response: &Response) -> Vec<Pos2> {
    if !response.clicked() {
        return Vec::new();
    }
    let releases: Vec<Pos2> = ui.input(|i| {
        let released = i.events.iter().filter_map(|event| match event {
            Event::PointerButton {
                pos,
                button: PointerButton::Primary,
                pressed: false,
                ..
            } => Some(*pos),
            _ => None,
        });
        released
            .filter(|pos| response.rect.contains(*pos))
            .collect()
    });
    if releases.len() > 1 {
        return releases;
    }
    response.interact_pointer_pos().into_iter().collect()
}
