//! The examples in the page: fetched when they are looked at and not before, and opened by a click.

use super::hand::{self, click, document, find, focus, strike};
use super::harness::Tab;
use super::*;
use std::collections::BTreeSet;

/// Bytes of the list and of the pictures together.
const MOST_BYTES: u64 = 400_000;

#[test]
fn examples_are_fetched_when_they_are_looked_at() {
    const SIZE: (u32, u32) = (960, 540);
    with_browser(BrowserGpu::Software, |session| async move {
        let tab = session
            .coarse_viewer(&format!("#{}", payload(PLAIN)), SIZE)
            .await;
        tab.settled().await;
        let asked = || {
            let mut asked = session.server.asked();
            asked.retain(|path| path.contains("/examples/"));
            asked.sort();
            asked
        };
        assert!(asked().is_empty(), "unasked: {:?}", asked());
        // From the press: until the cards are there, and until a frame was painted after their pictures had come.
        let clock = "(window.opening = new Promise((resolve) => addEventListener('pointerdown', (event) => {
            const viewer = window.fabrica.viewer, times = [];
            let frame = 0;
            const look = () => {
              const file = performance.getEntriesByType('resource').find((file) => file.name.endsWith('pictures.png'));
              const here = file?.responseEnd > 0 && viewer.controls().includes('Open the example');
              if (times.length === 0 && here) { times.push(performance.now() - event.timeStamp); frame = viewer.frame(); }
              if (times.length === 1 && viewer.frame() > frame) resolve([...times, performance.now() - event.timeStamp]);
              else setTimeout(look, 5);
            };
            look();
          }, { capture: true, once: true })), true)";
        hand::listed(&tab).await;
        tab.eval::<bool>(clock).await;
        click(&tab, "Examples").await;
        let [cards, pictures]: [f64; 2] = tab.eval("window.opening").await;
        println!(
            "examples: cards and files {cards:.0} ms after the press, painted with pictures after {pictures:.0} ms"
        );
        find(&tab, "Subject of the examples").await;
        let both = ["/examples/list.json", "/examples/pictures.png"];
        let files = "performance.getEntriesByType('resource').filter((file) => file.name.includes('/examples/'))";
        tab.wait_until(&format!("{files}.length === 2"), 20).await;
        assert_eq!(asked(), both);
        let bytes: u64 = tab
            .eval(&format!(
                "{files}.reduce((sum, file) => sum + file.encodedBodySize, 0)"
            ))
            .await;
        println!("{bytes} bytes of examples");
        assert!((20_000..=MOST_BYTES).contains(&bytes), "{bytes} bytes");
        let page = tab.picture("library").await;
        each_is_reached(&tab, &page).await;

        click(&tab, "Subject of the examples").await;
        click(&tab, "Cube").await;
        click(&tab, "Open the example Ten ways to open a block").await;
        tab.wait_until(
            "JSON.parse(window.fabrica.viewer.get_document()).title === 'Ten ways to open a block'",
            60,
        )
        .await;
        let opened = document(&tab).await;
        assert_eq!(
            opened["steps"].as_array().map(Vec::len),
            Some(SHOWCASE_STEPS)
        );
        assert_eq!(asked(), both, "the list holds the whole example");
        tab.assert_no_complaints().await;
    });
}

const SHOWCASE_STEPS: usize = 9;

/// Every example has a card that a screen reader finds and the tabulator comes to; those in sight have pictures.
async fn each_is_reached(tab: &Tab, page: &image::RgbaImage) {
    let list = std::fs::read(harness::dist().join("examples/list.json")).expect("the list");
    let list: serde_json::Value = serde_json::from_slice(&list).expect("JSON");
    let titles: BTreeSet<String> = list["examples"]
        .as_array()
        .expect("examples")
        .iter()
        .map(|example| {
            example["document"]["title"]
                .as_str()
                .expect("a title")
                .to_owned()
        })
        .collect();
    assert!(titles.len() > 20, "{titles:?}");
    let shown = hand::controls(tab).await;
    let mut in_sight = 0;
    for title in &titles {
        let name = format!("Open the example {title}");
        let card = shown.iter().find(|control| control.name == name);
        let card = card.unwrap_or_else(|| panic!("no card for {title}: {shown:?}"));
        assert_eq!(card.role, "Button", "{card:?}");
        // The upper part of a card is its picture.
        let ((left, top), (right, bottom)) = (card.corner(0.1, 0.05), card.corner(0.9, 0.4));
        if top > 120.0 && bottom < f64::from(page.height()) - 40.0 {
            let colors: BTreeSet<[u8; 4]> = (left as u32..right as u32)
                .flat_map(|x| (top as u32..bottom as u32).map(move |y| page.get_pixel(x, y).0))
                .collect();
            assert!(
                colors.len() > 50,
                "{title}: a picture of {} colours",
                colors.len()
            );
            in_sight += 1;
        }
    }
    assert!(in_sight >= 3, "{in_sight} cards in sight");

    focus(tab).await;
    let said = "document.getElementById('said').textContent";
    let mut left = titles.clone();
    for _ in 0..3 * titles.len() + 20 {
        // One frame takes the key in and says where it went, at the latest in the next round.
        strike(tab, 0, "Tab", None).await;
        tab.frames(1).await;
        let heard: String = tab.eval(said).await;
        left.retain(|title| !heard.contains(&format!("Open the example {title}")));
        if left.is_empty() {
            break;
        }
    }
    assert!(left.is_empty(), "the tabulator never comes to {left:?}");
}
