//! The reference of the document format, rendered from the schema and the catalogue into `reference.md`.

use super::model::{ParamKind, ParamSpec, StylePreset, TemplateKind, presets};
use super::schema::{Key, Kind, LeftOut, visit};
use super::text::json::{number, number_text};
use crate::displace::Holds;
use crate::math::plain_f64;
use serde_json::Value;
use std::fmt::Write as _;

/// The page as Markdown.
fn render() -> String {
    let mut page = String::from(
        "# Reference of the document format\n\n\
         Written by `FABRICA_BLESS=reference cargo test --lib document::reference`; do not edit.\n\n\
         An asterisk in a pointer stands for an index or a name that the author chooses. A key at its default is left out when a\n\
         document is written, unless its line says otherwise. Values outside a range are kept, and the nearest value is drawn.\n\
         Unknown keys, kinds and names are kept and named in a notice.\n",
    );
    visit(&mut |at, holds, keys| object(&mut page, at, holds, keys));
    page.push_str("\n## Parameters of templates\n\nThe keys of `/templates/*/params`, by kind.\n");
    for kind in TemplateKind::ALL {
        let spec = kind.spec();
        _ = write!(page, "\n### `{}`\n\n{}.\n", spec.name, spec.summary);
        if !spec.params.is_empty() {
            page.push_str("\n| key | value | meaning |\n|---|---|---|\n");
        }
        for param in spec.params {
            _ = writeln!(
                page,
                "| `{}` | {} | {} |",
                param.name,
                param_values(param),
                param.summary
            );
        }
    }
    page
}

/// The section of one object.
fn object(page: &mut String, at: &str, holds: Option<Holds>, keys: &[Key]) {
    let title = match at {
        "" => "The document".to_owned(),
        at => format!("`{at}`"),
    };
    let of = match holds {
        Some(Holds::Points) => " of an `rbf`, besides its parameters",
        Some(Holds::File) => " of a `field`, besides its parameters",
        Some(Holds::Object) => " of a `carve`, besides its parameters",
        Some(Holds::Tools) => " of a `sweep`, besides its parameters",
        Some(Holds::Parameters) | None => "",
    };
    _ = write!(
        page,
        "\n## {title}{of}\n\n| key | value | meaning |\n|---|---|---|\n"
    );
    let mut keys: Vec<&Key> = keys.iter().collect();
    keys.sort_by_key(|key| (key.order, key.name));
    for key in keys {
        let default = match default(key.kind) {
            Some(default) if key.left_out != LeftOut::Optional => format!("; default {default}"),
            _ => String::new(),
        };
        let stays = match key.left_out {
            LeftOut::Never if !default.is_empty() => ", kept where it is written",
            LeftOut::ExceptField => ", kept where it is written in a `field`",
            LeftOut::ExceptFile => ", kept where it is written in an object with a file",
            LeftOut::OfSource => ", kept where it is written in a region without `from`",
            LeftOut::Alone => ", left out where it stands alone",
            _ => "",
        };
        let fixed = match (key.is_fixed, key.is_whole) {
            (true, _) => ". No step may set it",
            (_, true) => ". No step may set it as a whole",
            _ => "",
        };
        _ = writeln!(
            page,
            "| `{}` | {}{default}{stays} | {}{fixed} |",
            key.name,
            values(key.kind),
            key.meaning
        );
    }
}

/// Type and range of a key.
fn values(kind: Kind) -> String {
    match kind {
        Kind::Format => format!("{}", super::FORMAT),
        Kind::Text => "text".to_owned(),
        Kind::Limited { most } => format!("text, of which the first {most} characters count"),
        Kind::Address => "text, an address relative to the document or absolute".to_owned(),
        Kind::Hash => "SHA-256, 64 hexadecimal digits".to_owned(),
        Kind::Builtin => {
            let figures = super::DRAWN_FIGURES;
            format!("{}, {}", listed(&super::BUILTIN_SUBJECTS), listed(&figures))
        }
        Kind::Tool => listed(&super::SceneObject::BUILTINS),
        Kind::Template => "the name of a kind (see below)".to_owned(),
        Kind::Name(names) => listed(names),
        Kind::Color => "`#rgb` or `#rrggbb`".to_owned(),
        Kind::Background => "`#rgb`, `#rrggbb` or `none`".to_owned(),
        Kind::Transfer(_) => {
            let names: Vec<&str> = presets().iter().map(|preset| preset.name).collect();
            format!("`auto`, {}, or a list of points", listed(&names))
        }
        Kind::Style(_) => format!("{}, or an object", listed(&StylePreset::NAMES)),
        Kind::Window => "`auto`, or the lowest and the highest value".to_owned(),
        Kind::Flag { .. } => "true or false".to_owned(),
        Kind::Whole => "whole number from 0".to_owned(),
        Kind::Number { min, max, .. } | Kind::Exact { min, max, .. } => {
            format!("number, {}", range(min, max))
        }
        Kind::Turn => "number, -4π … 4π, or `null`".to_owned(),
        Kind::Point { max } => format!("two numbers, each {}", range(-max, max)),
        Kind::Points { least, most, max } => format!(
            "list of {least} to {most} pairs of numbers, each {}",
            range(-max, max)
        ),
        Kind::Rigidity => {
            let [min, max] = super::model::figure::RIGIDITY_RANGE;
            let range = range(min, max);
            format!("number, {range}, a list of two such numbers, or `rigid`")
        }
        Kind::Behind => "`none`, `smooth`, `#rgb` or `#rrggbb`".to_owned(),
        Kind::Shape => "text, its id, or a whole number from 0, that of a filled shape".to_owned(),
        Kind::Count { min, max, .. } => format!("whole number, {}", range(min, max)),
        Kind::Range => "`[lowest]` or `[lowest, highest]`".to_owned(),
        Kind::Box => "six numbers, mm, RAS+: least x, y, z, greatest x, y, z".to_owned(),
        Kind::Vector { min, max, .. } => format!("three numbers, each {}", range(min, max)),
        Kind::Rotation => "unit quaternion x, y, z, w".to_owned(),
        Kind::Pairs { most } => {
            format!("list of pairs of numbers, of which the first {most} are drawn")
        }
        Kind::Triples { most, max } => format!(
            "list of entries of three numbers, each {}, of which the first {most} are drawn",
            range(-max, max)
        ),
        Kind::Vectors { most, max, .. } => {
            format!(
                "list of at most {most} entries of three numbers, each {}",
                range(-max, max)
            )
        }
        Kind::Path { most, max } => format!(
            "list of whole numbers, three for each of at most {most} points, which lie within {}",
            range(-max, max)
        ),
        Kind::Wholes {
            each,
            most,
            min,
            max,
        } => format!(
            "list of whole numbers, {} for each of at most {most} keys, each {}",
            ["one", "three"][usize::from(each > 1)],
            range(min, max)
        ),
        Kind::Segments => "list of names or label numbers".to_owned(),
        Kind::Labels => "object: text by label number".to_owned(),
        Kind::Looks(_) => "object: by name of a segment a number, 0 … 1, or an object".to_owned(),
        Kind::Object(_) | Kind::Params => "object".to_owned(),
        Kind::List { most, .. } => format!("list of at most {most} objects"),
        Kind::FirstOf { most, .. } => {
            format!("list of objects, of which the first {most} are drawn")
        }
        Kind::OneOrMore { most, .. } => format!("object, or list of at most {most} objects"),
        Kind::Set => "object: a value by JSON pointer".to_owned(),
    }
}

