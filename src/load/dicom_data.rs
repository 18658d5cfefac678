//! A DICOM file as a tree of the few elements that say what its pixels are and where they lie (PS3.5, "Data Structures
//! and Encoding"; PS3.10 for the file around it). Everything else is stepped over unread: nothing that names a patient
//! is ever taken out of the file.

use std::borrow::Cow;
use std::io::Read as _;

use flate2::read::DeflateDecoder;

/// Sequences within sequences beyond this are not followed.
const MAX_DEPTH: u32 = 16;
/// Items and elements kept of one file: enough for twenty thousand frames.
const MAX_KEPT: u32 = 1 << 19;
/// A deflated data set may be this much larger than four times the file.
const MAX_INFLATED_EXTRA: usize = 64 << 20;

const ITEM: u32 = 0xFFFE_E000;
const ITEM_END: u32 = 0xFFFE_E00D;
const SEQUENCE_END: u32 = 0xFFFE_E0DD;
const UNDEFINED: u32 = u32::MAX;

/// Elements that are read, by the names of PS3.6.
pub(crate) mod tag {
    pub(crate) const TRANSFER_SYNTAX: u32 = 0x0002_0010;
    pub(crate) const SOP_CLASS: u32 = 0x0008_0016;
    pub(crate) const MODALITY: u32 = 0x0008_0060;
    pub(crate) const ECHO_TIME: u32 = 0x0018_0081;
    pub(crate) const SLICE_THICKNESS: u32 = 0x0018_0050;
    pub(crate) const SPACING_BETWEEN_SLICES: u32 = 0x0018_0088;
    pub(crate) const TRIGGER_TIME: u32 = 0x0018_1060;
    pub(crate) const IMAGER_PIXEL_SPACING: u32 = 0x0018_1164;
    pub(crate) const SERIES: u32 = 0x0020_000E;
    pub(crate) const ACQUISITION_NUMBER: u32 = 0x0020_0012;
    pub(crate) const INSTANCE_NUMBER: u32 = 0x0020_0013;
    pub(crate) const POSITION: u32 = 0x0020_0032;
    pub(crate) const ORIENTATION: u32 = 0x0020_0037;
    pub(crate) const TEMPORAL_POSITION: u32 = 0x0020_0100;
    pub(crate) const FRAME_CONTENT: u32 = 0x0020_9111;
    pub(crate) const PLANE_POSITION: u32 = 0x0020_9113;
    pub(crate) const PLANE_ORIENTATION: u32 = 0x0020_9116;
    pub(crate) const TEMPORAL_POSITION_INDEX: u32 = 0x0020_9128;
    pub(crate) const SAMPLES: u32 = 0x0028_0002;
    pub(crate) const PHOTOMETRIC: u32 = 0x0028_0004;
    pub(crate) const PLANAR: u32 = 0x0028_0006;
    pub(crate) const FRAME_COUNT: u32 = 0x0028_0008;
    pub(crate) const FRAME_INCREMENT: u32 = 0x0028_0009;
    pub(crate) const ROWS: u32 = 0x0028_0010;
    pub(crate) const COLUMNS: u32 = 0x0028_0011;
    pub(crate) const PIXEL_SPACING: u32 = 0x0028_0030;
    pub(crate) const BITS_ALLOCATED: u32 = 0x0028_0100;
    pub(crate) const BITS_STORED: u32 = 0x0028_0101;
    pub(crate) const HIGH_BIT: u32 = 0x0028_0102;
    pub(crate) const IS_SIGNED: u32 = 0x0028_0103;
    pub(crate) const INTERCEPT: u32 = 0x0028_1052;
    pub(crate) const SLOPE: u32 = 0x0028_1053;
    pub(crate) const RED_SIZE: u32 = 0x0028_1101;
    pub(crate) const RED: u32 = 0x0028_1201;
    pub(crate) const GREEN: u32 = 0x0028_1202;
    pub(crate) const BLUE: u32 = 0x0028_1203;
    pub(crate) const PIXEL_MEASURES: u32 = 0x0028_9110;
    pub(crate) const PIXEL_VALUES: u32 = 0x0028_9145;
    pub(crate) const SEGMENTS: u32 = 0x0062_0002;
    pub(crate) const SEGMENT_NUMBER: u32 = 0x0062_0004;
    pub(crate) const SEGMENT_LABEL: u32 = 0x0062_0005;
    pub(crate) const SEGMENT_IDENTIFICATION: u32 = 0x0062_000A;
    pub(crate) const REFERENCED_SEGMENT: u32 = 0x0062_000B;
    pub(crate) const SEGMENT_COLOR: u32 = 0x0062_000D;
    pub(crate) const GRID_OFFSETS: u32 = 0x3004_000C;
    pub(crate) const DOSE_SCALING: u32 = 0x3004_000E;
    pub(crate) const SHARED_GROUPS: u32 = 0x5200_9229;
    pub(crate) const FRAME_GROUPS: u32 = 0x5200_9230;
    pub(crate) const FLOAT_PIXELS: u32 = 0x7FE0_0008;
    pub(crate) const DOUBLE_PIXELS: u32 = 0x7FE0_0009;
    pub(crate) const PIXELS: u32 = 0x7FE0_0010;
}

