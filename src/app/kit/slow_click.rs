//! Clicks on slow devices: a press and its release may lie a long frame apart, however short the finger or the button
//! was down, and one frame may hold several clicks.

use egui::{Context, Event, PointerButton, Pos2, RawInput, Response, Ui};
use std::time::Duration;

/// Longest press that is a click, seconds; a finger that rests longer opens a menu.
const CLICK: f64 = 0.8;
/// A frame that takes longer than this is slow, seconds.
const QUICK: f64 = 0.25;
/// Longest time that is made up for, seconds.
const LONGEST: f64 = 10.0;
/// Between two frames while a finger is down: so that the wait for the menu of a finger that rests is not taken for a
/// slow frame.
const WATCH: Duration = Duration::from_millis(100);

/// Lets a release end a click, and a move begin a drag, although frames were slow since the press: events do not tell
/// when within a frame they came. A slow frame counts as the longest quick one, so that a finger that rests opens its
/// menu some frames later, and a tap or a swipe opens none.
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
        let before = ctx.input(|i| i.time);
        let frame = input.time.map_or(0.0, |now| now - before);
        self.lost = (self.lost + (frame - QUICK).max(0.0)).min(LONGEST);
        let longest = CLICK + self.lost;
        if input.events.iter().any(is_press) {
            self.lost = 0.0;
        }
        ctx.options_mut(|options| options.input_options.max_click_duration = longest);
    }

    fn on_end_pass(&mut self, ui: &mut Ui) {
        if ui.input(|i| i.any_touches()) {
            ui.ctx().request_repaint_after(WATCH);
        }
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

#[cfg(test)]
mod tests {
    use super::*;
    use egui::{Modifiers, Rect, Sense, TouchDeviceId, TouchId, TouchPhase, vec2};

    /// A widget that fills the window, as seen by one who runs frame after frame.
    struct Hand {
        ctx: Context,
        now: f64,
    }

    /// What the widget met in a frame.
    #[derive(Debug)]
    struct Met {
        click: bool,
        drag: bool,
        menu: bool,
    }

    impl Hand {
        fn new() -> Self {
            let ctx = Context::default();
            ctx.add_plugin(SlowClicks::default());
            let mut hand = Self { ctx, now: 0.0 };
            hand.frame(0.02, &[]);
            hand.frame(0.02, &[]);
            hand
        }

        /// A frame so many seconds after the last one.
        fn frame(&mut self, after: f64, events: &[Event]) -> Met {
            self.now += after;
            let input = RawInput {
                time: Some(self.now),
                screen_rect: Some(Rect::from_min_size(Pos2::ZERO, vec2(300.0, 300.0))),
                events: events.to_vec(),
                ..RawInput::default()
            };
            let mut met = None;
            let mut output = self.ctx.run_ui(input, |ui| {
                let response = ui.allocate_response(vec2(290.0, 290.0), Sense::click_and_drag());
                met = Some(Met {
                    click: response.clicked(),
                    drag: response.dragged(),
                    menu: response.secondary_clicked() || response.long_touched(),
                });
            });
            output.textures_delta.clear();
            met.expect("a frame")
        }
    }

    /// What a browser's finger sends.
    fn finger(phase: TouchPhase, x: f32) -> Vec<Event> {
        let pos = Pos2::new(x, 100.0);
        let touch = Event::Touch {
            device_id: TouchDeviceId(0),
            id: TouchId(0),
            phase,
            pos,
            force: None,
        };
        let button = |pressed| Event::PointerButton {
            pos,
            button: PointerButton::Primary,
            pressed,
            modifiers: Modifiers::default(),
        };
        match phase {
            TouchPhase::Start => vec![button(true), touch],
            TouchPhase::Move => vec![Event::PointerMoved(pos), touch],
            _ => vec![button(false), Event::PointerGone, touch],
        }
    }

    #[test]
    fn a_finger_on_a_slow_page_taps_and_swipes() {
        let mut hand = Hand::new();
        hand.frame(1.5, &finger(TouchPhase::Start, 100.0));
        // The finger has long been lifted, and the next frame does not know yet.
        let met = hand.frame(1.5, &[]);
        assert!(!met.menu && !met.click, "{met:?}");
        let met = hand.frame(1.5, &finger(TouchPhase::End, 100.0));
        assert!(met.click && !met.menu, "{met:?}");

        hand.frame(1.0, &finger(TouchPhase::Start, 100.0));
        let met = hand.frame(1.0, &[]);
        assert!(!met.menu, "{met:?}");
        let met = hand.frame(1.0, &finger(TouchPhase::Move, 160.0));
        assert!(met.drag && !met.menu, "{met:?}");
    }

    #[test]
    fn a_finger_that_rests_opens_a_menu() {
        for (frame, soonest, latest) in [(0.02, 0.8, 0.85), (0.1, 0.8, 0.95), (1.0, 3.0, 5.0)] {
            let mut hand = Hand::new();
            hand.frame(frame, &finger(TouchPhase::Start, 100.0));
            let pressed = hand.now;
            while !hand.frame(frame, &[]).menu {
                assert!(hand.now - pressed < 20.0, "no menu comes");
            }
            let waited = hand.now - pressed;
            assert!(
                (soonest..=latest).contains(&waited),
                "{waited} s at {frame} s a frame"
            );
        }
    }
}
