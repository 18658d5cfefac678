//! Rules of style, and the elements that they are for: measured before usvg goes through them, as it does so for every
//! element with every rule.

use std::cell::Cell;

use simplecss::{AttributeOperator, Element, PseudoClass, Rule, StyleSheet};
use usvg::roxmltree::{Document, Node};

use super::error::SvgError;

/// Bytes times declarations at most, of all texts of style: each declaration counts the lines before it anew.
const MOST_READING: u64 = 2_000_000_000;
/// Commas times declarations at most: the declarations are copied for each selector before a comma.
const MOST_COPIES: u64 = 10_000_000;
/// Texts of style times selectors at most: all are put in order again after each text.
const MOST_SORTING: u64 = 20_000_000;
/// Steps at most in which rules find their elements: a second or two.
pub(super) const MOST_STEPS: u64 = 128 << 20;
/// Elements at most that one selector looks at, each seen from the one before.
const MOST_IN_A_ROW: u32 = 256;
/// Steps in which a declaration replaces those of the same name.
const STEPS_OF_DECLARATION: u64 = 20;

/// The rules of all texts of style, and what is left of the steps.
pub(super) struct Styles<'a> {
    rules: Vec<Rule<'a>>,
    budget: Budget,
}

impl<'a> Styles<'a> {
    /// Reads the rules as usvg does.
    ///
    /// # Errors
    /// [`SvgError::Styles`].
    pub(super) fn read(document: &'a Document<'_>) -> Result<Self, SvgError> {
        let mut reading = 0_u64;
        let mut add_reading = |text: &str| {
            let declarations = count(text, b':') + count(text, b'{') + count(text, b'}');
            reading = reading.saturating_add((text.len() as u64).saturating_mul(declarations));
        };
        let elements = || document.descendants().filter(Node::is_element);
        elements()
            .filter_map(|node| node.attribute("style"))
            .for_each(&mut add_reading);
        let texts: Vec<&str> = elements()
            .filter(|node| node.tag_name().name() == "style")
            .filter_map(|node| node.text())
            .collect();
        texts.iter().copied().for_each(&mut add_reading);
        let all = |byte: u8| texts.iter().map(|text| count(text, byte)).sum::<u64>();
        let (commas, declarations) = (all(b','), all(b':'));
        let sorting = (texts.len() as u64).saturating_mul(commas + all(b'{'));
        let copies = commas.saturating_mul(declarations);
        if reading > MOST_READING || copies > MOST_COPIES || sorting > MOST_SORTING {
            return Err(SvgError::Styles);
        }
        let mut sheet = StyleSheet::new();
        texts.iter().for_each(|text| sheet.parse_more(text));
        Ok(Self {
            rules: sheet.rules,
            budget: Budget::default(),
        })
    }

    /// Hands over name and value of each declaration that is for an element. Says how many steps it took.
    ///
    /// # Errors
    /// [`SvgError::Styles`].
    pub(super) fn find(
        &self,
        node: Node<'a, '_>,
        mut declared: impl FnMut(&'a str, &'a str),
    ) -> Result<u64, SvgError> {
        let before = self.budget.used.get();
        let element = Counted {
            node,
            budget: &self.budget,
            row: 0,
        };
        for rule in &self.rules {
            self.budget.take(1);
            if rule.selector.matches(&element) {
                self.budget
                    .take(STEPS_OF_DECLARATION * rule.declarations.len() as u64);
                rule.declarations
                    .iter()
                    .for_each(|declaration| declared(declaration.name, declaration.value));
            }
            if self.budget.is_used_up() {
                return Err(SvgError::Styles);
            }
        }
        Ok(self.budget.used.get() - before)
    }
}

fn count(text: &str, byte: u8) -> u64 {
    text.bytes().filter(|found| *found == byte).count() as u64
}

#[derive(Default)]
struct Budget {
    used: Cell<u64>,
}

impl Budget {
    fn take(&self, steps: u64) {
        self.used.set(self.used.get().saturating_add(steps));
    }

    fn is_used_up(&self) -> bool {
        self.used.get() > MOST_STEPS
    }
}

/// An element that counts what selectors ask. Once the steps are used up it says no to all, so that what asks ends.
struct Counted<'a, 'input, 'b> {
    node: Node<'a, 'input>,
    budget: &'b Budget,
    /// Elements before it from which it is seen.
    row: u32,
}

impl<'a, 'input> Counted<'a, 'input, '_> {
    /// The element that is seen next from this one.
    fn next(&self, node: Option<Node<'a, 'input>>) -> Option<Self> {
        self.budget.take(1);
        if self.row >= MOST_IN_A_ROW {
            self.budget.take(MOST_STEPS);
        }
        let node = node.filter(|_| !self.budget.is_used_up())?;
        Some(Self {
            node,
            row: self.row + 1,
            ..*self
        })
    }
}

