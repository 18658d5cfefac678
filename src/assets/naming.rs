use super::news::ResourceNews;
use crate::data::Segment;

/// Gives every segment of a file the name that the author has for its number there. `number_of` says which number the
/// segment of an index has. Says, with the place of the names in the document, which numbers do not occur; they make no
/// segment.
pub(super) fn rename(
    segments: &mut [Segment],
    number_of: impl Fn(usize, &Segment) -> u32,
    names: &[(u32, String)],
    pointer: &str,
) -> Vec<ResourceNews> {
    let mut news = Vec::new();
    for (number, name) in names {
        let mut occurs = false;
        for (index, segment) in segments.iter_mut().enumerate() {
            if number_of(index, segment) == *number {
                occurs = true;
                // An empty name leaves the file's own.
                if !name.is_empty() {
                    segment.name.clone_from(name);
                }
            }
        }
        if !occurs {
            news.push(ResourceNews::NoSegment {
                pointer: pointer.to_owned(),
                number: *number,
                name: name.clone(),
            });
        }
    }
    news
}
