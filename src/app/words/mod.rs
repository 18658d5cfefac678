//! Every text of the interface, in every language that it has. A table per panel; a line of it holds one text in all
//! languages, so that none can be forgotten: a line with a language missing does not compile.
//!
//! Panels write `w().heading` with the `w` of their table. The language is the program's, not the document's: `lang`
//! of a document names the language of its own texts and changes nothing here.
//!
//! A new language is a variant of [`Lang`] and one more column; texts hold `{0}`, `{1}` where [`fill`] puts words and
//! numbers, in the order that the language wants.
//!
//! # Glossary
//!
#![doc = include_str!("glossary.md")]

use std::cell::Cell;

/// A table: its name, then a line per text: key, English, German, Spanish, Chinese.
macro_rules! words {
    ($(#[$meta:meta])* $name:ident { $($key:ident: $en:literal, $de:literal, $es:literal, $zh:literal;)* }) => {
        $(#[$meta])*
        pub(crate) struct $name { $(pub(crate) $key: &'static str),* }

        static TABLES: [$name; crate::app::words::Lang::COUNT] = [
            $name { $($key: $en),* }, $name { $($key: $de),* }, $name { $($key: $es),* }, $name { $($key: $zh),* },
        ];

        /// The texts of this table in the language of the interface.
        pub(crate) fn w() -> &'static $name {
            &TABLES[crate::app::words::lang().column()]
        }

        /// Every line, for the tests of all tables.
        #[cfg(test)]
        pub(super) const LINES: &[(&str, [&str; crate::app::words::Lang::COUNT])] = &[$((stringify!($key), [$en, $de, $es, $zh])),*];
    };
}

pub(crate) mod authoring;
pub(crate) mod bar;
pub(crate) mod bodies;
pub(crate) mod captions;
pub(crate) mod catalogue;
pub(crate) mod clay;
pub(crate) mod controls;
pub(crate) mod curve;
pub(crate) mod facts;
pub(crate) mod faults;
pub(crate) mod figure;
pub(crate) mod files;
pub(crate) mod kept;
pub(crate) mod keys;
pub(crate) mod kinds;
pub(crate) mod library;
pub(crate) mod light;
pub(crate) mod look;
pub(crate) mod messages;
pub(crate) mod names;
pub(crate) mod objects;
pub(crate) mod picture;
pub(crate) mod points;
pub(crate) mod search;
pub(crate) mod share;
pub(crate) mod slices;
pub(crate) mod steps;
pub(crate) mod style;
pub(crate) mod sweep;
pub(crate) mod templates;
#[cfg(test)]
mod tests;
pub(crate) mod text;
pub(crate) mod tissue;
pub(crate) mod transfer;

/// A language of the interface.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Lang {
    /// Language tag `en`.
    #[default]
    English,
    /// Language tag `de`.
    German,
    /// Language tag `es`.
    Spanish,
    /// zh, in simplified characters
    Chinese,
    /// English set from right to left: shows what a language of such a script would find. Never offered, only asked
    /// for by its tag.
    Mirrored,
}

impl Lang {
    /// Columns of the tables.
    pub(crate) const COUNT: usize = 4;

    /// The languages that the user can choose.
    pub(crate) const OFFERED: [Self; Self::COUNT] =
        [Self::English, Self::German, Self::Spanish, Self::Chinese];

    /// Name of the language in that language.
    pub(crate) fn own_name(self) -> &'static str {
        match self {
            Self::English => "English",
            Self::German => "Deutsch",
            Self::Spanish => "Español",
            Self::Chinese => "简体中文",
            Self::Mirrored => "Mirrored",
        }
    }

    /// Name of the language in letters that every font of the program has.
    pub(crate) fn plain_name(self) -> &'static str {
        match self {
            Self::Chinese => "Chinese",
            Self::Spanish | Self::German | Self::English | Self::Mirrored => self.own_name(),
        }
    }

    /// Language tag (BCP 47) under which it is kept.
    pub(crate) fn tag(self) -> &'static str {
        match self {
            Self::English => "en",
            Self::German => "de",
            Self::Spanish => "es",
            Self::Chinese => "zh",
            Self::Mirrored => "qps-plocm",
        }
    }

    /// The one that a tag such as `de-AT`, or a name as in `LANG` (`de_AT.UTF-8`), asks for.
    pub(crate) fn from_tag(tag: &str) -> Option<Self> {
        if tag.eq_ignore_ascii_case(Self::Mirrored.tag()) {
            return Some(Self::Mirrored);
        }
        let primary = tag.split(['-', '_', '.', '@']).next().unwrap_or_default();
        Self::OFFERED
            .into_iter()
            .find(|lang| primary.eq_ignore_ascii_case(lang.tag()))
    }

    /// The first of the wanted ones that is spoken, else English.
    pub(crate) fn best(wanted: impl IntoIterator<Item = String>) -> Self {
        wanted
            .into_iter()
            .find_map(|tag| Self::from_tag(&tag))
            .unwrap_or_default()
    }

    /// Lines begin at the right, and panels change sides.
    pub(crate) fn is_rtl(self) -> bool {
        self == Self::Mirrored
    }

    /// The sign between a number's whole part and its fraction.
    fn decimal(self) -> char {
        match self {
            Self::German | Self::Spanish => ',',
            Self::English | Self::Chinese | Self::Mirrored => '.',
        }
    }

    /// The language that pictures are described in.
    pub(crate) fn of_descriptions(self) -> crate::describe::Lang {
        use crate::describe::Lang as Told;
        match self {
            Self::English | Self::Mirrored => Told::English,
            Self::German => Told::German,
            Self::Spanish => Told::Spanish,
            Self::Chinese => Told::Chinese,
        }
    }

    fn column(self) -> usize {
        match self {
            Self::English | Self::Mirrored => 0,
            Self::German => 1,
            Self::Spanish => 2,
            Self::Chinese => 3,
        }
    }
}

