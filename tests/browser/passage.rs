//! Passages of a lesson in the reader: captions with the picture that they belong to, and the pictures at rest.

use super::accessible::emulate;
use super::embed::{open, ready, rests_quietly};
use super::harness::Tab;
use super::*;
use fabrica::data::VolumeBuilder;
use fabrica::document::Lesson;
use fabrica::render::caption_places;
use fabrica::subjects::FINE_RESOLUTION;

/// Two captions on tissue that a passage carries away, and a step that turns the camera as well.
const CARRIED: &str = r#"{"fabrica":1,"subject":{"builtin":"cube"},"templates":[{"kind":"split","size":[1.2,1.2,1.2],"params":{"amount":0}}],"labels":[{"at":[0.3,0.49,0.3],"text":"Left"},{"at":[-0.25,0.49,-0.2],"text":"Right"}],"steps":[{"set":{"/templates/0/params/amount":0.25},"seconds":3},{"set":{"/camera/distance":3,"/camera/rotate":[0,0,0.3,0.95]},"seconds":2}]}"#;

/// Keeps where the lesson stands and where the ends of the leader lines are, whenever a picture is shown.
const TRACK: &str = "import('./reader/engine.js').then(({ theEngine }) => theEngine()).then((engine) => {
  engine.release();
  window.track = [];
  const { reader } = engine;
  const ask = reader.captions.bind(reader);
  reader.captions = (id, ...rest) => {
    const found = ask(id, ...rest);
    const { position } = JSON.parse(reader.state(id, 0));
    queueMicrotask(() => {
      const ends = [...e0.shadowRoot.querySelectorAll('circle')].map((circle) => [Number(circle.getAttribute('cx')), Number(circle.getAttribute('cy'))]);
      track.push([position, ends, JSON.parse(reader.view(id))]);
    });
    return found;
  };
  return true;
})";

/// Six steps: a template grows, the ground changes, the camera goes round; at the third a template and a caption are
/// switched on; the fifth switches the template off.
const SIX: &str = r##"{"fabrica":1,"subject":{"builtin":"cube"},"look":{"background":"#f4efe6"},"camera":{"distance":2.4},"templates":[{"kind":"split","size":[1.2,1.2,1.2],"params":{"amount":0}},{"kind":"twist","enabled":false,"params":{"angle":1}}],"labels":[{"at":[0.3,0.49,0.3],"text":"Corner","enabled":false}],"steps":[{"set":{"/templates/0/params/amount":0.25},"seconds":0.8},{"set":{"/look/background":"#204060"},"seconds":0.8},{"set":{"/templates/1/enabled":true,"/labels/0/enabled":true},"seconds":0.8},{"set":{"/camera/rotate":[0,0,0.3,0.95]},"seconds":0.8},{"set":{"/templates/1/enabled":false},"seconds":0.8},{"set":{"/templates/0/params/amount":0.05,"/camera/distance":3},"seconds":0.8}]}"##;

/// Whenever a picture is shown, keeps where the lesson stands, the time, and how far the picture is off the one before:
/// the mean over its values, of 255.
const FILMED: &str = "import('./reader/engine.js').then(({ theEngine }) => theEngine()).then((engine) => {
  engine.release();
  window.track = [];
  const { reader } = engine;
  const small = new OffscreenCanvas(80, 60).getContext('2d', { willReadFrequently: true });
  let before = null;
  const ask = reader.captions.bind(reader);
  reader.captions = (id, ...rest) => {
    small.clearRect(0, 0, 80, 60);
    small.drawImage(e0.shadowRoot.querySelector('canvas[part=picture]'), 0, 0, 80, 60);
    const { data } = small.getImageData(0, 0, 80, 60);
    const off = before ? data.reduce((sum, value, i) => sum + Math.abs(value - before[i]), 0) / data.length : 0;
    before = data;
    const { position } = JSON.parse(reader.state(id, 0));
    track.push([position, performance.now() * 1e-3, off]);
    return ask(id, ...rest);
  };
  return true;
})";

/// What was kept since the last time.
async fn filmed(tab: &Tab) -> Vec<[f64; 3]> {
    tab.eval("window.track.splice(0)").await
}

/// How fast pictures change from frame to frame, per second: the largest value, and the largest change of neighbours.
fn fastest(track: &[[f64; 3]]) -> [f64; 2] {
    let rates = track.windows(2).map(|pair| {
        let [before, now] = [&pair[0], &pair[1]];
        now[2] / (now[1] - before[1]).max(1e-3)
    });
    let most = track.iter().map(|now| now[2]).fold(0.0, f64::max);
    [rates.fold(0.0, f64::max), most]
}

