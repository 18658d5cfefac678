//! Faults of the reader's program: one picture stops, the others of the page go on.

use super::embed::{
    LESSON, lesson, open_coarse, part_of, picture_of, ready, rests_at, rests_quietly,
};
use super::harness::Tab;
use super::*;

/// A trap and a panic, which no document leads to: `trap()` calls the program with an object that lies outside of its
/// memory, `panic(id)` calls it while it is at work. Each engine is another one.
const FAULTS: &str = "import('./reader/engine.js').then(({ theEngine }) => theEngine()).then((engine) => {
  engine.release();
  const { reader } = engine;
  const { view } = Object.getPrototypeOf(reader);
  window.reader = reader;
  window.trap = () => view.call({ __wbg_ptr: 0xfffffff0 }, 1);
  window.panic = (id) => reader.add({ getContext: () => reader.view(id) }, '{\"fabrica\":1}', location.href, 0);
  return true;
})";

/// The sentence of an embed that has stopped.
const STOPPED: &str = "This illustration stopped because of a fault in the viewer.";

/// Both embeds have told a fault.
const BOTH_STOPPED: &str = "(told.filter(([name]) => name === 'error').length === 2)";

/// What embeds have told since the last time: name and embed.
async fn told(tab: &Tab) -> Vec<(String, String)> {
    tab.eval("told.splice(0).map(([name, id]) => [name, id])")
        .await
}

/// The words that stand under an embed's picture.
async fn words(tab: &Tab, embed: &str) -> String {
    tab.eval(&format!(
        "((words) => words.hidden ? '' : words.textContent)({embed}.shadowRoot.querySelector('.words'))"
    ))
    .await
}

/// An embed whose call ends the program keeps its picture and says so; the other comes back with its step, values and
/// view on a device of its own. What stops again and again is not begun anew any more.
#[test]
fn a_fault_in_one_embed_leaves_the_others_running() {
    with_browser(BrowserGpu::Software, |session| async move {
        let plain = format!("class=narrow src=\"#{}\">", payload(PLAIN));
        let embeds = [plain, lesson("controls")];
        let tab = open_coarse(&session, &embeds, "", (320, 900)).await;
        ready(&tab, 2).await;
        tab.eval::<bool>("(e1.next(), true)").await;
        rests_at(&tab, "e1", 1).await;
        tab.eval::<bool>("(e1.setParam('/templates/0/params/amount', 0.1), e1.shadowRoot.querySelector('[part~=left]').click(), true)")
            .await;
        rests_quietly(&tab).await;
        let seen = drawn_pixels(&part_of(&tab, "e0", "before_the_fault").await);
        let before = picture_of(&tab, "e1").await;
        rests_quietly(&tab).await;
        told(&tab).await;

        // A panic in a call for the first embed. The last pictures stand from then on.
        tab.eval::<bool>(FAULTS).await;
        let stand: [bool; 2] = tab
            .eval("(() => {
  window.promised = e1.toDataURL().then(() => 'kept', (error) => error.message);
  reader.set = panic;
  let hasThrown = false;
  try { e0.setParam('/camera/fov', 40); } catch { hasThrown = true; }
  const stands = ({ shadowRoot }) => getComputedStyle(shadowRoot.querySelector('.lost .paper')).display === 'block';
  return [hasThrown, stands(e0) && stands(e1)];
})()")
            .await;
        assert_eq!(stand, [true, true]);
        // What it had promised is refused.
        let answer: String = tab.eval("promised").await;
        assert_eq!(answer, "The viewer stopped because of a fault.");
        tab.wait_until("devices.length === 2 && ledger.devices.size === 1", 120)
            .await;
        rests_at(&tab, "e1", 1).await;
        let errors: Vec<(String, String)> = vec![("error".to_owned(), "e0".to_owned())];
        assert_eq!(told(&tab).await, errors, "the other tells nothing");
        assert_eq!(words(&tab, "e0").await, STOPPED);
        assert_eq!(words(&tab, "e1").await, "");
        let after = picture_of(&tab, "e1").await;
        let off = difference(&before, &after, WHITE).mean;
        assert!(off < 0.2, "the same picture after the fault: {off}");
        let still = drawn_pixels(&part_of(&tab, "e0", "after_the_fault").await);
        assert!(seen > 1000 && still * 10 > seen * 7, "{still} of {seen} px");
        // It goes on.
        tab.eval::<bool>("(e1.reset(), e1.next(), true)").await;
        rests_at(&tab, "e1", 2).await;
        assert_eq!(tab.eval::<usize>("ledger.workers.size").await, 0);

        // Another source begins anew.
        told(&tab).await;
        tab.eval::<bool>(&format!(
            "(e0.setAttribute('src', '#{}'), true)",
            payload(LESSON)
        ))
        .await;
        ready(&tab, 1).await;
        assert_eq!(words(&tab, "e0").await, "");
        rests_quietly(&tab).await;
        told(&tab).await;

        // A trap that nobody is to blame for: both come back, and both stop when it is too much within a minute. A slow
        // machine may need more than that for the first ones.
        let mut rounds = 0;
        while !tab.eval::<bool>(BOTH_STOPPED).await {
            rounds += 1;
            assert!(rounds < 6, "it is begun anew for ever");
            tab.eval::<bool>(FAULTS).await;
            let made: usize = tab
                .eval("(reader.tick = trap, e1.reset(), devices.length)")
                .await;
            let goes_on = format!("(devices.length > {made} && ledger.devices.size === 1)");
            tab.wait_until(&format!("{goes_on} || {BOTH_STOPPED}"), 120)
                .await;
            if rounds == 1 {
                rests_quietly(&tab).await;
                let heard = told(&tab).await;
                assert!(
                    heard.iter().all(|(name, _)| name == "viewchange"),
                    "{heard:?}"
                );
            }
        }
        assert!(rounds > 1, "the first time both came back");
        for embed in ["e0", "e1"] {
            assert_eq!(words(&tab, embed).await, STOPPED);
        }
        rests_quietly(&tab).await;
        let living: usize = tab.eval("ledger.devices.size").await;
        assert_eq!(living, 0, "nothing is begun anew");
    });
}
