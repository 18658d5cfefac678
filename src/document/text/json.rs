//! Reading of JSON text. It is stricter than JSON asks for and names the place of each fault: numbers must be finite,
//! keys unique, nesting bounded.

use super::error::DocumentError;
use super::pointer;
use super::shortened::shortened;
use crate::document::limits::MAX_DEPTH;
use serde_json::{Map, Number, Value};

/// Largest whole number up to which every whole number is a 64-bit float.
const MAX_EXACT_WHOLE: f64 = 9_007_199_254_740_992.0;

/// Reads one JSON value that fills the whole text.
///
/// # Errors
/// [`DocumentError::Syntax`], `NotFinite`, `DuplicateKey`, `TooDeep`.
pub(crate) fn read(text: &str) -> Result<Value, DocumentError> {
    let mut reader = Reader {
        text,
        pos: 0,
        path: Vec::new(),
    };
    // A byte order mark does not belong to the text.
    if text.starts_with('\u{feff}') {
        reader.pos = '\u{feff}'.len_utf8();
    }
    reader.space();
    let value = reader.value(0)?;
    reader.space();
    if reader.pos < text.len() {
        return Err(reader.syntax("more text after the end of the document"));
    }
    Ok(value)
}

/// Checks a tree that was not read from text as [`read`] checks one, and gives its numbers their one form.
///
/// # Errors
/// [`DocumentError::TooDeep`].
pub(crate) fn normalise(value: &mut Value, depth: usize) -> Result<(), DocumentError> {
    match value {
        Value::Number(found) => {
            if let Some(float) = found.as_f64().filter(|_| found.is_f64()) {
                *found = number(float);
            }
        }
        Value::Array(items) => {
            deeper(String::new, depth)?;
            for item in items {
                normalise(item, depth + 1)?;
            }
        }
        Value::Object(map) => {
            deeper(String::new, depth)?;
            for (_, item) in map {
                normalise(item, depth + 1)?;
            }
        }
        Value::Null | Value::Bool(_) | Value::String(_) => {}
    }
    Ok(())
}

fn deeper(pointer: impl FnOnce() -> String, depth: usize) -> Result<(), DocumentError> {
    if depth < MAX_DEPTH {
        return Ok(());
    }
    Err(DocumentError::TooDeep {
        pointer: pointer::shortened(&pointer()),
        limit: MAX_DEPTH,
    })
}

/// A number in the one form that documents hold: a whole number is an integer, however it was written (`1.0` is `1`).
/// NaN and infinity become 0; callers rule them out before.
pub(crate) fn number(value: f64) -> Number {
    if value.fract() == 0.0 && value.abs() <= MAX_EXACT_WHOLE {
        // Minus zero is zero.
        return Number::from(value as i64);
    }
    Number::from_f64(value).unwrap_or_else(|| Number::from(0))
}

struct Reader<'a> {
    text: &'a str,
    pos: usize,
    path: Vec<String>,
}

