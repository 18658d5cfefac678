//! The cases that a program is put together for. Compilers draw a function into each place that calls it before they
//! see that a branch is never taken: a document with one alignment would have each formula compiled two hundred times.
//! So what a document does not use is left out of the text.

use crate::displace::{
    DRAWN_ALONE, DRAWN_CROWDED, DRAWN_ELLIPSOIDS, DRAWN_GRIDS, DRAWN_PIECES, DRAWN_TOGETHER, Holds,
    TemplateKind, without_formula,
};

/// What the documents have that a program is put together for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Cases {
    /// Bit k: templates of kind k occur; upper bits: what sweeps have (as `Templates::drawn_kinds`).
    pub kinds: u32,
    /// Bit m: tissue is kept by align mode m (`KeptTissue::align_mode`).
    pub align_modes: u32,
    /// Displacements give way to kept tissue.
    pub gives_way: bool,
    /// Some give way to tissue that templates before them have moved.
    pub gives_way_late: bool,
    /// The main parameter of some is scaled where they give way.
    pub gives_way_by_coordinate: bool,
    /// Some move tissue as a whole.
    pub moves_as_a_whole: bool,
}

impl Cases {
    /// Programs that serve every document.
    pub const ALL: Self = Self::of_kinds(u32::MAX);

    /// Documents of these kinds of templates, however they keep tissue.
    pub const fn of_kinds(kinds: u32) -> Self {
        Self {
            kinds,
            align_modes: u32::MAX,
            gives_way: true,
            gives_way_late: true,
            gives_way_by_coordinate: true,
            moves_as_a_whole: true,
        }
    }

    fn has_mode(self, modes: &[u32]) -> bool {
        modes.iter().any(|mode| self.align_modes & (1 << mode) != 0)
    }

    /// A file's text without what these cases do not use; none where the text stays as it is. Lines that are left and
    /// the bindings of each entry point stay as they are. `path`: under `shaders/`.
    pub(super) fn leave_out(self, path: &str, text: &str) -> Option<String> {
        let mut left = without_formula(path, text, self.kinds);
        let mut replace = |by: &dyn Fn(&str) -> String| {
            left = Some(by(left.as_deref().unwrap_or(text)));
        };
        for body in BODIES {
            if body.path == path && !(body.is_used)(self) {
                replace(&|text| with_body(text, body.function, body.instead));
            }
        }
        let calls = path == "displace/compose.wgsl";
        for kind in TemplateKind::ALL.into_iter().filter(|_| calls) {
            // What stands for the formula of a kind that reads a texture names the texture.
            let is_alone = matches!(kind.facts().holds, Holds::Parameters);
            if is_alone && self.kinds & (1 << kind as u32) == 0 {
                let call = format!("d = displace_{}(q, size, p0, p1);", kind.spec().name);
                replace(&|text| text.replace(&call, ""));
            }
        }
        left
    }
}

/// A function whose body is left out where no document of the cases uses it, and what stands instead.
pub(super) struct Body {
    pub(super) path: &'static str,
    pub(super) function: &'static str,
    is_used: fn(Cases) -> bool,
    pub(super) instead: &'static str,
}

/// What stands for a way of asking that is never taken. It names what keeps tissue, so that the bindings stay.
const NEVER_ASKED: &str = "return Material(pos, select(1.0, 0.0, is_kept(pos, mask, distance_to_kept(pos, mask, 0.0, 0u))), 0u);";

const fn body(
    path: &'static str,
    function: &'static str,
    is_used: fn(Cases) -> bool,
    instead: &'static str,
) -> Body {
    Body {
        path,
        function,
        is_used,
        instead,
    }
}

