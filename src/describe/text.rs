//! The description of one step of a document.

use glam::Quat;
use serde_json::{Value, json};

use super::lang::{Lang, Line, one_line};
use super::names::{has_patient, segment_in_sentence, subject_in_sentence};
use super::operations::{Extent, Operation, Ruler, listed, operation_of};
use super::sight::Sight;
use super::view::{Sides, sentence};
use crate::document::{Document, DocumentError, Illustration, MAX_ALT, SubjectRef};

/// What a description needs besides the document; all of it may be unknown.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Measured {
    /// What the picture of the step shows.
    pub sight: Option<Sight>,
    /// Millimetres in one subject unit; without it lengths are told in parts of the subject's longest side.
    pub mm_per_unit: Option<f64>,
    /// Rotation of the camera, where the reader has turned the object away from the view of the step.
    pub turned: Option<Quat>,
}

/// A picture in words: what was done, what was kept, from where one looks, what is in sight.
#[derive(Clone, Debug, PartialEq)]
pub struct Description {
    /// The language of the sentences. The author's texts stay in the author's.
    pub lang: Lang,
    /// The step, 0 for the document itself.
    pub step: usize,
    /// Title of the step, or of the document at step 0; may be empty.
    pub title: String,
    /// The text under the picture; may be empty.
    pub legend: String,
    /// What the author wrote in place of the picture of this step, or empty.
    pub alt: String,
    /// What the templates do, in their order, without those that do nothing.
    pub operations: Vec<Operation>,
    /// The sides that one looks from.
    pub sides: Sides,
    /// What is in sight, if it was measured.
    pub sight: Option<Sight>,
    /// The program's own words.
    generated: String,
}

/// Describes a document at a step; step 0 is the document itself.
///
/// # Errors
/// [`DocumentError::NoSuchStep`].
pub fn describe(
    document: &Document,
    step: usize,
    measured: &Measured,
    lang: Lang,
) -> Result<Description, DocumentError> {
    let shown = document.lesson()?.at_step(step)?;
    describe_shown(document, (step, shown), measured, lang)
}

/// The same of what the document shows on the way to a step.
///
/// # Errors
/// [`DocumentError::NoSuchStep`].
pub fn describe_shown(
    document: &Document,
    (step, shown): (usize, &Illustration),
    measured: &Measured,
    lang: Lang,
) -> Result<Description, DocumentError> {
    let lesson = document.lesson()?;
    let whole = document.illustration();
    let own = step.checked_sub(1).and_then(|i| whole.steps.get(i));
    let (title, legend, alt) = match own {
        None => (&whole.title, &whole.legend, whole.alt.clone()),
        Some(own) => {
            // A text that stays from the step before says nothing about this step.
            let before = &lesson.at_step(step - 1)?.alt;
            let set = Some(&shown.alt).filter(|alt| *alt != before);
            let own_alt = Some(&own.alt).filter(|alt| !alt.is_empty());
            let alt = own_alt.or(set).cloned().unwrap_or_default();
            (&own.title, &own.legend, alt)
        }
    };
    let (title, legend) = (one_line(title, MAX_ALT), one_line(legend, MAX_ALT));
    let ruler = Ruler {
        mm_per_unit: measured
            .mm_per_unit
            .filter(|mm| mm.is_finite() && *mm > 0.0),
        lang,
    };
    let operations: Vec<Operation> = shown
        .templates
        .iter()
        .filter_map(|template| operation_of(template, ruler))
        .collect();
    let sides = Sides::of(measured.turned.unwrap_or(shown.camera.rotate));
    let mut sentences = vec![
        heading(&title, step, whole.steps.len(), lang),
        legend.clone(),
    ];
    sentences.push(object(shown, lang));
    match strokes(shown, lang) {
        Some(shaped) => {
            sentences.push(shaped);
            if !operations.is_empty() {
                done(&operations, lang, &mut sentences);
            }
        }
        None => done(&operations, lang, &mut sentences),
    }
    drawn(shown, lang, &mut sentences);
    // A figure is flat: it is seen from its front.
    if !shown.is_of_figure() {
        sentences.push(sentence(sides, has_patient(&shown.subject), lang));
    }
    if let Some(sight) = &measured.sight {
        in_sight(sight, lang, &mut sentences);
    }
    Ok(Description {
        lang,
        step,
        title,
        legend,
        alt: one_line(&alt, MAX_ALT),
        operations,
        sides,
        sight: measured.sight.clone(),
        generated: lang.sentences(&sentences),
    })
}

