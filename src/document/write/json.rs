//! Writing of JSON text. It is canonical: known keys in the order of [`schema`], then the other keys by name.

use crate::document::schema;
use crate::document::text::json::number_text;
use serde_json::{Map, Value};

/// An object's entries in the order in which they are written.
fn ordered(map: &Map<String, Value>) -> Vec<(&String, &Value)> {
    let mut entries: Vec<_> = map.iter().collect();
    entries.sort_by_cached_key(|&(key, _)| (schema::order_of(key), key));
    entries
}

/// Writes a value without white space.
pub(crate) fn write_compact(value: &Value, out: &mut String) {
    match value {
        Value::Array(items) => {
            out.push('[');
            for (i, item) in items.iter().enumerate() {
                if i > 0 {
                    out.push(',');
                }
                write_compact(item, out);
            }
            out.push(']');
        }
        Value::Object(map) => {
            out.push('{');
            for (i, (key, item)) in ordered(map).into_iter().enumerate() {
                if i > 0 {
                    out.push(',');
                }
                write_string(key, out);
                out.push(':');
                write_compact(item, out);
            }
            out.push('}');
        }
        scalar => write_scalar(scalar, out),
    }
}

/// Writes a value for people: two spaces per level, arrays of plain values on one line.
pub(crate) fn write_pretty(value: &Value, indent: usize, out: &mut String) {
    let line = |out: &mut String, indent: usize| {
        out.push('\n');
        out.extend(std::iter::repeat_n("  ", indent));
    };
    match value {
        Value::Array(items) if items.iter().any(|i| i.is_array() || i.is_object()) => {
            out.push('[');
            for (i, item) in items.iter().enumerate() {
                if i > 0 {
                    out.push(',');
                }
                line(out, indent + 1);
                write_pretty(item, indent + 1, out);
            }
            line(out, indent);
            out.push(']');
        }
        Value::Array(items) => {
            out.push('[');
            for (i, item) in items.iter().enumerate() {
                if i > 0 {
                    out.push_str(", ");
                }
                write_scalar(item, out);
            }
            out.push(']');
        }
        Value::Object(map) if !map.is_empty() => {
            out.push('{');
            for (i, (key, item)) in ordered(map).into_iter().enumerate() {
                if i > 0 {
                    out.push(',');
                }
                line(out, indent + 1);
                write_string(key, out);
                out.push_str(": ");
                write_pretty(item, indent + 1, out);
            }
            line(out, indent);
            out.push('}');
        }
        Value::Object(_) => out.push_str("{}"),
        scalar => write_scalar(scalar, out),
    }
}

fn write_scalar(value: &Value, out: &mut String) {
    match value {
        Value::Null => out.push_str("null"),
        Value::Bool(flag) => out.push_str(if *flag { "true" } else { "false" }),
        Value::Number(number) => out.push_str(&number_text(number)),
        Value::String(string) => write_string(string, out),
        // No scalars, and never given here; written all the same.
        Value::Array(_) | Value::Object(_) => write_compact(value, out),
    }
}

fn write_string(string: &str, out: &mut String) {
    out.push('"');
    for c in string.chars() {
        match c {
            '"' => out.push_str("\\\""),
            '\\' => out.push_str("\\\\"),
            '\n' => out.push_str("\\n"),
            '\r' => out.push_str("\\r"),
            '\t' => out.push_str("\\t"),
            c if c < ' ' => out.push_str(&format!("\\u{:04x}", u32::from(c))),
            c => out.push(c),
        }
    }
    out.push('"');
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::text::json::read;

    #[test]
    fn numbers_have_one_form() {
        for (text, written) in [
            ("1.0", "1"),
            ("-0.0", "0"),
            ("1e3", "1000"),
            ("0.1", "0.1"),
            ("1e-9", "1e-9"),
            ("1e300", "1e300"),
            ("18446744073709551615", "18446744073709551615"),
            ("-9223372036854775808", "-9223372036854775808"),
            ("123456789012345678901234567890", "1.2345678901234568e29"),
            ("5e-324", "5e-324"),
            ("0.30000000000000004", "0.30000000000000004"),
        ] {
            let value = read(text).expect(text);
            let mut out = String::new();
            write_compact(&value, &mut out);
            assert_eq!(out, written, "of {text}");
            assert_eq!(read(&out).expect(written), value, "{text} read back");
        }
    }

    #[test]
    fn strings_survive() {
        let text = "\"a\\\"\\\\\\/\\b\\f\\n\\r\\t\\u00e9\\ud83e\\udde0 é🧠\u{7f}\"";
        let value = read(text).expect("a string");
        assert_eq!(
            value,
            Value::String("a\"\\/\u{8}\u{c}\n\r\té🧠 é🧠\u{7f}".to_owned())
        );
        let mut out = String::new();
        write_compact(&value, &mut out);
        assert_eq!(read(&out).expect("a string"), value);
    }
}
