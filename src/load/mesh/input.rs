//! The bytes of a mesh as they come, with progress and stop, and the lines of a text in any encoding.

use std::borrow::Cow;

use super::error::MeshError;
use crate::load::LoadError;
use crate::load::stream::Stream;

/// Told how far the reading is, 0 to 1; it returns false to stop.
pub type Progress<'a> = dyn FnMut(f32) -> bool + 'a;

/// Bytes between two reports of progress.
const REPORT_BYTES: u64 = 1 << 18;
/// Bytes of text decoded at once.
const BLOCK_BYTES: usize = 1 << 16;
/// The longest line, with those it is continued by. A PLY may have all its strips in one.
const MAX_LINE_BYTES: usize = 32 << 20;

/// A file that is being read.
pub(super) struct Input<'s, 'f> {
    stream: Stream<'f>,
    progress: &'s mut Progress<'s>,
    reported: u64,
}

impl<'s, 'f> Input<'s, 'f> {
    pub(super) fn new(stream: Stream<'f>, progress: &'s mut Progress<'s>) -> Self {
        Self {
            stream,
            progress,
            reported: 0,
        }
    }

    /// Unpacked bytes taken so far.
    pub(super) fn position(&self) -> u64 {
        self.stream.position()
    }

    /// Length of a file that is not packed.
    pub(super) fn byte_len(&self) -> Option<u64> {
        use crate::load::stream::Packing;
        let len = self.stream.byte_len();
        len.filter(|_| self.stream.packing() == Packing::Plain)
    }

    pub(super) fn peek(&mut self, n: usize) -> Result<Vec<u8>, MeshError> {
        Ok(self.stream.peek(n)?)
    }

    /// Fills the buffer as far as the file goes; returns how many bytes came.
    pub(super) fn fill(&mut self, buffer: &mut [u8]) -> Result<usize, MeshError> {
        let n = self.stream.fill(buffer)?;
        if self.stream.position() - self.reported >= REPORT_BYTES {
            self.reported = self.stream.position();
            self.keep_on()?;
        }
        Ok(n)
    }

    /// Reports progress.
    ///
    /// # Errors
    /// [`LoadError::Cancelled`].
    fn keep_on(&mut self) -> Result<(), MeshError> {
        let fraction = self.stream.fraction().unwrap_or(0.0);
        match (self.progress)(fraction) {
            true => Ok(()),
            false => Err(LoadError::Cancelled.into()),
        }
    }

    /// The next bytes, all of them.
    ///
    /// # Errors
    /// [`MeshError::Byte`] where the file ends before.
    pub(super) fn exact<const N: usize>(&mut self, what: &str) -> Result<[u8; N], MeshError> {
        let mut bytes = [0; N];
        match self.fill(&mut bytes)? {
            n if n == N => Ok(bytes),
            _ => Err(self.ends(what)),
        }
    }

    /// At most this many bytes more; memory grows as they come.
    pub(super) fn take(&mut self, n: u64) -> Result<Vec<u8>, MeshError> {
        let mut bytes = Vec::new();
        while (bytes.len() as u64) < n {
            let start = bytes.len();
            let more = (n - start as u64).min(REPORT_BYTES) as usize;
            bytes.resize(start + more, 0);
            let got = self.fill(&mut bytes[start..])?;
            bytes.truncate(start + got);
            if got < more {
                break;
            }
        }
        Ok(bytes)
    }

    /// Passes over bytes; returns how many there were.
    pub(super) fn skip(&mut self, n: u64) -> Result<u64, MeshError> {
        let progress = &mut *self.progress;
        let skipped = self.stream.skip(n, |stream| {
            let fraction = stream.fraction().unwrap_or(0.0);
            progress(fraction)
        })?;
        Ok(skipped)
    }

    /// Reads on to the end, so that the hash is complete. True if there was anything left.
    pub(super) fn finish(&mut self) -> Result<bool, MeshError> {
        let progress = &mut *self.progress;
        Ok(self.stream.finish(|stream| {
            let fraction = stream.fraction().unwrap_or(0.0);
            progress(fraction)
        })?)
    }

    /// That the file ends here, in the middle of something.
    pub(super) fn ends(&self, what: &str) -> MeshError {
        self.at_byte(self.position(), format!("the file ends in {what}"))
    }

    pub(super) fn at_byte(&self, offset: u64, what: String) -> MeshError {
        MeshError::Byte {
            name: self.stream.name().to_owned(),
            offset,
            what,
        }
    }
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Encoding {
    Bytes,
    Utf16 { is_big: bool },
}

/// The lines of a text: UTF-8 or UTF-16 with a mark, ends of any kind, and lines that a backslash continues.
pub(super) struct Lines<'i, 's, 'f> {
    input: &'i mut Input<'s, 'f>,
    encoding: Option<Encoding>,
    /// Text as bytes of UTF-8, or whatever the file has where it is not UTF-16.
    text: Vec<u8>,
    at: usize,
    /// A first half of a UTF-16 pair, and an odd byte, that wait for what follows.
    high: Option<u16>,
    odd: Option<u8>,
    line: Vec<u8>,
    /// Lines ended so far.
    ended: u64,
    number: u64,
}

