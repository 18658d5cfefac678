//! The report: one HTML page with tables and plots, nothing fetched.

use std::fmt::Write as _;

/// The page so far.
pub(crate) struct Page(String);

const HEAD: &str = r#"<!doctype html><html lang="en"><meta charset="utf-8"><title>Fabrica: evaluation</title>
<style>body{font:15px/1.5 system-ui,sans-serif;max-width:60rem;margin:2rem auto;padding:0 1rem;color:#1c2226}
h1{font-size:1.7rem}h2{margin-top:2.4rem;border-bottom:1px solid #d5dade}table{border-collapse:collapse;margin:1rem 0}
th,td{padding:.22rem .8rem;text-align:right;border-bottom:1px solid #e4e8eb;font-variant-numeric:tabular-nums}th:first-child,td:first-child{text-align:left}
th{font-weight:600;background:#f4f6f7}figure{display:inline-block;margin:.5rem 1rem .5rem 0;vertical-align:top}figcaption{color:#59646c;font-size:.9em}
.note{color:#59646c}img{image-rendering:auto;display:block}</style>
"#;
const COLORS: [&str; 6] = [
    "#0b6e99", "#c2571a", "#3f8f3f", "#8a4fa3", "#b8922b", "#4c5a63",
];

/// A number to three figures.
pub(crate) fn figures(value: f64) -> String {
    match value.abs() {
        0.0 => "0".to_owned(),
        v if v < 1e-3 => format!("{value:.1e}"),
        v if v < 1.0 => format!("{value:.4}"),
        v if v < 100.0 => format!("{value:.2}"),
        _ => format!("{value:.0}"),
    }
}

impl Page {
    pub(crate) fn new() -> Self {
        Self(HEAD.to_owned())
    }

    pub(crate) fn title(&mut self, text: &str) {
        let _ = writeln!(self.0, "<h1>{text}</h1>");
    }

    pub(crate) fn section(&mut self, text: &str) {
        let _ = writeln!(self.0, "<h2>{text}</h2>");
    }

    pub(crate) fn text(&mut self, text: &str) {
        let _ = writeln!(self.0, "<p>{text}</p>");
    }

    pub(crate) fn table(&mut self, head: &[&str], rows: &[Vec<String>]) {
        let _ = write!(self.0, "<table><tr>");
        for cell in head {
            let _ = write!(self.0, "<th>{cell}</th>");
        }
        for row in rows {
            let _ = write!(self.0, "</tr><tr>");
            for cell in row {
                let _ = write!(self.0, "<td>{cell}</td>");
            }
        }
        let _ = writeln!(self.0, "</tr></table>");
    }

    pub(crate) fn picture(&mut self, file: &str, caption: &str) {
        let _ = writeln!(
            self.0,
            "<figure><img src=\"{file}\" width=\"176\" height=\"176\" alt=\"{caption}\"><figcaption>{caption}</figcaption></figure>"
        );
    }

    /// Lines over logarithmic axes; a value of 0 or below is left out.
    pub(crate) fn plot(
        &mut self,
        caption: &str,
        axes: [&str; 2],
        lines: &[(String, Vec<[f64; 2]>)],
    ) {
        let (wide, high, left, low) = (430.0, 270.0, 62.0, 42.0);
        let all = || {
            lines
                .iter()
                .flat_map(|line| &line.1)
                .filter(|p| p[0] > 0.0 && p[1] > 0.0)
        };
        let ends = |axis: usize| {
            let logs = all().map(|p| p[axis].log10());
            let from = logs.clone().fold(f64::INFINITY, f64::min);
            let to = logs.fold(f64::NEG_INFINITY, f64::max);
            [
                from - 0.06 * (to - from + 0.1),
                to + 0.06 * (to - from + 0.1),
            ]
        };
        let (x, y) = (ends(0), ends(1));
        let place = |p: [f64; 2]| {
            let part = |v: f64, [from, to]: [f64; 2]| (v.log10() - from) / (to - from);
            [
                left + part(p[0], x) * (wide - left - 12.0),
                (high - low) - part(p[1], y) * (high - low - 14.0),
            ]
        };
        let _ = write!(
            self.0,
            "<figure><svg width=\"{wide}\" height=\"{high}\" font-size=\"11\" font-family=\"system-ui,sans-serif\" fill=\"#59646c\">"
        );
        let marks = |[from, to]: [f64; 2]| {
            let few = to - from < 2.2;
            (from.floor() as i32..=to.ceil() as i32)
                .flat_map(move |decade| {
                    let parts: &[f64] = if few { &[1.0, 2.0, 5.0] } else { &[1.0] };
                    parts.iter().map(move |part| part * 10f64.powi(decade))
                })
                .filter(move |v| (from..=to).contains(&v.log10()))
        };
        for value in marks(x) {
            let at = place([value, 10f64.powf(y[0])])[0];
            let base = high - low;
            let _ = write!(
                self.0,
                "<line x1=\"{at:.1}\" x2=\"{at:.1}\" y1=\"14\" y2=\"{base}\" stroke=\"#e4e8eb\"/><text x=\"{at:.1}\" y=\"{}\" text-anchor=\"middle\">{}</text>",
                base + 14.0,
                figures(value).trim_end_matches(".00")
            );
        }
        for value in marks(y) {
            let at = place([10f64.powf(x[0]), value])[1];
            let _ = write!(
                self.0,
                "<line x1=\"{left}\" x2=\"{}\" y1=\"{at:.1}\" y2=\"{at:.1}\" stroke=\"#e4e8eb\"/><text x=\"{}\" y=\"{:.1}\" text-anchor=\"end\">{}</text>",
                wide - 12.0,
                left - 6.0,
                at + 4.0,
                figures(value).trim_end_matches(".00")
            );
        }
        let _ = write!(
            self.0,
            "<text x=\"{:.0}\" y=\"{:.0}\" text-anchor=\"middle\">{}</text><text transform=\"translate(12 {:.0}) rotate(-90)\" text-anchor=\"middle\">{}</text>",
            (left + wide) / 2.0,
            high - 8.0,
            axes[0],
            (high - low) / 2.0,
            axes[1]
        );
        for (i, (name, points)) in lines.iter().enumerate() {
            let color = COLORS[i % COLORS.len()];
            let mut way = String::new();
            for p in points.iter().filter(|p| p[0] > 0.0 && p[1] > 0.0) {
                let [px, py] = place(*p);
                let _ = write!(way, "{px:.1},{py:.1} ");
                let _ = write!(
                    self.0,
                    "<circle cx=\"{px:.1}\" cy=\"{py:.1}\" r=\"3\" fill=\"{color}\"/>"
                );
            }
            let _ = write!(
                self.0,
                "<polyline points=\"{way}\" fill=\"none\" stroke=\"{color}\" stroke-width=\"1.8\"/><text x=\"{:.0}\" y=\"{:.0}\" fill=\"{color}\" text-anchor=\"end\" font-weight=\"600\">{name}</text>",
                wide - 16.0,
                26.0 + 14.0 * i as f64
            );
        }
        let _ = writeln!(self.0, "</svg><figcaption>{caption}</figcaption></figure>");
    }

    pub(crate) fn end(mut self) -> String {
        self.0.push_str("</html>\n");
        self.0
    }
}
