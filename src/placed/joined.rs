//! One sweep out of two (spec/sweepers.md, A.4, "Lists and modes", and B.3): the tools of one act at once and never
//! fold tissue, which a sum of two may.

use crate::displace::{COAT, FARTHEST, MAX_IMAGES, MAX_TOOLS, SweepTools};
use crate::document::{PlacedTemplate, TemplateData, TemplateMode};
use glam::Vec3;

/// The sweep that can take the tools of the one at `index`: the one just before it, or one farther before to which its
/// displacement is added. Its index, and the tools that it then has, which go through the subject as they did. `None`
/// where there is none, or where the two are done in different ways: by other parts, along curves, with other tissue
/// kept, with more tools than one sweep has.
pub fn joined_sweep(templates: &[PlacedTemplate], index: usize) -> Option<(usize, SweepTools)> {
    let place = templates.iter().position(|t| t.index == index)?;
    let own = &templates[place];
    for other in templates[..place].iter().rev() {
        if let Some(tools) = joined(other, own) {
            return Some((other.index, tools));
        }
        if own.mode != TemplateMode::Add || other.mode != TemplateMode::Add {
            return None;
        }
    }
    None
}

/// The tools of both in the box of the first.
fn joined(first: &PlacedTemplate, second: &PlacedTemplate) -> Option<SweepTools> {
    let (TemplateData::Tools(held), TemplateData::Tools(added)) = (&first.data, &second.data)
    else {
        return None;
    };
    let is_straight = first.curve.is_none() && second.curve.is_none();
    let is_alike = first.params == second.params
        && first.amount == second.amount
        && first.enabled == second.enabled
        && first.align == second.align
        && first.constrain == second.constrain;
    // Planes of mirrors go through the middle of the box.
    let has_planes = held.images() > 1 || added.images() > 1;
    let is_mirrored_alike =
        !has_planes || (held.mirror == added.mirror && first.placement == second.placement);
    let count = held.tools.len() + added.tools.len();
    let fits = count <= MAX_TOOLS && count * held.images() <= MAX_IMAGES;
    if !(is_straight && is_alike && is_mirrored_alike && fits) {
        return None;
    }
    let (to, from) = (first.placement, second.placement);
    let turn = to.rotate.conjugate() * from.rotate;
    let grown = from.size.min_element() / to.size.min_element();
    let mut joined = held.clone();
    for tool in &added.tools {
        let mut tool = tool.clone();
        // A tool of an unknown shape stays where the document has it.
        let shape = tool.shape.as_mut()?;
        shape.numbers_mut().into_iter().for_each(|x| *x *= grown);
        tool.coat *= grown;
        let coat = f64::from(tool.coat);
        let is_sized = shape.is_in_range() && (COAT[0]..=COAT[1]).contains(&coat);
        for key in &mut tool.path {
            key.at = to.template_from_subject(from.subject_from_template(key.at));
            key.rotate = (turn * key.rotate).normalize();
        }
        let is_near = |at: Vec3| at.abs().max_element() <= FARTHEST;
        if !is_sized || !tool.path.iter().all(|key| is_near(key.at)) {
            return None;
        }
        tool.index = usize::MAX;
        joined.tools.push(tool);
    }
    Some(joined)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::Grids;
    use crate::document::Document;
    use crate::placed::tool_ways;
    use serde_json::{Value, json};

    fn read(templates: &[Value]) -> Vec<PlacedTemplate> {
        let document = Document::from_value(json!({ "fabrica": 1, "templates": templates }));
        document.expect("right").illustration().templates.clone()
    }

    fn sweep(at: [f32; 3], size: [f32; 3], more: &Value) -> Value {
        let mut template = json!({ "kind": "sweep", "at": at, "size": size, "params": { "tools": [
            { "shape": "box", "coat": 0.3, "path": [[0.2, 0.5, 0.9], { "at": [0.6, 0.4, 0.5], "rotate": [0, 0.6, 0, 0.8] }] }
        ] } });
        for (key, value) in more.as_object().expect("keys") {
            template[key] = value.clone();
        }
        template
    }

    #[test]
    fn a_tool_goes_through_the_subject_as_it_did() {
        let first = sweep([0.1, 0.0, 0.2], [0.4, 0.5, 0.6], &json!({}));
        let turned = json!({ "rotate": [0.0, 0.6, 0.0, 0.8], "mode": "add" });
        let second = sweep([-0.1, 0.1, 0.0], [0.6, 0.3, 0.5], &turned);
        let all = read(&[first.clone(), second.clone()]);
        let (index, tools) = joined_sweep(&all, 1).expect("both are straight and alike");
        assert_eq!((index, tools.tools.len()), (0, 2));
        let mut whole = all[0].clone();
        whole.data = TemplateData::Tools(tools.clone());
        let before = tool_ways(&all[1], &Grids::default())[0]
            .clone()
            .expect("a box");
        let after = tool_ways(&whole, &Grids::default())[1]
            .clone()
            .expect("a box");
        let lines = before.outline.iter().zip(&after.outline);
        for (old, new) in lines.flat_map(|(old, new)| old.iter().zip(new)) {
            let [old, new] =
                [(&all[1], *old), (&whole, *new)].map(|(t, q)| t.subject_from_template(q));
            assert!(old.distance(new) < 1e-5, "{old} and {new}");
        }
        for (old, new) in before.poses.iter().zip(&after.poses) {
            let [old, new] =
                [(&all[1], old.at), (&whole, new.at)].map(|(t, q)| t.subject_from_template(q));
            assert!(old.distance(new) < 1e-5, "{old} and {new}");
        }
        let coats = [
            (all[1].placement, 0.3),
            (whole.placement, tools.tools[1].coat),
        ];
        let [old, new] = coats.map(|(placement, coat)| placement.size.min_element() * coat);
        assert!((old - new).abs() < 1e-6, "{old} and {new}");
        // One between them, added too, is no obstacle; one that they come after is.
        let poke = |mode: &str| json!({ "kind": "poke", "mode": mode });
        let found = |mode| joined_sweep(&read(&[first.clone(), poke(mode), second.clone()]), 2);
        assert_eq!(found("add").map(|(index, _)| index), Some(0));
        assert!(found("compose").is_none());
    }

    #[test]
    fn what_is_done_in_another_way_is_not_joined() {
        let none = |first: Value, second: Value| {
            let first = sweep([0.0; 3], [0.4; 3], &first);
            let mut second = sweep([0.1, 0.0, 0.0], [0.4; 3], &second);
            if second["mode"].is_null() {
                second["mode"] = json!("add");
            }
            joined_sweep(&read(&[first, second]), 1).is_none()
        };
        assert!(!none(json!({}), json!({})), "these are alike");
        assert!(
            !none(json!({}), json!({ "mode": "compose" })),
            "one after the other"
        );
        assert!(none(json!({}), json!({ "amount": 0.5 })));
        assert!(none(
            json!({ "align": { "to": "segment", "keep": ["bone"] } }),
            json!({})
        ));
        assert!(none(
            json!({ "params": { "mirror": "x" } }),
            json!({ "params": { "mirror": "x" } })
        ));
        let four = json!({ "params": { "tools": [{}, {}, {}, {}] } });
        assert!(none(four, json!({})), "five tools");
        let small = json!({ "size": [0.01, 0.01, 0.01] });
        assert!(none(small, json!({})), "lengths beyond their ranges");
    }
}