/// How the value of an element that is read is written.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Value,
    Sequence,
}

fn wanted(tag: u32) -> Option<Kind> {
    use tag::*;
    Some(match tag {
        FRAME_CONTENT
        | PLANE_POSITION
        | PLANE_ORIENTATION
        | PIXEL_MEASURES
        | PIXEL_VALUES
        | SEGMENTS
        | SEGMENT_IDENTIFICATION
        | SHARED_GROUPS
        | FRAME_GROUPS => Kind::Sequence,
        TRANSFER_SYNTAX
        | SOP_CLASS
        | MODALITY
        | ECHO_TIME
        | SLICE_THICKNESS
        | SPACING_BETWEEN_SLICES
        | TRIGGER_TIME
        | IMAGER_PIXEL_SPACING
        | SERIES
        | ACQUISITION_NUMBER
        | INSTANCE_NUMBER
        | POSITION
        | ORIENTATION
        | TEMPORAL_POSITION
        | TEMPORAL_POSITION_INDEX
        | SAMPLES
        | PHOTOMETRIC
        | PLANAR
        | FRAME_COUNT
        | FRAME_INCREMENT
        | ROWS
        | COLUMNS
        | PIXEL_SPACING
        | BITS_ALLOCATED
        | BITS_STORED
        | HIGH_BIT
        | IS_SIGNED
        | INTERCEPT
        | SLOPE
        | RED_SIZE
        | RED
        | GREEN
        | BLUE
        | SEGMENT_NUMBER
        | SEGMENT_LABEL
        | REFERENCED_SEGMENT
        | SEGMENT_COLOR
        | GRID_OFFSETS
        | DOSE_SCALING => Kind::Value,
        _ => return None,
    })
}

/// What stops a data set from being read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Fault {
    /// The data set goes on beyond the bytes read so far.
    Short,
    /// The bytes from `offset` on are no data set.
    Wrong { offset: usize, what: &'static str },
}

/// Bytes in a transfer syntax.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Syntax {
    pub(crate) is_explicit: bool,
    pub(crate) is_big_endian: bool,
}

/// One data set or item: the elements wanted.
#[derive(Clone, Debug, Default)]
pub(crate) struct Item {
    elements: Vec<(u32, Data)>,
    is_big_endian: bool,
}

#[derive(Clone, Debug)]
enum Data {
    Bytes(Vec<u8>),
    Items(Vec<Item>),
}

impl Item {
    fn data(&self, tag: u32) -> Option<&Data> {
        let found = self.elements.iter().find(|(found, _)| *found == tag);
        found.map(|(_, data)| data)
    }

    /// The value as it lies in the file.
    pub(crate) fn bytes(&self, tag: u32) -> Option<&[u8]> {
        match self.data(tag)? {
            Data::Bytes(bytes) => Some(bytes),
            Data::Items(_) => None,
        }
    }

    /// The items of a sequence.
    pub(crate) fn items(&self, tag: u32) -> &[Self] {
        match self.data(tag) {
            Some(Data::Items(items)) => items,
            _ => &[],
        }
    }

    /// A text without its padding.
    pub(crate) fn text(&self, tag: u32) -> Option<String> {
        let text = String::from_utf8_lossy(self.bytes(tag)?);
        Some(
            text.trim_matches(|c: char| c == '\0' || c.is_whitespace())
                .to_owned(),
        )
    }

    /// Numbers written as text, parted by backslashes; none if one of them is not finite.
    pub(crate) fn decimals(&self, tag: u32) -> Vec<f64> {
        let text = self.text(tag).unwrap_or_default();
        let numbers: Option<Vec<f64>> = text
            .split('\\')
            .map(|part| part.trim().parse().ok().filter(|x: &f64| x.is_finite()))
            .collect();
        numbers.unwrap_or_default()
    }

    pub(crate) fn decimal(&self, tag: u32) -> Option<f64> {
        self.decimals(tag).first().copied()
    }