impl<'i, 's, 'f> Lines<'i, 's, 'f> {
    /// Lines from where the input is, after `before` lines.
    pub(super) fn new(input: &'i mut Input<'s, 'f>, before: u64) -> Self {
        Self {
            input,
            // Only the beginning of a file has a mark.
            encoding: (before > 0).then_some(Encoding::Bytes),
            text: Vec::new(),
            at: 0,
            high: None,
            odd: None,
            line: Vec::new(),
            ended: before,
            number: before,
        }
    }

    /// Number of the line that [`Lines::text`] gives, from 1: the first, if it is continued.
    pub(super) fn number(&self) -> u64 {
        self.number
    }

    /// The line, without its end.
    pub(super) fn text(&self) -> Cow<'_, str> {
        String::from_utf8_lossy(&self.line)
    }

    /// Goes to the next line; false at the end. With `joins` a backslash at the end of a line that is no comment takes
    /// the next one with it.
    pub(super) fn advance(&mut self, joins: bool) -> Result<bool, MeshError> {
        self.line.clear();
        self.number = self.ended + 1;
        loop {
            let is_line = self.more_of_line()?;
            let is_continued = joins
                && is_line
                && self.line.last() == Some(&b'\\')
                && !self.line.trim_ascii_start().starts_with(b"#");
            if !is_continued {
                return Ok(is_line || !self.line.is_empty());
            }
            self.line.pop();
            self.line.push(b' ');
        }
    }

    /// Adds the rest of the line; false if the text ended before anything came.
    fn more_of_line(&mut self) -> Result<bool, MeshError> {
        let mut came = false;
        loop {
            if self.at == self.text.len() && !self.decode()? {
                self.ended += u64::from(came);
                return Ok(came);
            }
            came = true;
            let rest = &self.text[self.at..];
            let end = rest.iter().position(|byte| matches!(byte, b'\n' | b'\r'));
            self.line
                .extend_from_slice(&rest[..end.unwrap_or(rest.len())]);
            let Some(end) = end else {
                self.at = self.text.len();
                if self.line.len() > MAX_LINE_BYTES {
                    let what = format!("a line of more than {MAX_LINE_BYTES} bytes");
                    return Err(self.wrong(what));
                }
                continue;
            };
            let is_return = rest[end] == b'\r';
            self.at += end + 1;
            self.ended += 1;
            if is_return && (self.at < self.text.len() || self.decode()?) {
                self.at += usize::from(self.text[self.at] == b'\n');
            }
            return Ok(true);
        }
    }

    /// Decodes another block; false at the end. What was there before has been taken.
    fn decode(&mut self) -> Result<bool, MeshError> {
        self.text.clear();
        self.at = 0;
        let mut block = vec![0; BLOCK_BYTES];
        while self.text.is_empty() {
            let n = self.input.fill(&mut block)?;
            if n == 0 {
                return Ok(false);
            }
            let mut bytes = &block[..n];
            let encoding = *self.encoding.get_or_insert_with(|| {
                let (encoding, mark) = match bytes {
                    [0xff, 0xfe, ..] => (Encoding::Utf16 { is_big: false }, 2),
                    [0xfe, 0xff, ..] => (Encoding::Utf16 { is_big: true }, 2),
                    [0xef, 0xbb, 0xbf, ..] => (Encoding::Bytes, 3),
                    _ => (Encoding::Bytes, 0),
                };
                bytes = &bytes[mark..];
                encoding
            });
            match encoding {
                Encoding::Bytes => self.text.extend_from_slice(bytes),
                Encoding::Utf16 { is_big } => self.decode_utf16(bytes, is_big),
            }
        }
        Ok(true)
    }

    fn decode_utf16(&mut self, bytes: &[u8], is_big: bool) {
        let odd = self.odd.take();
        let mut all = odd.into_iter().chain(bytes.iter().copied());
        let mut units: Vec<u16> = self.high.take().into_iter().collect();
        while let Some(first) = all.next() {
            let Some(second) = all.next() else {
                self.odd = Some(first);
                break;
            };
            units.push(match is_big {
                true => u16::from_be_bytes([first, second]),
                false => u16::from_le_bytes([first, second]),
            });
        }
        if let Some(&last) = units.last().filter(|unit| (0xd800..0xdc00).contains(*unit)) {
            self.high = Some(last);
            units.pop();
        }
        for c in char::decode_utf16(units) {
            let c = c.unwrap_or(char::REPLACEMENT_CHARACTER);
            self.text
                .extend_from_slice(c.encode_utf8(&mut [0; 4]).as_bytes());
        }
    }

    /// That the line is not what it should be.
    pub(super) fn wrong(&self, what: impl Into<String>) -> MeshError {
        self.wrong_at(self.number.max(1), what)
    }

    /// That a line is not what it should be.
    pub(super) fn wrong_at(&self, line: u64, what: impl Into<String>) -> MeshError {
        MeshError::Line {
            name: self.input.stream.name().to_owned(),
            line,
            what: what.into(),
        }
    }
}

