//! The decoders of pictures: every kind, and hostile files.

use crate::data::data_folder;
use crate::picture_files::{jpeg, png, rgb_png};
use crate::scans::{Random, rounds};
use fabrica::pictures::{MAX_FILE_BYTES, Picture, PictureError, PictureHeader, decode};

const BASELINE: (u8, u8) = (0xc0, 8);
const YCBCR: &[u8] = &[1, 2, 3];

fn pixels(file: &[u8]) -> Vec<[u8; 4]> {
    let picture = decode(file).unwrap_or_else(|error| panic!("{error}"));
    let [width, height] = picture.size;
    assert_eq!(picture.pixels.len(), (width * height) as usize);
    assert_eq!(
        PictureHeader::of(file).expect("a header").size,
        picture.size
    );
    picture.pixels
}

#[test]
fn every_kind_of_png_is_read() {
    let gray = |v: u8| [v, v, v, 255];
    let bits = png([4, 1], [2, 0, 0], &[], &[0, 0b0001_1011]);
    assert_eq!(pixels(&bits), [0, 85, 170, 255].map(gray));
    let sixteen = png(
        [3, 1],
        [16, 0, 0],
        &[],
        &[0, 0x12, 0x34, 0x12, 0xa0, 0xff, 0x80],
    );
    assert_eq!(
        pixels(&sixteen),
        [18, 19, 255].map(gray),
        "rounded, not cut"
    );
    let clear = png([2, 1], [8, 4, 0], &[], &[0, 9, 255, 200, 0]);
    assert_eq!(pixels(&clear), [[9, 9, 9, 255], [200, 200, 200, 0]]);
    let palette: (&[u8; 4], &[u8]) = (b"PLTE", &[1, 2, 3, 4, 5, 6]);
    let colors = png(
        [2, 1],
        [1, 3, 0],
        &[palette, (b"tRNS", &[7])],
        &[0, 0b0100_0000],
    );
    assert_eq!(pixels(&colors), [[1, 2, 3, 7], [4, 5, 6, 255]]);
    let key: (&[u8; 4], &[u8]) = (b"tRNS", &[0, 1, 0, 2, 0, 3]);
    let keyed = png([2, 1], [8, 2, 0], &[key], &[0, 1, 2, 3, 1, 2, 4]);
    assert_eq!(pixels(&keyed), [[1, 2, 3, 0], [1, 2, 4, 255]]);
    let rgba = png([1, 1], [16, 6, 0], &[], &[0, 10, 0, 20, 0, 30, 0, 40, 0]);
    assert_eq!(pixels(&rgba), [[10, 20, 30, 40]]);
    // Passes 1, 6 and 7 of Adam7.
    let woven = png([2, 2], [8, 0, 1], &[], &[0, 1, 0, 2, 0, 3, 4]);
    assert_eq!(pixels(&woven), [1, 2, 3, 4].map(gray));
    // Of an animation the default image: the frame that is kept apart is another one.
    let frame: [u8; 26] = {
        let mut frame = [0; 26];
        (frame[7], frame[11], frame[21]) = (1, 1, 1);
        frame
    };
    let animated = png(
        [1, 1],
        [8, 0, 0],
        &[(b"acTL", &[0, 0, 0, 1, 0, 0, 0, 0]), (b"fcTL", &frame)],
        &[0, 77],
    );
    assert_eq!(pixels(&animated), [gray(77)]);
    let gamma = png([1, 1], [8, 0, 0], &[(b"gAMA", &[0, 0, 0, 1])], &[0, 77]);
    assert_eq!(pixels(&gamma), [gray(77)], "gamma is left aside");
}

#[test]
fn every_kind_of_jpeg_is_read() {
    let gray = jpeg([9, 8], &[1], BASELINE, &[], |_, x, _| {
        [200, 30][usize::from(x)]
    });
    let found = pixels(&gray);
    assert_eq!(
        (found[0], found[8]),
        ([200, 200, 200, 255], [30, 30, 30, 255])
    );
    let sample = |component: usize, _: u16, _: u16| [150, 100, 180][component];
    let by_formula = [
        150.0 + 1.402 * 52.0,
        150.0 + 0.344_136 * 28.0 - 0.714_136 * 52.0,
        150.0 - 1.772 * 28.0,
    ];
    let color = pixels(&jpeg([8, 8], YCBCR, BASELINE, &[], sample))[0];
    for (value, expected) in color.iter().zip(by_formula) {
        assert!((f64::from(*value) - expected).abs() <= 0.6, "{color:?}");
    }
    let rgb = pixels(&jpeg([8, 8], b"RGB", BASELINE, &[], sample));
    assert_eq!(rgb[0], [150, 100, 180, 255]);
    // Inks are stored inverted; black takes its part of what the others leave.
    let adobe: (u8, &[u8]) = (0xee, b"Adobe\0\x64\0\0\0\0\0");
    let inks = |component: usize, _: u16, _: u16| [255, 128, 0, 128][component];
    let file = jpeg([8, 8], &[1, 2, 3, 4], BASELINE, &[adobe], inks);
    let picture = decode(&file).expect("inks");
    assert!(picture.is_of_inks);
    assert_eq!(picture.pixels[0], [128, 64, 0, 255]);
    // An orientation is not followed.
    let turned: (u8, &[u8]) = (
        0xe1,
        b"Exif\0\0MM\0\x2a\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0\x06\0\0\0\0\0\0",
    );
    let upright = decode(&jpeg([16, 8], &[1], BASELINE, &[turned], |_, _, _| 9));
    assert_eq!(upright.expect("a picture").size, [16, 8]);
}