impl Description {
    /// The text in place of the picture, one paragraph: the author's where there is one, else the program's.
    pub fn text(&self) -> &str {
        match self.alt.as_str() {
            "" => &self.generated,
            alt => alt,
        }
    }

    /// The program's own words, whatever the author wrote.
    pub fn generated(&self) -> &str {
        &self.generated
    }

    /// The same with its numbers, for other programs.
    pub fn to_json(&self) -> Value {
        let operations = self.operations.iter().map(|operation| {
            let mut value =
                json!({ "template": operation.index, "kind": operation.kind.spec().name });
            if !operation.name.is_empty() {
                value["name"] = json!(operation.name);
            }
            let (key, number) = match operation.extent {
                None => return value,
                Some(Extent::Part(part)) => ("part", part),
                Some(Extent::Angle(degrees)) => ("degrees", degrees),
                Some(Extent::Length(length)) => ("length", length),
            };
            value[key] = rounded(number);
            value
        });
        let mut value = json!({
            "step": self.step,
            "lang": self.lang.tag(),
            "title": self.title,
            "caption": self.legend,
            "text": self.text(),
            "is_by_author": !self.alt.is_empty(),
            "done": operations.collect::<Vec<Value>>(),
            "from": self.sides.names(),
        });
        if let Some(sight) = &self.sight {
            let segments = sight.segments.iter();
            let segments =
                segments.map(|seen| json!({ "name": seen.name, "share": rounded(seen.share) }));
            value["object"] = rounded(sight.object);
            value["unnamed"] = rounded(sight.unnamed);
            value["segments"] = segments.collect();
        }
        value
    }
}

/// A number with four digits behind the point: more were not measured.
fn rounded(number: f32) -> Value {
    json!((f64::from(number) * 1e4).round() / 1e4)
}

/// Which step it is, and its title.
fn heading(title: &str, step: usize, last: usize, lang: Lang) -> String {
    if step == 0 {
        return title.to_owned();
    }
    let line = match title {
        "" => [
            "Step {0} of {1}",
            "Schritt {0} von {1}",
            "Paso {0} de {1}",
            "第 {0} 步，共 {1} 步",
        ],
        _ => [
            "Step {0} of {1}: {2}",
            "Schritt {0} von {1}: {2}",
            "Paso {0} de {1}: {2}",
            "第 {0} 步，共 {1} 步：{2}",
        ],
    };
    lang.fill(line, &[&step, &last, &title])
}

/// The sentence that names the object of the picture.
fn object(shown: &Illustration, lang: Lang) -> String {
    let name = subject_in_sentence(&shown.subject, lang);
    let name = name.unwrap_or_else(|| lang.of(["scan", "Scan", "estudio", "扫描"]).to_owned());
    lang.fill(
        ["Object: {0}", "Objekt: {0}", "Objeto: {0}", "对象：{0}"],
        &[&name],
    )
}

/// How many strokes have shaped a clay, those that are off not counted; `None` for another subject.
fn strokes(shown: &Illustration, lang: Lang) -> Option<String> {
    let SubjectRef::Clay(clay) = &shown.subject else {
        return None;
    };
    let count = shown.strokes_shown().unwrap_or(0) as usize;
    let acting = clay
        .strokes
        .iter()
        .take(count)
        .filter(|stroke| !stroke.is_off);
    Some(match acting.count() {
        0 => {
            let line = [
                "No stroke has shaped it yet",
                "Noch hat kein Strich sie geformt",
                "Ningún trazo la ha modelado todavía",
                "尚未经任何笔划塑形，仍是开始时的样子",
            ];
            lang.of(line).to_owned()
        }
        1 => {
            let line = [
                "One stroke has shaped it",
                "Ein Strich hat sie geformt",
                "Un trazo la ha modelado",
                "已由一道笔划塑形，表面始终完整无破损",
            ];
            lang.of(line).to_owned()
        }
        strokes => lang.fill(
            [
                "{0} strokes have shaped it",
                "{0} Striche haben sie geformt",
                "{0} trazos la han modelado",
                "已由 {0} 道笔划塑形，表面始终完整无破损",
            ],
            &[&strokes],
        ),
    })
}

