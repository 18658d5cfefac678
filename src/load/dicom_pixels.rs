//! From the pixels of a DICOM file to plain bytes, frame by frame: unpacked, low byte first, without the bits that do
//! not count, colours as brightness (PS3.3, "Image Pixel Module"; PS3.5, section 8 and annexes A and G).

use super::ElementType;
use super::dicom_codecs;
use super::dicom_data::{Item, Parsed, tag};

/// Pixels in a row or column at most, and bytes that a packed frame may unpack to beyond 64 times its own.
const MAX_UNPACKED_EXTRA: u64 = 64 << 20;

/// How the pixels of a file are written.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct PixelFormat {
    pub(crate) rows: u32,
    pub(crate) columns: u32,
    pub(crate) element: ElementType,
    /// What each pixel is.
    pub(crate) color: Color,
    bits_allocated: u16,
    bits_stored: u16,
    high_bit: u16,
    is_signed: bool,
    is_planar: bool,
    is_big_endian: bool,
    packing: Packing,
}

#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Color {
    Gray,
    /// Red, green and blue samples.
    Rgb,
    /// Brightness and two differences of colour.
    Ybr,
    /// As `Ybr`, with half the columns for the differences.
    Ybr422,
    /// Numbers of colours: the brightness of each, and the first number.
    Palette(Vec<u8>, u16),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Packing {
    Native,
    Rle,
    Jpeg,
    JpegLs,
    Jpeg2000,
}

/// What a transfer syntax is called, for those that are not read.
fn syntax_name(uid: &str) -> &'static str {
    match uid {
        "1.2.840.10008.1.2.4.92" | "1.2.840.10008.1.2.4.93" => "JPEG 2000 in several components",
        "1.2.840.10008.1.2.4.110" | "1.2.840.10008.1.2.4.111" | "1.2.840.10008.1.2.4.112" => {
            "JPEG XL"
        }
        "1.2.840.10008.1.2.4.201" | "1.2.840.10008.1.2.4.202" | "1.2.840.10008.1.2.4.203" => {
            "High-Throughput JPEG 2000"
        }
        _ if uid.starts_with("1.2.840.10008.1.2.4.10") => "MPEG video",
        _ => "an unknown transfer syntax",
    }
}

fn packing(uid: &str) -> Result<Packing, String> {
    Ok(match uid {
        ""
        | "1.2.840.10008.1.2"
        | "1.2.840.10008.1.2.1"
        | "1.2.840.10008.1.2.1.99"
        | "1.2.840.10008.1.2.2" => Packing::Native,
        "1.2.840.10008.1.2.5" => Packing::Rle,
        "1.2.840.10008.1.2.4.50"
        | "1.2.840.10008.1.2.4.51"
        | "1.2.840.10008.1.2.4.57"
        | "1.2.840.10008.1.2.4.70" => Packing::Jpeg,
        "1.2.840.10008.1.2.4.80" | "1.2.840.10008.1.2.4.81" => Packing::JpegLs,
        "1.2.840.10008.1.2.4.90" | "1.2.840.10008.1.2.4.91" => Packing::Jpeg2000,
        _ => {
            let uid: String = uid
                .chars()
                .filter(|c| c.is_ascii_digit() || *c == '.')
                .collect();
            return Err(format!(
                "its pixels are packed as {} ({uid}), which is not read: save it uncompressed (gdcmconv or dcmconv do)",
                syntax_name(&uid)
            ));
        }
    })
}