/// A word that is not what it should be, for a message: short, and fit for a line.
pub(super) fn shown(word: &str) -> String {
    let mut short: String = word.chars().filter(|c| !c.is_control()).take(20).collect();
    if word.chars().nth(20).is_some() {
        short.push('…');
    }
    short
}

/// The `SPACE=LPS` or `SPACE=RAS` that medical programs write into a comment or header.
pub(super) fn space_in(text: &str) -> Option<super::options::Axes> {
    use super::options::Axes;
    let at = text.find("SPACE=")?;
    match text.get(at + 6..at + 9)? {
        "LPS" => Some(Axes::Lps),
        "RAS" => Some(Axes::Ras),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Read;

    /// Gives one byte at a time, which is where decoders break.
    struct Drip(Vec<u8>, usize);

    impl Read for Drip {
        fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
            let Some(&byte) = self.0.get(self.1) else {
                return Ok(0);
            };
            buffer[0] = byte;
            self.1 += 1;
            Ok(1)
        }
    }

    fn lines(bytes: &[u8], joins: bool) -> Vec<(u64, String)> {
        let stream = Stream::new("a", Box::new(Drip(bytes.to_vec(), 0)), None, None);
        let mut go_on = |_: f32| true;
        let mut input = Input::new(stream, &mut go_on);
        let mut lines = Lines::new(&mut input, 0);
        let mut all = Vec::new();
        while lines.advance(joins).expect("memory is read") {
            all.push((lines.number(), lines.text().into_owned()));
        }
        all
    }

    #[test]
    fn lines_end_in_any_way() {
        let expected = [(1, "a"), (2, "b"), (3, ""), (4, "c")].map(|(n, s)| (n, s.to_owned()));
        for text in [
            "a\nb\n\nc",
            "a\r\nb\r\n\r\nc\r\n",
            "a\rb\r\rc\r",
            "a\nb\r\n\rc",
        ] {
            assert_eq!(lines(text.as_bytes(), true), expected, "{text:?}");
            let mut marked = b"\xef\xbb\xbf".to_vec();
            marked.extend(text.as_bytes());
            assert_eq!(lines(&marked, true), expected, "{text:?} with a mark");
            let units = |of: fn(u16) -> [u8; 2]| text.encode_utf16().flat_map(of).collect();
            let big: Vec<u8> = units(u16::to_be_bytes);
            let little: Vec<u8> = units(u16::to_le_bytes);
            assert_eq!(lines(&[&[0xfe, 0xff], &big[..]].concat(), true), expected);
            assert_eq!(
                lines(&[&[0xff, 0xfe], &little[..]].concat(), true),
                expected
            );
        }
        let pair: Vec<u8> = "\u{feff}😀"
            .encode_utf16()
            .flat_map(u16::to_le_bytes)
            .collect();
        assert_eq!(lines(&pair, true), [(1, "😀".to_owned())]);
        assert_eq!(lines(b"", true), []);
    }

    #[test]
    fn a_backslash_continues_a_line_that_is_no_comment() {
        let text = b"f 1 2 \\\r\n3\n# C:\\\nv";
        let joined = [(1, "f 1 2  3"), (3, "# C:\\"), (4, "v")];
        assert_eq!(lines(text, true), joined.map(|(n, s)| (n, s.to_owned())));
        assert_eq!(lines(text, false).len(), 4);
    }

    #[test]
    fn an_endless_line_is_an_error() {
        let long = std::io::repeat(b'x').take(40 << 20);
        let stream = Stream::new("a", Box::new(long), None, None);
        let mut go_on = |_: f32| true;
        let mut input = Input::new(stream, &mut go_on);
        let error = Lines::new(&mut input, 0)
            .advance(true)
            .expect_err("too long");
        assert!(
            error.to_string().starts_with("line 1: a line of more than"),
            "{error}"
        );
    }

    #[test]
    fn a_comment_may_say_the_space() {
        use crate::load::mesh::options::Axes;
        assert_eq!(space_in("# x SPACE=LPS y"), Some(Axes::Lps));
        assert_eq!(space_in("SPACE=RAS"), Some(Axes::Ras));
        assert_eq!(space_in("SPACE=XYZ, SPACE="), None);
        assert_eq!(space_in("SPACE=ü"), None);
    }
}
