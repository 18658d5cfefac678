//! The table of shader programs. A program is a pass and, by the `needs:` lines at the heads of the files, all that
//! it takes names from, one behind the other; a line map turns the compiler's line into `file.wgsl:line`.

#[cfg(target_arch = "wasm32")]
use super::bare;
use super::cases::Cases;
use super::error::RenderError;
use super::gpu::Gpu;
use crate::displace::shader_constants;
use std::fmt::Write as _;
use std::sync::LazyLock;

/// An embedded WGSL file.
#[derive(Debug)]
pub struct ShaderFile {
    /// Path of the file under `shaders/`.
    pub path: &'static str,
    /// The file's text, as embedded in the program.
    pub source: &'static str,
    /// The `needs:` lines: paths of the files that this file takes names from.
    pub needs: &'static str,
}

/// What runs an entry point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Vertex shader: places the corners of a triangle.
    Vertex,
    /// Fragment shader: colours a pixel.
    Fragment,
    /// Compute shader: preparation only, never the picture.
    Compute,
}

/// Names a program of the table: one that is missing there does not compile.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ProgramId {
    /// The inverse map at points.
    Probe,
    /// What the object has at points, alignment counted.
    Object,
    /// Where points of the rest are now.
    Follow,
    /// Motions of segments that move as a whole.
    Rigid,
    /// Distances to kept tissue.
    Distance,
    /// Connected parts of kept tissue.
    Parts,
    /// Shares of kept tissue.
    Shares,
    /// Shares of the segments that are drawn as bodies.
    Bodies,
    /// The skip grid over the deformed space.
    Grid,
    /// The picture, where no tissue is kept.
    Raycast,
    /// The baked map: the composed map of the document, sampled on a grid.
    Bake,
    /// The picture, by the baked map.
    RaycastBaked,
    /// The picture, where tissue is kept.
    RaycastAligned,
    /// Slices, where no tissue is kept.
    Slice,
    /// Slices, where tissue is kept.
    SliceAligned,
    /// A bent figure.
    Sheet,
    /// An illustrator's look over a traced picture.
    Style,
    /// From the accumulated picture to the one that is shown.
    Resolve,
}

impl ProgramId {
    /// The entry of the program in the table.
    pub fn program(self) -> &'static Program {
        &PROGRAMS[self as usize]
    }
}

// Checked while compiling: the programs stand in the order of their names, and their passes are embedded.
const _: () = {
    let mut i = 0;
    while i < PROGRAMS.len() {
        let program = &PROGRAMS[i];
        assert!(
            program.id as usize == i,
            "a program stands in another place than its name"
        );
        assert!(is_embedded(program.pass), "a pass is not embedded");
        i += 1;
    }
};

const fn is_embedded(path: &str) -> bool {
    let mut i = 0;
    while i < FILES.len() {
        if is_same(FILES[i].path.as_bytes(), path.as_bytes()) {
            return true;
        }
        i += 1;
    }
    false
}

const fn is_same(a: &[u8], b: &[u8]) -> bool {
    if a.len() != b.len() {
        return false;
    }
    let mut i = 0;
    while i < a.len() {
        if a[i] != b[i] {
            return false;
        }
        i += 1;
    }
    true
}

/// The file that says what a subject has at a place. The files of all kinds stand in for each other, so that programs
/// which ask a subject are compiled once for each kind that is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SubjectShader {
    /// Values and labels from two 3D textures.
    Volume,
    /// Triangles, and a field that leads to them.
    Mesh,
    /// Both: a volume, and meshes beside it.
    Both,
}

impl SubjectShader {
    /// All of them.
    pub const ALL: &[Self] = &[Self::Volume, Self::Mesh, Self::Both];

