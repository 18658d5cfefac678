//! Comments that can be read: lines that fit, and docs with content.

use std::path::{Path, PathBuf};

/// What [`faults`] says of a doc that repeats the name of its item.
const HOLLOW: &str = "a doc that only repeats a name";

/// Longest line of a comment, in characters.
const WIDTH: usize = 120;

/// Docs that only satisfy the lint for missing docs, as whole comments and in lower case.
const EMPTY: [&str; 21] = [
    "which",
    "on",
    "how",
    "what",
    "where",
    "when",
    "who",
    "why",
    "it",
    "this",
    "the same",
    "see the module",
    "see above",
    "see there",
    "as above",
    "ditto",
    "all of it",
    "none here",
    "back again",
    "by how much",
    "not at all",
];

/// Words that say nothing by themselves. A doc of one of these and one further word (“Its name.”, “The file.”) has no
/// content: neither what the item is for, nor its space, unit or range.
const FILLERS: [&str; 27] = [
    "a", "all", "along", "an", "as", "at", "each", "every", "for", "from", "how", "in", "is", "it",
    "its", "no", "of", "on", "one", "some", "that", "the", "their", "this", "what", "where",
    "which",
];

/// The text of a comment line, without its marks; nothing for code. A line of a string that begins so counts too.
fn comment(line: &str) -> Option<(&str, &str)> {
    let line = line.trim_start();
    let marks = ["///", "//!", "//"];
    let mark = marks.iter().find(|mark| line.starts_with(**mark))?;
    Some((mark, line[mark.len()..].trim()))
}

/// A line without the attributes before its item: nothing is left of a line of `#[…]` or of `@compute`.
fn without_attributes(line: &str) -> &str {
    let line = line.trim_start();
    if line.starts_with('#') {
        return "";
    }
    let mut rest = line;
    while rest.starts_with('@') {
        let end = rest.find(char::is_whitespace).unwrap_or(rest.len());
        let inner = rest.find(')').filter(|_| rest[..end].contains('('));
        rest = rest[inner.map_or(end, |inner| inner + 1)..].trim_start();
    }
    rest
}

/// The name of the item that a line of Rust or WGSL declares: a function, type, constant, field or variant.
fn item(line: &str) -> Option<&str> {
    const BEFORE: [&str; 14] = [
        "pub", "async", "unsafe", "const", "static", "fn", "struct", "enum", "trait", "type",
        "mod", "var", "let", "override",
    ];
    let is_name = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let mut rest = line.trim_start();
    loop {
        let end = rest.find(|c| !is_name(c)).unwrap_or(rest.len());
        let (word, after) = rest.split_at(end);
        if !BEFORE.contains(&word) {
            return (!word.is_empty()).then_some(word);
        }
        let is_restricted = after.starts_with('(') || after.starts_with('<');
        let end = after.find([')', '>']).filter(|_| is_restricted);
        rest = after[end.map_or(0, |end| end + 1)..].trim_start();
    }
}

/// The words of a name or of a text in lower case, without the endings of plurals and verbs.
fn stems(text: &str) -> Vec<String> {
    let mut words = vec![String::new()];
    let mut before = ' ';
    for c in text.chars() {
        if !c.is_alphanumeric() || (c.is_uppercase() && before.is_lowercase()) {
            words.push(String::new());
        }
        if let Some(word) = words.last_mut().filter(|_| c.is_alphanumeric()) {
            word.extend(c.to_lowercase());
        }
        before = c;
    }
    words.retain(|word| !word.is_empty());
    for word in &mut words {
        let mut endings = ["ing", "ies", "es", "ed", "s", "e", "y"].into_iter();
        let stem = endings.find_map(|ending| word.strip_suffix(ending));
        if let Some(stem) = stem.filter(|stem| stem.len() >= 3) {
            *word = stem.to_owned();
        }
    }
    words
}

/// True for a doc whose words are fillers or repeat the name of its item, and for one of a filler and one further word.
fn is_hollow(doc: &str, item: &str) -> bool {
    let words: Vec<&str> = doc.split_whitespace().collect();
    let of_words = words
        .iter()
        .map(|word| word.trim_matches(|c: char| !c.is_alphanumeric()));
    let content: Vec<&str> = of_words
        .filter(|word| !FILLERS.contains(&word.to_lowercase().as_str()))
        .collect();
    let name = stems(item);
    let repeats = content
        .iter()
        .all(|word| stems(word).iter().all(|stem| name.contains(stem)));
    repeats || (words.len() == 2 && content.len() < 2)
}

