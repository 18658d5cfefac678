//! What stands at the edges of an embed's picture, and letters that only a browser shapes.

use super::embed::{open, ready, rests_quietly, stage};
use super::*;
use fabrica::data::VolumeBuilder;
use fabrica::render::ScaleBar;

/// A scale bar as long as the native program says, letters of the sides that follow the camera, captions in Arabic and
/// Hebrew as text.
#[test]
fn an_embed_has_a_scale_and_letters_where_its_author_wishes() {
    with_browser(BrowserGpu::Software, |session| async move {
        let json = r##"{"fabrica":1,"subject":{"builtin":"cube"},"look":{"background":"#20262b","scale":true,"sides":true},"labels":[{"at":[0.3,0.49,0.3],"text":"عظم الجبهة"},{"at":[-0.3,0.49,-0.3],"text":"עצם"},{"at":[-0.3,0.49,0.2],"text":"Bone"}],"title":"Whole","caption":"As it is.","steps":[{"set":{"/look/scale":false,"/camera/rotate":[0,0,1,0],"/title":"From behind"}},{"title":"Own","set":{"/caption":"Set"}}]}"##;
        let lesson = format!("src=\"#{}\" controls>", payload(json));
        let tab = open(&session, &[lesson], "", (520, 600)).await;
        ready(&tab, 1).await;
        rests_quietly(&tab).await;
        tab.picture("embed_marks").await;
        let letters = "[...e0.shadowRoot.querySelectorAll('[part=side]')].map((it) => it.hidden ? '' : it.textContent)";
        let found: Vec<String> = tab.eval(letters).await;
        assert_eq!(found, ["R", "L", "S", "I"]);
        let [_, _, width, height] = stage(&tab, "e0").await;
        let (bar, told): (f64, String) = tab
            .eval("((bar) => [bar.getBoundingClientRect().width, bar.textContent])(e0.shadowRoot.querySelector('[part=scale]'))")
            .await;
        let document = Document::from_json(json).expect("a document");
        let size = [width, height].map(|side| side.round() as u32);
        let mut cube = VolumeBuilder::new();
        fabrica::subjects::generate("cube", 32, &mut cube).expect("a cube");
        let mm_per_unit = cube.finish().expect("a whole volume").grid.mm_per_unit();
        let wanted = ScaleBar::of(&document.illustration().camera, size, mm_per_unit);
        let wanted = wanted.expect("a bar");
        assert_eq!(told, wanted.text());
        assert!(
            (bar - f64::from(wanted.length_px)).abs() < 1.0,
            "{bar} px, {wanted:?}"
        );

        // Captions are text in the document's order; none of them lies on a letter.
        let texts: Vec<String> = tab
            .eval("[...e0.shadowRoot.querySelectorAll('[part=caption]')].map((it) => it.firstChild.data)")
            .await;
        assert_eq!(texts, ["عظم الجبهة", "עצם", "Bone"]);
        let overlapping: u32 = tab
            .eval("((marks, texts) => marks.flatMap((a) => texts.filter((b) => a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom)).length)(...['.mark:not([hidden])', '[part=caption]:not(.absent)'].map((of) => [...e0.shadowRoot.querySelectorAll(of)].map((it) => it.getBoundingClientRect())))")
            .await;
        assert_eq!(overlapping, 0);

        tab.eval::<bool>("(e0.next(), true)").await;
        tab.wait_until(&format!("({letters}).join() === 'L,R,S,I'"), 60)
            .await;
        rests_quietly(&tab).await;
        assert!(
            tab.eval::<bool>("e0.shadowRoot.querySelector('[part=scale]').hidden")
                .await,
            "the step has no bar"
        );
        tab.picture("embed_marks_behind").await;

        // Title and caption are those of the step, else what a step has set.
        let legend = "e0.shadowRoot.querySelector('[part=legend]').textContent";
        let mut found = vec![tab.eval::<String>(legend).await];
        for step in [2, 0] {
            tab.eval::<bool>(&format!("(e0.step = {step}, true)")).await;
            rests_quietly(&tab).await;
            found.push(tab.eval(legend).await);
        }
        assert_eq!(found, ["From behind", "Own: Set", "Whole: As it is."]);
        tab.assert_no_complaints().await;
    });
}
