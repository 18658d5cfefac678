use std::collections::BTreeMap;

use usvg::roxmltree::{Document, Node};

use super::error::SvgError;
use super::styles::{MOST_STEPS, Styles};

/// Bytes of a text at most, when its entities are put in.
const MAX_TEXT: u64 = 16 << 20;
/// Weight of a drawing at most, when what is used is put in wherever it is used.
const MAX_WEIGHT: u64 = 32 << 20;
/// Weights of elements, about in step with the memory that they take; a byte of a path weighs 1.
const OF_ELEMENT: u64 = 100;
const OF_STOP: u64 = 8;
/// Elements that use each other in a row, at most; groups within them count.
const MAX_DEPTH: usize = 512;
/// Elements that take themselves in, at most. The parser mends one after the other, each time from the start.
const MAX_CIRCLES: usize = 64;

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

/// Measures what a drawing becomes when all that is used, marked, clipped or patterned by an element is put in there,
/// and how long rules of style take to find their elements.
pub(super) fn check_weight(document: &Document<'_>) -> Result<(), SvgError> {
    let mut weights = Weights {
        element_of: BTreeMap::new(),
        styles: Styles::read(document)?,
        cost_of: BTreeMap::new(),
        circles: 0,
    };
    for node in document.descendants().filter(Node::is_element) {
        if let Some(id) = node.attribute("id") {
            weights.element_of.entry(id).or_insert(node);
        }
    }
    let whole = weights.weigh(document.root_element(), 0)?;
    match whole {
        _ if whole.steps > MOST_STEPS => Err(SvgError::Styles),
        _ if whole.weight > MAX_WEIGHT => Err(SvgError::Repeats),
        _ => Ok(()),
    }
}

/// An element that another one takes in.
#[derive(Clone, Copy)]
struct Use<'a> {
    id: &'a str,
    how: Taken,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Taken {
    /// As it is: the parser goes through the rules of style once more.
    Copied,
    /// As paint, clip or mask.
    Referred,
    /// The same at each point.
    AtPoints,
}

/// What an element costs with all that it takes in.
#[derive(Clone, Copy, Default)]
struct Cost {
    /// About in step with bytes of memory.
    weight: u64,
    /// Steps in which rules of style find it.
    steps: u64,
}

impl Cost {
    fn add(&mut self, other: Self) {
        self.weight = self.weight.saturating_add(other.weight);
        self.steps = self.steps.saturating_add(other.steps);
    }
}

struct Weights<'a, 'input> {
    element_of: BTreeMap<&'a str, Node<'a, 'input>>,
    styles: Styles<'a>,
    /// By the number of the element; of one that is being weighed there is none yet.
    cost_of: BTreeMap<u32, Option<Cost>>,
    circles: usize,
}

impl<'a, 'input> Weights<'a, 'input> {
    /// What an element costs with all that it takes in.
    fn weigh(&mut self, node: Node<'a, 'input>, depth: usize) -> Result<Cost, SvgError> {
        match self.cost_of.get(&node.id().get()) {
            Some(Some(known)) => return Ok(*known),
            // What takes itself in is left to the parser, which finds the circle.
            Some(None) if self.circles < MAX_CIRCLES => {
                self.circles += 1;
                return Ok(Cost::default());
            }
            Some(None) => return Err(SvgError::Uses),
            None => {}
        }
        if depth > MAX_DEPTH {
            return Err(SvgError::Uses);
        }
        self.cost_of.insert(node.id().get(), None);
        let of_points = |key| node.attribute(key).map_or(0, |text| text.len() as u64);
        let of_points = of_points("d") + of_points("points");
        let weight = match node.tag_name().name() {
            "stop" => OF_STOP,
            "linearGradient" | "radialGradient" => 0,
            _ => OF_ELEMENT + of_points,
        };
        let (used, steps) = self.used(node)?;
        let mut cost = Cost { weight, steps };
        for used in used {
            let Some(target) = self.element_of.get(used.id).copied() else {
                continue;
            };
            let one = self.weigh(target, depth + 1)?;
            let points = match used.how {
                Taken::AtPoints => 2 + of_points / 2,
                Taken::Copied | Taken::Referred => 1,
            };
            cost.add(Cost {
                weight: one.weight.saturating_mul(points),
                steps: if used.how == Taken::Copied {
                    one.steps
                } else {
                    0
                },
            });
        }
        for child in node.children().filter(Node::is_element) {
            cost.add(self.weigh(child, depth + 1)?);
        }
        self.cost_of.insert(node.id().get(), Some(cost));
        Ok(cost)
    }

    /// What an element takes in, and the steps in which rules of style find it.
    fn used(&self, node: Node<'a, 'input>) -> Result<(Vec<Use<'a>>, u64), SvgError> {
        let mut used = Vec::new();
        for attribute in node.attributes() {
            match (attribute.name(), attribute.value()) {
                ("href", target) => used.extend(target.strip_prefix('#').map(|id| Use {
                    id,
                    how: Taken::Copied,
                })),
                ("style", body) => {
                    let declared = body.split(';').filter_map(|one| one.split_once(':'));
                    used.extend(declared.flat_map(|(name, value)| uses(name, value)));
                }
                (name, value) => used.extend(uses(name, value)),
            }
        }
        let steps = self.styles.find(node, |name, value| {
            used.extend(uses(name, value));
        })?;
        Ok((used, steps))
    }
}

/// The elements that a property takes in.
fn uses<'a>(name: &str, value: &'a str) -> impl Iterator<Item = Use<'a>> + use<'a> {
    let how = match name.trim_start().starts_with("marker") {
        true => Taken::AtPoints,
        false => Taken::Referred,
    };
    let targets = value.split("url(").skip(1).filter_map(|target| {
        let inner = target.split(')').next()?.trim();
        inner.trim_matches(['"', '\'']).strip_prefix('#')
    });
    targets.map(move |id| Use { id, how })
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
        let circles = |count: usize| -> String {
            (0..count)
                .map(|i| format!("<pattern id=\"p{i}\"><path fill=\"url(#p{i})\"/></pattern>"))
                .collect()
        };
        assert_eq!(weight(&circles(60)), Ok(()), "the parser mends them");
        assert_eq!(weight(&circles(70)), Err(SvgError::Uses), "one by one");
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