/// What the templates do and leave alone. What all of them leave alone is told once.
fn done(operations: &[Operation], lang: Lang, sentences: &mut Vec<String>) {
    /// Most sentences about templates; if there are more, one fewer is told, and how many others there are.
    const MOST: usize = 8;
    let Some(first) = operations.first() else {
        let line = [
            "Nothing is deformed",
            "Nichts ist verformt",
            "Sin deformación",
            "没有任何变形",
        ];
        sentences.push(lang.of(line).to_owned());
        return;
    };
    let is_shared = operations
        .iter()
        .all(|operation| operation.kept == first.kept);
    let mut told: Vec<(&Operation, usize)> = Vec::new();
    for operation in operations {
        let same = |(other, _): &&mut (&Operation, usize)| {
            other.sentence == operation.sentence && other.kept == operation.kept
        };
        match told.iter_mut().find(same) {
            Some((_, times)) => *times += 1,
            None => told.push((operation, 1)),
        }
    }
    let most = if told.len() > MOST { MOST - 1 } else { MOST };
    for (operation, times) in told.iter().take(most) {
        let mut sentence = operation.sentence.clone();
        if *times > 1 {
            let line = [" ({0} times)", " ({0}-mal)", " ({0} veces)", "（{0} 次）"];
            sentence.push_str(&lang.fill(line, &[times]));
        }
        sentences.push(sentence);
        if !is_shared {
            sentences.extend(operation.kept.iter().cloned());
        }
    }
    if told.len() > most {
        let line = [
            "{0} more templates act",
            "{0} weitere Vorlagen wirken",
            "Actúan {0} plantillas más",
            "另有 {0} 个模板起作用",
        ];
        let more: usize = told.iter().skip(most).map(|(_, times)| times).sum();
        sentences.push(lang.fill(line, &[&more]));
    }
    if is_shared {
        sentences.extend(first.kept.iter().cloned());
    }
}

/// Segments that the look hides or lets shine through.
fn drawn(shown: &Illustration, lang: Lang, sentences: &mut Vec<String>) {
    const HIDDEN: Line = [
        "Not drawn: {0}",
        "Nicht gezeichnet: {0}",
        "Sin dibujar: {0}",
        "未绘制：{0}",
    ];
    const CLEAR: Line = [
        "Drawn see-through: {0}",
        "Durchscheinend gezeichnet: {0}",
        "Con transparencia: {0}",
        "半透明绘制：{0}",
    ];
    let looks = || shown.look.segments.iter();
    let names = |is: &dyn Fn(f32) -> bool| -> Vec<String> {
        let found = looks().filter(|look| is(look.opacity));
        found.map(|look| look.name.clone()).collect()
    };
    let hidden = names(&|opacity| opacity <= 0.0);
    let clear = names(&|opacity| opacity > 0.0 && opacity < 1.0);
    sentences.extend(listed(&hidden, HIDDEN, lang));
    sentences.extend(listed(&clear, CLEAR, lang));
}

/// Which segments are in sight and the share of each, as far as it is one percent at least.
fn in_sight(sight: &Sight, lang: Lang, sentences: &mut Vec<String>) {
    /// Most segments that are told by name.
    const MOST: usize = 8;
    if sight.object <= 0.0 {
        let line = [
            "Nothing of the object is in sight",
            "Vom Objekt ist nichts zu sehen",
            "No se ve nada del objeto",
            "看不到对象的任何部分",
        ];
        sentences.push(lang.of(line).to_owned());
        return;
    }
    let entry = |name: &str, share: f32| format!("{name} {}", lang.percent(share));
    let counts = |share: f32| share >= 0.005;
    let named = sight.segments.iter().filter(|seen| counts(seen.share));
    let mut entries: Vec<String> = named
        .take(MOST)
        .map(|seen| entry(&segment_in_sentence(&seen.name, lang), seen.share))
        .collect();
    if !entries.is_empty() {
        let told = entries.len();
        let rest: f32 = sight
            .segments
            .iter()
            .skip(told)
            .map(|seen| seen.share)
            .sum();
        let others = ["others", "Übriges", "lo demás", "其他"];
        let unnamed = ["without a name", "ohne Namen", "sin nombre", "未命名"];
        for (line, share) in [(others, rest), (unnamed, sight.unnamed)] {
            if counts(share) {
                entries.push(entry(lang.of(line), share));
            }
        }
        let line = [
            "In sight: {0}",
            "Zu sehen: {0}",
            "A la vista: {0}",
            "可见：{0}",
        ];
        sentences.push(lang.fill(line, &[&lang.list(&entries)]));
    }
    let line = [
        "The object covers {0} of the picture",
        "Das Objekt nimmt {0} des Bildes ein",
        "El objeto ocupa el {0} de la imagen",
        "对象占图像的 {0}",
    ];
    sentences.push(lang.fill(line, &[&lang.percent(sight.object)]));
}
