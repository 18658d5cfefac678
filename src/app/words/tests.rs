//! Every table has every text in every language, with the same gaps.

use super::*;
use crate::document::TemplateKind;

type Line = (&'static str, [&'static str; Lang::COUNT]);

/// The lines of all tables.
fn lines() -> impl Iterator<Item = &'static Line> {
    let tables = [
        bar::LINES,
        bodies::LINES,
        catalogue::LINES,
        controls::LINES,
        faults::LINES,
        facts::LINES,
        figure::LINES,
        files::LINES,
        kept::LINES,
        keys::LINES,
        captions::LINES,
        library::LINES,
        light::LINES,
        look::LINES,
        authoring::LINES,
        names::LINES,
        objects::LINES,
        picture::LINES,
        curve::LINES,
        points::LINES,
        messages::LINES,
        share::LINES,
        slices::LINES,
        steps::LINES,
        style::LINES,
        sweep::LINES,
        clay::LINES,
        templates::LINES,
        text::LINES,
        tissue::LINES,
        transfer::LINES,
    ];
    tables.into_iter().flatten()
}

#[test]
fn every_line_has_the_same_gaps_in_every_language() {
    let mut count = 0;
    for (key, line) in lines() {
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

#[test]
fn the_glossary_has_the_words_of_the_tables() {
    let mut count = 0;
    for row in include_str!("glossary.md").lines() {
        let cells: Vec<&str> = row.split('|').map(str::trim).collect();
        let Ok::<[&str; 9], _>([_, what, en, de, es, zh, _, _, _]) = cells.try_into() else {
            continue;
        };
        if what == "What it is" || what.starts_with("---") {
            continue;
        }
        let has = |(_, line): &Line| *line == [en, de, es, zh];
        assert!(
            lines().any(has),
            "no table has the line: {en}, {de}, {es}, {zh}"
        );
        count += 1;
    }
    assert!(count > 30, "only {count} rows were seen");
}

#[test]
fn words_that_nobody_could_guess_do_not_come_back() {
    // These tell nothing alone, and may stand in a sentence.
    const ALONE_GONE: &[&str] = &[
        "Moves less far",
        "Acts less",
        "As it is",
        "Wie sie ist",
        "Tal cual",
        "Mass",
        "Surfaces",
        "After",
        "Added",
        "{0} / {1}",
        "{0} characters",
        "{0} Zeichen",
        "{0} caracteres",
        "{0} 个字符",
        "整体移动",
        "避让",
        "原样",
    ];
    const GONE: &[&str] = &[
        "Leaves alone",
        "Gives way to",
        "As a whole",
        "Picture alone",
        "Colours of the program",
        "what was before",
        "under deformation",
        "Joins",
        "Lay on the surface",
        "Let it act earlier",
        "closed in",
        "brings no tissues",
        "x = 0",
        "Lässt unberührt",
        "Weicht aus",
        "Kürzere Wege",
        "Als Ganzes",
        "Nur das Bild",
        "Farben des Programms",
        "was vorher war",
        "bei Verformung",
        "Wieder an die Oberfläche",
        "Früher wirken lassen",
        "Eingeschlossenes",
        "bringt keine Gewebe mit",
        "Deja intacto",
        "Cede ante",
        "Menos recorrido",
        "Menos efecto",
        "Como un todo",
        "Solo la imagen",
        "Colores del programa",
        "al deformar",
        "Se une",
        "Ajustar de nuevo",
        "Que actúe antes",
        "lo encerrado",
        "no trae tejidos",
        "不触及",
        "仅显示图像",
        "界面颜色",
        "变形时的不透明度",
        "重新贴合",
        "更早作用",
        "封闭空腔",
        "自身不含",
    ];
    for (key, line) in lines() {
        for text in line {
            assert!(!ALONE_GONE.contains(text), "{key}: {text}");
            let gone = GONE
                .iter()
                .find(|gone| text.to_lowercase().contains(&gone.to_lowercase()));
            assert_eq!(gone, None, "{key}: {text}");
        }
    }
    // Those of the program's own commands and of the reference too.
    for kind in TemplateKind::ALL {
        let summary = kind.spec().summary;
        assert!(!summary.contains(" = "), "{kind:?}: {summary}");
    }
}