    /// A whole number of 16 bits (or more, of which the low ones).
    pub(crate) fn short(&self, tag: u32) -> Option<u16> {
        let bytes = *self.bytes(tag)?.first_chunk::<2>()?;
        Some(if self.is_big_endian {
            u16::from_be_bytes(bytes)
        } else {
            u16::from_le_bytes(bytes)
        })
    }

    /// All 16-bit numbers of a value.
    pub(crate) fn shorts(&self, tag: u32) -> Vec<u16> {
        let number = |bytes: &[u8; 2]| {
            if self.is_big_endian {
                u16::from_be_bytes(*bytes)
            } else {
                u16::from_le_bytes(*bytes)
            }
        };
        let (pairs, _) = self.bytes(tag).unwrap_or_default().as_chunks::<2>();
        pairs.iter().map(number).collect()
    }

    /// A whole number of 32 bits.
    pub(crate) fn long(&self, tag: u32) -> Option<u32> {
        let bytes = *self.bytes(tag)?.first_chunk::<4>()?;
        Some(if self.is_big_endian {
            u32::from_be_bytes(bytes)
        } else {
            u32::from_le_bytes(bytes)
        })
    }
}

/// The pixels of a file: where they lie in its (unpacked) bytes.
#[derive(Clone, Debug, Default)]
pub(crate) struct Pixels {
    /// [`tag::PIXELS`] or its float kin; 0 if there are none.
    pub(crate) tag: u32,
    /// As they are, from where to where; the end may lie beyond the file.
    pub(crate) native: Option<(usize, usize)>,
    /// Packed: the fragments, the first of which is the table of offsets.
    pub(crate) fragments: Vec<(usize, usize)>,
    /// They are words of 16 bits (matters where bytes are exchanged).
    pub(crate) is_words: bool,
}

/// A file understood so far.
#[derive(Clone, Debug, Default)]
pub(crate) struct Parsed {
    /// The data set of the file: the wanted elements, with their sequences.
    pub(crate) root: Item,
    /// UID of the transfer syntax; empty if it was guessed.
    pub(crate) syntax_uid: String,
    pub(crate) pixels: Pixels,
}

const DEFLATED: &str = "1.2.840.10008.1.2.1.99";

/// True if the bytes begin with the preamble of a DICOM file.
pub(crate) fn has_mark(start: &[u8]) -> bool {
    start.get(128..132) == Some(b"DICM")
}

/// True if the bytes begin like a DICOM file, with or without its preamble.
pub(crate) fn is_header(start: &[u8]) -> bool {
    if has_mark(start) {
        return true;
    }
    // Without: the first element is of group 2 or 8, and its length or type makes sense.
    let Some(head) = start.first_chunk::<8>() else {
        return false;
    };
    let is_group = matches!(head[..2], [2 | 8, 0]) && head[3] == 0 && head[2] <= 0x18;
    let has_type = head[4].is_ascii_uppercase() && head[5].is_ascii_uppercase();
    let len = u32::from_le_bytes([head[4], head[5], head[6], head[7]]);
    is_group && (has_type || len <= 64)
}

/// Unpacks a deflated data set; other files come back as they are. `is_whole` if the bytes are the whole file.
pub(crate) fn unpack(bytes: &[u8], is_whole: bool) -> Result<Cow<'_, [u8]>, Fault> {
    let (syntax, start) = meta(bytes)?;
    if syntax != DEFLATED {
        return Ok(Cow::Borrowed(bytes));
    }
    let packed = bytes.get(start..).unwrap_or_default();
    let most = 4 * bytes.len() + MAX_INFLATED_EXTRA;
    let mut out = bytes[..start].to_vec();
    let mut decoder = DeflateDecoder::new(packed).take(most as u64 + 1);
    let result = decoder.read_to_end(&mut out);
    if out.len() > most {
        return Err(Fault::Wrong {
            offset: start,
            what: "its deflated data set unpacks to more than can be",
        });
    }
    match result {
        Err(_) if is_whole && out.len() == start => Err(Fault::Wrong {
            offset: start,
            what: "its deflated data set is damaged",
        }),
        // Elements before the damage, or before the end of a part, are used.
        _ => Ok(Cow::Owned(out)),
    }
}

