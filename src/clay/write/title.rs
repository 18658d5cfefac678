//! Titles as files can hold them: on one line, and never as a word of the format.

/// Characters of a title that are written. Lines of a PLY may not be longer than 4096 bytes, also of ten bytes each.
const MAX_CHARACTERS: usize = 200;

/// Words that readers look for in remarks: the axes (`crate::load`, 3D Slicer) and colours in the header of an STL
/// (Materialise Magics).
const MEANT: [&str; 3] = ["SPACE=", "COLOR=", "MATERIAL="];

/// A title on one line: spaces for line ends and control characters, nothing that is not seen or turns text around.
pub(super) fn one_line(title: &str) -> String {
    let is_unseen = |c: &char| {
        matches!(
            c,
            '\u{ad}' | '\u{200b}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}'
        ) || matches!(c, '\u{2060}'..='\u{206f}' | '\u{feff}' | '\u{fff9}'..='\u{fffb}')
    };
    let mut line = String::new();
    for c in title.chars().filter(|c| !is_unseen(c)).take(MAX_CHARACTERS) {
        match c.is_control() || c.is_whitespace() {
            true if line.is_empty() || line.ends_with(' ') => {}
            true => line.push(' '),
            false => line.push(c),
        }
    }
    line.truncate(line.trim_end().len());
    line
}

/// A title on one line of a text that is read line by line: nothing in it is meant for a reader, and it does not go on
/// in the next line.
pub(super) fn remark(title: &str) -> String {
    let mut line = one_line(title);
    for word in MEANT {
        line = line.replace(word, &word.replace('=', ":"));
    }
    line.truncate(line.trim_end_matches(['\\', ' ']).len());
    line
}

/// The remark that begins files: who wrote them, and the title.
pub(super) fn signed(title: &str) -> String {
    match &*remark(title) {
        "" => "Fabrica".to_owned(),
        title => format!("Fabrica: {title}"),
    }
}

/// What is not ASCII as `\u{e4}`: some programs refuse the whole file, or take it for a binary one.
pub(super) fn ascii(text: &str) -> String {
    let mut plain = String::new();
    for c in text.chars() {
        match c.is_ascii() {
            true => plain.push(c),
            false => plain.extend(c.escape_unicode()),
        }
    }
    plain
}

/// The name of the mesh within a file, which is never empty.
pub(super) fn name(title: String) -> String {
    if title.is_empty() {
        "clay".to_owned()
    } else {
        title
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::clay::write::testing::{TITLES, long_title};

    #[test]
    fn titles_are_one_line_without_meaning() {
        for title in TITLES
            .iter()
            .map(|&title| title.to_owned())
            .chain([long_title()])
        {
            let line = remark(&title);
            assert!(
                !line
                    .chars()
                    .any(|c| c.is_control() || "\u{2028}\u{202e}\u{feff}".contains(c)),
                "{line}"
            );
            assert!(
                !line.contains("SPACE=") && !line.contains("COLOR="),
                "{line}"
            );
            assert!(
                !line.ends_with(['\\', ' ']) && !line.starts_with(' '),
                "{line}"
            );
            assert!(
                ascii(&line).is_ascii() && ascii(&line).len() < 4000,
                "{line}"
            );
            assert!(signed(&title).starts_with("Fabrica"), "{line}");
        }
        assert_eq!(one_line(" a\r\n\tb\u{2028}c "), "a b c");
        assert_eq!(remark("S\u{200b}PACE=LPS"), "SPACE:LPS");
        assert_eq!(
            one_line("SPACE=LPS"),
            "SPACE=LPS",
            "in JSON it means nothing"
        );
        assert_eq!(ascii("Schädel 🦴"), "Sch\\u{e4}del \\u{1f9b4}");
        assert_eq!(
            (&*signed(" \n"), &*signed("A\nhand")),
            ("Fabrica", "Fabrica: A hand")
        );
        assert_eq!(name(String::new()), "clay");
    }
}
