//! The import graph of the crate, read from the text of its files.
//!
//! A file imports another one if it names something that the other one defines: in a `use`, or in a path such as
//! `crate::math::Aabb`. A `mod.rs` or `lib.rs` that holds nothing but declarations and re-exports imports nothing; what
//! is imported through it counts as imported from the file that defines it.
//!
//! The reader knows the part of Rust's grammar that imports need: comments, literals, modules (in files and inline),
//! `use` trees and paths. It does not expand macros; an item that a macro defines counts as defined in the file that
//! calls the macro.

use std::collections::{BTreeMap, BTreeSet};

/// One file of the crate.
pub(crate) struct Source {
    /// Path below `src`, with `/`.
    pub(crate) path: String,
    /// The file's whole text.
    pub(crate) text: String,
}

/// That one file imports another one.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Import {
    /// The importing file, below `src`.
    pub(crate) from: String,
    /// The file that defines the imported name.
    pub(crate) to: String,
    /// Line of the importing file, from 1.
    pub(crate) line: usize,
    /// The imported path as written, groups expanded.
    pub(crate) written: String,
}

/// A path that leaves the crate, as `std::fs::read`.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Foreign {
    /// The file, below `src`.
    pub(crate) from: String,
    /// Line of the path in the file, from 1.
    pub(crate) line: usize,
    /// The whole path, aliases replaced.
    pub(crate) path: String,
}

/// All imports of the crate, sorted.
#[derive(Default)]
pub(crate) struct Graph {
    /// Between its files: the first line of each pair of files.
    pub(crate) imports: Vec<Import>,
    /// Out of the crate.
    pub(crate) foreign: Vec<Foreign>,
    /// Files that hold nothing but declarations and re-exports: what they import is imported by whoever uses them.
    pub(crate) declaring: BTreeSet<String>,
    /// Files that no `mod` line reaches.
    pub(crate) unreached: Vec<String>,
}

// ---------------------------------------------------------------------------------------------------- words

#[derive(Clone, Debug, PartialEq, Eq)]
enum Word {
    Name(String),
    /// The sign `::` between two names of a path.
    Path,
    Sign(char),
}

struct Token {
    word: Word,
    line: usize,
}

/// The words of a source text. Comments, literals and lifetimes are left out.
fn words(text: &str) -> Vec<Token> {
    let chars: Vec<char> = text.chars().collect();
    let at = |i: usize| chars.get(i).copied().unwrap_or('\0');
    let is_name = |c: char| c.is_alphanumeric() || c == '_';
    let (mut tokens, mut i, mut line) = (Vec::new(), 0, 1);
    while i < chars.len() {
        let start = i;
        match at(i) {
            '/' if at(i + 1) == '/' => {
                while i < chars.len() && at(i) != '\n' {
                    i += 1;
                }
            }
            '/' if at(i + 1) == '*' => {
                let mut depth = 0;
                while i < chars.len() {
                    match (at(i), at(i + 1)) {
                        ('/', '*') => (depth, i) = (depth + 1, i + 2),
                        ('*', '/') => (depth, i) = (depth - 1, i + 2),
                        _ => i += 1,
                    }
                    if depth == 0 {
                        break;
                    }
                }
            }
            '"' => i = after_quotes(&chars, i),
            'r' | 'b' | 'c' if is_literal(&chars, i) => i = after_prefixed(&chars, i),
            // A lifetime has no closing quote; a character has one two or more places on.
            '\'' if at(i + 1) != '\\' && at(i + 2) != '\'' => {
                i += 1;
                while is_name(at(i)) {
                    i += 1;
                }
            }
            '\'' => {
                i += if at(i + 1) == '\\' { 3 } else { 2 };
                while i < chars.len() && at(i) != '\'' {
                    i += 1;
                }
                i += 1;
            }
            c if is_name(c) => {
                // A raw name, `r#move`.
                let is_raw = c == 'r' && at(i + 1) == '#';
                let start = if is_raw { i + 2 } else { i };
                i = start;
                while is_name(at(i)) {
                    i += 1;
                }
                if !c.is_ascii_digit() {
                    let name = chars[start..i].iter().collect();
                    let word = Word::Name(name);
                    tokens.push(Token { word, line });
                }
            }
            ':' if at(i + 1) == ':' => {
                i += 2;
                let word = Word::Path;
                tokens.push(Token { word, line });
            }
            c => {
                i += 1;
                if !c.is_whitespace() {
                    let word = Word::Sign(c);
                    tokens.push(Token { word, line });
                }
            }
        }
        line += chars[start..i.min(chars.len())]
            .iter()
            .filter(|c| **c == '\n')
            .count();
    }
    tokens
}