impl Element for Counted<'_, '_, '_> {
    fn parent_element(&self) -> Option<Self> {
        self.next(self.node.parent_element())
    }

    fn prev_sibling_element(&self) -> Option<Self> {
        // Texts and comments in between are passed over.
        let mut before = self.node.prev_sibling();
        while let Some(node) = before.filter(|node| !node.is_element()) {
            self.budget.take(1);
            before = node.prev_sibling();
        }
        self.next(before)
    }

    fn has_local_name(&self, name: &str) -> bool {
        !self.budget.is_used_up() && self.node.tag_name().name() == name
    }

    fn attribute_matches(&self, local_name: &str, operator: AttributeOperator<'_>) -> bool {
        self.budget
            .take(1 + self.node.attributes().len() as u64 / 4);
        self.node.attribute(local_name).is_some_and(|value| {
            self.budget.take(value.len() as u64 / 16);
            !self.budget.is_used_up() && operator.matches(value)
        })
    }

    fn pseudo_class_matches(&self, class: PseudoClass<'_>) -> bool {
        match class {
            PseudoClass::FirstChild => self.prev_sibling_element().is_none(),
            _ => false,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn steps(style: &str, inner: &str) -> Result<u64, SvgError> {
        let text = format!("<svg><style>{style}</style>{inner}</svg>");
        let document = Document::parse(&text).expect("XML");
        let styles = Styles::read(&document)?;
        let elements = document.descendants().filter(Node::is_element);
        elements.map(|node| styles.find(node, |_, _| {})).sum()
    }

    #[test]
    fn rules_reach_the_elements_that_their_selectors_name() {
        let style =
            "/* a { } */ .a, #b > path { fill: url(#p) } g path:first-child { marker: url('#m') }";
        let text = format!(
            "<svg><style>{style}</style><g id=\"b\"><path/><path/></g><path class=\"c a\"/><path/></svg>"
        );
        let document = Document::parse(&text).expect("XML");
        let styles = Styles::read(&document).expect("rules");
        let of = |node: Node<'_, '_>| {
            let mut found = Vec::new();
            styles
                .find(node, |name, value| found.push(format!("{name} {value}")))
                .expect("few steps");
            found.join(", ")
        };
        let paths = document
            .descendants()
            .filter(|node| node.has_tag_name("path"));
        let found: Vec<String> = paths.map(of).collect();
        let fill = "fill url(#p)";
        let both = format!("marker url('#m'), {fill}");
        assert_eq!(found, [both.as_str(), fill, fill, ""]);
    }

    #[test]
    fn what_takes_minutes_is_refused() {
        let shapes = "<path class=\"a\" d=\"M0 0h1v1z\"/>".repeat(50_000);
        let nested = format!("{}{}", "<g>".repeat(50), "</g>".repeat(50));
        let long_row = "<path/>".repeat(1000);
        let many_styles = "a{b:c}</style><style>".repeat(20_000);
        for (style, inner, what) in [
            (
                &*"path{fill:url(#a)}".repeat(10_000),
                &*shapes,
                "rules times elements",
            ),
            (&*"x,".repeat(20_000), "", "declared for nothing"),
            (
                &*format!("{}x{{{}}}", "x,".repeat(20_000), "a:b;".repeat(20_000)),
                "",
                "selectors times declarations",
            ),
            (&*"a{b:c}".repeat(100_000), "", "one line of declarations"),
            (&*many_styles, "", "texts"),
            (
                &*format!("{} b{{c:d}}", "g ".repeat(25)),
                &*nested,
                "none of them at all",
            ),
            (
                &*format!("{}g{{c:d}}", "g ".repeat(25)),
                &*nested,
                "found at once",
            ),
            (
                &*format!("b {}g{{c:d}}", "g ".repeat(25)),
                &*nested,
                "groups in groups",
            ),
            (
                &*format!("{}*{{c:d}}", "*+".repeat(900)),
                &*long_row,
                "one after the other",
            ),
            (
                "a{b:c}",
                &*format!("<path style=\"{}\"/>", "a:b;".repeat(100_000)),
                "a long attribute",
            ),
        ] {
            let found = steps(style, inner);
            match what {
                "declared for nothing" | "none of them at all" | "found at once" => {
                    assert!(found.is_ok(), "{what}: {found:?}");
                }
                _ => assert_eq!(found, Err(SvgError::Styles), "{what}"),
            }
        }
    }
}
