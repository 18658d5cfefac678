//! The languages that pictures are described in, and how texts are put together in each.

use std::fmt::Display;

/// A language of a description. The same as those of the editor (`app::words`).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Lang {
    /// Language tag `en`.
    #[default]
    English,
    /// Language tag `de`.
    German,
    /// Language tag `es`.
    Spanish,
    /// Language tag `zh`, in simplified characters.
    Chinese,
}

/// A text in every language, in the order of [`Lang::ALL`].
pub type Line = [&'static str; Lang::ALL.len()];

impl Lang {
    /// All languages, in the order of the columns of a [`Line`].
    pub const ALL: [Self; 4] = [Self::English, Self::German, Self::Spanish, Self::Chinese];

    /// Language tag (BCP 47).
    pub fn tag(self) -> &'static str {
        self.of(["en", "de", "es", "zh"])
    }

    /// The language that a tag such as `de-AT` asks for; `None` if there is no text in it.
    pub fn from_tag(tag: &str) -> Option<Self> {
        let primary = tag.split(['-', '_']).next().unwrap_or_default();
        let mut all = Self::ALL.into_iter();
        all.find(|lang| primary.eq_ignore_ascii_case(lang.tag()))
    }

    /// The text of this language.
    pub(crate) fn of(self, line: Line) -> &'static str {
        line[self as usize]
    }

    /// A line with `{0}`, `{1}` … replaced by values; braces in a value are not replaced again.
    pub(super) fn fill(self, line: Line, values: &[&dyn Display]) -> String {
        let mut filled = String::new();
        let mut rest = self.of(line);
        while let Some((before, after)) = rest.split_once('{') {
            filled.push_str(before);
            let (index, tail) = after.split_once('}').unwrap_or((after, ""));
            if let Some(value) = index.parse().ok().and_then(|i: usize| values.get(i)) {
                filled.push_str(&value.to_string());
            }
            rest = tail;
        }
        filled.push_str(rest);
        filled
    }

    /// Entries one after the other.
    pub(super) fn list(self, entries: &[String]) -> String {
        entries.join(self.of([", ", ", ", ", ", "、"]))
    }

    /// Sentences one after the other, each with its end; one that ends by itself keeps its end.
    pub(super) fn sentences(self, sentences: &[String]) -> String {
        let mut text = String::new();
        for sentence in sentences.iter().map(|sentence| sentence.trim()) {
            if sentence.is_empty() {
                continue;
            }
            if !text.is_empty() {
                text.push_str(self.of([" ", " ", " ", ""]));
            }
            text.push_str(sentence);
            let ends = ['.', '!', '?', '…', '。', '！', '？', ':', '：'];
            // A quotation mark or a bracket may follow the end of a sentence.
            let last = sentence.trim_end_matches(['"', '”', '“', '»', ')', '）']);
            if !last.ends_with(ends) {
                text.push_str(self.of([".", ".", ".", "。"]));
            }
        }
        text
    }

    /// A share of 1 in whole percent: `42 %`.
    pub(super) fn percent(self, share: f32) -> String {
        let whole = (share * 100.0).round();
        self.fill(["{0} %", "{0} %", "{0} %", "{0}%"], &[&whole])
    }

    /// A number with one digit behind the sign where it is below 10.
    pub(super) fn number(self, value: f64) -> String {
        if value.abs() >= 9.95 {
            return format!("{value:.0}");
        }
        let text = format!("{value:.1}");
        let text = text.strip_suffix(".0").unwrap_or(&text);
        text.replace('.', self.of([".", ",", ",", "."]))
    }
}

/// A text of an author as part of a sentence: one line without control characters, cut where it is too long.
pub(super) fn one_line(text: &str, most: usize) -> String {
    let mut line = String::new();
    for word in text.split(|c: char| c.is_whitespace() || c.is_control()) {
        if !word.is_empty() && !line.is_empty() {
            line.push(' ');
        }
        line.push_str(word);
    }
    if let Some((end, _)) = line.char_indices().nth(most) {
        line.truncate(end);
        line.push('…');
    }
    line
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tags_ask_for_their_language() {
        for lang in Lang::ALL {
            assert_eq!(Lang::from_tag(lang.tag()), Some(lang));
        }
        assert_eq!(Lang::from_tag("de-AT"), Some(Lang::German));
        assert_eq!(Lang::from_tag("ZH_Hans"), Some(Lang::Chinese));
        for unknown in ["", "fr", "deutsch", "e"] {
            assert_eq!(Lang::from_tag(unknown), None, "{unknown}");
        }
    }

    #[test]
    fn sentences_end_once() {
        let all = ["Open?", "", "  a ", "He said “no.”", "(b)"].map(str::to_owned);
        assert_eq!(Lang::English.sentences(&all), "Open? a. He said “no.” (b).");
        assert_eq!(Lang::Chinese.sentences(&all[..3]), "Open?a。");
    }

    #[test]
    fn an_authors_text_is_one_line_and_not_endless() {
        assert_eq!(one_line(" a\n\n\tb\u{1b}[2J\u{0} ", 99), "a b [2J");
        assert_eq!(one_line("äöüß", 3), "äöü…");
        assert_eq!(one_line("äöü", 3), "äöü");
    }

    #[test]
    fn numbers_are_written_as_the_language_does() {
        assert_eq!(Lang::German.number(3.21), "3,2");
        assert_eq!(Lang::English.number(3.04), "3");
        assert_eq!(Lang::English.number(99.6), "100");
        assert_eq!(Lang::Chinese.percent(0.426), "43%");
    }

    #[test]
    fn gaps_are_filled_once() {
        let line = ["{1} of {0}", "{1} von {0}", "{1} de {0}", "{0} 的 {1}"];
        assert_eq!(Lang::English.fill(line, &[&2, &"{0}"]), "{0} of 2");
    }
}
