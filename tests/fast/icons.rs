//! The sheet of icons that ships with the program has a tile for every kind of the catalogue. A test with a GPU finds
//! tiles that are out of date.

use crate::palette::{Rgba, palette};
use fabrica::placed::{ICON_COLUMNS, ICON_PX, icon_kinds};

#[test]
fn every_kind_of_the_catalogue_has_a_tile() {
    let png = include_bytes!("../../src/app/panel/catalogue.png");
    let mut packed = Vec::new();
    let all = brotli::enc::BrotliEncoderParams::default();
    brotli::BrotliCompress(&mut &png[..], &mut packed, &all).expect("it is packed");
    assert!(
        packed.len() < 64_000,
        "{} bytes in every page",
        packed.len()
    );
    let sheet = image::load_from_memory(png).expect("a PNG").to_rgba8();
    let count = icon_kinds().count() as u32;
    let rows = count.div_ceil(ICON_COLUMNS);
    let size = (ICON_COLUMNS * ICON_PX, rows * ICON_PX);
    assert_eq!(sheet.dimensions(), size, "run `cargo xtask icons`");
    let mut tiles: Vec<Vec<u8>> = Vec::new();
    for (index, kind) in (0..).zip(icon_kinds()) {
        let corner = (
            index % ICON_COLUMNS * ICON_PX,
            index / ICON_COLUMNS * ICON_PX,
        );
        let tile = image::imageops::crop_imm(&sheet, corner.0, corner.1, ICON_PX, ICON_PX);
        let tile = tile.to_image();
        let solid = tile.pixels().filter(|pixel| pixel.0[3] > 128).count();
        let share = solid as f32 / (ICON_PX * ICON_PX) as f32;
        assert!((0.2..0.9).contains(&share), "{kind:?} covers {share}");
        let pixels = tile.into_raw();
        let earlier = tiles.iter().position(|other| *other == pixels);
        assert_eq!(earlier, None, "{kind:?} looks like an earlier one");
        tiles.push(pixels);
    }
}

/// Few colours stay as they are, clear ones too; of many the most frequent does.
#[test]
fn palettes_stand_for_their_colours() {
    let few: Vec<Rgba> = vec![[0; 4], [200, 10, 30, 255], [200, 10, 30, 128], [0; 4]];
    let (colors, index_of) = palette(&few);
    for pixel in &few {
        let stands = colors[usize::from(index_of[pixel])];
        let off = pixel.iter().zip(stands).map(|(a, b)| a.abs_diff(b)).max();
        assert!(off <= Some(1), "{pixel:?} is {stands:?}");
    }
    let mut many: Vec<Rgba> = (0..4096u32)
        .map(|i| [(i % 64 * 4) as u8, (i / 64 * 4) as u8, 90, 255])
        .collect();
    many.extend([[255; 4]; 9000]);
    let (colors, index_of) = palette(&many);
    assert_eq!(colors.len(), 256);
    assert_eq!(colors[usize::from(index_of[&[255; 4]])], [255; 4]);
    let off = many.iter().map(|pixel| {
        let stands = colors[usize::from(index_of[pixel])];
        let pairs = pixel.iter().zip(stands);
        pairs
            .map(|(a, b)| u32::from(a.abs_diff(b)).pow(2))
            .sum::<u32>()
    });
    assert!(off.max() < Some(20 * 20), "the nearest of 256 is near");
}
