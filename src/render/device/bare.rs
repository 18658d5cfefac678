//! Shader text without its comments and indentation, worked out while the page is compiled: half of the bytes that a
//! visitor would download are for those who read the files. Lines stay where they are, so that messages still name
//! them.

/// Copies `text` without comments and leading spaces into `out` as far as that reaches; the number of bytes of the
/// whole.
pub(crate) const fn strip(text: &[u8], out: &mut [u8]) -> usize {
    let (mut from, mut to) = (0, 0);
    let mut at_start = true;
    while from < text.len() {
        let byte = text[from];
        if byte == b'/' && from + 1 < text.len() && text[from + 1] == b'/' {
            while from < text.len() && text[from] != b'\n' {
                from += 1;
            }
            continue;
        }
        from += 1;
        if at_start && byte == b' ' {
            continue;
        }
        at_start = byte == b'\n';
        if to < out.len() {
            out[to] = byte;
        }
        to += 1;
    }
    to
}

/// Bytes that are left of `text`.
pub(crate) const fn length(text: &str) -> usize {
    strip(text.as_bytes(), &mut [])
}

/// What is left of `text`, whose [`length`] is `N`.
pub(crate) const fn bytes<const N: usize>(text: &str) -> [u8; N] {
    let mut out = [0; N];
    strip(text.as_bytes(), &mut out);
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_and_indentation_go_and_lines_stay() {
        const TEXT: &str = "/// Half of it – so.\nfn half(x: f32) -> f32 {\n    // why\n    return x / 2.0; // here\n}\n";
        const BARE: [u8; length(TEXT)] = bytes(TEXT);
        assert_eq!(
            std::str::from_utf8(&BARE),
            Ok("\nfn half(x: f32) -> f32 {\n\nreturn x / 2.0; \n}\n")
        );
    }
}
