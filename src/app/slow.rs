//! Clicks on slow devices: a press and its release may lie a long frame apart, however short the finger or the button was down.

use egui::{Context, Event, RawInput};

/// Longest press that is a click, seconds; a finger that rests longer opens a menu.
const CLICK: f64 = 0.8;
/// Longest frame that is made up for, seconds.
const LONGEST: f64 = 10.0;

/// Lets a release that comes with a frame end a click if it can have been one before that frame began.
pub(crate) struct SlowClicks;

impl egui::Plugin for SlowClicks {
    fn debug_name(&self) -> &'static str {
        "slow clicks"
    }

    fn input_hook(&mut self, ctx: &Context, input: &mut RawInput) {
        let is_release =
            |event: &Event| matches!(event, Event::PointerButton { pressed: false, .. });
        let mut longest = CLICK;
        if input.events.iter().any(is_release) {
            // When within the frame it came is not said.
            let before = ctx.input(|i| i.time);
            let frame = input.time.map_or(0.0, |now| now - before);
            longest += frame.clamp(0.0, LONGEST);
        }
        ctx.options_mut(|options| options.input_options.max_click_duration = longest);
    }
}
