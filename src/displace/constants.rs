//! What the shaders know of kinds, as one block of `const` lines: their numbers, their bits in `drawn_kinds`, their
//! main parameters; and what stands for the formula of a kind that a document does not have.

use super::drawn::DRAWN_OF_SWEEPS;
use super::facts::Holds;
use super::kind::TemplateKind;
use super::spec::{ParamKind, ParamValue};
use std::fmt::Write as _;

/// Floats of the parameters that have a bit for each kind in `MAIN_PARAMETERS`.
const MAIN_FLOATS: usize = 4;

/// The text of `shaders/displace/kinds.wgsl`: numbers and masks of kinds, generated from the catalogue.
pub fn shader_constants() -> String {
    let mut text = String::from(
        "/// Bit of templates along curves in `drawn_kinds`.\nconst DRAWN_CURVES: u32 = 0x1u;\n",
    );
    let mut main = [0; MAIN_FLOATS];
    let _ = writeln!(
        text,
        "/// Bits of what sweeps have in `drawn_kinds`.\nconst DRAWN_OF_SWEEPS: u32 = {DRAWN_OF_SWEEPS:#x}u;"
    );
    for kind in TemplateKind::ALL {
        let (name, number) = (kind.spec().name.to_uppercase(), kind as u32);
        let bit = 1u32 << number;
        let _ = writeln!(text, "const KIND_{name}: u32 = {number}u;");
        let _ = writeln!(text, "const DRAWN_{name}: u32 = {bit:#x}u;");
        for float in main_floats(kind) {
            main[float] |= bit;
        }
    }
    let [x, y, z, w] = main;
    let _ = writeln!(
        text,
        "/// Bit k of component j: float j of the parameters of kind k is its main parameter, or a part of it.\n\
         const MAIN_PARAMETERS: vec4u = vec4u({x:#x}u, {y:#x}u, {z:#x}u, {w:#x}u);"
    );
    text
}

/// The file of a kind's formula for programs of documents without the kind (`drawn_kinds`: bit k for kind k): in place
/// of the formula, which is the last in its file, a function that moves nothing. None for other files, and for kinds
/// that occur. The function names the texture that the formula reads, so that the program has the same bindings.
/// `path`: under `shaders/`.
pub fn without_formula(path: &str, text: &str, drawn_kinds: u32) -> Option<String> {
    let name = path.strip_prefix("displace/")?.strip_suffix(".wgsl")?;
    let kind = TemplateKind::from_name(name)?;
    if drawn_kinds & (1 << kind as u32) != 0 {
        return None;
    }
    let (held, texture) = match kind.facts().holds {
        Holds::Parameters => ("", None),
        Holds::Points => (", held: u32", None),
        Holds::File => (", held: u32", Some("fields")),
        Holds::Object => (", held: u32", Some("carvers")),
        Holds::Tools => (", held: u32", Some("sweeps")),
    };
    let touched = texture.map_or_else(String::new, |texture| {
        format!(
            "    d.continuity = select(d.continuity, 0.0, textureDimensions({texture}).x == 0u);\n"
        )
    });
    let formula = text.find(&format!("fn displace_{name}("))?;
    let before = &text[..formula];
    Some(format!(
        "{before}fn displace_{name}(q: vec3f, size: vec3f, p0: vec4f, p1: vec4f{held}) -> Displaced {{\n    \
         var d = at_rest(q);\n{touched}    return d;\n}}\n"
    ))
}

/// Where the main parameter lies among the floats that the parameters are packed into; nothing for a kind without one.
fn main_floats(kind: TemplateKind) -> std::ops::Range<usize> {
    let spec = kind.spec();
    let Some(main) = spec.main_param else {
        return 0..0;
    };
    let count = |kind: &ParamKind| {
        let mut floats = Vec::new();
        ParamValue::pack(&kind.default_value(), &mut floats);
        floats.len()
    };
    let before: usize = spec.params[..main].iter().map(|p| count(&p.kind)).sum();
    before..before + count(&spec.params[main].kind)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kinds_leave_room_for_what_sweeps_have() {
        for kind in TemplateKind::ALL {
            assert_eq!(DRAWN_OF_SWEEPS & (1 << kind as u32), 0, "{kind:?}");
        }
    }

    /// Written out once more, so that a change of a main parameter is meant.
    #[test]
    fn main_parameters_are_where_the_shaders_scale_them() {
        for kind in TemplateKind::ALL {
            let expected = match kind {
                TemplateKind::Cut => 0..0,
                TemplateKind::Pull | TemplateKind::Move => 0..3,
                TemplateKind::Slices => 3..4,
                _ => 0..1,
            };
            assert_eq!(main_floats(kind), expected, "{kind:?}");
            assert!(expected.end <= MAIN_FLOATS, "{kind:?} lies in params0");
        }
    }
}
