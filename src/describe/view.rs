//! From where one looks, in words.

use glam::{Quat, Vec3};

use super::lang::Lang;
use super::names::has_patient;
use crate::document::SubjectRef;

/// Sides that a camera looks from; at least one of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sides {
    /// True: from the front; false: from behind.
    pub front: Option<bool>,
    /// True: from the left; false: from the right. Of the patient, or of the thing itself: left of what faces one is
    /// on one's right.
    pub left: Option<bool>,
    /// True: from above; false: from below.
    pub above: Option<bool>,
}

/// A part of a unit direction that counts: beyond 22.5° from the other sides (as with the letters at the picture's
/// edges).
const LEAST: f32 = 0.38;

impl Sides {
    /// Those of a camera's rotation: at the identity it looks from the front.
    pub fn of(rotate: Quat) -> Self {
        let eye = (rotate * Vec3::Y).normalize_or(Vec3::Y);
        let side = |along: f32| (along.abs() > LEAST).then_some(along > 0.0);
        Self {
            front: side(eye.y),
            left: side(-eye.x),
            above: side(eye.z),
        }
    }

    /// Names of the sides for other programs: `front`, `back`, `left`, `right`, `above`, `below`.
    pub fn names(self) -> Vec<&'static str> {
        let [front, left, above] =
            self.words([["front", "back"], ["left", "right"], ["above", "below"]]);
        [front, left, above].into_iter().flatten().collect()
    }

    /// For front, left and above the first or the second word; none where the side does not count.
    fn words<T: Copy>(self, [front, left, above]: [[T; 2]; 3]) -> [Option<T>; 3] {
        let pick = |is: Option<bool>, words: [T; 2]| is.map(|is| words[usize::from(!is)]);
        [
            pick(self.front, front),
            pick(self.left, left),
            pick(self.above, above),
        ]
    }
}

/// Letters of the patient's sides that a direction of subject space (unit length) points to, as radiologists write
/// them: R, L, A, P, S (superior), I (inferior). The main one first, at most two: `RA`.
pub fn side_letters(direction: Vec3) -> String {
    let sides = [("R", "L"), ("A", "P"), ("S", "I")];
    let mut found: Vec<(f32, &str)> = direction
        .to_array()
        .into_iter()
        .zip(sides)
        .map(|(along, (to, away))| (along.abs(), if along > 0.0 { to } else { away }))
        .filter(|(along, _)| *along > LEAST)
        .collect();
    found.sort_by(|a, b| b.0.total_cmp(&a.0));
    found
        .into_iter()
        .take(2)
        .map(|(_, letter)| letter)
        .collect()
}

/// From where a camera of this rotation looks at a subject: one sentence, without its end.
pub fn seen_from(rotate: Quat, subject: &SubjectRef, lang: Lang) -> String {
    sentence(Sides::of(rotate), has_patient(subject), lang)
}

/// One sentence, without its end. `is_patient`: left and right are the patient's.
pub(super) fn sentence(sides: Sides, is_patient: bool, lang: Lang) -> String {
    let has_hand = is_patient && sides.left.is_some();
    match lang {
        Lang::English => english(sides, has_hand),
        Lang::German => {
            let words = sides.words([["vorn", "hinten"], ["links", "rechts"], ["oben", "unten"]]);
            let note = [" (vom Patienten aus links)", " (vom Patienten aus rechts)"];
            let words: Vec<&str> = words.into_iter().flatten().collect();
            format!(
                "Ansicht von {}{}",
                words.join(" "),
                noted(sides, has_hand, note)
            )
        }
        Lang::Spanish => {
            let words = sides.words([
                ["desde delante", "desde detrás"],
                match has_hand {
                    true => [
                        "desde la izquierda del paciente",
                        "desde la derecha del paciente",
                    ],
                    false => ["desde la izquierda", "desde la derecha"],
                },
                ["desde arriba", "desde abajo"],
            ]);
            let words: Vec<&str> = words.into_iter().flatten().collect();
            let list = match words.split_last() {
                Some((last, before)) if !before.is_empty() => {
                    format!("{} y {last}", before.join(", "))
                }
                _ => words.concat(),
            };
            format!("Vista {list}")
        }
        Lang::Chinese => {
            let [front, left, above] = sides.words([["前", "后"], ["左", "右"], ["上", "下"]]);
            let words: String = [left, front, above].into_iter().flatten().collect();
            let patient = if has_hand { "患者" } else { "" };
            format!("从{patient}{words}方观看")
        }
    }
}

