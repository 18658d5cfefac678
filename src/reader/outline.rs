//! What a page needs to know of a document before anything is drawn.

use serde_json::{Value, json};

use crate::document::{Background, Control, ControlRange, Document, Illustration, Step};
use crate::link::{self, Link};

/// A link, a payload or a document, and its texts as JSON: `title`, `legend`, `credit`, `lang`, `steps` (each with
/// `title`, `legend`, `alt`, `seconds`), `captions` (texts), `controls` (each with `pointer`, `name` and, for a
/// number, `min`, `max`, `whole`), `step` (the one that a link asks for), `alt`, and `background` (`#rrggbb`, or null
/// where it is transparent).
///
/// # Errors
/// In words: what is wrong with the link or the document.
pub fn outline(text: &str) -> Result<(Document, Value), String> {
    let Link { document, step } = link::document_of(text)?;
    let shown = document.illustration();
    let steps: Vec<Value> = shown
        .steps
        .iter()
        .map(|step| {
            let Step {
                title,
                legend,
                alt,
                seconds,
                ..
            } = step;
            json!({ "title": title, "legend": legend, "alt": alt, "seconds": seconds })
        })
        .collect();
    let controls: Vec<Value> = shown
        .controls
        .iter()
        .map(|Control { pointer, name, range }| match range {
            ControlRange::Flag(_) => json!({ "pointer": pointer, "name": name }),
            ControlRange::Number { min, max, is_whole, .. } => {
                json!({ "pointer": pointer, "name": name, "min": min, "max": max, "whole": is_whole })
            }
        })
        .collect();
    let mut found = json!({
        "title": shown.title,
        "legend": shown.legend,
        "credit": shown.credit,
        "lang": shown.lang,
        "alt": shown.alt,
        "steps": steps,
        "controls": controls,
        "step": step.min(shown.steps.len()),
    });
    let around = texts(shown);
    for key in ["captions", "background"] {
        found[key] = around[key].clone();
    }
    Ok((document, found))
}

/// What a step can set of the texts around a picture: `title`, `legend`, `captions` (texts) and `background`
/// (`#rrggbb`, or null where it is transparent).
pub fn texts(shown: &Illustration) -> Value {
    let captions: Vec<&str> = shown.captions.iter().map(|c| c.text.trim()).collect();
    let background = match shown.look.background {
        Background::Color([r, g, b]) => Some(format!("#{r:02x}{g:02x}{b:02x}")),
        Background::None => None,
    };
    json!({
        "title": shown.title,
        "legend": shown.legend,
        "captions": captions,
        "background": background,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_are_told_as_text() {
        let text = r##"{ "fabrica": 1, "title": "<b>A</b>", "lang": "de", "labels": [{ "at": [0,0,0], "text": " Bone " }],
            "look": { "background": "#102030" }, "steps": [{ "title": "One", "caption": "Two" }] }"##;
        let (_, outline) = outline(text).expect("a document");
        assert_eq!(outline["title"], "<b>A</b>");
        assert_eq!(outline["lang"], "de");
        assert_eq!(outline["captions"], json!(["Bone"]));
        assert_eq!(outline["steps"][0]["legend"], "Two");
        assert_eq!(outline["background"], "#102030");
        assert!(super::outline("{").is_err());
    }
}
