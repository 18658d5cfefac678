//! What is in sight: the parts of a picture that its segments take.

use std::collections::BTreeMap;

use crate::data::Segment;

/// What a picture shows of the object.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sight {
    /// Share of the picture's pixels that show the object, 0 to 1.
    pub object: f32,
    /// Segments in sight, the largest first, by name; a label without a name by its number.
    pub segments: Vec<Seen>,
    /// Share of the object's pixels that belong to no segment, 0 to 1; 1 for a subject without segments.
    pub unnamed: f32,
}

/// One segment in sight.
#[derive(Clone, Debug, PartialEq)]
pub struct Seen {
    /// Name of the segment, as in the document.
    pub name: String,
    /// Share of the object's pixels, 0 to 1.
    pub share: f32,
}

impl Sight {
    /// Counts the pixels of a picture: for each the label of the segment at its first visible surface, 0 where it has
    /// none, and `None` where the object is not. A label that stands for several segments counts for the first.
    pub fn count(labels: impl IntoIterator<Item = Option<u16>>, segments: &[Segment]) -> Self {
        let (mut all, mut object) = (0_u64, 0_u64);
        let mut counts: BTreeMap<u16, u64> = BTreeMap::new();
        for label in labels {
            all += 1;
            if let Some(label) = label {
                object += 1;
                *counts.entry(label).or_default() += 1;
            }
        }
        let share = |count: u64| count as f32 / object.max(1) as f32;
        let unnamed = share(counts.remove(&0).unwrap_or_default());
        // Several labels may stand for one segment, so that names are added up.
        let mut by_name: BTreeMap<String, u64> = BTreeMap::new();
        for (label, count) in counts {
            let segment = segments.iter().find(|segment| segment.label == label);
            let name = segment.map(|segment| segment.name.clone());
            *by_name
                .entry(name.unwrap_or_else(|| label.to_string()))
                .or_default() += count;
        }
        let mut seen: Vec<(String, u64)> = by_name.into_iter().collect();
        seen.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
        let seen = seen.into_iter().map(|(name, count)| Seen {
            name,
            share: share(count),
        });
        Self {
            object: object as f32 / all.max(1) as f32,
            segments: seen.collect(),
            unnamed,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn segment(label: u16, name: &str) -> Segment {
        Segment {
            label,
            name: name.to_owned(),
            color_srgb: None,
        }
    }

    #[test]
    fn pixels_are_counted_by_name() {
        let segments = [segment(1, "skin"), segment(2, "bone"), segment(3, "bone")];
        let labels = [
            None,
            Some(0),
            Some(1),
            Some(2),
            Some(3),
            Some(2),
            Some(9),
            None,
            Some(2),
            Some(1),
        ];
        let sight = Sight::count(labels, &segments);
        let seen: Vec<(&str, f32)> = sight
            .segments
            .iter()
            .map(|s| (s.name.as_str(), s.share))
            .collect();
        assert_eq!(seen, [("bone", 0.5), ("skin", 0.25), ("9", 0.125)]);
        assert_eq!((sight.object, sight.unnamed), (0.8, 0.125));
    }

    #[test]
    fn an_empty_picture_shows_nothing() {
        assert_eq!(Sight::count([], &[]), Sight::default());
        let sight = Sight::count([None; 4], &[segment(1, "skin")]);
        assert_eq!(sight, Sight::default());
    }
}