/// The place behind a quoted text that begins at `i`.
fn after_quotes(chars: &[char], mut i: usize) -> usize {
    i += 1;
    while i < chars.len() && chars[i] != '"' {
        i += if chars[i] == '\\' { 2 } else { 1 };
    }
    i + 1
}

/// True where `r"`, `r#"`, `b"`, `br"`, `c"` or `b'` begins, and no name.
fn is_literal(chars: &[char], start: usize) -> bool {
    let before = start.checked_sub(1).map(|i| chars[i]);
    if before.is_some_and(|c| c.is_alphanumeric() || c == '_') {
        return false;
    }
    let rest: String = chars[start..].iter().take(24).collect();
    let rest = rest.trim_start_matches(['b', 'c']);
    let is_raw = rest.strip_prefix('r').is_some_and(|rest| {
        let quoted = rest.trim_start_matches('#');
        quoted.starts_with('"')
    });
    let is_short = rest.len() < 24;
    is_raw
        || (is_short && (rest.starts_with('"') || (chars[start] == 'b' && rest.starts_with('\''))))
}

/// The place behind a literal with a prefix.
fn after_prefixed(chars: &[char], mut i: usize) -> usize {
    let mut is_raw = false;
    while matches!(chars.get(i), Some('r' | 'b' | 'c')) {
        is_raw |= chars[i] == 'r';
        i += 1;
    }
    if chars.get(i) == Some(&'\'') {
        i += if chars.get(i + 1) == Some(&'\\') {
            3
        } else {
            2
        };
        while i < chars.len() && chars[i] != '\'' {
            i += 1;
        }
        return i + 1;
    }
    if !is_raw {
        return after_quotes(chars, i);
    }
    let hashes = chars[i..].iter().take_while(|c| **c == '#').count();
    i += hashes + 1;
    while i < chars.len() {
        let closes = chars[i] == '"'
            && chars[i + 1..]
                .iter()
                .take(hashes)
                .filter(|c| **c == '#')
                .count()
                == hashes;
        i += 1;
        if closes {
            return i + hashes;
        }
    }
    i
}

// ---------------------------------------------------------------------------------------------------- modules

/// A path that is written somewhere in a module.
struct Written {
    names: Vec<String>,
    line: usize,
}

/// One leaf of a `use` tree.
struct Use {
    names: Vec<String>,
    /// Name in the importing file; `None` for `*` and `as _`.
    alias: Option<String>,
    is_glob: bool,
    is_public: bool,
    line: usize,
}

/// A module: a file, or an inline one in a file.
struct Module {
    file: usize,
    parent: Option<usize>,
    /// Root of its crate.
    root: usize,
    children: BTreeMap<String, usize>,
    items: BTreeSet<String>,
    uses: Vec<Use>,
    paths: Vec<Written>,
}

/// What a path leads to.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Target {
    Module(usize),
    /// Something that the file of this module defines.
    Item(usize),
    Foreign(Vec<String>),
}

struct Reader<'a> {
    sources: &'a [Source],
    index: BTreeMap<&'a str, usize>,
    modules: Vec<Module>,
    /// Per file: holds nothing but declarations and re-exports.
    declares_only: Vec<bool>,
    is_reached: Vec<bool>,
}

