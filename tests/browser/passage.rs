//! Passages of a lesson in the reader: captions with the picture that they belong to.

use super::embed::{open_coarse, ready, rests_quietly};
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

/// In every frame of a passage the end of a leader line is at its tissue.
#[test]
fn captions_go_with_the_pictures_of_a_passage() {
    with_browser(BrowserGpu::Software, |session| async move {
        let link = payload(CARRIED);
        let tab = open_coarse(&session, &[format!("src=\"#{link}\">")], "", (240, 400)).await;
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

        let gpu = Gpu::open(&GpuOptions::default()).await.expect("a device");
        let mut builder = VolumeBuilder::new();
        fabrica::subjects::generate("cube", FINE_RESOLUTION, &mut builder).expect("a subject");
        let volume = builder.finish().expect("a whole volume");
        let studio = Studio::new(&gpu, &volume.into(), true).expect("the subject fits");
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

        tab.assert_no_complaints().await;
    });
}
