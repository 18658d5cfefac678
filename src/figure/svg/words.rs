use std::str::FromStr as _;

use glam::{DAffine2, DMat2, DVec2, dvec2};
use svgtypes::{LengthListParser, LengthUnit, Transform, ViewBox};
use usvg::roxmltree::{Document, Node};

/// Texts of a drawing that are read, at most.
const MOST_WORDS: usize = 300;

/// A text of an SVG, which is not drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct Word {
    /// Its words, with single spaces.
    pub text: String,
    /// Where its first letter stands, units of the view box from its upper left corner, y down.
    pub at: DVec2,
}

/// The texts of a drawing of this size, in its order. Those that are placed by styles or along paths stand where their
/// element does.
pub(super) fn words(document: &Document<'_>, size: DVec2) -> Vec<Word> {
    let root = document.root_element();
    let view = root
        .attribute("viewBox")
        .and_then(|text| ViewBox::from_str(text).ok());
    let corner = view.map_or(DVec2::ZERO, |view| dvec2(view.x, view.y));
    let is_text = |node: &Node<'_, '_>| node.has_tag_name(("http://www.w3.org/2000/svg", "text"));
    let texts = document.descendants().filter(is_text);
    let word = |node: Node<'_, '_>| {
        let parts = node.descendants().filter(Node::is_text);
        let parts = parts.filter_map(|part| part.text());
        let parts: Vec<&str> = parts.flat_map(str::split_whitespace).collect();
        let at = [place(&node, "x", size.x), place(&node, "y", size.y)];
        let at = placed(&node).transform_point2(DVec2::from(at)) - corner;
        (!parts.is_empty() && at.is_finite()).then(|| Word {
            text: parts.join(" "),
            at,
        })
    };
    texts.filter_map(word).take(MOST_WORDS).collect()
}

/// A coordinate of a text, or of the first part of it that has one.
fn place(text: &Node<'_, '_>, key: &str, whole: f64) -> f64 {
    let mut given = text.descendants().filter_map(|node| node.attribute(key));
    let first = given
        .next()
        .and_then(|list| LengthListParser::from(list).next()?.ok());
    first.map_or(0.0, |length| match length.unit {
        LengthUnit::Percent => length.number / 100.0 * whole,
        _ => length.number,
    })
}

/// The map of an element and of all that it is in.
fn placed(node: &Node<'_, '_>) -> DAffine2 {
    let own = |node: Node<'_, '_>| Transform::from_str(node.attribute("transform")?).ok();
    let maps = node.ancestors().filter_map(own).map(|map| DAffine2 {
        matrix2: DMat2::from_cols(dvec2(map.a, map.b), dvec2(map.c, map.d)),
        translation: dvec2(map.e, map.f),
    });
    maps.fold(DAffine2::IDENTITY, |inner, outer| outer * inner)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_stand_where_their_first_letter_does() {
        let text = r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="10 20 200 100">
            <text x="30" y="40px">Left <tspan>ventricle</tspan></text>
            <g transform="translate(5 6)"><g transform="scale(2)"><text><tspan x="10 20" y="50%">Apex</tspan></text></g></g>
            <text transform="broken" y="1e999">Nowhere</text><text> </text></svg>"#;
        let document = Document::parse(text).expect("XML");
        let word = |text: &str, at| Word {
            text: text.to_owned(),
            at,
        };
        assert_eq!(
            words(&document, dvec2(200.0, 100.0)),
            [
                word("Left ventricle", dvec2(20.0, 20.0)),
                word("Apex", dvec2(15.0, 86.0)),
                word("Nowhere", dvec2(-10.0, -20.0)),
            ]
        );
    }
}
