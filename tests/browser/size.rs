//! What a visitor downloads. Fails above a ceiling, so that growth is a decision.

use super::running::timed;
use std::io::Write as _;
use std::path::Path;

/// A program with its script, and its ceilings in bytes.
struct Program {
    name: &'static str,
    /// As a server sends it that compresses while it sends (brotli, quality 9).
    sent: usize,
    /// As a static host sends it, packed once beforehand (brotli, quality 11, the tool's default).
    packed: usize,
}

/// The page itself, and the parts that it fetches when it first needs them.
const PROGRAMS: [Program; 8] = [
    // With the editor of figures, and room for what the page is still to get.
    Program {
        name: "fabrica",
        sent: 1_815_000,
        packed: 1_650_000,
    },
    Program {
        name: "fabrica_reader",
        sent: 660_000,
        packed: 600_000,
    },
    Program {
        name: "fabrica_subjects",
        sent: 572_000,
        packed: 520_000,
    },
    Program {
        name: "fabrica_scans",
        sent: 572_000,
        packed: 520_000,
    },
    Program {
        name: "fabrica_meshes",
        sent: 572_000,
        packed: 520_000,
    },
    Program {
        name: "fabrica_clay",
        sent: 572_000,
        packed: 520_000,
    },
    Program {
        name: "fabrica_pictures",
        sent: 572_000,
        packed: 520_000,
    },
    Program {
        name: "fabrica_figures",
        sent: 572_000,
        packed: 520_000,
    },
];

#[test]
fn programs_stay_under_their_ceilings() {
    timed(weigh);
}

fn weigh() {
    let mut head = 0;
    for program in &PROGRAMS {
        let mut total = [0; 4];
        for name in [
            format!("{}_bg.wasm", program.name),
            format!("{}.js", program.name),
        ] {
            let bytes = built(&name);
            let sizes = [
                bytes.len(),
                gzip(&bytes),
                brotli(&bytes, 9),
                brotli(&bytes, 11),
            ];
            println!("{name}: {}", shown(sizes));
            for (sum, size) in total.iter_mut().zip(sizes) {
                *sum += size;
            }
        }
        println!("{} in all: {}", program.name, shown(total));
        for (sum, ceiling) in [(total[2], program.sent), (total[3], program.packed)] {
            assert!(
                sum <= ceiling,
                "{} has grown to {sum} bytes (brotli), the ceiling is {ceiling}",
                program.name
            );
        }
        if ["fabrica", "fabrica_subjects"].contains(&program.name) {
            head += total[3];
        }
    }
    println!("to show the built-in head: {head} bytes brotli (quality 11)");
}

/// What a lesson page fetches before any program: the element's own script, and those of the reader.
#[test]
fn the_readers_scripts_are_small() {
    let element = gzip(&built("fabrica-viewer.js"));
    println!("fabrica-viewer.js: {element} gzip");
    assert!(element <= 4096, "{element} bytes (gzip)");
    let folder = super::harness::dist().join("reader");
    let scripts = std::fs::read_dir(folder).expect("the reader's scripts");
    let sum: usize = scripts
        .map(|entry| {
            brotli(
                &std::fs::read(entry.expect("a file").path()).expect("a script"),
                11,
            )
        })
        .sum();
    let program: usize = ["fabrica_reader_bg.wasm", "fabrica_reader.js"]
        .map(|name| brotli(&built(name), 11))
        .iter()
        .sum();
    println!(
        "the reader with its scripts: {} brotli (quality 11)",
        sum + program
    );
    assert!(
        sum + program <= 600_000,
        "{sum} and {program} bytes (brotli)"
    );
}