    /// Paths of its files: what the subject has at a place, the march of a ray through it, what stands on a ray besides
    /// a volume, what takes a volume's place, and slices.
    pub fn paths(self) -> [&'static str; 5] {
        match self {
            Self::Volume => [
                "subject/volume.wgsl",
                "march/volume.wgsl",
                "march/straight.wgsl",
                "march/whole.wgsl",
                "slice/volume.wgsl",
            ],
            Self::Mesh => [
                "subject/surfaces.wgsl",
                "march/surfaces.wgsl",
                "march/straight.wgsl",
                "march/whole.wgsl",
                "slice/surfaces.wgsl",
            ],
            Self::Both => [
                "subject/both.wgsl",
                "march/volume.wgsl",
                "march/layers.wgsl",
                "march/replaced.wgsl",
                "slice/both.wgsl",
            ],
        }
    }
}

/// A program: a pass, with all that it takes names from, and its entry points.
#[derive(Debug)]
pub struct Program {
    /// Tells the program from the others.
    pub id: ProgramId,
    /// Name in messages and tests.
    pub name: &'static str,
    /// Path of the file that has the entry points.
    pub pass: &'static str,
    /// The file that is taken where a `needs:` line names several that stand in for each other.
    pub stand_in: Option<&'static str>,
    /// Names of its entry points, and what runs each.
    pub entries: &'static [(&'static str, Stage)],
}

impl Program {
    /// The files of the program for a kind of subject, each after the files that it needs.
    pub fn files(&self, subject: SubjectShader) -> Vec<&'static ShaderFile> {
        let mut stand_ins = subject.paths().to_vec();
        stand_ins.extend(self.stand_in);
        files_of(self.pass, &stand_ins)
    }
}

/// A file and all that it needs, each behind those that it needs itself. What no file fits is left out: the compiler
/// then names what is missing, and tests/shaders.rs the line.
pub fn files_of(path: &str, stand_ins: &[&str]) -> Vec<&'static ShaderFile> {
    let mut files = Vec::new();
    add_files(path, stand_ins, &mut files);
    files
}

fn add_files(path: &str, stand_ins: &[&str], files: &mut Vec<&'static ShaderFile>) {
    let ours = path.split('|').find(|path| stand_ins.contains(path));
    let Some(file) = file(ours.unwrap_or(path)) else {
        return;
    };
    if !files.iter().any(|known| known.path == file.path) {
        for need in needs(file) {
            add_files(need, stand_ins, files);
        }
        files.push(file);
    }
}

/// The text of a file as it is built in: whole, or without comments in what visitors download.
#[cfg(not(target_arch = "wasm32"))]
macro_rules! embedded {
    ($text:expr) => {
        $text
    };
}

/// The text of a file as it is built in: whole, or without comments in what visitors download.
#[cfg(target_arch = "wasm32")]
macro_rules! embedded {
    ($text:expr) => {{
        const BARE: [u8; bare::length($text)] = bare::bytes($text);
        as_text(&BARE)
    }};
}

/// Where the `needs:` lines of a file are: the byte at which they begin, and their number of bytes. They end with the
/// comment.
const fn needs_span(text: &[u8]) -> (usize, usize) {
    let mark = b"// needs:";
    let mut start = 0;
    while start + mark.len() <= text.len() {
        let mut same = 0;
        while same < mark.len() && text[start + same] == mark[same] {
            same += 1;
        }
        if same == mark.len() {
            let mut end = start;
            while end < text.len() && (text[end] != b'\n' || is_comment(text, end + 1)) {
                end += 1;
            }
            return (start, end - start);
        }
        start += 1;
    }
    (0, 0)
}

/// True if a comment begins at this byte.
const fn is_comment(text: &[u8], at: usize) -> bool {
    at + 1 < text.len() && text[at] == b'/' && text[at + 1] == b'/'
}

/// So many bytes of a text: a copy, so that the rest of the text is not built in for their sake.
const fn part<const N: usize>(text: &[u8], start: usize) -> [u8; N] {
    let (mut out, mut i) = ([0; N], 0);
    while i < N {
        out[i] = text[start + i];
        i += 1;
    }
    out
}

