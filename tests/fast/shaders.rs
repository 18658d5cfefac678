//! Every shader program parses and validates with what browsers have, and keeps the rules of the house.

use fabrica::document::TemplateKind;
use fabrica::render::Cases;
use fabrica::render::programs::{self, Assembled, PROGRAMS, Program, Stage, SubjectShader};
use std::collections::BTreeSet;
use wgpu::naga;

/// What naga's default capabilities add to none is sample-rate shading and cube arrays; WebGPU has both and we use
/// neither.
fn browser_capabilities() -> naga::valid::Capabilities {
    naga::valid::Capabilities::empty()
}

fn validator() -> naga::valid::Validator {
    naga::valid::Validator::new(naga::valid::ValidationFlags::all(), browser_capabilities())
}

fn check(source: &str) -> Result<naga::Module, (Option<usize>, String)> {
    let module = naga::front::wgsl::parse_str(source).map_err(|error| {
        let line = error.location(source).map(|at| at.line_number as usize);
        (line, error.emit_to_string(source))
    })?;
    validator().validate(&module).map_err(|error| {
        let line = error.location(source).map(|at| at.line_number as usize);
        (line, error.emit_to_string(source))
    })?;
    Ok(module)
}

/// Every program for every kind of subject.
fn programs_of_kinds() -> impl Iterator<Item = (&'static Program, SubjectShader)> {
    let each = |program| SubjectShader::ALL.iter().map(move |kind| (program, *kind));
    PROGRAMS.iter().flat_map(each)
}

#[test]
fn every_program_validates() {
    for (program, kind) in programs_of_kinds() {
        let text = Assembled::new(program, kind, Cases::ALL);
        let module = check(&text.source).unwrap_or_else(|(line, message)| {
            let place = line.map_or_else(String::new, |line| text.place(line));
            panic!("{} at {place}: {message}", program.name)
        });
        let found: BTreeSet<(String, naga::ShaderStage)> = module
            .entry_points
            .iter()
            .map(|entry| (entry.name.clone(), entry.stage))
            .collect();
        let declared = program
            .entries
            .iter()
            .map(|(name, stage)| {
                let stage = match stage {
                    Stage::Vertex => naga::ShaderStage::Vertex,
                    Stage::Fragment => naga::ShaderStage::Fragment,
                    Stage::Compute => naga::ShaderStage::Compute,
                };
                ((*name).to_owned(), stage)
            })
            .collect();
        assert_eq!(found, declared, "entry points of {}", program.name);
    }
}

/// No templates; one way of keeping tissue alone; one way of giving way alone.
fn few_cases() -> impl Iterator<Item = Cases> {
    (0..9).map(|i| Cases {
        kinds: 0,
        align_modes: 1 << (i % 5),
        gives_way: i > 4,
        gives_way_late: i == 6,
        gives_way_by_coordinate: i == 7,
        moves_as_a_whole: i == 8,
    })
}

/// Programs for documents of some cases only: whatever these are, a program validates and has the same bindings.
#[test]
fn programs_without_some_kinds_validate() {
    let bindings = |text: &Assembled, what: &str| {
        let module = check(&text.source).unwrap_or_else(|(line, message)| {
            let place = line.map_or_else(String::new, |line| text.place(line));
            panic!("{what} at {place}: {message}")
        });
        let info = validator().validate(&module).expect("validated above");
        let mut used = BTreeSet::new();
        for entry in 0..module.entry_points.len() {
            for (handle, global) in module.global_variables.iter() {
                let binding = global.binding.as_ref().map(|b| (entry, b.group, b.binding));
                used.extend(binding.filter(|_| !info.get_entry_point(entry)[handle].is_empty()));
            }
        }
        used
    };
    for (program, kind) in programs_of_kinds() {
        let whole = bindings(&Assembled::new(program, kind, Cases::ALL), program.name);
        for cases in few_cases() {
            let left = bindings(&Assembled::new(program, kind, cases), program.name);
            assert_eq!(left, whole, "{} for {kind:?}, {cases:?}", program.name);
        }
    }
    for kind in TemplateKind::ALL {
        let name = kind.spec().name;
        let file = programs::file(&format!("displace/{name}.wgsl")).expect("embedded");
        for other in TemplateKind::ALL.into_iter().filter(|other| *other != kind) {
            let call = format!("displace_{}(", other.spec().name);
            assert!(
                !file.source.contains(&call),
                "{name} calls {call}, which may not be there"
            );
        }
        let formula = file
            .source
            .find(&format!("fn displace_{name}("))
            .expect("its formula");
        assert!(
            !file.source[formula + 1..].contains("\nfn "),
            "{name}'s formula is the last in its file"
        );
        let program = programs::ProgramId::Probe.program();
        let text = Assembled::new(
            program,
            SubjectShader::Volume,
            Cases::of_kinds(1 << kind as u32),
        );
        bindings(&text, kind.spec().name);
    }
}

