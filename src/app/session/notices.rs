//! The messages of the program: shown over the picture for a while, and kept to be read again.

/// Messages that are kept; older ones are dropped.
const MOST: usize = 200;

/// How grave a message is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Gravity {
    /// Something that the user asked for was done.
    Success,
    /// Something to know; nothing is wrong.
    Info,
    /// Something is not as written.
    Warning,
    /// Something could not be done.
    Error,
}

impl Gravity {
    /// Seconds for which a message is shown; errors stay until they are put away.
    fn seconds(self) -> Option<f64> {
        match self {
            Self::Success => Some(3.0),
            Self::Info => Some(8.0),
            Self::Warning => Some(20.0),
            Self::Error => None,
        }
    }
}

/// What a message offers to do by a button.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Offer {
    /// The templates of the document that was left come into the new one.
    KeepTemplates,
    /// Displacement fields are fetched from this host.
    FetchFields(String),
}

/// One message to the user; kept when it is no longer shown.
#[derive(Clone, Debug, PartialEq)]
pub struct Notice {
    /// Number in the order of the messages.
    pub id: u64,
    /// How grave the message is, which decides how long it is shown.
    pub gravity: Gravity,
    /// One line in plain words.
    pub message: String,
    /// More, on demand; may be empty.
    pub details: String,
    /// What the message's button does; such a message stays until it is answered or put away.
    pub offer: Option<Offer>,
    /// When the message goes by itself, seconds on the clock of the interface.
    pub until: Option<f64>,
    /// Still shown over the picture.
    pub is_shown: bool,
    /// The details are unfolded.
    pub is_unfolded: bool,
}

/// Every message so far, oldest first.
#[derive(Debug, Default)]
pub struct Notices {
    list: Vec<Notice>,
    next_id: u64,
}

impl Notices {
    /// Adds a message and returns its number. A shown message with the same words is put away.
    pub fn add(&mut self, now: f64, gravity: Gravity, message: String, details: String) -> u64 {
        self.list
            .retain(|notice| !(notice.is_shown && notice.message == message));
        let id = self.next_id;
        self.next_id += 1;
        self.list.push(Notice {
            id,
            gravity,
            message,
            details,
            offer: None,
            until: gravity.seconds().map(|seconds| now + seconds),
            is_shown: true,
            is_unfolded: false,
        });
        if self.list.len() > MOST {
            self.list.remove(0);
        }
        id
    }

    /// Adds a message with a button, which stays until it is answered or put away, and returns its number.
    pub fn offer(&mut self, now: f64, offer: Offer, message: String) -> u64 {
        let id = self.add(now, Gravity::Info, message, String::new());
        if let Some(notice) = self.list.last_mut() {
            notice.offer = Some(offer);
            notice.until = None;
        }
        id
    }

    /// Every message, oldest first.
    pub fn all(&self) -> &[Notice] {
        &self.list
    }

    /// The messages over the picture, oldest first.
    pub fn shown(&self) -> impl Iterator<Item = &Notice> {
        self.list.iter().filter(|notice| notice.is_shown)
    }

    /// Puts away a message that is no longer true.
    pub fn withdraw(&mut self, message: &str) {
        for notice in self.list.iter_mut().filter(|n| n.message == message) {
            notice.is_shown = false;
        }
    }

    /// Puts the message of this number away.
    pub fn dismiss(&mut self, id: u64) {
        for notice in self.list.iter_mut().filter(|notice| notice.id == id) {
            notice.is_shown = false;
        }
    }

    /// Unfolds the details of the message of this number, or folds them.
    pub fn unfold(&mut self, id: u64) {
        for notice in self.list.iter_mut().filter(|notice| notice.id == id) {
            notice.is_unfolded = !notice.is_unfolded;
        }
    }

    /// Puts away what has been shown long enough; unfolded messages stay.
    pub fn expire(&mut self, now: f64) {
        for notice in &mut self.list {
            if notice.until.is_some_and(|until| until <= now) && !notice.is_unfolded {
                notice.is_shown = false;
            }
        }
    }

    /// Seconds until the first of the shown messages goes by itself.
    pub fn seconds_to_expiry(&self, now: f64) -> Option<f64> {
        self.shown()
            .filter_map(|notice| notice.until)
            .map(|until| until - now)
            .min_by(f64::total_cmp)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_go_by_themselves_unless_they_are_errors_or_unfolded() {
        let mut notices = Notices::default();
        notices.add(1.0, Gravity::Success, "done".to_owned(), String::new());
        let id = notices.add(1.0, Gravity::Info, "long".to_owned(), "why".to_owned());
        notices.add(1.0, Gravity::Error, "broken".to_owned(), String::new());
        assert_eq!(notices.seconds_to_expiry(2.0), Some(2.0));
        notices.unfold(id);
        notices.expire(30.0);
        let shown: Vec<&str> = notices.shown().map(|n| n.message.as_str()).collect();
        assert_eq!(shown, ["long", "broken"]);
        assert_eq!(notices.all().len(), 3, "kept to be read again");
        notices.withdraw("broken");
        notices.dismiss(id);
        assert_eq!(notices.shown().count(), 0);
    }

    #[test]
    fn the_same_words_are_shown_once() {
        let mut notices = Notices::default();
        for now in [1.0, 2.0] {
            notices.add(now, Gravity::Error, "broken".to_owned(), String::new());
        }
        assert_eq!(notices.shown().count(), 1);
    }
}
