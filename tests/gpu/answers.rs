//! What somebody does is answered first: the interface is drawn before the picture where the device is slow, and the
//! picture gets no finer meanwhile.

use crate::gpu::{builtin, open_software};
use crate::long::long_or;
use crate::scatter::Random;
use fabrica::data::Subject;
use fabrica::document::{Document, Illustration};
use fabrica::render::{Clock, DrawState, Image, Renderer};
use serde_json::json;
use std::sync::atomic::{AtomicU64, Ordering};

/// Milliseconds of the test's own clocks: each test has one.
static HELD: AtomicU64 = AtomicU64::new(0);
static FIRST: AtomicU64 = AtomicU64::new(0);
static WILD: AtomicU64 = AtomicU64::new(0);

fn held() -> f64 {
    HELD.load(Ordering::Relaxed) as f64 * 1e-3
}

fn first() -> f64 {
    FIRST.load(Ordering::Relaxed) as f64 * 1e-3
}

fn wild() -> f64 {
    WILD.load(Ordering::Relaxed) as f64 * 1e-3
}

const SIZE: [u32; 2] = [256, 192];
const SMALL: [u32; 2] = [96, 72];

fn cube(distance: f32) -> Illustration {
    let json = r#"{ "fabrica": 1, "subject": { "builtin": "cube" } }"#;
    let document = Document::from_json(json).expect("a document");
    let mut illustration = document.illustration().clone();
    illustration.camera.distance = distance;
    illustration
}

fn renderer(clock: Clock) -> Renderer {
    let mut renderer = Renderer::new(open_software(), clock);
    let subject = Subject::from(builtin("cube", 32));
    renderer.set_subject(subject).expect("it fits");
    renderer.set_illustration(&cube(2.5));
    renderer
}

/// Draws, so many milliseconds a frame, until something is so.
fn until(
    renderer: &mut Renderer,
    size_px: [u32; 2],
    (clock, step): (&AtomicU64, u64),
    is_so: impl Fn(&DrawState) -> bool,
) -> DrawState {
    for _ in 0..20_000 {
        let state = renderer.draw(size_px, 1e-3, false).expect("it is drawn");
        if is_so(&state) {
            return state;
        }
        clock.fetch_add(step, Ordering::Relaxed);
        std::thread::sleep(std::time::Duration::from_millis(1));
    }
    panic!("it never comes to that");
}

#[test]
fn the_picture_gets_no_finer_while_somebody_does_something() {
    let mut renderer = renderer(held);
    let frames = (&HELD, 20);
    until(&mut renderer, SIZE, frames, |state| {
        state.has_picture && state.progress > 0.0 && !state.is_done
    });
    // Work under way ends.
    let mut state = None;
    for _ in 0..2_000 {
        renderer.hold();
        let now = renderer.draw(SIZE, 1e-3, true).expect("it is drawn");
        if now.is_held {
            state = Some(now);
            break;
        }
        std::thread::sleep(std::time::Duration::from_millis(1));
    }
    let before = state.expect("it is held").progress;
    for _ in 0..20 {
        renderer.hold();
        HELD.fetch_add(50, Ordering::Relaxed);
        let now = renderer.draw(SIZE, 1e-3, true).expect("it is drawn");
        assert!(now.is_held && now.progress == before, "{now:?}");
    }
    let after = until(&mut renderer, SIZE, frames, |state| state.progress > before);
    assert!(!after.is_held, "nobody does anything any more: {after:?}");
}

/// However `progress` is dragged about, the device holds no more for it, and at last the picture is of the last value.
#[test]
fn progress_that_is_dragged_wildly_takes_no_memory() {
    let swept = |progress: f32| {
        let sweep = json!({ "kind": "sweep", "size": [1, 1, 1], "params": { "progress": progress,
            "tools": [{ "radius": 0.1, "path": [[0.2, 0.2, 0.9], [0.7, 0.7, 0.6], [0.8, 0.3, 0.4]] }] } });
        let value = json!({ "fabrica": 1, "subject": { "builtin": "cube" }, "templates": [sweep] });
        let document = Document::from_value(value).expect("a document");
        document.illustration().clone()
    };
    let mut random = Random(0xd7a6);
    let mut renderer = renderer(wild);
    let held = |renderer: &Renderer| {
        let device = &renderer.gpu().device;
        device
            .poll(wgpu::PollType::wait_indefinitely())
            .expect("it is there");
        let report = device.generate_allocator_report().expect("lavapipe tells");
        report.total_allocated_bytes
    };
    let mut drag = |renderer: &mut Renderer, times: usize| {
        for _ in 0..times {
            renderer.set_illustration(&swept(random.unit()));
            for _ in 0..1 + random.index(3) {
                WILD.fetch_add(10, Ordering::Relaxed);
                renderer.draw(SMALL, 1e-3, true).expect("it is drawn");
            }
        }
    };
    // Each takes a skip grid of its own.
    drag(&mut renderer, 8);
    let before = held(&renderer);
    drag(&mut renderer, long_or(200, 12));
    let after = held(&renderer);
    assert!(
        after <= before + before / 10,
        "{before} and then {after} bytes"
    );
    let last = |renderer: &mut Renderer| {
        renderer.set_illustration(&swept(0.7));
        until(renderer, SMALL, (&WILD, 0), |state| state.is_done);
        pollster::block_on(renderer.read_output()).expect("a picture")
    };
    let dragged = last(&mut renderer);
    assert!(
        dragged == last(&mut self::renderer(wild)),
        "the same as at once"
    );
}

#[test]
fn a_slow_device_draws_the_interface_before_the_picture() {
    let picture = |renderer: &Renderer| -> Image {
        pollster::block_on(renderer.read_output()).expect("a picture")
    };
    for (step, is_slow) in [(0, false), (60, true)] {
        let mut renderer = renderer(first);
        let frames = (&FIRST, step);
        until(&mut renderer, SIZE, frames, |state| state.is_done);
        let before = picture(&renderer);
        FIRST.fetch_add(1_000, Ordering::Relaxed);
        renderer.set_illustration(&cube(3.0));
        let state = renderer.draw(SIZE, 1e-3, true).expect("it is drawn");
        assert!(!state.is_done, "there is more to come");
        assert_eq!(
            picture(&renderer) == before,
            is_slow,
            "frames of {step} ms: the first frame after a rest"
        );
        renderer.draw(SIZE, 1e-3, true).expect("it is drawn");
        assert!(picture(&renderer) != before, "the next frame");
        // What goes on moving is drawn in every frame.
        let before = picture(&renderer);
        FIRST.fetch_add(60, Ordering::Relaxed);
        renderer.set_illustration(&cube(3.5));
        for _ in 0..200 {
            renderer.draw(SIZE, 1e-3, true).expect("it is drawn");
            if picture(&renderer) != before {
                break;
            }
        }
        assert!(picture(&renderer) != before, "and those after it");
    }
}