macro_rules! shader_files {
    ($($path:literal),* $(,)?) => {
        /// Every embedded WGSL file.
        pub const FILES: &[ShaderFile] = &[
            $({
                const TEXT: &str =
                    include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/shaders/", $path));
                const SPAN: (usize, usize) = needs_span(TEXT.as_bytes());
                const NEEDS: [u8; SPAN.1] = part(TEXT.as_bytes(), SPAN.0);
                ShaderFile {
                    path: $path,
                    source: embedded!(TEXT),
                    needs: as_text(&NEEDS),
                }
            }),*
        ];
    };
}

/// Bytes of a shader file as text.
const fn as_text(bytes: &'static [u8]) -> &'static str {
    match std::str::from_utf8(bytes) {
        Ok(text) => text,
        Err(_) => panic!("a shader file is no UTF-8"),
    }
}

/// Numbers of the kinds of templates: made from what `displace` knows of them, in place of a file.
static KINDS: LazyLock<ShaderFile> = LazyLock::new(|| ShaderFile {
    path: "kinds.wgsl",
    source: shader_constants().leak(),
    needs: "",
});

shader_files![
    "affine.wgsl",
    "objects.wgsl",
    "octahedron.wgsl",
    "srgb.wgsl",
    "textures.wgsl",
    "triangles.wgsl",
    "types.wgsl",
    "bind/templates.wgsl",
    "displace/angles.wgsl",
    "displace/frame.wgsl",
    "displace/poke.wgsl",
    "displace/twist.wgsl",
    "displace/wave.wgsl",
    "displace/bend.wgsl",
    "displace/squeeze.wgsl",
    "displace/dilate.wgsl",
    "displace/peel.wgsl",
    "displace/flap.wgsl",
    "displace/split.wgsl",
    "displace/slices.wgsl",
    "displace/retractor.wgsl",
    "displace/cutquad.wgsl",
    "displace/peeler.wgsl",
    "displace/pull.wgsl",
    "displace/cut.wgsl",
    "displace/hole.wgsl",
    "displace/lens.wgsl",
    "displace/move.wgsl",
    "displace/rbf.wgsl",
    "displace/field.wgsl",
    "displace/noise.wgsl",
    "displace/crack.wgsl",
    "displace/carve.wgsl",
    "displace/tools.wgsl",
    "displace/sweep.wgsl",
    "displace/curve.wgsl",
    "displace/compose.wgsl",
    "bind/frame.wgsl",
    "bind/subject.wgsl",
    "bind/look.wgsl",
    "bind/mesh_look.wgsl",
    "bind/objects.wgsl",
    "bind/bodies.wgsl",
    "bind/grid.wgsl",
    "bind/baked.wgsl",
    "bind/rays.wgsl",
    "bind/slice.wgsl",
    "bind/sheet.wgsl",
    "bind/style.wgsl",
    "bind/kept.wgsl",
    "bind/distance_job.wgsl",
    "march/align.wgsl",
    "march/asked.wgsl",
    "march/baked.wgsl",
    "march/bodies.wgsl",
    "march/color.wgsl",
    "march/constrain.wgsl",
    "march/cover.wgsl",
    "march/edges.wgsl",
    "march/filling.wgsl",
    "march/gathered.wgsl",
    "march/ghost.wgsl",
    "march/interface.wgsl",
    "march/jacobian.wgsl",
    "march/kept.wgsl",
    "march/kept_surface.wgsl",
    "march/layers.wgsl",
    "march/marched.wgsl",
    "march/mesh.wgsl",
    "march/objects.wgsl",
    "march/opacity.wgsl",
    "march/overrides.wgsl",
    "march/plain.wgsl",
    "march/ray.wgsl",
    "march/refine.wgsl",
    "march/replaced.wgsl",
    "march/sample.wgsl",
    "march/seek.wgsl",
    "march/segments.wgsl",
    "march/shade.wgsl",
    "march/straight.wgsl",
    "march/surface.wgsl",
    "march/surfaces.wgsl",
    "march/surroundings.wgsl",
    "march/textures.wgsl",
    "march/under.wgsl",
    "march/value.wgsl",
    "march/view.wgsl",
    "march/volume.wgsl",
    "march/whole.wgsl",
    "slice/both.wgsl",
    "slice/mesh.wgsl",
    "slice/objects.wgsl",
    "slice/plane.wgsl",
    "slice/surfaces.wgsl",
    "slice/values.wgsl",
    "slice/volume.wgsl",
    "subject/both.wgsl",
    "subject/crossing.wgsl",
    "subject/label.wgsl",
    "subject/mesh.wgsl",
    "subject/place.wgsl",
    "subject/surfaces.wgsl",
    "subject/volume.wgsl",
    "subject/member.wgsl",
    "pass/bake.wgsl",
    "pass/bodies.wgsl",
    "pass/distance.wgsl",
    "pass/follow.wgsl",
    "pass/grid.wgsl",
    "pass/object.wgsl",
    "pass/parts.wgsl",
    "pass/probe.wgsl",
    "pass/raycast.wgsl",
    "pass/resolve.wgsl",
    "pass/rigid.wgsl",
    "pass/shares.wgsl",
    "pass/slice.wgsl",
    "pass/sheet.wgsl",
    "pass/style.wgsl",
    "style/directions.wgsl",
    "style/outlines.wgsl",
    "style/strokes.wgsl",
    "style/traced.wgsl",
    "style/vignette.wgsl",
    "style/words.wgsl",
];

/// Every program. The number of programs does not depend on the document.
pub const PROGRAMS: &[Program] = &[
    Program {
        id: ProgramId::Probe,
        name: "probe",
        pass: "pass/probe.wgsl",
        stand_in: None,
        entries: &[("probe", Stage::Compute)],
    },
    Program {
        id: ProgramId::Object,
        name: "object",
        pass: "pass/object.wgsl",
        stand_in: None,
        entries: &[("probe_object", Stage::Compute)],
    },
    Program {
        id: ProgramId::Follow,
        name: "follow",
        pass: "pass/follow.wgsl",
        stand_in: None,
        entries: &[("search", Stage::Compute), ("settle", Stage::Compute)],
    },
    Program {
        id: ProgramId::Rigid,
        name: "rigid",
        pass: "pass/rigid.wgsl",
        stand_in: None,
        entries: &[("fit", Stage::Compute)],
    },
    Program {
        id: ProgramId::Distance,
        name: "distance",
        pass: "pass/distance.wgsl",
        stand_in: None,
        entries: &[
            ("open_blocks", Stage::Compute),
            ("sweep", Stage::Compute),
            ("along_x", Stage::Compute),
            ("along_y", Stage::Compute),
            ("along_z", Stage::Compute),
            ("smooth_out", Stage::Compute),
            ("smooth_back", Stage::Compute),
            ("write_texture", Stage::Compute),
        ],
    },
    Program {
        id: ProgramId::Parts,
        name: "parts",
        pass: "pass/parts.wgsl",
        stand_in: None,
        entries: &[
            ("mark_parts", Stage::Compute),
            ("spread_parts", Stage::Compute),
            ("count_parts", Stage::Compute),
            ("rank_parts", Stage::Compute),
            ("name_parts", Stage::Compute),
        ],
    },
    Program {
        id: ProgramId::Shares,
        name: "shares",
        pass: "pass/shares.wgsl",
        stand_in: None,
        entries: &[
            ("mark_rest", Stage::Compute),
            ("find_boxes", Stage::Compute),
            ("fill_boxes", Stage::Compute),
            ("spread_large", Stage::Compute),
            ("find_members", Stage::Compute),
            ("write_shares", Stage::Compute),
        ],
    },
    Program {
        id: ProgramId::Bodies,
        name: "bodies",
        pass: "pass/bodies.wgsl",
        stand_in: None,
        entries: &[("share_bodies", Stage::Compute)],
    },
    Program {
        id: ProgramId::Grid,
        name: "grid",
        pass: "pass/grid.wgsl",
        stand_in: None,
        entries: &[
            ("fill", Stage::Compute),
            ("spread_x", Stage::Compute),
            ("spread_y", Stage::Compute),
            ("spread_z", Stage::Compute),
        ],
    },
    Program {
        id: ProgramId::Raycast,
        name: "raycast",
        pass: "pass/raycast.wgsl",
        stand_in: Some("march/plain.wgsl"),
        entries: &[
            ("cover", Stage::Vertex),
            ("draw", Stage::Fragment),
            ("trace", Stage::Fragment),
            ("pick", Stage::Fragment),
            ("identify", Stage::Fragment),
            ("meet", Stage::Fragment),
        ],
    },
    Program {
        id: ProgramId::Bake,
        name: "bake",
        pass: "pass/bake.wgsl",
        stand_in: None,
        entries: &[("bake", Stage::Compute)],
    },
    Program {
        id: ProgramId::RaycastBaked,
        name: "raycast_baked",
        pass: "pass/raycast.wgsl",
        stand_in: Some("march/baked.wgsl"),
        entries: &[
            ("cover", Stage::Vertex),
            ("draw", Stage::Fragment),
            ("trace", Stage::Fragment),
            ("pick", Stage::Fragment),
            ("identify", Stage::Fragment),
            ("meet", Stage::Fragment),
        ],
    },
    Program {
        id: ProgramId::RaycastAligned,
        name: "raycast_aligned",
        pass: "pass/raycast.wgsl",
        stand_in: Some("march/align.wgsl"),
        entries: &[
            ("cover", Stage::Vertex),
            ("draw", Stage::Fragment),
            ("trace", Stage::Fragment),
            ("pick", Stage::Fragment),
            ("identify", Stage::Fragment),
            ("meet", Stage::Fragment),
        ],
    },
    Program {
        id: ProgramId::Slice,
        name: "slice",
        pass: "pass/slice.wgsl",
        stand_in: Some("march/plain.wgsl"),
        entries: &[
            ("cover", Stage::Vertex),
            ("draw", Stage::Fragment),
            ("read", Stage::Fragment),
        ],
    },
    Program {
        id: ProgramId::SliceAligned,
        name: "slice_aligned",
        pass: "pass/slice.wgsl",
        stand_in: Some("march/align.wgsl"),
        entries: &[
            ("cover", Stage::Vertex),
            ("draw", Stage::Fragment),
            ("read", Stage::Fragment),
        ],
    },
    Program {
        id: ProgramId::Sheet,
        name: "sheet",
        pass: "pass/sheet.wgsl",
        stand_in: None,
        entries: &[
            ("place_corner", Stage::Vertex),
            ("cover", Stage::Vertex),
            ("draw_sheet", Stage::Fragment),
            ("lay", Stage::Fragment),
        ],
    },
    Program {
        id: ProgramId::Style,
        name: "style",
        pass: "pass/style.wgsl",
        stand_in: None,
        entries: &[("cover", Stage::Vertex), ("draw_style", Stage::Fragment)],
    },
    Program {
        id: ProgramId::Resolve,
        name: "resolve",
        pass: "pass/resolve.wgsl",
        stand_in: None,
        entries: &[("cover", Stage::Vertex), ("encode", Stage::Fragment)],
    },
];

/// The file of a path: of [`FILES`], or the one that is made.
pub fn file(path: &str) -> Option<&'static ShaderFile> {
    let made = (path == KINDS.path).then(|| &*KINDS);
    FILES.iter().find(|file| file.path == path).or(made)
}