/// Reads the graph of the files given; `src/bin` may be among them.
pub(crate) fn read(sources: &[Source]) -> Graph {
    let index = sources.iter().enumerate();
    let mut reader = Reader {
        sources,
        index: index.map(|(i, source)| (source.path.as_str(), i)).collect(),
        modules: Vec::new(),
        declares_only: vec![false; sources.len()],
        is_reached: vec![false; sources.len()],
    };
    let is_root = |path: &str| {
        let parts: Vec<&str> = path.split('/').collect();
        matches!(
            parts[..],
            ["lib.rs" | "main.rs"] | ["bin", _] | ["bin", _, "main.rs"]
        )
    };
    // The library first: programs name it.
    for wants_library in [true, false] {
        for (i, source) in sources.iter().enumerate() {
            if is_root(&source.path) && (source.path == "lib.rs") == wants_library {
                reader.add(i, None, reader.modules.len());
            }
        }
    }
    reader.graph()
}

impl Reader<'_> {
    /// Adds a file as a module, with the modules that it declares.
    fn add(&mut self, file: usize, parent: Option<usize>, root: usize) -> usize {
        let module = self.modules.len();
        self.modules.push(Module {
            file,
            parent,
            root,
            children: BTreeMap::new(),
            items: BTreeSet::new(),
            uses: Vec::new(),
            paths: Vec::new(),
        });
        self.is_reached[file] = true;
        let tokens = words(&self.sources[file].text);
        let path = self.sources[file].path.clone();
        let (folder, name) = path.rsplit_once('/').unwrap_or(("", &path));
        let is_root_file = parent.is_none() || name == "mod.rs";
        self.declares_only[file] = is_root_file && declares_only(&tokens);
        let stem = name.trim_end_matches(".rs");
        let below = match (is_root_file, folder) {
            (true, "") => String::new(),
            (true, _) => format!("{folder}/"),
            (false, "") => format!("{stem}/"),
            (false, _) => format!("{folder}/{stem}/"),
        };
        let mut declared = Vec::new();
        self.fill(module, &tokens, &mut declared);
        for (place, name) in declared {
            let candidates = [format!("{below}{name}.rs"), format!("{below}{name}/mod.rs")];
            let found = candidates
                .iter()
                .find_map(|path| self.index.get(path.as_str()));
            if let Some(&child) = found {
                let id = self.add(child, Some(place), root);
                self.modules[place].children.insert(name, id);
            }
        }
        module
    }

    /// Reads modules, items, `use` lines and paths of a file. `declared` gets modules that have a file of their own.
    fn fill(&mut self, file_module: usize, tokens: &[Token], declared: &mut Vec<(usize, String)>) {
        let name_at = |i: usize| match tokens.get(i).map(|t| &t.word) {
            Some(Word::Name(name)) => Some(name.as_str()),
            _ => None,
        };
        let is_sign = |i: usize, c: char| tokens.get(i).is_some_and(|t| t.word == Word::Sign(c));
        // Inline modules that are open, with the depth of braces within them.
        let mut open = vec![(file_module, 0usize)];
        let (mut depth, mut i) = (0_usize, 0);
        while i < tokens.len() {
            let (here, level) = open[open.len() - 1];
            match &tokens[i].word {
                Word::Sign('{') => depth += 1,
                Word::Sign('}') => {
                    depth = depth.saturating_sub(1);
                    if open.len() > 1 && depth < level {
                        open.pop();
                    }
                }
                Word::Name(word) if word == "mod" && name_at(i + 1).is_some() => {
                    let name = name_at(i + 1).unwrap_or_default().to_owned();
                    if is_sign(i + 2, ';') {
                        declared.push((here, name));
                    } else if is_sign(i + 2, '{') {
                        let id = self.modules.len();
                        let (file, root) = (self.modules[here].file, self.modules[here].root);
                        self.modules.push(Module {
                            file,
                            parent: Some(here),
                            root,
                            children: BTreeMap::new(),
                            items: BTreeSet::new(),
                            uses: Vec::new(),
                            paths: Vec::new(),
                        });
                        self.modules[here].children.insert(name, id);
                        depth += 1;
                        open.push((id, depth));
                    }
                    i += 2;
                }
                Word::Name(word) if word == "use" && !is_sign(i + 1, '<') => {
                    let is_public = match i.checked_sub(1) {
                        Some(before) => name_at(before) == Some("pub") || is_sign(before, ')'),
                        None => false,
                    };
                    let mut uses = Vec::new();
                    i = use_tree(tokens, i + 1, &[], &mut uses);
                    for leaf in &mut uses {
                        leaf.is_public = is_public;
                    }
                    self.modules[here].uses.extend(uses);
                    continue;
                }
                Word::Name(word) => {
                    let is_item = matches!(
                        word.as_str(),
                        "fn" | "struct" | "enum" | "union" | "trait" | "type" | "const" | "static"
                    );
                    if is_item && depth == level {
                        let skip = usize::from(name_at(i + 1) == Some("mut"));
                        if let Some(name) = name_at(i + 1 + skip) {
                            self.modules[here].items.insert(name.to_owned());
                        }
                    }
                    if word == "macro_rules"
                        && is_sign(i + 1, '!')
                        && let Some(name) = name_at(i + 2)
                    {
                        self.modules[here].items.insert(name.to_owned());
                    }
                    let line = tokens[i].line;
                    let continues = match i.checked_sub(1).map(|before| &tokens[before].word) {
                        Some(Word::Sign('.')) => true,
                        // After a name or generics; at the head of a path it means a crate.
                        Some(Word::Path) => {
                            i > 1 && (name_at(i - 2).is_some() || is_sign(i - 2, '>'))
                        }
                        _ => false,
                    };
                    let mut names = vec![word.clone()];
                    while tokens.get(i + 1).is_some_and(|t| t.word == Word::Path) {
                        let Some(next) = name_at(i + 2) else { break };
                        names.push(next.to_owned());
                        i += 2;
                    }
                    if names.len() > 1 && !continues {
                        self.modules[here].paths.push(Written { names, line });
                    }
                }
                _ => {}
            }
            i += 1;
        }
    }

    // ------------------------------------------------------------------------------------------------ names

    /// What a path leads to that is written in a module.
    fn resolve(&self, module: usize, names: &[String], asked: &mut Vec<(usize, String)>) -> Target {
        let Some((first, rest)) = names.split_first() else {
            return Target::Module(module);
        };
        let start = match first.as_str() {
            "crate" => Target::Module(self.modules[module].root),
            "self" => Target::Module(module),
            "super" => Target::Module(self.modules[module].parent.unwrap_or(module)),
            "fabrica" if self.modules[module].root != 0 => Target::Module(0),
            name => match self.find(module, name, asked) {
                Some(target) => target,
                None => return Target::Foreign(names.to_vec()),
            },
        };
        self.descend(start, rest, asked)
    }

    fn descend(&self, start: Target, rest: &[String], asked: &mut Vec<(usize, String)>) -> Target {
        let mut target = start;
        for (i, name) in rest.iter().enumerate() {
            target = match target {
                Target::Module(module) if name == "super" => {
                    Target::Module(self.modules[module].parent.unwrap_or(module))
                }
                Target::Module(module) if name == "self" => Target::Module(module),
                Target::Module(module) => match self.find(module, name, asked) {
                    Some(found) => found,
                    // By a macro, or written in a way that this reader does not know.
                    None => return Target::Item(module),
                },
                Target::Item(module) => return Target::Item(module),
                Target::Foreign(mut path) => {
                    path.extend(rest[i..].iter().cloned());
                    return Target::Foreign(path);
                }
            };
        }
        target
    }

    /// What a name means in a module: a child, an item, or what a `use` brings in.
    fn find(&self, module: usize, name: &str, asked: &mut Vec<(usize, String)>) -> Option<Target> {
        let key = (module, name.to_owned());
        if asked.contains(&key) {
            return None;
        }
        asked.push(key);
        let found = self.find_once(module, name, asked);
        asked.pop();
        found
    }

    fn find_once(
        &self,
        module: usize,
        name: &str,
        asked: &mut Vec<(usize, String)>,
    ) -> Option<Target> {
        let here = &self.modules[module];
        if let Some(child) = here.children.get(name) {
            return Some(Target::Module(*child));
        }
        if here.items.contains(name) {
            return Some(Target::Item(module));
        }
        let named = here
            .uses
            .iter()
            .find(|leaf| leaf.alias.as_deref() == Some(name));
        if let Some(leaf) = named {
            return Some(self.resolve(module, &leaf.names, asked));
        }
        for leaf in here.uses.iter().filter(|leaf| leaf.is_glob) {
            if let Target::Module(other) = self.resolve(module, &leaf.names, asked)
                && other != module
                && let Some(found) = self.find(other, name, asked)
            {
                return Some(found);
            }
        }
        None
    }

    // ------------------------------------------------------------------------------------------------ graph

    fn graph(&self) -> Graph {
        let mut imports: BTreeMap<(usize, usize), (usize, String)> = BTreeMap::new();
        let mut foreign = BTreeSet::new();
        for (id, module) in self.modules.iter().enumerate() {
            let uses = module
                .uses
                .iter()
                .map(|leaf| (&leaf.names, leaf.line, leaf.is_glob));
            let paths = module
                .paths
                .iter()
                .map(|path| (&path.names, path.line, false));
            for (names, line, is_glob) in uses.chain(paths) {
                let mut files = BTreeSet::new();
                match self.resolve(id, names, &mut Vec::new()) {
                    Target::Module(to) if is_glob => {
                        self.through_glob(to, &mut files, &mut BTreeSet::new())
                    }
                    Target::Module(to) | Target::Item(to) => {
                        files.insert(self.modules[to].file);
                    }
                    Target::Foreign(path) => {
                        foreign.insert(Foreign {
                            from: self.sources[module.file].path.clone(),
                            line,
                            path: path.join("::"),
                        });
                    }
                }
                for to in files {
                    if to == module.file {
                        continue;
                    }
                    let written = names.join("::") + if is_glob { "::*" } else { "" };
                    let first = imports
                        .entry((module.file, to))
                        .or_insert((line, written.clone()));
                    if line < first.0 {
                        *first = (line, written);
                    }
                }
            }
        }
        let path = |i: usize| self.sources[i].path.clone();
        let mut imports: Vec<Import> = imports
            .into_iter()
            .map(|((from, to), (line, written))| Import {
                from: path(from),
                to: path(to),
                line,
                written,
            })
            .collect();
        imports.sort();
        let files = 0..self.sources.len();
        let declaring = files.filter(|i| self.declares_only[*i]).map(path).collect();
        let unreached = (0..self.sources.len())
            .filter(|i| !self.is_reached[*i])
            .map(path);
        Graph {
            imports,
            foreign: foreign.into_iter().collect(),
            declaring,
            unreached: unreached.collect(),
        }
    }

    /// Files that `use module::*` may take names from.
    fn through_glob(&self, module: usize, files: &mut BTreeSet<usize>, seen: &mut BTreeSet<usize>) {
        if !seen.insert(module) {
            return;
        }
        let here = &self.modules[module];
        files.insert(here.file);
        for leaf in here.uses.iter().filter(|leaf| leaf.is_public) {
            match self.resolve(module, &leaf.names, &mut Vec::new()) {
                Target::Module(to) if leaf.is_glob => self.through_glob(to, files, seen),
                Target::Module(to) | Target::Item(to) => {
                    files.insert(self.modules[to].file);
                }
                Target::Foreign(_) => {}
            }
        }
    }
}