/// The picture that an embed's canvas shows at rest.
async fn canvas_of(tab: &Tab) -> image::RgbaImage {
    let url: String = tab
        .eval("e0.shadowRoot.querySelector('.paper').toDataURL()")
        .await;
    let data = url.strip_prefix("data:image/png;base64,").expect("a PNG");
    let picture = image::load_from_memory(&from_base64(data)).expect("a PNG");
    picture.to_rgba8()
}

/// However a lesson of six steps is walked, the embed comes to rest at the pictures that the native program draws, and
/// neighbouring frames differ by no more than in a passage that nobody disturbs.
#[test]
fn a_lesson_rests_at_its_steps_however_it_is_walked() {
    with_browser(BrowserGpu::Software, |session| async move {
        let link = payload(SIX);
        let embed = format!("src=\"#{link}\" controls>");
        let tab = open(&session, &[embed], "", (216, 520)).await;
        ready(&tab, 1).await;
        rests_quietly(&tab).await;
        let first = canvas_of(&tab).await;
        let size = [first.width(), first.height()];

        let studio = studio_of_the_cube().await;
        let document = Document::from_json(SIX).expect("a document");
        let lesson = document.lesson().expect("steps");
        let mut pictures = Vec::new();
        for step in 0..=6 {
            let shown = lesson.at_step(step).expect("a step");
            let image = studio
                .render_image(shown, size, 4)
                .await
                .expect("a picture");
            pictures.push(image::RgbaImage::from_raw(size[0], size[1], image.rgba).expect("whole"));
        }
        let least = pictures
            .windows(2)
            .map(|pair| difference(&pair[0], &pair[1], WHITE).mean);
        let least = least.fold(f64::INFINITY, f64::min);
        let rests_at = async |step: usize, how: &str| {
            super::embed::rests_at(&tab, "e0", step).await;
            let off = difference(&canvas_of(&tab).await, &pictures[step], WHITE).mean;
            assert!(
                off < 0.3 * least,
                "{how}, step {step}: {off} of 255, steps differ by {least}"
            );
        };
        rests_at(0, "opened").await;
        assert!(tab.eval::<bool>(FILMED).await);

        // Forward and back: as fast as pictures change where nobody disturbs them.
        let mut undisturbed = [0.0_f64; 2];
        for step in (1..=6).chain((0..6).rev()) {
            tab.eval::<bool>(&format!("(e0.step = {step}, true)")).await;
            rests_at(step, "walked").await;
            let [rate, most] = fastest(&filmed(&tab).await);
            undisturbed = [undisturbed[0].max(rate), undisturbed[1].max(most)];
        }
        // Each passage is interrupted in its middle, twice.
        let mut disturbed = [0.0_f64; 2];
        for step in 1..=6_u8 {
            let middle = f64::from(step) - 0.5;
            tab.eval::<bool>("(e0.next(), true)").await;
            let is_there = format!("Math.abs((track.at(-1)?.[0] ?? 0) - {middle}) < 0.4");
            tab.wait_until(&is_there, 20).await;
            tab.eval::<bool>("(e0.previous(), true)").await;
            tab.frames(3).await;
            tab.eval::<bool>("(e0.next(), true)").await;
            rests_at(step.into(), "interrupted").await;
            let [rate, most] = fastest(&filmed(&tab).await);
            disturbed = [disturbed[0].max(rate), disturbed[1].max(most)];
        }
        println!(
            "change per second and in a frame: undisturbed {undisturbed:?}, disturbed {disturbed:?}"
        );
        assert!(
            disturbed[0] <= 1.25 * undisturbed[0],
            "{disturbed:?}, undisturbed {undisturbed:?}"
        );
        // A cut from the last step to the first is more than any frame of a passage.
        tab.eval::<bool>("(e0.step = 1, true)").await;
        rests_at(1, "cut").await;
        let [_, cut] = fastest(&filmed(&tab).await);
        let most = undisturbed[1].max(disturbed[1]);
        assert!(cut > 1.2 * most, "a cut changes {cut}, a frame {most}");

        // To a place between two steps, and on from there; and opened at a step by its link.
        let scrub = "e0.shadowRoot.querySelector('[part=scrub]')";
        tab.eval::<bool>(&format!(
            "({scrub}.value = 1.5, {scrub}.dispatchEvent(new Event('input')), true)"
        ))
        .await;
        rests_quietly(&tab).await;
        tab.eval::<bool>("(e0.next(), true)").await;
        rests_at(2, "scrubbed").await;
        tab.eval::<bool>(&format!(
            "(told.length = 0, e0.setAttribute('src', '#{link}&step=4'), true)"
        ))
        .await;
        ready(&tab, 1).await;
        rests_at(4, "opened at a step").await;

        // Who wants less motion sees cuts.
        emulate(&tab, "", &[("prefers-reduced-motion", "reduce")]).await;
        filmed(&tab).await;
        tab.eval::<bool>("(e0.next(), true)").await;
        rests_at(5, "without motion").await;
        let between = filmed(&tab).await;
        assert!(
            between.iter().all(|[at, ..]| at.fract() == 0.0),
            "{between:?}"
        );
        tab.assert_no_complaints().await;
    });
}

