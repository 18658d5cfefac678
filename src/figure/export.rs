use glam::DVec2;
use serde_json::{Map, Value, json};

use super::mesh::Part;
use super::solve::{GripKind, Posed, Rig};
use crate::document::figure::{Figure, Rigidity};

/// Rigid parts that count as elastic are listed as a region of this name, behind its own.
const LOOSE: &str = " (elastic)";

/// A posed figure as JSON, for other programs (spec/figures.md, "Labels, steps, link, files out"): mesh, regions, what
/// handles hold, and where vertices go. Points are at rest, but for `positions` and `to`; vertices are named by their
/// number in `vertices`, in the context's `triangles` too.
pub fn exported(rig: &Rig, figure: &Figure, posed: &Posed) -> Value {
    let mesh = &rig.mesh;
    let (regions, of_triangles) = regions(rig, figure);
    let triangles: Vec<Value> = mesh
        .triangles
        .iter()
        .map(|corners| json!(corners))
        .collect();
    let mut out = Map::new();
    let mut put = |key: &str, value: Value| {
        out.insert(key.to_owned(), value);
    };
    put("vertices", points(&mesh.vertices));
    put("triangles", Value::Array(triangles));
    put("region", json!(of_triangles));
    put("regions", Value::Array(regions));
    put("handles", handles(rig, figure, &posed.base));
    put("contours", contours(rig, figure));
    put("propagation", json!(figure.propagation.name()));
    put("reach", json!(figure.reach));
    put("rotations", json!(figure.rotations.name()));
    put("context", context(rig, figure));
    put("positions", points(&posed.places));
    put("folded", json!(posed.folded));
    put(
        "context_found",
        match posed.context_found {
            Some([turn, scale]) => json!({ "turn": turn, "scale": scale }),
            None => Value::Null,
        },
    );
    put("rounds", json!(super::solve::MAX_ROUNDS));
    put("tolerance", json!(super::solve::TOLERANCE));
    Value::Object(out)
}

fn point(at: DVec2) -> Value {
    json!([at.x, at.y])
}

fn points(list: &[DVec2]) -> Value {
    list.iter().map(|at| point(*at)).collect()
}

fn rigidity_value(rigidity: Rigidity) -> Value {
    match rigidity {
        Rigidity::Rigid => json!("rigid"),
        Rigidity::Elastic([kx, ky]) if kx == ky => json!(kx),
        Rigidity::Elastic(k) => json!(k),
    }
}

/// The regions in the order of the list, the rest, and those of rigid parts that count as elastic; and the region of
/// each triangle.
fn regions(rig: &Rig, figure: &Figure) -> (Vec<Value>, Vec<usize>) {
    let mesh = &rig.mesh;
    let mut regions = Vec::new();
    for tissue in &mesh.tissues {
        let rigidity = match tissue.part {
            Part::Region(i) => figure.regions[i].rigidity,
            Part::Behind(_) | Part::Rest => Rigidity::SOFT,
        };
        regions.push(json!({
            "name": tissue.name,
            "rigidity": rigidity_value(rigidity),
            "pixels": tissue.pixels,
        }));
    }
    let mut of_triangles: Vec<usize> = mesh
        .tissue_of
        .iter()
        .map(|tissue| usize::from(*tissue))
        .collect();
    let mut loose_of = vec![None; mesh.tissues.len()];
    for t in &rig.pose.parts.loose {
        let of = &mut of_triangles[*t as usize];
        let name = &mesh.tissues[*of].name;
        *of = *loose_of[*of].get_or_insert_with(|| {
            regions.push(json!({
                "name": format!("{name}{LOOSE}"),
                "rigidity": rigidity_value(Rigidity::Elastic(Rigidity::BONE)),
                "pixels": 0,
            }));
            regions.len() - 1
        });
    }
    (regions, of_triangles)
}

fn kind_name(kind: GripKind) -> &'static str {
    match kind {
        GripKind::Point => "point",
        GripKind::Region => "region",
        GripKind::Line => "line",
        GripKind::Outside => "outside",
    }
}

/// What each handle would hold alone and what it does; fixed regions and the outside of `only` last.
fn handles(rig: &Rig, figure: &Figure, base: &[DVec2]) -> Value {
    let mut found = Vec::new();
    for grip in &rig.pose.holding.grips {
        let at = grip.anchors.first().map_or(DVec2::ZERO, |anchor| anchor.at);
        let handle = grip.handle.and_then(|index| figure.handles.get(index));
        let motion = handle.map(|handle| handle.motion).unwrap_or_default();
        let turn = if grip.kind == GripKind::Point {
            motion.turn
        } else {
            Some(motion.turn.unwrap_or(0.0))
        };
        let mut value = json!({
            "kind": kind_name(grip.kind),
            "vertices": grip.alone,
            "at": point(at),
            "move": point(motion.by),
            "turn": turn,
            "scale": motion.scale,
        });
        if let Some((to, targets)) = rig.line_targets(grip, figure, base) {
            value["move"] = point(to - at);
            value["turn"] = json!(0.0);
            value["scale"] = json!(1.0);
            put_targets(&mut value, &targets);
        }
        found.push(value);
    }
    Value::Array(found)
}

fn put_targets(value: &mut Value, targets: &[(DVec2, f64, f64)]) {
    value["to"] = targets.iter().map(|(place, ..)| point(*place)).collect();
    value["turns"] = targets.iter().map(|(_, turn, _)| json!(turn)).collect();
    value["scales"] = targets.iter().map(|(.., scale)| json!(scale)).collect();
}

fn contours(rig: &Rig, figure: &Figure) -> Value {
    let of = |(number, vertices, targets): (usize, Vec<u32>, Vec<(DVec2, f64, f64)>)| {
        let mut value = json!({ "region": figure.contours[number].region, "vertices": vertices });
        put_targets(&mut value, &targets);
        value
    };
    rig.contour_targets(figure).into_iter().map(of).collect()
}

fn context(rig: &Rig, figure: &Figure) -> Value {
    let (Some(sheet), Some(context)) = (rig.context(), &figure.context) else {
        return Value::Null;
    };
    let like = context
        .like
        .as_ref()
        .map(|like| points(&sheet.points.iter().map(|i| like[*i]).collect::<Vec<_>>()));
    let triangles: Vec<[u32; 3]> = sheet
        .elements
        .iter()
        .map(|element| element.vertices)
        .collect();
    json!({
        "vertices": sheet.vertices,
        "triangles": triangles,
        "strength": context.strength,
        "keep": context.keep,
        "like": like,
        "amount": context.amount,
    })
}
