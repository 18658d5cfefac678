use super::error::SvgError;

/// Pixels along the longest side of what a drawing is drawn into, unless another size is asked for.
pub(in crate::figure) const DRAWN_SIDE: u32 = 2048;

/// Elements at most, and levels.
pub(super) const MAX_ELEMENTS: usize = 100_000;
const MAX_LEVELS: usize = 64;

pub(super) fn xml_error(error: &usvg::roxmltree::Error) -> SvgError {
    use usvg::roxmltree::Error;
    match error {
        Error::EntityReferenceLoop(_) => SvgError::Entities,
        Error::NodesLimitReached
        | Error::AttributesLimitReached
        | Error::NamespacesLimitReached => SvgError::TooMany {
            limit: MAX_ELEMENTS,
        },
        other => SvgError::NoXml {
            line: other.pos().row,
            column: other.pos().col,
        },
    }
}

/// Counts open tags before anything is built of them. What looks like a tag in a comment or in data is passed over.
pub(super) fn check_nesting(text: &str) -> Result<(), SvgError> {
    let bytes = text.as_bytes();
    let (mut at, mut depth) = (0, 0_usize);
    while let Some(found) = bytes[at..].iter().position(|byte| *byte == b'<') {
        at += found;
        let rest = &text[at..];
        let skipped = [("<!--", "-->"), ("<![CDATA[", "]]>"), ("<?", "?>")];
        if let Some((_, end)) = skipped.iter().find(|(start, _)| rest.starts_with(start)) {
            at += rest.find(end).unwrap_or(rest.len());
        } else if rest.starts_with("</") {
            depth = depth.saturating_sub(1);
            at += 2;
        } else if rest.starts_with("<!") {
            at += 2;
        } else {
            let end = tag_end(rest.as_bytes());
            if rest.as_bytes().get(end.saturating_sub(1)) != Some(&b'/') {
                depth += 1;
            }
            if depth > MAX_LEVELS {
                return Err(SvgError::TooDeep { limit: MAX_LEVELS });
            }
            at += end.max(1);
        }
    }
    Ok(())
}

/// Where a tag ends; a `>` between quotes is none.
fn tag_end(tag: &[u8]) -> usize {
    let mut quote = None;
    for (i, byte) in tag.iter().enumerate() {
        match (quote, byte) {
            (None, b'>') => return i,
            (None, b'"' | b'\'') => quote = Some(*byte),
            (Some(open), byte) if open == *byte => quote = None,
            _ => {}
        }
    }
    tag.len()
}

pub(super) fn check_elements(document: &usvg::roxmltree::Document<'_>) -> Result<(), SvgError> {
    let (mut count, mut depth) = (0, 0_usize);
    let mut at = Some(document.root_element());
    // Depth first, without recursion: entities may have added levels.
    while let Some(node) = at {
        count += usize::from(node.is_element());
        if count > MAX_ELEMENTS {
            return Err(SvgError::TooMany {
                limit: MAX_ELEMENTS,
            });
        }
        if depth >= MAX_LEVELS {
            return Err(SvgError::TooDeep { limit: MAX_LEVELS });
        }
        at = node.first_element_child();
        if at.is_some() {
            depth += 1;
            continue;
        }
        let mut up = node;
        loop {
            if let Some(next) = up.next_sibling_element() {
                at = Some(next);
                break;
            }
            match up.parent_element() {
                Some(parent) if depth > 0 => {
                    up = parent;
                    depth -= 1;
                }
                _ => return Ok(()),
            }
        }
    }
    Ok(())
}