impl PixelFormat {
    /// Reads the layout from a data set; an error tells in words what cannot be drawn.
    pub(crate) fn of(parsed: &Parsed) -> Result<Self, String> {
        let root = &parsed.root;
        let packing = packing(&parsed.syntax_uid)?;
        let (rows, columns) = (
            root.short(tag::ROWS).unwrap_or(0),
            root.short(tag::COLUMNS).unwrap_or(0),
        );
        if rows == 0 || columns == 0 {
            return Err("it says nothing of rows and columns".to_owned());
        }
        let samples = root.short(tag::SAMPLES).unwrap_or(1);
        let is_float = parsed.pixels.tag == tag::FLOAT_PIXELS;
        let is_double = parsed.pixels.tag == tag::DOUBLE_PIXELS;
        let bits_allocated = match (is_float, is_double) {
            (true, _) => 32,
            (_, true) => 64,
            _ => root.short(tag::BITS_ALLOCATED).unwrap_or(16),
        };
        let bits_stored = root.short(tag::BITS_STORED).unwrap_or(bits_allocated);
        let high_bit = root
            .short(tag::HIGH_BIT)
            .unwrap_or(bits_stored.saturating_sub(1));
        let is_signed = root.short(tag::IS_SIGNED) == Some(1);
        let element = match (bits_allocated, is_signed) {
            _ if is_float => ElementType::F32,
            _ if is_double => ElementType::F64,
            (1, _) | (8, false) => ElementType::U8,
            (8, true) => ElementType::I8,
            (16, false) => ElementType::U16,
            (16, true) => ElementType::I16,
            (32, false) => ElementType::U32,
            (32, true) => ElementType::I32,
            _ => {
                return Err(format!(
                    "its pixels have {bits_allocated} bits, which is not read"
                ));
            }
        };
        if bits_stored == 0
            || bits_stored > bits_allocated
            || high_bit >= bits_allocated
            || high_bit + 1 < bits_stored
        {
            return Err(format!(
                "of {bits_allocated} bits of a pixel, {bits_stored} up to bit {high_bit} cannot count"
            ));
        }
        let photometric = root.text(tag::PHOTOMETRIC).unwrap_or_default();
        let color = match (samples, photometric.as_str()) {
            (1, "PALETTE COLOR") => palette(root)?,
            (1, _) => Color::Gray,
            (3, "YBR_FULL") => Color::Ybr,
            (3, "YBR_FULL_422") if packing == Packing::Native => Color::Ybr422,
            (3, "RGB" | "YBR_FULL_422" | "YBR_RCT" | "YBR_ICT") => Color::Rgb,
            _ => {
                let name: String = photometric
                    .chars()
                    .filter(char::is_ascii_graphic)
                    .take(20)
                    .collect();
                return Err(format!("pixels of {samples} samples ({name}) are not read"));
            }
        };
        if color != Color::Gray && !matches!(bits_allocated, 8 | 16) {
            return Err(format!("colours of {bits_allocated} bits are not read"));
        }
        Ok(Self {
            rows: rows.into(),
            columns: columns.into(),
            element,
            color,
            bits_allocated,
            bits_stored,
            high_bit,
            is_signed,
            is_planar: samples > 1 && root.short(tag::PLANAR) == Some(1),
            is_big_endian: parsed.syntax_uid == "1.2.840.10008.1.2.2",
            packing,
        })
    }

    fn samples(&self) -> u64 {
        match self.color {
            Color::Gray | Color::Palette(..) => 1,
            Color::Ybr422 => 2,
            Color::Rgb | Color::Ybr => 3,
        }
    }

    /// The type in which frames come.
    pub(crate) fn comes_as(&self) -> ElementType {
        match self.color {
            Color::Gray => self.element,
            Color::Rgb | Color::Ybr | Color::Ybr422 | Color::Palette(..) => ElementType::U8,
        }
    }

    fn pixels(&self) -> u64 {
        u64::from(self.rows) * u64::from(self.columns)
    }

    /// Bits of one frame, unpacked.
    fn frame_bits(&self) -> u64 {
        self.pixels() * self.samples() * u64::from(self.bits_allocated)
    }