/// The meaning of a missing key, where its kind alone tells.
fn default(kind: Kind) -> Option<String> {
    Some(match kind {
        Kind::Builtin => format!("`{}`", super::DEFAULT_SUBJECT),
        Kind::Name(names) => format!("`{}`", names.first()?),
        Kind::Background => "`#ffffff`".to_owned(),
        Kind::Transfer(_) | Kind::Window => "`auto`".to_owned(),
        Kind::Style(_) => "`none`".to_owned(),
        Kind::Flag { default } => default.to_string(),
        Kind::Whole => "0".to_owned(),
        Kind::Number { default, .. }
        | Kind::Count { default, .. }
        | Kind::Exact { default, .. } => text(default),
        Kind::Turn => "`null`".to_owned(),
        Kind::Point { .. } => "`[0, 0]`".to_owned(),
        Kind::Rigidity => "1".to_owned(),
        Kind::Behind => "`none`".to_owned(),
        Kind::Vector { default, .. } => format!("`[{}]`", default.map(text).join(", ")),
        Kind::Rotation => "`[0, 0, 0, 1]`".to_owned(),
        _ => return None,
    })
}

/// Type, range and default of a parameter.
fn param_values(spec: &ParamSpec) -> String {
    let plain = |value: f32| text(plain_f64(value));
    match spec.kind {
        ParamKind::Number { default, min, max } => {
            format!(
                "number, {} … {}; default {}",
                plain(min),
                plain(max),
                plain(default)
            )
        }
        ParamKind::Count { default, min, max } => format!(
            "whole number, {} … {}; default {}",
            plain(min),
            plain(max),
            plain(default)
        ),
        ParamKind::Flag { default } => format!("true or false; default {default}"),
        ParamKind::Choice { names } => {
            format!(
                "{}; default `{}`",
                listed(names),
                names.first().unwrap_or(&"")
            )
        }
        ParamKind::Vector {
            default,
            min,
            max,
            max_length,
        } => {
            let length = match max_length.is_finite() {
                true => format!("length at most {}", plain(max_length)),
                false => format!("each {} … {}", plain(min), plain(max)),
            };
            format!(
                "three numbers, {length}; default `[{}]`",
                default.map(plain).join(", ")
            )
        }
        ParamKind::Rotation => "unit quaternion x, y, z, w; default `[0, 0, 0, 1]`".to_owned(),
    }
}

/// Both ends of a range; ends beyond every use are left out.
fn range(min: f64, max: f64) -> String {
    match max < 1e30 {
        true => format!("{} … {}", text(min), text(max)),
        false => "any".to_owned(),
    }
}

fn text(value: f64) -> String {
    number_text(&number(value))
}

fn listed(names: &[&str]) -> String {
    let names: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
    names.join(", ")
}

#[test]
fn the_page_is_up_to_date() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/src/document/reference.md");
    let page = render();
    if std::env::var("FABRICA_BLESS").as_deref() == Ok("reference") {
        std::fs::write(path, &page).expect("the page is written");
    }
    let found = include_str!("reference.md");
    let found = std::fs::read_to_string(path).unwrap_or(found.to_owned());
    assert!(
        found == page,
        "src/document/reference.md is out of date: FABRICA_BLESS=reference cargo test --lib document::reference"
    );
}

#[test]
fn every_key_has_its_line() {
    let page = render();
    visit(&mut |at, _, keys| {
        for key in keys {
            let line = format!("| `{}` | ", key.name);
            assert!(page.contains(&line), "{at}/{}", key.name);
        }
    });
    let example: Value = serde_json::json!({ "fov": 30 });
    assert!(page.contains(&format!("number, 0.1 … 170; default {}", example["fov"])));
    assert!(page.contains("### `peel`"), "and every kind its parameters");
}