/// What is wrong with the comments of a text, with the number of the line.
fn faults(text: &str) -> Vec<(usize, String)> {
    let mut faults = Vec::new();
    let lines: Vec<&str> = text.lines().collect();
    for (i, line) in lines.iter().enumerate() {
        let Some((mark, words)) = comment(line) else {
            continue;
        };
        let width = line.chars().count();
        if width > WIDTH {
            faults.push((i + 1, format!("a comment of {width} columns")));
        }
        let is_doc = |line: Option<&&str>| {
            line.is_some_and(|line| comment(line).is_some_and(|c| c.0 == mark))
        };
        let before = i.checked_sub(1).and_then(|i| lines.get(i));
        let is_alone = mark != "//" && !is_doc(before) && !is_doc(lines.get(i + 1));
        let plain = words.trim_end_matches(['.', ':', '!']).to_lowercase();
        let mut below = lines[i + 1..].iter().map(|line| without_attributes(line));
        let item = below
            .find(|line| !line.is_empty())
            .and_then(item)
            .filter(|_| mark == "///");
        let is_empty = plain.len() <= 1 || EMPTY.contains(&plain.as_str());
        if is_alone && is_empty {
            faults.push((i + 1, format!("a doc without content: “{words}”")));
        } else if is_alone && item.is_some_and(|item| is_hollow(words, item)) {
            faults.push((i + 1, format!("{HOLLOW}: “{words}”")));
        }
    }
    faults
}

fn files(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).expect("a folder of the repository") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            files(&path, found);
        } else if path
            .extension()
            .is_some_and(|end| end == "rs" || end == "wgsl")
        {
            found.push(path);
        }
    }
}

#[test]
fn comments_fit_and_say_something() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut all = Vec::new();
    for folder in ["src", "shaders", "tests"] {
        files(&root.join(folder), &mut all);
    }
    assert!(all.len() > 200, "only {} files are read", all.len());
    all.sort();
    let mut found = Vec::new();
    for path in all {
        let text = std::fs::read_to_string(&path).expect("text");
        let name = path.strip_prefix(root).unwrap_or(&path).display();
        let faults = faults(&text).into_iter();
        found.extend(faults.map(|(line, fault)| format!("{name}:{line}: {fault}")));
    }
    assert!(
        found.is_empty(),
        "{} places:\n{}",
        found.len(),
        found.join("\n")
    );
}

/// The negative control: planted comments without content are caught, good ones pass.
#[test]
fn poor_comments_are_caught() {
    let long = format!("    // {}", "word ".repeat(24));
    for (text, expected) in [
        ("/// Which.\nindex: usize,", 1),
        ("/// See the module.\nfn f() {}", 1),
        ("    /// The same.\n    fn f() {}", 1),
        ("//! What.", 1),
        ("/// W.\nfn w() {}", 1),
        (long.as_str(), 1),
        ("/// The same.\n/// With a second line.\nfn f() {}", 0),
        ("/// Index of the template, from 0.\nindex: usize,", 0),
        ("// Which.\nlet a = 1;", 0),
        ("/// Red.\nRed,", 1),
        ("/// Its name.\npub ticket: Ticket,", 1),
        ("/// The file.\nname: String,", 1),
        ("/// All of it.\ntext: String,", 1),
        ("/// The camera.\npub camera: Camera,", 1),
        ("/// Clicks.\npub(crate) async fn click(&self) {", 1),
        (
            "/// Every preset.\npub fn presets() -> &'static [Preset] {",
            1,
        ),
        (
            "/// Skip grid.\n#[derive(Debug)]\npub(crate) struct SkipGrid {",
            1,
        ),
        ("/// `@group`.\npub group: u32,", 1),
        ("/// Which one it is.\npub id: ProgramId,", 1),
        (
            "/// The channel of the outside.\nconst CHANNEL_OUTSIDE: u32 = 4u;",
            1,
        ),
        ("/// Linear.\n@group(3) @binding(2) var linear: sampler;", 1),
        (
            "/// The camera that the document opens with.\npub camera: Camera,",
            0,
        ),
        ("/// Hounsfield units.\nCt,", 0),
        ("/// sRGB bytes.\npub color: [u8; 3],", 0),
        ("/// Half open, 0 to 1.\nopen: f32,", 0),
        ("//! Reads scans.\n\nuse std::io;", 0),
    ] {
        assert_eq!(faults(text).len(), expected, "{text}");
    }
}
