use std::collections::BTreeMap;

use usvg::roxmltree::{Document, Node};

use super::error::SvgError;

/// Bytes of a text at most, when its entities are put in.
const MAX_TEXT: u64 = 16 << 20;
/// Weight of a drawing at most, when what is used is put in wherever it is used.
const MAX_WEIGHT: u64 = 32 << 20;
/// Weights of elements, about in step with the memory that they take; a byte of a path weighs 1.
const OF_ELEMENT: u64 = 100;
const OF_STOP: u64 = 8;
/// Elements that use each other in a row, at most; groups within them count.
const MAX_DEPTH: usize = 512;

/// Measures what entities become before any is put in: a few kilobytes of them can stand for terabytes.
pub(super) fn check_entities(text: &str) -> Result<(), SvgError> {
    let mut entities = Entities::default();
    let mut body = text;
    for declaration in text.split("<!ENTITY").skip(1) {
        if let Some((name, value, rest)) = declared(declaration) {
            // The first declaration of a name counts.
            entities.value_of.entry(name).or_insert(value);
            body = rest;
        }
    }
    if entities.value_of.is_empty() {
        return Ok(());
    }
    match entities.length(body, 0)? {
        ..=MAX_TEXT => Ok(()),
        _ => Err(SvgError::Entities),
    }
}

/// Name and value of a declared entity, and what follows; none of one that stands for a file.
fn declared(declaration: &str) -> Option<(&str, &str, &str)> {
    let (name, rest) = declaration.trim_start().split_once(char::is_whitespace)?;
    let rest = rest.trim_start();
    let quote = rest.chars().next().filter(|c| matches!(c, '"' | '\''))?;
    let (value, rest) = rest[1..].split_once(quote)?;
    Some((name, value, rest))
}

#[derive(Default)]
struct Entities<'a> {
    value_of: BTreeMap<&'a str, &'a str>,
    length_of: BTreeMap<&'a str, u64>,
}

impl<'a> Entities<'a> {
    /// Bytes of a text with its entities put in. Those that stand for each other are left to the parser, which finds
    /// the circle.
    fn length(&mut self, text: &'a str, depth: usize) -> Result<u64, SvgError> {
        if depth > MAX_DEPTH {
            return Err(SvgError::Entities);
        }
        let mut length = text.len() as u64;
        for after in text.split('&').skip(1) {
            let Some((name, _)) = after.split_once(';') else {
                continue;
            };
            let known = self.length_of.get(name).copied();
            let of_one = match (known, self.value_of.get(name).copied()) {
                (Some(known), _) => known,
                (None, None) => continue,
                (None, Some(value)) => {
                    self.length_of.insert(name, 0);
                    let found = self.length(value, depth + 1)?;
                    self.length_of.insert(name, found);
                    found
                }
            };
            length = length.saturating_add(of_one);
        }
        Ok(length)
    }
}

/// Measures what a drawing becomes when all that is used, marked, clipped or patterned by an element is put in there.
pub(super) fn check_weight(document: &Document<'_>) -> Result<(), SvgError> {
    let mut weights = Weights {
        element_of: BTreeMap::new(),
        used_by: BTreeMap::new(),
        weight_of: BTreeMap::new(),
    };
    for node in document.descendants().filter(Node::is_element) {
        if let Some(id) = node.attribute("id") {
            weights.element_of.entry(id).or_insert(node);
        }
        if node.tag_name().name() == "style" {
            let texts = node.descendants().filter(Node::is_text);
            texts
                .filter_map(|text| text.text())
                .for_each(|text| weights.add_rules(text));
        }
    }
    match weights.weight(document.root_element(), 0)? {
        ..=MAX_WEIGHT => Ok(()),
        _ => Err(SvgError::Repeats),
    }
}

/// An element that another one takes in, and whether that is done at each of its points.
#[derive(Clone, Copy)]
struct Use<'a> {
    id: &'a str,
    is_at_points: bool,
}