    /// One frame of a file as bytes of [`Self::comes_as`], low byte first, rows after each other from the top.
    pub(crate) fn frame(
        &self,
        bytes: &[u8],
        parsed: &Parsed,
        index: u64,
        count: u64,
    ) -> Result<Vec<u8>, FrameFault> {
        let mut frame = match (self.packing, parsed.pixels.native) {
            (Packing::Native, Some((start, end))) => self.native(bytes, start, end, index)?,
            (Packing::Native, None) | (_, Some(_)) => {
                return Err(FrameFault::Other(
                    "its pixels are not packed as its transfer syntax says".to_owned(),
                ));
            }
            (_, None) => {
                let packed = fragments(bytes, parsed, index, count)?;
                let most = self.frame_bits() / 8;
                if most > 64 * packed.len() as u64 + MAX_UNPACKED_EXTRA {
                    return Err(FrameFault::Other(
                        "its pixels are too few bytes for its rows and columns".to_owned(),
                    ));
                }
                let image = dicom_codecs::Image {
                    columns: self.columns,
                    rows: self.rows,
                    samples: self.samples(),
                    bits_allocated: self.bits_allocated,
                };
                match self.packing {
                    Packing::Rle => self.rle(&packed)?,
                    Packing::Jpeg => dicom_codecs::jpeg(&packed, &image)?,
                    Packing::JpegLs => dicom_codecs::jpeg_ls(&packed, &image)?,
                    Packing::Jpeg2000 | Packing::Native => dicom_codecs::jpeg2000(&packed, &image)?,
                }
            }
        };
        if self.bits_allocated == 1 {
            return Ok(frame);
        }
        if self.is_planar && self.packing == Packing::Native {
            frame = interleave(
                &frame,
                self.samples() as usize,
                usize::from(self.bits_allocated / 8),
            );
        }
        self.cut_bits(&mut frame);
        Ok(self.brightness(frame))
    }

    fn native(
        &self,
        bytes: &[u8],
        start: usize,
        end: usize,
        index: u64,
    ) -> Result<Vec<u8>, FrameFault> {
        let there = bytes.get(start..end.min(bytes.len())).unwrap_or_default();
        let bits = self.frame_bits();
        let short = || FrameFault::Short {
            expected: (index + 1).saturating_mul(bits).div_ceil(8),
            found: there.len() as u64,
        };
        let first = index.checked_mul(bits).ok_or_else(short)?;
        let last = first.checked_add(bits).ok_or_else(short)?;
        if last.div_ceil(8) > there.len() as u64 {
            return Err(short());
        }
        if self.bits_allocated == 1 {
            // Frames follow each other bit by bit, the lowest bit first.
            let bit = |i: u64| (there[(i / 8) as usize] >> (i % 8)) & 1;
            return Ok((first..last).map(bit).collect());
        }
        let mut frame = there[(first / 8) as usize..(last / 8) as usize].to_vec();
        if self.is_big_endian {
            match self.bits_allocated {
                16 => frame
                    .as_chunks_mut::<2>()
                    .0
                    .iter_mut()
                    .for_each(|b| b.reverse()),
                32 => frame
                    .as_chunks_mut::<4>()
                    .0
                    .iter_mut()
                    .for_each(|b| b.reverse()),
                64 => frame
                    .as_chunks_mut::<8>()
                    .0
                    .iter_mut()
                    .for_each(|b| b.reverse()),
                _ => {}
            }
        }
        Ok(frame)
    }

