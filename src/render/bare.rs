//! Shader text without its comments and indentation, worked out while the page is compiled: half of the bytes that a visitor
//! would download are for those who read the files. Lines stay where they are, so that messages still name them.

/// Copies `text` without comments and leading spaces into `out` as far as that reaches; the number of bytes of the whole.
const fn strip(text: &[u8], out: &mut [u8]) -> usize {
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
pub(super) const fn length(text: &str) -> usize {
    strip(text.as_bytes(), &mut [])
}

/// What is left of `text`, whose [`length`] is `N`.
pub(super) const fn bytes<const N: usize>(text: &str) -> [u8; N] {
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

    /// The program that visitors get is the one that is tested.
    #[test]
    fn every_program_validates_without_its_comments() {
        use crate::render::programs::{FILES, PROGRAMS};
        for program in PROGRAMS {
            let mut text = String::new();
            for path in program.files {
                let file = FILES
                    .iter()
                    .find(|file| file.path == *path)
                    .expect("in the table");
                let mut bare = vec![0; length(file.source)];
                strip(file.source.as_bytes(), &mut bare);
                assert_eq!(
                    bare.iter().filter(|byte| **byte == b'\n').count(),
                    file.source.lines().count(),
                    "{path}"
                );
                text.push_str(std::str::from_utf8(&bare).expect("still text"));
            }
            wgpu::naga::front::wgsl::parse_str(&text).unwrap_or_else(|error| {
                panic!("{}: {}", program.name, error.emit_to_string(&text))
            });
        }
    }
}