/// Where a folder is named, the programs are left there as the GPU gets them, each line with the file and line it came
/// from.
#[test]
fn programs_are_written_where_a_folder_is_named() {
    let scratch = tempfile::tempdir().expect("a folder");
    let folder = std::env::var_os("FABRICA_DUMP_SHADERS")
        .map_or_else(|| scratch.path().to_owned(), std::path::PathBuf::from);
    std::fs::create_dir_all(&folder).expect("the folder");
    for program in PROGRAMS {
        let text = Assembled::new(program, SubjectShader::Volume, Cases::ALL);
        std::fs::write(folder.join(format!("{}.wgsl", program.name)), &text.source)
            .expect("the program");
        let map: String = (1..=text.source.lines().count())
            .map(|line| format!("{line}\t{}\n", text.place(line)))
            .collect();
        assert!(
            map.ends_with(&format!("{}\n", text.place(text.source.lines().count())))
                && map.starts_with("1\t"),
            "{} has a line map",
            program.name
        );
        std::fs::write(folder.join(format!("{}.lines", program.name)), map).expect("the line map");
    }
}

/// The picture needs only what WebGL2 also has: no storage buffers or textures in programs that draw.
#[test]
fn drawing_uses_no_storage() {
    for (program, kind) in programs_of_kinds() {
        if program
            .entries
            .iter()
            .any(|(_, stage)| *stage == Stage::Compute)
        {
            continue;
        }
        let module =
            check(&Assembled::new(program, kind, Cases::ALL).source).expect("validated above");
        for (_, global) in module.global_variables.iter() {
            let name = global.name.as_deref().unwrap_or_default();
            assert!(
                !matches!(global.space, naga::AddressSpace::Storage { .. }),
                "{}: {name} is a storage buffer",
                program.name
            );
            if let naga::TypeInner::Image { class, .. } = module.types[global.ty].inner {
                assert!(
                    !matches!(class, naga::ImageClass::Storage { .. }),
                    "{}: {name} is a storage texture",
                    program.name
                );
            }
        }
    }
}

/// What the `needs:` lines of a file name, with what those files need, is all that it takes names from; and every file
/// is used.
#[test]
fn needs_lines_hold() {
    let mut used = BTreeSet::new();
    for (program, kind) in programs_of_kinds() {
        used.extend(program.files(kind).iter().map(|file| file.path));
    }
    for file in programs::FILES {
        assert!(used.contains(file.path), "no program uses {}", file.path);
        assert!(!file.needs.is_empty(), "{} has no needs line", file.path);
        let needs = programs::needs(file);
        for path in needs.iter().flat_map(|need| need.split('|')) {
            let known = programs::file(path);
            assert!(
                known.is_some(),
                "{} needs {path}, which is not there",
                file.path
            );
        }
        // A choice of the map, and one of the kind of subject.
        let of_kind = |kind: &SubjectShader| programs::files_of(file.path, &kind.paths());
        let all = SubjectShader::ALL.iter().flat_map(of_kind);
        let mut choices: Vec<Vec<&str>> = (SubjectShader::ALL.iter())
            .map(|kind| kind.paths().to_vec())
            .collect();
        let of_kinds: Vec<&str> = SubjectShader::ALL.iter().flat_map(|k| k.paths()).collect();
        let needed: BTreeSet<&str> = all.flat_map(programs::needs).collect();
        let of_map = |need: &&str| {
            need.contains('|') && need.split('|').all(|path| !of_kinds.contains(&path))
        };
        for need in needed.into_iter().filter(of_map) {
            let with = |path| {
                choices
                    .iter()
                    .map(move |made| [made.as_slice(), &[path]].concat())
            };
            choices = need.split('|').flat_map(with).collect();
        }
        for stand_ins in choices {
            let files = programs::files_of(file.path, &stand_ins);
            // A file of one kind of subject is not joined with those of another.
            let is_other = |path: &&str| of_kinds.contains(path) && !stand_ins.contains(path);
            if files.iter().any(|file| is_other(&file.path)) {
                continue;
            }
            let text = Assembled::of(&files, Cases::ALL);
            check(&text.source).unwrap_or_else(|(line, message)| {
                let place = line.map_or_else(String::new, |line| text.place(line));
                panic!("{} with what it needs, at {place}: {message}", file.path)
            });
        }
    }
}