impl Reader<'_> {
    fn peek(&self) -> Option<u8> {
        self.text.as_bytes().get(self.pos).copied()
    }

    fn space(&mut self) {
        while matches!(self.peek(), Some(b' ' | b'\t' | b'\n' | b'\r')) {
            self.pos += 1;
        }
    }

    fn pointer(&self) -> String {
        self.path
            .iter()
            .fold(String::new(), |pointer, key| pointer::join(&pointer, key))
    }

    fn syntax(&self, problem: &'static str) -> DocumentError {
        let before = self.text.get(..self.pos).unwrap_or(self.text);
        let line_start = before.rfind('\n').map_or(0, |i| i + 1);
        DocumentError::Syntax {
            line: before.matches('\n').count() + 1,
            column: before[line_start..].chars().count() + 1,
            pointer: pointer::shortened(&self.pointer()),
            problem,
        }
    }

    fn value(&mut self, depth: usize) -> Result<Value, DocumentError> {
        match self.peek() {
            None => Err(self.syntax("the text ends where a value should be")),
            Some(b'{') => {
                deeper(|| self.pointer(), depth)?;
                self.object(depth)
            }
            Some(b'[') => {
                deeper(|| self.pointer(), depth)?;
                self.array(depth)
            }
            Some(b'"') => Ok(Value::String(self.string()?)),
            Some(_) => self.word(),
        }
    }

    fn object(&mut self, depth: usize) -> Result<Value, DocumentError> {
        let mut map = Map::new();
        self.pos += 1;
        self.space();
        if self.peek() == Some(b'}') {
            self.pos += 1;
            return Ok(Value::Object(map));
        }
        loop {
            if self.peek() != Some(b'"') {
                return Err(self.syntax("expected a key in quotation marks"));
            }
            let key = self.string()?;
            self.space();
            if self.peek() != Some(b':') {
                return Err(self.syntax("expected a colon after the key"));
            }
            self.pos += 1;
            self.space();
            self.path.push(key.clone());
            let value = self.value(depth + 1)?;
            if map.insert(key, value).is_some() {
                return Err(DocumentError::DuplicateKey {
                    pointer: pointer::shortened(&self.pointer()),
                });
            }
            self.path.pop();
            self.space();
            match self.peek() {
                Some(b',') => self.pos += 1,
                Some(b'}') => {
                    self.pos += 1;
                    return Ok(Value::Object(map));
                }
                _ => return Err(self.syntax("expected a comma or a closing brace")),
            }
            self.space();
        }
    }

    fn array(&mut self, depth: usize) -> Result<Value, DocumentError> {
        let mut items = Vec::new();
        self.pos += 1;
        self.space();
        if self.peek() == Some(b']') {
            self.pos += 1;
            return Ok(Value::Array(items));
        }
        loop {
            self.path.push(items.len().to_string());
            items.push(self.value(depth + 1)?);
            self.path.pop();
            self.space();
            match self.peek() {
                Some(b',') => self.pos += 1,
                Some(b']') => {
                    self.pos += 1;
                    return Ok(Value::Array(items));
                }
                _ => return Err(self.syntax("expected a comma or a closing bracket")),
            }
            self.space();
        }
    }

    /// A string; the reader stands on its opening quotation mark.
    fn string(&mut self) -> Result<String, DocumentError> {
        let mut string = String::new();
        self.pos += 1;
        loop {
            let rest = self.text.get(self.pos..).unwrap_or("");
            let plain = rest
                .find(|c: char| c == '"' || c == '\\' || c < ' ')
                .unwrap_or(rest.len());
            string.push_str(&rest[..plain]);
            self.pos += plain;
            match self.peek() {
                None => return Err(self.syntax("the text ends inside a string")),
                Some(b'"') => {
                    self.pos += 1;
                    return Ok(string);
                }
                Some(b'\\') => {
                    self.pos += 1;
                    string.push(self.escape()?);
                }
                Some(_) => return Err(self.syntax("a control character inside a string")),
            }
        }
    }

    fn escape(&mut self) -> Result<char, DocumentError> {
        let escape = self.peek();
        self.pos += 1;
        Ok(match escape {
            Some(b'"') => '"',
            Some(b'\\') => '\\',
            Some(b'/') => '/',
            Some(b'b') => '\u{8}',
            Some(b'f') => '\u{c}',
            Some(b'n') => '\n',
            Some(b'r') => '\r',
            Some(b't') => '\t',
            Some(b'u') => {
                let high = self.hex4()?;
                let code = if (0xd800..0xdc00).contains(&high) {
                    if self.text.as_bytes().get(self.pos..self.pos + 2) != Some(b"\\u") {
                        return Err(self.syntax("half of a surrogate pair"));
                    }
                    self.pos += 2;
                    let low = self.hex4()?;
                    if !(0xdc00..0xe000).contains(&low) {
                        return Err(self.syntax("half of a surrogate pair"));
                    }
                    0x10000 + ((high - 0xd800) << 10) + (low - 0xdc00)
                } else {
                    high
                };
                match char::from_u32(code) {
                    Some(c) => c,
                    None => return Err(self.syntax("half of a surrogate pair")),
                }
            }
            _ => {
                self.pos -= 1;
                return Err(self.syntax("unknown escape in a string"));
            }
        })
    }

    fn hex4(&mut self) -> Result<u32, DocumentError> {
        let digits = self
            .text
            .get(self.pos..self.pos + 4)
            .filter(|digits| digits.bytes().all(|b| b.is_ascii_hexdigit()))
            .and_then(|digits| u32::from_str_radix(digits, 16).ok());
        match digits {
            Some(code) => {
                self.pos += 4;
                Ok(code)
            }
            None => Err(self.syntax("expected four hexadecimal digits")),
        }
    }

    /// A number or one of the words of JSON.
    fn word(&mut self) -> Result<Value, DocumentError> {
        let rest = self.text.get(self.pos..).unwrap_or("");
        let end = rest
            .find(|c: char| !(c.is_ascii_alphanumeric() || matches!(c, '+' | '-' | '.' | '_')))
            .unwrap_or(rest.len());
        let word = &rest[..end];
        let value = match word {
            "null" => Value::Null,
            "true" => Value::Bool(true),
            "false" => Value::Bool(false),
            _ => {
                // Other programs write these words where JSON has no number.
                let bare = word.trim_start_matches(['+', '-']).to_ascii_lowercase();
                if matches!(bare.as_str(), "nan" | "inf" | "infinity") {
                    return Err(self.not_finite(word));
                }
                if !is_number(word) {
                    return Err(self.syntax("expected a value"));
                }
                if let Ok(whole) = word.parse::<i64>() {
                    Value::Number(whole.into())
                } else if let Ok(whole) = word.parse::<u64>() {
                    Value::Number(whole.into())
                } else {
                    match word.parse::<f64>() {
                        Ok(float) if float.is_finite() => Value::Number(number(float)),
                        _ => return Err(self.not_finite(word)),
                    }
                }
            }
        };
        self.pos += end;
        Ok(value)
    }

    fn not_finite(&self, word: &str) -> DocumentError {
        DocumentError::NotFinite {
            pointer: pointer::shortened(&self.pointer()),
            found: shortened(word, 24),
        }
    }
}

