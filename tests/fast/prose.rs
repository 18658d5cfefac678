//! Comments that can be read: lines that fit, and docs that say something.

use std::path::{Path, PathBuf};

/// Longest line of a comment, in characters.
const WIDTH: usize = 120;

/// Docs that only satisfy the lint for missing docs, as whole comments and in lower case.
const EMPTY: [&str; 16] = [
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
];

/// The text of a comment line, without its marks; nothing for code. A line of a string that begins so counts too.
fn comment(line: &str) -> Option<(&str, &str)> {
    let line = line.trim_start();
    let marks = ["///", "//!", "//"];
    let mark = marks.iter().find(|mark| line.starts_with(**mark))?;
    Some((mark, line[mark.len()..].trim()))
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
        if is_alone && (plain.is_empty() || plain.len() == 1 || EMPTY.contains(&plain.as_str())) {
            faults.push((i + 1, format!("a doc without content: “{words}”")));
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

/// The negative control.
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
        ("/// Red.\nRed,", 0),
    ] {
        assert_eq!(faults(text).len(), expected, "{text}");
    }
}
