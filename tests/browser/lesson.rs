//! A lesson of six steps in the reader: wherever one comes from it rests at the pictures of the native program, and an
//! interrupted passage changes from frame to frame no more than an undisturbed one.

use super::embed::{open_half, picture_of, ready, rests_quietly};
use super::harness::Tab;
use super::*;
use fabrica::clay::Way;
use fabrica::data::{Grids, VolumeBuilder};
use fabrica::document::SubjectRef;
use fabrica::render::View;
use fabrica::shell::clays::{ClayDesk, surface_of_clay};
use fabrica::subjects::FINE_RESOLUTION;
use glam::{DVec3, Vec2};

/// As clicks in the editor record it (see tests/app/steps.rs): a template and a label are added at step 3.
const RECORDED: &str = r##"{"fabrica":1,"subject":{"builtin":"cube"},"templates":[{"kind":"peel","at":[0,0.3902,0],"rotate":[0,-0.7071,-0.7071,0],"size":[0.3349,0.2679,0.201]},{"kind":"hole","at":[-0.385,-0.0808,0.0748],"rotate":[0.5001,-0.5001,-0.4999,0.4999],"size":[0.3349,0.3349,0.2679],"amount":0,"enabled":false}],"labels":[{"at":[-0.4803,0.0808,0.1959],"enabled":false,"text":"Middle"}],"steps":[{"set":{"/look/background":"#f6f1e7"}},{"set":{"/camera/rotate":[0,0,0.7071,0.7071]}},{"set":{"/labels/0/enabled":true,"/templates/1/amount":1,"/templates/1/enabled":true}},{"set":{"/look/background":"#262b30"}},{"set":{"/templates/1/enabled":false}},{"set":{"/camera/rotate":[0,0,0,1]}}]}"##;

const STEPS: usize = 6;

/// Mean difference of a picture at rest from that of the native program, 255ths, at most.
const NEAR: f64 = 0.5;

/// Frames of two passages do not fall on the same moments: the one may show the fastest moment, the other what is
/// beside it.
const SLACK: f32 = 1.1;

/// Colours are whole 255ths, which tells where a background goes over slowly.
const ROUNDED: f32 = 0.5;

/// Gives the lesson a clock of its own, which goes on by one length with each picture that is shown, and time enough to
/// draw each of them finely, before the next is begun: frames differ by what moves alone. `lesson.walk` goes to steps,
/// each of them after so many pictures, and gives by how much each picture differs from the one before (255ths, the
/// mean over all pixels).
const LESSON_CLOCK: &str = "import('./reader/engine.js').then(({ theEngine }) => theEngine()).then((engine) => {
  engine.release();
  const { reader } = engine;
  const [draw, go] = [reader.draw.bind(reader), reader.go.bind(reader)];
  const pad = new OffscreenCanvas(1, 1).getContext('2d', { willReadFrequently: true });
  let [now, id, isIdle, before, changes, acts, end, fail] = [10, 0, true, null, [], [], null, null];
  const act = () => {
    while (acts.length && acts[0][0] <= changes.length) e0.step = acts.shift()[1];
  };
  reader.go = (picture, step) => go((id = picture), step, now);
  reader.draw = (picture, width, height, time, budget, moves) => {
    if (picture !== id) return draw(picture, width, height, time, budget, moves);
    if (!isIdle) return 0;
    const flags = draw(picture, width, height, now, 30, moves);
    isIdle = false;
    devices.at(-1).queue.onSubmittedWorkDone().then(() => (isIdle = true));
    if (flags & 1) {
      const shown = e0.shadowRoot.querySelector('canvas:not(.paper)');
      [pad.canvas.width, pad.canvas.height] = [shown.width, shown.height];
      pad.drawImage(shown, 0, 0);
      const { data } = pad.getImageData(0, 0, shown.width, shown.height);
      if (before?.length === data.length) {
        changes.push(data.reduce((sum, value, at) => sum + Math.abs(value - before[at]), 0) / (0.75 * data.length));
      }
      before = data;
      now += 1 / 6;
      queueMicrotask(act);
    }
    if (flags & 2) acts.length ? fail(new Error(`at rest before ${acts}`)) : end(changes);
    return flags;
  };
  window.lesson = { walk: (wanted) => new Promise((...kept) => {
    [end, fail] = kept;
    [changes, acts] = [[], wanted];
    act();
  }) };
  return true;
})";

/// Goes to steps, each of them after so many pictures, and gives the changes from frame to frame once it rests.
async fn walk(tab: &Tab, acts: &[(usize, usize)]) -> Vec<f32> {
    let acts = serde_json::to_string(acts).expect("numbers");
    tab.eval(&format!("lesson.walk({acts})")).await
}

