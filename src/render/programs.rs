//! The table of shader programs. A program is the concatenation of its files; a line map turns the compiler's line
//! into `file.wgsl:line`. WGSL does not care about order, so the order is only that of reading.

#[cfg(target_arch = "wasm32")]
use super::bare;
use super::{Gpu, RenderError};
use std::fmt::Write as _;

/// An embedded WGSL file.
#[derive(Debug)]
pub struct ShaderFile {
    /// Path under `shaders/`.
    pub path: &'static str,
    /// Its text.
    pub source: &'static str,
}

/// What runs an entry point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Vertex shader.
    Vertex,
    /// Fragment shader.
    Fragment,
    /// Compute shader: preparation only, never the picture.
    Compute,
}

/// A program: its files and entry points.
#[derive(Debug)]
pub struct Program {
    /// Name in this table.
    pub name: &'static str,
    /// Paths of its files, all in [`FILES`].
    pub files: &'static [&'static str],
    /// Its entry points.
    pub entries: &'static [(&'static str, Stage)],
}

/// The text of a file as it is built in: whole, or without comments in what visitors download.
#[cfg(not(target_arch = "wasm32"))]
macro_rules! embedded {
    ($path:expr) => {
        include_str!($path)
    };
}

/// The text of a file as it is built in: whole, or without comments in what visitors download.
#[cfg(target_arch = "wasm32")]
macro_rules! embedded {
    ($path:expr) => {{
        const BARE: [u8; bare::length(include_str!($path))] = bare::bytes(include_str!($path));
        match std::str::from_utf8(&BARE) {
            Ok(text) => text,
            Err(_) => panic!("a shader file is no UTF-8"),
        }
    }};
}

macro_rules! shader_files {
    ($($path:literal),* $(,)?) => {
        /// Every embedded WGSL file.
        pub const FILES: &[ShaderFile] = &[
            $(ShaderFile {
                path: $path,
                source: embedded!(concat!(env!("CARGO_MANIFEST_DIR"), "/shaders/", $path)),
            }),*
        ];
    };
}

shader_files![
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
    "displace/curve.wgsl",
    "displace/compose.wgsl",
    "bind/frame.wgsl",
    "bind/subject.wgsl",
    "bind/look.wgsl",
    "bind/bodies.wgsl",
    "bind/grid.wgsl",
    "bind/baked.wgsl",
    "bind/feature.wgsl",
    "march/align.wgsl",
    "march/plain.wgsl",
    "march/baked.wgsl",
    "march/ray.wgsl",
    "march/shade.wgsl",
    "march/value.wgsl",
    "pass/bake.wgsl",
    "pass/bodies.wgsl",
    "pass/distance.wgsl",
    "pass/follow.wgsl",
    "pass/grid.wgsl",
    "pass/object.wgsl",
    "pass/probe.wgsl",
    "pass/raycast.wgsl",
    "pass/resolve.wgsl",
    "pass/rigid.wgsl",
    "pass/slice.wgsl",
];

/// The files of `rest_from_subject` (what `displace/compose.wgsl` needs, itself included), and those named after them.
macro_rules! with_displacement {
    ($($path:literal),* $(,)?) => {
        &[
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
            "displace/curve.wgsl",
            "displace/compose.wgsl",
            $($path),*
        ]
    };
}

