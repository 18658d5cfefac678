//! Texts that the page sets in place of the canvas: web/texts.js.

use egui::{Vec2, vec2};
use serde_json::json;
use wasm_bindgen::prelude::*;

use crate::app::{SetText, TextOver, TextToSet};

#[wasm_bindgen]
extern "C" {
    /// An object of the class of this name in web/texts.js.
    #[derive(Clone)]
    pub type Texts;
    #[wasm_bindgen(method, catch)]
    fn show(this: &Texts, texts: &str) -> Result<Vec<f32>, JsValue>;
    #[wasm_bindgen(method, catch)]
    fn set(
        this: &Texts,
        text: &str,
        letters_px: f32,
        is_strong: bool,
        widest_px: f32,
        rows: u32,
    ) -> Result<Letters, JsValue>;

    type Letters;
    #[wasm_bindgen(method, getter)]
    fn width(this: &Letters) -> u32;
    #[wasm_bindgen(method, getter)]
    fn height(this: &Letters) -> u32;
    #[wasm_bindgen(method, getter)]
    fn coverage(this: &Letters) -> Vec<u8>;
}

/// Shows texts over the canvas; returns the size of each, points. `zoom`: CSS pixels of a point.
pub(super) fn shown(page: &Texts, texts: &[TextOver], zoom: f32) -> Vec<Vec2> {
    let listed = texts.iter().map(|text| {
        json!({
            "caption": text.caption,
            "text": text.text,
            "at": text.at.map(|at| [at.x * zoom, at.y * zoom]),
            "widest": text.widest * zoom,
            "letters": text.letters * zoom,
            "light": text.is_light,
            "faded": text.is_faded,
        })
    });
    let listed = serde_json::Value::Array(listed.collect());
    let sizes = page.show(&listed.to_string()).unwrap_or_default();
    let sizes = sizes.chunks_exact(2);
    sizes.map(|size| vec2(size[0], size[1]) / zoom).collect()
}

/// The letters of a text as the browser shapes them; `None` where it does not.
pub(super) fn set(page: &Texts, text: &TextToSet) -> Option<SetText> {
    let rows = u32::try_from(text.rows).unwrap_or(u32::MAX);
    let (px, widest) = (text.letters_px, text.widest_px);
    let letters = page.set(&text.text, px, text.is_strong, widest, rows);
    let letters = letters.ok()?;
    let (size, coverage) = ([letters.width(), letters.height()], letters.coverage());
    let is_whole = u64::from(size[0]) * u64::from(size[1]) == coverage.len() as u64;
    is_whole.then_some(SetText { size, coverage })
}