struct Weights<'a, 'input> {
    element_of: BTreeMap<&'a str, Node<'a, 'input>>,
    /// What rules of a style take in, by the classes, ids and names of elements in their selectors.
    used_by: BTreeMap<&'a str, Vec<Use<'a>>>,
    /// By the number of the element.
    weight_of: BTreeMap<u32, u64>,
}

impl<'a, 'input> Weights<'a, 'input> {
    fn add_rules(&mut self, style: &'a str) {
        for rule in style.split('}') {
            let Some((selectors, body)) = rule.split_once('{') else {
                continue;
            };
            let used: Vec<Use<'a>> = body.split(';').flat_map(uses).collect();
            if used.is_empty() {
                continue;
            }
            let is_name = |c: char| c.is_alphanumeric() || matches!(c, '-' | '_' | '*');
            for name in selectors
                .split(|c| !is_name(c))
                .filter(|name| !name.is_empty())
            {
                self.used_by.entry(name).or_default().extend(&used);
            }
        }
    }

    /// What an element weighs with all that it takes in.
    fn weight(&mut self, node: Node<'a, 'input>, depth: usize) -> Result<u64, SvgError> {
        if let Some(known) = self.weight_of.get(&node.id().get()) {
            return Ok(*known);
        }
        if depth > MAX_DEPTH {
            return Err(SvgError::Uses);
        }
        // What takes itself in is left to the parser, which finds the circle.
        self.weight_of.insert(node.id().get(), 0);
        let of_points = |key| node.attribute(key).map_or(0, |text| text.len() as u64);
        let of_points = of_points("d") + of_points("points");
        let mut weight = match node.tag_name().name() {
            "stop" => OF_STOP,
            "linearGradient" | "radialGradient" => 0,
            _ => OF_ELEMENT + of_points,
        };
        for used in self.used(node) {
            let Some(target) = self.element_of.get(used.id).copied() else {
                continue;
            };
            let times = match used.is_at_points {
                true => 2 + of_points / 2,
                false => 1,
            };
            let one = self.weight(target, depth + 1)?;
            weight = weight.saturating_add(one.saturating_mul(times));
        }
        for child in node.children().filter(Node::is_element) {
            weight = weight.saturating_add(self.weight(child, depth + 1)?);
        }
        self.weight_of.insert(node.id().get(), weight);
        Ok(weight)
    }

    fn used(&self, node: Node<'a, 'input>) -> Vec<Use<'a>> {
        let mut used = Vec::new();
        for attribute in node.attributes() {
            match (attribute.name(), attribute.value()) {
                ("href", target) => used.extend(target.strip_prefix('#').map(|id| Use {
                    id,
                    is_at_points: false,
                })),
                ("style", body) => used.extend(body.split(';').flat_map(uses)),
                (name, value) => used.extend(uses(value).map(|found| Use {
                    is_at_points: name.starts_with("marker"),
                    ..found
                })),
            }
        }
        if !self.used_by.is_empty() {
            let classes = node.attribute("class").unwrap_or_default();
            let names = classes.split_whitespace();
            let names = names.chain(node.attribute("id"));
            let names = names.chain([node.tag_name().name(), "*"]);
            used.extend(names.filter_map(|name| self.used_by.get(name)).flatten());
        }
        used
    }
}