    /// PS3.5, annex G: a run-length code per byte of a sample, the high bytes first.
    fn rle(&self, packed: &[u8]) -> Result<Vec<u8>, FrameFault> {
        let wrong = |what: &str| FrameFault::Other(format!("its run-length code {what}"));
        let (words, _) = packed.as_chunks::<4>();
        let word = |i: usize| {
            words
                .get(i)
                .map_or(0, |&word| u32::from_le_bytes(word) as usize)
        };
        let bytes = usize::from(self.bits_allocated / 8);
        let samples = self.samples() as usize;
        if word(0) != bytes * samples || word(0) > 15 {
            return Err(wrong(
                "has another number of parts than its pixels have bytes",
            ));
        }
        let pixels = self.pixels() as usize;
        let mut frame = vec![0; pixels * bytes * samples];
        for part in 0..word(0) {
            let start = word(1 + part);
            let end = if part + 1 < word(0) {
                word(2 + part)
            } else {
                packed.len()
            };
            let code = packed
                .get(start..end)
                .ok_or_else(|| wrong("has parts beyond its end"))?;
            let (sample, byte) = (part / bytes, bytes - 1 - part % bytes);
            let mut put = frame
                .iter_mut()
                .skip(sample * bytes + byte)
                .step_by(bytes * samples);
            let mut left = pixels;
            let mut at = 0;
            while left > 0 {
                let Some(&control) = code.get(at) else {
                    return Err(wrong("ends too soon"));
                };
                at += 1;
                let control = control as i8;
                if control >= 0 {
                    let n = (control as usize + 1).min(left);
                    let run = code.get(at..at + n).ok_or_else(|| wrong("ends too soon"))?;
                    run.iter().zip(&mut put).for_each(|(&from, to)| *to = from);
                    at += control as usize + 1;
                    left -= n;
                } else if control != i8::MIN {
                    let n = (1 - isize::from(control)).unsigned_abs().min(left);
                    let &value = code.get(at).ok_or_else(|| wrong("ends too soon"))?;
                    put.by_ref().take(n).for_each(|to| *to = value);
                    at += 1;
                    left -= n;
                }
            }
        }
        Ok(frame)
    }

    /// Takes away the bits that do not count, and spreads the sign.
    fn cut_bits(&self, frame: &mut [u8]) {
        if self.bits_stored == self.bits_allocated
            || matches!(self.element, ElementType::F32 | ElementType::F64)
        {
            return;
        }
        let shift = self.high_bit + 1 - self.bits_stored;
        let cut = |value: u32| {
            let low = (value >> shift) & (u32::MAX >> (32 - self.bits_stored));
            let sign = 1u32 << (self.bits_stored - 1);
            if self.is_signed && low & sign != 0 {
                low | !(sign | (sign - 1))
            } else {
                low
            }
        };
        match self.bits_allocated {
            8 => frame
                .iter_mut()
                .for_each(|byte| *byte = cut((*byte).into()) as u8),
            16 => frame.as_chunks_mut::<2>().0.iter_mut().for_each(|bytes| {
                *bytes = (cut(u16::from_le_bytes(*bytes).into()) as u16).to_le_bytes();
            }),
            32 => frame.as_chunks_mut::<4>().0.iter_mut().for_each(|bytes| {
                *bytes = cut(u32::from_le_bytes(*bytes)).to_le_bytes();
            }),
            _ => {}
        }
    }

    /// Colours as brightness, a byte each: the luma of ITU-R BT.709 of red, green and blue, or the brightness as
    /// stored.
    fn brightness(&self, frame: Vec<u8>) -> Vec<u8> {
        // Of samples of 16 bits, the high byte is enough.
        let bytes = usize::from(self.bits_allocated / 8);
        let sample = |pixel: &[u8], i: usize| pixel.get((i + 1) * bytes - 1).copied().unwrap_or(0);
        match &self.color {
            Color::Gray => frame,
            Color::Rgb => frame
                .chunks_exact(3 * bytes)
                .map(|p| luma([sample(p, 0), sample(p, 1), sample(p, 2)]))
                .collect(),
            Color::Ybr => frame
                .chunks_exact(3 * bytes)
                .map(|p| sample(p, 0))
                .collect(),
            // Two brightnesses and two differences for every two pixels.
            Color::Ybr422 => frame
                .chunks_exact(4 * bytes)
                .flat_map(|p| [sample(p, 0), sample(p, 1)])
                .chain(std::iter::repeat(0))
                .take(self.pixels() as usize)
                .collect(),
            Color::Palette(table, first) => {
                let number = |pixel: &[u8]| match *pixel {
                    [low, high] => u16::from_le_bytes([low, high]),
                    _ => u16::from(pixel.first().copied().unwrap_or(0)),
                };
                let entry = |number: u16| {
                    let index = usize::from(number.saturating_sub(*first));
                    table.get(index).or(table.last()).copied().unwrap_or(0)
                };
                frame
                    .chunks_exact(bytes)
                    .map(|p| entry(number(p)))
                    .collect()
            }
        }
    }
}

