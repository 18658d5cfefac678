//! Passages of a lesson in the reader: captions with the picture that they belong to.

use super::accessible::emulate;
use super::embed::{open_coarse, ready, rests_at, rests_quietly};
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

/// Who wants less motion sees steps follow each other at once, and nothing plays by itself. Who changes her mind sees
/// passages.
#[test]
fn steps_are_cut_where_less_motion_is_wanted() {
    with_browser(BrowserGpu::Software, |session| async move {
        let lesson = format!("src=\"#{}\" controls>", payload(CARRIED));
        let tab = open_coarse(&session, &[lesson], "", (240, 560)).await;
        emulate(&tab, "", &[("prefers-reduced-motion", "reduce")]).await;
        ready(&tab, 1).await;
        rests_quietly(&tab).await;
        assert!(tab.eval::<bool>(TRACK).await);
        let at_rest: (u32, String) = tab
            .eval(
                "[e0.step, e0.shadowRoot.querySelector('[part~=play]').getAttribute('aria-label')]",
            )
            .await;
        assert_eq!(at_rest, (0, "Play".to_owned()), "nothing plays by itself");
        for step in [1, 2] {
            tab.eval::<bool>("(e0.next(), true)").await;
            rests_at(&tab, "e0", step).await;
        }
        // Played on wish, a lesson after its last step begins at its start, and goes on by cuts.
        tab.eval::<bool>("(e0.play(), true)").await;
        tab.wait_until("e0.step === 1", 60).await;
        tab.eval::<bool>("(e0.pause(), true)").await;
        rests_quietly(&tab).await;
        let places: Vec<f32> = tab.eval("track.map(([position]) => position)").await;
        let between = places.iter().find(|at| at.fract() != 0.0);
        assert!(between.is_none() && places.contains(&2.0), "{places:?}");

        emulate(&tab, "", &[("prefers-reduced-motion", "no-preference")]).await;
        let wants_less = "matchMedia('(prefers-reduced-motion: reduce)').matches";
        tab.wait_until(&format!("!{wants_less}"), 20).await;
        tab.frames(3).await;
        tab.eval::<bool>("(track.length = 0, e0.next(), true)")
            .await;
        rests_at(&tab, "e0", 2).await;
        let passes: bool = tab
            .eval("track.some(([position]) => position % 1 !== 0)")
            .await;
        assert!(passes, "a passage is tracked");
        tab.assert_no_complaints().await;
    });
}

/// A caption whose tissue a step cuts away stays in the list, which says so in the page's language.
#[test]
fn the_list_of_captions_says_what_was_cut_away() {
    with_browser(BrowserGpu::Software, |session| async move {
        let json = r#"{"fabrica":1,"subject":{"builtin":"cube"},"templates":[{"kind":"cut","at":[0,0,0.5],"size":[2,2,0.6],"enabled":false}],"labels":[{"at":[0.3,0.49,0.4],"text":"Lid"},{"at":[-0.3,0.49,-0.3],"text":"Wall"}],"steps":[{"set":{"/templates/0/enabled":true}}]}"#;
        let lesson = format!("src=\"#{}\" controls>", payload(json));
        let tab = open_coarse(&session, &[lesson], "", (240, 560)).await;
        ready(&tab, 1).await;
        let list = "e0.shadowRoot.querySelector('ol[part=captions]')";
        let texts = format!("[...{list}.querySelectorAll('li')].map((it) => it.textContent)");
        assert_eq!(tab.eval::<Vec<String>>(&texts).await, ["Lid", "Wall"]);
        tab.eval::<bool>("(e0.next(), true)").await;
        rests_at(&tab, "e0", 1).await;
        let after: Vec<String> = tab.eval(&texts).await;
        assert_eq!(after, ["Lid (cut away)", "Wall"]);
        let seen: [bool; 2] = tab
            .eval(&format!(
                "[...{list}.querySelectorAll('li')].map((it) => !it.classList.contains('absent'))"
            ))
            .await;
        assert_eq!(seen, [false, true], "for screen readers alone");
        let name: String = tab
            .eval(&format!("{list}.getAttribute('aria-label')"))
            .await;
        assert_eq!(name, "Captions");
        tab.eval::<bool>("(e0.lang = 'de', true)").await;
        tab.wait_until(&format!("{texts}[0] === 'Lid (weggeschnitten)'"), 30)
            .await;
        tab.assert_no_complaints().await;
    });
}