/// True if there is nothing but `mod`, `use` and attributes.
fn declares_only(tokens: &[Token]) -> bool {
    let is_sign = |i: usize, c: char| tokens.get(i).is_some_and(|t| t.word == Word::Sign(c));
    let closing = |mut i: usize, opens: char, closes: char| {
        let mut depth = 0;
        while i < tokens.len() {
            depth += i32::from(is_sign(i, opens)) - i32::from(is_sign(i, closes));
            i += 1;
            if depth == 0 {
                break;
            }
        }
        i
    };
    let mut i = 0;
    while i < tokens.len() {
        match &tokens[i].word {
            Word::Sign('#') => i = closing(i + 1 + usize::from(is_sign(i + 1, '!')), '[', ']'),
            Word::Name(word) if word == "pub" => {
                i += 1;
                if is_sign(i, '(') {
                    i = closing(i, '(', ')');
                }
            }
            Word::Name(word) if word == "mod" && is_sign(i + 2, ';') => i += 3,
            Word::Name(word) if word == "use" => {
                while i < tokens.len() && !is_sign(i, ';') {
                    i += 1;
                }
                i += 1;
            }
            _ => return false,
        }
    }
    true
}

/// Reads a `use` tree that begins at `i`, below `before`; gives the place behind it.
fn use_tree(tokens: &[Token], mut i: usize, before: &[String], uses: &mut Vec<Use>) -> usize {
    let mut names = before.to_vec();
    let line = tokens.get(i).map_or(0, |t| t.line);
    let mut leaf = |names: Vec<String>, alias: Option<String>, is_glob: bool, line: usize| {
        uses.push(Use {
            names,
            alias,
            is_glob,
            is_public: false,
            line,
        });
    };
    while let Some(token) = tokens.get(i) {
        match &token.word {
            Word::Path => i += 1,
            Word::Sign('*') => {
                leaf(names, None, true, token.line);
                return i + 1;
            }
            Word::Sign('{') => {
                i += 1;
                while i < tokens.len() && tokens[i].word != Word::Sign('}') {
                    if tokens[i].word == Word::Sign(',') {
                        i += 1;
                    } else {
                        i = use_tree(tokens, i, &names, uses);
                    }
                }
                return i + 1;
            }
            Word::Name(word) if word == "as" => {
                let alias = match tokens.get(i + 1).map(|t| &t.word) {
                    Some(Word::Name(name)) if name != "_" => Some(name.clone()),
                    _ => None,
                };
                leaf(names, alias, false, line);
                return i + 2;
            }
            Word::Name(word) if word == "self" && !names.is_empty() => i += 1,
            Word::Name(word) => {
                names.push(word.clone());
                i += 1;
            }
            Word::Sign(_) => break,
        }
    }
    let alias = names.last().cloned();
    leaf(names, alias, false, line);
    i
}