fn luma([red, green, blue]: [u8; 3]) -> u8 {
    (0.2126 * f32::from(red) + 0.7152 * f32::from(green) + 0.0722 * f32::from(blue)).round() as u8
}

/// The brightness of each colour of a palette.
fn palette(root: &Item) -> Result<Color, String> {
    let sizes = root.shorts(tag::RED_SIZE);
    let (&[count, first, bits], false) = (
        <&[u16; 3]>::try_from(sizes.as_slice()).unwrap_or(&[0, 0, 0]),
        sizes.len() != 3,
    ) else {
        return Err("its palette of colours is not told".to_owned());
    };
    let count = if count == 0 {
        65_536
    } else {
        usize::from(count)
    };
    let part = |tag| -> Vec<u8> {
        let words = root.shorts(tag);
        let packed = root.bytes(tag).unwrap_or_default();
        if bits == 8 && packed.len() >= count && words.len() < count {
            packed.to_vec()
        } else if bits == 8 && words.iter().all(|&word| word < 256) {
            words.iter().map(|&word| word as u8).collect()
        } else {
            words.iter().map(|&word| (word >> 8) as u8).collect()
        }
    };
    let (red, green, blue) = (part(tag::RED), part(tag::GREEN), part(tag::BLUE));
    let colors = red.iter().zip(&green).zip(&blue).take(count);
    let table: Vec<u8> = colors.map(|((&r, &g), &b)| luma([r, g, b])).collect();
    if table.is_empty() {
        return Err("its palette of colours is empty".to_owned());
    }
    Ok(Color::Palette(table, first))
}

/// Why a frame did not come.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum FrameFault {
    /// Bytes of pixels are missing.
    Short { expected: u64, found: u64 },
    /// Any other fault, in plain words.
    Other(String),
}

impl From<String> for FrameFault {
    fn from(words: String) -> Self {
        Self::Other(words)
    }
}

/// The packed bytes of one frame.
fn fragments(bytes: &[u8], parsed: &Parsed, index: u64, count: u64) -> Result<Vec<u8>, FrameFault> {
    let all = &parsed.pixels.fragments;
    let (table, parts) = all
        .split_first()
        .ok_or_else(|| FrameFault::Other("it has no pixels".to_owned()))?;
    let of = |part: &(usize, usize)| bytes.get(part.0..part.1).unwrap_or_default();
    let missing = || {
        FrameFault::Other(format!(
            "the packed pixels of image {} of {count} are missing",
            index + 1
        ))
    };
    if count == 1 {
        return Ok(parts.iter().flat_map(of).copied().collect());
    }
    if parts.len() as u64 == count {
        return Ok(of(parts.get(index as usize).ok_or_else(missing)?).to_vec());
    }
    // The table tells where each frame begins, counted from the first fragment's head.
    let (offsets, _) = of(table).as_chunks::<4>();
    let offset = |i: u64| {
        offsets
            .get(usize::try_from(i).ok()?)
            .map(|&word| u32::from_le_bytes(word) as usize)
    };
    let origin = parts.first().map_or(0, |part| part.0.saturating_sub(8));
    let start = offset(index).ok_or_else(missing)?;
    let end = offset(index + 1).unwrap_or(usize::MAX);
    let of_frame = parts
        .iter()
        .filter(|part| (start..end).contains(&(part.0.saturating_sub(8) - origin)));
    let packed: Vec<u8> = of_frame.flat_map(of).copied().collect();
    if packed.is_empty() {
        Err(missing())
    } else {
        Ok(packed)
    }
}

/// Samples one plane after the other, put side by side.
fn interleave(frame: &[u8], samples: usize, bytes: usize) -> Vec<u8> {
    let plane = frame.len() / samples;
    let mut out = Vec::with_capacity(frame.len());
    for pixel in (0..plane).step_by(bytes.max(1)) {
        for sample in 0..samples {
            let at = sample * plane + pixel;
            out.extend_from_slice(frame.get(at..at + bytes).unwrap_or_default());
        }
    }
    out
}