/// What the `needs:` lines of a file name: paths, or several that stand in for each other with `|` between them.
pub fn needs(file: &ShaderFile) -> Vec<&'static str> {
    let words = file.needs.split_whitespace();
    words.filter(|word| word.ends_with(".wgsl")).collect()
}

/// A program's text, put together.
#[derive(Debug)]
pub struct Assembled {
    /// The texts of all files, one after the other.
    pub source: String,
    /// First line (from 1) of each file in `source`, in order.
    starts: Vec<(usize, &'static str)>,
}

impl Assembled {
    /// Puts a program's files together, for documents of these cases.
    pub fn new(program: &Program, subject: SubjectShader, cases: Cases) -> Self {
        Self::of(&program.files(subject), cases)
    }

    /// Puts files together in the order given.
    pub fn of(files: &[&'static ShaderFile], cases: Cases) -> Self {
        let (mut source, mut starts, mut line) = (String::new(), Vec::new(), 1);
        for file in files {
            starts.push((line, file.path));
            #[cfg(all(debug_assertions, not(target_arch = "wasm32")))]
            let text = &super::reload::text_of(file.path, file.source);
            #[cfg(not(all(debug_assertions, not(target_arch = "wasm32"))))]
            let text = file.source;
            let left = cases.leave_out(file.path, text);
            let text = left.as_deref().unwrap_or(text);
            source.push_str(text);
            source.push('\n');
            line += text.matches('\n').count() + 1;
        }
        Self { source, starts }
    }

    /// `file.wgsl:line` of a line (from 1) of the assembled text.
    pub fn place(&self, line: usize) -> String {
        match self.starts.iter().rev().find(|(start, _)| *start <= line) {
            Some((start, path)) => format!("{path}:{}", line - start + 1),
            None => format!("line {line}"),
        }
    }
}

/// Makes a program's module at once, for documents of these cases. What the compiler has to say arrives
/// later in [`Gpu::take_errors`]; tests/shaders.rs sees to it that it has nothing to say.
pub fn module(gpu: &Gpu, id: ProgramId, cases: Cases) -> wgpu::ShaderModule {
    module_for(gpu, id, ANY_SUBJECT, cases)
}

/// As [`module`], of a program that asks a subject of this kind what it has at a place.
pub fn module_for(
    gpu: &Gpu,
    id: ProgramId,
    subject: SubjectShader,
    cases: Cases,
) -> wgpu::ShaderModule {
    let program = id.program();
    module_of(gpu, program, &Assembled::new(program, subject, cases))
}

/// For programs that do not ask the subject what it has at a place.
const ANY_SUBJECT: SubjectShader = SubjectShader::Volume;

/// Compiles a program.
///
/// # Errors
/// [`RenderError::Shader`] with `file.wgsl:line` for each message.
pub async fn compile(gpu: &Gpu, id: ProgramId) -> Result<wgpu::ShaderModule, RenderError> {
    compile_for(gpu, id, ANY_SUBJECT, Cases::ALL).await
}

/// As [`compile`], of a program that asks a subject of this kind what it has at a place.
///
/// # Errors
/// As [`compile`].
pub async fn compile_for(
    gpu: &Gpu,
    id: ProgramId,
    subject: SubjectShader,
    cases: Cases,
) -> Result<wgpu::ShaderModule, RenderError> {
    let program = id.program();
    let assembled = Assembled::new(program, subject, cases);
    let scope = gpu.device.push_error_scope(wgpu::ErrorFilter::Validation);
    let module = module_of(gpu, program, &assembled);
    if let Some(error) = scope.pop().await {
        let info = module.get_compilation_info().await;
        let mut messages = String::new();
        for message in info.messages {
            let place = message
                .location
                .map_or_else(String::new, |at| assembled.place(at.line_number as usize));
            let _ = write!(messages, "\n{place}: {}", message.message);
        }
        if messages.is_empty() {
            messages = error.to_string();
        }
        return Err(RenderError::Shader {
            program: program.name,
            messages,
        });
    }
    Ok(module)
}

fn module_of(gpu: &Gpu, program: &Program, assembled: &Assembled) -> wgpu::ShaderModule {
    gpu.device
        .create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(program.name),
            source: wgpu::ShaderSource::Wgsl(assembled.source.as_str().into()),
        })
}

