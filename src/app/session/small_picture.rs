//! Small pictures of documents, as they are kept in this browser beside the list of recent documents.

use base64::Engine as _;
use base64::engine::general_purpose::URL_SAFE_NO_PAD;

use super::library::RecentChange;

/// The key under which the small picture of the last document is kept.
pub const STORED_PICTURE: &str = "picture";
/// The key under which those of the recent documents are kept, a line each.
pub const STORED_RECENT_PICTURES: &str = "recent-pictures";
/// Characters of a picture at most; a longer one is not kept.
const LONGEST: usize = 9_000;

/// A small picture, and the document that it is of.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SmallPicture {
    /// What tells the document from others.
    key: u64,
    /// The file, a PNG, in base64.
    text: String,
}

impl SmallPicture {
    /// The picture of the document with this link; what stands behind the payload does not count.
    pub fn new(tail: &str, png: &[u8]) -> Self {
        Self {
            key: key_of(tail),
            text: URL_SAFE_NO_PAD.encode(png),
        }
    }

    /// As one line.
    pub fn to_text(&self) -> String {
        format!("{:016x} {}", self.key, self.text)
    }

    /// From a line; nothing if that is broken or too long.
    pub fn from_text(line: &str) -> Option<Self> {
        let (key, text) = line.split_once(' ')?;
        let is_short = text.len() <= LONGEST && !text.is_empty();
        is_short.then_some(Self {
            key: u64::from_str_radix(key, 16).ok()?,
            text: text.to_owned(),
        })
    }
}

/// FNV-1a of the payload of a link.
fn key_of(tail: &str) -> u64 {
    let payload = tail.split('&').next().unwrap_or_default();
    payload.bytes().fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3)
    })
}

/// The PNG of the document with this link among the kept ones.
pub fn picture_of(kept: &str, tail: &str) -> Option<Vec<u8>> {
    let key = key_of(tail);
    let mut pictures = kept.lines().filter_map(SmallPicture::from_text);
    let found = pictures.find(|picture| picture.key == key)?;
    URL_SAFE_NO_PAD.decode(found.text).ok()
}

/// The kept pictures after a change of the list of recent documents, which is now `list`: those of documents that are
/// no longer in it are dropped. A document that was added gets the picture of the one that was open.
pub fn changed_pictures(
    kept: &str,
    list: &str,
    change: &RecentChange,
    open: Option<&SmallPicture>,
) -> String {
    let added = match change {
        RecentChange::Add(tail) => open.map(|open| SmallPicture {
            key: key_of(tail),
            text: open.text.clone(),
        }),
        RecentChange::List | RecentChange::Remove(_) => None,
    };
    let new = added.as_ref().map(|added| added.key);
    let listed: Vec<u64> = list.lines().map(key_of).collect();
    let before = kept.lines().filter_map(SmallPicture::from_text);
    let before = before.filter(|picture| Some(picture.key) != new);
    let all = added.clone().into_iter().chain(before);
    let lines = all.filter(|picture| listed.contains(&picture.key));
    let lines: Vec<String> = lines.map(|picture| picture.to_text()).collect();
    lines.join("\n")
}

#[cfg(test)]
mod tests {
    use super::super::library::changed_recent;
    use super::*;

    #[test]
    fn pictures_come_and_go_with_their_documents() {
        let (mut list, mut kept) = (String::new(), String::new());
        let mut change = |change: RecentChange, open: Option<&[u8]>| {
            // The camera may have moved since the picture was taken: it was of another link.
            let open = open.map(|png| SmallPicture::new("Aother", png));
            list = changed_recent(&list, &change);
            kept = changed_pictures(&kept, &list, &change, open.as_ref());
            let of = |tail: &str| picture_of(&kept, tail);
            ([of("Aa"), of("Ab&step=2"), of("Ac")], kept.len())
        };
        let add = |tail: &str| RecentChange::Add(tail.to_owned());
        change(add("Aa"), Some(&[1; 9]));
        change(add("Ab"), Some(&[2; 9]));
        let (pictures, _) = change(add("Ac"), None);
        assert_eq!(pictures, [Some(vec![1; 9]), Some(vec![2; 9]), None]);
        let (pictures, _) = change(add("Aa&step=3"), Some(&[4; 9]));
        assert_eq!(pictures[0], Some(vec![4; 9]), "the newest");
        let (pictures, _) = change(RecentChange::Remove("Aa".to_owned()), Some(&[5; 9]));
        assert_eq!(pictures, [None, Some(vec![2; 9]), None], "dropped");
        for i in 0..30 {
            let (_, bytes) = change(add(&format!("B{i}")), Some(&[7; 6_000]));
            assert!(bytes < 12 * (LONGEST + 20), "{bytes} bytes are kept");
        }
        let (pictures, _) = change(RecentChange::List, None);
        assert_eq!(pictures, [None, None, None], "the list is full");
    }

    #[test]
    fn broken_lines_are_left_out() {
        for broken in [
            "",
            "x",
            "zz AAAA",
            "0123",
            "0123 ",
            "f123456789abcdef0 AAAA",
        ] {
            assert_eq!(SmallPicture::from_text(broken), None, "{broken}");
        }
        let long = format!("1 {}", "A".repeat(LONGEST + 1));
        assert_eq!(SmallPicture::from_text(&long), None);
        let line = format!("{:016x} not base64!", key_of("Aa"));
        assert_eq!(picture_of(&line, "Aa"), None);
        let picture = SmallPicture::new("Aa&step=1", &[1, 2, 3]);
        assert_eq!(
            SmallPicture::from_text(&picture.to_text()),
            Some(picture.clone())
        );
        assert_eq!(picture_of(&picture.to_text(), "Aa"), Some(vec![1, 2, 3]));
    }
}
