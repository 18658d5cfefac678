//! Every table has every text in every language, with the same gaps.

use super::*;

#[test]
fn every_line_has_the_same_gaps_in_every_language() {
    let tables = [
        bar::LINES,
        catalogue::LINES,
        faults::LINES,
        facts::LINES,
        files::LINES,
        kept::LINES,
        keys::LINES,
        captions::LINES,
        library::LINES,
        look::LINES,
        authoring::LINES,
        names::LINES,
        picture::LINES,
        curve::LINES,
        points::LINES,
        messages::LINES,
        slices::LINES,
        templates::LINES,
        text::LINES,
        tissue::LINES,
        transfer::LINES,
    ];
    let mut count = 0;
    for (key, line) in tables.into_iter().flatten() {
        for text in line {
            assert!(!text.trim().is_empty(), "{key} says nothing");
            for index in 0..4 {
                let gap = format!("{{{index}}}");
                assert_eq!(
                    text.contains(&gap),
                    line[0].contains(&gap),
                    "{key}: {gap} in {text:?}"
                );
            }
        }
        count += 1;
    }
    assert!(count > 150, "only {count} lines were seen");
}

#[test]
fn gaps_are_filled_once() {
    assert_eq!(fill("{1} of {0}", &[&2, &"{0}"]), "{0} of 2");
    assert_eq!(fill("a {9} b {", &[&1]), "a {9} b {");
}

#[test]
fn languages_are_found_by_their_tags() {
    assert_eq!(Lang::from_tag("de-AT"), Some(Lang::German));
    assert_eq!(Lang::from_tag("zh_CN.UTF-8"), Some(Lang::Chinese));
    assert_eq!(Lang::from_tag("C"), None);
    let wanted = ["fr-FR", "es-MX", "en"].map(str::to_owned);
    assert_eq!(Lang::best(wanted), Lang::Spanish);
    assert_eq!(Lang::best([]), Lang::English);
}

#[test]
fn numbers_are_read_as_they_are_written() {
    set_lang(Lang::German);
    assert_eq!(localized("0.25".to_owned()), "0,25");
    assert_eq!(parse_number("\u{2212}0,25°"), Some(-0.25));
    assert_eq!(parse_number("inf"), None);
    set_lang(Lang::English);
    assert_eq!(localized("0.25".to_owned()), "0.25");
}
