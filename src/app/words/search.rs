//! How names are compared with what is searched for: in capitals or not, with accents or without.

/// True if every word that is wanted is in the text; true if none is.
pub(crate) fn has_words(text: &str, wanted: &str) -> bool {
    let text = folded(text);
    let wanted = folded(wanted);
    wanted.split_whitespace().all(|word| text.contains(word))
}

/// The text in small letters without accents.
fn folded(text: &str) -> String {
    let mut folded = String::with_capacity(text.len());
    for letter in text.chars().flat_map(char::to_lowercase) {
        match letter {
            'à'..='å' | 'ā' | 'ă' | 'ą' => folded.push('a'),
            'æ' => folded.push_str("ae"),
            'ç' | 'ć' | 'č' => folded.push('c'),
            'ď' | 'đ' => folded.push('d'),
            'è'..='ë' | 'ē' | 'ė' | 'ę' | 'ě' => folded.push('e'),
            'ğ' => folded.push('g'),
            'ì'..='ï' | 'ī' | 'į' | 'ı' => folded.push('i'),
            'ł' => folded.push('l'),
            'ñ' | 'ń' | 'ň' => folded.push('n'),
            'ò'..='ö' | 'ø' | 'ō' | 'ő' => folded.push('o'),
            'œ' => folded.push_str("oe"),
            'ř' => folded.push('r'),
            'ś' | 'ş' | 'š' => folded.push('s'),
            'ß' => folded.push_str("ss"),
            'ţ' | 'ť' => folded.push('t'),
            'ù'..='ü' | 'ū' | 'ů' | 'ű' => folded.push('u'),
            'ý' | 'ÿ' => folded.push('y'),
            'ź' | 'ż' | 'ž' => folded.push('z'),
            // Accents that are written as signs of their own.
            '\u{300}'..='\u{36f}' => {}
            letter => folded.push(letter),
        }
    }
    folded
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn capitals_and_accents_make_no_difference() {
        for (text, wanted) in [
            ("Vía aérea", "via AEREA"),
            ("Weiße Substanz", "weisse"),
            ("Schädel", "schadel"),
            ("Schadel", "SCHÄDEL"),
            ("Scha\u{308}del", "schädel"),
            ("İliac artery", "iliac"),
            ("硬脑膜", "脑"),
            ("Brain stem", "stem brain"),
            ("anything", "  "),
        ] {
            assert!(has_words(text, wanted), "{wanted} in {text}");
        }
        for (text, wanted) in [("Brain", "brain stem"), ("Bone", "bonne"), ("", "a")] {
            assert!(!has_words(text, wanted), "{wanted} in {text}");
        }
    }
}