// ---------------------------------------------------------------------------------------------------- circles

/// Groups of files that import each other, directly or in a circle; each sorted, and with the imports within it.
pub(crate) fn circles(graph: &Graph) -> Vec<(Vec<String>, Vec<Import>)> {
    let is_declaring = |file: &String| graph.declaring.contains(file);
    let counts = |import: &&Import| !is_declaring(&import.from) && !is_declaring(&import.to);
    let imports: Vec<&Import> = graph.imports.iter().filter(counts).collect();
    let mut next: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    for import in &imports {
        next.entry(&import.from).or_default().push(&import.to);
        next.entry(&import.to).or_default();
    }
    let reach = |start: &str| {
        let (mut seen, mut todo) = (BTreeSet::new(), vec![start]);
        while let Some(file) = todo.pop() {
            for &to in next.get(file).into_iter().flatten() {
                if seen.insert(to) {
                    todo.push(to);
                }
            }
        }
        seen
    };
    let reached: BTreeMap<&str, BTreeSet<&str>> =
        next.keys().map(|file| (*file, reach(file))).collect();
    let mut done = BTreeSet::new();
    let mut groups = Vec::new();
    for (file, seen) in &reached {
        if !seen.contains(file) || done.contains(file) {
            continue;
        }
        let group: BTreeSet<&str> = seen
            .iter()
            .copied()
            .filter(|other| reached[other].contains(file))
            .collect();
        done.extend(group.iter().copied());
        let within = |i: &&Import| group.contains(i.from.as_str()) && group.contains(i.to.as_str());
        let within = imports.iter().copied().filter(within).cloned().collect();
        groups.push((group.into_iter().map(str::to_owned).collect(), within));
    }
    groups
}