/// Under which the language is kept.
pub(crate) const STORED_LANGUAGE: &str = "language";

thread_local! {
    /// The interface lives on one thread; every viewer on it speaks the same language, as one reader looks at them all.
    static LANG: Cell<Lang> = const { Cell::new(Lang::English) };
}

/// The language of the interface.
pub(crate) fn lang() -> Lang {
    LANG.get()
}

/// Makes it the language of the interface.
pub(crate) fn set_lang(lang: Lang) {
    LANG.set(lang);
}

/// True if lines begin at the right.
pub(crate) fn is_rtl() -> bool {
    lang().is_rtl()
}

/// The text of the interface's language out of one line.
pub(crate) fn of(line: [&'static str; Lang::COUNT]) -> &'static str {
    line[lang().column()]
}

/// A text with `{0}`, `{1}` … replaced by values. Braces in a value are not replaced again.
pub(crate) fn fill(text: &str, values: &[&dyn std::fmt::Display]) -> String {
    let mut filled = String::with_capacity(text.len() + 16);
    let mut rest = text;
    while let Some((before, after)) = rest.split_once('{') {
        filled.push_str(before);
        let value = after
            .split_once('}')
            .and_then(|(index, tail)| Some((values.get(index.parse::<usize>().ok()?)?, tail)));
        match value {
            Some((value, tail)) => {
                filled.push_str(&value.to_string());
                rest = tail;
            }
            None => {
                filled.push('{');
                rest = after;
            }
        }
    }
    filled.push_str(rest);
    filled
}

/// A number as it was formatted with a point, with the decimal sign of the language.
pub(crate) fn localized(number: String) -> String {
    match lang().decimal() {
        '.' => number,
        sign => number.replace('.', &sign.to_string()),
    }
}

/// A number as typed in any of the languages.
pub(crate) fn parse_number(text: &str) -> Option<f64> {
    let text: String = text
        .trim()
        .chars()
        .map(|c| match c {
            ',' => '.',
            '\u{2212}' => '-',
            c => c,
        })
        .filter(|c| !c.is_whitespace() && *c != '°' && *c != '%')
        .collect();
    text.parse().ok().filter(|number: &f64| number.is_finite())
}

/// A name within a sentence: where nouns have no capitals, without its own.
pub(crate) fn in_sentence(name: &str) -> String {
    match lang() {
        Lang::English | Lang::Spanish | Lang::Mirrored => name.to_lowercase(),
        Lang::German | Lang::Chinese => name.to_owned(),
    }
}

/// The word with its first letter in upper case: `progress` to `Progress`.
pub(crate) fn capitalized(word: &str) -> String {
    let mut letters = word.chars();
    match letters.next() {
        Some(first) => first.to_uppercase().chain(letters).collect(),
        None => String::new(),
    }
}