pub(super) const BODIES: [Body; 14] = [
    body(
        "displace/tools.wgsl",
        "grid_distance",
        |cases| cases.kinds & DRAWN_GRIDS != 0,
        "return length(p);",
    ),
    body(
        "displace/tools.wgsl",
        "ellipsoid_distance",
        |cases| cases.kinds & DRAWN_ELLIPSOIDS != 0,
        "return length(q);",
    ),
    body(
        "displace/tools.wgsl",
        "pieces_distance",
        |cases| cases.kinds & DRAWN_PIECES != 0,
        "return length(q);",
    ),
    body(
        "displace/sweep.wgsl",
        "sweep_back",
        |cases| cases.kinds & DRAWN_TOGETHER != 0,
        "return end;",
    ),
    body(
        "displace/sweep.wgsl",
        "with_three_fields",
        |cases| cases.kinds & DRAWN_CROWDED != 0,
        "return flow;",
    ),
    body(
        "displace/sweep.wgsl",
        "sweep_back_alone",
        |cases| cases.kinds & DRAWN_ALONE != 0,
        "return SweptRun(end, last - 1);",
    ),
    body(
        "march/asked.wgsl",
        "grouped",
        |cases| cases.has_mode(&[1, 4]),
        NEVER_ASKED,
    ),
    body(
        "march/asked.wgsl",
        "chained",
        |cases| cases.has_mode(&[2]),
        NEVER_ASKED,
    ),
    body(
        "march/asked.wgsl",
        "asked",
        |cases| cases.has_mode(&[3]),
        NEVER_ASKED,
    ),
    body(
        "march/align.wgsl",
        "map_along",
        |cases| cases.gives_way,
        "return rest_from_subject(pos, path);",
    ),
    body(
        "march/constrain.wgsl",
        "group_map",
        |cases| cases.gives_way,
        "return rest_from_subject(pos, bits);",
    ),
    body(
        "march/constrain.wgsl",
        "before_group",
        |cases| cases.gives_way_late,
        "return Mapped(pos, 1.0);",
    ),
    body(
        "march/constrain.wgsl",
        "moved_as_a_whole",
        |cases| cases.moves_as_a_whole,
        "return whole;",
    ),
    body(
        "march/constrain.wgsl",
        "group_done_partly",
        |cases| cases.gives_way_by_coordinate,
        "return Mapped(pos, 1.0);",
    ),
];

/// A text in which the body of a function is replaced. Lines behind it stay where they are; a function that is not
/// there is left to the tests to find.
fn with_body(text: &str, function: &str, instead: &str) -> String {
    let found = text.find(&format!("fn {function}("));
    let Some((open, close)) = found.and_then(|at| braces(text, at)) else {
        return text.to_owned();
    };
    let lines = "\n".repeat(text[open..close].matches('\n').count());
    format!("{} {instead} {lines}{}", &text[..=open], &text[close..])
}

/// Where the first brace behind a place stands and the one that closes it, comments aside.
fn braces(text: &str, from: usize) -> Option<(usize, usize)> {
    let (mut open, mut depth) = (None, 0);
    let mut is_comment = false;
    for (at, byte) in text.bytes().enumerate().skip(from) {
        match byte {
            b'\n' => is_comment = false,
            b'/' if text[at..].starts_with("//") => is_comment = true,
            b'{' if !is_comment => {
                open = open.or(Some(at));
                depth += 1;
            }
            b'}' if !is_comment => {
                depth -= 1;
                if depth == 0 {
                    return Some((open?, at));
                }
            }
            _ => {}
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::with_body;

    #[test]
    fn a_body_ends_where_its_brace_closes() {
        let text =
            "fn a(x: f32) -> f32 { // {\n if x > 0.0 { return 1.0; }\n return 2.0; }\nfn b() {}";
        let left = with_body(text, "a", "return x;");
        assert_eq!(left, "fn a(x: f32) -> f32 { return x; \n\n}\nfn b() {}");
        assert_eq!(with_body(text, "c", ""), text);
        assert_eq!(with_body("fn a() {", "a", ""), "fn a() {");
    }
}