/// The transfer syntax and where the data set begins.
fn meta(bytes: &[u8]) -> Result<(String, usize), Fault> {
    let start = if bytes.get(128..132) == Some(b"DICM") {
        132
    } else {
        // Cut out of a file, a data set may keep the byte that padded the element before it.
        let rest = bytes.get(1..).unwrap_or_default();
        usize::from(!is_header(bytes) && is_header(rest))
    };
    let mut reader = Reader {
        bytes,
        at: start,
        syntax: Syntax {
            is_explicit: true,
            is_big_endian: false,
        },
        kept: 0,
    };
    let mut syntax = String::new();
    while bytes.get(reader.at..reader.at + 2) == Some(&[2, 0]) {
        let head = reader.head()?;
        let value = reader.take(head.len as usize)?;
        if head.tag == tag::TRANSFER_SYNTAX {
            let text = String::from_utf8_lossy(value);
            syntax = text.trim_matches(['\0', ' ']).chars().take(64).collect();
        }
    }
    Ok((syntax, reader.at))
}

/// Reads a file, [`unpack`]ed. Not `is_whole`: up to its pixels, of which the place is not told then.
pub(crate) fn parse(bytes: &[u8], is_whole: bool) -> Result<Parsed, Fault> {
    let (syntax_uid, at) = meta(bytes)?;
    let syntax = match syntax_uid.as_str() {
        "" => guess(bytes.get(at..).unwrap_or_default()),
        "1.2.840.10008.1.2" => Syntax {
            is_explicit: false,
            is_big_endian: false,
        },
        uid => Syntax {
            is_explicit: true,
            is_big_endian: uid == "1.2.840.10008.1.2.2",
        },
    };
    let mut reader = Reader {
        bytes,
        at,
        syntax,
        kept: 0,
    };
    let mut parsed = Parsed {
        syntax_uid,
        ..Parsed::default()
    };
    parsed.root = reader.data_set(bytes.len(), 0, Some((&mut parsed.pixels, is_whole)))?;
    Ok(parsed)
}

/// A data set without its meta information: by its first element.
fn guess(start: &[u8]) -> Syntax {
    let is_big_endian = start.first() == Some(&0) && start.get(1).is_some_and(|&group| group != 0);
    let is_type = |i: usize| start.get(i).is_some_and(u8::is_ascii_uppercase);
    Syntax {
        is_explicit: is_type(4) && is_type(5),
        is_big_endian,
    }
}

struct Head {
    tag: u32,
    vr: [u8; 2],
    len: u32,
}

struct Reader<'a> {
    bytes: &'a [u8],
    at: usize,
    syntax: Syntax,
    kept: u32,
}

impl<'a> Reader<'a> {
    /// Counts the elements that are kept, so that a file of nothing but empty elements does not fill the memory.
    fn keep(&mut self) -> Result<(), Fault> {
        self.kept += 1;
        if self.kept > MAX_KEPT {
            return Err(Fault::Wrong {
                offset: self.at,
                what: "more elements than can be",
            });
        }
        Ok(())
    }