fn largest(changes: &[f32]) -> f32 {
    changes.iter().copied().fold(0.0, f32::max)
}

/// The picture that the embed rests at, as it is on the screen.
async fn at_rest(tab: &Tab) -> image::RgbaImage {
    let url: String = tab
        .eval("e0.shadowRoot.querySelector('.paper').toDataURL()")
        .await;
    let data = url.strip_prefix("data:image/png;base64,").expect("a PNG");
    let picture = image::load_from_memory(&from_base64(data)).expect("a PNG");
    picture.to_rgba8()
}

#[test]
fn a_lesson_rests_at_its_steps_and_never_jumps() {
    with_browser(BrowserGpu::Software, |session| async move {
        let link = payload(RECORDED);
        let embed = format!("controls step=4 src=\"#{link}\">");
        let tab = open_half(&session, &[embed], "", (240, 700)).await;
        ready(&tab, 1).await;
        rests_quietly(&tab).await;
        assert!(tab.eval::<bool>(LESSON_CLOCK).await);

        // What `fabrica render --step` draws, with as many samples as a software GPU has time for.
        let samples: u32 = tab.eval("window.fabricaSamples ?? 5").await;
        let size: [u32; 2] = picture_of(&tab, "e0").await.dimensions().into();
        let gpu = Gpu::open(&GpuOptions::default()).await.expect("a device");
        let mut cube = VolumeBuilder::new();
        fabrica::subjects::generate("cube", FINE_RESOLUTION, &mut cube).expect("a cube");
        let cube = cube.finish().expect("a whole volume");
        let studio = Studio::new(&gpu, &cube.into(), true).expect("it fits");
        let document = Document::from_json(RECORDED).expect("a document");
        let lesson = document.lesson().expect("steps");
        let mut pictures = Vec::new();
        for step in 0..=STEPS {
            let shown = lesson.at_step(step).expect("a step");
            let image = studio.render_image(shown, size, samples).await;
            let image = image.expect("a picture");
            let picture = image::RgbaImage::from_raw(size[0], size[1], image.rgba);
            pictures.push(picture.expect("whole"));
        }
        for (step, pair) in pictures.windows(2).enumerate() {
            let apart = difference(&pair[0], &pair[1], WHITE);
            assert!(
                apart.mean > 2.0 * NEAR,
                "step {} is seen: {apart:?}",
                step + 1
            );
        }
        let mut worst = 0.0_f64;
        let mut rests_at = async |step: usize, how: &str| {
            let told: usize = tab.eval("e0.step").await;
            assert_eq!(told, step, "{how}");
            let off = difference(&at_rest(&tab).await, &pictures[step], WHITE);
            assert!(off.mean < NEAR, "{how}, at step {step}: {off:?}");
            worst = worst.max(off.mean);
        };
        rests_at(4, "opened there").await;
        walk(&tab, &[(0, 0)]).await;
        rests_at(0, "far back").await;

        // Forward, undisturbed: the largest change from one picture to the next of each passage.
        let mut most = [0.0_f32; STEPS + 1];
        for (step, most) in most.iter_mut().enumerate().skip(1) {
            *most = largest(&walk(&tab, &[(0, step)]).await);
            rests_at(step, "forward").await;
        }
        println!("largest changes: {most:?}");
        // Back, each passage turned round in its middle, and round again.
        for step in (1..=STEPS).rev() {
            let changes = walk(&tab, &[(0, step - 1), (4, step), (6, step - 1)]).await;
            rests_at(step - 1, "back, interrupted").await;
            let found = largest(&changes);
            assert!(
                found <= SLACK * most[step] + ROUNDED,
                "{step}: {found}, {changes:?}"
            );
        }
        // Pressed on in the middle of a passage.
        let changes = walk(&tab, &[(0, 1), (4, 2)]).await;
        rests_at(2, "pressed on").await;
        let found = largest(&changes);
        assert!(
            found <= SLACK * most[1].max(most[2]) + ROUNDED,
            "{found}, {changes:?}"
        );
        // A step that is far away is a cut, and is found to be one.
        let cut = largest(&walk(&tab, &[(0, STEPS)]).await);
        assert!(cut > 1.5 * largest(&most), "{cut}, {most:?}");

        // To a place between two steps by the slider, and on from there.
        let scrub = |place: f32| {
            format!(
                "((slider) => {{ slider.value = {place}; slider.dispatchEvent(new Event('input')); return true; }})(e0.shadowRoot.querySelector('[part=scrub]'))"
            )
        };
        tab.eval::<bool>(&scrub(2.5)).await;
        rests_quietly(&tab).await;
        let between = at_rest(&tab).await;
        for (step, picture) in pictures.iter().enumerate() {
            let off = difference(&between, picture, WHITE);
            assert!(off.mean > NEAR, "between, not at {step}: {off:?}");
        }
        walk(&tab, &[(0, 3)]).await;
        rests_at(3, "on from between").await;
        tab.eval::<bool>(&scrub(5.0)).await;
        rests_quietly(&tab).await;
        rests_at(5, "scrubbed").await;

        println!("at rest the worst mean difference is {worst}");
        tab.assert_no_complaints().await;
    });
}