/// Every program. The number of programs does not depend on the document.
pub const PROGRAMS: &[Program] = &[
    Program {
        name: "probe",
        files: with_displacement!["pass/probe.wgsl"],
        entries: &[("probe", Stage::Compute)],
    },
    Program {
        name: "object",
        files: with_displacement![
            "bind/subject.wgsl",
            "bind/feature.wgsl",
            "march/align.wgsl",
            "pass/object.wgsl",
        ],
        entries: &[("probe_object", Stage::Compute)],
    },
    Program {
        name: "follow",
        files: with_displacement![
            "bind/subject.wgsl",
            "bind/feature.wgsl",
            "march/align.wgsl",
            "pass/follow.wgsl",
        ],
        entries: &[("search", Stage::Compute), ("settle", Stage::Compute)],
    },
    Program {
        name: "rigid",
        files: with_displacement![
            "bind/subject.wgsl",
            "bind/feature.wgsl",
            "march/align.wgsl",
            "pass/rigid.wgsl",
        ],
        entries: &[("fit", Stage::Compute)],
    },
    Program {
        name: "distance",
        files: &["types.wgsl", "bind/subject.wgsl", "pass/distance.wgsl"],
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
        name: "bodies",
        files: &["types.wgsl", "bind/subject.wgsl", "pass/bodies.wgsl"],
        entries: &[("share_bodies", Stage::Compute)],
    },
    Program {
        name: "grid",
        files: with_displacement!["bind/feature.wgsl", "pass/grid.wgsl"],
        entries: &[
            ("fill", Stage::Compute),
            ("spread_x", Stage::Compute),
            ("spread_y", Stage::Compute),
            ("spread_z", Stage::Compute),
        ],
    },
    Program {
        name: "raycast",
        files: with_displacement![
            "bind/frame.wgsl",
            "bind/subject.wgsl",
            "bind/look.wgsl",
            "bind/bodies.wgsl",
            "bind/grid.wgsl",
            "march/plain.wgsl",
            "march/ray.wgsl",
            "march/shade.wgsl",
            "march/value.wgsl",
            "pass/raycast.wgsl",
        ],
        entries: &[
            ("cover", Stage::Vertex),
            ("draw", Stage::Fragment),
            ("pick", Stage::Fragment),
        ],
    },
    Program {
        name: "bake",
        files: with_displacement!["pass/bake.wgsl"],
        entries: &[("bake", Stage::Compute)],
    },
    Program {
        name: "raycast_baked",
        files: with_displacement![
            "bind/frame.wgsl",
            "bind/subject.wgsl",
            "bind/look.wgsl",
            "bind/bodies.wgsl",
            "bind/grid.wgsl",
            "bind/baked.wgsl",
            "march/baked.wgsl",
            "march/ray.wgsl",
            "march/value.wgsl",
            "march/shade.wgsl",
            "pass/raycast.wgsl",
        ],
        entries: &[
            ("cover", Stage::Vertex),
            ("draw", Stage::Fragment),
            ("pick", Stage::Fragment),
        ],
    },
    Program {
        name: "raycast_aligned",
        files: with_displacement![
            "bind/frame.wgsl",
            "bind/subject.wgsl",
            "bind/look.wgsl",
            "bind/bodies.wgsl",
            "bind/grid.wgsl",
            "bind/feature.wgsl",
            "march/align.wgsl",
            "march/ray.wgsl",
            "march/shade.wgsl",
            "march/value.wgsl",
            "pass/raycast.wgsl",
        ],
        entries: &[
            ("cover", Stage::Vertex),
            ("draw", Stage::Fragment),
            ("pick", Stage::Fragment),
        ],
    },
    Program {
        name: "slice",
        files: with_displacement![
            "bind/subject.wgsl",
            "bind/look.wgsl",
            "bind/bodies.wgsl",
            "march/plain.wgsl",
            "march/ray.wgsl",
            "pass/slice.wgsl",
        ],
        entries: &[
            ("cover", Stage::Vertex),
            ("draw", Stage::Fragment),
            ("read", Stage::Fragment),
        ],
    },
    Program {
        name: "slice_aligned",
        files: with_displacement![
            "bind/subject.wgsl",
            "bind/look.wgsl",
            "bind/bodies.wgsl",
            "bind/feature.wgsl",
            "march/align.wgsl",
            "march/ray.wgsl",
            "pass/slice.wgsl",
        ],
        entries: &[
            ("cover", Stage::Vertex),
            ("draw", Stage::Fragment),
            ("read", Stage::Fragment),
        ],
    },
    Program {
        name: "resolve",
        files: &["types.wgsl", "pass/resolve.wgsl"],
        entries: &[("cover", Stage::Vertex), ("encode", Stage::Fragment)],
    },
];