/// The names of the program's functions are for debugging and not for visitors.
#[test]
fn no_names_of_functions_are_shipped() {
    for program in &PROGRAMS {
        let module = built(&format!("{}_bg.wasm", program.name));
        let shipped = shipped_names(&module);
        assert_eq!(shipped, None, "{}", program.name);
    }

    // The negative controls: names of the program, and too many of whomever.
    let planted = |section: &str, names: &[u8]| shipped_names(&made_up_module(section, names));
    assert_eq!(planted("name", b"__wbindgen_malloc"), None, "an adapter");
    let by_name = planted("name", b"\x03fabrica::x");
    assert!(by_name.is_some_and(|found| found.contains("names functions")));
    let elsewhere = planted("linking", b"fabrica::x");
    assert!(elsewhere.is_some_and(|found| found.contains("names functions")));
    assert_eq!(planted("name", &[b'a'; MOST_BYTES]), None, "just as many");
    let by_length = planted("name", &[b'a'; MOST_BYTES + 1]);
    assert!(by_length.is_some_and(|found| found.contains("bytes of names")));
}

/// Bytes of a name section at most: wasm-bindgen writes some 20 kB of names of its own adapters.
const MOST_BYTES: usize = 32 << 10;

/// What a module ships of the names of functions, if it does.
fn shipped_names(module: &[u8]) -> Option<String> {
    custom_sections(module)
        .into_iter()
        .find_map(|(name, bytes)| {
            if name == "name" && bytes.len() > MOST_BYTES {
                return Some(format!("{} bytes of names", bytes.len()));
            }
            let is_ours = bytes.windows(9).any(|part| part == b"fabrica::");
            is_ours.then(|| format!("section “{name}” names functions"))
        })
}

/// A module of one custom section.
fn made_up_module(name: &str, content: &[u8]) -> Vec<u8> {
    fn number(mut value: usize) -> Vec<u8> {
        let mut bytes = Vec::new();
        while value >= 0x80 {
            bytes.push(value as u8 | 0x80);
            value >>= 7;
        }
        bytes.push(value as u8);
        bytes
    }
    let section = [&number(name.len()), name.as_bytes(), content].concat();
    [b"\0asm\x01\0\0\0\0", &*number(section.len()), &section].concat()
}

/// The custom sections of a WebAssembly module, by name.
fn custom_sections(module: &[u8]) -> Vec<(String, &[u8])> {
    fn number(bytes: &mut &[u8]) -> usize {
        let (mut value, mut shift) = (0, 0);
        loop {
            let (&byte, rest) = bytes.split_first().expect("the module goes on");
            *bytes = rest;
            value |= usize::from(byte & 0x7f) << shift;
            shift += 7;
            if byte < 0x80 {
                return value;
            }
        }
    }
    let mut sections = Vec::new();
    let mut rest = module
        .strip_prefix(b"\0asm\x01\0\0\0")
        .expect("a module of version 1");
    while let Some((&kind, after)) = rest.split_first() {
        rest = after;
        let length = number(&mut rest);
        let (mut section, after) = rest.split_at(length);
        rest = after;
        if kind == 0 {
            let length = number(&mut section);
            let (name, content) = section.split_at(length);
            sections.push((String::from_utf8_lossy(name).into_owned(), content));
        }
    }
    sections
}

fn built(name: &str) -> Vec<u8> {
    let dist = Path::new(env!("CARGO_MANIFEST_DIR")).join("dist");
    std::fs::read(dist.join(name)).unwrap_or_else(|error| {
        panic!(
            "dist/{name}: {error}. The page is not built: run `cargo xtask test`, or `trunk build`"
        )
    })
}

fn shown([raw, gzip, quality_9, quality_11]: [usize; 4]) -> String {
    format!(
        "{raw} bytes raw, {gzip} gzip, {quality_9} brotli (quality 9), {quality_11} brotli (quality 11)"
    )
}

fn gzip(bytes: &[u8]) -> usize {
    let mut encoder = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::new(6));
    encoder.write_all(bytes).expect("a vector takes bytes");
    encoder.finish().expect("a vector takes bytes").len()
}

fn brotli(bytes: &[u8], quality: u32) -> usize {
    let mut out = Vec::new();
    let mut reader = brotli::CompressorReader::new(bytes, 1 << 16, quality, 22);
    std::io::copy(&mut reader, &mut out).expect("a vector takes bytes");
    out.len()
}