/// The cube, as the native program draws it.
async fn studio_of_the_cube() -> Studio {
    let gpu = Gpu::open(&GpuOptions::default()).await.expect("a device");
    let mut builder = VolumeBuilder::new();
    fabrica::subjects::generate("cube", FINE_RESOLUTION, &mut builder).expect("a subject");
    let volume = builder.finish().expect("a whole volume");
    Studio::new(&gpu, &volume.into(), true).expect("the subject fits")
}

/// In every frame of a passage the end of a leader line is at its tissue, and at rest the picture is the native
/// program's.
#[test]
fn captions_go_with_the_pictures_of_a_passage() {
    with_browser(BrowserGpu::Software, |session| async move {
        let link = payload(CARRIED);
        let tab = open(&session, &[format!("src=\"#{link}\">")], "", (240, 400)).await;
        ready(&tab, 1).await;
        rests_quietly(&tab).await;
        assert!(tab.eval::<bool>(TRACK).await);
        for step in 1..=2 {
            tab.eval::<bool>(&format!("(e0.step = {step}, true)")).await;
            tab.wait_until(&format!("track.at(-1)?.[0] === {step}"), 120)
                .await;
        }
        rests_quietly(&tab).await;
        let track: Vec<(f32, Vec<[f32; 2]>, serde_json::Value)> = tab.eval("track").await;
        let size: [u32; 2] = tab.eval("(({ clientWidth, clientHeight }) => [clientWidth, clientHeight])(e0.shadowRoot.querySelector('.stage'))").await;

        let studio = studio_of_the_cube().await;
        let document = Document::from_json(CARRIED).expect("a document");
        let lesson = document.lesson().expect("steps");
        let between: Vec<_> = track.iter().filter(|(at, ..)| at.fract() > 0.0).collect();
        println!(
            "{} frames, {} of them in passages",
            track.len(),
            between.len()
        );
        assert!(between.len() >= 4, "a passage has frames");
        let mut worst = 0.0_f32;
        // Every eighth frame: the native program is slow at this.
        for (at, ends, view) in track.iter().rev().step_by(8) {
            let (before, part) = (at.floor() as usize, at.fract());
            let state = |step: usize| lesson.at_step(step).expect("a step");
            let mut shown = match part > 0.0 {
                true => Lesson::between(state(before), state(before + 1), part),
                false => (**state(before)).clone(),
            };
            let numbers = |key: &str| -> Vec<f32> {
                serde_json::from_value(view[key].clone()).expect("numbers")
            };
            shown.camera.rotate = glam::Quat::from_slice(&numbers("rotate"));
            shown.camera.distance = view["distance"].as_f64().expect("a number") as f32;
            let places = caption_places(&studio, &shown, size).await.expect("places");
            let seen = View::new(&shown.camera, size);
            for (place, end) in places.iter().zip(ends) {
                let (place, _) = place.expect("its tissue is there");
                let pixel = seen.pixel_from_subject(place).expect("before the camera");
                worst = worst.max(pixel.distance(glam::Vec2::from(*end)));
            }
        }
        println!("the worst end is {worst} pixels off");
        assert!(worst <= 1.4, "{worst} pixels");

        // At rest the picture is that of the native program at this step.
        let shown = lesson.at_step(2).expect("a step");
        let image = studio
            .render_image(shown, size, 4)
            .await
            .expect("a picture");
        let native = image::RgbaImage::from_raw(size[0], size[1], image.rgba).expect("whole");
        let own = super::embed::picture_of(&tab, "e0").await;
        assert_eq!(own.dimensions(), native.dimensions());
        let off = difference(&own, &native, WHITE);
        println!("at rest: {off:?}");
        assert!(off.mean < 2.0, "{off:?}");
        tab.assert_no_complaints().await;
    });
}
