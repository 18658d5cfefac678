//! What the shaders know of kinds, as one block of `const` lines: their numbers, their bits in `drawn_kinds`, their
//! main parameters.

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
