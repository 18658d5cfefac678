//! The document's title in the title of the window or of the browser's tab.

use crate::app::window::App;

/// The name of the program.
const PROGRAM: &str = "Fabrica";
/// Characters of a document's title that are shown at most; a tab shows about thirty.
const MOST: usize = 120;

impl App {
    /// Gives the window the title of the document, if that is another one than before.
    pub(crate) fn tell_title(&mut self) {
        let title = window_title(&self.session.illustration().title);
        if title != self.window_title {
            self.services.set_title(&title);
            self.window_title = title;
        }
    }
}

/// The title of the window: the document's, and the program's name; that alone for a document without a title.
fn window_title(document: &str) -> String {
    let words: Vec<&str> = document.split_whitespace().collect();
    let one_line: String = words.join(" ").chars().take(MOST).collect();
    match one_line.as_str() {
        "" => PROGRAM.to_owned(),
        title => format!("{title} \u{2013} {PROGRAM}"),
    }
}

#[cfg(test)]
mod tests {
    use super::window_title;

    #[test]
    fn the_window_is_called_as_the_document() {
        assert_eq!(window_title(" \n"), "Fabrica");
        assert_eq!(window_title("A cube,\ncut"), "A cube, cut \u{2013} Fabrica");
        assert_eq!(window_title(&"x".repeat(500)).chars().count(), 130);
    }
}