/// True for a number as JSON has it: `-?(0|[1-9][0-9]*)(\.[0-9]+)?([eE][+-]?[0-9]+)?`
fn is_number(word: &str) -> bool {
    fn digits(s: &str) -> (usize, &str) {
        let n = s.bytes().take_while(u8::is_ascii_digit).count();
        (n, &s[n..])
    }
    let unsigned = word.strip_prefix('-').unwrap_or(word);
    let (n, mut rest) = digits(unsigned);
    if n == 0 || (n > 1 && unsigned.starts_with('0')) {
        return false;
    }
    if let Some(fraction) = rest.strip_prefix('.') {
        let (n, after) = digits(fraction);
        if n == 0 {
            return false;
        }
        rest = after;
    }
    if let Some(exponent) = rest.strip_prefix(['e', 'E']) {
        let (n, after) = digits(exponent.strip_prefix(['+', '-']).unwrap_or(exponent));
        if n == 0 {
            return false;
        }
        rest = after;
    }
    rest.is_empty()
}

/// The shortest text that reads back to the same number.
pub(crate) fn number_text(number: &Number) -> String {
    match number.as_f64().filter(|_| number.is_f64()) {
        Some(float) => {
            // Both forms are the shortest digits that round-trip; very small and very large ones need the exponent.
            let (plain, scientific) = (format!("{float}"), format!("{float:e}"));
            // A whole number too large for a float to count would read back as another kind of number.
            if scientific.len() < plain.len() || float.abs() > MAX_EXACT_WHOLE {
                scientific
            } else {
                plain
            }
        }
        None => number.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn error(text: &str) -> String {
        read(text).expect_err(text).to_string()
    }

    #[test]
    fn what_is_not_finite_is_named_by_pointer() {
        for word in ["NaN", "Infinity", "-Infinity", "1e999", "-1e400", "inf"] {
            let message = error(&format!(r#"{{"a":[0,{{"b/c":{word}}}]}}"#));
            assert_eq!(message, format!("/a/1/b~1c: {word} is not a finite number"));
        }
    }

    #[test]
    fn broken_text_is_named_by_place() {
        assert_eq!(
            error("{\"a\": 1,\n \"b\" 2}"),
            "not JSON at line 2, column 6: expected a colon after the key"
        );
        for text in [
            "",
            " ",
            "{",
            "[",
            "[1,]",
            "{\"a\":1,}",
            "01",
            "1.",
            "-",
            "+1",
            ".5",
            "1e",
            "nul",
            "\"",
            "\"\\x\"",
            "\"\\ud800\"",
            "\"\\ud800\\u0041\"",
            "\"\\u12\"",
            "\"\\u12é4\"",
            "\"\n\"",
            "1 2",
            "{1:2}",
            "{\"a\":1 \"b\":2}",
            "\u{0}",
        ] {
            assert!(read(text).is_err(), "{text:?} is no JSON");
        }
    }

    #[test]
    fn depth_is_bounded_and_keys_are_unique() {
        let deep = |n: usize| "[".repeat(n) + &"]".repeat(n);
        assert!(
            read(&deep(MAX_DEPTH)).is_ok(),
            "the limit itself is allowed"
        );
        assert!(
            matches!(
                read(&deep(MAX_DEPTH + 1)),
                Err(DocumentError::TooDeep { .. })
            ),
            "one more is not"
        );
        assert!(
            matches!(
                read(&"[".repeat(1 << 20)),
                Err(DocumentError::TooDeep { .. })
            ),
            "nor a bomb"
        );
        assert_eq!(
            error(r#"{"a":{"b":1,"b":1}}"#),
            "/a/b: the key is there twice"
        );
    }
}
