//! Files of small pictures, whose pixels are known: PNG of any kind, JPEG of flat blocks, and a GLB of a plate.

#![allow(dead_code, reason = "each test uses a part of it")]

use std::io::Write as _;

fn chunk(file: &mut Vec<u8>, kind: &[u8; 4], data: &[u8]) {
    file.extend((data.len() as u32).to_be_bytes());
    let start = file.len();
    file.extend(kind);
    file.extend(data);
    let mut crc = flate2::Crc::new();
    crc.update(&file[start..]);
    file.extend(crc.sum().to_be_bytes());
}

/// A PNG of rows that begin with their filter. `kind` is bit depth, colour type and 1 for Adam7; `chunks` stand before
/// the pixels.
pub(crate) fn png(
    size: [u32; 2],
    [depth, color, interlace]: [u8; 3],
    chunks: &[(&[u8; 4], &[u8])],
    rows: &[u8],
) -> Vec<u8> {
    let mut file = b"\x89PNG\r\n\x1a\n".to_vec();
    let mut header = size.map(u32::to_be_bytes).concat();
    header.extend([depth, color, 0, 0, interlace]);
    chunk(&mut file, b"IHDR", &header);
    for (kind, data) in chunks {
        chunk(&mut file, kind, data);
    }
    let mut packed = flate2::write::ZlibEncoder::new(Vec::new(), flate2::Compression::new(6));
    packed.write_all(rows).expect("a vector takes bytes");
    chunk(
        &mut file,
        b"IDAT",
        &packed.finish().expect("a vector takes bytes"),
    );
    chunk(&mut file, b"IEND", &[]);
    file
}

/// A PNG of red, green and blue, by column and row.
pub(crate) fn rgb_png(size: [u32; 2], color: impl Fn(u32, u32) -> [u8; 3]) -> Vec<u8> {
    let mut rows = Vec::new();
    for y in 0..size[1] {
        rows.push(0);
        rows.extend((0..size[0]).flat_map(|x| color(x, y)));
    }
    png(size, [8, 2, 0], &[], &rows)
}

/// A JPEG of flat blocks of 8 × 8 pixels: `value` has the sample of a component, by its index, in a block. `ids` are
/// the numbers of the components, and `segments` stand behind the first marker. `frame` is the marker of the frame
/// (0xc0 is baseline) and the bits of a sample.
pub(crate) fn jpeg(
    size: [u16; 2],
    ids: &[u8],
    (frame, bits): (u8, u8),
    segments: &[(u8, &[u8])],
    value: impl Fn(usize, u16, u16) -> u8,
) -> Vec<u8> {
    let mut file = vec![0xff, 0xd8];
    let mut segment = |marker: u8, data: &[u8]| {
        file.extend([0xff, marker]);
        file.extend((data.len() as u16 + 2).to_be_bytes());
        file.extend(data);
    };
    for (marker, data) in segments {
        segment(*marker, data);
    }
    segment(0xdb, &[&[0][..], &[1; 64]].concat());
    let [width, height] = size.map(u16::to_be_bytes);
    let mut described = vec![
        bits,
        height[0],
        height[1],
        width[0],
        width[1],
        ids.len() as u8,
    ];
    described.extend(ids.iter().flat_map(|&id| [id, 0x11, 0]));
    segment(frame, &described);
    // Twelve codes of four bits for the size of a difference; one bit for the end of a block.
    let counts = |length: usize, count: u8| {
        let mut counts = [0; 16];
        counts[length - 1] = count;
        counts
    };
    let sizes: Vec<u8> = (0..12).collect();
    segment(0xc4, &[&[0x00][..], &counts(4, 12), &sizes].concat());
    segment(0xc4, &[&[0x10][..], &counts(1, 1), &[0]].concat());
    let mut scan = vec![ids.len() as u8];
    scan.extend(ids.iter().flat_map(|&id| [id, 0]));
    scan.extend([0, 63, 0]);
    segment(0xda, &scan);
    let mut written = Vec::new();
    let mut write = |value: u32, count: u32| {
        written.extend((0..count).rev().map(|bit| (value >> bit & 1) as u8));
    };
    let mut before = vec![0_i32; ids.len()];
    for y in 0..size[1].div_ceil(8) {
        for x in 0..size[0].div_ceil(8) {
            for (component, before) in before.iter_mut().enumerate() {
                let mean = 8 * (i32::from(value(component, x, y)) - 128);
                let change = mean - *before;
                *before = mean;
                let count = 32 - change.unsigned_abs().leading_zeros();
                write(count, 4);
                let low = if change < 0 { change - 1 } else { change };
                write(low as u32 & ((1 << count) - 1), count);
                write(0, 1);
            }
        }
    }
    for eight in written.chunks(8) {
        let byte = (0..8).fold(0, |byte, i| byte << 1 | eight.get(i).unwrap_or(&1));
        file.push(byte);
        if byte == 0xff {
            file.push(0);
        }
    }
    file.extend([0xff, 0xd9]);
    file
}

/// A GLB of a square plate of 1 m in the plane of x and y, seen from +z: u to the right, v down, `repeats` pictures
/// along each. `changes` are put into its description, by pointer.
pub(crate) fn plate(
    picture: &[u8],
    mime: &str,
    repeats: f32,
    changes: &[(&str, serde_json::Value)],
) -> Vec<u8> {
    let floats = |values: &[f32]| -> Vec<u8> {
        values
            .iter()
            .flat_map(|value| value.to_le_bytes())
            .collect()
    };
    let mut bytes = floats(&[0., 0., 0., 1., 0., 0., 1., 1., 0., 0., 1., 0.]);
    let r = repeats;
    bytes.extend(floats(&[0., r, r, r, r, 0., 0., 0.]));
    bytes.extend([0_u16, 1, 2, 0, 2, 3].iter().flat_map(|i| i.to_le_bytes()));
    bytes.extend(picture);
    bytes.resize(bytes.len().next_multiple_of(4), 0);
    let mut json = serde_json::json!({
        "asset": { "version": "2.0" },
        "scenes": [{ "nodes": [0] }],
        "nodes": [{ "mesh": 0 }],
        "meshes": [{ "primitives": [{
            "attributes": { "POSITION": 0, "TEXCOORD_0": 2 }, "indices": 1, "material": 0 }] }],
        "materials": [{ "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } } }],
        "textures": [{ "source": 0, "sampler": 0 }],
        "samplers": [{}],
        "images": [{ "bufferView": 3, "mimeType": mime }],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3" },
            { "bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR" },
            { "bufferView": 2, "componentType": 5126, "count": 4, "type": "VEC2" },
        ],
        "bufferViews": [
            { "buffer": 0, "byteLength": 48 },
            { "buffer": 0, "byteOffset": 80, "byteLength": 12 },
            { "buffer": 0, "byteOffset": 48, "byteLength": 32 },
            { "buffer": 0, "byteOffset": 92, "byteLength": picture.len() },
        ],
        "buffers": [{ "byteLength": bytes.len() }],
    });
    for (pointer, value) in changes {
        let (parent, key) = pointer.rsplit_once('/').expect("a pointer");
        json.pointer_mut(parent).expect("a parent")[key] = value.clone();
    }
    let mut text = json.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let mut file = b"glTF\x02\0\0\0".to_vec();
    file.extend((28 + text.len() as u32 + bytes.len() as u32).to_le_bytes());
    for (kind, chunk) in [(b"JSON", &text), (b"BIN\0", &bytes)] {
        file.extend((chunk.len() as u32).to_le_bytes());
        file.extend(kind);
        file.extend(chunk);
    }
    file
}