/// Negative control: a file that is missing in a `needs:` line, and a choice that a program does not make, are seen.
#[test]
fn a_missing_need_is_seen() {
    let undecided = programs::files_of("pass/raycast.wgsl", &[]);
    assert!(
        check(&Assembled::of(&undecided, Cases::ALL).source).is_err(),
        "somebody has to choose"
    );
    let alone = programs::file("march/value.wgsl").expect("embedded");
    assert!(check(alone.source).is_err(), "it needs the subject");
}

/// A kind has its file and is called in compose.wgsl under its own name and bit.
#[test]
fn every_kind_has_its_place_in_the_shaders() {
    let compose = programs::file("displace/compose.wgsl")
        .expect("embedded")
        .source;
    let kinds = programs::file("kinds.wgsl").expect("made").source;
    for kind in TemplateKind::ALL {
        let name = kind.spec().name;
        let (path, upper) = (format!("displace/{name}.wgsl"), name.to_uppercase());
        let file = programs::file(&path).unwrap_or_else(|| panic!("{path} is not embedded"));
        let function = format!("fn displace_{name}(q: vec3f, size: vec3f, p0: vec4f, p1: vec4f");
        assert!(file.source.contains(&function), "{path} has no {function}");
        let case = compose.split(&format!("case KIND_{upper}: {{")).nth(1);
        let case = case.unwrap_or_else(|| panic!("compose.wgsl does not know {name}"));
        let case = case.split("case KIND_").next().unwrap_or_default();
        assert!(
            case.contains(&format!("(drawn_kinds & DRAWN_{upper}) != 0u")),
            "bit of {name}"
        );
        assert!(
            case.contains(&format!("d = displace_{name}(")),
            "call of {name}"
        );
        let number = kind as u32;
        for line in [
            format!("const KIND_{upper}: u32 = {number}u;"),
            format!("const DRAWN_{upper}: u32 = {:#x}u;", 1u32 << number),
        ] {
            assert!(kinds.contains(&line), "{line}");
        }
    }
}

/// Library files hold no bindings and no entry points, so that they run unchanged in a pass and in a probe.
#[test]
fn library_files_hold_no_bindings() {
    for file in programs::FILES {
        let is_library = !file.path.starts_with("bind/") && !file.path.starts_with("pass/");
        if is_library {
            for word in ["@group", "@fragment", "@vertex", "@compute"] {
                let code = file
                    .source
                    .lines()
                    .map(|line| line.split("//").next().unwrap_or_default());
                assert!(
                    code.into_iter().all(|line| !line.contains(word)),
                    "{} holds {word}",
                    file.path
                );
            }
        }
    }
}

/// Each binding has a comment.
#[test]
fn bindings_have_comments() {
    for file in programs::FILES {
        let lines: Vec<&str> = file.source.lines().collect();
        for (i, line) in lines.iter().enumerate() {
            if line.contains("@binding(") && !line.trim_start().starts_with("//") {
                assert!(
                    i > 0 && lines[i - 1].trim_start().starts_with("///"),
                    "{}:{} has no comment",
                    file.path,
                    i + 1
                );
            }
        }
    }
}

/// Negative control and the line map: an error planted in a file in the middle is named with that file and its line.
#[test]
fn an_error_names_its_file_and_line() {
    let program = programs::ProgramId::Raycast.program();
    let text = Assembled::new(program, SubjectShader::Volume, Cases::ALL);
    let planted = "let half_dir = normalize(look.key_dir.xyz + to_eye);";
    let broken = text.source.replace(
        planted,
        "let half_dir = normalize(look.key_dir.xyz + to_moon);",
    );
    assert_ne!(broken, text.source, "the error is planted");
    let (line, _) = check(&broken).expect_err("an unknown name must not validate");
    let file = programs::file("march/shade.wgsl").expect("embedded");
    let expected = file
        .source
        .lines()
        .position(|line| line.contains(planted))
        .expect("it is there")
        + 1;
    assert_eq!(
        text.place(line.expect("naga says where")),
        format!("march/shade.wgsl:{expected}")
    );
}