    fn take(&mut self, n: usize) -> Result<&'a [u8], Fault> {
        let end = self.at.checked_add(n).ok_or(Fault::Short)?;
        let taken = self.bytes.get(self.at..end).ok_or(Fault::Short)?;
        self.at = end;
        Ok(taken)
    }

    fn array<const N: usize>(&mut self) -> Result<[u8; N], Fault> {
        self.take(N)?.first_chunk().copied().ok_or(Fault::Short)
    }

    fn short(&mut self) -> Result<u16, Fault> {
        let bytes = self.array()?;
        Ok(if self.syntax.is_big_endian {
            u16::from_be_bytes(bytes)
        } else {
            u16::from_le_bytes(bytes)
        })
    }

    fn long(&mut self) -> Result<u32, Fault> {
        let bytes = self.array()?;
        Ok(if self.syntax.is_big_endian {
            u32::from_be_bytes(bytes)
        } else {
            u32::from_le_bytes(bytes)
        })
    }

    fn head(&mut self) -> Result<Head, Fault> {
        let offset = self.at;
        let tag = (u32::from(self.short()?) << 16) | u32::from(self.short()?);
        if tag >> 16 == 0xFFFE || !self.syntax.is_explicit {
            let len = self.long()?;
            return Ok(Head {
                tag,
                vr: [0; 2],
                len,
            });
        }
        let vr: [u8; 2] = self.array()?;
        if !vr.iter().all(u8::is_ascii_uppercase) {
            return Err(Fault::Wrong {
                offset,
                what: "an element without a type",
            });
        }
        let len = match &vr {
            b"OB" | b"OD" | b"OF" | b"OL" | b"OV" | b"OW" | b"SQ" | b"SV" | b"UC" | b"UN"
            | b"UR" | b"UT" | b"UV" => {
                self.short()?;
                self.long()?
            }
            _ => u32::from(self.short()?),
        };
        Ok(Head { tag, vr, len })
    }

    /// Elements up to `end`, or up to the end of an item whose length is not told.
    fn data_set(
        &mut self,
        end: usize,
        depth: u32,
        mut pixels: Option<(&mut Pixels, bool)>,
    ) -> Result<Item, Fault> {
        let mut item = Item {
            is_big_endian: self.syntax.is_big_endian,
            ..Item::default()
        };
        while self.at < end {
            // Padding behind the last element of a file is no element.
            if depth == 0 && self.bytes.len() - self.at < 8 {
                break;
            }
            let offset = self.at;
            let head = self.head()?;
            if head.tag == ITEM_END {
                break;
            }
            if let Some((pixels, is_whole)) = &mut pixels
                && matches!(
                    head.tag,
                    tag::PIXELS | tag::FLOAT_PIXELS | tag::DOUBLE_PIXELS
                )
            {
                pixels.tag = head.tag;
                pixels.is_words = head.vr == *b"OW" || !self.syntax.is_explicit;
                if *is_whole {
                    self.pixels(&head, pixels)?;
                }
                break;
            }
            let kind = wanted(head.tag);
            if head.len == UNDEFINED || kind == Some(Kind::Sequence) {
                if depth >= MAX_DEPTH {
                    return Err(Fault::Wrong {
                        offset,
                        what: "sequences too deep within each other",
                    });
                }
                // An unknown one of unknown length is written implicitly, whatever the rest is (PS3.5, 6.2.2).
                let outer = self.syntax;
                if head.vr == *b"UN" {
                    self.syntax = Syntax {
                        is_explicit: false,
                        is_big_endian: false,
                    };
                }
                let items = self.sequence(head.len, depth, kind == Some(Kind::Sequence));
                self.syntax = outer;
                let items = items?;
                if kind == Some(Kind::Sequence) {
                    self.keep()?;
                    item.elements.push((head.tag, Data::Items(items)));
                }
                continue;
            }
            let value = self.take(head.len as usize)?;
            if kind == Some(Kind::Value) {
                self.keep()?;
                item.elements.push((head.tag, Data::Bytes(value.to_vec())));
            }
        }
        Ok(item)
    }

    /// The items of a sequence, or nothing if they are only to be stepped over.
    fn sequence(&mut self, len: u32, depth: u32, is_kept: bool) -> Result<Vec<Item>, Fault> {
        let end = if len == UNDEFINED {
            self.bytes.len()
        } else {
            let end = self.at.checked_add(len as usize).ok_or(Fault::Short)?;
            if end > self.bytes.len() {
                return Err(Fault::Short);
            }
            end
        };
        let mut items = Vec::new();
        while self.at < end {
            let offset = self.at;
            let head = self.head()?;
            match head.tag {
                SEQUENCE_END => return Ok(items),
                ITEM => {}
                _ => {
                    return Err(Fault::Wrong {
                        offset,
                        what: "something that is no item in a sequence",
                    });
                }
            }
            let item_end = if head.len == UNDEFINED {
                end
            } else {
                let item_end = self.at.checked_add(head.len as usize).ok_or(Fault::Short)?;
                if item_end > self.bytes.len() {
                    return Err(Fault::Short);
                }
                item_end
            };
            if !is_kept && head.len != UNDEFINED {
                self.at = item_end;
                continue;
            }
            let item = self.data_set(item_end, depth + 1, None)?;
            if is_kept {
                self.keep()?;
                items.push(item);
            }
        }
        if len == UNDEFINED {
            Err(Fault::Short)
        } else {
            Ok(items)
        }
    }

    fn pixels(&mut self, head: &Head, pixels: &mut Pixels) -> Result<(), Fault> {
        if head.len != UNDEFINED {
            pixels.native = Some((self.at, self.at.saturating_add(head.len as usize)));
            return Ok(());
        }
        loop {
            let offset = self.at;
            let fragment = match self.head() {
                Ok(fragment) => fragment,
                // The end of the file ends the sequence as well.
                Err(Fault::Short) => return Ok(()),
                Err(fault) => return Err(fault),
            };
            match fragment.tag {
                SEQUENCE_END => return Ok(()),
                ITEM => {
                    let end = self
                        .at
                        .saturating_add(fragment.len as usize)
                        .min(self.bytes.len());
                    pixels.fragments.push((self.at, end));
                    self.at = end;
                }
                _ => {
                    return Err(Fault::Wrong {
                        offset,
                        what: "something that is no fragment in the pixels",
                    });
                }
            }
        }
    }
}