/// The elements that a property of a style takes in.
fn uses(property: &str) -> impl Iterator<Item = Use<'_>> {
    let is_at_points = property.trim_start().starts_with("marker");
    let targets = property.split("url(").skip(1).filter_map(|target| {
        let inner = target.split(')').next()?.trim();
        inner.trim_matches(['"', '\'']).strip_prefix('#')
    });
    targets.map(move |id| Use { id, is_at_points })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn weight(inner: &str) -> Result<(), SvgError> {
        let text = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\">{inner}</svg>"
        );
        check_weight(&Document::parse(&text).expect("XML"))
    }

    #[test]
    fn what_is_used_counts_as_often_as_it_is_used() {
        let long = format!(
            "<path id=\"p\" class=\"k\" d=\"M0 0{}\"/>",
            "h1v1".repeat(10_000)
        );
        assert_eq!(weight(&long), Ok(()), "once");
        let twice = format!("{long}<use xlink:href=\"#p\"/><use href=\"#p\"/>");
        assert_eq!(weight(&twice), Ok(()), "three times");
        let many = format!("{long}{}", "<use href=\"#p\"/>".repeat(1000));
        assert_eq!(weight(&many), Err(SvgError::Repeats), "40 MB");
        for marked in [
            "marker-mid=\"url(#m)\"",
            "style=\"fill:red; marker:url('#m')\"",
            "class=\"mark\"",
        ] {
            let style =
                "<style>.a, .mark { fill: red; marker-mid: url(#m) } .k { fill: url(#g) }</style>";
            let marker = format!(
                "<marker id=\"m\">{}</marker>",
                "<path d=\"M0 0h9v9z\"/>".repeat(200)
            );
            let line = format!("<path {marked} d=\"M0 0{}\"/>", "h1v1".repeat(1000));
            let inner = format!("{style}{marker}{line}");
            assert_eq!(weight(&inner), Err(SvgError::Repeats), "{marked}");
            assert_eq!(weight(&inner.replace("url(", "uri(")), Ok(()), "no marker");
        }
        // As drawing programs write them: a class of their own for each of many gradients.
        let mut drawn = String::from("<style>");
        for i in 0..300 {
            drawn += &format!(".c{i}{{fill:url(#g{i})}}");
        }
        drawn += "</style>";
        for i in 0..300 {
            drawn += &format!(
                "<linearGradient id=\"g{i}\">{}</linearGradient>",
                "<stop/>".repeat(5)
            );
        }
        for i in 0..60_000 {
            drawn += &format!("<path class=\"c{}\" d=\"M0 0h9v9z\"/>", i % 300);
        }
        assert_eq!(weight(&drawn), Ok(()), "gradients");
        let chain: String = (0..2000)
            .map(|i| format!("<g id=\"a{i}\"><use href=\"#a{}\"/></g>", i + 1))
            .collect();
        assert_eq!(weight(&chain), Err(SvgError::Uses), "too many in a row");
        assert_eq!(
            weight("<g id=\"a\"><use href=\"#a\"/></g>"),
            Ok(()),
            "the parser finds it"
        );
    }

    #[test]
    fn entities_are_measured_before_they_are_put_in() {
        let with = |declared: &str, body: &str| {
            check_entities(&format!("<!DOCTYPE svg [{declared}]><svg>{body}</svg>"))
        };
        let long = format!("<!ENTITY a \"{}\">", "x".repeat(10_000));
        assert_eq!(with(&long, "&a; &amp; &#32; &b;"), Ok(()));
        assert_eq!(
            with(&long, &"&a;".repeat(2000)),
            Err(SvgError::Entities),
            "20 MB"
        );
        let mut nested = "<!ENTITY a0 'x'>".to_owned();
        for i in 1..12 {
            nested += &format!("<!ENTITY a{i} '{}'>", format!("&a{};", i - 1).repeat(10));
        }
        assert_eq!(
            with(&nested, "&a11;"),
            Err(SvgError::Entities),
            "10 to the 11"
        );
        assert_eq!(with(&nested, "&a4;"), Ok(()), "10 to the 4");
        assert_eq!(
            with("<!ENTITY a '&b;'><!ENTITY b '&a;'>", "&a;"),
            Ok(()),
            "the parser finds it"
        );
        assert_eq!(
            with(
                "<!ENTITY % a 'x'><!ENTITY b SYSTEM 'file:///'> <!ENTITY",
                "&b;&"
            ),
            Ok(())
        );
    }
}