/// Two embeds of one clay show different strokes of it, and steps show it grow, each as the native program shapes it.
/// The caption is on its tissue in all of them.
#[test]
fn a_clay_grows_by_steps() {
    const GROWS: &str = r#"{"fabrica":1,"subject":{"clay":{"detail":0.05,"tools":[{"radius":0.15}],
        "strokes":[{"path":[0,0,400,0,0,150]},{"path":[700,0,0,-350,0,0]}]}},"look":{"strokes":0},"labels":[{"at":[0,0,0.5],"text":"Tip"}],
        "steps":[{"title":"Pulled","seconds":0.1,"set":{"/look/strokes":1}},{"title":"Pressed","seconds":0.1,"set":{"/look/strokes":2}}]}"#;
    with_browser(BrowserGpu::Software, |session| async move {
        let link = payload(GROWS);
        let embeds = [0, 2].map(|step| format!("controls step={step} src=\"#{link}\">"));
        let tab = open_half(&session, &embeds, "", (240, 700)).await;
        ready(&tab, 2).await;
        rests_quietly(&tab).await;
        let size: [u32; 2] = picture_of(&tab, "e0").await.dimensions().into();
        let gpu = Gpu::open(&GpuOptions::default()).await.expect("a device");
        let document = Document::from_json(GROWS).expect("a document");
        let lesson = document.lesson().expect("steps");
        let (mut pictures, mut tips) = (Vec::new(), Vec::new());
        for step in 0..=2 {
            let shown = lesson.at_step(step).expect("a step");
            let SubjectRef::Clay(clay) = shown.subject_shown() else {
                panic!("a clay")
            };
            assert_eq!(clay.strokes.len(), step);
            let tip = Way::of(&clay, &Grids::default()).forward_of(DVec3::new(0.0, 0.0, 0.5));
            let tip = View::new(&shown.camera, size).pixel_from_subject(tip.as_vec3());
            tips.push(tip.expect("in the picture") / Vec2::from(size.map(|n| n as f32)));
            let made = surface_of_clay(&mut ClayDesk::default(), &clay, &mut |_| true);
            let subject = fabrica::data::Subject::from(made.expect("it can be made").0);
            let studio = Studio::new(&gpu, &subject, true).expect("it fits");
            let image = studio.render_image(shown, size, 5).await;
            let image = image.expect("a picture");
            let picture = image::RgbaImage::from_raw(size[0], size[1], image.rgba);
            pictures.push(picture.expect("whole"));
        }
        let looks_like = |picture: &image::RgbaImage| {
            let off = |step: usize| difference(picture, &pictures[step], WHITE).mean;
            (0..3).min_by(|a, b| off(*a).total_cmp(&off(*b)))
        };
        assert_eq!(looks_like(&picture_of(&tab, "e0").await), Some(0));
        assert_eq!(looks_like(&picture_of(&tab, "e1").await), Some(2));
        for step in [1, 2, 0] {
            tab.eval::<bool>(&format!("(e0.step = {step}, true)")).await;
            // Nothing is drawn while a worker shapes, so that quiet alone says little.
            let mut seen = None;
            for _ in 0..200 {
                seen = looks_like(&picture_of(&tab, "e0").await);
                if seen == Some(step) {
                    break;
                }
                tokio::time::sleep(std::time::Duration::from_millis(200)).await;
            }
            assert_eq!(seen, Some(step));
            // The dot at the end of its line is seen, and stands there as a part of the picture.
            let [x, y] = tips[step].to_array();
            let is_there = format!(
                "(() => {{ const [dot, room] = ['circle', 'canvas'].map(name => e0.shadowRoot.querySelector(name));
                    const at = name => Number(dot.getAttribute(name));
                    return dot.style.display !== 'none'
                        && Math.hypot(at('cx') / room.clientWidth - {x}, at('cy') / room.clientHeight - {y}) < 0.02; }})()"
            );
            tab.wait_until(&is_there, 30).await;
        }
        assert!(tips[0].distance(tips[1]) > 0.05, "it is pulled: {tips:?}");
        assert_eq!(looks_like(&picture_of(&tab, "e1").await), Some(2));
        tab.assert_no_complaints().await;
    });
}
