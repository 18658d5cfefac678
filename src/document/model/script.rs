//! Scripts whose letters cannot be set one after the other from the left.

/// First and last characters of such scripts: Hebrew, Arabic, Syriac and their neighbours up to the signs of Arabic,
/// their older forms, and those of the supplementary planes that run from the right.
const BLOCKS: [(char, char); 5] = [
    ('\u{590}', '\u{8ff}'),
    ('\u{fb1d}', '\u{fdff}'),
    ('\u{fe70}', '\u{fefc}'),
    ('\u{10800}', '\u{10fff}'),
    ('\u{1e800}', '\u{1eeff}'),
];

/// True if a text has letters that run from the right or join their neighbours, as Hebrew and Arabic do. Browsers shape
/// them; the program's own letters stand unjoined and in the order of their characters.
pub fn needs_shaping(text: &str) -> bool {
    let is_in = |letter: char| {
        BLOCKS
            .iter()
            .any(|(first, last)| (*first..=*last).contains(&letter))
    };
    text.chars().any(is_in)
}

#[cfg(test)]
mod tests {
    use super::needs_shaping;

    #[test]
    fn arabic_and_hebrew_need_shaping() {
        for text in ["عظم", "Bone (עצם)", "ﷲ"] {
            assert!(needs_shaping(text), "{text}");
        }
        for text in [
            "",
            "Os frontale",
            "Čelní kost",
            "颅骨",
            "Κρανίο",
            "Череп",
            "🦴\u{feff}",
        ] {
            assert!(!needs_shaping(text), "{text}");
        }
    }
}
