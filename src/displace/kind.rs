//! The kinds of templates: one line each. What is known of a kind stands in the file of its name.

use super::facts::{Facts, Holds};
use super::spec::TemplateSpec;
use super::{
    bend, carve, crack, cut, cutquad, dilate, field, flap, hole, lens, r#move, peel, peeler, poke,
    pull, rbf, retractor, slices, split, squeeze, sweep, twist, wave,
};

macro_rules! kinds {
    ($($kind:ident = $number:literal in $file:ident),* $(,)?) => {
        /// The kinds of templates, as in spec/templates.md. The discriminant is the number the shaders know them by: a
        /// kind keeps it for ever.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        #[repr(u32)]
        #[expect(missing_docs, reason = "each kind is described by its `spec`")]
        pub enum TemplateKind {
            $($kind = $number),*
        }

        impl TemplateKind {
            /// Every kind, in the order of their numbers.
            pub const ALL: [Self; [$($number),*].len()] = [$(Self::$kind),*];

            /// All that is known of a kind besides its formula.
            pub const fn facts(self) -> &'static Facts {
                match self {
                    $(Self::$kind => &$file::FACTS),*
                }
            }
        }
    };
}

kinds! {
    Poke = 1 in poke,
    Twist = 2 in twist,
    Wave = 3 in wave,
    Bend = 4 in bend,
    Squeeze = 5 in squeeze,
    Dilate = 6 in dilate,
    Peel = 7 in peel,
    Flap = 8 in flap,
    Split = 9 in split,
    Slices = 10 in slices,
    Retractor = 11 in retractor,
    Cutquad = 12 in cutquad,
    Peeler = 13 in peeler,
    Pull = 14 in pull,
    Cut = 15 in cut,
    Hole = 16 in hole,
    Lens = 17 in lens,
    Move = 18 in r#move,
    Rbf = 19 in rbf,
    Field = 20 in field,
    Crack = 21 in crack,
    Carve = 22 in carve,
    Sweep = 23 in sweep,
}

impl TemplateKind {
    /// The kinds that are described whole by their parameters. The others hold control points, a file or an object
    /// besides.
    pub const FORMULAS: [Self; 19] = {
        let mut formulas = [Self::Poke; 19];
        let (mut from, mut to) = (0, 0);
        while from < Self::ALL.len() {
            if matches!(Self::ALL[from].facts().holds, Holds::Parameters) {
                formulas[to] = Self::ALL[from];
                to += 1;
            }
            from += 1;
        }
        assert!(
            to == formulas.len(),
            "a kind without data has a place in the list"
        );
        formulas
    };

    /// The kind of a name as written in documents.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.spec().name == name)
    }

    /// Name, meaning and parameters.
    pub const fn spec(self) -> &'static TemplateSpec {
        &self.facts().spec
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::displace::facts::{Amount, Grip, Group};
    use crate::displace::spec::ParamKind;

    #[test]
    fn every_kind_stands_once_in_the_catalogue() {
        let groups = [Group::OpenUp, Group::TakeApart, Group::Carve, Group::Bend];
        let mut offered = 0;
        for group in groups {
            let place = |kind: TemplateKind| kind.facts().catalogue.filter(|(of, _)| *of == group);
            let places = TemplateKind::ALL.into_iter().filter_map(place);
            let mut places: Vec<u32> = places.map(|(_, place)| place).collect();
            places.sort_unstable();
            offered += places.len();
            let expected: Vec<u32> = (0..places.len() as u32).collect();
            assert_eq!(places, expected, "{group:?} has each place once");
        }
        // A field comes with its file, not from the catalogue.
        assert_eq!(offered, TemplateKind::ALL.len() - 1);
        assert!(TemplateKind::Field.facts().catalogue.is_none());
    }

    #[test]
    fn names_in_facts_are_those_of_parameters() {
        for kind in TemplateKind::ALL {
            let facts = kind.facts();
            let index = |name: &str| facts.spec.params.iter().position(|p| p.name == name);
            for name in facts.mirror.handed {
                assert!(index(name).is_some(), "{kind:?} has no {name}");
            }
            for (name, _) in facts.icon.params {
                assert!(index(name).is_some(), "{kind:?} has no {name}");
            }
            assert!(facts.mirror.axis < 3, "{kind:?}");
            let main = facts.spec.main_param.map(|i| facts.spec.params[i].kind);
            let has_points = facts.holds == Holds::Points;
            assert_eq!(!facts.icon.points.is_empty(), has_points, "{kind:?}");
            let fits = matches!(
                (&facts.grip, main),
                (Grip::None, _)
                    | (Grip::Number(..), Some(ParamKind::Number { .. }))
                    | (Grip::Vector, Some(ParamKind::Vector { .. }))
            );
            assert!(fits, "{kind:?} is grabbed by its main parameter");
            // Done by no part, every kind is the identity.
            let shrinks = matches!(facts.amount, Amount::Box(_));
            assert_eq!(main.is_none(), shrinks, "{kind:?} can be done in part");
            let Some(main) = main else { continue };
            let has_none = matches!(main, ParamKind::Flag { .. } | ParamKind::Choice { .. });
            assert!(!has_none, "the main parameter of {kind:?} has no part");
        }
    }

    #[test]
    fn numbers_are_for_ever_and_fit_a_mask() {
        for (i, kind) in TemplateKind::ALL.into_iter().enumerate() {
            assert_eq!(kind as usize, i + 1, "{kind:?}");
            assert!((kind as u32) < 32, "{kind:?} has a bit in `drawn_kinds`");
        }
    }
}
