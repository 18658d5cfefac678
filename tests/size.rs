//! What a visitor downloads. Fails above a ceiling, so that growth is a decision.
#![cfg(feature = "app")]

use std::io::Write as _;
use std::path::Path;

/// Ceiling for the program and its script together, compressed by brotli as servers do (quality 9).
const BROTLI_CEILING: usize = 1_650_000;
/// What is aimed at.
const BROTLI_AIM: usize = 1_500_000;

#[test]
fn page_stays_under_its_ceiling() {
    let dist = Path::new(env!("CARGO_MANIFEST_DIR")).join("dist");
    let mut total = [0; 3];
    for name in ["fabrica_bg.wasm", "fabrica.js"] {
        let bytes = std::fs::read(dist.join(name)).unwrap_or_else(|error| {
            panic!("dist/{name}: {error}. The page is not built: run `cargo xtask test`, or `trunk build`")
        });
        let sizes = [bytes.len(), gzip(&bytes), brotli(&bytes)];
        println!(
            "{name}: {} bytes raw, {} gzip, {} brotli",
            sizes[0], sizes[1], sizes[2]
        );
        for (sum, size) in total.iter_mut().zip(sizes) {
            *sum += size;
        }
    }
    println!(
        "together: {} bytes raw, {} gzip, {} brotli (aim {BROTLI_AIM}, ceiling {BROTLI_CEILING})",
        total[0], total[1], total[2]
    );
    assert!(
        total[2] <= BROTLI_CEILING,
        "the page has grown to {} bytes (brotli), the ceiling is {BROTLI_CEILING}",
        total[2]
    );
}

fn gzip(bytes: &[u8]) -> usize {
    let mut encoder = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::new(6));
    encoder.write_all(bytes).expect("a vector takes bytes");
    encoder.finish().expect("a vector takes bytes").len()
}

fn brotli(bytes: &[u8]) -> usize {
    let mut out = Vec::new();
    let mut reader = brotli::CompressorReader::new(bytes, 1 << 16, 9, 22);
    std::io::copy(&mut reader, &mut out).expect("a vector takes bytes");
    out.len()
}
