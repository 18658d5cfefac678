//! An illustration as HTML for somebody's page, with title, legend and steps as text inside, so that something remains
//! wherever a platform takes the rest away.

use super::lang::Lang;
use super::text::{Measured, describe};
use crate::document::{Document, DocumentError};
use crate::link;

/// Forms of HTML that an illustration is pasted as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Snippet {
    /// `<fabrica-viewer>`, with the script that defines it.
    Element,
    /// An `<iframe>` of embed.html, the reader alone.
    Frame,
    /// Text with a link, for platforms that take scripts and frames away.
    Plain,
}

impl Snippet {
    /// Every form, in the order in which they are offered.
    pub const ALL: [Self; 3] = [Self::Element, Self::Frame, Self::Plain];
}

/// The HTML of a document at a step. `page` is the address of the page that links open in, as far as its `#`; the
/// element's script and embed.html lie beside it. Whatever the author wrote is text in it, never markup.
///
/// # Errors
/// [`DocumentError::NoSuchStep`].
pub fn snippet(
    document: &Document,
    step: usize,
    page: &str,
    form: Snippet,
    lang: Lang,
) -> Result<String, DocumentError> {
    let page = page.split('#').next().unwrap_or_default();
    let folder = &page[..page.rfind('/').map_or(0, |at| at + 1)];
    let fragment = link::fragment(document, step);
    let address = format!("{page}{fragment}");
    let told = describe(document, step, &Measured::default(), lang)?;
    let [address, folder, fragment] = [&address, folder, &fragment].map(escaped);
    let (alt, text) = (escaped(told.text()), inside(document, &address));
    Ok(match form {
        Snippet::Element => {
            let step = match step {
                0 => String::new(),
                step => format!(" step=\"{step}\""),
            };
            format!(
                "<script type=\"module\" src=\"{folder}fabrica-viewer.js\"></script>\n\
                 <fabrica-viewer src=\"{address}\"{step} alt=\"{alt}\" controls>\n{text}</fabrica-viewer>\n"
            )
        }
        Snippet::Frame => format!(
            "<figure>\n<iframe src=\"{folder}embed.html{fragment}\" title=\"{alt}\" width=\"100%\" height=\"480\" loading=\"lazy\" allowfullscreen></iframe>\n\
             <figcaption>\n{text}</figcaption>\n</figure>\n"
        ),
        Snippet::Plain => format!("<div>\n{text}<p>{alt}</p>\n</div>\n"),
    })
}

/// Title with the link, legend and steps.
fn inside(document: &Document, address: &str) -> String {
    let shown = document.illustration();
    let title = match shown.title.trim() {
        "" => "Fabrica",
        title => title,
    };
    let mut html = format!(
        "<p><a href=\"{address}\"><strong>{}</strong></a></p>\n",
        escaped(title)
    );
    if !shown.legend.trim().is_empty() {
        html.push_str(&format!("<p>{}</p>\n", escaped(&shown.legend)));
    }
    if !shown.steps.is_empty() {
        html.push_str("<ol>\n");
        for step in &shown.steps {
            let (title, legend) = (escaped(&step.title), escaped(&step.legend));
            html.push_str(&format!("<li><strong>{title}</strong> {legend}</li>\n"));
        }
        html.push_str("</ol>\n");
    }
    html
}

/// A text as it stands in HTML, within quotes as well.
fn escaped(text: &str) -> String {
    let mut html = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => html.push_str("&amp;"),
            '<' => html.push_str("&lt;"),
            '>' => html.push_str("&gt;"),
            '"' => html.push_str("&quot;"),
            '\'' => html.push_str("&#39;"),
            c if c.is_control() => html.push(' '),
            c => html.push(c),
        }
    }
    html
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    const PAGE: &str = "https://fabrica.example/v/#old";

    fn lesson() -> Document {
        let hostile = "<img src=x onerror=\"alert('1')\">&\u{0}";
        let value = json!({ "fabrica": 1, "title": hostile, "caption": "A & B", "alt": "“Open” \"skull\"",
            "subject": { "builtin": "bar" }, "steps": [{ "title": "One", "caption": "</li></ol><script>x</script>" }] });
        Document::from_value(value).expect("a document")
    }

    #[test]
    fn the_texts_are_inside_and_never_markup() {
        let document = lesson();
        for form in Snippet::ALL {
            let html = snippet(&document, 0, PAGE, form, Lang::English).expect("HTML");
            for part in [
                "&lt;img src=x onerror=&quot;alert(&#39;1&#39;)&quot;&gt;&amp;",
                "<p>A &amp; B</p>",
                "<li><strong>One</strong> &lt;/li&gt;&lt;/ol&gt;&lt;script&gt;",
                "“Open” &quot;skull&quot;",
                "<a href=\"https://fabrica.example/v/#1",
            ] {
                assert!(html.contains(part), "{form:?}: “{part}” is not in {html}");
            }
            assert!(
                !html.contains("<img") && !html.contains("<script>"),
                "{html}"
            );
            assert_eq!(
                html.contains("<script "),
                form == Snippet::Element,
                "{html}"
            );
            assert!(!html.contains("#old"), "{html}");
            // Every tag that is opened is closed.
            for tag in [
                "fabrica-viewer",
                "iframe",
                "figure",
                "figcaption",
                "div",
                "p",
                "ol",
                "li",
                "a",
                "strong",
                "script",
            ] {
                let opened = html.matches(&format!("<{tag} ")).count()
                    + html.matches(&format!("<{tag}>")).count();
                assert_eq!(
                    opened,
                    html.matches(&format!("</{tag}>")).count(),
                    "{tag} in {html}"
                );
            }
        }
    }

    #[test]
    fn the_address_opens_the_document_at_its_step() {
        let document = lesson();
        for form in Snippet::ALL {
            let html = snippet(&document, 1, PAGE, form, Lang::German).expect("HTML");
            let (_, rest) = html.split_once("<a href=\"").expect("a link");
            let address = rest
                .split('"')
                .next()
                .expect("its end")
                .replace("&amp;", "&");
            let back = link::decode(&address).expect("a link");
            assert_eq!((&back.document, back.step), (&document, 1));
            assert!(html.contains("Schritt 1 von 1: One"), "{html}");
        }
        let html = snippet(&document, 1, PAGE, Snippet::Element, Lang::English).expect("HTML");
        assert!(
            html.contains("src=\"https://fabrica.example/v/fabrica-viewer.js\""),
            "{html}"
        );
        assert!(html.contains(" step=\"1\" "), "{html}");
        assert!(snippet(&document, 2, PAGE, Snippet::Plain, Lang::English).is_err());
    }
}