/// Checks the programs as they stand; an error names `file.wgsl:line`.
///
/// # Errors
/// [`RenderError::Shader`] for the first that does not parse or validate.
#[cfg(all(debug_assertions, not(target_arch = "wasm32")))]
pub(crate) fn check_programs() -> Result<(), RenderError> {
    use wgpu::naga;
    let each = |program| SubjectShader::ALL.iter().map(move |kind| (program, *kind));
    for (program, kind) in PROGRAMS.iter().flat_map(each) {
        let text = Assembled::new(program, kind, Cases::ALL);
        let fault = |line: Option<usize>, message: String| {
            let place = line.map_or_else(String::new, |line| text.place(line));
            RenderError::Shader {
                program: program.name,
                messages: format!("{place}: {message}"),
            }
        };
        let line_of = |at: Option<naga::SourceLocation>| at.map(|at| at.line_number as usize);
        let module = naga::front::wgsl::parse_str(&text.source)
            .map_err(|e| fault(line_of(e.location(&text.source)), e.message().to_owned()))?;
        naga::valid::Validator::new(
            naga::valid::ValidationFlags::all(),
            naga::valid::Capabilities::empty(),
        )
        .validate(&module)
        .map_err(|e| fault(line_of(e.location(&text.source)), e.as_inner().to_string()))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::cases::BODIES;
    use super::{Cases, PROGRAMS, Program, SubjectShader, file};
    use crate::displace::TemplateKind;
    use crate::render::device::bare::{length, strip};

    /// What is left out is there, and lines stay where they are.
    #[test]
    fn what_is_left_out_is_found() {
        // A sweep that has nothing of what may be left out: without a kind its whole formula is.
        let none = Cases {
            kinds: 1 << TemplateKind::Sweep as u32,
            align_modes: 1,
            gives_way: false,
            gives_way_late: false,
            gives_way_by_coordinate: false,
            moves_as_a_whole: false,
        };
        for body in &BODIES {
            let text = file(body.path).expect("embedded").source;
            assert!(text.contains(&format!("fn {}(", body.function)));
            let left = none.leave_out(body.path, text).expect("another text");
            assert!(left.contains(body.instead), "{}", body.function);
            assert_eq!(left.lines().count(), text.lines().count(), "{}", body.path);
            assert_eq!(Cases::ALL.leave_out(body.path, text), None);
        }
        let path = "displace/compose.wgsl";
        let text = file(path).expect("embedded").source;
        let left = none.leave_out(path, text).expect("another text");
        assert!(text.contains("displace_bend(q") && !left.contains("displace_bend(q"));
        assert_eq!(left.lines().count(), text.lines().count());
        let bends = Cases::of_kinds(1 << TemplateKind::Bend as u32);
        let left = bends.leave_out(path, text).expect("another text");
        assert!(left.contains("displace_bend(q") && !left.contains("displace_poke(q"));
    }

    /// The program that visitors get is the one that is tested.
    #[test]
    fn every_program_validates_without_its_comments() {
        let each = |program: &'static Program| SubjectShader::ALL.iter().map(|k| program.files(*k));
        for files in PROGRAMS.iter().flat_map(each) {
            let mut text = String::new();
            for file in files {
                let mut bare = vec![0; length(file.source)];
                strip(file.source.as_bytes(), &mut bare);
                assert_eq!(
                    bare.iter().filter(|byte| **byte == b'\n').count(),
                    file.source.lines().count(),
                    "{}",
                    file.path
                );
                text.push_str(std::str::from_utf8(&bare).expect("still text"));
            }
            wgpu::naga::front::wgsl::parse_str(&text)
                .unwrap_or_else(|error| panic!("{}", error.emit_to_string(&text)));
        }
    }
}