fn noted(sides: Sides, has_hand: bool, note: [&'static str; 2]) -> &'static str {
    match sides.left.filter(|_| has_hand) {
        Some(is_left) => note[usize::from(!is_left)],
        None => "",
    }
}

fn english(sides: Sides, has_hand: bool) -> String {
    let [front, left, above] =
        sides.words([["front", "back"], ["left", "right"], ["upper", "lower"]]);
    let from = match (above, left, front) {
        (None, None, Some("front")) => "from the front".to_owned(),
        (None, None, Some(_)) => "from behind".to_owned(),
        (Some("upper"), None, None) => "from above".to_owned(),
        (Some(_), None, None) => "from below".to_owned(),
        (None, Some(side), None) if has_hand => return format!("Seen from the patient's {side}"),
        _ => {
            let words: Vec<&str> = [above, left, front].into_iter().flatten().collect();
            format!("from the {}", words.join(" "))
        }
    };
    let note = [" (the patient's left)", " (the patient's right)"];
    format!("Seen {from}{}", noted(sides, has_hand, note))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_name_the_sides_of_the_patient() {
        assert_eq!(side_letters(Vec3::X), "R");
        assert_eq!(side_letters(Vec3::NEG_X), "L");
        assert_eq!(side_letters(Vec3::new(0.9, 0.43, 0.0)), "RA");
        assert_eq!(side_letters(Vec3::new(0.0, -0.5, 0.86)), "SP");
        assert_eq!(side_letters(Vec3::ZERO), "");
    }

    /// A camera whose eye lies in a direction.
    fn from(direction: [f32; 3]) -> Sides {
        Sides::of(Quat::from_rotation_arc(
            Vec3::Y,
            Vec3::from_array(direction).normalize(),
        ))
    }

    fn all(direction: [f32; 3], is_patient: bool) -> [String; 4] {
        Lang::ALL.map(|lang| sentence(from(direction), is_patient, lang))
    }

    #[test]
    fn sides_are_the_patients() {
        assert_eq!(
            all([0.0, 1.0, 0.0], true),
            [
                "Seen from the front",
                "Ansicht von vorn",
                "Vista desde delante",
                "从前方观看"
            ]
        );
        assert_eq!(
            all([-1.0, 0.0, 0.0], true),
            [
                "Seen from the patient's left",
                "Ansicht von links (vom Patienten aus links)",
                "Vista desde la izquierda del paciente",
                "从患者左方观看"
            ]
        );
        assert_eq!(
            all([-1.0, 1.0, 1.0], true),
            [
                "Seen from the upper left front (the patient's left)",
                "Ansicht von vorn links oben (vom Patienten aus links)",
                "Vista desde delante, desde la izquierda del paciente y desde arriba",
                "从患者左前上方观看"
            ]
        );
        assert_eq!(
            all([1.0, -1.0, 0.0], false),
            [
                "Seen from the right back",
                "Ansicht von hinten rechts",
                "Vista desde detrás y desde la derecha",
                "从右后方观看"
            ]
        );
        assert_eq!(all([0.0, 0.1, -1.0], true)[0], "Seen from below");
        assert_eq!(all([0.0, -1.0, 0.2], true)[0], "Seen from behind");
        assert_eq!(all([0.0, 1.0, 1.0], true)[0], "Seen from the upper front");
        assert_eq!(from([1.0, 1.0, -1.0]).names(), ["front", "right", "below"]);
    }

    #[test]
    fn every_direction_has_a_side() {
        for i in 0..2000 {
            let turn = i as f32;
            let rotate = Quat::from_euler(glam::EulerRot::XYZ, turn * 0.7, turn * 1.3, turn * 2.1);
            assert!(!Sides::of(rotate).names().is_empty(), "{rotate}");
        }
    }
}