#[test]
fn what_is_no_picture_is_told() {
    let wide = |size| PictureHeader::of(&rgb_png([1, 1], |_, _| [0; 3]).with_size(size));
    assert_eq!(decode(b"GIF89a"), Err(PictureError::Unknown));
    assert_eq!(decode(b""), Err(PictureError::Unknown));
    assert_eq!(wide([0, 3]), Err(PictureError::Empty));
    for size in [[16_385, 1], [10_000, 4001], [u32::MAX, u32::MAX]] {
        assert_eq!(wide(size), Err(PictureError::TooLarge { size }));
        // Nothing is allocated that rests on the header.
        let file = rgb_png([1, 1], |_, _| [0; 3]).with_size(size);
        assert_eq!(decode(&file), Err(PictureError::TooLarge { size }));
    }
    let promising = rgb_png([1, 1], |_, _| [0; 3]).with_size([6000, 6000]);
    assert_eq!(
        decode(&promising),
        Err(PictureError::Broken("PNG")),
        "its check sum is off"
    );
    let unsupported = |file: &[u8]| matches!(decode(file), Err(PictureError::Unsupported(_)));
    let of = |frame| jpeg([8, 8], YCBCR, frame, &[], |_, _, _| 9);
    for frame in [(0xc3, 8), (0xc9, 8), (0xca, 8), (0xc1, 12)] {
        assert!(unsupported(&of(frame)), "{frame:?}");
    }
    assert!(decode(&of((0xc0, 8))).is_ok(), "the negative control");
    assert!(
        decode(&jpeg([8, 8], &[1, 2], BASELINE, &[], |_, _, _| 9)).is_err(),
        "two channels"
    );
    let mut endless = of((0xc2, 8));
    let scan = endless
        .windows(2)
        .rposition(|pair| pair == [0xff, 0xda])
        .expect("a scan");
    let scan = endless[scan..endless.len() - 2].to_vec();
    endless.truncate(endless.len() - 2);
    (0..300).for_each(|_| endless.extend(&scan));
    assert!(unsupported(&endless), "scans without end");
    let mut long = rgb_png([1, 1], |_, _| [0; 3]);
    long.resize(MAX_FILE_BYTES as usize + 1, 0);
    assert!(matches!(decode(&long), Err(PictureError::LargeFile { .. })));
}

trait WithSize {
    /// The same PNG with another size in its header.
    fn with_size(self, size: [u32; 2]) -> Self;
}

impl WithSize for Vec<u8> {
    fn with_size(mut self, size: [u32; 2]) -> Self {
        self[16..24].copy_from_slice(&size.map(u32::to_be_bytes).concat());
        self
    }
}

/// Files that are cut short or have wrong bytes give a picture of the size that they promise, or an error.
#[test]
fn broken_files_never_panic() {
    let files = [
        rgb_png([19, 7], |x, y| [x as u8 * 9, y as u8 * 30, 200]),
        png([2, 2], [8, 0, 1], &[], &[0, 1, 0, 2, 0, 3, 4]),
        png(
            [4, 4],
            [1, 3, 0],
            &[(b"PLTE", &[1; 6])],
            &[0, 0xa0, 0, 0x50, 0, 0, 0, 0xf0],
        ),
        jpeg([40, 24], YCBCR, BASELINE, &[], |c, x, y| {
            (60 * c as u16 + 20 * x + 9 * y) as u8
        }),
        jpeg([24, 24], &[1, 2, 3, 4], BASELINE, &[], |c, x, _| {
            (60 * c as u16 + 20 * x) as u8
        }),
    ];
    let mut random = Random(5);
    let (mut good, mut bad) = (0, 0);
    let mut take = |bytes: &[u8]| match decode(bytes) {
        Ok(Picture { size, pixels, .. }) => {
            assert_eq!(pixels.len(), (size[0] * size[1]) as usize);
            good += 1;
        }
        Err(error) => {
            assert!(!error.to_string().contains('\n'));
            bad += 1;
        }
    };
    for file in &files {
        for len in 0..file.len() {
            take(&file[..len]);
        }
        for _ in 0..rounds(300) {
            let mut flipped = file.clone();
            for _ in 0..=random.next() % 3 {
                let at = random.next() % flipped.len();
                flipped[at] = random.next() as u8;
            }
            // A PNG's pixels are behind check sums; those of its header and of its chunks are not looked at twice.
            take(&flipped);
        }
    }
    println!("{good} pictures, {bad} errors");
    assert!(good > 100 && bad > 100, "{good} pictures, {bad} errors");
}

/// FNV-1a over the pixels.
fn hash(picture: &Picture) -> u64 {
    let bytes = picture.pixels.as_flattened().iter();
    bytes.fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(*byte)).wrapping_mul(0x100_0000_01b3)
    })
}

/// The same pixels on every machine: natively here, in a page in the browser's tests.
#[test]
fn real_pictures_have_the_same_pixels_everywhere() {
    let Some(folder) = data_folder("real pictures have the same pixels everywhere") else {
        return;
    };
    let found = HASHES.map(|(name, ..)| {
        let bytes = std::fs::read(folder.join("image2d").join(name)).expect("a picture");
        let mut picture = decode(&bytes).unwrap_or_else(|error| panic!("{name}: {error}"));
        let own = hash(&picture);
        picture.pixels[7][1] ^= 1;
        assert_ne!(hash(&picture), own, "the negative control");
        (name, picture.size, own)
    });
    assert_eq!(found, HASHES);
}

const HASHES: [(&str, [u32; 2], u64); 1] = [("gray_Skull.jpg", [500, 503], 0xa207_14b9_498a_e029)];