/// The file of a path in [`FILES`].
pub fn file(path: &str) -> Option<&'static ShaderFile> {
    FILES.iter().find(|file| file.path == path)
}

/// Paths that a file's `needs:` line names. Space-separated, `-` for none.
pub fn needs(file: &ShaderFile) -> Vec<&'static str> {
    let line = file
        .source
        .lines()
        .find_map(|line| line.strip_prefix("// needs:"));
    line.map_or_else(Vec::new, |line| {
        line.split([' ', ','])
            .filter(|word| word.ends_with(".wgsl"))
            .collect()
    })
}

/// A program's text, put together.
#[derive(Debug)]
pub struct Assembled {
    /// Concatenated source.
    pub source: String,
    /// First line (from 1) of each file in `source`, in order.
    starts: Vec<(usize, &'static str)>,
}

impl Assembled {
    /// Puts a program's files together.
    ///
    /// # Errors
    /// [`RenderError::NoSuchProgram`] if a file is not in the table.
    pub fn new(program: &Program) -> Result<Self, RenderError> {
        let (mut source, mut starts, mut line) = (String::new(), Vec::new(), 1);
        for path in program.files {
            let file = file(path).ok_or_else(|| RenderError::NoSuchProgram((*path).to_owned()))?;
            starts.push((line, file.path));
            #[cfg(all(debug_assertions, not(target_arch = "wasm32")))]
            let text = &super::reload::text_of(file);
            #[cfg(not(all(debug_assertions, not(target_arch = "wasm32"))))]
            let text = file.source;
            source.push_str(text);
            source.push('\n');
            line += text.matches('\n').count() + 1;
        }
        Ok(Self { source, starts })
    }

    /// `file.wgsl:line` of a line (from 1) of the assembled text.
    pub fn place(&self, line: usize) -> String {
        match self.starts.iter().rev().find(|(start, _)| *start <= line) {
            Some((start, path)) => format!("{path}:{}", line - start + 1),
            None => format!("line {line}"),
        }
    }
}

/// The program of a name.
///
/// # Errors
/// [`RenderError::NoSuchProgram`].
pub fn program(name: &str) -> Result<&'static Program, RenderError> {
    PROGRAMS
        .iter()
        .find(|program| program.name == name)
        .ok_or_else(|| RenderError::NoSuchProgram(name.to_owned()))
}

/// Makes a program's module at once. What the compiler has to say arrives later in [`Gpu::take_errors`]; tests/shaders.rs
/// sees to it that it has nothing to say.
///
/// # Errors
/// [`RenderError::NoSuchProgram`].
pub fn module(gpu: &Gpu, name: &str) -> Result<wgpu::ShaderModule, RenderError> {
    let program = program(name)?;
    let assembled = Assembled::new(program)?;
    Ok(gpu
        .device
        .create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(program.name),
            source: wgpu::ShaderSource::Wgsl(assembled.source.as_str().into()),
        }))
}

/// Compiles a program. Returns its name in the table and the module.
///
/// # Errors
/// [`RenderError::NoSuchProgram`], or [`RenderError::Shader`] with `file.wgsl:line` for each message.
pub async fn compile(
    gpu: &Gpu,
    name: &str,
) -> Result<(&'static str, wgpu::ShaderModule), RenderError> {
    let program = program(name)?;
    let assembled = Assembled::new(program)?;
    let scope = gpu.device.push_error_scope(wgpu::ErrorFilter::Validation);
    let module = gpu
        .device
        .create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(program.name),
            source: wgpu::ShaderSource::Wgsl(assembled.source.as_str().into()),
        });
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
    Ok((program.name, module))
}
